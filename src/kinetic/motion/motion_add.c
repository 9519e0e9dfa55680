/* motion_add.c: flight plans enter a motion, all of a batch or nothing; and the checks of their input.
 *
 * Knots are written behind the published counts; a batch that fails is forgotten. */
#include "base/floats.h"
#include "kinetic/motion/motion.h"
#include "scene/scene.h"
#include "support/fail.h"
#include <string.h>

#define LIMIT 2147483646u /* ids stay below 2^31 - 2 */

typedef struct plan_adding {
    froe_motion *motion;
    const froe_moving *batch;
    froe_diagnostic *diag;
    size_t knots; /* of the batch so far */
    size_t seconds;
    int unit, top; /* of the coordinates so far */
    int time_unit, time_top;
} plan_adding;

/* ------------------------------------------------------------ widths of numbers -- */

/* The power of 2 of the last bit of x, INT16_MAX for 0. */
static int last_bit(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    uint64_t mantissa = bits & 0xfffffffffffffu, power = bits >> 52 & 0x7ff;
    if (power)
        mantissa |= (uint64_t)1 << 52;
    else
        power = 1;
    return mantissa ? (int)power - 1075 + __builtin_ctzll(mantissa) : INT16_MAX;
}

/* The least e with |x| < 2^e, INT16_MIN for 0. */
static int top_bit(double x) {
    int e = INT16_MIN;
    if (x != 0) frexp(x, &e);
    return e;
}

static int least_of(int a, int b) {
    return a < b ? a : b;
}

static int most(int a, int b) {
    return a > b ? a : b;
}

/* The unit of times in the piece that begins at a knot, and how many of them it lasts. */
static void measure_knot(const froe_motion *m, motion_knot *knot, const motion_knot *next) {
    enum { SPARE = 120 }; /* no time itself may be wider */
    int unit = least_of(least_of(last_bit(m->begin), m->power), least_of(last_bit(knot->time), last_bit(next->time)));
    int top = most(most(top_bit(m->begin), top_bit(m->end)), most(top_bit(knot->time), top_bit(next->time)));
    knot->unit = (int16_t)unit;
    knot->bits = INT16_MAX;
    if (top - unit <= SPARE) knot->bits = (int16_t)(top_bit(next->time - knot->time) + 1 - unit);
}

/* -------------------------------------------------------------------- one plan -- */

typedef struct plan_input {
    size_t count;
    const double *times, *coords, *controls, *second_controls;
    uint32_t vertex; /* for messages: of the batch, or the number of a body */
    const char *noun;
} plan_input;

static froe_status fail_at_knot(plan_adding *a, const plan_input *p, size_t i, const char *what, double value) {
    return support_fail_at(a->diag, FROE_E_INPUT, FROE_NONE, p->vertex, FROE_NONE,
                           "%s %u: Its %s %zu is %g, not a finite number.", p->noun, p->vertex, what, i, value);
}

/* One finite number of the plan; -0 becomes +0. */
static froe_status take_number(plan_adding *a, const plan_input *p, size_t i, const char *what, double value,
                               double *out) {
    if (!isfinite(value)) return fail_at_knot(a, p, i, what, value);
    *out = value + 0.0;
    a->unit = least_of(a->unit, last_bit(*out));
    a->top = most(a->top, top_bit(*out));
    return FROE_OK;
}

static void take_time(plan_adding *a, double time) {
    a->time_unit = least_of(a->time_unit, last_bit(time));
    a->time_top = most(a->time_top, top_bit(time));
}

static bool is_none(const double *point, size_t dim) {
    bool none = true;
    for (size_t k = 0; k < dim; k++) none = none && isnan(point[k]);
    return none;
}

