/* solid.h: an exploded view while it is made: what is seen, from front to back.
 *
 *     parts       regions of the nodes at explode_depth, each with the vector it moves by
 *     items       dots, lines and areas in the plane of projection, nearest first       */
#ifndef FROE_DRAW_SOLID_H
#define FROE_DRAW_SOLID_H
#include "picture.h"
#include "shape.h"

/** Parallel projection: right and up span the page, eye points at the viewer; unit vectors. */
typedef struct draw_camera {
    double right[3], up[3], eye[3], light[3];
} draw_camera;
/** view: in the scene's axes, towards the eye; zero: from the front right and above. */
draw_camera draw_camera_from(const draw_space *space, const double *view);
draw_point draw_camera_project(const draw_camera *camera, const double *p);
/** How light a face with this normal (any length, either way round) is: 0 .. 1. */
double draw_camera_shade(const draw_camera *camera, const double *normal);

typedef struct draw_part {
    froe_node node;
    size_t first_face, face_count; /**< into `face_ends` */
    size_t first_corner;           /**< into `corners`, three each */
    double middle[3];              /**< a point inside: the part moves by a multiple of it */
    double depth;                  /**< of the leaf; mean depth of the part's leaves */
    bool leaf;
} draw_part;

/** A cut above all parts, within its region. */
typedef struct draw_wall {
    size_t first_corner, count; /**< into `corners`: three each */
} draw_wall;

typedef enum draw_matter { DRAW_PIECE, DRAW_BACK, DRAW_FRONT, DRAW_WALL } draw_matter;

typedef struct draw_item {
    size_t first;   /**< into points */
    uint32_t count; /**< 1: a dot, or a disc; 2: a line; more: an area */
    uint32_t part;  /**< BACK, FRONT */
    float shade;    /**< 0 .. 1 */
    float radius;   /**< of a disc, in drawing coordinates */
    uint8_t matter; /**< draw_matter */
    uint8_t odd;    /**< alternates among the pieces of an object */
    uint16_t depth; /**< WALL: of the cut, at most 65535 */
} draw_item;

typedef struct draw_solid {
    draw_picture *picture;
    draw_camera camera;
    draw_shaper shaper; /**< for corners */
    draw_view view;     /**< of the shaper: its space only */
    ARRAY(draw_part) parts;
    ARRAY(size_t) face_ends; /**< corner counts of faces, summed up within a part */
    ARRAY(draw_wall) walls;
    ARRAY(double) corners;       /**< of the parts' faces, and of walls */
    uint32_t *part_of, *wall_of; /**< by node: part + 1, wall + 1, or 0 */
    size_t node_count, object_count;
    ARRAY(draw_item) items;
    ARRAY(draw_point) points;  /**< in the plane of projection */
    ARRAY(uint8_t) cut;        /**< for each point: was the edge that leaves it made by a cut? */
    draw_point lo, hi;         /**< of all points */
    uint32_t *met;             /**< by object: pieces alternate; boxes: the part that drew it last */
    double lo_depth, hi_depth; /**< of the parts */
    uint64_t leaves;           /**< in all parts */
} draw_solid;

/** Finds the parts. */
froe_status draw_solid_parts(draw_solid *solid);
/** Finds the items, nearest first. */
froe_status draw_solid_items(draw_solid *solid);
#endif
