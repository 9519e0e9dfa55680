/* share.c: questions go to the owners of shards, and what was found comes back; see share.h. */
#include "shards/ask/share.h"
#include "shards/ask/letters.h"
#include "shards/ask/serve.h"
#include "support/fail.h"
#include "support/floats.h"

enum { WORD = 8 };

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

/* ------------------------------------------------------------------- asking -- */

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
            if (questions) ok = shards_put_questions(share, count, call->q, t, which + first, alone + first, questions);
        }
        if (!ok) return support_fail_memory(diag);
    }
    return FROE_OK;
}

static froe_status take_all(shards_call *call, const size_t *starts, const size_t *which, froe_diagnostic *diag) {
    const shards_share *share = call->s->share;
    shards_letter c = {share->in.bytes, 0};
    froe_status status = FROE_OK;
    for (uint32_t r = 0; r < share->count && !status; r++) {
        c.left = share->in_counts[r];
        for (uint32_t turn = 0, t; r != share->rank && !status && next_shard_of(call->s, r, &turn, &t);)
            if (starts[t] < starts[t + 1])
                status = shards_take_answers(call, &c, t, which + starts[t], starts[t + 1] - starts[t], diag);
        if (!status && c.left) status = shards_letter_cut(diag);
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
    status = shards_serve(call, starts, which, alone, &any, diag);
    if (!status && !any) return FROE_OK; /* which all processes know */
    if (!status) status = shards_call_progress(call, call->upto, diag);
    if ((status = shards_share_trade(share, status, diag))) return status;
    *more = true;
    status = take_all(call, starts, which, diag);
    froe_shard_records_free(&share->in);
    return status;
}
