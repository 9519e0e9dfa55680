/* spaces.h: scenes of space, of all sizes and at all places, for tests of packed trees; and points that a search may
 * trip over. */
#ifndef FROE_TESTS_QUERY_SPACES_H
#define FROE_TESTS_QUERY_SPACES_H
#include "query/packed/space.h"
#include "support/sanitized.h"
#include "tree/trees.h"

typedef struct kind_of_scene {
    const char *name;
    uint32_t count, grid, leaf;
    double size, scale, shift;
    bool triangles; /* and nothing else */
} kind_of_scene;

static const kind_of_scene kinds[] = {
    {"random", 600, 0, 24, 0.2, 1, 0, false},
    {"large", 150, 0, 8, 1.2, 1, 0, false},
    {"small leaves", 300, 0, 2, 0.3, 1, 0, false},
    {"lattice", 300, 6, 8, 0.6, 1, 0, false},
    {"huge", 200, 0, 6, 0.5, 0x1p390, 0, false},
    {"too large for single precision", 100, 0, 6, 0.5, 0x1p900, 0, false},
    {"tiny", 200, 0, 6, 0.5, 0x1p-390, 0, false},
    {"far away", 300, 0, 8, 0.2, 1, 0x1p30, false},
    {"so far away that units are less than doubles can tell", 300, 0, 8, 0.2, 0x1p-8, 0x1p40, false},
    {"small beside a large one", 300, 0, 8, 0.2, 0x1p-34, 0.3, false},
    {"one", 1, 0, 24, 0.2, 1, 0, false},
    {"triangles", 600, 0, 24, 0.2, 1, 0, true},
};
enum { KINDS = sizeof kinds / sizeof *kinds, QUERIES = 80 / SANITIZED_SHARE(4) };

static inline double place(const kind_of_scene *k, double x) {
    return (k->grid ? floor(x * k->grid) : x) * k->scale + k->shift;
}

/* Triangles, and a few of everything else. */
static inline froe_tree *tree_of(const kind_of_scene *k) {
    froe_scene *scene;
    froe_tree *tree;
    froe_diagnostic why;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    /* Around a small part of a scene, rounding is far more than a unit of its leaves. */
    const double large[9] = {0, 0, 1, 1, 0, 1, 0, 1, 1};
    if (k->shift > 0 && k->shift < 1) assert_int_equal(trees_add(scene, FROE_POLYGON, 1, large, NULL, NULL), FROE_OK);
    for (uint32_t i = 0; i < k->count; i++) {
        double c[9], lo[3], hi[3], radius = 0.05 * k->scale;
        for (uint32_t j = 0; j < 9; j++) {
            double at = trees_unit(1, 9 * i + j % 3), x = at + k->size * (trees_unit(2, 9 * i + j) - 0.5);
            c[j] = place(k, x);
        }
        assert_int_equal(trees_add(scene, FROE_POLYGON, 1, c, NULL, NULL), FROE_OK);
        for (int j = 0; j < 3; j++) lo[j] = fmin(c[j], c[3 + j]), hi[j] = fmax(c[j], c[3 + j]);
        if (k->triangles) continue;
        if (i % 10 == 1) assert_int_equal(trees_add(scene, FROE_POLYGON, 1, c, NULL, NULL), FROE_OK); /* once more */
        const double box[6] = {lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]};
        if (i % 10 == 3) assert_int_equal(trees_add(scene, FROE_BOX, 1, box, NULL, NULL), FROE_OK);
        froe_objects ball = froe_objects_defaults();
        ball.kind = FROE_BALL, ball.count = 1, ball.coords = c, ball.radii = &radius;
        if (i % 10 == 5) assert_int_equal(froe_scene_add(scene, &ball, NULL), FROE_OK);
        if (i % 10 == 7) assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, c, NULL, NULL), FROE_OK);
        if (i % 10 == 9) assert_int_equal(trees_add(scene, FROE_POINT, 1, c, NULL, NULL), FROE_OK);
    }
    froe_build_options o = froe_build_defaults();
    o.method = "index", o.leaf = k->leaf;
    if (froe_build(scene, &o, &tree, &why)) fail_msg("%s: %s", k->name, why.message);
    froe_scene_free(scene);
    assert_true(tree_is_space(tree));
    if (froe_tree_audit(tree, NULL, &why)) fail_msg("%s: %s", k->name, why.message);
    return tree;
}

/* Coordinates that a search may trip over: of corners, of cuts, anything in and around the scene. */
static inline void odd_point(const froe_tree *t, uint64_t draw, double x[3]) {
    const froe_scene *s = t->scene;
    for (int k = 0; k < 3; k++) {
        double lo = t->meta.root_lo[k], hi = t->meta.root_hi[k],
               share = 1.2 * trees_unit(11, 3 * draw + (uint64_t)k) - 0.1;
        const tree_node *node = t->nodes + trees_random(12, 3 * draw + (uint64_t)k, t->node_count);
        x[k] = lo * (1 - share) + hi * share;
        uint32_t style = trees_random(13, 3 * draw + (uint64_t)k, 5);
        if (style == 0) x[k] = scene_vertex(s, trees_random(14, 3 * draw + (uint64_t)k, s->vertex_count))[k];
        if (style == 1 && !tree_is_leaf(node) && node->axis == k) x[k] = node->u.value;
    }
    if (draw % 4 == 0) memcpy(x, scene_vertex(s, trees_random(15, draw, s->vertex_count)), 3 * sizeof *x);
}

/* A general tree of the same scene, which other tests compare with oracles. */
static inline froe_tree *reference_of(const froe_tree *t) {
    froe_build_options o = froe_build_defaults();
    froe_tree *tree;
    o.method = "density", o.leaf = 1000000;
    assert_int_equal(froe_build(t->scene, &o, &tree, NULL), FROE_OK);
    return tree;
}
#endif
