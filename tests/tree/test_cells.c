/* test_cells.c: cells and corners in coordinates: cells tile the box, pieces tile the objects. */
#include "tree/shape.h"
#include "trees.h"
#include <math.h>
#include <pthread.h>

/* ------------------------------------------------------------------ measures -- */

static double polygon_area(const double *x, size_t corners) {
    double sum = 0;
    for (size_t i = 0; i < corners; i++) {
        const double *p = x + 2 * i, *q = x + 2 * (i + 1 < corners ? i + 1 : 0);
        sum += p[0] * q[1] - p[1] * q[0];
    }
    return sum / 2;
}

/* Six times the volume of the tetrahedron with the origin. */
static double corner_product(const double *a, const double *b, const double *c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

static double polyhedron_volume(const froe_cell *cell) {
    double sum = 0;
    for (size_t f = 0; f < cell->face_count; f++)
        for (size_t i = cell->face_starts[f] + 1; i + 1 < cell->face_starts[f + 1]; i++)
            sum +=
                corner_product(cell->coords + 3 * cell->face_starts[f], cell->coords + 3 * i, cell->coords + 3 * i + 3);
    return sum / 6;
}

typedef struct tally {
    int dim;
    const froe_tree *tree;
    size_t cells, leaves, cuts, last_depth;
    double leaf_measure, root_measure;
    size_t stop_after;
} tally;

/* The cut's corners lie on it, up to rounding. */
static void check_cut(const tally *t, const froe_cell *cell) {
    geom_plane exact = tree_plane_at(t->tree, cell->node.id1 - 1);
    shape_plane plane = shape_plane_from(&exact, &(shape_frame){.exponent = 0});
    assert_true(cell->cut_corners >= (size_t)t->dim);
    for (size_t i = 0; i < cell->cut_corners; i++) {
        double value = -plane.c;
        for (int k = 0; k < t->dim; k++) value += plane.n[k] * cell->cut_coords[i * (size_t)t->dim + (size_t)k];
        assert_true(fabs(value) < 1e-9);
    }
}

static bool add_cell(void *user, const froe_cell *cell) {
    tally *t = user;
    assert_int_equal(cell->face_starts[0], 0);
    assert_int_equal(cell->face_starts[cell->face_count], cell->corners);
    double measure = t->dim == 2 ? polygon_area(cell->coords, cell->corners) : polyhedron_volume(cell);
    assert_true(measure > -1e-12);
    if (t->dim == 2) assert_int_equal(cell->face_count, 1);
    if (!t->cells) t->root_measure = measure;
    if (cell->leaf) {
        assert_int_equal(cell->cut_corners, 0);
        t->leaves++;
        t->leaf_measure += measure;
    }
    if (cell->cut_corners) {
        t->cuts++;
        check_cut(t, cell);
    }
    assert_true(t->cells == 0 ? cell->depth == 0 : cell->depth <= t->last_depth + 1); /* parents first */
    t->last_depth = cell->depth;
    return ++t->cells != t->stop_after;
}

static tally cells_in(const froe_tree *tree, const double *lo, const double *hi) {
    tally t = {.dim = froe_scene_dim(froe_tree_scene(tree)), .tree = tree};
    assert_int_equal(froe_tree_cells(tree, lo, hi, add_cell, &t, NULL), FROE_OK);
    return t;
}

/* --------------------------------------------------------------------- cells -- */

static void leaves_tile_the_box(void **state) {
    (void)state;
    const double lo[3] = {-0.5, -0.5, -0.5}, hi[3] = {1.5, 1.5, 1.5};
    const char *const methods[] = {"autopartition", "density"};
    for (int dim = 2; dim <= 3; dim++)
        for (int m = 0; m < 2; m++)
            for (uint32_t grid = 0; grid <= 4; grid += 4) {
                froe_tree *tree = trees_grow(dim, dim == 2 ? FROE_SEGMENT : FROE_POLYGON, 60, grid, 0.6, methods[m], 1);
                tally t = cells_in(tree, lo, hi);
                assert_true(fabs(t.root_measure - (dim == 2 ? 4 : 8)) < 1e-12);
                assert_true(fabs(t.leaf_measure - t.root_measure) < 1e-9);
                assert_true(t.leaves > 5 && t.cuts == t.leaves - 1);
                froe_tree_free(tree);
            }
}

/* Walls that stand on edges of triangles. */
static void leaves_between_walls_tile_the_box(void **state) {
    (void)state;
    const double lo[3] = {-0.5, -0.5, -0.5}, hi[3] = {1.5, 1.5, 1.5};
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 30, 0, 0.03, "cylindrical", 1);
    const tally t = cells_in(tree, lo, hi);
    assert_true(fabs(t.leaf_measure - 8) < 1e-9);
    assert_true(t.leaves > 30 && t.cuts == t.leaves - 1);
    froe_tree_free(tree);
}

