/* pass.c: a point passes a wall that belongs to another point, and nothing else happens.
 *
 *     _________________             Only two cells change, those on both sides of the wall at the height of the
 *        :   |     :                point: near, where the certificate was, and far. In one of them the segment s of
 *        :far|near :                the point comes to be, or ends, a little earlier, in the other a little later.
 *        :   | o---:-- s            Other segments that cross the wall there, the threads, do so before and after.
 *        :   |     :                A walk down along the wall lists them from below. Since that part of the cell is
 *     ___:__(q)____:___             thin, their order and heights alone determine its new tree (a treap).
 *
 * If there is another wall in a thin part, as of a vertex that has the same x for ever, it passes, too, and this case
 * is refused. The far cell is found by walking down on the other side of the wall, past all segments before s in
 * order. Each of these is on the way to the near cell, too, or ends before the wall. Segments after s are in the far
 * cell. Source: the shaves of the paper's section 2.3; that a thin part is a treap is not in the paper. */
#include "kinetic/live.h"
#include <string.h>

/* A place in the tree, which of the walls of its cell is passed, and the line that bounds the thin part there. */
typedef struct half {
    live_site site;
    int side;
} half;

typedef struct passing {
    half near, far;
    uint32_t node, segment; /* of s, in the near cell */
    uint32_t wall;          /* END_0, END_1, or the segment that it crosses at the point */
    bool grows;             /* it gets longer: the point goes to the far cell, and s comes after it from the near one */
    size_t thread;          /* how many on the list cross the wall in the far cell, from below */
    size_t below;           /* how many of these are below the point */
} passing;

/* ----------------------------------------------------------------- two cells -- */

/* On which side of a segment that comes to the wall is the way from the near cell up to the wall's owner? If that does
 * not know it, then it lies beyond the owner's segment, which ends at the wall, and is passed on the same side. */
static int way_past(const froe_kinetic *k, uint32_t near, uint32_t owner, uint32_t segment) {
    uint8_t slot = 0;
    for (uint32_t n = near; n != owner; n = node_at(k, n)->parent) {
        slot = live_slot_of(k, n);
        if (node_at(k, node_at(k, n)->parent)->segment == segment && slot >= UP) return slot;
    }
    return slot >= UP ? slot : -1;
}

/* From the place at `far` down along the wall. False: the tree there is not as described. */
static bool descend_to_half(const froe_kinetic *k, uint32_t near, uint32_t owner, half *far) {
    uint32_t segment = node_at(k, near)->segment;
    for (;;) {
        uint32_t x = node_at(k, far->site.parent)->child[far->site.slot];
        if (!x || node_at(k, x)->segment == segment || comes_before(k, segment, node_at(k, x)->segment)) return true;
        int way = far->side;
        if (node_at(k, x)->wall[far->side] == END_NONE) way = way_past(k, near, owner, node_at(k, x)->segment);
        if (way < 0) return false;
        far->site.parent = x;
        far->site.slot = (uint8_t)way;
    }
}

static uint32_t root_of(const froe_kinetic *k, const live_site *site) {
    return node_at(k, site->parent)->child[site->slot];
}

static void look_at(const froe_kinetic *k, live_site *site) {
    const uint32_t node = root_of(k, site);
    const live_cell cell = live_cell_of(k, site->parent);
    site->cell = live_child_cell(k, &cell, site->parent, site->slot);
    site->cut = node && node_at(k, node)->cut;
}

/* 1, -1: p is above, below q; 0: undecided. */
static int height_order(froe_kinetic *k, now_name p, now_name q) {
    now_spot a = now_spot_of(&k->now, p), b = now_spot_of(&k->now, q);
    double d = a.y - b.y, error = (a.error + b.error) * 2;
    return d > error ? 1 : d < -error ? -1 : 0;
}

