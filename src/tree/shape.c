/* shape.c: clipping a convex polygon or polyhedron (after Sutherland and Hodgman 1974, with shared
 * edges so that the closing face is combinatorial). */
#include "tree/shape.h"
#include "num/pair.h"
#include <math.h>
#include <string.h>

#define SHAPE_EMPTY UINT32_MAX

static const double FAR = 0x1p-20; /* the size of a box by its distance from 0, below which it is far from 0 */

void shape_free(const froe_allocator *alloc, shape *s) {
    array_free(alloc, &s->points);
    array_free(alloc, &s->loops);
    array_free(alloc, &s->starts);
}

void shape_scratch_free(const froe_allocator *alloc, shape_scratch *scratch) {
    array_free(alloc, &scratch->sides);
    array_free(alloc, &scratch->values);
    array_free(alloc, &scratch->edges);
    array_free(alloc, &scratch->renumber);
}

static void clear(shape *s) {
    s->points.count = s->loops.count = s->starts.count = 0;
}

bool shape_copy(const froe_allocator *alloc, const shape *from, shape *out) {
    clear(out);
    if (!array_reserve(alloc, &out->points, from->points.count) ||
        !array_reserve(alloc, &out->loops, from->loops.count) ||
        !array_reserve(alloc, &out->starts, from->starts.count))
        return false;
    memcpy(out->points.data, from->points.data, from->points.count * sizeof(double));
    memcpy(out->loops.data, from->loops.data, from->loops.count * sizeof(uint32_t));
    memcpy(out->starts.data, from->starts.data, from->starts.count * sizeof(uint32_t));
    out->points.count = from->points.count;
    out->loops.count = from->loops.count;
    out->starts.count = from->starts.count;
    return true;
}

shape_frame shape_frame_of(int dim, const double *lo, const double *hi) {
    shape_frame f = {.exponent = 0};
    double extent = 0, most = 0;
    for (int k = 0; k < dim; k++) {
        extent = fmax(extent, hi[k] / 2 - lo[k] / 2);
        most = fmax(most, fmax(fabs(lo[k]), fabs(hi[k])));
    }
    if (extent < FAR * most)
        for (int k = 0; k < dim; k++) { /* of two numbers of which one is at most twice the other, Sterbenz (1974) */
            if (lo[k] > 0 && hi[k] / 2 <= lo[k]) f.origin[k] = lo[k];
            if (hi[k] < 0 && lo[k] / 2 >= hi[k]) f.origin[k] = hi[k];
        }
    most = 0;
    for (int k = 0; k < dim; k++) most = fmax(most, fmax(fabs(lo[k] - f.origin[k]), fabs(hi[k] - f.origin[k])));
    frexp(most, &f.exponent);
    return f;
}

static double in_frame(const shape_frame *f, int axis, double x) {
    return ldexp(x - f->origin[axis], -f->exponent);
}

double shape_coordinate(const shape_frame *f, int axis, double x) {
    return ldexp(x, f->exponent) + f->origin[axis];
}

bool shape_box(const froe_allocator *alloc, int dim, const double *lo, const double *hi, const shape_frame *frame,
               shape *out) {
    static const uint32_t square[4] = {0, 1, 3, 2};
    static const uint32_t cube[24] = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
    const uint32_t *loops = dim == 2 ? square : cube;
    size_t points = dim == 2 ? 4 : 8, corners = dim == 2 ? 4 : 24;
    clear(out);
    if (!array_reserve(alloc, &out->points, points * (size_t)dim) || !array_reserve(alloc, &out->loops, corners) ||
        !array_reserve(alloc, &out->starts, corners / 4 + 1))
        return false;
    for (size_t i = 0; i < points; i++)
        for (int k = 0; k < dim; k++)
            out->points.data[out->points.count++] = in_frame(frame, k, (i >> k & 1) ? hi[k] : lo[k]);
    for (size_t i = 0; i < corners; i++) out->loops.data[out->loops.count++] = loops[i];
    for (uint32_t i = 0; i <= corners; i += 4) out->starts.data[out->starts.count++] = i;
    return true;
}

