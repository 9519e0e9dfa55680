/* write_solids.c: bodies and triangles in motion, for write_motion.c: a feature is a run of objects of one group and
 * one body, or, in space, of none.
 *
 *     a body      MovingPoint, with `turns` (quaternions x, y, z, w; in the plane z, w) and `base`: corners, and
 *                 triangles or, in the plane, segments in the body
 *     corners     MovingPointCloud, with `triangles`
 * that move each for itself. Objects name corners of the feature, from 0, in the order in which they first appear. */
#include "formats/motion/solids.h"
#include "support/alloc.h"
#include <math.h>

typedef struct solid {
    const froe_motion *motion;
    int dim;
    uint32_t first, end; /* objects */
    uint32_t body;       /* or FROE_NONE */
    bool rests;          /* it has one instant, and stands still from the birth to the death of its triangles */
    uint32_t *number;    /* [vertex]: in this feature */
    uint32_t *corners;   /* vertices */
    uint32_t count;
} solid;

static froe_moving_object object_at(const solid *s, uint32_t i) {
    return froe_motion_object(s->motion, i);
}

/* The next run, with its corners numbered. */
static void take_run(solid *s) {
    const froe_moving_object begin = object_at(s, s->first);
    s->body = froe_motion_vertex_body(s->motion, begin.vertices[0]);
    s->count = 0;
    for (s->end = s->first; s->end < froe_motion_object_count(s->motion); s->end++) {
        const froe_moving_object o = object_at(s, s->end);
        if (o.group != begin.group || o.birth != begin.birth || o.death != begin.death ||
            froe_motion_vertex_body(s->motion, o.vertices[0]) != s->body)
            return;
        for (int k = 0; k < s->dim; k++) {
            const uint32_t v = o.vertices[k], known = s->number[v];
            if (known < s->count && s->corners[known] == v) continue;
            s->number[v] = s->count;
            s->corners[s->count++] = v;
        }
    }
}

static size_t knots_of(const solid *s, uint32_t vertex) {
    return s->body == FROE_NONE ? froe_motion_knot_count(s->motion, vertex)
                                : froe_motion_body_knot_count(s->motion, s->body);
}

/* In the file, what rests has two instants. */
static size_t instants_of(const solid *s, uint32_t vertex) {
    return s->rests ? 2 : knots_of(s, vertex);
}

static double instant_of(const solid *s, uint32_t vertex, size_t k) {
    const froe_moving_object o = object_at(s, s->first);
    if (s->rests) return k ? o.death : o.birth;
    return s->body == FROE_NONE ? froe_motion_knot(s->motion, vertex, k).time
                                : froe_motion_body_knot(s->motion, s->body, k).time;
}

/* A vertex or a body of one instant is there at all times. */
static bool rests(const solid *s) {
    for (uint32_t i = 0; i < s->count; i++)
        if (knots_of(s, s->corners[i]) != 1) return false;
    return true;
}

static froe_moving_knot knot_of(const solid *s, uint32_t vertex, size_t k) {
    return froe_motion_knot(s->motion, vertex, s->rests ? 0 : k);
}

static froe_body_knot body_knot_of(const solid *s, size_t k) {
    return froe_motion_body_knot(s->motion, s->body, s->rests ? 0 : k);
}

/* Do all corners have the same instants, from the birth to the death of the triangles? */
static bool fits(const solid *s) {
    const froe_moving_object o = object_at(s, s->first);
    const size_t count = instants_of(s, s->corners[0]);
    bool fits =
        count > 1 && instant_of(s, s->corners[0], 0) == o.birth && instant_of(s, s->corners[0], count - 1) == o.death;
    for (uint32_t i = 1; i < s->count && fits && s->body == FROE_NONE; i++) {
        fits = instants_of(s, s->corners[i]) == count;
        for (size_t k = 0; k < count && fits; k++)
            fits = instant_of(s, s->corners[i], k) == instant_of(s, s->corners[0], k);
    }
    return fits;
}

/* --------------------------------------------------------------------- writing -- */

int formats_degree_of(const froe_moving_knot *knot) {
    return isnan(knot->control[0]) ? 1 : isnan(knot->second[0]) ? 2 : 3;
}

void formats_put_interpolation(formats_writer *w, int degree) {
    formats_put(w, degree > 2   ? "\",\"interpolation\":\"Cubic\",\"datetimes\":["
                   : degree > 1 ? "\",\"interpolation\":\"Quadratic\",\"datetimes\":["
                                : "\",\"datetimes\":[");
}

static void put_array(formats_writer *w, const double *x, int count) {
    formats_put(w, "[");
    formats_put_point(w, x, count, ",");
    formats_put(w, "]");
}

void formats_put_listed(formats_writer *w, const froe_moving_knot *knot, const froe_moving_knot *next, int dim,
                        formats_listed what, int degree) {
    const double *at = what == FORMATS_PLACES ? knot->at : what == FORMATS_CONTROLS ? knot->control : knot->second;
    double middle[3];
    if (isnan(at[0]) && degree == 3) {
        formats_put(w, "null");
        return;
    }
    for (int i = 0; i < 3; i++) middle[i] = 0.5 * knot->at[i] + 0.5 * next->at[i];
    put_array(w, isnan(at[0]) ? middle : at, dim);
}

/* An instant of a corner, or of the centre of the body. */
static froe_moving_knot flight_knot(const solid *s, uint32_t vertex, size_t k) {
    if (s->body == FROE_NONE) return knot_of(s, vertex, k);
    const froe_body_knot b = body_knot_of(s, k);
    return (froe_moving_knot){
        b.time, {b.at[0], b.at[1], b.at[2]}, {b.control[0], b.control[1], b.control[2]}, {(double)NAN}};
}

