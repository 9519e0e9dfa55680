/* audits.h: what the tests of audits share. */
#ifndef FROE_TESTS_TREE_AUDITS_H
#define FROE_TESTS_TREE_AUDITS_H
#include "trees.h"

static inline froe_status audit(const froe_tree *tree, froe_diagnostic *why) {
    return froe_tree_audit(tree, NULL, why);
}

static inline void assert_right(const froe_tree *tree) {
    froe_diagnostic why;
    if (audit(tree, &why)) fail_msg("%s", why.message);
}

/* The violation found, whose message must speak of `what`. */
static inline void assert_wrong(const froe_tree *tree, const char *what) {
    froe_diagnostic why;
    if (audit(tree, &why) != FROE_E_AUDIT) fail_msg("not found: %s", what);
    assert_int_equal(why.status, FROE_E_AUDIT);
    if (!strstr(why.message, what)) fail_msg("%s instead of %s", why.message, what);
}

/* ------------------------------------------------------------------ trees by hand -- */

/* Trees whose lists the test chooses: pieces {node, object, ring}. */
typedef struct entry {
    uint32_t node, object, count, ring[4];
} entry;

static const tree_meta by_hand = {.method = "by hand", .leaf = 9};

/* Splits 0, then others as `splits` says; nodes count in the order of splitting. Leaves the scene to the caller. */
static inline froe_tree *hand_made(froe_scene *scene, const froe_cut *cuts, const uint32_t *splits,
                                   uint32_t split_count, const entry *entries, size_t entry_count,
                                   const tree_meta *meta) {
    tree_draft draft;
    froe_tree *tree;
    uint32_t child;
    assert_int_equal(draft_new(NULL, scene->dim, 0, &draft), FROE_OK);
    for (uint32_t i = 0; i < split_count; i++)
        assert_int_equal(draft_split(&draft, splits[i], cuts + i, 0, &child), FROE_OK);
    for (size_t i = 0; i < entry_count; i++) {
        if (!i || entries[i].node != entries[i - 1].node)
            assert_int_equal(draft_list(&draft, entries[i].node), FROE_OK);
        assert_int_equal(draft_piece(&draft, entries[i].node, entries[i].object,
                                     entries[i].count ? entries[i].ring : NULL, entries[i].count),
                         FROE_OK);
    }
    assert_int_equal(draft_seal(&draft, NULL, 0, scene, meta, &tree), FROE_OK);
    draft_free(&draft);
    return tree;
}
#endif
