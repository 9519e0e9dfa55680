/* windows.c: which fields does a window meet, cover or lie in; and which does a path cross? */
#include <froe/query.h>
#include <stdio.h>

static const char *const names[] = {"meadow", "wood"};

/* Rings or paths as groups: `sizes` segments of each, one after the other. */
static froe_query *ask_groups(const double *ends, const size_t *sizes, uint32_t groups, froe_scene **scene,
                              froe_tree **tree) {
    froe_build_options options = froe_build_defaults();
    froe_query *query = NULL;
    froe_status status = froe_scene_new(2, NULL, scene);
    options.purpose = "query";
    for (uint32_t g = 0; g < groups && !status; ends += 4 * sizes[g++]) {
        froe_objects objects = froe_objects_defaults();
        status = froe_scene_add_group(*scene, &(froe_group){.name = names[g]}, &objects.group);
        objects.kind = FROE_SEGMENT, objects.count = sizes[g], objects.coords = ends;
        if (!status) status = froe_scene_add(*scene, &objects, NULL);
    }
    if (!status) status = froe_build(*scene, &options, tree, NULL);
    if (!status) status = froe_query_new(*tree, &query, NULL);
    if (status) fprintf(stderr, "windows: %s\n", froe_status_name(status));
    return query;
}

static void print(const char *what, froe_relation relation, const uint32_t *ids, size_t count) {
    printf("%s, %s:", what, froe_relation_name(relation));
    for (size_t i = 0; i < count; i++) printf(" %s", names[ids[i]]);
    printf("\n");
}

int main(void) {
    const double fields[] = {0, 0, 8, 0, 8, 0, 8, 8, 8, 8, 0, 8, 0, 8, 0, 0,  /* the meadow, */
                             2, 2, 4, 2, 4, 2, 4, 4, 4, 4, 2, 4, 2, 4, 2, 2,  /* with a pond, */
                             8, 0, 9, 0, 9, 0, 9, 8, 9, 8, 8, 8, 8, 8, 8, 0}; /* and the wood beside it */
    const double path[] = {7, 1, 7, 7, 7, 7, 1, 7};
    froe_scene *land = NULL, *ways = NULL;
    froe_tree *land_tree = NULL, *ways_tree = NULL;
    froe_query *query = ask_groups(fields, (const size_t[]){8, 4}, 2, &land, &land_tree);
    froe_query *asking = ask_groups(path, (const size_t[]){2}, 1, &ways, &ways_tree);
    froe_diagnostic why = {0};
    froe_range window = froe_range_defaults();
    window.points = (const double[]){5, 0, 9, 8};
    for (froe_relation r = 0; query && asking && r < FROE_RELATION_COUNT; r++) {
        froe_list groups;
        froe_answers paths;
        if (froe_query_groups_range(query, &window, r, &groups, &why)) return fprintf(stderr, "%s\n", why.message), 1;
        print("window", r, groups.ids, groups.count);
        if (froe_batch_groups_join(query, asking, r, NULL, &paths, &why))
            return fprintf(stderr, "%s\n", why.message), 1;
        print("path", r, paths.ids, paths.starts[1]);
        froe_answers_free(&paths);
    }
    froe_query_free(query), froe_query_free(asking);
    froe_tree_free(land_tree), froe_tree_free(ways_tree);
    froe_scene_free(land), froe_scene_free(ways);
}
