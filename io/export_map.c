/* export_map.c: froe_export_map: parts of a tree as GeoPackage, FlatGeobuf and Shapefile, by the writers of OGR.
 *
 *     FOLDER/.froe-XXXXXX/NAME.gpkg    what OGR makes; it knows nothing of files that appear whole or not at all
 *     FOLDER/NAME.gpkg                 its copy, by support/writer.h
 *
 * A Shapefile is several files, which take their places one after the other, the one with the shapes last. */
#include "heard.h"
#include "support/floats.h"
#include "support/locale.h"
#include "support/path.h"
#include "support/utf8.h"
#include "support/writer.h"
#include <cpl_conv.h>
#include <cpl_string.h>
#include <dirent.h>
#include <errno.h>
#include <froe/io.h>
#include <gdal.h>
#include <inttypes.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Of a path that does not fit into PATH_OF_OGR bytes OGR may lose the folder, and write into the current one. */
enum { PATH_ROOM = 4096, PATH_OF_OGR = 2048, MOST_SIBLINGS = 8, TEXT_OF_DBF = 254 };
static const uint64_t number_of_dbf = 999999999999999999u; /* 18 digits: more would be read as a double */

/** A format of OGR. */
typedef struct map_format {
    const char *extension, *driver;
    bool tables;                 /**< dBASE: numbers and texts are limited */
    const char *const *options;  /**< of its layer */
    const char *const *siblings; /**< endings of other files that belong to it */
} map_format;

static const map_format *format_of(const char *path) {
    static const char *const utf8[] = {"ENCODING=UTF-8", NULL};
    static const char *const siblings[] = {"shx", "dbf", "prj", "cpg", "qix", "qpj", "sbn", "sbx", NULL};
    static const map_format formats[] = {{"gpkg", "GPKG", false, NULL, NULL},
                                         {"fgb", "FlatGeobuf", false, NULL, NULL},
                                         {"shp", "ESRI Shapefile", true, utf8, siblings}};
    const support_extension extension = support_path_extension(path);
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
        if (!strcmp(extension.text, formats[i].extension)) return formats + i;
    return NULL;
}

typedef struct map_export {
    const froe_scene *scene;
    const char *path;
    const map_format *format;
    froe_diagnostic *diag;
    froe_allocator alloc;
    io_heard heard;
    char folder[PATH_OF_OGR], file[PATH_OF_OGR], layer_name[256]; /* of OGR */
    GDALDatasetH data;
    OGRLayerH layer;
    OGRwkbGeometryType type; /* of all parts; wkbNone: there are none so far, wkbUnknown: of several */
    uint64_t written;
    ARRAY(char) text;
    char siblings[MOST_SIBLINGS][PATH_ROOM]; /* where the other files of a Shapefile go */
    froe_status status;
} map_export;

static froe_status export_fail(map_export *m, froe_status status, const char *sentence) {
    return io_gdal_fail(&m->heard, m->diag, status, m->path, sentence);
}

/* ------------------------------------------------------------------- parts -- */

/* A segment without length is a line all the same, whose ends are in one place. */
static bool is_short(const froe_part *part) {
    return part->sort == FROE_PART_POINTS && part->corners == 1 && part->kind == FROE_SEGMENT;
}

static OGRwkbGeometryType type_of(const froe_part *part) {
    if (is_short(part)) return wkbLineString;
    if (part->sort == FROE_PART_POINTS) return part->corners == 1 ? wkbPoint : wkbMultiPoint;
    return part->sort == FROE_PART_LINE ? wkbLineString : wkbPolygon;
}

/* Which types are there? */
static bool see_part(void *user, const froe_part *part) {
    map_export *m = user;
    const OGRwkbGeometryType type = type_of(part);
    m->type = m->type == wkbNone || m->type == type ? type : wkbUnknown;
    return m->type != wkbUnknown;
}

static OGRGeometryH geometry_of(const froe_part *part) {
    const OGRwkbGeometryType type = type_of(part);
    OGRGeometryH whole = OGR_G_CreateGeometry(type), points = whole;
    if (type == wkbPolygon) points = OGR_G_CreateGeometry(wkbLinearRing);
    for (size_t i = 0; i < part->corners; i++) {
        const double *at = part->coords + 2 * i;
        if (type != wkbMultiPoint) {
            OGR_G_AddPoint_2D(points, at[0], at[1]);
            continue;
        }
        OGRGeometryH point = OGR_G_CreateGeometry(wkbPoint);
        OGR_G_SetPoint_2D(point, 0, at[0], at[1]);
        OGR_G_AddGeometryDirectly(whole, point);
    }
    if (is_short(part)) OGR_G_AddPoint_2D(whole, part->coords[0], part->coords[1]);
    if (type != wkbPolygon) return whole;
    OGR_G_CloseRings(points);
    OGR_G_AddGeometryDirectly(whole, points);
    return whole;
}

