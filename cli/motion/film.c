/* film.c: see film.h. */
#include "motion/film.h"
#include "commands/render_writer.h"
#include "exit.h"
#include "motion/bodies.h"
#include "progress.h"
#include "report/report.h"
#include "support/path.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

bool cli_is_moving(const render_args *args) {
    const bool stream = !strcmp(args->tree.scene.path, "-") && !args->tree.scene.format; /* of a known kind: MF-JSON */
    return args->frames || (!args->turntable && (args->exact || (args->animate && stream))) || !isnan(args->at) ||
           !isnan(args->moving.from) || !isnan(args->moving.to) || !isnan(args->moving.deviation) ||
           args->moving.animation || args->moving.poses ||
           !strcmp(support_path_extension(args->tree.scene.path).text, "mfjson") ||
           (args->tree.scene.format && !strcmp(args->tree.scene.format, "mfjson"));
}

typedef struct film_run {
    const render_args *args;
    froe_motion *motion;
    froe_motion *replaced; /* exact films: without its bodies; NULL: it has none */
    double reached;        /* how far its corners are off at most */
    froe_motion_report read;
    froe_render_options *options;
    froe_render_report last;
    froe_film_report film;
} film_run;

/* The picture of one instant, from a tree of its own. */
static froe_status draw_instant(film_run *r, double time, render_fn *write, const char *path, froe_diagnostic *diag) {
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_build_options o = froe_build_defaults();
    o.purpose = "draw", o.seed = r->args->common.seed, o.threads = (unsigned)r->args->common.threads;
    froe_status status = froe_motion_scene(r->motion, time, NULL, &scene, diag);
    if (!status) status = froe_build(scene, &o, &tree, diag);
    if (!status) status = write(tree, path, r->options, &r->last, diag);
    froe_tree_free(tree), froe_scene_free(scene);
    return status;
}

static froe_status draw_frames(film_run *r, size_t frames, render_fn *write, froe_diagnostic *diag) {
    const froe_motion_options window = froe_motion_window(r->motion);
    froe_camera *cameras = calloc(frames, sizeof *cameras);
    if (!cameras) return FROE_E_MEMORY;
    froe_status status =
        froe_film_cameras(r->motion, &r->options->camera, r->args->turntable > 0, frames, cameras, diag);
    for (size_t i = 0; i < frames && !status; i++) {
        const double share = (double)i / (double)frames, time = window.begin * (1 - share) + window.end * share;
        char *path = render_frame_name(r->args->output.path, i);
        r->options->camera = cameras[i];
        status = path ? draw_instant(r, time, write, path, diag) : FROE_E_MEMORY;
        free(path);
    }
    free(cameras);
    return status;
}

static froe_status draw_one(film_run *r, render_fn *write, froe_diagnostic *diag) {
    froe_camera camera;
    const froe_status status = froe_film_cameras(r->motion, &r->options->camera, false, 1, &camera, diag);
    if (status) return status;
    r->options->camera = camera;
    return draw_instant(r, r->args->at, write, r->args->output.path, diag);
}

static json_t *report_film(const film_run *r) {
    json_t *all = json_pack("{s:o, s:o}", "model", cli_name_json(r->args->tree.scene.path), "output",
                            cli_name_json(r->args->output.name));
    cli_report_moving(&r->read, all);
    if (r->replaced) json_object_set_new(all, "bodies_deviation", json_real(r->reached));
    if (!r->args->animate) return all;
    json_object_set_new(all, "pictures", json_integer((json_int_t)r->film.pictures));
    json_object_set_new(all, "shown", json_integer((json_int_t)r->film.shown));
    json_object_set_new(all, "changes", json_integer((json_int_t)r->film.changes));
    json_object_set_new(all, "late", json_real(r->film.late));
    json_object_set_new(all, "paths", json_integer((json_int_t)r->film.paths));
    json_object_set_new(all, "bytes", json_integer((json_int_t)r->film.bytes));
    return all;
}

static int check_film(const render_args *args) {
    const bool many = args->frames || args->turntable;
    if (args->tree.method || args->tree.save || args->section.count)
        return cli_fail(CLI_USE, NULL,
                        "--method, --save-tree, --section: A model that moves or is filmed has trees of its own.");
    if (!isnan(args->at) && (many || args->animate))
        return cli_fail(CLI_USE, NULL, "--at: It is one picture, and excludes --frames, --turntable and --animate.");
    if (args->exact && !args->animate) return cli_fail(CLI_USE, NULL, "--exact: It is for --animate.");
    if (isnan(args->at) && !args->animate && !many)
        return cli_fail(CLI_USE, args->tree.scene.path, "A moving model needs --at, --frames or --animate.");
    if (args->frames && args->turntable && args->frames != args->turntable)
        return cli_fail(CLI_USE, NULL, "--frames: There is one picture for each place of the turntable.");
    if (many && !args->animate && !render_names_frames(args->output.path))
        return cli_fail(CLI_USE, NULL, "--frames: '%s' is not like pic-%%03d.svg.", args->output.name);
    return 0;
}

