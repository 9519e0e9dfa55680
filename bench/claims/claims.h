/* claims.h: claims of the sources, each with a number that can be measured and the range it must lie in. */
#ifndef FROE_BENCH_CLAIMS_H
#define FROE_BENCH_CLAIMS_H
#include "../bench.h"

typedef struct claim {
    const char *source;   /**< paper and theorem */
    const char *says;     /**< what it claims */
    const char *method;   /**< that must be registered; NULL: none */
    const char *measured; /**< what the number is, and of what */
    double least, most;   /**< the claim holds when the number lies between them; NaN never does */
    double (*fn)(void);
} claim;
/** Each ended by a NULL source. */
extern const claim claims_size[], claims_query[], claims_motion[];

enum { CLAIMS_SERIES = 16 };
/** How numbers grow with n. */
typedef struct claims_series {
    double x[CLAIMS_SERIES], y[CLAIMS_SERIES];
    size_t count;
} claims_series;
void claims_add(claims_series *s, double x, double y);
/** Slope of log y against log x. */
double claims_slope(const claims_series *s);

/** A tree of a generated scene (kind of bench_generate), with its scene. */
typedef struct claims_tree {
    froe_scene *scene;
    froe_tree *tree;
    froe_report report;
    double seconds; /**< processor time of the build */
} claims_tree;
claims_tree claims_build(const char *kind, size_t n, const char *method, const char *settings, uint32_t leaf);
void claims_free(claims_tree *t);

bool claims_has(const char *method);
/** Does the method serve the dimension and the kinds of the scene? */
bool claims_serves(const froe_method_info *method, const froe_scene *scene);
#endif
