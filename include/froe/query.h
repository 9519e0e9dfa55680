/* query.h: queries to a tree: ranges, points, rays, neighbours and pairs.
 *
 *     froe_query *q;
 *     froe_query_new(tree, &q, NULL);                     // one a thread; froe_query_fork() for more
 *     froe_range window = froe_range_defaults();
 *     window.points = (double[]){lo_x, lo_y, hi_x, hi_y};
 *     froe_list found;
 *     froe_query_range(q, &window, &found, NULL);         // found.ids[0 .. found.count)
 *     ...
 *     froe_query_free(q);
 *
 * Ranges and objects are closed: touching counts as meeting. Every answer is the exact one for the doubles given,
 * on every tree, from every builder. Each object is reported once, in an order that depends on the tree
 * and the query alone.
 *
 * A query context holds what one thread needs for queries: stacks, marks, numbers. It grows with the
 * first queries and then allocates nothing. What is prepared once for all threads (the structure
 * that locates points in deep trees, the borders of groups, the coordinates of points in the order of
 * the tree) is shared by its forks.
 *
 * Bad queries (NaN, infinity where no bound may be infinite, lo > hi, a negative radius, a
 * direction of length zero) are FROE_E_INPUT and leave the context as it was. */
#ifndef FROE_QUERY_H
#define FROE_QUERY_H
#include <froe/froe.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ----------------------------------------------------------------- context -- */

/** What one thread needs for queries. The tree must outlive it. */
typedef struct froe_query froe_query;

/** A context for a tree, with the tree's allocator. FROE_E_MEMORY. O(1); it grows with the answers, to at
 * most a few bytes per object. */
FROE_API froe_status froe_query_new(const froe_tree *tree, froe_query **out, froe_diagnostic *diag);
/** Another context for the same tree, for another thread; shares what was prepared. */
FROE_API froe_status froe_query_fork(const froe_query *query, froe_query **out, froe_diagnostic *diag);
FROE_API void froe_query_free(froe_query *query);

/** What the queries of a context have cost since it was made, or since the last call of froe_query_statistics(). */
typedef struct froe_query_stats {
    uint64_t queries, nodes, leaves; /**< answered; visited. A search for all pairs is one query */
    uint64_t tests;                  /**< objects tested against a query; by index in space, one by one */
    uint64_t exact;                  /**< decisions by exact numbers; an object or a cut may take several */
    uint64_t slices;                 /**< lists reported without a test */
    uint64_t steps;                  /**< of searches past the cuts of deep trees or among cubes, each like a node */
    uint64_t reserved[5];
} froe_query_stats;
/** Returns the counts and starts again at 0. */
FROE_API froe_query_stats froe_query_statistics(froe_query *query);

/** Objects (or groups) found. The array belongs to the context and is valid until its next call. */
typedef struct froe_list {
    const uint32_t *ids;
    size_t count;
} froe_list;

/* ------------------------------------------------------------------ ranges -- */

/** Shapes of ranges. dim is that of the tree; `points` are dim doubles each. */
typedef enum froe_range_shape {
    FROE_SHAPE_BOX = 0,        /**< points: lo, hi; bounds may be infinite */
    FROE_SHAPE_BALL = 1,       /**< points: centre; radius */
    FROE_SHAPE_SIMPLEX = 2,    /**< points: dim + 1 corners, in any order, degenerate or not */
    FROE_SHAPE_CAPSULE = 3,    /**< points: the two ends of its axis; radius */
    FROE_SHAPE_HALFSPACES = 4, /**< count of them: points[i] . x <= offsets[i]; may be unbounded or empty */
    FROE_SHAPE_HULL = 5,       /**< convex hull of `count` points */
    FROE_SHAPE_SEGMENT = 6,    /**< points: two ends */
    FROE_SHAPE_RAY = 7,        /**< points: origin, direction; dim 2 or 3 */
    FROE_SHAPE_COUNT = 8
} froe_range_shape;
/** "box", "ball", ...; NULL for other numbers. */
FROE_API const char *froe_range_shape_name(froe_range_shape shape);

/** How a range is searched for; answers are the same, but for their order. Box and lca go down below oblique cuts as
 * plain does. What they prepare at the first call, O(nodes log nodes), is shared by all forks. */
