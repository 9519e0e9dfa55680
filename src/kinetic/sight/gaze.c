/* gaze.c: see gaze.h. */
#include "kinetic/sight/gaze.h"
#include "kinetic/motion/products.h"
#include "support/fail.h"

#include "num/ball_terms.inc"
#define POLY num_ball_poly
#define GAZE gaze_ball
#define CURVE motion_ball_curve
#define SPAN(m, piece, from, to, out) motion_span_ball(m, piece, from, to, out)
#define TURN(m, piece, from, to, out) motion_turn_ball(m, piece, from, to, out)
#include "kinetic/sight/gaze_body.inc"

#include "num/dyadic_terms.inc"
#define POLY num_poly
#define GAZE gaze_exact
#define CURVE motion_dyadic_curve
#define SPAN(m, piece, from, to, out) motion_span_dyadic(arena, m, piece, from, to, out)
#define TURN(m, piece, from, to, out) motion_turn_dyadic(arena, m, piece, from, to, out)
#include "kinetic/sight/gaze_body.inc"

void gaze_near(const gaze *g, double from, double to, gaze_ball *out) {
    gaze_of_ball(NULL, g, from, to, out);
}

void gaze_exactly(num_arena *arena, const gaze *g, double from, double to, gaze_exact *out) {
    gaze_of_dyadic(arena, g, from, to, out);
}

/* --------------------------------------------------------------------- degrees -- */

int gaze_flight(const gaze *g) {
    int most = 0;
    const motion_plan *plan = g->rig ? &g->rig->bodies.data->plan : NULL;
    for (uint32_t i = 0; plan && i + 1 < plan->count; i++) {
        const int degree = motion_knot_degree(g->rig->knots.data + plan->first + i);
        most = degree > most ? degree : most;
    }
    return most;
}

int gaze_turn(const gaze *g) {
    const motion_body *body = g->rig ? g->rig->bodies.data : NULL;
    for (uint32_t i = 0; body && i + 1 < body->plan.count; i++) {
        const motion_turn *turn = g->rig->turns.data + body->turns + i;
        for (int k = 0; k < 4; k++)
            if (turn[0].q[k] != turn[1].q[k]) return 2;
    }
    return 0;
}

/* -------------------------------------------------------------------- beginning -- */

static froe_status make_rig(gaze *g, const froe_motion *m, const froe_body *body, froe_diagnostic *diag) {
    const size_t starts[] = {0, 1};
    const double time = m->begin;
    const uint32_t carrier = 0;
    froe_motion_options window = froe_motion_window(m);
    froe_moving eye = froe_moving_defaults();
    froe_status status = froe_motion_new(&window, &m->alloc, &g->rig, diag);
    if (!status) status = froe_motion_add_body(g->rig, body, NULL, diag);
    if (status) return status;
    const motion_plan *plan = &g->rig->bodies.data->plan;
    const motion_knot *first = g->rig->knots.data + plan->first, *last = first + plan->count - 1;
    if (plan->count > 1 && !(first->time <= m->begin && last->time >= m->end))
        return support_fail(diag, FROE_E_INPUT,
                            "The plan of the eye, from %.17g to %.17g, does not cover the window of the motion.",
                            first->time, last->time);
    eye.vertex_count = 1, eye.starts = starts, eye.times = &time, eye.coords = g->at, eye.bodies = &carrier;
    return froe_motion_add(g->rig, &eye, diag);
}

froe_status gaze_begin(gaze *g, const froe_motion *m, const froe_sight_options *o, froe_diagnostic *diag) {
    *g = (gaze){.parallel = o->parallel, .at = {o->at[0], o->at[1], o->at[2]}};
    for (int k = 0; k < 3; k++)
        if (!isfinite(g->at[k]))
            return support_fail(diag, FROE_E_OPTIONS, "option 'at': Coordinate %d is not a finite number.", k);
    if (g->parallel && g->at[0] == 0 && g->at[1] == 0 && g->at[2] == 0)
        return support_fail(diag, FROE_E_OPTIONS, "option 'at': The direction towards a parallel eye is 0.");
    return o->body ? make_rig(g, m, o->body, diag) : FROE_OK;
}

void gaze_end(gaze *g) {
    froe_motion_free(g->rig);
}
