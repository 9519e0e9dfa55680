/* test_grain.c: how the grain builder scores planes: against exact counts and against brute force, in every cell of
 * whole builds; and what it promises. */
#include "build/grain/candidates.h"
#include "build/grain/crossing.h"
#include "build/grain/sweep.h"
#include "build/method.h"
#include "geom/meet/contact.h"
#include "split/cell.h"
#include "split/score/exact.h"
#include "tree/tree.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "meshes.h"

/** The same scene, `factor` times as large and turned about an axis. */
static froe_scene *changed(const froe_scene *from, double factor, double sine, double cosine) {
    size_t n = froe_scene_object_count(from);
    double *x = test_malloc(9 * n * sizeof *x);
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t corner = k < froe_scene_object(from, i).corners ? k : 0;
            const double *p = froe_scene_vertex(from, froe_scene_corner(from, i, corner));
            double *q = x + 9 * (size_t)i + 3 * k;
            q[0] = factor * (cosine * p[0] - sine * p[1]);
            q[1] = factor * (sine * p[0] + cosine * p[1]);
            q[2] = factor * p[2];
        }
    froe_scene *scene = mesh_of(3, x, n);
    test_free(x);
    return scene;
}

/** A builder that looks at each cell before grain cuts it. */
typedef struct watch {
    split_grain grain;
    split_grain_notes notes;
    void (*look)(struct watch *w, split_work *work, const split_cell *cell);
    split_view view;
    split_sweep sweep;
    split_price price;
    fuzz_source random;
    size_t compared, wrong;
} watch;

static split_verdict watch_and_choose(const void *config, split_work *work, const split_cell *cell, froe_cut *cut) {
    watch *w = (watch *)(void *)(uintptr_t)config;
    if (cell->count > 1 && !cell->attempt) w->look(w, work, cell);
    return split_grain_choose(&w->grain, work, cell, cut);
}

/** Builds a tree of a scene, which is freed, with one thread, looking at all cells. */
static watch build_watching_scene(froe_scene *scene, void (*look)(watch *, split_work *, const split_cell *)) {
    base_task task;
    tree_meta meta = {0};
    froe_allocator alloc = support_allocator(NULL);
    watch w = {.grain = {.seed = 5, .effort = {4, 4, 4, 6, 256, false}, .height = 30}, .look = look, .random = {9}};
    w.grain.notes = &w.notes;
    base_task_init(&task, 1, NULL, NULL);
    split_price_init(&w.price);
    split_job job = {.scene = scene, .alloc = alloc, .task = &task, .meta = &meta};
    split_method method = {.config = &w,
                           .choose = watch_and_choose,
                           .scratch_new = split_grain_scratch_new,
                           .scratch_free = split_grain_scratch_free};
    assert_int_equal(split_grow(&job, &method, NULL), FROE_OK);
    assert_true(w.compared > 100);
    split_sweep_free(&alloc, &w.sweep);
    split_view_free(&alloc, &w.view);
    froe_scene_free(scene);
    return w;
}

static watch build_watching(mesh_kind kind, size_t n, void (*look)(watch *, split_work *, const split_cell *)) {
    return build_watching_scene(mesh_new(kind, n), look);
}

static uint32_t drawn_vertex(watch *w, const split_work *work, const split_cell *cell) {
    uint32_t item = base_below(fuzz_bits(&w->random), cell->count);
    uint32_t object = work->set.items.data[cell->first + item].object;
    uint32_t corner = base_below(fuzz_bits(&w->random), scene_corners(work->set.scene, object));
    return scene_corner(work->set.scene, object, corner);
}

/** As many vertices as span a plane. */
static bool drawn_span(watch *w, const split_work *work, const split_cell *cell, uint32_t id[3]) {
    for (int k = 0; k < work->set.scene->dim; k++) id[k] = drawn_vertex(w, work, cell);
    return id[0] != id[1] && (work->set.scene->dim == 2 || (id[1] != id[2] && id[2] != id[0]));
}

static void compare_tallies(watch *w, split_tally a, split_tally b) {
    w->wrong += a.negative != b.negative || a.positive != b.positive || a.on != b.on || a.both != b.both;
    w->compared++;
}

/* ---------------------------------------------------------------- scoring -- */

