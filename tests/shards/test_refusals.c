/* test_refusals.c: every step of building a folder of shards, and every question to one, with arguments that
 * are none: FROE_E_ARG or another status with a sentence, and nothing is changed. */
#include "folders.h"
#include <math.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "support/refusals.h" /* last: others have variables called `why` */

static froe_status take_none(void *user, const void *records, size_t count) {
    (void)user, (void)records, (void)count;
    return FROE_OK;
}

static void batches_are_checked(void **state) {
    (void)state;
    static const double corners[] = {0, 0, 1, 1, 2, 2};
    static const uint32_t indices[] = {0, 2};
    froe_shard_records records = {0};
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_SEGMENT, batch.count = 1, batch.coords = corners;
    NULLS(froe_shard_records_add(NULL, 2, &batch, 0, &why));
    NULLS(froe_shard_records_add(&records, 2, NULL, 0, &why));
    expect(froe_shard_records_add(&records, 1, &batch, 0, &why), FROE_E_ARG, "dimension 1 is not");
    expect(froe_shard_records_add(&records, 9, &batch, 0, &why), FROE_E_ARG, "dimension 9 is not");
    batch.size = 1;
    expect(froe_shard_records_add(&records, 2, &batch, 0, &why), FROE_E_OPTIONS, "froe_objects_defaults");
    batch.size = froe_objects_defaults().size, batch.coords = NULL;
    assert_int_not_equal(froe_shard_records_add(&records, 2, &batch, 0, NULL), FROE_OK);
    batch.kind = FROE_BALL, batch.coords = corners;
    static const double radii[] = {-1, NAN};
    for (int i = 0; i < 3; i++) {
        batch.radii = i < 2 ? radii + i : NULL;
        assert_int_not_equal(froe_shard_records_add(&records, 2, &batch, 0, NULL), FROE_OK);
    }
    NULLS(froe_shard_records_append(NULL, corners, 8, &why));
    NULLS(froe_shard_records_append(&records, NULL, 8, &why));
    assert_int_equal(records.count, 0);
    batch.kind = FROE_SEGMENT, batch.radii = NULL, batch.count = 0;
    assert_int_equal(froe_shard_records_add(&records, 2, &batch, 0, &why), FROE_OK); /* none is no failure */
    assert_int_equal(records.count, 0);
    batch.count = 1;
    /* The same object by indices and without. */
    froe_shard_records plain = {0};
    const double ends[] = {0, 0, 2, 2};
    batch.kind = FROE_SEGMENT, batch.radii = NULL, batch.indices = indices, batch.point_count = 3;
    assert_int_equal(froe_shard_records_add(&records, 2, &batch, 7, &why), FROE_OK);
    batch.indices = NULL, batch.point_count = 0, batch.coords = ends;
    assert_int_equal(froe_shard_records_add(&plain, 2, &batch, 7, &why), FROE_OK);
    assert_true(records.count == plain.count && !memcmp(records.bytes, plain.bytes, plain.count));
    assert_int_equal(froe_shard_records_append(&records, NULL, 0, &why), FROE_OK);
    for (int i = 0; i < 12; i++) { /* its own bytes, which move while it grows */
        assert_int_equal(froe_shard_records_append(&records, records.bytes, records.count, &why), FROE_OK);
        assert_memory_equal(records.bytes + records.count - plain.count, plain.bytes, plain.count);
    }
    assert_int_equal(records.count, plain.count << 12);
    froe_shard_records_free(&records), froe_shard_records_free(&plain), froe_shard_records_free(NULL);
}

