/* pairs.c: segments in one line, as cars in one lane. Where two of them overlap only the earlier in order is in the
 * tree. The tree does not show when an end of the other comes out, so the order of their ends has certificates. */
#include "kinetic/live.h"

/* The next pair in a list of those of one segment: 2 pair + which of the two it is. */
static uint32_t *link_of(froe_kinetic *k, uint32_t entry) {
    return k->pairs.data[entry / 2].next + entry % 2;
}

static bool is_watched(froe_kinetic *k, uint32_t s, uint32_t t) {
    for (uint32_t e = segment_at(k, s)->pairs; e != FROE_NONE; e = *link_of(k, e))
        if (k->pairs.data[e / 2].segment[1 - e % 2] == t) return true;
    return false;
}

static int64_t order_changes(froe_kinetic *k, uint32_t u, uint32_t v) {
    now_claim claim = {{u, NAME_VERTEX}, {v, NAME_VERTEX}, 0};
    int order = now_compare(&k->now, claim.p, claim.q);
    if (!order) return NOW_NEVER; /* until a plan takes another piece */
    if (order > 0) claim = (now_claim){claim.q, claim.p, 0};
    return now_first_failure(&k->now, &claim);
}

static uint32_t new_pair(froe_kinetic *k) {
    uint32_t pair = k->free_pair;
    if (pair != FROE_NONE) {
        k->free_pair = k->pairs.data[pair].next[0];
        return pair;
    }
    if (!array_push(&k->alloc, &k->pairs, (live_pair){{0}, {0}, 0})) {
        k->short_of_memory = true;
        return FROE_NONE;
    }
    return (uint32_t)(k->pairs.count - 1);
}

int64_t live_pair_tick(froe_kinetic *k, const uint32_t segment[2]) {
    const now_segment *s = k->now.segments.data + segment[0], *t = k->now.segments.data + segment[1];
    int64_t first = NOW_NEVER;
    for (int i = 0; i < 4; i++) {
        int64_t tick = order_changes(k, s->end[i / 2], t->end[i % 2]);
        first = tick < first ? tick : first;
    }
    return first;
}

void live_watch_pair(froe_kinetic *k, uint32_t s, uint32_t t) {
    if (now_is_question(&k->now, t) || is_watched(k, s, t)) return;
    uint32_t pair = new_pair(k), both[2] = {s, t};
    if (pair == FROE_NONE) return;
    uint32_t cert = live_new_cert(k, CERT_PAIR, pair, live_pair_tick(k, both), NULL);
    live_pair *p = k->pairs.data + pair;
    p->cert = cert;
    for (uint32_t i = 0; i < 2; i++) {
        p->segment[i] = both[i];
        p->next[i] = segment_at(k, both[i])->pairs;
        segment_at(k, both[i])->pairs = 2 * pair + i;
    }
}

void live_partners(froe_kinetic *k, uint32_t s) {
    k->order.count = 0;
    for (uint32_t e = segment_at(k, s)->pairs; e != FROE_NONE; e = *link_of(k, e))
        if (!array_push(&k->alloc, &k->order, k->pairs.data[e / 2].segment[1 - e % 2])) k->short_of_memory = true;
}

static void unlink_entry(froe_kinetic *k, uint32_t segment, uint32_t entry) {
    uint32_t *at = &segment_at(k, segment)->pairs;
    while (*at != entry) at = link_of(k, *at);
    *at = *link_of(k, entry);
}

void live_forget_pairs(froe_kinetic *k, uint32_t s) {
    while (segment_at(k, s)->pairs != FROE_NONE) {
        uint32_t pair = segment_at(k, s)->pairs / 2;
        for (uint32_t i = 0; i < 2; i++) unlink_entry(k, k->pairs.data[pair].segment[i], 2 * pair + i);
        if (k->pairs.data[pair].cert != CERT_NONE) live_drop_cert(k, k->pairs.data[pair].cert);
        k->pairs.data[pair].next[0] = k->free_pair;
        k->free_pair = pair;
    }
}
