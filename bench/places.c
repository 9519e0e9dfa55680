/* places.c: pieces and height of the same models as they are, far from the origin, and turned, as lines of results.
 *
 *     bench_places SCENE...        a file of polygons, or KIND:N for a generated scene
 *
 * "As it is" means on a grid of 2^-24 of the size, so that the shift by 2^20 sizes is exact. The turn is about two axes
 * by 0.7, with sines that are rounded. Turned models are rounded to doubles, which cannot see that walls are no longer
 * flat, or to floats, whose rounding doubles see as it is. One thread, leaf 0, seed 1. */
#include "bench.h"
#include "json.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum place { AS_IT_IS, SHIFTED, TURNED, TURNED_FLOATS, PLACES } place;

static const char *const place_names[] = {"as it is", "shifted", "turned", "turned, floats"};

static double size_of(const froe_scene *scene) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], size = 0;
    if (!froe_scene_bounds(scene, lo, hi)) return 1;
    for (int k = 0; k < 3; k++) size = fmax(size, hi[k] - lo[k]);
    return size;
}

static void put_point(const double *from, place where, double size, double *to) {
    static const double sine = 0.644217687237691, cosine = 0.7648421872844885;
    const double unit = exp2(ceil(log2(size)) - 24);
    double p[3];
    for (int k = 0; k < 3; k++) p[k] = round(from[k] / unit) * unit;
    const double x = cosine * p[0] - sine * p[1], y = sine * p[0] + cosine * p[1];
    const double turned[3] = {x, cosine * y - sine * p[2], sine * y + cosine * p[2]};
    for (int k = 0; k < 3; k++) {
        to[k] = where < TURNED ? p[k] + (where == SHIFTED ? unit * exp2(44) : 0) : turned[k];
        if (where == TURNED_FLOATS) to[k] = (double)(float)to[k];
    }
}

/** A polygon without area has one or two corners, of which the last one is repeated. */
static const double *corner_at(const froe_scene *scene, uint32_t object, size_t corner) {
    const size_t last = froe_scene_object(scene, object).corners - 1;
    return froe_scene_vertex(scene, froe_scene_corner(scene, object, (uint32_t)(corner < last ? corner : last)));
}

/** The same polygons in another place; those that the grid leaves without area stay as objects that no cut meets. */
static froe_scene *placed(const froe_scene *from, place where) {
    const size_t n = froe_scene_object_count(from);
    const double size = size_of(from);
    froe_scene *scene = NULL;
    froe_diagnostic diag = {0};
    size_t *starts = bench_take(n + 1, sizeof *starts);
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t corners = froe_scene_object(from, i).corners;
        starts[i + 1] = starts[i] + (corners < 3 ? 3 : corners);
    }
    double *x = bench_take(starts[n], 3 * sizeof *x);
    for (uint32_t i = 0; i < n; i++)
        for (size_t k = starts[i]; k < starts[i + 1]; k++)
            put_point(corner_at(from, i, k - starts[i]), where, size, x + 3 * k);
    froe_objects o = froe_objects_defaults();
    o.count = n, o.coords = x, o.starts = starts;
    bench_must(froe_scene_new(3, NULL, &scene), NULL);
    bench_must(froe_scene_add(scene, &o, &diag), &diag);
    free(x);
    free(starts);
    return scene;
}

static void measure(const froe_scene *from, const char *name, place where) {
    static const char *const methods[] = {"grain", "density"};
    froe_scene *scene = placed(from, where);
    char work[64], program[64];
    snprintf(work, sizeof work, "places, %s", place_names[where]);
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        froe_tree *tree = bench_build(scene, methods[i], NULL, 0, 1, NULL);
        const froe_report r = froe_tree_report(tree);
        const double pieces = (double)r.fragments, height = (double)r.height;
        snprintf(program, sizeof program, "froe, %s", methods[i]);
        json_result line = {work, name, (size_t)r.objects, program, "pieces", &pieces, 1, NULL};
        json_line(&line);
        line.measure = "height", line.values = &height;
        json_line(&line);
        froe_tree_free(tree);
    }
    froe_scene_free(scene);
}

int main(int argc, char **argv) {
    for (int i = 1; i < argc; i++) {
        char name[32];
        const char *colon = strrchr(argv[i], ':');
        froe_scene *scene = NULL;
        if (colon) {
            snprintf(name, sizeof name, "%.*s", (int)(colon - argv[i]), argv[i]);
            scene = bench_generate(name, strtoul(colon + 1, NULL, 10), 1);
        } else {
            bench_name(argv[i], name);
            scene = bench_read(argv[i]);
        }
        for (int where = 0; where < PLACES; where++) measure(scene, name, (place)where);
        froe_scene_free(scene);
    }
    return 0;
}
