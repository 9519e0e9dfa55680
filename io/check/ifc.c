/* ifc.c: whether an IFC file (ISO 10303-21) names what assimp finds. It takes a name of nothing, or of a thing that
 * came with IFC4, for an address, and the program ends. A file that was cut off has such names, and so have most
 * of IFC4.
 *
 *     #60=IFCEXTRUDEDAREASOLID(#61,#11,#63,3.);   names 61, 11 and 63
 *
 * Looked at are those things alone that assimp follows, and in these what it knows is let be. */
#include "check/check.h"
#include <stdlib.h>
#include <string.h>

typedef struct entity {
    size_t id;
    const char *type; /* behind its '#', not ended */
} entity;

typedef struct ifc_check {
    const formats_source *source;
    formats_sink *sink;
    ARRAY(entity) entities;
} ifc_check;

bool io_is_ifc(const formats_source *source) {
    return !strncmp(source->head, "ISO-10303-21", 12); /* assimp looks no further */
}

/* clang-format off */
/* Shapes, and parts of buildings that have one, of IFC4 and later, without their "IFC", in the order of the alphabet.
 * assimp knows IFC2x3. */
static const char *const later[] = {
    "ACTUATOR", "ADVANCEDBREP", "ADVANCEDBREPWITHVOIDS", "AIRTERMINAL", "AIRTERMINALBOX", "AIRTOAIRHEATRECOVERY",
    "ALARM", "ALIGNMENT", "AUDIOVISUALAPPLIANCE", "AXIS2PLACEMENTLINEAR", "BEAMSTANDARDCASE", "BEARING", "BOILER",
    "BOUNDARYCURVE", "BRIDGE", "BRIDGEPART", "BSPLINECURVEWITHKNOTS", "BSPLINESURFACEWITHKNOTS", "BUILTELEMENT",
    "BURNER", "CABLECARRIERFITTING", "CABLECARRIERSEGMENT", "CABLEFITTING", "CABLESEGMENT", "CAISSONFOUNDATION",
    "CHILLER", "CHIMNEY", "CIVILELEMENT", "CLOTHOID", "COIL", "COLUMNSTANDARDCASE", "COMMUNICATIONSAPPLIANCE",
    "COMPOSITECURVEONSURFACE", "COMPRESSOR", "CONDENSER", "CONTROLLER", "COOLEDBEAM", "COOLINGTOWER", "COURSE",
    "CURVEBOUNDEDSURFACE", "CURVEONSURFACE", "CYLINDRICALSURFACE", "DAMPER", "DEEPFOUNDATION", "DOORSTANDARDCASE",
    "DUCTFITTING", "DUCTSEGMENT", "DUCTSILENCER", "EARTHWORKSELEMENT", "EARTHWORKSFILL", "ELECTRICAPPLIANCE",
    "ELECTRICDISTRIBUTIONBOARD", "ELECTRICFLOWSTORAGEDEVICE", "ELECTRICGENERATOR", "ELECTRICMOTOR",
    "ELECTRICTIMECONTROL", "ENGINE", "EVAPORATIVECOOLER", "EVAPORATOR", "EXTRUDEDAREASOLIDTAPERED", "FACILITY",
    "FACILITYPART", "FAN", "FILTER", "FIRESUPPRESSIONTERMINAL", "FIXEDREFERENCESWEPTAREASOLID", "FLOWINSTRUMENT",
    "FLOWMETER", "FURNITURE", "GEOGRAPHICELEMENT", "GRADIENTCURVE", "HEATEXCHANGER", "HUMIDIFIER",
    "INDEXEDPOLYCURVE", "INDEXEDPOLYGONALFACE", "INDEXEDPOLYGONALFACEWITHVOIDS", "INTERCEPTOR", "INTERSECTIONCURVE",
    "JUNCTIONBOX", "KERB", "LAMP", "LIGHTFIXTURE", "LINEARPLACEMENT", "MARINEFACILITY", "MEDICALDEVICE",
    "MEMBERSTANDARDCASE", "MIRROREDPROFILEDEF", "MOORINGDEVICE", "MOTORCONNECTION", "NAVIGATIONELEMENT",
    "OPENINGSTANDARDCASE", "OUTERBOUNDARYCURVE", "OUTLET", "PAVEMENT", "PCURVE", "PIPEFITTING", "PIPESEGMENT",
    "PLATESTANDARDCASE", "POLYGONALFACESET", "POLYNOMIALCURVE", "PROTECTIVEDEVICE", "PROTECTIVEDEVICETRIPPINGUNIT",
    "PUMP", "RAIL", "RAILWAY", "RATIONALBSPLINECURVEWITHKNOTS", "RATIONALBSPLINESURFACEWITHKNOTS",
    "REPARAMETRISEDCOMPOSITECURVESEGMENT", "REVOLVEDAREASOLIDTAPERED", "ROAD", "ROADPART", "SANITARYTERMINAL",
    "SEAMCURVE", "SECTIONEDSOLIDHORIZONTAL", "SEGMENTEDREFERENCECURVE", "SENSOR", "SHADINGDEVICE", "SIGN", "SIGNAL",
    "SLABELEMENTEDCASE", "SLABSTANDARDCASE", "SOLARDEVICE", "SPACEHEATER", "SPATIALZONE", "SPHERICALSURFACE",
    "STACKTERMINAL", "SURFACECURVE", "SWEPTDISKSOLIDPOLYGONAL", "SWITCHINGDEVICE", "SYSTEMFURNITUREELEMENT", "TANK",
    "TENDONCONDUIT", "TOROIDALSURFACE", "TRACKELEMENT", "TRANSFORMER", "TRIANGULATEDFACESET",
    "TRIANGULATEDIRREGULARNETWORK", "TUBEBUNDLE", "UNITARYCONTROLELEMENT", "UNITARYEQUIPMENT", "VALVE",
    "VIBRATIONISOLATOR", "WALLELEMENTEDCASE", "WASTETERMINAL", "WINDOWSTANDARDCASE"};

