/* areas.c: features of maps as areas. A feature is a run of segments of one group. Where each chain of them comes back
 * to its beginning, the chains are rings, and what lies within an odd number of them is the feature. */
#include "map/map.h"
#include "palette.h"
#include <math.h>

typedef ARRAY(draw_point) ring_points;

typedef struct area_painter {
    const draw_page *page;
    cairo_t *cr;
    const draw_view *view;
    const froe_scene *scene;
    ring_points ring, spare;
} area_painter;

/* One past the last object of the feature that begins with `first`; *closed: it is made of rings. */
static uint32_t end_of_feature(const froe_scene *scene, uint32_t first, bool *closed) {
    const uint32_t count = (uint32_t)froe_scene_object_count(scene), group = froe_scene_object(scene, first).group;
    uint32_t start = froe_scene_corner(scene, first, 0), at = start, i = first;
    *closed = true;
    for (; i < count; i++) {
        const froe_object o = froe_scene_object(scene, i);
        if (o.group != group || o.form != FROE_SEGMENT) break;
        const uint32_t from = froe_scene_corner(scene, i, 0);
        if (from != at) {
            *closed = *closed && at == start;
            start = from;
        }
        at = froe_scene_corner(scene, i, 1);
    }
    *closed = *closed && at == start;
    return i;
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

static bool area_path(area_painter *pen, uint32_t first, uint32_t end) {
    uint32_t at = FROE_NONE;
    pen->ring.count = 0;
    for (uint32_t i = first; i < end; i++) {
        const uint32_t from = froe_scene_corner(pen->scene, i, 0);
        double p[3];
        if (from != at && !ring_path(pen)) return false;
        if (from != at) pen->ring.count = 0;
        at = froe_scene_corner(pen->scene, i, 1);
        draw_space_point(&pen->view->space, froe_scene_vertex(pen->scene, from), p);
        const draw_point corner = {p[pen->view->across], p[pen->view->up]};
        if (!array_push(&pen->page->alloc, &pen->ring, corner)) return false;
    }
    return ring_path(pen);
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
        end = end_of_feature(pen.scene, first, &closed);
        if (!closed) continue;
        cairo_new_path(cr);
        ok = area_path(&pen, first, end);
        draw_set_color(cr, DRAW_LAND, 0.8);
        cairo_fill(cr);
    }
    cairo_set_fill_rule(cr, CAIRO_FILL_RULE_WINDING);
    array_free(&page->alloc, &pen.ring);
    array_free(&page->alloc, &pen.spare);
    return !ok ? FROE_E_MEMORY : page->task->cancelled ? FROE_E_CANCELLED : FROE_OK;
}
