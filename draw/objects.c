/* objects.c: objects in ink; of those that were cut every second piece in the accent
 * colour, with a tick across each end that a cut made. */
#include "paint.h"
#include "palette.h"
#include <math.h>
#include <stdlib.h>

enum { PATH = 512 };

enum { WHOLE, CUT, CUT_UNSEEN };

typedef struct stroke {
    draw_point p, q; /* p before q: left to right, bottom to top */
    uint32_t object;
    bool cut, odd; /* cut: p is an end that a cut made */
} stroke;

typedef struct object_painter {
    const draw_page *page;
    cairo_t *cr;
    const draw_view *view;
    draw_shaper shaper;
    draw_dots dots;
    double weight;
    size_t object_count;
    uint8_t *cut; /* by object: WHOLE, or only pieces are shown; NULL: objects are shown whole */
    ARRAY(stroke) ink, parts;
    ARRAY(draw_point) points;
} object_painter;

static stroke directed(const draw_shape *shape, uint32_t object) {
    draw_point p = shape->points[0], q = shape->points[1];
    bool turn = q.x < p.x || (q.x == p.x && q.y > p.y);
    return turn ? (stroke){q, p, object, shape->cut[1], false} : (stroke){p, q, object, shape->cut[0], false};
}

/* Areas are washed and outlined at once, under all strokes. Nothing is taken that spans no more than a dot whose place
 * is taken. */
static bool take_object(object_painter *pen, const draw_shape *shape, uint32_t object, bool whole) {
    cairo_t *cr = pen->cr;
    if (shape->sort == DRAW_NOTHING) return true;
    draw_point lo = shape->points[0], hi = lo;
    for (size_t i = 1; i < shape->count; i++) {
        draw_point p = shape->points[i];
        lo = (draw_point){fmin(lo.x, p.x), fmin(lo.y, p.y)};
        hi = (draw_point){fmax(hi.x, p.x), fmax(hi.y, p.y)};
    }
    hi.x += 2 * fmax(shape->half.x, shape->half.y);
    if (draw_dots_taken(&pen->dots, lo, hi)) return true;
    if (shape->sort == DRAW_DOT) return array_push(&pen->page->alloc, &pen->points, shape->points[0]);
    if (shape->sort == DRAW_STROKE)
        return whole ? array_push(&pen->page->alloc, &pen->ink, directed(shape, object))
                     : array_push(&pen->page->alloc, &pen->parts, directed(shape, object));
    if (shape->sort == DRAW_DISC)
        draw_ellipse(cr, shape->points[0], shape->half);
    else
        for (size_t i = 0; i < shape->count; i++) cairo_line_to(cr, shape->points[i].x, shape->points[i].y);
    cairo_close_path(cr);
    draw_set_color(cr, DRAW_INK, 0.07);
    cairo_fill_preserve(cr);
    draw_set_color(cr, DRAW_INK, 1);
    cairo_set_line_width(cr, 0.8 * pen->weight);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_MITER);
    cairo_stroke(cr);
    return true;
}

/* Whole objects and, if pieces are wanted, those of the objects that were cut. */
static bool gather_shapes(object_painter *pen, bool pieces) {
    const draw_page *page = pen->page;
    const froe_tree *tree = pen->shaper.tree;
    const size_t count = pieces ? froe_tree_piece_count(tree) : 0;
    draw_shape shape;
    if (!draw_dots_new(&page->alloc, 0, 0, page->width, page->height, pen->view->detail, &pen->dots)) return false;
    if (pieces) pen->cut = support_calloc(&page->alloc, pen->object_count, sizeof *pen->cut);
    if (pieces && !pen->cut) return false;
    for (size_t i = 0; i < count; i++) {
        froe_piece piece = froe_tree_piece(tree, i);
        if (!piece.whole) pen->cut[piece.object] = CUT;
    }
    for (size_t i = 0; i < pen->object_count && draw_tick(page->task); i++) {
        if (!draw_shape_of_object(&pen->shaper, (uint32_t)i, &shape)) return false;
        if (!pen->cut || pen->cut[i] == WHOLE) {
            if (!take_object(pen, &shape, (uint32_t)i, true)) return false;
        } else if (shape.sort == DRAW_NOTHING)
            pen->cut[i] = CUT_UNSEEN; /* so are its pieces, whose corners cost exact arithmetic */
    }
    for (size_t i = 0; i < count && draw_tick(page->task); i++) {
        froe_piece piece = froe_tree_piece(tree, i);
        if (piece.whole || pen->cut[piece.object] == CUT_UNSEEN) continue;
        if (!draw_shape_of_piece(&pen->shaper, i, &shape) || !take_object(pen, &shape, piece.object, false))
            return false;
    }
    return true;
}

static int along_object(const void *a, const void *b) {
    const stroke *s = a, *t = b;
    if (s->object != t->object) return s->object < t->object ? -1 : 1;
    if (s->p.x != t->p.x) return s->p.x < t->p.x ? -1 : 1;
    if (s->p.y != t->p.y) return s->p.y > t->p.y ? -1 : 1;
    if (s->q.x != t->q.x) return s->q.x < t->q.x ? -1 : 1;
    return (s->q.y < t->q.y) - (s->q.y > t->q.y);
}

static void paint_strokes(cairo_t *cr, const stroke *strokes, size_t count, bool odd) {
    size_t held = 0;
    for (size_t i = 0; i < count; i++) {
        if (strokes[i].odd != odd) continue;
        cairo_move_to(cr, strokes[i].p.x, strokes[i].p.y);
        cairo_line_to(cr, strokes[i].q.x, strokes[i].q.y);
        if (++held % PATH == 0) cairo_stroke(cr);
    }
    cairo_stroke(cr);
}

