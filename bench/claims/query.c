/* claims_query.c: what the sources say of the cost of queries, as numbers of visited nodes. */
#include "claims.h"
#include <froe/query.h>
#include <math.h>
#include <stdlib.h>

enum { QUERIES = 300 };

typedef struct asker {
    froe_query *query;
    const froe_scene *scene;
    int dim;
    double side; /* longest of the scene */
    uint64_t state;
} asker;

static asker begin(const claims_tree *t) {
    asker a = {.scene = t->scene, .dim = froe_scene_dim(t->scene), .state = 1};
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    if (froe_query_new(t->tree, &a.query, NULL) || !froe_scene_bounds(t->scene, lo, hi)) exit(1);
    for (int k = 0; k < a.dim; k++) a.side = fmax(a.side, hi[k] - lo[k]);
    return a;
}

static double draw(asker *a) {
    a->state = a->state * 6364136223846793005u + 1442695040888963407u;
    return (double)(a->state >> 11) * 0x1p-53;
}

/* A corner of a random object, moved by a random part of `away` sides of the scene. */
static void draw_place(asker *a, double away, double *out) {
    const uint32_t object = (uint32_t)(draw(a) * (double)froe_scene_object_count(a->scene));
    const double *p = froe_scene_vertex(a->scene, froe_scene_corner(a->scene, object, 0));
    for (int k = 0; k < a->dim; k++) out[k] = p[k] + away * a->side * (2 * draw(a) - 1);
}

/* Asks a kind of query many times; nodes, leaves and tests of all of them, divided by their number. */
typedef froe_status ask_fn(asker *a, double parameter);
static double cost(const claims_tree *t, ask_fn *fn, double parameter) {
    asker a = begin(t);
    for (int i = 0; i < QUERIES; i++)
        if (fn(&a, parameter)) exit(1);
    const froe_query_stats s = froe_query_statistics(a.query);
    froe_query_free(a.query);
    return (double)(s.nodes + s.leaves + s.tests) / QUERIES;
}

static froe_status locate(asker *a, double away) {
    double point[FROE_MAX_DIM];
    froe_list list;
    draw_place(a, away, point);
    return froe_query_locate(a->query, point, &list, NULL);
}

/* A ball much smaller than any object. */
static froe_status tiny_ball(asker *a, double radius) {
    double centre[FROE_MAX_DIM];
    froe_range ball = froe_range_defaults();
    froe_list list;
    draw_place(a, radius, centre);
    ball.shape = FROE_SHAPE_BALL;
    ball.points = centre;
    ball.radius = radius * a->side;
    return froe_query_range(a->query, &ball, &list, NULL);
}

/* Is anything counted in a window of a third of the scene, within eps of its diameter? */
static froe_status window(asker *a, double eps) {
    double points[2 * FROE_MAX_DIM];
    froe_range box = froe_range_defaults();
    uint64_t count;
    draw_place(a, 0.1, points);
    for (int k = 0; k < a->dim; k++) {
        const double middle = points[k];
        points[k] = middle - a->side / 6;
        points[a->dim + k] = middle + a->side / 6;
    }
    box.points = points;
    box.eps = eps;
    return froe_query_count(a->query, &box, &count, NULL);
}

/* ----------------------------------------------------------------- in n, in eps -- */

static double growth(const char *kind, size_t from, int doublings, const char *method, ask_fn *fn, double parameter) {
    claims_series s = {.count = 0};
    for (int i = 0; i <= doublings; i++) {
        claims_tree t = claims_build(kind, from << i, method, NULL, FROE_LEAF_OWN);
        claims_add(&s, (double)t.report.objects, cost(&t, fn, parameter));
        claims_free(&t);
    }
    return claims_slope(&s);
}

/* The guard stage alone, which is as deep as scenes are nested. */
static claims_tree deep(size_t n) {
    return claims_build("nested", n, "density", "k=1 stop=0 growth=0 height=0", FROE_LEAF_OWN);
}
static double deep_height(void) {
    claims_tree t = deep(3200);
    const double height = t.report.mean_depth / log2((double)t.report.objects);
    claims_free(&t);
    return height;
}
static double deep_location(void) {
    claims_tree t = deep(3200);
    const double visited = cost(&t, locate, 0) / t.report.mean_depth;
    claims_free(&t);
    return visited;
}
static double location(void) {
    return fmax(growth("scatter", 2000, 5, "density", locate, 0.01),
                growth("cuboids", 2000, 5, "density", locate, 0.01));
}
static double small_ranges(void) {
    return fmax(growth("scatter", 2000, 5, "density", tiny_ball, 1e-6),
                growth("cuboids", 2000, 5, "density", tiny_ball, 1e-6));
}

