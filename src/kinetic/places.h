/* places.h: where the ends of a snapshot's objects are, exactly: the internal type. */
#ifndef FROE_KINETIC_PLACES_H
#define FROE_KINETIC_PLACES_H
#include "kinetic/motion/poly.h"

/** A whole number among the limbs. */
typedef struct places_part {
    size_t at;
    uint32_t count;
    int sign;
} places_part;

typedef struct places_entry {
    places_part part[3]; /**< x, y, w */
    bool rounded;
} places_entry;

struct froe_places {
    froe_allocator alloc;
    ARRAY(uint64_t) limbs;
    ARRAY(places_entry) entries; /**< 2 object + end */
};

froe_places *places_new(const froe_allocator *alloc); /**< NULL: no memory */
/** Adds the next end, a point of degree 0. False: no memory. */
bool places_add(froe_places *places, const exact_point *at, bool rounded);
#endif
