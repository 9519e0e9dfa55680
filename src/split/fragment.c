/* fragment.c: classifying and cutting one fragment, exactly. */
#include "split/fragment.h"
#include "geom/filter.h"
#include "geom/selftest.h"
#include <string.h>

froe_status split_set_new(const froe_scene *scene, const froe_allocator *alloc, split_set *out) {
    memset(out, 0, sizeof *out);
    out->scene = scene;
    out->alloc = *alloc;
    return geom_context_new(alloc, &out->context);
}

void split_set_free(split_set *set) {
    array_free(&set->alloc, &set->items);
    array_free(&set->alloc, &set->corners);
    array_free(&set->alloc, &set->sides);
    array_free(&set->alloc, &set->classes);
    array_free(&set->alloc, &set->spare);
    array_free(&set->alloc, &set->ring);
    num_context_free(&set->context);
}

/* ----------------------------------------------------------------- planes -- */

split_plane split_plane_of(const froe_scene *scene, const froe_cut *cut) {
    split_plane out = {.cut = *cut};
    if (cut->kind == FROE_CUT_AXIS && scene->dim > 3) { /* all that vertex_side() reads */
        out.plane.form = GEOM_AXIS;
        out.plane.axis = cut->axis;
        out.plane.c = cut->value;
        return out;
    }
    out.plane = scene_cut_plane(scene, cut);
    if (cut->kind == FROE_CUT_OBJECT) {
        uint32_t n = scene_corners(scene, cut->id[0]);
        for (; out.known_count < n && out.known_count < SPLIT_KNOWN; out.known_count++)
            out.known[out.known_count] = scene_point(scene, cut->id[0], out.known_count);
    } else if (cut->kind == FROE_CUT_VERTICES || cut->kind == FROE_CUT_EDGE) {
        out.known_count = cut->kind == FROE_CUT_EDGE ? 2 : (uint32_t)scene->dim;
        for (uint32_t i = 0; i < out.known_count; i++) out.known[i] = scene_vertex(scene, cut->id[i]);
    }
    return out;
}

froe_cut split_cut_at(const split_set *set, uint32_t node) {
    bool own = node >= set->draft->outer;
    const tree_draft *draft = own ? set->draft : set->main;
    return tree_cut_view(draft->nodes.data + (own ? node - set->draft->outer : node), draft->cuts.data,
                         draft->normals.data);
}

geom_plane split_plane_at(const split_set *set, uint32_t node) {
    froe_cut cut = split_cut_at(set, node);
    return scene_cut_plane(set->scene, &cut);
}

/* ------------------------------------------------------------------ sides -- */

static int known_side(split_set *set, int side) {
    set->context.stats.calls++;
    return num_by_id(&set->context, side);
}

/** Beyond the filter: a vertex that the plane contains by construction (equal coordinates are the
 * same vertex), or any other. */
static int near_vertex_side(split_set *set, const split_plane *plane, const double *x) {
    int dim = set->scene->dim;
    for (uint32_t i = 0; i < plane->known_count; i++) {
        const double *k = plane->known[i];
        if (k[0] == x[0] && k[1] == x[1] && (dim == 2 || k[2] == x[2])) return known_side(set, 0);
    }
    return geom_side_vertex(&set->context, &plane->plane, x);
}

static inline int vertex_side(split_set *set, const split_plane *plane, const double *x) {
    if (plane->plane.form == GEOM_AXIS) {
        double v = x[plane->plane.axis], c = plane->plane.c;
        return known_side(set, (v > c) - (v < c));
    }
    if (plane->plane.form == GEOM_AT_VERTEX) {
        const double *p = plane->plane.p[0];
        int k = x[0] == p[0]; /* the order by x, then y */
        return known_side(set, (x[k] > p[k]) - (x[k] < p[k]));
    }
    int side = set->context.first == NUM_FILTER ? filter_sign(filter_value(&plane->plane, x)) : NUM_UNSURE;
    return num_filtered_call(&set->context, side) == NUM_UNSURE ? near_vertex_side(set, plane, x) : side;
}

/** The side on which all corners of a small polygon are; NUM_UNSURE: there is none. */
static int object_side(split_set *set, const split_plane *plane, uint32_t object) {
    enum { SMALL = 4 };
    uint32_t n = scene_corners(set->scene, object);
    if (n > SMALL) return NUM_UNSURE;
    int side = vertex_side(set, plane, scene_point(set->scene, object, 0));
    for (uint32_t i = 1; i < n; i++)
        if (vertex_side(set, plane, scene_point(set->scene, object, i)) != side) return NUM_UNSURE;
    return side;
}

