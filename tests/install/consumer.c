/* consumer.c: a user's program. It has functions that are called as internal ones of
 * the library are; the library must neither see them nor clash with them. */
#include <froe/formats.h>
#include <froe/froe.h>
#include <froe/query.h>
#include <froe/render.h>
#include <froe/view.h>
#include <stdio.h>

void *support_realloc(void);
void *support_realloc(void) {
    return NULL;
}
int support_array_grow(int x);
int support_array_grow(int x) {
    return x + 1;
}

static bool count_bytes(void *user, const void *bytes, size_t count) {
    *(size_t *)user += bytes ? count : 0;
    return true;
}

/* A picture is made without any other library. */
static int render(froe_render_format format) {
    const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 1};
    size_t bytes = 0;
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_objects objects = froe_objects_defaults();
    objects.count = 1;
    objects.coords = corners;
    const int failed = froe_scene_new(3, NULL, &scene) || froe_scene_add(scene, &objects, NULL) ||
                       froe_build(scene, NULL, &tree, NULL) ||
                       froe_render_write(tree, format, count_bytes, &bytes, NULL, NULL, NULL);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return failed || bytes < 200;
}

int main(void) {
    const double corners[] = {0, 0, 1, 1, 1, 0, 0, 1};
    froe_scene *scene = NULL;
    froe_objects objects = froe_objects_defaults();
    objects.kind = FROE_SEGMENT;
    objects.count = 2;
    objects.coords = corners;
    if (froe_scene_new(2, NULL, &scene) || froe_scene_add(scene, &objects, NULL)) return 1;
    if (froe_scene_object_count(scene) != 2 || froe_scene_vertex_count(scene) != 4) return 2;
    froe_scene_free(scene);
    FILE *file = fopen("consumer.csv", "w"); /* a file is read without any other library */
    if (!file || fputs("x,y\n1,2\n3,4\n", file) < 0 || fclose(file)) return 4;
    if (froe_read_own("consumer.csv", NULL, &scene, NULL, NULL) || froe_scene_object_count(scene) != 2) return 5;
    froe_scene_free(scene);
    remove("consumer.csv");
    if (render(FROE_RENDER_SVG) || render(FROE_RENDER_PDF) || render(FROE_RENDER_EPS)) return 6;
    if (support_realloc() || support_array_grow(1) != 2) return 3;
    puts(froe_version());
    return 0;
}
