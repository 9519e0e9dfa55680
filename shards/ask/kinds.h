/* kinds.h: the kinds of questions: by which call of froe/query.h one tree answers a batch of each, and the box or bound
 * by which shards are asked. Arrays stay the caller's. */
#ifndef FROE_SHARDS_KINDS_H
#define FROE_SHARDS_KINDS_H
#include "shards/ask/ask.h"
#include "support/fail.h"

shards_question shards_kind_ranges(const froe_shards *s, const froe_range *ranges, size_t count);
/** The groups that are related to ranges. */
shards_question shards_kind_related(const froe_shards *s, const froe_range *ranges, size_t count,
                                    froe_relation relation);
shards_question shards_kind_boxes(const froe_shards *s, const double *boxes, size_t count);
/** Points that `batch` answers. */
shards_question shards_kind_points(const froe_shards *s, const double *points, size_t count, shards_rows_fn *batch);
/** What is above (way 1) or below (-1). */
shards_question shards_kind_vertical(const froe_shards *s, const double *points, size_t count, int way);
/** The groups that are related to those of another tree, which lie within `bounds`. */
shards_question shards_kind_join(const froe_shards *s, const froe_query *asking, const double *bounds, size_t count,
                                 froe_relation relation);
/** The k nearest among those within `most`. */
shards_question shards_kind_near(const froe_shards *s, const double *points, size_t count, size_t k, double most);
/** Rays that end at `most`: with k 1 what each meets first, with 0 all. */
shards_question shards_kind_rays(const froe_shards *s, const double *origins, const double *directions, size_t count,
                                 size_t k, double most);

/** FROE_E_ARG, with the name of the public function, if something is missing; `input` may be, of no questions. */
static inline froe_status shards_refuse_null(const void *shards, const void *input, size_t count, const void *out,
                                             const char *function, froe_diagnostic *diag) {
    return shards && (input || !count) && out ? FROE_OK : support_fail_null(diag, function);
}
/** The same, where the answers are an array of the caller's, of one for each question. */
static inline froe_status shards_refuse_nulls(const void *shards, const void *input, size_t count, const void *answers,
                                              const char *function, froe_diagnostic *diag) {
    return shards_refuse_null(shards, input, count, count ? answers : shards, function, diag);
}
#endif
