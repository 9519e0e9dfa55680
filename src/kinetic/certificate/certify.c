/* certify.c: the certificates of regions, ends and turns. */
#include "kinetic/certificate/certify.h"
#include "kinetic/kinetic.h"

int64_t certify_fail_tick(froe_kinetic *k, const now_claim *claim) {
    int64_t tick = cert_recall(&k->certs, claim);
    if (tick >= 0) return tick;
    k->counts.certificates_made++;
    return now_first_failure(&k->now, claim);
}

/* Makes the certificate at *cert say this, or nothing. */
static void set_cert(froe_kinetic *k, uint32_t *cert, cert_kind kind, uint32_t owner, const now_claim *claim) {
    if (*cert != FROE_NONE) {
        const cert_record *c = k->certs.all.data + *cert;
        if (claim && claim_is(&c->claim, claim) && c->tick > k->now.tick) return;
        cert_drop(&k->certs, *cert);
        *cert = FROE_NONE;
    }
    if (claim) *cert = cert_new(&k->certs, kind, owner, certify_fail_tick(k, claim), claim);
}

cert_kind certify_kind(const ktree *tree, const cert_table *certs, uint32_t cert) {
    const cert_record *c = certs->all.data + cert;
    if (c->kind > CERT_RIGHT) return c->kind;
    const ktree_node *n = ktree_node_at(tree, c->owner);
    return n->cert[CERT_LEFT] == cert ? CERT_LEFT : n->cert[CERT_RIGHT] == cert ? CERT_RIGHT : CERT_MIDDLE;
}

now_claim certify_claim_of(const froe_kinetic *k, uint32_t cert) {
    cert_record *c = k->certs.all.data + cert;
    now_claim claim = c->claim;
    if (cert_covers_turns(c)) {
        const ktree_cell cell = ktree_cell_of(&k->tree, c->owner);
        name_point border[2];
        certify_borders(&k->tree, c->owner, &cell, certify_kind(&k->tree, &k->certs, cert), border);
        claim = c->claim = (now_claim){border[KTREE_LEFT], border[KTREE_RIGHT], 0};
        turn_name_along(&k->tree, &c->claim);
    } else if (claim.above == NOW_ALONG) {
        claim.above = 0;
        if (k->now.segments.data[now_shared(&k->now, claim.p, claim.q)].turned)
            claim = (now_claim){claim.q, claim.p, 0};
    }
    return claim;
}

void certify_again(froe_kinetic *k, uint32_t cert) {
    cert_record *c = k->certs.all.data + cert;
    c->covered[KTREE_LEFT] = c->covered[KTREE_RIGHT] = FROE_NONE;
    cert_set_tick(&k->certs, cert, now_first_failure(&k->now, &c->claim));
    if (c->kind <= CERT_RIGHT && k->tree.augmented) turn_cover(k, cert);
}

/* ----------------------------------------------------------------- regions -- */

/* No turn changes what this reads of a node. */
static bool has_cut(const ktree *tree, uint32_t node) {
    return node && tree->nodes.data[node].cut;
}

void certify_borders(const ktree *tree, uint32_t node, const ktree_cell *cell, cert_kind region, name_point out[2]) {
    const ktree_node *n = ktree_node_at(tree, node);
    for (int side = 0; side < 2; side++) {
        const bool outer = region == (side == KTREE_LEFT ? CERT_LEFT : CERT_RIGHT);
        const int own = region == CERT_MIDDLE ? side : 1 - side;
        if (!outer && n->wall[own] != KTREE_NO_WALL)
            out[side] = ktree_wall_name(tree, n->segment, n->wall[own]);
        else
            out[side] = cell ? cell->wall[side] : ktree_wall_beside(tree, node, side);
    }
}

static bool has_walls(const ktree_node *n) {
    return n->wall[KTREE_LEFT] != KTREE_NO_WALL || n->wall[KTREE_RIGHT] != KTREE_NO_WALL;
}

static bool has_certs(const ktree_node *n) {
    return (n->cert[CERT_LEFT] & n->cert[CERT_MIDDLE] & n->cert[CERT_RIGHT]) != FROE_NONE;
}

