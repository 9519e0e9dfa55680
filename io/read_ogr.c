/* read_ogr.c: plane maps in all formats of OGR. The first failure that GDAL tells of becomes the diagnostic. */
#include "check/check.h"
#include "crs.h"
#include "formats/input/csv_header.h"
#include "heard.h"
#include "ogr_shapes.h"
#include "readers.h"
#include "support/text/csv.h"
#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <errno.h>
#include <fcntl.h>
#include <gdal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* -------------------------------------------------------------- features -- */

typedef struct map {
    const formats_source *source;
    formats_sink *sink;
    io_heard heard;
    GDALDatasetH data;
    io_shapes shapes;
    bool container;              /* a folder or an archive */
    bool is_table;               /* CSV, which may be in an archive */
    support_extension extension; /* that counts */
    OGRLayerH layer;             /* the fields below belong to it */
    const char *layer_name;
    int name_field, id_field, layer_field; /* -1: none */
    ARRAY(char) texts;                     /* of these, of a feature */
    uint64_t features_done;
    io_crs crs; /* of the layers so far */
} map;

static froe_status map_fail(map *m, froe_status status, const char *sentence) {
    return io_gdal_fail(&m->heard, m->sink->diag, status, m->source->path, sentence);
}

static bool is_model(support_extension extension) {
    const formats_source named = {.extension = extension};
    return io_assimp_recognise(&named);
}

/* Does the name in the virtual file systems of GDAL, or a file in the archive that it is, end as models do? That is
 * said: neither assimp nor the readers of the core look into archives. */
static froe_status refuse_model(map *m, const char *name) {
    char **files = m->container ? VSIReadDirRecursive(name) : NULL;
    const char *model = is_model(m->extension) ? m->source->path : NULL;
    for (char **file = files; file && *file && !model; file++)
        if (is_model(support_path_extension(*file))) model = *file;
    const froe_status status =
        model ? support_fail(m->sink->diag, FROE_E_FORMAT,
                             "%.60s: Models are not read from archives, and '%.60s' must be unpacked first.",
                             support_short(m->source->path), support_short(model))
              : FROE_OK;
    CSLDestroy(files);
    return status;
}

/* Is it a table of geometries alone? */
static bool is_single_column(const map *m) {
    const char *head = m->source->head;
    return !strcmp(m->extension.text, "csv") && formats_csv_has_geometry(m->source) &&
           strcspn(head, ",;\t") >= strcspn(head, "\r\n");
}

/* Says that nothing in it is a map; an archive is looked into. */
static froe_status refuse_content(map *m, const char *name) {
    const froe_status status = strncmp(name, "/vsi", 4) ? FROE_OK : refuse_model(m, name);
    if (status) return status;
    char **files = m->container && !m->source->beyond ? VSIReadDir(name) : NULL;
    io_names names = {.count = 0};
    for (char **file = files; file && *file; file++) io_names_put(&names, *file);
    CSLDestroy(files);
    if (names.count)
        return support_fail(m->sink->diag, FROE_E_FORMAT,
                            "%.60s: No single map is in it, but: %s. One of them is named %.60s/NAME.",
                            support_short(m->source->path), names.text, name);
    if (m->container && m->source->beyond && faccessat(AT_FDCWD, name, R_OK | X_OK, AT_EACCESS) && errno == EACCES)
        return support_fail_file(m->sink->diag, "read", m->source->path, EACCES);
    if (m->container && m->source->beyond)
        return map_fail(m, FROE_E_FORMAT, "It is a directory, and no map that can be read as a whole is in it.");
    if (formats_is_utf16(m->source)) return formats_refuse_utf16(m->source, m->sink);
    if (is_single_column(m))
        return support_fail(m->sink->diag, FROE_E_FORMAT,
                            "%s: GDAL reads no table of one column. Another, which may be empty, must stand beside the "
                            "geometry.",
                            support_short(m->source->path));
    return map_fail(m, FROE_E_FORMAT, "The file is of no type that can be read.");
}

