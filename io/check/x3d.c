/* x3d.c: what an X3D file (ISO/IEC 19776-1) may say that assimp passes over, so that the model would be another.
 *
 *     rotation, scaleOrientation   assimp stretches the model where the axis has another length than 1
 *     Cone                         assimp turns it upside down, and its side is torn
 *     coordIndex, index            assimp takes the first of numbers with commas and no blanks between them for all of
 *                                  them, and ends the program where a face has no corners
 *     IndexedLineSet, LineSet      assimp takes a line of more than two points for a face
 *     Collision, LOD, Text, ...    assimp leaves out what it does not know, with all shapes in it: these are named
 *
 * A text that is no XML gives no model, and no reason. */
#include "check/check.h"
#include "support/decimal/decimal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct x3d_check {
    io_xml xml;
    size_t depth;         /* of the element, from 1 */
    size_t shape, beyond; /* of the Shape, and of what assimp passes over, that it is in, or 0 */
    char passed[32];      /* the name of that; "": what is in it is shown elsewhere, if anywhere */
} x3d_check;

bool io_is_x3d(const formats_source *source) {
    return !strcmp(source->extension.text, "x3d");
}

static const char blanks[] = " \t\r\n";

static bool is_one_of(const char *name, const char *names) {
    const size_t length = strlen(name);
    for (const char *at = names; (at = strstr(at, name)); at++)
        if ((at == names || at[-1] == ' ') && (!at[length] || at[length] == ' ')) return true;
    return false;
}

/* Four numbers: an axis and an angle. Commas are blanks. */
static bool is_turn(const char *given) {
    double at[4] = {0};
    char *end;
    for (int i = 0; i < 4; i++, given = end) {
        given += strspn(given, " \t\r\n,");
        at[i] = support_decimal(given, &end);
    }
    const double length = at[0] * at[0] + at[1] * at[1] + at[2] * at[2];
    return at[3] == 0 || fabs(length - 1) < 2e-3; /* it may have been rounded to three digits */
}

/* A whole number, and a comma perhaps, with a blank behind them; NULL: there is something else. */
static const char *pass_index(const char *at, long *number) {
    char *end;
    *number = strtol(at, &end, 10);
    if (end == at) return NULL;
    end += *end == ',';
    return !*end || strchr(blanks, *end) ? end + strspn(end, blanks) : NULL;
}

/* Lists of corners with -1 between them, or of how many points lines have. */
static void look_at_list(x3d_check *c, const char *name, const char *attribute, const char *list) {
    const bool lines = is_one_of(name, "IndexedLineSet LineSet"), counts = !strcmp(attribute, "vertexCount");
    const bool faces = !counts && strcmp(name, "IndexedTriangleSet") != 0; /* which has nothing between them */
    size_t corners = 0;
    long number;
    for (list += strspn(list, blanks); !c->xml.status && *list;) {
        list = pass_index(list, &number);
        if (!list)
            io_xml_refuse(&c->xml, FROE_E_UNSUPPORTED, "Indices are not whole numbers with blanks between them.");
        else if (faces && number == -1 && !corners)
            io_xml_refuse(&c->xml, FROE_E_FORMAT, "A face or line has no corners.");
        else if (lines && (counts ? number > 2 : number != -1 && corners == 2))
            io_xml_refuse(&c->xml, FROE_E_UNSUPPORTED, "Lines of more than two points are not read.");
        corners = !counts && number == -1 ? 0 : corners + 1;
    }
}

static void XMLCALL enter_element(void *user, const char *name, const char **attributes) {
    static const char groups[] = "X3D Scene Group StaticGroup Transform Switch", elsewhere[] = "ProtoDeclare head";
    static const char shapes[] =
        "Appearance Arc2D ArcClose2D Box Circle2D Cone Cylinder Disk2D ElevationGrid Extrusion IndexedFaceSet "
        "IndexedLineSet IndexedTriangleFanSet IndexedTriangleSet IndexedTriangleStripSet LineSet PointSet Polyline2D "
        "Polypoint2D Rectangle2D Sphere TriangleFanSet TriangleSet TriangleSet2D MetadataBoolean MetadataDouble "
        "MetadataFloat MetadataInteger MetadataSet MetadataString";
    static const char others[] = "CoordinateDouble GeoCoordinate ProtoInstance"; /* wherever they are */
    x3d_check *c = user;
    if (c->xml.status) return;
    c->depth++;
    if (c->beyond) {
        if (*c->passed && is_one_of(name, "Shape ProtoInstance Inline"))
            io_leave(c->xml.sink, c->passed, strlen(c->passed));
        return;
    }
    if (is_one_of(name, others) || (c->shape && c->depth == c->shape + 1 && !is_one_of(name, shapes)))
        io_leave(c->xml.sink, name, strlen(name));
    if (c->shape && !strcmp(name, "Cone"))
        io_xml_refuse(&c->xml, FROE_E_UNSUPPORTED, "Cones are not read. Faces of an IndexedFaceSet are.");
    for (; c->shape && *attributes && !c->xml.status; attributes += 2)
        if (is_one_of(attributes[0], "coordIndex index vertexCount"))
            look_at_list(c, name, attributes[0], attributes[1]);
    if (c->shape) return;
    if (!strcmp(name, "Shape")) {
        c->shape = c->depth;
    } else if (!is_one_of(name, groups)) {
        c->beyond = c->depth;
        const size_t length = is_one_of(name, elsewhere) || strlen(name) >= sizeof c->passed ? 0 : strlen(name);
        memcpy(c->passed, name, length);
        c->passed[length] = '\0';
    }
    for (; *attributes && !strcmp(name, "Transform") && !c->xml.status; attributes += 2)
        if (is_one_of(attributes[0], "rotation scaleOrientation") && !is_turn(attributes[1]))
            io_xml_refuse(&c->xml, FROE_E_FORMAT, "The axis of a rotation has not the length 1.");
}

static void XMLCALL leave_element(void *user, const char *name) {
    (void)name;
    x3d_check *c = user;
    if (c->shape == c->depth) c->shape = 0;
    if (c->beyond == c->depth) c->beyond = 0;
    c->depth--;
}

froe_status io_x3d_check(const formats_source *source, formats_sink *sink) {
    x3d_check c = {.xml.sink = sink};
    return io_xml_look(&c.xml, source, &(io_xml_handlers){enter_element, leave_element, NULL}, NULL);
}
