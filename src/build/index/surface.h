/* surface.h: axis-parallel cuts of space by surface area (MacDonald and Booth: Heuristics for ray tracing using space
 * subdivision, 1990), tried at the borders of bins (Shevtsov, Soupikov and Kapustin: Highly parallel fast kd-tree
 * construction, 2007). */
#ifndef FROE_BUILD_INDEX_SURFACE_H
#define FROE_BUILD_INDEX_SURFACE_H
#include "tree/packed/space.h"

/** A cut, and the items on each side of it; those on both count in both. */
typedef struct surface_cut {
    int axis;
    double value;
    double cost; /**< expected tests for a search that comes into the bounds of the items, over those without the cut */
    uint32_t sides[2], both;
} surface_cut;

/** The best cut by samples of the items. False: nothing can be cut. */
bool surface_choose(const space_item *items, uint32_t count, surface_cut *cut);
/** Counts the items beside the cut, and leaves their classes in `classes`: 1 negative, 2 positive, 3 both. A value at
 * which an item is flat is moved to the next double. False: no value will do. */
bool surface_count(const space_item *items, uint32_t count, surface_cut *cut, uint8_t *classes);
/** Do differences of coordinates not overflow? Only then parts of triangles can be told. */
bool surface_is_tame(const froe_scene *s);
/** Divides an item that is on both sides of a cut: the bounds of its parts, and on which sides anything of it is.
 * thorough: triangles are compared with boxes by their planes, too. */
void surface_divide(const froe_scene *s, bool tame, const surface_cut *cut, bool thorough, const space_item *item,
                    space_item *const out[2], bool left[2]);
/** Deals items to two runs, by their classes; those on both sides are divided, and left out where nothing of them
 * remains. Updates the counts of the cut. */
void surface_deal(const froe_scene *s, const space_item *items, uint32_t count, surface_cut *cut,
                  const uint8_t *classes, bool thorough, space_item *negative, space_item *positive);
#endif
