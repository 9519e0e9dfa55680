/* hits.h: the oracle for pictures: what the rays through sample points of a page meet, in doubles, by looking at every
 * polygon.
 *
 *      page               A ray is r = (u, v, 1) in the camera's coordinates, a triangle three vectors a, b, c. The
 *      .  .  .  .         signs of r . (b x c), r . (c x a) and r . (a x b) tell whether it is met; as b x c = -(c x b)
 *      . /\ .  .          to the last bit, a ray between two triangles with a common edge meets one of them.
 *      ./  \.  .          The weights that they make tell at which depth.
 *      .----.  .
 *
 * Exact answers are not its business: where two polygons are met at nearly the same depth (|dz| < 1e-7 z) a sample says
 * so and is not held against anyone. It shares nothing with the code under test but the camera's numbers. */
#ifndef FROE_TESTS_ORACLE_HITS_H
#define FROE_TESTS_ORACLE_HITS_H
#include <froe/view.h>

#define ORACLE_TIE 1e-7 /**< of the depth: nearer neighbours are in a tie */

/** Samples at the centres of a grid of wide x high cells, moved by `shift` of a cell (-0.5 .. 0.5), so that lattices do
 * not fall on them. */
typedef struct oracle_grid {
    uint32_t wide, high;
    double shift[2];
} oracle_grid;

/** A triangle before a camera. */
typedef struct oracle_triangle {
    double normal[3][3]; /**< b x c, c x a, a x b */
    double depth[3];     /**< of the corners, from where `back` begins: parallel eyes only */
    double volume;       /**< a . (b x c): eyes at a point only */
    double lo[2], hi[2]; /**< on the page */
    uint32_t object, patch;
    bool edge_on; /**< the eye lies in its plane but for rounding: it has no area on the page; eyes at a point only */
} oracle_triangle;

typedef struct oracle_triangles {
    const froe_projection *view;
    oracle_triangle *at;
    size_t count;
    double
        back; /**< parallel eyes: depths count from a plane so far before the camera's origin that all are positive */
} oracle_triangles;

typedef struct oracle_hit {
    double depth;
    uint32_t sample, patch;
} oracle_hit;

/** Hits of all samples: those of sample y * wide + x are hits[starts[i]] .. hits[starts[i+1] - 1], nearest first; of
 * those in a tie the higher patch first, as froe ranks faces in one plane. */
typedef struct oracle_hits {
    oracle_grid grid;
    oracle_hit *hits;
    size_t *starts;
} oracle_hits;

/** All polygons of the scene that belong to patches; with cull_back only those whose corners turn left. */
oracle_triangles oracle_triangles_new(const froe_scene *scene, const froe_surface *surface, const froe_projection *view,
                                      bool cull_back);
void oracle_triangles_free(oracle_triangles *triangles);
/** The depth at which the ray through a place of the page meets a triangle; not positive: nowhere. *doubt: the ray
 * passes so near to its border that rounding decides. */
double oracle_depth(const oracle_triangles *triangles, size_t i, const double page[2], bool *doubt);
/** The place of a sample on the page. */
void oracle_place(const oracle_grid *grid, const froe_projection *view, size_t sample, double page[2]);

/** Only the nearest hit of every sample, for grids of millions. */
typedef struct oracle_nearest {
    oracle_grid grid;
    double *depth;   /**< INFINITY: nothing is met */
    uint32_t *patch; /**< FROE_NONE */
    uint8_t *tie;    /**< another patch is as near */
} oracle_nearest;

oracle_nearest oracle_nearest_new(const oracle_triangles *triangles, oracle_grid grid);
void oracle_nearest_free(oracle_nearest *nearest);

oracle_hits oracle_hits_new(const oracle_triangles *triangles, oracle_grid grid);
void oracle_hits_free(oracle_hits *hits);
/** How many hits of a sample are seen: down to the first patch that is not clear (clear NULL: none is). *tie: another
 * order of two of them would be as good. */
size_t oracle_stack(const oracle_hits *hits, size_t sample, const uint8_t *clear, bool *tie);
#endif
