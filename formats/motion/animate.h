/* animate.h: a motion on its way to a picture: its scale on the page, and the contacts of each object. It speaks for
 * animate.c, animate_svg.c and animate_page.c. */
#ifndef FROE_FORMATS_ANIMATE_H
#define FROE_FORMATS_ANIMATE_H
#include "formats/write/writer.h"

typedef struct formats_animation {
    const froe_motion *motion;
    const froe_contact *contacts;
    size_t count;
    froe_animation_options options;
    double begin, end;   /**< of the window */
    double lo[2], hi[2]; /**< of everything */
    double height;       /**< of the picture, whose width is in the options */
    double scale;        /**< pixels a unit */
    size_t *starts;      /**< [object]: its contacts, in order of time, begin in `touched` */
    uint32_t *touched;   /**< numbers of contacts */
} formats_animation;

/** Margins of the picture. */
#define FORMATS_ANIMATION_MARGIN 16

typedef void formats_animation_writer(formats_writer *w, const formats_animation *a);
formats_animation_writer formats_animate_svg, formats_animate_page;
#endif
