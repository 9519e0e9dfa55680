/* beam.c: rings of pieces (tree/ring.h) become rings of sightlines. */
#include "view/visibility/beam.h"

/* The ring of a piece: entry i is the side that leaves corner i, an edge of the polygon or a cut. */
typedef struct piece_ring {
    uint32_t object, count;
    const uint32_t *ring; /* NULL: the whole polygon */
} piece_ring;

static piece_ring ring_of_piece(const froe_tree *t, uint32_t piece) {
    const tree_piece *p = t->pieces + piece;
    if (!p->ring) return (piece_ring){p->object, scene_corners(t->scene, p->object), NULL};
    return (piece_ring){p->object, t->bounds[p->ring], t->bounds + p->ring + 1};
}

static uint32_t entry(const piece_ring *o, uint32_t i) {
    return o->ring ? o->ring[i] : i;
}

static uint32_t edge_of(const view_sightlines *s, uint32_t object, uint32_t side) {
    return s->surface->edge_of[scene_start(s->tree->scene, object) + side];
}

/* The way along an entry, the piece on its positive side; `facing` is the side of the eye. For an own edge the ring
 * turns left as the eye sees it when the eye is in front. On the support s of a patch the covector of a cut line is
 * -s(E) a(x). */
static view_way way_of(view_sightlines *s, uint32_t piece, uint32_t object, uint32_t side, int facing) {
    const froe_scene *scene = s->tree->scene;
    if (!(side & TREE_EDGE_CUT)) {
        const uint32_t n = scene_corners(scene, object), line = view_line_of_edge(s, edge_of(s, object, side));
        const bool ascends =
            scene_corner(scene, object, side) < scene_corner(scene, object, side + 1 < n ? side + 1 : 0);
        return line == FROE_NONE ? FROE_NONE : 2 * line + (ascends != (facing > 0));
    }
    const uint32_t node = side & ~TREE_EDGE_CUT, patch = s->surface->patch_of[object];
    const uint32_t line = view_line_of_cut(s, patch, node);
    const bool positive = piece >= tree_first_piece(s->tree, s->tree->nodes[node].child + 1);
    const bool in_front = view_facing(s, surface_first(s->surface, patch)) > 0;
    return line == FROE_NONE ? FROE_NONE : 2 * line + (positive == in_front);
}

/* The vertex at corner i of a ring: between two edges of the polygon, or at the end of one where a cut goes through it.
 * FROE_NONE: the corner is none. */
static uint32_t vertex_at(const view_sightlines *s, const piece_ring *o, uint32_t i) {
    const froe_scene *scene = s->tree->scene;
    const uint32_t before = entry(o, i ? i - 1 : o->count - 1), after = entry(o, i),
                   n = scene_corners(scene, o->object);
    const bool cut_before = before & TREE_EDGE_CUT, cut_after = after & TREE_EDGE_CUT;
    if (cut_before && cut_after) return FROE_NONE;
    const uint32_t vertex = scene_corner(scene, o->object, !cut_after ? after : before + 1 < n ? before + 1 : 0);
    if (!cut_before && !cut_after) return vertex;
    return view_cut_has(s, (cut_before ? before : after) & ~TREE_EDGE_CUT, vertex) ? vertex : FROE_NONE;
}

/* Drops sides along the line of the side before, which have no length as the eye sees them. A wall of the method
 * `cylindrical` is sheared by an infinitely small eps, and a piece may lie between it and the upright face that it
 * touches: where the two lines have opposite directions nothing of the piece is seen, and the ring becomes empty. */
static void drop_flat(const view_sightlines *s, view_ring *ring) {
    size_t kept = 0;
    for (size_t i = 0; i < ring->count; i++) {
        const view_corner *k = ring->data + i;
        if (k->ray.x[0] != 0 || k->ray.x[1] != 0 || k->ray.x[2] != 0) { /* the lines meet at a point */
            ring->data[kept++] = *k;
            continue;
        }
        const view_way before = ring->data[i ? i - 1 : ring->count - 1].way;
        const double *a = s->lines.data[before >> 1].image.x, *b = s->lines.data[k->way >> 1].image.x;
        const bool along = (a[0] * b[0] + a[1] * b[1] + a[2] * b[2] > 0) != ((before ^ k->way) & 1);
        if (!along) {
            ring->count = 0;
            return;
        }
    }
    ring->count = kept < 3 ? 0 : kept;
}

