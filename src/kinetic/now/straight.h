/* straight.h: when claims about vertices fail that fly straight, in doubles, for most of what is asked. */
#ifndef FROE_KINETIC_STRAIGHT_H
#define FROE_KINETIC_STRAIGHT_H
#include "kinetic/now/now.h"

/** What now_first_failure() says. False: doubles leave it open, or it is another kind of claim. */
bool straight_first_failure(now_state *now, const now_claim *claim, int64_t *out);
#endif
