/* meet_triangles.c: when two moving triangles meet in space.
 *
 * Of two closed triangles a and b, 15 signs are asked for: on which side of the plane of the other each corner is (6),
 * and how each edge of a passes each edge of b (9): orient3d of corners all of them. Edge pq of one crosses the other
 * if
 *     p and q are not on one side of its plane, nor both on it, and pq does not pass two of its edges differently.
 * Then pq meets the plane in one point, and that lies in the triangle. If the six corners are not in one plane, the
 * triangles meet iff one of the six edges crosses: a point of both that is a corner of what they have in common lies on
 * an edge, and where an edge lies in the plane of the other triangle, another edge of one of them ends in that point
 * and leaves the plane. Triangles without area have no plane and all is 0; nothing of what was said needs more.
 *
 * The corners are in one plane iff all 15 signs are 0. Then the triangles meet iff they do in all three views along the
 * axes: in one of them the plane is not upright, or the line, if they lie in one, and the view is faithful. In a view
 * they meet iff two edges do, or a corner of one is within the other: by turns, and where points are in one line by
 * differences of coordinates, as segments of the plane.
 *
 * Degrees in time: corners on straight lines 3, bodies that turn 5, either along parabolas 6, corners on parabolas of
 * their own and a body that turns 8. */
#include "kinetic/contact/encounter.h"
#include "kinetic/motion/products.h"
#include <string.h>

/* Do the pieces of all corners have one degree, and begin and end together? */
static bool same_times(const motion_piece piece[3]) {
    for (int i = 1; i < 3; i++)
        if (piece[i].degree != piece->degree ||
            (piece->degree && (piece[i].from->time != piece->from->time || piece[i].to->time != piece->to->time)))
            return false;
    return true;
}

#include "num/ball_terms.inc"
#define CURVE motion_ball_curve
#define POLY num_ball_poly
#define SPAN(m, piece, from, to, out) motion_span_ball(m, piece, from, to, out)
#define TURN(m, piece, from, to, out) motion_turn_ball(m, piece, from, to, out)
#include "kinetic/contact/triangles_body.inc"

#include "num/dyadic_terms.inc"
#define CURVE motion_dyadic_curve
#define POLY num_poly
#define SPAN(m, piece, from, to, out) motion_span_dyadic(arena, m, piece, from, to, out)
#define TURN(m, piece, from, to, out) motion_turn_dyadic(arena, m, piece, from, to, out)
#define EXACT
#include "kinetic/contact/triangles_body.inc"

void encounter_crossing_signs(int edge, int out[5]) {
    const int of = edge < 3, e = edge % 3; /* of: whose plane it is */
    out[0] = SIDES + 3 * of + e;
    out[1] = SIDES + 3 * of + (e + 1) % 3;
    for (int i = 0; i < 3; i++) out[2 + i] = PASSES + (of ? 3 * e + i : 3 * i + e);
}

/* --------------------------------------------------------------- error bounds -- */

static bool surely_no_crossing(const signed char *sign, int edge) {
    int of[5];
    bool left = false, right = false;
    encounter_crossing_signs(edge, of);
    if (sign[of[0]] != NUM_UNSURE && sign[of[0]] == sign[of[1]]) return true;
    for (int i = 2; i < 5; i++) {
        left = left || sign[of[i]] == -1;
        right = right || sign[of[i]] == 1;
    }
    return left && right;
}

/* What is known of a part of the time. */
typedef struct ball_patch {
    num_ball_poly f[IN_SPACE];
    signed char sign[IN_SPACE]; /* all over the part, or NUM_UNSURE */
    bool counts[IN_SPACE];      /* may_cross or may_be_flat depend on it */
    bool may_cross[6], may_be_flat;
    int depth;
} ball_patch;

enum { MOST_HALVINGS = 4 };

/* What one pair needs; large. */
struct triangles_room {
    trios_ball near;
    num_ball_poly near_line[2][3];
    ball_patch all, part, stack[MOST_HALVINGS + 1];
    trios_dyadic exact;
    num_poly line[2][3];
};

