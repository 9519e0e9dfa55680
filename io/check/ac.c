/* ac.c: what an AC3D file may say that assimp passes over, so that the model would be another one. A file is lines of a
 * word, or of numbers behind a line that counts them:
 *
 *     OBJECT poly, loc 1 0 0, numvert 3, x y z, x y z, x y z, numsurf 1, SURF 0x0, refs 3, 0 u v, 1 u v, 2 u v, kids 0
 *
 * assimp leaves out lines that are more than were counted, and reads what is no whole number as 0. Where an object has
 * corners, it moves neither lines nor kids by `loc`, and turns that move by `rot`. Points in no surface are left out,
 * which is told. */
#include "check/check.h"
#include "support/decimal/decimal.h"
#include <stdlib.h>
#include <string.h>

bool io_is_ac(const formats_source *source) {
    return !strncmp(source->head, "AC3D", 4);
}

typedef struct ac_check {
    formats_sink *sink;
    size_t points, surfaces, corners, kids, bytes; /* still to come */
    size_t vertices;                               /* of the object */
    bool moved, turned, lined, faced;              /* it has loc, rot, lines, corners */
    froe_status status;                            /* of the fault */
} ac_check;

static bool begins_with(const char *line, const char *word) {
    const size_t length = strlen(word);
    return !strncmp(line, word, length) && strchr(" \t\r\n", line[length]);
}

/* A whole number; SIZE_MAX: there is none. */
static size_t whole_number(const char *at) {
    char *end;
    at += strspn(at, " \t");
    const size_t number = strtoul(at, &end, 10);
    return *at >= '0' && *at <= '9' && strchr(" \t\r\n", *end) ? number : SIZE_MAX;
}

/* Does one of so many numbers differ from those given? */
static bool differ(const char *at, const double *given, size_t count) {
    for (size_t i = 0; i < count; i++) {
        char *end;
        at += strspn(at, " \t");
        if (support_decimal(at, &end) != given[i]) return true;
        at = end;
    }
    return false;
}

static const char *look_at_numbers(ac_check *c, const char *line) {
    if (c->points) return c->points--, NULL;
    if (!c->corners) return "There are more lines of numbers than were counted.";
    c->corners--;
    return whole_number(line) < c->vertices ? NULL : "A surface names a vertex that does not exist.";
}

/* The end of an object. */
static const char *look_at_kids(ac_check *c, size_t kids) {
    if (c->surfaces) return "There are fewer surfaces than were counted.";
    if (c->vertices && !c->faced) io_leave(c->sink, "points", 6);
    c->kids += kids;
    if (!c->moved || !c->faced || (!c->turned && !c->lined && !kids)) return NULL;
    c->status = FROE_E_UNSUPPORTED;
    return "Objects that are moved (loc) and turned (rot), or have lines or kids, are not read.";
}

static void look_at_surface(ac_check *c, const char *at) {
    const unsigned long sort = strtoul(at, NULL, 0) & 15;
    c->lined = c->lined || sort == 1 || sort == 2;
}

static const char *look_at_ac_word(ac_check *c, const char *line) {
    static const double still[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, origin[3] = {0};
    static const char *const counting[] = {"numvert", "numsurf", "refs", "kids", "data"};
    enum { POINTS, SURFACES, CORNERS, KIDS, BYTES };
    size_t count = 0, kind = 0;
    if (c->points || c->corners) return "There are fewer lines of numbers than were counted.";
    while (kind <= BYTES && !begins_with(line, counting[kind])) kind++;
    if (kind <= BYTES) count = whole_number(line + strlen(counting[kind]));
    if (count == SIZE_MAX) return "A count is no whole number.";
    if (begins_with(line, "OBJECT")) *c = (ac_check){c->sink, .kids = c->kids - (c->kids > 0), .status = c->status};
    if (begins_with(line, "loc")) c->moved = differ(line + 3, origin, 3);
    if (begins_with(line, "rot")) c->turned = differ(line + 3, still, 9);
    if (begins_with(line, "SURF")) look_at_surface(c, line + 4);
    if (kind == POINTS) c->points = count, c->vertices += count;
    if (kind == SURFACES) c->surfaces = count;
    if (kind == CORNERS && !c->surfaces--) return "There are more surfaces than were counted.";
    if (kind == CORNERS) c->corners = count, c->faced = c->faced || count;
    if (kind == BYTES) c->bytes = count;
    return kind == KIDS ? look_at_kids(c, count) : NULL;
}

static io_fault find_ac_fault(formats_sink *sink, const char *text) {
    ac_check c = {sink, .status = FROE_E_FORMAT};
    size_t line = 0;
    for (const char *at = text; *at;) {
        ++line;
        at += strspn(at, " \t\r");
        const bool none = !*at || *at == '\n', numbers = !none && strchr("+-0123456789", *at);
        const char *fault = none ? NULL : numbers ? look_at_numbers(&c, at) : look_at_ac_word(&c, at);
        if (fault) return (io_fault){fault, line, c.status};
        at += strcspn(at, "\n");
        at += *at == '\n';
        for (; c.bytes && *at; c.bytes--) line += *at++ == '\n'; /* of any text */
    }
    const bool cut = c.kids || c.points || c.corners;
    return (io_fault){cut ? "The file ends before all is there that was counted." : NULL, line, c.status};
}

froe_status io_ac_check(const formats_source *source, formats_sink *sink) {
    return io_text_look(source, sink, true, find_ac_fault);
}
