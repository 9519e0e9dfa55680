/* sacks.c: Sacks, lecture notes on density-sensitive binary space partitions, section 12. */
#include "build/options.h"
#include "guarding.h"
#include <math.h>
#include <string.h>

/* Pieces over n + 2 n ln n, the mean over seeds. */
static double expected_pieces(const claims_tree *t) {
    enum { SEEDS = 5 };
    const double bound = t->n + 2 * t->n * log(t->n);
    double sum = 0;
    if (strcmp(t->way.method, "sorted") == 0) return claims_pieces(t) / bound;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        froe_build_options o = froe_build_defaults();
        froe_diagnostic diag = {0};
        froe_tree *tree = NULL;
        o.method = t->way.method, o.settings = t->way.settings, o.leaf = 0, o.seed = seed;
        bench_must(build_tuned(t->scene, &o, &tree, &diag), &diag);
        sum += (double)froe_tree_report(tree).fragments;
        froe_tree_free(tree);
    }
    return sum / SEEDS / bound;
}

/* Nodes and pieces for each object and each part of a logarithm of lambda. */
static double size_per_log_lambda(const claims_tree *t) {
    return claims_size(t) / (1 + log(t->lambda));
}

const claim claims_sacks[] = {
    {.source = "Sacks, lemma 12.1",
     .says = "n + 2 n ln n expected pieces of disjoint segments",
     .measured = "mean pieces / bound, worst of combs, disjoint, rooms, parallel, spiral",
     .least = 0,
     .most = 1,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("combs", "disjoint", "rooms", "parallel", "spiral"), 1000, 0, expected_pieces, .cuts = true),
     .with = {.method = "autopartition", .settings = "free=no"},
     .needs = "random order",
     .without = {.method = "sorted"}},
    {.source = "Sacks, lemma 12.1 in space",
     .says = "O(n^2) expected pieces",
     .measured = "exponent of pieces in n; worst of saddles, cards",
     .least = 1,
     .most = 2.1,
     .measure = claims_growth,
     .of = CLAIMS_PLAN(("saddles", "cards"), 48, 2, claims_pieces),
     .with = {.method = "autopartition"},
     .needs = "random order and free cuts",
     .without = {.method = "sorted"}},
    {.source = "Sacks, lemma 12.6",
     .says = "doubling ends below twice the density",
     .measured = "lambda at the end / (2 density), worst of ten scenes",
     .least = 0,
     .most = 1,
     .measure = claims_most,
     .of = CLAIMS_PLAN(GUARDED, 2000, 0, guarding_doubled),
     .with = {.method = "density", .settings = "mode=doubling"},
     .needs = "cubes: slabs with lambda guards",
     .without = {.method = "density", .settings = "mode=doubling", .bare = true}},
    {.source = "Sacks, lemma 12.7",
     .says = "(2^d - 1)(2 V / k - 1) + 1 leaves",
     .measured = "leaves / bound, worst of ten scenes, k = 4",
     .least = 0,
     .most = 1,
     .measure = claims_most,
     .of = CLAIMS_PLAN(GUARDED, 600, 0, guarding_leaves_over_bound, .leaf = 1 << 30),
     .with = {.method = "density", .settings = "k=4 form=cross"},
     .needs = "shrinks: cubes are halved until k guards are left",
     .without = {.method = "density", .settings = "k=4 form=cross", .bare = true},
     .kind = CLAIM_QUICK},
    {.source = "Sacks, lemma 12.7",
     .says = "leaves ~ V / k",
     .measured = "exponent of leaves in k, nested, k = 1 .. 64",
     .least = -1.2,
     .most = -0.8,
     .measure = guarding_leaves_by_k,
     .with = {.method = "density"},
     .needs = "shrinks: cubes are halved until k guards are left",
     .without = {.method = "density", .bare = true},
     .kind = CLAIM_QUICK},
    {.source = "Sacks, lemma 12.7",
     .says = "a leaf meets k + c_d lambda objects",
     .measured = "fullest leaf / bound, worst of ten scenes, k by doubling",
     .least = 0,
     .most = 1,
     .measure = claims_most,
     .of = CLAIMS_PLAN(GUARDED, 2000, 0, guarding_load_over_bound),
     .with = {.method = "density", .settings = "mode=doubling"},
     .needs = "cubes: slabs without a guard inside",
     .without = {.method = "density", .settings = "mode=doubling", .bare = true}},
    {.source = "Sacks, lemma 12.7",
     .says = "for shapes of arbitrary complexity: leaves ~ shapes, not their parts",
     .measured = "exponent of leaves in the parts of a shape, 4096 segments in zigzags of 4 .. 64",
     .least = -1.2,
     .most = -0.8,
     .measure = claims_by_lambda,
     .of = CLAIMS_PLAN(("zigzags"), 4096, 4, guarding_leaves, .lambda = 4, .leaf = 1 << 30),
     .with = {.method = "density", .settings = "k=4 guards=shape"},
     .needs = "guards of shapes: those of their parts",
     .without = {.method = "density", .settings = "k=4"},
     .kind = CLAIM_QUICK},
    {.source = "Sacks, theorem 12.8",
     .says = "size O(n log lambda)",
     .measured = "exponent of size / (1 + ln lambda) in lambda, 4096 segments in combs of 4 .. 128",
     .least = -INFINITY,
     .most = 0.05,
     .measure = claims_by_lambda,
     .of = CLAIMS_PLAN(("combs"), 4096, 5, size_per_log_lambda, .lambda = 4),
     .with = {.method = "density", .settings = "k=8 supports=1 quantiles=0 edges=0 small=0 free=no"},
     .needs = "random order of the cuts below the guards",
     .without = {.method = "sorted"}},
    {.source = "Sacks, theorem 12.8",
     .says = "and linear in n",
     .measured = "exponent of size in n, combs of 64",
     .least = 0.9,
     .most = 1.1,
     .measure = claims_growth,
     .of = CLAIMS_PLAN(("combs"), 512, 3, claims_size, .lambda = 64),
     .with = {.method = "density", .settings = "k=8 supports=1 quantiles=0 edges=0 small=0 free=no"},
     .needs = "guards",
     .without = {.method = "sorted"},
     .kind = CLAIM_QUICK},
    {.source = "Sacks, theorem 12.9",
     .says = "size O(n lambda) in space",
     .measured = "exponent of size in lambda, 1024 triangles, lines of saddles in groups of 16 .. 128",
     .least = 0.7,
     .most = 1.1,
     .measure = claims_by_lambda,
     .of = CLAIMS_PLAN(("saddles", "cards"), 1024, 3, claims_size, .lambda = 16),
     .with = {.method = "density"},
     .needs = "random order of the cuts below the guards, and free cuts",
     .without = {.method = "sorted"}},
    {0}};
