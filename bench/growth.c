/* growth.c: how size and time of a density tree grow with n: exponents fitted on a log-log scale.
 *
 *     bench_growth [KIND [LARGEST [LEAF]]]     default: boxes of triangles, up to 10^6, leaf 1
 *
 * de Berg, theorem 2.5: linear size on uncluttered scenes. */
#include "bench.h"
#include <stdio.h>
#include <stdlib.h>

int main(int argc, char **argv) {
    const char *kind = argc > 1 ? argv[1] : "box-triangles";
    size_t largest = argc > 2 ? strtoull(argv[2], NULL, 10) : 1000000, used = 0;
    uint32_t leaf = argc > 3 ? (uint32_t)strtoul(argv[3], NULL, 10) : 1;
    double n[32], size[32], seconds[32];
    bench_head("growth with n, density, one thread", 1);
    printf("%-16s %9s %9s %7s %9s %9s\n", "scene", "n", "pieces/n", "height", "size/n", "us/n");
    for (size_t want = 1000; want <= largest && used < 32; want = want * 316 / 100) {
        froe_scene *scene = bench_generate(kind, want, 1);
        froe_tree *tree = bench_build(scene, "density", NULL, leaf, 1, &seconds[used]);
        froe_report r = froe_tree_report(tree);
        double objects = (double)r.objects;
        printf("%-16s %9.0f %9.3f %7llu %9.3f %9.3f\n", kind, objects, (double)r.fragments / objects,
               (unsigned long long)r.height, (double)r.size / objects, 1e6 * seconds[used] / objects);
        fflush(stdout);
        if (objects >= 9000) n[used] = objects, size[used] = (double)r.size, used++;
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
    if (used > 1)
        printf("from 10^4 up: size grows as n^%.3f, time as n^%.3f\n", bench_exponent(n, size, used),
               bench_exponent(n, seconds, used));
    return 0;
}