static void samples_and_plans_are_checked(void **state) {
    (void)state;
    static const double corners[] = {0, 0, 0, 1, 1, 1};
    froe_shard_records records = {0};
    froe_shard_sample *sample, *other;
    froe_shard_plan *plan = NULL;
    froe_objects batch = froe_objects_defaults();
    size_t count;
    batch.kind = FROE_SEGMENT, batch.count = 1, batch.coords = corners;
    assert_int_equal(froe_shard_records_add(&records, 3, &batch, 0, &why), FROE_OK);
    assert_int_equal(froe_shard_sample_new(2, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_shard_sample_new(1, NULL, &sample), FROE_E_ARG);
    assert_int_equal(froe_shard_sample_new(9, NULL, &sample), FROE_E_ARG);
    assert_int_equal(froe_shard_sample_new(2, NULL, &sample), FROE_OK);
    assert_int_equal(froe_shard_sample_add(NULL, records.bytes, records.count), FROE_E_ARG);
    assert_int_equal(froe_shard_sample_add(sample, NULL, 8), FROE_E_ARG);
    assert_int_equal(froe_shard_sample_add(sample, records.bytes, records.count), FROE_E_ARG); /* of space */
    assert_int_equal(froe_shard_sample_add(sample, records.bytes, records.count - 8), FROE_E_ARG);
    assert_true(froe_shard_sample_bound(NULL, 1) == UINT64_MAX && froe_shard_sample_bound(sample, 0) == UINT64_MAX);
    froe_shard_sample_cut(NULL, 0), froe_shard_sample_cut(sample, UINT64_MAX);
    assert_int_equal(froe_shard_sample_add(sample, NULL, 0), FROE_OK);
    assert_null(froe_shard_sample_words(NULL, &count));
    assert_null(froe_shard_sample_words(sample, NULL));
    assert_int_equal(froe_shard_sample_new(3, NULL, &other), FROE_OK);
    assert_int_equal(froe_shard_sample_add(other, records.bytes, records.count), FROE_OK);
    const uint64_t *words = froe_shard_sample_words(other, &count);
    assert_non_null(words);
    assert_int_equal(froe_shard_sample_merge(NULL, words, count), FROE_E_ARG);
    assert_int_equal(froe_shard_sample_merge(other, NULL, count), FROE_E_ARG);
    assert_int_equal(froe_shard_sample_merge(sample, words, count), FROE_E_ARG); /* of space */
    assert_int_equal(froe_shard_sample_merge(other, words, 1), FROE_E_ARG);
    assert_int_equal(froe_shard_sample_merge(other, words, count - 1), FROE_E_ARG);
    NULLS(froe_shard_plan_new(NULL, 1, 0, &plan, &why));
    NULLS(froe_shard_plan_new(sample, 1, 0, NULL, &why));
    expect(froe_shard_plan_new(sample, 5000, 0, &plan, &why), FROE_E_ARG, "at most 4096 shards");
    froe_shard_sample *heavy;
    static double many[3 * 3 * 5000];
    assert_int_equal(froe_shard_sample_new(3, NULL, &heavy), FROE_OK);
    for (size_t i = 0; i < sizeof many / sizeof *many; i++) many[i] = (double)(i * 37 % 101);
    froe_shard_records load = {0};
    batch.count = 5000, batch.coords = many;
    assert_int_equal(froe_shard_records_add(&load, 3, &batch, 0, &why), FROE_OK);
    assert_int_equal(froe_shard_sample_add(heavy, load.bytes, load.count), FROE_OK);
    expect(froe_shard_plan_new(heavy, 0, 3, &plan, &why), FROE_E_LIMIT, "A folder has at most 4096 shards");
    froe_shard_sample_free(heavy), froe_shard_records_free(&load);
    assert_int_equal(froe_shard_plan_count(NULL), 0);
    assert_int_equal(froe_shard_report(NULL, NULL).shards, 0);
    froe_shard_plan_free(NULL);
    froe_shard_sample_free(sample), froe_shard_sample_free(other), froe_shard_sample_free(NULL);
    froe_shard_records_free(&records);
}

/* Words of a sample that are cut off behind an item, that go on, or of which one has changed. */
static void samples_come_whole_or_are_refused(void **state) {
    (void)state;
    enum { HEAD = 3, WIDTH = 4 };
    static const double corners[] = {0, 0, 0, 1, 1, 1}, none[] = {NAN, INFINITY, -INFINITY};
    uint64_t more[HEAD + 2 * WIDTH];
    froe_shard_records records = {0};
    froe_shard_sample *sample, *other;
    froe_objects batch = froe_objects_defaults();
    size_t count;
    batch.kind = FROE_SEGMENT, batch.count = 1, batch.coords = corners;
    assert_int_equal(froe_shard_records_add(&records, 3, &batch, 0, &why), FROE_OK);
    assert_int_equal(froe_shard_sample_new(3, NULL, &sample), FROE_OK);
    assert_int_equal(froe_shard_sample_new(3, NULL, &other), FROE_OK);
    assert_int_equal(froe_shard_sample_add(sample, records.bytes, records.count), FROE_OK);
    const uint64_t *words = froe_shard_sample_words(sample, &count);
    assert_true(words && count == HEAD + WIDTH);
    assert_int_equal(froe_shard_sample_merge(other, words, HEAD), FROE_E_ARG);
    memcpy(more, words, count * sizeof *words);
    memcpy(more + count, words + HEAD, WIDTH * sizeof *words);
    assert_int_equal(froe_shard_sample_merge(other, more, HEAD + 2 * WIDTH), FROE_E_ARG);
    for (size_t i = 0; i < WIDTH; i++) {
        memcpy(more, words, count * sizeof *words);
        if (i) memcpy(more + HEAD + i, none + i - 1, sizeof *none);
        if (!i) more[1] = 0; /* objects, fewer than items */
        assert_int_equal(froe_shard_sample_merge(other, more, count), FROE_E_ARG);
    }
    assert_int_equal(froe_shard_sample_merge(other, words, count), FROE_OK);
    words = froe_shard_sample_words(other, &count); /* nothing else was added */
    assert_true(words && count == HEAD + WIDTH && words[1] == 1);
    froe_shard_sample_free(sample), froe_shard_sample_free(other), froe_shard_records_free(&records);
}

static void shards_are_checked(void **state) {
    (void)state;
    static const double corners[] = {0, 0, 1, 1};
    froe_shard_records records = {0};
    froe_shard_sample *sample;
    froe_shard_plan *plan;
    froe_shard_entry entry;
    const froe_shards_options good = froe_shards_defaults();
    froe_shards_options o = good;
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_SEGMENT, batch.count = 1, batch.coords = corners;
    assert_int_equal(froe_shard_records_add(&records, 2, &batch, 0, &why), FROE_OK);
    assert_int_equal(froe_shard_sample_new(2, NULL, &sample), FROE_OK);
    assert_int_equal(froe_shard_sample_add(sample, records.bytes, records.count), FROE_OK);
    assert_int_equal(froe_shard_plan_new(sample, 1, 0, &plan, &why), FROE_OK);
    NULLS(froe_shard_build(NULL, plan, 0, NULL, &o, ".", &entry, &why));
    NULLS(froe_shard_build(&records, NULL, 0, NULL, &o, ".", &entry, &why));
    NULLS(froe_shard_build(&records, plan, 0, NULL, NULL, ".", &entry, &why));
    NULLS(froe_shard_build(&records, plan, 0, NULL, &o, NULL, &entry, &why));
    NULLS(froe_shard_build(&records, plan, 0, NULL, &o, ".", NULL, &why));
    expect(froe_shard_build(&records, plan, 1, NULL, &o, ".", &entry, &why), FROE_E_ARG, "There is no shard 1.");
    o.size = 1;
    expect(froe_shard_build(&records, plan, 0, NULL, &o, ".", &entry, &why), FROE_E_OPTIONS, "froe_shards_defaults");
    expect(froe_shard_build(&records, plan, 0, NULL, &good, "absent", &entry, &why), FROE_E_IO,
           "absent/shard-0000.froe");
    NULLS(froe_shard_manifest_write(plan, NULL, ".", NULL, &why));
    NULLS(froe_shard_manifest_write(plan, &entry, NULL, NULL, &why));
    assert_int_equal(froe_shard_report(plan, NULL).shards, 0);
    froe_shard_plan_free(plan), froe_shard_sample_free(sample);
    /* Objects of groups, and no scene that has them. */
    static const uint32_t groups[] = {3}, faces[] = {7};
    for (int i = 0; i < 3; i++) {
        froe_shard_records of_groups = {0};
        batch.groups = i == 0 ? groups : NULL, batch.faces = i == 1 ? faces : NULL,
        batch.group = i == 2 ? 3 : FROE_NONE;
        assert_int_equal(froe_shard_records_add(&of_groups, 2, &batch, 0, &why), FROE_OK);
        assert_int_equal(froe_shard_sample_new(2, NULL, &sample), FROE_OK);
        assert_int_equal(froe_shard_sample_add(sample, of_groups.bytes, of_groups.count), FROE_OK);
        assert_int_equal(froe_shard_plan_new(sample, 1, 0, &plan, &why), FROE_OK);
        if (i == 1)
            assert_int_equal(froe_shard_build(&of_groups, plan, 0, NULL, &good, ".", &entry, &why), FROE_OK);
        else
            expect(froe_shard_build(&of_groups, plan, 0, NULL, &good, ".", &entry, &why), FROE_E_UNSUPPORTED,
                   "Objects have groups, and there is no scene that has them.");
        froe_shard_plan_free(plan), froe_shard_sample_free(sample), froe_shard_records_free(&of_groups);
    }
    froe_shard_records_free(&records);
}

static const double three[] = {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5}; /* segments */

/* Their records, with the sample and the plan of two cells that are made of them. */
static void make_three(froe_shard_records *records, froe_shard_sample **sample, froe_shard_plan **plan) {
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_SEGMENT, batch.count = 3, batch.coords = three;
    assert_int_equal(froe_shard_records_add(records, 2, &batch, 0, &why), FROE_OK);
    assert_int_equal(froe_shard_sample_new(2, NULL, sample), FROE_OK);
    assert_int_equal(froe_shard_sample_add(*sample, records->bytes, records->count), FROE_OK);
    assert_int_equal(froe_shard_plan_new(*sample, 2, 0, plan, &why), FROE_OK);
}

/* Records that are changed on their way: each step that reads them says so, and reads nothing behind them. */
static void what_is_no_record_is_refused(void **state) {
    (void)state;
    enum { WORDS = 0, KIND = 4, DIM, SOURCED, UNUSED, SIZE = 48, ALL = 3 * SIZE };
    static const struct {
        int at;
        unsigned char byte;
    } changes[] = {{WORDS, 0}, {WORDS, 1}, {WORDS, 2},   {WORDS, 5},   {WORDS, 7}, {WORDS + 3, 255}, {KIND, 0},
                   {KIND, 2},  {KIND, 4},  {KIND, 6},    {KIND, 255},  {DIM, 0},   {DIM, 1},         {DIM, 3},
                   {DIM, 9},   {DIM, 255}, {SOURCED, 1}, {SOURCED, 2}, {UNUSED, 1}};
    const froe_shards_options good = froe_shards_defaults();
    froe_shard_records records = {0};
    froe_shard_sample *sample;
    froe_shard_plan *plan;
    froe_shard_entry entry;
    make_three(&records, &sample, &plan);
    assert_int_equal(records.count, ALL);
    assert_int_equal(froe_shard_plan_count(plan), 2);
    for (size_t i = 0; i <= sizeof changes / sizeof *changes; i++) /* and at last one that is cut off */
        for (size_t r = 0; r < 3; r++) {
            const bool cut = i == sizeof changes / sizeof *changes;
            froe_shard_records bad = {0};
            froe_shard_buckets *buckets;
            assert_int_equal(froe_shard_records_append(&bad, records.bytes, cut ? SIZE * r + 40 : ALL, &why), FROE_OK);
            if (!cut) bad.bytes[SIZE * r + (size_t)changes[i].at] = changes[i].byte;
            assert_int_equal(froe_shard_record_size(bad.bytes + SIZE * r, bad.count - SIZE * r), 0);
            assert_int_equal(froe_shard_sample_add(sample, bad.bytes, bad.count), FROE_E_ARG);
            assert_int_equal(froe_shard_buckets_new(".", 1, NULL, &buckets, &why), FROE_OK);
            assert_int_equal(froe_shard_buckets_add(buckets, 0, bad.bytes, bad.count, &why), FROE_OK);
            expect(froe_shard_buckets_take(buckets, 0, take_none, NULL, &why), FROE_E_FORMAT,
                   ".: Bucket 0 holds bytes that are no records.");
            froe_shard_buckets_free(buckets);
            expect(froe_shard_build(&bad, plan, 0, NULL, &good, ".", &entry, &why), FROE_E_ARG,
                   r == 0   ? "At byte 0 there is no whole record of an object of dimension 2."
                   : r == 1 ? "At byte 48 there is no whole record"
                            : "");
            froe_shard_records_free(&bad);
        }
    froe_shard_plan_free(plan), froe_shard_sample_free(sample), froe_shard_records_free(&records);
}

/* What is a record, and no object of this shard. */
static void what_is_no_object_of_a_shard_is_refused(void **state) {
    (void)state;
    enum { NUMBERS = 16, SIZE = 48 };
    static const double none[] = {NAN, INFINITY, -INFINITY};
    const froe_shards_options good = froe_shards_defaults();
    froe_shard_records records = {0};
    froe_shard_sample *sample;
    froe_shard_plan *plan;
    froe_shard_entry entry;
    make_three(&records, &sample, &plan);
    for (size_t i = 0; i < 3; i++) {
        memcpy(records.bytes + NUMBERS, none + i, sizeof *none);
        assert_int_equal(froe_shard_record_size(records.bytes, SIZE), SIZE);
        assert_int_equal(froe_shard_sample_add(sample, records.bytes, SIZE), FROE_E_ARG);
    }
    records.count = SIZE;
    expect(froe_shard_build(&records, plan, 0, NULL, &good, ".", &entry, &why), FROE_E_INPUT, "tag 0: corner 0 of seg");
    froe_shard_records_free(&records);
    /* An object of another cell. */
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_SEGMENT, batch.count = 1, batch.coords = three + 8;
    assert_int_equal(froe_shard_records_add(&records, 2, &batch, 7, &why), FROE_OK);
    expect(froe_shard_build(&records, plan, 0, NULL, &good, ".", &entry, &why), FROE_E_ARG,
           "tag 7: The object does not meet the cell of shard 0.");
    froe_shard_records_free(&records);
    /* A group that the scene has not. */
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    batch.group = FROE_NONE - 1, batch.coords = three;
    assert_int_equal(froe_shard_records_add(&records, 2, &batch, 7, &why), FROE_OK);
    expect(froe_shard_build(&records, plan, 0, scene, &good, ".", &entry, &why), FROE_E_INPUT,
           "tag 7: The scene has no group 4294967294.");
    froe_scene_free(scene);
    froe_shard_plan_free(plan), froe_shard_sample_free(sample), froe_shard_records_free(&records);
}

/* Options are refused before objects are read, and leave nothing. */
static void options_are_tried_at_the_beginning(void **state) {
    (void)state;
    static const struct {
        const char *method, *settings, *words;
        uint32_t leaf;
    } cases[] = {{"nonsense", NULL, "There is no method 'nonsense'.", FROE_LEAF_OWN},
                 {"kd", "nonsense=3", "Method 'kd' has no option 'nonsense'.", FROE_LEAF_OWN},
                 {"density", "guards=many", "option 'guards=many'", FROE_LEAF_OWN},
                 {"auto", NULL, "A leaf capacity of 2147483648 is above", UINT32_C(1) << 31},
                 {NULL, NULL, "A leaf capacity of 4294967294 is above", FROE_LEAF_OWN - 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_shards_options o = froe_shards_defaults();
        froe_shards_builder *builder = NULL;
        o.method = cases[i].method, o.settings = cases[i].settings, o.leaf = cases[i].leaf;
        expect(froe_shards_begin("options.froes", 3, &o, &builder, &why), FROE_E_OPTIONS, cases[i].words);
        assert_null(builder);
        assert_int_equal(access(".options.froes.building", F_OK), -1);
    }
    /* What depends on objects is no refusal yet: methods of other kinds, and leaves. */
    for (size_t i = 0; froe_method_at(i); i++)
        for (int dim = 2; dim <= 4; dim++) {
            froe_shards_options o = froe_shards_defaults();
            froe_shards_builder *builder;
            o.method = froe_method_at(i)->name, o.leaf = 0;
            assert_int_equal(froe_shards_begin("options.froes", dim, &o, &builder, &why), FROE_OK);
            froe_shards_abandon(builder);
        }
}

/* A disk that is full for a time: the batch of which a part was kept must not be in a folder, and neither what comes
 * behind it. */
static void a_batch_that_failed_is_in_no_folder(void **state) {
    (void)state;
    enum { MANY = 60000 };
    struct rlimit limit;
    double *corners = calloc(4 * MANY, sizeof *corners);
    froe_shards_builder *builder;
    froe_scene *scene;
    assert_non_null(corners);
    assert_int_equal(system("rm -rf full.froes"), 0); /* of an earlier run */
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_SEGMENT, batch.count = MANY, batch.coords = corners;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &batch, &why), FROE_OK);
    signal(SIGXFSZ, SIG_IGN);
    for (int of_scene = 0; of_scene < 2; of_scene++) {
        const struct rlimit few = {1 << 20, limit.rlim_max};
        assert_int_equal(froe_shards_begin("full.froes", 2, NULL, &builder, &why), FROE_OK);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &few), 0);
        const froe_status status =
            of_scene ? froe_shards_add_scene(builder, scene, &why) : froe_shards_add(builder, &batch, &why);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
        expect(status, FROE_E_IO, "cannot be written: File too large");
        expect(froe_shards_add(builder, &batch, &why), FROE_E_IO, "Objects that were added before");
        expect(froe_shards_add_scene(builder, scene, &why), FROE_E_IO, "Objects that were added before");
        expect(froe_shards_finish(builder, NULL, &why), FROE_E_IO, "Objects that were added before");
        assert_int_equal(access("full.froes", F_OK), -1);
    }
    signal(SIGXFSZ, SIG_DFL);
    /* What is made of a scene takes no batch, nor another scene. */
    froe_scene *empty;
    assert_int_equal(froe_scene_new(2, NULL, &empty), FROE_OK);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(froe_shards_begin("full.froes", 2, NULL, &builder, &why), FROE_OK);
        assert_int_equal(froe_shards_add_scene(builder, i ? empty : scene, &why), FROE_OK);
        expect(froe_shards_add(builder, &batch, &why), FROE_E_ARG, "A scene is all that this folder is made of.");
        expect(froe_shards_add_scene(builder, scene, &why), FROE_E_ARG, "A scene is all");
        froe_shards_abandon(builder);
    }
    froe_scene_free(scene), froe_scene_free(empty), free(corners);
}

