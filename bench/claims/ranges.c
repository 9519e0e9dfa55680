/* ranges.c: de Berg and Streppel, "Approximate range searching using binary space partitions". */
#include "claims.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define BY_BAR                                                                                                         \
    { .method = "bar" }

/* ------------------------------------------------------- approximate windows -- */

enum { FINEST = 6 };

/** Mean cost of counting in windows of a third of the scene, within 2^-finer of their diameter. */
static double window_cost(claims_asker *a, int finer) {
    froe_diagnostic diag = {0};
    for (int i = 0; i < CLAIMS_QUERIES; i++) {
        double points[2 * FROE_MAX_DIM];
        froe_range box = froe_range_defaults();
        uint64_t count;
        claims_place(a, 0.1, points);
        for (int k = 0; k < a->dim; k++) {
            const double middle = points[k];
            points[k] = middle - a->side / 6;
            points[a->dim + k] = middle + a->side / 6;
        }
        box.points = points, box.eps = ldexp(1, -finer);
        bench_must(froe_query_count(a->query, &box, &count, &diag), &diag);
    }
    return claims_asked(a) / CLAIMS_QUERIES;
}

/** The greatest cost over log2 n + (1 / eps)^(d - 1), times `factor` behind the sum, eps = 1/4 .. 1/64. */
static double cost_over_bound(const claims_tree *t, double lambda, double logs) {
    claims_asker a = claims_ask(t);
    double worst = 0;
    for (int i = 2; i <= FINEST; i++) {
        const double border = pow(ldexp(1, i), a.dim - 1);
        worst = fmax(worst, window_cost(&a, i) / (log2(t->n) + lambda * border * logs));
    }
    froe_query_free(a.query);
    return worst;
}
static double points_cost(const claims_tree *t) {
    return cost_over_bound(t, 1, 1);
}
static double objects_cost(const claims_tree *t) {
    return cost_over_bound(t, fmax(t->lambda, 1), 1);
}
static double segments_cost(const claims_tree *t) {
    return cost_over_bound(t, 1, log2(t->n));
}

/** As promised, and measured anew by every audit. */
static double largest_aspect(const claims_tree *t) {
    const froe_promise *p = t->report.promises;
    while (p->name && strcmp(p->name, "aspect")) p++;
    return p->name ? p->measured : (double)INFINITY;
}

/* --------------------------------------------- segments by way of endpoints -- */

/** A tree of segments beside its plan, the partition of their endpoints that it follows. */
typedef struct conversion {
    claims_tree tree, plan;
} conversion;

static const char *const plans[] = {"from=kd", "from=bar", "from=quad", "from=median", "from=hamsandwich", NULL};

static froe_scene *endpoints_of(const froe_scene *scene) {
    froe_diagnostic diag = {0};
    froe_scene *points;
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_POINT;
    batch.count = froe_scene_vertex_count(scene);
    batch.coords = froe_scene_vertex(scene, 0);
    bench_must(froe_scene_new(2, NULL, &points), &diag);
    bench_must(froe_scene_add(points, &batch, &diag), &diag);
    return points;
}

/** The greatest, over the five plans and the scenes, of a number; `method` converts, or another tree stands for it. */
typedef double conversion_fn(const conversion *c);
static double worst_conversion(const claims_way *way, conversion_fn *fn) {
    static const char *const kinds[] = {"disjoint", "parallel", "spiral", "star", "nested", "combs", NULL};
    enum { SEGMENTS = 1000 };
    double worst = 0;
    for (const char *const *kind = kinds; *kind; kind++)
        for (const char *const *plan = plans; *plan; plan++) {
            const claims_way from = {.method = "converted", .settings = *plan};
            const claims_way with = {.method = way->method, .settings = way->settings ? way->settings : *plan};
            conversion c = {.tree = claims_build(*kind, SEGMENTS, 0, &with, FROE_LEAF_OWN)};
            c.plan = claims_build_of(endpoints_of(c.tree.scene), &from, FROE_LEAF_OWN);
            worst = fmax(worst, fn(&c));
            claims_free(&c.tree);
            claims_free(&c.plan);
        }
    return worst;
}

/* At least log2 n: where many endpoints lie on a line, one cut takes all of them, and a plan may be lower. */
static double height_of_plan(const conversion *c) {
    return fmax(claims_height(&c->plan), log2(c->tree.n));
}

