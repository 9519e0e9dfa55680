/* measure.c: froe measure, what a scene is like: clutter, density, fatness, directional density. */
#include "args/budget.h"
#include "args/scene.h"
#include "command.h"
#include "commands/measure_picture.h"
#include "exit.h"
#include "files.h"
#include "progress.h"
#include "report/report.h"
#include <froe/measure.h>

typedef struct measure_args {
    cli_common common;
    cli_scene_args scene;
    const char *cube, *ball; /* pictures of them */
    uint64_t samples, max_fragments;
    cli_reals deltas;
    int counting;
} measure_args;

static const char *const countings[] = {[FROE_COUNT_SEARCH] = "search", [FROE_COUNT_TREES] = "trees", NULL};
static const cli_option options[] = {
    {"draw", 0, CLI_TEXT, offsetof(measure_args, cube), "FILE", .file = CLI_WRITTEN,
     .help = "draw the worst cube among the objects around it (.svg, .pdf, .png)"},
    {"draw-ball", 0, CLI_TEXT, offsetof(measure_args, ball), "FILE", .file = CLI_WRITTEN,
     .help = "draw the densest ball, of radius density"},
    CLI_BUDGET_OPTION(measure_args, max_fragments),
    {"samples", 0, CLI_WHOLE, offsetof(measure_args, samples), "N",
     .help = "objects, or cubes, looked at by each measure; 0: all objects", .max = UINT32_MAX},
    {"delta", 0, CLI_REALS, offsetof(measure_args, deltas), "D,...",
     .help = "room beside boxes, in sides, for directional density (default 0.25,0.5,1)"},
    {"counting", 0, CLI_CHOICE, offsetof(measure_args, counting), "HOW",
     .help = "for directional density: search (default), or range trees, which do not mind large counts; the numbers "
             "are the same",
     .choices = countings},
    {0},
};

static const cli_part parts[] = {
    {"Scene", cli_scene_options, offsetof(measure_args, scene)},
    {"Measure", options, 0},
    {"Options", cli_common_options, 0},
    {0},
};

/** What all measures of a run share. */
typedef struct survey {
    const measure_args *args;
    froe_scene *scene;
    froe_measure_options options;
    cli_progress bar;
    double started;
    froe_diagnostic diag;
} survey;

static json_t *spread_json(const froe_spread *s) {
    return json_pack("{s:I, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f}", "count", (json_int_t)s->count, "least", s->least,
                     "5 %", s->q05, "25 %", s->q25, "median", s->median, "75 %", s->q75, "95 %", s->q95, "most",
                     s->most, "mean", s->mean);
}

static void begin(survey *s, const char *what) {
    s->bar = cli_progress_begin(&s->args->common, what);
    s->options.progress = cli_progress_step;
    s->options.user = &s->bar;
    s->started = cli_seconds();
}

/** Ends a measure; its seconds go into `out`. */
static int end(survey *s, froe_status status, json_t *out) {
    cli_progress_end(&s->bar);
    if (!status) json_object_set_new(out, "seconds", json_real(cli_seconds() - s->started));
    return status ? cli_fail_status(CLI_WORKING, s->args->scene.path, status, &s->diag) : 0;
}

static int measure_clutter(survey *s, json_t *report) {
    const size_t dim = (size_t)froe_scene_dim(s->scene);
    froe_clutter c = {.lower = 0};
    begin(s, "growing cubes");
    const froe_status status = froe_measure_clutter(s->scene, &s->options, &c, &s->diag);
    json_t *out = json_pack("{s:I, s:o, s:o}", "at least", (json_int_t)c.lower, "cube lo", cli_reals_json(c.lo, dim),
                            "cube hi", cli_reals_json(c.hi, dim));
    json_object_set_new(json_object_get(report, "distributions"), "clutter of cubes", spread_json(&c.load));
    json_object_set_new(report, "clutter factor", out);
    const int code = end(s, status, out);
    return code || !s->args->cube
               ? code
               : measure_draw_cube(&s->args->common, s->args->cube, s->scene, &c, s->args->max_fragments);
}

static int measure_density(survey *s, froe_size size, json_t *report) {
    static const char *const names[][2] = {{"density (radius)", "load within 3 radii"},
                                           {"density (diameter)", "load within 3 half diameters"}};
    const size_t dim = (size_t)froe_scene_dim(s->scene);
    froe_density d = {.lower = 0};
    begin(s, "looking around objects");
    const froe_status status = froe_measure_density(s->scene, size, &s->options, &d, &s->diag);
    json_t *out = json_pack("{s:I, s:I, s:b, s:o, s:f}", "at least", (json_int_t)d.lower, "at most",
                            (json_int_t)d.upper, "of all objects", d.count == froe_scene_object_count(s->scene),
                            "ball centre", cli_reals_json(d.centre, dim), "ball radius", d.radius);
    json_object_set_new(json_object_get(report, "distributions"), names[size][1], spread_json(&d.load));
    json_object_set_new(report, names[size][0], out);
    const int code = end(s, status, out);
    if (code || size != FROE_SIZE_RADIUS || !s->args->ball) return code;
    return measure_draw_ball(&s->args->common, s->args->ball, s->scene, &d, s->args->max_fragments);
}

