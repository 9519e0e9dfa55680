/* decide.c: which of several objects comes first, where their values are equal as doubles and their trees differ?
 *
 * They become a tree of their own, in the order of their tags, which is asked the same question. It compares exact
 * values, and goes by its ids where these are equal, that is, by tags. */
#include "ask.h"
#include "support/fail.h"

/* Adds a copy of an object of a scene. Its form has fewer corners than its kind where it has no length or area; the
 * last corner then stands for those that are left out. */
static froe_status copy_object(froe_scene *to, const froe_scene *from, uint32_t object, const froe_allocator *alloc,
                               froe_diagnostic *diag) {
    const froe_object o = froe_scene_object(from, object);
    const uint32_t least = o.kind == FROE_POLYGON ? 3 : o.kind == FROE_SEGMENT || o.kind == FROE_BOX ? 2 : 1;
    const size_t dim = (size_t)froe_scene_dim(from), corners = o.corners > least ? o.corners : least;
    const size_t starts[2] = {0, corners};
    double *coords = support_calloc(alloc, corners * dim, sizeof *coords);
    if (!coords) return support_fail_memory(diag);
    for (uint32_t i = 0; i < corners; i++) {
        const uint32_t vertex = froe_scene_corner(from, object, i < o.corners ? i : o.corners - 1);
        memcpy(coords + i * dim, froe_scene_vertex(from, vertex), dim * sizeof *coords);
    }
    froe_objects batch = froe_objects_defaults();
    batch.kind = o.kind;
    batch.count = 1;
    batch.coords = coords;
    batch.starts = o.kind == FROE_POLYGON || o.kind == FROE_HULL ? starts : NULL;
    batch.radii = o.kind == FROE_BALL ? &o.radius : NULL;
    batch.threads = 1;
    const froe_status status = froe_scene_add(to, &batch, diag);
    support_free(alloc, coords, corners * dim * sizeof *coords);
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
    for (size_t j = 0; j < count && !status; j++)
        status = copy_object(scene, froe_tree_scene(s->slots[items[j].shard].tree), items[j].object, &s->alloc, diag);
    if (!status) status = froe_build(scene, &o, &tree, diag);
    if (!status) status = froe_query_new(tree, &query, diag);
    if (!status) status = q->ask(q, query, &i, 1, &one, out, diag);
    froe_query_free(query);
    froe_tree_free(tree);
    froe_scene_free(scene);
    return status;
}

/* Puts `count` answers of equal values into their order, which they have if they are of one shard. Those that the
 * question has no room for come last, and *count becomes the number of the others. */
static froe_status decide_run(froe_shards *s, const shards_question *q, size_t i, froe_find *items, size_t *count,
                              froe_diagnostic *diag) {
    bool several = false;
    for (size_t j = 1; j < *count; j++) several = several || items[j].shard != items[0].shard;
    if (!several) return FROE_OK;
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

/* Decides the answers of a question, and returns how many of them stay by *kept. */
static froe_status decide_question(froe_shards *s, const shards_question *q, size_t i, froe_find *items, size_t count,
                                   size_t k, size_t *kept, froe_diagnostic *diag) {
    froe_status status = FROE_OK;
    *kept = 0;
    for (size_t first = 0, end; first < count && *kept < k && !status; first = end) {
        for (end = first + 1; end < count && items[end].value == items[first].value;) end++;
        size_t run = end - first;
        status = run > 1 ? decide_run(s, q, i, items + first, &run, diag) : FROE_OK;
        if (run > k - *kept) run = k - *kept;
        memmove(items + *kept, items + first, run * sizeof *items);
        *kept += run;
    }
    return status;
}

froe_status shards_decide(froe_shards *s, const shards_question *q, froe_finds *f, size_t k, froe_diagnostic *diag) {
    froe_status status = FROE_OK;
    size_t total = 0;
    for (size_t i = 0, first = 0, end; i < q->count && !status; i++, first = end) {
        size_t kept;
        end = f->starts[i + 1];
        status = decide_question(s, q, i, f->items + first, end - first, k, &kept, diag);
        memmove(f->items + total, f->items + first, kept * sizeof *f->items);
        f->starts[i + 1] = total += kept;
    }
    return status;
}
