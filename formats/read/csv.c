/* csv.c: points, boxes, balls, segments and hulls from comma-separated values, recognised by
 * their header line (RFC 4180, with commas, semicolons or tabs).
 *
 *     x,y,z       lo_x,lo_y,hi_x,hi_y       x,y,r       from_x,from_y,to_x,to_y       hull,x,y
 *
 * A hull has one row for each corner: rows one after the other with the same number are one hull. Rows one after the
 * other with the same name (column name, or else group) are one group. */
#include "formats/input/csv_header.h"
#include "formats/read/readers.h"
#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* Where the radius of a ball stands among the numbers of a row, and what stands for a column without number. */
enum { RADIUS = 2 * FROE_MAX_DIM, NO_NUMBER };

typedef struct csv_row {
    double numbers[NO_NUMBER]; /* the corners, corner 1 directly behind corner 0, and the radius */
    uint64_t row, tag, hull;
    bool tagged;
    const char *name; /* of its group; NULL or "": none */
} csv_row;

typedef struct csv_reader {
    formats_sink *sink;
    formats_csv_table table;
    const char *name; /* of the last group, in the text */
    uint32_t group;
    uint64_t line;                            /* that the next record begins in, from 1 */
    csv_row row, first;                       /* the current one; that of the hull whose rows are read */
    unsigned char place[SUPPORT_CSV_COLUMNS]; /* of the number of a column */
    ARRAY(double) corners;
} csv_reader;

static froe_status read_csv_number(formats_sink *sink, char *field, char separator, double *value) {
    if (support_csv_number(field, separator, value)) return FROE_OK;
    if (!*field) return formats_sink_fail(sink, FROE_E_FORMAT, "A coordinate is missing.");
    return formats_sink_fail(sink, FROE_E_FORMAT, "'%.40s' is not a number.", field);
}

/* Where the number of a column with this role stands. */
static unsigned char place_of_role(const formats_csv_table *t, int role) {
    if (role == FORMATS_CSV_RADIUS && t->kind == FROE_BALL) return RADIUS;
    const int corner = role / FROE_MAX_DIM, axis = role % FROE_MAX_DIM;
    return role < FORMATS_CSV_RADIUS ? (unsigned char)(corner * t->dim + axis) : NO_NUMBER;
}

static froe_status read_field(csv_reader *c, int column, char *field) {
    const formats_csv_table *t = &c->table;
    csv_row *r = &c->row;
    const int role = t->role[column];
    if (c->place[column] != NO_NUMBER)
        return read_csv_number(c->sink, field, t->separator, r->numbers + c->place[column]);
    if (role == FORMATS_CSV_NAME) r->name = field;
    const bool hull = role == FORMATS_CSV_HULL && t->kind == FROE_HULL;
    if (role != FORMATS_CSV_TAG && !hull) return FROE_OK;
    char *end;
    errno = 0;
    *(hull ? &r->hull : &r->tag) = strtoull(field, &end, 10);
    if (!hull) r->tagged = true;
    if (end == field || *end || errno || *field == '-')
        return formats_sink_fail(c->sink, FROE_E_FORMAT, "The %s '%.40s' is not a whole number below 2^64.",
                                 hull ? "hull" : "tag", field);
    return FROE_OK;
}

/* Begins the object that a row makes, or a hull whose first row it is. */
static froe_status begin_object(csv_reader *c, const csv_row *r) {
    formats_sink *sink = c->sink;
    froe_status status = formats_sink_feature(sink, r->row);
    sink->tagged = r->tagged;
    sink->tag = r->tag;
    if (status || !r->name || !*r->name) return status;
    if (!c->name || strcmp(c->name, r->name) != 0) {
        status = formats_sink_group(sink, &(froe_group){.name = r->name});
        c->group = sink->group;
        c->name = r->name;
    }
    sink->group = c->group;
    return status;
}

/* Ends the hull whose rows were read, if there is one. */
static froe_status end_hull(csv_reader *c) {
    if (!c->corners.count) return FROE_OK;
    froe_status status = begin_object(c, &c->first);
    if (!status) status = formats_sink_hull(c->sink, c->corners.data, c->corners.count / (size_t)c->table.dim);
    c->corners.count = 0;
    return status;
}

/* A row as a corner of the hull that it says. */
static froe_status take_corner(csv_reader *c, const csv_row *r) {
    if (c->corners.count && c->first.hull != r->hull) {
        const froe_status status = end_hull(c);
        if (status) return status;
    }
    if (!c->corners.count) c->first = *r;
    return array_append(&c->sink->alloc, &c->corners, r->numbers, (size_t)c->table.dim)
               ? FROE_OK
               : support_fail_memory(c->sink->diag);
}

/* What stands behind a quotation mark that is not closed would be one field: rows would be lost. */
static froe_status refuse_open(formats_sink *sink, uint64_t line) {
    return support_fail(sink->diag, FROE_E_FORMAT, "%s: line %llu: A quotation mark is not closed.",
                        support_short(sink->path), (unsigned long long)line);
}

