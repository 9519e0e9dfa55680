/* Every builder on scenes of every scale at once: the audit passes, of sections, too, and the tree is the same where
 * predicates begin with exact numbers. */
#include "query/extremes.h"
#include "tree/tree.h"
#include <froe/view.h>
#include <stdio.h>

enum { BUDGET = 20000 };

static size_t trees, sections;

static void check(const froe_tree *tree, const char *what, uint64_t seed, uint32_t leaf) {
    froe_audit_options o = froe_audit_defaults();
    froe_diagnostic why = {0};
    o.exact_only = true;
    if (froe_tree_audit(tree, &o, &why))
        fail_msg("%s by %s, leaf %u, FROE_SEED=%llu: %s", what, froe_tree_report(tree).method, leaf,
                 (unsigned long long)seed, why.message);
}

/* By a plane through a vertex, mostly. */
static void check_section(fuzz_source *r, const froe_tree *tree, const froe_build_options *o, uint64_t seed) {
    const int dim = froe_scene_dim(tree->scene);
    double plane[FROE_MAX_DIM + 1] = {0};
    const double *x = extreme_vertex(r, tree->scene);
    for (int k = 0; k < dim; k++) {
        plane[k] = extreme_number(r, tree->scene);
        plane[dim] = extreme_finite(plane[dim] + plane[k] * (x ? x[k] : 0));
    }
    froe_tree *section;
    froe_diagnostic why;
    if (froe_tree_section(tree, plane, o, &section, &why)) return; /* a normal of 0, or by a method that makes none */
    check(section, "section", seed, o->leaf);
    froe_tree_free(section);
    sections++;
}

static void check_scene(int dim, unsigned kinds, uint64_t seed) {
    static const uint32_t leaves[] = {1, 0, 5};
    froe_scene *scene = extreme_scene_new(dim, kinds, seed % 8 ? 9 : 60, seed);
    fuzz_source r = {base_hash(seed, 81, 0)};
    for (size_t m = 0; froe_method_at(m); m++) {
        froe_build_options o = froe_build_defaults();
        const char *method = o.method = froe_method_at(m)->name;
        froe_tree *tree;
        o.leaf = leaves[(m + seed) % 3];
        o.threads = 1;
        o.max_fragments = BUDGET;
        if (!strcmp(method, "density")) o.settings = "k=4 stop=1";
        if (!strcmp(method, "cylindrical")) o.settings = "crossing=split";
        const froe_status status = froe_build(scene, &o, &tree, NULL);
        if (status) {
            assert_true(status == FROE_E_UNSUPPORTED || status == FROE_E_OPTIONS || status == FROE_E_BUDGET);
            continue;
        }
        trees++;
        check(tree, "tree", seed, o.leaf);
        check_section(&r, tree, &o, seed);
        froe_tree_free(tree);
    }
    froe_scene_free(scene);
}

static void trees_at_every_scale_pass_the_exact_audit(void **state) {
    enum { FLAT = 1 << FROE_POINT | 1 << FROE_SEGMENT, SOLID = 1 << FROE_BOX | 1 << FROE_BALL };
    static const unsigned kinds[][3] = {
        {1 << FROE_SEGMENT, FLAT, FLAT | SOLID | 1 << FROE_HULL},
        {1 << FROE_POLYGON, 1 << FROE_POLYGON | FLAT, FLAT | SOLID | 1 << FROE_HULL | 1 << FROE_POLYGON}};
    const uint64_t first = extreme_seed();
    (void)state;
    for (uint64_t seed = first; seed < first + 60 * extreme_rounds(); seed++) {
        const int dim = seed % 11 == 10 ? 4 + (int)(seed / 11 % (FROE_MAX_DIM - 3)) : 2 + (int)(seed % 2);
        check_scene(dim, dim > 3 ? 1 << FROE_POINT | SOLID : kinds[dim - 2][seed / 2 % 3], seed);
    }
    assert_true(trees > 300 && sections > 60);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(trees_at_every_scale_pass_the_exact_audit)};
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    print_message("%zu trees, %zu sections\n", trees, sections);
    return failed;
}
