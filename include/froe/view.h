/* view.h: what an eye sees of a scene of polygons, segments and points in space, exactly: in which order, which parts
 * of it, and how to paint that. Part of the core library.
 *
 *     froe_eye eye = {.at = {3, -7, 2}};
 *     froe_tree_order(tree, &eye, NULL, paint, page, NULL);       // back to front: one piece at a time
 *
 * One tree serves every eye. Nothing is compared with an epsilon: on which side of a cut an eye
 * is, is the sign of an exact expression in the doubles given.
 */
#ifndef FROE_VIEW_H
#define FROE_VIEW_H

#include <froe/froe.h>

#ifdef __cplusplus
extern "C" {
#endif

/* --------------------------------------------------------------------- eye -- */

/** Where a picture is seen from. Taken exactly, as the doubles given. */
typedef struct froe_eye {
    double at[3];  /**< a point; of a parallel eye the direction from the scene towards it, of any length but 0.
                        In the plane at[2] is ignored */
    bool parallel; /**< infinitely far away: parallel projection */
} froe_eye;

/* ------------------------------------------------------------- depth order -- */

typedef struct froe_order_options {
    size_t size;                /**< set by froe_order_defaults() */
    bool front_to_back;         /**< default false: back to front, the painter's order */
    const uint32_t *ranks;      /**< one per object, or NULL: its face, see froe_objects. Of pieces that lie in one cut
                                those of higher rank are in front, from both sides, whatever the eye; of
                                equal ranks those that come later in the tree */
    unsigned threads;           /**< froe_tree_orders() only; 0: one per processor */
    froe_progress_fn *progress; /**< froe_tree_orders() only; may be NULL */
    void *user;                 /**< for progress */
} froe_order_options;
FROE_DEFAULTS(froe_order_options, froe_order_defaults);

/** Receives one piece (see froe_tree_piece); false stops. */
typedef bool froe_order_fn(void *user, size_t piece);

/** Visits all pieces of a tree in R^2 or R^3 so that, as the eye sees them, none hides one that comes after it
 * (front to back) or before it (back to front), by the side of the eye at each cut (Fuchs, Kedem, Naylor, "On visible
 * surface generation by a priori tree structures", 1980). Pieces in a cut come between what is before
 * and what is behind it. options NULL: the defaults. Stopping is no failure.
 * FROE_E_ARG: NaN, infinity, or a direction of length 0. FROE_E_UNSUPPORTED: boxes, balls or hulls, which are never
 * cut, or a leaf with several pieces that do not lie in one plane (build with leaf 1 or 0). FROE_E_MEMORY.
 * O(nodes + pieces), O(height) memory. */
FROE_API froe_status froe_tree_order(const froe_tree *tree, const froe_eye *eye, const froe_order_options *options,
                                     froe_order_fn *fn, void *user, froe_diagnostic *diag);
/** The same for `count` eyes at once: pieces[e * froe_tree_piece_count(tree) ..] receives the order of eye e. Each
 * cut is read once for 32 eyes, and eyes are shared among threads. Also FROE_E_CANCELLED. */
FROE_API froe_status froe_tree_orders(const froe_tree *tree, const froe_eye *eyes, size_t count,
                                      const froe_order_options *options, uint32_t *pieces, froe_diagnostic *diag);

/** Where a walk by depth is at a node. */
typedef enum froe_order_stage {
    FROE_ORDER_BEGIN = 0, /**< before everything in its region */
    FROE_ORDER_LIST = 1,  /**< at its list, of an inner node between its two sides */
    FROE_ORDER_END = 2    /**< after everything in its region */
} froe_order_stage;
/** Receives a node at each stage; false stops. */
typedef bool froe_order_node_fn(void *user, froe_node node, froe_order_stage stage);
/** The walk by itself: visits every node of a tree in R^2 or R^3, whatever its objects and leaves, so that no region
 * hides one that comes after it (front to back) or before it (back to front). What is in the list of one node is in
 * no order. Of the options front_to_back alone counts. Stopping is no failure. FROE_E_ARG: as froe_tree_order().
 * FROE_E_UNSUPPORTED: other dimensions. FROE_E_MEMORY. O(nodes) time, O(height) memory. */
FROE_API froe_status froe_tree_order_nodes(const froe_tree *tree, const froe_eye *eye,
                                           const froe_order_options *options, froe_order_node_fn *fn, void *user,
                                           froe_diagnostic *diag);

/* ----------------------------------------------------------------- surface -- */

/** What belongs together in the polygons of a scene in space, for any eye. A patch is a maximal set of
 * polygons of one group that lie in one plane, exactly, and hang together by edges that just two of them use, from
 * their two sides. An edge is a pair of vertices between which at least one polygon has an edge. A wire is a segment of
 * the scene, and a point is a point of it, or a segment of length 0. Polygons without area are none of these.
 * Immutable; the scene may neither grow nor be freed before it. */
typedef struct froe_surface froe_surface;
/** alloc NULL: malloc. FROE_E_UNSUPPORTED: the scene is not in space. O(corners) time. */
FROE_API froe_status froe_surface_new(const froe_scene *scene, const froe_allocator *alloc, froe_surface **out,
                                      froe_diagnostic *diag);
FROE_API void froe_surface_free(froe_surface *surface);

/** Ordered by the first object of each, ascending. */
typedef struct froe_patch {
    uint32_t group;          /**< of all its objects, or FROE_NONE */
    const uint32_t *objects; /**< ascending */
    size_t object_count;     /**< 0: there is no such patch */
} froe_patch;
FROE_API size_t froe_surface_patch_count(const froe_surface *surface);
FROE_API froe_patch froe_surface_patch(const froe_surface *surface, uint32_t patch);
/** FROE_NONE if the object belongs to none. */
FROE_API uint32_t froe_surface_patch_of(const froe_surface *surface, uint32_t object);

/** Ordered by their vertices. */
typedef struct froe_edge {
    uint32_t vertex[2];      /**< ascending */
    const uint32_t *objects; /**< that use it, ascending; one that uses it twice is there twice */
    size_t object_count;     /**< 0: there is no such edge */
} froe_edge;
FROE_API size_t froe_surface_edge_count(const froe_surface *surface);
FROE_API froe_edge froe_surface_edge(const froe_surface *surface, uint32_t edge);
/** The edge that leaves a corner of an object, or FROE_NONE. */
FROE_API uint32_t froe_surface_edge_of(const froe_surface *surface, uint32_t object, uint32_t corner);

/** Wires and points are ordered by their objects, which these give; FROE_NONE: there is no such wire or point. */
FROE_API size_t froe_surface_wire_count(const froe_surface *surface);
FROE_API uint32_t froe_surface_wire(const froe_surface *surface, uint32_t wire);
FROE_API size_t froe_surface_point_count(const froe_surface *surface);
FROE_API uint32_t froe_surface_point(const froe_surface *surface, uint32_t point);

/* -------------------------------------------------------------- visibility -- */

#define FROE_WINDOW_MOST 64 /**< corners of a window */

typedef struct froe_visibility_options {
    size_t size;  /**< set by froe_visibility_defaults() */
    froe_eye eye; /**< default: at the origin */
    /** A convex polygon in space, 3 doubles a corner: only what is seen through it counts, before or behind it.
     * NULL: everything around the eye counts (an eye at a point looks in all directions). */
    const double *window;
    size_t window_corners;
    const uint8_t *clear;        /**< per patch, not 0: transparent; NULL: all are opaque */
    const int32_t *priorities;   /**< per patch; where patches overlap in one plane, the one of higher priority is seen,
                                      of equal ones the later; NULL: all equal */
    const uint8_t *edges;        /**< per edge, not 0: its intervals are wanted; NULL: all */
    bool faces_only;             /**< nothing is asked about segments and points */
    bool crossings;              /**< lines along which polygons pass through each other are wanted */
    bool hidden_crossings;       /**< and what is hidden of them, at the cost of all that is hidden */
    int section;                 /**< -1 or 1: only what lies on the negative or positive side of the root's cut, or in
                                      it, is there: see froe_tree_section(); 0 (default): all */
    bool cull_back;              /**< polygons whose corners turn right, as the eye sees them, are not there */
    const froe_allocator *alloc; /**< NULL: malloc */
    froe_progress_fn *progress;  /**< may be NULL */
    void *user;                  /**< for progress */
} froe_visibility_options;
FROE_DEFAULTS(froe_visibility_options, froe_visibility_defaults);

/** What one eye sees. Immutable; belongs to tree and surface, which must outlive it. */
typedef struct froe_visibility froe_visibility;

/** Finds, exactly, which part of every polygon is visible, which part of every edge and segment, and which points.
 *
 * The pieces of the tree come front to back; those of them that are open are kept and, unless they are transparent,
 * close the part of the picture that they take, which is a BSP of lines of sight (a beam tree). Each line is a plane
 * through the eye and an edge, or through the eye and a cut of the tree across a polygon, and every side is decided
 * from the input doubles. A part of an edge is visible where one of
 * its faces is visible beside it; edges whose faces are all seen edge-on have no visible part.
 *
 * A point, also one of a segment, is hidden where a polygon lies between it and the eye, border included, that is
 * opaque, not culled, not cut away and not seen edge-on. So it is visible where it lies in a polygon or on its border,
 * from both sides, if nothing else hides it. Intervals of segments pass over what is hidden as a single point, behind a
 * corner. Segments and points hide nothing. A segment that the eye sees as a point,
 * and a point at the eye, are not visible. What lies in the section is not cut away.
 *
 * FROE_E_ARG: the eye is none, the surface is not of the tree's scene. FROE_E_OPTIONS. FROE_E_INPUT: the window, as the
 * eye sees it, is not strictly convex. FROE_E_UNSUPPORTED: see froe_tree_order(), but segments and points may share
 * leaves, and a scene without polygons may have any tree. FROE_E_LIMIT: 2^31 - 1 objects or more. FROE_E_MEMORY,
 * FROE_E_CANCELLED. Time and memory O(pieces + visible pieces) times the depth of the beam tree, about 20 to 60 on real
 * scenes. */
FROE_API froe_status froe_visibility_new(const froe_tree *tree, const froe_surface *surface,
                                         const froe_visibility_options *options, froe_visibility **out,
                                         froe_diagnostic *diag);
FROE_API void froe_visibility_free(froe_visibility *visibility);

/** A visible piece: a convex part of one polygon, seen whole. Those of a patch do not overlap. */
typedef struct froe_visible {
    uint32_t patch, object;
    uint32_t piece;   /**< of the tree: froe_tree_piece() */
    uint32_t place;   /**< of that piece front to back: pieces behind have higher places */
    uint32_t corners; /**< 0: there is no such visible piece */
} froe_visible;
/** Visible pieces are ordered by patch, those of a patch front to back. */
FROE_API size_t froe_visibility_piece_count(const froe_visibility *visibility);
FROE_API froe_visible froe_visibility_piece(const froe_visibility *visibility, size_t i);
/** Pieces of a patch: *first .. *first + the result - 1. */
FROE_API size_t froe_visibility_of_patch(const froe_visibility *visibility, uint32_t patch, size_t *first);
/** Corners in space, 3 doubles each, turning left as the eye sees them; up to `capacity` are written. They are rounded
 * (only this output is), to some units in the last place of what the view resolves. Returns how many there are. */
FROE_API size_t froe_visibility_corners(const froe_visibility *visibility, size_t i, double *coords, size_t capacity);

/** A part of an edge, from + t (to - from) with t from its lower vertex (0) to its higher (1). */
typedef struct froe_interval {
    double from, to;
} froe_interval;
/** The visible intervals of an edge, ascending and disjoint, touching ones joined; what is between them is hidden.
 * They were ordered and joined exactly; only these numbers are rounded. Live as long as the visibility. */
FROE_API const froe_interval *froe_visibility_of_edge(const froe_visibility *visibility, uint32_t edge, size_t *count);

/** The same of a segment, with t from its first corner (0) to its second (1). */
FROE_API const froe_interval *froe_visibility_of_wire(const froe_visibility *visibility, uint32_t wire, size_t *count);
/** Is it visible? */
FROE_API bool froe_visibility_of_point(const froe_visibility *visibility, uint32_t point);

/** A part of the line along which a patch passes through polygons of another plane, or through the section. */
typedef struct froe_crossing {
    uint32_t patch;        /**< the one of the two that the tree has cut */
    bool section;          /**< no crossing: where the section cuts the patch */
    bool hidden;           /**< by something else; otherwise all of it is visible */
    double from[3], to[3]; /**< rounded as by froe_visibility_corners() */
} froe_crossing;
/** All of them, when they were wanted, visible ones first; found and joined exactly. Where a polygon is seen edge-on
 * there is none, but for the section as seen from the side that is left out. They live as long as the visibility. */
FROE_API const froe_crossing *froe_visibility_crossings(const froe_visibility *visibility, size_t *count);

/** Receives the visible region of a patch: ring i has the corners starts[i] .. starts[i+1] - 1, 3 doubles each. Outer
 * rings turn left as the eye sees them, holes right. The arrays live until it returns; false stops. */
typedef bool froe_region_fn(void *user, uint32_t patch, const double *coords, const size_t *starts, size_t rings);
/** The visible regions of the patches that have one, as rings, in the order of their numbers, from `first` on, `count`
 * patches. Pieces are joined exactly; corners are rounded as by froe_visibility_corners(). Where sides of one
 * patch lie on one line of sight by different edges (T-junctions), a cut may stay. FROE_E_MEMORY. */
FROE_API froe_status froe_visibility_regions(const froe_visibility *visibility, uint32_t first, uint32_t count,
                                             froe_region_fn *fn, void *user, froe_diagnostic *diag);

typedef struct froe_visibility_report {
    uint64_t pieces;         /**< of the tree that were visited before the picture was closed */
    uint64_t visible_pieces; /**< convex parts that are visible */
    /** Patches: each is counted once, by the first of these that applies. */
    uint64_t visible_patches;
    uint64_t cut_away;         /**< wholly on the side of the section that is not there */
    uint64_t edge_on;          /**< the eye is in their plane */
    uint64_t culled;           /**< seen from behind, with cull_back */
    uint64_t hidden;           /**< by others, or away from the window */
    uint64_t points, segments; /**< objects of the scene of which nothing is visible, or was asked for; points with
                                    segments of length 0 */
    uint64_t visible_points, visible_segments;
    uint64_t flat; /**< polygons without area: nothing is seen of them */
    uint64_t intervals;
    uint64_t screen_nodes; /**< of the beam tree */
    uint64_t lines;
    froe_predicate_stats predicates;
    uint64_t reserved[8];
} froe_visibility_report;
FROE_API froe_visibility_report froe_visibility_statistics(const froe_visibility *visibility);

/* ------------------------------------------------------------------ camera -- */

/** How a scene becomes a page. Lengths on the page are in units of the caller's choice; y points down. */
typedef struct froe_camera {
    size_t size;   /**< set by froe_camera_defaults() */
    bool parallel; /**< parallel projection; default false: perspective */
    bool fit;      /**< perspective: the eye moves along its line of view, and the page is centred, so that the
                        whole scene just fits; parallel: the same by scale. Default true */
    double eye[3], target[3]; /**< looked from, looked at. Default: from (3, -5, 2) at the origin, so that fitting
                                   needs a direction only; fit aims at the middle of the scene instead of the target */
    double up[3];             /**< what points up on the page; default (0, 0, 1) */
    double fov;   /**< perspective: angle between the lower and the upper margin, degrees, 1 .. 170; default 35 */
    double scale; /**< parallel: page units per unit of the scene; 0 (default): as fits */
    const double *section;        /**< 4 doubles: fit what lies where section[0..2] . x <= section[3]; NULL: all */
    double width, height, margin; /**< of the page; default 1000, 1000, 20 */
    double reserved[4];
} froe_camera;
FROE_DEFAULTS(froe_camera, froe_camera_defaults);

/** A camera put in place. */
typedef struct froe_projection {
    froe_eye eye;
    double origin[3]; /**< seen at `centre` */
    double right[3], up[3],
        back[3];          /**< orthogonal and of length 1, up to rounding: the page's axes, and towards the eye */
    double scale;         /**< page units per unit of the scene at distance 1 (parallel: at any) */
    double centre[2];     /**< on the page */
    double near;          /**< perspective: nothing nearer than this is drawn: 10^-6 of the scene's extent */
    double width, height; /**< of the page */
    double window[12];    /**< the page as a window in space: see froe_visibility_options */
    int up_axis;          /**< -1, or the axis that took the place of an `up` along the line of view */
    double reserved[4];
} froe_projection;
/** Computed in doubles by + - * / and square roots alone: the same everywhere. Only the eye, and the window as
 * rounded, decide what is visible. FROE_E_OPTIONS: not from _defaults(), a size, angle or scale out of range.
 * FROE_E_ARG: the eye is at the target, NaN, infinity, or too far away. FROE_E_INPUT: nothing to fit.
 * FROE_E_UNSUPPORTED: the scene's extent is not in 2^-1000 .. 2^1000, nor 0. O(vertices). */
FROE_API froe_status froe_camera_place(const froe_camera *camera, const froe_scene *scene, froe_projection *out,
                                       froe_diagnostic *diag);
/** A turntable: cameras[0 .. count-1] look at the middle of the scene as `camera` looks at its target, the i-th turned
 * by 360 i / count degrees about `up`, all from one distance and at one scale, at which the scene stays within the
 * page. Failures as froe_camera_place(). */
FROE_API froe_status froe_camera_turn(const froe_camera *camera, const froe_scene *scene, size_t count,
                                      froe_camera *cameras, froe_diagnostic *diag);
/** The same as a rigid body turns (froe_body.turns): for i from 0 to `count` the quaternion at turns[4 i ..], by which
 * the i-th camera is turned; the last one, a whole turn later, is the first, negated. FROE_E_ARG: `up` is 0 or no
 * number. */
FROE_API froe_status froe_camera_turns(const froe_camera *camera, size_t count, double *turns, froe_diagnostic *diag);
/** Where a point is on the page; false, nothing written, when it is not before the eye. */
FROE_API bool froe_project(const froe_projection *view, const double *point, double page[2]);

/* ----------------------------------------------------------------- picture -- */

/** What shapes a picture is made of. */
typedef enum froe_paint {
    FROE_PAINT_WHOLE = 0,     /**< whole patches in an order in which they paint each other over; few are clipped */
    FROE_PAINT_REGIONS = 1,   /**< visible regions, which do not overlap, unless one sees through some: for plotters and
                                   cutters */
    FROE_PAINT_FRAGMENTS = 2, /**< pieces of the tree that are visible anywhere, back to front */
    FROE_PAINT_COUNT = 3
} froe_paint;
/** "whole", "regions", "fragments"; NULL for other numbers. */
FROE_API const char *froe_paint_name(froe_paint paint);

typedef struct froe_picture_options {
    size_t size;                 /**< set by froe_picture_defaults() */
    const froe_projection *view; /**< needed */
    froe_paint paint;            /**< default WHOLE */
    bool no_fills;               /**< lines only */
    double underlap;             /**< WHOLE: how far, on the page, shapes go under neighbours that are painted later, so
                                      that antialiasing shows no seams; 0 (default): not at all */
    const uint32_t *styles;    /**< per patch; shapes of one style are put next to each other where the order allows it;
                                    NULL: all of one style */
    const uint8_t *clear;      /**< per patch, not 0: transparent; NULL: all are opaque */
    const int32_t *priorities; /**< see froe_visibility_options */
    int section;               /**< the same */
    bool cull_back;            /**< the same */
    uint32_t lines;            /**< bits of froe_line; default 0: none */
    double crease;             /**< degrees from which on an edge is a crease, 0 .. 180; default 30 */
    const uint32_t *chains;    /**< per object: lines of objects of different numbers are strokes of their own; NULL:
                                    lines run on from any object to any other */
    bool hidden;               /**< hidden lines as well */
    double halo;               /**< gap in lines before a nearer line, on the page; default 0: none */
    double interleave;         /**< WHOLE: half the width of a line. Each visible line is then painted before what is
                                    nearer and visible within that reach, and after what is not; default 0: lines
                                    are painted after all shapes */
    double interleave_points;  /**< the same of points: half their width */
    double min_area;           /**< patches of which less is visible, in square units of the page, are left out; the
                                    report says how many and how much; default 0 */
    uint64_t max_graph;        /**< WHOLE: most pairs to compare; 0 (default): 1,000 for each visible piece, 50 million
                                    at least. Beyond them the picture is made of fragments and says so: see
                                    froe_picture_report */
    unsigned threads;          /**< 0: one per processor; no picture depends on it */
    const froe_allocator *alloc; /**< NULL: malloc */
    froe_progress_fn *progress;
    void *user;
} froe_picture_options;
FROE_DEFAULTS(froe_picture_options, froe_picture_defaults);

/** Shapes and lines on a page, in the order in which they are painted. Immutable. */
typedef struct froe_picture froe_picture;
/** Computes visibility, the order, and the shapes. Every sample point of the page shows what a ray through it meets
 * first: each patch comes after all others over whose visible parts it lies; where such demands form cycles a few
 * patches are clipped to what is visible of them. `clear` patches are transparent, layer by layer. Failures as
 * froe_visibility_new(). */
FROE_API froe_status froe_picture_new(const froe_tree *tree, const froe_surface *surface,
                                      const froe_picture_options *options, froe_picture **out, froe_diagnostic *diag);
FROE_API void froe_picture_free(froe_picture *picture);

typedef struct froe_shape {
    uint32_t patch, style;
    bool whole;        /**< the whole patch; otherwise clipped to what is visible, or a fragment */
    size_t first_ring; /**< rings fill by the nonzero rule; outer ones turn left seen with y upwards */
    size_t ring_count; /**< 0 with patch FROE_NONE: there is no such shape */
} froe_shape;
FROE_API size_t froe_picture_shape_count(const froe_picture *picture);
FROE_API froe_shape froe_picture_shape(const froe_picture *picture, size_t i);
/** Points of a ring on the page: 2 doubles each, not rounded to anything. */
FROE_API const double *froe_picture_ring(const froe_picture *picture, size_t ring, size_t *points);

/** Kinds of lines, as bits. An edge gets the first that applies. Where lines of different kinds lie on each other on
 * the page, exactly or as far as it can tell, one is drawn: a visible one before a hidden one, then the first of
 * section, wire, border, silhouette, crossing, object, material, crease and mesh. */
typedef enum froe_line {
    FROE_LINE_BORDER = 1,     /**< used by one polygon, or by more than two */
    FROE_LINE_SILHOUETTE = 2, /**< between a polygon seen from the front and one seen from behind */
    FROE_LINE_OBJECT = 4,     /**< between groups of different names, or of one name, material and colour */
    FROE_LINE_MATERIAL = 8,   /**< between groups of one name and different materials */
    FROE_LINE_CREASE = 16,    /**< between planes at an angle */
    FROE_LINE_MESH = 32,      /**< any other edge between patches */
    FROE_LINE_CROSSING = 64,  /**< no edge: where polygons pass through each other; only visible parts */
    FROE_LINE_SECTION = 128,  /**< no edge: where the section cuts polygons; only visible parts */
    FROE_LINE_WIRE = 256,     /**< no edge: a segment of the scene */
    FROE_LINE_POINT = 512,    /**< no line: a point of the scene; only visible ones */
    FROE_LINE_END = 1024      /**< no kind */
} froe_line;
/** "border", "silhouette", "object", "material", "crease", "mesh", "crossing", "section", "wire", "point"; NULL for
 * anything else. */
FROE_API const char *froe_line_name(froe_line kind);

typedef struct froe_stroke {
    froe_line kind;
    bool hidden, closed;
    bool butt[2];         /**< the end is where something begins to hide the line: no round cap may stick out there */
    size_t place;         /**< shapes that are painted before it: all, unless lines are interleaved */
    const double *points; /**< 2 doubles each */
    const double *space;  /**< the same points in the scene, 3 doubles each; rounded as all points here are */
    /** Per point: the object that the line from it to the next point belongs to. (The last point of an open line
     * repeats the one before.) An edge belongs to the first of its polygons that faces the eye, or else to the first.
     * A line where polygons pass through each other, or where a section cuts them, belongs to the first object of the
     * patch that is divided. Of lines that lie on each other, it is the object of the one that is drawn. */
    const uint32_t *objects;
    size_t count; /**< POINT: 1; 0: there is no such stroke */
} froe_stroke;
/** Polylines, by place, then hidden ones first, then by kind, wires by group. Points come last, the farthest first. */
FROE_API size_t froe_picture_stroke_count(const froe_picture *picture);
FROE_API froe_stroke froe_picture_stroke(const froe_picture *picture, size_t i);

typedef struct froe_picture_report {
    froe_visibility_report visibility;
    froe_paint paint;      /**< what it is made of: FRAGMENTS although WHOLE was asked for when max_graph was reached */
    uint64_t arcs, tests;  /**< of the order, and pairs compared for them */
    uint64_t cyclic, late; /**< patches in circles, and those clipped (or divided) to break them */
    uint64_t shapes, whole, points, strokes; /**< points: corners of shapes; strokes: with dots */
    uint64_t dots;                           /**< points of the scene */
    uint64_t left_out;                       /**< patches, by min_area */
    double left_out_area;                    /**< of all of them together */
    uint64_t reserved[8];
} froe_picture_report;
FROE_API froe_picture_report froe_picture_statistics(const froe_picture *picture);

#ifdef __cplusplus
}
#endif
#endif
