/* record.c: see record.h. */
#include "record.h"
#include "support/fail.h"
#include "support/floats.h"
#include <float.h>
#include <math.h>

enum { MOST_BYTES = INT32_MAX }; /* of a record */

/* ------------------------------------------------------------------ reading -- */

/* Has a kind so many corners? */
static bool may_have_corners(froe_kind kind, size_t corners) {
    switch (kind) {
    case FROE_POINT:
    case FROE_BALL:
        return corners == 1;
    case FROE_SEGMENT:
    case FROE_BOX:
        return corners == 2;
    case FROE_POLYGON:
        return corners >= 3;
    default:
        return corners >= 1;
    }
}

/* Does the head say what reading relies on? */
static bool is_head(const shards_record *record) {
    const size_t fixed = (sizeof *record + (record->sourced ? sizeof(shards_source) : 0)) / 8;
    const size_t numbers = record->words - fixed - (record->kind == FROE_BALL), dim = record->dim;
    if (record->kind >= FROE_KIND_COUNT || dim < 2 || dim > FROE_MAX_DIM || record->sourced > 1 || record->unused)
        return false;
    if (record->words <= fixed + (record->kind == FROE_BALL) || numbers % dim) return false;
    return record->words <= MOST_BYTES / 8 && may_have_corners((froe_kind)record->kind, numbers / dim);
}

size_t froe_shard_record_size(const void *bytes, size_t left) {
    if (left < sizeof(shards_record)) return 0;
    const shards_record *record = shards_record_at(bytes, 0);
    const size_t size = shards_record_bytes(record);
    return size <= left && is_head(record) && shards_record_read(record).source.group <= FROE_NONE ? size : 0;
}

bool shards_record_is_none(const void *bytes, size_t left) {
    if (left < sizeof(shards_record)) return false;
    const shards_record *record = shards_record_at(bytes, 0);
    return !is_head(record) || (shards_record_bytes(record) <= left && !froe_shard_record_size(bytes, left));
}

/* A ball that reaches beyond the largest double is refused, so that no box has to. */
void shards_widen_box(int dim, double radius, double *lo, double *hi) {
    for (int a = 0; a < dim; a++) {
        lo[a] = fmax(nextafter(lo[a] - radius, -INFINITY), -DBL_MAX);
        hi[a] = fmin(nextafter(hi[a] + radius, INFINITY), DBL_MAX);
    }
}

void froe_shard_record_box(const void *record, double *lo, double *hi) {
    SUPPORT_FLOATS_OWN;
    const shards_object o = shards_record_read(record);
    shards_object_box(&o, lo, hi);
}

int shards_record_compare(const shards_record *a, const shards_record *b) {
    if (a->words != b->words) return a->words < b->words ? -1 : 1;
    return memcmp(a, b, shards_record_bytes(a));
}

/* As measured with trees of method index of the plane and of space: objects, corners and their vertices while the tree
 * is built, beside the record itself and the place of its order. */
uint64_t shards_record_weight(const shards_record *record) {
    enum { OBJECT = 72, CORNER = 40 };
    const shards_object o = shards_record_read(record);
    return shards_record_bytes(record) + OBJECT + o.corners * (CORNER + 8 * (size_t)o.dim);
}

/* ------------------------------------------------------------------ writing -- */

/* How many corners object i of a batch has. */
static size_t corners_in_batch(const froe_objects *batch, size_t i) {
    switch (batch->kind) {
    case FROE_SEGMENT:
    case FROE_BOX:
        return 2;
    case FROE_POLYGON:
    case FROE_HULL:
        return batch->starts ? batch->starts[i + 1] - batch->starts[i] : 3;
    default:
        return 1;
    }
}

/* Which point is corner `corner` of a batch? */
static const double *batch_point(const froe_objects *batch, size_t corner, size_t dim) {
    return batch->coords + (batch->indices ? batch->indices[corner] : corner) * dim;
}

/* A scene says what is wrong with a batch, or that nothing is. */
static froe_status check_in_scene(const froe_allocator *alloc, int dim, const froe_objects *batch,
                                  froe_diagnostic *diag) {
    froe_scene *scene;
    froe_objects bare = *batch;
    bare.groups = NULL, bare.group = FROE_NONE, bare.progress = NULL;
    froe_status status = froe_scene_new(dim, alloc, &scene);
    if (status == FROE_E_MEMORY) return support_fail_memory(diag);
    if (status) return support_fail(diag, status, "The dimension %d is not within 2 and %d.", dim, FROE_MAX_DIM);
    status = froe_scene_add(scene, &bare, diag);
    froe_scene_free(scene);
    return status;
}

/* Are the bounds of a ball certain to be doubles? */
static bool is_bounded(int dim, const double *middle, double radius) {
    for (int a = 0; a < dim; a++)
        if (!(fabs(middle[a]) + radius < DBL_MAX)) return false;
    return true;
}

/* Can only a scene tell whether a batch is right? What is numbers alone is right if these are finite, radii no less
 * than 0, the bounds of balls doubles, and the corners of boxes in order. */
