/* lettering.h: single-stroke letters, so that pictures need no font
 * of the system and have the same bytes everywhere. */
#ifndef FROE_DRAW_LETTERING_H
#define FROE_DRAW_LETTERING_H
#include <cairo.h>
#include <stdbool.h>
#include <stdint.h>

/** Can every character of this UTF-8 text be written? */
bool draw_text_known(const char *text);
/** Length of a text of this size (size: of the em; capitals are 0.7 of it). Texts
 * that are not known in full are measured, and shown, in the system's sans serif. */
double draw_text_length(cairo_t *cr, const char *text, double size);
/** Writes from (x, y) on the base line in the current colour; align 0: x is the left
 * end, 0.5: the middle, 1: the right end. */
void draw_text(cairo_t *cr, const char *text, double x, double y, double size, double align);
/** The same from a left end, in `ink` with a rim of `paper` around the letters, to be read over a map. */
void draw_text_backed(cairo_t *cr, const char *text, double x, double y, double size, uint32_t paper, uint32_t ink);
#endif
