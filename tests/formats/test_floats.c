/* test_floats.c: however the calling thread computes, questions to partitions in space have the same answers,
 * the thread computes so afterwards, and so do the callbacks. (conformance/test_floats.c says more.) */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "support/settings.h"
#include <froe/kinetic.h>

static bool note_layer(void *user, uint32_t object, const double corners[8]) {
    floats_called(user);
    floats_note(user, &object, sizeof object);
    floats_note(user, corners, 8 * sizeof *corners);
    return true;
}

static void ask_in_space(floats_run *r, void *user) {
    const froe_allocator memory = {floats_memory, r};
    const froe_kinetic_options o = froe_kinetic_defaults();
    static const size_t starts[] = {0, 1, 2, 3, 5, 6, 7};
    static const double times[] = {0, 0, 0, 0, 8, 0, 0};
    static const double coords[] = {0,   0,   0,   0.9, 0.1, 0.3, 0.2, 0.8, 0x1p-1070, 0.1, 0.1,
                                    1.7, 0.7, 0.3, 1.1, 0.8, 0.2, 1.3, 0.4, 0.9,       1.9};
    froe_motion_options w = froe_motion_defaults();
    froe_moving b = froe_moving_defaults();
    froe_motion *motion;
    froe_kinetic *kinetic;
    froe_kinetic_place place;
    (void)user;
    w.dim = 3, w.begin = 0, w.end = 8;
    b.vertex_count = 6, b.count = 2, b.starts = starts, b.times = times, b.coords = coords;
    MUST(r, froe_motion_new(&w, &memory, &motion, NULL));
    MUST(r, froe_motion_add(motion, &b, NULL));
    MUST(r, froe_kinetic_new(motion, &o, &memory, &kinetic, NULL));
    for (int i = 0; i < 4; i++) {
        const double at[3] = {0.1 + 0.3 * i, 0.7 - 0.2 * i, 0x1p-1074};
        MUST(r, froe_kinetic_locate_in_space(kinetic, at, &place, NULL));
        floats_note(r, &place, sizeof place);
    }
    MUST(r, froe_kinetic_layers(kinetic, note_layer, r, NULL));
    froe_kinetic_free(kinetic);
    froe_motion_free(motion);
}

static void columns_are_the_same(void **state) {
    (void)state;
    floats_compare(ask_in_space, NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(columns_are_the_same)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
