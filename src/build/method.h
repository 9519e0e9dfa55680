/* method.h: what a builder is, and what it is given. */
#ifndef FROE_BUILD_METHOD_H
#define FROE_BUILD_METHOD_H
#include "split/grow.h"

#define BUILD_OPTIONS 20 /* most options of a method, tuning and what stands between included */
#define BUILD_DIMS_ALL 0x1fcu
#define BUILD_KINDS_ALL 0x3fu
/* What there is in R^d: polygons in space only. */
#define BUILD_KINDS_OF(d) ((d) == 3 ? BUILD_KINDS_ALL : BUILD_KINDS_ALL & ~(1u << FROE_POLYGON))
#define BUILD_IN(d, dims, kinds) (((dims) >> (d)) & 1 ? (kinds)&BUILD_KINDS_OF(d) : 0)
/** info.kinds of a method that serves these kinds in its dimensions, and above 3 those. */
#define BUILD_SERVES_ABOVE(dims, kinds, high)                                                                          \
    {                                                                                                                  \
        [2] = BUILD_IN(2, dims, kinds), [3] = BUILD_IN(3, dims, kinds), [4] = BUILD_IN(4, dims, high),                 \
        [5] = BUILD_IN(5, dims, high), [6] = BUILD_IN(6, dims, high), [7] = BUILD_IN(7, dims, high),                   \
        [8] = BUILD_IN(8, dims, high)                                                                                  \
    }
/** The same kinds in all of its dimensions. */
#define BUILD_SERVES(dims, kinds) BUILD_SERVES_ABOVE(dims, kinds, kinds)

/** One build in progress. */
typedef struct build_job {
    froe_scene *scene;
    froe_allocator alloc;
    base_task *task;
    froe_diagnostic *diag;
    uint32_t leaf;
    bool own_leaf; /**< the caller names none: the builder may take another, and says so in meta */
    bool picture;  /**< "auto" chose the method for pictures of a scene in space: the tree serves few of them */
    uint64_t seed, max_fragments;
    const uint32_t *order;        /**< of all objects, or NULL */
    const froe_cut *root;         /**< the first cut, or NULL */
    num_stage first;              /**< where predicates start: NUM_FILTER, later ones for tests */
    double option[BUILD_OPTIONS]; /**< values in the order of info.options, tuning included */
    tree_meta meta;               /**< method, settings, seed, leaf are set; the builder adds promises and root */
} build_job;

typedef struct build_method {
    froe_method_info info;
    /** Replaces "by dimension" values of options by what they mean for this scene; may be NULL. */
    void (*resolve)(const froe_scene *scene, uint32_t leaf, double *option);
    bool tunable; /**< behind the end of info.options stands a second table: options_tuning() */
    bool ordered; /**< takes an order of the objects */
    bool rooted;  /**< takes a first cut */
    /** Builds the tree. The dispatcher has checked kinds, dims, leaf and option ranges. */
    froe_status (*build)(build_job *job, froe_tree **out);
} build_method;

/** A job for the shared loop. */
split_job build_split_job(const build_job *job);
/** Adds a promise to job->meta. */
void build_promise(build_job *job, const char *name, double promised, double measured);
/** What a cut that the caller gives adds to a promise of height, which counts cuts by objects: that cut need not run
 * along one. */
static inline double build_levels_given(const build_job *job) {
    return job->root ? 1 : 0;
}
#endif
