/* sightlines.h: the oracle for lines: is a point of an edge hidden by a polygon before it? In doubles, by looking at
 * all triangles there; doubtful points are passed over. */
#ifndef FROE_TESTS_ORACLE_SIGHTLINES_H
#define FROE_TESTS_ORACLE_SIGHTLINES_H
#include "oracle/hits.h"

typedef struct oracle_lines {
    uint64_t visible, hidden; /**< points of edges that were found to be what they should */
    uint64_t doubtful;        /**< beside a border, or as deep as another polygon */
    uint64_t wrong;
    uint32_t edge; /**< the first wrong one */
    double share;  /**< ... there */
} oracle_lines;

/** The middle of every visible interval, and of what lies between them, of every `step`-th edge. */
void oracle_check_edges(const oracle_triangles *triangles, const froe_scene *scene, const froe_surface *surface,
                        const froe_visibility *visibility, uint32_t step, oracle_lines *sum);
#endif
