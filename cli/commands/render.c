/* render.c: froe render, hidden surfaces removed, exactly. */
#include "command.h"
#include "commands/render_options.h"
#include "commands/render_writer.h"
#include "exit.h"
#include "files.h"
#include "motion/film.h"
#include "progress.h"
#include "report/report.h"
#include "support/fail.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const directions[] = {"corner", "iso", "front",  "back",     "left",
                                         "right",  "top", "bottom", "dimetric", NULL};
static const char *const seams[] = {"underlap", "none", "twice", "stroke", NULL};
static const char *const hiddens[] = {"none", "dashed", NULL};
static const char *const over[] = {"top", "interleaved", NULL};
static const char *const colours[] = {"file", "own", NULL};
static const char *const ids[] = {"none", "object", "face", NULL};
static const char *const layers[] = {"none", "object", "kind", NULL};
static const char *const axes[] = {"x", "y", "z", NULL};
static const char *const paints[] = {"whole", "regions", "fragments", NULL};
static const char *const presets[] = {"illustration", "technical", "plotter", "web", "print", NULL};

static const cli_option what[] = {
    CLI_OUTPUT_OPTIONS(render_args, "FILE", ".svg, .pdf, .eps or .png; lines alone as .dxf, .csv or .geojson",
                       .required = true),
    {"preset", 0, CLI_CHOICE, offsetof(render_args, preset), "NAME",
     .help =
         "what the other options begin with: illustration (default), technical (parallel, lines, hidden ones dashed), "
         "plotter (visible regions that do not overlap), web (short files), print (millimetres)",
     .choices = presets},
    {"size", 0, CLI_TEXT, offsetof(render_args, size), "WxH",
     .help = "of the page: 1000x1000 (default), or in millimetres, 160x120mm"},
    {"margin", 0, CLI_REAL, offsetof(render_args, margin), "M",
     .help = "around the picture (default 1/50 of the width)"},
    {"background", 0, CLI_TEXT, offsetof(render_args, background), "RRGGBB",
     .help = "colour of the page, or clear for none (default: white in PNG, clear in other files)"},
    {0},
};

static const cli_option camera[] = {
    {"view", 0, CLI_CHOICE, offsetof(render_args, direction), "FROM",
     .help = "corner (default), or in parallel projection iso, dimetric, front, back, left, right, top or bottom",
     .choices = directions},
    {"up", 0, CLI_CHOICE, offsetof(render_args, up_axis), "AXIS",
     .help = "the axis that points up: x, y or z (default: as the file says; y in glTF)", .choices = axes},
    {"eye", 0, CLI_REALS, offsetof(render_args, eye), "X,Y,Z",
     .help = "look from here, at the middle of the scene or the target; nothing is fitted"},
    {"target", 0, CLI_REALS, offsetof(render_args, target), "X,Y,Z", .help = "with --eye: look at this point"},
    {"parallel", 0, CLI_FLAG, offsetof(render_args, parallel), .help = "parallel instead of perspective projection"},
    {"fov", 0, CLI_REAL, offsetof(render_args, fov), "DEGREES",
     .help = "perspective: vertical angle of view within the margin (default 35)"},
    {"scale", 0, CLI_TEXT, offsetof(render_args, scale), "S",
     .help = "parallel: units of the page per unit of the scene; or true to scale on a page in millimetres, 1:50 "
             "(default: as fits)"},
    {"unit", 0, CLI_REAL, offsetof(render_args, unit), "METRES",
     .help = "for --scale 1:50: how long a unit of the scene is (default 1)"},
    {"section", 0, CLI_REALS, offsetof(render_args, section), "A,B,C,D",
     .help = "leave out what lies where a x + b y + c z > d, exactly; builds the tree anew for it"},
    {"turntable", 0, CLI_WHOLE, offsetof(render_args, turntable), "N",
     .help = "N pictures from all around; the name of the file says where their number goes, pic-%03d.svg", .min = 1,
     .max = 100000},
    {"animate", 0, CLI_FLAG, offsetof(render_args, animate),
     .help = "all pictures, of the turntable or of a moving model, in one SVG that moves"},
    {"seconds", 0, CLI_REAL, offsetof(render_args, seconds), "S", .help = "with --animate: of a round (default 8)"},
    {0},
};

