/* sample.h: what measures share: the sample of objects, the distribution of values, and progress. */
#ifndef FROE_MEASURE_SAMPLE_H
#define FROE_MEASURE_SAMPLE_H
#include "base/task.h"
#include "scene/scene.h"
#include "support/array.h"
#include <froe/measure.h>

typedef struct measure_sample {
    const froe_scene *scene;
    froe_allocator alloc;
    base_task task;
    uint64_t seed;
    uint32_t count; /**< of objects measured */
    ARRAY(double) values[4];
} measure_sample;

/** Takes the options (NULL: the defaults). FROE_E_ARG, FROE_E_OPTIONS. Free it in any case. */
froe_status measure_sample_begin(const froe_scene *scene, const froe_measure_options *options, const void *out,
                                 measure_sample *sample, froe_diagnostic *diag);
void measure_sample_free(measure_sample *sample);
/** The bounding boxes of all objects, dim numbers each. */
typedef struct measure_bounds {
    double *lo, *hi;
    size_t numbers; /**< of each array */
} measure_bounds;
/** FROE_E_MEMORY; free them in any case. */
froe_status measure_bounds_new(const measure_sample *sample, measure_bounds *out);
void measure_bounds_free(const measure_sample *sample, measure_bounds *bounds);
/** Object i of the sample: one at random of each of `count` equal runs of ids. */
uint32_t measure_sample_object(const measure_sample *sample, uint32_t i);
/** A number that identifies an object by its place and extent in the scene: the same in any order and at any scale 2^k.
 * So random choices that start from it are the same, too. */
uint64_t measure_sample_key(const measure_sample *sample, uint32_t object);
/** Reports progress; false: cancelled. To be called for each object. */
bool measure_sample_go_on(measure_sample *sample, uint32_t i);
/** How the values noted in list `which` are distributed; sorts them. FROE_E_MEMORY. */
froe_status measure_sample_spread(measure_sample *sample, int which, froe_spread *out);
/** Turns a status into what a public function returns. */
froe_status measure_sample_end(measure_sample *sample, froe_status status, froe_diagnostic *diag);
#endif