/* ------------------------------------------------------------------- plane -- */

/* Scales v so that max |v[k]| is in [1/2, 1); returns the exponent taken out, 0 for the zero vector. */
static int normalise(double v[3]) {
    double most = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2])));
    int exponent = 0;
    frexp(most, &exponent);
    for (int k = 0; k < 3; k++) v[k] = ldexp(v[k], -exponent);
    return exponent;
}

/* Normal of a plane through points; q becomes its first point less the origin, in units of 2^(the result). */
static int points_normal(const geom_plane *plane, const double *origin, double n[3], double q[3]) {
    double all[3] = {0}, d[2][3] = {{0}};
    int count = plane->form == GEOM_VERTICAL ? 2 : plane->dim;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < plane->dim; k++) all[k] = fmax(all[k], fabs(plane->p[i][k] - origin[k]));
    int exponent = normalise(all);
    for (int k = 0; k < plane->dim; k++) q[k] = ldexp(plane->p[0][k] - origin[k], -exponent);
    for (int i = 1; i < count; i++) {
        for (int k = 0; k < plane->dim; k++) d[i - 1][k] = ldexp(plane->p[i][k] - origin[k], -exponent) - q[k];
        normalise(d[i - 1]);
    }
    if (count == 2) {
        n[0] = -d[0][1];
        n[1] = d[0][0];
        n[2] = 0;
    } else {
        for (int k = 0; k < 3; k++) {
            int i = (k + 1) % 3, j = (k + 2) % 3;
            n[k] = d[0][i] * d[1][j] - d[0][j] * d[1][i];
        }
    }
    normalise(n);
    return exponent;
}

/* c - n . origin, in units of the frame: numbers that are far larger than what is left of them. */
static double value_in_frame(const shape_frame *f, const double n[3], double c, int dim) {
    num_pair sum = {c, 0};
    for (int k = 0; k < dim; k++) sum = num_pair_sub(sum, num_pair_product(n[k], ldexp(f->origin[k], -f->exponent)));
    return sum.hi;
}

shape_plane shape_plane_from(const geom_plane *plane, const shape_frame *frame) {
    shape_plane out = {.axis = -1};
    double q[3] = {0};
    if (plane->form == GEOM_AXIS || geom_is_sheared(plane)) {
        out.axis = plane->axis;
        out.n[plane->axis] = 1;
        out.c = in_frame(frame, plane->axis, plane->c);
    } else if (geom_is_vector(plane)) {
        for (int k = 0; k < plane->dim; k++) out.n[k] = plane->normal[k];
        out.c = ldexp(plane->c, -normalise(out.n) - frame->exponent);
        out.c = value_in_frame(frame, out.n, out.c, plane->dim);
    } else {
        int scale = points_normal(plane, frame->origin, out.n, q);
        out.c = ldexp(out.n[0] * q[0] + out.n[1] * q[1] + out.n[2] * q[2], scale - frame->exponent);
    }
    out.slack = 0x1p-44 * (fabs(out.n[0]) + fabs(out.n[1]) + fabs(out.n[2]) + fabs(out.c));
    if (out.axis >= 0) out.slack = 0; /* a comparison is exact */
    return out;
}

bool shape_sides(const froe_allocator *alloc, int dim, const shape *s, const shape_plane *plane, shape_scratch *scratch,
                 unsigned *reached) {
    size_t count = s->points.count / (size_t)dim;
    scratch->sides.count = scratch->values.count = 0;
    if (!array_reserve(alloc, &scratch->sides, count) || !array_reserve(alloc, &scratch->values, count)) return false;
    *reached = 0;
    for (size_t i = 0; i < count; i++) {
        const double *x = s->points.data + i * (size_t)dim;
        double value = plane->axis >= 0 ? x[plane->axis] - plane->c : -plane->c;
        for (int k = 0; k < dim && plane->axis < 0; k++) value += plane->n[k] * x[k];
        bool on = fabs(value) <= plane->slack && isfinite(value);
        scratch->values.data[i] = value;
        scratch->sides.data[i] = (int8_t)(on ? 0 : value > 0 ? 1 : -1);
        if (!on) *reached |= value > 0 ? 2 : 1;
    }
    scratch->sides.count = scratch->values.count = count;
    return true;
}

