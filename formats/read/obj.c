/* obj.c: Wavefront OBJ in double precision: vertices, points, lines and faces,
 * groups (o, g) and materials (usemtl, coloured by mtllib). Free-form curves and surfaces are skipped and
 * counted. Where nothing names a vertex, the vertices are points. Each pair of an object's name and a material is one
 * group, wherever in the file its faces are.
 *
 *     o roof
 *     usemtl tiles
 *     f 1/1/1 2/2/1 -1//1        indices from 1; negative: from the last vertex back
 */
#include "formats/read/mtl.h"
#include "formats/read/readers.h"
#include "support/decimal/decimal.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_ROOM = FORMATS_MATERIAL_NAME, BUCKETS = 4096 };

/* A group met before, and the next with the same hash. */
typedef struct known {
    char name[NAME_ROOM], material[NAME_ROOM];
    uint32_t group, next1; /* next1: index + 1, 0: none */
} known;

typedef struct obj {
    formats_sink *sink;
    const char *path;
    formats_materials materials;
    char *line;                    /* the current one, ended by a NUL */
    uint64_t number;               /* of the line, from 1 */
    ARRAY(double) points, corners; /* 3 each */
    ARRAY(known) groups;
    uint32_t first1[BUCKETS]; /* heads of the chains */
    char name[NAME_ROOM], material[NAME_ROOM];
    bool regroup, refeature; /* name or material, name changed since the last element */
} obj;

static froe_status broken_obj(obj *o, const char *sentence) {
    return support_fail(o->sink->diag, FROE_E_FORMAT, "%s: line %llu: %s", support_short(o->sink->path),
                        (unsigned long long)o->number, sentence);
}

static froe_status out_of_memory(obj *o) {
    return support_fail_memory(o->sink->diag);
}

/* ---------------------------------------------------------------- groups -- */

static froe_status enter_named_group(obj *o) {
    o->sink->group = FROE_NONE;
    if (!*o->name && !*o->material) return FROE_OK;
    uint32_t hash = 2166136261u; /* FNV-1a of both names, with a byte between them that no text has */
    for (const char *c = o->name; *c; ++c) hash = (hash ^ (unsigned char)*c) * 16777619u;
    hash = (hash ^ 255u) * 16777619u;
    for (const char *c = o->material; *c; ++c) hash = (hash ^ (unsigned char)*c) * 16777619u;
    const uint32_t bucket = hash % BUCKETS;
    for (uint32_t at = o->first1[bucket]; at; at = o->groups.data[at - 1].next1) {
        const known *k = o->groups.data + at - 1;
        if (strcmp(k->name, o->name) || strcmp(k->material, o->material)) continue;
        o->sink->group = k->group;
        return FROE_OK;
    }
    froe_group group = {
        .name = o->name, .material = o->material, .colour = formats_material_colour(&o->materials, o->material)};
    froe_status status = formats_sink_group(o->sink, &group);
    if (status) return status;
    known added = {.group = o->sink->group, .next1 = o->first1[bucket]};
    memcpy(added.name, o->name, NAME_ROOM);
    memcpy(added.material, o->material, NAME_ROOM);
    if (!array_push(&o->sink->alloc, &o->groups, added)) return out_of_memory(o);
    o->first1[bucket] = (uint32_t)o->groups.count;
    return FROE_OK;
}

/* What follows a word, without blanks around it, filled up with zeros. */
static void copy_rest(char *to, size_t room, const char *from) {
    from += strspn(from, " \t");
    size_t length = strlen(from);
    while (length && strchr(" \t\r", from[length - 1])) --length;
    memset(to, 0, room);
    memcpy(to, from, length < room ? length : room - 1);
}

/* -------------------------------------------------------------- elements -- */

/* Gathers the corners named on a line. */
static froe_status read_corners(obj *o, const char *at, size_t *count) {
    int64_t vertices = (int64_t)(o->points.count / 3);
    o->corners.count = 0;
    for (*count = 0; at += strspn(at, " \t\r"), *at; ++*count) {
        char *end;
        int64_t index = strtoll(at, &end, 10);
        if (end == at) return broken_obj(o, "An index is not a number.");
        if (index < 0) index += vertices + 1;
        if (index < 1 || index > vertices) return broken_obj(o, "An index names a vertex that does not exist.");
        if (!array_append(&o->sink->alloc, &o->corners, o->points.data + 3 * (index - 1), 3)) return out_of_memory(o);
        at = end + strcspn(end, " \t\r"); /* texture and normal */
    }
    return FROE_OK;
}

