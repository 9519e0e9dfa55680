/* view.c: laying out a cell and counting beside planes. */
#include "split/score/view.h"
#include "base/random.h"
#include "base/sort.h"
#include "split/axes.h"
#include "support/axes.h"
#include <math.h>
#include <string.h>

void split_view_free(const froe_allocator *alloc, split_view *v) {
    array_free(alloc, &v->x);
    array_free(alloc, &v->y);
    array_free(alloc, &v->z);
    array_free(alloc, &v->radius);
    array_free(alloc, &v->vertex);
    array_free(alloc, &v->vertices);
    array_free(alloc, &v->side);
    array_free(alloc, &v->start);
    array_free(alloc, &v->corner);
    array_free(alloc, &v->fours);
    array_free(alloc, &v->many);
    array_free(alloc, &v->item);
    array_free(alloc, &v->marked);
    array_free(alloc, &v->sides);
    array_free(alloc, &v->values);
    array_free(alloc, &v->low);
    array_free(alloc, &v->high);
    if (v->place) support_free(alloc, v->place, v->place_count * sizeof *v->place);
    v->place = NULL;
}

/* ---------------------------------------------------------------- filling -- */

static bool reserve_view(split_view *v, const froe_allocator *alloc, uint32_t corners) {
    v->y.count = v->z.count = v->radius.count = v->x.count;
    return array_reserve(alloc, &v->x, corners) && array_reserve(alloc, &v->y, corners) &&
           array_reserve(alloc, &v->z, corners) && array_reserve(alloc, &v->radius, corners) &&
           array_reserve(alloc, &v->vertex, corners) && array_reserve(alloc, &v->vertices, corners) &&
           array_reserve(alloc, &v->corner, corners) && array_reserve(alloc, &v->start, 1);
}

/** Half the way from the origin of the view to a point of the scene: a difference of halves, which never overflows. */
static void half_way(const split_view *v, const double *x, double out[3]) {
    for (int k = 0; k < 3; k++) out[k] = k < v->dim ? 0.5 * x[k] - v->origin[k] : 0;
}

/** The same to the i-th corner of a fragment; returns the input vertex that it is, or FROE_NONE. */
static uint32_t half_way_to_corner(const split_view *v, const split_set *set, const split_fragment *f, uint32_t i,
                                   double out[3]) {
    const split_corner *k = f->count ? set->corners.data + f->first + i : NULL;
    const uint32_t vertex = !k ? scene_corner(set->scene, f->object, i) : k->type == SPLIT_VERTEX ? k->a : FROE_NONE;
    const bool image = k && !v->swept && isfinite(k->x[0]) && isfinite(k->x[1]) && (v->dim == 2 || isfinite(k->x[2]));
    const double *first = scene_point(set->scene, f->object, 0);
    half_way(v, vertex != FROE_NONE ? scene_vertex(set->scene, vertex) : image ? k->x : first, out);
    for (int a = 0; a < v->dim && vertex == FROE_NONE && v->swept; a++) out[a] += 0.5 * k->apart[a];
    return vertex;
}

/** A corner of its own, half way from the origin for now. */
static uint32_t add_view_corner(split_view *v, const double half[3], double radius, uint32_t vertex) {
    uint32_t at = (uint32_t)v->x.count++;
    v->x.data[at] = half[0];
    v->y.data[at] = half[1];
    v->z.data[at] = half[2];
    v->radius.data[at] = radius;
    v->vertex.data[at] = vertex;
    v->vertex.count = at + 1;
    return at;
}

static uint32_t add_view_vertex(split_view *v, const froe_scene *scene, uint32_t vertex) {
    uint32_t at = v->place[vertex];
    if (at != FROE_NONE) return at;
    double half[3];
    half_way(v, scene_vertex(scene, vertex), half);
    v->place[vertex] = at = add_view_corner(v, half, 0, vertex);
    v->vertices.data[v->vertices.count++] = at;
    return at;
}

/** Of the fragment that came last. */
static void note_four(split_view *v) {
    const uint32_t i = (uint32_t)v->start.count - 2, *corner = v->corner.data + v->start.data[i];
    const uint32_t n = v->start.data[i + 1] - v->start.data[i];
    for (uint32_t j = 0; j < 4; j++) v->fours.data[v->fours.count++] = n > 4 ? 0 : 1 + corner[j < n ? j : n - 1];
    if (n > 4) v->many.data[v->many.count++] = i;
}

