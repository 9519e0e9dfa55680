/* froe.h: binary space partitions of segments in the plane, polygons in space
 * and boxes, balls, hulls, segments and points in R^d. Small on real scenes, exact, never recursive.
 *
 *     froe_scene *scene;  froe_tree *tree;
 *     froe_scene_new(2, NULL, &scene);
 *     froe_objects o = froe_objects_defaults();
 *     o.kind = FROE_SEGMENT;  o.count = n;  o.coords = xyxy;      // 4 doubles a segment
 *     froe_scene_add(scene, &o, NULL);
 *     froe_build_options b = froe_build_defaults();
 *     froe_build(scene, &b, &tree, NULL);
 *     ... froe_tree_report(tree), froe_tree_save(tree, "floor.froe", NULL) ...
 *     froe_tree_free(tree);  froe_scene_free(scene);
 *
 * Conventions of the whole interface:
 *   - A call that can fail returns a froe_status; its outputs are written only on
 *     FROE_OK, and on any failure its inputs are as they were.
 *   - The last argument `diag` of a call may be NULL; otherwise it receives, on
 *     failure, which object, which coordinate and a sentence.
 *   - Option structs come from their _defaults() function, which sets `size`. They may grow at their end:
 *     a program goes on to work with later libraries of the same soname, and is refused by earlier ones.
 *     `reserved` members of other structs are 0, and may become something.
 *   - Callbacks take their `user` pointer first and return false to stop.
 *   - There is no global state. A tree is immutable: any number of threads may
 *     read one. A scene may be filled by one thread at a time.
 *   - How the calling thread computes makes no difference: see froe_floats_begin().
 *   - Free functions accept NULL.
 */
#ifndef FROE_FROE_H
#define FROE_FROE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifndef FROE_API
#if defined(_WIN32) && defined(FROE_SHARED)
#define FROE_API __declspec(dllimport)
#elif defined(__GNUC__)
#define FROE_API __attribute__((visibility("default")))
#else
#define FROE_API
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** name(), a function of this header, returns the defaults of a struct as large as this header has it, and name_into(),
 * a function of the library, writes as much of them as a caller has room for: bindings that do not compile headers give
 * it the size that their declaration of the struct has. */
/* NOLINTBEGIN(bugprone-macro-parentheses): types and names that are declared take none */
#define FROE_DEFAULTS(type, name)                                                                                      \
    FROE_API void name##_into(type *out, size_t size);                                                                 \
    static inline type name(void) {                                                                                    \
        type made;                                                                                                     \
        name##_into(&made, sizeof made);                                                                               \
        return made;                                                                                                   \
    }                                                                                                                  \
    FROE_API void name##_into(type *out, size_t size)
/* NOLINTEND(bugprone-macro-parentheses) */

/* ------------------------------------------------------------------ limits -- */

#define FROE_MAX_DIM 8           /**< all objects but polygons exist in R^2 .. R^8 */
#define FROE_NONE UINT32_MAX     /**< "no object", "no group", "no face" */
#define FROE_LEAF_OWN UINT32_MAX /**< the leaf capacity that a method has by itself */

/* ------------------------------------------------------------------ status -- */

/** The outcome of a call. Numbers never change meaning; docs/reference/errors.md says for
 * each what to do about it. */
typedef enum froe_status {
    FROE_OK = 0,
    FROE_E_ARG = 1,         /**< null pointer, count or dimension out of range */
    FROE_E_OPTIONS = 2,     /**< struct not from _defaults(), unknown method or option, bad value */
    FROE_E_MEMORY = 3,      /**< the allocator returned NULL */
    FROE_E_INPUT = 4,       /**< NaN or infinity, a polygon that is not planar, convex and simple, ... */
    FROE_E_LIMIT = 5,       /**< more than 2^31 - 2 objects, vertices, nodes or pieces */
    FROE_E_BUDGET = 6,      /**< max_fragments would be exceeded */
    FROE_E_CANCELLED = 7,   /**< the progress callback returned false */
    FROE_E_UNSUPPORTED = 8, /**< this method, tree or reader cannot serve the request */
    FROE_E_IO = 9,          /**< a file cannot be opened, read or written */
    FROE_E_FORMAT = 10,     /**< a file is not what it claims to be, truncated or corrupted */
    FROE_E_FROZEN = 11,     /**< the scene belongs to a tree and can no longer grow */
    FROE_E_AUDIT = 12,      /**< an invariant does not hold (froe_tree_audit only) */
    FROE_STATUS_COUNT = 13
} froe_status;