static void parts_of_a_tree_are_cells_of_a_smaller_box(void **state) {
    (void)state;
    const double lo[2] = {0.4, 0.4}, hi[2] = {0.5, 0.6};
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 300, 0, 0.2, "density", 1);
    tally t = cells_in(tree, lo, hi);
    assert_true(fabs(t.leaf_measure - 0.02) < 1e-12);
    assert_true(t.cells < tree->node_count / 4);
    froe_tree_free(tree);
}

static void flat_and_point_boxes_have_cells_too(void **state) {
    (void)state;
    const double lo[3] = {-1, -1, 0.3}, hi[3] = {2, 2, 0.3}, point[3] = {0.2, 0.2, 0.2};
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 60, 0, 0.6, "density", 1);
    tally t = cells_in(tree, lo, hi);
    assert_true(t.leaves > 10 && t.leaves < tree->node_count / 2);
    assert_true(cells_in(tree, point, point).leaves >= 1);
    froe_tree_free(tree);
}

enum { FAR_CORNERS = 400 };
static const double far_away = 0x1p49; /* doubles there are multiples of 1/8 */

static bool add_far_leaf(void *user, const froe_cell *cell) {
    tally *t = user;
    double near[3 * FAR_CORNERS];
    assert_true(cell->corners <= FAR_CORNERS);
    for (size_t i = 0; i < cell->corners * (size_t)t->dim; i++) near[i] = cell->coords[i] - far_away;
    froe_cell moved = *cell;
    moved.coords = near;
    const double measure = t->dim == 2 ? polygon_area(near, cell->corners) : polyhedron_volume(&moved);
    if (!t->cells++) t->root_measure = measure;
    t->leaves += cell->leaf;
    t->leaf_measure += cell->leaf ? measure : 0;
    return true;
}

static bool add_leaf_far_along(void *user, const froe_cell *cell) {
    tally *t = user;
    double near[2 * FAR_CORNERS];
    assert_true(cell->corners <= FAR_CORNERS);
    for (size_t i = 0; i < 2 * cell->corners; i++) near[i] = cell->coords[i] - (i % 2 ? 0 : far_away);
    const double measure = polygon_area(near, cell->corners);
    if (!t->cells++) t->root_measure = measure;
    t->leaves += cell->leaf;
    t->leaf_measure += cell->leaf ? measure : 0;
    return true;
}

/* Cuts through corners and, with `section`, an oblique one that is given by numbers. */
static void leaves_far_from_the_origin_tile_the_box(void **state) {
    (void)state;
    const double lo[3] = {far_away, far_away, far_away}, hi[3] = {far_away + 64, far_away + 64, far_away + 64};
    for (int dim = 2; dim <= 3; dim++)
        for (int section = 0; section < 2; section++) {
            enum { N = 24 };
            double x[9 * N], plane[4] = {1, 1, 1, 1};
            for (int i = 0; i < 9 * N; i++) x[i] = far_away + trees_random(7, (uint64_t)i, 65);
            froe_objects objects = froe_objects_defaults();
            froe_scene *scene;
            objects.kind = dim == 2 ? FROE_SEGMENT : FROE_POLYGON;
            objects.count = N, objects.coords = x;
            assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
            assert_int_equal(froe_scene_add(scene, &objects, NULL), FROE_OK);
            froe_tree *whole = trees_build(scene, "autopartition", 1), *tree = whole;
            plane[dim] = dim * far_away + 48;
            if (section) assert_int_equal(froe_tree_section(whole, plane, NULL, &tree, NULL), FROE_OK);
            tally t = {.dim = dim};
            assert_int_equal(froe_tree_cells(tree, lo, hi, add_far_leaf, &t, NULL), FROE_OK);
            assert_true(10 * t.leaves > 9 * froe_tree_report(tree).leaves);
            assert_true(fabs(t.leaf_measure / t.root_measure - 1) < 0.05);
            if (section) froe_tree_free(whole);
            froe_tree_free(tree), froe_scene_free(scene);
        }
}

/* Adds leaf areas in units of unit^2; all coordinates must be finite. */
typedef struct scaled {
    double unit, sum;
    size_t leaves;
} scaled;

