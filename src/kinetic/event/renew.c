/* renew.c: see renew.h. */
#include "kinetic/event/renew.h"
#include "base/sort.h"
#include "kinetic/kinetic.h"
#include "kinetic/now/straight.h"
#include <math.h>

enum { CERTS_EACH = 1 << 14 }; /* so many certificates are looked at for a segment, at most */

static bool certs_tell_all(const froe_kinetic *k, uint32_t segment) {
    const ktree_segment *s = ktree_segment_at(&k->tree, segment);
    const uint32_t *vertex = k->now.segments.data[segment].end;
    if (!s->here || s->bound || k->collinear.first.data[segment] != FROE_NONE) return false;
    for (uint32_t i = 0; i < 2; i++)
        if (k->tree.vertices.data[vertex[i]] != 2 * segment + i || s->end[i].next != FROE_NONE) return false;
    return true;
}

void renew_note_leaving(froe_kinetic *k, uint32_t segment, uint32_t tell_it) {
    ktree_segment_at(&k->tree, segment)->leaving = (uint32_t)k->events.leaving.count;
    call_push(&k->call, &k->events.leaving, 2 * segment + tell_it);
}

void renew_choose(froe_kinetic *k, int64_t tick) {
    event_state *events = &k->events;
    size_t kept = 0, staying = 0;
    if (k->tree.augmented || k->call.stopped) return;
    for (size_t i = 0; i < events->leaving.count; i++) {
        const uint32_t s = events->leaving.data[i] / 2, life = k->certs.segments.data[s].life;
        const bool lives = life == FROE_NONE || k->certs.all.data[life].tick > tick;
        staying += ktree_segment_at(&k->tree, s)->stays = lives && certs_tell_all(k, s);
    }
    const bool pays = k->certs.all.count / CERTS_EACH <= staying;
    for (size_t i = 0; i < events->leaving.count; i++) {
        const uint32_t s = events->leaving.data[i] / 2;
        ktree_segment *segment = ktree_segment_at(&k->tree, s);
        segment->stays = segment->stays && pays;
        segment->leaving = (uint32_t)kept;
        if (segment->stays)
            call_push(&k->call, &events->staying, s);
        else
            events->leaving.data[kept++] = events->leaving.data[i];
    }
    events->leaving.count = kept;
}

/* The segments that a point is about, of which up to two stay. */
static size_t staying_at(const ktree *tree, name_point p, uint32_t out[2]) {
    const bool vertex = name_is_vertex(p);
    uint32_t about[2] = {vertex ? tree->vertices.data[p.a] / 2 : p.a, p.b >= 0 ? (uint32_t)p.b : p.a};
    size_t count = 0;
    if (!name_exists(p) || p.b == NAME_LINE || (vertex && tree->vertices.data[p.a] == FROE_NONE)) return 0;
    for (int i = 0; i < (p.b >= 0 ? 2 : 1); i++)
        if (ktree_segment_at(tree, about[i])->stays) out[count++] = about[i];
    return count;
}

/* How the lines of a crossing turn; 0: it is none. */
static int turn_at(now_state *now, name_point p) {
    const now_claim turn = {p, {0, NAME_NONE}, 1};
    return name_is_crossing(p) ? now_holds(now, &turn) : 0;
}

/* The certificates about segments that stay, with how the lines of their crossings turn. */
static void find_renewed(froe_kinetic *k) {
    event_state *events = &k->events;
    uint32_t found[2];
    events->renewed.count = 0;
    for (uint32_t i = 0; i < k->certs.all.count && !k->call.stopped; i++) {
        const cert_record *c = k->certs.all.data + i;
        if (c->kind > CERT_TURN) continue;
        if (!staying_at(&k->tree, c->claim.p, found) && !staying_at(&k->tree, c->claim.q, found)) continue;
        const event_renewal renewal = {i, {turn_at(&k->now, c->claim.p), turn_at(&k->now, c->claim.q)}, 0};
        call_push(&k->call, &events->renewed, renewal);
        call_poll(&k->call);
    }
}

