/* match.c: the steps of match.h. */
#include "scene/match.h"
#include <string.h>

enum { PART_BITS_MOST = 13, RUN = 16, WRONG = 64, PARTS_A_JOB = 16, AHEAD = 128 };

const match_plan match_usual = {.least = 256, .chunk = 1 << 15, .part = 1024, .careful = 1 << 26, .mask = UINT64_MAX};

/* ------------------------------------------------------------------- points -- */

/** Chunk by its number among all; the number of its first point; how many it has. */
static const double *chunk_points(const match_work *w, uint32_t chunk, uint32_t *number, uint32_t *count) {
    const match_points *p = &w->points;
    const bool known = chunk < w->known_chunks;
    const uint32_t from = (known ? chunk : chunk - w->known_chunks) * w->chunk;
    const uint32_t all = known ? p->known_count : p->fresh_count;
    *count = all - from < w->chunk ? all - from : w->chunk;
    *number = known ? from : p->known_count + from;
    return (known ? p->known : p->fresh) + (size_t)from * (size_t)p->dim;
}

static const double *point_at(const match_work *w, uint32_t number) {
    const match_points *p = &w->points;
    const bool known = number < p->known_count;
    return (known ? p->known : p->fresh) + (size_t)(known ? number : number - p->known_count) * (size_t)p->dim;
}

/* --------------------------------------------------------------------- deal -- */

/** Hashes of n points; false: a coordinate is not finite. Multiplications move differences to higher bits, shifts to
 * lower ones; the highest bits of the last product are the best. */
static inline __attribute__((always_inline)) bool hash_in(const double *x, size_t n, int dim, uint64_t *out) {
    uint64_t bad = 0;
    for (size_t i = 0; i < n; i++) {
        uint64_t hash = 0, bits;
        __builtin_prefetch(x + (i + AHEAD) * (size_t)dim);
        for (int k = 0; k < dim; k++) {
            const double y = x[i * (size_t)dim + (size_t)k] + 0.0; /* no -0 */
            memcpy(&bits, &y, sizeof bits);
            bad |= ((bits >> 52 & 0x7ff) + 1) & 0x800; /* the exponent of infinity and NaN */
            hash = (hash ^ bits) * 0xbf58476d1ce4e5b9u;
            hash ^= hash >> 32;
        }
        out[i] = hash * 0x94d049bb133111ebu;
    }
    return !bad;
}

static bool hash_points(const double *x, size_t n, int dim, uint64_t mask, uint64_t *out) {
    const bool finite = dim == 2   ? hash_in(x, n, 2, out)
                        : dim == 3 ? hash_in(x, n, 3, out)
                                   : hash_in(x, n, dim, out); /* loops of known length */
    for (size_t i = 0; mask != UINT64_MAX && i < n; i++) out[i] &= mask;
    return finite;
}

static froe_status deal_chunk(void *user, unsigned worker, size_t job) {
    match_work *w = user;
    const uint32_t chunk = (uint32_t)job, parts = 1u << w->part_bits;
    uint32_t number, count, *begin = w->begins + (size_t)chunk * (parts + 1), sum = 0;
    const double *x = chunk_points(w, chunk, &number, &count);
    uint64_t *hash = w->scratch + worker * w->scratch_each;
    uint64_t *entries = w->entries + number;
    const uint64_t tags = UINT64_MAX << w->number_bits;
    if (!hash_points(x, count, w->points.dim, w->plan.mask, hash)) atomic_store(&w->lost, true);
    if (atomic_load(&w->lost)) return FROE_OK;
    for (uint32_t i = 0; i < count; i++) begin[hash[i] >> (64 - w->part_bits)]++;
    for (uint32_t p = 0; p <= parts; p++) {
        const uint32_t size = begin[p];
        begin[p] = sum;
        sum += size;
    }
    for (uint32_t i = 0; i < count; i++) {
        const uint64_t h = hash[i];
        entries[begin[h >> (64 - w->part_bits)]++] = (h << w->part_bits & tags) | (number + i);
    }
    memmove(begin + 1, begin, parts * sizeof *begin); /* begins have moved to ends */
    begin[0] = 0;
    return FROE_OK;
}

/* -------------------------------------------------------------------- match -- */

typedef struct match_table {
    uint64_t *slots; /**< tag and number + 1; 0: free */
    uint32_t slot_bits, number_bits, room;
} match_table;

/** Sends a run of entries through the table. Those that equal an earlier one come to the front; *equal of them.
 * False: the table is full. */
