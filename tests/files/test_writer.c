/* test_writer.c: the writer of files against failing system calls, kill -9, links, modes, pipes, names and memory. */
#define _DEFAULT_SOURCE 1 /* fchown of files to other users, mkdtemp */
#include "faults/faults.h"
#include "support/memory.h"
#include "support/writer.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { SIZE = 150000 }; /* more than two buffers */
static const char old_text[] = "old";

static unsigned char *content(void) {
    static unsigned char bytes[SIZE];
    if (!bytes[SIZE - 1]) /* not yet filled */
        for (size_t i = 0; i < SIZE; i++) bytes[i] = (unsigned char)(i % 251);
    return bytes;
}

/* As writers do it: small pieces, and one that is larger than the buffer. */
static froe_status write_content(const char *path, froe_diagnostic *why) {
    support_writer w;
    froe_status status = support_writer_open(&w, path, NULL, why);
    if (status) return status;
    size_t at = 0;
    for (; at < 70000; at += 700) support_writer_put(&w, content() + at, 700);
    support_writer_put(&w, content() + at, SIZE - at);
    return support_writer_close(&w, FROE_OK);
}

static void spill(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

typedef enum found { ABSENT, OLD, NEW, OTHER } found;

static found look(const char *path) {
    static unsigned char bytes[SIZE + 1];
    FILE *file = fopen(path, "rb");
    if (!file) return ABSENT;
    size_t count = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    if (count == SIZE && !memcmp(bytes, content(), SIZE)) return NEW;
    return count == strlen(old_text) && !memcmp(bytes, old_text, count) ? OLD : OTHER;
}

/* Files and links below the current folder and its folder "behind"; of these, temporary ones. */
static int count_files(int *temporary) {
    static const char *const folders[] = {".", "behind"};
    int files = 0;
    *temporary = 0;
    for (int i = 0; i < 2; i++) {
        DIR *folder = opendir(folders[i]);
        struct dirent *entry;
        while (folder && (entry = readdir(folder))) {
            if (!strcmp(entry->d_name, ".") || !strcmp(entry->d_name, "..") || !strcmp(entry->d_name, "behind"))
                continue;
            files++;
            *temporary += !strncmp(entry->d_name, ".froe-", 6);
        }
        if (folder) closedir(folder);
    }
    return files;
}

/* -------------------------------------------------------------- situations -- */

typedef struct situation {
    const char *name, *target;
    bool exists;
    int links;
} situation;

static const situation situations[] = {
    {"a new file", "out", false, 0},
    {"an old file", "out", true, 0},
    {"a link to an old file", "behind/real", true, 1},
    {"a dangling link", "behind/real", false, 1},
    {"a link to a link", "behind/real", true, 2},
};

static void clear(void) {
    char name[300];
    DIR *folder = opendir("behind");
    struct dirent *entry;
    while (folder && (entry = readdir(folder))) {
        snprintf(name, sizeof name, "behind/%s", entry->d_name);
        unlink(name);
    }
    if (folder) closedir(folder);
    folder = opendir(".");
    while ((entry = readdir(folder))) unlink(entry->d_name);
    closedir(folder);
    rmdir("behind");
}

static void set_up(const situation *s) {
    faults = (fault_plan){.log = -1};
    clear();
    mkdir("behind", 0777);
    if (s->exists) spill(s->target, old_text), chmod(s->target, 0604);
    if (s->links == 1) assert_int_equal(symlink("behind/real", "out"), 0);
    if (s->links == 2) assert_int_equal(symlink("behind/next", "out") | symlink("real", "behind/next"), 0);
    faults = (fault_plan){.log = -1};
}

/* All that must hold however writing to "out" ended. */
static void check(const situation *s, bool written, bool removed, const char *what) {
    int temporary, files = count_files(&temporary);
    found now = look("out"), before = s->exists ? OLD : ABSENT;
    if (now != (written ? NEW : before)) fail_msg("%s, %s: the file is wrong: %d", s->name, what, now);
    if (removed && temporary) fail_msg("%s, %s: a temporary file is left", s->name, what);
    if (temporary > 1 || files - temporary != s->links + (written || s->exists))
        fail_msg("%s, %s: %d files", s->name, what, files);
    struct stat info;
    if (s->links && (lstat("out", &info) || !S_ISLNK(info.st_mode))) fail_msg("%s, %s: no link", s->name, what);
    if (s->exists && (stat("out", &info) || (info.st_mode & 07777) != 0604))
        fail_msg("%s, %s: mode %o", s->name, what, info.st_mode & 07777);
}

/* Does the end of the call leave no doubt, where only this call fails? */
static bool is_harmless(const char *call, fault_kind kind) {
    if (kind == FAULT_SHORT || strstr(call, "folder")) return true;
    return kind == FAULT_EINTR && strcmp(call, "rename") != 0 && strcmp(call, "readlink") != 0;
}

static unsigned calls_of(const situation *s) {
    set_up(s);
    assert_int_equal(write_content("out", NULL), FROE_OK);
    check(s, true, true, "nothing fails");
    return faults.calls;
}

/* ------------------------------------------------------------------- tests -- */

static void each_system_call_may_fail(void **state) {
    (void)state;
    static const char *const reasons[] = {[FAULT_EIO] = "Input/output error",
                                          [FAULT_ENOSPC] = "No space left",
                                          [FAULT_EINTR] = "Interrupted",
                                          [FAULT_SHORT] = "",
                                          [FAULT_FOREVER] = "Input/output error"};
    unsigned tried = 0;
    for (size_t i = 0; i < sizeof situations / sizeof *situations; i++) {
        const situation *s = situations + i;
        unsigned calls = calls_of(s);
        for (unsigned at = 1; at <= calls; at++)
            for (fault_kind kind = FAULT_EIO; kind <= FAULT_FOREVER; kind++, tried++) {
                char what[80];
                froe_diagnostic why = {0};
                set_up(s);
                faults.at = at, faults.kind = kind;
                froe_status status = write_content("out", &why);
                faults.at = 0;
                const char *call = faults.names[at - 1];
                snprintf(what, sizeof what, "call %u, %s, kind %d", at, call, kind);
                if (!status != is_harmless(call, kind)) fail_msg("%s, %s: status %d", s->name, what, status);
                if (status && (status != FROE_E_IO || !strstr(why.message, "out: The file cannot be written: ") ||
                               !strstr(why.message, reasons[kind])))
                    fail_msg("%s, %s: %s", s->name, what, why.message);
                check(s, !status, kind != FAULT_FOREVER, what);
            }
    }
    assert_true(tried > 200);
    clear();
}

/* The program ends at each call of each situation. */
static void end_everywhere(fault_kind kind) {
    for (size_t i = 0; i < sizeof situations / sizeof *situations; i++) {
        const situation *s = situations + i;
        unsigned calls = calls_of(s);
        for (unsigned at = 1; at <= calls; at++) {
            set_up(s);
            pid_t child = fork();
            if (!child) {
                faults.at = at, faults.kind = kind;
                write_content("out", NULL);
                _exit(0);
            }
            int ended;
            assert_int_equal(waitpid(child, &ended, 0), child);
            assert_true(WIFSIGNALED(ended) && WTERMSIG(ended) == SIGKILL);
            char what[40];
            snprintf(what, sizeof what, "kind %d at call %u", kind, at);
            check(s, look("out") == NEW, false, what);
        }
        assert_int_equal(look("out"), NEW); /* the last call is behind all that matters */
    }
    clear();
}

static void a_killed_program_leaves_at_most_the_temporary_file(void **state) {
    (void)state;
    end_everywhere(FAULT_KILL);
}

static void so_does_a_loss_of_power(void **state) {
    (void)state;
    end_everywhere(FAULT_POWER);
    end_everywhere(FAULT_POWER_BACK);
}

static void the_bytes_and_the_name_reach_the_disk_in_order(void **state) {
    (void)state;
    static const char *const order[] = {"readlink", "open",  "fchmod", "write",       "write",        "write",
                                        "fsync",    "close", "rename", "open folder", "fsync folder", "close folder"};
    set_up(situations + 1);
    mode_t mask = umask(077);
    froe_status status = write_content("out", NULL);
    umask(mask);
    assert_int_equal(status, FROE_OK);
    assert_int_equal(faults.calls, sizeof order / sizeof *order);
    for (unsigned i = 0; i < faults.calls; i++) assert_string_equal(faults.names[i], order[i]);
    clear();
}

static void a_name_that_is_taken_is_neither_followed_nor_lost(void **state) {
    (void)state;
    static const char planted[] = ".froe-0000000000000000.tmp";
    froe_diagnostic why;
    set_up(situations);
    spill("victim", old_text);
    assert_int_equal(symlink("victim", planted), 0);
    faults.zeros = 3;
    assert_int_equal(write_content("out", NULL), FROE_OK);
    assert_int_equal(look("out"), NEW);
    faults.zeros = 1000;
    assert_int_equal(write_content("out", &why), FROE_E_IO);
    assert_non_null(strstr(why.message, "File exists"));
    faults.zeros = 0;
    assert_int_equal(look("victim"), OLD);
    assert_int_equal(look(planted), OLD);
    clear();
}

static void loops_folders_and_absent_places_are_refused(void **state) {
    (void)state;
    static char far[PATH_MAX + 10];
    memset(far, 'a', sizeof far - 1);
    froe_diagnostic why;
    set_up(situations);
    assert_int_equal(symlink("loop", "loop") | symlink("no/where", "dangling"), 0);
    static char target[PATH_MAX]; /* a link whose name has room alone, and not behind that of its folder */
    for (size_t i = 0; i + 2 < sizeof target; i += 2) memcpy(target + i, "./", 2);
    assert_int_equal(symlink(target, "behind/long"), 0);
    const char *const paths[] = {"loop", "dangling", "no/out", "behind",           ".",
                                 "",     "out/",     far,      "behind/../behind", "behind/long"};
    int files, temporary;
    files = count_files(&temporary);
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        assert_int_equal(write_content(paths[i], &why), FROE_E_IO);
        assert_int_equal(why.status, FROE_E_IO);
        assert_int_equal(count_files(&temporary), files);
    }
    clear();
}

