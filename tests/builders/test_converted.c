/* test_converted.c: plans of endpoints, their locations and T-junctions, by brute force; what a converted tree owes to
 * its plan: size, height, cells met; balance along chords; every way to plan, on every kind of scene. */
#include "build/conversion/chord.h"
#include "build/conversion/convert.h"
#include "build/conversion/ham_sandwich.h"
#include "build/options.h"
#include "tree/tree.h"
#include <froe/io.h>
#include <froe/query.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "support/memory.h"

static const char *const plans[] = {"kd", "quad", "median", "bar", "hamsandwich"};
enum { PLANS = sizeof plans / sizeof *plans };

static froe_scene *generate(const char *kind, size_t n) {
    froe_scene *scene = NULL;
    assert_int_equal(froe_generate(kind, n, 3, NULL, &scene, NULL), FROE_OK);
    return scene;
}

static froe_status try_build(froe_scene *scene, const char *method, const char *settings, uint32_t leaf,
                             froe_tree **tree, froe_diagnostic *diag) {
    froe_build_options o = froe_build_defaults();
    o.method = method;
    o.settings = settings;
    o.leaf = leaf;
    o.threads = 1;
    return build_tuned(scene, &o, tree, diag);
}

static froe_tree *build(froe_scene *scene, const char *method, const char *settings, uint32_t leaf) {
    froe_diagnostic diag = {0};
    froe_tree *tree = NULL;
    if (try_build(scene, method, settings, leaf, &tree, &diag)) fail_msg("%s: %s", method, diag.message);
    return tree;
}

static froe_tree *convert(froe_scene *scene, const char *from, const char *more, uint32_t leaf) {
    char settings[80];
    snprintf(settings, sizeof settings, "from=%s %s", from, more);
    return build(scene, "converted", settings, leaf);
}

static void audit(const froe_tree *tree, const char *what) {
    froe_audit_options exact = froe_audit_defaults();
    froe_diagnostic diag = {0};
    exact.exact_only = true;
    if (froe_tree_audit(tree, &exact, &diag)) fail_msg("%s: %s", what, diag.message);
}

/** All endpoints, each once: what the plan is made of. */
static froe_scene *endpoints(const froe_scene *scene) {
    froe_scene *points = NULL;
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_POINT;
    batch.count = froe_scene_vertex_count(scene);
    batch.coords = froe_scene_vertex(scene, 0);
    assert_int_equal(froe_scene_new(2, NULL, &points), FROE_OK);
    assert_int_equal(froe_scene_add(points, &batch, NULL), FROE_OK);
    return points;
}

/* --------------------------------------------------------------- point trees -- */

typedef struct planned {
    num_context context;
    point_tree plan;
} planned;

/** The plan that medians make, cuts across the axes in turn. */
static void plan_by_medians(planned *p, const froe_scene *scene, uint32_t node, uint32_t *vertex, size_t count,
                            int axis) {
    size_t below = 0, above = 0;
    uint32_t child;
    if (count < 2) return;
    for (size_t i = 1; i < count; i++) /* insertion sort */
        for (size_t j = i; j && scene_vertex(scene, vertex[j])[axis] < scene_vertex(scene, vertex[j - 1])[axis]; j--) {
            uint32_t swap = vertex[j];
            vertex[j] = vertex[j - 1];
            vertex[j - 1] = swap;
        }
    double value = scene_vertex(scene, vertex[count / 2])[axis];
    froe_cut cut = {.kind = FROE_CUT_AXIS, .axis = axis, .value = value};
    assert_int_equal(point_tree_split(&p->plan, node, &cut, &child), FROE_OK);
    while (scene_vertex(scene, vertex[below])[axis] < value) below++;
    while (scene_vertex(scene, vertex[count - 1 - above])[axis] > value) above++;
    plan_by_medians(p, scene, child, vertex, below, 1 - axis);
    plan_by_medians(p, scene, child + 1, vertex + count - above, above, 1 - axis);
}

static void plan_begin(planned *p, const froe_scene *scene) {
    froe_allocator alloc = support_allocator(NULL);
    assert_int_equal(num_context_new(&alloc, &p->context), FROE_OK);
    assert_int_equal(point_tree_new(&alloc, scene, &p->plan), FROE_OK);
}

