/* read_motion.c: froe_read_motion: OGC Moving Features JSON (19-045r3).
 *
 *     feature -> temporalGeometry (or its prisms) -> one flight plan a point, one segment a pair of neighbours
 *                 ... with `triangles`, or a `base` that has them -> in space: a cloud of corners, or a body
 *                 ... with a `base` that has `segments` -> a body of the plane
 *
 * The file is walked twice: for its first and last instant, and for what moves. */
#include "formats/input/json.h"
#include "formats/input/source.h"
#include "formats/motion/datetime.h"
#include "formats/motion/solids.h"
#include "support/decimal/decimal.h"
#include "support/fail.h"
#include "support/floats.h"
#include "support/locale.h"
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

typedef ARRAY(double) doubles;
typedef ARRAY(size_t) sizes;

typedef struct reading {
    const char *path;
    froe_motion_read_options options;
    froe_allocator alloc;
    froe_diagnostic *diag;
    froe_motion_report report;
    froe_motion *motion; /* NULL on the first walk */
    double first, last;  /* instant of all */
    int dim;             /* 2 or 3, once a geometry was seen */
    size_t number;       /* of the feature */
    uint32_t group;
    bool flat; /* no z so far */
    bool gaps; /* a position may be null: no control point */
    /* of one geometry */
    size_t instants, points; /* points: of each instant, rings without their last */
    sizes rings, here;       /* points of each line or ring: at instant 0, and at the one being read */
    doubles times, coords, controls, second_controls;                     /* one instant after the other */
    doubles plan_times, plan_coords, plan_controls, plan_second_controls; /* one point after the other */
    doubles turns;                                                        /* of a body */
    ARRAY(uint32_t) bodies;                                               /* of each point of its base */
    sizes starts;
    ARRAY(uint32_t) vertices;
    doubles births, deaths;
    ARRAY(uint64_t) tags;
} reading;

typedef enum form { POINT, LINE, POLYGON, FORMS } form;
static const char *const forms[2][FORMS] = {{"MovingPoint", "MovingLineString", "MovingPolygon"},
                                            {"MovingPoint", "MovingPointCloud", "MovingPointCloud"}}; /* in space */

static froe_status fail_feature(const reading *r, froe_status status, const char *sentence, ...)
    __attribute__((format(printf, 3, 4)));
static froe_status fail_feature(const reading *r, froe_status status, const char *sentence, ...) {
    char own_sentence[160];
    va_list args;
    va_start(args, sentence);
    vsnprintf(own_sentence, sizeof own_sentence, sentence, args);
    va_end(args);
    return support_fail(r->diag, status, "%s: feature %zu: %s", support_short(r->path), r->number, own_sentence);
}

static froe_status no_memory(const reading *r) {
    return support_fail_memory(r->diag);
}

/* --------------------------------------------------- instants and coordinates -- */

static froe_status take_instants(reading *r, const formats_json *geometry) {
    const formats_json *datetimes = formats_json_get(geometry, "datetimes");
    r->times.count = 0;
    r->instants = formats_json_size(datetimes);
    if (!r->instants) return fail_feature(r, FROE_E_FORMAT, "Datetimes are missing.");
    FORMATS_JSON_EACH(value, datetimes) {
        double t = value->number;
        const bool known = formats_json_is(value, FORMATS_JSON_NUMBER) ||
                           (formats_json_string(value) && formats_datetime(formats_json_string(value), &t));
        if (!known)
            return fail_feature(r, FROE_E_FORMAT, "Datetime %zu is neither a number nor an ISO 8601 instant.",
                                r->times.count);
        if (!array_push(&r->alloc, &r->times, t)) return no_memory(r);
        if (t < r->first) r->first = t;
        if (t > r->last) r->last = t;
    }
    return FROE_OK;
}

static froe_status take_position(reading *r, const formats_json *position, size_t instant, doubles *to) {
    double p[3] = {NAN, NAN, NAN};
    const size_t dim = (size_t)r->dim;
    if (r->gaps && formats_json_is(position, FORMATS_JSON_NAME) && position->text[0] == 'n') /* null */
        return array_append(&r->alloc, to, p, dim) ? FROE_OK : no_memory(r);
    if (formats_json_size(position) < dim)
        return fail_feature(r, FROE_E_FORMAT, "At instant %zu a position is no array of %s numbers.", instant,
                            dim == 2 ? "two" : "three");
    const formats_json *x = position + 1;
    for (size_t k = 0; k < dim; k++, x = formats_json_next(x)) {
        if (!formats_json_is(x, FORMATS_JSON_NUMBER))
            return fail_feature(r, FROE_E_FORMAT, "At instant %zu a coordinate is not a number.", instant);
        p[k] = x->number;
    }
    if (formats_json_size(position) > dim) r->flat = false;
    return array_append(&r->alloc, to, p, dim) ? FROE_OK : no_memory(r);
}

