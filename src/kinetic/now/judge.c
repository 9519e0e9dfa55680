/* judge.c: order and sides where doubles do not decide: in stack integers of 128 bits if these are wide enough, of 320,
 * or in dyadic numbers, of any width.
 *
 * Vertices whose pieces last from the same instant to the same instant share their denominator, as most do. Then it is
 * left out, for no order and no side depends on a common scale. The width of results follows from the width of the
 * vertices at this tick; the formulas are those of poly_body.inc. */
#include "kinetic/now/turning.h"

enum { SHORT_BITS = 126, WIDE_BITS = NUM_WIDE_BITS - 1 };

/* The vertices of a question, at the tick or as polynomials in ticks from it on, as integers: |x|, |y| <= 2^place and
 * |w| <= 2^weight, all coefficients alike. */
typedef struct judge_cast {
    now_state *now;
    bool along;
    uint32_t vertex[NOW_POINTS];
    motion_whole_curve curve[NOW_POINTS];
    int count, degree, place, weight;
    bool turning; /* one of them is of a body */
} judge_cast;

static const motion_piece *piece_of(const judge_cast *c, int i) {
    return &c->now->bends.data[c->vertex[i]].piece;
}

static void cast_vertex(judge_cast *c, uint32_t vertex) {
    now_course_of(c->now, vertex);
    c->vertex[c->count] = vertex;
    const motion_piece *piece = piece_of(c, c->count++);
    c->turning = c->turning || piece->corner;
    c->degree = piece->degree > c->degree ? piece->degree : c->degree;
}

/* How many vertices are behind it: 1 or 4. */
static int cast_name(judge_cast *c, name_point p) {
    if (p.b == NAME_VERTEX) {
        cast_vertex(c, p.a);
        return 1;
    }
    const now_segment *segments = c->now->segments.data;
    for (int i = 0; i < 4; i++) cast_vertex(c, segments[i < 2 ? p.a : (uint32_t)p.b].end[i % 2]);
    return 4;
}

static void cast_side(judge_cast *c, uint32_t segment, uint32_t vertex) {
    for (int i = 0; i < 2; i++) cast_vertex(c, now_vertex(c->now, segment, i));
    cast_vertex(c, vertex);
}

/* ------------------------------------------------------------------ widths -- */

static num_limbs2 size_of_short(num_short x) {
    return x < 0 ? -(num_limbs2)x : (num_limbs2)x;
}

/* |x| <= 2^bits */
static int bits_of(num_limbs2 x) {
    uint64_t high = (uint64_t)(x >> 64), low = (uint64_t)x;
    if (x <= 1) return 0;
    return high ? 128 - __builtin_clzll(high) : 64 - __builtin_clzll(low);
}

static int terms_of(const judge_cast *c, int i) {
    return c->along ? piece_of(c, i)->degree + 1 : 1;
}

static int curve_bits(const judge_cast *c, int i) {
    num_limbs2 all = 0;
    for (int k = 0; k < terms_of(c, i); k++) all |= size_of_short(c->curve[i].x[k]) | size_of_short(c->curve[i].y[k]);
    for (int k = 0; k < terms_of(c, i) && c->now->motion->dim == 3; k++) all |= size_of_short(c->curve[i].z[k]);
    return bits_of(all);
}

/* Gives all vertices one denominator and drops it. Those of pieces that begin and end together are powers of one
 * number, so the highest is a multiple of the others. */
static void drop_weights(judge_cast *c) {
    int clock = -1; /* a piece of the highest degree that begins and ends when all others do that move */
    for (int i = 0; i < c->count; i++) {
        const motion_piece *p = piece_of(c, i), *q = clock < 0 ? p : piece_of(c, clock);
        if (!p->degree) continue;
        if (p->from->time != q->from->time || p->to->time != q->to->time) return;
        if (p == q || p->degree > q->degree) clock = i;
    }
    if (clock < 0) return;
    const num_short whole = c->curve[clock].w;
    for (int i = 0; i < c->count; i++) {
        motion_whole_curve *v = c->curve + i;
        const int degree = piece_of(c, i)->degree;
        if (degree == c->degree) continue;
        const num_short by = whole / v->w;
        if (curve_bits(c, i) + bits_of(size_of_short(by)) > SHORT_BITS) return;
        for (int k = 0; k < terms_of(c, i); k++) v->x[k] *= by, v->y[k] *= by;
        for (int k = 0; k < terms_of(c, i) && c->now->motion->dim == 3; k++) v->z[k] *= by;
        v->w = whole;
    }
    for (int i = 0; i < c->count; i++) c->curve[i].w = 1;
}

