/* crs.c: GeoJSON is in longitudes and latitudes of WGS 84 (RFC 7946, section 4), unless it has a member `crs`, as
 * before that RFC; null says that nothing is known. TopoJSON extends GeoJSON, and names no system: what can be degrees
 * is taken for such, as other programs do; pixels, of which many of its files consist, cannot. */
#include "crs.h"
#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

void io_crs_free(io_crs *crs) {
    if (crs->system) OSRRelease(crs->system);
    crs->system = NULL;
}

static const char *behind_string(const char *at) {
    for (at++; *at && *at != '"'; at++) at += *at == '\\' && at[1];
    return at + (*at == '"');
}

static const char *behind_blanks(const char *at) {
    return at + strspn(at, " \t\r\n");
}

/* The value of the member `crs` of the object that a text begins with, in capitals or not. NULL: it has none. */
static const char *find_crs(const char *head) {
    static const char word[] = "\"crs\"";
    int depth = 0;
    for (const char *at = head; *at;) {
        if (*at != '"') {
            depth += (*at == '{' || *at == '[') - (*at == '}' || *at == ']');
            at++;
            continue;
        }
        const char *behind = behind_blanks(behind_string(at));
        if (depth == 1 && *behind == ':' && !strncasecmp(at, word, strlen(word))) return behind_blanks(behind + 1);
        at = behind;
    }
    return NULL;
}

/* Does the value of a member `crs`, whose only text is that name, say WGS 84? */
static bool names_degrees(const char *value) {
    static const char *const names[] = {"4326", "4979", "CRS84", "WGS84", "WGS 84"};
    const size_t length = strcspn(value, "}");
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        for (const char *at = value; (at = strstr(at, names[i])) && at < value + length; at++)
            if (at > value && !isalnum((unsigned char)at[-1]) && !isalnum((unsigned char)at[strlen(names[i])]))
                return true;
    return false;
}

/* Without the database of PROJ, GDAL takes a GeoJSON for WGS 84 whatever its `crs` says. */
static bool has_database(void) {
    OGRSpatialReferenceH probe = OSRNewSpatialReference(NULL);
    const bool has = OSRImportFromEPSG(probe, 4326) == OGRERR_NONE;
    OSRRelease(probe);
    return has;
}

io_crs_promise io_crs_promise_of(GDALDatasetH data) {
    const char *driver = GDALGetDriverShortName(GDALGetDatasetDriver(data));
    const bool topology = !strcmp(driver, "TopoJSON");
    char head[4096] = "";
    if (!topology && strncmp(driver, "GeoJSON", strlen("GeoJSON")) != 0) return IO_CRS_BY_FILE;
    char **files = GDALGetFileList(data); /* in an archive, the one within it */
    VSILFILE *file = files && *files ? VSIFOpenL(*files, "rb") : NULL;
    if (file) head[VSIFReadL(head, 1, sizeof head - 1, file)] = '\0';
    if (file) VSIFCloseL(file);
    CSLDestroy(files);
    const char *crs = find_crs(head);
    if (!has_database() || (crs && !strncmp(crs, "null", 4))) return IO_CRS_NONE;
    return topology ? IO_CRS_GUESSED : crs && !names_degrees(crs) ? IO_CRS_OTHER : IO_CRS_DEGREES;
}

static froe_crs_kind kind_of_system(OGRSpatialReferenceH system) {
    const double degree = 3.14159265358979323846 / 180;
    if (OSRIsProjected(system)) return FROE_CRS_PROJECTED;
    const bool degrees = OSRIsGeographic(system) && fabs(OSRGetAngularUnits(system, NULL) - degree) < 1e-9 * degree;
    return degrees ? FROE_CRS_GEOGRAPHIC : FROE_CRS_OTHER;
}

