/* axis.h: scales of figures: from numbers to places on the page, and where ticks stand. */
#ifndef FROE_DRAW_AXIS_H
#define FROE_DRAW_AXIS_H
#include <stdbool.h>
#include <stddef.h>

typedef struct draw_axis {
    bool log;
    double lo, hi;   /**< of the numbers; lo > hi: none yet */
    double from, to; /**< where these lie on the page */
} draw_axis;

draw_axis draw_axis_new(bool log);
/** Can the number be shown? */
bool draw_axis_shows(const draw_axis *axis, double value);
/** Widens the axis so that it shows the number, if it can. */
void draw_axis_add(draw_axis *axis, double value);
/** Moves the ends out to ticks, or a little beyond the numbers. */
void draw_axis_round(draw_axis *axis);
double draw_axis_at(const draw_axis *axis, double value);

enum { DRAW_TICKS = 24 };
/** Values of ticks, at most DRAW_TICKS; returns how many. */
size_t draw_axis_ticks(const draw_axis *axis, double *out);
/** A tick's number for reading, e.g. 0.05, 20, 50k, 2M; the same in every locale. `text` holds at least 24 bytes. */
void draw_axis_label(double value, char *text);
#endif