/** The enumerator's name, e.g. "FROE_E_INPUT"; "FROE_E_?" for other numbers. Never NULL. */
FROE_API const char *froe_status_name(froe_status status);
/** One lower-case clause without a full stop, e.g. "bad input data". Never NULL. */
FROE_API const char *froe_status_text(froe_status status);

/** Detail of a failure. Zero-initialise it or not: a failing call writes it whole. */
typedef struct froe_diagnostic {
    froe_status status;
    uint32_t object;   /**< id or batch position of the offending object, or FROE_NONE */
    uint32_t corner;   /**< its offending corner, or FROE_NONE */
    uint32_t axis;     /**< the offending coordinate axis, or FROE_NONE */
    char message[244]; /**< a whole sentence, NUL-terminated */
} froe_diagnostic;

/** Version of the library, "major.minor.patch". */
FROE_API const char *froe_version(void);

/* --------------------------------------------------------------- allocator -- */

/** malloc, realloc and free in one: ptr NULL allocates, new_size 0 frees (and
 * returns NULL). Must be callable from several threads at once when threads > 1.
 * Returned memory is aligned for any type. A NULL return is FROE_E_MEMORY. */
typedef void *froe_alloc_fn(void *user, void *ptr, size_t old_size, size_t new_size);
typedef struct froe_allocator {
    froe_alloc_fn *fn;
    void *user;
} froe_allocator;

/** Called now and then with the share done so far, 0 <= done <= 1, from one
 * thread at a time; false cancels: the call returns FROE_E_CANCELLED. */
typedef bool froe_progress_fn(void *user, double done);

/** Receives the bytes of a file in order, some at a time; false stops (FROE_E_IO). */
typedef bool froe_write_fn(void *user, const void *bytes, size_t count);

/* ---------------------------------------------------------- floating point -- */

/** froe rounds to nearest, keeps denormal numbers, and traps no exception. A call that computes sets the processor so
 * where the calling thread has it otherwise (any rounding mode, flushed denormals, traps), and gives the settings back
 * when it returns, and for as long as one of the caller's functions runs: visitors, progress, allocators, on threads
 * that froe starts as well. Settings that such a function changes are undone when it returns. Exception flags: a call
 * clears none, and may raise some, as functions of the C library may.
 *
 * Between these two the calling thread computes as froe does (own) or as it did before (not own): for libraries on
 * top of froe that compute themselves and call functions of their callers, and for programs with settings of their own
 * that make many small calls: setting the processor takes some 0.1 microseconds a call. Returns what
 * froe_floats_end() takes, on the same thread; such pairs may be nested. */
FROE_API unsigned froe_floats_begin(bool own);
FROE_API void froe_floats_end(unsigned began);

/* ------------------------------------------------------------------- scene -- */

/** Kinds of objects. All are closed, convex point sets. */
typedef enum froe_kind {
    FROE_POINT = 0,      /**< 1 corner, any dimension */
    FROE_SEGMENT = 1,    /**< 2 corners, any dimension */
    FROE_POLYGON = 2,    /**< >= 3 corners in order, planar, convex; dimension 3 */
    FROE_BOX = 3,        /**< 2 corners lo <= hi, axis-parallel, any dimension */
    FROE_BALL = 4,       /**< centre, and a radius >= 0, any dimension */
    FROE_HULL = 5,       /**< convex hull of >= 1 corners, any dimension: a simplex, a polytope */
    FROE_KIND_COUNT = 6, /**< grows with later versions, as every _COUNT does */
    FROE_KIND_NONE = 255 /**< of an object that does not exist */
} froe_kind;

/** "point", "segment", "polygon", "box", "ball", "hull"; NULL for other numbers. */
FROE_API const char *froe_kind_name(froe_kind kind);

/** A set of objects in R^dim. Coordinates are kept exactly; equal ones share a
 * vertex (-0 counts as +0). Objects have the ids 0, 1, ... in the order they were added. */
