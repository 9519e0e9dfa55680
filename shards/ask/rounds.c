/* rounds.c: questions that are put to one shard after the other, the lowest bound first; see ask.h.
 *
 * The bound of a shard is a double that is at most each of its values, rounded, so that a shard whose bound is larger
 * than the value of the k-th answer has nothing to add: its exact values are larger as well. */
#include "shards/ask/ask.h"
#include "support/fail.h"
#include <math.h>

/* How far a question is. */
typedef struct question_state {
    double bound; /* of the shard asked last */
    uint32_t shard;
    bool begun, done;
} question_state;

/* A batch of questions in rounds. */
typedef struct rounds {
    froe_shards *s;
    const shards_question *q;
    question_state *states; /* of each question */
    size_t *shard_starts;   /* [shards + 2]: the questions of this round, by shard */
    size_t *which;
    bool *alone;
    froe_finds finds; /* so far */
    uint64_t *counts; /* instead of these, of questions that are counted; NULL: there are no questions */
    size_t active;
} rounds;

/* Has question i its answers, if the next shard has none below a bound? */
static bool is_answered(const rounds *r, size_t i, double bound) {
    if (r->q->counted) return r->counts[i] >= r->q->k;
    const size_t found = r->finds.starts ? r->finds.starts[i + 1] - r->finds.starts[i] : 0;
    if (r->q->any && found) return true;
    return found >= r->q->k && found && bound > r->finds.items[r->finds.starts[i] + r->q->k - 1].value;
}

/* The shard that question i is put to next, if there is one: behind the last by bound, then number. */
static bool find_next(const rounds *r, size_t i) {
    question_state *state = &r->states[i];
    double least = INFINITY;
    uint32_t next = FROE_NONE;
    for (uint32_t t = 0; t < r->s->count; t++) {
        const froe_shard_entry *e = shards_entry(r->s, t);
        if (!e->objects) continue;
        const double bound = r->q->bound(r->q, i, e->lo, e->hi);
        const bool behind = !state->begun || bound > state->bound || (bound == state->bound && t > state->shard);
        if (behind && bound < least && bound <= r->q->most) {
            least = bound;
            next = t;
        }
    }
    if (next == FROE_NONE && !state->begun) { /* one has to find out whether it is a question */
        least = 0;
        next = r->s->first;
    }
    if (next == FROE_NONE || (state->begun && !r->q->k) || is_answered(r, i, least)) return false;
    *state = (question_state){.bound = least, .shard = next, .begun = true};
    return true;
}

/* Assigns the questions that go on to their next shards; none, behind a bad one. */
static void assign_round(rounds *r, const shards_call *call) {
    const uint32_t shards = r->s->count;
    r->active = 0;
    memset(r->shard_starts, 0, ((size_t)shards + 2) * sizeof *r->shard_starts);
    if (call->limit < r->q->count) return;
    for (size_t i = 0; i < r->q->count; i++) {
        question_state *state = &r->states[i];
        if (state->done) continue;
        state->done = !find_next(r, i);
        if (state->done) continue;
        r->active++;
        r->shard_starts[state->shard + 2]++;
    }
    size_t *at = r->shard_starts + 1;
    for (uint32_t t = 0; t < shards; t++) at[t + 1] += at[t];
    for (size_t i = 0; i < r->q->count; i++)
        if (!r->states[i].done) r->which[at[r->states[i].shard]++] = i;
}

/* What was found in a round joins what was found before. Beyond the k-th, answers of its value stay. */
static froe_status join_round(rounds *r, shards_gather *found) {
    bool ok = true;
    for (size_t i = 0; i < r->q->count && r->finds.starts && ok; i++)
        for (size_t at = r->finds.starts[i]; at < r->finds.starts[i + 1] && ok; at++)
            ok = shards_gather_take(found, i, r->finds.items + at);
    froe_finds all;
    if (!ok || shards_gather_finds(found, r->q->count, &all)) return FROE_E_MEMORY;
    froe_finds_free(&r->finds);
    r->finds = all;
    return FROE_OK;
}

/* Asks the questions that go on, and finds out which do so then. *more: does any? Also called with a failure, which
 * other processes wait to hear of. */
static froe_status ask_round(rounds *r, shards_call *call, froe_status status, bool *more, froe_diagnostic *diag) {
    shards_gather found = {.values = true, .alloc = r->s->alloc};
    call->take = r->q->counted ? shards_add_count : shards_gather_take;
    call->take_user = r->q->counted ? (void *)r->counts : &found;
    call->upto = 1 - (double)r->active / (double)(r->q->count + 1);
    status = shards_call_all(call, status, r->shard_starts, r->which, r->alone, more, diag);
    const bool joins = !r->q->counted && (found.list.count || !r->finds.starts);
    if (!status && joins && join_round(r, &found)) status = support_fail_memory(diag);
    array_free(&found.alloc, &found.list);
    if (!status) assign_round(r, call);
    return status;
}

/* All rounds, into counts or finds. */
static froe_status go_rounds(froe_shards *s, const shards_question *q, const froe_batch_options *options,
                             uint64_t *counts, froe_finds *out, froe_diagnostic *diag) {
    shards_call call;
    rounds r = {.s = s, .q = q, .counts = counts};
    bool more = true;
    froe_status status = shards_call_begin(s, q, options, &call, diag);
    if (status) return status;
    const size_t starts = ((size_t)s->count + 2) * sizeof *r.shard_starts;
    r.states = support_calloc(&s->alloc, q->count, sizeof *r.states);
    r.shard_starts = support_calloc(&s->alloc, 1, starts);
    r.which = support_calloc(&s->alloc, q->count, sizeof *r.which);
    r.alone = support_calloc(&s->alloc, q->count, sizeof *r.alone);
    if (!r.states || !r.shard_starts || !r.which || !r.alone) status = support_fail_memory(diag);
    if (!status) assign_round(&r, &call);
    while (more) status = ask_round(&r, &call, status, &more, diag);
    if (!status) status = shards_call_end(&call, diag);
    if (r.states) support_free(&s->alloc, r.states, q->count * sizeof *r.states);
    if (r.shard_starts) support_free(&s->alloc, r.shard_starts, starts);
    if (r.which) support_free(&s->alloc, r.which, q->count * sizeof *r.which);
    if (r.alone) support_free(&s->alloc, r.alone, q->count * sizeof *r.alone);
    if (status)
        froe_finds_free(&r.finds);
    else if (out)
        *out = r.finds;
    return status;
}

froe_status shards_rounds(froe_shards *s, const shards_question *q, const froe_batch_options *options, froe_finds *out,
                          froe_diagnostic *diag) {
    return go_rounds(s, q, options, NULL, out, diag);
}

froe_status shards_rounds_count(froe_shards *s, const shards_question *q, const froe_batch_options *options,
                                uint64_t *counts, froe_diagnostic *diag) {
    if (q->count) memset(counts, 0, q->count * sizeof *counts);
    return go_rounds(s, q, options, counts, NULL, diag);
}
