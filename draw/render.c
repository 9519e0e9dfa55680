/* render.c: the public calls for pictures with hidden surfaces removed: checked, computed, painted, written. */
#include "render.h"
#include "support/floats.h"
#include "support/writer.h"
#include <math.h>
#include <string.h>

froe_render_options froe_render_defaults(void) {
    return (froe_render_options){
        .size = sizeof(froe_render_options),
        .camera = froe_camera_defaults(),
        .cel_levels = 4,
        .seam_width = 1,
        .lines = FROE_LINE_BORDER | FROE_LINE_SILHOUETTE | FROE_LINE_OBJECT | FROE_LINE_MATERIAL | FROE_LINE_CREASE |
                 FROE_LINE_CROSSING | FROE_LINE_SECTION,
        .crease = 30,
        .line_width = 1,
        .background = FROE_DRAW_CLEAR,
        .decimals = 2,
        .pixels = 1,
    };
}

const char *froe_shading_name(froe_shading shading) {
    static const char *const names[FROE_SHADING_COUNT] = {"flat", "cel", "plain", "white", "none"};
    return shading >= 0 && shading < FROE_SHADING_COUNT ? names[shading] : NULL;
}

const char *froe_seams_name(froe_seams seams) {
    static const char *const names[FROE_SEAMS_COUNT] = {"underlap", "none", "twice", "stroke"};
    return seams >= 0 && seams < FROE_SEAMS_COUNT ? names[seams] : NULL;
}

/* ---------------------------------------------------------------------- checking -- */

static bool format_of(const char *path, int *format) {
    const size_t length = strlen(path);
    if (length > 4 && (!strcmp(path + length - 4, ".eps") || !strcmp(path + length - 4, ".EPS"))) {
        *format = DRAW_EPS;
        return true;
    }
    froe_draw_format known;
    if (!froe_draw_format_of(path, &known)) return false;
    *format = (int)known;
    return true;
}

static froe_status check_seams(const froe_render_options *o, froe_diagnostic *diag) {
    if (o->seams != FROE_SEAMS_TWICE || !o->interleaved) return FROE_OK;
    return draw_fail(diag, FROE_E_OPTIONS, "Shapes with lines among them cannot be painted twice: use other seams.");
}

static froe_status check_opacity(const froe_scene *scene, const froe_render_options *o, int format,
                                 froe_diagnostic *diag) {
    for (uint32_t g = 0; g < froe_scene_group_count(scene); g++) {
        const double opacity = draw_opacity(scene, o, g);
        if (!(opacity >= 0 && opacity <= 1))
            return draw_fail(diag, FROE_E_OPTIONS, "The opacity of group %u is %g, not 0 to 1.", g, opacity);
        if (opacity < 1 && o->seams == FROE_SEAMS_TWICE)
            return draw_fail(diag, FROE_E_OPTIONS, "What one sees through cannot be painted twice: use other seams.");
        if (opacity < 1 && format == DRAW_EPS)
            return draw_fail(
                diag, FROE_E_OPTIONS,
                "EPS has no opacity, and '%s' (group %u) has: use .svg, .pdf or .png, or make everything opaque.",
                froe_scene_group(scene, g).material, g);
    }
    return FROE_OK;
}

typedef struct range {
    const char *name;
    double value, lo, hi;
} range;

static froe_status check_render_options(const froe_scene *scene, const froe_render_options *o, int format,
                                        froe_diagnostic *diag) {
    if (o->size != sizeof *o)
        return draw_fail(diag, FROE_E_OPTIONS, "The picture's options do not come from froe_render_defaults().");
    const double pixels = format == FROE_DRAW_PNG ? o->pixels : 1;
    const range ranges[] = {{"shading", o->shading, 0, FROE_SHADING_COUNT - 1},
                            {"cel_levels", o->cel_levels, 2, 64},
                            {"seams", o->seams, 0, FROE_SEAMS_COUNT - 1},
                            {"ids", o->ids, 0, FROE_IDS_FACE},
                            {"min_area", o->min_area, 0, 1e18},
                            {"seam_width", o->seam_width, 0, 1e6},
                            {"line_width", o->line_width, 0, 1e6},
                            {"halo", o->halo, 0, 1e6},
                            {"decimals", o->decimals, 0, 6},
                            {"pixels", o->pixels, 0.1, 64},
                            {"width", o->camera.width * pixels, 1, 32000},
                            {"height", o->camera.height * pixels, 1, 32000}};
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        const range *r = ranges + i;
        if (!(r->value >= r->lo && r->value <= r->hi))
            return draw_fail(diag, FROE_E_OPTIONS, "Option '%s' of a picture is %g, but must be %g to %g.", r->name,
                             r->value, r->lo, r->hi);
    }
    const froe_status status = check_seams(o, diag);
    return status ? status : check_opacity(scene, o, format, diag);
}

