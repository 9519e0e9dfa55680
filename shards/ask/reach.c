/* reach.c: one shard asked, and all shards in reach; see ask.h. */
#include "shards/ask/ask.h"
#include "shards/ask/share.h"
#include "shards/record.h"
#include "support/fail.h"
#include "support/floats.h"
#include <math.h>

/* ---------------------------------------------------------------- one shard -- */

froe_status shards_call_begin(froe_shards *s, const shards_question *q, const froe_batch_options *options,
                              shards_call *out, froe_diagnostic *diag) {
    if (options && options->size != sizeof *options) return support_fail_defaults(diag, "froe_batch_defaults");
    *out = (shards_call){.s = s, .q = q, .options = froe_batch_defaults(), .limit = q->count, .upto = 1};
    shards_share_begin(s);
    if (options) {
        out->options.threads = options->threads;
        out->progress = options->progress;
        out->user = options->user;
    }
    return FROE_OK;
}

froe_status shards_call_progress(shards_call *call, double done, froe_diagnostic *diag) {
    const volatile double share = call->done = done;
    return !call->progress || support_callback(call->progress(call->user, share)) ? FROE_OK
                                                                                  : support_fail_cancelled(diag);
}

froe_status shards_call_end(const shards_call *call, froe_diagnostic *diag) {
    if (call->limit == call->q->count) return FROE_OK;
    shards_share_refuse(call->s);
    if (diag) *diag = call->bad;
    return call->bad.status;
}

/* Is a shard the first of those that are asked question i and have an object with this box? See ask.h. */
static bool is_first(const shards_call *call, size_t i, uint32_t shard, const double *lo, const double *hi) {
    const shards_question *q = call->q;
    const froe_shards *s = call->s;
    const froe_shard_plan *plan = s->manifest.plan;
    bool inside = true; /* the cell, so that no other has it */
    for (int a = 0; a < s->dim; a++)
        inside = inside && lo[a] > shards_cell_lo(plan, shard)[a] && hi[a] < shards_cell_hi(plan, shard)[a];
    if (inside) return true;
    if (q->box) {
        double box_lo[FROE_MAX_DIM], box_hi[FROE_MAX_DIM];
        q->box(q, i, box_lo, box_hi);
        for (int a = 0; a < s->dim; a++) box_lo[a] = box_lo[a] > lo[a] ? box_lo[a] : lo[a];
        return shards_plan_first(plan, box_lo) == shard;
    }
    if (!shards_boxes_meet(lo, hi, shards_cell_lo(plan, shard), shards_cell_hi(plan, shard), s->dim)) return false;
    const double bound = q->bound(q, i, shards_entry(s, shard)->lo, shards_entry(s, shard)->hi);
    for (uint32_t t = 0; t < s->count; t++) {
        const froe_shard_entry *e = shards_entry(s, t);
        if (t == shard || !e->objects ||
            !shards_boxes_meet(lo, hi, shards_cell_lo(plan, t), shards_cell_hi(plan, t), s->dim))
            continue;
        const double other = q->bound(q, i, e->lo, e->hi);
        if (isfinite(other) && (other < bound || (other == bound && t < shard))) return false;
    }
    return true;
}

/* Does the shard report an object that it has found for question i, or another shard? */
static bool reports(const shards_call *call, uint32_t shard, size_t i, bool alone, uint32_t object) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    if (alone || call->q->any || call->q->groups) return true;
    shards_scene_box(froe_tree_scene(call->s->slots[shard].tree), object, lo, hi);
    return is_first(call, i, shard, lo, hi);
}

/* Hands over what a shard found, but for what another one reports. */
static froe_status take_answers(shards_call *call, uint32_t shard, const size_t *which, const bool *alone,
                                const froe_answers *answers, froe_diagnostic *diag) {
    const froe_scene *scene = froe_tree_scene(call->s->slots[shard].tree);
    for (size_t j = 0; j < answers->queries; j++) {
        froe_find all = {.shard = shard, .object = FROE_NONE};
        for (size_t at = answers->starts[j]; at < answers->starts[j + 1]; at++) {
            froe_find find = {
                .shard = shard, .object = answers->ids[at], .value = answers->values ? answers->values[at] : 0};
            if (!reports(call, shard, which[j], alone[j], find.object)) continue;
            all.tag++;
            if (call->q->counted) continue;
            find.tag = call->q->groups ? find.object : froe_scene_object(scene, find.object).tag;
            if (call->q->groups) find.object = FROE_NONE;
            if (!call->take(call->take_user, which[j], &find)) return support_fail_memory(diag);
        }
        if (call->q->counted && all.tag && !call->take(call->take_user, which[j], &all))
            return support_fail_memory(diag);
    }
    return FROE_OK;
}

froe_status shards_call_shard(shards_call *call, uint32_t shard, const size_t *which, const bool *alone, size_t count,
                              froe_diagnostic *diag) {
    froe_query *query;
    shards_answers answers = {.own = false};
    froe_diagnostic why;
    while (count && which[count - 1] >= call->limit) count--;
    if (!count) return FROE_OK;
    froe_status status = shards_query(call->s, shard, &query, diag);
    if (status) return status;
    status = call->q->ask(call->q, query, which, count, &call->options, &answers, &why);
    if ((status == FROE_E_INPUT || status == FROE_E_UNSUPPORTED) && why.object < count) {
        call->limit = which[why.object];
        why.object = (uint32_t)call->limit;
        call->bad = why;
        return FROE_OK;
    }
    if (status) {
        if (diag) *diag = why;
        return shards_name_file(call->s, shard, status, diag);
    }
    if (call->limit == call->q->count) status = take_answers(call, shard, which, alone, &answers.all, diag);
    shards_answers_free(&answers);
    return status;
}