/* The control points of the piece that begins at a knot, the last one excepted: none, one or two. */
static froe_status take_controls(plan_adding *a, const plan_input *p, size_t i, motion_knot *knot) {
    static const char *const names[2][3] = {
        {"x of control point", "y of control point", "z of control point"},
        {"x of second control point", "y of second control point", "z of second control point"}};
    const size_t dim = (size_t)a->motion->dim;
    const double *const first = p->controls ? p->controls + dim * i : NULL;
    const double *const second = p->second_controls ? p->second_controls + dim * i : NULL;
    const bool curved = first && i + 1 < p->count && !is_none(first, dim);
    const bool cubic = second && i + 1 < p->count && !is_none(second, dim);
    froe_status status = FROE_OK;
    if (cubic && !curved)
        return support_fail_at(a->diag, FROE_E_INPUT, FROE_NONE, p->vertex, FROE_NONE,
                               "%s %u: It has a second control point %zu, and no first.", p->noun, p->vertex, i);
    for (size_t k = 0; k < dim && !status && curved; k++)
        status = take_number(a, p, i, names[0][k], first[k], &knot->control[k]);
    if (dim == 2 && curved) knot->control[2] = 0;
    if (!cubic) return status;
    motion_second *out = a->motion->seconds.data + a->motion->seconds.count + a->seconds;
    *out = (motion_second){{0, 0, 0}};
    for (size_t k = 0; k < dim && !status; k++) status = take_number(a, p, i, names[1][k], second[k], &out->at[k]);
    knot->second = (uint32_t)(a->motion->seconds.count + a->seconds++);
    return status;
}

static froe_status take_knot(plan_adding *a, const plan_input *p, size_t i, motion_knot *knot) {
    const size_t dim = (size_t)a->motion->dim;
    *knot = (motion_knot){.time = p->times[i] + 0.0, .control = {NAN, NAN, NAN}, .second = FROE_NONE};
    if (!isfinite(knot->time)) return fail_at_knot(a, p, i, "time", knot->time);
    if (i && !(knot->time > knot[-1].time))
        return support_fail_at(a->diag, FROE_E_INPUT, FROE_NONE, p->vertex, FROE_NONE,
                               "%s %u: Time %zu, %.17g, is not after time %zu, %.17g.", p->noun, p->vertex, i,
                               knot->time, i - 1, knot[-1].time);
    knot->tick = motion_tick_after(a->motion, knot->time);
    take_time(a, knot->time);
    static const char *const names[] = {"x", "y", "z"};
    froe_status status = FROE_OK;
    for (size_t k = 0; k < dim && !status; k++)
        status = take_number(a, p, i, names[k], p->coords[dim * i + k], &knot->at[k]);
    return status ? status : take_controls(a, p, i, knot);
}

/* Appends the knots of a plan. REQUIRES: room. */
static froe_status take_plan(plan_adding *a, const plan_input *p, motion_plan *plan) {
    if (!p->count)
        return support_fail_at(a->diag, FROE_E_INPUT, FROE_NONE, p->vertex, FROE_NONE, "%s %u: It has no flight plan.",
                               p->noun, p->vertex);
    if (p->count > LIMIT)
        return support_fail(a->diag, FROE_E_LIMIT, "%s %u: There are more than %u times.", p->noun, p->vertex, LIMIT);
    *plan = (motion_plan){a->motion->knots.count + a->knots, (uint32_t)p->count, FROE_NONE};
    motion_knot *knots = a->motion->knots.data + plan->first;
    for (size_t i = 0; i < p->count; i++) {
        froe_status status = take_knot(a, p, i, knots + i);
        if (status) return status;
        if (i) measure_knot(a->motion, knots + i - 1, knots + i);
    }
    a->knots += p->count;
    return FROE_OK;
}

/* Does a plan cover a life? */
static froe_status check_cover(const plan_adding *a, const motion_plan *plan, uint32_t vertex, uint32_t object,
                               double birth, double death) {
    const motion_knot *first = a->motion->knots.data + plan->first, *last = first + plan->count - 1;
    if (plan->count == 1 || birth > death || (first->time <= birth && death <= last->time)) return FROE_OK;
    bool late = first->time > birth;
    double plan_end = late ? first->time : last->time, life_end = late ? birth : death;
    const char *begins = late ? "begins" : "ends", *after = late ? "after" : "before";
    if (object == FROE_NONE)
        return support_fail_at(a->diag, FROE_E_INPUT, object, vertex, FROE_NONE,
                               "The plan of vertex %u %s at %.17g, %s %.17g.", vertex, begins, plan_end, after,
                               life_end);
    return support_fail_at(
        a->diag, FROE_E_INPUT, object, vertex, FROE_NONE,
        "%s %u: The plan of its vertex %u %s at %.17g, %s the %s's time in the window does, at %.17g.",
        motion_noun(a->motion), object, vertex, begins, plan_end, after, motion_noun(a->motion), life_end);
}

