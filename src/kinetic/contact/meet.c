/* meet.c: see meet.h. */
#include "kinetic/contact/meet.h"
#include "kinetic/contact/walk.h"

froe_status meet_find(const froe_motion *m, meet_worker *worker, uint32_t p, uint32_t q, double a, double b) {
    const motion_object *one = m->objects.data + p, *other = m->objects.data + q;
    worker->arena.top = 0;
    worker->stats.pairs++;
    walk_begin(worker->room, a, b);
    const bool told = m->dim == 2 ? meet_segments(m, worker, one, other) : meet_triangles(m, worker, one, other);
    worker->spans = worker->room->spans;
    worker->span_count = worker->room->span_count;
    return told ? FROE_OK : FROE_E_LIMIT;
}

/* In the plane, and nothing turns. */
static bool is_turnless(const froe_motion *m) {
    return m->dim == 2 && !m->bodies.count;
}

/* Limbs of the widest coefficient. In the plane a turn is the product of two differences  Xq Wp - Xp Wq:  coordinates
 * once and times up to six times in each. In space a corner has coordinates once and times up to nine times, in a body
 * coordinates three times and times twice; the widest is the product of the place of a body and two edges of bodies, of
 * a flat side and a corner of a body, or of such a side and a corner of no body. That is more than where bodies turn in
 * the plane. */
static size_t widest(const froe_motion *m) {
    enum { SPARE_BITS = 64, CUT_BITS = 32 };
    const size_t coordinate = m->top > m->unit ? (size_t)(m->top - m->unit) : 1;
    const size_t time = (m->time_top > m->time_unit ? (size_t)(m->time_top - m->time_unit) : 1) + CUT_BITS;
    return ((is_turnless(m) ? 2 * coordinate + 12 * time : 7 * coordinate + 36 * time) + SPARE_BITS) / 64 + 3;
}

bool meet_is_too_wide(const froe_motion *m) {
    enum { MOST_LIMBS = 160 };
    return m->dim == 3 && m->seconds.count && widest(m) > MOST_LIMBS;
}

froe_status meet_worker_new(const froe_motion *m, meet_worker *out) {
    enum { NUMBERS = 800, MORE_NUMBERS = 12000, CHAINS = 4, MORE_CHAINS = 3, DEGREE = 10 };
    /* In space: what one step of a chain of that degree needs, and twice as much again: 15 chains of degree 8, or 81 of
     * degree 6, keep less. */
    const size_t limbs = widest(m), numbers = is_turnless(m) ? NUMBERS : MORE_NUMBERS;
    const size_t chains = m->dim == 2 ? CHAINS : MORE_CHAINS;
    *out = (meet_worker){.room = support_calloc(&m->alloc, 1, sizeof *out->room)};
    if (m->dim == 3) out->shapes = support_calloc(&m->alloc, 1, meet_triangles_bytes());
    if (!out->room || (m->dim == 3 && !out->shapes)) return FROE_E_MEMORY;
    return num_arena_reserve(&m->alloc, &out->arena,
                             numbers * limbs + chains * num_poly_arena(DEGREE, limbs, NUM_FRACTION_LIMBS));
}

void meet_worker_free(const froe_motion *m, meet_worker *worker) {
    num_arena_free(&m->alloc, &worker->arena);
    support_free(&m->alloc, worker->room, sizeof *worker->room);
    support_free(&m->alloc, worker->shapes, meet_triangles_bytes());
}
