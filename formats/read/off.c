/* off.c: the Object File Format of Geomview, as text, in double precision:
 * a header, three counts, vertices, and faces as a count and that many indices.
 * Faces of two corners are segments, faces of one are points. */
#include "formats/read/readers.h"
#include <stdlib.h>
#include <string.h>

typedef struct off {
    const formats_source *source;
    formats_sink *sink;
    const char *begin, *at;
    size_t length;
    bool extras; /* vertices carry normals or colours: the rest of their line is theirs */
    uint64_t vertices, faces;
    ARRAY(double) points, corners; /* 3 each */
} off;

static froe_status broken_off(off *o, const char *sentence) {
    size_t line = 1;
    for (const char *c = o->begin; c < o->at; ++c) line += *c == '\n';
    return support_fail(o->sink->diag, FROE_E_FORMAT, "%s: line %zu: %s", support_short(o->source->path), line,
                        sentence);
}

static void skip_blanks(off *o) {
    for (;;) {
        o->at += strspn(o->at, " \t\r\n");
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
    *value = strtod(o->at, &end);
    bool found = end != o->at;
    o->at = end;
    return found;
}

static bool whole(off *o, uint64_t *value) {
    char *end;
    skip_blanks(o);
    if (*o->at < '0' || *o->at > '9') return false;
    *value = strtoull(o->at, &end, 10);
    o->at = end;
    return true;
}

static froe_status read_off_header(off *o) {
    skip_blanks(o);
    size_t prefix = strspn(o->at, "STCN4n");
    if (memchr(o->at, '4', prefix) || memchr(o->at, 'n', prefix))
        return support_fail(o->sink->diag, FROE_E_UNSUPPORTED,
                            "%s: Vertices with more than 3 coordinates are not read.", support_short(o->source->path));
    o->extras = prefix > 0;
    o->at += prefix + strlen("OFF");
    skip_blanks(o);
    if (!strncmp(o->at, "BINARY", 6))
        return support_fail(o->sink->diag, FROE_E_UNSUPPORTED, "%s: Binary OFF is not read.",
                            support_short(o->source->path));
    uint64_t edges;
    if (!whole(o, &o->vertices) || !whole(o, &o->faces) || !whole(o, &edges))
        return broken_off(o, "The counts of vertices, faces and edges are missing.");
    if (o->vertices > o->length || o->faces > o->length)
        return broken_off(o, "The file is shorter than its counts say.");
    return FROE_OK;
}

static froe_status read_face(off *o) {
    uint64_t corners, vertex;
    o->corners.count = 0;
    if (!whole(o, &corners))
        return broken_off(o, *o->at ? "A count of corners is not a number." : "Faces are missing.");
    for (uint64_t i = 0; i < corners; ++i) {
        if (!whole(o, &vertex)) return broken_off(o, *o->at ? "An index is not a number." : "Faces are missing.");
        if (vertex >= o->vertices) return broken_off(o, "A face names a vertex that does not exist.");
        if (!array_append(&o->sink->alloc, &o->corners, o->points.data + 3 * vertex, 3))
            return support_fail_memory(o->sink->diag);
    }
    skip_line(o); /* colours */
    if (!corners) return ++o->sink->report.skipped, FROE_OK;
    return formats_sink_face(o->sink, o->corners.data, (size_t)corners);
}

froe_status formats_read_off(const formats_source *source, formats_sink *sink) {
    enum { FACES_PER_REPORT = 4096 };
    formats_text text = {0};
    froe_status status = formats_load(source, sink, false, &text);
    off o = {.source = source, .sink = sink, .begin = text.data, .at = text.data, .length = text.count};
    if (!status) status = read_off_header(&o);
    if (!status) status = formats_sink_open(sink, 3);
    if (!status && !array_reserve(&sink->alloc, &o.points, (size_t)o.vertices * 3))
        status = support_fail_memory(sink->diag);
    for (uint64_t i = 0; i < o.vertices && !status; ++i) {
        for (int k = 0; k < 3 && !status; ++k)
            if (!number(&o, &o.points.data[o.points.count++]))
                status = broken_off(&o, *o.at ? "A coordinate is not a number." : "Vertices are missing.");
        if (o.extras) skip_line(&o);
    }
    formats_report_format(sink, "float64", "OFF");
    sink->report.layers = 1;
    if (!status) status = formats_sink_feature(sink, 0);
    sink->unit = "face";
    for (uint64_t i = 0; i < o.faces && !status; ++i) {
        sink->number = i;
        status = read_face(&o);
        if (!status && i % FACES_PER_REPORT == 0)
            status = formats_sink_progress(sink, (double)(o.at - o.begin) / (double)o.length);
    }
    array_free(&sink->alloc, &o.points);
    array_free(&sink->alloc, &o.corners);
    array_free(&sink->alloc, &text);
    return status;
}
