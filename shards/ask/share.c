/* share.c: questions go to the owners of shards, and what was found comes back; see share.h.
 *
 *     words of questions     1: the sender has questions, for whichever process
 *                            of each shard: its number and how many follow
 *                                a byte each: is it put to this shard alone?
 *                                rows of doubles; directions; or of each range its parts
 *     words of answers       of each shard, in the same order: how many; the number of the first bad question, or that
 *                            of all, and its diagnostic if there is one
 *                                of each question: how many, 4 bytes
 *                                of each answer its tag; then of each its object, 4 bytes; then, where answers have
 *                                values, of each its value; where they are only counted, none of these */
#include "shards/ask/share.h"
#include "support/fail.h"
#include "support/floats.h"

enum { WORD = 8, WORDS_OF_DIAGNOSTIC = (sizeof(froe_diagnostic) + WORD - 1) / WORD };

/* ------------------------------------------------------------------ sharing -- */

uint32_t froe_shard_owner(uint32_t shard, uint32_t count) {
    return count ? (uint32_t)(((uint64_t)shard % count + shard / count) % count) : 0;
}

uint32_t froe_shard_of_turn(uint32_t process, uint32_t count, uint32_t turn) {
    if (process >= count) return FROE_NONE;
    const uint64_t place = ((uint64_t)process + count - turn % count) % count, shard = (uint64_t)turn * count + place;
    return shard < FROE_NONE ? (uint32_t)shard : FROE_NONE;
}

/* The next shard of a process, if there is one. */
static bool next_shard_of(const froe_shards *s, uint32_t process, uint32_t *turn, uint32_t *shard) {
    *shard = froe_shard_of_turn(process, s->share->count, (*turn)++);
    return *shard < s->count;
}

froe_status froe_shards_share(froe_shards *s, uint32_t rank, uint32_t count, froe_shards_trade_fn *trade, void *user,
                              froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!s || !trade) return support_fail_null(diag, __func__);
    if (rank >= count) return support_fail(diag, FROE_E_ARG, "There is no process %u of %u.", rank, count);
    shards_share_free(s);
    if (count == 1) return FROE_OK;
    shards_share *share = support_calloc(&s->alloc, 1, sizeof *share);
    if (!share) return support_fail_memory(diag);
    *share = (shards_share){.rank = rank, .count = count, .trade = trade, .user = user};
    share->out.alloc = share->in.alloc = s->alloc;
    share->out_counts = support_calloc(&s->alloc, count, 2 * sizeof *share->out_counts);
    s->share = share;
    if (share->out_counts) {
        share->in_counts = share->out_counts + count;
        return FROE_OK;
    }
    shards_share_free(s);
    return support_fail_memory(diag);
}

void shards_share_free(froe_shards *s) {
    shards_share *share = s->share;
    if (!share) return;
    froe_shard_records_free(&share->out);
    froe_shard_records_free(&share->in);
    array_free(&s->alloc, &share->fetched);
    if (share->out_counts) support_free(&s->alloc, share->out_counts, 2 * share->count * sizeof *share->out_counts);
    support_free(&s->alloc, share, sizeof *share);
    s->share = NULL;
}

void shards_share_begin(froe_shards *s) {
    if (s->share) s->share->refused = false;
}

void shards_share_refuse(froe_shards *s) {
    if (s->share) s->share->refused = true;
}

bool shards_share_put(shards_share *share, size_t *count, const void *words, size_t size) {
    const size_t room = (size + WORD - 1) / WORD * WORD;
    if (!shards_records_reserve(&share->out, room)) return false;
    unsigned char *to = share->out.bytes + share->out.count;
    memset(to + room - (room ? WORD : 0), 0, room ? WORD : 0);
    if (size) memcpy(to, words, size);
    share->out.count += room;
    *count += room;
    return true;
}

/* The transport may have made memory known to its devices, so that what it has seen must not grow: buffers are made
 * anew for each exchange. */
froe_status shards_share_trade(shards_share *share, froe_status status, froe_diagnostic *diag) {
    froe_diagnostic why = {0};
    if (status && diag) why = *diag;
    why.status = status;
    froe_shard_records_free(&share->in);
    const froe_status agreed = support_callback(
        share->trade(share->user, status, &share->out, share->out_counts, &share->in, share->in_counts, &why));
    froe_shard_records_free(&share->out);
    memset(share->out_counts, 0, share->count * sizeof *share->out_counts);
    if (agreed && diag) *diag = why;
    return agreed;
}

/* ------------------------------------------------------------------ reading -- */

/* What is left of the words of a process. */
typedef struct letter {
    const unsigned char *at;
    size_t left;
} letter;

