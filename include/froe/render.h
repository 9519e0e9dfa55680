/* render.h: pictures of a tree in space with hidden surfaces removed, exactly, as SVG, PDF and EPS. Part of the core
 * library; froe/draw.h has PNG.
 *
 *     froe_render_options o = froe_render_defaults();
 *     o.title = "House";
 *     froe_render(tree, "house.svg", &o, NULL, NULL);       // or .pdf, or .eps
 *
 * What is visible, and in which order it is painted, froe_picture_new() of froe/view.h finds. This header colours it,
 * joins it to paths, and writes them: to a file, as bytes to a function, or as paths, for formats that froe does not
 * write itself. The lines alone come as data, too: as arrays, as CSV and as GeoJSON. The same tree and options give the
 * same bytes on every machine. */
#ifndef FROE_RENDER_H
#define FROE_RENDER_H

#include <froe/froe.h>
#include <froe/kinetic.h>
#include <froe/view.h>

#ifdef __cplusplus
extern "C" {
#endif

#define FROE_DRAW_CLEAR UINT32_MAX           /**< background: none, transparent where the format can be */
#define FROE_DRAW_BY_FORMAT (UINT32_MAX - 1) /**< background: white in PNG, none in other files */

#define FROE_LINE_COLOUR 0x1B2630 /**< of lines without a style, a dark blue */

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

/** What SVG contains of the origin of shapes and lines. Lines then have data-kind, too, and end where what they belong
 * to does: see froe_stroke. */
typedef enum froe_ids {
    FROE_IDS_NONE = 0,
    FROE_IDS_OBJECT = 1, /**< one path for shapes of one colour and group that follow each other, and for lines of one
                              kind and group, with data-group */
    FROE_IDS_FACE = 2    /**< one path per face, and for lines of one kind and face, with data-object, which is the
                              first of the face, and data-group */
} froe_ids;

/** Groups around parts of an SVG, which Inkscape shows as layers. */
typedef enum froe_layers {
    FROE_LAYERS_NONE = 0,
    FROE_LAYERS_OBJECT =
        1,               /**< shapes of one object (groups of one name) that follow each other; its visible lines; its
                                 hidden ones. The order of painting keeps objects together where it can */
    FROE_LAYERS_KIND = 2 /**< all shapes; visible and hidden lines of each kind. Not with interleaved lines */
} froe_layers;

/** How lines of some kinds are drawn. What is NaN or FROE_NONE stays as it is without this style. */
typedef struct froe_line_style {
    uint32_t visible, hidden; /**< bits of froe_line: the kinds of visible and of hidden lines that it is about */
    double width;             /**< in units of the page, above 0 */
    uint32_t colour;          /**< 0xRRGGBB; default FROE_LINE_COLOUR */
    double dash, gap;         /**< lengths in units of the page; both 0: the line is solid */
} froe_line_style;
/** Of no lines, and everything as it is. */
FROE_API froe_line_style froe_line_style_defaults(void);

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
    uint32_t lines;       /**< bits of froe_line; default all but mesh. Wires and points have the colours of their
                               groups, if they have any and own_colours does not exclude it */
    double crease;        /**< degrees; default 30 */
    double line_width;    /**< default 1; silhouettes, borders and wires; sections twice, crossings 0.8, other kinds
                            0.6 of it; hidden lines 0.6 of visible ones, with dashes of 4 and gaps of 3 times their
                            width. 0: there are no lines, whatever their styles */
    double point_width;   /**< of the discs that points are; default 3 */
    const froe_line_style *line_styles; /**< of lines of one kind the last that is about them counts; NULL: none */
    size_t line_style_count;
    bool interleaved; /**< lines go below what is nearer, and so never cover half their width of it; default: on top */
    bool hidden;      /**< hidden lines, dashed */
    double halo;      /**< gap in lines before nearer ones; default 0 */
    bool own_colours; /**< not those of groups, nor their opacity, but froe's; default false. So it is, whatever is said
                           here, in white and in lines alone */
    const double *opacity;     /**< per group, 0 .. 1; NaN, or all NULL: that of its colour, or 1 */
    const int32_t *priorities; /**< per group, see froe_visibility_options; NULL: equal */
    bool cull_back;
    uint32_t background;             /**< 0xRRGGBB, FROE_DRAW_CLEAR or FROE_DRAW_BY_FORMAT (default) */
    int decimals;                    /**< SVG: digits after the point, 0 .. 6; default 2 */
    froe_ids ids;                    /**< default NONE */
    froe_layers layers;              /**< SVG; default NONE */
    double min_area;                 /**< see froe_picture_options */
    const char *title, *description; /**< SVG, PDF: UTF-8; NULL: none */
    double pixels;                   /**< PNG: pixels per unit of the page, 0.1 .. 64; default 1 */
    unsigned threads;                /**< 0: one per processor; no picture depends on it */
    const froe_allocator *alloc;
    froe_progress_fn *progress;
    void *user;
} froe_render_options;
FROE_DEFAULTS(froe_render_options, froe_render_defaults);

