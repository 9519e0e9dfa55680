/* tree.c: trees: built, counted, as nodes and cuts, and as bytes */
#include "web.h"
#include <froe/formats.h>
#include <string.h>

#define AT(member) offsetof(froe_build_options, member)
static const web_member build_members[] = {
    {"method", WEB_TEXT, AT(method), NULL},
    {"purpose", WEB_TEXT, AT(purpose), NULL},
    {"settings", WEB_TEXT, AT(settings), NULL},
    {"leaf", WEB_INT, AT(leaf), NULL},
    {"seed", WEB_UINT64, AT(seed), NULL},
    {"order", WEB_ADDRESS, AT(order), NULL},
    {"orderCount", WEB_INT, AT(order_count), NULL},
    {"maxFragments", WEB_UINT64, AT(max_fragments), NULL},
    {NULL, WEB_INT, 0, NULL},
};
#undef AT
static void build_defaults(void *options) {
    froe_build_options *o = options;
    *o = froe_build_defaults();
    o->threads = 1;
    o->progress = web_progress;
}
const web_kind web_build_options = {"build", sizeof(froe_build_options), build_defaults, build_members};

static const web_member audit_members[] = {
    {"exactOnly", WEB_BOOL, offsetof(froe_audit_options, exact_only), NULL},
    {NULL, WEB_INT, 0, NULL},
};
static void audit_defaults(void *options) {
    froe_audit_options *o = options;
    *o = froe_audit_defaults();
    o->threads = 1;
    o->progress = web_progress;
}
const web_kind web_audit = {"audit", sizeof(froe_audit_options), audit_defaults, audit_members};

static const web_member export_members[] = {{NULL, WEB_INT, 0, NULL}};
static void export_defaults(void *options) {
    froe_export_options *o = options;
    *o = froe_export_defaults();
    o->progress = web_progress;
}
const web_kind web_export_options = {"export", sizeof(froe_export_options), export_defaults, export_members};

/** The numbers of a report, in the order of REPORT in package/tree.js, and its two texts. */
enum { REPORT = 17 };
WEB_EXPORT void web_report(const froe_tree *tree, double out[REPORT], const char *texts[2]) {
    const froe_report r = froe_tree_report(tree);
    const double numbers[REPORT] = {
        (double)r.dim,
        (double)r.leaf,
        (double)r.seed,
        (double)r.objects,
        (double)r.nodes,
        (double)r.leaves,
        (double)r.fragments,
        (double)r.in_cut,
        (double)r.covers,
        (double)r.size,
        (double)r.height,
        r.mean_depth,
        (double)r.max_leaf,
        (double)r.inseparable,
        (double)r.crowded,
        (double)r.bytes,
        (double)r.predicates.exact,
    };
    memcpy(out, numbers, sizeof numbers);
    texts[0] = r.method;
    texts[1] = r.settings;
}

/** Promises of the method of a tree: the i-th, or NULL past the last. */
WEB_EXPORT const froe_promise *web_promise(const froe_tree *tree, size_t i) {
    const froe_promise *promises = froe_tree_report(tree).promises;
    return promises && promises[i].name ? promises + i : NULL;
}

/** A node as JavaScript takes it, at number id1 - 1. */
typedef struct web_node {
    uint32_t children[2], first_piece, piece_count, cover_count;
    uint32_t cut, axis, ids[3];
    double value;
} web_node;
_Static_assert(sizeof(web_node) == 48, "package/tree.js reads it");

/** All nodes of a tree; room for as many as the report tells. */
WEB_EXPORT void web_nodes(const froe_tree *tree, web_node *nodes, size_t count) {
    for (size_t i = 0; i < count; i++) {
        const froe_node_info info = froe_tree_node(tree, (froe_node){(uint32_t)i + 1});
        nodes[i] = (web_node){
            .children = {info.child[0].id1, info.child[1].id1},
            .first_piece = (uint32_t)info.first_piece,
            .piece_count = (uint32_t)info.piece_count,
            .cover_count = (uint32_t)info.cover_count,
            .cut = info.cut.kind,
            .axis = (uint32_t)info.cut.axis,
            .ids = {info.cut.id[0], info.cut.id[1], info.cut.id[2]},
            .value = info.cut.value,
        };
    }
}

/** Cuts within a box, parents first: of each its node, its depth, and where in `coords` its corners begin, in
 * corners. */
typedef struct web_cuts {
    web_bytes nodes, depths, starts, coords;
} web_cuts;
_Static_assert(sizeof(web_cuts) == 64, "package/tree.js reads it");

typedef struct cut_taker {
    web_cuts *cuts;
    size_t dim;
    uint32_t corners;
} cut_taker;

static bool take_cut(void *user, const froe_cell *cell) {
    cut_taker *taker = user;
    if (cell->leaf || !cell->cut_corners) return true;
    taker->corners += (uint32_t)cell->cut_corners;
    return web_bytes_take(&taker->cuts->nodes, &cell->node.id1, sizeof cell->node.id1) &&
           web_bytes_take(&taker->cuts->depths, &cell->depth, sizeof cell->depth) &&
           web_bytes_take(&taker->cuts->starts, &taker->corners, sizeof taker->corners) &&
           web_bytes_take(&taker->cuts->coords, cell->cut_coords, cell->cut_corners * taker->dim * sizeof(double));
}

WEB_EXPORT void web_cuts_free(web_cuts *cuts) {
    web_bytes_free(&cuts->nodes);
    web_bytes_free(&cuts->depths);
    web_bytes_free(&cuts->starts);
    web_bytes_free(&cuts->coords);
}

/** Fills `out`, which is freed by web_cuts_free(), unless the call fails. */
WEB_EXPORT froe_status web_cuts_of(const froe_tree *tree, const double *lo, const double *hi, web_cuts *out,
                                   froe_diagnostic *diag) {
    *out = (web_cuts){{NULL, 0, 0, false}, {NULL, 0, 0, false}, {NULL, 0, 0, false}, {NULL, 0, 0, false}};
    cut_taker taker = {out, (size_t)froe_scene_dim(froe_tree_scene(tree)), 0};
    const bool begun = web_bytes_take(&out->starts, &taker.corners, sizeof taker.corners);
    froe_status status = begun ? froe_tree_cells(tree, lo, hi, take_cut, &taker, diag) : FROE_OK;
    web_bytes *columns[] = {&out->nodes, &out->depths, &out->starts, &out->coords};
    for (size_t i = 0; i < 4; i++) status = web_bytes_end(columns[i], status, diag);
    if (status != FROE_OK) web_cuts_free(out);
    return status;
}

/** The bytes of a saved tree. */
WEB_EXPORT froe_status web_save(const froe_tree *tree, web_bytes *out, froe_diagnostic *diag) {
    *out = (web_bytes){NULL, 0, 0, false};
    return web_bytes_end(out, froe_tree_write(tree, web_bytes_take, out, diag), diag);
}
