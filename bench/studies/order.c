/* order.c: depth orders a second, one thread.
 *
 *     bench_order SCENE...
 *
 * Alone: froe_tree_order for one eye after the other, with a visitor that counts. Together: froe_tree_orders for 256
 * eyes on a circle. The tree is built with its defaults for drawing. */
#include "bench.h"
#include <froe/view.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { EYES = 256, CIRCLE = 32 };

/** On a circle about the middle of the scene, two diagonals away; by halving chords, as no sine is needed. */
static void circle(const froe_scene *scene, froe_eye *eyes) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], diagonal = 0;
    if (!froe_scene_bounds(scene, lo, hi)) exit(1);
    for (int k = 0; k < 3; k++) diagonal += (hi[k] - lo[k]) * (hi[k] - lo[k]);
    for (int e = 0; e < EYES; e++) {
        const double angle = 2 * acos(-1.0) * e / EYES, reach = 2 * sqrt(diagonal);
        const double way[3] = {cos(angle), 0.4 + 0.3 * (e % CIRCLE) / CIRCLE, sin(angle)};
        for (int k = 0; k < 3; k++) eyes[e].at[k] = 0.5 * (lo[k] + hi[k]) + reach * way[k];
        eyes[e].parallel = false;
    }
}

static bool count_one(void *user, size_t piece) {
    *(size_t *)user += piece < SIZE_MAX;
    return true;
}

int main(int argc, char **argv) {
    bench_head("depth orders from 256 eyes, one thread", 1);
    printf("%-16s %8s %9s %9s %14s %14s\n", "scene", "objects", "nodes", "pieces", "alone /s", "together /s");
    for (int i = 1; i < argc; i++) {
        char name[32];
        froe_eye eyes[EYES];
        size_t seen = 0;
        froe_scene *scene = bench_read(argv[i]);
        bench_name(argv[i], name);
        froe_tree *tree = bench_build(scene, "auto", NULL, 1, 1, NULL);
        const froe_report r = froe_tree_report(tree);
        circle(scene, eyes);
        froe_order_options o = froe_order_defaults();
        o.threads = 1;
        double start = bench_cpu();
        for (int e = 0; e < EYES; e++)
            if (froe_tree_order(tree, eyes + e, &o, count_one, &seen, NULL)) return 1;
        const double alone = bench_cpu() - start;
        uint32_t *pieces = malloc(EYES * froe_tree_piece_count(tree) * sizeof *pieces);
        if (!pieces || seen != EYES * froe_tree_piece_count(tree)) return 1;
        start = bench_cpu();
        if (froe_tree_orders(tree, eyes, EYES, &o, pieces, NULL)) return 1;
        const double together = bench_cpu() - start;
        printf("%-16s %8.0f %9.0f %9.0f %14.0f %14.0f\n", name, (double)r.objects, (double)r.nodes, (double)r.fragments,
               EYES / alone, EYES / together);
        free(pieces);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
    return 0;
}
