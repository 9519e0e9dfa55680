/* test_units.c: the unit of a scene changes nothing in its picture: neither places, light and creases, nor lines where
 * faces cross. */
#include "support/small_scenes.h"
#include <froe/render.h>
#include <math.h>
#include <stdio.h>

enum { CORNERS = 3 * (2 + 2 * 12) };

/* A box as twelve triangles, tilted so that its faces are not exactly planar. */
static double *put_box(double *out, const double lo[3], const double hi[3]) {
    static const int face[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    static const double turn[3][3] = {{0.96, -0.21, 0.17}, {0.23, 0.97, -0.08}, {-0.15, 0.12, 0.98}};
    for (int i = 0; i < 6 * 2 * 3; i++) {
        const int corner = face[i / 6][i % 3 ? i % 3 + i / 3 % 2 : 0];
        double x[3];
        for (int k = 0; k < 3; k++) x[k] = corner >> k & 1 ? hi[k] : lo[k];
        for (int k = 0; k < 3; k++) *out++ = turn[k][0] * x[0] + turn[k][1] * x[1] + turn[k][2] * x[2];
    }
    return out;
}

/* A tower with a bar that begins in it, and two triangles that pass through each other, in a unit. */
static froe_tree *make(double unit) {
    double at[3 * CORNERS] = {-2,   -2,   0.1, -1.1, -2.2, 0.7,  -1.3, -0.9, 0.2,
                              -1.7, -1.9, 0.6, -1.2, -1.4, -0.3, -2.1, -1,   0.5};
    double *next = at + 18;
    next = put_box(next, (const double[]){0, 0, 0}, (const double[]){1, 1, 2.5});
    next = put_box(next, (const double[]){0.9, 0.3, 2}, (const double[]){3, 0.7, 2.3});
    assert_ptr_equal(next, at + 3 * CORNERS);
    for (int i = 0; i < 3 * CORNERS; i++) at[i] *= unit;
    froe_scene *scene = scene_of(3);
    froe_objects o = froe_objects_defaults();
    o.count = CORNERS / 3, o.coords = at;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    return tree_of(scene, "autopartition", 1);
}

/* What a picture shows of one colour, or of one kind of lines: area or length, and that times where it is. */
typedef struct amount {
    bool lines, hidden;
    uint32_t what;
    double sum[3];
} amount;

typedef struct picture {
    amount all[64];
    size_t count;
} picture;

static amount *amount_of(picture *p, const froe_render_path *path) {
    const amount wanted = {path->lines, path->hidden, path->lines ? (uint32_t)path->kind : path->colour, {0}};
    size_t i = 0;
    while (i < p->count &&
           (p->all[i].lines != wanted.lines || p->all[i].hidden != wanted.hidden || p->all[i].what != wanted.what))
        i++;
    if (i == p->count) {
        assert_true(i < sizeof p->all / sizeof *p->all);
        p->all[p->count++] = wanted;
    }
    return p->all + i;
}

static bool measure_path(void *user, const froe_render_path *path) {
    amount *sum = amount_of(user, path);
    for (size_t i = 0; i < path->count; i++) {
        const froe_outline *o = path->outlines + i;
        for (size_t k = 0; k + (o->closed ? 0 : 1) < o->count; k++) {
            const double *p = o->points + 2 * k, *q = o->points + 2 * ((k + 1) % o->count);
            const double share =
                path->lines ? hypot(q[0] - p[0], q[1] - p[1]) : 0.5 * (p[0] * q[1] - p[1] * q[0]) / 1000;
            sum->sum[0] += share;
            for (int c = 0; c < 2; c++) sum->sum[1 + c] += share * (p[c] + q[c]) / 1000;
        }
    }
    return true;
}

static picture draw(const froe_tree *tree, const double *eye, bool parallel, froe_shading shading) {
    picture out = {.count = 0};
    froe_render_options o = froe_render_defaults();
    froe_diagnostic why = {.message = ""};
    for (int k = 0; k < 3; k++) o.camera.eye[k] = eye[k], o.camera.up[k] = k == (eye[2] > 2 ? 1 : 2);
    o.camera.parallel = parallel, o.hidden = true, o.shading = shading, o.paint = FROE_PAINT_REGIONS;
    o.seams = FROE_SEAMS_NONE;
    if (froe_render_paths(tree, 1000, measure_path, &out, &o, NULL, &why)) fail_msg("%s", why.message);
    return out;
}

static void the_unit_changes_nothing(void **state) {
    (void)state;
    static const int powers[] = {-990, -840, -700, -540, -480, -360, -300, -220, -180,
                                 -120, -60,  -20,  20,   60,   300,  480,  700,  980};
    static const double eyes[][3] = {{0, 0, 9}, {0, -9, 0}, {1, -2, 1.5}};
    for (int i = 0; i < 3 * 2 * 2; i++) {
        const froe_shading shading = i % 2 ? FROE_SHADE_FLAT : FROE_SHADE_CEL;
        froe_tree *plain = make(1);
        const picture expected = draw(plain, eyes[i / 4], i / 2 % 2, shading);
        froe_tree_free(plain);
        assert_true(expected.count > 5);
        for (size_t p = 0; p < sizeof powers / sizeof *powers; p++) {
            froe_tree *tree = make(ldexp(1, powers[p]));
            const picture found = draw(tree, eyes[i / 4], i / 2 % 2, shading);
            froe_tree_free(tree);
            bool same = found.count == expected.count;
            for (size_t k = 0; same && k < found.count; k++) {
                const froe_render_path path = {.lines = expected.all[k].lines,
                                               .hidden = expected.all[k].hidden,
                                               .kind = (froe_line)expected.all[k].what,
                                               .colour = expected.all[k].what};
                picture copy = found;
                const amount *a = amount_of(&copy, &path);
                for (int c = 0; c < 3; c++) same = same && fabs(a->sum[c] - expected.all[k].sum[c]) < 0.1;
            }
            if (!same) fail_msg("picture %d differs in the unit 2^%d", i, powers[p]);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_unit_changes_nothing)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