/* Bytes that are no UTF-8 become U+FFFD, as in text files. NULL: no memory. */
static const char *clean_text(map_export *m, const char *text) {
    m->text.count = 0;
    while (*text) {
        const size_t length = support_utf8_length(text);
        if (!array_append(&m->alloc, &m->text, length ? text : "\xef\xbf\xbd", length ? length : 3)) return NULL;
        text += length ? length : 1;
    }
    return array_push(&m->alloc, &m->text, '\0') ? m->text.data : NULL;
}

static froe_status set_attribute(map_export *m, OGRFeatureH feature, int field, const froe_attribute *a,
                                 uint64_t object) {
    const bool tables = m->format->tables;
    if (a->missing) return OGR_F_SetFieldNull(feature, field), FROE_OK;
    if (!a->text) {
        if (a->number > (tables ? number_of_dbf : (uint64_t)INT64_MAX))
            return support_fail(m->diag, FROE_E_UNSUPPORTED,
                                "%s: object %" PRIu64 ": The %s %" PRIu64 " is larger than numbers of this format.",
                                support_short(m->path), object, a->name, a->number);
        return OGR_F_SetFieldInteger64(feature, field, (GIntBig)a->number), FROE_OK;
    }
    const char *text = clean_text(m, a->text);
    if (!text) return support_fail_memory(m->diag);
    if (tables && strlen(text) > TEXT_OF_DBF)
        return support_fail(m->diag, FROE_E_UNSUPPORTED,
                            "%s: object %" PRIu64 ": Its %s has more than %d bytes, the most that a Shapefile holds.",
                            support_short(m->path), object, a->name, TEXT_OF_DBF);
    OGR_F_SetFieldString(feature, field, text);
    return FROE_OK;
}

static bool write_part(void *user, const froe_part *part) {
    SUPPORT_FLOATS_OWN;
    map_export *m = user;
    OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(m->layer));
    for (int i = 0; i < part->attribute_count && !m->status; i++)
        m->status = set_attribute(m, feature, i, part->attributes + i, part->attributes[0].number);
    OGR_F_SetGeometryDirectly(feature, geometry_of(part));
    if (!m->status && OGR_L_CreateFeature(m->layer, feature) != OGRERR_NONE)
        m->status = export_fail(m, FROE_E_IO, "The file cannot be written.");
    OGR_F_Destroy(feature);
    m->written++;
    return !m->status;
}

/* ----------------------------------------------------------------- dataset -- */

static OGRSpatialReferenceH system_of(const froe_scene *scene) {
    const froe_crs crs = froe_scene_crs(scene);
    if (!crs.kind) return NULL;
    OGRSpatialReferenceH system = OSRNewSpatialReference(NULL);
    char *wkt = (char *)(uintptr_t)crs.wkt; /* only a definition: a name could make GDAL open files or connections */
    if (OSRImportFromWkt(system, &wkt) == OGRERR_NONE) {
        OSRSetAxisMappingStrategy(system, OAMS_TRADITIONAL_GIS_ORDER);
        return system;
    }
    OSRRelease(system);
    return NULL;
}

static froe_status create_layer(map_export *m, froe_export_what what) {
    const froe_part like = froe_part_like(what);
    GDALDriverH driver = GDALGetDriverByName(m->format->driver);
    if (!driver) return export_fail(m, FROE_E_UNSUPPORTED, "This GDAL does not write its format.");
    OGRSpatialReferenceH system = system_of(m->scene);
    if (!system && froe_scene_crs(m->scene).kind)
        return export_fail(m, FROE_E_UNSUPPORTED, "The coordinate system of the scene is none that GDAL knows.");
    m->data = GDALCreate(driver, m->file, 0, 0, 0, GDT_Unknown, NULL);
    if (m->data)
        m->layer = GDALDatasetCreateLayer(m->data, m->layer_name, system, m->type == wkbNone ? wkbUnknown : m->type,
                                          (char **)(uintptr_t)m->format->options);
    if (system) OSRRelease(system);
    bool made = m->layer;
    for (int i = 0; i < like.attribute_count && made; i++) {
        OGRFieldDefnH field =
            OGR_Fld_Create(like.attributes[i].name, like.attributes[i].text ? OFTString : OFTInteger64);
        made = OGR_L_CreateField(m->layer, field, FALSE) == OGRERR_NONE;
        OGR_Fld_Destroy(field);
    }
    return made ? FROE_OK : export_fail(m, FROE_E_IO, "The file cannot be written.");
}

