/* test_letters.c: what processes send each other about questions and answers, byte for byte: room for it may be refused
 * anywhere, what is cut off anywhere is refused, and what says more than has come, too. */
#include "shards/ask/kinds.h"
#include "shards/ask/letters.h"
#include "shards/ask/share.h"
#include "shards/folders.h"
#include "support/memory.h"
#include <math.h>
#include <stddef.h>

enum { OBJECTS = 20, SHARDS = 3, QUESTIONS = 6 };

static froe_status trade_nothing(void *user, froe_status status, const froe_shard_records *out, const size_t *counts,
                                 froe_shard_records *in, size_t *in_counts, froe_diagnostic *diag) {
    (void)user, (void)out, (void)counts, (void)in, (void)in_counts, (void)diag;
    return status;
}

static froe_status open_shared(const froe_allocator *alloc, froe_shards **out) {
    froe_status status = froe_shards_open("letters.froes", alloc, out, NULL);
    if (status) return status;
    status = froe_shards_share(*out, 0, 2, trade_nothing, NULL, NULL);
    if (!status) status = froe_shards_share(*out, 0, 2, trade_nothing, NULL, NULL); /* instead of the first */
    if (status) froe_shards_close(*out);
    return status;
}

static int setup(void **state) {
    one_object *list = lattice_objects(2, FROE_SEGMENT, OBJECTS, 9, 5);
    froe_shards_options o = froe_shards_defaults();
    o.shards = SHARDS;
    const froe_status status = build_folder("letters.froes", 2, list, OBJECTS, &o, NULL, NULL);
    free(list);
    return status || open_shared(NULL, (froe_shards **)state);
}

static int teardown(void **state) {
    froe_shards_close(*state);
    return 0;
}

static const double numbers[] = {1, 2, 3, 5, 8, 13, 21, 34, 55, 89, 144, 233, 377, 610, 987, 1597};
static const size_t which[QUESTIONS] = {0, 1, 2, 3, 4, 5};
static const bool alone[QUESTIONS] = {true, false, true};

/* With and without points and offsets, and of a shape that there is not: whether ranges are good is not asked here. */
static void make_ranges(froe_range ranges[QUESTIONS]) {
    static const froe_range_shape shapes[QUESTIONS] = {FROE_SHAPE_BOX,        FROE_SHAPE_HULL,  FROE_SHAPE_HALFSPACES,
                                                       FROE_SHAPE_HALFSPACES, FROE_SHAPE_COUNT, FROE_SHAPE_BALL};
    for (size_t i = 0; i < QUESTIONS; i++) {
        ranges[i] = froe_range_defaults();
        ranges[i].shape = shapes[i], ranges[i].count = 3, ranges[i].radius = 1;
        ranges[i].points = i == 5 ? NULL : numbers + i, ranges[i].offsets = i == 2 ? numbers : NULL;
    }
}

/* Puts questions, or, without these, answers into room for so many bytes, which does not grow. */
static bool put_into(froe_shards *s, const shards_question *q, const shards_list *answers, size_t room, void *bytes) {
    test_memory m;
    size_t count = 0;
    const froe_shard_records whole = s->share->out;
    s->share->out = (froe_shard_records){.alloc = test_memory_begin(&m), .capacity = room};
    if (room) s->share->out.bytes = test_memory_fn(&m, NULL, 0, room);
    m.fail_at = 1, m.fail_on = true;
    const bool ok = answers ? shards_put_answers(s->share, &count, answers)
                            : shards_put_questions(s->share, &count, q, 0, which, alone, q->count);
    assert_true(count <= room && count == s->share->out.count);
    if (ok) memcpy(bytes, s->share->out.bytes, count);
    froe_shard_records_free(&s->share->out);
    test_memory_end(&m);
    s->share->out = whole;
    return ok;
}

/* All words, after room for them was refused at each of them. */
static size_t put_everywhere(froe_shards *s, const shards_question *q, const shards_list *answers, void *bytes,
                             size_t most) {
    size_t room = 0;
    while (!put_into(s, q, answers, room, bytes)) {
        room += 8;
        assert_true(room <= most);
    }
    assert_true(room > 32);
    return room;
}

static froe_status take_questions(froe_shards *s, const shards_question *q, const unsigned char *bytes, size_t count,
                                  shards_list *list) {
    shards_letter letter = {bytes, count};
    const shards_call call = {.s = s, .q = q};
    const froe_status status = shards_take_questions(&letter, &call, list, NULL);
    if (!status) assert_int_equal(letter.left, 0);
    return status;
}

