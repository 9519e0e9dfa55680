/* test_snapshot.c: the present as an ordinary tree: where its vertices are exactly, against whole numbers (GMP) of the
 * plans as they are written; what is rounded, refused, and whether it made a difference. */
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "kinetic/motions.h"
#include "kinetic/moving.h"
#include "oracle/truth.h"
#include "support/memory.h"

typedef struct tally {
    size_t exact, rounded, unlike;
} tally;

static void set(mpz_t out, const froe_whole *a) {
    mpz_import(out, a->count, -1, sizeof *a->limbs, 0, 0, a->limbs);
    if (a->sign < 0) mpz_neg(out, out);
    assert_int_equal(mpz_sgn(out), a->sign);
    assert_int_equal(a->count == 0, a->sign == 0);
    char ours[4000], theirs[4000];
    assert_true(froe_whole_text(a, ours, sizeof ours) < sizeof ours);
    assert_string_equal(ours, mpz_get_str(theirs, 10, out));
}

/* x is the double nearest to the truth, and nothing else if that is one. */
static void check_double(double x, const mpq_t at, bool *exact) {
    mpq_t ours, off, other;
    mpq_inits(ours, off, other, NULL);
    mpq_set_d(ours, x);
    *exact &= mpq_equal(ours, at) != 0;
    mpq_sub(off, ours, at);
    mpq_abs(off, off);
    for (int way = -1; way <= 1; way += 2) {
        mpq_set_d(other, nextafter(x, way * (double)INFINITY));
        mpq_sub(other, other, at);
        mpq_abs(other, other);
        assert_true(mpq_cmp(off, other) <= 0);
    }
    mpq_clears(ours, off, other, NULL);
}

static void check_end(truth *g, const froe_kinetic *k, const froe_snapshot *s, uint32_t id, uint32_t object, int end) {
    const froe_motion *m = k->now.motion;
    froe_exact_place at;
    bool exact = true;
    mpz_t w;
    mpz_init(w);
    assert_true(froe_places_end(s->places, object, end, &at));
    assert_int_equal(at.w.sign, 1);
    truth_place(g, m, m->objects.data[id].vertices[end], k->now.tick, g->x[0]);
    const froe_whole *number[2] = {&at.x, &at.y};
    set(w, &at.w);
    assert_true((at.x.count && at.x.limbs[0] & 1) || (at.y.count && at.y.limbs[0] & 1) || at.w.limbs[0] & 1);
    uint32_t vertex = froe_scene_corner(froe_tree_scene(s->tree), object, (uint32_t)end);
    if (vertex == FROE_NONE) vertex = froe_scene_corner(froe_tree_scene(s->tree), object, 0);
    const double *coords = froe_scene_vertex(froe_tree_scene(s->tree), vertex);
    for (int c = 0; c < 2; c++) {
        set(mpq_numref(g->x[1][c]), number[c]);
        mpz_set(mpq_denref(g->x[1][c]), w);
        mpq_canonicalize(g->x[1][c]);
        assert_true(mpq_equal(g->x[1][c], g->x[0][c]));
        check_double(coords[c], g->x[0][c], &exact);
    }
    assert_int_equal(at.rounded, !exact);
    mpz_clear(w);
}

/* Node by node, by recursion: the cuts and their order. */
static bool match(const froe_kinetic *k, const uint32_t *index, uint32_t node, const froe_tree *tree, froe_node at) {
    froe_node_info info = froe_tree_node(tree, at);
    if (!node) return info.cut.kind == FROE_CUT_NONE;
    const ktree_node *n = ktree_node_at(&k->tree, node);
    for (int side = 0; side < 2; side++) {
        if (n->wall[side] == KTREE_NO_WALL) continue;
        if (info.cut.kind != FROE_CUT_VERTEX && info.cut.kind != FROE_CUT_CROSSING) return false;
        if (!match(k, index, n->child[side], tree, info.child[side])) return false;
        info = froe_tree_node(tree, info.child[1 - side]);
    }
    if (info.cut.kind != FROE_CUT_OBJECT) return false;
    const froe_scene *scene = froe_tree_scene(tree); /* the cut may be along an equal object, from end to end or back */
    const uint32_t object = index[n->segment], cut = info.cut.id[0];
    const uint32_t of[2] = {froe_scene_corner(scene, object, 0), froe_scene_corner(scene, object, 1)};
    const uint32_t along[2] = {froe_scene_corner(scene, cut, 0), froe_scene_corner(scene, cut, 1)};
    const bool reversed = along[0] != of[0], turned = k->now.segments.data[n->segment].turned != reversed;
    return of[0] == along[reversed] && of[1] == along[1 - reversed] &&
           match(k, index, n->child[turned ? KTREE_DOWN : KTREE_UP], tree, info.child[1]) &&
           match(k, index, n->child[turned ? KTREE_UP : KTREE_DOWN], tree, info.child[0]);
}

