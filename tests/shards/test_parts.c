/* test_parts.c: the same folder whatever the order of the objects, the number of threads, and the number of processes
 * that build it; and what the parts refuse. */
#include "shards/folders.h"
#include "shards/plan.h"
#include "support/memory.h"
#include <float.h>
#include <froe/shard_parts.h>
#include <math.h>
#include <unistd.h>

enum { COUNT = 3000, MOST = 40 };

static void shuffle(one_object *list, size_t count, uint64_t seed) {
    for (size_t i = count; i > 1; i--) {
        const size_t j = next_random(&seed) % i;
        const one_object kept = list[i - 1];
        list[i - 1] = list[j];
        list[j] = kept;
    }
}

static void order_and_threads_make_no_difference(void **state) {
    (void)state;
    for (int dim = 2; dim <= 4; dim++) {
        one_object *list = lattice_objects(dim, FROE_KIND_COUNT, COUNT, MOST, (uint64_t)dim);
        froe_shards_options o = froe_shards_defaults();
        froe_shards_report report;
        froe_diagnostic diag;
        o.shards = 7;
        for (int round = 0; round < 3; round++) {
            const char *path = round ? "second.froes" : "first.froes";
            o.threads = 1 + (unsigned)round;
            assert_int_equal(build_folder(path, dim, list, COUNT, &o, &report, &diag), FROE_OK);
            assert_int_equal(report.objects, COUNT);
            assert_int_equal(report.shards, 7);
            assert_true(report.copies > COUNT && report.most < COUNT / 2);
            if (round) assert_equal_folders("first.froes", path, 7);
            shuffle(list, COUNT, 17 + (uint64_t)round);
        }
        free(list);
    }
}

/* Objects of one tag lie in the order of their bytes: of a segment, a point and a longer hull, in any order. */
static void equal_tags_are_in_one_order(void **state) {
    (void)state;
    enum { EQUAL = 6 };
    one_object list[EQUAL] = {{.kind = FROE_SEGMENT, .corners = 2, .at = {0, 0, 1, 1}, .tag = 7},
                              {.kind = FROE_POINT, .corners = 1, .at = {3, 3}, .tag = 7},
                              {.kind = FROE_HULL, .corners = 3, .at = {0, 0, 1, 1, 0, 1}, .tag = 7},
                              {.kind = FROE_SEGMENT, .corners = 2, .at = {0, 0, 1, 2}, .tag = 7},
                              {.kind = FROE_POINT, .corners = 1, .at = {3, 4}, .tag = 7},
                              {.kind = FROE_POINT, .corners = 1, .at = {3, 4}, .tag = 6}};
    const froe_shards_options o = froe_shards_defaults();
    assert_int_equal(build_folder("tags.froes", 2, list, EQUAL, &o, NULL, NULL), FROE_OK);
    for (uint64_t seed = 1; seed < 8; seed++) {
        shuffle(list, EQUAL, seed);
        assert_int_equal(build_folder("shuffled.froes", 2, list, EQUAL, &o, NULL, NULL), FROE_OK);
        assert_equal_folders("tags.froes", "shuffled.froes", 1);
    }
}

/* Middles that are 0 and -0, of which a cut is made that lies at one or the other. */
static void a_cut_at_0_has_no_sign(void **state) {
    (void)state;
    enum { MIDDLES = 8 };
    const double least = 0x1p-1074; /* half of it is rounded to 0, or to -0 */
    one_object list[MIDDLES];
    for (size_t i = 0; i < MIDDLES; i++) {
        const double lo = i < 4 ? -2 * least : i < 6 ? -least : 0, hi = i < 4 ? 0 : lo;
        list[i] = (one_object){.kind = FROE_BOX, .corners = 2, .at = {lo, 0, hi, 0}, .tag = i};
    }
    froe_shards_options o = froe_shards_defaults();
    froe_shards_report report;
    o.shards = 2;
    assert_int_equal(build_folder("signs.froes", 2, list, MIDDLES, &o, &report, NULL), FROE_OK);
    assert_int_equal(report.shards, 2);
    for (uint64_t seed = 1; seed < 8; seed++) {
        shuffle(list, MIDDLES, seed);
        assert_int_equal(build_folder("shuffled.froes", 2, list, MIDDLES, &o, NULL, NULL), FROE_OK);
        assert_equal_folders("signs.froes", "shuffled.froes", 2);
    }
}

