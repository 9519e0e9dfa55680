/* whole.c: sides of vertices, crossings and corners of planes, against whole numbers of 128 bits, which are quick
 * enough for a thousand million. Coordinates are whole numbers times a power of two, so that they are exact from the
 * smallest denormal to 2^1023. Points lie in one plane, or beside it by one unit of up to 2^50, where no filter can
 * decide. */
#include "geom/predicates.h"
#include "soak.h"
#include "support/fuzz.h"
#include <stdlib.h>

enum { CASES = 4000, EACH = 16 };

__extension__ typedef __int128 whole;

typedef struct whole_point {
    int64_t at[3];
    double x[3];
} whole_point;

/* n . (x - o) */
typedef struct whole_plane {
    whole n[3];
    const int64_t *o;
    geom_plane plane;
} whole_plane;

typedef struct whole_case {
    fuzz_source random;
    num_context *context;
    soak_block *block;
    int dim, power;
    double unit;                         /* 2^power */
    int64_t offset, base[3], d[3], e[3]; /* points are base + i d + j e, or beside that */
} whole_case;

static int64_t whole_below(fuzz_source *r, int bits) {
    return bits ? (int64_t)(fuzz_bits(r) >> (64 - bits)) : 0;
}

static int64_t whole_any(fuzz_source *r, int bits) {
    const int64_t x = whole_below(r, bits);
    return fuzz_int(r, 0, 1) ? x : -x;
}

/* Coordinates of at most so many bits, of all sizes below; all of one case are of one power of two. */
static void whole_begin(whole_case *c, int dim, int most) {
    fuzz_source *r = &c->random;
    const int bits = fuzz_int(r, 3, most);
    c->dim = dim;
    c->offset = fuzz_int(r, 0, 3) ? 0 : whole_any(r, 52);
    for (int k = 0; k < 3; k++) {
        c->base[k] = k < dim ? whole_any(r, bits - 2) : 0;
        c->d[k] = k < dim ? whole_any(r, bits > 7 ? bits - 6 : 1) : 0;
        c->e[k] = k < dim ? whole_any(r, bits > 7 ? bits - 6 : 1) : 0;
    }
    const int way = fuzz_int(r, 0, 3);
    c->power = way == 0 ? -1074 : way == 1 ? 969 : way == 2 ? 0 : fuzz_int(r, -1074, 969);
    c->unit = ldexp(1, c->power);
}

static void whole_draw(whole_case *c, whole_point *p) {
    const int64_t i = fuzz_int(&c->random, -7, 7), j = c->dim == 3 ? fuzz_int(&c->random, -7, 7) : 0;
    const bool beside = fuzz_int(&c->random, 0, 1);
    for (int k = 0; k < 3; k++) {
        p->at[k] = k < c->dim ? c->base[k] + i * c->d[k] + j * c->e[k] + (beside ? fuzz_int(&c->random, -1, 1) : 0) : 0;
        p->x[k] = (double)(p->at[k] + (k < c->dim ? c->offset : 0)) * c->unit;
    }
}

static whole_plane whole_through(int dim, const whole_point p[3]) {
    whole_plane h = {.o = p[0].at};
    whole d[2][3];
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 3; k++) d[i][k] = (whole)p[i + 1].at[k] - p[0].at[k];
    h.plane = geom_plane_points(dim, (const double *const[]){p[0].x, p[1].x, p[2].x});
    if (dim == 2) {
        h.n[0] = -d[0][1], h.n[1] = d[0][0];
        return h;
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        h.n[k] = d[0][i] * d[1][j] - d[0][j] * d[1][i];
    }
    return h;
}

static whole whole_at(const whole_plane *h, const int64_t *x) {
    whole sum = 0;
    for (int k = 0; k < 3; k++) sum += h->n[k] * (x[k] - h->o[k]);
    return sum;
}

static int whole_sign(whole x) {
    return (x > 0) - (x < 0);
}

static void whole_judge(whole_case *c, const char *what, int expected, int got, uint64_t before) {
    const froe_predicate_stats *s = &c->context->stats;
    c->block->decisions++;
    c->block->hard += s->refined + s->exact - before;
    if (got != expected)
        soak_complain(c->block, "%s, dimension %d, 2^%d, stage %d: %d instead of %d", what, c->dim, c->power,
                      (int)c->context->first, got, expected);
}

