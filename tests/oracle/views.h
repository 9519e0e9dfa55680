/* views.h: every scene from nine eyes, held against the oracles: painted shapes against rays (canvas.h), whole stacks
 * of layers where one sees through things, edges against everything before them (sightlines.h). Public interface only,
 * so that tests and the long run in bench/ share it. */
#ifndef FROE_TESTS_ORACLE_VIEWS_H
#define FROE_TESTS_ORACLE_VIEWS_H
#include "oracle/canvas.h"
#include "oracle/sightlines.h"

/** Four eyes around the scene, one from above, two parallel ones, one of them along an axis; two amid the scene, where
 * rooms are. */
enum { ORACLE_VIEWS = 9 };
froe_status oracle_view(const froe_scene *scene, unsigned number, froe_projection *out, froe_diagnostic *diag);

typedef struct oracle_task {
    const froe_tree *tree;
    const froe_surface *surface;
    uint32_t samples; /**< along each side of the page */
    froe_paint paint;
    double underlap;
    uint32_t clear;     /**< of `clear` patches one is clear; 0: none */
    uint32_t edge_step; /**< every so many edges are checked; 0: none */
    const froe_allocator *alloc;
} oracle_task;

typedef struct oracle_report {
    oracle_result faces;
    oracle_lines lines;
    froe_picture_report last;     /**< of the last picture */
    uint64_t shapes, whole, late; /**< of all */
    uint64_t fallbacks;           /**< pictures of fragments although whole faces were asked for */
} oracle_report;

/** Adds what one view shows. */
froe_status oracle_check_view(const oracle_task *task, unsigned number, oracle_report *sum, froe_diagnostic *diag);
#endif
