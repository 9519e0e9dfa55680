/* test_drafts.c: several programs build the same folder. Each gets its own draft or is refused, no file of a draft goes
 * away before its end, and what comes to the place of the folder meanwhile is replaced only if it is one of shards. */
#define _DEFAULT_SOURCE 1 /* flock */
#include "shards/folders.h"
#include <errno.h>
#include <fcntl.h>
#include <froe/shard_parts.h>
#include <sys/file.h>
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

enum { PROGRAMS = 4, DRAFTS = 10, FILES = 20 };

static bool put_file(const char *folder, int number) {
    char path[4096 + 64];
    snprintf(path, sizeof path, "%s/shard-%04d.froe", folder, number);
    FILE *file = fopen(path, "wx");
    return file && fprintf(file, "%d", (int)getpid()) > 0 && !fclose(file);
}

static void a_folder_that_another_program_built_meanwhile_is_replaced(void **state) {
    (void)state;
    froe_shard_draft *draft;
    assert_int_equal(system("rm -rf later.froes"), 0); /* of an earlier run */
    assert_int_equal(froe_shard_draft_begin("later.froes", NULL, &draft, NULL), FROE_OK);
    assert_true(put_file(froe_shard_draft_folder(draft), 1));
    assert_int_equal(mkdir("later.froes", 0777), 0);
    assert_true(put_file("later.froes", 0));
    assert_int_equal(froe_shard_draft_end(draft, FROE_OK, NULL), FROE_OK);
    assert_int_equal(access("later.froes/shard-0000.froe", F_OK), -1);
    assert_int_equal(access("later.froes/shard-0001.froe", F_OK), 0);
    assert_int_equal(access(".later.froes.building", F_OK), -1);
}

static void a_stranger_that_came_meanwhile_stays(void **state) {
    (void)state;
    froe_shard_draft *draft;
    froe_diagnostic diag;
    assert_int_equal(system("rm -rf strange.froes"), 0);
    assert_int_equal(froe_shard_draft_begin("strange.froes", NULL, &draft, NULL), FROE_OK);
    assert_true(put_file(froe_shard_draft_folder(draft), 1));
    assert_int_equal(mkdir("strange.froes", 0777), 0);
    assert_int_equal(system("echo notes > strange.froes/notes.txt"), 0);
    assert_int_equal(froe_shard_draft_end(draft, FROE_OK, &diag), FROE_E_IO);
    assert_non_null(strstr(diag.message, "The folder is not replaced, because it holds 'notes.txt'."));
    assert_int_equal(access("strange.froes/notes.txt", F_OK), 0);
    assert_int_equal(access(".strange.froes.building", F_OK), -1);
}

/* Whoever holds a lock on the old folder, which a builder does for a moment only, is not waited for without end. */
static void a_lock_that_is_kept_on_the_old_folder_is_told(void **state) {
    (void)state;
    froe_shard_draft *draft;
    froe_diagnostic diag;
    char who[64];
    snprintf(who, sizeof who, "Another program (process %d) holds a lock on the folder", (int)getpid());
    assert_int_equal(system("rm -rf kept.froes && mkdir kept.froes"), 0);
    assert_true(put_file("kept.froes", 0));
    assert_int_equal(froe_shard_draft_begin("kept.froes", NULL, &draft, NULL), FROE_OK);
    const int old = open("kept.froes", O_RDONLY | O_DIRECTORY);
    assert_int_equal(flock(old, LOCK_EX), 0);
    assert_int_equal(froe_shard_draft_end(draft, FROE_OK, &diag), FROE_E_IO);
    if (!access("/proc/locks", R_OK)) assert_non_null(strstr(diag.message, who));
    close(old);
    assert_int_equal(access("kept.froes/shard-0000.froe", F_OK), 0);
    assert_int_equal(access(".kept.froes.building", F_OK), -1);
}

/* Several processes remove the folder that was there, each a part; another builder waits until all is done. */
static void a_folder_that_was_replaced_is_removed_in_parts(void **state) {
    (void)state;
    froe_shard_draft *draft, *other;
    froe_diagnostic diag;
    bool replaced = false;
    char path[4096 + 64];
    assert_int_equal(system("rm -rf parted.froes && mkdir parted.froes"), 0);
    assert_int_equal(froe_shard_draft_begin("parted.froes", NULL, &draft, NULL), FROE_OK);
    assert_true(put_file(froe_shard_draft_folder(draft), 1));
    for (int i = 0; i < FILES; i++) assert_true(put_file("parted.froes", i));
    assert_int_equal(froe_shard_draft_place(draft, &replaced, NULL), FROE_OK);
    assert_true(replaced);
    assert_int_equal(access("parted.froes/shard-0001.froe", F_OK), 0);
    for (uint32_t part = 0; part < 3; part++) {
        for (int i = 0; i < FILES; i++) {
            snprintf(path, sizeof path, "%s/shard-%04d.froe", froe_shard_draft_folder(draft), i);
            assert_int_equal(access(path, F_OK), (uint32_t)i % 3 < part ? -1 : 0);
        }
        froe_shard_draft_clear(froe_shard_draft_folder(draft), part, 3);
    }
    assert_int_equal(froe_shard_draft_begin("parted.froes", NULL, &other, &diag), FROE_E_IO);
    assert_non_null(strstr(diag.message, "Another program is building this folder."));
    assert_int_equal(froe_shard_draft_end(draft, FROE_OK, NULL), FROE_OK);
    assert_int_equal(access(".parted.froes.building", F_OK), -1);
    assert_int_equal(access("parted.froes/shard-0001.froe", F_OK), 0);
    assert_int_equal(access("parted.froes/shard-0000.froe", F_OK), -1);
}

