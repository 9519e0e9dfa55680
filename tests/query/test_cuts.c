/* test_cuts.c: the error bounds by which queries go beside cuts through crossings: they cover that nobody knows exactly
 * where the crossing is, and charge hardly more. */
#include "query/cuts.h"
#include "tree/trees.h"
#include <froe/query.h>
#include <gmp.h>

enum { SEGMENTS = 30, PLACES = 64 };

/* Segments of which many cross, some of them nearly parallel. */
static froe_scene *crossing_segments(uint64_t seed) {
    double coords[4 * SEGMENTS];
    froe_objects o = froe_objects_defaults();
    froe_scene *scene;
    for (int i = 0; i < SEGMENTS; i++)
        for (int k = 0; k < 4; k++)
            coords[4 * i + k] = ldexp((double)(base_mix(seed + (uint64_t)(4 * i + k)) >> 11), -53) * (k % 2 ? 0.1 : 1);
    o.kind = FROE_SEGMENT, o.count = SEGMENTS, o.coords = coords;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    return scene;
}

/* Is |value - (x - c)| + reserve <= error, exactly? */
static bool is_covered(double value, double x, double c, double reserve, double error) {
    mpq_t off, other;
    mpq_init(off), mpq_init(other);
    mpq_set_d(off, value);
    mpq_set_d(other, x), mpq_sub(off, off, other);
    mpq_set_d(other, c), mpq_add(off, off, other);
    mpq_abs(off, off);
    mpq_set_d(other, reserve), mpq_add(off, off, other);
    mpq_set_d(other, error);
    const bool covered = mpq_cmp(off, other) <= 0;
    mpq_clear(off), mpq_clear(other);
    return covered;
}

/* Beside one cut: near the place where it is measured from, where the least is charged, and near the cut. */
static void assert_bounds(const geom_plane *plane, const query_plane *h) {
    double error;
    for (int i = 0; i < PLACES; i++) {
        const double share = ldexp((double)(base_mix((uint64_t)i) >> 11), -53), k = h->c;
        const double places[] = {h->o[0] + k * share * 0x1p-20, plane->c + plane->c_err * (2 * share - 1),
                                 plane->c + k * share};
        for (size_t p = 0; p < sizeof places / sizeof *places; p++) {
            const double x[3] = {places[p], 0.05, 0}, value = query_plane_value(h, 2, x, &error);
            assert_true(is_covered(value, x[0], plane->c, plane->c_err, error));
        }
    }
    /* the least that is charged is not much more than there is */
    const double x[3] = {h->o[0], 0.05, 0};
    query_plane_value(h, 2, x, &error);
    assert_true(error <= 1.4 * (plane->c_err + FILTER_U * fabs(plane->c)) + NUM_BALL_TINY);
}

static void bounds_beside_crossings_are_right_and_small(void **state) {
    uint32_t seen = 0;
    (void)state;
    for (uint64_t seed = 1; seed <= 10; seed++) {
        froe_scene *scene = crossing_segments(1000 * seed);
        froe_tree *tree = trees_build(scene, "cylindrical", 1);
        froe_scene_free(scene);
        const query_planes *planes;
        froe_query *q;
        assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
        assert_int_equal(query_planes_of(q, &planes, NULL), FROE_OK);
        for (uint32_t v = 0; v < tree->node_count; v++) {
            const tree_node *node = tree->nodes + v;
            if (tree_is_leaf(node) || node->type != TREE_TABLED || tree->cuts[node->u.cut].kind != FROE_CUT_CROSSING)
                continue;
            const geom_plane plane = tree_plane_at(tree, v);
            const query_cut cut = query_cut_at(tree, planes, node);
            assert_true(cut.plane->n_err == 0 && plane.c_err > 0);
            assert_bounds(&plane, cut.plane);
            seen++;
        }
        froe_query_free(q);
        froe_tree_free(tree);
    }
    assert_true(seen > 200);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_beside_crossings_are_right_and_small),
    };
    return cmocka_run_group_tests_name("query/cuts", tests, NULL, NULL);
}
