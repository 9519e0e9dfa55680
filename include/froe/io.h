/* io.h: scenes from files, files from trees, and scenes made to measure.
 *
 *     froe_scene *scene;  froe_read_report report;  froe_diagnostic diag;
 *     froe_read_options o = froe_read_defaults();
 *     if (froe_read("floor.geojson", &o, &scene, &report, &diag)) puts(diag.message);
 *
 * A companion library (link froe-io) on top of froe.h alone. Plane maps are read
 * by GDAL's OGR, solid models by assimp, numbers in CSV by froe itself. Nothing is
 * printed: what those libraries have to say ends up in the diagnostic. All
 * functions may be called from several threads at once. */
#ifndef FROE_IO_H
#define FROE_IO_H

#include <froe/froe.h>

#ifdef __cplusplus
extern "C" {
#endif

/* -------------------------------------------------------------------- read -- */

/** What becomes of the faces of a solid model. */
typedef enum froe_faces {
    FROE_FACES_TRIANGLES = 0, /**< every polygon is triangulated */
    FROE_FACES_POLYGONS = 1   /**< exactly planar, convex and simple polygons stay whole; others are triangulated */
} froe_faces;

typedef struct froe_read_options {
    size_t size;                 /**< set by froe_read_defaults() */
    const char *layer;           /**< OGR: read this layer only; NULL: all, or of a topology (TopoJSON) the first */
    const char *where;           /**< OGR: attribute filter, as in SQL's WHERE; NULL: none */
    froe_faces faces;            /**< solid models: default FROE_FACES_TRIANGLES */
    bool boxes;                  /**< the bounding box of every feature (or row, or node) instead of its shape */
    froe_progress_fn *progress;  /**< may be NULL; false cancels */
    void *user;                  /**< for progress */
    const froe_allocator *alloc; /**< of the scene and of the reader's own arrays; NULL: malloc */
} froe_read_options;
FROE_API froe_read_options froe_read_defaults(void); /**< all layers, triangles, shapes */

/** How a file was read: nothing is done to a scene that is not counted here. */
typedef struct froe_read_report {
    char format[64];      /**< e.g. "GeoJSON", "CSV boxes", "glTF2 (assimp)" */
    char precision[16];   /**< of the reader's coordinates: "float64" or "float32" */
    uint64_t layers;      /**< layers read; 1 for files without layers */
    uint64_t layers_left; /**< layers not read */
    uint64_t features;    /**< features, rows, or nodes or named objects with faces */
    uint64_t groups;
    uint64_t linearised;   /**< curves replaced by chords (OGR's default step, 4 degrees) */
    uint64_t flattened;    /**< features whose z was left out of a plane map */
    uint64_t triangulated; /**< polygons of more than 3 corners that were split into triangles */
    uint64_t closed;       /**< polygon rings without their last edge, which was added */
    uint64_t skipped;      /**< geometries without extent to read: of no known sort, empty, lines of one point */
    uint64_t no_geometry;  /**< features that have none */
    double seconds;        /**< from call to return, by the wall clock */
} froe_read_report;

/** Reads a scene. The content of the file decides who reads it, then its extension:
 *
 *   CSV by header   points `x,y[,z...]`, boxes `lo_x,lo_y[,...],hi_x,hi_y[,...]`, balls `x,y[,...],r`;
 *                   the axes are called x y z w x5 x6 x7 x8 (or x1 ... x8), columns come in any order,
 *                   a column `tag` (a whole number below 2^64) becomes the tag, others are left alone.
 *                   Decimal numbers become the nearest doubles, whatever the locale.
 *   OFF, OBJ, PLY   dimension 3, double precision (binary PLY: its own). In OBJ each pair of an object's (o, g) name
 * and a material is a group. assimp          glTF, STL, IFC, FBX, ...: dimension 3, single precision; node transforms
 * are applied in double; each pair of a node and a material of its faces is a group. Points and lines of a model become
 * points and segments. OGR             GeoJSON, TopoJSON, Shapefile, GeoPackage, FlatGeobuf, DXF, OSM, WKT in CSV, ...:
 *                   dimension 2. Lines and polygon rings become one segment per pair of vertices, in
 *                   the order of feature, part, ring, vertex; points become points; the tag is the
 *                   feature's id in its layer. Every polygon feature is a group, and so is any other
 *                   that has a name. The name is the attribute called name, title, label or id, whichever
 *                   comes first in this list, or else the feature's id; `left` or `right` repeats it
 *                   when all rings of the feature have its interior on that one side.
 *
 * `face` of an object is the lowest id among those of the same source polygon. With `boxes` every
 * feature gives one box. `report` may be NULL.
 *
 * FROE_E_IO: missing, unreadable, a directory. FROE_E_FORMAT: empty, of no known type, truncated
 * or broken. FROE_E_INPUT: NaN or infinite coordinates, or no objects at all; the message names the
 * feature. FROE_E_OPTIONS: no such layer, a filter OGR cannot apply, either of them
 * for a file that is not a map. FROE_E_UNSUPPORTED: moving
 * features, more than 8 axes. FROE_E_MEMORY, FROE_E_CANCELLED, FROE_E_LIMIT. */
FROE_API froe_status froe_read(const char *path, const froe_read_options *options, froe_scene **out,
                               froe_read_report *report, froe_diagnostic *diag);

/* ------------------------------------------------------------------- write -- */

/** Writes a scene so that froe_read gives it back, exactly: .geojson or .json (points, segments and
 * boxes in the plane), .csv (points, boxes or balls, one kind), .off or .obj (polygons,
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
FROE_API froe_export_options froe_export_defaults(void);

/** Writes a part of a tree for other programs, by extension: .geojson or .json (dimension 2), .obj
 * (dimension 3), .csv (any; geometry as WKT in dimensions 2 and 3). Atomic, streaming: memory does not
 * grow with the tree. options may be NULL. FROE_E_UNSUPPORTED: extension and dimension do not go
 * together. FROE_E_IO: cannot be written, disk full. FROE_E_CANCELLED. */
FROE_API froe_status froe_export(const froe_tree *tree, const char *path, froe_export_what what,
                                 const froe_export_options *options, froe_diagnostic *diag);

/* ---------------------------------------------------------------- generate -- */

/** A kind of made-up scene. */
typedef struct froe_generator_info {
    const char *name;    /**< e.g. "segments" */
    int dim;             /**< of the scene */
    froe_kind kind;      /**< of its objects */
    const char *summary; /**< one line */
} froe_generator_info;
/** The i-th kind; NULL past the last. */
FROE_API const froe_generator_info *froe_generator_at(size_t i);

/** A made-up scene of about n objects (exactly n where the kind allows it, never fewer than one unit
 * of the kind). A pure function of kind, n and seed: coordinates come from + - * / sqrt and an integer
 * hash, so that the scene is the same, bit for bit, on every platform. alloc NULL: malloc.
 * FROE_E_ARG: n is 0. FROE_E_OPTIONS: no such kind. FROE_E_LIMIT, FROE_E_MEMORY. */
FROE_API froe_status froe_generate(const char *kind, size_t n, uint64_t seed, const froe_allocator *alloc,
                                   froe_scene **out, froe_diagnostic *diag);

#ifdef __cplusplus
}
#endif
#endif