typedef struct froe_render_report {
    froe_picture_report picture;
    froe_projection view;
    uint64_t shapes, strokes; /**< in the file */
    uint64_t dots;            /**< of the strokes: points of the scene */
    uint64_t thin_shapes;     /**< left out, since nothing is left of them in the file's coordinates: */
    uint64_t short_strokes;   /**< in SVG `decimals` digits, otherwise 1/256 of a point or pixel */
    uint64_t paths, bytes;
    uint64_t reserved[8];
} froe_render_report;

typedef enum froe_render_format {
    FROE_RENDER_SVG = 0,
    FROE_RENDER_PDF = 1, /**< 1.4, uncompressed */
    FROE_RENDER_EPS = 2, /**< PostScript level 2 */
    /** Lines alone, as data: those of an SVG of the same options, in the same order, each once. In units of the page, y
     * upwards from its lower left corner, with all digits. Each has kind, hidden, closed; as far as the option `ids`
     * keeps them apart, group and name (OBJECT), object and face (FACE: the first object of the face, and froe_object's
     * face of it); and `space`, the same points in the scene. Where `closed`, the first point comes once more. */
    FROE_RENDER_CSV = 3,     /**< a row each; in columns WKT and space LINESTRINGs, which OGR reads */
    FROE_RENDER_GEOJSON = 4, /**< a feature each, in no coordinate system of the earth */
    FROE_RENDER_FORMAT_COUNT = 5
} froe_render_format;

/** The polygons, segments and points of a tree in space as a picture with hidden surfaces removed, exactly: see
 * froe_picture_new(). `path` ends in .svg, .pdf, .eps, .csv or .geojson and appears whole or not at all. `options`
 * NULL: the defaults; `report` may be NULL. FROE_E_OPTIONS: a value out of range, a title or description that is
 * not UTF-8, or EPS with an opacity below 1, which EPS does not have. FROE_E_UNSUPPORTED: `path` ends in .png or
 * .dxf, which froe_render_png() of froe/draw.h and froe_render_dxf() of froe/io.h make. FROE_E_IO: the directory or
 * disk does not take it. Otherwise as froe_camera_place(), froe_picture_new(). */
FROE_API froe_status froe_render(const froe_tree *tree, const char *path, const froe_render_options *options,
                                 froe_render_report *report, froe_diagnostic *diag);

/** The same picture, byte for byte, to a function, some kilobytes at a time. After a failure, what it has received is
 * the beginning of a picture at most. */
FROE_API froe_status froe_render_write(const froe_tree *tree, froe_render_format format, froe_write_fn *fn, void *user,
                                       const froe_render_options *options, froe_render_report *report,
                                       froe_diagnostic *diag);

/** One SVG that shows a picture from each of `count` cameras (see froe_camera_turn) in turn, for ever, in `seconds` a
 * round; where nothing moves (in print) it shows the first. options->camera gives the page; all cameras must have the
 * same. `report`: of the last, but for paths and bytes, which are those of the file. Otherwise as froe_render(). */
FROE_API froe_status froe_render_animation(const froe_tree *tree, const char *path, const froe_render_options *options,
                                           const froe_camera *cameras, size_t count, double seconds,
                                           froe_render_report *report, froe_diagnostic *diag);

/* -------------------------------------------------------------------- film -- */

typedef struct froe_film_options {
    size_t size;       /**< set by froe_film_defaults() */
    uint32_t frames;   /**< pictures at equal distances in time, the first when the window begins; default 200 */
    double seconds;    /**< that a round takes; default 8 */
    uint32_t halvings; /**< 0 .. 20: where one frame shows other faces than the one before, the time between the two is
                            halved so often; default 4 */
    bool turn;         /**< the eye goes around once, as froe_camera_turn() has it; see froe_film() */
    bool exact;        /**< the instants at which faces come into sight or vanish are roots of polynomials, and none is
                            missed while no triangles touch; see froe_film(). default false */
} froe_film_options;
FROE_DEFAULTS(froe_film_options, froe_film_defaults);

typedef struct froe_film_report {
    uint64_t pictures; /**< that were made, each from a tree of its own */
    uint64_t shown;    /**< of them, each at its time */
    uint64_t changes;  /**< times between two frames at which other faces come into sight */
    uint64_t paths;    /**< in the file */
    uint64_t bytes;
    double late; /**< no change that was found is shown later than so much, in units of the motion's time */
    uint64_t reserved[8];
} froe_film_report;

