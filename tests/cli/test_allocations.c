/* test_allocations.c: every command, while memory runs out, the time is over, or Ctrl-C or `kill` comes, anywhere: at
 * each call that gives memory, and at each that tells of progress. It says that memory has run out, with exit code 4,
 * and what it was to write is as before; or it found another way, and all is as without a fault. After a signal it says
 * that it was cancelled, or late. Nothing else is left behind, nothing crashes.
 *
 * A place of the program that asks for memory is refused it once, in the first command that comes there. Of the places
 * an eighth is tried. Of the other faults there is a sample of the calls, of another seed for each command. With the
 * argument "all" (make faults) each call has each fault, with "all WORDS" only those of the command lines that begin
 * with these words. */
#include "faults/commands.h"
#include "support/sanitized.h"
#include <inttypes.h>

static bool all;
static const char *only = ""; /* command lines that begin with this */

/* Calls that are tried of a kind, of most kinds half as many. */
enum { SAMPLE = SANITIZED ? 2 : 6 };

/* After memory that was refused. The file may be written and the report refused. */
static const char *judge_memory(const outcome *o) {
    if (!WIFEXITED(o->ended)) return "it crashes";
    if (WEXITSTATUS(o->ended) == 0) return o->whole ? NULL : "its output is another one";
    if (WEXITSTATUS(o->ended) != 4) return "the exit code is wrong";
    if (!o->as_before && !o->file_whole) return "the old file is lost";
    if (!is_told(o->said)) return "it does not say why in lines of its own";
    return strstr(o->said.bytes, "ut of memory") || strstr(o->said.bytes, "Cannot allocate memory")
               ? NULL
               : "it does not say that memory ran out";
}

/* After a signal, which may come before it is listened to, or when all is done. */
static const char *judge_signal(const outcome *o, int number) {
    if (WIFSIGNALED(o->ended)) return WTERMSIG(o->ended) == number && o->as_before ? NULL : "it crashes";
    if (WEXITSTATUS(o->ended) != 128 + number) return "the exit code is wrong";
    if (!o->as_before && !o->file_whole) return "the old file is lost";
    return is_told(o->said) && strstr(o->said.bytes, "ancelled") ? NULL : "it does not say that it was cancelled";
}

/* When the time is over, which is told unless all is done. */
static const char *judge_late(const outcome *o) {
    if (!WIFEXITED(o->ended)) return "it crashes";
    if (WEXITSTATUS(o->ended) == 0) return o->whole ? NULL : "its output is another one";
    if (WEXITSTATUS(o->ended) != 4) return "the exit code is wrong";
    if (!o->as_before && !o->file_whole) return "the old file is lost";
    return is_told(o->said) && strstr(o->said.bytes, "longer than --limit-time allows")
               ? NULL
               : "it does not say that it was late";
}

static const char *judge(const run_case *c, const outcome *o, fault one) {
    (void)c;
    const bool memory = !strcmp(one.variable, "FROE_FAULT_MEMORY");
    const bool met = one.at <= (memory ? o->calls.memory : o->calls.steps);
    if (one.kind < FAULT_INTERRUPT || (!met && !WIFSIGNALED(o->ended))) return judge_memory(o);
    if (one.kind == FAULT_LATE) return judge_late(o);
    return judge_signal(o, one.kind == FAULT_INTERRUPT ? SIGINT : SIGTERM);
}

/* The faults of one kind at `calls` calls, or at so many of these: the first and last ones, and some between. */
static void try_calls(faulted *f, const char *variable, unsigned calls, unsigned sample, fault_kind kind) {
    const unsigned ends = sample / 3, salt = (unsigned)(f->c - cases) * 7919 + (unsigned)kind * 104729;
    if (all || calls <= sample) sample = calls;
    for (unsigned i = 0; i < sample; i++) {
        unsigned at = 1 + i;
        if (sample < calls && i >= sample - ends) at = calls - (sample - 1 - i);
        if (sample < calls && i >= ends && i < sample - ends) {
            const uint64_t share = (calls - 2 * ends) / (sample - 2 * ends);
            at = 1 + ends + (unsigned)((i - ends) * share + (i * 2654435761u + salt) % share);
        }
        try_faults(f, (fault){variable, at, kind}, no_fault, judge);
    }
}

/* Hashes of places (faults/memory.c), of both programs. */
typedef struct known_places {
    uint64_t hashes[32768];
    size_t count;
} known_places;

/* One of so many places is tried. Which ones depends on the machine code. Where branches are counted, all are. */
static uint64_t places_of_one(void) {
    return getenv("LLVM_PROFILE_FILE") ? 1 : 8;
}

/* Adds a place; was it unknown? */
static bool add_place(known_places *k, uint64_t hash) {
    for (size_t i = 0; i < k->count; i++)
        if (k->hashes[i] == hash) return false;
    assert_true(k->count < sizeof k->hashes / sizeof *k->hashes);
    k->hashes[k->count++] = hash;
    return true;
}

/* Refuses memory where no command before asked for it. */
static void try_places(faulted *f, known_places *known) {
    const size_t before = known->count;
    unsigned calls[sizeof known->hashes / sizeof *known->hashes];
    unsigned number;
    uint64_t hash;
    FILE *file = fopen("places", "r");
    assert_non_null(file);
    while (fscanf(file, "%u %" SCNx64, &number, &hash) == 2)
        if (hash % places_of_one() == 0 && add_place(known, hash ^ (f->c->kind == LINKED)))
            calls[known->count - 1] = number;
    fclose(file);
    for (size_t i = before; i < known->count; i++)
        try_faults(f, (fault){"FROE_FAULT_MEMORY", calls[i], FAULT_EIO}, no_fault, judge);
}

static unsigned try_case(const run_case *c, known_places *known, unsigned *tried) {
    faulted f = begin_case(c);
    const call_counts calls = f.calls;
    if (calls.memory < 10) fail_msg("froe %s: %u calls", c->words, calls.memory);
    const unsigned sample = c->kind == THOROUGH ? 8 * SAMPLE : SAMPLE;
    if (all)
        try_calls(&f, "FROE_FAULT_MEMORY", calls.memory, sample, FAULT_EIO);
    else
        try_places(&f, known);
    try_calls(&f, "FROE_FAULT_MEMORY", calls.memory, sample, FAULT_FOREVER);
    try_calls(&f, "FROE_FAULT_MEMORY", calls.memory, SAMPLE / 2, FAULT_INTERRUPT);
    try_calls(&f, "FROE_FAULT_MEMORY", calls.memory, SAMPLE / 2, FAULT_TERMINATE);
    try_calls(&f, "FROE_FAULT_STEPS", calls.steps, SAMPLE / 2, FAULT_INTERRUPT);
    try_calls(&f, "FROE_FAULT_STEPS", calls.steps, SAMPLE / 3, FAULT_LATE);
    if (all)
        printf("froe %s: %u calls for memory, %u of progress, %u runs, %u wrong\n", c->words, calls.memory, calls.steps,
               f.tried, f.wrong);
    end_case(&f);
    *tried += f.tried;
    return f.wrong;
}

static void nothing_is_lost_and_every_end_is_told(void **state) {
    (void)state;
    static known_places known;
    unsigned wrong = 0, tried = 0, chosen = 0;
    set_up();
    for (size_t i = 0; i < CASES; i++) {
        if (strncmp(cases[i].words, only, strlen(only)) != 0) continue;
        wrong += try_case(cases + i, &known, &tried);
        chosen++;
    }
    printf("%u runs of %u command lines, %zu places, %u wrong\n", tried, chosen, known.count, wrong);
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