/* ----------------------------------------------------------------------- making -- */

/* How long a unit of the page is in what Cairo counts. */
static double unit_of(const froe_render_options *o, int format) {
    return format != FROE_DRAW_PNG && o->millimetres ? 72 / 25.4 : 1;
}

static double grid_of(const froe_render_options *o, int format) {
    double grid = 1;
    if (format != FROE_DRAW_SVG) return 256 * unit_of(o, format) * (format == FROE_DRAW_PNG ? o->pixels : 1);
    for (int i = 0; i < o->decimals; i++) grid *= 10;
    return grid;
}

/* What is given per group, per patch. */
static froe_status spread_groups(draw_render *r) {
    const froe_render_options *o = r->options;
    bool any = false;
    for (uint32_t g = 0; g < froe_scene_group_count(r->scene); g++) any = any || draw_opacity(r->scene, o, g) < 1;
    if (any) r->clear = draw_calloc(&r->alloc, r->patches + 1, 1);
    if (o->priorities) r->priorities = draw_calloc(&r->alloc, r->patches + 1, sizeof *r->priorities);
    if ((any && !r->clear) || (o->priorities && !r->priorities)) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < r->patches; i++) {
        const uint32_t group = froe_surface_patch(r->surface, i).group;
        if (group == FROE_NONE) continue;
        if (r->clear) r->clear[i] = draw_opacity(r->scene, o, group) < 1;
        if (r->priorities) r->priorities[i] = o->priorities[group];
    }
    return FROE_OK;
}

static froe_status look_at_scene(draw_render *r, froe_diagnostic *diag) {
    const froe_render_options *o = r->options;
    froe_picture_options p = froe_picture_defaults();
    p.view = &r->view;
    p.paint = o->paint;
    p.no_fills = o->shading == FROE_SHADE_NONE;
    p.underlap = o->seams == FROE_SEAMS_UNDERLAP ? o->seam_width : 0;
    p.styles = r->keys ? r->keys : r->style_of;
    p.min_area = o->min_area;
    p.clear = r->clear;
    p.priorities = r->priorities;
    p.cull_back = o->cull_back;
    p.lines = o->line_width > 0 ? o->lines : 0;
    p.crease = o->crease;
    p.section = o->section;
    p.interleave = o->interleaved ? 0.5 * o->line_width : 0;
    p.hidden = o->hidden;
    p.halo = o->halo;
    p.alloc = &r->alloc;
    p.progress = o->progress;
    p.user = o->user;
    return froe_picture_new(r->tree, r->surface, &p, &r->picture, diag);
}

static froe_status prepare(draw_render *r, const froe_camera *camera, froe_diagnostic *diag) {
    froe_status status = froe_camera_place(camera, r->scene, &r->view, diag);
    if (!status) status = froe_surface_new(r->scene, &r->alloc, &r->surface, diag);
    if (status) return status;
    r->patches = froe_surface_patch_count(r->surface);
    status = draw_shade(r);
    if (!status) status = spread_groups(r);
    status = status ? draw_fail_memory(diag) : look_at_scene(r, diag);
    if (status) return status;
    r->report.picture = froe_picture_statistics(r->picture);
    r->report.view = r->view;
    draw_count_shown(r);
    return FROE_OK;
}

static froe_status paint(draw_render *r, int format, draw_output *output, froe_diagnostic *diag) {
    const froe_render_options *o = r->options;
    if (format == FROE_DRAW_SVG) {
        const draw_frame always = {0};
        const bool ok = draw_svg_begin(r, output) && draw_svg_picture(r, output, &always) && draw_svg_end(r, output);
        return ok ? FROE_OK : draw_fail_memory(diag);
    }
    const double unit = unit_of(o, format);
    froe_status status = draw_output_begin(output, &r->alloc, (froe_draw_format)format, o->camera.width * unit,
                                           o->camera.height * unit, o->pixels, o->title, diag);
    if (status) return status;
    cairo_scale(output->cr, unit, unit);
    draw_cairo(r, output->cr);
    return draw_output_finish(output, diag);
}

