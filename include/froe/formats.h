/* formats.h: scenes and motions from files and to files, and generated ones, by the core alone.
 *
 *     froe_scene *scene;  froe_read_report report;  froe_diagnostic diag;
 *     froe_read_options o = froe_read_defaults();
 *     if (froe_read_own("house.obj", &o, &scene, &report, &diag)) puts(diag.message);
 *
 * What is here needs no other library. froe/io.h reads every format of GDAL and assimp besides. Nothing is printed.
 * All functions may be called from several threads at once. */
#ifndef FROE_FORMATS_H
#define FROE_FORMATS_H

#include <froe/kinetic.h>

#ifdef __cplusplus
extern "C" {
#endif

/* -------------------------------------------------------------------- read -- */

/** What becomes of the faces of a solid model. */
typedef enum froe_faces {
    FROE_FACES_TRIANGLES = 0, /**< every polygon is triangulated */
    FROE_FACES_POLYGONS = 1   /**< exactly planar, convex and simple polygons stay whole; others are triangulated */
} froe_faces;

/** An image: rows from the top, 4 bytes a pixel: red, green, blue (sRGB) and opacity. */
typedef struct froe_image {
    uint32_t width, height; /**< at least 1 each */
    uint8_t *pixels;        /**< of the allocator, 4 * width * height bytes */
} froe_image;

/** Reads an image: the file `path`, or where bytes are given these, as a file's would be. It may be smaller than in the
 * file. False: it cannot be read, or memory is short; then nothing is left to be freed. */
typedef bool froe_image_fn(void *user, const char *path, const void *bytes, size_t count, const froe_allocator *alloc,
                           froe_image *out);

typedef struct froe_read_options {
    size_t size;                 /**< set by froe_read_defaults() */
    const char *name;            /**< what messages call the file; NULL: the path */
    const char *layer;           /**< OGR: read this layer only; NULL: all, or the only one, or of TopoJSON the first */
    const char *where;           /**< OGR: attribute filter, as in SQL's WHERE; NULL: none */
    froe_faces faces;            /**< solid models: default FROE_FACES_TRIANGLES */
    bool boxes;                  /**< the bounding box of every feature (or row, or node) instead of its shape */
    bool wrap;                   /**< maps: cut borders that cross the antimeridian there; with `boxes`
                                      features wider than 180 degrees give two, one on each side of Greenwich */
    froe_progress_fn *progress;  /**< may be NULL; false cancels */
    void *user;                  /**< for progress */
    froe_image_fn *image;        /**< reads textures, whose means faces are coloured by; NULL (default): none is read.
                                      froe_read() of froe/io.h takes one of its own then, by GDAL */
    void *image_user;            /**< for image */
    const froe_allocator *alloc; /**< of the scene and of the reader's own arrays; NULL: malloc */
} froe_read_options;
FROE_DEFAULTS(froe_read_options, froe_read_defaults); /**< all layers, triangles, shapes */

/** How a file was read: nothing is done to a scene that is not counted here. */
typedef struct froe_read_report {
    char format[64];      /**< e.g. "GeoJSON", "CSV boxes", "glTF2 (assimp)" */
    char precision[16];   /**< of the reader's coordinates: "float64" or "float32" */
    uint64_t layers;      /**< layers read; 1 for files without layers */
    uint64_t layers_left; /**< layers not read; of glTF, scenes beside the one that is to be shown */
    uint64_t features;    /**< features, rows, or nodes or named objects with faces */
    uint64_t groups;
    uint64_t linearised;   /**< curves replaced by chords (OGR's default step, 4 degrees) */
    uint64_t flattened;    /**< features with a z other than 0, which was left out of a plane map */
    uint64_t triangulated; /**< polygons of more than 3 corners that were split into triangles */
    uint64_t closed;       /**< polygon rings without their last edge, which was added */
    uint64_t skipped;      /**< geometries without extent to read: of no known sort, empty, lines of one point */
    uint64_t no_geometry;  /**< features that have none */
    uint64_t wrapped;      /**< features that were cut at the antimeridian */
    uint64_t textures;     /**< images that materials name */
    uint64_t unread;       /**< of these: not there, not at or below the folder of the file, or unreadable */
    char unread_name[64];  /**< the first of them */
    /** OBJ: the first library of materials (MTL) that is not there, not at or below the folder of the file, or
     * unreadable; "": none, or with `boxes`, where nothing is coloured. */
    char unread_library[64];
    bool no_degrees;     /**< the format promises longitudes and latitudes in degrees, and the coordinates cannot be
                                any (beyond 180 or 90): the scene has no coordinate system */
    double seconds;      /**< from call to return, by the wall clock */
    char sorts_left[48]; /**< sorts of entities of a DXF that GDAL passes over, or of parts of a model that assimp does,
                            as "MESH, 3DSOLID", as many as fit; they are not counted; "": none */
    uint64_t reserved[2];
} froe_read_report;

/** Reads a scene from one of the formats that need no other library. The content of the file decides which reader is
 * used, then its extension:
 *
 *   CSV by header   points `x,y[,z...]`, boxes `lo_x,lo_y[,...],hi_x,hi_y[,...]`, balls `x,y[,...],r`,
 *                   segments `from_x,from_y[,...],to_x,to_y[,...]`, hulls `hull,x,y[,...]`, a row a corner;
 *                   the axes are called x y z w x5 x6 x7 x8 (or x1 ... x8), columns come in any order,
 *                   a column `tag` (a whole number below 2^64) becomes the tag, others are ignored.
 *                   Decimal numbers become the nearest doubles, whatever the locale.
 *   OFF, OBJ, PLY   dimension 3, double precision (binary PLY: its own). In OBJ each pair of an
 *                   object's (o, g) name and a material is a group, coloured by the MTL beside it. Where
 *                   corners have colours or a material has a texture (map_Kd), so is each colour of a
 *                   face: the mean of its corners, or of its part of the texture, in 64 steps a channel.
 *   GeoJSON         dimension 2: collections of features that are plain (RFC 7946): positions of two numbers, in WGS 84
 *                   or, where a member `crs` is null, without a coordinate system; as froe_read() does, without GDAL.
 *                   Names of features are strings and whole numbers, and their ids are of one kind.
 *
 * `face` of an object is the lowest id among those of the same source polygon. With `boxes` every
 * feature gives one box. The caller frees the scene. `options`, `report` and `diag` may be NULL. The time is
 * proportional to the bytes of the file, which is held in memory.
 *
 * FROE_E_IO: missing, unreadable, a directory. FROE_E_FORMAT: empty, truncated or broken. FROE_E_INPUT: NaN or infinite
 * coordinates, or no objects at all; the message names the feature. FROE_E_UNSUPPORTED: another format, moving
 * features, more than 8 axes, GeoJSON that is not plain, or with layer or filter; froe_read() may read such a file.
 * FROE_E_OPTIONS: layer, filter or `wrap`, which are for maps. FROE_E_ARG, FROE_E_MEMORY,
 * FROE_E_CANCELLED, FROE_E_LIMIT. */
FROE_API froe_status froe_read_own(const char *path, const froe_read_options *options, froe_scene **out,
                                   froe_read_report *report, froe_diagnostic *diag);
/** Receives a batch of objects, which lasts as long as the call. Anything but FROE_OK ends the reading, which returns
 * it. `diag`, which is never NULL, takes the message of such a failure; without one, froe_read_batches() names the
 * status. */
typedef froe_status froe_objects_fn(void *user, int dim, const froe_objects *batch, froe_diagnostic *diag);
/** Reads a CSV file as froe_read_own() does, but hands its objects over in batches, in their order, instead of making a
 * scene of them: for more objects than memory holds. Objects without tags have their numbers as tags, from 0. It takes
 * some 100 MB whatever the size of the file. FROE_E_UNSUPPORTED: another format, or a CSV that names groups; both are
 * read as scenes. Otherwise as froe_read_own(). */
FROE_API froe_status froe_read_batches(const char *path, const froe_read_options *options, froe_objects_fn *fn,
                                       void *user, froe_read_report *report, froe_diagnostic *diag);
/** Is this a file that froe_read_own() reads, if it is right and, of GeoJSON, plain? By its first 4096 bytes, then its
 * extension. False, too: NULL, or it
 * cannot be read. */
FROE_API bool froe_reads_own(const char *path);

/* ------------------------------------------------------------------- write -- */

/** Writes a scene so that froe_read() of froe/io.h gives it back, exactly: .geojson or .json (points, segments and
 * boxes in the plane), .csv (all but polygons, one kind), .off or .obj (polygons,
 * segments and points in space). Numbers have the digits that give the same doubles again. GeoJSON and
 * OBJ keep the names of groups, CSV keeps tags. Atomic: `path` holds the old file or the new one, whole.
 * FROE_E_UNSUPPORTED: this kind, dimension or extension does not go together. FROE_E_IO. */
FROE_API froe_status froe_write_scene(const froe_scene *scene, const char *path, froe_diagnostic *diag);

typedef enum froe_export_what {
    FROE_EXPORT_FRAGMENTS = 0, /**< every piece, with object, face, group, name, tag and node */
    FROE_EXPORT_CELLS = 1,     /**< every leaf's region, with node, depth and number of pieces */
    FROE_EXPORT_CUTS = 2       /**< every cut within its region, with node, depth and number of pieces in it */
} froe_export_what;

typedef struct froe_export_options {
    size_t size;                /**< set by froe_export_defaults() */
    const double *lo, *hi;      /**< cells and cuts are clipped to this box, dim doubles each;
                                     NULL: the scene's bounds and a tenth more on every side */
    froe_progress_fn *progress; /**< may be NULL */
    void *user;                 /**< for progress */
} froe_export_options;
FROE_DEFAULTS(froe_export_options, froe_export_defaults);

/** Does froe_export() write files with this ending? False for NULL. */
FROE_API bool froe_exports_own(const char *path);

typedef enum froe_part_sort {
    FROE_PART_POINTS = 0,
    FROE_PART_LINE = 1,    /**< two corners */
    FROE_PART_POLYGON = 2, /**< corners in order; the first is not repeated */
    FROE_PART_SURFACE = 3  /**< in space: polygons around a solid */
} froe_part_sort;

/** A whole number, a text, or nothing. */
typedef struct froe_attribute {
    const char *name;
    const char *text; /**< NULL: a number */
    uint64_t number;
    bool missing;
} froe_attribute;

enum { FROE_PART_ATTRIBUTES = 12 };

/** A fragment, a cell or a cut, with its attributes. */
typedef struct froe_part {
    froe_part_sort sort;
    froe_kind kind; /**< of the object that a fragment belongs to; of cells and cuts FROE_KIND_NONE */
    int dim;
    const double *coords; /**< dim doubles a corner */
    size_t corners;
    const size_t *starts; /**< surfaces: polygon f has the corners starts[f] .. starts[f+1] - 1 */
    size_t faces;         /**< surfaces: how many polygons */
    froe_attribute attributes[FROE_PART_ATTRIBUTES];
    int attribute_count;
} froe_part;

/** A part without geometry, with the names of the attributes of all parts; those that are texts have a text. */
FROE_API froe_part froe_part_like(froe_export_what what);
typedef bool froe_part_fn(void *user, const froe_part *part);
/** Calls fn for each fragment, cell or cut, in an order that is the same each time; what it is given lasts as long as
 * the call. False ends that, with FROE_OK. Memory does not grow with the tree. options may be NULL. FROE_E_ARG: no such
 * `what`; a bound of the box is not finite, or lo > hi. FROE_E_UNSUPPORTED: cells and cuts above dimension 3.
 * FROE_E_OPTIONS, FROE_E_CANCELLED, FROE_E_MEMORY. */
FROE_API froe_status froe_tree_parts(const froe_tree *tree, froe_export_what what, const froe_export_options *options,
                                     froe_part_fn *fn, void *user, froe_diagnostic *diag);

/** Writes a part of a tree for other programs, by extension: .geojson or .json (dimension 2), .obj
 * (dimension 3), .csv (any; geometry as WKT in dimensions 2 and 3). Atomic, streaming: memory does not
 * grow with the tree. GeoJSON names the coordinate system of the scene, unless that is WGS 84. options may be NULL.
 * FROE_E_UNSUPPORTED: extension and dimension do not go together, or the coordinate system has no code, and the file
 * is GeoJSON. FROE_E_IO: cannot be written, disk full. FROE_E_CANCELLED. */
FROE_API froe_status froe_export(const froe_tree *tree, const char *path, froe_export_what what,
                                 const froe_export_options *options, froe_diagnostic *diag);

/* ------------------------------------------------------------------ motion -- */

typedef struct froe_motion_read_options {
    size_t size;                 /**< set by froe_motion_read_defaults() */
    double from, to;             /**< the window; NaN (default): the first and the last instant in the file */
    const froe_allocator *alloc; /**< of the motion and of the reader's own arrays; NULL: malloc */
    const char *animation;       /**< of a model (froe_read_animation() of froe/io.h): which one, by its name or by its
                                      number from 0; NULL (default): the only one */
    const char *name;            /**< of a model: what messages call the file; NULL: the path */
    double deviation;            /**< of a model: how far a point may be from where the file's own interpolation has it,
                                      as a share of the model's size; default 1e-3 */
} froe_motion_read_options;
FROE_DEFAULTS(froe_motion_read_options, froe_motion_read_defaults);

typedef struct froe_motion_report {
    uint64_t features;  /**< with a motion */
    uint64_t still;     /**< without one: left out */
    uint64_t pieces;    /**< of flight plans: times between two instants */
    uint64_t flattened; /**< features whose z was left out */
    double seconds;     /**< from call to return, by the wall clock */
    uint64_t jumps;     /**< of a model: instants at which a part ends, and another like it begins elsewhere */
    double deviation;   /**< of a model: no point is farther from where the file's own interpolation has it, in units of
                             the model; otherwise 0 */
    double extent;      /**< of a model: its size, the diagonal of the box around it when the window begins */
    int up;             /**< the axis that points up in pictures: 0, 1 or 2 */
    uint64_t reserved[4];
} froe_motion_report;

/** Reads OGC Moving Features JSON (19-045r3): MovingPoint, MovingLineString, MovingPolygon and collections of them
 * (prisms), in a Feature or a FeatureCollection. Lines and rings become one segment per pair of neighbours, which
 * share vertices; a point becomes a segment without length. Each feature is a group, named by the first of name, title,
 * label and id among its properties, or its id, or its first property that is a text; the tag is its number, from 0.
 * Its segments live from its first instant to its last.
 * Times are milliseconds since 1970 (ISO 8601), or the numbers of the file as they are. Numbers become the nearest
 * doubles. Interpolation is Linear (also where nothing is said) or Quadratic: the parabolas that continue one another
 * with the same velocity, the first of them through the first three instants; a member `controls` beside
 * `coordinates`, of one geometry less, gives their control points itself. Coordinate systems are ignored.
 * A `base` of a MovingPoint, an object with `coordinates` (an array of positions) and `segments`, arrays of two numbers
 * of these, is a body of the plane, whose centre the point is, with `turns`, z and w for each instant (froe_body).
 * A file is of motions in space if its geometries carry triangles, by two members beside those of the standard:
 * `triangles`, arrays of three numbers of points, of a MovingPointCloud, whose points are their corners; or `base`, an
 * object with `coordinates` (an array of positions) and `triangles`, of a MovingPoint, which is then the centre of a
 * body, with `turns`, a quaternion x, y, z, w for each instant (froe_body), where it turns. A `base` without
 * `coordinates`, such as the standard's name of a model file, is ignored. One with `coordinates`, but
 * neither `triangles` nor `segments`, or `turns` without it, is FROE_E_FORMAT.
 * FROE_E_UNSUPPORTED: Discrete, Step and Cubic interpolation, other geometries. FROE_E_FORMAT: no JSON, not of this
 * form. FROE_E_INPUT: times that do not increase, geometries that change their number of points, a window in which
 * nothing is; the message names the feature. FROE_E_IO, FROE_E_MEMORY, FROE_E_OPTIONS, FROE_E_LIMIT. options, report
 * and diag may be NULL. */
FROE_API froe_status froe_read_motion(const char *path, const froe_motion_read_options *options, froe_motion **out,
                                      froe_motion_report *report, froe_diagnostic *diag);

/** The parts of a model in motion, from a .csv with the header
 *     body,time,x,y,z,qx,qy,qz,qw
 * in any order, perhaps with other columns, and perhaps without the four of the turn. A row is where the part of that
 * name (a group of the model; of several of one name, one) is at an instant: its polygons, as triangles, are turned
 * about the origin of the model by the quaternion, and then moved by x, y, z. Rows of one part are in order of time;
 * between two of them it moves as a body does (froe_body). In the plane z, if it is there, stays the same for a part,
 * and qx and qy are 0: the parts are the segments of the groups, which share vertices. A part lives from its first
 * instant to its last; a part of one row, or of none, stands still and always lives. Groups of the motion are those of
 * the model. The model may be freed afterwards. FROE_E_INPUT: no such part, no finite number, times that do not
 * increase, a quaternion whose length is not 1, a part that leaves the plane, a window in which no part moves although
 * some do; the message names line or part. FROE_E_FORMAT: a column is missing. FROE_E_UNSUPPORTED: the model is not of
 * polygons in space, or of segments in the plane. FROE_E_IO, FROE_E_MEMORY, FROE_E_OPTIONS, FROE_E_LIMIT. options,
 * report and diag may be NULL. */
FROE_API froe_status froe_read_poses(const char *path, const froe_scene *model, const froe_motion_read_options *options,
                                     froe_motion **out, froe_motion_report *report, froe_diagnostic *diag);

/** A model that rests, as a motion whose window is from `begin` to `end`: its polygons as triangles, a fan for each, in
 * their order, with vertices, groups and names of the model. The model may be freed afterwards. FROE_E_UNSUPPORTED: an
 * object is no polygon in space. FROE_E_INPUT: the window is none. FROE_E_MEMORY, FROE_E_LIMIT. O(corners). */
FROE_API froe_status froe_motion_at_rest(const froe_scene *model, double begin, double end, const froe_allocator *alloc,
                                         froe_motion **out, froe_diagnostic *diag);

/** What moves, as it is at an instant: segments in the plane, triangles in space, where they are to within a few units
 * in the last place (froe_motion_position()). Objects that begin then are there, and those that end are not, unless the
 * window ends. Tags are the objects of the motion, groups its own. FROE_E_ARG: the time is outside of the window.
 * FROE_E_MEMORY. O(objects). */
FROE_API froe_status froe_motion_scene(const froe_motion *motion, double time, const froe_allocator *alloc,
                                       froe_scene **out, froe_diagnostic *diag);

/** Writes a motion as MF-JSON so that froe_read_motion() gives it back: objects that follow one another with a common
 * vertex in one group become one line or polygon; in space, triangles of one group and one body, or of none, one
 * feature. Numbers have the digits that give the same doubles again. FROE_E_UNSUPPORTED: the vertices of one feature
 * have different instants, or its segments do not live as long as its plans. FROE_E_IO, FROE_E_MEMORY. */
FROE_API froe_status froe_write_motion(const froe_motion *motion, const char *path, froe_diagnostic *diag);

/** Writes contacts, in their order, as a table: .csv with the header
 *     a,b,begin_low,begin_high,end_low,end_high,instant,since_start,to_stop,a_name,b_name
 * (0 and 1 for no and yes, names of groups), or .json, an array of objects with the same members. FROE_E_UNSUPPORTED:
 * another extension. FROE_E_IO, FROE_E_MEMORY. */
FROE_API froe_status froe_write_contacts(const froe_motion *motion, const froe_contact *contacts, size_t count,
                                         const char *path, froe_diagnostic *diag);

/** Events on their way to a .csv with the header
 *     tick,early,late,kind,objects,a,b,c,d
 * with the number of segments that an event is about, and the first four of these. Each is written as it happens. */
typedef struct froe_event_writer froe_event_writer;
/** Begins a file; froe_event_writer_close() must follow, and `path` last until then. alloc NULL: malloc.
 * FROE_E_UNSUPPORTED: another extension. FROE_E_IO, FROE_E_MEMORY. */
FROE_API froe_status froe_event_writer_new(const char *path, const froe_allocator *alloc, froe_event_writer **out,
                                           froe_diagnostic *diag);
/** Adds an event. False: something has failed, which froe_event_writer_close() tells, and further calls add nothing. */
FROE_API bool froe_event_writer_put(froe_event_writer *writer, const froe_event *event);
/** With FROE_OK: brings the file to its place, whole. Otherwise, or where something has failed, no file is left, and
 * what was there before stays. Returns `status`, or what has failed: FROE_E_IO, FROE_E_MEMORY. NULL: returns
 * `status`. */
FROE_API froe_status froe_event_writer_close(froe_event_writer *writer, froe_status status, froe_diagnostic *diag);

/** Writes where the ends of a snapshot's objects are, exactly, as .csv with the header
 *     object,end,x,y,w,rounded
 * in whole numbers of as many digits as it takes: the place is (x / w, y / w). FROE_E_UNSUPPORTED: another
 * extension. FROE_E_IO, FROE_E_MEMORY. */
FROE_API froe_status froe_write_places(const froe_places *places, const char *path, froe_diagnostic *diag);

typedef struct froe_animation_options {
    size_t size;    /**< set by froe_animation_defaults() */
    double width;   /**< of the picture, in pixels; default 960 */
    double seconds; /**< that the whole window takes to play; default 20 */
    int up;         /**< in space: the axis that points up; default 2, which is z */
    bool numbers;   /**< times are shown as numbers. false (default): as milliseconds since 1970 by a clock, if the
                         window lasts a thousand of them */
} froe_animation_options;
FROE_DEFAULTS(froe_animation_options, froe_animation_defaults);

/** A motion as an animation, objects red while they are in contact: .svg, a picture (SMIL; parabolas by chords),
 * or .html, a page of its own that plays it, with a slider for the time and a list of the contacts. Triangles in space
 * are the film of froe_film() in froe/render.h, 15 frames a second; on its page, contacts of two groups that follow one
 * another without a gap are one, and the faces of both have an orange border meanwhile. The same bytes on every
 * platform. FROE_E_UNSUPPORTED: another extension. FROE_E_OPTIONS, FROE_E_IO, FROE_E_MEMORY, and in space the failures
 * of froe_film(). options may be NULL. */
FROE_API froe_status froe_animate(const froe_motion *motion, const froe_contact *contacts, size_t count,
                                  const froe_animation_options *options, const char *path, froe_diagnostic *diag);

/* ---------------------------------------------------------------- generate -- */

/** A kind of made-up scene. */
typedef struct froe_generator_info {
    const char *name;    /**< e.g. "segments" */
    int dim;             /**< of the scene */
    froe_kind kind;      /**< of its objects */
    const char *summary; /**< one line */
    bool usual;          /**< what users ask for; the others are for tests and benches */
} froe_generator_info;
/** The i-th kind; NULL past the last. */
FROE_API const froe_generator_info *froe_generator_at(size_t i);

/** A made-up scene of about n objects (exactly n where the kind allows it, never fewer than one unit
 * of the kind). A pure function of kind, n and seed: coordinates come from + - * / sqrt and an integer
 * hash, so that the scene is the same, bit for bit, on every platform. alloc NULL: malloc.
 * FROE_E_ARG: n is 0. FROE_E_OPTIONS: no such kind. FROE_E_LIMIT, FROE_E_MEMORY. */
FROE_API froe_status froe_generate(const char *kind, size_t n, uint64_t seed, const froe_allocator *alloc,
                                   froe_scene **out, froe_diagnostic *diag);

/** A kind of made-up motion. */
typedef struct froe_motion_generator_info {
    const char *name;    /**< e.g. "moving" */
    int dim;             /**< 2: segments; 3: triangles */
    const char *summary; /**< one line */
    bool usual;          /**< as of froe_generator_info */
} froe_motion_generator_info;
/** The i-th kind; NULL past the last. */
FROE_API const froe_motion_generator_info *froe_motion_generator_at(size_t i);
/** About n moving segments or triangles, in the window 0 .. 60; else as froe_generate(). */
FROE_API froe_status froe_generate_motion(const char *kind, size_t n, uint64_t seed, const froe_allocator *alloc,
                                          froe_motion **out, froe_diagnostic *diag);

#ifdef __cplusplus
}
#endif
#endif