/* One ring, without its last point, which is the first again. */
static froe_status take_ring(reading *r, const formats_json *ring, size_t instant, doubles *to) {
    const formats_json *last = NULL;
    FORMATS_JSON_EACH(position, ring) last = position;
    const size_t count = formats_json_size(ring);
    bool closed = count >= 4 && formats_json_size(ring + 1) == formats_json_size(last) && ring[1].span == last->span;
    for (size_t i = 0; closed && i < last->span; i++)
        closed = ring[1 + i].kind == last[i].kind && ring[1 + i].number == last[i].number;
    if (!closed)
        return fail_feature(r, FROE_E_INPUT, "At instant %zu a ring is not closed, or has less than three corners.",
                            instant);
    froe_status status = FROE_OK;
    for (const formats_json *position = ring + 1; position != last && !status; position = formats_json_next(position))
        status = take_position(r, position, instant, to);
    if (!status && !array_push(&r->alloc, &r->here, count - 1)) status = no_memory(r);
    return status;
}

/* The points of one instant, and how many there are in each line or ring. */
static froe_status take_geometry(reading *r, form kind, const formats_json *geometry, size_t instant, doubles *to) {
    froe_status status = FROE_OK;
    const size_t count = formats_json_size(geometry);
    r->here.count = 0;
    if (kind == POINT) return take_position(r, geometry, instant, to);
    if (!count) return fail_feature(r, FROE_E_INPUT, "At instant %zu there is no geometry.", instant);
    FORMATS_JSON_EACH(item, geometry) {
        status = kind == LINE ? take_position(r, item, instant, to) : take_ring(r, item, instant, to);
        if (status) return status;
    }
    return kind == LINE && !array_push(&r->alloc, &r->here, count) ? no_memory(r) : FROE_OK;
}

/* All instants of an array: the same points at each, in `to` one instant after the other. `first`: nothing is known of
 * the points yet. */
static froe_status take_all(reading *r, form kind, const formats_json *array, const char *what, size_t count,
                            doubles *to, bool first) {
    if (formats_json_size(array) != count)
        return fail_feature(r, FROE_E_FORMAT, "There are %zu %s for %zu instants.", formats_json_size(array), what,
                            r->instants);
    to->count = 0;
    const formats_json *geometry = array + 1;
    for (size_t i = 0; i < count; i++, geometry = formats_json_next(geometry)) {
        const froe_status status = take_geometry(r, kind, geometry, i, to);
        if (status) return status;
        const size_t lines = r->here.count;
        if (first && i == 0) {
            r->points = to->count / (size_t)r->dim;
            r->rings.count = 0;
            if (!array_append(&r->alloc, &r->rings, r->here.data, lines)) return no_memory(r);
        } else if (lines != r->rings.count ||
                   (lines && memcmp(r->here.data, r->rings.data, lines * sizeof *r->here.data) != 0)) {
            return fail_feature(r, FROE_E_INPUT, "At instant %zu it has not as many points as at instant 0.", i);
        }
    }
    return FROE_OK;
}

/* ---------------------------------------------------------------------- plans -- */

/* The parabolas with one velocity where they meet: control points  c = p0 + v h / 2,  and  v' = 2 (p1 - c) / h.  The
 * first velocity is that of the parabola through the first three instants. */
static froe_status make_spline(reading *r) {
    const double *t = r->times.data, *p = r->coords.data;
    size_t n = r->instants, width = (size_t)r->dim * r->points;
    if (n < 3) return fail_feature(r, FROE_E_INPUT, "Quadratic interpolation needs three instants.");
    r->controls.count = 0;
    if (!array_reserve(&r->alloc, &r->controls, (n - 1) * width)) return no_memory(r);
    double *c = r->controls.data;
    double h0 = t[1] - t[0], h1 = t[2] - t[1];
    for (size_t k = 0; k < width; k++) {
        double s0 = (p[width + k] - p[k]) / h0, s1 = (p[2 * width + k] - p[width + k]) / h1;
        double velocity = s0 - (s1 - s0) * h0 / (h0 + h1);
        for (size_t i = 0; i + 1 < n; i++) {
            double h = t[i + 1] - t[i], control = p[i * width + k] + 0.5 * velocity * h;
            c[i * width + k] = control;
            velocity = 2 * (p[(i + 1) * width + k] - control) / h;
        }
    }
    return FROE_OK;
}

