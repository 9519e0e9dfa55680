/* marks.c: see marks.h. */
#include "args/marks.h"
#include "args/scene.h"
#include "exit.h"
#include "queries/rows.h"
#include <stdlib.h>
#include <string.h>

static bool set_mark(const froe_scene *scene, uint32_t id, froe_draw_mark *mark) {
    const froe_object o = froe_scene_object(scene, id);
    const uint32_t last = o.corners ? o.corners - 1 : 0;
    *mark = (froe_draw_mark){.kind = o.form == FROE_BOX    ? FROE_DRAW_MARK_BOX
                                     : o.form == FROE_BALL ? FROE_DRAW_MARK_BALL
                                                           : FROE_DRAW_MARK_LINE};
    if (o.form == FROE_POLYGON || o.form == FROE_HULL || !o.corners) return false;
    for (int k = 0; k < froe_scene_dim(scene); k++) {
        mark->lo[k] = froe_scene_vertex(scene, froe_scene_corner(scene, id, 0))[k] - o.radius;
        mark->hi[k] = froe_scene_vertex(scene, froe_scene_corner(scene, id, last))[k] + o.radius;
    }
    if (o.group != FROE_NONE) mark->label = froe_scene_group(scene, o.group).name;
    return true;
}

static bool has_origins(const cli_rows *rows) {
    for (size_t i = 0; i < rows->columns; i++)
        if (rows->names[i] && strcmp(rows->names[i], "ox") == 0) return true;
    return false;
}

/* Lets lines begin where the rows of the CSV that the points come from say. */
static int read_origins(const char *path, int dim, cli_marks *out) {
    static const cli_column points[] = {{"", true}, {0}}, rays[] = {{"o", true}, {"", true}, {0}};
    double values[CLI_ROW_NUMBERS];
    cli_rows rows;
    int code = cli_rows_open(path, points, dim, &rows);
    if (code) return code;
    const bool any = has_origins(&rows);
    cli_rows_close(&rows);
    if (!any) return 0;
    code = cli_rows_open(path, rays, dim, &rows);
    if (code) return code;
    cli_row row = CLI_ROW_READ;
    for (size_t i = 0; i < out->count && row == CLI_ROW_READ; i++) {
        row = cli_rows_next(&rows, values);
        for (int k = 0; row == CLI_ROW_READ && k < dim; k++) out->marks[i].lo[k] = values[k];
    }
    if (row != CLI_ROW_READ) code = cli_fail(CLI_INPUT, path, "row %zu: %s", (size_t)rows.row, rows.sentence);
    cli_rows_close(&rows);
    return code;
}

int cli_marks_read(const cli_common *common, const char *path, int dim, cli_marks *out) {
    *out = (cli_marks){.scene = NULL};
    if (!path) return 0;
    froe_read_report reader;
    const cli_scene_args args = {.path = path, .faces = -1};
    const int code = cli_read_scene(common, &args, &out->scene, &reader);
    if (code) {
        out->scene = NULL;
        return code;
    }
    if (froe_scene_dim(out->scene) != dim)
        return cli_fail(CLI_INPUT, path, "Its dimension is %d, and that of the picture is %d.",
                        froe_scene_dim(out->scene), dim);
    const size_t count = froe_scene_object_count(out->scene);
    out->marks = malloc((count + 1) * sizeof *out->marks);
    if (!out->marks) return cli_fail_memory();
    for (size_t i = 0; i < count; i++) out->count += set_mark(out->scene, (uint32_t)i, &out->marks[out->count]);
    if (out->count < count)
        return cli_fail(CLI_INPUT, path, "Marks are points, segments, boxes and balls, and %zu of its objects are not.",
                        count - out->count);
    const char *ending = strrchr(path, '.');
    return ending && strcmp(ending, ".csv") == 0 ? read_origins(path, dim, out) : 0;
}

void cli_marks_free(cli_marks *marks) {
    froe_scene_free(marks->scene);
    free(marks->marks);
}
