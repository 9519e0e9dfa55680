/* cylinder.c: cylindrical partitions of space, cut by cut (Agarwal, Erickson and Guibas, "Kinetic BSPs for intersecting
 * segments and disjoint triangles", SODA 1998).
 *
 * Seen from above, cells are the trapezoids of trapezoid.h: left and right of them are walls, below and above edges
 * that span them. The first fragment of a cell, in the order of priority, says how the cell is cut: by the vertical
 * planes through its edges, one after the other, until it spans the cell, then by its own plane. Where such an edge
 * ends inside of the cell, at a vertex or where it crosses the edge below or above, walls come first. What lies in a
 * plane that cuts stays in its list.
 * Source and proofs: the paper's section 2. */
#include "build/cylindrical/cylinder.h"
#include "split/cell.h"
#include <string.h>

enum { LEFT, RIGHT };

/** What is cut: a segment, or an edge of a polygon; or a vertical polygon, as seen from above. */
typedef struct stretch {
    const split_fragment *fragment;
    split_corner end[2]; /**< left and right */
    uint32_t edge;       /**< its number, for crossings */
    uint32_t u, v;       /**< vertices of the line, left and right */
} stretch;

/* ------------------------------------------------------------------ frames -- */

static split_cylinder_frame frame_of(const split_work *work, const split_cell *cell) {
    split_cylinder_frame f = {{FROE_NONE, FROE_NONE}, {FROE_NONE, FROE_NONE}};
    if (cell->depth) memcpy(&f, split_room(work), sizeof f);
    return f;
}

/* ------------------------------------------------------------------ walls -- */

static int order_xy(const double *p, const double *q) {
    int k = p[0] == q[0];
    return (p[k] > q[k]) - (p[k] < q[k]);
}

static bool is_wall(froe_cut_kind kind) {
    return kind == FROE_CUT_VERTEX || kind == FROE_CUT_CROSSING;
}

/** Does the wall on this side of the cell run through the end of the stretch? */
static bool is_on_wall(split_set *set, const split_cylinder_frame *frame, const stretch *s, int side) {
    uint32_t node = frame->wall[side];
    const split_corner *end = s->end + side;
    if (node == FROE_NONE) return false;
    froe_cut wall = split_cut_at(set, node);
    if (end->type == SPLIT_VERTEX && wall.kind == FROE_CUT_VERTEX)
        return !order_xy(scene_vertex(set->scene, end->a), scene_vertex(set->scene, wall.id[0]));
    split_plane plane = split_plane_of(set->scene, &wall);
    return !split_corner_side(set, &plane, s->fragment->object, end);
}

/** The vertical plane through an edge, by its number, from its left end to its right. */
static froe_cut edge_cut(const froe_scene *scene, uint32_t edge) {
    uint32_t v[2];
    froe_scene_edge(scene, edge, v);
    bool falls = order_xy(scene_vertex(scene, v[0]), scene_vertex(scene, v[1])) > 0;
    return (froe_cut){.kind = FROE_CUT_EDGE, .id = {v[falls], v[!falls], edge}}; /* trees do not keep the third */
}

froe_cut split_cylinder_crossing(split_set *set, uint32_t a, uint32_t b) {
    const double *line[2], *other[2];
    scene_crossing_line(set->scene, a, line);
    scene_crossing_line(set->scene, b, other);
    geom_plane plane = set->scene->dim == 2 ? geom_plane_points(2, line) : geom_plane_vertical(line[0], line[1]);
    int from = geom_side_vertex(&set->context, &plane, other[0]),
        to = geom_side_vertex(&set->context, &plane, other[1]);
    return (froe_cut){.kind = FROE_CUT_CROSSING, .id = {to > from ? a : b, to > from ? b : a}};
}

/** Names the wall that the stretch needs at one end. False: none, it ends on one, or on another polygon. */
static bool wall_at(split_set *set, const split_cylinder_frame *frame, const stretch *s, int side, froe_cut *cut) {
    const split_corner *end = s->end + side;
    if (end->type == SPLIT_VERTEX) {
        *cut = (froe_cut){.kind = FROE_CUT_VERTEX, .id = {end->a}};
        return !is_on_wall(set, frame, s, side);
    }
    /* what ends the stretch here: the first cut through that point; a wall if there is one among them */
    froe_cut by = split_cut_at(set, end->type == SPLIT_CROSSING ? end->c : end->a);
    if (end->type == SPLIT_CORNER && !is_wall(by.kind)) {
        froe_cut second = split_cut_at(set, end->b);
        if (is_wall(second.kind) || by.kind != FROE_CUT_EDGE) by = second;
    }
    if (by.kind != FROE_CUT_EDGE || is_on_wall(set, frame, s, side)) return false;
    /* the edge below or above on which the end of the stretch lies */
    uint32_t other = FROE_NONE;
    for (int i = 0; i < 2 && other == FROE_NONE; i++) {
        if (frame->edge[i] == FROE_NONE) continue;
        froe_cut border = edge_cut(set->scene, frame->edge[i]);
        split_plane plane = split_plane_of(set->scene, &border);
        if (!split_corner_side(set, &plane, s->fragment->object, end)) other = frame->edge[i];
    }
    if (other == FROE_NONE) return false;
    *cut = split_cylinder_crossing(set, other, s->edge); /* the stretch has its ends on both sides of the other line */
    return true;
}

