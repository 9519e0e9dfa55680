/* test_allocations.c: every command, while memory runs out, or Ctrl-C or `kill` comes, anywhere: at each call that
 * gives memory, and at each that tells of progress. It says that memory has run out, with exit code 4, and what it was
 * to write is as before; or it found another way, and all is as without a fault. After a signal it says that it was
 * cancelled. Nothing else is left behind, nothing crashes.
 *
 * A sample of the calls, of another seed for each command; with the argument "all" (make faults) each of them, with
 * "all WORDS" only of the command lines that begin with these words. */
#include "faults/faults.h"
#include "support/sanitized.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
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

enum { MOST_WORDS = 40, MOST_TEXT = 1 << 21, MOST_TOLD = 20 };
static bool all;
static const char *only = ""; /* command lines that begin with this */

/* Calls that are tried of a kind, of most kinds half as many. */
enum { SAMPLE = SANITIZED ? 4 : 12 };

typedef enum case_kind {
    PLAIN,
    THOROUGH, /* PLAIN, at eight times as many calls: much JSON is put together */
    TIMED,    /* standard output has times, which differ */
    LINKED    /* by the program that holds GDAL and Cairo, which starts slowly; others open none */
} case_kind;

typedef struct run_case {
    const char *words; /* parted by blanks */
    const char *file;  /* that it writes; NULL: standard output alone */
    case_kind kind;
} run_case;

static const char *const scenes[] = {
    "generate segments -n 40 --seed 1 -o s.geojson",
    "build s.geojson -o s.froe",
    "build s.geojson --method grain -o g.froe",
    "generate cuboids -n 12 -o h.off",
    "build h.off -o h.froe",
    "generate boxes -n 40 -o b.csv",
    "generate moving-polygons -n 5 -o m.mfjson",
    "generate segments -n 2000 --seed 2 -o t.geojson",
};

static const run_case cases[] = {
    {"info s.geojson", NULL, PLAIN},
    {"info s.froe --json", NULL, PLAIN},
    {"info data/fzk-haus-boxes.csv --json", NULL, PLAIN},
    {"measure s.geojson --json", NULL, TIMED},
    {"measure h.off --draw out.svg --quiet", "out.svg", LINKED},
    {"compare s.geojson --methods kd,index --queries 1 --halvings 0 --no-times -o out.html --quiet", "out.html",
     LINKED},
    {"compare s.geojson --methods kd --queries 1 --halvings 0 --no-times --csv out.csv --quiet", "out.csv", THOROUGH},
    {"build s.geojson -o out.froe --json", "out.froe", TIMED},
    {"build t.geojson -o out.froe --threads 3 --quiet", "out.froe", PLAIN},
    {"build h.off -o - --quiet", NULL, PLAIN},
    {"build b.csv --leaf 4 -o out.froe --quiet", "out.froe", PLAIN},
    {"check s.froe --json", NULL, TIMED},
    {"methods --json", NULL, PLAIN},
    {"locate s.froe --queries q.csv --columns x,name,id", NULL, PLAIN},
    {"locate data/countries-110m.json --wrap --groups --queries q.csv", NULL, LINKED},
    {"range s.geojson --queries r.csv --json", NULL, TIMED},
    {"range h.froe --queries r3.csv --format jsonl", NULL, PLAIN},
    {"ray h.froe --queries y.csv", NULL, PLAIN},
    {"near s.froe --queries q.csv -k 3 --format geojson", NULL, PLAIN},
    {"near b.csv --queries q.csv --save-tree out.froe", "out.froe", PLAIN},
    {"pairs s.geojson", NULL, PLAIN},
    {"draw s.froe -o out.svg --quiet", "out.svg", LINKED},
    {"render h.froe -o out.pdf --quiet", "out.pdf", PLAIN},
    {"render h.off -o out.svg --preset technical --threads 2 --quiet", "out.svg", PLAIN},
    {"export s.froe -o out.geojson --quiet", "out.geojson", PLAIN},
    {"export h.froe -o out.obj --quiet", "out.obj", PLAIN},
    {"generate sphere -n 60 -o out.off --quiet", "out.off", PLAIN},
    {"generate moving -n 5 -o out.mfjson --quiet", "out.mfjson", PLAIN},
    {"simulate m.mfjson --contacts out.csv --json", "out.csv", TIMED},
    {"simulate m.mfjson --events out.csv --quiet", "out.csv", PLAIN},
    {"simulate m.mfjson --at 1 -o out.froe --quiet", "out.froe", PLAIN},
    {"simulate m.mfjson --animate out.svg --quiet", "out.svg", PLAIN},
    {"simulate m.mfjson --player out.html --quiet", "out.html", PLAIN},
};
enum { CASES = sizeof cases / sizeof *cases };

