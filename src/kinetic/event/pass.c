/* pass.c: a point passes a wall that belongs to another point, and nothing else happens. */
#include "kinetic/event/pass.h"
#include "kinetic/certificate/certify.h"
#include "kinetic/event/strip.h"
#include "kinetic/kinetic.h"
#include <string.h>

typedef struct passing {
    strip near, far;
    uint32_t node, segment; /* of s, in the near cell */
    uint32_t owner;         /* of the wall: the lowest node above both cells */
    uint32_t wall;          /* an end, or the segment that it crosses at the point */
    bool grows;             /* it gets longer: the point goes to the far cell, and s comes after it from the near one */
    bool above;             /* the point is above the one that the wall belongs to */
    size_t across;          /* how many on the list cross the wall in the far cell, from below */
    size_t below;           /* how many of these are below the point */
    size_t beside;          /* how many nodes with walls are next to the wall in the far cell */
} passing;

/* ----------------------------------------------------------------- two cells -- */

static uint32_t root_of(const ktree *tree, const ktree_site *site) {
    return ktree_node_at(tree, site->parent)->child[site->slot];
}

/* From the place at `far` down along the wall. False: the tree there is not as described. */
static bool descend_to_half(const ktree *tree, uint32_t near, uint32_t owner, strip *far) {
    const uint32_t segment = ktree_node_at(tree, near)->segment;
    for (;;) {
        const uint32_t x = root_of(tree, &far->site);
        if (!x || ktree_node_at(tree, x)->segment == segment) return true;
        const uint32_t other = ktree_node_at(tree, x)->segment;
        if (ktree_before(tree, segment, other)) return true;
        uint8_t way = (uint8_t)far->side;
        if (ktree_node_at(tree, x)->wall[far->side] == KTREE_NO_WALL) {
            /* On which side of that segment is the way from the near cell up to the wall's owner? If that does not
             * know it, then it lies beyond the owner's segment, which ends at the wall, and is passed alike. */
            bool known = false;
            way = 0;
            for (uint32_t n = near; n != owner && !known; n = ktree_node_at(tree, n)->parent) {
                way = ktree_slot_of(tree, n);
                known = ktree_node_at(tree, ktree_node_at(tree, n)->parent)->segment == other && way >= KTREE_UP;
            }
            if (way < KTREE_UP) return false;
        }
        far->site.parent = x;
        far->site.slot = way;
    }
}

/* The near cell, and which end of s passes which of its walls. False: not one end of s alone. */
static bool find_near(const froe_kinetic *k, const slab_item *item, passing *p) {
    p->node = k->certs.all.data[item->cert].owner;
    const ktree_node *n = ktree_node_at(&k->tree, p->node);
    const bool left = n->wall[KTREE_LEFT] != KTREE_NO_WALL, right = n->wall[KTREE_RIGHT] != KTREE_NO_WALL;
    if (item->kind == CERT_MIDDLE && left && right) return false;
    p->segment = n->segment;
    p->grows = item->kind != CERT_MIDDLE;
    int side = item->kind == CERT_LEFT || (!p->grows && !left) ? KTREE_LEFT : KTREE_RIGHT;
    p->wall = n->wall[p->grows ? side : 1 - side];
    p->near = (strip){ktree_site_of(&k->tree, p->node), side};
    return name_is(p->near.site.cell.wall[side], side == KTREE_LEFT ? item->claim.p : item->claim.q);
}

