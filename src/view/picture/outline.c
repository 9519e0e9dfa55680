/* outline.c: borders of patches are the edges that their polygons do not share. */
#include "view/picture/outline.h"
#include <math.h>
#include <string.h>

froe_status view_outliner_new(view_outliner *o, view_sightlines *sights, const froe_projection *view, bool cull_back) {
    const size_t n = (size_t)sights->tree->scene->vertex_count + 1;
    *o = (view_outliner){.alloc = sights->alloc, .sights = sights, .view = view, .cull_back = cull_back};
    o->press = (print_press){.alloc = sights->alloc, .view = view};
    o->first_side = support_calloc(&o->alloc, n, sizeof *o->first_side);
    if (!o->first_side) return FROE_E_MEMORY;
    memset(o->first_side, 0xff, n * sizeof *o->first_side);
    return FROE_OK;
}

void view_outliner_free(view_outliner *o) {
    if (!o->sights) return;
    support_free(&o->alloc, o->first_side, ((size_t)o->sights->tree->scene->vertex_count + 1) * sizeof *o->first_side);
    array_free(&o->alloc, &o->sides);
    array_free(&o->alloc, &o->starts);
    array_free(&o->alloc, &o->ring);
    array_free(&o->alloc, &o->detours);
    print_free(&o->press);
}

/* ------------------------------------------------------------------------ sides -- */

static bool is_drawn(const view_outliner *o, uint32_t object) {
    const int facing = view_facing(o->sights, object);
    return facing > 0 || (facing < 0 && !o->cull_back);
}

/* ----------------------------------------------------------------------- points -- */

static print_point page_of(const view_outliner *o, uint32_t vertex) {
    print_point p = {0, 0};
    double page[2];
    if (froe_project(o->view, view_vertex(o->sights, vertex), page)) p = (print_point){page[0], page[1]};
    return p;
}

/* The corner of a polygon farthest from ab, on the other side of it than the patch, which is on its left. */
static bool apex(const view_outliner *o, uint32_t object, print_point a, print_point b, print_point *c,
                 double *height) {
    const froe_scene *scene = o->sights->surface->scene;
    const double dx = b.x - a.x, dy = b.y - a.y, length = sqrt(dx * dx + dy * dy);
    *height = 0;
    for (uint32_t i = 0; i < scene_corners(scene, object); i++) {
        double at[3], page[2];
        view_camera_point(o->view, scene_point(scene, object, i), at);
        if (!o->view->eye.parallel && !(at[2] > o->view->near)) return false;
        view_camera_page(o->view, at, page);
        const double right = dx * (page[1] - a.y) - dy * (page[0] - a.x); /* y points down */
        if (right > *height * length) {
            *height = right / length;
            *c = (print_point){page[0], page[1]};
        }
    }
    return *height > 1e-6 * o->underlap;
}

/* From a and b towards c, which is `height` away from ab, as far as the width of the underlap; or just c. */
static outline_detour detour_by(const view_outliner *o, print_point a, print_point b, print_point c, double height) {
    const double t = height > o->underlap ? o->underlap / height : 1;
    if (t > 0.99) return (outline_detour){1, {c}};
    return (outline_detour){
        2, {{a.x + t * (c.x - a.x), a.y + t * (c.y - a.y)}, {b.x + t * (c.x - b.x), b.y + t * (c.y - b.y)}}};
}

static bool find_detour(view_outliner *o, uint32_t patch, uint32_t side, outline_detour *out) {
    const outline_side *s = o->sides.data + side;
    const froe_surface *surface = o->sights->surface;
    const uint32_t *use = surface->uses + surface->edge_starts[s->edge];
    uint32_t object = FROE_NONE; /* the polygon across the side into which the patch may be extended */
    if (o->underlap > 0 && o->runs && surface->edge_starts[s->edge + 1] - surface->edge_starts[s->edge] == 2) {
        const uint32_t other = surface->patch_of[use[0]] == patch ? use[1] : use[0], far = surface->patch_of[other];
        const bool later = far != patch && o->runs[far] != FROE_NONE && o->runs[far] > o->runs[patch];
        if (later && is_drawn(o, other)) object = other;
    }
    const print_point a = page_of(o, o->starts.data[side]), b = page_of(o, s->to);
    print_point c;
    double height;
    bool beside, hidden;
    out->count = 0;
    if (object != FROE_NONE && apex(o, object, a, b, &c, &height)) {
        *out = detour_by(o, a, b, c, height);
        return true;
    }
    if (!o->seams) return true;
    if (!view_seams_look(o->seams, o->node, a, b, &beside)) return false;
    if (beside || !apex(o, s->object, b, a, &c, &height)) return true;
    /* The side is drawn short where the patch is hidden and what hides it ends at the same side; see seams.h. */
    const outline_detour d = detour_by(o, a, b, c, height);
    const print_point ring[4] = {a, b, d.at[d.count - 1], d.at[0]};
    bool ends = false;
    if (!view_seams_hidden(o->seams, o->node, ring, 2 + d.count, &hidden)) return false;
    if (hidden && !view_seams_end(o->seams, o->node, a, b, &ends)) return false;
    if (ends) *out = d;
    return true;
}

