/* view.c: counting candidates, fast and only nearly right. */
#include "split/view.h"
#include "base/random.h"
#include "base/sort.h"
#include <math.h>
#include <string.h>

void split_view_free(const froe_allocator *alloc, split_view *view) {
    for (int k = 0; k < 3; k++) array_free(alloc, &view->x[k]);
    array_free(alloc, &view->radius);
    array_free(alloc, &view->start);
    array_free(alloc, &view->side);
    array_free(alloc, &view->values);
    array_free(alloc, &view->low);
    array_free(alloc, &view->high);
}

/** Appends one corner, or ball. The caller has made room. */
static void add_view_corner(split_view *view, const double *x, double radius, int dim) {
    size_t at = view->x[0].count++;
    for (int k = 0; k < dim; k++) {
        double size = fabs(x[k]) + radius;
        view->x[k].data[at] = x[k];
        if (size > view->reach[k]) view->reach[k] = size;
    }
    view->radius.data[at] = radius;
    view->round |= radius > 0;
}

static void add_view_box(split_view *view, const split_set *set, uint32_t object, int dim) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], x[3];
    scene_object_bounds(set->scene, object, lo, hi);
    for (unsigned corner = 0; corner < 1u << dim; corner++) {
        for (int k = 0; k < dim; k++) x[k] = corner >> k & 1 ? hi[k] : lo[k];
        add_view_corner(view, x, 0, dim);
    }
}

/** Room for n more corners and one more fragment. */
static bool reserve_view(split_view *view, const froe_allocator *alloc, int dim, uint32_t n) {
    for (int k = 0; k < dim; k++) {
        view->x[k].count = view->x[0].count;
        if (!array_reserve(alloc, &view->x[k], n)) return false;
    }
    view->radius.count = view->x[0].count;
    return array_reserve(alloc, &view->radius, n) && array_reserve(alloc, &view->start, 1);
}

static bool add_fragment(split_view *view, const split_set *set, const split_fragment *f) {
    const froe_scene *scene = set->scene;
    int dim = scene->dim;
    froe_kind form = scene_form(scene, f->object);
    uint32_t n = form == FROE_BOX ? 1u << dim : form == FROE_BALL ? 1 : split_corner_count(set, f);
    if (!reserve_view(view, &set->alloc, dim, n)) return false;
    if (form == FROE_BOX)
        add_view_box(view, set, f->object, dim);
    else
        for (uint32_t i = 0; i < n; i++)
            add_view_corner(view, split_image(set, f, i), form == FROE_BALL ? scene_radius(scene, f->object) : 0, dim);
    view->start.data[view->start.count++] = (uint32_t)view->x[0].count;
    return true;
}

/** The i-th fragment shown of a cell. */
static const split_fragment *shown(const split_set *set, const split_cell *cell, uint32_t i, uint32_t count,
                                   uint64_t seed) {
    uint32_t pick = count == cell->count ? i : base_below(base_hash(seed, cell->path, 1000 + i), cell->count);
    return set->items.data + cell->first + pick;
}

/** Segments in the plane, shown whole: the commonest case by far. False: there are others, nothing was done. */
static bool fill_pairs(split_view *view, const split_set *set, const split_fragment *items) {
    double *x = view->x[0].data, *y = view->x[1].data, reach[2] = {0, 0};
    for (uint32_t i = 0; i < view->count; i++) {
        if (split_corner_count(set, items + i) != 2 || scene_form(set->scene, items[i].object) != FROE_SEGMENT)
            return false;
        for (uint32_t k = 0; k < 2; k++, x++, y++) {
            const double *p = split_image(set, items + i, k);
            *x = p[0];
            *y = p[1];
            reach[0] = fabs(*x) > reach[0] ? fabs(*x) : reach[0];
            reach[1] = fabs(*y) > reach[1] ? fabs(*y) : reach[1];
        }
    }
    view->x[0].count = view->x[1].count = 2 * (size_t)view->count;
    view->reach[0] = reach[0];
    view->reach[1] = reach[1];
    return true;
}

bool split_view_fill(split_view *view, const split_set *set, const split_cell *cell, uint32_t sample, uint64_t seed) {
    view->count = cell->count > sample ? sample : cell->count;
    view->weight = (double)cell->count / view->count;
    view->pairs = view->round = false;
    if (set->scene->dim > 3) return true; /* axis-parallel planes are the only candidates */
    view->start.count = 0;
    for (int k = 0; k < 3; k++) view->x[k].count = 0, view->reach[k] = 0;
    if (!reserve_view(view, &set->alloc, set->scene->dim, 2 * view->count)) return false;
    if (set->scene->dim == 2 && view->count == cell->count)
        view->pairs = fill_pairs(view, set, set->items.data + cell->first);
    if (view->pairs) return true;
    view->start.data[view->start.count++] = 0;
    for (uint32_t i = 0; i < view->count; i++)
        if (!add_fragment(view, set, shown(set, cell, i, view->count, seed))) return false;
    view->side.count = 0;
    return array_reserve(&set->alloc, &view->side, view->x[0].count);
}

/** A plane in plain doubles: side = sign of n . x - d. */
typedef struct rough {
    double n[3], d;
} rough;

/** Through dim points: the normal as in geom/plane.h. */
static rough through(int dim, const double *p, const double *q, const double *r) {
    rough h = {{p[1] - q[1], q[0] - p[0], 0}, 0};
    if (dim == 3) {
        double u[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]}, v[3] = {r[0] - p[0], r[1] - p[1], r[2] - p[2]};
        h.n[0] = u[1] * v[2] - u[2] * v[1];
        h.n[1] = u[2] * v[0] - u[0] * v[2];
        h.n[2] = u[0] * v[1] - u[1] * v[0];
    }
    for (int k = 0; k < dim; k++) h.d += h.n[k] * p[k];
    return h;
}