static double height_over_plan(const conversion *c) {
    return claims_height(&c->tree) / height_of_plan(c);
}
static double converted_height(const claims_way *way, const void *of) {
    (void)of;
    return worst_conversion(way, height_over_plan);
}
static double size_over_plan(const conversion *c) {
    return claims_size(&c->tree) / (c->tree.n * height_of_plan(c));
}
static double converted_size(const claims_way *way, const void *of) {
    (void)of;
    return worst_conversion(way, size_over_plan);
}

/* Exact windows of all sizes: nodes over (v + k) height, where the plan has v cells that they meet. */
static double visits_over_plan(const conversion *c) {
    claims_asker of_tree = claims_ask(&c->tree), of_plan = claims_ask(&c->plan);
    froe_diagnostic diag = {0};
    double worst = 0;
    for (int i = 0; i < CLAIMS_QUERIES; i++) {
        double points[4];
        uint64_t k, endpoints;
        froe_range box = froe_range_defaults();
        const double side = of_tree.side * ldexp(0.5, -(i % 8));
        claims_place(&of_tree, 0.1, points);
        for (int axis = 0; axis < 2; axis++) points[2 + axis] = points[axis] + side;
        box.points = points, box.walk = FROE_WALK_PLAIN;
        bench_must(froe_query_count(of_tree.query, &box, &k, &diag), &diag);
        bench_must(froe_query_count(of_plan.query, &box, &endpoints, &diag), &diag);
        const double nodes = (double)froe_query_statistics(of_tree.query).nodes;
        const double v = (double)froe_query_statistics(of_plan.query).leaves;
        worst = fmax(worst, nodes / ((v + (double)k) * height_of_plan(c)));
    }
    froe_query_free(of_tree.query);
    froe_query_free(of_plan.query);
    return worst;
}
static double converted_visits(const claims_way *way, const void *of) {
    (void)of;
    return worst_conversion(way, visits_over_plan);
}

