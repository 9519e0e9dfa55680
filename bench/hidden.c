/* hidden.c: pictures without hidden surfaces, froe beside gl2ps (best root, occlusion cull): same scene, same view,
 * same colours, a page of 1000 x 1000.
 *
 *     bench_hidden SCENE[:y] ...        :y when y points up
 *
 * Wrong: of 2000 x 2000 samples where a ray meets something, those at which the file, its fills taken as they are
 * written, shows another colour (where two faces are equally deep nothing counts); in blocks: with all eight neighbours
 * wrong, too, more than rounding does. Seams: pixels that, drawn by librsvg on white, differ from the exact picture
 * (16 samples a pixel) by more than 16 (40) of 255. Seconds, processor time: from tree (gl2ps: from triangles)
 * to file, median of five; froe's tree, which serves all views, is given apart. */
#include "bench.h"
#include "peers/gl2ps.h"
#include "svg_shapes.h"
#include <cairo.h>
#include <froe/render.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PAGE = 1000, WRONG_GRID = 2000, EXACT_GRID = 4 * PAGE, RUNS = 5 };

typedef struct subject {
    char name[32];
    froe_scene *scene;
    froe_tree *tree;
    froe_surface *surface;
    froe_render_options options;
    froe_projection view;
    oracle_triangles triangles;
    uint32_t *colours; /* per patch */
    double build_seconds;
} subject;

/* ------------------------------------------------------------------------ making -- */

static void note_colour(void *user, uint32_t object, uint32_t colour) {
    subject *s = user;
    s->colours[froe_surface_patch_of(s->surface, object)] = colour;
}

/* froe's own colours, which it writes beside the objects; gl2ps gets the same. */
static void find_colours(subject *s) {
    froe_diagnostic why = {0};
    froe_render_options o = s->options;
    oracle_canvas canvas = oracle_canvas_new((oracle_grid){1, 1, {0, 0}}, &s->view);
    o.ids = FROE_IDS_FACE;
    bench_must(froe_render(s->tree, "colours.svg", &o, NULL, &why), &why);
    s->colours = bench_take(1, (froe_surface_patch_count(s->surface) + 1) * sizeof *s->colours);
    svg_paint("colours.svg", &canvas, note_colour, s);
    oracle_canvas_free(&canvas);
}

static void open_subject(subject *s, const char *arg) {
    char path[4096];
    const char *colon = strrchr(arg, ':');
    const bool y_up = colon && !strcmp(colon, ":y");
    froe_diagnostic why = {0};
    froe_render_report report;
    snprintf(path, sizeof path, "%.*s", (int)(y_up ? colon - arg : (long)strlen(arg)), arg);
    bench_name(path, s->name);
    s->scene = bench_read(path);
    const double start = bench_cpu();
    s->tree = bench_build(s->scene, "auto", NULL, 1, 1, NULL);
    s->build_seconds = bench_cpu() - start;
    bench_must(froe_surface_new(s->scene, NULL, &s->surface, &why), &why);
    s->options = froe_render_defaults();
    s->options.lines = 0;
    s->options.own_colours = true; /* all opaque */
    if (y_up) {
        const double eye[3] = {3, 2, 5}, up[3] = {0, 1, 0};
        memcpy(s->options.camera.eye, eye, sizeof eye);
        memcpy(s->options.camera.up, up, sizeof up);
    }
    bench_must(froe_render(s->tree, "froe.svg", &s->options, &report, &why), &why);
    s->view = report.view;
    s->triangles = oracle_triangles_new(s->scene, s->surface, &s->view, false);
    find_colours(s);
}

static void close_subject(subject *s) {
    free(s->colours);
    oracle_triangles_free(&s->triangles);
    froe_surface_free(s->surface);
    froe_tree_free(s->tree);
    froe_scene_free(s->scene);
}

static double ours(subject *s) {
    froe_diagnostic why = {0};
    double seconds[RUNS];
    for (int i = 0; i < RUNS; i++) {
        const double start = bench_cpu();
        bench_must(froe_render(s->tree, "froe.svg", &s->options, NULL, &why), &why);
        seconds[i] = bench_cpu() - start;
    }
    return bench_median(seconds, RUNS);
}

