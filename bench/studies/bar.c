/* bar.c: how many nodes approximate range queries visit in trees of fat cells, and in others.
 *
 *     bench_bar [FOLDER]
 *
 * Prints tables: nodes against 1 / eps, against what is reported, against n; long thin ranges; guards that are
 * forgotten or not, and guards of three kinds (de Berg and Streppel, theorems 1 and 3). Counts, which are the same on
 * every machine. With FOLDER, writes figures there: bar-*.svg. A minute. */
#include "bench.h"
#include "build/options.h"
#include "figure.h"
#include <froe/query.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { QUERIES = 100, EXPONENTS = 12, SERIES = 8 };

typedef struct spec {
    const char *name, *method, *settings;
} spec;
static const spec specs[] = {{"bar, 3 directions", "bar", "directions=3"},
                             {"bar", "bar", NULL},
                             {"bar, cubes", "bar", "directions=0"},
                             {"kd", "kd", NULL},
                             {"quad", "quad", NULL},
                             {"converted from bar", "converted", "from=bar"}};
enum { SPECS = sizeof specs / sizeof *specs };

static bool serves(const spec *s, const froe_scene *scene) {
    const froe_method_info *m;
    const int dim = froe_scene_dim(scene);
    if (dim == 3 && s->settings && strstr(s->settings, "=3")) return false;
    for (size_t i = 0; (m = froe_method_at(i)) != NULL; i++) {
        if (!strcmp(m->name, s->method) && froe_method_serves(m, scene, FROE_LEAF_OWN))
            return strcmp(s->method, "converted") != 0 || froe_scene_kind_count(scene, FROE_SEGMENT);
    }
    return false;
}

static double draw(uint64_t *state) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

static froe_scene *scene_of(int dim, froe_kind kind, size_t n, double *coords) {
    froe_scene *scene;
    froe_objects o = froe_objects_defaults();
    o.kind = kind, o.count = n, o.coords = coords;
    bench_must(froe_scene_new(dim, NULL, &scene), NULL);
    bench_must(froe_scene_add(scene, &o, NULL), NULL);
    free(coords);
    return scene;
}

/* ------------------------------------------------------------------- asking -- */

typedef struct cost {
    double nodes, found;
} cost;

/** Ranges of one kind and size, at many places. */
typedef froe_range range_fn(uint64_t *state, const froe_scene *scene, double size, double *points);

static froe_range cube(uint64_t *state, const froe_scene *scene, double size, double *points) {
    froe_range r = froe_range_defaults();
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], side = 0;
    const int dim = froe_scene_dim(scene);
    froe_scene_bounds(scene, lo, hi);
    for (int k = 0; k < dim; k++) side = fmax(side, hi[k] - lo[k]);
    for (int k = 0; k < dim; k++) {
        points[k] = lo[k] + (hi[k] - lo[k] - size * side) * draw(state);
        points[dim + k] = points[k] + size * side;
    }
    r.points = points;
    return r;
}

/** A capsule of length 0.8, `size` thick, nearly upright, between the lines of make_lines(). */
static froe_range needle(uint64_t *state, const froe_scene *scene, double size, double *points) {
    froe_range r = froe_range_defaults();
    (void)scene;
    points[0] = 0.3 + 0.2 * draw(state);
    points[1] = 0.1;
    points[2] = points[0] + 0.05 * draw(state);
    points[3] = 0.9;
    r.shape = FROE_SHAPE_CAPSULE;
    r.points = points;
    r.radius = size / 2;
    return r;
}

static cost ask(const froe_tree *tree, range_fn *fn, double size, double eps) {
    froe_query *q;
    uint64_t state = 1, found = 0, count;
    double points[2 * FROE_MAX_DIM];
    bench_must(froe_query_new(tree, &q, NULL), NULL);
    for (int i = 0; i < QUERIES; i++) {
        froe_range r = fn(&state, froe_tree_scene(tree), size, points);
        r.eps = eps;
        bench_must(froe_query_count(q, &r, &count, NULL), NULL);
        found += count;
    }
    const froe_query_stats s = froe_query_statistics(q);
    froe_query_free(q);
    return (cost){(double)s.nodes / QUERIES, (double)found / QUERIES};
}

