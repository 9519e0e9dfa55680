/* boxes.c: Tobola and Nechvile, "BSP trees for sets of hyperrectangles with low directional density"; Paterson and Yao
 * on orthogonal objects. */
#include "claims.h"
#include <froe/measure.h>
#include <math.h>
#include <stdlib.h>

#define BY_ROOMS                                                                                                       \
    { .method = "directional" }
#define BY_MEDIANS                                                                                                     \
    { .method = "kd", .settings = "growth=1000" }

static const claims_plan bars[] = {
    {.kinds = CLAIMS_KINDS("bars"), .from = 192, .doublings = 4, .value = claims_pieces},
    {.kinds = CLAIMS_KINDS("bars apart"), .from = 192, .doublings = 4, .value = claims_pieces}};
static const claims_plan rods[] = {
    {.kinds = CLAIMS_KINDS("rods"), .from = 192, .doublings = 4, .value = claims_pieces},
    {.kinds = CLAIMS_KINDS("cut rods"), .from = 192, .doublings = 4, .value = claims_pieces}};

static double n_log2_n(const claims_tree *t) {
    return t->n * log(t->n) * log(t->n);
}

/* Boxes that cross the plane of a face near it, most of all boxes. Bare: near by much, not by the box's own sides. */
static double simple_density(const claims_tree *t) {
    froe_measure_options o = froe_measure_defaults();
    froe_directional d;
    o.samples = 0;
    bench_must(froe_measure_directional(t->scene, 0.25, &o, &d, NULL), NULL);
    return t->way.bare ? d.extended.most : d.simple.most;
}

/* Nodes and pieces. Bare: boxes that contain the region of a node are listed in every leaf below it instead. */
static double size_per_box(const claims_tree *t) {
    double size = (double)t->report.size;
    double *leaves = malloc((size_t)t->report.nodes * sizeof *leaves); /* below each node */
    bench_must(leaves ? FROE_OK : FROE_E_MEMORY, NULL);
    for (uint64_t i = t->report.nodes; i-- > 0;) { /* children come after their parents */
        const froe_node_info node = froe_tree_node(t->tree, (froe_node){(uint32_t)i + 1});
        const bool leaf = !node.child[0].id1;
        leaves[i] = leaf ? 1 : leaves[node.child[0].id1 - 1] + leaves[node.child[1].id1 - 1];
        if (t->way.bare) size += (leaves[i] - 1) * (double)node.cover_count;
    }
    free(leaves);
    return size / t->n;
}

