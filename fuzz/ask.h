/* ask.h: every question of froe/query.h to a tree, with arguments from bytes. */
#ifndef FROE_FUZZ_ASK_H
#define FROE_FUZZ_ASK_H
#include "support.h"
#include <froe/froe.h>

/** Ends the program if answers of a right tree do not agree with one another. Those of a wrong one may be any. */
void ask(const froe_tree *tree, bool right, fuzz_bytes *bytes);
#endif
