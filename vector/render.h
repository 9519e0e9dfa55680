/* render.h: a picture with hidden surfaces removed while it is written, by render.c, options.c, shade.c, paths.c and a
 * file for each format. */
#ifndef FROE_VECTOR_RENDER_H
#define FROE_VECTOR_RENDER_H
#include "output.h"
#include "support/array.h"
#include <math.h>

typedef struct vector_render {
    froe_allocator alloc;
    const froe_tree *tree;
    const froe_scene *scene;
    const froe_render_options *options;
    bool lines_only; /**< nothing is filled, whatever the options say */
    double grid;     /**< steps of the output in a unit of the page: see vector_grid() */
    froe_surface *surface;
    froe_projection view;
    froe_picture *picture;
    size_t patches;
    uint32_t *style_of;     /**< per patch, into styles */
    ARRAY(uint32_t) styles; /**< colours, 0xAARRGGBB, ascending, each once */
    uint32_t *layer_of;     /**< per group: the first of its name; NULL: there are no layers */
    uint32_t *keys;         /**< per patch: what the order of painting keeps together; NULL: styles */
    uint32_t *owners;       /**< per object: what its lines belong to, a face, group or layer; NULL: nothing is asked */
    size_t *order;          /**< of the strokes, when they have owners: those of one are together */
    uint8_t *clear;         /**< per patch; NULL: all are opaque */
    int32_t *priorities;    /**< per patch; NULL */
    froe_outline *outlines; /**< room for those of the longest path */
    size_t room;            /**< for so many */
    froe_render_report report;
} vector_render;

/* -------------------------------------------------------------------------- render.c -- */

/** Everything but the bytes, of a render that has tree, scene, options and grid. Whatever its status, vector_free()
 * gives back what it has made. */
froe_status vector_prepare(vector_render *render, const froe_camera *camera, froe_diagnostic *diag);
void vector_free(vector_render *render);
/** The status of an output, with a sentence. */
froe_status vector_end(vector_output *output, froe_diagnostic *diag);

/* ---------------------------------------------------------------- options.c, shade.c -- */

/** FROE_E_OPTIONS, unless every option is in its range. */
froe_status vector_check(const froe_scene *scene, const froe_render_options *options, froe_diagnostic *diag);
/** The same, and that the format has what the picture needs. */
froe_status vector_check_format(const froe_scene *scene, const froe_render_options *options, froe_render_format format,
                                froe_diagnostic *diag);
/** Length of a unit of the page in points (PDF, EPS). */
double vector_unit(const froe_render_options *options);
/** Steps of a format's coordinates in a unit of the page: 1/256 of a point in PDF and EPS, otherwise SVG's digits. */
double vector_grid(const froe_render_options *options, froe_render_format format);

/** Opacity of a group, 0 .. 1; of FROE_NONE 1. */
double vector_opacity(const froe_scene *scene, const froe_render_options *options, uint32_t group);
/** Colour of wires and points of a group, 0xRRGGBB; FROE_LINE_COLOUR if it has none. */
uint32_t vector_line_colour(const vector_render *render, uint32_t group);
/** Fills style_of, styles, keys and layer_of. FROE_E_MEMORY. */
froe_status vector_shade(vector_render *render);
/** The group of an object, or FROE_NONE. */
uint32_t vector_group(const vector_render *render, uint32_t object);

/* ------------------------------------------------------------------------- strokes.c -- */

/** How lines of one kind are drawn, all members filled in; lengths in units of 1/scale of a unit of the page. */
froe_line_style vector_line_style(const froe_render_options *options, froe_line kind, bool hidden, double scale);
/** Half the width of the widest visible line, in units of the page. */
double vector_line_reach(const froe_render_options *options);
/** FROE_E_OPTIONS, unless every style of lines is one. */
froe_status vector_check_lines(const froe_render_options *options, froe_diagnostic *diag);
/** Fills owners, before there is a picture, if the options keep lines of objects apart. FROE_E_MEMORY. */
froe_status vector_find_owners(vector_render *render);
/** Fills order, if there are owners. FROE_E_MEMORY. */
froe_status vector_sort_strokes(vector_render *render);
/** The i-th stroke in that order. */
froe_stroke vector_stroke(const vector_render *render, size_t i);

/* --------------------------------------------------------------------------- paths.c -- */

/** How far a picture has been painted. */
typedef struct vector_cursor {
    size_t shape, stroke;
} vector_cursor;
/** Where a coordinate falls on the grid of the output. */
static inline int64_t vector_step(const vector_render *render, double x) {
    return (int64_t)floor(x * render->grid + 0.5);
}
/** Is anything left of a closed outline on that grid? */
bool vector_ring_shows(const vector_render *render, const froe_outline *ring);
/** Is anything left of a stroke there? */
bool vector_stroke_shows(const vector_render *render, const froe_stroke *stroke);
/** Makes room for outlines, and notes in the report how many shapes and strokes show, and how many do not.
 * FROE_E_MEMORY. */
froe_status vector_count_shown(vector_render *render);
/** The next path of which something shows; false: there is no more. */
bool vector_next_path(const vector_render *render, vector_cursor *at, froe_render_path *path);
/** All paths, with the faces before them once more where the seams want that, counted in the report. False: fn was
 * false. */
bool vector_each_path(vector_render *render, froe_render_path_fn *fn, void *user);

/* ------------------------------------------------------------ svg.c, pdf.c, eps.c, data.c -- */

/** When a picture is shown: the i-th of `count`, for a share of `seconds`. count 0: always. */
typedef struct vector_frame {
    size_t i, count;
    double seconds;
} vector_frame;
/** Write the beginning of an SVG, a picture (if `frame` says so, only for its time), and the end. */
void vector_svg_begin(const vector_render *render, vector_output *output);
void vector_svg_picture(vector_render *render, vector_output *output, const vector_frame *frame);
void vector_svg_end(const vector_render *render, vector_output *output);
/** Writes each path by itself, and calls fn behind it, when its bytes have been handed over. False: fn was false. */
bool vector_svg_each(vector_render *render, vector_output *output, bool (*fn)(void *user, bool lines), void *user);
/** What lines are in, if there are no layers. */
#define VECTOR_SVG_LINES "<g fill=\"none\" stroke=\"#1b2630\" stroke-linejoin=\"round\">\n"
/** The style by which, where less motion is wanted, what is shown first stays. */
#define VECTOR_SVG_STILL                                                                                               \
    "<style>@media (prefers-reduced-motion: reduce) "                                                                  \
    "{ .first { display: inline !important } .other { display: none !important } }</style>\n"
void vector_pdf(vector_render *render, vector_output *output);
void vector_eps(vector_render *render, vector_output *output);
/** The lines of a picture as data. */
void vector_csv(vector_render *render, vector_output *output);
void vector_geojson(vector_render *render, vector_output *output);
#endif
