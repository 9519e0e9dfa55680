/* marks.h: places to be marked in pictures, from a file that holds a scene. */
#ifndef FROE_CLI_MARKS_H
#define FROE_CLI_MARKS_H
#include "args/options.h"
#include <froe/draw.h>

typedef struct cli_marks {
    froe_scene *scene; /**< holds the labels */
    froe_draw_mark *marks;
    size_t count;
} cli_marks;

/** Reads the file: points become dots, segments lines, boxes and balls outlines; names of their features become labels.
 * A CSV of points with columns ox,oy[,oz], as froe ray writes it, gives lines from there to the points. One of
 * ax,ay[,az],bx,by[,bz], as segments are asked for, gives segments; with r, for capsules, the balls around their ends
 * beside them. Equal marks are kept once. `dim`: of the picture's scene. `path` NULL: no marks. Returns 0, or an exit
 * code after saying why; cli_marks_free() must follow in any case. */
int cli_marks_read(const cli_common *common, const char *path, int dim, cli_marks *out);
void cli_marks_free(cli_marks *marks);
#endif