static int by_hash(const void *a, const void *b) {
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

static void samples_of_many_objects_do_not_depend_on_their_order(void **state) {
    (void)state;
    enum { MANY = 300000, CHUNK = 1000 };
    double *coords = calloc(2 * MANY, sizeof *coords);
    uint64_t *tags = calloc(MANY, sizeof *tags), seed = 7;
    froe_shard_sample *samples[3];
    size_t words[3];
    assert_non_null(coords);
    assert_non_null(tags);
    for (size_t i = 0; i < MANY; i++) {
        coords[2 * i] = on_lattice(&seed, 999);
        coords[2 * i + 1] = on_lattice(&seed, 999);
        tags[i] = i % 1000;
    }
    for (int k = 0; k < 3; k++) assert_int_equal(froe_shard_sample_new(2, NULL, &samples[k]), FROE_OK);
    for (size_t i = 0; i < MANY; i += CHUNK) { /* forwards in one, backwards in two, which are merged */
        for (int k = 0; k < 2; k++) {
            const size_t first = k ? MANY - CHUNK - i : i;
            froe_shard_records records = {0};
            froe_objects batch = froe_objects_defaults();
            batch.kind = FROE_POINT, batch.count = CHUNK;
            batch.coords = coords + 2 * first, batch.tags = tags + first;
            assert_int_equal(froe_shard_records_add(&records, 2, &batch, 0, NULL), FROE_OK);
            froe_shard_sample *to = k ? samples[1 + i / CHUNK % 2] : samples[0];
            assert_int_equal(froe_shard_sample_add(to, records.bytes, records.count), FROE_OK);
            froe_shard_records_free(&records);
        }
    }
    uint64_t bound = 0; /* half of each sample is enough for that of both */
    for (int k = 1; k < 3; k++) {
        const uint64_t own = froe_shard_sample_bound(samples[k], 2);
        bound = own > bound ? own : bound;
    }
    for (int k = 1; k < 3; k++) froe_shard_sample_cut(samples[k], bound);
    const uint64_t *other = froe_shard_sample_words(samples[2], &words[2]);
    assert_true(words[2] > 3 * 64000 && words[2] < 3 * 68000);
    assert_int_equal(froe_shard_sample_merge(samples[1], other, words[2]), FROE_OK);
    uint64_t *both[2];
    for (int k = 0; k < 2; k++) { /* they have the items in any order */
        const uint64_t *found = froe_shard_sample_words(samples[k], &words[k]);
        both[k] = calloc(words[k], sizeof *both[k]);
        assert_non_null(both[k]);
        memcpy(both[k], found, words[k] * sizeof *found);
        qsort(both[k] + 3, (words[k] - 3) / 3, 3 * sizeof **both, by_hash);
    }
    assert_int_equal(words[0], words[1]);
    assert_true(words[0] < 2 * (size_t)MANY);
    assert_memory_equal(both[0], both[1], words[0] * sizeof **both);
    free(both[0]), free(both[1]);
    for (int k = 0; k < 3; k++) froe_shard_sample_free(samples[k]);
    free(coords), free(tags);
}

/* As many shards as leave a quarter of the memory, or as a folder can have, if these take no more than all of it. */
static void memory_is_used_up_where_a_folder_has_no_more_shards(void **state) {
    (void)state;
    enum { OBJECTS = 9000 };
    const uint64_t memory = 1 << 20;
    const struct {
        double weight; /* of the objects, in units of the memory */
        uint32_t shards;
    } cases[] = {{0.7, 1}, {2.9, 4}, {3000, 4001}, {3071, 4095}, {3073, 4096}, {4095.5, 4096}, {4096.5, 0}};
    double *coords = calloc(OBJECTS, 2 * sizeof *coords);
    assert_non_null(coords);
    for (int i = 0; i < OBJECTS; i++) coords[2 * i] = i, coords[2 * i + 1] = i * 7919 % OBJECTS;
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_POINT, batch.count = OBJECTS, batch.coords = coords;
    froe_shard_records records = {0};
    froe_shard_sample *one;
    assert_int_equal(froe_shard_records_add(&records, 2, &batch, 0, NULL), FROE_OK);
    assert_int_equal(froe_shard_sample_new(2, NULL, &one), FROE_OK);
    assert_int_equal(froe_shard_sample_add(one, records.bytes, records.count), FROE_OK);
    size_t count;
    const uint64_t *words = froe_shard_sample_words(one, &count);
    uint64_t *copy = malloc(count * sizeof *copy);
    assert_non_null(copy);
    memcpy(copy, words, count * sizeof *copy);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_shard_sample *heavy;
        froe_shard_plan *plan = NULL;
        froe_diagnostic diag;
        copy[2] = (uint64_t)(cases[i].weight * (double)memory); /* see froe_shard_sample_words() */
        assert_int_equal(froe_shard_sample_new(2, NULL, &heavy), FROE_OK);
        assert_int_equal(froe_shard_sample_merge(heavy, copy, count), FROE_OK);
        assert_int_equal(froe_shard_plan_new(heavy, 0, memory, &plan, &diag), cases[i].shards ? FROE_OK : FROE_E_LIMIT);
        if (cases[i].shards)
            assert_int_equal(froe_shard_plan_count(plan), cases[i].shards);
        else
            assert_string_equal(diag.message,
                                "A folder has at most 4096 shards, and building one of so many takes up to 2 MiB of "
                                "memory. 1 MiB were given.");
        froe_shard_plan_free(plan);
        froe_shard_sample_free(heavy);
    }
    free(coords), free(copy);
    froe_shard_records_free(&records);
    froe_shard_sample_free(one);
}