/* Neither words, nor more digits than descriptors have, nor digits before something else. */
static void names_in_the_folder_of_descriptors_may_be_none(void **state) {
    (void)state;
    static const char *const names[] = {"/dev/fd/", "/dev/fd/one", "/dev/fd/1234567890", "/proc/self/fd/1x"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        froe_diagnostic why = {0};
        assert_int_equal(write_content(names[i], &why), FROE_E_IO);
        assert_int_equal(strncmp(why.message, names[i], strlen(names[i])), 0);
        assert_null(strstr(why.message, "descriptor"));
    }
}

static void a_caller_that_failed_leaves_the_old_file(void **state) {
    (void)state;
    support_writer w;
    set_up(situations + 1);
    assert_int_equal(support_writer_open(&w, "out", NULL, NULL), FROE_OK);
    support_writer_put(&w, content(), SIZE);
    assert_int_equal(support_writer_close(&w, FROE_E_CANCELLED), FROE_E_CANCELLED);
    check(situations + 1, false, true, "cancelled");
    clear();
}

static unsigned mode_of(const char *path) {
    struct stat info;
    assert_int_equal(stat(path, &info), 0);
    return info.st_mode & 07777;
}

static void modes_and_owners_are_kept(void **state) {
    (void)state;
    struct stat info;
    set_up(situations);
    mode_t mask = umask(026);
    assert_int_equal(write_content("out", NULL), FROE_OK);
    assert_int_equal(mode_of("out"), 0640);
    assert_int_equal(chmod("out", 04777), 0);
    assert_int_equal(write_content("out", NULL), FROE_OK);
    assert_int_equal(mode_of("out"), 0777);
    if (geteuid() == 0) {
        assert_int_equal(chmod("out", 0460) | chown("out", 12345, 54321), 0);
        assert_int_equal(write_content("out", NULL), FROE_OK);
        assert_int_equal(stat("out", &info), 0);
        assert_int_equal(info.st_uid, 12345);
        assert_int_equal(info.st_gid, 54321);
        assert_int_equal(mode_of("out"), 0460);
    }
    umask(mask);
    clear();
}

