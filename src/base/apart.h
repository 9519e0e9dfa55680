/* apart.h: room between what threads write.
 *
 *     item of thread 0 | apart | item of thread 1 | apart |     A cache line that one thread writes, and another one
 *     ..........line..|.line..|......line........|.line...     reads or writes, goes to and fro between their
 *                                                               processors at each turn ("false sharing"). */
#ifndef FROE_BASE_APART_H
#define FROE_BASE_APART_H

/** Ends an item of an array whose items are written by different threads at once. Two lines, as processors fetch
 * pairs. */
typedef struct base_apart {
    char unused[128];
} base_apart;
#endif
