/* space.c: trees of the builder `index` in space beside what people use as an index of triangles.
 *
 *     bench_space [N [SCENE...]]       default: 10^6, of fat, city, mesh; FILE: a model
 *
 *     fat     triangles of about 0.7 of the mean distance, anywhere, in all directions
 *     city    boxes of 12 triangles on a grid of lots, heights by a power law
 *     mesh    a bumpy sphere
 *
 * One thread, processor time. In every round each program answers the same queries, one program after the other; a
 * rate is the median of 5 rounds, a ratio that of the medians. First with the best code that the processor can run,
 * then with the others. Answers are compared, all of them: windows by their objects, parameters and distances by how
 * many differ by more than 10^-9 of the scene (Embree: 10^-4; it rounds). */
#include "peers/space.h"
#include "bench.h"
#include "query/packed/space.h"
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 5, QUERIES = 20000, MOST = 64 };
#define TAU 6.283185307179586

static const space_peer *const peers[] = {
#ifdef HAVE_EMBREE
    &peer_embree,
#endif
#ifdef HAVE_CGAL
    &peer_cgal_aabb,
#endif
#ifdef HAVE_BOOST
    &peer_boost_space,
#endif
    NULL,
};
enum { PEERS = sizeof peers / sizeof *peers - 1 };

typedef struct run {
    char name[32];
    peer_triangle *t;
    size_t n;
    double lo[3], hi[3], size;
    double *origins, *directions, *points, *windows[2]; /* QUERIES of each */
    froe_scene *scene;
    froe_tree *tree;
    froe_query *query;
    void *index[PEERS + 1];
    double rate[PEERS + 1][ROUNDS]; /* froe first */
    double wrong[PEERS + 1];        /* answers that differ from froe's; -1: did not take part */
    uint32_t *out;
    double *answers; /* froe's */
} run;

/* -------------------------------------------------------------------- scenes -- */

static uint64_t numbers; /* state of the random ones */

static void direction(double d[3]) {
    double z = 2 * bench_unit(&numbers) - 1, a = TAU * bench_unit(&numbers), r = sqrt(1 - z * z);
    d[0] = r * cos(a), d[1] = r * sin(a), d[2] = z;
}

static void make_fat(run *r, size_t n) {
    double size = 0.7 * cbrt(1.0 / (double)n);
    r->t = bench_take(n, sizeof *r->t);
    for (r->n = 0; r->n < n; r->n++) {
        double c[3] = {bench_unit(&numbers), bench_unit(&numbers), bench_unit(&numbers)}, d[3];
        for (int i = 0; i < 3; i++) {
            direction(d);
            for (int k = 0; k < 3; k++) r->t[r->n].p[i][k] = c[k] + size * d[k] * 0.6;
        }
    }
}