static void questions_come_whole_or_are_refused(void **state) {
    froe_shards *s = *state;
    static uint64_t words[1000];
    unsigned char *bytes = (unsigned char *)words;
    froe_range ranges[QUESTIONS];
    make_ranges(ranges);
    const shards_question kinds[] = {shards_kind_ranges(s, ranges, QUESTIONS), shards_kind_boxes(s, numbers, 4),
                                     shards_kind_rays(s, numbers, numbers + 3, 5, 1, INFINITY)};
    for (size_t k = 0; k < 3; k++) {
        const shards_question *q = kinds + k;
        shards_list list;
        const size_t count = put_everywhere(s, q, NULL, bytes, sizeof words);
        for (size_t cut = 0; cut < count; cut++) {
            assert_int_equal(take_questions(s, q, bytes, cut, &list), FROE_E_FORMAT);
            shards_list_free(&s->alloc, &list);
        }
        assert_int_equal(take_questions(s, q, bytes, count, &list), FROE_OK);
        assert_true(list.count == q->count && !memcmp(list.alone, alone, q->count));
        for (size_t i = 0; i < q->count && q->ranges; i++) {
            const froe_range *r = list.ranges + i;
            assert_true(r->shape == ranges[i].shape && !r->points == !ranges[i].points &&
                        !r->offsets == !ranges[i].offsets);
            if (r->points && i < 4) assert_memory_equal(r->points, ranges[i].points, 2 * sizeof(double));
        }
        shards_list_free(&s->alloc, &list);
    }
}

/* Numbers that other processes say, and which do not fit what has come. */
static void ranges_of_other_numbers_are_refused(void **state) {
    froe_shards *s = *state;
    static uint64_t words[1000], changed[1000];
    enum { FIRST = 2 + 1, SPOTS = 4 }; /* words before those of the only range */
    froe_range ranges[QUESTIONS];
    make_ranges(ranges);
    const shards_question q = shards_kind_ranges(s, ranges + 2, 1);
    const size_t count = put_everywhere(s, &q, NULL, words, sizeof words);
    static const struct {
        size_t word;
        uint64_t value;
    } cases[] = {{0, 1},         /* a shard of the other process */
                 {1, 1 << 20},   /* more questions */
                 {FIRST, 9},     /* all that is left are points, and then there are no offsets */
                 {FIRST, 1000},  /* more points */
                 {FIRST + 1, 2}, /* fewer offsets */
                 {FIRST + 1, 1000},
                 {FIRST + SPOTS + offsetof(froe_range, count) / 8, UINT64_MAX},
                 {FIRST + SPOTS + offsetof(froe_range, count) / 8, 2}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        shards_list list;
        memcpy(changed, words, count);
        changed[cases[i].word] = cases[i].value;
        assert_int_equal(take_questions(s, &q, (unsigned char *)changed, count, &list), FROE_E_FORMAT);
        shards_list_free(&s->alloc, &list);
    }
}

static bool count_down(void *user, size_t i, const froe_find *find) {
    (void)i, (void)find;
    return (*(size_t *)user)-- > 0;
}

/* Takes answers to all questions; there is memory for so many of them. */
static froe_status take_answers(froe_shards *s, const shards_question *q, const unsigned char *bytes, size_t count,
                                size_t memory) {
    shards_letter letter = {bytes, count};
    shards_call call = {.s = s, .q = q, .limit = QUESTIONS, .take = count_down, .take_user = &memory};
    const froe_status status = shards_take_answers(&call, &letter, 0, which, QUESTIONS, NULL);
    if (!status) assert_int_equal(letter.left, 0);
    return status;
}