/* False: the vertices themselves are too wide. */
static bool cast_integers(judge_cast *c) {
    const froe_motion *m = c->now->motion;
    const int64_t tick = c->now->tick;
    if (c->turning) return false;
    for (int i = 0; i < c->count; i++) {
        motion_whole_curve *v = c->curve + i;
        num_short at[4];
        if (c->vertex[i] + 2 >= c->now->courses.count) return false; /* of a question, perhaps finer than the unit */
        if (c->along ? !motion_curve_whole(m, piece_of(c, i), tick, v) : !motion_whole(m, piece_of(c, i), tick, at))
            return false;
        if (!c->along) v->x[0] = at[0], v->y[0] = at[1], v->z[0] = m->dim == 3 ? at[2] : 0, v->w = at[m->dim];
    }
    drop_weights(c);
    for (int i = 0; i < c->count; i++) {
        int place = curve_bits(c, i), weight = bits_of(size_of_short(c->curve[i].w));
        c->place = place > c->place ? place : c->place;
        c->weight = weight > c->weight ? weight : c->weight;
    }
    if (!c->along) c->degree = 0;
    return true;
}

static int most(int a, int b) {
    return a > b ? a : b;
}

/* A product of polynomials, one of them of this degree, has sums of degree + 1 terms. */
static int growth(int degree) {
    return degree > 3 ? 3 : degree > 1 ? 2 : degree;
}

/* Of d x e for steps between vertices. */
static int turn_bits(const judge_cast *c) {
    return 2 * (c->place + c->weight + 1) + growth(c->degree) + 1;
}

/* Of the volume between four vertices: d x e for steps, times another step, and three such products. */
static int volume_bits(const judge_cast *c) {
    return turn_bits(c) + c->place + c->weight + 1 + growth(2 * c->degree) + 2;
}

/* Of the order of two points, from 1 or 4 vertices each. */
static int order_bits(const judge_cast *c, const int count[2]) {
    const int more = growth(c->degree), scaled = turn_bits(c) + c->weight;
    int place[2], weight[2];
    for (int i = 0; i < 2; i++) {
        const int moved = c->place + scaled + more, along = c->place + c->weight + 1 + turn_bits(c) + more;
        place[i] = count[i] == 1 ? c->place : most(moved, along) + 1;
        weight[i] = count[i] == 1 ? c->weight : scaled + c->weight;
    }
    return most(place[0] + weight[1], place[1] + weight[0]) + growth(2 * c->degree) + 1;
}

/* The first stage whose numbers have so many bits; not before the one asked for. */
static now_stage stage_for(const judge_cast *c, int bits) {
    now_stage stage = bits <= SHORT_BITS ? NOW_SHORT : bits <= WIDE_BITS ? NOW_WIDE : NOW_DYADIC;
    return stage > c->now->least ? stage : c->now->least;
}

/* ------------------------------------------------------------------ points -- */

static void wide_points(const judge_cast *c, wide_point *out) {
    for (int i = 0; i < c->count; i++) {
        const motion_whole_curve *v = c->curve + i;
        const int terms = terms_of(c, i);
        out[i].x.degree = out[i].y.degree = out[i].z.degree = terms - 1;
        out[i].w.degree = 0;
        for (int k = 0; k < terms; k++) {
            out[i].x.c[k] = num_wide_from(v->x[k]);
            out[i].y.c[k] = num_wide_from(v->y[k]);
            if (c->now->motion->dim == 3) out[i].z.c[k] = num_wide_from(v->z[k]);
        }
        out[i].w.c[0] = num_wide_from(v->w);
    }
}

/* Resets the arena. */
static void dyadic_points(const judge_cast *c, exact_point *out) {
    c->now->context.arena.top = 0;
    for (int i = 0; i < c->count; i++)
        if (c->along)
            now_exact_along(c->now, c->vertex[i], out + i);
        else
            now_exact_at(c->now, c->vertex[i], out + i);
}

/* --------------------------------------------------------------- questions -- */

/* What is asked about vertices: the order of two points, from count[] of them each; the side of the third of the line
 * through two; how the line through two turns to that through two more; or the side of the fourth of the plane through
 * three. */
