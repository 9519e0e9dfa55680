/* places.c: whether places in GPX (version 1.1, and 1.0) and GML (versions 2 and 3) are numbers. GDAL takes what they
 * begin with, so that 48,5 is 48, and what is none for 0. Of GPX it leaves out places of a track without a latitude or
 * a longitude; between the numbers of a list of GML it takes a comma for a blank.
 *
 *     <trkpt lat="48.25" lon="11.5"/>                                      and so wpt and rtept
 *     <gml:Point><gml:pos>11.5 48.25</gml:pos></gml:Point>
 *     <gml:LineString><gml:posList>11.5 48.25 11.5 48.5</gml:posList></gml:LineString>
 *     <gml:LineString><gml:coordinates>11.5,48.25 11.5,48.5</gml:coordinates></gml:LineString>
 *     <gml:Point><gml:coord><gml:X>11.5</gml:X><gml:Y>48.25</gml:Y></gml:coord></gml:Point> */
#include "check/check.h"
#include "support/decimal/decimal.h"
#include <string.h>

static const char blanks[] = " \t\r\n";

/* ------------------------------------------------------------------- GPX -- */

static bool is_degrees(const char **attributes, const char *name) {
    char *end;
    while (*attributes && strcmp(attributes[0], name) != 0) attributes += 2;
    if (!*attributes) return false;
    const char *at = attributes[1] + strspn(attributes[1], blanks);
    (void)support_decimal(at, &end);
    return end != at && !end[strspn(end, blanks)];
}

static void XMLCALL look_at_point(void *user, const char *name, const char **attributes) {
    static const char *const points[] = {"wpt", "trkpt", "rtept"};
    io_xml *xml = user;
    for (size_t i = 0; i < sizeof points / sizeof *points && !xml->status; i++)
        if (!strcmp(io_xml_local(name), points[i]) && !(is_degrees(attributes, "lat") && is_degrees(attributes, "lon")))
            io_xml_refuse(xml, FROE_E_FORMAT, "A place has no lat and lon that are numbers with decimal points.");
}

froe_status io_gpx_check(const formats_source *source, formats_sink *sink) {
    io_xml xml = {.sink = sink};
    return io_xml_look(&xml, source, &(io_xml_handlers){.begin = look_at_point}, NULL);
}

/* ------------------------------------------------------------------- GML -- */

typedef struct gml_check {
    io_xml xml;
    enum { NOTHING, LIST, PAIRS, NUMBER } inside;
    size_t depth, geometry, place; /* of the element, from 1; of the geometry and the coord that it is in, or 0 */
    char point, other;             /* what decimal points are in PAIRS; what is between its numbers beside blanks */
    ARRAY(char) text;
} gml_check;

