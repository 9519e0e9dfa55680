/* poly.c: see poly.h. */
#include "num/poly.h"

void num_poly_trim(num_poly *f, int most) {
    f->degree = most;
    while (f->degree >= 0 && !f->c[f->degree].sign) f->degree--;
}

/* The nearest double; beyond the range of doubles it is infinite, and nothing is known. */
static num_ball ball_of(num_arena *arena, num_dyadic a) {
    double x = num_dyadic_quotient(arena, a, num_dyadic_scaled(arena, 1, 1, 0));
    bool exact = a.count <= 1 && fabs(x) < 0x1p53 && a.exponent == 0;
    return (num_ball){x, exact ? 0 : fabs(x) * 0x1p-53 + 0x1p-1074};
}

num_ball_poly num_poly_balls(num_arena *arena, const num_poly *f) {
    num_ball_poly out = {.degree = f->degree};
    size_t mark = arena->top;
    for (int i = 0; i <= f->degree; i++) {
        out.c[i] = ball_of(arena, f->c[i]);
        arena->top = mark;
    }
    return out;
}

num_ball num_ball_poly_at(const num_ball_poly *f, num_ball x) {
    num_ball sum = num_ball_from(0);
    for (int i = f->degree; i >= 0; i--) sum = num_ball_add(num_ball_mul(sum, x), f->c[i]);
    return sum;
}

int num_poly_sign(num_arena *arena, const num_poly *f, num_dyadic x) {
    size_t mark = arena->top;
    num_dyadic sum = {0};
    for (int i = f->degree; i >= 0; i--) sum = num_dyadic_add(arena, num_dyadic_mul(arena, sum, x), f->c[i]);
    arena->top = mark;
    return sum.sign;
}

static num_poly derivative(num_arena *arena, const num_poly *f) {
    num_poly d = {.degree = f->degree - 1};
    for (int i = 1; i <= f->degree; i++)
        d.c[i - 1] = num_dyadic_mul(arena, f->c[i], num_dyadic_scaled(arena, 1, (uint64_t)i, 0));
    return d;
}

static num_poly product(num_arena *arena, const num_poly *f, const num_poly *g) {
    num_poly fg = {.degree = f->degree < 0 || g->degree < 0 ? -1 : f->degree + g->degree};
    for (int i = 0; i <= f->degree; i++)
        for (int j = 0; j <= g->degree; j++)
            fg.c[i + j] = num_dyadic_add(arena, fg.c[i + j], num_dyadic_mul(arena, f->c[i], g->c[j]));
    return fg;
}

/* |lead b|^(deg a - deg b + 1) times the remainder of a by b, not zero. Each step of pseudo-division takes |lead b| a,
 * less the multiple of b that takes a's leading term away. */
static num_poly remainder_of(num_arena *arena, num_poly a, const num_poly *b) {
    int steps = a.degree - b->degree + 1;
    num_dyadic lead = b->c[b->degree];
    const int sign = lead.sign;
    lead.sign = 1;
    for (; a.degree >= b->degree; steps--) {
        num_dyadic top = a.c[a.degree];
        top.sign *= sign;
        const int shift = a.degree - b->degree;
        for (int i = 0; i < a.degree; i++) a.c[i] = num_dyadic_mul(arena, a.c[i], lead);
        for (int i = 0; i < b->degree; i++)
            a.c[i + shift] = num_dyadic_sub(arena, a.c[i + shift], num_dyadic_mul(arena, top, b->c[i]));
        num_poly_trim(&a, a.degree - 1);
    }
    for (; steps > 0; steps--)
        for (int i = 0; i <= a.degree; i++) a.c[i] = num_dyadic_mul(arena, a.c[i], lead);
    return a;
}

static num_dyadic power_of(num_arena *arena, num_dyadic x, int power) {
    num_dyadic product = num_dyadic_scaled(arena, 1, 1, 0);
    for (; power > 0; power--) product = num_dyadic_mul(arena, product, x);
    return product;
}

/* What Knuth's algorithm calls g and h, without their signs. */
typedef struct shrinking {
    num_dyadic g, h;
} shrinking;

/* Gives back what was made behind the mark, but for the coefficients, which were made one after the other. */
static void keep_coefficients(num_arena *arena, size_t mark, num_poly *f) {
    for (int i = 0; i <= f->degree; i++, mark = arena->top) f->c[i] = num_dyadic_keep(arena, mark, f->c[i]);
    arena->top = mark;
}

/* The next of a chain that ends with a, b: -remainder / (g h^(deg a - deg b)); g and h go on to the next step. */
static num_poly next_in_chain(num_arena *arena, const num_poly *a, const num_poly *b, shrinking *s) {
    const int drop = a->degree - b->degree; /* > 0 */
    const size_t mark = arena->top;
    num_poly r = remainder_of(arena, *a, b);
    const num_dyadic by = num_dyadic_mul(arena, s->g, power_of(arena, s->h, drop));
    for (int i = 0; i <= r.degree; i++) {
        r.c[i] = num_dyadic_divide(arena, r.c[i], by);
        r.c[i].sign = -r.c[i].sign;
    }
    keep_coefficients(arena, mark, &r);
    s->g = b->c[b->degree];
    s->g.sign = 1;
    const num_dyadic top = power_of(arena, s->g, drop);
    s->h = drop > 1 ? num_dyadic_divide(arena, top, power_of(arena, s->h, drop - 1)) : top;
    return r;
}

