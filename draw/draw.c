/* draw.c: the public calls: options checked, page planned and painted, bytes written. */
#include "map/map.h"
#include "output.h"
#include "palette.h"
#include "picture.h"
#include "support/escape.h"
#include "support/fail.h"
#include "support/floats.h"
#include "support/path.h"
#include "support/utf8.h"
#include "support/writer.h"
#include <math.h>
#include <string.h>

void froe_draw_defaults_into(froe_draw_options *out, size_t size) {
    const froe_draw_options all = {.size = size,
                                   .style = FROE_DRAW_AUTO,
                                   .width = 960,
                                   .margin = -1,
                                   .scale = 1,
                                   .background = DRAW_PAPER,
                                   .legend = true,
                                   .detail = -1,
                                   .axis = -1,
                                   .up = -1,
                                   .explode = 0.5,
                                   .explode_depth = 4};
    support_defaults(out, size, &all, sizeof all);
}

const char *froe_draw_style_name(froe_draw_style style) {
    static const char *const names[FROE_DRAW_STYLE_COUNT] = {"auto", "flat", "sections", "exploded"};
    return (unsigned)style < FROE_DRAW_STYLE_COUNT ? names[style] : NULL;
}

const char *froe_draw_layer_name(froe_draw_layer layer) {
    switch (layer) {
    case FROE_DRAW_CELLS:
        return "cells";
    case FROE_DRAW_CUTS:
        return "cuts";
    case FROE_DRAW_FRAGMENTS:
        return "fragments";
    case FROE_DRAW_OBJECTS:
        return "objects";
    default:
        return NULL;
    }
}

bool froe_draw_format_of(const char *path, froe_draw_format *format) {
    static const char *const extensions[FROE_DRAW_FORMAT_COUNT] = {"svg", "pdf", "png"};
    const support_extension extension = support_path_extension(path ? path : "");
    for (int f = 0; f < FROE_DRAW_FORMAT_COUNT; f++)
        if (strcmp(extension.text, extensions[f]) == 0) {
            *format = (froe_draw_format)f;
            return true;
        }
    return false;
}

/* --------------------------------------------------------------- checking -- */

typedef struct draw_range {
    const char *name;
    double value, lo, hi;
} draw_range;

static bool all_finite(const double *x, int count) {
    for (int k = 0; k < count; k++)
        if (!isfinite(x[k])) return false;
    return true;
}

static froe_status check_options(const froe_draw_options *o, int dim, froe_diagnostic *diag) {
    if (o->size != sizeof *o) return support_fail_defaults(diag, "froe_draw_defaults");
    if (dim > 3) return support_fail(diag, FROE_E_UNSUPPORTED, "Pictures exist in 2 and 3 dimensions, not in %d.", dim);
    if ((unsigned)o->style >= FROE_DRAW_STYLE_COUNT)
        return support_fail(diag, FROE_E_OPTIONS, "There is no style %d.", (int)o->style);
    if (o->style != FROE_DRAW_AUTO && (o->style == FROE_DRAW_FLAT) != (dim == 2))
        return support_fail(diag, FROE_E_OPTIONS, "Style '%s' does not suit a tree of dimension %d.",
                            froe_draw_style_name(o->style), dim);
    if (o->background > 0xFFFFFF && o->background < FROE_DRAW_BY_FORMAT)
        return support_fail(diag, FROE_E_OPTIONS, "option 'background': The colour 0x%X is not like 0xRRGGBB.",
                            o->background);
    if (o->show > 15) return support_fail(diag, FROE_E_OPTIONS, "option 'show': It has unknown bits.");
    if (!all_finite(o->lo, 3) || !all_finite(o->hi, 3) || !all_finite(o->view, 3))
        return support_fail(diag, FROE_E_OPTIONS, "The window and the direction of view must be finite.");
    for (size_t i = 0; i < o->mark_count; i++)
        if (!o->marks || !all_finite(o->marks[i].lo, 3) || !all_finite(o->marks[i].hi, 3))
            return support_fail(diag, FROE_E_OPTIONS, "Mark %zu of a picture is not finite.", i);
    for (size_t i = 0; i < o->mark_count; i++)
        if ((unsigned)o->marks[i].kind >= FROE_DRAW_MARK_KIND_COUNT || !support_is_utf8(o->marks[i].label))
            return support_fail(diag, FROE_E_OPTIONS,
                                "Mark %zu of a picture has an unknown kind, or a label that is not UTF-8.", i);
    if (o->accented_count && !o->accented)
        return support_fail(diag, FROE_E_OPTIONS, "The objects to be accented are missing.");
    if (!support_is_utf8(o->title)) return support_fail(diag, FROE_E_OPTIONS, "The title of the picture is not UTF-8.");
    const draw_range ranges[] = {{"width", o->width, 16, 32000},
                                 {"height", o->height, o->height == 0 ? 0 : 16, 32000},
                                 {"margin", o->margin, -HUGE_VAL, o->width / 2},
                                 {"scale", o->scale, 0.1, 16},
                                 {"detail", o->detail, -HUGE_VAL, 1e6},
                                 {"axis", o->axis, -1, 2},
                                 {"up", o->up, -1, 2},
                                 {"at", o->at, -1.7976931348623157e308, 1.7976931348623157e308},
                                 {"explode", o->explode, 0, 10},
                                 {"explode_depth", o->explode_depth, 0, 32}};
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        const draw_range *r = ranges + i;
        if (r->value >= r->lo && r->value <= r->hi) continue;
        if (r->lo == -HUGE_VAL)
            return support_fail(diag, FROE_E_OPTIONS, "option '%s': '%g' is not a number up to %g.", r->name, r->value,
                                r->hi);
        return support_fail(diag, FROE_E_OPTIONS, "option '%s': '%g' is not a number from %g to %g.", r->name, r->value,
                            r->lo, r->hi);
    }
    return FROE_OK;
}

