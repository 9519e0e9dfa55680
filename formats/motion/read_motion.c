/* read_motion.c: OGC Moving Features JSON (19-045r3).
 *
 *     feature -> temporalGeometry (or its prisms) -> one flight plan a point, one segment a pair of neighbours
 *
 * The file is walked twice: for its first and last instant, and for what moves. */
#include "formats/motion/datetime.h"
#include "formats/motion/json.h"
#include "support/floats.h"
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

typedef struct reading {
    const char *path;
    froe_motion_read_options options;
    froe_allocator alloc;
    froe_diagnostic *diag;
    froe_motion_report report;
    froe_motion *motion; /* NULL on the first walk */
    double first, last;  /* instant of all */
    size_t number;       /* of the feature */
    uint32_t group;
    bool flat; /* no z so far */
    /* of one geometry */
    formats_buffer times, coords, controls, starts, vertices, births, deaths, tags;
    size_t instants, points; /* points: of each instant, rings without their last */
} reading;

typedef enum form { POINT, LINE, POLYGON, FORMS } form;
static const char *const forms[FORMS] = {"MovingPoint", "MovingLineString", "MovingPolygon"};

static froe_status fail_feature(const reading *r, froe_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
static froe_status fail_feature(const reading *r, froe_status status, const char *format, ...) {
    char reason[160];
    va_list args;
    va_start(args, format);
    vsnprintf(reason, sizeof reason, format, args);
    va_end(args);
    return support_fail(r->diag, status, "%s: feature %zu: %s", support_short(r->path), r->number, reason);
}

static froe_status no_memory(const reading *r) {
    return support_fail_memory(r->diag);
}

/* -------------------------------------------------------------------- instants -- */

static froe_status take_instant(const reading *r, const formats_json *value, size_t i, double *out) {
    if (formats_json_is(value, FORMATS_JSON_NUMBER))
        *out = value->number;
    else if (!formats_json_string(value) || !formats_datetime(formats_json_string(value), out))
        return fail_feature(r, FROE_E_FORMAT, "datetime %zu is neither a number nor an ISO 8601 instant", i);
    return FROE_OK;
}

static froe_status take_instants(reading *r, const formats_json *geometry) {
    const formats_json *datetimes = formats_json_get(geometry, "datetimes");
    size_t i = 0;
    r->times.size = 0;
    r->instants = formats_json_size(datetimes);
    if (!r->instants) return fail_feature(r, FROE_E_FORMAT, "datetimes are missing");
    FORMATS_JSON_EACH(value, datetimes) {
        double t = 0;
        froe_status status = take_instant(r, value, i++, &t);
        if (status) return status;
        if (!formats_buffer_put(&r->alloc, &r->times, &t, sizeof t)) return no_memory(r);
        if (t < r->first) r->first = t;
        if (t > r->last) r->last = t;
    }
    return FROE_OK;
}

/* ------------------------------------------------------------------ coordinates -- */

static froe_status take_position(reading *r, const formats_json *position, size_t instant, formats_buffer *to) {
    double p[2];
    if (formats_json_size(position) < 2)
        return fail_feature(r, FROE_E_FORMAT, "at instant %zu a position is no array of two numbers", instant);
    const formats_json *x = position + 1;
    for (size_t k = 0; k < 2; k++, x = formats_json_next(x)) {
        if (!formats_json_is(x, FORMATS_JSON_NUMBER))
            return fail_feature(r, FROE_E_FORMAT, "at instant %zu a coordinate is no number", instant);
        p[k] = x->number;
    }
    if (formats_json_size(position) > 2) r->flat = false;
    return formats_buffer_put(&r->alloc, to, p, sizeof p) ? FROE_OK : no_memory(r);
}

/* Are two values arrays of the same numbers? */
static bool are_equal(const formats_json *a, const formats_json *b) {
    if (formats_json_size(a) != formats_json_size(b) || a->span != b->span) return false;
    for (size_t i = 0; i < a->span; i++)
        if (a[i].kind != b[i].kind || a[i].number != b[i].number) return false;
    return true;
}

/* One ring, without its last point, which is the first again; `rings` receives its number of points. */
static froe_status take_ring(reading *r, const formats_json *ring, size_t instant, formats_buffer *to,
                             formats_buffer *rings) {
    const formats_json *last = NULL;
    FORMATS_JSON_EACH(position, ring) last = position;
    size_t count = formats_json_size(ring);
    if (count < 4 || !are_equal(ring + 1, last))
        return fail_feature(r, FROE_E_INPUT, "at instant %zu a ring is not closed, or has less than three corners",
                            instant);
    froe_status status = FROE_OK;
    for (const formats_json *position = ring + 1; position != last && !status; position = formats_json_next(position))
        status = take_position(r, position, instant, to);
    count--;
    if (!status && !formats_buffer_put(&r->alloc, rings, &count, sizeof count)) status = no_memory(r);
    return status;
}

/* The points of one instant, and how many there are in each line or ring. */
static froe_status take_geometry(reading *r, form kind, const formats_json *geometry, size_t instant,
                                 formats_buffer *to, formats_buffer *rings) {
    froe_status status = FROE_OK;
    size_t count = formats_json_size(geometry);
    if (kind == POINT) return take_position(r, geometry, instant, to);
    if (!count) return fail_feature(r, FROE_E_INPUT, "at instant %zu there is no geometry", instant);
    FORMATS_JSON_EACH(item, geometry) {
        if (kind == LINE)
            status = take_position(r, item, instant, to);
        else
            status = take_ring(r, item, instant, to, rings);
        if (status) return status;
    }
    if (kind == LINE && !formats_buffer_put(&r->alloc, rings, &count, sizeof count)) status = no_memory(r);
    return status;
}

/* All instants of an array: the same points at each, in `to` one instant after the other. */
static froe_status take_all(reading *r, form kind, const formats_json *array, const char *what, size_t count,
                            formats_buffer *to, formats_buffer *rings) {
    if (formats_json_size(array) != count)
        return fail_feature(r, FROE_E_FORMAT, "%zu %s for %zu instants", formats_json_size(array), what, r->instants);
    to->size = 0;
    formats_buffer here = {0};
    froe_status status = FROE_OK;
    const formats_json *geometry = array + 1;
    for (size_t i = 0; i < count && !status; i++, geometry = formats_json_next(geometry)) {
        here.size = 0;
        status = take_geometry(r, kind, geometry, i, to, &here);
        if (status) break;
        size_t points = to->size / (2 * sizeof(double)) / (i + 1);
        if (rings->size == 0 && rings->data == NULL) {
            r->points = points;
            if (!formats_buffer_put(&r->alloc, rings, here.data, here.size)) status = no_memory(r);
        } else if (here.size != rings->size || (here.size && memcmp(here.data, rings->data, here.size) != 0) ||
                   points != r->points) {
            status = fail_feature(r, FROE_E_INPUT, "at instant %zu it has not as many points as at instant 0", i);
        }
    }
    formats_buffer_free(&r->alloc, &here);
    return status;
}

/* ------------------------------------------------------------------- parabolas -- */

/* The parabolas with one velocity where they meet: control points  c = p0 + v h / 2,  and  v' = 2 (p1 - c) / h.  The
 * first velocity is that of the parabola through the first three instants. */
static froe_status make_spline(reading *r) {
    const double *t = r->times.data, *p = r->coords.data;
    size_t n = r->instants, width = 2 * r->points;
    if (n < 3) return fail_feature(r, FROE_E_INPUT, "quadratic interpolation needs three instants");
    r->controls.size = 0;
    double *c = formats_buffer_add(&r->alloc, &r->controls, (n - 1) * width * sizeof *c);
    if (!c) return no_memory(r);
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

static froe_status take_interpolation(reading *r, form kind, const formats_json *geometry, formats_buffer *rings,
                                      bool *parabolas) {
    const formats_json *said = formats_json_get(geometry, "interpolation"),
                       *given = formats_json_get(geometry, "controls");
    if (!said) said = formats_json_get(geometry, "interpolations"); /* drafts */
    if (formats_json_size(said)) said = said + 1;
    const char *name = formats_json_string(said) ? formats_json_string(said) : "Linear";
    *parabolas = strcmp(name, "Quadratic") == 0;
    if (strcmp(name, "Linear") == 0) return FROE_OK;
    if (!*parabolas)
        return fail_feature(r, FROE_E_UNSUPPORTED, "interpolation '%.40s': froe knows Linear and Quadratic motion",
                            name);
    if (given) return take_all(r, kind, given, "controls", r->instants - 1, &r->controls, rings);
    return make_spline(r);
}

/* ---------------------------------------------------------------------- plans -- */

/* From one instant after the other to one point after the other. */
static bool transpose(reading *r, bool parabolas, formats_buffer *times, formats_buffer *coords,
                      formats_buffer *controls) {
    const double *t = r->times.data, *p = r->coords.data, *c = r->controls.data;
    r->starts.size = 0;
    for (size_t v = 0; v <= r->points; v++) {
        size_t start = v * r->instants;
        if (!formats_buffer_put(&r->alloc, &r->starts, &start, sizeof start)) return false;
        for (size_t i = 0; i < r->instants && v < r->points; i++) {
            size_t at = 2 * (i * r->points + v);
            const double none[2] = {NAN, NAN};
            const double *control = parabolas && i + 1 < r->instants ? c + at : none;
            if (!formats_buffer_put(&r->alloc, times, t + i, sizeof *t) ||
                !formats_buffer_put(&r->alloc, coords, p + at, 2 * sizeof *p) ||
                !formats_buffer_put(&r->alloc, controls, control, 2 * sizeof *c))
                return false;
        }
    }
    return true;
}

static bool put_segment(reading *r, size_t a, size_t b) {
    const double *t = r->times.data;
    const uint32_t ends[2] = {(uint32_t)a, (uint32_t)b};
    const uint64_t tag = r->number;
    return formats_buffer_put(&r->alloc, &r->vertices, ends, sizeof ends) &&
           formats_buffer_put(&r->alloc, &r->births, t, sizeof *t) &&
           formats_buffer_put(&r->alloc, &r->deaths, t + r->instants - 1, sizeof *t) &&
           formats_buffer_put(&r->alloc, &r->tags, &tag, sizeof tag);
}

/* Lines from point to point, rings back to their first, a point to itself. */
static bool put_segments(reading *r, form kind, const formats_buffer *rings) {
    const size_t *counts = rings->data;
    size_t lines = rings->size / sizeof *counts, first = 0;
    r->vertices.size = r->births.size = r->deaths.size = r->tags.size = 0;
    if (kind == POINT) return put_segment(r, 0, 0);
    for (size_t k = 0; k < lines; first += counts[k++])
        for (size_t i = 0; i + (kind == LINE) < counts[k]; i++)
            if (!put_segment(r, first + i, first + (i + 1) % counts[k])) return false;
    return true;
}

static froe_status add_moving(reading *r, const formats_buffer *times, const formats_buffer *coords,
                              const formats_buffer *controls) {
    froe_diagnostic why;
    froe_moving b = froe_moving_defaults();
    b.vertex_count = r->points;
    b.starts = r->starts.data;
    b.times = times->data;
    b.coords = coords->data;
    b.controls = controls->data;
    b.count = r->tags.size / sizeof(uint64_t);
    b.vertices = r->vertices.data;
    b.births = r->births.data;
    b.deaths = r->deaths.data;
    b.tags = r->tags.data;
    b.group = r->group;
    froe_status status = froe_motion_add(r->motion, &b, &why);
    if (status == FROE_E_MEMORY) return no_memory(r);
    r->report.pieces += r->points * (r->instants - 1);
    return status ? fail_feature(r, status, "%s", why.message) : FROE_OK;
}

static froe_status add_geometry(reading *r, form kind, const formats_json *geometry) {
    formats_buffer rings = {0}, times = {0}, coords = {0}, controls = {0};
    bool parabolas = false;
    froe_status status =
        take_all(r, kind, formats_json_get(geometry, "coordinates"), "geometries", r->instants, &r->coords, &rings);
    if (!status) status = take_interpolation(r, kind, geometry, &rings, &parabolas);
    if (!status && (!transpose(r, parabolas, &times, &coords, &controls) || !put_segments(r, kind, &rings)))
        status = no_memory(r);
    if (!status) status = add_moving(r, &times, &coords, &controls);
    formats_buffer_free(&r->alloc, &rings);
    formats_buffer_free(&r->alloc, &times);
    formats_buffer_free(&r->alloc, &coords);
    formats_buffer_free(&r->alloc, &controls);
    return status;
}

/* -------------------------------------------------------------------- features -- */

static froe_status take_moving(reading *r, const formats_json *geometry) {
    const char *type = formats_json_string(formats_json_get(geometry, "type"));
    int which = 0;
    while (which < FORMS && type && strcmp(type, forms[which]) != 0) which++;
    if (!type || which == FORMS)
        return fail_feature(r, type ? FROE_E_UNSUPPORTED : FROE_E_FORMAT, "geometry of the type '%.40s'",
                            type ? type : "");
    froe_status status = take_instants(r, geometry);
    return status || !r->motion ? status : add_geometry(r, (form)which, geometry);
}

/* The first member of an object that is a string, or NULL. */
static const char *first_string(const formats_json *object) {
    if (!formats_json_is(object, FORMATS_JSON_OBJECT)) return NULL;
    const formats_json *value = object + 2;
    for (size_t i = 0; i < object->count; i++, value = formats_json_next(value) + 1)
        if (formats_json_string(value)) return value->text;
    return NULL;
}

/* What a feature is called: by its properties, or its id. */
static const char *name_of_feature(const formats_json *feature, char number[32]) {
    static const char *const keys[] = {"name", "title", "label", "id"};
    const formats_json *properties = formats_json_get(feature, "properties"), *id = formats_json_get(feature, "id");
    const char *name = NULL;
    for (size_t i = 0; i < sizeof keys / sizeof *keys && !name; i++)
        name = formats_json_string(formats_json_get(properties, keys[i]));
    if (!name) name = formats_json_string(id);
    if (!name) name = first_string(properties);
    if (name) return name;
    size_t digits = formats_json_is(id, FORMATS_JSON_NUMBER) ? strspn(id->text, "-0123456789") : 0;
    if (digits && digits < 32 && !strchr(".eE", id->text[digits])) snprintf(number, 32, "%.*s", (int)digits, id->text);
    return number;
}

static froe_status begin_feature(reading *r, const formats_json *feature) {
    char number[32];
    snprintf(number, sizeof number, "%zu", r->number);
    const froe_group group = {.name = name_of_feature(feature, number)};
    r->flat = true;
    r->report.features++;
    froe_status status = froe_motion_add_group(r->motion, &group, &r->group);
    return status == FROE_E_MEMORY ? no_memory(r)
           : status                ? fail_feature(r, status, "has no room for its name")
                                   : FROE_OK;
}

static froe_status take_feature(reading *r, const formats_json *feature) {
    const formats_json *geometry = formats_json_get(feature, "temporalGeometry");
    const formats_json *prisms = formats_json_get(geometry, "prisms");
    if (!formats_json_is(geometry, FORMATS_JSON_OBJECT)) {
        r->report.still += r->motion != NULL;
        return FROE_OK;
    }
    froe_status status = r->motion ? begin_feature(r, feature) : FROE_OK;
    if (!status && !prisms) status = take_moving(r, geometry);
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
        return support_fail(r->diag, FROE_E_FORMAT, "%s: is neither a Feature nor a FeatureCollection",
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
    if (!(r->first <= r->last))
        return support_fail(r->diag, FROE_E_INPUT, "%s: nothing moves in it", support_short(r->path));
    if (r->first == r->last)
        return support_fail(r->diag, FROE_E_INPUT, "%s: all of it is at one instant, %.17g", support_short(r->path),
                            r->first);
    w.begin = isnan(r->options.from) ? r->first : r->options.from;
    w.end = isnan(r->options.to) ? r->last : r->options.to;
    if (w.begin > r->last || w.end < r->first)
        return support_fail(r->diag, FROE_E_INPUT,
                            "%s: nothing is there from %.17g to %.17g: all is from %.17g to %.17g",
                            support_short(r->path), w.begin, w.end, r->first, r->last);
    froe_status status = froe_motion_new(&w, r->options.alloc, &r->motion, &why);
    if (status == FROE_E_MEMORY) return no_memory(r);
    return status ? support_fail(r->diag, status, "%s: %s", support_short(r->path), why.message) : FROE_OK;
}

static froe_status load(const reading *r, formats_buffer *text) {
    enum { PART = 1 << 16 };
    FILE *file = fopen(r->path, "r");
    if (!file) return formats_fail_file(r->diag, r->path, errno);
    char *to;
    size_t got = PART;
    while (got == PART && (to = formats_buffer_add(&r->alloc, text, PART))) {
        got = fread(to, 1, PART, file);
        text->size -= PART - got;
    }
    int error = ferror(file) ? errno : 0;
    fclose(file);
    if (error) return formats_fail_file(r->diag, r->path, error);
    return got < PART && formats_buffer_put(&r->alloc, text, "", 1) ? FROE_OK : no_memory(r);
}

static froe_status parse(const reading *r, formats_buffer *text, formats_buffer *values) {
    formats_locale locale;
    formats_json_error error;
    if (!formats_locale_enter(&locale)) return no_memory(r);
    froe_status status = formats_json_read(&r->alloc, text->data, text->size - 1, values, &error);
    formats_locale_leave(&locale);
    if (status == FROE_E_MEMORY) return no_memory(r);
    return status ? support_fail(r->diag, status, "%s: line %zu: %s", support_short(r->path), error.line, error.reason)
                  : FROE_OK;
}

static froe_status read_file(reading *r) {
    formats_buffer text = {0}, values = {0};
    froe_status status = load(r, &text);
    if (!status) status = parse(r, &text, &values);
    if (!status) status = take_features(r, values.data);
    if (!status) status = open_window(r);
    if (!status) status = take_features(r, values.data);
    formats_buffer_free(&r->alloc, &values);
    formats_buffer_free(&r->alloc, &text);
    return status;
}

static void free_buffers(reading *r) {
    formats_buffer *const all[] = {&r->times,    &r->coords, &r->controls, &r->starts,
                                   &r->vertices, &r->births, &r->deaths,   &r->tags};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) formats_buffer_free(&r->alloc, all[i]);
}

froe_motion_read_options froe_motion_read_defaults(void) {
    return (froe_motion_read_options){.size = sizeof(froe_motion_read_options), .from = NAN, .to = NAN};
}

froe_status froe_read_motion(const char *path, const froe_motion_read_options *options, froe_motion **out,
                             froe_motion_report *report, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    double start = formats_seconds();
    if (!path || !out) return support_fail(diag, FROE_E_ARG, "froe_read_motion: path and out must not be NULL");
    if (options && options->size != sizeof *options)
        return support_fail(diag, FROE_E_OPTIONS,
                            "froe_read_motion: the options do not come from "
                            "froe_motion_read_defaults()");
    reading r = {.path = path, .options = options ? *options : froe_motion_read_defaults(), .diag = diag};
    r.alloc = support_allocator(r.options.alloc);
    r.first = (double)INFINITY;
    r.last = -(double)INFINITY;
    froe_status status = read_file(&r);
    free_buffers(&r);
    if (status) {
        froe_motion_free(r.motion);
        return status;
    }
    r.report.seconds = formats_seconds() - start;
    if (report) *report = r.report;
    *out = r.motion;
    return FROE_OK;
}
