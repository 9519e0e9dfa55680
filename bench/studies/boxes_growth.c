/* boxes_growth.c: how trees of boxes grow with n, and what balance costs. Tables, and two figures as SVG.
 *
 *     bench_boxes_growth FOLDER [LARGEST]      into FOLDER: boxes-pieces.svg, boxes-balance.svg; default 10^6
 *
 * Tobola and Nechvile, theorem 5.4: linear size at low directional density, O(n log^2 n) time, and a trade-off between
 * balance and size. Leaf 1, one thread, processor time. */
#include "bench.h"
#include "figure.h"
#include <froe/measure.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIZES = 7, MOST = 16 };

typedef struct line {
    const char *name, *settings;
    double n[SIZES], pieces[SIZES], height[SIZES], seconds[SIZES];
    size_t count;
} line;

static void build(line *l, const char *kind, size_t n) {
    froe_scene *scene = bench_generate(kind, n, 1);
    double start = bench_cpu();
    froe_tree *tree = bench_build(scene, "directional", l->settings, 1, 1, NULL);
    froe_report r = froe_tree_report(tree);
    l->seconds[l->count] = bench_cpu() - start;
    l->n[l->count] = (double)r.objects;
    l->pieces[l->count] = (double)r.fragments / (double)r.objects;
    l->height[l->count++] = (double)r.height;
    froe_tree_free(tree);
    froe_scene_free(scene);
}

/* Exponents are fitted from 10^4 on. */
static void print(const line *l, const char *name) {
    double sizes[SIZES];
    size_t from = 0, last = l->count - 1;
    for (size_t i = 0; i < l->count; i++) sizes[i] = l->pieces[i] * l->n[i];
    while (from < last && l->n[from] < 9000) from++;
    printf("%-34s", name);
    for (size_t i = 0; i < l->count; i += 2) printf(" %7.3f (%3.0f)", l->pieces[i], l->height[i]);
    if (last > from)
        printf("   n^%.3f  time n^%.3f", bench_exponent(l->n + from, sizes + from, l->count - from),
               bench_exponent(l->n + from, l->seconds + from, l->count - from));
    printf("\n");
    fflush(stdout);
}

static void head(const char *what, size_t largest) {
    printf("%-34s", what);
    for (size_t n = 1000; n <= largest; n *= 10) printf(" %13zu", n);
    printf("   from 10^4\n");
}

/* 1000, 3160, 10^4, ... */
static void grow(line *l, const char *kind, size_t largest) {
    for (size_t ten = 1000; ten <= largest && l->count < SIZES; ten *= 10) {
        build(l, kind, ten);
        if (ten < largest) build(l, kind, ten * 316 / 100);
    }
}

/* --------------------------------------------------------------------- figures -- */

static void figure(const char *folder, const char *name, const char *title, const char *y_label, const line *lines,
                   size_t count, bool heights) {
    plot_series series[MOST];
    plot_options o = plot_defaults();
    for (size_t i = 0; i < count; i++)
        series[i] =
            (plot_series){lines[i].name, lines[i].n, heights ? lines[i].height : lines[i].pieces, lines[i].count};
    o.title = title, o.x_label = "boxes", o.y_label = y_label, o.log_x = true;
    bench_figure(folder, name, series, count, &o);
}

/* ---------------------------------------------------------------------- tables -- */

static void sizes(const char *folder, size_t largest) {
    static const char *const kinds[] = {"boxes-3d", "sticks", "slabs", "towers", "panels", "rows", "moons", "plates"};
    enum { KINDS = sizeof kinds / sizeof *kinds };
    static line lines[KINDS];
    head("# pieces a box (height)", largest);
    for (size_t k = 0; k < KINDS; k++) {
        lines[k].name = kinds[k];
        grow(lines + k, kinds[k], largest);
        print(lines + k, kinds[k]);
    }
    figure(folder, "boxes-pieces.svg", "Pieces a box, directional", "pieces a box", lines, KINDS, false);
}

static void balances(const char *folder, size_t largest) {
    static const char *const settings[] = {"balance=0 slack=0.75", "balance=0 slack=0.25", "balance=0 slack=0",
                                           "balance=0.5 slack=0", "balance=1 slack=0"};
    enum { SETTINGS = sizeof settings / sizeof *settings };
    static const char *const kinds[] = {"boxes-3d", "slabs"};
    head("# pieces a box (height)", largest);
    for (size_t k = 0; k < 2; k++) {
        line lines[SETTINGS];
        for (size_t i = 0; i < SETTINGS; i++) {
            char name[64];
            lines[i] = (line){.name = settings[i], .settings = settings[i]};
            grow(lines + i, kinds[k], largest);
            snprintf(name, sizeof name, "%s, %s", kinds[k], settings[i]);
            print(lines + i, name);
        }
        if (k) figure(folder, "boxes-balance.svg", "Height, slabs", "height", lines, SETTINGS, true);
    }
}

/* Neither property follows from the other (Tobola and Nechvile, section 6). */
static void properties(void) {
    static const char *const kinds[] = {"boxes-3d", "moons", "plates", "bars"};
    printf("%-10s %8s %12s %16s %16s %9s\n", "# scene", "boxes", "clutter >=", "two-dir., most", "paired, most",
           "pieces/n");
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        for (size_t n = 300; n <= 4800; n *= 4) {
            froe_scene *scene = bench_generate(kinds[k], n, 1);
            froe_measure_options o = froe_measure_defaults();
            froe_clutter clutter = {0};
            froe_directional d = {0};
            o.samples = 0;
            if (froe_measure_clutter(scene, &o, &clutter, NULL) || froe_measure_directional(scene, 0.5, &o, &d, NULL))
                exit(1);
            froe_tree *tree = bench_build(scene, "directional", NULL, 1, 1, NULL);
            froe_report r = froe_tree_report(tree);
            printf("%-10s %8llu %12u %16.0f %16.0f %9.3f\n", kinds[k], (unsigned long long)r.objects, clutter.lower,
                   d.two_directional.most, d.paired.most, (double)r.fragments / (double)r.objects);
            froe_tree_free(tree);
            froe_scene_free(scene);
        }
}

int main(int argc, char **argv) {
    size_t largest = argc > 2 ? strtoull(argv[2], NULL, 10) : 1000000;
    if (argc < 2) return fprintf(stderr, "bench_boxes_growth FOLDER [LARGEST]\n"), 1;
    bench_head("growth of trees of boxes, directional, one thread", 1);
    sizes(argv[1], largest);
    printf("\n");
    balances(argv[1], largest);
    printf("\n");
    properties();
    return 0;
}