/* ------------------------------------------------------------------ figures -- */

typedef struct figure {
    plot_series series[SERIES];
    double x[SERIES][16], y[SERIES][16];
    size_t count;
} figure;

static void add(figure *f, const char *name) {
    f->series[f->count] = (plot_series){name, f->x[f->count], f->y[f->count], 0};
    f->count++;
}
static void point(figure *f, double x, double y) {
    plot_series *s = &f->series[f->count - 1];
    f->x[f->count - 1][s->count] = x;
    f->y[f->count - 1][s->count++] = y;
}

static void save(const figure *f, const char *folder, const char *name, const char *title, const char *x) {
    char file[64];
    plot_options o = plot_defaults();
    if (!folder) return;
    snprintf(file, sizeof file, "bar-%s.svg", name);
    o.title = title, o.x_label = x, o.y_label = "nodes visited";
    o.log_x = o.log_y = true;
    bench_figure(folder, file, f->series, f->count, &o);
}

/* ------------------------------------------------------------------- tables -- */

static froe_scene *make_points(int dim, size_t n) {
    double *x = bench_take(n * (size_t)dim, sizeof(double));
    uint64_t state = 7;
    for (size_t i = 0; i < n * (size_t)dim; i++) x[i] = draw(&state);
    return scene_of(dim, FROE_POINT, n, x);
}

/** Points within 10^-4 of the two lines x = 0 and x = 1: medians cut the room between them into strips. */
static froe_scene *make_lines(size_t n) {
    double *x = bench_take(2 * n, sizeof(double));
    uint64_t state = 9;
    for (size_t i = 0; i < n; i++) {
        x[2 * i] = (double)(i % 2) + 1e-4 * draw(&state);
        x[2 * i + 1] = draw(&state);
    }
    return scene_of(2, FROE_POINT, n, x);
}

static froe_tree *build(froe_scene *scene, const spec *s) {
    return bench_build_by(build_tuned, scene, s->method, s->settings, 1, 1, NULL);
}

/** Nodes for eps = 2^-1 .. 2^-EXPONENTS and 0, ranges of a fixed size. Slope: of the first six. */
static void against_eps(const char *what, froe_scene *scene, range_fn *fn, double size, const char *folder,
                        const char *name) {
    figure f = {.count = 0};
    printf("\n%s, n = %zu\n\n| 1/eps |", what, froe_scene_object_count(scene));
    for (int e = 1; e <= EXPONENTS; e++) printf(" %g |", ldexp(1, e));
    printf(" exact | slope |\n|---|");
    for (int e = 0; e <= EXPONENTS + 1; e++) printf("---|");
    printf("\n");
    for (int i = 0; i < SPECS; i++) {
        if (!serves(specs + i, scene)) continue;
        froe_tree *tree = build(scene, specs + i);
        add(&f, specs[i].name);
        printf("| %s |", specs[i].name);
        for (int e = 1; e <= EXPONENTS; e++) {
            point(&f, ldexp(1, e), ask(tree, fn, size, ldexp(1, -e)).nodes);
            printf(" %.0f |", f.y[f.count - 1][e - 1]);
        }
        printf(" %.0f | %.2f |\n", ask(tree, fn, size, 0).nodes, bench_exponent(f.x[f.count - 1], f.y[f.count - 1], 6));
        froe_tree_free(tree);
    }
    save(&f, folder, name, what, "1/eps");
    froe_scene_free(scene);
}

