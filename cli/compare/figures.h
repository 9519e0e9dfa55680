/* figures.h: the plots of a scene: growth, cost against 1/eps, loads of leaves. */
#ifndef FROE_CLI_COMPARE_FIGURES_H
#define FROE_CLI_COMPARE_FIGURES_H
#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>

/** Writes the figures of all rows of a scene (row.h) as HTML. Returns false without memory. */
bool figures_put(FILE *out, const json_t *rows);
#endif
