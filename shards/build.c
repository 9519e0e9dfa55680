/* build.c: folders from batches of objects, by the steps of shard_parts.h.
 *
 *     batches  ->  records, in one nameless file, and a sample      memory: a block
 *     sample   ->  plan
 *     records  ->  buckets, another nameless file                   memory: a block for each shard
 *     bucket   ->  tree, file                                       memory: one shard
 *
 * The first file makes one pass over the input suffice, which may be a pipe. */
#include "folder.h"
#include "record.h"
#include "shard.h"
#include "support/fail.h"
#include "support/floats.h"
#include <math.h>

struct froe_shards_builder {
    int dim;
    uint64_t objects; /* so far */
    froe_shards_options o;
    froe_allocator alloc;
    froe_shard_draft *draft;
    froe_shard_sample *sample;
    froe_shard_buckets *spool, *buckets;
    froe_shard_plan *plan;
    froe_shard_entry *entries;
    froe_shard_records batch;
    const froe_scene *scene; /* whose groups the objects have; NULL: none */
    double *areas;           /* of each group lo and hi, dim doubles each */
    size_t area_count;
    uint32_t *cells;    /* room for all of them */
    uint64_t sorted;    /* objects that are in buckets */
    froe_status failed; /* what a batch has ended in, of which a part may be in the file */
    froe_diagnostic *diag;
};

void froe_shards_defaults_into(froe_shards_options *out, size_t size) {
    const froe_shards_options all = {
        .size = size, .memory = UINT64_C(1) << 32, .method = "auto", .leaf = FROE_LEAF_OWN, .seed = 1};
    support_defaults(out, size, &all, sizeof all);
}

/* Ends the draft, and frees everything else. */
static froe_status end_builder(froe_shards_builder *b, froe_status status, froe_diagnostic *diag) {
    const froe_allocator alloc = b->alloc;
    froe_shard_buckets_free(b->spool);
    froe_shard_buckets_free(b->buckets);
    status = froe_shard_draft_end(b->draft, status, diag);
    froe_shard_sample_free(b->sample);
    if (b->entries) support_free(&alloc, b->entries, froe_shard_plan_count(b->plan) * sizeof *b->entries);
    if (b->cells) support_free(&alloc, b->cells, froe_shard_plan_count(b->plan) * sizeof *b->cells);
    froe_shard_plan_free(b->plan);
    froe_shard_records_free(&b->batch);
    if (b->areas) support_free(&alloc, b->areas, 2 * (size_t)b->dim * b->area_count * sizeof *b->areas);
    support_free(&alloc, b, sizeof *b);
    return status;
}

void froe_shards_abandon(froe_shards_builder *b) {
    if (b) (void)end_builder(b, FROE_E_CANCELLED, NULL);
}

/* Are these options of a tree? A tree of a point tells, before all objects are read; but not what only other objects
 * can: the settings of a method that takes no points, or of that which "auto" will stand for. */
static froe_status try_options(int dim, const froe_shards_options *o, const froe_allocator *alloc,
                               froe_diagnostic *diag) {
    static const double corner[FROE_MAX_DIM];
    const bool automatic = !o->method || !strcmp(o->method, "auto");
    froe_build_options build = froe_build_defaults();
    froe_objects point = froe_objects_defaults();
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_diagnostic why;
    build.method = o->method;
    build.settings = automatic ? NULL : o->settings;
    build.leaf = o->leaf;
    build.purpose = "query";
    build.threads = 1;
    point.kind = FROE_POINT, point.count = 1, point.coords = corner;
    froe_status status = froe_scene_new(dim, alloc, &scene);
    if (!status) status = froe_scene_add(scene, &point, &why);
    if (!status) status = froe_build(scene, &build, &tree, &why);
    froe_tree_free(tree);
    froe_scene_free(scene);
    if (status == FROE_E_MEMORY) return support_fail_memory(diag);
    if (status != FROE_E_OPTIONS) return FROE_OK;
    if (diag) *diag = why;
    return status;
}

