/* seal.c: drafts become the final arrays, in one depth-first walk.
 *
 *     draft, builder's order           sealed, depth-first
 *     0 | 1 2 | 3 4 (of 2) | 5 6 (of 1)   ->   0 | 1 2 | 3 4 (of 1) | 5 6 (of 2)
 *
 * Children get the next free pair when their parent is visited, and everything a node
 * owns (cut, normal, list, rings) the next free places of its array. So arrays are
 * packed, the lists of a subtree are one slice, and the result depends on the shape of
 * the tree alone. An ancestor is numbered before the rings that name it are copied. */
#include "tree/draft.h"
#include <string.h>

#define SEAL_MOST 0x7ffffffeu

typedef struct seal_visit {
    uint32_t source, from, to; /* draft; node in it; node in the tree */
} seal_visit;

typedef struct seal {
    const tree_draft *main;
    const tree_graft *grafts;
    size_t graft_count;
    uint32_t **maps; /* per source: draft node -> tree node; an unvisited leaf of the main draft: its graft + 1 */
    size_t map_count;
    froe_tree *tree;
    uint32_t nodes, cuts, pieces, bounds, normals; /* filled so far */
    ARRAY(seal_visit) stack;
} seal;

static const tree_draft *source_of(const seal *s, uint32_t source) {
    return source ? s->grafts[source - 1].draft : s->main;
}

static uint32_t translate(const seal *s, uint32_t source, uint32_t outer, uint32_t edge) {
    uint32_t node = edge & ~TREE_EDGE_CUT;
    if (!(edge & TREE_EDGE_CUT)) return edge;
    return TREE_EDGE_CUT | (node < outer ? s->maps[0][node] : s->maps[source][node - outer]);
}

static void copy_ring(seal *s, uint32_t source, const tree_draft *draft, uint32_t ring) {
    const uint32_t *from = draft->bounds.data + ring;
    uint32_t *to = s->tree->bounds + s->bounds, count = *from;
    *to = count;
    for (uint32_t i = 1; i <= count; i++) to[i] = translate(s, source, draft->outer, from[i]);
    s->bounds += count + 1;
}

/* Copies a list; *first becomes its new place. */
static void copy_list(seal *s, uint32_t source, uint32_t *first, uint32_t count) {
    const tree_draft *draft = source_of(s, source);
    const tree_piece *from = draft->pieces.data + *first;
    tree_piece *to = s->tree->pieces + s->pieces;
    *first = s->pieces;
    for (uint32_t i = 0; i < count; i++) {
        to[i] = (tree_piece){from[i].object, from[i].ring ? s->bounds : 0};
        if (from[i].ring) copy_ring(s, source, draft, from[i].ring);
    }
    s->pieces += count;
}

static void copy_cut(seal *s, uint32_t source, uint32_t *index) {
    const tree_draft *draft = source_of(s, source);
    tree_cut *cut = s->tree->cuts + s->cuts;
    *cut = draft->cuts.data[*index];
    *index = s->cuts++;
    if (cut->kind == FROE_CUT_PLANE) {
        size_t dim = (size_t)draft->dim;
        memcpy(s->tree->normals + s->normals, draft->normals.data + cut->a, dim * sizeof(double));
        cut->a = s->normals;
        s->normals += (uint32_t)dim;
    }
    copy_list(s, source, &cut->first, cut->count);
}

/* Places one node with all it owns; true when its children, a fresh pair, come next. */
static bool place_node(seal *s, seal_visit *visit) {
    tree_node node;
    if (visit->source == 0 && s->maps[0][visit->from]) { /* grafted: the walk goes on in the other draft */
        uint32_t source = s->maps[0][visit->from];
        s->maps[0][visit->from] = visit->to;
        *visit = (seal_visit){source, 0, visit->to};
    }
    s->maps[visit->source][visit->from] = visit->to;
    node = source_of(s, visit->source)->nodes.data[visit->from];
    visit->from = node.child;
    if (node.type == TREE_LEAF) {
        copy_list(s, visit->source, &node.u.list.first, node.u.list.count);
    } else {
        if (node.type == TREE_TABLED) copy_cut(s, visit->source, &node.u.cut);
        node.child = s->nodes;
        s->nodes += 2;
    }
    s->tree->nodes[visit->to] = node;
    visit->to = node.child;
    return node.type != TREE_LEAF;
}

static froe_status walk_draft(seal *s) {
    const froe_allocator *alloc = &s->tree->alloc;
    s->nodes = s->bounds = 1;
    s->tree->bounds[0] = 0;
    if (!array_push(alloc, &s->stack, (seal_visit){0, 0, 0})) return FROE_E_MEMORY;
    while (s->stack.count) {
        seal_visit at = s->stack.data[--s->stack.count];
        while (place_node(s, &at)) {
            seal_visit right = {at.source, at.from + 1, at.to + 1};
            if (!array_push(alloc, &s->stack, right)) return FROE_E_MEMORY;
        }
    }
    return FROE_OK;
}