/* ----------------------------------------------------------------- objects -- */

/** Puts the ends in order. */
static void turn_right(const froe_scene *scene, stretch *s) {
    if (order_xy(scene_vertex(scene, s->u), scene_vertex(scene, s->v)) < 0) return;
    uint32_t u = s->u;
    split_corner left = s->end[LEFT];
    s->u = s->v, s->v = u;
    s->end[LEFT] = s->end[RIGHT], s->end[RIGHT] = left;
}

/** Left wall, right wall, line. */
static split_verdict cut_stretch(split_set *set, const split_cylinder_frame *frame, const stretch *s,
                                 const froe_cut *line, froe_cut *cut) {
    if (!wall_at(set, frame, s, LEFT, cut) && !wall_at(set, frame, s, RIGHT, cut)) *cut = *line;
    return SPLIT_CUT_ANYWAY;
}

static split_verdict cut_vertex(const split_set *set, const split_fragment *f, froe_cut *cut) {
    *cut = (froe_cut){.kind = FROE_CUT_VERTEX, .id = {scene_corner(set->scene, f->object, 0)}};
    return SPLIT_CUT_ANYWAY;
}

static split_verdict cut_segment(split_set *set, const split_cylinder_frame *frame, const split_fragment *f,
                                 froe_cut *cut) {
    const froe_scene *scene = set->scene;
    stretch s = {.fragment = f, .u = scene_corner(scene, f->object, 0), .v = scene_corner(scene, f->object, 1)};
    if (!order_xy(scene_vertex(scene, s.u), scene_vertex(scene, s.v))) return cut_vertex(set, f, cut); /* vertical */
    for (uint32_t i = 0; i < 2; i++) s.end[i] = split_corner_of(set, f, i);
    s.edge = scene_start(scene, f->object);
    turn_right(scene, &s);
    const froe_cut line = edge_cut(scene, s.edge);
    return cut_stretch(set, frame, &s, &line, cut);
}

/** Length of an edge as seen from above, to choose by. */
static double edge_length(const froe_scene *scene, uint32_t edge) {
    uint32_t v[2];
    froe_scene_edge(scene, edge, v);
    const double *p = scene_vertex(scene, v[0]), *q = scene_vertex(scene, v[1]);
    double x = fabs(0.5 * p[0] - 0.5 * q[0]), y = fabs(0.5 * p[1] - 0.5 * q[1]);
    return x > y ? x : y;
}

/** Would a cut along the edge, by its number, change nothing? Where polygons cut each other, an edge on the border of
 * the cell need not be the one below or above, and to cut along it again would not end. */
static froe_status is_done(const split_cylinder *c, split_work *work, const split_cell *cell, uint32_t edge,
                           bool *done) {
    split_set *set = &work->set;
    froe_cut cut = edge_cut(set->scene, edge);
    split_tally n;
    uint32_t v[2];
    /* does it lie in the vertical plane below or above the cell? */
    const split_cylinder_frame f = frame_of(work, cell);
    froe_scene_edge(set->scene, edge, v);
    *done = false;
    for (int i = 0; i < 2 && !*done; i++) {
        if (f.edge[i] == FROE_NONE) continue;
        froe_cut border = edge_cut(set->scene, f.edge[i]);
        geom_plane plane = scene_cut_plane(set->scene, &border);
        *done = !geom_side_vertex(&set->context, &plane, scene_vertex(set->scene, v[0])) &&
                !geom_side_vertex(&set->context, &plane, scene_vertex(set->scene, v[1]));
    }
    if (*done || c->refuse) return FROE_OK;
    froe_status status = cell_tally(work, cell, &cut, &n);
    *done = !status && !split_tally_useful(n) && !n.both;
    return status;
}

/** The longest of the polygon's own edges that reaches into the cell, as the number of a corner of the fragment;
 * FROE_NONE: there is none. Longest, because that of an upright triangle covers it. With `given` it is the first, by
 * its number: an order that stays the same while the polygon moves, as partitions in motion have it. */