froe_status shards_call_all(shards_call *call, froe_status status, const size_t *starts, const size_t *which,
                            const bool *alone, bool *more, froe_diagnostic *diag) {
    const uint32_t shards = call->s->count;
    const double done = call->done;
    if (call->s->share) return shards_share_ask(call, status, starts, which, alone, more, diag);
    *more = !status && starts[shards] > 0;
    for (uint32_t t = 0; t < shards && !status; t++) {
        const size_t first = starts[t], end = starts[t + 1];
        if (first == end) continue;
        status = shards_call_shard(call, t, which + first, alone + first, end - first, diag);
        const double part = (double)end / (double)starts[shards];
        if (!status) status = shards_call_progress(call, done + (call->upto - done) * part, diag);
    }
    return status;
}

/* --------------------------------------------------------- all that is reached -- */

/* Which shards are asked which questions. */
typedef struct reached {
    size_t *starts; /* [questions + 1] */
    ARRAY(uint32_t) shards;
    size_t *shard_starts; /* [shards + 1], the same by shards */
    size_t *which;
    bool *alone;
} reached;

/* The shards of question i that may have answers; writes their numbers. A question that reaches none is asked of one,
 * which finds out whether it is a question. */
static uint32_t shards_in_reach(const froe_shards *s, const shards_question *q, size_t i, uint32_t *cells) {
    uint32_t count = 0, kept = 0;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    if (q->box) {
        q->box(q, i, lo, hi);
        count = shards_plan_cells(s->manifest.plan, lo, hi, cells);
    }
    for (uint32_t j = 0; j < (q->box ? count : s->count); j++) {
        const uint32_t shard = q->box ? cells[j] : j;
        const froe_shard_entry *e = shards_entry(s, shard);
        if (!e->objects) continue;
        const bool met = q->groups || (q->box ? shards_boxes_meet(lo, hi, e->lo, e->hi, s->dim)
                                              : isfinite(q->bound(q, i, e->lo, e->hi)));
        if (met) cells[kept++] = shard;
    }
    if (!kept) cells[kept++] = s->first;
    return kept;
}

static bool find_reached(const froe_shards *s, const shards_question *q, reached *r) {
    uint32_t *cells = support_calloc(&s->alloc, s->count, sizeof *cells);
    r->starts = support_calloc(&s->alloc, q->count + 1, sizeof *r->starts);
    r->shard_starts = support_calloc(&s->alloc, (size_t)s->count + 2, sizeof *r->shard_starts);
    bool ok = cells && r->starts && r->shard_starts;
    for (size_t i = 0; i < q->count && ok; i++) {
        const uint32_t count = shards_in_reach(s, q, i, cells);
        ok = array_append(&s->alloc, &r->shards, cells, count);
        r->starts[i + 1] = r->shards.count;
        for (uint32_t j = 0; j < count; j++) r->shard_starts[cells[j] + 2]++;
    }
    support_free(&s->alloc, cells, cells ? s->count * sizeof *cells : 0);
    r->which = ok ? support_calloc(&s->alloc, r->shards.count, sizeof *r->which) : NULL;
    r->alone = ok ? support_calloc(&s->alloc, r->shards.count, sizeof *r->alone) : NULL;
    if (!r->which || !r->alone) return false;
    size_t *at = r->shard_starts + 1; /* of each shard, where it goes on; in the end where it ends */
    for (uint32_t i = 0; i < s->count; i++) at[i + 1] += at[i];
    for (size_t i = 0; i < q->count; i++)
        for (size_t j = r->starts[i]; j < r->starts[i + 1]; j++) {
            const size_t place = at[r->shards.data[j]]++;
            r->which[place] = i;
            r->alone[place] = r->starts[i + 1] - r->starts[i] == 1 && !s->manifest.plan->areas;
        }
    return true;
}

static void free_reached(const froe_shards *s, const shards_question *q, reached *r) {
    if (r->starts) support_free(&s->alloc, r->starts, (q->count + 1) * sizeof *r->starts);
    if (r->shard_starts) support_free(&s->alloc, r->shard_starts, ((size_t)s->count + 2) * sizeof *r->shard_starts);
    if (r->which) support_free(&s->alloc, r->which, r->shards.count * sizeof *r->which);
    if (r->alone) support_free(&s->alloc, r->alone, r->shards.count * sizeof *r->alone);
    array_free(&s->alloc, &r->shards);
}

froe_status shards_reach(froe_shards *s, const shards_question *q, const froe_batch_options *options,
                         shards_take_fn *take, void *user, froe_diagnostic *diag) {
    shards_call call;
    reached r = {0};
    froe_status status = shards_call_begin(s, q, options, &call, diag);
    if (status) return status;
    call.take = take;
    call.take_user = user;
    bool more;
    status = find_reached(s, q, &r) ? FROE_OK : support_fail_memory(diag);
    status = shards_call_all(&call, status, r.shard_starts, r.which, r.alone, &more, diag);
    free_reached(s, q, &r);
    return status ? status : shards_call_end(&call, diag);
}

froe_status shards_find_all(froe_shards *s, const shards_question *q, const froe_batch_options *options,
                            froe_finds *out, froe_diagnostic *diag) {
    shards_gather found = {.values = q->bound != NULL, .alloc = s->alloc};
    froe_status status = shards_reach(s, q, options, shards_gather_take, &found, diag);
    if (!status && shards_gather_finds(&found, q->count, out)) status = support_fail_memory(diag);
    array_free(&found.alloc, &found.list);
    return status;
}
