/* window.c: which walls of a room meet a window, a disc and a point; and many points at once. */
#include <froe/query.h>
#include <stdio.h>

static void print(const char *what, const uint32_t *ids, size_t count) {
    printf("%s:", what);
    for (size_t i = 0; i < count; i++) printf(" %u", ids[i]);
    printf("\n");
}

int main(void) {
    const double walls[] = {0, 0, 8, 0, 8, 0, 8, 6, 8, 6, 0, 6, 0, 6, 0, 0, 4, 1, 4, 5, 2, 3, 6, 3};
    const double window[] = {5, 2, 9, 4}, centre[] = {3, 5}, points[] = {4, 3, 0, 0, 1, 1};
    froe_objects objects = froe_objects_defaults();
    objects.kind = FROE_SEGMENT, objects.count = 6, objects.coords = walls;
    froe_build_options options = froe_build_defaults();
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_query *query = NULL;
    froe_diagnostic why = {0};
    if (froe_scene_new(2, NULL, &scene) || froe_scene_add(scene, &objects, &why) ||
        froe_build(scene, &options, &tree, &why) || froe_query_new(tree, &query, &why))
        return fprintf(stderr, "window: %s\n", why.message), 1;

    froe_range box = froe_range_defaults(), disc = froe_range_defaults();
    box.points = window;
    disc.shape = FROE_SHAPE_BALL, disc.points = centre, disc.radius = 1;
    froe_list found;
    if (froe_query_range(query, &box, &found, &why)) return fprintf(stderr, "window: %s\n", why.message), 1;
    print("window", found.ids, found.count);
    if (froe_query_range(query, &disc, &found, &why)) return fprintf(stderr, "window: %s\n", why.message), 1;
    print("disc", found.ids, found.count);

    froe_answers answers;
    if (froe_batch_locate(query, points, 3, NULL, &answers, &why))
        return fprintf(stderr, "window: %s\n", why.message), 1;
    for (size_t i = 0; i < answers.queries; i++)
        print("point", answers.ids + answers.starts[i], answers.starts[i + 1] - answers.starts[i]);
    froe_answers_free(&answers);
    froe_query_free(query), froe_tree_free(tree), froe_scene_free(scene);
}