/* ----------------------------------------------------------------- running -- */

typedef struct text {
    size_t size;
    char *bytes; /* ended by a zero; to be freed */
} text;

static text slurp(const char *path) {
    text t = {0, calloc(1, MOST_TEXT)};
    FILE *file = fopen(path, "rb");
    assert_non_null(t.bytes);
    if (file) {
        t.size = fread(t.bytes, 1, MOST_TEXT - 1, file);
        fclose(file);
    }
    return t;
}

static void spill(const char *path, const char *what) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(what, file);
    fclose(file);
}

static bool same(text a, text b) {
    return a.size == b.size && !memcmp(a.bytes, b.bytes, a.size);
}

static void become(const char *path, int descriptor) {
    const int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (file < 0 || dup2(file, descriptor) < 0) _exit(99);
    if (file != descriptor) close(file);
}

/* Runs `froe WORDS`; its wait status. What it prints is in the files "said" and "out", and "counts" has how many calls
 * of each kind there were. */
static int run_froe(bool draws, const char *words, const char *variable, unsigned at, fault_kind kind) {
    char line[300], plan[40], *argv[MOST_WORDS] = {getenv(draws ? "FROE_FAULTY" : "FROE_FAULTY_CORE")};
    const pid_t child = fork();
    assert_true(child >= 0 && argv[0]);
    if (!child) {
        int count = 1;
        snprintf(line, sizeof line, "%s", words);
        for (char *word = strtok(line, " "); word && count < MOST_WORDS - 1; word = strtok(NULL, " "))
            argv[count++] = word;
        snprintf(plan, sizeof plan, "%u %d", at, kind);
        if (at) setenv(variable, plan, 1);
        setenv("FROE_FAULT_COUNTS", "3", 1);
        become("out", STDOUT_FILENO), become("said", STDERR_FILENO), become("counts", 3);
        execv(argv[0], argv);
        _exit(99);
    }
    int ended;
    assert_int_equal(waitpid(child, &ended, 0), child);
    return ended;
}

static int count_entries(const char *path, const char *beginning) {
    int found = 0;
    DIR *folder = opendir(path);
    for (struct dirent *entry; folder && (entry = readdir(folder));)
        found += !strncmp(entry->d_name, beginning, strlen(beginning));
    if (folder) closedir(folder);
    return found;
}

/* Removes temporary files, here and in the folder for them, all of whose names begin alike; were there any? */
static bool sweep(void) {
    const bool found = count_entries(".", ".froe-") + count_entries("tmp", "froe-");
    if (found && system("rm -rf .froe-* tmp/froe-*")) fail_msg("temporary files cannot be removed");
    return found;
}

/* ---------------------------------------------------------------- verdicts -- */

typedef struct faulted {
    const run_case *c;
    text old, file, out; /* before; undisturbed */
    unsigned wrong, tried;
} faulted;

/* How many calls of each kind the last run made. */
typedef struct call_counts {
    unsigned memory, steps;
    int json; /* blocks of JSON that were left at the end */
} call_counts;

static call_counts read_counts(void) {
    call_counts c = {0};
    FILE *file = fopen("counts", "r");
    if (file && fscanf(file, "memory %u steps %u json %d", &c.memory, &c.steps, &c.json) != 3) c = (call_counts){0};
    if (file) fclose(file);
    return c;
}