/* Exact films follow corners that fly straight, along parabolas unless the eye is a point that goes around, and along
 * cubics if the eye is parallel and stands still. */
static int prepare_exactly(film_run *r) {
    const char *path = r->args->tree.scene.path;
    const int code = cli_replace_bodies(path, r->motion, r->args->moving.deviation, &r->replaced, &r->reached);
    const froe_motion *motion = r->replaced ? r->replaced : r->motion;
    const bool parallel = r->options->camera.parallel, turns = r->args->turntable;
    for (uint32_t v = 0; v < froe_motion_vertex_count(motion) && !code; v++)
        for (size_t i = 0; i < froe_motion_knot_count(motion, v); i++) {
            const froe_moving_knot knot = froe_motion_knot(motion, v, i);
            if (!isnan(knot.second[0]) && (turns || !parallel))
                return cli_fail(CLI_USE, path,
                                "--exact: What flies along cubics is followed in parallel alone, by an eye that rests. "
                                "Add --parallel, without --turntable.");
            if (!isnan(knot.control[0]) && turns && !parallel)
                return cli_fail(CLI_USE, path,
                                "--exact: From an eye that goes around, what turns, or flies along parabolas, is "
                                "followed in parallel alone. Add --parallel.");
        }
    return code;
}

/* A call may fail because of the file that it writes, of the options, or else of the motion. */
static int fail_to_draw(const render_args *args, froe_status status, const froe_diagnostic *diag) {
    if (status == FROE_E_IO || status == FROE_E_OPTIONS) return cli_output_fail(&args->output, status, diag);
    return cli_fail_status(CLI_WORKING, args->tree.scene.path, status, diag);
}

static int draw(film_run *r) {
    const render_args *args = r->args;
    froe_diagnostic diag = {.message = "Out of memory."};
    render_fn *write = froe_render;
    int code = args->animate ? 0 : render_find_writer(args->output.path, &write);
    if (!code && args->exact) code = prepare_exactly(r);
    if (code) return code;
    cli_progress bar = cli_progress_begin(&args->common, "looking");
    r->options->progress = cli_progress_step, r->options->user = &bar;
    froe_film_options film = froe_film_defaults();
    const uint64_t frames = args->turntable ? args->turntable : args->frames ? args->frames : film.frames;
    film.frames = (uint32_t)frames, film.turn = args->turntable > 0, film.exact = args->exact;
    if (!isnan(args->seconds)) film.seconds = args->seconds;
    const froe_status status = !isnan(args->at) ? draw_one(r, write, &diag)
                               : args->animate  ? froe_film(r->replaced ? r->replaced : r->motion, args->output.path,
                                                           r->options, &film, &r->film, &diag)
                                                : draw_frames(r, (size_t)frames, write, &diag);
    cli_progress_end(&bar);
    if (status) return fail_to_draw(args, status, &diag);
    if (args->animate && !r->film.paths)
        (void)cli_fail(0, args->output.name, "note: Nothing is drawn in any of the pictures.");
    return cli_report(&args->common, NULL, report_film(r));
}

/* What was read, from its groups to the picture; frees the motion. */
static int render_motion(film_run *r) {
    const render_args *args = r->args;
    const char *path = args->tree.scene.path;
    froe_diagnostic diag;
    froe_scene *scene = NULL;
    render_prepared prepared = {.values = NULL};
    int code = 0;
    const froe_motion_options window = froe_motion_window(r->motion);
    if (window.dim != 3)
        code = cli_fail(CLI_USE, path, "A motion in the plane has no hidden surfaces. froe simulate shows it.");
    if (!code) code = cli_check_at(args->at, r->motion);
    const froe_status status = code ? FROE_OK : froe_motion_scene(r->motion, window.begin, NULL, &scene, &diag);
    if (status) code = cli_fail_status(CLI_WORKING, path, status, &diag);
    if (!code && froe_scene_set_up(scene, r->read.up)) code = cli_fail_memory();
    if (!code) code = render_prepare(args, scene, &prepared);
    r->options = &prepared.options;
    if (!code) code = draw(r);
    render_release(&prepared);
    froe_scene_free(scene);
    froe_motion_free(r->replaced), froe_motion_free(r->motion);
    return code;
}

int cli_render_moving(const render_args *args) {
    film_run r = {.args = args};
    cli_moving_args moving = args->moving;
    moving.path = args->tree.scene.path, moving.format = args->tree.scene.format;
    int code = check_film(args);
    if (!code) code = cli_read_moving(&args->common, &moving, args->exact, &r.motion, &r.read);
    return code ? code : render_motion(&r);
}

int cli_render_around(const render_args *args, const froe_scene *scene) {
    film_run r = {.args = args, .read.up = froe_scene_up(scene)};
    froe_diagnostic diag;
    const int code = check_film(args);
    if (code) return code;
    const froe_status status = froe_motion_at_rest(scene, 0, 1, NULL, &r.motion, &diag);
    return status ? cli_fail_status(CLI_WORKING, args->tree.scene.path, status, &diag) : render_motion(&r);
}
