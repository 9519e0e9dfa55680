/* areas_assign.c: which segments bound areas? */
#include "base/radix.h"
#include "query/point/areas.h"
#include "support/fail.h"
#include <string.h>

enum { SILENT, RINGED, OPEN }; /* a group: nothing known yet; some of its segments share a face; it consists of lines */

typedef struct survey {
    const froe_scene *scene;
    query_areas *areas;
    uint8_t *groups;          /* [group]: see above */
    base_pair *pairs, *spare; /* two for each object */
    size_t count;
} survey;

/* Roles that follow from the object alone: segments with a group are members for now. */
static void look_at_objects(survey *v) {
    const froe_scene *s = v->scene;
    for (uint32_t i = 0; i < s->object_count; i++) {
        const froe_kind form = scene_form(s, i);
        if (!s->groups || s->groups[i] == FROE_NONE) continue;
        v->areas->roles[i] = form >= FROE_BOX ? AREA_SOLID : AREA_MEMBER;
        v->areas->solids |= form >= FROE_BOX;
        if (form != FROE_SEGMENT) continue;
        const uint32_t face = s->faces ? s->faces[i] : i;
        v->pairs[v->count++] = (base_pair){(uint64_t)s->groups[i] << 32 | face, i};
    }
}

/* Segments of one group and face are neighbours now. */
static void find_rings(survey *v) {
    base_radix_sort(v->pairs, v->spare, v->count);
    for (size_t i = 1; i < v->count; i++) {
        if (v->pairs[i].key != v->pairs[i - 1].key) continue;
        v->areas->roles[v->pairs[i].value] = v->areas->roles[v->pairs[i - 1].value] = AREA_BORDER;
        v->groups[v->pairs[i].key >> 32] = RINGED;
    }
}

/* Segments of groups without rings are borders for now. Collects their ends, by group and vertex, in v->pairs. */
static void gather_ends(survey *v) {
    const froe_scene *s = v->scene;
    v->count = 0;
    for (uint32_t i = 0; i < s->object_count; i++) {
        if (!v->areas->roles[i] || s->forms[i] != FROE_SEGMENT) continue;
        if (v->groups[s->groups[i]] == SILENT) v->areas->roles[i] = AREA_BORDER;
        for (uint32_t end = 0; end < 2 && v->areas->roles[i] == AREA_BORDER; end++)
            v->pairs[v->count++] = (base_pair){(uint64_t)s->groups[i] << 32 | scene_corner(s, i, end), i};
    }
}

static froe_status refuse_open_border(const survey *v, const base_pair *end, froe_diagnostic *diag) {
    const uint32_t group = (uint32_t)(end->key >> 32);
    const double *x = scene_vertex(v->scene, (uint32_t)end->key);
    return support_fail_at(diag, FROE_E_UNSUPPORTED, end->value, FROE_NONE, FROE_NONE,
                           "Group %u (%.80s) bounds no area: an odd number of its segments ends at (%.17g, %.17g).",
                           group, froe_scene_group(v->scene, group).name, x[0], x[1]);
}

/* Where an odd number of segments ends, borders do not close. */
static froe_status check_ends(survey *v, froe_diagnostic *diag) {
    base_radix_sort(v->pairs, v->spare, v->count);
    for (size_t i = 0, end; i < v->count; i = end) {
        for (end = i + 1; end < v->count && v->pairs[end].key == v->pairs[i].key;) end++;
        uint8_t *group = v->groups + (v->pairs[i].key >> 32);
        if ((end - i) % 2 == 0) continue;
        if (*group == RINGED) return refuse_open_border(v, v->pairs + i, diag);
        *group = OPEN;
    }
    return FROE_OK;
}

static void settle_areas(survey *v) {
    const froe_scene *s = v->scene;
    for (uint32_t i = 0; i < s->object_count; i++) {
        uint8_t *role = v->areas->roles + i;
        if (*role == AREA_BORDER && v->groups[s->groups[i]] == OPEN) *role = AREA_MEMBER;
        v->areas->borders |= *role == AREA_BORDER;
    }
}

froe_status query_areas_assign(froe_query *q, query_areas *areas, froe_diagnostic *diag) {
    const froe_scene *s = q->tree->scene;
    const froe_allocator *alloc = &q->alloc;
    const size_t most = 2 * (size_t)s->object_count;
    survey v = {.scene = s, .areas = areas};
    froe_status status = FROE_E_MEMORY;
    areas->roles = support_calloc(alloc, s->object_count, sizeof *areas->roles);
    if (!areas->roles) return support_fail_memory(diag);
    areas->object_count = s->object_count;
    v.groups = support_calloc(alloc, s->group_count, sizeof *v.groups);
    v.pairs = support_calloc(alloc, most, sizeof *v.pairs);
    v.spare = support_calloc(alloc, most, sizeof *v.spare);
    if (v.groups && v.pairs && v.spare) {
        look_at_objects(&v);
        find_rings(&v);
        gather_ends(&v);
        status = check_ends(&v, diag);
        settle_areas(&v);
    } else {
        support_fail_memory(diag);
    }
    support_free(alloc, v.groups, s->group_count * sizeof *v.groups);
    support_free(alloc, v.pairs, most * sizeof *v.pairs);
    support_free(alloc, v.spare, most * sizeof *v.spare);
    return status;
}