/* Takes arrays of exactly the needed size. */
static froe_status take_arrays(seal *s) {
    froe_tree *t = s->tree;
    size_t nodes = s->main->nodes.count - s->graft_count, cuts = s->main->cuts.count, pieces = s->main->pieces.count;
    size_t bounds = s->main->bounds.count, normals = s->main->normals.count;
    for (size_t i = 0; i < s->graft_count; i++) {
        const tree_draft *draft = s->grafts[i].draft;
        nodes += draft->nodes.count;
        cuts += draft->cuts.count;
        pieces += draft->pieces.count;
        bounds += draft->bounds.count - 1;
        normals += draft->normals.count;
    }
    if (nodes > SEAL_MOST || pieces > SEAL_MOST || bounds > UINT32_MAX || normals > UINT32_MAX) return FROE_E_LIMIT;
    t->node_count = (uint32_t)nodes;
    t->cut_count = (uint32_t)cuts;
    t->piece_count = (uint32_t)pieces;
    t->bound_count = (uint32_t)bounds;
    t->normal_count = (uint32_t)normals;
    return tree_take_arrays(t);
}

/* One map per draft, all zero; grafted leaves know their graft. */
static froe_status take_maps(seal *s) {
    const froe_allocator *alloc = &s->tree->alloc;
    s->maps = support_calloc(alloc, s->graft_count + 1, sizeof *s->maps);
    if (!s->maps) return FROE_E_MEMORY;
    s->map_count = s->graft_count + 1;
    for (uint32_t i = 0; i < s->map_count; i++) {
        s->maps[i] = support_calloc(alloc, source_of(s, i)->nodes.count, sizeof(uint32_t));
        if (!s->maps[i]) return FROE_E_MEMORY;
    }
    for (uint32_t i = 0; i < s->graft_count; i++) s->maps[0][s->grafts[i].node] = i + 1;
    return FROE_OK;
}

static void free_scratch(seal *s) {
    const froe_allocator *alloc = &s->main->alloc;
    for (uint32_t i = 0; i < s->map_count; i++)
        support_free(alloc, s->maps[i], source_of(s, i)->nodes.count * sizeof(uint32_t));
    support_free(alloc, s->maps, s->map_count * sizeof *s->maps);
    array_free(alloc, &s->stack);
}

static froe_status fill_tree(seal *s) {
    froe_status status = take_arrays(s);
    if (!status) status = take_maps(s);
    if (!status) status = walk_draft(s);
    if (status) return status;
    s->tree->predicates = s->main->predicates;
    for (size_t i = 0; i < s->graft_count; i++) num_stats_add(&s->tree->predicates, &s->grafts[i].draft->predicates);
    status = tree_finish(s->tree);
    return status ? status : tree_fill_promises(s->tree);
}

static void copy_text(char *to, const char *from, size_t size) {
    memcpy(to, from, strnlen(from, size - 1));
}

/* A copy without what may stand behind the ends of strings and lists: equal trees make equal files. */
static void copy_meta(const tree_meta *from, size_t dim, tree_meta *to) {
    copy_text(to->method, from->method, sizeof to->method);
    copy_text(to->settings, from->settings, sizeof to->settings);
    to->seed = from->seed;
    to->leaf = from->leaf;
    to->promise_count = from->promise_count;
    for (uint32_t i = 0; i < from->promise_count; i++) {
        copy_text(to->promises[i].name, from->promises[i].name, sizeof to->promises[i].name);
        to->promises[i].promised = from->promises[i].promised;
        to->promises[i].measured = from->promises[i].measured;
    }
    memcpy(to->root_lo, from->root_lo, dim * sizeof *to->root_lo);
    memcpy(to->root_hi, from->root_hi, dim * sizeof *to->root_hi);
}

froe_status draft_shell(const froe_allocator *alloc, froe_scene *scene, const tree_meta *meta, froe_tree **out) {
    froe_tree *t = support_calloc(alloc, 1, sizeof *t);
    if (!t) return FROE_E_MEMORY;
    t->alloc = *alloc;
    t->scene = scene;
    copy_meta(meta, (size_t)scene->dim, &t->meta);
    scene_hold(scene);
    *out = t;
    return FROE_OK;
}

froe_status draft_seal(const tree_draft *main, const tree_graft *grafts, size_t graft_count, froe_scene *scene,
                       const tree_meta *meta, froe_tree **out) {
    seal s = {.main = main, .grafts = grafts, .graft_count = graft_count};
    froe_status status = draft_shell(&main->alloc, scene, meta, &s.tree);
    if (!status) status = fill_tree(&s);
    free_scratch(&s);
    if (status)
        froe_tree_free(s.tree);
    else
        *out = s.tree;
    return status;
}
