/* country.c: which countries do these points lie in? */
#include <froe/io.h>
#include <froe/query.h>
#include <stdio.h>

static int fail(const froe_diagnostic *why) {
    return fprintf(stderr, "country: %s\n", why->message), 1;
}

int main(void) {
    const double places[] = {2.35, 48.85, 28, -29.5, -30, 0, 116.4, 39.9};
    froe_scene *map = NULL;
    froe_tree *tree = NULL;
    froe_query *query = NULL;
    froe_answers groups;
    froe_diagnostic why = {0};
    froe_read_options reading = froe_read_defaults();
    froe_build_options options = froe_build_defaults();
    reading.wrap = true; /* borders of Fiji, Russia and Antarctica cross the antimeridian */
    options.purpose = "query";
    if (froe_read("data/countries-110m.json", &reading, &map, NULL, &why) || froe_build(map, &options, &tree, &why) ||
        froe_query_new(tree, &query, &why) || froe_batch_groups(query, places, 4, NULL, &groups, &why))
        return fail(&why);
    for (size_t i = 0; i < groups.queries; i++) {
        printf("%g, %g:", places[2 * i], places[2 * i + 1]);
        for (size_t j = groups.starts[i]; j < groups.starts[i + 1]; j++)
            printf(" %s", froe_scene_group(map, groups.ids[j]).name);
        printf("\n");
    }
    froe_answers_free(&groups);
    froe_query_free(query), froe_tree_free(tree), froe_scene_free(map);
}