static bool find_far(ktree *tree, name_point point, passing *p) {
    uint8_t slot;
    const int side = p->near.side;
    const uint32_t owner = ktree_wall_owner(tree, p->node, side, &slot);
    const name_point wall = p->near.site.cell.wall[side];
    if (!owner) return false;
    p->owner = owner;
    const now_spot a = now_spot_of(tree->now, point), b = now_spot_of(tree->now, wall);
    const double d = a.y - b.y, error = (a.error + b.error) * 2;
    if (!(d > error) && !(d < -error)) return false; /* which one is higher is undecided */
    p->above = d > error;
    ktree_site *far = &p->far.site;
    p->far.side = 1 - side;
    far->parent = owner;
    far->slot = (uint8_t)(slot >= KTREE_UP ? side : d > error ? KTREE_UP : KTREE_DOWN);
    if (!descend_to_half(tree, p->node, owner, &p->far)) return false;
    const uint32_t root = root_of(tree, far);
    const ktree_cell above = ktree_cell_of(tree, far->parent);
    far->cell = ktree_child_cell(tree, &above, far->parent, far->slot);
    far->cut = root && ktree_node_at(tree, root)->cut;
    if (!name_is(far->cell.wall[1 - side], wall)) return false;
    const bool there = root && ktree_node_at(tree, root)->segment == p->segment;
    if (there == p->grows || (there && ktree_node_at(tree, root)->wall[1 - side] != KTREE_NO_WALL)) return false;
    const ktree_cell *near = &p->near.site.cell;
    return ktree_is_end(p->wall) || (p->wall == near->top && near->top == far->cell.top) ||
           (p->wall == near->bottom && near->bottom == far->cell.bottom);
}

/* --------------------------------------------------------- what crosses the wall -- */

enum { VISIT, LIST, LEAVE };

static void push_half_visit(froe_kinetic *k, uint32_t node, unsigned what) {
    if (!node) return;
    __builtin_prefetch(k->tree.nodes.data + node);
    call_push(&k->call, &k->surgery.scratch, 4 * node + what);
}

/* Lists the segments that cross a subtree of a half along the passed wall, from the bottom up, and stamps nodes at
 * that wall. Those with walls are in surgery.beside, children before parents. False: something has a wall in the thin
 * part. */
static bool walk_half(froe_kinetic *k, const strip *h, uint32_t node) {
    ktree *tree = &k->tree;
    k->surgery.scratch.count = 0;
    push_half_visit(k, node, VISIT);
    while (k->surgery.scratch.count && !k->call.stopped) {
        const uint32_t top = k->surgery.scratch.data[--k->surgery.scratch.count], x = top / 4;
        ktree_node *n = ktree_node_at(tree, x);
        if (top % 4) {
            if (top % 4 == LIST)
                ktree_list(tree, n->segment);
            else
                call_push(&k->call, &k->surgery.beside, x);
            continue;
        }
        const uint32_t *end = k->now.segments.data[n->segment].end;
        __builtin_prefetch(k->now.courses.data + end[0]);
        __builtin_prefetch(k->now.courses.data + end[1]);
        n->stamp = tree->stamp;
        k->counts.nodes_touched++;
        const bool ends = n->wall[h->side] != KTREE_NO_WALL;
        if (!strip_ends_before(&k->now, h, ktree_wall_name(tree, n->segment, n->wall[ends ? h->side : 1 - h->side])))
            return false;
        if (ends || n->wall[1 - h->side] != KTREE_NO_WALL) push_half_visit(k, x, LEAVE);
        if (ends) {
            push_half_visit(k, n->child[h->side], VISIT);
            continue;
        }
        push_half_visit(k, n->child[KTREE_UP], VISIT);
        push_half_visit(k, x, LIST);
        push_half_visit(k, n->child[KTREE_DOWN], VISIT);
    }
    return true;
}

/* Both children of a node that reaches the wall. */
static bool walk_past(froe_kinetic *k, const strip *h, uint32_t node) {
    ktree_node *n = ktree_node_at(&k->tree, node);
    n->stamp = k->tree.stamp;
    const uint32_t up = n->child[KTREE_UP];
    return walk_half(k, h, n->child[KTREE_DOWN]) && walk_half(k, h, up);
}

