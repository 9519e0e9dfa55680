/* test_share.c: threads share the shards of a folder, as processes of an MPI program do, and get the answers that one
 * alone gets: in any number, on cuts through corners of objects and questions, with bad questions, and with memory
 * refused in one of them. */
#include "shards/ask/kinds.h"
#include "shards/folders.h"
#include "support/memory.h"
#include <froe/shard_parts.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>

enum { COUNT = 400, MOST = 24, QUESTIONS = 120, RANKS = 4 };

/* --------------------------------------------------------------- transport -- */

typedef struct post {
    froe_status status;
    froe_diagnostic diag;
    const froe_shard_records *out;
    const size_t *counts;
} post;

typedef struct office {
    pthread_mutex_t lock;
    pthread_cond_t turn;
    int ranks, waiting;
    unsigned rounds;
    post posts[RANKS];
    size_t foreign; /* bytes that went from one to another */
    bool spoils;    /* ranges that go to thread 0 have more points than were sent */
    /* Of the trade of this number (from 1 on; 0: of none) that brings thread 0 words of thread 1, those from word
     * `kept` on are lost, or, where `changes`, that word becomes `word`. */
    int spoilt_trade;
    size_t kept;
    bool changes;
    uint64_t word;
    int trades;
    bool spoilt;
} office;

typedef struct member {
    office *office;
    int rank;
} member;

static void wait_for_all(office *o) {
    pthread_mutex_lock(&o->lock);
    const unsigned round = o->rounds;
    if (++o->waiting == o->ranks) {
        o->waiting = 0;
        o->rounds++;
        pthread_cond_broadcast(&o->turn);
    }
    while (o->rounds == round) pthread_cond_wait(&o->turn, &o->lock);
    pthread_mutex_unlock(&o->lock);
}

/* The first failure, or FROE_OK. */
static froe_status agree(const member *m, froe_status status, froe_diagnostic *diag) {
    office *o = m->office;
    o->posts[m->rank].status = status;
    o->posts[m->rank].diag = *diag;
    wait_for_all(o);
    for (int r = 0; r < o->ranks && !status; r++) status = o->posts[r].status;
    for (int r = o->ranks - 1; r >= 0; r--)
        if (o->posts[r].status) status = o->posts[r].status, *diag = o->posts[r].diag;
    wait_for_all(o);
    return status;
}

/* Lets the only range that has come be one of more corners. Before it stand words of both threads, the shard and the
 * number of questions, of each whether it is put to this shard alone, and four words of the range; see share.c. */
static void spoil_range(froe_shard_records *in) {
    enum { BEFORE = 8 * (1 + 1 + 2 + 1 + 4) };
    froe_range r;
    if (in->count < BEFORE + sizeof r) return; /* these are answers */
    memcpy(&r, in->bytes + BEFORE, sizeof r);
    assert_int_equal(r.shape, FROE_SHAPE_HULL);
    r.count = 100000;
    memcpy(in->bytes + BEFORE, &r, sizeof r);
}

/* What thread 1 has sent, the last of the words, is not as it was. */
static void spoil_words(office *o, froe_shard_records *in, size_t *count) {
    if (!*count || ++o->trades != o->spoilt_trade || 8 * o->kept >= *count) return;
    unsigned char *sent = in->bytes + in->count - *count;
    o->spoilt = true;
    if (o->changes)
        memcpy(sent + 8 * o->kept, &o->word, sizeof o->word);
    else
        in->count -= *count - 8 * o->kept, *count = 8 * o->kept;
}

static froe_status trade(void *user, froe_status status, const froe_shard_records *out, const size_t *counts,
                         froe_shard_records *in, size_t *in_counts, froe_diagnostic *diag) {
    const member *m = user;
    office *o = m->office;
    if ((status = agree(m, status, diag))) return status;
    o->posts[m->rank].out = out, o->posts[m->rank].counts = counts;
    wait_for_all(o);
    for (int r = 0; r < o->ranks && !status; r++) {
        const post *from = &o->posts[r];
        size_t at = 0;
        for (int i = 0; i < m->rank; i++) at += from->counts[i];
        in_counts[r] = from->counts[m->rank];
        if (in_counts[r]) status = froe_shard_records_append(in, from->out->bytes + at, in_counts[r], diag);
        if (r != m->rank && m->rank == 0) o->foreign += in_counts[r];
    }
    if (o->spoils && m->rank == 0 && !status) spoil_range(in);
    if (m->rank == 0 && o->ranks == 2 && !status) spoil_words(o, in, &in_counts[1]);
    return agree(m, status, diag);
}

