/* alone.c: processor seconds that froe takes for the lines of a mesh, without reading and writing: tree, visibility and
 * lines. The mesh is seen along -z, as by `bench/parts/lines`.
 *
 *     bench_lines_alone MESH.off */
#include "bench.h"
#include <froe/render.h>
#include <stdio.h>

static bool count_line(void *user, const froe_stroke *line) {
    *(size_t *)user += line->count;
    return true;
}

int main(int argc, char **argv) {
    froe_diagnostic why = {.message = ""};
    froe_render_options o = froe_render_defaults();
    size_t points = 0;
    if (argc != 2) return 2;
    froe_scene *scene = bench_read(argv[1]);
    o.lines = FROE_LINE_BORDER | FROE_LINE_SILHOUETTE | FROE_LINE_CREASE;
    o.camera = froe_camera_defaults();
    o.camera.parallel = true, o.camera.fit = false, o.camera.scale = 1;
    for (int k = 0; k < 3; k++) o.camera.eye[k] = k == 2, o.camera.target[k] = 0, o.camera.up[k] = k == 1;
    const double start = bench_cpu();
    froe_tree *tree;
    froe_build_options build = froe_build_defaults();
    build.purpose = "draw", build.threads = 1;
    bench_must(froe_build(scene, &build, &tree, &why), &why);
    bench_must(froe_render_lines(tree, count_line, &points, &o, NULL, &why), &why);
    printf("%.4f\n", bench_cpu() - start);
    froe_tree_free(tree), froe_scene_free(scene);
}
