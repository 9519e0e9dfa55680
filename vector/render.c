/* render.c: the public calls for pictures with hidden surfaces removed: checked, computed, written. */
#include "render.h"
#include "support/fail.h"
#include "support/floats.h"
#include "support/path.h"
#include "support/writer.h"
#include <string.h>

static froe_status format_of(const char *path, froe_render_format *format, froe_diagnostic *diag) {
    static const char *const extensions[FROE_RENDER_FORMAT_COUNT] = {"svg", "pdf", "eps", "csv", "geojson"};
    const support_extension extension = support_path_extension(path);
    for (int f = 0; f < FROE_RENDER_FORMAT_COUNT; f++)
        if (strcmp(extension.text, extensions[f]) == 0) {
            *format = (froe_render_format)f;
            return FROE_OK;
        }
    if (strcmp(extension.text, "png") == 0)
        return support_fail(diag, FROE_E_UNSUPPORTED,
                            "%s: A PNG is made by froe_render_png() of the library froe-draw, not by froe_render().",
                            support_short(path));
    if (strcmp(extension.text, "dxf") == 0)
        return support_fail(diag, FROE_E_UNSUPPORTED,
                            "%s: A DXF is made by froe_render_dxf() of the library froe-io, not by froe_render().",
                            support_short(path));
    return support_fail_ending(diag, FROE_E_OPTIONS, path, "pictures",
                               ".svg, .pdf, .eps, .png, .dxf, .csv or .geojson");
}

/* ----------------------------------------------------------------------- making -- */

/* What is given per group, per patch. */
static froe_status spread_groups(vector_render *r) {
    const froe_render_options *o = r->options;
    bool any = false;
    for (uint32_t g = 0; g < froe_scene_group_count(r->scene); g++) any = any || vector_opacity(r->scene, o, g) < 1;
    if (any) r->clear = support_calloc(&r->alloc, r->patches, 1);
    if (o->priorities) r->priorities = support_calloc(&r->alloc, r->patches, sizeof *r->priorities);
    if ((any && !r->clear) || (o->priorities && !r->priorities)) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < r->patches; i++) {
        const uint32_t group = froe_surface_patch(r->surface, i).group;
        if (group == FROE_NONE) continue;
        if (r->clear) r->clear[i] = vector_opacity(r->scene, o, group) < 1;
        if (r->priorities) r->priorities[i] = o->priorities[group];
    }
    return FROE_OK;
}

static froe_status find_picture(vector_render *r, froe_diagnostic *diag) {
    const froe_render_options *o = r->options;
    froe_picture_options p = froe_picture_defaults();
    p.view = &r->view;
    p.paint = o->paint;
    p.no_fills = r->lines_only || o->shading == FROE_SHADE_NONE;
    p.underlap = o->seams == FROE_SEAMS_UNDERLAP ? o->seam_width : 0;
    p.styles = r->keys ? r->keys : r->style_of;
    p.min_area = o->min_area;
    p.clear = r->clear;
    p.priorities = r->priorities;
    p.cull_back = o->cull_back;
    p.lines = o->line_width > 0 ? o->lines : o->lines & FROE_LINE_POINT;
    if (!(o->point_width > 0)) p.lines &= ~(uint32_t)FROE_LINE_POINT;
    p.crease = o->crease;
    p.section = o->section;
    p.interleave = o->interleaved && p.lines ? vector_line_reach(o) : 0;
    p.chains = r->owners;
    p.interleave_points = o->interleaved ? 0.5 * vector_line_style(o, FROE_LINE_POINT, false, 1).width : 0;
    p.hidden = o->hidden;
    p.halo = o->halo;
    p.threads = o->threads;
    p.alloc = &r->alloc;
    p.progress = o->progress;
    p.user = o->user;
    return froe_picture_new(r->tree, r->surface, &p, &r->picture, diag);
}

froe_status vector_prepare(vector_render *r, const froe_camera *camera, froe_diagnostic *diag) {
    r->alloc = support_allocator(r->options->alloc);
    froe_status status = froe_camera_place(camera, r->scene, &r->view, diag);
    if (!status) status = froe_surface_new(r->scene, &r->alloc, &r->surface, diag);
    if (status) return status;
    r->patches = froe_surface_patch_count(r->surface);
    if (vector_shade(r) || spread_groups(r) || vector_find_owners(r)) return support_fail_memory(diag);
    status = find_picture(r, diag);
    if (status) return status;
    r->report.picture = froe_picture_statistics(r->picture);
    r->report.view = r->view;
    return vector_sort_strokes(r) || vector_count_shown(r) ? support_fail_memory(diag) : FROE_OK;
}