typedef struct judge_question {
    enum { JUDGE_ORDER, JUDGE_TURN, JUDGE_LINES, JUDGE_VOLUME } what;
    int count[2];
    bool both; /* JUDGE_ORDER: by x, then y */
} judge_question;

static int judge_short(const judge_cast *c, const judge_question *ask) {
    short_point *v = c->now->points->narrow;
    for (int i = 0; i < c->count; i++) {
        const motion_whole_curve *from = c->curve + i;
        v[i].x.degree = v[i].y.degree = v[i].z.degree = terms_of(c, i) - 1;
        v[i].w.degree = 0;
        for (int k = 0; k < terms_of(c, i); k++)
            v[i].x.c[k] = from->x[k], v[i].y.c[k] = from->y[k], v[i].z.c[k] = from->z[k];
        v[i].w.c[0] = from->w;
    }
    if (ask->what == JUDGE_ORDER) return short_order_sign(v, ask->count, ask->both);
    if (ask->what == JUDGE_VOLUME) return short_volume_sign(v);
    return ask->what == JUDGE_TURN ? short_turn_sign(v) : short_lines_sign(v);
}

static int judge_wide(const judge_cast *c, const judge_question *ask) {
    wide_point *v = c->now->points->wide;
    wide_points(c, v);
    if (ask->what == JUDGE_ORDER) return wide_order_sign(v, ask->count, ask->both);
    if (ask->what == JUDGE_VOLUME) return wide_volume_sign(v);
    return ask->what == JUDGE_TURN ? wide_turn_sign(v) : wide_lines_sign(v);
}

/* The polynomial of a question about sides or lines, where bodies turn. */
static void turning_polynomial(const judge_cast *c, const judge_question *ask, poly_exact *out) {
    if (ask->what == JUDGE_TURN)
        now_turning_side(c->now, c->vertex, c->along, out);
    else
        now_turning_lines(c->now, c->vertex, c->along, out);
}

static int judge_turning(const judge_cast *c, const judge_question *ask) {
    poly_exact side;
    exact_point p[2];
    c->now->context.arena.top = 0;
    if (ask->what != JUDGE_ORDER) {
        turning_polynomial(c, ask, &side);
        return exact_sign(&side);
    }
    for (int i = 0; i < 2; i++)
        now_turning_point(c->now, c->vertex + (i ? ask->count[0] : 0), ask->count[i], c->along, p + i);
    return exact_compare_points(&c->now->context.arena, p, p + 1, ask->both);
}

static int judge_dyadic(const judge_cast *c, const judge_question *ask) {
    num_arena *arena = &c->now->context.arena;
    exact_point *v = c->now->points->exact;
    if (c->turning) return judge_turning(c, ask);
    dyadic_points(c, v);
    if (ask->what == JUDGE_ORDER) return exact_order_sign(arena, v, ask->count, ask->both);
    if (ask->what == JUDGE_VOLUME) return exact_volume_sign(arena, v);
    return ask->what == JUDGE_TURN ? exact_turn_sign(arena, v) : exact_lines_sign(arena, v);
}

static int judge(judge_cast *c, const judge_question *ask) {
    now_stage stage = NOW_DYADIC;
    if (cast_integers(c))
        stage = stage_for(c, ask->what == JUDGE_ORDER    ? order_bits(c, ask->count)
                             : ask->what == JUDGE_VOLUME ? volume_bits(c)
                                                         : turn_bits(c));
    c->now->judged[stage]++;
    if (stage == NOW_SHORT) return judge_short(c, ask);
    return stage == NOW_WIDE ? judge_wide(c, ask) : judge_dyadic(c, ask);
}

int now_judge_order(now_state *now, name_point p, name_point q, bool along, bool both) {
    judge_cast c = {.now = now, .along = along};
    judge_question ask = {.what = JUDGE_ORDER, .both = both};
    ask.count[0] = cast_name(&c, p);
    ask.count[1] = cast_name(&c, q);
    return judge(&c, &ask);
}

int now_judge_side(now_state *now, uint32_t segment, uint32_t vertex, bool along) {
    judge_cast c = {.now = now, .along = along};
    cast_side(&c, segment, vertex);
    return judge(&c, &(judge_question){.what = JUDGE_TURN});
}

int now_judge_turn(now_state *now, const uint32_t vertex[3], bool along) {
    judge_cast c = {.now = now, .along = along};
    for (int i = 0; i < 3; i++) cast_vertex(&c, vertex[i]);
    return judge(&c, &(judge_question){.what = JUDGE_TURN});
}

