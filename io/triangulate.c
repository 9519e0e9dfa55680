/* triangulate.c: exact orientation in the plane and ear clipping (Meisters,
 * "Polygons have ears", 1975) for the polygons that cannot stay whole.
 *
 * Every choice is by exact signs. Where exponents leave the range of doubles the
 * sign may be wrong; then the triangles are less fair but still the same number,
 * with the same corners and the same outline. */
#include "triangulate.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Adds x to an expansion of *n nonoverlapping doubles (Shewchuk 1997, GROW-EXPANSION). */
static void grow(double *e, int *n, double x) {
    double q = x;
    for (int i = 0; i < *n; ++i) {
        double sum = q + e[i], tail = sum - q, error = (q - (sum - tail)) + (e[i] - tail);
        e[i] = error;
        q = sum;
    }
    e[(*n)++] = q;
}

static void grow_product(double *e, int *n, double x, double y) {
    double product = x * y;
    grow(e, n, fma(x, y, -product));
    grow(e, n, product);
}

int io_orient(const double *a, const double *b, const double *c) {
    double left = (b[0] - a[0]) * (c[1] - a[1]), right = (b[1] - a[1]) * (c[0] - a[0]);
    double det = left - right, bound = 4e-16 * (fabs(left) + fabs(right)); /* Shewchuk's ccw filter, rounded up */
    if (det > bound) return 1;
    if (-det > bound) return -1;
    double e[12];
    int n = 0;
    grow_product(e, &n, a[0], b[1]);
    grow_product(e, &n, -a[1], b[0]);
    grow_product(e, &n, b[0], c[1]);
    grow_product(e, &n, -b[1], c[0]);
    grow_product(e, &n, c[0], a[1]);
    grow_product(e, &n, -c[1], a[0]);
    for (int i = n - 1; i >= 0; --i)
        if (e[i] != 0) return e[i] > 0 ? 1 : -1;
    return 0;
}

static bool same(const double *a, const double *b) {
    return a[0] == b[0] && a[1] == b[1];
}

int io_ring_side(const double *xy, size_t count) {
    size_t low = 0, before, after;
    for (size_t i = 1; i < count; ++i) {
        const double *p = xy + 2 * i, *q = xy + 2 * low;
        if (p[0] < q[0] || (p[0] == q[0] && p[1] < q[1])) low = i;
    }
    for (before = low; before != (low + 1) % count && same(xy + 2 * before, xy + 2 * low);)
        before = (before + count - 1) % count;
    for (after = low; after != before && same(xy + 2 * after, xy + 2 * low);) after = (after + 1) % count;
    return io_orient(xy + 2 * before, xy + 2 * low, xy + 2 * after);
}

/* ------------------------------------------------------------------ ears -- */

typedef struct outline {
    const double *xy; /* the shadow: 2 doubles per corner, turning left as a whole */
    uint32_t *next, *before;
    uint32_t left; /* corners not clipped yet */
} outline;

static bool in_triangle(const double *p, const double *a, const double *b, const double *c) {
    return io_orient(a, b, p) >= 0 && io_orient(b, c, p) >= 0 && io_orient(c, a, p) >= 0;
}

static bool is_ear(const outline *o, uint32_t b) {
    const double *pa = o->xy + 2 * o->before[b], *pb = o->xy + 2 * b, *pc = o->xy + 2 * o->next[b];
    if (io_orient(pa, pb, pc) <= 0) return false;
    for (uint32_t i = o->next[o->next[b]]; i != o->before[b]; i = o->next[i]) {
        const double *p = o->xy + 2 * i;
        if (!same(p, pa) && !same(p, pb) && !same(p, pc) && in_triangle(p, pa, pb, pc)) return false;
    }
    return true;
}

/* The next ear from `from` on; without one (flat, or not simple) `from` itself. */
static uint32_t find_ear(const outline *o, uint32_t from) {
    uint32_t b = from;
    for (uint32_t tried = 0; tried < o->left; ++tried, b = o->next[b])
        if (is_ear(o, b)) return b;
    return from;
}

static bool clip_all(const froe_allocator *alloc, outline *o, io_buffer *triangles) {
    uint32_t at = 1 % o->left; /* the fan of a convex polygon starts at its corner 0 */
    while (o->left >= 3) {
        uint32_t b = find_ear(o, at), triangle[3] = {o->before[b], b, o->next[b]};
        if (!io_buffer_put(alloc, triangles, triangle, sizeof triangle)) return false;
        o->next[o->before[b]] = o->next[b];
        o->before[o->next[b]] = o->before[b];
        at = o->next[b];
        --o->left;
    }
    return true;
}

/* The axis along which the polygon is widest seen (that of Newell's normal, 1972), and
 * in `flip` whether the shadow turns right. Coordinates are first scaled by a power of 2. */
static int main_axis(const double *corners, size_t count, bool *flip) {
    double most = 0, normal[3] = {0, 0, 0};
    for (size_t i = 0; i < 3 * count; ++i) most = fabs(corners[i]) > most ? fabs(corners[i]) : most;
    int exponent;
    frexp(most, &exponent);
    const double *o = corners;
    for (size_t i = 1; i + 1 < count; ++i) {
        double u[3], v[3];
        for (int k = 0; k < 3; ++k) {
            u[k] = ldexp(corners[3 * i + k], -exponent) - ldexp(o[k], -exponent);
            v[k] = ldexp(corners[3 * i + 3 + k], -exponent) - ldexp(o[k], -exponent);
        }
        for (int k = 0; k < 3; ++k) normal[k] += u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    }
    int axis = 0;
    for (int k = 1; k < 3; ++k)
        if (fabs(normal[k]) > fabs(normal[axis])) axis = k;
    *flip = normal[axis] < 0;
    return axis;
}

bool io_triangulate(const froe_allocator *alloc, const double *corners, size_t count, io_buffer *triangles) {
    if (count > UINT32_MAX / 2) return false;
    io_buffer shadow = {0}, links = {0};
    double *xy = io_buffer_add(alloc, &shadow, count * 2 * sizeof *xy);
    uint32_t *next = io_buffer_add(alloc, &links, count * 2 * sizeof *next);
    bool done = false;
    if (xy && next) {
        bool flip;
        int axis = main_axis(corners, count, &flip), first = (axis + 1) % 3, second = (axis + 2) % 3;
        outline o = {xy, next, next + count, (uint32_t)count};
        for (uint32_t i = 0; i < count; ++i) {
            xy[2 * i] = corners[3 * i + (flip ? second : first)];
            xy[2 * i + 1] = corners[3 * i + (flip ? first : second)];
            o.next[i] = i + 1 < count ? i + 1 : 0;
            o.before[i] = i ? i - 1 : (uint32_t)count - 1;
        }
        done = clip_all(alloc, &o, triangles);
    }
    io_buffer_free(alloc, &shadow);
    io_buffer_free(alloc, &links);
    return done;
}
