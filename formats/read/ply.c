/* ply.c: the Polygon File Format (Turk 1994), as text and binary of either byte
 * order, in the precision of the file: elements `vertex` (x, y, z), `face` (a list of
 * indices) and `edge` (vertex1, vertex2). Without faces and edges the vertices are points. A
 * face has its own colour (red, green, blue, perhaps alpha), or else the mean of its corners' colours.
 *
 *     ply / format ascii 1.0 / element vertex 3 / property double x ... / end_header / data */
#include "formats/input/colour.h"
#include "formats/input/paint.h"
#include "formats/input/texture.h"
#include "formats/read/readers.h"
#include "support/decimal/decimal.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_PROPERTIES = 64, WORD_ROOM = 32 };

typedef enum ply_type { NO_TYPE, INT8, UINT8, INT16, UINT16, INT32, UINT32, FLOAT32, FLOAT64 } ply_type;
typedef enum ply_role { LEFT_ALONE, X, Y, Z, INDICES, FIRST, SECOND, RED, GREEN, BLUE, ALPHA, ROLES } ply_role;

typedef struct property {
    ply_type count, type; /* count: of a list; NO_TYPE otherwise */
    ply_role role;
} property;

typedef struct element {
    enum { OTHER, VERTEX, FACE, EDGE } kind;
    char name[WORD_ROOM];
    uint64_t count;
    int properties;
    property property[MOST_PROPERTIES];
} element;

typedef struct ply {
    formats_sink *sink;
    const char *at, *end;
    bool text, big; /* big: the most significant byte comes first */
    bool doubles;   /* x, y and z are doubles */
    ARRAY(element) elements;
    ARRAY(uint32_t) corners; /* of an item */
    ARRAY(double) indices;
    ARRAY(uint32_t) colours, shades; /* of vertices, where they have any; of the corners of a face */
    formats_paint paint;
    uint64_t done, all; /* items of all elements */
    bool shapes;        /* there are faces or edges */
} ply;

static froe_status broken(ply *p, const char *sentence) {
    return support_fail(p->sink->diag, FROE_E_FORMAT, "%s: %s", support_short(p->sink->path), sentence);
}

static froe_status out_of_memory(ply *p) {
    return support_fail_memory(p->sink->diag);
}

/* ---------------------------------------------------------------- header -- */

/* The next word of the line, cut to its room; empty at the end of the line. */
static const char *next_word(ply *p, char *word) {
    p->at += strspn(p->at, " \t");
    size_t length = strcspn(p->at, " \t\r\n"), kept = length < WORD_ROOM ? length : WORD_ROOM - 1;
    memcpy(word, p->at, kept);
    word[kept] = '\0';
    p->at += length;
    return word;
}

/* To the next line; false at the end of the file, or of its text: a zero byte. */
static bool skip_line(ply *p) {
    while (*p->at && *p->at != '\n' && *p->at != '\r') ++p->at;
    if (!*p->at) return false;
    if (*p->at == '\r') ++p->at;
    if (*p->at == '\n') ++p->at;
    return p->at < p->end;
}

static ply_type type_of(const char *name) {
    static const char *const names[] = {"",       "char",  "uchar",  "short",   "ushort", "int",
                                        "uint",   "float", "double", "int8",    "uint8",  "int16",
                                        "uint16", "int32", "uint32", "float32", "float64"};
    for (int i = 1; i < (int)(sizeof names / sizeof *names); ++i)
        if (!strcmp(names[i], name)) return (ply_type)(i > FLOAT64 ? i - FLOAT64 : i);
    return NO_TYPE;
}