typedef struct froe_scene froe_scene;

/** An empty scene. dim in 2..FROE_MAX_DIM. alloc is copied; NULL: malloc.
 * FROE_E_ARG, FROE_E_MEMORY. */
FROE_API froe_status froe_scene_new(int dim, const froe_allocator *alloc, froe_scene **out);
/** Releases the caller's reference. Trees built from the scene keep it alive. */
FROE_API void froe_scene_free(froe_scene *scene);

/** A batch of objects of one kind, as arrays the caller keeps. Object j has the
 * corners starts[j] .. starts[j+1]-1 (or a fixed number of them, see froe_kind);
 * corner i is the point coords[i*dim ..], or coords[indices[i]*dim ..] when
 * `indices` is given. A ball has one corner, its centre. */
typedef struct froe_objects {
    size_t size; /**< set by froe_objects_defaults() */
    froe_kind kind;
    size_t count;               /**< number of objects */
    const double *coords;       /**< points, dim doubles each */
    size_t point_count;         /**< points in coords; needed (and checked) with indices only */
    const uint32_t *indices;    /**< corner -> point; NULL: corners are the points in order */
    const size_t *starts;       /**< count + 1 offsets; polygons and hulls only, NULL: triangles */
    const double *radii;        /**< count radii; balls only */
    const uint64_t *tags;       /**< the caller's names; NULL: each object's own id */
    const uint32_t *faces;      /**< source polygon of each object; NULL: each object its own face */
    const uint32_t *groups;     /**< group of each object; NULL: `group` for all */
    uint32_t group;             /**< FROE_NONE: no group */
    froe_progress_fn *progress; /**< may be NULL */
    void *user;                 /**< for progress */
    unsigned threads;           /**< 0: one per processor; the scene does not depend on it */
} froe_objects;
FROE_DEFAULTS(froe_objects, froe_objects_defaults); /**< triangles, none, no groups */

/** Adds a batch: all of it, or on failure none of it. Zero-length segments,
 * zero-area polygons and duplicates are accepted and keep their ids.
 * FROE_E_INPUT: a coordinate is NaN or infinite, lo > hi, a radius is negative, a
 * polygon is not exactly planar, convex and simple. FROE_E_FROZEN: a tree holds
 * the scene. FROE_E_UNSUPPORTED: the kind does not exist in this dimension.
 * O(corners) expected time. */
FROE_API froe_status froe_scene_add(froe_scene *scene, const froe_objects *batch, froe_diagnostic *diag);

/** What the objects of one feature, mesh node or layer share. */
typedef struct froe_group {
    const char *name, *material;
    const char *left, *right; /**< what lies left and right of its segments; "" unknown */
    uint32_t colour;          /**< 0xRRGGBBAA: red, green and blue of sRGB, opacity; 0: unknown */
} froe_group;
/** Adds a group; *id: 0, 1, ...; `id` may be NULL. Strings are copied, and may be those of another group of the scene;
 * NULL counts as "". FROE_E_ARG, FROE_E_FROZEN, FROE_E_MEMORY. FROE_E_LIMIT: more than 2^31 - 2 groups, or 2^32 bytes
 * of strings. */
FROE_API froe_status froe_scene_add_group(froe_scene *scene, const froe_group *group, uint32_t *id);

/** The axis of a scene in space that points up in pictures: 0, 1 or 2. Readers set it by the
 * format; a new scene has 2, z. FROE_E_ARG: not such an axis, or not in space; FROE_E_FROZEN: a tree holds the
 * scene. */
FROE_API froe_status froe_scene_set_up(froe_scene *scene, int axis);
FROE_API int froe_scene_up(const froe_scene *scene); /**< -1: not in space */

/** What the coordinates of a scene mean. */
typedef enum froe_crs_kind {
    FROE_CRS_UNKNOWN = 0,    /**< nothing is known */
    FROE_CRS_GEOGRAPHIC = 1, /**< x is a longitude and y a latitude, in degrees */
    FROE_CRS_PROJECTED = 2,  /**< x and y are lengths on a map projection, mostly easting and northing */
    FROE_CRS_OTHER = 3,      /**< something else, of which the definition tells */
    FROE_CRS_KIND_COUNT = 4
} froe_crs_kind;