static rough rough_plane(const froe_scene *scene, const froe_cut *cut) {
    int dim = scene->dim;
    rough h = {.d = cut->value};
    const uint32_t *id = cut->kind == FROE_CUT_OBJECT ? scene->corners + scene->starts[cut->id[0]] : cut->id;
    switch (cut->kind) {
    case FROE_CUT_AXIS:
        h.n[cut->axis] = 1;
        return h;
    case FROE_CUT_PLANE:
        for (int k = 0; k < dim; k++) h.n[k] = cut->normal[k];
        return h;
    case FROE_CUT_EDGE: {
        const double *p = scene_vertex(scene, id[0]), *q = scene_vertex(scene, id[1]);
        return through(2, p, q, NULL);
    }
    default:
        return through(dim, scene_vertex(scene, id[0]), scene_vertex(scene, id[1]), scene_vertex(scene, id[dim - 1]));
    }
}

/** How far from the plane rounding could have moved a value: nearer ones count as on the plane. */
static double slack_of(const split_view *view, int dim, const rough *h) {
    double reach = fabs(h->d);
    for (int k = 0; k < dim; k++) reach += fabs(h->n[k]) * view->reach[k];
    return reach * 0x1p-49;
}

static uint8_t rough_side(double value, double slack) {
    return (uint8_t)((value < -slack) | (value > slack) << 1);
}

static void find_rough_sides(split_view *view, int dim, const rough *h) {
    size_t n = view->x[0].count;
    const double *x = view->x[0].data, *y = view->x[1].data, *z = view->x[2].data;
    double a = h->n[0], b = h->n[1], c = h->n[2], d = h->d, slack = slack_of(view, dim, h);
    uint8_t *side = view->side.data;
    if (dim == 2)
        for (size_t i = 0; i < n; i++) side[i] = rough_side(a * x[i] + b * y[i] - d, slack);
    else
        for (size_t i = 0; i < n; i++) side[i] = rough_side(a * x[i] + b * y[i] + c * z[i] - d, slack);
}

/** The same where some corners are centres of balls: these reach further by their radius. */
static void find_sides_round(split_view *view, int dim, const rough *h) {
    double square = 0, slack = slack_of(view, dim, h);
    for (int k = 0; k < dim; k++) square += h->n[k] * h->n[k];
    double length = sqrt(square);
    for (size_t i = 0; i < view->x[0].count; i++) {
        double value = -h->d;
        for (int k = 0; k < dim; k++) value += h->n[k] * view->x[k].data[i];
        view->side.data[i] = rough_side(value, slack - view->radius.data[i] * length);
    }
}

/** Counts segments in the plane, the commonest case by far, without a detour. */
static split_tally count_pairs(const split_view *view, const rough *h) {
    const double *x = view->x[0].data, *y = view->x[1].data;
    double a = h->n[0], b = h->n[1], d = h->d, slack = slack_of(view, 2, h);
    uint32_t negative = 0, positive = 0, both = 0;
    for (uint32_t i = 0; i < view->count; i++, x += 2, y += 2) {
        double from = a * x[0] + b * y[0] - d, to = a * x[1] + b * y[1] - d;
        uint32_t below = (from < to ? from : to)<-slack, above = (from > to ? from : to)> slack;
        negative += below;
        positive += above;
        both += below & above;
    }
    return (split_tally){negative - both, positive - both, view->count + both - negative - positive, both};
}

static split_tally count_rings(split_view *view, int dim, const rough *h) {
    uint32_t of[4] = {0}; /* on, negative, positive, both */
    const uint32_t *start = view->start.data;
    const uint8_t *side = view->side.data;
    view->round ? find_sides_round(view, dim, h) : find_rough_sides(view, dim, h);
    for (uint32_t i = 0; i < view->count; i++) {
        unsigned seen = 0;
        for (uint32_t j = start[i]; j < start[i + 1]; j++) seen |= side[j];
        of[seen]++;
    }
    return (split_tally){of[1], of[2], of[0], of[3]};
}

split_tally split_view_count(split_view *view, const froe_scene *scene, const froe_cut *cut) {
    rough plane = rough_plane(scene, cut);
    return view->pairs ? count_pairs(view, &plane) : count_rings(view, scene->dim, &plane);
}

/* ------------------------------------------------------------ axis extents -- */

void split_extent(const split_set *set, const split_fragment *f, int axis, double *low, double *high) {
    froe_kind form = scene_form(set->scene, f->object);
    if (form >= FROE_BOX) {
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        scene_object_bounds(set->scene, f->object, lo, hi);
        *low = lo[axis];
        *high = hi[axis];
        return;
    }
    uint32_t n = split_corner_count(set, f);
    *low = *high = split_image(set, f, 0)[axis];
    for (uint32_t i = 1; i < n; i++) {
        double x = split_image(set, f, i)[axis];
        if (x < *low) *low = x;
        if (x > *high) *high = x;
    }
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
        view->values.data[view->values.count++] = low;
        view->values.data[view->values.count++] = high;
    }
    base_sort(view->values.data, view->values.count, sizeof(double), base_compare_doubles);
    return true;
}

split_tally split_view_count_axis(const split_view *view, double value) {
    split_tally t = {0};
    for (uint32_t i = 0; i < view->count; i++) {
        bool negative = view->low.data[i]<value, positive = view->high.data[i]> value;
        t.negative += negative & !positive;
        t.positive += positive & !negative;
        t.both += positive & negative;
        t.on += !positive & !negative;
    }
    return t;
}