static int find_field(OGRFeatureDefnH fields, const char *const *names) {
    for (; *names; ++names)
        for (int i = 0; i < OGR_FD_GetFieldCount(fields); ++i)
            if (support_equal_nocase(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(fields, i)), *names)) return i;
    return -1;
}

static const char *text_of(OGRFeatureH feature, int field) {
    return field >= 0 && OGR_F_IsFieldSetAndNotNull(feature, field) ? OGR_F_GetFieldAsString(feature, field) : "";
}

/* OGR keeps the text of a number in one place per feature: texts are copied before the next is asked. */
static froe_status name_feature(map *m, OGRFeatureH feature, GIntBig id, const formats_sides *sides) {
    const int fields[] = {m->name_field, m->id_field, m->layer_field};
    size_t begins[3];
    m->texts.count = 0;
    for (int k = 0; k < 3; k++) {
        const char *text = text_of(feature, fields[k]);
        begins[k] = m->texts.count;
        if (!array_append(&m->sink->alloc, &m->texts, text, strlen(text) + 1))
            return support_fail_memory(m->sink->diag);
    }
    const char *texts = m->texts.data, *material = texts + begins[2];
    const formats_feature_names names = {texts + begins[0], texts + begins[1], id,
                                         *material ? material : m->layer_name};
    return formats_feature_group(m->sink, &names, sides);
}

/* Has a geometry heights other than 0? DXF has heights everywhere; NaN is none. */
static bool has_heights(OGRGeometryH geometry) {
    OGREnvelope3D box = {.MinZ = 0};
    if (!OGR_GT_HasZ(OGR_G_GetGeometryType(geometry)) || OGR_G_IsEmpty(geometry)) return false;
    OGR_G_GetEnvelope3D(geometry, &box);
    return box.MinZ < 0 || box.MaxZ > 0;
}

/* What a table has in the place of the geometry; "": nothing. Of several such columns the first is read. */
static const char *written_geometry(const map *m, OGRFeatureH feature) {
    OGRGeomFieldDefnH read = OGR_F_GetGeomFieldCount(feature) ? OGR_F_GetGeomFieldDefnRef(feature, 0) : NULL;
    const char *wanted = read ? OGR_GFld_GetNameRef(read) : "";
    if (!*wanted) wanted = "WKT"; /* which has no name then */
    for (int i = 0; m->is_table && i < OGR_F_GetFieldCount(feature); ++i) {
        const char *name = OGR_Fld_GetNameRef(OGR_F_GetFieldDefnRef(feature, i)), *text = text_of(feature, i);
        const bool absent = !text[strspn(text, " ")] || support_equal_nocase(text, "NULL");
        if (!absent && support_equal_nocase(name, wanted)) return text;
    }
    return "";
}

/* GDAL says nothing of a text in a table that is no geometry. */
static froe_status check_absence(const map *m, OGRFeatureH feature) {
    const char *text = written_geometry(m, feature);
    if (!*text) return FROE_OK;
    return formats_sink_fail(m->sink, FROE_E_FORMAT, "Its geometry '%.40s' cannot be read.", text);
}

/* Where GDAL goes wrong in a well-known text that it reads; NULL: nowhere. It takes the 64th character of a number for
 * the first of another one. */
static const char *find_wkt_fault(const char *text, bool *number) {
    enum { MOST_CHARACTERS = 63 };
    bool ended = false;
    size_t depth = 0;
    for (size_t length; *text; text += length) {
        length = strcspn(text, " ;\t\r\n,()");
        *number = depth && length > MOST_CHARACTERS; /* outside of parentheses it is a geometry in hexadecimal digits */
        if (*number || (ended && !strchr(" ;\t\r\n", *text))) return text;
        depth += *text == '(';
        depth -= *text == ')';
        ended = ended || (*text == ')' && !depth);
        length += !length;
    }
    return NULL;
}

