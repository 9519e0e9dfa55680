/* csv_header.c: columns by their names: axes, ends of boxes, radius, tag and geometry. */
#include "formats/input/csv_header.h"
#include <string.h>

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

/* With `bounds` names of axes are those that bound boxes, as xmin does. */
static int role_of(const char *name, int family, bool bounds, bool *beyond) {
    static const struct {
        const char *name;
        int role;
    } roles[] = {{"r", FORMATS_CSV_RADIUS},  {"radius", FORMATS_CSV_RADIUS}, {"tag", FORMATS_CSV_TAG},
                 {"hull", FORMATS_CSV_HULL}, {"wkt", FORMATS_CSV_GEOMETRY},  {"geometry", FORMATS_CSV_GEOMETRY},
                 {"name", FORMATS_CSV_NAME}, {"geom", FORMATS_CSV_GEOMETRY}};
    for (size_t i = 0; i < sizeof roles / sizeof *roles; i++)
        if (support_equal_nocase(name, roles[i].name)) return roles[i].role;
    bool high = false;
    const name_side side = bounds ? (name_side){0, 0} : side_of(name);
    const int axis =
        bounds ? support_csv_bound(name, family, &high) : support_csv_axis(name + side.length, family, side.length > 0);
    if (axis < 0) return FORMATS_CSV_LEFT_ALONE;
    if (axis >= FROE_MAX_DIM) return *beyond = true, FORMATS_CSV_LEFT_ALONE;
    if (high) return FROE_MAX_DIM + axis;
    return side.role + axis; /* a plain axis is stored as corner 0; sides are told apart by the presence of corner 1 */
}

/* Counts the roles; settles kind and dimension. False: it is no header of this reader. */
static bool settle(formats_csv_table *t, froe_kind sided) {
    int count[FORMATS_CSV_LEFT_ALONE + 1] = {0}, dim = 0, high = 0;
    for (int i = 0; i < t->columns; ++i) ++count[t->role[i]];
    for (int role = 0; role < FORMATS_CSV_LEFT_ALONE; ++role)
        if (count[role] > 1 && role != FORMATS_CSV_NAME) return false;
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

/* What the names say when axes are those of one family. */
static formats_csv_header read_names(formats_csv_table *t, const char *const *names, int family, bool bounds) {
    bool beyond = false;
    int sided = 0, plain = 0, ends = 0;
    for (int i = 0; i < t->columns; ++i) {
        const int role = role_of(names[i], family, bounds, &beyond);
        if (role < FORMATS_CSV_RADIUS) ++*(bounds || strchr(names[i], '_') ? &sided : &plain);
        ends += role >= SEGMENT_END;
        t->role[i] = (unsigned char)role;
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

/* Where there is no column `name`, one that is named `group` has the names of groups. */
static void find_names(formats_csv_table *t, const char *const *names) {
    const unsigned char *role = memchr(t->role, FORMATS_CSV_NAME, (size_t)t->columns);
    for (int i = 0; i < t->columns; ++i) {
        if (t->role[i] == FORMATS_CSV_NAME && t->role + i != role) t->role[i] = FORMATS_CSV_LEFT_ALONE;
        if (!role && support_equal_nocase(names[i], "group")) t->role[i] = FORMATS_CSV_NAME, role = t->role + i;
    }
}

formats_csv_header formats_csv_read_header(char **at, formats_csv_table *t) {
    const char *names[SUPPORT_CSV_COLUMNS];
    support_csv_field field = {.last = false};
    t->separator = support_csv_separator(*at);
    t->lines = 1;
    t->open = false;
    for (t->columns = 0; !field.last; ++t->columns) {
        if (t->columns == SUPPORT_CSV_COLUMNS) return t->columns = 0, FORMATS_CSV_OTHER;
        field = support_csv_next(at, t->separator);
        names[t->columns] = field.text;
        t->lines += support_csv_line_ends(&field);
        t->open = field.open;
    }
    t->spare = t->columns > 1 && !*field.text;
    support_csv_names(t->found, sizeof t->found, names, (size_t)t->columns);
    formats_csv_header first = FORMATS_CSV_OTHER;
    for (int family = 0; family < SUPPORT_CSV_FAMILIES; ++family) {
        const formats_csv_header what = read_names(t, names, family, false);
        if (what == FORMATS_CSV_OURS) return find_names(t, names), what;
        if (first == FORMATS_CSV_OTHER) first = what;
    }
    /* Bounds beside something else, such as x and y of a point, are columns among others. */
    for (int family = 0; family < SUPPORT_CSV_FAMILIES && first != FORMATS_CSV_HALVES; ++family)
        if (read_names(t, names, family, true) == FORMATS_CSV_OURS) return find_names(t, names), FORMATS_CSV_OURS;
    return first;
}

/* Reads the header from the file's first bytes. Lines may end by returns alone. */
static formats_csv_header peek_header(const formats_source *source, formats_csv_table *t) {
    char line[sizeof source->head], *at = line;
    size_t length = strcspn(source->head, strchr(source->head, '\n') ? "\n" : "\r");
    t->columns = 0;
    if (memchr(source->head, '\0', length)) return FORMATS_CSV_OTHER;
    memcpy(line, source->head, length);
    line[length] = '\0';
    return formats_csv_read_header(&at, t);
}

bool formats_csv_recognise(const formats_source *source) {
    formats_csv_table t = {.columns = 0};
    const bool named = !strcmp(source->extension.text, "csv") || !strcmp(source->extension.text, "tsv");
    return peek_header(source, &t) != FORMATS_CSV_OTHER ||
           (named && t.columns && !memchr(t.role, FORMATS_CSV_GEOMETRY, (size_t)t.columns));
}

bool formats_csv_has_geometry(const formats_source *source) {
    formats_csv_table t;
    peek_header(source, &t);
    return memchr(t.role, FORMATS_CSV_GEOMETRY, (size_t)t.columns) != NULL;
}
