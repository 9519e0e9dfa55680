/* colour.h: a colour as groups have it. */
#ifndef FROE_FORMATS_COLOUR_H
#define FROE_FORMATS_COLOUR_H
#include <stdint.h>

/** A colour (see froe_group) of four shares, cut to 0 .. 1. */
static inline uint32_t formats_colour(const double rgba[4]) {
    uint32_t out = 0;
    for (int i = 0; i < 4; i++) {
        const double share = rgba[i] > 0 ? rgba[i] < 1 ? rgba[i] : 1 : 0;
        out = out << 8 | (uint32_t)(share * 255 + 0.5);
    }
    return out;
}
#endif
