/* geojson.c: collections of features in plain GeoJSON (RFC 7946), in one pass over the text.
 *
 * It reads what most files have, into the scene that froe_read() makes of them by GDAL, and refuses everything else
 * with FROE_E_UNSUPPORTED: other coordinate systems than WGS 84 or none, single features, heights, and all that GDAL
 * takes although it is no GeoJSON. What GDAL refuses is refused here, but for features that take GDAL more than 200 MB.
 */
#include "formats/input/outline.h"
#include "formats/read/geojson_names.h"
#include "formats/read/geojson_shapes.h"
#include "formats/read/readers.h"
#include <string.h>

/* GDAL looks for the beginning of the features in the first 6000 bytes of a file, and for a denied coordinate system
 * io/crs.c does in 4095; a mark of 3 bytes may stand before the text. */
enum { FEATURES_WITHIN = 5900, HEAD = 6100, CRS_WITHIN = 4000, CRS_HEAD = 4200 };

typedef struct geojson {
    const formats_source *source;
    formats_sink *sink;
    formats_text text;
    char *at;
    geojson_shapes shapes;
    geojson_names names;
    formats_outlines outlines;
    const char *layer;
    bool named;         /* by a member, not by the file */
    const char *filled; /* where the first word "features" stands */
    bool denied;        /* the coordinate system: the file says that there is none */
    size_t crs, heads;  /* members of this name; words like that in the head of the file that are no such member */
    uint64_t features;
    froe_status refused; /* a feature cannot be an object; the text may still be left to GDAL */
} geojson;

/* What is known of a feature while its members are read. */
typedef struct open_feature {
    geojson_feature names;
    unsigned seen;
    bool shaped, described; /* its geometry, its properties are not null */
} open_feature;

static froe_status odd(const geojson *g, const char *sentence) {
    size_t line = 1;
    for (const char *at = g->text.data; at < g->at; at++) line += *at == '\n';
    return support_fail(g->sink->diag, FROE_E_UNSUPPORTED, "%s: line %zu: %s", support_short(g->sink->path), line,
                        sentence);
}

static froe_status odd_text(const geojson *g) {
    return odd(g, "What stands here is not plain GeoJSON, of which the core reads collections of features in two "
                  "dimensions.");
}

/* ---------------------------------------------------------------- a feature -- */

static froe_status add_parts(geojson *g, const formats_sides *sides) {
    const geojson_shapes *s = &g->shapes;
    froe_status status = FROE_OK;
    size_t ring = 0, point = 0;
    for (size_t i = 0; i < s->parts.count && !status; i++) {
        const geojson_part part = s->parts.data[i];
        const bool area = part.kind == GEOJSON_AREA;
        if (area) formats_sink_new_face(g->sink);
        for (; ring < part.end && !status; ring++) {
            const double *xy = s->points.data + point;
            const size_t count = (s->rings.data[ring] - point) / 2;
            point = s->rings.data[ring];
            for (size_t j = 0; part.kind == GEOJSON_POINTS && j < count && !status; j++)
                status = formats_outline_point(g->sink, &g->outlines, xy + 2 * j);
            if (part.kind != GEOJSON_POINTS) status = formats_outline_line(g->sink, &g->outlines, xy, count, area);
        }
        if (!status && part.kind != GEOJSON_POINTS)
            status = formats_outline_end(g->sink, &g->outlines, area ? sides : NULL);
    }
    return status;
}

static froe_status find_sides(geojson *g, formats_sides *sides) {
    const geojson_shapes *s = &g->shapes;
    froe_status status = FROE_OK;
    size_t ring = 0, point = 0;
    *sides = formats_sides_begin();
    for (size_t i = 0; i < s->parts.count; i++) {
        const geojson_part part = s->parts.data[i];
        const size_t first = ring;
        for (; ring < part.end && !status; point = s->rings.data[ring++])
            if (part.kind == GEOJSON_AREA)
                status = formats_sides_add(g->sink, &g->outlines, s->points.data + point,
                                           (s->rings.data[ring] - point) / 2, ring > first, sides);
    }
    formats_sides_end(sides);
    return status;
}