/** Counts of shared vertices are those of fragments one by one, and so is the class of each fragment. */
static void compare_exact_counts(watch *w, split_work *work, const split_cell *cell, const froe_cut *cut) {
    split_set *set = &work->set;
    split_tally shared, single;
    uint8_t *classes = test_malloc(cell->count);
    assert_true(split_exact_tally(&w->view, work, cell, cut, &shared));
    memcpy(classes, set->classes.data, cell->count);
    assert_int_equal(cell_tally(work, cell, cut, &single), FROE_OK);
    assert_memory_equal(&shared, &single, sizeof shared);
    assert_memory_equal(classes, set->classes.data, cell->count);
    test_free(classes);
}

static void compare_with_exact(watch *w, split_work *work, const split_cell *cell) {
    assert_true(split_view_fill(&w->view, &work->set, cell, cell->count, 1, true));
    for (int i = 0; i < 6; i++) {
        froe_cut cut = {.kind = FROE_CUT_VERTICES};
        split_view_plane plane;
        split_tally tally;
        if (!drawn_span(w, work, cell, cut.id)) continue;
        compare_exact_counts(w, work, cell, &cut);
        if (!split_view_span(&w->view, work->set.scene, cut.id, 1e-5, &plane)) continue;
        assert_int_equal(cell_tally(work, cell, &cut, &tally), FROE_OK);
        compare_tallies(w, split_view_count(&w->view, &plane), tally);
    }
}

static void compare_axes_with_exact(watch *w, split_work *work, const split_cell *cell) {
    assert_true(split_view_fill(&w->view, &work->set, cell, cell->count, 1, true));
    for (int i = 0; i < 6; i++) {
        uint32_t vertex = drawn_vertex(w, work, cell);
        froe_cut cut = {.kind = FROE_CUT_AXIS, .axis = i % work->set.scene->dim};
        cut.value = scene_vertex(work->set.scene, vertex)[cut.axis];
        split_view_plane plane = split_view_axis(&w->view, cut.axis, cut.value);
        split_tally tally;
        compare_exact_counts(w, work, cell, &cut);
        assert_int_equal(cell_tally(work, cell, &cut, &tally), FROE_OK);
        compare_tallies(w, split_view_count(&w->view, &plane), tally);
    }
}

static void all_shown_scored_counts_are_the_exact_ones(void **state) {
    (void)state;
    assert_int_equal(build_watching(MESH_LOOSE, 250, compare_with_exact).wrong, 0);
    assert_int_equal(build_watching(MESH_HILLS, 400, compare_with_exact).wrong, 0);
    assert_int_equal(build_watching(MESH_FAN, 100, compare_with_exact).wrong, 0);
    assert_int_equal(build_watching(MESH_STROKES, 400, compare_with_exact).wrong, 0);
    assert_int_equal(build_watching(MESH_MAP, 400, compare_with_exact).wrong, 0);
}

/** But for corners that rounding moved out of a plane, or into one. */
static void exact_coincidences_are_scored_as_such(void **state) {
    watch planes, axes;
    (void)state;
    planes = build_watching(MESH_LATTICE, 100, compare_with_exact);
    axes = build_watching(MESH_LATTICE, 100, compare_axes_with_exact);
    assert_true(200 * planes.wrong < planes.compared);
    assert_true(200 * axes.wrong < axes.compared);
}

static void count_exactly(watch *w, split_work *work, const split_cell *cell) {
    assert_true(split_view_fill(&w->view, &work->set, cell, cell->count, 1, true));
    for (uint32_t i = 0; i < cell->count; i++) {
        const froe_cut cut = {.kind = FROE_CUT_OBJECT, .id = {work->set.items.data[cell->first + i].object}};
        compare_exact_counts(w, work, cell, &cut);
        w->compared++;
    }
}

/** Corners lie beside planes by as little as rounding moved them: only exact numbers tell. */
static void walls_that_are_nearly_flat_are_counted_exactly(void **state) {
    froe_scene *lattice = mesh_new(MESH_LATTICE, 150);
    (void)state;
    build_watching_scene(changed(lattice, 1, 0.644217687237691, 0.7648421872844885), count_exactly);
    froe_scene_free(lattice);
}

