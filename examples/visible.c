/* visible.c: two crossing panes and a wall behind them: which part of each does an eye see? */
#include <froe/view.h>
#include <stdio.h>

static bool print_region(void *user, uint32_t patch, const double *coords, const size_t *starts, size_t rings) {
    (void)user;
    for (size_t r = 0; r < rings; r++) {
        printf("face %u:", patch);
        for (size_t i = starts[r]; i < starts[r + 1]; i++)
            printf(" (%g, %g, %g)", coords[3 * i], coords[3 * i + 1], coords[3 * i + 2]);
        printf("\n");
    }
    return true;
}

int main(void) {
    const double quads[] = {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0,  /* the wall, z = 0 */
                            1, 1, 1, 3, 1, 3, 3, 3, 3, 1, 3, 1,  /* a pane that leans */
                            1, 1, 3, 3, 1, 1, 3, 3, 1, 1, 3, 3}; /* another, through it */
    const size_t starts[] = {0, 4, 8, 12};
    froe_objects objects = froe_objects_defaults();
    objects.count = 3, objects.coords = quads, objects.starts = starts;
    froe_build_options build = froe_build_defaults();
    froe_visibility_options look = froe_visibility_defaults();
    look.eye = (froe_eye){.at = {0, 0, 1}, .parallel = true}; /* from above */
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_surface *surface = NULL;
    froe_visibility *seen = NULL;
    froe_diagnostic why = {0};
    if (froe_scene_new(3, NULL, &scene) || froe_scene_add(scene, &objects, &why) ||
        froe_build(scene, &build, &tree, &why) || froe_surface_new(scene, NULL, &surface, &why) ||
        froe_visibility_new(tree, surface, &look, &seen, &why) ||
        froe_visibility_regions(seen, 0, UINT32_MAX, print_region, NULL, &why))
        return fprintf(stderr, "visible: %s\n", why.message), 1;
    froe_visibility_free(seen), froe_surface_free(surface), froe_tree_free(tree), froe_scene_free(scene);
}
