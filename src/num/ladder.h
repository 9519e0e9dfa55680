/* ladder.h: the stages of a decision, from the fastest to the one that always knows.
 *
 *     filter   doubles beside one error bound                              nearly all answers
 *     known    the input itself: equal points, coordinates compared        nearly all zeros of meshes
 *     ball     doubles with running error bounds (num/ball.h)              nearly all zeros of lattices
 *     exact    dyadic numbers (num/dyadic.h)                               the rest
 *
 * A stage answers -1, 0, 1 or NUM_UNSURE, and where it is unsure, the next is asked. `known` stands second because it
 * can do no more than prove a zero or lead to a simpler question, and there no filter is sure: so it costs nothing
 * where the filter decides. The context says which stage is the first, and counts which one gave the answer. */
#ifndef FROE_NUM_LADDER_H
#define FROE_NUM_LADDER_H
#include "num/ball.h"
#include "num/context.h"

/** These count how an answer was found, and return it. */
static inline int num_by_id(num_context *context, int sign) {
    context->stats.by_id++;
    return sign;
}
static inline int num_filtered(num_context *context, int sign) {
    context->stats.filtered++;
    return sign;
}
static inline int num_refined(num_context *context, int sign) {
    context->stats.refined++;
    return sign;
}
static inline int num_exact(num_context *context, int sign) {
    context->stats.exact++;
    context->stats.exact_zero += sign == 0;
    return sign;
}
/** For a filter that is asked before a predicate is called: counts a call, if it is sure. */
static inline int num_filtered_call(num_context *context, int sign) {
    context->stats.calls += sign != NUM_UNSURE;
    context->stats.filtered += sign != NUM_UNSURE;
    return sign;
}

/** The first sure answer. Each of the last four arguments is an expression that is computed only when it is asked.
 * `sign` is a variable of the caller's. `known` and `otherwise` count their answers themselves, and `otherwise` is
 * sure. */
#define NUM_STAGES(context, sign, filter, known, ball, otherwise)                                                      \
    ((context)->first == NUM_FILTER && ((sign) = (filter)) != NUM_UNSURE  ? num_filtered(context, sign)                \
     : (context)->first == NUM_FILTER && ((sign) = (known)) != NUM_UNSURE ? (sign)                                     \
     : (context)->first <= NUM_BALL && ((sign) = (ball)) != NUM_UNSURE    ? num_refined(context, sign)                 \
                                                                          : (otherwise))
/** The same with exact numbers as the last stage. */
#define NUM_LADDER(context, sign, filter, known, ball, exact)                                                          \
    NUM_STAGES(context, sign, filter, known, ball, num_exact(context, exact))
/** The same for a formula of a template (*_body.inc) that returns a sign: its arguments follow, without the arena. */
#define NUM_DECIDE(context, sign, filter, known, formula, ...)                                                         \
    NUM_LADDER(context, sign, filter, known, formula##_ball(NULL, __VA_ARGS__),                                        \
               formula##_dyadic(num_fresh(context), __VA_ARGS__))
#endif