/* --------------------------------------------------------------- questions -- */

/* All questions; thread r of n asks those from QUESTIONS r / n on. */
typedef struct questions {
    int dim;
    double points[QUESTIONS * FROE_MAX_DIM], boxes[2 * QUESTIONS * FROE_MAX_DIM], directions[QUESTIONS * FROE_MAX_DIM];
    double shapes[QUESTIONS * 5 * FROE_MAX_DIM], offsets[QUESTIONS];
    froe_range ranges[QUESTIONS];
} questions;

static void make_questions(questions *q, int dim, uint64_t seed) {
    const size_t each = (size_t)dim;
    *q = (questions){.dim = dim};
    for (size_t i = 0; i < QUESTIONS; i++) {
        double *shape = q->shapes + 5 * each * i, *box = q->boxes + 2 * each * i, *direction = q->directions + each * i;
        for (size_t a = 0; a < each; a++) {
            q->points[i * each + a] = on_lattice(&seed, 2 * MOST) / 2;
            box[a] = on_lattice(&seed, MOST), box[each + a] = box[a] + on_lattice(&seed, i % 9 ? 4 : MOST);
            direction[a] = i % 3 ? on_lattice(&seed, 6) - 3 : a == i / 3 % each;
        }
        direction[0] += direction[0] == 0 && direction[1] == 0;
        for (size_t a = 0; a < 5 * each; a++) shape[a] = on_lattice(&seed, 2 * MOST) / 2;
        froe_range *r = &q->ranges[i];
        *r = froe_range_defaults();
        do r->shape = (froe_range_shape)(next_random(&seed) % FROE_SHAPE_COUNT);
        while (dim > 3 && r->shape == FROE_SHAPE_RAY);
        for (size_t a = 0; a < each && r->shape == FROE_SHAPE_BOX; a++) shape[each + a] = shape[a] + 2;
        r->points = shape, r->offsets = &q->offsets[i];
        r->count = r->shape == FROE_SHAPE_HULL ? 4 : 1;
        r->radius = on_lattice(&seed, 6) / 2;
        q->offsets[i] = on_lattice(&seed, MOST);
    }
}

/* Everything that was found, as text of words. */
typedef struct record_of_answers {
    ARRAY(uint64_t) words;
    froe_allocator alloc;
} record_of_answers;

static void note_find(record_of_answers *a, const froe_find *f) {
    uint64_t words[4] = {f->tag, f->shard, f->object, 0};
    memcpy(words + 3, &f->value, sizeof f->value);
    if (!array_append(&a->alloc, &a->words, words, 4)) abort();
}

typedef struct asking {
    const questions *q;
    froe_shards *shards;
    size_t first, count;
    int kind; /* which of the questions below */
    froe_find found[QUESTIONS];
    uint64_t counts[QUESTIONS];
    froe_finds finds;
    record_of_answers *out;
    froe_diagnostic diag;
} asking;
enum {
    RANGES,
    BOXES,
    COUNTS,
    ANY,
    LOCATE,
    ABOVE,
    BELOW,
    NEAR,
    NEAREST = NEAR + 6,
    RAY = NEAREST,
    RAY_ANY,
    RAY_ALL,
    COUNT_LOCATE,
    COUNT_ABOVE,
    COUNT_BELOW,
    COUNT_RAYS,
    COUNT_NEAR,
    ALL = COUNT_NEAR + 6,
    BATCHES = ALL /* points, of which a shard counts how often it is asked */
};

static const size_t some[] = {1, 3, 20}; /* neighbours */

static froe_status ask_counts(asking *a, const double *points, const double *directions) {
    const size_t n = a->count;
    switch (a->kind) {
    case COUNT_LOCATE:
        return froe_shards_locate_count(a->shards, points, n, NULL, a->counts, &a->diag);
    case COUNT_ABOVE:
    case COUNT_BELOW:
        if (a->q->dim != 2) return FROE_OK;
        return froe_shards_vertical_count(a->shards, points, n, a->kind == COUNT_ABOVE ? 1 : -1, NULL, a->counts,
                                          &a->diag);
    case COUNT_RAYS:
        return froe_shards_ray_count(a->shards, points, directions, n, 3, NULL, a->counts, &a->diag);
    default:
        return froe_shards_near_count(a->shards, points, n, some[(a->kind - COUNT_NEAR) % 3],
                                      a->kind < COUNT_NEAR + 3 ? INFINITY : 2, NULL, a->counts, &a->diag);
    }
}

