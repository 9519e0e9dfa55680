/* cylinders.c: Agarwal, Erickson and Guibas, "Kinetic binary space partitions for intersecting segments and disjoint
 * triangles", section 2; Paterson and Yao on segments. */
#include "claims.h"
#include <math.h>

#define IN_RANDOM_ORDER                                                                                                \
    { .method = "cylindrical" }
#define IN_ORDER                                                                                                       \
    { .method = "sorted cylinders" }

/* ----------------------------------------------------------------- crossings -- */

static double turn(const double *a, const double *b, const double *c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool cross(const double *a, const double *b, const double *c, const double *d) {
    return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

static const double *corner_of(const froe_scene *s, uint32_t object, uint32_t corner) {
    return froe_scene_vertex(s, froe_scene_corner(s, object, corner % froe_scene_object(s, object).corners));
}

/** Crossings of segments, in space of projected edges of different polygons; of n^2 pairs, in doubles. */
static double crossings(const froe_scene *s) {
    const uint32_t n = (uint32_t)froe_scene_object_count(s);
    const bool plane = froe_scene_dim(s) == 2;
    double count = 0;
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 0; j < i; j++) {
            const uint32_t p = plane ? 1 : froe_scene_object(s, i).corners,
                           q = plane ? 1 : froe_scene_object(s, j).corners;
            for (uint32_t e = 0; e < p; e++)
                for (uint32_t f = 0; f < q; f++)
                    count +=
                        cross(corner_of(s, i, e), corner_of(s, i, e + 1), corner_of(s, j, f), corner_of(s, j, f + 1));
        }
    return count;
}

/* ------------------------------------------------------------------- numbers -- */

static double nodes_per_n_log_n(const claims_tree *t) {
    return (double)t->report.nodes / claims_n_log_n(t);
}
static double nodes_per_n_log_n_and_k(const claims_tree *t) {
    return (double)t->report.nodes / (claims_n_log_n(t) + crossings(t->scene));
}
static double nodes_per_n_log2_n_and_k(const claims_tree *t) {
    return (double)t->report.nodes / (claims_n_log_n(t) * log(t->n) + crossings(t->scene));
}
static double n_log2_n_and_k_log_n(const claims_tree *t) {
    return (claims_n_log_n(t) + crossings(t->scene)) * log(t->n);
}
static double pieces_per_n_log_n(const claims_tree *t) {
    return claims_pieces(t) / claims_n_log_n(t);
}
/* Each segment ends in two slabs of each level. */
static double pieces_per_slab(const claims_tree *t) {
    return claims_pieces(t) / (t->n * (1 + 2 * log2(t->n)));
}

const claim claims_cylinders[] = {
    {.source = "Agarwal et al., theorem 2.3",
     .says = "O(n log n) nodes of disjoint segments",
     .measured = "exponent of nodes / (n log n) in n; worse of disjoint, rungs",
     .least = -INFINITY,
     .most = 0.05,
     .measure = claims_growth,
     .of = CLAIMS_PLAN(("disjoint", "rungs"), 64, 4, nodes_per_n_log_n, .cuts = true),
     .with = IN_RANDOM_ORDER,
     .needs = "random order",
     .without = IN_ORDER},
    {.source = "Agarwal et al., theorem 2.3",
     .says = "O(n log n + k) nodes with k crossings",
     .measured = "exponent of nodes / (n log n + k) in n; worst of slats, segments, crossed rungs",
     .least = -INFINITY,
     .most = 0.1,
     .measure = claims_growth,
     .of = CLAIMS_PLAN(("slats", "segments", "crossed rungs"), 64, 3, nodes_per_n_log_n_and_k, .cuts = true),
     .with = IN_RANDOM_ORDER,
     .needs = "random order",
     .without = IN_ORDER},
    {.source = "Agarwal et al., theorem 2.3",
     .says = "height O(log n)",
     .measured = "height / log2 n, the most of disjoint, rungs, crossed rungs, n = 128 to 1024",
     .least = 1,
     .most = 6,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("disjoint", "rungs", "crossed rungs"), 128, 3, claims_high, .cuts = true),
     .with = IN_RANDOM_ORDER,
     .needs = "random order",
     .without = IN_ORDER},
    {.source = "Agarwal et al., theorem 2.3",
     .says = "O(n log^2 n + k log n) expected time",
     .measured = "exponent of time / (n log^2 n + k log n) in n; worse of disjoint, crossed rungs",
     .least = -INFINITY,
     .most = 0.3,
     .measure = claims_time,
     .of = CLAIMS_PLAN(("disjoint", "crossed rungs"), 128, 3, n_log2_n_and_k_log_n, .cuts = true),
     .with = IN_RANDOM_ORDER,
     .needs = "random order",
     .without = IN_ORDER,
     .kind = CLAIM_TIMED},
    {.source = "Agarwal et al., theorem 2.5",
     .says = "O(n log^2 n + k) nodes of triangles in space",
     .measured = "exponent of nodes / (n log^2 n) in n; worse of terrain, roofs (k = 0)",
     .least = -INFINITY,
     .most = 0.05,
     .measure = claims_growth,
     .of = CLAIMS_PLAN(("terrain", "roofs"), 16, 3, nodes_per_n_log2_n_and_k, .cuts = true),
     .with = IN_RANDOM_ORDER,
     .needs = "random order",
     .without = IN_ORDER},
    {.source = "Agarwal et al., theorem 2.5",
     .says = "the same with k crossings of projected edges",
     .measured = "exponent of nodes / (n log^2 n + k) in n; worst of turned roofs (k ~ n), disjoint-3d, slats above "
                 "one another (k ~ n^2)",
     .least = -INFINITY,
     .most = 0.15,
     .measure = claims_growth,
     .of = CLAIMS_PLAN(("turned roofs", "disjoint-3d", "saddles apart"), 16, 3, nodes_per_n_log2_n_and_k, .cuts = true),
     .with = IN_RANDOM_ORDER,
     .needs = "random order",
     .without = IN_ORDER},
    {.source = "Agarwal et al., theorem 2.5",
     .says = "height O(log n) in space",
     .measured = "height / log2 n, the most of terrain, roofs, turned roofs, n = 16 to 128",
     .least = 1,
     .most = 12,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("terrain", "roofs", "turned roofs"), 16, 3, claims_high, .cuts = true),
     .with = IN_RANDOM_ORDER,
     .needs = "random order",
     .without = IN_ORDER},
    {.source = "Paterson and Yao 1990",
     .says = "O(n log n) pieces of disjoint segments",
     .measured = "exponent of pieces / (n log n) in n; worst of parallel, disjoint, combs",
     .least = -INFINITY,
     .most = 0.1,
     .measure = claims_growth,
     .of = CLAIMS_PLAN(("parallel", "disjoint", "combs"), 250, 3, pieces_per_n_log_n),
     .with = {.method = "paterson_yao", .settings = "rule=slabs"},
     .needs = "slabs: cuts along the objects in any order",
     .without = {.method = "sorted"}},
    {.source = "Paterson and Yao 1990",
     .says = "two pieces a slab of each level",
     .measured = "pieces / (n (1 + 2 log2 n)), worst of disjoint, rooms, blocks, spiral, combs",
     .least = 0,
     .most = 1,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("disjoint", "rooms", "blocks", "spiral", "combs"), 1000, 0, pieces_per_slab),
     .with = {.method = "paterson_yao", .settings = "rule=slabs"},
     .needs = "slabs: cuts along the objects in any order",
     .without = {.method = "sorted"}},
    {0}};
