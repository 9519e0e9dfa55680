/* collada.c: what a COLLADA file (version 1.4.1) may say that assimp passes over, so that the model would be another.
 *
 *     instance_node, instance_geometry, instance_controller: what they name must be where assimp finds it
 *     trifans      assimp takes a fan of triangles for a polygon
 *     rotate       assimp stretches the model where the axis has another length than 1
 *     matrix       assimp leaves out what the last row says
 *     p, vcount    assimp takes a negative index for 0, and what is no number for indices 0 without an end
 *     lines        assimp leaves out an index that is left over
 *     accessor     assimp reads beyond the numbers that there are, and without a z takes the next number for it
 *     skew         assimp ends the program
 *     count, p     assimp ends it where triangles have no indices, or polygons others than were counted, and leaves
 *                  out what is counted as 0; so it does without the vcount of a polylist
 *     lookat       assimp turns the model by an axis that need not be upright on the others
 *     param        assimp takes x for y and z where they have no names
 *     geometry     what is neither mesh nor instanced is counted: splines, and hulls of other meshes
 *
 * What assimp does not look at is not looked at either: libraries of other things, such as physics, and extras of
 * programs. Whatever assimp refuses by itself is left to it, and so is a text that is no XML. */
#include "check/check.h"
#include "support/decimal/decimal.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct reference {
    size_t name; /* in `text` */
    const char *element;
    unsigned long line;
} reference;

typedef struct collada_check {
    io_xml xml;
    ARRAY(char) text;       /* names, each with a NUL */
    ARRAY(char) numbers;    /* what stands in an element rotate or matrix */
    ARRAY(size_t) ids;      /* where those of geometries, controllers and nodes begin */
    ARRAY(reference) named; /* what must be among them */
    size_t depth, geometry; /* of the element, from 1; of the geometry that it is in, or 0 */
    bool indices, counts;   /* in an element p; in a vcount */
    size_t given, stride;   /* whole numbers in this p; how many belong to a corner */
    bool digit;             /* the last character of it was one */
    size_t floats;          /* in the last array */
    char array[64];         /* its id, or the first letters of it */
    bool has_x, has_z;      /* the accessor */
    bool turns, matrix;     /* in an element rotate; in a matrix */
    size_t beyond;          /* the depth of the element, in which nothing is looked at, that it is in, or 0 */
    size_t looking;         /* the depth of the node, in which a lookat stands, that it is in, or 0 */
    size_t list, counted;   /* of faces or lines: its sort, from 1, and its count; 0: in none */
    size_t filled, parts;   /* how many of its elements p have anything in them; all of them */
    bool vcount, text_in;   /* it has one; there is text in this element p */
    size_t source;          /* the last one, in `text` */
    ARRAY(size_t) unnamed;  /* sources without names of all axes */
    bool has_y;             /* the accessor */
    bool nodes;             /* in the library of nodes, of which assimp finds those alone that are in no other one */
    bool scenes;            /* in the library of scenes, or behind it */
} collada_check;

bool io_is_collada(const formats_source *source) {
    return !strcmp(source->extension.text, "dae") || !strcmp(source->extension.text, "zae");
}

static const char *attribute(const char **attributes, const char *name) {
    for (; *attributes; attributes += 2)
        if (!strcmp(attributes[0], name)) return attributes[1];
    return NULL;
}

/* Keeps a name; *at is where. */
static bool keep(collada_check *c, const char *name, size_t *at) {
    *at = c->text.count;
    if (array_append(&c->xml.sink->alloc, &c->text, name, strlen(name) + 1)) return true;
    io_xml_stop(&c->xml, support_fail_memory(c->xml.sink->diag));
    return false;
}

static void define(collada_check *c, const char *name) {
    size_t at;
    if (!name || c->xml.status || !keep(c, name, &at)) return;
    if (!array_push(&c->xml.sink->alloc, &c->ids, at)) io_xml_stop(&c->xml, support_fail_memory(c->xml.sink->diag));
}

static void refer(collada_check *c, const char *element, const char *name, bool looking) {
    if (looking) {
        io_xml_refuse(&c->xml, FROE_E_UNSUPPORTED, "Shapes in nodes that are turned by a lookat are not read.");
        return;
    }
    reference r = {.element = element, .line = XML_GetCurrentLineNumber(c->xml.parser)};
    if (!keep(c, name ? name : "", &r.name)) return;
    if (!array_push(&c->xml.sink->alloc, &c->named, r)) io_xml_stop(&c->xml, support_fail_memory(c->xml.sink->diag));
}

