/* page.h: the demo's one HTML page. */
#ifndef FROE_CLI_DEMO_PAGE_H
#define FROE_CLI_DEMO_PAGE_H
#include "demo/scenes.h"
#include <jansson.h>

/** The reports of one scene. */
typedef struct demo_result {
    json_t *report[DEMO_STEPS]; /**< of each step; NULL: the step has none */
    json_t *methods;            /**< array: the reports of the same build by every method */
} demo_result;

/** Writes the page, whole or not at all. `results` are in the order of demo_scenes.
 * Returns 0 or an exit code after saying why. */
int demo_write_page(const char *path, const demo_result *results);
#endif
