/* Small ranges by one location in cubes of all sizes: the same answers as brute force in rationals, at the borders of
 * classes and wherever sizes are extreme; and O(log n) steps, however many sizes there are. */
#include "query/range/classes.h"
#include "query/ranges.h"
#include "support/memory.h"
#include <float.h>

/* ------------------------------------------------------------------- scenes -- */

static froe_status add(froe_scene *scene, froe_kind kind, const double *centre, double size) {
    const size_t dim = (size_t)froe_scene_dim(scene);
    double coords[2 * FROE_MAX_DIM];
    for (size_t k = 0; k < dim; k++) {
        coords[k] = kind == FROE_BALL || kind == FROE_POINT ? centre[k] : centre[k] - size;
        coords[dim + k] = centre[k] + size;
    }
    const size_t starts[2] = {0, 2}; /* of hulls */
    return trees_add(scene, kind, 1, coords, kind == FROE_BALL ? &size : NULL, kind == FROE_HULL ? starts : NULL);
}

/* Objects of half size 2^-k, k below `classes`, or up to twice that, on a lattice of 2^-classes or not. */
static froe_scene *mixed(int dim, unsigned kinds, uint32_t count, uint32_t classes, bool lattice, uint64_t seed) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    for (uint32_t i = 0; i < count; i++) {
        const double unit = ldexp(1, -(int)classes);
        double centre[FROE_MAX_DIM], size = ldexp(1, -(int)trees_random(seed, 20 * i, classes)) / 8;
        froe_kind kind = (froe_kind)trees_random(seed, 20 * i + 1, FROE_KIND_COUNT);
        while (!(kinds >> kind & 1)) kind = (froe_kind)((kind + 1) % FROE_KIND_COUNT);
        if (!lattice && i % 3) size *= 1 + trees_unit(seed, 20 * i + 2);
        for (int k = 0; k < dim; k++) {
            centre[k] = trees_unit(seed, 20 * i + 3 + (uint64_t)k);
            if (lattice) centre[k] = floor(centre[k] / unit) * unit;
        }
        assert_int_equal(add(scene, kind, centre, size), FROE_OK);
    }
    return scene;
}

enum { SOME = 1 << FROE_POINT | 1 << FROE_SEGMENT | 1 << FROE_BOX | 1 << FROE_BALL | 1 << FROE_HULL };

/* --------------------------------------------------------------------- asking -- */

/* One range, given as it is, by classes and by the tree itself. */
static void ask_one(const world *w, froe_range_shape shape, const double *points, double radius) {
    question q = {.range = froe_range_defaults()};
    bool *meets = calloc(w->count + 1, sizeof *meets);
    size_t expected = 0;
    memcpy(q.points, points, 2 * (size_t)w->dim * sizeof *points);
    q.range.shape = shape, q.range.points = q.points, q.range.radius = radius;
    if (w->dim <= 3) make_oracle(w, &q);
    for (uint32_t i = 0; i < w->count; i++) expected += meets[i] = truth(w, &q, i);
    for (int i = 0; i < 2; i++) {
        q.range.walk = i ? FROE_WALK_CLASSES : FROE_WALK_AUTO;
        compare(w, &q, meets, expected);
    }
    if (w->dim <= 3) oracle_set_free(&q.set);
    free(meets);
}

/* Balls and boxes that reach exactly as far as a class of sizes, or by one unit more or less, so that they touch. */
static void ask_at_borders(const world *w, uint64_t seed, double scale) {
    const size_t dim = (size_t)w->dim;
    const uint32_t object = trees_random(seed, 0, (uint32_t)w->count);
    const double *x = froe_scene_vertex(w->scene, froe_scene_corner(w->scene, object, 0));
    const double exact = scale * ldexp(1, -(int)trees_random(seed, 1, 9)) / 8;
    const double reach[3] = {exact, nextafter(exact, INFINITY), nextafter(exact, 0)};
    double points[2 * FROE_MAX_DIM];
    for (size_t k = 0; k < dim; k++)
        points[k] = points[dim + k] = x[k] + (double)trees_random(seed, 2 + k, 5) / 4 * exact - exact / 2;
    for (int i = 0; i < 3; i++) {
        ask_one(w, FROE_SHAPE_BALL, points, reach[i]);
        double box[2 * FROE_MAX_DIM];
        for (size_t k = 0; k < dim; k++) {
            box[k] = fmax(points[k] - reach[i], -DBL_MAX);
            box[dim + k] = fmin(points[k] + reach[i], DBL_MAX);
        }
        ask_one(w, FROE_SHAPE_BOX, box, 0);
    }
}

