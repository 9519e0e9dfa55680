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
#include "json.h"
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
    double *window;    /* the triangles as gl2ps takes them, and their colours */
    unsigned *window_colours;
    size_t window_count;
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

static void close_subject(subject *s) {
    free(s->colours), free(s->window), free(s->window_colours);
    oracle_triangles_free(&s->triangles);
    froe_surface_free(s->surface);
    froe_tree_free(s->tree);
    froe_scene_free(s->scene);
}

static froe_tree *tree_for_drawing(froe_scene *scene) {
    froe_build_options o = froe_build_defaults();
    froe_diagnostic why = {0};
    froe_tree *tree = NULL;
    o.purpose = "draw", o.threads = 1;
    bench_must(froe_build(scene, &o, &tree, &why), &why);
    return tree;
}

/* From the scene to the file, the tree included; and the same with a tree that is there. */
static void ours(subject *s, double seconds[2]) {
    froe_diagnostic why = {0};
    const double start = bench_cpu();
    froe_tree *tree = tree_for_drawing(s->scene);
    const double built = bench_cpu() - start;
    bench_must(froe_render(tree, "froe.svg", &s->options, NULL, &why), &why);
    seconds[0] = bench_cpu() - start, seconds[1] = seconds[0] - built;
    froe_tree_free(tree);
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

static void open_subject(subject *s, const char *arg) {
    char path[4096];
    const char *colon = strrchr(arg, ':');
    const bool y_up = colon && !strcmp(colon, ":y");
    froe_diagnostic why = {0};
    froe_render_report report;
    snprintf(path, sizeof path, "%.*s", (int)(y_up ? colon - arg : (long)strlen(arg)), arg);
    bench_name(path, s->name);
    s->scene = bench_read(path);
    s->tree = tree_for_drawing(s->scene);
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
    const size_t most = froe_scene_object_count(s->scene);
    s->window = bench_take(9 * most, sizeof *s->window);
    s->window_colours = bench_take(most, sizeof *s->window_colours);
    s->window_count = window_coordinates(s, s->window, s->window_colours);
}

static double theirs(const subject *s) {
    const double start = bench_cpu();
    if (!peer_gl2ps_picture(s->window, s->window_colours, s->window_count, "gl2ps.svg")) exit(1);
    return bench_cpu() - start;
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

/* Pixels whose colours differ from the mean of 16 samples by more than 16 and 40; SIZE_MAX: not counted. */
static void count_seams(const subject *s, const char *path, const oracle_nearest *n, verdict *v) {
    char command[256];
    snprintf(command, sizeof command, "rsvg-convert -b white -w %d -h %d -o raster.png %s", PAGE, PAGE, path);
    if (system(command) != 0) { /* NOLINT(cert-env33-c): a bench, and its own words */
        fprintf(stderr, "hidden: rsvg-convert (librsvg2-bin) is missing: no pixels are compared\n");
        v->seams[0] = SIZE_MAX;
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

static void print(const subject *s, const char *who, const verdict *v, const double *seconds) {
    const double shapes = (double)v->file.shapes, bytes = (double)v->file.bytes, pixels = (double)v->seams[0];
    const double wrong = 100 * (double)v->wrong / (double)v->covered, blocks = (double)v->blocks;
    json_result r = {.work = "picture", .scene = s->name, .objects = froe_scene_object_count(s->scene), .program = who};
    const struct {
        const char *measure;
        const double *values;
        size_t count;
    } all[] = {{"shapes", &shapes, 1},       {"bytes", &bytes, 1},
               {"percent wrong", &wrong, 1}, {"wrong amid wrong ones", &blocks, 1},
               {"pixels off", &pixels, 1},   {"seconds", seconds, RUNS}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        if (v->seams[0] == SIZE_MAX && all[i].values == &pixels) continue;
        r.measure = all[i].measure, r.values = all[i].values, r.count = all[i].count;
        json_line(&r);
    }
}

static void compare(const char *arg) {
    subject s = {.scene = NULL};
    verdict v[2] = {{.wrong = 0}, {.wrong = 0}};
    double seconds[3][RUNS];
    open_subject(&s, arg);
    for (int i = 0; i < RUNS; i++) {
        double both[2];
        ours(&s, both);
        seconds[0][i] = both[0], seconds[1][i] = both[1], seconds[2][i] = theirs(&s);
    }
    const char *const files[2] = {"froe.svg", "gl2ps.svg"};
    const oracle_grid grids[2] = {{WRONG_GRID, WRONG_GRID, {0.31415926, -0.27182818}},
                                  {EXACT_GRID, EXACT_GRID, {0, 0}}};
    oracle_nearest some = oracle_nearest_new(&s.triangles, grids[0]);
    for (int i = 0; i < 2; i++) count_wrong(&s, files[i], &some, v + i);
    oracle_nearest_free(&some);
    oracle_nearest all = oracle_nearest_new(&s.triangles, grids[1]);
    for (int i = 0; i < 2; i++) count_seams(&s, files[i], &all, v + i);
    oracle_nearest_free(&all);
    print(&s, "froe", v, seconds[0]);
    print(&s, "gl2ps", v + 1, seconds[2]);
    json_line(&(json_result){"picture", s.name, froe_scene_object_count(s.scene), "froe, tree there", "seconds",
                             seconds[1], RUNS, NULL});
    close_subject(&s);
}

int main(int argc, char **argv) {
    for (int i = 1; i < argc; i++) compare(argv[i]);
    const char *const made[] = {"colours.svg", "froe.svg", "gl2ps.svg", "raster.png"};
    for (size_t i = 0; i < sizeof made / sizeof *made; i++) remove(made[i]);
    return 0;
}