/* What OGR wrote must be there: it does not tell of everything that went wrong when it closes a file. */
static froe_status check_dataset(map_export *m) {
    GDALDatasetH data = GDALOpenEx(m->file, GDAL_OF_VECTOR | GDAL_OF_READONLY, NULL, NULL, NULL);
    OGRLayerH layer = data ? GDALDatasetGetLayer(data, 0) : NULL;
    uint64_t found = 0;
    for (OGRFeatureH feature; layer && (feature = OGR_L_GetNextFeature(layer)); OGR_F_Destroy(feature))
        found += OGR_F_GetGeometryRef(feature) != NULL;
    const bool whole = layer && found == m->written && !m->heard.failed;
    if (data) GDALClose(data);
    return whole ? FROE_OK : export_fail(m, FROE_E_IO, "The file cannot be written to its end.");
}

static froe_status make_dataset(map_export *m, const froe_tree *tree, froe_export_what what,
                                const froe_export_options *options) {
    froe_export_options silent = *options;
    silent.progress = NULL;
    m->type = wkbNone;
    froe_status status = froe_tree_parts(tree, what, &silent, see_part, m, m->diag);
    if (!status && m->format->tables && m->type == wkbUnknown)
        status = support_fail(m->diag, FROE_E_UNSUPPORTED,
                              "%s: A Shapefile holds points, lines or polygons, and these are of several kinds.",
                              support_short(m->path));
    if (!status) status = create_layer(m, what);
    const bool steps = !status && GDALDatasetTestCapability(m->data, ODsCTransactions);
    if (steps && GDALDatasetStartTransaction(m->data, FALSE) != OGRERR_NONE)
        status = export_fail(m, FROE_E_IO, "The file cannot be written.");
    if (!status) status = froe_tree_parts(tree, what, options, write_part, m, m->diag);
    if (!status) status = m->status;
    if (!status && steps && GDALDatasetCommitTransaction(m->data) != OGRERR_NONE)
        status = export_fail(m, FROE_E_IO, "The file cannot be written.");
    if (m->data) GDALClose(m->data);
    return status ? status : check_dataset(m);
}

/* ------------------------------------------------------------------- files -- */

/* The same path with another ending. */
static void with_ending(const char *path, const char *ending, char *out) {
    snprintf(out, PATH_ROOM, "%.*s%s", (int)(strlen(path) - strlen(support_path_extension(path).text)), path, ending);
}

static froe_status copy_file(map_export *m, const char *from, support_writer *out) {
    char buffer[1 << 13];
    FILE *in = fopen(from, "rb");
    if (!in) return support_fail_file(m->diag, "written", m->path, errno);
    for (size_t got; (got = fread(buffer, 1, sizeof buffer, in)) > 0 && support_writer_put(out, buffer, got);) {
    }
    const bool failed = ferror(in);
    fclose(in);
    return failed ? support_fail_file(m->diag, "written", m->path, EIO) : FROE_OK;
}

/* The other files of a Shapefile. All are copied before the first takes its place; those of an older Shapefile that the
 * new one does not have are removed at last. */
static froe_status take_places(map_export *m, support_writer *whole) {
    support_writer out[MOST_SIBLINGS];
    bool open[MOST_SIBLINGS] = {false};
    char from[PATH_ROOM];
    const char *const none = NULL, *const *endings = m->format->siblings ? m->format->siblings : &none;
    froe_status status = copy_file(m, m->file, whole);
    for (int i = 0; endings[i] && !status; i++) {
        with_ending(m->file, endings[i], from);
        with_ending(m->path, endings[i], m->siblings[i]);
        if (access(from, R_OK) != 0) continue;
        status = support_writer_open(out + i, m->siblings[i], &m->alloc, m->diag);
        open[i] = !status;
        if (!status) status = copy_file(m, from, out + i);
    }
    for (int i = 0; endings[i]; i++)
        if (open[i]) status = support_writer_close(out + i, status);
    status = support_writer_close(whole, status);
    for (int i = 0; endings[i] && !status; i++)
        if (!open[i] && unlink(m->siblings[i]) && errno != ENOENT)
            status = support_fail_file(m->diag, "removed", m->siblings[i], errno);
    return status;
}