void vector_free(vector_render *r) {
    support_free(&r->alloc, r->owners, froe_scene_object_count(r->scene) * sizeof *r->owners);
    if (r->order) support_free(&r->alloc, r->order, froe_picture_stroke_count(r->picture) * sizeof *r->order);
    froe_picture_free(r->picture);
    froe_surface_free(r->surface);
    support_free(&r->alloc, r->style_of, r->patches * sizeof *r->style_of);
    support_free(&r->alloc, r->clear, r->patches);
    support_free(&r->alloc, r->priorities, r->patches * sizeof *r->priorities);
    support_free(&r->alloc, r->layer_of, froe_scene_group_count(r->scene) * sizeof *r->layer_of);
    support_free(&r->alloc, r->keys, r->patches * sizeof *r->keys);
    support_free(&r->alloc, r->outlines, r->room * sizeof *r->outlines);
    array_free(&r->alloc, &r->styles);
}

/* ---------------------------------------------------------------------- writing -- */

static const char refused_sentence[] = "The receiver of the picture refused it.";

froe_status vector_end(vector_output *output, froe_diagnostic *diag) {
    const froe_status status = vector_flush(output);
    return status == FROE_E_MEMORY ? support_fail_memory(diag)
           : status                ? support_fail(diag, status, refused_sentence)
                                   : FROE_OK;
}

static void put_svg(vector_render *r, vector_output *output) {
    vector_svg_begin(r, output);
    vector_svg_picture(r, output, &(vector_frame){0});
    vector_svg_end(r, output);
}

/* A whole picture; the options are checked. */
static froe_status write_picture(vector_render *r, froe_render_format format, vector_output *output,
                                 froe_diagnostic *diag) {
    static void (*const writers[FROE_RENDER_FORMAT_COUNT])(vector_render *, vector_output *) = {
        put_svg, vector_pdf, vector_eps, vector_csv, vector_geojson};
    r->grid = vector_grid(r->options, format);
    r->lines_only = format == FROE_RENDER_CSV || format == FROE_RENDER_GEOJSON;
    froe_status status = vector_prepare(r, &r->options->camera, diag);
    if (status) return status;
    writers[format](r, output);
    status = vector_end(output, diag);
    r->report.bytes = output->count;
    return status;
}

/* The writer keeps the first error, which support_writer_close() reports. */
static bool put_to_file(void *user, const void *bytes, size_t count) {
    support_writer_put(user, bytes, count);
    return true;
}

froe_status froe_render(const froe_tree *tree, const char *path, const froe_render_options *options,
                        froe_render_report *report, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    const froe_render_options standard = froe_render_defaults();
    support_writer file;
    vector_output output = {.fn = put_to_file, .user = &file};
    froe_render_format format = FROE_RENDER_SVG;
    if (!tree || !path) return support_fail_null(diag, __func__);
    vector_render r = {.tree = tree, .scene = froe_tree_scene(tree), .options = options ? options : &standard};
    froe_status status = format_of(path, &format, diag);
    if (!status) status = vector_check_format(r.scene, r.options, format, diag);
    if (!status) status = support_writer_open(&file, path, r.options->alloc, diag);
    if (status) return status;
    status = write_picture(&r, format, &output, diag);
    status = support_writer_close(&file, status);
    if (!status && report) *report = r.report;
    vector_free(&r);
    return status;
}

froe_status froe_render_write(const froe_tree *tree, froe_render_format format, froe_write_fn *fn, void *user,
                              const froe_render_options *options, froe_render_report *report, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    const froe_render_options standard = froe_render_defaults();
    vector_output output = {.fn = fn, .user = user};
    if (!tree || !fn) return support_fail_null(diag, __func__);
    if ((unsigned)format >= FROE_RENDER_FORMAT_COUNT)
        return support_fail(diag, FROE_E_OPTIONS, "There is no format %d.", (int)format);
    vector_render r = {.tree = tree, .scene = froe_tree_scene(tree), .options = options ? options : &standard};
    froe_status status = vector_check_format(r.scene, r.options, format, diag);
    if (status) return status;
    status = write_picture(&r, format, &output, diag);
    if (!status && report) *report = r.report;
    vector_free(&r);
    return status;
}

