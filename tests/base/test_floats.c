/* test_floats.c: froe's floating point begins and ends where it should, callbacks have the caller's and flags
 * survive. */
#include "base/floats.h"
#include "base/task.h"

#pragma GCC diagnostic ignored "-Wshadow" /* what begins within blocks, begins within blocks here */
#include "support/settings.h"

/* ------------------------------------------------------------------- nesting -- */

static bool own(void) {
    return base_floats_are_own(base_floats_now());
}

static bool is_lent(const floats_setting *s) {
    BASE_FLOATS_CALLER;
    return floats_are(s);
}

static void own_and_the_callers_follow_each_other_however_nested(void **state) {
    (void)state;
    for (size_t s = 0; s < FLOATS_SETTINGS; s++) {
        const floats_setting *setting = floats_settings + s;
        bool good = true;
        floats_set(setting);
        {
            BASE_FLOATS_OWN;
            good &= own() && is_lent(setting) && own();
            {
                BASE_FLOATS_OWN; /* a call within a call */
                good &= own();
            }
            good &= own() && is_lent(setting);
            {
                BASE_FLOATS_CALLER;
                good &= floats_are(setting);
                {
                    BASE_FLOATS_OWN; /* a callback that calls */
                    good &= own() && is_lent(setting) && own();
                }
                good &= floats_are(setting) && is_lent(setting);
            }
            good &= own();
        }
        good &= floats_are(setting) && is_lent(setting) && floats_are(setting);
        floats_set(floats_settings);
        assert_true(good);
    }
}

static void what_a_callback_sets_is_undone(void **state) {
    (void)state;
    for (size_t s = 0; s < FLOATS_SETTINGS; s++)
        for (size_t other = 0; other < FLOATS_SETTINGS; other++) {
            bool good = true;
            floats_set(floats_settings + s);
            {
                BASE_FLOATS_OWN;
                {
                    BASE_FLOATS_CALLER;
                    floats_set(floats_settings + other);
                }
                good &= own() && is_lent(floats_settings + s);
            }
            good &= floats_are(floats_settings + s);
            floats_set(floats_settings);
            assert_true(good);
        }
}

static void the_public_pair_does_the_same(void **state) {
    (void)state;
    floats_set(floats_settings + 1);
    const unsigned outer = froe_floats_begin(true), lent = (own() ? froe_floats_begin(false) : 99);
    const bool caller = floats_are(floats_settings + 1);
    froe_floats_end(lent);
    const bool again = own();
    froe_floats_end(outer);
    const bool kept = floats_are(floats_settings + 1);
    floats_set(floats_settings);
    assert_true(caller && again && kept);
}

/* --------------------------------------------------------------------- flags -- */

static void flags_of_the_caller_and_its_callbacks_stay(void **state) {
    (void)state;
    for (size_t s = 0; s < 5; s++) { /* those without traps, which raising would spring */
        floats_set(floats_settings + s);
        feclearexcept(FE_ALL_EXCEPT);
        feraiseexcept(FE_DIVBYZERO);
        {
            BASE_FLOATS_OWN;
            BASE_FLOATS_CALLER;
            feraiseexcept(FE_OVERFLOW);
        }
        const int raised = fetestexcept(FE_ALL_EXCEPT);
        floats_set(floats_settings);
        assert_int_equal(raised & FE_DIVBYZERO, FE_DIVBYZERO);
        assert_int_equal(raised & FE_OVERFLOW, FE_OVERFLOW);
        assert_int_equal(raised & FE_INVALID, 0);
    }
}

/* ------------------------------------------------------------------- threads -- */

typedef struct labour {
    const floats_setting *setting;
    atomic_size_t wrong;
} labour;

static froe_status work(void *user, unsigned worker, size_t job) {
    labour *l = user;
    (void)worker, (void)job;
    if (!own() || !is_lent(l->setting) || !own()) atomic_fetch_add(&l->wrong, 1);
    return FROE_OK;
}

static void workers_compute_as_froe_does_and_lend_the_callers(void **state) {
    (void)state;
    for (size_t s = 0; s < FLOATS_SETTINGS; s++) {
        labour l = {.setting = floats_settings + s};
        base_task task;
        base_task_init(&task, 4, NULL, NULL);
        floats_set(l.setting);
        {
            BASE_FLOATS_OWN;
            base_run(&task, 1, 200, work, &l);
        }
        const bool kept = floats_are(l.setting);
        floats_set(floats_settings);
        assert_true(kept);
        assert_int_equal(l.wrong, 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(own_and_the_callers_follow_each_other_however_nested),
        cmocka_unit_test(what_a_callback_sets_is_undone),
        cmocka_unit_test(the_public_pair_does_the_same),
        cmocka_unit_test(flags_of_the_caller_and_its_callbacks_stay),
        cmocka_unit_test(workers_compute_as_froe_does_and_lend_the_callers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
