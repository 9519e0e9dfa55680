/* collinear.c: segments in one line, and the certificates of the order of their ends. */
#include "kinetic/certificate/collinear.h"
#include "kinetic/kinetic.h"

/* The next pair in a list of those of one segment: 2 pair + which of the two it is. */
static uint32_t *link_of(collinear_table *c, uint32_t entry) {
    return c->pairs.data[entry / 2].next + entry % 2;
}

int64_t collinear_tick(now_state *now, const uint32_t segment[2]) {
    const now_segment *s = now->segments.data + segment[0], *t = now->segments.data + segment[1];
    int64_t first = NOW_NEVER;
    for (int i = 0; i < 4; i++) {
        now_claim claim = {{s->end[i / 2], NAME_VERTEX}, {t->end[i % 2], NAME_VERTEX}, 0};
        const int order = now_compare(now, claim.p, claim.q);
        if (!order) continue; /* until a plan takes another piece */
        if (order > 0) claim = (now_claim){claim.q, claim.p, 0};
        const int64_t tick = now_first_failure(now, &claim);
        first = tick < first ? tick : first;
    }
    return first;
}

void collinear_watch(froe_kinetic *k, uint32_t s, uint32_t t) {
    collinear_table *c = &k->collinear;
    if (now_is_question(&k->now, t)) return;
    for (uint32_t e = c->first.data[s]; e != FROE_NONE; e = *link_of(c, e))
        if (c->pairs.data[e / 2].segment[1 - e % 2] == t) return;
    uint32_t pair = c->first_free;
    const uint32_t both[2] = {s, t};
    if (pair != FROE_NONE) {
        c->first_free = c->pairs.data[pair].next[0];
    } else {
        if (!call_reserve(&k->call, &c->pairs, 1)) return;
        pair = (uint32_t)c->pairs.count++;
    }
    collinear_pair *p = c->pairs.data + pair;
    c->count++;
    p->cert = cert_new(&k->certs, CERT_COLLINEAR, pair, collinear_tick(&k->now, both), NULL);
    for (uint32_t i = 0; i < 2; i++) {
        p->segment[i] = both[i];
        p->next[i] = c->first.data[both[i]];
        c->first.data[both[i]] = 2 * pair + i;
    }
}

void collinear_find_partners(froe_kinetic *k, uint32_t s) {
    collinear_table *c = &k->collinear;
    c->partners.count = 0;
    for (uint32_t e = c->first.data[s]; e != FROE_NONE; e = *link_of(c, e))
        call_push(&k->call, &c->partners, c->pairs.data[e / 2].segment[1 - e % 2]);
}

void collinear_forget(froe_kinetic *k, uint32_t s) {
    collinear_table *c = &k->collinear;
    while (c->first.data[s] != FROE_NONE) {
        const uint32_t pair = c->first.data[s] / 2;
        for (uint32_t i = 0; i < 2; i++) {
            uint32_t *at = c->first.data + c->pairs.data[pair].segment[i];
            while (*at != 2 * pair + i) at = link_of(c, *at);
            *at = *link_of(c, *at);
        }
        cert_forget(&k->certs, &c->pairs.data[pair].cert);
        c->pairs.data[pair].next[0] = c->first_free;
        c->first_free = pair;
        c->count--;
    }
}
