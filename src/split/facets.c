/* facets.c: laying out a cell and counting beside planes. */
#include "split/facets.h"
#include "base/random.h"
#include <math.h>
#include <string.h>

froe_status split_facets_new(const froe_allocator *alloc, const froe_scene *scene, split_facets *out) {
    *out = (split_facets){.place_count = scene->vertex_count, .dim = scene->dim};
    out->place = support_calloc(alloc, out->place_count, sizeof *out->place);
    if (!out->place) return FROE_E_MEMORY;
    memset(out->place, 0xff, out->place_count * sizeof *out->place);
    return FROE_OK;
}

void split_facets_free(const froe_allocator *alloc, split_facets *f) {
    array_free(alloc, &f->x);
    array_free(alloc, &f->y);
    array_free(alloc, &f->z);
    array_free(alloc, &f->vertex);
    array_free(alloc, &f->side);
    array_free(alloc, &f->start);
    array_free(alloc, &f->corner);
    array_free(alloc, &f->vertices);
    support_free(alloc, f->place, f->place_count ? f->place_count * sizeof *f->place : 1);
    f->place = NULL;
}

/* ---------------------------------------------------------------- filling -- */

static void forget(split_facets *f) {
    for (size_t i = 0; i < f->vertices.count; i++) f->place[f->vertex.data[f->vertices.data[i]]] = FROE_NONE;
    f->x.count = f->y.count = f->z.count = f->vertex.count = f->vertices.count = 0;
    f->start.count = f->corner.count = 0;
}

static bool reserve_facet_corners(split_facets *f, const froe_allocator *alloc, uint32_t corners) {
    f->y.count = f->z.count = f->x.count;
    return array_reserve(alloc, &f->x, corners) && array_reserve(alloc, &f->y, corners) &&
           array_reserve(alloc, &f->z, corners) && array_reserve(alloc, &f->vertex, corners) &&
           array_reserve(alloc, &f->vertices, corners) && array_reserve(alloc, &f->corner, corners) &&
           array_reserve(alloc, &f->start, 1);
}

/** A corner of its own; coordinates as in the scene for now. */
static uint32_t add_facet_corner(split_facets *f, const double *x, uint32_t vertex) {
    uint32_t at = (uint32_t)f->x.count++;
    f->x.data[at] = x[0];
    f->y.data[at] = x[1];
    f->z.data[at] = f->dim == 3 ? x[2] : 0;
    f->vertex.data[at] = vertex;
    f->vertex.count = at + 1;
    return at;
}

static uint32_t add_vertex(split_facets *f, const froe_scene *scene, uint32_t vertex) {
    uint32_t at = f->place[vertex];
    if (at != FROE_NONE) return at;
    f->place[vertex] = at = add_facet_corner(f, scene_vertex(scene, vertex), vertex);
    f->vertices.data[f->vertices.count++] = at;
    return at;
}

/** Where a corner lies; where that is beyond doubles, any place of its object will do. */
static const double *image(const split_set *set, const split_fragment *item, const split_corner *k) {
    bool known = isfinite(k->x[0]) && isfinite(k->x[1]) && (set->scene->dim == 2 || isfinite(k->x[2]));
    return known ? k->x : scene_point(set->scene, item->object, 0);
}

static bool add_fragment(split_facets *f, const split_set *set, const split_fragment *item) {
    uint32_t n = split_corner_count(set, item);
    if (!reserve_facet_corners(f, &set->alloc, n)) return false;
    for (uint32_t i = 0; i < n; i++) {
        const split_corner *k = item->count ? set->corners.data + item->first + i : NULL;
        uint32_t vertex = !k ? scene_corner(set->scene, item->object, i) : k->type == SPLIT_VERTEX ? k->a : FROE_NONE;
        uint32_t at = vertex == FROE_NONE ? add_facet_corner(f, image(set, item, k), FROE_NONE)
                                          : add_vertex(f, set->scene, vertex);
        f->corner.data[f->corner.count++] = at;
    }
    f->start.data[f->start.count++] = (uint32_t)f->corner.count;
    return true;
}