/** However thin the triangle: where the plane is hardly known, its own vertices are on it all the same. */
static void compare_zeros(watch *w, split_work *work, const split_cell *cell) {
    assert_true(split_view_fill(&w->view, &work->set, cell, cell->count, 1, true));
    for (int i = 0; i < 6; i++) {
        uint32_t id[3];
        split_view_plane plane;
        if (!drawn_span(w, work, cell, id)) continue;
        if (!split_view_span(&w->view, work->set.scene, id, 0, &plane)) continue;
        plane.slack = 0;
        split_view_count(&w->view, &plane);
        for (int k = 0; k < work->set.scene->dim; k++) {
            uint32_t at = w->view.place[id[k]];
            if (at < w->view.corners) assert_int_equal(w->view.side.data[at + 1], 0);
        }
        w->compared++;
    }
}

static void vertices_of_a_plane_lie_in_it_by_their_ids(void **state) {
    (void)state;
    build_watching(MESH_HAIR, 80, compare_zeros);
    build_watching(MESH_STROKES, 200, compare_zeros);
}

static void compare_outside(watch *w, split_work *work, const split_cell *cell) {
    const split_view *f = &w->view;
    assert_true(split_view_fill(&w->view, &work->set, cell, cell->count, 1, true));
    for (uint32_t i = 0; i < f->corners; i++) {
        assert_true(fabs(f->x.data[i]) <= 0.5 && fabs(f->y.data[i]) <= 0.5 && fabs(f->z.data[i]) <= 0.5);
        if (f->vertex.data[i] != FROE_NONE) assert_int_equal(f->place[f->vertex.data[i]], i);
        w->compared++;
    }
    for (size_t i = 0; i < f->vertices.count; i++) {
        assert_true(f->vertex.data[f->vertices.data[i]] != FROE_NONE);
        assert_int_equal(i < f->inside, f->vertices.data[i] < f->corners);
    }
}

static void corners_lie_around_the_middle_and_know_their_vertices(void **state) {
    (void)state;
    for (mesh_kind kind = 0; kind < MESH_KINDS; kind++) build_watching(kind, 80, compare_outside);
}

/* --------------------------------------------------------------- crossings -- */

static uint32_t crossings_by_contact(split_work *work, uint32_t object) {
    const froe_scene *scene = work->set.scene;
    geom_body body = scene_body(scene, object);
    uint32_t count = 0;
    for (uint32_t other = 0; other < scene->object_count; other++) {
        geom_body with = scene_body(scene, other);
        signed char sides[6];
        if (other != object) count += geom_contact_of(&work->set.context, &body, &with, sides).kind == GEOM_CROSS;
    }
    return count;
}

/** While all objects are whole, exact geometry knows as well. */
static void compare_crossings(watch *w, split_work *work, const split_cell *cell) {
    const froe_scene *scene = work->set.scene;
    for (uint32_t object = 0; object < scene->object_count && !cell->depth; object++) {
        const uint32_t id[3] = {scene_corner(scene, object, 0), scene_corner(scene, object, 1),
                                scene->dim == 3 ? scene_corner(scene, object, 2) : FROE_NONE};
        split_view_plane plane;
        assert_true(split_view_fill(&w->view, &work->set, cell, cell->count, 1, true));
        assert_true(split_view_span(&w->view, scene, id, 0, &plane));
        split_view_count(&w->view, &plane);
        uint32_t count = split_crossing_count(&w->view, scene, object, &plane);
        assert_int_equal(count, crossings_by_contact(work, object));
        w->compared += 1 + count;
    }
}

static void splits_are_due_where_objects_cross(void **state) {
    (void)state;
    assert_true(build_watching(MESH_LOOSE, 150, compare_crossings).compared > 170);
    assert_true(build_watching(MESH_STROKES, 150, compare_crossings).compared > 200);
    assert_int_equal(build_watching(MESH_HILLS, 150, compare_crossings).compared, 150);
    assert_int_equal(build_watching(MESH_MAP, 150, compare_crossings).compared, 150);
}

/* ----------------------------------------------------------------- sweeps -- */

