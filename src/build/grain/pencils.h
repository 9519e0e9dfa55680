/* pencils.h: the pencils that were swept for the cut of one cell, with what they gave.
 *
 * Exchanging vertices of several planes ends at the same few planes, and every end is only known for one after all
 * pencils about its edges were swept in vain. So about half of those pencils have been swept before. */
#ifndef FROE_BUILD_GRAIN_PENCILS_H
#define FROE_BUILD_GRAIN_PENCILS_H
#include "build/grain/sweep.h"

enum { SPLIT_PENCILS = 2048 }; /* a power of two */

/** An axle by its vertices, the lower first, in one part of the view. */
typedef struct split_axle {
    uint32_t low, high;
    bool few;
} split_axle;

typedef struct split_pencil {
    split_axle axle;
    uint32_t cell;         /**< number of the cell for which it was swept */
    uint32_t marks;        /**< of the view then */
    double limit;          /**< below which a plane was sought */
    split_sweep_best best; /**< vertex FROE_NONE: there is none */
} split_pencil;

typedef struct split_pencils {
    uint32_t cell, count;
    split_pencil of[SPLIT_PENCILS]; /**< open addressing */
} split_pencils;

/** Forgets all pencils. */
void split_pencils_begin(split_pencils *pencils);
static inline split_axle split_axle_of(uint32_t a, uint32_t b, bool few) {
    return (split_axle){a < b ? a : b, a < b ? b : a, few};
}
/** The place of a pencil, with its axle, and with limit -INFINITY if it was not swept yet. NULL: there is no room. */
split_pencil *split_pencil_at(split_pencils *pencils, split_axle axle);
#endif
