/* gpx.c: whether places in GPX (version 1.1, and 1.0) are numbers. GDAL takes what they begin with, so that 48,5 is 48,
 * and leaves out places of a track without a latitude or a longitude.
 *
 *     <trkpt lat="48.25" lon="11.5"/>      and so wpt and rtept */
#include "check/check.h"
#include "support/decimal/decimal.h"
#include <string.h>

static bool is_degrees(const char **attributes, const char *name) {
    static const char blanks[] = " \t\r\n";
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
    const char *colon = strchr(name, ':');
    for (size_t i = 0; i < sizeof points / sizeof *points && !xml->status; i++)
        if (!strcmp(colon ? colon + 1 : name, points[i]) &&
            !(is_degrees(attributes, "lat") && is_degrees(attributes, "lon")))
            io_xml_refuse(xml, FROE_E_FORMAT, "A place has no lat and lon that are numbers with decimal points.");
}

froe_status io_gpx_check(const formats_source *source, formats_sink *sink) {
    io_xml xml = {.sink = sink};
    return io_xml_look(&xml, source, &(io_xml_handlers){.begin = look_at_point}, NULL);
}