/* --------------------------------------------------------------- painting -- */

static froe_status paint_page(draw_picture *picture, froe_draw_format format, draw_output *output,
                              froe_diagnostic *diag) {
    const draw_page *page = &picture->page;
    const double scale = page->options->scale, most = 32000;
    bool solid = page->options->style == FROE_DRAW_EXPLODED;
    froe_status status = solid ? draw_solid_plan(picture) : draw_plane_plan(picture);
    if (status == FROE_OK && format == FROE_DRAW_PNG && !(page->width * scale <= most && page->height * scale <= most))
        return support_fail(diag, FROE_E_OPTIONS,
                            "A PNG of %.0f x %.0f pixels is too large. There are at most %.0f either way.",
                            page->width * scale, page->height * scale, most);
    if (status == FROE_OK) {
        status = draw_output_begin(output, &page->alloc, format, page->width, page->height, page->options->scale,
                                   page->options->title, diag);
        if (status != FROE_OK) return status;
        status = solid ? draw_solid_paint(picture, output->cr) : draw_plane_paint(picture, output->cr);
    }
    if (status == FROE_E_MEMORY) support_fail_memory(diag);
    if (status == FROE_E_CANCELLED) support_fail_cancelled(diag);
    return status == FROE_OK ? draw_output_finish(output, diag) : status;
}

/* How many marks have nothing in the box that the picture shows; of a ball the box around it counts. */
static size_t count_outside(const draw_picture *picture, const froe_draw_options *o) {
    const draw_space *space = &picture->space;
    size_t count = 0;
    for (size_t i = 0; i < o->mark_count; i++) {
        bool outside = false;
        for (int k = 0; k < space->dim; k++) {
            const double a = draw_space_map(space, k, o->marks[i].lo[space->from[k]]);
            const double b = draw_space_map(space, k, o->marks[i].hi[space->from[k]]);
            outside = outside || fmin(a, b) > picture->wide[k] || fmax(a, b) < -picture->wide[k];
        }
        count += outside;
    }
    return count;
}

