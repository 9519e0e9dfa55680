/* read_3mf.c: the meshes of a 3MF file (3MF Core Specification 1.3): a zip archive of parts in XML. A part defines
 * objects, which are meshes or consist of components, and the build says which objects stand where:
 *
 *   item --> object --> component --> object --> mesh
 *                   \-> component --> object of another part (3MF Production Extension) --> mesh
 *
 * Colours come from base materials and from colour groups (3MF Materials and Properties Extension). Coordinates are
 * decimal numbers, each rounded once. GDAL opens the archive, and expat parses its parts. Components are followed with
 * an explicit stack. */
#include "check/check.h"
#include "formats/input/colour.h"
#include "formats/input/paint.h"
#include "heard.h"
#include "readers.h"
#include "support/decimal/decimal.h"
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <expat.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NO_INDEX = -1 };

typedef struct resource { /* ids are unique within a part */
    uint32_t part, id;
} resource;

typedef struct placement { /* an item of the build, or a component */
    resource what;         /* the object */
    uint32_t depth;        /* components above it */
    double m[12];          /* (x, y, z, 1) times these four rows of three */
} placement;

typedef struct object {
    resource self;
    size_t name;                                          /* in `text` */
    size_t first_corner, first_triangle, first_component; /* up to those of the next object as defined */
    size_t corners, triangles, components;
    uint32_t properties; /* of triangles that name none; 0: none */
    int64_t index;
} object;

typedef struct triangle {
    int64_t corner[3], index[3]; /* of the object's vertices, and of the properties */
    uint32_t properties;
} triangle;

typedef struct properties { /* base materials or a group of colours */
    resource self;
    size_t first, count; /* in `colours` */
} properties;

typedef struct colour {
    uint32_t value;
    size_t name;     /* of a base material, in `text` */
    size_t instance; /* the last that used it, from 1, and its group */
    uint32_t group;
} colour;

typedef struct name_space {
    size_t prefix, name; /* in `text` */
} name_space;

typedef struct archive {
    const formats_source *source;
    formats_sink *sink;
    froe_status status;
    io_heard heard;
    XML_Parser parser;        /* of the current part */
    uint32_t part;            /* its number */
    ARRAY(size_t) parts;      /* their names, in `text`; part 0 is the root */
    ARRAY(name_space) spaces; /* of the current part */
    ARRAY(char) text;         /* names, each with a NUL; at 0 the empty one */
    ARRAY(double) points;     /* 3 a vertex */
    ARRAY(triangle) triangles;
    ARRAY(object) objects; /* as defined; when all are, by resource, as are the lists */
    ARRAY(placement) components, items;
    ARRAY(properties) lists;
    ARRAY(colour) colours;
    formats_paint paint; /* for triangles whose corners differ in colour */
    bool inside;         /* an object */
    size_t instances;
} archive;

bool io_3mf_recognise(const formats_source *source) {
    return !strncmp(source->head, "PK\3\4", 4) && !strcmp(source->extension.text, "3mf");
}

/* ----------------------------------------------------------------- parts -- */

/* The first failure counts, and ends the parsing of its part. */
static void fail(archive *a, const char *sentence) {
    if (a->status) return;
    a->status = support_fail(a->sink->diag, FROE_E_FORMAT, "%s: part '%.80s', line %lu: %s",
                             support_short(a->source->path), a->text.data + a->parts.data[a->part],
                             (unsigned long)XML_GetCurrentLineNumber(a->parser), sentence);
    XML_StopParser(a->parser, XML_FALSE);
}

static void check(archive *a, bool room) {
    if (room || a->status) return;
    a->status = support_fail_memory(a->sink->diag);
    XML_StopParser(a->parser, XML_FALSE);
}

static size_t keep_text(archive *a, const char *text) {
    const size_t at = a->text.count;
    if (!text || !*text) return 0;
    const bool room = array_append(&a->sink->alloc, &a->text, text, strlen(text) + 1);
    check(a, room);
    return room ? at : 0;
}