/* -------------------------------------------------------------------- clip -- */

typedef struct clip {
    const froe_allocator *alloc;
    int dim, side;
    const shape *from;
    const shape_plane *plane;
    shape_scratch *scratch;
    shape *out;
} clip;

static bool kept(const clip *c, uint32_t point) {
    return c->scratch->sides.data[point] * c->side >= 0;
}

/* Slot of a crossed edge, made when it is new. False without memory. */
static bool edge_slot(clip *c, uint32_t a, uint32_t b, uint32_t *slot) {
    shape *out = c->out;
    size_t dim = (size_t)c->dim;
    shape_edge *edges = c->scratch->edges.data;
    uint32_t mask = (uint32_t)c->scratch->edges.count - 1, at = (a * 0x9e3779b1u ^ b * 0x85ebca6bu) & mask;
    while (edges[at].kept != SHAPE_EMPTY && (edges[at].kept != a || edges[at].dropped != b)) at = (at + 1) & mask;
    *slot = at;
    if (edges[at].kept != SHAPE_EMPTY) return true;
    edges[at] = (shape_edge){a, b, a, SHAPE_EMPTY};
    if (c->scratch->sides.data[a] == 0) return true;
    /* a new point where the edge meets the plane; the same bits from either side of it */
    if (!array_reserve(c->alloc, &out->points, dim)) return false;
    uint32_t first = a < b ? a : b, second = a < b ? b : a;
    const double *x = c->from->points.data + first * dim, *y = c->from->points.data + second * dim;
    double u = c->scratch->values.data[first], v = c->scratch->values.data[second], t = u / (u - v);
    edges[at].point = (uint32_t)(out->points.count / dim);
    for (size_t k = 0; k < dim; k++) out->points.data[out->points.count++] = x[k] + t * (y[k] - x[k]);
    if (c->plane->axis >= 0) out->points.data[out->points.count - dim + (size_t)c->plane->axis] = c->plane->c;
    return true;
}

/* Appends a point to the last face unless it just was. */
static bool add_point(clip *c, uint32_t point) {
    size_t first = c->out->starts.data[c->out->starts.count - 1];
    if (c->out->loops.count > first && c->out->loops.data[c->out->loops.count - 1] == point) return true;
    return array_push(c->alloc, &c->out->loops, point);
}

/* Ends the last face; one that has shrunk to an edge or point goes away. */
static bool close_face(clip *c) {
    shape *out = c->out;
    size_t first = out->starts.data[out->starts.count - 1];
    while (out->loops.count > first + 1 && out->loops.data[out->loops.count - 1] == out->loops.data[first])
        out->loops.count--;
    if (out->loops.count < first + 3) {
        out->loops.count = first;
        return true;
    }
    return array_push(c->alloc, &out->starts, (uint32_t)out->loops.count);
}

/* The kept part of one face. Where it leaves the kept side and comes back, the face's new edge runs
 * from exit to entry; the loop around the cut runs the other way: entry -> exit. */
static bool clip_face(clip *c, const uint32_t *loop, uint32_t count) {
    uint32_t slot, exit = SHAPE_EMPTY, wait = SHAPE_EMPTY;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t a = loop[i], b = loop[i + 1 < count ? i + 1 : 0];
        if (kept(c, a) && !add_point(c, a)) return false;
        if (kept(c, a) == kept(c, b)) continue;
        if (!edge_slot(c, kept(c, a) ? a : b, kept(c, a) ? b : a, &slot)) return false;
        if (!add_point(c, c->scratch->edges.data[slot].point)) return false;
        if (kept(c, a))
            exit = slot;
        else if (exit != SHAPE_EMPTY)
            c->scratch->edges.data[slot].next = exit;
        else
            wait = slot; /* its exit comes last */
    }
    if (wait != SHAPE_EMPTY) c->scratch->edges.data[wait].next = exit;
    return close_face(c);
}