int now_judge_volume(now_state *now, const uint32_t vertex[4], bool along) {
    judge_cast c = {.now = now, .along = along};
    for (int i = 0; i < 4; i++) cast_vertex(&c, vertex[i]);
    return judge(&c, &(judge_question){.what = JUDGE_VOLUME});
}

int now_judge_lines(now_state *now, name_point crossing, bool along) {
    judge_cast c = {.now = now, .along = along};
    cast_name(&c, crossing);
    return judge(&c, &(judge_question){.what = JUDGE_LINES});
}

/* ------------------------------------------------------------------ claims -- */

/* The vertices of a claim; how many are behind each of its points. */
static void cast_claim(judge_cast *c, const now_claim *claim, int count[2]) {
    count[0] = 2, count[1] = 1;
    if (claim->q.b == NAME_NONE) {
        count[0] = cast_name(c, claim->p);
    } else if (claim->p.b == NAME_SEGMENT) {
        cast_side(c, claim->p.a, claim->q.a);
    } else {
        count[0] = cast_name(c, claim->p);
        count[1] = cast_name(c, claim->q);
    }
}

static void turning_claim(const judge_cast *c, const now_claim *claim, const int count[2], int axis, poly_exact *out) {
    exact_point p[2];
    c->now->context.arena.top = 0;
    if (claim->q.b == NAME_NONE || claim->p.b == NAME_SEGMENT) {
        const judge_question ask = {.what = claim->q.b == NAME_NONE ? JUDGE_LINES : JUDGE_TURN};
        turning_polynomial(c, &ask, out);
        return;
    }
    for (int i = 0; i < 2; i++) now_turning_point(c->now, c->vertex + (i ? count[0] : 0), count[i], true, p + i);
    exact_claim_points(&c->now->context.arena, p, p + 1, axis, out);
}

void now_claim_exact(now_state *now, const now_claim *claim, int axis, poly_exact *out) {
    if (claim->above == NOW_ALONG) {
        now_along_exact(now, claim, out);
        return;
    }
    judge_cast c = {.now = now, .along = true};
    int count[2];
    exact_point *v = now->points->exact;
    cast_claim(&c, claim, count);
    if (!c.turning) dyadic_points(&c, v);
    if (c.turning)
        turning_claim(&c, claim, count, axis, out);
    else if (claim->q.b == NAME_NONE)
        exact_lines(&now->context.arena, v, out);
    else if (claim->p.b != NAME_SEGMENT)
        exact_order(&now->context.arena, v, count, axis, out);
    else
        exact_turn(&now->context.arena, v, out);
    if (claim->above < 0) exact_negate(out);
}

int now_judge_denominators(now_state *now, const now_claim *claim) {
    int sign = 1;
    if (name_is_crossing(claim->p)) sign *= now_judge_lines(now, claim->p, true);
    if (name_is_crossing(claim->q)) sign *= now_judge_lines(now, claim->q, true);
    return sign;
}

bool now_claim_wide(now_state *now, const now_claim *claim, int axis, int64_t span, poly_wide *out) {
    judge_cast c = {.now = now, .along = true};
    int count[2], length = 64 - __builtin_clzll((uint64_t)span | 1) + 1;
    const bool lines = claim->q.b == NAME_NONE, side = lines || claim->p.b == NAME_SEGMENT;
    wide_point *v = now->points->wide;
    if (claim->above == NOW_ALONG) return false;
    cast_claim(&c, claim, count);
    if (!cast_integers(&c)) return false;
    int bits = side ? turn_bits(&c) : order_bits(&c, count);
    int degree = c.degree * (side ? 2 : count[0] == 1 && count[1] == 1 ? 1 : count[0] == count[1] ? 5 : 3);
    if (stage_for(&c, bits + degree * (length + 2) + 2) == NOW_DYADIC) return false;
    wide_points(&c, v);
    if (!side)
        wide_order(v, count, axis, out);
    else if (lines)
        wide_lines(claim->above > 0 ? v : (wide_point[4]){v[1], v[0], v[2], v[3]}, out);
    else if (claim->above > 0)
        wide_turn(v, out);
    else
        wide_turn((wide_point[3]){v[1], v[0], v[2]}, out);
    now->judged[NOW_WIDE]++;
    return true;
}