static atomic_int batches; /* that shards were asked */

static froe_status ask_and_count(const shards_question *q, froe_query *query, const size_t *which, size_t count,
                                 const froe_batch_options *o, shards_answers *out, froe_diagnostic *diag) {
    const shards_question usual = shards_kind_points(&(froe_shards){.dim = q->dim, .alloc = q->alloc}, NULL, 0, NULL);
    batches++;
    return usual.ask(q, query, which, count, o, out, diag);
}

static froe_status ask_counted(asking *a, const double *points) {
    shards_question q = shards_kind_points(a->shards, points, a->count, froe_batch_locate);
    q.ask = ask_and_count;
    return shards_find_all(a->shards, &q, NULL, &a->finds, &a->diag);
}

static froe_status ask(asking *a) {
    const size_t dim = (size_t)a->q->dim, n = a->count;
    const double *points = a->q->points + a->first * dim, *directions = a->q->directions + a->first * dim;
    const froe_range *ranges = a->q->ranges + a->first;
    froe_shards *s = a->shards;
    switch (a->kind) {
    case RANGES:
        return froe_shards_range(s, ranges, n, NULL, &a->finds, &a->diag);
    case BOXES:
        return froe_shards_boxes(s, a->q->boxes + 2 * a->first * dim, n, NULL, &a->finds, &a->diag);
    case COUNTS:
        return froe_shards_count(s, ranges, n, NULL, a->counts, &a->diag);
    case ANY:
        return froe_shards_any(s, ranges, n, NULL, a->found, &a->diag);
    case LOCATE:
        return froe_shards_locate(s, points, n, NULL, &a->finds, &a->diag);
    case ABOVE:
    case BELOW:
        if (dim != 2) return FROE_OK;
        return froe_shards_vertical(s, points, n, a->kind == ABOVE ? 1 : -1, NULL, a->found, &a->diag);
    case RAY:
        return froe_shards_ray(s, points, directions, n, INFINITY, NULL, a->found, &a->diag);
    case RAY_ANY:
        return froe_shards_ray_any(s, points, directions, n, 2, NULL, a->found, &a->diag);
    case RAY_ALL:
        return froe_shards_ray_all(s, points, directions, n, 3, NULL, &a->finds, &a->diag);
    case BATCHES:
        return ask_counted(a, points);
    default:
        return a->kind < COUNT_LOCATE ? froe_shards_near(s, points, n, some[(a->kind - NEAR) % 3],
                                                         a->kind < NEAR + 3 ? INFINITY : 2, NULL, &a->finds, &a->diag)
                                      : ask_counts(a, points, directions);
    }
}

/* Keeps what came out, and frees it. */
static void note(asking *a) {
    for (size_t i = 0; i < a->count; i++) {
        const bool lists = a->finds.starts != NULL;
        for (size_t j = lists ? a->finds.starts[i] : 0; lists && j < a->finds.starts[i + 1]; j++)
            note_find(a->out, &a->finds.items[j]);
        if (!lists) note_find(a->out, &a->found[i]);
        if (!array_push(&a->out->alloc, &a->out->words, a->counts[i])) abort();
    }
    froe_finds_free(&a->finds);
}

/* ----------------------------------------------------------------- threads -- */

typedef struct worker {
    member member;
    const questions *q;
    int first_kind, end_kind;
    size_t first, count; /* questions */
    froe_allocator alloc;
    test_memory *memory; /* from the opened folder on, call number `fail_at` is refused; 0: none */
    size_t fail_at, calls;
    record_of_answers answers[ALL + 1];
    froe_status status;   /* agreed */
    froe_status own;      /* of this thread's last call */
    froe_diagnostic diag; /* of this thread's last call */
} worker;