/* A disk that is full at once, and one that is full within the first block. */
static void buckets_on_a_full_disk_are_told(void **state) {
    (void)state;
    struct rlimit limit;
    static char bytes[1 << 20];
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    signal(SIGXFSZ, SIG_IGN);
    for (rlim_t most = 0; most < 2000; most += 1000) {
        const struct rlimit few = {most, limit.rlim_max};
        froe_shard_buckets *buckets;
        assert_int_equal(froe_shard_buckets_new(".", 2, NULL, &buckets, &why), FROE_OK);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &few), 0);
        froe_status status = FROE_OK;
        for (int i = 0; i < 64 && !status; i++) status = froe_shard_buckets_add(buckets, 0, bytes, sizeof bytes, &why);
        assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
        expect(status, FROE_E_IO, "cannot be written: File too large");
        froe_shard_buckets_free(buckets);
    }
    signal(SIGXFSZ, SIG_DFL);
}

static void buckets_are_checked(void **state) {
    (void)state;
    static const double corners[] = {0, 0, 1, 1};
    froe_shard_buckets *buckets;
    NULLS(froe_shard_buckets_new(NULL, 1, NULL, &buckets, &why));
    NULLS(froe_shard_buckets_new(".", 1, NULL, NULL, &why));
    expect(froe_shard_buckets_new(".", 0, NULL, &buckets, &why), FROE_E_ARG, "Buckets are 1 to");
    expect(froe_shard_buckets_new(".", 5000, NULL, &buckets, &why), FROE_E_ARG, "Buckets are 1 to");
    expect(froe_shard_buckets_new("absent", 1, NULL, &buckets, &why), FROE_E_IO, "absent: ");
    assert_int_equal(froe_shard_buckets_new(".", 1, NULL, &buckets, &why), FROE_OK);
    NULLS(froe_shard_buckets_add(NULL, 0, corners, 8, &why));
    NULLS(froe_shard_buckets_add(buckets, 0, NULL, 8, &why));
    assert_int_equal(froe_shard_buckets_add(buckets, 0, NULL, 0, &why), FROE_OK);
    expect(froe_shard_buckets_add(buckets, 1, corners, 8, &why), FROE_E_ARG, "no bucket 1");
    NULLS(froe_shard_buckets_take(NULL, 0, take_none, NULL, &why));
    NULLS(froe_shard_buckets_take(buckets, 0, NULL, NULL, &why));
    expect(froe_shard_buckets_take(buckets, 1, take_none, NULL, &why), FROE_E_ARG, "no bucket 1");
    froe_shard_buckets_free(buckets), froe_shard_buckets_free(NULL);
}

