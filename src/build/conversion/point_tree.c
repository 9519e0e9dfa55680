/* point_tree.c: the lowest containing nodes of endpoints, and where cuts end on others. */
#include "build/conversion/point_tree.h"
#include "base/radix.h"
#include "geom/predicates.h"
#include <string.h>

froe_status point_tree_new(const froe_allocator *alloc, const froe_scene *scene, point_tree *out) {
    *out = (point_tree){.alloc = *alloc, .scene = scene};
    point_node root = {.cut = {.kind = FROE_CUT_NONE}};
    return array_push(alloc, &out->nodes, root) ? FROE_OK : FROE_E_MEMORY;
}

void point_tree_free(point_tree *t) {
    size_t vertices = t->scene->vertex_count, nodes = t->nodes.count;
    support_free(&t->alloc, t->locations, vertices ? vertices * sizeof *t->locations : 1);
    support_free(&t->alloc, t->starts, (2 * nodes + 1) * sizeof *t->starts);
    array_free(&t->alloc, &t->junctions);
    array_free(&t->alloc, &t->nodes);
}

froe_status point_tree_split(point_tree *t, uint32_t node, const froe_cut *cut, uint32_t *child) {
    point_node leaf = {.cut = {.kind = FROE_CUT_NONE}};
    if (t->nodes.count + 2 > INT32_MAX) return FROE_E_LIMIT;
    if (!array_reserve(&t->alloc, &t->nodes, 2)) return FROE_E_MEMORY;
    *child = (uint32_t)t->nodes.count;
    t->nodes.data[t->nodes.count++] = leaf;
    t->nodes.data[t->nodes.count++] = leaf;
    t->nodes.data[node].cut = *cut;
    t->nodes.data[node].child = *child;
    return FROE_OK;
}

static bool is_leaf(const point_node *node) {
    return node->cut.kind == FROE_CUT_NONE;
}

/* -------------------------------------------------- lowest containing nodes -- */

typedef struct walk_step {
    uint32_t node, depth;
    bool left; /**< its children have been walked */
} walk_step;

static froe_status locate_endpoints(point_tree *t, num_context *context) {
    const froe_scene *s = t->scene;
    t->locations = support_calloc(&t->alloc, s->vertex_count, sizeof *t->locations);
    if (!t->locations) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < s->vertex_count; i++) t->locations[i] = FROE_NONE;
    for (uint32_t i = 0; i < s->object_count; i++)
        for (uint32_t j = 0; j < scene_corners(s, i); j++) {
            uint32_t vertex = scene_corner(s, i, j), node = 0;
            if (t->locations[vertex] != FROE_NONE) continue;
            while (!is_leaf(t->nodes.data + node)) {
                const point_node *n = t->nodes.data + node;
                geom_plane plane = scene_cut_plane(s, &n->cut);
                int side = geom_side_vertex(context, &plane, scene_vertex(s, vertex));
                if (!side) break;
                node = n->child + (side > 0);
            }
            t->locations[vertex] = t->nodes.data[node].enter;
        }
    return FROE_OK;
}

/* --------------------------------------------------------------- junctions -- */

/** The end of a cut at another: the latter's node and side, 2 v + s, and where. */
typedef struct junction {
    uint32_t on;
    double at;
} junction;

typedef ARRAY(junction) junction_list;

typedef struct region_step {
    uint32_t node, count; /**< corners of its region, on top of all others when its turn comes */
} region_step;

typedef struct region_walk {
    point_tree *tree;
    ARRAY(region_step) steps;
    ARRAY(region_corner) corners;
    junction_list found;
} region_walk;

static bool push_region(region_walk *w, uint32_t node, const region *r) {
    if (!array_reserve(&w->tree->alloc, &w->corners, r->count)) return false;
    if (r->count) memcpy(w->corners.data + w->corners.count, r->corner, r->count * sizeof *r->corner);
    w->corners.count += r->count;
    return array_push(&w->tree->alloc, &w->steps, (region_step){node, r->count});
}