/* What had the file opened to its group is not opened to another: tried as a user that belongs to no other. */
static void a_group_that_cannot_be_kept_gets_no_more_than_all(void **state) {
    (void)state;
    if (geteuid() != 0) skip();
    set_up(situations + 1);
    assert_int_equal(chmod("out", 0664) | chown("out", 12345, 54321) | chmod(".", 0777), 0);
    pid_t child = fork();
    if (!child) _exit(setgid(12346) || setuid(12345) || write_content("out", NULL) ? 1 : 0);
    int ended;
    struct stat info;
    assert_int_equal(waitpid(child, &ended, 0), child);
    if (WIFEXITED(ended) && WEXITSTATUS(ended) == 1) skip(); /* this user cannot get here */
    assert_int_equal(stat("out", &info), 0);
    assert_int_equal(info.st_gid, 12346);
    assert_int_equal(info.st_mode & 07777, 0644);
    clear();
}

/* -------------------------------------------------- what is no regular file -- */

/* Writes to the descriptor `file` by the name `path` what a child reads to the end, at first byte by byte. */
static void assert_arrives(int ends[2], const char *path) {
    pid_t child = fork();
    if (!child) {
        static unsigned char bytes[SIZE + 1];
        size_t count = 0;
        close(ends[1]);
        for (ssize_t got; (got = read(ends[0], bytes + count, count > SIZE / 2 ? sizeof bytes - count : 1)) > 0;)
            count += (size_t)got;
        _exit(count != SIZE || memcmp(bytes, content(), SIZE) != 0);
    }
    close(ends[0]);
    assert_int_equal(write_content(path, NULL), FROE_OK);
    close(ends[1]);
    int ended;
    assert_int_equal(waitpid(child, &ended, 0), child);
    assert_true(WIFEXITED(ended) && WEXITSTATUS(ended) == 0);
}

