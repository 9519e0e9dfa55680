/* plan.c: the order in which nodes are painted, from the arcs between them.
 *
 * Where all is opaque, cycles are broken by patches that are painted clipped to their visible parts, so that they cover
 * nothing else. Where something is clear, that does not suffice: a clipped patch still has to come before the clear
 * patches in front of it. There patches in cycles are divided into their pieces, and arcs are found anew. This ends
 * when all are pieces, at the latest, since the order of pieces by the tree has no cycles. */
#include "view/picture/picture.h"
#include <string.h>

static froe_status find_graph(view_painter *p) {
    const froe_allocator *alloc = &p->picture->alloc;
    froe_picture_report *report = &p->picture->report;
    const uint64_t given = p->options->max_graph, own = 1000 * (uint64_t)p->v->piece_count;
    const uint64_t most = given ? given : own > 50000000 ? own : 50000000; /* pairs to be compared */
    view_graph_free(alloc, &p->graph);
    froe_status status = view_parts_make(&p->parts, p->sights);
    if (!status) status = view_find_arcs(&p->parts, p->sights, &p->task, most, &p->arcs, &report->tests);
    if (!status) status = view_graph_new(alloc, (uint32_t)p->parts.nodes.count, p->arcs.data, p->arcs.count, &p->graph);
    array_free(alloc, &p->arcs);
    if (status) return status;
    const size_t n = p->parts.nodes.count;
    uint8_t *fixed = support_calloc(alloc, n + 1, 1);
    if (!fixed) return FROE_E_MEMORY;
    for (size_t i = 0; i < n; i++) fixed[i] = p->parts.nodes.data[i].piece != FROE_NONE;
    status = view_graph_break(alloc, &p->graph, fixed);
    support_free(alloc, fixed, n + 1);
    report->arcs = p->graph.arc_count;
    if (!report->cyclic) report->cyclic = p->graph.cyclic;
    return status;
}

/* Divides the patches of late nodes. False when there was none. */
static bool split_late(view_painter *p) {
    bool any = false;
    for (uint32_t v = 0; v < p->graph.count; v++) {
        const paint_node *node = p->parts.nodes.data + v;
        if (!p->graph.late[v] || node->piece != FROE_NONE) continue;
        p->picture->report.late++;
        p->parts.split[node->patch] = PARTS_PIECES;
        any = true;
    }
    return any;
}

/* Lines have a style of their own. */
static uint32_t style_of_node(const view_painter *p, uint32_t v, uint32_t lines) {
    if (v >= p->parts.nodes.count) return lines;
    return p->options->styles ? p->options->styles[p->parts.nodes.data[v].patch] : 0;
}

froe_status view_sort_nodes(const view_painter *p, const view_graph *graph, uint32_t *order) {
    const froe_allocator *alloc = &p->picture->alloc;
    uint32_t lines = 0, *styles = support_calloc(alloc, (size_t)graph->count + 1, sizeof *styles);
    if (!styles) return FROE_E_MEMORY;
    for (uint32_t v = 0; v < p->parts.nodes.count; v++)
        if (style_of_node(p, v, 0) >= lines) lines = style_of_node(p, v, 0) + 1;
    for (uint32_t v = 0; v < graph->count; v++) styles[v] = style_of_node(p, v, lines);
    const froe_status status = view_graph_sort(alloc, graph, styles, lines + 1, order);
    support_free(alloc, styles, ((size_t)graph->count + 1) * sizeof *styles);
    return status;
}

froe_status view_plan_whole(view_painter *p) {
    const bool clear = p->places != NULL;
    const froe_visibility *v = p->v;
    const froe_tree *t = v->tree;
    const uint32_t middle = v->section ? tree_first_piece(t, t->nodes->child + 1) : 0;
    const uint32_t from = v->section < 0 ? middle : tree_first_piece(t, t->nodes->child);
    for (uint32_t i = from; v->section && i < (v->section < 0 ? t->piece_count : middle); i++) {
        const uint32_t patch = v->surface->patch_of[t->pieces[i].object]; /* may be cut by the section: */
        if (patch != FROE_NONE) p->parts.split[patch] = PARTS_REGION;     /* only its visible parts are painted */
    }
    if (p->options->paint == FROE_PAINT_REGIONS)
        memset(p->parts.split, PARTS_REGION, v->surface->patch_count * sizeof *p->parts.split);
    froe_status status = find_graph(p);
    while (!status && clear && split_late(p)) status = find_graph(p);
    if (!clear) p->picture->report.late = p->graph.late_count;
    if (status) return status;
    p->order = support_calloc(&p->picture->alloc, p->parts.nodes.count + 1, sizeof *p->order);
    if (!p->order) return FROE_E_MEMORY;
    const bool among =
        p->options->paint == FROE_PAINT_WHOLE && (p->options->interleave > 0 || p->options->interleave_points > 0);
    status = among ? view_interleave(p) : view_sort_nodes(p, &p->graph, p->order);
    view_parts_drop(&p->parts);
    view_graph_drop(&p->picture->alloc, &p->graph);
    return status;
}