/* --------------------------------------------------------------------- a batch -- */

static froe_status check_batch(const plan_adding *a) {
    const froe_moving *b = a->batch;
    const froe_motion *m = a->motion;
    if (b->size != sizeof *b) return support_fail_defaults(a->diag, "froe_moving_defaults");
    if ((b->vertex_count && (!b->starts || !b->times || !b->coords)) || (b->count && !b->vertex_count))
        return support_fail(a->diag, FROE_E_ARG, "The batch has %ss without flight plans.", motion_noun(m));
    if (b->vertex_count > LIMIT - m->plans.count || b->count > LIMIT - m->objects.count)
        return support_fail(a->diag, FROE_E_LIMIT, "There are more than %u vertices or %ss.", LIMIT, motion_noun(m));
    for (size_t v = 0; v < b->vertex_count; v++)
        if (b->starts[v] > b->starts[v + 1])
            return support_fail(a->diag, FROE_E_ARG, "The plan of vertex %zu ends before it starts.", v);
    for (uint32_t j = 0; j < b->count; j++) {
        uint32_t group = b->groups ? b->groups[j] : b->group;
        if (group != FROE_NONE && group >= m->names->group_count)
            return support_fail_at(a->diag, FROE_E_INPUT, j, FROE_NONE, FROE_NONE, "%s %u: There is no group %u.",
                                   motion_noun(m), j, group);
    }
    return FROE_OK;
}

/* A vertex that a body carries. */
static froe_status take_into_body(const plan_adding *a, size_t v, motion_plan *plan) {
    const uint32_t body = plan->body = a->batch->bodies[v];
    if (body >= a->motion->bodies.count)
        return support_fail_at(a->diag, FROE_E_INPUT, FROE_NONE, (uint32_t)v, FROE_NONE,
                               "vertex %zu: There is no body %u.", v, body);
    if (plan->count == 1) return FROE_OK;
    return support_fail_at(a->diag, FROE_E_INPUT, FROE_NONE, (uint32_t)v, FROE_NONE,
                           "vertex %zu: It belongs to body %u, and has a plan of its own.", v, body);
}

static froe_status take_vertices(plan_adding *a) {
    const froe_moving *b = a->batch;
    const size_t dim = (size_t)a->motion->dim;
    for (size_t v = 0; v < b->vertex_count; v++) {
        size_t start = b->starts[v];
        plan_input plan = {.count = b->starts[v + 1] - start,
                           .times = b->times + start,
                           .coords = b->coords + dim * start,
                           .vertex = (uint32_t)v,
                           .noun = "vertex"};
        if (b->controls) plan.controls = b->controls + dim * start;
        if (b->second_controls) plan.second_controls = b->second_controls + dim * start;
        motion_plan *taken = a->motion->plans.data + a->motion->plans.count + v;
        froe_status status = take_plan(a, &plan, taken);
        if (!status && b->bodies && b->bodies[v] != FROE_NONE) status = take_into_body(a, v, taken);
        if (status) return status;
    }
    return FROE_OK;
}

/* Vertex k of an object whose life is known. */
static froe_status take_corner(const plan_adding *a, uint32_t j, uint32_t k, motion_object *o) {
    const froe_moving *b = a->batch;
    const froe_motion *m = a->motion;
    const size_t at = (size_t)m->dim * j + k;
    const size_t v = b->vertices ? b->vertices[at] : at;
    if (v >= b->vertex_count)
        return support_fail_at(a->diag, FROE_E_INPUT, j, FROE_NONE, FROE_NONE, "%s %u: There is no vertex %zu.",
                               motion_noun(m), j, v);
    o->vertices[k] = (uint32_t)(m->plans.count + v);
    for (uint32_t i = 0; i < k && m->dim == 3; i++)
        if (o->vertices[i] == o->vertices[k])
            return support_fail_at(a->diag, FROE_E_INPUT, j, (uint32_t)v, FROE_NONE,
                                   "triangle %u: Two of its corners are the vertex %zu.", j, v);
    const motion_plan *plan = m->plans.data + o->vertices[k];
    if (m->plans.data[o->vertices[0]].body != plan->body)
        return support_fail_at(a->diag, FROE_E_INPUT, j, (uint32_t)v, FROE_NONE,
                               "%s %u: Its %s do not belong to the same body.", motion_noun(m), j,
                               m->dim == 2 ? "ends" : "corners");
    if (plan->body != FROE_NONE) plan = &m->bodies.data[plan->body].plan;
    return check_cover(a, plan, (uint32_t)v, j, o->birth, o->death);
}