static void drafts_are_checked(void **state) {
    (void)state;
    froe_shard_draft *draft;
    bool replaced;
    NULLS(froe_shard_draft_begin(NULL, NULL, &draft, &why));
    NULLS(froe_shard_draft_begin("d.froes", NULL, NULL, &why));
    NULLS(froe_shard_draft_sync(NULL, 0, 1, &why));
    NULLS(froe_shard_draft_sync(".", 0, 0, &why));
    NULLS(froe_shard_draft_place(NULL, &replaced, &why));
    froe_shard_draft_clear(NULL, 0, 1), froe_shard_draft_clear(".", 0, 0);
    assert_null(froe_shard_draft_folder(NULL));
    assert_int_equal(froe_shard_draft_end(NULL, FROE_E_IO, &why), FROE_E_IO);
    static char far[5000];
    memset(far, 'a', sizeof far - 1);
    far[300] = 0; /* a name that no file has */
    const char *const places[] = {"", "absent/d.froes", "..", "absent/.", "absent/..", "file/d.froes", far, "a/.."};
    fclose(fopen("file", "w"));
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        expect(froe_shard_draft_begin(places[i], NULL, &draft, &why), FROE_E_IO, ": ");
    assert_int_equal(froe_shard_draft_begin("d.froes", NULL, &draft, &why), FROE_OK);
    NULLS(froe_shard_draft_place(draft, NULL, &why));
    assert_int_equal(froe_shard_draft_end(draft, FROE_E_IO, &why), FROE_E_IO);
    assert_true(access("d.froes", F_OK) && access(".d.froes.building", F_OK));
    far[300] = 'a';
    expect(froe_shard_draft_begin(far, NULL, &draft, &why), FROE_E_IO, "name too long");
}

