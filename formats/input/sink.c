/* sink.c: batches on their way into a scene. */
#include "formats/input/sink.h"
#include "formats/input/triangulate.h"
#include "support/floats.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* The scene takes large batches more quickly than small ones, above all where they are not small beside it. */
enum { BATCH_OBJECTS = 1 << 20, BATCH_DOUBLES = 10 << 20, INDEXED_OBJECTS = 1 << 24 };

froe_status formats_sink_open(formats_sink *sink, int dim) {
    sink->dim = dim;
    sink->group = sink->face = FROE_NONE;
    froe_status status = froe_scene_new(dim, &sink->alloc, &sink->scene);
    if (status == FROE_E_MEMORY) return support_fail_memory(sink->diag);
    return status ? support_fail(sink->diag, status, "%s: No scene of dimension %d can be made.",
                                 support_short(sink->path), dim)
                  : FROE_OK;
}

void formats_sink_free(formats_sink *sink) {
    array_free(&sink->alloc, &sink->points);
    array_free(&sink->alloc, &sink->coords);
    array_free(&sink->alloc, &sink->gathered);
    array_free(&sink->alloc, &sink->indices);
    array_free(&sink->alloc, &sink->radii);
    array_free(&sink->alloc, &sink->starts);
    array_free(&sink->alloc, &sink->object_faces);
    array_free(&sink->alloc, &sink->groups);
    array_free(&sink->alloc, &sink->tags);
    froe_scene_free(sink->scene);
    sink->scene = NULL;
}

froe_status formats_sink_fail(formats_sink *sink, froe_status status, const char *sentence, ...) {
    char own_sentence[160], inside[72] = "";
    va_list args;
    va_start(args, sentence);
    vsnprintf(own_sentence, sizeof own_sentence, sentence, args);
    va_end(args);
    if (sink->inside && *sink->inside) snprintf(inside, sizeof inside, " of '%.60s'", sink->inside);
    support_fail(sink->diag, status, "%s: %s %llu%s: %s", support_short(sink->path), sink->unit ? sink->unit : "object",
                 (unsigned long long)sink->number, inside, own_sentence);
    if (sink->diag) sink->diag->object = sink->total < FROE_NONE ? (uint32_t)sink->total : FROE_NONE;
    return status;
}

froe_status formats_sink_progress(formats_sink *sink, double done) {
    volatile const double share = done < 1 ? done : 1;
    if (!sink->progress || support_callback(sink->progress(sink->user, share))) return FROE_OK;
    return support_fail_cancelled(sink->diag);
}

/* ------------------------------------------------------------- the batch -- */

static bool has_starts(froe_kind kind) {
    return kind == FROE_POLYGON || kind == FROE_HULL;
}

static froe_status flush(formats_sink *sink) {
    if (!sink->count) return FROE_OK;
    froe_objects batch = froe_objects_defaults();
    batch.kind = sink->kind;
    batch.count = sink->count;
    batch.coords = sink->indexed ? sink->points.data : sink->coords.data;
    batch.indices = sink->indexed ? sink->indices.data : NULL;
    batch.point_count = sink->indexed ? sink->points.count / (size_t)sink->dim : 0;
    batch.starts = has_starts(sink->kind) ? sink->starts.data : NULL;
    batch.radii = sink->kind == FROE_BALL ? sink->radii.data : NULL;
    batch.tags = sink->tags.data;
    batch.faces = sink->object_faces.data;
    batch.groups = sink->groups.data;
    froe_diagnostic why = {.object = FROE_NONE, .corner = FROE_NONE, .axis = FROE_NONE};
    if (sink->deliver) batch.faces = batch.groups = NULL; /* each its own, and none */
    froe_status status = sink->deliver ? support_callback(sink->deliver(sink->deliver_user, sink->dim, &batch, &why))
                                       : froe_scene_add(sink->scene, &batch, &why);
    if (status && sink->deliver) {
        if (!*why.message)
            return support_fail(sink->diag, status, "%s: The function that takes the objects returned %s.",
                                support_short(sink->path), froe_status_name(status));
        why.status = status;
        if (sink->diag) *sink->diag = why;
        return status;
    }
    if (status) {
        const char *path = support_short(sink->path), *sentence = strstr(why.message, ": ");
        if (why.object == FROE_NONE || !sentence) return support_fail(sink->diag, status, "%s: %s", path, why.message);
        const size_t object = sink->total - sink->count + why.object;
        sentence += 2; /* behind "ball 1: ", which counts within the batch */
        return support_fail_at(sink->diag, status, (uint32_t)object, why.corner, why.axis, "%s: object %zu: %s", path,
                               object, sentence);
    }
    sink->coords.count = sink->indices.count = sink->radii.count = sink->starts.count = 0;
    sink->object_faces.count = sink->groups.count = sink->tags.count = 0;
    sink->count = 0;
    return FROE_OK;
}

