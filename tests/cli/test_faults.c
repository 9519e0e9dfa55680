/* test_faults.c: every command that writes, while the system calls that write fail, or the program is interrupted or
 * killed, or the power is lost: the old file is as it was or the new one whole, and a failure names the file and the
 * reason. (The writer itself meets more kinds of faults in files/writer.) */
#include "faults/faults.h"
#include <dirent.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h> /* needs setjmp.h and stdarg.h before it */

typedef struct writing {
    const char *arguments, *file;
    bool thorough; /* every kind of fault at every call; otherwise each at one */
    bool linked;   /* by the program that holds GDAL and Cairo, which starts slowly; others open none */
} writing;

static const writing writings[] = {
    {"build s.geojson -o out.froe", "out.froe", true, false},
    {"draw s.froe -o out.svg", "out.svg", false, true},
    {"draw s.froe -o out.png", "out.png", false, true},
    {"render h.froe -o out.eps", "out.eps", false, false},
    {"export s.froe -o out.geojson", "out.geojson", false, false},
    {"generate points -n 9 -o out.csv", "out.csv", false, false},
    {"compare s.geojson --methods kd --queries 1 --halvings 0 --no-times -o out.html", "out.html", false, true},
    {"compare s.geojson --methods kd --queries 1 --halvings 0 --no-times --csv out.csv", "out.csv", false, false},
    {"simulate m.mfjson --events out.csv", "out.csv", false, false},
    {"simulate m.mfjson --contacts out.csv", "out.csv", false, false},
    {"simulate m.mfjson --at 1 -o out.froe", "out.froe", false, false},
    {"simulate m.mfjson --animate out.svg", "out.svg", false, false},
    {"simulate m.mfjson --player out.html", "out.html", false, false},
    {"measure s.geojson --draw out.svg", "out.svg", false, true},
    {"demo -o .", "fzk-haus.glb", false, true},
};
static bool all; /* the argument "all": every fault at every call of every command */
enum { WRITINGS = sizeof writings / sizeof *writings, MOST_CALLS = 32 };
static const char old_text[] = "old";

/* Runs `froe ARGUMENTS` with a fault at a call; its wait status. What it says on stderr is in `said`, the calls it
 * made are in `calls`. */
static int run_froe(const char *arguments, bool linked, unsigned at, fault_kind kind) {
    char command[600];
    const char *program = getenv(linked ? "FROE_FAULTY" : "FROE_FAULTY_CORE");
    assert_non_null(program);
    snprintf(command, sizeof command, "FROE_FAULT='%u %d' FROE_FAULT_LOG=3 exec '%s' %s --quiet 2>said 3>calls", at,
             kind, program, arguments);
    return system(command);
}

static char *slurp(const char *path, size_t *size) {
    FILE *file = fopen(path, "rb");
    char *bytes = calloc(1, 1 << 21);
    assert_non_null(bytes);
    *size = file ? fread(bytes, 1, (1 << 21) - 1, file) : 0;
    if (file) fclose(file);
    return bytes;
}

/* Files whose names begin like those of temporary ones, which are removed. */
static int sweep(void) {
    int found = 0;
    DIR *folder = opendir(".");
    for (struct dirent *entry; (entry = readdir(folder));) {
        if (strncmp(entry->d_name, ".froe-", 6) != 0) continue;
        found++;
        unlink(entry->d_name);
    }
    closedir(folder);
    return found;
}

static void begin(const writing *w) {
    FILE *file = fopen(w->file, "w");
    assert_non_null(file);
    fputs(old_text, file);
    fclose(file);
}

static bool is(const char *path, const char *bytes, size_t size) {
    size_t count;
    char *found = slurp(path, &count);
    bool same = count == size && !memcmp(found, bytes, size);
    free(found);
    return same;
}

