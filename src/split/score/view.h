/* view.h: a cell laid out for scoring: every corner once, and the fragments that have it.
 *
 *        1-------2          corners    x[], y[], z[]; the input vertex each is, if it is one
 *       / \  b  /           fragments  a: 0 3 1   b: 1 3 2
 *      / a \   /
 *     0-----\-3             a plane is compared with 4 corners, not 6; in a mesh with a sixth of them
 *
 * Candidates are many and only one becomes the cut, so they are counted in plain doubles, and nearly right; the chosen
 * one is then classified exactly (cell.c). A wrong count costs a worse cut, never a wrong tree. Large cells are
 * represented by a sample. Coordinates are relative to the middle of the cell and of size at most 1/2, so a score does
 * not depend on the scale of the scene, for powers of two. Nor, in views for sweeps, on where it lies, as long as no
 * coordinate is rounded: there they come from differences of input coordinates alone (split_corner.apart). Others take
 * images as they are.
 *
 * For sweeps (build/grain/sweep.h) vertices of the same objects that lie outside the cell come behind the corners:
 * where large polygons cross a small cell there may be no others to lay planes through. */
#ifndef FROE_SPLIT_SCORE_VIEW_H
#define FROE_SPLIT_SCORE_VIEW_H
#include "split/grow.h"
#include "split/score/price.h"

/** Vertices whose triangle is thinner than this give no plane worth trying. */
#define SPLIT_THIN 1e-5
enum { SPLIT_VIEW_FEW = 256, SPLIT_VIEW_ENDS = 32, SPLIT_CHECKS = 64, SPLIT_CHECKED = 256 };

/** A plane, by its vertices in ascending order, or its object. */
typedef struct split_checked {
    froe_cut_kind kind;
    uint32_t id[3];
    bool refuted; /**< its exact price was higher than it had seemed */
} split_checked;

typedef struct split_view {
    int dim;
    ARRAY(double) x, y, z;    /**< corners, then vertices outside; z = 0 in the plane */
    ARRAY(double) radius;     /**< per corner: balls are shown by their centres */
    ARRAY(uint32_t) vertex;   /**< the input vertex each is, or FROE_NONE */
    ARRAY(uint32_t) vertices; /**< those that are one, the corners first */
    uint32_t corners, inside; /**< how many of the former are corners; of the latter */
    ARRAY(uint8_t) side;      /**< 1 + corner, of the last count: bit 0 negative, bit 1 positive; at 0: neither */
    ARRAY(uint8_t) sides;     /**< per fragment, of the last count: those of its corners together */
    ARRAY(uint32_t) start;    /**< count + 1 offsets into corner */
    ARRAY(uint32_t) corner;   /**< corners of the fragments, one after the other */
    ARRAY(uint32_t)
    fours;                  /**< the same for loops without branches: per fragment four, 1 + corner, the last
                                         repeated; 0 of those that have more */
    ARRAY(uint32_t) many;   /**< fragments that have more than four corners */
    ARRAY(uint32_t) item;   /**< per fragment: its place in the cell; of pairs that is their own number */
    ARRAY(uint8_t) marked;  /**< per fragment: 3, if it only seems to lie in planes (mark.h), or 0 */
    uint32_t marks;         /**< how many are marked */
    uint32_t checked_count; /**< of the following */
    split_checked checked[SPLIT_CHECKED]; /**< planes that exact numbers have been asked about */
    ARRAY(double) values;                 /**< ends of extents, for axis candidates */
    ARRAY(double) low, high;              /**< extents of the fragments on the current axis */
    uint32_t *place;                      /**< per vertex of the scene: where it is here, or FROE_NONE */
    uint32_t place_count;
    bool pairs;           /**< segments of the plane, two corners each, none shared: no vertex, start, corner, side */
    bool swept;           /**< for sweeps */
    bool round;           /**< there are balls */
    uint32_t count;       /**< fragments shown */
    uint32_t few_corners; /**< of the first SPLIT_VIEW_FEW of them, which come from all over the cell */
    double weight;        /**< fragments of the cell per fragment shown, >= 1 */
    double origin[3];     /**< half the coordinates of an input vertex of the cell; 0 but for sweeps */
    double middle[3];     /**< half the way from there to the cell's middle */
    double scale;         /**< local = (x / 2 - origin - middle) * scale */
    double reach[3];      /**< about the largest coordinates of the scene here, in local units */
    uint32_t outermost[6], outermost_count; /**< least and greatest vertices of the scene by axis; 0: not sought yet */
} split_view;

/** A part of what is shown: fragments 0 .. count - 1, with their corners, and some of the vertices outside. */
typedef struct split_view_part {
    uint32_t count, corners, outside;
    double weight; /**< fragments of the cell per fragment of the part */
} split_view_part;

/** A plane in local coordinates: n . x = d, |n| = 1; what lies within `slack` of it counts as in it. */
typedef struct split_view_plane {
    double n[3], d, slack;
    uint32_t known[3]; /**< corners that lie in it by their ids, or FROE_NONE */
} split_view_plane;

void split_view_free(const froe_allocator *alloc, split_view *view);
/** Shows the cell, or `sample` fragments drawn with replacement by `seed` when it has more. `swept`: for sweeps, with
 * vertices outside. In more than three dimensions only extents are shown. False: no memory. */
bool split_view_fill(split_view *view, const split_set *set, const split_cell *cell, uint32_t sample, uint64_t seed,
                     bool swept);
/** All of it, or the first few fragments. */
split_view_part split_view_part_of(const split_view *view, bool few);
/** Shows vertices of the scene, behind all others. False: no memory. */
bool split_view_add(split_view *view, const split_set *set, const uint32_t *vertices, uint32_t count);
/** Finds the outermost vertices of the scene. O(vertices), the first time. */
void split_view_find_outermost(split_view *view, const froe_scene *scene);
/** The i-th fragment shown lies in the plane, as far as doubles tell. */
bool split_view_flat(const split_view *view, const split_view_plane *plane, uint32_t i);
/** Local coordinates of any point. */
void split_view_local(const split_view *view, const double *x, double out[3]);
/** The plane through as many vertices of the scene as it has dimensions. False when their triangle is too thin: its
 * area is at most `thin` times the square of its longest edge, or not a normal number. */
bool split_view_span(const split_view *view, const froe_scene *scene, const uint32_t *id, double thin,
                     split_view_plane *out);
/** The plane x[axis] = value. */
split_view_plane split_view_axis(const split_view *view, int axis, double value);
/** The plane of a cut; through vertices only if it is certainly one. Dimensions 2 and 3. */
bool split_view_cut(const split_view *view, const froe_scene *scene, const froe_cut *cut, split_view_plane *out);
/** Deals the fragments shown to sides; those of their corners stay in `side`. */
split_tally split_view_count(split_view *view, const split_view_plane *plane);
/** Computes the extents on an axis, and the ends of a few of them, sorted, as `values`. Any dimension. */
bool split_view_extents(split_view *view, const split_set *set, const split_cell *cell, int axis);
/** Counts for the plane x[axis] = value from the extents on that axis. */
split_tally split_view_count_axis(const split_view *view, double value);
#endif
