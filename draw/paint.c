/* paint.c: cells in tones, cuts as hairlines. Equal ones go into common paths: a
 * picture of a million cells has a few hundred paths. */
#include "paint.h"
#include "palette.h"
#include <math.h>
#include <string.h>

enum { PATH = 512 }; /* most rings or lines in one path: Cairo's sweeps are not linear */

/* Cells by tone, a counting sort. */
static froe_status paint_cells(const draw_page *page, cairo_t *cr, const draw_partition *part) {
    size_t starts[DRAW_TONES + 1] = {0}, next[DRAW_TONES];
    uint32_t *order = support_calloc(&part->alloc, part->cells.count, sizeof *order);
    if (!order) return FROE_E_MEMORY;
    for (size_t i = 0; i < part->cells.count; i++)
        starts[draw_tone_of(part->cells.data[i].depth, part->lo_depth, part->hi_depth) + 1]++;
    for (int t = 0; t < DRAW_TONES; t++) starts[t + 1] += starts[t];
    memcpy(next, starts, sizeof next);
    for (size_t i = 0; i < part->cells.count; i++)
        order[next[draw_tone_of(part->cells.data[i].depth, part->lo_depth, part->hi_depth)]++] = (uint32_t)i;
    for (int tone = 0; tone < DRAW_TONES; tone++)
        for (size_t i = starts[tone]; i < starts[tone + 1]; i++) {
            const draw_cell *cell = part->cells.data + order[i];
            const draw_point *p = part->points.data + cell->first;
            cairo_move_to(cr, p[0].x, p[0].y);
            for (size_t k = 1; k < cell->count; k++) cairo_line_to(cr, p[k].x, p[k].y);
            cairo_close_path(cr);
            if (i + 1 != starts[tone + 1] && (i + 1 - starts[tone]) % PATH != 0) continue;
            /* A thin line of the same colour around each cell closes the seams that antialiasing leaves. */
            draw_set_color(cr, draw_cell_color(page, tone), 1);
            cairo_set_line_width(cr, 0.35 * page->unit);
            cairo_set_line_join(cr, CAIRO_LINE_JOIN_BEVEL);
            cairo_fill_preserve(cr);
            cairo_stroke(cr);
        }
    support_free(&part->alloc, order, part->cells.count * sizeof *order);
    return FROE_OK;
}

/* Cuts are heavy near the root; from class DEEP on they are hairlines. Cuts of
 * regions of a few dots would only darken the picture: they fade out by size. */
enum { DEEP = 11, FADES = 4, CLASSES = DEEP + FADES, GONE = CLASSES };

static void paint_cuts(const draw_page *page, cairo_t *cr, const draw_partition *part) {
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
    for (int class = CLASSES; class -- > 0;) {
        size_t held = 0;
        const double deep = class < DEEP ? (double)class / DEEP : 1,
                     faint = class > DEEP ? (double)(class - DEEP) / FADES : 0;
        draw_set_color(cr, DRAW_LINE, (1 - 0.45 * deep) * (1 - faint) * (1 - page->faint));
        cairo_set_line_width(cr, (1.25 - 0.95 * sqrt(deep)) * page->unit);
        for (size_t i = 0; i < part->cuts.count; i++) {
            const draw_cut *cut = part->cuts.data + i;
            const double size = cut->size / (2.5 * page->unit);
            const int own = size < 1       ? GONE
                            : size < FADES ? CLASSES - (int)size
                                           : (int)(cut->depth < DEEP ? cut->depth : DEEP);
            if (own != class) continue;
            cairo_move_to(cr, cut->p.x, cut->p.y);
            cairo_line_to(cr, cut->q.x, cut->q.y);
            if (++held % PATH == 0) cairo_stroke(cr);
        }
        cairo_stroke(cr);
    }
}

froe_status draw_paint_partition(const draw_page *page, cairo_t *cr, const draw_partition *partition, uint32_t show) {
    froe_status status = show & FROE_DRAW_CELLS ? paint_cells(page, cr, partition) : FROE_OK;
    if (status == FROE_OK && show & FROE_DRAW_CUTS) paint_cuts(page, cr, partition);
    return status;
}
