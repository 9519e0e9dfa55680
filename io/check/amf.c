/* amf.c: what an AMF file (ISO/ASTM 52915) may say that assimp passes over, so that the model would be another.
 *
 *     rx, ry, rz       assimp takes the turn of an instance for a move, and forgets the move
 *     volume, mesh     of several in a mesh or an object assimp reads one
 *
 * A text that is no XML gives no model, and no reason. */
#include "check/check.h"
#include <string.h>

typedef struct amf_check {
    formats_sink *sink;
    froe_status status;
    XML_Parser parser;
    size_t volumes, meshes; /* of the mesh, and of the object */
} amf_check;

bool io_is_amf(const formats_source *source) {
    return !strcmp(source->extension.text, "amf") && strncmp(source->head, "PK", 2) != 0;
}

static void refuse_line(amf_check *c, froe_status status, const char *sentence) {
    c->status = support_fail(c->sink->diag, status, "%s: line %lu: %s", support_short(c->sink->path),
                             (unsigned long)XML_GetCurrentLineNumber(c->parser), sentence);
    XML_StopParser(c->parser, XML_FALSE);
}

static void XMLCALL look_at_element(void *user, const char *name, const char **attributes) {
    amf_check *c = user;
    (void)attributes;
    if (c->status) return;
    if (!strcmp(name, "object")) c->meshes = 0;
    if (!strcmp(name, "mesh")) c->meshes++, c->volumes = 0;
    if (!strcmp(name, "volume")) c->volumes++;
    if (c->meshes > 1 || c->volumes > 1)
        refuse_line(c, FROE_E_UNSUPPORTED, "Objects of several volumes or meshes are not read.");
    else if (!strcmp(name, "rx") || !strcmp(name, "ry") || !strcmp(name, "rz"))
        refuse_line(c, FROE_E_UNSUPPORTED, "Turns of instances (rx, ry, rz) are not read.");
}

froe_status io_amf_check(const formats_source *source, formats_sink *sink) {
    amf_check c = {.sink = sink, .parser = XML_ParserCreate(NULL)};
    if (!c.parser) return support_fail_memory(sink->diag);
    XML_SetUserData(c.parser, &c);
    XML_SetStartElementHandler(c.parser, look_at_element);
    bool whole = true;
    const froe_status status = io_xml_parse(source, sink, c.parser, &whole);
    if (!status && !c.status && !whole && XML_GetErrorCode(c.parser) != XML_ERROR_UNKNOWN_ENCODING)
        refuse_line(&c, FROE_E_FORMAT, "The text is not well-formed XML.");
    XML_ParserFree(c.parser);
    return status ? status : c.status;
}
