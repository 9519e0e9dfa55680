/* claims.h: claims of the sources as rows: a number that can be measured and the range it must lie in.
 *
 *     is        the number by the method                          must lie in the range
 *     without   the same number without what the claim rests on   must lie outside
 *
 * A row whose two numbers both lie in the range says nothing about the method, and fails. */
#ifndef FROE_BENCH_CLAIMS_H
#define FROE_BENCH_CLAIMS_H
#include "../bench.h"
#include <froe/query.h>

/** How a measure makes its trees. */
typedef struct claims_way {
    const char *method;   /**< registered, or "sorted": cuts along the objects in the order of the scene; or NULL */
    const char *settings; /**< of build_tuned() */
    bool bare;            /**< the measure itself leaves out what the row names */
} claims_way;

typedef double claims_measure(const claims_way *way, const void *of);

typedef struct claim {
    const char *source;   /**< paper and theorem */
    const char *says;     /**< what it claims */
    const char *measured; /**< what the number is, and of what */
    double least, most;   /**< the claim holds when the number lies between them; NaN never does */
    claims_measure *measure;
    const void *of; /**< what to measure, for `measure` */
    claims_way with;
    const char *needs; /**< what would break the claim if it were missing */
    claims_way without;
    enum { CLAIM_COUNTED, CLAIM_QUICK, CLAIM_TIMED } kind; /**< quick: counted, in a second at most */
} claim;
/** Each ended by a NULL source. */
extern const claim claims_berg[], claims_sacks[], claims_boxes[], claims_cylinders[], claims_ranges[], claims_motion[];

/* ------------------------------------------------------------------- scenes -- */

/** A kind of froe_generate, "scatter", or one of the worst scenes of scenes.c. lambda: for those that come in groups,
 * each as dense as that; 0: one group of all. */
froe_scene *claims_scene(const char *kind, size_t n, size_t lambda);

/** A tree of such a scene, with its scene. */
typedef struct claims_tree {
    froe_scene *scene;
    froe_tree *tree;
    froe_report report;
    claims_way way;
    double n, lambda, seconds; /**< objects; processor time of the build */
} claims_tree;
claims_tree claims_build(const char *kind, size_t n, size_t lambda, const claims_way *way, uint32_t leaf);
/** The same of a scene that there is: it is taken over. */
claims_tree claims_build_of(froe_scene *scene, const claims_way *way, uint32_t leaf);
void claims_free(claims_tree *t);
/** lacking.c: a tree by a method that lacks something; NULL: there is none of that name. */
froe_tree *claims_lacking(froe_scene *scene, const char *method, uint32_t leaf);

/* ----------------------------------------------------------------- measures -- */

enum { CLAIMS_SERIES = 16 };
/** How numbers grow. */
typedef struct claims_series {
    double x[CLAIMS_SERIES], y[CLAIMS_SERIES];
    size_t count;
} claims_series;
void claims_add(claims_series *s, double x, double y);
/** Slope of log y against log x. */
double claims_slope(const claims_series *s);

/** A number of a tree. */
typedef double claims_value(const claims_tree *t);
claims_value claims_size;                       /**< nodes and pieces */
claims_value claims_pieces;                     /**< in all lists */
claims_value claims_height;                     /**< edges on the longest path */
claims_value claims_per_object;                 /**< pieces / n */
claims_value claims_high;                       /**< height / log2 n */
claims_value claims_n_log_n;                    /**< n ln n, what times are divided by */
double claims_density(const froe_scene *scene); /**< an upper bound, certified */

/* Costs of queries, the mean of many: nodes and leaves visited, steps that lead past nodes, objects tested. */
typedef struct claims_asker {
    froe_query *query;
    const froe_scene *scene;
    int dim;
    double side; /**< longest of the scene */
    uint64_t state;
} claims_asker;
enum { CLAIMS_QUERIES = 300 };
claims_asker claims_ask(const claims_tree *t); /**< the query is to be freed */
double claims_asked(claims_asker *a);          /**< cost since it was last asked */
/** A corner of a random object, moved by a random part of `away` sides of the scene. */
void claims_place(claims_asker *a, double away, double *out);
claims_value claims_location; /**< of a point; bare: from the root, cut by cut */

/** The trees that a measure looks at. */
typedef struct claims_plan {
    const char *const *kinds; /**< of scenes, ended by NULL */
    size_t from;              /**< objects; doubled so many times: */
    int doublings;
    claims_value *value;
    size_t lambda; /**< of the scenes; claims_by_lambda() doubles it instead of n */
    uint32_t leaf; /**< 0: the method's own */
    bool cuts;     /**< no object is left in a leaf */
} claims_plan;
#define CLAIMS_PAIR(...) ((const claims_plan[]){__VA_ARGS__})
/** A plan: kinds of scenes in brackets, objects, doublings, value, then other members by name. */
#define CLAIMS_PLAN(scenes, n, times, number, ...)                                                                     \
    (&(const claims_plan){.kinds = CLAIMS_KINDS scenes, .from = n, .doublings = times, .value = number, __VA_ARGS__})

#define CLAIMS_KINDS(...)                                                                                              \
    (const char *const[]) {                                                                                            \
        __VA_ARGS__, NULL                                                                                              \
    }

/* Each takes a claims_plan and returns the worst, that is the greatest, over kinds. */
claims_measure claims_growth;    /**< exponent of the value in n */
claims_measure claims_of_two;    /**< the same of two plans: the second, when bare, is of scenes that lack something */
claims_measure claims_by_log_n;  /**< exponent of the value in log n */
claims_measure claims_by_lambda; /**< exponent of the value in lambda */
claims_measure claims_most;      /**< the value itself, for all n */
/** Exponent of the processor time in n, the least of three, divided by what the value is. */
claims_measure claims_time;
#endif