static froe_status check_text(const map *m, OGRFeatureH feature) {
    bool number;
    const char *text = written_geometry(m, feature), *fault = *text == '{' ? NULL : find_wkt_fault(text, &number);
    if (!fault) return FROE_OK;
    return formats_sink_fail(m->sink, FROE_E_FORMAT,
                             number ? "Of a number of more than 63 characters, '%.40s...', GDAL makes two."
                                    : "Behind its geometry stands '%.40s', which GDAL leaves out.",
                             fault);
}

static froe_status add_feature(map *m, OGRFeatureH feature) {
    formats_sink *sink = m->sink;
    GIntBig id = OGR_F_GetFID(feature);
    froe_status status = formats_sink_feature(sink, (uint64_t)id);
    if (status) return status;
    sink->tagged = id >= 0;
    sink->tag = (uint64_t)id;
    OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
    const bool curved = geometry && OGR_G_HasCurveGeometry(geometry, FALSE);
    if (curved) { /* a copy without curves */
        sink->report.linearised += OGR_G_HasCurveGeometry(geometry, TRUE) != 0;
        geometry = OGR_G_GetLinearGeometry(geometry, 0, NULL);
    }
    if (!geometry && curved) return formats_sink_fail(sink, FROE_E_FORMAT, "Its curves cannot be linearised.");
    if (!geometry) return ++sink->report.no_geometry, check_absence(m, feature);
    sink->report.flattened += has_heights(geometry);
    formats_sides sides;
    status = check_text(m, feature);
    if (!status) status = io_shapes_sides(sink, &m->shapes, geometry, &sides);
    if (!status) status = name_feature(m, feature, id, &sides);
    if (!status) status = io_shapes_add(sink, &m->shapes, geometry, &sides);
    if (curved) OGR_G_DestroyGeometry(geometry);
    return status;
}

/* The features of one layer, or of all. A file like OSM, that knows the layer of a feature only when it has read it,
 * gives all of them mixed. */
static froe_status add_features(map *m, OGRLayerH one) {
    enum { FEATURES_PER_REPORT = 256 };
    static const char *const names[] = {"name", "title", "label", NULL}, *const ids[] = {"id", NULL},
                             *const layers[] = {"layer", NULL};
    const bool reporting = m->sink->progress != NULL;
    froe_status status = FROE_OK;
    double expected = reporting && one ? (double)OGR_L_GetFeatureCount(one, FALSE) : -1, done = 0;
    if (one)
        OGR_L_ResetReading(one);
    else
        GDALDatasetResetReading(m->data);
    while (!status) {
        OGRLayerH layer = one;
        OGRFeatureH feature = one ? OGR_L_GetNextFeature(one)
                                  : GDALDatasetGetNextFeature(m->data, &layer, reporting ? &done : NULL, NULL, NULL);
        if (!feature) break;
        if (layer != m->layer) {
            OGRFeatureDefnH fields = OGR_L_GetLayerDefn(layer);
            m->layer = layer;
            m->layer_name = m->sink->inside = OGR_L_GetName(layer);
            m->name_field = find_field(fields, names);
            m->id_field = find_field(fields, ids);
            m->layer_field = find_field(fields, layers);
            status = io_crs_take(&m->crs, m->sink, layer);
        }
        if (!status) status = add_feature(m, feature);
        OGR_F_Destroy(feature);
        if (one) done = expected > 0 ? (double)m->features_done / expected : 0;
        if (!status && m->features_done++ % FEATURES_PER_REPORT == 0) status = formats_sink_progress(m->sink, done);
    }
    return status;
}

/* The first 28 bytes; *size: of all. */
static bool load_head(const char *name, unsigned char head[28], uint64_t *size) {
    VSILFILE *in = VSIFOpenL(name, "rb");
    const bool is_there = in && VSIFReadL(head, 1, 28, in) == 28 && !VSIFSeekL(in, 0, SEEK_END);
    if (is_there) *size = VSIFTellL(in);
    if (in) VSIFCloseL(in);
    return is_there;
}

