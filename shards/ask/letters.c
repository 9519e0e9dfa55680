/* letters.c: see letters.h. */
#include "shards/ask/letters.h"
#include "support/fail.h"

enum { WORD = 8, RANGE_WORDS = 4 };

/* The next bytes, whole words of them. NULL: they are not there. */
static const void *take(shards_letter *c, size_t size) {
    const size_t room = (size + WORD - 1) / WORD * WORD;
    const void *found = c->at;
    /* one way: sizes are of numbers of items that were compared with the bytes that are left */
    if (size > SIZE_MAX - WORD || room > c->left) return NULL;
    c->at += room;
    c->left -= room;
    return found;
}

bool shards_letter_words(shards_letter *c, uint64_t *words, size_t count) {
    const void *found = take(c, count * WORD);
    if (found) memcpy(words, found, count * WORD);
    return found;
}

froe_status shards_letter_cut(froe_diagnostic *diag) {
    return support_fail(diag, FROE_E_FORMAT, "Words of another process have been cut off on their way.");
}

void shards_list_free(const froe_allocator *alloc, shards_list *l) {
    if (l->ranges) support_free(alloc, l->ranges, l->count * sizeof *l->ranges);
    if (l->counts) support_free(alloc, l->counts, l->count * sizeof *l->counts);
    array_free(alloc, &l->tags);
    array_free(alloc, &l->objects);
    array_free(alloc, &l->values);
    l->ranges = NULL, l->counts = NULL;
}

/* ---------------------------------------------------------------- questions -- */

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
static bool take_range(shards_letter *c, froe_range *r, size_t dim) {
    uint64_t words[RANGE_WORDS];
    const void *range = shards_letter_words(c, words, RANGE_WORDS) ? take(c, sizeof *r) : NULL;
    if (!range || words[0] > c->left / WORD || words[1] > c->left / WORD) return false;
    memcpy(r, range, sizeof *r);
    const double *points = take(c, words[0] * sizeof *points), *offsets = take(c, words[1] * sizeof *offsets);
    r->points = words[2] ? points : NULL;
    r->offsets = words[3] ? offsets : NULL;
    return offsets && r->count <= SIZE_MAX / dim && points_of_range(r, dim) == words[0] &&
           offsets_of_range(r) == words[1];
}

bool shards_put_questions(shards_share *share, size_t *count, const shards_question *q, uint32_t shard,
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

froe_status shards_take_questions(shards_letter *c, const shards_call *call, shards_list *out, froe_diagnostic *diag) {
    const shards_question *q = call->q;
    const size_t dim = (size_t)q->dim;
    uint64_t head[2];
    *out = (shards_list){.count = 0};
    if (!shards_letter_words(c, head, 2) || head[0] >= call->s->count || head[1] > c->left ||
        !shards_share_owns(call->s, (uint32_t)head[0]))
        return shards_letter_cut(diag);
    out->shard = (uint32_t)head[0];
    out->count = out->limit = head[1];
    out->alone = take(c, out->count * sizeof *out->alone);
    if (!out->alone) return shards_letter_cut(diag);
    for (size_t i = 0; i < out->count; i++) /* bytes of another process need not be those of a bool */
        if (((const unsigned char *)out->alone)[i] > 1) return shards_letter_cut(diag);
    if (!q->ranges) {
        out->points = take(c, out->count * q->width * sizeof(double));
        out->directions = q->directions ? take(c, out->count * dim * sizeof(double)) : NULL;
        return out->points && (out->directions || !q->directions) ? FROE_OK : shards_letter_cut(diag);
    }
    out->ranges = support_calloc(&call->s->alloc, out->count, sizeof *out->ranges);
    if (!out->ranges) return support_fail_memory(diag);
    for (size_t i = 0; i < out->count; i++)
        if (!take_range(c, out->ranges + i, dim)) return shards_letter_cut(diag);
    return FROE_OK;
}

/* ------------------------------------------------------------------ answers -- */

bool shards_put_answers(shards_share *share, size_t *count, const shards_list *l) {
    const uint64_t head[2] = {l->tags.count, l->limit};
    return shards_share_put(share, count, head, sizeof head) &&
           (l->limit == l->count || shards_share_put(share, count, &l->bad, sizeof l->bad)) &&
           shards_share_put(share, count, l->counts, l->count * sizeof *l->counts) &&
           shards_share_put(share, count, l->tags.data, l->tags.count * sizeof *l->tags.data) &&
           shards_share_put(share, count, l->objects.data, l->objects.count * sizeof *l->objects.data) &&
           shards_share_put(share, count, l->values.data, l->values.count * sizeof *l->values.data);
}

/* Takes `all` answers. */
static froe_status take_answers(shards_call *call, shards_letter *c, uint32_t shard, const size_t *which,
                                size_t questions, size_t all, froe_diagnostic *diag) {
    const bool valued = call->q->bound != NULL;
    const uint32_t *counts = take(c, questions * sizeof *counts);
    const uint64_t *tags = counts ? take(c, all * sizeof *tags) : NULL;
    const uint32_t *objects = tags ? take(c, all * sizeof *objects) : NULL;
    const double *values = objects && valued ? take(c, all * sizeof *values) : NULL;
    if (!objects || (valued && !values)) return shards_letter_cut(diag);
    size_t at = 0;
    for (size_t i = 0; i < questions; i++) {
        froe_find find = {.tag = counts[i], .shard = shard, .object = FROE_NONE};
        if (call->q->counted && counts[i] && !call->take(call->take_user, which[i], &find))
            return support_fail_memory(diag);
        if (call->q->counted) continue;
        if (counts[i] > all - at) return shards_letter_cut(diag);
        for (const size_t end = at + counts[i]; at < end; at++) {
            find = (froe_find){tags[at], shard, objects[at], values ? values[at] : 0};
            if (!call->take(call->take_user, which[i], &find)) return support_fail_memory(diag);
        }
    }
    return at == all ? FROE_OK : shards_letter_cut(diag);
}

/* Does it say why a question is bad? See shards_call_shard(). */
static bool is_refusal(const froe_diagnostic *bad) {
    return (bad->status == FROE_E_INPUT || bad->status == FROE_E_UNSUPPORTED) &&
           memchr(bad->message, '\0', sizeof bad->message);
}

froe_status shards_take_answers(shards_call *call, shards_letter *c, uint32_t shard, const size_t *which,
                                size_t questions, froe_diagnostic *diag) {
    uint64_t head[2];
    if (!shards_letter_words(c, head, 2) || head[0] > c->left || head[1] > questions) return shards_letter_cut(diag);
    if (head[1] < questions) {
        froe_diagnostic bad = {0};
        const void *found = take(c, sizeof bad);
        if (found) memcpy(&bad, found, sizeof bad);
        if (!is_refusal(&bad)) return shards_letter_cut(diag);
        if (which[head[1]] < call->limit) {
            call->bad = bad;
            call->limit = which[head[1]];
            call->bad.object = (uint32_t)call->limit;
        }
    }
    return take_answers(call, c, shard, which, questions, head[0], diag);
}
