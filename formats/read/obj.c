/* obj.c: Wavefront OBJ in double precision: vertices, points, lines and faces,
 * groups (o, g) and materials (usemtl, coloured by mtllib). Free-form curves and surfaces are skipped and
 * counted. Where nothing names a vertex, the vertices are points. Each pair of an object's name and a material is one
 * group, wherever in the file its faces are; where corners have colours (v x y z r g b, shares of sRGB), or the
 * material a texture, one for each colour of a face.
 *
 *     o roof
 *     usemtl tiles
 *     f 1/1/1 2/2/1 -1//1        indices from 1; negative: from the last vertex back
 */
#include "formats/input/colour.h"
#include "formats/input/paint.h"
#include "formats/read/mtl.h"
#include "formats/read/readers.h"
#include "support/decimal/decimal.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { BUCKETS = 4096 };

/* A group met before, and the next with the same hash. */
typedef struct known {
    const char *name, *material; /* in the text */
    uint32_t group, next1;       /* group: FROE_NONE before there is one; next1: index + 1, 0: none */
    formats_paint colours;       /* groups of faces with colours of their own */
} known;

typedef struct obj {
    formats_sink *sink;
    const char *path;
    formats_materials materials;
    formats_images images;
    ARRAY(uint32_t) shades;      /* per point, up to the last that has one: its colour; 0: none */
    ARRAY(uint32_t) own_shades;  /* of an element's corners */
    ARRAY(double) places;        /* in textures, 2 each */
    ARRAY(double) corner_places; /* of an element's corners; not all have one: none */
    char *line;                  /* the current one, ended by a NUL */
    uint64_t number;             /* of the line, from 1 */
    ARRAY(uint32_t) indices;     /* of an element's corners */
    ARRAY(double) corners;       /* the same, 3 each, where a texture colours them */
    ARRAY(known) groups;
    uint32_t first1[BUCKETS];    /* heads of the chains */
    const char *name, *material; /* in the text */
    bool regroup, refeature;     /* name or material, name changed since the last element */
    size_t current;              /* of `groups`; the current pair of names, if regroup is not set */
    const formats_material *paint;
} obj;

static froe_status broken_obj(obj *o, const char *sentence) {
    return support_fail(o->sink->diag, FROE_E_FORMAT, "%s: line %llu: %s", support_short(o->sink->path),
                        (unsigned long long)o->number, sentence);
}

static froe_status out_of_memory(obj *o) {
    return support_fail_memory(o->sink->diag);
}

/* ---------------------------------------------------------------- groups -- */

/* Looks for the entry of the name and material. */
static bool find_group(obj *o) {
    if (!o->regroup) return true;
    o->paint = formats_material_find(&o->materials, o->material);
    o->regroup = false;
    uint32_t hash = 2166136261u; /* FNV-1a of both names, with a byte between them that no text has */
    for (const char *c = o->name; *c; ++c) hash = (hash ^ (unsigned char)*c) * 16777619u;
    hash = (hash ^ 255u) * 16777619u;
    for (const char *c = o->material; *c; ++c) hash = (hash ^ (unsigned char)*c) * 16777619u;
    const uint32_t bucket = hash % BUCKETS;
    for (uint32_t at = o->first1[bucket]; at; at = o->groups.data[at - 1].next1) {
        const known *k = o->groups.data + at - 1;
        o->current = at - 1;
        if (!strcmp(k->name, o->name) && !strcmp(k->material, o->material)) return true;
    }
    const known added = {.name = o->name, .material = o->material, .group = FROE_NONE, .next1 = o->first1[bucket]};
    if (!array_push(&o->sink->alloc, &o->groups, added)) return false;
    o->current = o->groups.count - 1;
    o->first1[bucket] = (uint32_t)o->groups.count;
    return true;
}

/* The colour of the current element by its corners or its texture; 0: it has none of its own. */
static uint32_t own_colour(const obj *o, size_t count) {
    const uint32_t mean = formats_paint_mean(o->own_shades.data, o->own_shades.count);
    if (mean) return formats_step_colour(mean);
    if (!o->paint || !o->paint->textured || o->corner_places.count < 2 * count) return 0;
    return formats_material_texel(o->paint, o->corners.data, o->corner_places.data, count);
}

static froe_status enter_group_of(obj *o, size_t count) {
    if (!find_group(o)) return out_of_memory(o);
    known *k = o->groups.data + o->current;
    const uint32_t colour = o->sink->boxes ? 0 : own_colour(o, count);
    if (colour) {
        k->colours.name = o->name, k->colours.material = o->material;
        return formats_paint_enter(o->sink, &k->colours, colour);
    }
    o->sink->group = k->group;
    if (k->group != FROE_NONE || (!*o->name && !*o->material)) return FROE_OK;
    const froe_group group = {.name = o->name, .material = o->material, .colour = formats_material_colour(o->paint)};
    const froe_status status = formats_sink_group(o->sink, &group);
    k->group = o->sink->group;
    return status;
}

