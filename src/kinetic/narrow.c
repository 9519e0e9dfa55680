/* narrow.c: a point passes a wall that belongs to somebody else, and nothing else happens.
 *
 *     _________________             Only two cells change, those on both sides of the wall at the height of the
 *        :   |     :                point: near, where the certificate was, and far. Each has a thin part cut off at
 *        :far|near :                the wall, which is made anew. The wall itself stays; nothing above or below the two
 *        :   | o---:-- s            cells is touched, and that is what makes this cheaper than a slab of the cell
 *        :   |     :                that has the wall: the paper's bound counts the thread of the point alone.
 *     ___:__(q)____:___
 *
 * If there is another wall in a thin part, as of a vertex that has the same x for ever, it passes, too, and this is
 * not for here. The far cell is found by going down on the other side of the wall, past what comes before s in order:
 * that is cut by segments that the way to the near cell knows, too, or ends before the wall. What comes later than s is
 * in the far cell. Source: the shaves of the paper's section 2.3, made by cut, growth and join. */
#include "kinetic/live.h"

/* A place in the tree, and which of the walls of its cell is passed. */
typedef struct half {
    live_site site;
    int side;
} half;

/* The ancestor that gives a node's cell its wall on a side, and below which child of it the node is. */
static uint32_t wall_owner(const froe_kinetic *k, uint32_t node, int side, uint8_t *slot) {
    for (uint32_t n = node;; n = node_at(k, n)->parent) {
        uint32_t above = node_at(k, n)->parent;
        *slot = node_at(k, n)->slot;
        if (above == ROOT) return LEAF;
        if (*slot == 1 - side || (*slot >= UP && node_at(k, above)->wall[side] != END_NONE)) return above;
    }
}

/* On which side of a segment that comes to the wall is the way from the near cell up to the wall's owner? If that does
 * not know it, then it lies beyond the owner's segment, which ends at the wall, and is passed on the same side. */
static int way_past(const froe_kinetic *k, uint32_t near, uint32_t owner, uint32_t segment) {
    uint8_t slot = 0;
    for (uint32_t n = near; n != owner; n = node_at(k, n)->parent) {
        slot = node_at(k, n)->slot;
        if (node_at(k, node_at(k, n)->parent)->segment == segment && slot >= UP) return slot;
    }
    return slot >= UP ? slot : -1;
}

