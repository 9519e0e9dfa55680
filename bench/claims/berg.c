/* berg.c: de Berg, "Linear size binary space partitions for uncluttered scenes". */
#include "guarding.h"
#include "scene/scene.h"
#include "tree/list.h"
#include <math.h>
#include <string.h>

#define BY_DENSITY                                                                                                     \
    { .method = "density" }
#define UNGUARDED                                                                                                      \
    { .method = "density", .settings = "k=1000000000" }

/* Axis-parallel cuts, in a tree as deep as scenes are nested. */
#define DEEP .method = "quad"

static const claims_plan saddles[] = {
    {.kinds = CLAIMS_KINDS("saddles"), .from = 64, .doublings = 3, .value = claims_pieces},
    {.kinds = CLAIMS_KINDS("saddles apart"), .from = 64, .doublings = 3, .value = claims_pieces}};

/* Balls smaller than every object. */
static double small_range_by(const claims_tree *t, froe_walk walk) {
    claims_asker a = claims_ask(t);
    froe_diagnostic diag = {0};
    for (int i = 0; i < CLAIMS_QUERIES; i++) {
        double centre[FROE_MAX_DIM];
        froe_range ball = froe_range_defaults();
        froe_list list;
        claims_place(&a, 0, centre);
        ball.shape = FROE_SHAPE_BALL, ball.points = centre, ball.radius = 0;
        for (int k = 0; k < a.dim; k++) ball.radius = fmax(ball.radius, 0x1p-20 * fabs(centre[k]));
        ball.walk = t->way.bare ? FROE_WALK_PLAIN : walk;
        bench_must(froe_query_range(a.query, &ball, &list, &diag), &diag);
    }
    const double cost = claims_asked(&a) / CLAIMS_QUERIES;
    froe_query_free(a.query);
    return cost;
}
static double small_range(const claims_tree *t) {
    return small_range_by(t, FROE_WALK_AUTO);
}
static double small_range_in_cubes(const claims_tree *t) {
    return small_range_by(t, FROE_WALK_CLASSES);
}

/* Windows half as wide as the least of all objects, at places inside objects of all sizes. */
static double window_in_octaves(const claims_tree *t) {
    claims_asker a = claims_ask(t);
    froe_diagnostic diag = {0};
    const double wide = ldexp(0.1, -(int)t->n);
    for (int i = 0; i < CLAIMS_QUERIES; i++) {
        double points[4];
        froe_range box = froe_range_defaults();
        froe_list list;
        const double s = ldexp(1.2, -(int)(bench_unit(&a.state) * t->n));
        for (int k = 0; k < 2; k++) points[k] = s - wide, points[2 + k] = s + wide;
        box.points = points, box.walk = t->way.bare ? FROE_WALK_PLAIN : FROE_WALK_CLASSES;
        bench_must(froe_query_range(a.query, &box, &list, &diag), &diag);
    }
    const double cost = claims_asked(&a) / CLAIMS_QUERIES;
    froe_query_free(a.query);
    return cost;
}

/* Pairs that share a leaf, over n. Bare: pairs whose bounding boxes meet, which no axis-parallel plane separates. */
static double pairs_together(const claims_tree *t) {
    const uint32_t n = (uint32_t)t->n;
    const int dim = froe_scene_dim(t->scene);
    double pairs = 0;
    for (uint32_t i = 0; i < t->tree->node_count && !t->way.bare; i++)
        if (tree_is_leaf(t->tree->nodes + i)) {
            const double m = tree_list(t->tree, i).count;
            pairs += 0.5 * m * (m - 1);
        }
    for (uint32_t i = 0; i < n && t->way.bare; i++)
        for (uint32_t j = 0; j < i; j++) {
            double lo[2][FROE_MAX_DIM], hi[2][FROE_MAX_DIM];
            bool meet = true;
            scene_object_bounds(t->scene, i, lo[0], hi[0]);
            scene_object_bounds(t->scene, j, lo[1], hi[1]);
            for (int k = 0; k < dim; k++) meet = meet && lo[0][k] <= hi[1][k] && lo[1][k] <= hi[0][k];
            pairs += meet;
        }
    return pairs / t->n;
}

