/* draw.h: a partition as a picture. Companion library of froe.h, on top of Cairo.
 *
 *     froe_draw_options o = froe_draw_defaults();
 *     o.title = "Floor plan";
 *     froe_draw(tree, "floor.svg", &o, NULL);       // or .pdf, or .png
 *
 * What a picture shows, from back to front: cells filled with a colour that
 * tells their depth in the tree (pale: near the root, dark: deep; the scale is
 * perceptually even and reads the same for the colour-blind; faint where objects
 * are drawn), cuts as hairlines that thin out with depth, the areas of features
 * of maps whose borders are closed, the pieces into which the objects fell, and
 * the objects themselves. Y points up, both axes have the same scale; on maps in
 * degrees x is shorter by the cosine of the middle latitude, so that shapes there
 * are right. With the legend, pictures of the plane have numbers along two edges,
 * in degrees where the coordinates are.
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
#include <froe/render.h>

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

typedef enum froe_draw_mark_kind {
    FROE_DRAW_MARK_BOX = 0,  /**< from its lower to its upper corner */
    FROE_DRAW_MARK_BALL = 1, /**< its centre is that of the box, its radius half the first side */
    FROE_DRAW_MARK_LINE = 2, /**< from lo to hi, with a dot at its end; a dot alone where they are the same point */
    FROE_DRAW_MARK_KIND_COUNT = 3
} froe_draw_mark_kind;
/** A marked place, in the scene's coordinates. */
typedef struct froe_draw_mark {
    double lo[3], hi[3];
    froe_draw_mark_kind kind;
    const char *label; /**< UTF-8, one line, beside hi; NULL or "": none. In the plane only. Of lines of one label, one
                          after the other, the first whose end is in the picture has it */
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
    bool legend;                 /**< method, counts, scale of depths, scale bar, numbers of axes; default true */
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
    int up;                      /**< 3D: the axis that points up on the page, 0, 1 or 2; -1 (default): the one
                                      that points up in the scene. With 1, z points at the viewer, as in glTF */
    double view[3];              /**< EXPLODED: from the scene to the eye, any length; default all 0: from the
                                      front right and above */
    double explode;              /**< EXPLODED: parts move away from the centre by this multiple of their
                                      distance from it, 0 .. 10; default 0.5; 0: nothing moves */
    uint32_t explode_depth;      /**< EXPLODED: the parts are the regions of the nodes at this depth (and
                                      shallower leaves), 0 .. 32; default 4 */
    const froe_draw_mark *marks; /**< FLAT, SECTIONS: on top, where the section meets them; NULL: none */
    size_t mark_count;
    size_t *marks_outside;    /**< gets how many of the marks are wholly outside of the window, or of the whole picture
                              where there is none; NULL (default): not counted */
    const uint32_t *accented; /**< FLAT, SECTIONS: objects that are drawn on top in the accent colour; NULL: none */
    size_t accented_count;
    bool locator; /**< FLAT, SECTIONS, with a window: the whole scene, small, in a corner, and where the window is;
                       default false */
    const froe_allocator *alloc; /**< of working memory (Cairo's own apart); NULL (default): malloc */
    froe_progress_fn *progress;  /**< may be NULL */
    void *user;                  /**< for progress */
} froe_draw_options;
FROE_DEFAULTS(froe_draw_options, froe_draw_defaults);

/** Draws the tree to a file whose extension says how: .svg, .pdf or .png. options
 * NULL: the defaults. The file appears at once and whole: it is made in memory,
 * written beside `path` and moved there, so that on any failure an older file stays.
 * FROE_E_OPTIONS: unknown extension, a value out of its range (named in diag), or a
 * style that the tree's dimension does not have. FROE_E_UNSUPPORTED: dimension above
 * 3. FROE_E_IO: the directory or disk does not take it. FROE_E_MEMORY,
 * FROE_E_CANCELLED. O(nodes + pieces) time; memory for what is seen. */
FROE_API froe_status froe_draw(const froe_tree *tree, const char *path, const froe_draw_options *options,
                               froe_diagnostic *diag);

/** The same picture, byte for byte, to a callback. */
FROE_API froe_status froe_draw_write(const froe_tree *tree, froe_draw_format format, froe_write_fn *fn, void *user,
                                     const froe_draw_options *options, froe_diagnostic *diag);

/** The picture of froe_render() as a PNG of options->pixels pixels per unit of the page; `path` may have any name. Same
 * tree and options: the same bytes with the same Cairo. Otherwise as froe_render(). */
FROE_API froe_status froe_render_png(const froe_tree *tree, const char *path, const froe_render_options *options,
                                     froe_render_report *report, froe_diagnostic *diag);

#ifdef __cplusplus
}
#endif
#endif
