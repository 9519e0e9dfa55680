/* obj.c: Wavefront OBJ in double precision: vertices, points, lines and faces,
 * groups (o, g) and materials (usemtl, coloured by mtllib). Free-form curves and surfaces are skipped and
 * counted. Each pair of an object's name and a material is one group, wherever in
 * the file its faces are.
 *
 *     o roof
 *     usemtl tiles
 *     f 1/1/1 2/2/1 -1//1        indices from 1; negative: from the last vertex back
 */
#include "formats/read/mtl.h"
#include "formats/read/readers.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAME_ROOM = 128 };

/* A group met before, and the next with the same hash. */
typedef struct known {
    char name[NAME_ROOM], material[NAME_ROOM];
    uint32_t group, next1; /* next1: index + 1, 0: none */
} known;

enum { BUCKETS = 4096 };

typedef struct obj {
    formats_sink *sink;
    const char *path;
    formats_materials materials;
    char *line;      /* the current one, ended by a NUL */
    uint64_t number; /* of the line, from 1 */
    formats_buffer points, corners;
    formats_buffer groups;    /* of known */
    uint32_t first1[BUCKETS]; /* heads of the chains */
    char name[NAME_ROOM], material[NAME_ROOM];
    bool regroup, refeature; /* name or material, name changed since the last element */
} obj;

static froe_status broken_obj(obj *o, const char *what) {
    return support_fail(o->sink->diag, FROE_E_FORMAT, "%s: line %llu: %s", support_short(o->sink->path),
                        (unsigned long long)o->number, what);
}

static froe_status out_of_memory(obj *o) {
    return support_fail(o->sink->diag, FROE_E_MEMORY, "%s: line %llu: out of memory", support_short(o->sink->path),
                        (unsigned long long)o->number);
}

/* ---------------------------------------------------------------- groups -- */

static uint32_t hash(const char *name, const char *material) { /* FNV-1a */
    uint32_t h = 2166136261u;
    for (; *name; ++name) h = (h ^ (unsigned char)*name) * 16777619u;
    h = (h ^ 255u) * 16777619u;
    for (; *material; ++material) h = (h ^ (unsigned char)*material) * 16777619u;
    return h % BUCKETS;
}

