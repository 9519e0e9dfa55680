/* test_space_near.c: what is nearest by packed trees of space: what kernels say of distances, and what neighbours have
 * in common. */
#include "query/spaces.h"
#include "support/memory.h"

/* Every triangle of a block is found, no nearer than its key, and no further away than its end. Of most
 * the end is less than 9/8 of the key. */
static void check_block_around(froe_query *q, const space_kernels *kernels, const space_header *h, uint64_t *sure) {
    space_walk *w = &q->space->walk;
    uint32_t objects[512];
    float keys[512], ends[512];
    space_found found = {objects, keys, ends, 0};
    w->point.one = false;
    kernels->near(h, &w->point, 0, (float)INFINITY, &found);
    assert_int_equal(found.count, h->count);
    for (uint32_t i = 0; i < h->triangles; i++) {
        assert_int_equal(objects[i], space_ids(h)[i] & PACKED_OBJECT);
        const geom_body body = scene_body(q->tree->scene, objects[i]);
        const geom_distance d = geom_distance_from(&q->numbers, q->near.point, &body);
        const double from = sqrt((double)keys[i] / w->per), to = sqrt((double)ends[i] / w->per);
        assert_true(geom_distance_compare_to(&q->numbers, q->near.point, &d, from * (1 - 0x1p-45)) >= 0);
        assert_true(geom_distance_compare_to(&q->numbers, q->near.point, &d, to * (1 + 0x1p-45)) <= 0);
        *sure += isfinite(ends[i]) && to <= 1.125 * from;
    }
}

static void keys_and_ends_hold_distances(void **state) {
    uint64_t sure = 0, other = 0, all = 0;
    (void)state;
    for (int i = 0; i < KINDS; i++) {
        froe_tree *t = tree_of(kinds + i);
        froe_query *q;
        bool begun = true;
        assert_int_equal(froe_query_new(t, &q, NULL), FROE_OK);
        q->near.scale = 1;
        for (uint64_t draw = 0; draw < 60 && t->packed.wide; draw++) {
            odd_point(t, 7000 + draw, q->near.point);
            for (int k = 0; k < 3 && draw % 6 == 5; k++) q->near.point[k] *= draw % 4 == 1 ? 50 : 500;
            assert_int_equal(space_walk_near(q, &q->space->walk, SPACE_ALL, &begun), FROE_OK);
            for (uint32_t n = 0; begun && n < t->node_count; n++) {
                if (!tree_is_leaf(t->nodes + n)) continue;
                const space_header *h = space_block(t, t->nodes[n].child);
                all += h->triangles;
                for (size_t kernel = 0; space_kernels_at(kernel); kernel++)
                    if (!kernel || draw % 4 == kernel)
                        check_block_around(q, space_kernels_at(kernel), h, kernel ? &other : &sure);
            }
        }
        froe_query_free(q);
        froe_tree_free(t);
    }
    if (2 * sure < all) fail_msg("%zu of %zu", (size_t)sure, (size_t)all);
}

/* Of a leaf, what is certainly further away than something else is left out; whatever may be the nearest stays. */
static void check_one(const space_kernels *kernels, const space_header *h, space_point *point, size_t kept[2]) {
    uint32_t objects[2][512];
    float keys[2][512], ends[2][512], least = (float)INFINITY;
    space_found found[2];
    for (int one = 0; one < 2; one++) {
        found[one] = (space_found){objects[one], keys[one], ends[one], 0};
        point->one = one;
        kernels->near(h, point, 0, (float)INFINITY, found + one);
        kept[one] += found[one].count;
    }
    for (size_t i = 0; i < found[0].count; i++) least = ends[0][i] < least ? ends[0][i] : least;
    for (size_t i = 0, at = 0; i < found[0].count; i++) {
        const bool there = at < found[1].count && objects[1][at] == objects[0][i];
        assert_true(there || keys[0][i] > least);
        if (there) assert_true(keys[1][at] == keys[0][i] && ends[1][at] == ends[0][i]);
        at += there;
    }
}

static void of_one_leaf_only_what_may_be_nearest_is_kept(void **state) {
    froe_tree *t = tree_of(kinds);
    froe_query *q;
    (void)state;
    assert_int_equal(froe_query_new(t, &q, NULL), FROE_OK);
    q->near.scale = 1;
    for (size_t kernel = 0; space_kernels_at(kernel); kernel++) {
        size_t kept[2] = {0, 0};
        for (uint64_t draw = 0; draw < 40; draw++) {
            bool begun;
            odd_point(t, draw, q->near.point);
            assert_int_equal(space_walk_near(q, &q->space->walk, SPACE_ALL, &begun), FROE_OK);
            for (uint32_t n = 0; begun && n < t->node_count; n++)
                if (tree_is_leaf(t->nodes + n))
                    check_one(space_kernels_at(kernel), space_block(t, t->nodes[n].child), &q->space->walk.point, kept);
        }
        assert_true(4 * kept[1] < kept[0]);
    }
    froe_query_free(q);
    froe_tree_free(t);
}