/* The number of a part by its name, which may begin with a slash; a new one if it was not named before. */
static uint32_t part_number(archive *a, const char *name) {
    name += strspn(name, "/");
    for (size_t i = 0; i < a->parts.count; i++)
        if (!strcmp(a->text.data + a->parts.data[i], name)) return (uint32_t)i;
    const size_t at = keep_text(a, name);
    check(a, array_push(&a->sink->alloc, &a->parts, at));
    return (uint32_t)a->parts.count - 1;
}

/* ------------------------------------------------------------ attributes -- */

/* Names of expat are "namespace|name"; the namespaces of 3MF have no two names that mean different things here. */
static const char *local(const char *name) {
    const char *bar = strrchr(name, '|');
    return bar ? bar + 1 : name;
}

static const char *attribute(const char **attributes, const char *name) {
    for (; *attributes; attributes += 2)
        if (!strcmp(local(attributes[0]), name)) return attributes[1];
    return NULL;
}

/* A whole number below 2^31; NO_INDEX if there is no such attribute. */
static int64_t whole(archive *a, const char **attributes, const char *name) {
    const char *given = attribute(attributes, name);
    if (!given) return NO_INDEX;
    char *end;
    const unsigned long long value = strtoull(given, &end, 10);
    if (*given < '0' || *given > '9' || *end || value > INT32_MAX) {
        fail(a, "An attribute is not a whole number below 2^31.");
        return NO_INDEX;
    }
    return (int64_t)value;
}

static uint32_t identifier(archive *a, const char **attributes, const char *name) {
    const int64_t value = whole(a, attributes, name);
    return value > 0 ? (uint32_t)value : 0;
}

/* As many numbers as there are in `to`, parted by blanks, and nothing else. */
static void numbers(archive *a, const char *given, double *to, int count) {
    char *end;
    bool good = given;
    for (int i = 0; good && i < count; i++, given = end) {
        to[i] = support_decimal(given, &end);
        good = end != given && isfinite(to[i]);
    }
    if (!good || given[strspn(given, " \t\r\n")]) fail(a, "A coordinate is missing or no finite number.");
}

static uint32_t colour_of(archive *a, const char *given) { /* #RRGGBB or #RRGGBBAA */
    const size_t digits = given && *given == '#' ? strspn(given + 1, "0123456789abcdefABCDEF") : 0;
    if ((digits != 6 && digits != 8) || given[1 + digits]) return fail(a, "A colour is not like #RRGGBB."), 0;
    const unsigned long value = strtoul(given + 1, NULL, 16);
    return (uint32_t)(digits == 6 ? value << 8 | 0xff : value);
}

/* -------------------------------------------------------------- elements -- */

static void XMLCALL declare_space(void *user, const char *prefix, const char *name) {
    archive *a = user;
    if (a->inside) return; /* prefixes are looked up at the beginning alone */
    const name_space space = {keep_text(a, prefix), keep_text(a, name)};
    if (!a->status) check(a, array_push(&a->sink->alloc, &a->spaces, space));
}

/* Those that are read, and those that say nothing of where faces are. */
static bool is_harmless(const char *extension) {
    static const char *const known[] = {"core/2015/02", "production/2015/06", "material/2015/02",
                                        "trianglesets/2021/07"};
    static const char about[] = "http://schemas.microsoft.com/3dmanufacturing/";
    if (strncmp(extension, about, strlen(about)) != 0) return false;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (!strcmp(extension + strlen(about), known[i])) return true;
    return false;
}

