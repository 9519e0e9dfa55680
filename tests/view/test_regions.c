/* test_regions.c: rings against the pieces they are made of. Inside every piece the rings wind once around, outside all
 * pieces not at all; the area is the sum of the pieces' areas. */
#include "rays.h"
#include "view/visibility/visibility.h"

typedef struct counts {
    const froe_visibility *v;
    const froe_tree *tree;
    uint64_t patches, corners, piece_corners, holes, probes;
} counts;

/* The plane's two axes: those of the scene without that where the normal is largest. */
static void axes_of(const geom_plane *plane, int axes[2], double *turn) {
    int most = 0;
    for (int k = 1; k < 3; k++)
        if (fabs(plane->n[k]) > fabs(plane->n[most])) most = k;
    axes[0] = (most + 1) % 3, axes[1] = (most + 2) % 3;
    *turn = plane->n[most] > 0 ? 1 : -1;
}

static double ring_area(const double *x, size_t count, const int axes[2]) {
    double area = 0;
    for (size_t i = 0; i < count; i++) {
        const double *p = x + 3 * i, *q = x + 3 * ((i + 1) % count);
        area += p[axes[0]] * q[axes[1]] - q[axes[0]] * p[axes[1]];
    }
    return area / 2;
}

static int winding(const double *coords, const size_t *starts, size_t rings, const int axes[2], const double *at) {
    int turns = 0;
    for (size_t r = 0; r < rings; r++)
        for (size_t i = starts[r]; i < starts[r + 1]; i++) {
            const double *p = coords + 3 * i, *q = coords + 3 * (i + 1 < starts[r + 1] ? i + 1 : starts[r]);
            const double px = p[axes[0]] - at[0], py = p[axes[1]] - at[1], qx = q[axes[0]] - at[0],
                         qy = q[axes[1]] - at[1];
            if ((py <= 0) == (qy <= 0)) continue;
            const bool left = px * qy - qx * py > 0;
            if (left == (qy > py)) turns += qy > py ? 1 : -1;
        }
    return turns;
}

static bool check_region(void *user, uint32_t patch, const double *coords, const size_t *starts, size_t rings) {
    counts *c = user;
    const froe_visibility *v = c->v;
    geom_plane plane;
    int axes[2];
    double turn, area = 0, pieces = 0, corners[3 * 64];
    size_t first, count = froe_visibility_of_patch(v, patch, &first);
    assert_true(count > 0 && rings > 0);
    scene_support(c->tree->scene, froe_visibility_piece(v, first).object, &plane);
    axes_of(&plane, axes, &turn);
    turn *= v->sights.eye_sides[froe_visibility_piece(v, first).object];
    for (size_t r = 0; r < rings; r++) {
        assert_true(starts[r + 1] - starts[r] >= 3);
        const double a = turn * ring_area(coords + 3 * starts[r], starts[r + 1] - starts[r], axes);
        area += a;
        c->holes += a < 0;
    }
    for (size_t i = first; i < first + count; i++) {
        const size_t n = froe_visibility_corners(v, i, corners, 64);
        double middle[2] = {0, 0};
        for (size_t k = 0; k < 2 * n; k++) middle[k % 2] += corners[3 * (k / 2) + (size_t)axes[k % 2]] / (double)n;
        const double a = turn * ring_area(corners, n, axes);
        assert_true(a > -1e-12);
        pieces += a;
        c->piece_corners += n;
        if (a < 1e-7) continue;
        assert_int_equal(winding(coords, starts, rings, axes, middle), (int)turn);
        c->probes++;
    }
    assert_true(fabs(area - pieces) <= 1e-9 * (1 + pieces));
    c->patches++;
    c->corners += starts[rings];
    return true;
}