size_t meet_triangles_bytes(void) {
    return sizeof(triangles_room);
}

/* Finds the signs that stay, and which edges may cross. False: none, nor can all corners be in one plane. */
static bool may_meet(ball_patch *p) {
    bool may = p->may_be_flat = true;
    for (int i = 0; i < IN_SPACE; i++) {
        if (p->counts[i] && p->sign[i] == NUM_UNSURE) p->sign[i] = (signed char)num_ball_poly_sign_throughout(&p->f[i]);
        p->may_be_flat = p->may_be_flat && (p->sign[i] == NUM_UNSURE || !p->sign[i]);
        p->counts[i] = false;
    }
    may = p->may_be_flat;
    for (int edge = 0; edge < 6; edge++) {
        int of[5];
        p->may_cross[edge] = p->may_cross[edge] && !surely_no_crossing(p->sign, edge);
        may = may || p->may_cross[edge];
        encounter_crossing_signs(edge, of);
        for (int i = 0; i < 5; i++) p->counts[of[i]] = p->counts[of[i]] || p->may_cross[edge] || p->may_be_flat;
    }
    return may;
}

static void take_half(const ball_patch *p, bool upper, ball_patch *half) {
    memcpy(half->sign, p->sign, sizeof half->sign);
    memcpy(half->counts, p->counts, sizeof half->counts);
    memcpy(half->may_cross, p->may_cross, sizeof half->may_cross);
    half->depth = p->depth + 1;
    for (int i = 0; i < IN_SPACE; i++)
        if (p->counts[i] && p->sign[i] == NUM_UNSURE) half->f[i] = num_ball_poly_half(&p->f[i], upper);
}

/* The same for halves of halves of the time, one by one, until one of the least may hold a contact. */
static bool may_meet_in_parts(triangles_room *room) {
    ball_patch *stack = room->stack, *p = &room->part;
    int count = 0;
    take_half(&room->all, true, &stack[count++]);
    take_half(&room->all, false, &stack[count++]);
    while (count) {
        *p = stack[--count];
        if (!may_meet(p)) continue;
        if (p->depth == MOST_HALVINGS) return true;
        take_half(p, true, &stack[count++]);
        take_half(p, false, &stack[count++]);
    }
    return false;
}

static bool surely_apart(encounter *g) {
    trios_ball *p = &g->room->near;
    ball_patch *all = &g->room->all;
    num_ball_poly(*of)[3] = g->room->near_line;
    all->depth = 0;
    for (int i = 0; i < 2; i++) shape_of_ball(NULL, g->m, g->piece[i], g->w, g->origin, &p->shape[i]);
    finish_pair_ball(NULL, p);
    memcpy(all->sign, g->w->sign, sizeof all->sign);
    for (int i = 0; i < 2; i++) {
        signed char *sign = all->sign + SIDES + 3 * i;
        for (int k = 0; k < 3; k++) {
            num_ball_poly *side = &all->f[SIDES + 3 * i + k];
            if (sign[k] != NUM_UNSURE) continue;
            side_ball(NULL, p, i, k, side);
            sign[k] = (signed char)num_ball_poly_sign_throughout(side);
        }
        if (sign[0] != NUM_UNSURE && sign[0] == sign[1] && sign[0] == sign[2]) return true;
    }
    for (int j = 0; j < 3; j++) {
        line_ball(NULL, p, j, of);
        for (int i = 0; i < 3; i++)
            if (all->sign[PASSES + 3 * i + j] == NUM_UNSURE)
                pass_ball(NULL, p->shape, i, of, &all->f[PASSES + 3 * i + j]);
    }
    memset(all->counts, true, sizeof all->counts);
    memcpy(all->may_cross, g->may_cross, sizeof all->may_cross);
    if (!may_meet(all) || !may_meet_in_parts(g->room)) return true;
    memcpy(g->w->sign, all->sign, sizeof all->sign);
    memcpy(g->may_cross, all->may_cross, sizeof all->may_cross);
    g->may_be_flat = all->may_be_flat;
    return false;
}