static void complain(faulted *f, const char *what, unsigned at, fault_kind kind, int ended, const char *why) {
    text said = slurp("said");
    if (f->wrong++ < MOST_TOLD)
        fprintf(stderr, "froe %s: %s %u, kind %d: %s; wait status %#x, it says: %s\n", f->c->words, what, at, kind, why,
                (unsigned)ended, said.bytes);
    free(said.bytes);
}

/* Sentences of this program, one a line. */
static bool is_told(text said) {
    const char *line = said.bytes;
    while (!strncmp(line, "froe: ", 6) && strchr(line, '\n')) line = strchr(line, '\n') + 1;
    return said.size && !*line;
}

/* After memory that was refused. The file may be written and the report refused. */
static const char *judge_memory(int ended, text said, bool as_before, bool file_whole, bool whole) {
    if (!WIFEXITED(ended)) return "it crashes";
    if (WEXITSTATUS(ended) == 0) return whole ? NULL : "its output is another one";
    if (WEXITSTATUS(ended) != 4) return "the exit code is wrong";
    if (!as_before && !file_whole) return "the old file is lost";
    if (!is_told(said)) return "it does not say why in lines of its own";
    return strstr(said.bytes, "ut of memory") || strstr(said.bytes, "Cannot allocate memory")
               ? NULL
               : "it does not say that memory ran out";
}

/* After a signal, which may come before it is listened to, or when all is done. */
static const char *judge_signal(int ended, text said, int number, bool as_before, bool file_whole) {
    if (WIFSIGNALED(ended)) return WTERMSIG(ended) == number && as_before ? NULL : "it crashes";
    if (WEXITSTATUS(ended) != 128 + number) return "the exit code is wrong";
    if (!as_before && !file_whole) return "the old file is lost";
    return is_told(said) && strstr(said.bytes, "ancelled") ? NULL : "it does not say that it was cancelled";
}

static void try_fault(faulted *f, const char *variable, unsigned at, fault_kind kind) {
    const char *const path = f->c->file;
    if (path) spill(path, "old");
    const int ended = run_froe(f->c->kind == LINKED, f->c->words, variable, at, kind),
              number = kind == FAULT_INTERRUPT ? SIGINT : SIGTERM;
    text file = path ? slurp(path) : (text){0}, out = slurp("out"), said = slurp("said");
    const bool as_before = !path || same(file, f->old), file_whole = !path || same(file, f->file);
    const bool whole = file_whole && (f->c->kind == TIMED || same(out, f->out));
    const call_counts calls = read_counts(); /* several threads may make fewer than the last time */
    const bool memory = !strcmp(variable, "FROE_FAULT_MEMORY"), met = at <= (memory ? calls.memory : calls.steps);
    const char *why = kind < FAULT_INTERRUPT || (!met && !WIFSIGNALED(ended))
                          ? judge_memory(ended, said, as_before, file_whole, whole)
                          : judge_signal(ended, said, number, as_before, file_whole);
    if (why) complain(f, variable, at, kind, ended, why);
    if (sweep()) complain(f, variable, at, kind, ended, "temporary files are left");
    if (WIFEXITED(ended) && calls.json) complain(f, variable, at, kind, ended, "JSON is left");
    f->tried++;
    free(file.bytes), free(out.bytes), free(said.bytes);
}

/* The faults of one kind at `calls` calls, or at so many of these: the first and last ones, and some between. */
static void try_calls(faulted *f, const char *variable, unsigned calls, unsigned sample, fault_kind kind) {
    const unsigned ends = sample / 4, salt = (unsigned)(f->c - cases) * 7919 + (unsigned)kind * 104729;
    if (all || calls <= sample) sample = calls;
    for (unsigned i = 0; i < sample; i++) {
        unsigned at = 1 + i;
        if (sample < calls && i >= sample - ends) at = calls - (sample - 1 - i);
        if (sample < calls && i >= ends && i < sample - ends) {
            const uint64_t share = (calls - 2 * ends) / (sample - 2 * ends);
            at = 1 + ends + (unsigned)((i - ends) * share + (i * 2654435761u + salt) % share);
        }
        try_fault(f, variable, at, kind);
    }
}

