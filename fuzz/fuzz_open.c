/* fuzz_open.c: any bytes as a tree file. What opens must be safe to look at, all of it. */
#include "support.h"
#include <froe/froe.h>
#include <stdio.h>

static bool see_cell(void *user, const froe_cell *cell) {
    size_t *seen = user;
    return cell->leaf ? ++*seen < 10000 : true;
}

static void look_at_nodes(const froe_tree *tree, froe_node node, const froe_report *report) {
    /* Down the path that prefers child 1: nodes are values, no stack is needed. */
    for (uint64_t steps = 0; node.id1 && steps <= report->height; steps++) {
        const froe_node_info info = froe_tree_node(tree, node);
        for (size_t i = 0; i < info.piece_count; i++) (void)froe_tree_piece(tree, info.first_piece + i);
        node = info.child[1];
    }
}

static void look_at_scene(const froe_scene *scene) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], sum = 0;
    for (size_t i = 0; i < froe_scene_object_count(scene); i++) {
        const froe_object object = froe_scene_object(scene, (uint32_t)i);
        for (uint32_t corner = 0; corner < object.corners; corner++)
            sum += *froe_scene_vertex(scene, froe_scene_corner(scene, (uint32_t)i, corner));
        if (object.group != FROE_NONE) sum += froe_scene_group(scene, object.group).name[0];
    }
    uint32_t ends[2];
    for (uint32_t edge = 0; froe_scene_edge(scene, edge, ends); edge++) sum += *froe_scene_vertex(scene, ends[1]);
    if (froe_scene_bounds(scene, lo, hi)) sum += lo[0] + hi[froe_scene_dim(scene) - 1];
    volatile double used = sum;
    (void)used;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char path[256];
    froe_tree *tree;
    froe_diagnostic why;
    fuzz_file("", ".froe", data, size, path, sizeof path);
    if (froe_tree_open(path, NULL, &tree, &why) == FROE_OK) {
        const froe_report report = froe_tree_report(tree);
        const froe_scene *scene = froe_tree_scene(tree);
        look_at_scene(scene);
        look_at_nodes(tree, froe_tree_root(tree), &report);
        for (size_t i = 0; i < froe_tree_piece_count(tree); i++) {
            double corners[8 * FROE_MAX_DIM];
            froe_node made[8];
            (void)froe_tree_piece_corners(tree, i, corners, made, 8);
        }
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        size_t seen = 0;
        if (report.dim <= 3 && froe_scene_bounds(scene, lo, hi)) froe_tree_cells(tree, lo, hi, see_cell, &seen, &why);
        (void)froe_tree_audit(tree, NULL, &why); /* a wrong tree with right checksums may open; the audit says so */
        froe_tree_free(tree);
    }
    remove(path);
    return 0;
}