static const cli_option motion[] = {
    {"at", 0, CLI_REAL, offsetof(render_args, at), "T", .help = "a moving model as it is at the time T"},
    {"frames", 0, CLI_WHOLE, offsetof(render_args, frames), "N",
     .help = "N pictures of a moving model, as those of a turntable; with --animate one SVG that plays (default 200)",
     .min = 1, .max = 100000},
    {"exact", 0, CLI_FLAG, offsetof(render_args, exact),
     .help = "with --animate: miss no face that comes into sight, however short; slow. What turns is followed within "
             "--deviation, and with --turntable it needs --parallel"},
    {0},
};

static const cli_option faces[] = {
    {"style", 0, CLI_TEXT, offsetof(render_args, shading), "STYLE",
     .help = "flat (default), cel, cel:N with N steps, plain, white, or none (lines only)"},
    {"colours", 0, CLI_CHOICE, offsetof(render_args, colours), "FROM",
     .help = "file (default): colours and opacity of the materials where the scene has them; or own: froe's, opaque",
     .choices = colours},
    {"paint", 0, CLI_CHOICE, offsetof(render_args, paint), "SHAPES",
     .help = "whole faces (default), visible regions, or fragments of the tree", .choices = paints},
    {"seams", 0, CLI_CHOICE, offsetof(render_args, seams), "HOW",
     .help =
         "against background that shines through between faces: underlap (default; they go under later neighbours), "
         "twice (all is painted twice), stroke (in their own colour), none",
     .choices = seams},
    {"seam-width", 0, CLI_REAL, offsetof(render_args, seam_width), "U", .help = "of underlap and strokes (default 1)"},
    {"min-area", 0, CLI_REAL, offsetof(render_args, min_area), "A",
     .help = "leave out faces of which less is visible, in square units of the page (default 0)"},
    {"opacity", 0, CLI_TEXT, offsetof(render_args, opacity), "NAME=A,...", .help = "of a material or group, 0 to 1"},
    {"priority", 0, CLI_TEXT, offsetof(render_args, priority), "NAME=K,...",
     .help = "of faces that overlap in one plane the one with the higher K is seen (default 0, then the later)"},
    {"cull-back", 0, CLI_FLAG, offsetof(render_args, cull_back), .help = "leave out faces seen from behind"},
    {0},
};

static const cli_option line_options[] = {
    {"lines", 0, CLI_CHOICE, offsetof(render_args, over), "WHERE",
     .help = "top (default): over all faces; interleaved: under what is nearer", .choices = over},
    {"line-kinds", 0, CLI_TEXT, offsetof(render_args, lines), "KINDS",
     .help = "border, silhouette, object, material, crease, crossing, section, mesh, and of the scene itself wire "
             "(segments) and point, parted by commas; or none (default: all but mesh)"},
    {"line-width", 0, CLI_REAL, offsetof(render_args, line_width), "W",
     .help = "of borders, silhouettes and segments, by which other kinds go (default 1)"},
    {"line-style", 0, CLI_WORDS, offsetof(render_args, line_style), "LINES=STYLE,...",
     .help = "width, colour and dash by kind: crease=0.6, hidden=0.4:888888:4:2 (width, RRGGBB, dash, gap); LINES are "
             "a kind, hidden-KIND, visible or hidden, and later ones count"},
    {"point-width", 0, CLI_REAL, offsetof(render_args, point_width), "W",
     .help = "of the discs that points are (default 3)"},
    {"crease", 0, CLI_REAL, offsetof(render_args, crease), "DEGREES",
     .help = "angle that makes an edge a line (default 30)"},
    {"halo", 0, CLI_REAL, offsetof(render_args, halo), "G", .help = "gap in lines before nearer lines (default 0)"},
    {"hidden", 0, CLI_CHOICE, offsetof(render_args, hidden), "HOW", .help = "hidden lines: none (default) or dashed",
     .choices = hiddens},
    {0},
};