/** A coordinate reference system, as the file of a map names it. A scene carries it, its tree file keeps it, exports
 * write it; no number of a scene is ever changed by it. Whatever order of axes its authority prefers, x is the
 * longitude or the easting. */
typedef struct froe_crs {
    froe_crs_kind kind;
    const char *wkt;  /**< its definition, WKT 2 (ISO 19162:2019) */
    const char *name; /**< e.g. "WGS 84 / UTM zone 32N" */
    const char *code; /**< authority and number, e.g. "EPSG:32632"; "" unknown */
    const char *unit; /**< of x and y, e.g. "metre" */
} froe_crs;
/** Strings are copied; NULL counts as "". FROE_CRS_UNKNOWN takes away what was there, and has no strings. FROE_E_ARG:
 * no such kind. FROE_E_LIMIT: more than 2^24 bytes. FROE_E_FROZEN: a tree holds the scene. FROE_E_MEMORY. */
FROE_API froe_status froe_scene_set_crs(froe_scene *scene, const froe_crs *crs);
/** Strings live until the next call of froe_scene_set_crs(), at most as long as the scene; none is NULL. */
FROE_API froe_crs froe_scene_crs(const froe_scene *scene);
/** How many features of a scene in longitudes and latitudes have an edge, or a box of their own, that is wider than
 * 180 degrees, and the first object that is. As a rule the border of such a feature crosses the antimeridian, which
 * its coordinates do not tell: a straight edge from 179 to -179 runs around the whole Earth. Edges along a pole do not
 * count. Objects of one group are one feature, and so are neighbours without group that have the same tag. `first`
 * may be NULL, and is FROE_NONE where there is none. 0 for scenes of other kinds. O(n). */
FROE_API size_t froe_scene_across(const froe_scene *scene, uint32_t *first);

FROE_API int froe_scene_dim(const froe_scene *scene);
FROE_API size_t froe_scene_object_count(const froe_scene *scene);
FROE_API size_t froe_scene_vertex_count(const froe_scene *scene);
FROE_API size_t froe_scene_group_count(const froe_scene *scene);
/** Number of objects of one kind, as added. O(n). */
FROE_API size_t froe_scene_kind_count(const froe_scene *scene, froe_kind kind);
/** Bounds of everything: dim doubles each. False (nothing written) when empty.
 * Balls count with their extent rounded outwards. */
FROE_API bool froe_scene_bounds(const froe_scene *scene, double *lo, double *hi);

/** One object, by value. `form` is what it really is: a zero-length segment has
 * the form of a point, a zero-area polygon that of a segment or a point; then
 * `corners` counts the corners of the form. Above dimension 3 segments have the form
 * of hulls: no cut runs along one, and none divides it. */
typedef struct froe_object {
    froe_kind kind, form;
    uint32_t corners;
    uint32_t face, group;
    uint64_t tag;
    double radius; /**< balls; 0 otherwise */
} froe_object;
/** An id out of range gives kind and form FROE_KIND_NONE. */
FROE_API froe_object froe_scene_object(const froe_scene *scene, uint32_t object);
/** Vertex id of a corner (of the form), FROE_NONE if there is none. A polygon's
 * corners may start at another one than given, so that the first three span its plane, and
 * drop a corner equal to the one before; a hull's ascend, each once. */
FROE_API uint32_t froe_scene_corner(const froe_scene *scene, uint32_t object, uint32_t corner);
/** Vertices of an edge of an object, in order. Edges are numbered through all objects by their first corners: edge i
 * of object o has the number of the corners of all objects before o, plus i. False if there is no such edge. */
FROE_API bool froe_scene_edge(const froe_scene *scene, uint32_t edge, uint32_t vertices[2]);
/** dim exact coordinates of a vertex, NULL if there is none; valid as long as the scene does not grow. */
FROE_API const double *froe_scene_vertex(const froe_scene *scene, uint32_t vertex);
/** Strings live as long as the scene does not grow. */
FROE_API froe_group froe_scene_group(const froe_scene *scene, uint32_t group);

/** Checks all of the scene of an opened tree (see froe_tree_open()): FROE_E_FORMAT, FROE_E_MEMORY. O(corners) expected,
 * and O(1) for other scenes. Until then, froe_scene_object() and the like say of a wrong object or group that it does
 * not exist. */