static froe_status read_property(ply *p) {
    char word[WORD_ROOM];
    if (!p->elements.count) return broken(p, "A property belongs to no element.");
    element *e = p->elements.data + p->elements.count - 1;
    if (e->properties == MOST_PROPERTIES) return broken(p, "An element has more than 64 properties.");
    property *to = &e->property[e->properties++];
    *to = (property){.count = NO_TYPE};
    bool list = !strcmp(next_word(p, word), "list");
    if (list) {
        to->count = type_of(next_word(p, word));
        next_word(p, word);
    }
    to->type = type_of(word);
    if (to->type == NO_TYPE || (list && (to->count == NO_TYPE || to->count >= FLOAT32)))
        return broken(p, "A property is of unknown type.");
    next_word(p, word);
    to->role = LEFT_ALONE;
    if (e->kind == VERTEX && !list && word[0] >= 'x' && word[0] <= 'z' && !word[1])
        to->role = (ply_role)(X + word[0] - 'x');
    const bool indices = list && (!strcmp(word, "vertex_indices") || !strcmp(word, "vertex_index"));
    if (e->kind == OTHER && e->count && indices)
        return support_fail(p->sink->diag, FROE_E_UNSUPPORTED,
                            "%s: The element '%.40s' names vertices, which is read of faces and edges alone.",
                            support_short(p->sink->path), e->name);
    if (e->kind == FACE && indices) to->role = INDICES;
    if (e->kind == EDGE && !list && !strcmp(word, "vertex1")) to->role = FIRST;
    if (e->kind == EDGE && !list && !strcmp(word, "vertex2")) to->role = SECOND;
    static const char *const channels[] = {"red", "green", "blue", "alpha"};
    for (int k = 0; k < 4 && !list && (e->kind == VERTEX || e->kind == FACE); k++)
        if (!strcmp(word, channels[k])) to->role = (ply_role)(RED + k);
    if (to->role >= X && to->role <= Z) p->doubles = to->type == FLOAT64;
    return FROE_OK;
}

static froe_status read_element(ply *p) {
    char word[WORD_ROOM], *end;
    if (!array_reserve(&p->sink->alloc, &p->elements, 1)) return out_of_memory(p);
    element *e = p->elements.data + p->elements.count++;
    memset(e, 0, sizeof *e);
    next_word(p, word);
    memcpy(e->name, word, sizeof e->name);
    e->kind = !strcmp(word, "vertex") ? VERTEX : !strcmp(word, "face") ? FACE : !strcmp(word, "edge") ? EDGE : OTHER;
    next_word(p, word);
    e->count = strtoull(word, &end, 10);
    if (*word < '0' || *word > '9' || *end) return broken(p, "An element has no count.");
    if (e->count > (uint64_t)(p->end - p->at)) return broken(p, "The file is shorter than its counts say.");
    p->shapes = p->shapes || ((e->kind == FACE || e->kind == EDGE) && e->count);
    p->all += e->count;
    return FROE_OK;
}

/* Does an element lack what its items are made of? A file without z is flat. */
static froe_status check_element(ply *p, const element *e) {
    unsigned found = 0, needed = 0;
    for (int i = 0; i < e->properties; ++i) found |= 1u << e->property[i].role;
    if (e->kind == VERTEX) needed = 1u << X | 1u << Y;
    if (e->kind == FACE) needed = 1u << INDICES;
    if (e->kind == EDGE) needed = 1u << FIRST | 1u << SECOND;
    if (!e->count || (found & needed) == needed) return FROE_OK;
    return broken(p, e->kind == VERTEX ? "Its vertices have no x or no y."
                     : e->kind == FACE ? "Its faces have no list vertex_indices."
                                       : "Its edges have no vertex1 or no vertex2.");
}

static froe_status read_ply_header(ply *p) {
    froe_status status = FROE_OK;
    bool formatted = false;
    char word[WORD_ROOM];
    while (!status) {
        if (!skip_line(p)) return broken(p, "The header has no end.");
        next_word(p, word);
        if (!strcmp(word, "end_header")) break;
        if (!strcmp(word, "format")) {
            next_word(p, word);
            p->text = !strcmp(word, "ascii");
            p->big = !strcmp(word, "binary_big_endian");
            formatted = p->text || p->big || !strcmp(word, "binary_little_endian");
            if (!formatted) return broken(p, "Its format is neither ascii nor binary.");
        } else if (!strcmp(word, "element")) {
            status = read_element(p);
        } else if (!strcmp(word, "property")) {
            status = read_property(p);
        }
    }
    skip_line(p); /* data begins behind the line, even when it is empty */
    if (!status && !formatted) status = broken(p, "The header names no format.");
    for (size_t k = 0; k < p->elements.count && !status; ++k) status = check_element(p, p->elements.data + k);
    return status;
}

