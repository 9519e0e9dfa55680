/* plot.h: figures of numbers as SVG: lines with markers, columns, or markers alone. Companion of draw.h (link
 * froe-draw).
 *
 *     froe_plot_series s = {.name = "density", .x = n, .y = size, .count = 5};
 *     froe_plot_options o = froe_plot_defaults();
 *     o.title = "Size", o.log_x = o.log_y = true;
 *     froe_plot_write(&s, 1, write_to_file, file, &o, NULL);
 *
 * A figure is one <svg> element, to stand in a file of its own or within a page. Axes and text have the colour of
 * the text around them (currentColor), so that it fits light pages, dark ones and paper; series differ in colour,
 * marker and, from the ninth on, dashes. The same numbers make the same bytes. */
#ifndef FROE_PLOT_H
#define FROE_PLOT_H
#include <froe/draw.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Points of one colour, in the order in which lines join them. */
typedef struct froe_plot_series {
    const char *name; /**< in the key; UTF-8. A figure of one series, or of series without names, has no key; a series
                         without points is not in it, but has its colour all the same */
    const double *x, *y;
    size_t count;
} froe_plot_series;

typedef enum froe_plot_kind {
    FROE_PLOT_LINES = 0,   /**< markers joined by lines */
    FROE_PLOT_COLUMNS = 1, /**< columns from the axis, `column` wide, around x */
    FROE_PLOT_POINTS = 2   /**< markers alone */
} froe_plot_kind;

typedef struct froe_plot_options {
    size_t size; /**< set by froe_plot_defaults() */
    froe_plot_kind kind;
    const char *title, *x_label, *y_label; /**< UTF-8; NULL: none */
    bool log_x, log_y;                     /**< logarithmic axes; what is not positive is left out */
    double column;                         /**< width of columns, in units of x; default 0.8 */
    double width, height;                  /**< in pixels, 60 .. 4000; default 460 x 300; the key comes below */
    const froe_allocator *alloc;           /**< NULL: malloc */
} froe_plot_options;
FROE_API froe_plot_options froe_plot_defaults(void);

/** Writes the figure. Points that are not finite are left out; a figure without any says so. FROE_E_OPTIONS: a value
 * out of its range. FROE_E_ARG: fn is NULL. FROE_E_MEMORY. FROE_E_IO: fn returned false. O(points). */
FROE_API froe_status froe_plot_write(const froe_plot_series *series, size_t count, froe_draw_write_fn *fn, void *user,
                                     const froe_plot_options *options, froe_diagnostic *diag);

#ifdef __cplusplus
}
#endif
#endif
