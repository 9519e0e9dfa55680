/* range_take.c: a caller's range is checked and prepared. */
#include "geom/filter.h"
#include "query/context.h"
#include "support/fail.h"
#include <string.h>

static const char *const names[FROE_SHAPE_COUNT] = {"box",        "ball", "simplex", "capsule",
                                                    "halfspaces", "hull", "segment", "ray"};

const char *froe_range_shape_name(froe_range_shape shape) {
    return (unsigned)shape < FROE_SHAPE_COUNT ? names[shape] : NULL;
}

const char *froe_walk_name(froe_walk walk) {
    static const char *const walks[FROE_WALK_COUNT] = {"auto", "plain", "box", "lca", "classes"};
    return (unsigned)walk < FROE_WALK_COUNT ? walks[walk] : NULL;
}

void froe_range_defaults_into(froe_range *out, size_t size) {
    const froe_range all = {.size = size};
    support_defaults(out, size, &all, sizeof all);
}

void query_range_free(query_range *r, const froe_allocator *alloc) {
    geom_range_free(&r->range, alloc);
    geom_polytope_free(&r->polytope, alloc);
    array_free(alloc, &r->nodes);
    array_free(alloc, &r->boxes);
}

/* ---------------------------------------------------------------- checking -- */

static size_t range_point_count(const froe_range *r, size_t dim) {
    switch (r->shape) {
    case FROE_SHAPE_BALL:
        return 1;
    case FROE_SHAPE_SIMPLEX:
        return dim + 1;
    case FROE_SHAPE_HALFSPACES:
    case FROE_SHAPE_HULL:
        return r->count;
    default:
        return 2;
    }
}

static bool has_radius(froe_range_shape shape) {
    return shape == FROE_SHAPE_BALL || shape == FROE_SHAPE_CAPSULE;
}

/* Most ranges are windows, which are seen to be good at a glance; NaN compares as false. */
static bool is_good_window(const froe_range *r, size_t dim) {
    bool good = r->shape == FROE_SHAPE_BOX && r->walk == FROE_WALK_AUTO && r->eps == 0 && r->points;
    for (size_t k = 0; good && k < dim; k++) {
        const double lo = r->points[k], hi = r->points[dim + k];
        good = lo <= hi && lo < INFINITY && hi > -INFINITY;
    }
    return good;
}

