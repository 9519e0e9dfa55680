/* screen.c: the tree, and beams sent down it. */
#include "view/visibility/screen.h"
#include <string.h>

#define ROOT_SLOT UINT32_MAX /* slot: 2 * node + child, or this */
enum { TILE_MOST = 32 };     /* how many times as wide or high as a beam its leaf may be */

static void set_child(view_screen *s, uint32_t slot, uint32_t child) {
    if (slot == ROOT_SLOT)
        s->root = child;
    else
        s->nodes.data[slot >> 1].child[slot & 1] = child;
}

static bool is_closed(const view_screen *s, uint32_t child) {
    return child < VIEW_OPEN ? s->nodes.data[child].above & 1 : child > VIEW_OPEN;
}

/* Closes the nodes above a slot below which nothing is open any more. */
static void close_above(view_screen *s, uint32_t slot) {
    while (slot != ROOT_SLOT) {
        view_screen_node *n = s->nodes.data + (slot >> 1);
        if (!is_closed(s, n->child[0]) || !is_closed(s, n->child[1])) return;
        slot = n->above;
        n->above |= 1;
        if (slot == (ROOT_SLOT & ~1u)) return;
    }
}

/* Puts a node under `slot`: inside the way `inner`, beyond it `outer`. The slot inside; FROE_NONE without memory. */
static uint32_t put_node(view_screen *s, uint32_t slot, view_way way, uint32_t inner, uint32_t outer) {
    const uint32_t node = (uint32_t)s->nodes.count, inside = !(way & 1);
    view_screen_node n = {.line = way >> 1, .above = slot & ~1u};
    if (node >= VIEW_OPEN) return FROE_NONE;
    n.child[inside] = inner;
    n.child[!inside] = outer;
    if (!array_push(&s->sights->alloc, &s->nodes, n)) return FROE_NONE;
    set_child(s, slot, node);
    return 2 * node + inside;
}

/* --------------------------------------------------------------------- window -- */

/* The covector of a side of the window, 0 on it and 1 at the corner `opposite`. */
static void scale_side(view_screen *s, uint32_t side, uint32_t opposite, double out[3]) {
    const filter_vector h = view_way_image(s->sights, s->sights->window_ways[side]);
    const filter_vector ray = view_ray(s->sights, s->sights->tree->scene->vertex_count + opposite);
    const double at = h.x[0] * ray.x[0] + h.x[1] * ray.x[1] + h.x[2] * ray.x[2];
    for (int k = 0; k < 3; k++) out[k] = h.x[k] / at;
}

/* The lines across the window. */
static froe_status make_tiles(view_screen *s) {
    view_sightlines *sights = s->sights;
    s->first_across = (uint32_t)sights->lines.count;
    for (int axis = 0; axis < 2; axis++)
        for (uint32_t i = 1; i < sights->tiles; i++)
            if (view_line_across(sights, axis, i) == FROE_NONE) return FROE_E_MEMORY;
    if (sights->tiles == 1) return FROE_OK;
    scale_side(s, 3, 1, s->sides[0][0]);
    scale_side(s, 1, 0, s->sides[0][1]);
    scale_side(s, 0, 3, s->sides[1][0]);
    scale_side(s, 2, 0, s->sides[1][1]);
    return FROE_OK;
}

froe_status view_screen_new(view_screen *s, view_sightlines *sights) {
    const uint32_t n = sights->window_count, first = sights->tree->scene->vertex_count;
    uint32_t lines[FROE_WINDOW_MOST], slot = ROOT_SLOT;
    int turn = 0;
    *s = (view_screen){.sights = sights, .root = VIEW_OPEN, .open = 1};
    for (uint32_t i = 0; i < n; i++)
        if ((lines[i] = view_line_of_window(sights, i)) == FROE_NONE) return FROE_E_MEMORY;
    /* The turn of the window as the eye sees it. It must be strictly convex. */
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 2; j < n; j++) {
            const uint32_t v = first + (i + j) % n;
            const int side = view_side_of_vertex(sights, lines[i], v);
            if (side == 0 || (turn && side != turn)) return FROE_E_INPUT;
            turn = side;
        }
    for (uint32_t i = 0; i < n; i++) {
        sights->window_ways[i] = 2 * lines[i] + (turn < 0);
        slot = put_node(s, slot, sights->window_ways[i], VIEW_OPEN, VIEW_OUTSIDE);
        if (slot == FROE_NONE) return FROE_E_MEMORY;
    }
    s->turn = turn;
    return make_tiles(s);
}

