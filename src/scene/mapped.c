/* mapped.c: a scene over arrays from a file, which are unvalidated input.
 *
 * It is checked whole when something asks for all of it (scene_settle()), or object by object where a query comes by
 * (scene_check_object()). docs/design/opening.md says why. */
#include "base/floats.h"
#include "geom/selftest.h"
#include "scene/polygon.h"
#include "scene/store.h"
#include "support/fail.h"
#include <math.h>
#include <string.h>

#define BAD_NUMBER "a coordinate is not finite, or is -0"
#define BAD_SHAPE "it has no valid shape"

static froe_status bad_scene(froe_diagnostic *diag, const char *what) {
    return support_fail(diag, FROE_E_FORMAT, "The scene of the file is corrupted: %s.", what);
}

static froe_status bad_object(froe_diagnostic *diag, uint32_t object, const char *what) {
    return support_fail_at(diag, FROE_E_FORMAT, object, FROE_NONE, FROE_NONE,
                           "object %u: The scene of the file is corrupted: %s.", object, what);
}

/* ---------------------------------------------------------------- vertices -- */

static bool plain_number(double x) {
    return isfinite(x) && !(x == 0 && signbit(x));
}

/** No two vertices may be equal: everything that knows points by their ids relies on it. */
static froe_status check_vertices(const froe_scene *s, const froe_allocator *alloc, froe_diagnostic *diag) {
    for (size_t i = 0, n = (size_t)s->vertex_count * (size_t)s->dim; i < n; i++)
        if (!plain_number(s->coords[i])) return bad_scene(diag, BAD_NUMBER);
    scene_table table = {0};
    size_t bytes = (size_t)s->dim * sizeof(double);
    froe_status status = scene_table_reserve(alloc, &table, s->vertex_count) ? FROE_OK : support_fail_memory(diag);
    for (uint32_t v = 0; !status && v < s->vertex_count; v++) {
        uint32_t tag = scene_vertex_tag(scene_vertex(s, v), s->dim);
        size_t at = scene_table_first(&table, tag);
        uint32_t other = scene_table_find(&table, tag, &at);
        while (other != FROE_NONE && memcmp(scene_vertex(s, v), scene_vertex(s, other), bytes) != 0)
            other = scene_table_find_next(&table, tag, &at);
        if (other != FROE_NONE) status = bad_scene(diag, "two vertices are equal");
        scene_table_put(&table, at, tag, v);
    }
    scene_table_free(alloc, &table);
    return status;
}

/* ----------------------------------------------------------------- objects -- */

static bool shape_fits(const froe_scene *s, uint32_t object, num_context *context) {
    const geom_body body = scene_body(s, object);
    uint32_t count = scene_corners(s, object);
    double radius, lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    switch (scene_form(s, object)) {
    case FROE_SEGMENT:
        return scene_corner(s, object, 0) != scene_corner(s, object, 1);
    case FROE_POLYGON:
        return scene_polygon_valid(context, body.coords, body.corners, count);
    case FROE_BOX:
        for (int k = 0; k < s->dim; k++)
            if (scene_point(s, object, 0)[k] > scene_point(s, object, 1)[k]) return false;
        return true;
    case FROE_BALL:
        radius = scene_radius(s, object);
        if (!plain_number(radius) || radius < 0) return false;
        scene_ball_bounds(s->dim, scene_point(s, object, 0), radius, lo, hi);
        for (int k = 0; k < s->dim; k++)
            if (!isfinite(lo[k]) || !isfinite(hi[k])) return false;
        return true;
    case FROE_HULL:
        for (uint32_t i = 1; i < count; i++)
            if (scene_corner(s, object, i) <= scene_corner(s, object, i - 1)) return false;
        return true;
    default:
        return true;
    }
}

static const char *index_fault(const froe_scene *s, uint32_t object) {
    unsigned kind = scene_kind(s, object), form = scene_form(s, object);
    uint32_t begin = scene_start(s, object), end = scene_start(s, object + 1);
    const bool exists = kind == FROE_POLYGON ? s->dim == 3 : kind < FROE_KIND_COUNT;
    const bool high = kind == FROE_SEGMENT && s->dim > 3, whole = form == (high ? (unsigned)FROE_HULL : kind);
    const bool lesser = (kind == FROE_SEGMENT && form == FROE_POINT) ||
                        (kind == FROE_POLYGON && (form == FROE_POINT || form == FROE_SEGMENT));
    if (!exists || (!whole && !lesser)) return "it has a wrong kind or form";
    const uint32_t least = form == FROE_POINT || kind == FROE_HULL ? 1 : form == FROE_POLYGON ? 3 : 2;
    const bool more = form == FROE_POLYGON || kind == FROE_HULL;
    if (end < begin || end > s->corner_count || (more ? end - begin < least : end - begin != least))
        return "it has a wrong number of corners";
    for (uint32_t i = begin; i < end; i++) {
        bool radius = form == FROE_BALL && i > begin;
        if (scene_corner_vertex(s, i) >= (radius ? s->radius_count : s->vertex_count)) return "a corner does not exist";
    }
    if (s->groups && s->groups[object] != FROE_NONE && s->groups[object] >= s->group_count)
        return "its group does not exist";
    return NULL;
}

bool scene_object_fits(const froe_scene *s, uint32_t object) {
    return !index_fault(s, object);
}