static froe_status take_mover(plan_adding *a, uint32_t j, motion_object *o) {
    const froe_moving *b = a->batch;
    const froe_motion *m = a->motion;
    const double birth = b->births ? b->births[j] : m->begin, death = b->deaths ? b->deaths[j] : m->end;
    if (!(birth <= death) || birth == (double)INFINITY || death == -(double)INFINITY)
        return support_fail_at(a->diag, FROE_E_INPUT, j, FROE_NONE, FROE_NONE, "%s %u: Its life from %g to %g is none.",
                               motion_noun(m), j, birth, death);
    o->birth = birth > m->begin ? birth + 0.0 : m->begin;
    o->death = death < m->end ? death + 0.0 : m->end;
    take_time(a, o->birth);
    take_time(a, o->death);
    o->first = motion_tick_after(m, o->birth);
    o->last = motion_tick_before(m, o->death);
    o->vertices[2] = FROE_NONE;
    froe_status status = FROE_OK;
    for (uint32_t k = 0; k < (uint32_t)m->dim && !status; k++) status = take_corner(a, j, k, o);
    o->tag = b->tags ? b->tags[j] : m->objects.count + j;
    o->group = b->groups ? b->groups[j] : b->group;
    return status;
}

/* Knots are numbered by size_t, their second control points by 32 bits. */
static bool reserve_knots(froe_motion *m, size_t knots, const double *second_controls) {
    return array_reserve(&m->alloc, &m->knots, knots) &&
           array_reserve(&m->alloc, &m->seconds, second_controls ? knots : 0);
}

static plan_adding begin_adding(froe_motion *m, const froe_moving *batch, froe_diagnostic *diag) {
    plan_adding a = {.motion = m, .batch = batch, .diag = diag, .unit = m->unit, .top = m->top};
    a.time_unit = least_of(m->time_unit, least_of(last_bit(m->begin), last_bit(m->end)));
    a.time_top = most(m->time_top, most(top_bit(m->begin), top_bit(m->end)));
    return a;
}

static void commit(const plan_adding *a) {
    froe_motion *m = a->motion;
    m->unit = a->unit;
    m->top = a->top;
    m->time_unit = a->time_unit;
    m->time_top = a->time_top;
    m->knots.count += a->knots;
    m->seconds.count += a->seconds;
}

froe_status froe_motion_add(froe_motion *motion, const froe_moving *batch, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!motion || !batch) return support_fail_null(diag, __func__);
    plan_adding a = begin_adding(motion, batch, diag);
    froe_status status = check_batch(&a);
    if (status) return status;
    const size_t knots = batch->vertex_count ? batch->starts[batch->vertex_count] - batch->starts[0] : 0;
    motion->edition++;
    if (!reserve_knots(motion, knots, batch->second_controls) ||
        !array_reserve(&motion->alloc, &motion->plans, batch->vertex_count) ||
        !array_reserve(&motion->alloc, &motion->objects, batch->count))
        return support_fail_memory(diag);
    status = take_vertices(&a);
    for (uint32_t j = 0; j < batch->count && !status; j++)
        status = take_mover(&a, j, motion->objects.data + motion->objects.count + j);
    if (status) return status;
    commit(&a);
    motion->plans.count += batch->vertex_count;
    motion->objects.count += batch->count;
    return FROE_OK;
}

/* -------------------------------------------------------------------- bodies -- */

static double product_of_turns(const double *p, const double *q) {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
}

