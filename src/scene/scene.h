/* scene.h: the scene from inside: a vertex table and, per object, a run of corners.
 *
 *     kind_of, form_of   [object]        what it was added as; what it really is
 *     start_of           [object]    ->  vertex_of[start_of[o] .. start_of[o + 1])  ->  vertex ids
 *     coords             [vertex * dim]  exact, pairwise different, no -0
 *
 * Each of the first four is NULL where it would say nothing: all objects have one kind, or one form, or equally many
 * corners; or corner i is vertex i. All readers ask by the functions below. A million segments without common ends
 * need no array but coords, which then has the two ends of object o at 2 o and 2 o + 1 (scene_in_order()).
 *
 * A ball's corners are {centre vertex, index into radii}. A polygon's ring is stored
 * so that its first three corners are not collinear: they span its plane. Ring
 * orientation is the caller's. Objects with form != kind store the corners of their
 * form: the two extreme vertices of a zero-area polygon, one for a zero-length segment. Above dimension 3 segments are
 * hulls of two corners.
 * Polygons keep no two equal corners in a row. A hull's corners ascend, each once.
 * Optional arrays are NULL when every object has the default. All arrays lie either in
 * memory of `alloc` or inside a mapped tree file (then `mapped`). */
#ifndef FROE_SCENE_SCENE_H
#define FROE_SCENE_SCENE_H
#include "geom/body.h"
#include "geom/plane.h"
#include "support/array.h"
#include <stdatomic.h>

typedef struct scene_group {
    uint32_t name, material, left, right; /**< offsets into text */
    uint32_t colour;                      /**< see froe_group */
} scene_group;

/** Of arrays that come from a file: what scene_settle() has found. */
typedef enum scene_trust { SCENE_RIGHT = 0, SCENE_UNCHECKED, SCENE_WRONG } scene_trust;

struct froe_scene {
    froe_allocator alloc;
    atomic_uint holds; /**< the caller's and each tree's; > 1: frozen */
    atomic_int trust;  /**< scene_trust */
    bool mapped;
    void *map; /**< the file they lie in, which goes with the scene; trees that hold it may lie there, too */
    size_t map_size;
    bool copied; /**< the file lies in memory of alloc; otherwise it is mapped */
    int dim;
    int up; /**< the axis that points up; -1: not in space */
    uint32_t vertex_count, object_count, group_count, radius_count, corner_count;
    size_t text_size;
    double *coords;
    uint8_t *kind_of, *form_of; /**< NULL: `kind`, `form` of all objects */
    uint32_t *start_of;         /**< object_count + 1; NULL: every object has `each` corners */
    uint32_t *vertex_of;        /**< of each corner; NULL: its own number */
    froe_kind kind, form;
    uint32_t each;
    double *radii;
    uint64_t *tags;   /**< NULL: tag = id */
    uint32_t *faces;  /**< NULL: face = id */
    uint32_t *groups; /**< NULL: none */
    scene_group *group_table;
    char *text; /**< NUL-terminated strings; text[0] = 0 */
    froe_crs_kind crs_kind;
    uint32_t crs_size; /**< bytes of the strings of the coordinate system, each ended by a NUL; 0: unknown */
    char *crs;         /**< wkt, name, code, unit */
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    struct scene_store *store; /**< hash table and capacities while the scene grows; NULL when mapped */
};

static inline const double *scene_vertex(const froe_scene *s, uint32_t vertex) {
    return s->coords + (size_t)vertex * (size_t)s->dim;
}
static inline froe_kind scene_kind(const froe_scene *s, uint32_t object) {
    return s->kind_of ? (froe_kind)s->kind_of[object] : s->kind;
}
static inline froe_kind scene_form(const froe_scene *s, uint32_t object) {
    return s->form_of ? (froe_kind)s->form_of[object] : s->form;
}
/** Its first corner among those of all objects; object_count: their number. */
static inline uint32_t scene_start(const froe_scene *s, uint32_t object) {
    return s->start_of ? s->start_of[object] : object * s->each;
}
static inline uint32_t scene_corners(const froe_scene *s, uint32_t object) { /* of the form; balls: 2 */
    return s->start_of ? s->start_of[object + 1] - s->start_of[object] : s->each;
}
/** The vertex of a corner by its number among those of all objects. */
static inline uint32_t scene_corner_vertex(const froe_scene *s, uint32_t corner) {
    return s->vertex_of ? s->vertex_of[corner] : corner;
}
static inline uint32_t scene_corner(const froe_scene *s, uint32_t object, uint32_t i) {
    return scene_corner_vertex(s, scene_start(s, object) + i);
}
static inline const double *scene_point(const froe_scene *s, uint32_t object, uint32_t i) {
    return scene_vertex(s, scene_corner(s, object, i));
}
/** Has every object s->each corners, which are vertices of its own, in order? Then those of object o are the vertices
 * o * each .., side by side in coords. */
