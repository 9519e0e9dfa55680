/* areas_assign.c: which segments bound areas? */
#include "base/radix.h"
#include "query/point/areas.h"
#include "support/fail.h"
#include <string.h>

enum {
    GROUP_UNKNOWN,
    GROUP_RINGED,
    GROUP_OPEN
}; /* a group: nothing known yet; some of its segments share a face; it consists of lines */

typedef struct border_search {
    const froe_scene *scene;
    query_areas *areas;
    uint8_t *groups;          /* [group]: see above */
    base_pair *pairs, *spare; /* two for each object */
    size_t count;
} border_search;

/* Roles that follow from objects, groups and faces alone; collects the ends of what may be a border. */
static void assign_first_roles(border_search *v) {
    const froe_scene *s = v->scene;
    uint8_t *roles = v->areas->roles;
    for (uint32_t i = 0; i < s->object_count; i++) { /* segments with a group are members for now */
        const froe_kind form = scene_form(s, i);
        if (!s->groups || s->groups[i] == FROE_NONE) continue;
        roles[i] = form >= FROE_BOX ? AREA_SOLID : AREA_MEMBER;
        v->areas->solids |= form >= FROE_BOX;
        if (form != FROE_SEGMENT) continue;
        const uint32_t face = s->faces ? s->faces[i] : i;
        v->pairs[v->count++] = (base_pair){(uint64_t)s->groups[i] << 32 | face, i};
    }
    base_radix_sort(v->pairs, v->spare, v->count);
    for (size_t i = 1; i < v->count; i++) { /* segments of one group and face are neighbours now */
        if (v->pairs[i].key != v->pairs[i - 1].key) continue;
        roles[v->pairs[i].value] = roles[v->pairs[i - 1].value] = AREA_BORDER;
        v->groups[v->pairs[i].key >> 32] = GROUP_RINGED;
    }
    v->count = 0;
    for (uint32_t i = 0; i < s->object_count; i++) { /* segments of groups without rings are borders for now */
        if (!roles[i] || scene_form(s, i) != FROE_SEGMENT) continue;
        if (v->groups[s->groups[i]] == GROUP_UNKNOWN) roles[i] = AREA_BORDER;
        for (uint32_t end = 0; end < 2 && roles[i] == AREA_BORDER; end++)
            v->pairs[v->count++] = (base_pair){(uint64_t)s->groups[i] << 32 | scene_corner(s, i, end), i};
    }
}

/* Where an odd number of segments ends, borders do not close. */
static froe_status check_ends(border_search *v, froe_diagnostic *diag) {
    base_radix_sort(v->pairs, v->spare, v->count);
    for (size_t i = 0, end; i < v->count; i = end) {
        for (end = i + 1; end < v->count && v->pairs[end].key == v->pairs[i].key;) end++;
        uint8_t *group = v->groups + (v->pairs[i].key >> 32);
        if ((end - i) % 2 == 0) continue;
        if (*group == GROUP_RINGED) {
            const uint32_t id = (uint32_t)(v->pairs[i].key >> 32);
            const double *x = scene_vertex(v->scene, (uint32_t)v->pairs[i].key);
            return support_fail_at(
                diag, FROE_E_UNSUPPORTED, v->pairs[i].value, FROE_NONE, FROE_NONE,
                "group %u (%.80s): It bounds no area, because an odd number of its segments ends at (%.17g, %.17g).",
                id, froe_scene_group(v->scene, id).name, x[0], x[1]);
        }
        *group = GROUP_OPEN;
    }
    return FROE_OK;
}

froe_status query_areas_assign(froe_query *q, query_areas *areas, froe_diagnostic *diag) {
    const froe_scene *s = q->tree->scene;
    const froe_allocator *alloc = &q->alloc;
    const size_t most = 2 * (size_t)s->object_count;
    border_search v = {.scene = s, .areas = areas};
    froe_status status = FROE_E_MEMORY;
    areas->roles = support_calloc(alloc, s->object_count, sizeof *areas->roles);
    if (!areas->roles) return support_fail_memory(diag);
    areas->object_count = s->object_count;
    v.groups = support_calloc(alloc, s->group_count, sizeof *v.groups);
    v.pairs = support_calloc(alloc, most, sizeof *v.pairs);
    v.spare = support_calloc(alloc, most, sizeof *v.spare);
    if (v.groups && v.pairs && v.spare) {
        assign_first_roles(&v);
        status = check_ends(&v, diag);
        for (uint32_t i = 0; i < s->object_count; i++) { /* groups that do not close consist of lines */
            uint8_t *role = areas->roles + i;
            if (*role == AREA_BORDER && v.groups[s->groups[i]] == GROUP_OPEN) *role = AREA_MEMBER;
            areas->borders |= *role == AREA_BORDER;
        }
    } else {
        support_fail_memory(diag);
    }
    support_free(alloc, v.groups, s->group_count * sizeof *v.groups);
    support_free(alloc, v.pairs, most * sizeof *v.pairs);
    support_free(alloc, v.spare, most * sizeof *v.spare);
    return status;
}