static void builders_are_checked(void **state) {
    (void)state;
    static const double corners[] = {0, 0, 1, 1};
    froe_shards_builder *builder;
    NULLS(froe_shards_begin(NULL, 2, NULL, &builder, &why));
    NULLS(froe_shards_begin("d.froes", 2, NULL, NULL, &why));
    expect(froe_shards_begin("d.froes", 1, NULL, &builder, &why), FROE_E_ARG, "imension");
    expect(froe_shards_begin("d.froes", 9, NULL, &builder, &why), FROE_E_ARG, "imension");
    froe_shards_options o = froe_shards_defaults();
    o.shards = 5000;
    expect(froe_shards_begin("d.froes", 2, &o, &builder, &why), FROE_E_OPTIONS, "4096");
    o.size = 1;
    expect(froe_shards_begin("d.froes", 2, &o, &builder, &why), FROE_E_OPTIONS, "froe_shards_defaults");
    NULLS(froe_shards_finish(NULL, NULL, &why));
    froe_shards_abandon(NULL);
    assert_int_equal(froe_shards_begin("d.froes/", 2, NULL, &builder, &why), FROE_OK);
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_SEGMENT, batch.count = 1, batch.coords = corners;
    NULLS(froe_shards_add(NULL, &batch, &why));
    NULLS(froe_shards_add(builder, NULL, &why));
    const froe_objects none = {0};
    expect(froe_shards_add(builder, &none, &why), FROE_E_OPTIONS, "froe_objects_defaults");
    batch.group = 0;
    expect(froe_shards_add(builder, &batch, &why), FROE_E_UNSUPPORTED, "roups");
    static const uint32_t groups[] = {0};
    batch.group = FROE_NONE, batch.groups = groups;
    expect(froe_shards_add(builder, &batch, &why), FROE_E_UNSUPPORTED, "roups");
    froe_scene *space;
    assert_int_equal(froe_scene_new(3, NULL, &space), FROE_OK);
    NULLS(froe_shards_add_scene(builder, NULL, &why));
    NULLS(froe_shards_add_scene(NULL, space, &why));
    expect(froe_shards_add_scene(builder, space, &why), FROE_E_ARG, "of its dimension");
    froe_scene_free(space);
    expect(froe_shards_finish(builder, NULL, &why), FROE_E_INPUT, "no objects");
    assert_true(access("d.froes", F_OK) && access(".d.froes.building", F_OK));
}

static bool stop(void *user, double done) {
    (void)user, (void)done;
    return false;
}

typedef struct patience {
    int left, heard;
} patience;
static bool lose_patience(void *user, double done) {
    patience *p = user;
    (void)done;
    p->heard++;
    return p->left-- > 0;
}