FROE_API froe_status froe_scene_check(const froe_scene *scene, froe_diagnostic *diag);

/** What is odd about a scene: nothing here stops any builder. Pairs are counted
 * once; `first` is one example pair of each sort, FROE_NONE if there is none. */
typedef struct froe_defects {
    size_t size;          /**< to be set to sizeof(froe_defects) before the call */
    uint64_t zero_length; /**< segments that are points */
    uint64_t zero_area;   /**< polygons that are segments or points */
    uint64_t duplicates;  /**< objects equal, as point sets with equal corners, to an earlier one */
    uint64_t crossings;   /**< pairs that meet without overlap where neither has a corner (2D: cross; 3D: pierce,
                             or touch in edges alone) */
    uint64_t t_junctions; /**< pairs where a corner of one lies in the other, neither shared nor crossing */
    uint64_t overlaps;    /**< pairs that share a piece of their own dimension and are not duplicates */
    uint32_t first_crossing[2], first_t_junction[2], first_overlap[2];
} froe_defects;
/** Exact. Pairs are pairs of segments in 2D or of polygons in 3D, without those
 * that are duplicates or have no length or area; other kinds count as duplicates only.
 * O(n log^(dim-1) n + pairs of touching bounding boxes), without pairs that certainly lie side by side (segments of the
 * plane, polygons of one source polygon) where such pairs are many. FROE_E_OPTIONS: out->size not set. */
FROE_API froe_status froe_scene_defects(const froe_scene *scene, unsigned threads, froe_progress_fn *progress,
                                        void *user, froe_defects *out, froe_diagnostic *diag);

/* ----------------------------------------------------------------- methods -- */

/** One option of a method. Values are doubles; choices are listed as text. */
typedef struct froe_option_info {
    const char *name, *summary;
    double standard, lo, hi;    /**< default and allowed range, inclusive */
    const char *const *choices; /**< NULL-ended names of the values 0, 1, ...; NULL: a number */
    bool whole;                 /**< whole numbers only */
} froe_option_info;

/** A builder, as listed by `froe methods`. */
typedef struct froe_method_info {
    const char *name;                 /**< e.g. "density" */
    const char *summary;              /**< one line */
    const char *source;               /**< paper and theorem */
    const char *guarantee;            /**< what its size, height and time obey, or "none" */
    uint32_t kinds[FROE_MAX_DIM + 1]; /**< [d], bit k set: serves froe_kind k in R^d; 0: does not serve R^d */
    uint32_t leaf;                    /**< its own leaf capacity, which it may fit to the scene; 0 stands for 1 */
    uint32_t least_leaf;              /**< the smallest it takes */
    const froe_option_info *options;  /**< ended by a NULL name */
} froe_method_info;
/** The i-th method; NULL past the last. "auto" is not listed. */
FROE_API const froe_method_info *froe_method_at(size_t i);
/** Does a method serve all objects of a scene, in leaves of so many (FROE_LEAF_OWN: its own)? Then froe_build() does
 * not return FROE_E_UNSUPPORTED, unless an option or the coordinates call for it. False for NULL. O(n). */
FROE_API bool froe_method_serves(const froe_method_info *method, const froe_scene *scene, uint32_t leaf);

/** The method that "auto" stands for on a scene, for a purpose: "pieces" (NULL: this one), "query" or "draw".
 * NULL: there is no such purpose. O(n). */
FROE_API const char *froe_method_auto(const froe_scene *scene, const char *purpose);

/* ------------------------------------------------------------------- build -- */