/* Triangles in the window coordinates of OpenGL: z linear in 1 / depth, 0.01 the nearest, 0.99 the farthest. */
static size_t window_coordinates(const subject *s, double *out, unsigned *colours) {
    double near = INFINITY, far = 0;
    size_t n = 0;
    for (uint32_t v = 0; v < froe_scene_vertex_count(s->scene); v++) {
        const double *x = froe_scene_vertex(s->scene, v);
        double depth = 0;
        for (int k = 0; k < 3; k++) depth -= s->view.back[k] * (x[k] - s->view.origin[k]);
        near = fmin(near, depth), far = fmax(far, depth);
    }
    for (uint32_t i = 0; i < froe_scene_object_count(s->scene); i++) {
        const uint32_t patch = froe_surface_patch_of(s->surface, i);
        if (patch == FROE_NONE) continue;
        for (uint32_t c = 0; c < 3; c++) {
            const double *x = froe_scene_vertex(s->scene, froe_scene_corner(s->scene, i, c));
            double page[2] = {0, 0}, depth = 0;
            froe_project(&s->view, x, page);
            for (int k = 0; k < 3; k++) depth -= s->view.back[k] * (x[k] - s->view.origin[k]);
            out[9 * n + 3 * c] = page[0];
            out[9 * n + 3 * c + 1] = PAGE - page[1];
            out[9 * n + 3 * c + 2] = 0.01 + 0.98 * (1 / near - 1 / depth) / (1 / near - 1 / far);
        }
        colours[n++] = s->colours[patch];
    }
    return n;
}

static double theirs(subject *s) {
    const size_t most = froe_scene_object_count(s->scene);
    double *triangles = bench_take(1, 9 * most * sizeof *triangles), seconds[RUNS];
    unsigned *colours = bench_take(1, most * sizeof *colours);
    const size_t n = window_coordinates(s, triangles, colours);
    for (int i = 0; i < RUNS; i++) {
        const double start = bench_cpu();
        if (!peer_gl2ps_picture(triangles, colours, n, "gl2ps.svg")) exit(1);
        seconds[i] = bench_cpu() - start;
    }
    free(triangles);
    free(colours);
    return bench_median(seconds, RUNS);
}

/* --------------------------------------------------------------------- measuring -- */

typedef struct verdict {
    svg_count file;
    size_t covered, wrong, blocks, seams[2];
} verdict;

static bool is_wrong(const oracle_canvas *c, const oracle_nearest *n, const uint32_t *colours, size_t i) {
    if (n->patch[i] == FROE_NONE || n->tie[i]) return false;
    return c->top[i] == FROE_NONE || c->layers[c->top[i]].patch != colours[n->patch[i]];
}

static void count_wrong(const subject *s, const char *path, const oracle_nearest *n, verdict *v) {
    const uint32_t side = n->grid.wide;
    oracle_canvas canvas = oracle_canvas_new(n->grid, &s->view);
    uint8_t *wrong = bench_take(1, (size_t)side * side);
    v->file = svg_paint(path, &canvas, NULL, NULL);
    for (size_t i = 0; i < (size_t)side * side; i++) {
        wrong[i] = is_wrong(&canvas, n, s->colours, i);
        v->covered += n->patch[i] != FROE_NONE && !n->tie[i];
        v->wrong += wrong[i];
    }
    for (size_t y = 1; y + 1 < side; y++)
        for (size_t x = 1; x + 1 < side; x++) {
            int around = 0;
            for (size_t k = 0; k < 9; k++) around += wrong[(y + k / 3 - 1) * side + x + k % 3 - 1];
            v->blocks += around == 9;
        }
    free(wrong);
    oracle_canvas_free(&canvas);
}

