/* info.c: froe info, what is in a scene and what is odd about it. */
#include "args/tree.h"
#include "command.h"
#include "exit.h"
#include "progress.h"
#include "report/tree_report.h"
#include <froe/measure.h>
#include <inttypes.h>

typedef struct info_args {
    cli_common common;
    cli_tree_args tree;
} info_args;

static const cli_part parts[] = {
    CLI_TREE_PART(info_args),
    {"Reading the scene", cli_scene_options + 1, offsetof(info_args, tree.scene)},
    {"Options", cli_common_options, 0},
    {0},
};

static json_t *pair_json(const uint32_t pair[2]) {
    if (pair[0] == FROE_NONE) return json_null();
    return json_pack("[I, I]", (json_int_t)pair[0], (json_int_t)pair[1]);
}

static json_t *crs_json(const froe_scene *scene, bool whole) {
    static const char *const kinds[FROE_CRS_KIND_COUNT] = {"unknown", "geographic", "projected", "other"};
    const froe_crs crs = froe_scene_crs(scene);
    json_t *out = json_pack("{s:s}", "kind", kinds[crs.kind]);
    if (!out || !crs.kind) return out;
    json_object_set_new(out, "name", cli_name_json(crs.name));
    json_object_set_new(out, "code", cli_name_json(crs.code));
    json_object_set_new(out, "unit", cli_name_json(crs.unit));
    if (whole) json_object_set_new(out, "wkt", cli_name_json(crs.wkt));
    if (crs.kind == FROE_CRS_GEOGRAPHIC)
        json_object_set_new(out, "across_180", json_integer((json_int_t)froe_scene_across(scene, NULL)));
    return out;
}

/* Of the largest coordinate: sixteen units in its last place. */
#define NEAR 0x1p-48

static json_t *near_json(const froe_near *n) {
    return json_pack("{s:f, s:I, s:I, s:o, s:o}", "within", n->within, "coplanar", (json_int_t)n->coplanar, "poking",
                     (json_int_t)n->poking, "first_coplanar", pair_json(n->first_coplanar), "first_poking",
                     pair_json(n->first_poking));
}

static json_t *reader_json(const froe_read_report *r) {
    json_t *left = r->layers_left ? json_integer((json_int_t)r->layers_left) : NULL;
    return json_pack("{s:s, s:s, s:I, s:o*, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:s*, s:I, s:f}", "format", r->format,
                     "precision", r->precision, "layers", (json_int_t)r->layers, "layers_left", left, "features",
                     (json_int_t)r->features, "linearised", (json_int_t)r->linearised, "flattened",
                     (json_int_t)r->flattened, "triangulated", (json_int_t)r->triangulated, "closed",
                     (json_int_t)r->closed, "skipped", (json_int_t)r->skipped, "no_geometry",
                     (json_int_t)r->no_geometry, "sorts_left", *r->sorts_left ? r->sorts_left : NULL, "wrapped",
                     (json_int_t)r->wrapped, "seconds", r->seconds);
}

