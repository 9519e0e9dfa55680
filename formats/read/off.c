/* off.c: the Object File Format of Geomview, as text, in double precision:
 * a header, counts of vertices, faces and (perhaps) edges, vertices, and faces as a count and that many indices.
 * Faces of two corners are segments, faces of one are points. Without faces the vertices are points. A face has the
 * colour that follows its indices, or else the mean of the colours of its corners.
 *
 *     COFF               the word may be missing; letters before it: what vertices carry (N normals, C colours, ST)
 *     4 1 0
 *     0 0 0 255 0 0 255  shares from 0 to 255, or with decimal points from 0 to 1; the fourth, opacity, may be missing
 *     ...
 *     3 0 1 2 0.5 0 0
 */
#include "formats/input/colour.h"
#include "formats/input/paint.h"
#include "formats/read/readers.h"
#include "support/decimal/decimal.h"
#include <stdlib.h>
#include <string.h>

typedef struct off {
    const formats_source *source;
    formats_sink *sink;
    const char *begin, *at;
    size_t length;
    bool extras;            /* vertices carry something behind their coordinates, to the end of the line */
    bool normals, coloured; /* of it, what is read */
    uint64_t vertices, faces;
    ARRAY(uint32_t) corners; /* of a face */
    ARRAY(uint32_t) colours; /* of vertices; as many as points when `coloured` */
    ARRAY(uint32_t) shades;  /* of the corners of a face */
    formats_paint paint;
} off;

static froe_status broken_off(off *o, const char *sentence) {
    size_t line = 1;
    for (const char *c = o->begin; c < o->at; ++c) line += *c == '\n';
    return support_fail(o->sink->diag, FROE_E_FORMAT, "%s: line %zu: %s", support_short(o->source->path), line,
                        sentence);
}

static void skip_blanks(off *o) {
    for (;;) {
        while (*o->at == ' ' || *o->at == '\n' || *o->at == '\t' || *o->at == '\r') o->at++;
        if (*o->at != '#') return;
        o->at += strcspn(o->at, "\n");
    }
}

static void skip_line(off *o) {
    o->at += strcspn(o->at, "\n");
}

static bool number(off *o, double *value) {
    char *end;
    skip_blanks(o);
    *value = support_decimal_ahead(o->at, &end);
    bool found = end != o->at;
    o->at = end;
    return found;
}

static bool whole(off *o, uint64_t *value) {
    enum { MOST_DIGITS = 18 };
    skip_blanks(o);
    const char *first = o->at;
    char *end;
    for (*value = 0; *o->at >= '0' && *o->at <= '9'; o->at++) *value = 10 * *value + (uint64_t)(*o->at - '0');
    if (o->at - first > MOST_DIGITS) *value = strtoull(first, &end, 10); /* the greatest where it is too great */
    return o->at > first;
}

/* Up to four shares on the rest of the line, as a colour; 0: there are not three. */
static uint32_t rest_colour(off *o) {
    double shares[4] = {0, 0, 0, 1};
    bool whole_numbers = true;
    int count = 0;
    while (count < 4) {
        char *end;
        while (*o->at == ' ' || *o->at == '\t' || *o->at == '\r') o->at++;
        if (!*o->at || !strchr("+-.0123456789", *o->at)) break;
        const double share = support_decimal_ahead(o->at, &end);
        if (end == o->at) break;
        shares[count++] = share;
        for (; o->at < end; o->at++) whole_numbers = whole_numbers && *o->at != '.' && (*o->at | 0x20) != 'e';
    }
    if (count < 3) return 0;
    for (int k = 0; whole_numbers && k < count; k++) shares[k] /= 255;
    return formats_colour(shares);
}

/* Passes over the count of edges, which is the third on its line, or alone on a line, or not there. */
static void skip_edges(off *o) {
    o->at += strspn(o->at, " \t\r");
    if (*o->at != '\n' && *o->at != '#') {
        skip_line(o);
        return;
    }
    skip_blanks(o);
    const size_t digits = strspn(o->at, "0123456789");
    if (strchr("\r\n", o->at[digits + strspn(o->at + digits, " \t")])) o->at += digits;
}

