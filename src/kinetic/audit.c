/* audit.c: checks a partition in motion and its certificates against those made from scratch. */
#include "base/floats.h"
#include "kinetic/certificate/certify.h"
#include "kinetic/kinetic.h"
#include "support/fail.h"

static bool same_node(const ktree *tree, uint32_t a, const ktree *other, uint32_t b) {
    const ktree_node *m = ktree_node_at(tree, a), *n = ktree_node_at(other, b);
    if (m->segment != n->segment || m->wall[0] != n->wall[0] || m->wall[1] != n->wall[1] || m->cut != n->cut)
        return false;
    for (int i = 0; i < 4; i++)
        if (!m->child[i] != !n->child[i]) return false;
    return true;
}

/* Does a certificate state what the same one from scratch does? There may be more: they are implied. */
static bool same_cert(const froe_kinetic *k, uint32_t a, const froe_kinetic *fresh, uint32_t b) {
    if (a == FROE_NONE || b == FROE_NONE) return b == FROE_NONE;
    const now_claim c = certify_claim_of(k, a), d = certify_claim_of(fresh, b);
    return claim_is(&c, &d);
}

static bool list_has(const froe_kinetic *k, uint32_t list, const froe_kinetic *fresh, uint32_t wanted) {
    for (uint32_t i = list; i != FROE_NONE; i = k->certs.all.data[i].next)
        if (same_cert(k, i, fresh, wanted)) return true;
    return false;
}

/* The certificates of two nodes that are the same. */
static bool same_certs(const froe_kinetic *k, uint32_t a, const froe_kinetic *fresh, uint32_t b) {
    const ktree_node *m = ktree_node_at(&k->tree, a), *n = ktree_node_at(&fresh->tree, b);
    for (int i = 0; i < 3; i++)
        if (!same_cert(k, m->cert[i], fresh, n->cert[i])) return false;
    for (int side = 0; side < 2; side++) {
        if (!ktree_is_end(m->wall[side])) continue;
        const uint32_t end = KTREE_END_0 - m->wall[side];
        const uint32_t *c = k->certs.segments.data[m->segment].end[end];
        const uint32_t *d = fresh->certs.segments.data[n->segment].end[end];
        for (int i = 0; i < 2; i++)
            for (uint32_t wanted = d[i]; wanted != FROE_NONE; wanted = fresh->certs.all.data[wanted].next)
                if (!list_has(k, c[i], fresh, wanted)) return false;
    }
    return true;
}

froe_status kinetic_compare(const froe_kinetic *k, const froe_kinetic *fresh, bool certificates, uint32_t found[2]) {
    ARRAY(uint32_t) stack = {0};
    const uint32_t top[2] = {ktree_node_at(&k->tree, KTREE_ROOT)->child[0],
                             ktree_node_at(&fresh->tree, KTREE_ROOT)->child[0]};
    found[0] = found[1] = !top[0] != !top[1] ? top[0] + top[1] : KTREE_LEAF;
    bool room = array_reserve(&k->call.alloc, &stack, 2);
    if (room && top[0] && top[1]) stack.data[0] = top[0], stack.data[1] = top[1], stack.count = 2;
    while (room && stack.count && !found[0]) {
        uint32_t b = stack.data[--stack.count], a = stack.data[--stack.count];
        if (!same_node(&k->tree, a, &fresh->tree, b) || (certificates && !same_certs(k, a, fresh, b)))
            found[0] = a, found[1] = b;
        room = array_reserve(&k->call.alloc, &stack, 8);
        for (int i = 0; i < 4 && room && !found[0]; i++) {
            if (!ktree_node_at(&k->tree, a)->child[i]) continue;
            stack.data[stack.count++] = ktree_node_at(&k->tree, a)->child[i];
            stack.data[stack.count++] = ktree_node_at(&fresh->tree, b)->child[i];
        }
    }
    array_free(&k->call.alloc, &stack);
    return room ? FROE_OK : FROE_E_MEMORY;
}

