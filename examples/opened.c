/* opened.c: what meets a window, of a tree that froe build saved; only what the window comes to is read. */
#include <froe/query.h>
#include <stdio.h>

int main(void) {
    const double window[] = {5, 45, 8, 48};
    froe_range box = froe_range_defaults();
    froe_tree *tree = NULL;
    froe_query *query = NULL;
    froe_list found;
    froe_diagnostic why = {0};
    box.points = window;
    if (froe_tree_open("countries.froe", NULL, &tree, &why) || froe_query_new(tree, &query, &why) ||
        froe_query_range(query, &box, &found, &why))
        return fprintf(stderr, "opened: %s\n", why.message), 1;
    printf("%zu of %zu objects\n", found.count, froe_scene_object_count(froe_tree_scene(tree)));
    if (froe_tree_check(tree, &why)) return fprintf(stderr, "opened: %s\n", why.message), 1; /* now all is read */
    froe_query_free(query), froe_tree_free(tree);
}