/* The system becomes that of the scene. What has no definition, because the database of PROJ is missing, is unknown. */
static froe_status describe(formats_sink *sink, OGRSpatialReferenceH system) {
    static const char *const wkt2[] = {"FORMAT=WKT2_2019", "MULTILINE=NO", NULL};
    char *wkt = NULL, *unit = NULL, code[64] = "";
    if (OSRExportToWktEx(system, &wkt, wkt2) != OGRERR_NONE || !wkt || !*wkt) {
        CPLFree(wkt);
        return FROE_OK;
    }
    const char *authority = OSRGetAuthorityName(system, NULL), *number = OSRGetAuthorityCode(system, NULL);
    if (authority && number) snprintf(code, sizeof code, "%s:%s", authority, number);
    froe_crs crs = {.kind = kind_of_system(system), .wkt = wkt, .name = OSRGetName(system), .code = code};
    if (OSRIsGeographic(system))
        (void)OSRGetAngularUnits(system, &unit);
    else
        (void)OSRGetLinearUnits(system, &unit);
    crs.unit = unit;
    const froe_status status = formats_sink_crs(sink, &crs);
    CPLFree(wkt);
    return status;
}

/* GeoPackages have two systems that stand for none (OGC 12-128r18, table 6). */
static bool is_undefined(OGRSpatialReferenceH system) {
    const char *name = OSRGetName(system);
    return name && (!strcmp(name, "Undefined geographic SRS") || !strcmp(name, "Undefined Cartesian SRS"));
}

/* WGS 84, in the plane or with heights? */
static bool is_default(OGRSpatialReferenceH system) {
    const char *code = OSRGetAuthorityCode(system, NULL);
    return code && (!strcmp(code, "4326") || !strcmp(code, "4979"));
}

static const char *name_of(OGRSpatialReferenceH system) {
    const char *name = system ? OSRGetName(system) : "none";
    return name ? name : "without a name";
}

static bool same(OGRSpatialReferenceH a, OGRSpatialReferenceH b) {
    static const char *const alike[] = {"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES",
                                        "CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS", NULL};
    return a && b ? OSRIsSameEx(a, b, alike) : a == b;
}

static froe_status take_system(io_crs *crs, formats_sink *sink, OGRLayerH layer) {
    OGRSpatialReferenceH system = crs->promise == IO_CRS_NONE ? NULL : OGR_L_GetSpatialRef(layer), made = NULL;
    froe_status status = FROE_OK;
    if (system && (is_undefined(system) || (crs->promise == IO_CRS_OTHER && is_default(system)))) system = NULL;
    if (!system && crs->promise == IO_CRS_GUESSED) {
        made = system = OSRNewSpatialReference(NULL);
        (void)OSRImportFromEPSG(made, 4326); /* there is a database */
    }
    if (!crs->any) {
        crs->any = true;
        crs->system = system ? OSRClone(system) : NULL;
        snprintf(crs->layer, sizeof crs->layer, "%s", OGR_L_GetName(layer));
        if (system && crs->wrap && kind_of_system(system) != FROE_CRS_GEOGRAPHIC)
            return support_fail(
                sink->diag, FROE_E_OPTIONS,
                "%s: Coordinates in '%.60s' are no longitudes and latitudes in degrees, and nothing can "
                "be cut at the antimeridian.",
                support_short(sink->path), name_of(system));
        if (system) status = describe(sink, system);
        sink->guessed = made != NULL;
        sink->promised = crs->promise == IO_CRS_DEGREES && system && OSRIsGeographic(system);
    } else if (!same(crs->system, system)) {
        status = support_fail(sink->diag, FROE_E_OPTIONS,
                              "%.50s: One layer must be named, because coordinate systems differ: of '%.20s' %.40s, of "
                              "'%.20s' %.40s.",
                              support_short(sink->path), crs->layer, name_of(crs->system), OGR_L_GetName(layer),
                              name_of(system));
    }
    if (made) OSRRelease(made);
    return status;
}

froe_status io_crs_take(io_crs *crs, formats_sink *sink, OGRLayerH layer) {
    CPLPushErrorHandler(
        CPLQuietErrorHandler); /* a system without a name or a definition keeps no map from being read */
    const froe_status status = take_system(crs, sink, layer);
    CPLPopErrorHandler();
    return status;
}
