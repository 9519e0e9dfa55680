/* read_csv.c: points, boxes and balls from comma-separated values, recognised by
 * their header line (RFC 4180, with commas, semicolons or tabs).
 *
 *     x,y,z          lo_x,lo_y,hi_x,hi_y          x,y,r
 */
#include "read.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_COLUMNS = 512, NAME_ROOM = 32 };
/* What a column holds. Corner c (0, or 1 for hi_) of axis a is c * FROE_MAX_DIM + a. */
enum { RADIUS = 2 * FROE_MAX_DIM, TAG, GEOMETRY, LEFT_ALONE };

typedef enum header {
    OURS,
    OTHER,  /* left to OGR */
    BEYOND, /* more axes than there can be */
    HALVES  /* ends of boxes, but not both on the same axes */
} header;

typedef struct table {
    char separator;
    froe_kind kind;
    int dim;
    int columns;
    unsigned char role[MOST_COLUMNS];
} table;

/* One field, in place: ends it, unquotes it, and moves `at` to the next. Returns it; *last when its
 * line ends with it. */
static char *next_field(char **at, char separator, bool *last) {
    char *from = *at, *to = from, *field = from;
    from += strspn(from, " ");
    if (*from == '"') {
        for (++from; *from && (*from != '"' || from[1] == '"'); ++from) {
            if (*from == '"') ++from;
            *to++ = *from;
        }
        if (*from) ++from;
    }
    while (*from && *from != separator && *from != '\n') *to++ = *from++;
    *last = *from != separator;
    *at = *from ? from + 1 : from;
    *to = '\0';
    return field;
}

static char *trim(char *field) {
    field += strspn(field, " \t\r");
    size_t length = strlen(field);
    while (length && strchr(" \t\r", field[length - 1])) field[--length] = '\0';
    return field;
}

/* ---------------------------------------------------------------- header -- */

/* Axis of a name like x, z or x7, behind lo_ and hi_ also 7; -1 when it is none, FROE_MAX_DIM when it is beyond. */
static int axis_of(const char *name, bool sided) {
    static const char letters[] = "xyzw";
    const char *at = name[0] && !name[1] ? strchr(letters, name[0] | 0x20) : NULL;
    char *end;
    if (at) return (int)(at - letters);
    if ((name[0] | 0x20) == 'x')
        ++name;
    else if (!sided)
        return -1;
    if (name[0] < '1' || name[0] > '9') return -1;
    long number = strtol(name, &end, 10);
    if (*end) return -1;
    return number <= FROE_MAX_DIM ? (int)number - 1 : FROE_MAX_DIM;
}

static int role_of(const char *name, bool *beyond) {
    if (io_equal_nocase(name, "r") || io_equal_nocase(name, "radius")) return RADIUS;
    if (io_equal_nocase(name, "tag")) return TAG;
    if (io_equal_nocase(name, "wkt") || io_equal_nocase(name, "geometry") || io_equal_nocase(name, "geom"))
        return GEOMETRY;
    int corner = (name[0] | 0x20) == 'h';
    bool sided = strlen(name) > 3 && name[2] == '_';
    char side[3] = {name[0], sided ? name[1] : '\0', '\0'};
    if (sided && !io_equal_nocase(side, "lo") && !io_equal_nocase(side, "hi")) return LEFT_ALONE;
    int axis = axis_of(sided ? name + 3 : name, sided);
    if (axis < 0) return LEFT_ALONE;
    if (axis >= FROE_MAX_DIM) return *beyond = true, LEFT_ALONE;
    /* a plain axis is stored as corner 0; `sided` is told apart by the presence of corner 1 */
    return (sided && corner ? FROE_MAX_DIM : 0) + axis;
}

/* Counts the roles; settles kind and dimension. False: it is no header of this reader. */
static bool settle(table *t, bool sided) {
    int count[LEFT_ALONE + 1] = {0}, dim = 0, high = 0;
    for (int i = 0; i < t->columns; ++i) ++count[t->role[i]];
    for (int role = 0; role < LEFT_ALONE; ++role)
        if (count[role] > 1) return false;
    while (dim < FROE_MAX_DIM && count[dim]) ++dim;
    while (high < FROE_MAX_DIM && count[FROE_MAX_DIM + high]) ++high;
    for (int k = 0; k < FROE_MAX_DIM; ++k)
        if ((count[k] && k >= dim) || (count[FROE_MAX_DIM + k] && k >= high)) return false;
    t->dim = dim;
    t->kind = sided ? FROE_BOX : count[RADIUS] ? FROE_BALL : FROE_POINT;
    return dim >= 2 && !count[GEOMETRY] && high == (sided ? dim : 0);
}

/* Reads the header line, which it changes, and moves `at` behind it. */
static header read_csv_header(char **at, table *t) {
    if (!strncmp(*at, "\xef\xbb\xbf", 3)) *at += 3;
    size_t length = strcspn(*at, "\r\n");
    char *line = *at;
    t->separator = memchr(line, ',', length) ? ',' : memchr(line, ';', length) ? ';' : '\t';
    bool last = false, beyond = false;
    int sided = 0, plain = 0;
    for (t->columns = 0; !last; ++t->columns) {
        if (t->columns == MOST_COLUMNS) return OTHER;
        char *name = trim(next_field(at, t->separator, &last));
        int role = role_of(name, &beyond);
        if (role < RADIUS) ++*(strchr(name, '_') ? &sided : &plain);
        t->role[t->columns] = (unsigned char)role;
    }
    if (beyond) return BEYOND;
    if (!(sided && plain) && settle(t, sided)) return OURS;
    return sided > 1 && !memchr(t->role, GEOMETRY, (size_t)t->columns) ? HALVES : OTHER;
}

