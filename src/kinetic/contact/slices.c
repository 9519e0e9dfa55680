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
    double spacing; /* the side of a square that an object has for itself */
} slicing;

/* What the objects have for themselves, roughly: the scene's extent is that of all knots. */
static double typical_spacing(const froe_motion *m) {
    double lo[2] = {DBL_MAX, DBL_MAX}, hi[2] = {-DBL_MAX, -DBL_MAX};
    for (size_t i = 0; i < m->knots.count; i++)
        for (int k = 0; k < 2; k++) {
            double x = m->knots.data[i].at[k];
            if (x < lo[k]) lo[k] = x;
            if (x > hi[k]) hi[k] = x;
        }
    double width = hi[0] - lo[0], height = hi[1] - lo[1], n = (double)(m->objects.count + 1);
    return sqrt((width / n + DBL_MIN) * (height > width / 16 ? height : width / 16));
}

static bool put_slice(slicing *s, uint32_t object, const motion_piece piece[2], double from, double to) {
    double lo[2] = {(double)INFINITY, (double)INFINITY}, hi[2] = {-(double)INFINITY, -(double)INFINITY};
    for (int i = 0; i < 2; i++) motion_extend(s->m, &piece[i], from, to, lo, hi);
    const froe_allocator *alloc = &s->m->alloc;
    slices_table *out = s->out;
    if (!array_reserve(alloc, &out->lo, 3) || !array_reserve(alloc, &out->hi, 3)) return false;
    if (!array_push(alloc, &out->slices, (slices_entry){object, from, to})) return false;
    const double low[3] = {lo[0], lo[1], from}, high[3] = {hi[0], hi[1], to};
    for (int k = 0; k < 3; k++) {
        out->lo.data[out->lo.count++] = low[k];
        out->hi.data[out->hi.count++] = high[k];
    }
    return true;
}

/* Cuts a time in which neither vertex changes its piece. */
static bool cut_piece(slicing *s, uint32_t object, const motion_piece piece[2], double from, double to) {
    const froe_motion *m = s->m;
    double way = 0, size = s->spacing, at[2][2];
    for (int i = 0; i < 2; i++) {
        double lo[2] = {(double)INFINITY, (double)INFINITY}, hi[2] = {-(double)INFINITY, -(double)INFINITY};
        motion_extend(m, &piece[i], from, to, lo, hi);
        for (int k = 0; k < 2; k++) {
            if (hi[k] - lo[k] > way) way = hi[k] - lo[k];
            at[i][k] = lo[k];
        }
    }
    for (int k = 0; k < 2; k++)
        if (fabs(at[0][k] - at[1][k]) > size) size = fabs(at[0][k] - at[1][k]);
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
        motion_piece piece[2];
        double end = to;
        for (int i = 0; i < 2; i++) {
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