/* Before up to `count` objects of this kind: hands a batch over where it is full or of another kind. *fits: the new one
 * takes so many of them, at least one. */
static froe_status begin_put(formats_sink *sink, froe_kind kind, bool indexed, size_t count, size_t *fits) {
    const size_t most = indexed ? INDEXED_OBJECTS : BATCH_OBJECTS;
    const bool full = sink->count >= most || sink->coords.count > BATCH_DOUBLES;
    if (full || (sink->count && (kind != sink->kind || indexed != sink->indexed))) {
        const froe_status status = flush(sink);
        if (status) return status;
    }
    const size_t limit = sink->deliver ? SIZE_MAX : FROE_NONE - 1; /* a scene has no more */
    if (sink->total >= limit) return formats_sink_fail(sink, FROE_E_LIMIT, "There are more than 2^32 - 2 objects.");
    const size_t left = limit - sink->total, room = most - sink->count;
    if (count > left) count = left;
    *fits = count < room ? count : room;
    sink->kind = kind;
    sink->indexed = indexed;
    return FROE_OK;
}

/* Faces, groups and tags of the next `count` objects. */
static bool put_descriptions(formats_sink *sink, size_t count) {
    const froe_allocator *alloc = &sink->alloc;
    if (!array_reserve(alloc, &sink->object_faces, count) || !array_reserve(alloc, &sink->groups, count) ||
        !array_reserve(alloc, &sink->tags, count))
        return false;
    for (size_t i = sink->count, end = i + count; i < end; i++, sink->total++) {
        sink->object_faces.data[i] = sink->face == FROE_NONE ? (uint32_t)sink->total : sink->face;
        sink->groups.data[i] = sink->group;
        sink->tags.data[i] = sink->tagged ? sink->tag : sink->total;
    }
    sink->count += count;
    sink->object_faces.count = sink->groups.count = sink->tags.count = sink->count;
    return true;
}

/* indices: of the points, or NULL. */
static froe_status put_in_sink(formats_sink *sink, froe_kind kind, const double *coords, const uint32_t *indices,
                               size_t corners) {
    size_t fits;
    const froe_status status = begin_put(sink, kind, indices, 1, &fits);
    if (status) return status;
    const froe_allocator *alloc = &sink->alloc;
    const size_t dim = (size_t)sink->dim, start = indices ? sink->indices.count : sink->coords.count / dim;
    const bool first = has_starts(kind) && !sink->count;
    if ((first && !array_push(alloc, &sink->starts, start)) ||
        (has_starts(kind) && !array_push(alloc, &sink->starts, start + corners)) ||
        (indices ? !array_append(alloc, &sink->indices, indices, corners)
                 : !array_append(alloc, &sink->coords, coords, corners * dim)) ||
        !put_descriptions(sink, 1))
        return support_fail_memory(sink->diag);
    return FROE_OK;
}

/* Segments between neighbours of points that are finite. */
static froe_status put_segments(formats_sink *sink, const double *points, size_t count) {
    const size_t dim = (size_t)sink->dim;
    for (size_t fits = 0; count > 1; points += fits * dim, count -= fits) {
        const froe_status status = begin_put(sink, FROE_SEGMENT, false, count - 1, &fits);
        if (status) return status;
        if (!array_reserve(&sink->alloc, &sink->coords, 2 * fits * dim)) return support_fail_memory(sink->diag);
        double *to = sink->coords.data + sink->coords.count;
        for (size_t i = 0; i < fits; i++, to += 2 * dim) memcpy(to, points + i * dim, 2 * dim * sizeof *to);
        sink->coords.count += 2 * fits * dim;
        if (!put_descriptions(sink, fits)) return support_fail_memory(sink->diag);
    }
    return FROE_OK;
}

