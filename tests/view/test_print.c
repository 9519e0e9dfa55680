/* Convex rings on the page, and what of rings and segments is on it. */
#include "../tree/trees.h"
#include "pages.h"
#include "view/print.h"

static const print_point square[] = {
    {0, 0}, {0, 2}, {2, 2}, {2, 0}}; /* y points down: this turns left as one sees it */

static bool overlap(const print_point *a, size_t a_count, double x, double y, double margin) {
    print_point b[4];
    for (int i = 0; i < 4; i++) b[i] = (print_point){square[i].x + x, square[i].y + y};
    const bool there = print_overlap(a, a_count, b, 4, margin);
    assert_int_equal(there, print_overlap(b, 4, a, a_count, margin));
    return there;
}

static void rings_overlap_by_more_than_a_margin(void **state) {
    (void)state;
    assert_true(print_area(square, 4) > 0);
    assert_true(overlap(square, 4, 1, 1, 0.5));
    assert_true(overlap(square, 4, 1.75, 0, 0.125));
    assert_false(overlap(square, 4, 1.75, 0, 0.5));
    assert_false(overlap(square, 4, 2, 0, 0));
    assert_true(overlap(square, 4, 2, 0, -0.125));
    assert_false(overlap(square, 4, 2.5, 0, -0.125));
    assert_false(overlap(square, 4, -3, 5, -0.125));
}

/* Rounding makes one point of the page from two, or two with any direction between them: that no side has it says
 * nothing about the ring. Once a face of a house was painted over one before it for that. */
static void corners_that_all_but_coincide_separate_nothing(void **state) {
    (void)state;
    for (int way = 0; way < 9; way++) {
        const double dx = (way % 3 - 1) * 0x1p-50, dy = (way / 3 - 1) * 0x1p-50;
        const print_point five[] = {{0, 0}, {dx, dy}, {0, 2}, {2, 2}, {2, 0}};
        assert_true(overlap(five, 5, 1, 1, -1e-6));
        assert_true(overlap(five, 5, -1, -1, -1e-6));
        assert_true(overlap(five, 5, 1, -1, -1e-6));
        assert_false(overlap(five, 5, 3, 0, -1e-6));
        assert_false(overlap(five, 5, -3, -1, -1e-6));
    }
}

/* A place on the page at the distance of the scene, in sizes of the page: its corners are 0 0 and 1 1. */
static void put(const page *p, double x, double y, double out[3]) {
    point_at(p, x * p->view.width, y * p->view.height, out);
}

static void segments_end_at_the_sides_of_the_page(void **state) {
    static const struct {
        double from[2], to[2], beyond;
        bool left;
        double share[2];
    } cases[] = {
        {{0.25, 0.25}, {0.75, 0.5}, 0, true, {0, 1}},
        {{-1, 0.5}, {1, 0.5}, 0, true, {0.5, 1}},
        {{0.5, 2}, {0.5, -2}, 0, true, {0.25, 0.5}},
        {{-1, 0.5}, {1, 0.5}, 0.5, true, {0.25, 1}},
        {{2, 0.25}, {3, 0.5}, 0, false, {0}},
        {{2, 0.25}, {3, 0.5}, 3, true, {0, 1}},
        {{-0.5, 0.25}, {0.25, -0.75}, 0, false, {0}}, /* it passes a corner */
        {{0.25, -2}, {0.5, -1}, 0, false, {0}},
        {{0.25, 2}, {0.5, 5}, 0.5, false, {0}},
        {{1.5, -0.5}, {-0.5, 1.5}, 0, true, {0.25, 0.75}},
    };
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 5, 0, 1, "density", 1);
    page p;
    open_page(&p, tree);
    for (int parallel = 0; parallel < 2; parallel++) {
        froe_camera c = froe_camera_defaults();
        c.parallel = parallel;
        c.width = c.height = 128;
        place(&p, &c);
        for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
            double from[3], to[3], share[2] = {0, 1};
            put(&p, cases[i].from[0], cases[i].from[1], from);
            put(&p, cases[i].to[0], cases[i].to[1], to);
            assert_int_equal(print_clip_segment(&p.view, from, to, cases[i].beyond, share), cases[i].left);
            for (int k = 0; k < 2 && cases[i].left; k++) assert_true(fabs(share[k] - cases[i].share[k]) < 1e-9);
        }
    }
    close_page(&p);
    froe_tree_free(tree);
}

typedef struct printing {
    const page *p;
    double x[8][2]; /* sizes of the page */
    size_t corners, left;
} printing;

static froe_status print_ring_of(void *user, const froe_allocator *alloc) {
    const printing *r = user;
    print_press press = {.alloc = *alloc, .view = &r->p->view};
    print_ring out = {0};
    bool ok = true, cut = false;
    print_begin(&press);
    for (size_t i = 0; ok && i < r->corners; i++) {
        double x[3];
        put(r->p, r->x[i][0], r->x[i][1], x);
        ok = print_add(&press, x);
    }
    ok = ok && print_end(&press, &out, &cut);
    if (ok) {
        const double least = -PRINT_BEYOND * r->p->view.width, most = (1 + PRINT_BEYOND) * r->p->view.width;
        assert_true(cut);
        assert_int_equal(out.count, r->left);
        for (size_t i = 0; i < out.count; i++) {
            assert_true(out.data[i].x > least - 1e-6 && out.data[i].x < most + 1e-6);
            assert_true(out.data[i].y > least - 1e-6 && out.data[i].y < most + 1e-6);
        }
    }
    print_free(&press);
    array_free(alloc, &out);
    return ok ? FROE_OK : FROE_E_MEMORY;
}

/* Faces far beyond the page, of which a corner, a strip or nothing is left. The first corner lies inside or outside. */
static void faces_are_cut_beyond_the_page_or_memory_is_missing(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 5, 0, 1, "density", 1);
    page p;
    open_page(&p, tree);
    look_from(&p, 0, 0, 1, 0);
    p.view.height = p.view.width;
    printing cases[] = {
        {&p, {{0, 0}, {9, 0}, {0, 9}}, 3, 4},
        {&p, {{9, 0}, {0, 9}, {0, 0}}, 3, 4},
        {&p, {{-9, 0.5}, {9, 0.5}, {9, 1}, {-9, 1}}, 4, 4},
        {&p, {{5, 0}, {9, 0}, {9, 9}}, 3, 0},
        {&p, {{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}, 4, 4},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_true(test_memory_each(print_ring_of, cases + i) > 0);
    close_page(&p);
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rings_overlap_by_more_than_a_margin),
        cmocka_unit_test(corners_that_all_but_coincide_separate_nothing),
        cmocka_unit_test(segments_end_at_the_sides_of_the_page),
        cmocka_unit_test(faces_are_cut_beyond_the_page_or_memory_is_missing),
    };
    return cmocka_run_group_tests_name("view/print", tests, NULL, NULL);
}
