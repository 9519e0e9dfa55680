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
#endif
