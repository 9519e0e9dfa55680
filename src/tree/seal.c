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

/* Copies a list; *first becomes its new place. */
static void copy_list(seal *s, uint32_t source, uint32_t *first, uint32_t count) {
    const tree_draft *draft = source_of(s, source);
    const tree_piece *from = draft->pieces.data + *first;
    tree_piece *to = s->tree->pieces + s->pieces;
    *first = s->pieces;
    for (uint32_t i = 0; i < count; i++) {
        to[i] = (tree_piece){from[i].object, from[i].ring ? s->bounds : 0};
        if (!from[i].ring) continue;
        const uint32_t *ring = draft->bounds.data + from[i].ring, length = *ring;
        uint32_t *copy = s->tree->bounds + s->bounds;
        copy[0] = length;
        for (uint32_t k = 1; k <= length; k++) {
            uint32_t node = ring[k] & ~TREE_EDGE_CUT;
            copy[k] = ring[k];
            if (ring[k] & TREE_EDGE_CUT)
                copy[k] =
                    TREE_EDGE_CUT | (node < draft->outer ? s->maps[0][node] : s->maps[source][node - draft->outer]);
        }
        s->bounds += length + 1;
    }
    s->pieces += count;
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
        if (node.type == TREE_TABLED) {
            const tree_draft *draft = source_of(s, visit->source);
            tree_cut *cut = s->tree->cuts + s->cuts;
            *cut = draft->cuts.data[node.u.cut];
            node.u.cut = s->cuts++;
            const size_t normals = tree_cut_normals(cut, draft->dim);
            if (normals) {
                memcpy(s->tree->normals + s->normals, draft->normals.data + cut->a, normals * sizeof(double));
                cut->a = s->normals;
                s->normals += (uint32_t)normals;
            }
            copy_list(s, visit->source, &cut->first, cut->count);
        }
        node.child = s->nodes;
        s->nodes += 2;
    }
    s->tree->nodes[visit->to] = node;
    visit->to = node.child;
    return node.type != TREE_LEAF;
}

/* Takes arrays of exactly the needed size, and a map per draft, all zero; grafted leaves know their graft. */
static froe_status take_memory(seal *s) {
    froe_tree *t = s->tree;
    const froe_allocator *alloc = &t->alloc;
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
    /* one way: so many take 16 GB */
    if (nodes > TREE_MOST || pieces > TREE_MOST || bounds > UINT32_MAX || normals > UINT32_MAX) return FROE_E_LIMIT;
    t->node_count = (uint32_t)nodes;
    t->cut_count = (uint32_t)cuts;
    t->piece_count = (uint32_t)pieces;
    t->bound_count = (uint32_t)bounds;
    t->normal_count = (uint32_t)normals;
    froe_status status = tree_take_arrays(t);
    if (status) return status;
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

static void copy_text(char *to, const char *from, size_t size) {
    memcpy(to, from, strnlen(from, size - 1));
}

froe_status draft_shell(const froe_allocator *alloc, froe_scene *scene, const tree_meta *meta, froe_tree **out) {
    froe_tree *t = support_calloc(alloc, 1, sizeof *t);
    if (!t) return FROE_E_MEMORY;
    t->alloc = *alloc;
    t->scene = scene;
    /* a copy without what may stand behind the ends of strings and lists: equal trees make equal files */
    tree_meta *to = &t->meta;
    copy_text(to->method, meta->method, sizeof to->method);
    copy_text(to->settings, meta->settings, sizeof to->settings);
    to->seed = meta->seed;
    to->leaf = meta->leaf;
    to->promise_count = meta->promise_count;
    for (uint32_t i = 0; i < meta->promise_count; i++) {
        copy_text(to->promises[i].name, meta->promises[i].name, sizeof to->promises[i].name);
        to->promises[i].promised = meta->promises[i].promised;
        to->promises[i].measured = meta->promises[i].measured;
    }
    memcpy(to->root_lo, meta->root_lo, (size_t)scene->dim * sizeof *to->root_lo);
    memcpy(to->root_hi, meta->root_hi, (size_t)scene->dim * sizeof *to->root_hi);
    scene_hold(scene);
    *out = t;
    return FROE_OK;
}

/* Gives the array of a draft to the tree, in exactly the needed size. */
#define SEAL_HAND_OVER(array, number)                                                                                  \
    do {                                                                                                               \
        const size_t size = sizeof *draft->array.data, count = draft->array.count;                                     \
        void *exact =                                                                                                  \
            support_realloc(&t->alloc, draft->array.data, draft->array.capacity * size, count ? count * size : 1);     \
        if (exact) {                                                                                                   \
            t->array = exact;                                                                                          \
            t->number = (uint32_t)count;                                                                               \
            draft->array.data = NULL;                                                                                  \
            draft->array.count = draft->array.capacity = 0;                                                            \
        } else {                                                                                                       \
            status = FROE_E_MEMORY;                                                                                    \
        }                                                                                                              \
    } while (0)

froe_status draft_seal_ordered(tree_draft *draft, froe_scene *scene, const tree_meta *meta, froe_tree **out) {
    froe_tree *t = NULL;
    froe_status status = draft_shell(&draft->alloc, scene, meta, &t);
    if (status) return status;
    SEAL_HAND_OVER(nodes, node_count);
    SEAL_HAND_OVER(cuts, cut_count);
    SEAL_HAND_OVER(pieces, piece_count);
    SEAL_HAND_OVER(bounds, bound_count);
    SEAL_HAND_OVER(normals, normal_count);
    t->predicates = draft->predicates;
    if (!status) status = tree_finish(t);
    if (!status) status = tree_fill_promises(t);
    if (status)
        froe_tree_free(t);
    else
        *out = t;
    return status;
}

froe_status draft_seal(const tree_draft *main, const tree_graft *grafts, size_t graft_count, froe_scene *scene,
                       const tree_meta *meta, froe_tree **out) {
    seal s = {.main = main, .grafts = grafts, .graft_count = graft_count};
    froe_status status = draft_shell(&main->alloc, scene, meta, &s.tree);
    if (!status) status = take_memory(&s);
    if (!status) {
        s.nodes = s.bounds = 1;
        s.tree->bounds[0] = 0;
        if (!array_push(&main->alloc, &s.stack, (seal_visit){0, 0, 0})) status = FROE_E_MEMORY;
    }
    while (!status && s.stack.count) {
        seal_visit at = s.stack.data[--s.stack.count];
        while (!status && place_node(&s, &at)) {
            seal_visit right = {at.source, at.from + 1, at.to + 1};
            if (!array_push(&main->alloc, &s.stack, right)) status = FROE_E_MEMORY;
        }
    }
    if (!status) {
        s.tree->predicates = main->predicates;
        for (size_t i = 0; i < graft_count; i++) num_stats_add(&s.tree->predicates, &grafts[i].draft->predicates);
        status = tree_finish(s.tree);
    }
    if (!status) status = tree_fill_promises(s.tree);
    for (uint32_t i = 0; i < s.map_count; i++)
        support_free(&main->alloc, s.maps[i], source_of(&s, i)->nodes.count * sizeof(uint32_t));
    support_free(&main->alloc, s.maps, s.map_count * sizeof *s.maps);
    array_free(&main->alloc, &s.stack);
    if (status)
        froe_tree_free(s.tree);
    else
        *out = s.tree;
    return status;
}