/* Where the file system has no locks, who makes a draft has it; one that is there may be in use. */
static void without_locks_a_draft_belongs_to_who_made_it(void **state) {
    (void)state;
    froe_shard_draft *draft, *other;
    froe_diagnostic diag;
    assert_int_equal(system("rm -rf lockless.froes .lockless.froes.building && mkdir lockless.froes"), 0);
    assert_true(put_file("lockless.froes", 0));
    lock_error = ENOSYS;
    assert_int_equal(froe_shard_draft_begin("lockless.froes", NULL, &draft, NULL), FROE_OK);
    assert_true(put_file(froe_shard_draft_folder(draft), 1));
    assert_int_equal(froe_shard_draft_begin("lockless.froes", NULL, &other, &diag), FROE_E_IO);
    assert_string_equal(diag.message,
                        "lockless.froes: Its draft beside it, whose name ends in .building, may be in use, as the "
                        "file system has no locks. Remove it if no program builds the folder.");
    assert_int_equal(froe_shard_draft_end(draft, FROE_OK, NULL), FROE_OK);
    assert_int_equal(access("lockless.froes/shard-0000.froe", F_OK), -1);
    assert_int_equal(access("lockless.froes/shard-0001.froe", F_OK), 0);
    assert_int_equal(access(".lockless.froes.building", F_OK), -1);
    assert_int_equal(froe_shard_draft_begin("lockless.froes", NULL, &draft, NULL), FROE_OK);
    assert_int_equal(froe_shard_draft_end(draft, FROE_E_CANCELLED, NULL), FROE_E_CANCELLED);
    assert_int_equal(access("lockless.froes/shard-0001.froe", F_OK), 0);
    assert_int_equal(access(".lockless.froes.building", F_OK), -1);
    lock_error = 0;
}

/* What is where the draft is to be is no folder; a draft in the topmost folder; one that others have taken away. */
static void drafts_that_cannot_be_are_told(void **state) {
    (void)state;
    froe_shard_draft *draft;
    froe_diagnostic diag;
    fclose(fopen(".blocked.froes.building", "w"));
    assert_int_equal(froe_shard_draft_begin("blocked.froes", NULL, &draft, &diag), FROE_E_IO);
    assert_non_null(strstr(diag.message, "blocked.froes: "));
    assert_int_equal(access(".blocked.froes.building", F_OK), 0);
    const froe_status status = froe_shard_draft_begin("/froe-test-of-drafts.froes", NULL, &draft, &diag);
    if (status) {
        assert_int_equal(status, FROE_E_IO); /* the folder is of root alone */
    } else {
        assert_string_equal(froe_shard_draft_folder(draft), "/.froe-test-of-drafts.froes.building");
        assert_int_equal(froe_shard_draft_end(draft, FROE_E_CANCELLED, NULL), FROE_E_CANCELLED);
        assert_int_equal(access("/.froe-test-of-drafts.froes.building", F_OK), -1);
    }
    for (int again = 0; again < 2; again++) {
        assert_int_equal(froe_shard_draft_begin("gone.froes", NULL, &draft, NULL), FROE_OK);
        assert_true(put_file(froe_shard_draft_folder(draft), 1));
        assert_int_equal(system("rm -rf .gone.froes.building"), 0);
        if (again) assert_int_equal(system("mkdir .gone.froes.building"), 0);
        const froe_status ended = froe_shard_draft_end(draft, again ? FROE_E_CANCELLED : FROE_OK, &diag);
        assert_int_equal(ended, again ? FROE_E_CANCELLED : FROE_E_IO);
        assert_int_equal(access("gone.froes", F_OK), -1);
    }
    assert_int_equal(system("rm -rf .gone.froes.building .blocked.froes.building"), 0);
}

/* Files of a draft, which are there as long as it is. */
static bool fill(const char *folder) {
    bool whole = true;
    for (int i = 0; i < FILES && whole; i++) whole = put_file(folder, i);
    for (int i = 0; i < FILES && whole; i++) {
        char path[4096 + 64];
        snprintf(path, sizeof path, "%s/shard-%04d.froe", folder, i);
        whole = !access(path, F_OK);
    }
    return whole;
}