typedef enum froe_walk {
    FROE_WALK_AUTO = 0, /**< a packed tree's own way for boxes; otherwise box where the tree is deep, plain where not */
    FROE_WALK_PLAIN = 1, /**< from cut to cut: O(height) for each cell met */
    FROE_WALK_BOX = 2, /**< many cuts at a time, by where the bounds of what is left of the range lie: O(log nodes) for
                            each cell met. 16 bytes for each node and dimension, and 12 */
    FROE_WALK_LCA = 3, /**< the same by its extreme points and their lowest common ancestors (de Berg 2000, Lemma 3.4),
                            for comparison: several times slower than box. 16 bytes more for each node */
    FROE_WALK_CLASSES =
        4, /**< not in the tree: cubes of all sizes, each with a list of those objects of its size and larger ones that
              meet it. Where density is low, O(log n) for a range no larger than the objects near it, whatever other
              sizes there are (de Berg 2000, Corollary 3.2); smaller objects near it are found as in a quadtree.
              Unbounded ranges go down the tree. The cubes take 40 to 100 bytes for each object in the plane */
    FROE_WALK_COUNT = 5
} froe_walk;
/** "auto", "plain", ...; NULL for other numbers. */
FROE_API const char *froe_walk_name(froe_walk walk);

/** A closed convex set, by arrays the caller keeps. */
typedef struct froe_range {
    size_t size; /**< set by froe_range_defaults() */
    froe_range_shape shape;
    const double *points;
    size_t count;          /**< of halfspaces or hull points; ignored otherwise */
    const double *offsets; /**< halfspaces only */
    double radius;         /**< balls and capsules; >= 0 */
    double eps;            /**< >= 0. 0: exact. Otherwise everything that meets Q is reported, and nothing that
                                does not meet Q_eps, the points within eps * diam(Q) of Q (de Berg & Streppel).
                                FROE_E_INPUT for unbounded ranges */
    froe_walk walk;        /**< how to search */
} froe_range;
FROE_DEFAULTS(froe_range, froe_range_defaults); /**< a box without points, exact */

/** All objects that meet the range. */
FROE_API froe_status froe_query_range(froe_query *query, const froe_range *range, froe_list *out,
                                      froe_diagnostic *diag);
/** How many there are. */
FROE_API froe_status froe_query_count(froe_query *query, const froe_range *range, uint64_t *out, froe_diagnostic *diag);
/** One of them, FROE_NONE if there is none: stops at the first found. */
FROE_API froe_status froe_query_any(froe_query *query, const froe_range *range, uint32_t *out, froe_diagnostic *diag);

/* ------------------------------------------------------------------ locate -- */

/** The objects that contain a point of dim doubles. For a point on no cut one leaf: O(log n) for the axis-parallel
 * cuts of deep trees (de Berg, Theorem 3.1), O(height) in shallow ones and below oblique cuts. In the plane the first
 * call lays out the tree for points, in O(nodes); that takes about 12 bytes for each node. */
FROE_API froe_status froe_query_locate(froe_query *query, const double *point, froe_list *out, froe_diagnostic *diag);

/** The groups that a point of the plane lies in, ascending: which countries of a map, say.
 *
 * A group whose segments are closed rings is an area, however many rings it has and however they lie: the points from
 * which a ray crosses its segments an odd number of times, so that a ring within a ring is a hole, and its border.
 * Areas may overlap and share borders; a point on a border lies in all groups whose border it is. Its rings are the
 * segments that share a face with another segment of the group, as those of polygons read from files do, or, if none
 * does, all of its segments. A group without faces whose segments do not close has only the points on them: rivers are
 * no areas. A group also has all points of its objects of other kinds.
 *
 * What is prepared at the first call takes a few bytes for each object, 4 for each node, and 40 for each different
 * border in the list of a leaf, and about as long as building the tree. After that a point costs what
 * froe_query_locate() does, and a few operations for each object of one leaf. FROE_E_UNSUPPORTED: not in the plane; a
 * group has faces that do not close (diag names it). FROE_E_MEMORY.
 */
FROE_API froe_status froe_query_groups(froe_query *query, const double *point, froe_list *out, froe_diagnostic *diag);

/* ---------------------------------------------------------------- relations -- */

/** How a group lies to a range, or to another group. Both are closed sets: a group is the points that
 * froe_query_groups() finds it at, so that its border belongs to it, and rings that overlap count by parity. */
