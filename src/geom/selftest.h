/* selftest.h: may the filters of this build be trusted? Hard cases of the formulas that decide. */
#ifndef FROE_GEOM_SELFTEST_H
#define FROE_GEOM_SELFTEST_H
#include "num/context.h"

/** As num_context_new(), for all layers above: predicates start at NUM_EXACT also where this build gives a wrong answer
 * to one of the hard cases. Some 10 us. */
froe_status geom_context_new(const froe_allocator *alloc, num_context *out);
/** The name of the first formula with a wrong answer to one of its hard cases; NULL: all are right. Predicates start
 * where the context says. */
const char *geom_formula_at_fault(num_context *context);
#endif
