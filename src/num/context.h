/* context.h: what a thread needs for predicates: an arena, counters, and how
 * far the filters may be trusted. One per thread; never shared. */
#ifndef FROE_NUM_CONTEXT_H
#define FROE_NUM_CONTEXT_H
#include "base/apart.h"
#include "num/dyadic.h"

/** Where evaluation starts. Tests start each stage by itself; on a machine that
 * fails the self-test everything starts at NUM_EXACT: slow rather than wrong. */
typedef enum num_stage { NUM_FILTER, NUM_BALL, NUM_EXACT } num_stage;

typedef struct num_context {
    num_arena arena;
    froe_predicate_stats stats;
    num_stage first;
    froe_allocator alloc;
    base_apart apart;
} num_context;

/** Runs the self-test (num_machine_trusted) and takes the arena: the only step that may fail. */
froe_status num_context_new(const froe_allocator *alloc, num_context *out);
void num_context_free(num_context *context);

/** The arena, for a new evaluation. */
static inline num_arena *num_fresh(num_context *context) {
    context->arena.top = 0;
    return &context->arena;
}
void num_stats_add(froe_predicate_stats *sum, const froe_predicate_stats *more);

/** These three are in selftest.c. Round to nearest, gradual underflow, no contraction, double evaluation: checked by
 * computing with values the compiler cannot see. */
bool num_machine_trusted(void);
/** Of these only what a program can change while it runs: the rounding mode, and whether
 * denormals are flushed. ~40 ns where denormal results are slow, ~3 ns elsewhere. */
bool num_rounding_trusted(void);
/** For calls with which all use of froe begins: FROE_E_UNSUPPORTED, with a sentence, where the rounding is not to be
 * trusted although froe has set its floating point (base/floats.h). */
froe_status num_rounding_check(froe_diagnostic *diag);
#endif