/* Component k of the velocity at an instant: that of the parabola through it and the two next to it, at both ends
 * through the first or last three (cubic Bessel interpolation: de Boor, A Practical Guide to Splines, chapter IV). */
static double velocity_at(const reading *r, size_t i, size_t k) {
    const size_t width = (size_t)r->dim * r->points, middle = i ? i + 1 < r->instants ? i : i - 1 : 1;
    const double *t = r->times.data + middle, *p = r->coords.data + width * middle + k;
    const double before = t[0] - t[-1], after = t[1] - t[0];
    const double s0 = (p[0] - *(p - width)) / before, s1 = (p[width] - p[0]) / after;
    const double bend = (s1 - s0) / (before + after);
    return i == middle ? s0 + bend * before : i ? s1 + bend * after : s0 - bend * before;
}

/* Cubics with these velocities:  c = p0 + v0 h / 3,  d = p1 - v1 h / 3. */
static froe_status make_cubics(reading *r) {
    const double *t = r->times.data, *p = r->coords.data;
    const size_t n = r->instants, width = (size_t)r->dim * r->points;
    if (n < 3) return fail_feature(r, FROE_E_INPUT, "Cubic interpolation needs three instants.");
    r->controls.count = r->second_controls.count = 0;
    if (!array_reserve(&r->alloc, &r->controls, (n - 1) * width) ||
        !array_reserve(&r->alloc, &r->second_controls, (n - 1) * width))
        return no_memory(r);
    for (size_t i = 0; i + 1 < n; i++)
        for (size_t k = 0; k < width; k++) {
            const double h = (t[i + 1] - t[i]) / 3;
            r->controls.data[i * width + k] = p[i * width + k] + velocity_at(r, i, k) * h;
            r->second_controls.data[i * width + k] = p[(i + 1) * width + k] - velocity_at(r, i + 1, k) * h;
        }
    return FROE_OK;
}

/* The control points of all pieces, from the file or from their instants. */
static froe_status take_controls(reading *r, form kind, const formats_json *geometry, int degree) {
    const formats_json *first = formats_json_get(geometry, "controls"),
                       *second = formats_json_get(geometry, "secondControls");
    const size_t pieces = r->instants - 1;
    if (degree < 2) return FROE_OK;
    if (!first) return degree == 2 ? make_spline(r) : make_cubics(r);
    r->gaps = degree == 3;
    froe_status status = take_all(r, kind, first, "controls", pieces, &r->controls, false);
    if (!status && degree == 3)
        status = take_all(r, kind, second, "second controls", pieces, &r->second_controls, false);
    r->gaps = false;
    return status;
}

static bool put_object(reading *r, const uint32_t *corners) {
    return array_append(&r->alloc, &r->vertices, corners, r->dim) &&
           array_push(&r->alloc, &r->births, r->times.data[0]) &&
           array_push(&r->alloc, &r->deaths, r->times.data[r->instants - 1]) &&
           array_push(&r->alloc, &r->tags, r->number);
}

static bool put_segment(reading *r, size_t a, size_t b) {
    const uint32_t ends[2] = {(uint32_t)a, (uint32_t)b};
    return put_object(r, ends);
}

/* Plans, one point after the other. */
static bool make_plans(reading *r, int degree) {
    static const double none[3] = {NAN, NAN, NAN};
    const size_t dim = (size_t)r->dim;
    const froe_allocator *alloc = &r->alloc;
    r->plan_times.count = r->plan_coords.count = r->plan_controls.count = r->starts.count = 0;
    r->plan_second_controls.count = 0;
    for (size_t v = 0; v <= r->points; v++) {
        if (!array_push(alloc, &r->starts, v * r->instants)) return false;
        for (size_t i = 0; i < r->instants && v < r->points; i++) {
            const size_t at = dim * (i * r->points + v);
            const bool ends = i + 1 == r->instants;
            const double *control = degree > 1 && !ends ? r->controls.data + at : none;
            if (!array_push(alloc, &r->plan_times, r->times.data[i]) ||
                !array_append(alloc, &r->plan_coords, r->coords.data + at, dim) ||
                !array_append(alloc, &r->plan_controls, control, dim))
                return false;
            control = ends ? none : r->second_controls.data + at;
            if (degree == 3 && !array_append(alloc, &r->plan_second_controls, control, dim)) return false;
        }
    }
    return true;
}