/* Takes `more`: how the scene was read, or the tree that it was saved with. */
static json_t *info_json(const info_args *args, const froe_scene *scene, const froe_defects *d, const froe_near *near,
                         const char *where, json_t *more) {
    json_t *kinds = json_object();
    for (int kind = 0; kind < FROE_KIND_COUNT; kind++) {
        const size_t count = froe_scene_kind_count(scene, (froe_kind)kind);
        if (count) json_object_set_new(kinds, froe_kind_name((froe_kind)kind), json_integer((json_int_t)count));
    }
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    const size_t dim = (size_t)froe_scene_dim(scene);
    json_t *bounds = froe_scene_bounds(scene, lo, hi)
                         ? json_pack("{s:o, s:o}", "lo", cli_reals_json(lo, dim), "hi", cli_reals_json(hi, dim))
                         : json_object();
    json_t *defects =
        json_pack("{s:I, s:I, s:I, s:I, s:I, s:I, s:o, s:o, s:o}", "zero_length", (json_int_t)d->zero_length,
                  "zero_area", (json_int_t)d->zero_area, "duplicates", (json_int_t)d->duplicates, "crossings",
                  (json_int_t)d->crossings, "t_junctions", (json_int_t)d->t_junctions, "overlaps",
                  (json_int_t)d->overlaps, "first_crossing", pair_json(d->first_crossing), "first_t_junction",
                  pair_json(d->first_t_junction), "first_overlap", pair_json(d->first_overlap));
    static const char *const axes[] = {"x", "y", "z"};
    json_t *up = dim == 3 ? json_string(axes[froe_scene_up(scene)]) : NULL;
    json_t *crs = dim == 2 ? crs_json(scene, args->common.json) : NULL;
    return json_pack("{s:o, s:i, s:o*, s:I, s:o, s:I, s:I, s:o, s:o*, s:o, s:o, s:o}", "file",
                     cli_name_json(args->tree.scene.path), "dim", froe_scene_dim(scene), "up", up, "objects",
                     (json_int_t)froe_scene_object_count(scene), "kinds", kinds, "vertices",
                     (json_int_t)froe_scene_vertex_count(scene), "groups", (json_int_t)froe_scene_group_count(scene),
                     "bounds", bounds, "crs", crs, "defects", defects, "near_misses", near_json(near), where, more);
}

static int run_info(const void *given) {
    const info_args *args = given;
    const char *path = args->tree.scene.path;
    const bool saved = cli_is_saved_tree(path);
    froe_scene *read = NULL;
    froe_tree *tree = NULL;
    froe_read_report reader;
    int code = saved ? cli_open_saved_tree(&args->common, &args->tree, &tree)
                     : cli_read_scene(&args->common, &args->tree.scene, &read, &reader);
    if (code) return code;
    const froe_scene *scene = saved ? froe_tree_scene(tree) : read;
    const unsigned threads = (unsigned)args->common.threads;
    froe_defects defects = {.size = sizeof defects};
    froe_near near;
    froe_diagnostic diag;
    cli_progress bar = cli_progress_begin(&args->common, "examining");
    froe_status status = froe_scene_defects(scene, threads, cli_progress_step, &bar, &defects, &diag);
    if (!status) status = froe_measure_near(scene, NEAR, threads, cli_progress_step, &bar, &near, &diag);
    cli_progress_end(&bar);
    if (status) {
        code = cli_fail_status(CLI_WORKING, path, status, &diag);
    } else {
        json_t *more = saved ? cli_tree_json(tree) : reader_json(&reader);
        code =
            cli_report(&args->common, NULL, info_json(args, scene, &defects, &near, saved ? "tree" : "reader", more));
    }
    froe_tree_free(tree);
    froe_scene_free(read);
    return code;
}

const cli_command cli_command_info = {
    .name = "info",
    .summary = "tell what a scene contains: counts, bounds and defects",
    .about = CLI_SCENE_ABOUT
    " Of a tree that froe build saved, its scene is examined, and its report printed."
    "\n\nDefects stop nothing: every builder takes scenes that have them. They are counted exactly, pairs once: "
    "objects "
    "without length or area, duplicates, crossings, T-junctions (a corner of one inside the other) and overlaps, each "
    "with one example. Near misses are what was rounded before it was read: faces with a common edge that lie in one "
    "plane, and objects that end at others, but for sixteen units in the last place of the largest coordinate. There "
    "no tree is as small as for the scene that was meant. The reader tells how it read: in which precision, and what "
    "it had to change.",
    .examples = "froe info floor.geojson\nfroe info house.glb --faces polygons --json\nfroe info house.froe\n",
    .parts = parts,
    .defaults = &(const info_args){.common = CLI_COMMON_DEFAULTS, .tree = CLI_TREE_DEFAULTS},
    .size = sizeof(info_args),
    .run = run_info,
};