static double cost_of(watch *w, const split_work *work, const uint32_t id[3], const split_terms *terms) {
    split_view_plane plane;
    if (!split_view_span(&w->view, work->set.scene, id, 1e-12, &plane)) return INFINITY;
    split_tally tally = split_view_count(&w->view, &plane);
    return split_tally_useful(tally) ? split_price_of(&w->price, terms, tally, 1) : (double)INFINITY;
}

static void compare_pencil(watch *w, split_work *work, const split_cell *cell) {
    const split_terms terms = {0.1, 0.5 * cell->count};
    uint32_t id[3], last = (uint32_t)work->set.scene->dim - 1;
    double least = INFINITY;
    split_sweep_best best, none;
    assert_true(split_view_fill(&w->view, &work->set, cell, cell->count, 1, true));
    if (!drawn_span(w, work, cell, id)) return;
    const split_view_part part = split_view_part_of(&w->view, false);
    const split_prices prices = split_prices_of(&w->price, &terms, part.count, 1);
    assert_true(split_sweep_pencil(&w->sweep, &work->set, &w->view, &part, &prices, id, INFINITY, &best));
    for (size_t i = 0; i < w->view.vertices.count; i++) {
        id[last] = w->view.vertex.data[w->view.vertices.data[i]];
        double cost = id[last] == id[0] || id[last] == id[last - 1] ? (double)INFINITY : cost_of(w, work, id, &terms);
        if (cost < least) least = cost;
    }
    id[last] = best.vertex;
    w->wrong += best.vertex == FROE_NONE ? !isinf(least) : cost_of(w, work, id, &terms) != least || best.cost != least;
    w->compared++;
    if (best.vertex == FROE_NONE) return;
    /* below a limit there is the same, or nothing */
    assert_true(split_sweep_pencil(&w->sweep, &work->set, &w->view, &part, &prices, id, best.cost, &none));
    assert_int_equal(none.vertex, FROE_NONE);
}

static void a_pencil_has_the_best_of_its_planes(void **state) {
    (void)state;
    assert_int_equal(build_watching(MESH_LOOSE, 200, compare_pencil).wrong, 0);
    assert_int_equal(build_watching(MESH_HILLS, 300, compare_pencil).wrong, 0);
    assert_int_equal(build_watching(MESH_STROKES, 300, compare_pencil).wrong, 0);
    watch map = build_watching(MESH_MAP, 300, compare_pencil); /* corners very near the turning line */
    assert_true(50 * map.wrong < map.compared);
}

static void compare_axis(watch *w, split_work *work, const split_cell *cell) {
    const split_terms terms = {0.1, cell->count};
    const split_prices prices = split_prices_of(&w->price, &terms, cell->count, 1);
    assert_true(split_view_fill(&w->view, &work->set, cell, cell->count, 1, true));
    for (int axis = 0; axis < work->set.scene->dim; axis++) {
        split_sweep_best best;
        double least = INFINITY, found = INFINITY;
        assert_true(split_sweep_axis(&w->sweep, &work->set, &w->view, &prices, axis, &best));
        for (uint32_t i = 0; i < w->view.inside; i++) {
            const uint32_t vertex = w->view.vertex.data[w->view.vertices.data[i]];
            double value = scene_vertex(work->set.scene, vertex)[axis];
            split_view_plane plane = split_view_axis(&w->view, axis, value);
            split_tally tally = split_view_count(&w->view, &plane);
            double cost = split_tally_useful(tally) ? split_price_of(&w->price, &terms, tally, 1) : (double)INFINITY;
            least = cost < least ? cost : least;
            if (vertex == best.vertex) found = cost;
        }
        w->wrong += found != least;
        w->compared++;
    }
}

/** But where several of its buckets seem better than they are. */
static void an_axis_mostly_has_the_best_of_its_planes(void **state) {
    static const mesh_kind kinds[] = {MESH_LOOSE, MESH_HILLS, MESH_MAP};
    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const watch w = build_watching(kinds[i], 200, compare_axis);
        assert_true(100 * w.wrong < w.compared);
    }
}