/* Pixels whose colours differ from the mean of 16 samples by more than 16 and 40. */
static void count_seams(const subject *s, const char *path, const oracle_nearest *n, verdict *v) {
    char command[256];
    snprintf(command, sizeof command, "rsvg-convert -b white -w %d -h %d -o raster.png %s", PAGE, PAGE, path);
    if (system(command) != 0) { /* NOLINT(cert-env33-c): a bench, and its own words */
        fprintf(stderr, "hidden: no rsvg-convert (librsvg2-bin): no seams counted\n");
        return;
    }
    cairo_surface_t *image = cairo_image_surface_create_from_png("raster.png");
    const unsigned char *data = cairo_image_surface_get_data(image);
    const int stride = cairo_image_surface_get_stride(image);
    for (size_t y = 0; data && y < PAGE; y++)
        for (size_t x = 0; x < PAGE; x++) {
            int sum[3] = {0, 0, 0}, most = 0;
            for (size_t k = 0; k < 16; k++) {
                const uint32_t patch = n->patch[(4 * y + k / 4) * EXACT_GRID + 4 * x + k % 4];
                const uint32_t colour = patch == FROE_NONE ? 0xffffff : s->colours[patch];
                for (int c = 0; c < 3; c++) sum[c] += (int)(colour >> 8 * c & 255);
            }
            for (int c = 0; c < 3; c++) {
                const int off = abs(16 * data[y * (size_t)stride + 4 * x + (size_t)c] - sum[c]);
                most = off > most ? off : most;
            }
            v->seams[0] += most > 16 * 16;
            v->seams[1] += most > 16 * 40;
        }
    cairo_surface_destroy(image);
}

static void print(const char *name, const char *who, const verdict *v, double seconds, double build) {
    printf("%-12s %-6s %9zu %7zu %7zu %8zu %9zu %8zu %8zu %9.3f", name, who, v->covered, v->wrong, v->blocks,
           v->file.shapes, v->file.bytes, v->seams[0], v->seams[1], seconds);
    if (build > 0) printf("   (tree %.3f)", build);
    printf("\n");
    fflush(stdout);
}

static void compare(const char *arg) {
    subject s = {.scene = NULL};
    verdict v[2] = {{.wrong = 0}, {.wrong = 0}};
    open_subject(&s, arg);
    const double seconds[2] = {ours(&s), theirs(&s)};
    const char *const files[2] = {"froe.svg", "gl2ps.svg"};
    const oracle_grid grids[2] = {{WRONG_GRID, WRONG_GRID, {0.31415926, -0.27182818}},
                                  {EXACT_GRID, EXACT_GRID, {0, 0}}};
    oracle_nearest some = oracle_nearest_new(&s.triangles, grids[0]);
    for (int i = 0; i < 2; i++) count_wrong(&s, files[i], &some, v + i);
    oracle_nearest_free(&some);
    oracle_nearest all = oracle_nearest_new(&s.triangles, grids[1]);
    for (int i = 0; i < 2; i++) count_seams(&s, files[i], &all, v + i);
    oracle_nearest_free(&all);
    print(s.name, "froe", v, seconds[0], s.build_seconds);
    print(s.name, "gl2ps", v + 1, seconds[1], 0);
    printf("%-12s ratio gl2ps / froe: shapes %.1f, bytes %.1f, seams %.2f, seconds %.1f\n", s.name,
           (double)v[1].file.shapes / (double)v[0].file.shapes, (double)v[1].file.bytes / (double)v[0].file.bytes,
           (double)v[1].seams[0] / (double)v[0].seams[0], seconds[1] / seconds[0]);
    close_subject(&s);
}

int main(int argc, char **argv) {
    bench_head("pictures without hidden surfaces, beside gl2ps with best root and occlusion cull", 1);
    printf("%-12s %-6s %9s %7s %7s %8s %9s %8s %8s %9s\n", "scene", "", "samples", "wrong", "blocks", "shapes", "bytes",
           "seams", "> 40", "cpu s");
    for (int i = 1; i < argc; i++) compare(argv[i]);
    const char *const made[] = {"colours.svg", "froe.svg", "gl2ps.svg", "raster.png"};
    for (size_t i = 0; i < sizeof made / sizeof *made; i++) remove(made[i]);
    return 0;
}
