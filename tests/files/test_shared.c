/* test_shared.c: a file that several processes write: whole or not at all, by one program at a time, whatever a killed
 * one left. */
#include "support/memory.h"
#include "support/writer.h"
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* The linker leads flock() here: with an error, as where the file system has no locks. */
static int lock_error;
int __real_flock(int file, int how);
int __wrap_flock(int file, int how);
int __wrap_flock(int file, int how) {
    if (!lock_error) return __real_flock(file, how);
    errno = lock_error;
    return -1;
}

static void spill(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void assert_text(const char *path, const char *text) {
    char found[64] = "";
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    found[fread(found, 1, sizeof found - 1, file)] = '\0';
    fclose(file);
    assert_string_equal(found, text);
}

/* Another process writes a text at its place; it asserts nothing, because it is not the one that runs the tests. */
static void write_elsewhere(const char *draft, const char *text, off_t place) {
    const pid_t other = fork();
    int result;
    assert_true(other >= 0);
    if (!other) {
        const int file = open(draft, O_WRONLY);
        _exit(file < 0 || pwrite(file, text, strlen(text), place) != (ssize_t)strlen(text) || close(file));
    }
    assert_int_equal(waitpid(other, &result, 0), other);
    assert_true(WIFEXITED(result) && !WEXITSTATUS(result));
}

static void processes_write_one_file_at_their_places(void **state) {
    (void)state;
    support_writer w;
    struct stat info;
    spill("places.txt", "old");
    assert_int_equal(chmod("places.txt", 0640), 0);
    assert_int_equal(support_writer_open_shared(&w, "places.txt", NULL, NULL), FROE_OK);
    assert_string_equal(support_writer_draft(&w), ".places.txt.writing");
    write_elsewhere(support_writer_draft(&w), "second", 6);
    write_elsewhere(support_writer_draft(&w), "first ", 0);
    assert_text("places.txt", "old");
    assert_int_equal(support_writer_close(&w, FROE_OK), FROE_OK);
    assert_text("places.txt", "first second");
    assert_int_equal(stat("places.txt", &info), 0);
    assert_int_equal(info.st_mode & 0777, 0640);
    assert_int_equal(access(".places.txt.writing", F_OK), -1);
}

static void a_failure_leaves_the_old_file_and_nothing_beside_it(void **state) {
    (void)state;
    support_writer w;
    spill("failed.txt", "old");
    assert_int_equal(support_writer_open_shared(&w, "failed.txt", NULL, NULL), FROE_OK);
    write_elsewhere(support_writer_draft(&w), "new", 0);
    assert_int_equal(support_writer_close(&w, FROE_E_INPUT), FROE_E_INPUT);
    assert_text("failed.txt", "old");
    assert_int_equal(access(".failed.txt.writing", F_OK), -1);
}

static void one_program_writes_at_a_time(void **state) {
    (void)state;
    support_writer w, other;
    froe_diagnostic diag;
    assert_int_equal(support_writer_open_shared(&w, "contested.txt", NULL, NULL), FROE_OK);
    write_elsewhere(support_writer_draft(&w), "mine", 0);
    assert_int_equal(support_writer_open_shared(&other, "contested.txt", NULL, &diag), FROE_E_IO);
    assert_string_equal(diag.message, "contested.txt: Another program is writing this file.");
    assert_int_equal(support_writer_close(&w, FROE_OK), FROE_OK);
    assert_text("contested.txt", "mine");
    assert_int_equal(support_writer_open_shared(&w, "contested.txt", NULL, NULL), FROE_OK);
    assert_int_equal(support_writer_close(&w, FROE_E_INPUT), FROE_E_INPUT);
}

static void what_a_killed_program_left_is_used_again(void **state) {
    (void)state;
    support_writer w;
    spill(".left.txt.writing", "a long text of a program that was killed");
    assert_int_equal(support_writer_open_shared(&w, "left.txt", NULL, NULL), FROE_OK);
    write_elsewhere(support_writer_draft(&w), "new", 0);
    assert_int_equal(support_writer_close(&w, FROE_OK), FROE_OK);
    assert_text("left.txt", "new");
    assert_int_equal(access(".left.txt.writing", F_OK), -1);
}

static void links_in_the_place_of_the_draft_are_not_followed(void **state) {
    (void)state;
    support_writer w;
    froe_diagnostic diag;
    spill("victim.txt", "keep");
    (void)unlink(".linked.txt.writing");
    assert_int_equal(symlink("victim.txt", ".linked.txt.writing"), 0);
    assert_int_equal(support_writer_open_shared(&w, "linked.txt", NULL, &diag), FROE_E_IO);
    assert_text("victim.txt", "keep");
    assert_int_equal(access("linked.txt", F_OK), -1);
}

/* A second name of another file, a pipe without a reader, a pipe with one. */
static void what_is_no_file_of_its_own_is_no_draft(void **state) {
    (void)state;
    support_writer w;
    froe_diagnostic diag;
    spill("shared.txt", "keep");
    (void)unlink(".named.txt.writing");
    assert_int_equal(link("shared.txt", ".named.txt.writing"), 0);
    assert_int_equal(support_writer_open_shared(&w, "named.txt", NULL, &diag), FROE_E_IO);
    assert_string_equal(diag.message,
                        "named.txt: Its draft beside it, whose name ends in .writing, is no file of yours. "
                        "Remove it.");
    assert_text("shared.txt", "keep");
    (void)unlink(".piped.txt.writing");
    assert_int_equal(mkfifo(".piped.txt.writing", 0600), 0);
    assert_int_equal(support_writer_open_shared(&w, "piped.txt", NULL, NULL), FROE_E_IO);
    const int reader = open(".piped.txt.writing", O_RDONLY | O_NONBLOCK);
    assert_true(reader >= 0);
    assert_int_equal(support_writer_open_shared(&w, "piped.txt", NULL, NULL), FROE_E_IO);
    close(reader);
    assert_int_equal(access("piped.txt", F_OK), -1);
}

static void what_is_no_file_has_no_draft(void **state) {
    (void)state;
    support_writer w;
    assert_int_equal(support_writer_open_shared(&w, "/dev/null", NULL, NULL), FROE_OK);
    assert_null(support_writer_draft(&w));
    assert_true(support_writer_put(&w, "text", 4));
    assert_int_equal(support_writer_close(&w, FROE_OK), FROE_OK);
}

/* One process writes it alone, under a name of its own; a file that another one left stays, since it may be in use. */
static void without_locks_there_is_no_draft(void **state) {
    (void)state;
    static const int errors[] = {ENOSYS, ENOLCK, EOPNOTSUPP};
    for (size_t i = 0; i < 2 * sizeof errors / sizeof *errors; i++) {
        const bool left = i % 2;
        support_writer w, other;
        spill("lockless.txt", "old");
        (void)unlink(".lockless.txt.writing");
        if (left) spill(".lockless.txt.writing", "in use");
        lock_error = errors[i / 2];
        assert_int_equal(support_writer_open_shared(&w, "lockless.txt", NULL, NULL), FROE_OK);
        assert_null(support_writer_draft(&w));
        assert_int_equal(access(".lockless.txt.writing", F_OK), left ? 0 : -1);
        assert_true(support_writer_put(&w, "new", 3));
        assert_text("lockless.txt", "old");
        assert_int_equal(support_writer_open_shared(&other, "lockless.txt", NULL, NULL), FROE_OK);
        assert_int_equal(support_writer_close(&other, FROE_E_INPUT), FROE_E_INPUT);
        assert_int_equal(support_writer_close(&w, FROE_OK), FROE_OK);
        lock_error = 0;
        assert_text("lockless.txt", "new");
        if (left) assert_text(".lockless.txt.writing", "in use");
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(processes_write_one_file_at_their_places),
        cmocka_unit_test(a_failure_leaves_the_old_file_and_nothing_beside_it),
        cmocka_unit_test(one_program_writes_at_a_time),
        cmocka_unit_test(what_a_killed_program_left_is_used_again),
        cmocka_unit_test(links_in_the_place_of_the_draft_are_not_followed),
        cmocka_unit_test(what_is_no_file_of_its_own_is_no_draft),
        cmocka_unit_test(what_is_no_file_has_no_draft),
        cmocka_unit_test(without_locks_there_is_no_draft),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
