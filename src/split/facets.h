/* facets.h: a cell of polygons laid out for scoring: every corner once, and the fragments that have it.
 *
 *        1-------2          corners    x[], y[], z[]; the input vertex each is, if it is one
 *       / \  b  /           fragments  a: 0 3 1   b: 1 3 2
 *      / a \   /
 *     0-----\-3             a plane is compared with 4 corners, not 6; in a mesh with a sixth of them
 *
 * Coordinates are relative to the middle of the cell and of size at most 1/2, so a score does not depend on
 * where the scene lies, nor, for powers of two, on its scale. Counting is in plain doubles and
 * nearly right: a wrong count costs a worse cut, never a wrong tree.
 *
 * Behind the corners come vertices of the same objects that lie outside the cell: where large polygons cross a small
 * cell there may be no others to lay planes through. */
#ifndef FROE_SPLIT_FACETS_H
#define FROE_SPLIT_FACETS_H
#include "split/view.h"

typedef struct split_facets {
    int dim;
    ARRAY(double) x, y, z;    /**< corners, then vertices outside; z = 0 in the plane */
    ARRAY(uint32_t) vertex;   /**< the input vertex each is, or FROE_NONE */
    ARRAY(uint32_t) vertices; /**< those that are one, the corners first */
    uint32_t corners, inside; /**< how many of the former are corners; of the latter */
    ARRAY(uint8_t) side;      /**< per corner, of the last count: bit 0 negative, bit 1 positive */
    ARRAY(uint32_t) start;    /**< count + 1 offsets into corner */
    ARRAY(uint32_t) corner;   /**< corners of the fragments, one after the other */
    uint32_t *place;          /**< per vertex of the scene: where it is here, or FROE_NONE */
    uint32_t place_count;
    uint32_t count;   /**< fragments shown */
    double weight;    /**< fragments of the cell per fragment shown, >= 1 */
    double middle[3]; /**< half the coordinates of the cell's middle */
    double scale;     /**< local = (x / 2 - middle) * scale */
} split_facets;

/** A plane in local coordinates: n . x = d, |n| = 1; what lies within `slack` of it counts as in it. */
typedef struct split_facet_plane {
    double n[3], d, slack;
    uint32_t known[3]; /**< corners that lie in it by their ids, or FROE_NONE */
} split_facet_plane;

froe_status split_facets_new(const froe_allocator *alloc, const froe_scene *scene, split_facets *out);
void split_facets_free(const froe_allocator *alloc, split_facets *facets);

/** Shows the cell, or `sample` fragments drawn with replacement by `seed` when it has more. False: no memory. */
bool split_facets_fill(split_facets *facets, const split_set *set, const split_cell *cell, uint32_t sample,
                       uint64_t seed);
/** Local coordinates of any point. */
void split_facets_local(const split_facets *facets, const double *x, double out[3]);
/** The plane through three vertices of the scene. False when their triangle is too thin: its area is at most `thin`
 * times the square of its longest edge, or not a normal number. */
bool split_facets_plane(const split_facets *facets, const froe_scene *scene, const uint32_t id[3], double thin,
                        split_facet_plane *out);
/** The plane x[axis] = value. */
split_facet_plane split_facets_axis(const split_facets *facets, int axis, double value);
/** A coordinate of a corner, in the scene; rounded once more where the corner is no vertex. */
double split_facets_coordinate(const split_facets *facets, const froe_scene *scene, uint32_t corner, int axis);
/** Deals the fragments shown to sides; those of their corners stay in `side`. */
split_tally split_facets_count(split_facets *facets, const split_facet_plane *plane);
#endif