/* ------------------------------------------------------------------- ranks -- */

/* What a process of a program of several holds. */
typedef struct test_rank {
    froe_shard_records records;
    froe_shard_sample *sample;
    froe_shard_plan *plan;
    froe_shard_buckets *buckets;
} test_rank;

static froe_status gather(void *user, const void *records, size_t count) {
    return froe_shard_records_append(user, records, count, NULL);
}

static void plan_of_all(test_rank *ranks, int count, int dim, uint32_t shards) {
    for (int r = 0; r < count; r++) {
        froe_shard_sample *all;
        assert_int_equal(froe_shard_sample_new(dim, NULL, &all), FROE_OK);
        for (int i = 0; i < count; i++) { /* each in an order of its own */
            size_t words;
            const uint64_t *sample = froe_shard_sample_words(ranks[(i + r) % count].sample, &words);
            assert_int_equal(froe_shard_sample_merge(all, sample, words), FROE_OK);
        }
        assert_int_equal(froe_shard_plan_new(all, shards, 0, &ranks[r].plan, NULL), FROE_OK);
        froe_shard_sample_free(all);
        assert_int_equal(
            froe_shard_buckets_new(".", froe_shard_plan_count(ranks[r].plan), NULL, &ranks[r].buckets, NULL), FROE_OK);
    }
}

static void exchange_records(test_rank *ranks, int count) {
    for (int r = 0; r < count; r++)
        for (size_t at = 0, size; at < ranks[r].records.count; at += size) {
            double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
            uint32_t cells[FROE_SHARDS_MOST];
            const unsigned char *record = ranks[r].records.bytes + at;
            size = froe_shard_record_size(record, ranks[r].records.count - at);
            froe_shard_record_box(record, lo, hi);
            const uint32_t met = froe_shard_plan_cells(ranks[r].plan, lo, hi, cells);
            assert_true(met > 0);
            for (uint32_t i = 0; i < met; i++)
                assert_int_equal(
                    froe_shard_buckets_add(ranks[cells[i] % (uint32_t)count].buckets, cells[i], record, size, NULL),
                    FROE_OK);
        }
}