/* A row as the object that it says. */
static froe_status read_row(csv_reader *c, char **at, uint64_t row) {
    formats_sink *sink = c->sink;
    const formats_csv_table *t = &c->table;
    csv_row *r = &c->row;
    bool last = false;
    int column = 0;
    const uint64_t line = c->line++;
    r->row = sink->number = row;
    r->name = NULL;
    for (; !last; ++column) {
        const int place = column < t->columns ? c->place[column] : NO_NUMBER;
        if (place != NO_NUMBER && support_csv_plain(at, t->separator, r->numbers + place, &last)) continue;
        const support_csv_field field = support_csv_next(at, t->separator);
        if (field.open) return refuse_open(sink, line);
        c->line += support_csv_line_ends(&field);
        last = field.last;
        const froe_status status = column < t->columns ? read_field(c, column, field.text) : FROE_OK;
        if (status) return status;
    }
    if (column != t->columns && !(t->spare && column == t->columns - 1))
        return formats_sink_fail(sink, FROE_E_FORMAT, "The row has %d column%s, and the header %d.", column,
                                 support_plural((uint64_t)column), t->columns);
    if (t->kind == FROE_HULL) return take_corner(c, r);
    const froe_status status = begin_object(c, r);
    if (status) return status;
    if (t->kind == FROE_SEGMENT) return formats_sink_segment(sink, r->numbers, r->numbers + t->dim);
    if (t->kind == FROE_BOX) return formats_sink_box(sink, r->numbers, r->numbers + t->dim);
    if (t->kind == FROE_BALL) return formats_sink_ball(sink, r->numbers, r->numbers[RADIUS]);
    return formats_sink_point(sink, r->numbers);
}

/* Does the next line have no record? Then it is passed. */
static bool pass_blank_line(csv_reader *c, char **at) {
    if ((unsigned char)**at > ' ') return false;
    const char *word = *at + strspn(*at, " \t\r");
    if (*word != '\n' && *word) return false;
    *at += strcspn(*at, "\n");
    *at += **at == '\n';
    ++c->line;
    return true;
}

static froe_status refuse_header(const csv_reader *c, const formats_source *source, formats_csv_header what) {
    const char *name = support_short(source->path);
    froe_diagnostic *diag = c->sink->diag;
    if (what == FORMATS_CSV_BEYOND)
        return support_fail(diag, FROE_E_UNSUPPORTED, "%s: The header has more than %d axes.", name, FROE_MAX_DIM);
    if (what == FORMATS_CSV_HALVES)
        return support_fail(diag, FROE_E_FORMAT,
                            "%s: Columns of boxes are lo_ and hi_, of segments from_ and to_, of the same two or more "
                            "axes, as in lo_x,lo_y,hi_x,hi_y.",
                            name);
    return support_fail(diag, FROE_E_FORMAT,
                        "%s: The header names %s. Columns of points are x,y or x1,x2 or lon,lat or easting,northing, "
                        "of balls x,y,r, of boxes lo_x,lo_y,hi_x,hi_y or xmin,ymin,xmax,ymax.",
                        name, c->table.found);
}

/* Names of groups are kept by where they stand in the text, which a text that is passed as it is read does not keep. */
static froe_status refuse_names(const csv_reader *c) {
    for (int i = 0; i < c->table.columns && c->sink->deliver; ++i)
        if (c->table.role[i] == FORMATS_CSV_NAME)
            return support_fail(c->sink->diag, FROE_E_UNSUPPORTED,
                                "%s: The rows name groups, which are read as a scene alone.",
                                support_short(c->sink->path));
    return FROE_OK;
}

froe_status formats_read_csv(const formats_source *source, formats_sink *sink) {
    enum { ROWS_PER_REPORT = 4096 };
    formats_text text = {0};
    csv_reader c = {.sink = sink};
    uint64_t row = 0;
    froe_status status = formats_is_utf16(source) ? formats_refuse_utf16(source, sink)
                         : sink->deliver          ? formats_map_text(source, sink, &text)
                                                  : formats_load(source, sink, false, &text);
    char *at = text.data;
    const formats_csv_header what = status ? FORMATS_CSV_OURS : formats_csv_read_header(&at, &c.table);
    if (c.table.open)
        status = refuse_open(sink, 1);
    else if (what != FORMATS_CSV_OURS)
        status = refuse_header(&c, source, what);
    c.line = c.table.lines + 1;
    if (!status) status = refuse_names(&c);
    if (!status) status = formats_sink_open(sink, c.table.dim);
    sink->unit = "row";
    sink->report.layers = 1;
    if (!status)
        formats_report_format(sink, "float64", "CSV %ss",
                              c.table.kind == FROE_BOX ? "boxe" : froe_kind_name(c.table.kind));
    for (int i = 0; i < c.table.columns; ++i) c.place[i] = place_of_role(&c.table, c.table.role[i]);
    while (!status && *at) {
        if (pass_blank_line(&c, &at)) continue;
        status = read_row(&c, &at, ++row);
        if (status || row % ROWS_PER_REPORT) continue;
        status = formats_sink_progress(sink, (double)(at - text.data) / (double)text.count);
        if (sink->deliver) formats_pass_text(&text, at);
    }
    if (!status) status = end_hull(&c);
    if (!status && at < text.data + text.count) status = formats_refuse_zero(source, sink, (size_t)(at - text.data));
    array_free(&sink->alloc, &c.corners);
    if (sink->deliver)
        formats_unmap_text(&text);
    else
        array_free(&sink->alloc, &text);
    return status;
}
