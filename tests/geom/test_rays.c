/* Where rays meet bodies first, against the oracle: every kind, every class of coordinates, every stage. */
#include "geom/bodies.h"
#include "geom/ray/ray.h"
#include <stdlib.h>

static uint64_t hits, misses, orders[3], sources[GEOM_SPHERE + 1], total;

typedef struct fixture {
    num_context context;
    bodies_case c;
    geom_ray ray;
} fixture;

static int setup(void **state) {
    fixture *f = calloc(1, sizeof *f);
    *state = f;
    return !f || num_context_new(NULL, &f->context) != FROE_OK;
}

static int teardown(void **state) {
    fixture *f = *state;
    froe_predicate_stats *s = &f->context.stats;
    print_message("  %llu hits, %llu misses, %llu calls, %llu exact\n", (unsigned long long)hits,
                  (unsigned long long)misses, (unsigned long long)s->calls, (unsigned long long)s->exact);
    assert_true(f->context.arena.high <= f->context.arena.capacity);
    num_context_free(&f->context);
    free(f);
    return 0;
}

/* Through two of the points; along an axis; or along a row of coordinates. */
static bool aim(fuzz_source *r, fixture *f) {
    int dim = f->c.dim, way = fuzz_int(r, 0, 3), axis = fuzz_int(r, 0, dim - 1);
    const double *to = bodies_at(&f->c, (uint32_t)fuzz_int(r, 0, BODIES_POINTS - 3));
    bool any = false;
    f->ray = (geom_ray){.dim = dim};
    for (int k = 0; k < dim; k++) {
        f->ray.o[k] = f->c.point[k];
        f->ray.d[k] = way == 0 ? (k == axis) * (to[0] < 0 ? -1.0 : 1.0) : way == 1 ? to[k] : to[k] - f->c.point[k];
        if (!isfinite(f->ray.d[k])) return false;
        any = any || f->ray.d[k] != 0;
    }
    return any;
}

static geom_hit check_hit(fixture *f, const geom_body *body, const exact_value *t, double bound, int beyond) {
    geom_hit hit;
    bool got = geom_ray_meets(&f->context, &f->ray, body, &hit);
    if (got != (t->s != NULL)) fail_msg("%s: %s", froe_kind_name(body->form), got ? "hit" : "missed");
    if (!got) return (geom_hit){.source = GEOM_START};
    double rounded = geom_hit_round(&f->context, &f->ray, &hit);
    if (!exact_rounds_to(t, rounded, 0)) fail_msg("%s: t = %.17g", froe_kind_name(body->form), rounded);
    if (geom_hit_compare_to(&f->context, &f->ray, &hit, bound) != beyond)
        fail_msg("%s: against %.17g", froe_kind_name(body->form), bound);
    assert_int_equal(geom_hit_compare_to(&f->context, &f->ray, &hit, INFINITY), -1);
    sources[hit.source]++;
    return hit;
}

static void try_rays(fixture *f, fuzz_source *r, fuzz_class kind) {
    bodies_draw(r, kind, f->c.dim, &f->c);
    if (!aim(r, f)) return;
    int shift = exact_shift(exact_shift(0, f->c.points, (size_t)(BODIES_POINTS * f->c.dim)), f->ray.d, FROE_MAX_DIM);
    exact_begin(shift);
    exact_value t[2] = {{NULL, NULL, NULL, NULL}, {NULL, NULL, NULL, NULL}};
    double bound[2] = {fabs(f->c.direction[0]), 1};
    int beyond[2] = {0, 0}, expected = 0;
    for (int i = 0; i < 2; i++) {
        exact_body b = exact_body_of(&f->c.body[i]);
        if (!exact_ray(f->ray.o, f->ray.d, &b, &t[i])) t[i].s = NULL;
        exact_value limit = exact_value_of(bound[i], 0);
        if (t[i].s) beyond[i] = exact_compare(&t[i], &limit);
        hits += t[i].s != NULL;
        misses += t[i].s == NULL;
    }
    bool both = t[0].s && t[1].s;
    if (both) orders[1 + (expected = exact_compare(&t[0], &t[1]))]++;
    for (num_stage first = NUM_FILTER; first <= NUM_EXACT; first++) {
        geom_hit hit[2];
        f->context.first = first;
        for (int i = 0; i < 2; i++) hit[i] = check_hit(f, &f->c.body[i], &t[i], bound[i], beyond[i]);
        if (both) assert_int_equal(geom_hit_compare(&f->context, &f->ray, &hit[0], &hit[1]), expected);
        total += 2;
    }
}

static void run_trials(fixture *f, int dim, int trials) {
    hits = misses = 0;
    for (int kind = 0; kind < FUZZ_CLASSES; kind++) {
        fuzz_source r = {(uint64_t)(kind * 1000 + dim)};
        f->c.dim = dim;
        for (int i = 0; i < bodies_trials((fuzz_class)kind, trials); i++) try_rays(f, &r, (fuzz_class)kind);
    }
    assert_true(hits > 500 / BODIES_SHARE && misses > 500 / BODIES_SHARE);
}

static void rays_in_the_plane(void **state) {
    run_trials(*state, 2, 4000);
}
static void rays_in_space(void **state) {
    run_trials(*state, 3, 4000);
    for (int i = 0; i < 3; i++) assert_true(orders[i] > 500 / BODIES_SHARE);
    for (int i = 0; i <= GEOM_SPHERE; i++) assert_true(sources[i] > 500 / BODIES_SHARE);
}
static void rays_in_five_dimensions(void **state) {
    run_trials(*state, 5, 2000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(rays_in_the_plane, setup, teardown),
        cmocka_unit_test_setup_teardown(rays_in_space, setup, teardown),
        cmocka_unit_test_setup_teardown(rays_in_five_dimensions, setup, teardown),
    };
    int failed = cmocka_run_group_tests_name("geom/rays", tests, NULL, NULL);
    print_message("%llu rays and bodies\n", (unsigned long long)total);
    return failed;
}
