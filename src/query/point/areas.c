/* areas.c: references: a point in every cell, and the groups that it lies in. */
#include "query/point/areas.h"
#include "base/floats.h"
#include "query/segment.h"
#include "support/fail.h"
#include "tree/list.h"
#include <string.h>

/* -------------------------------------------------------------- references -- */

typedef struct reference_search {
    froe_query *q;
    query_areas *areas;
    froe_status status;
} reference_search;

static bool keep_reference(reference_search *v, const double *at) {
    query_reference r = {.at = {at[0], at[1]}};
    const froe_allocator *alloc = &v->q->alloc;
    return query_sets_keep(&v->areas->sets, alloc, &v->q->groups.inside, &r.set) &&
           array_push(alloc, &v->areas->references, r);
}

/* Is the point within the cell of a node, and on no border? */
static bool serves(reference_search *v, uint32_t node, const double *x) {
    const froe_scene *s = v->q->tree->scene;
    const tree_objects list = tree_list(v->q->tree, node);
    query_leaf leaf;
    /* one way: a mean of finite corners, which only rounding beside the largest double could take beyond it */
    if (!isfinite(x[0]) || !isfinite(x[1])) return false;
    v->status = query_leaf_find(v->q, x, &leaf);
    if (v->status || leaf.place != query_leaf_place(v->q->tree, node) || leaf.on_cut) return false;
    for (uint32_t i = 0; i < list.count; i++) {
        const uint32_t object = tree_object(&list, i);
        if (v->areas->roles[object] != AREA_BORDER) continue;
        const double *a = scene_point(s, object, 0), *b = scene_point(s, object, 1);
        if (query_segment_meets_box(&v->q->numbers, a, b, x, x)) return false;
    }
    return true;
}

static uint32_t last_of(const reference_search *v) {
    return (uint32_t)v->areas->references.count - 1;
}

static bool look_at_cell(void *user, const froe_cell *cell) {
    BASE_FLOATS_OWN;
    enum { REFERENCE_TRIES = 4 };
    reference_search *v = user;
    query_areas *areas = v->areas;
    if (!cell->leaf) return true;
    const uint32_t node = cell->node.id1 - 1, place = query_leaf_place(v->q->tree, node);
    double x[2];
    bool found = false;
    for (uint32_t try = 0; try < REFERENCE_TRIES && !found && !v->status; try++) {
        /* A mean of the corners of the cell, with other weights at every try. */
        double sum = 0;
        for (size_t i = 0; i < cell->corners; i++) sum += 1 + (double)(try * (i + 1) % 7);
        x[0] = x[1] = 0;
        for (size_t i = 0; i < cell->corners; i++)
            for (size_t k = 0; k < 2; k++) x[k] += cell->coords[2 * i + k] * ((1 + (double)(try * (i + 1) % 7)) / sum);
        found = serves(v, node, x);
    }
    areas->slots[place] = last_of(v) | AREA_FAR;
    if (v->status || !found) return !v->status;
    v->status = query_areas_travel(v->q, areas, areas->references.data[last_of(v)].at, x, NULL);
    if (!v->status && !keep_reference(v, x)) v->status = FROE_E_MEMORY;
    areas->slots[place] = last_of(v);
    return !v->status;
}

static froe_status find_references(froe_query *q, query_areas *areas, froe_diagnostic *diag) {
    const froe_tree *t = q->tree;
    const froe_scene *s = t->scene;
    reference_search v = {.q = q, .areas = areas};
    double lo[2], hi[2], most = 0, size = 0;
    /* The first reference is outside of everything, in no group. */
    const double beyond[4][2] = {{nextafter(s->lo[0], -INFINITY), s->lo[1]},
                                 {nextafter(s->hi[0], INFINITY), s->lo[1]},
                                 {s->lo[0], nextafter(s->lo[1], -INFINITY)},
                                 {s->lo[0], nextafter(s->hi[1], INFINITY)}};
    int side = 0;
    while (side < 4 && !isfinite(beyond[side][side / 2])) side++;
    if (side == 4)
        return support_fail(diag, FROE_E_UNSUPPORTED,
                            "Nothing is outside of a scene that reaches as far as doubles do.");
    areas->place_count = tree_is_packed(t) ? t->packed.block_count : t->node_count;
    areas->slots = support_calloc(&q->alloc, areas->place_count, sizeof *areas->slots);
    if (!areas->slots) return support_fail_memory(diag);
    memset(areas->slots, 0xff, areas->place_count * sizeof *areas->slots);
    q->groups.inside.count = 0;
    memcpy(areas->outside, beyond[side], sizeof areas->outside);
    if (!keep_reference(&v, areas->outside)) return support_fail_memory(diag);
    /* Cells are cut off by a box around the scene, with a margin of an eighth of its size and more. */
    for (int k = 0; k < 2; k++) {
        size = fmax(size, s->hi[k] / 4 - s->lo[k] / 4);
        most = fmax(most, fmax(fabs(s->lo[k]), fabs(s->hi[k])));
    }
    const double margin = size / 2 + most * 0x1p-40 + 0x1p-1000, limit = 0x1.fffffffffffffp+1023;
    for (int k = 0; k < 2; k++) {
        lo[k] = fmax(s->lo[k] - margin, -limit);
        hi[k] = fmin(s->hi[k] + margin, limit);
    }
    const froe_status status = froe_tree_cells(t, lo, hi, look_at_cell, &v, diag);
    if (status || v.status) return status ? status : support_fail_memory(diag);
    /* A leaf whose cell was not visited, being too thin for doubles, takes the reference of the leaf before. */
    uint32_t last = AREA_FAR;
    for (uint32_t i = 0; i < t->node_count; i++) {
        if (!tree_is_leaf(t->nodes + i)) continue;
        uint32_t *slot = areas->slots + query_leaf_place(t, i);
        if (*slot == FROE_NONE) *slot = last;
        last = *slot | AREA_FAR;
    }
    scene_table_free(&q->alloc, &areas->sets.table);
    return query_areas_settle(q, areas) ? FROE_OK : support_fail_memory(diag);
}

/* ------------------------------------------------------------------ making -- */

static void free_areas(const froe_allocator *alloc, query_part *part) {
    query_areas *a = (query_areas *)part;
    support_free(alloc, a->roles, a->object_count * sizeof *a->roles);
    support_free(alloc, a->slots, a->place_count * sizeof *a->slots);
    array_free(alloc, &a->references);
    array_free(alloc, &a->leaves);
    query_sets_free(&a->sets, alloc);
    support_free(alloc, a, sizeof *a);
}

static froe_status make_areas(froe_query *q, query_part **out, froe_diagnostic *diag) {
    const froe_query_stats stats = q->stats;
    query_areas *areas = support_calloc(&q->alloc, 1, sizeof *areas);
    if (!areas) return support_fail_memory(diag);
    areas->part.free = free_areas;
    *out = &areas->part;
    froe_status status = query_areas_assign(q, areas, diag);
    if (!status && areas->borders) status = find_references(q, areas, diag);
    q->stats = stats;
    return status;
}

froe_status query_areas_of(froe_query *query, const query_areas **out, froe_diagnostic *diag) {
    const query_part *part;
    const froe_status status = query_prepare(query, QUERY_AREAS, make_areas, &part, diag);
    if (status == FROE_OK) *out = (const query_areas *)part;
    return status;
}