/* What the file requires is a list of prefixes (3.4.1 of the specification). */
static void check_required(archive *a, const char **attributes) {
    const char *words = attribute(attributes, "requiredextensions");
    for (size_t length; words && *words && !a->status; words += length) {
        words += strspn(words, " \t\r\n");
        length = strcspn(words, " \t\r\n");
        const char *name = NULL;
        for (size_t i = 0; i < a->spaces.count; i++) {
            const char *prefix = a->text.data + a->spaces.data[i].prefix;
            if (strlen(prefix) == length && !strncmp(prefix, words, length))
                name = a->text.data + a->spaces.data[i].name;
        }
        if (!length || (name && is_harmless(name))) continue;
        a->status = support_fail(
            a->sink->diag, FROE_E_UNSUPPORTED, "%s: The file requires the extension '%.*s' of 3MF, which is not read.",
            support_short(a->source->path), name ? 80 : (int)(length < 80 ? length : 80), name ? name : words);
        XML_StopParser(a->parser, XML_FALSE);
    }
}

static void define_object(archive *a, const char **attributes) {
    const object o = {.self = {a->part, identifier(a, attributes, "id")},
                      .name = keep_text(a, attribute(attributes, "name")),
                      .first_corner = a->points.count,
                      .first_triangle = a->triangles.count,
                      .first_component = a->components.count,
                      .properties = identifier(a, attributes, "pid"),
                      .index = whole(a, attributes, "pindex")};
    check(a, array_push(&a->sink->alloc, &a->objects, o));
    a->inside = true;
}

static void add_vertex(archive *a, const char **attributes) {
    double p[3];
    numbers(a, attribute(attributes, "x"), p, 1);
    numbers(a, attribute(attributes, "y"), p + 1, 1);
    numbers(a, attribute(attributes, "z"), p + 2, 1);
    if (!a->status) check(a, array_append(&a->sink->alloc, &a->points, p, 3));
}

static void add_triangle(archive *a, const char **attributes) {
    triangle t = {.properties = identifier(a, attributes, "pid")};
    static const char *const corner[] = {"v1", "v2", "v3"}, *const index[] = {"p1", "p2", "p3"};
    for (int k = 0; k < 3; k++) {
        t.corner[k] = whole(a, attributes, corner[k]);
        t.index[k] = whole(a, attributes, index[k]);
        if (t.index[k] == NO_INDEX) t.index[k] = t.index[0]; /* p1 alone is that of all corners */
        if (t.corner[k] == NO_INDEX) fail(a, "A triangle has no three vertices.");
    }
    check(a, array_push(&a->sink->alloc, &a->triangles, t));
}

static void add_place(archive *a, const char **attributes, bool component) {
    const char *path = attribute(attributes, "path"), *transform = attribute(attributes, "transform");
    placement p = {.what = {path ? part_number(a, path) : a->part, identifier(a, attributes, "objectid")},
                   .m = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}};
    if (transform) numbers(a, transform, p.m, 12);
    if (!p.what.id) fail(a, "A component or item names no object.");
    check(a, component ? array_push(&a->sink->alloc, &a->components, p) : array_push(&a->sink->alloc, &a->items, p));
}

static void add_colour(archive *a, const char **attributes, const char *name) {
    const colour c = {.value = colour_of(a, attribute(attributes, name)),
                      .name = keep_text(a, attribute(attributes, "name"))};
    if (!a->lists.count) return fail(a, "A colour is in no group.");
    a->lists.data[a->lists.count - 1].count++;
    check(a, array_push(&a->sink->alloc, &a->colours, c));
}

/* Images are not read. */
static void note_texture(archive *a, const char **attributes) {
    froe_read_report *r = &a->sink->report;
    const char *path = attribute(attributes, "path");
    if (a->sink->boxes) return;
    r->textures++;
    if (!r->unread++) snprintf(r->unread_name, sizeof r->unread_name, "%.63s", path ? path : "");
}

