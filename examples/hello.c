/* hello.c: a room of four walls and two more that cross: partition it, prove it right, print it. */
#include <froe/froe.h>
#include <stdio.h>

int main(void) {
    const double walls[] = {0, 0, 8, 0, 8, 0, 8, 6, 8, 6, 0, 6, 0, 6, 0, 0, 4, 1, 4, 5, 2, 3, 6, 3};
    froe_objects objects = froe_objects_defaults();
    objects.kind = FROE_SEGMENT, objects.count = 6, objects.coords = walls;
    froe_build_options options = froe_build_defaults();
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_diagnostic why = {0};
    if (froe_scene_new(2, NULL, &scene) || froe_scene_add(scene, &objects, &why) ||
        froe_build(scene, &options, &tree, &why) || froe_tree_audit(tree, NULL, &why))
        return fprintf(stderr, "hello: %s\n", why.message), 1;
    for (size_t i = 0; i < froe_tree_piece_count(tree); i++) {
        double p[2][2];
        froe_tree_piece_corners(tree, i, p[0], NULL, 2);
        printf("wall %u: (%g, %g) to (%g, %g)\n", froe_tree_piece(tree, i).object, p[0][0], p[0][1], p[1][0], p[1][1]);
    }
    froe_report report = froe_tree_report(tree);
    printf("%g pieces, height %g, audited\n", (double)report.fragments, (double)report.height);
    froe_tree_free(tree), froe_scene_free(scene);
}