typedef enum froe_relation {
    FROE_MEETS = 0,  /**< the two have a point in common; a touch is enough */
    FROE_WITHIN = 1, /**< every point of the group is one of the range: it may touch the range's border from within */
    FROE_COVERS = 2, /**< every point of the range is one of the group: it may touch the group's border from within */
    FROE_RELATION_COUNT = 3
} froe_relation;
/** "meets", "within", "covers"; NULL for other numbers. */
FROE_API const char *froe_relation_name(froe_relation relation);

/** The groups of the plane that meet a range, lie within it, or cover it, ascending; exactly. A range is taken whole,
 * however thin: a box of equal bounds is a point, a hull of points on one line a segment. Groups without objects have
 * no points, and no relation to anything.
 *
 * Prepares what froe_query_groups() does, and for FROE_WITHIN 4 bytes for each object. After that, FROE_MEETS and
 * FROE_WITHIN cost what froe_query_range() does, and FROE_COVERS also O(log) for each border piece of the covering
 * groups that meets the range.
 *
 * FROE_E_INPUT as froe_query_range(); FROE_E_MEMORY. FROE_E_UNSUPPORTED: as froe_query_groups(); halfspaces; eps above
 * 0; rays, but for FROE_MEETS; for FROE_COVERS balls and capsules of a radius above 0, and ranges that meet a box, a
 * ball or a hull of the group that may cover it (diag names the object); for FROE_WITHIN groups with balls in anything
 * but boxes. */
FROE_API froe_status froe_query_groups_range(froe_query *query, const froe_range *range, froe_relation relation,
                                             froe_list *out, froe_diagnostic *diag);

/* --------------------------------------------------------------------- ray -- */

/** Where a ray meets an object first: at origin + t * direction. */
typedef struct froe_hit {
    uint32_t object;
    double t; /**< the double nearest to the exact parameter */
} froe_hit;
/** Hits, owned by the context as froe_list is. */
typedef struct froe_hits {
    const froe_hit *hits;
    size_t count;
} froe_hits;

/** The first object met for 0 <= t <= t_max (which may be infinite), decided exactly; of several met
 * at the same point, that with the lowest id. hit->object FROE_NONE if there is none. */
FROE_API froe_status froe_query_ray(froe_query *query, const double *origin, const double *direction, double t_max,
                                    froe_hit *hit, froe_diagnostic *diag);
/** All objects met, by t, then id. */
FROE_API froe_status froe_query_ray_all(froe_query *query, const double *origin, const double *direction, double t_max,
                                        froe_hits *out, froe_diagnostic *diag);
/** Any object met, FROE_NONE if there is none. */
FROE_API froe_status froe_query_ray_any(froe_query *query, const double *origin, const double *direction, double t_max,
                                        uint32_t *object, froe_diagnostic *diag);
/** The first segment of the plane that the vertical ray from the point meets, upwards
 * (direction 1) or downwards (-1); FROE_NONE if there is none. A segment through the point comes first; of
 * several met at the same point, that with the lowest id. Objects of other kinds are passed over.
 * FROE_E_UNSUPPORTED: not in the plane. */
FROE_API froe_status froe_query_vertical(froe_query *query, const double *point, int direction, uint32_t *object,
                                         froe_diagnostic *diag);

/* -------------------------------------------------------------------- near -- */

/** An object and its Euclidean distance, the double nearest to the exact one. */
typedef struct froe_neighbour {
    uint32_t object;
    double distance;
} froe_neighbour;
typedef struct froe_neighbours {
    const froe_neighbour *items;
    size_t count;
} froe_neighbours;
/** The k objects nearest to a point among those within `bound` (may be infinite), nearest first;
 * equal distances, decided exactly, by id. */
FROE_API froe_status froe_query_near(froe_query *query, const double *point, size_t k, double bound,
                                     froe_neighbours *out, froe_diagnostic *diag);

/* ------------------------------------------------------------------- where -- */

/** The point of an object that is nearest to a point: dim doubles, each the one nearest to the exact coordinate, ties
 * to even. If the point lies in the object, it is the point itself. Objects are convex, so that there is one such point
 * alone. FROE_E_ARG: there is no such object. FROE_E_INPUT: a coordinate is not finite. A few microseconds up to
 * dimension 3. */
FROE_API froe_status froe_query_nearest_point(froe_query *query, uint32_t object, const double *point, double *nearest,
                                              froe_diagnostic *diag);

