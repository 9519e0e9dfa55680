/* draw.c: froe draw, a partition as a picture. */
#include "args/marks.h"
#include "args/output.h"
#include "args/picture.h"
#include "args/tree.h"
#include "command.h"
#include "exit.h"
#include "files.h"
#include "library.h"
#include "progress.h"
#include "report/report.h"
#include "support/fail.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct draw_args {
    cli_common common;
    cli_tree_args tree;
    cli_output output;
    const char *show, *background, *title, *section, *marks;
    int style, up;
    double width, height, margin, scale, detail, explode; /**< NaN: the library's default */
    uint64_t max_depth, explode_depth;                    /**< UINT64_MAX: the library's default */
    cli_reals window, view;
    bool no_legend;
} draw_args;

static const char *const styles[] = {"auto", "flat", "sections", "exploded", NULL};
static const char *const axes[] = {"x", "y", "z", NULL};

static const cli_option what[] = {
    CLI_OUTPUT_OPTIONS(draw_args, "FILE", ".svg, .pdf or .png", .required = true),
    {"show", 0, CLI_TEXT, offsetof(draw_args, show), "LAYERS",
     .help = "cells, cuts, fragments, objects, parted by commas (default: what suits the style)"},
    {"style", 0, CLI_CHOICE, offsetof(draw_args, style), "STYLE",
     .help = "auto (default), flat (plane), sections or exploded (space)", .choices = styles},
    {"window", 0, CLI_REALS, offsetof(draw_args, window), "LO,HI",
     .help = "draw this box only: lower corner, then upper, in the scene's coordinates"},
    {"marks", 0, CLI_TEXT, offsetof(draw_args, marks), "FILE", .file = CLI_READ,
     .help = "mark the points, segments, boxes or balls of this file, with the names of its features"},
    {"max-depth", 0, CLI_WHOLE, offsetof(draw_args, max_depth), "D",
     .help = "draw cells below this depth as one (0: no limit)", .max = UINT32_MAX},
    {"detail", 0, CLI_REAL, offsetof(draw_args, detail), "SIZE",
     .help = "draw regions smaller than this on the page as one (default: a pixel; 0: everything)"},
    {0},
};

static const cli_option space[] = {
    {"section", 0, CLI_TEXT, offsetof(draw_args, section), "x=VALUE",
     .help = "sections: this one, across x, y or z (default: a sheet of three through the middle)"},
    {"up", 0, CLI_CHOICE, offsetof(draw_args, up), "AXIS",
     .help = "the axis that points up on the page: x, y or z (default: as the file says; y in glTF)", .choices = axes},
    {"view", 0, CLI_REALS, offsetof(draw_args, view), "X,Y,Z", .help = "exploded: direction from the scene to the eye"},
    {"explode", 0, CLI_REAL, offsetof(draw_args, explode), "E",
     .help = "exploded: parts move away from the centre by E times their distance from it (default 0.5)"},
    {"explode-depth", 0, CLI_WHOLE, offsetof(draw_args, explode_depth), "D",
     .help = "exploded: parts are the regions at this depth of the tree (default 4)", .max = 32},
    {0},
};

static const cli_option page[] = {
    {"width", 0, CLI_REAL, offsetof(draw_args, width), "W", .help = "of the page, in points or pixels (default 960)"},
    {"height", 0, CLI_REAL, offsetof(draw_args, height), "H", .help = "of the page (default: as suits the scene)"},
    {"margin", 0, CLI_REAL, offsetof(draw_args, margin), "M", .help = "around everything (default: 1/32 of the width)"},
    {"scale", 0, CLI_REAL, offsetof(draw_args, scale), "S",
     .help = "PNG: pixels per unit, for dense screens (default 1)"},
    {"background", 0, CLI_TEXT, offsetof(draw_args, background), "RRGGBB",
     .help = "colour of the page, or clear for none"},
    {"title", 0, CLI_TEXT, offsetof(draw_args, title), "TEXT", .help = "one line above the picture"},
    {"no-legend", 0, CLI_FLAG, offsetof(draw_args, no_legend), .help = "leave out counts and scales"},
    {0},
};

