/* space.h: the layout of packed trees of space: leaves as blocks of whole objects in 16 bits.
 *
 *     blocks    [header | ids.. | x0.. y0.. z0.. x1.. y1.. z1.. | x2.. y2.. z2.. | zeros]  ...  [sentinel]
 *
 * Objects are not cut: like boxes in every tree, they are listed whole in all leaves whose closed cell they may meet,
 * and certainly in those whose open cell they do meet. First come the triangles of a leaf, as three corners; then
 * everything else, as the bounds (x0, y0, z0), (x1, y1, z1) of its part in the cell. All are whole numbers of the
 * frame, a cube around those corners and bounds:
 *
 *        +-----------------+  65535     frame    lo and 1 / scale, a power of 2
 *        |    +--------+   |            corners  are at most 1/2 + 2^-20 units from the truth
 *        |    | box    |   |            bounds   hold the part in the cell, up to 2^-20 units
 *        |    +--------+   |            box      holds the parts in the cell of all that is listed, up to 2^-20 units
 *     lo +-----------------+  0
 *
 * So any point of an object lies in the box of a leaf that lists it, and a search may go by boxes
 * alone: tree/packed/wide.h.
 *
 * It speaks for space.c, space_audit.c and space_validate.c. */
#ifndef FROE_TREE_PACKED_SPACE_H
#define FROE_TREE_PACKED_SPACE_H
#include "tree/packed/packed.h"

#define SPACE_EXACT 0x80000000u /**< with an id: the object is a box or a point; its bounds say all of it */

/** Begins every block of a tree of space. */
typedef struct space_header {
    double lo[3];
    double scale; /**< units per 1; 0: there are no objects, or doubles cannot tell: then the tree has no wide
                     nodes, which lead searches to blocks; all numbers are 0 */
    uint32_t count, triangles;
    uint16_t box[2][3];
    uint8_t unused[12];
} space_header;
_Static_assert(sizeof(space_header) == PACKED_BLOCK, "a cache line");

/** An object on its way into leaves: the bounds of its part in the cell, rounded outwards. */
typedef struct space_item {
    double lo[3], hi[3];
    uint32_t object;
    uint32_t corner; /**< the first one of a triangle; FROE_NONE: it is none */
} space_item;

/** Corner c of a triangle. */
static inline const double *space_corner(const froe_scene *s, const space_item *item, uint32_t c) {
    return s->coords + 3 * (size_t)scene_corner_vertex(s, item->corner + c);
}
/** Prefetches the ids of a triangle's corners; once they are in the cache, the corners. */
static inline void space_ask(const froe_scene *s, const space_item *item) {
    if (item->corner != FROE_NONE) scene_ask_corner(s, item->corner);
}
static inline void space_ask_corners(const froe_scene *s, const space_item *item) {
    for (uint32_t c = 0; item->corner != FROE_NONE && c < 3; c++) {
        const double *x = space_corner(s, item, c);
        __builtin_prefetch(x);
        __builtin_prefetch(x + 2); /* the next line, perhaps */
    }
}

static inline const space_header *space_block(const froe_tree *t, uint32_t block) {
    return (const space_header *)(const void *)(t->packed.blocks + (size_t)block * PACKED_BLOCK);
}
static inline const uint32_t *space_ids(const space_header *block) {
    return (const uint32_t *)(const void *)(block + 1);
}
/** Row 0 .. 5, of `count` numbers, or 6 .. 8, of `triangles`. */
static inline const uint16_t *space_row(const space_header *block, int row) {
    size_t rows =
        row < 6 ? (size_t)row * block->count : 6 * (size_t)block->count + (size_t)(row - 6) * block->triangles;
    return (const uint16_t *)(const void *)(space_ids(block) + block->count) + rows;
}
/** Blocks that a leaf takes. */
static inline uint32_t space_size(uint32_t count, uint32_t triangles) {
    return (uint32_t)((sizeof(space_header) + 16 * (uint64_t)count + 6 * (uint64_t)triangles + PACKED_BLOCK - 1) /
                      PACKED_BLOCK);
}
static inline bool tree_is_space(const froe_tree *t) {
    return tree_is_packed(t) && t->scene->dim == 3;
}
static inline bool space_is_triangle(const froe_scene *s, uint32_t object) {
    return scene_form(s, object) == FROE_POLYGON && scene_corners(s, object) == 3;
}

/** Can units hold the coordinates of scenes within these bounds? */
bool space_is_tame(const double *lo, const double *hi);
/** Triangles among items, which are brought to the front. */
uint32_t space_sort(space_item *items, uint32_t count);
/** Writes header, ids and rows of items that have been sorted to a zeroed block. */
void space_write(space_header *block, const froe_scene *s, const space_item *items, uint32_t count, uint32_t triangles);
/** What is wrong in the block of a leaf, as a clause, or NULL. It begins before the sentinel. *size: blocks that it
 * takes. O(pieces). */
const char *space_leaf_fault(const froe_tree *t, uint32_t block, uint32_t *size);
/** Checks what is special of a packed tree of space whose nodes have been checked (tree/validate.h). */
froe_status space_validate(const froe_tree *t, froe_diagnostic *diag);
/** Checks a piece in its block: its object may meet the cell, its numbers are right, and the box of the leaf holds the
 * part of the object in the cell. Exact. NULL, or what is wrong, as a clause. */
const char *space_refuted(num_context *context, const froe_tree *t, uint32_t piece);
#endif
