/* shards.h: folders of trees, for more objects than one tree takes.
 *
 *     froe_shards *shards;  froe_finds found;
 *     froe_shards_open("planet.froes", NULL, &shards, NULL);
 *     froe_shards_boxes(shards, windows, count, NULL, &found, NULL);     // 2 dim doubles each
 *     ... window i meets the objects found.items[found.starts[i] .. found.starts[i + 1]), by their tags ...
 *     froe_finds_free(&found);
 *     froe_shards_close(shards);
 *
 * Space is cut into cells, and each has a tree, its shard, of all objects whose boxes meet the cell. Answers are those
 * of a single tree of all objects, decided as exactly, where each object is called by its tag. Where a single tree goes
 * by ids (the order of answers, and which of several objects that are met at the same point comes first), a folder goes
 * by tags; objects of the same tag stand for each other. Objects without tags have their numbers in the input as tags.
 *
 * A handle is used by one thread at a time; calls use several inside. Opening reads a text of a line for each shard.
 * A shard is opened, as froe_tree_open() does it, when something is first asked of it. Every question can therefore
 * return FROE_E_IO or FROE_E_FORMAT, of a shard that is missing, of another folder or another time, or damaged; the
 * message names it. FROE_E_MEMORY, FROE_E_CANCELLED, FROE_E_ARG, FROE_E_OPTIONS and FROE_E_INPUT as in froe/query.h. */
#ifndef FROE_SHARDS_H
#define FROE_SHARDS_H
#include <froe/query.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { FROE_SHARDS_MOST = 4096 }; /**< shards of a folder */

/* ------------------------------------------------------------------- build -- */

typedef struct froe_shards_options {
    size_t size;                 /**< set by froe_shards_defaults() */
    uint32_t shards;             /**< how many; fewer where the objects have not so many different places. 0 (default):
                                      as many as `memory` calls for */
    uint64_t memory;             /**< bytes that building may take, about; default 4 GiB */
    const char *method;          /**< of the trees; "auto" (default): the one that serves queries best */
    const char *settings;        /**< as froe_build_options.settings */
    uint32_t leaf;               /**< as froe_build_options.leaf */
    uint64_t seed;               /**< of random choices of the method; default 1 */
    unsigned threads;            /**< 0: one per processor; the folder does not depend on it */
    froe_progress_fn *progress;  /**< may be NULL; of froe_shards_finish() */
    void *user;                  /**< for progress */
    const froe_allocator *alloc; /**< NULL: malloc */
} froe_shards_options;
FROE_DEFAULTS(froe_shards_options, froe_shards_defaults);

/** What was built. */
typedef struct froe_shards_report {
    uint32_t shards;
    uint64_t objects, copies; /**< objects; objects in all shards together */
    uint64_t most;            /**< objects of the largest shard */
    uint64_t bytes;           /**< of all files but the manifest */
    uint64_t reserved[4];     /**< 0 */
} froe_shards_report;

/** A folder that is being built. */
typedef struct froe_shards_builder froe_shards_builder;
/** Begins the folder `path`. What is there stays until froe_shards_finish() has done. It may be a folder of shards, or
 * an empty one. Nothing but the options' strings must last. FROE_E_IO: something else is there, another program builds
 * it, or it cannot be written. FROE_E_OPTIONS: as froe_build(), as far as that can be told without objects. FROE_E_ARG,
 * FROE_E_MEMORY. */
FROE_API froe_status froe_shards_begin(const char *path, int dim, const froe_shards_options *options,
                                       froe_shards_builder **out, froe_diagnostic *diag);
/** Adds a batch of objects as froe_scene_add() does, to a file without name in the folder of `path`. Without tags
 * objects are numbered on. Memory does not grow with the objects. Groups are refused: FROE_E_UNSUPPORTED; see
 * froe_shards_add_scene(). FROE_E_INPUT and others as froe_scene_add(); FROE_E_ARG: the folder is made of a scene;
 * FROE_E_IO: the disk is full, as one of the causes. Where part of a batch may have been kept, as then, all later calls
 * fail alike. */
FROE_API froe_status froe_shards_add(froe_shards_builder *builder, const froe_objects *batch, froe_diagnostic *diag);
/** Adds all objects of a scene with their groups and tags. The scene is then all that the folder is made of, and must
 * last until froe_shards_finish(). Groups keep their numbers. So that each shard can answer for areas, the objects of a
 * group go to all cells that the box of the group meets: a large area takes a copy in each. FROE_E_ARG: another
 * dimension, or there are objects already. FROE_E_IO, FROE_E_MEMORY, FROE_E_FORMAT of an opened scene. */
FROE_API froe_status froe_shards_add_scene(froe_shards_builder *builder, const froe_scene *scene,
                                           froe_diagnostic *diag);
/** Builds all shards, puts the folder into its place, and frees the builder, whatever comes out. On failure `path` is
 * as it was. report may be NULL. FROE_E_INPUT: there are no objects, or one is none (its tag is named). FROE_E_IO,
 * FROE_E_LIMIT, FROE_E_UNSUPPORTED, FROE_E_CANCELLED and others as froe_build() and froe_tree_save(). */