static const cli_option file[] = {
    {"decimals", 0, CLI_WHOLE, offsetof(render_args, decimals), "N",
     .help = "SVG, and lines alone: digits after the point (default 2)", .max = 6},
    {"ids", 0, CLI_CHOICE, offsetof(render_args, ids), "WHAT",
     .help = "what shapes and lines tell of their origin: none (default), object (its group; default in .csv and "
             ".geojson) or face (a path each, and its number as well)",
     .choices = ids},
    {"layers", 0, CLI_CHOICE, offsetof(render_args, layers), "WHAT",
     .help = "SVG: layers for Inkscape: none (default), kind (faces, visible and hidden lines of each kind) or object "
             "(its faces, its visible and its hidden lines)",
     .choices = layers},
    {"title", 0, CLI_TEXT, offsetof(render_args, title), "TEXT", .help = "SVG, PDF: title of the picture"},
    {"desc", 0, CLI_TEXT, offsetof(render_args, description), "TEXT", .help = "SVG, PDF: description of the picture"},
    {"pixels", 0, CLI_REAL, offsetof(render_args, pixels), "S", .help = "PNG: pixels per unit of the page (default 1)"},
    {0},
};

static const cli_part parts[] = {CLI_TREE_PART(render_args),
                                 {"Picture", what, 0},
                                 {"Camera", camera, 0},
                                 {"Motion", motion, 0},
                                 {"Reading the motion", cli_moving_options, offsetof(render_args, moving)},
                                 {"Faces", faces, 0},
                                 {"Lines", line_options, 0},
                                 {"File", file, 0},
                                 CLI_TREE_BUILD_PARTS(render_args),
                                 {"Options", cli_common_options, 0},
                                 {0}};

/* --------------------------------------------------------------------- rendering -- */

static json_t *report_json(const render_args *args, const froe_render_report *r) {
    const froe_picture_report *p = &r->picture;
    const froe_visibility_report *v = &p->visibility;
    /* What the picture does not show, and why: faces, then objects that are none, then what is too small for the file.
     */
    json_t *not_drawn = json_pack(
        "{s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I}", "hidden_faces", (json_int_t)v->hidden, "edge_on_faces",
        (json_int_t)v->edge_on, "culled_faces", (json_int_t)v->culled, "cut_away_faces", (json_int_t)v->cut_away,
        "flat_polygons", (json_int_t)v->flat, "segments", (json_int_t)v->segments, "points", (json_int_t)v->points,
        "thin_shapes", (json_int_t)r->thin_shapes, "short_lines", (json_int_t)r->short_strokes);
    return json_pack("{s:o, s:o, s:s, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:f, s:o}", "tree",
                     cli_name_json(args->tree.scene.path), "output", cli_name_json(args->output.name), "paint",
                     froe_paint_name(p->paint), "fragments", (json_int_t)v->pieces, "visible_fragments",
                     (json_int_t)v->visible_pieces, "visible_faces", (json_int_t)v->visible_patches, "arcs",
                     (json_int_t)p->arcs, "late_faces", (json_int_t)p->late, "shapes", (json_int_t)r->shapes, "lines",
                     (json_int_t)(r->strokes - r->dots), "points", (json_int_t)r->dots, "paths", (json_int_t)r->paths,
                     "bytes", (json_int_t)r->bytes, "exact_calls", (json_int_t)v->predicates.exact, "left_out_faces",
                     (json_int_t)p->left_out, "left_out_area", p->left_out_area, "not_drawn", not_drawn);
}

