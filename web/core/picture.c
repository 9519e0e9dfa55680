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
static const char *line_name(int value) {
    return froe_line_name((froe_line)value);
}
static const char *ids_name(int value) {
    static const char *const names[] = {"none", "object", "face", NULL};
    return names[value];
}
static const char *layers_name(int value) {
    static const char *const names[] = {"none", "object", "kind", NULL};
    return names[value];
}

#define AT(member) offsetof(froe_render_options, member)
static const web_member render_members[] = {
    {"parallel", WEB_BOOL, AT(camera.parallel), NULL},
    {"fit", WEB_BOOL, AT(camera.fit), NULL},
    {"eye", WEB_VECTOR, AT(camera.eye), NULL},
    {"target", WEB_VECTOR, AT(camera.target), NULL},
    {"up", WEB_VECTOR, AT(camera.up), NULL},
    {"fov", WEB_DOUBLE, AT(camera.fov), NULL},
    {"scale", WEB_DOUBLE, AT(camera.scale), NULL},
    {"sectionPlane", WEB_ADDRESS, AT(camera.section), NULL},
    {"width", WEB_DOUBLE, AT(camera.width), NULL},
    {"height", WEB_DOUBLE, AT(camera.height), NULL},
    {"margin", WEB_DOUBLE, AT(camera.margin), NULL},
    {"millimetres", WEB_BOOL, AT(millimetres), NULL},
    {"shading", WEB_NAMED, AT(shading), shading_name},
    {"celLevels", WEB_INT, AT(cel_levels), NULL},
    {"paint", WEB_NAMED, AT(paint), paint_name},
    {"seams", WEB_NAMED, AT(seams), seams_name},
    {"seamWidth", WEB_DOUBLE, AT(seam_width), NULL},
    {"section", WEB_SIGNED, AT(section), NULL},
    {"lines", WEB_BITS, AT(lines), line_name},
    {"crease", WEB_DOUBLE, AT(crease), NULL},
    {"lineWidth", WEB_DOUBLE, AT(line_width), NULL},
    {"pointWidth", WEB_DOUBLE, AT(point_width), NULL},
    {"lineStyles", WEB_ADDRESS, AT(line_styles), NULL},
    {"lineStyleCount", WEB_INT, AT(line_style_count), NULL},
    {"interleaved", WEB_BOOL, AT(interleaved), NULL},
    {"hidden", WEB_BOOL, AT(hidden), NULL},
    {"halo", WEB_DOUBLE, AT(halo), NULL},
    {"ownColours", WEB_BOOL, AT(own_colours), NULL},
    {"opacity", WEB_ADDRESS, AT(opacity), NULL},
    {"priorities", WEB_ADDRESS, AT(priorities), NULL},
    {"cullBack", WEB_BOOL, AT(cull_back), NULL},
    {"background", WEB_INT, AT(background), NULL},
    {"decimals", WEB_SIGNED, AT(decimals), NULL},
    {"ids", WEB_NAMED, AT(ids), ids_name},
    {"layers", WEB_NAMED, AT(layers), layers_name},
    {"minArea", WEB_DOUBLE, AT(min_area), NULL},
    {"title", WEB_TEXT, AT(title), NULL},
    {"description", WEB_TEXT, AT(description), NULL},
    {NULL, WEB_INT, 0, NULL},
};
#undef AT
static void render_defaults(void *options) {
    froe_render_options *o = options;
    *o = froe_render_defaults();
    o->progress = web_progress;
}
const web_kind web_render_options = {"render", sizeof(froe_render_options), render_defaults, render_members};

#define AT(member) offsetof(froe_line_style, member)
static const web_member style_members[] = {
    {"visible", WEB_BITS, AT(visible), line_name},
    {"hidden", WEB_BITS, AT(hidden), line_name},
    {"width", WEB_DOUBLE, AT(width), NULL},
    {"colour", WEB_INT, AT(colour), NULL},
    {"dash", WEB_DOUBLE, AT(dash), NULL},
    {"gap", WEB_DOUBLE, AT(gap), NULL},
    {NULL, WEB_INT, 0, NULL},
};
#undef AT
static void style_defaults(void *options) {
    *(froe_line_style *)options = froe_line_style_defaults();
}
const web_kind web_line_style = {"lineStyles", sizeof(froe_line_style), style_defaults, style_members};

/* The numbers of a report, in the order of PICTURE in package/pictures.js. */
enum { PICTURE = 6 };
static void tell(const froe_render_report *report, double out[PICTURE]) {
    out[0] = (double)report->shapes;
    out[1] = (double)report->strokes;
    out[2] = (double)report->dots;
    out[3] = (double)report->paths;
    out[4] = (double)report->picture.visibility.visible_patches;
    out[5] = report->picture.paint;
}

/** A picture as the bytes of a file. */
WEB_EXPORT froe_status web_render(const froe_tree *tree, int format, const froe_render_options *options,
                                  double numbers[PICTURE], web_bytes *out, froe_diagnostic *diag) {
    froe_render_report report;
    *out = (web_bytes){NULL, 0, 0, false};
    const froe_status status =
        froe_render_write(tree, (froe_render_format)format, web_bytes_take, out, options, &report, diag);
    if (status == FROE_OK) tell(&report, numbers);
    return web_bytes_end(out, status, diag);
}

/** A turntable of `count` pictures in `seconds` as one SVG, in the file `path` of the module's own file system. */
WEB_EXPORT froe_status web_render_turning(const froe_tree *tree, const char *path, const froe_render_options *options,
                                          size_t count, double seconds, double numbers[PICTURE],
                                          froe_diagnostic *diag) {
    froe_render_report report;
    froe_camera *cameras = malloc((count ? count : 1) * sizeof *cameras);
    if (!cameras) return web_no_memory(diag);
    froe_status status = froe_camera_turn(&options->camera, froe_tree_scene(tree), count, cameras, diag);
    if (status == FROE_OK) status = froe_render_animation(tree, path, options, cameras, count, seconds, &report, diag);
    if (status == FROE_OK) tell(&report, numbers);
    free(cameras);
    return status;
}
