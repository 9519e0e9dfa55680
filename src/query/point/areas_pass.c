/* areas_pass.c: the way from a reference to a point, and what lies beside it. */
#include "query/heap.h"
#include "query/point/areas.h"
#include "query/segment.h"
#include "support/fail.h"
#include "tree/list.h"
#include <string.h>

/* ---------------------------------------------------------------- crossing -- */

static bool in_bounds(const double *u, const double *v, const double *x) {
    for (int k = 0; k < 2; k++)
        if ((x[k] < u[k] && x[k] < v[k]) || (x[k] > u[k] && x[k] > v[k])) return false;
    return true;
}

/* Which of a list's borders are near the way is unpredictable, so branch-free. */
static bool bounds_meet(const double *a, const double *b, const double *u, const double *v) {
    bool apart = false;
    for (int k = 0; k < 2; k++) {
        const double lo = u[k] < v[k] ? u[k] : v[k], hi = u[k] < v[k] ? v[k] : u[k];
        apart |= ((a[k] < lo) & (b[k] < lo)) | ((a[k] > hi) & (b[k] > hi));
    }
    return !apart;
}

typedef bool change_fn(query_members *set, const froe_allocator *alloc, uint32_t number);

static bool change(froe_query *q, query_members *set, change_fn *fn, const query_border *s) {
    return fn(set, &q->alloc, s->groups[0]) && (s->groups[1] == FROE_NONE || fn(set, &q->alloc, s->groups[1]));
}

/* What a segment near the way between two points does to its groups. */
static bool pass_border(froe_query *q, const query_border *s, bool border, const double *from, const double *to) {
    num_context *numbers = &q->numbers;
    const int side = query_turn(numbers, s->u, s->v, to);
    if (side == 0 && in_bounds(s->u, s->v, to)) return change(q, &q->groups.touched, query_members_add, s);
    if (!border || side >= 0) return true;
    if ((query_turn(numbers, from, to, s->u) >= 0) == (query_turn(numbers, from, to, s->v) >= 0)) return true;
    return change(q, &q->groups.inside, query_members_flip, s);
}

/* An object as seen from a reference; AREA_BORDER if a way from there can cross it. */
static int see(froe_query *q, const query_areas *areas, uint32_t object, const double *from, query_border *out) {
    const froe_scene *s = q->tree->scene;
    const int role = areas->roles[object];
    if (role != AREA_MEMBER && role != AREA_BORDER) return AREA_NOTHING;
    const double *u = scene_point(s, object, 0), *v = scene_point(s, object, scene_corners(s, object) - 1);
    const int side = role == AREA_BORDER ? query_turn(&q->numbers, u, v, from) : 0;
    memcpy(out->u, side < 0 ? v : u, sizeof out->u);
    memcpy(out->v, side < 0 ? u : v, sizeof out->v);
    out->groups[0] = s->groups[object];
    out->groups[1] = FROE_NONE;
    return side ? AREA_BORDER : AREA_MEMBER;
}

froe_status query_areas_travel(froe_query *q, const query_areas *areas, const double *from, const double *to,
                               froe_diagnostic *diag) {
    const double ends[4] = {from[0], from[1], to[0], to[1]};
    froe_range way = froe_range_defaults();
    way.shape = FROE_SHAPE_SEGMENT;
    way.points = ends;
    const froe_status status = query_range_ask(q, &way, false, diag);
    if (status) return status;
    for (size_t i = 0; i < q->found.count; i++) {
        query_border s;
        const int role = see(q, areas, q->found.data[i], from, &s);
        if (role && !pass_border(q, &s, role == AREA_BORDER, from, to)) return support_fail_memory(diag);
    }
    return FROE_OK;
}

/* ---------------------------------------------------------------- entering -- */

froe_status query_areas_enter(froe_query *q, const query_areas *areas, const query_leaf *leaf, const double *point) {
    const uint32_t slot = areas->slots[leaf->place], number = slot & AREA_NUMBER;
    const query_area_leaf *there =
        slot & (AREA_FAR | AREA_SET) ? NULL : (const query_area_leaf *)(const void *)(areas->leaves.data + number);
    const query_reference *far = slot & AREA_FAR ? areas->references.data + number : NULL;
    const uint32_t set = there ? there->from.set : far ? far->set : number;
    q->groups.from = there ? there->from.at : far ? far->at : NULL;
    if (!query_sets_copy(&areas->sets, &q->alloc, set, &q->groups.inside)) return FROE_E_MEMORY;
    if (far) return query_areas_travel(q, areas, far->at, point, NULL);
    if (there) {
        const query_border *s = (const query_border *)(const void *)(there + 1);
        const uint32_t count = there->borders + there->others;
        const double *from = there->from.at;
        q->stats.tests += count;
        for (uint32_t i = 0; i < count; i++)
            if (bounds_meet(from, point, s[i].u, s[i].v) && !pass_border(q, s + i, i < there->borders, from, point))
                return FROE_E_MEMORY;
    }
    if (!leaf->on_cut) return FROE_OK;
    /* What a point on the border of a cell lies on may be listed elsewhere. Other borders are crossed within the
     * cell. */
    const double ends[4] = {point[0], point[1], point[0], point[1]};
    froe_range range = froe_range_defaults();
    range.points = ends;
    if (query_range_ask(q, &range, false, NULL)) return FROE_E_MEMORY;
    for (size_t i = 0; i < q->found.count; i++) {
        const uint32_t object = q->found.data[i];
        const int role = areas->roles[object];
        if ((role == AREA_MEMBER || role == AREA_BORDER) &&
            !query_members_add(&q->groups.touched, &q->alloc, q->tree->scene->groups[object]))
            return FROE_E_MEMORY;
    }
    return FROE_OK;
}