/* Segments: lines from point to point, rings back to their first, a point to itself. */
static bool make_segments(reading *r, form kind) {
    if (kind == POINT) return put_segment(r, 0, 0);
    for (size_t k = 0, first = 0; k < r->rings.count; first += r->rings.data[k++]) {
        const size_t count = r->rings.data[k];
        for (size_t i = 0; i + (kind == LINE) < count; i++)
            if (!put_segment(r, first + i, first + (i + 1) % count)) return false;
    }
    return true;
}

/* ------------------------------------------------------------------- triangles -- */

/* Triangles, or segments of a body of the plane, of so many points: three or two numbers of theirs each. */
static froe_status take_objects(reading *r, const formats_json *array, size_t points) {
    const bool flat = r->dim == 2;
    size_t number = 0;
    FORMATS_JSON_EACH(object, array) {
        uint32_t corners[3] = {0, 0, 0};
        const formats_json *corner = object + 1;
        bool numbers = formats_json_size(object) == (size_t)r->dim;
        for (int k = 0; k < r->dim && numbers; k++, corner = formats_json_next(corner)) {
            numbers = formats_json_is(corner, FORMATS_JSON_NUMBER);
            if (numbers &&
                !(corner->number >= 0 && corner->number < (double)points && corner->number == floor(corner->number)))
                return fail_feature(r, FROE_E_INPUT,
                                    flat ? "Segment %zu has an end %g of %zu points."
                                         : "Triangle %zu has a corner %g of %zu points.",
                                    number, corner->number, points);
            corners[k] = numbers ? (uint32_t)corner->number : 0;
        }
        if (!numbers)
            return fail_feature(r, FROE_E_FORMAT,
                                flat ? "Segment %zu is no array of two numbers."
                                     : "Triangle %zu is no array of three numbers.",
                                number);
        if (!put_object(r, corners)) return no_memory(r);
        number++;
    }
    return number ? FROE_OK : fail_feature(r, FROE_E_INPUT, "There are no %s.", flat ? "segments" : "triangles");
}

/* One quaternion for each instant, or none at all; in the plane z and w of it. */
static froe_status take_turns(reading *r, const formats_json *array) {
    const size_t each = r->dim == 2 ? 2 : 4;
    r->turns.count = 0;
    if (array && formats_json_size(array) != r->instants)
        return fail_feature(r, FROE_E_FORMAT, "There are %zu turns for %zu instants.", formats_json_size(array),
                            r->instants);
    FORMATS_JSON_EACH(turn, array) {
        const formats_json *x = turn + 1;
        bool numbers = formats_json_size(turn) == each;
        for (size_t k = 0; k < each && numbers; k++, x = formats_json_next(x)) {
            numbers = formats_json_is(x, FORMATS_JSON_NUMBER);
            if (numbers && !array_push(&r->alloc, &r->turns, x->number)) return no_memory(r);
        }
        if (!numbers)
            return fail_feature(r, FROE_E_FORMAT, "Turn %zu is no array of %s numbers.", r->turns.count / each,
                                each == 2 ? "two" : "four");
    }
    return FROE_OK;
}

