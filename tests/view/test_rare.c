/* test_rare.c: what pictures of ordinary scenes hardly ever meet: numbers that come round, two lines of one hash,
 * planes of every form, 2^31 of something, an order without memory, a section that nothing is left of. */
#include "base/random.h"
#include "pages.h"
#include "view/grid.h"
#include "view/picture/graph.h"
#include "view/picture/overlay.h"
#include "view/visibility/crossings.h"
#include "view/visibility/order.h"

/* ----------------------------------------------------------------------- grids -- */

enum { THINGS = 60 };

typedef struct things {
    print_point points[THINGS][2];
    size_t counts[THINGS];
} things;

static const print_point *points_of(const void *user, size_t i, size_t *count) {
    const things *t = user;
    *count = t->counts[i];
    return t->points[i];
}

/* How often a walk over cells finds each thing; with an ordinary number, and when numbers come round. */
static void walk(view_grid *g, view_cells cells, uint32_t walks, uint32_t found[THINGS]) {
    uint32_t i;
    memset(found, 0, THINGS * sizeof *found);
    g->walks = walks;
    view_grid_walk w = view_grid_begin(g, cells);
    while (view_grid_next(&w, &i)) found[i]++;
}

static void walks_find_each_thing_once_after_any_number_of_walks(void **state) {
    (void)state;
    static things t;
    uint32_t found[THINGS];
    const froe_allocator alloc = support_allocator(NULL);
    const froe_projection view = {.width = 80, .height = 80};
    view_grid g = {0};
    for (uint32_t i = 0; i < THINGS; i++) {
        t.counts[i] = i % 5 ? 2 : 0; /* some have no points, and are nowhere */
        for (uint32_t e = 0; e < 2; e++)
            t.points[i][e] = (print_point){80 * trees_unit(1, 4 * i + e), 80 * trees_unit(2, 4 * i + e)};
    }
    assert_int_equal(view_grid_new(&alloc, &view, THINGS, points_of, &t, &g), FROE_OK);
    const uint16_t last = (uint16_t)(g.cells - 1);
    for (uint32_t i = 0; i < THINGS; i++) g.stamps[i] = 1; /* the number of the first walk after 2^32 */
    static const uint32_t numbers[] = {5, UINT32_MAX - 1, UINT32_MAX, 0};
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
        if (numbers[k] == 0)
            for (uint32_t i = 0; i < THINGS; i++) g.stamps[i] = 0;
        walk(&g, (view_cells){0, 0, last, last}, numbers[k], found);
        for (uint32_t i = 0; i < THINGS; i++) assert_int_equal(found[i], t.counts[i] > 0);
        walk(&g, (view_cells){0, 1, last, 0}, g.walks, found); /* no row, and no column */
        for (uint32_t i = 0; i < THINGS; i++) assert_int_equal(found[i], 0);
        walk(&g, view_grid_cells(&g, t.points[0], 0, 0), g.walks, found);
        for (uint32_t i = 0; i < THINGS; i++) assert_int_equal(found[i], 0);
    }
    view_grid_free(&alloc, &g);
}

/* -------------------------------------------------------------------- sightlines -- */

typedef struct stage {
    froe_tree *tree;
    froe_surface *surface;
    view_sightlines sights;
} stage;

static stage open_stage(froe_tree *tree, const froe_eye *at) {
    stage s = {.tree = tree};
    geom_eye eye;
    assert_int_equal(froe_surface_new(tree->scene, NULL, &s.surface, NULL), FROE_OK);
    assert_int_equal(view_eye_of(tree, at, &eye, NULL), FROE_OK);
    assert_int_equal(view_sightlines_new(&s.sights, tree, s.surface, &eye, NULL, 0, &tree->alloc), FROE_OK);
    return s;
}

static void close_stage(stage *s) {
    view_sightlines_free(&s->sights);
    froe_surface_free(s->surface);
    froe_tree_free(s->tree);
}

typedef struct tagged {
    uint32_t tag, patch, node;
} tagged;

static int by_tag(const void *a, const void *b) {
    const tagged *x = a, *y = b;
    return (x->tag > y->tag) - (x->tag < y->tag);
}

