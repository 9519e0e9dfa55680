/* view_growth.c: how pictures without hidden surfaces grow with the scene: time, memory, the graph that orders whole
 * faces.
 *
 *     bench_view_growth [-m LARGEST] [-f FOLDER] KIND... | MESH.off...   a kind of froe_generate, or files
 *
 * Each size, 1,000 to 1,000,000 triangles (-m: fewer), in a process of its own, whose greatest memory is given. Seconds
 * are processor time: tree; look: visible parts of faces; whole: picture of whole faces, which contains another look.
 * Tests: pairs compared for the order, at most 1,000 a visible piece; beyond them a picture is made of fragments, and
 * says so. -f: figures of each kind, view-KIND.svg. */
#include "apart.h"
#include "bench.h"
#include "figure.h"
#include <froe/view.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

enum { TREE, LOOK, WHOLE, BYTES, TRIANGLES, VISIBLE, NODES, ARCS, TESTS, LATE, SHAPES, PAINT, COLUMNS, SIZES = 16 };

typedef struct subject {
    const char *kind;
    size_t want; /* 0: kind is a file */
} subject;

static bool seen(froe_tree *tree, const froe_surface *surface, const froe_projection *view, double *out) {
    froe_visibility_options look = froe_visibility_defaults();
    froe_picture_options paint = froe_picture_defaults();
    uint8_t *none = calloc(froe_surface_edge_count(surface) + 1, 1);
    froe_visibility *visibility;
    froe_picture *picture;
    look.eye = view->eye;
    look.window = view->window, look.window_corners = 4;
    look.edges = none;
    paint.view = view;
    double start = bench_cpu();
    if (!none || froe_visibility_new(tree, surface, &look, &visibility, NULL)) return false;
    out[LOOK] = bench_cpu() - start;
    froe_visibility_free(visibility);
    start = bench_cpu();
    if (froe_picture_new(tree, surface, &paint, &picture, NULL)) return false;
    out[WHOLE] = bench_cpu() - start;
    const froe_picture_report r = froe_picture_statistics(picture);
    out[VISIBLE] = (double)r.visibility.visible_patches, out[NODES] = (double)r.visibility.screen_nodes;
    out[ARCS] = (double)r.arcs, out[TESTS] = (double)r.tests, out[LATE] = (double)r.late;
    out[SHAPES] = (double)r.shapes, out[PAINT] = r.paint;
    froe_picture_free(picture);
    free(none);
    return true;
}

static bool measure(const void *user, double *out) {
    const subject *s = user;
    const froe_camera camera = froe_camera_defaults();
    froe_scene *scene = s->want ? bench_generate(s->kind, s->want, 1) : bench_read(s->kind);
    froe_projection view;
    froe_surface *surface;
    struct rusage usage;
    const double start = bench_cpu();
    froe_tree *tree = bench_build(scene, "density", NULL, 1, 1, NULL);
    out[TREE] = bench_cpu() - start;
    out[TRIANGLES] = (double)froe_scene_object_count(scene);
    if (froe_camera_place(&camera, scene, &view, NULL) || froe_surface_new(scene, NULL, &surface, NULL)) return false;
    const bool ok = seen(tree, surface, &view, out);
    getrusage(RUSAGE_SELF, &usage);
    out[BYTES] = 1024.0 * (double)usage.ru_maxrss;
    froe_surface_free(surface);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return ok;
}

/* False when it failed. */
static bool row(const char *name, const subject *s, double *out) {
    const char *trouble = bench_apart(measure, s, 600, out, COLUMNS);
    if (trouble) {
        printf("%-12s %9zu %s\n", name, s->want, trouble);
        return false;
    }
    const double n = out[TRIANGLES];
    printf("%-12s %9.0f %8.2f %8.2f %8.2f %9.0f %9.0f %9.2f %8.2f %8.2f %6.0f %9.0f %s\n", name, n, 1e6 * out[TREE] / n,
           1e6 * out[LOOK] / n, 1e6 * out[WHOLE] / n, out[BYTES] / n, out[VISIBLE], out[NODES] / out[VISIBLE],
           out[ARCS] / out[VISIBLE], out[TESTS] / out[VISIBLE], out[LATE], out[SHAPES],
           froe_paint_name((froe_paint)out[PAINT]));
    fflush(stdout);
    return true;
}

/* Microseconds a triangle. */
static void draw(const char *folder, const char *kind, const double *x, double y[4][SIZES], size_t count) {
    static const char *const names[2] = {"tree", "picture of whole faces"};
    double per[2][SIZES];
    char name[64], title[64];
    plot_series series[2];
    plot_options o = plot_defaults();
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; i < count; i++) per[k][i] = 1e6 * y[k][i] / x[i];
        series[k] = (plot_series){names[k], x, per[k], count};
    }
    snprintf(name, sizeof name, "view-%s.svg", kind);
    snprintf(title, sizeof title, "Hidden surfaces of %s", kind);
    o.title = title, o.x_label = "triangles", o.y_label = "microseconds a triangle", o.log_x = true;
    bench_figure(folder, name, series, 2, &o);
}

static void grow(const char *kind, double largest, const char *folder) {
    double x[SIZES], y[4][SIZES], out[COLUMNS];
    static const int fitted[4] = {TREE, WHOLE, BYTES, TESTS};
    size_t count = 0;
    for (double n = 1000; n <= 1.01 * largest && count < SIZES; n *= 3.1622776601683795) {
        const subject s = {kind, (size_t)n};
        if (!row(kind, &s, out)) break;
        x[count] = out[TRIANGLES];
        for (int k = 0; k < 4; k++) y[k][count] = out[fitted[k]] > 0 ? out[fitted[k]] : 1e-6;
        count++;
    }
    if (folder && count) draw(folder, kind, x, y, count);
    if (count < 3) return;
    printf("%-12s grows as n^ tree %.2f, whole %.2f, memory %.2f, tests %.2f\n", kind, bench_exponent(x, y[0], count),
           bench_exponent(x, y[1], count), bench_exponent(x, y[2], count), bench_exponent(x, y[3], count));
}

int main(int argc, char **argv) {
    double largest = 1e6;
    const char *folder = NULL;
    int at = 1;
    for (; at + 2 < argc && argv[at][0] == '-'; at += 2)
        if (argv[at][1] == 'm')
            largest = strtod(argv[at + 1], NULL);
        else
            folder = argv[at + 1];
    bench_head("growth of pictures without hidden surfaces, one thread", 1);
    printf("%-12s %9s %8s %8s %8s %9s %9s %9s %8s %8s %6s %9s\n", "", "", "tree us", "look us", "whole us", "bytes",
           "visible", "screen", "arcs", "tests", "", "");
    printf("%-12s %9s %8s %8s %8s %9s %9s %9s %8s %8s %6s %9s %s\n", "scene", "n", "/n", "/n", "/n", "/n", "faces",
           "/face", "/face", "/face", "late", "shapes", "made of");
    for (; at < argc; at++) {
        const subject file = {argv[at], 0};
        double out[COLUMNS];
        char name[32];
        if (strchr(argv[at], '.'))
            bench_name(argv[at], name), row(name, &file, out);
        else
            grow(argv[at], largest, folder);
    }
    return 0;
}
