/* visibility.c: pieces front to back, each sent down the beam tree. */
#include "base/floats.h"
#include "support/fail.h"
#include "tree/gate.h"
#include "view/visibility/crossings.h"
#include "view/visibility/order.h"
#include "view/visibility/wires.h"
#include <math.h>
#include <string.h>

void froe_visibility_defaults_into(froe_visibility_options *out, size_t size) {
    const froe_visibility_options all = {.size = size};
    support_defaults(out, size, &all, sizeof all);
}

typedef struct visibility_search {
    froe_visibility *v;
    const froe_visibility_options *options;
    base_task task;
    view_screen screen;
    view_ring ring;
    view_runs stretches;
    view_crosser crosser;
    ARRAY(view_piece) pieces;
    uint32_t *ranks; /* per object */
    view_piece now;
    uint32_t edge; /* whose stretches are being kept */
} visibility_search;

/* --------------------------------------------------------------------- looking -- */

static bool keep_stretch(void *user, const view_stretch *part) {
    visibility_search *k = user;
    const view_run run = {part->edge, {view_mark_of(&part->end[0]), view_mark_of(&part->end[1])}};
    return array_push(&k->v->alloc, &k->stretches, run);
}

static bool keep_side(void *user, const view_stretch *side) {
    visibility_search *k = user;
    const view_stretch part = {k->edge, {side->end[0], side->end[1]}};
    return keep_stretch(k, &part);
}

/* Keeps what was found open of the current piece. */
static froe_status keep_pieces(visibility_search *k) {
    froe_visibility *v = k->v;
    const view_screen *s = &k->screen;
    for (size_t n = 0; n < s->seen.count; n++) {
        const view_opening *part = s->seen.data + n;
        if (!array_reserve(&v->alloc, &v->corners, part->count)) return FROE_E_MEMORY;
        k->now.first = (uint32_t)v->corners.count;
        k->now.count = part->count;
        const view_corner *ring = s->ring.data + part->first;
        for (uint32_t i = 0; i < part->count; i++) {
            const view_way before = ring[i ? i - 1 : part->count - 1].way;
            if (!view_keep_corner(v, ring + i, before)) return FROE_E_MEMORY;
        }
        if (v->corners.count > INT32_MAX || !array_push(&v->alloc, &k->pieces, k->now)) return FROE_E_MEMORY;
    }
    return FROE_OK;
}

static bool is_wanted(const visibility_search *k, uint32_t edge) {
    return !k->options->edges || k->options->edges[edge];
}

/* Stretches of edges where the border of a polygon goes straight on at some corners, which its beam leaves out. */
static froe_status look_along_sides(visibility_search *k, uint32_t object) {
    view_sightlines *s = &k->v->sights;
    froe_status status = FROE_OK;
    view_stretch stretch;
    for (uint32_t i = 0, n = scene_corners(s->tree->scene, object); i < n && !status; i++) {
        if (!is_wanted(k, s->surface->edge_of[scene_start(s->tree->scene, object) + i])) continue;
        if (!view_stretch_of(s, object, i, &k->ring, &stretch, &status)) continue;
        const uint32_t line = view_line_of_edge(s, stretch.edge);
        status =
            view_screen_classify(&k->screen, &stretch, line, k->ring.data, (uint32_t)k->ring.count, keep_stretch, k);
    }
    return status;
}

/* Edges are seen where the piece is seen beside them. */
static froe_status look_at_edges(visibility_search *k, uint32_t piece) {
    view_sightlines *s = &k->v->sights;
    const uint32_t object = s->tree->pieces[piece].object;
    if (view_goes_straight(s, object)) return look_along_sides(k, object);
    for (size_t i = 0; i < k->ring.count; i++) {
        const view_way way = k->ring.data[i].way;
        const view_line *line = s->lines.data + (way >> 1);
        if (line->kind != VIEW_EDGE || !is_wanted(k, line->c)) continue;
        k->edge = line->c;
        if (!view_screen_side(&k->screen, way, keep_side, k)) return FROE_E_MEMORY;
    }
    return FROE_OK;
}

