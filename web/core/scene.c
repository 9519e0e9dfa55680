/* scene.c: scenes from arrays, and from the bytes of a file */
#include "web.h"
#include <froe/formats.h>
#include <stdlib.h>
#include <string.h>

/* Module.progress is what package/core.js sets. */
EM_JS(void, web_tell, (double done), {
    if (Module.progress) Module.progress(done);
})

bool web_progress(void *user, double done) {
    (void)user;
    web_tell(done);
    return true;
}

static const char *kind_name(int value) {
    return froe_kind_name((froe_kind)value);
}

static const web_member members[] = {
    {"kind", WEB_NAMED, offsetof(froe_objects, kind), kind_name},
    {"count", WEB_INT, offsetof(froe_objects, count), NULL},
    {"coords", WEB_ADDRESS, offsetof(froe_objects, coords), NULL},
    {"pointCount", WEB_INT, offsetof(froe_objects, point_count), NULL},
    {"indices", WEB_ADDRESS, offsetof(froe_objects, indices), NULL},
    {"starts", WEB_ADDRESS, offsetof(froe_objects, starts), NULL},
    {"radii", WEB_ADDRESS, offsetof(froe_objects, radii), NULL},
    {"tags", WEB_ADDRESS, offsetof(froe_objects, tags), NULL},
    {"faces", WEB_ADDRESS, offsetof(froe_objects, faces), NULL},
    {"groups", WEB_ADDRESS, offsetof(froe_objects, groups), NULL},
    {"group", WEB_INT, offsetof(froe_objects, group), NULL},
    {NULL, WEB_INT, 0, NULL},
};

/** A batch to be filled by name; freed by web_free(). NULL: no memory. */
WEB_EXPORT froe_objects *web_objects_new(void) {
    froe_objects *batch = malloc(sizeof *batch);
    if (!batch) return NULL;
    *batch = froe_objects_defaults();
    batch->threads = 1;
    batch->progress = web_progress;
    return batch;
}
WEB_EXPORT froe_status web_objects_number(froe_objects *batch, const char *name, double value, froe_diagnostic *diag) {
    return web_set_number(batch, members, name, value, diag);
}
WEB_EXPORT froe_status web_objects_name(froe_objects *batch, const char *name, const char *value,
                                        froe_diagnostic *diag) {
    return web_set_name(batch, members, name, value, diag);
}
WEB_EXPORT void web_free(void *memory) {
    free(memory);
}

/** Adds a group; colour is 0xRRGGBBAA. */
WEB_EXPORT froe_status web_scene_add_group(froe_scene *scene, const char *name, const char *material, uint32_t colour,
                                           uint32_t *id) {
    const froe_group group = {.name = name, .material = material, .colour = colour};
    return froe_scene_add_group(scene, &group, id);
}
WEB_EXPORT const char *web_scene_group_name(const froe_scene *scene, uint32_t group) {
    return froe_scene_group(scene, group).name;
}
WEB_EXPORT uint32_t web_scene_group_colour(const froe_scene *scene, uint32_t group) {
    return froe_scene_group(scene, group).colour;
}

/** Reads the file `path` of the module's own file system. What was read is told in `format`, of 64 bytes. */
WEB_EXPORT froe_status web_read(const char *path, const char *name, froe_scene **out, char *format,
                                froe_diagnostic *diag) {
    froe_read_options options = froe_read_defaults();
    froe_read_report report;
    options.name = name;
    options.progress = web_progress;
    const froe_status status = froe_read_own(path, &options, out, &report, diag);
    if (status == FROE_OK) memcpy(format, report.format, sizeof report.format);
    return status;
}

WEB_EXPORT froe_status web_generate(const char *kind, uint32_t n, uint32_t seed, froe_scene **out,
                                    froe_diagnostic *diag) {
    return froe_generate(kind, n, seed, NULL, out, diag);
}