/* ------------------------------------------------------------------- exactly -- */

static void take_in_space(const encounter *g, const trios_dyadic *p, const bool needed[IN_SPACE]) {
    num_poly *f = g->w->f, (*of)[3] = g->room->line;
    for (int i = 0; i < 6; i++)
        if (needed[SIDES + i]) side_dyadic(g->arena, p, i / 3, i % 3, &f[SIDES + i]);
    for (int j = 0; j < 3; j++) {
        if (!needed[PASSES + j] && !needed[PASSES + 3 + j] && !needed[PASSES + 6 + j]) continue;
        line_dyadic(g->arena, p, j, of);
        for (int i = 0; i < 3; i++)
            if (needed[PASSES + 3 * i + j]) pass_dyadic(g->arena, p->shape, i, of, &f[PASSES + 3 * i + j]);
    }
}

static void take_in_plane(const encounter *g, const trios_dyadic *p) {
    num_poly *f = g->w->f;
    for (int axis = 0; axis < 3; axis++) {
        for (int i = 0; i < 18; i++)
            flat_turn_dyadic(g->arena, p, i / 9, i / 3 % 3, i % 3, axis, &f[TURNS + 18 * axis + i]);
        for (int i = 0; i < 9; i++) flat_gap_dyadic(g->arena, p, i / 3, i % 3, axis, &f[GAPS + 9 * axis + i]);
    }
    for (int i = TURNS; i < ALL_SIGNS; i++) num_poly_trim(&f[i], f[i].degree);
}

bool encounter_is_flat(const encounter *g, const walk_moment *at) {
    for (int i = 0; i < IN_SPACE && g->may_be_flat; i++)
        if (walk_sign(g->arena, g->w, at, i)) return false;
    return g->may_be_flat;
}

/* At any of the instants that count? */
static bool flat_at_times(const encounter *g) {
    const walk_moment start = walk_start(), end = walk_end(g->arena);
    bool flat = encounter_is_flat(g, &start) || encounter_is_flat(g, &end);
    for (int k = 0; k < g->w->event_count && !flat; k++) {
        flat = g->may_be_flat;
        for (int i = 0; i < IN_SPACE && flat; i++)
            flat = !g->w->sign[i] || g->w->f[i].degree < 0 || (g->w->events[k].vanishing[0] >> i & 1);
    }
    return flat;
}

/* Takes the polynomials that count; their roots are events: of those in space, or in the plane if all stay in one. */
static bool list_events(const encounter *g) {
    walk_room *w = g->w;
    bool needed[IN_SPACE] = {false}, told = true, always_flat = g->may_be_flat;
    trios_dyadic *p = &g->room->exact;
    for (int i = 0; i < 2; i++) shape_of_dyadic(g->arena, g->m, g->piece[i], g->w, g->origin, &p->shape[i]);
    finish_pair_dyadic(g->arena, p);
    for (int edge = 0; edge < 6; edge++) {
        int of[5];
        encounter_crossing_signs(edge, of);
        for (int i = 0; i < 5 && (g->may_cross[edge] || g->may_be_flat); i++)
            needed[of[i]] = w->sign[of[i]] == NUM_UNSURE;
    }
    take_in_space(g, p, needed);
    for (int i = 0; i < IN_SPACE; i++)
        if (needed[i]) {
            num_poly_trim(&w->f[i], w->f[i].degree);
            always_flat = always_flat && w->f[i].degree < 0;
        }
    for (int i = 0; i < IN_SPACE && told && w->from < w->to && !always_flat; i++)
        if (needed[i]) told = walk_list(g->arena, w, i);
    if (!told || !(always_flat || flat_at_times(g))) return told;
    take_in_plane(g, p);
    for (int i = TURNS; i < ALL_SIGNS && told && w->from < w->to && always_flat; i++) told = walk_list(g->arena, w, i);
    return told;
}

/* --------------------------------------------------------------------- signs -- */