/* The next bytes, whole words of them. NULL: they are not there. */
static const void *take(letter *c, size_t size) {
    const size_t room = (size + WORD - 1) / WORD * WORD;
    const void *found = c->at;
    if (size > SIZE_MAX - WORD || room > c->left) return NULL;
    c->at += room;
    c->left -= room;
    return found;
}

static bool take_words(letter *c, uint64_t *words, size_t count) {
    const void *found = take(c, count * WORD);
    if (found) memcpy(words, found, count * WORD);
    return found;
}

static froe_status fail_cut(froe_diagnostic *diag) {
    return support_fail(diag, FROE_E_FORMAT, "Words of another process have been cut off on their way.");
}

/* ---------------------------------------------------------------- questions -- */

enum { RANGE_WORDS = 4 };

/* How many doubles the points of a range are. */
static size_t points_of_range(const froe_range *r, size_t dim) {
    const size_t rows[FROE_SHAPE_COUNT] = {[FROE_SHAPE_BOX] = 2,
                                           [FROE_SHAPE_BALL] = 1,
                                           [FROE_SHAPE_SIMPLEX] = dim + 1,
                                           [FROE_SHAPE_CAPSULE] = 2,
                                           [FROE_SHAPE_HALFSPACES] = r->count,
                                           [FROE_SHAPE_HULL] = r->count,
                                           [FROE_SHAPE_SEGMENT] = 2,
                                           [FROE_SHAPE_RAY] = 2};
    return r->points && (unsigned)r->shape < FROE_SHAPE_COUNT ? dim * rows[r->shape] : 0;
}

/* How many doubles the offsets of a range are. */
static size_t offsets_of_range(const froe_range *r) {
    return r->points && r->shape == FROE_SHAPE_HALFSPACES && r->offsets ? r->count : 0;
}

static bool put_range(shards_share *share, size_t *count, const froe_range *r, size_t dim) {
    const size_t points = points_of_range(r, dim), offsets = offsets_of_range(r);
    uint64_t words[RANGE_WORDS] = {points, offsets, r->points != NULL, r->offsets != NULL};
    return shards_share_put(share, count, words, sizeof words) && shards_share_put(share, count, r, sizeof *r) &&
           shards_share_put(share, count, r->points, points * sizeof(double)) &&
           shards_share_put(share, count, r->offsets, offsets * sizeof(double));
}

/* A range as it was sent; its arrays lie in the words, as many as it says that it has. */
static bool take_range(letter *c, froe_range *r, size_t dim) {
    uint64_t words[RANGE_WORDS];
    const void *range = take_words(c, words, RANGE_WORDS) ? take(c, sizeof *r) : NULL;
    if (!range || words[0] > c->left / WORD || words[1] > c->left / WORD) return false;
    memcpy(r, range, sizeof *r);
    const double *points = take(c, words[0] * sizeof *points), *offsets = take(c, words[1] * sizeof *offsets);
    r->points = words[2] ? points : NULL;
    r->offsets = words[3] ? offsets : NULL;
    return points && offsets && r->count <= SIZE_MAX / dim && points_of_range(r, dim) == words[0] &&
           offsets_of_range(r) == words[1];
}

/* The questions that are listed for a shard. */
static bool put_questions(shards_share *share, size_t *count, const shards_question *q, uint32_t shard,
                          const size_t *which, const bool *alone, size_t questions) {
    const uint64_t head[2] = {shard, questions};
    const size_t dim = (size_t)q->dim;
    bool ok = shards_share_put(share, count, head, sizeof head) &&
              shards_share_put(share, count, alone, questions * sizeof *alone);
    for (size_t j = 0; j < questions && ok && !q->ranges; j++)
        ok = shards_share_put(share, count, q->points + which[j] * q->width, q->width * sizeof(double));
    for (size_t j = 0; j < questions && ok && q->directions; j++)
        ok = shards_share_put(share, count, q->directions + which[j] * dim, dim * sizeof(double));
    for (size_t j = 0; j < questions && ok && q->ranges; j++) ok = put_range(share, count, q->ranges + which[j], dim);
    return ok;
}

/* Questions of another process, as they are asked here. */
typedef struct block {
    uint64_t head[2]; /* shard, how many */
    const bool *alone;
    shards_question q;
    froe_range *ranges;
} block;

