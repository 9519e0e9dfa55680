/* motion.c: a partition that follows moving segments, beside building one again and again, as lines of results.
 *
 *     bench_motion [KIND [EVENTS [N...]]]     default: moving, 30,000 events at 1,000, 10,000 and 100,000 segments
 *
 * One thread, processor time. Beside it in the same run, for the same segments in the same order of cuts:
 *     rebuild      froe_build() of the method cylindrical, of a scene that is given for nothing: at each event,
 *                  or 60 times a second of the motion, which misses what lies between two frames
 *     reinsert     each segment taken out and put in again where it is now, 60 times a second */
#include "bench.h"
#include "json.h"
#include <froe/kinetic.h>
#include <stdio.h>
#include <stdlib.h>

enum { FRAMES = 60, SAMPLE = 40, MOST_RUNS = 5 };

typedef struct ride {
    froe_motion *motion;
    froe_kinetic *kinetic;
    uint64_t most, events;
} ride;

static bool count(void *user, const froe_event *event) {
    (void)event;
    ride *r = user;
    return ++r->events < r->most;
}

/* Seconds for the events. */
static double follow(ride *r, uint64_t events) {
    froe_diagnostic diag = {0};
    r->events = 0, r->most = events;
    double start = bench_cpu();
    froe_status status = froe_kinetic_advance(r->kinetic, froe_motion_window(r->motion).end, count, r, &diag);
    if (status != FROE_E_CANCELLED) bench_must(status, &diag);
    return bench_cpu() - start;
}

/* Median seconds to build the present. */
static double rebuild(const ride *r, size_t n) {
    double *xyxy = malloc(4 * n * sizeof *xyxy), seconds[MOST_RUNS], time = froe_kinetic_time(r->kinetic);
    size_t runs = n > 20000 ? 1 : MOST_RUNS;
    if (!xyxy) exit(1);
    for (uint32_t i = 0; i < n; i++) {
        froe_moving_object o = froe_motion_object(r->motion, i);
        for (uint32_t e = 0; e < 2; e++) froe_motion_position(r->motion, o.vertices[e], time, xyxy + 4 * i + 2 * e);
    }
    froe_scene *scene = bench_segments(xyxy, n);
    for (size_t i = 0; i < runs; i++) {
        double start = bench_cpu();
        froe_tree *tree = bench_build(scene, "cylindrical", NULL, 0, 1, NULL);
        seconds[i] = bench_cpu() - start;
        froe_tree_free(tree);
    }
    froe_scene_free(scene);
    free(xyxy);
    return bench_median(seconds, runs);
}

/* Seconds to take one segment out and in again: a vertex gets the plan that it has. */
static double reinsert(ride *r) {
    enum { KNOTS = 64 };
    froe_diagnostic diag = {0};
    size_t n = froe_motion_object_count(r->motion), done = 0;
    double start = bench_cpu();
    for (size_t i = 0; i < n; i += n / SAMPLE + 1, done++) {
        uint32_t vertex = froe_motion_object(r->motion, (uint32_t)i).vertices[0];
        double times[KNOTS], xy[2 * KNOTS], controls[2 * KNOTS], seconds[2 * KNOTS];
        size_t count = froe_motion_knot_count(r->motion, vertex);
        for (size_t j = 0; j < count && j < KNOTS; j++) {
            froe_moving_knot k = froe_motion_knot(r->motion, vertex, j);
            times[j] = k.time;
            for (size_t c = 0; c < 2; c++)
                xy[2 * j + c] = k.at[c], controls[2 * j + c] = k.control[c], seconds[2 * j + c] = k.second[c];
        }
        bench_must(froe_kinetic_replan(r->kinetic, vertex, count, times, xy, controls, seconds, &diag), &diag);
    }
    return (bench_cpu() - start) / (double)done;
}

static void put(const char *kind, size_t n, const char *program, const char *measure, const double *value) {
    json_line(&(json_result){"motion", kind, n, program, measure, value, 1, NULL});
}

static void measure(const char *kind, size_t n, uint64_t events) {
    ride r = {NULL, NULL, 0, 0};
    froe_diagnostic diag = {0};
    const froe_kinetic_options o = froe_kinetic_defaults();
    bench_must(froe_generate_motion(kind, n, 1, NULL, &r.motion, &diag), &diag);
    bench_must(froe_kinetic_new(r.motion, &o, NULL, &r.kinetic, &diag), &diag);
    follow(&r, events / 10 + 1); /* memory that was never touched */
    froe_kinetic_stats before = froe_kinetic_statistics(r.kinetic);
    double from = froe_kinetic_time(r.kinetic), seconds = follow(&r, events);
    double passed = froe_kinetic_time(r.kinetic) - from, done = (double)r.events;
    froe_kinetic_stats after = froe_kinetic_statistics(r.kinetic);
    double again = rebuild(&r, n), once = reinsert(&r);
    double each = seconds / done, moved = seconds / passed; /* for a second of the motion */
    const double touched = (double)(after.nodes_touched - before.nodes_touched) / done, rate = done / seconds;
    const double ratios[] = {again / each, FRAMES * again / moved, FRAMES * once * (double)n / moved};
    put(kind, n, "froe", "events per second", &rate);
    put(kind, n, "froe", "nodes touched an event", &touched);
    put(kind, n, "froe", "events in the time of one rebuild", &ratios[0]);
    put(kind, n, "froe", "work of 60 rebuilds a second", &ratios[1]);
    put(kind, n, "froe", "work of 60 insertions of all a second", &ratios[2]);
    froe_kinetic_free(r.kinetic);
    froe_motion_free(r.motion);
}

int main(int argc, char **argv) {
    static const size_t sizes[] = {1000, 10000, 100000};
    const char *kind = argc > 1 ? argv[1] : "moving";
    uint64_t events = argc > 2 ? strtoull(argv[2], NULL, 10) : 30000;
    for (int i = 3; i < argc; i++) measure(kind, strtoull(argv[i], NULL, 10), events);
    for (size_t i = 0; argc < 4 && i < sizeof sizes / sizeof *sizes; i++) measure(kind, sizes[i], events);
    return 0;
}
