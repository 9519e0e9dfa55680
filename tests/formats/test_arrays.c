/* Whole arrays (froe/arrays.h): what they hold is what single calls tell, and adds up to the objects and the box. */
#include "support/memory.h"
#include <froe/arrays.h>
#include <froe/formats.h>
#include <math.h>
#include <string.h>

typedef struct sample {
    const char *kind, *method;
} sample;

static const sample samples[] = {{"segments", "density"},     {"mixed", "index"},           {"disjoint", "cylindrical"},
                                 {"triangles", "grain"},      {"triangles", "index"},       {"boxes", "kd"},
                                 {"degenerate", "density"},   {"degenerate-3d", "density"}, {"balls-3d", "kd"},
                                 {"boxes-3d", "directional"}, {"disjoint", "paterson_yao"}};
enum { SAMPLES = sizeof samples / sizeof *samples };

static froe_tree *tree_of(const sample *s) {
    froe_build_options o = froe_build_defaults();
    froe_scene *scene;
    froe_tree *tree;
    froe_diagnostic why;
    if (froe_generate(s->kind, 60, 3, NULL, &scene, &why)) fail_msg("%s: %s", s->kind, why.message);
    o.method = s->method;
    if (froe_build(scene, &o, &tree, &why)) fail_msg("%s by %s: %s", s->kind, s->method, why.message);
    froe_scene_free(scene);
    return tree;
}

static double distance(const double *a, const double *b, int dim) {
    double sum = 0;
    for (int k = 0; k < dim; k++) sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sqrt(sum);
}

/* Of a polygon of the plane or of space, as a vector. */
static void add_area(const double *coords, size_t corners, int dim, double sum[3]) {
    for (size_t i = 1; i + 1 < corners; i++) {
        double u[3] = {0}, v[3] = {0};
        for (int k = 0; k < dim; k++) {
            u[k] = coords[i * (size_t)dim + (size_t)k] - coords[k];
            v[k] = coords[(i + 1) * (size_t)dim + (size_t)k] - coords[k];
        }
        for (int k = 0; k < 3; k++) sum[k] += (u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]) / 2;
    }
}

static double extent(froe_kind form, const double *coords, size_t corners, int dim) {
    double area[3] = {0};
    if (form == FROE_SEGMENT) return distance(coords, coords + dim, dim);
    if (form == FROE_POLYGON) add_area(coords, corners, dim, area);
    return sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
}

/* ------------------------------------------------------------------- scene -- */

static void check_scene(const froe_scene *scene, const froe_scene_arrays *a) {
    const size_t dim = (size_t)froe_scene_dim(scene);
    assert_int_equal(a->dim, dim);
    assert_int_equal(a->object_count, froe_scene_object_count(scene));
    assert_int_equal(a->vertex_count, froe_scene_vertex_count(scene));
    assert_int_equal(a->starts[0], 0);
    assert_int_equal(a->starts[a->object_count], a->corner_count);
    for (uint32_t i = 0; i < a->object_count; i++) {
        const froe_object o = froe_scene_object(scene, i);
        assert_true(a->kinds[i] == o.kind && a->forms[i] == o.form && a->radii[i] == o.radius && a->tags[i] == o.tag);
        assert_true(a->faces[i] == o.face && a->groups[i] == o.group);
        assert_int_equal(a->starts[i + 1] - a->starts[i], o.corners);
        for (uint32_t c = 0; c < o.corners; c++)
            assert_memory_equal(a->coords + dim * a->corners[a->starts[i] + c],
                                froe_scene_vertex(scene, froe_scene_corner(scene, i, c)), dim * sizeof *a->coords);
    }
}

static void a_scene_is_its_objects(void **state) {
    (void)state;
    for (int i = 0; i < SAMPLES; i++) {
        froe_tree *tree = tree_of(samples + i);
        froe_scene_arrays a;
        assert_int_equal(froe_arrays_of_scene(froe_tree_scene(tree), NULL, &a, NULL), FROE_OK);
        check_scene(froe_tree_scene(tree), &a);
        froe_tree_free(tree);
        a.coords[0] += 1; /* it is a copy, and still there */
        froe_scene_arrays_free(&a);
        froe_scene_arrays_free(&a);
    }
    froe_scene_arrays_free(NULL);
}