static void check(const writing *w, unsigned at, const char *call, fault_kind kind, int ended, bool as_before,
                  bool whole) {
    size_t size;
    char what[400], *said = slurp("said", &size);
    int left = sweep(), code = WIFEXITED(ended) ? WEXITSTATUS(ended) : -1;
    bool folder = strstr(call, "folder") != NULL;
    snprintf(what, sizeof what, "froe %.200s: fault %d at call %u, %.40s: exit code %d", w->arguments, kind, at, call,
             code);
    if (!as_before && !whole) fail_msg("%s: the file is neither the old one nor the new one", what);
    if (kind == FAULT_KILL || kind >= FAULT_POWER) {
        if (code != -1 || left > 1) fail_msg("%s: %d temporary files", what, left);
    } else if (left)
        fail_msg("%s: a temporary file is left", what);
    else if (kind == FAULT_EIO && (folder ? code != 0 || !whole : code != 4 || !as_before))
        fail_msg("%s", what);
    else if (kind == FAULT_EIO && !folder && (!strstr(said, w->file) || !strstr(said, "Input/output error")))
        fail_msg("%s: it says %s", what, said);
    else if (kind >= FAULT_INTERRUPT && code != (kind == FAULT_INTERRUPT ? 130 : 143))
        fail_msg("%s", what);
    free(said);
}

/* The names of the calls that an undisturbed run makes, up to the first one of this name: for its first file. */
static unsigned read_calls(char names[MOST_CALLS][32], const char *last) {
    FILE *file = fopen("calls", "r");
    unsigned count = 0;
    assert_non_null(file);
    while (count < MOST_CALLS && fgets(names[count], 32, file)) {
        names[count][strcspn(names[count], "\n")] = '\0';
        if (!strcmp(names[count++], last)) break;
    }
    fclose(file);
    return count;
}

static void try_faults(const writing *w) {
    static const fault_kind kinds[] = {FAULT_EIO,       FAULT_KILL,  FAULT_INTERRUPT,
                                       FAULT_TERMINATE, FAULT_POWER, FAULT_POWER_BACK};
    char names[MOST_CALLS][32];
    size_t size;
    begin(w);
    assert_int_equal(run_froe(w->arguments, w->linked, strncmp(w->arguments, "demo", 4) ? 0 : 11, FAULT_KILL) & 0x7f00,
                     0);
    char *new = slurp(w->file, &size);
    unsigned calls = read_calls(names, "close folder");
    sweep();
    if (calls < 8 || !size || is(w->file, old_text, strlen(old_text)))
        fail_msg("froe %s: %u calls", w->arguments, calls);
    for (unsigned at = 1; at <= calls; at++)
        for (unsigned i = 0; i < sizeof kinds / sizeof *kinds; i++) {
            if (!all && !w->thorough && at != 1 + (3 * i + (unsigned)(w - writings)) % calls) continue;
            begin(w);
            int ended = run_froe(w->arguments, w->linked, at, kinds[i]);
            check(w, at, names[at - 1], kinds[i], ended, is(w->file, old_text, strlen(old_text)),
                  is(w->file, new, size));
        }
    free(new);
    unlink(w->file);
}

static void every_command_that_writes_loses_nothing(void **state) {
    (void)state;
    static const char *const scenes[] = {
        "generate segments -n 60 --seed 1 -o s.geojson",
        "build s.geojson -o s.froe",
        "generate cuboids -n 60 -o h.off",
        "build h.off -o h.froe",
        "generate moving-polygons -n 12 -o m.mfjson",
    };
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++)
        assert_int_equal(run_froe(scenes[i], false, 0, FAULT_NONE), 0);
    for (size_t i = 0; i < WRITINGS; i++) try_faults(writings + i);
}

/* What goes to a device is a file of its own first, and then copied in several blocks. */
static void a_device_gets_all_or_the_reason_is_told(void **state) {
    (void)state;
    static const char begins[] = "froe: /dev/null: ", told[] = "The file cannot be written: Input/output error.\n",
                      line[] = "generate points -n 2000 -o /dev/null --output-format csv";
    char names[MOST_CALLS][32];
    unsigned copied = 0;
    size_t size;
    assert_int_equal(run_froe(line, false, 0, FAULT_NONE), 0);
    const unsigned calls = read_calls(names, "");
    for (unsigned at = 1; at <= calls; at++) {
        const bool writes = !strcmp(names[at - 1], "write"), folder = strstr(names[at - 1], "folder") != NULL;
        int ended = run_froe(line, false, at, FAULT_EIO);
        char *said = slurp("said", &size);
        if (folder ? ended
                   : WEXITSTATUS(ended) != 4 || strncmp(said, begins, strlen(begins)) != 0 || !strstr(said, told))
            fail_msg("froe %s: call %u, %s: %#x: %s", line, at, names[at - 1], (unsigned)ended, said);
        free(said);
        copied += writes;
        if (writes) assert_int_equal(run_froe(line, false, at, FAULT_EINTR), 0);
        if (writes) assert_int_equal(run_froe(line, false, at, FAULT_SHORT), 0);
    }
    assert_true(copied > 2);
}

