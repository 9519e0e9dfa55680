/* motion.c: a motion from its window to its end, and what can be read from it. See motion.h. */
#include "kinetic/motion/motion.h"
#include "base/floats.h"
#include "num/context.h"
#include "support/fail.h"

enum {
    TICK_BITS = 31, /* by default 2^31 to 2^32 ticks in the window */
    MOST_TICK_BITS = 52,
    LEAST_POWER = -1074
};

void froe_motion_defaults_into(froe_motion_options *out, size_t size) {
    const froe_motion_options all = {.size = size, .dim = 2, .begin = NAN, .end = NAN};
    support_defaults(out, size, &all, sizeof all);
}

void froe_body_defaults_into(froe_body *out, size_t size) {
    const froe_body all = {.size = size};
    support_defaults(out, size, &all, sizeof all);
}

void froe_moving_defaults_into(froe_moving *out, size_t size) {
    const froe_moving all = {.size = size, .group = FROE_NONE};
    support_defaults(out, size, &all, sizeof all);
}

const char *motion_noun(const froe_motion *m) {
    return m->dim == 3 ? "triangle" : "segment";
}

/* --------------------------------------------------------------------- ticks -- */

/* floor((time - begin) / 2^power): the difference as a double and what it misses, exactly (Knuth's TwoSum). The double
 * is a multiple of more than twice the residue, so only where it is whole can the residue matter. */
static int64_t floor_tick(const froe_motion *m, double time, bool *whole) {
    double s = time - m->begin, t = s - time, residue = (time - (s - t)) + (-m->begin - t);
    double ticks = ldexp(s, -m->power);
    *whole = false;
    if (!(fabs(ticks) < 0x1p62)) return s > 0 ? MOTION_FAR : -MOTION_FAR;
    if (fabs(ticks) < 1) { /* ldexp may have lost bits */
        *whole = s == 0 && residue == 0;
        return s < 0 || (s == 0 && residue < 0) ? -1 : 0;
    }
    double low = floor(ticks);
    *whole = low == ticks && residue == 0;
    return (int64_t)low - (low == ticks && residue < 0);
}

int64_t motion_tick_before(const froe_motion *m, double time) {
    bool whole;
    return floor_tick(m, time, &whole);
}

int64_t motion_tick_after(const froe_motion *m, double time) {
    bool whole;
    int64_t tick = floor_tick(m, time, &whole);
    return whole || tick == MOTION_FAR || tick == -MOTION_FAR ? tick : tick + 1;
}

/* -------------------------------------------------------------------- window -- */

/* The power of 2 that a tick is by default: 2^31 to 2^32 of them are less than 2^top. */
static int usual_power(int top) {
    int power = top - 1 - TICK_BITS;
    return power < LEAST_POWER ? LEAST_POWER : power;
}

static froe_status set_window(froe_motion *m, const froe_motion_options *o, froe_diagnostic *diag) {
    int top, power;
    double length = o->end - o->begin;
    if (!isfinite(length) || !(length > 0))
        return support_fail(diag, FROE_E_INPUT, "The window %g .. %g is empty, endless or not a number.", o->begin,
                            o->end);
    if (o->tick < 0 || !isfinite(o->tick) || (o->tick > 0 && frexp(o->tick, &power) != 0.5))
        return support_fail(diag, FROE_E_OPTIONS, "A tick of %g is not a power of 2.", o->tick);
    const double share = frexp(length, &top); /* 2^(top - 1) <= length < 2^top */
    m->power = o->tick > 0 ? power - 1 : usual_power(top);
    m->begin = o->begin + 0.0;
    m->end = o->end + 0.0;
    if (top - m->power > MOST_TICK_BITS + (share == 0.5))
        return support_fail(diag, FROE_E_OPTIONS, "The window has more than 2^52 ticks of %g.", o->tick);
    m->last_tick = motion_tick_before(m, m->end);
    if (m->last_tick < 1) return support_fail(diag, FROE_E_OPTIONS, "A tick of %g is longer than the window.", o->tick);
    return FROE_OK;
}