/* ------------------------------------------------------------------ pieces -- */

static void check_pieces(const froe_tree *tree, const froe_piece_arrays *a) {
    const froe_scene *scene = froe_tree_scene(tree);
    const size_t dim = (size_t)a->dim, objects = froe_scene_object_count(scene);
    double *extents = calloc(objects, sizeof *extents);
    bool *held = calloc(objects, sizeof *held);
    assert_true(extents && held);
    assert_int_equal(a->count, froe_tree_piece_count(tree));
    assert_int_equal(a->starts[a->count], a->corner_count);
    for (size_t i = 0; i < a->count; i++) {
        double corners[64 * 3];
        froe_node made[64];
        const froe_piece p = froe_tree_piece(tree, i);
        const froe_node_info node = froe_tree_node(tree, a->nodes[i]);
        const size_t start = a->starts[i], count = a->starts[i + 1] - start;
        assert_true(a->objects[i] == p.object && a->whole[i] == p.whole && count == p.corners);
        assert_true(node.first_piece <= i && i < node.first_piece + node.piece_count);
        assert_int_equal(froe_tree_piece_corners(tree, i, corners, made, 64), count);
        assert_memory_equal(a->coords + start * dim, corners, count * dim * sizeof *corners);
        assert_memory_equal(a->made + start, made, count * sizeof *made);
        held[p.object] = true;
        const double part = extent(froe_scene_object(scene, p.object).form, corners, count, a->dim);
        extents[p.object] = part + (p.whole ? 0 : extents[p.object]); /* index cuts nothing in space */
    }
    for (uint32_t i = 0; i < objects; i++) { /* together the pieces of an object are the object */
        const froe_object o = froe_scene_object(scene, i);
        double corners[64 * 3];
        for (uint32_t c = 0; c < o.corners; c++)
            memcpy(corners + c * dim, froe_scene_vertex(scene, froe_scene_corner(scene, i, c)), dim * sizeof *corners);
        const double whole = extent(o.form, corners, o.corners, a->dim);
        assert_true(held[i]);
        assert_true(fabs(extents[i] - whole) <= 1e-9 * (1 + whole));
    }
    free(extents);
    free(held);
}

static void pieces_are_parts_of_their_objects(void **state) {
    (void)state;
    for (int i = 0; i < SAMPLES; i++) {
        froe_tree *tree = tree_of(samples + i);
        froe_piece_arrays a;
        assert_int_equal(froe_arrays_of_pieces(tree, NULL, &a, NULL), FROE_OK);
        check_pieces(tree, &a);
        froe_piece_arrays_free(&a);
        froe_tree_free(tree);
    }
}

/* ------------------------------------------------------------------- cells -- */

/* Area in the plane, volume in space. */
static double content(const froe_cell_arrays *a, size_t cell) {
    double sum = 0;
    for (size_t f = a->faces[cell]; f < a->faces[cell + 1]; f++) {
        const double *x = a->coords + a->starts[f] * (size_t)a->dim;
        double area[3] = {0};
        add_area(x, a->starts[f + 1] - a->starts[f], a->dim, area);
        if (a->dim == 2)
            sum += area[2];
        else
            for (int k = 0; k < 3; k++) sum += area[k] * x[k] / 3;
    }
    return sum;
}

static void leaves_fill_the_box(void **state) {
    (void)state;
    for (int i = 0; i < SAMPLES; i++) {
        froe_tree *tree = tree_of(samples + i);
        const froe_report r = froe_tree_report(tree);
        double lo[3], hi[3], box = 1, leaves = 0;
        froe_cell_arrays a, all;
        assert_true(froe_scene_bounds(froe_tree_scene(tree), lo, hi));
        for (int k = 0; k < r.dim; k++) lo[k] -= 0.125, hi[k] += 0.5, box *= hi[k] - lo[k];
        assert_int_equal(froe_arrays_of_cells(tree, lo, hi, false, NULL, &a, NULL), FROE_OK);
        assert_int_equal(froe_arrays_of_cells(tree, lo, hi, true, NULL, &all, NULL), FROE_OK);
        assert_true(a.count > 1 && a.count <= r.leaves && all.count > a.count && all.count <= r.nodes);
        assert_int_equal(a.faces[a.count], a.face_count);
        assert_int_equal(a.starts[a.face_count], a.corner_count);
        for (size_t c = 0; c < a.count; c++) {
            assert_int_equal(froe_tree_node(tree, a.nodes[c]).child[0].id1, 0);
            assert_true(a.depths[c] <= r.height);
            leaves += content(&a, c);
        }
        assert_true(fabs(leaves - box) <= 1e-9 * box);
        assert_true(fabs(content(&all, 0) - box) <= 1e-9 * box); /* the root */
        froe_cell_arrays_free(&a);
        froe_cell_arrays_free(&all);
        froe_tree_free(tree);
    }
}