/** Instructions of a processor give what plain C gives. */
static void the_greater_of_four_numbers_is_the_same_everywhere(void **state) {
    fuzz_source random = {3};
    (void)state;
    for (int i = 0; i < 100000; i++) {
        const uint64_t a = fuzz_bits(&random), b = i % 5 ? fuzz_bits(&random) : a ^ UINT64_C(1) << i % 64;
        assert_true(sweep_value(sweep_greater(sweep_lanes_of(a), sweep_lanes_of(b))) == sweep_greater_plain(a, b));
    }
    for (uint32_t bucket = 1; bucket < SWEEP_MOST + 3; bucket++)
        for (int negative = 0; negative < 2; negative++) {
            const sweep_met met = sweep_met_of(bucket, negative);
            assert_true(sweep_greater_plain(met, SWEEP_ALWAYS) == met && met != SWEEP_ALWAYS);
            assert_int_equal(met & 0xffff, bucket + (negative ? SWEEP_NEGATIVE : 0));
        }
}

/** An axle is the same both ways round. Pencils of the last cell are forgotten, and those without room unknown. */
static void pencils_are_known_again(void **state) {
    split_pencils *p = test_malloc(sizeof *p);
    (void)state;
    memset(p, 0, sizeof *p);
    p->cell = UINT32_MAX; /* the number of the cell begins anew */
    for (int round = 0; round < 2; round++) {
        split_pencils_begin(p);
        for (uint32_t i = 0; i < SPLIT_PENCILS; i++) {
            split_pencil *at = split_pencil_at(p, split_axle_of(i / 2, 2 * i + 1, i % 2));
            assert_true(2 * i < SPLIT_PENCILS ? at != NULL : at == NULL);
            if (!at) continue;
            assert_true(at->limit == (double)-INFINITY);
            at->limit = i;
        }
        for (uint32_t i = 0; 2 * i < SPLIT_PENCILS; i++) {
            assert_true(split_pencil_at(p, split_axle_of(2 * i + 1, i / 2, i % 2))->limit == (double)i);
            assert_null(split_pencil_at(p, split_axle_of(2 * i + 1, i / 2, i % 2 == 0)));
        }
    }
    test_free(p);
}

/* ------------------------------------------------------------------ prices -- */

static void prices_know_splits_balance_and_limits(void **state) {
    split_price *price = test_malloc(sizeof *price);
    split_terms terms = {0.1, 100};
    (void)state;
    split_price_init(price);
    split_tally even = {50, 50, 0, 0}, odd = {70, 30, 0, 0}, split = {49, 50, 0, 1}, on = {50, 49, 1, 0};
    assert_true(split_price_of(price, &terms, even, 1) < split_price_of(price, &terms, odd, 1));
    assert_true(split_price_of(price, &terms, even, 1) < split_price_of(price, &terms, split, 1));
    assert_true(split_price_of(price, &terms, on, 1) < split_price_of(price, &terms, even, 1));
    terms.most = 60;
    assert_true(split_price_of(price, &terms, odd, 1) > 1000);
    assert_true(split_price_of(price, &terms, even, 1) < 0);
    /* shown by halves, the same cell costs the same */
    split_tally whole = {60, 40, 6, 20}, half = {30, 20, 3, 10};
    terms.most = 1000;
    assert_true(fabs(split_price_of(price, &terms, whole, 1) - split_price_of(price, &terms, half, 2)) < 1e-9);
    test_free(price);
}

/* ----------------------------------------------------------------- promises -- */

static froe_tree *build(froe_scene *scene, const char *settings, uint32_t leaf) {
    froe_build_options o = froe_build_defaults();
    froe_diagnostic diag = {0};
    froe_tree *tree = NULL;
    o.method = "grain";
    o.settings = settings;
    o.leaf = leaf;
    o.threads = 1;
    if (froe_build(scene, &o, &tree, &diag)) fail_msg("%s", diag.message);
    return tree;
}

static void keep_the_height_asked_for(mesh_kind kind, size_t n) {
    static const char *const settings[] = {"height=2", "height=3", "effort=fast", "effort=min", "height=4 effort=fast"};
    static const double most[] = {2, 3, 2, 5, 4};
    for (size_t i = 0; i < sizeof most / sizeof *most; i++) {
        froe_scene *scene = mesh_new(kind, n);
        for (uint32_t leaf = 0; leaf < 3; leaf++) {
            froe_tree *tree = build(scene, settings[i], leaf);
            froe_report r = froe_tree_report(tree);
            const double levels = log2((double)r.objects + 1), promised = r.promises[0].promised;
            assert_true((double)r.height <= promised);
            assert_true(fabs(promised - most[i] * levels - 2) < 1e-6 ||
                        (i == 3 && fabs(promised - 2 * levels - 2) < 1e-6));
            froe_tree_free(tree);
        }
        froe_scene_free(scene);
    }
}

