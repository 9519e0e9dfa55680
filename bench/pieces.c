/* pieces.c: pieces per object, height and time of every method on every scene, beside gl2ps, as lines of results.
 *
 *     bench_pieces [-t SECONDS] SCENE...        a file, or KIND:N for a generated scene
 *
 * One thread; seconds are processor time. Every object ends in a cut (leaf 0), as polygons do in the other programs;
 * where froe cannot do that, as of boxes, one is left in a leaf. gl2ps sorts triangles by a BSP and writes every piece
 * as a polygon; its height cannot be seen from outside. */
#include "apart.h"
#include "bench.h"
#include "json.h"
#include "peers/gl2ps.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct subject {
    froe_scene *scene;
    char name[32];
    double objects;
    const char *method;
    uint32_t leaf;
    double *triangles; /* 9 numbers each, scaled to the page; NULL: not all objects are triangles */
    bool best_root;
} subject;

enum { PIECES, HEIGHT, SECONDS, COLUMNS };

/** Builds again and again until the clock, which may tick in steps of 4 ms, can tell the mean. */
static bool build(const void *user, double *out) {
    const subject *s = user;
    const double start = bench_cpu();
    for (int runs = 1;; runs++) {
        froe_tree *tree = bench_build(s->scene, s->method, NULL, s->leaf, 1, NULL);
        const double seconds = bench_cpu() - start;
        const froe_report r = froe_tree_report(tree);
        out[PIECES] = (double)r.fragments;
        out[HEIGHT] = (double)r.height;
        out[SECONDS] = seconds / runs;
        froe_tree_free(tree);
        if (seconds > 0.2) return true;
    }
}

/* `trouble`: why there are no numbers, or NULL. */
static void print(const subject *s, const char *program, const char *trouble, const double *out) {
    static const char *const measures[COLUMNS] = {"pieces", "height", "seconds"};
    json_result r = {.work = "pieces", .scene = s->name, .objects = (size_t)s->objects, .program = program, .count = 1};
    for (int c = 0; c < (trouble ? 1 : COLUMNS); c++) {
        r.measure = measures[c], r.values = trouble ? NULL : out + c, r.note = trouble;
        if (trouble || out[c] > 0) json_line(&r);
    }
}

static void ours(subject *s, unsigned limit) {
    const froe_method_info *m;
    s->leaf = 0;
    for (size_t i = 0; (m = froe_method_at(i)) != NULL; i++)
        if (!strcmp(m->name, "density") && !froe_method_serves(m, s->scene, 0)) s->leaf = 1;
    for (size_t i = 0; (m = froe_method_at(i)) != NULL; i++) {
        double out[COLUMNS];
        char name[64];
        if (!froe_method_serves(m, s->scene, s->leaf)) continue;
        snprintf(name, sizeof name, "froe, %s", m->name);
        s->method = m->name;
        const char *trouble = bench_apart(build, s, limit, out, COLUMNS);
        print(s, name, trouble, out);
    }
}

#ifdef HAVE_GL2PS
/** The scene's triangles, enlarged to fill a page of 1000 units; NULL if it has other objects. */
static double *page(const froe_scene *scene) {
    enum { PAGE = 1000 };
    const size_t n = froe_scene_object_count(scene);
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], extent = 0;
    if (froe_scene_dim(scene) != 3 || !froe_scene_bounds(scene, lo, hi)) return NULL;
    for (int k = 0; k < 3; k++) extent = fmax(extent, hi[k] - lo[k]);
    double *out = calloc(n, 9 * sizeof *out);
    for (uint32_t i = 0; out && i < n; i++) {
        const froe_object o = froe_scene_object(scene, i);
        if (o.kind != FROE_POLYGON || o.corners > 3) {
            free(out);
            return NULL;
        }
        for (uint32_t k = 0; k < 9; k++) /* one of zero area repeats its last corner */
            out[9 * (size_t)i + k] =
                PAGE / extent *
                (froe_scene_vertex(scene, froe_scene_corner(scene, i, k / 3 < o.corners ? k / 3 : 0))[k % 3] -
                 lo[k % 3]);
    }
    return out;
}

static bool sort_and_write(const void *user, double *out) {
    const subject *s = user;
    out[HEIGHT] = 0;
    const double start = bench_cpu();
    out[PIECES] = (double)peer_gl2ps(s->triangles, (size_t)s->objects, s->best_root);
    out[SECONDS] = bench_cpu() - start;
    return out[PIECES] > 0;
}

static void theirs(subject *s, unsigned limit) {
    double out[COLUMNS];
    s->triangles = page(s->scene);
    for (int best = 0; s->triangles && best < 2; best++) {
        s->best_root = best;
        const char *trouble = bench_apart(sort_and_write, s, limit, out, COLUMNS);
        print(s, best ? "gl2ps, best root" : "gl2ps", trouble, out);
    }
    free(s->triangles);
}
#endif

static froe_scene *open_scene(const char *arg, char name[32]) {
    const char *colon = strchr(arg, ':');
    if (!colon) {
        bench_name(arg, name);
        return bench_read(arg);
    }
    snprintf(name, 32, "%.*s", (int)(colon - arg), arg);
    return bench_generate(name, strtoull(colon + 1, NULL, 10), 1);
}

int main(int argc, char **argv) {
    unsigned limit = 120;
    int at = 1;
    if (argc > 2 && !strcmp(argv[1], "-t")) limit = (unsigned)strtoul(argv[2], NULL, 10), at = 3;
    for (; at < argc; at++) {
        subject s = {0};
        s.scene = open_scene(argv[at], s.name);
        s.objects = (double)froe_scene_object_count(s.scene);
        ours(&s, limit);
#ifdef HAVE_GL2PS
        theirs(&s, limit);
#endif
        froe_scene_free(s.scene);
    }
    return 0;
}