static froe_status look_at(visibility_search *k, uint32_t piece, uint32_t place) {
    froe_visibility *v = k->v;
    const froe_visibility_options *o = k->options;
    const uint32_t object = v->tree->pieces[piece].object, patch = v->surface->patch_of[object];
    if (patch == FROE_NONE) return FROE_OK;
    const int facing = view_facing(&v->sights, object);
    if (!facing || (o->cull_back && facing < 0)) return FROE_OK;
    if (!view_beam_of(&v->sights, piece, &k->ring)) return FROE_E_MEMORY;
    if (!k->ring.count) return FROE_OK;
    const bool opaque = !o->clear || !o->clear[patch];
    froe_status status = view_screen_look(&k->screen, k->ring.data, (uint32_t)k->ring.count, opaque);
    if (!status && k->screen.seen.count) status = look_at_edges(k, piece);
    if (!status && o->crossings && (k->screen.seen.count || o->hidden_crossings))
        status = view_look_at_crossings(&k->crosser, piece, &k->ring);
    k->now = (view_piece){.patch = patch, .object = object, .piece = piece, .place = place};
    if (!status) status = keep_pieces(k);
    return status || !opaque ? status : view_screen_cover(&k->screen, object);
}

static froe_status look_at_all(visibility_search *k) {
    froe_visibility *v = k->v;
    view_order order;
    uint32_t piece, place = 0;
    froe_status status = view_order_begin(&order, v->tree, &v->sights.eye, true, k->ranks);
    order.section = v->section;
    const bool all = k->options->crossings && k->options->hidden_crossings;
    while (!status && (k->screen.open || all) && view_order_next(&order, &piece)) {
        status = look_at(k, piece, place++);
        if (place % 1024 == 0 && !base_progress(&k->task, 0.9 * place / v->tree->piece_count))
            status = FROE_E_CANCELLED;
    }
    num_stats_add(&v->sights.context.stats, &order.context.stats);
    const froe_status end = view_order_end(&order);
    v->report.pieces = place;
    return status ? status : end;
}

/* -------------------------------------------------------------------- finishing -- */

/* Pieces by patch, in their order. */
static froe_status sort_pieces(visibility_search *k) {
    froe_visibility *v = k->v;
    const uint32_t patches = v->surface->patch_count, n = (uint32_t)k->pieces.count;
    uint32_t *starts = support_calloc(&v->alloc, (size_t)patches + 1, sizeof *starts);
    v->patch_starts = starts;
    v->piece_count = n;
    v->pieces = support_calloc(&v->alloc, (size_t)n + 1, sizeof *v->pieces);
    if (!starts || !v->pieces) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < n; i++) starts[k->pieces.data[i].patch + 1]++;
    for (uint32_t p = 0; p < patches; p++) starts[p + 1] += starts[p];
    for (uint32_t i = n; i-- > 0;) v->pieces[--starts[k->pieces.data[i].patch + 1]] = k->pieces.data[i];
    for (uint32_t p = 0; p < patches; p++) starts[p] = starts[p + 1]; /* ends were lowered to the starts */
    starts[patches] = n;
    return FROE_OK;
}