/* Exponent of the cost in 1 / eps. */
static double by_eps(const char *kind, size_t n, const char *method, const char *settings) {
    claims_series s = {.count = 0};
    claims_tree t = claims_build(kind, n, method, settings, FROE_LEAF_OWN);
    for (int i = 2; i <= 6; i++) claims_add(&s, ldexp(1, i), cost(&t, window, ldexp(1, -i)));
    claims_free(&t);
    return claims_slope(&s);
}
static double bar_plane_by_eps(void) {
    return by_eps("scatter", 60000, "bar", NULL);
}
static double bar_by_n(void) {
    return growth("scatter", 8000, 4, "bar", window, 0.125);
}
static double bar_space_by_eps(void) {
    return by_eps("triangles", 30000, "bar", NULL);
}
/* Points that crowd around the origin, closer and closer: 2^-1 .. 2^-400 from it. */
static froe_scene *nested_points(size_t n) {
    double *xy = calloc(2 * n, sizeof *xy);
    froe_scene *scene = NULL;
    froe_objects o = froe_objects_defaults();
    for (size_t i = 0; i < n; i++) {
        const double t = 1 + (double)i / (double)n, away = ldexp(1, -(int)(i % 400));
        xy[2 * i] = away * t, xy[2 * i + 1] = away * (3 - t);
    }
    o.kind = FROE_POINT, o.count = n, o.coords = xy;
    if (froe_scene_new(2, NULL, &scene) || froe_scene_add(scene, &o, NULL)) exit(1);
    free(xy);
    return scene;
}
static double nested_height(const char *method) {
    froe_scene *scene = nested_points(8000);
    froe_tree *tree = bench_build(scene, method, NULL, 1, 1, NULL);
    const double height = (double)froe_tree_report(tree).height / log2(8000);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return height;
}
static double bar_height(void) {
    return nested_height("bar");
}
static double quad_height(void) {
    return nested_height("quad");
}

/* ------------------------------------------------- segments by way of endpoints -- */

/* A converted tree beside the kd-tree of the endpoints, its plan. */
typedef struct conversion {
    claims_tree tree, plan;
    double n, height; /* height of the plan */
} conversion;

static froe_scene *endpoints_of(const froe_scene *scene) {
    froe_scene *points;
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_POINT;
    batch.count = froe_scene_vertex_count(scene);
    batch.coords = froe_scene_vertex(scene, 0);
    if (froe_scene_new(2, NULL, &points) || froe_scene_add(points, &batch, NULL)) exit(1);
    return points;
}

static conversion convert(const char *kind, size_t n) {
    conversion c = {.tree = claims_build(kind, n, "converted", NULL, FROE_LEAF_OWN)};
    c.plan.scene = endpoints_of(c.tree.scene);
    c.plan.tree = bench_build(c.plan.scene, "kd", NULL, 1, 1, NULL);
    c.plan.report = froe_tree_report(c.plan.tree);
    c.n = (double)c.tree.report.objects;
    c.height = (double)c.plan.report.height;
    return c;
}

static void conversion_free(conversion *c) {
    claims_free(&c->tree);
    claims_free(&c->plan);
}

static const char *const disjoint_kinds[] = {"disjoint", "parallel", "spiral", "star", "nested", NULL};

/* The worst over disjoint segments of a number of their conversion. */
typedef double conversion_fn(const conversion *c);
static double worst_conversion(conversion_fn *fn) {
    double worst = 0;
    for (const char *const *kind = disjoint_kinds; *kind; kind++) {
        conversion c = convert(*kind, 8000);
        worst = fmax(worst, fn(&c));
        conversion_free(&c);
    }
    return worst;
}

static double height_over_plan(const conversion *c) {
    return (double)c->tree.report.height / c->height;
}
static double converted_height(void) {
    return worst_conversion(height_over_plan);
}
static double size_over_plan(const conversion *c) {
    return (double)c->tree.report.size / (c->n * c->height);
}
static double converted_size(void) {
    return worst_conversion(size_over_plan);
}

