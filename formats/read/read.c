/* read.c: froe_read_own: which of the readers that need no library reads a file? */
#include "formats/input/csv_header.h"
#include "formats/read/readers.h"
#include "support/floats.h"
#include <string.h>

froe_read_options froe_read_defaults(void) {
    return (froe_read_options){.size = sizeof(froe_read_options), .faces = FROE_FACES_TRIANGLES};
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

bool froe_reads_own(const char *path) {
    SUPPORT_FLOATS_OWN;
    formats_source source;
    if (!path || formats_source_open(path, NULL, &source, NULL)) return false;
    return !formats_is_moving(&source) && choose_own(&source);
}

froe_status froe_read_own(const char *path, const froe_read_options *options, froe_scene **out,
                          froe_read_report *report, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    static const formats_readers own = {choose_own, formats_read_geojson, false};
    const froe_status status = formats_check_reading("froe_read_own", path, options, out, diag);
    return status ? status : formats_read(&own, path, options, out, report, diag);
}
