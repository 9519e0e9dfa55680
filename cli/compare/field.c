/* field.c: see field.h. */
#include "compare/field.h"
#include <math.h>
#include <string.h>

double field_number(const json_t *object, const char *key) {
    const json_t *value = json_object_get(object, key);
    return json_is_number(value) ? json_number_value(value) : NAN;
}

bool field_is_built(const json_t *row) {
    return strcmp(json_string_value(json_object_get(row, "status")), "ok") == 0;
}

const json_t *field_row(const json_t *rows, const char *method) {
    for (size_t i = 0; i < json_array_size(rows); i++) {
        const json_t *row = json_array_get(rows, i);
        if (strcmp(json_string_value(json_object_get(row, "method")), method) == 0) return row;
    }
    return NULL;
}

const char *field_scene(const json_t *scene) {
    const char *path = json_string_value(json_object_get(scene, "scene")), *slash = strrchr(path, '/');
    return slash && slash[1] ? slash + 1 : path;
}
