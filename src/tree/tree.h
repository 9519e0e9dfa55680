/* tree.h: the tree from inside: flat arrays, the same in memory and on disk.
 *
 *     nodes        [0] root; children in pairs, after their parent, in depth-first order
 *       inner, cut plain:   axis, value in the node itself, no in-cut list (the guard stage)
 *       inner, cut tabled:  u.cut -> cuts[], which holds any cut and the list of the node
 *       leaf:               u.list -> pieces[first .. first+count), or, in packed trees, the block `child`
 *     list         [ covers | pieces in the cut, or in the open cell ]
 *     pieces       object + where its fragment's ring starts in `bounds` (0: the whole object)
 *     bounds       rings:  count, edge, edge, ...   edge = own edge i | CUT | node
 *     normals      dim doubles per FROE_CUT_PLANE, dim + 1 per row of a FROE_CUT_FINE
 *
 * A cover is a box that contains the region of the node. It is listed there, and in no list below: all lists on the
 * way from the root to a leaf together hold what meets the leaf's cell. u.covers of an inner node and `child` of a leaf
 * say how many pieces of its list are covers; the nodes of packed trees have none.
 *
 * The ring of a segment is its two ends (own end 0 or 1, or the node whose cut ends it);
 * the ring of a polygon its edges in order: corner i is where edge i-1 meets edge i.
 * Lists of a subtree are one contiguous slice of `pieces`: node, left subtree, right subtree.
 * All arrays are packed in depth-first order: children are the next free pair when their parent is
 * visited, and cut, normal, list and rings of a node the next free places of their arrays; an empty
 * list has the place where it would begin. Unused fields are 0. tree/validate.c relies on it.
 *
 * A packed tree, one that is built to be queried, has plain cuts only and neither pieces nor bounds: its leaves are
 * blocks (tree/packed/packed.h). Pieces are numbered all the same. tree/list.h reads the lists of both layouts.
 *
 * It speaks for tree.c, corners.c (the spare context) and audit/promise.c. */
#ifndef FROE_TREE_TREE_H
#define FROE_TREE_TREE_H
#include "scene/scene.h"

#define TREE_EDGE_CUT 0x80000000u /**< ring entry: the rest is a node id; otherwise an own edge or end */
#define TREE_MOST 0x7ffffffeu     /**< nodes, and pieces: ids leave a bit for TREE_EDGE_CUT */

enum { TREE_LEAF = 0, TREE_PLAIN = 1, TREE_TABLED = 2 }; /* tree_node.type */
/* tree_node.flags. CHARGED: the fragments of the cell are counted by a promise (split/charge/thin.h) */
enum { TREE_GUARD = 1, TREE_INSEPARABLE = 2, TREE_CROWDED = 4, TREE_CHARGED = 8 };

typedef struct tree_node { /* 16 bytes */
    union {
        double value; /**< plain: x[axis] = value */
        struct {
            uint32_t cut, covers;
        }; /**< tabled */
        struct {
            uint32_t first, count;
        } list; /**< leaf */
    } u;
    uint32_t child; /**< left child; right = child + 1; leaf: its covers, packed: its block */
    uint8_t type, flags, axis, unused;
} tree_node;

typedef struct tree_cut { /* 24 bytes */
    uint32_t kind;        /**< froe_cut_kind */
    uint32_t a;           /**< axis | object | vertex 0 | edge 0 | index of a double in normals */
    union {
        double value; /**< AXIS, PLANE */
        struct {
            uint32_t b, c;
        } id; /**< VERTICES, EDGE, CROSSING; FINE: rows, 0 */
    } u;
    uint32_t first, count; /**< list: covers, then what lies in the cut */
} tree_cut;

typedef struct tree_piece { /* 8 bytes */
    uint32_t object;
    uint32_t ring; /**< index into bounds, 0: whole */
} tree_piece;

typedef struct tree_table tree_table;
typedef struct tree_wide tree_wide;
typedef struct tree_gate tree_gate;

#define TREE_PROMISES 12
#define TREE_TEXT 512
typedef struct tree_promise {
    char name[32];
    double promised, measured;
} tree_promise;

/** What is known of a tree beside its arrays; saved with it. */
typedef struct tree_meta {
    char method[32], settings[TREE_TEXT];
    uint64_t seed;
    uint32_t leaf, promise_count;
    tree_promise promises[TREE_PROMISES];
    double root_lo[FROE_MAX_DIM], root_hi[FROE_MAX_DIM]; /**< root cube of the guard stage; 0,0 without one */
} tree_meta;

/** What follows from the arrays of tree and scene by a walk through all of them; saved with the tree. */
typedef struct tree_facts {
    uint64_t pieces, leaves, in_cut, covers, height, max_leaf, inseparable, crowded; /**< as in froe_report */
    double mean_depth;
    uint64_t levels;                           /**< of wide nodes (tree/packed/wide.h); 0: there are none */
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM]; /**< bounds of the scene; 0 without objects and beyond its dimension */
} tree_facts;

/** The jump table (tree/packed/table.h) as files hold it: a node for each cell, and a byte for each line of columns,
 * then of rows. */
