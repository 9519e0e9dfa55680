/* json.c: see json.h. */
#include "json.h"
#include <stdio.h>

void json_line(const json_result *r) {
    printf("{\"work\": \"%s\", \"scene\": \"%s\", \"objects\": %zu, \"program\": \"%s\", \"measure\": \"%s\"", r->work,
           r->scene, r->objects, r->program, r->measure);
    if (!r->values) {
        printf(", \"failed\": \"%s\"}\n", r->note);
    } else {
        for (size_t i = 0; i < r->count; i++) printf("%s%.6g", i ? ", " : ", \"values\": [", r->values[i]);
        printf("]");
        if (r->note) printf(", \"note\": \"%s\"", r->note);
        printf("}\n");
    }
    fflush(stdout);
}
