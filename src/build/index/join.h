/* join.h: a tree whose upper nodes are known before, and whose subtrees are jobs.
 *
 *          *            The steps name the nodes above, depth first, negative child first: a cut, or a subtree. One
 *        /   \          thread writes each subtree at once to where it belongs. Several write them apart; when all
 *       *     *         are there, it is known where each belongs, and they are copied there, on all threads. So the
 *      / \   / \        tree is the same, byte for byte, for any number of threads.
 *     j0 j1 j2 j3
 */
#ifndef FROE_BUILD_INDEX_JOIN_H
#define FROE_BUILD_INDEX_JOIN_H
#include "base/apart.h"
#include "build/method.h"
#include "tree/packed/packer.h"

/** Room for a subtree, about: what stays untouched of a large array costs nothing. */
typedef struct join_room {
    uint64_t nodes, blocks, owners;
} join_room;

typedef struct join_step {
    int axis; /**< -1: a subtree */
    double value;
} join_step;

typedef struct join_part {
    size_t step;
    join_room room;
    /* of several threads: */
    unsigned worker;
    packer_subtree subtree; /**< as that worker has written it */
    packer_place place;
} join_part;

/** The subtrees that one of several threads has written, one behind the other. */
typedef struct join_worker {
    tree_packer packer;
    base_apart apart;
} join_worker;

/** Builds subtree `part`, that is the one of the part-th step that is no cut, at a node of a packer, which is open. */
typedef froe_status join_fn(void *user, unsigned worker, size_t part, tree_packer *packer, uint32_t node);

typedef struct tree_join {
    build_job *job;
    join_fn *fn;
    void *user;
    ARRAY(join_step) steps;
    ARRAY(join_part) parts;
    ARRAY(uint32_t) open; /**< nodes of the tree that wait for a step, the next on top */
    size_t next;          /**< step */
    tree_packer tree;
    join_worker *workers; /**< of several threads */
    unsigned worker_count;
} tree_join;

/** The next step. False: no memory. */
bool join_cut(tree_join *join, int axis, double value);
bool join_subtree(tree_join *join, const join_room *room);
/** Forgets all steps. */
void join_clear(tree_join *join);
/** Builds all subtrees, and puts them together in join->tree. FROE_E_MEMORY, FROE_E_LIMIT, FROE_E_BUDGET,
 * FROE_E_CANCELLED, or what fn returns. */
froe_status join_run(tree_join *join, double span);
void join_free(tree_join *join);
#endif
