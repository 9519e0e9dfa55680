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

/* The way along a side of a polygon, the polygon on its positive side; `facing` is the side of the eye. The ring turns
 * left as the eye sees it when the eye is in front. */
static view_way own_way(view_sightlines *s, uint32_t object, uint32_t side, int facing) {
    const froe_scene *scene = s->tree->scene;
    const uint32_t n = scene_corners(scene, object), line = view_line_of_edge(s, edge_of(s, object, side));
    const bool ascends = scene_corner(scene, object, side) < scene_corner(scene, object, side + 1 < n ? side + 1 : 0);
    return line == FROE_NONE ? FROE_NONE : 2 * line + (ascends != (facing > 0));
}

/* Is the cut of a node a wall of the method `cylindrical`, which leans by an infinitely small eps? */
static bool leans(const view_sightlines *s, uint32_t node) {
    const tree_node *n = s->tree->nodes + node;
    if (n->type == TREE_PLAIN) return false;
    const uint32_t kind = s->tree->cuts[n->u.cut].kind; /* the plane would say so, too, after much arithmetic */
    return kind == FROE_CUT_VERTEX || kind == FROE_CUT_CROSSING;
}

/* A wall that leans may cut off a piece without width along an edge, and pass along that edge as the eye sees it. Then
 * the way along the edge, in the direction of the wall; else the way as it is. */
static view_way snap_to_edge(view_sightlines *s, uint32_t object, view_way way, int facing) {
    const froe_scene *scene = s->tree->scene;
    const uint32_t n = scene_corners(scene, object);
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t next = i + 1 < n ? i + 1 : 0;
        if (view_side_of_vertex(s, way >> 1, scene_corner(scene, object, i)) ||
            view_side_of_vertex(s, way >> 1, scene_corner(scene, object, next)))
            continue;
        int inside = 0; /* on which side of the wall is the polygon? */
        for (uint32_t k = 0; k < n && !inside; k++)
            inside = view_side_of_vertex(s, way >> 1, scene_corner(scene, object, k));
        const view_way own = own_way(s, object, i, facing);
        return own == FROE_NONE ? own : own ^ ((inside < 0) != (way & 1));
    }
    return way;
}

/* The way along an entry, the piece on its positive side. On the support s of a patch the covector of a cut line is
 * -s(E) a(x). */
