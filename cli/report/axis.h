/* axis.h: scales of figures: from numbers to places on the page, and where ticks stand. */
#ifndef CLI_AXIS_H
#define CLI_AXIS_H
#include <stdbool.h>
#include <stddef.h>

typedef struct plot_axis {
    bool log;
    double lo, hi;   /**< of the numbers; lo > hi: none yet */
    double from, to; /**< where these lie on the page */
} plot_axis;

plot_axis plot_axis_new(bool log);
/** Can the number be shown? */
bool plot_axis_shows(const plot_axis *axis, double value);
/** Widens the axis so that it shows the number, if it can. */
void plot_axis_add(plot_axis *axis, double value);
/** Moves the ends out to ticks, or a little beyond the numbers. */
void plot_axis_round(plot_axis *axis);
double plot_axis_at(const plot_axis *axis, double value);

enum { PLOT_TICKS = 24 };
/** Values of ticks, at most PLOT_TICKS; returns how many. */
size_t plot_axis_ticks(const plot_axis *axis, double *out);
/** A tick's number for reading, e.g. 0.05, 20, 50k, 2M; the same in every locale. `text` holds at least 24 bytes. */
void plot_axis_label(double value, char *text);
#endif
