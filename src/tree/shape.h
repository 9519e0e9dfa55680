/* shape.h: convex polygons and polyhedra in doubles, for pictures: clipping by a plane.
 *
 * A shape is points and faces, loops of point numbers that turn left seen from outside; a
 * polygon of the plane is one face. Doubles may put a point on the wrong side of a plane, but
 * every point is put on ONE side, once, and the rest is combinatorics: each crossed edge gets
 * one new point, shared by the two faces of the edge, so the face that closes the cut always
 * consists of closed loops. Points within the rounding error of the plane count as on it,
 * which keeps slivers out of pictures; nothing else depends on it.
 *
 * It speaks for shape.c and cells.c (the cells of a tree as such shapes). */
#ifndef FROE_TREE_SHAPE_H
#define FROE_TREE_SHAPE_H
#include "geom/plane.h"
#include "support/array.h"

/** What coordinates are measured from, and in. */
typedef struct shape_frame {
    double origin[3];
    int exponent; /**< the unit is 2^exponent */
} shape_frame;

typedef struct shape {
    ARRAY(double) points;   /* dim a point, in a frame */
    ARRAY(uint32_t) loops;  /* point numbers, face after face */
    ARRAY(uint32_t) starts; /* face f: loops[starts[f] .. starts[f+1]) */
} shape;

/** n . x = c with max |n| about 1; where |n . x - c| <= slack x counts as on the plane. */
typedef struct shape_plane {
    double n[3], c, slack;
    int axis; /**< n is this unit vector; -1: oblique */
} shape_plane;

/** Memory of a clip, to be kept and freed by the caller (all zero at first). */
typedef struct shape_edge {
    uint32_t kept, dropped; /**< points of a crossed edge */
    uint32_t point;         /**< new point on it, or `kept` itself when that is on the plane */
    uint32_t next;          /**< slot of the edge by which the loop around the cut goes on */
} shape_edge;
typedef struct shape_scratch {
    ARRAY(int8_t) sides;      /* per point: -1, 0, 1 */
    ARRAY(double) values;     /* per point */
    ARRAY(shape_edge) edges;  /* hash table, by the points of the edge */
    ARRAY(uint32_t) renumber; /* per point */
} shape_scratch;

/** A frame in which the box has size 1, and differences of its coordinates from the origin are doubles. A box that is
 * small beside its distance from 0 has an origin of its own: doubles tell nothing apart in it otherwise. */
shape_frame shape_frame_of(int dim, const double *lo, const double *hi);
/** A coordinate of the frame in units of the scene. */
double shape_coordinate(const shape_frame *frame, int axis, double x);
/** The box in the frame. dim 2 or 3. */
bool shape_box(const froe_allocator *alloc, int dim, const double *lo, const double *hi, const shape_frame *frame,
               shape *out);
bool shape_copy(const froe_allocator *alloc, const shape *from, shape *out);
void shape_free(const froe_allocator *alloc, shape *s);
void shape_scratch_free(const froe_allocator *alloc, shape_scratch *scratch);

shape_plane shape_plane_from(const geom_plane *plane, const shape_frame *frame);
/** Which sides of the plane the shape reaches (bit 0: negative, bit 1: positive; 0: it lies in the
 * plane); fills scratch for shape_clip. False without memory. */
bool shape_sides(const froe_allocator *alloc, int dim, const shape *s, const shape_plane *plane, shape_scratch *scratch,
                 unsigned *reached);
/** The part on side -1 or 1 of a plane that has points of `s` on both. `cut`, unless NULL, becomes
 * the section: 2D two points and one loop, 3D one face. False without memory. */
bool shape_clip(const froe_allocator *alloc, int dim, const shape *s, const shape_plane *plane, int side,
                shape_scratch *scratch, shape *out, shape *cut);
#endif
