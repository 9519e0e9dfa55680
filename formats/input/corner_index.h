/* corner_index.h: corners of a polygon in the plane, marked and unmarked, and a search for marked ones in a triangle.
 *
 *     level 2              [ all ]                     eight neighbours along a curve make a node, which has the box
 *     level 1      [ 8 ] [ 8 ] [ 8 ] ...               of its corners and how many of them are marked: a search passes
 *     level 0     p p p p p p p p p ...                over nodes without marks, and over those beside the triangle
 *
 * The curve is Morton's (1966) over ranks of x and y, so that neither clusters nor rows of corners spoil the boxes.
 * Corners in one place are one entry. */
#ifndef FROE_FORMATS_CORNER_INDEX_H
#define FROE_FORMATS_CORNER_INDEX_H
#include "support/alloc.h"

enum { FORMATS_CORNER_FAN = 8, FORMATS_CORNER_LEVELS = 12 };

typedef struct formats_corner_index {
    size_t count;                                      /**< corners */
    uint32_t levels, first[FORMATS_CORNER_LEVELS + 1]; /**< entries of each level */
    double (*box)[4];                                  /**< of each entry: low x, y, high x, y */
    uint32_t *marks;                                   /**< of each entry: marked corners below */
    uint32_t *place;                                   /**< of each corner: its entry of level 0 */
} formats_corner_index;

/** Over `count` corners xy, none marked yet. O(count log count). False: no memory. */
bool formats_corner_index_new(const froe_allocator *alloc, const double *xy, uint32_t count, formats_corner_index *out);
void formats_corner_index_free(const froe_allocator *alloc, formats_corner_index *index);

/** Marks a corner, or takes its mark away. O(log count). */
void formats_corner_index_mark(formats_corner_index *index, uint32_t corner, bool marked);
/** Is a marked corner in the closed triangle a b c, which turns left, but for corners in the places of a, b and c?
 * Signs as of formats_orient(). About O(sqrt(count)). */
bool formats_corner_index_any(const formats_corner_index *index, const double *a, const double *b, const double *c);
#endif
