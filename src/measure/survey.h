/* survey.h: the objects of a scene whose pairs are examined, and what each worker needs for a pair.
 *
 *     objects -> distinct ones with length or area, in R^2 and R^3 -> their boxes -> pairs, passed to workers
 *
 * Each worker keeps counts of its own. They are added, and the least example pair is kept, so that no report depends on
 * the number of threads. */
#ifndef FROE_MEASURE_SURVEY_H
#define FROE_MEASURE_SURVEY_H
#include "geom/meet/contact.h"
#include "measure/odd_pairs.h"

typedef struct measure_worker {
    num_context context;
    bool ready;
    signed char *sides; /**< of the corners of two polygons */
} measure_worker;

typedef struct measure_survey {
    const froe_scene *scene;
    base_task task;
    measure_worker *workers; /**< task.threads of them, if there are two objects */
    size_t side_count, room; /**< room: bytes of objects */
    uint32_t *objects;       /**< segments of the plane or polygons of space, ascending, no two equal */
    uint32_t count;
    uint64_t duplicates; /**< objects that equal an earlier one, of all kinds */
    double *boxes;       /**< low corners, then high corners */
} measure_survey;

/** FROE_E_MEMORY; end it all the same. */
froe_status measure_survey_begin(const froe_scene *scene, unsigned threads, froe_progress_fn *progress, void *user,
                                 measure_survey *out);
void measure_survey_end(measure_survey *survey);
/** For measure_odd_pairs() and geom_box_pairs(). */
measure_candidates measure_survey_candidates(const measure_survey *survey);
/** Do two polygons certainly meet in nothing but a common corner, or a common edge of triangles, or not at all? False
 * says nothing. ~20 ns. */
bool measure_survey_are_aside(const measure_survey *survey, uint32_t a, uint32_t b);
/** How two objects of the scene meet. */
geom_contact measure_survey_meet(const measure_survey *survey, unsigned worker, uint32_t a, uint32_t b);

/** Counts a pair a < b, and keeps it if it is the least so far. */
void measure_note_pair(uint64_t *count, uint32_t first[2], uint32_t a, uint32_t b);
/** Adds what another worker has counted. */
void measure_add_pairs(uint64_t *count, uint32_t first[2], uint64_t more, const uint32_t least[2]);
#endif