static bool add_view_fragment(split_view *v, const split_set *set, const split_fragment *item) {
    const froe_scene *scene = set->scene;
    froe_kind form = scene_form(scene, item->object);
    bool solid = form == FROE_BOX || form == FROE_BALL;
    double half[3];
    uint32_t n = solid ? 1u << v->dim : split_corner_count(set, item);
    if (!reserve_view(v, &set->alloc, n)) return false;
    if (solid) {
        /* the corners of a box, or the centre of a ball: no vertices of the scene */
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], x[3], radius = 0;
        unsigned corners = 1u << v->dim;
        scene_object_bounds(scene, item->object, lo, hi);
        if (scene_form(scene, item->object) == FROE_BALL) {
            radius = scene_radius(scene, item->object);
            memcpy(lo, scene_point(scene, item->object, 0), (size_t)v->dim * sizeof *lo);
            v->round = true;
            corners = 1;
        }
        for (unsigned i = 0; i < corners; i++) {
            for (int k = 0; k < v->dim; k++) x[k] = i >> k & 1 ? hi[k] : lo[k];
            half_way(v, x, half);
            v->corner.data[v->corner.count++] = add_view_corner(v, half, radius, FROE_NONE);
        }
    }
    for (uint32_t i = 0; i < n && !solid; i++) {
        const uint32_t vertex = half_way_to_corner(v, set, item, i, half);
        v->corner.data[v->corner.count++] =
            vertex != FROE_NONE ? add_view_vertex(v, scene, vertex) : add_view_corner(v, half, 0, FROE_NONE);
    }
    v->start.data[v->start.count++] = (uint32_t)v->corner.count;
    note_four(v);
    return true;
}

/** Segments in the plane, shown whole: the commonest case by far. False: there are others, nothing was done. */
static bool fill_pairs(split_view *v, const split_set *set, const split_fragment *items) {
    double *x = v->x.data, *y = v->y.data;
    for (uint32_t i = 0; i < v->count; i++) {
        if (split_corner_count(set, items + i) != 2 || scene_form(set->scene, items[i].object) != FROE_SEGMENT)
            return false;
        for (uint32_t k = 0; k < 2; k++, x++, y++) {
            const double *p = split_image(set, items + i, k);
            if (!isfinite(p[0]) || !isfinite(p[1])) p = scene_point(set->scene, items[i].object, 0);
            *x = 0.5 * p[0];
            *y = 0.5 * p[1];
        }
    }
    v->x.count = v->corners = 2 * v->count;
    return true;
}

/** Two vertices of every object shown, on average, where corners are few. */
static bool add_outside(split_view *v, const split_set *set, const split_cell *cell, uint64_t seed) {
    const split_fragment *items = set->items.data + cell->first;
    if (v->inside >= v->count) return true;
    if (!reserve_view(v, &set->alloc, 2 * v->count)) return false;
    for (uint32_t i = 0; i < 2 * v->count; i++) {
        uint64_t hash = base_hash(seed, cell->path, 0x20000000 + i);
        uint32_t object = items[base_below(hash, cell->count)].object;
        uint32_t corner = base_below(base_mix(hash), scene_corners(set->scene, object));
        add_view_vertex(v, set->scene, scene_corner(set->scene, object, corner));
    }
    return true;
}

/** Where vertices are in the view: nowhere yet. Made once it is needed. */
static bool make_places(split_view *v, const split_set *set) {
    uint32_t count = set->scene->vertex_count;
    if (v->place) return true;
    v->place = support_calloc(&set->alloc, count, sizeof *v->place);
    if (!v->place) return false;
    v->place_count = count;
    memset(v->place, 0xff, count * sizeof *v->place);
    return true;
}

/** A step through n numbers that comes to each of them once, and spreads the first of them over all: next to n times
 * the golden ratio, without a common divisor. */
static uint32_t spreading_step(uint32_t n) {
    for (uint32_t step = (uint32_t)(0.6180339887498949 * n);; step--) {
        uint32_t a = n, b = step;
        while (b) {
            const uint32_t rest = a % b;
            a = b;
            b = rest;
        }
        if (a == 1 || step < 2) return step > 1 ? step : 1;
    }
}

