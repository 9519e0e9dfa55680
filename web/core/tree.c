/* tree.c: trees: built, counted, as cuts, and as bytes */
#include "web.h"
#include <stdlib.h>
#include <string.h>

static const web_member members[] = {
    {"method", WEB_ADDRESS, offsetof(froe_build_options, method), NULL},
    {"purpose", WEB_ADDRESS, offsetof(froe_build_options, purpose), NULL},
    {"settings", WEB_ADDRESS, offsetof(froe_build_options, settings), NULL},
    {"leaf", WEB_INT, offsetof(froe_build_options, leaf), NULL},
    {"seed", WEB_UINT64, offsetof(froe_build_options, seed), NULL},
    {"maxFragments", WEB_UINT64, offsetof(froe_build_options, max_fragments), NULL},
    {NULL, WEB_INT, 0, NULL},
};

WEB_EXPORT froe_build_options *web_build_options_new(void) {
    froe_build_options *options = malloc(sizeof *options);
    if (!options) return NULL;
    *options = froe_build_defaults();
    options->threads = 1;
    options->progress = web_progress;
    return options;
}
WEB_EXPORT froe_status web_build_options_number(froe_build_options *options, const char *name, double value,
                                                froe_diagnostic *diag) {
    return web_set_number(options, members, name, value, diag);
}

/** The numbers of a report, in the order of REPORT in package/tree.js. */
enum { REPORT = 16 };
WEB_EXPORT void web_report(const froe_tree *tree, double out[REPORT]) {
    const froe_report r = froe_tree_report(tree);
    const double numbers[REPORT] = {
        (double)r.dim,      (double)r.leaf,        (double)r.seed,      (double)r.objects,
        (double)r.nodes,    (double)r.leaves,      (double)r.fragments, (double)r.in_cut,
        (double)r.covers,   (double)r.size,        (double)r.height,    r.mean_depth,
        (double)r.max_leaf, (double)r.inseparable, (double)r.bytes,     (double)r.predicates.exact,
    };
    memcpy(out, numbers, sizeof numbers);
}
WEB_EXPORT const char *web_report_method(const froe_tree *tree) {
    return froe_tree_report(tree).method;
}
WEB_EXPORT const char *web_report_settings(const froe_tree *tree) {
    return froe_tree_report(tree).settings;
}

WEB_EXPORT const char *web_method_name(uint32_t i) {
    const froe_method_info *method = froe_method_at(i);
    return method ? method->name : NULL;
}
WEB_EXPORT const char *web_method_summary(uint32_t i) {
    return froe_method_at(i)->summary;
}
WEB_EXPORT bool web_method_serves(uint32_t i, const froe_scene *scene) {
    return froe_method_serves(froe_method_at(i), scene, FROE_LEAF_OWN);
}

/** A cut of the plane within a box: the node, its depth, and the two ends. */
typedef struct web_cut {
    uint32_t node, depth;
    double ends[4];
} web_cut;
typedef struct web_cuts {
    web_cut *cuts;
    size_t count, room;
    bool no_memory;
} web_cuts;

static bool take_cut(void *user, const froe_cell *cell) {
    web_cuts *all = user;
    if (cell->leaf || cell->cut_corners != 2) return true;
    if (all->count == all->room) {
        all->room = all->room ? 2 * all->room : 1024;
        web_cut *more = realloc(all->cuts, all->room * sizeof *more);
        if (!more) return !(all->no_memory = true);
        all->cuts = more;
    }
    web_cut *cut = all->cuts + all->count++;
    cut->node = cell->node.id1;
    cut->depth = cell->depth;
    memcpy(cut->ends, cell->cut_coords, sizeof cut->ends);
    return true;
}

/** The cuts of a tree of the plane, parents first: `*cuts` is freed by web_free(). */
WEB_EXPORT froe_status web_cuts_of(const froe_tree *tree, const double *lo, const double *hi, web_cut **cuts,
                                   size_t *count, froe_diagnostic *diag) {
    web_cuts all = {NULL, 0, 0, false};
    froe_status status = froe_tree_cells(tree, lo, hi, take_cut, &all, diag);
    if (status == FROE_OK && all.no_memory) status = web_no_memory(diag);
    if (status != FROE_OK) {
        free(all.cuts);
        return status;
    }
    *cuts = all.cuts;
    *count = all.count;
    return FROE_OK;
}

/** The bytes of a saved tree: `*bytes` is freed by web_free(). */
WEB_EXPORT froe_status web_save(const froe_tree *tree, void **bytes, size_t *count, froe_diagnostic *diag) {
    web_bytes all = {NULL, 0, 0, false};
    return web_bytes_end(&all, froe_tree_write(tree, web_bytes_take, &all, diag), bytes, count, diag);
}