static void check_tree(froe_tree *tree, uint32_t eyes, uint64_t holes) {
    froe_surface *surface;
    counts c = {.tree = tree};
    assert_int_equal(froe_surface_new(tree->scene, NULL, &surface, NULL), FROE_OK);
    for (uint32_t e = 0; e < eyes; e++) {
        froe_visibility_options o = froe_visibility_defaults();
        froe_visibility *v;
        o.eye = rays_eye(tree, e);
        assert_int_equal(froe_visibility_new(tree, surface, &o, &v, NULL), FROE_OK);
        c.v = v;
        const uint64_t before = c.patches;
        assert_int_equal(froe_visibility_regions(v, 0, UINT32_MAX, check_region, &c, NULL), FROE_OK);
        assert_int_equal(c.patches - before, froe_visibility_statistics(v).visible_patches);
        froe_visibility_free(v);
    }
    print_message("  %d regions, %d corners in place of %d, %d holes, %d probes\n", (int)c.patches, (int)c.corners,
                  (int)c.piece_corners, (int)c.holes, (int)c.probes);
    assert_true(c.corners < c.piece_corners && c.holes >= holes);
    froe_surface_free(surface);
    froe_tree_free(tree);
}

static void random_triangles(void **state) {
    (void)state;
    check_tree(trees_grow(3, FROE_POLYGON, 100, 0, 1, "density", 1), 6, 0);
    check_tree(trees_grow(3, FROE_POLYGON, 300, 0, 0.3, "autopartition", 0), 3, 0);
}

static void triangles_of_a_lattice(void **state) {
    (void)state;
    check_tree(trees_grow(3, FROE_POLYGON, 90, 3, 2, "density", 1), 8, 0);
}

/* A wall behind small panes: its region has a hole for each, and is one ring around them. */
static void holes_behind_small_faces(void **state) {
    (void)state;
    froe_scene *scene;
    const double wall[12] = {0, 0, 0, 10, 0, 0, 10, 10, 0, 0, 10, 0};
    const size_t starts[2] = {0, 4};
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POLYGON, 1, wall, NULL, starts), FROE_OK);
    for (int i = 0; i < 9; i++) {
        const double x = 1 + 3 * (i % 3), y = 1 + 3 * (i / 3); /* NOLINT(bugprone-integer-division) */
        const double pane[12] = {x, y, 1, x + 1, y, 1, x + 1, y + 1, 1, x, y + 1, 1};
        assert_int_equal(trees_add(scene, FROE_POLYGON, 1, pane, NULL, starts), FROE_OK);
    }
    froe_tree *tree = trees_build(scene, "density", 1);
    froe_scene_free(scene);
    froe_surface *surface;
    froe_visibility *v;
    assert_int_equal(froe_surface_new(tree->scene, NULL, &surface, NULL), FROE_OK);
    froe_visibility_options o = froe_visibility_defaults();
    o.eye = (froe_eye){.at = {0, 0, 1}, .parallel = true};
    assert_int_equal(froe_visibility_new(tree, surface, &o, &v, NULL), FROE_OK);
    counts c = {.tree = tree, .v = v};
    assert_int_equal(froe_visibility_regions(v, 0, UINT32_MAX, check_region, &c, NULL), FROE_OK);
    assert_int_equal(c.patches, 10);
    assert_int_equal(c.holes, 9);
    assert_int_equal(c.corners, 4 + 2 * 9 * 4);
    froe_visibility_free(v);
    froe_surface_free(surface);
    froe_tree_free(tree);
}

static bool stop_at_once(void *user, uint32_t patch, const double *coords, const size_t *starts, size_t rings) {
    (void)patch, (void)coords, (void)starts, (void)rings;
    ++*(int *)user;
    return false;
}

static froe_status regions_with(void *user, const froe_allocator *alloc) {
    froe_tree *tree = user;
    froe_surface *surface = NULL;
    froe_visibility *v = NULL;
    froe_visibility_options o = froe_visibility_defaults();
    int calls = 0;
    o.eye.at[2] = 3;
    o.alloc = alloc;
    froe_status status = froe_surface_new(tree->scene, alloc, &surface, NULL);
    if (!status) status = froe_visibility_new(tree, surface, &o, &v, NULL);
    if (!status) status = froe_visibility_regions(v, 0, UINT32_MAX, stop_at_once, &calls, NULL);
    if (!status) assert_int_equal(calls, 1);
    froe_visibility_free(v);
    froe_surface_free(surface);
    return status;
}

static void every_allocation_may_fail_and_visitors_may_stop(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 20, 3, 1, "density", 1);
    assert_true(test_memory_each(regions_with, tree) > 20);
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_triangles),
        cmocka_unit_test(triangles_of_a_lattice),
        cmocka_unit_test(holes_behind_small_faces),
        cmocka_unit_test(every_allocation_may_fail_and_visitors_may_stop),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
