/* measure.h: measures of a scene: fatness, density, clutter, directional density and near misses.
 *
 * The sizes that methods promise depend on such properties (de Berg 2000; de Berg and Streppel; Tobola and Nechvile),
 * so these tell which promises are strong on a given scene.
 *
 *     froe_measure_options o = froe_measure_defaults();
 *     froe_density density;
 *     froe_measure_density(scene, FROE_SIZE_RADIUS, &o, &density, NULL);   // density.lower <= lambda <= density.upper
 *
 * Bounds that are called certified hold exactly for the doubles of the scene; distributions are computed in
 * doubles. Where a scene has more objects than `samples`, a random sample of so many is used, the same for the
 * same seed: lower bounds stay certified, upper bounds and distributions are then those of the sample. All functions
 * leave the scene as it is. */
#ifndef FROE_MEASURE_H
#define FROE_MEASURE_H
#include <froe/froe.h>

#ifdef __cplusplus
extern "C" {
#endif

/** How boxes are counted for directional density; the numbers are the same. */
typedef enum froe_counting {
    FROE_COUNT_SEARCH, /**< a packed hierarchy: fast where few are found */
    FROE_COUNT_TREES   /**< range trees: O(log^(d - 1) n) a count however large, in as many times the space */
} froe_counting;

typedef struct froe_measure_options {
    size_t size;      /**< set by froe_measure_defaults() */
    uint32_t samples; /**< objects, or for clutter cubes, that are used, at most; 0: all objects */
    uint64_t seed;
    froe_counting counting;
    froe_progress_fn *progress; /**< may be NULL */
    void *user;
} froe_measure_options;
FROE_DEFAULTS(froe_measure_options, froe_measure_defaults); /**< 20,000 samples, seed 1, search */

/** How values are distributed. All 0 without any. */
typedef struct froe_spread {
    uint64_t count;
    double least, q05, q25, median, q75, q95, most, mean;
} froe_spread;

/* ----------------------------------------------------------------- fatness -- */

/** Fatness of convex objects: volume over that of the smallest enclosing ball (de Berg and Streppel; at most 1). */
typedef struct froe_fatness {
    froe_spread full;   /**< of boxes, balls and hulls */
    froe_spread flat;   /**< of polygons in space: area over that of the smallest enclosing disc */
    froe_spread sliver; /**< of polygons in space: width across their longest edge, over its length */
    uint64_t thin;      /**< objects without volume: fatness 0 (points, segments; in space polygons, flat solids) */
    uint64_t reserved[4];
} froe_fatness;
/** FROE_E_MEMORY, FROE_E_CANCELLED. FROE_E_UNSUPPORTED: above dimension 3 a hull is no simplex. O(n), but O(corners^2)
 * for polygons and hulls of many corners. */
FROE_API froe_status froe_measure_fatness(const froe_scene *scene, const froe_measure_options *options,
                                          froe_fatness *out, froe_diagnostic *diag);

/* ----------------------------------------------------------------- density -- */

typedef enum froe_size {
    FROE_SIZE_RADIUS,  /**< of the smallest enclosing ball, against that of a ball (de Berg) */
    FROE_SIZE_DIAMETER /**< against that of a ball (de Berg and Streppel; Sacks) */
} froe_size;

/** The density lambda of a scene: the most objects, of at least the size of a ball, that meet a ball. */
typedef struct froe_density {
    uint32_t lower, upper;               /**< certified; upper: of the objects in the sample (count) */
    uint64_t count;                      /**< objects in the sample */
    double centre[FROE_MAX_DIM], radius; /**< a ball that meets `lower` objects of at least its size */
    froe_spread load; /**< per object: objects of at least its size within three radii of its centre */
    uint64_t reserved[4];
} froe_density;
/** Only balls of the size of an object matter. FROE_E_ARG: there is no such size. FROE_E_MEMORY, FROE_E_CANCELLED.
 * O(n log n + sum of loads). */
FROE_API froe_status froe_measure_density(const froe_scene *scene, froe_size size, const froe_measure_options *options,
                                          froe_density *out, froe_diagnostic *diag);

/* ----------------------------------------------------------------- clutter -- */

/** The clutter factor kappa (de Berg): the most objects that meet an open cube without a guard, a corner of the
 * bounding box of an object, inside. */
typedef struct froe_clutter {
    uint32_t lower; /**< certified: that cube shows it */
    double lo[FROE_MAX_DIM],
        hi[FROE_MAX_DIM]; /**< the cube (sides equal up to rounding, and never longer than the first) */
    uint64_t count;       /**< cubes grown */
    froe_spread load;     /**< of the cubes that cannot grow any more */
    uint64_t reserved[4];
} froe_clutter;
/** Grows empty cubes at random places until opposite sides are blocked, and moves the best ones sideways.
 * FROE_E_MEMORY, FROE_E_CANCELLED. O(n log n + samples (log n + loads)). */
FROE_API froe_status froe_measure_clutter(const froe_scene *scene, const froe_measure_options *options,
                                          froe_clutter *out, froe_diagnostic *diag);

/* ------------------------------------------------------- directional density -- */

/** Directional density of the bounding boxes of objects (Tobola and Nechvile, definitions 2.4, 3.2 and 4.1): how many
 * other boxes cross the plane of a face within its neighbourhood. Boxes that meet the inside of the box itself do not
 * count. Much: (1 + 2 delta) times the longest side, of the face (extended) or of the box. */
typedef struct froe_directional {
    double delta;
    uint64_t count;              /**< boxes in the sample */
    froe_spread simple;          /**< most of all faces, each widened by delta times its own sides */
    froe_spread extended;        /**< most of all faces, each widened by much */
    froe_spread two_directional; /**< most of all faces, widened by much, but on one axis by delta times the side:
                                      least over the choices of that axis, all but the longest */
    froe_spread paired; /**< the same for the two faces across that axis alone: what a tree of linear size needs */
    uint64_t reserved[4];
} froe_directional;
/** Exact counts, up to the rounding of the widened sides. FROE_E_ARG: delta < 0 or not finite. FROE_E_MEMORY,
 * FROE_E_CANCELLED. O(n log n + d^2 samples (log n + counts)); by range trees O((n + d^2 samples) 2^d log^(d - 1) n).
 */
FROE_API froe_status froe_measure_directional(const froe_scene *scene, double delta,
                                              const froe_measure_options *options, froe_directional *out,
                                              froe_diagnostic *diag);

/* ------------------------------------------------------------- near misses -- */

/** What was rounded before it was given to froe: walls that are flat, and ends that stop at a wall, up to a few last
 * places. No tree is as small there as where they truly are, and do. Near means within a distance from a plane, in the
 * plane from a line; distances are computed in doubles, sides exactly. Pairs are counted once; `first` is one example
 * pair of each sort, FROE_NONE if there is none. */
typedef struct froe_near {
    uint64_t coplanar; /**< pairs of polygons with a common edge and no other common vertex, all corners of each near
                            the plane of the other, and not all in it */
    uint64_t poking;   /**< pairs of segments of the plane, or polygons of space, that cross (as in froe_defects), one
                            of which is on some side of the other nowhere but near it */
    uint32_t first_coplanar[2], first_poking[2];
    double within; /**< the distance */
    uint64_t reserved[4];
} froe_near;
/** The distance is `share` times the largest absolute value of a coordinate. Objects without length or area and
 * duplicates do not count; nor do other kinds, and nothing above dimension 3. threads, progress and user are as of
 * froe_scene_defects(). FROE_E_ARG: share is not from 0 to 1. FROE_E_MEMORY, FROE_E_CANCELLED.
 * O(n log^(dim-1) n + pairs with a common edge + pairs of touching bounding boxes), long thin objects side by side
 * left out as by froe_scene_defects(). */
FROE_API froe_status froe_measure_near(const froe_scene *scene, double share, unsigned threads,
                                       froe_progress_fn *progress, void *user, froe_near *out, froe_diagnostic *diag);

#ifdef __cplusplus
}
#endif
#endif