static bool measure_leaf(void *user, const froe_cell *cell) {
    scaled *s = user;
    double x[2 * 64];
    assert_true(cell->corners <= 64);
    for (size_t i = 0; i < 2 * cell->corners; i++) {
        assert_true(isfinite(cell->coords[i]));
        x[i] = cell->coords[i] / s->unit;
    }
    s->leaves += cell->leaf;
    if (cell->leaf) s->sum += polygon_area(x, cell->corners);
    return true;
}

static void no_scale_overflows(void **state) {
    (void)state;
    const double scales[] = {1.5e308, 1e200, 1e-200, 0x1p-1060};
    for (size_t i = 0; i < 4; i++) {
        froe_scene *scene;
        assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
        for (uint32_t j = 0; j < 30; j++) {
            double x[4];
            for (uint32_t k = 0; k < 4; k++) x[k] = scales[i] * (2 * trees_unit(j, k) - 1);
            assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, x, NULL, NULL), FROE_OK);
        }
        froe_tree *tree = trees_build(scene, "autopartition", 1);
        const double lo[2] = {-scales[i], -scales[i]}, hi[2] = {scales[i], scales[i]};
        scaled s = {.unit = scales[i]};
        assert_int_equal(froe_tree_cells(tree, lo, hi, measure_leaf, &s, NULL), FROE_OK);
        assert_true(s.leaves > 30 && fabs(s.sum - 4) < 1e-3);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/* A box of one scale around, or within, a tree of another. */
static void boxes_of_other_scales_are_no_trouble(void **state) {
    (void)state;
    const double scales[] = {1.7e308, 1e30, 1e-30, 1e-300};
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 40, 0, 0.9, "autopartition", 1);
    for (size_t i = 0; i < 4; i++) {
        const double lo[2] = {-scales[i], -scales[i]}, hi[2] = {scales[i], scales[i]};
        scaled s = {.unit = scales[i]};
        assert_int_equal(froe_tree_cells(tree, lo, hi, measure_leaf, &s, NULL), FROE_OK);
        assert_true(s.leaves >= 1 && fabs(s.sum - 4) < 1e-9);
    }
    froe_tree_free(tree);
}

static void visitors_stop_and_bad_boxes_are_refused(void **state) {
    (void)state;
    const double lo[2] = {0, 0}, hi[2] = {1, 1}, bad[2] = {1, -1}, nan_hi[2] = {1, NAN}, inf_hi[2] = {INFINITY, 1};
    froe_diagnostic why;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 30, 0, 0.5, "density", 1);
    tally t = {.dim = 2, .tree = tree, .stop_after = 5};
    assert_int_equal(froe_tree_cells(tree, lo, hi, add_cell, &t, NULL), FROE_OK);
    assert_int_equal(t.cells, 5);
    assert_int_equal(froe_tree_cells(tree, lo, bad, add_cell, &t, &why), FROE_E_ARG);
    assert_int_equal(why.axis, 1);
    assert_int_equal(froe_tree_cells(tree, lo, nan_hi, add_cell, &t, &why), FROE_E_ARG);
    assert_int_equal(froe_tree_cells(tree, lo, inf_hi, add_cell, &t, &why), FROE_E_ARG);
    assert_int_equal(why.axis, 0);
    assert_int_equal(froe_tree_cells(tree, lo, hi, NULL, NULL, &why), FROE_E_ARG);
    froe_tree_free(tree);
    tree = trees_grow(4, FROE_POINT, 3, 0, 0, "density", 1);
    assert_int_equal(froe_tree_cells(tree, lo, hi, add_cell, &t, &why), FROE_E_UNSUPPORTED);
    froe_tree_free(tree);
}

/* Every cut takes a corner off: cells of many faces, a chain of many levels. */
static void a_chain_of_many_cuts_needs_no_stack(void **state) {
    (void)state;
    enum { DEPTH = 3000 };
    const tree_meta meta = {.method = "by hand", .leaf = 1};
    const double lo[2] = {-2, -2}, hi[2] = {2, 2};
    froe_scene *scene = trees_scene(2, FROE_POINT, 0, 0, 0, 1);
    tree_draft draft;
    froe_tree *tree;
    uint32_t node = 0, child;
    assert_int_equal(draft_new(NULL, 2, 0, &draft), FROE_OK);
    for (uint32_t i = 0; i < DEPTH; i++, node = child) {
        double a = 2 * 3.14159265358979 * i / DEPTH, normal[2] = {cos(a), sin(a)};
        froe_cut cut = {.kind = FROE_CUT_PLANE, .normal = normal, .value = 1};
        assert_int_equal(draft_split(&draft, node, &cut, 0, &child), FROE_OK);
    }
    assert_int_equal(draft_seal(&draft, NULL, 0, scene, &meta, &tree), FROE_OK);
    draft_free(&draft);
    froe_scene_free(scene);
    tally t = cells_in(tree, lo, hi);
    assert_int_equal(t.leaves, DEPTH + 1);
    assert_true(fabs(t.leaf_measure - 16) < 1e-9);
    froe_tree_free(tree);
}