froe_status query_range_check(const froe_range *r, int dim, froe_diagnostic *diag) {
    if (r->size != sizeof *r) return support_fail_defaults(diag, "froe_range_defaults");
    if (is_good_window(r, (size_t)dim)) return FROE_OK;
    if ((unsigned)r->shape >= FROE_SHAPE_COUNT)
        return support_fail(diag, FROE_E_OPTIONS, "There is no shape of number %u.", (unsigned)r->shape);
    if ((unsigned)r->walk >= FROE_WALK_COUNT)
        return support_fail(diag, FROE_E_OPTIONS, "There is no walk of number %u.", (unsigned)r->walk);
    if (dim > 3 && r->shape == FROE_SHAPE_RAY)
        return support_fail(diag, FROE_E_UNSUPPORTED, "There is no %s in %d dimensions.", names[r->shape], dim);
    const size_t count = range_point_count(r, (size_t)dim);
    const bool halfspaces = r->shape == FROE_SHAPE_HALFSPACES;
    const char *const name = halfspaces ? "halfspace" : names[r->shape];
    if (count && (!r->points || (halfspaces && !r->offsets)))
        return support_fail(diag, FROE_E_ARG, "A %s has no %s.", name, r->points ? "offset" : "points");
    if (!count && !halfspaces) return support_fail(diag, FROE_E_INPUT, "A hull has no points.");
    if (count > UINT32_MAX / 8) return support_fail(diag, FROE_E_ARG, "There are %zu points of a %s.", count, name);
    const size_t n = (size_t)dim;
    for (size_t i = 0; i < count * n; i++) {
        const double x = r->points[i];
        if (isfinite(x)) continue;
        if (r->shape != FROE_SHAPE_BOX || x != (i < n ? -INFINITY : INFINITY)) /* boxes may be unbounded */
            return support_fail(diag, FROE_E_INPUT, "A coordinate of a %s is %g, not a finite number.", name, x);
    }
    for (size_t i = 0; halfspaces && i < count; i++)
        if (!isfinite(r->offsets[i]))
            return support_fail(diag, FROE_E_INPUT, "The offset of a halfspace is %g, not a finite number.",
                                r->offsets[i]);
    for (size_t k = 0; r->shape == FROE_SHAPE_BOX && k < n; k++)
        if (r->points[k] > r->points[n + k])
            return support_fail(diag, FROE_E_INPUT,
                                "The low corner %g of a box is above its high corner %g on axis %zu.", r->points[k],
                                r->points[n + k], k);
    if (has_radius(r->shape) && !(r->radius >= 0 && isfinite(r->radius)))
        return support_fail(diag, FROE_E_INPUT, "The radius of a %s is %g, not a finite number >= 0.", name, r->radius);
    if (!(r->eps >= 0 && isfinite(r->eps)))
        return support_fail(diag, FROE_E_INPUT, "The eps of a range, %g, is not a finite number >= 0.", r->eps);
    size_t zeros = 0;
    while (r->shape == FROE_SHAPE_RAY && zeros < n && r->points[n + zeros] == 0) zeros++;
    if (zeros == n) return support_fail(diag, FROE_E_INPUT, "A ray has no direction.");
    return FROE_OK;
}

/* ------------------------------------------------------------------ facets -- */

/* A normal of the line through p and q, of the plane through p, q and r; of any length. */
static void normal_of(int dim, const double *p, const double *q, const double *r, double n[3]) {
    double d[3] = {0}, e[3] = {0};
    for (int k = 0; k < dim; k++) d[k] = q[k] - p[k], e[k] = dim == 3 ? r[k] - p[k] : 0;
    if (dim == 2) e[2] = 1;
    for (int k = 0; k < 3; k++) n[k] = d[(k + 1) % 3] * e[(k + 2) % 3] - d[(k + 2) % 3] * e[(k + 1) % 3];
}

/* Facets in both directions, so that it does not matter which one is the outer one. */
static bool add_slab(geom_range *r, const froe_allocator *alloc, const double *n) {
    double back[FROE_MAX_DIM];
    bool ok = true;
    for (int k = 0; k < r->dim; k++) back[k] = -n[k];
    for (int i = 0; i < 2 && ok; i++) ok = geom_range_add_facet(r, alloc, i ? back : n);
    return ok;
}