/* Ranges of every shape, large, and small beside a vertex. */
static void check_world(world *w, uint64_t seeds) {
    const double scale = w->scale;
    double origin[FROE_MAX_DIM];
    memcpy(origin, w->origin, sizeof origin);
    for (uint64_t seed = 0; seed < seeds; seed++) {
        if (seed % 4 && w->count) {
            const uint32_t object = trees_random(seed, 40, (uint32_t)w->count);
            const double *x = froe_scene_vertex(w->scene, froe_scene_corner(w->scene, object, 0));
            w->scale = scale * ldexp(1, -(int)trees_random(seed, 41, 10));
            for (int k = 0; k < w->dim; k++) w->origin[k] = x[k] - w->scale / 2;
        }
        const uint64_t shapes = w->dim > 3 ? 2 : FROE_SHAPE_COUNT;
        ask_by(w, (froe_range_shape)(seed % shapes), seed, FROE_WALK_CLASSES, FROE_WALK_CLASSES, truth);
        memcpy(w->origin, origin, sizeof origin);
        w->scale = scale;
    }
}

static void check_scene(const char *name, froe_scene *scene, uint64_t seeds, double border) {
    world w = world_begin(name, scene);
    check_world(&w, seeds);
    for (uint64_t seed = 0; seed < seeds / 4 && border > 0 && w.count; seed++) ask_at_borders(&w, seed, border);
    world_end(&w);
}

/* ---------------------------------------------------------------------- tests -- */

static void scenes_of_many_sizes(void **state) {
    (void)state;
    check_scene("plane", mixed(2, SOME, 90, 9, false, 1), 60, 1);
    check_scene("plane, lattice", mixed(2, SOME, 90, 9, true, 2), 60, 1);
    check_scene("space", mixed(3, SOME, 50, 6, false, 3), 40, 1);
    check_scene("space, lattice", mixed(3, SOME, 50, 6, true, 4), 40, 1);
    check_scene("five dimensions", mixed(5, SOLID_KINDS, 40, 5, true, 5), 30, 1);
    check_scene("nested", world_generate("nested", 300), 50, 1);
}

static void one_small_object_among_large_ones(void **state) {
    const double centre[2] = {0.5, 0.25};
    (void)state;
    froe_scene *scene = mixed(2, SOME, 80, 1, true, 6);
    assert_int_equal(add(scene, FROE_BOX, centre, 0x1p-40), FROE_OK);
    check_scene("one small", scene, 80, 1);
}

static void points_have_no_size(void **state) {
    (void)state;
    check_scene("points", mixed(2, 1 << FROE_POINT, 100, 1, true, 7), 60, 1);
    check_scene("points in space", mixed(3, 1 << FROE_POINT, 60, 1, false, 8), 40, 1);
}

static void little_or_nothing(void **state) {
    (void)state;
    check_scene("none", mixed(2, SOME, 0, 1, true, 9), 32, 0);
    check_scene("one", mixed(2, 1 << FROE_BALL, 1, 1, true, 10), 60, 1);
    check_scene("one in space", mixed(3, 1 << FROE_BOX, 1, 1, true, 11), 60, 1);
}

/* The same scene, larger or smaller by a power of two. */
static froe_scene *scaled(double scale) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (uint32_t i = 0; i < 60; i++) {
        const double size = scale * ldexp(1, -(int)(i % 9)) / 8;
        const double centre[2] = {scale * (floor(trees_unit(1, 2 * i) * 64) / 64 - 0.5),
                                  scale * (floor(trees_unit(1, 2 * i + 1) * 64) / 64 - 0.5)};
        const froe_kind kinds[] = {FROE_SEGMENT, FROE_BOX, FROE_BALL, FROE_POINT};
        assert_int_equal(add(scene, kinds[i % 4], centre, size), FROE_OK);
    }
    return scene;
}

static void numbers_of_any_size(void **state) {
    const double scales[] = {0x1p990, 0x1p1023, 0x1p-800, 0x1p-1020, 0x1p-1066};
    (void)state;
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        world w = world_begin("scaled", scaled(scales[i]));
        for (uint64_t seed = 0; seed < 24; seed++) ask_at_borders(&w, seed, scales[i]);
        world_end(&w);
    }
}

