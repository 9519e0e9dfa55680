/* commands.h: command lines that are run with faults, by a program of FroeTests.cmake that has these inside, and how it
 * went: is what they write as before, or whole; what do they say? */
#ifndef FROE_TESTS_FAULTS_COMMANDS_H
#define FROE_TESTS_FAULTS_COMMANDS_H
#include "faults/faults.h"
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

#define FIFTY "12345678901234567890123456789012345678901234567890"
enum { MOST_WORDS = 40, MOST_TEXT = 1 << 21, MOST_TOLD = 20 };
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
    "build s.geojson --shards 3 -o f.froes",
    "generate moving-boxes -n 2 -o w.mfjson",
};

static const run_case cases[] = {
    {"info s.geojson", NULL, TIMED},
    {"info s.froe --json", NULL, PLAIN},
    {"info data/fzk-haus-boxes.csv --json", NULL, TIMED},
    {"measure s.geojson --json", NULL, TIMED},
    {"measure h.off --draw out.svg --quiet", "out.svg", LINKED},
    {"compare s.geojson --methods kd,index --queries 1 --halvings 0 --no-times -o out.html --quiet", "out.html",
     LINKED},
    {"compare s.geojson --methods kd --queries 1 --halvings 1 --no-times --csv out.csv --quiet", "out.csv", THOROUGH},
    {"build s.geojson -o out.froe --json", "out.froe", TIMED},
    {"build t.geojson -o out.froe --threads 3 --quiet", "out.froe", PLAIN},
    {"build h.off -o - --quiet", NULL, PLAIN},
    {"build tri.off --method cylindrical --order order.txt -o out.froe --quiet", "out.froe", PLAIN},
    {"info - --input-format geojson", NULL, TIMED},
    {"check f.froes", NULL, TIMED},
    {"range f.froes --queries r.csv", NULL, PLAIN},
    {"simulate plan.geojson --poses poses.csv --contacts out.csv --quiet", "out.csv", PLAIN},
    {"build b.csv --leaf 4 -o out.froe --quiet", "out.froe", PLAIN},
    {"check s.froe --json", NULL, TIMED},
    {"methods --json", NULL, PLAIN},
    {"locate s.froe --queries q.csv --columns x,name,id", NULL, PLAIN},
    {"locate data/countries-110m.json --wrap --groups --queries q.csv --columns name,id", NULL, LINKED},
    {"range s.geojson --queries r.csv --json", NULL, TIMED},
    {"range h.froe --queries r3.csv --format jsonl", NULL, PLAIN},
    {"ray h.froe --queries y.csv", NULL, PLAIN},
    {"near s.froe --queries q.csv -k 3 --format geojson", NULL, PLAIN},
    {"near b.csv --queries q.csv --save-tree out.froe", "out.froe", PLAIN},
    {"pairs s.geojson", NULL, PLAIN},
    {"draw s.froe -o out.svg --quiet", "out.svg", LINKED},
    {"draw s.froe --marks c.csv -o out.svg --quiet", "out.svg", LINKED},
    {"render h.froe -o out.pdf --quiet", "out.pdf", PLAIN},
    {"render w.mfjson --animate --frames 2 -o out.svg --quiet", "out.svg", PLAIN},
    {"render w.mfjson --animate --exact -o out.svg --quiet", "out.svg", PLAIN},
    {"render h.off --turntable 3 --animate -o out.svg --quiet", "out.svg", PLAIN},
    {"draw s.froe -o - --output-format svg --quiet", NULL, LINKED},
    {"range f.froes --queries r.csv --columns *,name --format geojson", NULL, PLAIN},
    {"locate f.froes --queries q.csv --groups", NULL, PLAIN},
    {"locate f.froes --queries q.csv --above", NULL, PLAIN},
    {"locate f.froes --queries q.csv", NULL, PLAIN},
    {"ray f.froes --queries y2.csv", NULL, PLAIN},
    {"ray f.froes --queries y2.csv --all", NULL, PLAIN},
    {"pairs f.froes", NULL, PLAIN},
    {"range s.froe --shape hull --queries p.csv --columns *,name", NULL, PLAIN},
    {"near s.froe --queries q.csv --columns point,name", NULL, PLAIN},
    {"info s.geojson --limit-memory 4000", NULL, TIMED},
    {"build s.geojson --method density --option k=16 --option growth=2 -o out.froe --quiet", "out.froe", PLAIN},
    {"render h.off --turntable 2 -o pic-%d.svg --quiet", "pic-1.svg", PLAIN},
    {"render w.mfjson --frames 2 -o pic-%d.svg --quiet", "pic-1.svg", PLAIN},
    {"render w.mfjson --at 1 -o out.svg --quiet", "out.svg", PLAIN},
    {"ray h.froe --queries y.csv --all --json", NULL, TIMED},
    {"near f.froes --queries q.csv", NULL, PLAIN},
    {"locate b.csv --queries q.csv --format geojson", NULL, PLAIN},
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

static void become(const char *path, int flags, int descriptor) {
    const int file = open(path, flags, 0666);
    if (file < 0 || dup2(file, descriptor) < 0) _exit(99);
    if (file != descriptor) close(file);
}

typedef struct fault {
    const char *variable; /* that the program reads; NULL: there is none */
    unsigned at;
    fault_kind kind;
} fault;
static const fault no_fault;

/* Runs `froe WORDS <in` with a fault or two; its wait status. What it prints is in the files "said" and "out", and
 * "counts" has how many calls of each kind there were; "places", without a fault, who asked for memory. */
static int run_froe(bool draws, const char *words, fault one, fault two) {
    enum { NEW = O_WRONLY | O_CREAT | O_TRUNC };
    char line[300], plan[40], *argv[MOST_WORDS] = {getenv(draws ? "FROE_FAULTY" : "FROE_FAULTY_CORE")};
    const fault both[] = {one, two};
    const pid_t child = fork();
    assert_true(child >= 0 && argv[0]);
    if (!child) {
        int count = 1;
        snprintf(line, sizeof line, "%s", words);
        for (char *word = strtok(line, " "); word && count < MOST_WORDS - 1; word = strtok(NULL, " "))
            argv[count++] = word;
        for (int i = 0; i < 2; i++) {
            snprintf(plan, sizeof plan, "%u %d", both[i].at, both[i].kind);
            if (both[i].variable) setenv(both[i].variable, plan, 1);
        }
        setenv("FROE_FAULT_COUNTS", "3", 1);
        become("in", O_RDONLY | O_CREAT, STDIN_FILENO);
        become("out", NEW, STDOUT_FILENO), become("said", NEW, STDERR_FILENO), become("counts", NEW, 3);
        if (!one.variable) {
            setenv("FROE_FAULT_PLACES", "4", 1);
            become("places", NEW, 4);
        }
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

/* How many calls of each kind the last run made. */
typedef struct call_counts {
    unsigned memory, steps, reads;
    int json; /* blocks of JSON that were left at the end */
} call_counts;

static call_counts read_counts(void) {
    call_counts c = {0};
    FILE *file = fopen("counts", "r");
    if (file && fscanf(file, "memory %u steps %u reads %u json %d", &c.memory, &c.steps, &c.reads, &c.json) != 4)
        c = (call_counts){0};
    if (file) fclose(file);
    return c;
}

/* Sentences of this program, one a line. */
static bool is_told(text said) {
    const char *line = said.bytes;
    while (!strncmp(line, "froe: ", 6) && strchr(line, '\n')) line = strchr(line, '\n') + 1;
    return said.size && !*line;
}

static void set_up(void) {
    static const char plan[] = "{\"type\":\"FeatureCollection\",\"features\":["
                               "{\"type\":\"Feature\",\"properties\":{\"name\":\"door\"},"
                               "\"geometry\":{\"type\":\"LineString\",\"coordinates\":[[0,0],[5,0]]}},"
                               "{\"type\":\"Feature\",\"properties\":{\"name\":\"wall\"},"
                               "\"geometry\":{\"type\":\"LineString\",\"coordinates\":[[3,4],[9,4]]}}]}";
    if (mkdir("tmp", 0777) && errno != EEXIST) fail_msg("tmp: %s", strerror(errno));
    unlink("data");
    assert_int_equal(symlink(FROE_TEST_DATA, "data"), 0);
    setenv("TMPDIR", "tmp", 1);
    /* Leaks of the library are looked for by tests that call it; JSON is counted. */
    setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
    spill("order.txt", "1\n0\n");
    spill("tri.off", "OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 1\n0 1 1\n3 0 1 2\n3 3 4 5\n");
    spill("in", plan), spill("plan.geojson", plan);
    spill("poses.csv", "body,time,x,y,qz,qw\ndoor,0,0,0,0,1\ndoor,2,0,0,0.7071067811865476,0.7071067811865476\n");
    /* Lines that are a little longer than what getline() takes at first, and one over two lines. */
    spill("q.csv", "x,y,name\n0.5,0.5,a\n2,48,\"b, c\n" FIFTY FIFTY "123456\"\n3,48," FIFTY FIFTY "1234567\n");
    spill("r.csv", "lo_x,lo_y,hi_x,hi_y\n0,0,0.5,0.5\n");
    spill("c.csv", "ax,ay,bx,by,r,name\n0.1,0.1,0.5,0.5,0.1,a\n0.2,0.9,0.3,0.8,0.05,b\n");
    spill("r3.csv", "lo_x,lo_y,lo_z,hi_x,hi_y,hi_z\n-9,-9,-9,9,9,9\n");
    spill("p.csv", "query,x,y,note\n0,0,0,a\n0,1,0,a\n0,0,1,a\n1,0.5,0.5,b\n1,0.9,0.9,b\n");
    spill("y2.csv", "ox,oy,dx,dy\n-9,0.5,1,0\n9,9,-1,-1\n");
    spill("y.csv", "ox,oy,oz,dx,dy,dz\n-9,-9,-9,1,1,1\n9,0,0,-1,0,0\n");
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        char words[200];
        snprintf(words, sizeof words, "%s --quiet", scenes[i]);
        if (run_froe(false, words, no_fault, no_fault)) fail_msg("froe %s: see the file 'said'", words);
    }
    sweep();
}

/* ----------------------------------------------------------------- outcomes -- */

typedef struct faulted {
    const run_case *c;
    text old, file, out; /* before; undisturbed */
    call_counts calls;   /* undisturbed */
    unsigned wrong, tried;
} faulted;

typedef struct outcome {
    int ended; /* wait status */
    text said;
    call_counts calls; /* several threads may make fewer than the last time */
    bool as_before, file_whole, whole;
} outcome;

/* Why an outcome is wrong; NULL: it is right. */
typedef const char *judge_fn(const run_case *c, const outcome *o, fault one);

static void complain(faulted *f, fault one, fault two, const outcome *o, const char *why) {
    if (f->wrong++ >= MOST_TOLD) return;
    fprintf(stderr, "froe %s: %s %u, kind %d", f->c->words, one.variable, one.at, one.kind);
    if (two.variable) fprintf(stderr, "; %s %u, kind %d", two.variable, two.at, two.kind);
    fprintf(stderr, ": %s; wait status %#x, it says: %s\n", why, (unsigned)o->ended, o->said.bytes);
}

static void try_faults(faulted *f, fault one, fault two, judge_fn *judge) {
    const char *const path = f->c->file;
    if (path) spill(path, "old");
    outcome o = {.ended = run_froe(f->c->kind == LINKED, f->c->words, one, two), .calls = read_counts()};
    text file = path ? slurp(path) : (text){0}, out = slurp("out");
    o.said = slurp("said");
    o.as_before = !path || same(file, f->old), o.file_whole = !path || same(file, f->file);
    o.whole = o.file_whole && (f->c->kind == TIMED || same(out, f->out));
    const char *why = judge(f->c, &o, one);
    if (why) complain(f, one, two, &o, why);
    if (sweep()) complain(f, one, two, &o, "temporary files are left");
    if (WIFEXITED(o.ended) && o.calls.json) complain(f, one, two, &o, "JSON is left");
    f->tried++;
    free(file.bytes), free(out.bytes), free(o.said.bytes);
}

/* Runs the command line undisturbed. */
static faulted begin_case(const run_case *c) {
    faulted f = {.c = c, .old = {3, "old"}};
    if (c->file) unlink(c->file);
    const int ended = run_froe(c->kind == LINKED, c->words, no_fault, no_fault);
    text said = slurp("said");
    if (ended) fail_msg("froe %s: %#x: %s", c->words, (unsigned)ended, said.bytes);
    f.calls = read_counts();
    f.out = slurp("out");
    if (c->file) f.file = slurp(c->file);
    assert_true(f.out.size + f.file.size > 0 && f.out.size < MOST_TEXT - 1 && f.file.size < MOST_TEXT - 1);
    free(said.bytes);
    return f;
}

static void end_case(faulted *f) {
    fflush(stdout);
    free(f->out.bytes), free(f->file.bytes);
    if (f->c->file) unlink(f->c->file);
}

#endif