static void meshes_keep_the_height_asked_for(void **state) {
    (void)state;
    keep_the_height_asked_for(MESH_HILLS, 700);
    keep_the_height_asked_for(MESH_MAP, 700);
}

/** Of grain at 2 log2 n + 2 levels. */
static uint64_t height_of(froe_scene *scene, bool again) {
    split_grain_notes notes = {0, false};
    split_grain grain = {.seed = 1, .effort = {4, 4, 4, 6, 256, false}, .notes = &notes};
    grain.height = 2 * log2((double)froe_scene_object_count(scene)) + 2;
    split_method method = {.config = &grain,
                           .choose = split_grain_choose,
                           .scratch_new = split_grain_scratch_new,
                           .scratch_free = split_grain_scratch_free,
                           .height = again ? grain.height : 0};
    base_task task;
    tree_meta meta = {0};
    split_job job = {.scene = scene, .alloc = support_allocator(NULL), .task = &task, .meta = &meta};
    froe_tree *tree;
    base_task_init(&task, 1, NULL, NULL);
    assert_int_equal(split_grow(&job, &method, &tree), FROE_OK);
    uint64_t height = froe_tree_report(tree).height;
    assert_true(froe_tree_report(tree).objects == froe_scene_object_count(scene));
    froe_tree_free(tree);
    return height;
}

/** Where objects cross, cells cannot always be cut with balance. */
static void subtrees_too_high_are_grown_again(void **state) {
    static const mesh_kind kinds[] = {MESH_LATTICE, MESH_LATTICE, MESH_FAN, MESH_HAIR};
    static const size_t counts[] = {33, 49, 109, 163};
    (void)state;
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        froe_scene *scene = mesh_new(kinds[i], counts[i]);
        double limit = 2 * log2((double)counts[i]) + 2;
        assert_true((double)height_of(scene, false) > limit);
        assert_true((double)height_of(scene, true) <= limit);
        froe_scene_free(scene);
    }
}

static void more_height_and_more_effort_mean_fewer_pieces(void **state) {
    static const char *const settings[] = {"effort=fast", "effort=log", "effort=min", "height=1000", "height=0"};
    uint64_t pieces[5];
    froe_scene *scene = mesh_new(MESH_HILLS, 1500);
    (void)state;
    for (int i = 0; i < 5; i++) {
        froe_tree *tree = build(scene, settings[i], 1);
        pieces[i] = froe_tree_report(tree).fragments;
        froe_tree_free(tree);
    }
    froe_scene_free(scene);
    assert_true(pieces[2] < pieces[1] && pieces[1] < pieces[0] && pieces[3] == pieces[4]);
}

/** Thin triangles along the lines of two nearby hyperbolic paraboloids: every cut splits, so height does not pay. */
static froe_scene *net_new(int n) {
    froe_scene *scene = NULL;
    froe_objects o = froe_objects_defaults();
    o.count = 1;
    o.kind = FROE_POLYGON;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    for (int i = 0; i < n; i++) {
        const double at = (i + 0.5) / n, thin = 0.0005, apart = 0.004;
        const double along[] = {at, 0, 0, at, 1, at, at + thin, 0.5, at / 2};
        const double across[] = {0, at, apart, 1, at, at + apart, 0.5, at + thin, at / 2 + apart};
        o.coords = along;
        assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
        o.coords = across;
        assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    }
    return scene;
}

static void least_effort_never_makes_more_pieces_than_log(void **state) {
    static const char *const settings[] = {"effort=log", "effort=min"};
    froe_report report[2];
    froe_scene *scene = net_new(30);
    (void)state;
    for (int i = 0; i < 2; i++) {
        froe_tree *tree = build(scene, settings[i], 0);
        report[i] = froe_tree_report(tree);
        assert_true((double)report[i].height <= report[i].promises[0].promised);
        froe_tree_free(tree);
    }
    froe_scene_free(scene);
    assert_true(report[1].fragments <= report[0].fragments);
}

