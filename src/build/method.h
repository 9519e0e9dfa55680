/* method.h: what a builder is, and what it is given. */
#ifndef FROE_BUILD_METHOD_H
#define FROE_BUILD_METHOD_H
#include "base/task.h"
#include "tree/draft.h"

#define BUILD_OPTIONS 16

/** One build in progress. */
typedef struct build_job {
    froe_scene *scene;
    froe_allocator alloc;
    base_task *task;
    froe_diagnostic *diag;
    uint32_t leaf;
    uint64_t seed, max_fragments;
    double option[BUILD_OPTIONS]; /**< values in the order of info.options */
    tree_meta meta;               /**< name, settings, seed, leaf are set; the builder adds promises and root */
} build_job;

typedef struct build_method {
    froe_method_info info;
    /** Builds the tree. The dispatcher has checked kinds, dims, leaf and option ranges. */
    froe_status (*build)(build_job *job, froe_tree **out);
} build_method;
#endif