/* In the units of places in doubles; infinite where they are none. */
static double width_of(now_state *now, uint32_t segment) {
    const uint32_t *end = now->segments.data[segment].end;
    const now_spot a = now_vertex_spot(now, end[0]), b = now_vertex_spot(now, end[1]);
    const double width = fabs(a.x - b.x) + a.error + b.error;
    return width >= 0 ? width : (double)INFINITY;
}

/* A segment is to leave after all. */
static void leave_after_all(froe_kinetic *k, name_point p) {
    uint32_t found[2];
    for (size_t i = staying_at(&k->tree, p, found); i-- > 0;) {
        ktree_segment_at(&k->tree, found[i])->stays = false;
        k->events.ousted = fmax(k->events.ousted, width_of(&k->now, found[i]));
        renew_note_leaving(k, found[i], 1);
    }
}

void renew_check(froe_kinetic *k, int64_t tick) {
    event_state *events = &k->events;
    now_state *now = &k->now;
    size_t kept = 0;
    if (!events->staying.count || k->call.stopped) return;
    find_renewed(k);
    const int64_t before = now->tick;
    const bool lost = now->lost;
    now->tick = tick;
    for (size_t i = 0; i < events->renewed.count && !k->call.stopped; i++) {
        event_renewal *r = events->renewed.data + i;
        const now_claim claim = k->certs.all.data[r->cert].claim;
        if (straight_first_failure(now, &claim, &r->tick)) continue; /* it holds, and is about no crossing */
        const bool holds = now_holds(now, &claim) > 0 && !now->lost && turn_at(now, claim.p) == r->turn[0] &&
                           turn_at(now, claim.q) == r->turn[1];
        r->tick = holds ? now_first_failure(now, &claim) : tick;
        if (r->tick <= tick || now->lost) leave_after_all(k, claim.p), leave_after_all(k, claim.q);
        now->lost = lost;
        call_poll(&k->call);
    }
    now->tick = before;
    for (size_t i = 0; i < events->staying.count; i++)
        if (ktree_segment_at(&k->tree, events->staying.data[i])->stays)
            events->staying.data[kept++] = events->staying.data[i];
    events->staying.count = kept;
}

static int by_segment(const void *a, const void *b) {
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* Puts those that leave into the order of segments: by a look at all segments where they are many. */
static void sort_leaving(froe_kinetic *k) {
    enum { MANY = 32 }; /* one in so many */
    event_state *events = &k->events;
    uint32_t *leaving = events->leaving.data;
    const size_t count = events->leaving.count;
    if (!count || count < k->tree.segments.count / MANY) {
        base_sort(leaving, count, sizeof *leaving, by_segment);
        return;
    }
    if (!call_reserve(&k->call, &events->staying, count)) return;
    uint32_t *sorted = events->staying.data;
    for (size_t i = 0; i < count; i++) ktree_segment_at(&k->tree, leaving[i] / 2)->leaving = (uint32_t)i;
    for (size_t s = 0, at = 0; s < k->tree.segments.count; s++) {
        const uint32_t i = k->tree.segments.data[s].leaving;
        if (i < count && leaving[i] / 2 == s) sorted[at++] = leaving[i];
    }
    memcpy(leaving, sorted, count * sizeof *leaving);
}

void renew_apply(froe_kinetic *k) {
    event_state *events = &k->events;
    if (events->staying.count)
        for (size_t i = 0; i < events->renewed.count; i++)
            cert_set_tick(&k->certs, events->renewed.data[i].cert, events->renewed.data[i].tick);
    for (size_t i = 0; i < events->staying.count; i++)
        call_push(&k->call, &events->leaving, 2 * events->staying.data[i] + 1);
    events->staying.count = events->renewed.count = 0;
    sort_leaving(k);
}