static froe_shards_report build_by_ranks(const char *path, int dim, const one_object *list, int count,
                                         uint32_t shards) {
    test_rank ranks[4] = {0};
    froe_shard_draft *draft;
    froe_shard_entry entries[64];
    const froe_shards_options o = froe_shards_defaults();
    assert_int_equal(froe_shard_draft_begin(path, NULL, &draft, NULL), FROE_OK);
    for (int r = 0; r < count; r++) {
        for (int i = r; i < COUNT; i += count) {
            size_t starts[2];
            const froe_objects batch = batch_of(list + i, starts);
            assert_int_equal(froe_shard_records_add(&ranks[r].records, dim, &batch, 0, NULL), FROE_OK);
        }
        assert_int_equal(froe_shard_sample_new(dim, NULL, &ranks[r].sample), FROE_OK);
        assert_int_equal(froe_shard_sample_add(ranks[r].sample, ranks[r].records.bytes, ranks[r].records.count),
                         FROE_OK);
    }
    plan_of_all(ranks, count, dim, shards);
    exchange_records(ranks, count);
    for (uint32_t s = 0; s < froe_shard_plan_count(ranks[0].plan); s++) {
        test_rank *owner = ranks + s % (uint32_t)count;
        froe_shard_records records = {0};
        assert_int_equal(froe_shard_buckets_take(owner->buckets, s, gather, &records, NULL), FROE_OK);
        assert_int_equal(
            froe_shard_build(&records, owner->plan, s, NULL, &o, froe_shard_draft_folder(draft), &entries[s], NULL),
            FROE_OK);
        froe_shard_records_free(&records);
    }
    assert_int_equal(froe_shard_manifest_write(ranks[0].plan, entries, froe_shard_draft_folder(draft), NULL, NULL),
                     FROE_OK);
    const froe_shards_report report = froe_shard_report(ranks[0].plan, entries);
    assert_int_equal(froe_shard_draft_end(draft, FROE_OK, NULL), FROE_OK);
    for (int r = 0; r < count; r++) {
        froe_shard_records_free(&ranks[r].records);
        froe_shard_sample_free(ranks[r].sample);
        froe_shard_plan_free(ranks[r].plan);
        froe_shard_buckets_free(ranks[r].buckets);
    }
    return report;
}

static void processes_build_the_same_folder_together(void **state) {
    (void)state;
    one_object *list = lattice_objects(3, FROE_KIND_COUNT, COUNT, MOST, 99);
    froe_shards_options o = froe_shards_defaults();
    o.shards = 13;
    froe_shards_report alone;
    assert_int_equal(build_folder("alone.froes", 3, list, COUNT, &o, &alone, NULL), FROE_OK);
    assert_int_equal(alone.shards, 13);
    assert_int_equal(alone.objects, COUNT);
    for (int ranks = 1; ranks <= 4; ranks++) {
        const froe_shards_report together = build_by_ranks("together.froes", 3, list, ranks, 13);
        assert_int_equal(together.shards, alone.shards);
        assert_int_equal(together.objects, alone.objects);
        assert_int_equal(together.copies, alone.copies);
        assert_int_equal(together.most, alone.most);
        assert_int_equal(together.bytes, alone.bytes);
        assert_equal_folders("alone.froes", "together.froes", 13);
    }
    free(list);
}

/* ------------------------------------------------------------------- cells -- */

static void an_object_goes_to_every_cell_that_its_box_meets(void **state) {
    (void)state;
    one_object *list = lattice_objects(2, FROE_SEGMENT, COUNT, MOST, 5);
    froe_shard_records records = {0};
    froe_shard_sample *sample;
    froe_shard_plan *plan;
    for (int i = 0; i < COUNT; i++) {
        size_t starts[2];
        const froe_objects batch = batch_of(list + i, starts);
        assert_int_equal(froe_shard_records_add(&records, 2, &batch, 0, NULL), FROE_OK);
    }
    assert_int_equal(froe_shard_sample_new(2, NULL, &sample), FROE_OK);
    assert_int_equal(froe_shard_sample_add(sample, records.bytes, records.count), FROE_OK);
    assert_int_equal(froe_shard_plan_new(sample, 64, 0, &plan, NULL), FROE_OK);
    assert_int_equal(froe_shard_plan_count(plan), 64);
    for (uint32_t s = 0; s < 64; s++) { /* points on and beside every corner of a cell */
        const double *lo = shards_cell_lo(plan, s), *hi = shards_cell_hi(plan, s);
        for (int k = 0; k < 36; k++) {
            const double x = k & 1 ? lo[0] : hi[0], y = k & 2 ? lo[1] : hi[1];
            const double p[2] = {nextafter(x, k / 4 % 3 == 0   ? -INFINITY
                                              : k / 4 % 3 == 1 ? x
                                                               : INFINITY),
                                 nextafter(y, k / 12 == 0   ? -INFINITY
                                              : k / 12 == 1 ? y
                                                            : INFINITY)};
            uint32_t cells[64], met = 0;
            const uint32_t count = froe_shard_plan_cells(plan, p, p, cells);
            for (uint32_t c = 0; c < 64; c++)
                if (shards_boxes_meet(p, p, shards_cell_lo(plan, c), shards_cell_hi(plan, c), 2)) {
                    assert_true(met < count);
                    assert_int_equal(cells[met++], c);
                }
            assert_int_equal(met, count);
        }
    }
    froe_shard_plan_free(plan);
    froe_shard_sample_free(sample);
    froe_shard_records_free(&records);
    free(list);
}