froe_status froe_shards_begin(const char *path, int dim, const froe_shards_options *options, froe_shards_builder **out,
                              froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!path || !out) return support_fail_null(diag, __func__);
    const froe_shards_options o = options ? *options : froe_shards_defaults();
    froe_status status = shards_check_options(&o, diag);
    if (status) return status;
    if (dim < 2 || dim > FROE_MAX_DIM)
        return support_fail(diag, FROE_E_ARG, "The dimension %d is not within 2 and %d.", dim, FROE_MAX_DIM);
    if (o.shards > FROE_SHARDS_MOST)
        return support_fail(diag, FROE_E_OPTIONS, "A folder has at most %d shards.", FROE_SHARDS_MOST);
    const froe_allocator alloc = support_allocator(o.alloc);
    if ((status = try_options(dim, &o, &alloc, diag))) return status;
    froe_shards_builder *b = support_calloc(&alloc, 1, sizeof *b);
    if (!b) return support_fail_memory(diag);
    *b = (froe_shards_builder){.dim = dim, .o = o, .alloc = alloc, .batch.alloc = alloc};
    b->o.alloc = &b->alloc;
    status = froe_shard_draft_begin(path, &alloc, &b->draft, diag);
    if (!status && froe_shard_sample_new(dim, &alloc, &b->sample)) status = support_fail_memory(diag);
    if (!status) status = froe_shard_buckets_new(froe_shard_draft_folder(b->draft), 1, &alloc, &b->spool, diag);
    if (status) return end_builder(b, status, diag);
    *out = b;
    return FROE_OK;
}

static froe_status fail_again(const froe_shards_builder *b, froe_diagnostic *diag) {
    return support_fail(diag, b->failed, "Objects that were added before could not be kept, so no folder is built.");
}

/* Hands the batch, of so many objects, on to file and sample. */
static froe_status spool_batch(froe_shards_builder *b, size_t objects, froe_diagnostic *diag) {
    b->failed = froe_shard_buckets_add(b->spool, 0, b->batch.bytes, b->batch.count, diag);
    if (!b->failed && froe_shard_sample_add(b->sample, b->batch.bytes, b->batch.count))
        b->failed = support_fail_memory(diag);
    if (!b->failed) b->objects += objects;
    return b->failed;
}

froe_status froe_shards_add(froe_shards_builder *b, const froe_objects *batch, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!b || !batch) return support_fail_null(diag, __func__);
    if (b->failed) return fail_again(b, diag);
    if (b->scene) return support_fail(diag, FROE_E_ARG, "A scene is all that this folder is made of.");
    if (batch->size != sizeof *batch) return support_fail_defaults(diag, "froe_objects_defaults");
    if (batch->groups || batch->group != FROE_NONE)
        return support_fail(diag, FROE_E_UNSUPPORTED, "A folder of shards takes objects with groups as a scene alone.");
    b->batch.count = 0;
    const froe_status status = froe_shard_records_add(&b->batch, b->dim, batch, b->objects, diag);
    return status ? status : spool_batch(b, batch->count, diag);
}

/* ------------------------------------------------------------------- scenes -- */

/* Adds an object of a scene to the batch. Its form has fewer corners than its kind where it has no length or area; the
 * last corner then stands for those that are left out. */