/* A body of the instants that were read, and the points of its base. */
static froe_status take_body(reading *r, const formats_json *geometry, int degree, froe_moving *b) {
    const formats_json *corners = formats_json_get(formats_json_get(geometry, "base"), "coordinates");
    froe_diagnostic why;
    froe_body body = froe_body_defaults();
    uint32_t id;
    if (degree == 3)
        return fail_feature(r, FROE_E_UNSUPPORTED,
                            "It is a body, which does not fly along cubics. There are: Linear, "
                            "Quadratic.");
    froe_status status = take_turns(r, formats_json_get(geometry, "turns"));
    if (status) return status;
    body.count = r->instants, body.times = r->times.data, body.coords = r->coords.data;
    body.controls = degree == 2 ? r->controls.data : NULL;
    body.turns = r->turns.count ? r->turns.data : NULL;
    status = froe_motion_add_body(r->motion, &body, &id, &why);
    if (status == FROE_E_MEMORY) return no_memory(r);
    if (status) return fail_feature(r, status, "%s", why.message);
    r->plan_times.count = r->plan_coords.count = r->starts.count = r->bodies.count = 0;
    FORMATS_JSON_EACH(corner, corners) {
        if (!array_push(&r->alloc, &r->starts, r->bodies.count) || !array_push(&r->alloc, &r->bodies, id) ||
            !array_push(&r->alloc, &r->plan_times, r->times.data[0]))
            return no_memory(r);
        status = take_position(r, corner, 0, &r->plan_coords);
        if (status) return status;
    }
    b->vertex_count = r->bodies.count;
    b->bodies = r->bodies.data;
    return array_push(&r->alloc, &r->starts, r->bodies.count) ? FROE_OK : no_memory(r);
}

/* What a geometry is made of: its batch, but for what is in the arrays of all. */
static froe_status take_batch(reading *r, form kind, const formats_json *geometry, int degree, froe_moving *b) {
    const formats_json *triangles = formats_json_get(geometry, "triangles"), *base = formats_json_get(geometry, "base");
    r->vertices.count = r->births.count = r->deaths.count = r->tags.count = 0;
    const formats_json *carried = formats_json_get(base, r->dim == 3 ? "triangles" : "segments");
    if (kind == POINT && (r->dim == 3 || carried)) {
        const froe_status status = take_body(r, geometry, degree, b);
        return status ? status : take_objects(r, carried, b->vertex_count);
    }
    b->vertex_count = r->points;
    if (!make_plans(r, degree)) return no_memory(r);
    b->controls = r->plan_controls.data;
    if (degree == 3) b->second_controls = r->plan_second_controls.data;
    if (r->dim == 3) return take_objects(r, triangles, r->points);
    return make_segments(r, kind) ? FROE_OK : no_memory(r);
}

static froe_status add_geometry(reading *r, form kind, const formats_json *geometry) {
    static const char *const names[] = {"", "Linear", "Quadratic", "Cubic"};
    const formats_json *said = formats_json_get(geometry, "interpolation");
    froe_status status =
        take_all(r, kind, formats_json_get(geometry, "coordinates"), "geometries", r->instants, &r->coords, true);
    if (status) return status;
    if (!said) said = formats_json_get(geometry, "interpolations"); /* drafts */
    if (formats_json_size(said)) said = said + 1;
    const char *name = formats_json_string(said) ? formats_json_string(said) : "Linear";
    int degree = 3;
    while (degree && strcmp(name, names[degree]) != 0) degree--;
    if (!degree)
        return fail_feature(r, FROE_E_UNSUPPORTED,
                            "There is no interpolation '%.40s'. There are: Linear, Quadratic, Cubic.", name);
    status = take_controls(r, kind, geometry, degree);
    froe_moving b = froe_moving_defaults();
    if (!status) status = take_batch(r, kind, geometry, degree, &b);
    if (status) return status;
    froe_diagnostic why;
    b.starts = r->starts.data;
    b.times = r->plan_times.data;
    b.coords = r->plan_coords.data;
    b.count = r->tags.count;
    b.vertices = r->vertices.data;
    b.births = r->births.data;
    b.deaths = r->deaths.data;
    b.tags = r->tags.data;
    b.group = r->group;
    status = froe_motion_add(r->motion, &b, &why);
    if (status == FROE_E_MEMORY) return no_memory(r);
    r->report.pieces += r->points * (r->instants - 1);
    return status ? fail_feature(r, status, "%s", why.message) : FROE_OK;
}

/* -------------------------------------------------------------------- features -- */

