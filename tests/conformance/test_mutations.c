/* Every bit of a tree file matters, or means something: mutation of files as a test of validation and audit.
 *
 * One bit of a small tree's file is turned over and the checksums are made right. Then the file
 *     is refused by froe_tree_open(), or
 *     opens and fails the audit, or
 *     describes another right tree: all answers are those of brute force on the scene that it holds.
 * There is no other outcome, and no crash: a tree that fails the audit is asked everything, too.
 *
 *     test_conformance_mutations                    a sample of the bits of every section
 *     test_conformance_mutations all [METHOD...]    all bits, a line for each method; an hour
 */
#include "query/answers.h"
#include "support/forge.h"
#include "support/opened.h"
#include "support/samples.h"
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#define NAME "mutant.froe"
enum {
    SAMPLE = 1,            /* bits of a section, and ... */
    SAMPLE_OF_TREE = 4,    /* ... of one that the audit is about */
    SAMPLE_OF_BLOCKS = 80, /* which say the most */
    PATIENCE = 60,         /* seconds for a mutant before it counts as one that hangs */
    ROUNDS = 6,            /* of questions to a tree that passes the audit */
    MOST_BYTES = 64 << 20, /* that a tree may take */
    MOST_COMPLAINTS = 20,
    MOST_METHODS = 20,
};

typedef enum outcome { REFUSED, FAILED, RIGHT, OUTCOMES } outcome;

typedef struct tally {
    const char *method;
    size_t trees, count[OUTCOMES];
} tally;

typedef struct mutation {
    uint8_t *bytes;
    size_t size;
    const char *method, *scene;
    bool all;
    char **methods; /* NULL-terminated; NULL: all */
    tally tallies[MOST_METHODS];
    size_t wrong;
} mutation;

/* For the alarm. */
static char now[200];

static void hangs(int signal_number) {
    (void)signal_number;
    (void)!write(STDERR_FILENO, now, strlen(now));
    (void)!write(STDERR_FILENO, " hangs\n", 7);
    _exit(3);
}

/* ----------------------------------------------------------------- mutants -- */

static froe_status open_bytes(const uint8_t *bytes, size_t size, const froe_allocator *alloc, froe_tree **tree,
                              froe_diagnostic *why) {
    const int fd = open(NAME, O_WRONLY | O_CREAT, 0666);
    assert_true(fd >= 0);
    assert_int_equal(pwrite(fd, bytes, size, 0), size);
    assert_int_equal(ftruncate(fd, (off_t)size), 0);
    assert_int_equal(close(fd), 0);
    return froe_tree_open(NAME, alloc, tree, why);
}

static void complain(mutation *m, const char *what) {
    if (m->wrong++ < MOST_COMPLAINTS) print_error("%s: %s\n", now, what);
}

static outcome judge_tree(mutation *m, const froe_tree *tree, uint64_t seed) {
    froe_audit_options o = froe_audit_defaults();
    froe_diagnostic why;
    char text[300];
    o.threads = 1;
    opened_ask(tree, seed, ROUNDS);
    const froe_status whole = froe_tree_check(tree, &why);
    if (whole) {
        if (whole != FROE_E_FORMAT || !why.message[0]) complain(m, "refused without a reason");
        opened_ask(tree, seed + 1, ROUNDS);
        return REFUSED;
    }
    const froe_status status = froe_tree_audit(tree, &o, &why);
    if (status == FROE_OK) {
        if (!answers_right(tree, seed, ROUNDS, text, sizeof text)) complain(m, text);
        return RIGHT;
    }
    if (status != FROE_E_AUDIT || !why.message[0]) complain(m, "an audit without a finding");
    answers_ask(tree, seed, ROUNDS);
    return FAILED;
}

static outcome judge(mutation *m, const uint8_t *bytes, uint64_t seed) {
    froe_tree *tree;
    froe_diagnostic why;
    outcome out = REFUSED;
    test_memory memory;
    const froe_allocator alloc = test_memory_begin(&memory);
    alarm(PATIENCE);
    const froe_status status = open_bytes(bytes, m->size, &alloc, &tree, &why);
    if (status == FROE_OK) {
        out = judge_tree(m, tree, seed);
        froe_tree_free(tree);
    } else if (status != FROE_E_FORMAT || !why.message[0]) {
        complain(m, "refused without a reason");
    }
    alarm(0);
    test_memory_end(&memory);
    if (memory.peak > MOST_BYTES) complain(m, "too much memory");
    return out;
}

static tally *tally_of(mutation *m) {
    size_t i = 0;
    while (m->tallies[i].method && strcmp(m->tallies[i].method, m->method) != 0) i++;
    assert_true(i < MOST_METHODS);
    m->tallies[i].method = m->method;
    return m->tallies + i;
}

static void flip(mutation *m, uint64_t bit) {
    uint8_t *copy = malloc(m->size);
    assert_non_null(copy);
    memcpy(copy, m->bytes, m->size);
    copy[bit / 8] ^= (uint8_t)(1u << bit % 8);
    forge_checksums(copy, m->size);
    snprintf(now, sizeof now, "%s of %s, byte %zu of %zu, bit %u", m->method, m->scene, (size_t)bit / 8, m->size,
             (unsigned)(bit % 8));
    tally_of(m)->count[judge(m, copy, bit)]++;
    free(copy);
}

