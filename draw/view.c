/* view.c: window to page, and clipping to the window (Cairo's coordinates have
 * 24 bits before the point: nothing far off the page may reach it). */
#include "view.h"
#include "support/clip.h"
#include <math.h>

void draw_view_place(draw_view *view, double left, double top, double width, double height) {
    const double squeeze = view->space.squeeze;
    double across = squeeze * (view->hi.x - view->lo.x), up = view->hi.y - view->lo.y;
    view->scale = fmin(across > 0 ? width / across : HUGE_VAL, up > 0 ? height / up : HUGE_VAL);
    if (!(view->scale < 1e9)) view->scale = fmin(width, height);
    view->x0 = left + 0.5 * width - view->scale * squeeze * 0.5 * (view->lo.x + view->hi.x);
    view->y0 = top + 0.5 * height + view->scale * 0.5 * (view->lo.y + view->hi.y);
}

draw_point draw_view_map(const draw_view *view, draw_point p) {
    return (draw_point){view->x0 + view->scale * view->space.squeeze * p.x, view->y0 - view->scale * p.y};
}

/* Liang and Barsky's clipping against one side: den * t <= num. */
static bool clip_t(double den, double num, double *t0, double *t1) {
    if (den == 0) return num >= 0;
    double t = num / den;
    if (den < 0 && t > *t0) *t0 = t;
    if (den > 0 && t < *t1) *t1 = t;
    return *t0 <= *t1;
}

bool draw_view_clip_line(const draw_view *view, draw_point *p, draw_point *q) {
    double dx = q->x - p->x, dy = q->y - p->y, t0 = 0, t1 = 1;
    if (!clip_t(-dx, p->x - view->lo.x, &t0, &t1) || !clip_t(dx, view->hi.x - p->x, &t0, &t1) ||
        !clip_t(-dy, p->y - view->lo.y, &t0, &t1) || !clip_t(dy, view->hi.y - p->y, &t0, &t1))
        return false;
    draw_point from = *p;
    if (t1 < 1) *q = (draw_point){from.x + t1 * dx, from.y + t1 * dy};
    if (t0 > 0) *p = (draw_point){from.x + t0 * dx, from.y + t0 * dy};
    return true;
}

size_t draw_clip_half(const draw_point *ring, size_t count, draw_point n, double c, double side, draw_point *out) {
    size_t made = 0;
    for (size_t i = 0; i < count; i++) {
        draw_point p = ring[i], q = ring[i + 1 < count ? i + 1 : 0];
        double d = side * (n.x * p.x + n.y * p.y - c), e = side * (n.x * q.x + n.y * q.y - c);
        const support_clipped left = support_clip_edge(d, e);
        if (left.corner) out[made++] = p;
        if (left.meeting) out[made++] = (draw_point){p.x + left.share * (q.x - p.x), p.y + left.share * (q.y - p.y)};
    }
    return made;
}

size_t draw_view_clip_ring(const draw_view *view, draw_point *ring, draw_point *spare, size_t count) {
    count = draw_clip_half(ring, count, (draw_point){1, 0}, view->lo.x, 1, spare);
    count = draw_clip_half(spare, count, (draw_point){1, 0}, view->hi.x, -1, ring);
    count = draw_clip_half(ring, count, (draw_point){0, 1}, view->lo.y, 1, spare);
    return draw_clip_half(spare, count, (draw_point){0, 1}, view->hi.y, -1, ring);
}

/* A page of more dots than that shows what other pages would not. */
#define MOST_DOTS 0x1p30

bool draw_dots_new(const froe_allocator *alloc, double left, double top, double width, double height, double detail,
                   draw_dots *out) {
    draw_dots dots = {.alloc = *alloc, .left = left, .top = top, .detail = detail};
    if (detail > 0 && width / detail * (height / detail) < MOST_DOTS) {
        dots.across = (size_t)(width / detail) + 1;
        dots.down = (size_t)(height / detail) + 1;
        dots.bits = support_calloc(alloc, dots.across * dots.down / 8 + 1, 1);
        if (!dots.bits) return false;
    }
    *out = dots;
    return true;
}

void draw_dots_free(draw_dots *dots) {
    if (dots->bits) support_free(&dots->alloc, dots->bits, dots->across * dots->down / 8 + 1);
    dots->bits = NULL;
}

bool draw_dots_taken(draw_dots *dots, draw_point lo, draw_point hi) {
    if (!dots->bits || hi.x - lo.x >= dots->detail || hi.y - lo.y >= dots->detail) return false;
    double x = (0.5 * (lo.x + hi.x) - dots->left) / dots->detail, y = (0.5 * (lo.y + hi.y) - dots->top) / dots->detail;
    if (!(x >= 0 && y >= 0 && x < (double)dots->across && y < (double)dots->down)) return false;
    size_t bit = (size_t)y * dots->across + (size_t)x;
    bool taken = dots->bits[bit / 8] >> (bit % 8) & 1;
    dots->bits[bit / 8] |= (unsigned char)(1u << (bit % 8));
    return taken;
}
