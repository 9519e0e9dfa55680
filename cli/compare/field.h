/* field.h: what stands in a row (row.h). */
#ifndef FROE_CLI_COMPARE_FIELD_H
#define FROE_CLI_COMPARE_FIELD_H
#include <jansson.h>
#include <stdbool.h>

/** The number `key` of an object; NaN: it has none, or there is no object. */
double field_number(const json_t *object, const char *key);

/** Does a row hold a tree, not the reason why there is none? */
bool field_is_built(const json_t *row);

/** The name of a scene's file without its folder, which is nobody's business whom a page or a table is sent to. */
const char *field_scene(const json_t *scene);

/** The first row of a method, NULL if there is none. */
const json_t *field_row(const json_t *rows, const char *method);
#endif
