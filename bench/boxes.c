/* boxes.c: trees of boxes beside each other and beside Boost's packed R-tree.
 *
 *     bench_boxes [-METHOD] SCENE...       a kind of froe_generate with a number (slabs:100000), or a file, of which
 * the bounding boxes of features, nodes or rows are taken
 *
 * One thread, processor time, medians of 3 rounds in which programs take turns. Windows are cubes around corners of
 * boxes that find about 10 boxes; answers are compared with Boost's. Leaves hold one box, or boxes that no
 * axis-parallel cut separates. Builders give up beyond 40 pieces a box. */
#include "peers/boxes.h"
#include "bench.h"
#include <froe/query.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 3, QUERIES = 3000, MOST_PIECES = 40 };

typedef struct contender {
    const char *name, *method, *settings;
} contender;

static const contender contenders[] = {
    {"directional", "directional", NULL},
    {"directional, slack=0", "directional", "slack=0"},
    {"density", "density", NULL},
    {"kd, median", "kd", "cost=median"},
    {"kd, surface", "kd", "cost=surface"},
    {"Paterson-Yao", "paterson_yao", NULL},
    {"best of 16 facets", "autopartition", "candidates=16"},
};
enum { CONTENDERS = sizeof contenders / sizeof *contenders };

typedef struct run {
    char name[32];
    int dim;
    size_t n;
    double *lo, *hi, size; /* size: the longest side of the scene */
    double *windows;       /* lo, hi */
    froe_scene *scene;
    void *index;
    double build, rate; /* Boost's */
    uint64_t checksum;
    uint32_t *out;
} run;

/* ----------------------------------------------------------------------- scene -- */

static froe_scene *read_boxes(const char *path) {
    froe_read_options o = froe_read_defaults();
    froe_diagnostic diag = {0};
    froe_scene *scene = NULL;
    o.boxes = true;
    if (froe_read(path, &o, &scene, NULL, &diag)) fprintf(stderr, "bench: %s: %s\n", path, diag.message), exit(1);
    return scene;
}

static void make_scene(run *r, const char *what) {
    char kind[32];
    const char *colon = strchr(what, ':');
    if (colon && (size_t)(colon - what) < sizeof kind) {
        snprintf(kind, sizeof kind, "%.*s", (int)(colon - what), what);
        snprintf(r->name, sizeof r->name, "%s", kind);
        r->scene = bench_generate(kind, strtoull(colon + 1, NULL, 10), 1);
    } else {
        bench_name(what, r->name);
        r->scene = read_boxes(what);
    }
    r->dim = froe_scene_dim(r->scene);
    r->n = froe_scene_object_count(r->scene);
    size_t dim = (size_t)r->dim;
    r->lo = bench_take(r->n * dim, sizeof *r->lo), r->hi = bench_take(r->n * dim, sizeof *r->hi);
    for (uint32_t i = 0; i < r->n; i++)
        for (uint32_t k = 0; k < dim; k++) {
            r->lo[i * dim + k] = froe_scene_vertex(r->scene, froe_scene_corner(r->scene, i, 0))[k];
            r->hi[i * dim + k] = froe_scene_vertex(r->scene, froe_scene_corner(r->scene, i, 1))[k];
        }
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    froe_scene_bounds(r->scene, lo, hi);
    for (int k = 0; k < r->dim; k++) r->size = fmax(r->size, hi[k] - lo[k]);
}

/* --------------------------------------------------------------------- windows -- */

static uint64_t numbers; /* state of the random ones */

static void place_windows(run *r, const double *centres, double half) {
    size_t dim = (size_t)r->dim;
    for (size_t i = 0; i < 2 * dim * QUERIES; i++) {
        size_t query = i / (2 * dim), k = i % (2 * dim);
        r->windows[i] = centres[query * dim + k % dim] + (k < dim ? -half : half);
    }
}

static void make_windows(run *r) {
    size_t dim = (size_t)r->dim;
    double low = 0, high = r->size, *centres = bench_take(QUERIES, dim * sizeof *centres);
    r->windows = bench_take(QUERIES, 2 * dim * sizeof *r->windows);
    for (size_t q = 0; q < QUERIES; q++)
        memcpy(centres + q * dim, (q % 2 ? r->lo : r->hi) + dim * (size_t)(bench_unit(&numbers) * (double)r->n),
               dim * sizeof(double));
    for (int step = 0; step < 40; step++) {
        double half = 0.5 * (low + high), found = 0;
        place_windows(r, centres, half);
        for (size_t q = 0; q < 200; q++) {
            const double *w = r->windows + 2 * dim * q;
            found += (double)peer_boxes_window(r->dim, r->index, w, w + dim, r->out) / 200;
        }
        *(found > 10 ? &high : &low) = half;
    }
    free(centres);
}

/* ------------------------------------------------------------------------ Boost -- */