/* Corners in the order of turning left; a corner lies between entries i - 1 and i of the ring. */
static bool make_ring(view_sightlines *s, uint32_t piece, const piece_ring *o, view_ring *ring) {
    const int facing = view_facing(s, o->object);
    ring->count = 0;
    if (!array_reserve(&s->alloc, ring, o->count)) return false;
    for (uint32_t j = 0; j < o->count; j++) {
        const uint32_t i = facing > 0 ? j : o->count - 1 - j, i_before = i ? i - 1 : o->count - 1;
        const uint32_t before = entry(o, i_before), after = entry(o, i);
        const bool own = !((before | after) & TREE_EDGE_CUT);
        if (own && s->surface->straight[scene_start(s->tree->scene, o->object) + after]) continue;
        view_corner k = {.vertex = vertex_at(s, o, i)};
        k.way = way_of(s, piece, o->object, facing > 0 ? after : before, facing);
        if (k.way == FROE_NONE) return false;
        ring->data[ring->count++] = k;
    }
    for (size_t i = 0; i < ring->count; i++) {
        view_corner *k = ring->data + i;
        const view_way before = ring->data[i ? i - 1 : ring->count - 1].way;
        k->ray = k->vertex != FROE_NONE ? s->rays[k->vertex] : view_meeting(s, before, k->way);
    }
    drop_flat(s, ring);
    return true;
}

bool view_beam_of(view_sightlines *s, uint32_t piece, view_ring *ring) {
    const piece_ring o = ring_of_piece(s->tree, piece);
    return make_ring(s, piece, &o, ring);
}

bool view_beam_of_object(view_sightlines *s, uint32_t object, view_ring *ring) {
    const piece_ring o = {object, scene_corners(s->tree->scene, object), NULL};
    return make_ring(s, 0, &o, ring);
}

/* ------------------------------------------------------------------ stretches -- */

uint32_t view_side_count(const view_sightlines *s, uint32_t piece) {
    return ring_of_piece(s->tree, piece).count;
}

/* The end of a stretch of an edge: a vertex, or where the cut of a node ends it. The cut's way then has the edge's
 * lower vertex on its positive side. */
static bool set_end(view_sightlines *s, uint32_t object, uint32_t edge, uint32_t neighbour, uint32_t vertex,
                    view_end *out) {
    const uint32_t *v = s->surface->vertices + 2 * (size_t)edge;
    *out = (view_end){.ray = s->rays[vertex], .vertex = vertex};
    if (!(neighbour & TREE_EDGE_CUT)) return true;
    const uint32_t own = view_line_of_edge(s, edge);
    const uint32_t line = view_line_of_cut(s, s->surface->patch_of[object], neighbour & ~TREE_EDGE_CUT);
    if (own == FROE_NONE || line == FROE_NONE) return false;
    int side = view_side(s, line, &s->rays[v[0]], v[0], 0, 0);
    if (!side) side = -view_side(s, line, &s->rays[v[1]], v[1], 0, 0);
    out->vertex = FROE_NONE;
    out->way = 2 * line + (side < 0);
    out->ray = view_meeting(s, 2 * own, out->way);
    return true;
}

bool view_stretch_of(view_sightlines *s, uint32_t piece, uint32_t i, view_stretch *out, froe_status *status) {
    const piece_ring o = ring_of_piece(s->tree, piece);
    const uint32_t side = entry(&o, i);
    if (side & TREE_EDGE_CUT) return false;
    const uint32_t n = scene_corners(s->tree->scene, o.object), edge = edge_of(s, o.object, side);
    const uint32_t from = scene_corner(s->tree->scene, o.object, side),
                   to = scene_corner(s->tree->scene, o.object, side + 1 < n ? side + 1 : 0);
    out->edge = edge;
    if (!set_end(s, o.object, edge, entry(&o, i ? i - 1 : o.count - 1), from, &out->end[from > to]) ||
        !set_end(s, o.object, edge, entry(&o, i + 1 < o.count ? i + 1 : 0), to, &out->end[from < to]))
        *status = FROE_E_MEMORY;
    return *status == FROE_OK;
}