/* Lists the segments across the wall in the far cell, from below, and then the others in the near one. */
static bool list_crossing(froe_kinetic *k, passing *p) {
    ktree *tree = &k->tree;
    const uint32_t root = root_of(tree, &p->far.site);
    const ktree_node *n = ktree_node_at(tree, p->node), *r = ktree_node_at(tree, root);
    const int side = p->near.side;
    ktree_new_list(tree);
    k->surgery.beside.count = 0;
    bool thin = p->grows ? walk_half(k, &p->far, root)
                         : strip_ends_before(&k->now, &p->far, ktree_wall_name(tree, p->segment, r->wall[side])) &&
                               walk_past(k, &p->far, root);
    p->across = tree->list.count;
    p->beside = k->surgery.beside.count;
    if (!thin) return false;
    if (!p->grows) return walk_half(k, &p->near, n->child[1 - side]);
    return strip_ends_before(&k->now, &p->near, ktree_wall_name(tree, p->segment, n->wall[1 - side])) &&
           walk_past(k, &p->near, p->node);
}

/* -------------------------------------------------------------------- height -- */

/* Segments that end at the same vertex as s have no wall there, but move with it. Those that come from the wall cross
 * the thin part in the far cell from now on, the others no longer. */
enum { MOST_FAN = 8 };

/* Those that come from the wall, from below. -1: too many, or some in one line, or earlier than s. */
static int fan_of(ktree *tree, const passing *p, uint32_t vertex, uint32_t fan[MOST_FAN]) {
    int count = 0;
    for (uint32_t e = tree->vertices.data[vertex]; e != FROE_NONE; e = ktree_next_end(tree, e)) {
        const uint32_t s = e / 2, other = tree->now->segments.data[s].end[1 - e % 2];
        if (!ktree_segment_at(tree, s)->here) continue;
        if (count == MOST_FAN || ktree_before(tree, s, p->segment)) return -1;
        if ((uint32_t)now_end(tree->now, s, p->near.side) != e % 2) continue;
        int at = count++;
        for (; at; at--) {
            int side = now_side(tree->now, fan[at - 1], other);
            if (!side) return -1;
            if (side > 0) break;
            fan[at] = fan[at - 1];
        }
        fan[at] = s;
    }
    return count;
}

/* How many of those that cross the wall are below the vertex. False: one goes through it. */
static bool find_height(ktree *tree, passing *p, uint32_t vertex) {
    size_t low = 0, high = p->across;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        int side = now_side(tree->now, tree->list.data[middle], vertex);
        if (!side) return false;
        if (side > 0)
            low = middle + 1;
        else
            high = middle;
    }
    p->below = low;
    return true;
}

/* Makes the list that of the segments that will cross the thin part of the far cell, without s. False: refused. */
static bool list_crossing_after(ktree *tree, passing *p, name_point point) {
    if (!ktree_is_end(p->wall)) {
        p->below = p->wall == p->near.site.cell.top ? p->across : 0;
        return true;
    }
    if (ktree_next_end(tree, tree->vertices.data[point.a]) == FROE_NONE) return find_height(tree, p, point.a);
    uint32_t fan[MOST_FAN];
    size_t kept = 0;
    const int count = fan_of(tree, p, point.a, fan);
    if (count < 0) return false;
    for (size_t i = 0; i < p->across; i++) /* without those at the vertex */
        if (!now_has_end(tree->now, tree->list.data[i], point.a)) tree->list.data[kept++] = tree->list.data[i];
    p->across = kept;
    if (!find_height(tree, p, point.a)) return false;
    tree->list.count = p->across;
    if (!call_reserve(tree->call, &tree->list, MOST_FAN)) return false;
    size_t at = p->below;
    for (int i = 0; i < count; i++) {
        if (fan[i] == p->segment) {
            p->below = at;
            continue;
        }
        uint32_t *place = tree->list.data + at;
        memmove(place + 1, place, (p->across++ - at++) * sizeof *place);
        *place = fan[i];
    }
    return true;
}

/* -------------------------------------------------------------------- change -- */

/* The tree of some that cross a cell from wall to wall, given from below: the first in order on top (Vuillemin 1980).
 * It has no certificates, and so no stamp that would make certify_sites() look for some. */
