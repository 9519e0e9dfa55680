/* render_options.c: each part of the command line, checked. */
#include "commands/render_options.h"
#include "args/picture.h"
#include "exit.h"
#include "support/path.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Of seams and lines, and so of points. */
static void set_widths(froe_render_options *o, double width) {
    o->seam_width = o->line_width = width;
    o->point_width = 3 * width;
}

static int set_size(const char *text, froe_render_options *o) {
    char *end = NULL;
    if (!text) return 0;
    o->camera.width = strtod(text, &end);
    const bool times = end != text && *end == 'x';
    const char *second = times ? end + 1 : text;
    if (times) o->camera.height = strtod(second, &end);
    const bool mm = strcmp(end, "mm") == 0;
    if (!times || end == second || (*end && !mm))
        return cli_fail(CLI_USE, NULL, "--size: '%s' is not like 1000x800 or 160x120mm.", text);
    const double least = fmin(o->camera.width, o->camera.height), most = fmax(o->camera.width, o->camera.height);
    if (!(least >= 1 && most <= 32000))
        return cli_fail(CLI_USE, NULL, "--size: '%s' is not between 1x1 and 32000x32000.", text);
    if (mm && !o->millimetres) set_widths(o, 0.2);
    o->millimetres = mm;
    return 0;
}

static int set_point(const char *name, const cli_reals *given, double out[3]) {
    if (!given->count) return 0;
    if (given->count != 3) return cli_fail_count(name, given->count, 3);
    memcpy(out, given->at, 3 * sizeof *out);
    return 0;
}

static int set_camera(const render_args *args, const froe_scene *scene, froe_camera *c) {
    /* Directions of the views, for z up: right, towards the front (-y), up. */
    static const double from[][3] = {{3, -5, 2}, {1, -1, 1}, {0, -1, 0}, {0, 1, 0}, {-1, 0, 0},
                                     {1, 0, 0},  {0, 0, 1},  {0, 0, -1}, {1, -4, 2}};
    const double *d = from[args->direction < 0 ? 0 : args->direction];
    const int up = args->up_axis < 0 ? froe_scene_up(scene) : args->up_axis;
    double lo[FROE_MAX_DIM] = {0}, hi[FROE_MAX_DIM] = {0};
    froe_scene_bounds(scene, lo, hi);
    for (int k = 0; k < 3; k++) c->up[k] = k == up, c->target[k] = 0;
    c->eye[up] = d[2];
    c->eye[(up + 1) % 3] = up == 1 ? -d[1] : d[0]; /* y up: z points at the viewer */
    c->eye[(up + 2) % 3] = up == 1 ? d[0] : d[1];
    if (args->eye.count || args->target.count) {
        for (int k = 0; k < 3; k++) c->target[k] = 0.5 * lo[k] + 0.5 * hi[k];
        int code = set_point("target", &args->target, c->target);
        for (int k = 0; k < 3; k++) c->eye[k] += c->target[k];
        if (!code) code = set_point("eye", &args->eye, c->eye);
        if (code) return code;
        c->fit = !args->eye.count;
    }
    if (args->section.count) c->section = args->section.at;
    if (args->parallel || args->direction > 0) c->parallel = true;
    cli_set_number(args->fov, &c->fov);
    c->margin = fmin(c->width / 50, c->height / 4);
    cli_set_number(args->margin, &c->margin);
    if (!(c->margin >= 0 && 2 * c->margin < fmin(c->width, c->height)))
        return cli_fail(CLI_USE, NULL, "--margin: '%g' leaves nothing of a page of %g x %g.", c->margin, c->width,
                        c->height);
    return 0;
}

