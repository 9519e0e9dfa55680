/* meet_segments.c: when two moving segments of the plane meet.
 *
 * Two closed segments p0p1 and q0q1 meet iff the signs of twelve polynomials in time allow it: of the four turns
 *     o0 = [p0 p1 q0], o1 = [p0 p1 q1], o2 = [q0 q1 p0], o3 = [q0 q1 p1]     (degree up to 4, of cubics 6)
 * o0 o1 <= 0 and o2 o3 <= 0, and where all four are 0 also their bounding boxes overlap, which is up to the differences
 * of coordinates (degree up to 2, of cubics 3). Where bodies turn, both have degree up to 6, beside cubics 8
 * (strokes.h).
 *
 * Error bounds first: most pairs stay apart for a simple reason. Then exactly. */
#include "kinetic/contact/strokes.h"
#include "kinetic/contact/walk.h"

enum { TURNS = 4, GAPS = 8 /* the polynomials, in this order */ };

#include "num/ball_terms.inc"
#define CURVE motion_ball_curve
#define POLY num_ball_poly
#include "kinetic/contact/segments_body.inc"

#include "num/dyadic_terms.inc"
#define CURVE motion_dyadic_curve
#define POLY num_poly
#include "kinetic/contact/segments_body.inc"

typedef struct meeting {
    num_arena *arena;
    walk_room *w;
} meeting;

/* --------------------------------------------------------------- error bounds -- */

/* Do these keep one and the same sign? */
static bool all_alike(const num_ball_poly *f, int count) {
    int sign = num_ball_poly_sign_throughout(f);
    for (int i = 1; i < count && sign != NUM_UNSURE; i++)
        if (num_ball_poly_sign_throughout(f + i) != sign) sign = NUM_UNSURE;
    return sign != NUM_UNSURE;
}

static bool is_turning(const motion_piece piece[4]) {
    return piece[0].corner || piece[2].corner;
}

/* Of the polynomials of all four; of lines 2, too. */
static int degree_of(const motion_piece piece[4]) {
    int degree = 2;
    for (int i = 0; i < 4; i++)
        if (piece[i].degree > degree) degree = piece[i].degree;
    return degree;
}

static bool surely_apart(const froe_motion *m, walk_room *w, const motion_piece piece[4]) {
    motion_ball_curve v[4];
    num_ball_poly gap[GAPS], turn[TURNS];
    const int degree = degree_of(piece);
    if (is_turning(piece)) {
        strokes_near(m, piece, w->from, w->to, gap, turn);
    } else {
        for (int i = 0; i < 4; i++) motion_span_ball(m, &piece[i], w->from, w->to, &v[i]);
        gaps_ball(NULL, v, v + 2, degree, gap);
    }
    if (all_alike(gap, 4) || all_alike(gap + 4, 4)) return true;
    if (!is_turning(piece)) turns_ball(NULL, v, v + 2, degree, gap, turn);
    for (int i = 0; i < TURNS; i++) w->sign[i] = (signed char)num_ball_poly_sign_throughout(&turn[i]);
    return (w->sign[0] != NUM_UNSURE && w->sign[0] == w->sign[1]) ||
           (w->sign[2] != NUM_UNSURE && w->sign[2] == w->sign[3]);
}

/* ------------------------------------------------------------------- exactly -- */

/* Takes the polynomials; the roots of the turns are events, or of the gaps if all turns are 0 for good. */
static bool list_events(const froe_motion *m, const meeting *g, const motion_piece piece[4]) {
    walk_room *w = g->w;
    motion_dyadic_curve v[4];
    if (is_turning(piece)) {
        strokes_exact(g->arena, m, piece, w->from, w->to, w->f + TURNS, w->f);
    } else {
        for (int i = 0; i < 4; i++) motion_span_dyadic(g->arena, m, &piece[i], w->from, w->to, &v[i]);
        const int degree = degree_of(piece);
        gaps_dyadic(g->arena, v, v + 2, degree, w->f + TURNS);
        turns_dyadic(g->arena, v, v + 2, degree, w->f + TURNS, w->f);
    }
    bool flat = true;
    for (int i = 0; i < TURNS + GAPS; i++) num_poly_trim(&w->f[i], w->f[i].degree);
    for (int i = 0; i < TURNS; i++) flat = flat && w->f[i].degree < 0;
    bool told = true;
    for (int i = flat ? TURNS : 0; i < (flat ? TURNS + GAPS : TURNS) && told && w->from < w->to; i++)
        if (w->sign[i] == NUM_UNSURE) told = walk_list(g->arena, w, i);
    return told;
}

static bool do_meet(void *user, const walk_moment *at) {
    const meeting *g = user;
    int sign[TURNS];
    bool flat = true;
    for (int i = 0; i < TURNS; i++) {
        sign[i] = walk_sign(g->arena, g->w, at, i);
        if (sign[i]) flat = false;
    }
    if (sign[0] * sign[1] > 0 || sign[2] * sign[3] > 0) return false;
    for (int k = 0; k < 2 && flat; k++) { /* boxes are apart if on one axis all of q is on one side of all of p */
        const int gap = TURNS + 4 * k, first = walk_sign(g->arena, g->w, at, gap);
        int alike = 1;
        for (int i = 1; i < 4; i++) alike += walk_sign(g->arena, g->w, at, gap + i) == first;
        if (first && alike == 4) return false;
    }
    return true;
}

bool meet_segments(const froe_motion *m, meet_worker *worker, const motion_object *p, const motion_object *q) {
    meeting g = {&worker->arena, worker->room};
    motion_piece piece[4];
    for (int i = 0; i < 4; i++) piece[i] = motion_piece_at_time(m, (i < 2 ? p : q)->vertices[i % 2], g.w->from);
    if (surely_apart(m, g.w, piece)) return true;
    worker->stats.exact++;
    return list_events(m, &g, piece) && walk_through(g.arena, g.w, do_meet, &g);
}