static void warn(const render_args *args, const froe_render_options *o, const froe_render_report *r) {
    if (r->view.up_axis >= 0 && !args->common.quiet)
        (void)cli_fail(0, args->output.name, "note: Up lies along the line of view, and axis %s points up instead.",
                       axes[r->view.up_axis]);
    if (r->picture.paint != o->paint && o->shading != FROE_SHADE_NONE)
        (void)cli_fail(0, args->output.name,
                       "note: An order of whole faces takes too many comparisons, and fragments were painted.");
    if (r->shapes || r->strokes) return;
    const froe_visibility_report *v = &r->picture.visibility;
    const bool unasked = v->visible_patches || (!o->lines && (v->segments || v->points));
    (void)cli_fail(0, args->output.name,
                   r->thin_shapes || r->short_strokes
                       ? "note: What is visible is too small for the coordinates of the file."
                   : unasked ? "note: Nothing is drawn with this --style, --line-kinds and --min-area."
                             : "note: Nothing is visible from here.");
}

static froe_status render_turning(const render_args *args, render_fn *write, const froe_tree *tree,
                                  froe_render_options *o, froe_render_report *report, froe_diagnostic *diag) {
    froe_camera *cameras = calloc(args->turntable, sizeof *cameras);
    if (!cameras) return support_fail_memory(diag);
    const double seconds = isnan(args->seconds) ? 8 : args->seconds;
    froe_status status = froe_camera_turn(&o->camera, froe_tree_scene(tree), args->turntable, cameras, diag);
    if (!status && args->animate)
        status = froe_render_animation(tree, args->output.path, o, cameras, args->turntable, seconds, report, diag);
    for (size_t i = 0; !status && !args->animate && i < args->turntable; i++) {
        char *path = render_frame_name(args->output.path, i);
        o->camera = cameras[i];
        status = path ? write(tree, path, o, report, diag) : support_fail_memory(diag);
        free(path);
    }
    free(cameras);
    return status;
}

/* Is there something that a camera can look at? That is a question of the scene; of other failures, which come again,
 * options or the output are told. */
static int check_view(const render_args *args, const froe_scene *scene, const froe_render_options *o) {
    froe_diagnostic diag;
    froe_projection view;
    const froe_status status = froe_camera_place(&o->camera, scene, &view, &diag);
    if (status != FROE_E_INPUT && status != FROE_E_UNSUPPORTED) return 0;
    return cli_fail_status(CLI_WORKING, args->tree.scene.path, status, &diag);
}

static int render(const render_args *args, const froe_tree *tree, froe_render_options *o) {
    froe_diagnostic diag;
    froe_render_report report;
    if (args->animate && !args->turntable)
        return cli_fail(CLI_USE, NULL,
                        "--animate: It needs --turntable, or of a moving model --frames or --animation.");
    if (args->turntable && (args->eye.count || args->target.count))
        return cli_fail(CLI_USE, NULL,
                        "--turntable: It goes around the middle of the scene, and excludes --eye and --target.");
    if (args->turntable && !args->animate && !render_names_frames(args->output.path))
        return cli_fail(CLI_USE, NULL, "--turntable: '%s' is not like pic-%%03d.svg.", args->output.name);
    render_fn *write = froe_render;
    int code = render_find_writer(args->output.path, &write);
    if (!code) code = check_view(args, froe_tree_scene(tree), o);
    if (code) return code;
    cli_progress bar = cli_progress_begin(&args->common, "looking");
    o->progress = cli_progress_step;
    o->user = &bar;
    const froe_status status = args->turntable ? render_turning(args, write, tree, o, &report, &diag)
                                               : write(tree, args->output.path, o, &report, &diag);
    cli_progress_end(&bar);
    if (status) return cli_output_fail(&args->output, status, &diag);
    warn(args, o, &report);
    return cli_report(&args->common, NULL, report_json(args, &report));
}

/* The tree once more, cut by the section first. */
static int cut_section(const render_args *args, froe_tree **tree) {
    froe_build_options o = froe_build_defaults();
    froe_diagnostic diag;
    froe_tree *whole = *tree;
    if (!args->section.count) return 0;
    if (args->section.count != 4) return cli_fail_count("section", args->section.count, 4);
    cli_progress bar = cli_progress_begin(&args->common, "cutting");
    o.threads = (unsigned)args->common.threads;
    o.max_fragments = cli_budget(args->tree.max_fragments, froe_tree_scene(whole));
    o.progress = cli_progress_step;
    o.user = &bar;
    const froe_status status = froe_tree_section(whole, args->section.at, &o, tree, &diag);
    cli_progress_end(&bar);
    if (status == FROE_E_ARG || status == FROE_E_UNSUPPORTED)
        return cli_fail(CLI_USE, NULL, "--section: %s", diag.message);
    if (status)
        return cli_fail_build(args->tree.scene.path, args->tree.max_fragments, froe_tree_scene(whole), status, &diag);
    froe_tree_free(whole);
    return 0;
}

