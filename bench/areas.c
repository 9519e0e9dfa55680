/* areas.c: which area of a map is a point in? froe beside a trapezoidal map and a tree of boxes with prepared polygons.
 *
 *     bench_areas [BORDERS | FILE]...        default: 10^4, 10^5, 10^6
 *
 * A number makes a crooked grid of areas of 16 segments each, so that every border is there twice. One thread,
 * processor time; medians of 5 rounds of the same points. Answers are compared: to the point with those of GEOS; in
 * each face of CGAL's map all must be the same. */
#include "area_map.h"
#include "bench.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 5, EDGE = 4, RING = 4 * EDGE, POINTS = 100000, MOST_CYLINDERS = 200000 };

typedef struct answers {
    double rate[ROUNDS];
    int64_t *found;
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

static void add_ring(froe_scene *scene, uint64_t x, uint64_t y) {
    double ring[2 * RING], ends[4 * RING];
    for (int i = 0; i < EDGE; i++) {
        border_point(x, y, 0, i, ring + 2 * i);
        border_point(x + 1, y, 1, i, ring + 2 * (EDGE + i));
        border_point(x, y + 1, 0, EDGE - i, ring + 2 * (2 * EDGE + i));
        border_point(x, y, 1, EDGE - i, ring + 2 * (3 * EDGE + i));
    }
    for (size_t i = 0; i < RING; i++) {
        memcpy(ends + 4 * i, ring + 2 * i, 2 * sizeof *ends);
        memcpy(ends + 4 * i + 2, ring + 2 * ((i + 1) % RING), 2 * sizeof *ends);
    }
    froe_objects o = froe_objects_defaults();
    o.kind = FROE_SEGMENT, o.count = RING, o.coords = ends;
    bench_must(froe_scene_add_group(scene, &(froe_group){.name = "area"}, &o.group), NULL);
    bench_must(froe_scene_add(scene, &o, NULL), NULL);
}

static froe_scene *make_grid(size_t segments) {
    const uint64_t side = (uint64_t)sqrt((double)segments / RING);
    froe_scene *scene;
    bench_must(froe_scene_new(2, NULL, &scene), NULL);
    for (uint64_t y = 0; y < side; y++)
        for (uint64_t x = 0; x < side; x++) add_ring(scene, x, y);
    return scene;
}

/* Anywhere within the bounds. */
static double *draw_points(const froe_scene *scene) {
    double lo[2], hi[2], *points = bench_take((size_t)2 * POINTS * ROUNDS, sizeof *points);
    if (!froe_scene_bounds(scene, lo, hi)) exit(1);
    for (size_t i = 0; i < (size_t)2 * POINTS * ROUNDS; i++) points[i] = lo[i % 2] + any(hi[i % 2] - lo[i % 2]);
    return points;
}

/* ------------------------------------------------------------------ asking -- */

/* An area, -1 for none, and for several less than that. */
static int64_t name_of(const uint32_t *ids, size_t count) {
    int64_t name = count == 1 ? (int64_t)ids[0] : -1;
    for (size_t i = 0; i < count && count > 1; i++) name = (name * 1000003 - ids[i]) % 1000000007;
    return name;
}

static void ask_singly(froe_query *q, const double *points, answers *out) {
    for (size_t round = 0; round < ROUNDS; round++) {
        const double start = bench_cpu();
        for (size_t i = round * POINTS; i < (round + 1) * POINTS; i++) {
            froe_list one;
            bench_must(froe_query_groups(q, points + 2 * i, &one, NULL), NULL);
            out->found[i] = name_of(one.ids, one.count);
        }
        out->rate[round] = POINTS / (bench_cpu() - start);
    }
}

/* False: the answers are not those of single questions. */
static bool ask_in_batches(froe_query *q, const double *points, answers *out) {
    froe_batch_options o = froe_batch_defaults();
    bool same = true;
    o.threads = 1;
    for (size_t round = 0; round < ROUNDS; round++) {
        froe_answers all;
        const double start = bench_cpu();
        bench_must(froe_batch_groups(q, points + 2 * POINTS * round, POINTS, &o, &all, NULL), NULL);
        out->rate[round] = POINTS / (bench_cpu() - start);
        for (size_t i = 0; i < POINTS; i++)
            same &=
                out->found[round * POINTS + i] == name_of(all.ids + all.starts[i], all.starts[i + 1] - all.starts[i]);
        froe_answers_free(&all);
    }
    return same;
}

typedef int64_t find_fn(void *index, double x, double y);

static void ask_peer(find_fn *find, void *index, const double *points, answers *out) {
    for (size_t round = 0; round < ROUNDS; round++) {
        const double start = bench_cpu();
        for (size_t i = round * POINTS; i < (round + 1) * POINTS; i++)
            out->found[i] = find(index, points[2 * i], points[2 * i + 1]);
        out->rate[round] = POINTS / (bench_cpu() - start);
    }
}

/* ----------------------------------------------------------------- printing -- */

/* The same wherever a point is in one area or none. */
static bool equal(const answers *froe, const answers *other) {
    bool same = true;
    for (size_t i = 0; i < POINTS * ROUNDS; i++) same &= froe->found[i] < -1 || froe->found[i] == other->found[i];
    return same;
}

static int compare_faces(const void *a, const void *b) {
    const int64_t *s = a, *t = b;
    return s[0] != t[0] ? s[0] < t[0] ? -1 : 1 : (s[1] > t[1]) - (s[1] < t[1]);
}

/* Has every face one answer? What is on a border, -1, is left out. */
static bool constant(const answers *froe, const answers *faces) {
    int64_t(*both)[2] = bench_take((size_t)POINTS * ROUNDS, sizeof *both);
    bool same = true;
    for (size_t i = 0; i < POINTS * ROUNDS; i++) both[i][0] = faces->found[i], both[i][1] = froe->found[i];
    qsort(both, POINTS * ROUNDS, sizeof *both, compare_faces);
    for (size_t i = 1; i < POINTS * ROUNDS; i++)
        same &= both[i][0] == -1 || both[i][0] != both[i - 1][0] || both[i][1] == both[i - 1][1];
    free(both);
    return same;
}

static void print(const char *who, const char *what, double build, answers *a, double rate, bool same) {
    printf("%-18s %8.3f %12.4g %10.2f   %s\n", who, build, bench_median(a->rate, ROUNDS),
           rate / bench_median(a->rate, ROUNDS), same ? what : "ANSWERS DIFFER");
    fflush(stdout);
}

/* What single questions say goes to `out`, and how many there are a second to `rate`, of the first method. */
static void bench_method(froe_scene *scene, const char *method, const double *points, double *rate, answers *out) {
    answers batch = {.found = out->found};
    froe_query *q;
    froe_list none;
    char what[64];
    double start = bench_cpu();
    froe_tree *tree = bench_build(scene, method, NULL, FROE_LEAF_OWN, 1, NULL);
    const double built = bench_cpu() - start;
    bench_must(froe_query_new(tree, &q, NULL), NULL);
    start = bench_cpu();
    bench_must(froe_query_groups(q, points, &none, NULL), NULL);
    snprintf(what, sizeof what, "and %.3f s to prepare", bench_cpu() - start);
    ask_singly(q, points, out);
    if (*rate == 0) *rate = bench_median(out->rate, ROUNDS);
    print(method, what, built, out, *rate, true);
    const bool same = ask_in_batches(q, points, &batch);
    print("  in batches", "", built, &batch, *rate, same);
    froe_query_free(q);
    froe_tree_free(tree);
}

static void bench(froe_scene *scene, const char *name) {
    const size_t n = froe_scene_object_count(scene);
    double *points = draw_points(scene), rate = 0;
    area_map map = area_map_of(scene);
    answers froe = {.found = bench_take((size_t)POINTS * ROUNDS, sizeof *froe.found)},
            other = {.found = bench_take((size_t)POINTS * ROUNDS, sizeof *other.found)};
    printf("\n%s: %zu areas, %zu segments\n%-18s %8s %12s %10s\n", name, froe_scene_group_count(scene), n, "",
           "build, s", "points/s", "index is x");
    bench_method(scene, "index", points, &rate, &froe);
    bench_method(scene, "density", points, &rate, &froe);
    if (n <= MOST_CYLINDERS) bench_method(scene, "cylindrical", points, &rate, &froe);
#ifdef HAVE_GEOS
    double start = bench_cpu();
    void *areas = peer_areas_new(&map.rings);
    double built = bench_cpu() - start;
    ask_peer(peer_areas_find, areas, points, &other);
    print("GEOS", "STRtree, prepared", built, &other, rate, equal(&froe, &other));
    peer_areas_free(areas);
#endif
#ifdef HAVE_CGAL
    if (area_map_is_plain(&map)) {
        start = bench_cpu();
        void *index = peer_trapezoids.build(map.borders, map.border_count);
        built = bench_cpu() - start;
        ask_peer(peer_trapezoids.locate, index, points, &other);
        print("CGAL trapezoids", "faces, borders once", built, &other, rate, constant(&froe, &other));
        peer_trapezoids.free(index);
    } else {
        printf("%-18s borders meet elsewhere than in their corners\n", "CGAL trapezoids");
    }
#endif
    free(froe.found), free(other.found), free(points);
    area_map_free(&map);
    froe_scene_free(scene);
}

static void bench_argument(const char *argument) {
    char *end;
    const size_t segments = strtoull(argument, &end, 10);
    char name[32] = "grid";
    if (*end) bench_name(argument, name);
    bench(*end ? bench_read(argument) : make_grid(segments), name);
}

int main(int argc, char **argv) {
    bench_head("the area that a point is in, one thread, medians of 5 rounds by processor time", 1);
    static const char *const defaults[] = {"10000", "100000", "1000000"};
    for (int i = 1; i < argc; i++) bench_argument(argv[i]);
    for (int i = 0; argc == 1 && i < 3; i++) bench_argument(defaults[i]);
    return 0;
}
