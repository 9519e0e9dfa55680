/* crs.c: the coordinate system of a scene: carried, not understood; and what crosses the antimeridian. */
#include "base/floats.h"
#include "scene/store.h"
#include <math.h>
#include <string.h>

enum { STRINGS = 4, MOST_BYTES = 1 << 24 };

froe_status froe_scene_set_crs(froe_scene *scene, const froe_crs *crs) {
    BASE_FLOATS_OWN;
    if (!scene || !crs || (unsigned)crs->kind >= FROE_CRS_KIND_COUNT) return FROE_E_ARG;
    froe_status status = scene_growable(scene, NULL);
    if (status) return status;
    const char *const strings[STRINGS] = {crs->wkt, crs->name, crs->code, crs->unit};
    size_t sizes[STRINGS], need = 0;
    for (int i = 0; i < STRINGS && crs->kind; i++) {
        sizes[i] = strings[i] ? strlen(strings[i]) + 1 : 1;
        if (sizes[i] > MOST_BYTES - need) return FROE_E_LIMIT;
        need += sizes[i];
    }
    char *text = need ? support_calloc(&scene->alloc, need, 1) : NULL, *end = text;
    if (need && !text) return FROE_E_MEMORY;
    for (int i = 0; i < STRINGS && crs->kind; end += sizes[i++]) memcpy(end, strings[i] ? strings[i] : "", sizes[i]);
    support_free(&scene->alloc, scene->crs, scene->crs_size); /* only now: the strings may be its own */
    scene->crs = text;
    scene->crs_size = (uint32_t)need;
    scene->crs_kind = crs->kind;
    return FROE_OK;
}

froe_crs froe_scene_crs(const froe_scene *scene) {
    const char *strings[STRINGS] = {"", "", "", ""}, *at = scene->crs;
    for (int i = 0; i < STRINGS && scene->crs_size; i++, at += strlen(at) + 1) strings[i] = at;
    return (froe_crs){scene->crs_kind, strings[0], strings[1], strings[2], strings[3]};
}

bool scene_crs_fits(uint32_t kind, const char *strings, size_t size) {
    size_t ends = 0;
    for (size_t i = 0; i < size; i++) ends += !strings[i];
    if (kind == FROE_CRS_UNKNOWN) return size == 0;
    return kind < FROE_CRS_KIND_COUNT && ends == STRINGS && !strings[size - 1];
}

/* ------------------------------------------------------------ antimeridian -- */

static bool is_across(const froe_scene *s, uint32_t object) {
    const double half_turn = 180, pole = 90;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    scene_object_bounds(s, object, lo, hi);
    return hi[0] - lo[0] > half_turn && !(lo[1] == hi[1] && fabs(lo[1]) == pole);
}

size_t froe_scene_across(const froe_scene *scene, uint32_t *first) {
    BASE_FLOATS_OWN;
    size_t count = 0;
    froe_object last = {.group = FROE_NONE};
    if (first) *first = FROE_NONE;
    if (scene->crs_kind != FROE_CRS_GEOGRAPHIC || !(scene->hi[0] - scene->lo[0] > 180)) return 0;
    for (uint32_t i = 0; i < scene->object_count; i++) {
        if (!scene_is_checked(scene) && !scene_object_fits(scene, i)) continue;
        if (!is_across(scene, i)) continue;
        const froe_object object = froe_scene_object(scene, i);
        if (!count && first) *first = i;
        if (!count || object.group != last.group || (object.group == FROE_NONE && object.tag != last.tag)) count++;
        last = object;
    }
    return count;
}