static const cli_part parts[] = {CLI_TREE_PART(draw_args),
                                 {"Picture", what, 0},
                                 {"Trees in space", space, 0},
                                 {"Page", page, 0},
                                 CLI_TREE_BUILD_PARTS(draw_args),
                                 {"Options", cli_common_options, 0},
                                 {0}};

/* Layers of a list parted by commas. */
static int set_show(const cli_draw *library, const char *list, uint32_t *show) {
    if (!list) return 0;
    do {
        const size_t length = strcspn(list, ",");
        uint32_t found = 0;
        for (uint32_t bit = 1; !found && bit <= FROE_DRAW_OBJECTS; bit <<= 1) {
            const char *known = library->layer_name((froe_draw_layer)bit);
            if (strlen(known) == length && memcmp(known, list, length) == 0) found = bit;
        }
        if (!found)
            return cli_fail(CLI_USE, NULL, "--show: '%.*s' is not one of cells, cuts, fragments, objects.", (int)length,
                            list);
        *show |= found;
        list += length + (list[length] == ',');
    } while (*list);
    return 0;
}

static int set_section(const char *text, size_t dim, froe_draw_options *o) {
    if (!text) return 0;
    const char *axis = strchr("xyz", text[0]);
    char *end = NULL;
    const double at = text[0] && text[1] == '=' ? strtod(text + 2, &end) : 0;
    if (!text[0] || !axis || !end || end == text + 2 || *end || !isfinite(at))
        return cli_fail(CLI_USE, NULL, "--section: '%s' is not like x=1.5.", text);
    if (dim == 2) return cli_fail(CLI_USE, NULL, "--section: A scene in the plane has none.");
    o->axis = (int)(axis - "xyz");
    o->at = at;
    return 0;
}

static int set_options(const draw_args *args, const cli_draw *library, size_t dim, froe_draw_options *o) {
    const cli_reals *window = &args->window, *view = &args->view;
    o->style = (froe_draw_style)args->style;
    o->up = args->up;
    o->title = args->title;
    o->legend = !args->no_legend;
    cli_set_number(args->width, &o->width);
    cli_set_number(args->height, &o->height);
    cli_set_number(args->margin, &o->margin);
    cli_set_number(args->scale, &o->scale);
    cli_set_number(args->detail, &o->detail);
    cli_set_number(args->explode, &o->explode);
    if (args->max_depth != UINT64_MAX) o->max_depth = (uint32_t)args->max_depth;
    if (args->explode_depth != UINT64_MAX) o->explode_depth = (uint32_t)args->explode_depth;
    int code = set_show(library, args->show, &o->show);
    if (!code) code = cli_set_background(args->background, &o->background);
    if (!code) code = set_section(args->section, dim, o);
    if (!code) code = cli_check_text("title", args->title);
    if (code) return code;
    if (window->count && window->count != 2 * dim) return cli_fail_count("window", window->count, 2 * dim);
    for (size_t k = 0; window->count && k < dim; k++) {
        o->lo[k] = window->at[k], o->hi[k] = window->at[dim + k];
        if (!(o->lo[k] < o->hi[k]))
            return cli_fail(CLI_USE, NULL, "--window: Its low corner %g is not below its high corner %g on axis %zu.",
                            o->lo[k], o->hi[k], k);
    }
    if (view->count && view->count != 3) return cli_fail_count("view", view->count, 3);
    if (view->count) memcpy(o->view, view->at, sizeof o->view);
    return 0;
}