/* GDAL reads as many shapes of a Shapefile as the head of its index (.shx) says, by its length in units of 2 bytes, the
 * highest byte first: 100 bytes, and 8 a shape. A program that was ended while it wrote has not counted them all. */
static froe_status check_index(const map *m, const char *index, uint64_t *shapes) {
    enum { HEAD = 100, SHAPE = 8 };
    unsigned char x[28];
    uint64_t size = 0;
    *shapes = 0;
    if (!load_head(index, x, &size)) return FROE_OK;
    const uint64_t length = 2 * ((uint64_t)x[24] << 24 | (uint64_t)x[25] << 16 | (uint64_t)x[26] << 8 | x[27]);
    const uint64_t there = size < HEAD ? 0 : (size - HEAD) / SHAPE;
    *shapes = length < HEAD ? 0 : (length - HEAD) / SHAPE;
    if (*shapes >= there) return FROE_OK;
    return support_fail(m->sink->diag, FROE_E_FORMAT,
                        "%.60s: The head of the index '%.60s' counts %llu shape%s, and there %s %llu.",
                        support_short(m->source->path), support_short(index), (unsigned long long)*shapes,
                        support_plural(*shapes), there == 1 ? "is" : "are", (unsigned long long)there);
}

/* So it does of the rows that the head of its table (.dbf) says, the lowest byte first. */
static froe_status check_rows(const map *m, const char *table, uint64_t shapes) {
    unsigned char t[28];
    uint64_t size;
    if (!load_head(table, t, &size)) return FROE_OK;
    const uint64_t rows = (uint64_t)t[7] << 24 | (uint64_t)t[6] << 16 | (uint64_t)t[5] << 8 | t[4];
    if (rows >= shapes) return FROE_OK;
    return support_fail(m->sink->diag, FROE_E_FORMAT,
                        "%.60s: The table '%.60s' has %llu row%s, and there are %llu shapes.",
                        support_short(m->source->path), support_short(table), (unsigned long long)rows,
                        support_plural(rows), (unsigned long long)shapes);
}

/* GDAL reads as many rows of the table of a MIF file (.mid) as that has objects; a line is a row. */
static froe_status check_lines(const map *m, const char *table) {
    VSILFILE *in = VSIFOpenL(table, "rb");
    size_t rows = 0;
    if (!in) return FROE_OK; /* one way: GDAL has read it just now */
    for (const char *line; (line = CPLReadLineL(in));) rows += line[strspn(line, " \t\r")] != '\0';
    VSIFCloseL(in);
    const size_t objects = (size_t)OGR_L_GetFeatureCount(GDALDatasetGetLayer(m->data, 0), TRUE);
    if (rows <= objects) return FROE_OK;
    return support_fail(m->sink->diag, FROE_E_FORMAT,
                        "%.60s: The table '%.60s' has %zu rows, and there %s %zu object%s.",
                        support_short(m->source->path), support_short(table), rows, objects == 1 ? "is" : "are",
                        objects, support_plural(objects));
}

/* GDAL takes a line of a table with an odd number of quotation marks for the beginning of a longer one, wherever they
 * stand, and so rows behind a name such as 5" pipe for a part of it. */
static froe_status check_quotes(const map *m) {
    VSILFILE *in = VSIFOpenL(GDALGetDescription(m->data), "rb");
    size_t number = 0, began = 0;
    char separator = '\0';
    bool within = false, odd = false;
    for (const char *line; in && odd == within && (line = CPLReadLineL(in));) {
        number++;
        if (!separator) separator = support_csv_separator(line);
        if (!within) began = number;
        within = support_csv_goes_on(line, separator, within);
        for (const char *at = line; (at = strchr(at, '"')); at++) odd = !odd;
    }
    if (in) VSIFCloseL(in);
    if (odd == within && !within) return FROE_OK;
    return support_fail(m->sink->diag, FROE_E_FORMAT, "%s: line %zu: %s", support_short(m->source->path),
                        odd == within ? began : number,
                        odd == within
                            ? "A quotation mark is not closed."
                            : "GDAL takes rows behind it for a part of it, because of a single quotation mark. "
                              "It must be doubled, and stand in a field that begins and ends with others.");
}

