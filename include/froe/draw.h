/* draw.h: a partition as a picture. Companion library of froe.h, on top of Cairo.
 *
 *     froe_draw_options o = froe_draw_defaults();
 *     o.title = "Floor plan";
 *     froe_draw(tree, "floor.svg", &o, NULL);       // or .pdf, or .png
 *
 * What a picture shows, from back to front: cells filled with a colour that
 * tells their depth in the tree (pale: near the root, dark: deep; the scale is
 * perceptually even and reads the same for the colour-blind), cuts as hairlines
 * that thin out with depth, the pieces into which the objects fell, and the
 * objects themselves. Y points up, both axes have the same scale.
 *
 * Trees in the plane are drawn flat. Trees in space are drawn as plane sections,
 * or pulled apart from the centre in parallel projection. The painter's order of
 * the latter comes from the tree itself (Fuchs, Kedem, Naylor, "On visible surface
 * generation by a priori tree structures", 1980): at every cut, what lies behind
 * it is painted first. Pulling apart does not spoil the order: two convex
 * parts on the two sides of a plane with normal n have centres a, b with n.a >= n.b,
 * and moving each by the same multiple of its own centre moves them apart along n.
 *
 * Coordinates are scaled to the page in doubles before Cairo sees them, so any
 * finite scene can be drawn. Bytes depend on tree, options and the version of Cairo
 * only: no fonts of the system are used (unless a title is not plain ASCII), no
 * dates, no random names. Nothing recurses on the tree. Trees of many millions of
 * leaves give small pictures: see froe_draw_options.detail.
 */
#ifndef FROE_DRAW_H
#define FROE_DRAW_H

#include <froe/froe.h>
#include <froe/view.h>