/** Beyond the filter, by the predicate of the corner; a crossing lies between two vertices first of all. */
static int corner_side(split_set *set, const split_plane *plane, uint32_t object, const split_corner *k) {
    if (k->type == SPLIT_CROSSING) {
        const double *from = scene_vertex(set->scene, k->a), *to = scene_vertex(set->scene, k->b);
        int u = vertex_side(set, plane, from), v = vertex_side(set, plane, to);
        if (u * v >= 0) return u ? u : v; /* it lies strictly between them */
        const geom_plane cut = split_plane_at(set, k->c);
        return geom_side_crossing(&set->context, &plane->plane, from, to, &cut);
    }
    const geom_plane first = split_plane_at(set, k->a), second = split_plane_at(set, k->b);
    geom_plane own;
    scene_support(set->scene, object, &own);
    return geom_side_corner(&set->context, &plane->plane, &own, &first, &second);
}

/** By the image of a corner that is no vertex; NUM_UNSURE: it is too near. */
static int image_sign(const split_set *set, const split_plane *plane, const split_corner *k) {
    return set->context.first == NUM_FILTER ? geom_side_image(&plane->plane, k->x, k->error) : NUM_UNSURE;
}

int split_image_side(split_set *set, const split_plane *plane, const split_corner *k) {
    return num_filtered_call(&set->context, image_sign(set, plane, k));
}

int split_vertex_side(split_set *set, const split_plane *plane, const double *x) {
    return vertex_side(set, plane, x);
}

int split_corner_side(split_set *set, const split_plane *plane, uint32_t object, const split_corner *k) {
    if (k->type == SPLIT_VERTEX) return vertex_side(set, plane, k->x);
    int side = split_image_side(set, plane, k);
    /* by the sides of the corners of the object where these tell */
    if (side == NUM_UNSURE && k->type == SPLIT_CORNER) side = object_side(set, plane, object);
    return side == NUM_UNSURE ? corner_side(set, plane, object, k) : side;
}

static int class_of_sides(bool negative, bool positive) {
    return negative ? (positive ? SPLIT_BOTH : SPLIT_NEG) : positive ? SPLIT_POS : SPLIT_ON;
}

/** Of what lies on one side. */
static int class_beside(int side) {
    return side < 0 ? SPLIT_NEG : side > 0 ? SPLIT_POS : SPLIT_ON;
}

/** Appends the sides of all corners, of the ring or of the whole object, and returns the class. */
static int corner_sides(split_set *set, const split_plane *plane, const split_fragment *f) {
    const split_corner *ring = f->count ? set->corners.data + f->first : NULL;
    uint32_t n = split_corner_count(set, f);
    bool negative = false, positive = false;
    for (uint32_t i = 0; i < n; i++) {
        int side =
            ring ? split_corner_side(set, plane, f->object, ring + i) : vertex_side(set, plane, split_image(set, f, i));
        negative |= side < 0;
        positive |= side > 0;
        set->sides.data[set->sides.count++] = (int8_t)side;
    }
    return class_of_sides(negative, positive);
}

static int classify_corners(split_set *set, const split_plane *plane, const split_fragment *f, bool is_cut) {
    size_t start = set->sides.count;
    if (plane->plane.form == GEOM_AXIS && !f->count) {
        /* whole objects beside x[axis] = c, by comparisons alone */
        uint32_t n = split_corner_count(set, f);
        bool negative = false, positive = false;
        set->context.stats.calls += n;
        set->context.stats.by_id += n;
        for (uint32_t i = 0; i < n; i++) {
            double x = split_image(set, f, i)[plane->plane.axis];
            negative |= x < plane->plane.c;
            positive |= x > plane->plane.c;
        }
        int class = class_of_sides(negative, positive);
        if (class == SPLIT_BOTH && is_cut) corner_sides(set, plane, f);
        return class;
    }
    int class = corner_sides(set, plane, f);
    if (class != SPLIT_BOTH || !is_cut) set->sides.count = start;
    return class;
}

