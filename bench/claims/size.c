/* claims_size.c: what the sources say of the size and height of partitions, and of the time to build them. */
#include "build/options.h"
#include "claims.h"
#include <froe/measure.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --------------------------------------------------------------------- growth -- */

typedef double value_fn(const claims_tree *t);

static double size(const claims_tree *t) {
    return (double)t->report.size;
}
static double pieces(const claims_tree *t) {
    return (double)t->report.fragments;
}
static double height(const claims_tree *t) {
    return (double)t->report.height;
}
static double seconds_per_n_log_n(const claims_tree *t) {
    const double n = (double)t->report.objects;
    return t->seconds / (n * log(n));
}
static double seconds_per_n_log2_n(const claims_tree *t) {
    const double n = (double)t->report.objects;
    return t->seconds / (n * log(n) * log(n));
}

/* Exponent of a value in n, for n doubled so many times. */
static double growth(const char *kind, size_t from, int doublings, const char *method, const char *settings,
                     uint32_t leaf, value_fn *fn) {
    claims_series s = {.count = 0};
    for (int i = 0; i <= doublings; i++) {
        claims_tree t = claims_build(kind, from << i, method, settings, leaf);
        claims_add(&s, (double)t.report.objects, fn(&t));
        claims_free(&t);
    }
    return claims_slope(&s);
}

/* The greatest exponent over kinds of scenes, ended by NULL. */
static double worst_growth(const char *const *kinds, size_t from, int doublings, const char *method, value_fn *fn) {
    double worst = -INFINITY;
    for (; *kinds; kinds++) worst = fmax(worst, growth(*kinds, from, doublings, method, NULL, FROE_LEAF_OWN, fn));
    return worst;
}

/* Exponent of the height in log n, from 1,000 objects on. */
static double height_in_log_n(const char *kind, int doublings, const char *method, uint32_t leaf) {
    claims_series s = {.count = 0};
    for (int i = 0; i <= doublings; i++) {
        claims_tree t = claims_build(kind, (size_t)1000 << i, method, NULL, leaf);
        claims_add(&s, log((double)t.report.objects), height(&t));
        claims_free(&t);
    }
    return claims_slope(&s);
}

/* Time is noisy: the least of three. */
static double time_growth(const char *kind, size_t from, int doublings, const char *method, value_fn *fn) {
    claims_series s = {.count = 0};
    for (int i = 0; i <= doublings; i++) {
        double least = INFINITY, n = 0;
        for (int round = 0; round < 3; round++) {
            claims_tree t = claims_build(kind, from << i, method, NULL, FROE_LEAF_OWN);
            least = fmin(least, fn(&t));
            n = (double)t.report.objects;
            claims_free(&t);
        }
        claims_add(&s, n, least);
    }
    return claims_slope(&s);
}

/* -------------------------------------------------------------------- de Berg -- */

static const char *const uncluttered[] = {"cuboids", "city", "terrain", NULL};

static double linear_size(void) {
    return worst_growth(uncluttered, 2000, 4, "density", size);
}
static double linear_size_in_the_plane(void) {
    static const char *const kinds[] = {"scatter", "rooms", "blocks", NULL};
    return worst_growth(kinds, 4000, 4, "density", size);
}

/* Groups of `each` thin triangles along the lines of two saddles z = x y, one just above the other: between each two
 * lines of one kind and each two of the other no plane has room (after Chazelle). The gap shrinks with n; a fixed one
 * would let few planes separate many. */
static froe_scene *saddles(size_t n, size_t each) {
    const double lines = (double)each / 2, above = 0.25 / (lines * lines), width = 0.05 / (lines * lines);
    double *coords = calloc(9 * n, sizeof *coords);
    for (size_t i = 0; i < n; i++) {
        const double t = ((double)(i % each / 2) + 0.5) / lines, shift = 2 * (double)(i / each);
        const double on_x[9] = {t, 0, 0, t, 1, t, t + width, 0.5, 0.5 * t};
        const double on_y[9] = {0, t, above, 1, t, t + above, 0.5, t + width, 0.5 * t + above};
        for (int k = 0; k < 9; k++) coords[9 * i + k] = (i % 2 ? on_y : on_x)[k] + (k % 3 ? 0 : shift);
    }
    froe_scene *scene = NULL;
    froe_objects o = froe_objects_defaults();
    o.kind = FROE_POLYGON, o.count = n, o.coords = coords;
    if (froe_scene_new(3, NULL, &scene) || froe_scene_add(scene, &o, NULL)) exit(1);
    free(coords);
    return scene;
}