static void *work(void *given) {
    worker *w = given;
    asking *a = calloc(1, sizeof *a);
    const uint32_t ranks = (uint32_t)w->member.office->ranks;
    if (!a) abort();
    *a = (asking){.q = w->q, .first = w->first, .count = w->count};
    w->status = froe_shards_open("shared.froes", &w->alloc, &a->shards, &a->diag);
    if (!w->status)
        w->status = froe_shards_share(a->shards, (uint32_t)w->member.rank, ranks, trade, &w->member, &a->diag);
    if (w->memory) {
        atomic_store(&w->memory->calls, 0);
        w->memory->fail_at = w->fail_at;
    }
    w->status = agree(&w->member, w->status, &a->diag);
    for (a->kind = w->first_kind; a->kind < w->end_kind && !w->status; a->kind++) {
        a->out = &w->answers[a->kind];
        memset(a->found, 0, sizeof a->found), memset(a->counts, 0, sizeof a->counts);
        w->own = ask(a);
        if (!w->own) note(a);
        w->diag = a->diag;
        w->status = agree(&w->member, w->own, &a->diag);
    }
    if (w->memory) w->calls = w->memory->calls;
    froe_shards_close(a->shards);
    free(a);
    return NULL;
}

/* Lets threads ask questions of these kinds. `workers` have first, count and memory set. */
static void run_workers(office *o, worker *workers, int ranks, const questions *q, int first_kind, int end_kind) {
    pthread_t threads[RANKS];
    const office asked = *o;
    *o = (office){.ranks = ranks,
                  .spoils = asked.spoils,
                  .spoilt_trade = asked.spoilt_trade,
                  .kept = asked.kept,
                  .changes = asked.changes,
                  .word = asked.word};
    pthread_mutex_init(&o->lock, NULL), pthread_cond_init(&o->turn, NULL);
    for (int r = 0; r < ranks; r++) {
        workers[r].member = (member){o, r};
        workers[r].q = q, workers[r].first_kind = first_kind, workers[r].end_kind = end_kind;
        if (!workers[r].alloc.fn) workers[r].alloc = support_allocator(NULL);
        for (int k = 0; k <= ALL; k++) workers[r].answers[k].alloc = support_allocator(NULL);
        assert_int_equal(pthread_create(&threads[r], NULL, work, &workers[r]), 0);
    }
    for (int r = 0; r < ranks; r++) pthread_join(threads[r], NULL);
    pthread_mutex_destroy(&o->lock), pthread_cond_destroy(&o->turn);
}

static void free_answers(worker *workers, int ranks) {
    for (int r = 0; r < ranks; r++)
        for (int k = 0; k <= ALL; k++) array_free(&workers[r].answers[k].alloc, &workers[r].answers[k].words);
}

static void build_shared(int dim, uint32_t shards, uint64_t seed) {
    one_object *list = lattice_objects(dim, FROE_KIND_COUNT, COUNT, MOST, seed);
    froe_shards_options o = froe_shards_defaults();
    o.shards = shards;
    assert_int_equal(build_folder("shared.froes", dim, list, COUNT, &o, NULL, NULL), FROE_OK);
    free(list);
}

/* The answers of one alone, then those of 2 to 4, to questions dealt to them in several ways. */
static void compare_numbers_of_threads(int dim, uint32_t shards, uint64_t seed) {
    questions *q = calloc(1, sizeof *q);
    office o = {.spoils = false};
    worker alone = {.count = QUESTIONS};
    assert_non_null(q);
    make_questions(q, dim, seed);
    build_shared(dim, shards, seed);
    run_workers(&o, &alone, 1, q, 0, ALL);
    assert_int_equal(alone.status, FROE_OK);
    for (int ranks = 2; ranks <= RANKS; ranks++)
        for (int uneven = 0; uneven < 2; uneven++) { /* one of them has all questions, and the others have none */
            worker workers[RANKS] = {0};
            for (int r = 0; r < ranks; r++) {
                workers[r].first = uneven ? 0 : (size_t)(QUESTIONS * r / ranks);
                workers[r].count =
                    uneven ? (r == 1 ? QUESTIONS : 0) : (size_t)(QUESTIONS * (r + 1) / ranks) - workers[r].first;
            }
            run_workers(&o, workers, ranks, q, 0, ALL);
            assert_true(o.foreign > 0);
            for (int k = 0; k < ALL; k++) {
                size_t at = 0;
                for (int r = 0; r < ranks; r++) {
                    const size_t count = workers[r].answers[k].words.count;
                    assert_int_equal(workers[r].status, FROE_OK);
                    assert_true(at + count <= alone.answers[k].words.count);
                    if (count)
                        assert_memory_equal(workers[r].answers[k].words.data, alone.answers[k].words.data + at,
                                            count * sizeof(uint64_t));
                    at += count;
                }
                assert_int_equal(at, alone.answers[k].words.count);
                assert_true(at >= QUESTIONS);
            }
            free_answers(workers, ranks);
        }
    free_answers(&alone, 1);
    free(q);
}