/* Boxes of half sizes 1/8 to 1/4 with corners on a lattice, some of them one double beside it. */
static void scatter_on_lattice(froe_scene *scene, double (*boxes)[6], uint32_t count, size_t dim) {
    for (uint32_t i = 0; i < count; i++) {
        for (size_t k = 0; k < dim; k++) {
            const double lo = trees_random(1, 6 * i + k, 96) / 64.0 - 0.75;
            boxes[i][k] = i % 5 ? lo : nextafter(lo, INFINITY);
            boxes[i][dim + k] = lo + (16 + trees_random(2, 6 * i + k, k ? 16 : 1)) / 64.0;
        }
        for (size_t k = 0; !i && k < dim; k++) boxes[i][k] = 2, boxes[i][dim + k] = 4; /* one of a larger class */
        if (i && i % 5 == 0) boxes[i][dim] = nextafter(boxes[i][dim], INFINITY);
        assert_int_equal(trees_add(scene, FROE_BOX, 1, boxes[i], NULL, NULL), FROE_OK);
    }
}

static bool boxes_meet(const double *a, const double *b, size_t dim) {
    bool meet = true;
    for (size_t k = 0; k < dim; k++) meet &= a[k] <= b[dim + k] && b[k] <= a[dim + k];
    return meet;
}

/* Windows that reach as far as the class of the boxes, one double more or less, so that they touch them and their
 * centres lie on cuts: few are larger than a leaf. */
static void check_touching(size_t dim, uint32_t queries) {
    enum { COUNT = 2000 };
    static double boxes[COUNT][6];
    froe_scene *scene;
    froe_query *q;
    froe_list list;
    size_t answers = 0;
    assert_int_equal(froe_scene_new((int)dim, NULL, &scene), FROE_OK);
    scatter_on_lattice(scene, boxes, COUNT, dim);
    froe_tree *tree = trees_build(scene, "kd", 8);
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    for (uint32_t i = 0; i < queries; i++) {
        const double reaches[] = {0.125, nextafter(0.125, 1), nextafter(0.125, 0), 0.0625};
        double window[6];
        froe_range range = froe_range_defaults();
        size_t expected = 0;
        for (size_t k = 0; k < dim; k++) {
            const double centre = i % 3 ? trees_random(3, 3 * i + k, 112) / 64.0 - 0.875 : 0;
            window[k] = centre - reaches[i % 4], window[dim + k] = centre + reaches[i % 4];
        }
        range.points = window, range.walk = FROE_WALK_CLASSES;
        assert_int_equal(froe_query_range(q, &range, &list, NULL), FROE_OK);
        for (uint32_t j = 0; j < COUNT; j++) expected += boxes_meet(boxes[j], window, dim);
        for (size_t j = 0; j < list.count; j++) assert_true(boxes_meet(boxes[list.ids[j]], window, dim));
        assert_int_equal(list.count, expected);
        answers += expected;
    }
    assert_true(answers > queries);
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void what_touches_is_found(void **state) {
    (void)state;
    check_touching(2, 20000);
    check_touching(3, 6000);
}

/* ---------------------------------------------------------------------- cells -- */

/* The smallest cell before this one that holds it. */
static uint32_t parent_of(const query_classes *p, uint32_t cell) {
    for (uint32_t i = cell; i > 0; i--)
        if (query_cell_holds(p, i - 1, query_cell_corner(p, cell))) return i - 1;
    return FROE_NONE;
}

static size_t times_listed(const query_classes *p, uint32_t cell, uint32_t object) {
    size_t times = 0;
    for (; cell != FROE_NONE; cell = p->cells[cell].refers ? p->cells[cell].parent : FROE_NONE)
        for (uint32_t i = 0; i < p->cells[cell].count; i++) times += p->ids.data[p->cells[cell].first + i] == object;
    return times;
}

/* The class of an object by multiplying: the least power of two that is greater than its extent. */
static int class_of_object(const froe_scene *scene, uint32_t object) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], extent = 0;
    int level = -1074;
    scene_object_bounds(scene, object, lo, hi);
    for (int k = 0; k < froe_scene_dim(scene); k++) extent = fmax(extent, hi[k] - lo[k]);
    while (extent > 0 && ldexp(1, level) <= extent) level++;
    return level;
}

