/* kml.c: whether places in KML (OGC 12-007r2) are numbers. GDAL takes what is none for 0, and the fourth number of a
 * place for the next place, as where numbers have decimal commas. It ends the program where a track has more places
 * than times.
 *
 *     <coordinates>11.5,48.25 11.5,48.5,300</coordinates>
 *     <gx:Track><when>2020-01-01</when><gx:coord>11.5 48.25 300</gx:coord></gx:Track>
 *
 * Other files that are named (NetworkLink) are not read, and told of. */
#include "check/check.h"
#include "support/decimal/decimal.h"
#include <string.h>

typedef struct kml_check {
    io_xml xml;
    enum { NOTHING, LIST, PLACE } inside;
    ARRAY(char) text;     /* of it */
    size_t places, times; /* of a track */
} kml_check;

static void XMLCALL begin_kml_element(void *user, const char *name, const char **attributes) {
    kml_check *c = user;
    (void)attributes;
    if (c->xml.status) return;
    name = io_xml_local(name);
    c->inside = !strcmp(name, "coordinates") ? LIST : !strcmp(name, "coord") ? PLACE : NOTHING;
    c->text.count = 0;
    if (!strcmp(name, "Track")) c->places = c->times = 0;
    c->places += c->inside == PLACE;
    c->times += !strcmp(name, "when");
    if (!strcmp(name, "NetworkLink")) io_leave(c->xml.sink, name, strlen(name));
}

static void XMLCALL read_kml_text(void *user, const char *text, int length) {
    kml_check *c = user;
    if (c->inside && !c->xml.status && !array_append(&c->xml.sink->alloc, &c->text, text, (size_t)length))
        io_xml_stop(&c->xml, support_fail_memory(c->xml.sink->diag));
}

static const char blanks[] = " \t\r\n";

/* Passes two or three numbers with commas between them, and perhaps behind the third. */
static bool pass_place(const char **at) {
    size_t count = 0;
    for (bool comma = true; comma && count < 3; count++) {
        char *end;
        (void)support_decimal(*at, &end);
        if (end == *at) return false;
        const size_t between = strspn(end, blanks);
        comma = end[between] == ',';
        *at = comma ? end + between + 1 : end;
    }
    return count > 1 && (!**at || strchr(blanks, **at));
}

static bool is_list(const char *at) {
    for (at += strspn(at, blanks); *at; at += strspn(at, blanks))
        if (!pass_place(&at)) return false;
    return true;
}

/* Between its numbers is one blank each, and none before them: GDAL takes what is between two blanks for 0. */
static bool is_place(const char *at) {
    size_t count = 0;
    for (at += strspn(at, "\r\n"); count < 3 && *at && !strchr(blanks, *at); count++) {
        char *end;
        (void)support_decimal(at, &end);
        if (end == at) return false;
        at = end + (*end == ' ');
    }
    return count > 1 && !at[strspn(at, blanks)];
}

static void XMLCALL end_kml_element(void *user, const char *name) {
    kml_check *c = user;
    if (c->xml.status) return;
    if (c->inside && !array_push(&c->xml.sink->alloc, &c->text, '\0')) {
        io_xml_stop(&c->xml, support_fail_memory(c->xml.sink->diag));
        return;
    }
    const bool list = c->inside == LIST, place = c->inside == PLACE;
    c->inside = NOTHING;
    if (list && !is_list(c->text.data))
        io_xml_refuse(&c->xml, FROE_E_FORMAT, "A place is not two or three numbers with decimal points.");
    else if (place && !is_place(c->text.data))
        io_xml_refuse(&c->xml, FROE_E_FORMAT,
                      "A place of a track is not two or three numbers with one blank between them.");
    else if (!strcmp(io_xml_local(name), "Track") && c->places > c->times)
        io_xml_refuse(&c->xml, FROE_E_FORMAT, "A track has more places (gx:coord) than times (when).");
}

static froe_status look(const formats_text *text, formats_sink *sink) {
    static const io_xml_handlers handlers = {begin_kml_element, end_kml_element, read_kml_text};
    kml_check c = {.xml.sink = sink};
    const froe_status status = io_xml_look_at(&c.xml, text, &handlers, NULL);
    array_free(&sink->alloc, &c.text);
    return status;
}

froe_status io_kml_check(const formats_source *source, formats_sink *sink) {
    if (!strncmp(source->head, "PK", 2)) return io_archive_look(source, sink, "kml", look);
    formats_text text = {0};
    froe_status status = formats_load_part(source, sink, 0, (size_t)source->size, &text);
    if (!status) status = look(&text, sink);
    array_free(&sink->alloc, &text);
    return status;
}
