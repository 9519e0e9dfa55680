/* marks.c: marked places: boxes, balls, points and lines, and labels beside them. */
#include "lettering.h"
#include "map/map.h"
#include "palette.h"
#include <math.h>
#include <string.h>

typedef struct label_box {
    double left, top, right, bottom;
} label_box;

typedef struct mark_painter {
    const draw_page *page;
    cairo_t *cr;
    const draw_view *view;
    ARRAY(label_box) taken; /* by labels and points */
} mark_painter;

enum { MOST_LABELS = 2000 }; /* that mind each other */

static bool is_free(const mark_painter *pen, const label_box *b) {
    const size_t count = pen->taken.count < MOST_LABELS ? pen->taken.count : MOST_LABELS;
    for (size_t i = 0; i < count; i++) {
        const label_box *t = pen->taken.data + i;
        if (b->left < t->right && t->left < b->right && b->top < t->bottom && t->top < b->bottom) return false;
    }
    return true;
}

static bool is_on_page(const mark_painter *pen, const label_box *b) {
    return b->left > 0 && b->right < pen->page->width && b->top > 0 && b->bottom < pen->page->height;
}

/* A label of this length right of a point, left of it, above or below. */
enum { PLACES = 4 };
static label_box place_label(double text, double length, draw_point p, int place) {
    static const struct {
        double x, y, align;
    } places[PLACES] = {{0.7, 0.3, 0}, {-0.7, 0.3, 1}, {0, -0.7, 0.5}, {0, 1.35, 0.5}};
    const double left = p.x + places[place].x * text - places[place].align * length;
    const double base = p.y + places[place].y * text;
    return (label_box){left, base - 0.8 * text, left + length, base + 0.25 * text};
}

/* In the first place that is free, or else the first on the page, or else right of the point. */
static bool mark_label(mark_painter *pen, const char *label, draw_point p) {
    const double text = pen->page->text, length = draw_text_length(pen->cr, label, text);
    label_box box = place_label(text, length, p, 0);
    bool whole = false, found = false;
    for (int i = 0; i < PLACES && !found; i++) {
        const label_box here = place_label(text, length, p, i);
        if (!is_on_page(pen, &here)) continue;
        found = is_free(pen, &here);
        if (found || !whole) box = here;
        whole = true;
    }
    draw_text_backed(pen->cr, label, box.left, box.bottom - 0.25 * text, text, DRAW_PAPER, DRAW_INK);
    return array_push(&pen->page->alloc, &pen->taken, box);
}

static bool is_labelled(const froe_draw_mark *mark) {
    return mark->label && *mark->label;
}

static bool is_within(const draw_view *view, draw_point p) {
    return p.x >= view->lo.x && p.x <= view->hi.x && p.y >= view->lo.y && p.y <= view->hi.y;
}

static void mark_dot(const mark_painter *pen, draw_point p, double radius) {
    cairo_new_path(pen->cr);
    draw_circle(pen->cr, p, radius * pen->page->unit);
    draw_set_color(pen->cr, DRAW_ACCENT, 1);
    cairo_fill_preserve(pen->cr);
    draw_set_color(pen->cr, DRAW_PAPER, 1);
    cairo_set_line_width(pen->cr, 0.3 * radius * pen->page->unit);
    cairo_stroke(pen->cr);
}

/* A box, or the ball within it, as the section leaves it. */
static void mark_solid(const mark_painter *pen, const froe_draw_mark *mark) {
    const draw_view *view = pen->view;
    double centre[3] = {0}, half[3] = {0};
    for (int k = 0; k < view->space.dim; k++) {
        const int from = view->space.from[k];
        const double a = draw_space_map(&view->space, k, mark->lo[from]);
        const double b = draw_space_map(&view->space, k, mark->hi[from]);
        centre[k] = 0.5 * (a + b), half[k] = 0.5 * fabs(b - a);
    }
    const double off = view->axis < 0 ? 0 : fabs(view->at - centre[view->axis]);
    /* What a section at `away` of half the height of a mark leaves of its half sides. */
    const double away = off > 0 ? off / half[view->axis] : 0;
    const double share = away > 1 ? 0 : mark->kind == FROE_DRAW_MARK_BALL ? sqrt(1 - away * away) : 1;
    if (!(share > 0)) return;
    const draw_point p = draw_view_map(view, (draw_point){centre[view->across] - share * half[view->across],
                                                          centre[view->up] - share * half[view->up]});
    const draw_point q = draw_view_map(view, (draw_point){centre[view->across] + share * half[view->across],
                                                          centre[view->up] + share * half[view->up]});
    cairo_new_path(pen->cr);
    const double radius = 0.5 * (q.x - p.x); /* along x */
    if (mark->kind == FROE_DRAW_MARK_BALL)
        draw_ellipse(pen->cr, (draw_point){0.5 * (p.x + q.x), 0.5 * (p.y + q.y)},
                     (draw_point){radius, radius / view->space.squeeze});
    else
        cairo_rectangle(pen->cr, p.x, q.y, q.x - p.x, p.y - q.y);
    draw_set_color(pen->cr, DRAW_ACCENT, 0.12);
    cairo_fill_preserve(pen->cr);
    draw_set_color(pen->cr, DRAW_ACCENT, 1);
    cairo_set_line_width(pen->cr, 2 * pen->page->unit);
    cairo_stroke(pen->cr);
}