froe_status formats_sink_crs(formats_sink *sink, const froe_crs *crs) {
    const froe_status status = froe_scene_set_crs(sink->scene, crs);
    if (status == FROE_E_MEMORY) return support_fail_memory(sink->diag);
    return status ? support_fail(sink->diag, status, "%s: The definition of its coordinate system is too long.",
                                 support_short(sink->path))
                  : FROE_OK;
}

/* Can all coordinates be longitudes and latitudes in degrees? */
static bool are_degrees(const froe_scene *scene) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    return !froe_scene_bounds(scene, lo, hi) || (lo[0] >= -180 && hi[0] <= 180 && lo[1] >= -90 && hi[1] <= 90);
}

froe_status formats_sink_take(formats_sink *sink, froe_scene **scene) {
    froe_status status = formats_sink_end_feature(sink);
    if (!status) status = flush(sink);
    if (!status && (sink->guessed || sink->promised) && !are_degrees(sink->scene)) {
        sink->report.no_degrees = sink->promised;
        status = formats_sink_crs(sink, &(froe_crs){.kind = FROE_CRS_UNKNOWN});
    }
    if (status) return status;
    *scene = sink->scene;
    sink->scene = NULL;
    return FROE_OK;
}

/* ------------------------------------------------------ features, groups -- */

froe_status formats_sink_feature(formats_sink *sink, uint64_t number) {
    froe_status status = formats_sink_end_feature(sink);
    sink->number = number;
    sink->group = sink->face = FROE_NONE;
    ++sink->report.features;
    return status;
}

static froe_status put_bounds(formats_sink *sink, formats_bounds *bounds) {
    double corners[2 * FROE_MAX_DIM];
    if (!bounds->any) return FROE_OK;
    memcpy(corners, bounds->lo, (size_t)sink->dim * sizeof(double));
    memcpy(corners + sink->dim, bounds->hi, (size_t)sink->dim * sizeof(double));
    bounds->any = false;
    sink->face = FROE_NONE;
    return put_in_sink(sink, FROE_BOX, corners, NULL, 2);
}

froe_status formats_sink_end_feature(formats_sink *sink) {
    formats_bounds *all = &sink->bounds, *half = sink->half;
    if (!sink->halves || !(all->hi[0] - all->lo[0] > 180)) {
        half[0].any = half[1].any = false;
        return put_bounds(sink, all);
    }
    all->any = false;
    const froe_status status = put_bounds(sink, half);
    return status ? status : put_bounds(sink, half + 1);
}

froe_status formats_sink_group(formats_sink *sink, const froe_group *group) {
    froe_status status = froe_scene_add_group(sink->scene, group, &sink->group);
    if (status == FROE_E_MEMORY) return support_fail_memory(sink->diag);
    if (status)
        return formats_sink_fail(sink, status, "Its group '%.60s' cannot be added.", group->name ? group->name : "");
    ++sink->report.groups;
    return FROE_OK;
}

void formats_sink_new_face(formats_sink *sink) {
    sink->face = sink->total < FROE_NONE ? (uint32_t)sink->total : FROE_NONE;
}

/* --------------------------------------------------------------- objects -- */

static const char *axis_name(int axis) {
    static const char *const names[FROE_MAX_DIM] = {"x", "y", "z", "w", "x5", "x6", "x7", "x8"};
    return names[axis];
}

static froe_status all_finite(formats_sink *sink, const double *coords, size_t corners) {
    size_t count = corners * (size_t)sink->dim;
    for (size_t i = 0; i < count; ++i) {
        if (isfinite(coords[i])) continue;
        int axis = (int)(i % (size_t)sink->dim);
        size_t corner = i / (size_t)sink->dim;
        froe_status status =
            formats_sink_fail(sink, FROE_E_INPUT, "Coordinate %s of corner %zu is %g, not a finite number.",
                              axis_name(axis), corner, coords[i]);
        if (sink->diag) sink->diag->corner = (uint32_t)corner, sink->diag->axis = (uint32_t)axis;
        return status;
    }
    return FROE_OK;
}