/** Fragments in the order of the cell; in views for sweeps so that the first few come from all over it. */
static bool fill_fragments(split_view *v, const split_set *set, const split_cell *cell, bool all, uint64_t seed) {
    const split_fragment *items = set->items.data + cell->first;
    const uint32_t step = all && v->swept ? spreading_step(v->count) : 1;
    if (!array_reserve(&set->alloc, &v->item, v->count) || !array_reserve(&set->alloc, &v->many, v->count) ||
        !array_reserve(&set->alloc, &v->fours, 4 * (size_t)v->count))
        return false;
    for (uint32_t i = 0, next = 0; i < v->count; i++, next = (uint32_t)(((uint64_t)next + step) % v->count)) {
        const uint32_t pick = all ? next : base_below(base_hash(seed, cell->path, 0x10000000 + i), cell->count);
        v->item.data[v->item.count++] = pick;
        if (!add_view_fragment(v, set, items + pick)) return false;
        if (i < SPLIT_VIEW_FEW) v->few_corners = (uint32_t)v->x.count;
    }
    v->corners = (uint32_t)v->x.count;
    v->inside = (uint32_t)v->vertices.count;
    return true;
}

bool split_view_fill(split_view *v, const split_set *set, const split_cell *cell, uint32_t sample, uint64_t seed,
                     bool swept) {
    const split_fragment *items = set->items.data + cell->first;
    bool all = cell->count <= sample;
    v->count = all ? cell->count : sample;
    v->weight = (double)cell->count / v->count;
    if (set->scene->dim > 3) return true;
    /* forgets the last cell */
    v->dim = set->scene->dim;
    v->swept = swept;
    for (int k = 0; k < v->dim; k++) v->origin[k] = swept ? 0.5 * scene_point(set->scene, items->object, 0)[k] : 0;
    v->pairs = v->round = false;
    for (size_t i = 0; i < v->vertices.count; i++) v->place[v->vertex.data[v->vertices.data[i]]] = FROE_NONE;
    v->x.count = v->vertex.count = v->vertices.count = v->start.count = v->corner.count = v->side.count = 0;
    v->fours.count = v->many.count = v->item.count = v->marked.count = v->sides.count = v->marks = v->checked_count = 0;
    if (!reserve_view(v, &set->alloc, 2 * v->count) || !array_reserve(&set->alloc, &v->marked, v->count) ||
        !array_reserve(&set->alloc, &v->sides, v->count))
        return false;
    memset(v->marked.data, 0, v->count);
    v->pairs = set->scene->dim == 2 && all && !swept && fill_pairs(v, set, items);
    if (!v->pairs) {
        if (!make_places(v, set)) return false;
        v->start.data[v->start.count++] = 0;
        if (!fill_fragments(v, set, cell, all, seed)) return false;
        if (!array_reserve(&set->alloc, &v->side, v->corners + (size_t)1)) return false;
        if (swept && !add_outside(v, set, cell, seed)) return false;
    }
    /* to local coordinates, by a power of two at most twice the width of the corners */
    double *const x[3] = {v->x.data, v->y.data, v->z.data}, width = 0;
    int exponent = 0;
    for (int k = 0; k < v->dim; k++) {
        double lo = x[k][0], hi = x[k][0];
        for (uint32_t i = 1; i < v->corners; i++) {
            lo = x[k][i] < lo ? x[k][i] : lo;
            hi = x[k][i] > hi ? x[k][i] : hi;
        }
        v->middle[k] = 0.5 * lo + 0.5 * hi;
        width = hi - lo > width ? hi - lo : width;
    }
    if (width > 0) frexp(width, &exponent); /* width < 2^exponent; local coordinates are at most half as large */
    v->scale = ldexp(1, exponent < -1000 ? 1000 : -exponent);
    for (int k = 0; k < 3; k++) v->reach[k] = k < v->dim ? 2 * fabs(v->origin[k] + v->middle[k]) * v->scale + 0.5 : 0;
    for (int k = 0; k < v->dim; k++)
        for (size_t i = 0; i < v->x.count; i++) x[k][i] = (x[k][i] - v->middle[k]) * v->scale;
    for (size_t i = 0; i < v->x.count && v->round; i++) v->radius.data[i] *= 0.5 * v->scale;
    return true;
}