froe_status froe_motion_new(const froe_motion_options *options, const froe_allocator *alloc, froe_motion **out,
                            froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!options || !out) return support_fail_null(diag, __func__);
    if (options->size != sizeof *options) return support_fail_defaults(diag, "froe_motion_defaults");
    if (num_rounding_check(diag)) return FROE_E_UNSUPPORTED;
    if (options->dim != 2 && options->dim != 3)
        return support_fail(diag, FROE_E_OPTIONS, "A motion has 2 or 3 dimensions, not %u.", options->dim);
    froe_motion window = {.alloc = support_allocator(alloc),
                          .dim = (int)options->dim,
                          .unit = INT16_MAX,
                          .top = INT16_MIN}; /* nothing yet */
    window.time_unit = INT16_MAX;
    window.time_top = INT16_MIN;
    froe_status status = set_window(&window, options, diag);
    if (status) return status;
    froe_motion *m = support_realloc(&window.alloc, NULL, 0, sizeof *m);
    if (!m) return support_fail_memory(diag);
    *m = window;
    status = froe_scene_new(m->dim, &m->alloc, &m->names);
    if (status) {
        froe_motion_free(m);
        return support_fail_memory(diag);
    }
    *out = m;
    return FROE_OK;
}

void froe_motion_free(froe_motion *m) {
    if (!m) return;
    froe_allocator alloc = m->alloc;
    array_free(&alloc, &m->knots);
    array_free(&alloc, &m->seconds);
    array_free(&alloc, &m->plans);
    array_free(&alloc, &m->objects);
    array_free(&alloc, &m->bodies);
    array_free(&alloc, &m->turns);
    froe_scene_free(m->names);
    support_free(&alloc, m, sizeof *m);
}

/* -------------------------------------------------------------------- groups -- */

froe_status froe_motion_add_group(froe_motion *motion, const froe_group *group, uint32_t *id) {
    return motion ? froe_scene_add_group(motion->names, group, id) : FROE_E_ARG;
}

froe_group froe_motion_group(const froe_motion *motion, uint32_t group) {
    return froe_scene_group(motion->names, group);
}

size_t froe_motion_group_count(const froe_motion *motion) {
    return motion ? froe_scene_group_count(motion->names) : 0;
}

/* ------------------------------------------------------------------- reading -- */

size_t froe_motion_object_count(const froe_motion *motion) {
    return motion ? motion->objects.count : 0;
}

size_t froe_motion_vertex_count(const froe_motion *motion) {
    return motion ? motion->plans.count : 0;
}

size_t froe_motion_body_count(const froe_motion *motion) {
    return motion ? motion->bodies.count : 0;
}

uint32_t froe_motion_vertex_body(const froe_motion *motion, uint32_t vertex) {
    return motion && vertex < motion->plans.count ? motion->plans.data[vertex].body : FROE_NONE;
}

size_t froe_motion_body_knot_count(const froe_motion *motion, uint32_t body) {
    return motion && body < motion->bodies.count ? motion->bodies.data[body].plan.count : 0;
}

froe_body_knot froe_motion_body_knot(const froe_motion *motion, uint32_t body, size_t knot) {
    const motion_body *b = motion->bodies.data + body;
    const motion_knot *k = motion->knots.data + b->plan.first + knot;
    const double *q = motion->turns.data[b->turns + knot].q;
    return (froe_body_knot){k->time,
                            {k->at[0], k->at[1], k->at[2]},
                            {k->control[0], k->control[1], k->control[2]},
                            {q[0], q[1], q[2], q[3]}};
}

void froe_motion_window_into(const froe_motion *motion, froe_motion_options *out, size_t size) {
    BASE_FLOATS_OWN;
    const froe_motion_options window = {.size = size,
                                        .dim = (unsigned)motion->dim,
                                        .begin = motion->begin,
                                        .end = motion->end,
                                        .tick = ldexp(1, motion->power)};
    support_defaults(out, size, &window, sizeof window);
}

froe_moving_object froe_motion_object(const froe_motion *motion, uint32_t object) {
    if (!motion || object >= motion->objects.count)
        return (froe_moving_object){.vertices = {FROE_NONE, FROE_NONE, FROE_NONE}, .group = FROE_NONE};
    const motion_object *o = motion->objects.data + object;
    return (froe_moving_object){{o->vertices[0], o->vertices[1], o->vertices[2]}, o->birth, o->death, o->group, o->tag};
}

size_t froe_motion_knot_count(const froe_motion *motion, uint32_t vertex) {
    return motion && vertex < motion->plans.count ? motion->plans.data[vertex].count : 0;
}

froe_moving_knot froe_motion_knot(const froe_motion *motion, uint32_t vertex, size_t knot) {
    const motion_knot *k = motion->knots.data + motion->plans.data[vertex].first + knot;
    froe_moving_knot out = {k->time,
                            {k->at[0], k->at[1], k->at[2]},
                            {k->control[0], k->control[1], k->control[2]},
                            {(double)NAN, (double)NAN, (double)NAN}};
    for (int i = 0; i < 3 && k->second != FROE_NONE; i++) out.second[i] = motion->seconds.data[k->second].at[i];
    return out;
}