/* A scene without groups, of objects of every kind with faces of their own, in two shards; cancelled at each report. */
static void scenes_become_folders_or_nothing(void **state) {
    (void)state;
    enum { OBJECTS = 60 };
    one_object *list = lattice_objects(2, FROE_KIND_COUNT, OBJECTS, 9, 6);
    froe_shards_options o = froe_shards_defaults();
    froe_shards_builder *builder;
    froe_shards *s;
    froe_scene *scene;
    patience p = {.left = 1000000};
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (uint32_t i = 0; i < OBJECTS; i++) {
        size_t starts[2];
        froe_objects batch = batch_of(list + i, starts);
        const uint32_t face = OBJECTS - i;
        batch.faces = &face;
        assert_int_equal(froe_scene_add(scene, &batch, &why), FROE_OK);
    }
    free(list);
    o.shards = 2, o.progress = lose_patience, o.user = &p;
    int reports = 1;
    for (int left = -1; left < reports; left++) {
        p = (patience){.left = left < 0 ? 1000000 : left};
        froe_status status = froe_shards_begin("scene.froes", 2, &o, &builder, &why);
        assert_int_equal(status, FROE_OK);
        status = froe_shards_add_scene(builder, scene, &why);
        if (!status && left < 0) expect(froe_shards_add_scene(builder, scene, &why), FROE_E_ARG, "A scene is all");
        if (status)
            froe_shards_abandon(builder);
        else
            status = froe_shards_finish(builder, NULL, &why);
        if (left >= 0) {
            expect(status, FROE_E_CANCELLED, "Cancelled");
            assert_int_equal(access(".scene.froes.building", F_OK), -1);
            continue;
        }
        assert_int_equal(status, FROE_OK);
        reports = p.heard;
        assert_true(reports > 2);
    }
    assert_int_equal(froe_shards_open("scene.froes", NULL, &s, &why), FROE_OK);
    assert_int_equal(froe_shards_check(s, NULL, &why), FROE_OK);
    froe_shards_close(s), froe_scene_free(scene);
}

/* As of the batches that are called alike, answers of no questions need no array. */
static void no_questions_need_no_room(void **state) {
    (void)state;
    static const double corners[] = {0, 0, 1, 1};
    froe_shards_builder *builder;
    froe_shards *s;
    froe_find find;
    uint64_t count;
    froe_range range = froe_range_defaults();
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_SEGMENT, batch.count = 1, batch.coords = range.points = corners;
    assert_int_equal(froe_shards_begin("one.froes", 2, NULL, &builder, &why), FROE_OK);
    assert_int_equal(froe_shards_add(builder, &batch, &why), FROE_OK);
    assert_int_equal(froe_shards_finish(builder, NULL, &why), FROE_OK);
    assert_int_equal(froe_shards_open("one.froes", NULL, &s, &why), FROE_OK);
    assert_int_equal(froe_shards_any(s, NULL, 0, NULL, NULL, &why), FROE_OK);
    assert_int_equal(froe_shards_vertical(s, NULL, 0, 1, NULL, NULL, &why), FROE_OK);
    assert_int_equal(froe_shards_ray(s, NULL, NULL, 0, 1, NULL, NULL, &why), FROE_OK);
    assert_int_equal(froe_shards_ray_any(s, NULL, NULL, 0, 1, NULL, NULL, &why), FROE_OK);
    assert_int_equal(froe_shards_count(s, NULL, 0, NULL, NULL, &why), FROE_OK);
    assert_int_equal(froe_shards_locate_count(s, NULL, 0, NULL, NULL, &why), FROE_OK);
    assert_int_equal(froe_shards_vertical_count(s, NULL, 0, 1, NULL, NULL, &why), FROE_OK);
    assert_int_equal(froe_shards_ray_count(s, NULL, NULL, 0, 1, NULL, NULL, &why), FROE_OK);
    assert_int_equal(froe_shards_near_count(s, NULL, 0, 1, 1, NULL, NULL, &why), FROE_OK);
    NULLS(froe_shards_any(s, &range, 1, NULL, NULL, &why));
    NULLS(froe_shards_any(s, NULL, 1, NULL, &find, &why));
    NULLS(froe_shards_count(s, &range, 1, NULL, NULL, &why));
    NULLS(froe_shards_count(NULL, &range, 1, NULL, &count, &why));
    froe_shards_close(s);
}

/* Triangles without starts, the last one without area, as a batch and as a scene: the same folder. */
static void triangles_need_no_starts(void **state) {
    (void)state;
    static const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 5, 5, 6, 5, 5, 5, 6, 5, 1, 1, 1, 2, 2, 2, 3, 3, 3};
    const froe_shards_options o = froe_shards_defaults();
    froe_shards_builder *builder;
    froe_scene *scene;
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_POLYGON, batch.count = 3, batch.coords = corners;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &batch, &why), FROE_OK);
    for (int from_scene = 0; from_scene < 2; from_scene++) {
        const char *path = from_scene ? "scene3.froes" : "batch3.froes";
        assert_int_equal(froe_shards_begin(path, 3, &o, &builder, &why), FROE_OK);
        assert_int_equal(
            from_scene ? froe_shards_add_scene(builder, scene, &why) : froe_shards_add(builder, &batch, &why), FROE_OK);
        assert_int_equal(froe_shards_finish(builder, NULL, &why), FROE_OK);
        froe_shards *s;
        assert_int_equal(froe_shards_open(path, NULL, &s, &why), FROE_OK);
        assert_int_equal(froe_shards_check(s, NULL, &why), FROE_OK);
        assert_int_equal(froe_shards_about(s).objects, 3);
        froe_shards_close(s);
    }
    froe_scene_free(scene);
}

static bool skip_pair(void *user, const froe_found_pair *pair) {
    (void)user, (void)pair;
    return false;
}

