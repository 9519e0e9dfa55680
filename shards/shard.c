/* shard.c: see shard.h. Objects have the order of their tags, and of equal tags that of their bytes, so that a tree is
 * a function of the set of its objects. */
#define _GNU_SOURCE 1 /* sync_file_range */
#include "shard.h"
#include "support/fail.h"
#include "support/floats.h"
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

void shards_file_name(char *out, size_t size, const char *folder, uint32_t shard) {
    snprintf(out, size, "%s/shard-%04u.froe", folder, shard);
}

ssize_t shards_read_at(int file, void *to, size_t count, off_t place) {
    size_t done = 0;
    while (done < count) {
        const ssize_t got = pread(file, (unsigned char *)to + done, count - done, place + (off_t)done);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return -1;
        if (!got) break;
        done += (size_t)got;
    }
    return (ssize_t)done;
}

froe_status shards_file_check(const char *path, uint64_t *bytes, uint64_t *check, froe_diagnostic *diag) {
    enum { HEADER = 64, CHECK_AT = 56 };
    unsigned char header[HEADER];
    struct stat info;
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0 || fstat(file, &info)) {
        const int error = errno;
        if (file >= 0) close(file);
        return support_fail_file(diag, "read", path, error);
    }
    const ssize_t got = S_ISREG(info.st_mode) ? shards_read_at(file, header, sizeof header, 0) : 0;
    const int error = errno;
    close(file);
    if (!S_ISREG(info.st_mode)) return support_fail_irregular(diag, path, info.st_mode);
    if (got < 0) return support_fail_file(diag, "read", path, error);
    if (got < HEADER) return support_fail(diag, FROE_E_FORMAT, "%s: The file is too short.", support_short(path));
    *bytes = (uint64_t)info.st_size;
    *check = 0;
    for (int i = 7; i >= 0; i--) *check = *check << 8 | header[CHECK_AT + i];
    return FROE_OK;
}

/* -------------------------------------------------------------------- order -- */

typedef struct shard_rank {
    uint64_t tag;
    const shards_record *record;
} shard_rank;

static int by_tag_then_bytes(const void *a, const void *b) {
    const shard_rank *x = a, *y = b;
    if (x->tag != y->tag) return x->tag < y->tag ? -1 : 1;
    return shards_record_compare(x->record, y->record);
}

/* Every record in its place. NULL: no memory. */
static shard_rank *rank_records(const froe_shard_records *records, const froe_allocator *alloc, size_t *count) {
    *count = 0;
    for (size_t at = 0; at < records->count; at += shards_record_bytes(shards_record_at(records->bytes, at))) ++*count;
    shard_rank *order = support_calloc(alloc, *count, sizeof *order);
    bool sorted = true;
    for (size_t i = 0, at = 0; order && i < *count; i++) {
        const shards_record *record = shards_record_at(records->bytes, at);
        order[i] = (shard_rank){record->tag, record};
        sorted = sorted && (!i || by_tag_then_bytes(order + i - 1, order + i) <= 0);
        at += shards_record_bytes(record);
    }
    if (order && !sorted) qsort(order, *count, sizeof *order, by_tag_then_bytes);
    return order;
}

/* ------------------------------------------------------------------ sources -- */

/* Where objects come from. A face is numbered by its first object in the shard. Groups have the same numbers in all
 * shards, so that each has all of them up to its last; those without objects in it have no names there. */
typedef struct shard_sources {
    uint32_t *faces, *groups; /* of each object; NULL: there are none */
    bool *present;            /* of each group: has it objects here? */
    size_t group_count;
} shard_sources;

typedef struct source_number {
    uint64_t number;
    size_t object;
} source_number;

static int by_source_number(const void *a, const void *b) {
    const source_number *x = a, *y = b;
    if (x->number != y->number) return x->number < y->number ? -1 : 1;
    return (x->object > y->object) - (x->object < y->object);
}

