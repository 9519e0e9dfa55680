/* scene.c: scenes from arrays, and from the bytes of a file */
#include "web.h"
#include <froe/formats.h>
#include <string.h>

static const char *kind_name(int value) {
    return froe_kind_name((froe_kind)value);
}

#define AT(member) offsetof(froe_objects, member)
static const web_member object_members[] = {
    {"kind", WEB_NAMED, AT(kind), kind_name},    {"count", WEB_INT, AT(count), NULL},
    {"coords", WEB_ADDRESS, AT(coords), NULL},   {"pointCount", WEB_INT, AT(point_count), NULL},
    {"indices", WEB_ADDRESS, AT(indices), NULL}, {"starts", WEB_ADDRESS, AT(starts), NULL},
    {"radii", WEB_ADDRESS, AT(radii), NULL},     {"tags", WEB_ADDRESS, AT(tags), NULL},
    {"faces", WEB_ADDRESS, AT(faces), NULL},     {"groups", WEB_ADDRESS, AT(groups), NULL},
    {"group", WEB_INT, AT(group), NULL},         {NULL, WEB_INT, 0, NULL},
};
#undef AT
static void object_defaults(void *options) {
    froe_objects *batch = options;
    *batch = froe_objects_defaults();
    batch->threads = 1;
    batch->progress = web_progress;
}
const web_kind web_objects = {"objects", sizeof(froe_objects), object_defaults, object_members};

static const char *faces_name(int value) {
    static const char *const names[] = {"triangles", "polygons", NULL};
    return names[value];
}

#define AT(member) offsetof(froe_read_options, member)
static const web_member read_members[] = {
    {"name", WEB_TEXT, AT(name), NULL},
    {"faces", WEB_NAMED, AT(faces), faces_name},
    {"boxes", WEB_BOOL, AT(boxes), NULL},
    {"wrap", WEB_BOOL, AT(wrap), NULL},
    {NULL, WEB_INT, 0, NULL},
};
#undef AT
static void read_defaults(void *options) {
    froe_read_options *o = options;
    *o = froe_read_defaults();
    o->progress = web_progress;
}
const web_kind web_read_options = {"read", sizeof(froe_read_options), read_defaults, read_members};

/** How a file was read: texts, and the numbers in the order of READ in package/files.js. */
typedef struct web_read_report {
    char format[64], precision[16], unread[64];
    double numbers[10];
} web_read_report;

/** Reads the file `path` of the module's own file system. */
WEB_EXPORT froe_status web_read(const char *path, const froe_read_options *options, web_read_report *report,
                                froe_scene **out, froe_diagnostic *diag) {
    froe_read_report r;
    const froe_status status = froe_read_own(path, options, out, &r, diag);
    if (status != FROE_OK) return status;
    const double numbers[10] = {
        (double)r.features, (double)r.groups,      (double)r.linearised, (double)r.flattened, (double)r.triangulated,
        (double)r.skipped,  (double)r.no_geometry, (double)r.wrapped,    (double)r.textures,  (double)r.unread,
    };
    memcpy(report->format, r.format, sizeof report->format);
    memcpy(report->precision, r.precision, sizeof report->precision);
    memcpy(report->unread, *r.unread_library ? r.unread_library : r.unread_name, sizeof report->unread);
    memcpy(report->numbers, numbers, sizeof numbers);
    return FROE_OK;
}