/* S, or 1:50. */
static int set_scale(const render_args *args, froe_render_options *o) {
    char *end;
    if (!args->scale) return 0;
    double scale = strtod(args->scale, &end);
    bool known = end != args->scale;
    if (known && *end == ':') {
        const char *second = end + 1;
        const double to = strtod(second, &end);
        known = end != second;
        if (known && !o->millimetres)
            return cli_fail(CLI_USE, NULL, "--scale: '%s' needs a page in millimetres, such as --size 160x120mm.",
                            args->scale);
        scale = scale / to * 1000 * (isnan(args->unit) ? 1 : args->unit);
    }
    if (!known || *end) return cli_fail(CLI_USE, NULL, "--scale: '%s' is not like 2.5 or 1:50.", args->scale);
    if (!(scale > 0) || isinf(scale))
        return cli_fail(CLI_USE, NULL, "--scale: '%s' is not a number above 0.", args->scale);
    if (!o->camera.parallel)
        return cli_fail(CLI_USE, NULL, "--scale: Perspective has none. It needs --parallel, or --fov instead.");
    o->camera.scale = scale;
    return 0;
}

static int set_style(const char *text, froe_render_options *o) {
    if (!text) return 0;
    char *end;
    if (strncmp(text, "cel:", 4) == 0) {
        o->shading = FROE_SHADE_CEL;
        const long levels = strtol(text + 4, &end, 10);
        if (end == text + 4 || *end) return cli_fail(CLI_USE, NULL, "--style: '%s' is not like cel:4.", text);
        o->cel_levels = (unsigned)levels;
        if (levels >= 2 && levels <= 64) return 0;
        return cli_fail(CLI_USE, NULL, "--style: '%s' names no number of steps from 2 to 64.", text);
    }
    for (int s = 0; s < FROE_SHADING_COUNT; s++)
        if (strcmp(text, froe_shading_name((froe_shading)s)) == 0) {
            o->shading = (froe_shading)s;
            return 0;
        }
    return cli_fail(CLI_USE, NULL, "--style: '%s' is not one of flat, cel, cel:N, plain, white, none.", text);
}

/* Lines as a preset draws them, which depends on how wide a line is. */
static void set_preset_styles(int preset, double width, render_styles *styles) {
    froe_line_style style = froe_line_style_defaults();
    if (preset == TECHNICAL) { /* ISO 128-2: hidden lines are narrow, half as wide as visible outlines, and dashed */
        style.hidden = UINT32_MAX;
        style.colour = 0x7A848C; /* so that visible lines stand out among many */
        style.width = 0.5 * width, style.dash = 4 * width, style.gap = 2 * width;
        styles->at[styles->count++] = style;
    } else if (preset == PLOTTER) { /* one pen */
        style.visible = style.hidden = UINT32_MAX;
        style.width = width, style.colour = 0x000000;
        styles->at[styles->count++] = style;
    }
}

int render_set_groups(const char *option, const char *list, const froe_scene *scene, double *values) {
    const size_t groups = froe_scene_group_count(scene);
    while (list && *list) {
        const size_t length = strcspn(list, ",");
        const char *equals = memchr(list, '=', length);
        char *end = NULL;
        const double value = equals ? strtod(equals + 1, &end) : 0;
        bool any = false;
        if (!equals || end != list + length || end == equals + 1 || !isfinite(value))
            return cli_fail(CLI_USE, NULL, "--%s: '%.*s' is not like NAME=1.", option, (int)length, list);
        const size_t name = (size_t)(equals - list);
        for (uint32_t g = 0; g < groups; g++) {
            const froe_group group = froe_scene_group(scene, g);
            const bool same = (strlen(group.name) == name && !memcmp(group.name, list, name)) ||
                              (strlen(group.material) == name && !memcmp(group.material, list, name));
            if (same) values[g] = value, any = true;
        }
        if (!any)
            return cli_fail(CLI_USE, NULL, "--%s: There is no group or material '%.*s'.", option, (int)name, list);
        list += length + (list[length] == ',');
    }
    return 0;
}

/* What else the library would refuse, by the names that options have here. */
static int check_values(const render_args *args) {
    const cli_range ranges[] = {{"fov", args->fov, 1, 170},
                                {"crease", args->crease, 0, 180},
                                {"halo", args->halo, 0, 1e6},
                                {"line-width", args->line_width, 0, 1e6},
                                {"point-width", args->point_width, 0, 1e6},
                                {"seam-width", args->seam_width, 0, 1e6},
                                {"min-area", args->min_area, 0, 1e18},
                                {"pixels", args->pixels, 0.1, 64},
                                {"seconds", args->seconds, 1e-3, 1e6}};
    int code = cli_check_ranges(ranges, sizeof ranges / sizeof *ranges);
    if (!code) code = cli_check_text("title", args->title);
    return code ? code : cli_check_text("desc", args->description);
}

