/* grow.h: the loop every builder shares: take a cell, name its cut, cut, go on.
 *
 *     pending cells     [ ... | cell | cell | current ]        depth first, negative child first
 *     set->items        [ ... | its fragments on top ]
 *     lowest->ids       [ .. | objects that nothing has cut yet | .. ]     in the guard stage only
 *
 * Nothing recurses. Cells of at most 1/64 of the fragments become tasks: each
 * is finished in a draft of its own, on any thread, and grafted. Larger cells are cut on one thread. Where naming their
 * cuts takes most of the time (split_method.ahead), they are worked off level by level: the cuts of a level are named
 * on all threads, and made one after the other. What a cell becomes depends on its path and its fragments alone, so
 * the tree is the same for any number of threads. */
#ifndef FROE_SPLIT_GROW_H
#define FROE_SPLIT_GROW_H
#include "base/apart.h"
#include "base/task.h"
#include "split/fragment.h"
#include "split/guard/lowest_nodes.h"

typedef struct split_cell {
    uint32_t node; /**< ring numbering */
    uint32_t depth;
    uint32_t peels;         /**< of the cuts above it, those that peel boxes (cover_peel) */
    uint64_t path;          /**< for base_hash() */
    uint32_t first, count;  /**< its fragments: set->items */
    uint32_t covers;        /**< so many before them are covers: boxes that contain the cell (split/cell.h) */
    uint32_t whole, wholes; /**< and, in the guard stage, whole objects: lowest->ids[whole ..], so many */
    uint32_t corner_top;    /**< corners from here on belong to cells that are done */
    uint32_t guard;         /**< node of the guard tree that this cell is, or FROE_NONE */
    float growth;           /**< fragmentation by the cuts so far: see density.c */
    uint32_t barren;        /**< cuts in a row that left nearly all fragments in this cell */
    uint32_t tried;         /**< load at which refinement was last taken back, here or above: guard/trial.h */
    bool plain;             /**< to be cut along its fragments alone, in random order */
    uint32_t thin;          /**< 1 + the node of work->thin that it is to be cut by, or 0 (charge/thin.h) */
    bool thinned;           /**< it is part of a cell that was thinned out */
    uint32_t attempt;       /**< how often the chosen cut separated nothing */
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM]; /**< bounds by the axis-parallel cuts above; where set->boxes only */
} split_cell;

typedef enum split_verdict {
    SPLIT_LEAF,        /**< done */
    SPLIT_INSEPARABLE, /**< done, over capacity: nothing separates these objects */
    SPLIT_CROWDED,     /**< done, over capacity: separating these solids would not pay (tree/crowd.h) */
    SPLIT_CUT,         /**< cut; the cut must lie through the cell's fragments or between them */
    SPLIT_CUT_ANYWAY,  /**< cut, whatever that separates */
    SPLIT_CUT_GUARD,   /**< the same, in the guard stage: such cells have only such cells above them */
    SPLIT_REFUSE,      /**< end the whole build with FROE_E_INPUT: the objects work->crossing cross */
    SPLIT_GIVE_UP,     /**< end the whole build with FROE_E_BUDGET */
    SPLIT_MEMORY,      /**< out of memory */
    SPLIT_CANCELLED    /**< split_go_on() returned false */
} split_verdict;

/** What `choose` of a method said. */
typedef struct split_choice {
    split_verdict verdict;
    froe_cut cut;
} split_choice;

/** What trials go by (guard/trial.h). */
typedef struct split_trial_terms {
    const uint32_t *leaves; /**< below every node of the guard tree */
    double candidates;      /**< for the cut of a cell, at most, with the cut itself */
    bool idle;              /**< what exceeds its allowance stays all the same */
} split_trial_terms;

/** What the cells where the guard stage ended add up to, with the cuts of the stage. */
typedef struct split_books {
    uint64_t fragments; /**< that these cells have, and those cuts */
    double beyond;      /**< the most of them that came after the stage would have ended by itself */
    double pieces;      /**< the most that refinement makes of them */
    double height;      /**< the most, too, besides cuts that peel boxes */
    double peels;       /**< the most of these on one path */
} split_books;

/** What refinement of a cell may take. */
typedef struct split_allowance {
    double pieces, tests, levels;
} split_allowance;

/** A subtree on its way: how much is in the arrays of split_work. */
typedef struct split_stand {
    tree_draft_mark draft;
    size_t items, cells;
    uint32_t deepest;
    split_books books;
} split_stand;

/** The subtree of a cell where the guard stage ended, while it may still be taken back (guard/trial.h). */
typedef struct split_trial {
    bool open, by_guard;     /**< by_guard: guard cuts come first, and refinement waits */
    bool final;              /**< allowed: all that is ever needed */
    double other;            /**< pieces that the other way is known to make at least */
    split_allowance allowed; /**< to refinement */
    uint64_t tested;         /**< split_work.tests when that began */
    split_cell cell;         /**< as it was before, with its fragments in items */
    split_stand before;      /**< without the subtree */
    split_stand waiting;     /**< with what waits: so many tests, and its root */
    uint64_t waiting_tests;
    tree_node root;
    ARRAY(split_fragment) items;
} split_trial;

/** How a cell is thinned out where its cut would split too much (charge/thin.h). */
typedef struct split_thin_rule {
    double growth;   /**< fragments in place of one at which a cut is refused; 0: never */
    uint32_t least;  /**< cells of fewer fragments are cut as they are */
    uint32_t guards; /**< left in a cube; 0: cells are cut as they are, whatever that splits */
} split_thin_rule;