int split_classify(split_set *set, const split_plane *plane, const split_fragment *f) {
    froe_kind form = scene_form(set->scene, f->object);
    if (plane->cut.kind == FROE_CUT_OBJECT && plane->cut.id[0] == f->object) return SPLIT_ON;
    if (form == FROE_SEGMENT && !f->count && plane->plane.form == GEOM_POINTS && plane->plane.dim == 2 &&
        set->context.first == NUM_FILTER) {
        /* whole segments beside a line, the commonest case of all */
        const double *u = split_image(set, f, 0), *v = split_image(set, f, 1);
        int a = filter_beside_line(&plane->plane, u), b = filter_beside_line(&plane->plane, v);
        unsigned sure = (a != NUM_UNSURE) + (b != NUM_UNSURE);
        set->context.stats.calls += sure;
        set->context.stats.filtered += sure;
        if (a == NUM_UNSURE) a = near_vertex_side(set, plane, u);
        if (b == NUM_UNSURE) b = near_vertex_side(set, plane, v);
        if (a * b < 0) {
            set->sides.data[set->sides.count++] = (int8_t)a;
            set->sides.data[set->sides.count++] = (int8_t)b;
        }
        return class_of_sides((a < 0) | (b < 0), (a > 0) | (b > 0));
    }
    if (form == FROE_BALL) {
        int side = geom_side_ball(&set->context, &plane->plane, scene_point(set->scene, f->object, 0),
                                  scene_radius(set->scene, f->object));
        return side == 2 ? SPLIT_BOTH : class_beside(side);
    }
    if (form == FROE_BOX && plane->plane.form != GEOM_AXIS) {
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        scene_object_bounds(set->scene, f->object, lo, hi);
        const int side = geom_side_box(&set->context, &plane->plane, lo, hi);
        return side == 2 ? SPLIT_BOTH : class_beside(side);
    }
    return classify_corners(set, plane, f, split_is_cut(form));
}

int split_class(split_set *set, const split_plane *plane, const split_fragment *f) {
    bool known = plane->cut.kind == FROE_CUT_OBJECT && plane->cut.id[0] == f->object;
    if (f->count && !known) {
        /* The class of a ring alone. Whether a plane splits it is mostly seen from corners that are far from the
         * plane; only where they do not tell are the others worth exact numbers, and only until both sides are met. */
        const split_corner *ring = set->corners.data + f->first;
        bool negative = false, positive = false, unsure = false;
        for (uint32_t i = 0; i < f->count && !(negative && positive); i++) {
            int side = ring[i].type == SPLIT_VERTEX ? vertex_side(set, plane, ring[i].x)
                                                    : split_image_side(set, plane, ring + i);
            unsure |= side == NUM_UNSURE;
            negative |= side == -1;
            positive |= side == 1;
        }
        if (!unsure || (negative && positive)) return class_of_sides(negative, positive);
        const int whole = object_side(set, plane, f->object);
        if (whole != NUM_UNSURE) return class_beside(whole);
        for (uint32_t i = 0; i < f->count && !(negative && positive); i++) {
            if (ring[i].type == SPLIT_VERTEX || image_sign(set, plane, ring + i) != NUM_UNSURE) continue;
            int side = corner_side(set, plane, f->object, ring + i);
            negative |= side < 0;
            positive |= side > 0;
        }
        return class_of_sides(negative, positive);
    }
    const size_t start = set->sides.count;
    const int class = split_classify(set, plane, f);
    set->sides.count = start;
    return class;
}

/* ---------------------------------------------------------------- cutting -- */

split_corner split_corner_of(const split_set *set, const split_fragment *f, uint32_t i) {
    if (f->count) return set->corners.data[f->first + i];
    split_corner k = {.edge = i, .type = SPLIT_VERTEX, .a = scene_corner(set->scene, f->object, i)};
    memcpy(k.x, scene_vertex(set->scene, k.a), (size_t)set->scene->dim * sizeof *k.x);
    return k;
}

/** Where an edge of the object crosses the plane: edge i of a polygon, or a segment (i = 0). */
static split_corner corner_at_crossing(split_set *set, const split_plane *plane, uint32_t node, uint32_t object,
                                       uint32_t i) {
    uint32_t n = scene_corners(set->scene, object);
    split_corner k = {.type = SPLIT_CROSSING, .c = node};
    k.a = scene_corner(set->scene, object, i);
    k.b = scene_corner(set->scene, object, i + 1 < n ? i + 1 : 0);
    const double *u = scene_vertex(set->scene, k.a), *v = scene_vertex(set->scene, k.b);
    k.error = geom_image_crossing(u, v, &plane->plane, k.x);
    geom_relative_crossing(u, v, &plane->plane, scene_point(set->scene, object, 0), k.apart);
    return k;
}

