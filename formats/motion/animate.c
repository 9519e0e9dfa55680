/* animate.c: froe_animate: from a motion to a page; see animate.h. */
#include "formats/motion/animate.h"
#include "support/alloc.h"
#include "support/fail.h"
#include "support/floats.h"
#include <math.h>
#include <string.h>

void froe_animation_defaults_into(froe_animation_options *out, size_t size) {
    const froe_animation_options all = {.size = size, .width = 960, .seconds = 20, .up = 2};
    support_defaults(out, size, &all, sizeof all);
}

void formats_animation_knots(const formats_animation *a, uint32_t vertex, size_t *first, size_t *end) {
    const size_t count = froe_motion_knot_count(a->motion, vertex);
    *first = 0, *end = count;
    while (*first + 1 < count && froe_motion_knot(a->motion, vertex, *first + 1).time <= a->begin) ++*first;
    while (*end > *first + 1 && froe_motion_knot(a->motion, vertex, *end - 2).time >= a->end) --*end;
}

static void extend_bounds(formats_animation *a, const double at[2]) {
    for (int k = 0; k < 2; k++) a->lo[k] = fmin(a->lo[k], at[k]), a->hi[k] = fmax(a->hi[k], at[k]); /* not NaN */
}

/* The hull of all knots and control points holds everything. */
static void find_bounds(formats_animation *a) {
    for (int k = 0; k < 2; k++) a->lo[k] = (double)INFINITY, a->hi[k] = -(double)INFINITY;
    for (uint32_t o = 0; o < froe_motion_object_count(a->motion); o++)
        for (int corner = 0; corner < 2; corner++) {
            const froe_moving_object object = froe_motion_object(a->motion, o);
            size_t first, end;
            formats_animation_knots(a, object.vertices[corner], &first, &end);
            for (size_t i = first; i < end && object.birth <= object.death; i++) {
                const froe_moving_knot knot = froe_motion_knot(a->motion, object.vertices[corner], i);
                extend_bounds(a, knot.at);
                if (i + 1 < end) extend_bounds(a, knot.control), extend_bounds(a, knot.second);
            }
        }
    for (int k = 0; k < 2; k++)
        if (!(a->lo[k] <= a->hi[k])) a->lo[k] = 0, a->hi[k] = 1; /* nothing is ever there */
}

/* Deals the contacts to their objects. */
static void deal(formats_animation *a) {
    size_t objects = froe_motion_object_count(a->motion);
    for (size_t i = 0; i < a->count; i++) {
        a->starts[a->contacts[i].a + 1]++;
        a->starts[a->contacts[i].b + 1]++;
    }
    for (size_t o = 0; o < objects; o++) a->starts[o + 1] += a->starts[o];
    for (size_t i = a->count; i--;) { /* from behind: starts end where they begin */
        a->touched[--a->starts[a->contacts[i].a + 1]] = (uint32_t)i;
        a->touched[--a->starts[a->contacts[i].b + 1]] = (uint32_t)i;
    }
    memmove(a->starts, a->starts + 1, objects * sizeof *a->starts);
    a->starts[objects] = 2 * a->count;
}

static froe_status animate(const froe_motion *motion, const froe_contact *contacts, size_t count,
                           const froe_animation_options *options, const char *path, froe_diagnostic *diag) {
    formats_animation a = {.motion = motion, .contacts = contacts, .count = count};
    a.options = options ? *options : froe_animation_defaults();
    a.begin = froe_motion_window(motion).begin;
    a.end = froe_motion_window(motion).end;
    if (a.options.size != sizeof a.options) return support_fail_defaults(diag, "froe_animation_defaults");
    a.clock = !a.options.numbers && a.end - a.begin >= 1000 &&
              fmax(fabs(a.begin), fabs(a.end)) < 8e15; /* the clock of scripts ends there */
    if (!(a.options.width >= 200) || !isfinite(a.options.width) || !(a.options.seconds > 0) ||
        !isfinite(a.options.seconds))
        return support_fail(diag, FROE_E_OPTIONS, "The width of the animation is below 200, or its time is none.");
    const size_t objects = froe_motion_object_count(motion), starts = objects + 2;
    for (size_t i = 0; i < count; i++)
        if (contacts[i].a >= objects || contacts[i].b >= objects)
            return support_fail(diag, FROE_E_ARG, "contact %zu: Its objects do not exist.", i);
    support_extension extension = support_path_extension(path);
    const bool svg = strcmp(extension.text, "svg") == 0, solid = froe_motion_window(motion).dim == 3;
    if (!svg && strcmp(extension.text, "html") != 0)
        return support_fail_ending(diag, FROE_E_UNSUPPORTED, path, "motions", ".svg or .html");
    const froe_allocator alloc = support_allocator(NULL);
    formats_writer w;
    a.starts = support_calloc(&alloc, starts, sizeof *a.starts);
    a.touched = support_calloc(&alloc, 2 * count, sizeof *a.touched);
    froe_status status = a.starts && a.touched ? formats_writer_open(&w, path, diag) : support_fail_memory(diag);
    if (!status) {
        if (!solid) find_bounds(&a), deal(&a);
        formats_animation_writer *const write = !svg    ? formats_animate_page
                                                : solid ? formats_animate_film
                                                        : formats_animate_svg;
        status = formats_writer_close(&w, write(&w, &a, diag));
    }
    support_free(&alloc, a.starts, starts * sizeof *a.starts);
    support_free(&alloc, a.touched, 2 * count * sizeof *a.touched);
    return status;
}

/* A share of what a picture shows, roughly: where vertices are at 17 instants. */
static double fine_enough(const froe_motion *motion) {
    enum { PARTS = 16, PIXELS = 1 << 13 };
    const froe_motion_options window = froe_motion_window(motion);
    double lo[2] = {(double)INFINITY, (double)INFINITY}, hi[2] = {-(double)INFINITY, -(double)INFINITY}, at[3];
    for (uint32_t v = 0; v < froe_motion_vertex_count(motion); v++)
        for (int i = 0; i <= PARTS; i++) {
            const double share = (double)i / PARTS;
            if (!froe_motion_position(motion, v, window.begin * (1 - share) + window.end * share, at)) continue;
            for (int k = 0; k < 2; k++) lo[k] = fmin(lo[k], at[k]), hi[k] = fmax(hi[k], at[k]);
        }
    const double size = fmax(hi[0] - lo[0], hi[1] - lo[1]) / PIXELS;
    return size > 0 && isfinite(size) ? size : 1;
}

froe_status froe_animate(const froe_motion *motion, const froe_contact *contacts, size_t count,
                         const froe_animation_options *options, const char *path, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!motion || !path || (count && !contacts)) return support_fail_null(diag, __func__);
    if (froe_motion_window(motion).dim == 3 || !froe_motion_body_count(motion))
        return animate(motion, contacts, count, options, path, diag);
    froe_motion *drawn = NULL; /* bodies of the plane, on parabolas */
    froe_status status = froe_motion_without_bodies(motion, fine_enough(motion), NULL, &drawn, NULL, diag);
    if (!status) status = animate(drawn, contacts, count, options, path, diag);
    froe_motion_free(drawn);
    return status;
}