/* Options that this picture would not heed. */
static int check_heeded(const draw_args *args, int dim, froe_draw_format format) {
    static const char exploded[] = "It needs --style exploded.";
    const bool apart = args->style == FROE_DRAW_EXPLODED;
    const cli_need needs[] = {
        {"scale", !isnan(args->scale), format == FROE_DRAW_PNG, "Only files of the ending .png have pixels."},
        {"section", args->section != NULL, !apart, "It excludes --style exploded."},
        {"view", args->view.count != 0, apart, exploded},
        {"explode", !isnan(args->explode), apart, exploded},
        {"explode-depth", args->explode_depth != UINT64_MAX, apart, exploded},
        {"up", args->up >= 0, dim == 3, "A scene in the plane has none."},
    };
    return cli_check_needs(needs, sizeof needs / sizeof *needs);
}

/* Towns in degrees on a map in metres are all outside. */
static void note_outside(const draw_args *args, size_t outside, size_t count) {
    if (!outside || args->common.quiet) return;
    (void)cli_fail(0, args->marks, "note: Of %zu mark%s, %zu %s outside of the picture.", count, support_plural(count),
                   outside, outside == 1 ? "is" : "are");
}

static int run_draw(const void *given) {
    const draw_args *args = given;
    froe_draw_format format;
    cli_draw library;
    int code = cli_open_draw(&library);
    if (code) return code;
    if (!library.format_of(args->output.path, &format))
        return cli_fail(CLI_USE, args->output.name, "The ending of pictures is .svg, .pdf or .png.");
    froe_tree *tree;
    code = cli_open_whole_tree(&args->common, &args->tree, NULL, &tree);
    if (code) return code;
    froe_draw_options o;
    library.defaults(&o, sizeof o);
    cli_marks marks;
    const int dim = froe_scene_dim(froe_tree_scene(tree));
    code = cli_marks_read(&args->common, args->marks, dim, &marks);
    size_t outside = 0;
    o.marks = marks.marks, o.mark_count = marks.count, o.marks_outside = &outside;
    if (!code) code = set_options(args, &library, (size_t)dim, &o);
    if (!code) code = check_heeded(args, dim, format);
    if (!code) {
        cli_progress bar = cli_progress_begin(&args->common, "drawing");
        froe_diagnostic diag;
        o.progress = cli_progress_step;
        o.user = &bar;
        const froe_status status = library.draw(tree, args->output.path, &o, &diag);
        cli_progress_end(&bar);
        if (status) code = cli_output_fail(&args->output, status, &diag);
        if (!status) note_outside(args, outside, marks.count);
    }
    if (!code)
        code = cli_report(&args->common, NULL,
                          json_pack("{s:o, s:o}", "tree", cli_name_json(args->tree.scene.path), "output",
                                    cli_name_json(args->output.name)));
    cli_marks_free(&marks);
    froe_tree_free(tree);
    return code;
}

const cli_command cli_command_draw = {
    .name = "draw",
    .summary = "draw the partition as SVG, PDF or PNG",
    .about = "Shows cells coloured by depth (pale near the root), cuts, the fragments into which objects fell, and the "
             "objects; faint cells behind strong objects. Features of maps whose borders are closed are filled. Trees "
             "in the plane are drawn flat; trees in space as plane sections or pulled apart. The same "
             "tree and options give the same bytes.",
    .examples =
        "froe draw floor.geojson -o floor.svg\n"
        "froe draw floor.geojson -o corner.png --method density --window 0,0,512,512 --show cells,fragments --scale 2\n"
        "froe draw house.glb -o house.pdf --style exploded --explode 1\n"
        "froe draw house.glb -o cut.svg --section z=1.2\n"
        "froe draw countries.geojson -o towns.svg --show objects --marks towns.csv\n",
    .parts = parts,
    .defaults = &(const draw_args){.common = CLI_COMMON_DEFAULTS,
                                   .tree = CLI_TREE_DEFAULTS,
                                   .up = -1,
                                   .width = NAN,
                                   .height = NAN,
                                   .margin = NAN,
                                   .scale = NAN,
                                   .detail = NAN,
                                   .explode = NAN,
                                   .max_depth = UINT64_MAX,
                                   .explode_depth = UINT64_MAX},
    .size = sizeof(draw_args),
    .run = run_draw,
};