/* Ends what follows a word before the blanks behind it; returns where it begins. */
static const char *words_after(char *line) {
    line += strspn(line, " \t");
    size_t length = strlen(line);
    while (length && strchr(" \t\r", line[length - 1])) --length;
    line[length] = '\0';
    return line;
}

/* -------------------------------------------------------------- elements -- */

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

static const char *pass_blanks(const char *at) {
    while (is_blank(*at)) at++;
    return at;
}

/* As strtoll(), which is slower. */
static int64_t read_index(const char *at, char **end) {
    enum { MOST_DIGITS = 18 };
    const char *first = at + (*at == '-'), *c = first;
    int64_t index = 0;
    for (; *c >= '0' && *c <= '9' && c - first < MOST_DIGITS; c++) index = 10 * index + (*c - '0');
    if (c == first || (*c >= '0' && *c <= '9')) return strtoll(at, end, 10);
    *end = (char *)c;
    return *at == '-' ? -index : index;
}

/* The place in textures that follows the vertex of a corner: "/7", perhaps with a normal. */
static froe_status read_place(obj *o, const char *at) {
    const int64_t places = (int64_t)(o->places.count / 2);
    char *end;
    if (*at != '/' || at[1] == '/' || is_blank(at[1])) return FROE_OK;
    int64_t index = read_index(at + 1, &end);
    if (index < 0) index += places + 1;
    if (end == at + 1 || index < 1 || index > places) return FROE_OK; /* no geometry: it has no colour by that */
    return array_append(&o->sink->alloc, &o->corner_places, o->places.data + 2 * (index - 1), 2) ? FROE_OK
                                                                                                 : out_of_memory(o);
}

/* Gathers the corners named on a line, with what colours them. */
static froe_status read_corners(obj *o, const char *at, size_t *count) {
    const froe_allocator *alloc = &o->sink->alloc;
    int64_t vertices = (int64_t)(o->sink->points.count / 3);
    o->indices.count = o->corners.count = o->own_shades.count = o->corner_places.count = 0;
    for (*count = 0; at = pass_blanks(at), *at && *at != '#'; ++*count) {
        char *end;
        int64_t index = read_index(at, &end);
        if (end == at) return broken_obj(o, "An index is not a number.");
        if (index < 0) index += vertices + 1;
        if (index < 1 || index > vertices) return broken_obj(o, "An index names a vertex that does not exist.");
        const size_t point = (size_t)index - 1;
        if (!array_push(alloc, &o->indices, (uint32_t)point) ||
            (o->places.count && !array_append(alloc, &o->corners, o->sink->points.data + 3 * point, 3)))
            return out_of_memory(o);
        if (o->shades.count && !array_push(alloc, &o->own_shades, point < o->shades.count ? o->shades.data[point] : 0))
            return out_of_memory(o);
        const froe_status status = read_place(o, end);
        if (status) return status;
        for (at = end; *at && *at != '#' && !is_blank(*at);) at++; /* texture and normal */
    }
    return FROE_OK;
}

/* Begins a feature when the name is new; then adds the element. */
static froe_status read_element(obj *o, char kind, const char *at) {
    size_t count;
    formats_sink *sink = o->sink;
    froe_status status = read_corners(o, at, &count);
    if (!status && o->refeature) status = formats_sink_feature(sink, o->number);
    if (!status) status = enter_group_of(o, count);
    if (status) return status;
    o->refeature = false;
    sink->number = o->number;
    const uint32_t *indices = o->indices.data;
    if (!count || (kind == 'l' && count < 2)) return ++sink->report.skipped, FROE_OK;
    if (kind == 'f') return formats_sink_indexed_face(sink, indices, count);
    size_t step = kind == 'l' ? 2 : 1;
    for (size_t i = 0; i + step <= count && !status; ++i) status = formats_sink_indexed_face(sink, indices + i, step);
    return status;
}

static inline bool starts(const char *line, const char *word) {
    for (; *word; line++, word++)
        if (*line != *word) return false;
    return !*line || is_blank(*line);
}

/* The colour behind the coordinates of a vertex: three shares. A single number there is a weight. */
static froe_status read_shade(obj *o, const char *at) {
    double rgba[4] = {0, 0, 0, 1};
    const size_t points = o->sink->points.count / 3;
    for (int k = 0; k < 3; ++k) {
        char *end;
        rgba[k] = support_decimal_ahead(at, &end);
        if (end == at) return FROE_OK;
        at = end;
    }
    if (!array_reserve(&o->sink->alloc, &o->shades, points - o->shades.count)) return out_of_memory(o);
    while (o->shades.count < points) o->shades.data[o->shades.count++] = 0;
    o->shades.data[points - 1] = formats_colour(rgba);
    return FROE_OK;
}