static void places_that_are_one_make_one_shard(void **state) {
    (void)state;
    one_object *list = calloc(500, sizeof *list);
    for (int i = 0; i < 500; i++) list[i] = (one_object){.corners = 1, .at = {3, i < 400 ? 4 : 5}, .tag = (uint64_t)i};
    froe_shards_options o = froe_shards_defaults();
    froe_shards_report report;
    o.shards = 64;
    assert_int_equal(build_folder("points.froes", 2, list, 500, &o, &report, NULL), FROE_OK);
    assert_int_equal(report.shards, 2);
    assert_int_equal(report.copies, 500);
    assert_int_equal(report.most, 400);
    free(list);
}

/* The largest ball there is, whose box must not become infinite where it is rounded. */
static void the_largest_ball_is_found_in_every_cell(void **state) {
    (void)state;
    enum { COUNT_OF_BALLS = 9 };
    one_object list[COUNT_OF_BALLS] = {{.kind = FROE_BALL, .corners = 1, .radius = DBL_MAX}};
    double points[2 * COUNT_OF_BALLS];
    for (int i = 0; i < COUNT_OF_BALLS; i++) {
        if (i) list[i] = (one_object){.kind = FROE_BALL, .corners = 1, .at = {i, -i}, .tag = (uint64_t)i};
        points[2 * (size_t)i] = i, points[2 * (size_t)i + 1] = -i;
    }
    froe_shards_options o = froe_shards_defaults();
    froe_shards_report report;
    froe_shards *shards;
    froe_finds found;
    froe_diagnostic diag = {0};
    o.shards = 4;
    assert_int_equal(build_folder("largest.froes", 2, list, COUNT_OF_BALLS, &o, &report, NULL), FROE_OK);
    assert_int_equal(report.shards, 4);
    assert_true(report.copies >= report.objects + 3);
    assert_int_equal(froe_shards_open("largest.froes", NULL, &shards, NULL), FROE_OK);
    if (froe_shards_check(shards, NULL, &diag)) fail_msg("%s", diag.message);
    assert_int_equal(froe_shards_locate(shards, points, COUNT_OF_BALLS, NULL, &found, NULL), FROE_OK);
    for (size_t i = 0, at = 0; i < COUNT_OF_BALLS; i++) {
        assert_int_equal(found.items[at++].tag, 0);
        if (i) assert_int_equal(found.items[at++].tag, i);
        assert_int_equal(found.starts[i + 1], at);
    }
    froe_finds_free(&found);
    froe_shards_close(shards);
}

/* ---------------------------------------------------------------- failures -- */

static void refused(const one_object *o, int dim, froe_status status, const char *sentence) {
    froe_shards_builder *builder;
    froe_diagnostic diag;
    size_t starts[2];
    const froe_objects batch = batch_of(o, starts);
    assert_int_equal(froe_shards_begin("refused.froes", dim, NULL, &builder, &diag), FROE_OK);
    assert_int_equal(froe_shards_add(builder, &batch, &diag), status);
    assert_non_null(strstr(diag.message, sentence));
    froe_shards_abandon(builder);
    assert_int_equal(access("refused.froes", F_OK), -1);
    assert_int_equal(access(".refused.froes.building", F_OK), -1);
}

static void what_is_no_object_is_refused_at_once(void **state) {
    (void)state;
    refused(&(one_object){.kind = FROE_SEGMENT, .corners = 2, .at = {0, 0, NAN, 1}}, 2, FROE_E_INPUT, "");
    refused(&(one_object){.kind = FROE_BOX, .corners = 2, .at = {0, 3, 1, 2}}, 2, FROE_E_INPUT, "");
    refused(&(one_object){.kind = FROE_BALL, .corners = 1, .radius = -1}, 2, FROE_E_INPUT, "");
    for (int i = 0; i < 3; i++) { /* balls that have no bounds, so that these have no middle */
        const double middle = i == 0 ? 1 : i == 1 ? -1e308 : DBL_MAX, radius = i == 0 ? DBL_MAX : 1e308;
        refused(&(one_object){.kind = FROE_BALL, .corners = 1, .at = {5, middle}, .radius = radius}, 2, FROE_E_INPUT,
                "ball 0: It reaches beyond the range of doubles.");
    }
    refused(&(one_object){.kind = FROE_POLYGON, .corners = 4, .at = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 1}}, 3,
            FROE_E_INPUT, "");
    refused(&(one_object){.kind = FROE_POLYGON, .corners = 3}, 2, FROE_E_UNSUPPORTED, "");
}

