/* cylinder.h: the next cut in a cell of a cylindrical partition of space. */
#ifndef FROE_BUILD_CYLINDRICAL_CYLINDER_H
#define FROE_BUILD_CYLINDRICAL_CYLINDER_H
#include "split/grow.h"

/** Settings, and what all threads note. */
typedef struct split_cylinder {
    uint32_t leaf;         /**< cells with so many fragments are done */
    uint32_t deepest;      /**< give up at this depth; 0: never */
    bool refuse;           /**< polygons that cross; otherwise they are cut */
    bool given;            /**< edges of a polygon cut in the order of its corners; otherwise the longest first */
    atomic_bool *too_deep; /**< set when `deepest` was why */
} split_cylinder;

/** What a cell keeps in its room: the walls left and right of it, and the edges below and above. */
typedef struct split_cylinder_frame {
    uint32_t wall[2], edge[2]; /**< nodes (ring numbering) and edges; FROE_NONE: none */
} split_cylinder_frame;

/** split_method.choose for a split_cylinder: names the next cut for the first fragment of the cell. */
split_verdict split_cylinder_choose(const void *config, split_work *work, const split_cell *cell, froe_cut *cut);
/** split_method.divided: which walls and edges bound the children. */
void split_cylinder_divided(const void *config, const split_work *work, const split_cell *cell, const froe_cut *cut,
                            bool guard, void *positive, void *negative);
/** The wall where two lines cross, of segments in the plane or of edges in space, by their numbers. */
froe_cut split_cylinder_crossing(split_set *set, uint32_t a, uint32_t b);
#endif
