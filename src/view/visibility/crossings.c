/* crossings.c: cut sides within the polygons of their cuts. */
#include "view/visibility/crossings.h"
#include "base/sort.h"
#include "geom/predicates.h"
#include "tree/list.h"
#include <string.h>

/* ---------------------------------------------------------------------- finding -- */

static bool keep_open(void *user, const view_stretch *part) {
    view_crosser *c = user;
    return array_push(&c->sights->alloc, &c->open, *part);
}

/* Appends the parts of the open stretches inside the list of a cut, or all where the cut is the section. */
static bool keep_crossed(view_crosser *c, uint32_t node, uint32_t patch, view_stretches *out) {
    view_sightlines *s = c->sights;
    const tree_objects list = tree_list(s->tree, node);
    const bool section = node == 0 && c->section;
    bool ok = true;
    for (size_t k = 0; ok && section && k < c->open.count; k++) ok = array_push(&s->alloc, out, c->open.data[k]);
    for (uint32_t k = 0; ok && !section && c->open.count && k < list.count; k++) {
        const uint32_t object = tree_object(&list, k), other = s->surface->patch_of[object];
        if (other == FROE_NONE || other == patch || !view_facing(s, object)) continue;
        ok = view_beam_of(s, list.first + k, &c->list_ring);
        for (size_t i = 0; ok && i < c->open.count; i++) { /* its part inside that piece of the list */
            view_stretch part = c->open.data[i];
            bool left = c->list_ring.count > 0; /* unless it runs along the border */
            for (size_t j = 0; left && j < c->list_ring.count; j++)
                left = view_cut_stretch(s, part.edge, c->list_ring.data[j].way, &part);
            if (left) ok = array_push(&s->alloc, out, part);
        }
    }
    return ok;
}

/* Are there polygons in the list of a cut? Segments and points may be all. */
static bool lists_polygons(const view_sightlines *s, uint32_t node) {
    const tree_objects list = tree_list(s->tree, node);
    uint32_t k = 0;
    while (k < list.count && s->surface->patch_of[tree_object(&list, k)] == FROE_NONE) k++;
    return k < list.count;
}

froe_status view_look_at_crossings(view_crosser *c, uint32_t piece, const view_ring *ring) {
    view_sightlines *s = c->sights;
    const uint32_t patch = s->surface->patch_of[s->tree->pieces[piece].object];
    for (uint32_t i = 0; i < ring->count; i++) {
        const view_line *l = s->lines.data + (ring->data[i].way >> 1);
        const uint32_t node = l->kind == VIEW_CUT ? l->b : FROE_NONE; /* whose cut makes this side */
        if (node == FROE_NONE || (!lists_polygons(s, node) && !(node == 0 && c->section))) continue;
        const view_stretch side = view_side_of_ring(ring->data, (uint32_t)ring->count, i);
        view_stretch inside = side;
        c->open.count = 0;
        if (c->hidden && view_cut_to_window(s, side.edge, &inside) &&
            (!keep_open(c, &inside) || !keep_crossed(c, node, patch, &c->all)))
            return FROE_E_MEMORY;
        c->open.count = 0; /* first the open part, as most is hidden */
        if (!view_screen_side(c->screen, ring->data[i].way, keep_open, c) || !keep_crossed(c, node, patch, &c->seen))
            return FROE_E_MEMORY;
    }
    return FROE_OK;
}

void view_crosser_free(view_crosser *c) {
    array_free(&c->sights->alloc, &c->open);
    array_free(&c->sights->alloc, &c->seen);
    array_free(&c->sights->alloc, &c->all);
    array_free(&c->sights->alloc, &c->list_ring);
}

/* ----------------------------------------------------------------------- keeping -- */

typedef struct crossing_line {
    uint32_t line, patch;
    bool section, hidden;
} crossing_line;

/* A stretch in its final form. A patch that is seen edge-on is met in the section. */
static bool put_crossing(froe_visibility *v, const view_end *from, const view_end *to, crossing_line on) {
    froe_crossing x = {.patch = on.patch, .section = on.section, .hidden = on.hidden};
    const view_run run = {on.line, {view_mark_of(from), view_mark_of(to)}};
    geom_plane plane = view_plane_of(&v->sights, x.patch);
    if (!view_facing(&v->sights, surface_first(v->surface, x.patch))) plane = tree_plane_at(v->tree, 0);
    view_point_on(&v->sights, &plane, from->ray.x, x.from);
    view_point_on(&v->sights, &plane, to->ray.x, x.to);
    return array_push(&v->alloc, &v->crossings, x) && array_push(&v->alloc, &v->crossing_runs, run);
}

/* The line of a stretch that was found on a cut side. */
static crossing_line line_of_crossing(const froe_visibility *v, uint32_t line, bool hidden) {
    const view_line *l = v->sights.lines.data + line;
    return (crossing_line){line, l->a, v->section && l->b == 0, hidden};
}

/* -------------------------------------------------------------- along the section -- */