bool encounter_edge_crosses(const encounter *g, const walk_moment *at, int edge) {
    int of[5], sides[2];
    bool left = false, right = false;
    encounter_crossing_signs(edge, of);
    for (int i = 0; i < 2; i++) sides[i] = walk_sign(g->arena, g->w, at, of[i]);
    if ((!sides[0] && !sides[1]) || sides[0] * sides[1] > 0) return false;
    for (int i = 2; i < 5 && !(left && right); i++) {
        const int sign = walk_sign(g->arena, g->w, at, of[i]);
        left = left || sign < 0;
        right = right || sign > 0;
    }
    return !(left && right);
}

/* Are edges i and j, seen along an axis in one line, apart in one of the other two coordinates? */
static bool boxes_apart(const encounter *g, const walk_moment *at, int axis, int i, int j) {
    for (int k = 0; k < 3; k++) {
        if (k == axis) continue;
        int first = 0, alike = 0;
        for (int n = 0; n < 4; n++) {
            const int gap = GAPS + 9 * k + 3 * ((i + n / 2) % 3) + (j + n % 2) % 3;
            const int sign = walk_sign(g->arena, g->w, at, gap);
            if (!n) first = sign;
            alike += sign == first;
        }
        if (first && alike == 4) return true;
    }
    return false;
}

/* Seen along an axis: do edges i and j meet? */
static bool edges_meet(const encounter *g, const walk_moment *at, int axis, int i, int j) {
    const int first = TURNS + 18 * axis + 3 * i, second = TURNS + 18 * axis + 9 + 3 * j;
    const int a = walk_sign(g->arena, g->w, at, first + j), b = walk_sign(g->arena, g->w, at, first + (j + 1) % 3);
    if (a * b > 0) return false;
    const int c = walk_sign(g->arena, g->w, at, second + i), d = walk_sign(g->arena, g->w, at, second + (i + 1) % 3);
    if (c * d > 0) return false;
    return a || b || c || d || !boxes_apart(g, at, axis, i, j);
}

/* Seen along an axis: does triangle `of` have the first corner of the other within? */
static bool has_corner_within(const encounter *g, const walk_moment *at, int axis, int of) {
    const int first = TURNS + 18 * axis + 9 * of, sign = walk_sign(g->arena, g->w, at, first);
    return sign && walk_sign(g->arena, g->w, at, first + 3) == sign && walk_sign(g->arena, g->w, at, first + 6) == sign;
}

static bool views_meet(const encounter *g, const walk_moment *at, int axis) {
    for (int i = 0; i < 9; i++)
        if (edges_meet(g, at, axis, i / 3, i % 3)) return true;
    return has_corner_within(g, at, axis, 0) || has_corner_within(g, at, axis, 1);
}

static bool do_meet(void *user, const walk_moment *at) {
    const encounter *g = user;
    if (g->shared_count) return neighbours_meet(g, at);
    for (int edge = 0; edge < 6; edge++)
        if (g->may_cross[edge] && encounter_edge_crosses(g, at, edge)) return true;
    return encounter_is_flat(g, at) && views_meet(g, at, 0) && views_meet(g, at, 1) && views_meet(g, at, 2);
}

bool meet_triangles(const froe_motion *m, meet_worker *worker, const motion_object *p, const motion_object *q) {
    encounter g = {.m = m, .arena = &worker->arena, .w = worker->room, .room = worker->shapes};
    for (int i = 0; i < 3; i++) {
        g.piece[0][i] = motion_piece_at_time(m, p->vertices[i], g.w->from);
        g.piece[1][i] = motion_piece_at_time(m, q->vertices[i], g.w->from);
    }
    const motion_piece *near = g.piece[g.piece[0]->corner != NULL]; /* a triangle of no body, if there is one */
    for (int k = 0; k < 3; k++) g.origin[k] = near->from->at[k];
    memset(g.may_cross, true, sizeof g.may_cross);
    neighbours_find(p, q, &g);
    neighbours_signs(&g, g.w->sign, g.may_cross);
    if (surely_apart(&g)) return true;
    worker->stats.exact++;
    return list_events(&g) && walk_through(g.arena, g.w, do_meet, &g);
}
