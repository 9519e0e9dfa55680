/* build_shards.c: see build_shards.h. A CSV is read in batches, in one pass; other files are read as a scene first. */
#include "shards/build_shards.h"
#include "args/spool.h"
#include "exit.h"
#include "progress.h"
#include "report/report.h"
#include "support/fail.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>

const cli_option cli_shards_options[] = {
    {"shards", 0, CLI_TEXT, offsetof(cli_shards_args, shards), "N",
     .help = "save a folder of N trees (auto: as many as --memory calls for), each of a part of space, for queries"},
    {"memory", 0, CLI_TEXT, offsetof(cli_shards_args, memory), "SIZE",
     .help = "of --shards: what building may take, about, as 500M or 16G (default 4G)"},
    {0},
};

/* A whole number of decimal digits. *end: what follows it. */
static bool read_whole_number(const char *text, char **end, uint64_t *out) {
    errno = 0;
    const unsigned long long number = strtoull(text, end, 10);
    *out = (uint64_t)number;
    return !errno && *text >= '0' && *text <= '9'; /* no sign and no blank */
}

/* A whole number with K, M, G or T behind it. */
static bool read_size(const char *text, uint64_t *out) {
    static const char letters[] = "KMGT";
    char *end;
    uint64_t number;
    if (!read_whole_number(text, &end, &number)) return false;
    const char *letter = *end ? strchr(letters, *end) : NULL;
    const int shift = letter ? 10 * (int)(letter - letters + 1) : 0;
    if ((*end && (!letter || end[1])) || number > UINT64_MAX >> shift) return false;
    *out = number << shift;
    return true;
}

static int read_numbers(const cli_shards_args *args, froe_shards_options *o) {
    uint64_t shards = 0;
    char *end;
    const bool automatic = !strcmp(args->shards, "auto");
    if (!automatic && (!read_whole_number(args->shards, &end, &shards) || *end || !shards || shards > FROE_SHARDS_MOST))
        return cli_fail(CLI_USE, NULL, "--shards: '%s' is neither auto nor a number from 1 to %d.", args->shards,
                        FROE_SHARDS_MOST);
    o->shards = (uint32_t)shards;
    if (args->memory && (!read_size(args->memory, &o->memory) || !o->memory))
        return cli_fail(CLI_USE, NULL, "--memory: '%s' is no size, as 500M or 4G.", args->memory);
    return 0;
}

/* A folder on its way from a file. */
typedef struct making {
    const char *path;
    const froe_shards_options *options;
    froe_shards_builder *builder; /* begun with the first batch, which tells the dimension */
    bool failed;                  /* what was read could not be written */
    cli_progress bar;
    double from, share; /* of the bar */
} making;

static bool advance_bar(void *user, double done) {
    making *m = user;
    return cli_progress_step(&m->bar, m->from + m->share * done);
}

static froe_status add_batch_of_file(void *user, int dim, const froe_objects *batch, froe_diagnostic *diag) {
    making *m = user;
    froe_status status = m->builder ? FROE_OK : froe_shards_begin(m->path, dim, m->options, &m->builder, diag);
    if (!status) status = froe_shards_add(m->builder, batch, diag);
    m->failed = status == FROE_E_IO || !m->builder;
    return status;
}

/* Reads the objects of a CSV into the folder. *read false: the file has to be read as a scene. */
static int stream(const cli_scene_args *scene, const char *path, const char *name, making *m, bool *read) {
    froe_read_options o = froe_read_defaults();
    froe_diagnostic diag;
    o.name = name;
    o.boxes = scene->boxes;
    o.progress = advance_bar;
    o.user = m;
    const bool own = !scene->layer && !scene->where && !scene->wrap;
    const froe_status status =
        own ? froe_read_batches(path, &o, add_batch_of_file, m, NULL, &diag) : FROE_E_UNSUPPORTED;
    *read = status != FROE_E_UNSUPPORTED;
    if (m->failed) return cli_fail_status(CLI_WRITING, m->path, status, &diag);
    return status && *read ? cli_fail_status(CLI_READING, name, status, &diag) : 0;
}

static int read_whole(const cli_common *common, const cli_scene_args *args, making *m, froe_scene **scene) {
    froe_read_report reader;
    froe_diagnostic diag;
    const int code = cli_read_scene(common, args, scene, &reader);
    if (code) return code;
    froe_status status = froe_shards_begin(m->path, froe_scene_dim(*scene), m->options, &m->builder, &diag);
    if (!status) status = froe_shards_add_scene(m->builder, *scene, &diag);
    return status ? cli_fail_status(CLI_WRITING, m->path, status, &diag) : 0;
}

static int report_shards(const cli_common *common, const char *scene, const char *folder, const froe_shards_report *r,
                         double seconds) {
    char headline[400];
    snprintf(headline, sizeof headline, "%.200s: %llu object%s in %u shard%s, the largest of %llu, in %.3g s", scene,
             (unsigned long long)r->objects, support_plural(r->objects), r->shards, support_plural(r->shards),
             (unsigned long long)r->most, seconds);
    return cli_report(common, headline,
                      json_pack("{s:o, s:o, s:I, s:I, s:I, s:I, s:I, s:f}", "scene", cli_name_json(scene), "folder",
                                cli_name_json(folder), "shards", (json_int_t)r->shards, "objects",
                                (json_int_t)r->objects, "copies", (json_int_t)r->copies, "most", (json_int_t)r->most,
                                "bytes", (json_int_t)r->bytes, "seconds", seconds));
}

int cli_build_shards(const cli_common *common, const cli_scene_args *scene, const cli_shards_args *args,
                     const cli_output *output, froe_shards_options options) {
    if (!output->name || output->path != output->name)
        return cli_fail(CLI_USE, NULL, "--shards: It needs -o with the name of a folder.");
    int code = read_numbers(args, &options);
    if (code) return code;
    const double start = cli_seconds();
    cli_spool spool;
    froe_scene *whole = NULL;
    froe_shards_report report = {0};
    froe_diagnostic diag;
    making m = {.path = output->path, .options = &options, .share = 0.3};
    options.progress = advance_bar;
    options.user = &m;
    code = cli_spool_open(scene->path, scene->format, &spool);
    if (code) return code;
    bool read = false;
    cli_scene_args file = *scene;
    file.path = spool.path;
    file.format = NULL;
    m.bar = cli_progress_begin(common, "building");
    code = stream(scene, spool.path, spool.name, &m, &read);
    if (!code && !read) code = read_whole(common, &file, &m, &whole);
    m.from = m.share;
    m.share = 1 - m.from;
    if (code) {
        froe_shards_abandon(m.builder);
    } else {
        const froe_status status = froe_shards_finish(m.builder, &report, &diag);
        cli_progress_end(&m.bar);
        if (status) code = cli_fail_status(CLI_WRITING, output->path, status, &diag);
    }
    froe_scene_free(whole);
    cli_spool_free(&spool);
    return code ? code : report_shards(common, scene->path, output->name, &report, cli_seconds() - start);
}