/* A folder by a plan for objects that are not all there: a shard without objects has no query. */
static void empty_shards_are_asked_nothing(void **state) {
    (void)state;
    enum { OBJECTS = 6 };
    static const double left[] = {0, 0, 0, 1}, right[] = {9, 0, 9, 1};
    const froe_shards_options o = froe_shards_defaults();
    froe_shard_records records = {0}, planned = {0};
    froe_shard_sample *sample;
    froe_shard_plan *plan;
    froe_shard_draft *draft;
    froe_shard_entry entries[2];
    froe_shards *s;
    froe_query *query;
    froe_finds finds = {0};
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_SEGMENT, batch.count = 1;
    for (uint64_t i = 0; i < OBJECTS; i++) {
        batch.coords = left;
        assert_int_equal(froe_shard_records_add(&records, 2, &batch, i, &why), FROE_OK);
        assert_int_equal(froe_shard_records_add(&planned, 2, &batch, i, &why), FROE_OK);
        batch.coords = right;
        assert_int_equal(froe_shard_records_add(&planned, 2, &batch, OBJECTS + i, &why), FROE_OK);
    }
    assert_int_equal(froe_shard_sample_new(2, NULL, &sample), FROE_OK);
    assert_int_equal(froe_shard_sample_add(sample, planned.bytes, planned.count), FROE_OK);
    assert_int_equal(froe_shard_plan_new(sample, 2, 0, &plan, &why), FROE_OK);
    assert_int_equal(froe_shard_plan_count(plan), 2);
    assert_int_equal(froe_shard_draft_begin("empty.froes", NULL, &draft, &why), FROE_OK);
    for (uint32_t i = 0; i < 2; i++) {
        assert_int_equal(
            froe_shard_build(&records, plan, i, NULL, &o, froe_shard_draft_folder(draft), entries + i, &why), FROE_OK);
        froe_shard_records_free(&records);
    }
    assert_int_equal(froe_shard_manifest_write(plan, entries, froe_shard_draft_folder(draft), NULL, &why), FROE_OK);
    assert_int_equal(froe_shard_draft_end(draft, FROE_OK, &why), FROE_OK);
    froe_shard_plan_free(plan), froe_shard_sample_free(sample), froe_shard_records_free(&planned);
    assert_int_equal(froe_shards_open("empty.froes", NULL, &s, &why), FROE_OK);
    uint32_t empty = 0;
    for (uint32_t i = 0; i < froe_shards_about(s).shards; i++) {
        const froe_tree *tree;
        assert_int_equal(froe_shards_tree(s, i, &tree, &why), FROE_OK);
        if (tree) continue;
        expect(froe_shards_query(s, i, &query, &why), FROE_E_ARG, "with objects.");
        empty++;
    }
    assert_int_equal(empty, 1);
    assert_int_equal(froe_shards_check(s, NULL, &why), FROE_OK);
    assert_int_equal(froe_shards_locate(s, (const double[]){0, 0.5}, 1, NULL, &finds, &why), FROE_OK);
    assert_int_equal(finds.starts[1], OBJECTS);
    froe_finds_free(&finds), froe_finds_free(&finds), froe_finds_free(NULL);
    assert_int_equal(froe_shards_pairs(s, true, NULL, skip_pair, NULL, &why), FROE_OK);
    froe_batch_options b = froe_batch_defaults();
    b.progress = stop;
    expect(froe_shards_check(s, &b, &why), FROE_E_CANCELLED, "Cancelled");
    b.progress = NULL;
    assert_int_equal(froe_shards_check(s, &b, &why), FROE_OK);
    froe_shards_close(s);
}

static void counts_groups_and_pairs_are_checked(froe_shards *s) {
    static const double x[] = {0, 0, 1, 1};
    froe_finds finds = {0};
    uint64_t count;
    NULLS(froe_shards_vertical_count(s, NULL, 1, 1, NULL, &count, &why));
    NULLS(froe_shards_ray_count(s, NULL, x, 1, INFINITY, NULL, &count, &why));
    NULLS(froe_shards_ray_count(s, x, NULL, 1, INFINITY, NULL, &count, &why));
    NULLS(froe_shards_near_count(s, NULL, 1, 1, INFINITY, NULL, &count, &why));
    NULLS(froe_shards_groups(s, NULL, 1, NULL, &finds, &why));
    NULLS(froe_shards_groups_range(s, NULL, 1, FROE_MEETS, NULL, &finds, &why));
    NULLS(froe_shards_pairs(NULL, true, NULL, skip_pair, NULL, &why));
    NULLS(froe_shards_pairs(s, true, NULL, NULL, NULL, &why));
}

/* Also without a place for the sentence. */
static void options_and_places_are_checked(froe_shards *s) {
    static const double x[] = {0, 0};
    froe_finds finds = {0};
    froe_batch_options b = froe_batch_defaults();
    b.size = 1;
    expect(froe_shards_near(s, x, 1, 1, INFINITY, &b, &finds, &why), FROE_E_OPTIONS, "froe_batch_defaults");
    expect(froe_shards_pairs(s, true, &b, skip_pair, NULL, &why), FROE_E_OPTIONS, "froe_batch_defaults");
    b = froe_batch_defaults(), b.progress = stop;
    expect(froe_shards_pairs(s, true, &b, skip_pair, NULL, &why), FROE_E_CANCELLED, "Cancelled");
    assert_int_equal(froe_shards_near(s, x, 1, 0, INFINITY, NULL, &finds, &why), FROE_OK); /* none of them */
    assert_int_equal(finds.starts[1], 0);
    froe_finds_free(&finds);
    static const double nowhere[] = {NAN, 0};
    expect(froe_shards_locate(s, nowhere, 1, NULL, &finds, &why), FROE_E_INPUT, "");
    assert_int_equal(froe_shards_locate(s, nowhere, 1, NULL, &finds, NULL), FROE_E_INPUT);
}