typedef struct froe_build_options {
    size_t size;                /**< set by froe_build_defaults() */
    const char *method;         /**< "auto" (default) or a name listed by froe_method_at() */
    const char *purpose;        /**< what "auto" chooses for: "pieces" (default), "query", "draw" */
    const char *settings;       /**< "name=value name=value": options of the method; NULL or "": defaults */
    uint32_t leaf;              /**< most objects in a leaf, boxes that contain its region not counted; FROE_LEAF_OWN
                                     (default): the method's own, mostly 1; 0: everything ends in cuts (scenes of 2D
                                     segments or of 3D polygons only) */
    uint64_t seed;              /**< of all random choices; default 1 */
    const uint32_t *order;      /**< every object once, the first to cut first, for methods that take one
                                     (cylindrical); NULL: a random one, by the seed */
    size_t order_count;         /**< as many as there are objects; 0 without */
    uint64_t max_fragments;     /**< budget for pieces; 0: none. Beyond it: FROE_E_BUDGET */
    unsigned threads;           /**< 0: one per processor; the tree does not depend on it */
    froe_progress_fn *progress; /**< may be NULL */
    void *user;                 /**< for progress */
} froe_build_options;
FROE_DEFAULTS(froe_build_options, froe_build_defaults);

/** A binary space partition with its scene. Immutable. */
typedef struct froe_tree froe_tree;

/** Builds a tree over all objects of the scene, which it holds (and freezes)
 * until it is freed. Same scene, options and seed: the same tree, bit for bit, on
 * any machine with any number of threads. */
FROE_API froe_status froe_build(froe_scene *scene, const froe_build_options *options, froe_tree **out,
                                froe_diagnostic *diag);
FROE_API void froe_tree_free(froe_tree *tree);

/** The tree of the same scene by the same method, settings, leaf and seed, once more, but with the first cut given:
 * where plane[0] x[0] + ... = plane[dim], for dim + 1 doubles taken exactly; see froe_visibility_options.section. Of
 * the options those of a method are ignored; NULL: defaults. There is no guard stage. FROE_E_ARG: a number is not
 * finite, or the normal 0. FROE_E_UNSUPPORTED: above dimension 3, or by a method that takes no first cut (grain,
 * density and autopartition do). Otherwise as froe_build(). */
FROE_API froe_status froe_tree_section(const froe_tree *tree, const double *plane, const froe_build_options *options,
                                       froe_tree **out, froe_diagnostic *diag);

/** How the exact predicates were decided (counts of calls). */
typedef struct froe_predicate_stats {
    uint64_t calls;      /**< sides asked for */
    uint64_t by_id;      /**< decided by vertex ids or a comparison, without arithmetic */
    uint64_t filtered;   /**< decided by a semi-static double filter */
    uint64_t refined;    /**< decided by doubles with running error */
    uint64_t exact;      /**< decided by exact dyadic numbers */
    uint64_t exact_zero; /**< ... of these, exactly on the plane */
    uint64_t reserved[2];
} froe_predicate_stats;

/** One promise of the method, and what was measured. */
typedef struct froe_promise {
    const char *name;          /**< e.g. "height" */
    double promised, measured; /**< the promise holds when measured <= promised */
} froe_promise;

/** Counts. `size` and `height` as in the papers: nodes + all list entries, and the
 * number of edges on the longest path. */
typedef struct froe_report {
    const char *method;   /**< the method that built it ("auto" resolved) */
    const char *settings; /**< all its options, defaults included, as "name=value ..." */
    int dim;
    uint32_t leaf;
    uint64_t seed;
    uint64_t objects, nodes, leaves;
    uint64_t fragments; /**< pieces in all lists */
    uint64_t in_cut;    /**< ... of these, those that lie in the cut of their node */
    uint64_t covers;    /**< ... and those that contain the region of their node */
    uint64_t size, height;
    double mean_depth;    /**< over pieces */
    uint64_t max_leaf;    /**< pieces in the fullest leaf */
    uint64_t inseparable; /**< leaves over capacity because nothing can separate them */
    uint64_t crowded;     /**< leaves over capacity because more cuts would make too many pieces: of solids that
                             mostly overlap (density, directional), of objects that no cut thins out (index) */
    uint64_t bytes;       /**< the tree without the scene */
    froe_predicate_stats predicates; /**< of the build; zero for an opened tree */
    const froe_promise *promises;    /**< ended by a NULL name */
    uint64_t reserved[8];
} froe_report;
FROE_API froe_report froe_tree_report(const froe_tree *tree);
FROE_API const froe_scene *froe_tree_scene(const froe_tree *tree);

/* -------------------------------------------------------------- structure -- */

/** A node, by value; zero is "none". */
typedef struct froe_node {
    uint32_t id1;
} froe_node;