/* A PNG has up to 32,000 pixels a side. */
static int check_pixels(const char *path, const froe_render_options *o) {
    const double width = o->camera.width * o->pixels, height = o->camera.height * o->pixels;
    if (strcmp(support_path_extension(path).text, "png") != 0 || fmax(width, height) <= 32000) return 0;
    return cli_fail(CLI_USE, NULL,
                    "--pixels: With '%g' the picture has %g x %g pixels. A side of at most 32000 is possible.",
                    o->pixels, width, height);
}

/* Lines as data are kept apart by object unless something else is said. */
static bool is_data(const char *path) {
    const support_extension extension = support_path_extension(path);
    return !strcmp(extension.text, "csv") || !strcmp(extension.text, "geojson");
}

/* The styles from `first` on, where hidden lines are not drawn. */
static int check_visible(const render_styles *styles, size_t first) {
    for (size_t i = first; i < styles->count; i++)
        if (!styles->at[i].visible)
            return cli_fail(CLI_USE, NULL, "--line-style: Hidden lines are not drawn. They need --hidden dashed.");
    return 0;
}

/* What is given, and would change nothing. */
static int check_needs(const render_args *args, const froe_render_options *o) {
    const support_extension ending = support_path_extension(args->output.path);
    const bool png = !strcmp(ending.text, "png"),
               fixed = png || !strcmp(ending.text, "pdf") || !strcmp(ending.text, "eps");
    const bool layered = !strcmp(ending.text, "svg") || !strcmp(ending.text, "dxf");
    const bool titled = !strcmp(ending.text, "svg") || !strcmp(ending.text, "pdf");
    const uint32_t creases = FROE_LINE_CREASE | FROE_LINE_MESH, dots = FROE_LINE_POINT;
    const bool lines = o->lines & ~dots && o->line_width > 0;
    static const char unlined[] = "No lines are drawn, by --line-kinds or --line-width.";
    const cli_need needs[] = {
        {"view", args->direction >= 0, !args->eye.count, "It excludes --eye, which says where from."},
        {"target", args->target.count, args->eye.count || args->turntable,
         "It needs --eye. Without that the eye is where it sees all of the scene."},
        {"fov", !isnan(args->fov), !o->camera.parallel,
         "The projection is parallel, by --parallel, --preset technical or a --view other than corner."},
        {"unit", !isnan(args->unit), args->scale && strchr(args->scale, ':'), "It needs a --scale like 1:50."},
        {"seconds", !isnan(args->seconds), args->animate, "It needs --animate."},
        {"seam-width", !isnan(args->seam_width), o->seams == FROE_SEAMS_UNDERLAP || o->seams == FROE_SEAMS_STROKE,
         "It needs --seams underlap or stroke."},
        {"line-width", !isnan(args->line_width), o->lines & ~dots, "No lines are drawn, by --line-kinds."},
        {"point-width", !isnan(args->point_width), o->lines & dots, "No points are drawn, by --line-kinds."},
        {"crease", !isnan(args->crease), lines && o->lines & creases,
         "It tells creases from the mesh, and neither is drawn, by --line-kinds or --line-width."},
        {"halo", !isnan(args->halo), lines, unlined},
        {"hidden", args->hidden > 0, lines, unlined},
        {"decimals", args->decimals != UINT64_MAX, !fixed,
         "Files of the endings .pdf, .eps and .png have steps of their own."},
        {"layers", args->layers > 0, layered, "Only files of the endings .svg and .dxf have layers."},
        {"title", args->title != NULL, titled, "Only files of the endings .svg and .pdf have titles."},
        {"desc", args->description != NULL, titled, "Only files of the endings .svg and .pdf have descriptions."},
        {"pixels", !isnan(args->pixels), png, "Only files of the ending .png have pixels."},
    };
    return cli_check_needs(needs, sizeof needs / sizeof *needs);
}

