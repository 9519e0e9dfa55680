/* groups.c: the public questions about groups, which are areas. A group is whole in every shard that has a part of it,
 * so that each knows all about it, and is told once. */
#include "shards/ask/kinds.h"
#include "shards/ask/share.h"
#include "support/floats.h"

static froe_status find_groups(froe_shards *s, shards_question *q, const froe_batch_options *options, froe_finds *out,
                               froe_diagnostic *diag) {
    froe_finds f;
    if (s->dim != 2) return support_fail(diag, FROE_E_UNSUPPORTED, "Groups are areas in the plane only.");
    q->groups = true;
    froe_status status = shards_find_all(s, q, options, &f, diag);
    if (status) return status;
    size_t kept = 0;
    for (size_t i = 0, first = 0, end; i < f.questions; i++, first = end) {
        end = f.starts[i + 1];
        for (size_t j = first; j < end; j++)
            if (j == first || f.items[j].tag != f.items[j - 1].tag) f.items[kept++] = f.items[j];
        f.starts[i + 1] = kept;
    }
    *out = f;
    return FROE_OK;
}

froe_status froe_shards_groups(froe_shards *s, const double *points, size_t count, const froe_batch_options *options,
                               froe_finds *out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (shards_refuse_null(s, points, count, out, __func__, diag)) return FROE_E_ARG;
    shards_question q = shards_kind_points(s, points, count, froe_batch_groups);
    return find_groups(s, &q, options, out, diag);
}

froe_status froe_shards_groups_range(froe_shards *s, const froe_range *ranges, size_t count, froe_relation relation,
                                     const froe_batch_options *options, froe_finds *out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (shards_refuse_null(s, ranges, count, out, __func__, diag)) return FROE_E_ARG;
    shards_question q = shards_kind_related(s, ranges, count, relation);
    return find_groups(s, &q, options, out, diag);
}

froe_status froe_shards_groups_join(froe_shards *s, const froe_tree *questions, froe_relation relation,
                                    const froe_batch_options *options, froe_finds *out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (shards_refuse_null(s, questions, 1, out, __func__, diag)) return FROE_E_ARG;
    const froe_scene *scene = froe_tree_scene(questions);
    double bounds[2 * FROE_MAX_DIM] = {0};
    froe_query *asking;
    if (froe_scene_dim(scene) != 2)
        return support_fail(diag, FROE_E_UNSUPPORTED, "Groups are areas in the plane only.");
    if (s->share) return support_fail(diag, FROE_E_UNSUPPORTED, "A tree of questions is not sent to other processes.");
    (void)froe_scene_bounds(scene, bounds, bounds + 2); /* of no objects: any place does */
    froe_status status = froe_query_new(questions, &asking, diag);
    if (status) return status;
    shards_question q = shards_kind_join(s, asking, bounds, froe_scene_group_count(scene), relation);
    status = find_groups(s, &q, options, out, diag);
    froe_query_free(asking);
    return status;
}