void view_screen_free(view_screen *s) {
    if (!s->sights) return;
    const froe_allocator *alloc = &s->sights->alloc;
    array_free(alloc, &s->nodes);
    array_free(alloc, &s->leaves);
    array_free(alloc, &s->seen);
    array_free(alloc, &s->ring);
    array_free(alloc, &s->beams);
    array_free(alloc, &s->corners);
    array_free(alloc, &s->where);
    array_free(alloc, &s->stretches);
}

/* ---------------------------------------------------------------------- tiles -- */

/* Is the line of a node one across the window? Then *axis and *at say which. */
static bool is_across(const view_screen *s, uint32_t line, int *axis, uint16_t *at) {
    const uint32_t number = line - s->first_across, each = s->sights->tiles - 1;
    if (number >= 2 * each) return false;
    *axis = number >= each;
    *at = (uint16_t)(number - (*axis ? each : 0) + 1);
    return true;
}

/* Which child of such a node has the tiles before the line? Lines of axis 0 have them on their left where the window
 * turns left, lines of axis 1 on their right. */
static uint32_t lower_child(const view_screen *s, int axis) {
    return (s->turn > 0) != (axis == 1);
}

/* The box of a child. */
static view_box box_of_child(const view_screen *s, uint32_t line, uint32_t child, view_box box) {
    int axis;
    uint16_t at;
    if (!is_across(s, line, &axis, &at)) return box;
    *(child == lower_child(s, axis) ? &box.hi[axis] : &box.lo[axis]) = at;
    return box;
}

/* How wide and high a beam is, in tiles: about, as this decides about no more than the shape of the tree. */
static void measure_beam(view_screen *s, const view_corner *ring, uint32_t count) {
    for (int axis = 0; axis < 2; axis++) {
        double lo = 1, hi = 0;
        for (uint32_t i = 0; i < count; i++) {
            double at[2] = {0, 0};
            for (int k = 0; k < 3; k++) {
                at[0] += s->sides[axis][0][k] * ring[i].ray.x[k];
                at[1] += s->sides[axis][1][k] * ring[i].ray.x[k];
            }
            const double sum = at[0] + at[1], share = sum > 0 ? at[0] / sum : i & 1;
            lo = share < lo ? share : lo;
            hi = share > hi ? share : hi;
        }
        lo = lo > 0 ? lo : 0;
        hi = hi < 1 ? hi : 1;
        s->extent[axis] = hi > lo ? (hi - lo) * s->sights->tiles : 0;
    }
}

/* Divides an open leaf that is large beside the beam. FROE_NONE: it is not; *ok: there was memory. */
static uint32_t divide_leaf(view_screen *s, uint32_t slot, view_box box, bool *ok) {
    double most = TILE_MOST;
    int axis = -1;
    for (int k = 0; k < 2; k++) {
        const int wide = box.hi[k] - box.lo[k];
        if (wide < 2 || wide <= most * s->extent[k]) continue;
        axis = k;
        if (s->extent[k] > 0)
            most = wide / s->extent[k];
        else
            break;
    }
    if (axis < 0) return FROE_NONE;
    const uint32_t at = (box.lo[axis] + box.hi[axis]) / 2u,
                   line = s->first_across + (axis ? s->sights->tiles - 1 : 0) + at - 1;
    slot = put_node(s, slot, 2 * line, VIEW_OPEN, VIEW_OPEN);
    *ok = slot != FROE_NONE;
    s->open += *ok;
    return *ok ? slot >> 1 : FROE_NONE;
}