static void answers_come_whole_or_are_refused(void **state) {
    froe_shards *s = *state;
    static uint64_t words[1000];
    unsigned char *bytes = (unsigned char *)words;
    uint32_t counts[QUESTIONS] = {2, 0, 1, 0, 3, 1}, objects[7] = {0, 1, 2, 3, 4, 5, 6};
    uint64_t tags[7] = {9, 8, 7, 6, 5, 4, 3};
    double values[7] = {0, 1, 2, 3, 4, 5, 6};
    for (int kind = 0; kind < 3; kind++) /* answers, with values, and numbers of answers */
        for (size_t limit = QUESTIONS - 1; limit <= QUESTIONS; limit++) { /* one question is bad, or none */
            shards_question q = kind == 1 ? shards_kind_near(s, numbers, QUESTIONS, 1, INFINITY)
                                          : shards_kind_points(s, numbers, QUESTIONS, NULL);
            q.counted = kind == 2;
            const size_t all = kind == 2 ? 0 : 7;
            const shards_list list = {.count = QUESTIONS,
                                      .limit = limit,
                                      .bad = {.status = FROE_E_INPUT, .message = "It is no point."},
                                      .counts = counts,
                                      .tags = {tags, all, all},
                                      .objects = {objects, all, all},
                                      .values = {values, kind == 1 ? all : 0, kind == 1 ? all : 0}};
            const size_t count = put_everywhere(s, NULL, &list, bytes, sizeof words);
            for (size_t cut = 0; cut < count; cut++)
                assert_int_equal(take_answers(s, &q, bytes, cut, 100), FROE_E_FORMAT);
            assert_int_equal(take_answers(s, &q, bytes, count, 100), FROE_OK);
            for (size_t memory = 0; memory < 4; memory++)
                assert_int_equal(take_answers(s, &q, bytes, count, memory), FROE_E_MEMORY);
        }
}

/* A question is bad for a reason that a call can return, in a sentence that ends. */
static void refusals_of_other_processes_are_checked(void **state) {
    froe_shards *s = *state;
    static uint64_t words[1000];
    unsigned char *bytes = (unsigned char *)words;
    uint32_t counts[QUESTIONS] = {0};
    const shards_question q = shards_kind_points(s, numbers, QUESTIONS, NULL);
    static const froe_status statuses[] = {FROE_OK, FROE_E_INPUT, FROE_E_UNSUPPORTED, FROE_E_MEMORY, (froe_status)-1};
    for (size_t i = 0; i < sizeof statuses / sizeof *statuses; i++)
        for (int ends = 0; ends < 2; ends++) {
            shards_list list = {.count = QUESTIONS, .limit = 2, .bad = {.status = statuses[i]}, .counts = counts};
            memset(list.bad.message, 'a', sizeof list.bad.message - (size_t)ends);
            const size_t count = put_everywhere(s, NULL, &list, bytes, sizeof words);
            assert_int_equal(take_answers(s, &q, bytes, count, 100),
                             ends && (i == 1 || i == 2) ? FROE_OK : FROE_E_FORMAT);
        }
}

static bool count_pair(void *user, const froe_found_pair *pair) {
    (void)pair;
    ++*(size_t *)user;
    return true;
}

/* Pairs are those of the shards that a process owns, and a failure has its status also where no diagnostic is given. */
static void processes_have_pairs_of_their_own(void **state) {
    froe_shards *shared = *state, *s;
    size_t all = 0, parts = 0;
    assert_int_equal(froe_shards_open("letters.froes", NULL, &s, NULL), FROE_OK);
    assert_int_equal(froe_shards_pairs(s, true, NULL, count_pair, &all, NULL), FROE_OK);
    for (uint32_t rank = 0; rank < 2; rank++) {
        const size_t before = parts;
        assert_int_equal(froe_shards_share(s, rank, 2, trade_nothing, NULL, NULL), FROE_OK);
        assert_int_equal(froe_shards_pairs(s, true, NULL, count_pair, &parts, NULL), FROE_OK);
        assert_true(parts > before && parts - before < all);
    }
    assert_int_equal(parts, all);
    froe_finds finds;
    const froe_tree *tree;
    froe_diagnostic diag;
    assert_int_equal(froe_shards_tree(s, 1, &tree, &diag), FROE_OK);
    assert_int_equal(froe_shards_groups_join(s, tree, FROE_MEETS, NULL, &finds, &diag), FROE_E_UNSUPPORTED);
    assert_string_equal(diag.message, "A tree of questions is not sent to other processes.");
    froe_shards_close(s);
    assert_int_equal(shards_share_trade(shared->share, FROE_E_IO, NULL), FROE_E_IO);
}

static froe_status share(void *user, const froe_allocator *alloc) {
    froe_shards *s;
    (void)user;
    const froe_status status = open_shared(alloc, &s);
    if (!status) froe_shards_close(s);
    return status;
}

static void sharing_may_lack_memory(void **state) {
    (void)state;
    assert_true(test_memory_each(share, NULL) > 5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(questions_come_whole_or_are_refused),
        cmocka_unit_test(ranges_of_other_numbers_are_refused),
        cmocka_unit_test(answers_come_whole_or_are_refused),
        cmocka_unit_test(refusals_of_other_processes_are_checked),
        cmocka_unit_test(processes_have_pairs_of_their_own),
        cmocka_unit_test(sharing_may_lack_memory),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
