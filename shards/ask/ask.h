/* ask.h: how a batch of questions is put to the trees of a folder.
 *
 * A question has a box, outside which it has no answers, and is asked of all shards that the box meets (reach.c). Or it
 * has answers with values, and of each shard a bound below them; then it is asked of one shard after the other, the
 * lowest bound first, until the next bound is beyond the answers there are (rounds.c).
 *
 * An object may be in several shards that are asked. It is reported by the first of them alone, so that nothing has to
 * be compared or remembered:
 *
 *     with a box      the first cell, by number, that meets what the boxes of object and question have in common: the
 *                     one of the lowest point of that (Dittrich and Seeger: Data redundancy and duplicate detection in
 *                     spatial join processing, 2000). It is asked, and has the object
 *     with bounds     the first of the shards whose cells meet the object's box, by bound, then number
 *
 * Values of different shards are compared as doubles, which are exact values rounded. Where two are equal, the objects
 * become a tree of a few objects, which is asked the same question and decides exactly (decide.c). Answers of one shard
 * keep the order that it tells them in. */
#ifndef FROE_SHARDS_ASK_H
#define FROE_SHARDS_ASK_H
#include "shards/folder.h"

typedef struct shards_question shards_question;

/** What a shard has answered. */
typedef struct shards_answers {
    froe_answers all;
    bool own; /**< put together here, and not freed by froe_answers_free(), which knows what froe's own batches hold */
} shards_answers;
void shards_answers_free(shards_answers *answers);

/** Asks `count` of the questions, those numbered by `which`, of one tree. */
typedef froe_status shards_ask_fn(const shards_question *q, froe_query *query, const size_t *which, size_t count,
                                  const froe_batch_options *options, shards_answers *out, froe_diagnostic *diag);
/** The same of questions that are rows of doubles. */
typedef froe_status shards_rows_fn(froe_query *query, const double *rows, size_t count,
                                   const froe_batch_options *options, froe_answers *out, froe_diagnostic *diag);
/** The box of question i. */
typedef void shards_box_fn(const shards_question *q, size_t i, double *lo, double *hi);
/** A bound below the values that question i can have in a box; infinite: it has no answers there. */
typedef double shards_bound_fn(const shards_question *q, size_t i, const double *lo, const double *hi);

struct shards_question {
    size_t count;
    int dim;
    shards_ask_fn *ask;
    shards_box_fn *box; /**< or NULL, and: */
    shards_bound_fn *bound;
    /* arguments; those of the question alone are set */
    const froe_range *ranges;
    const double *points, *directions; /**< dim doubles each; boxes: 2 dim */
    size_t width;                      /**< doubles of each question's `points` */
    shards_rows_fn *batch;             /**< what answers questions that are rows of these alone */
    size_t k;                          /**< how many answers are wanted, of rounds */
    double most;                       /**< largest value */
    bool any;                          /**< one answer is as good as another */
    bool counted;                      /**< only how many there are: a shard tells it as the tag of one answer */
    int way;                           /**< up or down */
    bool groups;                       /**< answers are groups */
    froe_relation relation;
    const froe_query *asking; /**< whose groups are the questions */
    froe_allocator alloc;
};

/** Receives an object that question i has found, each once. False: no memory. */
typedef bool shards_take_fn(void *user, size_t i, const froe_find *find);
/** Asks questions of every shard that they reach. */
froe_status shards_reach(froe_shards *s, const shards_question *q, const froe_batch_options *options,
                         shards_take_fn *take, void *user, froe_diagnostic *diag);
/** The same, as answers; those with values by value, ties undecided. */
froe_status shards_find_all(froe_shards *s, const shards_question *q, const froe_batch_options *options,
                            froe_finds *out, froe_diagnostic *diag);
/** Asks questions with bounds, shard by shard: k answers or more of each, by value, ties undecided. */
froe_status shards_rounds(froe_shards *s, const shards_question *q, const froe_batch_options *options, froe_finds *out,
                          froe_diagnostic *diag);
/** The same of questions that are counted: all that shards have told, or at least k. */
froe_status shards_rounds_count(froe_shards *s, const shards_question *q, const froe_batch_options *options,
                                uint64_t *counts, froe_diagnostic *diag);

/** One batch of questions to one shard. A bad question is no failure yet: `limit` becomes its number, from where on
 * questions are left out, and `bad` tells what is wrong with it; so the first bad one is found among all shards. */
typedef struct shards_call {
    froe_shards *s;
    const shards_question *q;
    froe_batch_options options; /**< threads alone */
    froe_progress_fn *progress;
    void *user;
    size_t limit;
    froe_diagnostic bad;
    shards_take_fn *take;
    void *take_user;
    double done, upto; /**< share of the work that was done, and that will be behind the next shards_call_all() */
} shards_call;
froe_status shards_call_begin(froe_shards *s, const shards_question *q, const froe_batch_options *options,
                              shards_call *out, froe_diagnostic *diag);
/** Asks the questions numbered by `which`, ascending, of a shard. `alone`: for each, whether it is asked of this shard
 * only. */
froe_status shards_call_shard(shards_call *call, uint32_t shard, const size_t *which, const bool *alone, size_t count,
                              froe_diagnostic *diag);
/** Asks every shard the questions that are listed for it: which[starts[t] .. starts[t + 1]) are those of shard t. If
 * several processes ask the folder together (share.h) all of them call it, also with a status that is a failure, which
 * ends the call in all of them. *more: are there questions, of any process? */
froe_status shards_call_all(shards_call *call, froe_status status, const size_t *starts, const size_t *which,
                            const bool *alone, bool *more, froe_diagnostic *diag);
/** Tells how much is done. FROE_E_CANCELLED. */
froe_status shards_call_progress(shards_call *call, double done, froe_diagnostic *diag);
/** The failure of the first bad question, if there was one. */
froe_status shards_call_end(const shards_call *call, froe_diagnostic *diag);

/** What was found, in any order. */
typedef struct shards_placed {
    size_t question;
    froe_find find;
} shards_placed;
typedef struct shards_gather {
    ARRAY(shards_placed) list;
    bool values; /**< the answers have values */
    froe_allocator alloc;
} shards_gather;
bool shards_gather_take(void *gather, size_t i, const froe_find *find); /**< a shards_take_fn */
/** A shards_take_fn of questions that are counted: adds to count i of an array of uint64_t. */
bool shards_add_count(void *counts, size_t i, const froe_find *find);
/** Answers question by question, each by tag, or by value; equal values in the order that they were taken in, which is
 * the exact one of answers of the same shard. Frees what was gathered. Behind the starts stands how many items there is
 * room for, so that some may be left out later. FROE_E_MEMORY. */
froe_status shards_gather_finds(shards_gather *gather, size_t questions, froe_finds *out);

/** Puts answers into the order of their tags. */
void shards_sort_by_tag(froe_find *items, size_t count);
/** Puts answers of equal values, of several shards, into their exact order, and keeps at most k of each question.
 * `status`: of what was done so far; processes that ask together call it also with a failure. */
froe_status shards_decide(froe_shards *s, const shards_question *q, froe_finds *finds, size_t k, froe_status status,
                          froe_diagnostic *diag);
/** How many answers of question i, from `first` on, have the value of the first. */
size_t shards_equal_values(const froe_finds *finds, size_t i, size_t first);
/** Appends an object of a scene as a record. */
froe_status shards_put_object(froe_shard_records *records, const froe_scene *scene, uint32_t object,
                              froe_diagnostic *diag);
/** Are they of several shards, so that they have no order yet? */
bool shards_of_several(const froe_find *items, size_t count);
#endif