/* The section as a shape: one loop over its own points. */
static bool copy_cut(const clip *c, const uint32_t *loop, size_t count, shape *cut) {
    size_t dim = (size_t)c->dim;
    clear(cut);
    if (!array_reserve(c->alloc, &cut->points, count * dim)) return false;
    for (size_t i = 0; i < count; i++, cut->points.count += dim)
        memcpy(cut->points.data + cut->points.count, c->out->points.data + loop[i] * dim, dim * sizeof(double));
    return true;
}

/* 2D: the section runs between the points where the polygon was cut. 3D: the loops around the cut become faces of
 * `out`, and the first of them is the section. */
static bool close_cut(clip *c, shape *cut) {
    shape_edge *edges = c->scratch->edges.data;
    const shape *out = c->out;
    const size_t faces = out->starts.count;
    if (cut) clear(cut);
    for (size_t i = 0; i < c->scratch->edges.count; i++) {
        uint32_t at = (uint32_t)i;
        if (edges[at].kept == SHAPE_EMPTY || edges[at].next == SHAPE_EMPTY) continue;
        if (c->dim == 2) {
            uint32_t ends[2] = {edges[at].point, edges[edges[at].next].point};
            return !cut || copy_cut(c, ends, 2, cut);
        }
        while (edges[at].next != SHAPE_EMPTY) {
            uint32_t next = edges[at].next;
            if (!add_point(c, edges[at].point)) return false;
            edges[at].next = SHAPE_EMPTY;
            at = next;
        }
        if (!close_face(c)) return false;
    }
    if (!cut) return true;
    /* one way: three edges of a solid shape are cut at least, but rounding may leave two points of them */
    size_t first = out->starts.data[faces - 1], end = out->loops.count > first ? out->starts.data[faces] : first;
    return copy_cut(c, out->loops.data + first, end - first, cut);
}

bool shape_clip(const froe_allocator *alloc, int dim, const shape *s, const shape_plane *plane, int side,
                shape_scratch *scratch, shape *out, shape *cut) {
    clip c = {alloc, dim, side, s, plane, scratch, out};
    clear(out);
    if (!array_reserve(alloc, &out->points, s->points.count) || !array_push(alloc, &out->starts, 0)) return false;
    memcpy(out->points.data, s->points.data, s->points.count * sizeof(double));
    out->points.count = s->points.count;
    /* an empty hash table with room for every edge of the shape */
    size_t size = 16;
    while (size < 2 * s->loops.count) size *= 2;
    scratch->edges.count = 0;
    if (!array_reserve(alloc, &scratch->edges, size)) return false;
    scratch->edges.count = size;
    memset(scratch->edges.data, 0xff, size * sizeof(shape_edge));
    for (size_t f = 0; f + 1 < s->starts.count; f++)
        if (!clip_face(&c, s->loops.data + s->starts.data[f], s->starts.data[f + 1] - s->starts.data[f])) return false;
    if (!close_cut(&c, cut)) return false;
    /* drops the points that no face uses */
    size_t width = (size_t)dim, count = out->points.count / width, used = 0;
    scratch->renumber.count = 0;
    if (!array_reserve(alloc, &scratch->renumber, count)) return false;
    uint32_t *number = scratch->renumber.data;
    memset(number, 0, count * sizeof *number);
    for (size_t i = 0; i < out->loops.count; i++) number[out->loops.data[i]] = 1;
    for (size_t i = 0; i < count; i++) {
        if (!number[i]) continue;
        memmove(out->points.data + used * width, out->points.data + i * width, width * sizeof(double));
        number[i] = (uint32_t)used++;
    }
    for (size_t i = 0; i < out->loops.count; i++) out->loops.data[i] = number[out->loops.data[i]];
    out->points.count = used * width;
    return true;
}