static void plan_end(planned *p) {
    point_tree_free(&p->plan);
    num_context_free(&p->context);
}

/** Each endpoint is carried down by comparisons alone. */
static void expect_homes(const planned *p, const froe_scene *scene) {
    for (uint32_t v = 0; v < scene->vertex_count; v++) {
        bool *inside = calloc(p->plan.nodes.count, sizeof *inside);
        inside[0] = true;
        for (uint32_t i = 0; i < p->plan.nodes.count; i++) { /* children come after their parents */
            const point_node *n = p->plan.nodes.data + i;
            assert_int_equal(point_tree_holds(&p->plan, i, v), inside[i]);
            if (n->cut.kind == FROE_CUT_NONE || !inside[i]) continue;
            double x = scene_vertex(scene, v)[n->cut.axis];
            inside[n->child] = x < n->cut.value;
            inside[n->child + 1] = x > n->cut.value;
        }
        free(inside);
    }
}

/** The box of a node, and which nodes made its sides: [axis][0 low, 1 high]. */
typedef struct node_box {
    double at[2][2];
    uint32_t by[2][2];
} node_box;

/** Each cut ends on two sides of its box. */
static void expect_junctions(const planned *p) {
    size_t n = p->plan.nodes.count, found = 0;
    node_box *box = calloc(n, sizeof *box);
    box[0] =
        (node_box){{{-INFINITY, INFINITY}, {-INFINITY, INFINITY}}, {{FROE_NONE, FROE_NONE}, {FROE_NONE, FROE_NONE}}};
    for (uint32_t i = 0; i < n; i++) {
        const point_node *v = p->plan.nodes.data + i;
        if (v->cut.kind == FROE_CUT_NONE) continue;
        int axis = v->cut.axis, other = 1 - axis;
        for (uint32_t s = 0; s < 2; s++) {
            uint32_t by = box[i].by[other][s];
            box[v->child + s] = box[i];
            box[v->child + s].at[axis][1 - s] = v->cut.value;
            box[v->child + s].by[axis][1 - s] = i;
            if (by == FROE_NONE) continue; /* it ends at side s of the box: beyond the cut of `by`, on its side 1 - s */
            double x = v->cut.value;
            assert_true(point_tree_junction(&p->plan, by, s ? 0 : 1, nextafter(x, -INFINITY), nextafter(x, INFINITY)));
            found++;
        }
    }
    assert_int_equal(found, p->plan.junctions.count);
    free(box);
}

static void plans_know_homes_and_junctions(void **state) {
    static const char *const kinds[] = {"disjoint", "mixed", "clusters", "parallel"};
    (void)state;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        froe_scene *scene = generate(kinds[k], 150);
        planned p;
        plan_begin(&p, scene);
        uint32_t *vertex = malloc(scene->vertex_count * sizeof *vertex);
        for (uint32_t i = 0; i < scene->vertex_count; i++) vertex[i] = i;
        plan_by_medians(&p, scene, 0, vertex, scene->vertex_count, 0);
        assert_int_equal(point_tree_finish(&p.plan, &p.context), FROE_OK);
        expect_homes(&p, scene);
        expect_junctions(&p);
        free(vertex);
        plan_end(&p);
        froe_scene_free(scene);
    }
}

/* ---------------------------------------------------------- ham-sandwich cuts -- */

static int beside(planned *p, const froe_cut *cut, uint32_t vertex) {
    geom_plane plane = scene_cut_plane(p->plan.scene, cut);
    return geom_side_vertex(&p->context, &plane, scene_vertex(p->plan.scene, vertex));
}

