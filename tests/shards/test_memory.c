/* test_memory.c: every question to a folder of shards, and the building of one, while any allocation fails, with sizes
 * that are checked where blocks are given back. */
#include "folders.h"
#include "shards/folder.h"
#include "shards/sample.h"
#include "support/memory.h"
#include <math.h>

enum { OBJECTS = 20, QUESTIONS = 3 };

static const double points[2 * QUESTIONS] = {1, 1, 4, 6, 7, 2}, ways[2 * QUESTIONS] = {1, 2, -1, 0, 0, -3};
static const double boxes[4 * QUESTIONS] = {0, 0, 3, 3, 2, 5, 9, 8, 6, 6, 6, 6};

static froe_range range_of(size_t i) {
    froe_range r = froe_range_defaults();
    r.points = boxes + 4 * i;
    return r;
}

typedef froe_status folder_question(froe_shards *s, const froe_batch_options *o);

#define FINDS(call)                                                                                                    \
    froe_finds found;                                                                                                  \
    const froe_status status = (call);                                                                                 \
    if (!status) froe_finds_free(&found);                                                                              \
    return status

static froe_status ask_range(froe_shards *s, const froe_batch_options *o) {
    const froe_range r[QUESTIONS] = {range_of(0), range_of(1), range_of(2)};
    FINDS(froe_shards_range(s, r, QUESTIONS, o, &found, NULL));
}
static froe_status ask_boxes(froe_shards *s, const froe_batch_options *o) {
    FINDS(froe_shards_boxes(s, boxes, QUESTIONS, o, &found, NULL));
}
static froe_status ask_count(froe_shards *s, const froe_batch_options *o) {
    const froe_range r[QUESTIONS] = {range_of(0), range_of(1), range_of(2)};
    uint64_t counts[QUESTIONS];
    return froe_shards_count(s, r, QUESTIONS, o, counts, NULL);
}
static froe_status ask_any(froe_shards *s, const froe_batch_options *o) {
    const froe_range r[QUESTIONS] = {range_of(0), range_of(1), range_of(2)};
    froe_find finds[QUESTIONS];
    return froe_shards_any(s, r, QUESTIONS, o, finds, NULL);
}
static froe_status ask_locate(froe_shards *s, const froe_batch_options *o) {
    FINDS(froe_shards_locate(s, points, QUESTIONS, o, &found, NULL));
}
static froe_status ask_vertical(froe_shards *s, const froe_batch_options *o) {
    froe_find finds[QUESTIONS];
    return froe_shards_vertical(s, points, QUESTIONS, 1, o, finds, NULL);
}
static froe_status ask_ray(froe_shards *s, const froe_batch_options *o) {
    froe_find finds[QUESTIONS];
    return froe_shards_ray(s, points, ways, QUESTIONS, INFINITY, o, finds, NULL);
}
static froe_status ask_ray_any(froe_shards *s, const froe_batch_options *o) {
    froe_find finds[QUESTIONS];
    return froe_shards_ray_any(s, points, ways, QUESTIONS, INFINITY, o, finds, NULL);
}
static froe_status ask_ray_all(froe_shards *s, const froe_batch_options *o) {
    FINDS(froe_shards_ray_all(s, points, ways, QUESTIONS, INFINITY, o, &found, NULL));
}
static froe_status ask_near(froe_shards *s, const froe_batch_options *o) {
    FINDS(froe_shards_near(s, points, QUESTIONS, 2, INFINITY, o, &found, NULL));
}

static froe_status ask_groups(froe_shards *s, const froe_batch_options *o) {
    FINDS(froe_shards_groups(s, points, QUESTIONS, o, &found, NULL));
}
static froe_status ask_groups_range(froe_shards *s, const froe_batch_options *o) {
    const froe_range r[QUESTIONS] = {range_of(0), range_of(1), range_of(2)};
    FINDS(froe_shards_groups_range(s, r, QUESTIONS, FROE_MEETS, o, &found, NULL));
}
static froe_status ask_near_count(froe_shards *s, const froe_batch_options *o) {
    uint64_t counts[QUESTIONS];
    return froe_shards_near_count(s, points, QUESTIONS, 2, INFINITY, o, counts, NULL);
}
static froe_status ask_locate_count(froe_shards *s, const froe_batch_options *o) {
    uint64_t counts[QUESTIONS];
    return froe_shards_locate_count(s, points, QUESTIONS, o, counts, NULL);
}

static folder_question *const questions[] = {
    ask_range,   ask_boxes,   ask_count, ask_any,    ask_locate,       ask_vertical,   ask_ray,
    ask_ray_any, ask_ray_all, ask_near,  ask_groups, ask_groups_range, ask_near_count, ask_locate_count};

static froe_status ask(void *user, const froe_allocator *alloc) {
    froe_shards *s;
    froe_batch_options o = froe_batch_defaults();
    o.threads = 1;
    froe_status status = froe_shards_open("folder.froes", alloc, &s, NULL);
    if (status) return status;
    status = questions[*(size_t *)user](s, &o);
    froe_shards_close(s);
    return status;
}