static void XMLCALL begin_element(void *user, const char *name, const char **attributes) {
    archive *a = user;
    name = local(name);
    if (a->status) return;
    if (!strcmp(name, "model")) check_required(a, attributes);
    if (!strcmp(name, "beamlattice") && a->inside) fail(a, "A lattice of beams is not read.");
    if (!strcmp(name, "vertex") && a->inside) add_vertex(a, attributes);
    if (!strcmp(name, "triangle") && a->inside) add_triangle(a, attributes);
    if (!strcmp(name, "object")) define_object(a, attributes);
    if (!strcmp(name, "component") && a->inside) add_place(a, attributes, true);
    if (!strcmp(name, "item") && !a->part) add_place(a, attributes, false);
    if (!strcmp(name, "texture2d")) note_texture(a, attributes);
    if (!strcmp(name, "base")) add_colour(a, attributes, "displaycolor");
    if (!strcmp(name, "color")) add_colour(a, attributes, "color");
    if (!strcmp(name, "basematerials") || !strcmp(name, "colorgroup")) {
        const properties list = {{a->part, identifier(a, attributes, "id")}, a->colours.count, 0};
        check(a, array_push(&a->sink->alloc, &a->lists, list));
    }
}

static void XMLCALL end_element(void *user, const char *name) {
    archive *a = user;
    if (!a->inside || strcmp(local(name), "object") != 0 || a->status) return;
    object *o = a->objects.data + a->objects.count - 1;
    o->corners = (a->points.count - o->first_corner) / 3;
    o->triangles = a->triangles.count - o->first_triangle;
    o->components = a->components.count - o->first_component;
    a->inside = false;
}

/* The root part is what _rels/.rels says, by a relationship whose type ends with 3dmodel. */
static void XMLCALL begin_relationship(void *user, const char *name, const char **attributes) {
    archive *a = user;
    const char *type = attribute(attributes, "Type"), *target = attribute(attributes, "Target");
    const char *slash = type ? strrchr(type, '/') : NULL;
    if (a->status || strcmp(local(name), "Relationship") != 0 || !slash || strcmp(slash, "/3dmodel") != 0 || !target)
        return;
    if (a->parts.count == 1) part_number(a, target);
}

static void parse_part(archive *a, uint32_t part, XML_StartElementHandler begin) {
    char chunk[1 << 15];
    const char *name = a->text.data + a->parts.data[part];
    a->part = part;
    a->spaces.count = 0;
    a->parser = XML_ParserCreateNS(NULL, '|');
    if (!a->parser) a->status = support_fail_memory(a->sink->diag);
    VSILFILE *in = a->status ? NULL : VSIFOpenL(CPLSPrintf("/vsizip/{%s}/%s", a->source->file, name), "rb");
    if (!a->status && !in)
        a->status = support_fail(a->sink->diag, FROE_E_FORMAT, "%s: The archive has no part '%.80s', or is damaged.",
                                 support_short(a->source->path), name);
    if (in) {
        XML_SetUserData(a->parser, a);
        XML_SetElementHandler(a->parser, begin, end_element);
        XML_SetStartNamespaceDeclHandler(a->parser, declare_space);
    }
    for (bool last = !in; !last && !a->status;) {
        const size_t got = VSIFReadL(chunk, 1, sizeof chunk, in);
        last = got < sizeof chunk;
        if (a->heard.failed)
            fail(a, "The part is damaged in the archive."); /* what is read of it may be XML all the same */
        else if (XML_Parse(a->parser, chunk, (int)got, last) == XML_STATUS_ERROR && !a->status) {
            if (XML_GetErrorCode(a->parser) == XML_ERROR_NO_MEMORY) check(a, false);
            fail(a, "The part is not well-formed XML.");
        }
        if (!a->status) a->status = formats_sink_progress(a->sink, 0.25);
    }
    if (in) VSIFCloseL(in);
    if (a->parser) XML_ParserFree(a->parser);
    a->parser = NULL;
}

/* ---------------------------------------------------------------- scene -- */

