/* test_faults.c: a folder is whole whatever happens while another takes its place: kill -9 and a loss of power at any
 * call that changes files, calls that fail, a full disk; and no change of its manifest goes unnoticed. */
#include "faults/power.h"
#include "shards/folder.h"
#include "shards/folders.h"
#include "shards/shard.h"
#include "support/sanitized.h"
#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { OLD_OBJECTS = 400, NEW_OBJECTS = 1000, SOME_OBJECTS = 500, SHARDS = 5, SHARE = SANITIZED_SHARE(3) };

/* The linker leads the calls of cmake/FroeTests.cmake here: at call number `ends_at`, from 1, the process is killed,
 * loses its power, or the call fails. */
typedef enum end_kind { KILLED, POWER, POWER_BACK, FAILED } end_kind;
static unsigned calls, ends_at;
static end_kind how_ends;
static int failure;            /* errno of a call that fails */
static const char *names[512]; /* of the calls of the last run */

/* Shall this call fail? */
static bool meets_end(const char *name) {
    if (++calls < 512) names[calls] = name;
    if (calls != ends_at) return false;
    errno = failure;
    if (how_ends == FAILED) return true;
    if (how_ends != KILLED) power_lose(how_ends == POWER_BACK);
    raise(SIGKILL);
    return true;
}

/* Is power.h told of this call, in a process that loses its power? */
static bool is_told(void) {
    return ends_at && (how_ends == POWER || how_ends == POWER_BACK);
}