static void threads_get_the_answers_of_one(void **state) {
    (void)state;
    compare_numbers_of_threads(2, 7, 1);
    compare_numbers_of_threads(2, 64, 2);
    compare_numbers_of_threads(2, 2, 3); /* fewer shards than threads */
    compare_numbers_of_threads(3, 13, 4);
    compare_numbers_of_threads(5, 7, 5);
}

/* Has a thread the answers to questions of a kind that one alone gets? */
static void expect_answers_of_one(const worker *w, int kind) {
    office o = {.spoils = false};
    worker alone = {.first = w->first, .count = w->count};
    run_workers(&o, &alone, 1, w->q, kind, kind + 1);
    assert_int_equal(alone.status, FROE_OK);
    assert_int_equal(w->answers[kind].words.count, alone.answers[kind].words.count);
    assert_memory_equal(w->answers[kind].words.data, alone.answers[kind].words.data,
                        alone.answers[kind].words.count * sizeof(uint64_t));
    free_answers(&alone, 1);
}

/* A bad question is the failure of the thread that has it, and the others get their answers. */
static void a_bad_question_is_one_of_its_own_thread(void **state) {
    (void)state;
    questions *q = calloc(1, sizeof *q);
    office o = {.spoils = false};
    assert_non_null(q);
    make_questions(q, 2, 6);
    build_shared(2, 7, 6);
    q->directions[2 * 70] = q->directions[2 * 70 + 1] = 0; /* of thread 1 of 3, its 31st and 36th questions */
    q->directions[2 * 75] = q->directions[2 * 75 + 1] = 0;
    q->points[2 * 70] = NAN, q->boxes[4 * 70] = INFINITY, q->boxes[4 * 70 + 2] = 0;
    for (int k = 0; k < ALL; k++) {
        if (k != BOXES && k != LOCATE && k != NEAR && k != NEAR + 2 && k != ABOVE && k < RAY) continue;
        worker workers[3] = {{.first = 0, .count = 40}, {.first = 40, .count = 40}, {.first = 80, .count = 40}};
        run_workers(&o, workers, 3, q, k, k + 1);
        for (int r = 0; r < 3; r++) {
            assert_int_equal(workers[r].status, FROE_E_INPUT);
            assert_int_equal(workers[r].own, r == 1 ? FROE_E_INPUT : FROE_OK);
            if (r != 1) expect_answers_of_one(&workers[r], k);
        }
        assert_int_equal(workers[1].diag.object, 30);
        free_answers(workers, 3);
    }
    free(q);
}

/* One thread has no memory, at each of its allocations in turn: all stop, none waits for ever, and nothing leaks. */
static void memory_is_refused_to_one(void **state) {
    (void)state;
    questions *q = calloc(1, sizeof *q);
    office o = {.spoils = false};
    assert_non_null(q);
    make_questions(q, 2, 7);
    build_shared(2, 7, 7);
    static const int kinds[] = {BOXES, RANGES, ABOVE, NEAR + 1, RAY_ALL, COUNT_LOCATE, COUNT_NEAR + 1};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        size_t calls = 1;
        for (size_t fail_at = 0; fail_at <= calls; fail_at += fail_at < 60 ? 1 : 7) {
            test_memory memory;
            worker workers[3] = {{.first = 0, .count = 12}, {.first = 12, .count = 12}, {.first = 24, .count = 12}};
            workers[1].alloc = test_memory_begin(&memory);
            workers[1].memory = &memory, workers[1].fail_at = fail_at;
            run_workers(&o, workers, 3, q, kinds[k], kinds[k] + 1);
            test_memory_end(&memory);
            for (int r = 0; r < 3; r++) assert_true(workers[r].status == FROE_E_MEMORY || workers[r].status == FROE_OK);
            assert_int_equal(workers[0].status, workers[1].status);
            assert_int_equal(workers[2].status, workers[1].status);
            if (!fail_at) {
                assert_int_equal(workers[1].status, FROE_OK);
                calls = workers[1].calls;
                assert_true(calls > 20);
            }
            free_answers(workers, 3);
        }
    }
    free(q);
}