/* Started by the filter, and one time in 16 at the stages behind it as well. */
#define WHOLE_CHECK(c, what, expected, call)                                                                           \
    for (int last_ = fuzz_int(&(c)->random, 0, 15) ? NUM_FILTER : NUM_EXACT, stage_ = NUM_FILTER; stage_ <= last_;     \
         stage_++) {                                                                                                   \
        const uint64_t before_ = (c)->context->stats.refined + (c)->context->stats.exact;                              \
        (c)->context->first = (num_stage)stage_;                                                                       \
        const int got_ = (call);                                                                                       \
        whole_judge(c, what, expected, got_, before_);                                                                 \
    }

static void whole_vertices(whole_case *c, int dim) {
    whole_point p[3], x;
    whole_begin(c, dim, dim == 2 ? 50 : 39);
    for (int i = 0; i < 3; i++) whole_draw(c, p + i);
    const whole_plane h = whole_through(dim, p);
    for (int i = 0; i < EACH; i++) {
        whole_draw(c, &x);
        const int side = whole_sign(whole_at(&h, x.at));
        WHOLE_CHECK(c, "vertex", side, geom_side_vertex(c->context, &h.plane, x.x))
    }
}

/* Where uv meets `a` is (a(v) u - a(u) v) / (a(v) - a(u)). */
static void whole_crossings(whole_case *c, int dim) {
    whole_point p[2][3], u, v;
    whole_begin(c, dim, dim == 2 ? 28 : 18);
    for (int i = 0; i < 6; i++) whole_draw(c, &p[i / 3][i % 3]);
    const whole_plane h = whole_through(dim, p[0]), a = whole_through(dim, p[1]);
    for (int i = 0; i < EACH; i++) {
        whole_draw(c, &u), whole_draw(c, &v);
        const whole at_u = whole_at(&a, u.at), at_v = whole_at(&a, v.at);
        if (whole_sign(at_u) == whole_sign(at_v)) continue;
        const whole value = at_v * whole_at(&h, u.at) - at_u * whole_at(&h, v.at);
        const int side = whole_sign(value) * whole_sign(at_v - at_u);
        WHOLE_CHECK(c, "crossing", side, geom_side_crossing(c->context, &h.plane, u.x, v.x, &a.plane))
    }
}

/* By Cramer's rule, as seen from where the first plane begins. Planes are at one point, or beside it. */
static void whole_corners(whole_case *c) {
    whole_point p[4][3];
    whole_plane h[4];
    whole top[3] = {0}, bottom = 0, value = 0;
    whole_begin(c, 3, 10);
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++) c->d[k] = whole_any(&c->random, 3), c->e[k] = whole_any(&c->random, 3);
        for (int j = 0; j < 3; j++) whole_draw(c, &p[i][j]);
        h[i] = whole_through(3, p[i]);
    }
    const int64_t *from = h[1].o;
    for (int i = 0; i < 3; i++) {
        const whole *n = h[1 + (i + 1) % 3].n, *m = h[1 + (i + 2) % 3].n;
        const whole offset = -whole_at(&h[1 + i], from);
        for (int k = 0; k < 3; k++) {
            const whole cross = n[(k + 1) % 3] * m[(k + 2) % 3] - n[(k + 2) % 3] * m[(k + 1) % 3];
            top[k] += offset * cross;
            if (i == 0) bottom += h[1].n[k] * cross;
        }
    }
    if (bottom == 0) return;
    for (int k = 0; k < 3; k++) value += h[0].n[k] * top[k];
    value += whole_at(&h[0], from) * bottom;
    const int side = whole_sign(value) * whole_sign(bottom);
    WHOLE_CHECK(c, "corner", side, geom_side_corner(c->context, &h[0].plane, &h[1].plane, &h[2].plane, &h[3].plane))
}

void soak_whole(soak_block *block) {
    num_context context;
    if (num_context_new(NULL, &context)) abort();
    whole_case c = {.random = {base_hash(block->seed, 1, 0)}, .context = &context, .block = block};
    for (int i = 0; i < CASES; i++) {
        for (int dim = 2; dim <= 3; dim++) whole_vertices(&c, dim), whole_crossings(&c, dim);
        whole_corners(&c);
    }
    num_context_free(&context);
}