/* `before` and `after` it power.h is told; `failed` is what it returns when it fails. */
#define COUNTED(type, name, parameters, arguments, failed, before, after)                                              \
    type __real_##name parameters;                                                                                     \
    type __wrap_##name parameters;                                                                                     \
    type __wrap_##name parameters {                                                                                    \
        if (meets_end(#name)) return failed;                                                                           \
        if (is_told()) before;                                                                                         \
        type result = __real_##name arguments;                                                                         \
        if (is_told() && result != (failed)) after;                                                                    \
        return result;                                                                                                 \
    }

#define NOTHING (void)0
COUNTED(int, mkdir, (const char *path, mode_t mode), (path, mode), -1, NOTHING, NOTHING)
COUNTED(FILE *, fopen, (const char *path, const char *mode), (path, mode), NULL, NOTHING,
        *mode == 'w' ? power_wrote(fileno(result)) : NOTHING)
COUNTED(int, fflush, (FILE * file), (file), EOF, NOTHING, NOTHING)
COUNTED(ssize_t, write, (int file, const void *bytes, size_t count), (file, bytes, count), -1, power_wrote(file),
        NOTHING)
COUNTED(size_t, fwrite, (const void *bytes, size_t size, size_t count, FILE *file), (bytes, size, count, file), 0,
        NOTHING, NOTHING)
COUNTED(ssize_t, pwrite, (int file, const void *bytes, size_t count, off_t place), (file, bytes, count, place), -1,
        NOTHING, NOTHING)
COUNTED(ssize_t, pread, (int file, void *bytes, size_t count, off_t place), (file, bytes, count, place), -1, NOTHING,
        NOTHING)
COUNTED(int, rename, (const char *from, const char *to), (from, to), -1, power_renames(to), power_renamed(from, to))
COUNTED(int, renameat2, (int in, const char *from, int out, const char *to, unsigned how), (in, from, out, to, how), -1,
        NOTHING, power_exchanged(from, to))
COUNTED(int, unlinkat, (int folder, const char *name, int how), (folder, name, how), -1, NOTHING, NOTHING)
COUNTED(int, rmdir, (const char *path), (path), -1, NOTHING, NOTHING)
COUNTED(DIR *, opendir, (const char *path), (path), NULL, NOTHING, NOTHING)
COUNTED(int, openat, (int folder, const char *name, int flags), (folder, name, flags), -1, NOTHING, NOTHING)
COUNTED(int, mkstemp, (char *path), (path), -1, NOTHING, NOTHING)
COUNTED(int, fstat, (int file, struct stat *about), (file, about), -1, NOTHING, NOTHING)
COUNTED(int, fclose, (FILE * file), (file), EOF, NOTHING, NOTHING)

/* What is on the disk is what power.h says, so the disk itself is not waited for. */
int __wrap_fsync(int file);
int __wrap_fsync(int file) {
    if (meets_end("fsync")) return -1;
    if (is_told()) power_synced(file);
    return 0;
}

static froe_status build(const char *path, size_t count, froe_diagnostic *why) {
    one_object *list = lattice_objects(2, FROE_SEGMENT, count, 50, count);
    froe_shards_options o = froe_shards_defaults();
    o.shards = SHARDS, o.threads = 1;
    const froe_status status = build_folder(path, 2, list, count, &o, NULL, why);
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
    for (unsigned at = 1;; at += SHARE) {
        assert_int_equal(build("killed.froes", OLD_OBJECTS, NULL), FROE_OK); /* which tidies up */
        assert_int_equal(access(".killed.froes.building", F_OK), -1);
        assert_int_equal(access(".killed.froes.building.old", F_OK), -1);
        const pid_t child = fork();
        assert_true(child >= 0);
        if (!child) {
            calls = 0, ends_at = at, how_ends = kind;
            _exit(build("killed.froes", NEW_OBJECTS, NULL) != FROE_OK);
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
    if (!(old > 10 / SHARE && new > 5 / SHARE)) fail_msg("%d left the old folder, %d the new one", old, new);
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

/* Is the failure of this call one that the program has an answer to? */
static bool is_answered(const char *name, int error) {
    if (error == ENOSYS || error == EINVAL) return !strcmp(name, "renameat2") || !strcmp(name, "fsync");
    if (error == EROFS || error == ENOTSUP) return !strcmp(name, "fsync");
    return error == EIO || !strcmp(name, "fsync") || !strcmp(name, "pwrite") || !strcmp(name, "pread");
}

/* A call that fails: the old folder, or the new one where the call does not matter. Without an exchange of names two
 * renames do the same. */
static void each_call_may_fail(void **state) {
    (void)state;
    static const int failures[] = {EIO, ENOSYS, EINTR, EINVAL, EROFS, ENOTSUP};
    int ended[2] = {0, 0};
    froe_diagnostic why;
    for (size_t i = 0; i < sizeof failures / sizeof *failures; i++) {
        assert_int_equal(build("failed.froes", OLD_OBJECTS, NULL), FROE_OK); /* where there is none yet */
        calls = 0;
        assert_int_equal(build("failed.froes", OLD_OBJECTS, NULL), FROE_OK);
        for (unsigned at = 1; at <= calls; at += SHARE) {
            if (!is_answered(names[at], failures[i])) continue;
            calls = 0, ends_at = at, how_ends = FAILED, failure = failures[i], why = (froe_diagnostic){0};
            const froe_status status = build("failed.froes", SOME_OBJECTS, &why);
            const char *last = names[at];
            ends_at = 0;
            const bool gone = access(".failed.froes.building", F_OK) && access(".failed.froes.building.old", F_OK);
            const bool kept = !strcmp(last, "unlinkat") || !strcmp(last, "rmdir") || !strcmp(last, "opendir");
            if (!gone && !kept) fail_msg("%s, call %u, fails: the draft is left", last, at);
            if (status && failures[i] != EIO && failures[i] != ENOSYS && failures[i] != EINTR)
                fail_msg("%s, call %u: a system that has nothing to wait for is no failure", last, at);
            if (status && status != FROE_E_IO) fail_msg("%s, call %u, fails: status %d", last, at, status);
            if (status && !*why.message) fail_msg("%s, call %u, fails: no sentence", last, at);
            assert_int_equal(objects_of("failed.froes"), status ? OLD_OBJECTS : SOME_OBJECTS);
            ended[!status]++;
            calls = 0;
            assert_int_equal(build("failed.froes", OLD_OBJECTS, NULL), FROE_OK);
        }
    }
    if (ended[0] < 30 / SHARE || ended[1] < 10 / SHARE) fail_msg("%d failed, %d did not", ended[0], ended[1]);
}

static void a_full_disk_leaves_the_old_folder_and_nothing_beside_it(void **state) {
    (void)state;
    int failed = 0, made = 0;
    assert_int_equal(build("full.froes", OLD_OBJECTS, NULL), FROE_OK);
    for (rlim_t most = 100; most < 1 << 21; most = most * 3 / 2) {
        const pid_t child = fork();
        int result;
        assert_true(child >= 0);
        if (!child) { /* files beyond the limit cannot be written, as on a full disk */
            signal(SIGXFSZ, SIG_IGN);
            setrlimit(RLIMIT_FSIZE, &(struct rlimit){most, most});
            _exit((int)build("full.froes", NEW_OBJECTS, NULL));
        }
        assert_int_equal(waitpid(child, &result, 0), child);
        assert_true(WIFEXITED(result));
        const int status = WEXITSTATUS(result);
        assert_true(status == FROE_OK || status == FROE_E_IO);
        assert_int_equal(objects_of("full.froes"), status ? OLD_OBJECTS : NEW_OBJECTS);
        assert_int_equal(access(".full.froes.building", F_OK), -1);
        failed += status != FROE_OK;
        made += status == FROE_OK;
        if (!status) assert_int_equal(build("full.froes", OLD_OBJECTS, NULL), FROE_OK);
    }
    assert_true(failed > 5 && made > 0);
}

static void every_changed_byte_of_a_manifest_is_noticed(void **state) {
    (void)state;
    const froe_allocator alloc = support_allocator(NULL);
    size_t count = 0, read = 0;
    assert_int_equal(build("changed.froes", OLD_OBJECTS, NULL), FROE_OK);
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

/* Lines that no program writes, with a right checksum. */
static void manifests_of_no_folder_are_refused(void **state) {
    (void)state;
    static const char *const bodies[] = {
        "dimension 9\nshard 1 1 2272 0123456789abcdef 0 0 0 0 0 0 0 0 0 1 1 1 1 1 1 1 1 1\n",
        "dimension 1\nshard 1 1 2272 0123456789abcdef 0 1\n",
        "dimension 2\nshard 0\n",
        "dimension 2\nshard 1 1 2272 0123456789abcdef 0 0 inf 1\n",
        "dimension 2\nshard 1 1 2272 0123456789abcdef 0 0 1e999 1\n",
        "dimension 2\nshard 1 1 2272 0123456789abcdef 0 0 nan 1\n",
        "dimension 2\ncut 2 5\nshard 1 1 2272 0123456789abcdef 0 0 1 1\nshard 1 1 2272 0123456789abcdef 6 0 7 1\n",
        "dimension 2\ncut 0 5\nshard 1 1 2272 0123456789abcdef 0 0 1 1\n",
        "dimension 2\nshard 1 1 2272 0123456789abcdef 0 0 1 1\nshard 1 1 2272 0123456789abcdef 6 0 7 1\n",
        "dimension 2\nshard 1 1 2272 0123456789abcdef 0 0 1 1\nshard 0\n",
    };
    const froe_allocator alloc = support_allocator(NULL);
    for (size_t i = 0; i <= sizeof bodies / sizeof *bodies; i++) {
        static char text[1 << 16];
        shards_manifest m;
        int used = snprintf(text, sizeof text, "froe shards 1\n");
        const size_t first = (size_t)used;
        if (i < sizeof bodies / sizeof *bodies) {
            used += snprintf(text + used, sizeof text - (size_t)used, "%s", bodies[i]);
        } else { /* deeper than any tree */
            used += snprintf(text + used, sizeof text - (size_t)used, "dimension 2\n");
            for (int k = 0; k < 2000; k++)
                used += snprintf(text + used, sizeof text - (size_t)used, "cut 0 %d\n", 4000 - k);
        }
        const uint64_t sums[] = {shards_manifest_sum(text, (size_t)used),
                                 shards_manifest_sum(text + first, (size_t)used - first)};
        for (int k = 0; k < 2; k++) {
            const int end =
                snprintf(text + used, sizeof text - (size_t)used, "end %016llx\n", (unsigned long long)sums[k]);
            assert_int_equal(shards_manifest_parse(text, (size_t)(used + end), "m", &alloc, &m, NULL), FROE_E_FORMAT);
        }
    }
}

/* A manifest that is no file or too large, and a shard that is damaged in a folder with a long name. */
static void what_is_no_manifest_is_named(void **state) {
    (void)state;
    froe_shards *shards;
    const froe_tree *tree;
    froe_diagnostic diag;
    const char *folder = "a folder whose name is so long that the sentence has only its end of it.froes";
    char path[200];
    assert_int_equal(system("rm -rf odd.froes && mkdir odd.froes"), 0); /* of an earlier run */
    assert_int_equal(mkdir("odd.froes/froe.shards", 0777), 0);
    assert_int_equal(froe_shards_open("odd.froes", NULL, &shards, &diag), FROE_E_IO);
    assert_non_null(strstr(diag.message, "odd.froes/froe.shards: "));
    assert_int_equal(rmdir("odd.froes/froe.shards"), 0);
    fclose(fopen("odd.froes/froe.shards", "w"));
    assert_int_equal(truncate("odd.froes/froe.shards", (1 << 24) + 1), 0);
    assert_int_equal(froe_shards_open("odd.froes", NULL, &shards, &diag), FROE_E_FORMAT);
    assert_string_equal(diag.message, "odd.froes/froe.shards: It is too large for a manifest.");
    assert_int_equal(build(folder, OLD_OBJECTS, &diag), FROE_OK);
    snprintf(path, sizeof path, "%s/shard-0000.froe", folder);
    assert_int_equal(truncate(path, 100), 0);
    assert_int_equal(froe_shards_open(folder, NULL, &shards, NULL), FROE_OK);
    assert_int_equal(froe_shards_tree(shards, 0, &tree, &diag), FROE_E_FORMAT);
    assert_non_null(strstr(diag.message, "shard-0000.froe"));
    froe_shards_close(shards);
}

/* The manifest of the folder calls a shard empty, with a right checksum; `gone`: its file is not there, either. */
static froe_status check_with_empty(uint32_t shard, bool gone) {
    char path[64];
    froe_shards *shards;
    assert_int_equal(build("forged.froes", OLD_OBJECTS, NULL), FROE_OK);
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

/* What the manifest of a folder of one shard says is changed, with a right checksum. */
static froe_status check_changed(void (*change)(froe_shard_entry *e), froe_diagnostic *diag) {
    froe_shards *shards;
    assert_int_equal(froe_shards_open("changed.froes", NULL, &shards, NULL), FROE_OK);
    froe_shard_entry entry = shards->manifest.entries.data[0];
    change(&entry);
    assert_int_equal(froe_shard_manifest_write(shards->manifest.plan, &entry, "changed.froes", NULL, NULL), FROE_OK);
    froe_shards_close(shards);
    assert_int_equal(froe_shards_open("changed.froes", NULL, &shards, NULL), FROE_OK);
    const froe_status status = froe_shards_check(shards, NULL, diag);
    froe_shards_close(shards);
    return status;
}

/* A shard of other objects, with their own bounds: of space, or whose tags are not in order. */
static void put_other_tree(froe_shard_entry *e, int dim, const uint64_t tags[2]) {
    static const double corners[12] = {0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3};
    const char *path = "changed.froes/shard-0000.froe";
    froe_scene *scene;
    froe_tree *tree;
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_SEGMENT, batch.count = 2, batch.coords = corners, batch.tags = tags;
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &batch, NULL), FROE_OK);
    assert_int_equal(froe_build(scene, NULL, &tree, NULL), FROE_OK);
    assert_int_equal(froe_tree_save(tree, path, NULL), FROE_OK);
    froe_scene_bounds(scene, e->lo, e->hi);
    e->objects = e->own = 2;
    assert_int_equal(shards_file_check(path, &e->bytes, &e->check, NULL), FROE_OK);
    froe_tree_free(tree), froe_scene_free(scene);
}

static void nothing_changes(froe_shard_entry *e) {
    (void)e;
}
static void one_object_more(froe_shard_entry *e) {
    e->objects++;
}
static void one_less_is_its_own(froe_shard_entry *e) {
    e->own--;
}
static void its_bounds_are_less(froe_shard_entry *e) {
    e->hi[0] = e->lo[0];
}
static void an_upper_bound_is_a_little_less(froe_shard_entry *e) {
    e->hi[1] = nextafter(e->hi[1], -INFINITY);
}
static void a_lower_bound_is_a_little_more(froe_shard_entry *e) {
    e->lo[0] = nextafter(e->lo[0], INFINITY);
}
static void a_lower_bound_is_less(froe_shard_entry *e) {
    e->lo[1] = -100;
}
static void in_order(froe_shard_entry *e) {
    put_other_tree(e, 2, (const uint64_t[]){3, 5});
}
static void out_of_order(froe_shard_entry *e) {
    put_other_tree(e, 2, (const uint64_t[]){5, 3});
}
static void in_space(froe_shard_entry *e) {
    put_other_tree(e, 3, (const uint64_t[]){3, 5});
}

static void what_a_manifest_says_is_compared_with_its_shards(void **state) {
    (void)state;
    static const char cell[] = "not those of its cell", other[] = "It is not the shard that the manifest names";
    static const struct {
        void (*change)(froe_shard_entry *e);
        const char *sentence; /* NULL: all is well */
    } cases[] = {{nothing_changes, NULL},
                 {in_order, NULL},
                 {one_object_more, other},
                 {one_less_is_its_own, cell},
                 {an_upper_bound_is_a_little_less, cell},
                 {a_lower_bound_is_a_little_more, cell},
                 {a_lower_bound_is_less, cell},
                 {its_bounds_are_less, cell},
                 {out_of_order, cell},
                 {in_space, other}};
    one_object *list = lattice_objects(2, FROE_SEGMENT, OLD_OBJECTS, 50, 1);
    froe_shards_options o = froe_shards_defaults();
    o.shards = 1, o.threads = 1;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_diagnostic diag = {0};
        assert_int_equal(build_folder("changed.froes", 2, list, OLD_OBJECTS, &o, NULL, NULL), FROE_OK);
        assert_int_equal(check_changed(cases[i].change, &diag), cases[i].sentence ? FROE_E_FORMAT : FROE_OK);
        if (cases[i].sentence && !strstr(diag.message, cases[i].sentence)) fail_msg("%zu: %s", i, diag.message);
    }
    free(list);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_a_manifest_says_is_compared_with_its_shards),
        cmocka_unit_test(a_killed_program_leaves_the_old_folder_or_the_new_one),
        cmocka_unit_test(so_does_a_loss_of_power),
        cmocka_unit_test(each_call_may_fail),
        cmocka_unit_test(a_full_disk_leaves_the_old_folder_and_nothing_beside_it),
        cmocka_unit_test(manifests_of_no_folder_are_refused),
        cmocka_unit_test(what_is_no_manifest_is_named),
        cmocka_unit_test(every_changed_byte_of_a_manifest_is_noticed),
        cmocka_unit_test(a_shard_that_the_manifest_calls_empty_is_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