/** Both children of a node are halved by one line. */
static void sandwiches_halve_both_sides(void **state) {
    static const char *const kinds[] = {"segments", "clusters", "parallel", "spiral"};
    (void)state;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        froe_scene *scene = generate(kinds[k], 300);
        base_task task;
        planned p;
        int shared = 0;
        base_task_init(&task, 1, NULL, NULL);
        plan_begin(&p, scene);
        assert_int_equal(point_tree_by_ham_sandwich(&p.plan, &p.context, &task), FROE_OK);
        assert_int_equal(point_tree_finish(&p.plan, &p.context), FROE_OK);
        for (uint32_t i = 0; i < p.plan.nodes.count; i++) {
            const point_node *n = p.plan.nodes.data + i;
            int sides[3] = {0, 0, 0}, held = 0;
            for (uint32_t v = 0; v < scene->vertex_count; v++) {
                if (!point_tree_holds(&p.plan, i, v)) continue;
                held++;
                if (n->cut.kind != FROE_CUT_NONE) sides[1 + beside(&p, &n->cut, v)]++;
            }
            if (n->cut.kind == FROE_CUT_NONE) {
                assert_true(held <= 1);
                continue;
            }
            assert_true(abs(sides[0] - sides[2]) <= (held > 4 ? 2 : 3)); /* one tie in doubles */
            const froe_cut *a = &p.plan.nodes.data[n->child].cut, *b = &p.plan.nodes.data[n->child + 1].cut;
            bool same = a->kind == FROE_CUT_VERTICES && b->kind == FROE_CUT_VERTICES;
            shared += same && a->id[0] == b->id[0] && a->id[1] == b->id[1];
        }
        assert_true(shared > 60);
        assert_true(p.plan.height <= 1.5 * log2(scene->vertex_count) + 2);
        plan_end(&p);
        froe_scene_free(scene);
    }
}

/* --------------------------------------------------------------------- chords -- */

/** The least weight of a heavier side, over all chords. */
static uint64_t least_heavier(const chord_search *s, const froe_scene *scene, uint64_t *of_chosen, uint32_t chosen) {
    uint64_t least = UINT64_MAX;
    for (uint32_t i = 0; i < s->items.count; i++) {
        if (s->items.data[i].weight > 1) continue;
        const double *p = scene_point(scene, s->items.data[i].item, 0);
        const double *q = scene_point(scene, s->items.data[i].item, 1);
        uint64_t weight[2] = {0, 0};
        for (uint32_t j = 0; j < s->items.count; j++) {
            const double *m = s->items.data[j].middle;
            bool left = (q[0] - p[0]) * (m[1] - p[1]) - (q[1] - p[1]) * (m[0] - p[0]) > 0;
            if (j != i) weight[left] += s->items.data[j].weight;
        }
        uint64_t heavier = weight[0] > weight[1] ? weight[0] : weight[1];
        least = heavier < least ? heavier : least;
        if (s->items.data[i].item == chosen) *of_chosen = heavier;
    }
    return least;
}

/** Chords across the four corners of a square and through it, none of which meet, and short segments between them. */
static void the_best_chord_is_found(void **state) {
    enum { N = 120, LEAST = 40 };
    (void)state;
    for (uint64_t seed = 0; seed < 30; seed++) {
        double x[4 * N];
        for (int i = 0; i < N; i++) {
            double *s = x + 4 * i, u = ((double)((i * 7 + seed * 13) % N) + 0.5) / N, d = 0.9 * u;
            int class = i < LEAST ? (int)(i + seed) % 5 : 5;
            double sx = class & 1 ? 1 : -1, sy = class & 2 ? 1 : -1;
            if (class < 4) /* a corner is cut off */
                s[0] = sx, s[1] = sy * (1 - d), s[2] = sx * (1 - d), s[3] = sy;
            else if (class == 4) /* between the corners, from below upwards */
                s[0] = 0.09 * u - 0.045, s[1] = -1, s[2] = 0.09 * u - 0.045, s[3] = 1;
            else
                s[0] = s[2] = 0.05 + 0.04 * u, s[1] = 0.8 * u - 0.4, s[3] = s[1] + 0.01;
        }
        froe_scene *scene = NULL;
        froe_objects batch = froe_objects_defaults();
        froe_allocator alloc = support_allocator(NULL);
        split_set set;
        chord_search search = {.items = {0}};
        split_cell cell = {.path = seed, .count = N};
        batch.kind = FROE_SEGMENT;
        batch.count = N;
        batch.coords = x;
        assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
        assert_int_equal(froe_scene_add(scene, &batch, NULL), FROE_OK);
        assert_int_equal(split_set_new(scene, &alloc, &set), FROE_OK);
        assert_true(array_reserve(&alloc, &set.items, N));
        for (uint32_t i = 0; i < N; i++) set.items.data[i] = (split_fragment){.object = i};
        set.items.count = N;
        assert_true(chord_begin(&search, &set, &cell));
        for (uint32_t i = 0; i < N; i++) chord_add(&search, &set, &cell, i, i < LEAST);
        uint64_t mine = UINT64_MAX, least;
        uint32_t chosen = chord_choose(&search, &set, &cell, seed);
        assert_true(chosen < LEAST);
        least = least_heavier(&search, scene, &mine, chosen);
        assert_int_equal(mine, least);
        chord_free(&alloc, &search);
        split_set_free(&set);
        froe_scene_free(scene);
    }
}

