/* sample.c: samples of objects and distributions of values. */
#include "measure/sample.h"
#include "base/radix.h"
#include "base/random.h"
#include "support/fail.h"

void froe_measure_defaults_into(froe_measure_options *out, size_t size) {
    const froe_measure_options all = {.size = size, .samples = 20000, .seed = 1};
    support_defaults(out, size, &all, sizeof all);
}

froe_status measure_sample_begin(const froe_scene *scene, const froe_measure_options *options, const void *out,
                                 measure_sample *sample, froe_diagnostic *diag) {
    froe_measure_options o = options ? *options : froe_measure_defaults();
    *sample = (measure_sample){.scene = scene, .seed = o.seed};
    if (!scene || !out) return support_fail_null(diag, "a measure");
    if (o.size != sizeof o) return support_fail_defaults(diag, "froe_measure_defaults");
    if (o.counting != FROE_COUNT_SEARCH && o.counting != FROE_COUNT_TREES)
        return support_fail(diag, FROE_E_OPTIONS, "There is no way of counting %d.", (int)o.counting);
    sample->alloc = scene->alloc;
    sample->count = o.samples && o.samples < scene->object_count ? o.samples : scene->object_count;
    base_task_init(&sample->task, 1, o.progress, o.user);
    return scene_settle(scene, diag);
}

void measure_sample_free(measure_sample *sample) {
    for (int i = 0; i < 4; i++) array_free(&sample->alloc, &sample->values[i]);
}

froe_status measure_bounds_new(const measure_sample *sample, measure_bounds *out) {
    const froe_scene *scene = sample->scene;
    size_t dim = (size_t)scene->dim;
    out->numbers = scene->object_count * dim;
    out->lo = support_calloc(&sample->alloc, out->numbers, sizeof *out->lo);
    out->hi = support_calloc(&sample->alloc, out->numbers, sizeof *out->hi);
    if (!out->lo || !out->hi) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < scene->object_count; i++)
        scene_object_bounds(scene, i, out->lo + i * dim, out->hi + i * dim);
    return FROE_OK;
}

void measure_bounds_free(const measure_sample *sample, measure_bounds *bounds) {
    size_t bytes = bounds->numbers ? bounds->numbers * sizeof(double) : 1;
    support_free(&sample->alloc, bounds->lo, bytes);
    support_free(&sample->alloc, bounds->hi, bytes);
    *bounds = (measure_bounds){.numbers = 0};
}

uint32_t measure_sample_object(const measure_sample *sample, uint32_t i) {
    uint64_t n = sample->scene->object_count;
    uint32_t from = (uint32_t)(n * i / sample->count), end = (uint32_t)(n * (i + (uint64_t)1) / sample->count);
    return from + base_below(base_hash(sample->seed, i, 0), end - from);
}

uint64_t measure_sample_key(const measure_sample *sample, uint32_t object) {
    const froe_scene *scene = sample->scene;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    uint64_t key = sample->seed;
    scene_object_bounds(scene, object, lo, hi);
    for (int k = 0; k < scene->dim; k++) {
        double extent = 0.5 * scene->hi[k] - 0.5 * scene->lo[k];
        double share[2] = {0, 0};
        if (extent > 0)
            share[0] = (0.5 * lo[k] - 0.5 * scene->lo[k]) / extent, share[1] = (0.5 * hi[k] - 0.5 * lo[k]) / extent;
        for (int i = 0; i < 2; i++) key = base_hash(key, base_double_key(share[i]), (uint64_t)k);
    }
    return key;
}

bool measure_sample_go_on(measure_sample *sample, uint32_t i) {
    return i % 64 || base_progress(&sample->task, (double)i / ((double)sample->count + 1));
}

/** The value that a share of the others does not exceed (nearest rank). */
static double quantile(const double *sorted, size_t count, double share) {
    size_t rank = (size_t)(share * (double)count);
    return sorted[rank < count ? rank : count - 1];
}

froe_status measure_sample_spread(measure_sample *sample, int which, froe_spread *out) {
    double *v = sample->values[which].data, sum = 0;
    size_t count = sample->values[which].count;
    *out = (froe_spread){.count = count};
    if (!count) return FROE_OK;
    base_pair *pairs = support_calloc(&sample->alloc, 2 * count, sizeof *pairs);
    double *sorted = support_calloc(&sample->alloc, count, sizeof *sorted);
    for (size_t i = 0; i < count && pairs; i++) pairs[i] = (base_pair){base_double_key(v[i]), (uint32_t)i};
    if (pairs && sorted) base_radix_sort(pairs, pairs + count, count);
    for (size_t i = 0; i < count && pairs && sorted; i++) sum += sorted[i] = v[pairs[i].value];
    if (pairs && sorted)
        *out = (froe_spread){count,
                             sorted[0],
                             quantile(sorted, count, 0.05),
                             quantile(sorted, count, 0.25),
                             quantile(sorted, count, 0.5),
                             quantile(sorted, count, 0.75),
                             quantile(sorted, count, 0.95),
                             sorted[count - 1],
                             sum / (double)count};
    froe_status status = pairs && sorted ? FROE_OK : FROE_E_MEMORY;
    support_free(&sample->alloc, pairs, 2 * count * sizeof *pairs);
    support_free(&sample->alloc, sorted, count * sizeof *sorted);
    return status;
}

froe_status measure_sample_end(measure_sample *sample, froe_status status, froe_diagnostic *diag) {
    measure_sample_free(sample);
    if (!status && !base_progress(&sample->task, 1)) status = FROE_E_CANCELLED;
    if (status == FROE_E_CANCELLED) return support_fail_cancelled(diag);
    return status == FROE_E_MEMORY ? support_fail_memory(diag) : status;
}