/** Where a cut comes from. Which fields of froe_cut hold what is said per kind. */
typedef enum froe_cut_kind {
    FROE_CUT_NONE = 0,     /**< a leaf */
    FROE_CUT_AXIS = 1,     /**< x[axis] = value */
    FROE_CUT_OBJECT = 2,   /**< supporting line or plane of object id[0] */
    FROE_CUT_VERTICES = 3, /**< through the vertices id[0..dim-1] */
    FROE_CUT_EDGE = 4,     /**< 3D: the vertical plane through the vertices id[0], id[1] */
    FROE_CUT_PLANE = 5,    /**< normal . x = value, for dim doubles normal */
    FROE_CUT_VERTEX = 6,   /**< wall x[0] = ... through the vertex id[0], see below */
    FROE_CUT_CROSSING = 7, /**< wall through the point where id[1] crosses id[0], from its right to its left:
                                objects in 2D, projected edges in 3D (froe_scene_edge) */
    FROE_CUT_FINE = 8,     /**< finer than doubles: the sum of id[0] planes, the i-th times 2^(-53 i), each dim doubles
                                normal and its value. Of the first, which is the sum rounded, is `value` */
    FROE_CUT_KIND_COUNT = 9
} froe_cut_kind;

/* Walls are lines (2D) and planes (3D) x[0] = c that are sheared by an infinitesimal amount: points are
 * on side 0 or 1 of one by their x and, where that is c, by their y. Only points with the same x and y as the
 * vertex or crossing lie in it. So a wall cuts vertical segments, too, and pieces may have
 * ends with equal coordinates. `value` is c, rounded, for output. */

typedef struct froe_cut {
    froe_cut_kind kind;
    int axis;
    double value;
    uint32_t id[3];
    const double *normal; /**< FROE_CUT_PLANE, FROE_CUT_FINE: dim doubles, or all those, inside the tree */
} froe_cut;

/** A node opened up. Child 0 is the negative side (below the value; right of an
 * oriented line; behind a plane whose corners turn left when seen from the front). */
typedef struct froe_node_info {
    froe_cut cut;
    froe_node child[2];              /**< both none in a leaf */
    size_t first_piece, piece_count; /**< its list: covers, then what meets the leaf's cell, or lies in the cut */
    size_t cover_count;              /**< boxes that contain the region of the node, and are in no list below it */
    bool guard;                      /**< belongs to the guard stage of a density or bar tree */
    bool inseparable;                /**< a leaf over capacity that nothing can separate */
    bool crowded;                    /**< a leaf over capacity that more cuts would not thin out */
} froe_node_info;
FROE_API froe_node froe_tree_root(const froe_tree *tree);
FROE_API froe_node_info froe_tree_node(const froe_tree *tree, froe_node node);

/** A piece: object ∩ closure of the cell (leaf), of the cut within its region, or, a cover, of the region. */
typedef struct froe_piece {
    uint32_t object;
    bool whole;       /**< nothing of the object was cut off, or its form is not cut (boxes, balls, hulls) */
    uint32_t corners; /**< corners of the piece: 1, 2 or those of the polygon */
} froe_piece;
FROE_API size_t froe_tree_piece_count(const froe_tree *tree);
FROE_API froe_piece froe_tree_piece(const froe_tree *tree, size_t piece);
/** Corners of a piece, each coordinate within one unit in the last place of the
 * true one (cuts are kept exactly; only this output is rounded). Writes up to
 * capacity corners of dim doubles; `made[i]`, if given, tells for the edge that
 * leaves corner i the node whose cut made it (none: an edge or end of the object
 * itself). Returns the number of corners there are. */
FROE_API size_t froe_tree_piece_corners(const froe_tree *tree, size_t piece, double *coords, froe_node *made,
                                        size_t capacity);

/** One node's region clipped to a box, for pictures and exports only: computed
 * in doubles. 2D: `corners` points of a convex polygon, face_count 1. 3D: faces
 * as consecutive runs of corners that turn left seen from outside, face_starts has
 * face_count + 1 entries. Arrays live until the visitor returns. */
