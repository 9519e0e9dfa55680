/* screen.c: the tree, and beams sent down it. */
#include "view/visibility/screen.h"
#include <string.h>

enum { ROOT_SLOT = UINT32_MAX }; /* slot: 2 * node + child, or this */

static void set_child(view_screen *s, uint32_t slot, uint32_t child) {
    if (slot == ROOT_SLOT)
        s->root = child;
    else
        s->nodes.data[slot >> 1].child[slot & 1] = child;
}

/* Puts a node under `slot`: inside the way `inner`, beyond it `outer`. FROE_NONE without memory. */
static uint32_t put_node(view_screen *s, uint32_t slot, view_way way, uint32_t inner, uint32_t outer) {
    const uint32_t node = (uint32_t)s->nodes.count, inside = !(way & 1);
    view_screen_node n = {.line = way >> 1};
    if (node >= VIEW_OPEN) return FROE_NONE;
    n.child[inside] = inner;
    n.child[!inside] = outer;
    if (!array_push(&s->sights->alloc, &s->nodes, n)) return FROE_NONE;
    set_child(s, slot, node);
    return 2 * node + inside;
}

/* --------------------------------------------------------------------- window -- */

froe_status view_screen_new(view_screen *s, view_sightlines *sights) {
    const uint32_t n = sights->window_count, first = sights->tree->scene->vertex_count;
    uint32_t lines[FROE_WINDOW_MOST], slot = ROOT_SLOT;
    int turn = 0;
    *s = (view_screen){.sights = sights, .root = VIEW_OPEN, .open = 1};
    for (uint32_t i = 0; i < n; i++)
        if ((lines[i] = view_line_of_window(sights, i)) == FROE_NONE) return FROE_E_MEMORY;
    /* The turn of the window as the eye sees it: 1 left, -1 right. It must be strictly convex. */
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t j = 2; j < n; j++) {
            const uint32_t v = first + (i + j) % n;
            const int side = view_side(sights, lines[i], &sights->rays[v], v, 0, 0);
            if (side == 0 || (turn && side != turn)) return FROE_E_INPUT;
            turn = side;
        }
    for (uint32_t i = 0; i < n; i++) {
        sights->window_ways[i] = 2 * lines[i] + (turn < 0);
        slot = put_node(s, slot, sights->window_ways[i], VIEW_OPEN, VIEW_OUTSIDE);
        if (slot == FROE_NONE) return FROE_E_MEMORY;
    }
    return FROE_OK;
}

void view_screen_free(view_screen *s) {
    if (!s->sights) return;
    const froe_allocator *alloc = &s->sights->alloc;
    array_free(alloc, &s->nodes);
    array_free(alloc, &s->beams);
    array_free(alloc, &s->corners);
    array_free(alloc, &s->sides);
    array_free(alloc, &s->stretches);
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
        const int here = wanted * s->sides.data[i], next = wanted * s->sides.data[i + 1 < count ? i + 1 : 0];
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
static bool divide_beam(view_screen *s, uint32_t node, size_t first, uint32_t count) {
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
    s->beams.data[s->beams.count++] = (view_pending){n.child[1], 2 * node + 1, first, positive};
    s->beams.data[s->beams.count++] = (view_pending){n.child[0], 2 * node, first + positive, negative};
    return true;
}

/* Follows the topmost beam down until it ends or is divided. */
static bool send(view_screen *s, uint32_t cover, view_beam_fn *fn, void *user) {
    const view_pending top = s->beams.data[--s->beams.count];
    uint32_t node = top.node, slot = top.slot;
    const uint32_t count = top.count;
    if (s->sides.capacity < count && !array_reserve(&s->sights->alloc, &s->sides, count)) return false;
    view_corner *ring = s->corners.data + top.first;
    while (node < VIEW_OPEN) {
        const view_screen_node *n = s->nodes.data + node;
        unsigned reached = 0; /* bit 0: some corners are on the negative side, bit 1: some on the positive */
        view_way before = ring[count - 1].way;
        for (uint32_t i = 0; i < count; i++) {
            const int side = view_side(s->sights, n->line, &ring[i].ray, ring[i].vertex, before, ring[i].way);
            s->sides.data[i] = (int8_t)side;
            reached |= side < 0 ? 1u : side > 0 ? 2u : 0u;
            before = ring[i].way;
        }
        if (reached == 3) return divide_beam(s, node, top.first, count);
        for (uint32_t i = 0; i < count; i++) /* a beam on one side of a line may have a side on it */
            if (!s->sides.data[i] && !s->sides.data[i + 1 < count ? i + 1 : 0]) ring[i].bound = 1;
        slot = 2 * node + (reached == 2);
        node = n->child[reached == 2];
    }
    s->corners.count = top.first;
    if (node != VIEW_OPEN) return true;
    if (!fn(user, ring, count)) return false;
    if (cover == FROE_NONE) return true;
    /* Covers the open leaf: a chain of those sides of the beam that the tree does not have yet. */
    s->open--;
    set_child(s, slot, VIEW_COVERED + cover);
    for (uint32_t i = 0; i < count; i++) {
        if (ring[i].bound) continue;
        slot = put_node(s, slot, ring[i].way, VIEW_COVERED + cover, VIEW_OPEN);
        if (slot == FROE_NONE) return false;
        s->open++;
    }
    return true;
}

froe_status view_screen_insert(view_screen *s, const view_corner *ring, uint32_t count, uint32_t cover,
                               view_beam_fn *fn, void *user) {
    const froe_allocator *alloc = &s->sights->alloc;
    s->beams.count = s->corners.count = 0;
    if (!array_reserve(alloc, &s->corners, count) || !array_reserve(alloc, &s->beams, 1)) return FROE_E_MEMORY;
    memcpy(s->corners.data, ring, count * sizeof *ring);
    s->corners.count = count;
    s->beams.data[s->beams.count++] = (view_pending){s->root, ROOT_SLOT, 0, count};
    while (s->beams.count)
        if (!send(s, cover, fn, user)) return FROE_E_MEMORY;
    return FROE_OK;
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
        ok = push_stretch(s, n.child[from > 0], &first) && push_stretch(s, n.child[to > 0], &last);
    }
    return ok ? FROE_OK : FROE_E_MEMORY;
}
