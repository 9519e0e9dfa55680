/* queue.c: certificates, and which of them fails next: a heap of four children a node (Johnson 1975). */
#include "kinetic/live.h"

static void put_turn(froe_kinetic *k, size_t place, live_turn turn) {
    k->queue.data[place] = turn;
    k->certs.data[turn.cert].place = (uint32_t)place;
}

static void rise(froe_kinetic *k, size_t place) {
    const live_turn turn = k->queue.data[place];
    for (; place && turn.tick < k->queue.data[(place - 1) / 4].tick; place = (place - 1) / 4)
        put_turn(k, place, k->queue.data[(place - 1) / 4]);
    put_turn(k, place, turn);
}

static void sink(froe_kinetic *k, size_t place) {
    const live_turn turn = k->queue.data[place], *queue = k->queue.data;
    const size_t count = k->queue.count;
    for (size_t child = 4 * place + 1; child < count; child = 4 * place + 1) {
        const size_t end = child + 4 < count ? child + 4 : count;
        size_t best = child;
        while (++child < end)
            if (queue[child].tick < queue[best].tick) best = child;
        if (queue[best].tick >= turn.tick) break;
        put_turn(k, place, queue[best]);
        place = best;
    }
    put_turn(k, place, turn);
}

static void leave_queue(froe_kinetic *k, uint32_t cert) {
    const uint32_t place = k->certs.data[cert].place;
    if (place == CERT_NONE) return;
    const live_turn last = k->queue.data[--k->queue.count];
    k->certs.data[cert].place = CERT_NONE;
    if (last.cert == cert) return;
    put_turn(k, place, last);
    rise(k, place);
    sink(k, k->certs.data[last.cert].place);
}

void live_set_tick(froe_kinetic *k, uint32_t cert, int64_t tick) {
    live_cert *c = k->certs.data + cert;
    c->tick = tick;
    if (tick == NOW_NEVER) {
        leave_queue(k, cert);
        return;
    }
    if (c->place == CERT_NONE) c->place = (uint32_t)k->queue.count++; /* there is room: live_new_cert */
    k->queue.data[c->place] = (live_turn){tick, cert};
    rise(k, c->place);
    sink(k, c->place);
}

uint32_t live_new_cert(froe_kinetic *k, cert_kind kind, uint32_t owner, int64_t tick, const now_claim *claim) {
    static const now_claim nothing = {{0, NAME_NONE}, {0, NAME_NONE}, 0};
    uint32_t cert = k->free_cert;
    if (cert != CERT_NONE) {
        k->free_cert = k->certs.data[cert].next;
    } else {
        if (!array_reserve(&k->alloc, &k->queue, k->certs.count + 1 - k->queue.count) ||
            !array_push(&k->alloc, &k->certs, (live_cert){0})) {
            k->short_of_memory = true;
            return CERT_NONE;
        }
        cert = (uint32_t)(k->certs.count - 1);
    }
    k->certs.data[cert] = (live_cert){.place = CERT_NONE,
                                      .owner = owner,
                                      .next = CERT_NONE,
                                      .kind = kind,
                                      .claim = claim ? *claim : nothing,
                                      .covered = {END_NONE, END_NONE}};
    live_set_tick(k, cert, tick);
    return cert;
}

/* The slot for a pair of names, by a hash. Another pair may have overwritten it. */
static live_recent *recent_at(const froe_kinetic *k, const now_claim *c) {
    uint64_t hash = ((uint64_t)c->p.a << 32 | (uint32_t)c->p.b) * 0x9e3779b97f4a7c15u;
    hash = (hash ^ ((uint64_t)c->q.a << 32 | (uint32_t)c->q.b)) * 0xbf58476d1ce4e5b9u;
    return k->recent + (hash >> 32) % RECENT;
}

void live_drop_cert(froe_kinetic *k, uint32_t cert) {
    live_cert *c = k->certs.data + cert;
    leave_queue(k, cert);
    if (c->kind <= CERT_BELOW) *recent_at(k, &c->claim) = (live_recent){c->claim, k->stamp, c->tick};
    c->kind = CERT_FREE;
    c->next = k->free_cert;
    k->free_cert = cert;
}

int64_t live_recall(const froe_kinetic *k, const now_claim *claim) {
    const live_recent *r = recent_at(k, claim);
    bool known = r->stamp == k->stamp && claim_is(&r->claim, claim);
    return known && r->tick > k->now.tick ? r->tick : -1;
}

void live_due(froe_kinetic *k, int64_t tick) {
    k->order.count = 0;
    if (!array_reserve(&k->alloc, &k->order, k->queue.count)) {
        k->short_of_memory = true;
        return;
    }
    if (k->queue.count && k->queue.data[0].tick <= tick) k->order.data[k->order.count++] = k->queue.data[0].cert;
    for (size_t i = 0; i < k->order.count; i++) { /* breadth first: all above a due certificate are due */
        size_t child = 4 * (size_t)k->certs.data[k->order.data[i]].place + 1, end = child + 4;
        for (; child < end && child < k->queue.count; child++)
            if (k->queue.data[child].tick <= tick) k->order.data[k->order.count++] = k->queue.data[child].cert;
    }
}

int64_t live_next_tick(const froe_kinetic *k) {
    return k->queue.count ? k->queue.data[0].tick : NOW_NEVER;
}
