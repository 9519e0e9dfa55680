/* slices.c: see slices.h. The fineness of the slices affects speed alone. */
#include "kinetic/contact/slices.h"
#include <float.h>

enum {
    MOST_CUTS = 64,  /* of one piece */
    MOST_LEVEL = 24, /* cuts are at whole multiples of the window's 2^-24, or coarser */
};
#define SLICE_LIMIT ((size_t)1 << 31)

typedef struct slicing {
    const froe_motion *m;
    slices_table *out;
    double spacing; /* the side of a square or cube that an object has for itself */
} slicing;

/* A box that holds nothing yet. */
static void empty_box(double lo[3], double hi[3]) {
    for (int k = 0; k < 3; k++) lo[k] = (double)INFINITY, hi[k] = -(double)INFINITY;
}

/* The side of a square or cube of this size. y = (x y)^(1/4) converges to the cube root of x. */
static double typical_side(int dim, double size) {
    double y = sqrt(size);
    for (int i = 0; i < 16 && dim == 3; i++) y = sqrt(sqrt(size * y));
    return y;
}

/* What the objects have for themselves, roughly: the scene's extent is that of all knots. */
static double typical_spacing(const froe_motion *m) {
    double lo[3], hi[3], widest = 0, room = 1;
    empty_box(lo, hi);
    for (size_t i = 0; i < m->knots.count; i++)
        for (int k = 0; k < m->dim; k++) {
            const double x = m->knots.data[i].at[k];
            if (x < lo[k]) lo[k] = x;
            if (x > hi[k]) hi[k] = x;
        }
    for (int k = 0; k < m->dim; k++)
        if (hi[k] - lo[k] > widest) widest = hi[k] - lo[k];
    for (int k = 0; k < m->dim; k++) /* in units of the widest, as products of lengths may be no doubles */
        room *= hi[k] - lo[k] > widest / 16 ? (hi[k] - lo[k]) / widest : 1.0 / 16;
    return typical_side(m->dim, room / (double)(m->objects.count + 1)) * widest + DBL_MIN;
}

static bool put_slice(slicing *s, uint32_t object, const motion_piece piece[3], double from, double to) {
    const int dim = s->m->dim;
    double lo[4], hi[4];
    empty_box(lo, hi);
    for (int i = 0; i < dim; i++) motion_extend(s->m, &piece[i], from, to, dim, lo, hi);
    lo[dim] = from, hi[dim] = to;
    const froe_allocator *alloc = &s->m->alloc;
    slices_table *out = s->out;
    return array_append(alloc, &out->lo, lo, (size_t)dim + 1) && array_append(alloc, &out->hi, hi, (size_t)dim + 1) &&
           array_push(alloc, &out->slices, (slices_entry){object, from, to});
}

/* Cuts a time in which no vertex changes its piece. */
static bool cut_piece(slicing *s, uint32_t object, const motion_piece piece[3], double from, double to) {
    const froe_motion *m = s->m;
    double way = 0, size = s->spacing, at[3][3];
    for (int i = 0; i < m->dim; i++) {
        double hi[3];
        empty_box(at[i], hi);
        motion_extend(m, &piece[i], from, to, m->dim, at[i], hi);
        for (int k = 0; k < m->dim; k++)
            if (hi[k] - at[i][k] > way) way = hi[k] - at[i][k];
    }
    for (int i = 1; i < m->dim; i++)
        for (int k = 0; k < m->dim; k++)
            if (fabs(at[0][k] - at[i][k]) > size) size = fabs(at[0][k] - at[i][k]);
    /* as many cuts as the way of the vertices is longer than the object is large */
    double cuts = way / size, step = m->end - m->begin, next = from;
    if (!(cuts < MOST_CUTS)) cuts = MOST_CUTS;
    for (int level = 0; level < MOST_LEVEL && step * cuts > to - from && 0.5 * step > 0; level++) step *= 0.5;
    for (double k = floor((from - m->begin) / step) + 1; next < to && cuts > 1; k++) {
        double end = m->begin + k * step;
        if (!(end > next)) continue;
        if (end >= to) break;
        if (!put_slice(s, object, piece, next, end)) return false;
        next = end;
    }
    return put_slice(s, object, piece, next, to);
}

static bool slice_object(slicing *s, uint32_t object, double from, double to) {
    const motion_object *o = s->m->objects.data + object;
    if (o->birth > from) from = o->birth;
    if (o->death < to) to = o->death;
    while (from <= to) {
        motion_piece piece[3];
        double end = to;
        for (int i = 0; i < s->m->dim; i++) {
            piece[i] = motion_piece_at_time(s->m, o->vertices[i], from);
            if (piece[i].degree && piece[i].to->time > from && piece[i].to->time < end) end = piece[i].to->time;
        }
        if (!cut_piece(s, object, piece, from, end)) return false;
        if (end == to) break;
        from = end;
    }
    return true;
}

froe_status slices_find(const froe_motion *m, double from, double to, slices_table *out) {
    *out = (slices_table){.slices = {0}};
    slicing s = {m, out, typical_spacing(m)};
    froe_status status = FROE_OK;
    for (uint32_t i = 0; i < m->objects.count && !status; i++) {
        if (!slice_object(&s, i, from, to)) status = FROE_E_MEMORY;
        if (out->slices.count >= SLICE_LIMIT) status = FROE_E_LIMIT;
    }
    if (status) slices_free(m, out);
    return status;
}

void slices_free(const froe_motion *m, slices_table *s) {
    array_free(&m->alloc, &s->slices);
    array_free(&m->alloc, &s->lo);
    array_free(&m->alloc, &s->hi);
}