static inline bool scene_in_order(const froe_scene *s) {
    return !s->start_of && !s->vertex_of;
}
static inline double scene_radius(const froe_scene *s, uint32_t object) { /* balls */
    return s->radii[scene_corner(s, object, 1)];
}
/** An object for geometry. */
static inline geom_body scene_body(const froe_scene *s, uint32_t object) {
    const uint32_t first = scene_start(s, object);
    geom_body b = {.form = scene_form(s, object), .dim = s->dim, .count = scene_corners(s, object)};
    b.coords = s->vertex_of ? s->coords : scene_vertex(s, first);
    b.corners = s->vertex_of ? s->vertex_of + first : NULL;
    if (b.form != FROE_BALL) return b;
    b.count = 1;
    b.radius = scene_radius(s, object);
    if (b.radius == 0) b.form = FROE_POINT;
    return b;
}

/** Prefetches where its corners begin; the vertex of a corner. */
static inline void scene_ask_start(const froe_scene *s, uint32_t object) {
    if (s->start_of) __builtin_prefetch(s->start_of + object);
}
static inline void scene_ask_corner(const froe_scene *s, uint32_t corner) {
    if (s->vertex_of) __builtin_prefetch(s->vertex_of + corner);
}
/** Prefetches what scene_body() reads, and, where all objects are triangles, the ids of its corners. */
static inline void scene_ask(const froe_scene *s, uint32_t object) {
    const uint64_t guess = s->start_of ? 3 * (uint64_t)object : scene_start(s, object);
    if (s->form_of) __builtin_prefetch(s->form_of + object);
    scene_ask_start(s, object);
    scene_ask_corner(s, guess < s->corner_count ? (uint32_t)guess : 0);
}
/** Prefetches its points, up to three, once that is in the cache. */
static inline void scene_ask_points(const froe_scene *s, uint32_t object) {
    const uint32_t corners = scene_corners(s, object);
    for (uint32_t i = 0; i < corners && i < 3; i++) {
        const double *x = scene_point(s, object, i);
        __builtin_prefetch(x);
        __builtin_prefetch(x + s->dim - 1); /* the next line, perhaps */
    }
}

/** The object whose corner number `corner` of all corners is. O(log objects), O(1) on triangles. */
uint32_t scene_object_of(const froe_scene *s, uint32_t corner);

/** The ends of a line that a FROE_CUT_CROSSING names: a segment in the plane, an edge in space. */
void scene_crossing_line(const froe_scene *s, uint32_t id, const double *ends[2]);

void scene_hold(froe_scene *scene); /**< one more owner; froe_scene_free() gives it up */

/** Bounding box of one object, dim doubles each; exact, for balls rounded outwards. */
void scene_object_bounds(const froe_scene *s, uint32_t object, double *lo, double *hi);
/** Of any ball; infinite where it leaves the range of doubles (a scene holds no such ball). */
void scene_ball_bounds(int dim, const double *centre, double radius, double *lo, double *hi);

