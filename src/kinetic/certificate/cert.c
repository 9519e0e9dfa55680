/* cert.c: certificates, each a claim that holds until a tick, in a queue by that tick. */
#include "kinetic/certificate/cert.h"

enum { RECENT = 1 << 10 };

froe_status cert_table_new(kinetic_call *call, const now_state *now, cert_table *out) {
    *out = (cert_table){.call = call, .now = now, .first_free = FROE_NONE};
    out->recent = support_calloc(&call->alloc, RECENT, sizeof *out->recent);
    return out->recent ? FROE_OK : FROE_E_MEMORY;
}

void cert_table_free(cert_table *certs) {
    const froe_allocator *alloc = &certs->call->alloc;
    array_free(alloc, &certs->all);
    queue_free(alloc, &certs->queue);
    array_free(alloc, &certs->segments);
    array_free(alloc, &certs->courses);
    for (int i = 0; i < 2; i++) array_free(alloc, certs->neighbours + i);
    if (certs->recent) support_free(alloc, certs->recent, RECENT * sizeof *certs->recent);
}

void cert_set_tick(cert_table *certs, uint32_t cert, int64_t tick) {
    certs->all.data[cert].tick = tick;
    if (tick == NOW_NEVER)
        queue_remove(&certs->queue, cert);
    else
        queue_set(&certs->queue, cert, tick);
}

uint32_t cert_new(cert_table *certs, cert_kind kind, uint32_t owner, int64_t tick, const now_claim *claim) {
    static const now_claim nothing = {{0, NAME_NONE}, {0, NAME_NONE}, 0};
    uint32_t cert = certs->first_free;
    if (cert != FROE_NONE) {
        certs->first_free = certs->all.data[cert].next;
    } else {
        const froe_allocator *alloc = &certs->call->alloc;
        if (!queue_reserve(alloc, &certs->queue, certs->all.count + 1) ||
            !array_push(alloc, &certs->all, (cert_record){0})) {
            call_stop(certs->call);
            return FROE_NONE;
        }
        cert = (uint32_t)(certs->all.count - 1);
    }
    certs->all.data[cert] = (cert_record){.owner = owner,
                                          .next = FROE_NONE,
                                          .kind = kind,
                                          .claim = claim ? *claim : nothing,
                                          .covered = {FROE_NONE, FROE_NONE},
                                          .tick = tick};
    if (tick != NOW_NEVER) queue_set(&certs->queue, cert, tick);
    return cert;
}

/* The slot for a pair of names, by a hash. Another pair may have overwritten it. */
static cert_recent *recent_at(const cert_table *certs, const now_claim *c) {
    uint64_t hash = ((uint64_t)c->p.a << 32 | (uint32_t)c->p.b) * 0x9e3779b97f4a7c15u;
    hash = (hash ^ ((uint64_t)c->q.a << 32 | (uint32_t)c->q.b)) * 0xbf58476d1ce4e5b9u;
    return certs->recent + (hash >> 32) % RECENT;
}

void cert_drop(cert_table *certs, uint32_t cert) {
    cert_record *c = certs->all.data + cert;
    queue_remove(&certs->queue, cert);
    if (c->kind <= CERT_BELOW && !certs->forgets)
        *recent_at(certs, &c->claim) = (cert_recent){c->claim, certs->stamp, c->tick};
    c->kind = CERT_FREE;
    c->next = certs->first_free;
    certs->first_free = cert;
}

void cert_forget(cert_table *certs, uint32_t *cert) {
    while (*cert != FROE_NONE) {
        const uint32_t next = certs->all.data[*cert].next;
        cert_drop(certs, *cert);
        *cert = next;
    }
}

int64_t cert_recall(const cert_table *certs, const now_claim *claim) {
    if (certs->forgets) return -1;
    const cert_recent *r = recent_at(certs, claim);
    bool known = r->stamp == certs->stamp && claim_is(&r->claim, claim);
    return known && r->tick > certs->now->tick ? r->tick : -1;
}

void cert_find_due(cert_table *certs, int64_t tick) {
    if (!queue_find_due(&certs->call->alloc, &certs->queue, tick)) call_stop(certs->call);
}

int64_t cert_next_tick(const cert_table *certs) {
    return certs->queue.entries.count ? certs->queue.entries.data[0].tick : NOW_NEVER;
}