static void memory_that_is_short_leaves_the_old_folder(void **state) {
    (void)state;
    one_object *list = lattice_objects(2, FROE_KIND_COUNT, 300, 20, 5);
    froe_shards_options o = froe_shards_defaults();
    test_memory m;
    froe_allocator alloc = test_memory_begin(&m);
    o.shards = 3, o.threads = 1;
    assert_int_equal(build_folder("kept.froes", 2, list, 200, &o, NULL, NULL), FROE_OK);
    assert_int_equal(build_folder("again.froes", 2, list, 200, &o, NULL, NULL), FROE_OK);
    o.alloc = &alloc;
    assert_int_equal(build_folder("other.froes", 2, list, 300, &o, NULL, NULL), FROE_OK);
    test_memory_end(&m);
    const size_t calls = m.calls;
    int failed = 0;
    for (size_t i = 0; i < calls; i += 1 + i / 97) {
        test_memory_begin(&m);
        m.fail_at = i + 1;
        m.fail_on = i % 2;
        const froe_status status = build_folder("kept.froes", 2, list, 300, &o, NULL, NULL);
        test_memory_end(&m);
        assert_int_equal(access(".kept.froes.building", F_OK), -1);
        assert_true(status == FROE_OK || status == FROE_E_MEMORY);
        failed += status != FROE_OK;
        assert_equal_folders("kept.froes", status ? "again.froes" : "other.froes", 3);
        if (!status) {
            froe_shards_options plain = o;
            plain.alloc = NULL;
            assert_int_equal(build_folder("kept.froes", 2, list, 200, &plain, NULL, NULL), FROE_OK);
        }
    }
    assert_true(failed > 100);
    free(list);
}

static void strangers_in_the_way_stay(void **state) {
    (void)state;
    one_object *list = lattice_objects(2, FROE_POINT, 10, 5, 1);
    froe_diagnostic diag;
    assert_int_equal(system("mkdir -p mine.froes && echo notes > mine.froes/notes.txt && echo text > file.froes"), 0);
    assert_int_equal(build_folder("mine.froes", 2, list, 10, NULL, NULL, &diag), FROE_E_IO);
    assert_string_equal(diag.message, "mine.froes: The folder is not replaced, because it holds 'notes.txt'.");
    assert_int_equal(build_folder("file.froes", 2, list, 10, NULL, NULL, &diag), FROE_E_IO);
    assert_string_equal(diag.message, "file.froes: What is there is no folder, and is not replaced.");
    assert_int_equal(build_folder("no/such/folder.froes", 2, list, 10, NULL, NULL, &diag), FROE_E_IO);
    froe_shards_builder *first;
    assert_int_equal(froe_shards_begin("busy.froes", 2, NULL, &first, NULL), FROE_OK);
    assert_int_equal(build_folder("busy.froes", 2, list, 10, NULL, NULL, &diag), FROE_E_IO);
    assert_string_equal(diag.message, "busy.froes: Another program is building this folder.");
    froe_shards_abandon(first);
    assert_int_equal(build_folder("busy.froes", 2, list, 0, NULL, NULL, &diag), FROE_E_INPUT);
    assert_int_equal(build_folder("busy.froes/", 2, list, 10, NULL, NULL, &diag), FROE_OK);
    free(list);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_tags_are_in_one_order),
        cmocka_unit_test(order_and_threads_make_no_difference),
        cmocka_unit_test(a_cut_at_0_has_no_sign),
        cmocka_unit_test(samples_of_many_objects_do_not_depend_on_their_order),
        cmocka_unit_test(memory_is_used_up_where_a_folder_has_no_more_shards),
        cmocka_unit_test(processes_build_the_same_folder_together),
        cmocka_unit_test(an_object_goes_to_every_cell_that_its_box_meets),
        cmocka_unit_test(places_that_are_one_make_one_shard),
        cmocka_unit_test(the_largest_ball_is_found_in_every_cell),
        cmocka_unit_test(what_is_no_object_is_refused_at_once),
        cmocka_unit_test(memory_that_is_short_leaves_the_old_folder),
        cmocka_unit_test(strangers_in_the_way_stay),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
