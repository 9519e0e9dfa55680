/* marks.c: see marks.h. */
#include "args/marks.h"
#include "args/scene.h"
#include "exit.h"
#include "queries/rows.h"
#include "support/path.h"
#include "support/utf8.h"
#include <stdlib.h>
#include <string.h>

/* Which columns of lines and capsules does the header of a CSV name? */
typedef struct marks_header {
    bool csv, origins, ends, radius;
} marks_header;

static int read_header(const char *path, int dim, marks_header *out) {
    static const cli_column none[] = {{0}};
    cli_rows rows;
    const support_extension extension = support_path_extension(path);
    *out = (marks_header){.csv = strcmp(extension.text, "csv") == 0 || strcmp(extension.text, "tsv") == 0};
    if (!out->csv) return 0;
    const int code = cli_rows_open(path, none, dim, &rows);
    for (size_t i = 0; !code && i < rows.columns; i++) {
        out->origins |= support_equal_nocase(rows.names[i], "ox");
        out->ends |= support_equal_nocase(rows.names[i], "ax");
        out->radius |= support_equal_nocase(rows.names[i], "r");
    }
    if (!code) cli_rows_close(&rows);
    return code;
}

/* ---------------------------------------------------- capsules and segments -- */

static int fail_row(const cli_rows *rows, const char *sentence) {
    return cli_fail(CLI_INPUT, rows->path, "row %llu: %s", (unsigned long long)rows->row + 1, sentence);
}

static froe_status add_one(froe_scene *scene, froe_kind kind, const double *at, double radius, uint32_t group,
                           froe_diagnostic *diag) {
    froe_objects o = froe_objects_defaults();
    o.kind = kind, o.count = 1, o.coords = at, o.group = group;
    if (kind == FROE_BALL) o.radii = &radius;
    return froe_scene_add(scene, &o, diag);
}

/* A segment with its name, and the balls around its ends where there is a radius. */
static froe_status add_capsule(froe_scene *scene, const double *values, bool ball, const char *name,
                               froe_diagnostic *diag) {
    const int dim = froe_scene_dim(scene);
    uint32_t group = FROE_NONE;
    froe_status status = name && *name ? froe_scene_add_group(scene, &(froe_group){.name = name}, &group) : FROE_OK;
    if (status) return FROE_E_MEMORY;
    for (int end = 0; ball && !status && end < 2; end++)
        status = add_one(scene, FROE_BALL, values + end * dim, values[2 * dim], FROE_NONE, diag);
    return status ? status : add_one(scene, FROE_SEGMENT, values, 0, group, diag);
}

/* Rows ax,ay,bx,by or ax,ay,bx,by,r, as questions have them. */
static int read_capsules(const char *path, bool ball, froe_scene *scene) {
    static const cli_column capsules[] = {{"a", true}, {"b", true}, {"r", false}, {0}};
    static const cli_column segments[] = {{"a", true}, {"b", true}, {0}};
    double values[CLI_ROW_NUMBERS];
    cli_rows rows;
    cli_row row;
    int code = cli_rows_open(path, ball ? capsules : segments, froe_scene_dim(scene), &rows);
    if (code) return code;
    size_t name = 0;
    while (name < rows.columns && !support_equal_nocase(rows.names[name], "name")) name++;
    while (!code && (row = cli_rows_next(&rows, values)) != CLI_ROWS_END) {
        if (row == CLI_ROWS_FAILED) code = rows.code;
        if (row == CLI_ROW_BAD) code = fail_row(&rows, rows.sentence);
        if (row != CLI_ROW_READ) continue;
        froe_diagnostic diag = {0};
        const char *label = name < rows.columns ? rows.fields[name].text : NULL;
        if (!support_is_utf8(label)) {
            code = fail_row(&rows, "Its name is not UTF-8.");
            break;
        }
        const froe_status status = add_capsule(scene, values, ball, label, &diag);
        if (status == FROE_E_MEMORY) code = cli_fail_memory();
        if (status && !code) code = fail_row(&rows, diag.message);
    }
    cli_rows_close(&rows);
    return code;
}

/* ------------------------------------------------------------------- marks -- */

static bool set_mark(const froe_scene *scene, uint32_t id, froe_draw_mark *mark) {
    const froe_object o = froe_scene_object(scene, id);
    const uint32_t last = o.corners - 1;
    *mark = (froe_draw_mark){.kind = o.form == FROE_BOX    ? FROE_DRAW_MARK_BOX
                                     : o.form == FROE_BALL ? FROE_DRAW_MARK_BALL
                                                           : FROE_DRAW_MARK_LINE};
    if (o.form == FROE_POLYGON || o.form == FROE_HULL) return false;
    for (int k = 0; k < froe_scene_dim(scene); k++) {
        mark->lo[k] = froe_scene_vertex(scene, froe_scene_corner(scene, id, 0))[k] - o.radius;
        mark->hi[k] = froe_scene_vertex(scene, froe_scene_corner(scene, id, last))[k] + o.radius;
    }
    if (o.group != FROE_NONE) mark->label = froe_scene_group(scene, o.group).name;
    return true;
}

