/* look.h: what eyes see of a tree in space: depth order, visibility, pictures. */
#ifndef FROE_FUZZ_LOOK_H
#define FROE_FUZZ_LOOK_H
#include "support.h"
#include <froe/froe.h>

/** Ends the program if what is seen of a right tree cannot be. Of a wrong one anything may be seen. */
void look(const froe_tree *tree, bool right, fuzz_bytes *bytes);
#endif