/* Bytes that go to thread 0, which has all questions of a kind, from thread 1, which has none. */
static size_t bytes_of_answers(const questions *q, int kind) {
    office o = {.spoils = false};
    worker workers[2] = {{.count = QUESTIONS}, {.count = 0}};
    run_workers(&o, workers, 2, q, kind, kind + 1);
    for (int r = 0; r < 2; r++) assert_int_equal(workers[r].status, FROE_OK);
    free_answers(workers, 2);
    return o.foreign;
}

/* An answer takes 12 bytes, 20 with a value; a number of answers takes 4. */
static void numbers_of_answers_are_sent_without_the_answers(void **state) {
    (void)state;
    static const int pairs[][2] = {{RANGES, COUNTS},
                                   {ABOVE, COUNT_ABOVE},
                                   {NEAR + 2, COUNT_NEAR + 2},
                                   {RAY_ALL, COUNT_RAYS},
                                   {LOCATE, COUNT_LOCATE}};
    questions *q = calloc(1, sizeof *q);
    assert_non_null(q);
    make_questions(q, 2, 10);
    build_shared(2, 2, 10);
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        const size_t lists = bytes_of_answers(q, pairs[i][0]), counts = bytes_of_answers(q, pairs[i][1]);
        assert_true(counts > 0 && counts < QUESTIONS * 2 * sizeof(uint64_t));
        assert_true(counts < lists);
    }
    free(q);
}

/* A shard is asked once for the questions of all threads, which keeps its tree in the cache; once more where one of
 * them is bad. */
static void a_shard_is_asked_once_for_all(void **state) {
    (void)state;
    enum { SHARDS = 7 };
    questions *q = calloc(1, sizeof *q);
    assert_non_null(q);
    make_questions(q, 2, 11);
    build_shared(2, SHARDS, 11);
    for (int bad = 0; bad < 2; bad++) {
        office o = {.spoils = false};
        worker workers[3] = {{.first = 0, .count = 40}, {.first = 40, .count = 40}, {.first = 80, .count = 40}};
        atomic_store(&batches, 0);
        if (bad) q->points[2 * 60] = NAN;
        run_workers(&o, workers, 3, q, BATCHES, BATCHES + 1);
        assert_int_equal(atomic_load(&batches), SHARDS + bad);
        for (int r = 0; r < 3; r++) assert_int_equal(workers[r].own, bad && r == 1 ? FROE_E_INPUT : FROE_OK);
        free_answers(workers, 3);
    }
    free(q);
}

/* What another process sends is not believed: a range has as many points as have come. */
static void a_range_of_more_points_than_have_come_is_refused(void **state) {
    (void)state;
    questions *q = calloc(1, sizeof *q);
    assert_non_null(q);
    make_questions(q, 2, 9);
    build_shared(2, 2, 9);
    q->ranges[0].shape = FROE_SHAPE_HULL, q->ranges[0].count = 4;
    for (int i = 0; i < 8; i++) q->shapes[i] = i / 2 % 2 ? MOST : 0;
    q->shapes[5] = MOST;
    for (int spoils = 0; spoils < 2; spoils++) {
        office o = {.spoils = spoils};
        worker workers[2] = {{.count = 0}, {.count = 1}};
        run_workers(&o, workers, 2, q, RANGES, RANGES + 1);
        for (int r = 0; r < 2; r++) assert_int_equal(workers[r].status, spoils ? FROE_E_FORMAT : FROE_OK);
        if (spoils)
            assert_string_equal(workers[1].diag.message, "Words of another process have been cut off on their way.");
        free_answers(workers, 2);
    }
    free(q);
}

/* Asks questions of a kind while words are spoilt, and returns whether that trade has so many words. */
static bool is_spoilt(const questions *q, int kind, office o) {
    worker workers[2] = {{.first = 0, .count = 2}, {.first = 2, .count = 2}};
    run_workers(&o, workers, 2, q, kind, kind + 1);
    assert_int_equal(workers[0].status, workers[1].status);
    if (!o.spoilt) assert_int_equal(workers[0].status, FROE_OK);
    if (o.spoilt && !o.changes && workers[0].status != FROE_E_FORMAT)
        fail_msg("kind %d, trade %d, %zu words: status %d", kind, o.spoilt_trade, o.kept, (int)workers[0].status);
    if (workers[0].status == FROE_E_FORMAT)
        assert_non_null(
            strstr(workers[0].diag.message[0] ? workers[0].diag.message : workers[1].diag.message, "process"));
    free_answers(workers, 2);
    return o.spoilt;
}