static unsigned try_case(const run_case *c, unsigned *tried) {
    faulted f = {.c = c, .old = {3, "old"}};
    if (c->file) unlink(c->file);
    const int ended = run_froe(c->kind == LINKED, c->words, "", 0, FAULT_NONE);
    text said = slurp("said");
    const call_counts calls = read_counts();
    if (ended) fail_msg("froe %s: %#x: %s", c->words, (unsigned)ended, said.bytes);
    if (calls.memory < 10) fail_msg("froe %s: %u calls", c->words, calls.memory);
    f.out = slurp("out");
    if (c->file) f.file = slurp(c->file);
    assert_true(f.out.size + f.file.size > 0 && f.out.size < MOST_TEXT - 1 && f.file.size < MOST_TEXT - 1);
    const unsigned sample = c->kind == THOROUGH ? 8 * SAMPLE : SAMPLE;
    try_calls(&f, "FROE_FAULT_MEMORY", calls.memory, sample, FAULT_EIO);
    try_calls(&f, "FROE_FAULT_MEMORY", calls.memory, sample, FAULT_FOREVER);
    try_calls(&f, "FROE_FAULT_MEMORY", calls.memory, SAMPLE / 2, FAULT_INTERRUPT);
    try_calls(&f, "FROE_FAULT_MEMORY", calls.memory, SAMPLE / 2, FAULT_TERMINATE);
    try_calls(&f, "FROE_FAULT_STEPS", calls.steps, SAMPLE / 2, FAULT_INTERRUPT);
    if (all)
        printf("froe %s: %u calls for memory, %u of progress, %u runs, %u wrong\n", c->words, calls.memory, calls.steps,
               f.tried, f.wrong);
    fflush(stdout);
    free(said.bytes), free(f.out.bytes), free(f.file.bytes);
    if (c->file) unlink(c->file);
    *tried += f.tried;
    return f.wrong;
}

static void set_up(void) {
    if (mkdir("tmp", 0777) && errno != EEXIST) fail_msg("tmp: %s", strerror(errno));
    unlink("data");
    assert_int_equal(symlink(FROE_TEST_DATA, "data"), 0);
    setenv("TMPDIR", "tmp", 1);
    /* Leaks of the library are looked for by tests that call it; JSON is counted. */
    setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
    spill("q.csv", "x,y,name\n0.5,0.5,a\n2,48,\"b, c\"\n");
    spill("r.csv", "lo_x,lo_y,hi_x,hi_y\n0,0,0.5,0.5\n");
    spill("r3.csv", "lo_x,lo_y,lo_z,hi_x,hi_y,hi_z\n-9,-9,-9,9,9,9\n");
    spill("y.csv", "ox,oy,oz,dx,dy,dz\n-9,-9,-9,1,1,1\n9,0,0,-1,0,0\n");
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        char words[200];
        snprintf(words, sizeof words, "%s --quiet", scenes[i]);
        if (run_froe(false, words, "", 0, FAULT_NONE)) fail_msg("froe %s: see the file 'said'", words);
    }
    sweep();
}

static void nothing_is_lost_and_every_end_is_told(void **state) {
    (void)state;
    unsigned wrong = 0, tried = 0, chosen = 0;
    set_up();
    for (size_t i = 0; i < CASES; i++) {
        if (strncmp(cases[i].words, only, strlen(only)) != 0) continue;
        wrong += try_case(cases + i, &tried);
        chosen++;
    }
    printf("%u runs of %u command lines, %u wrong\n", tried, chosen, wrong);
    assert_true(chosen && tried > 5 * SAMPLE / 2 * chosen);
    assert_int_equal(wrong, 0);
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_is_lost_and_every_end_is_told),
    };
    all = argc > 1 && !strcmp(argv[1], "all");
    if (argc > 2) only = argv[2];
    signal(SIGINT, SIG_DFL); /* shells make what they start in the background ignore it */
    return cmocka_run_group_tests(tests, NULL, NULL);
}