typedef struct froe_cell {
    froe_node node;
    uint32_t depth;
    bool leaf;
    const double *coords; /**< corner i at coords[i*dim] */
    size_t corners;
    const size_t *face_starts;
    size_t face_count;        /**< faces of the region */
    const double *cut_coords; /**< inner nodes: the part of the cut in the region (2 corners in 2D) */
    size_t cut_corners;       /**< 0: the cut misses the box */
} froe_cell;
typedef bool froe_cell_fn(void *user, const froe_cell *cell);
/** Visits every node whose region meets the box, parents first; false stops, which is no failure. FROE_E_ARG: a bound
 * is not finite, or lo > hi. FROE_E_UNSUPPORTED: above dimension 3. FROE_E_MEMORY. */
FROE_API froe_status froe_tree_cells(const froe_tree *tree, const double *lo, const double *hi, froe_cell_fn *fn,
                                     void *user, froe_diagnostic *diag);

/* ------------------------------------------------------------------- audit -- */

typedef struct froe_audit_options {
    size_t size;      /**< set by froe_audit_defaults() */
    bool exact_only;  /**< bypass every filter */
    unsigned threads; /**< 0: one per processor */
    froe_progress_fn *progress;
    void *user;
} froe_audit_options;
FROE_DEFAULTS(froe_audit_options, froe_audit_defaults);

/** Checks the whole tree exactly: structure and indices; that every object is
 * exactly the union of its pieces and each list holds exactly the pieces that
 * brute force puts there; that in-cut pieces lie in their cuts; leaf capacity; the
 * method's own promises. FROE_E_AUDIT with the first violation in diag. */
FROE_API froe_status froe_tree_audit(const froe_tree *tree, const froe_audit_options *options, froe_diagnostic *diag);

/* -------------------------------------------------------------------- file -- */

/** Writes the tree with its scene (docs/format.md), atomically: `path` holds the
 * old file or the new one, whole, whatever happens. FROE_E_IO. */
FROE_API froe_status froe_tree_save(const froe_tree *tree, const char *path, froe_diagnostic *diag);
/** The same bytes to a function; after a failure, what it has received is the beginning of a file at most. */
FROE_API froe_status froe_tree_write(const froe_tree *tree, froe_write_fn *fn, void *user, froe_diagnostic *diag);
/** How many bytes that are. */
FROE_API uint64_t froe_tree_saved_size(const froe_tree *tree);
/** Does the file begin as a saved tree does? False as well for a file that cannot be read. */
FROE_API bool froe_is_tree(const char *path);
/** Opens a saved tree by mapping the file, which must not be shortened or written to in
 * place while the tree is open (replacing it, as froe_tree_save does, is fine).
 *
 * That costs as much for a large file as for a small one: pages come from the disk when they are first read. Here only
 * the header and the description are checked: FROE_E_FORMAT, FROE_E_IO, FROE_E_MEMORY. Windows, rays, first neighbours
 * and what lies above, asked of a tree that was built to be queried, check the parts that they read, once each. Any
 * other call that reads the tree first checks all of it, as froe_tree_check() does, once; so do forks and threads
 * together. Each of these returns FROE_E_FORMAT for a file that froe_tree_save() could not have written; calls without
 * a status return what they return for an id that does not exist. */
FROE_API froe_status froe_tree_open(const char *path, const froe_allocator *alloc, froe_tree **out,
                                    froe_diagnostic *diag);
/** The same by reading the whole file into memory, so that nothing that happens to the file afterwards matters: for
 * files that other programs may shorten or write to. O(size). */
FROE_API froe_status froe_tree_open_copy(const char *path, const froe_allocator *alloc, froe_tree **out,
                                         froe_diagnostic *diag);
/** The same of the bytes of a file in memory, which are copied: the caller may free them at once. */
FROE_API froe_status froe_tree_open_memory(const void *bytes, size_t count, const froe_allocator *alloc,
                                           froe_tree **out, froe_diagnostic *diag);
/** Checks all of an opened tree now, with its scene and the checksums of the file: FROE_E_FORMAT for any file that
 * froe_tree_save() could not have written; FROE_E_MEMORY. O(size of the file), and O(1) for a tree that was built, or
 * has been found right. That its lists are right is a matter of froe_tree_audit(). */
FROE_API froe_status froe_tree_check(const froe_tree *tree, froe_diagnostic *diag);

#ifdef __cplusplus
}
#endif
#endif
