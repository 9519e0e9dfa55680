/* zone_cut.h: the cut of a zone: both parts fat, and after a few such cuts no part has too many of the points.
 *
 *     +-----+-------+     median   a cut at the median of some direction leaves two fat parts, none too full.
 *     |    :|:    . |              Otherwise more points than the goal lie in a cluster:
 *     |    :|:   ...|
 *     +-------------+     border   it is amid the zone in some direction: a cut runs beside it, so that it is no more
 *     |           / |     zoom     it is near the border of the zone in every direction: one cut leaves it in a zone
 *     |          /::|              not much larger than its distance from there
 *     |         /::.|     halve    the zone is not much larger than the cluster
 *     +-------------+
 *
 * docs/design/bar.md proves that with an aspect of 20 this ends, within a number of cuts that depends on the dimension
 * alone. It is what Duncan, Goodrich and Kobourov ("Balanced aspect ratio trees", 1999) do with other directions and
 * two cuts. */
#ifndef FROE_BUILD_BAR_ZONE_CUT_H
#define FROE_BUILD_BAR_ZONE_CUT_H
#include "build/bar/bar_cut.h"
#include "build/bar/zone.h"

/** What a thread works with; all zero at first. */
typedef struct zone_search {
    ARRAY(double) rows; /**< the points, dim doubles each, by the caller; then seen from shape.origin */
    ARRAY(double) column;
    zone_shape shape;     /**< the zone, seen from one of the points */
    zone_cluster cluster; /**< for the parts that the cut leaves */
} zone_search;

/** The cut of a zone of R^dim with `count` points inside, of which a part is to have `goal` at most; 0 < count / 2 <=
 * goal < count. Where it is the zone's own goal, the sequence of cuts goes on, about the zone's own cluster. `aspect`:
 * of zones, at most. Never BAR_UNBALANCED. Deterministic. O(dim^2 count). */
bar_found zone_search_cut(const froe_allocator *alloc, zone_search *search, const bar_zone *zone, int dim,
                          uint32_t count, uint32_t goal, double aspect, froe_cut *out);
void zone_search_free(const froe_allocator *alloc, zone_search *search);
#endif