static froe_status read_off_header(off *o) {
    skip_blanks(o);
    size_t prefix = strspn(o->at, "STCN4n");
    if (memchr(o->at, '4', prefix) || memchr(o->at, 'n', prefix))
        if (!strncmp(o->at + prefix, "OFF", 3))
            return support_fail(o->sink->diag, FROE_E_UNSUPPORTED,
                                "%s: Vertices with more than 3 coordinates are not read.",
                                support_short(o->source->path));
    if (!strncmp(o->at + prefix, "OFF", 3)) {
        o->extras = prefix > 0;
        o->normals = memchr(o->at, 'N', prefix) != NULL;
        o->coloured = memchr(o->at, 'C', prefix) != NULL;
        o->at += prefix + strlen("OFF");
    }
    skip_blanks(o);
    if (!strncmp(o->at, "BINARY", 6))
        return support_fail(o->sink->diag, FROE_E_UNSUPPORTED, "%s: Binary OFF is not read.",
                            support_short(o->source->path));
    if (!whole(o, &o->vertices) || !whole(o, &o->faces))
        return broken_off(o, "The counts of vertices and faces are missing.");
    skip_edges(o);
    if (o->vertices > o->length || o->faces > o->length)
        return broken_off(o, "The file is shorter than its counts say.");
    return FROE_OK;
}

static froe_status read_vertex(off *o) {
    double ignored;
    for (int k = 0; k < 3; ++k)
        if (!number(o, &o->sink->points.data[o->sink->points.count++]))
            return broken_off(o, *o->at ? "A coordinate is not a number." : "Vertices are missing.");
    for (int k = 0; o->normals && k < 3; ++k)
        if (!number(o, &ignored)) return broken_off(o, "A normal is not a number.");
    if (o->coloured) o->colours.data[o->colours.count++] = rest_colour(o);
    if (o->extras) skip_line(o);
    return FROE_OK;
}

static froe_status read_face(off *o) {
    uint64_t corners, vertex;
    const froe_allocator *alloc = &o->sink->alloc;
    o->corners.count = o->shades.count = 0;
    if (!whole(o, &corners))
        return broken_off(o, *o->at ? "A count of corners is not a number." : "Faces are missing.");
    for (uint64_t i = 0; i < corners; ++i) {
        if (!whole(o, &vertex)) return broken_off(o, *o->at ? "An index is not a number." : "Faces are missing.");
        if (vertex >= o->vertices) return broken_off(o, "A face names a vertex that does not exist.");
        if (!array_push(alloc, &o->corners, (uint32_t)vertex) ||
            (o->coloured && !array_push(alloc, &o->shades, o->colours.data[vertex])))
            return support_fail_memory(o->sink->diag);
    }
    const uint32_t own = rest_colour(o);
    skip_line(o);
    if (!corners) return ++o->sink->report.skipped, FROE_OK;
    const froe_status status =
        formats_paint_enter(o->sink, &o->paint, own ? own : formats_paint_mean(o->shades.data, o->shades.count));
    return status ? status : formats_sink_indexed_face(o->sink, o->corners.data, (size_t)corners);
}

froe_status formats_read_off(const formats_source *source, formats_sink *sink) {
    enum { FACES_PER_REPORT = 4096 };
    const froe_allocator *alloc = &sink->alloc;
    formats_text text = {0};
    froe_status status = formats_load(source, sink, false, &text);
    if (!status) formats_end_lines(text.data);
    off o = {.source = source, .sink = sink, .begin = text.data, .at = text.data, .length = text.count};
    if (!status) status = read_off_header(&o);
    if (!status) status = formats_sink_open(sink, 3);
    if (!status && (!array_reserve(alloc, &sink->points, (size_t)o.vertices * 3) ||
                    (o.coloured && !array_reserve(alloc, &o.colours, (size_t)o.vertices))))
        status = support_fail_memory(sink->diag);
    for (uint64_t i = 0; i < o.vertices && !status; ++i) status = read_vertex(&o);
    formats_report_format(sink, "float64", "OFF");
    sink->report.layers = 1;
    if (!status) status = formats_sink_feature(sink, 0);
    sink->unit = o.faces ? "face" : "vertex";
    for (uint64_t i = 0; i < (o.faces ? o.faces : o.vertices) && !status; ++i) {
        sink->number = i;
        status = o.faces ? read_face(&o) : formats_sink_point(sink, sink->points.data + 3 * i);
        if (!status && i % FACES_PER_REPORT == 0)
            status = formats_sink_progress(sink, (double)(o.at - o.begin) / (double)o.length);
    }
    if (!status) skip_blanks(&o);
    if (!status && *o.at) status = broken_off(&o, "There is more than its counts say.");
    array_free(alloc, &o.corners);
    array_free(alloc, &o.colours);
    array_free(alloc, &o.shades);
    formats_paint_free(sink, &o.paint);
    array_free(alloc, &text);
    return status;
}