/* Lines are found by a hash of patch and node, which has 32 bits. Pairs of lines of one hash are searched for. */
static void lines_of_one_hash_are_two_lines(void **state) {
    enum { PATCHES = 300, ENOUGH = 3 };
    (void)state;
    stage s = open_stage(trees_grow(3, FROE_POLYGON, PATCHES, 0, 0.5, "density", 1), &(froe_eye){.at = {1, 2, 9}});
    const uint32_t nodes = s.tree->node_count;
    tagged *all = calloc((size_t)PATCHES * nodes, sizeof *all);
    size_t count = 0, pairs = 0;
    for (uint32_t p = 0; p < PATCHES; p++)
        for (uint32_t n = 0; n < nodes; n++)
            if (!tree_is_leaf(s.tree->nodes + n)) all[count++] = (tagged){(uint32_t)base_hash(0, p, n), p, n};
    qsort(all, count, sizeof *all, by_tag);
    for (size_t i = 1; i < count && pairs < ENOUGH; i++) {
        const tagged *a = all + i - 1, *b = all + i;
        if (a->tag != b->tag) continue;
        const uint32_t first = view_line_of_cut(&s.sights, a->patch, a->node),
                       second = view_line_of_cut(&s.sights, b->patch, b->node);
        assert_int_not_equal(first, second);
        const view_line *x = s.sights.lines.data + first, *y = s.sights.lines.data + second;
        assert_true(x->a == a->patch && x->b == a->node && y->a == b->patch && y->b == b->node);
        pairs++;
        uint32_t *numbers = calloc(s.sights.lines.count, sizeof *numbers);
        for (size_t k = 0; k < s.sights.lines.count; k++) numbers[k] = 1; /* all are kept */
        assert_int_equal(view_sightlines_keep(&s.sights, numbers), FROE_OK);
        assert_int_equal(view_line_of_cut(&s.sights, b->patch, b->node), numbers[second]);
        assert_int_equal(view_line_of_cut(&s.sights, a->patch, a->node), numbers[first]);
        assert_int_equal(s.sights.lines.count, 2 * pairs); /* and none was made anew */
        free(numbers);
    }
    print_message("  %zu lines, %zu pairs of one hash\n", count, pairs);
    assert_int_equal(pairs, ENOUGH);
    free(all);
    close_stage(&s);
}

/* Walls of `cylindrical` through crossings, in whose planes upright faces stand: by definition they divide these where
 * the lines cross. (No tree was found in which such a face reaches to both sides of a wall within its cell.) */
static void walls_of_crossings_divide_upright_faces_there(void **state) {
    enum { ROWS = 12 };
    (void)state;
    froe_scene *scene;
    uint32_t found = 0;
    froe_build_options o = froe_build_defaults();
    o.method = "cylindrical", o.settings = "crossing=split", o.leaf = 1;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    for (int i = 0; i < ROWS; i++) { /* edges cross at (x + 1, 1), and along x + 1 */
        const double x = 4 * i, z = i % 3, s = i % 2 ? 1 : -1;
        const double faces[4][9] = {{x, 0, z, x + 2, 2, z + 1, x + 3, -1 - z, z},
                                    {x, 2, 3 - z, x + 2, 0, 4, x + 3, 3, 5},
                                    {x + 1, -2, s * z - 1, x + 1, 4, -1, x + 1, 1 + 0.5 * s, 7},
                                    {x + 1, 0.5, -2, x + 1, 1.5, 6, x + 1, 3, s}};
        assert_int_equal(trees_add(scene, FROE_POLYGON, 4, faces[0], NULL, NULL), FROE_OK);
    }
    froe_tree *tree;
    assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
    froe_scene_free(scene);
    stage s = open_stage(tree, &(froe_eye){.at = {-20, 3, 9}});
    for (uint32_t n = 0; n < tree->node_count; n++) {
        const tree_node *node = tree->nodes + n;
        if (tree_is_leaf(node) || node->type == TREE_PLAIN) continue;
        const geom_plane wall = tree_plane_at(tree, n);
        if (wall.form != GEOM_AT_CROSSING) continue;
        for (uint32_t i = 0; i < 4 * ROWS; i++) {
            const double x = scene_point(tree->scene, i, 0)[0];
            if (i % 4 < 2 || fabs(wall.c - x) > 1e-9) continue;
            const uint32_t line = view_line_of_cut(&s.sights, s.surface->patch_of[i], n);
            /* where do the two lines of the wall cross? one of them may lie in the face */
            double y = NAN;
            for (int k = 0; k < 4; k += 2) {
                const double *p = wall.p[k], *q = wall.p[k + 1];
                if (p[0] != q[0]) y = p[1] + (x - p[0]) / (q[0] - p[0]) * (q[1] - p[1]);
            }
            for (int k = -2; k <= 2; k++) {
                const double at[3] = {x, y, k}, beside[3] = {x, y + 0.25, k};
                const filter_vector *image = &s.sights.lines.data[line].image, ray = geom_ray_image(&s.sights.eye, at),
                                    other = geom_ray_image(&s.sights.eye, beside);
                assert_true(fabs(filter_dot(image, &ray).x) < 1e-9 * image->most * ray.most);
                assert_true(fabs(filter_dot(image, &other).x) > 1e-6 * image->most * other.most);
            }
            found++;
        }
    }
    assert_true(found > ROWS);
    close_stage(&s);
}

