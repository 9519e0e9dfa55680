/* house.c: read a model, draw it without what is hidden, and find what a line of sight meets. */
#include <froe/io.h>
#include <froe/query.h>
#include <froe/render.h>
#include <math.h>
#include <stdio.h>

static int fail(const froe_diagnostic *why) {
    return fprintf(stderr, "house: %s\n", why->message), 1;
}

int main(void) {
    froe_scene *house = NULL;
    froe_tree *tree = NULL;
    froe_query *query = NULL;
    froe_diagnostic why = {0};

    /* A scene is what a file contains. A tree is built of it once, and serves everything below. */
    froe_build_options build = froe_build_defaults();
    build.purpose = "draw";
    if (froe_read("data/fzk-haus.glb", NULL, &house, NULL, &why) || froe_build(house, &build, &tree, &why))
        return fail(&why);
    printf("%zu triangles\n", froe_scene_object_count(house));

    froe_render_options picture = froe_render_defaults();
    froe_render_report report;
    const double from[] = {3, 2, 5}, up[] = {0, 1, 0}; /* in glTF the axis y points up */
    for (int a = 0; a < 3; a++) picture.camera.eye[a] = from[a], picture.camera.up[a] = up[a];
    picture.camera.height = 600, picture.title = "House";
    if (froe_render(tree, "house.svg", &picture, &report, &why)) return fail(&why);
    printf("house.svg: %g shapes\n", (double)report.picture.shapes);

    const double eye[] = {5, 1.6, 8}, direction[] = {0, 0, -1};
    froe_hit hit;
    if (froe_query_new(tree, &query, &why) || froe_query_ray(query, eye, direction, INFINITY, &hit, &why))
        return fail(&why);
    if (hit.object != FROE_NONE) {
        const uint32_t group = froe_scene_object(house, hit.object).group;
        printf("triangle %u of '%s', %.3f m away\n", hit.object, froe_scene_group(house, group).name, hit.t);
    }
    froe_query_free(query), froe_tree_free(tree), froe_scene_free(house);
}