/** Ranges of growing size at one eps, and exactly. */
static void against_found(const char *what, froe_scene *scene) {
    printf("\n%s, n = %zu: nodes for eps = 1/8 / exact, by what is found exactly\n\n| found |", what,
           froe_scene_object_count(scene));
    froe_tree *tree = build(scene, specs + 1);
    for (int e = 8; e > 0; e--) printf(" %.0f |", ask(tree, cube, ldexp(1, -e), 0).found);
    froe_tree_free(tree);
    printf("\n|---|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < SPECS; i++) {
        if (!serves(specs + i, scene)) continue;
        tree = build(scene, specs + i);
        printf("| %s |", specs[i].name);
        for (int e = 8; e > 0; e--)
            printf(" %.0f / %.0f |", ask(tree, cube, ldexp(1, -e), 0.125).nodes,
                   ask(tree, cube, ldexp(1, -e), 0).nodes);
        printf("\n");
        froe_tree_free(tree);
    }
    froe_scene_free(scene);
}

/** The square that the points of make_ring() lie around. */
static froe_range middle(uint64_t *state, const froe_scene *scene, double size, double *points) {
    froe_range r = froe_range_defaults();
    (void)state, (void)scene, (void)size;
    for (int k = 0; k < 2; k++) points[k] = 1.0 / 3, points[2 + k] = 2.0 / 3;
    r.points = points;
    return r;
}

enum { EVERYWHERE = 10000, RING = 64 }; /* 1 / eps of the ring */

/** Points everywhere, and k more within eps diameters of the border of the middle square, beyond it. */
static froe_scene *make_ring(size_t k) {
    const size_t n = EVERYWHERE + k;
    const double width = sqrt(2) / 3 / RING;
    double *x = bench_take(2 * n, sizeof(double));
    uint64_t state = 13;
    for (size_t i = 0; i < n; i++) {
        const double along = 1.0 / 3 + draw(&state) / 3, out = width * draw(&state);
        const int axis = i % 2, far = i / 2 % 2;
        x[2 * i + (size_t)axis] = i < k ? along : draw(&state);
        x[2 * i + 1 - (size_t)axis] = i >= k ? draw(&state) : far ? 2.0 / 3 + out : 1.0 / 3 - out;
    }
    return scene_of(2, FROE_POINT, n, x);
}

/** What lies near the border is all that an exact search pays for, beside log n + 1/eps. */
static void against_near(const char *folder) {
    figure f = {.count = 0};
    printf("\nPoints within 1/%d diameter of the border, %d others: nodes of the exact search\n\n| k_eps |", RING,
           EVERYWHERE);
    for (size_t k = 64; k <= 65536; k *= 4) printf(" %zu |", k);
    printf("\n|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < SPECS; i++) {
        if (!strcmp(specs[i].method, "converted")) continue;
        add(&f, specs[i].name);
        printf("| %s |", specs[i].name);
        for (size_t k = 64; k <= 65536; k *= 4) {
            froe_scene *scene = make_ring(k);
            froe_tree *tree = build(scene, specs + i);
            point(&f, (double)k, ask(tree, middle, 0, 0).nodes);
            printf(" %.0f |", f.y[f.count - 1][f.series[f.count - 1].count - 1]);
            froe_tree_free(tree);
            froe_scene_free(scene);
        }
        printf("\n");
    }
    save(&f, folder, "near", "Nodes against what lies near the border, exact search", "k_eps");
}

static void against_n(const char *what, froe_scene *make(size_t n), const char *folder, const char *name) {
    figure f = {.count = 0};
    printf("\n%s, eps = 1/8, a third of the side: nodes (height)\n\n| n | 1000 | 4000 | 16000 | 64000 |\n", what);
    printf("|---|---|---|---|---|\n");
    for (int i = 0; i < SPECS; i++) {
        froe_scene *scene = make(100);
        const bool served = serves(specs + i, scene);
        froe_scene_free(scene);
        if (!served) continue;
        add(&f, specs[i].name);
        printf("| %s |", specs[i].name);
        for (size_t n = 1000; n <= 64000; n *= 4) {
            scene = make(n);
            froe_tree *tree = build(scene, specs + i);
            point(&f, (double)n, ask(tree, cube, 1.0 / 3, 0.125).nodes);
            printf(" %.0f (%d) |", f.y[f.count - 1][f.series[f.count - 1].count - 1],
                   (int)froe_tree_report(tree).height);
            froe_tree_free(tree);
            froe_scene_free(scene);
        }
        printf("\n");
    }
    save(&f, folder, name, what, "n");
}