/* The point of a plane that is seen along a ray lies on both, whatever the plane is made of; where it is seen edge-on,
 * on the ray. */
static void points_lie_on_planes_of_every_form_and_on_rays(void **state) {
    static const double p[] = {1, 2, 3}, q[] = {4, 1, 3};
    static const froe_eye eyes[] = {{{7, 9, 5}, false}, {{1, 2, 1}, true}, {{0, 0, 2}, true}, {{-3, 0, 0}, true}};
    (void)state;
    const geom_plane planes[] = {geom_plane_axis(3, 0, 2), geom_plane_axis(3, 1, -1), geom_plane_axis(3, 2, 4),
                                 geom_plane_vertical(p, q)};
    uint32_t sure = 0, edge_on = 0;
    for (size_t e = 0; e < sizeof eyes / sizeof *eyes; e++) {
        stage s = open_stage(trees_grow(3, FROE_POLYGON, 5, 0, 1, "density", 1), eyes + e);
        const geom_eye *eye = &s.sights.eye;
        for (size_t i = 0; i < sizeof planes / sizeof *planes; i++)
            for (uint32_t r = 0; r < 6; r++) {
                double x[3], ray[3], slope = 0, value = 0, most = 0;
                for (int k = 0; k < 3; k++) ray[k] = 2 * trees_unit(3, 3 * r + (uint32_t)k) - 1;
                if (!eye->parallel && r < 3) ray[r] = 0; /* along the planes of an axis */
                if (eye->parallel) ray[2] = 1;
                view_point_on(&s.sights, planes + i, ray, x);
                for (int k = 0; k < 3; k++) assert_true(isfinite(x[k]));
                for (int k = 0; k < 3; k++) {
                    const double way = eye->parallel ? eye->at[k] : ray[k];
                    slope += planes[i].n[k] * way;
                    most = fmax(most, fabs(planes[i].n[k] * x[k]));
                    value += planes[i].n[k] * (x[k] - (planes[i].form == GEOM_VERTICAL ? p[k] : 0));
                }
                if (planes[i].form != GEOM_VERTICAL) value -= planes[i].c;
                if (fabs(slope) > 1e-9) assert_true(fabs(value) < 1e-12 * (1 + most));
                ++*(fabs(slope) > 1e-9 ? &sure : &edge_on);
                for (int k = 0; k < 3 && !eye->parallel; k++) { /* parallel to the ray, from the eye */
                    const int m = (k + 1) % 3, n = (k + 2) % 3;
                    const double cross = (x[m] - eye->at[m]) * ray[n] - (x[n] - eye->at[n]) * ray[m];
                    assert_true(fabs(cross) < 1e-12 * (1 + fabs(x[m]) + fabs(x[n]) + 10));
                }
            }
        close_stage(&s);
    }
    assert_true(sure > 50 && edge_on > 10);
}

/* ------------------------------------------------------------------------ limits -- */