static view_way way_of(view_sightlines *s, uint32_t piece, uint32_t object, uint32_t side, int facing) {
    if (!(side & TREE_EDGE_CUT)) return own_way(s, object, side, facing);
    const uint32_t node = side & ~TREE_EDGE_CUT, patch = s->surface->patch_of[object];
    const uint32_t line = view_line_of_cut(s, patch, node);
    const bool positive = piece >= tree_first_piece(s->tree, s->tree->nodes[node].child + 1);
    const bool in_front = view_facing(s, surface_first(s->surface, patch)) > 0;
    if (line == FROE_NONE) return FROE_NONE;
    const view_way way = 2 * line + (positive == in_front);
    return leans(s, node) ? snap_to_edge(s, object, way, facing) : way;
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

/* Does the line of a way go on along that of another? */
static bool is_along(view_sightlines *s, view_way a, view_way b) {
    if (a >> 1 == b >> 1) return true;
    const filter_vector ray = view_meeting(s, a, b);
    return ray.x[0] == 0 && ray.x[1] == 0 && ray.x[2] == 0;
}

static bool is_opposite(const view_sightlines *s, view_way a, view_way b) {
    const double *x = s->lines.data[a >> 1].image.x, *y = s->lines.data[b >> 1].image.x;
    return (x[0] * y[0] + x[1] * y[1] + x[2] * y[2] > 0) != !((a ^ b) & 1);
}

static void remove_side(view_ring *ring, size_t i) {
    for (size_t j = i + 1; j < ring->count; j++) ring->data[j - 1] = ring->data[j];
    ring->count--;
}

/* A vertex at which two edges end; FROE_NONE: the ways are no such edges. */
static uint32_t shared_vertex(const view_sightlines *s, view_way a, view_way b) {
    const view_line *p = s->lines.data + (a >> 1), *q = s->lines.data + (b >> 1);
    if (p->kind != VIEW_EDGE || q->kind != VIEW_EDGE) return FROE_NONE;
    return p->a == q->a || p->a == q->b ? p->a : p->b == q->a || p->b == q->b ? p->b : FROE_NONE;
}

/* Walls that lean leave pieces, and sides of pieces, which have no width as the eye sees them. Drops sides that go on
 * along the side before, and sides both of whose ends are one point. What is left of a piece without width has fewer
 * than three sides, or two along one line in opposite directions: then the ring becomes empty. */
static void drop_flat(view_sightlines *s, view_ring *ring) {
    size_t fine = 0, i = 0; /* so many sides before i are neither */
    while (fine < ring->count && ring->count > 2) {
        i %= ring->count;
        const size_t last = i ? i - 1 : ring->count - 1, next = i + 1 < ring->count ? i + 1 : 0;
        const view_corner *before = ring->data + last, *here = ring->data + i;
        view_corner *after = ring->data + next;
        if (is_along(s, before->way, here->way)) {
            if (is_opposite(s, before->way, here->way)) break;
            remove_side(ring, i);
            fine = 0;
        } else if (!is_along(s, here->way, after->way) &&
                   !view_side(s, before->way >> 1, &after->ray, after->vertex, here->way, after->way)) {
            if (after->vertex == FROE_NONE) after->vertex = here->vertex, after->ray = here->ray;
            remove_side(ring, i);
            fine = 0;
        } else {
            fine++, i++;
        }
    }
    if (ring->count < 3 || fine < ring->count) ring->count = 0;
    for (i = 0; i < ring->count; i++) {
        view_corner *k = ring->data + i;
        const view_way before = ring->data[i ? i - 1 : ring->count - 1].way;
        if (k->vertex == FROE_NONE) k->vertex = shared_vertex(s, before, k->way);
        k->ray = k->vertex != FROE_NONE ? view_ray(s, k->vertex) : view_meeting(s, before, k->way);
    }
}

/* Corners in the order of turning left; a corner lies between entries i - 1 and i of the ring. */
static bool make_ring(view_sightlines *s, uint32_t piece, const piece_ring *o, view_ring *ring) {
    const int facing = view_facing(s, o->object);
    bool leaning = false;
    ring->count = 0;
    if (!array_reserve(&s->alloc, ring, o->count)) return false;
    for (uint32_t j = 0; j < o->count; j++) {
        const uint32_t i = facing > 0 ? j : o->count - 1 - j, i_before = i ? i - 1 : o->count - 1;
        const uint32_t before = entry(o, i_before), after = entry(o, i);
        const bool own = !((before | after) & TREE_EDGE_CUT);
        leaning = leaning || (after & TREE_EDGE_CUT && leans(s, after & ~TREE_EDGE_CUT));
        if (own && s->surface->straight[scene_start(s->tree->scene, o->object) + after]) continue;
        view_corner k = {.vertex = vertex_at(s, o, i)};
        k.way = way_of(s, piece, o->object, facing > 0 ? after : before, facing);
        if (k.way == FROE_NONE) return false;
        ring->data[ring->count++] = k;
    }
    for (size_t i = 0; i < ring->count; i++) {
        view_corner *k = ring->data + i;
        const view_way before = ring->data[i ? i - 1 : ring->count - 1].way;
        k->ray = k->vertex != FROE_NONE ? view_ray(s, k->vertex) : view_meeting(s, before, k->way);
    }
    if (leaning) drop_flat(s, ring);
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

bool view_goes_straight(const view_sightlines *s, uint32_t object) {
    const uint32_t n = scene_corners(s->tree->scene, object), first = scene_start(s->tree->scene, object);
    uint32_t i = 0;
    while (n > 3 && i < n && !s->surface->straight[first + i]) i++;
    return n > 3 && i < n;
}

bool view_stretch_of(view_sightlines *s, uint32_t object, uint32_t side, const view_ring *ring, view_stretch *out,
                     froe_status *status) {
    const uint32_t edge = edge_of(s, object, side), *v = s->surface->vertices + 2 * (size_t)edge;
    const uint32_t own = view_line_of_edge(s, edge);
    if (own == FROE_NONE) *status = FROE_E_MEMORY;
    if (own == FROE_NONE) return false;
    size_t along = 0;
    while (along < ring->count && (view_side_of_vertex(s, ring->data[along].way >> 1, v[0]) ||
                                   view_side_of_vertex(s, ring->data[along].way >> 1, v[1])))
        along++;
    bool left = along < ring->count;
    *out = (view_stretch){.edge = edge};
    for (int k = 0; k < 2; k++) out->end[k] = (view_end){.ray = view_ray(s, v[k]), .vertex = v[k]};
    for (size_t i = 0; i < ring->count && left; i++)
        left = i == along || view_cut_stretch(s, own, ring->data[i].way, out);
    return left;
}