static void any_allocation_of_any_question_may_fail(void **state) {
    (void)state;
    one_object *list = lattice_objects(2, FROE_SEGMENT, OBJECTS, 9, 5);
    froe_shards_options o = froe_shards_defaults();
    froe_shards_report report;
    o.shards = 3;
    assert_int_equal(build_folder("folder.froes", 2, list, OBJECTS, &o, &report, NULL), FROE_OK);
    free(list);
    for (size_t i = 0; i < sizeof questions / sizeof *questions; i++) assert_true(test_memory_each(ask, &i) > 5);
}

/* A folder of whole objects of all kinds, or of a scene with groups, a system of coordinates and an axis that is up. */
static froe_status build_scene(const froe_allocator *alloc, froe_shards_options *o) {
    froe_scene *scene;
    froe_shards_builder *builder;
    froe_status status = froe_scene_new(2, NULL, &scene);
    one_object *list = lattice_objects(2, FROE_KIND_COUNT, OBJECTS, 9, 6);
    for (size_t i = 0; i < OBJECTS && !status; i++) {
        size_t starts[2];
        froe_objects batch = batch_of(list + i, starts);
        const froe_group group = {.name = "a", .colour = (uint32_t)i};
        if (i % 4) status = froe_scene_add_group(scene, &group, &batch.group);
        if (!status) status = froe_scene_add(scene, &batch, NULL);
    }
    const froe_crs crs = {.kind = FROE_CRS_GEOGRAPHIC, .name = "WGS 84"};
    if (!status) status = froe_scene_set_crs(scene, &crs);
    assert_int_equal(status, FROE_OK);
    o->alloc = alloc;
    status = froe_shards_begin("built.froes", 2, o, &builder, NULL);
    if (!status) {
        status = froe_shards_add_scene(builder, scene, NULL);
        if (status)
            froe_shards_abandon(builder);
        else
            status = froe_shards_finish(builder, NULL, NULL);
    }
    free(list);
    froe_scene_free(scene);
    return status;
}

static froe_status build_any(void *user, const froe_allocator *alloc) {
    froe_shards_options o = froe_shards_defaults();
    froe_shards *s;
    o.shards = 3, o.threads = 1, o.alloc = alloc;
    if (*(int *)user) {
        const froe_status status = build_scene(alloc, &o);
        if (status) return status;
    } else {
        one_object *list = lattice_objects(2, FROE_KIND_COUNT, OBJECTS, 9, 6);
        const froe_status status = build_folder("built.froes", 2, list, OBJECTS, &o, NULL, NULL);
        free(list);
        if (status) return status;
    }
    froe_status status = froe_shards_open("built.froes", alloc, &s, NULL);
    if (status) return status;
    status = froe_shards_check(s, NULL, NULL);
    froe_shards_close(s);
    return status;
}

static void any_allocation_of_any_build_may_fail(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) assert_true(test_memory_each(build_any, &i) > 50);
}

/* Buckets with blocks in their file. */
static froe_status count_bytes(void *user, const void *records, size_t count) {
    (void)records;
    *(size_t *)user += count;
    return FROE_OK;
}

static froe_status fill_bucket(void *user, const froe_allocator *alloc) {
    enum { TIMES = 6000 };
    froe_shard_buckets *b;
    froe_shard_records one = {.alloc = *alloc};
    one_object *list = lattice_objects(2, FROE_SEGMENT, 1, 9, 6);
    size_t starts[2], taken = 0;
    const froe_objects batch = batch_of(list, starts);
    (void)user;
    froe_status status = froe_shard_records_add(&one, 2, &batch, 0, NULL);
    free(list);
    if (!status) status = froe_shard_buckets_new(".", 4096, alloc, &b, NULL); /* with small blocks, so many of them */
    const bool made = !status;
    for (int i = 0; i < TIMES && !status; i++) status = froe_shard_buckets_add(b, 1, one.bytes, one.count, NULL);
    if (!status) status = froe_shard_buckets_take(b, 1, count_bytes, &taken, NULL);
    if (!status) assert_int_equal(taken, TIMES * one.count);
    if (made) froe_shard_buckets_free(b);
    froe_shard_records_free(&one);
    return status;
}

static void any_allocation_of_buckets_may_fail(void **state) {
    (void)state;
    assert_true(test_memory_each(fill_bucket, NULL) > 5);
}

/* A spool may be larger than memory: what is behind a record that is none stays on the disk. */
static void a_bucket_is_left_at_what_is_no_record(void **state) {
    (void)state;
    enum { SIZE = 48, RECORDS = 200000, MOST = 1 << 20, KIND = 4, LENGTH = 3 };
    static const double segments[] = {0, 0, 1, 1, 2, 2, 3, 3};
    static const int bad[] = {KIND, LENGTH}; /* bytes of the second record */
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        test_memory m;
        const froe_allocator alloc = test_memory_begin(&m);
        froe_shard_records records = {0};
        froe_shard_buckets *buckets;
        froe_diagnostic why;
        size_t taken = 0;
        froe_objects batch = froe_objects_defaults();
        batch.kind = FROE_SEGMENT, batch.count = 2, batch.coords = segments;
        assert_int_equal(froe_shard_records_add(&records, 2, &batch, 0, NULL), FROE_OK);
        records.bytes[SIZE + bad[i]] = 255;
        assert_int_equal(froe_shard_buckets_new(".", 1, &alloc, &buckets, NULL), FROE_OK);
        for (int r = 0; r < RECORDS; r += 2)
            assert_int_equal(froe_shard_buckets_add(buckets, 0, records.bytes, records.count, NULL), FROE_OK);
        assert_int_equal(froe_shard_buckets_take(buckets, 0, count_bytes, &taken, &why), FROE_E_FORMAT);
        assert_string_equal(why.message, ".: Bucket 0 holds bytes that are no records.");
        assert_int_equal(taken, SIZE);
        assert_true(m.peak < MOST);
        froe_shard_buckets_free(buckets), froe_shard_records_free(&records);
        test_memory_end(&m);
    }
}