/* FROE_E_FORMAT, FROE_E_MEMORY. */
static froe_status take_questions(letter *c, const shards_call *call, block *b, froe_diagnostic *diag) {
    *b = (block){.q = *call->q};
    if (!take_words(c, b->head, 2) || b->head[0] >= call->s->count || b->head[1] > c->left) return fail_cut(diag);
    const size_t count = b->q.count = b->head[1];
    b->alone = take(c, count * sizeof *b->alone);
    if (!b->alone || !shards_share_owns(call->s, (uint32_t)b->head[0])) return fail_cut(diag);
    if (!call->q->ranges) {
        b->q.points = take(c, count * b->q.width * sizeof(double));
        if (b->q.directions) b->q.directions = take(c, count * (size_t)b->q.dim * sizeof(double));
        return b->q.points && (b->q.directions || !call->q->directions) ? FROE_OK : fail_cut(diag);
    }
    b->q.ranges = b->ranges = support_calloc(&call->s->alloc, count, sizeof *b->ranges);
    if (!b->ranges) return support_fail_memory(diag);
    for (size_t i = 0; i < count; i++)
        if (!take_range(c, b->ranges + i, (size_t)call->q->dim)) return fail_cut(diag);
    return FROE_OK;
}

/* Words for all processes of what is listed for their shards. */
static froe_status put_lists(shards_call *call, const size_t *starts, const size_t *which, const bool *alone,
                             froe_diagnostic *diag) {
    shards_share *share = call->s->share;
    const uint64_t active = starts[call->s->count] > 0;
    for (uint32_t r = 0; r < share->count; r++) {
        size_t *count = &share->out_counts[r];
        bool ok = shards_share_put(share, count, &active, sizeof active);
        for (uint32_t turn = 0, t; r != share->rank && ok && next_shard_of(call->s, r, &turn, &t);) {
            const size_t first = starts[t], questions = starts[t + 1] - first;
            if (questions) ok = put_questions(share, count, call->q, t, which + first, alone + first, questions);
        }
        if (!ok) return support_fail_memory(diag);
    }
    return FROE_OK;
}

/* ------------------------------------------------------------------ answers -- */

/* What was found for a block of questions, in their order. */
typedef struct answer_list {
    uint32_t *counts; /* of each question */
    ARRAY(uint64_t) tags;
    ARRAY(uint32_t) objects;
    ARRAY(double) values;
    bool counted, valued;
    froe_allocator alloc;
} answer_list;

static bool note_answer(void *user, size_t i, const froe_find *find) {
    answer_list *a = user;
    a->counts[i] += a->counted ? (uint32_t)find->tag : 1;
    return a->counted ||
           (array_push(&a->alloc, &a->tags, find->tag) && array_push(&a->alloc, &a->objects, find->object) &&
            (!a->valued || array_push(&a->alloc, &a->values, find->value)));
}

static bool put_answers(shards_share *share, size_t *count, const answer_list *a, size_t questions) {
    return shards_share_put(share, count, a->counts, questions * sizeof *a->counts) &&
           shards_share_put(share, count, a->tags.data, a->tags.count * sizeof *a->tags.data) &&
           shards_share_put(share, count, a->objects.data, a->objects.count * sizeof *a->objects.data) &&
           shards_share_put(share, count, a->values.data, a->values.count * sizeof *a->values.data);
}

/* Answers a block of another process's questions. */
static froe_status answer_block(const shards_call *call, const block *b, size_t *count, froe_diagnostic *diag) {
    froe_shards *s = call->s;
    const size_t questions = b->q.count;
    answer_list found = {.counted = b->q.counted, .valued = b->q.bound != NULL, .alloc = s->alloc};
    shards_call own = *call;
    size_t *which = support_calloc(&s->alloc, questions, sizeof *which);
    found.counts = support_calloc(&s->alloc, questions, sizeof *found.counts);
    froe_status status = which && found.counts ? FROE_OK : support_fail_memory(diag);
    for (size_t i = 0; i < questions && !status; i++) which[i] = i;
    own.q = &b->q, own.limit = questions, own.take = note_answer, own.take_user = &found;
    if (!status) status = shards_call_shard(&own, (uint32_t)b->head[0], which, b->alone, questions, diag);
    const uint64_t head[2] = {found.tags.count, own.limit};
    bool ok = status || shards_share_put(s->share, count, head, sizeof head);
    if (ok && own.limit < questions) ok = shards_share_put(s->share, count, &own.bad, sizeof own.bad);
    if (ok && !status) ok = put_answers(s->share, count, &found, questions);
    if (!ok) status = support_fail_memory(diag);
    array_free(&s->alloc, &found.tags);
    array_free(&s->alloc, &found.objects);
    array_free(&s->alloc, &found.values);
    if (found.counts) support_free(&s->alloc, found.counts, questions * sizeof *found.counts);
    if (which) support_free(&s->alloc, which, questions * sizeof *which);
    return status;
}

