/* areas.c: references: a point in every cell, and the groups that it lies in. */
#include "query/point/areas.h"
#include "base/floats.h"
#include "query/segment.h"
#include "support/fail.h"
#include <string.h>

/* -------------------------------------------------------------- references -- */

typedef struct survey {
    froe_query *q;
    query_areas *areas;
    froe_status status;
} survey;

static bool keep_reference(survey *v, const double *at) {
    query_reference r = {.at = {at[0], at[1]}};
    const froe_allocator *alloc = &v->q->alloc;
    return query_sets_keep(&v->areas->sets, alloc, &v->q->groups.inside, &r.set) &&
           array_push(alloc, &v->areas->references, r);
}

/* A mean of the corners of a cell, with other weights at every try. */
static void mean(const froe_cell *cell, uint32_t try, double x[2]) {
    double sum = 0;
    for (size_t i = 0; i < cell->corners; i++) sum += 1 + (double)(try * (i + 1) % 7);
    x[0] = x[1] = 0;
    for (size_t i = 0; i < cell->corners; i++)
        for (int k = 0; k < 2; k++) x[k] += cell->coords[2 * i + (size_t)k] * ((1 + (double)(try * (i + 1) % 7)) / sum);
}

/* Is the point within the cell of a node, and on no border? */
static bool serves(survey *v, uint32_t node, const double *x) {
    const froe_scene *s = v->q->tree->scene;
    const tree_objects list = tree_list(v->q->tree, node);
    query_leaf leaf;
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

static uint32_t last_of(const survey *v) {
    return (uint32_t)v->areas->references.count - 1;
}

static bool look_at_cell(void *user, const froe_cell *cell) {
    BASE_FLOATS_OWN;
    enum { TRIES = 4 };
    survey *v = user;
    query_areas *areas = v->areas;
    if (!cell->leaf) return true;
    const uint32_t node = cell->node.id1 - 1, place = query_leaf_place(v->q->tree, node);
    double x[2];
    bool found = false;
    for (uint32_t try = 0; try < TRIES && !found && !v->status; try++) {
        mean(cell, try, x);
        found = serves(v, node, x);
    }
    areas->slots[place] = last_of(v) | AREA_FAR;
    if (v->status || !found) return !v->status;
    v->status = query_areas_travel(v->q, areas, areas->references.data[last_of(v)].at, x, NULL);
    if (!v->status && !keep_reference(v, x)) v->status = FROE_E_MEMORY;
    areas->slots[place] = last_of(v);
    return !v->status;
}

/* A point in no group, outside of everything. False: the scene reaches as far as doubles do. */
static bool find_outside(const froe_scene *s, double x[2]) {
    x[0] = nextafter(s->lo[0], -INFINITY);
    x[1] = s->lo[1];
    if (isfinite(x[0])) return true;
    x[0] = nextafter(s->hi[0], INFINITY);
    if (isfinite(x[0])) return true;
    x[0] = s->lo[0];
    x[1] = nextafter(s->lo[1], -INFINITY);
    if (isfinite(x[1])) return true;
    x[1] = nextafter(s->hi[1], INFINITY);
    return isfinite(x[1]);
}

/* A box around the scene, with a margin of an eighth of its size and more. */
static void frame(const froe_scene *s, double lo[2], double hi[2]) {
    double most = 0, size = 0;
    for (int k = 0; k < 2; k++) {
        size = fmax(size, s->hi[k] / 4 - s->lo[k] / 4);
        most = fmax(most, fmax(fabs(s->lo[k]), fabs(s->hi[k])));
    }
    const double margin = size / 2 + most * 0x1p-40 + 0x1p-1000, limit = 0x1.fffffffffffffp+1023;
    for (int k = 0; k < 2; k++) {
        lo[k] = fmax(s->lo[k] - margin, -limit);
        hi[k] = fmin(s->hi[k] + margin, limit);
    }
}

/* A leaf whose cell was not visited, being too thin for doubles, takes the reference of the leaf before. */
static void fill_slots(survey *v) {
    const froe_tree *t = v->q->tree;
    uint32_t last = AREA_FAR;
    for (uint32_t i = 0; i < t->node_count; i++) {
        if (!tree_is_leaf(t->nodes + i)) continue;
        uint32_t *slot = v->areas->slots + query_leaf_place(t, i);
        if (*slot == FROE_NONE) *slot = last;
        last = *slot | AREA_FAR;
    }
}

static froe_status find_references(froe_query *q, query_areas *areas, froe_diagnostic *diag) {
    const froe_scene *s = q->tree->scene;
    survey v = {.q = q, .areas = areas};
    double x[2], lo[2], hi[2];
    if (!find_outside(s, x))
        return support_fail(diag, FROE_E_UNSUPPORTED,
                            "Nothing is outside of a scene that reaches as far as doubles do.");
    areas->place_count = tree_is_packed(q->tree) ? q->tree->packed.block_count : q->tree->node_count;
    areas->slots = support_calloc(&q->alloc, areas->place_count, sizeof *areas->slots);
    if (!areas->slots) return support_fail_memory(diag);
    memset(areas->slots, 0xff, areas->place_count * sizeof *areas->slots);
    q->groups.inside.count = 0;
    if (!keep_reference(&v, x)) return support_fail_memory(diag);
    frame(s, lo, hi);
    const froe_status status = froe_tree_cells(q->tree, lo, hi, look_at_cell, &v, diag);
    if (status || v.status) return status ? status : support_fail_memory(diag);
    fill_slots(&v);
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
