/* certify.c: what proves that a live partition is what it should be.
 *
 *        :  |  :                      regions   the walls left and right of a region keep their order. Only regions
 *     ___:__|__:___ above             without a wall inside have certificates: these imply the others
 *        :  o----             ends    an end with a wall is below the next segment above and above the next below
 *     ___:_____:___ below     turns   the left end of a segment is left of the right end
 *
 * As long as they all hold the partition is right, and when one fails it is repaired near that place. Source: the
 * paper's sections 2.2 and 2.3. That regions between a wall of the node and one of its cell need certificates, too,
 * is not in the paper. */
#include "kinetic/live.h"

int64_t live_fail_tick(froe_kinetic *k, const now_claim *claim) {
    int64_t tick = live_recall(k, claim);
    if (tick >= 0) return tick;
    k->counts.certificates_made++;
    return now_first_failure(&k->now, claim);
}

/* Makes the certificate at *cert say this, or nothing. */
static void set_cert(froe_kinetic *k, uint32_t *cert, cert_kind kind, uint32_t owner, const now_claim *claim) {
    if (*cert != CERT_NONE) {
        const live_cert *c = k->certs.data + *cert;
        if (claim && claim_is(&c->claim, claim) && c->tick > k->now.tick) return;
        live_drop_cert(k, *cert);
        *cert = CERT_NONE;
    }
    if (claim) *cert = live_new_cert(k, kind, owner, live_fail_tick(k, claim), claim);
}

now_claim live_claim_of(const froe_kinetic *k, uint32_t cert) {
    live_cert *c = k->certs.data + cert;
    now_claim claim = c->claim;
    if (c->kind <= CERT_RIGHT) (void)node_at(k, c->owner); /* which region is it? */
    if (live_covers_turns(c)) {
        const live_cell cell = live_cell_of(k, c->owner);
        now_name border[2];
        live_borders(k, c->owner, &cell, c->kind, border);
        claim = c->claim = (now_claim){border[LEFT], border[RIGHT], 0};
        live_name_along(k, &c->claim);
    } else if (claim.above == NOW_ALONG) {
        claim.above = 0;
        if (k->now.segments.data[now_shared(&k->now, claim.p, claim.q)].turned)
            claim = (now_claim){claim.q, claim.p, 0};
    }
    return claim;
}

void live_rearm(froe_kinetic *k, uint32_t cert) {
    const live_cert *c = k->certs.data + cert;
    k->certs.data[cert].covered[LEFT] = k->certs.data[cert].covered[RIGHT] = END_NONE;
    live_set_tick(k, cert, now_first_failure(&k->now, &c->claim));
    if (c->kind <= CERT_RIGHT && k->options.augmented) live_cover_turns(k, cert);
}

/* ----------------------------------------------------------------- regions -- */

static bool has_cut(const froe_kinetic *k, uint32_t node) {
    return node && node_at(k, node)->cut;
}

static void set_region(froe_kinetic *k, uint32_t node, cert_kind region, bool wanted, const live_cell *cell) {
    now_name border[2];
    live_borders(k, node, cell, region, border);
    now_claim claim = {border[LEFT], border[RIGHT], 0};
    uint32_t *cert = node_at(k, node)->cert + region;
    wanted = wanted && name_exists(claim.p) && name_exists(claim.q);
    if (wanted) live_name_along(k, &claim);
    set_cert(k, cert, region, node, wanted ? &claim : NULL);
    if (k->options.augmented && *cert != CERT_NONE) live_cover_turns(k, *cert);
}

void live_borders(const froe_kinetic *k, uint32_t node, const live_cell *cell, cert_kind region, now_name out[2]) {
    const live_node *n = node_at(k, node);
    const now_name own[2] = {wall_name(k, n->segment, n->wall[LEFT]), wall_name(k, n->segment, n->wall[RIGHT])};
    out[LEFT] = region == CERT_RIGHT ? own[RIGHT] : cell->wall[LEFT];
    out[RIGHT] = region == CERT_LEFT ? own[LEFT] : cell->wall[RIGHT];
    for (int side = 0; side < 2 && region == CERT_MIDDLE; side++)
        if (name_exists(own[side])) out[side] = own[side];
}