static void widen(const formats_sink *sink, formats_bounds *bounds, const double *lo, const double *hi) {
    for (int k = 0; k < sink->dim; k++) {
        if (!bounds->any || lo[k] < bounds->lo[k]) bounds->lo[k] = lo[k];
        if (!bounds->any || hi[k] > bounds->hi[k]) bounds->hi[k] = hi[k];
    }
    bounds->any = true;
}

/* Checks; then adds the object, or with `boxes` only widens the feature's box. */
static froe_status add_to_sink(formats_sink *sink, froe_kind kind, const double *coords, const uint32_t *indices,
                               size_t corners) {
    froe_status status = all_finite(sink, coords, corners);
    if (status) return status;
    if (!sink->boxes) return put_in_sink(sink, kind, coords, indices, corners);
    if (!corners) return FROE_OK;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    for (size_t i = 0; i < corners * (size_t)sink->dim; ++i) {
        const size_t k = i % (size_t)sink->dim;
        const bool first = i < (size_t)sink->dim;
        if (first || coords[i] < lo[k]) lo[k] = coords[i];
        if (first || coords[i] > hi[k]) hi[k] = coords[i];
    }
    widen(sink, &sink->bounds, lo, hi);
    const double west = lo[0], east = hi[0];
    hi[0] = fmin(east, 0);
    if (sink->halves && west <= 0) widen(sink, sink->half, lo, hi);
    lo[0] = fmax(west, 0), hi[0] = east;
    if (sink->halves && east >= 0) widen(sink, sink->half + 1, lo, hi);
    return FROE_OK;
}

froe_status formats_sink_point(formats_sink *sink, const double *p) {
    return add_to_sink(sink, FROE_POINT, p, NULL, 1);
}

static froe_status add_pair(formats_sink *sink, froe_kind kind, const double *a, const double *b) {
    double corners[2 * FROE_MAX_DIM];
    memcpy(corners, a, (size_t)sink->dim * sizeof(double));
    memcpy(corners + sink->dim, b, (size_t)sink->dim * sizeof(double));
    return add_to_sink(sink, kind, corners, NULL, 2);
}

froe_status formats_sink_segment(formats_sink *sink, const double *a, const double *b) {
    return add_pair(sink, FROE_SEGMENT, a, b);
}

froe_status formats_sink_line(formats_sink *sink, const double *points, size_t count) {
    const size_t dim = (size_t)sink->dim;
    double odd = 0; /* not 0 where a number is not finite: then the segment is found that has it */
    for (size_t i = 0; i < count * dim; i++) odd += points[i] - points[i];
    if (odd == 0 && !sink->boxes) return put_segments(sink, points, count);
    froe_status status = FROE_OK;
    for (size_t i = 0; i + 1 < count && !status; i++)
        status = formats_sink_segment(sink, points + i * dim, points + (i + 1) * dim);
    return status;
}

froe_status formats_sink_hull(formats_sink *sink, const double *corners, size_t count) {
    return add_to_sink(sink, FROE_HULL, corners, NULL, count);
}

froe_status formats_sink_box(formats_sink *sink, const double *lo, const double *hi) {
    for (int k = 0; k < sink->dim; ++k)
        if (lo[k] > hi[k])
            return formats_sink_fail(sink, FROE_E_INPUT,
                                     "Its low corner %.17g is above its high corner %.17g on axis %s.", lo[k], hi[k],
                                     axis_name(k));
    return add_pair(sink, FROE_BOX, lo, hi);
}

froe_status formats_sink_ball(formats_sink *sink, const double *centre, double radius) {
    froe_status status = all_finite(sink, centre, 1);
    if (status) return status;
    if (!(radius >= 0) || !isfinite(radius))
        return formats_sink_fail(sink, FROE_E_INPUT, "Its radius is %.17g, not a finite number >= 0.", radius);
    for (int k = 0; k < sink->dim; ++k)
        if (isinf(nextafter(centre[k] - radius, -INFINITY)) || isinf(nextafter(centre[k] + radius, INFINITY)))
            return formats_sink_fail(sink, FROE_E_INPUT, "It reaches beyond the range of doubles.");
    if (sink->boxes) { /* one unit in the last place outwards, so that the box contains the ball */
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        for (int k = 0; k < sink->dim; ++k) {
            lo[k] = radius > 0 ? nextafter(centre[k] - radius, -INFINITY) : centre[k];
            hi[k] = radius > 0 ? nextafter(centre[k] + radius, INFINITY) : centre[k];
        }
        return add_pair(sink, FROE_BOX, lo, hi);
    }
    status = put_in_sink(sink, FROE_BALL, centre, NULL, 1);
    if (!status && !array_push(&sink->alloc, &sink->radii, radius)) return support_fail_memory(sink->diag);
    return status;
}