static void check_refusal(froe_kinetic *k, size_t rounded) {
    froe_snapshot_options o = froe_snapshot_defaults();
    froe_snapshot s = {.tree = NULL};
    froe_diagnostic why = {0};
    o.refuse = true, o.places = false;
    assert_int_equal(froe_kinetic_snapshot(k, &o, &s, &why), rounded ? FROE_E_UNSUPPORTED : FROE_OK);
    assert_null(s.places);
    assert_int_equal(s.tree == NULL, rounded > 0);
    if (rounded) assert_int_not_equal(why.object, FROE_NONE);
    froe_tree_free(s.tree);
}

static void check(froe_kinetic *k, tally *seen) {
    froe_snapshot s;
    froe_diagnostic why = {0};
    truth g;
    truth_init(&g);
    uint32_t *index = calloc(k->tree.segments.count + 1, sizeof *index), n = 0, points = 0;
    assert_non_null(index);
    if (froe_kinetic_snapshot(k, NULL, &s, &why)) fail_msg("%s", why.message);
    truth_set_time(&g, k->now.motion, k->now.tick, false);
    for (uint32_t id = 0; id < k->tree.segments.count; id++) {
        if (!ktree_segment_at(&k->tree, id)->alive) continue;
        for (int end = 0; end < 2; end++) check_end(&g, k, &s, id, n, end);
        points += !ktree_segment_at(&k->tree, id)->here;
        index[id] = n++;
    }
    assert_int_equal(froe_places_count(s.places), n);
    froe_exact_place none;
    assert_false(froe_places_end(s.places, n, 0, &none));
    assert_false(froe_places_end(s.places, 0, 2, &none));
    const bool same = match(k, index, ktree_node_at(&k->tree, KTREE_ROOT)->child[0], s.tree, froe_tree_root(s.tree));
    if (s.alike) assert_true(same); /* it compares which ends and crossings, too */
    if (!s.rounded && !points) assert_true(s.alike);
    assert_int_equal(froe_tree_audit(s.tree, NULL, &why), FROE_OK);
    check_refusal(k, s.rounded);
    seen->exact += !s.rounded;
    seen->rounded += s.rounded > 0;
    seen->unlike += !s.alike;
    free(index);
    froe_tree_free(s.tree);
    froe_places_free(s.places);
    truth_clear(&g);
}

static void check_motion(froe_motion *m, double end, tally *seen) {

    const froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
    for (int i = 0; i < 5; i++) {
        check(k, seen);
        assert_int_equal(froe_kinetic_advance(k, end * (i + 1) / 6, NULL, NULL, NULL), FROE_OK);
    }
    froe_kinetic_free(k);
    froe_motion_free(m);
}

static void snapshots_know_where_they_are(void **state) {
    (void)state;
    tally seen = {0, 0, 0};
    for (size_t i = 0; i < MOVING_KINDS; i++) check_motion(moving_new(moving_kinds + i, 3, NULL), MOVING_TIME, &seen);
    for (int kind = 0; kind < MOTION_KINDS; kind++) check_motion(motion_new((motion_kind)kind), 8, &seen);
    assert_true(seen.exact > 20 && seen.rounded > 20 && seen.unlike > 0);
}

static froe_status with_memory(void *user, const froe_allocator *alloc) {
    froe_motion *m = user;
    froe_kinetic *k = NULL;
    const froe_kinetic_options o = froe_kinetic_defaults();
    froe_snapshot s = {.tree = NULL};
    froe_status status = froe_kinetic_new(m, &o, alloc, &k, NULL);
    if (!status) status = froe_kinetic_snapshot(k, NULL, &s, NULL);
    froe_tree_free(s.tree);
    froe_places_free(s.places);
    froe_kinetic_free(k);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    static const moving_kind few = {
        .name = "few", .count = 3, .grid = 8, .length = 8, .speed = 1, .spin = 1, .legs = 3};
    froe_motion *m = moving_new(&few, 1, NULL);
    test_memory_each(with_memory, m);
    froe_motion_free(m);
}