typedef struct path_receiver {
    froe_render_path_fn *fn;
    void *user;
} path_receiver;

static bool hand_over(void *user, const froe_render_path *path) {
    const path_receiver *to = user;
    return support_callback(to->fn(to->user, path));
}

froe_status froe_render_paths(const froe_tree *tree, double steps, froe_render_path_fn *fn, void *user,
                              const froe_render_options *options, froe_render_report *report, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    const froe_render_options standard = froe_render_defaults();
    path_receiver to = {fn, user};
    if (!tree || !fn) return support_fail_null(diag, __func__);
    if (!(steps > 0 && steps <= 1e6))
        return support_fail(diag, FROE_E_OPTIONS, "option 'steps': '%g' is not a number above 0 and up to 1e6.", steps);
    vector_render r = {.tree = tree, .scene = froe_tree_scene(tree), .options = options ? options : &standard};
    r.grid = steps;
    froe_status status = vector_check(r.scene, r.options, diag);
    if (status) return status;
    status = vector_prepare(&r, &r.options->camera, diag);
    if (!status) vector_each_path(&r, hand_over, &to);
    if (!status && report) *report = r.report;
    vector_free(&r);
    return status;
}

froe_status froe_render_lines(const froe_tree *tree, froe_render_line_fn *fn, void *user,
                              const froe_render_options *options, froe_render_report *report, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    const froe_render_options standard = froe_render_defaults();
    if (!tree || !fn) return support_fail_null(diag, __func__);
    vector_render r = {.tree = tree, .scene = froe_tree_scene(tree), .options = options ? options : &standard};
    froe_status status = vector_check(r.scene, r.options, diag);
    if (status) return status;
    r.lines_only = true;
    r.grid = vector_grid(r.options, FROE_RENDER_SVG);
    status = vector_prepare(&r, &r.options->camera, diag);
    const size_t count = status ? 0 : froe_picture_stroke_count(r.picture);
    bool more = true;
    for (size_t i = 0; more && i < count; i++) {
        const froe_stroke line = vector_stroke(&r, i);
        more = !vector_stroke_shows(&r, &line) || support_callback(fn(user, &line));
    }
    if (!status && report) *report = r.report;
    vector_free(&r);
    return status;
}

froe_status froe_render_animation(const froe_tree *tree, const char *path, const froe_render_options *options,
                                  const froe_camera *cameras, size_t count, double seconds, froe_render_report *report,
                                  froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    const froe_render_options standard = froe_render_defaults(), *o = options ? options : &standard;
    support_writer file;
    vector_output output = {.fn = put_to_file, .user = &file};
    froe_render_report last = {.paths = 0};
    if (!tree || !path || !cameras || !count) return support_fail_null(diag, __func__);
    if (strcmp(support_path_extension(path).text, "svg") != 0)
        return support_fail_ending(diag, FROE_E_OPTIONS, path, "animations", ".svg");
    if (!(seconds > 0 && seconds <= 1e6))
        return support_fail(diag, FROE_E_OPTIONS, "option 'seconds': '%g' is not a number above 0 and up to 1e6.",
                            seconds);
    froe_status status = vector_check_format(froe_tree_scene(tree), o, FROE_RENDER_SVG, diag);
    if (!status) status = support_writer_open(&file, path, o->alloc, diag);
    if (status) return status;
    for (size_t i = 0; !status && i < count; i++) {
        vector_render r = {.tree = tree, .scene = froe_tree_scene(tree), .options = o};
        r.grid = vector_grid(o, FROE_RENDER_SVG);
        status = vector_prepare(&r, cameras + i, diag);
        if (!status) {
            if (i == 0) vector_svg_begin(&r, &output);
            vector_svg_picture(&r, &output, &(vector_frame){i, count, seconds});
            if (i + 1 == count) vector_svg_end(&r, &output);
            status = vector_end(&output, diag);
        }
        r.report.paths += last.paths;
        last = r.report;
        vector_free(&r);
    }
    status = support_writer_close(&file, status);
    last.bytes = output.count;
    if (!status && report) *report = last;
    return status;
}