static froe_status check_tables(const map *m) {
    char **files = GDALGetFileList(m->data);
    froe_status status = FROE_OK;
    for (char **index = files; index && *index; index++) {
        const size_t stem = strlen(*index) < 3 ? 0 : strlen(*index) - 3;
        const bool is_index = support_equal_nocase(*index + stem, "shx");
        uint64_t shapes;
        if (!status && is_index) status = check_index(m, *index, &shapes);
        for (char **table = files; *table && !status && is_index; table++)
            if (!strncmp(*table, *index, stem) && support_equal_nocase(*table + stem, "dbf"))
                status = check_rows(m, *table, shapes);
        if (!status && support_equal_nocase(*index + stem, "mid")) status = check_lines(m, *index);
    }
    CSLDestroy(files);
    return status;
}

/* ----------------------------------------------------------------- layers -- */

static froe_status filter(map *m, OGRLayerH layer) {
    const char *where = m->source->options->where;
    if (!where) return FROE_OK;
    m->heard.failed = false;
    if (OGR_L_SetAttributeFilter(layer, where) == OGRERR_NONE) return FROE_OK;
    return map_fail(m, FROE_E_OPTIONS, "The attribute filter cannot be applied.");
}

static froe_status add_layers(map *m) {
    const char *wanted = m->source->options->layer;
    OGRLayerH one = wanted ? GDALDatasetGetLayerByName(m->data, wanted) : NULL;
    const int layers = GDALDatasetGetLayerCount(m->data);
    /* In folders, archives and GeoPackages they have nothing to do with each other; tables without geometry, such as
     * the styles of QGIS, are no maps. */
    const bool apart = m->container || !strcmp(m->sink->report.format, "GPKG");
    io_names maps = {.count = 0};
    for (int i = 0; i < layers; ++i) {
        OGRLayerH layer = GDALDatasetGetLayer(m->data, i);
        if (OGR_L_GetGeomType(layer) == wkbNone) continue;
        if (apart && !wanted) one = layer;
        io_names_put(&maps, OGR_L_GetName(layer));
    }
    if (wanted && !one)
        return support_fail(m->sink->diag, FROE_E_OPTIONS, "%.60s: There is no layer '%.40s'. There are: %s.",
                            support_short(m->source->path), wanted, maps.text);
    if (apart && !wanted && maps.count > 1)
        return support_fail(m->sink->diag, FROE_E_OPTIONS,
                            "%.60s: A layer must be named, because there are several: %s.",
                            support_short(m->source->path), maps.text);
    /* the layers of a topology are views of the same arcs: all of them would be the same lines again */
    if (!one && layers && !strcmp(m->sink->report.format, "TopoJSON")) one = GDALDatasetGetLayer(m->data, 0);
    froe_status status = FROE_OK;
    for (int i = 0; i < layers && !status && !one; ++i) status = filter(m, GDALDatasetGetLayer(m->data, i));
    if (!status && one) status = filter(m, one);
    m->sink->report.layers = one ? 1 : (uint64_t)layers;
    m->sink->report.layers_left = (uint64_t)layers - m->sink->report.layers;
    for (int i = 0; i < layers; ++i) /* a system that cannot be read is unknown; GDAL tells of it when first asked */
        (void)OGR_L_GetSpatialRef(GDALDatasetGetLayer(m->data, i));
    m->heard.failed = false; /* earlier failures did not keep the file from opening */
    if (!status) status = add_features(m, one);
    if (!status && m->heard.failed) status = map_fail(m, FROE_E_FORMAT, "The file cannot be read to its end.");
    if (!status) status = formats_sink_end_feature(m->sink);
    m->sink->inside = NULL;
    return status;
}