/* Begins a feature when the name is new, a group when name or material is; then adds the element. */
static froe_status read_element(obj *o, char kind, const char *at) {
    size_t count;
    formats_sink *sink = o->sink;
    froe_status status = read_corners(o, at, &count);
    if (!status && o->refeature) status = formats_sink_feature(sink, o->number);
    if (!status && (o->regroup || o->refeature)) status = enter_named_group(o);
    if (status) return status;
    o->refeature = o->regroup = false;
    sink->number = o->number;
    const double *p = o->corners.data;
    if (!count || (kind == 'l' && count < 2)) return ++sink->report.skipped, FROE_OK;
    if (kind == 'f') return formats_sink_face(sink, p, count);
    size_t step = kind == 'l' ? 2 : 1;
    for (size_t i = 0; i + step <= count && !status; ++i) status = formats_sink_face(sink, p + 3 * i, step);
    return status;
}

static bool starts(const char *line, const char *word) {
    size_t length = strlen(word);
    return !strncmp(line, word, length) && (strchr(" \t\r", line[length]) != NULL);
}

static froe_status read_line(obj *o) {
    char *line = o->line + strspn(o->line, " \t");
    if (starts(line, "v")) {
        double p[3];
        char *end = line + 1;
        for (int k = 0; k < 3; ++k) {
            const char *from = end;
            p[k] = support_decimal(from, &end);
            if (end == from) return broken_obj(o, "A vertex needs three coordinates.");
        }
        return array_append(&o->sink->alloc, &o->points, p, 3) ? FROE_OK : out_of_memory(o);
    }
    if (starts(line, "f") || starts(line, "l") || starts(line, "p")) return read_element(o, *line, line + 1);
    if (starts(line, "mtllib")) {
        char name[1024];
        copy_rest(name, sizeof name, line + 6);
        return formats_materials_read(o->sink, o->path, name, &o->materials);
    }
    if (starts(line, "curv") || starts(line, "curv2") || starts(line, "surf"))
        return ++o->sink->report.skipped, FROE_OK;
    const bool material = starts(line, "usemtl"), name = starts(line, "o") || starts(line, "g");
    if (material) copy_rest(o->material, NAME_ROOM, line + 6);
    if (name) copy_rest(o->name, NAME_ROOM, line + 1);
    o->regroup = o->regroup || material || name;
    o->refeature = o->refeature || name;
    return FROE_OK;
}

/* Ends the line at `at`, joining lines that end in a backslash; returns where the next begins. */
static char *cut_line(obj *o, char *at) {
    o->line = at;
    for (;; ++at) {
        at += strcspn(at, "\n");
        if (!*at) return at;
        ++o->number;
        char *last = at > o->line && at[-1] == '\r' ? at - 2 : at - 1;
        if (last < o->line || *last != '\\') break;
        memset(last, ' ', (size_t)(at - last) + 1);
    }
    *at = '\0';
    return at + 1;
}

froe_status formats_read_obj(const formats_source *source, formats_sink *sink) {
    enum { LINES_PER_REPORT = 16384 };
    const froe_allocator *alloc = &sink->alloc;
    formats_text text = {0};
    froe_status status = formats_load(source, sink, false, &text);
    obj *o = status ? NULL : support_calloc(alloc, 1, sizeof *o);
    if (!status && !o) status = support_fail_memory(sink->diag);
    if (!status) status = formats_sink_open(sink, 3);
    if (!status) {
        o->sink = sink;
        o->path = source->file;
        formats_report_format(sink, "float64", "OBJ");
        sink->report.layers = 1;
        sink->unit = "line";
        o->refeature = true;
        uint64_t reported = 0;
        for (char *at = text.data, *end = at + text.count; at < end && !status;) {
            at = cut_line(o, at);
            status = read_line(o);
            if (status || o->number - reported < LINES_PER_REPORT) continue;
            reported = o->number;
            status = formats_sink_progress(sink, (double)(at - text.data) / (double)text.count);
        }
        const bool cloud = !sink->report.features; /* vertices, and nothing that names them */
        if (!status && cloud) status = formats_sink_feature(sink, 0);
        for (size_t i = 0; i < o->points.count && cloud && !status; i += 3)
            status = formats_sink_point(sink, o->points.data + i);
        if (!status && !o->points.count)
            status = support_fail(sink->diag, FROE_E_FORMAT, "%s: The file has no vertices, and is not OBJ.",
                                  support_short(source->path));
        array_free(alloc, &o->points);
        array_free(alloc, &o->corners);
        array_free(alloc, &o->groups);
        array_free(alloc, &o->materials);
    }
    support_free(alloc, o, sizeof *o);
    array_free(alloc, &text);
    return status;
}