/* ------------------------------------------------------------------ data -- */

static const unsigned char sizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};

static bool read_number(ply *p, ply_type type, double *value) {
    if (p->text) {
        char *end;
        *value = support_decimal_ahead(p->at, &end);
        bool found = end != p->at;
        p->at = end;
        return found;
    }
    const size_t size = sizes[type];
    if ((size_t)(p->end - p->at) < size) return false;
    uint64_t bits = 0;
    if (size == 8 && p->big == (__BYTE_ORDER__ == __ORDER_BIG_ENDIAN__))
        memcpy(&bits, p->at, 8);
    else
        for (size_t i = 0; i < size; ++i) bits = bits << 8 | (unsigned char)p->at[p->big ? i : size - 1 - i];
    p->at += size;
    float single;
    const uint32_t low = (uint32_t)bits;
    memcpy(value, &bits, sizeof *value);
    memcpy(&single, &low, sizeof single);
    if (type == FLOAT32) *value = (double)single;
    if (type == INT8) *value = (int8_t)bits;
    if (type == INT16) *value = (int16_t)bits;
    if (type == INT32) *value = (int32_t)bits;
    if (type == UINT8 || type == UINT16 || type == UINT32) *value = (double)bits;
    return true;
}

/* Numbers of one item, by role; of its indices all. */
static froe_status read_item(ply *p, const element *e, double *by_role) {
    p->indices.count = 0;
    for (int i = 0; i < e->properties; ++i) {
        const property *to = &e->property[i];
        double count = 1, value;
        if (to->count && !read_number(p, to->count, &count)) return broken(p, "The data end too early.");
        if (!(count >= 0 && count == floor(count))) return broken(p, "The length of a list is no whole number.");
        if (count > (double)(p->end - p->at)) return broken(p, "A list is longer than the file.");
        for (double k = 0; k < count; ++k) {
            if (!read_number(p, to->type, &value)) return broken(p, "The data end too early, or hold no number.");
            by_role[to->role] = value;
            if (to->role == INDICES && !array_push(&p->sink->alloc, &p->indices, value)) return out_of_memory(p);
        }
    }
    if (p->text) skip_line(p); /* some programs write more numbers than the header declares */
    return FROE_OK;
}

static froe_status add_corner(ply *p, double index) {
    const size_t vertices = p->sink->points.count / 3;
    if (!(index >= 0 && index < (double)vertices) || index != (double)(uint64_t)index)
        return formats_sink_fail(p->sink, FROE_E_FORMAT,
                                 "A face or edge names a vertex that does not exist (or comes later).");
    const bool coloured = p->colours.count == vertices;
    return array_push(&p->sink->alloc, &p->corners, (uint32_t)index) &&
                   (!coloured || array_push(&p->sink->alloc, &p->shades, p->colours.data[(size_t)index]))
               ? FROE_OK
               : out_of_memory(p);
}

/* Is there more than the counts say? Behind binary data there may be bytes, too few for an item of the last element. */
static bool has_more(const ply *p) {
    size_t least = 0;
    if (p->text) return p->at[strspn(p->at, " \t\r\n")] != '\0';
    for (size_t k = 0; k < p->elements.count; ++k) {
        const element *e = p->elements.data + k;
        if (e->count) least = 0;
        for (int i = 0; i < e->properties && e->count; ++i)
            least += sizes[e->property[i].count] + sizes[e->property[i].type]; /* a list of one, or a number */
    }
    return least && (size_t)(p->end - p->at) >= least;
}

