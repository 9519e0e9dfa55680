/* serve.c: a shard is asked once for all processes together: the places of its tree that questions look at stay in the
 * cache, and threads have more to divide.
 *
 *     process 0     0 1 2              lists for shard t, by process
 *     process 1           0 1
 *     process 2               0 1 2
 *     batch         0 1 2 3 4 5 6 7    asked of shard t; what is found goes back to its list, or is taken here
 *
 * A bad question takes its list out of the batch, and the others are asked again. */
#include "shards/ask/serve.h"
#include "shards/ask/letters.h"
#include "support/fail.h"

typedef ARRAY(shards_list) list_array;

/* The questions of a shard, of those lists that have no bad one. */
typedef struct batch {
    shards_call *call; /* of this process itself */
    list_array *lists;
    uint32_t shard;
    shards_question q; /* all of them, one after the other */
    double *points, *directions;
    froe_range *ranges;
    bool *alone;
    size_t *which;
    size_t at, before; /* the list whose answers come now, and how many questions are in front of it */
} batch;

static bool is_in(const batch *b, const shards_list *l) {
    return l->shard == b->shard && l->limit == l->count;
}

/* The list that question i of the batch, or a later one, is in. *before: how many questions are in front of it. */
static shards_list *list_of(const batch *b, size_t i, size_t *at, size_t *before) {
    shards_list *l = b->lists->data + *at;
    while (!is_in(b, l) || i - *before >= l->count) {
        if (is_in(b, l)) *before += l->count;
        l = b->lists->data + ++*at;
    }
    return l;
}

/* ---------------------------------------------------------------- questions -- */

static void free_batch(batch *b) {
    const froe_allocator *alloc = &b->call->s->alloc;
    const size_t count = b->q.count;
    if (b->points) support_free(alloc, b->points, count * b->q.width * sizeof *b->points);
    if (b->directions) support_free(alloc, b->directions, count * (size_t)b->q.dim * sizeof *b->directions);
    if (b->ranges) support_free(alloc, b->ranges, count * sizeof *b->ranges);
    if (b->alone) support_free(alloc, b->alone, count * sizeof *b->alone);
    if (b->which) support_free(alloc, b->which, count * sizeof *b->which);
    b->points = b->directions = NULL, b->ranges = NULL, b->alone = NULL, b->which = NULL;
}

/* Lays the questions of a list from number `first` on. */
static void lay_list(batch *b, const shards_list *l, size_t first) {
    const shards_question *q = b->call->q;
    const size_t dim = (size_t)q->dim;
    const double *points = l->which ? q->points : l->points, *directions = l->which ? q->directions : l->directions;
    const froe_range *ranges = l->which ? q->ranges : l->ranges;
    for (size_t j = 0; j < l->count; j++) {
        const size_t from = l->which ? l->which[j] : j, to = first + j;
        if (b->points) memcpy(b->points + to * q->width, points + from * q->width, q->width * sizeof *points);
        if (b->directions) memcpy(b->directions + to * dim, directions + from * dim, dim * sizeof *directions);
        if (b->ranges) b->ranges[to] = ranges[from];
        b->alone[to] = l->alone[j];
        b->which[to] = to;
    }
}

/* False: no memory. */
static bool lay_batch(batch *b) {
    const shards_question *q = b->call->q;
    const froe_allocator *alloc = &b->call->s->alloc;
    size_t count = 0;
    for (size_t i = 0; i < b->lists->count; i++)
        if (is_in(b, b->lists->data + i)) count += b->lists->data[i].count;
    b->q = *q;
    b->q.count = count;
    if (!count) return true;
    if (q->ranges)
        b->q.ranges = b->ranges = support_calloc(alloc, count, sizeof *b->ranges);
    else
        b->q.points = b->points = support_calloc(alloc, count, q->width * sizeof *b->points);
    if (q->directions)
        b->q.directions = b->directions = support_calloc(alloc, count, (size_t)q->dim * sizeof *b->directions);
    b->alone = support_calloc(alloc, count, sizeof *b->alone);
    b->which = support_calloc(alloc, count, sizeof *b->which);
    if (!(b->ranges || b->points) || (q->directions && !b->directions) || !b->alone || !b->which) return false;
    for (size_t i = 0, first = 0; i < b->lists->count; i++) {
        if (!is_in(b, b->lists->data + i)) continue;
        lay_list(b, b->lists->data + i, first);
        first += b->lists->data[i].count;
    }
    return true;
}

/* ------------------------------------------------------------------ answers -- */