static froe_status look_from_eye(visibility_search *k, const geom_eye *eye) {
    froe_visibility *v = k->v;
    const double *window = k->options->window;
    const uint32_t corners = window ? (uint32_t)k->options->window_corners : 0;
    froe_status status = view_sightlines_new(&v->sights, v->tree, v->surface, eye, window, corners, &v->alloc);
    if (!status) status = view_screen_new(&k->screen, &v->sights);
    k->crosser = (view_crosser){.sights = &v->sights,
                                .screen = &k->screen,
                                .section = v->section != 0,
                                .hidden = k->options->hidden_crossings,
                                .cull_back = k->options->cull_back};
    if (!status) status = view_rank_objects(&v->alloc, v->surface, k->options->priorities, &k->ranks);
    if (!status && v->surface->patch_count) status = look_at_all(k);
    if (!status && !k->options->faces_only) status = view_look_at_wires(v, &k->screen, &k->task, &k->stretches);
    /* Polygons seen edge-on show where the section cuts them, if nothing can be in front of that. */
    const bool along = !status && v->section && k->options->crossings &&
                       view_side_of_eye(&v->sights.context, v->tree, 0, &v->sights.eye) == -v->section;
    for (uint32_t o = 0; along && o < v->surface->scene->object_count && !status; o++)
        if (v->surface->patch_of[o] != FROE_NONE && !view_facing(&v->sights, o)) status = view_look_along_section(v, o);
    v->report.screen_nodes = k->screen.nodes.count;
    view_screen_free(&k->screen);
    if (!status) status = sort_pieces(k);
    array_free(&v->alloc, &k->pieces);
    if (!status) status = view_join_intervals(v, &k->stretches);
    array_free(&v->alloc, &k->stretches);
    if (!status && k->options->crossings) status = view_look_between_patches(v, &k->crosser);
    if (!status) status = view_join_crossings(v, &k->crosser);
    if (!status) v->report.lines = v->sights.lines.count;
    if (!status) status = view_keep_lines(v);
    if (!status) view_tally(v, k->options->cull_back);
    if (!status) {
        froe_predicate_stats *predicates = &v->report.predicates;
        v->report.visible_pieces = v->piece_count;
        v->report.intervals = v->interval_count;
        *predicates = v->sights.context.stats;
        predicates->calls = predicates->by_id + predicates->filtered + predicates->refined + predicates->exact;
    }
    array_free(&v->alloc, &k->ring);
    view_crosser_free(&k->crosser);
    support_free(&v->alloc, k->ranks, ((size_t)v->surface->scene->object_count + 1) * sizeof *k->ranks);
    return status;
}

/* ---------------------------------------------------------------------- calling -- */

froe_status view_check_surface(const froe_tree *tree, const froe_surface *surface, froe_diagnostic *diag) {
    if (surface->scene == tree->scene) return FROE_OK;
    return support_fail(diag, FROE_E_ARG, "The surface is not of the tree's scene.");
}

static froe_status check_visibility_options(const froe_tree *tree, const froe_surface *surface,
                                            const froe_visibility_options *o, froe_diagnostic *diag) {
    if (!tree || !surface) return support_fail_null(diag, "froe_visibility_new");
    if (!o || o->size != sizeof *o) return support_fail_defaults(diag, "froe_visibility_defaults");
    froe_status status = view_check_surface(tree, surface, diag);
    if (!status) status = tree_settle(tree, diag);
    if (status) return status;
    if (o->section < -1 || o->section > 1)
        return support_fail(diag, FROE_E_OPTIONS, "A section is -1, 0 or 1, not %d.", o->section);
    if (o->section && tree_is_leaf(tree->nodes))
        return support_fail(diag, FROE_E_OPTIONS, "A tree of a single leaf has no cut to be its section.");
    if (o->window && (o->window_corners < 3 || o->window_corners > FROE_WINDOW_MOST))
        return support_fail(diag, FROE_E_OPTIONS, "A window has 3 to %d corners, not %zu.", FROE_WINDOW_MOST,
                            o->window_corners);
    for (size_t i = 0; o->window && i < 3 * o->window_corners; i++)
        if (!isfinite(o->window[i]))
            return support_fail_at(diag, FROE_E_OPTIONS, FROE_NONE, (uint32_t)(i / 3), (uint32_t)(i % 3),
                                   "Corner %zu of the window is not a finite point.", i / 3);
    if (surface->scene->object_count >= INT32_MAX)
        return support_fail(diag, FROE_E_LIMIT, "The scene has more than 2^31 - 2 objects.");
    return view_order_check(tree, true, diag);
}