froe_status formats_sink_triangle(formats_sink *sink, const double *a, const double *b, const double *c) {
    double corners[3 * FROE_MAX_DIM];
    const double *from[3] = {a, b, c};
    for (int i = 0; i < 3; ++i) memcpy(corners + i * sink->dim, from[i], (size_t)sink->dim * sizeof(double));
    return add_to_sink(sink, FROE_POLYGON, corners, NULL, 3);
}

void formats_sink_up(formats_sink *sink, int axis) {
    (void)froe_scene_set_up(sink->scene, axis); /* it is not frozen yet */
}

/* The core decides whether it takes the polygon as it is. */
static froe_status polygon_fits(formats_sink *sink, const double *corners, size_t count, bool *fits) {
    froe_scene *trial;
    froe_status status = froe_scene_new(sink->dim, &sink->alloc, &trial);
    if (status) return support_fail_memory(sink->diag);
    size_t starts[2] = {0, count};
    froe_objects one = froe_objects_defaults();
    one.kind = FROE_POLYGON;
    one.count = 1;
    one.coords = corners;
    one.starts = starts;
    status = froe_scene_add(trial, &one, NULL);
    froe_scene_free(trial);
    *fits = !status;
    if (status == FROE_E_MEMORY) return support_fail_memory(sink->diag);
    return FROE_OK;
}

/* indices: of the corners, or NULL. */
static froe_status add_face(formats_sink *sink, const double *corners, const uint32_t *indices, size_t count) {
    if (count == 1) return formats_sink_point(sink, corners);
    if (count == 2) return formats_sink_segment(sink, corners, corners + 3);
    if (count == 3 || sink->boxes) return add_to_sink(sink, FROE_POLYGON, corners, indices, count);
    froe_status status = all_finite(sink, corners, count);
    bool whole = false;
    if (!status && sink->faces == FROE_FACES_POLYGONS) status = polygon_fits(sink, corners, count, &whole);
    if (status) return status;
    formats_sink_new_face(sink);
    formats_indices triangles = {0};
    if (whole)
        status = put_in_sink(sink, FROE_POLYGON, corners, indices, count);
    else if (++sink->report.triangulated, !formats_triangulate(&sink->alloc, corners, count, &triangles))
        status = support_fail_memory(sink->diag);
    for (size_t t = 0; t < triangles.count && !status; t += 3) { /* there may be none */
        const uint32_t *at = triangles.data + t;
        double triangle[9];
        const uint32_t named[3] = {indices ? indices[at[0]] : 0, indices ? indices[at[1]] : 0,
                                   indices ? indices[at[2]] : 0};
        for (int i = 0; i < 3; i++) memcpy(triangle + 3 * i, corners + 3 * at[i], 3 * sizeof *corners);
        status = put_in_sink(sink, FROE_POLYGON, triangle, indices ? named : NULL, 3);
    }
    array_free(&sink->alloc, &triangles);
    sink->face = FROE_NONE;
    return status;
}

froe_status formats_sink_face(formats_sink *sink, const double *corners, size_t count) {
    return add_face(sink, corners, NULL, count);
}

froe_status formats_sink_indexed_face(formats_sink *sink, const uint32_t *indices, size_t count) {
    if (sink->points.count / 3 >= FROE_NONE)
        return formats_sink_fail(sink, FROE_E_LIMIT, "There are more than 2^32 - 2 points.");
    if (!array_reserve(&sink->alloc, &sink->gathered, 3 * count)) return support_fail_memory(sink->diag);
    for (size_t i = 0; i < count; i++)
        memcpy(sink->gathered.data + 3 * i, sink->points.data + 3 * (size_t)indices[i], 3 * sizeof(double));
    return add_face(sink, sink->gathered.data, indices, count);
}
