/* picture.c: pictures with hidden surfaces removed */
#include "web.h"
#include <froe/render.h>
#include <stdlib.h>

static const char *shading_name(int value) {
    return froe_shading_name((froe_shading)value);
}
static const char *seams_name(int value) {
    return froe_seams_name((froe_seams)value);
}
static const char *paint_name(int value) {
    return froe_paint_name((froe_paint)value);
}

#define AT(member) offsetof(froe_render_options, member)
static const web_member members[] = {
    {"parallel", WEB_BOOL, AT(camera.parallel), NULL},
    {"fit", WEB_BOOL, AT(camera.fit), NULL},
    {"eye", WEB_VECTOR, AT(camera.eye), NULL},
    {"target", WEB_VECTOR, AT(camera.target), NULL},
    {"up", WEB_VECTOR, AT(camera.up), NULL},
    {"fov", WEB_DOUBLE, AT(camera.fov), NULL},
    {"scale", WEB_DOUBLE, AT(camera.scale), NULL},
    {"width", WEB_DOUBLE, AT(camera.width), NULL},
    {"height", WEB_DOUBLE, AT(camera.height), NULL},
    {"margin", WEB_DOUBLE, AT(camera.margin), NULL},
    {"millimetres", WEB_BOOL, AT(millimetres), NULL},
    {"shading", WEB_NAMED, AT(shading), shading_name},
    {"celLevels", WEB_INT, AT(cel_levels), NULL},
    {"paint", WEB_NAMED, AT(paint), paint_name},
    {"seams", WEB_NAMED, AT(seams), seams_name},
    {"section", WEB_INT, AT(section), NULL},
    {"lines", WEB_INT, AT(lines), NULL},
    {"crease", WEB_DOUBLE, AT(crease), NULL},
    {"lineWidth", WEB_DOUBLE, AT(line_width), NULL},
    {"hidden", WEB_BOOL, AT(hidden), NULL},
    {"halo", WEB_DOUBLE, AT(halo), NULL},
    {"ownColours", WEB_BOOL, AT(own_colours), NULL},
    {"cullBack", WEB_BOOL, AT(cull_back), NULL},
    {"background", WEB_INT, AT(background), NULL},
    {"decimals", WEB_INT, AT(decimals), NULL},
    {"ids", WEB_INT, AT(ids), NULL},
    {"layers", WEB_INT, AT(layers), NULL},
    {"minArea", WEB_DOUBLE, AT(min_area), NULL},
    {"title", WEB_ADDRESS, AT(title), NULL},
    {"description", WEB_ADDRESS, AT(description), NULL},
    {NULL, WEB_INT, 0, NULL},
};

WEB_EXPORT froe_render_options *web_render_options_new(void) {
    froe_render_options *options = malloc(sizeof *options);
    if (!options) return NULL;
    *options = froe_render_defaults();
    options->progress = web_progress;
    return options;
}
WEB_EXPORT froe_status web_render_options_number(froe_render_options *options, const char *name, double value,
                                                 froe_diagnostic *diag) {
    return web_set_number(options, members, name, value, diag);
}
WEB_EXPORT froe_status web_render_options_name(froe_render_options *options, const char *name, const char *value,
                                               froe_diagnostic *diag) {
    return web_set_name(options, members, name, value, diag);
}

/** A picture as the bytes of a file; `*bytes` is freed by web_free(). `counts`: shapes and lines in it. */
WEB_EXPORT froe_status web_render(const froe_tree *tree, int format, const froe_render_options *options, void **bytes,
                                  size_t *count, double counts[2], froe_diagnostic *diag) {
    web_bytes all = {NULL, 0, 0, false};
    froe_render_report report;
    const froe_status status =
        froe_render_write(tree, (froe_render_format)format, web_bytes_take, &all, options, &report, diag);
    if (status == FROE_OK) {
        counts[0] = (double)report.shapes;
        counts[1] = (double)report.strokes;
    }
    return web_bytes_end(&all, status, bytes, count, diag);
}

/** The tree of the same scene whose first cut is the plane of 4 numbers. */
WEB_EXPORT froe_status web_section(const froe_tree *tree, const double *plane, froe_tree **out, froe_diagnostic *diag) {
    froe_build_options options = froe_build_defaults();
    options.threads = 1;
    options.progress = web_progress;
    return froe_tree_section(tree, plane, &options, out, diag);
}
