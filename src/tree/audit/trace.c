/* trace.c: carrying points, segments and polygons down a tree, exactly. */
#include "tree/audit/trace.h"
#include "geom/selftest.h"
#include <math.h>
#include <string.h>

froe_status trace_new(const froe_tree *tree, bool exact_only, tree_trace *out) {
    memset(out, 0, sizeof *out);
    out->alloc = tree->alloc;
    froe_status status = geom_context_new(&tree->alloc, &out->context);
    if (status) return status;
    out->tree = tree;
    if (exact_only) out->context.first = NUM_EXACT;
    out->planes = support_calloc(&out->alloc, 1, sizeof *out->planes);
    return out->planes ? FROE_OK : FROE_E_MEMORY;
}

void trace_free(tree_trace *t) {
    array_free(&t->alloc, &t->corners);
    array_free(&t->alloc, &t->parts);
    array_free(&t->alloc, &t->solids);
    array_free(&t->alloc, &t->sides);
    array_free(&t->alloc, &t->ring);
    support_free(&t->alloc, t->planes, sizeof *t->planes);
    if (t->tree) num_context_free(&t->context);
}

const geom_plane *trace_plane(tree_trace *t, uint32_t node) {
    uint32_t slot = node % TRACE_PLANES;
    if (t->planes->id1[slot] != node + 1) {
        t->planes->plane[slot] = tree_plane_at(t->tree, node);
        t->planes->id1[slot] = node + 1;
    }
    return t->planes->plane + slot;
}

/* ------------------------------------------------------------------- sides -- */

/* The side of a corner of a part: by its image, or exactly by what meets there. */
static int corner_side(tree_trace *t, const geom_plane *plane, const trace_part *part, uint32_t i) {
    const froe_scene *s = t->tree->scene;
    const trace_corner *c = t->corners.data + part->first;
    if (t->context.first == NUM_FILTER && isfinite(c[i].error)) {
        int side = geom_side_image(plane, c[i].x, c[i].error);
        if (side != NUM_UNSURE) return side;
    }
    froe_kind form = scene_form(s, t->object);
    if (form == FROE_POINT) return geom_side_vertex(&t->context, plane, scene_point(s, t->object, 0));
    ring_point p = form == FROE_SEGMENT ? ring_end(s, t->object, c[i].edge)
                                        : ring_corner(s, t->object, c[i ? i - 1 : part->count - 1].edge, c[i].edge);
    if (p.kind == RING_VERTEX) return geom_side_vertex(&t->context, plane, p.x);
    geom_plane a = tree_plane_at(t->tree, p.a), b, support;
    if (p.kind == RING_CROSSING) return geom_side_crossing(&t->context, plane, p.u, p.v, &a);
    b = tree_plane_at(t->tree, p.b);
    scene_support(s, t->object, &support);
    return geom_side_corner(&t->context, plane, &support, &a, &b);
}

/* The one side of a plain node on which all corners surely are, as bits; 0: not known. An axis-parallel cut needs no
 * plane, as long as the images are sure. */
static unsigned plain_side(const tree_trace *t, const trace_part *part) {
    const tree_node *n = t->tree->nodes + part->node;
    unsigned reached = 0;
    if (n->type != TREE_PLAIN || t->context.first != NUM_FILTER || t->tree->scene->dim > 3) return 0;
    for (uint32_t i = 0; i < part->count; i++) {
        const trace_corner *c = t->corners.data + part->first + i;
        double beyond = c->x[n->axis] - n->u.value;
        if (c->error != 0 && !(fabs(beyond) > c->error * (1 + 0x1p-50))) return 0;
        if (beyond != 0) reached |= beyond > 0 ? 2 : 1;
    }
    return reached == 3 ? 0 : reached;
}

/* ---------------------------------------------------------------- dividing -- */

/* Where the own edge that begins at `corner` crosses the plane. */
static trace_corner own_crossing(const tree_trace *t, const geom_plane *plane, uint32_t corner, uint32_t edge) {
    const froe_scene *s = t->tree->scene;
    uint32_t next = corner + 1 < scene_corners(s, t->object) ? corner + 1 : 0;
    trace_corner c = {.edge = edge};
    c.error = geom_image_crossing(scene_point(s, t->object, corner), scene_point(s, t->object, next), plane, c.x);
    return c;
}

/* Where an edge of the part, own or made by a cut, crosses the plane. */
static trace_corner edge_crossing(const tree_trace *t, const geom_plane *plane, uint32_t crossed, uint32_t edge) {
    if (!(crossed & TREE_EDGE_CUT)) return own_crossing(t, plane, crossed, edge);
    trace_corner c = {.edge = edge};
    geom_plane support, a = tree_plane_at(t->tree, crossed & ~TREE_EDGE_CUT);
    scene_support(t->tree->scene, t->object, &support);
    c.error = geom_image_corner(&support, &a, plane, c.x);
    return c;
}

static void put_trace_corner(tree_trace *t, trace_corner c, uint32_t edge) {
    c.edge = edge;
    t->corners.data[t->corners.count++] = c;
}

