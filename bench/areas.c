/* areas.c: which area of a map is a point in? froe beside a trapezoidal map and a tree of boxes with prepared polygons.
 *
 *     bench_areas [BORDERS...]        default: 10^4, 10^5, 10^6
 *
 * The map is a crooked grid of areas of 16 segments each, so that every border is there twice. One thread, processor
 * time; medians of 5 rounds of the same points. Answers are compared: each area is one face, each face one area. */
#include "peers/areas.h"
#include "bench.h"
#include "peers/index.h"
#include <froe/query.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 5, EDGE = 4, RING = 4 * EDGE, MOST_TRAPEZOIDS = 1000000, POINTS = 100000 };

typedef struct map {
    size_t side, areas;
    double *rings;         /* [area]: RING points */
    peer_segment *borders; /* each once */
    size_t border_count;
    double *points;
} map;

typedef struct answers {
    double rate[ROUNDS];
    int64_t *found;
    bool there;
} answers;

/* ------------------------------------------------------------------- scene -- */

static uint64_t state = 1;
static double any(double below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 33) * 0x1p-31 * below;
}

/* Point i of the border that begins at lattice point (x, y) and goes right (axis 0) or up (1): whole numbers, the same
 * from both sides. */
static void border_point(uint64_t x, uint64_t y, int axis, int i, double out[2]) {
    const double step = 4096;
    const uint64_t saved = state, at[2] = {x + (axis == 0 && i == EDGE), y + (axis == 1 && i == EDGE)};
    const uint64_t part = i == EDGE ? 0 : (uint64_t)i;
    state = ((at[0] * 1000003 + at[1]) * 2 + (part ? (uint64_t)axis : 0)) * EDGE + part;
    any(1), any(1);
    const double reach = part ? step / 16 : step / 8;
    for (int k = 0; k < 2; k++)
        out[k] = floor((double)at[k] * step + (part && k == axis ? step / EDGE * (double)part : 0) + any(reach));
    state = saved;
}

static void add_ring(map *m, size_t x, size_t y) {
    double *ring = m->rings + (y * m->side + x) * 2 * RING;
    for (int i = 0; i < EDGE; i++) {
        border_point(x, y, 0, i, ring + 2 * i);
        border_point(x + 1, y, 1, i, ring + 2 * (EDGE + i));
        border_point(x, y + 1, 0, EDGE - i, ring + 2 * (2 * EDGE + i));
        border_point(x, y, 1, EDGE - i, ring + 2 * (3 * EDGE + i));
    }
}

static void add_borders(map *m, size_t x, size_t y, int axis) {
    for (int i = 0; i < EDGE; i++) {
        double a[2], b[2];
        border_point(x, y, axis, i, a);
        border_point(x, y, axis, i + 1, b);
        const bool swap = b[0] < a[0] || (b[0] == a[0] && b[1] < a[1]);
        m->borders[m->border_count++] =
            swap ? (peer_segment){b[0], b[1], a[0], a[1]} : (peer_segment){a[0], a[1], b[0], b[1]};
    }
}

static map make_map(size_t segments) {
    map m = {.side = (size_t)sqrt((double)segments / RING)};
    m.areas = m.side * m.side;
    m.rings = bench_take(m.areas * 2 * RING, sizeof *m.rings);
    m.borders = bench_take(2 * (m.side + 1) * (m.side + 1) * EDGE, sizeof *m.borders);
    m.points = bench_take(2 * POINTS * ROUNDS, sizeof *m.points);
    for (size_t y = 0; y <= m.side; y++)
        for (size_t x = 0; x <= m.side; x++) {
            if (x < m.side && y < m.side) add_ring(&m, x, y);
            if (x < m.side) add_borders(&m, x, y, 0);
            if (y < m.side) add_borders(&m, x, y, 1);
        }
    for (size_t i = 0; i < 2 * POINTS * ROUNDS; i++) m.points[i] = floor(any((double)m.side * 4096)) + 0.5;
    return m;
}

static froe_scene *make_scene(const map *m) {
    froe_scene *scene;
    bench_must(froe_scene_new(2, NULL, &scene), NULL);
    for (size_t a = 0; a < m->areas; a++) {
        double ends[4 * RING];
        const double *ring = m->rings + a * 2 * RING;
        for (size_t i = 0; i < RING; i++) {
            memcpy(ends + 4 * i, ring + 2 * i, 2 * sizeof *ends);
            memcpy(ends + 4 * i + 2, ring + 2 * ((i + 1) % RING), 2 * sizeof *ends);
        }
        froe_objects o = froe_objects_defaults();
        o.kind = FROE_SEGMENT, o.count = RING, o.coords = ends;
        bench_must(froe_scene_add_group(scene, &(froe_group){.name = "area"}, &o.group), NULL);
        bench_must(froe_scene_add(scene, &o, NULL), NULL);
    }
    return scene;
}

/* ------------------------------------------------------------------ asking -- */