/** Half the middle and half the width of some numbers; halves, so that nothing overflows. */
static void extent_of(const double *x, size_t count, double *middle, double *width) {
    double lo = x[0], hi = x[0];
    for (size_t i = 1; i < count; i++) {
        lo = x[i] < lo ? x[i] : lo;
        hi = x[i] > hi ? x[i] : hi;
    }
    *middle = 0.25 * lo + 0.25 * hi;
    *width = 0.5 * hi - 0.5 * lo;
}

/** To local coordinates, by a power of two at most twice the width of the corners. */
static void centre(split_facets *f) {
    double *const x[3] = {f->x.data, f->y.data, f->z.data}, width = 0;
    int exponent = 0;
    for (int k = 0; k < 3; k++) {
        double w;
        extent_of(x[k], f->corners, f->middle + k, &w);
        width = w > width ? w : width;
    }
    if (width > 0) frexp(width, &exponent); /* width < 2^exponent; local coordinates are at most half as large */
    f->scale = ldexp(1, exponent < -1000 ? 1000 : -exponent);
    for (int k = 0; k < 3; k++)
        for (size_t i = 0; i < f->x.count; i++) x[k][i] = (0.5 * x[k][i] - f->middle[k]) * f->scale;
}

/** Two vertices of every object shown, on average, where corners are few. */
static bool add_outside(split_facets *f, const split_set *set, const split_cell *cell, uint64_t seed) {
    const split_fragment *items = set->items.data + cell->first;
    f->corners = (uint32_t)f->x.count;
    f->inside = (uint32_t)f->vertices.count;
    if (f->inside >= f->count) return true;
    if (!reserve_facet_corners(f, &set->alloc, 2 * f->count)) return false;
    for (uint32_t i = 0; i < 2 * f->count; i++) {
        uint64_t hash = base_hash(seed, cell->path, 0x20000000 + i);
        uint32_t object = items[base_below(hash, cell->count)].object;
        uint32_t corner = base_below(base_mix(hash), scene_corners(set->scene, object));
        add_vertex(f, set->scene, scene_corner(set->scene, object, corner));
    }
    return true;
}

bool split_facets_fill(split_facets *f, const split_set *set, const split_cell *cell, uint32_t sample, uint64_t seed) {
    const split_fragment *items = set->items.data + cell->first;
    f->count = cell->count > sample ? sample : cell->count;
    f->weight = (double)cell->count / f->count;
    forget(f);
    if (!reserve_facet_corners(f, &set->alloc, 1)) return false;
    f->start.data[f->start.count++] = 0;
    for (uint32_t i = 0; i < f->count; i++) {
        bool all = f->count == cell->count;
        uint32_t pick = all ? i : base_below(base_hash(seed, cell->path, 0x10000000 + i), cell->count);
        if (!add_fragment(f, set, items + pick)) return false;
    }
    if (!add_outside(f, set, cell, seed)) return false;
    centre(f);
    f->side.count = 0;
    return array_reserve(&set->alloc, &f->side, f->corners);
}

/* ----------------------------------------------------------------- planes -- */

void split_facets_local(const split_facets *f, const double *x, double out[3]) {
    for (int k = 0; k < 3; k++) out[k] = k < f->dim ? (0.5 * x[k] - f->middle[k]) * f->scale : 0;
}