/* The picture's bytes, in `output`, which the caller frees. */
static froe_status make(const froe_tree *tree, froe_draw_format format, const froe_draw_options *given,
                        draw_output *output, froe_diagnostic *diag) {
    froe_draw_options o = given ? *given : froe_draw_defaults();
    const bool sized = o.size == sizeof o; /* otherwise its pointers may lead nowhere */
    *output = (draw_output){.alloc = support_allocator(sized ? o.alloc : NULL)};
    int dim = froe_scene_dim(froe_tree_scene(tree));
    froe_status status = check_options(&o, dim, diag);
    if (status == FROE_OK) status = froe_tree_check(tree, diag);
    if (status != FROE_OK) return status;
    if (o.style == FROE_DRAW_AUTO) o.style = dim == 2 ? FROE_DRAW_FLAT : FROE_DRAW_SECTIONS;
    froe_report report = froe_tree_report(tree);
    /* Small trees are drawn to the last cell a reader may zoom into; of large ones, what the page shows. */
    if (o.detail < 0)
        o.detail = format == FROE_DRAW_PNG                    ? 1 / fmax(o.scale, 1)
                   : report.leaves + report.objects <= 100000 ? 0.125
                                                              : 3;
    const uint32_t all = FROE_DRAW_CELLS | FROE_DRAW_CUTS | FROE_DRAW_FRAGMENTS | FROE_DRAW_OBJECTS,
                   standard = o.style == FROE_DRAW_EXPLODED ? all & ~(uint32_t)FROE_DRAW_CUTS : all;
    draw_task task = {.progress = o.progress, .user = o.user};
    task.total = 3.0 * (double)(report.nodes + report.objects + report.fragments) + 1;
    draw_picture picture = {.show = o.show ? o.show : standard};
    picture.page = (draw_page){.tree = tree, .options = &o, .alloc = output->alloc, .task = &task};
    /* Margins around a whole scene, and no window thinner than an eighth. */
    double lo[FROE_MAX_DIM] = {0}, hi[FROE_MAX_DIM] = {0};
    picture.whole = o.style == FROE_DRAW_EXPLODED;
    for (int k = 0; k < dim; k++)
        if (!(o.lo[k] < o.hi[k])) picture.whole = true; /* there is no window */
    if (picture.whole) froe_scene_bounds(froe_tree_scene(tree), lo, hi);
    const int up = dim == 3 && o.up < 0 ? froe_scene_up(froe_tree_scene(tree)) : o.up;
    const double *from = picture.whole ? lo : o.lo, *to = picture.whole ? hi : o.hi;
    picture.space = draw_space_over(dim, up, from, to);
    picture.space.squeeze = draw_map_squeeze(froe_tree_scene(tree), from[1], to[1]);
    const bool inked = picture.show & (FROE_DRAW_OBJECTS | FROE_DRAW_FRAGMENTS) && o.style != FROE_DRAW_EXPLODED;
    picture.page.faint = inked ? 0.5 : 0;
    for (int k = 0; k < 3; k++)
        picture.wide[k] = picture.whole ? fmax(picture.space.reach[k] + 0.025, 0.125) : picture.space.reach[k];
    if (o.marks_outside) *o.marks_outside = count_outside(&picture, &o);
    status = paint_page(&picture, format, output, diag);
    draw_picture_free(&picture);
    if (status == FROE_OK && o.progress && !support_callback(o.progress(o.user, 1)))
        return support_fail_cancelled(diag);
    return status;
}

froe_status froe_draw_write(const froe_tree *tree, froe_draw_format format, froe_write_fn *fn, void *user,
                            const froe_draw_options *options, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!tree || !fn) return support_fail_null(diag, __func__);
    if ((unsigned)format >= FROE_DRAW_FORMAT_COUNT)
        return support_fail(diag, FROE_E_OPTIONS, "There is no format %d.", (int)format);
    draw_output output;
    froe_status status = make(tree, format, options, &output, diag);
    if (status == FROE_OK && !support_callback(fn(user, output.bytes.data, output.bytes.count)))
        status = support_fail(diag, FROE_E_IO, "The receiver of the picture refused it.");
    draw_output_free(&output);
    return status;
}

froe_status froe_draw(const froe_tree *tree, const char *path, const froe_draw_options *options,
                      froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    froe_draw_format format;
    if (!tree || !path) return support_fail_null(diag, __func__);
    if (!froe_draw_format_of(path, &format))
        return support_fail_ending(diag, FROE_E_OPTIONS, path, "pictures", ".svg, .pdf or .png");
    draw_output output;
    froe_status status = make(tree, format, options, &output, diag);
    if (status == FROE_OK) status = support_write(path, output.bytes.data, output.bytes.count, &output.alloc, diag);
    draw_output_free(&output);
    return status;
}