/* In the plane and in space. */
static bool add_near_facets(geom_range *r, const froe_allocator *alloc, froe_range_shape shape) {
    const double *p[3];
    double n[3];
    bool ok = true;
    switch (shape) {
    case FROE_SHAPE_SIMPLEX: /* each side */
        for (uint32_t i = 0; i < r->set.count && ok; i++) {
            for (uint32_t j = 0; j < 3; j++) p[j] = geom_convex_point(&r->set, (i + j) % r->set.count);
            normal_of(r->dim, p[0], p[1], p[2], n);
            ok = add_slab(r, alloc, n);
        }
        return ok;
    case FROE_SHAPE_CAPSULE: /* across the axis */
        for (int i = 0; i < 2; i++) p[i] = geom_convex_point(&r->set, (uint32_t)i);
        for (int axis = r->dim == 2 ? 2 : 0; axis < 3 && ok; axis++) {
            double up[3] = {0};
            for (int k = 0; k < r->dim; k++) up[k] = p[0][k];
            if (axis < r->dim) up[axis] += fabs(p[1][axis] - p[0][axis]) + 1;
            normal_of(r->dim, p[0], p[1], up, n);
            ok = add_slab(r, alloc, n);
        }
        return ok;
    case FROE_SHAPE_HULL: /* in the directions between the axes */
        for (int i = 0; i < 27 && ok; i++) {
            const int step[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
            for (int k = 0; k < 3; k++) n[k] = step[k];
            const int axes = (n[0] != 0) + (n[1] != 0) + (n[2] != 0);
            if (axes > 1 && (r->dim == 3 || n[2] == 0)) ok = geom_range_add_facet(r, alloc, n);
        }
        return ok;
    default:
        return true;
    }
}

/* What is left of v across the first `count` vectors, which are made orthogonal to each other on the way. */
static void take_across(double vectors[][FROE_MAX_DIM], int count, int dim, double *v) {
    for (int i = 0; i < count; i++) {
        double along = 0, square = 0;
        for (int k = 0; k < dim; k++) along += v[k] * vectors[i][k], square += vectors[i][k] * vectors[i][k];
        for (int k = 0; k < dim && square > 0; k++) v[k] -= along / square * vectors[i][k];
    }
}

/* Across each side of a simplex, about: any direction bounds the range. */
static bool add_sides(geom_range *r, const froe_allocator *alloc) {
    bool ok = true;
    for (uint32_t corner = 0; corner < r->set.count && ok; corner++) {
        double side[FROE_MAX_DIM][FROE_MAX_DIM], n[FROE_MAX_DIM];
        const double *from = geom_convex_point(&r->set, !corner);
        int count = 0;
        for (uint32_t i = 0; i < r->set.count; i++) {
            if (i == corner || i == (uint32_t)!corner) continue;
            for (int k = 0; k < r->dim; k++) side[count][k] = geom_convex_point(&r->set, i)[k] - from[k];
            take_across(side, count, r->dim, side[count]);
            count++;
        }
        for (int k = 0; k < r->dim; k++) n[k] = geom_convex_point(&r->set, corner)[k] - from[k];
        take_across(side, count, r->dim, n);
        ok = add_slab(r, alloc, n);
    }
    return ok;
}

/* Across the axis of a capsule, seen along all axes but two. */
static bool add_around(geom_range *r, const froe_allocator *alloc) {
    const double *a = geom_convex_point(&r->set, 0), *b = geom_convex_point(&r->set, 1);
    bool ok = true;
    for (int i = 0; i < r->dim && ok; i++)
        for (int j = 0; j < i && ok; j++) {
            double n[FROE_MAX_DIM] = {0};
            n[i] = b[j] - a[j];
            n[j] = a[i] - b[i];
            ok = add_slab(r, alloc, n);
        }
    return ok;
}

/* In the directions between two axes. */
static bool add_diagonals(geom_range *r, const froe_allocator *alloc) {
    bool ok = true;
    for (int i = 0; i < r->dim && ok; i++)
        for (int j = 0; j < i && ok; j++)
            for (int sign = -1; sign <= 1 && ok; sign += 2) {
                double n[FROE_MAX_DIM] = {0};
                n[i] = 1;
                n[j] = sign;
                ok = add_slab(r, alloc, n);
            }
    return ok;
}

/* Above dimension 3: any directions bound the range. */
static bool add_far_facets(geom_range *r, const froe_allocator *alloc, froe_range_shape shape) {
    return shape == FROE_SHAPE_SIMPLEX   ? add_sides(r, alloc)
           : shape == FROE_SHAPE_CAPSULE ? add_around(r, alloc)
           : shape == FROE_SHAPE_HULL    ? add_diagonals(r, alloc)
                                         : true;
}

/* Those of halfspaces are their own. */
static bool add_facets(geom_range *r, const froe_allocator *alloc, const froe_range *from) {
    r->facets.count = 0;
    if (from->shape != FROE_SHAPE_HALFSPACES)
        return r->dim > 3 ? add_far_facets(r, alloc, from->shape) : add_near_facets(r, alloc, from->shape);
    if (!array_reserve(alloc, &r->facets, from->count)) return false;
    for (size_t i = 0; i < from->count; i++) {
        geom_facet f = {.c = from->offsets[i]};
        double square = 0;
        for (int k = 0; k < r->dim; k++) {
            f.n[k] = from->points[i * (size_t)r->dim + (size_t)k];
            square += f.n[k] * f.n[k];
        }
        f.norm = sqrt(square) * (1 + 0x1p-48);
        r->facets.data[r->facets.count++] = f;
    }
    return true;
}

/* ------------------------------------------------------------------ margin -- */

enum { FEW_POINTS = 256 };

/* A lower bound of the diameter; of halfspaces that of their corners. Of many points it is the greatest extent along an
 * axis. */
static double diameter(const geom_range *r, const froe_range *from) {
    const size_t dim = (size_t)r->dim;
    const size_t count = from->shape == FROE_SHAPE_HALFSPACES ? r->set.count : range_point_count(from, dim);
    const double *points = from->shape == FROE_SHAPE_HALFSPACES ? r->set.coords : from->points;
    const double radius = has_radius(from->shape) ? from->radius : 0;
    double most = 0;
    for (size_t k = 0; k < dim && count > FEW_POINTS; k++) most = filter_greater(most, r->hi[k] - r->lo[k]);
    for (size_t i = 0; i < count && count <= FEW_POINTS; i++)
        for (size_t j = 0; j < i; j++) {
            double square = 0;
            for (size_t k = 0; k < dim; k++) {
                const double d = points[i * dim + k] - points[j * dim + k];
                square += d * d;
            }
            most = filter_greater(most, square);
        }
    /* Squares that are not denormal; what is shorter has no margin. */
    if (count <= FEW_POINTS) most = most > 0x1p-900 ? sqrt(most) : 0;
    const double size = (most - 4 * r->set.error) * (1 - 0x1p-45) + 2 * radius;
    return size > 0x1p-500 ? size * (1 - 0x1p-45) : 0;
}

static froe_status take_margin(froe_query *q, const froe_range *from, froe_diagnostic *diag) {
    static const double lo[3] = {-0x1p1023, -0x1p1023, -0x1p1023}, hi[3] = {0x1p1023, 0x1p1023, 0x1p1023};
    query_range *r = &q->range;
    const uint32_t dim = (uint32_t)r->range.dim;
    r->margin = 0;
    if (from->eps == 0) return FROE_OK;
    bool unbounded = from->shape == FROE_SHAPE_RAY;
    for (size_t i = 0; from->shape == FROE_SHAPE_BOX && i < 2 * (size_t)dim; i++)
        unbounded |= !isfinite(from->points[i]);
    if (unbounded) return support_fail(diag, FROE_E_INPUT, "A %s without a bound has no eps.", names[from->shape]);
    if (from->shape == FROE_SHAPE_HALFSPACES && dim > 3) {
        const geom_halfspaces of = query_halfspaces(r);
        const froe_scene *scene = q->tree->scene;
        double x[FROE_MAX_DIM];
        if (!geom_halfspaces_bounded(&q->numbers, &of) && geom_halfspaces_any(&q->numbers, &of))
            return support_fail(diag, FROE_E_INPUT, "Halfspaces without a bound have no eps.");
        /* A ball around x is inside. If all planes move outwards by eps times its radius, what they hold is larger by
         * the factor 1 + eps at most, seen from x. So no point of it is further than eps times the diameter away. */
        for (uint32_t k = 0; k < dim; k++) x[k] = 0.5 * scene->lo[k] + 0.5 * scene->hi[k];
        const double margin = scene->object_count ? from->eps * geom_halfspaces_ball(&of, x) * (1 - 0x1p-45) : 0;
        r->margin = margin > 0x1p-900 && isfinite(margin) ? margin : 0;
        return FROE_OK;
    }
    if (from->shape == FROE_SHAPE_HALFSPACES) {
        /* Within a box that holds all numbers: which of its planes makes a corner bounds what they do not. */
        if (!geom_polytope_make(&q->numbers, &q->alloc, (int)dim, from->points, from->offsets, from->count, lo, hi,
                                &r->polytope))
            return support_fail_memory(diag);
        for (size_t i = 0; i < 3 * r->polytope.corners.count; i++)
            if (r->polytope.corners.data[i / 3].planes[i % 3] < 2 * dim)
                return support_fail(diag, FROE_E_INPUT, "Halfspaces without a bound have no eps.");
        r->range.set = geom_polytope_convex(&r->polytope, (int)dim);
    }
    const double margin = from->eps * diameter(&r->range, from) * (1 - 0x1p-45);
    r->margin = margin > 0x1p-900 && isfinite(margin) ? margin : 0;
    return FROE_OK;
}

/* ------------------------------------------------------------------ taking -- */

froe_status query_range_take(froe_query *q, const froe_range *from, froe_diagnostic *diag) {
    static const geom_range_kind kinds[FROE_SHAPE_COUNT] = {
        [FROE_SHAPE_BOX] = GEOM_RANGE_BOX,          [FROE_SHAPE_BALL] = GEOM_RANGE_BALL,
        [FROE_SHAPE_SIMPLEX] = GEOM_RANGE_SOLID,    [FROE_SHAPE_CAPSULE] = GEOM_RANGE_SOLID,
        [FROE_SHAPE_HALFSPACES] = GEOM_RANGE_SOLID, [FROE_SHAPE_HULL] = GEOM_RANGE_SOLID,
        [FROE_SHAPE_SEGMENT] = GEOM_RANGE_THIN,     [FROE_SHAPE_RAY] = GEOM_RANGE_THIN};
    query_range *r = &q->range;
    const int dim = q->tree->scene->dim;
    froe_status status = query_range_check(from, dim, diag);
    if (status) return status;
    r->from = from;
    r->shape = from->shape;
    r->walk = from->walk;
    r->polytope_made = false;
    r->range.kind = kinds[from->shape];
    r->range.dim = dim;
    geom_convex *set = &r->range.set;
    *set = (geom_convex){.dim = dim, .coords = from->points, .count = (uint32_t)range_point_count(from, (size_t)dim)};
    if (has_radius(from->shape)) set->radius = from->radius;
    if (from->shape == FROE_SHAPE_RAY) set->core = GEOM_CORE_RAY;
    if (from->shape == FROE_SHAPE_BOX) set->core = GEOM_CORE_BOX, set->count = 1u << dim;
    if (from->shape == FROE_SHAPE_HALFSPACES) set->count = 0;
    double *lo = r->range.lo, *hi = r->range.hi;
    for (int k = 0; k < dim; k++) lo[k] = -INFINITY, hi[k] = INFINITY;
    if (from->shape == FROE_SHAPE_BOX) {
        memcpy(lo, from->points, (size_t)dim * sizeof *lo);
        memcpy(hi, from->points + dim, (size_t)dim * sizeof *hi);
    } else if (from->shape == FROE_SHAPE_RAY) {
        for (int k = 0; k < dim; k++) {
            if (from->points[dim + k] >= 0) lo[k] = from->points[k];
            if (from->points[dim + k] <= 0) hi[k] = from->points[k];
        }
    } else if (from->shape != FROE_SHAPE_HALFSPACES) {
        geom_range_bound(&r->range);
    }
    status = take_margin(q, from, diag);
    if (status) return status;
    r->range.facets.count = 0;
    if (q->numbers.first != NUM_EXACT && !add_facets(&r->range, &q->alloc, from)) return support_fail_memory(diag);
    return FROE_OK;
}

void query_range_of_box(froe_query *q, const froe_range *box) {
    q->range.from = box;
    q->range.shape = box->shape;
    q->range.range.kind = GEOM_RANGE_BOX;
    q->range.margin = 0;
}
