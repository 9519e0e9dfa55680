/* questions.c: the public questions about objects. */
#include "shards/ask/bounds.h"
#include "shards/ask/kinds.h"
#include "support/floats.h"

/* Puts the first of each question's answers, or none, where the caller has room for it. */
static void take_firsts(froe_finds *f, froe_find *finds) {
    for (size_t i = 0; i < f->questions; i++)
        finds[i] = f->starts[i] < f->starts[i + 1] ? f->items[f->starts[i]]
                                                   : (froe_find){.shard = FROE_NONE, .object = FROE_NONE};
    froe_finds_free(f);
}

/* Answers by bounds; k of each at most, or with k 0 all. */
static froe_status find_ordered(froe_shards *s, const shards_question *q, const froe_batch_options *options,
                                froe_finds *out, froe_diagnostic *diag) {
    froe_finds f = {0};
    froe_status status = q->k ? shards_rounds(s, q, options, &f, diag) : shards_find_all(s, q, options, &f, diag);
    if (!q->any) status = shards_decide(s, q, &f, q->k ? q->k : SIZE_MAX, status, diag);
    if (status)
        froe_finds_free(&f);
    else
        *out = f;
    return status;
}

/* The first answer of each by bounds, or any. */
static froe_status find_first(froe_shards *s, shards_question *q, bool any, const froe_batch_options *options,
                              froe_find *finds, froe_diagnostic *diag) {
    froe_finds f;
    q->any = any;
    const froe_status status = find_ordered(s, q, options, &f, diag);
    if (!status) take_firsts(&f, finds);
    return status;
}

/* ------------------------------------------------------------ ranges, points -- */

froe_status froe_shards_range(froe_shards *s, const froe_range *ranges, size_t count, const froe_batch_options *options,
                              froe_finds *out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (shards_refuse_null(s, ranges, count, out, __func__, diag)) return FROE_E_ARG;
    const shards_question q = shards_kind_ranges(s, ranges, count);
    return shards_find_all(s, &q, options, out, diag);
}

froe_status froe_shards_boxes(froe_shards *s, const double *boxes, size_t count, const froe_batch_options *options,
                              froe_finds *out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (shards_refuse_null(s, boxes, count, out, __func__, diag)) return FROE_E_ARG;
    const shards_question q = shards_kind_boxes(s, boxes, count);
    return shards_find_all(s, &q, options, out, diag);
}

froe_status froe_shards_any(froe_shards *s, const froe_range *ranges, size_t count, const froe_batch_options *options,
                            froe_find *finds, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (shards_refuse_nulls(s, ranges, count, finds, __func__, diag)) return FROE_E_ARG;
    shards_question q = shards_kind_ranges(s, ranges, count);
    q.box = NULL; /* the first shard that has an answer is enough */
    q.bound = shards_bound_of_any;
    q.k = 1;
    return find_first(s, &q, true, options, finds, diag);
}

froe_status froe_shards_locate(froe_shards *s, const double *points, size_t count, const froe_batch_options *options,
                               froe_finds *out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (shards_refuse_null(s, points, count, out, __func__, diag)) return FROE_E_ARG;
    const shards_question q = shards_kind_points(s, points, count, froe_batch_locate);
    return shards_find_all(s, &q, options, out, diag);
}

froe_status froe_shards_vertical(froe_shards *s, const double *points, size_t count, int direction,
                                 const froe_batch_options *options, froe_find *finds, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (shards_refuse_nulls(s, points, count, finds, __func__, diag)) return FROE_E_ARG;
    const shards_question q = shards_kind_vertical(s, points, count, direction);
    froe_finds f = {0};
    froe_status status = shards_find_all(s, &q, options, &f, diag);
    status = shards_decide(s, &q, &f, 1, status, diag); /* of all shards: they have no values to compare */
    if (status)
        froe_finds_free(&f);
    else
        take_firsts(&f, finds);
    return status;
}

/* -------------------------------------------------------- rays, neighbours -- */

froe_status froe_shards_ray(froe_shards *s, const double *origins, const double *directions, size_t count, double t_max,
                            const froe_batch_options *options, froe_find *finds, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (shards_refuse_nulls(s, directions ? origins : NULL, count, finds, __func__, diag)) return FROE_E_ARG;
    shards_question q = shards_kind_rays(s, origins, directions, count, 1, t_max);
    return find_first(s, &q, false, options, finds, diag);
}

froe_status froe_shards_ray_any(froe_shards *s, const double *origins, const double *directions, size_t count,
                                double t_max, const froe_batch_options *options, froe_find *finds,
                                froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (shards_refuse_nulls(s, directions ? origins : NULL, count, finds, __func__, diag)) return FROE_E_ARG;
    shards_question q = shards_kind_rays(s, origins, directions, count, 1, t_max);
    return find_first(s, &q, true, options, finds, diag);
}

froe_status froe_shards_ray_all(froe_shards *s, const double *origins, const double *directions, size_t count,
                                double t_max, const froe_batch_options *options, froe_finds *out,
                                froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (shards_refuse_null(s, directions ? origins : NULL, count, out, __func__, diag)) return FROE_E_ARG;
    const shards_question q = shards_kind_rays(s, origins, directions, count, 0, t_max);
    return find_ordered(s, &q, options, out, diag);
}

froe_status froe_shards_near(froe_shards *s, const double *points, size_t count, size_t k, double bound,
                             const froe_batch_options *options, froe_finds *out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (shards_refuse_null(s, points, count, out, __func__, diag)) return FROE_E_ARG;
    const shards_question q = shards_kind_near(s, points, count, k, bound);
    return find_ordered(s, &q, options, out, diag);
}