static void questions_are_checked(void **state) {
    (void)state;
    enum { OBJECTS = 20 };
    static const double x[] = {0, 0, 1, 1};
    one_object *list = lattice_objects(2, FROE_SEGMENT, OBJECTS, 9, 6);
    froe_shards_options o = froe_shards_defaults();
    froe_shards *s;
    froe_finds finds = {0};
    froe_find find;
    froe_query *query;
    uint64_t count;
    const froe_tree *tree;
    froe_range range = froe_range_defaults();
    o.shards = 3, range.points = x;
    assert_int_equal(build_folder("asked.froes", 2, list, OBJECTS, &o, NULL, &why), FROE_OK);
    free(list);
    assert_false(froe_is_shards(NULL));
    NULLS(froe_shards_open(NULL, NULL, &s, &why));
    NULLS(froe_shards_open("asked.froes", NULL, NULL, &why));
    assert_int_equal(froe_shards_open("asked.froes", NULL, &s, &why), FROE_OK);
    NULLS(froe_shards_range(NULL, &range, 1, NULL, &finds, &why));
    NULLS(froe_shards_range(s, NULL, 1, NULL, &finds, &why));
    NULLS(froe_shards_range(s, &range, 1, NULL, NULL, &why));
    NULLS(froe_shards_boxes(s, NULL, 1, NULL, &finds, &why));
    NULLS(froe_shards_any(s, NULL, 1, NULL, &find, &why));
    NULLS(froe_shards_count(s, &range, 1, NULL, NULL, &why));
    NULLS(froe_shards_locate(s, NULL, 1, NULL, &finds, &why));
    NULLS(froe_shards_vertical(s, NULL, 1, 1, NULL, &find, &why));
    NULLS(froe_shards_ray(s, x, NULL, 1, INFINITY, NULL, &find, &why));
    NULLS(froe_shards_ray_any(s, x, NULL, 1, INFINITY, NULL, &find, &why));
    NULLS(froe_shards_ray_all(s, x, NULL, 1, INFINITY, NULL, &finds, &why));
    NULLS(froe_shards_near(s, NULL, 1, 1, INFINITY, NULL, &finds, &why));
    NULLS(froe_shards_locate_count(s, x, 1, NULL, NULL, &why));
    assert_int_equal(froe_shards_locate_count(s, x, 0, NULL, &count, &why), FROE_OK);
    counts_groups_and_pairs_are_checked(s);
    NULLS(froe_shards_tree(NULL, 0, &tree, &why));
    NULLS(froe_shards_tree(s, 0, NULL, &why));
    expect(froe_shards_tree(s, 3, &tree, &why), FROE_E_ARG, "no shard 3");
    NULLS(froe_shards_query(NULL, 0, &query, &why));
    NULLS(froe_shards_query(s, 0, NULL, &why));
    expect(froe_shards_query(s, 3, &query, &why), FROE_E_ARG, "no shard 3");
    NULLS(froe_shards_check(NULL, NULL, &why));
    froe_batch_options b = froe_batch_defaults();
    b.progress = stop;
    expect(froe_shards_check(s, &b, &why), FROE_E_CANCELLED, "Cancelled");
    expect(froe_shards_range(s, &range, 1, &b, &finds, &why), FROE_E_CANCELLED, "Cancelled");
    b.size = 1;
    expect(froe_shards_check(s, &b, &why), FROE_E_OPTIONS, "froe_batch_defaults");
    expect(froe_shards_range(s, &range, 1, &b, &finds, &why), FROE_E_OPTIONS, "froe_batch_defaults");
    options_and_places_are_checked(s);
    NULLS(froe_shards_share(s, 0, 1, NULL, NULL, &why));
    NULLS(froe_shard_manifest_write(NULL, NULL, ".", NULL, &why));
    assert_int_equal(froe_shards_about(NULL).shards, 0);
    assert_int_equal(froe_shards_range(s, &range, 1, NULL, &finds, &why), FROE_OK); /* all the same */
    froe_finds_free(&finds);
    froe_shards_close(s), froe_shards_close(NULL);
}

/* Its files are opened by their names, so that the folder need not be listed. */
static void a_folder_that_cannot_be_listed_is_asked(void **state) {
    (void)state;
    one_object *list = lattice_objects(2, FROE_SEGMENT, 60, 5, 4);
    froe_shards *s = NULL;
    froe_shards_options o = froe_shards_defaults();
    o.shards = 3;
    const bool root = geteuid() == 0; /* who lists everything */
    assert_int_equal(build_folder("closed.froes", 2, list, 60, &o, NULL, NULL), FROE_OK);
    assert_int_equal(chmod("closed.froes", 0711), 0);
    if (root) assert_int_equal(seteuid(65534), 0);
    const bool is = froe_is_shards("closed.froes");
    const froe_status opened = froe_shards_open("closed.froes", NULL, &s, NULL);
    const froe_status checked = opened ? opened : froe_shards_check(s, NULL, NULL);
    if (root) assert_int_equal(seteuid(0), 0);
    assert_true(is);
    assert_int_equal(checked, FROE_OK);
    froe_shards_close(s);
    free(list);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(batches_are_checked),
        cmocka_unit_test(samples_and_plans_are_checked),
        cmocka_unit_test(buckets_are_checked),
        cmocka_unit_test(drafts_are_checked),
        cmocka_unit_test(builders_are_checked),
        cmocka_unit_test(questions_are_checked),
        cmocka_unit_test(shards_are_checked),
        cmocka_unit_test(samples_come_whole_or_are_refused),
        cmocka_unit_test(what_is_no_record_is_refused),
        cmocka_unit_test(what_is_no_object_of_a_shard_is_refused),
        cmocka_unit_test(options_are_tried_at_the_beginning),
        cmocka_unit_test(a_batch_that_failed_is_in_no_folder),
        cmocka_unit_test(buckets_on_a_full_disk_are_told),
        cmocka_unit_test(empty_shards_are_asked_nothing),
        cmocka_unit_test(a_folder_that_cannot_be_listed_is_asked),
        cmocka_unit_test(scenes_become_folders_or_nothing),
        cmocka_unit_test(no_questions_need_no_room),
        cmocka_unit_test(triangles_need_no_starts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
