/* contacts.c: the times at which moving objects meet.
 *
 *     slices (slices.h)  ->  pairs whose boxes touch  ->  spans of time (meet.h)  ->  joined, sorted, reported
 *
 * Slices of two objects that touch have a time in common, and all these times together are the time in which both live;
 * so spans that end and begin at the instant where two such times meet are one contact. */
#include "base/apart.h"
#include "base/floats.h"
#include "base/sort.h"
#include "geom/meet/box_pairs.h"
#include "kinetic/contact/meet.h"
#include "kinetic/contact/slices.h"
#include "support/fail.h"

void froe_contact_defaults_into(froe_contact_options *out, size_t size) {
    const froe_contact_options all = {.size = size, .from = NAN, .to = NAN};
    support_defaults(out, size, &all, sizeof all);
}

/* A span of one pair of slices. */
typedef struct contact_record {
    uint32_t a, b;
    double from; /* when the time begins that the slices have in common */
    meet_span span;
} contact_record;

typedef ARRAY(contact_record) record_array;

typedef struct contact_worker {
    meet_worker meet;
    record_array records;
    uint64_t candidates;
    froe_status status;
    uint32_t failed[2];
    base_apart apart;
} contact_worker;

typedef struct contact_search {
    const froe_motion *m;
    const froe_contact_options *o;
    double from, to;
    base_task task;
    slices_table slices;
    contact_worker *workers;
    record_array records; /* of all workers */
    froe_contact *contacts;
    size_t contact_count;
} contact_search;

/* ------------------------------------------------------------------- one pair -- */

/* Not of objects that share a body, nor, unless these are asked for, a vertex; nor, if groups are to be kept apart, of
 * two of one group. */
static bool is_asked_for(const contact_search *s, const motion_object *a, const motion_object *b) {
    const int dim = s->m->dim;
    for (int i = 0; i < dim * dim && !s->o->neighbours; i++)
        if (a->vertices[i / dim] == b->vertices[i % dim]) return false;
    const uint32_t body = s->m->plans.data[a->vertices[0]].body;
    if (body != FROE_NONE && body == s->m->plans.data[b->vertices[0]].body) return false;
    return !s->o->apart || a->group == FROE_NONE || a->group != b->group;
}

static double later_time(double a, double b) {
    return a > b ? a : b;
}

static double earlier(double a, double b) {
    return a < b ? a : b;
}

/* The time both live in, within the time asked for. */
static void common_life(const contact_search *s, uint32_t a, uint32_t b, double life[2]) {
    const motion_object *p = s->m->objects.data + a, *q = s->m->objects.data + b;
    life[0] = later_time(s->from, later_time(p->birth, q->birth));
    life[1] = earlier(s->to, earlier(p->death, q->death));
}

/* Finds the spans of two slices. Slices with a single instant in common are skipped, as longer ones end there, unless
 * the objects have no more time in common. */
static bool look_at_slices(void *user, unsigned number, uint32_t i, uint32_t j) {
    contact_search *s = user;
    contact_worker *w = s->workers + number;
    const slices_entry *p = s->slices.slices.data + i, *q = s->slices.slices.data + j;
    if (p->object > q->object) {
        const slices_entry *swap = p;
        p = q;
        q = swap;
    }
    const froe_motion *m = s->m;
    if (p->object == q->object || !is_asked_for(s, m->objects.data + p->object, m->objects.data + q->object))
        return true;
    double from = later_time(p->from, q->from), to = earlier(p->to, q->to), life[2];
    common_life(s, p->object, q->object, life);
    if (from > to || (from == to && life[0] < life[1])) return true;
    w->candidates++;
    w->status = meet_find(m, &w->meet, p->object, q->object, from, to);
    w->failed[0] = p->object;
    w->failed[1] = q->object;
    for (int k = 0; k < w->meet.span_count && !w->status; k++)
        if (!array_push(&m->alloc, &w->records, (contact_record){p->object, q->object, from, w->meet.spans[k]}))
            w->status = FROE_E_MEMORY;
    return !w->status;
}

