/* film_instants.h: when the faces in sight may change, for films that miss no change (froe_film_options.exact).
 *
 *     frame --+---------+-+--------------- frame      what is seen stays from one instant to the next, so one picture
 *             instant   two of them                   between two of them tells all */
#ifndef FROE_VECTOR_FILM_INSTANTS_H
#define FROE_VECTOR_FILM_INSTANTS_H
#include "film_turn.h"
#include "support/array.h"
#include <froe/render.h>

typedef struct film_instant {
    double low, high; /**< it is between */
} film_instant;

typedef struct film_instants {
    const froe_motion *motion;
    froe_allocator alloc;
    froe_projection view;        /**< when the film begins */
    const film_turn *turn;       /**< NULL: the eye rests */
    bool all;                    /**< what is drawn does not tell of all that is seen */
    uint8_t *seen;               /**< per object */
    ARRAY(film_instant) touches; /**< at which triangles begin or cease to touch */
    ARRAY(uint32_t) pairs;       /**< of triangles at rest that touch all the time */
    ARRAY(film_instant) list;    /**< what was found last, ascending */
    bool full;
} film_instants;

/** Finds when triangles touch. `scene` is any of the motion. `turn` is set afterwards. FROE_E_UNSUPPORTED and others of
 * froe_motion_sights(), froe_motion_contacts(), froe_camera_place(). */
froe_status film_instants_begin(film_instants *x, const froe_motion *motion, const froe_camera *camera,
                                const froe_scene *scene, const froe_render_options *options, froe_diagnostic *diag);
void film_instants_end(film_instants *x);
/** The instants from one time to another, while these objects are in sight. */
froe_status film_instants_find(film_instants *x, const uint64_t *tags, size_t count, double from, double to,
                               froe_diagnostic *diag);
/** The first that begins after a time and ends before another; *next: when the one after it begins, or that other
 * time. False: there is none. */
bool film_instants_next(const film_instants *x, double after, double before, film_instant *out, double *next);
#endif
