/* picture.h: the kinds of pictures. Each plans its page, so that the page can be made, and paints it. */
#ifndef FROE_DRAW_PICTURE_H
#define FROE_DRAW_PICTURE_H
#include "page.h"
#include "space.h"

struct draw_solid;

typedef struct draw_picture {
    draw_page page;
    draw_space space;
    bool whole;     /**< no window was asked for */
    double wide[3]; /**< half extents of the window in drawing coordinates, with a margin around a whole scene */
    uint32_t show;
    struct draw_solid *solid; /**< what an exploded view has gathered */
} draw_picture;

/** Plans the page. FROE_E_MEMORY, FROE_E_CANCELLED. */
froe_status draw_plane_plan(draw_picture *picture);
froe_status draw_plane_paint(draw_picture *picture, cairo_t *cr);
froe_status draw_solid_plan(draw_picture *picture);
froe_status draw_solid_paint(draw_picture *picture, cairo_t *cr);
/** Frees what planning has gathered. */
void draw_picture_free(draw_picture *picture);
#endif