split_view_part split_view_part_of(const split_view *v, bool few) {
    const uint32_t outside = (uint32_t)v->x.count - v->corners;
    if (!few || v->count <= SPLIT_VIEW_FEW) return (split_view_part){v->count, v->corners, outside, v->weight};
    const double weight = v->weight * v->count / SPLIT_VIEW_FEW;
    return (split_view_part){SPLIT_VIEW_FEW, v->few_corners,
                             outside < 2 * SPLIT_VIEW_FEW ? outside : 2 * SPLIT_VIEW_FEW, weight};
}

bool split_view_add(split_view *v, const split_set *set, const uint32_t *vertices, uint32_t count) {
    if (v->pairs) return true;
    if (!reserve_view(v, &set->alloc, count)) return false;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t before = (uint32_t)v->x.count, at = add_view_vertex(v, set->scene, vertices[i]);
        double local[3];
        if (at < before) continue;
        split_view_local(v, scene_vertex(set->scene, vertices[i]), local);
        v->x.data[at] = local[0];
        v->y.data[at] = local[1];
        v->z.data[at] = local[2];
    }
    return true;
}

void split_view_find_outermost(split_view *v, const froe_scene *scene) {
    if (v->outermost_count) return;
    v->outermost_count = 2 * (uint32_t)scene->dim;
    memset(v->outermost, 0, sizeof v->outermost);
    for (uint32_t i = 1; i < scene->vertex_count; i++) {
        const double *x = scene_vertex(scene, i);
        for (int k = 0; k < scene->dim; k++) {
            if (x[k] < scene_vertex(scene, v->outermost[2 * k])[k]) v->outermost[2 * k] = i;
            if (x[k] > scene_vertex(scene, v->outermost[2 * k + 1])[k]) v->outermost[2 * k + 1] = i;
        }
    }
}

/* ----------------------------------------------------------------- planes -- */

void split_view_local(const split_view *v, const double *x, double out[3]) {
    half_way(v, x, out);
    for (int k = 0; k < v->dim; k++) out[k] = (out[k] - v->middle[k]) * v->scale;
}

/** Planes that agree up to the rounding of the scene's coordinates are meant as one. Views for sweeps are stricter:
 * their best is counted again. */
static double slack_of(const split_view *v, const split_view_plane *plane) {
    double sum = fabs(plane->d);
    for (int k = 0; k < 3; k++) sum += fabs(plane->n[k]) * v->reach[k];
    return 0x1p-49 * sum;
}

/** The vector between two vertices in the first `dim` coordinates, and its squared length. */
static double edge(const split_view *v, const froe_scene *scene, uint32_t a, uint32_t b, int dim, double out[3]) {
    const double *x = scene_vertex(scene, a), *y = scene_vertex(scene, b);
    for (int k = 0; k < 3; k++) out[k] = k < dim ? (0.5 * y[k] - 0.5 * x[k]) * v->scale : 0;
    return support_dot(out, out);
}

/** Through three vertices, or through two and upright, as a line of the plane is. */
static bool plane_through(const split_view *v, const froe_scene *scene, const uint32_t *id, int span, double thin,
                          split_view_plane *out) {
    double *n = out->n, at[3], u[3], w[3] = {0, 0, -1}, x[3], longest = edge(v, scene, id[0], id[1], span, u);
    if (span == 3) {
        double ww = edge(v, scene, id[0], id[2], 3, w), xx = edge(v, scene, id[1], id[2], 3, x);
        longest = ww > longest ? ww : longest;
        longest = xx > longest ? xx : longest;
    } else {
        longest = sqrt(longest); /* in place of an area there is the distance of the two */
    }
    n[0] = u[1] * w[2] - u[2] * w[1];
    n[1] = u[2] * w[0] - u[0] * w[2];
    n[2] = u[0] * w[1] - u[1] * w[0];
    double length = sqrt(support_dot(n, n)), over = 1 / length;
    if (!(length > thin * longest) || !(length > 0x1p-900) || !(length < 0x1p900)) return false; /* NaN, too */
    split_view_local(v, scene_vertex(scene, id[0]), at);
    for (int k = 0; k < 3; k++) n[k] *= over, out->known[k] = k < span && !v->pairs ? v->place[id[k]] : FROE_NONE;
    out->d = support_dot(n, at);
    /* a few roundings of the normal, which weigh more the thinner the triangle, and of the sums */
    out->slack = v->swept ? 0x1p-48 * (1 + longest * over) * (1 + sqrt(support_dot(at, at))) : slack_of(v, out);
    return true;
}

