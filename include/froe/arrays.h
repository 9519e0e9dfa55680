/* arrays.h: scenes and trees as whole arrays, in one call: for bindings, plots, and formats of other programs.
 *
 *     froe_piece_arrays a;
 *     froe_arrays_of_pieces(tree, NULL, &a, NULL);
 *     ... piece i is a part of object a.objects[i]; its corners are those from a.starts[i] to a.starts[i + 1] - 1,
 *         and corner c lies at a.coords + c * dim ...
 *     froe_piece_arrays_free(&a);
 *
 * All arrays are copies, in memory of the allocator (NULL: malloc), and outlive the scene and the tree. An array
 * without items is not NULL. */
#ifndef FROE_ARRAYS_H
#define FROE_ARRAYS_H
#include <froe/froe.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A scene. Object i has the corners from starts[i] to starts[i + 1] - 1; see froe_object, froe_scene_corner(). */
typedef struct froe_scene_arrays {
    int dim;
    size_t object_count, vertex_count, corner_count;
    double *coords;           /**< of the vertices, dim doubles each */
    uint8_t *kinds, *forms;   /**< froe_kind of each object, as added and as it is */
    size_t *starts;           /**< one more than objects */
    uint32_t *corners;        /**< vertices */
    double *radii;            /**< of each object; 0 but for balls */
    uint64_t *tags;           /**< of each object */
    uint32_t *faces, *groups; /**< of each object; groups: FROE_NONE: none */
    froe_allocator alloc;     /**< that the arrays came from */
} froe_scene_arrays;
/** FROE_E_MEMORY. O(corners). */
FROE_API froe_status froe_arrays_of_scene(const froe_scene *scene, const froe_allocator *alloc, froe_scene_arrays *out,
                                          froe_diagnostic *diag);
FROE_API void froe_scene_arrays_free(froe_scene_arrays *arrays);

/** The pieces of a tree, in the order of their numbers; see froe_piece. */
typedef struct froe_piece_arrays {
    int dim;
    size_t count, corner_count;
    uint32_t *objects;
    froe_node *nodes; /**< in whose list each piece is */
    uint8_t *whole;   /**< 1: nothing of the object was cut off; otherwise 0 */
    size_t *starts;   /**< of its corners; one more than pieces */
    double *coords;   /**< of the corners, dim doubles each, rounded as froe_tree_piece_corners() does */
    froe_node *made;  /**< of the edge that leaves each corner, the node whose cut made it, or none */
    froe_allocator alloc;
} froe_piece_arrays;
/** FROE_E_MEMORY. O(nodes + corners). */
FROE_API froe_status froe_arrays_of_pieces(const froe_tree *tree, const froe_allocator *alloc, froe_piece_arrays *out,
                                           froe_diagnostic *diag);
FROE_API void froe_piece_arrays_free(froe_piece_arrays *arrays);

/** Regions of nodes, as froe_tree_cells() shows them. Cell i has the faces from faces[i] to faces[i + 1] - 1, and face
 * f the corners from starts[f] to starts[f + 1] - 1. In the plane every cell is one face. */
typedef struct froe_cell_arrays {
    int dim;
    size_t count, face_count, corner_count;
    froe_node *nodes;
    uint32_t *depths;
    size_t *faces;  /**< one more than cells */
    size_t *starts; /**< one more than faces */
    double *coords; /**< of the corners, dim doubles each */
    froe_allocator alloc;
} froe_cell_arrays;
/** The regions of all leaves that meet the box, lo and hi being dim doubles each; with `inner` those of all nodes, in
 * the order of froe_tree_cells(), and otherwise as it. FROE_E_MEMORY. */
FROE_API froe_status froe_arrays_of_cells(const froe_tree *tree, const double *lo, const double *hi, bool inner,
                                          const froe_allocator *alloc, froe_cell_arrays *out, froe_diagnostic *diag);
FROE_API void froe_cell_arrays_free(froe_cell_arrays *arrays);

#ifdef __cplusplus
}
#endif
#endif
