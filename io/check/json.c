/* json.c: whether a file of JSON is one value. GDAL reads the first, and leaves out whatever stands behind it: features
 * that follow each other, but not each in a line of its own.
 *
 *     {"type": "Feature", ...}        then nothing, or what JavaScript puts behind a call: ) and ;
 *
 * Whether the value is right GDAL tells. */
#include "check/check.h"
#include <cpl_vsi.h>
#include <string.h>

typedef struct json_scan {
    size_t line, depth;
    bool begun, escaped;
    char quote; /* 0: outside of strings */
} json_scan;

/* Stops behind the value, at the first byte that belongs to something else; NULL: there is none. */
static const char *scan_json(json_scan *s, const char *at, const char *end) {
    for (; at < end; at++) {
        s->line += *at == '\n';
        if (s->quote) {
            if (!s->escaped && *at == s->quote) s->quote = '\0';
            s->escaped = !s->escaped && *at == '\\';
        } else if (s->begun && !s->depth && !strchr(" \t\r\n);", *at)) { /* a zero, too, may stand there */
            return at;
        } else if (*at == '{' || *at == '[') {
            s->depth++;
            s->begun = true;
        } else if (*at == '}' || *at == ']') {
            s->depth -= s->depth > 0;
        } else if (s->depth && (*at == '"' || *at == '\'')) {
            s->quote = *at;
        }
    }
    return NULL;
}

froe_status io_json_check(const char *path, formats_sink *sink) {
    enum { CHUNK = 1 << 16 };
    json_scan s = {.line = 1};
    char *bytes = support_calloc(&sink->alloc, 1, CHUNK);
    VSILFILE *in = bytes ? VSIFOpenL(path, "rb") : NULL;
    const char *more = NULL;
    for (size_t got = CHUNK; in && got == CHUNK && !more;) {
        got = VSIFReadL(bytes, 1, CHUNK, in);
        more = scan_json(&s, bytes, bytes + got);
    }
    if (in) VSIFCloseL(in);
    const bool room = bytes != NULL;
    support_free(&sink->alloc, bytes, CHUNK);
    if (!room) return support_fail_memory(sink->diag);
    if (!more) return FROE_OK;
    return support_fail(sink->diag, FROE_E_FORMAT,
                        "%s: line %zu: Behind the first object there is more, which is not read. Features in a row "
                        "may be lines, one each, without a byte order mark.",
                        support_short(sink->path), s.line);
}