/* Appends the polygon's part on one side. The edge in the plane comes where the ring leaves that side. */
static void polygon_side(tree_trace *t, const geom_plane *plane, const trace_part *part, uint32_t cut, int side) {
    const int8_t *sides = t->sides.data;
    for (uint32_t i = 0; i < part->count; i++) {
        trace_corner c = t->corners.data[part->first + i];
        int here = sides[i] * side, next = sides[i + 1 < part->count ? i + 1 : 0] * side;
        if (here > 0 || (here == 0 && next > 0)) put_trace_corner(t, c, c.edge);
        if (here == 0 && next <= 0) put_trace_corner(t, c, cut);
        if (here > 0 && next < 0) put_trace_corner(t, edge_crossing(t, plane, c.edge, cut), cut);
        if (here < 0 && next > 0) put_trace_corner(t, edge_crossing(t, plane, c.edge, c.edge), c.edge);
    }
}

static void segment_side(tree_trace *t, const geom_plane *plane, const trace_part *part, uint32_t cut, int side) {
    for (uint32_t i = 0; i < 2; i++) {
        trace_corner c = t->corners.data[part->first + i];
        put_trace_corner(t, t->sides.data[i] * side > 0 ? c : own_crossing(t, plane, 0, cut),
                         t->sides.data[i] * side > 0 ? c.edge : cut);
    }
}

/* Replaces a part by its two sides: the positive one waits, the negative one is next. */
static froe_status divide_trace(tree_trace *t, const geom_plane *plane, trace_part *part) {
    uint32_t room = part->count + 2, top = part->first + part->count, cut = TREE_EDGE_CUT | part->node;
    uint32_t child = t->tree->nodes[part->node].child, middle;
    bool segment = scene_form(t->tree->scene, t->object) == FROE_SEGMENT;
    if (!array_reserve(&t->alloc, &t->corners, 2 * (size_t)room) || !array_reserve(&t->alloc, &t->parts, 1))
        return FROE_E_MEMORY;
    t->corners.count = top;
    segment ? segment_side(t, plane, part, cut, 1) : polygon_side(t, plane, part, cut, 1);
    middle = (uint32_t)t->corners.count;
    segment ? segment_side(t, plane, part, cut, -1) : polygon_side(t, plane, part, cut, -1);
    memmove(t->corners.data + part->first, t->corners.data + top, (t->corners.count - top) * sizeof(trace_corner));
    t->corners.count -= part->count;
    middle -= part->count;
    t->parts.data[t->parts.count++] = (trace_part){child + 1, part->first, middle - part->first};
    *part = (trace_part){child, middle, (uint32_t)t->corners.count - middle};
    return FROE_OK;
}

/* ----------------------------------------------------------------- tracing -- */

/* Follows one part until it arrives; what is cut off on the way waits. Sides of corners are kept in t->sides. */
static froe_status follow_object(tree_trace *t, trace_part part) {
    while (!tree_is_leaf(t->tree->nodes + part.node)) {
        unsigned reached = plain_side(t, &part);
        if (reached) {
            part.node = t->tree->nodes[part.node].child + (reached == 2);
            continue;
        }
        const geom_plane *plane = trace_plane(t, part.node);
        t->sides.count = 0;
        if (!array_reserve(&t->alloc, &t->sides, part.count)) return FROE_E_MEMORY;
        for (uint32_t i = 0; i < part.count; i++) {
            int side = corner_side(t, plane, &part, i);
            t->sides.data[t->sides.count++] = (int8_t)side;
            if (side) reached |= side > 0 ? 2 : 1;
        }
        if (!reached) break;
        if (reached == 3) {
            froe_status status = divide_trace(t, plane, &part);
            if (status) return status;
        } else {
            part.node = t->tree->nodes[part.node].child + (reached == 2);
        }
    }
    trace_place place = {.node = part.node, .must = true, .count = part.count};
    t->ring.count = 0;
    if (!array_reserve(&t->alloc, &t->ring, part.count)) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < part.count; i++) t->ring.data[t->ring.count++] = t->corners.data[part.first + i].edge;
    place.ring = t->ring.data;
    t->stopped = !t->fn(t->user, &place);
    return FROE_OK;
}

froe_status trace_object(tree_trace *t, uint32_t object, trace_fn *fn, trace_cover_fn *covers, void *user) {
    const froe_scene *s = t->tree->scene;
    const uint32_t count = scene_corners(s, object);
    const size_t bytes = (size_t)(s->dim < 3 ? s->dim : 3) * sizeof(double);
    froe_status status = FROE_OK;
    t->object = object;
    t->fn = fn;
    t->cover_fn = covers;
    t->user = user;
    t->stopped = false;
    if (scene_form(s, object) > FROE_POLYGON) return trace_solid_object(t);
    t->corners.count = t->parts.count = 0;
    if (!array_reserve(&t->alloc, &t->corners, count)) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < count; i++) {
        trace_corner c = {.edge = i, .error = s->dim > 3 ? INFINITY : 0};
        memcpy(c.x, scene_point(s, object, i), bytes);
        t->corners.data[t->corners.count++] = c;
    }
    if (!array_push(&t->alloc, &t->parts, (trace_part){0, 0, count})) return FROE_E_MEMORY;
    while (!status && !t->stopped && t->parts.count) {
        trace_part part = t->parts.data[--t->parts.count];
        t->corners.count = part.first + part.count;
        status = follow_object(t, part);
    }
    return status;
}