static froe_status fail_length(const plan_adding *a, const plan_input *p, const double *q, size_t i) {
    if (a->motion->dim == 2)
        return support_fail(a->diag, FROE_E_INPUT, "body %u: The pair of turn %zu, %g %g, has not the length 1.",
                            p->vertex, i, q[2], q[3]);
    return support_fail(a->diag, FROE_E_INPUT,
                        "body %u: The quaternion of turn %zu, %g %g %g %g, has not the length 1.", p->vertex, i, q[0],
                        q[1], q[2], q[3]);
}

/* Turn i of a body, in the plane z and w; of q and -q, that which is nearer to the one before. */
static froe_status take_turn(plan_adding *a, const plan_input *p, const double *q, size_t i, motion_turn *out) {
    static const char *const names[4] = {"x of turn", "y of turn", "z of turn", "w of turn"};
    const double near = 0x1p-20;
    froe_status status = FROE_OK;
    const size_t first = a->motion->dim == 2 ? 2 : 0;
    *out = (motion_turn){{0}};
    for (size_t k = first; k < 4 && !status; k++) status = take_number(a, p, i, names[k], q[k - first], &out->q[k]);
    if (status) return status;
    const double square = product_of_turns(out->q, out->q);
    if (!(fabs(square - 1) <= near)) return fail_length(a, p, out->q, i);
    const double along = i ? product_of_turns(out[-1].q, out->q) : 1;
    if (fabs(along) <= near)
        return support_fail(a->diag, FROE_E_INPUT,
                            "body %u: Turns %zu and %zu are half a turn apart, which does not tell the way.", p->vertex,
                            i - 1, i);
    for (int k = 0; k < 4 && along < 0; k++) out->q[k] = 0.0 - out->q[k];
    return FROE_OK;
}

froe_status froe_motion_add_body(froe_motion *m, const froe_body *body, uint32_t *id, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    static const double upright[4] = {0, 0, 0, 1};
    const size_t each = m && m->dim == 2 ? 2 : 4;
    if (!m || !body) return support_fail_null(diag, __func__);
    if (body->size != sizeof *body) return support_fail_defaults(diag, "froe_body_defaults");
    if (!body->times || !body->coords) return support_fail_null(diag, __func__);
    plan_adding a = begin_adding(m, NULL, diag);
    const plan_input input = {.count = body->count,
                              .times = body->times,
                              .coords = body->coords,
                              .controls = body->controls,
                              .vertex = (uint32_t)m->bodies.count,
                              .noun = "body"};
    if (m->bodies.count >= LIMIT) return support_fail(diag, FROE_E_LIMIT, "There are more than %u bodies.", LIMIT);
    m->edition++;
    if (!array_reserve(&m->alloc, &m->knots, body->count) || !array_reserve(&m->alloc, &m->turns, body->count) ||
        !array_reserve(&m->alloc, &m->bodies, 1))
        return support_fail_memory(diag);
    motion_body *out = m->bodies.data + m->bodies.count;
    out->turns = m->turns.count;
    froe_status status = take_plan(&a, &input, &out->plan);
    for (size_t i = 0; i < body->count && !status; i++)
        status = take_turn(&a, &input, body->turns ? body->turns + each * i : upright + 4 - each, i,
                           m->turns.data + out->turns + i);
    if (status) return status;
    commit(&a);
    m->turns.count += body->count;
    if (id) *id = (uint32_t)m->bodies.count;
    m->bodies.count++;
    return FROE_OK;
}

froe_status motion_replan(froe_motion *m, uint32_t vertex, size_t count, const double *times, const double *coords,
                          const double *controls, const double *second_controls, const double life[2],
                          froe_diagnostic *diag) {
    plan_adding a = begin_adding(m, NULL, diag);
    const plan_input input = {count, times, coords, controls, second_controls, vertex, "vertex"};
    motion_plan plan;
    m->edition++;
    if (!reserve_knots(m, count, second_controls)) return support_fail_memory(diag);
    froe_status status = take_plan(&a, &input, &plan);
    if (!status) status = check_cover(&a, &plan, vertex, FROE_NONE, life[0], life[1]);
    if (status) return status;
    commit(&a);
    m->plans.data[vertex] = plan;
    return FROE_OK;
}