/** What thinning cells out came to. */
typedef struct split_thin_notes {
    uint64_t before, after;   /**< fragments of cells that were thinned out, and in what they became */
    uint32_t height, largest; /**< most levels of guard cuts, and most fragments of a cell below */
} split_thin_notes;

/** One thread's working state; `scratch` is the builder's, one per worker. */
typedef struct split_work {
    split_set set;
    ARRAY(split_cell) cells;
    ARRAY(unsigned char) rooms; /**< split_method.room bytes each: of the cell at hand, then of those in cells */
    void *scratch;
    base_task *task;
    const split_choice *chosen; /**< for the cell at hand, ahead of its turn; NULL: it has yet to be chosen */
    split_trial first, later;
    split_books books;
    uint64_t tests;        /**< fragments compared with planes: with cuts and with candidates for them */
    double tests_allowed;  /**< the most that trials allow of these */
    uint64_t carried;      /**< fragments that guard cuts have led anywhere; these and those, what failed, too */
    split_guard_tree thin; /**< of the cell that is being thinned out */
    split_thin_notes thinned;
    uint32_t crossing[2]; /**< on SPLIT_REFUSE; otherwise FROE_NONE */
    uint32_t deepest;     /**< depth of the deepest cell of the current subtree */
    uint64_t most;        /**< pieces that a subtree grown again may have; 0: the first time, max_fragments counts */
    bool calling;         /**< on the thread of the caller's call, the only one that calls the callback */
    base_apart apart;
} split_work;

/** False once the build is cancelled. Methods call it in loops that one cell may make long. */
static inline bool split_go_on(const split_work *work) {
    return work->calling ? base_progress(work->task, work->task->done) : !base_cancelled(work->task);
}

/** A builder, as the loop sees it. `config` is shared by all threads, read only. */
typedef struct split_method {
    const void *config;
    /** Names the cut of a cell whose fragments are set->items[first ..]. Deterministic. */
    split_verdict (*choose)(const void *config, split_work *work, const split_cell *cell, froe_cut *cut);
    /** Grows the whole subtree of a cell at once; *done false: the cell is to be cut. Called of every cell below the
     * guard tree, before `choose`. NULL: never done. */
    froe_status (*finish)(const void *config, split_work *work, const split_cell *cell, bool *done);
    /** Does `choose` read nothing but the fragments of the cell and the cuts above it, and take long? Then it is called
     * for many large cells at once, before any of them is cut. REQUIRES: no guard stage, no boxes. */
    bool ahead;
    /** Bytes that the method keeps of a cell besides, its room: all zero at the root. */
    size_t room;
    /** Fills the rooms of the children, positive and negative, of a cell that `cut` has just cut: so far they are
     * their parent's. NULL: the method uses no rooms. `guard`: it was a SPLIT_CUT_GUARD. */
    void (*divided)(const void *config, const split_work *work, const split_cell *cell, const froe_cut *cut, bool guard,
                    void *positive, void *negative);
    /** Is the cell to be cut by its node of the guard tree? NULL: never. */
    bool (*in_guard_stage)(const void *config, const split_cell *cell);
    /** Do cells have a shape that cuts along boxes that contain all others would spoil (split/cell.h)? */
    bool shaped;
    /** Are boxes that contain all others peeled before `choose` is asked, or else where it finds nothing? */
    bool peels_first;
    /** Called once all cells are done, before job->meta is read; may be NULL. */
    void (*note)(const void *config);
    /** Makes and frees a worker's scratch; may be NULL. */
    froe_status (*scratch_new)(const void *config, split_work *work);
    void (*scratch_free)(split_work *work);
    /** Levels wanted: a small subtree that reaches deeper is grown again as if it began deeper. 0: any. */
    double height;
    split_thin_rule thin;
} split_method;

/** What a build came to, with all that was taken back. */
typedef struct split_sums {
    split_books books;
    double tests, tests_allowed, carried;
} split_sums;

typedef struct split_job {
    froe_scene *scene;
    froe_allocator alloc;
    base_task *task;
    uint64_t max_fragments;        /**< 0: none */
    const uint32_t *order;         /**< of the objects, in the root cell and among those of any other; NULL: by id
                                        (no guard stage) */
    const froe_cut *root;          /**< the cut of the root, whatever it separates, and then no guard stage; NULL: the
                                        method's choice */
    const split_guard_tree *guard; /**< NULL: no guard stage */
    const split_lowest_nodes *lowest; /**< with guard */
    const split_trial_terms *trials;  /**< with guard: refinement is on trial; or NULL */
    double span;                      /**< share of the task's progress */
    const tree_meta *meta;
    split_sums *sums;          /**< may be NULL */
    num_stage first;           /**< where predicates start: NUM_FILTER, later ones for tests */
    split_thin_notes *thinned; /**< receives what thinning came to; may be NULL */
    froe_diagnostic *diag;
} split_job;

/** The room of the cell at hand, aligned for any type. */
static inline const void *split_room(const split_work *work) {
    return work->rooms.data;
}

/** Fragments and whole objects of a cell. */
static inline uint32_t split_load(const split_cell *cell) {
    return cell->count + cell->wholes;
}

/** One turn of the loop, for loops of their own, too: ends the cell, whose fragments are on top, or cuts it and pushes
 * its children, the negative one last. */
froe_status split_step(const split_method *method, split_work *work, split_cell *cell);
/** Says why growing a tree ended, for loops of their own, too: budget, limit, cancelled or memory. */
froe_status split_explain(froe_diagnostic *diag, uint64_t max_fragments, froe_status status);
/** Grows the whole tree over all objects of the scene. out NULL: for the method's own notes only. */
froe_status split_grow(const split_job *job, const split_method *method, froe_tree **out);
#endif