static bool find_sources(const shard_rank *order, size_t count, const froe_allocator *alloc, shard_sources *out) {
    size_t sourced = 0;
    for (size_t i = 0; i < count; i++) sourced += order[i].record->sourced;
    if (!sourced) return true;
    source_number *list = support_calloc(alloc, sourced, sizeof *list);
    out->faces = support_calloc(alloc, count, sizeof *out->faces);
    out->groups = support_calloc(alloc, count, sizeof *out->groups);
    const bool ok = list && out->faces && out->groups;
    for (size_t i = 0, n = 0; i < count && ok; i++) {
        const shards_source source = shards_record_read(order[i].record).source;
        out->faces[i] = (uint32_t)i;
        out->groups[i] = (uint32_t)source.group;
        if (source.group != FROE_NONE && source.group >= out->group_count) out->group_count = source.group + 1;
        if (order[i].record->sourced) list[n++] = (source_number){source.face, i};
    }
    if (ok) qsort(list, sourced, sizeof *list, by_source_number);
    for (size_t i = 1; i < sourced && ok; i++)
        if (list[i].number == list[i - 1].number) out->faces[list[i].object] = out->faces[list[i - 1].object];
    if (list) support_free(alloc, list, sourced * sizeof *list);
    out->present = support_calloc(alloc, out->group_count, sizeof *out->present);
    for (size_t i = 0; i < count && ok && out->present; i++)
        if (out->groups[i] != FROE_NONE) out->present[out->groups[i]] = true;
    return ok && out->present;
}

static void free_sources(shard_sources *s, size_t count, const froe_allocator *alloc) {
    if (s->faces) support_free(alloc, s->faces, count * sizeof *s->faces);
    if (s->groups) support_free(alloc, s->groups, count * sizeof *s->groups);
    if (s->present) support_free(alloc, s->present, s->group_count * sizeof *s->present);
}

/* -------------------------------------------------------------------- scene -- */

/* Objects of one kind on their way into a scene. */
typedef struct shard_batch {
    ARRAY(double) coords, radii;
    ARRAY(uint64_t) tags;
    ARRAY(size_t) starts;
    size_t first; /* the object it begins with */
    froe_kind kind;
} shard_batch;

static bool put_in_batch(shard_batch *b, const shards_object *o, const froe_allocator *alloc) {
    b->kind = o->kind;
    return (b->starts.count || array_push(alloc, &b->starts, 0)) &&
           array_append(alloc, &b->coords, o->numbers, o->corners * (size_t)o->dim) &&
           array_push(alloc, &b->radii, o->radius) && array_push(alloc, &b->tags, o->tag) &&
           array_push(alloc, &b->starts, b->coords.count / (size_t)o->dim);
}

static froe_status add_batch(froe_scene *scene, shard_batch *b, const shard_sources *sources, unsigned threads,
                             froe_diagnostic *diag) {
    if (!b->tags.count) return FROE_OK;
    froe_diagnostic why;
    froe_objects objects = froe_objects_defaults();
    objects.kind = b->kind;
    objects.count = b->tags.count;
    objects.coords = b->coords.data;
    objects.tags = b->tags.data;
    objects.radii = b->kind == FROE_BALL ? b->radii.data : NULL;
    objects.starts = b->kind == FROE_POLYGON || b->kind == FROE_HULL ? b->starts.data : NULL;
    objects.faces = sources->faces ? sources->faces + b->first : NULL;
    objects.groups = sources->groups ? sources->groups + b->first : NULL;
    objects.threads = threads;
    const froe_status status = froe_scene_add(scene, &objects, &why);
    if (status && diag) {
        *diag = why;
        if (why.object < b->tags.count)
            return support_fail(diag, status, "tag %llu: %s", (unsigned long long)b->tags.data[why.object],
                                why.message);
    }
    b->first += b->tags.count;
    b->coords.count = b->radii.count = b->tags.count = b->starts.count = 0;
    return status;
}

static froe_status add_objects(froe_scene *scene, const shard_rank *order, size_t count, const shard_sources *sources,
                               const froe_shards_options *o, const froe_allocator *alloc, froe_diagnostic *diag) {
    enum { BATCH = 1 << 16 };
    shard_batch batch = {0};
    froe_status status = FROE_OK;
    for (size_t i = 0; i < count && !status; i++) {
        const shards_object object = shards_record_read(order[i].record);
        if (batch.tags.count && (object.kind != batch.kind || batch.coords.count >= BATCH))
            status = add_batch(scene, &batch, sources, o->threads, diag);
        if (!status && !put_in_batch(&batch, &object, alloc)) status = support_fail_memory(diag);
    }
    if (!status) status = add_batch(scene, &batch, sources, o->threads, diag);
    array_free(alloc, &batch.coords);
    array_free(alloc, &batch.radii);
    array_free(alloc, &batch.tags);
    array_free(alloc, &batch.starts);
    return status;
}