/* Prefetches all slots first, then the beginnings of all leaves: so no load waits for another. */
void query_areas_ask(const query_areas *areas, const query_leaf *leaves, size_t count) {
    enum { CACHE_LINE = 64, LEAF_BYTES = 384 }; /* bytes */
    for (size_t i = 0; i < count; i++) __builtin_prefetch(areas->slots + leaves[i].place);
    for (size_t i = 0; i < count; i++) {
        const uint32_t slot = areas->slots[leaves[i].place];
        if (slot & (AREA_FAR | AREA_SET)) continue;
        const char *at = (const char *)(areas->leaves.data + slot);
        for (int line = 0; line < LEAF_BYTES; line += CACHE_LINE) __builtin_prefetch(at + line);
    }
}

/* ---------------------------------------------------------------- settling -- */

/** Turns the leaves of a tree, one after the other, into what a query reads. */
typedef struct settling {
    froe_query *q;
    query_areas *areas;
    ARRAY(query_reference) far; /* references still needed, the last of them ... */
    uint32_t last;              /* ... numbered so before */
    ARRAY(query_border) seen;   /* in a leaf */
    ARRAY(uint32_t) order;
} settling;

static int compare_ends(const query_border *a, const query_border *b) {
    const double x[2][4] = {{a->u[0], a->u[1], a->v[0], a->v[1]}, {b->u[0], b->u[1], b->v[0], b->v[1]}};
    for (int k = 0; k < 4; k++)
        if (x[0][k] != x[1][k]) return x[0][k] < x[1][k] ? -1 : 1;
    return 0;
}

static bool comes_later(void *user, uint32_t a, uint32_t b) {
    const query_border *seen = user;
    const int order = compare_ends(seen + a, seen + b);
    return order ? order > 0 : a > b;
}

/* The objects of a list that have a role, seen from the reference of its leaf, in order. */
static bool gather_borders(settling *w, const tree_objects *list, int role, const double *from) {
    query_border s;
    w->seen.count = w->order.count = 0;
    for (uint32_t i = 0; i < list->count; i++) {
        if (see(w->q, w->areas, tree_object(list, i), from, &s) != role) continue;
        if (!array_push(&w->q->alloc, &w->order, (uint32_t)w->seen.count)) return false;
        if (!array_push(&w->q->alloc, &w->seen, s)) return false;
    }
    query_heap_sort(w->order.data, w->order.count, comes_later, w->seen.data);
    return true;
}

/* Appends the gathered borders; two that are equal share one entry. */
static bool append_border(settling *w, uint32_t *count) {
    enum { ENTRY_WORDS = sizeof(query_border) / sizeof(uint64_t) };
    query_border *seen = w->seen.data, *last = NULL;
    if (!array_reserve(&w->q->alloc, &w->areas->leaves, w->order.count * ENTRY_WORDS)) return false;
    *count = 0;
    for (size_t i = 0; i < w->order.count; i++) {
        const query_border *s = seen + w->order.data[i];
        if (last && last->groups[1] == FROE_NONE && compare_ends(last, s) == 0) {
            last->groups[1] = s->groups[0];
            continue;
        }
        last = (query_border *)(void *)(w->areas->leaves.data + w->areas->leaves.count);
        *last = *s;
        w->areas->leaves.count += ENTRY_WORDS;
        ++*count;
    }
    return true;
}

/* The slot of a leaf that has its reference. */
static bool settle_near(settling *w, const tree_objects *list, query_reference from, uint32_t *slot) {
    enum { ENTRY_WORDS = sizeof(query_area_leaf) / sizeof(uint64_t) };
    query_areas *areas = w->areas;
    query_area_leaf leaf = {.from = from};
    const size_t start = areas->leaves.count;
    if (!array_reserve(&w->q->alloc, &areas->leaves, ENTRY_WORDS)) return false;
    areas->leaves.count += ENTRY_WORDS;
    if (!gather_borders(w, list, AREA_BORDER, from.at) || !append_border(w, &leaf.borders)) return false;
    if (!gather_borders(w, list, AREA_MEMBER, from.at) || !append_border(w, &leaf.others)) return false;
    if (leaf.borders + leaf.others == 0) {
        areas->leaves.count = start;
        *slot = from.set | AREA_SET;
        return from.set <= AREA_NUMBER;
    }
    memcpy(areas->leaves.data + start, &leaf, sizeof leaf);
    *slot = (uint32_t)start;
    return start <= AREA_NUMBER;
}

bool query_areas_settle(froe_query *q, query_areas *areas) {
    const froe_allocator *alloc = &q->alloc;
    const froe_tree *t = q->tree;
    settling w = {.q = q, .areas = areas, .last = FROE_NONE};
    bool ok = true;
    for (uint32_t i = 0; i < t->node_count && ok; i++) {
        if (!tree_is_leaf(t->nodes + i)) continue;
        uint32_t *slot = areas->slots + query_leaf_place(t, i);
        const tree_objects list = tree_list(t, i);
        const uint32_t number = *slot & ~AREA_FAR;
        if (number == *slot) {
            ok = settle_near(&w, &list, areas->references.data[number], slot);
            continue;
        }
        ok = number == w.last || array_push(alloc, &w.far, areas->references.data[number]);
        w.last = number;
        *slot = (uint32_t)(w.far.count - 1) | AREA_FAR;
        ok = ok && w.far.count <= AREA_NUMBER; /* one way: so many references take 16 GB */
    }
    array_free(alloc, &areas->references);
    areas->references.data = w.far.data;
    areas->references.count = w.far.count;
    areas->references.capacity = w.far.capacity;
    array_free(alloc, &w.seen);
    array_free(alloc, &w.order);
    return ok;
}
