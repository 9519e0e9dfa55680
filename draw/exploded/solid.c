/* solid.c: exploded views: opaque pieces in transparent cells.
 *
 * Items are listed from front to back. Of those smaller than a dot the nearest in each
 * dot is kept, then all are painted from back to front. */
#include "exploded/solid.h"
#include "paint.h"
#include "palette.h"
#include <math.h>
#include <stdlib.h>

#define PLASTER_DARK 0x9C8F7Eu
#define PLASTER_LIGHT 0xFBF6EBu

/* ---------------------------------------------------------------- planning -- */

froe_status draw_solid_plan(draw_picture *picture) {
    draw_page *page = &picture->page;
    const froe_scene *scene = froe_tree_scene(page->tree);
    draw_solid *solid = support_calloc(&page->alloc, 1, sizeof *solid);
    if (!solid) return FROE_E_MEMORY;
    picture->solid = solid;
    solid->picture = picture;
    solid->camera = draw_camera_from(&picture->space, page->options->view);
    solid->view.space = picture->space;
    solid->shaper = (draw_shaper){.alloc = page->alloc, .tree = page->tree, .scene = scene, .view = &solid->view};
    solid->node_count = (size_t)froe_tree_report(page->tree).nodes;
    solid->object_count = froe_scene_object_count(scene);
    solid->part_of = support_calloc(&page->alloc, solid->node_count, sizeof *solid->part_of);
    solid->wall_of = support_calloc(&page->alloc, solid->node_count, sizeof *solid->wall_of);
    solid->met = support_calloc(&page->alloc, solid->object_count, sizeof *solid->met);
    froe_status status = solid->part_of && solid->wall_of && solid->met ? draw_solid_parts(solid) : FROE_E_MEMORY;
    if (status == FROE_OK) status = draw_solid_items(solid);
    double across = solid->hi.x - solid->lo.x, up = solid->hi.y - solid->lo.y;
    draw_page_plan(page, across > 0 ? fmin(up / across, 4) : 1, 0, 0);
    return status;
}

void draw_picture_free(draw_picture *picture) {
    draw_solid *solid = picture->solid;
    const froe_allocator *alloc = &picture->page.alloc;
    if (!solid) return;
    array_free(alloc, &solid->parts);
    array_free(alloc, &solid->face_ends);
    array_free(alloc, &solid->walls);
    array_free(alloc, &solid->corners);
    array_free(alloc, &solid->items);
    array_free(alloc, &solid->points);
    array_free(alloc, &solid->cut);
    support_free(alloc, solid->part_of, solid->node_count * sizeof *solid->part_of);
    support_free(alloc, solid->wall_of, solid->node_count * sizeof *solid->wall_of);
    support_free(alloc, solid->met, solid->object_count * sizeof *solid->met);
    draw_shaper_free(&solid->shaper);
    support_free(alloc, solid, sizeof *solid);
    picture->solid = NULL;
}

/* ---------------------------------------------------------------- painting -- */

typedef struct solid_painter {
    const draw_solid *solid;
    const draw_page *page;
    cairo_t *cr;
    draw_view view;
    double weight; /* of the edges of pieces */
    bool glass;    /* contents are seen through the cells */
} solid_painter;

static draw_point at(const solid_painter *pen, const draw_item *item, size_t i) {
    return draw_view_map(&pen->view, pen->solid->points.data[item->first + i]);
}

static void area_path(const solid_painter *pen, const draw_item *item) {
    for (size_t i = 0; i < item->count; i++) {
        draw_point p = at(pen, item, i);
        cairo_line_to(pen->cr, p.x, p.y);
    }
    cairo_close_path(pen->cr);
}

/* The edges whose mark is `cut`. */
static bool edge_path(const solid_painter *pen, const draw_item *item, bool cut) {
    bool any = false;
    for (size_t i = 0; i < item->count; i++) {
        if (pen->solid->cut.data[item->first + i] != cut) continue;
        draw_point p = at(pen, item, i), q = at(pen, item, i + 1 < item->count ? i + 1 : 0);
        cairo_move_to(pen->cr, p.x, p.y);
        cairo_line_to(pen->cr, q.x, q.y);
        any = true;
    }
    return any;
}

static void ink_edges(const solid_painter *pen) {
    draw_set_color(pen->cr, DRAW_INK, 0.75);
    cairo_set_line_width(pen->cr, pen->weight);
    cairo_stroke(pen->cr);
}

static void paint_piece(const solid_painter *pen, const draw_item *item) {
    cairo_t *cr = pen->cr;
    bool fragments = pen->solid->picture->show & FROE_DRAW_FRAGMENTS;
    uint32_t color = draw_mix(PLASTER_DARK, PLASTER_LIGHT, item->shade);
    if (fragments && item->odd) color = draw_mix(color, DRAW_WOOD, 0.28);
    area_path(pen, item);
    draw_set_color(cr, color, 1);
    cairo_fill_preserve(cr);
    bool cut = false;
    for (size_t i = 0; i < item->count; i++) cut = cut || pen->solid->cut.data[item->first + i];
    if (!cut) {
        ink_edges(pen);
        return;
    }
    /* Its own colour closes the seams to other pieces of the object. */
    cairo_set_line_width(cr, 0.4 * pen->page->unit);
    cairo_stroke(cr);
    cairo_set_line_width(cr, pen->weight);
    draw_set_color(cr, DRAW_ACCENT, 0.8);
    if (fragments && edge_path(pen, item, true)) cairo_stroke(cr);
    if (edge_path(pen, item, false)) ink_edges(pen);
}