static bool nothing(void *user, const froe_cell *cell) {
    (void)user;
    return cell->corners > 0;
}

static froe_status showing(void *user, const froe_allocator *alloc) {
    froe_tree *tree = user;
    const double lo[3] = {0, 0, 0}, hi[3] = {1, 1, 1};
    froe_allocator own = tree->alloc;
    tree->alloc = *alloc;
    froe_status status = froe_tree_cells(tree, lo, hi, nothing, NULL, NULL);
    tree->alloc = own;
    return status;
}

/* Triangles in planes that touch a ball: the cell within has as many faces as there are planes. */
static froe_tree *round_cell(void) {
    enum { PLANES = 24 };
    double corners[9 * PLANES];
    size_t starts[PLANES + 1] = {0};
    for (int i = 0; i < PLANES; i++) {
        const double z = 1 - (2 * i + 1.0) / PLANES, turn = 2.4 * i, r = sqrt(1 - z * z);
        const double n[3] = {r * cos(turn), r * sin(turn), z}, u[3] = {-sin(turn), cos(turn), 0};
        const double v[3] = {-z * cos(turn), -z * sin(turn), r}, away[3][2] = {{-1, -1}, {1, -1}, {0, 1}};
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++)
                corners[9 * i + 3 * c + k] = 0.5 + 0.4 * n[k] + 0.01 * (away[c][0] * u[k] + away[c][1] * v[k]);
        starts[i + 1] = 3 * (size_t)(i + 1);
    }
    return trees_of_polygons(corners, starts, PLANES, "autopartition");
}

static bool count_corners(void *user, const froe_cell *cell) {
    size_t *most = user;
    if (cell->leaf && cell->corners > *most) *most = cell->corners;
    return true;
}

static void memory_may_end_at_cells_of_many_faces(void **state) {
    (void)state;
    const double lo[3] = {0, 0, 0}, hi[3] = {1, 1, 1};
    froe_tree *tree = round_cell();
    size_t most = 0;
    assert_int_equal(froe_tree_cells(tree, lo, hi, count_corners, &most, NULL), FROE_OK);
    assert_true(most > 28); /* of a solid with f faces at most 2 f - 4: more than 16 faces */
    assert_true(test_memory_each(showing, tree) > 15);
    froe_tree_free(tree);
}

static void any_allocation_may_fail(void **state) {
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        froe_tree *tree = trees_grow(dim, dim == 2 ? FROE_SEGMENT : FROE_POLYGON, 12, 0, 0.8, "autopartition", 1);
        assert_true(test_memory_each(showing, tree) > 15);
        froe_tree_free(tree);
    }
}

/* -------------------------------------------------------------------- corners -- */

static double length_of(const double *x, int dim) {
    double square = 0;
    for (int k = 0; k < dim; k++) square += (x[dim + k] - x[k]) * (x[dim + k] - x[k]);
    return sqrt(square);
}

