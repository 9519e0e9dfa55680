/* options.c: the options of a picture and their names, checked before anything is computed. */
#include "render.h"
#include "support/fail.h"
#include "support/utf8.h"

void froe_render_defaults_into(froe_render_options *out, size_t size) {
    const froe_render_options all = {
        .size = size,
        .camera = froe_camera_defaults(),
        .cel_levels = 4,
        .seam_width = 1,
        .lines = FROE_LINE_BORDER | FROE_LINE_SILHOUETTE | FROE_LINE_OBJECT | FROE_LINE_MATERIAL | FROE_LINE_CREASE |
                 FROE_LINE_CROSSING | FROE_LINE_SECTION | FROE_LINE_WIRE | FROE_LINE_POINT,
        .crease = 30,
        .line_width = 1,
        .point_width = 3,
        .background = FROE_DRAW_BY_FORMAT,
        .decimals = 2,
        .pixels = 1,
    };
    support_defaults(out, size, &all, sizeof all);
}

const char *froe_shading_name(froe_shading shading) {
    static const char *const names[FROE_SHADING_COUNT] = {"flat", "cel", "plain", "white", "none"};
    return (unsigned)shading < FROE_SHADING_COUNT ? names[shading] : NULL;
}

const char *froe_seams_name(froe_seams seams) {
    static const char *const names[FROE_SEAMS_COUNT] = {"underlap", "none", "twice", "stroke"};
    return (unsigned)seams < FROE_SEAMS_COUNT ? names[seams] : NULL;
}

typedef struct render_range {
    const char *name;
    double value, lo, hi;
} render_range;

static froe_status check_in_range(const render_range *r, size_t count, froe_diagnostic *diag) {
    for (; count--; r++)
        if (!(r->value >= r->lo && r->value <= r->hi))
            return support_fail(diag, FROE_E_OPTIONS, "option '%s': '%g' is not a number from %g to %g.", r->name,
                                r->value, r->lo, r->hi);
    return FROE_OK;
}

froe_status vector_check(const froe_scene *scene, const froe_render_options *o, froe_diagnostic *diag) {
    if (o->size != sizeof *o) return support_fail_defaults(diag, "froe_render_defaults");
    const render_range ranges[] = {{"shading", o->shading, 0, FROE_SHADING_COUNT - 1},
                                   {"cel_levels", o->cel_levels, 2, 64},
                                   {"seams", o->seams, 0, FROE_SEAMS_COUNT - 1},
                                   {"ids", o->ids, 0, FROE_IDS_FACE},
                                   {"layers", o->layers, 0, FROE_LAYERS_KIND},
                                   {"min_area", o->min_area, 0, 1e18},
                                   {"seam_width", o->seam_width, 0, 1e6},
                                   {"line_width", o->line_width, 0, 1e6},
                                   {"point_width", o->point_width, 0, 1e6},
                                   {"halo", o->halo, 0, 1e6},
                                   {"decimals", o->decimals, 0, 6},
                                   {"pixels", o->pixels, 0.1, 64}};
    froe_status status = check_in_range(ranges, sizeof ranges / sizeof *ranges, diag);
    if (!status) status = vector_check_lines(o, diag);
    if (status) return status;
    if (o->background > 0xFFFFFF && o->background < FROE_DRAW_BY_FORMAT)
        return support_fail(diag, FROE_E_OPTIONS, "option 'background': The colour 0x%X is not like 0xRRGGBB.",
                            o->background);
    if (o->seams == FROE_SEAMS_TWICE && o->interleaved)
        return support_fail(diag, FROE_E_OPTIONS,
                            "Shapes with lines among them cannot be painted twice. Other seams paint them once.");
    if (o->layers == FROE_LAYERS_KIND && o->interleaved)
        return support_fail(diag, FROE_E_OPTIONS,
                            "Lines among shapes cannot be in layers by kind. Lines on top can, and layers by object.");
    for (uint32_t g = 0; g < froe_scene_group_count(scene); g++) {
        const double opacity = vector_opacity(scene, o, g);
        if (!(opacity >= 0 && opacity <= 1))
            return support_fail(diag, FROE_E_OPTIONS, "group %u: Its opacity is %g, not a number from 0 to 1.", g,
                                opacity);
        if (opacity < 1 && o->seams == FROE_SEAMS_TWICE)
            return support_fail(diag, FROE_E_OPTIONS,
                                "Transparent shapes cannot be painted twice. Other seams paint them once.");
    }
    return FROE_OK;
}

froe_status vector_check_format(const froe_scene *scene, const froe_render_options *o, froe_render_format format,
                                froe_diagnostic *diag) {
    froe_status status = vector_check(scene, o, diag);
    const render_range page[] = {{"width", o->camera.width, 1, 32000}, {"height", o->camera.height, 1, 32000}};
    if (!status) status = check_in_range(page, 2, diag);
    if (status) return status;
    if (!support_is_utf8(o->title)) return support_fail(diag, FROE_E_OPTIONS, "The title of the picture is not UTF-8.");
    if (!support_is_utf8(o->description))
        return support_fail(diag, FROE_E_OPTIONS, "The description of the picture is not UTF-8.");
    for (uint32_t g = 0; format == FROE_RENDER_EPS && g < froe_scene_group_count(scene); g++)
        if (vector_opacity(scene, o, g) < 1)
            return support_fail(diag, FROE_E_OPTIONS,
                                "group %u ('%s'): EPS has no opacity, and the group has. Pictures with opacity are "
                                "written as .svg, .pdf or .png.",
                                g, froe_scene_group(scene, g).material);
    return FROE_OK;
}

double vector_unit(const froe_render_options *o) {
    return o->millimetres ? 72 / 25.4 : 1;
}

double vector_grid(const froe_render_options *o, froe_render_format format) {
    double grid = 1;
    if (format == FROE_RENDER_PDF || format == FROE_RENDER_EPS) return 256 * vector_unit(o);
    for (int i = 0; i < o->decimals; i++) grid *= 10;
    return grid;
}