/* Of structures that begin with their resource. */
static int order_resources(const void *x, const void *y) {
    const resource *a = x, *b = y;
    if (a->part != b->part) return a->part < b->part ? -1 : 1;
    return a->id < b->id ? -1 : a->id > b->id;
}

static const void *find_resource(const resource *key, const void *all, size_t count, size_t size) {
    return count ? bsearch(key, all, count, size, order_resources) : NULL;
}

static froe_status broken(archive *a, const char *sentence, uint32_t id) {
    return support_fail(a->sink->diag, FROE_E_FORMAT, "%s: object with id %u: %s", support_short(a->source->path), id,
                        sentence);
}

/* NULL: there is none, or it is a texture or a mixture of materials, which are not read. */
static colour *find_colour(archive *a, const object *o, uint32_t list, int64_t index) {
    const resource key = {o->self.part, list};
    const properties *l = find_resource(&key, a->lists.data, a->lists.count, sizeof *l);
    return l && index >= 0 && (uint64_t)index < l->count ? a->colours.data + l->first + index : NULL;
}

/* The group of the triangle: one for each object and material, or for each mixture of colours at corners. */
static froe_status enter_group(archive *a, const object *o, const triangle *t, uint32_t *plain) {
    const bool own = t->index[0] != NO_INDEX; /* else the list and the index are the object's */
    const uint32_t list = own && t->properties ? t->properties : o->properties;
    uint32_t shades[3];
    colour *c = NULL;
    bool mixed = false, all = true;
    for (int k = 0; k < 3 && !a->sink->boxes; k++) {
        colour *at = find_colour(a, o, list, own ? t->index[k] : o->index);
        shades[k] = at ? at->value : 0;
        mixed = mixed || (k && shades[k] != shades[0]);
        all = all && at;
        if (!k) c = at;
    }
    if (mixed && all) return formats_paint_enter(a->sink, &a->paint, formats_paint_mean(shades, 3));
    uint32_t *group = c && !mixed ? &c->group : plain;
    if (c && !mixed && c->instance != a->instances) c->instance = a->instances, c->group = FROE_NONE;
    froe_status status = FROE_OK;
    if (*group == FROE_NONE) {
        const froe_group added = {.name = a->text.data + o->name,
                                  .material = c && !mixed ? a->text.data + c->name : "",
                                  .colour = c && !mixed ? c->value : 0};
        status = formats_sink_group(a->sink, &added);
        *group = a->sink->group;
    }
    a->sink->group = *group;
    return status;
}

static froe_status add_mesh(archive *a, const object *o, const double *m) {
    formats_sink *sink = a->sink;
    uint32_t plain = FROE_NONE;
    froe_status status = formats_sink_feature(sink, a->instances++);
    sink->inside = a->text.data + o->name;
    for (size_t i = 0; i < o->triangles && !status; i++) {
        const triangle *t = a->triangles.data + o->first_triangle + i;
        double corners[9];
        sink->number = i;
        for (int k = 0; k < 3; k++) {
            if ((uint64_t)t->corner[k] >= o->corners)
                return formats_sink_fail(sink, FROE_E_FORMAT, "The triangle names a vertex that does not exist.");
            const double *p = a->points.data + o->first_corner + 3 * (size_t)t->corner[k];
            for (int j = 0; j < 3; j++) corners[3 * k + j] = p[0] * m[j] + p[1] * m[3 + j] + p[2] * m[6 + j] + m[9 + j];
        }
        status = enter_group(a, o, t, &plain);
        if (!status) status = formats_sink_face(sink, corners, 3);
        if (!status && i % 8192 == 0) status = formats_sink_progress(sink, 0.75);
    }
    return status;
}

/* Items and their components, in the order of the file. A component of its own object would be deeper than there are
 * objects. */