static double area_of(const double *x, size_t corners) {
    double sum[3] = {0};
    for (size_t i = 1; i + 1 < corners; i++) {
        double a[3], b[3];
        for (int k = 0; k < 3; k++) a[k] = x[3 * i + (size_t)k] - x[k], b[k] = x[3 * i + 3 + (size_t)k] - x[k];
        for (int k = 0; k < 3; k++) sum[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
    return 0.5 * sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
}

static double measure_of(const double *x, size_t corners, int dim) {
    return corners == 2 ? length_of(x, dim) : corners > 2 ? area_of(x, corners) : 0;
}

static void pieces_add_up_to_their_objects(void **state) {
    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (uint32_t grid = 0; grid <= 4; grid += 4) {
            enum { OBJECTS = 80 };
            froe_tree *tree = trees_grow(dim, dim == 2 ? FROE_SEGMENT : FROE_POLYGON, OBJECTS, grid, 0.7, "density", 1);
            const froe_scene *scene = froe_tree_scene(tree);
            double sum[OBJECTS] = {0}, x[64 * 3];
            for (size_t i = 0; i < froe_tree_piece_count(tree); i++) {
                size_t corners = froe_tree_piece_corners(tree, i, x, NULL, 64);
                assert_int_equal(corners, froe_tree_piece(tree, i).corners);
                sum[froe_tree_piece(tree, i).object] += measure_of(x, corners, dim);
            }
            for (uint32_t o = 0; o < OBJECTS; o++) {
                uint32_t corners = froe_scene_object(scene, o).corners;
                for (uint32_t c = 0; c < corners; c++)
                    memcpy(x + c * (size_t)dim, scene_point(scene, o, c), (size_t)dim * sizeof *x);
                assert_true(fabs(sum[o] - measure_of(x, corners, dim)) < 1e-12);
            }
            froe_tree_free(tree);
        }
}

/* An edge that a cut made has both its corners on the cut. */
static void made_edges_lie_in_their_cuts(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 80, 0, 0.7, "density", 1);
    size_t made_edges = 0;
    for (size_t i = 0; i < froe_tree_piece_count(tree); i++) {
        double x[64 * 3];
        froe_node made[64];
        size_t corners = froe_tree_piece_corners(tree, i, x, made, 64);
        for (size_t c = 0; c < corners; c++) {
            if (!made[c].id1) continue;
            geom_plane exact = tree_plane_at(tree, made[c].id1 - 1);
            shape_plane plane = shape_plane_from(&exact, &(shape_frame){.exponent = 0});
            for (size_t e = 0; e < 2; e++) {
                const double *p = x + 3 * ((c + e) % corners);
                assert_true(fabs(plane.n[0] * p[0] + plane.n[1] * p[1] + plane.n[2] * p[2] - plane.c) < 1e-13);
            }
            made_edges++;
        }
    }
    assert_true(made_edges > 100);
    froe_tree_free(tree);
}

static void *read_corners(void *user) {
    const froe_tree *tree = user;
    double x[64 * 2], *sum = calloc(1, sizeof *sum);
    for (size_t turn = 0; turn < 5; turn++)
        for (size_t i = 0; i < froe_tree_piece_count(tree); i++) {
            size_t corners = froe_tree_piece_corners(tree, i, x, NULL, 64);
            for (size_t k = 0; k < 2 * corners; k++) *sum += x[k];
        }
    return sum;
}

static void *no_memory(void *user, void *ptr, size_t old_size, size_t new_size) {
    (void)user;
    (void)old_size;
    if (!new_size) free(ptr);
    return NULL;
}

/* Many threads share the spare context of a tree, with memory for more and without. */
static void threads_read_corners_together(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 300, 0, 0.3, "density", 1);
    froe_allocator own = tree->alloc;
    double *expected = read_corners(tree);
    for (int scarce = 0; scarce < 2; scarce++) {
        pthread_t threads[4];
        if (scarce) tree->alloc = (froe_allocator){no_memory, NULL};
        for (int i = 0; i < 4; i++) assert_int_equal(pthread_create(threads + i, NULL, read_corners, tree), 0);
        for (int i = 0; i < 4; i++) {
            void *sum;
            pthread_join(threads[i], &sum);
            assert_true(*(double *)sum == *expected);
            free(sum);
        }
    }
    tree->alloc = own;
    free(expected);
    froe_tree_free(tree);
}

static bool count_leaves(void *user, const froe_cell *cell) {
    *(size_t *)user += cell->leaf;
    return true;
}

/* A cut through two corners of the box has no edge of it to cross, and one beside the box divides nothing. */
static void cuts_through_corners_of_the_box_have_sections(void **state) {
    static const double diagonal[] = {-1, -1, 4, 4}, triangle[] = {-1, -1, 0, 4, 4, 0, -1, -1, 3};
    static const double lo[3] = {0, 0, 0}, hi[3] = {2, 2, 2}, off[3] = {0.5, 0, 0};
    static const size_t starts[] = {0, 3};
    (void)state;
    for (int dim = 2; dim <= 3; dim++)
        for (int beside = 0; beside < 2; beside++) {
            froe_scene *scene;
            assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
            assert_int_equal(trees_add(scene, dim == 2 ? FROE_SEGMENT : FROE_POLYGON, 1, dim == 2 ? diagonal : triangle,
                                       NULL, dim == 2 ? NULL : starts),
                             FROE_OK);
            froe_tree *tree = trees_build(scene, "autopartition", 0);
            assert_int_equal(tree->node_count, 3);
            const tally t = cells_in(tree, beside ? off : lo, hi);
            assert_int_equal(t.leaves, 2);
            assert_int_equal(t.cuts, 1); /* check_cut() has looked at its corners */
            assert_true(fabs(t.leaf_measure - t.root_measure) < 1e-12);
            froe_tree_free(tree), froe_scene_free(scene);
        }
}