/** What lies where a ray meets an object first. Every number is the double nearest to the exact one, ties to even.
 * Coordinates from dim on are 0. */
typedef struct froe_hit_place {
    double point[FROE_MAX_DIM];  /**< origin + t * direction, of the exact t */
    double normal[FROE_MAX_DIM]; /**< of length 1, or all 0 where there is none */
    double distance;             /**< of the point from the origin */
} froe_hit_place;
/** Where a ray meets an object first, as froe_query_ray() finds it. Normals are the object's own, whichever way the ray
 * goes: of a polygon the one that sees its corners turn left; of a segment of the plane the one to its left; of a
 * box, a ball or a hull the outward one of the face that is entered, of several faces one of them. There is none where
 * the ray begins in a box, a ball or a hull; of points, of segments in space, of hulls that the ray meets in an edge or
 * a corner of their shadow, and of segments and hulls above dimension 3. FROE_E_ARG: there is no such object.
 * FROE_E_INPUT: a coordinate is not finite, the direction is 0, or the ray does not meet the object. A few
 * microseconds up to dimension 3. */
FROE_API froe_status froe_query_hit_place(froe_query *query, uint32_t object, const double *origin,
                                          const double *direction, froe_hit_place *out, froe_diagnostic *diag);

/* ------------------------------------------------------------------- pairs -- */

/** How two objects meet. */
typedef enum froe_meeting {
    FROE_MEET_CROSS = 0,  /**< interiors (relative to each object's own dimension) meet in a set of lower dimension */
    FROE_MEET_TOUCH = 1,  /**< they meet, but not their relative interiors */
    FROE_MEET_OVERLAP = 2 /**< relative interiors meet in a piece of the dimension of the lower one */
} froe_meeting;
typedef struct froe_pair {
    uint32_t a, b; /**< a < b */
    froe_meeting kind;
} froe_pair;
typedef bool froe_pair_fn(void *user, const froe_pair *pair);
/** All pairs of objects that meet, each once, by a, then b. `shared` false leaves out pairs that touch in nothing but
 * one corner of both. A visitor that returns false ends the call with FROE_OK; it must not use the context. */
FROE_API froe_status froe_query_pairs(froe_query *query, bool shared, froe_pair_fn *fn, void *user,
                                      froe_diagnostic *diag);

/* ------------------------------------------------------------------- batch -- */

/** Answers of a batch: those of query i are ids[starts[i] .. starts[i+1]) (and values beside them:
 * parameters or distances). Freed by froe_answers_free(). */
typedef struct froe_answers {
    size_t *starts; /**< one more than queries */
    uint32_t *ids;
    double *values; /**< NULL where there are none */
    size_t queries;
    froe_allocator alloc; /**< that the arrays came from */
} froe_answers;
FROE_API void froe_answers_free(froe_answers *answers);

typedef struct froe_batch_options {
    size_t size;                /**< set by froe_batch_defaults() */
    unsigned threads;           /**< 0: one per processor; answers do not depend on it */
    froe_progress_fn *progress; /**< may be NULL */
    void *user;
} froe_batch_options;
FROE_DEFAULTS(froe_batch_options, froe_batch_defaults);

/** The same questions over arrays, on several threads. options NULL: the defaults. The first bad query ends the
 * call: diag->object is its position. The tree's allocator must be callable from several threads at once
 * when there are several. */
FROE_API froe_status froe_batch_range(froe_query *query, const froe_range *ranges, size_t count,
                                      const froe_batch_options *options, froe_answers *out, froe_diagnostic *diag);
/** Of exact boxes alone: 2 dim doubles each, lower corner, then upper. */
FROE_API froe_status froe_batch_boxes(froe_query *query, const double *boxes, size_t count,
                                      const froe_batch_options *options, froe_answers *out, froe_diagnostic *diag);
/** How many objects meet each range, and one of them, or FROE_NONE. counts, objects: `count` of them, the caller's; on
 * failure they may hold anything. */
FROE_API froe_status froe_batch_count(froe_query *query, const froe_range *ranges, size_t count,
                                      const froe_batch_options *options, uint64_t *counts, froe_diagnostic *diag);
FROE_API froe_status froe_batch_any(froe_query *query, const froe_range *ranges, size_t count,
                                    const froe_batch_options *options, uint32_t *objects, froe_diagnostic *diag);
