/* soak.h: decisions that are checked over and over: blocks of work, each made by a seed alone, and counted.
 *
 * What is called a decision: one side of one point, one object that does or does not belong to an answer, one sample of
 * a page, one contact, one comparison of a tree with one made anew. */
#ifndef FROE_TESTS_SOAK_SOAK_H
#define FROE_TESTS_SOAK_SOAK_H
#include <stdbool.h>
#include <stdint.h>

enum { SOAK_WORDS = 400 };

typedef struct soak_block {
    uint64_t seed;
    uint64_t decisions, wrong;
    uint64_t hard;        /**< that filters left to exact numbers, or that the oracle left open: see the kind */
    char why[SOAK_WORDS]; /**< of the first wrong one */
} soak_block;

/** Does the block of a seed, and adds to the counts. A failing assertion ends the program. */
typedef void soak_fn(soak_block *block);

soak_fn soak_whole, soak_rational, soak_walls, soak_answers, soak_pictures, soak_contacts, soak_plane, soak_space;

/** Counts a decision that is wrong. */
void soak_complain(soak_block *block, const char *format, ...);
#endif