/* A line from lo to hi, with a dot at its end; a dot alone where both are the same. In a section only what lies in it,
 * by a millionth of the picture. */
static bool mark_line(mark_painter *pen, const froe_draw_mark *mark) {
    const draw_view *view = pen->view;
    double a[3], b[3];
    draw_space_point(&view->space, mark->lo, a);
    draw_space_point(&view->space, mark->hi, b);
    if (view->axis >= 0 && fmax(fabs(a[view->axis] - view->at), fabs(b[view->axis] - view->at)) > 1e-6) return true;
    draw_point from = {a[view->across], a[view->up]}, to = {b[view->across], b[view->up]};
    const draw_point end = to;
    const bool line = from.x != to.x || from.y != to.y;
    if (line && draw_view_clip_line(view, &from, &to)) {
        const draw_point p = draw_view_map(view, from), q = draw_view_map(view, to);
        cairo_new_path(pen->cr);
        cairo_move_to(pen->cr, p.x, p.y);
        cairo_line_to(pen->cr, q.x, q.y);
        draw_set_color(pen->cr, DRAW_ACCENT, 0.75);
        cairo_set_line_width(pen->cr, 1.2 * pen->page->unit);
        cairo_stroke(pen->cr);
    }
    if (!is_within(view, end)) return true;
    const draw_point p = draw_view_map(view, end);
    const double radius = (line ? 3.2 : 4.8) * pen->page->unit;
    mark_dot(pen, p, line ? 3.2 : 4.8);
    const label_box box = {p.x - radius, p.y - radius, p.x + radius, p.y + radius};
    return !is_labelled(mark) || array_push(&pen->page->alloc, &pen->taken, box);
}

static bool is_same_point(const double a[3], const double b[3]) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Does the mark belong to a line whose label another mark has, which `last` is? Borders are many marks. */
static bool continues_label(const froe_draw_mark *last, const froe_draw_mark *mark) {
    return last && last->kind == FROE_DRAW_MARK_LINE && mark->kind == FROE_DRAW_MARK_LINE &&
           !is_same_point(mark->lo, mark->hi) && strcmp(last->label, mark->label) == 0;
}

/* Over all marks. */
static bool mark_labels(mark_painter *pen) {
    const draw_view *view = pen->view;
    const froe_draw_options *o = pen->page->options;
    const froe_draw_mark *last = NULL;
    bool ok = true;
    for (size_t i = 0; i < o->mark_count && ok; i++) {
        const froe_draw_mark *m = o->marks + i;
        if (!is_labelled(m) || continues_label(last, m)) continue;
        double end[3];
        draw_space_point(&view->space, m->hi, end);
        const draw_point p = {end[view->across], end[view->up]};
        if (!is_within(view, p)) continue;
        ok = mark_label(pen, m->label, draw_view_map(view, p));
        last = m;
    }
    return ok;
}

/* Answers repeat the box or the ball that was asked for, with a name each. */
static bool is_same_place(const froe_draw_mark *m, const froe_draw_mark *n) {
    return m->kind == n->kind && is_same_point(m->lo, n->lo) && is_same_point(m->hi, n->hi);
}

froe_status draw_map_marks(const draw_page *page, cairo_t *cr, const draw_view *view) {
    mark_painter pen = {.page = page, .cr = cr, .view = view};
    const froe_draw_options *o = page->options;
    bool ok = true;
    const draw_point corner = draw_view_map(view, view->lo), other = draw_view_map(view, view->hi);
    cairo_save(cr);
    cairo_rectangle(cr, corner.x, other.y, other.x - corner.x, corner.y - other.y);
    cairo_clip(cr);
    for (size_t i = 0; i < o->mark_count && ok; i++) {
        if (o->marks[i].kind == FROE_DRAW_MARK_LINE)
            ok = mark_line(&pen, o->marks + i);
        else if (!i || !is_same_place(o->marks + i - 1, o->marks + i))
            mark_solid(&pen, o->marks + i);
    }
    cairo_restore(cr);
    if (ok && view->axis < 0) ok = mark_labels(&pen);
    array_free(&page->alloc, &pen.taken);
    return ok ? FROE_OK : FROE_E_MEMORY;
}