/* All of it was read: its objects come into the scene. */
static froe_status add_feature(geojson *g, const geojson_feature *feature, bool shaped) {
    geojson_labels labels;
    formats_sides sides;
    formats_sink *sink = g->sink;
    if (!geojson_label(&g->names, feature, &labels))
        return odd(g, "What features are called, or their numbers, is of several kinds, which is left to GDAL.");
    if (g->refused) return FROE_OK;
    froe_status status = formats_sink_feature(sink, (uint64_t)labels.number);
    sink->tagged = true;
    sink->tag = (uint64_t)labels.number;
    if (status || !shaped) return sink->report.no_geometry += !shaped, status;
    status = find_sides(g, &sides);
    const formats_feature_names names = {labels.name, labels.id, labels.number,
                                         *labels.material ? labels.material : g->layer};
    if (!status) status = formats_feature_group(sink, &names, &sides);
    g->outlines.wrapped = false;
    if (!status) status = add_parts(g, &sides);
    sink->report.wrapped += g->outlines.wrapped;
    return status;
}

/* The members of a feature. */
enum { TYPE = 1, PROPERTIES = 2, GEOMETRY = 4, MEMBERS = 7 };

/* Is it written like the word, but for capitals? GDAL takes such a member for that one. */
static bool is_like(const formats_scan_text *name, const char *word) {
    size_t i = 0;
    while (i < name->length && word[i] && (name->text[i] | 0x20) == word[i]) i++;
    return i == name->length && !word[i];
}

/* A member of a feature, whose name is read. */
static froe_status read_member(geojson *g, const formats_scan_text *name, open_feature *f) {
    static const char *const words[] = {"type", "properties", "geometry", "id"};
    formats_scan_text type;
    unsigned which = 0;
    while (which < 4 && !is_like(name, words[which])) which++;
    const bool doubled = which < 4 && f->seen >> which & 1;
    f->seen |= 1u << which;
    if (which == 4) return formats_scan_skip(&g->at) ? FROE_OK : odd_text(g);
    if (doubled || !formats_scan_is(name, words[which])) return odd_text(g);
    formats_scan_blanks(&g->at);
    const bool object = *g->at == '{';
    switch (1u << which) {
    case TYPE:
        return formats_scan_string(&g->at, &type) && formats_scan_is(&type, "Feature") ? FROE_OK : odd_text(g);
    case PROPERTIES:
        f->described = object;
        if (!object) return formats_scan_null(&g->at) ? FROE_OK : odd_text(g);
        return g->at++, geojson_read_properties(&g->at, &g->names, &f->names) ? FROE_OK : odd_text(g);
    case GEOMETRY:
        f->shaped = object;
        if (!object) return formats_scan_null(&g->at) ? FROE_OK : odd_text(g);
        g->at++;
        const froe_status status = geojson_shapes_read(&g->sink->alloc, &g->at, &g->shapes);
        return status == FROE_E_MEMORY ? support_fail_memory(g->sink->diag) : status ? odd_text(g) : FROE_OK;
    default:
        return geojson_read_id(&g->at, &f->names) ? FROE_OK : odd_text(g);
    }
}

static froe_status read_feature(geojson *g) {
    open_feature f = {.seen = 0};
    formats_scan_text name;
    formats_scan_step step;
    if (!formats_scan_byte(&g->at, '{')) return odd_text(g);
    for (bool first = true; (step = formats_scan_member(&g->at, first, &name)) == FORMATS_SCAN_MORE; first = false) {
        const froe_status status = read_member(g, &name, &f);
        if (status) return status;
    }
    const bool whole = (f.seen & MEMBERS) == MEMBERS;
    /* in place of properties that are null GDAL takes other members */
    if (step == FORMATS_SCAN_ODD || !whole || (!f.described && f.seen != MEMBERS)) return odd_text(g);
    return add_feature(g, &f.names, f.shaped);
}

