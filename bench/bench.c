/* bench.c: see bench.h. */
#include "bench.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>
#include <unistd.h>

double bench_now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double bench_cpu(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void print_processor(void) {
    char line[256];
    FILE *f = fopen("/proc/cpuinfo", "r");
    while (f && fgets(line, sizeof line, f))
        if (!strncmp(line, "model name", 10)) {
            printf("%s", strchr(line, ':') + 2);
            break;
        }
    if (f) fclose(f);
}

void bench_head(const char *title, unsigned long long seed) {
    struct utsname u;
    uname(&u);
    printf("# %s\n# froe %s (%s), seed %llu, compiler %s, %s %s, %ld processors: ", title, froe_version(), FROE_COMMIT,
           seed, __VERSION__, u.sysname, u.machine, sysconf(_SC_NPROCESSORS_ONLN));
    print_processor();
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double bench_median(double *values, size_t count) {
    qsort(values, count, sizeof *values, ascending);
    return 0.5 * (values[(count - 1) / 2] + values[count / 2]);
}

#define STEP 0x9e3779b97f4a7c15u

uint64_t bench_state(uint64_t numbers) {
    return numbers * STEP;
}

uint64_t bench_draw(uint64_t *state) {
    uint64_t x = *state += STEP;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

double bench_unit(uint64_t *state) {
    return (double)(bench_draw(state) >> 11) * 0x1p-53;
}

void bench_must(froe_status status, const froe_diagnostic *diag) {
    if (!status) return;
    fprintf(stderr, "bench: %s\n", diag ? diag->message : froe_status_text(status));
    exit(1);
}

void *bench_take(size_t count, size_t size) {
    void *memory = calloc(count ? count : 1, size);
    bench_must(memory ? FROE_OK : FROE_E_MEMORY, NULL);
    return memory;
}

froe_scene *bench_read(const char *path) {
    froe_diagnostic diag = {0};
    froe_scene *scene = NULL;
    bench_must(froe_read(path, NULL, &scene, NULL, &diag), &diag);
    return scene;
}

froe_scene *bench_segments(const double *xyxy, size_t n) {
    froe_diagnostic diag = {0};
    froe_scene *scene = NULL;
    froe_objects o = froe_objects_defaults();
    o.kind = FROE_SEGMENT, o.count = n, o.coords = xyxy;
    froe_status status = froe_scene_new(2, NULL, &scene);
    bench_must(status ? status : froe_scene_add(scene, &o, &diag), &diag);
    return scene;
}

static froe_scene *scattered(size_t n, unsigned long long seed) {
    double *xyxy = bench_scatter(n, seed);
    froe_scene *scene = bench_segments(xyxy, n);
    free(xyxy);
    return scene;
}

froe_scene *bench_generate(const char *kind, size_t n, unsigned long long seed) {
    froe_diagnostic diag = {0};
    froe_scene *scene = NULL;
    if (!strcmp(kind, "scatter")) return scattered(n, seed);
    bench_must(froe_generate(kind, n, seed, NULL, &scene, &diag), &diag);
    return scene;
}

froe_tree *bench_build_by(bench_builder *builder, froe_scene *scene, const char *method, const char *settings,
                          uint32_t leaf, unsigned threads, double *seconds) {
    froe_diagnostic diag = {0};
    froe_tree *tree = NULL;
    froe_build_options o = froe_build_defaults();
    o.method = method;
    o.settings = settings;
    o.leaf = leaf;
    o.threads = threads;
    double start = bench_now();
    bench_must(builder(scene, &o, &tree, &diag), &diag);
    if (seconds) *seconds = bench_now() - start;
    return tree;
}

froe_tree *bench_build(froe_scene *scene, const char *method, const char *settings, uint32_t leaf, unsigned threads,
                       double *seconds) {
    return bench_build_by(froe_build, scene, method, settings, leaf, threads, seconds);
}

double bench_exponent(const double *x, const double *y, size_t count) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0, n = (double)count;
    for (size_t i = 0; i < count; i++) {
        double u = log(x[i]), v = log(y[i]);
        sx += u, sy += v, sxx += u * u, sxy += u * v;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

void bench_name(const char *path, char name[32]) {
    const char *base = strrchr(path, '/');
    snprintf(name, 32, "%s", base ? base + 1 : path);
    char *dot = strchr(name, '.');
    if (dot) *dot = 0;
}