/* ---------------------------------------------------------------------- beams -- */

static void put_corner(view_screen *s, const view_corner *corner, view_way way, uint32_t bound) {
    view_corner k = *corner;
    k.way = way;
    k.bound = bound;
    s->corners.data[s->corners.count++] = k;
}

/* Appends the part of a ring on one side (1 or -1) of a line that divides it; there is room. */
static void cut_off(view_screen *s, size_t first, uint32_t count, uint32_t line, int wanted) {
    const view_way along = 2 * line + (wanted < 0);
    for (uint32_t i = 0; i < count; i++) {
        const view_corner *k = s->corners.data + first + i;
        const int here = wanted * s->where.data[i], next = wanted * s->where.data[i + 1 < count ? i + 1 : 0];
        if (here > 0) put_corner(s, k, k->way, k->bound);
        if (here == 0) put_corner(s, k, next > 0 ? k->way : along, next > 0 ? k->bound : 1);
        if (here * next >= 0) continue;
        view_corner x = {.vertex = FROE_NONE};
        if (here > 0) { /* leaving: the side i, then the line */
            x.ray = view_meeting(s->sights, k->way, along);
            put_corner(s, &x, along, 1);
        } else {
            x.ray = view_meeting(s->sights, along, k->way);
            put_corner(s, &x, k->way, k->bound);
        }
    }
}

/* Replaces the topmost beam, its ring at `first`, by its two parts, the negative one on top. */
static bool divide_beam(view_screen *s, uint32_t node, size_t first, uint32_t count, view_box box) {
    const froe_allocator *alloc = &s->sights->alloc;
    const view_screen_node n = s->nodes.data[node];
    if (!array_reserve(alloc, &s->corners, 2 * ((size_t)count + 2)) || !array_reserve(alloc, &s->beams, 2))
        return false;
    const size_t start = s->corners.count;
    cut_off(s, first, count, n.line, 1);
    const uint32_t positive = (uint32_t)(s->corners.count - start);
    cut_off(s, first, count, n.line, -1);
    const uint32_t negative = (uint32_t)(s->corners.count - start) - positive;
    memmove(s->corners.data + first, s->corners.data + start, (size_t)(positive + negative) * sizeof *s->corners.data);
    s->corners.count = first + positive + negative;
    s->beams.data[s->beams.count++] =
        (view_pending){n.child[1], 2 * node + 1, first, positive, box_of_child(s, n.line, 1, box)};
    s->beams.data[s->beams.count++] =
        (view_pending){n.child[0], 2 * node, first + positive, negative, box_of_child(s, n.line, 0, box)};
    return true;
}

/* Appends a ring to those that were found. */
static bool keep_ring(view_screen *s, const view_corner *ring, uint32_t count, view_opening *out) {
    if (s->ring.count + count > INT32_MAX || !array_reserve(&s->sights->alloc, &s->ring, count)) return false;
    out->first = (uint32_t)s->ring.count;
    out->count = count;
    memcpy(s->ring.data + s->ring.count, ring, count * sizeof *ring);
    s->ring.count += count;
    return true;
}