/* Along the first axis 2^49 away, along the second beside 0, on either side of it or across it: numbers count from the
 * nearer side where its distance from 0 is at least half that of the other side. */
static void boxes_far_along_one_axis_are_tiled(void **state) {
    static const double sides[][2] = {{-3, -1}, {1, 3}, {-1, 1}, {-64, -62}, {62, 64}}, origins[] = {0, 0, 0, -62, 62};
    (void)state;
    for (size_t i = 0; i < sizeof sides / sizeof *sides; i++) {
        const double lo[2] = {far_away, sides[i][0]}, hi[2] = {far_away + 64, sides[i][1]};
        const double coords[8] = {far_away + 8,  lo[1] + 0.5,  far_away + 24, lo[1] + 1.5,
                                  far_away + 40, lo[1] + 0.25, far_away + 56, lo[1] + 0.75};
        const shape_frame frame = shape_frame_of(2, lo, hi);
        tally t = {.dim = 2};
        froe_scene *scene;
        assert_true(frame.origin[0] == far_away && frame.origin[1] == origins[i]);
        assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_SEGMENT, 2, coords, NULL, NULL), FROE_OK);
        t.tree = trees_build(scene, "autopartition", 1);
        assert_int_equal(froe_tree_cells(t.tree, lo, hi, add_leaf_far_along, &t, NULL), FROE_OK);
        assert_true(t.leaves >= 2);
        assert_true(fabs(t.leaf_measure - 128) < 1e-9 && t.root_measure == 128);
        froe_tree_free((froe_tree *)(uintptr_t)t.tree), froe_scene_free(scene);
    }
}

/* Cuts so far from the box that they overflow in its units are on one side of it. */
static void boxes_far_smaller_than_the_tree_are_in_one_leaf(void **state) {
    (void)state;
    for (int dim = 2; dim <= 3; dim++) {
        const size_t d = (size_t)dim, count = 12;
        double coords[12 * 9];
        size_t starts[13];
        for (size_t i = 0; i <= count; i++) starts[i] = 3 * i;
        for (size_t i = 0; i < count * d * d; i++) coords[i] = ldexp(trees_unit(4, i) + 0.25, 400);
        froe_scene *scene;
        assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
        assert_int_equal(
            trees_add(scene, dim == 2 ? FROE_SEGMENT : FROE_POLYGON, count, coords, NULL, dim == 2 ? NULL : starts),
            FROE_OK);
        froe_tree *tree = trees_build(scene, "autopartition", 1);
        const double tiny[3] = {0x1p-1000, 0x1p-1000, 0x1p-1000}, zero[3] = {0, 0, 0};
        size_t leaves = 0;
        assert_int_equal(froe_tree_cells(tree, zero, tiny, count_leaves, &leaves, NULL), FROE_OK);
        assert_int_equal(leaves, 1);
        froe_tree_free(tree), froe_scene_free(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cuts_through_corners_of_the_box_have_sections),
        cmocka_unit_test(boxes_far_smaller_than_the_tree_are_in_one_leaf),
        cmocka_unit_test(boxes_far_along_one_axis_are_tiled),
        cmocka_unit_test(leaves_tile_the_box),
        cmocka_unit_test(leaves_between_walls_tile_the_box),
        cmocka_unit_test(parts_of_a_tree_are_cells_of_a_smaller_box),
        cmocka_unit_test(flat_and_point_boxes_have_cells_too),
        cmocka_unit_test(leaves_far_from_the_origin_tile_the_box),
        cmocka_unit_test(no_scale_overflows),
        cmocka_unit_test(boxes_of_other_scales_are_no_trouble),
        cmocka_unit_test(visitors_stop_and_bad_boxes_are_refused),
        cmocka_unit_test(a_chain_of_many_cuts_needs_no_stack),
        cmocka_unit_test(any_allocation_may_fail),
        cmocka_unit_test(memory_may_end_at_cells_of_many_faces),
        cmocka_unit_test(pieces_add_up_to_their_objects),
        cmocka_unit_test(made_edges_lie_in_their_cuts),
        cmocka_unit_test(threads_read_corners_together),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
