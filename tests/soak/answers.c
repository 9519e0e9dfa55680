/* answers.c: every question to small trees by all methods, against brute force in whole numbers and rationals: of
 * scattered objects of all kinds, on lattices and off, of scenes of every scale at once, and of parts of real ones. */
#include "query/answers.h"
#include "soak.h"

enum { ROUNDS = 12, PART = 40 };

/* Some objects of a file, one after the other. */
static froe_scene *answers_part(fuzz_source *r) {
    static const char *const files[] = {"freedoom-e1m1.geojson", "countries-110m.json", "utah-teapot.obj",
                                        "fzk-haus-boxes.csv"};
    froe_scene *whole = world_read(files[fuzz_int(r, 0, 3)]), *part;
    const uint32_t count = (uint32_t)froe_scene_object_count(whole);
    const uint32_t first = base_below(fuzz_bits(r), count > PART ? count - PART : 1);
    const size_t dim = (size_t)froe_scene_dim(whole);
    assert_int_equal(froe_scene_new((int)dim, NULL, &part), FROE_OK);
    for (uint32_t i = first; i < first + PART && i < count; i++) {
        const froe_object o = froe_scene_object(whole, i);
        const size_t starts[2] = {0, o.corners};
        double coords[8 * 3];
        for (uint32_t c = 0; c < o.corners && c < 8; c++)
            memcpy(coords + c * dim, froe_scene_vertex(whole, froe_scene_corner(whole, i, c)), dim * sizeof *coords);
        const bool runs = o.form == FROE_HULL || o.form == FROE_POLYGON;
        if (o.corners <= 8) assert_int_equal(trees_add(part, o.form, 1, coords, NULL, runs ? starts : NULL), FROE_OK);
    }
    froe_scene_free(whole);
    return part;
}

static froe_scene *answers_scene(fuzz_source *r, bool *extreme) {
    enum { FLAT = 1 << FROE_POINT | 1 << FROE_SEGMENT | 1 << FROE_BOX | 1 << FROE_BALL | 1 << FROE_HULL };
    static const unsigned kinds[] = {1 << FROE_SEGMENT, FLAT, 1 << FROE_POINT | 1 << FROE_SEGMENT, 1 << FROE_BOX};
    const int way = fuzz_int(r, 0, 7), dim = fuzz_int(r, 0, 9) ? 2 + fuzz_int(r, 0, 1) : 4;
    const unsigned any = kinds[fuzz_int(r, 0, 3)] | (dim == 3 ? 1u << FROE_POLYGON : 0);
    const unsigned mask = dim == 4 ? 1 << FROE_POINT | 1 << FROE_BOX | 1 << FROE_BALL : any;
    *extreme = way == 1;
    if (way == 0) return answers_part(r);
    if (*extreme) return extreme_scene_new(dim, mask, 8, fuzz_bits(r));
    const uint32_t grid = way % 2 ? 0 : (uint32_t)(1 + fuzz_int(r, 1, 11));
    return world_mixture(dim, mask, (size_t)fuzz_int(r, 1, 12), grid, 0.1 * fuzz_int(r, 1, 8), fuzz_bits(r));
}

void soak_answers(soak_block *block) {
    fuzz_source r = {base_hash(block->seed, 3, 0)};
    bool extreme;
    froe_scene *scene = answers_scene(&r, &extreme);
    for (size_t i = 0; froe_method_at(i); i++) {
        const uint32_t leaf = (uint32_t)fuzz_int(&r, 0, 6);
        froe_build_options o = froe_build_defaults();
        froe_tree *tree;
        froe_diagnostic diag;
        char why[SOAK_WORDS / 2];
        o.method = froe_method_at(i)->name, o.leaf = leaf, o.threads = 1, o.max_fragments = 40000;
        if (froe_build(scene, &o, &tree, &diag)) continue;
        if (!answers_judge(tree, extreme, block->seed, ROUNDS, &block->decisions, why, sizeof why))
            soak_complain(block, "%s: %s", o.method, why);
        if (froe_tree_audit(tree, NULL, &diag)) soak_complain(block, "%s: %s", o.method, diag.message);
        block->decisions++;
        froe_tree_free(tree);
    }
    froe_scene_free(scene);
}