static void plant(froe_kinetic *k, size_t first, size_t count, uint32_t parent, uint8_t slot) {
    static const uint32_t no_walls[2] = {KTREE_NO_WALL, KTREE_NO_WALL};
    ktree *tree = &k->tree;
    k->surgery.scratch.count = 0; /* from the root, always upwards */
    for (const uint32_t *s = tree->list.data + first; s < tree->list.data + first + count; s++) {
        const uint32_t node = ktree_new_node(tree, *s, no_walls);
        uint32_t below = KTREE_LEAF;
        if (!node || !call_reserve(&k->call, &k->surgery.scratch, 1)) return;
        ktree_node_at(tree, node)->stamp = tree->stamp - 1;
        uint32_t *path = k->surgery.scratch.data;
        for (; k->surgery.scratch.count; k->surgery.scratch.count--) {
            const uint32_t last = path[k->surgery.scratch.count - 1];
            if (ktree_before(tree, ktree_node_at(tree, last)->segment, *s)) break;
            below = last;
        }
        ktree_attach(tree, node, KTREE_DOWN, below);
        if (k->surgery.scratch.count) ktree_attach(tree, path[k->surgery.scratch.count - 1], KTREE_UP, node);
        path[k->surgery.scratch.count++] = node;
    }
    k->counts.nodes_touched += count;
    ktree_attach(tree, parent, slot, count ? k->surgery.scratch.data[0] : KTREE_LEAF);
}

/* Takes s, or its end, out of the near cell and puts it into the far one. */
static void move_segment(froe_kinetic *k, const passing *p) {
    ktree *tree = &k->tree;
    const uint8_t from = (uint8_t)(p->grows ? p->near.side : 1 - p->near.side);
    const uint32_t behind = ktree_node_at(tree, p->node)->child[from];
    ktree_node_at(tree, p->node)->child[from] = KTREE_LEAF;
    if (p->grows) {
        ktree_set_wall(tree, p->node, from, KTREE_NO_WALL);
        surgery_free_tree(k, behind);
    } else {
        ktree_attach(tree, p->near.site.parent, p->near.site.slot, behind);
        surgery_free_tree(k, p->node);
    }
    const uint32_t root = root_of(tree, &p->far.site);
    const uint8_t to = (uint8_t)(p->grows ? p->near.side : p->far.side);
    if (p->grows) {
        uint32_t wall[2] = {KTREE_NO_WALL, KTREE_NO_WALL};
        wall[to] = p->wall;
        const uint32_t node = ktree_new_node(tree, p->segment, wall);
        if (!node) return;
        ktree_attach(tree, p->far.site.parent, p->far.site.slot, node);
        ktree_attach(tree, node, to, root);
        plant(k, 0, p->below, node, KTREE_DOWN);
        plant(k, p->below, p->across - p->below, node, KTREE_UP);
    } else {
        turn_note_half(k, root, 1 - to);
        ktree_set_wall(tree, root, to, p->wall);
        plant(k, 0, p->across, root, to);
    }
    if (ktree_is_end(p->wall)) ktree_touch_end(tree, 2 * p->segment + (KTREE_END_0 - p->wall));
}

/* ---------------------------------------------------------------------- ends -- */

/* Is it an end of one segment alone? */
static bool is_single_end(const ktree *tree, name_point p) {
    const uint32_t end = name_is_vertex(p) ? tree->vertices.data[p.a] : FROE_NONE;
    return end != FROE_NONE && ktree_next_end(tree, end) == FROE_NONE;
}

/* What is next to an end by its certificates. False: they are to be made anew, or it is s itself, which goes. */
static bool recall_next(const froe_kinetic *k, uint32_t end, uint32_t segment, uint32_t next[2]) {
    for (int below = 0; below < 2; below++) {
        const uint32_t cert = k->certs.segments.data[end / 2].end[end % 2][below];
        const cert_record *c = cert == FROE_NONE ? NULL : k->certs.all.data + cert;
        if (c && (c->tick <= k->now.tick || c->next != FROE_NONE)) return false;
        next[below] = c ? c->claim.p.a : FROE_NONE;
        if (next[below] == segment) return false;
    }
    return true;
}