static froe_status take_moving(reading *r, const formats_json *geometry) {
    const char *type = formats_json_string(formats_json_get(geometry, "type"));
    const formats_json *base = formats_json_get(geometry, "base");
    const int dim = formats_json_get(geometry, "triangles") || formats_json_get(base, "triangles") ? 3 : 2;
    if (r->dim && r->dim != dim)
        return fail_feature(r, FROE_E_INPUT, "It moves in %s, and those before it do not.",
                            dim == 3 ? "space" : "the plane");
    const bool carried = dim == 2 && formats_json_get(base, "segments");
    if (dim == 2 && !carried && formats_json_get(base, "coordinates"))
        return fail_feature(r, FROE_E_FORMAT, "Its base has coordinates, but neither triangles nor segments.");
    if (dim == 2 && !carried && formats_json_get(geometry, "turns"))
        return fail_feature(r, FROE_E_FORMAT, "It has turns, but no base with triangles or segments.");
    if (!type) return fail_feature(r, FROE_E_FORMAT, "Its moving geometry has no type.");
    r->dim = dim;
    int which = 0;
    while (which < FORMS && strcmp(type, forms[dim - 2][which]) != 0) which++;
    if (carried && which != POINT && which != FORMS)
        return fail_feature(r, FROE_E_FORMAT, "It has a base with segments, and is no MovingPoint.");
    if (which == FORMS)
        return fail_feature(r, FROE_E_UNSUPPORTED, "There is no moving geometry of type '%.40s'.", type);
    froe_status status = take_instants(r, geometry);
    return status || !r->motion ? status : add_geometry(r, (form)which, geometry);
}

/* What a feature is called: by its properties, or its id, or its first property that is a string; or else `number`,
 * which an id in digits replaces. */
static const char *name_of_feature(const formats_json *feature, char number[32]) {
    static const char *const keys[] = {"name", "title", "label", "id"};
    const formats_json *properties = formats_json_get(feature, "properties"), *id = formats_json_get(feature, "id");
    const char *name = NULL;
    for (size_t i = 0; i < sizeof keys / sizeof *keys && !name; i++)
        name = formats_json_string(formats_json_get(properties, keys[i]));
    if (!name) name = formats_json_string(id);
    const bool more = !name && formats_json_is(properties, FORMATS_JSON_OBJECT);
    const formats_json *value = more ? properties + 2 : NULL;
    for (size_t i = 0; more && i < properties->count && !name; i++, value = formats_json_next(value) + 1)
        name = formats_json_string(value);
    if (name) return name;
    size_t digits = formats_json_is(id, FORMATS_JSON_NUMBER) ? strspn(id->text, "-0123456789") : 0;
    if (digits && digits < 32 && !strchr(".eE", id->text[digits])) snprintf(number, 32, "%.*s", (int)digits, id->text);
    return number;
}

static froe_status take_feature(reading *r, const formats_json *feature) {
    const formats_json *geometry = formats_json_get(feature, "temporalGeometry");
    const formats_json *prisms = formats_json_get(geometry, "prisms");
    froe_status status = FROE_OK;
    if (!formats_json_is(geometry, FORMATS_JSON_OBJECT)) {
        r->report.still += r->motion != NULL;
        return FROE_OK;
    }
    if (r->motion) {
        char number[32];
        snprintf(number, sizeof number, "%zu", r->number);
        const froe_group group = {.name = name_of_feature(feature, number)};
        r->flat = true;
        r->report.features++;
        status = froe_motion_add_group(r->motion, &group, &r->group);
        if (status == FROE_E_MEMORY) return no_memory(r);
        if (status) return fail_feature(r, status, "There is no room for its name.");
    }
    if (!prisms) status = take_moving(r, geometry);
    FORMATS_JSON_EACH(prism, prisms) if (!status) status = take_moving(r, prism);
    if (!r->flat && r->motion) r->report.flattened++;
    return status;
}

static froe_status take_features(reading *r, const formats_json *root) {
    const formats_json *features = formats_json_get(root, "features");
    const char *type = formats_json_string(formats_json_get(root, "type"));
    r->number = 0;
    if (type && strcmp(type, "Feature") == 0) return take_feature(r, root);
    if (!formats_json_is(features, FORMATS_JSON_ARRAY))
        return support_fail(r->diag, FROE_E_FORMAT, "%s: The file is neither a Feature nor a FeatureCollection.",
                            support_short(r->path));
    FORMATS_JSON_EACH(feature, features) {
        froe_status status = take_feature(r, feature);
        if (status) return status;
        r->number++;
    }
    return FROE_OK;
}

/* ------------------------------------------------------------------------ file -- */

