/* parts.c: nodes, and the parts that they paint on the page. */
#include "view/picture/parts.h"
#include "base/radix.h"
#include "view/grid.h"

froe_status view_parts_new(view_parts *p, const froe_visibility *v, const froe_projection *view, uint32_t *places,
                           bool cull_back) {
    const uint32_t patches = v->surface->patch_count;
    *p = (view_parts){.v = v, .view = view, .places = places, .clear = places != NULL, .cull_back = cull_back};
    p->press = (print_press){.alloc = v->alloc, .view = view};
    p->plane_of = FROE_NONE;
    p->split = support_calloc(&v->alloc, (size_t)patches + 1, 1);
    p->node_of_patch = support_calloc(&v->alloc, (size_t)patches + 1, sizeof *p->node_of_patch);
    p->node_of = support_calloc(&v->alloc, (size_t)v->piece_count + 1, sizeof *p->node_of);
    return p->split && p->node_of_patch && p->node_of ? FROE_OK : FROE_E_MEMORY;
}

void view_parts_free(view_parts *p) {
    if (!p->v) return;
    const froe_allocator *alloc = &p->v->alloc;
    support_free(alloc, p->split, (size_t)p->v->surface->patch_count + 1);
    support_free(alloc, p->node_of_patch, ((size_t)p->v->surface->patch_count + 1) * sizeof *p->node_of_patch);
    support_free(alloc, p->node_of, ((size_t)p->v->piece_count + 1) * sizeof *p->node_of);
    array_free(alloc, &p->nodes);
    array_free(alloc, &p->tour);
    array_free(alloc, &p->ring);
    print_free(&p->press);
    view_parts_drop(p);
}

void view_parts_drop(view_parts *p) {
    array_free(&p->v->alloc, &p->parts);
    array_free(&p->v->alloc, &p->kinds);
    array_free(&p->v->alloc, &p->points);
}

/* ----------------------------------------------------------------------- prints -- */

/* Adds the point of a plane that is seen along a ray. */
static bool add_point_on(view_parts *p, const geom_plane *plane, const double ray[3]) {
    double x[3];
    if (p->view->eye.parallel) {
        view_point_on(&p->v->sights, plane, ray, x);
        return print_add(&p->press, x);
    }
    view_way_on(&p->v->sights, plane, ray, x);
    return print_add_way(&p->press, x);
}

bool view_print_visible(view_parts *p, uint32_t visible, print_ring *out) {
    const view_piece *piece = p->v->pieces + visible;
    bool cut, ok = true;
    if (p->plane_of != piece->patch) p->plane = view_plane_of(&p->v->sights, p->plane_of = piece->patch);
    print_begin(&p->press);
    for (uint32_t i = 0; ok && i < piece->count; i++) {
        double ray[3];
        view_ray_at(p->v, view_turn_at(p->v, piece, i), ray);
        ok = add_point_on(p, &p->plane, ray);
    }
    return ok && print_end(&p->press, out, &cut);
}

bool view_print_piece(view_parts *p, view_sightlines *sights, uint32_t piece, print_ring *out) {
    const geom_plane plane = view_plane_of(&p->v->sights, p->v->surface->patch_of[p->v->tree->pieces[piece].object]);
    bool cut, ok = view_beam_of(sights, piece, &p->ring);
    print_begin(&p->press);
    for (size_t i = 0; ok && i < p->ring.count; i++) ok = add_point_on(p, &plane, p->ring.data[i].ray.x);
    return ok && print_end(&p->press, out, &cut);
}

/* ------------------------------------------------------------------------ parts -- */

static bool add_part(view_parts *p, view_sightlines *sights, uint32_t node, int kind, uint32_t source, uint32_t place) {
    const froe_allocator *alloc = &p->v->alloc;
    paint_part part = {.node = node, .place = place, .source = source, .first = (uint32_t)p->points.count};
    bool cut, ok = true;
    if (kind == PART_OBJECT) {
        const froe_scene *s = p->v->tree->scene;
        const uint32_t n = scene_corners(s, source);
        const bool front = view_facing(sights, source) > 0;
        print_begin(&p->press);
        for (uint32_t i = 0; ok && i < n; i++) ok = print_add(&p->press, scene_point(s, source, front ? i : n - 1 - i));
        ok = ok && print_end(&p->press, &p->points, &cut);
    } else {
        ok = kind == PART_PIECE ? view_print_piece(p, sights, source, &p->points)
                                : view_print_visible(p, source, &p->points);
    }
    part.count = (uint32_t)p->points.count - part.first;
    if (!ok) return false;
    if (part.count < 3) { /* away from the page */
        p->points.count = part.first;
        return true;
    }
    return array_push(alloc, &p->parts, part) && array_push(alloc, &p->kinds, (uint8_t)kind);
}