/* Answers what came, into `out`. *more: has any process questions? */
static froe_status answer_others(const shards_call *call, bool *more, froe_diagnostic *diag) {
    shards_share *share = call->s->share;
    letter c = {share->in.bytes, 0};
    froe_status status = FROE_OK;
    *more = false;
    for (uint32_t r = 0; r < share->count; r++) {
        uint64_t active;
        c.left = share->in_counts[r];
        if (!take_words(&c, &active, 1)) return fail_cut(diag);
        *more = *more || active;
        while (c.left && !status) {
            block b;
            status = take_questions(&c, call, &b, diag);
            if (!status) status = answer_block(call, &b, &share->out_counts[r], diag);
            if (b.ranges) support_free(&call->s->alloc, b.ranges, b.q.count * sizeof *b.ranges);
        }
        if (status) return status;
    }
    return FROE_OK;
}

/* Takes `all` answers that another process has found in a shard. */
static froe_status take_answers(shards_call *call, letter *c, uint32_t shard, const size_t *which, size_t questions,
                                size_t all, froe_diagnostic *diag) {
    const bool valued = call->q->bound != NULL;
    const uint32_t *counts = take(c, questions * sizeof *counts);
    const uint64_t *tags = counts ? take(c, all * sizeof *tags) : NULL;
    const uint32_t *objects = tags ? take(c, all * sizeof *objects) : NULL;
    const double *values = objects && valued ? take(c, all * sizeof *values) : NULL;
    if (!objects || (valued && !values)) return fail_cut(diag);
    size_t at = 0;
    for (size_t i = 0; i < questions; i++) {
        froe_find find = {.tag = counts[i], .shard = shard, .object = FROE_NONE};
        if (call->q->counted && counts[i] && !call->take(call->take_user, which[i], &find))
            return support_fail_memory(diag);
        if (call->q->counted) continue;
        if (counts[i] > all - at) return fail_cut(diag);
        for (const size_t end = at + counts[i]; at < end; at++) {
            find = (froe_find){tags[at], shard, objects[at], values ? values[at] : 0};
            if (!call->take(call->take_user, which[i], &find)) return support_fail_memory(diag);
        }
    }
    return at == all ? FROE_OK : fail_cut(diag);
}

/* Takes what another process has found for the questions that were sent to it. */
static froe_status take_block(shards_call *call, letter *c, uint32_t shard, const size_t *which, size_t questions,
                              froe_diagnostic *diag) {
    uint64_t head[2];
    if (!take_words(c, head, 2) || head[0] > c->left || head[1] > questions) return fail_cut(diag);
    if (head[1] < questions) {
        const void *bad = take(c, sizeof call->bad);
        if (!bad) return fail_cut(diag);
        if (which[head[1]] < call->limit) {
            memcpy(&call->bad, bad, sizeof call->bad);
            call->limit = which[head[1]];
            call->bad.object = (uint32_t)call->limit;
        }
    }
    return take_answers(call, c, shard, which, questions, head[0], diag);
}

static froe_status take_all(shards_call *call, const size_t *starts, const size_t *which, froe_diagnostic *diag) {
    const shards_share *share = call->s->share;
    letter c = {share->in.bytes, 0};
    froe_status status = FROE_OK;
    for (uint32_t r = 0; r < share->count && !status; r++) {
        c.left = share->in_counts[r];
        for (uint32_t turn = 0, t; r != share->rank && !status && next_shard_of(call->s, r, &turn, &t);)
            if (starts[t] < starts[t + 1])
                status = take_block(call, &c, t, which + starts[t], starts[t + 1] - starts[t], diag);
        if (!status && c.left) status = fail_cut(diag);
    }
    return status;
}

froe_status shards_share_ask(shards_call *call, froe_status status, const size_t *starts, const size_t *which,
                             const bool *alone, bool *more, froe_diagnostic *diag) {
    shards_share *share = call->s->share;
    *more = false;
    if (!status) status = put_lists(call, starts, which, alone, diag);
    if ((status = shards_share_trade(share, status, diag))) return status;
    bool any;
    status = answer_others(call, &any, diag);
    for (uint32_t turn = 0, t; !status && next_shard_of(call->s, share->rank, &turn, &t);) {
        const size_t first = starts[t], count = starts[t + 1] - first;
        if (count) status = shards_call_shard(call, t, which + first, alone + first, count, diag);
    }
    if (!status && !any) return FROE_OK; /* which all processes know */
    if (!status) status = shards_call_progress(call, call->upto, diag);
    if ((status = shards_share_trade(share, status, diag))) return status;
    *more = true;
    status = take_all(call, starts, which, diag);
    froe_shard_records_free(&share->in);
    return status;
}