static froe_status tell_difference(const froe_kinetic *k, const froe_kinetic *fresh, const uint32_t node[2],
                                   froe_diagnostic *diag) {
    const ktree_node *m = ktree_node_at(&k->tree, node[0]), *n = ktree_node_at(&fresh->tree, node[1]);
    if (same_node(&k->tree, node[0], &fresh->tree, node[1]))
        return support_fail_at(diag, FROE_E_INPUT, m->segment, FROE_NONE, FROE_NONE,
                               "A node of segment %u has not the certificates that it has from scratch.", m->segment);
    unsigned has[2] = {0, 0};
    for (unsigned i = 0; i < 4; i++)
        has[0] |= (m->child[i] != KTREE_LEAF) << i, has[1] |= (n->child[i] != KTREE_LEAF) << i;
    return support_fail_at(diag, FROE_E_INPUT, m->segment, FROE_NONE, FROE_NONE,
                           "A node of segment %u with walls %x %x and children %x is, from scratch, one of segment %u "
                           "with walls %x %x and children %x.",
                           m->segment, m->wall[0], m->wall[1], has[0], n->segment, n->wall[0], n->wall[1], has[1]);
}

/* Is the queue in order, does each certificate in it hold, and does each fail when the same one from scratch does? A
 * late one would miss events. One of an augmented partition may be early, as it may cover more than its claim; it is
 * tested again then. */
static froe_status audit_certificates(froe_kinetic *k, froe_diagnostic *diag) {
    const queue_heap *queue = &k->certs.queue;
    const queue_entry *entries = queue->entries.data;
    for (size_t i = 0; i < queue->entries.count; i++) {
        const uint32_t cert = entries[i].id;
        const cert_record *c = k->certs.all.data + cert;
        const int kind = certify_kind(&k->tree, &k->certs, cert);
        if (queue->places.data[cert] != i || c->tick != entries[i].tick || c->tick < entries[i ? (i - 1) / 4 : 0].tick)
            return support_fail(diag, FROE_E_INPUT, "The queue is not in order at place %zu.", i);
        if (c->tick <= k->now.tick)
            return support_fail(diag, FROE_E_INPUT, "A certificate of kind %d is overdue.", kind);
        if (kind <= CERT_FLOP && now_holds(&k->now, &c->claim) < 0)
            return support_fail(diag, FROE_E_INPUT, "A certificate of kind %d does not hold.", kind);
    }
    for (uint32_t i = 0; i < k->certs.all.count; i++) {
        const cert_record *c = k->certs.all.data + i;
        if (c->kind > CERT_COLLINEAR) continue;
        if (!call_goes_on(&k->call)) return call_fail(&k->call, diag);
        if (c->kind != CERT_COLLINEAR) (void)certify_claim_of(k, i); /* names the borders that it is about now */
        const int64_t tick = c->kind == CERT_COLLINEAR
                                 ? collinear_tick(&k->now, k->collinear.pairs.data[c->owner].segment)
                                 : now_first_failure(&k->now, &c->claim);
        const bool may_be_early = k->tree.augmented && c->kind <= CERT_RIGHT;
        if (c->tick > tick || (c->tick < tick && !may_be_early))
            return support_fail(diag, FROE_E_INPUT,
                                "A certificate of kind %d fails at tick %lld, and from scratch at tick %lld.",
                                (int)certify_kind(&k->tree, &k->certs, i), (long long)c->tick, (long long)tick);
    }
    return FROE_OK;
}

froe_status froe_kinetic_audit(froe_kinetic *k, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!k) return support_fail_null(diag, __func__);
    froe_kinetic *fresh = NULL;
    froe_status status = kinetic_begin(k, diag);
    if (!status) status = kinetic_copy(k, &fresh, diag);
    if (status) return status;
    uint32_t node[2];
    status = kinetic_compare(k, fresh, true, node);
    if (status)
        support_fail_memory(diag);
    else if (node[0])
        status = tell_difference(k, fresh, node, diag);
    else if (k->tree.node_count != fresh->tree.node_count)
        status = support_fail(diag, FROE_E_INPUT, "There are %zu nodes, and from scratch %zu.", k->tree.node_count,
                              fresh->tree.node_count);
    else
        status = audit_certificates(k, diag);
    froe_kinetic_free(fresh);
    return status;
}