/* Each of the first calls that ask for memory; all that follow belong to the commands that it runs. */
static void a_demo_that_cannot_begin_says_why(void **state) {
    (void)state;
    char plan[8];
    size_t size;
    for (int i = 1; i <= 4; i++) {
        snprintf(plan, sizeof plan, "%d %d", i, FAULT_EIO);
        setenv("FROE_FAULT_MEMORY", plan, 1);
        const int ended = run_froe("demo -o made", false, 0, FAULT_NONE);
        char *said = slurp("said", &size);
        if (!WIFEXITED(ended) || WEXITSTATUS(ended) != 4 || !strstr(said, "Out of memory."))
            fail_msg("froe demo: memory %s: %#x: %s", plan, (unsigned)ended, said);
        free(said);
    }
    unsetenv("FROE_FAULT_MEMORY");
}

/* Files of the libraries' names that are none are found first. What needs no library does without, and a comparison has
 * no pictures. */
static void a_library_that_cannot_be_opened_is_named(void **state) {
    (void)state;
    static const struct {
        const char *arguments, *library; /* NULL: none is needed */
        int code;
    } lines[] = {
        {"draw s.froe -o out.svg", "libfroe-draw", 4},
        {"draw s.froe -o out.svg --limit-memory 4000", "libfroe-draw", 4},
        {"measure s.geojson --draw out.svg", "libfroe-draw", 4},
        {"render h.froe -o out.png", "libfroe-draw", 4},
        {"render w.mfjson --frames 2 -o out-%d.png", "libfroe-draw", 4},
        {"compare s.geojson --methods kd --queries 1 --halvings 0 -o out.html", "libfroe-draw", 0},
        {"render h.froe -o out.dxf", "libfroe-io", 4},
        {"export s.froe -o out.gpkg", "libfroe-io", 4},
        {"info map.gpkg", "libfroe-io", 4},
        {"simulate model.fbx", "libfroe-io", 4},
        {"render h.froe -o out.svg", NULL, 0},
        {"export s.froe -o out.geojson", NULL, 0},
    };
    size_t size;
    if (system("mkdir -p none; for l in io draw; do touch none/libfroe-$l.so none/libfroe-$l.so.0; done; rm -f out.*"))
        fail_msg("none: it cannot be made");
    assert_int_equal(run_froe("generate moving-boxes -n 2 -o w.mfjson", false, 0, FAULT_NONE), 0);
    if (system("echo none | tee map.gpkg >model.fbx")) fail_msg("map.gpkg: it cannot be made");
    setenv("LD_LIBRARY_PATH", "none", 1);
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        const int ended = run_froe(lines[i].arguments, false, 0, FAULT_NONE);
        char *said = slurp("said", &size);
        if (!WIFEXITED(ended) || WEXITSTATUS(ended) != lines[i].code ||
            (lines[i].library ? !strstr(said, lines[i].library) : *said))
            fail_msg("froe %s: %#x: %s", lines[i].arguments, (unsigned)ended, said);
        free(said);
    }
    unsetenv("LD_LIBRARY_PATH");
}

int main(int argc, char **argv) {
    all = argc > 1 && !strcmp(argv[1], "all");
    signal(SIGINT, SIG_DFL); /* shells make what they start in the background ignore it */
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_command_that_writes_loses_nothing),
        cmocka_unit_test(a_device_gets_all_or_the_reason_is_told),
        cmocka_unit_test(a_demo_that_cannot_begin_says_why),
        cmocka_unit_test(a_library_that_cannot_be_opened_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