/* The end that the wall belongs to: s comes next to it if it comes between it and what is next to it. */
static void know_owner(froe_kinetic *k, const passing *p, name_point point, name_point wall) {
    cert_known *out = k->certs.known + k->certs.known_count;
    out->end = k->tree.vertices.data[wall.a];
    bool known = recall_next(k, out->end, p->segment, out->next);
    uint32_t *next = out->next + !p->above;
    if (known && p->grows) {
        const int side = *next == FROE_NONE ? 0 : now_side(&k->now, *next, point.a);
        if (*next == FROE_NONE || (side && (side > 0) != p->above)) {
            *next = p->segment;
            k->certs.known_count++;
            known = false;
        }
        known = known && side;
    }
    if (!known) ktree_touch_wall(&k->tree, wall);
}

/* What is next to both ends, where nothing else ends with them. Of s that is what is next to it on the list. False:
 * something else may. */
static bool know_neighbours(froe_kinetic *k, const passing *p, name_point point) {
    const ktree *tree = &k->tree;
    const ktree_cell *far = &p->far.site.cell;
    const name_point wall = p->near.site.cell.wall[p->near.side];
    const bool single = ktree_is_end(p->wall) && is_single_end(tree, point);
    if (single) {
        cert_known *out = k->certs.known + k->certs.known_count++;
        out->end = tree->vertices.data[point.a];
        out->next[0] = p->below < p->across ? tree->list.data[p->below] : far->top;
        out->next[1] = p->below ? tree->list.data[p->below - 1] : far->bottom;
    }
    if (single && is_single_end(tree, wall)) {
        know_owner(k, p, point, wall);
        return true;
    }
    ktree_touch_wall(&k->tree, wall);
    return false;
}

static void certify_both(froe_kinetic *k, const passing *p, name_point point) {
    const size_t far = p->beside, all = k->surgery.beside.count;
    const name_point wall = p->near.site.cell.wall[p->near.side];
    if (know_neighbours(k, p, point) && !k->tree.augmented) {
        const uint32_t *beside = k->surgery.beside.data;
        const int near = p->near.side, other = p->far.side;
        const certify_side both[2] = {{&p->near.site, near, wall, beside + far, all - far, p->grows ? near : -1},
                                      {&p->far.site, other, point, beside, far, p->grows ? near : other}};
        certify_passing(k, both, p->owner);
    } else {
        certify_sites(k, (const ktree_site *const[]){&p->near.site, &p->far.site}, 2);
    }
    k->certs.known_count = 0;
}

pass_outcome pass_wall(froe_kinetic *k, const slab_item *item) {
    ktree *tree = &k->tree;
    passing p;
    if (!find_near(k, item, &p)) return PASS_REFUSED;
    const name_point point = ktree_wall_name(tree, p.segment, p.wall);
    if (!find_far(tree, point, &p)) return PASS_REFUSED;
    const ktree_cell *near = &p.near.site.cell, *far = &p.far.site.cell;
    if (!strip_ends_before(&k->now, &p.near, near->wall[p.far.side]) ||
        !strip_ends_before(&k->now, &p.far, far->wall[p.near.side]))
        return PASS_REFUSED;
    if (now_is_in_space(&k->now)) return strip_pass(k, (strip[]){p.near, p.far}, point);
    surgery_begin(k);
    if (!list_crossing(k, &p)) return PASS_REFUSED;
    if (k->call.stopped) return PASS_DONE;
    const uint32_t border[4] = {near->top, near->bottom, far->top == near->top ? FROE_NONE : far->top,
                                far->bottom == near->bottom ? FROE_NONE : far->bottom};
    bool more = participants_add_near(k, border, 4);
    more = participants_add_near(k, tree->list.data, tree->list.count) || more;
    if (more) return PASS_NEIGHBOURS;
    if (!list_crossing_after(tree, &p, point) || k->now.lost) return PASS_REFUSED;
    k->counts.surgeries++;
    k->certs.forgets = !tree->augmented; /* there a tick may be that of a turn */
    move_segment(k, &p);
    if (!k->call.stopped) {
        certify_both(k, &p, point);
        turn_certify_halves(k);
    }
    k->certs.forgets = false;
    return PASS_DONE;
}