static froe_status place_objects(archive *a) {
    ARRAY(placement) stack = {0};
    froe_status status = FROE_OK;
    for (size_t i = a->items.count; i-- > 0 && !status;)
        if (!array_push(&a->sink->alloc, &stack, a->items.data[i])) status = support_fail_memory(a->sink->diag);
    while (!status && stack.count) {
        const placement at = stack.data[--stack.count];
        const object *o = find_resource(&at.what, a->objects.data, a->objects.count, sizeof *o);
        if (!o)
            status = broken(a, "It is placed and not defined.", at.what.id);
        else if (at.depth > a->objects.count)
            status = broken(a, "It is a component of itself.", at.what.id);
        else if (o->triangles)
            status = add_mesh(a, o, at.m);
        for (size_t i = o ? o->components : 0; i-- > 0 && !status;) {
            const placement *c = a->components.data + o->first_component + i;
            placement next = {.what = c->what, .depth = at.depth + 1};
            for (int k = 0; k < 12; k++) {
                const double *row = c->m + k / 3 * 3;
                next.m[k] =
                    row[0] * at.m[k % 3] + row[1] * at.m[3 + k % 3] + row[2] * at.m[6 + k % 3] + (k >= 9 ? at.m[k] : 0);
            }
            if (!array_push(&a->sink->alloc, &stack, next)) status = support_fail_memory(a->sink->diag);
        }
        if (!status) status = formats_sink_progress(a->sink, 0.75);
    }
    array_free(&a->sink->alloc, &stack);
    return status;
}

static froe_status load_parts(archive *a) {
    const size_t relationships = 1; /* in `text`; they are part 0 until the root is known */
    if (!array_append(&a->sink->alloc, &a->text, "\0_rels/.rels", sizeof "\0_rels/.rels") ||
        !array_push(&a->sink->alloc, &a->parts, relationships))
        return support_fail_memory(a->sink->diag);
    if (!a->status) parse_part(a, 0, begin_relationship);
    if (!a->status && a->parts.count < 2)
        return support_fail(a->sink->diag, FROE_E_FORMAT, "%s: The archive names no 3D model.",
                            support_short(a->source->path));
    if (!a->status) a->parts.data[0] = a->parts.data[--a->parts.count];
    for (uint32_t part = 0; part < a->parts.count && !a->status; part++) parse_part(a, part, begin_element);
    if (a->status) return a->status;
    if (a->objects.count) qsort(a->objects.data, a->objects.count, sizeof *a->objects.data, order_resources);
    if (a->lists.count) qsort(a->lists.data, a->lists.count, sizeof *a->lists.data, order_resources);
    for (size_t i = 1; i < a->objects.count; i++)
        if (!order_resources(a->objects.data + i - 1, a->objects.data + i))
            return broken(a, "It is defined twice.", a->objects.data[i].self.id);
    return FROE_OK;
}

froe_status io_read_3mf(const formats_source *source, formats_sink *sink) {
    archive a = {.source = source, .sink = sink, .heard = {.path = source->file}};
    const froe_allocator *alloc = &sink->alloc;
    formats_report_format(sink, "float64", "3MF");
    sink->unit = "triangle";
    sink->report.layers = 1;
    froe_status status = formats_sink_open(sink, 3);
    if (!status) status = io_stored_check(source, sink);
    io_gdal_begin(&a.heard);
    if (!status) status = load_parts(&a);
    io_gdal_end(&a.heard);
    if (!status) status = place_objects(&a);
    if (!status) status = formats_sink_end_feature(sink);
    sink->inside = NULL;
    array_free(alloc, &a.parts);
    array_free(alloc, &a.spaces);
    array_free(alloc, &a.text);
    array_free(alloc, &a.points);
    array_free(alloc, &a.triangles);
    array_free(alloc, &a.objects);
    array_free(alloc, &a.components);
    array_free(alloc, &a.items);
    array_free(alloc, &a.lists);
    array_free(alloc, &a.colours);
    formats_paint_free(sink, &a.paint);
    return status;
}
