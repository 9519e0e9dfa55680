/* sight.c: what a ray meets in a room, what is nearest, and which walls meet without sharing a corner. */
#include <froe/query.h>
#include <stdio.h>

static bool print_pair(void *user, const froe_pair *pair) {
    static const char *const kinds[] = {"cross", "touch", "overlap"};
    (void)user;
    return printf("walls %u and %u %s\n", pair->a, pair->b, kinds[pair->kind]) > 0;
}

int main(void) {
    const double walls[] = {0, 0, 8, 0, 8, 0, 8, 6, 8, 6, 0, 6, 0, 6, 0, 0, 4, 1, 4, 5, 2, 3, 6, 3};
    const double eye[] = {1, 2}, ahead[] = {2, 1};
    froe_objects objects = froe_objects_defaults();
    objects.kind = FROE_SEGMENT, objects.count = 6, objects.coords = walls;
    froe_build_options options = froe_build_defaults();
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_query *query = NULL;
    froe_diagnostic why = {0};
    froe_hits hits;
    froe_neighbours near;
    uint32_t above;
    if (froe_scene_new(2, NULL, &scene) || froe_scene_add(scene, &objects, &why) ||
        froe_build(scene, &options, &tree, &why) || froe_query_new(tree, &query, &why))
        return fprintf(stderr, "sight: %s\n", why.message), 1;
    if (froe_query_ray_all(query, eye, ahead, 10, &hits, &why)) return fprintf(stderr, "sight: %s\n", why.message), 1;
    for (size_t i = 0; i < hits.count; i++) printf("wall %u at t = %g\n", hits.hits[i].object, hits.hits[i].t);
    if (froe_query_vertical(query, eye, 1, &above, &why)) return fprintf(stderr, "sight: %s\n", why.message), 1;
    printf("wall %u above\n", above);
    if (froe_query_near(query, eye, 2, 1.5, &near, &why)) return fprintf(stderr, "sight: %s\n", why.message), 1;
    for (size_t i = 0; i < near.count; i++)
        printf("wall %u is %g away\n", near.items[i].object, near.items[i].distance);
    if (froe_query_pairs(query, false, print_pair, NULL, &why)) return fprintf(stderr, "sight: %s\n", why.message), 1;
    froe_query_free(query), froe_tree_free(tree), froe_scene_free(scene);
}