/* Is the cube of the object's class around a corner, without its far sides, one that the bounds of the object meet? */
static bool reaches_cube(const froe_scene *scene, uint32_t object, const double *corner, int level) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    bool reaches = true;
    scene_object_bounds(scene, object, lo, hi);
    for (int k = 0; k < froe_scene_dim(scene); k++) {
        const double cube = cube_corner(corner[k], level);
        reaches &= cube_digit(cube_corner(lo[k] + 0.0, level), cube) == CUBE_ALIKE ||
                   cube_digit(cube_corner(hi[k] + 0.0, level), cube) == CUBE_ALIKE;
    }
    return reaches;
}

static void check_cell(froe_query *q, const query_classes *p, uint32_t cell, const int *classes) {
    const query_cell *c = p->cells + cell;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    size_t own = 0;
    if (cell)
        assert_true(cube_compare(p->dim, query_cell_corner(p, cell - 1), c[-1].level, query_cell_corner(p, cell),
                                 c->level) < 0);
    assert_int_equal(c->parent, parent_of(p, cell));
    cube_bounds(p->dim, query_cell_corner(p, cell), c->level, lo, hi);
    for (uint32_t i = 0; i < froe_scene_object_count(q->tree->scene); i++) {
        const bool near =
            classes[i] >= c->level && reaches_cube(q->tree->scene, i, query_cell_corner(p, cell), classes[i]);
        const bool there = near && query_object_meets_box(q, i, lo, hi);
        const size_t times = times_listed(p, cell, i);
        assert_true(times <= 1);
        if (there) assert_int_equal(times, 1);
        if (!there && !c->refers) assert_int_equal(times, 0);
        own += times && classes[i] == c->level;
    }
    assert_int_equal(own, c->own);
}

