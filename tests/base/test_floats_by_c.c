/* test_floats_by_c.c: what floats.h does on processors it does not know, by fenv.h alone, does the same on this one. */
#include "support/settings.h"

/* The same file once more, under other names than those of the library that the test is linked with. */
#define BASE_FLOATS_BY_C
#define base_floats_change_to_own by_c_change_to_own
#define base_floats_begin_caller by_c_begin_caller
#define base_floats_undo by_c_undo
#define base_floats_of_caller by_c_of_caller
#define base_floats_begin_thread by_c_begin_thread
#define froe_floats_begin by_c_begin
#define froe_floats_end by_c_end
unsigned by_c_begin(bool own);
void by_c_end(unsigned began);
#include "../../src/base/floats.c"

#pragma GCC diagnostic ignored "-Wshadow"

static bool is_lent(const floats_setting *s) {
    BASE_FLOATS_CALLER;
    return floats_are(s);
}

static void the_default_environment_is_froes_own(void **state) {
    const floats_setting *own = floats_settings;
    (void)state;
    for (size_t s = 0; s < FLOATS_SETTINGS; s++) {
        const floats_setting *setting = floats_settings + s;
        bool good = true;
        floats_set(setting);
        {
            BASE_FLOATS_OWN;
            good &= floats_are(own) && is_lent(setting) && floats_are(own);
            {
                BASE_FLOATS_OWN;
                good &= floats_are(own) && is_lent(setting) && floats_are(own);
            }
            good &= floats_are(own) && is_lent(setting);
            {
                BASE_FLOATS_CALLER;
                good &= floats_are(setting);
                {
                    BASE_FLOATS_OWN;
                    good &= floats_are(own) && is_lent(setting) && floats_are(own);
                }
                good &= floats_are(setting);
            }
            good &= floats_are(own);
        }
        good &= floats_are(setting) && is_lent(setting) && floats_are(setting);
        floats_set(own);
        if (!good) fail_msg("%s", setting->name);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_default_environment_is_froes_own)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
