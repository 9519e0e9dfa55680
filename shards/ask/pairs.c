/* pairs.c: pairs of objects that meet, shard by shard. */
#include "shards/ask/share.h"
#include "support/fail.h"
#include "support/floats.h"

/* Pairs of one shard on their way to the caller. */
typedef struct shard_pairs {
    const froe_shards *shards;
    uint32_t shard;
    bool stopped;
    froe_found_pair_fn *fn;
    void *user;
} shard_pairs;

static froe_find find_in(const froe_scene *scene, uint32_t shard, uint32_t object) {
    return (froe_find){.tag = froe_scene_object(scene, object).tag, .shard = shard, .object = object};
}

/* A pair is told by the first cell that what the boxes of both have in common meets. */
static bool tell_pair(void *user, const froe_pair *pair) {
    SUPPORT_FLOATS_OWN;
    shard_pairs *p = user;
    const froe_scene *scene = froe_tree_scene(p->shards->slots[p->shard].tree);
    double lo[FROE_MAX_DIM], other[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    shards_scene_box(scene, pair->a, lo, hi);
    shards_scene_box(scene, pair->b, other, hi);
    for (int a = 0; a < p->shards->dim; a++) lo[a] = other[a] > lo[a] ? other[a] : lo[a];
    if (shards_plan_first(p->shards->manifest.plan, lo) != p->shard) return true;
    const froe_found_pair found = {
        .a = find_in(scene, p->shard, pair->a), .b = find_in(scene, p->shard, pair->b), .kind = pair->kind};
    p->stopped = !support_callback(p->fn(p->user, &found));
    return !p->stopped;
}

froe_status froe_shards_pairs(froe_shards *s, bool shared, const froe_batch_options *options, froe_found_pair_fn *fn,
                              void *user, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!s || !fn) return support_fail_null(diag, __func__);
    const shards_question none = {0};
    shards_call call;
    shard_pairs p = {.shards = s, .fn = fn, .user = user};
    froe_status status = shards_call_begin(s, &none, options, &call, diag);
    for (uint32_t i = 0; i < s->count && !status && !p.stopped; i++) {
        froe_query *query;
        p.shard = i;
        if (!shards_entry(s, i)->objects || !shards_share_owns(s, i)) continue;
        status = shards_query(s, i, &query, diag);
        if (status) break;
        status = froe_batch_pairs(query, shared, &call.options, tell_pair, &p, diag);
        if (status) return shards_name_file(s, i, status, diag);
        status = shards_call_progress(&call, (double)(i + 1) / s->count, diag);
    }
    return status;
}