static bool match_run(match_table *t, uint64_t *run, uint32_t count, uint32_t *equal) {
    const uint64_t numbers = ~(UINT64_MAX << t->number_bits);
    const uint32_t mask = (1u << t->slot_bits) - 1;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint64_t e = run[i];
        uint32_t at = (uint32_t)(e >> (64 - t->slot_bits));
        while (t->slots[at] && (t->slots[at] ^ (e + 1)) > numbers) at = (at + 1) & mask;
        if (t->slots[at]) {
            run[kept++] = ((t->slots[at] & numbers) - 1) << 32 | (e & numbers);
        } else {
            if (!t->room--) return false;
            t->slots[at] = e + 1;
        }
    }
    *equal = kept;
    return true;
}

/** The entries of a part that are of one chunk. */
static uint64_t *part_run(const match_work *w, uint32_t chunk, uint32_t part, uint32_t *count) {
    const uint32_t *begin = w->begins + (size_t)chunk * ((1u << w->part_bits) + 1) + part;
    uint32_t number, points;
    (void)chunk_points(w, chunk, &number, &points);
    *count = begin[1] - begin[0];
    return w->entries + number + begin[0];
}

static froe_status match_parts(void *user, unsigned worker, size_t job) {
    match_work *w = user;
    const uint32_t parts = 1u << w->part_bits, slots = 1u << w->slot_bits;
    match_table t = {
        .slots = w->scratch + worker * w->scratch_each, .slot_bits = w->slot_bits, .number_bits = w->number_bits};
    for (uint32_t p = (uint32_t)job * PARTS_A_JOB; p < parts && p < (job + 1) * PARTS_A_JOB; p++) {
        memset(t.slots, 0, slots * sizeof *t.slots);
        t.room = slots - slots / 4;
        for (uint32_t c = 0; c < w->chunks; c++) {
            uint32_t count, *equal = w->equal + (size_t)c * parts + p;
            if (c + 2 < w->chunks) {
                const uint64_t *ahead = part_run(w, c + 2, p, &count);
                __builtin_prefetch(ahead);
                __builtin_prefetch(ahead + RUN / 2);
            }
            uint64_t *run = part_run(w, c, p, &count);
            if (match_run(&t, run, count, equal)) continue;
            atomic_store(&w->lost, true);
            return FROE_OK;
        }
    }
    return FROE_OK;
}

/* ------------------------------------------------------------------- spread -- */

static froe_status spread_chunk(void *user, unsigned worker, size_t job) {
    match_work *w = user;
    (void)worker;
    const uint32_t chunk = (uint32_t)job, parts = 1u << w->part_bits, known = w->points.known_count;
    const bool fresh = chunk >= w->known_chunks;
    const uint32_t *begin = w->begins + (size_t)chunk * (parts + 1), *equal = w->equal + (size_t)chunk * parts;
    uint32_t number, count, wrong = 0, *out = w->wrong + (size_t)chunk * WRONG, firsts = 0;
    const double *x = chunk_points(w, chunk, &number, &count);
    const uint64_t *entries = w->entries + number;
    uint32_t *first = fresh ? w->first + (number - known) : NULL;
    const int dim = w->points.dim;
    for (uint32_t i = 0; fresh && i < count; i++) first[i] = number + i;
    for (uint32_t p = 0; p < parts; p++)
        for (const uint64_t *e = entries + begin[p], *end = e + equal[p]; e < end; e++) {
            if (fresh)
                first[(uint32_t)*e - number] = MATCH_EQUAL | (uint32_t)(*e >> 32);
            else if (wrong++ < WRONG) /* known points differ */
                out[wrong - 1] = (uint32_t)*e;
        }
    for (uint32_t i = 0; fresh && !w->careful && i < count; i++) firsts += !(first[i] & MATCH_EQUAL);
    for (uint32_t i = 0; fresh && w->careful && i < count; i++) {
        const bool is_first = !(first[i] & MATCH_EQUAL);
        firsts += is_first;
        if (is_first || match_same_point(x + (size_t)i * (size_t)dim, point_at(w, first[i] & ~MATCH_EQUAL), dim))
            continue;
        if (wrong++ < WRONG) out[wrong - 1] = number + i;
    }
    if (wrong && !w->careful) atomic_store(&w->mistaken, true);
    if (wrong > WRONG) atomic_store(&w->lost, true);
    w->counts[chunk] = wrong;
    w->counts[w->chunks + chunk] = firsts;
    return FROE_OK;
}

/** Points that differ from the first with their tag are compared with one another: the first of them that equals is
 * the first of all, because all points that equal it have that tag. They come in the order of their numbers. */