/* A shards_take_fn of the batch, whose questions come in their order. */
static bool take_found(void *user, size_t i, const froe_find *find) {
    batch *b = user;
    const shards_call *call = b->call;
    const froe_allocator *alloc = &call->s->alloc;
    shards_list *l = list_of(b, i, &b->at, &b->before);
    const size_t j = i - b->before;
    if (l->which) return call->take(call->take_user, l->which[j], find);
    l->counts[j] += call->q->counted ? (uint32_t)find->tag : 1;
    return call->q->counted ||
           (array_push(alloc, &l->tags, find->tag) && array_push(alloc, &l->objects, find->object) &&
            (!call->q->bound || array_push(alloc, &l->values, find->value)));
}

/* Question i of the batch is bad: its list is answered no further. */
static void refuse(const batch *b, size_t i, const froe_diagnostic *bad) {
    size_t at = 0, before = 0;
    shards_list *l = list_of(b, i, &at, &before);
    l->limit = i - before;
    l->bad = *bad;
    if (!l->which || l->which[l->limit] >= b->call->limit) return;
    b->call->limit = l->which[l->limit];
    b->call->bad = *bad;
    b->call->bad.object = (uint32_t)b->call->limit;
}

/* Asks a shard what all lists have for it. */
static froe_status ask_shard(shards_call *call, uint32_t shard, list_array *lists, froe_diagnostic *diag) {
    froe_status status = FROE_OK;
    for (bool again = true; again && !status;) {
        batch b = {.call = call, .lists = lists, .shard = shard};
        status = lay_batch(&b) ? FROE_OK : support_fail_memory(diag);
        shards_call joint = *call;
        joint.q = &b.q, joint.limit = b.q.count, joint.take = take_found, joint.take_user = &b;
        if (!status) status = shards_call_shard(&joint, shard, b.which, b.alone, b.q.count, diag);
        again = joint.limit < b.q.count;
        if (again && !status) refuse(&b, joint.limit, &joint.bad);
        free_batch(&b);
    }
    return status;
}

/* -------------------------------------------------------------------- lists -- */

/* The lists of all processes for shards of this one, by process. *more: has any process questions? */
static froe_status take_lists(shards_call *call, list_array *lists, bool *more, froe_diagnostic *diag) {
    const froe_allocator *alloc = &call->s->alloc;
    const shards_share *share = call->s->share;
    shards_letter c = {share->in.bytes, 0};
    *more = false;
    for (uint32_t r = 0; r < share->count; r++) {
        uint64_t active;
        c.left = share->in_counts[r];
        if (!shards_letter_words(&c, &active, 1)) return shards_letter_cut(diag);
        *more = *more || active;
        while (c.left) {
            shards_list list;
            froe_status status = shards_take_questions(&c, call, &list, diag);
            list.process = r;
            if (!status) list.counts = support_calloc(alloc, list.count, sizeof *list.counts);
            if (!status && (!list.counts || !array_push(alloc, lists, list))) status = support_fail_memory(diag);
            if (status) shards_list_free(alloc, &list);
            if (status) return status;
        }
    }
    return FROE_OK;
}

/* The lists of this process itself. */
static froe_status add_own(shards_call *call, const size_t *starts, const size_t *which, const bool *alone,
                           list_array *lists, froe_diagnostic *diag) {
    const shards_share *share = call->s->share;
    for (uint32_t turn = 0, t; (t = froe_shard_of_turn(share->rank, share->count, turn)) < call->s->count; turn++) {
        const size_t first = starts[t], count = starts[t + 1] - first;
        const shards_list own = {.process = share->rank,
                                 .shard = t,
                                 .count = count,
                                 .limit = count,
                                 .alone = alone + first,
                                 .which = which + first};
        if (count && !array_push(&call->s->alloc, lists, own)) return support_fail_memory(diag);
    }
    return FROE_OK;
}

froe_status shards_serve(shards_call *call, const size_t *starts, const size_t *which, const bool *alone, bool *more,
                         froe_diagnostic *diag) {
    shards_share *share = call->s->share;
    list_array lists = {0};
    froe_status status = take_lists(call, &lists, more, diag);
    if (!status) status = add_own(call, starts, which, alone, &lists, diag);
    for (uint32_t turn = 0, t; !status && (t = froe_shard_of_turn(share->rank, share->count, turn)) < call->s->count;
         turn++)
        status = ask_shard(call, t, &lists, diag);
    for (size_t i = 0; i < lists.count; i++) {
        shards_list *l = lists.data + i;
        if (!status && !l->which && !shards_put_answers(share, &share->out_counts[l->process], l))
            status = support_fail_memory(diag);
        shards_list_free(&call->s->alloc, l);
    }
    array_free(&call->s->alloc, &lists);
    return status;
}