typedef struct table_cells {
    uint32_t *nodes;
    uint8_t *crooked;
    uint64_t count, lines; /**< 0: there is no table */
} table_cells;

/** Leaf blocks and what belongs to them; all zero in other trees. */
typedef struct tree_packed {
    uint8_t *blocks;      /**< at a multiple of 64 */
    uint32_t block_count; /**< of 64 bytes each; the last is a sentinel */
    uint32_t owner_count;
    uint32_t *owners;
    void *memory; /**< that blocks lie in; NULL: in a mapped file */
    size_t memory_size;
    tree_table *table; /**< of the plane; follows from the nodes: tree/packed/table.h. Opened trees have it when they
                            are ready (tree/gate.h) */
    table_cells cells; /**< its size; of an opened tree they lie in the file */
    tree_wide *wide;   /**< of space; follows from the nodes and boxes: tree/packed/wide.h */
} tree_packed;

/** A number context for calls that have no other (corners.c). */
typedef struct tree_spare tree_spare;
froe_status tree_spare_new(const froe_allocator *alloc, tree_spare **out);
void tree_spare_free(const froe_allocator *alloc, tree_spare *spare);

struct froe_tree {
    froe_allocator alloc;
    froe_scene *scene; /**< held */
    tree_meta meta;
    tree_facts facts;
    uint32_t node_count, cut_count, piece_count, bound_count, normal_count; /**< normal_count in doubles */
    tree_node *nodes;
    tree_cut *cuts;
    tree_piece *pieces;
    uint32_t *bounds; /**< bounds[0] unused */
    double *normals;
    tree_packed packed;
    froe_predicate_stats predicates; /**< of the build */
    froe_report report;              /**< computed once, by tree_finish */
    froe_promise promises[TREE_PROMISES + 1];
    tree_spare *spare;
    bool mapped;     /**< arrays lie in the file that the scene has mapped */
    tree_gate *gate; /**< what of the file has been checked (tree/gate.h); NULL: there is no file */
};

static inline bool tree_is_leaf(const tree_node *node) {
    return node->type == TREE_LEAF;
}
static inline bool tree_is_packed(const froe_tree *t) {
    return t->packed.blocks;
}
/** So many of a node's list, the first ones, are covers. */
static inline uint32_t tree_covers(const froe_tree *t, const tree_node *node) {
    return node->type == TREE_TABLED ? node->u.covers : tree_is_leaf(node) && !tree_is_packed(t) ? node->child : 0;
}
/** First piece of a subtree (not of a packed tree): a node's list comes before those of its children, the left one
 * first. */
static inline uint32_t tree_first_piece(const froe_tree *t, uint32_t node) {
    while (t->nodes[node].type == TREE_PLAIN) node = t->nodes[node].child;
    return tree_is_leaf(t->nodes + node) ? t->nodes[node].u.list.first : t->cuts[t->nodes[node].u.cut].first;
}
/** How many doubles of normals a cut has. */
static inline size_t tree_cut_normals(const tree_cut *cut, int dim) {
    if (cut->kind == FROE_CUT_FINE) return cut->u.id.b * ((size_t)dim + 1);
    return cut->kind == FROE_CUT_PLANE ? (size_t)dim : 0;
}
/** A node's cut, given the tables it refers to; kind NONE at a leaf. */
froe_cut tree_cut_view(const tree_node *node, const tree_cut *cuts, const double *normals);
froe_cut tree_cut_at(const froe_tree *t, uint32_t node); /**< kind NONE at a leaf */
geom_plane tree_plane_at(const froe_tree *t, uint32_t node);

/** Takes memory for the arrays, of the sizes their counts say. FROE_E_MEMORY: froe_tree_free() gives back what was had.
 */
froe_status tree_take_arrays(froe_tree *tree);
/** Computes facts, report and promise views of a tree whose arrays and meta are complete, and what searches need beside
 * them. FROE_E_MEMORY. */
froe_status tree_finish(froe_tree *tree);
/** Computes the facts of a tree, whose nodes have been checked. FROE_E_MEMORY. O(nodes). */
froe_status tree_facts_of(const froe_tree *tree, tree_facts *out);
/** Makes report and promise views from meta and facts. FROE_E_MEMORY. O(1). */
froe_status tree_show(froe_tree *tree);
/** Measures what a promise of that name is about, on a finished tree: height, nodes, path_length (over all pieces, the
 * cuts above each), size, fragments, leaf_load (most pieces in a leaf), guard_leaves (cells of the guard stage),
 * guard_fragments (over those cells and the stage's own cuts), charged_fragments (the same of charged cells), aspect
 * (of the guard stage's cells, above dimension 3:
 * audit/aspect.h). FROE_E_UNSUPPORTED for other names; FROE_E_MEMORY. */
froe_status tree_measure(const froe_tree *tree, const char *name, double *out);
/** Replaces the promise of a name, for a value that a builder finds while it builds. */
void tree_promise_anew(froe_tree *tree, const char *name, double promised);
/** Measures the promises whose builder left that at 0, by tree_measure. FROE_E_MEMORY. */
froe_status tree_fill_promises(froe_tree *tree);
#endif