static void free_render(draw_render *r) {
    froe_picture_free(r->picture);
    froe_surface_free(r->surface);
    draw_free(&r->alloc, r->style_of, (r->patches + 1) * sizeof *r->style_of);
    draw_free(&r->alloc, r->clear, r->patches + 1);
    draw_free(&r->alloc, r->priorities, (r->patches + 1) * sizeof *r->priorities);
    draw_free(&r->alloc, r->layer_of, (froe_scene_group_count(r->scene) + 1) * sizeof *r->layer_of);
    draw_free(&r->alloc, r->keys, (r->patches + 1) * sizeof *r->keys);
    draw_release(&r->alloc, &r->styles);
}

froe_status froe_render(const froe_tree *tree, const char *path, const froe_render_options *options,
                        froe_render_report *report, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    const froe_render_options standard = froe_render_defaults();
    int format = 0;
    if (!tree || !path) return draw_fail(diag, FROE_E_ARG, "A picture needs a tree and a path.");
    if (!options) options = &standard;
    if (!format_of(path, &format))
        return draw_fail(diag, FROE_E_OPTIONS, "Cannot tell from '%.140s' what to draw: use .svg, .pdf, .eps or .png.",
                         path);
    draw_render r = {.tree = tree, .scene = froe_tree_scene(tree), .options = options};
    froe_status status = check_render_options(r.scene, options, format, diag);
    if (status) return status;
    r.alloc = draw_allocator(options->alloc);
    r.grid = grid_of(options, format);
    draw_output output = {.alloc = r.alloc};
    status = prepare(&r, &options->camera, diag);
    if (!status) status = paint(&r, format, &output, diag);
    if (!status) status = support_write(path, output.bytes.data, output.bytes.count, &r.alloc, diag);
    r.report.bytes = output.bytes.count;
    if (!status && report) *report = r.report;
    draw_output_free(&output);
    free_render(&r);
    return status;
}

/* ------------------------------------------------------------------------ turning -- */

static froe_status add_frame(draw_render *r, const froe_camera *camera, const draw_frame *frame, draw_output *output,
                             froe_diagnostic *diag) {
    froe_status status = prepare(r, camera, diag);
    if (!status && frame->i == 0 && !draw_svg_begin(r, output)) status = draw_fail_memory(diag);
    if (!status && !draw_svg_picture(r, output, frame)) status = draw_fail_memory(diag);
    if (!status && frame->i + 1 == frame->count && !draw_svg_end(r, output)) status = draw_fail_memory(diag);
    return status;
}

froe_status froe_render_animation(const froe_tree *tree, const char *path, const froe_render_options *options,
                                  const froe_camera *cameras, size_t count, double seconds, froe_render_report *report,
                                  froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    const froe_render_options standard = froe_render_defaults();
    int format = 0;
    uint64_t paths = 0;
    if (!tree || !path || !cameras || !count)
        return draw_fail(diag, FROE_E_ARG, "An animation needs a tree, a path and cameras.");
    if (!options) options = &standard;
    if (!format_of(path, &format) || format != FROE_DRAW_SVG)
        return draw_fail(diag, FROE_E_OPTIONS, "Only SVG moves: '%.140s' does not end in .svg.", path);
    if (!(seconds > 0 && seconds <= 1e6))
        return draw_fail(diag, FROE_E_OPTIONS, "A round of %g seconds is none.", seconds);
    froe_status status = check_render_options(froe_tree_scene(tree), options, format, diag);
    draw_output output = {.alloc = draw_allocator(options->alloc)};
    for (size_t i = 0; !status && i < count; i++) {
        draw_render r = {.tree = tree, .scene = froe_tree_scene(tree), .options = options, .alloc = output.alloc};
        r.grid = grid_of(options, format);
        const draw_frame frame = {i, count, seconds};
        status = add_frame(&r, cameras + i, &frame, &output, diag);
        r.report.paths = paths += r.report.paths;
        r.report.bytes = output.bytes.count;
        if (!status && report) *report = r.report;
        free_render(&r);
    }
    if (!status) status = support_write(path, output.bytes.data, output.bytes.count, &output.alloc, diag);
    draw_output_free(&output);
    return status;
}
