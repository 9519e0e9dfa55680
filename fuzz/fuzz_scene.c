/* fuzz_scene.c: bytes as a program that fills a scene and builds trees of it. Whatever
 * the scene, a build succeeds and passes the audit, or it is refused with a sentence. */
#include "ask.h"
#include "base/random.h"
#include "look.h"
#include <froe/froe.h>
#include <stdio.h>
#include <string.h>

/* Options of the method within their ranges, at an end of one, or as they are, by bits of the seed. */
static void draw_settings(const char *method, uint64_t seed, char *out, size_t size) {
    size_t i = 0, length = 0;
    *out = '\0';
    while (froe_method_at(i) && strcmp(froe_method_at(i)->name, method) != 0) i++;
    const froe_method_info *m = froe_method_at(i);
    for (const froe_option_info *o = m ? m->options : NULL; o && o->name && length < size; o++) {
        const uint64_t bits = base_hash(seed, 2, (uint64_t)(o - m->options));
        const double share = (double)(bits >> 40) / 0x1p24, hi = o->hi < 1e6 ? o->hi : 1e6;
        double value = bits % 4 ? o->lo + share * (hi - o->lo) : bits & 4 ? o->lo : hi;
        if (o->choices || o->whole) value = (double)(int64_t)value;
        if (bits & 8) continue;
        length += (size_t)(o->choices ? snprintf(out + length, size - length, "%s=%s ", o->name, o->choices[(int)value])
                                      : snprintf(out + length, size - length, "%s=%.17g ", o->name, value));
    }
    if (length >= size) *out = '\0';
}

static void build_and_audit(froe_scene *scene, fuzz_bytes *bytes) {
    froe_build_options b = froe_build_defaults();
    size_t methods = 0;
    while (froe_method_at(methods)) methods++;
    const uint8_t which = fuzz_byte(bytes);
    if (methods && which % 4) b.method = froe_method_at(which % methods)->name;
    b.leaf = fuzz_byte(bytes) % 4;
    b.seed = fuzz_byte(bytes);
    char settings[400];
    if (b.seed & 0x80) draw_settings(b.method, b.seed, settings, sizeof settings), b.settings = settings;
    b.threads = 1 + fuzz_byte(bytes) % 2;
    b.max_fragments = 20000;
    froe_tree *tree;
    froe_diagnostic why;
    if (froe_build(scene, &b, &tree, &why)) return;
    if (froe_tree_audit(tree, NULL, &why)) fuzz_complain("audit", &why);
    look(tree, true, bytes);
    ask(tree, true, bytes);
    froe_tree_free(tree);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes bytes = {data, size};
    const uint8_t d = fuzz_byte(&bytes);
    const int dim = d < 0x60 ? 2 : d < 0xc0 ? 3 : 2 + d % 7;
    froe_scene *scene;
    if (froe_scene_new(dim, NULL, &scene)) return 0;
    for (int batches = 1 + fuzz_byte(&bytes) % 3; batches; batches--) fuzz_add_batch(scene, &bytes);
    froe_defects defects = {.size = sizeof defects};
    froe_diagnostic why;
    (void)froe_scene_defects(scene, 1, NULL, NULL, &defects, &why);
    build_and_audit(scene, &bytes);
    froe_scene_free(scene);
    return 0;
}