/* Is there such a region, without a wall inside? */
static bool has_region(const ktree *tree, const ktree_node *n, cert_kind region) {
    const uint32_t *wall = n->wall, *child = n->child;
    if (region == CERT_LEFT) return wall[KTREE_LEFT] != KTREE_NO_WALL && !has_cut(tree, child[KTREE_LEFT]);
    if (region == CERT_RIGHT) return wall[KTREE_RIGHT] != KTREE_NO_WALL && !has_cut(tree, child[KTREE_RIGHT]);
    if (!has_walls(n)) return false;
    /* the middle between the two ends of the segment exists as long as the segment does, in an augmented tree */
    if (tree->augmented && ktree_is_end(wall[KTREE_LEFT]) && ktree_is_end(wall[KTREE_RIGHT])) return false;
    return !has_cut(tree, child[KTREE_UP]) && !has_cut(tree, child[KTREE_DOWN]);
}

static bool is_due(const froe_kinetic *k, uint32_t cert) {
    return cert != FROE_NONE && k->certs.all.data[cert].tick <= k->now.tick;
}

enum { ALL_REGIONS = 7 };

/* The regions of a node, of which only those in `some`, as bits, and those that are due, can have changed. cell NULL:
 * its walls have stayed, and nothing but what is inside of its regions has changed. */
static void certify_regions(froe_kinetic *k, uint32_t node, const ktree_cell *cell, unsigned some) {
    static const cert_kind order[3] = {CERT_LEFT, CERT_RIGHT, CERT_MIDDLE};
    const ktree *tree = &k->tree;
    ktree_node *n = ktree_node_at(tree, node);
    if (!has_walls(n) && !has_certs(n)) return;
    for (int i = 0; i < 3; i++) {
        const cert_kind region = order[i];
        uint32_t *cert = n->cert + region;
        if (!(some >> region & 1) && !is_due(k, *cert)) continue;
        bool wanted = has_region(tree, n, region);
        if (!wanted && *cert == FROE_NONE) continue;
        if (wanted && !cell && !tree->augmented && *cert != FROE_NONE && k->certs.all.data[*cert].tick > k->now.tick)
            continue;
        now_claim claim = {{0, NAME_NONE}, {0, NAME_NONE}, 0};
        if (wanted) {
            name_point border[2];
            certify_borders(tree, node, cell, region, border);
            claim.p = border[KTREE_LEFT], claim.q = border[KTREE_RIGHT];
            wanted = name_exists(claim.p) && name_exists(claim.q);
        }
        if (wanted) turn_name_along(tree, &claim);
        set_cert(k, cert, region, node, wanted ? &claim : NULL);
        if (tree->augmented && *cert != FROE_NONE) turn_cover(k, *cert);
    }
}

/* -------------------------------------------------------------------- ends -- */

enum { BORDER = 0xfffffffe }; /* a segment: that of the cell */

static void push_layer(froe_kinetic *k, uint32_t node, uint32_t top, uint32_t bottom) {
    const uint32_t layer[3] = {node, top, bottom};
    for (int i = 0; i < 3; i++) call_push(&k->call, &k->tree.stack, layer[i]);
}

static void add_neighbour(froe_kinetic *k, bool below, uint32_t segment) {
    const uint32_t *known = k->certs.neighbours[below].data;
    if (segment == FROE_NONE) return;
    for (size_t i = 0; i < k->certs.neighbours[below].count; i++)
        if (known[i] == segment) return;
    call_push(&k->call, k->certs.neighbours + below, segment);
}

/* The next segments above and below the vertex of a wall of the node: of those that cross it on the outer side of that
 * wall, as what ends on the wall ends at the vertex. In space the wall goes through layers of surfaces, from the floor
 * of the cell to its ceiling, and each has its own: an edge that passes over the vertex changes the tree of its layer
 * (section 3.2 of the paper has the walls, but not these certificates). cell NULL: it is found if it is needed. */