froe_status view_look_along_section(froe_visibility *v, uint32_t object) {
    view_sightlines *s = &v->sights;
    const uint32_t *edges = s->surface->edge_of + scene_start(s->tree->scene, object);
    const froe_scene *scene = s->tree->scene;
    const geom_plane plane = tree_plane_at(s->tree, 0);
    const uint32_t n = scene_corners(scene, object);
    view_mark mark[2];
    while (view_is_point(s, *edges)) edges++; /* all that are seen as lines lie on one */
    const uint32_t line = view_line_of_edge(s, *edges);
    if (line == FROE_NONE) return FROE_E_MEMORY;
    /* The two points of its border in which the section parts the polygon. */
    int count = 0, reached = 0, last = geom_side_vertex(&s->context, &plane, scene_point(scene, object, n - 1));
    for (uint32_t i = 0; i < n; i++) {
        const int side = geom_side_vertex(&s->context, &plane, scene_point(scene, object, i));
        const uint32_t before = s->surface->edge_of[scene_start(scene, object) + (i ? i - 1 : n - 1)];
        reached |= side > 0 ? 2 : side < 0 ? 1 : 0;
        if (!side && count < 2) mark[count++] = (view_mark){.vertex = scene_corner(scene, object, i)};
        if (side * last < 0 && count < 2 && view_stop_edge(s, before, FROE_NONE, line, &mark[count++]))
            return FROE_E_MEMORY;
        last = side;
    }
    if (reached != 3 || count < 2) return FROE_OK; /* the section only touches it */
    view_stretch part = {line, {view_end_at(s, line, mark[0]), view_end_at(s, line, mark[1])}};
    const int order = view_compare_ends(s, line, &part.end[0], &part.end[1]);
    if (!order) return FROE_OK;
    if (order > 0) part = (view_stretch){line, {part.end[1], part.end[0]}};
    if (!view_cut_to_window(s, line, &part)) return FROE_OK;
    return put_crossing(v, &part.end[0], &part.end[1], (crossing_line){line, s->surface->patch_of[object], true, false})
               ? FROE_OK
               : FROE_E_MEMORY;
}

/* ---------------------------------------------------------------------- joining -- */

typedef struct stretch_joiner {
    view_sightlines *sights;
    const view_stretch *stretches;
} stretch_joiner;

static int by_line(void *user, uint32_t a, uint32_t b) {
    const stretch_joiner *j = user;
    const view_stretch *x = j->stretches + a, *y = j->stretches + b;
    if (x->edge != y->edge) return x->edge < y->edge ? -1 : 1;
    return view_compare_along(j->sights, x->edge, &x->end[0], &y->end[0]);
}

/* Sorts the stretches of each line and unites those that touch or overlap. */
static froe_status join_stretches(view_sightlines *s, view_stretches *stretches) {
    const size_t n = stretches->count;
    if (n > INT32_MAX) return FROE_E_LIMIT;
    uint32_t *items = support_calloc(&s->alloc, 2 * n + 1, sizeof *items);
    view_stretch *copy = support_calloc(&s->alloc, n + 1, sizeof *copy);
    if (items && copy) {
        stretch_joiner j = {s, copy};
        if (n) memcpy(copy, stretches->data, n * sizeof *copy);
        for (uint32_t i = 0; i < n; i++) items[i] = i;
        base_merge_sort(items, items + n, n, by_line, &j);
        size_t kept = 0; /* what is left is in order and disjoint */
        for (size_t i = 0; i < n; i++) {
            const view_stretch next = copy[items[i]];
            view_stretch *last = kept ? stretches->data + kept - 1 : NULL;
            if (!last || last->edge != next.edge || view_compare_along(s, next.edge, &next.end[0], &last->end[1]) > 0)
                stretches->data[kept++] = next;
            else if (view_compare_along(s, next.edge, &next.end[1], &last->end[1]) > 0)
                last->end[1] = next.end[1];
        }
        stretches->count = kept;
    }
    const bool ok = items && copy;
    support_free(&s->alloc, items, (2 * n + 1) * sizeof *items);
    support_free(&s->alloc, copy, (n + 1) * sizeof *copy);
    return ok ? FROE_OK : FROE_E_MEMORY;
}

/* Appends the hidden parts of a stretch, between visible ones from *seen on and before `end`. *seen moves on. */
static bool put_hidden(froe_visibility *v, const view_stretch *part, const view_stretch **seen,
                       const view_stretch *end) {
    view_sightlines *s = &v->sights;
    const uint32_t line = part->edge;
    const view_end *from = &part->end[0], *to = &part->end[1];
    while (*seen < end && (*seen)->edge < line) ++*seen;
    for (const view_stretch *x = *seen; x < end && x->edge == line; x++) {
        if (view_compare_along(s, line, &x->end[1], from) <= 0) continue;
        if (view_compare_along(s, line, &x->end[0], to) >= 0) break;
        if (view_compare_along(s, line, from, &x->end[0]) < 0 &&
            !put_crossing(v, from, &x->end[0], line_of_crossing(v, line, true)))
            return false;
        from = &x->end[1];
    }
    return view_compare_along(s, line, from, to) >= 0 || put_crossing(v, from, to, line_of_crossing(v, line, true));
}

froe_status view_join_crossings(froe_visibility *v, view_crosser *c) {
    froe_status status = join_stretches(&v->sights, &c->seen);
    if (!status) status = join_stretches(&v->sights, &c->all);
    bool ok = !status;
    for (size_t i = 0; ok && i < c->seen.count; i++) {
        const view_stretch *x = c->seen.data + i;
        ok = put_crossing(v, &x->end[0], &x->end[1], line_of_crossing(v, x->edge, false));
    }
    const view_stretch *seen = c->seen.data;
    for (size_t i = 0; ok && i < c->all.count; i++)
        ok = put_hidden(v, c->all.data + i, &seen, c->seen.data + c->seen.count);
    return status ? status : ok ? FROE_OK : FROE_E_MEMORY;
}
