/* film_turn.h: the eye of an exact film that goes around once: as a rigid body, and as a camera at any time.
 *
 *       . 1 .          between two places it goes along a rational arc, q(u) = (1 - u) q0 + u q1 (froe_body): at each
 *     2       0        frame, and in between at least every 5 degrees, it is where a turntable has it, and never more
 *       ' 3 '          than 0.0002 degrees ahead of that or behind */
#ifndef FROE_VECTOR_FILM_TURN_H
#define FROE_VECTOR_FILM_TURN_H
#include <froe/kinetic.h>
#include <froe/view.h>

typedef struct film_turn {
    froe_allocator alloc;
    froe_camera first;
    double begin, end;
    size_t count;    /**< places */
    double *numbers; /**< of the body, 8 (count + 1) of them: times, centres, turns */
    froe_body body;
    double at[3], window[12]; /**< eye and page in the body */
} film_turn;

/** How many places there are around for that many frames. */
size_t film_turn_places(uint32_t frames);
/** From the first of so many cameras, all of which are put in place, and how that sees. FROE_E_OPTIONS: it goes around
 * its own line of view. FROE_E_MEMORY. */
froe_status film_turn_begin(film_turn *turn, const froe_camera *first, const froe_projection *view, size_t places,
                            double begin, double end, const froe_allocator *alloc, froe_diagnostic *diag);
void film_turn_end(film_turn *turn);
/** Where the eye is at a time. */
froe_camera film_turn_at(const film_turn *turn, double time);
#endif