/* Follows the topmost beam down until it ends or is divided. */
static bool send(view_screen *s, bool opaque) {
    const view_pending top = s->beams.data[--s->beams.count];
    uint32_t node = top.node, slot = top.slot;
    view_box box = top.box;
    const uint32_t count = top.count;
    if (s->where.capacity < count && !array_reserve(&s->sights->alloc, &s->where, count)) return false;
    view_corner *ring = s->corners.data + top.first;
    for (;;) {
        if (node == VIEW_OPEN && opaque) {
            bool ok = true;
            const uint32_t divided = divide_leaf(s, slot, box, &ok);
            if (!ok) return false;
            if (divided != FROE_NONE) node = divided;
        }
        if (is_closed(s, node) || node == VIEW_OPEN) break;
        const view_screen_node *n = s->nodes.data + node;
        unsigned reached = 0; /* bit 0: some corners are on the negative side, bit 1: some on the positive */
        view_way before = ring[count - 1].way;
        for (uint32_t i = 0; i < count; i++) {
            const int side = view_side(s->sights, n->line, &ring[i].ray, ring[i].vertex, before, ring[i].way);
            s->where.data[i] = (int8_t)side;
            reached |= side < 0 ? 1u : side > 0 ? 2u : 0u;
            before = ring[i].way;
        }
        if (reached == 3) return divide_beam(s, node, top.first, count, box);
        for (uint32_t i = 0; i < count; i++) /* a beam on one side of a line may have a side on it */
            if (!s->where.data[i] && !s->where.data[i + 1 < count ? i + 1 : 0]) ring[i].bound = 1;
        const uint32_t child = reached == 2;
        box = box_of_child(s, n->line, child, box);
        slot = 2 * node + child;
        node = n->child[child];
    }
    s->corners.count = top.first;
    view_opening part = {.slot = slot};
    if (node != VIEW_OPEN) s->lost = true;
    return node != VIEW_OPEN || (keep_ring(s, ring, count, &part) && array_push(&s->sights->alloc, &s->leaves, part));
}

froe_status view_screen_look(view_screen *s, const view_corner *ring, uint32_t count, bool opaque) {
    const froe_allocator *alloc = &s->sights->alloc;
    const uint16_t tiles = (uint16_t)s->sights->tiles;
    s->beams.count = s->corners.count = s->leaves.count = s->seen.count = s->ring.count = 0;
    s->lost = false;
    if (!array_reserve(alloc, &s->corners, count) || !array_reserve(alloc, &s->beams, 1)) return FROE_E_MEMORY;
    memcpy(s->corners.data, ring, count * sizeof *ring);
    s->corners.count = count;
    s->beams.data[s->beams.count++] = (view_pending){s->root, ROOT_SLOT, 0, count, {{0, 0}, {tiles, tiles}}};
    if (opaque && tiles > 1) measure_beam(s, ring, count);
    while (s->beams.count)
        if (!send(s, opaque)) return FROE_E_MEMORY;
    /* Parts of a beam that is wholly open need not be told apart. */
    if (!array_reserve(alloc, &s->seen, s->leaves.count)) return FROE_E_MEMORY;
    if (s->leaves.count < 2 || s->lost) {
        for (size_t i = 0; i < s->leaves.count; i++) s->seen.data[s->seen.count++] = s->leaves.data[i];
        return FROE_OK;
    }
    return keep_ring(s, ring, count, &s->seen.data[s->seen.count++]) ? FROE_OK : FROE_E_MEMORY;
}

/* Covers an open leaf: a chain of those sides of the beam that the tree does not have yet. */
froe_status view_screen_cover(view_screen *s, uint32_t object) {
    for (size_t k = 0; k < s->leaves.count; k++) {
        const view_opening *part = s->leaves.data + k;
        const view_corner *ring = s->ring.data + part->first;
        uint32_t slot = part->slot;
        s->open--;
        set_child(s, slot, VIEW_COVERED + object);
        for (uint32_t i = 0; i < part->count; i++) {
            if (ring[i].bound) continue;
            slot = put_node(s, slot, ring[i].way, VIEW_COVERED + object, VIEW_OPEN);
            if (slot == FROE_NONE) return FROE_E_MEMORY;
            s->open++;
        }
        close_above(s, slot);
    }
    return FROE_OK;
}

/* ---------------------------------------------------------------------- sides -- */

/* Its ends are the meetings of its line with the sides before and after: see region.c. */
view_stretch view_side_of_ring(const view_corner *ring, uint32_t count, uint32_t i) {
    const uint32_t j = i + 1 < count ? i + 1 : 0;
    const view_corner *k = ring + i, *next = ring + j;
    const view_way before = ring[i ? i - 1 : count - 1].way;
    const uint32_t turned = k->way & 1;
    view_stretch s = {.edge = k->way >> 1};
    s.end[turned] = (view_end){k->ray, k->vertex, before ^ 1 ^ turned};
    s.end[!turned] = (view_end){next->ray, next->vertex, next->way ^ turned};
    return s;
}