/* Words that are lost are noticed wherever that happens; others instead of them end in a status. Behind the first
 * trade the first word stays: without that of the last round a process cannot tell that there is no other, and a
 * function that exchanges bytes must not lose it (froe_shards_trade_fn). */
static void words_that_are_spoilt_are_refused(void **state) {
    (void)state;
    questions *q = calloc(1, sizeof *q);
    static const int kinds[] = {RANGES, ABOVE, NEAR + 1, RAY_ALL, COUNT_LOCATE};
    assert_non_null(q);
    make_questions(q, 2, 9);
    build_shared(2, 4, 9);
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        for (int number = 1; number <= 3; number++) {
            bool spoilt = true;
            for (size_t kept = number > 1; kept < 16 && spoilt; kept++)
                spoilt = is_spoilt(q, kinds[k], (office){.spoilt_trade = number, .kept = kept});
            for (size_t at = 1; at < 8; at++)
                (void)is_spoilt(
                    q, kinds[k],
                    (office){.spoilt_trade = number, .kept = at, .changes = true, .word = UINT64_MAX >> at});
        }
    free(q);
}

static void every_shard_has_an_owner_and_every_turn_begins_with_the_next(void **state) {
    (void)state;
    enum { SHARDS = 4096 };
    static const uint32_t first[] = {0, 1, 2, 1, 2, 0, 2, 0, 1, 0};
    for (uint32_t s = 0; s < 10; s++) assert_int_equal(froe_shard_owner(s, 3), first[s]);
    for (uint32_t count = 1; count < 40; count++) {
        uint32_t found = 0;
        for (uint32_t process = 0; process < count; process++)
            for (uint32_t turn = 0, s; (s = froe_shard_of_turn(process, count, turn)) < SHARDS; turn++) {
                assert_int_equal(froe_shard_owner(s, count), process);
                assert_int_equal(s / count, turn);
                found++;
            }
        assert_int_equal(found, SHARDS);
    }
    assert_int_equal(froe_shard_of_turn(3, 3, 0), FROE_NONE);
    assert_int_equal(froe_shard_of_turn(0, 0, 0), FROE_NONE);
    assert_int_equal(froe_shard_of_turn(0, 2, UINT32_MAX), FROE_NONE);
    assert_int_equal(froe_shard_owner(1, 0), 0);
    assert_int_equal(froe_shard_owner(UINT32_MAX, UINT32_MAX), 1);
}

static void what_is_no_process_is_refused(void **state) {
    (void)state;
    froe_shards *shards;
    froe_diagnostic diag;
    build_shared(2, 2, 8);
    assert_int_equal(froe_shards_open("shared.froes", NULL, &shards, NULL), FROE_OK);
    assert_int_equal(froe_shards_share(shards, 3, 3, trade, NULL, &diag), FROE_E_ARG);
    assert_string_equal(diag.message, "There is no process 3 of 3.");
    assert_int_equal(froe_shards_share(shards, 0, 1, NULL, NULL, &diag), FROE_E_ARG);
    assert_int_equal(froe_shards_share(NULL, 0, 1, trade, NULL, &diag), FROE_E_ARG);
    assert_int_equal(froe_shards_share(shards, 0, 1, trade, NULL, &diag), FROE_OK);
    froe_shards_close(shards);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_get_the_answers_of_one),
        cmocka_unit_test(a_bad_question_is_one_of_its_own_thread),
        cmocka_unit_test(memory_is_refused_to_one),
        cmocka_unit_test(numbers_of_answers_are_sent_without_the_answers),
        cmocka_unit_test(a_shard_is_asked_once_for_all),
        cmocka_unit_test(a_range_of_more_points_than_have_come_is_refused),
        cmocka_unit_test(words_that_are_spoilt_are_refused),
        cmocka_unit_test(every_shard_has_an_owner_and_every_turn_begins_with_the_next),
        cmocka_unit_test(what_is_no_process_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
