/* read.c: froe_read_own: which of the readers that need no library reads a file? */
#include "formats/input/csv_header.h"
#include "formats/read/readers.h"
#include "support/fail.h"
#include "support/floats.h"
#include <string.h>

void froe_read_defaults_into(froe_read_options *out, size_t size) {
    const froe_read_options all = {.size = size, .faces = FROE_FACES_TRIANGLES};
    support_defaults(out, size, &all, sizeof all);
}

/* Is the first word behind blanks and comments OFF, behind letters for what vertices carry? */
static bool is_off(const char *at) {
    for (; at += strspn(at, " \t\r\n"), *at == '#';) at += strcspn(at, "\n");
    at += strspn(at, "STCN4n");
    return !strncmp(at, "OFF", 3) && strchr(" \t\n\v\f\r", at[3]) /* or the end */;
}

static formats_reader *choose_own(const formats_source *source) {
    if (formats_csv_recognise(source)) return formats_read_csv;
    if (is_off(source->head) || !strcmp(source->extension.text, "off")) return formats_read_off;
    if (!strncmp(source->head, "ply\n", 4) || !strncmp(source->head, "ply\r", 4)) return formats_read_ply;
    if (!strcmp(source->extension.text, "ply")) return formats_read_ply;
    if (formats_is_collection(source)) return formats_read_geojson;
    return strcmp(source->extension.text, "obj") ? NULL : formats_read_obj;
}

static formats_reader *choose_csv(const formats_source *source) {
    return formats_csv_recognise(source) ? formats_read_csv : NULL;
}

froe_status froe_read_batches(const char *path, const froe_read_options *options, froe_objects_fn *fn, void *user,
                              froe_read_report *report, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    froe_scene *none; /* it has no objects */
    const formats_readers own = {.choose = choose_csv, .deliver = fn, .user = user};
    froe_status status = formats_check_reading(__func__, path, options, &none, diag);
    if (status) return status;
    if (!fn) return support_fail_null(diag, __func__);
    status = formats_read(&own, path, options, &none, report, diag);
    if (!status) froe_scene_free(none);
    return status;
}

bool froe_reads_own(const char *path) {
    SUPPORT_FLOATS_OWN;
    formats_source source;
    if (!path || formats_source_open(path, NULL, &source, NULL)) return false;
    return !formats_is_moving(&source) && choose_own(&source);
}

froe_status froe_read_own(const char *path, const froe_read_options *options, froe_scene **out,
                          froe_read_report *report, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    static const formats_readers own = {.choose = choose_own, .maps = formats_read_geojson};
    const froe_status status = formats_check_reading("froe_read_own", path, options, out, diag);
    return status ? status : formats_read(&own, path, options, out, report, diag);
}