static int measure_fatness(survey *s, json_t *report) {
    json_t *spreads = json_object_get(report, "distributions");
    froe_fatness f = {.thin = 0};
    begin(s, "comparing with balls");
    const froe_status status = froe_measure_fatness(s->scene, &s->options, &f, &s->diag);
    json_t *out = json_pack("{s:I}", "without volume", (json_int_t)f.thin);
    if (f.full.count) json_object_set_new(spreads, "fatness", spread_json(&f.full));
    if (f.flat.count) json_object_set_new(spreads, "fatness in the plane", spread_json(&f.flat));
    if (f.sliver.count) json_object_set_new(spreads, "width / longest edge", spread_json(&f.sliver));
    json_object_set_new(report, "fatness", out);
    return end(s, status, out);
}

static int measure_directional(survey *s, json_t *report) {
    static const cli_reals usual = {3, {0.25, 0.5, 1}};
    const cli_reals *deltas = s->args->deltas.count ? &s->args->deltas : &usual;
    json_t *rows = json_array(), *seconds = json_object();
    int code = 0;
    for (size_t i = 0; i < deltas->count && !code; i++) {
        froe_directional d = {.delta = 0};
        begin(s, "looking across faces");
        code = end(s, froe_measure_directional(s->scene, deltas->at[i], &s->options, &d, &s->diag), seconds);
        if (code) continue;
        json_array_append_new(rows,
                              json_pack("{s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f, s:f}", "delta", d.delta,
                                        "simple 95 %", d.simple.q95, "simple most", d.simple.most, "extended 95 %",
                                        d.extended.q95, "extended most", d.extended.most, "two-directional 95 %",
                                        d.two_directional.q95, "two-directional most", d.two_directional.most,
                                        "paired 95 %", d.paired.q95, "paired most", d.paired.most));
    }
    json_decref(seconds);
    json_object_set_new(report, "directional density", rows);
    return code;
}

static int run_measure(const void *given) {
    const measure_args *args = given;
    froe_scene *scene;
    froe_read_report reader;
    const char *const pictures[] = {args->cube, args->ball};
    int code = measure_check_pictures(pictures, 2);
    if (!code) code = cli_read_scene(&args->common, &args->scene, &scene, &reader);
    if (code) return code;
    if (args->cube || args->ball) code = measure_check_dimension(args->scene.path, scene);
    if (code) {
        froe_scene_free(scene);
        return code;
    }
    survey s = {.args = args, .scene = scene, .options = froe_measure_defaults()};
    s.options.samples = (uint32_t)args->samples;
    s.options.seed = args->common.seed;
    s.options.counting = (froe_counting)args->counting;
    json_t *report = json_pack("{s:o, s:I, s:I, s:I, s:{}}", "file", cli_name_json(args->scene.path), "objects",
                               (json_int_t)froe_scene_object_count(scene), "samples", (json_int_t)args->samples, "seed",
                               (json_int_t)args->common.seed, "distributions");
    code = measure_clutter(&s, report);
    if (!code) code = measure_density(&s, FROE_SIZE_RADIUS, report);
    if (!code) code = measure_density(&s, FROE_SIZE_DIAMETER, report);
    if (!code) code = measure_fatness(&s, report);
    if (!code) code = measure_directional(&s, report);
    json_t *spreads = json_incref(json_object_get(report, "distributions"));
    json_object_del(report, "distributions"); /* tables come last */
    json_object_set_new(report, "distributions", spreads);
    if (code)
        json_decref(report);
    else
        code = cli_report(&args->common, NULL, report);
    froe_scene_free(scene);
    return code;
}

const cli_command cli_command_measure = {
    .name = "measure",
    .summary = "tell how crowded a scene is: clutter, density, fatness and directional density",
    .about = CLI_SCENE_ABOUT
    "\n\nWhat methods promise depends on such properties. The clutter factor is the most objects that meet a cube "
    "without "
    "a corner of a bounding box inside; a cube that shows its lower bound is printed. Density is the most objects, of "
    "at "
    "least the size of a ball, that meet the ball; size is the radius of the smallest enclosing ball, or half the "
    "diameter. Fatness is volume over "
    "that of the smallest enclosing ball. Directional density counts, for the bounding boxes of objects, boxes that "
    "cross "
    "the plane of a face near it: simple, extended, two-directional, and for the best pair of faces alone.\n\nBounds "
    "are certified. "
    "Scenes of more objects than --samples are looked at in a random sample: then upper bounds are those of the "
    "sample.",
    .examples = "froe measure floor.geojson\nfroe measure house.glb --boxes --delta 0.5 --json\n",
    .parts = parts,
    .defaults = &(const measure_args){.common = CLI_COMMON_DEFAULTS, .samples = 20000, .max_fragments = CLI_BUDGET_OWN},
    .size = sizeof(measure_args),
    .run = run_measure,
};