static froe_status enter_named_group(obj *o) {
    o->sink->group = FROE_NONE;
    if (!*o->name && !*o->material) return FROE_OK;
    uint32_t bucket = hash(o->name, o->material);
    const known *all = o->groups.data;
    for (uint32_t at = o->first1[bucket]; at; at = all[at - 1].next1) {
        const known *k = &all[at - 1];
        if (strcmp(k->name, o->name) || strcmp(k->material, o->material)) continue;
        o->sink->group = k->group;
        return FROE_OK;
    }
    froe_group group = {
        .name = o->name, .material = o->material, .colour = formats_material_colour(&o->materials, o->material)};
    froe_status status = formats_sink_group(o->sink, &group);
    if (status) return status;
    known *added = formats_buffer_add(&o->sink->alloc, &o->groups, sizeof *added);
    if (!added) return out_of_memory(o);
    *added = (known){.group = o->sink->group, .next1 = o->first1[bucket]};
    memcpy(added->name, o->name, NAME_ROOM);
    memcpy(added->material, o->material, NAME_ROOM);
    o->first1[bucket] = (uint32_t)(o->groups.size / sizeof *added);
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

static void set_name(obj *o, char *to, const char *from) {
    copy_rest(to, NAME_ROOM, from);
    o->regroup = true;
}

static froe_status read_library(obj *o, const char *from) {
    char name[1024];
    copy_rest(name, sizeof name, from);
    return formats_materials_read(o->sink, o->path, name, &o->materials);
}

/* -------------------------------------------------------------- elements -- */

static froe_status read_vertex(obj *o, const char *at) {
    double p[3];
    for (int k = 0; k < 3; ++k) {
        char *end;
        p[k] = strtod(at, &end);
        if (end == at) return broken_obj(o, "a vertex needs three coordinates");
        at = end;
    }
    return formats_buffer_put(&o->sink->alloc, &o->points, p, sizeof p) ? FROE_OK : out_of_memory(o);
}

/* Gathers the corners named on a line. */
static froe_status read_corners(obj *o, const char *at, size_t *count) {
    int64_t vertices = (int64_t)(o->points.size / (3 * sizeof(double)));
    o->corners.size = 0;
    for (*count = 0; at += strspn(at, " \t\r"), *at; ++*count) {
        char *end;
        int64_t index = strtoll(at, &end, 10);
        if (end == at) return broken_obj(o, "an index is not a number");
        if (index < 0) index += vertices + 1;
        if (index < 1 || index > vertices) return broken_obj(o, "an index names a vertex that does not exist");
        const double *p = (const double *)o->points.data + 3 * (index - 1);
        if (!formats_buffer_put(&o->sink->alloc, &o->corners, p, 3 * sizeof *p)) return out_of_memory(o);
        at = end + strcspn(end, " \t\r"); /* texture and normal */
    }
    return FROE_OK;
}

/* Before an element: begins a feature when the name is new, a group when name or material is. */
static froe_status enter(obj *o) {
    froe_status status = FROE_OK;
    if (o->refeature) status = formats_sink_feature(o->sink, o->number);
    if (!status && (o->regroup || o->refeature)) status = enter_named_group(o);
    o->refeature = o->regroup = false;
    o->sink->number = o->number;
    return status;
}

static froe_status read_element(obj *o, char kind, const char *at) {
    size_t count;
    froe_status status = read_corners(o, at, &count);
    if (!status) status = enter(o);
    if (status) return status;
    formats_sink *sink = o->sink;
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
    const char *line = o->line + strspn(o->line, " \t");
    if (starts(line, "v")) return read_vertex(o, line + 1);
    if (starts(line, "f") || starts(line, "l") || starts(line, "p")) return read_element(o, *line, line + 1);
    if (starts(line, "mtllib")) return read_library(o, line + 6);
    if (starts(line, "usemtl")) return set_name(o, o->material, line + 6), FROE_OK;
    if (starts(line, "curv") || starts(line, "curv2") || starts(line, "surf"))
        return ++o->sink->report.skipped, FROE_OK;
    if (!starts(line, "o") && !starts(line, "g")) return FROE_OK;
    set_name(o, o->name, line + 1);
    o->refeature = true;
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

static froe_status read_lines(obj *o, formats_buffer *text) {
    enum { LINES_PER_REPORT = 16384 };
    froe_status status = FROE_OK;
    uint64_t reported = 0;
    char *begin = text->data, *at = begin, *end = begin + text->size;
    while (at < end && !status) {
        at = cut_line(o, at);
        status = read_line(o);
        if (status || o->number - reported < LINES_PER_REPORT) continue;
        reported = o->number;
        status = formats_sink_progress(o->sink, (double)(at - begin) / (double)text->size);
    }
    return status;
}

froe_status formats_read_obj(const formats_source *source, formats_sink *sink) {
    formats_buffer text = {0}, state = {0};
    froe_status status = formats_load(source, sink, false, &text);
    obj *o = status ? NULL : formats_buffer_add(&sink->alloc, &state, sizeof *o);
    if (!status && !o) status = support_fail_memory(sink->diag);
    if (!status) status = formats_sink_open(sink, 3);
    if (!status) {
        memset(o, 0, sizeof *o);
        o->sink = sink;
        o->path = source->path;
        formats_report_format(sink, "float64", "OBJ");
        sink->report.layers = 1;
        sink->unit = "line";
        o->refeature = true;
        status = read_lines(o, &text);
        if (!status && !o->points.size)
            status = support_fail(sink->diag, FROE_E_FORMAT, "%s: has no vertices: it is not OBJ",
                                  support_short(source->path));
        formats_buffer_free(&sink->alloc, &o->points);
        formats_buffer_free(&sink->alloc, &o->corners);
        formats_buffer_free(&sink->alloc, &o->groups);
        formats_materials_free(sink, &o->materials);
    }
    formats_buffer_free(&sink->alloc, &state);
    formats_buffer_free(&sink->alloc, &text);
    return status;
}
