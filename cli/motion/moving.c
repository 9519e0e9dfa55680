/* moving.c: see moving.h. */
#include "motion/moving.h"
#include "args/crash.h"
#include "args/scene.h"
#include "args/spool.h"
#include "exit.h"
#include "library.h"
#include "motion/bodies.h"
#include "progress.h"
#include "support/path.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

const cli_option cli_moving_options[] = {
    {"poses", 0, CLI_TEXT, offsetof(cli_moving_args, poses), "FILE", .file = CLI_READ,
     .help = "the parts of the model move as a table says: body,time,x,y,z,qx,qy,qz,qw, in the plane without z, qx "
             "and qy (.csv)"},
    {"animation", 0, CLI_TEXT, offsetof(cli_moving_args, animation), "NAME",
     .help = "of a model: the animation of this name, or of this number from 0 (default: the only one)"},
    {"deviation", 0, CLI_REAL, offsetof(cli_moving_args, deviation), "D",
     .help = "of an animation: how far anything may be from where the file's own interpolation has it, and of bodies "
             "in a partition, as a share of the model's size (default 0.001)"},
    {"from", 0, CLI_REAL, offsetof(cli_moving_args, from), "T",
     .help = "begin here (default: the file's first instant)"},
    {"to", 0, CLI_REAL, offsetof(cli_moving_args, to), "T", .help = "end here (default: the file's last instant)"},
    {0},
};

/* Is it JSON of another kind than glTF? So it is where nothing is known of a file. */
static bool holds_features(const char *path) {
    static const char *const endings[] = {"mfjson", "json", "geojson"};
    const support_extension extension = support_path_extension(path);
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (!strcmp(extension.text, endings[i])) return true;
    FILE *file = strcmp(extension.text, "gltf") != 0 ? fopen(path, "rb") : NULL;
    int c = file ? fgetc(file) : 0;
    while (c > 0 && strchr(" \t\r\n\xEF\xBB\xBF", c)) c = fgetc(file); /* a byte order mark, too */
    if (file) fclose(file);
    return c == '{' || c == '[' || (c == EOF && !*extension.text);
}

static int read_posed(const cli_common *common, const cli_moving_args *args, const froe_motion_read_options *o,
                      froe_motion **motion, froe_motion_report *report) {
    froe_diagnostic diag;
    froe_scene *model = NULL;
    froe_read_report read;
    const cli_scene_args scene = {.path = args->path, .format = args->format, .faces = FROE_FACES_TRIANGLES};
    if (!strcmp(args->path, "-") && !args->format)
        return cli_fail(CLI_USE, NULL, "With --poses, MOVING is the file of a model, and not standard input.");
    const int code = cli_read_scene(common, &scene, &model, &read);
    if (code) return code;
    const char *path = strcmp(args->poses, "-") ? args->poses : "/dev/stdin";
    const froe_status status = froe_read_poses(path, model, o, motion, report, &diag);
    froe_scene_free(model);
    return status ? cli_fail_status(CLI_READING, NULL, status, &diag) : 0;
}

static int read_animated(const cli_common *common, const cli_spool *spool, froe_motion_read_options *o,
                         froe_motion **motion, froe_motion_report *report) {
    froe_diagnostic diag;
    cli_io io;
    const int code = cli_open_io(&io);
    if (code) return code;
    cli_progress bar = cli_progress_begin(common, "reading");
    o->name = spool->name;
    cli_crash_begin(spool);
    const froe_status status = io.read_animation(spool->path, o, motion, report, &diag);
    cli_crash_end();
    cli_progress_end(&bar);
    return status ? cli_fail_status(CLI_READING, NULL, status, &diag) : 0;
}

/* By what its content is; *animated: a model as its animation says. */
static int read_any(const cli_common *common, const cli_moving_args *args, froe_motion_read_options *o,
                    froe_motion **motion, froe_motion_report *report, bool *animated) {
    froe_diagnostic diag;
    if (args->poses) return read_posed(common, args, o, motion, report);
    const bool stream = !strcmp(args->path, "-") && !args->format;
    const char *features = stream ? "/dev/stdin" : args->path;
    cli_spool spool = {.path = features};
    int code = stream ? 0 : cli_spool_open(args->path, args->format, &spool);
    if (code) return code;
    *animated = !stream && !holds_features(spool.path);
    if (*animated) {
        code = read_animated(common, &spool, o, motion, report);
    } else {
        const froe_status status = froe_read_motion(spool.path, o, motion, report, &diag);
        code = status ? cli_fail_status(CLI_READING, NULL, status, &diag) : 0;
    }
    if (!stream) cli_spool_free(&spool);
    return code;
}

int cli_read_moving(const cli_common *common, const cli_moving_args *args, bool followed, froe_motion **motion,
                    froe_motion_report *report) {
    bool animated = false;
    froe_motion_read_options o = froe_motion_read_defaults();
    o.from = args->from, o.to = args->to, o.animation = args->animation;
    if (!isnan(args->deviation)) o.deviation = args->deviation;
    if (!isnan(args->from) && !isnan(args->to) && !(args->from < args->to))
        return cli_fail(CLI_USE, NULL, "--from: '%.15g' is not before --to, '%.15g'.", args->from, args->to);
    if (!(o.deviation > 0)) return cli_fail(CLI_USE, NULL, "--deviation: '%g' is not a number above 0.", o.deviation);
    int code = read_any(common, args, &o, motion, report, &animated);
    if (code) return code;
    const cli_need needs[] = {
        {"animation", args->animation, animated, "It is one of a model, and nothing else has any."},
        {"deviation", !isnan(args->deviation), animated || (followed && cli_has_turning_bodies(*motion)),
         "It is about animations of models, and about bodies in a partition of space."},
    };
    code = cli_check_needs(needs, sizeof needs / sizeof *needs);
    if (code) froe_motion_free(*motion);
    return code;
}

int cli_check_at(double at, const froe_motion *motion) {
    const froe_motion_options window = froe_motion_window(motion);
    if (isnan(at) || (at >= window.begin && at <= window.end)) return 0;
    return cli_fail(CLI_USE, NULL, "--at: '%.15g' is not from %.15g to %.15g.", at, window.begin, window.end);
}

void cli_report_moving(const froe_motion_report *report, json_t *object) {
    if (!(report->extent > 0)) return;
    json_object_set_new(object, "jumps", json_integer((json_int_t)report->jumps));
    json_object_set_new(object, "deviation", json_real(report->deviation));
    json_object_set_new(object, "extent", json_real(report->extent));
}
