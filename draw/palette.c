/* palette.c: the colours, pale yellow to slate blue. The depth scale is a quadratic curve in OKLab
 * (B. Ottosson, 2020) from L 0.975 C 0.02 h 90 over L 0.84 C 0.085 h 185 to L 0.54
 * C 0.085 h 245, cut into eight pieces of equal length: equal steps in depth look
 * equal, and lightness alone carries the order, so that it survives colour
 * blindness and grey printers. The accent is its complement. */
#include "palette.h"

static const uint32_t anchors[9] = {0xFCF7E8, 0xD8ECE0, 0xB8DED7, 0x9DCECE, 0x84BDC4,
                                    0x6FABBB, 0x5D99B1, 0x4E86A7, 0x41749D};

uint32_t draw_mix(uint32_t a, uint32_t b, double t) {
    uint32_t mixed = 0;
    for (int shift = 0; shift < 24; shift += 8) {
        double from = a >> shift & 255, to = b >> shift & 255;
        mixed |= (uint32_t)(from + t * (to - from) + 0.5) << shift;
    }
    return mixed;
}

uint32_t draw_tone(int tone) {
    double t = 8.0 * tone / (DRAW_TONES - 1);
    int i = t >= 8 ? 7 : (int)t;
    return draw_mix(anchors[i], anchors[i + 1], t - i);
}

int draw_tone_of(double depth, double lo, double hi) {
    double t = hi > lo ? (depth - lo) / (hi - lo) : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return (int)(t * (DRAW_TONES - 1) + 0.5);
}

void draw_set_color(cairo_t *cr, uint32_t rgb, double alpha) {
    cairo_set_source_rgba(cr, (rgb >> 16 & 255) / 255.0, (rgb >> 8 & 255) / 255.0, (rgb & 255) / 255.0, alpha);
}
