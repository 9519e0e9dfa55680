/* test_reads.c: every command, while calls that read fail, in turn one alone or all from it on: open(), read(), mmap(),
 * stat() and others of the program and its core. It names a file and the reason, with exit code 3 or 4, and what it was
 * to write is as before; or it found another way, and all is as without a fault. A read that
 * hands over one byte changes nothing. Where a file ends early, nothing crashes or waits.
 *
 * Then memory is refused, and a call that reads or writes fails, in the same run: at pairs of calls that are drawn. */
#include "faults/commands.h"
#include "support/sanitized.h"

static bool all; /* the argument "all": every kind of fault at every call, and more pairs; otherwise one kind in turn */
enum { PAIRS = 2, MOST_WRITES = 12 };

/* Does it name a file of the command line, what reads it, one of the system, or one that the command has made? */
static bool names_file(const run_case *c, const char *said) {
    char line[300];
    if (strstr(said, "standard input") || strstr(said, "froe-") || strstr(said, "/proc/")) return true;
    snprintf(line, sizeof line, "%s", c->words);
    for (char *word = strtok(line, " "); word; word = strtok(NULL, " "))
        if (strchr(word, '.') && strstr(said, word)) return true;
    return false;
}

/* What holds after all faults that let the program go on. */
static const char *judge_end(const outcome *o) {
    if (!WIFEXITED(o->ended)) return "it crashes";
    const int code = WEXITSTATUS(o->ended);
    if (!code) return NULL;
    if (code != 3 && code != 4) return "the exit code is wrong";
    if (!o->as_before && !o->file_whole) return "the old file is lost";
    return is_told(o->said) ? NULL : "it does not say why in lines of its own";
}

static const char *judge_read(const run_case *c, const outcome *o, fault one) {
    const char *why = judge_end(o);
    const bool done = !o->ended;
    if (why || one.kind == FAULT_END) return why;
    if (done) return o->whole ? NULL : "its output is another one";
    if (one.kind == FAULT_SHORT) return "it does not read on";
    if (!strstr(o->said.bytes, one.kind == FAULT_EINTR ? "Interrupted" : "Input/output error"))
        return "it does not say that reading failed";
    return names_file(c, o->said.bytes) ? NULL : "it does not name the file";
}

/* Of two faults either may be told. */
static const char *judge_two(const run_case *c, const outcome *o, fault one) {
    (void)c, (void)one;
    const char *why = judge_end(o);
    return why || o->ended || o->whole ? why : "its output is another one";
}

static void try_pairs(faulted *f) {
    uint32_t state = 2463534242u + (uint32_t)(f->c - cases);
    for (int i = 0; i < (all ? 10 * PAIRS : PAIRS); i++) {
        state ^= state << 13, state ^= state >> 17, state ^= state << 5; /* Marsaglia: Xorshift RNGs, 2003 */
        const unsigned others = i % 2 ? f->calls.reads : MOST_WRITES;
        const fault memory = {"FROE_FAULT_MEMORY", 1 + (state >> 8) % f->calls.memory, FAULT_EIO};
        const fault other = {i % 2 ? "FROE_FAULT_READS" : "FROE_FAULT", 1 + state % 251 % others,
                             i % 2 ? FAULT_FOREVER : FAULT_FULL};
        try_faults(f, memory, other, judge_two);
    }
}

static unsigned try_case(const run_case *c, unsigned *tried) {
    static const fault_kind others[] = {FAULT_FOREVER, FAULT_SHORT, FAULT_END, FAULT_EINTR};
    faulted f = begin_case(c);
    for (unsigned at = 1; at <= f.calls.reads; at++) {
        const unsigned turn = at + (unsigned)(c - cases), other = turn / 2 % 4;
        if (all || turn % 2 == 0) try_faults(&f, (fault){"FROE_FAULT_READS", at, FAULT_EIO}, no_fault, judge_read);
        for (unsigned i = 0; i < 4; i++)
            if (all || (turn % 2 && i == other && !SANITIZED))
                try_faults(&f, (fault){"FROE_FAULT_READS", at, others[i]}, no_fault, judge_read);
    }
    if (f.calls.reads) try_pairs(&f);
    if (getenv("FROE_TELL")) fprintf(stderr, "%s: %u reads %u wrong\n", c->words, f.calls.reads, f.wrong);
    end_case(&f);
    *tried += f.tried;
    return f.wrong;
}

static void what_cannot_be_read_is_named(void **state) {
    (void)state;
    unsigned wrong = 0, tried = 0;
    set_up();
    for (size_t i = 0; i < CASES; i++) wrong += try_case(cases + i, &tried);
    printf("%u runs, %u wrong\n", tried, wrong);
    assert_true(tried > 5 * CASES);
    assert_int_equal(wrong, 0);
}

int main(int argc, char **argv) {
    all = argc > 1 && !strcmp(argv[1], "all");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_cannot_be_read_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