bool split_view_span(const split_view *v, const froe_scene *scene, const uint32_t *id, double thin,
                     split_view_plane *out) {
    return plane_through(v, scene, id, v->dim, thin, out);
}

split_view_plane split_view_axis(const split_view *v, int axis, double value) {
    split_view_plane out = {.slack = 0x1p-50, .known = {FROE_NONE, FROE_NONE, FROE_NONE}};
    out.n[axis] = 1;
    out.d = (0.5 * value - v->origin[axis] - v->middle[axis]) * v->scale;
    return out;
}

/** n . x = value, for any n. */
static split_view_plane plane_across(const split_view *v, const double *normal, double value) {
    split_view_plane out = {.known = {FROE_NONE, FROE_NONE, FROE_NONE}};
    double length = 0;
    for (int k = 0; k < v->dim; k++) length += normal[k] * normal[k];
    length = sqrt(length);
    out.d = 0.5 * value / length;
    for (int k = 0; k < v->dim; k++) {
        out.n[k] = normal[k] / length;
        out.d -= out.n[k] * v->origin[k] + out.n[k] * v->middle[k];
    }
    out.d *= v->scale;
    out.slack = slack_of(v, &out);
    return out;
}

bool split_view_cut(const split_view *v, const froe_scene *scene, const froe_cut *cut, split_view_plane *out) {
    uint32_t corners[3];
    switch (cut->kind) {
    case FROE_CUT_AXIS:
        *out = split_view_axis(v, cut->axis, cut->value);
        return true;
    case FROE_CUT_PLANE:
    case FROE_CUT_FINE:
        *out = plane_across(v, cut->normal, cut->value);
        return true;
    case FROE_CUT_EDGE:
        return plane_through(v, scene, cut->id, 2, 0, out);
    case FROE_CUT_OBJECT:
        for (uint32_t i = 0; i < (uint32_t)v->dim; i++) corners[i] = scene_corner(scene, cut->id[0], i);
        return plane_through(v, scene, corners, v->dim, 0, out);
    default:
        return plane_through(v, scene, cut->id, v->dim, SPLIT_THIN, out);
    }
}

/* --------------------------------------------------------------- counting -- */

/** The sides of all corners; balls reach further than their centres. */
static void find_view_sides(split_view *v, const split_view_plane *plane) {
    const double *x = v->x.data, *y = v->y.data, *z = v->z.data, *radius = v->radius.data;
    const double a = plane->n[0], b = plane->n[1], c = plane->n[2], d = plane->d, slack = plane->slack;
    const size_t n = v->corners;
    uint8_t *side = v->side.data + 1;
    v->side.data[0] = 0;
    for (size_t i = 0; i < n && v->round; i++) {
        double value = a * x[i] + b * y[i] + c * z[i] - d, reach = slack - radius[i];
        side[i] = (uint8_t)((value < -reach) | (value > reach) << 1);
    }
    for (size_t i = v->round ? n : 0; i < n; i++) {
        double value = a * x[i] + b * y[i] + c * z[i] - d;
        side[i] = (uint8_t)((value < -slack) | (value > slack) << 1);
    }
    for (int k = 0; k < 3; k++)
        if (plane->known[k] < v->corners) side[plane->known[k]] = 0;
}

/** From those of their corners. */
static void find_fragment_sides(split_view *v) {
    const uint32_t *four = v->fours.data;
    const uint8_t *side = v->side.data;
    uint8_t *sides = v->sides.data;
    for (uint32_t i = 0; i < v->count; i++, four += 4)
        sides[i] = side[four[0]] | side[four[1]] | side[four[2]] | side[four[3]];
    for (size_t k = 0; k < v->many.count; k++) {
        const uint32_t i = v->many.data[k];
        for (uint32_t j = v->start.data[i]; j < v->start.data[i + 1]; j++) sides[i] |= side[1 + v->corner.data[j]];
    }
}

