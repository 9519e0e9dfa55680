/* areas.c: features of maps as areas. A feature is a run of segments of one group. Where an even number of them ends at
 * each vertex, they make rings, in whatever order and direction they are, and what lies within an odd number of rings
 * is the feature. */
#include "map/map.h"
#include "palette.h"
#include <math.h>
#include <stdlib.h>

typedef ARRAY(draw_point) ring_points;

typedef struct segment_end {
    uint32_t vertex, segment;
    size_t next;
} segment_end;

typedef struct area_painter {
    const draw_page *page;
    cairo_t *cr;
    const draw_view *view;
    const froe_scene *scene;
    ring_points ring, spare;
    ARRAY(segment_end) ends; /* of the feature, by vertex */
    ARRAY(bool) used;        /* [segment of the feature]: it is in a ring */
} area_painter;

/* One past the last object of the feature that begins with `first`. */
static uint32_t end_of_feature(const froe_scene *scene, uint32_t first) {
    const uint32_t count = (uint32_t)froe_scene_object_count(scene), group = froe_scene_object(scene, first).group;
    uint32_t i = first;
    for (; i < count; i++) {
        const froe_object o = froe_scene_object(scene, i);
        if (o.group != group || o.form != FROE_SEGMENT) break;
    }
    return i;
}

static int by_vertex(const void *a, const void *b) {
    const segment_end *x = a, *y = b;
    if (x->vertex != y->vertex) return x->vertex < y->vertex ? -1 : 1;
    return (x->segment > y->segment) - (x->segment < y->segment);
}

/* Gathers the ends of the feature's segments, those at one vertex behind each other. False without memory. */
static bool gather_ends(area_painter *pen, uint32_t first, uint32_t end, bool *closed) {
    pen->ends.count = pen->used.count = 0;
    for (uint32_t i = first; i < end; i++) {
        for (uint32_t k = 0; k < 2; k++) {
            const segment_end e = {froe_scene_corner(pen->scene, i, k), i - first, 0};
            if (!array_push(&pen->page->alloc, &pen->ends, e)) return false;
        }
        if (!array_push(&pen->page->alloc, &pen->used, false)) return false;
    }
    segment_end *ends = pen->ends.data;
    qsort(ends, pen->ends.count, sizeof *ends, by_vertex);
    *closed = true;
    for (size_t i = 0, from = 0; i < pen->ends.count; i++) {
        if (ends[i].vertex != ends[from].vertex) from = i;
        const bool last = i + 1 == pen->ends.count || ends[i + 1].vertex != ends[i].vertex;
        *closed = *closed && (!last || (i + 1 - from) % 2 == 0);
    }
    return true;
}

/* A segment at the vertex that no ring has yet, FROE_NONE: there is none. The first end at a vertex keeps in `next` how
 * many of its segments are known to be in rings. */
static uint32_t unused_at(area_painter *pen, uint32_t vertex) {
    const segment_end key = {vertex, 0, 0};
    segment_end *ends = pen->ends.data;
    size_t low = 0, high = pen->ends.count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (by_vertex(&ends[middle], &key) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    for (size_t *i = &ends[low].next; low + *i < pen->ends.count && ends[low + *i].vertex == vertex; ++*i)
        if (!pen->used.data[ends[low + *i].segment]) return ends[low + *i].segment;
    return FROE_NONE;
}

/* The part of the ring in the window as a path (Sutherland and Hodgman 1974: a ring that leaves the window and comes
 * back runs along its edge, where it encloses nothing). */
static bool ring_path(area_painter *pen) {
    const size_t room = 16 * pen->ring.count + 16; /* each of four clips may double the corners */
    if (pen->ring.count < 3) return true;
    if (!array_reserve(&pen->page->alloc, &pen->ring, room) || !array_reserve(&pen->page->alloc, &pen->spare, room))
        return false;
    const size_t left = draw_view_clip_ring(pen->view, pen->ring.data, pen->spare.data, pen->ring.count);
    draw_point last = {0, 0};
    for (size_t i = 0; i < left; i++) {
        const draw_point p = draw_view_map(pen->view, pen->ring.data[i]);
        if (i && fabs(p.x - last.x) < 0.3 * pen->page->unit && fabs(p.y - last.y) < 0.3 * pen->page->unit) continue;
        if (i)
            cairo_line_to(pen->cr, p.x, p.y);
        else
            cairo_move_to(pen->cr, p.x, p.y);
        last = p;
    }
    if (left) cairo_close_path(pen->cr);
    return true;
}

static bool add_corner(area_painter *pen, uint32_t vertex) {
    double p[3];
    draw_space_point(&pen->view->space, froe_scene_vertex(pen->scene, vertex), p);
    const draw_point corner = {p[pen->view->across], p[pen->view->up]};
    return array_push(&pen->page->alloc, &pen->ring, corner);
}

/* Follows segments from end to end until they come back: each vertex has an even number of them, so they do. */
static bool area_path(area_painter *pen, uint32_t first, uint32_t end) {
    for (uint32_t i = 0; i < end - first; i++) {
        if (pen->used.data[i]) continue;
        const uint32_t start = froe_scene_corner(pen->scene, first + i, 0);
        uint32_t at = start, segment = i;
        pen->ring.count = 0;
        do {
            pen->used.data[segment] = true;
            if (!add_corner(pen, at)) return false;
            const uint32_t from = froe_scene_corner(pen->scene, first + segment, 0);
            at = from != at ? from : froe_scene_corner(pen->scene, first + segment, 1);
            segment = at == start ? FROE_NONE : unused_at(pen, at);
        } while (segment != FROE_NONE);
        if (!ring_path(pen)) return false;
    }
    return true;
}

froe_status draw_map_areas(const draw_page *page, cairo_t *cr, const draw_view *view) {
    area_painter pen = {.page = page, .cr = cr, .view = view, .scene = froe_tree_scene(page->tree)};
    const uint32_t count = (uint32_t)froe_scene_object_count(pen.scene);
    bool ok = true;
    cairo_set_fill_rule(cr, CAIRO_FILL_RULE_EVEN_ODD);
    for (uint32_t first = 0, end; first < count && ok && draw_tick(page->task); first = end) {
        bool closed = false;
        const froe_object o = froe_scene_object(pen.scene, first);
        end = first + 1;
        if (o.group == FROE_NONE || o.form != FROE_SEGMENT) continue;
        end = end_of_feature(pen.scene, first);
        ok = gather_ends(&pen, first, end, &closed);
        if (!ok || !closed) continue;
        cairo_new_path(cr);
        ok = area_path(&pen, first, end);
        draw_set_color(cr, DRAW_LAND, 0.8);
        cairo_fill(cr);
    }
    cairo_set_fill_rule(cr, CAIRO_FILL_RULE_WINDING);
    array_free(&page->alloc, &pen.ring);
    array_free(&page->alloc, &pen.spare);
    array_free(&page->alloc, &pen.ends);
    array_free(&page->alloc, &pen.used);
    return !ok ? FROE_E_MEMORY : page->task->cancelled ? FROE_E_CANCELLED : FROE_OK;
}
