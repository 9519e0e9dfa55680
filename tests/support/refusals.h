/* refusals.h: calls that are to be refused, with a sentence. */
#ifndef FROE_TESTS_SUPPORT_REFUSALS_H
#define FROE_TESTS_SUPPORT_REFUSALS_H
#include <froe/froe.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

/** What the last call said. */
static froe_diagnostic why;

/** A status with a sentence that has these words. */
static void expect(froe_status found, froe_status wanted, const char *words) {
    assert_int_equal(found, wanted);
    if (!strstr(why.message, words)) fail_msg("'%s' lacks '%s'", why.message, words);
    why = (froe_diagnostic){0};
}
#define NULLS(call) expect(call, FROE_E_ARG, "is NULL")
#endif
