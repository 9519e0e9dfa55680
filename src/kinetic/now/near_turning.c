/* near_turning.c: claims as polynomials in doubles where bodies turn: in balls, by lines and points, as motion/lines.h
 * has them exactly. */
#include "kinetic/now/near.h"
#include "kinetic/now/turning.h"
#include "num/poly.h"

typedef struct near_ball_point {
    num_ball_poly x, y, w;
} near_ball_point;
typedef struct near_ball_line {
    num_ball_poly a, b, c;
} near_ball_line;

#include "num/ball_terms.inc"
#undef FORMULA
#define FORMULA(f) f##_near
#define POLY num_ball_poly
#define POINT near_ball_point
#define LINE near_ball_line
#define CURVE motion_ball_curve
#include "kinetic/motion/arcs_body.inc"
#include "num/end_terms.inc"

static const motion_piece *piece_at(now_state *now, uint32_t vertex) {
    now_course_of(now, vertex);
    return &now->bends.data[vertex].piece;
}

static void place_body(now_state *now, const motion_piece *piece, double span, placing_near *out) {
    motion_ball_curve centre;
    num_ball turn[4][2];
    motion_stretch_ball(now->motion, piece, now->tick, span, &centre);
    const int turning = motion_stretch_turn_ball(now->motion, piece, now->tick, span, turn);
    placing_of_near(NULL, &centre, piece->degree, turn, turning, out);
}

static void place_point(now_state *now, uint32_t vertex, double span, near_ball_point *out) {
    const motion_piece *piece = piece_at(now, vertex);
    motion_ball_curve curve;
    if (piece->corner) {
        placing_near placing;
        place_body(now, piece, span, &placing);
        point_in_near(NULL, &placing, piece->corner, out);
        return;
    }
    motion_stretch_ball(now->motion, piece, now->tick, span, &curve);
    out->x.degree = out->y.degree = piece->degree;
    out->w.degree = 0;
    out->w.c[0] = curve.w;
    for (int i = 0; i <= piece->degree; i++) out->x.c[i] = curve.x[i], out->y.c[i] = curve.y[i];
}

static void place_line(now_state *now, const uint32_t vertex[2], double span, near_ball_line *out) {
    const motion_piece *piece[2] = {piece_at(now, vertex[0]), piece_at(now, vertex[1])};
    if (piece[0]->corner && piece[0]->turn == piece[1]->turn) {
        placing_near placing;
        place_body(now, piece[0], span, &placing);
        line_in_near(NULL, &placing, piece[0]->corner, piece[1]->corner, out);
        return;
    }
    near_ball_point p[2];
    for (int i = 0; i < 2; i++) place_point(now, vertex[i], span, p + i);
    line_through_near(NULL, p, p + 1, out);
}

static void place_name(now_state *now, name_point name, double span, near_ball_point *out) {
    uint32_t vertex[4];
    near_ball_line l, k;
    if (now_vertices_of(now, name, vertex) == 1) {
        place_point(now, vertex[0], span, out);
        return;
    }
    place_line(now, vertex, span, &l), place_line(now, vertex + 2, span, &k);
    det_near(NULL, &l.b, &k.c, &k.b, &l.c, &out->x);
    det_near(NULL, &l.c, &k.a, &k.c, &l.a, &out->y);
    det_near(NULL, &l.a, &k.b, &k.a, &l.b, &out->w);
}

/* Returns the sign that the value has to be multiplied by. */
static int find_value(now_state *now, const now_claim *claim, int axis, double span, num_ball_poly *out) {
    near_ball_point p, q;
    near_ball_line line;
    if (claim->q.b == NAME_NONE) {
        place_name(now, claim->p, span, &p);
        *out = p.w;
        return claim->above;
    }
    if (claim->p.b == NAME_SEGMENT) {
        place_line(now, (const uint32_t[]){now_vertex(now, claim->p.a, 0), now_vertex(now, claim->p.a, 1)}, span,
                   &line);
        place_point(now, claim->q.a, span, &q);
        side_of_line_near(NULL, &line, &q, out);
        return claim->above;
    }
    place_name(now, claim->p, span, &p), place_name(now, claim->q, span, &q);
    det_near(NULL, axis ? &q.y : &q.x, &p.w, axis ? &p.y : &p.x, &q.w, out);
    const int below = num_ball_sign(p.w.c[0]), other = num_ball_sign(q.w.c[0]);
    const bool sure = below * below == 1 && other * other == 1;
    return sure ? below * other : now_judge_denominators(now, claim);
}

bool near_find_turning(now_state *now, const now_claim *claim, int axis, double span, near_poly *out) {
    const double enough = 0x1p10; /* so many times the error at least */
    num_ball_poly value;
    if (claim->above == NOW_ALONG) return false;
    const int sign = find_value(now, claim, axis, span, &value);
    *out = (near_poly){.degree = value.degree};
    for (int i = 0; i <= value.degree; i++) {
        out->c[i] = sign < 0 ? -value.c[i].x : value.c[i].x;
        out->size += fabs(out->c[i]);
        out->error += value.c[i].e;
    }
    out->size *= 1 + 0x1p-40, out->error = out->error * (1 + 0x1p-40) + NUM_BALL_TINY;
    return out->size > enough * out->error && out->size < (double)INFINITY; /* not NaN */
}