static void descriptors_are_written_as_they_are(void **state) {
    (void)state;
    int ends[2];
    char name[40];
    set_up(situations);
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(fcntl(ends[1], F_SETFL, O_NONBLOCK), 0); /* a pipe that says "later" */
    snprintf(name, sizeof name, "/dev/fd/%d", ends[1]);
    assert_arrives(ends, name);
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
    snprintf(name, sizeof name, "/proc/self/fd/%d", ends[1]);
    assert_int_equal(symlink(name, "out"), 0);
    assert_arrives(ends, "out");
    int temporary;
    assert_int_equal(count_files(&temporary), 1);
    froe_diagnostic why;
    assert_int_equal(write_content("/dev/fd/987654", &why), FROE_E_IO);
    assert_non_null(strstr(why.message, "Bad file descriptor"));
    clear();
}

static void a_descriptor_of_a_file_is_appended_to(void **state) {
    (void)state;
    char name[40];
    set_up(situations);
    int file = open("out", O_WRONLY | O_CREAT, 0666);
    assert_int_equal(write(file, "old", 3), 3);
    snprintf(name, sizeof name, "/dev/fd/%d", file);
    assert_int_equal(write_content(name, NULL), FROE_OK);
    assert_int_equal(write(file, "old", 3), 3);
    close(file);
    struct stat info;
    assert_int_equal(stat("out", &info), 0);
    assert_int_equal(info.st_size, SIZE + 6);
    clear();
}

static void devices_stay_devices(void **state) {
    (void)state;
    struct stat info;
    froe_diagnostic why;
    set_up(situations);
    assert_int_equal(write_content("/dev/null", NULL), FROE_OK);
    assert_int_equal(symlink("/dev/full", "out"), 0);
    assert_int_equal(write_content("out", &why), FROE_E_IO);
    assert_non_null(strstr(why.message, "No space left"));
    assert_true(!stat("/dev/full", &info) && S_ISCHR(info.st_mode));
    assert_true(!stat("/dev/null", &info) && S_ISCHR(info.st_mode));
    clear();
}

static froe_status with_memory(void *user, const froe_allocator *alloc) {
    (void)user;
    froe_diagnostic why = {0};
    froe_status status = support_write("out", content(), SIZE, alloc, &why);
    assert_int_equal(status, why.status);
    return status;
}

static void memory_may_run_out(void **state) {
    (void)state;
    set_up(situations + 1);
    assert_int_equal(test_memory_each(with_memory, NULL), 1);
    check(situations + 1, true, true, "memory");
    clear();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_system_call_may_fail),
        cmocka_unit_test(a_killed_program_leaves_at_most_the_temporary_file),
        cmocka_unit_test(so_does_a_loss_of_power),
        cmocka_unit_test(the_bytes_and_the_name_reach_the_disk_in_order),
        cmocka_unit_test(a_name_that_is_taken_is_neither_followed_nor_lost),
        cmocka_unit_test(loops_folders_and_absent_places_are_refused),
        cmocka_unit_test(names_in_the_folder_of_descriptors_may_be_none),
        cmocka_unit_test(a_caller_that_failed_leaves_the_old_file),
        cmocka_unit_test(modes_and_owners_are_kept),
        cmocka_unit_test(a_group_that_cannot_be_kept_gets_no_more_than_all),
        cmocka_unit_test(descriptors_are_written_as_they_are),
        cmocka_unit_test(a_descriptor_of_a_file_is_appended_to),
        cmocka_unit_test(devices_stay_devices),
        cmocka_unit_test(memory_may_run_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