/* All bits from one byte up to another, or some, that depend on nothing but the file's size. */
static void flip_part(mutation *m, uint64_t from, uint64_t to, uint64_t sample) {
    const uint64_t bits = 8 * (to - from);
    if (m->all)
        for (uint64_t i = 0; i < bits; i++) flip(m, 8 * from + i);
    else
        for (uint64_t i = 0; bits && i < (sample + EXACT_SHARE - 1) / EXACT_SHARE; i++)
            flip(m, 8 * from + base_below(base_hash(m->size, from, i), (uint32_t)bits));
}

static uint64_t sample_of(uint32_t id) {
    if (id == FILE_BLOCKS) return SAMPLE_OF_BLOCKS;
    const bool tree = (id != FILE_META && file_is_of_tree((file_id)id)) || id == FILE_COORDS || id == FILE_CORNERS;
    return tree ? SAMPLE_OF_TREE : SAMPLE;
}

static void flip_sections(mutation *m) {
    uint64_t end = sizeof(file_header) + FILE_SECTIONS * sizeof(file_section);
    flip_part(m, 0, sizeof(file_header) - 8, SAMPLE); /* without checksums, which forge_checksums() makes */
    for (uint32_t i = 0; i < FILE_SECTIONS; i++) {
        const uint64_t at = sizeof(file_header) + i * sizeof(file_section);
        file_section s;
        memcpy(&s, m->bytes + at, sizeof s);
        if (m->all || i % 4 == m->size / 64 % 4) flip_part(m, at, at + offsetof(file_section, checksum), 1);
        if (m->all) flip_part(m, end, s.offset, 0);
        flip_part(m, s.offset, s.offset + s.size, sample_of(i + 1));
        if (!m->all && i + 1 == FILE_META)
            flip_part(m, s.offset + offsetof(tree_meta, root_lo), s.offset + s.size, SAMPLE_OF_TREE);
        end = s.offset + s.size;
    }
    if (m->all) flip_part(m, end, m->size, 0);
}

/* ------------------------------------------------------------------- trees -- */

static bool is_wanted(const mutation *m, const char *method) {
    size_t i = 0;
    if (!m->methods || !m->methods[0]) return true;
    while (m->methods[i] && strcmp(m->methods[i], method) != 0) i++;
    return m->methods[i];
}

static bool mutate(void *user, const char *method, const char *scene, const froe_tree *tree) {
    mutation *m = user;
    char text[300];
    if (!is_wanted(m, method)) return true;
    m->method = method, m->scene = scene;
    assert_int_equal(froe_tree_save(tree, "sample.froe", NULL), FROE_OK);
    FILE *in = fopen("sample.froe", "rb");
    assert_non_null(in);
    fseek(in, 0, SEEK_END);
    m->size = (size_t)ftell(in);
    rewind(in);
    m->bytes = malloc(m->size);
    assert_non_null(m->bytes);
    assert_int_equal(fread(m->bytes, 1, m->size, in), m->size);
    fclose(in);
    snprintf(now, sizeof now, "%s of %s as it is", method, scene);
    if (!answers_right(tree, 1, 10 * ROUNDS, text, sizeof text)) complain(m, text);
    flip_sections(m);
    tally_of(m)->trees++;
    free(m->bytes);
    return true;
}

static size_t sum_up(const mutation *m) {
    size_t sum[OUTCOMES] = {0}, trees = 0;
    print_message("%-14s %6s %9s %9s %9s\n", "method", "trees", "refused", "failed", "right");
    for (const tally *t = m->tallies; t->method; t++) {
        print_message("%-14s %6zu %9zu %9zu %9zu\n", t->method, t->trees, t->count[0], t->count[1], t->count[2]);
        trees += t->trees;
        for (int i = 0; i < OUTCOMES; i++) sum[i] += t->count[i];
    }
    print_message("%-14s %6zu %9zu %9zu %9zu\n", "all", trees, sum[0], sum[1], sum[2]);
    print_message("%zu wrong\n", m->wrong);
    for (int i = 0; i < OUTCOMES; i++) assert_true(sum[i] > 0);
    return sum[REFUSED] + sum[FAILED] + sum[RIGHT];
}

static mutation plan;

static void a_turned_bit_is_refused_or_found_or_harmless(void **state) {
    (void)state;
    signal(SIGALRM, hangs);
    samples_each(mutate, &plan);
    unlink(NAME);
    unlink("sample.froe");
    assert_true(sum_up(&plan) >= (plan.methods ? 1 : 1000));
    assert_int_equal(plan.wrong, 0);
}

static int tell_where(void **state) {
    (void)state;
    if (now[0]) print_error("the last one: %s\n", now);
    return 0;
}

int main(int argc, char **argv) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_turned_bit_is_refused_or_found_or_harmless, tell_where),
    };
    plan.all = argc > 1 && !strcmp(argv[1], "all");
    plan.methods = argc > 2 ? argv + 2 : NULL;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
