/* test_numbers.c: trees with numbers that no tree has, infinite or beyond what they count: each is refused. */
#include <math.h>

#include "support/forge.h"
#include "support/tree_file.h"
#include "tree/packed/space.h"
#include "tree/validate.h"
#include "trees.h"

static void assert_refused(const froe_tree *tree, const char *what) {
    froe_diagnostic why = {0};
    assert_int_equal(tree_validate(tree, &why), FROE_E_FORMAT);
    if (!strstr(why.message, what)) fail_msg("%s instead of %s", why.message, what);
}

/* ---------------------------------------------------------------------------- cuts -- */

/* How many cuts of a kind, none of which may have a number that is none. */
static int try_cuts(froe_tree *tree, froe_cut_kind kind) {
    int found = 0;
    for (uint32_t i = 0; i < tree->cut_count; i++) {
        tree_cut *cut = tree->cuts + i;
        const tree_cut right = *cut;
        if (cut->kind != kind) continue;
        found++;
        cut->u.value = INFINITY;
        assert_refused(tree, "a cut");
        cut->u.value = NAN;
        assert_refused(tree, "a cut");
        *cut = right;
        for (uint32_t k = 0; k < 2 && kind == FROE_CUT_PLANE; k++) {
            double *number = tree->normals + cut->a + k, before = *number;
            *number = -INFINITY;
            assert_refused(tree, "a cut");
            *number = before;
        }
    }
    assert_int_equal(tree_validate(tree, NULL), FROE_OK);
    return found;
}

static void cuts_have_finite_numbers(void **state) {
    (void)state;
    const double plane[] = {1, 2, 1.25};
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 9, 0, 0.4, "autopartition", 1), *lines = NULL;
    assert_int_equal(froe_tree_section(tree, plane, NULL, &lines, NULL), FROE_OK);
    froe_tree_free(tree);
    froe_tree *axes = trees_grow(2, FROE_SEGMENT, 30, 6, 0.5, "kd", 1);
    assert_true(try_cuts(lines, FROE_CUT_PLANE) == 1);
    assert_true(try_cuts(axes, FROE_CUT_AXIS) > 3);
    froe_tree_free(axes);
    froe_tree_free(lines);
}

/* -------------------------------------------------------------------------- blocks -- */

/* An object that lies in no cut ends, and a block whose coordinates say nothing says so. */
static void blocks_have_objects_and_scales_there_are(void **state) {
    (void)state;
    froe_tree *space = trees_grow(3, FROE_POLYGON, 20, 0, 0.4, "index", 6);
    froe_tree *plane = trees_grow(2, FROE_SEGMENT, 20, 0, 0.4, "index", 6);
    int found = 0;
    for (uint32_t node = 0; node < space->node_count; node++) {
        if (!tree_is_leaf(space->nodes + node) || !space->nodes[node].u.list.count) continue;
        uint32_t *ids = (uint32_t *)(uintptr_t)space_ids(space_block(space, space->nodes[node].child)), right = ids[0];
        ids[0] |= PACKED_END;
        assert_refused(space, "an object that does not exist");
        ids[0] = right, found++;
    }
    for (uint32_t node = 0; node < plane->node_count; node++) {
        if (!tree_is_leaf(plane->nodes + node)) continue;
        packed_header *h = (packed_header *)(uintptr_t)packed_block(plane, plane->nodes + node), right = *h;
        h->scale = 0;
        assert_refused(plane, "a block whose header does not fit");
        h->error = PACKED_COARSE, h->scale = right.scale;
        assert_refused(plane, "a block whose header does not fit");
        *h = right, found++;
    }
    assert_true(found > 6);
    assert_int_equal(tree_validate(space, NULL), FROE_OK);
    assert_int_equal(tree_validate(plane, NULL), FROE_OK);
    froe_tree_free(plane);
    froe_tree_free(space);
}

/* --------------------------------------------------------------------------- files -- */

static void files_tell_of_finite_cubes_and_depths(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 9, 0, 0.4, "autopartition", 1), *opened = NULL;
    const tree_file f = tree_file_of(tree);
    tree_meta *m = tree_file_at(&f, FILE_META);
    tree_facts *facts = tree_file_at(&f, FILE_FACTS);
    double *const numbers[] = {m->root_lo, m->root_hi + 1, m->root_lo + 2, &facts->mean_depth};
    const double wrong[] = {-INFINITY, NAN, 1, INFINITY};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        const double right = *numbers[i];
        *numbers[i] = wrong[i];
        forge_checksums(f.bytes, f.size);
        assert_int_equal(froe_tree_open_memory(f.bytes, f.size, NULL, &opened, NULL), FROE_E_FORMAT);
        assert_null(opened);
        *numbers[i] = right;
    }
    forge_checksums(f.bytes, f.size);
    assert_int_equal(froe_tree_open_memory(f.bytes, f.size, NULL, &opened, NULL), FROE_OK);
    froe_tree_free(opened);
    free(f.bytes);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cuts_have_finite_numbers),
        cmocka_unit_test(blocks_have_objects_and_scales_there_are),
        cmocka_unit_test(files_tell_of_finite_cubes_and_depths),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
