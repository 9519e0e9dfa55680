/* animate.h: a motion on its way to a picture: what it spans, and the contacts of each object. It speaks for
 * animate.c, animate_svg.c, animate_film.c and animate_page.c. */
#ifndef FROE_FORMATS_ANIMATE_H
#define FROE_FORMATS_ANIMATE_H
#include "formats/write/writer.h"

typedef struct formats_animation {
    const froe_motion *motion;
    const froe_contact *contacts;
    size_t count;
    froe_animation_options options;
    double begin, end;   /**< of the window */
    bool clock;          /**< times are milliseconds since 1970, as the standard says (OGC 19-045r3), and are shown as
                            a clock shows them; numbers that span less than a second are shown as numbers */
    double lo[2], hi[2]; /**< of everything that is there in the window */
    size_t *starts;      /**< [object]: its contacts, in order of time, begin in `touched` */
    uint32_t *touched;   /**< numbers of contacts */
} formats_animation;

/** The knots of a vertex that matter in the window: first .. end - 1, one at least. */
void formats_animation_knots(const formats_animation *a, uint32_t vertex, size_t *first, size_t *end);

/** Fail as films do; the writer keeps failures of its own. */
typedef froe_status formats_animation_writer(formats_writer *w, const formats_animation *a, froe_diagnostic *diag);
formats_animation_writer formats_animate_svg, formats_animate_page, formats_animate_film;
#endif