/* ---------------------------------------------------------------- whole trees -- */

static double promised(const froe_tree *tree) {
    const froe_promise *p = froe_tree_report(tree).promises;
    assert_string_equal(p->name, "fragments");
    return p->promised;
}

/** Theorem 1 on disjoint segments: nothing is split but by the plan; size and height follow from that of the plan. */
static void size_and_height_follow_the_plan(void **state) {
    static const char *const kinds[] = {"disjoint", "parallel", "spiral", "star", "nested"};
    static const char *const methods[][2] = {
        {"kd", NULL}, {"quad", NULL}, {"kd", "axes=first"}, {"bar", NULL}}; /* of plans[] */
    (void)state;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
            froe_scene *scene = generate(kinds[k], 2000), *points = endpoints(scene);
            froe_tree *plan = build(points, methods[i][0], methods[i][1], 1), *tree = convert(scene, plans[i], "", 1);
            froe_report r = froe_tree_report(tree);
            double n = (double)r.objects, height = (double)froe_tree_report(plan).height;
            assert_true(promised(tree) == n * (1 + 2 * height)); /* no cut along a segment splits another */
            assert_true((double)r.size <= 1.2 * n * (1 + height));
            double most = i < 3 ? 2.5 : 3; /* cells of bar have up to eight sides, and chords cut off as many corners */
            assert_true((double)r.height <= most * height + 3);
            froe_tree_free(plan);
            froe_tree_free(tree);
            froe_scene_free(points);
            froe_scene_free(scene);
        }
}

/** Pruning spares nodes and changes no piece. */
static void pruning_spares_nodes_alone(void **state) {
    static const char *const kinds[] = {"disjoint", "parallel", "mixed", "polylines"};
    uint64_t spared = 0;
    (void)state;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        for (size_t i = 0; i < PLANS; i++) {
            froe_scene *scene = generate(kinds[k], 1500);
            froe_tree *pruned = convert(scene, plans[i], "prune=yes", 1),
                      *all = convert(scene, plans[i], "prune=no", 1);
            assert_int_equal(froe_tree_report(pruned).fragments, froe_tree_report(all).fragments);
            assert_true(pruned->node_count <= all->node_count);
            spared += all->node_count - pruned->node_count;
            froe_tree_free(pruned);
            froe_tree_free(all);
            froe_scene_free(scene);
        }
    assert_true(spared > 5000);
}

static froe_query_stats met(froe_query *q, const froe_range *window, uint64_t *found) {
    froe_query_statistics(q);
    assert_int_equal(froe_query_count(q, window, found, NULL), FROE_OK);
    return froe_query_statistics(q);
}