/* The near cell, and which end of s passes which of its walls. False: not one end of s alone. */
static bool find_near(froe_kinetic *k, const live_item *item, passing *p) {
    p->node = k->certs.data[item->cert].owner;
    const live_node *n = node_at(k, p->node);
    const bool both = n->wall[LEFT] != END_NONE && n->wall[RIGHT] != END_NONE;
    if (item->kind == CERT_MIDDLE && both) return false;
    p->segment = n->segment;
    p->grows = item->kind != CERT_MIDDLE;
    int side = item->kind == CERT_LEFT || (!p->grows && n->wall[LEFT] == END_NONE) ? LEFT : RIGHT;
    p->wall = n->wall[p->grows ? side : 1 - side];
    p->near = (half){live_site_of(k, p->node), side};
    return name_is(p->near.site.cell.wall[side], side == LEFT ? item->claim.p : item->claim.q);
}

static bool find_far(froe_kinetic *k, now_name point, passing *p) {
    uint8_t slot;
    const int side = p->near.side;
    const uint32_t owner = live_wall_owner(k, p->node, side, &slot);
    const now_name wall = p->near.site.cell.wall[side];
    int order = owner ? height_order(k, point, wall) : 0;
    if (!order) return false;
    p->far.side = 1 - side;
    p->far.site.parent = owner;
    p->far.site.slot = (uint8_t)(slot >= UP ? side : order > 0 ? UP : DOWN);
    if (!descend_to_half(k, p->node, owner, &p->far)) return false;
    look_at(k, &p->far.site);
    if (!name_is(p->far.site.cell.wall[1 - side], wall)) return false;
    const uint32_t root = root_of(k, &p->far.site);
    const bool there = root && node_at(k, root)->segment == p->segment;
    if (there == p->grows || (there && node_at(k, root)->wall[1 - side] != END_NONE)) return false;
    const live_cell *near = &p->near.site.cell, *far = &p->far.site.cell;
    return is_end(p->wall) || (p->wall == near->top && near->top == far->top) ||
           (p->wall == near->bottom && near->bottom == far->bottom);
}

/* ------------------------------------------------------------------- threads -- */

/* Is a wall, if there is one, beyond the line that bounds the thin part of a half? */
static bool is_beyond(froe_kinetic *k, const half *h, now_name wall) {
    if (!name_exists(wall)) return true;
    int order = now_compare(&k->now, wall, (now_name){(uint32_t)(1 - h->side), NAME_LINE});
    return h->side == RIGHT ? order < 0 : order > 0;
}

static void push_half_visit(froe_kinetic *k, uint32_t node, unsigned back) {
    if (node && !array_push(&k->alloc, &k->order, 2 * node + back)) k->short_of_memory = true;
}

/* Lists the segments that cross a subtree of a half along the passed wall, from the bottom up, and stamps nodes at
 * that wall. False: something has a wall in the thin part. */
static bool walk_half(froe_kinetic *k, const half *h, uint32_t node) {
    k->order.count = 0;
    push_half_visit(k, node, 0);
    while (k->order.count && !k->short_of_memory) {
        const uint32_t top = k->order.data[--k->order.count], x = top / 2;
        live_node *n = node_at(k, x);
        if (top % 2) {
            live_list(k, n->segment);
            continue;
        }
        n->stamp = k->stamp;
        k->counts.nodes_touched++;
        const bool ends = n->wall[h->side] != END_NONE;
        if (!is_beyond(k, h, wall_name(k, n->segment, n->wall[ends ? h->side : 1 - h->side]))) return false;
        if (ends) {
            push_half_visit(k, n->child[h->side], 0);
            continue;
        }
        push_half_visit(k, n->child[UP], 0);
        push_half_visit(k, x, 1);
        push_half_visit(k, n->child[DOWN], 0);
    }
    return true;
}

/* Both children of a node that reaches the wall. */
static bool walk_past(froe_kinetic *k, const half *h, uint32_t node) {
    live_node *n = node_at(k, node);
    n->stamp = k->stamp;
    const uint32_t up = n->child[UP];
    return walk_half(k, h, n->child[DOWN]) && walk_half(k, h, up);
}