/** The same, for loops over many objects that know the dimension. */
static inline void scene_bounds_in(const froe_scene *s, int dim, uint32_t object, double *lo, double *hi) {
    const double *x = scene_point(s, object, 0);
    if (scene_form(s, object) == FROE_BALL) {
        scene_ball_bounds(dim, x, scene_radius(s, object), lo, hi);
        return;
    }
    for (int k = 0; k < dim; k++) lo[k] = hi[k] = x[k];
    for (uint32_t i = 1, n = scene_corners(s, object); i < n; i++) {
        x = scene_point(s, object, i);
        for (int k = 0; k < dim; k++) {
            lo[k] = x[k] < lo[k] ? x[k] : lo[k]; /* which end is the lower one is unpredictable, so branch-free */
            hi[k] = x[k] > hi[k] ? x[k] : hi[k];
        }
    }
}

/** The hyperplane an object lies in (its cut, FROE_CUT_OBJECT): 2D segments,
 * polygons. Other forms get a plane that contains them and needs no new numbers:
 * points x[0] = value; segments in 3D the plane x[k] = value if one holds it, else the
 * vertical plane. Returns the cut that names the plane; kind NONE for boxes, balls, hulls. */
froe_cut scene_support(const froe_scene *s, uint32_t object, geom_plane *plane);
/** The same without the plane. */
froe_cut scene_support_cut(const froe_scene *s, uint32_t object);

/** The hyperplane of any cut. */
geom_plane scene_cut_plane(const froe_scene *s, const froe_cut *cut);

/** Equal as point sets with equal corners (same form, same vertex set, same radius). */
bool scene_equal(const froe_scene *s, uint32_t a, uint32_t b);
/** For each object the lowest id equal to it (out[o] <= o). O(corners) expected. */
froe_status scene_originals(const froe_scene *s, const froe_allocator *alloc, uint32_t *out);

/** The same scene in *out with all arrays, as files hold them; those that it lacks are made. Only for reading, while
 * the scene is there. FROE_E_MEMORY. O(corners). */
froe_status scene_explicit(const froe_scene *s, const froe_allocator *alloc, froe_scene *out);
void scene_explicit_free(const froe_scene *s, const froe_allocator *alloc, froe_scene *out);

/** Are these the strings of a coordinate system of this kind, as scenes keep them? */
bool scene_crs_fits(uint32_t kind, const char *strings, size_t size);

/** Everything above said about the arrays, checked on unvalidated arrays: every
 * index, ring, form and coordinate, and that no two vertices are equal. Bounds are not looked at.
 * FROE_E_FORMAT with the first violation. O(corners) expected. */
froe_status scene_validate(const froe_scene *s, const froe_allocator *alloc, froe_diagnostic *diag);
/** A scene over arrays that lie in a file mapping: `arrays` gives dim, counts, arrays, none of objects or corners
 * missing, and bounds; all else is ignored. Only what has no size is validated, and the scene is unchecked. The
 * mapping stays the caller's, must outlive the scene and is not written to; froe_scene_free() frees the rest. The
 * scene has one hold and never grows. FROE_E_FORMAT, FROE_E_MEMORY. O(1). */
froe_status scene_mapped(const froe_scene *arrays, const froe_allocator *alloc, froe_scene **out,
                         froe_diagnostic *diag);
/** Is there nothing left to be checked? Until then the arrays are untrusted: readers ask scene_object_fits() first. */
static inline bool scene_is_checked(const froe_scene *s) {
    return atomic_load_explicit(&s->trust, memory_order_relaxed) == SCENE_RIGHT;
}
/** Checks an unchecked scene whole, by scene_validate(), and its bounds. O(1) once that has been done, unless it is
 * wrong and the sentence is wanted. FROE_E_FORMAT, FROE_E_MEMORY. */
static inline froe_status scene_settle(const froe_scene *s, froe_diagnostic *diag) {
    return scene_is_checked(s) ? FROE_OK : froe_scene_check(s, diag);
}
/** May the corners, the radius and the group of an object, whose id is good, be looked up? O(corners of the object). */
bool scene_object_fits(const froe_scene *s, uint32_t object);
/** May the strings of a group be looked up? */
bool scene_group_fits(const froe_scene *s, const scene_group *group);
/** Is the object one that geometry may be done with? All that scene_validate() checks of an object, and its
 * coordinates. FROE_E_FORMAT. */
froe_status scene_check_object(const froe_scene *s, uint32_t object, num_context *context, froe_diagnostic *diag);
#endif
