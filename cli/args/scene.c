/* scene.c: options and errors of reading a scene. */
#include "args/scene.h"
#include "args/crash.h"
#include "args/spool.h"
#include "exit.h"
#include "library.h"
#include "progress.h"
#include "support/fail.h"
#include "support/path.h"
#include <froe/shards.h>
#include <stdio.h>

static const char *const faces[] = {[FROE_FACES_TRIANGLES] = "triangles", [FROE_FACES_POLYGONS] = "polygons", NULL};

const cli_option cli_scene_options[] = {
    {NULL, 0, CLI_TEXT, offsetof(cli_scene_args, path), "SCENE", .help = "map, model or CSV file", .required = true,
     .file = CLI_READ},
    {"input-format", 0, CLI_TEXT, offsetof(cli_scene_args, format), "EXT",
     .help = "of SCENE from standard input (-) or a pipe: the usual extension of its files, e.g. geojson",
     .alias = "format"},
    {"layer", 0, CLI_TEXT, offsetof(cli_scene_args, layer), "NAME",
     .help = "maps: read this layer only (default: all; of a folder, an archive or a GeoPackage the only one)"},
    {"where", 0, CLI_TEXT, offsetof(cli_scene_args, where), "FILTER",
     .help = "maps: read features that pass this filter, as in SQL, e.g. \"height > 3\""},
    {"faces", 0, CLI_CHOICE, offsetof(cli_scene_args, faces), "KIND",
     .help = "models: triangles (default), or polygons: exactly planar, convex faces stay whole", .choices = faces},
    {"boxes", 0, CLI_FLAG, offsetof(cli_scene_args, boxes),
     .help = "take the bounding box of every feature instead of its shape"},
    {"wrap", 0, CLI_FLAG, offsetof(cli_scene_args, wrap),
     .help = "maps in degrees: cut borders that cross the antimeridian at 180 and -180"},
    {0},
};

void cli_warn_scene(const cli_common *common, const char *path, const froe_scene *scene) {
    uint32_t first;
    const size_t features = common->quiet ? 0 : froe_scene_across(scene, &first);
    if (!features) return;
    const froe_object object = froe_scene_object(scene, first);
    const char *name = object.group == FROE_NONE ? "" : froe_scene_group(scene, object.group).name;
    char number[32];
    snprintf(number, sizeof number, "%llu", (unsigned long long)object.tag);
    (void)cli_fail(
        0, path,
        "warning: Edges of %zu feature%s, first of '%.60s', cross the antimeridian, and run around the whole "
        "Earth instead. Reading the map with --wrap cuts them there.",
        features, features > 1 ? "s" : "", *name ? name : number);
}

static const char *is_or_are(uint64_t count) {
    return count == 1 ? "is" : "are";
}

/* What was read otherwise than the file means it; `flat`: it is a map, not a model in space. */
static void warn(const cli_common *common, const char *name, const froe_read_report *r, bool flat) {
    if (common->quiet) return;
    if (r->no_degrees)
        (void)cli_fail(0, name,
                       "warning: Coordinates of a %s are degrees, and these cannot be any: the coordinate system is "
                       "unknown. A member \"crs\" of the file that is null says that, too.",
                       r->format);
    if (r->flattened)
        (void)cli_fail(0, name,
                       "warning: The heights (z) of %llu feature%s are left out, because maps are flat. Models in "
                       "space come in other formats, such as OBJ, glTF and STL.",
                       (unsigned long long)r->flattened, support_plural(r->flattened));
    if (r->no_geometry)
        (void)cli_fail(0, name, "warning: Left out %s %llu feature%s without a geometry.", is_or_are(r->no_geometry),
                       (unsigned long long)r->no_geometry, support_plural(r->no_geometry));
    if (*r->sorts_left)
        (void)cli_fail(0, name, "warning: Left out is everything of these sorts, which are not read: %s.",
                       r->sorts_left);
    if (r->skipped && flat)
        (void)cli_fail(0, name, "warning: Left out %s %llu %s of one point, or of a sort that is not read.",
                       is_or_are(r->skipped), (unsigned long long)r->skipped,
                       r->skipped == 1 ? "geometry that is empty, a line" : "geometries that are empty, lines");
    if (r->skipped && !flat)
        (void)cli_fail(0, name, "warning: Left out %s %llu %s of too few corners, or of a sort that is not read.",
                       is_or_are(r->skipped), (unsigned long long)r->skipped,
                       r->skipped == 1 ? "face, line or curve" : "faces, lines or curves");
    if (r->unread)
        (void)cli_fail(0, name,
                       "warning: Of %llu texture%s %llu %s missing or unreadable, first of all '%s'. Their faces have "
                       "the colours of their materials.",
                       (unsigned long long)r->textures, support_plural(r->textures), (unsigned long long)r->unread,
                       is_or_are(r->unread), r->unread_name);
    if (*r->unread_library)
        (void)cli_fail(
            0, name, "warning: The library of materials '%s' is missing or unreadable. Its materials have no colours.",
            r->unread_library);
}

/* By the core, where it reads the file, otherwise by GDAL or assimp. */
static int read_spooled(const cli_spool *spool, const froe_read_options *options, froe_scene **scene,
                        froe_read_report *report) {
    cli_io io = {0};
    froe_diagnostic diag;
    froe_status status = froe_read_own(spool->path, options, scene, report, &diag);
    const bool textured = !status && report->textures; /* images are read by GDAL */
    const bool left = status == FROE_E_UNSUPPORTED || (status == FROE_E_IO && support_path_is_beyond(spool->path));
    cli_progress_end(options->user);
    const int missing = textured || left ? cli_open_io(&io) : 0;
    if (missing && left && !froe_reads_own(spool->path)) return missing;
    if (io.read) {
        if (textured) froe_scene_free(*scene);
        cli_crash_begin(spool);
        status = io.read(spool->path, options, scene, report, &diag);
        cli_crash_end();
        cli_progress_end(options->user);
    }
    return status ? cli_fail_status(CLI_READING, spool->name, status, &diag) : 0;
}

int cli_read_scene(const cli_common *common, const cli_scene_args *args, froe_scene **scene, froe_read_report *report) {
    cli_spool spool;
    if (froe_is_shards(args->path))
        return cli_fail(CLI_USE, args->path,
                        "It is a folder of shards, which check, range, locate, ray, near and pairs take.");
    int code = cli_spool_open(args->path, args->format, &spool);
    if (code) return code;
    cli_progress bar = cli_progress_begin(common, "reading");
    froe_read_options options = froe_read_defaults();
    options.name = spool.name;
    options.layer = args->layer;
    options.where = args->where;
    if (args->faces >= 0) options.faces = (froe_faces)args->faces;
    options.boxes = args->boxes;
    options.wrap = args->wrap;
    options.alloc = args->alloc;
    options.progress = cli_progress_step;
    options.user = &bar;
    code = read_spooled(&spool, &options, scene, report);
    if (!code) warn(common, spool.name, report, froe_scene_dim(*scene) == 2);
    if (!code && !args->wrap) cli_warn_scene(common, spool.name, *scene);
    cli_spool_free(&spool);
    return code;
}