/* What a program of several does; it asserts nothing, because it is not the one that runs the tests. */
static bool build_often(void) {
    for (int built = 0; built < DRAFTS;) {
        const froe_status wanted = built % 8 == 5 ? FROE_E_CANCELLED : FROE_OK;
        froe_shard_draft *draft;
        froe_diagnostic diag = {0};
        if (froe_shard_draft_begin("contested.froes", NULL, &draft, &diag)) {
            if (!strstr(diag.message, "Another program is building this folder.")) return false;
            continue;
        }
        if (!fill(froe_shard_draft_folder(draft))) return false;
        const froe_status ended = froe_shard_draft_end(draft, wanted, &diag);
        const bool waited = ended && strstr(diag.message, "holds a lock on the folder"); /* it had to wait too long */
        if (ended != wanted && !waited) return false;
        built += ended == wanted;
    }
    return true;
}

static void programs_at_the_same_time_do_not_touch_drafts_of_each_other(void **state) {
    (void)state;
    pid_t programs[PROGRAMS];
    for (int p = 0; p < PROGRAMS; p++) {
        programs[p] = fork();
        assert_true(programs[p] >= 0);
        if (!programs[p]) _exit(!build_often());
    }
    int failed = 0;
    for (int p = 0; p < PROGRAMS; p++) {
        int result;
        assert_int_equal(waitpid(programs[p], &result, 0), programs[p]);
        failed += !WIFEXITED(result) || WEXITSTATUS(result);
    }
    assert_int_equal(failed, 0);
    assert_int_equal(access(".contested.froes.building", F_OK), -1);
    char *owner = NULL;
    for (int i = 0; i < FILES; i++) { /* of the same program */
        char path[64];
        size_t count;
        snprintf(path, sizeof path, "contested.froes/shard-%04d.froe", i);
        char *text = read_whole(path, &count);
        assert_non_null(text);
        if (owner) assert_string_equal(text, owner);
        free(owner);
        owner = text;
    }
    free(owner);
}

/* Tries to replace a folder that may be read and not written: it stays, and nothing is beside it. Returns what is
 * wrong; 1: this user cannot get here. */
static int replace_shut_folder(void) {
    froe_shard_draft *draft;
    froe_diagnostic diag = {0};
    if (mkdir("shut.froes", 0777) || !put_file("shut.froes", 0) || chmod("shut.froes", 0555)) return 1;
    const froe_status begun = froe_shard_draft_begin("shut.froes", NULL, &draft, &diag);
    if (!begun) froe_shard_draft_end(draft, FROE_E_CANCELLED, NULL);
    if (begun != FROE_E_IO) return 2;
    if (!strstr(diag.message, "shut.froes: The file cannot be written: Permission denied")) return 3;
    if (access("shut.froes/shard-0000.froe", F_OK) || !access(".shut.froes.building", F_OK)) return 4;
    /* One that is shut while the new one grows. */
    if (chmod("shut.froes", 0755) || froe_shard_draft_begin("shut.froes", NULL, &draft, NULL)) return 5;
    if (!put_file(froe_shard_draft_folder(draft), 1) || chmod("shut.froes", 0555)) return 6;
    if (froe_shard_draft_end(draft, FROE_OK, &diag) != FROE_E_IO) return 7;
    return access("shut.froes/shard-0000.froe", F_OK) || !access(".shut.froes.building", F_OK) ? 8 : 0;
}

static void a_folder_that_cannot_be_written_is_not_replaced(void **state) {
    (void)state;
    assert_int_equal(system("rm -rf shut.froes .shut.froes.building && chmod 777 ."), 0);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (!child) /* root may write everywhere */
        _exit(geteuid() == 0 && (setgid(12346) || setuid(12345)) ? 1 : replace_shut_folder());
    int ended;
    assert_int_equal(waitpid(child, &ended, 0), child);
    assert_int_equal(system("chmod -f 755 shut.froes; rm -rf shut.froes"), 0);
    assert_true(WIFEXITED(ended));
    if (WEXITSTATUS(ended) == 1) skip();
    assert_int_equal(WEXITSTATUS(ended), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_folder_that_another_program_built_meanwhile_is_replaced),
        cmocka_unit_test(a_stranger_that_came_meanwhile_stays),
        cmocka_unit_test(a_lock_that_is_kept_on_the_old_folder_is_told),
        cmocka_unit_test(a_folder_that_was_replaced_is_removed_in_parts),
        cmocka_unit_test(a_folder_that_cannot_be_written_is_not_replaced),
        cmocka_unit_test(drafts_that_cannot_be_are_told),
        cmocka_unit_test(without_locks_a_draft_belongs_to_who_made_it),
        cmocka_unit_test(programs_at_the_same_time_do_not_touch_drafts_of_each_other),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
