/* test_facts.c: the box of the objects that a file tells, wrong in one number. */
#include "support/forge.h"
#include "support/tree_file.h"
#include "trees.h"

static froe_status check(const tree_file *f) {
    froe_tree *tree = NULL;
    froe_status status = froe_tree_open_memory(f->bytes, f->size, NULL, &tree, NULL);
    if (!status) status = froe_tree_check(tree, NULL);
    froe_tree_free(tree);
    return status;
}

/* A box of no objects, or of axes that there are not, is 0. */
static void facts_have_no_box_where_there_is_nothing(void **state) {
    (void)state;
    for (size_t count = 0; count <= 9; count += 9) {
        tree_file f = tree_file_of(trees_grow(2, FROE_SEGMENT, count, 0, 0.4, "autopartition", 1));
        tree_facts *facts = tree_file_at(&f, FILE_FACTS);
        assert_int_equal(check(&f), FROE_OK);
        for (int k = 0; k < 3; k++)
            for (int end = 1; end < 4; end++) { /* only the upper one; both */
                const tree_facts right = *facts;
                if (end & 2) facts->lo[k] += 0.125;
                facts->hi[k] += 0.125;
                forge_checksums(f.bytes, f.size);
                const bool there = count && k < 2; /* what is there is compared with the objects, later */
                froe_tree *tree = NULL;
                assert_int_equal(froe_tree_open_memory(f.bytes, f.size, NULL, &tree, NULL),
                                 there ? FROE_OK : FROE_E_FORMAT);
                if (there) assert_int_equal(froe_tree_check(tree, NULL), FROE_E_FORMAT);
                froe_tree_free(tree);
                *facts = right;
            }
        free(f.bytes);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(facts_have_no_box_where_there_is_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
