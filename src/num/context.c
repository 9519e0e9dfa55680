/* context.c: arena, counters and first stage of one thread. */
#include "num/context.h"

froe_status num_context_new(const froe_allocator *alloc, num_context *out) {
    num_context context = {.alloc = support_allocator(alloc)};
    froe_status status = num_arena_new(&context.alloc, &context.arena);
    if (status != FROE_OK) return status;
    context.first = num_machine_trusted() ? NUM_FILTER : NUM_EXACT;
    *out = context;
    return FROE_OK;
}

void num_context_free(num_context *context) {
    num_arena_free(&context->alloc, &context->arena);
}

void num_stats_add(froe_predicate_stats *sum, const froe_predicate_stats *more) {
    sum->calls += more->calls;
    sum->by_id += more->by_id;
    sum->filtered += more->filtered;
    sum->refined += more->refined;
    sum->exact += more->exact;
    sum->exact_zero += more->exact_zero;
}
