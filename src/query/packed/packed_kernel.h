/* packed_kernel.h: sixteen fragments of a block at a time, beside a window, a vertical ray, a point, or another
 * fragment.
 *
 *      sure no  <------- unsure ------->  sure yes
 *     ----------|-----------------------|----------->
 *            -bound         0        +bound
 *
 * Units are within the error E of the block from the truth, so each answer has three values. What is unsure is
 * decided by the caller, exactly, on the objects: with 16 bits a cell, about one fragment in twenty thousand.
 *
 * The same source (packed_kernel.inc) is compiled three times, over lanes of AVX-512, of AVX2 and of what any compiler
 * has. Its floating-point operations are the same, one by one, and none is fused, so all three give the same answers in
 * the same order and leave the same ones unsure. The header speaks for packed_avx512.c, packed_avx2.c and
 * packed_plain.c. */
#ifndef FROE_QUERY_PACKED_PACKED_KERNEL_H
#define FROE_QUERY_PACKED_PACKED_KERNEL_H
#include "tree/packed/packed.h"

enum { PACKED_LANES = 16 };

/** Short vectors in the notation that gcc and clang have for any machine: of the axes, the rest unused. */
typedef double four_doubles __attribute__((vector_size(32)));
typedef int64_t four_longs __attribute__((vector_size(32)));
typedef float four_floats __attribute__((vector_size(16)));
typedef int32_t four_ints __attribute__((vector_size(16)));

/** A closed axis-parallel window; bounds may be infinite. */
typedef packed_box packed_window;

/** A fragment that a kernel could not decide. */
typedef struct packed_unsure {
    const packed_header *block;
    uint32_t id; /**< with flags */
} packed_unsure;

/** What a kernel appends to. The caller has made room: `count` + PACKED_LANES ids, `count` unsure ones. */
typedef struct packed_answers {
    uint32_t *ids; /**< objects */
    size_t count;
    packed_unsure *unsure;
    size_t unsure_count;
} packed_answers;

/** What a vertical ray meets first in a block. */
typedef struct packed_heights {
    bool sure;            /**< then there is one candidate, and it is the answer */
    uint32_t count;       /**< of candidates; 0: nothing is met */
    uint32_t *candidates; /**< objects; room for those of the block and PACKED_LANES more */
} packed_heights;

/** Fragments j > i of a block that meet fragment i, as bits: bit j % 16 of word j / 16. */
typedef struct packed_row {
    uint16_t *crossing; /**< surely cross, inside of the cell and of both fragments */
    uint16_t *unsure;
    uint16_t *bent; /**< of unsure ones: surely not on one line */
} packed_row;

/** Whole words. */
static inline size_t packed_boxes_room(uint32_t count) {
    return ((size_t)count + PACKED_LANES - 1) / PACKED_LANES * PACKED_LANES;
}

/** How near the fragments of a block are to a point. */
typedef struct packed_near {
    float *squares;   /**< of distances in units; room for those of the block and PACKED_LANES more */
    uint32_t *places; /**< ascending; room for those of the block */
    uint32_t count;   /**< of places */
    float least;      /**< of all squares */
} packed_near;

typedef struct packed_kernels {
    const char *name;
    /** Fragments that report for a window: they meet it, and the segment enters it with them, for p is outside or its
     * own first end. Exactly one fragment of each segment that meets a convex window does. With `whole`, whole units
     * come first: sooner, unless a fragment is near the window and has no end in it. */
    void (*window)(const packed_header *block, uint32_t count, const packed_window *window, bool whole,
                   packed_answers *out);
    /** The segments met first by the ray from (x, y), upwards (1) or downwards (-1), that starts in the closed cell or
     * enters it. */
    void (*vertical)(const packed_header *block, uint32_t count, const double *point, int direction,
                     packed_heights *out);
    /** The boxes of all fragments in whole units, widened by what two of them may err together: four arrays of
     * packed_boxes_room() numbers, x lo, y lo, x hi, y hi. */
    void (*boxes)(const packed_header *block, uint32_t count, uint16_t *boxes);
    /** Words i / 16 .. (count - 1) / 16 of the row are written, those of `bent` where others are not 0. False: all are
     * 0. */
    bool (*pairs)(const packed_header *block, uint32_t count, const uint16_t *boxes, uint32_t i, packed_row *out);
    /** Squared distances of all fragments from a point, all in units: near the truth as near_packed.c has it, for a
     * point with coordinates up to 2^60; and the places of those up to `most`. */
    void (*nearest)(const packed_header *block, uint32_t count, const float *point, float most, packed_near *out);
} packed_kernels;

extern const packed_kernels packed_kernels_plain;
#if defined(__x86_64__) && defined(__GNUC__)
#define PACKED_X86 1
extern const packed_kernels packed_kernels_avx2, packed_kernels_avx512;
#endif

/** The i-th set of kernels that this machine can run, the fastest first; NULL past the last. */
const packed_kernels *packed_kernels_at(size_t i);
#endif