const claim claims_boxes[] = {
    {.source = "Tobola and Nechvile, lemma 4.2",
     .says = "linear size at low directional density",
     .measured = "pieces / n, the most of bricks, sticks, towers, slabs, plates, moons, n = 1000 to 16000",
     .least = 1,
     .most = 2.4,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("bricks", "sticks", "towers", "slabs", "plates", "moons"), 1000, 4, claims_per_object),
     .with = BY_ROOMS,
     .needs = "rooms: medians",
     .without = BY_MEDIANS},
    {.source = "Tobola and Nechvile, section 5",
     .says = "linear size of boxes one in the other, too",
     .measured = "(nodes + pieces) / n, the most of shells, n = 100 to 6400",
     .least = 1,
     .most = 14,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("shells"), 100, 6, size_per_box),
     .with = BY_ROOMS,
     .needs = "covers: they are listed in all leaves below",
     .without = {.method = "directional", .bare = true}},
    {.source = "Tobola and Nechvile, lemma 3.4",
     .says = "the same for flat rectangles",
     .measured = "exponent of pieces in n; faces of nested cubes",
     .least = 0.95,
     .most = 1.1,
     .measure = claims_growth,
     .of = CLAIMS_PLAN(("faces"), 96, 3, claims_pieces),
     .with = BY_ROOMS,
     .needs = "rooms: medians",
     .without = BY_MEDIANS},
    {.source = "Tobola and Nechvile, lemma 3.1",
     .says = "simple directional density is too little: no linear partition",
     .measured = "exponent of pieces in n, rods",
     .least = 1.3,
     .most = 1.65,
     .measure = claims_of_two,
     .of = &rods,
     .with = BY_ROOMS,
     .needs = "rods: they are cut to pieces one step long",
     .without = {.method = "directional", .bare = true},
     .kind = CLAIM_QUICK},
    {.source = "Tobola and Nechvile, lemma 3.1",
     .says = "although it is bounded",
     .measured = "simple directional density, delta = 1/4, rods, n to 3072",
     .least = 0,
     .most = 4,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("rods"), 768, 2, simple_density),
     .with = BY_ROOMS,
     .needs = "simple: extended",
     .without = {.method = "directional", .bare = true}},
    {.source = "Tobola and Nechvile, introduction (Paterson and Yao)",
     .says = "n^1.5 where the density is high",
     .measured = "exponent of pieces in n, bars",
     .least = 1.35,
     .most = 1.65,
     .measure = claims_of_two,
     .of = &bars,
     .with = BY_ROOMS,
     .needs = "bars that reach through one another: the three directions are moved apart",
     .without = {.method = "directional", .bare = true},
     .kind = CLAIM_QUICK},
    {.source = "Tobola and Nechvile, section 5",
     .says = "O(n log^2 n) time",
     .measured = "exponent of time / (n log^2 n) in n; worst of sticks, rows, faces",
     .least = -INFINITY,
     .most = 0.15,
     .measure = claims_time,
     .of = CLAIMS_PLAN(("sticks", "rows", "faces"), 768, 3, n_log2_n),
     .with = BY_ROOMS,
     .needs = "trees that pay for the smaller side",
     .without = {.method = "directional", .settings = "structure=sweep"},
     .kind = CLAIM_TIMED},
    {.source = "Tobola and Nechvile, definition 5.1",
     .says = "best balanced cuts: low trees",
     .measured = "height / log2 n, the most of boxes-3d, slabs, sticks, 8000 boxes",
     .least = 1,
     .most = 1.6,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("boxes-3d", "slabs", "sticks"), 8000, 0, claims_high),
     .with = {.method = "directional", .settings = "balance=1 slack=0"},
     .needs = "balance: of cuts that are paid for any is taken",
     .without = {.method = "directional", .settings = "slack=1"},
     .kind = CLAIM_QUICK},
    {.source = "Tobola and Nechvile, theorem 5.4",
     .says = "balance is traded for size",
     .measured = "pieces / n, the most of boxes-3d, slabs, sticks, 8000 boxes",
     .least = 1,
     .most = 2.2,
     .measure = claims_most,
     .of = CLAIMS_PLAN(("boxes-3d", "slabs", "sticks"), 8000, 0, claims_per_object),
     .with = {.method = "directional", .settings = "slack=1"},
     .needs = "trade-off: only balance counts",
     .without = {.method = "directional", .settings = "balance=1 slack=0"},
     .kind = CLAIM_QUICK},
    {.source = "Paterson and Yao 1992",
     .says = "few pieces of axis-parallel objects in the plane",
     .measured = "exponent of pieces in n; worst of cells, walls, rows",
     .least = 0.9,
     .most = 1.05,
     .measure = claims_growth,
     .of = CLAIMS_PLAN(("cells", "walls", "rows"), 1000, 4, claims_pieces),
     .with = {.method = "paterson_yao"},
     .needs = "cuts that divide nothing: medians",
     .without = BY_MEDIANS,
     .kind = CLAIM_QUICK},
    {.source = "Paterson and Yao 1992",
     .says = "n^1.5 in space, where it must be",
     .measured = "exponent of pieces in n, bars",
     .least = 1.35,
     .most = 1.65,
     .measure = claims_of_two,
     .of = &bars,
     .with = {.method = "paterson_yao"},
     .needs = "bars that reach through one another: the three directions are moved apart",
     .without = {.method = "paterson_yao", .bare = true}},
    {0}};
