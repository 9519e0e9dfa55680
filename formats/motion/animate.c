/* animate.c: froe_animate: from a motion to a page; see animate.h. */
#include "formats/motion/animate.h"
#include "support/alloc.h"
#include "support/floats.h"
#include <math.h>
#include <string.h>

froe_animation_options froe_animation_defaults(void) {
    return (froe_animation_options){.size = sizeof(froe_animation_options), .width = 960, .seconds = 20};
}

/* The hull of all knots and control points holds everything. */
static void find_bounds(formats_animation *a) {
    for (int k = 0; k < 2; k++) a->lo[k] = (double)INFINITY, a->hi[k] = -(double)INFINITY;
    for (uint32_t v = 0; v < froe_motion_vertex_count(a->motion); v++)
        for (size_t i = 0; i < froe_motion_knot_count(a->motion, v); i++) {
            froe_moving_knot knot = froe_motion_knot(a->motion, v, i);
            for (int k = 0; k < 2; k++) {
                if (!isnan(knot.control[k])) a->lo[k] = fmin(a->lo[k], knot.control[k]);
                if (!isnan(knot.control[k])) a->hi[k] = fmax(a->hi[k], knot.control[k]);
                a->lo[k] = fmin(a->lo[k], knot.at[k]);
                a->hi[k] = fmax(a->hi[k], knot.at[k]);
            }
        }
    double width = a->hi[0] - a->lo[0], height = a->hi[1] - a->lo[1],
           page = a->options.width - 2 * FORMATS_ANIMATION_MARGIN;
    a->scale = page / fmax(fmax(width, height), 1e-300);
    if (height <= width) a->scale = page / fmax(width, 1e-300);
    if (!(a->scale > 0) || !isfinite(a->scale)) a->scale = 1; /* no extent, or one beyond doubles */
    a->height = ceil(height * a->scale) + 2 * FORMATS_ANIMATION_MARGIN;
    if (!(a->height > 2 * FORMATS_ANIMATION_MARGIN)) a->height = 2 * FORMATS_ANIMATION_MARGIN + 1;
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

froe_status froe_animate(const froe_motion *motion, const froe_contact *contacts, size_t count,
                         const froe_animation_options *options, const char *path, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!motion || !path || (count && !contacts)) return support_fail_null(diag, __func__);
    formats_animation a = {.motion = motion, .contacts = contacts, .count = count};
    a.options = options ? *options : froe_animation_defaults();
    a.begin = froe_motion_window(motion).begin;
    a.end = froe_motion_window(motion).end;
    if (a.options.size != sizeof a.options) return support_fail_defaults(diag, "froe_animation_defaults");
    if (!(a.options.width > 4 * FORMATS_ANIMATION_MARGIN) || !isfinite(a.options.width) || !(a.options.seconds > 0) ||
        !isfinite(a.options.seconds))
        return support_fail(diag, FROE_E_OPTIONS, "The width of the animation is below 64, or its time is none.");
    const size_t objects = froe_motion_object_count(motion), starts = objects + 2;
    for (size_t i = 0; i < count; i++)
        if (contacts[i].a >= objects || contacts[i].b >= objects)
            return support_fail(diag, FROE_E_ARG, "contact %zu: Its objects do not exist.", i);
    support_extension extension = support_path_extension(path);
    bool svg = strcmp(extension.text, "svg") == 0;
    if (!svg && strcmp(extension.text, "html") != 0)
        return support_fail_ending(diag, FROE_E_UNSUPPORTED, path, "motions", ".svg or .html");
    const froe_allocator alloc = support_allocator(NULL);
    formats_writer w;
    a.starts = support_calloc(&alloc, starts, sizeof *a.starts);
    a.touched = support_calloc(&alloc, 2 * count, sizeof *a.touched);
    froe_status status = a.starts && a.touched ? formats_writer_open(&w, path, diag) : support_fail_memory(diag);
    if (!status) {
        find_bounds(&a);
        deal(&a);
        (svg ? formats_animate_svg : formats_animate_page)(&w, &a);
        status = formats_writer_close(&w, FROE_OK);
    }
    support_free(&alloc, a.starts, starts * sizeof *a.starts);
    support_free(&alloc, a.touched, 2 * count * sizeof *a.touched);
    return status;
}
