/* amf.c: what an AMF file (ISO/ASTM 52915) may say that assimp passes over, so that the model would be another.
 *
 *     rx, ry, rz       assimp takes the turn of an instance for a move, and forgets the move
 *     volume, mesh     of several in a mesh or an object assimp reads one
 *
 * A text that is no XML gives no model, and no reason. */
#include "check/check.h"
#include <string.h>

typedef struct amf_check {
    io_xml xml;
    size_t volumes, meshes; /* of the mesh, and of the object */
} amf_check;

bool io_is_amf(const formats_source *source) {
    return !strcmp(source->extension.text, "amf") && strncmp(source->head, "PK", 2) != 0;
}

static void XMLCALL look_at_element(void *user, const char *name, const char **attributes) {
    amf_check *c = user;
    (void)attributes;
    if (c->xml.status) return;
    if (!strcmp(name, "object")) c->meshes = 0;
    if (!strcmp(name, "mesh")) c->meshes++, c->volumes = 0;
    if (!strcmp(name, "volume")) c->volumes++;
    if (c->meshes > 1 || c->volumes > 1)
        io_xml_refuse(&c->xml, FROE_E_UNSUPPORTED, "Objects of several volumes or meshes are not read.");
    else if (!strcmp(name, "rx") || !strcmp(name, "ry") || !strcmp(name, "rz"))
        io_xml_refuse(&c->xml, FROE_E_UNSUPPORTED, "Turns of instances (rx, ry, rz) are not read.");
}

froe_status io_amf_check(const formats_source *source, formats_sink *sink) {
    amf_check c = {.xml.sink = sink};
    return io_xml_look(&c.xml, source, &(io_xml_handlers){.begin = look_at_element}, NULL);
}