/* Elements of these names are places in a geometry alone. Other elements are data of any kind. */
static bool is_geometry(const char *name) {
    static const char *const names[] = {
        "Point",     "LineString", "LinearRing",          "LineStringSegment", "Arc",
        "ArcString", "Circle",     "CircleByCenterPoint", "ArcByCenterPoint",  "GeodesicString"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (!strcmp(name, names[i])) return true;
    return false;
}

static char mark_of(const char **attributes, const char *name, char otherwise) {
    for (; *attributes; attributes += 2)
        if (!strcmp(attributes[0], name)) return attributes[1][0];
    return otherwise;
}

static void XMLCALL begin_gml_element(void *user, const char *name, const char **attributes) {
    gml_check *c = user;
    if (c->xml.status) return;
    name = io_xml_local(name);
    c->depth++;
    c->inside = NOTHING;
    c->text.count = 0;
    if (is_geometry(name)) c->geometry = c->depth;
    const bool direct = c->geometry && c->geometry + 1 == c->depth;
    if (direct && !strcmp(name, "coord")) c->place = c->depth;
    if (direct && (!strcmp(name, "pos") || !strcmp(name, "posList"))) c->inside = LIST;
    if (direct && !strcmp(name, "coordinates")) {
        const char between[] = {mark_of(attributes, "cs", ','), mark_of(attributes, "ts", ' ')};
        c->inside = PAIRS;
        c->point = mark_of(attributes, "decimal", '.');
        c->other = strchr(blanks, between[0]) ? between[1] : between[0];
    }
    if (c->place && c->place + 1 == c->depth) c->inside = NUMBER;
}

static void XMLCALL read_gml_text(void *user, const char *text, int length) {
    gml_check *c = user;
    if (c->inside && !c->xml.status && !array_append(&c->xml.sink->alloc, &c->text, text, (size_t)length))
        io_xml_stop(&c->xml, support_fail_memory(c->xml.sink->diag));
}

static const char *pass_number(const char *at, char point) {
    static const char digits[] = "0123456789";
    at += *at == '+' || *at == '-';
    const size_t whole = strspn(at, digits), fraction = at[whole] == point ? strspn(at + whole + 1, digits) : 0;
    if (!whole && !fraction) return NULL;
    at += whole;
    if (*at == point) at += 1 + fraction;
    const char *power = at + 1 + (*at && (at[1] == '+' || at[1] == '-'));
    return (*at == 'e' || *at == 'E') && strspn(power, digits) ? power + strspn(power, digits) : at;
}

/* Between numbers are blanks, or what is in `other`. */
static bool are_numbers(const char *at, char point, const char *other) {
    for (at += strspn(at, blanks); *at;) {
        at = pass_number(at, point);
        if (!at || (*at && !strchr(blanks, *at) && !strchr(other, *at))) return false;
        while (*at && (strchr(blanks, *at) || strchr(other, *at))) at++;
    }
    return true;
}

/* Places of two or three numbers with one comma between them. Where blanks stand between the first numbers, GDAL takes
 * commas for what is between places. */
static bool is_pairs(const char *at, char point, char other) {
    const char between[] = {',', other, '\0'};
    const char *first = at + strspn(at, blanks), *behind = pass_number(first, point);
    if (point != '.' || other != ',' || (behind && *behind && strchr(blanks, *behind)))
        return are_numbers(at, point, between + (point == ','));
    for (at = first; *at; at += strspn(at, blanks)) {
        size_t count = 0;
        for (bool comma = true; comma; count++, at += comma) {
            at = pass_number(at, point);
            if (!at) return false;
            comma = *at == ',';
        }
        if (count < 2 || count > 3 || (*at && !strchr(blanks, *at))) return false;
    }
    return true;
}

static void XMLCALL end_gml_element(void *user, const char *name) {
    gml_check *c = user;
    (void)name;
    if (c->xml.status) return;
    if (c->inside && !array_push(&c->xml.sink->alloc, &c->text, '\0')) {
        io_xml_stop(&c->xml, support_fail_memory(c->xml.sink->diag));
        return;
    }
    if ((c->inside == LIST || c->inside == NUMBER) && !are_numbers(c->text.data, '.', ""))
        io_xml_refuse(&c->xml, FROE_E_FORMAT, "A place is not numbers with decimal points and blanks between them.");
    if (c->inside == PAIRS && !is_pairs(c->text.data, c->point, c->other))
        io_xml_refuse(&c->xml, FROE_E_FORMAT, "A place is not two or three numbers with decimal points.");
    c->inside = NOTHING;
    if (c->place == c->depth) c->place = 0;
    if (c->geometry == c->depth) c->geometry = 0;
    c->depth--;
}

froe_status io_gml_check(const formats_source *source, formats_sink *sink) {
    static const io_xml_handlers handlers = {begin_gml_element, end_gml_element, read_gml_text};
    gml_check c = {.xml.sink = sink};
    bool whole;
    const froe_status status = io_xml_look(&c.xml, source, &handlers, &whole);
    array_free(&sink->alloc, &c.text);
    return status;
}