/* Cones of 60 triangles around an apex, on a lattice of nine, each with the least number elsewhere. */
static froe_tree *tree_of_cones(void) {
    enum { CONES = 9, SIDES = 60 };
    static double c[CONES * SIDES * 9];
    froe_scene *scene;
    froe_tree *tree;
    froe_build_options o = froe_build_defaults();
    for (size_t i = 0; i < CONES * SIDES; i++) {
        double *x = c + 9 * (i * 7 % (CONES * SIDES));
        const double middle[2] = {3.0 * (double)(i / SIDES % 3), 3.0 * (double)(i / SIDES / 3)};
        for (size_t j = 0; j < 2; j++) {
            const double angle = 6.283185307179586 * (double)((i + j) % SIDES) / (double)SIDES;
            x[3 * j] = middle[0] + cos(angle), x[3 * j + 1] = middle[1] + sin(angle), x[3 * j + 2] = 0;
        }
        x[6] = middle[0], x[7] = middle[1], x[8] = 1;
    }
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POLYGON, CONES * SIDES, c, NULL, NULL), FROE_OK);
    o.method = "index", o.leaf = 6;
    assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
    froe_scene_free(scene);
    return tree;
}

/* The nearest corner or edge belongs to many: the one with the least number is the nearest. */
static void of_triangles_side_by_side_the_first_is_nearest(void **state) {
    froe_tree *tree = tree_of_cones(), *general = reference_of(tree);
    froe_query *q, *reference;
    size_t apexes = 0;
    (void)state;
    assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
    assert_int_equal(froe_query_new(general, &reference, NULL), FROE_OK);
    for (uint64_t draw = 0; draw < 500; draw++) {
        froe_neighbours found, wanted;
        double x[3] = {8 * trees_unit(51, draw) - 1, 8 * trees_unit(52, draw) - 1, 4 * trees_unit(53, draw) - 1};
        if (draw % 3 == 0) x[0] = round(x[0] / 3) * 3 + 0.1, x[1] = round(x[1] / 3) * 3, x[2] = 1.5 + x[2];
        const double bound = draw % 5 == 4 ? 1 : (double)INFINITY;
        assert_int_equal(froe_query_near(reference, x, 1, bound, &wanted, NULL), FROE_OK);
        assert_int_equal(froe_query_near(q, x, 1, bound, &found, NULL), FROE_OK);
        assert_int_equal(found.count, wanted.count);
        if (!found.count) continue;
        if (found.items->object != wanted.items->object || found.items->distance != wanted.items->distance)
            fail_msg("point %d: %u at %a, not %u at %a", (int)draw, found.items->object, found.items->distance,
                     wanted.items->object, wanted.items->distance);
        apexes += found.items->distance == sqrt(0.1 * 0.1 + (x[2] - 1) * (x[2] - 1));
    }
    assert_true(apexes > 20);
    assert_true(froe_query_statistics(q).exact <= froe_query_statistics(reference).exact);
    froe_query_free(q);
    froe_query_free(reference);
    froe_tree_free(general);
    froe_tree_free(tree);
}

static froe_status ask_without_memory(void *user, const froe_allocator *alloc) {
    froe_tree tree = *(const froe_tree *)user;
    froe_query *q = NULL;
    froe_neighbours found;
    tree.alloc = *alloc;
    froe_status status = froe_query_new(&tree, &q, NULL);
    for (uint64_t draw = 0; draw < 20 && !status; draw++) {
        double x[3];
        odd_point(&tree, draw, x);
        status = froe_query_near(q, x, 1, INFINITY, &found, NULL);
    }
    froe_query_free(q);
    return status;
}

static void memory_may_end_at_every_allocation(void **state) {
    (void)state;
    froe_tree *tree = tree_of_cones();
    assert_true(test_memory_each(ask_without_memory, tree) > 5);
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(keys_and_ends_hold_distances),
        cmocka_unit_test(of_one_leaf_only_what_may_be_nearest_is_kept),
        cmocka_unit_test(of_triangles_side_by_side_the_first_is_nearest),
        cmocka_unit_test(memory_may_end_at_every_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