static froe_status find_spans(contact_search *s, froe_diagnostic *diag) {
    unsigned threads = s->task.threads;
    s->workers = support_calloc(&s->m->alloc, threads, sizeof *s->workers);
    froe_status status = s->workers ? FROE_OK : FROE_E_MEMORY;
    for (unsigned i = 0; i < threads && !status; i++) status = meet_worker_new(s->m, &s->workers[i].meet);
    if (!status)
        status = geom_box_pairs(&s->m->alloc, &s->task, 1, s->m->dim + 1, (uint32_t)s->slices.slices.count,
                                s->slices.lo.data, s->slices.hi.data, look_at_slices, s);
    for (unsigned i = 0; s->workers && i < threads; i++) {
        const contact_worker *w = s->workers + i;
        if (w->status == FROE_E_LIMIT)
            return support_fail_at(diag, w->status, w->failed[0], FROE_NONE, FROE_NONE,
                                   "%ss %u and %u: Two events happen too close to be told apart.", motion_noun(s->m),
                                   w->failed[0], w->failed[1]);
        if (w->status) status = w->status;
    }
    return status;
}

/* ----------------------------------------------------------------- all of them -- */

/* Spans of one pair of slices stay in their order: where two begin and end between neighbouring doubles, these do not
 * tell it. */
static int compare_records(void *user, uint32_t i, uint32_t j) {
    const contact_search *s = user;
    const contact_record *a = s->records.data + i, *b = s->records.data + j;
    if (a->a != b->a) return a->a < b->a ? -1 : 1;
    if (a->b != b->b) return a->b < b->b ? -1 : 1;
    return (a->from > b->from) - (a->from < b->from);
}

static int compare_contacts(void *user, uint32_t i, uint32_t j) {
    const contact_search *s = user;
    const froe_contact *a = s->contacts + i, *b = s->contacts + j;
    for (int k = 0; k < 2; k++)
        if (a->begin[k] != b->begin[k]) return a->begin[k] < b->begin[k] ? -1 : 1;
    if (a->a != b->a) return a->a < b->a ? -1 : 1;
    return a->b < b->b ? -1 : a->b > b->b;
}

/* The numbers 0 .. count-1 in order; to be freed as 2 count + 1 numbers. */
static uint32_t *sorted(contact_search *s, size_t count, base_compare_fn *compare) {
    uint32_t *order = support_calloc(&s->m->alloc, 2 * count + 1, sizeof *order);
    if (!order) return NULL;
    for (uint32_t i = 0; i < count; i++) order[i] = i;
    base_merge_sort(order, order + count, count, compare, s);
    return order;
}

static void free_order(const contact_search *s, uint32_t *order, size_t count) {
    support_free(&s->m->alloc, order, (2 * count + 1) * sizeof *order);
}

/* Records in order become contacts: one goes on where its last span ended. */
static void join_contacts(contact_search *s, const uint32_t *order) {
    const contact_record *last = NULL;
    for (size_t i = 0; i < s->records.count; i++) {
        const contact_record *r = s->records.data + order[i];
        const meet_span *span = &r->span;
        double life[2];
        common_life(s, r->a, r->b, life);
        const bool to_stop = span->to_end && span->end.high == life[1];
        if (last && last->a == r->a && last->b == r->b && last->span.to_end && span->from_start &&
            last->span.end.high == span->begin.low) {
            froe_contact *c = s->contacts + s->contact_count - 1;
            c->end[0] = span->end.low, c->end[1] = span->end.high;
            c->to_stop = to_stop;
            c->instant = c->instant && span->instant;
        } else {
            s->contacts[s->contact_count++] =
                (froe_contact){.a = r->a,
                               .b = r->b,
                               .begin = {span->begin.low, span->begin.high},
                               .end = {span->end.low, span->end.high},
                               .instant = span->instant,
                               .since_start = span->from_start && span->begin.low == life[0],
                               .to_stop = to_stop};
        }
        last = r;
    }
    /* A contact ends no earlier than it begins, so each bound holds for both. Where it lasts for an instant, or nearly
     * so, the enclosures of begin and end overlap. */
    for (froe_contact *c = s->contacts; c < s->contacts + s->contact_count; c++) {
        if (c->end[0] < c->begin[0]) c->end[0] = c->begin[0];
        if (c->begin[1] > c->end[1]) c->begin[1] = c->end[1];
    }
}