#ifdef __cplusplus
extern "C" {
#endif

/** How a tree in space becomes flat. Trees in the plane have FROE_DRAW_FLAT only. */
typedef enum froe_draw_style {
    FROE_DRAW_AUTO = 0,     /**< 2D: FLAT; 3D: SECTIONS */
    FROE_DRAW_FLAT = 1,     /**< 2D only: the plane itself */
    FROE_DRAW_SECTIONS = 2, /**< 3D only: one plane section, or a sheet of three: see `axis` */
    FROE_DRAW_EXPLODED = 3, /**< 3D only: parallel projection, parts pulled apart: see `explode` */
    FROE_DRAW_STYLE_COUNT = 4
} froe_draw_style;
/** "auto", "flat", "sections", "exploded"; NULL for other numbers. */
FROE_API const char *froe_draw_style_name(froe_draw_style style);

/** What is drawn, as bits. An exploded view shows cells as glassy solids around
 * the pieces, cuts as the walls between parts. */
typedef enum froe_draw_layer {
    FROE_DRAW_CELLS = 1,     /**< cells, coloured by depth */
    FROE_DRAW_CUTS = 2,      /**< cuts within their regions, heavier near the root */
    FROE_DRAW_FRAGMENTS = 4, /**< pieces; those of cut objects in alternating shades, ticks where a cut ended them */
    FROE_DRAW_OBJECTS = 8    /**< objects in ink; those shown as fragments not twice */
} froe_draw_layer;
/** Name of one bit: "cells", "cuts", "fragments", "objects"; NULL for anything else. */
FROE_API const char *froe_draw_layer_name(froe_draw_layer layer);

typedef enum froe_draw_format {
    FROE_DRAW_SVG = 0,
    FROE_DRAW_PDF = 1,
    FROE_DRAW_PNG = 2,
    FROE_DRAW_FORMAT_COUNT = 3
} froe_draw_format;
/** The format that a path's extension asks for, whatever its case. False (nothing
 * written) when the path has no extension or an unknown one. */
FROE_API bool froe_draw_format_of(const char *path, froe_draw_format *format);

#define FROE_DRAW_CLEAR UINT32_MAX /**< background: none, transparent where the format can be */

/** A marked place: a box in the scene's coordinates, or the ball within it. */
typedef struct froe_draw_mark {
    double lo[3], hi[3];
    bool ball; /**< its centre is that of the box, its radius half the first side */
} froe_draw_mark;

typedef struct froe_draw_options {
    size_t size;                 /**< set by froe_draw_defaults() */
    froe_draw_style style;       /**< default AUTO */
    uint32_t show;               /**< froe_draw_layer bits; 0 (default): what suits the style */
    double width;                /**< of the page, 16 .. 32000: points in SVG and PDF, pixels in PNG; default 960 */
    double height;               /**< the same; 0 (default): by the scene's proportions, between 1/4 and 2 x width */
    double margin;               /**< around everything, in the same unit; negative (default -1): 1/32 of the width */
    double scale;                /**< PNG: pixels per unit, 0.1 .. 16, for dense screens; default 1 */
    uint32_t background;         /**< 0xRRGGBB or FROE_DRAW_CLEAR; default a paper white */
    const char *title;           /**< UTF-8, one line; NULL or "": none (default) */
    bool legend;                 /**< method, counts, scale of depths, scale bar; default true */
    uint32_t max_depth;          /**< cells below this depth are drawn as one; 0 (default): no limit */
    double detail;               /**< regions, and objects, smaller than this both ways (in the page's unit) are
                                      drawn as one, or one for many; the legend says how many cells that
                                      concerned. 0: everything is drawn; negative (default -1): a pixel in
                                      PNG; 1/8 point in SVG and PDF, but 3 for more than 100,000 cells and
                                      objects, which keeps files to some 20 MB */
    double lo[3], hi[3];         /**< FLAT, SECTIONS: window in the scene's coordinates, where lo < hi for
                                      every axis; default all 0: everything */
    int axis;                    /**< SECTIONS: 0, 1, 2: the section x, y or z = at; -1 (default): a sheet
                                      of the three sections through the middle */
    double at;                   /**< see axis */
    int up;                      /**< 3D: the axis that points up on the page, 0, 1 or 2; default 2. With 1, z
                                      points at the viewer, as in glTF */
    double view[3];              /**< EXPLODED: from the scene to the eye, any length; default all 0: from the
                                      front right and above */
    double explode;              /**< EXPLODED: parts move away from the centre by this multiple of their
                                      distance from it, 0 .. 10; default 0.5; 0: nothing moves */
    uint32_t explode_depth;      /**< EXPLODED: the parts are the regions of the nodes at this depth (and
                                      shallower leaves), 0 .. 32; default 4 */
    const froe_draw_mark *marks; /**< FLAT, SECTIONS: outlined on top, where the section meets them; NULL: none */
    size_t mark_count;
    const froe_allocator *alloc; /**< of working memory (Cairo's own apart); NULL (default): malloc */
    froe_progress_fn *progress;  /**< may be NULL */
    void *user;                  /**< for progress */
} froe_draw_options;
FROE_API froe_draw_options froe_draw_defaults(void);

/** Draws the tree to a file whose extension says how: .svg, .pdf or .png. options
 * NULL: the defaults. The file appears at once and whole: it is made in memory,
 * written beside `path` and moved there, so that on any failure an older file stays.
 * FROE_E_OPTIONS: unknown extension, a value out of its range (named in diag), or a
 * style that the tree's dimension does not have. FROE_E_UNSUPPORTED: dimension above
 * 3. FROE_E_IO: the directory or disk does not take it. FROE_E_MEMORY,
 * FROE_E_CANCELLED. O(nodes + pieces) time; memory for what is seen. */
FROE_API froe_status froe_draw(const froe_tree *tree, const char *path, const froe_draw_options *options,
                               froe_diagnostic *diag);

/** Receives the bytes of a picture in order; false stops (FROE_E_IO). */
typedef bool froe_draw_write_fn(void *user, const void *bytes, size_t count);
/** The same picture, byte for byte, to a callback. */
FROE_API froe_status froe_draw_write(const froe_tree *tree, froe_draw_format format, froe_draw_write_fn *fn, void *user,
                                     const froe_draw_options *options, froe_diagnostic *diag);

/* ------------------------------------------------------------------ render -- */

/** How faces are filled. */
typedef enum froe_shading {
    FROE_SHADE_FLAT = 0,  /**< lit from the upper left of the camera, two-sided */
    FROE_SHADE_CEL = 1,   /**< the same in few steps: see cel_levels */
    FROE_SHADE_PLAIN = 2, /**< one colour per material */
    FROE_SHADE_WHITE = 3, /**< white: hides what is behind */
    FROE_SHADE_NONE = 4,  /**< no fills: lines only */
    FROE_SHADING_COUNT = 5
} froe_shading;
/** "flat", "cel", "plain", "white", "none"; NULL for other numbers. */
FROE_API const char *froe_shading_name(froe_shading shading);

/** What is done about the background that shines through between antialiased shapes. */
typedef enum froe_seams {
    FROE_SEAMS_UNDERLAP = 0, /**< WHOLE: shapes go under later neighbours by seam_width */
    FROE_SEAMS_NONE = 1,
    FROE_SEAMS_TWICE = 2, /**< all fills are painted twice; only where everything is opaque */
    FROE_SEAMS_STROKE =
        3, /**< every fill gets a stroke of its own colour, seam_width wide; outlines grow by half of it */
    FROE_SEAMS_COUNT = 4
} froe_seams;
/** "underlap", "none", "twice", "stroke"; NULL for other numbers. */
FROE_API const char *froe_seams_name(froe_seams seams);

/** What SVG contains of the origin of shapes. */
typedef enum froe_ids {
    FROE_IDS_NONE = 0,
    FROE_IDS_OBJECT = 1, /**< one path for shapes of one colour and group that follow each other, with data-group */
    FROE_IDS_FACE = 2    /**< one path per face, with data-object and data-group */
} froe_ids;

typedef struct froe_render_options {
    size_t size;          /**< set by froe_render_defaults() */
    froe_camera camera;   /**< its page is the picture's */
    bool millimetres;     /**< one unit of the page is a millimetre; otherwise a pixel (SVG, PNG) or point (PDF, EPS) */
    froe_shading shading; /**< default FLAT */
    unsigned cel_levels;  /**< 2 .. 64; default 4 */
    froe_paint paint;     /**< default WHOLE */
    froe_seams seams;     /**< default UNDERLAP */
    double seam_width;    /**< in units of the page; default 1 */
    int section;          /**< see froe_visibility_options */
    uint32_t lines;       /**< bits of froe_line; default all but mesh */
    double crease;        /**< degrees; default 30 */
    double line_width; /**< default 1; silhouettes and borders; sections twice, crossings 0.8, other kinds 0.6 of it */
    bool interleaved;  /**< lines go below what is nearer, and so never cover half their width of it; default: on top */
    bool hidden;       /**< hidden lines, dashed */
    double halo;       /**< gap in lines before nearer ones; default 0 */
    bool own_colours;  /**< not those of groups, nor their opacity, but froe's; default false. So it is, whatever is
                                 said here, in white and in lines alone */
    const double *opacity;     /**< per group, 0 .. 1; NaN, or all NULL: that of its colour, or 1 */
    const int32_t *priorities; /**< per group, see froe_visibility_options; NULL: equal */
    bool cull_back;
    uint32_t background; /**< 0xRRGGBB, or FROE_DRAW_CLEAR (default) */
    int decimals;        /**< SVG: digits after the point, 0 .. 6; default 2 */
    froe_ids ids;        /**< default NONE */
    bool layers; /**< SVG: shapes of one object (groups of one name) that follow each other are a group with data-layer;
                      the order of painting keeps objects together where it can */
    double min_area;                 /**< see froe_picture_options */
    const char *title, *description; /**< SVG, PDF: UTF-8; NULL: none */
    double pixels;                   /**< PNG: pixels per unit of the page, 0.1 .. 64; default 1 */
    const froe_allocator *alloc;
    froe_progress_fn *progress;
    void *user;
} froe_render_options;
FROE_API froe_render_options froe_render_defaults(void);

typedef struct froe_render_report {
    froe_picture_report picture;
    froe_projection view;
    uint64_t shapes, strokes; /**< in the file */
    uint64_t thin_shapes;     /**< left out, since nothing is left of them in the file's coordinates: */
    uint64_t short_strokes;   /**< in SVG `decimals` digits, otherwise 1/256 of a point or pixel */
    uint64_t paths, bytes;
} froe_render_report;

/** The polygons of a tree in space as a picture with hidden surfaces removed, exactly: see froe_picture_new(). `path`
 * ends in .svg, .pdf, .eps or .png and appears whole or not at all. Same tree and options: the same bytes (in PDF, EPS
 * and PNG with the same Cairo). `report` may be NULL. FROE_E_OPTIONS: a value out of range, or EPS with an opacity
 * below 1, which EPS does not have. Otherwise as froe_camera_place(), froe_picture_new(), froe_draw(). */
FROE_API froe_status froe_render(const froe_tree *tree, const char *path, const froe_render_options *options,
                                 froe_render_report *report, froe_diagnostic *diag);
/** One SVG that shows a picture from each of `count` cameras (see froe_camera_turn) in turn, for ever, in `seconds` a
 * round; where nothing moves (in print) it shows the first. options->camera gives the page; all cameras must have the
 * same. `report`: of the last, but for paths and bytes, which are those of the file. Otherwise as froe_render(). */
FROE_API froe_status froe_render_animation(const froe_tree *tree, const char *path, const froe_render_options *options,
                                           const froe_camera *cameras, size_t count, double seconds,
                                           froe_render_report *report, froe_diagnostic *diag);

#ifdef __cplusplus
}
#endif
#endif