/* ---------------------------------------------------------------- failures -- */

static froe_status copying(void *user, const froe_allocator *alloc) {
    const froe_tree *tree = user;
    const double lo[2] = {-1e3, -1e3}, hi[2] = {1e3, 1e3};
    froe_scene_arrays scene;
    froe_piece_arrays pieces;
    froe_cell_arrays cells;
    froe_status status = froe_arrays_of_scene(froe_tree_scene(tree), alloc, &scene, NULL);
    if (status) return status;
    status = froe_arrays_of_pieces(tree, alloc, &pieces, NULL);
    if (!status) {
        status = froe_arrays_of_cells(tree, lo, hi, true, alloc, &cells, NULL);
        if (!status) froe_cell_arrays_free(&cells);
        froe_piece_arrays_free(&pieces);
    }
    froe_scene_arrays_free(&scene);
    return status;
}

static void any_allocation_may_fail(void **state) {
    (void)state;
    froe_tree *tree = tree_of(samples);
    assert_int_equal(test_memory_each(copying, tree), 9 + 6 + 5);
    froe_tree_free(tree);
}

/* An empty scene, bad boxes, dimensions without cells: statuses, and outputs as they were. */
static void nothing_is_an_answer(void **state) {
    (void)state;
    for (int dim = 2; dim <= 4; dim++) {
        const double lo[4] = {0}, hi[4] = {1, 1, 1, 1};
        froe_build_options o = froe_build_defaults();
        froe_scene *scene;
        froe_tree *tree;
        froe_scene_arrays s;
        froe_piece_arrays p;
        froe_cell_arrays c = {.count = 77};
        froe_diagnostic why;
        assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
        assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
        assert_int_equal(froe_arrays_of_scene(scene, NULL, &s, NULL), FROE_OK);
        assert_true(s.object_count == 0 && s.coords && s.starts[0] == 0 && s.corners && s.groups);
        assert_int_equal(froe_arrays_of_pieces(tree, NULL, &p, NULL), FROE_OK);
        assert_true(p.count == 0 && p.objects && p.starts[0] == 0 && p.coords);
        assert_int_equal(froe_arrays_of_cells(tree, hi, lo, true, NULL, &c, &why),
                         dim > 3 ? FROE_E_UNSUPPORTED : FROE_E_ARG);
        assert_int_equal(froe_arrays_of_cells(tree, NULL, hi, true, NULL, &c, &why), FROE_E_ARG);
        assert_int_equal(c.count, 77);
        assert_int_equal(froe_arrays_of_cells(tree, lo, hi, true, NULL, &c, &why),
                         dim > 3 ? FROE_E_UNSUPPORTED : FROE_OK);
        if (dim <= 3) {
            assert_int_equal(c.count, 1);
            assert_int_equal(c.face_count, dim == 2 ? 1 : 6);
            froe_cell_arrays_free(&c);
        }
        froe_piece_arrays_free(&p);
        froe_scene_arrays_free(&s);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
    assert_int_equal(froe_arrays_of_scene(NULL, NULL, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_arrays_of_pieces(NULL, NULL, NULL, NULL), FROE_E_ARG);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_is_its_objects), cmocka_unit_test(pieces_are_parts_of_their_objects),
        cmocka_unit_test(leaves_fill_the_box),    cmocka_unit_test(any_allocation_may_fail),
        cmocka_unit_test(nothing_is_an_answer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
