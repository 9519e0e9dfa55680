/* test_faults.c: a folder is whole whatever happens while another takes its place: kill -9 and a loss of power at any
 * call that changes files, a full disk; and no change of its manifest goes unnoticed. */
#include "faults/power.h"
#include "shards/folder.h"
#include "shards/folders.h"
#include <signal.h>
#include <stdio.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { OLD_OBJECTS = 400, NEW_OBJECTS = 3000, SHARDS = 5 };

/* The linker leads the calls of cmake/FroeTests.cmake here: call number `killed_at`, from 1, is a kill -9 instead. */
static unsigned calls, killed_at;
typedef enum end_kind { KILLED, POWER, POWER_BACK } end_kind;
static end_kind how_ends;

static void count_call(void) {
    if (++calls != killed_at) return;
    if (how_ends != KILLED) power_lose(how_ends == POWER_BACK);
    raise(SIGKILL);
}

/* The same for calls of which power.h is told: after(), in a process that loses its power. */
static bool is_told(void) {
    return killed_at && how_ends != KILLED;
}

#define COUNTED(type, name, parameters, arguments)                                                                     \
    type __real_##name parameters;                                                                                     \
    type __wrap_##name parameters;                                                                                     \
    type __wrap_##name parameters {                                                                                    \
        count_call();                                                                                                  \
        return __real_##name arguments;                                                                                \
    }

COUNTED(int, mkdir, (const char *path, mode_t mode), (path, mode))
COUNTED(int, fflush, (FILE * file), (file))
COUNTED(size_t, fwrite, (const void *bytes, size_t size, size_t count, FILE *file), (bytes, size, count, file))
COUNTED(ssize_t, pwrite, (int file, const void *bytes, size_t count, off_t place), (file, bytes, count, place))
COUNTED(int, unlinkat, (int folder, const char *name, int how), (folder, name, how))
COUNTED(int, rmdir, (const char *path), (path))

FILE *__real_fopen(const char *path, const char *mode);
FILE *__wrap_fopen(const char *path, const char *mode);
FILE *__wrap_fopen(const char *path, const char *mode) {
    count_call();
    FILE *file = __real_fopen(path, mode);
    if (file && *mode == 'w' && is_told()) power_wrote(fileno(file));
    return file;
}

ssize_t __real_write(int file, const void *bytes, size_t count);
ssize_t __wrap_write(int file, const void *bytes, size_t count);
ssize_t __wrap_write(int file, const void *bytes, size_t count) {
    count_call();
    if (is_told()) power_wrote(file);
    return __real_write(file, bytes, count);
}

int __real_fsync(int file);
int __wrap_fsync(int file);
int __wrap_fsync(int file) {
    count_call();
    const int result = __real_fsync(file);
    if (!result && is_told()) power_synced(file);
    return result;
}

int __real_rename(const char *from, const char *to);
int __wrap_rename(const char *from, const char *to);
int __wrap_rename(const char *from, const char *to) {
    count_call();
    if (is_told()) power_renames(to);
    const int result = __real_rename(from, to);
    if (!result && is_told()) power_renamed(from, to);
    return result;
}

int __real_renameat2(int in, const char *from, int out, const char *to, unsigned how);
int __wrap_renameat2(int in, const char *from, int out, const char *to, unsigned how);
int __wrap_renameat2(int in, const char *from, int out, const char *to, unsigned how) {
    count_call();
    const int result = __real_renameat2(in, from, out, to, how);
    if (!result && is_told()) power_exchanged(from, to);
    return result;
}

static froe_status build(const char *path, size_t count) {
    one_object *list = lattice_objects(2, FROE_SEGMENT, count, 50, count);
    froe_shards_options o = froe_shards_defaults();
    o.shards = SHARDS, o.threads = 1;
    const froe_status status = build_folder(path, 2, list, count, &o, NULL, NULL);
    free(list);
    return status;
}

/* How many objects a folder has that is whole. */
static uint64_t objects_of(const char *path) {
    froe_shards *shards;
    assert_int_equal(froe_shards_open(path, NULL, &shards, NULL), FROE_OK);
    assert_int_equal(froe_shards_check(shards, NULL, NULL), FROE_OK);
    const uint64_t objects = froe_shards_about(shards).objects;
    froe_shards_close(shards);
    return objects;
}

/* The program ends at each call. */
static void end_everywhere(end_kind kind) {
    int old = 0, new = 0, ended;
    for (unsigned at = 1;; at++) {
        assert_int_equal(build("killed.froes", OLD_OBJECTS), FROE_OK); /* which tidies up */
        assert_int_equal(access(".killed.froes.building", F_OK), -1);
        assert_int_equal(access(".killed.froes.building.old", F_OK), -1);
        const pid_t child = fork();
        assert_true(child >= 0);
        if (!child) {
            calls = 0, killed_at = at, how_ends = kind;
            _exit(build("killed.froes", NEW_OBJECTS) != FROE_OK);
        }
        assert_int_equal(waitpid(child, &ended, 0), child);
        const uint64_t objects = objects_of("killed.froes");
        assert_true(objects == OLD_OBJECTS || objects == NEW_OBJECTS);
        if (!WIFSIGNALED(ended)) break;
        assert_int_equal(WTERMSIG(ended), SIGKILL);
        old += objects == OLD_OBJECTS;
        new += objects == NEW_OBJECTS;
    }
    assert_true(WIFEXITED(ended) && !WEXITSTATUS(ended));
    assert_int_equal(objects_of("killed.froes"), NEW_OBJECTS);
    if (!(old > 10 && new > 5)) fail_msg("%d left the old folder, %d the new one", old, new);
}