/* Lists the segments across the wall in the far cell, from below, and then the others in the near one. */
static bool list_threads(froe_kinetic *k, passing *p) {
    const uint32_t root = root_of(k, &p->far.site);
    const live_node *n = node_at(k, p->node), *r = node_at(k, root);
    const int side = p->near.side;
    live_new_list(k);
    bool thin = p->grows
                    ? walk_half(k, &p->far, root)
                    : is_beyond(k, &p->far, wall_name(k, p->segment, r->wall[side])) && walk_past(k, &p->far, root);
    p->thread = k->list.count;
    if (!thin) return false;
    if (!p->grows) return walk_half(k, &p->near, n->child[1 - side]);
    return is_beyond(k, &p->near, wall_name(k, p->segment, n->wall[1 - side])) && walk_past(k, &p->near, p->node);
}

/* -------------------------------------------------------------------- height -- */

/* Segments that end at the same vertex as s have no wall there, but move with it. Those that come from the wall cross
 * the thin part in the far cell from now on, the others no longer. */
enum { MOST_FAN = 8 };

/* Those that come from the wall, from below. -1: too many, or some in one line, or earlier than s. */
static int fan_of(froe_kinetic *k, const passing *p, uint32_t vertex, uint32_t fan[MOST_FAN]) {
    int count = 0;
    for (uint32_t e = k->vertices.data[vertex]; e != FROE_NONE; e = segment_at(k, e / 2)->end[e % 2].next) {
        const uint32_t s = e / 2, other = k->now.segments.data[s].end[1 - e % 2];
        if (!segment_at(k, s)->here) continue;
        if (count == MOST_FAN || comes_before(k, s, p->segment)) return -1;
        if ((uint32_t)now_end(&k->now, s, p->near.side) != e % 2) continue;
        int at = count++;
        for (; at; at--) {
            int side = now_side(&k->now, fan[at - 1], other);
            if (!side) return -1;
            if (side > 0) break;
            fan[at] = fan[at - 1];
        }
        fan[at] = s;
    }
    return count;
}

static void forget_those_at(froe_kinetic *k, passing *p, uint32_t vertex) {
    size_t kept = 0;
    for (size_t i = 0; i < p->thread; i++)
        if (!live_has_end(k, k->list.data[i], vertex)) k->list.data[kept++] = k->list.data[i];
    p->thread = kept;
}

/* How many of the thread are below the vertex. False: one goes through it. */
static bool find_height(froe_kinetic *k, passing *p, uint32_t vertex) {
    size_t low = 0, high = p->thread;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        int side = now_side(&k->now, k->list.data[middle], vertex);
        if (!side) return false;
        if (side > 0)
            low = middle + 1;
        else
            high = middle;
    }
    p->below = low;
    return true;
}

static void insert_fan(froe_kinetic *k, passing *p, const uint32_t *fan, int count) {
    size_t at = p->below;
    for (int i = 0; i < count; i++) {
        if (fan[i] == p->segment) {
            p->below = at;
            continue;
        }
        uint32_t *place = k->list.data + at;
        memmove(place + 1, place, (p->thread++ - at++) * sizeof *place);
        *place = fan[i];
    }
}

/* Makes the thread the segments that will cross the thin part of the far cell, without s. False: refused. */
static bool thread_anew(froe_kinetic *k, passing *p, now_name point) {
    if (!is_end(p->wall)) {
        p->below = p->wall == p->near.site.cell.top ? p->thread : 0;
        return true;
    }
    const uint32_t first = k->vertices.data[point.a];
    if (segment_at(k, first / 2)->end[first % 2].next == FROE_NONE) return find_height(k, p, point.a);
    uint32_t fan[MOST_FAN];
    int count = fan_of(k, p, point.a, fan);
    if (count < 0) return false;
    forget_those_at(k, p, point.a);
    if (!find_height(k, p, point.a)) return false;
    k->list.count = p->thread;
    if (array_reserve(&k->alloc, &k->list, MOST_FAN))
        insert_fan(k, p, fan, count);
    else
        k->short_of_memory = true;
    return !k->short_of_memory;
}

/* -------------------------------------------------------------------- change -- */

/* The tree of some that cross a cell from wall to wall, given from below: the first in order on top (Vuillemin 1980).
 */
