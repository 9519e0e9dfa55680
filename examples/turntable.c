/* turntable.c: eight pictures from all around a stool, at one scale. */
#include <froe/render.h>
#include <stdio.h>

enum { FRAMES = 8 };

int main(void) {
    const double quads[] = {0,   0,   3, 4,   0,   3, 4,   4,   3, 0,   4,   3,  /* the seat */
                            0.5, 0.5, 0, 3.5, 3.5, 0, 3.5, 3.5, 3, 0.5, 0.5, 3,  /* two legs, */
                            3.5, 0.5, 0, 0.5, 3.5, 0, 0.5, 3.5, 3, 3.5, 0.5, 3}; /* crossing */
    const size_t starts[] = {0, 4, 8, 12};
    froe_objects objects = froe_objects_defaults();
    objects.count = 3, objects.coords = quads, objects.starts = starts;
    froe_build_options build = froe_build_defaults();
    froe_render_options options = froe_render_defaults();
    froe_camera cameras[FRAMES];
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_diagnostic why = {0};
    if (froe_scene_new(3, NULL, &scene) || froe_scene_add(scene, &objects, &why) ||
        froe_build(scene, &build, &tree, &why) || froe_camera_turn(&options.camera, scene, FRAMES, cameras, &why))
        return fprintf(stderr, "turntable: %s\n", why.message), 1;
    for (int i = 0; i < FRAMES; i++) {
        char path[32];
        froe_render_report report;
        snprintf(path, sizeof path, "stool-%d.svg", i);
        options.camera = cameras[i];
        if (froe_render(tree, path, &options, &report, &why)) return fprintf(stderr, "turntable: %s\n", why.message), 1;
        printf("%s: %g faces\n", path, (double)report.picture.shapes);
    }
    froe_tree_free(tree), froe_scene_free(scene);
}