/* What assimp follows: it looks for shapes and placements, and for what stands in a storey. */
static const char *const followed[] = {
    "ARBITRARYCLOSEDPROFILEDEF", "ARBITRARYPROFILEDEFWITHVOIDS", "AXIS2PLACEMENT2D", "AXIS2PLACEMENT3D",
    "BOOLEANCLIPPINGRESULT", "BOOLEANRESULT", "CLOSEDSHELL", "COMPOSITECURVE", "COMPOSITECURVESEGMENT",
    "CONNECTEDFACESET", "DERIVEDPROFILEDEF", "EXTRUDEDAREASOLID", "FACE", "FACEBASEDSURFACEMODEL", "FACEBOUND",
    "FACEOUTERBOUND", "FACETEDBREP", "HALFSPACESOLID", "LOCALPLACEMENT", "MAPPEDITEM", "OPENSHELL", "PLANE",
    "POLYGONALBOUNDEDHALFSPACE", "POLYLINE", "POLYLOOP", "PRODUCTDEFINITIONSHAPE", "RECTANGLEPROFILEDEF",
    "RELAGGREGATES", "RELCONTAINEDINSPATIALSTRUCTURE", "RELVOIDSELEMENT", "REPRESENTATIONMAP", "REVOLVEDAREASOLID",
    "SHAPEREPRESENTATION", "SHELLBASEDSURFACEMODEL", "STYLEDITEM", "SURFACEOFLINEAREXTRUSION", "SWEPTDISKSOLID",
    "TRIMMEDCURVE"};
/* clang-format on */

static int order_names(const void *key, const void *one) {
    return strcmp(key, *(const char *const *)one);
}

/* The name of a type that begins at `at`, in capital letters and without its "IFC", cut where it is longer. */
static size_t copy_type(const char *at, char type[40]) {
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789abcdefghijklmnopqrstuvwxyz";
    const size_t length = strspn(at, letters), from = length > 3 ? 3 : length;
    size_t count = 0;
    for (size_t i = from; i < length && count < 39; i++)
        type[count++] = (char)(at[i] >= 'a' ? at[i] - 'a' + 'A' : at[i]);
    type[count] = '\0';
    return length;
}