/* Every list of every cell is that of a search of all objects; the bytes stay linear. */
static void cells_list_what_their_cubes_meet(void **state) {
    (void)state;
    for (int dim = 2; dim <= 4; dim++) {
        const uint32_t count = dim == 2 ? 400 : 150;
        const unsigned kinds = dim == 4 ? SOLID_KINDS : SOME;
        froe_scene *scene = mixed(dim, kinds, count, 7, dim == 3, 13);
        froe_tree *tree = trees_build(scene, "kd", 8);
        froe_query *q;
        const query_classes *p;
        int classes[400];
        assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
        assert_int_equal(query_classes_of(q, &p, NULL), FROE_OK);
        assert_true(p->count >= count / 4);
        for (uint32_t i = 0; i < count; i++) classes[i] = class_of_object(scene, i);
        for (uint32_t i = 0; i < p->count; i++) check_cell(q, p, i, classes);
        froe_query_free(q);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

/* ------------------------------------------------------------ logarithmic work -- */

/* What a search took, all of it. */
static uint64_t work_of(froe_query *q) {
    const froe_query_stats s = froe_query_statistics(q);
    return s.nodes + s.leaves + s.tests + s.steps;
}

/* A context for n objects, each of its own size, `spread` powers of two apart in all: squares along a diagonal, or
 * segments across it, whose bounds have almost a corner in common, which no segment is near, and whose cells are nested
 * n deep. */
static froe_query *many_sizes(uint32_t n, double spread, bool across, froe_tree **tree) {
    froe_scene *scene;
    froe_query *q;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (uint32_t i = 0; i < n; i++) {
        const double s = exp2(-spread * i / n), next = exp2(-spread / n), off = s * 0x1p-20;
        const double square[4] = {s, s, s * (1 + 0.4 * fmin(1, 1 / next - 1)), s * (1 + 0.4 * fmin(1, 1 / next - 1))};
        const double line[4] = {off, 0.75 * s, 0.75 * s, off};
        assert_int_equal(trees_add(scene, across ? FROE_SEGMENT : FROE_BOX, 1, across ? line : square, NULL, NULL),
                         FROE_OK);
    }
    *tree = trees_build(scene, "kd", 8);
    assert_int_equal(froe_query_new(*tree, &q, NULL), FROE_OK);
    froe_scene_free(scene);
    return q;
}

/* The most work of small windows at two places of every object, a corner of its bounds and one of its own; answers are
 * those of the tree. */
static uint64_t most_work(froe_query *q, double least) {
    const froe_scene *scene = q->tree->scene;
    uint64_t most = 0;
    for (uint32_t i = 0; i < 2 * froe_scene_object_count(scene); i++) {
        froe_range range = froe_range_defaults();
        double lo[2], hi[2], window[4];
        uint64_t count, expected;
        scene_object_bounds(scene, i / 2, lo, hi);
        const double *x = i % 2 ? lo : froe_scene_vertex(scene, froe_scene_corner(scene, i / 2, 0));
        for (int k = 0; k < 2; k++) window[k] = x[k] - least / 4, window[2 + k] = x[k] + least / 4;
        range.points = window;
        assert_int_equal(froe_query_count(q, &range, &expected, NULL), FROE_OK);
        range.walk = FROE_WALK_CLASSES;
        assert_int_equal(froe_query_count(q, &range, &count, NULL), FROE_OK); /* the first makes the cells */
        work_of(q);
        assert_int_equal(froe_query_count(q, &range, &count, NULL), FROE_OK);
        assert_int_equal(count, expected);
        const uint64_t work = work_of(q);
        if (work > most) most = work;
    }
    return most;
}

/* De Berg, Corollary 3.2, with 100 to 3,200 sizes: all work of a range no larger than any object is logarithmic, and
 * what is kept for an object is bounded. */
static void small_ranges_take_logarithmic_time_whatever_the_sizes(void **state) {
    (void)state;
    for (int across = 0; across < 2; across++)
        for (uint32_t n = 100; n <= 3200; n *= 2) {
            const double spread = fmin(n, across ? 900 : 1000);
            froe_tree *tree;
            froe_query *q = many_sizes(n, spread, across, &tree);
            const query_classes *p;
            assert_int_equal(query_classes_of(q, &p, NULL), FROE_OK);
            const uint64_t most = most_work(q, exp2(-spread) * 0.1);
            assert_true((double)most <= 16 * log2(n) + 8 * n / spread); /* so many of one class */
            assert_true(p->count <= 4 * n && p->ids.count <= 40 * n);
            froe_query_free(q);
            froe_tree_free(tree);
        }
}

/* One class: a range looks at one to four lists, of bounded length. */
static void a_small_range_is_one_to_four_locations(void **state) {
    froe_scene *scene = mixed(2, 1 << FROE_BOX, 2000, 1, false, 12);
    froe_tree *tree = trees_build(scene, "density", 1);
    froe_query *q;
    (void)state;
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    for (uint32_t i = 0; i < 500; i++) {
        const double centre[2] = {trees_unit(1, 2 * i), trees_unit(1, 2 * i + 1)};
        froe_range range = froe_range_defaults();
        uint64_t count, expected;
        range.shape = FROE_SHAPE_BALL, range.points = centre, range.radius = 0.125;
        assert_int_equal(froe_query_count(q, &range, &expected, NULL), FROE_OK);
        range.walk = FROE_WALK_CLASSES;
        froe_query_statistics(q);
        assert_int_equal(froe_query_count(q, &range, &count, NULL), FROE_OK);
        assert_int_equal(count, expected);
        const froe_query_stats stats = froe_query_statistics(q);
        assert_in_range(stats.leaves, 1, 4);
        assert_int_equal(stats.nodes, 0);
        assert_int_equal(stats.queries, 1);
    }
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

/* More objects across one cube than a cell copies: its cells refer to larger ones, and find the same. */
static void crowded_cells_refer_to_larger_ones(void **state) {
    froe_scene *scene;
    froe_query *q;
    const query_classes *p;
    size_t refer = 0;
    (void)state;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (uint32_t i = 0; i < 2 * CLASSES_MOST; i++) {
        const double line[4] = {0, 0.25 + i * 0x1p-12, 0.9, 0.25 + i * 0x1p-12};
        const double x = 0.5 + i * 0x1p-12, dot[4] = {x, 0.25, x + 0x1p-14, 0.25 + 0x1p-14};
        assert_int_equal(trees_add(scene, FROE_SEGMENT, 1, line, NULL, NULL), FROE_OK);
        assert_int_equal(trees_add(scene, FROE_BOX, 1, dot, NULL, NULL), FROE_OK);
    }
    froe_tree *tree = trees_build(scene, "kd", 8);
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    assert_int_equal(query_classes_of(q, &p, NULL), FROE_OK);
    for (uint32_t i = 0; i < p->count; i++) refer += p->cells[i].refers;
    assert_true(refer > CLASSES_MOST);
    assert_true(p->ids.count < 8 * froe_scene_object_count(scene));
    most_work(q, 0x1p-14);
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

/* ---------------------------------------------------------------- contexts -- */

enum { MANY = 700 };

static void make_ranges(froe_range *ranges, double *points) {
    for (uint32_t i = 0; i < MANY; i++) {
        double *x = points + 2 * i;
        x[0] = trees_unit(3, 2 * i), x[1] = trees_unit(3, 2 * i + 1);
        ranges[i] = froe_range_defaults();
        ranges[i].shape = FROE_SHAPE_BALL;
        ranges[i].points = x;
        ranges[i].radius = ldexp(1, -(int)(i % 12));
        ranges[i].walk = FROE_WALK_CLASSES;
    }
}

static void threads_say_the_same(void **state) {
    static froe_range ranges[MANY];
    static double points[2 * MANY];
    froe_scene *scene = mixed(2, SOME, 3000, 9, false, 14);
    froe_tree *tree = trees_build(scene, "density", 8);
    froe_query *q;
    froe_answers one, many;
    froe_batch_options o = froe_batch_defaults();
    (void)state;
    make_ranges(ranges, points);
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    o.threads = 4;
    assert_int_equal(froe_batch_range(q, ranges, MANY, &o, &many, NULL),
                     FROE_OK); /* classes are made by many at once */
    o.threads = 1;
    assert_int_equal(froe_batch_range(q, ranges, MANY, &o, &one, NULL), FROE_OK);
    assert_memory_equal(one.starts, many.starts, (MANY + 1) * sizeof *one.starts);
    assert_memory_equal(one.ids, many.ids, one.starts[MANY] * sizeof *one.ids);
    froe_answers_free(&one), froe_answers_free(&many);
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void nothing_is_allocated_after_the_first_queries(void **state) {
    static froe_range ranges[MANY];
    static double points[2 * MANY];
    test_memory m;
    const froe_allocator alloc = test_memory_begin(&m);
    froe_scene *scene;
    froe_tree *tree;
    froe_query *q;
    froe_list list;
    froe_build_options o = froe_build_defaults();
    (void)state;
    make_ranges(ranges, points);
    o.method = "density";
    assert_int_equal(froe_scene_new(2, &alloc, &scene), FROE_OK);
    assert_int_equal(trees_scatter(scene, FROE_BOX, 300, 0, 0.1, 3), FROE_OK);
    assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    for (size_t i = 0; i < MANY; i++) assert_int_equal(froe_query_range(q, ranges + i, &list, NULL), FROE_OK);
    const size_t calls = m.calls;
    for (size_t i = 0; i < MANY; i++) assert_int_equal(froe_query_range(q, ranges + i, &list, NULL), FROE_OK);
    assert_int_equal(m.calls, calls);
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
    test_memory_end(&m);
}

static froe_status search(void *user, const froe_allocator *alloc) {
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_query *q = NULL, *fork = NULL;
    froe_list list;
    froe_range range = froe_range_defaults();
    const double point[2] = {0.5, 0.5};
    froe_build_options o = froe_build_defaults();
    (void)user;
    o.method = "kd";
    range.shape = FROE_SHAPE_BALL, range.points = point, range.radius = 0.02, range.walk = FROE_WALK_CLASSES;
    froe_status status = froe_scene_new(2, alloc, &scene);
    if (!status) status = trees_scatter(scene, FROE_SEGMENT, 40, 0, 0.3, 3);
    if (!status) status = froe_build(scene, &o, &tree, NULL);
    if (!status) status = froe_query_new(tree, &q, NULL);
    for (int i = 0; i < 2 && !status; i++) {
        status = froe_query_range(q, &range, &list, NULL);
        if (status) (void)froe_query_range(q, &range, &list, NULL); /* nothing is left half made */
    }
    if (!status) status = froe_query_fork(q, &fork, NULL);
    if (!status) status = froe_query_range(fork, &range, &list, NULL);
    froe_query_free(fork);
    froe_query_free(q);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

static void classes_survive_every_failing_allocation(void **state) {
    (void)state;
    assert_true(test_memory_each(search, NULL) > 40);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_of_many_sizes),
        cmocka_unit_test(one_small_object_among_large_ones),
        cmocka_unit_test(points_have_no_size),
        cmocka_unit_test(little_or_nothing),
        cmocka_unit_test(numbers_of_any_size),
        cmocka_unit_test(what_touches_is_found),
        cmocka_unit_test(cells_list_what_their_cubes_meet),
        cmocka_unit_test(small_ranges_take_logarithmic_time_whatever_the_sizes),
        cmocka_unit_test(a_small_range_is_one_to_four_locations),
        cmocka_unit_test(crowded_cells_refer_to_larger_ones),
        cmocka_unit_test(threads_say_the_same),
        cmocka_unit_test(nothing_is_allocated_after_the_first_queries),
        cmocka_unit_test(classes_survive_every_failing_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