static froe_status put_scene_object(froe_shards_builder *b, uint32_t object, double **coords, size_t *room,
                                    froe_diagnostic *diag) {
    const froe_object o = froe_scene_object(b->scene, object);
    const uint32_t least = o.kind == FROE_POLYGON ? 3 : o.kind == FROE_SEGMENT || o.kind == FROE_BOX ? 2 : 1;
    const size_t dim = (size_t)b->dim, corners = o.corners > least ? o.corners : least, starts[2] = {0, corners};
    if (corners * dim > *room &&
        !support_array_grow(&b->alloc, (void **)coords, room, 0, corners * dim, sizeof **coords))
        return support_fail_memory(diag);
    for (uint32_t i = 0; i < corners; i++) {
        const uint32_t vertex = froe_scene_corner(b->scene, object, i < o.corners ? i : o.corners - 1);
        memcpy(*coords + i * dim, froe_scene_vertex(b->scene, vertex), dim * sizeof **coords);
    }
    froe_objects batch = froe_objects_defaults();
    batch.kind = o.kind;
    batch.count = 1;
    batch.coords = *coords;
    batch.starts = starts;
    batch.radii = &o.radius;
    batch.tags = &o.tag;
    batch.faces = o.group == FROE_NONE && o.face == object ? NULL : &o.face;
    batch.group = o.group;
    return shards_records_put(&b->batch, b->dim, &batch, object, diag);
}

/* The boxes of all groups. */
static bool find_areas(froe_shards_builder *b) {
    const size_t dim = (size_t)b->dim, groups = froe_scene_group_count(b->scene);
    b->areas = support_calloc(&b->alloc, groups, 2 * dim * sizeof *b->areas);
    if (!b->areas) return false;
    b->area_count = groups;
    for (size_t i = 0; i < groups * 2 * dim; i++) b->areas[i] = i % (2 * dim) < dim ? INFINITY : -INFINITY;
    for (uint32_t i = 0; i < froe_scene_object_count(b->scene); i++) {
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        const uint32_t group = froe_scene_object(b->scene, i).group;
        if (group == FROE_NONE) continue;
        double *area = b->areas + group * 2 * dim;
        shards_scene_box(b->scene, i, lo, hi);
        for (size_t a = 0; a < dim; a++) {
            if (lo[a] < area[a]) area[a] = lo[a];
            if (hi[a] > area[dim + a]) area[dim + a] = hi[a];
        }
    }
    return true;
}

froe_status froe_shards_add_scene(froe_shards_builder *b, const froe_scene *scene, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    enum { BATCH = 4096 };
    if (!b || !scene) return support_fail_null(diag, __func__);
    if (b->failed) return fail_again(b, diag);
    if (b->objects || b->scene || froe_scene_dim(scene) != b->dim)
        return support_fail(diag, FROE_E_ARG, "A scene is all that a folder is made of, and of its dimension.");
    const uint32_t count = (uint32_t)froe_scene_object_count(scene);
    double *coords = NULL;
    size_t room = 0, held = 0;
    froe_status status = froe_scene_check(scene, diag);
    if (status) return status;
    b->scene = scene;
    if (froe_scene_group_count(scene) && !find_areas(b)) status = support_fail_memory(diag);
    b->batch.count = 0;
    for (uint32_t i = 0; i < count && !status; i++) {
        status = put_scene_object(b, i, &coords, &room, diag);
        if (status || (++held < BATCH && i + 1 < count)) continue;
        status = spool_batch(b, held, diag);
        b->batch.count = held = 0;
    }
    if (coords) support_free(&b->alloc, coords, room * sizeof *coords);
    return b->failed = status;
}

/* ------------------------------------------------------------------- finish -- */

/* Tells how much is done: the share of a step among all, about by what they take. False: cancelled. */
static bool progress(const froe_shards_builder *b, double done) {
    const volatile double share = done; /* computed before the floating point is the caller's */
    return !b->o.progress || support_callback(b->o.progress(b->o.user, share));
}

/* Part of the time that putting records into buckets takes. */
static const double sorting_share = 0.15;