/** Regions of nodes from above; unknown ones have no junctions. */
static bool do_region(region_walk *w, region_step step) {
    const point_node *n = w->tree->nodes.data + step.node;
    region r = {.count = step.count}, part;
    w->corners.count -= step.count;
    if (r.count) memcpy(r.corner, w->corners.data + w->corners.count, r.count * sizeof *r.corner);
    if (is_leaf(n)) return true;
    geom_plane line = scene_cut_plane(w->tree->scene, &n->cut);
    region_corner end[2];
    bool ok = true, met = region_section(&r, &line, end);
    for (int i = 0; i < 2 && met && ok; i++) {
        if (end[i].side == FROE_NONE) continue;
        geom_plane on = scene_cut_plane(w->tree->scene, &w->tree->nodes.data[end[i].side / 2].cut);
        junction j = {end[i].side, end[i].x[region_along(&on)]};
        ok = array_push(&w->tree->alloc, &w->found, j);
    }
    for (int s = 1; s >= 0 && ok; s--) {
        region_clip(&r, &line, s ? 1 : -1, 2 * step.node + (uint32_t)s, &part);
        ok = push_region(w, n->child + (uint32_t)s, &part);
    }
    return ok;
}

/** By node and side, and along each. */
static froe_status sort_junctions(point_tree *t, const junction_list *found) {
    size_t count = found->count;
    base_pair *pairs = support_calloc(&t->alloc, 2 * count, sizeof *pairs);
    bool ok = pairs && array_reserve(&t->alloc, &t->junctions, count);
    for (size_t i = 0; i < count && ok; i++) pairs[i] = (base_pair){base_double_key(found->data[i].at), (uint32_t)i};
    if (ok) base_radix_sort(pairs, pairs + count, count);
    for (size_t i = 0; i < count && ok; i++) pairs[i].key = found->data[pairs[i].value].on;
    if (ok) base_radix_sort(pairs, pairs + count, count);
    for (size_t i = 0; i < count && ok; i++) {
        t->junctions.data[t->junctions.count++] = found->data[pairs[i].value].at;
        t->starts[pairs[i].key + 1]++;
    }
    for (size_t i = 0; i < 2 * t->nodes.count && ok; i++) t->starts[i + 1] += t->starts[i];
    support_free(&t->alloc, pairs, count ? 2 * count * sizeof *pairs : 1);
    return ok ? FROE_OK : FROE_E_MEMORY;
}

froe_status point_tree_finish(point_tree *t, num_context *context) {
    /* times of entering and leaving, in depth-first order */
    ARRAY(walk_step) stack = {0};
    uint32_t time = 0;
    bool room = array_push(&t->alloc, &stack, (walk_step){0, 0, false});
    while (stack.count && room) {
        walk_step s = stack.data[--stack.count];
        point_node *n = t->nodes.data + s.node;
        if (s.left) {
            n->leave = time;
            continue;
        }
        n->enter = time++;
        n->leave = time;
        t->height = s.depth > t->height ? s.depth : t->height;
        if (is_leaf(n)) continue;
        room = array_push(&t->alloc, &stack, (walk_step){s.node, s.depth, true}) &&
               array_push(&t->alloc, &stack, (walk_step){n->child + 1, s.depth + 1, false}) &&
               array_push(&t->alloc, &stack, (walk_step){n->child, s.depth + 1, false});
    }
    array_free(&t->alloc, &stack);
    froe_status status = room ? FROE_OK : FROE_E_MEMORY;
    if (!status) status = locate_endpoints(t, context);
    if (status) return status;
    region_walk w = {.tree = t};
    region root = {.count = 0};
    t->starts = support_calloc(&t->alloc, 2 * t->nodes.count + 1, sizeof *t->starts);
    if (t->scene->object_count) region_around(t->scene->lo, t->scene->hi, FROE_NONE, &root);
    bool ok = t->starts && push_region(&w, 0, &root);
    while (w.steps.count && ok) ok = do_region(&w, w.steps.data[--w.steps.count]);
    status = ok ? sort_junctions(t, &w.found) : FROE_E_MEMORY;
    array_free(&t->alloc, &w.steps);
    array_free(&t->alloc, &w.corners);
    array_free(&t->alloc, &w.found);
    return status;
}

bool point_tree_junction(const point_tree *t, uint32_t node, int side, double from, double to) {
    uint32_t low = t->starts[2 * node + (uint32_t)side], end = t->starts[2 * node + (uint32_t)side + 1], high = end;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (t->junctions.data[middle] > from)
            high = middle;
        else
            low = middle + 1;
    }
    return low < end && t->junctions.data[low] < to;
}