/* Width of strokes by their number: a few hundred are bold, a million are fine. */
static double weight_of(const draw_page *page, double count) {
    const double each = sqrt(page->inner_width * page->inner_height / (count + 1));
    return fmin(fmax(0.1 * each, 0.4 * page->unit), 1.8 * page->unit);
}

static void paint_gathered(object_painter *pen) {
    cairo_t *cr = pen->cr;
    stroke *parts = pen->parts.data;
    pen->weight = weight_of(pen->page, (double)(pen->ink.count + pen->parts.count + pen->points.count));
    const double reach = 2.4 * pen->page->unit;
    size_t held = 0;
    /* Along each object, every second part is odd. */
    if (pen->parts.count) qsort(parts, pen->parts.count, sizeof *parts, along_object);
    for (size_t i = 1; i < pen->parts.count; i++)
        parts[i].odd = parts[i].object == parts[i - 1].object && !parts[i - 1].odd;
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_width(cr, pen->weight);
    draw_set_color(cr, DRAW_INK, 1);
    paint_strokes(cr, pen->ink.data, pen->ink.count, false);
    for (size_t i = 0; i < pen->points.count; i++) {
        draw_circle(cr, pen->points.data[i], 1.1 * pen->weight);
        if ((i + 1) % PATH == 0) cairo_fill(cr);
    }
    cairo_fill(cr);
    paint_strokes(cr, parts, pen->parts.count, false);
    draw_set_color(cr, DRAW_ACCENT, 1);
    paint_strokes(cr, parts, pen->parts.count, true);
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
    cairo_set_line_width(cr, fmax(0.6 * pen->weight, 0.5 * pen->page->unit));
    draw_set_color(cr, DRAW_INK, 1);
    /* Ticks, where there is room for one. */
    for (size_t i = 0; i < pen->parts.count; i++) {
        const stroke *s = parts + i;
        double dx = s->q.x - s->p.x, dy = s->q.y - s->p.y, length = sqrt(dx * dx + dy * dy);
        if (!s->cut || length < 2 * reach) continue;
        dx *= reach / length, dy *= reach / length;
        cairo_move_to(cr, s->p.x - dy, s->p.y + dx);
        cairo_line_to(cr, s->p.x + dy, s->p.y - dx);
        if (++held % PATH == 0) cairo_stroke(cr);
    }
    cairo_stroke(cr);
}

/* The objects that the options single out, over all others. */
static bool paint_accented(object_painter *pen) {
    const froe_draw_options *o = pen->page->options;
    cairo_t *cr = pen->cr;
    draw_shape shape;
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_width(cr, fmax(1.6 * pen->weight, 2 * pen->page->unit));
    for (size_t i = 0; i < o->accented_count; i++) {
        if (o->accented[i] >= pen->object_count) continue;
        if (!draw_shape_of_object(&pen->shaper, o->accented[i], &shape)) return false;
        if (shape.sort == DRAW_NOTHING) continue;
        cairo_new_path(cr);
        if (shape.sort == DRAW_DISC) draw_ellipse(cr, shape.points[0], shape.half);
        if (shape.sort == DRAW_DOT) draw_circle(cr, shape.points[0], 2.4 * pen->page->unit);
        for (size_t k = 0; shape.sort != DRAW_DISC && shape.sort != DRAW_DOT && k < shape.count; k++)
            cairo_line_to(cr, shape.points[k].x, shape.points[k].y);
        if (shape.sort == DRAW_RING) cairo_close_path(cr);
        draw_set_color(cr, DRAW_ACCENT, shape.sort == DRAW_DOT ? 1 : 0.2);
        if (shape.sort != DRAW_STROKE) cairo_fill_preserve(cr);
        draw_set_color(cr, DRAW_ACCENT, 1);
        cairo_stroke(cr);
    }
    return true;
}

froe_status draw_paint_objects(const draw_page *page, cairo_t *cr, const draw_view *view, uint32_t show) {
    if (!(show & (FROE_DRAW_OBJECTS | FROE_DRAW_FRAGMENTS))) return FROE_OK;
    const froe_scene *scene = froe_tree_scene(page->tree);
    object_painter pen = {.page = page, .cr = cr, .view = view};
    pen.shaper = (draw_shaper){.alloc = page->alloc, .tree = page->tree, .scene = scene, .view = view};
    pen.object_count = froe_scene_object_count(scene);
    /* Of a scene in space a section meets about the power 2/3. */
    const double count = (double)pen.object_count;
    pen.weight = weight_of(page, view->axis < 0 ? count : cbrt(count * count));
    bool ok = gather_shapes(&pen, show & FROE_DRAW_FRAGMENTS);
    if (ok && !page->task->cancelled) paint_gathered(&pen);
    if (ok && !page->task->cancelled) ok = paint_accented(&pen);
    draw_dots_free(&pen.dots);
    support_free(&page->alloc, pen.cut, pen.object_count * sizeof *pen.cut);
    array_free(&page->alloc, &pen.ink);
    array_free(&page->alloc, &pen.parts);
    array_free(&page->alloc, &pen.points);
    draw_shaper_free(&pen.shaper);
    return !ok ? FROE_E_MEMORY : page->task->cancelled ? FROE_E_CANCELLED : FROE_OK;
}