static const char *const lists[] = {"triangles", "polylist", "polygons", "lines", "linestrips", "tristrips"};
enum { TRIANGLES = 1, POLYLIST, POLYGONS, LINES, LISTS = sizeof lists / sizeof *lists };

static size_t list_of(const char *name) {
    for (size_t i = 0; i < LISTS; i++)
        if (!strcmp(name, lists[i])) return i + 1;
    return 0;
}

static size_t whole_number(const char **attributes, const char *name, size_t otherwise) {
    const char *given = attribute(attributes, name);
    return given ? strtoul(given, NULL, 10) : otherwise;
}

/* An array, and what says how its numbers are read. */
static void check_source(collada_check *c, const char *name, const char **attributes) {
    if (!strcmp(name, "float_array")) {
        const char *id = attribute(attributes, "id");
        c->floats = whole_number(attributes, "count", 0);
        snprintf(c->array, sizeof c->array, "#%s", id ? id : "");
    } else if (!strcmp(name, "accessor")) {
        const char *from = attribute(attributes, "source");
        const size_t count = whole_number(attributes, "count", 0), stride = whole_number(attributes, "stride", 1);
        const size_t left = c->floats - whole_number(attributes, "offset", 0);
        c->has_x = c->has_y = c->has_z = false;
        if (from && !strcmp(from, c->array) && count && (left > c->floats || stride > left / count))
            io_xml_refuse(&c->xml, FROE_E_FORMAT, "An accessor counts more numbers than its array has.");
    } else if (!strcmp(name, "param") && attribute(attributes, "name")) {
        const char *axis = attribute(attributes, "name");
        c->has_x = c->has_x || !strcmp(axis, "X");
        c->has_y = c->has_y || !strcmp(axis, "Y");
        c->has_z = c->has_z || !strcmp(axis, "Z");
    } else if (!strcmp(name, "source")) {
        const char *id = attribute(attributes, "id");
        (void)keep(c, id ? id : "", &c->source);
    } else if (!strcmp(name, "input") && attribute(attributes, "semantic") && attribute(attributes, "source")) {
        const char *from = attribute(attributes, "source");
        const bool places = !strcmp(attribute(attributes, "semantic"), "POSITION");
        const size_t offset = whole_number(attributes, "offset", 0);
        if (offset >= c->stride) c->stride = offset + 1;
        for (size_t i = 0; i < c->unnamed.count && places && !c->xml.status; i++)
            if (*from == '#' && !strcmp(from + 1, c->text.data + c->unnamed.data[i]))
                io_xml_refuse(&c->xml, FROE_E_UNSUPPORTED, "Points whose X, Y and Z have no names are not read.");
    }
}

/* A list of faces or lines, and what stands in it. */
static void begin_part(collada_check *c, const char *name, const char **attributes) {
    const bool indices = !strcmp(name, "p");
    if (list_of(name)) {
        c->list = list_of(name);
        c->counted = whole_number(attributes, "count", 0);
        c->filled = c->parts = 0;
        c->stride = 1;
        c->vcount = false;
    } else if (!strcmp(name, "vcount")) {
        c->vcount = true;
    } else if (!strcmp(name, "ph")) {
        io_xml_refuse(&c->xml, FROE_E_UNSUPPORTED, "Polygons with holes (ph) are not read.");
    } else if (indices && c->list == POLYLIST && !c->vcount) {
        io_xml_refuse(&c->xml, FROE_E_FORMAT, "A polylist has no vcount before its indices.");
    }
    c->parts += indices;
    c->text_in = c->digit = false;
    c->given = 0;
}

static void end_part(collada_check *c, const char *name) {
    c->filled += c->text_in;
    c->text_in = false;
    if (c->list == LINES && !strcmp(name, "p") && c->given % (2 * c->stride)) {
        io_xml_refuse(&c->xml, FROE_E_FORMAT, "The indices of lines are no pairs.");
        return;
    }
    if (!c->list || strcmp(name, lists[c->list - 1]) != 0) return;
    const bool others = c->list == POLYGONS ? c->parts != c->counted : c->list < POLYGONS && c->counted && !c->parts;
    c->list = 0;
    if (others || (c->filled && !c->counted))
        io_xml_refuse(&c->xml, FROE_E_FORMAT, "A list of faces or lines has other indices than it counts.");
}