/* ------------------------------------------------------------------------ rings -- */

/* Appends the ring: with its detours, or cut where a vertex is out of sight or too far away. */
static bool put_ring(view_outliner *o, uint32_t patch, print_ring *points, print_ends *ends) {
    const size_t first = points->count, n = o->ring.count;
    bool cut, beside;
    print_begin(&o->press);
    for (size_t i = 0; i < n; i++)
        if (!print_add(&o->press, view_vertex(o->sights, o->starts.data[o->ring.data[i]]))) return false;
    if (!print_end(&o->press, points, &cut)) return false;
    const print_point *at = points->data + first;
    for (size_t i = 0, m = points->count - first; cut && o->seams && i < m; i++) /* strips along what is left */
        if (!view_seams_look(o->seams, o->node, at[i], at[i + 1 < m ? i + 1 : 0], &beside)) return false;
    if (!cut) {
        points->count = first;
        o->detours.count = 0;
        if (!array_reserve(&o->alloc, &o->detours, n) || !array_reserve(&o->alloc, points, 3 * n)) return false;
        for (size_t i = 0; i < n; i++)
            if (!find_detour(o, patch, o->ring.data[i], &o->detours.data[i])) return false;
    }
    for (size_t i = 0; i < n && !cut; i++) {
        const size_t j = i ? i - 1 : n - 1;
        const uint32_t side = o->ring.data[i], before = o->ring.data[j], a = o->starts.data[side];
        const outline_detour *d = o->detours.data + i;
        if (!d->count && !o->detours.data[j].count) { /* goes the border straight on? Exactly, in space */
            const uint32_t vertices[3] = {o->starts.data[before], a, o->sides.data[side].to};
            const double *p[3];
            for (int k = 0; k < 3; k++) p[k] = view_vertex(o->sights, vertices[k]);
            const geom_plane plane = geom_plane_points(3, p);
            if (!geom_plane_valid(&o->sights->context, &plane)) continue;
        }
        points->data[points->count++] = page_of(o, a);
        for (uint32_t k = 0; k < d->count; k++) points->data[points->count++] = d->at[k];
    }
    if (points->count - first < 3) {
        points->count = first;
        return true;
    }
    return array_push(&o->alloc, ends, (uint32_t)points->count);
}

bool view_outline(view_outliner *o, uint32_t patch, print_ring *points, print_ends *ends) {
    const froe_surface *s = o->sights->surface;
    const froe_scene *scene = s->scene;
    bool ok = true;
    o->sides.count = o->starts.count = 0;
    for (uint32_t m = s->patch_starts[patch]; ok && m < s->patch_starts[patch + 1]; m++) {
        const uint32_t object = s->members[m], n = scene_corners(scene, object);
        const bool front = view_facing(o->sights, object) > 0;
        if (!is_drawn(o, object)) continue;
        /* Sides as they turn left, but for those that the patch goes on across. */
        for (uint32_t i = 0; ok && i < n; i++) {
            const uint32_t edge = s->edge_of[scene_start(scene, object) + i], *use = s->uses + s->edge_starts[edge];
            const uint32_t a = scene_corner(scene, object, i), b = scene_corner(scene, object, i + 1 < n ? i + 1 : 0);
            const uint32_t from = front ? a : b, to = front ? b : a, side = (uint32_t)o->sides.count;
            if (s->inside[edge] && is_drawn(o, use[0] == object ? use[1] : use[0])) continue;
            ok = array_push(&o->alloc, &o->sides, (outline_side){edge, to, object, o->first_side[from]}) &&
                 array_push(&o->alloc, &o->starts, from);
            if (ok) o->first_side[from] = side;
        }
    }
    for (uint32_t i = 0; ok && i < o->sides.count; i++) {
        o->ring.count = 0;
        for (uint32_t at = o->starts.data[i]; ok && o->first_side[at] != FROE_NONE;) { /* takes a ring off the lists */
            const uint32_t next = o->first_side[at];
            o->first_side[at] = o->sides.data[next].next;
            ok = array_push(&o->alloc, &o->ring, next);
            at = o->sides.data[next].to;
        }
        ok = ok && (o->ring.count < 3 || put_ring(o, patch, points, ends));
    }
    for (size_t i = 0; i < o->starts.count; i++) o->first_side[o->starts.data[i]] = FROE_NONE;
    return ok;
}
