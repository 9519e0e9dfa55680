/* amf.c: what an AMF file (ISO/ASTM 52915) may say that assimp passes over, so that the model would be another.
 *
 *     rx, ry, rz       assimp takes the turn of an instance for a move, and forgets the move
 *     scalex, mirrorx  and the like, which PrusaSlicer writes, it leaves out
 *     volume, mesh     of several in a mesh or an object assimp reads one
 *
 * Turns by 0 are hidden from assimp, and so is where a volume ends and the next begins: all triangles are in the first
 * one then. Volumes of other materials or colours are refused. A text that is no XML gives no model, and no reason. */
#include "check/check.h"
#include "support/decimal/decimal.h"
#include <stdio.h>
#include <string.h>

/* What an instance may say, and the value that changes nothing. */
static const struct {
    const char *name;
    double neutral;
} parts[] = {{"rx", 0},     {"ry", 0},     {"rz", 0},      {"scale", 1},   {"scalex", 1},
             {"scaley", 1}, {"scalez", 1}, {"mirrorx", 1}, {"mirrory", 1}, {"mirrorz", 1}};
enum { TURNS = 3, PARTS = sizeof parts / sizeof *parts, NO_PART = PARTS };

typedef struct amf_check {
    io_xml xml;
    io_mask *mask;
    size_t volumes, meshes; /* of the mesh, and of the object */
    size_t end;             /* of the last volume: where its tag stands; 0: it has none */
    char material[64];      /* of the first volume */
    bool inside, triangle;  /* of a volume, of a triangle */
    bool apart;             /* a volume has a colour, or the vertices are behind it */
    size_t part, begin;     /* of the instance: which, and where its tag stands */
    char number[64];        /* its text, or the first letters of it */
} amf_check;

bool io_is_amf(const formats_source *source) {
    return !strcmp(source->extension.text, "amf") && strncmp(source->head, "PK", 2) != 0;
}

static size_t place_of_tag(const amf_check *c) {
    return (size_t)XML_GetCurrentByteIndex(c->xml.parser);
}

static void hide(amf_check *c, size_t place) {
    if (!array_push(&c->xml.sink->alloc, c->mask, place)) io_xml_stop(&c->xml, support_fail_memory(c->xml.sink->diag));
}

/* Does a volume go on with what the first one is? Then the tags between both are no tags. */
static void begin_volume(amf_check *c, const char **attributes) {
    const char *material = "";
    for (; *attributes; attributes += 2)
        if (!strcmp(attributes[0], "materialid")) material = attributes[1];
    c->inside = true;
    if (!c->volumes++) {
        snprintf(c->material, sizeof c->material, "%s", material);
    } else if (c->apart || !c->end || strcmp(c->material, material) != 0) {
        io_xml_refuse(&c->xml, FROE_E_UNSUPPORTED, "Objects of several volumes that differ are not read.");
    } else {
        hide(c, c->end);
        hide(c, place_of_tag(c));
    }
}

static void XMLCALL begin_amf_element(void *user, const char *name, const char **attributes) {
    amf_check *c = user;
    if (c->xml.status) return;
    if (!strcmp(name, "object")) c->meshes = 0;
    if (!strcmp(name, "mesh")) c->meshes++, c->volumes = 0, c->apart = false;
    if (c->meshes > 1) {
        io_xml_refuse(&c->xml, FROE_E_UNSUPPORTED, "Objects of several meshes are not read.");
        return;
    }
    if (!strcmp(name, "triangle")) c->triangle = true;
    if (!strcmp(name, "color") && c->inside && !c->triangle) c->apart = true;
    if (!strcmp(name, "vertices") && c->volumes) c->apart = true;
    if (c->apart && c->volumes > 1)
        io_xml_refuse(&c->xml, FROE_E_UNSUPPORTED, "Objects of several volumes that differ are not read.");
    else if (!strcmp(name, "volume"))
        begin_volume(c, attributes);
    for (c->part = 0; c->part < PARTS && strcmp(name, parts[c->part].name) != 0;) c->part++;
    c->begin = place_of_tag(c);
    *c->number = '\0';
}

static void end_part(amf_check *c) {
    char *end;
    const bool turn = c->part < TURNS;
    if (support_decimal(c->number, &end) != parts[c->part].neutral)
        io_xml_refuse(&c->xml, FROE_E_UNSUPPORTED,
                      turn ? "Turns of instances (rx, ry, rz) are not read."
                           : "Scales and mirrors of instances are not read.");
    if (turn && !c->xml.status) hide(c, c->begin + strlen("<"));
    if (turn && !c->xml.status && XML_GetCurrentByteCount(c->xml.parser)) hide(c, place_of_tag(c) + strlen("</"));
    c->part = NO_PART;
}

static void XMLCALL end_amf_element(void *user, const char *name) {
    amf_check *c = user;
    if (c->xml.status) return;
    if (!strcmp(name, "triangle")) c->triangle = false;
    if (!strcmp(name, "volume"))
        c->inside = false, c->end = XML_GetCurrentByteCount(c->xml.parser) ? place_of_tag(c) : 0;
    if (c->part < PARTS) end_part(c);
}

static void XMLCALL read_amf_text(void *user, const char *text, int length) {
    amf_check *c = user;
    const size_t used = strlen(c->number), room = sizeof c->number - 1 - used;
    if (c->part < PARTS) strncat(c->number, text, (size_t)length < room ? (size_t)length : room);
}

froe_status io_amf_check(const formats_source *source, formats_sink *sink, io_mask *mask) {
    static const io_xml_handlers handlers = {begin_amf_element, end_amf_element, read_amf_text};
    amf_check c = {.xml.sink = sink, .mask = mask, .part = NO_PART};
    return io_xml_look(&c.xml, source, &handlers, NULL);
}