/* What a shard takes over from the scene that the objects came from. */
static froe_status take_over(froe_scene *scene, const froe_scene *from, const shard_sources *sources,
                             froe_diagnostic *diag) {
    if (!from) return FROE_OK;
    const froe_crs crs = froe_scene_crs(from);
    const int up = froe_scene_up(from);
    froe_status status = crs.kind == FROE_CRS_UNKNOWN ? FROE_OK : froe_scene_set_crs(scene, &crs);
    if (!status && up >= 0) status = froe_scene_set_up(scene, up);
    for (size_t i = 0; i < sources->group_count && !status; i++) {
        uint32_t id;
        const froe_group group = sources->present[i] ? froe_scene_group(from, (uint32_t)i) : (froe_group){0};
        status = froe_scene_add_group(scene, &group, &id);
    }
    return status ? support_fail_memory(diag) : FROE_OK;
}

/* The objects of the records in a scene, which the caller frees also after a failure. */
static froe_status make_scene(const froe_shard_records *records, int dim, const froe_scene *from,
                              const froe_shards_options *o, const froe_allocator *alloc, froe_scene **out,
                              froe_diagnostic *diag) {
    size_t count;
    shard_sources sources = {0};
    shard_rank *order = rank_records(records, alloc, &count);
    froe_status status = order && find_sources(order, count, alloc, &sources) ? FROE_OK : support_fail_memory(diag);
    if (!status && froe_scene_new(dim, alloc, out)) status = support_fail_memory(diag);
    if (!status) status = take_over(*out, from, &sources, diag);
    if (!status) status = add_objects(*out, order, count, &sources, o, alloc, diag);
    free_sources(&sources, count, alloc);
    if (order) support_free(alloc, order, count * sizeof *order);
    return status;
}

/* --------------------------------------------------------------------- tree -- */

/* Are these whole records of objects that belong into a cell, with groups of the scene? */
static froe_status check_records(const froe_shard_records *records, const froe_shard_plan *plan, uint32_t cell,
                                 const froe_scene *scene, froe_diagnostic *diag) {
    const double *cell_lo = shards_cell_lo(plan, cell), *cell_hi = shards_cell_hi(plan, cell);
    const size_t groups = scene ? froe_scene_group_count(scene) : 0;
    for (size_t at = 0, size; at < records->count; at += size) {
        const shards_record *record = shards_record_at(records->bytes, at);
        size = froe_shard_record_size(record, records->count - at);
        if (!size || record->dim != plan->dim)
            return support_fail(diag, FROE_E_ARG, "At byte %zu there is no whole record of an object of dimension %d.",
                                at, plan->dim);
        const shards_object o = shards_record_read(record);
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        shards_object_box(&o, lo, hi);
        if (!plan->areas && !shards_boxes_meet(lo, hi, cell_lo, cell_hi, plan->dim))
            return support_fail(diag, FROE_E_ARG, "tag %llu: The object does not meet the cell of shard %u.",
                                (unsigned long long)o.tag, cell);
        if (o.source.group != FROE_NONE && !scene)
            return support_fail(diag, FROE_E_UNSUPPORTED, "Objects have groups, and there is no scene that has them.");
        if (o.source.group != FROE_NONE && o.source.group >= groups)
            return support_fail(diag, FROE_E_INPUT, "tag %llu: The scene has no group %llu.", (unsigned long long)o.tag,
                                (unsigned long long)o.source.group);
    }
    return FROE_OK;
}

void shards_entry_bound(froe_shard_entry *e, const froe_shard_plan *plan, uint32_t cell, const double *lo,
                        const double *hi, bool first) {
    const double *cell_lo = shards_cell_lo(plan, cell), *cell_hi = shards_cell_hi(plan, cell);
    for (int a = 0; a < plan->dim; a++) {
        const double x = lo[a] > cell_lo[a] ? lo[a] : cell_lo[a], y = hi[a] < cell_hi[a] ? hi[a] : cell_hi[a];
        e->lo[a] = first || x < e->lo[a] ? x : e->lo[a];
        e->hi[a] = first || y > e->hi[a] ? y : e->hi[a];
    }
}

