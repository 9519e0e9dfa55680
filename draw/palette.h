/* palette.h: the colours of froe's pictures. */
#ifndef FROE_DRAW_PALETTE_H
#define FROE_DRAW_PALETTE_H
#include <cairo.h>
#include <stdint.h>

#define DRAW_PAPER 0xFDFCF8u  /**< page */
#define DRAW_INK 0x1B2630u    /**< objects and text */
#define DRAW_SOFT 0x6B7680u   /**< small text */
#define DRAW_ACCENT 0xC8502Du /**< where a cut went through an object */
#define DRAW_WOOD 0xE3A070u   /**< every second fragment of a cut object */
#define DRAW_LAND 0xF0DFB6u   /**< areas of features */
#define DRAW_LINE 0x24506Au   /**< cuts */

enum { DRAW_TONES = 64 };
/** Tone 0 (pale) .. DRAW_TONES-1 (dark) of the depth scale, 0xRRGGBB. */
uint32_t draw_tone(int tone);
/** The tone of a depth on a scale from lo to hi. */
int draw_tone_of(double depth, double lo, double hi);
/** From a (t = 0) to b (t = 1). */
uint32_t draw_mix(uint32_t a, uint32_t b, double t);
/** What is painted next has this colour. */
void draw_set_color(cairo_t *cr, uint32_t rgb, double alpha);
#endif