/* Windows that meet k of m cells: the worst cost over k log2 m. */
static double cells_met(const claims_tree *t) {
    claims_asker a = claims_ask(t);
    froe_diagnostic diag = {0};
    double worst = 0;
    for (int i = 0; i < CLAIMS_QUERIES; i++) {
        double points[2 * FROE_MAX_DIM];
        froe_range box = froe_range_defaults();
        froe_list list;
        claims_place(&a, 0, points);
        for (int k = 0; k < a.dim; k++) {
            const double p = points[k], wide = ldexp(fabs(p), -2 - i % 6);
            points[k] = p - wide, points[a.dim + k] = p + wide;
        }
        box.points = points, box.walk = t->way.bare ? FROE_WALK_PLAIN : FROE_WALK_LCA;
        bench_must(froe_query_range(a.query, &box, &list, &diag), &diag);
        const froe_query_stats s = froe_query_statistics(a.query);
        const double visited = (double)(s.nodes + s.leaves + s.steps), k = (double)s.leaves;
        if (k > 0) worst = fmax(worst, visited / (k * log2((double)t->report.nodes)));
    }
    froe_query_free(a.query);
    return worst;
}

static double pieces_as_promised(const claims_tree *t) {
    for (const froe_promise *p = t->report.promises; p->name; p++)
        if (!strcmp(p->name, "fragments")) return p->measured / p->promised;
    return NAN;
}