/** Is least effort grown within so many pieces? With how many? */
static size_t least_within(froe_scene *scene, const char *settings, size_t most) {
    froe_build_options o = froe_build_defaults();
    froe_tree *tree = NULL;
    o.method = "grain", o.settings = settings, o.leaf = 1, o.threads = 1, o.max_fragments = most;
    const froe_status status = froe_build(scene, &o, &tree, NULL);
    const size_t pieces = status ? 0 : froe_tree_piece_count(tree);
    assert_int_equal(status, pieces ? FROE_OK : FROE_E_BUDGET);
    assert_int_equal(status == FROE_OK, tree != NULL);
    froe_tree_free(tree);
    return pieces;
}

/** The taller tree is grown where the low one is not within the limit, and not where that splits nothing. */
static void least_effort_keeps_limits_of_pieces(void **state) {
    static const double apart[] = {0, 0, 1, 1, 0, 2, 1, 3, 0, 4, 1, 5, 0, 6, 1, 7};
    (void)state;
    for (int free = 0; free < 2; free++) {
        const char *settings = free ? "effort=min height=0" : "effort=min";
        froe_scene *scene = mesh_new(MESH_HILLS, 200);
        const size_t low = least_within(scene, "effort=log", 0), least = least_within(scene, settings, 0);
        assert_true(least < low && least > 200);
        assert_int_equal(least_within(scene, settings, low), least);
        assert_int_equal(least_within(scene, settings, low - 1), least);
        assert_int_equal(least_within(scene, settings, least), least);
        assert_int_equal(least_within(scene, settings, least - 1), 0);
        froe_scene_free(scene);
        scene = mesh_of(2, apart, 4);
        assert_int_equal(least_within(scene, settings, 0), 4);
        assert_int_equal(least_within(scene, settings, 4), 4);
        assert_int_equal(least_within(scene, settings, 3), 0);
        froe_scene_free(scene);
    }
}

static double pieces_of(const froe_scene *from, double factor, bool turn) {
    froe_scene *scene = changed(from, factor, turn, !turn);
    froe_tree *tree = build(scene, NULL, 1);
    double pieces = (double)froe_tree_report(tree).fragments;
    froe_tree_free(tree);
    froe_scene_free(scene);
    return pieces;
}

static void scale_changes_nothing_and_quarter_turns_hardly_anything(void **state) {
    froe_scene *scene = mesh_new(MESH_HILLS, 900);
    (void)state;
    double pieces = pieces_of(scene, 1, false);
    assert_true(pieces_of(scene, 0x1p60, false) == pieces);
    assert_true(pieces_of(scene, 0x1p-60, false) == pieces);
    assert_true(fabs(pieces_of(scene, 1, true) / pieces - 1) < 0.03);
    froe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_shown_scored_counts_are_the_exact_ones),
        cmocka_unit_test(exact_coincidences_are_scored_as_such),
        cmocka_unit_test(walls_that_are_nearly_flat_are_counted_exactly),
        cmocka_unit_test(vertices_of_a_plane_lie_in_it_by_their_ids),
        cmocka_unit_test(corners_lie_around_the_middle_and_know_their_vertices),
        cmocka_unit_test(splits_are_due_where_objects_cross),
        cmocka_unit_test(a_pencil_has_the_best_of_its_planes),
        cmocka_unit_test(an_axis_mostly_has_the_best_of_its_planes),
        cmocka_unit_test(the_greater_of_four_numbers_is_the_same_everywhere),
        cmocka_unit_test(pencils_are_known_again),
        cmocka_unit_test(prices_know_splits_balance_and_limits),
        cmocka_unit_test(meshes_keep_the_height_asked_for),
        cmocka_unit_test(subtrees_too_high_are_grown_again),
        cmocka_unit_test(more_height_and_more_effort_mean_fewer_pieces),
        cmocka_unit_test(least_effort_never_makes_more_pieces_than_log),
        cmocka_unit_test(least_effort_keeps_limits_of_pieces),
        cmocka_unit_test(scale_changes_nothing_and_quarter_turns_hardly_anything),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