/* Two segments in one place, given the same or the other way round, alone and with one across them, in all orders. The
 * tree names the first of them where the partition names the first in order. */
static void equal_segments_are_alike(void **state) {
    (void)state;
    const size_t starts[] = {0, 1, 2, 3, 4, 5, 6};
    const double times[6] = {0};
    for (int turn = 0; turn < 2; turn++)
        for (uint32_t count = 2; count <= 3; count++)
            for (uint32_t first = 0; first < count; first++) {
                double coords[] = {0, 0, 4, 1, 0, 0, 4, 1, 1, -2, 3, 2};
                if (turn) coords[4] = 4, coords[5] = 1, coords[6] = 0, coords[7] = 0;
                froe_moving b = froe_moving_defaults();
                b.vertex_count = 2 * count, b.count = count, b.starts = starts, b.times = times, b.coords = coords;
                froe_motion *m = motion_of(&b, NULL);
                froe_kinetic_options o = froe_kinetic_defaults();
                const uint32_t order[] = {first, (first + 1) % count, (first + 2) % count};
                froe_kinetic *k = NULL;
                froe_snapshot s = {0};
                o.order = order;
                assert_int_equal(froe_kinetic_new(m, &o, NULL, &k, NULL), FROE_OK);
                assert_int_equal(froe_kinetic_snapshot(k, NULL, &s, NULL), FROE_OK);
                assert_int_equal(s.rounded, 0);
                assert_true(s.alike);
                froe_tree_free(s.tree), froe_places_free(s.places);
                froe_kinetic_free(k);
                froe_motion_free(m);
            }
}

/* An allocator that counts the calls of other threads than the one that made it. */
typedef struct thread_log {
    pthread_t caller;
    atomic_size_t elsewhere;
} thread_log;

static void *logged_memory(void *user, void *ptr, size_t old_size, size_t new_size) {
    thread_log *log = user;
    (void)old_size;
    if (!pthread_equal(pthread_self(), log->caller)) atomic_fetch_add(&log->elsewhere, 1);
    if (new_size) return realloc(ptr, new_size);
    free(ptr);
    return NULL;
}

/* So many segments that the tree of a snapshot can be built by several threads. */
static void snapshots_take_as_many_threads_as_partitions(void **state) {
    (void)state;
    enum { COUNT = 6000 };
    static double coords[4 * COUNT];
    static const double times[2 * COUNT];
    static size_t starts[2 * COUNT + 1];
    for (size_t i = 0; i <= 2 * COUNT; i++) starts[i] = i;
    for (size_t i = 0; i < COUNT; i++) {
        double *at = coords + 4 * i;
        at[0] = at[2] = (double)(i % 80), at[1] = at[3] = (double)(i / 80);
        at[2] += 0.5, at[3] += 0.25;
    }
    froe_moving b = froe_moving_defaults();
    b.vertex_count = 2 * COUNT, b.count = COUNT, b.starts = starts, b.times = times, b.coords = coords;
    froe_motion *m = motion_of(&b, NULL);
    thread_log log = {.caller = pthread_self()};
    const froe_allocator alloc = {logged_memory, &log};
    froe_kinetic_options o = froe_kinetic_defaults();
    froe_kinetic *k = NULL;
    froe_snapshot s = {0};
    assert_int_equal(o.threads, 1);
    assert_int_equal(froe_kinetic_new(m, &o, &alloc, &k, NULL), FROE_OK);
    assert_int_equal(froe_kinetic_snapshot(k, NULL, &s, NULL), FROE_OK);
    assert_int_equal(log.elsewhere, 0);
    assert_true(s.alike);
    froe_tree_free(s.tree), froe_places_free(s.places);
    froe_kinetic_free(k);
    froe_motion_free(m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(snapshots_know_where_they_are), cmocka_unit_test(equal_segments_are_alike),
        cmocka_unit_test(snapshots_take_as_many_threads_as_partitions), cmocka_unit_test(every_allocation_may_fail)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
