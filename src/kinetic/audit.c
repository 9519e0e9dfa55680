/* audit.c: checks a live partition and its certificates against those made from scratch. */
#include "base/floats.h"
#include "kinetic/live.h"
#include "support/fail.h"

static bool same_node(const froe_kinetic *k, uint32_t a, const froe_kinetic *l, uint32_t b) {
    const live_node *m = node_at(k, a), *n = node_at(l, b);
    if (m->segment != n->segment || m->wall[0] != n->wall[0] || m->wall[1] != n->wall[1] || m->cut != n->cut)
        return false;
    for (int i = 0; i < 4; i++)
        if (!m->child[i] != !n->child[i]) return false;
    return true;
}

/* Does a certificate state what the same one from scratch does? There may be more: they are implied. */
static bool same_cert(const froe_kinetic *k, uint32_t a, const froe_kinetic *fresh, uint32_t b) {
    if (a == CERT_NONE || b == CERT_NONE) return b == CERT_NONE;
    const now_claim c = live_claim_of(k, a), d = live_claim_of(fresh, b);
    return claim_is(&c, &d);
}

/* The certificates of two nodes that are the same. */
static bool same_certs(const froe_kinetic *k, uint32_t a, const froe_kinetic *fresh, uint32_t b) {
    const live_node *m = node_at(k, a), *n = node_at(fresh, b);
    for (int i = 0; i < 3; i++)
        if (!same_cert(k, m->cert[i], fresh, n->cert[i])) return false;
    for (int side = 0; side < 2; side++) {
        if (!is_end(m->wall[side])) continue;
        const uint32_t end = END_0 - m->wall[side];
        for (int i = 0; i < 2; i++)
            if (!same_cert(k, segment_at(k, m->segment)->end[end].cert[i], fresh,
                           segment_at(fresh, n->segment)->end[end].cert[i]))
                return false;
    }
    return true;
}

froe_status live_compare(const froe_kinetic *k, const froe_kinetic *fresh, bool certificates, uint32_t found[2]) {
    ARRAY(uint32_t) stack = {0};
    const uint32_t top[2] = {node_at(k, ROOT)->child[0], node_at(fresh, ROOT)->child[0]};
    found[0] = found[1] = !top[0] != !top[1] ? top[0] + top[1] : LEAF;
    bool room = array_reserve(&k->alloc, &stack, 2);
    if (room && top[0] && top[1]) stack.data[0] = top[0], stack.data[1] = top[1], stack.count = 2;
    while (room && stack.count && !found[0]) {
        uint32_t b = stack.data[--stack.count], a = stack.data[--stack.count];
        if (!same_node(k, a, fresh, b) || (certificates && !same_certs(k, a, fresh, b))) found[0] = a, found[1] = b;
        room = array_reserve(&k->alloc, &stack, 8);
        for (int i = 0; i < 4 && room && !found[0]; i++) {
            if (!node_at(k, a)->child[i]) continue;
            stack.data[stack.count++] = node_at(k, a)->child[i];
            stack.data[stack.count++] = node_at(fresh, b)->child[i];
        }
    }
    array_free(&k->alloc, &stack);
    return room ? FROE_OK : FROE_E_MEMORY;
}

static froe_status tell_difference(const froe_kinetic *k, const froe_kinetic *fresh, const uint32_t node[2],
                                   froe_diagnostic *diag) {
    const live_node *m = node_at(k, node[0]), *n = node_at(fresh, node[1]);
    if (same_node(k, node[0], fresh, node[1]))
        return support_fail_at(diag, FROE_E_INPUT, m->segment, FROE_NONE, FROE_NONE,
                               "a node of segment %u has not the certificates that it has from scratch", m->segment);
    unsigned has[2] = {0, 0};
    for (unsigned i = 0; i < 4; i++) has[0] |= (m->child[i] != LEAF) << i, has[1] |= (n->child[i] != LEAF) << i;
    return support_fail_at(
        diag, FROE_E_INPUT, m->segment, FROE_NONE, FROE_NONE,
        "a node of segment %u with walls %x %x and children %x is, from scratch, one of segment %u with "
        "walls %x %x and children %x",
        m->segment, m->wall[0], m->wall[1], has[0], n->segment, n->wall[0], n->wall[1], has[1]);
}

/* From the present on. */
static int64_t tick_from_scratch(froe_kinetic *k, uint32_t cert) {
    const live_cert *c = k->certs.data + cert;
    if (c->kind == CERT_PAIR) return live_pair_tick(k, k->pairs.data[c->owner].segment);
    (void)live_claim_of(k, cert); /* names the borders that it is about now */
    return now_first_failure(&k->now, &c->claim);
}

/* Does each certificate fail when the same one from scratch does? A late one would miss events. One
 * of an augmented partition may be early, as it may cover more than its claim; it is tested again then. */
static froe_status audit_ticks(froe_kinetic *k, froe_diagnostic *diag) {
    for (uint32_t i = 0; i < k->certs.count; i++) {
        const live_cert *c = k->certs.data + i;
        if (c->kind > CERT_PAIR) continue;
        if (!live_goes_on(k)) return live_fail(k, diag);
        const int64_t tick = tick_from_scratch(k, i);
        const bool may_be_early = k->options.augmented && c->kind <= CERT_RIGHT;
        if (c->tick > tick || (c->tick < tick && !may_be_early))
            return support_fail(diag, FROE_E_INPUT, "a certificate of kind %d fails at tick %lld, from scratch at %lld",
                                c->kind, (long long)c->tick, (long long)tick);
    }
    return FROE_OK;
}

static froe_status audit_certificates(froe_kinetic *k, froe_diagnostic *diag) {
    for (size_t i = 0; i < k->queue.count; i++) {
        const live_cert c = k->certs.data[k->queue.data[i].cert];
        if (c.place != i || c.tick != k->queue.data[i].tick || c.tick < k->queue.data[i ? (i - 1) / 4 : 0].tick)
            return support_fail(diag, FROE_E_INPUT, "the queue is not in order at place %zu", i);
        if (c.tick <= k->now.tick)
            return support_fail(diag, FROE_E_INPUT, "a certificate of kind %d is overdue", c.kind);
        if (c.kind <= CERT_TURN && now_holds(&k->now, &c.claim) < 0)
            return support_fail(diag, FROE_E_INPUT, "a certificate of kind %d does not hold", c.kind);
    }
    return audit_ticks(k, diag);
}

froe_status froe_kinetic_audit(froe_kinetic *k, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!k) return support_fail(diag, FROE_E_ARG, "froe_kinetic_audit: NULL");
    froe_kinetic *fresh = NULL;
    froe_status status = live_begin(k, diag);
    if (!status) status = live_copy(k, &fresh, diag);
    if (status) return status;
    uint32_t node[2];
    status = live_compare(k, fresh, true, node);
    if (status)
        support_fail_memory(diag);
    else if (node[0])
        status = tell_difference(k, fresh, node, diag);
    else if (k->node_count != fresh->node_count)
        status = support_fail(diag, FROE_E_INPUT, "%zu nodes, %zu from scratch", k->node_count, fresh->node_count);
    else
        status = audit_certificates(k, diag);
    froe_kinetic_free(fresh);
    return status;
}