const claim claims_berg[] = {
    {.source = "de Berg, theorem 2.5",
     .says = "linear size in uncluttered scenes of space",
     .measured = "exponent of nodes + pieces in n; worst of cuboids, city, terrain",
     .least = 0.9,
     .most = 1.05,
     .measure = claims_growth,
     .of = CLAIMS_PLAN(("cuboids", "city", "terrain"), 1000, 3, claims_size),
     .with = BY_DENSITY,
     .needs = "guards: cuts along the objects in any order",
     .without = {.method = "sorted"}},
    {.source = "de Berg, theorem 2.5",
     .says = "linear size for objects of all scales",
     .measured = "exponent of nodes + pieces in n; worst of nests, shells off centre",
     .least = 0.9,
     .most = 1.03,
     .measure = claims_growth,
     .of = CLAIMS_PLAN(("nests", "shells off centre"), 2000, 3, claims_size),
     .with = BY_DENSITY,
     .needs = "guards: cuts along the objects in any order",
     .without = {.method = "sorted"}},
    {.source = "de Berg, theorem 2.5",
     .says = "few pieces of shells at an odd angle, by guards alone",
     .measured = "pieces / n, 8000 triangles; worst of nests, shells off centre",
     .least = 1,
     .most = 10,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("nests", "shells off centre"), 8000, 0, claims_per_object),
     .with = {.method = "density", .settings = "checks=0"},
     .needs = "guards",
     .without = {.method = "density", .settings = "k=1000000000 checks=0"}},
    {.source = "de Berg, theorem 2.5",
     .says = "a size that follows from k, the leaves and the fragments of the guard stage",
     .measured = "pieces / promised, 4000 triangles; worst of nested-3d, nests, cuboids",
     .least = 0.1,
     .most = 1,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("nested-3d", "nests", "cuboids"), 4000, 0, pieces_as_promised),
     .with = BY_DENSITY,
     .needs = "trials: refinement that is never taken back",
     .without = {.method = "density", .settings = "trials=0"}},
    {.source = "de Berg, theorem 2.5, of points",
     .says = "height O(log n) however they lie",
     .measured = "height / log2 n, 8000 nested points",
     .least = 1,
     .most = 4.5,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("nested points"), 8000, 0, claims_high),
     .with = BY_DENSITY,
     .needs = "balanced cuts below 2 log2 n levels of guard cuts",
     .without = {.method = "density", .settings = "height=0"}},
    {.source = "de Berg, theorem 2.5",
     .says = "linear size in uncluttered scenes of the plane",
     .measured = "exponent of nodes + pieces in n; worst of scatter, rooms, blocks, combs of 16",
     .least = 0.9,
     .most = 1.1,
     .measure = claims_growth,
     .of = CLAIMS_PLAN(("scatter", "rooms", "blocks", "combs"), 1000, 3, claims_size, .lambda = 16),
     .with = BY_DENSITY,
     .needs = "guards: cuts along the objects in any order",
     .without = {.method = "sorted"},
     .kind = CLAIM_QUICK},
    {.source = "de Berg, theorem 2.5",
     .says = "few pieces of objects of all scales",
     .measured = "pieces / n, 8000 triangles of nested-3d",
     .least = 1,
     .most = 10,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("nested-3d"), 8000, 0, claims_per_object),
     .with = BY_DENSITY,
     .needs = "guards",
     .without = UNGUARDED},
    {.source = "de Berg, theorem 2.5",
     .says = "O(n log n) time",
     .measured = "exponent of time / (n log n) in n; worst of scatter, clusters, combs of 16",
     .least = -INFINITY,
     .most = 0.2,
     .measure = claims_time,
     .of = CLAIMS_PLAN(("scatter", "clusters", "combs"), 2000, 4, claims_n_log_n, .lambda = 16),
     .with = BY_DENSITY,
     .needs = "guards: cuts along the objects in any order",
     .without = {.method = "sorted"},
     .kind = CLAIM_TIMED},
    {.source = "de Berg, introduction (Chazelle)",
     .says = "some scenes are quadratic for every partition",
     .measured = "exponent of pieces in n, lines of two saddles",
     .least = 1.8,
     .most = 2.2,
     .measure = claims_of_two,
     .of = &saddles,
     .with = BY_DENSITY,
     .needs = "saddles so close that no plane has room between",
     .without = {.method = "density", .bare = true},
     .kind = CLAIM_QUICK},
    {.source = "de Berg, introduction (Chazelle)",
     .says = "the same",
     .measured = "exponent of pieces in n, lines of two saddles",
     .least = 1.8,
     .most = 2.2,
     .measure = claims_of_two,
     .of = &saddles,
     .with = {.method = "grain"},
     .needs = "saddles so close that no plane has room between",
     .without = {.method = "grain", .bare = true}},
    {.source = "de Berg, lemma 2.1",
     .says = "(2 V - 1)(2^d - 1) + 1 leaves without guards inside",
     .measured = "leaves / bound, worst of ten scenes",
     .least = 0,
     .most = 1,
     .measure = claims_most,
     .of = CLAIMS_PLAN(GUARDED, 600, 0, guarding_leaves_over_bound, .leaf = 1 << 30),
     .with = {.method = "density", .settings = "k=0 form=slabs"},
     .needs = "shrinks: cubes are halved until they are empty",
     .without = {.method = "density", .settings = "k=0 form=slabs", .bare = true},
     .kind = CLAIM_QUICK},
    {.source = "de Berg, lemma 2.8 corrected",
     .says = "clutter <= c_d density, c_2 = 4, c_3 = 8",
     .measured = "clutter found / (c_d density), worst of ten scenes",
     .least = 0,
     .most = 1,
     .measure = claims_most,
     .of = CLAIMS_PLAN(GUARDED, 1000, 0, guarding_clutter_over_density, .leaf = 1 << 30),
     .with = BY_DENSITY,
     .needs = "cubes: slabs meet any number without a guard inside",
     .without = {.method = "density", .bare = true}},
    {.source = "de Berg, section 1",
     .says = "few pieces for the painter",
     .measured = "pieces / n, the most of city, rooms-3d, cuboids",
     .least = 1,
     .most = 2,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("city", "rooms-3d", "cuboids"), 8000, 0, claims_per_object),
     .with = BY_DENSITY,
     .needs = "a choice of cuts: those of the objects, in any order",
     .without = {.method = "sorted"}},
    {.source = "de Berg, theorem 3.1",
     .says = "points are located in O(log n) in trees however deep",
     .measured = "exponent of cost in n; worst of nested, nested-3d",
     .least = -INFINITY,
     .most = 0.5,
     .measure = claims_growth,
     .of = CLAIMS_PLAN(("nested", "nested-3d"), 250, 3, claims_location),
     .with = {DEEP},
     .needs = "the structure for locating: from cut to cut",
     .without = {DEEP, .bare = true}},
    {.source = "de Berg, corollary 3.2",
     .says = "O(log n) for ranges smaller than objects",
     .measured = "exponent of cost in n; worst of nested, scatter, cuboids",
     .least = -INFINITY,
     .most = 0.5,
     .measure = claims_growth,
     .of = CLAIMS_PLAN(("nested", "scatter", "cuboids"), 250, 3, small_range),
     .with = {DEEP},
     .needs = "the structure for locating: from cut to cut",
     .without = {DEEP, .bare = true},
     .kind = CLAIM_QUICK},
    {.source = "de Berg, corollary 3.2",
     .says = "the same in cubes of all sizes, whatever the tree",
     .measured = "exponent of cost in n; worst of nested, scatter, cuboids",
     .least = -INFINITY,
     .most = 0.3,
     .measure = claims_growth,
     .of = CLAIMS_PLAN(("nested", "scatter", "cuboids"), 250, 3, small_range_in_cubes),
     .with = {DEEP},
     .needs = "the cubes: the tree, from cut to cut",
     .without = {DEEP, .bare = true},
     .kind = CLAIM_QUICK},
    {.source = "de Berg, corollary 3.2",
     .says = "whatever the number of sizes",
     .measured = "exponent of cost in n, n boxes of n sizes, windows smaller than each, n = 100 to 800",
     .least = -INFINITY,
     .most = 0.3,
     .measure = claims_growth,
     .of = CLAIMS_PLAN(("octaves"), 100, 3, window_in_octaves),
     .with = {.method = "quad"},
     .needs = "the structure of cubes: from cut to cut",
     .without = {.method = "quad", .bare = true},
     .kind = CLAIM_QUICK},
    {.source = "de Berg, section 2.1",
     .says = "planes separate all disjoint convex objects that are curved",
     .measured = "pairs in one leaf / n, balls of chess boards in R^2 to R^5, 300 and 600 balls",
     .least = 0,
     .most = 0,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("chess balls", "chess balls 3d", "chess balls 4d", "chess balls 5d"), 300, 1, pairs_together),
     .with = BY_DENSITY,
     .needs = "planes between objects: the axes alone",
     .without = {.method = "density", .bare = true}},
    {.source = "de Berg, theorem 2.5",
     .says = "few pieces of curved objects",
     .measured = "pieces / n, the most of balls, balls-3d, chess balls, 1000 to 4000 balls",
     .least = 1,
     .most = 2.5,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("balls", "balls-3d", "chess balls"), 1000, 2, claims_per_object),
     .with = BY_DENSITY,
     .needs = "guards and planes between objects: medians",
     .without = {.method = "kd", .settings = "growth=1000"},
     .kind = CLAIM_QUICK},
    {.source = "de Berg, lemma 3.4",
     .says = "k of m cells met are found in O(k log m)",
     .measured = "worst cost / (k log2 m), windows in quadtrees of nested, nested-3d",
     .least = 0,
     .most = 16,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("nested", "nested-3d"), 2000, 0, cells_met),
     .with = {DEEP},
     .needs = "lowest common ancestors: from cut to cut",
     .without = {DEEP, .bare = true}},
    {0}};