froe_status scene_check_object(const froe_scene *s, uint32_t object, num_context *context, froe_diagnostic *diag) {
    const char *why = index_fault(s, object);
    if (why) return bad_object(diag, object, why);
    const uint32_t points = scene_form(s, object) == FROE_BALL ? 1 : scene_corners(s, object);
    for (uint32_t i = 0; i < points; i++)
        for (int k = 0; k < s->dim; k++)
            if (!plain_number(scene_point(s, object, i)[k])) return bad_object(diag, object, BAD_NUMBER);
    const bool flat = scene_form(s, object) == FROE_SEGMENT &&
                      !memcmp(scene_point(s, object, 0), scene_point(s, object, 1), (size_t)s->dim * sizeof(double));
    return flat || !shape_fits(s, object, context) ? bad_object(diag, object, BAD_SHAPE) : FROE_OK;
}

/* The same where the vertices have been checked. */
static froe_status check_object(const froe_scene *s, uint32_t object, num_context *context, froe_diagnostic *diag) {
    const char *why = index_fault(s, object);
    if (!why && !shape_fits(s, object, context)) why = BAD_SHAPE;
    return why ? bad_object(diag, object, why) : FROE_OK;
}

static froe_status check_objects(const froe_scene *s, const froe_allocator *alloc, froe_diagnostic *diag) {
    num_context context;
    if (scene_start(s, 0) != 0 || scene_start(s, s->object_count) != s->corner_count)
        return bad_scene(diag, "the offsets of the corners are wrong");
    if (geom_context_new(alloc, &context)) return support_fail_memory(diag);
    froe_status status = FROE_OK;
    for (uint32_t i = 0; !status && i < s->object_count; i++) status = check_object(s, i, &context, diag);
    num_context_free(&context);
    return status;
}

/* ------------------------------------------------------------------- whole -- */

/* What takes no longer for larger scenes. */
static froe_status check_frame(const froe_scene *s, froe_diagnostic *diag) {
    if (s->dim < 2 || s->dim > FROE_MAX_DIM) return bad_scene(diag, "its dimension is wrong");
    if (s->object_count > SCENE_LIMIT || s->vertex_count > SCENE_LIMIT || s->group_count > SCENE_LIMIT ||
        s->corner_count > SCENE_CORNER_LIMIT)
        return bad_scene(diag, "its counts are wrong");
    bool vertices = (!s->vertex_count || s->coords) && (!s->radius_count || s->radii);
    bool groups = !s->group_count || (s->group_table && s->text);
    if (!vertices || !groups) return bad_scene(diag, "a part is missing");
    if (s->group_count && (!s->text_size || s->text[0] || s->text[s->text_size - 1]))
        return bad_scene(diag, "the strings of the groups are wrong");
    if (!scene_crs_fits(s->crs_kind, s->crs, s->crs_size)) return bad_scene(diag, "its coordinate system is wrong");
    return FROE_OK;
}

bool scene_group_fits(const froe_scene *s, const scene_group *g) {
    return g->name < s->text_size && g->material < s->text_size && g->left < s->text_size && g->right < s->text_size;
}

froe_status scene_validate(const froe_scene *s, const froe_allocator *alloc, froe_diagnostic *diag) {
    froe_status status = check_frame(s, diag);
    if (!status) status = check_vertices(s, alloc, diag);
    if (!status) status = check_objects(s, alloc, diag);
    for (uint32_t i = 0; !status && i < s->group_count; i++)
        if (!scene_group_fits(s, s->group_table + i)) status = bad_scene(diag, "the strings of a group are wrong");
    return status;
}

froe_status scene_mapped(const froe_scene *arrays, const froe_allocator *caller, froe_scene **out,
                         froe_diagnostic *diag) {
    froe_allocator alloc = support_allocator(caller);
    if (!arrays->start_of || (arrays->object_count && !(arrays->kind_of && arrays->form_of && arrays->vertex_of)))
        return bad_scene(diag, "a part is missing");
    froe_status status = check_frame(arrays, diag);
    if (status) return status;
    froe_scene *s = support_calloc(&alloc, 1, sizeof *s);
    if (!s) return support_fail_memory(diag);
    *s = *arrays;
    s->alloc = alloc;
    s->mapped = true;
    s->store = NULL;
    atomic_init(&s->holds, 1);
    atomic_init(&s->trust, SCENE_UNCHECKED);
    *out = s;
    return FROE_OK;
}

static bool bounds_fit(const froe_scene *s) {
    double all_lo[FROE_MAX_DIM], all_hi[FROE_MAX_DIM];
    bool fit = true;
    for (int k = 0; k < s->dim; k++) all_lo[k] = INFINITY, all_hi[k] = -INFINITY;
    for (uint32_t i = 0; i < s->object_count; i++) {
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        scene_object_bounds(s, i, lo, hi);
        for (int k = 0; k < s->dim; k++) {
            all_lo[k] = lo[k] < all_lo[k] ? lo[k] : all_lo[k];
            all_hi[k] = hi[k] > all_hi[k] ? hi[k] : all_hi[k];
        }
    }
    for (int k = 0; k < s->dim; k++) fit = fit && s->lo[k] == all_lo[k] && s->hi[k] == all_hi[k];
    return fit;
}

froe_status froe_scene_check(const froe_scene *s, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!s) return support_fail_null(diag, __func__);
    atomic_int *trust = &((froe_scene *)(uintptr_t)s)->trust;
    const int known = atomic_load_explicit(trust, memory_order_relaxed);
    if (known == SCENE_RIGHT) return FROE_OK;
    if (known == SCENE_WRONG && !diag) return FROE_E_FORMAT;
    froe_status status = scene_validate(s, &s->alloc, diag);
    if (!status && !bounds_fit(s)) status = bad_scene(diag, "its bounds are wrong");
    if (status != FROE_E_MEMORY) atomic_store_explicit(trust, status ? SCENE_WRONG : SCENE_RIGHT, memory_order_relaxed);
    return status;
}
