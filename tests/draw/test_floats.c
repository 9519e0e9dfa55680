/* test_floats.c: however the calling thread computes, pictures have the same bytes, the thread computes so
 * afterwards, and so do the callbacks. (conformance/test_floats.c has everything else.) */
#include "support/settings.h"
#include <froe/plot.h>

/** Segments of the plane or triangles in space, strewn by a multiplication, in a cube of that size. */
static froe_tree *tree_of(floats_run *r, int dim, double size, froe_scene **scene) {
    enum { OBJECTS = 25, MOST = OBJECTS * 9 };
    froe_build_options b = froe_build_defaults();
    froe_objects o = froe_objects_defaults();
    double coords[MOST];
    froe_tree *tree;
    for (uint32_t i = 0; i < MOST; i++) {
        const double centre = (i / (uint32_t)(dim * dim) * 2654435761u >> (3 * i % 9)) % 1000;
        coords[i] = (centre + (i * 40503u >> 4) % 300) * size / 1000;
    }
    o.kind = dim == 2 ? FROE_SEGMENT : FROE_POLYGON;
    o.count = OBJECTS;
    o.coords = coords;
    b.purpose = "draw";
    MUST(r, froe_scene_new(dim, NULL, scene));
    MUST(r, froe_scene_add(*scene, &o, NULL));
    MUST(r, froe_build(*scene, &b, &tree, NULL));
    return tree;
}

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
            froe_tree *tree = tree_of(r, scenes[k].dim, scenes[k].size, &scene);
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
    static const char *const files[] = {"floats.svg", "floats.png"};
    const froe_allocator memory = {floats_memory, r};
    froe_render_options o = froe_render_defaults();
    froe_camera cameras[2];
    froe_scene *scene;
    froe_tree *tree = tree_of(r, 3, 1, &scene);
    (void)user;
    o.alloc = &memory;
    o.progress = floats_progress;
    o.user = r;
    for (size_t f = 0; f < 2; f++) {
        MUST(r, (f ? froe_render_png : froe_render)(tree, files[f], &o, NULL, NULL));
        floats_note_file(r, files[f]);
    }
    MUST(r, froe_camera_turn(&o.camera, scene, 2, cameras, NULL));
    MUST(r, froe_render_animation(tree, files[0], &o, cameras, 2, 3, NULL, NULL));
    floats_note_file(r, files[0]);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void renderings_have_the_same_bytes(void **state) {
    (void)state;
    floats_compare(renderings, NULL);
}

static void plots(floats_run *r, void *user) {
    static const double x[] = {1, 10, 1000, 0x1p-1060}, y[] = {0.1, 0.3, 7, 0x1p-1070};
    const froe_plot_series series = {.name = "a", .x = x, .y = y, .count = 4};
    const froe_allocator memory = {floats_memory, r};
    froe_plot_options o = froe_plot_defaults();
    (void)user;
    o.log_x = o.log_y = true;
    o.alloc = &memory;
    MUST(r, froe_plot_write(&series, 1, floats_bytes, r, &o, NULL));
}

static void plots_have_the_same_bytes(void **state) {
    (void)state;
    floats_compare(plots, NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_of_partitions_have_the_same_bytes),
        cmocka_unit_test(renderings_have_the_same_bytes),
        cmocka_unit_test(plots_have_the_same_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
