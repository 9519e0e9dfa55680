/* chord.h: the segment to cut along, of those that cross a region from border to border.
 *
 * That is the one that leaves least on the heavier side. Chords that do not cross divide a convex region like the
 * edges of a tree: what is on the lighter side of one is no better than that one. So the search goes on among those
 * on the heavier side, from a random one each time: O(log m) rounds over m fragments, expected, where chords lie in
 * a bounded number of rows, as they do in regions with few sides. Sides are those of middles, in doubles. */
#ifndef FROE_BUILD_CONVERSION_CHORD_H
#define FROE_BUILD_CONVERSION_CHORD_H
#include "split/grow.h"

typedef struct chord_item {
    double middle[2];
    uint32_t item;   /**< of the cell */
    uint32_t weight; /**< 1: a chord; more: something else, which lies between chords */
} chord_item;

typedef struct chord_search {
    ARRAY(chord_item) items;
    ARRAY(uint32_t) chords; /**< candidates: places in items */
} chord_search;

void chord_free(const froe_allocator *alloc, chord_search *search);
/** Forgets everything, and makes room for the fragments of a cell. False without memory. */
bool chord_begin(chord_search *search, const split_set *set, const split_cell *cell);
void chord_add(chord_search *search, const split_set *set, const split_cell *cell, uint32_t item, bool is_chord);
/** The best chord, as an item of the cell. REQUIRES: there is one. */
uint32_t chord_choose(chord_search *search, const split_set *set, const split_cell *cell, uint64_t seed);
#endif