static void a_killed_program_leaves_the_old_folder_or_the_new_one(void **state) {
    (void)state;
    end_everywhere(KILLED);
}

static void so_does_a_loss_of_power(void **state) {
    (void)state;
    end_everywhere(POWER);
    end_everywhere(POWER_BACK);
}

static void a_full_disk_leaves_the_old_folder_and_nothing_beside_it(void **state) {
    (void)state;
    int failed = 0, made = 0;
    assert_int_equal(build("full.froes", OLD_OBJECTS), FROE_OK);
    for (rlim_t most = 100; most < 1 << 21; most = most * 3 / 2) {
        const pid_t child = fork();
        int result;
        assert_true(child >= 0);
        if (!child) { /* files beyond the limit cannot be written, as on a full disk */
            signal(SIGXFSZ, SIG_IGN);
            setrlimit(RLIMIT_FSIZE, &(struct rlimit){most, most});
            _exit((int)build("full.froes", NEW_OBJECTS));
        }
        assert_int_equal(waitpid(child, &result, 0), child);
        assert_true(WIFEXITED(result));
        const int status = WEXITSTATUS(result);
        assert_true(status == FROE_OK || status == FROE_E_IO);
        assert_int_equal(objects_of("full.froes"), status ? OLD_OBJECTS : NEW_OBJECTS);
        assert_int_equal(access(".full.froes.building", F_OK), -1);
        failed += status != FROE_OK;
        made += status == FROE_OK;
        if (!status) assert_int_equal(build("full.froes", OLD_OBJECTS), FROE_OK);
    }
    assert_true(failed > 5 && made > 0);
}

static void every_changed_byte_of_a_manifest_is_noticed(void **state) {
    (void)state;
    const froe_allocator alloc = support_allocator(NULL);
    size_t count = 0, read = 0;
    assert_int_equal(build("changed.froes", OLD_OBJECTS), FROE_OK);
    char *text = read_whole("changed.froes/froe.shards", &count);
    assert_non_null(text);
    for (size_t i = 0; i < count; i++)
        for (int bit = 0; bit < 8; bit++) {
            shards_manifest m;
            text[i] = (char)(text[i] ^ 1 << bit);
            assert_int_equal(shards_manifest_parse(text, count, "m", &alloc, &m, NULL), FROE_E_FORMAT);
            text[i] = (char)(text[i] ^ 1 << bit);
        }
    for (size_t cut = 0; cut < count; cut++) {
        shards_manifest m;
        assert_int_equal(shards_manifest_parse(text, cut, "m", &alloc, &m, NULL), FROE_E_FORMAT);
    }
    const size_t lines = count - strlen("end 0123456789abcdef\n");
    for (size_t i = 0; i < lines; i++) /* with a right checksum: refused, or another right text */
        for (int bit = 0; bit < 7; bit++) {
            shards_manifest m;
            char sum[24];
            text[i] = (char)(text[i] ^ 1 << bit);
            snprintf(sum, sizeof sum, "end %016llx\n", (unsigned long long)shards_manifest_sum(text, lines));
            memcpy(text + lines, sum, strlen(sum));
            if (shards_manifest_parse(text, count, "m", &alloc, &m, NULL) == FROE_OK) {
                read++;
                shards_manifest_free(&m);
            }
            text[i] = (char)(text[i] ^ 1 << bit);
        }
    assert_true(read > 10 && read < lines * 3);
    free(text);
}

/* The manifest of the folder calls a shard empty, with a right checksum; `gone`: its file is not there, either. */
static froe_status check_with_empty(uint32_t shard, bool gone) {
    char path[64];
    froe_shards *shards;
    assert_int_equal(build("forged.froes", OLD_OBJECTS), FROE_OK);
    assert_int_equal(froe_shards_open("forged.froes", NULL, &shards, NULL), FROE_OK);
    shards->manifest.entries.data[shard] = (froe_shard_entry){0};
    assert_int_equal(
        froe_shard_manifest_write(shards->manifest.plan, shards->manifest.entries.data, "forged.froes", NULL, NULL),
        FROE_OK);
    froe_shards_close(shards);
    snprintf(path, sizeof path, "forged.froes/shard-%04u.froe", shard);
    if (gone) assert_int_equal(unlink(path), 0);
    froe_diagnostic diag = {0};
    assert_int_equal(froe_shards_open("forged.froes", NULL, &shards, NULL), FROE_OK);
    const froe_status status = froe_shards_check(shards, NULL, &diag);
    assert_non_null(strstr(diag.message, path));
    froe_shards_close(shards);
    return status;
}

static void a_shard_that_the_manifest_calls_empty_is_found(void **state) {
    (void)state;
    for (uint32_t shard = 0; shard < SHARDS; shard++) assert_int_equal(check_with_empty(shard, false), FROE_E_FORMAT);
    for (uint32_t shard = 1; shard < SHARDS; shard++) /* others have objects of theirs in its cell */
        assert_int_equal(check_with_empty(shard, true), FROE_E_FORMAT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_killed_program_leaves_the_old_folder_or_the_new_one),
        cmocka_unit_test(so_does_a_loss_of_power),
        cmocka_unit_test(a_full_disk_leaves_the_old_folder_and_nothing_beside_it),
        cmocka_unit_test(every_changed_byte_of_a_manifest_is_noticed),
        cmocka_unit_test(a_shard_that_the_manifest_calls_empty_is_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