/* Does the middle lie between the two ends of the segment? Then it exists as long as the segment does. */
static bool is_whole(const froe_kinetic *k, const live_node *n) {
    return k->options.augmented && is_end(n->wall[LEFT]) && is_end(n->wall[RIGHT]);
}

static void certify_regions(froe_kinetic *k, uint32_t node, const live_cell *cell) {
    const live_node *n = node_at(k, node);
    const bool has[2] = {n->wall[LEFT] != END_NONE, n->wall[RIGHT] != END_NONE};
    bool clear[4];
    for (int i = 0; i < 4; i++) clear[i] = !has_cut(k, n->child[i]);
    set_region(k, node, CERT_LEFT, has[LEFT] && clear[LEFT], cell);
    set_region(k, node, CERT_RIGHT, has[RIGHT] && clear[RIGHT], cell);
    set_region(k, node, CERT_MIDDLE, (has[LEFT] || has[RIGHT]) && clear[UP] && clear[DOWN] && !is_whole(k, n), cell);
}

/* -------------------------------------------------------------------- ends -- */

/* The next segment above or below the vertex of a wall of the node: of those that cross it on the outer side of that
 * wall, as what ends on the wall ends at the vertex. */
static uint32_t next_segment(froe_kinetic *k, uint32_t node, const live_cell *cell, int side, bool above) {
    uint32_t best = above ? cell->top : cell->bottom;
    const live_node *n = node_at(k, node);
    uint32_t vertex = wall_name(k, n->segment, n->wall[side]).a;
    for (uint32_t x = n->child[side]; x;) {
        n = node_at(k, x);
        if (n->wall[1 - side] != END_NONE) { /* to the child next to the wall */
            x = n->child[1 - side];
            continue;
        }
        int where = now_side(&k->now, n->segment, vertex);
        if (!where) where = above ? 1 : -1; /* it ends at the vertex */
        if ((where < 0) == above) best = n->segment;
        x = n->child[where > 0 ? UP : DOWN];
    }
    return best;
}

static void certify_end(froe_kinetic *k, uint32_t node, const live_cell *cell, int side) {
    const live_node *n = node_at(k, node);
    if (!is_end(n->wall[side])) return;
    uint32_t segment = n->segment, which = END_0 - n->wall[side];
    if (segment_at(k, segment)->end[which].stamp != k->stamp) return;
    uint32_t vertex = k->now.segments.data[segment].end[which];
    segment_at(k, segment)->end[which].stamp = 0;
    for (int i = 0; i < 2; i++) {
        uint32_t next = next_segment(k, node, cell, side, i == 0);
        now_claim claim = {{next, NAME_SEGMENT}, {vertex, NAME_VERTEX}, i == 0 ? -1 : 1};
        set_cert(k, segment_at(k, segment)->end[which].cert + i, i == 0 ? CERT_ABOVE : CERT_BELOW, 2 * segment + which,
                 next == FROE_NONE ? NULL : &claim);
    }
}

static void forget_end(froe_kinetic *k, live_end *end) {
    for (int i = 0; i < 2; i++) {
        if (end->cert[i] != CERT_NONE) live_drop_cert(k, end->cert[i]);
        end->cert[i] = CERT_NONE;
    }
}

void live_forget_ends(froe_kinetic *k, uint32_t segment) {
    for (int i = 0; i < 2; i++) forget_end(k, segment_at(k, segment)->end + i);
}