static bool is_among(const char *at, const char *const *names, size_t count) {
    char type[40];
    copy_type(at, type);
    return bsearch(type, names, count, sizeof *names, order_names);
}
#define IS_AMONG(at, names) is_among(at, names, sizeof(names) / sizeof *(names))

static const char blanks[] = " \t\r\n";

/* Behind a text, a comment or any other character. */
static const char *pass_token(const char *at) {
    if (*at == '\'') {
        at += 1 + strcspn(at + 1, "'");
    } else if (at[0] == '/' && at[1] == '*') {
        const char *end = strstr(at + 2, "*/");
        at = end ? end + 1 : at + strlen(at);
    }
    return *at ? at + 1 : at;
}

static int order_entities(const void *x, const void *y) {
    const size_t a = ((const entity *)x)->id, b = ((const entity *)y)->id;
    return a < b ? -1 : a > b;
}

/* `#60 = IFCBLOCK(...);`: the number, and where the type begins; NULL: there is none. */
static const char *find_type(const char *at, size_t *id) {
    char *end;
    if (*at != '#') return NULL;
    *id = strtoul(at + 1, &end, 10);
    end += strspn(end, blanks);
    return *end == '=' ? end + 1 + strspn(end + 1, blanks) : NULL;
}

static froe_status list_entities(ifc_check *c, const char *text) {
    for (const char *at = text; *at; at = pass_token(at)) {
        entity e;
        e.type = find_type(at, &e.id);
        if (e.type && !array_push(&c->sink->alloc, &c->entities, e)) return support_fail_memory(c->sink->diag);
    }
    if (c->entities.count) qsort(c->entities.data, c->entities.count, sizeof *c->entities.data, order_entities);
    return FROE_OK;
}

static froe_status refuse_name(const ifc_check *c, const entity *by, size_t id, const entity *named) {
    char name[40], other[40];
    const char *path = support_short(c->source->path);
    copy_type(by->type, name);
    if (!named)
        return support_fail(c->sink->diag, FROE_E_FORMAT,
                            "%s: Entity #%zu, which #%zu (IFC%s) names, is not in the file.", path, id, by->id, name);
    copy_type(named->type, other);
    return support_fail(c->sink->diag, FROE_E_UNSUPPORTED,
                        "%s: Entity #%zu is an IFC%s, which came with IFC4 and is not read. IFC2x3 is.", path, id,
                        other);
}

/* Is everything there, and known, that an entity names? Parts of what is unknown are not looked for. */
static froe_status check_entity(const ifc_check *c, const entity *e) {
    char type[40];
    size_t count = 0;
    const bool parts = (copy_type(e->type, type), !strcmp(type, "RELAGGREGATES"));
    for (const char *at = e->type; *at && *at != ';'; at = pass_token(at)) {
        if (*at != '#') continue;
        const entity key = {.id = strtoul(at + 1, NULL, 10)};
        const entity *named =
            bsearch(&key, c->entities.data, c->entities.count, sizeof *c->entities.data, order_entities);
        const bool unknown = named && IS_AMONG(named->type, later);
        if (unknown && parts && count == 1) return FROE_OK; /* behind the owner stands what is divided */
        if (!named || unknown) return refuse_name(c, e, key.id, named);
        count++;
    }
    return FROE_OK;
}

froe_status io_ifc_check(const formats_source *source, formats_sink *sink) {
    ifc_check c = {.source = source, .sink = sink};
    formats_text text = {0};
    froe_status status = formats_load(source, sink, true, &text);
    if (!status && !strstr(text.data, "END-ISO-10303-21"))
        status = support_fail(sink->diag, FROE_E_FORMAT,
                              "%s: The file does not end with END-ISO-10303-21, so that parts may be missing.",
                              support_short(source->path));
    if (!status) status = list_entities(&c, text.data);
    for (size_t i = 0; i < c.entities.count && !status; i++)
        if (IS_AMONG(c.entities.data[i].type, followed)) status = check_entity(&c, c.entities.data + i);
    array_free(&sink->alloc, &c.entities);
    array_free(&sink->alloc, &text);
    return status;
}