static void plant(froe_kinetic *k, size_t first, size_t count, uint32_t parent, uint8_t slot) {
    static const uint32_t no_walls[2] = {END_NONE, END_NONE};
    k->order.count = 0; /* from the root, always upwards */
    for (const uint32_t *s = k->list.data + first; s < k->list.data + first + count; s++) {
        const uint32_t node = live_new_node(k, *s, no_walls);
        uint32_t below = LEAF;
        if (!node || !array_reserve(&k->alloc, &k->order, 1)) {
            k->short_of_memory = true;
            return;
        }
        for (; k->order.count; k->order.count--) {
            const uint32_t last = k->order.data[k->order.count - 1];
            if (comes_before(k, node_at(k, last)->segment, *s)) break;
            below = last;
        }
        live_attach(k, node, DOWN, below);
        if (k->order.count) live_attach(k, k->order.data[k->order.count - 1], UP, node);
        k->order.data[k->order.count++] = node;
    }
    k->counts.nodes_touched += count;
    live_attach(k, parent, slot, count ? k->order.data[0] : LEAF);
}

static void leave_near(froe_kinetic *k, const passing *p) {
    live_node *n = node_at(k, p->node);
    const uint8_t slot = (uint8_t)(p->grows ? p->near.side : 1 - p->near.side);
    const uint32_t behind = n->child[slot];
    n->child[slot] = LEAF;
    if (p->grows) {
        live_set_wall(k, p->node, slot, END_NONE);
        live_free_tree(k, behind);
    } else {
        live_attach(k, p->near.site.parent, p->near.site.slot, behind);
        live_free_tree(k, p->node);
    }
}

static void enter_far(froe_kinetic *k, const passing *p) {
    const uint32_t root = root_of(k, &p->far.site);
    const uint8_t slot = (uint8_t)(p->grows ? p->near.side : p->far.side);
    uint32_t node = root, wall[2] = {END_NONE, END_NONE};
    wall[slot] = p->wall;
    if (p->grows) {
        node = live_new_node(k, p->segment, wall);
        if (!node) return;
        live_attach(k, p->far.site.parent, p->far.site.slot, node);
        live_attach(k, node, slot, root);
        plant(k, 0, p->below, node, DOWN);
        plant(k, p->below, p->thread - p->below, node, UP);
    } else {
        live_note_half(k, node, 1 - slot);
        live_set_wall(k, node, slot, p->wall);
        plant(k, 0, p->thread, node, slot);
    }
    if (is_end(p->wall)) live_touch_end(k, 2 * p->segment + (END_0 - p->wall));
}

static bool has_strangers(froe_kinetic *k, const passing *p) {
    const live_cell *near = &p->near.site.cell, *far = &p->far.site.cell;
    const uint32_t border[4] = {near->top, near->bottom, far->top, far->bottom};
    bool found = live_find_strangers(k, border, 4);
    return live_find_strangers(k, k->list.data, k->list.count) || found;
}

live_outcome live_pass(froe_kinetic *k, const live_item *item) {
    passing p;
    if (!find_near(k, item, &p)) return LIVE_NOT_NARROW;
    const now_name point = wall_name(k, p.segment, p.wall);
    if (!find_far(k, point, &p)) return LIVE_NOT_NARROW;
    if (!is_beyond(k, &p.near, p.near.site.cell.wall[p.far.side]) ||
        !is_beyond(k, &p.far, p.far.site.cell.wall[p.near.side]))
        return LIVE_NOT_NARROW;
    k->stamp++;
    if (!list_threads(k, &p)) return LIVE_NOT_NARROW;
    if (k->short_of_memory) return LIVE_DONE;
    if (has_strangers(k, &p)) return LIVE_STRANGERS;
    if (!thread_anew(k, &p, point) || k->now.lost) return LIVE_NOT_NARROW;
    k->counts.surgeries++;
    leave_near(k, &p);
    enter_far(k, &p);
    if (k->short_of_memory) return LIVE_DONE;
    live_touch_wall(k, p.near.site.cell.wall[p.near.side]);
    live_certify(k, &p.near.site);
    live_certify(k, &p.far.site);
    live_certify_halves(k);
    return LIVE_DONE;
}