/* The counts are told before anything is read. */
static void more_than_two_to_the_31_is_a_limit(void **state) {
    (void)state;
    const froe_allocator alloc = support_allocator(NULL);
    view_graph graph;
    graph_arc arc = {0, 1};
    assert_int_equal(view_graph_new(&alloc, 2, &arc, (size_t)INT32_MAX + 1, &graph), FROE_E_LIMIT);

    froe_tree *tree = trees_grow(3, FROE_POLYGON, 20, 0, 1, "density", 1);
    froe_surface *surface;
    froe_visibility *v, *none = NULL;
    froe_diagnostic why;
    froe_visibility_options o = froe_visibility_defaults();
    o.eye.at[2] = 3;
    assert_int_equal(froe_surface_new(tree->scene, NULL, &surface, NULL), FROE_OK);
    assert_int_equal(froe_visibility_new(tree, surface, &o, &v, NULL), FROE_OK);
    const view_runs runs = {.count = (size_t)INT32_MAX + 1};
    view_drop_intervals(v);
    assert_int_equal(view_join_intervals(v, &runs), FROE_E_LIMIT);
    for (int i = 0; i < 2; i++) {
        view_crosser crosser = {.sights = &v->sights};
        (i ? &crosser.all : &crosser.seen)->count = (size_t)INT32_MAX + 1;
        assert_int_equal(view_join_crossings(v, &crosser), FROE_E_LIMIT);
    }
    const view_items items = {.count = (size_t)INT32_MAX + 1};
    const view_drawing drawing = {.sights = &v->sights};
    const view_chains chains = {NULL, NULL};
    view_segments segments = {0};
    assert_int_equal(view_overlay(&drawing, &items, &chains, false, &segments), FROE_E_LIMIT);
    froe_visibility_free(v);

    froe_scene *scene = (froe_scene *)(uintptr_t)tree->scene;
    const uint32_t objects = scene->object_count;
    scene->object_count = INT32_MAX;
    assert_int_equal(froe_visibility_new(tree, surface, &o, &none, &why), FROE_E_LIMIT);
    scene->object_count = objects;
    assert_null(none);
    assert_non_null(strstr(why.message, "2^31 - 2 objects"));
    froe_surface_free(surface);
    froe_tree_free(tree);
}

/* ------------------------------------------------------------------------ orders -- */

typedef struct pieces {
    uint32_t data[20000];
    uint32_t count;
} pieces;

static bool keep(void *user, size_t piece) {
    pieces *p = user;
    assert_true(p->count < sizeof p->data / sizeof *p->data);
    p->data[p->count++] = (uint32_t)piece;
    return true;
}

/* The memory of a tree is refused while its pieces are put in order: an order is whole and the same, or there is none.
 */
static void orders_without_memory_are_told(void **state) {
    static const struct {
        const char *method;
        uint32_t leaf, grid;
    } cases[] = {{"autopartition", 1, 0}, {"density", 1, 3}, {"density", 0, 0}};
    static pieces whole, part;
    (void)state;
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        test_memory m;
        const froe_allocator alloc = test_memory_begin(&m);
        froe_scene *scene;
        uint32_t refused = 0, count;
        assert_int_equal(froe_scene_new(3, &alloc, &scene), FROE_OK);
        assert_int_equal(trees_scatter(scene, FROE_POLYGON, 300, cases[c].grid, 1, 1), FROE_OK);
        froe_tree *tree = trees_build(scene, cases[c].method, cases[c].leaf);
        froe_surface *surface;
        froe_visibility *v;
        froe_visibility_options o = froe_visibility_defaults();
        assert_int_equal(froe_surface_new(scene, NULL, &surface, NULL), FROE_OK);
        count = tree->piece_count;
        uint32_t *places = calloc(count + 1, sizeof *places), *again = calloc(count + 1, sizeof *again);
        for (uint32_t e = 0; e < 8; e++) {
            const froe_eye eye = rays_eye(tree, e);
            whole.count = 0, o.eye = eye;
            assert_int_equal(froe_tree_order(tree, &eye, NULL, keep, &whole, NULL), FROE_OK);
            assert_int_equal(whole.count, count);
            assert_int_equal(froe_visibility_new(tree, surface, &o, &v, NULL), FROE_OK);
            assert_int_equal(view_find_places(v, NULL, places), FROE_OK);
            froe_status status = FROE_E_MEMORY;
            for (size_t i = 1; status || i < 8; i++) { /* until nothing is refused */
                part.count = 0;
                m.fail_at = m.calls + i;
                status = froe_tree_order(tree, &eye, NULL, keep, &part, NULL);
                assert_true(status == FROE_OK || status == FROE_E_MEMORY);
                assert_memory_equal(part.data, whole.data, part.count * sizeof *part.data); /* as far as it went */
                if (!status) assert_int_equal(part.count, count);
                refused += status != FROE_OK;
                m.fail_at = m.calls + i;
                status = view_find_places(v, NULL, again);
                assert_true(status == FROE_OK || status == FROE_E_MEMORY);
                if (!status) assert_memory_equal(again, places, count * sizeof *again);
                refused += status != FROE_OK;
                m.fail_at = 0;
            }
            froe_visibility_free(v);
        }
        assert_true(refused > 16);
        free(places), free(again);
        froe_surface_free(surface);
        froe_tree_free(tree);
        froe_scene_free(scene);
        test_memory_end(&m);
    }
}