/* Does assimp look at nothing in it? */
static bool is_beyond(const collada_check *c, const char *name) {
    static const char *const looked[] = {"library_geometries", "library_controllers", "library_nodes",
                                         "library_visual_scenes"};
    if (c->depth != 2) return !strcmp(name, "extra");
    for (size_t i = 0; i < sizeof looked / sizeof *looked; i++)
        if (!strcmp(name, looked[i])) return false;
    return true;
}

static void XMLCALL begin_element(void *user, const char *name, const char **attributes) {
    static const char *const defined[] = {"geometry", "controller", "node"};
    static const char *const others[] = {"spline", "convex_mesh", "brep"}; /* than a mesh */
    static const char *const naming[] = {"instance_geometry", "instance_controller", "instance_node"};
    collada_check *c = user;
    if (c->xml.status) return;
    c->depth++;
    if (!c->beyond && is_beyond(c, name)) c->beyond = c->depth;
    if (c->beyond) return;
    if (c->depth == 2) c->nodes = !strcmp(name, "library_nodes");
    for (size_t i = 0; i < sizeof defined / sizeof *defined; i++)
        if (!strcmp(name, defined[i]) && (!c->nodes || c->depth == 3)) define(c, attribute(attributes, "id"));
    if (!strcmp(name, "library_visual_scenes")) c->scenes = true;
    if (!strcmp(name, "node") && c->scenes && !c->nodes)
        define(c, attribute(attributes, "name")); /* by which assimp finds it, too */
    for (size_t i = 0; i < sizeof naming / sizeof *naming && !c->xml.status; i++)
        if (!strcmp(name, naming[i])) refer(c, naming[i], attribute(attributes, "url"), c->looking);
    if (!strcmp(name, "instance_controller")) io_leave(c->xml.sink, "skins", 5);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        c->xml.sink->report.skipped += c->geometry && c->depth == c->geometry + 1 && !strcmp(name, others[i]);
    if (!strcmp(name, "geometry")) c->geometry = c->depth;
    c->indices = !strcmp(name, "p");
    c->counts = !strcmp(name, "vcount");
    c->turns = !strcmp(name, "rotate");
    c->matrix = !strcmp(name, "matrix");
    c->numbers.count = 0;
    if (!c->xml.status && !strcmp(name, "trifans"))
        io_xml_refuse(&c->xml, FROE_E_UNSUPPORTED, "Fans of triangles (trifans) are not read.");
    if (!c->xml.status && !strcmp(name, "skew"))
        io_xml_refuse(&c->xml, FROE_E_UNSUPPORTED, "Skews are not read. A matrix is.");
    if (!strcmp(name, "lookat")) c->looking = c->looking ? c->looking : c->depth - 1;
    if (!c->xml.status) check_source(c, name, attributes);
    if (!c->xml.status) begin_part(c, name, attributes);
}

/* An axis may have been rounded to three digits. The last number of a matrix may be 1 as single precision rounds it. */
static void check_numbers(collada_check *c) {
    double at[16] = {0};
    char *from = c->numbers.data, *end;
    for (size_t i = 0; i < sizeof at / sizeof *at; i++, from = end) at[i] = support_decimal(from, &end);
    const double length = at[0] * at[0] + at[1] * at[1] + at[2] * at[2];
    if (c->turns && at[3] != 0 && !(fabs(length - 1) < 2e-3))
        io_xml_refuse(&c->xml, FROE_E_FORMAT, "The axis of a rotation has not the length 1.");
    if (c->matrix && !(at[12] == 0 && at[13] == 0 && at[14] == 0 && fabs(at[15] - 1) < 1e-6))
        io_xml_refuse(&c->xml, FROE_E_FORMAT, "The last row of a matrix is not 0, 0, 0 and 1.");
}