static void paint_thin(const solid_painter *pen, const draw_item *item) {
    cairo_t *cr = pen->cr;
    draw_point p = at(pen, item, 0);
    double r = item->radius > 0 ? item->radius * pen->view.scale : 1.2 * pen->page->unit;
    draw_set_color(cr, item->odd ? DRAW_ACCENT : DRAW_INK, 1);
    if (item->count == 2) {
        draw_point q = at(pen, item, 1);
        cairo_move_to(cr, p.x, p.y);
        cairo_line_to(cr, q.x, q.y);
        cairo_set_line_width(cr, fmax(1.1 * pen->page->unit, pen->weight));
        cairo_stroke(cr);
        return;
    }
    draw_circle(cr, p, r);
    if (item->radius > 0) {
        draw_set_color(cr, draw_mix(PLASTER_DARK, PLASTER_LIGHT, item->shade), 1);
        cairo_fill_preserve(cr);
        draw_set_color(cr, DRAW_INK, 0.75);
        cairo_set_line_width(cr, pen->weight);
        cairo_stroke(cr);
    } else
        cairo_fill(cr);
}

static void paint_face(const solid_painter *pen, const draw_item *item) {
    cairo_t *cr = pen->cr;
    const draw_solid *solid = pen->solid;
    uint32_t tone = draw_tone(draw_tone_of(solid->parts.data[item->part].depth, solid->lo_depth, solid->hi_depth));
    bool back = item->matter == DRAW_BACK;
    if (back && !pen->glass) return;
    area_path(pen, item);
    if (pen->glass)
        draw_set_color(cr, tone, back ? 0.35 : 0.14);
    else
        draw_set_color(cr, draw_mix(draw_mix(tone, DRAW_INK, 0.35), tone, 0.2 + 0.8 * item->shade), 1);
    cairo_fill_preserve(cr);
    draw_set_color(cr, draw_mix(tone, DRAW_LINE, 0.6), back ? 0.45 : 0.9);
    cairo_set_line_width(cr, (back ? 0.4 : 0.6) * pen->page->unit);
    cairo_stroke(cr);
}

/* Drops what lies behind something tiny in the same dot; front to back. */
static bool thin_out(solid_painter *pen, draw_item *items, size_t *count) {
    draw_dots dots;
    const draw_page *page = pen->page;
    if (!draw_dots_new(&page->alloc, 0, 0, page->width, page->height, page->options->detail, &dots)) return false;
    size_t kept = 0;
    for (size_t i = 0; i < *count; i++) {
        draw_point lo = at(pen, items + i, 0), hi = lo;
        for (size_t k = 1; k < items[i].count; k++) {
            draw_point p = at(pen, items + i, k);
            lo = (draw_point){fmin(lo.x, p.x), fmin(lo.y, p.y)};
            hi = (draw_point){fmax(hi.x, p.x), fmax(hi.y, p.y)};
        }
        hi.x += 2 * items[i].radius * pen->view.scale;
        if (!draw_dots_taken(&dots, lo, hi)) items[kept++] = items[i];
    }
    *count = kept;
    draw_dots_free(&dots);
    return true;
}

froe_status draw_solid_paint(draw_picture *picture, cairo_t *cr) {
    draw_solid *solid = picture->solid;
    const draw_page *page = &picture->page;
    solid_painter pen = {.solid = solid, .page = page, .cr = cr};
    pen.view = (draw_view){.space.squeeze = 1, .lo = solid->lo, .hi = solid->hi};
    draw_view_place(&pen.view, page->left, page->top, page->inner_width, page->inner_height);
    pen.glass = picture->show & (FROE_DRAW_FRAGMENTS | FROE_DRAW_OBJECTS);
    if (!thin_out(&pen, solid->items.data, &solid->items.count)) return FROE_E_MEMORY;
    const double each = sqrt(page->inner_width * page->inner_height / (double)(solid->items.count + 1));
    pen.weight = fmin(fmax(0.03 * each, 0.12 * page->unit), 0.6 * page->unit);
    draw_page_open(page, cr);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
    for (size_t i = solid->items.count; i-- > 0;) {
        const draw_item *item = solid->items.data + i;
        if (item->matter == DRAW_WALL) {
            double fade = fmin(item->depth / 8.0, 1);
            area_path(&pen, item);
            draw_set_color(cr, DRAW_ACCENT, 0.07);
            cairo_fill_preserve(cr);
            draw_set_color(cr, DRAW_ACCENT, 0.8 - 0.4 * fade);
            cairo_set_line_width(cr, (0.9 - 0.5 * fade) * page->unit);
            cairo_stroke(cr);
        } else
            (item->matter != DRAW_PIECE ? paint_face : item->count < 3 ? paint_thin : paint_piece)(&pen, item);
    }
    draw_legend legend = {.scale_of_depths = picture->show & FROE_DRAW_CELLS,
                          .lo_depth = floor(solid->lo_depth),
                          .hi_depth = ceil(solid->hi_depth),
                          .parts = true,
                          .merged = solid->parts.count,
                          .merged_leaves = solid->leaves};
    draw_page_close(page, cr, &legend);
    return FROE_OK;
}