/** Where the edge that an earlier cut made crosses the plane. */
static split_corner meeting(split_set *set, const split_plane *plane, uint32_t node, uint32_t object, uint32_t cutter) {
    split_corner k = {.type = SPLIT_CORNER, .a = cutter, .b = node};
    geom_plane own, first = split_plane_at(set, cutter);
    scene_support(set->scene, object, &own);
    k.error = geom_image_corner(&own, &first, &plane->plane, k.x);
    geom_relative_corner(&first, &plane->plane, &own, scene_point(set->scene, object, 0), k.apart);
    return k;
}

/** Appends a corner; the caller has made room. */
static void put_corner(split_set *set, split_fragment *f, split_corner corner, uint32_t edge) {
    corner.edge = edge;
    set->corners.data[f->first + f->count++] = corner;
}

static void divide_segment(split_set *set, const split_plane *plane, uint32_t node, const split_fragment *f,
                           const int8_t *sides, split_fragment *const side[2]) {
    split_corner start = split_corner_of(set, f, 0), end = split_corner_of(set, f, 1);
    split_corner middle = corner_at_crossing(set, plane, node, f->object, 0);
    split_fragment *first = side[sides[0] > 0], *last = side[sides[0] < 0];
    put_corner(set, first, start, start.edge);
    put_corner(set, first, middle, TREE_EDGE_CUT | node);
    put_corner(set, last, middle, TREE_EDGE_CUT | node);
    put_corner(set, last, end, end.edge);
}

static void divide_polygon(split_set *set, const split_plane *plane, uint32_t node, const split_fragment *f,
                           const int8_t *sides, split_fragment *const side[2]) {
    uint32_t n = split_corner_count(set, f), cut = TREE_EDGE_CUT | node;
    for (uint32_t i = 0; i < n; i++) {
        split_corner k = split_corner_of(set, f, i);
        int here = sides[i], next = sides[i + 1 < n ? i + 1 : 0];
        if (here)
            put_corner(set, side[here > 0], k, k.edge);
        else { /* in the plane: the edge leaving it belongs to the side it leads to */
            put_corner(set, side[0], k, next < 0 ? k.edge : cut);
            put_corner(set, side[1], k, next > 0 ? k.edge : cut);
        }
        if (here * next >= 0) continue;
        split_corner x = k.edge & TREE_EDGE_CUT ? meeting(set, plane, node, f->object, k.edge & ~TREE_EDGE_CUT)
                                                : corner_at_crossing(set, plane, node, f->object, k.edge);
        put_corner(set, side[here > 0], x, cut);
        put_corner(set, side[here < 0], x, k.edge);
    }
}

froe_status split_divide(split_set *set, const split_plane *plane, uint32_t node, const split_fragment *f,
                         const int8_t *sides, split_fragment *negative, split_fragment *positive) {
    uint32_t n = split_corner_count(set, f), room = n + 2; /* a convex ring gains at most one corner a side */
    if (set->corners.count + 2 * (size_t)room > INT32_MAX) return FROE_E_LIMIT;
    if (!array_reserve(&set->alloc, &set->corners, 2 * (size_t)room)) return FROE_E_MEMORY;
    uint32_t top = (uint32_t)set->corners.count;
    *negative = (split_fragment){f->object, top, 0};
    *positive = (split_fragment){f->object, top + room, 0};
    split_fragment *const side[2] = {negative, positive};
    if (scene_form(set->scene, f->object) == FROE_SEGMENT)
        divide_segment(set, plane, node, f, sides, side);
    else
        divide_polygon(set, plane, node, f, sides, side);
    uint32_t second = top + negative->count; /* close the gap between the two rings */
    memmove(set->corners.data + second, set->corners.data + positive->first, positive->count * sizeof(split_corner));
    positive->first = second;
    set->corners.count = second + positive->count;
    return FROE_OK;
}

froe_status split_emit(split_set *set, uint32_t node, const split_fragment *f) {
    uint32_t local = node - set->draft->outer;
    if (!f->count) return draft_piece(set->draft, local, f->object, NULL, 0);
    set->ring.count = 0;
    if (!array_reserve(&set->alloc, &set->ring, f->count)) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < f->count; i++) set->ring.data[set->ring.count++] = set->corners.data[f->first + i].edge;
    return draft_piece(set->draft, local, f->object, set->ring.data, f->count);
}