FROE_API froe_status froe_shards_finish(froe_shards_builder *builder, froe_shards_report *report,
                                        froe_diagnostic *diag);
/** Frees a builder that is not to be finished. `path` is as it was. */
FROE_API void froe_shards_abandon(froe_shards_builder *builder);

/* -------------------------------------------------------------------- open -- */

/** A folder that is open. */
typedef struct froe_shards froe_shards;
/** Is the path a folder with a file froe.shards, or shard-0000.froe? */
FROE_API bool froe_is_shards(const char *path);
/** Opens a folder: reads its manifest and nothing else. The folder must stay as it is as long as it is open; replacing
 * it, as froe_shards_finish() does, is noticed when a shard is opened that is not from then. FROE_E_IO: there is none.
 * FROE_E_FORMAT: it is damaged, cut off or of another version. FROE_E_MEMORY. */
FROE_API froe_status froe_shards_open(const char *path, const froe_allocator *alloc, froe_shards **out,
                                      froe_diagnostic *diag);
FROE_API void froe_shards_close(froe_shards *shards);

/** What the manifest says. */
typedef struct froe_shards_info {
    int dim;
    uint32_t shards;
    uint64_t objects, copies;                  /**< objects; objects in all shards together */
    uint64_t bytes;                            /**< of all shards */
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM]; /**< bounds of everything; balls are rounded outwards */
    uint64_t check;                            /**< a checksum of the manifest, which other folders have not */
    uint64_t reserved[3];                      /**< 0 */
} froe_shards_info;
FROE_API froe_shards_info froe_shards_about(const froe_shards *shards);
/** The tree of a shard, which is opened if it is not yet, and belongs to the folder; NULL where it has no objects.
 * FROE_E_ARG: there is no such shard. FROE_E_IO, FROE_E_FORMAT, FROE_E_MEMORY. */
FROE_API froe_status froe_shards_tree(froe_shards *shards, uint32_t shard, const froe_tree **out,
                                      froe_diagnostic *diag);
/** A context of the tree of a shard with objects, which belongs to the folder. FROE_E_ARG: there is no such shard, or
 * it is empty. FROE_E_IO, FROE_E_FORMAT, FROE_E_MEMORY. */
FROE_API froe_status froe_shards_query(froe_shards *shards, uint32_t shard, froe_query **out, froe_diagnostic *diag);
/** Checks all shards as froe_tree_check() does, one after the other, and that every object is in all the cells that its
 * box meets: FROE_E_FORMAT names the first shard that is not what the manifest says, or not what it says itself, or
 * lacks objects. FROE_E_MEMORY. O(size of all files). */
FROE_API froe_status froe_shards_check(froe_shards *shards, const froe_batch_options *options, froe_diagnostic *diag);

/* --------------------------------------------------------------------- ask -- */

/** An object that was found: its tag, and where it is. */
typedef struct froe_find {
    uint64_t tag;
    uint32_t shard;
    uint32_t object; /**< in the tree of the shard; FROE_NONE: nothing was found */
    double value;    /**< parameter of a ray, or distance; 0 for other questions */
} froe_find;
/** Answers of a batch: those of question i are items[starts[i] .. starts[i + 1]). */
typedef struct froe_finds {
    size_t *starts; /**< one more than questions */
    froe_find *items;
    size_t questions;
    froe_allocator alloc; /**< that the arrays came from */
} froe_finds;
FROE_API void froe_finds_free(froe_finds *finds);

/* Each of these is the batch of froe/query.h that is called alike, with the same statuses. options NULL: the defaults;
 * progress is told behind each shard. The first bad question ends the call: diag->object is its position. */

/** The objects that meet ranges, by tag. With eps, which objects beyond a range are told depends on the shards. */
FROE_API froe_status froe_shards_range(froe_shards *shards, const froe_range *ranges, size_t count,
                                       const froe_batch_options *options, froe_finds *out, froe_diagnostic *diag);
/** Of exact boxes alone: 2 dim doubles each, lower corner, then upper. */
FROE_API froe_status froe_shards_boxes(froe_shards *shards, const double *boxes, size_t count,
                                       const froe_batch_options *options, froe_finds *out, froe_diagnostic *diag);
/** One object that meets each range; finds: `count` of them, the caller's, as for the following functions. */
FROE_API froe_status froe_shards_any(froe_shards *shards, const froe_range *ranges, size_t count,
                                     const froe_batch_options *options, froe_find *finds, froe_diagnostic *diag);
/** The objects that contain points of dim doubles each, by tag. */
FROE_API froe_status froe_shards_locate(froe_shards *shards, const double *points, size_t count,
                                        const froe_batch_options *options, froe_finds *out, froe_diagnostic *diag);
/** The groups that points of the plane lie in, ascending: `tag` is the number of the group, `shard` one that has all of
 * it, and `object` FROE_NONE. FROE_E_UNSUPPORTED as froe_query_groups(). */