static bool is_doubtful(int dim, const froe_objects *batch) {
    if (dim < 2 || dim > FROE_MAX_DIM || !batch->coords || batch->indices) return true;
    if (batch->kind != FROE_POINT && batch->kind != FROE_SEGMENT && batch->kind != FROE_BOX && batch->kind != FROE_BALL)
        return true;
    const size_t each = corners_in_batch(batch, 0) * (size_t)dim;
    for (size_t i = 0; i < batch->count * each; i++)
        if (!isfinite(batch->coords[i])) return true;
    for (size_t i = 0; i < batch->count && batch->kind == FROE_BALL; i++)
        if (!batch->radii || !(batch->radii[i] >= 0) || !is_bounded(dim, batch->coords + i * each, batch->radii[i]))
            return true;
    for (size_t i = 0; i < batch->count && batch->kind == FROE_BOX; i++)
        for (int a = 0; a < dim; a++)
            if (batch->coords[i * each + (size_t)a] > batch->coords[i * each + (size_t)(dim + a)]) return true;
    return false;
}

/* Writes an object, for which there is room. */
static void write_record(unsigned char *at, int dim, const froe_objects *batch, size_t i, uint64_t first,
                         size_t words) {
    const bool sourced = batch->faces || batch->groups || batch->group != FROE_NONE;
    const size_t corners = corners_in_batch(batch, i), begin = batch->starts ? batch->starts[i] : i * corners;
    const shards_record head = {.words = (uint32_t)words,
                                .kind = (uint8_t)batch->kind,
                                .dim = (uint8_t)dim,
                                .sourced = sourced,
                                .tag = batch->tags ? batch->tags[i] : first + i};
    const shards_source source = {.face = batch->faces ? batch->faces[i] : first + i,
                                  .group = batch->groups ? batch->groups[i] : batch->group};
    memcpy(at, &head, sizeof head);
    at += sizeof head;
    if (sourced) memcpy(at, &source, sizeof source);
    double *numbers = (double *)(void *)(at + (sourced ? sizeof source : 0));
    for (size_t c = 0; c < corners; c++) {
        const double *point = batch_point(batch, begin + c, (size_t)dim);
        for (int a = 0; a < dim; a++) *numbers++ = point[a] + 0.0;
    }
    if (batch->kind == FROE_BALL) *numbers = batch->radii[i] + 0.0;
}

froe_status shards_records_put(froe_shard_records *records, int dim, const froe_objects *batch, uint64_t first,
                               froe_diagnostic *diag) {
    const bool sourced = batch->faces || batch->groups || batch->group != FROE_NONE;
    const size_t before = records->count, fixed = sizeof(shards_record) + (sourced ? sizeof(shards_source) : 0);
    for (size_t i = 0; i < batch->count; i++) {
        const size_t numbers = corners_in_batch(batch, i) * (size_t)dim + (batch->kind == FROE_BALL);
        const size_t size = fixed + 8 * numbers;
        froe_status status = FROE_OK;
        if (size > MOST_BYTES)
            status = support_fail_at(diag, FROE_E_LIMIT, (uint32_t)i, FROE_NONE, FROE_NONE,
                                     "Object %zu takes more than 2^31 bytes.", i);
        else if (!shards_records_reserve(records, size))
            status = support_fail_memory(diag);
        if (status) {
            records->count = before;
            return status;
        }
        write_record(records->bytes + records->count, dim, batch, i, first, size / 8);
        records->count += size;
    }
    return FROE_OK;
}

froe_status froe_shard_records_add(froe_shard_records *records, int dim, const froe_objects *batch, uint64_t first,
                                   froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!records || !batch) return support_fail_null(diag, __func__);
    records->alloc = support_allocator(&records->alloc);
    if (batch->size != sizeof *batch) return support_fail_defaults(diag, "froe_objects_defaults");
    if (batch->count && is_doubtful(dim, batch)) {
        const froe_status status = check_in_scene(&records->alloc, dim, batch, diag);
        if (status) return status;
    }
    return shards_records_put(records, dim, batch, first, diag);
}

froe_status froe_shard_records_append(froe_shard_records *records, const void *bytes, size_t count,
                                      froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!records || (count && !bytes)) return support_fail_null(diag, __func__);
    if (!count) return FROE_OK;
    records->alloc = support_allocator(&records->alloc);
    const uintptr_t place = (uintptr_t)bytes - (uintptr_t)records->bytes; /* they may be records of its own */
    const bool own = place < records->count;
    if (!shards_records_reserve(records, count)) return support_fail_memory(diag);
    memcpy(records->bytes + records->count, own ? records->bytes + place : bytes, count);
    records->count += count;
    return FROE_OK;
}

void froe_shard_records_free(froe_shard_records *records) {
    if (!records) return;
    records->alloc = support_allocator(&records->alloc);
    support_free(&records->alloc, records->bytes, records->capacity);
    records->bytes = NULL;
    records->count = records->capacity = 0;
}
