/* space_kernel.h: sixteen children of a wide node, or objects of a block of space, at a time: beside a ray, a point, a
 * window.
 *
 * A kernel says no only if that is certain for the true coordinates behind the rounded units (space_kernel.inc). What
 * may be met by a ray or near a point comes with a key: no point of it is met earlier, or is nearer. Callers decide
 * the rest exactly. Compiled three times like packed_kernel.h, with the same answers. */
#ifndef FROE_QUERY_PACKED_SPACE_KERNEL_H
#define FROE_QUERY_PACKED_SPACE_KERNEL_H
#include "query/packed/packed_kernel.h"
#include "tree/packed/wide.h"
#include <string.h>

/** A ray o + u d in the coordinates of a wide tree, in whose box it is for u >= start only. Keys are u - start. Fourth
 * components are 0, since kernels load four. */
typedef struct space_ray {
    const tree_wide *wide;
    double o[4], d[4]; /**< the largest component of d is between 1/2 and 1 */
    double entry[4];   /**< o + start d */
    double inverse[4]; /**< 1 / d, at most 2^60 */
    double start;
    double largest;  /**< component of d */
    double size;     /**< the largest component of o */
    double shear[2]; /**< other components of d / largest */
    float step[4];   /**< 1 / d */
    float slope[4];  /**< |step| 2^-13: what floats may cost beside a unit of a node */
    float rest[4];   /**< slack, and what they may cost beside the start */
    int axis[3];     /**< that of the largest component last */
    int up[3];       /**< 1 where it goes up, otherwise 0 */
    float any;       /**< any object that is certainly met by this key will do; -1: no */
} space_ray;

/** A point; keys are squared distances in the coordinates of the wide tree. */
typedef struct space_point {
    const tree_wide *wide;
    bool one;    /**< only the nearest object is wanted */
    double x[3]; /**< the caller's */
    double at[3];
} space_point;

/** A window; bounds may be infinite. Fourth components are 0. */
typedef struct space_window {
    const tree_wide *wide;
    double lo[4], hi[4];
    double from[4], to[4]; /**< in the coordinates of the wide tree */
} space_window;

/** What may be met, appended by kernels; the caller has made room for the objects of the block and PACKED_LANES more.
 */
typedef struct space_found {
    uint32_t *objects;
    float *keys;
    float *ends; /**< the object is certainly met, and no later than this, or no further away; infinite: it may be */
    size_t count;
} space_found;

/** Objects that meet a window, and those that may. Room as above in both. */
typedef struct space_answers {
    uint32_t *sure, *unsure;
    size_t sure_count, unsure_count;
} space_answers;

/** An entry of a stack: what waits, below the key from which it may be met, so that entries are in the order of keys. A
 * wide node; a leaf, WIDE_LEAF; or an object, SPACE_ITEM_OBJECT. */
#define SPACE_ITEM_OBJECT 0x40000000u
/** Entries that a ray's walk may add for each level of wide nodes (space_ray.inc). */
enum { SPACE_ROOM = 2 * WIDE_CHILDREN };
static inline uint64_t space_entry(float key, uint32_t what) {
    uint32_t bits;
    memcpy(&bits, &key, sizeof bits); /* of numbers that are not negative: in their order */
    return (uint64_t)bits << 32 | what;
}
static inline float space_key(uint64_t entry) {
    const uint32_t bits = (uint32_t)(entry >> 32);
    float key;
    memcpy(&key, &bits, sizeof key);
    return key;
}
/** Prefetches all of a node, or as much of a leaf as one of 24 triangles has; not an object. It is inlined, since gcc
 * drops calls of functions that only prefetch. */
__attribute__((always_inline)) static inline void space_prefetch(const froe_tree *t, uint32_t what) {
    const bool leaf = what & WIDE_LEAF;
    const uint8_t *at = leaf ? t->packed.blocks + (size_t)(what & WIDE_INDEX) * PACKED_BLOCK
                             : (const uint8_t *)(t->packed.wide->nodes + what);
    if (!leaf && what & SPACE_ITEM_OBJECT) return;
    for (int i = 0; i < (leaf ? 640 : 192); i += 64) __builtin_prefetch(at + i);
}

typedef struct space_kernels {
    /** Prepares a ray for ray->wide, but for shear, axis and largest; `per` is a power of 2 that brings the largest
     * component of the direction near 1. *meets false: it misses the scene. False: it comes from too far away. */
    bool (*aim)(space_ray *ray, const double *from, const double *way, double per, bool *meets);
    /** Replaces nodes on top of the stack by their children that may be met with a key up to the limit, until something
     * else is on top, or, with `once`, one node; drops what is beyond the limit. What is left of the stack, which has
     * room for SPACE_ROOM more a level. Children are prefetched unless it is once. */
    size_t (*ray_nodes)(const froe_tree *tree, const space_ray *ray, float limit, bool once, uint64_t *stack,
                        size_t count, uint64_t *nodes);
    /** Children that may be met with a key up to the limit, as bits; their keys. */
    uint32_t (*ray_node)(const wide_node *node, const space_ray *ray, float limit, float keys[PACKED_LANES]);
    uint32_t (*near_node)(const wide_node *node, const space_point *point, float limit, float keys[PACKED_LANES]);
    /** Children that the window may meet. */
    uint32_t (*window_node)(const wide_node *node, const space_window *window);
    /** Objects of a block that the ray comes to with `key`. */
    void (*ray)(const space_header *block, const space_ray *ray, float key, float limit, space_found *out);
    void (*near)(const space_header *block, const space_point *point, float key, float limit, space_found *out);
    void (*window)(const space_header *block, const space_window *window, space_answers *out);
} space_kernels;

extern const space_kernels space_kernels_plain;
#ifdef PACKED_X86
extern const space_kernels space_kernels_avx2, space_kernels_avx512;
#endif

/** As packed_kernels_at(). */
const space_kernels *space_kernels_at(size_t i);
#endif