static double saddles_growth(const char *method) {
    claims_series s = {.count = 0};
    for (size_t n = 64; n <= 512; n *= 2) {
        froe_scene *scene = saddles(n, n);
        froe_tree *tree = bench_build(scene, method, NULL, FROE_LEAF_OWN, 1, NULL);
        claims_add(&s, (double)n, (double)froe_tree_report(tree).fragments);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
    return claims_slope(&s);
}
static double saddles_are_quadratic(void) {
    return saddles_growth("density");
}
static double saddles_are_quadratic_for_grain(void) {
    return saddles_growth("grain");
}
static double build_time(void) {
    return fmax(time_growth("scatter", 16000, 4, "density", seconds_per_n_log_n),
                time_growth("clusters", 16000, 4, "density", seconds_per_n_log_n));
}

/* A guard stage of guards down to k; nothing is refined. */
static claims_tree guard_stage(const char *kind, size_t n, int k, const char *form) {
    char settings[100];
    snprintf(settings, sizeof settings, "k=%d form=%s", k, form);
    return claims_build(kind, n, "density", settings, 1 << 30);
}

static const froe_promise *promised(const froe_report *r, const char *name) {
    const froe_promise *p = r->promises;
    while (p && p->name && strcmp(p->name, name) != 0) p++;
    if (!p || !p->name) exit(1);
    return p;
}

static double share_of_promise(const froe_report *r, const char *name) {
    const froe_promise *p = promised(r, name);
    return p->measured / p->promised;
}

static const char *const guarded[] = {"segments",  "clusters", "nested",  "lattice",   "star", "parallel",
                                      "identical", "terrain",  "cuboids", "nested-3d", NULL};

static double guard_leaves(const int *ks, const char *form) {
    double worst = 0;
    for (const char *const *kind = guarded; *kind; kind++)
        for (const int *k = ks; *k >= 0; k++) {
            claims_tree t = guard_stage(*kind, 600, *k, form);
            worst = fmax(worst, share_of_promise(&t.report, "guard_leaves"));
            claims_free(&t);
        }
    return worst;
}
static double guard_leaves_without_guards(void) {
    return guard_leaves((const int[]){0, -1}, "slabs");
}
static double guard_leaves_with_guards(void) {
    return guard_leaves((const int[]){1, 4, 16, 64, -1}, "cross");
}
static double guard_leaves_against_k(void) {
    claims_series s = {.count = 0};
    for (int k = 1; k <= 256; k *= 4) {
        claims_tree t = guard_stage("segments", 20000, k, "cross");
        claims_add(&s, k, promised(&t.report, "guard_leaves")->measured);
        claims_free(&t);
    }
    return claims_slope(&s);
}

static froe_density density_of(const froe_scene *scene) {
    froe_measure_options o = froe_measure_defaults();
    froe_density d = {.upper = 0};
    o.samples = 0;
    froe_measure_density(scene, FROE_SIZE_DIAMETER, &o, &d, NULL);
    return d;
}

/* Lambda at which doubling ends, from the load it promises, over twice the density. */
static double doubling(void) {
    double worst = 0;
    for (const char *const *kind = guarded; *kind; kind++) {
        claims_tree t = claims_build(*kind, 400, "density", "mode=doubling", FROE_LEAF_OWN);
        const double c = t.report.dim == 2 ? 4 : 8, lambda = promised(&t.report, "guard_load")->promised / (1 + c);
        worst = fmax(worst, lambda / (2 * (double)density_of(t.scene).upper));
        claims_free(&t);
    }
    return worst;
}

/* Clutter over c_d lambda. */
static double clutter_is_low_where_density_is(void) {
    double worst = 0;
    for (const char *const *kind = guarded; *kind; kind++) {
        froe_scene *scene = bench_generate(*kind, 400, 1);
        froe_clutter c = {.lower = 0};
        froe_measure_clutter(scene, NULL, &c, NULL);
        worst = fmax(worst, c.lower / ((froe_scene_dim(scene) == 2 ? 4.0 : 8.0) * density_of(scene).upper));
        froe_scene_free(scene);
    }
    return worst;
}

/* ---------------------------------------------------------------------- Sacks -- */

/* Pieces over n + 2 n ln n, the mean over seeds, the worst over scenes. */
static double autopartition_in_the_plane(void) {
    static const char *const kinds[] = {"disjoint", "rooms", "blocks", "parallel", "spiral", NULL};
    double worst = 0;
    for (const char *const *kind = kinds; *kind; kind++) {
        double sum = 0;
        for (unsigned seed = 1; seed <= 5; seed++) {
            froe_scene *scene = bench_generate(*kind, 3000, seed);
            froe_tree *tree = bench_build_by(build_tuned, scene, "autopartition", "free=no", 0, 1, NULL);
            const froe_report r = froe_tree_report(tree);
            const double n = (double)r.objects;
            sum += (double)r.fragments / (n + 2 * n * log(n)) / 5;
            froe_tree_free(tree);
            froe_scene_free(scene);
        }
        worst = fmax(worst, sum);
    }
    return worst;
}
static double autopartition_in_space(void) {
    return fmax(saddles_growth("autopartition"),
                growth("disjoint-3d", 250, 3, "autopartition", NULL, FROE_LEAF_OWN, pieces));
}

/* n / lambda bundles of lambda long, nearly parallel segments, each in a cell of its own of a grid. */
static froe_scene *bundles(size_t n, size_t lambda) {
    double *xyxy = calloc(4 * n, sizeof *xyxy);
    const size_t side = (size_t)ceil(sqrt((double)n / (double)lambda));
    uint64_t state = 1;
    for (size_t i = 0; i < n; i++) {
        const size_t bundle = i / lambda, within = i % lambda;
        double random[4];
        for (int k = 0; k < 4; k++)
            state = state * 6364136223846793005u + 1442695040888963407u, random[k] = (double)(state >> 11) * 0x1p-53;
        const double gap = 0.8 / (double)lambda, y = (double)(bundle / side) + gap * ((double)within + 0.5);
        double *s = xyxy + 4 * i;
        s[0] = (double)(bundle % side) + 0.1 * random[0], s[1] = y + 0.4 * gap * (random[1] - 0.5);
        s[2] = (double)(bundle % side) + 0.8 - 0.1 * random[2], s[3] = y + 0.4 * gap * (random[3] - 0.5);
    }
    froe_scene *scene = bench_segments(xyxy, n);
    free(xyxy);
    return scene;
}

static double size_against_lambda(void) {
    claims_series s = {.count = 0};
    for (size_t lambda = 4; lambda <= 1024; lambda *= 4) {
        froe_scene *scene = bundles(16384, lambda);
        froe_tree *tree = bench_build_by(build_tuned, scene, "density",
                                         "k=8 supports=1 quantiles=0 edges=0 small=0 free=no", 1, 1, NULL);
        claims_add(&s, log((double)lambda) + 1, (double)froe_tree_report(tree).size);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
    return claims_slope(&s);
}

static double size_against_lambda_in_space(void) {
    claims_series s = {.count = 0};
    for (size_t lambda = 16; lambda <= 256; lambda *= 2) {
        froe_scene *scene = saddles(1024, lambda);
        froe_tree *tree = bench_build(scene, "density", NULL, 1, 1, NULL);
        claims_add(&s, (double)lambda, (double)froe_tree_report(tree).size);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
    return claims_slope(&s);
}

/* --------------------------------------------------------- Tobola and Nechvile -- */

static double directional_is_linear(void) {
    static const char *const kinds[] = {"bricks", "sticks", "towers", "slabs", NULL};
    return worst_growth(kinds, 2000, 4, "directional", pieces);
}
static double directional_bars(void) {
    return growth("bars", 200, 4, "directional", NULL, FROE_LEAF_OWN, pieces);
}
static double directional_time(void) {
    return fmax(time_growth("sticks", 4000, 4, "directional", seconds_per_n_log2_n),
                time_growth("rows", 4000, 4, "directional", seconds_per_n_log2_n));
}
static double directional_potential(void) {
    double worst = 0;
    static const char *const kinds[] = {"sticks", "slabs", "towers", "panels", "bars", "debris-3d", "shells", NULL};
    for (const char *const *kind = kinds; *kind; kind++) {
        claims_tree t = claims_build(*kind, 2000, "directional", NULL, FROE_LEAF_OWN);
        worst = fmax(worst, share_of_promise(&t.report, "fragments"));
        claims_free(&t);
    }
    return worst;
}

/* ------------------------------------------------ Agarwal, Erickson and Guibas -- */

static double nodes_per_n_log_n(const claims_tree *t) {
    const double n = (double)t->report.objects;
    return (double)t->report.nodes / (n * log(n));
}
static double nodes_per_crossing(const claims_tree *t) {
    const double n = (double)t->report.objects, k = n * n / 4;
    return (double)t->report.nodes / (n * log(n) + k);
}
static double cylindrical_size(void) {
    return growth("disjoint", 1000, 5, "cylindrical", NULL, 0, nodes_per_n_log_n);
}
static double nodes_per_n_log2_n(const claims_tree *t) {
    const double n = (double)t->report.objects;
    return (double)t->report.nodes / (n * log(n) * log(n));
}
static double cylindrical_in_space(void) {
    return growth("terrain", 250, 4, "cylindrical", NULL, 0, nodes_per_n_log2_n);
}
static double cylindrical_crossings(void) {
    return growth("slats", 128, 3, "cylindrical", NULL, 0, nodes_per_crossing);
}
static double cylindrical_height(void) {
    return height_in_log_n("disjoint", 5, "cylindrical", 0);
}

/* ---------------------------------------------------------- de Berg and Streppel -- */

static double bar_size(void) {
    static const char *const kinds[] = {"scatter", "rooms", "cuboids", NULL};
    return worst_growth(kinds, 1000, 4, "bar", size);
}
static double bar_object_height(void) {
    return fmax(height_in_log_n("scatter", 4, "bar", FROE_LEAF_OWN),
                height_in_log_n("cuboids", 4, "bar", FROE_LEAF_OWN));
}

/* ------------------------------------------------------------- Paterson and Yao -- */

static double pieces_per_n_log_n(const claims_tree *t) {
    const double n = (double)t->report.objects;
    return pieces(t) / (n * log(n));
}
static double slabs(void) {
    return fmax(growth("parallel", 1000, 4, "paterson_yao", "rule=slabs", 1, pieces_per_n_log_n),
                growth("disjoint", 1000, 4, "paterson_yao", "rule=slabs", 1, pieces_per_n_log_n));
}
static double orthogonal_in_the_plane(void) {
    static const char *const kinds[] = {"cells", "walls", "rows", NULL};
    return worst_growth(kinds, 1000, 4, "paterson_yao", pieces);
}
static double orthogonal_bars(void) {
    return growth("bars", 200, 4, "paterson_yao", NULL, FROE_LEAF_OWN, pieces);
}
/* Pieces over n (1 + 2 log2 n): each segment ends in two slabs of each level. */
static double slab_constant(void) {
    static const char *const kinds[] = {"disjoint", "rooms", "blocks", "spiral", NULL};
    double worst = 0;
    for (const char *const *kind = kinds; *kind; kind++) {
        claims_tree t = claims_build(*kind, 8000, "paterson_yao", "rule=slabs", FROE_LEAF_OWN);
        const double n = (double)t.report.objects;
        worst = fmax(worst, pieces(&t) / (n * (1 + 2 * log2(n))));
        claims_free(&t);
    }
    return worst;
}

/* ------------------------------------------------------------- all, and froe's own -- */

/* The greatest measured / promised of all promises of all methods. */
static double promises(void) {
    static const char *const kinds[] = {"scatter", "rooms",     "star",  "wedge", "terrain",  "rooms-3d", "grid-3d",
                                        "cuboids", "nested-3d", "boxes", "bars",  "balls-3d", NULL};
    double worst = 0;
    const froe_method_info *m;
    for (const char *const *kind = kinds; *kind; kind++)
        for (size_t i = 0; (m = froe_method_at(i)) != NULL; i++) {
            froe_scene *scene = bench_generate(*kind, 300, 1);
            froe_build_options o = froe_build_defaults();
            froe_tree *tree = NULL;
            o.method = m->name;
            if (claims_serves(m, scene) && froe_build(scene, &o, &tree, NULL) == FROE_OK) {
                const froe_report r = froe_tree_report(tree);
                for (const froe_promise *p = r.promises; p && p->name; p++)
                    if (p->measured > 0) worst = fmax(worst, p->measured / p->promised);
                froe_tree_free(tree);
            }
            froe_scene_free(scene);
        }
    return worst;
}

/** Most pieces per triangle of 1,000 to 4,000 triangles of cubes, one in the other. */
static double nested_cubes(const char *method) {
    double worst = 0;
    for (size_t n = 1000; n <= 4000; n *= 2) {
        claims_tree t = claims_build("nested-3d", n, method, NULL, 1);
        worst = fmax(worst, pieces(&t) / (double)t.report.objects);
        claims_free(&t);
    }
    return worst;
}
static double nested_cubes_by_guards(void) {
    return nested_cubes("density");
}
static double nested_cubes_without(void) {
    return nested_cubes("autopartition");
}

static double painters(void) {
    static const char *const kinds[] = {"city", "rooms-3d", "cuboids", NULL};
    double worst = 0;
    for (const char *const *kind = kinds; *kind; kind++) {
        claims_tree t = claims_build(*kind, 8000, "density", NULL, 1);
        worst = fmax(worst, pieces(&t) / (double)t.report.objects);
        claims_free(&t);
    }
    return worst;
}

const claim claims_size[] = {
    {"de Berg, theorem 2.5", "linear size in uncluttered scenes", "density",
     "exponent of nodes + pieces in n; worst of cuboids, city, terrain", 0.9, 1.05, linear_size},
    {"de Berg, theorem 2.5", "the same in the plane", "density",
     "exponent of nodes + pieces in n; worst of scatter, rooms, blocks", 0.9, 1.05, linear_size_in_the_plane},
    {"de Berg, theorem 2.5", "few pieces of objects of all scales", "density",
     "pieces / n, 1000, 2000 and 4000 triangles of nested cubes", 1, 5.5, nested_cubes_by_guards},
    {"the same, for comparison", "refinement without guards makes many", "autopartition",
     "pieces / n, the same triangles", 15, 200, nested_cubes_without},
    {"de Berg, introduction (Chazelle)", "some scenes are quadratic for every partition", "density",
     "exponent of pieces in n, lines of two saddles", 1.8, 2.2, saddles_are_quadratic},
    {"de Berg, introduction (Chazelle)", "the same", "grain", "exponent of pieces in n, lines of two saddles", 1.8, 2.2,
     saddles_are_quadratic_for_grain},
    {"de Berg, theorem 2.5", "O(n log n) time", "density",
     "exponent of time / (n log n) in n; worse of scatter, clusters", -INFINITY, 0.15, build_time},
    {"de Berg, lemma 2.1", "(2 V - 1)(2^d - 1) + 1 leaves without guards inside", "density",
     "leaves / bound, worst of ten scenes", 0, 1, guard_leaves_without_guards},
    {"de Berg, lemma 2.8 corrected", "clutter <= c_d density, c_2 = 4, c_3 = 8", NULL,
     "clutter found / (c_d density), worst of ten scenes", 0, 1, clutter_is_low_where_density_is},
    {"de Berg, section 1", "few pieces for the painter", "density", "pieces / n, worst of city, rooms-3d, cuboids", 1,
     3, painters},
    {"Sacks, lemma 12.7", "(2^d - 1)(2 V / k - 1) + 1 leaves", "density",
     "leaves / bound, worst of ten scenes and k = 1, 4, 16, 64", 0, 1, guard_leaves_with_guards},
    {"Sacks, lemma 12.7", "leaves ~ n / k", "density", "exponent of leaves in k, segments", -1.15, -0.85,
     guard_leaves_against_k},
    {"Sacks, lemma 12.6", "cells with k guards meet k + c_d lambda objects: doubling ends below twice the density",
     "density", "k at the end / (2 density), worst of ten scenes", 0, 1, doubling},
    {"Sacks, lemma 12.1", "n + 2 n ln n expected pieces of disjoint segments", "autopartition",
     "mean pieces / bound, worst of five scenes", 0, 1, autopartition_in_the_plane},
    {"Sacks, lemma 12.1 in space", "O(n^2) expected pieces", "autopartition",
     "exponent of pieces in n; worse of disjoint-3d, saddles", 1, 2.1, autopartition_in_space},
    {"Sacks, theorem 12.8", "size O(n log lambda)", "density",
     "exponent of size in 1 + ln lambda, bundles of lambda = 4 .. 1024 segments", 0, 1.1, size_against_lambda},
    {"Sacks, theorem 12.9", "size O(n lambda) in space", "density",
     "exponent of size in lambda, groups of 16 .. 256 triangles along saddles", 0.7, 1.1, size_against_lambda_in_space},
    {"Tobola and Nechvile, lemma 4.2", "linear size at low directional density", "directional",
     "exponent of pieces in n; worst of bricks, sticks, towers, slabs", 0.95, 1.1, directional_is_linear},
    {"Tobola and Nechvile, introduction (Paterson and Yao)", "n^1.5 where the density is high", "directional",
     "exponent of pieces in n, bars", 1.35, 1.65, directional_bars},
    {"Tobola and Nechvile, section 5", "O(n log^2 n) time", "directional",
     "exponent of time / (n log^2 n) in n; worse of sticks, rows", -INFINITY, 0.15, directional_time},
    {"Tobola and Nechvile, lemma 3.3 weighted", "(2 + 2 trade)^d n pieces and what faces divide", "directional",
     "pieces / bound, worst of seven scenes", 0, 1, directional_potential},
    {"Agarwal et al., theorem 2.3", "O(n log n) nodes of disjoint segments", "cylindrical",
     "exponent of nodes / (n log n) in n, disjoint", -INFINITY, 0.05, cylindrical_size},
    {"Agarwal et al., theorem 2.3", "O(n log n + k) nodes with k crossings", "cylindrical",
     "exponent of nodes / (n log n + k) in n, slats", -INFINITY, 0.1, cylindrical_crossings},
    {"Agarwal et al., theorem 2.5", "O(n log^2 n + k) nodes of triangles in space, k crossings of projected edges",
     "cylindrical", "exponent of nodes / (n log^2 n) in n, terrain (k = 0)", -INFINITY, 0.05, cylindrical_in_space},
    {"Agarwal et al., theorem 2.3", "height O(log n)", "cylindrical", "exponent of height in log n, disjoint", 0.5, 1.4,
     cylindrical_height},
    {"de Berg and Streppel, theorem 3", "size O(lambda n)", "bar",
     "exponent of nodes + pieces in n; worst of scatter, rooms, cuboids", 0.9, 1.1, bar_size},
    {"de Berg and Streppel, theorem 3", "height O(log n)", "bar",
     "exponent of height in log n; worse of scatter, cuboids", 0.5, 1.5, bar_object_height},
    {"Paterson and Yao 1990", "O(n log n) pieces of disjoint segments", "paterson_yao",
     "exponent of pieces / (n log n) in n; worse of parallel, disjoint", -INFINITY, 0.1, slabs},
    {"the same", "two pieces a slab of each level", "paterson_yao",
     "pieces / (n (1 + 2 log2 n)), worst of disjoint, rooms, blocks, spiral", 0, 1, slab_constant},
    {"Paterson and Yao 1992", "few pieces of axis-parallel objects in the plane", "paterson_yao",
     "exponent of pieces in n; worst of cells, walls, rows", 0.9, 1.05, orthogonal_in_the_plane},
    {"Paterson and Yao 1992", "n^1.5 in space, where it must be", "paterson_yao", "exponent of pieces in n, bars", 1.35,
     1.65, orthogonal_bars},
    {"all", "what methods promise of each tree", NULL, "measured / promised, worst of all methods and twelve scenes", 0,
     1, promises},
    {0}};
