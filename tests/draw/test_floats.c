/* test_floats.c: however the calling thread computes, pictures have the same bytes, the thread computes so
 * afterwards, and so do the callbacks. (conformance/test_floats.c has everything else.) */
#include "support/floats_tree.h"
#include <froe/draw.h>

static void partitions(floats_run *r, void *user) {
    static const struct {
        int dim;
        double size;
        froe_draw_style style;
    } scenes[] = {
        {2, 1, FROE_DRAW_AUTO}, {2, 0x1p-1050, FROE_DRAW_AUTO}, {3, 1, FROE_DRAW_SECTIONS}, {3, 1, FROE_DRAW_EXPLODED}};
    const froe_allocator memory = {floats_memory, r};
    (void)user;
    for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++)
        for (int format = 0; format < FROE_DRAW_FORMAT_COUNT; format++) {
            froe_scene *scene;
            froe_tree *tree = floats_tree(r, scenes[k].dim, scenes[k].size, &scene);
            froe_draw_options o = froe_draw_defaults();
            o.alloc = &memory;
            o.progress = floats_progress;
            o.user = r;
            o.style = scenes[k].style;
            if (format != FROE_DRAW_PDF)
                ASK(r, froe_draw_write(tree, (froe_draw_format)format, floats_bytes, r, &o, NULL));
            if (!ASK(r, froe_draw(tree, "floats.svg", &o, NULL))) floats_note_file(r, "floats.svg");
            froe_tree_free(tree);
            froe_scene_free(scene);
        }
}

static void pictures_of_partitions_have_the_same_bytes(void **state) {
    (void)state;
    floats_compare(partitions, NULL);
}

static void renderings(floats_run *r, void *user) {
    const froe_allocator memory = {floats_memory, r};
    froe_render_options o = froe_render_defaults();
    froe_scene *scene;
    froe_tree *tree = floats_tree(r, 3, 1, &scene);
    (void)user;
    o.alloc = &memory;
    o.progress = floats_progress;
    o.user = r;
    MUST(r, froe_render_png(tree, "floats.png", &o, NULL, NULL));
    floats_note_file(r, "floats.png");
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void renderings_have_the_same_bytes(void **state) {
    (void)state;
    floats_compare(renderings, NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_of_partitions_have_the_same_bytes),
        cmocka_unit_test(renderings_have_the_same_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
