/* fallback.h: cuts that certainly separate something, where better ones cannot be had. */
#ifndef FROE_SPLIT_FALLBACK_H
#define FROE_SPLIT_FALLBACK_H
#include "split/score/view.h"

/** The support of some fragment, drawn by `draw`, takes that fragment at least out of the cell. False: there is none
 * (boxes, balls and hulls only). */
bool split_any_support(const split_set *set, const split_cell *cell, uint64_t draw, froe_cut *cut);
/** The same, but only by a fragment that crosses its cell from border to border: no disjoint one is split by it. */
bool split_any_free(const split_set *set, const split_cell *cell, uint64_t draw, froe_cut *cut);
/** The axis-parallel plane that halves the vertices shown, without those that are first or last along the axis; on the
 * axis where most are left. False: none are left on any. Uses up the view. */
bool split_vertex_median(split_view *view, const froe_scene *scene, froe_cut *cut);
/** Does the fragment cross its cell from border to border? */
bool split_is_free(const split_set *set, const split_fragment *fragment);
/** Equal points, and nothing else, in the cell? */
bool split_one_point(const split_set *set, const split_cell *cell);
#endif