/* Windows of a third of the scene, exact: nodes over (v + k) height, where the plan has v cells that they meet. */
static double visits_over_plan(const conversion *c) {
    asker of_tree = begin(&c->tree), of_plan = begin(&c->plan);
    double worst = 0;
    for (int i = 0; i < QUERIES; i++) {
        double points[4];
        uint64_t k, endpoints;
        froe_range box = froe_range_defaults();
        const double side = of_tree.side * ldexp(0.5, -(i % 8)); /* of all sizes */
        draw_place(&of_tree, 0.1, points);
        for (int axis = 0; axis < 2; axis++) points[2 + axis] = points[axis] + side;
        box.points = points;
        if (froe_query_count(of_tree.query, &box, &k, NULL)) exit(1);
        if (froe_query_count(of_plan.query, &box, &endpoints, NULL)) exit(1);
        const double nodes = (double)froe_query_statistics(of_tree.query).nodes;
        const double v = (double)froe_query_statistics(of_plan.query).leaves;
        worst = fmax(worst, nodes / ((v + (double)k) * c->height));
    }
    froe_query_free(of_tree.query);
    froe_query_free(of_plan.query);
    return worst;
}
static double converted_visits(void) {
    return worst_conversion(visits_over_plan);
}
static double converted_by_eps(void) {
    return fmax(by_eps("disjoint", 60000, "converted", "from=bar"), by_eps("parallel", 8000, "converted", "from=bar"));
}

const claim claims_query[] = {
    {"de Berg, theorem 3.1", "guard stages may be far deeper than log n", "density", "mean depth / log2 n, nested", 20,
     200, deep_height},
    {"de Berg, theorem 3.1", "and yet points are located in O(log n)", "density",
     "(nodes + leaves + tests) / mean depth, the same tree", 0, 0.2, deep_location},
    {"de Berg, theorem 3.1", "the same elsewhere", "density",
     "exponent of nodes + leaves + tests in n; worse of scatter, cuboids", -INFINITY, 0.3, location},
    {"de Berg, corollary 3.2", "O(log n) for ranges smaller than objects", "density",
     "exponent of nodes + leaves + tests in n; worse of scatter, cuboids", -INFINITY, 0.3, small_ranges},
    {"de Berg and Streppel, corollary 2", "O(log n + 1 / eps) in the plane", "bar",
     "exponent of nodes + leaves + tests in 1 / eps, scatter", -INFINITY, 1.15, bar_plane_by_eps},
    {"de Berg and Streppel, corollary 2", "and whatever n", "bar",
     "exponent of nodes + leaves + tests in n, eps = 1/8, scatter", -INFINITY, 0.25, bar_by_n},
    {"de Berg and Streppel, theorem 3", "O(log n + lambda / eps^2) in space", "bar",
     "exponent of nodes + leaves + tests in 1 / eps, triangles", -INFINITY, 2.1, bar_space_by_eps},
    {"de Berg and Streppel, theorem 1 (i)", "height O(depth) of the BSP of points", "converted",
     "height / height of the kd-tree of endpoints, worst of five scenes", 1, 3, converted_height},
    {"de Berg and Streppel, theorem 1 (ii)", "size O(n depth)", "converted",
     "size / (n height of the kd-tree of endpoints), worst of five scenes", 0.1, 1.2, converted_size},
    {"de Berg and Streppel, theorem 1 (iii)", "O((v + k) depth) nodes visited", "converted",
     "nodes / ((v + k) height of the kd-tree of endpoints), worst window of five scenes", 0, 3, converted_visits},
    {"de Berg and Streppel, corollary 2", "O(log n / eps) for disjoint segments", "converted",
     "exponent of nodes + leaves + tests in 1 / eps, converted from bar; worse of disjoint, parallel", -INFINITY, 1.05,
     converted_by_eps},
    {"de Berg and Streppel, section 2 (Duncan et al.)", "height O(log n) for points, however they lie", "bar",
     "height / log2 n, 8000 points at distances 2^-1 .. 2^-400", 1, 6, bar_height},
    {"the same, for comparison", "other trees of fat cells are as high as points are nested", "quad",
     "height / log2 n, the same points", 15, 200, quad_height},
    {0}};
