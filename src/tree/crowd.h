/* crowd.h: when solids that can be separated stay together.
 *
 * Where solids overlap, a cut between two of them runs through many others, and each of these has one more entry
 * from then on. A leaf is crowded when at least half of the pairs of its objects cannot be separated by any cut: to
 * compare all of them is then at most twice the work that remains with any partition. In long lists each object is
 * compared with the TREE_CROWD_REACH before it. Builder and audit go through the same pairs. Each decides by a method
 * of its own which can be separated. */
#ifndef FROE_TREE_CROWD_H
#define FROE_TREE_CROWD_H
#include <stdbool.h>
#include <stdint.h>

enum { TREE_CROWD_REACH = 32 };

/** Goes through the pairs of a list, from (0, 1) on. */
typedef struct tree_crowd {
    uint32_t a, b;                   /**< the next pair: places in the list, a < b */
    uint64_t pairs, together, apart; /**< of all; that cannot be separated; that can */
} tree_crowd;

/** Of a list of two objects at least. */
static inline tree_crowd tree_crowd_of(uint32_t count) {
    uint64_t n = count, reach = n > TREE_CROWD_REACH ? TREE_CROWD_REACH : n;
    return (tree_crowd){.b = 1, .pairs = n * reach - reach * (reach + 1) / 2};
}
static inline bool tree_crowd_is(const tree_crowd *crowd) {
    return 2 * crowd->together >= crowd->pairs;
}
/** Is the answer known before all pairs are? */
static inline bool tree_crowd_known(const tree_crowd *crowd) {
    return tree_crowd_is(crowd) || 2 * crowd->apart > crowd->pairs;
}
/** Takes note of a pair, and goes on to the next. */
static inline void tree_crowd_tell(tree_crowd *crowd, bool apart) {
    *(apart ? &crowd->apart : &crowd->together) += 1;
    if (++crowd->a < crowd->b) return;
    crowd->b++;
    crowd->a = crowd->b > TREE_CROWD_REACH ? crowd->b - TREE_CROWD_REACH : 0;
}
#endif