froe_status froe_visibility_new(const froe_tree *tree, const froe_surface *surface,
                                const froe_visibility_options *options, froe_visibility **out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    geom_eye eye;
    if (!out) return support_fail_null(diag, __func__);
    froe_status status = check_visibility_options(tree, surface, options, diag);
    if (!status) status = view_eye_of(tree, &options->eye, &eye, diag);
    if (status) return status;
    const froe_allocator alloc = support_allocator(options->alloc);
    froe_visibility *v = support_calloc(&alloc, 1, sizeof *v);
    if (!v) return support_fail_memory(diag);
    v->alloc = alloc;
    v->tree = tree;
    v->surface = surface;
    v->section = options->section;
    v->points_seen = support_calloc(&alloc, (size_t)surface->point_count + 1, 1);
    visibility_search k = {.v = v, .options = options};
    base_task_init(&k.task, 1, options->progress, options->user);
    status = v->points_seen ? look_from_eye(&k, &eye) : FROE_E_MEMORY;
    if (!status) {
        *out = v;
        return FROE_OK;
    }
    froe_visibility_free(v);
    switch (status) {
    case FROE_E_MEMORY:
        return support_fail_memory(diag);
    case FROE_E_INPUT:
        return support_fail(diag, status, "The window, as the eye sees it, is not strictly convex.");
    case FROE_E_CANCELLED:
        return support_fail_cancelled(diag);
    default:
        return support_fail(diag, status, "More than 2^31 lines, corners or intervals are visible.");
    }
}

void froe_visibility_free(froe_visibility *v) {
    if (!v) return;
    const froe_allocator alloc = v->alloc;
    view_drop_pieces(v);
    if (v->sights.surface) view_sightlines_free(&v->sights);
    support_free(&alloc, v->patch_starts, ((size_t)v->surface->patch_count + 1) * sizeof *v->patch_starts);
    view_drop_intervals(v);
    array_free(&alloc, &v->crossings);
    array_free(&alloc, &v->crossing_runs);
    support_free(&alloc, v->points_seen, (size_t)v->surface->point_count + 1);
    support_free(&alloc, v, sizeof *v);
}

/* --------------------------------------------------------------------- reading -- */

size_t froe_visibility_piece_count(const froe_visibility *v) {
    return v->piece_count;
}

froe_visible froe_visibility_piece(const froe_visibility *v, size_t i) {
    if (i >= v->piece_count) return (froe_visible){.patch = FROE_NONE, .object = FROE_NONE};
    const view_piece *p = v->pieces + i;
    return (froe_visible){p->patch, p->object, p->piece, p->place, p->count};
}

size_t froe_visibility_of_patch(const froe_visibility *v, uint32_t patch, size_t *first) {
    const bool there = patch < v->surface->patch_count;
    *first = there ? v->patch_starts[patch] : 0;
    return there ? v->patch_starts[patch + 1] - v->patch_starts[patch] : 0;
}

size_t froe_visibility_corners(const froe_visibility *v, size_t i, double *coords, size_t capacity) {
    BASE_FLOATS_OWN;
    if (i >= v->piece_count) return 0;
    const view_piece *p = v->pieces + i;
    const geom_plane plane = view_plane_of(&v->sights, p->patch);
    for (uint32_t c = 0; c < p->count && c < capacity; c++) {
        double ray[3];
        view_ray_at(v, view_turn_at(v, p, c), ray);
        view_point_on(&v->sights, &plane, ray, coords + 3 * (size_t)c);
    }
    return p->count;
}

const froe_interval *froe_visibility_of_edge(const froe_visibility *v, uint32_t edge, size_t *count) {
    const bool there = edge < v->surface->edge_count;
    *count = there ? v->edge_starts[edge + 1] - v->edge_starts[edge] : 0;
    return v->intervals + (there ? v->edge_starts[edge] : 0);
}

const froe_interval *froe_visibility_of_wire(const froe_visibility *v, uint32_t wire, size_t *count) {
    const bool there = wire < v->surface->wire_count;
    const uint32_t *starts = v->edge_starts + v->surface->edge_count + (there ? wire : 0);
    *count = there ? starts[1] - starts[0] : 0;
    return v->intervals + (there ? starts[0] : 0);
}

bool froe_visibility_of_point(const froe_visibility *v, uint32_t point) {
    return point < v->surface->point_count && v->points_seen[point];
}

const froe_crossing *froe_visibility_crossings(const froe_visibility *v, size_t *count) {
    *count = v->crossings.count;
    return v->crossings.data;
}

froe_visibility_report froe_visibility_statistics(const froe_visibility *v) {
    return v->report;
}