static void repair(match_work *w) {
    uint32_t *wrong = w->wrong, kept = 0, known = w->points.known_count;
    for (uint32_t c = 0; c < w->chunks; c++)
        for (uint32_t i = 0; i < w->counts[c]; i++) {
            const uint32_t number = w->wrong[(size_t)c * WRONG + i];
            uint32_t j = 0;
            while (j < kept && !match_same_point(point_at(w, number), point_at(w, wrong[j]), w->points.dim)) j++;
            if (number >= known) w->first[number - known] = j < kept ? MATCH_EQUAL | wrong[j] : number;
            if (j < kept) continue;
            w->counts[w->chunks + c] += number >= known;
            wrong[kept++] = number; /* not ahead of what is read */
        }
}

/* -------------------------------------------------------------------- whole -- */

/** How many bits of the hash name parts, and how many points a chunk has: a chunk's run of each part is to be some
 * cache lines long, and a part is to fit the cache, which the largest batches forgo. */
static void choose_sizes(match_work *w) {
    const match_points *p = &w->points;
    const uint64_t all = (uint64_t)p->known_count + p->fresh_count;
    w->part_bits = 1;
    while (w->part_bits < PART_BITS_MOST && all >> w->part_bits > w->plan.part) w->part_bits++;
    w->number_bits = 32 - (uint32_t)__builtin_clz((uint32_t)all); /* for all + 1, too */
    w->slot_bits = 4;
    while (all >> w->part_bits >= (uint64_t)1 << (w->slot_bits - 2)) w->slot_bits++; /* a quarter full at most, about */
    w->chunk = w->plan.chunk;
    while (w->chunk < (uint32_t)RUN << w->part_bits && w->chunk < all) w->chunk *= 2;
    w->known_chunks = (uint32_t)(((uint64_t)p->known_count + w->chunk - 1) / w->chunk);
    w->chunks = w->known_chunks + (uint32_t)(((uint64_t)p->fresh_count + w->chunk - 1) / w->chunk);
    const uint64_t hashes = w->chunk < all ? w->chunk : all, slots = (uint64_t)1 << w->slot_bits;
    w->scratch_each = hashes > slots ? hashes : slots;
}

froe_status match_begin(match_work *w, const match_points *points, const match_plan *plan, base_task *task,
                        const froe_allocator *alloc, uint64_t *entries) {
    *w = (match_work){.points = *points, .plan = *plan, .task = task, .alloc = *alloc, .entries = entries};
    atomic_init(&w->lost, false);
    atomic_init(&w->mistaken, false);
    choose_sizes(w);
    const size_t parts = (size_t)1 << w->part_bits;
    w->begins = support_calloc(alloc, w->chunks * (parts + 1), sizeof *w->begins);
    w->equal = support_calloc(alloc, w->chunks * parts, sizeof *w->equal);
    w->wrong = support_calloc(alloc, (size_t)w->chunks * WRONG, sizeof *w->wrong);
    w->counts = support_calloc(alloc, 2 * (size_t)w->chunks, sizeof *w->counts);
    w->scratch = support_realloc(alloc, NULL, 0, w->scratch_each * task->threads * sizeof *w->scratch);
    if (!w->begins || !w->equal || !w->wrong || !w->counts || !w->scratch) return FROE_E_MEMORY;
    froe_status status = base_run(task, 0.2, w->chunks, deal_chunk, w);
    if (status || atomic_load(&w->lost)) return status;
    status = base_run(task, 0.15, (parts + PARTS_A_JOB - 1) / PARTS_A_JOB, match_parts, w);
    for (size_t i = 0; i < w->chunks * parts; i++) w->equals += w->equal[i];
    return status;
}

froe_status match_spread(match_work *w, bool careful, uint32_t *first, uint32_t *fresh_firsts) {
    w->first = first;
    w->careful = careful;
    froe_status status = base_run(w->task, 0.1, w->chunks, spread_chunk, w);
    if (status || atomic_load(&w->lost)) return status;
    if (careful) repair(w);
    memmove(w->counts, w->counts + w->chunks, w->chunks * sizeof *w->counts);
    *fresh_firsts = 0;
    for (uint32_t c = 0; c < w->chunks; c++) *fresh_firsts += w->counts[c];
    return FROE_OK;
}

void match_end(match_work *w) {
    const size_t parts = (size_t)1 << w->part_bits, chunks = w->chunks;
    support_free(&w->alloc, w->begins, chunks * (parts + 1) * sizeof *w->begins);
    support_free(&w->alloc, w->equal, chunks * parts * sizeof *w->equal);
    support_free(&w->alloc, w->wrong, chunks * WRONG * sizeof *w->wrong);
    support_free(&w->alloc, w->counts, 2 * chunks * sizeof *w->counts);
    support_free(&w->alloc, w->scratch, w->scratch_each * w->task->threads * sizeof *w->scratch);
}