static froe_status own_edge(const split_cylinder *c, split_work *work, const split_cell *cell, const split_fragment *f,
                            uint32_t *at) {
    const split_set *set = &work->set;
    uint32_t count = split_corner_count(set, f), first = scene_start(set->scene, f->object), best = FROE_NONE;
    double longest = 0;
    *at = FROE_NONE;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t edge = split_corner_of(set, f, i).edge;
        if (edge & TREE_EDGE_CUT) continue;
        const double length = edge_length(set->scene, first + edge);
        const bool tied = c->given || length == longest;
        bool done = !(length > 0) || (best != FROE_NONE && !(tied ? edge < best : length > longest));
        froe_status status = done ? FROE_OK : is_done(c, work, cell, first + edge, &done);
        if (status) return status;
        if (!done) best = edge, *at = i, longest = length;
    }
    return FROE_OK;
}

static split_verdict cut_polygon(const split_cylinder *c, split_work *work, const split_cell *cell,
                                 const split_fragment *f, froe_cut *cut) {
    split_set *set = &work->set;
    const froe_scene *scene = set->scene;
    uint32_t at, edge = scene_start(scene, f->object);
    if (own_edge(c, work, cell, f, &at)) return SPLIT_MEMORY;
    if (at != FROE_NONE) {
        /* the edge from the corner, turned so that it runs to the right */
        stretch s = {.fragment = f, .end = {split_corner_of(set, f, at)}};
        uint32_t next = at + 1 < split_corner_count(set, f) ? at + 1 : 0, v[2];
        s.end[1] = split_corner_of(set, f, next);
        s.edge = edge + s.end[0].edge;
        froe_scene_edge(scene, s.edge, v);
        s.u = v[0], s.v = v[1];
        turn_right(scene, &s);
        froe_cut line = edge_cut(scene, s.edge);
        const split_cylinder_frame frame = frame_of(work, cell);
        return cut_stretch(set, &frame, &s, &line, cut);
    }
    /* The polygon's plane; or, of an upright one whose own edges do not reach into the cell, the same by an edge. A
     * segment, as seen from above, is upright. */
    geom_plane side = geom_plane_vertical(scene_point(scene, f->object, 0), scene_point(scene, f->object, 1));
    if (geom_side_vertex(&set->context, &side, scene_point(scene, f->object, 2))) {
        *cut = (froe_cut){.kind = FROE_CUT_OBJECT, .id = {f->object}};
    } else {
        while (!(edge_length(scene, edge) > 0)) edge++;
        *cut = edge_cut(scene, edge);
    }
    if (!c->refuse) return SPLIT_CUT_ANYWAY;
    /* the first polygon of the cell that crosses that plane */
    split_tally n;
    if (cell_tally(work, cell, cut, &n)) return SPLIT_MEMORY;
    if (!n.both) return SPLIT_CUT_ANYWAY;
    uint32_t i = 0;
    while (set->classes.data[i] != SPLIT_BOTH) i++;
    work->crossing[0] = f->object;
    work->crossing[1] = set->items.data[cell->first + i].object;
    return SPLIT_REFUSE;
}

/* ------------------------------------------------------------------- cells -- */

split_verdict split_cylinder_choose(const void *config, split_work *work, const split_cell *cell, froe_cut *cut) {
    const split_cylinder *c = config;
    if (cell->count <= c->leaf) return SPLIT_LEAF;
    if (c->deepest && cell->depth >= c->deepest) {
        atomic_store(c->too_deep, true);
        return SPLIT_GIVE_UP;
    }
    const split_fragment first = work->set.items.data[cell->first];
    const split_cylinder_frame frame = frame_of(work, cell);
    switch (scene_form(work->set.scene, first.object)) {
    case FROE_POINT:
        return cut_vertex(&work->set, &first, cut);
    case FROE_SEGMENT:
        return cut_segment(&work->set, &frame, &first, cut);
    default:
        return cut_polygon(c, work, cell, &first, cut);
    }
}

void split_cylinder_divided(const void *config, const split_work *work, const split_cell *cell, const froe_cut *cut,
                            bool guard, void *positive, void *negative) {
    (void)config;
    (void)guard;
    split_cylinder_frame above = frame_of(work, cell), below = above;
    if (is_wall(cut->kind)) {
        above.wall[LEFT] = below.wall[RIGHT] = cell->node;
    } else if (cut->kind == FROE_CUT_EDGE) { /* runs to the right: its positive side is above */
        above.edge[0] = cut->id[2];
        below.edge[1] = cut->id[2];
    }
    memcpy(positive, &above, sizeof above);
    memcpy(negative, &below, sizeof below);
}