/* One library or more. Names may hold blanks: each ends where a blank follows .mtl, or with the line. */
static froe_status read_libraries(obj *o, char *at) {
    froe_status status = FROE_OK;
    o->regroup = true;
    for (char *next; *(at += strspn(at, " \t\r")) && !status; at = next) {
        for (next = at + 1; *next && !(is_blank(*next) && next - at > 4 && !strncasecmp(next - 4, ".mtl", 4));) next++;
        if (*next) *next++ = '\0';
        status = formats_materials_read(o->sink, o->path, words_after(at), &o->materials, &o->images);
    }
    return status;
}

/* Curves and surfaces, those of version 2 as well, and what is in another file. */
static bool is_left_out(const char *line) {
    static const char *const words[] = {"curv", "curv2", "surf", "bzp", "bsp", "cdc", "cdp", "call"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (*line == *words[i] && starts(line, words[i])) return true;
    return false;
}

static froe_status read_line(obj *o) {
    char *line = o->line + strspn(o->line, " \t");
    if (starts(line, "v")) {
        double p[3];
        char *end = line + 1;
        for (int k = 0; k < 3; ++k) {
            const char *from = end;
            p[k] = support_decimal_ahead(from, &end);
            if (end == from) return broken_obj(o, "A vertex needs three coordinates.");
        }
        return array_append(&o->sink->alloc, &o->sink->points, p, 3) ? read_shade(o, end) : out_of_memory(o);
    }
    if (starts(line, "vt")) {
        double place[2] = {0, 0};
        char *end = line + 2;
        for (int k = 0; k < 2; ++k) place[k] = support_decimal_ahead(end, &end);
        return array_append(&o->sink->alloc, &o->places, place, 2) ? FROE_OK : out_of_memory(o);
    }
    if (starts(line, "f") || starts(line, "l") || starts(line, "p")) return read_element(o, *line, line + 1);
    if (starts(line, "fo")) return read_element(o, 'f', line + 2); /* a face of version 2 */
    if (starts(line, "mtllib")) return read_libraries(o, line + 6);
    if (is_left_out(line)) return ++o->sink->report.skipped, FROE_OK;
    if (*line && strchr("VFLP", *line) && is_blank(line[1]))
        return broken_obj(o, "Words such as 'v' and 'f' are not read in capital letters.");
    const bool material = starts(line, "usemtl"), name = starts(line, "o") || starts(line, "g");
    if (material) o->material = words_after(line + 6);
    if (name) o->name = words_after(line + 1);
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

static froe_status read_cloud_point(obj *o, size_t i) {
    o->own_shades.count = o->corner_places.count = 0;
    if (i < o->shades.count && !array_push(&o->sink->alloc, &o->own_shades, o->shades.data[i])) return out_of_memory(o);
    const froe_status status = enter_group_of(o, 1);
    return status ? status : formats_sink_point(o->sink, o->sink->points.data + 3 * i);
}

froe_status formats_read_obj(const formats_source *source, formats_sink *sink) {
    enum { LINES_PER_REPORT = 16384 };
    const froe_allocator *alloc = &sink->alloc;
    formats_text text = {0};
    froe_status status = formats_load(source, sink, false, &text);
    if (!status) formats_end_lines(text.data);
    obj *o = status ? NULL : support_calloc(alloc, 1, sizeof *o);
    if (!status && !o) status = support_fail_memory(sink->diag);
    if (!status) status = formats_sink_open(sink, 3);
    if (!status) {
        o->sink = sink;
        o->path = source->file;
        o->name = o->material = "";
        formats_report_format(sink, "float64", "OBJ");
        sink->report.layers = 1;
        sink->unit = "line";
        o->refeature = o->regroup = true;
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
        for (size_t i = 0; i < o->sink->points.count && cloud && !status; i += 3) status = read_cloud_point(o, i / 3);
        if (!status && !o->sink->points.count)
            status = support_fail(sink->diag, FROE_E_FORMAT, "%s: The file has no vertices, and is not OBJ.",
                                  support_short(source->path));
        array_free(alloc, &o->indices);
        array_free(alloc, &o->corners);
        for (size_t i = 0; i < o->groups.count; ++i) formats_paint_free(sink, &o->groups.data[i].colours);
        array_free(alloc, &o->groups);
        formats_materials_free(alloc, &o->materials);
        array_free(alloc, &o->shades);
        array_free(alloc, &o->own_shades);
        array_free(alloc, &o->places);
        array_free(alloc, &o->corner_places);
        formats_images_free(alloc, &o->images);
    }
    support_free(alloc, o, sizeof *o);
    array_free(alloc, &text);
    return status;
}