bool view_screen_side(const view_screen *s, view_way way, view_stretch_fn *fn, void *user) {
    for (size_t k = 0; k < s->seen.count; k++) {
        const view_opening *part = s->seen.data + k;
        const view_corner *ring = s->ring.data + part->first;
        for (uint32_t i = 0; i < part->count; i++) {
            if (ring[i].way != way) continue;
            const view_stretch stretch = view_side_of_ring(ring, part->count, i);
            if (!fn(user, &stretch)) return false;
        }
    }
    return true;
}

/* ------------------------------------------------------------------ stretches -- */

static int side_of_end(view_sightlines *s, uint32_t line, const view_end *end, uint32_t own) {
    return view_side(s, line, &end->ray, end->vertex, 2 * own, end->way);
}

bool view_cut_stretch(view_sightlines *s, uint32_t own, view_way way, view_stretch *part) {
    const uint32_t line = way >> 1;
    const int turn = way & 1 ? -1 : 1, from = side_of_end(s, line, &part->end[0], own),
              to = side_of_end(s, line, &part->end[1], own);
    if (turn * from <= 0 && turn * to <= 0) return false;
    if (from * to >= 0) return true;
    view_end middle = {.vertex = FROE_NONE, .way = 2 * line + (from < 0)}; /* leaving: edge x line */
    middle.ray = view_meeting(s, 2 * own, middle.way);
    part->end[turn * from > 0] = middle; /* replaces the end outside */
    return true;
}

bool view_cut_to_window(view_sightlines *s, uint32_t own, view_stretch *part) {
    bool left = true;
    for (uint32_t i = 0; left && i < s->window_count; i++) left = view_cut_stretch(s, own, s->window_ways[i], part);
    return left;
}

static bool push_stretch(view_screen *s, uint32_t node, const view_stretch *part) {
    if (!array_reserve(&s->sights->alloc, &s->stretches, 1)) return false;
    s->stretches.data[s->stretches.count++] = (view_pending_stretch){node, *part};
    return true;
}

froe_status view_screen_classify(view_screen *s, const view_stretch *stretch, uint32_t own, const view_corner *ring,
                                 uint32_t count, view_stretch_fn *fn, void *user) {
    s->stretches.count = 0;
    bool ok = push_stretch(s, s->root, stretch);
    while (ok && s->stretches.count) {
        const view_pending_stretch top = s->stretches.data[--s->stretches.count];
        if (top.node == VIEW_OPEN) ok = fn(user, &top.part);
        if (top.node >= VIEW_OPEN) continue;
        const view_screen_node n = s->nodes.data[top.node];
        const view_end *ends = top.part.end;
        const int from = side_of_end(s->sights, n.line, &ends[0], own),
                  to = side_of_end(s->sights, n.line, &ends[1], own);
        if (from * to >= 0) {
            int side = from ? from : to;
            for (uint32_t i = 0; i < count && !side; i++) { /* on the line: the side on which the beam is */
                const view_way before = ring[i ? i - 1 : count - 1].way;
                side = view_side(s->sights, n.line, &ring[i].ray, ring[i].vertex, before, ring[i].way);
            }
            ok = push_stretch(s, n.child[side > 0], &top.part);
            continue;
        }
        view_end middle = {.vertex = FROE_NONE, .way = 2 * n.line + (from < 0)}; /* leaving: edge x line */
        middle.ray = view_meeting(s->sights, 2 * own, middle.way);
        const view_stretch first = {top.part.edge, {ends[0], middle}}, last = {top.part.edge, {middle, ends[1]}};
        ok = push_stretch(s, n.child[from > 0], &first) && /* one way: it has the room of what it is a part of */
             push_stretch(s, n.child[to > 0], &last);
    }
    return ok ? FROE_OK : FROE_E_MEMORY;
}
