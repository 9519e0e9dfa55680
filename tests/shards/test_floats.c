/* test_floats.c: however the calling thread computes, folders of shards have the same bytes, the thread computes so
 * afterwards, and so do the callbacks. (conformance/test_floats.c says more.) */
#include "shards/folders.h"
#include "support/settings.h"
#include <froe/formats.h>
#include <froe/shard_parts.h>
#include <math.h>

enum { OBJECTS = 300 };

static froe_status note_records(void *user, const void *records, size_t count) {
    floats_bytes(user, records, count);
    return FROE_OK;
}

static void building_alone(floats_run *r, void *user) {
    static const char *const files[] = {"floats.froes/froe.shards", "floats.froes/shard-0000.froe",
                                        "floats.froes/shard-0001.froe"};
    const froe_allocator memory = {floats_memory, r};
    froe_shards_options o = froe_shards_defaults();
    froe_shards_builder *builder;
    o.shards = 3, o.threads = 1, o.alloc = &memory;
    o.progress = floats_progress;
    o.user = r;
    MUST(r, froe_shards_begin("floats.froes", 2, &o, &builder, NULL));
    const one_object *list = user;
    for (size_t i = 0; i < OBJECTS; i++) {
        size_t starts[2];
        const froe_objects batch = batch_of(list + i, starts);
        MUST(r, froe_shards_add(builder, &batch, NULL));
    }
    MUST(r, froe_shards_finish(builder, NULL, NULL));
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) floats_note_file(r, files[i]);
    MUST(r, froe_shards_begin("floats.froes", 2, &o, &builder, NULL));
    TELL(r, (froe_shards_abandon(builder), 0));
}

/* Appends the records that go to a cell. */
static void take_of_cell(const froe_shard_records *all, const froe_shard_plan *plan, uint32_t cell,
                         froe_shard_records *out) {
    for (size_t at = 0, size; (size = froe_shard_record_size(all->bytes + at, all->count - at)) != 0; at += size) {
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        uint32_t cells[2] = {0};
        froe_shard_record_box(all->bytes + at, lo, hi);
        const uint32_t met = froe_shard_plan_cells(plan, lo, hi, cells);
        if (cells[0] == cell || (met > 1 && cells[1] == cell))
            froe_shard_records_append(out, all->bytes + at, size, NULL);
    }
}

static void building_by_steps(floats_run *r, void *user) {
    const one_object *list = user;
    const froe_shards_options o = froe_shards_defaults();
    froe_shard_records records = {0}, taken = {0};
    froe_shard_sample *sample, *other;
    const uint64_t *words;
    size_t count;
    froe_shard_plan *plan;
    froe_shard_buckets *buckets;
    froe_shard_draft *draft;
    bool replaced = false;
    froe_shard_entry entries[2];
    double box[2 * FROE_MAX_DIM] = {0};
    uint32_t cells[2] = {0};
    for (size_t i = 0; i < OBJECTS; i++) {
        size_t starts[2];
        const froe_objects batch = batch_of(list + i, starts);
        MUST(r, froe_shard_records_add(&records, 2, &batch, 0, NULL));
    }
    MUST(r, froe_shard_records_append(&taken, records.bytes, records.count, NULL));
    TELL(r, (froe_shard_record_box(records.bytes, box, box + 2), 0));
    floats_note(r, box, sizeof box);
    froe_shard_sample_new(2, NULL, &sample);
    MUST(r, froe_shard_sample_add(sample, records.bytes, records.count));
    froe_shard_sample_new(2, NULL, &other);
    TELL(r, froe_shard_sample_bound(sample, 7));
    TELL(r, froe_shard_owner(5, 3) + froe_shard_of_turn(1, 3, 1));
    TELL(r, (words = froe_shard_sample_words(sample, &count), 0));
    MUST(r, froe_shard_sample_merge(other, words, count));
    MUST(r, froe_shard_plan_new(other, 2, 0, &plan, NULL));
    TELL(r, froe_shard_plan_cells(plan, box, box + 2, cells));
    floats_note(r, cells, sizeof cells);
    MUST(r, froe_shard_draft_begin("steps.froes", NULL, &draft, NULL));
    MUST(r, froe_shard_buckets_new(".", 2, NULL, &buckets, NULL));
    MUST(r, froe_shard_buckets_add(buckets, 1, records.bytes, records.count, NULL));
    MUST(r, froe_shard_buckets_take(buckets, 1, note_records, r, NULL));
    froe_shard_records_free(&taken);
    for (uint32_t i = 0; i < 2; i++) {
        take_of_cell(&records, plan, i, &taken);
        MUST(r, froe_shard_build(&taken, plan, i, NULL, &o, froe_shard_draft_folder(draft), &entries[i], NULL));
        froe_shard_records_free(&taken);
    }
    MUST(r, froe_shard_manifest_write(plan, entries, froe_shard_draft_folder(draft), NULL, NULL));
    MUST(r, froe_shard_draft_sync(froe_shard_draft_folder(draft), 0, 1, NULL));
    MUST(r, froe_shard_draft_place(draft, &replaced, NULL));
    TELL(r, (froe_shard_draft_clear(froe_shard_draft_folder(draft), 0, 1), replaced));
    MUST(r, froe_shard_draft_end(draft, FROE_OK, NULL));
    floats_note_file(r, "steps.froes/froe.shards");
    froe_shard_records_free(&records);
    froe_shard_sample_free(sample), froe_shard_sample_free(other);
    froe_shard_plan_free(plan);
    froe_shard_buckets_free(buckets);
}

