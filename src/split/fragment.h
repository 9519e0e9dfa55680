/* fragment.h: fragments: on which side of a cut each lies, and where a segment or polygon is cut in two.
 *
 * A fragment is an object and, once something was cut off, a ring of corners, each
 * known by where it comes from (Bernstein and Fussell 2009) and with a double image for
 * filters and scores. No coordinate is ever rounded to decide.
 *
 *      0--------1          cut of node 9        0-----X          ring:  0  edge own 0
 *      |        |     ------------------->      |     |                 X  edge CUT 9
 *      3--------2                               3-----Y                 Y  edge own 2
 *                                                                       3  edge own 3
 *
 * X is CROSSING(vertices 0 and 1, node 9); where two cuts meet in a polygon is a CORNER.
 * A segment's ring is its two ends; the `edge` of an end says what ends it there.
 * Boxes, balls and hulls are never cut: they go to both sides as a whole. */
#ifndef FROE_SPLIT_FRAGMENT_H
#define FROE_SPLIT_FRAGMENT_H
#include "geom/predicates.h"
#include "tree/draft.h"

typedef enum split_type { SPLIT_VERTEX, SPLIT_CROSSING, SPLIT_CORNER } split_type;

typedef struct split_corner {
    double x[3], error; /**< image: every coordinate within error of the true one; 0: exact */
    double apart[3];    /**< of corners that cuts made: from the first vertex of the object, for scores; the same
                             wherever the scene lies */
    uint32_t edge;      /**< ring entry of the edge leaving this corner (segments: of this end) */
    uint32_t type;      /**< split_type */
    uint32_t a, b, c;   /**< VERTEX: vertex a | CROSSING: vertices a, b with the cut of node c | CORNER: nodes a, b */
} split_corner;

typedef struct split_fragment {
    uint32_t object;
    uint32_t first, count; /**< its corners; count 0: the whole object */
} split_fragment;

/** Classes of a fragment beside a cut. */
enum { SPLIT_NEG, SPLIT_POS, SPLIT_ON, SPLIT_BOTH };

/** A cut with its plane, and the input vertices known to lie in it. */
#define SPLIT_KNOWN 8
typedef struct split_plane {
    froe_cut cut;
    geom_plane plane;
    uint32_t known_count;
    const double *known[SPLIT_KNOWN];
} split_plane;

/** What a thread works with: fragments on a stack, their corners on another, the
 * draft it fills, and the draft around that (NULL in the main one). */
typedef struct split_set {
    const froe_scene *scene;
    froe_allocator alloc;
    num_context context;
    const tree_draft *main; /**< nodes below draft->outer are its nodes */
    tree_draft *draft;
    ARRAY(split_fragment) items;
    ARRAY(split_corner) corners;
    ARRAY(int8_t) sides;    /**< of the corners of the current cell's divided fragments, in order */
    ARRAY(uint8_t) classes; /**< of the fragments of the current cell */
    ARRAY(split_fragment) spare;
    ARRAY(uint32_t) ring;
    bool boxes; /**< does the scene have boxes, which may become covers? Cells then know their bounds */
} split_set;

froe_status split_set_new(const froe_scene *scene, const froe_allocator *alloc, split_set *out);
void split_set_free(split_set *set);

/** Makes a cut ready for use: its plane and known vertices. */
split_plane split_plane_of(const froe_scene *scene, const froe_cut *cut);
/** A node's cut, and its plane, by ring numbering. */
froe_cut split_cut_at(const split_set *set, uint32_t node);
geom_plane split_plane_at(const split_set *set, uint32_t node);

/** Is the kind cut into fragments? */
static inline bool split_is_cut(froe_kind form) {
    return form <= FROE_POLYGON;
}

/** Exact class of a fragment; when that is SPLIT_BOTH and the kind is cut, appends the
 * sides of its corners to set->sides, where the caller has made room. */
int split_classify(split_set *set, const split_plane *plane, const split_fragment *fragment);
/** The class alone, for less; the caller has made the same room. */
int split_class(split_set *set, const split_plane *plane, const split_fragment *fragment);
/** The i-th corner, made on the fly for whole objects. */
split_corner split_corner_of(const split_set *set, const split_fragment *fragment, uint32_t i);
/** Exact side of a vertex. */
int split_vertex_side(split_set *set, const split_plane *plane, const double *x);
/** Side of a corner that is no vertex, by its image; NUM_UNSURE where it is too near. */
int split_image_side(split_set *set, const split_plane *plane, const split_corner *corner);
/** Exact side of a corner of a fragment of `object`. */
int split_corner_side(split_set *set, const split_plane *plane, uint32_t object, const split_corner *corner);
/** Cuts a fragment of class SPLIT_BOTH in two by the cut of `node`; sides as split_classify gave them. */
froe_status split_divide(split_set *set, const split_plane *plane, uint32_t node, const split_fragment *fragment,
                         const int8_t *sides, split_fragment *negative, split_fragment *positive);
/** Number of corners, whole or not. */
static inline uint32_t split_corner_count(const split_set *set, const split_fragment *f) {
    return f->count ? f->count : scene_corners(set->scene, f->object);
}
/** Image of the i-th corner, scene->dim doubles. */
static inline const double *split_image(const split_set *set, const split_fragment *f, uint32_t i) {
    return f->count ? set->corners.data[f->first + i].x : scene_point(set->scene, f->object, i);
}
/** Hands a fragment to the list begun last in the draft, that of `node` (ring numbering). */
froe_status split_emit(split_set *set, uint32_t node, const split_fragment *fragment);
#endif