static void time_peer(run *r) {
    double builds[ROUNDS], rates[ROUNDS];
    for (int i = 0; i < ROUNDS; i++) {
        if (r->index) peer_boxes_free(r->dim, r->index);
        double start = bench_cpu();
        r->index = peer_boxes_build(r->dim, r->n, r->lo, r->hi);
        builds[i] = bench_cpu() - start;
    }
    r->build = bench_median(builds, ROUNDS);
    make_windows(r);
    for (int i = 0; i < ROUNDS; i++) {
        double start = bench_cpu();
        r->checksum = 0;
        for (size_t q = 0; q < QUERIES; q++) {
            const double *w = r->windows + 2 * (size_t)r->dim * q;
            size_t count = peer_boxes_window(r->dim, r->index, w, w + r->dim, r->out);
            for (size_t k = 0; k < count; k++) r->checksum += (r->out[k] + 1) * 0x9e3779b97f4a7c15u * (q + 1);
        }
        rates[i] = QUERIES / (bench_cpu() - start);
    }
    r->rate = bench_median(rates, ROUNDS);
}

/* ------------------------------------------------------------------------- froe -- */

static double time_windows(run *r, const froe_tree *tree, bool *equal) {
    double rates[ROUNDS];
    froe_query *query = NULL;
    froe_range range = froe_range_defaults();
    bench_must(froe_query_new(tree, &query, NULL), NULL);
    for (int i = 0; i < ROUNDS; i++) {
        double start = bench_cpu();
        uint64_t checksum = 0;
        for (size_t q = 0; q < QUERIES; q++) {
            froe_list found;
            range.points = r->windows + 2 * (size_t)r->dim * q;
            bench_must(froe_query_range(query, &range, &found, NULL), NULL);
            for (size_t k = 0; k < found.count; k++) checksum += (found.ids[k] + 1) * 0x9e3779b97f4a7c15u * (q + 1);
        }
        rates[i] = QUERIES / (bench_cpu() - start);
        *equal = checksum == r->checksum;
    }
    froe_query_free(query);
    return bench_median(rates, ROUNDS);
}

static void time_method(run *r, const contender *c) {
    froe_build_options o = froe_build_defaults();
    froe_tree *tree = NULL;
    double builds[ROUNDS];
    bool equal = true;
    o.method = c->method, o.settings = c->settings, o.leaf = 1, o.threads = 1;
    o.max_fragments = MOST_PIECES * r->n;
    for (int i = 0; i < ROUNDS; i++) {
        froe_tree_free(tree);
        double start = bench_cpu();
        froe_status status = froe_build(r->scene, &o, &tree, NULL);
        builds[i] = bench_cpu() - start;
        if (!status) continue;
        printf("%-16s %8zu %-22s %s\n", r->name, r->n, c->name,
               status == FROE_E_BUDGET ? "more than 40 pieces a box" : froe_status_text(status));
        return;
    }
    froe_report report = froe_tree_report(tree);
    double build = bench_median(builds, ROUNDS), rate = time_windows(r, tree, &equal);
    printf("%-16s %8zu %-22s %8.3f %6llu %8.3f %6.1fx %9.0f %5.2fx%s\n", r->name, r->n, c->name,
           (double)report.fragments / (double)r->n, (unsigned long long)report.height, build, build / r->build, rate,
           rate / r->rate, equal ? "" : "   other answers than Boost");
    fflush(stdout);
    froe_tree_free(tree);
}

static bool exists(const char *method) {
    const froe_method_info *info;
    for (size_t i = 0; (info = froe_method_at(i)); i++)
        if (!strcmp(info->name, method)) return true;
    return false;
}

static void bench(const char *what, const char *only) {
    run r = {.n = 0};
    make_scene(&r, what);
    if (r.dim > 3) fprintf(stderr, "bench: %s: Boost's column takes boxes in the plane and in space\n", what), exit(1);
    r.out = bench_take(r.n, sizeof *r.out);
    time_peer(&r);
    printf("%-16s %8zu %-22s %8s %6s %8.3f %7s %9.0f\n", r.name, r.n, "Boost, packed R-tree", "1", "", r.build, "",
           r.rate);
    for (size_t i = 0; i < CONTENDERS; i++)
        if (exists(contenders[i].method) && (!only || !strcmp(only, contenders[i].method)))
            time_method(&r, contenders + i);
    peer_boxes_free(r.dim, r.index);
    froe_scene_free(r.scene);
    free(r.lo), free(r.hi), free(r.windows), free(r.out);
}

int main(int argc, char **argv) {
    bench_head("trees of boxes, one thread, medians of 3 rounds by processor time", 1);
    printf("# x: times as long as Boost to build, times as many windows a second\n");
    printf("%-16s %8s %-22s %8s %6s %8s %7s %9s\n", "scene", "boxes", "", "pieces/n", "height", "build s", "",
           "windows/s");
    const char *only = argc > 1 && *argv[1] == '-' ? argv[1] + 1 : NULL;
    for (int i = only ? 2 : 1; i < argc; i++) bench(argv[i], only);
    return argc < 2;
}