static void find_neighbours(froe_kinetic *k, uint32_t node, const ktree_cell *cell, int side) {
    ktree *tree = &k->tree;
    const ktree_node *n = ktree_node_at(tree, node);
    const uint32_t vertex = ktree_wall_name(tree, n->segment, n->wall[side]).a;
    ktree_cell own;
    for (int i = 0; i < 2; i++) k->certs.neighbours[i].count = 0;
    tree->stack.count = 0;
    push_layer(k, n->child[side], BORDER, BORDER);
    while (tree->stack.count && !k->call.stopped) {
        const uint32_t *layer = tree->stack.data + (tree->stack.count -= 3);
        uint32_t x = layer[0], top = layer[1], bottom = layer[2];
        while (x) {
            n = ktree_node_at(tree, x);
            if (n->wall[1 - side] != KTREE_NO_WALL) { /* to the child next to the wall */
                x = n->child[1 - side];
                continue;
            }
            const bool surface = now_is_surface(tree->now, n->segment);
            const int where = surface ? 0 : now_side(tree->now, n->segment, vertex);
            if (!where) { /* both sides are next to the vertex; of an edge that ends at it, one above and one below */
                push_layer(k, n->child[KTREE_UP], top, surface ? bottom : FROE_NONE);
                if (!surface) top = FROE_NONE;
            } else {
                *(where < 0 ? &top : &bottom) = n->segment;
            }
            x = n->child[where > 0 ? KTREE_UP : KTREE_DOWN];
        }
        if (top == BORDER || bottom == BORDER) cell = cell ? cell : (own = ktree_cell_of(tree, node), &own);
        add_neighbour(k, false, top == BORDER ? cell->top : top);
        add_neighbour(k, true, bottom == BORDER ? cell->bottom : bottom);
    }
}

/* Makes a list that of the certificates about a vertex and all segments of certs.neighbours[below]. */
static void set_list(froe_kinetic *k, uint32_t *list, uint32_t owner, uint32_t vertex, bool below) {
    cert_table *certs = &k->certs;
    uint32_t *wanted = certs->neighbours[below].data;
    const size_t count = certs->neighbours[below].count;
    for (uint32_t *at = list; *at != FROE_NONE;) {
        cert_record *c = certs->all.data + *at;
        size_t i = 0;
        while (i < count && wanted[i] != c->claim.p.a) i++;
        if (i < count && c->tick > k->now.tick) {
            wanted[i] = FROE_NONE;
            at = &c->next;
        } else {
            const uint32_t cert = *at;
            *at = c->next;
            cert_drop(certs, cert);
        }
    }
    for (size_t i = 0; i < count; i++) {
        const now_claim claim = {{wanted[i], NAME_SEGMENT}, {vertex, NAME_VERTEX}, below ? 1 : -1};
        if (wanted[i] == FROE_NONE) continue;
        const cert_kind kind = below ? CERT_BELOW : CERT_ABOVE;
        const uint32_t cert = cert_new(certs, kind, owner, certify_fail_tick(k, &claim), &claim);
        if (cert == FROE_NONE) return;
        certs->all.data[cert].next = *list;
        *list = cert;
    }
}

/* False: the surgery does not know them. */
static bool recall_neighbours(froe_kinetic *k, uint32_t end) {
    const cert_table *certs = &k->certs;
    for (unsigned i = 0; i < certs->known_count; i++) {
        if (certs->known[i].end != end) continue;
        for (int below = 0; below < 2; below++) {
            k->certs.neighbours[below].count = 0;
            add_neighbour(k, below, certs->known[i].next[below]);
        }
        return true;
    }
    return false;
}

/* REQUIRES: the wall is that of an end. */
static void certify_end(froe_kinetic *k, uint32_t node, const ktree_cell *cell, int side) {
    const ktree_node *n = ktree_node_at(&k->tree, node);
    const uint32_t segment = n->segment, which = KTREE_END_0 - n->wall[side];
    ktree_end *end = ktree_segment_at(&k->tree, segment)->end + which;
    if (end->stamp != k->tree.stamp) return;
    end->stamp = 0;
    if (!recall_neighbours(k, 2 * segment + which)) find_neighbours(k, node, cell, side);
    for (int below = 0; below < 2; below++)
        set_list(k, k->certs.segments.data[segment].end[which] + below, 2 * segment + which,
                 k->now.segments.data[segment].end[which], below);
}

/* -------------------------------------------------------------------- tree -- */