static froe_status open_window(reading *r) {
    froe_diagnostic why;
    froe_motion_options w = froe_motion_defaults();
    w.dim = r->dim == 3 ? 3 : 2;
    if (!(r->first <= r->last))
        return support_fail(r->diag, FROE_E_INPUT, "%s: Nothing in the file moves.", support_short(r->path));
    if (r->first == r->last)
        return support_fail(r->diag, FROE_E_INPUT, "%s: All of the file is at one instant, %.17g.",
                            support_short(r->path), r->first);
    w.begin = isnan(r->options.from) ? r->first : r->options.from;
    w.end = isnan(r->options.to) ? r->last : r->options.to;
    if (w.begin > r->last || w.end < r->first)
        return support_fail(r->diag, FROE_E_INPUT,
                            "%s: Nothing is there from %.17g to %.17g, for all is from %.17g to %.17g.",
                            support_short(r->path), w.begin, w.end, r->first, r->last);
    froe_status status = froe_motion_new(&w, r->options.alloc, &r->motion, &why);
    if (status == FROE_E_MEMORY) return no_memory(r);
    return status ? support_fail(r->diag, status, "%s: %s", support_short(r->path), why.message) : FROE_OK;
}

froe_status formats_load_motion(const char *path, const froe_allocator *alloc, formats_text *text,
                                froe_diagnostic *diag) {
    enum { PART = 1 << 16, BEHIND = 1 + SUPPORT_DECIMAL_AHEAD };
    FILE *file = fopen(path, "r");
    if (!file) return support_fail_file(diag, "read", path, errno);
    size_t got = PART;
    while (got == PART && array_reserve(alloc, text, PART)) {
        got = fread(text->data + text->count, 1, PART, file);
        text->count += got;
    }
    int error = ferror(file) ? errno : 0;
    fclose(file);
    if (error) return support_fail_file(diag, "read", path, error);
    if (got == PART || !array_reserve(alloc, text, BEHIND)) return support_fail_memory(diag);
    text->count = formats_drop_mark(text->data, text->count);
    memset(text->data + text->count, 0, BEHIND);
    return FROE_OK;
}

static froe_status read_file(reading *r) {
    const froe_allocator *alloc = &r->alloc;
    formats_text text = {0};
    formats_json_values values = {0};
    formats_json_error error;
    support_locale locale;
    froe_status status = formats_load_motion(r->path, alloc, &text, r->diag);
    if (!status && !support_locale_enter(&locale)) status = no_memory(r);
    if (!status) {
        status = formats_json_read(alloc, text.data, text.count, &values, &error);
        support_locale_leave(&locale);
        if (status == FROE_E_MEMORY) no_memory(r);
        if (status == FROE_E_FORMAT)
            support_fail(r->diag, status, "%s: line %zu: %s", support_short(r->path), error.line, error.sentence);
    }
    if (!status) status = take_features(r, values.data);
    if (!status) status = open_window(r);
    if (!status) status = take_features(r, values.data);
    array_free(alloc, &values);
    array_free(alloc, &text);
    doubles *const numbers[] = {&r->times,      &r->coords,      &r->controls,      &r->second_controls,
                                &r->plan_times, &r->plan_coords, &r->plan_controls, &r->plan_second_controls,
                                &r->births,     &r->deaths,      &r->turns};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) array_free(alloc, numbers[i]);
    array_free(alloc, &r->rings);
    array_free(alloc, &r->here);
    array_free(alloc, &r->starts);
    array_free(alloc, &r->vertices);
    array_free(alloc, &r->bodies);
    array_free(alloc, &r->tags);
    return status;
}

void froe_motion_read_defaults_into(froe_motion_read_options *out, size_t size) {
    const froe_motion_read_options all = {.size = size, .from = NAN, .to = NAN, .deviation = 1e-3};
    support_defaults(out, size, &all, sizeof all);
}

froe_status froe_read_motion(const char *path, const froe_motion_read_options *options, froe_motion **out,
                             froe_motion_report *report, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    double start = formats_seconds();
    if (!path || !out) return support_fail_null(diag, __func__);
    if (options && options->size != sizeof *options) return support_fail_defaults(diag, "froe_motion_read_defaults");
    reading r = {.path = path, .options = options ? *options : froe_motion_read_defaults(), .diag = diag};
    r.alloc = support_allocator(r.options.alloc);
    r.first = (double)INFINITY;
    r.last = -(double)INFINITY;
    froe_status status = read_file(&r);
    if (status) {
        froe_motion_free(r.motion);
        return status;
    }
    r.report.up = 2;
    r.report.seconds = formats_seconds() - start;
    if (report) *report = r.report;
    *out = r.motion;
    return FROE_OK;
}
