/* support.c: see support.h. */
#include "support.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

double fuzz_double(fuzz_bytes *bytes) {
    static const double odd[] = {0.5,       -0.0, 1e308,   -1e308, 0x1p-1074,
                                 0x1p-1022, 0.1,  1.0 / 3, 1e16,   0x1.fffffffffffffp0};
    const uint8_t what = fuzz_byte(bytes);
    if (what < 0xe0) return (double)(what % 16) - 8;
    if (what < 0xf0) return odd[what % (sizeof odd / sizeof *odd)];
    uint64_t bits = 0;
    double x;
    for (int i = 0; i < 8; i++) bits = bits << 8 | fuzz_byte(bytes);
    memcpy(&x, &bits, sizeof x);
    return x;
}

enum { MOST_OBJECTS = 24, MOST_CORNERS = 6 };

static size_t corners_of(froe_kind kind, fuzz_bytes *bytes) {
    switch (kind) {
    case FROE_POINT:
    case FROE_BALL:
        return 1;
    case FROE_SEGMENT:
    case FROE_BOX:
        return 2;
    default:
        return 1 + fuzz_byte(bytes) % MOST_CORNERS;
    }
}

void fuzz_add_batch(froe_scene *scene, fuzz_bytes *bytes) {
    const int dim = froe_scene_dim(scene);
    double coords[MOST_OBJECTS * MOST_CORNERS * FROE_MAX_DIM], radii[MOST_OBJECTS];
    size_t starts[MOST_OBJECTS + 1] = {0};
    froe_objects o = froe_objects_defaults();
    o.kind = (froe_kind)(fuzz_byte(bytes) % FROE_KIND_COUNT);
    o.count = 1 + fuzz_byte(bytes) % MOST_OBJECTS;
    const size_t corners = corners_of(o.kind, bytes);
    for (size_t i = 0; i < o.count; i++) starts[i + 1] = starts[i] + corners, radii[i] = fuzz_double(bytes);
    for (size_t i = 0; i < starts[o.count] * (size_t)dim; i++) coords[i] = fuzz_double(bytes);
    o.coords = coords;
    o.point_count = starts[o.count];
    if (o.kind == FROE_POLYGON || o.kind == FROE_HULL) o.starts = starts;
    if (o.kind == FROE_BALL) o.radii = radii;
    froe_diagnostic why;
    if (froe_scene_add(scene, &o, &why) && !memchr(why.message, '\0', sizeof why.message))
        fuzz_complain("message without an end", &why);
}

void fuzz_complain(const char *what, const froe_diagnostic *why) {
    fprintf(stderr, "%s: %s: %s\n", what, froe_status_name(why->status), why->message);
    abort();
}

static void give_up(const char *what) {
    perror(what);
    exit(2);
}

void fuzz_file(const char *prefix, const char *suffix, const uint8_t *data, size_t size, char *path, size_t capacity) {
    const char *folder = getenv("TMPDIR");
    snprintf(path, capacity, "%s/froe-fuzz-%ld%s", folder ? folder : ".", (long)getpid(), suffix);
    FILE *file = fopen(path, "wb");
    if (!file) give_up(path);
    fputs(prefix, file);
    if (size) fwrite(data, 1, size, file);
    if (fclose(file)) give_up(path);
}