static bool note_pair(void *user, const froe_found_pair *pair) {
    return floats_bytes(user, &pair->a.tag, sizeof pair->a.tag) && floats_bytes(user, &pair->b.tag, sizeof pair->b.tag);
}

static void note_finds(floats_run *r, froe_finds *finds) {
    for (size_t i = 0; i < finds->starts[finds->questions]; i++) {
        floats_note(r, &finds->items[i].tag, sizeof finds->items[i].tag);
        floats_note(r, &finds->items[i].value, sizeof finds->items[i].value);
    }
    froe_finds_free(finds);
}

static froe_status note_batch(void *user, int dim, const froe_objects *batch, froe_diagnostic *diag) {
    (void)diag;
    floats_bytes(user, batch->coords, batch->count * 2 * (size_t)dim * sizeof *batch->coords);
    return FROE_OK;
}

static froe_status refuse_trade(void *user, froe_status status, const froe_shard_records *out, const size_t *counts,
                                froe_shard_records *in, size_t *in_counts, froe_diagnostic *diag) {
    (void)out, (void)in, (void)in_counts, (void)diag;
    floats_bytes(user, counts, 2 * sizeof *counts);
    return status ? status : FROE_E_CANCELLED;
}

/* A triangle and a square, as areas. */
static void areas(floats_run *r, void *user) {
    static const double edges[] = {0, 0, 4, 0, 4, 0, 2, 3.5, 2, 3.5, 0, 0, 3, 1,
                                   9, 1, 9, 1, 9, 7, 9, 7,   3, 7,   3, 7, 3, 1};
    static const uint32_t groups[] = {0, 0, 0, 1, 1, 1, 1}, faces[] = {0, 0, 0, 3, 3, 3, 3};
    static const double points[] = {3.25, 1, 8, 2};
    froe_objects batch = froe_objects_defaults();
    froe_shards_options o = froe_shards_defaults();
    froe_range range = froe_range_defaults();
    froe_shards_builder *builder;
    froe_scene *scene;
    froe_shards *shards;
    froe_finds finds;
    froe_query *query;
    const froe_tree *tree;
    uint32_t id;
    (void)user;
    batch.kind = FROE_SEGMENT, batch.count = 7, batch.coords = edges, batch.groups = groups, batch.faces = faces;
    o.shards = 3;
    range.points = points;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    for (int i = 0; i < 2; i++) froe_scene_add_group(scene, &(froe_group){.name = "area"}, &id);
    assert_int_equal(froe_scene_add(scene, &batch, NULL), FROE_OK);
    MUST(r, froe_write_scene(scene, "edges.csv", NULL));
    MUST(r, froe_read_batches("edges.csv", NULL, note_batch, r, NULL, NULL));
    MUST(r, froe_shards_begin("areas.froes", 2, &o, &builder, NULL));
    MUST(r, froe_shards_add_scene(builder, scene, NULL));
    MUST(r, froe_shards_finish(builder, NULL, NULL));
    MUST(r, froe_shards_open("areas.froes", NULL, &shards, NULL));
    MUST(r, froe_shards_query(shards, 0, &query, NULL));
    MUST(r, froe_shards_groups(shards, points, 2, NULL, &finds, NULL));
    assert_int_equal(finds.starts[2], 3);
    note_finds(r, &finds);
    MUST(r, froe_shards_groups_range(shards, &range, 1, FROE_MEETS, NULL, &finds, NULL));
    note_finds(r, &finds);
    MUST(r, froe_shards_tree(shards, 0, &tree, NULL));
    MUST(r, froe_shards_groups_join(shards, tree, FROE_MEETS, NULL, &finds, NULL));
    note_finds(r, &finds);
    MUST(r, froe_shards_share(shards, 0, 2, refuse_trade, r, NULL));
    TELL(r, froe_shards_groups(shards, points, 2, NULL, &finds, NULL));
    froe_shards_close(shards);
    froe_scene_free(scene);
}