static froe_status make_contacts(contact_search *s) {
    const froe_allocator *alloc = &s->m->alloc;
    size_t count = 0;
    for (unsigned i = 0; i < s->task.threads; i++) count += s->workers[i].records.count;
    if (count >= UINT32_MAX / 2) return FROE_E_LIMIT;
    if (!array_reserve(alloc, &s->records, count)) return FROE_E_MEMORY;
    for (unsigned i = 0; i < s->task.threads; i++) {
        const contact_worker *w = s->workers + i;
        for (size_t k = 0; k < w->records.count; k++) s->records.data[s->records.count++] = w->records.data[k];
    }
    s->contacts = support_calloc(alloc, count + 1, sizeof *s->contacts);
    uint32_t *order = sorted(s, count, compare_records);
    const bool room = s->contacts && order;
    if (room) join_contacts(s, order);
    free_order(s, order, count);
    return room ? FROE_OK : FROE_E_MEMORY;
}

static froe_status tell_contacts(contact_search *s, froe_contact_fn *fn, void *user) {
    uint32_t *order = sorted(s, s->contact_count, compare_contacts);
    if (!order) return FROE_E_MEMORY;
    double first = (double)INFINITY; /* the first contact begins no later */
    for (size_t i = 0; i < s->contact_count && s->o->first; i++) first = earlier(first, s->contacts[i].begin[1]);
    for (size_t i = 0; i < s->contact_count; i++) {
        const froe_contact *c = s->contacts + order[i];
        if (c->begin[0] > first || !base_callback(fn(user, c))) break;
    }
    free_order(s, order, s->contact_count);
    return FROE_OK;
}

/* --------------------------------------------------------------------- a search -- */

static froe_status check_contact_search(contact_search *s, froe_diagnostic *diag) {
    const froe_contact_options *o = s->o;
    if (o->size != sizeof *o) return support_fail_defaults(diag, "froe_contact_defaults");
    s->from = isnan(o->from) ? s->m->begin : o->from;
    s->to = isnan(o->to) ? s->m->end : o->to;
    if (s->from > s->to || s->from < s->m->begin || s->to > s->m->end)
        return support_fail(diag, FROE_E_OPTIONS, "The time %.17g .. %.17g does not lie in the window %.17g .. %.17g.",
                            s->from, s->to, s->m->begin, s->m->end);
    if (o->neighbours && s->m->dim == 2)
        return support_fail(diag, FROE_E_UNSUPPORTED, "Contacts of segments that share a vertex are not told of.");
    if (meet_is_too_wide(s->m))
        return support_fail(diag, FROE_E_LIMIT,
                            "Coordinates of %d bits and times of %d are too wide for contacts along cubics in space.",
                            s->m->top - s->m->unit, s->m->time_top - s->m->time_unit);
    return FROE_OK;
}

static void contact_search_free(contact_search *s) {
    const froe_allocator *alloc = &s->m->alloc;
    for (unsigned i = 0; s->workers && i < s->task.threads; i++) {
        meet_worker_free(s->m, &s->workers[i].meet);
        array_free(alloc, &s->workers[i].records);
    }
    support_free(alloc, s->workers, s->task.threads * sizeof *s->workers);
    support_free(alloc, s->contacts, (s->records.count + 1) * sizeof *s->contacts);
    array_free(alloc, &s->records);
    slices_free(s->m, &s->slices);
}

froe_status froe_motion_contacts(const froe_motion *motion, const froe_contact_options *options, froe_contact_fn *fn,
                                 void *user, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    const froe_contact_options standard = froe_contact_defaults();
    if (!motion || !fn) return support_fail_null(diag, __func__);
    contact_search s = {.m = motion, .o = options ? options : &standard};
    froe_status status = check_contact_search(&s, diag);
    if (status) return status;
    base_task_init(&s.task, s.o->threads, s.o->progress, s.o->user);
    status = slices_find(motion, s.from, s.to, &s.slices);
    if (status == FROE_E_LIMIT) return support_fail(diag, status, "More than 2^31 boxes in space and time are needed.");
    if (!status) status = find_spans(&s, diag);
    if (!status) status = make_contacts(&s);
    if (!status) status = tell_contacts(&s, fn, user);
    if (!status && s.o->statistics) {
        *s.o->statistics = (froe_contact_statistics){.boxes = s.slices.slices.count};
        for (unsigned i = 0; i < s.task.threads; i++) {
            s.o->statistics->candidates += s.workers[i].candidates;
            s.o->statistics->exact += s.workers[i].meet.stats.exact;
        }
    }
    contact_search_free(&s);
    if (status == FROE_E_MEMORY) return support_fail_memory(diag);
    return status == FROE_E_CANCELLED ? support_fail_cancelled(diag) : status;
}
