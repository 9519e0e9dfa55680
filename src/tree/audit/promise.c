/* promise.c: measuring on a finished tree what methods promise about it.
 *
 * The guard stage is the connected top part of the tree whose nodes carry TREE_GUARD; what hangs
 * below it are its cells. A convex object has one fragment in a cell, whatever the refinement
 * of the cell cut it into, so the fragments of a cell are the different objects in its slice. The
 * same holds for the stage of charged cells (TREE_CHARGED). */
#include "tree/audit/aspect.h"
#include "tree/list.h"
#include "tree/walk.h"
#include <string.h>

static bool in_stage(const froe_tree *t, uint8_t flag, uint32_t node) {
    return !tree_is_leaf(t->nodes + node) && t->nodes[node].flags & flag;
}

/* The cell of a node: its highest ancestor-or-self outside the stage; itself within. */
static froe_status stage_fragments(const froe_tree *t, uint8_t flag, double *out) {
    const size_t objects = t->scene->object_count;
    uint32_t *met =
        support_calloc(&t->alloc, objects, sizeof *met); /* per object: 1 + root of the last cell it was in */
    tree_walk walk = {.tree = t};
    uint32_t cell = 0;
    size_t depth = SIZE_MAX; /* of the cell's root, while in one */
    double fragments = 0;
    if (!met) return FROE_E_MEMORY;
    while (tree_walk_next(&walk)) {
        if (tree_walk_depth(&walk) <= depth) depth = SIZE_MAX;
        if (depth == SIZE_MAX) {
            cell = walk.node;
            if (!in_stage(t, flag, cell)) depth = tree_walk_depth(&walk);
        }
        tree_objects list = tree_list(t, walk.node);
        for (uint32_t i = 0; i < list.count; i++) {
            uint32_t *last = met + tree_object(&list, i);
            fragments += *last != cell + 1;
            *last = cell + 1;
        }
    }
    support_free(&t->alloc, met, objects ? objects * sizeof *met : 1);
    *out = fragments;
    return tree_walk_end(&walk);
}

/* Each cut above a piece has dealt it, or what it is a part of, to a side. */
static froe_status path_length(const froe_tree *t, double *out) {
    tree_walk walk = {.tree = t};
    double sum = 0;
    while (tree_walk_next(&walk)) sum += (double)tree_walk_depth(&walk) * tree_list(t, walk.node).count;
    *out = sum;
    return tree_walk_end(&walk);
}

froe_status tree_measure(const froe_tree *t, const char *name, double *out) {
    const froe_report *r = &t->report;

    if (!strcmp(name, "height")) {
        *out = (double)r->height;
    } else if (!strcmp(name, "nodes")) {
        *out = (double)t->node_count;
    } else if (!strcmp(name, "path_length")) {
        return path_length(t, out);
    } else if (!strcmp(name, "fragments")) {
        *out = (double)r->fragments;
    } else if (!strcmp(name, "guard_leaves")) {
        *out = 1;
        for (uint32_t i = 0; i < t->node_count; i++) *out += in_stage(t, TREE_GUARD, i);
    } else if (!strcmp(name, "guard_fragments")) {
        return stage_fragments(t, TREE_GUARD, out);
    } else if (!strcmp(name, "charged_fragments")) {
        return stage_fragments(t, TREE_CHARGED, out);
    } else if (!strcmp(name, "aspect") && t->scene->dim > 3) {
        return tree_aspect(t, out);
    } else {
        return FROE_E_UNSUPPORTED;
    }
    return FROE_OK;
}

froe_status tree_fill_promises(froe_tree *t) {
    for (uint32_t i = 0; i < t->meta.promise_count; i++) {
        tree_promise *p = t->meta.promises + i;
        double measured = p->measured;
        if (p->measured == 0 && tree_measure(t, p->name, &measured) == FROE_E_MEMORY) return FROE_E_MEMORY;
        p->measured = t->promises[i].measured = measured;
    }
    return FROE_OK;
}

void tree_promise_anew(froe_tree *t, const char *name, double promised) {
    for (uint32_t i = 0; i < t->meta.promise_count; i++)
        if (!strcmp(t->meta.promises[i].name, name)) t->meta.promises[i].promised = t->promises[i].promised = promised;
}
