/* reading.c: from a file to a scene, beside GDAL and assimp, which read it into arrays, as lines of results.
 *
 *     bench_reading FILE...
 *
 * One thread, processor time, five rounds in turn; the file is in the system's cache. */
#include "peers/reading.h"
#include "bench.h"
#include "json.h"
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

enum { ROUNDS = 5 };

static size_t by_froe(const char *path) {
    froe_scene *scene = bench_read(path);
    const size_t count = froe_scene_vertex_count(scene);
    froe_scene_free(scene);
    return count;
}

static const struct {
    const char *name;
    reading_fn *read;
} programs[] = {{"froe", by_froe}, {"GDAL", reading_by_ogr}, {"assimp", reading_by_assimp}};
enum { PROGRAMS = sizeof programs / sizeof *programs };

static void measure(const char *path) {
    double seconds[PROGRAMS][ROUNDS];
    size_t points[PROGRAMS];
    struct stat about;
    const char *name = strrchr(path, '/') ? strrchr(path, '/') + 1 : path;
    if (stat(path, &about)) return;
    for (int p = 0; p < PROGRAMS; p++) points[p] = programs[p].read(path);
    for (int round = 0; round < ROUNDS; round++)
        for (int p = 0; p < PROGRAMS; p++) {
            const double start = bench_cpu();
            if (points[p]) programs[p].read(path);
            seconds[p][round] = bench_cpu() - start;
        }
    for (int p = 0; p < PROGRAMS; p++)
        if (points[p])
            json_line(&(json_result){"reading", name, (size_t)about.st_size, programs[p].name, "seconds", seconds[p],
                                     ROUNDS, NULL});
}

int main(int argc, char **argv) {
    for (int i = 1; i < argc; i++) measure(argv[i]);
    return 0;
}