static bool is_drawn(const view_parts *p, view_sightlines *sights, uint32_t object) {
    const int facing = view_facing(sights, object);
    return facing > 0 || (facing < 0 && !p->cull_back);
}

static bool make_tour(view_parts *p) {
    const froe_allocator *alloc = &p->v->alloc;
    const size_t n = p->nodes.count;
    base_pair *pairs = support_calloc(alloc, 2 * n + 1, sizeof *pairs);
    print_ring ring = {0};
    p->tour.count = 0;
    bool ok = pairs && array_reserve(alloc, &p->tour, n);
    for (uint32_t i = 0; ok && i < n; i++) {
        ring.count = 0;
        ok = view_print_visible(p, p->nodes.data[i].first, &ring);
        pairs[i] = (base_pair){view_grid_place(p->view, ok && ring.count ? ring.data[0] : (print_point){0, 0}), i};
    }
    if (ok) base_radix_sort(pairs, pairs + n, n);
    for (size_t i = 0; ok && i < n; i++) p->tour.data[p->tour.count++] = pairs[i].value;
    support_free(alloc, pairs, (2 * n + 1) * sizeof *pairs);
    array_free(alloc, &ring);
    return ok;
}

froe_status view_parts_make(view_parts *p, view_sightlines *sights) {
    const froe_visibility *v = p->v;
    const froe_surface *s = v->surface;
    const froe_tree *t = v->tree;
    p->nodes.count = p->parts.count = p->kinds.count = p->points.count = 0;
    for (uint32_t patch = 0; patch < s->patch_count; patch++) {
        p->node_of_patch[patch] = FROE_NONE;
        if (v->patch_starts[patch] == v->patch_starts[patch + 1]) continue;
        /* One node for a patch; or one for each piece of it with a visible part. */
        const bool pieces = p->split[patch] == PARTS_PIECES;
        p->node_of_patch[patch] = (uint32_t)p->nodes.count;
        if (!pieces && !array_push(&v->alloc, &p->nodes, (paint_node){patch, FROE_NONE, v->patch_starts[patch]}))
            return FROE_E_MEMORY;
        for (uint32_t i = v->patch_starts[patch]; i < v->patch_starts[patch + 1]; i++) {
            const bool next = pieces && (i == v->patch_starts[patch] || v->pieces[i].piece != v->pieces[i - 1].piece);
            if (next && !array_push(&v->alloc, &p->nodes, (paint_node){patch, v->pieces[i].piece, i}))
                return FROE_E_MEMORY;
            p->node_of[i] = (uint32_t)p->nodes.count - 1;
        }
        for (uint32_t i = v->patch_starts[patch]; p->split[patch] && i < v->patch_starts[patch + 1]; i++)
            if (!add_part(p, sights, p->node_of[i], PART_VISIBLE, i, v->pieces[i].place)) return FROE_E_MEMORY;
        for (uint32_t m = s->patch_starts[patch]; !p->clear && !p->split[patch] && m < s->patch_starts[patch + 1]; m++)
            if (is_drawn(p, sights, s->members[m]) &&
                !add_part(p, sights, p->node_of_patch[patch], PART_OBJECT, s->members[m], 0))
                return FROE_E_MEMORY;
    }
    for (uint32_t i = 0; p->clear && i < t->piece_count; i++) { /* all pieces of the tree that whole patches paint */
        const uint32_t object = t->pieces[i].object, patch = s->patch_of[object];
        if (patch == FROE_NONE || p->node_of_patch[patch] == FROE_NONE || p->split[patch]) continue;
        if (is_drawn(p, sights, object) && !add_part(p, sights, p->node_of_patch[patch], PART_PIECE, i, p->places[i]))
            return FROE_E_MEMORY;
    }
    return make_tour(p) ? FROE_OK : FROE_E_MEMORY;
}

/* ------------------------------------------------------------------------ threads -- */

view_parts view_parts_fork(const view_parts *parts) {
    view_parts out = *parts;
    out.press = (print_press){.alloc = parts->v->alloc, .view = parts->view};
    out.ring = (view_ring){0};
    return out;
}

void view_parts_close(view_parts *p) {
    if (!p->v) return;
    array_free(&p->v->alloc, &p->ring);
    print_free(&p->press);
}