/* ------------------------------------------------------------- the collection -- */

static froe_status read_features(geojson *g) {
    enum { FEATURES_PER_REPORT = 256 };
    formats_scan_step step;
    if (!formats_scan_byte(&g->at, '[') || g->at - g->text.data > FEATURES_WITHIN) return odd_text(g);
    for (bool first = true; (step = formats_scan_item(&g->at, first)) == FORMATS_SCAN_MORE; first = false) {
        froe_status status = read_feature(g);
        if (status == FROE_E_INPUT) g->refused = status, status = FROE_OK;
        if (!status && g->features++ % FEATURES_PER_REPORT == 0)
            status = formats_sink_progress(g->sink, (double)(g->at - g->text.data) / (double)g->text.count);
        if (status) return status;
    }
    return step == FORMATS_SCAN_END ? FROE_OK : odd_text(g);
}

/* The member `crs`: null, or the name of WGS 84 that programs wrote before RFC 7946. */
static froe_status read_crs(geojson *g, const char *name) {
    static const char usual[] = "{\"type\":\"name\",\"properties\":{\"name\":\"urn:ogc:def:crs:OGC:1.3:CRS84\"}}";
    g->heads -= name + strlen("crs\"") - g->text.data <= CRS_HEAD;
    formats_scan_blanks(&g->at);
    const char *value = g->at;
    if (g->crs++ || !formats_scan_skip(&g->at)) return odd_text(g);
    g->denied = *value == 'n' && value - g->text.data < CRS_WITHIN;
    if (g->denied) return FROE_OK;
    bool quoted = false;
    size_t length = 0;
    for (; value < g->at; value++) { /* but for blanks between its words */
        if (!quoted && strchr(" \n\r\t", *value)) continue;
        quoted ^= *value == '"';
        if (*value != usual[length++]) break;
    }
    return value == g->at ? FROE_OK : odd(g, "Other coordinate systems than WGS 84 are left to GDAL.");
}

/* A member of the collection behind the first, which is its type: formats_is_collection(). */
static froe_status read_root_member(geojson *g, formats_scan_text *name, bool *filled) {
    formats_scan_text text;
    if (is_like(name, "type")) {
        return odd_text(g);
    } else if (is_like(name, "features")) {
        if (*filled || !formats_scan_is(name, "features")) return odd_text(g);
        if (g->filled != name->text - 1) return odd_text(g); /* GDAL looks for the word alone */
        *filled = true;
        g->sink->inside = g->layer;
        return read_features(g);
    } else if (is_like(name, "crs")) {
        return formats_scan_is(name, "crs") ? read_crs(g, name->text) : odd_text(g);
    } else if (formats_scan_is(name, "name")) {
        if (*filled || g->named || !formats_scan_string(&g->at, &text)) return odd_text(g);
        g->named = true;
        g->layer = formats_scan_decode(&text);
    } else if (!formats_scan_skip(&g->at)) {
        return odd_text(g);
    }
    return FROE_OK;
}

/* Looks at what GDAL recognises files by. False: it may take this one for another format. */
static bool look_at_head(geojson *g) {
    static const char crs[] = "\"crs\"";
    g->filled = strstr(g->text.data, "\"features\"");
    const size_t length = g->text.count < HEAD ? g->text.count : HEAD;
    char *const end = g->text.data + length, after = *end;
    *end = '\0';
    const bool plain = !strstr(g->text.data, "\"Topology\"");
    for (const char *at = g->text.data; (at = strstr(at, crs)); at += strlen(crs))
        g->heads += at + strlen(crs) - g->text.data <= CRS_HEAD;
    *end = after;
    return plain;
}

