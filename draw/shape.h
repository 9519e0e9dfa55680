/* shape.h: what an object or a piece looks like in a view: a dot, a line, a ring or a disc. */
#ifndef FROE_DRAW_SHAPE_H
#define FROE_DRAW_SHAPE_H
#include "view.h"

typedef enum draw_sort { DRAW_NOTHING, DRAW_DOT, DRAW_STROKE, DRAW_RING, DRAW_DISC } draw_sort;

typedef struct draw_shape {
    draw_sort sort;
    const draw_point *points; /**< on the page, inside the window; until the next shape */
    size_t count;             /**< DOT 1, STROKE 2, RING >= 3, DISC 1: its centre */
    draw_point half;          /**< DISC: its half axes on the page; they differ on maps in degrees */
    bool cut[2];              /**< STROKE: is this end (which is not the object's own) in the window? */
} draw_shape;

/** Makes shapes in a view, with buffers of its own. */
typedef struct draw_shaper {
    froe_allocator alloc;
    const froe_tree *tree;
    const froe_scene *scene;
    const draw_view *view;
    ARRAY(double) raw;        /**< corners of a piece as the tree gives them */
    ARRAY(froe_node) made;    /**< what made its edges */
    ARRAY(double) solid;      /**< corners in drawing coordinates, three each */
    ARRAY(draw_point) points; /**< in the view */
    ARRAY(draw_point) spare;
} draw_shaper;

/** False without memory. */
bool draw_shape_of_object(draw_shaper *shaper, uint32_t object, draw_shape *out);
bool draw_shape_of_piece(draw_shaper *shaper, size_t piece, draw_shape *out);
void draw_shaper_free(draw_shaper *shaper);

/** Corners of an object (piece FROE_NONE) or piece as drawing coordinates in
 * shaper->solid, of a piece also shaper->made. Boxes give lo and hi, balls the centre. */
bool draw_corners_of_object(draw_shaper *shaper, uint32_t object);
bool draw_corners_of_piece(draw_shaper *shaper, size_t piece);
/** Convex hull of points, counterclockwise, in place. Returns its number of corners. `spare` has
 * room for count + 1. */
size_t draw_hull(draw_point *points, draw_point *spare, size_t count);
#endif