/* Reads the header from the file's first bytes. */
static header peek_header(const io_source *source, table *t) {
    char line[sizeof source->head], *at = line;
    size_t length = strcspn(source->head, "\n");
    t->columns = 0;
    if (memchr(source->head, '\0', length)) return OTHER;
    memcpy(line, source->head, length);
    line[length] = '\0';
    return read_csv_header(&at, t);
}

bool io_csv_recognise(const io_source *source) {
    table t;
    return peek_header(source, &t) != OTHER;
}

static froe_status refuse_header(const io_source *source, const io_sink *sink, header what) {
    const char *name = io_short(source->path);
    if (what == BEYOND) return io_fail(sink->diag, FROE_E_UNSUPPORTED, "%s: has more than %d axes", name, FROE_MAX_DIM);
    if (what == HALVES)
        return io_fail(sink->diag, FROE_E_FORMAT,
                       "%s: columns of boxes are lo_ and hi_ of the same two or more axes, as in lo_x,lo_y,hi_x,hi_y",
                       name);
    return io_fail(sink->diag, FROE_E_IO, "%s: changed while it was read", name);
}

bool io_csv_has_geometry(const io_source *source) {
    table t;
    peek_header(source, &t);
    return memchr(t.role, GEOMETRY, (size_t)t.columns) != NULL;
}

/* ------------------------------------------------------------------ rows -- */

typedef struct row {
    double corners[2 * FROE_MAX_DIM], radius; /* corner 1 directly behind corner 0 */
    uint64_t tag;
    bool tagged;
} row;

static froe_status read_csv_number(io_sink *sink, const char *field, double *value) {
    char *end;
    *value = strtod(field, &end); /* correctly rounded, in the C locale of this thread */
    if (end != field && !*end) return FROE_OK;
    if (!*field) return io_sink_fail(sink, FROE_E_FORMAT, "a coordinate is missing");
    return io_sink_fail(sink, FROE_E_FORMAT, "'%.40s' is not a number", field);
}

static froe_status read_field(io_sink *sink, const table *t, int role, const char *field, row *r) {
    if (role == RADIUS && t->kind == FROE_BALL) return read_csv_number(sink, field, &r->radius);
    if (role < RADIUS) {
        int corner = role / FROE_MAX_DIM, axis = role % FROE_MAX_DIM;
        return read_csv_number(sink, field, &r->corners[corner * t->dim + axis]);
    }
    if (role != TAG) return FROE_OK;
    char *end;
    errno = 0;
    r->tag = strtoull(field, &end, 10);
    r->tagged = true;
    if (end == field || *end || errno || *field == '-')
        return io_sink_fail(sink, FROE_E_FORMAT, "the tag '%.40s' is not a whole number below 2^64", field);
    return FROE_OK;
}

static froe_status read_row(io_sink *sink, const table *t, char **at, row *r) {
    bool last = false;
    int column = 0;
    froe_status status = FROE_OK;
    while (!last && !status) {
        char *field = trim(next_field(at, t->separator, &last));
        if (column < t->columns) status = read_field(sink, t, t->role[column], field, r);
        ++column;
    }
    if (!status && column != t->columns)
        return io_sink_fail(sink, FROE_E_FORMAT, "it has %d columns, the header %d", column, t->columns);
    return status;
}

static froe_status add_row(io_sink *sink, const table *t, const row *r) {
    sink->tagged = r->tagged;
    sink->tag = r->tag;
    if (t->kind == FROE_BOX) return io_sink_box(sink, r->corners, r->corners + t->dim);
    if (t->kind == FROE_BALL) return io_sink_ball(sink, r->corners, r->radius);
    return io_sink_point(sink, r->corners);
}

static bool is_blank(const char *at) {
    at += strspn(at, " \t\r");
    return *at == '\n' || !*at;
}

static froe_status read_rows(io_sink *sink, const table *t, char *at, const io_buffer *text) {
    enum { ROWS_PER_REPORT = 4096 };
    froe_status status = FROE_OK;
    const char *begin = text->data;
    while (*at && !status) {
        if (is_blank(at)) {
            at += strcspn(at, "\n");
            at += *at == '\n';
            continue;
        }
        row r = {.tag = 0};
        status = io_sink_feature(sink, sink->report.features + 1);
        if (!status) status = read_row(sink, t, &at, &r);
        if (!status) status = add_row(sink, t, &r);
        if (!status && sink->report.features % ROWS_PER_REPORT == 0)
            status = io_sink_progress(sink, (double)(at - begin) / (double)text->size);
    }
    return status;
}

froe_status io_read_csv(const io_source *source, io_sink *sink) {
    io_buffer text = {0};
    table t;
    froe_status status = io_load(source, sink, false, &text);
    char *at = text.data;
    header what = status ? OURS : read_csv_header(&at, &t);
    if (what != OURS) status = refuse_header(source, sink, what);
    if (!status) status = io_sink_open(sink, t.dim);
    sink->unit = "row";
    sink->report.layers = 1;
    if (!status) {
        io_report_format(sink, "float64", "CSV %ss", t.kind == FROE_BOX ? "boxe" : froe_kind_name(t.kind));
        status = read_rows(sink, &t, at, &text);
    }
    io_buffer_free(&sink->alloc, &text);
    return status;
}
