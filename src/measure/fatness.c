/* fatness.c: the share of each object in its smallest enclosing ball, or of polygons in space, in its disc. */
#include "base/floats.h"
#include "geom/selftest.h"
#include "measure/enclosing.h"
#include "measure/sample.h"
#include "measure/volume.h"
#include "support/axes.h"
#include "support/fail.h"
#include <math.h>

enum { FULL, FLAT, SLIVER }; /* lists of values */

/* Of the unit ball: pi r^2 in the plane, each dimension d from d - 2. */
static double ball_volume(int dim, double radius) {
    const double pi = 3.14159265358979323846;
    double volume = dim % 2 ? 2 * radius : 1;
    for (int d = dim % 2 ? 3 : 2; d <= dim; d += 2) volume *= 2 * pi / d * radius * radius;
    return volume;
}

static void cross_of_points(const double *a, const double *b, const double *c, double scale, double *out) {
    double u[3], v[3];
    for (int k = 0; k < 3; k++) u[k] = b[k] * scale - a[k] * scale, v[k] = c[k] * scale - a[k] * scale;
    support_cross(u, v, out);
}

static double length(const double *v) {
    return sqrt(support_dot(v, v));
}

static double polygon_area(const froe_scene *scene, uint32_t object, double scale) {
    double sum[3] = {0}, part[3];
    for (uint32_t i = 2; i < scene_corners(scene, object); i++) {
        cross_of_points(scene_point(scene, object, 0), scene_point(scene, object, i - 1), scene_point(scene, object, i),
                        scale, part);
        for (int k = 0; k < 3; k++) sum[k] += 0.5 * part[k];
    }
    return length(sum);
}

/* Width across the longest edge, over its length. */
static double sliver_ratio(const froe_scene *scene, uint32_t object, double scale) {
    uint32_t n = scene_corners(scene, object), longest = 0;
    double most = 0, width = 0, v[3];
    for (uint32_t i = 0; i < n; i++) {
        const double *a = scene_point(scene, object, i), *b = scene_point(scene, object, (i + 1) % n);
        for (int k = 0; k < 3; k++) v[k] = b[k] * scale - a[k] * scale;
        if (length(v) > most) most = length(v), longest = i;
    }
    const double *a = scene_point(scene, object, longest), *b = scene_point(scene, object, (longest + 1) % n);
    for (uint32_t i = 0; i < n; i++) {
        cross_of_points(a, b, scene_point(scene, object, i), scale, v);
        if (length(v) > width) width = length(v);
    }
    return width / most / most;
}

static bool note(measure_sample *s, int list, double value) {
    return array_push(&s->alloc, &s->values[list], value);
}

/* A solid: its share of the ball around it, both times a power of the scale. */
static bool note_full(measure_sample *s, uint32_t object, double scale, double volume, froe_fatness *out) {
    const measure_ball ball = measure_enclosing(s->scene, object);
    out->thin += !(volume > 0);
    return note(s, FULL, volume > 0 ? volume / ball_volume(s->scene->dim, ball.radius * scale) : 0);
}

static froe_status note_object(measure_sample *s, num_context *context, uint32_t object, froe_fatness *out) {
    const froe_scene *scene = s->scene;
    const double scale = measure_scale(scene, object);
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], volume = 1;
    bool ok = true;
    froe_status status = FROE_OK;
    switch (scene_form(scene, object)) {
    case FROE_BALL:
        out->thin += scene_radius(scene, object) == 0;
        ok = note(s, FULL, scene_radius(scene, object) > 0);
        break;
    case FROE_BOX:
        scene_object_bounds(scene, object, lo, hi);
        for (int k = 0; k < scene->dim; k++) volume *= hi[k] * scale - lo[k] * scale;
        ok = note_full(s, object, scale, volume, out);
        break;
    case FROE_HULL:
        status = measure_hull_volume(context, &s->alloc, scene, object, scale, &volume);
        ok = status || note_full(s, object, scale, volume, out);
        break;
    case FROE_POLYGON:
        out->thin++;
        const double disc = ball_volume(2, measure_enclosing(scene, object).radius * scale);
        ok = note(s, FLAT, polygon_area(scene, object, scale) / disc) &&
             note(s, SLIVER, sliver_ratio(scene, object, scale));
        break;
    default:
        out->thin++;
    }
    return ok ? status : FROE_E_MEMORY;
}

froe_status froe_measure_fatness(const froe_scene *scene, const froe_measure_options *options, froe_fatness *out,
                                 froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    measure_sample s;
    num_context context;
    froe_status status = measure_sample_begin(scene, options, out, &s, diag);
    if (status) return status;
    froe_fatness found = {.thin = 0};
    status = geom_context_new(&s.alloc, &context);
    const bool made = !status;
    for (uint32_t i = 0; i < s.count && !status; i++) {
        uint32_t object = measure_sample_object(&s, i);
        status = measure_sample_go_on(&s, i) ? note_object(&s, &context, object, &found) : FROE_E_CANCELLED;
        if (status == FROE_E_UNSUPPORTED)
            support_fail_at(diag, status, object, FROE_NONE, FROE_NONE,
                            "object %u: Above dimension 3 volumes of hulls are measured that are simplices.", object);
    }
    if (made) num_context_free(&context);
    if (!status) status = measure_sample_spread(&s, FULL, &found.full);
    if (!status) status = measure_sample_spread(&s, FLAT, &found.flat);
    if (!status) status = measure_sample_spread(&s, SLIVER, &found.sliver);
    if (!status) *out = found;
    return measure_sample_end(&s, status, diag);
}