/* Of the folder that was built last. */
static void asking(floats_run *r, void *user) {
    static const double points[] = {3, 4, 9.5, 7, 0, 12}, directions[] = {1, 0.25, -3, 1, 0.5, -1};
    static const double boxes[] = {1, 1, 9, 8, 0, 5, 20, 6};
    froe_range ranges[] = {froe_range_defaults(), froe_range_defaults()};
    froe_shards *shards;
    froe_finds finds;
    froe_find one[3];
    uint64_t counts[3] = {0};
    const froe_tree *tree;
    (void)user;
    for (size_t i = 0; i < 2; i++) ranges[i].points = boxes + 4 * i;
    ranges[1].shape = FROE_SHAPE_BALL, ranges[1].radius = 0.1;
    MUST(r, froe_shards_open("floats.froes", NULL, &shards, NULL));
    TELL(r, froe_shards_about(shards).objects);
    MUST(r, froe_shards_tree(shards, 0, &tree, NULL));
    MUST(r, froe_shards_check(shards, NULL, NULL));
    MUST(r, froe_shards_range(shards, ranges, 2, NULL, &finds, NULL));
    note_finds(r, &finds);
    MUST(r, froe_shards_boxes(shards, boxes, 2, NULL, &finds, NULL));
    note_finds(r, &finds);
    MUST(r, froe_shards_count(shards, ranges, 2, NULL, counts, NULL));
    floats_note(r, counts, sizeof counts);
    MUST(r, froe_shards_any(shards, ranges, 2, NULL, one, NULL));
    MUST(r, froe_shards_locate(shards, points, 3, NULL, &finds, NULL));
    note_finds(r, &finds);
    MUST(r, froe_shards_vertical(shards, points, 3, 1, NULL, one, NULL));
    MUST(r, froe_shards_ray(shards, points, directions, 3, INFINITY, NULL, one, NULL));
    for (size_t i = 0; i < 3; i++) floats_note(r, &one[i].value, sizeof one[i].value);
    MUST(r, froe_shards_ray_any(shards, points, directions, 3, 2, NULL, one, NULL));
    MUST(r, froe_shards_ray_all(shards, points, directions, 3, INFINITY, NULL, &finds, NULL));
    note_finds(r, &finds);
    MUST(r, froe_shards_near(shards, points, 3, 5, INFINITY, NULL, &finds, NULL));
    note_finds(r, &finds);
    MUST(r, froe_shards_locate_count(shards, points, 3, NULL, counts, NULL));
    floats_note(r, counts, sizeof counts);
    MUST(r, froe_shards_vertical_count(shards, points, 3, 1, NULL, counts, NULL));
    floats_note(r, counts, sizeof counts);
    MUST(r, froe_shards_ray_count(shards, points, directions, 3, 4, NULL, counts, NULL));
    floats_note(r, counts, sizeof counts);
    MUST(r, froe_shards_near_count(shards, points, 3, 5, 2, NULL, counts, NULL));
    floats_note(r, counts, sizeof counts);
    MUST(r, froe_shards_pairs(shards, true, NULL, note_pair, r, NULL));
    froe_shards_close(shards);
}

static void folders_have_the_same_bytes(void **state) {
    (void)state;
    one_object *list = lattice_objects(2, FROE_KIND_COUNT, OBJECTS, 20, 3);
    floats_compare(building_alone, list);
    floats_compare(building_by_steps, list);
    floats_compare(asking, list);
    floats_compare(areas, NULL);
    free(list);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(folders_have_the_same_bytes)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
