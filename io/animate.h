/* animate.h: a motion on its way to a picture: its scale on the page, and the contacts of each object. */
#ifndef FROE_IO_ANIMATE_H
#define FROE_IO_ANIMATE_H
#include "writer.h"

typedef struct io_animation {
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
} io_animation;

/** Margins of the picture. */
#define IO_ANIMATION_MARGIN 16

typedef void io_animation_writer(io_writer *w, const io_animation *a);
io_animation_writer io_animate_svg, io_animate_page;
#endif