static froe_status sort_records(void *user, const void *records, size_t count) {
    SUPPORT_FLOATS_OWN;
    froe_shards_builder *b = user;
    for (size_t at = 0, size; at < count; at += size) {
        const void *record = (const unsigned char *)records + at;
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        size = froe_shard_record_size(record, count - at);
        const shards_object object = shards_record_read(record);
        const size_t dim = (size_t)b->dim;
        const double *area = object.source.group == FROE_NONE ? NULL : b->areas + object.source.group * 2 * dim;
        shards_object_box(&object, lo, hi);
        const uint32_t cells = shards_plan_cells(b->plan, area ? area : lo, area ? area + dim : hi, b->cells);
        for (uint32_t i = 0; i < cells; i++) {
            const froe_status status = froe_shard_buckets_add(b->buckets, b->cells[i], record, size, b->diag);
            if (status) return status;
        }
        b->sorted++;
    }
    return progress(b, sorting_share * (double)b->sorted / (double)b->objects) ? FROE_OK
                                                                               : support_fail_cancelled(b->diag);
}

static froe_status make_buckets(froe_shards_builder *b, froe_diagnostic *diag) {
    if (!b->objects) return support_fail(diag, FROE_E_INPUT, "There are no objects.");
    froe_status status = froe_shard_plan_new(b->sample, b->o.shards, b->o.memory, &b->plan, diag);
    if (status) return status;
    const uint32_t count = b->plan->count;
    b->plan->areas = b->areas != NULL;
    froe_shard_sample_free(b->sample);
    b->sample = NULL;
    b->cells = support_calloc(&b->alloc, count, sizeof *b->cells);
    b->entries = support_calloc(&b->alloc, count, sizeof *b->entries);
    if (!b->cells || !b->entries) return support_fail_memory(diag);
    status = froe_shard_buckets_new(froe_shard_draft_folder(b->draft), count, &b->alloc, &b->buckets, diag);
    b->diag = diag;
    if (!status) status = froe_shard_buckets_take(b->spool, 0, sort_records, b, diag);
    froe_shard_buckets_free(b->spool);
    b->spool = NULL;
    return status;
}

static froe_status gather_records(void *user, const void *records, size_t count) {
    SUPPORT_FLOATS_OWN;
    froe_shards_builder *b = user;
    return froe_shard_records_append(&b->batch, records, count, b->diag);
}

/* How far the building of a shard is, within the whole. */
typedef struct shard_progress {
    const froe_shards_builder *builder;
    double before, share;
} shard_progress;

static bool pass_progress(void *user, double done) {
    SUPPORT_FLOATS_OWN;
    const shard_progress *p = user;
    return progress(p->builder, p->before + p->share * done);
}

static froe_status build_all(froe_shards_builder *b, froe_diagnostic *diag) {
    froe_shards_options o = b->o;
    shard_progress part = {.builder = b, .before = sorting_share, .share = (1 - sorting_share) / b->plan->count};
    o.progress = b->o.progress ? pass_progress : NULL;
    o.user = &part;
    froe_status status = FROE_OK;
    for (uint32_t i = 0; i < b->plan->count && !status; i++) {
        froe_shard_records_free(&b->batch);
        status = froe_shard_buckets_take(b->buckets, i, gather_records, b, diag);
        if (!status)
            status = froe_shard_build(&b->batch, b->plan, i, b->scene, &o, froe_shard_draft_folder(b->draft),
                                      b->entries + i, diag);
        part.before += part.share;
        if (!status && !progress(b, part.before)) status = support_fail_cancelled(diag);
    }
    if (!status)
        status = froe_shard_manifest_write(b->plan, b->entries, froe_shard_draft_folder(b->draft), &b->alloc, diag);
    return status;
}

froe_status froe_shards_finish(froe_shards_builder *b, froe_shards_report *out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!b) return support_fail_null(diag, __func__);
    froe_shards_report report = {0};
    froe_status status = b->failed ? fail_again(b, diag) : make_buckets(b, diag);
    if (!status) status = build_all(b, diag);
    if (!status) report = froe_shard_report(b->plan, b->entries);
    status = end_builder(b, status, diag);
    if (!status && out) *out = report;
    return status;
}