static froe_status read_collection(geojson *g) {
    formats_scan_text name;
    formats_scan_step step;
    bool filled = false;
    if (!look_at_head(g) || !formats_scan_byte(&g->at, '{')) return odd_text(g);
    for (bool first = true; (step = formats_scan_member(&g->at, first, &name)) == FORMATS_SCAN_MORE; first = false) {
        const froe_status status = first && formats_scan_skip(&g->at) ? FROE_OK : read_root_member(g, &name, &filled);
        if (status) return status;
    }
    formats_scan_blanks(&g->at);
    if (step == FORMATS_SCAN_ODD || !filled || g->heads || g->at != g->text.data + g->text.count) return odd_text(g);
    if (!geojson_names_right(&g->names)) return odd(g, "All names of features may be dates, which are left to GDAL.");
    return g->refused;
}

/* As GDAL describes the coordinate system that the format promises. */
static froe_status promise_degrees(formats_sink *sink) {
    sink->promised = true;
    return formats_sink_crs(
        sink,
        &(froe_crs){.kind = FROE_CRS_GEOGRAPHIC,
                    .wkt = "GEOGCRS[\"WGS 84\",DATUM[\"World Geodetic System 1984\",ELLIPSOID[\"WGS 84\",6378137,"
                           "298.257223563,LENGTHUNIT[\"metre\",1]]],PRIMEM[\"Greenwich\",0,ANGLEUNIT[\"degree\","
                           "0.0174532925199433]],CS[ellipsoidal,2],AXIS[\"geodetic latitude (Lat)\",north,ORDER[1],"
                           "ANGLEUNIT[\"degree\",0.0174532925199433]],AXIS[\"geodetic longitude (Lon)\",east,ORDER[2],"
                           "ANGLEUNIT[\"degree\",0.0174532925199433]],ID[\"EPSG\",4326]]",
                    .name = "WGS 84",
                    .code = "EPSG:4326",
                    .unit = "degree"});
}

/* The name of the file without folders and its extension, as GDAL names a layer. It has an extension. */
static froe_status name_layer(geojson *g, formats_text *name) {
    const char *slash = strrchr(g->source->file, '/'), *backslash = strrchr(g->source->file, '\\');
    const char *begin = slash > backslash ? slash : backslash;
    begin = begin ? begin + 1 : g->source->file;
    const char *dot = strrchr(begin, '.');
    const size_t length = dot && dot > begin ? (size_t)(dot - begin) : strlen(begin);
    if (!array_append(&g->sink->alloc, name, begin, length) || !array_push(&g->sink->alloc, name, '\0'))
        return support_fail_memory(g->sink->diag);
    g->layer = name->data;
    return FROE_OK;
}

froe_status formats_read_geojson(const formats_source *source, formats_sink *sink) {
    geojson g = {.source = source, .sink = sink, .outlines.wrap = source->options->wrap};
    formats_text file = {0};
    if (source->options->layer || source->options->where)
        return support_fail(sink->diag, FROE_E_UNSUPPORTED, "%s: Layers and filters of GeoJSON are left to GDAL.",
                            support_short(source->path));
    sink->unit = "feature";
    formats_report_format(sink, "float64", "GeoJSON");
    sink->report.layers = 1;
    froe_status status = formats_sink_open(sink, 2);
    if (!status) status = formats_load(source, sink, true, &g.text);
    if (!status) status = name_layer(&g, &file);
    g.at = g.text.data;
    if (!status) status = read_collection(&g);
    if (!status && !g.denied && g.features) status = promise_degrees(sink);
    if (!status) status = formats_sink_end_feature(sink);
    sink->inside = NULL;
    geojson_shapes_free(&sink->alloc, &g.shapes);
    formats_outlines_free(&sink->alloc, &g.outlines);
    array_free(&sink->alloc, &file);
    array_free(&sink->alloc, &g.text);
    return status;
}