/* Bounds and counts of the objects in a cell. Those that are here for their group alone have no part in it. */
static void describe_shard(const froe_shard_records *records, const froe_shard_plan *plan, uint32_t cell,
                           froe_shard_entry *e) {
    const double *cell_lo = shards_cell_lo(plan, cell), *cell_hi = shards_cell_hi(plan, cell);
    bool any = false;
    for (size_t at = 0; at < records->count; at += shards_record_bytes(shards_record_at(records->bytes, at))) {
        const shards_object object = shards_record_read(shards_record_at(records->bytes, at));
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        shards_object_box(&object, lo, hi);
        e->objects++;
        if (!shards_boxes_meet(lo, hi, cell_lo, cell_hi, plan->dim)) continue;
        e->own += shards_plan_first(plan, lo) == cell;
        shards_entry_bound(e, plan, cell, lo, hi, !any);
        any = true;
    }
}

froe_shards_report froe_shard_report(const froe_shard_plan *plan, const froe_shard_entry *entries) {
    froe_shards_report r = {0};
    if (!plan || !entries) return r;
    r.shards = plan->count;
    for (uint32_t i = 0; i < plan->count; i++) {
        const froe_shard_entry *e = &entries[i];
        r.objects += e->own;
        r.copies += e->objects;
        r.bytes += e->bytes;
        r.most = e->objects > r.most ? e->objects : r.most;
    }
    return r;
}

froe_status shards_check_options(const froe_shards_options *options, froe_diagnostic *diag) {
    return options->size == sizeof *options ? FROE_OK : support_fail_defaults(diag, "froe_shards_defaults");
}

static bool put_bytes(void *file, const void *bytes, size_t count) {
    return fwrite(bytes, 1, count, file) == count;
}

/* Lets the system begin to write what it holds of a file, which is waited for when the draft is brought to its place:
 * see draft.c. */
static void begin_writeback(FILE *file) {
#ifdef SYNC_FILE_RANGE_WRITE
    (void)sync_file_range(fileno(file), 0, 0, SYNC_FILE_RANGE_WRITE);
#else
    (void)file;
#endif
}

static froe_status write_tree(const froe_tree *tree, const char *path, froe_diagnostic *diag) {
    FILE *file = fopen(path, "wbe");
    if (!file) return support_fail_file(diag, "written", path, errno);
    errno = 0;
    froe_status status = froe_tree_write(tree, put_bytes, file, diag);
    const bool failed = fflush(file) || ferror(file);
    if (failed && (!status || status == FROE_E_IO))
        status = support_fail_file(diag, "written", path, errno ? errno : EIO);
    if (!status) begin_writeback(file);
    if (fclose(file) && !status) status = support_fail_file(diag, "written", path, errno);
    return status;
}

static froe_status save_tree(const froe_tree *tree, const char *folder, uint32_t cell, const froe_allocator *alloc,
                             froe_shard_entry *e, froe_diagnostic *diag) {
    const size_t size = strlen(folder) + SHARDS_NAME;
    char *path = support_realloc(alloc, NULL, 0, size);
    if (!path) return support_fail_memory(diag);
    shards_file_name(path, size, folder, cell);
    froe_status status = write_tree(tree, path, diag);
    if (!status) status = shards_file_check(path, &e->bytes, &e->check, diag);
    support_free(alloc, path, size);
    return status;
}

froe_status froe_shard_build(froe_shard_records *records, const froe_shard_plan *plan, uint32_t cell,
                             const froe_scene *scene, const froe_shards_options *options, const char *folder,
                             froe_shard_entry *out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!records || !plan || !options || !folder || !out) return support_fail_null(diag, __func__);
    if (cell >= plan->count) return support_fail(diag, FROE_E_ARG, "There is no shard %u.", cell);
    froe_status status = shards_check_options(options, diag);
    if (!status) status = check_records(records, plan, cell, scene, diag);
    if (status) return status;
    const froe_allocator alloc = support_allocator(options->alloc);
    froe_scene *own = NULL;
    froe_tree *tree = NULL;
    froe_shard_entry entry = {0};
    describe_shard(records, plan, cell, &entry);
    if (entry.objects) {
        status = make_scene(records, plan->dim, scene, options, &alloc, &own, diag);
        froe_shard_records_free(records);
        froe_build_options o = froe_build_defaults();
        o.method = options->method;
        o.purpose = "query";
        o.settings = options->settings;
        o.leaf = options->leaf;
        o.seed = options->seed;
        o.threads = options->threads;
        o.progress = options->progress;
        o.user = options->user;
        if (!status) status = froe_build(own, &o, &tree, diag);
        if (!status) status = save_tree(tree, folder, cell, &alloc, &entry, diag);
        froe_tree_free(tree);
        froe_scene_free(own);
    }
    if (!status) *out = entry;
    return status;
}
