/* print.c: cutting and projecting. */
#include "view/print.h"
#include "support/axes.h"
#include "support/clip.h"
#include <math.h>

void print_free(print_press *press) {
    for (int i = 0; i < 2; i++) array_free(&press->alloc, &press->at[i]);
}

static bool put_on_page(print_press *p, int which, double x, double y, double z) {
    if (!array_reserve(&p->alloc, &p->at[which], 3)) return false;
    double *out = p->at[which].data + p->at[which].count;
    out[0] = x, out[1] = y, out[2] = z;
    p->at[which].count += 3;
    return true;
}

bool print_add(print_press *press, const double *point) {
    double at[3];
    view_camera_point(press->view, point, at);
    return put_on_page(press, 0, at[0], at[1], at[2]);
}

/* Five half-spaces n . p + c >= 0: before the eye, and inside each side of the page, enlarged by `beyond` of its size.
 */
static void side_of_view(const froe_projection *v, int side, double beyond, double n[3], double *c) {
    const bool parallel = v->eye.parallel;
    const double reach = beyond * (side < 3 ? v->width : v->height);
    n[0] = n[1] = n[2] = *c = 0;
    if (side == 0) { /* z >= near */
        n[2] = parallel ? 0 : 1;
        *c = parallel ? 1 : -v->near;
        return;
    }
    const int axis = side > 2, sign = side % 2 ? 1 : -1;               /* left, right; bottom, top */
    const double far = axis ? v->height - v->centre[1] : v->centre[0], /* centre to the left or lower side */
        other = axis ? v->centre[1] : v->width - v->centre[0];
    const double limit = (sign > 0 ? far : other) + reach; /* sign * page distance + limit >= 0 */
    n[axis] = sign * v->scale;
    n[2] = parallel ? 0 : limit;
    *c = parallel ? limit : 0;
}

bool print_add_way(print_press *press, const double *way) {
    const froe_projection *v = press->view;
    return put_on_page(press, 0, support_dot(way, v->right), support_dot(way, v->up), -support_dot(way, v->back));
}

bool print_end(print_press *press, print_ring *out, bool *cut) {
    *cut = false;
    for (int side = 0; side < 5; side++) {
        double n[3], c;
        bool needed = false;
        side_of_view(press->view, side, PRINT_BEYOND, n, &c);
        for (size_t i = 0; i < press->at[0].count && !needed; i += 3) {
            const double *a = press->at[0].data + i;
            needed = !(support_dot(n, a) + c >= 0);
        }
        if (!needed) continue;
        *cut = true; /* from at[0] to one half-space into at[1] */
        press->at[1].count = 0;
        for (size_t i = 0, count = press->at[0].count; i < count; i += 3) {
            const double *a = press->at[0].data + i, *b = press->at[0].data + (i + 3 < count ? i + 3 : 0);
            const double at_a = support_dot(n, a) + c, at_b = support_dot(n, b) + c;
            if (at_a >= 0 && !put_on_page(press, 1, a[0], a[1], a[2])) return false;
            if ((at_a >= 0) == (at_b >= 0)) continue;
            const double t = at_a / (at_a - at_b);
            if (!put_on_page(press, 1, a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])))
                return false;
        }
        const __typeof__(press->at[0]) swap = press->at[0];
        press->at[0] = press->at[1];
        press->at[1] = swap;
    }
    const size_t count = press->at[0].count / 3;
    if (!array_reserve(&press->alloc, out, count)) return false;
    for (size_t i = 0; i < count; i++) {
        double page[2];
        view_camera_page(press->view, press->at[0].data + 3 * i, page);
        out->data[out->count++] = (print_point){page[0], page[1]};
    }
    return true;
}

bool print_clip_segment(const froe_projection *view, const double *from, const double *to, double beyond,
                        double share[2]) {
    double a[3], b[3], n[3], c;
    view_camera_point(view, from, a);
    view_camera_point(view, to, b);
    for (int side = 0; side < 5; side++) {
        side_of_view(view, side, beyond, n, &c);
        const double at_a = support_dot(n, a) + c, at_b = support_dot(n, b) + c;
        if (!support_clip_shares(at_a, at_b, share)) return false;
    }
    return share[0] < share[1];
}

double print_share(const froe_projection *view, const double *from, const double *to, double t) {
    double a[3], b[3];
    if (view->eye.parallel || t == 0 || t == 1) return t;
    view_camera_point(view, from, a);
    view_camera_point(view, to, b);
    return t * a[2] / (t * a[2] + (1 - t) * b[2]); /* 1 / depth is linear on the page */
}

double print_area(const print_point *p, size_t count) {
    double area = 0;
    for (size_t i = 0; i < count; i++) {
        const print_point a = p[i], b = p[i + 1 < count ? i + 1 : 0];
        area -= (a.x - p[0].x) * (b.y - p[0].y) - (b.x - p[0].x) * (a.y - p[0].y); /* y points down */
    }
    return area;
}

/* How far a ring reaches to the left of u v, times its length: at least (sign -1) or at most (sign 1). */
static double reach(const print_point *ring, size_t count, print_point u, print_point v, int sign) {
    double most = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        const double at = sign * ((v.y - u.y) * (ring[i].x - u.x) - (v.x - u.x) * (ring[i].y - u.y));
        most = at > most ? at : most;
    }
    return sign * most;
}

/* Is all of `b` beyond a side of `a`, up to `margin`? Where corners all but coincide the side between them may have any
 * direction, so that `a` itself has to be seen on the other side of it. */
static bool separated(const print_point *a, size_t a_count, const print_point *b, size_t b_count, double margin) {
    for (size_t i = 0; i < a_count; i++) {
        const print_point u = a[i], v = a[i + 1 < a_count ? i + 1 : 0];
        const double length = sqrt((v.x - u.x) * (v.x - u.x) + (v.y - u.y) * (v.y - u.y)),
                     most = reach(b, b_count, u, v, 1);
        if (length > 0 && most <= margin * length && most - reach(a, a_count, u, v, -1) <= margin * length) return true;
    }
    return false;
}

bool print_overlap(const print_point *a, size_t a_count, const print_point *b, size_t b_count, double margin) {
    return !separated(a, a_count, b, b_count, margin) && !separated(b, b_count, a, a_count, margin);
}
