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

static int role_of(const char *name, bool *beyond) {
    if (support_equal_nocase(name, "r") || support_equal_nocase(name, "radius")) return FORMATS_CSV_RADIUS;
    if (support_equal_nocase(name, "tag")) return FORMATS_CSV_TAG;
    if (support_equal_nocase(name, "wkt") || support_equal_nocase(name, "geometry") ||
        support_equal_nocase(name, "geom"))
        return FORMATS_CSV_GEOMETRY;
    int corner = (name[0] | 0x20) == 'h';
    bool sided = strlen(name) > 3 && name[2] == '_';
    char side[3] = {name[0], sided ? name[1] : '\0', '\0'};
    if (sided && !support_equal_nocase(side, "lo") && !support_equal_nocase(side, "hi")) return FORMATS_CSV_LEFT_ALONE;
    int axis = axis_of(sided ? name + 3 : name, sided);
    if (axis < 0) return FORMATS_CSV_LEFT_ALONE;
    if (axis >= FROE_MAX_DIM) return *beyond = true, FORMATS_CSV_LEFT_ALONE;
    /* a plain axis is stored as corner 0; `sided` is told apart by the presence of corner 1 */
    return (sided && corner ? FROE_MAX_DIM : 0) + axis;
}

/* Counts the roles; settles kind and dimension. False: it is no header of this reader. */
static bool settle(formats_csv_table *t, bool sided) {
    int count[FORMATS_CSV_LEFT_ALONE + 1] = {0}, dim = 0, high = 0;
    for (int i = 0; i < t->columns; ++i) ++count[t->role[i]];
    for (int role = 0; role < FORMATS_CSV_LEFT_ALONE; ++role)
        if (count[role] > 1) return false;
    while (dim < FROE_MAX_DIM && count[dim]) ++dim;
    while (high < FROE_MAX_DIM && count[FROE_MAX_DIM + high]) ++high;
    for (int k = 0; k < FROE_MAX_DIM; ++k)
        if ((count[k] && k >= dim) || (count[FROE_MAX_DIM + k] && k >= high)) return false;
    t->dim = dim;
    t->kind = sided ? FROE_BOX : count[FORMATS_CSV_RADIUS] ? FROE_BALL : FROE_POINT;
    return dim >= 2 && !count[FORMATS_CSV_GEOMETRY] && high == (sided ? dim : 0);
}

formats_csv_header formats_csv_read_header(char **at, formats_csv_table *t) {
    size_t length = strcspn(*at, "\r\n");
    char *line = *at;
    t->separator = memchr(line, ',', length) ? ',' : memchr(line, ';', length) ? ';' : '\t';
    bool last = false, beyond = false;
    int sided = 0, plain = 0;
    for (t->columns = 0; !last; ++t->columns) {
        if (t->columns == FORMATS_CSV_COLUMNS) return FORMATS_CSV_OTHER;
        char *name = formats_csv_field(at, t->separator, &last);
        int role = role_of(name, &beyond);
        if (role < FORMATS_CSV_RADIUS) ++*(strchr(name, '_') ? &sided : &plain);
        t->role[t->columns] = (unsigned char)role;
    }
    if (beyond) return FORMATS_CSV_BEYOND;
    if (!(sided && plain) && settle(t, sided)) return FORMATS_CSV_OURS;
    return sided > 1 && !memchr(t->role, FORMATS_CSV_GEOMETRY, (size_t)t->columns) ? FORMATS_CSV_HALVES
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
