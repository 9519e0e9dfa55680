/* context.h: a context of predicates for a group of tests, or for each test, as its state. */
#ifndef FROE_TESTS_SUPPORT_CONTEXT_H
#define FROE_TESTS_SUPPORT_CONTEXT_H
#include "num/context.h"

static inline int context_open(void **state) {
    static num_context context;
    *state = &context;
    return num_context_new(NULL, &context) != FROE_OK;
}

static inline int context_close(void **state) {
    num_context_free(*state);
    return 0;
}
#endif
