/* pictures.c: pictures of made and real scenes from nine eyes, against rays in doubles: what is painted at each sample
 * of a page, layers that one sees through, and points of edges. Hard are those that the oracle leaves open: ties. */
#include "oracle/views.h"
#include "soak.h"
#include "support/fuzz.h"
#include <froe/io.h>
#include <stdio.h>
#include <stdlib.h>

static void pictures_must(soak_block *block, froe_status status, const froe_diagnostic *why) {
    if (!status) return;
    fprintf(stderr, "seed %llu: %s\n", (unsigned long long)block->seed, why->message);
    abort();
}

enum { MOST_PIECES = 50000 }; /* 1024 slats that all cross have more, and a picture of them takes many minutes */

/* One kind in six is a file. */
static froe_scene *pictures_scene(soak_block *block, fuzz_source *r, char *name, size_t room) {
    static const char *const files[] = {"utah-teapot.obj", "bracket.off", "fzk-haus.glb", "robot.gltf"};
    froe_scene *scene = NULL;
    froe_diagnostic why = {0};
    if (fuzz_int(r, 0, 5) == 0) {
        snprintf(name, room, "%s/%s", FROE_TEST_DATA, files[fuzz_int(r, 0, 3)]);
        pictures_must(block, froe_read(name, NULL, &scene, NULL, &why), &why);
        return scene;
    }
    size_t count = 0;
    while (froe_generator_at(count)) count++;
    for (;;) {
        const froe_generator_info *kind = froe_generator_at(base_below(fuzz_bits(r), (uint32_t)count));
        if (kind->dim != 3 || kind->kind != FROE_POLYGON) continue;
        if (strstr(kind->name, "huge") || strstr(kind->name, "denormal")) continue; /* beyond the oracle's doubles */
        const size_t n = (size_t)1 << fuzz_int(r, 3, 10);
        snprintf(name, room, "%s of %zu", kind->name, n);
        pictures_must(block, froe_generate(kind->name, n, fuzz_bits(r), NULL, &scene, &why), &why);
        return scene;
    }
}

void soak_pictures(soak_block *block) {
    fuzz_source r = {base_hash(block->seed, 4, 0)};
    char name[300];
    froe_scene *scene = pictures_scene(block, &r, name, sizeof name);
    froe_build_options o = froe_build_defaults();
    froe_diagnostic why = {0};
    froe_tree *tree;
    froe_surface *surface;
    o.max_fragments = MOST_PIECES;
    const froe_status built = froe_build(scene, &o, &tree, &why);
    if (built == FROE_E_BUDGET) {
        froe_scene_free(scene);
        return;
    }
    pictures_must(block, built, &why);
    pictures_must(block, froe_surface_new(scene, NULL, &surface, &why), &why);
    const bool layers = fuzz_int(&r, 0, 3) == 0;
    const oracle_task task = {.tree = tree,
                              .surface = surface,
                              .samples = 400,
                              .underlap = layers ? 0 : 1,
                              .clear = layers ? 3 : 0,
                              .edge_step = layers ? 0 : 1};
    const unsigned first = (unsigned)fuzz_int(&r, 0, 2);
    for (unsigned view = first; view < ORACLE_VIEWS; view += 3) {
        oracle_report sum = {.shapes = 0};
        pictures_must(block, oracle_check_view(&task, view, &sum, &why), &why);
        block->decisions += sum.faces.samples + sum.lines.visible + sum.lines.hidden + sum.lines.wrong;
        block->hard += sum.faces.ties + sum.lines.doubtful;
        if (sum.faces.wrong || sum.lines.wrong)
            soak_complain(block, "%s, view %u: %d samples, %d points of edges", name, view, (int)sum.faces.wrong,
                          (int)sum.lines.wrong);
    }
    froe_surface_free(surface);
    froe_tree_free(tree);
    froe_scene_free(scene);
}
