/* selftest.h: may the filters of this build be trusted? Hard cases of the formulas that decide. */
#ifndef FROE_GEOM_SELFTEST_H
#define FROE_GEOM_SELFTEST_H
#include "num/context.h"

/** As num_context_new(), for all layers above: predicates start at NUM_EXACT also where this build gives a wrong answer
 * to one of the hard cases. Some 10 us. */
froe_status geom_context_new(const froe_allocator *alloc, num_context *out);
/** Is every answer to the hard cases right, or "unsure"? By filters and balls alone where `exact` is false: then
 * NULL, or the name of the first formula that is wrong. */
const char *geom_formula_at_fault(num_context *context);
#endif