/* A file within others is named by the virtual file systems of GDAL; `inner` becomes the extension that counts. */
static const char *gdal_name(const formats_source *source, support_extension *inner) {
    static const char *const systems[][2] = {
        {"zip", "/vsizip/%s"}, {"gz", "/vsigzip/%s"}, {"tar", "/vsitar/%s"}, {"tgz", "/vsitar/%s"}, {NULL, "%s"}};
    size_t i = 0;
    *inner = source->extension;
    while (systems[i][0] && (source->beyond || strcmp(systems[i][0], inner->text) != 0)) i++;
    if (systems[i][0] && !strcmp(inner->text, "gz")) { /* map.csv.gz */
        char name[64];
        const size_t length = strlen(source->file) - strlen(".gz"), from = length < 32 ? 0 : length - 32;
        snprintf(name, sizeof name, "%.*s", (int)(length - from), source->file + from);
        *inner = support_path_extension(name);
    }
    return CPLSPrintf(systems[i][1], source->file);
}

/* A virtual file (VRT) names files, databases and services, which GDAL then opens, too. So a file must have the name of
 * one to be read as one. */
static froe_status refuse_virtual(map *m, const char *name) {
    static const char *const virtual[] = {"OGR_VRT", NULL};
    if (!strcmp(m->extension.text, "vrt") || !GDALIdentifyDriverEx(name, GDAL_OF_VECTOR, virtual, NULL)) return FROE_OK;
    return support_fail(m->sink->diag, FROE_E_FORMAT,
                        "%s: It is a virtual file, which names others, and its name does not end in .vrt.",
                        support_short(m->source->path));
}

/* Is it a table, perhaps the one file of an archive? */
static bool is_table(const char *name, support_extension extension) {
    char **files = strncmp(name, "/vsizip/", 8) ? NULL : VSIReadDirRecursive(name);
    if (CSLCount(files) == 1) extension = support_path_extension(files[0]);
    CSLDestroy(files);
    return !strcmp(extension.text, "csv") || !strcmp(extension.text, "tsv");
}

/* The source, or the table in it that is compressed or in an archive, of which GDAL reads the first bytes. */
static void find_inner(const formats_source *source, const char *name, formats_source *inner) {
    *inner = *source;
    if (!source->beyond && !strcmp(name, source->file)) return;
    VSILFILE *file = VSIFOpenL(name, "rb");
    const size_t got = file ? VSIFReadL(inner->head, 1, sizeof inner->head - 1, file) : 0;
    if (file) VSIFCloseL(file);
    inner->head[formats_drop_mark(inner->head, got)] = '\0';
}

/* Of tables with places GDAL reads x and y alone. The core reads the others, but not in archives. */
static froe_status refuse_columns(const map *m, formats_source *inner) {
    char *at = inner->head;
    formats_csv_table t;
    const bool ours = formats_csv_read_header(&at, &t) == FORMATS_CSV_OURS;
    const bool tagged = ours && memchr(t.role, FORMATS_CSV_TAG, (size_t)t.columns);
    if (!ours || (t.kind == FROE_POINT && t.dim == 2 && !tagged)) return FROE_OK;
    return support_fail(
        m->sink->diag, FROE_E_FORMAT,
        "%s: Of tables in archives only points of the plane without tags are read, and this one must be "
        "unpacked first.",
        support_short(m->source->path));
}

static froe_status open_data(map *m, const char *name) {
    /* columns with geometry have many names */
    static const char *const wkt[] = {"GEOM_POSSIBLE_NAMES=WKT,geometry,geom", NULL};
    static const char *const places[] = {"X_POSSIBLE_NAMES=x,lon,lng,long,longitude,easting",
                                         "Y_POSSIBLE_NAMES=y,lat,latitude,northing", NULL};
    static const char *const no_notes[] = {"WRITE_GFS=NO", NULL}; /* a file beside GML, of what is in it */
    const bool table = is_table(name, m->extension);
    formats_source inner;
    if (table) find_inner(m->source, name, &inner);
    const bool geometry = table && formats_csv_has_geometry(&inner);
    const froe_status status = table && !geometry ? refuse_columns(m, &inner) : FROE_OK;
    if (status) return status;
    const char *const *options = !strcmp(m->extension.text, "gml") ? no_notes : !table ? NULL : geometry ? wkt : places;
    m->data = GDALOpenEx(name, GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, NULL, options, NULL);
    return m->data ? FROE_OK : refuse_content(m, name);
}