/* Has the scene hidden surfaces, or what they can hide, and nothing else? */
static int check_scene(const render_args *args, const froe_scene *scene) {
    const char *path = args->tree.scene.path;
    const int dim = froe_scene_dim(scene);
    if (dim == 2) return cli_fail(CLI_USE, path, "A scene in the plane has no hidden surfaces. froe draw draws it.");
    if (dim > 3)
        return cli_fail(
            CLI_USE, path,
            "froe render draws scenes in 3 dimensions, not in %d. froe export writes their parts as a table.", dim);
    for (uint32_t i = 0; i < froe_scene_object_count(scene); i++) {
        const froe_kind kind = froe_scene_object(scene, i).kind;
        if (kind > FROE_POLYGON)
            return cli_fail(CLI_USE, path,
                            "object %u: It is a %s, and froe render draws polygons, segments and points. froe draw "
                            "draws it.",
                            i, froe_kind_name(kind));
    }
    return 0;
}

static int run_render(const void *given) {
    const render_args *args = given;
    froe_tree *tree;
    if (cli_is_moving(args)) return cli_render_moving(args);
    int code = cli_open_tree(&args->common, &args->tree, "draw", &tree);
    if (code) return code;
    code = check_scene(args, froe_tree_scene(tree));
    if (!code) code = cut_section(args, &tree);
    const froe_scene *scene = froe_tree_scene(tree);
    if (code) {
        froe_tree_free(tree);
        return code;
    }
    if (args->exact) {
        code = cli_render_around(args, scene);
    } else {
        render_prepared prepared;
        code = render_prepare(args, scene, &prepared);
        if (!code) code = render(args, tree, &prepared.options);
        render_release(&prepared);
    }
    froe_tree_free(tree);
    return code;
}

const cli_command cli_command_render = {
    .name = "render",
    .summary = "draw a model without what is hidden, as SVG, PDF, EPS or PNG",
    .about = "Finds, exactly, which parts of all faces and edges are visible, and paints whole faces in an order that "
             "shows just these: few shapes, no cracks, nothing sorted by distance. Faces that intersect are cut. The "
             "same tree and options give the same bytes.",
    .examples = "froe render house.glb -o house.svg\n"
                "froe render house.glb -o front.pdf --preset technical --view front --size 160x120mm\n"
                "froe render house.glb -o turn.svg --turntable 36 --animate\n"
                "froe render robot.glb -o wave.svg --animation wave --animate\n"
                "froe render house.glb -o glass.svg --opacity 'Glass=0.3'\n"
                "froe render house.glb -o room.svg --eye 4,1.6,-3 --target 8,1.2,-6 --fov 70\n",
    .parts = parts,
    .defaults = &(const render_args){.common = CLI_COMMON_DEFAULTS,
                                     .tree = CLI_TREE_DEFAULTS,
                                     .moving = CLI_MOVING_DEFAULTS,
                                     .at = NAN,
                                     .direction = -1,
                                     .up_axis = -1,
                                     .hidden = -1,
                                     .ids = -1,
                                     .halo = NAN,
                                     .fov = NAN,
                                     .unit = NAN,
                                     .min_area = NAN,
                                     .seconds = NAN,
                                     .margin = NAN,
                                     .seam_width = NAN,
                                     .line_width = NAN,
                                     .point_width = NAN,
                                     .crease = NAN,
                                     .pixels = NAN,
                                     .decimals = UINT64_MAX},

    .size = sizeof(render_args),
    .run = run_render,
};