/* Leaves of several objects have an order where these lie in one line, or plane, and where one of them has a side. */
static void objects_of_a_leaf_have_an_order_in_one_plane(void **state) {
    static const double in_line[] = {0, 0, 1, 1, 2, 2, 5, 5, 6, 6, 9, 9},
                        not_in_line[] = {0, 0, 1, 1, 2, 2, 5, 5, 6, 6, 9, 8}, dots[] = {0, 0, 3, 1, 2, 4},
                        dots_in_space[] = {0, 0, 0, 3, 1, 2, 2, 4, 5, 7, 1, 8},
                        faces[] = {0, 0, 1, 4, 0, 1, 0, 4, 1, 5, 5, 1, 9, 5, 1, 5, 9, 1},
                        not_flat[] = {0, 0, 1, 4, 0, 1, 0, 4, 1, 5, 5, 1, 9, 5, 1, 5, 9, 2};
    static const struct {
        int dim;
        froe_kind kind;
        size_t count;
        const double *coords;
        bool ordered;
    } cases[] = {{2, FROE_SEGMENT, 3, in_line, true},       {2, FROE_SEGMENT, 3, not_in_line, false},
                 {2, FROE_POINT, 3, dots, false},           {3, FROE_POINT, 3, dots_in_space, false},
                 {3, FROE_POLYGON, 2, faces, true},         {3, FROE_POLYGON, 2, not_flat, false},
                 {3, FROE_SEGMENT, 2, dots_in_space, false}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        test_memory m;
        froe_allocator alloc = test_memory_begin(&m);
        static pieces p;
        froe_scene *scene;
        froe_diagnostic why;
        const froe_eye eye = {.at = {20, 30, 40}};
        assert_int_equal(froe_scene_new(cases[i].dim, &alloc, &scene), FROE_OK);
        assert_int_equal(trees_add(scene, cases[i].kind, cases[i].count, cases[i].coords, NULL, NULL), FROE_OK);
        froe_tree *tree = trees_build(scene, "kd", 8);
        assert_true(froe_tree_report(tree).max_leaf > 1);
        p.count = 0;
        const froe_status status = froe_tree_order(tree, &eye, NULL, keep, &p, &why);
        assert_int_equal(status, cases[i].ordered ? FROE_OK : FROE_E_UNSUPPORTED);
        assert_int_equal(p.count, cases[i].ordered ? cases[i].count : 0);
        if (status) assert_non_null(strstr(why.message, "without a cut between them"));
        m.fail_at = m.calls + 1;
        assert_int_equal(froe_tree_order(tree, &eye, NULL, keep, &p, &why), FROE_E_MEMORY);
        froe_tree_free(tree);
        froe_scene_free(scene);
        test_memory_end(&m);
    }
}

/* ----------------------------------------------------------------------- cameras -- */

static double beyond(const double *plane, const double *x) {
    return plane[0] * x[0] + plane[1] * x[1] + plane[2] * x[2] - plane[3];
}