bool split_view_flat(const split_view *v, const split_view_plane *plane, uint32_t i) {
    const uint32_t from = v->pairs ? 2 * i : v->start.data[i], to = v->pairs ? from + 2 : v->start.data[i + 1];
    for (uint32_t j = from; j < to; j++) {
        const uint32_t at = v->pairs ? j : v->corner.data[j];
        const double z = v->pairs ? 0 : v->z.data[at];
        const double value = plane->n[0] * v->x.data[at] + plane->n[1] * v->y.data[at] + plane->n[2] * z - plane->d;
        bool known = false;
        for (int k = 0; k < 3; k++) known |= plane->known[k] == at;
        if (!known && !(fabs(value) <= plane->slack)) return false;
    }
    return true;
}

split_tally split_view_count(split_view *v, const split_view_plane *plane) {
    if (v->pairs) {
        /* counts segments in the plane without a detour */
        const double *x = v->x.data, *y = v->y.data;
        const double a = plane->n[0], b = plane->n[1], d = plane->d, slack = plane->slack;
        uint32_t negative = 0, positive = 0, both = 0;
        for (uint32_t i = 0; i < v->count; i++, x += 2, y += 2) {
            double from = a * x[0] + b * y[0] - d, to = a * x[1] + b * y[1] - d;
            uint32_t below = (from < to ? from : to)<-slack, above = (from > to ? from : to)> slack;
            negative += below;
            positive += above;
            both += below & above;
        }
        split_tally t = {negative - both, positive - both, v->count + both - negative - positive, both};
        for (uint32_t i = 0; i < v->count && v->marks; i++) {
            const uint32_t false_flat = v->marked.data[i] && split_view_flat(v, plane, i);
            t.on -= false_flat;
            t.both += false_flat;
        }
        return t;
    }
    find_view_sides(v, plane);
    find_fragment_sides(v);
    const uint8_t *restrict sides = v->sides.data, *restrict marked = v->marked.data;
    uint32_t negative = 0, positive = 0, both = 0;
    for (uint32_t i = 0; i < v->count; i++) {
        const uint8_t seen = sides[i] ? sides[i] : marked[i];
        negative += seen == 1;
        positive += seen == 2;
        both += seen == 3;
    }
    return (split_tally){negative, positive, v->count - negative - positive - both, both};
}

/* ------------------------------------------------------------ axis extents -- */

/** Ends of a few fragments from all over the cell, sorted: as good as all of them for choosing among. */
static void take_ends(split_view *view) {
    const uint32_t count = view->count, few = count < SPLIT_VIEW_ENDS ? count : SPLIT_VIEW_ENDS;
    for (uint32_t i = 0; i < few; i++) {
        const uint32_t at = (uint32_t)((2 * (uint64_t)i + 1) * count / (2 * few));
        view->values.data[view->values.count++] = view->low.data[at];
        view->values.data[view->values.count++] = view->high.data[at];
    }
    base_sort(view->values.data, view->values.count, sizeof(double), base_compare_doubles);
}

bool split_view_extents(split_view *view, const split_set *set, const split_cell *cell, int axis) {
    const froe_allocator *alloc = &set->alloc;
    uint32_t step = view->count < cell->count ? cell->count / view->count : 1;
    view->low.count = view->high.count = view->values.count = 0;
    if (!array_reserve(alloc, &view->low, view->count) || !array_reserve(alloc, &view->high, view->count) ||
        !array_reserve(alloc, &view->values, 2 * (size_t)view->count))
        return false;
    for (uint32_t i = 0; i < view->count; i++) {
        double low, high;
        split_extent(set, set->items.data + cell->first + (size_t)i * step, axis, &low, &high);
        view->low.data[view->low.count++] = low;
        view->high.data[view->high.count++] = high;
    }
    take_ends(view);
    return true;
}

split_tally split_view_count_axis(const split_view *view, double value) {
    const double *low = view->low.data, *high = view->high.data;
    const uint32_t n = view->count;
    uint32_t negative = 0, positive = 0, both = 0;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t below = low[i]<value, above = high[i]> value;
        negative += below;
        positive += above;
        both += below & above;
    }
    return (split_tally){negative - both, positive - both, n + both - negative - positive, both};
}
