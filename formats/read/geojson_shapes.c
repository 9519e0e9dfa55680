/* geojson_shapes.c: see geojson_shapes.h. How deep positions lie in arrays is seen before the type may be known:
 *
 *     1   [x,y]              Point
 *     2   [[x,y],...]        MultiPoint, LineString
 *     3   [[[x,y],...],...]  MultiLineString, Polygon
 *     4                      MultiPolygon */
#include "formats/read/geojson_shapes.h"
#include "formats/read/json_scan.h"

enum { MOST_NESTED = 16, MOST_LEVELS = 4 };

void geojson_shapes_free(const froe_allocator *alloc, geojson_shapes *shapes) {
    array_free(alloc, &shapes->points);
    array_free(alloc, &shapes->rings);
    array_free(alloc, &shapes->areas);
    array_free(alloc, &shapes->parts);
}

/* -------------------------------------------------------------- coordinates -- */

/* The position behind a bracket. */
static froe_status read_position(const froe_allocator *alloc, char **at, geojson_shapes *shapes) {
    double xy[2];
    if (!formats_scan_number(at, xy) || !formats_scan_byte(at, ',')) return FROE_E_UNSUPPORTED;
    formats_scan_blanks(at);
    if (!formats_scan_number(at, xy + 1) || !formats_scan_byte(at, ']')) return FROE_E_UNSUPPORTED;
    return array_append(alloc, &shapes->points, xy, 2) ? FROE_OK : FROE_E_MEMORY;
}

/* An array that lies so many levels above positions has ended. */
static bool end_array(const froe_allocator *alloc, geojson_shapes *shapes, int above) {
    if (above == 1) return array_push(alloc, &shapes->rings, shapes->points.count);
    if (above == 2) return array_push(alloc, &shapes->areas, shapes->rings.count);
    return true;
}

/* Arrays of positions that all lie at one depth, which becomes *level. None is empty. */
static froe_status read_coordinates(const froe_allocator *alloc, char **at, geojson_shapes *shapes, int *level) {
    int depth = 0;
    froe_status status = FROE_OK;
    *level = 0;
    do { /* a value begins */
        if (!formats_scan_byte(at, '[') || ++depth > MOST_LEVELS) return FROE_E_UNSUPPORTED;
        formats_scan_blanks(at);
        if (**at == '[') continue;
        if (*level && depth != *level) return FROE_E_UNSUPPORTED;
        *level = depth;
        status = read_position(alloc, at, shapes);
        if (status) return status;
        while (--depth && !formats_scan_byte(at, ',')) { /* arrays end */
            if (!formats_scan_byte(at, ']')) return FROE_E_UNSUPPORTED;
            if (!end_array(alloc, shapes, *level - depth)) return FROE_E_MEMORY;
        }
    } while (depth);
    return *level > 1 || end_array(alloc, shapes, 1) ? FROE_OK : FROE_E_MEMORY;
}

/* --------------------------------------------------------------- geometries -- */

static const struct {
    const char *name;
    geojson_kind kind;
    int level; /* of positions; 0: a collection */
    bool several;
} types[] = {{"Point", GEOJSON_POINTS, 1, false},          {"MultiPoint", GEOJSON_POINTS, 2, false},
             {"LineString", GEOJSON_LINE, 2, false},       {"MultiLineString", GEOJSON_LINE, 3, true},
             {"Polygon", GEOJSON_AREA, 3, false},          {"MultiPolygon", GEOJSON_AREA, 4, true},
             {"GeometryCollection", GEOJSON_AREA, 0, true}};
enum { TYPES = sizeof types / sizeof *types };

/* A geometry of which not all members are read. */
typedef struct open_geometry {
    int type, level;     /* TYPES: not known yet; -1: no coordinates yet */
    size_t rings, areas; /* the first of its own */
    bool collection;     /* it has a member `geometries`, */
    bool within;         /* in which the text stands */
    bool filled;         /* of which a geometry was read */
} open_geometry;

static int geometry_type(const formats_scan_text *name) {
    int type = 0;
    while (type < TYPES && !formats_scan_is(name, types[type].name)) type++;
    return type;
}

/* All members are read: its rings become parts. */
static froe_status end_geometry(const froe_allocator *alloc, geojson_shapes *shapes, const open_geometry *g) {
    if (g->type == TYPES || g->collection != !types[g->type].level) return FROE_E_UNSUPPORTED;
    if (g->collection) return g->level < 0 ? FROE_OK : FROE_E_UNSUPPORTED;
    if (g->level != types[g->type].level) return FROE_E_UNSUPPORTED;
    const geojson_kind kind = types[g->type].kind;
    const size_t rings = shapes->rings.count, ends = kind == GEOJSON_AREA ? shapes->areas.count : rings;
    for (size_t i = kind == GEOJSON_AREA ? g->areas : g->rings; i < ends; i++) {
        const geojson_part part = {kind, kind == GEOJSON_AREA ? shapes->areas.data[i] : i + 1};
        if (!array_push(alloc, &shapes->parts, part)) return FROE_E_MEMORY;
    }
    return FROE_OK;
}

/* A member of a geometry, whose name is read. */
static froe_status read_member(const froe_allocator *alloc, char **at, geojson_shapes *shapes, open_geometry *g,
                               const formats_scan_text *name) {
    formats_scan_text word;
    if (formats_scan_is(name, "type")) {
        if (g->type != TYPES || !formats_scan_string(at, &word)) return FROE_E_UNSUPPORTED;
        g->type = geometry_type(&word);
        return g->type == TYPES ? FROE_E_UNSUPPORTED : FROE_OK;
    }
    if (formats_scan_is(name, "coordinates")) {
        if (g->level >= 0) return FROE_E_UNSUPPORTED;
        g->rings = shapes->rings.count, g->areas = shapes->areas.count;
        return read_coordinates(alloc, at, shapes, &g->level);
    }
    if (formats_scan_is(name, "geometries")) {
        if (g->collection || !formats_scan_byte(at, '[')) return FROE_E_UNSUPPORTED;
        g->collection = g->within = true;
        return FROE_OK;
    }
    return formats_scan_is(name, "bbox") && formats_scan_skip(at) ? FROE_OK : FROE_E_UNSUPPORTED;
}

froe_status geojson_shapes_read(const froe_allocator *alloc, char **at, geojson_shapes *shapes) {
    static const open_geometry fresh = {.type = TYPES, .level = -1};
    open_geometry stack[MOST_NESTED] = {fresh};
    int depth = 1;
    bool first = true; /* of the members of the innermost geometry none was read yet */
    shapes->points.count = shapes->rings.count = shapes->areas.count = shapes->parts.count = 0;
    while (depth) {
        open_geometry *g = stack + depth - 1;
        formats_scan_text name;
        const formats_scan_step step =
            g->within ? formats_scan_item(at, !g->filled) : formats_scan_member(at, first, &name);
        froe_status status = FROE_OK;
        first = false;
        if (step == FORMATS_SCAN_ODD) return FROE_E_UNSUPPORTED;
        if (g->within && step == FORMATS_SCAN_END) {
            g->within = false;
        } else if (g->within) {
            g->filled = first = true;
            if (depth == MOST_NESTED || !formats_scan_byte(at, '{')) return FROE_E_UNSUPPORTED;
            stack[depth++] = fresh;
        } else if (step == FORMATS_SCAN_END) {
            status = end_geometry(alloc, shapes, g);
            depth--;
        } else {
            status = read_member(alloc, at, shapes, g, &name);
        }
        if (status) return status;
    }
    return FROE_OK;
}
