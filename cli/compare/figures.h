/* figures.h: the plots of a scene: growth, cost against 1/eps, loads of leaves. */
#ifndef FROE_CLI_COMPARE_FIGURES_H
#define FROE_CLI_COMPARE_FIGURES_H
#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

/** Writes how trees grow and what queries cost, of all rows of a scene (row.h), as HTML; and how full the leaves are,
 * folded away. Return false without memory. */
bool figures_put(FILE *out, const json_t *rows);
bool figures_put_loads(FILE *out, const json_t *rows);
#endif
