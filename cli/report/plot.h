/* plot.h: figures of numbers as SVG: lines with markers, columns, or markers alone. For froe compare, and for benches.
 *
 * A figure is one <svg> element, to stand in a file of its own or within a page. Axes and text have the colour of
 * the text around them (currentColor), so that it fits light pages, dark ones and paper; series differ in colour,
 * marker and, from the ninth on, dashes. The same numbers make the same bytes in every locale. */
#ifndef CLI_PLOT_H
#define CLI_PLOT_H
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/** Points of one colour, in the order in which lines join them. */
typedef struct plot_series {
    const char *name; /**< in the key; UTF-8. A figure of one series, or of series without names, has no key; a series
                         without points is not in it, but has its colour all the same */
    const double *x, *y;
    size_t count;
} plot_series;

typedef enum plot_kind {
    PLOT_LINES = 0,   /**< markers joined by lines */
    PLOT_COLUMNS = 1, /**< columns from the axis, `column` wide, around x */
    PLOT_POINTS = 2   /**< markers alone */
} plot_kind;

typedef struct plot_options {
    plot_kind kind;
    const char *title, *x_label, *y_label; /**< UTF-8; NULL: none */
    bool log_x, log_y;                     /**< logarithmic axes; what is not positive is left out */
    double column;                         /**< width of columns, in units of x; default 0.8 */
    double width, height;                  /**< in pixels, 60 .. 4000; default 460 x 300; the key comes below */
} plot_options;
plot_options plot_defaults(void);

/** Writes the figure; `out` keeps its errors. Points that are not finite are left out; a figure without any says so.
 * O(points). */
void plot_put(FILE *out, const plot_series *series, size_t count, const plot_options *options);
#endif
