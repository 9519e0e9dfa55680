/* info.c: froe info, what is in a scene and what is odd about it. */
#include "args/scene.h"
#include "command.h"
#include "exit.h"
#include "progress.h"
#include "report/report.h"
#include <inttypes.h>

typedef struct info_args {
    cli_common common;
    cli_scene_args scene;
} info_args;

static const cli_part parts[] = {
    {"Scene", cli_scene_options, offsetof(info_args, scene)},
    {"Options", cli_common_options, 0},
    {0},
};

static json_t *kinds_json(const froe_scene *scene) {
    json_t *kinds = json_object();
    for (int kind = 0; kind < FROE_KIND_COUNT; kind++) {
        const size_t count = froe_scene_kind_count(scene, (froe_kind)kind);
        if (count) json_object_set_new(kinds, froe_kind_name((froe_kind)kind), json_integer((json_int_t)count));
    }
    return kinds;
}

static json_t *bounds_json(const froe_scene *scene) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    if (!froe_scene_bounds(scene, lo, hi)) return json_object();
    const size_t dim = (size_t)froe_scene_dim(scene);
    return json_pack("{s:o, s:o}", "lo", cli_reals_json(lo, dim), "hi", cli_reals_json(hi, dim));
}

static json_t *pair_json(const uint32_t pair[2]) {
    if (pair[0] == FROE_NONE) return json_null();
    return json_pack("[I, I]", (json_int_t)pair[0], (json_int_t)pair[1]);
}

static json_t *defects_json(const froe_defects *d) {
    return json_pack("{s:I, s:I, s:I, s:I, s:I, s:I, s:o, s:o, s:o}", "zero_length", (json_int_t)d->zero_length,
                     "zero_area", (json_int_t)d->zero_area, "duplicates", (json_int_t)d->duplicates, "crossings",
                     (json_int_t)d->crossings, "t_junctions", (json_int_t)d->t_junctions, "overlaps",
                     (json_int_t)d->overlaps, "first_crossing", pair_json(d->first_crossing), "first_t_junction",
                     pair_json(d->first_t_junction), "first_overlap", pair_json(d->first_overlap));
}

static json_t *reader_json(const froe_read_report *r) {
    return json_pack("{s:s, s:s, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:f}", "format", r->format, "precision",
                     r->precision, "layers", (json_int_t)r->layers, "features", (json_int_t)r->features, "linearised",
                     (json_int_t)r->linearised, "flattened", (json_int_t)r->flattened, "triangulated",
                     (json_int_t)r->triangulated, "closed", (json_int_t)r->closed, "skipped", (json_int_t)r->skipped,
                     "no_geometry", (json_int_t)r->no_geometry, "seconds", r->seconds);
}

static json_t *info_json(const char *path, const froe_scene *scene, const froe_read_report *reader,
                         const froe_defects *defects) {
    return json_pack("{s:o, s:i, s:I, s:o, s:I, s:I, s:o, s:o, s:o}", "file", cli_name_json(path), "dim",
                     froe_scene_dim(scene), "objects", (json_int_t)froe_scene_object_count(scene), "kinds",
                     kinds_json(scene), "vertices", (json_int_t)froe_scene_vertex_count(scene), "groups",
                     (json_int_t)froe_scene_group_count(scene), "bounds", bounds_json(scene), "defects",
                     defects_json(defects), "reader", reader_json(reader));
}

static int find_defects(const info_args *args, const froe_scene *scene, froe_defects *defects) {
    cli_progress bar = cli_progress_begin(&args->common, "examining");
    froe_diagnostic diag;
    const froe_status status =
        froe_scene_defects(scene, (unsigned)args->common.threads, cli_progress_step, &bar, defects, &diag);
    cli_progress_end(&bar);
    return status ? cli_fail_status(CLI_WORKING, args->scene.path, status, &diag) : 0;
}

static int run_info(const void *given) {
    const info_args *args = given;
    froe_scene *scene;
    froe_read_report reader;
    int code = cli_read_scene(&args->common, &args->scene, &scene, &reader);
    if (code) return code;
    froe_defects defects = {.size = sizeof defects};
    code = find_defects(args, scene, &defects);
    if (!code) code = cli_report(&args->common, NULL, info_json(args->scene.path, scene, &reader, &defects));
    froe_scene_free(scene);
    return code;
}

const cli_command cli_command_info = {
    .name = "info",
    .summary = "counts, bounds and defects of a scene",
    .about = CLI_SCENE_ABOUT
    "\n\nDefects stop nothing: every builder takes scenes that have them. They are counted exactly, pairs once: "
    "objects "
    "without length or area, duplicates, crossings, T-junctions (a corner of one inside the other) and overlaps, each "
    "with one example. The reader tells how it read: in which precision, and what it had to change.",
    .examples = "froe info floor.geojson\nfroe info house.glb --faces polygons --json\n",
    .parts = parts,
    .defaults = &(const info_args){.common = CLI_COMMON_DEFAULTS},
    .size = sizeof(info_args),
    .run = run_info,
};