/* Notes where a point is on the page. */
static void reach(const froe_projection *view, const double *x, double bounds[4]) {
    double at[2];
    assert_true(froe_project(view, x, at));
    for (int k = 0; k < 2; k++) bounds[k] = fmin(bounds[k], at[k]), bounds[2 + k] = fmax(bounds[2 + k], at[k]);
}

/* What a section leaves of polygons fills the page within its margin, from side to side or from top to bottom; a box,
 * which such pictures do not show, takes no room. Without memory for its points there is no camera. */
static void what_a_section_leaves_fills_the_page(void **state) {
    static const double planes[][4] = {{1, 0, 0, 0.4}, {0, 1, 0, 0.5}, {0, 0, -2, -1}, {1, 1, 1, 1.2}, {1, 0, 0, 0}},
                        box[] = {-9, -9, -9, -8, -8, -8};
    (void)state;
    for (size_t i = 0; i < sizeof planes / sizeof *planes; i++) {
        test_memory m;
        const froe_allocator alloc = test_memory_begin(&m);
        froe_scene *scene;
        froe_camera c = froe_camera_defaults();
        froe_projection view;
        double bounds[4] = {INFINITY, INFINITY, -INFINITY, -INFINITY};
        assert_int_equal(froe_scene_new(3, &alloc, &scene), FROE_OK);
        assert_int_equal(trees_scatter(scene, FROE_POLYGON, 40, 0, 0.3, 1), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_BOX, 1, box, NULL, NULL), FROE_OK);
        c.section = planes[i];
        c.parallel = i % 2;
        assert_int_equal(froe_camera_place(&c, scene, &view, NULL), FROE_OK);
        for (uint32_t o = 0; o < 40; o++)
            for (uint32_t k = 0; k < 3; k++) {
                const double *a = scene_point(scene, o, k), *b = scene_point(scene, o, (k + 1) % 3);
                const double at_a = beyond(planes[i], a), at_b = beyond(planes[i], b);
                double x[3];
                if (at_a <= 0) reach(&view, a, bounds);
                for (int d = 0; d < 3; d++) x[d] = a[d] + at_a / (at_a - at_b) * (b[d] - a[d]);
                if (at_a * at_b < 0) reach(&view, x, bounds);
            }
        double least = INFINITY;
        for (int k = 0; k < 2; k++) {
            const double size = k ? view.height : view.width;
            assert_true(bounds[k] > c.margin - 1e-6 && bounds[2 + k] < size - c.margin + 1e-6);
            least = fmin(least, size - 2 * c.margin - (bounds[2 + k] - bounds[k]));
        }
        assert_true(least < 1e-6);
        froe_status status = FROE_E_MEMORY;
        for (size_t k = 1; status; k++) {
            m.fail_at = m.calls + k;
            status = froe_camera_place(&c, scene, &view, NULL);
            assert_true(status == FROE_E_MEMORY || (k > 1 && status == FROE_OK));
        }
        m.fail_at = 0;
        froe_scene_free(scene);
        test_memory_end(&m);
    }
}

/* A section that leaves nothing, and a scene of nothing, have no camera; nor a turntable. One whose scale is given has
 * that scale all around. */
static void cameras_of_nothing_are_refused(void **state) {
    static const double away[] = {1, 0, 0, -100};
    (void)state;
    froe_scene *scenes[2] = {trees_scene(3, FROE_POLYGON, 0, 0, 1, 1), trees_scene(3, FROE_POLYGON, 9, 0, 1, 1)};
    for (int parallel = 0; parallel < 2; parallel++)
        for (int i = 0; i < 2; i++) {
            froe_camera c = froe_camera_defaults(), turned[3];
            froe_projection view;
            froe_diagnostic why;
            c.parallel = parallel;
            if (i) c.section = away;
            assert_int_equal(froe_camera_place(&c, scenes[i], &view, &why), FROE_E_INPUT);
            assert_non_null(strstr(why.message, "nothing before the eye"));
            assert_int_equal(froe_camera_turn(&c, scenes[i], 3, turned, &why), FROE_E_INPUT);
            if (!i) continue;
            c.section = NULL, c.scale = 7;
            assert_int_equal(froe_camera_turn(&c, scenes[i], 3, turned, &why), FROE_OK);
            for (int k = 0; k < 3; k++) {
                assert_int_equal(froe_camera_place(turned + k, scenes[i], &view, NULL), FROE_OK);
                if (parallel) assert_true(view.scale == 7);
            }
        }
    for (int i = 0; i < 2; i++) froe_scene_free(scenes[i]);
}

