/* test_shift.c: wherever a scene lies, grain makes the same tree of it, cut by cut and piece by piece. */
#include <froe/froe.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "meshes.h"

#define GRID 0x1p20 /* coordinates are multiples of 1 / GRID below 2^5, so that sums with 2^31 are exact */

/** A scene on the grid, moved by `by` on each axis, exactly. */
static froe_scene *moved(const froe_scene *from, const double *by) {
    const uint32_t dim = (uint32_t)froe_scene_dim(from);
    const size_t n = froe_scene_object_count(from);
    double *x = test_malloc(n * dim * dim * sizeof *x), *at = x;
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t corner = 0; corner < dim; corner++)
            for (uint32_t k = 0; k < dim; k++) {
                const uint32_t vertex = froe_scene_object(from, i).corners == dim ? froe_scene_corner(from, i, corner)
                                                                                  : froe_scene_corner(from, i, 0);
                const double place = round(froe_scene_vertex(from, vertex)[k] * GRID) / GRID;
                *at = place + by[k];
                assert_true(*at++ - by[k] == place);
            }
    froe_scene *scene = mesh_of((int)dim, x, n);
    test_free(x);
    return scene;
}

static froe_tree *grown(froe_scene *scene, const char *settings) {
    froe_build_options o = froe_build_defaults();
    froe_tree *tree = NULL;
    o.method = "grain";
    o.settings = settings;
    o.leaf = 0;
    o.threads = 1;
    assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
    return tree;
}

static void compare_cuts(const froe_cut *a, const froe_cut *b, const double *by) {
    assert_int_equal(a->kind, b->kind);
    if (a->kind == FROE_CUT_AXIS) {
        assert_int_equal(a->axis, b->axis);
        assert_true(a->value + by[a->axis] == b->value);
    } else {
        assert_memory_equal(a->id, b->id, sizeof a->id);
    }
}

/** The same objects, with edges made by the same cuts. */
static void compare_pieces(const froe_tree *a, const froe_tree *b, size_t piece) {
    froe_node made[2][64];
    double corners[2][64 * 3];
    const size_t n = froe_tree_piece_corners(a, piece, corners[0], made[0], 64);
    assert_true(n <= 64 && froe_tree_piece_corners(b, piece, corners[1], made[1], 64) == n);
    assert_int_equal(froe_tree_piece(a, piece).object, froe_tree_piece(b, piece).object);
    assert_memory_equal(made[0], made[1], n * sizeof **made);
}

static void compare_trees(const froe_tree *a, const froe_tree *b, const double *by) {
    enum { MOST = 256 };
    froe_node pending[MOST] = {froe_tree_root(a)};
    assert_int_equal(froe_tree_root(b).id1, pending->id1);
    assert_int_equal(froe_tree_piece_count(a), froe_tree_piece_count(b));
    for (size_t count = 1; count;) {
        const froe_node node = pending[--count];
        const froe_node_info p = froe_tree_node(a, node), q = froe_tree_node(b, node);
        compare_cuts(&p.cut, &q.cut, by);
        assert_int_equal(p.first_piece, q.first_piece);
        assert_int_equal(p.piece_count, q.piece_count);
        assert_memory_equal(p.child, q.child, sizeof p.child);
        if (p.cut.kind == FROE_CUT_NONE) continue;
        assert_true(count + 2 <= MOST);
        for (int side = 0; side < 2; side++) pending[count++] = p.child[side];
    }
    for (size_t i = 0; i < froe_tree_piece_count(a); i++) compare_pieces(a, b, i);
}

/** Frees the scene. */
static void compare_places(froe_scene *from, const char *settings) {
    static const double shifts[] = {0x1p15, 0x1p25, 0x1p31}; /* 2^10, 2^20 and 2^26 times the scene's size */
    const double here[3] = {0, 0, 0};
    froe_scene *scene = moved(from, here);
    froe_tree *tree = grown(scene, settings);
    for (size_t i = 0; i < sizeof shifts / sizeof *shifts; i++) {
        const double there[3] = {shifts[i], -shifts[i] / 2, shifts[i]};
        froe_scene *other = moved(from, there);
        froe_tree *far = grown(other, settings);
        compare_trees(tree, far, there);
        froe_tree_free(far);
        froe_scene_free(other);
    }
    froe_tree_free(tree);
    froe_scene_free(scene);
    froe_scene_free(from);
}

static void meshes_make_the_same_trees_everywhere(void **state) {
    (void)state;
    compare_places(mesh_new(MESH_HILLS, 1200), NULL);
    compare_places(mesh_new(MESH_LOOSE, 500), NULL);
    compare_places(mesh_new(MESH_LATTICE, 100), NULL);
    compare_places(mesh_new(MESH_FAN, 150), NULL);
    compare_places(mesh_new(MESH_HAIR, 60), NULL);
}

static void maps_make_the_same_trees_everywhere(void **state) {
    (void)state;
    compare_places(mesh_new(MESH_STROKES, 800), NULL);
    compare_places(mesh_new(MESH_MAP, 1000), NULL);
}

/** The boxes of pieces, whose corners are rounded, guide the cuts of cells that are thinned out. */
static void cells_that_are_thinned_out_make_the_same_trees_everywhere(void **state) {
    (void)state;
    compare_places(mesh_shells(50), NULL);
    compare_places(mesh_shells(120), "effort=fast");
}

/** Cells of more pieces than the sample, too. */
static void samples_and_efforts_make_the_same_trees_everywhere(void **state) {
    (void)state;
    compare_places(mesh_new(MESH_HILLS, 1500), "effort=fast");
    compare_places(mesh_new(MESH_MAP, 1500), "effort=fast");
    compare_places(mesh_new(MESH_LOOSE, 150), "effort=log");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meshes_make_the_same_trees_everywhere),
        cmocka_unit_test(maps_make_the_same_trees_everywhere),
        cmocka_unit_test(cells_that_are_thinned_out_make_the_same_trees_everywhere),
        cmocka_unit_test(samples_and_efforts_make_the_same_trees_everywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
