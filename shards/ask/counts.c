/* counts.c: the public questions of how many objects there are. Shards tell numbers, and of several processes numbers
 * alone go from one to another. */
#include "shards/ask/kinds.h"
#include "support/floats.h"

/* All that questions reach. */
static froe_status count_all(froe_shards *s, shards_question *q, const froe_batch_options *options, uint64_t *counts,
                             froe_diagnostic *diag) {
    q->counted = true;
    if (q->count) memset(counts, 0, q->count * sizeof *counts);
    return shards_reach(s, q, options, shards_add_count, counts, diag);
}

froe_status froe_shards_count(froe_shards *s, const froe_range *ranges, size_t count, const froe_batch_options *options,
                              uint64_t *counts, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (shards_refuse_nulls(s, ranges, count, counts, __func__, diag)) return FROE_E_ARG;
    shards_question q = shards_kind_ranges(s, ranges, count);
    return count_all(s, &q, options, counts, diag);
}

froe_status froe_shards_locate_count(froe_shards *s, const double *points, size_t count,
                                     const froe_batch_options *options, uint64_t *counts, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (shards_refuse_nulls(s, points, count, counts, __func__, diag)) return FROE_E_ARG;
    shards_question q = shards_kind_points(s, points, count, froe_batch_locate);
    return count_all(s, &q, options, counts, diag);
}

froe_status froe_shards_vertical_count(froe_shards *s, const double *points, size_t count, int direction,
                                       const froe_batch_options *options, uint64_t *counts, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (shards_refuse_nulls(s, points, count, counts, __func__, diag)) return FROE_E_ARG;
    shards_question q = shards_kind_vertical(s, points, count, direction);
    const froe_status status = count_all(s, &q, options, counts, diag);
    for (size_t i = 0; i < count && !status; i++) counts[i] = counts[i] > 0; /* each shard has told its first one */
    return status;
}

froe_status froe_shards_ray_count(froe_shards *s, const double *origins, const double *directions, size_t count,
                                  double t_max, const froe_batch_options *options, uint64_t *counts,
                                  froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (shards_refuse_nulls(s, directions ? origins : NULL, count, counts, __func__, diag)) return FROE_E_ARG;
    shards_question q = shards_kind_rays(s, origins, directions, count, 0, t_max);
    return count_all(s, &q, options, counts, diag);
}

/* The k nearest within the bound are among the k nearest of their shards. So there are k as soon as shards have told so
 * many, and otherwise those that all shards within the bound have told. */
froe_status froe_shards_near_count(froe_shards *s, const double *points, size_t count, size_t k, double bound,
                                   const froe_batch_options *options, uint64_t *counts, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (shards_refuse_nulls(s, points, count, counts, __func__, diag)) return FROE_E_ARG;
    shards_question q = shards_kind_near(s, points, count, k, bound);
    q.counted = true;
    const froe_status status =
        k ? shards_rounds_count(s, &q, options, counts, diag) : count_all(s, &q, options, counts, diag);
    for (size_t i = 0; i < count && !status; i++) counts[i] = counts[i] < k ? counts[i] : k;
    return status;
}