/* A GeoPackage may be the home of other layers, which would go with it. */
static froe_status check_old(map_export *m) {
    io_names others = {.count = 0};
    if (strcmp(m->format->extension, "gpkg") != 0 || access(m->path, F_OK) != 0) return FROE_OK;
    GDALDatasetH data = GDALOpenEx(m->path, GDAL_OF_VECTOR | GDAL_OF_READONLY, NULL, NULL, NULL);
    const int layers = data ? GDALDatasetGetLayerCount(data) : 0;
    for (int i = 0; i < layers; i++) {
        const char *name = OGR_L_GetName(GDALDatasetGetLayer(data, i));
        if (strcmp(name, m->layer_name) != 0) io_names_put(&others, name);
    }
    if (data) GDALClose(data);
    m->heard.failed = false; /* what is no GeoPackage is replaced like any other file */
    if (!others.count) return FROE_OK;
    return support_fail(m->diag, FROE_E_UNSUPPORTED, "%s: Other layers in the file would be lost: %s.",
                        support_short(m->path), others.text);
}

/* A new folder within one whose path has so many bytes, and the file in it. False: errno says why there is none. */
static bool make_folder_in(map_export *m, const char *path, int length, const char *name) {
    const size_t room = (size_t)snprintf(m->file, sizeof m->file, "%.*s.froe-XXXXXX/%s", length, path, name);
    if (room >= sizeof m->file) return errno = ENAMETOOLONG, false;
    snprintf(m->folder, sizeof m->folder, "%.*s", (int)(room - strlen(name) - 1), m->file);
    if (!mkdtemp(m->folder)) return *m->folder = '\0', false;
    memcpy(m->file, m->folder, strlen(m->folder));
    return true;
}

/* A folder for OGR beside the file, or where temporary files are. */
static froe_status make_folder(map_export *m) {
    const char *name = strrchr(m->path, '/'), *given = getenv("TMPDIR");
    char temporary[PATH_OF_OGR];
    name = name ? name + 1 : m->path;
    const int length = snprintf(temporary, sizeof temporary, "%s/", given && *given ? given : "/tmp");
    if (!make_folder_in(m, m->path, (int)(name - m->path), name) && !make_folder_in(m, temporary, length, name))
        return support_fail_file(m->diag, "written", m->path, errno);
    snprintf(m->layer_name, sizeof m->layer_name, "%.*s",
             (int)(strlen(name) - strlen(support_path_extension(name).text) - 1), name);
    return FROE_OK;
}

static void remove_folder(const map_export *m) {
    DIR *folder = *m->folder ? opendir(m->folder) : NULL;
    char file[2 * PATH_ROOM];
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        snprintf(file, sizeof file, "%s/%s", m->folder, entry->d_name);
        unlink(file); /* "." and ".." stay */
    }
    if (!folder) return;
    closedir(folder);
    rmdir(m->folder);
}

static froe_status export_map(map_export *m, const froe_tree *tree, froe_export_what what,
                              const froe_export_options *options) {
    support_writer out;
    froe_status status = support_writer_open(&out, m->path, &m->alloc, m->diag);
    if (status) return status;
    status = make_folder(m);
    m->heard.path = m->folder;
    io_gdal_begin(&m->heard);
    if (!status) status = check_old(m);
    if (!status) status = make_dataset(m, tree, what, options);
    io_gdal_end(&m->heard);
    status = status ? support_writer_close(&out, status) : take_places(m, &out);
    remove_folder(m);
    return status;
}

froe_status froe_export_map(const froe_tree *tree, const char *path, froe_export_what what,
                            const froe_export_options *options, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    const froe_export_options defaults = froe_export_defaults();
    const froe_allocator alloc = support_allocator(NULL);
    if (!tree || !path) return support_fail_null(diag, __func__);
    const froe_scene *scene = froe_tree_scene(tree);
    const map_format *format = format_of(path);
    if (froe_exports_own(path)) return froe_export(tree, path, what, options, diag);
    if (!format)
        return support_fail_ending(diag, FROE_E_UNSUPPORTED, path, "exports",
                                   ".geojson, .gpkg, .fgb or .shp for maps, .obj for space, and .csv for all");
    if (froe_scene_dim(scene) != 2)
        return support_fail(diag, FROE_E_UNSUPPORTED, "%s: Maps have dimension 2, and this scene has %d.",
                            support_short(path), froe_scene_dim(scene));
    support_locale locale;
    map_export *m = support_calloc(&alloc, 1, sizeof *m); /* paths: too much for a small stack */
    if (!m || !support_locale_enter(&locale)) {
        support_free(&alloc, m, sizeof *m);
        return support_fail_memory(diag);
    }
    m->scene = scene, m->path = path, m->format = format, m->diag = diag, m->alloc = alloc;
    const froe_status status = export_map(m, tree, what, options ? options : &defaults);
    support_locale_leave(&locale);
    array_free(&alloc, &m->text);
    support_free(&alloc, m, sizeof *m);
    return status;
}
