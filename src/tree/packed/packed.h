/* packed.h: the layout of trees that are built to be queried: leaves as blocks of bytes.
 *
 *     nodes     as in every tree, but all cuts are axis-parallel; `child` of a leaf is the number of its block
 *     blocks    [header | px.. py.. qx.. qy.. | ids.. | zeros]  [header | ...  ]  ...  [sentinel]
 *     owners    every object once, in the order of the leaves where they begin: a subtree's are one slice
 *
 * A block holds the fragments of a cell of the plane in 16-bit units of the cell, beginning at its lower corner:
 *
 *     hi +-----------------+        p, q    ends of a fragment, p first by x, then by y
 *        |       ___--q    |        unit    1 / scale
 *        |  p---'          |        error   no stored coordinate is further than this many units from the true one,
 *     lo +-----------------+                (x - lo) * scale in exact arithmetic
 *
 * An id is that of the object, with PACKED_START where p is its own first end and PACKED_END where q is its last;
 * elsewhere an end lies in a cut. A fragment so finds its object, and the object's rings follow from the cuts
 * (tree/packed/packed.c): nothing else is stored, and nothing twice.
 *
 * General position. No corner of an object, and no point where a cut ends a fragment, lies in another cut.
 * So what meets a cut crosses it, in-cut lists are empty, and all objects through a point are in the list of every leaf
 * whose closed cell holds the point: hits on borders of cells need no care. The builder chooses its cuts so, the audit
 * proves it.
 *
 * Points are segments without length. The layout is that of docs/design/index.md, with what was measured.
 *
 * It speaks for packed.c and packed_validate.c. */
#ifndef FROE_TREE_PACKED_PACKED_H
#define FROE_TREE_PACKED_PACKED_H
#include "tree/tree.h"
#include <string.h>

#define PACKED_START 0x80000000u
#define PACKED_END 0x40000000u
#define PACKED_OBJECT 0x3fffffffu
#define PACKED_BLOCK 64u   /**< bytes; blocks begin at multiples of it */
#define PACKED_UNITS 65535 /**< on the longer side of a cell */
#define PACKED_COARSE 1e9f /**< error of a block whose coordinates say nothing: its scale is 0 */

/** Begins every block. */
typedef struct packed_header {
    double lo[2];   /**< lower corner of the cell, exactly */
    double scale;   /**< units per 1 */
    uint32_t owner; /**< objects that begin in leaves before this one */
    float error;    /**< in units, at least 0.5 */
} packed_header;
_Static_assert(sizeof(packed_header) == 32, "half a cache line, as specified");

typedef struct packed_box {
    double lo[2], hi[2];
} packed_box;

/** A fragment, as builders carry it: images of its ends, each coordinate within an error of the true one. Ends of the
 * object are exact; of an end in a cut x[axis] = value that coordinate is. */
typedef struct packed_fragment {
    double p[2], q[2];
    uint32_t id;    /**< with flags */
    uint32_t error; /**< upper half of a double, so that it has the range of the coordinates */
} packed_fragment;

static inline double packed_error(uint32_t half) {
    uint64_t bits = (uint64_t)half << 32;
    double error;
    memcpy(&error, &bits, sizeof error);
    return error;
}
/** Rounded up; infinity for what is not finite. */
static inline uint32_t packed_half(double error) {
    uint64_t bits;
    memcpy(&bits, &error, sizeof bits);
    return error <= 0x1p1020 ? (uint32_t)(bits >> 32) + 1 : 0x7ff00000u;
}

static inline const packed_header *packed_block_at(const froe_tree *t, uint32_t block) {
    return (const packed_header *)(const void *)(t->packed.blocks + (size_t)block * PACKED_BLOCK);
}
static inline const packed_header *packed_block(const froe_tree *t, const tree_node *leaf) {
    return packed_block_at(t, leaf->child);
}
/** px of a block; py, qx, qy and the ids follow, `count` each. */
static inline const uint16_t *packed_units(const packed_header *block) {
    return (const uint16_t *)(const void *)(block + 1);
}
static inline const uint32_t *packed_ids(const packed_header *block, uint32_t count) {
    return (const uint32_t *)(const void *)(packed_units(block) + 4 * (size_t)count);
}
/** Blocks that a leaf of so many fragments takes. */
static inline uint32_t packed_size(uint32_t count) {
    return (uint32_t)((sizeof(packed_header) + 12 * (uint64_t)count + PACKED_BLOCK - 1) / PACKED_BLOCK);
}
/** Ends of a segment or point of the plane, by x, then y. */
static inline void packed_ends(const froe_scene *s, uint32_t object, const double *ends[2]) {
    const double *a = scene_point(s, object, 0), *b = scene_point(s, object, scene_corners(s, object) - 1);
    bool swap = b[0] < a[0] || (b[0] == a[0] && b[1] < a[1]);
    ends[0] = swap ? b : a;
    ends[1] = swap ? a : b;
}

/** Writes header and fragments of a cell to a zeroed block. */
void packed_write(packed_header *block, const packed_box *box, uint32_t owner, const packed_fragment *fragments,
                  uint32_t count);

/** Does the block of a leaf of the plane begin at `*blocks`, with room for its pieces before the sentinel? Moves
 * *blocks behind it. */
bool packed_takes_place(const froe_tree *t, const tree_node *leaf, uint32_t *blocks);
/** What is wrong in the block of a leaf of the plane, as a clause, or NULL. The nodes have been checked. *owners,
 * objects that begin before it, is moved on. O(height + pieces). */
const char *packed_leaf_fault(const froe_tree *t, uint32_t node, uint32_t *owners);
/** Checks what is special of a packed tree whose nodes have been checked (tree/validate.h). */
froe_status packed_validate(const froe_tree *t, froe_diagnostic *diag);
/** Units per 1 for a cell, 0 where doubles cannot tell. */
double packed_scale(const packed_box *box);
/** The leaf that lists a piece. O(height^2), whatever the number of pieces: nothing is stored for it. */
uint32_t packed_leaf(const froe_tree *t, uint32_t piece);
/** The same with its cell; sides without a cut are those of the root box. */
uint32_t packed_leaf_in(const froe_tree *t, uint32_t piece, double *lo, double *hi);
/** The leaf that a block is of, and its cell; sides without a cut are those of the root box. O(height). */
uint32_t packed_cell(const froe_tree *t, const packed_header *block, packed_box *box);
/** Ring of a fragment that a leaf lists and that is not whole, as in tree.h. Exact. O(height). */
void packed_ring(const froe_tree *t, num_context *context, uint32_t leaf, uint32_t object, uint32_t ring[2]);
/** Id of a piece, with flags. */
static inline uint32_t packed_id(const froe_tree *t, uint32_t piece) {
    const tree_node *leaf = t->nodes + packed_leaf(t, piece);
    return packed_ids(packed_block(t, leaf), leaf->u.list.count)[piece - leaf->u.list.first];
}
static inline bool packed_is_whole(uint32_t id) {
    return (id & (PACKED_START | PACKED_END)) == (PACKED_START | PACKED_END);
}

#endif
