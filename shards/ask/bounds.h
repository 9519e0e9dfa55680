/* bounds.h: the boxes of questions, outside which they have no answers, and bounds below the values that they can have
 * in a box; see ask.h. */
#ifndef FROE_SHARDS_BOUNDS_H
#define FROE_SHARDS_BOUNDS_H
#include "shards/ask/ask.h"

shards_box_fn shards_box_of_range; /**< it need not be the least */
shards_box_fn shards_box_of_box, shards_box_of_point;
shards_box_fn shards_box_of_all;      /**< the same for all questions: `points` */
shards_bound_fn shards_bound_of_any;  /**< of ranges: 0 in the shards that one may meet */
shards_bound_fn shards_bound_of_near; /**< the largest distance along an axis */
shards_bound_fn shards_bound_of_ray;  /**< the parameter at which it enters a box */
#endif
