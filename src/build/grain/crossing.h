/* crossing.h: splits that no cut can avoid.
 *
 *      \                    f is to be the cut, and splits both g and h. Wherever two objects cross, one of them has to
 *       g         h         be split, f or g, so that a split of g costs nothing that could be saved. h crosses only
 *     ---\--f-- . / . .     the line of f: another cut may spare it.
 *         \     /
 */
#ifndef FROE_BUILD_GRAIN_CROSSING_H
#define FROE_BUILD_GRAIN_CROSSING_H
#include "split/score/view.h"

/** Of the fragments that a count has just found on both sides of the plane of `object`, how many cross the object
 * itself. In plain doubles: what only touches it may count or not. */
uint32_t split_crossing_count(const split_view *view, const froe_scene *scene, uint32_t object,
                              const split_view_plane *plane);
#endif