int render_set_options(const render_args *args, const froe_scene *scene, froe_render_options *o,
                       render_styles *styles) {
    if (args->preset == TECHNICAL) {
        o->shading = FROE_SHADE_NONE;
        o->camera.parallel = true;
        o->hidden = true;
    } else if (args->preset == PLOTTER) {
        o->shading = FROE_SHADE_WHITE;
        o->paint = FROE_PAINT_REGIONS;
    } else if (args->preset == WEB) {
        o->decimals = 1;
    } else if (args->preset == PRINT) {
        o->millimetres = true;
        o->camera.width = 160, o->camera.height = 120;
        set_widths(o, 0.2);
        o->decimals = 3;
    }
    int code = check_values(args);
    if (!code) code = set_size(args->size, o);
    if (!code) code = set_camera(args, scene, &o->camera);
    if (!code) code = set_scale(args, o);
    if (!code) code = set_style(args->shading, o);
    if (!code) code = render_set_lines(args->lines, &o->lines);
    if (!code) code = cli_set_background(args->background, &o->background);
    if (args->paint) o->paint = (froe_paint)args->paint;
    cli_set_number(args->seam_width, &o->seam_width);
    cli_set_number(args->line_width, &o->line_width);
    cli_set_number(args->point_width, &o->point_width);
    cli_set_number(args->crease, &o->crease);
    cli_set_number(args->halo, &o->halo);
    cli_set_number(args->pixels, &o->pixels);
    if (args->decimals != UINT64_MAX) o->decimals = (int)args->decimals;
    if (args->hidden >= 0) o->hidden = args->hidden > 0;
    o->cull_back = args->cull_back;
    o->threads = (unsigned)args->common.threads;
    o->section = args->section.count ? -1 : 0;
    o->interleaved = args->over > 0;
    o->own_colours = args->colours > 0;
    o->ids = args->ids >= 0 ? (froe_ids)args->ids : is_data(args->output.path) ? FROE_IDS_OBJECT : FROE_IDS_NONE;
    o->layers = (froe_layers)args->layers;
    o->seams = (froe_seams)args->seams;
    cli_set_number(args->min_area, &o->min_area);
    o->title = args->title, o->description = args->description;
    if (o->line_width > 0) set_preset_styles(args->preset, o->line_width, styles);
    const size_t preset = styles->count;
    if (!code) code = render_add_styles(args->line_style, styles);
    if (!code && !o->hidden) code = check_visible(styles, preset);
    if (!code) code = check_needs(args, o);
    o->line_styles = styles->at, o->line_style_count = styles->count;
    return code ? code : check_pixels(args->output.path, o);
}

int render_prepare(const render_args *args, const froe_scene *scene, render_prepared *out) {
    const size_t groups = froe_scene_group_count(scene);
    *out = (render_prepared){.options = froe_render_defaults()};
    out->values = calloc(2 * groups + 1, sizeof *out->values);
    out->priorities = calloc(groups + 1, sizeof *out->priorities);
    if (!out->values || !out->priorities) return cli_fail_memory();
    int code = render_set_options(args, scene, &out->options, &out->styles);
    for (size_t g = 0; !code && g < groups; g++) out->values[g] = NAN;
    if (!code) code = render_set_groups("opacity", args->opacity, scene, out->values);
    if (!code) code = render_set_groups("priority", args->priority, scene, out->values + groups);
    for (size_t g = 0; !code && g < groups; g++) {
        const double priority = out->values[groups + g];
        if (fabs(priority) > 1e9 || priority != floor(priority))
            code = cli_fail(CLI_USE, NULL, "--priority: '%g' is not a whole number from -1e9 to 1e9.", priority);
        if (!code) out->priorities[g] = (int32_t)priority;
    }
    if (args->opacity) out->options.opacity = out->values;
    if (args->priority) out->options.priorities = out->priorities;
    return code;
}

void render_release(render_prepared *prepared) {
    free(prepared->values), free(prepared->priorities);
}