static void add_box(run *r, const double lo[3], const double hi[3]) {
    static const int faces[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
    for (int f = 0; f < 6; f++)
        for (int half = 0; half < 2; half++) {
            int corner[3] = {faces[f][0], faces[f][1 + half], faces[f][2 + half]};
            for (int i = 0; i < 3; i++)
                for (int k = 0; k < 3; k++) r->t[r->n].p[i][k] = corner[i] >> k & 1 ? hi[k] : lo[k];
            r->n++;
        }
}

static void make_city(run *r, size_t n) {
    size_t side = (size_t)ceil(sqrt((double)n / 12));
    double lot = 1.0 / (double)side;
    r->t = bench_take(12 * side * side, sizeof *r->t);
    for (size_t i = 0; i < side; i++)
        for (size_t j = 0; j < side; j++) {
            double lo[3] = {lot * ((double)i + 0.3 * bench_unit(&numbers)),
                            lot * ((double)j + 0.3 * bench_unit(&numbers)), 0};
            double hi[3] = {lo[0] + lot * (0.3 + 0.4 * bench_unit(&numbers)),
                            lo[1] + lot * (0.3 + 0.4 * bench_unit(&numbers)),
                            lot * fmin(0.5 / sqrt(bench_unit(&numbers) + 1e-9), 20)};
            add_box(r, lo, hi);
        }
}

static void sphere_point(size_t i, size_t j, size_t side, double x[3]) {
    double u = TAU * (double)(j % (2 * side)) / (double)(2 * side), v = 0.5 * TAU * (double)i / (double)side;
    double s = sin(v), d[3] = {s * cos(u), s * sin(u), cos(v)}, bump = 0;
    if (i == 0 || i == side) d[0] = d[1] = 0;
    for (int o = 1; o <= 6; o++) {
        double f = 3 << o;
        bump += sin(f * d[0] + o) * sin(f * d[1] + 2 * o) * sin(f * d[2] + 3 * o) / (double)(2 << o);
    }
    for (int k = 0; k < 3; k++) x[k] = 0.5 + 0.4 * d[k] * (1 + 0.3 * bump);
}

static void make_mesh(run *r, size_t n) {
    size_t side = (size_t)floor(sqrt((double)n / 4));
    r->t = bench_take(4 * side * side, sizeof *r->t);
    for (size_t i = 0; i < side; i++)
        for (size_t j = 0; j < 2 * side; j++) {
            double p[4][3];
            for (size_t c = 0; c < 4; c++) sphere_point(i + c / 2, j + c % 2, side, p[c]);
            if (i)
                memcpy(r->t[r->n].p[0], p[0], 24), memcpy(r->t[r->n].p[1], p[1], 24),
                    memcpy(r->t[r->n++].p[2], p[2], 24);
            if (i + 1 < side)
                memcpy(r->t[r->n].p[0], p[1], 24), memcpy(r->t[r->n].p[1], p[3], 24),
                    memcpy(r->t[r->n++].p[2], p[2], 24);
        }
}

/* The triangles of a model. */
static void read_model(run *r, const char *path) {
    froe_scene *scene = bench_read(path);
    size_t count = froe_scene_object_count(scene);
    r->t = bench_take(count, sizeof *r->t);
    for (uint32_t i = 0; i < count; i++) {
        froe_object o = froe_scene_object(scene, i);
        if (o.kind != FROE_POLYGON || o.corners != 3) continue;
        for (uint32_t c = 0; c < 3; c++)
            memcpy(r->t[r->n].p[c], froe_scene_vertex(scene, froe_scene_corner(scene, i, c)), 24);
        r->n++;
    }
    froe_scene_free(scene);
}

/* In random order. */
static void shuffle(run *r) {
    for (size_t i = r->n; i-- > 1;) {
        size_t j = (size_t)(bench_unit(&numbers) * (double)(i + 1));
        peer_triangle t = r->t[i];
        r->t[i] = r->t[j], r->t[j] = t;
    }
}

static void make_scene(run *r, const char *kind, size_t n) {
    numbers = bench_state(1);
    bench_name(kind, r->name);
    if (!strcmp(kind, "fat"))
        make_fat(r, n);
    else if (!strcmp(kind, "city"))
        make_city(r, n);
    else if (!strcmp(kind, "mesh"))
        make_mesh(r, n);
    else
        read_model(r, kind);
    shuffle(r);
    for (int k = 0; k < 3; k++) r->lo[k] = INFINITY, r->hi[k] = -(double)INFINITY;
    for (size_t i = 0; i < r->n; i++) {
        double lo[3], hi[3];
        peer_bounds(r->t + i, lo, hi);
        for (int k = 0; k < 3; k++) r->lo[k] = fmin(r->lo[k], lo[k]), r->hi[k] = fmax(r->hi[k], hi[k]);
    }
    for (int k = 0; k < 3; k++) r->size = fmax(r->size, r->hi[k] - r->lo[k]);
    froe_objects o = froe_objects_defaults();
    o.count = r->n, o.coords = &r->t[0].p[0][0];
    bench_must(froe_scene_new(3, NULL, &r->scene), NULL);
    bench_must(froe_scene_add(r->scene, &o, NULL), NULL);
}

/* ------------------------------------------------------------------- queries -- */

static void anywhere(const run *r, double x[3]) {
    for (int k = 0; k < 3; k++) x[k] = r->lo[k] + (r->hi[k] - r->lo[k]) * bench_unit(&numbers);
}

static size_t froe_window(run *r, const double *w) {
    froe_range range = froe_range_defaults();
    froe_list found;
    range.points = w;
    bench_must(froe_query_range(r->query, &range, &found, NULL), NULL);
    memcpy(r->out, found.ids, found.count * sizeof *r->out);
    return found.count;
}

/* Cubes about corners of triangles, of the size that finds so many on average, by bisection. */
static void make_windows(run *r, int i, double wanted) {
    double low = 0, high = r->size;
    double *w = r->windows[i] = bench_take(QUERIES, 6 * sizeof *w), *centres = bench_take(QUERIES, 3 * sizeof *centres);
    for (size_t q = 0; q < QUERIES; q++) {
        memcpy(centres + 3 * q, r->t[(size_t)(bench_unit(&numbers) * (double)r->n)].p[0], 24);
        for (int k = 0; k < 3; k++)
            centres[3 * q + (size_t)k] += 0.2 * r->size * cbrt(1 / (double)r->n) * (bench_unit(&numbers) - 0.5);
    }
    for (int step = 0; step < 40; step++) {
        double half = 0.5 * (low + high), found = 0;
        for (size_t q = 0; q < 6 * QUERIES; q++) w[q] = centres[q / 6 * 3 + q % 3] + (q % 6 < 3 ? -half : half);
        for (size_t q = 0; q < 200; q++) found += (double)froe_window(r, w + 6 * q) / 200;
        found > wanted ? (high = half) : (low = half);
    }
    free(centres);
}

static void make_queries(run *r) {
    r->origins = bench_take(QUERIES, 24), r->directions = bench_take(QUERIES, 24), r->points = bench_take(QUERIES, 24);
    for (size_t q = 0; q < QUERIES; q++) {
        anywhere(r, r->origins + 3 * q);
        anywhere(r, r->points + 3 * q);
        direction(r->directions + 3 * q);
    }
    make_windows(r, 0, 10);
    make_windows(r, 1, 1000);
}

/* -------------------------------------------------------------------- output -- */

/* Rates or, `less` being better, seconds; and froe's ratio to each peer. */
static void print(run *r, const char *what, bool less) {
    double froe = bench_median(r->rate[0], ROUNDS);
    printf("%-8s %-12s %10.4g", r->name, what, froe);
    for (int p = 0; p < PEERS; p++) {
        if (r->wrong[p + 1] < 0) {
            printf(" %10s %6s", "-", "");
            continue;
        }
        double rate = bench_median(r->rate[p + 1], ROUNDS);
        printf(" %10.4g %5.2fx", rate, less ? rate / froe : froe / rate);
    }
    bool equal = true;
    for (int p = 0; p < PEERS; p++)
        if (r->wrong[p + 1] > 0)
            printf("   %g of %d differ from %s", r->wrong[p + 1], QUERIES, peers[p]->name), equal = false;
    printf(equal ? "   equal\n" : "\n");
    fflush(stdout);
}

static void begin(run *r) {
    for (int p = 0; p <= PEERS; p++) r->wrong[p] = -1;
}

/* --------------------------------------------------------------------- build -- */

static size_t heap(void) {
    struct mallinfo2 m = mallinfo2();
    return m.uordblks + m.hblkhd;
}

static void time_builds(run *r) {
    double bytes[PEERS + 1] = {0};
    begin(r);
    for (int i = 0; i < ROUNDS; i++) {
        froe_tree_free(r->tree);
        double start = bench_cpu();
        r->tree = bench_build(r->scene, "index", NULL, FROE_LEAF_OWN, 1, NULL);
        r->rate[0][i] = bench_cpu() - start;
        for (int p = 0; p < PEERS; p++) {
            if (r->index[p]) peers[p]->free(r->index[p]);
            size_t before = heap();
            start = bench_cpu();
            r->index[p] = peers[p]->build(r->t, r->n);
            r->rate[p + 1][i] = bench_cpu() - start;
            bytes[p + 1] = (double)(heap() - before);
            if (peers[p]->bytes) bytes[p + 1] = (double)peers[p]->bytes(r->index[p]);
            r->wrong[p + 1] = 0;
        }
    }
    print(r, "build, s", true);
    bytes[0] = (double)froe_tree_report(r->tree).bytes;
    for (int p = 0; p <= PEERS; p++)
        for (int i = 0; i < ROUNDS; i++) r->rate[p][i] = bytes[p] / (double)r->n;
    print(r, "bytes each", true);
    bench_must(froe_query_new(r->tree, &r->query, NULL), NULL);
}

/* -------------------------------------------------------------------- numbers -- */

/* A question whose answer is a number. */
typedef struct question {
    const char *name;
    double (*froe)(run *r, size_t q);
    bool (*takes)(const space_peer *p);
    double (*ask)(const run *r, const space_peer *p, void *index, size_t q);
} question;

static double froe_ray(run *r, size_t q) {
    froe_hit hit;
    bench_must(froe_query_ray(r->query, r->origins + 3 * q, r->directions + 3 * q, INFINITY, &hit, NULL), NULL);
    return hit.object == FROE_NONE ? (double)INFINITY : hit.t;
}
static bool takes_ray(const space_peer *p) {
    return p->ray;
}
static double ask_ray(const run *r, const space_peer *p, void *index, size_t q) {
    return p->ray(index, r->origins + 3 * q, r->directions + 3 * q);
}

static double froe_any(run *r, size_t q) {
    uint32_t object;
    bench_must(froe_query_ray_any(r->query, r->origins + 3 * q, r->directions + 3 * q, INFINITY, &object, NULL), NULL);
    return object != FROE_NONE;
}
static bool takes_any(const space_peer *p) {
    return p->any;
}
static double ask_any(const run *r, const space_peer *p, void *index, size_t q) {
    return p->any(index, r->origins + 3 * q, r->directions + 3 * q);
}

static double froe_near(run *r, size_t q) {
    froe_neighbours near;
    bench_must(froe_query_near(r->query, r->points + 3 * q, 1, INFINITY, &near, NULL), NULL);
    return near.items[0].distance;
}
static bool takes_near(const space_peer *p) {
    return p->near;
}
static double ask_near(const run *r, const space_peer *p, void *index, size_t q) {
    return p->near(index, r->points + 3 * q);
}

static const question questions[] = {{"first hit", froe_ray, takes_ray, ask_ray},
                                     {"any hit", froe_any, takes_any, ask_any},
                                     {"nearest", froe_near, takes_near, ask_near}};

static bool same(const run *r, const space_peer *p, double a, double b) {
    double most = (strcmp(p->name, "Embree") ? 1e-9 : 1e-4) * r->size;
    return a == b || fabs(a - b) <= most;
}

static void time_numbers(run *r, const question *a) {
    const size_t share = QUERIES / ROUNDS;
    begin(r);
    froe_query_statistics(r->query);
    for (int round = 0; round < ROUNDS; round++)
        for (int p = -1; p < PEERS; p++) {
            if (p >= 0 && !a->takes(peers[p])) continue;
            double start = bench_cpu(), wrong = 0;
            for (size_t q = (size_t)round * share; q < ((size_t)round + 1) * share; q++) {
                double x = p < 0 ? a->froe(r, q) : a->ask(r, peers[p], r->index[p], q);
                if (p < 0)
                    r->answers[q] = x;
                else
                    wrong += !same(r, peers[p], x, r->answers[q]);
            }
            r->rate[p + 1][round] = (double)share / (bench_cpu() - start);
            r->wrong[p + 1] = wrong + (round ? r->wrong[p + 1] : 0);
        }
    print(r, a->name, false);
    froe_query_stats s = froe_query_statistics(r->query);
    printf("#        a query: %.1f nodes, %.2f leaves, %.2f objects, %.3f exact numbers\n",
           (double)s.nodes / (double)s.queries, (double)s.leaves / (double)s.queries,
           (double)s.tests / (double)s.queries, (double)s.exact / (double)s.queries);
}

/* The rays of a round in one call, on one thread; peers take theirs one by one. */
static void time_batches(run *r) {
    const size_t share = QUERIES / ROUNDS;
    froe_batch_options o = froe_batch_defaults();
    froe_hit *hits = bench_take(QUERIES, sizeof *hits);
    o.threads = 1;
    begin(r);
    for (size_t round = 0; round < ROUNDS; round++)
        for (int p = -1; p < PEERS; p++) {
            if (p >= 0 && !peers[p]->ray) continue;
            const size_t from = share * round;
            const double *origins = r->origins + 3 * from, *directions = r->directions + 3 * from;
            double start = bench_cpu(), wrong = 0;
            if (p < 0)
                bench_must(froe_batch_ray(r->query, origins, directions, share, INFINITY, &o, hits + from, NULL), NULL);
            for (size_t q = from; p >= 0 && q < from + share; q++) {
                const double t = hits[q].object == FROE_NONE ? (double)INFINITY : hits[q].t;
                wrong += !same(r, peers[p], ask_ray(r, peers[p], r->index[p], q), t);
            }
            r->rate[p + 1][round] = (double)share / (bench_cpu() - start);
            r->wrong[p + 1] = wrong + (round ? r->wrong[p + 1] : 0);
        }
    free(hits);
    print(r, "rays, batch", false);
}

/* -------------------------------------------------------------------- windows -- */

static double checksum(const uint32_t *ids, size_t count) {
    double sum = (double)count;
    for (size_t i = 0; i < count; i++) sum += (double)(ids[i] * 2654435761u >> 12);
    return sum;
}

static void time_windows(run *r, int i) {
    const size_t share = (i ? 1000 : QUERIES) / ROUNDS;
    begin(r);
    for (int round = 0; round < ROUNDS; round++)
        for (int p = -1; p < PEERS; p++) {
            if (p >= 0 && !peers[p]->window) continue;
            double start = bench_cpu(), wrong = 0;
            for (size_t q = (size_t)round * share; q < ((size_t)round + 1) * share; q++) {
                const double *w = r->windows[i] + 6 * q;
                size_t count = p < 0 ? froe_window(r, w) : peers[p]->window(r->index[p], w, w + 3, r->out);
                double x = checksum(r->out, count);
                if (p < 0)
                    r->answers[q] = x;
                else
                    wrong += x != r->answers[q];
            }
            r->rate[p + 1][round] = (double)share / (bench_cpu() - start);
            r->wrong[p + 1] = wrong + (round ? r->wrong[p + 1] : 0);
        }
    print(r, i ? "box 1000" : "box 10", false);
}

/* ---------------------------------------------------------------------- paths -- */

/* Once more with code for processors that can do less. */
static void time_paths(run *r) {
    for (size_t i = 1; space_kernels_at(i); i++) {
        r->query->space->kernels = space_kernels_at(i);
        printf("#        %s\n", packed_kernels_at(i)->name);
        for (size_t a = 0; a < sizeof questions / sizeof *questions; a++) time_numbers(r, questions + a);
        time_batches(r);
        time_windows(r, 0);
        time_windows(r, 1);
    }
    r->query->space->kernels = space_kernels_at(0);
}

/* ---------------------------------------------------------------------- whole -- */

static void bench(const char *kind, size_t n) {
    run r = {.n = 0};
    make_scene(&r, kind, n);
    r.out = bench_take(r.n + MOST, sizeof *r.out);
    r.answers = bench_take(QUERIES, sizeof *r.answers);
    printf("\n%s: %zu triangles\n%-8s %-12s %10s", r.name, r.n, "", "", "froe");
    for (int p = 0; p < PEERS; p++) printf(" %10s froe :", peers[p]->name);
    printf("\n");
    time_builds(&r);
    make_queries(&r);
    for (size_t i = 0; i < sizeof questions / sizeof *questions; i++) time_numbers(&r, questions + i);
    time_batches(&r);
    time_windows(&r, 0);
    time_windows(&r, 1);
    time_paths(&r);
    for (int p = 0; p < PEERS; p++) peers[p]->free(r.index[p]);
    froe_query_free(r.query);
    froe_tree_free(r.tree);
    froe_scene_free(r.scene);
    free(r.t), free(r.out), free(r.answers), free(r.origins), free(r.directions), free(r.points);
    free(r.windows[0]), free(r.windows[1]);
}

int main(int argc, char **argv) {
    static char *all[] = {"fat", "city", "mesh"};
    size_t n = argc > 1 ? strtoull(argv[1], NULL, 10) : 1000000;
    bench_head("an index of triangles, one thread, medians of 5 rounds by processor time", 1);
    printf("# rates are queries a second\n");
    char **kinds = argc > 2 ? argv + 2 : all;
    for (int i = 0, count = argc > 2 ? argc - 2 : 3; i < count; i++) bench(kinds[i], n);
    return 0;
}