/** points: dim doubles each. */
FROE_API froe_status froe_batch_locate(froe_query *query, const double *points, size_t count,
                                       const froe_batch_options *options, froe_answers *out, froe_diagnostic *diag);
/** points: 2 doubles each. The ids of the answers are those of groups. */
FROE_API froe_status froe_batch_groups(froe_query *query, const double *points, size_t count,
                                       const froe_batch_options *options, froe_answers *out, froe_diagnostic *diag);
/** The ids of the answers are those of groups, ascending for each range. */
FROE_API froe_status froe_batch_groups_range(froe_query *query, const froe_range *ranges, size_t count,
                                             froe_relation relation, const froe_batch_options *options,
                                             froe_answers *out, froe_diagnostic *diag);
/** ... of boxes alone: 4 doubles each, as for froe_batch_boxes(). */
FROE_API froe_status froe_batch_groups_boxes(froe_query *query, const double *boxes, size_t count,
                                             froe_relation relation, const froe_batch_options *options,
                                             froe_answers *out, froe_diagnostic *diag);
/** The same with groups as questions: polygons with holes, paths, sets of points. Answers i are the groups of `query`
 * that meet group i of `questions`, lie within it, or cover it. `questions` is a context of a tree of the plane, of any
 * builder; it may be of the same tree, or `query` itself. A question without objects has no answers.
 *
 * FROE_MEETS costs a range query for each object of a question, and locates points of what its bounds hold.
 * FROE_WITHIN and FROE_COVERS follow the borders of both groups and cost a few microseconds for each piece near them.
 * FROE_E_UNSUPPORTED: as froe_query_groups_range(), of either tree; for FROE_WITHIN and FROE_COVERS boxes, balls and
 * hulls on either side (diag->object is the question). */
FROE_API froe_status froe_batch_groups_join(froe_query *query, const froe_query *questions, froe_relation relation,
                                            const froe_batch_options *options, froe_answers *out,
                                            froe_diagnostic *diag);
/** objects: count of them, the caller's; on failure they may hold anything. */
FROE_API froe_status froe_batch_vertical(froe_query *query, const double *points, size_t count, int direction,
                                         const froe_batch_options *options, uint32_t *objects, froe_diagnostic *diag);
/** First hits. hits: count of them, the caller's; on failure they may hold anything. */
FROE_API froe_status froe_batch_ray(froe_query *query, const double *origins, const double *directions, size_t count,
                                    double t_max, const froe_batch_options *options, froe_hit *hits,
                                    froe_diagnostic *diag);
/** Any object met by each ray; objects: count of them, as for froe_batch_vertical(). */
FROE_API froe_status froe_batch_ray_any(froe_query *query, const double *origins, const double *directions,
                                        size_t count, double t_max, const froe_batch_options *options,
                                        uint32_t *objects, froe_diagnostic *diag);
/** All objects met, with parameters as values. */
FROE_API froe_status froe_batch_ray_all(froe_query *query, const double *origins, const double *directions,
                                        size_t count, double t_max, const froe_batch_options *options,
                                        froe_answers *out, froe_diagnostic *diag);
/** With distances as values. */
FROE_API froe_status froe_batch_near(froe_query *query, const double *points, size_t count, size_t k, double bound,
                                     const froe_batch_options *options, froe_answers *out, froe_diagnostic *diag);
/** froe_query_pairs() on several threads: the same pairs in the same order, visited on the calling thread. On packed
 * trees of the plane (method index) pairs are found leaf by leaf, which is much faster, and visited once all are found,
 * which takes up to 24 bytes for each; where they are more than 16 for each object, object by object as on other trees.
 * FROE_E_CANCELLED. */
FROE_API froe_status froe_batch_pairs(froe_query *query, bool shared, const froe_batch_options *options,
                                      froe_pair_fn *fn, void *fn_user, froe_diagnostic *diag);
/** All pairs of objects that meet, by a, then b. */
typedef struct froe_pairs {
    froe_pair *pairs;
    size_t count;
    froe_allocator alloc; /**< that the array came from */
} froe_pairs;
/** The same as an array of all pairs. */
FROE_API froe_status froe_batch_pair_array(froe_query *query, bool shared, const froe_batch_options *options,
                                           froe_pairs *out, froe_diagnostic *diag);
FROE_API void froe_pairs_free(froe_pairs *pairs);

#ifdef __cplusplus
}
#endif
#endif