/** Theorem 1 (iii): O((v + k) height) nodes, where the plan has v cells that the range meets. */
static void searches_follow_the_plan(void **state) {
    static const char *const kinds[] = {"disjoint", "parallel", "mixed", "clusters", "polylines"};
    (void)state;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        froe_scene *scene = generate(kinds[k], 3000), *points = endpoints(scene);
        froe_tree *plan = build(points, "kd", NULL, 1), *tree = convert(scene, "kd", "", 1);
        froe_query *of_plan, *of_tree;
        double lo[2], hi[2], worst = 0;
        assert_int_equal(froe_query_new(plan, &of_plan, NULL), FROE_OK);
        assert_int_equal(froe_query_new(tree, &of_tree, NULL), FROE_OK);
        assert_true(froe_scene_bounds(scene, lo, hi));
        for (int i = 0; i < 60; i++) {
            double at[2] = {(i * 37 % 60) / 60.0, (i * 23 % 60) / 60.0}, size = ldexp(0.5, -(i % 8)), corner[4];
            uint64_t endpoints_found, segments_found;
            froe_range window = froe_range_defaults();
            window.points = corner;
            for (int axis = 0; axis < 2; axis++) {
                corner[axis] = lo[axis] + at[axis] * (hi[axis] - lo[axis]);
                corner[2 + axis] = corner[axis] + size * (hi[axis] - lo[axis]);
            }
            double v = (double)met(of_plan, &window, &endpoints_found).leaves;
            double nodes = (double)met(of_tree, &window, &segments_found).nodes;
            double ratio = nodes / ((v + (double)segments_found) * (double)froe_tree_report(plan).height);
            worst = ratio > worst ? ratio : worst;
        }
        if (worst > 2) fail_msg("%s: %g (v + k) height nodes", kinds[k], worst);
        froe_query_free(of_plan);
        froe_query_free(of_tree);
        froe_tree_free(plan);
        froe_tree_free(tree);
        froe_scene_free(points);
        froe_scene_free(scene);
    }
}

static void every_plan_serves_every_scene(void **state) {
    (void)state;
    for (size_t g = 0; froe_generator_at(g); g++) {
        const froe_generator_info *info = froe_generator_at(g);
        bool points = !strcmp(info->name, "points");
        if (info->dim != 2 || (info->kind != FROE_SEGMENT && !points) || strstr(info->name, "moving")) continue;
        froe_scene *scene = generate(info->name, 50);
        for (size_t i = 0; i < PLANS; i++)
            for (uint32_t leaf = points ? 1 : 0; leaf < 6; leaf += 3) {
                froe_tree *tree = convert(scene, plans[i], "", leaf);
                audit(tree, info->name);
                froe_tree_free(tree);
            }
        froe_scene_free(scene);
    }
}

static void slabs_of_paterson_and_yao_are_a_conversion(void **state) {
    froe_scene *scene = generate("disjoint", 500);
    froe_tree *slabs = build(scene, "paterson_yao", NULL, 1), *converted = convert(scene, "median", "", 1);
    (void)state;
    assert_int_equal(slabs->node_count, converted->node_count);
    assert_memory_equal(slabs->nodes, converted->nodes, slabs->node_count * sizeof *slabs->nodes);
    assert_memory_equal(slabs->cuts, converted->cuts, slabs->cut_count * sizeof *slabs->cuts);
    for (uint32_t i = 0; i < slabs->node_count; i++) {
        froe_cut cut = tree_cut_at(slabs, i);
        assert_true(cut.kind == FROE_CUT_NONE || cut.kind == FROE_CUT_OBJECT || cut.axis == 0);
    }
    froe_tree_free(slabs);
    froe_tree_free(converted);
    froe_scene_free(scene);
}

static froe_status convert_in(void *user, const froe_allocator *alloc) {
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_status status = froe_generate("segments", 24, 7, alloc, &scene, NULL);
    if (!status) status = try_build(scene, "converted", user, 1, &tree, NULL);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

static void a_conversion_survives_every_failing_allocation(void **state) {
    char *const settings[] = {"from=kd", "from=bar", "from=quad prune=no", "from=hamsandwich"};
    (void)state;
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) test_memory_each(convert_in, settings[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plans_know_homes_and_junctions),
        cmocka_unit_test(sandwiches_halve_both_sides),
        cmocka_unit_test(the_best_chord_is_found),
        cmocka_unit_test(size_and_height_follow_the_plan),
        cmocka_unit_test(pruning_spares_nodes_alone),
        cmocka_unit_test(searches_follow_the_plan),
        cmocka_unit_test(every_plan_serves_every_scene),
        cmocka_unit_test(slabs_of_paterson_and_yao_are_a_conversion),
        cmocka_unit_test(a_conversion_survives_every_failing_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