/* The text of a manifest, into room for so many bytes, which does not grow. False: there is not enough. */
static bool print_into(const froe_shard_plan *plan, const froe_shard_entry *entries, size_t room, const char *whole) {
    test_memory m;
    const froe_allocator alloc = test_memory_begin(&m);
    shards_text text = {.capacity = room};
    if (room) text.data = test_memory_fn(&m, NULL, 0, room);
    m.fail_at = 1, m.fail_on = true;
    const bool ok = shards_manifest_print(plan, entries, &alloc, &text);
    assert_true(text.count <= room && !memcmp(text.data ? text.data : "", whole, text.count));
    if (ok) assert_int_equal(text.count, room);
    array_free(&alloc, &text);
    test_memory_end(&m);
    return ok;
}

static void a_manifest_may_lack_room_at_any_byte(void **state) {
    (void)state;
    const froe_allocator alloc = support_allocator(NULL);
    one_object *list = lattice_objects(2, FROE_SEGMENT, OBJECTS, 9, 5);
    froe_shards_options o = froe_shards_defaults();
    froe_shards *s;
    o.shards = 3;
    assert_int_equal(build_folder("folder.froes", 2, list, OBJECTS, &o, NULL, NULL), FROE_OK);
    free(list);
    assert_int_equal(froe_shards_open("folder.froes", NULL, &s, NULL), FROE_OK);
    s->manifest.entries.data[1] = (froe_shard_entry){0}; /* its line is shorter */
    for (int areas = 0; areas < 2; areas++) {
        shards_text whole = {0};
        size_t room = 0;
        s->manifest.plan->areas = areas;
        assert_true(shards_manifest_print(s->manifest.plan, s->manifest.entries.data, &alloc, &whole));
        while (!print_into(s->manifest.plan, s->manifest.entries.data, room, whole.data)) room++;
        assert_int_equal(room, whole.count);
        array_free(&alloc, &whole);
    }
    froe_shards_close(s);
}

/* Samples of no objects, and of those whose numbers are below a bound only. */
static froe_status merge_samples(void *user, const froe_allocator *alloc) {
    enum { MANY = 600 };
    froe_shard_records records = {.alloc = *alloc};
    froe_shard_sample *samples[3] = {NULL, NULL, NULL};
    one_object *list = lattice_objects(2, FROE_SEGMENT, MANY, 99, 6);
    froe_status status = FROE_OK;
    size_t counts[3] = {0}, before = 0;
    (void)user;
    for (size_t i = 0; i < MANY && !status; i++) {
        size_t starts[2];
        const froe_objects batch = batch_of(list + i, starts);
        status = froe_shard_records_add(&records, 2, &batch, 0, NULL);
    }
    free(list);
    for (int i = 0; i < 3 && !status; i++) status = froe_shard_sample_new(2, alloc, &samples[i]);
    if (!status) status = froe_shard_sample_add(samples[0], records.bytes, records.count);
    for (int i = 0; i < 3 && !status;
         i++) { /* into the second, what is below the bound; and the third, which is none */
        if (i == 1) froe_shard_sample_cut(samples[1], UINT64_MAX / 4);
        const uint64_t *words = froe_shard_sample_words(samples[i == 1 ? 0 : i], &counts[i]);
        if (!words) status = FROE_E_MEMORY;
        if (words && i) status = froe_shard_sample_merge(samples[1], words, counts[i]);
        if (words && i == 2) assert_true(counts[2] < 8);
    }
    if (!status && froe_shard_sample_words(samples[1], &before)) assert_in_range(before, counts[0] / 8, counts[0] / 2);
    for (int i = 0; i < 3; i++) froe_shard_sample_free(samples[i]);
    froe_shard_records_free(&records);
    return status;
}

static void any_allocation_of_samples_may_fail(void **state) {
    (void)state;
    assert_true(test_memory_each(merge_samples, NULL) > 6);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_manifest_may_lack_room_at_any_byte),
        cmocka_unit_test(any_allocation_of_samples_may_fail),
        cmocka_unit_test(any_allocation_of_any_question_may_fail),
        cmocka_unit_test(any_allocation_of_any_build_may_fail),
        cmocka_unit_test(any_allocation_of_buckets_may_fail),
        cmocka_unit_test(a_bucket_is_left_at_what_is_no_record),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