/* Lets lines begin where the rows of the CSV that the points come from say. */
static int read_origins(const char *path, int dim, cli_marks *out) {
    static const cli_column rays[] = {{"o", true}, {"", true}, {0}};
    double values[CLI_ROW_NUMBERS];
    cli_rows rows;
    int code = cli_rows_open(path, rays, dim, &rows);
    if (code) return code;
    cli_row row = CLI_ROW_READ;
    for (size_t i = 0; i < out->count && row == CLI_ROW_READ; i++) {
        row = cli_rows_next(&rows, values);
        for (int k = 0; row == CLI_ROW_READ && k < dim; k++) out->marks[i].lo[k] = values[k];
    }
    if (row != CLI_ROW_READ) code = fail_row(&rows, rows.sentence);
    cli_rows_close(&rows);
    return code;
}

/* Rows of a CSV make an object each. */
static int check_labels(const char *path, bool csv, const cli_marks *marks) {
    for (size_t i = 0; i < marks->count; i++)
        if (!support_is_utf8(marks->marks[i].label))
            return cli_fail(CLI_INPUT, path, "%s %zu: Its name is not UTF-8.", csv ? "row" : "object", i + csv);
    return 0;
}

static int compare_marks(const froe_draw_mark *m, const froe_draw_mark *n) {
    if (m->kind != n->kind) return m->kind < n->kind ? -1 : 1;
    for (int k = 0; k < 3; k++) {
        if (m->lo[k] != n->lo[k]) return m->lo[k] < n->lo[k] ? -1 : 1;
        if (m->hi[k] != n->hi[k]) return m->hi[k] < n->hi[k] ? -1 : 1;
    }
    return strcmp(m->label ? m->label : "", n->label ? n->label : "");
}

static int by_mark_then_place(const void *a, const void *b) {
    const froe_draw_mark *m = *(froe_draw_mark *const *)a, *n = *(froe_draw_mark *const *)b;
    const int order = compare_marks(m, n);
    return order ? order : (m > n) - (m < n);
}

/* Of equal marks the first stays; answers repeat their questions. */
static int drop_repeated(cli_marks *marks) {
    froe_draw_mark **sorted = malloc((marks->count + 1) * sizeof(froe_draw_mark *));
    bool *repeated = calloc(marks->count + 1, sizeof *repeated);
    if (sorted && repeated) {
        for (size_t i = 0; i < marks->count; i++) sorted[i] = marks->marks + i;
        qsort(sorted, marks->count, sizeof *sorted, by_mark_then_place);
        for (size_t i = 1; i < marks->count; i++)
            repeated[sorted[i] - marks->marks] = compare_marks(sorted[i - 1], sorted[i]) == 0;
        size_t kept = 0;
        for (size_t i = 0; i < marks->count; i++)
            if (!repeated[i]) marks->marks[kept++] = marks->marks[i];
        marks->count = kept;
    }
    const bool enough = sorted && repeated;
    free(sorted);
    free(repeated);
    return enough ? 0 : cli_fail_memory();
}

static int set_marks(const char *path, cli_marks *out) {
    const size_t count = froe_scene_object_count(out->scene);
    out->marks = malloc((count + 1) * sizeof *out->marks);
    if (!out->marks) return cli_fail_memory();
    for (size_t i = 0; i < count; i++) out->count += set_mark(out->scene, (uint32_t)i, &out->marks[out->count]);
    if (out->count == count) return 0;
    return cli_fail(CLI_INPUT, path, "Marks are points, segments, boxes and balls, and %zu of its objects are not.",
                    count - out->count);
}

static int read_marks(const cli_common *common, const char *path, int dim, const marks_header *header,
                      froe_scene **out) {
    if (header->ends)
        return froe_scene_new(dim, NULL, out) ? cli_fail_memory() : read_capsules(path, header->radius, *out);
    froe_read_report reader;
    const cli_scene_args args = {.path = path, .faces = -1};
    const int code = cli_read_scene(common, &args, out, &reader);
    if (code) return *out = NULL, code;
    if (froe_scene_dim(*out) == dim) return 0;
    if (dim == 3 && !header->csv)
        return cli_fail(
            CLI_INPUT, path,
            "Its dimension is %d, and that of the picture is %d. Maps are read without heights, and a CSV of "
            "x,y,z has them.",
            froe_scene_dim(*out), dim);
    return cli_fail(CLI_INPUT, path, "Its dimension is %d, and that of the picture is %d.", froe_scene_dim(*out), dim);
}

int cli_marks_read(const cli_common *common, const char *path, int dim, cli_marks *out) {
    *out = (cli_marks){.scene = NULL};
    if (!path) return 0;
    marks_header header;
    int code = read_header(path, dim, &header);
    if (!code) code = read_marks(common, path, dim, &header, &out->scene);
    if (!code) code = set_marks(path, out);
    if (!code) code = check_labels(path, header.csv && !header.ends, out);
    if (!code && header.origins) code = read_origins(path, dim, out);
    return code ? code : drop_repeated(out);
}

void cli_marks_free(cli_marks *marks) {
    froe_scene_free(marks->scene);
    free(marks->marks);
}