static double dot_3(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** The vector between two vertices, and its squared length. */
static double edge(const split_facets *f, const froe_scene *scene, uint32_t a, uint32_t b, double out[3]) {
    const double *x = scene_vertex(scene, a), *y = scene_vertex(scene, b);
    for (int k = 0; k < 3; k++) out[k] = k < f->dim ? (0.5 * y[k] - 0.5 * x[k]) * f->scale : 0;
    return dot_3(out, out);
}

/** A normal of the plane through vertices, as long as twice their triangle's area; returns the square of their longest
 * distance. In the plane both are the distance of the two vertices. */
static double facet_normal(const split_facets *f, const froe_scene *scene, const uint32_t *id, double n[3]) {
    double u[3], v[3] = {0, 0, -1}, w[3], longest = edge(f, scene, id[0], id[1], u);
    if (f->dim == 3) {
        double vv = edge(f, scene, id[0], id[2], v), ww = edge(f, scene, id[1], id[2], w);
        longest = vv > longest ? vv : longest;
        longest = ww > longest ? ww : longest;
    }
    n[0] = u[1] * v[2] - u[2] * v[1];
    n[1] = u[2] * v[0] - u[0] * v[2];
    n[2] = u[0] * v[1] - u[1] * v[0];
    return f->dim == 3 ? longest : sqrt(longest);
}

bool split_facets_plane(const split_facets *f, const froe_scene *scene, const uint32_t id[3], double thin,
                        split_facet_plane *out) {
    double *n = out->n, longest = facet_normal(f, scene, id, n), length = sqrt(dot_3(n, n)), over = 1 / length, at[3];
    if (!(length > thin * longest) || !(length > 0x1p-900) || !(length < 0x1p900)) return false; /* NaN, too */
    split_facets_local(f, scene_vertex(scene, id[0]), at);
    for (int k = 0; k < 3; k++) n[k] *= over, out->known[k] = k < f->dim ? f->place[id[k]] : FROE_NONE;
    out->d = dot_3(n, at);
    /* a few roundings of the normal, which weigh more the thinner the triangle, and of the sums */
    out->slack = 0x1p-48 * (1 + longest * over) * (1 + sqrt(dot_3(at, at)));
    return true;
}

split_facet_plane split_facets_axis(const split_facets *f, int axis, double value) {
    split_facet_plane out = {.slack = 0x1p-50, .known = {FROE_NONE, FROE_NONE, FROE_NONE}};
    out.n[axis] = 1;
    out.d = (0.5 * value - f->middle[axis]) * f->scale;
    return out;
}

double split_facets_coordinate(const split_facets *f, const froe_scene *scene, uint32_t corner, int axis) {
    const double *const x[3] = {f->x.data, f->y.data, f->z.data};
    uint32_t vertex = f->vertex.data[corner];
    return vertex != FROE_NONE ? scene_vertex(scene, vertex)[axis] : 2 * (x[axis][corner] / f->scale + f->middle[axis]);
}

/* --------------------------------------------------------------- counting -- */

static void find_facet_sides(split_facets *f, const split_facet_plane *plane) {
    const double *x = f->x.data, *y = f->y.data, *z = f->z.data;
    const double a = plane->n[0], b = plane->n[1], c = plane->n[2], d = plane->d, slack = plane->slack;
    uint8_t *side = f->side.data;
    for (size_t i = 0, n = f->corners; i < n; i++) {
        double value = a * x[i] + b * y[i] + c * z[i] - d;
        side[i] = (uint8_t)((value < -slack) | (value > slack) << 1);
    }
    for (int k = 0; k < 3; k++)
        if (plane->known[k] < f->corners) side[plane->known[k]] = 0;
}

split_tally split_facets_count(split_facets *f, const split_facet_plane *plane) {
    const uint32_t *start = f->start.data, *corner = f->corner.data;
    const uint8_t *side = f->side.data;
    uint32_t of[4] = {0}; /* on, negative, positive, both */
    find_facet_sides(f, plane);
    for (uint32_t i = 0; i < f->count; i++) {
        unsigned seen = 0;
        for (uint32_t j = start[i]; j < start[i + 1]; j++) seen |= side[corner[j]];
        of[seen]++;
    }
    return (split_tally){.negative = of[1], .positive = of[2], .on = of[0], .both = of[3]};
}