/* Certifies the touched ends outside of the subtree, and those whose walls went away. */
static void certify_ends(froe_kinetic *k) {
    for (size_t i = 0; i < k->ends.count; i++) {
        uint32_t segment = k->ends.data[i] / 2, which = k->ends.data[i] % 2;
        live_end *end = segment_at(k, segment)->end + which;
        if (!end->node) {
            forget_end(k, end);
        } else if (end->stamp == k->stamp) {
            live_cell cell = live_cell_of(k, end->node);
            certify_end(k, end->node, &cell, node_at(k, end->node)->wall[LEFT] == END_0 - which ? LEFT : RIGHT);
        }
    }
    k->ends.count = 0;
}

/* -------------------------------------------------------------------- tree -- */

static bool find_cut(const froe_kinetic *k, uint32_t node) {
    const live_node *n = node_at(k, node);
    bool cut = n->wall[LEFT] != END_NONE || n->wall[RIGHT] != END_NONE;
    for (int i = 0; i < 4; i++) cut = cut || has_cut(k, n->child[i]);
    return cut;
}

static void visit_region(froe_kinetic *k, uint32_t node, const live_cell *cell) {
    live_visit v = {*cell, node, false};
    if (!array_push(&k->alloc, &k->visits, v)) k->short_of_memory = true;
}

/* All touched nodes of a subtree, children before parents. */
static void certify_touched(froe_kinetic *k, uint32_t root, live_cell cell) {
    k->visits.count = 0;
    visit_region(k, root, &cell);
    while (k->visits.count) {
        live_visit *top = k->visits.data + k->visits.count - 1;
        uint32_t node = top->node;
        cell = top->cell;
        if (top->back) {
            k->visits.count--;
            live_poll(k);
            node_at(k, node)->cut = find_cut(k, node);
            certify_regions(k, node, &cell);
            for (int side = 0; side < 2; side++) certify_end(k, node, &cell, side);
            continue;
        }
        top->back = true;
        for (int i = 0; i < 4; i++) {
            uint32_t child = node_at(k, node)->child[i];
            if (!child || node_at(k, child)->stamp != k->stamp) continue;
            live_cell inner = live_child_cell(k, &cell, node, i);
            visit_region(k, child, &inner);
        }
    }
}

live_site live_site_of(const froe_kinetic *k, uint32_t node) {
    const live_node *n = node_at(k, node);
    return (live_site){n->parent, live_slot_of(k, node), n->cut, live_cell_of(k, node)};
}

void live_certify(froe_kinetic *k, const live_site *site) {
    uint32_t root = node_at(k, site->parent)->child[site->slot];
    if (k->short_of_memory) return; /* parts may have no parent */
    if (root && node_at(k, root)->stamp == k->stamp) certify_touched(k, root, site->cell);
    bool changed = has_cut(k, root) != site->cut;
    for (uint32_t node = site->parent; changed && node != ROOT; node = node_at(k, node)->parent) {
        bool cut = find_cut(k, node);
        changed = cut != node_at(k, node)->cut;
        node_at(k, node)->cut = cut;
        live_cell cell = live_cell_of(k, node);
        certify_regions(k, node, &cell);
    }
    if (!k->short_of_memory) certify_ends(k);
}

/* ------------------------------------------------------------------- turns -- */

void live_forget_turn(froe_kinetic *k, uint32_t segment) {
    live_segment *s = segment_at(k, segment);
    if (s->turn != CERT_NONE) live_drop_cert(k, s->turn);
    s->turn = CERT_NONE;
}

void live_certify_turn(froe_kinetic *k, uint32_t segment) {
    now_segment *s = k->now.segments.data + segment;
    now_claim claim = {{s->end[0], NAME_VERTEX}, {s->end[1], NAME_VERTEX}, 0};
    s->turned = now_compare(&k->now, claim.p, claim.q) > 0;
    if (s->turned) claim = (now_claim){claim.q, claim.p, 0};
    live_forget_turn(k, segment);
    segment_at(k, segment)->turn = live_new_cert(k, CERT_TURN, segment, now_first_failure(&k->now, &claim), &claim);
}