static void XMLCALL end_element(void *user, const char *name) {
    collada_check *c = user;
    if (c->has_x && !c->has_z && !c->beyond && !c->xml.status && !strcmp(name, "accessor"))
        io_xml_refuse(&c->xml, FROE_E_UNSUPPORTED, "Points with an X and no Z are not read.");
    if (!strcmp(name, "accessor") && !c->beyond && !c->xml.status && !(c->has_x && c->has_y && c->has_z) &&
        !array_push(&c->xml.sink->alloc, &c->unnamed, c->source))
        io_xml_stop(&c->xml, support_fail_memory(c->xml.sink->diag));
    if (!c->beyond && !c->xml.status) end_part(c, name);
    if (c->looking == c->depth) c->looking = 0;
    if (c->geometry == c->depth) c->geometry = 0;
    if (c->beyond == c->depth) c->beyond = 0;
    c->depth--;
    if ((c->turns || c->matrix) && !c->xml.status) {
        if (array_push(&c->xml.sink->alloc, &c->numbers, '\0'))
            check_numbers(c);
        else
            io_xml_stop(&c->xml, support_fail_memory(c->xml.sink->diag));
    }
    c->indices = c->counts = c->turns = c->matrix = false;
}

/* Indices and counts are whole numbers with blanks between them. */
static void check_whole(collada_check *c, const char *text, size_t length) {
    for (size_t i = 0; i < length && !c->xml.status; i++) {
        const bool digit = text[i] >= '0' && text[i] <= '9';
        const bool blank = text[i] && strchr(" \t\r\n", text[i]);
        c->given += digit && !c->digit;
        c->digit = digit;
        c->text_in = c->text_in || (c->indices && !blank);
        if (!digit && !blank)
            io_xml_refuse(&c->xml, FROE_E_FORMAT,
                          text[i] == '-' ? "An index is negative." : "An index or a count is no whole number.");
    }
}

static void XMLCALL read_text(void *user, const char *text, int length) {
    collada_check *c = user;
    if (c->indices || c->counts) check_whole(c, text, (size_t)length);
    if ((c->turns || c->matrix) && !c->xml.status &&
        !array_append(&c->xml.sink->alloc, &c->numbers, text, (size_t)length))
        io_xml_stop(&c->xml, support_fail_memory(c->xml.sink->diag));
}

static int order_names(const void *x, const void *y) {
    return strcmp(*(const char *const *)x, *(const char *const *)y);
}

/* Is everything there that is named? */
static froe_status check_names(collada_check *c) {
    ARRAY(const char *) ids = {0};
    if (!array_reserve(&c->xml.sink->alloc, &ids, c->ids.count)) return support_fail_memory(c->xml.sink->diag);
    for (size_t i = 0; i < c->ids.count; i++) ids.data[i] = c->text.data + c->ids.data[i];
    if (c->ids.count) qsort(ids.data, c->ids.count, sizeof *ids.data, order_names);
    for (size_t i = 0; i < c->named.count && !c->xml.status; i++) {
        const reference r = c->named.data[i];
        const char *name = c->text.data + r.name, *id = name + 1;
        if (*name == '#' && c->ids.count && bsearch(&id, ids.data, c->ids.count, sizeof *ids.data, order_names))
            continue;
        c->xml.status = support_fail(
            c->xml.sink->diag, FROE_E_FORMAT, "%s: line %lu: '%.80s', which %s names, is not in this file%s.",
            support_short(c->xml.sink->path), r.line, name, r.element,
            strcmp(r.element, "instance_node") ? "" : ", or is within a node of library_nodes");
    }
    array_free(&c->xml.sink->alloc, &ids);
    return c->xml.status;
}

static froe_status look(const formats_text *text, formats_sink *sink) {
    static const io_xml_handlers handlers = {begin_element, end_element, read_text};
    collada_check c = {.xml.sink = sink};
    bool whole;
    froe_status status = io_xml_look_at(&c.xml, text, &handlers, &whole);
    if (!status && whole) status = check_names(&c);
    array_free(&sink->alloc, &c.text);
    array_free(&sink->alloc, &c.numbers);
    array_free(&sink->alloc, &c.ids);
    array_free(&sink->alloc, &c.named);
    array_free(&sink->alloc, &c.unnamed);
    return status;
}

/* There is one model in an archive as a rule. Of several assimp reads that which a manifest names, or any. */
froe_status io_collada_check(const formats_source *source, formats_sink *sink) {
    const bool archive = !strcmp(source->extension.text, "zae") && !strncmp(source->head, "PK", 2);
    if (archive) return io_archive_look(source, sink, "dae", look);
    formats_text text = {0};
    froe_status status = formats_load_part(source, sink, 0, (size_t)source->size, &text);
    if (!status) status = look(&text, sink);
    array_free(&sink->alloc, &text);
    return status;
}