static bool find_cut(const ktree *tree, uint32_t node) {
    const ktree_node *n = ktree_node_at(tree, node);
    bool cut = has_walls(n);
    for (int i = 0; i < 4 && !cut; i++) cut = has_cut(tree, n->child[i]);
    return cut;
}

/* Puts the touched children of a node on the list of visits. False: there are none. */
static bool push_touched(ktree *tree, uint32_t node, const ktree_cell *cell) {
    const size_t before = tree->visits.count;
    for (int i = 0; i < 4; i++) {
        const uint32_t child = ktree_node_at(tree, node)->child[i];
        if (!child || tree->nodes.data[child].stamp != tree->stamp) continue;
        const ktree_cell inner = ktree_child_cell(tree, cell, node, i);
        ktree_push_visit(tree, child, &inner, false);
    }
    return tree->visits.count > before;
}

/* All touched nodes of a subtree, children before parents. */
static void certify_touched(froe_kinetic *k, uint32_t root, ktree_cell cell) {
    ktree *tree = &k->tree;
    tree->visits.count = 0;
    ktree_push_visit(tree, root, &cell, false);
    while (tree->visits.count) {
        ktree_visit *top = tree->visits.data + tree->visits.count - 1;
        const uint32_t node = top->node;
        const bool back = top->back;
        cell = top->cell;
        top->back = true;
        if (!back && push_touched(tree, node, &cell)) continue;
        tree->visits.count--;
        call_poll(&k->call);
        const ktree_node *n = ktree_node_at(tree, node);
        ktree_node_at(tree, node)->cut = find_cut(tree, node);
        if (!has_walls(n) && !has_certs(n)) continue;
        certify_regions(k, node, &cell, ALL_REGIONS);
        for (int side = 0; side < 2; side++)
            if (ktree_is_end(ktree_node_at(tree, node)->wall[side])) certify_end(k, node, &cell, side);
    }
}

/* The region of a node that has a child in it, as a bit. */
static unsigned region_of_slot(uint8_t slot) {
    return 1u << (slot == KTREE_LEFT ? CERT_LEFT : slot == KTREE_RIGHT ? CERT_RIGHT : CERT_MIDDLE);
}

/* The regions of the nodes above a subtree, as far as these tell whether there is a wall in it. Nodes above `common`
 * and below have changed in the subtree alone; KTREE_LEAF: there may be more. */
static void certify_above(froe_kinetic *k, const ktree_site *site, uint32_t common) {
    ktree *tree = &k->tree;
    uint8_t slot = site->slot;
    bool changed = has_cut(tree, ktree_node_at(tree, site->parent)->child[slot]) != site->cut;
    for (uint32_t n = site->parent; changed && n != KTREE_ROOT; n = ktree_node_at(tree, n)->parent) {
        bool cut = find_cut(tree, n);
        changed = cut != ktree_node_at(tree, n)->cut;
        ktree_node_at(tree, n)->cut = cut;
        certify_regions(k, n, NULL, !common || n == common ? ALL_REGIONS : region_of_slot(slot));
        slot = ktree_slot_of(tree, n);
    }
}

/* Ends that were touched, outside of the subtrees, and those without a wall. */
static void certify_touched_ends(froe_kinetic *k) {
    ktree *tree = &k->tree;
    for (size_t i = 0; i < tree->touched.count; i++) {
        uint32_t segment = tree->touched.data[i] / 2, which = tree->touched.data[i] % 2;
        const ktree_end *end = ktree_segment_at(tree, segment)->end + which;
        if (!end->node) {
            for (int above = 0; above < 2; above++)
                cert_forget(&k->certs, k->certs.segments.data[segment].end[which] + above);
        } else if (end->stamp == tree->stamp) {
            const bool left = ktree_node_at(tree, end->node)->wall[KTREE_LEFT] == KTREE_END_0 - which;
            certify_end(k, end->node, NULL, left ? KTREE_LEFT : KTREE_RIGHT);
        }
    }
    tree->touched.count = 0;
}