static froe_scene *plane_points(size_t n) {
    return make_points(2, n);
}
static froe_scene *scatter(size_t n) {
    return bench_generate("scatter", n, 1);
}
static froe_scene *cuboids(size_t n) {
    return bench_generate("cuboids", n, 1);
}

/* ------------------------------------------------------------------ pruning -- */

/** Segments on parallel lines x + y = c, 2 < c < 3, and four far away, so that the corner below belongs to the scene.
 */
static double *make_diagonals(size_t n) {
    double *x = bench_take(4 * n, sizeof(double)), *s = x;
    uint64_t state = 11;
    for (size_t i = 0; i < n; i++, s += 4) {
        const double c = 2 + (double)i / (double)n, u = draw(&state), v = draw(&state);
        s[0] = u, s[1] = c - u, s[2] = c - v, s[3] = v;
        if (i < 4) s[0] = i % 2 ? 6 : -6, s[1] = i / 2 ? 6 : -6, s[2] = s[0] + 0.01, s[3] = s[1];
    }
    return x;
}

/** The eight guards of each segment, where the first and last of four neighbouring supporting lines meet: those of the
 * tree of `bar`, from their definition. */
static froe_scene *guards_of(const double *segments, size_t n) {
    static const double normals[8][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    double *x = bench_take(16 * n, sizeof(double));
    for (size_t i = 0; i < n; i++)
        for (int k = 0; k < 8; k++) {
            const double *s = segments + 4 * i, *a = normals[k], *b = normals[(k + 3) % 8];
            const double c = fmin(a[0] * s[0] + a[1] * s[1], a[0] * s[2] + a[1] * s[3]);
            const double d = fmin(b[0] * s[0] + b[1] * s[1], b[0] * s[2] + b[1] * s[3]);
            const double det = a[0] * b[1] - a[1] * b[0];
            x[16 * i + 2 * (size_t)k] = (c * b[1] - d * a[1]) / det;
            x[16 * i + 2 * (size_t)k + 1] = (d * a[0] - c * b[0]) / det;
        }
    return scene_of(2, FROE_POINT, 8 * n, x);
}

static froe_range corner(uint64_t *state, const froe_scene *scene, double size, double *points) {
    froe_range r = froe_range_defaults();
    (void)scene;
    points[0] = 0.2 + 0.3 * draw(state), points[1] = -0.7 + 0.3 * draw(state);
    for (int k = 0; k < 2; k++) points[2 + k] = points[k] + size;
    r.points = points;
    return r;
}

/** The same guards and cuts in a tree of points: what comes out when no guard is forgotten. */
static void without_pruning(void) {
    static const spec pruned = {"", "bar", "k=1 stop=0 growth=0"}, plain = {"", "bar", NULL};
    printf("\nRanges of side 0.3 in an empty corner full of guards: nodes\n\n| n | 250 | 1000 | 4000 | 16000 |\n");
    printf("|---|---|---|---|---|\n");
    for (int forget = 1; forget >= 0; forget--) {
        printf("| %s |", forget ? "guards forgotten" : "all guards kept");
        for (size_t n = 250; n <= 16000; n *= 4) {
            double *segments = make_diagonals(n);
            froe_scene *scene = forget ? scene_of(2, FROE_SEGMENT, n, segments) : guards_of(segments, n);
            if (!forget) free(segments);
            froe_tree *tree = build(scene, forget ? &pruned : &plain);
            printf(" %.1f |", ask(tree, corner, 0.3, 0).nodes);
            froe_tree_free(tree);
            froe_scene_free(scene);
        }
        printf("\n");
    }
}

/* ------------------------------------------------------------------- guards -- */

typedef struct load {
    uint32_t *stamp, most;
} load;

/** Objects of one cell of the guard stage. */
static void weigh(const froe_tree *tree, froe_node root, load *l) {
    froe_node stack[512];
    int count = 0;
    uint32_t found = 0;
    for (stack[count++] = root; count;) {
        const froe_node_info info = froe_tree_node(tree, stack[--count]);
        for (size_t i = 0; i < info.piece_count; i++) {
            uint32_t *stamp = l->stamp + froe_tree_piece(tree, info.first_piece + i).object;
            found += *stamp != root.id1;
            *stamp = root.id1;
        }
        for (int s = 0; s < 2 && info.child[s].id1 && count < 512; s++) stack[count++] = info.child[s];
    }
    if (found > l->most) l->most = found;
}

static uint32_t fullest_cell(const froe_tree *tree) {
    load l = {calloc(froe_scene_object_count(froe_tree_scene(tree)), sizeof(uint32_t)), 0};
    froe_node stack[512];
    int count = 0;
    if (!l.stamp) exit(1);
    for (stack[count++] = froe_tree_root(tree); count;) {
        const froe_node node = stack[--count];
        const froe_node_info info = froe_tree_node(tree, node);
        if (!info.guard) weigh(tree, node, &l);
        for (int s = 0; s < 2 && info.guard && count < 512; s++) stack[count++] = info.child[s];
    }
    free(l.stamp);
    return l.most;
}

static void kinds_of_guards(void) {
    static const char *const scenes[] = {"scatter", "wedge", "nested", "clusters", "cuboids"};
    static const char *const kinds[] = {"hemisphere", "pairs", "boxes"};
    printf("\nObjects in the fullest cell of the guard stage, k = 0 (pieces per object), n = 4000\n\n| guards |");
    for (int s = 0; s < 5; s++) printf(" %s |", scenes[s]);
    printf("\n|---|---|---|---|---|---|\n");
    for (int k = 0; k < 3; k++) {
        printf("| %s |", kinds[k]);
        for (int s = 0; s < 5; s++) {
            char settings[80];
            snprintf(settings, sizeof settings, "k=0 stop=1 growth=0 guards=%s", kinds[k]);
            froe_scene *scene = bench_generate(scenes[s], 4000, 1);
            froe_tree *tree = bench_build_by(build_tuned, scene, "bar", settings, 1, 1, NULL);
            const froe_report r = froe_tree_report(tree);
            printf(" %u (%.2f) |", fullest_cell(tree), (double)r.fragments / (double)r.objects);
            froe_tree_free(tree);
            froe_scene_free(scene);
        }
        printf("\n");
    }
}

int main(int argc, char **argv) {
    const char *folder = argc > 1 ? argv[1] : NULL;
    bench_head("bar", 1);
    against_eps("Points in the plane, squares of a third of the side", make_points(2, 100000), cube, 1.0 / 3, folder,
                "eps");
    against_eps("Points in space, cubes of a third of the side", make_points(3, 100000), cube, 1.0 / 3, folder,
                "eps-space");
    against_eps("Segments in the plane, the same", scatter(50000), cube, 1.0 / 3, folder, "eps-segments");
    against_eps("Triangles of boxes in space, the same", cuboids(50000), cube, 1.0 / 3, NULL, "");
    against_eps("Points along two lines, thin ranges between", make_lines(100000), needle, 0.001, folder, "thin");
    against_found("Points in the plane", make_points(2, 100000));
    against_near(folder);
    against_n("Points in the plane", plane_points, NULL, "");
    against_n("Segments in the plane", scatter, folder, "n");
    against_n("Triangles of boxes in space", cuboids, NULL, "");
    without_pruning();
    kinds_of_guards();
    return 0;
}