/* From the place at `far` down along the wall. False: not as it should be. */
static bool descend(const froe_kinetic *k, uint32_t near, uint32_t owner, half *far) {
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

static void look_at(const froe_kinetic *k, live_site *site) {
    const uint32_t node = node_at(k, site->parent)->child[site->slot];
    const live_cell cell = live_cell_of(k, site->parent);
    site->cell = live_child_cell(k, &cell, site->parent, site->slot);
    site->cut = node && node_at(k, node)->cut;
}

/* 1, -1: p is above, below q; 0: there is no telling. */
static int height_order(froe_kinetic *k, now_name p, now_name q) {
    now_spot a = now_spot_of(&k->now, p), b = now_spot_of(&k->now, q);
    double d = a.y - b.y, error = (a.error + b.error) * 2;
    return d > error ? 1 : d < -error ? -1 : 0;
}

static bool find_halves(froe_kinetic *k, const live_item *item, half *near, half *far) {
    uint32_t node = k->certs.data[item->cert].owner;
    const live_node *n = node_at(k, node);
    near->side = item->kind == CERT_LEFT || (item->kind == CERT_MIDDLE && n->wall[LEFT] == END_NONE) ? LEFT : RIGHT;
    near->site = live_site_of(k, node);
    uint8_t slot;
    uint32_t owner = wall_owner(k, node, near->side, &slot);
    now_name wall = near->site.cell.wall[near->side];
    now_name point = near->side == LEFT ? item->claim.q : item->claim.p;
    if (!owner || !name_is(wall, near->side == LEFT ? item->claim.p : item->claim.q)) return false;
    int order = height_order(k, point, wall);
    if (!order) return false;
    far->side = 1 - near->side;
    far->site.parent = owner;
    far->site.slot = (uint8_t)(slot >= UP ? near->side : order > 0 ? UP : DOWN);
    if (!descend(k, node, owner, far)) return false;
    look_at(k, &far->site);
    return name_is(far->site.cell.wall[far->side], wall);
}

/* Is the other wall of the cell outside the slab? */
static bool is_wide(froe_kinetic *k, const half *h) {
    now_name wall = h->site.cell.wall[1 - h->side];
    if (!name_exists(wall)) return true;
    int order = now_compare(&k->now, wall, (now_name){(uint32_t)(1 - h->side), NAME_LINE});
    return h->side == RIGHT ? order < 0 : order > 0;
}

/* Cuts the thin part next to the wall off, to `place`; the rest to the next. */
static void cut_off(froe_kinetic *k, const half *h, uint8_t place) {
    const uint8_t slot[2] = {(uint8_t)(place + (h->side == RIGHT)), (uint8_t)(place + (h->side == LEFT))};
    live_split(k, node_at(k, h->site.parent)->child[h->site.slot], 1 - h->side, (uint32_t[]){PARTS, PARTS}, slot);
}

static void put_back(froe_kinetic *k, const half *h, uint8_t place) {
    const uint32_t *part = node_at(k, PARTS)->child + place;
    live_join(k, part[h->side == RIGHT], part[h->side == LEFT], h->site.parent, h->site.slot);
}

/* Makes the thin part anew from the `count` segments at the beginning of the list. */
static void grow_thin(froe_kinetic *k, const half *h, uint8_t place, size_t count) {
    live_cell thin = h->site.cell;
    thin.wall[1 - h->side] = (now_name){(uint32_t)(1 - h->side), NAME_LINE};
    if (!array_reserve(&k->alloc, &k->list, count)) {
        k->short_of_memory = true;
        return;
    }
    k->list.count = 2 * count;
    for (size_t i = 0; i < count; i++) k->list.data[count + i] = k->list.data[i];
    live_grow(k, &thin, count, PARTS, place);
}

static bool has_strangers(froe_kinetic *k, const half *near, const half *far) {
    const uint32_t border[4] = {near->site.cell.top, near->site.cell.bottom, far->site.cell.top, far->site.cell.bottom};
    bool found = live_find_strangers(k, border, 4);
    return live_find_strangers(k, k->list.data, k->list.count) || found;
}

/* Makes both thin parts anew. */
static void grow_halves(froe_kinetic *k, const half h[2], now_name point) {
    size_t count = k->list.count;
    k->counts.surgeries++;
    for (uint8_t i = 0; i < 2; i++) {
        live_free_tree(k, node_at(k, PARTS)->child[2 * i]);
        grow_thin(k, h + i, (uint8_t)(2 * i), count);
        if (live_has_wall(k, node_at(k, PARTS)->child[2 * i], point)) k->broken = true; /* never seen */
    }
}

live_outcome live_pass(froe_kinetic *k, const live_item *item) {
    half h[2];
    if (!find_halves(k, item, h, h + 1) || !is_wide(k, h) || !is_wide(k, h + 1)) return LIVE_NOT_NARROW;
    const now_name point = h->side == LEFT ? item->claim.q : item->claim.p;
    live_outcome outcome = LIVE_DONE;
    k->stamp++;
    live_new_list(k);
    for (uint8_t i = 0; i < 2; i++) cut_off(k, h + i, (uint8_t)(2 * i));
    if (k->short_of_memory) return LIVE_DONE;
    for (size_t i = 0; i < k->crew.count; i++) live_list(k, k->crew.data[i]);
    for (int i = 0; i < 2; i++) {
        live_collect(k, node_at(k, PARTS)->child[2 * i]);
        if (live_has_wall(k, node_at(k, PARTS)->child[2 * i], point)) outcome = LIVE_NOT_NARROW;
    }
    if (has_strangers(k, h, h + 1)) outcome = LIVE_STRANGERS;
    if (!outcome) grow_halves(k, h, point);
    for (uint8_t i = 0; i < 2; i++) put_back(k, h + i, (uint8_t)(2 * i));
    if (outcome || k->broken || k->now.lost) return outcome;
    live_touch_wall(k, h->site.cell.wall[h->side]);
    for (int i = 0; i < 2; i++) live_certify(k, &h[i].site);
    return LIVE_DONE;
}