void certify_sites(froe_kinetic *k, const ktree_site *const sites[], int count) {
    ktree *tree = &k->tree;
    if (k->call.stopped) return; /* parts may have no parent */
    for (int i = 0; i < count; i++) {
        const uint32_t root = ktree_node_at(tree, sites[i]->parent)->child[sites[i]->slot];
        if (root && ktree_node_at(tree, root)->stamp == tree->stamp) certify_touched(k, root, sites[i]->cell);
    }
    for (int i = 0; i < count; i++) certify_above(k, sites[i], KTREE_LEAF); /* a node may be above several */
    if (!k->call.stopped) certify_touched_ends(k);
}

void certify_site(froe_kinetic *k, const ktree_site *site) {
    certify_sites(k, &site, 1);
}

/* ---------------------------------------------------------------- passings -- */

/* The region between a node and the wall beside it, which has become another one. */
static void certify_beside(froe_kinetic *k, uint32_t node, int side, name_point wall) {
    const ktree *tree = &k->tree;
    ktree_node *n = ktree_node_at(tree, node);
    const bool ends = n->wall[side] != KTREE_NO_WALL;
    const cert_kind region = !ends ? CERT_MIDDLE : side == KTREE_LEFT ? CERT_LEFT : CERT_RIGHT;
    for (int i = 0; i < 3; i++)
        if (i != (int)region && is_due(k, n->cert[i])) { /* in the usual order */
            const ktree_cell cell = ktree_cell_of(tree, node);
            certify_regions(k, node, &cell, ALL_REGIONS);
            return;
        }
    now_claim claim = {wall, wall, 0};
    *(side == KTREE_LEFT ? &claim.q : &claim.p) = ktree_wall_name(tree, n->segment, n->wall[ends ? side : 1 - side]);
    if (has_region(tree, n, region))
        set_cert(k, n->cert + region, region, node, &claim);
    else if (n->cert[region] != FROE_NONE)
        set_cert(k, n->cert + region, region, node, NULL);
}

void certify_passing(froe_kinetic *k, const certify_side both[2], uint32_t common) {
    ktree *tree = &k->tree;
    for (const certify_side *b = both; b < both + 2; b++) {
        for (size_t i = 0; i < b->count; i++) certify_beside(k, b->nodes[i], b->side, b->wall);
        if (b->own < 0) continue;
        const uint32_t node = ktree_node_at(tree, b->site->parent)->child[b->site->slot];
        const ktree_node *n = ktree_node_at(tree, node);
        tree->nodes.data[node].cut = find_cut(tree, node);
        certify_regions(k, node, &b->site->cell, region_of_slot((uint8_t)b->own) | 1u << CERT_MIDDLE);
        if (ktree_is_end(n->wall[b->own])) certify_end(k, node, &b->site->cell, b->own);
    }
    call_poll(&k->call);
    for (int i = 0; i < 2; i++) certify_above(k, both[i].site, common);
    if (!k->call.stopped) certify_touched_ends(k);
}

/* --------------------------------------------------------- turns and flops -- */

void certify_turn(froe_kinetic *k, uint32_t segment) {
    now_segment *s = k->now.segments.data + segment;
    now_claim claim = {{s->end[0], NAME_VERTEX}, {s->end[1], NAME_VERTEX}, 0};
    uint32_t *cert = &k->certs.segments.data[segment].turn;
    s->turned = now_compare(&k->now, claim.p, claim.q) > 0;
    if (s->turned) claim = (now_claim){claim.q, claim.p, 0};
    cert_forget(&k->certs, cert);
    *cert = cert_new(&k->certs, CERT_TURN, segment, now_first_failure(&k->now, &claim), &claim);
}

/* A surface is a segment from its first corner to the second that never turns, so a claim about its third corner is
 * about its area. */
void certify_flop(froe_kinetic *k, uint32_t surface) {
    const uint32_t third = now_face_of(&k->now, surface)->vertex[2];
    const int side = now_side(&k->now, surface, third);
    const now_claim claim = {{surface, NAME_SEGMENT}, {third, NAME_VERTEX}, side < 0 ? -1 : 1};
    uint32_t *cert = &k->certs.segments.data[surface].turn;
    cert_forget(&k->certs, cert);
    *cert = cert_new(&k->certs, CERT_FLOP, surface, now_first_failure(&k->now, &claim), &claim);
}