/* Is there something that GDAL passes over in silence? */
static froe_status check_data(map *m) {
    const formats_source *source = m->source;
    const char *format = m->sink->report.format, *name = GDALGetDescription(m->data);
    const bool single = !source->beyond && !m->container;
    froe_status status = FROE_OK;
    if (single && !strcmp(m->extension.text, "mif")) status = io_mif_check(source, m->sink);
    if (single && !strcmp(format, "GPX")) status = io_gpx_check(source, m->sink);
    if (single && !strcmp(format, "GML")) status = io_gml_check(source, m->sink);
    if (single && !strcmp(format, "DXF")) status = io_dxf_check(source, m->sink);
    if (!status && (!strcmp(format, "ESRI Shapefile") || !strcmp(format, "MapInfo File"))) status = check_tables(m);
    if (!status && m->is_table) status = check_quotes(m);
    if (!status && m->shapes.cuts && strcmp(format, "GeoJSONSeq") != 0) status = io_json_check(name, m->sink);
    if (!status && !strcmp(format, "TopoJSON")) status = io_topojson_check(name, source->options->layer, m->sink);
    return status;
}

froe_status io_read_ogr(const formats_source *source, formats_sink *sink) {
    support_extension extension;
    const char *name = gdal_name(source, &extension);
    map m = {.source = source,
             .sink = sink,
             .heard = {.path = source->file, .online = source->beyond},
             .shapes.outlines.wrap = source->options->wrap,
             .crs.wrap = source->options->wrap};
    m.extension = extension;
    m.container = source->beyond ? strncmp(name, "/vsi", 4) != 0 : strcmp(name, source->file) != 0;
    sink->unit = "feature";
    froe_status status = formats_sink_open(sink, 2);
    if (status) return status;
    if (!strncmp(name, "/vsizip/", 8) && !source->beyond) status = io_stored_check(source, sink);
    const bool kml = !strcmp(extension.text, "kml") || !strcmp(extension.text, "kmz");
    if (!status && kml && !m.container && !source->beyond) status = io_kml_check(source, sink);
    io_gdal_begin(&m.heard);
    if (!status) status = refuse_virtual(&m, name);
    if (!status) status = open_data(&m, name);
    if (!status) {
        formats_report_format(sink, "float64", "%s", GDALGetDriverShortName(GDALGetDatasetDriver(m.data)));
        m.is_table = !strcmp(sink->report.format, "CSV");
        m.shapes.cuts = strstr(sink->report.format, "JSON") != NULL;
        m.crs.promise = io_crs_promise_of(m.data);
        status = check_data(&m);
        if (!status) status = add_layers(&m);
    }
    io_crs_free(&m.crs);
    if (m.data) GDALClose(m.data);
    io_gdal_end(&m.heard);
    const char *left = m.heard.left.text; /* whole names, each of less than 32 letters */
    const size_t used = strlen(sink->report.sorts_left), between = used ? 2 : 0;
    size_t fit = strlen(left);
    while (fit && (used + between + fit >= sizeof sink->report.sorts_left || (left[fit] && left[fit] != ','))) fit--;
    if (fit)
        snprintf(sink->report.sorts_left + used, sizeof sink->report.sorts_left - used, "%s%.*s", used ? ", " : "",
                 (int)fit, left);
    io_shapes_free(&sink->alloc, &m.shapes);
    array_free(&sink->alloc, &m.texts);
    return status;
}
