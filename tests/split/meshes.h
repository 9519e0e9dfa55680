/* meshes.h: scenes of triangles, and of segments in the plane, for tests of the grain builder. */
#ifndef FROE_TESTS_SPLIT_MESHES_H
#define FROE_TESTS_SPLIT_MESHES_H
#include <froe/froe.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "support/fuzz.h"

typedef enum mesh_kind {
    MESH_LOOSE,   /**< small triangles that meet now and then */
    MESH_HILLS,   /**< a bumpy, irregular network */
    MESH_LATTICE, /**< coordinates 0 .. 3: shared corners, common planes, duplicates, triangles without area */
    MESH_FAN,     /**< around one vertex */
    MESH_HAIR,    /**< long, thin, nearly parallel */
    MESH_STROKES, /**< segments in the plane that cross now and then */
    MESH_MAP,     /**< edges of a shaken grid in the plane */
    MESH_KINDS
} mesh_kind;

static inline int mesh_dim(mesh_kind kind) {
    return kind < MESH_STROKES ? 3 : 2;
}

/** Of n triangles in space or segments in the plane. */
static inline froe_scene *mesh_of(int dim, const double *coords, size_t n) {
    froe_scene *scene;
    froe_objects o = froe_objects_defaults();
    o.kind = dim == 3 ? FROE_POLYGON : FROE_SEGMENT;
    o.count = n;
    o.coords = coords;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    return scene;
}

static inline void mesh_loose(fuzz_source *r, double *x) {
    double centre[3] = {fuzz_unit(r), fuzz_unit(r), fuzz_unit(r)};
    for (int k = 0; k < 9; k++) x[k] = centre[k % 3] + 0.2 * fuzz_unit(r);
}

/** Vertex i, j of a grid, shaken; a function of its place alone. */
static inline void mesh_hill(uint64_t seed, int i, int j, double *x) {
    fuzz_source r = {seed * 1000003 + (uint64_t)(1000 * i + j)};
    x[0] = i + 0.3 * fuzz_unit(&r);
    x[1] = j + 0.3 * fuzz_unit(&r);
    x[2] = 0.02 * (x[0] - 6) * (x[1] - 6) + 0.2 * fuzz_unit(&r);
}

static inline void mesh_hills(uint64_t seed, size_t index, size_t width, double *x) {
    int i = (int)(index / 2 % width), j = (int)(index / 2 / width), upper = (int)(index % 2);
    mesh_hill(seed, i + 1, j, x);
    mesh_hill(seed, i + upper, j + upper, x + 3);
    mesh_hill(seed, i, j + 1, x + 6);
}

/** The edges right and up from vertex i, j of a grid by turns. */
static inline void mesh_map(uint64_t seed, size_t index, size_t width, double *x) {
    int i = (int)(index / 2 % width), j = (int)(index / 2 / width), right = (int)(index % 2);
    double p[3], q[3];
    mesh_hill(seed, i, j, p);
    mesh_hill(seed, i + right, j + 1 - right, q);
    for (int k = 0; k < 2; k++) x[k] = p[k], x[2 + k] = q[k];
}

static inline void mesh_stroke(fuzz_source *r, double *x) {
    double centre[2] = {fuzz_unit(r), fuzz_unit(r)};
    for (int k = 0; k < 4; k++) x[k] = centre[k % 2] + 0.2 * fuzz_unit(r);
}

static inline void mesh_object(fuzz_source *r, mesh_kind kind, size_t index, size_t n, double *x) {
    size_t width = 1;
    while (2 * width * width < n) width++;
    switch (kind) {
    case MESH_LOOSE:
        mesh_loose(r, x);
        break;
    case MESH_HILLS:
        mesh_hills(3, index, width, x);
        break;
    case MESH_LATTICE:
        for (int k = 0; k < 9; k++) x[k] = fuzz_int(r, 0, 3);
        break;
    case MESH_FAN:
        for (int k = 0; k < 9; k++) x[k] = k < 3 ? 0 : fuzz_unit(r);
        break;
    case MESH_STROKES:
        mesh_stroke(r, x);
        break;
    case MESH_MAP:
        mesh_map(3, index, width, x);
        break;
    default:
        for (int k = 0; k < 9; k++) x[k] = fuzz_unit(r) * (k % 3 ? 1e-3 : 1);
        for (int k = 0; k < 9; k++) x[k] += k % 3 ? 0.1 * (double)(index % 7) : 0;
    }
}

static inline froe_scene *mesh_new(mesh_kind kind, size_t n) {
    fuzz_source random = {7};
    size_t each = kind < MESH_STROKES ? 9 : 4;
    double *x = test_malloc(each * n * sizeof *x);
    for (size_t i = 0; i < n; i++) mesh_object(&random, kind, i, n, x + each * i);
    froe_scene *scene = mesh_of(mesh_dim(kind), x, n);
    test_free(x);
    return scene;
}

/** Writes a cube of half width s around c, tilted, as twelve triangles. */
static inline void mesh_cube(double *x, const double *c, double s) {
    static const int side[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    static const double axes[3][3] = {{0.71, 0.43, -0.55}, {-0.32, 0.9, 0.29}, {0.62, -0.03, 0.78}};
    for (int f = 0; f < 12; f++)
        for (int k = 0; k < 3; k++, x += 3) {
            int corner = side[f / 2][k ? k + f % 2 : 0];
            for (int i = 0; i < 3; i++) {
                x[i] = c[i];
                for (int a = 0; a < 3; a++) x[i] += (corner >> a & 1 ? s : -s) * axes[a][i];
            }
        }
}

/** Cubes in one another, each 0.9 as wide as the one around it and off its centre, of twelve triangles each. */
static inline froe_scene *mesh_shells(size_t cubes) {
    double *x = test_malloc(108 * cubes * sizeof *x);
    double at[3] = {0, 0, 0};
    fuzz_source r = {5};
    for (size_t i = cubes; i-- > 0;) {
        const double s = pow(0.9, (double)i);
        for (int k = 0; k < 3; k++) at[k] += 0.02 * s * (fuzz_unit(&r));
        mesh_cube(x + 108 * i, at, s);
    }
    froe_scene *scene = mesh_of(3, x, 12 * cubes);
    test_free(x);
    return scene;
}
#endif