void num_chain_of(num_arena *arena, const num_poly *f, const num_poly *g, num_chain *out) {
    const num_dyadic one = num_dyadic_scaled(arena, 1, 1, 0);
    shrinking s = {one, one};
    num_poly next = derivative(arena, f);
    if (g) {
        next = product(arena, &next, g);
        if (next.degree >= f->degree) next = remainder_of(arena, next, f); /* which changes no sign at a root of f */
    }
    out->p[0] = *f, out->count = 1;
    while (next.degree >= 0) {
        const num_poly *last = &out->p[out->count - 1];
        out->p[out->count++] = next;
        next = next_in_chain(arena, last, &out->p[out->count - 1], &s);
    }
}

int num_chain_variations(num_arena *arena, const num_chain *chain, num_dyadic x) {
    int variations = 0, last = 0;
    for (int i = 0; i < chain->count; i++) {
        int sign = num_poly_sign(arena, &chain->p[i], x);
        variations += sign * last < 0;
        if (sign) last = sign;
    }
    return variations;
}

/* Horner's scheme evaluates f, and its partial sums are the quotient (Ruffini). */
num_poly num_poly_without(num_arena *arena, const num_poly *f, num_dyadic x) {
    num_poly g = *f;
    while (g.degree > 0) {
        num_poly quotient = {.degree = g.degree - 1};
        num_dyadic sum = g.c[g.degree];
        for (int i = g.degree - 1; i >= 0; i--) {
            quotient.c[i] = sum;
            sum = num_dyadic_add(arena, num_dyadic_mul(arena, sum, x), g.c[i]);
        }
        if (sum.sign) break;
        g = quotient;
    }
    return g;
}

/* A coefficient of a chain of degree n is a determinant of up to n - 1 rows of coefficients of f and n of coefficients
 * of f', or of the remainder of f' g by f, which have n + 2 times the limbs of f. Before it is divided, a
 * pseudo-remainder has three times as many. 6 n + 16 such numbers are more than one step needs; the chain itself has
 * (n + 1) (n + 2) / 2 of a third. */
size_t num_poly_arena(int degree, size_t limbs, size_t argument) {
    const size_t n = (size_t)degree, growth = 3 * (n - 1 + n * (n + 2));
    return (6 * n + 16) * ((limbs + 2) * growth + n * (argument + 2));
}

/* The sum of c[i] C(n - i, j - i). */
num_ball num_ball_poly_bernstein(const num_ball_poly *f, int j) {
    static const double choose[NUM_DEGREE + 1][NUM_DEGREE + 1] = {
        {1},
        {1, 1},
        {1, 2, 1},
        {1, 3, 3, 1},
        {1, 4, 6, 4, 1},
        {1, 5, 10, 10, 5, 1},
        {1, 6, 15, 20, 15, 6, 1},
        {1, 7, 21, 35, 35, 21, 7, 1},
        {1, 8, 28, 56, 70, 56, 28, 8, 1},
        {1, 9, 36, 84, 126, 126, 84, 36, 9, 1},
        {1, 10, 45, 120, 210, 252, 210, 120, 45, 10, 1},
        {1, 11, 55, 165, 330, 462, 462, 330, 165, 55, 11, 1},
        {1, 12, 66, 220, 495, 792, 924, 792, 495, 220, 66, 12, 1}};
    num_ball sum = f->c[j];
    for (int i = 0; i < j; i++)
        sum = num_ball_add(sum, num_ball_mul(num_ball_from(choose[f->degree - i][j - i]), f->c[i]));
    return sum;
}

int num_ball_poly_sign_throughout(const num_ball_poly *f) {
    const int sign = f->degree < 0 ? 0 : num_ball_sign(f->c[0]);
    for (int j = 1; j <= f->degree && sign != NUM_UNSURE; j++)
        if (num_ball_sign(num_ball_poly_bernstein(f, j)) != sign) return NUM_UNSURE;
    return sign ? sign : NUM_UNSURE;
}

num_ball_poly num_ball_poly_half(const num_ball_poly *f, bool upper) {
    num_ball_poly half = {.degree = f->degree};
    for (int i = 0; i <= f->degree; i++) half.c[i] = num_ball_mul(f->c[i], num_ball_from(ldexp(1, -i)));
    for (int i = 0; i < f->degree && upper; i++)
        for (int j = f->degree - 1; j >= i; j--) half.c[j] = num_ball_add(half.c[j], half.c[j + 1]);
    return half;
}

int num_ball_poly_changes(const num_ball_poly *f, int sign[NUM_DEGREE + 1]) {
    int changes = 0, last = 0;
    for (int j = 0; j <= f->degree; j++) {
        sign[j] = num_ball_sign(num_ball_poly_bernstein(f, j));
        if (sign[j] == NUM_UNSURE) changes = NUM_DEGREE + 1;
        if (changes <= NUM_DEGREE) changes += sign[j] * last < 0;
        if (sign[j]) last = sign[j];
    }
    return changes;
}