/* ----------------------------------------------------------------------- lines -- */

/* Draws lines of these kinds. How many strokes there are, all of one kind. */
static size_t strokes_of(page *p, uint32_t kinds, froe_line kind) {
    p->options.lines = kinds;
    assert_int_equal(froe_picture_new(p->tree, p->surface, &p->options, &p->picture, NULL), FROE_OK);
    const size_t count = froe_picture_stroke_count(p->picture);
    for (size_t i = 0; i < count; i++) assert_int_equal(froe_picture_stroke(p->picture, i).kind, kind);
    froe_picture_free(p->picture);
    return count;
}

/* A zigzag, of which so many segments at the end are of a group of their own, or of as many numbers. */
static void wires_run_on_within_their_group(void **state) {
    enum { PARTS = 24 };
    static const struct {
        uint32_t grouped, numbered, strokes;
    } cases[] = {{0, 0, 1}, {PARTS, 0, 1}, {4, 0, 2}, {0, 3, 2}, {5, 3, 3}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_scene *scene;
        page p;
        uint32_t id = FROE_NONE, numbers[PARTS] = {0};
        assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
        if (cases[i].grouped) assert_int_equal(froe_scene_add_group(scene, &(froe_group){.name = "end"}, &id), FROE_OK);
        for (uint32_t k = 0; k < PARTS; k++) {
            const double x[] = {k, k % 2, 0.1 * k, k + 1, (k + 1) % 2, 0.1 * (k + 1)};
            froe_objects o = froe_objects_defaults();
            o.kind = FROE_SEGMENT, o.count = 1, o.coords = x;
            o.group = k + cases[i].grouped >= PARTS ? id : FROE_NONE;
            numbers[k] = k + cases[i].numbered >= PARTS;
            assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
        }
        froe_tree *tree = trees_build(scene, "density", 1);
        froe_scene_free(scene);
        open_page(&p, tree);
        if (cases[i].numbered) p.options.chains = numbers;
        look_from(&p, 0.1, 0.2, 1, 0);
        assert_int_equal(strokes_of(&p, FROE_LINE_WIRE | FROE_LINE_BORDER, FROE_LINE_WIRE), cases[i].strokes);
        assert_int_equal(strokes_of(&p, FROE_LINE_BORDER, FROE_LINE_BORDER), 0);
        p.options.lines = FROE_LINE_WIRE;
        if (i < 3) assert_true(test_memory_each(make_picture, &p) > 10);
        close_page(&p);
        froe_tree_free(tree);
    }
}

/* Points before the eye are drawn, unless they are too near to have a place on the page. */
static void points_that_all_but_touch_the_eye_are_not_drawn(void **state) {
    enum { DOTS = 40 };
    (void)state;
    for (int near = 0; near < 2; near++) {
        double x[3 * DOTS] = {0, 0, -1e-7, 0, 0, 4}; /* that one, and one behind the eye */
        page p;
        froe_scene *scene;
        froe_camera c = froe_camera_defaults();
        for (uint32_t i = 2; i < DOTS; i++)
            for (uint32_t k = 0; k < 3; k++) x[3 * i + k] = (k == 2 ? -6 : -0.5) + trees_unit(1, 3 * i + k);
        if (near) x[2] = -1e-3;
        assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_POINT, DOTS, x, NULL, NULL), FROE_OK);
        froe_tree *tree = trees_build(scene, "density", 1);
        froe_scene_free(scene);
        open_page(&p, tree);
        c.fit = false;
        for (int k = 0; k < 3; k++) c.eye[k] = 0, c.target[k] = k == 2 ? -1 : 0;
        c.up[0] = 0, c.up[1] = 1, c.up[2] = 0;
        place(&p, &c);
        assert_int_equal(strokes_of(&p, FROE_LINE_POINT, FROE_LINE_POINT), DOTS - 2 + near);
        assert_true(test_memory_each(make_picture, &p) > 10);
        close_page(&p);
        froe_tree_free(tree);
    }
}

