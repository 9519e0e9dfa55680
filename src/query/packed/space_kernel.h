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

/** A ray o + u d in the coordinates of a wide tree, in whose box it is for u >= start only. Keys are u - start. Fourth
 * components are 0, since kernels load four. */
typedef struct space_ray {
    const tree_wide *wide;
    double o[4], d[4]; /**< the largest component of d is between 1/2 and 1 */
    double entry[4];   /**< o + start d */
    double inverse[4]; /**< 1 / d, at most 2^60 */
    double slack[4];   /**< what rounding may cost along an axis */
    double start;
    double largest; /**< component of d */
    float step[4];  /**< 1 / d */
    float rest[4];  /**< slack, and what floats may cost */
    float shear[2]; /**< other components / largest */
    int axis[3];    /**< that of the largest component last */
    int up[3];      /**< 1 where it goes up, otherwise 0 */
} space_ray;

/** A point; keys are squared distances in the coordinates of the wide tree. */
typedef struct space_point {
    const tree_wide *wide;
    double x[3]; /**< the caller's */
    double at[3];
} space_point;

/** A window; bounds may be infinite. */
typedef struct space_window {
    const tree_wide *wide;
    double lo[3], hi[3];
    double from[3], to[3]; /**< in the coordinates of the wide tree */
} space_window;

/** What may be met, appended by kernels; the caller has made room for the objects of the block and PACKED_LANES more.
 */
typedef struct space_found {
    uint32_t *objects;
    float *keys;
    float *ends; /**< rays: the object is certainly met, and no later than this; infinite: it may be */
    size_t count;
    float least; /**< near: lowered to what one object's squared distance certainly does not exceed */
} space_found;

/** Objects that meet a window, and those that may. Room as above in both. */
typedef struct space_answers {
    uint32_t *sure, *unsure;
    size_t sure_count, unsure_count;
} space_answers;

typedef struct space_kernels {
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