/* The greatest degree of a piece. */
static int solid_degree(const solid *s) {
    const size_t count = instants_of(s, s->corners[0]);
    int degree = 1;
    for (uint32_t i = 0; i < (s->body == FROE_NONE ? s->count : 1); i++)
        for (size_t k = 0; k + 1 < count; k++) {
            const froe_moving_knot knot = flight_knot(s, s->corners[i], k);
            const int here = formats_degree_of(&knot);
            degree = here > degree ? here : degree;
        }
    return degree;
}

static void put_places(formats_writer *w, const solid *s, const char *name, size_t count, formats_listed what,
                       int degree) {
    const uint32_t each = s->body == FROE_NONE ? s->count : 1;
    formats_put(w, name);
    for (size_t k = 0; k < count; k++) {
        if (k) formats_put(w, ",");
        for (uint32_t i = 0; i < each; i++) {
            const froe_moving_knot knot = flight_knot(s, s->corners[i], k);
            const froe_moving_knot next = what == FORMATS_PLACES ? knot : flight_knot(s, s->corners[i], k + 1);
            if (s->body == FROE_NONE) formats_put(w, i ? "," : "[");
            formats_put_listed(w, &knot, &next, s->dim, what, degree);
        }
        if (s->body == FROE_NONE) formats_put(w, "]");
    }
    formats_put(w, "]");
}

static void put_members(formats_writer *w, const solid *s) {
    formats_put(w, s->dim == 2 ? "\"segments\":[" : "\"triangles\":[");
    for (uint32_t i = s->first; i < s->end; i++) {
        const froe_moving_object o = object_at(s, i);
        formats_put(w, i > s->first ? ",[" : "[");
        for (int k = 0; k < s->dim; k++) {
            if (k) formats_put(w, ",");
            formats_put_whole(w, s->number[o.vertices[k]]);
        }
        formats_put(w, "]");
    }
    formats_put(w, "]");
}

static void put_base(formats_writer *w, const solid *s, size_t count) {
    formats_put(w, ",\"turns\":[");
    for (size_t k = 0; k < count; k++) {
        const froe_body_knot knot = body_knot_of(s, k);
        if (k) formats_put(w, ",");
        put_array(w, s->dim == 2 ? knot.turn + 2 : knot.turn, s->dim == 2 ? 2 : 4);
    }
    formats_put(w, "],\"base\":{\"coordinates\":[");
    for (uint32_t i = 0; i < s->count; i++) {
        const froe_moving_knot knot = knot_of(s, s->corners[i], 0);
        if (i) formats_put(w, ",");
        put_array(w, knot.at, s->dim);
    }
    formats_put(w, "],");
    put_members(w, s);
    formats_put(w, "}");
}

static void put_solid(formats_writer *w, const solid *s) {
    const froe_moving_object o = object_at(s, s->first);
    const size_t count = instants_of(s, s->corners[0]);
    const int degree = solid_degree(s);
    formats_put(w, "{\"type\":\"Feature\",\"properties\":{");
    if (o.group != FROE_NONE) {
        formats_put(w, "\"name\":");
        formats_put_json(w, froe_motion_group(s->motion, o.group).name);
    }
    formats_put(w, "},\"temporalGeometry\":{\"type\":\"");
    formats_put(w, s->body == FROE_NONE ? "MovingPointCloud" : "MovingPoint");
    formats_put_interpolation(w, degree);
    for (size_t k = 0; k < count; k++) {
        if (k) formats_put(w, ",");
        formats_put_number(w, instant_of(s, s->corners[0], k));
    }
    put_places(w, s, "],\"coordinates\":[", count, FORMATS_PLACES, degree);
    if (degree > 1) put_places(w, s, ",\"controls\":[", count - 1, FORMATS_CONTROLS, degree);
    if (degree > 2) put_places(w, s, ",\"secondControls\":[", count - 1, FORMATS_SECOND_CONTROLS, degree);
    if (s->body == FROE_NONE)
        formats_put(w, ","), put_members(w, s);
    else
        put_base(w, s, count);
    formats_put(w, "}}");
}

static bool is_of_body(const froe_motion *motion, uint32_t object) {
    return froe_motion_vertex_body(motion, froe_motion_object(motion, object).vertices[0]) != FROE_NONE;
}

froe_status formats_write_solids(const froe_motion *motion, formats_writer *w, formats_other_fn *other,
                                 froe_diagnostic *diag) {
    const froe_allocator alloc = support_allocator(NULL);
    const size_t vertices = froe_motion_vertex_count(motion);
    solid s = {.motion = motion, .dim = (int)froe_motion_window(motion).dim};
    s.number = support_calloc(&alloc, vertices, sizeof *s.number);
    s.corners = support_calloc(&alloc, vertices, sizeof *s.corners);
    froe_status status = s.number && s.corners ? FROE_OK : support_fail_memory(diag);
    for (; s.first < froe_motion_object_count(motion) && !status; s.first = s.end) {
        formats_put(w, s.first ? ",\n" : "\n");
        if (s.dim == 2 && !is_of_body(motion, s.first)) {
            s.end = other(motion, w, s.first);
            continue;
        }
        take_run(&s);
        s.rests = rests(&s);
        if (!fits(&s))
            status = support_fail(diag, FROE_E_UNSUPPORTED,
                                  "%s %u: The instants of its %s are not the same, or not those of its life, which "
                                  "MF-JSON cannot say.",
                                  s.dim == 2 ? "segment" : "triangle", s.first, s.dim == 2 ? "body" : "corners");
        if (!status) put_solid(w, &s);
    }
    support_free(&alloc, s.number, vertices * sizeof *s.number);
    support_free(&alloc, s.corners, vertices * sizeof *s.corners);
    return status;
}