const claim claims_ranges[] = {
    {.source = "de Berg and Streppel, theorem 1 (i)",
     .says = "height O(depth) of any plan",
     .measured = "height / height of the plan, worst of kd, bar, quad, median, hamsandwich and six scenes",
     .least = 1,
     .most = 3,
     .measure = converted_height,
     .with = {.method = "converted"},
     .needs = "the plan: cuts along the objects in any order",
     .without = {.method = "sorted", .settings = ""}},
    {.source = "de Berg and Streppel, theorem 1 (ii)",
     .says = "size O(n depth)",
     .measured = "size / (n height of the plan), worst of the same plans and scenes",
     .least = 0.1,
     .most = 1.5,
     .measure = converted_size,
     .with = {.method = "converted"},
     .needs = "the plan: cuts along the objects in any order",
     .without = {.method = "sorted", .settings = ""}},
    {.source = "de Berg and Streppel, theorem 1 (iii)",
     .says = "O((v + k) depth) nodes visited",
     .measured = "nodes / ((v + k) height of the plan), worst window of the same plans and scenes",
     .least = 0,
     .most = 10,
     .measure = converted_visits,
     .with = {.method = "converted"},
     .needs = "the plan: cuts along the objects in any order",
     .without = {.method = "sorted", .settings = ""}},
    {.source = "de Berg and Streppel, corollary 2",
     .says = "O(log n + 1 / eps) for points",
     .measured = "cost / (log2 n + 1 / eps), the most of points, columns, 4000 to 32000 points, eps = 1/4 .. 1/64",
     .least = 0,
     .most = 8,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("points", "columns"), 4000, 3, points_cost),
     .with = BY_BAR,
     .needs = "fat cells: medians of the axes in turn",
     .without = {.method = "kd", .settings = "axes=cycle"}},
    {.source = "de Berg and Streppel, corollary 2",
     .says = "O(log n / eps) for disjoint segments",
     .measured = "cost / (log2 n / eps), disjoint, 4000 to 16000 segments, eps = 1/4 .. 1/64",
     .least = 0,
     .most = 2,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("disjoint"), 4000, 2, segments_cost),
     .with = {.method = "converted", .settings = "from=bar"},
     .needs = "fat cells and the plan: cuts along the objects at random",
     .without = {.method = "autopartition"}},
    {.source = "de Berg and Streppel, section 2 (Duncan et al.)",
     .says = "height O(log n) for points, however they lie",
     .measured = "height / log2 n, 8000 points at distances 2^-1 .. 2^-400",
     .least = 1,
     .most = 6,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("nested points"), 8000, 0, claims_high),
     .with = BY_BAR,
     .needs = "cuts across corners: cubes are halved",
     .without = {.method = "quad"},
     .kind = CLAIM_QUICK},
    {.source = "de Berg and Streppel, section 2 (Duncan et al.)",
     .says = "height O(log n) for points beyond space, however they lie",
     .measured = "height / log2 n, the more of R^4 and R^8, 8000 points at distances 2^-1 .. 2^-400",
     .least = 1,
     .most = 6,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("nested points in R^4", "nested points in R^8"), 8000, 0, claims_high),
     .with = BY_BAR,
     .needs = "oblique cuts: cubes are halved",
     .without = {.method = "bar", .settings = "directions=0"},
     .kind = CLAIM_QUICK},
    {.source = "de Berg and Streppel, section 2 (Duncan et al.)",
     .says = "fat cells beyond space",
     .measured = "the largest aspect of a cell, as the audit measures it, of the same points, 1000",
     .least = 1,
     .most = 29,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("nested points in R^4", "nested points in R^8"), 1000, 0, largest_aspect),
     .with = BY_BAR,
     .needs = "cuts that leave both parts fat: the bound is 4000",
     .without = {.method = "bar", .settings = "aspect=4000"},
     .kind = CLAIM_QUICK},
    {.source = "de Berg and Streppel, theorem 3 (i)",
     .says = "height O(log n)",
     .measured = "height / log2 n, the most of scatter, cuboids, nested, nested-3d, n = 1000 to 4000",
     .least = 1,
     .most = 4,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("scatter", "cuboids", "nested", "nested-3d"), 1000, 2, claims_high),
     .with = BY_BAR,
     .needs = "cuts across corners: cubes are halved",
     .without = {.method = "quad"}},
    {.source = "de Berg and Streppel, theorem 3 (ii)",
     .says = "size O(lambda n): in n",
     .measured = "exponent of nodes + pieces in n; worst of scatter, rooms, cuboids, combs of 16",
     .least = 0.9,
     .most = 1.1,
     .measure = claims_growth,
     .of = CLAIMS_PLAN(("scatter", "rooms", "cuboids", "combs"), 1000, 3, claims_size, .lambda = 16),
     .with = BY_BAR,
     .needs = "guards: cuts along the objects in any order",
     .without = {.method = "sorted"}},
    {.source = "de Berg and Streppel, theorem 3 (ii)",
     .says = "size O(lambda n): in lambda",
     .measured =
         "exponent of nodes + pieces in lambda, 1024 triangles, cards and lines of saddles in groups of 16 .. 128",
     .least = -INFINITY,
     .most = 1.1,
     .measure = claims_by_lambda,
     .of = CLAIMS_PLAN(("cards", "saddles"), 1024, 3, claims_size, .lambda = 16),
     .with = BY_BAR,
     .needs = "guards: cuts along the objects in any order",
     .without = {.method = "sorted"}},
    {.source = "de Berg and Streppel, theorem 3 (iii)",
     .says = "O(log n + lambda / eps) in the plane",
     .measured = "cost / (log2 n + lambda / eps), the most of scatter, twigs, combs of 4, 4000 to 16000 segments",
     .least = 0,
     .most = 5,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("scatter", "twigs", "combs"), 4000, 2, objects_cost, .lambda = 4),
     .with = BY_BAR,
     .needs = "fat cells: medians of the axes in turn",
     .without = {.method = "kd", .settings = "axes=cycle"}},
    {.source = "de Berg and Streppel, theorem 3 (iii)",
     .says = "O(log n + lambda / eps^2) in space",
     .measured = "cost / (log2 n + lambda / eps^2), the most of triangles, petals, cards of 4, 4000 to 16000 triangles",
     .least = 0,
     .most = 5,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("triangles", "petals", "cards"), 4000, 2, objects_cost, .lambda = 4),
     .with = BY_BAR,
     .needs = "fat cells: medians of the axes in turn",
     .without = {.method = "kd", .settings = "axes=cycle"}},
    {0}};