FROE_API froe_status froe_shards_groups(froe_shards *shards, const double *points, size_t count,
                                        const froe_batch_options *options, froe_finds *out, froe_diagnostic *diag);
/** The groups that meet ranges, lie within them, or cover them, told as by froe_shards_groups(). FROE_E_UNSUPPORTED as
 * froe_query_groups_range(). */
FROE_API froe_status froe_shards_groups_range(froe_shards *shards, const froe_range *ranges, size_t count,
                                              froe_relation relation, const froe_batch_options *options,
                                              froe_finds *out, froe_diagnostic *diag);
/** The groups that meet the groups of a tree of the plane, lie within them, or cover them, as
 * froe_batch_groups_join() has them: question i is group i of that tree, and answers are told as by
 * froe_shards_groups(). Only shards within the bounds of the tree are opened. A folder takes the place of the tree by a
 * call for each of its shards: froe_shards_tree() has every group of which it has a part as a whole. FROE_E_UNSUPPORTED
 * as froe_batch_groups_join(). */
FROE_API froe_status froe_shards_groups_join(froe_shards *shards, const froe_tree *questions, froe_relation relation,
                                             const froe_batch_options *options, froe_finds *out, froe_diagnostic *diag);
/** The first segment above (direction 1) or below (-1) each point of the plane; of several met at the same point, that
 * with the lowest tag. */
FROE_API froe_status froe_shards_vertical(froe_shards *shards, const double *points, size_t count, int direction,
                                          const froe_batch_options *options, froe_find *finds, froe_diagnostic *diag);
/** What rays meet first; of several objects met at the same point, that with the lowest tag. */
FROE_API froe_status froe_shards_ray(froe_shards *shards, const double *origins, const double *directions, size_t count,
                                     double t_max, const froe_batch_options *options, froe_find *finds,
                                     froe_diagnostic *diag);
/** Any object that each ray meets. */
FROE_API froe_status froe_shards_ray_any(froe_shards *shards, const double *origins, const double *directions,
                                         size_t count, double t_max, const froe_batch_options *options,
                                         froe_find *finds, froe_diagnostic *diag);
/** All that rays meet, by parameters, then tags. */
FROE_API froe_status froe_shards_ray_all(froe_shards *shards, const double *origins, const double *directions,
                                         size_t count, double t_max, const froe_batch_options *options, froe_finds *out,
                                         froe_diagnostic *diag);
/** The k objects nearest to points among those within `bound`, nearest first, equal distances by tag. */
FROE_API froe_status froe_shards_near(froe_shards *shards, const double *points, size_t count, size_t k, double bound,
                                      const froe_batch_options *options, froe_finds *out, froe_diagnostic *diag);

/* How many answers the questions above have; counts: `count` of them, the caller's, which may hold anything after a
 * failure. Of several processes (froe_shards_share()) numbers alone go from one to another. */

/** How many objects meet each range. */
FROE_API froe_status froe_shards_count(froe_shards *shards, const froe_range *ranges, size_t count,
                                       const froe_batch_options *options, uint64_t *counts, froe_diagnostic *diag);
/** How many froe_shards_locate() finds. */
FROE_API froe_status froe_shards_locate_count(froe_shards *shards, const double *points, size_t count,
                                              const froe_batch_options *options, uint64_t *counts,
                                              froe_diagnostic *diag);
/** 1: there is a segment above (direction 1) or below (-1); 0: there is none. */
FROE_API froe_status froe_shards_vertical_count(froe_shards *shards, const double *points, size_t count, int direction,
                                                const froe_batch_options *options, uint64_t *counts,
                                                froe_diagnostic *diag);
/** How many froe_shards_ray_all() finds. */
FROE_API froe_status froe_shards_ray_count(froe_shards *shards, const double *origins, const double *directions,
                                           size_t count, double t_max, const froe_batch_options *options,
                                           uint64_t *counts, froe_diagnostic *diag);
/** How many froe_shards_near() finds: k at most. */
FROE_API froe_status froe_shards_near_count(froe_shards *shards, const double *points, size_t count, size_t k,
                                            double bound, const froe_batch_options *options, uint64_t *counts,
                                            froe_diagnostic *diag);

/** Two objects that meet; a.tag <= b.tag. */
typedef struct froe_found_pair {
    froe_find a, b; /**< of the same shard */
    froe_meeting kind;
} froe_found_pair;
typedef bool froe_found_pair_fn(void *user, const froe_found_pair *pair);
/** All pairs of objects that meet, each once, shard by shard, and of each by a, then b: it takes the memory that
 * froe_batch_pairs() takes of one shard. `shared` and the visitor are as for froe_query_pairs(). */
FROE_API froe_status froe_shards_pairs(froe_shards *shards, bool shared, const froe_batch_options *options,
                                       froe_found_pair_fn *fn, void *user, froe_diagnostic *diag);

#ifdef __cplusplus
}
#endif
#endif
