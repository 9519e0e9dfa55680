/* csv_header.c: columns by their names: axes, ends of boxes, radius, tag and geometry. */
#include "formats/input/csv_header.h"
#include <stdlib.h>
#include <string.h>

char *formats_csv_field(char **at, char separator, bool *last) {
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
    while (to > field && strchr(" \t\r", to[-1])) to--;
    *to = '\0';
    return field + strspn(field, " \t\r");
}

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

/* Added to the role of a column from_ or to_ until it is known whether the rows are segments. */
enum { SEGMENT_END = 64 };

/* The beginning of a column's name, and what it adds to the role of the axis: lo_, hi_ of boxes, from_, to_ of
 * segments. */
typedef struct name_side {
    size_t length; /* 0: none */
    int role;
} name_side;

static name_side side_of(const char *name) {
    static const char *const words[] = {"lo_", "hi_", "from_", "to_"};
    static const int roles[] = {0, FROE_MAX_DIM, SEGMENT_END, SEGMENT_END + FROE_MAX_DIM};
    for (size_t i = 0; i < 4; i++) {
        size_t at = 0;
        while (words[i][at] && (name[at] | 0x20) == (words[i][at] | 0x20)) at++;
        if (!words[i][at]) return (name_side){at, roles[i]};
    }
    return (name_side){0, 0};
}

static int role_of(const char *name, bool *beyond) {
    if (support_equal_nocase(name, "r") || support_equal_nocase(name, "radius")) return FORMATS_CSV_RADIUS;
    if (support_equal_nocase(name, "tag")) return FORMATS_CSV_TAG;
    if (support_equal_nocase(name, "hull")) return FORMATS_CSV_HULL;
    if (support_equal_nocase(name, "wkt") || support_equal_nocase(name, "geometry") ||
        support_equal_nocase(name, "geom"))
        return FORMATS_CSV_GEOMETRY;
    const name_side side = side_of(name);
    int axis = axis_of(name + side.length, side.length > 0);
    if (axis < 0) return FORMATS_CSV_LEFT_ALONE;
    if (axis >= FROE_MAX_DIM) return *beyond = true, FORMATS_CSV_LEFT_ALONE;
    return side.role + axis; /* a plain axis is stored as corner 0; sides are told apart by the presence of corner 1 */
}

/* Counts the roles; settles kind and dimension. False: it is no header of this reader. */
static bool settle(formats_csv_table *t, froe_kind sided) {
    int count[FORMATS_CSV_LEFT_ALONE + 1] = {0}, dim = 0, high = 0;
    for (int i = 0; i < t->columns; ++i) ++count[t->role[i]];
    for (int role = 0; role < FORMATS_CSV_LEFT_ALONE; ++role)
        if (count[role] > 1) return false;
    while (dim < FROE_MAX_DIM && count[dim]) ++dim;
    while (high < FROE_MAX_DIM && count[FROE_MAX_DIM + high]) ++high;
    for (int k = 0; k < FROE_MAX_DIM; ++k)
        if ((count[k] && k >= dim) || (count[FROE_MAX_DIM + k] && k >= high)) return false;
    t->dim = dim;
    t->kind = sided != FROE_POINT         ? sided
              : count[FORMATS_CSV_HULL]   ? FROE_HULL
              : count[FORMATS_CSV_RADIUS] ? FROE_BALL
                                          : FROE_POINT;
    return dim >= 2 && !count[FORMATS_CSV_GEOMETRY] && high == (sided != FROE_POINT ? dim : 0);
}

formats_csv_header formats_csv_read_header(char **at, formats_csv_table *t) {
    size_t length = strcspn(*at, "\r\n");
    char *line = *at;
    t->separator = memchr(line, ',', length) ? ',' : memchr(line, ';', length) ? ';' : '\t';
    bool last = false, beyond = false;
    int sided = 0, plain = 0, ends = 0;
    for (t->columns = 0; !last; ++t->columns) {
        if (t->columns == FORMATS_CSV_COLUMNS) return FORMATS_CSV_OTHER;
        char *name = formats_csv_field(at, t->separator, &last);
        int role = role_of(name, &beyond);
        if (role < FORMATS_CSV_RADIUS) ++*(strchr(name, '_') ? &sided : &plain);
        ends += role >= SEGMENT_END;
        t->role[t->columns] = (unsigned char)role;
    }
    const bool segments = ends && !sided && !plain; /* else such columns are others */
    for (int i = 0; i < t->columns; ++i)
        if (t->role[i] >= SEGMENT_END)
            t->role[i] = segments ? (unsigned char)(t->role[i] - SEGMENT_END) : FORMATS_CSV_LEFT_ALONE;
    if (beyond) return FORMATS_CSV_BEYOND;
    if (!(sided && plain) && settle(t, segments ? FROE_SEGMENT : sided ? FROE_BOX : FROE_POINT))
        return FORMATS_CSV_OURS;
    return sided + (segments ? ends : 0) > 1 && !memchr(t->role, FORMATS_CSV_GEOMETRY, (size_t)t->columns)
               ? FORMATS_CSV_HALVES
               : FORMATS_CSV_OTHER;
}

/* Reads the header from the file's first bytes. */
static formats_csv_header peek_header(const formats_source *source, formats_csv_table *t) {
    char line[sizeof source->head], *at = line;
    size_t length = strcspn(source->head, "\n");
    t->columns = 0;
    if (memchr(source->head, '\0', length)) return FORMATS_CSV_OTHER;
    memcpy(line, source->head, length);
    line[length] = '\0';
    return formats_csv_read_header(&at, t);
}

bool formats_csv_recognise(const formats_source *source) {
    formats_csv_table t;
    return peek_header(source, &t) != FORMATS_CSV_OTHER;
}

bool formats_csv_has_geometry(const formats_source *source) {
    formats_csv_table t;
    peek_header(source, &t);
    return memchr(t.role, FORMATS_CSV_GEOMETRY, (size_t)t.columns) != NULL;
}
