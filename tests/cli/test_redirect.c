/* test_redirect.c: what is printed goes to a file and then where it went before, or a sentence says why not; standard
 * output is what it was in any case. */
#define _XOPEN_SOURCE 700
#include "demo/redirect.h"
#include "exit.h"
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h> /* needs setjmp.h and stdarg.h before it */

static struct stat standard_output(void) {
    struct stat about;
    fflush(stdout);
    assert_int_equal(fstat(STDOUT_FILENO, &about), 0);
    return about;
}

/* Prints a word to the file, and comes back: both exit codes. */
static void print_to(const char *path, int *there, int *back) {
    int kept;
    const struct stat before = standard_output();
    *there = demo_redirect(path, &kept);
    if (!*there) printf("word\n");
    *back = demo_restore(path, kept);
    const struct stat after = standard_output();
    assert_true(before.st_dev == after.st_dev && before.st_ino == after.st_ino);
}

static void a_file_gets_what_is_printed(void **state) {
    (void)state;
    char line[20];
    int there, back;
    print_to("printed", &there, &back);
    assert_true(!there && !back);
    FILE *file = fopen("printed", "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    assert_string_equal(line, "word\n");
    assert_null(fgets(line, sizeof line, file));
    fclose(file);
}

static void what_cannot_be_written_is_told(void **state) {
    (void)state;
    int there, back;
    print_to(".", &there, &back);
    assert_int_equal(there, CLI_RESOURCES);
    assert_int_equal(back, 0);
    print_to("/dev/full", &there, &back);
    assert_int_equal(there, 0);
    assert_int_equal(back, CLI_RESOURCES);
    clearerr(stdout);
}

/* There is one descriptor for the file, and none to keep the standard output, which stays. */
static void descriptors_may_run_out(void **state) {
    (void)state;
    struct rlimit limit;
    int there, back;
    assert_int_equal(getrlimit(RLIMIT_NOFILE, &limit), 0);
    const int next = dup(STDOUT_FILENO);
    close(next);
    const struct rlimit one = {(rlim_t)next + 1, limit.rlim_max};
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &one), 0);
    print_to("printed", &there, &back);
    assert_int_equal(setrlimit(RLIMIT_NOFILE, &limit), 0);
    assert_int_equal(there, CLI_RESOURCES);
    assert_int_equal(back, CLI_RESOURCES);
    assert_int_equal(demo_restore("printed", next), CLI_RESOURCES); /* a descriptor that is closed */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_gets_what_is_printed),
        cmocka_unit_test(what_cannot_be_written_is_told),
        cmocka_unit_test(descriptors_may_run_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