/** Triangles in motion as one SVG that plays: each picture, taken at its instant, has its hidden surfaces removed as by
 * froe_render(), exactly, from where its corners are rounded to. A path that stays as it is from one picture to the
 * next is in the file once. Where nothing moves (in print) the first picture is shown.
 *
 * Beside the frames there are pictures of the instants at which objects appear or end, which are known exactly, and of
 * those at which a face comes into sight or vanishes: they are found by halving between two frames of which one shows
 * it, so that what comes and goes between two frames is not seen. All other parts of faces grow and shrink from frame
 * to frame.
 *
 * An exact film has a picture after each of the instants of froe_motion_sights() and of those at which triangles begin
 * or cease to touch, and shows it from then on if other faces are in sight. So it misses nothing, however short, but
 * what is shorter than the doubles tell apart, and what happens along the lines of triangles that pass through one
 * another while one of them moves. If the eye goes around, it does so along rational arcs (froe_body): it is where
 * froe_camera_turn() has it at each frame, and never more than 0.0002 degrees off. It needs many pictures: where n
 * edges are in sight, up to n^2 an interval between frames. FROE_E_OPTIONS: the eye would go around its own line of
 * view. FROE_E_UNSUPPORTED: as froe_motion_sights(); froe_motion_without_bodies() replaces bodies.
 *
 * The camera holds all that is ever there, as long as it is there; it is as given if it does not fit. Paths are as with
 * FROE_IDS_OBJECT. `path` ends in .svg. FROE_E_OPTIONS: layers, interleaved lines, fills that are painted twice; see
 * froe_render(). FROE_E_UNSUPPORTED: the motion is of the plane. FROE_E_INPUT: nothing is ever there. The time of
 * froe_build() and froe_render() for each picture. */
FROE_API froe_status froe_film(const froe_motion *motion, const char *path, const froe_render_options *options,
                               const froe_film_options *film, froe_film_report *report, froe_diagnostic *diag);
/** The same bytes to a function, as froe_render_write(). */
FROE_API froe_status froe_film_write(const froe_motion *motion, froe_write_fn *fn, void *user,
                                     const froe_render_options *options, const froe_film_options *film,
                                     froe_film_report *report, froe_diagnostic *diag);
/** The cameras of `count` pictures of a motion at equal distances in time, as films have them: all equal, unless they
 * turn. FROE_E_ARG, FROE_E_OPTIONS, FROE_E_UNSUPPORTED, FROE_E_INPUT, FROE_E_MEMORY. */
FROE_API froe_status froe_film_cameras(const froe_motion *motion, const froe_camera *camera, bool turn, size_t count,
                                       froe_camera *cameras, froe_diagnostic *diag);

/* ------------------------------------------------------------------- paths -- */

/** Points joined by straight lines, 2 doubles each, in units of the page, y downwards. */
typedef struct froe_outline {
    const double *points;
    size_t count;
    bool closed;
} froe_outline;

/** What is painted at once: faces of one colour, or lines of one kind. */
typedef struct froe_render_path {
    bool lines;             /**< stroked, with round joins; otherwise filled by the nonzero rule */
    bool dots;              /**< lines of one point each: discs, or strokes with round caps */
    uint32_t colour;        /**< 0xAARRGGBB, AA: opacity, 255 of lines */
    double width;           /**< of the stroke; of faces 0, but for FROE_SEAMS_STROKE */
    double dash, gap;       /**< lengths; 0: the line is solid */
    froe_line kind;         /**< lines */
    bool hidden;            /**< lines */
    uint32_t object, group; /**< of the first face; of lines as far as the option `ids` keeps them apart; FROE_NONE */
    uint32_t layer;         /**< with FROE_LAYERS_OBJECT the first group of that name, else FROE_NONE */
    const froe_outline *outlines; /**< a union, in any order; valid during the call */
    size_t count;
} froe_render_path;

/** Receives the paths of a picture from back to front; false stops, which is no failure. */
typedef bool froe_render_path_fn(void *user, const froe_render_path *path);
/** The same picture as paths, for formats that froe does not write. Shapes and lines of which nothing is left once
 * their points are rounded to 1/steps of a unit are no paths of their own, and lines not part of one. The page and its
 * background are the caller's to paint. `steps`: above 0, at most 1e6. `bytes` in the report is 0. */
FROE_API froe_status froe_render_paths(const froe_tree *tree, double steps, froe_render_path_fn *fn, void *user,
                                       const froe_render_options *options, froe_render_report *report,
                                       froe_diagnostic *diag);

/** Receives a line of a picture; false stops, which is no failure. Its arrays are valid during the call. */
typedef bool froe_render_line_fn(void *user, const froe_stroke *line);
/** The lines of the same picture, visible and hidden, in the order of painting: on the page, in units of it, y
 * downwards; in the scene; and the objects that they belong to. They are those of an SVG of the same options: lines of
 * which nothing is left in its coordinates are left out. Shapes are neither made nor counted. */
FROE_API froe_status froe_render_lines(const froe_tree *tree, froe_render_line_fn *fn, void *user,
                                       const froe_render_options *options, froe_render_report *report,
                                       froe_diagnostic *diag);

#ifdef __cplusplus
}
#endif
#endif