/* The colour of an item: whole numbers up to 255 (in other integer types, too), or shares; 0: it has none. */
static uint32_t item_colour(const element *e, const double *by_role) {
    double shares[4] = {0, 0, 0, 1};
    int found = 0;
    for (int i = 0; i < e->properties; i++) {
        const property *to = &e->property[i];
        if (to->role < RED || to->role > ALPHA) continue;
        shares[to->role - RED] = to->type >= FLOAT32 ? by_role[to->role] : by_role[to->role] / 255;
        found += to->role != ALPHA;
    }
    return found == 3 ? formats_colour(shares) : 0;
}

/* A vertex is kept for the faces and edges to come, where there are any. */
static froe_status add_item(ply *p, const element *e, const double *by_role) {
    froe_status status = FROE_OK;
    if (e->kind == OTHER) return FROE_OK;
    const uint32_t colour = item_colour(e, by_role);
    if (e->kind == VERTEX && !p->shapes) { /* a cloud: so many points that their colours are few steps */
        status = formats_paint_enter(p->sink, &p->paint, colour ? formats_step_colour(colour) : 0);
        return status ? status : formats_sink_point(p->sink, by_role + X);
    }
    if (e->kind == VERTEX)
        return array_append(&p->sink->alloc, &p->sink->points, by_role + X, 3) &&
                       (!colour || array_push(&p->sink->alloc, &p->colours, colour))
                   ? FROE_OK
                   : out_of_memory(p);
    p->corners.count = p->shades.count = 0;
    if (e->kind == EDGE) {
        status = add_corner(p, by_role[FIRST]);
        if (!status) status = add_corner(p, by_role[SECOND]);
    } else {
        for (size_t i = 0; i < p->indices.count && !status; ++i) status = add_corner(p, p->indices.data[i]);
    }
    if (status) return status;
    if (!p->corners.count) return ++p->sink->report.skipped, FROE_OK;
    const uint32_t mean = formats_paint_mean(p->shades.data, p->shades.count);
    status = formats_paint_enter(p->sink, &p->paint, colour ? colour : mean);
    return status ? status : formats_sink_indexed_face(p->sink, p->corners.data, p->corners.count);
}

froe_status formats_read_ply(const formats_source *source, formats_sink *sink) {
    enum { ITEMS_PER_REPORT = 8192 };
    const froe_allocator *alloc = &sink->alloc;
    formats_text file = {0};
    ply p = {.sink = sink};
    froe_status status = formats_load(source, sink, true, &file);
    p.at = file.data;
    p.end = p.at + file.count;
    if (!status && formats_is_utf16(source)) status = formats_refuse_utf16(source, sink);
    if (!status && strncmp(p.at, "ply", 3) != 0) status = broken(&p, "The file does not begin like PLY.");
    if (!status) status = read_ply_header(&p);
    if (!status) status = formats_sink_open(sink, 3);
    formats_report_format(sink, p.text || p.doubles ? "float64" : "float32", "PLY");
    sink->report.layers = 1;
    if (!status) status = formats_sink_feature(sink, 0);
    sink->unit = p.shapes ? "face" : "vertex";
    for (size_t k = 0; k < p.elements.count; ++k) {
        const element *e = p.elements.data + k;
        for (uint64_t i = 0; i < e->count && !status; ++i) {
            double by_role[ROLES] = {0};
            sink->number = i;
            status = read_item(&p, e, by_role);
            if (!status) status = add_item(&p, e, by_role);
            if (!status && p.done++ % ITEMS_PER_REPORT == 0)
                status = formats_sink_progress(sink, (double)p.done / (double)p.all);
        }
    }
    if (!status && has_more(&p)) status = broken(&p, "There is more than its counts say.");
    array_free(alloc, &file);
    array_free(alloc, &p.elements);
    array_free(alloc, &p.corners);
    array_free(alloc, &p.indices);
    array_free(alloc, &p.colours);
    array_free(alloc, &p.shades);
    formats_paint_free(sink, &p.paint);
    return status;
}