/* One at a time, or the round as a batch. */
static void ask_froe(froe_query *q, const map *m, bool batch, answers *out) {
    froe_batch_options o = froe_batch_defaults();
    o.threads = 1;
    for (size_t round = 0; round < ROUNDS; round++) {
        const double *points = m->points + 2 * POINTS * round;
        const double start = bench_cpu();
        if (batch) {
            froe_answers all;
            bench_must(froe_batch_groups(q, points, POINTS, &o, &all, NULL), NULL);
            froe_answers_free(&all);
        } else {
            for (size_t i = 0; i < POINTS; i++) {
                froe_list one;
                bench_must(froe_query_groups(q, points + 2 * i, &one, NULL), NULL);
                out->found[round * POINTS + i] = one.count == 1 ? one.ids[0] : -1 - (int64_t)one.count;
            }
        }
        out->rate[round] = POINTS / (bench_cpu() - start);
    }
    out->there = true;
}

typedef int64_t find_fn(void *index, double x, double y);

static void ask_peer(find_fn *find, void *index, const map *m, answers *out) {
    for (size_t round = 0; round < ROUNDS; round++) {
        const double start = bench_cpu();
        for (size_t i = round * POINTS; i < (round + 1) * POINTS; i++)
            out->found[i] = find(index, m->points[2 * i], m->points[2 * i + 1]);
        out->rate[round] = POINTS / (bench_cpu() - start);
    }
    out->there = true;
}

/* Does every area of froe's have one answer of the other's? Points on borders and outside may differ. */
static bool agree(const map *m, const answers *froe, const answers *other) {
    int64_t *face = bench_take(m->areas, sizeof *face);
    bool same = true;
    for (size_t i = 0; i < POINTS * ROUNDS; i++) {
        const int64_t area = froe->found[i];
        if (area < 0) continue;
        if (!face[area]) face[area] = other->found[i] + 1;
        same = same && face[area] == other->found[i] + 1;
    }
    free(face);
    return same;
}

static void print(const char *who, const char *what, double build, answers *a, double rate, bool same) {
    if (a->there)
        printf("%-18s %8.2f %12.4g %10.2f   %s\n", who, build, bench_median(a->rate, ROUNDS),
               rate / bench_median(a->rate, ROUNDS), same ? what : "ANSWERS DIFFER");
}

static void bench(size_t segments) {
    map m = make_map(segments);
    froe_scene *scene = make_scene(&m);
    answers froe = {.found = bench_take(POINTS * ROUNDS, sizeof *froe.found)}, batch = {0},
            other = {.found = bench_take(POINTS * ROUNDS, sizeof *other.found)};
    printf("\n%zu areas, %zu segments\n%-18s %8s %12s %10s\n", m.areas, froe_scene_object_count(scene), "", "build, s",
           "points/s", "froe is x");
    const char *const methods[] = {"index", "density"};
    double rate = 0;
    for (int i = 0; i < 2; i++) {
        double start = bench_cpu();
        froe_tree *tree = bench_build(scene, methods[i], NULL, FROE_LEAF_OWN, 1, NULL);
        const double built = bench_cpu() - start;
        froe_query *q;
        froe_list none;
        bench_must(froe_query_new(tree, &q, NULL), NULL);
        start = bench_cpu();
        bench_must(froe_query_groups(q, m.points, &none, NULL), NULL);
        const double prepared = bench_cpu() - start;
        char what[64];
        snprintf(what, sizeof what, "and %.2f s to prepare", prepared);
        ask_froe(q, &m, false, &froe);
        ask_froe(q, &m, true, &batch);
        if (!i) rate = bench_median(froe.rate, ROUNDS);
        print(methods[i], what, built, &froe, rate, true);
        print("  in batches", "", built, &batch, rate, true);
        froe_query_free(q);
        froe_tree_free(tree);
    }
#ifdef HAVE_GEOS
    double start = bench_cpu();
    void *areas = peer_areas_new(m.rings, m.areas, RING);
    double built = bench_cpu() - start;
    ask_peer(peer_areas_find, areas, &m, &other);
    print("GEOS", "STRtree, prepared", built, &other, rate, agree(&m, &froe, &other));
    peer_areas_free(areas);
#endif
#ifdef HAVE_CGAL
    if (m.border_count <= MOST_TRAPEZOIDS) {
        start = bench_cpu();
        void *index = peer_trapezoids.build(m.borders, m.border_count);
        built = bench_cpu() - start;
        ask_peer(peer_trapezoids.locate, index, &m, &other);
        print("CGAL trapezoids", "faces, borders once", built, &other, rate, agree(&m, &froe, &other));
        peer_trapezoids.free(index);
    }
#endif
    free(froe.found), free(other.found), free(m.rings), free(m.borders), free(m.points);
    froe_scene_free(scene);
    fflush(stdout);
}

int main(int argc, char **argv) {
    bench_head("the area that a point is in, one thread, medians of 5 rounds by processor time", 1);
    for (int i = 1; i < argc; i++) bench(strtoull(argv[i], NULL, 10));
    for (size_t n = 10000; argc == 1 && n <= 1000000; n *= 10) bench(n);
    return 0;
}
