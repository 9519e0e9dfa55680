/* decide.c: which of several objects comes first, where their values are equal as doubles and their trees differ?
 *
 * They become a tree of their own, in the order of their tags, which is asked the same question. It compares exact
 * values, and goes by its ids where these are equal, that is, by tags. */
#include "shards/ask/ask.h"
#include "shards/ask/share.h"
#include "support/fail.h"

/* The object's form has fewer corners than its kind where it has no length or area; the last corner then stands for
 * those that are left out. */
froe_status shards_put_object(froe_shard_records *records, const froe_scene *scene, uint32_t object,
                              froe_diagnostic *diag) {
    const froe_object o = froe_scene_object(scene, object);
    const uint32_t least = o.kind == FROE_POLYGON ? 3 : o.kind == FROE_SEGMENT || o.kind == FROE_BOX ? 2 : 1;
    const size_t dim = (size_t)froe_scene_dim(scene), corners = o.corners > least ? o.corners : least;
    const size_t starts[2] = {0, corners};
    double *coords = support_calloc(&records->alloc, corners * dim, sizeof *coords);
    if (!coords) return support_fail_memory(diag);
    for (uint32_t i = 0; i < corners; i++) {
        const uint32_t vertex = froe_scene_corner(scene, object, i < o.corners ? i : o.corners - 1);
        memcpy(coords + i * dim, froe_scene_vertex(scene, vertex), dim * sizeof *coords);
    }
    froe_objects batch = froe_objects_defaults();
    batch.kind = o.kind;
    batch.count = 1;
    batch.coords = coords;
    batch.starts = o.kind == FROE_POLYGON || o.kind == FROE_HULL ? starts : NULL;
    batch.radii = o.kind == FROE_BALL ? &o.radius : NULL;
    const froe_status status = shards_records_put(records, (int)dim, &batch, o.tag, diag);
    support_free(&records->alloc, coords, corners * dim * sizeof *coords);
    return status;
}

static froe_status add_record(froe_scene *to, const shards_record *record, froe_diagnostic *diag) {
    const shards_object o = shards_record_read(record);
    const size_t starts[2] = {0, o.corners};
    froe_objects batch = froe_objects_defaults();
    batch.kind = o.kind;
    batch.count = 1;
    batch.coords = o.numbers;
    batch.starts = o.kind == FROE_POLYGON || o.kind == FROE_HULL ? starts : NULL;
    batch.radii = o.kind == FROE_BALL ? &o.radius : NULL;
    batch.threads = 1;
    return froe_scene_add(to, &batch, diag);
}

/* Adds a copy of an object that was found, of a shard here or of another process. */
static froe_status copy_object(const froe_shards *s, froe_scene *to, const froe_find *find, froe_diagnostic *diag) {
    froe_shard_records own = {.alloc = s->alloc};
    const shards_record *record = shards_share_fetched(s, find);
    froe_status status = FROE_OK;
    if (!record) {
        status = shards_put_object(&own, froe_tree_scene(s->slots[find->shard].tree), find->object, diag);
        record = shards_record_at(own.bytes, 0);
    }
    if (!status) status = add_record(to, record, diag);
    froe_shard_records_free(&own);
    return status;
}

/* Asks question i of these objects alone. */
static froe_status ask_few(froe_shards *s, const shards_question *q, size_t i, const froe_find *items, size_t count,
                           shards_answers *out, froe_diagnostic *diag) {
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_query *query = NULL;
    froe_batch_options one = froe_batch_defaults();
    froe_build_options o = froe_build_defaults();
    one.threads = o.threads = 1;
    o.purpose = "query";
    froe_status status = froe_scene_new(s->dim, &s->alloc, &scene) ? support_fail_memory(diag) : FROE_OK;
    for (size_t j = 0; j < count && !status; j++) status = copy_object(s, scene, &items[j], diag);
    if (!status) status = froe_build(scene, &o, &tree, diag);
    if (!status) status = froe_query_new(tree, &query, diag);
    if (!status) status = q->ask(q, query, &i, 1, &one, out, diag);
    froe_query_free(query);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

size_t shards_equal_values(const froe_finds *f, size_t i, size_t first) {
    size_t end = first + 1;
    while (end < f->starts[i + 1] && f->items[end].value == f->items[first].value) end++;
    return end - first;
}

bool shards_of_several(const froe_find *items, size_t count) {
    for (size_t j = 1; j < count; j++)
        if (items[j].shard != items[0].shard) return true;
    return false;
}

/* Puts `count` answers of equal values into their order, which they have if they are of one shard. Those that the
 * question has no room for come last, and *count becomes the number of the others. */
static froe_status decide_run(froe_shards *s, const shards_question *q, size_t i, froe_find *items, size_t *count,
                              froe_diagnostic *diag) {
    if (!shards_of_several(items, *count)) return FROE_OK;
    shards_answers order = {.own = false};
    const size_t size = *count * sizeof *items;
    froe_find *before = support_realloc(&s->alloc, NULL, 0, size);
    if (!before) return support_fail_memory(diag);
    shards_sort_by_tag(items, *count);
    memcpy(before, items, size);
    const froe_status status = ask_few(s, q, i, items, *count, &order, diag);
    if (!status) {
        *count = order.all.starts[1];
        for (size_t j = 0; j < *count; j++) items[j] = before[order.all.ids[j]];
    }
    shards_answers_free(&order);
    support_free(&s->alloc, before, size);
    return status;
}

/* Decides question i, moves the answers that stay to items[*total], and counts them there. */
static froe_status decide_question(froe_shards *s, const shards_question *q, size_t i, froe_finds *f, size_t k,
                                   size_t first, size_t *total, froe_diagnostic *diag) {
    froe_status status = FROE_OK;
    size_t kept = 0;
    for (size_t each; first < f->starts[i + 1] && kept < k && !status; first += each) {
        each = shards_equal_values(f, i, first);
        size_t run = each;
        status = run > 1 ? decide_run(s, q, i, f->items + first, &run, diag) : FROE_OK;
        if (run > k - kept) run = k - kept;
        memmove(f->items + *total, f->items + first, run * sizeof *f->items);
        *total += run;
        kept += run;
    }
    return status;
}

froe_status shards_decide(froe_shards *s, const shards_question *q, froe_finds *f, size_t k, froe_status status,
                          froe_diagnostic *diag) {
    size_t total = 0;
    if (s->share) status = shards_share_fetch(s, f, k, status, diag);
    for (size_t i = 0, first = 0, end; i < q->count && !status; i++, first = end) {
        end = f->starts[i + 1];
        status = decide_question(s, q, i, f, k, first, &total, diag);
        f->starts[i + 1] = total;
    }
    return status;
}