/* Lines of a section are drawn without those in which faces cross, and the other way round. */
static void sections_and_crossings_are_drawn_apart(void **state) {
    enum { PAIRS = 12 };
    static const double plane[] = {0, 0, 1, 0.5};
    (void)state;
    double x[PAIRS][2][9];
    size_t starts[2 * PAIRS + 1];
    for (size_t i = 0; i < PAIRS; i++)
        for (size_t k = 0; k < 2; k++) {
            const double at = 3 * (double)i, s = k ? 1 : -1,
                         corners[9] = {at - 1, -s, -1, at + 1, s, -1, at, 0.1 * s, 2};
            memcpy(x[i][k], corners, sizeof corners);
        }
    for (size_t i = 0; i <= 2 * (size_t)PAIRS; i++) starts[i] = 3 * i;
    froe_tree *whole = trees_of_polygons(x[0][0], starts, 2 * (size_t)PAIRS, "density"), *tree;
    assert_int_equal(froe_tree_section(whole, plane, NULL, &tree, NULL), FROE_OK);
    page p;
    open_page(&p, tree);
    p.options.section = -1;
    look_from(&p, 0.3, -1, 2, 0);
    assert_int_equal(strokes_of(&p, FROE_LINE_CROSSING, FROE_LINE_CROSSING), PAIRS);
    assert_true(strokes_of(&p, FROE_LINE_SECTION, FROE_LINE_SECTION) >= PAIRS);
    for (int i = 0; i < 2; i++) {
        p.options.lines = i ? FROE_LINE_CROSSING : FROE_LINE_SECTION;
        p.options.no_fills = true;
        assert_true(test_memory_each(make_picture, &p) > 10);
    }
    close_page(&p);
    froe_tree_free(tree);
    froe_tree_free(whole);
}

/* A camera without an up has that of the first axis that it does not look along. */
static void a_camera_without_an_up_has_one(void **state) {
    (void)state;
    froe_scene *scene = trees_scene(3, FROE_POLYGON, 9, 0, 1, 1);
    for (int k = 0; k < 3; k++) {
        froe_camera none = froe_camera_defaults(), one = none;
        froe_projection a, b;
        for (int i = 0; i < 3; i++) none.target[i] = one.target[i] = 0, none.eye[i] = one.eye[i] = i == k ? 9 : 0;
        for (int i = 0; i < 3; i++) none.up[i] = 0, one.up[i] = i == (k == 0);
        assert_int_equal(froe_camera_place(&none, scene, &a, NULL), FROE_OK);
        assert_int_equal(froe_camera_place(&one, scene, &b, NULL), FROE_OK);
        assert_memory_equal(a.right, b.right, sizeof a.right);
        assert_memory_equal(a.up, b.up, sizeof a.up);
        assert_true(a.scale == b.scale);
    }
    froe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(walks_find_each_thing_once_after_any_number_of_walks),
        cmocka_unit_test(lines_of_one_hash_are_two_lines),
        cmocka_unit_test(walls_of_crossings_divide_upright_faces_there),
        cmocka_unit_test(points_lie_on_planes_of_every_form_and_on_rays),
        cmocka_unit_test(more_than_two_to_the_31_is_a_limit),
        cmocka_unit_test(orders_without_memory_are_told),
        cmocka_unit_test(objects_of_a_leaf_have_an_order_in_one_plane),
        cmocka_unit_test(what_a_section_leaves_fills_the_page),
        cmocka_unit_test(cameras_of_nothing_are_refused),
        cmocka_unit_test(a_camera_without_an_up_has_one),
        cmocka_unit_test(wires_run_on_within_their_group),
        cmocka_unit_test(points_that_all_but_touch_the_eye_are_not_drawn),
        cmocka_unit_test(sections_and_crossings_are_drawn_apart),
    };
    return cmocka_run_group_tests_name("view/rare", tests, NULL, NULL);
}
