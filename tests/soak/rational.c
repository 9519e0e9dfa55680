/* rational.c: sides of points of every kind beside planes of every kind, and among sheared walls, started at each
 * stage, against rationals, with coordinates of every class of support/fuzz.h: denormal, huge, of any bits. */
#include "geom/walls.h"
#include "soak.h"
#include <stdlib.h>

enum { CASES = 20, WALL_CASES = 2 };

typedef struct rational_case {
    num_context context;
    sides_oracle oracle;
    sides_case c;
    fuzz_class kind;
    soak_block *block;
} rational_case;

static void rational_judge(rational_case *r, const char *what, int expected, int got, bool hard) {
    r->block->decisions++;
    r->block->hard += hard;
    if (got != expected)
        soak_complain(r->block, "%s, dimension %d, class %s, stage %d: %d instead of %d", what, r->c.dim,
                      fuzz_names[r->kind], (int)r->context.first, got, expected);
}

#define RATIONAL_CHECK(r, what, expected, call)                                                                        \
    for (int stage_ = NUM_FILTER; stage_ <= NUM_EXACT; stage_++) {                                                     \
        const uint64_t filtered_ = (r)->context.stats.filtered;                                                        \
        (r)->context.first = (num_stage)stage_;                                                                        \
        const int got_ = (call);                                                                                       \
        rational_judge(r, what, expected, got_, (r)->context.stats.filtered == filtered_);                             \
    }

static void rational_vertex(rational_case *r) {
    const int side = rational_side(&r->oracle.planes[0], &r->oracle.u);
    RATIONAL_CHECK(r, "vertex", side, geom_side_vertex(&r->context, &r->c.planes[0], r->c.u))
}

static void rational_crossing(rational_case *r) {
    sides_oracle *o = &r->oracle;
    const int at_u = rational_side(&o->planes[1], &o->u), at_v = rational_side(&o->planes[1], &o->v);
    if (at_u == at_v || !rational_meet(&o->x, &o->planes[1], &o->u, &o->v)) return;
    const int side = rational_side(&o->planes[0], &o->x);
    RATIONAL_CHECK(r, "crossing", side, geom_side_crossing(&r->context, r->c.planes, r->c.u, r->c.v, r->c.planes + 1))
}

static void rational_corners(rational_case *r) {
    sides_oracle *o = &r->oracle;
    const geom_plane *p = r->c.planes;
    if (r->c.dim != 3 || !rational_corner(&o->x, &o->planes[1], &o->planes[2], &o->planes[3])) return;
    const int side = rational_side(&o->planes[0], &o->x);
    RATIONAL_CHECK(r, "corner", side, geom_side_corner(&r->context, p, p + 1, p + 2, p + 3))
}

static void rational_ball(rational_case *r) {
    if (!geom_plane_valid(&r->context, &r->c.planes[0])) return;
    const int side = rational_side_ball(&r->oracle.planes[0], &r->oracle.u, r->c.radius);
    RATIONAL_CHECK(r, "ball", side, geom_side_ball(&r->context, r->c.planes, r->c.u, r->c.radius))
}

/* Draws points and planes. */
typedef void rational_draw(fuzz_source *r, fuzz_class kind, int dim, sides_case *c);

static void rational_run(soak_block *block, uint64_t stream, int cases, rational_draw *draw, bool balls) {
    rational_case *r = calloc(1, sizeof *r);
    fuzz_source random = {base_hash(block->seed, stream, 0)};
    if (!r || num_context_new(NULL, &r->context)) abort();
    sides_oracle_init(&r->oracle);
    r->block = block;
    for (int i = 0; i < cases * FUZZ_CLASSES; i++) {
        r->kind = (fuzz_class)(i % FUZZ_CLASSES);
        draw(&random, r->kind, 2 + fuzz_int(&random, 0, 1), &r->c);
        sides_oracle_set(&r->oracle, &r->c, SIDES_PLANES);
        r->context.first = NUM_FILTER;
        rational_vertex(r);
        rational_crossing(r);
        rational_corners(r);
        if (balls) rational_ball(r);
    }
    sides_oracle_clear(&r->oracle);
    num_context_free(&r->context);
    free(r);
}

void soak_rational(soak_block *block) {
    rational_run(block, 2, CASES, sides_draw, true);
}

/* Whether a wall cuts a ball that it only touches is not the oracle's: its infinitesimal is a number. */
void soak_walls(soak_block *block) {
    rational_run(block, 8, WALL_CASES, walls_draw, false);
}
