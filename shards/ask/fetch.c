/* fetch.c: objects of other processes' shards, whose order is to be decided here; see share.h.
 *
 *     words that ask        shard and object of each
 *     words that answer     a record of each, in the same order */
#include "shards/ask/share.h"
#include "support/fail.h"
#include <stdlib.h>

typedef struct wanted {
    uint32_t shard, object;
} wanted;
typedef ARRAY(wanted) wanted_array;

static int by_shard_and_object(const void *a, const void *b) {
    const shards_fetched *x = a, *y = b;
    if (x->shard != y->shard) return x->shard < y->shard ? -1 : 1;
    return (x->object > y->object) - (x->object < y->object);
}

/* The objects of other processes that are compared, in the order of the answers. False: no memory. */
static bool list_wanted(const froe_shards *s, const froe_finds *f, size_t k, wanted_array *out) {
    for (size_t i = 0; i < f->questions; i++)
        for (size_t first = f->starts[i], run, kept = 0; first < f->starts[i + 1] && kept < k; first += run) {
            run = shards_equal_values(f, i, first);
            kept += run;
            for (size_t j = first; j < first + run && shards_of_several(f->items + first, run); j++)
                if (!shards_share_owns(s, f->items[j].shard) &&
                    !array_push(&s->alloc, out, (wanted){f->items[j].shard, f->items[j].object}))
                    return false;
        }
    return true;
}

static froe_status put_wanted(shards_share *share, const wanted_array *list, froe_diagnostic *diag) {
    for (uint32_t r = 0; r < share->count; r++)
        for (size_t i = 0; i < list->count; i++)
            if (froe_shard_owner(list->data[i].shard, share->count) == r &&
                !shards_share_put(share, &share->out_counts[r], &list->data[i], sizeof list->data[i]))
                return support_fail_memory(diag);
    return FROE_OK;
}

/* Records of the objects that others have asked for. */
static froe_status put_records(froe_shards *s, froe_diagnostic *diag) {
    shards_share *share = s->share;
    const wanted *list = (const wanted *)(const void *)share->in.bytes;
    froe_status status = FROE_OK;
    for (uint32_t r = 0; r < share->count && !status; r++) {
        const size_t before = share->out.count, count = share->in_counts[r] / sizeof *list;
        for (size_t i = 0; i < count && !status; i++, list++) {
            const froe_tree *tree = NULL;
            const bool own = list->shard < s->count && shards_share_owns(s, list->shard);
            status = own ? froe_shards_tree(s, list->shard, &tree, diag) : FROE_E_FORMAT;
            if (!status && (!tree || list->object >= froe_scene_object_count(froe_tree_scene(tree))))
                status = FROE_E_FORMAT;
            if (status == FROE_E_FORMAT)
                status = support_fail(diag, status, "Another process asks for an object that is not there.");
            if (!status) status = shards_put_object(&share->out, froe_tree_scene(tree), list->object, diag);
        }
        share->out_counts[r] = share->out.count - before;
    }
    return status;
}

/* What came, to be found by shard and object. */
static froe_status note_records(froe_shards *s, const wanted_array *list, froe_diagnostic *diag) {
    shards_share *share = s->share;
    size_t at = 0;
    if (!array_reserve(&s->alloc, &share->fetched, list->count)) return support_fail_memory(diag);
    for (uint32_t r = 0; r < share->count; r++)
        for (size_t i = 0; i < list->count; i++) {
            if (froe_shard_owner(list->data[i].shard, share->count) != r) continue;
            const size_t size = froe_shard_record_size(share->in.bytes + at, share->in.count - at);
            const shards_record *record = shards_record_at(share->in.bytes, at);
            if (!size || record->dim != s->dim)
                return support_fail(diag, FROE_E_FORMAT, "Objects of another process have been cut off on their way.");
            share->fetched.data[share->fetched.count++] =
                (shards_fetched){list->data[i].shard, list->data[i].object, record};
            at += size;
        }
    if (list->count) qsort(share->fetched.data, share->fetched.count, sizeof *share->fetched.data, by_shard_and_object);
    return FROE_OK;
}

froe_status shards_share_fetch(froe_shards *s, const froe_finds *finds, size_t k, froe_status status,
                               froe_diagnostic *diag) {
    shards_share *share = s->share;
    const bool asks = !share->refused;
    wanted_array list = {0};
    froe_diagnostic bad = {0};
    if (!asks && diag) bad = *diag;
    const froe_status mine = status;
    if (!asks) status = FROE_OK;
    share->fetched.count = 0;
    if (!status && asks && !list_wanted(s, finds, k, &list)) status = support_fail_memory(diag);
    if (!status) status = put_wanted(share, &list, diag);
    status = shards_share_trade(share, status, diag);
    if (!status) status = shards_share_trade(share, put_records(s, diag), diag);
    if (!status) status = note_records(s, &list, diag);
    array_free(&s->alloc, &list);
    if (asks || status) return status;
    if (diag) *diag = bad;
    return mine;
}

const shards_record *shards_share_fetched(const froe_shards *s, const froe_find *find) {
    if (shards_share_owns(s, find->shard)) return NULL;
    const shards_fetched key = {find->shard, find->object, NULL};
    const shards_fetched *found =
        bsearch(&key, s->share->fetched.data, s->share->fetched.count, sizeof key, by_shard_and_object);
    return found ? found->record : NULL;
}
