/* tree.c: nodes, cuts, pieces and counts of a finished tree. */
#include "tree/tree.h"
#include "base/floats.h"
#include "tree/file.h"
#include "tree/gate.h"
#include "tree/list.h"
#include "tree/packed/table.h"
#include "tree/packed/wide.h"
#include "tree/walk.h"
#include <string.h>

static void *take_array(const froe_allocator *alloc, size_t count, size_t item_size) {
    return support_realloc(alloc, NULL, 0, count ? count * item_size : 1);
}
static void give_array(const froe_allocator *alloc, void *array, size_t count, size_t item_size) {
    support_free(alloc, array, count ? count * item_size : 1);
}

froe_status tree_take_arrays(froe_tree *t) {
    t->nodes = take_array(&t->alloc, t->node_count, sizeof *t->nodes);
    t->cuts = take_array(&t->alloc, t->cut_count, sizeof *t->cuts);
    t->pieces = take_array(&t->alloc, t->piece_count, sizeof *t->pieces);
    t->bounds = take_array(&t->alloc, t->bound_count, sizeof *t->bounds);
    t->normals = take_array(&t->alloc, t->normal_count, sizeof *t->normals);
    return t->nodes && t->cuts && t->pieces && t->bounds && t->normals ? FROE_OK : FROE_E_MEMORY;
}

void froe_tree_free(froe_tree *tree) {
    if (!tree) return;
    froe_allocator alloc = tree->alloc;
    tree_spare_free(&alloc, tree->spare);
    tree_gate_free(&alloc, tree->gate);
    tree_table_free(&alloc, tree->packed.table);
    tree_wide_free(&alloc, tree->packed.wide);
    froe_scene_free(tree->scene);
    if (!tree->mapped) {
        give_array(&alloc, tree->nodes, tree->node_count, sizeof *tree->nodes);
        give_array(&alloc, tree->cuts, tree->cut_count, sizeof *tree->cuts);
        give_array(&alloc, tree->pieces, tree->piece_count, sizeof *tree->pieces);
        give_array(&alloc, tree->bounds, tree->bound_count, sizeof *tree->bounds);
        give_array(&alloc, tree->normals, tree->normal_count, sizeof *tree->normals);
        give_array(&alloc, tree->packed.owners, tree->packed.owner_count, sizeof *tree->packed.owners);
        support_free(&alloc, tree->packed.memory, tree->packed.memory_size);
    }
    support_free(&alloc, tree, sizeof *tree);
}

froe_cut tree_cut_view(const tree_node *n, const tree_cut *cuts, const double *normals) {
    froe_cut cut = {.kind = FROE_CUT_NONE};
    if (n->type == TREE_LEAF) return cut;
    if (n->type == TREE_PLAIN) return (froe_cut){.kind = FROE_CUT_AXIS, .axis = n->axis, .value = n->u.value};
    const tree_cut *c = cuts + n->u.cut;
    cut.kind = (froe_cut_kind)c->kind;
    switch (cut.kind) {
    case FROE_CUT_AXIS:
        cut.axis = (int)c->a;
        cut.value = c->u.value;
        break;
    case FROE_CUT_PLANE:
        cut.normal = normals + c->a;
        cut.value = c->u.value;
        break;
    case FROE_CUT_FINE:
        cut.normal = normals + c->a;
        cut.id[0] = c->u.id.b;
        break;
    default:
        cut.id[0] = c->a;
        cut.id[1] = c->u.id.b;
        cut.id[2] = c->u.id.c;
    }
    return cut;
}

froe_cut tree_cut_at(const froe_tree *t, uint32_t node) {
    return tree_cut_view(t->nodes + node, t->cuts, t->normals);
}

geom_plane tree_plane_at(const froe_tree *t, uint32_t node) {
    const tree_node *n = t->nodes + node;
    if (n->type == TREE_PLAIN) return geom_plane_axis(t->scene->dim, n->axis, n->u.value);
    froe_cut cut = tree_cut_at(t, node);
    return scene_cut_plane(t->scene, &cut);
}

/* ------------------------------------------------------------------ report -- */

froe_status tree_facts_of(const froe_tree *t, tree_facts *out) {
    const froe_scene *s = t->scene;
    tree_facts f = {.pieces = t->piece_count};
    tree_walk walk = {.tree = t};
    double depths = 0; /* of all pieces */
    for (int k = 0; s->object_count && k < s->dim; k++) f.lo[k] = s->lo[k], f.hi[k] = s->hi[k];
    while (tree_walk_next(&walk)) {
        const tree_node *n = t->nodes + walk.node;
        const uint32_t count = tree_list(t, walk.node).count, covers = tree_covers(t, n);
        const uint32_t depth = tree_walk_depth(&walk);
        depths += (double)depth * (double)count;
        f.covers += covers;
        if (!tree_is_leaf(n)) {
            f.in_cut += count - covers;
            continue;
        }
        f.leaves++;
        if (depth > f.height) f.height = depth;
        if (count > f.max_leaf) f.max_leaf = count;
        if (n->flags & TREE_INSEPARABLE) f.inseparable++;
        if (n->flags & TREE_CROWDED) f.crowded++;
    }
    f.mean_depth = f.pieces ? depths / (double)f.pieces : 0;
    *out = f;
    return tree_walk_end(&walk);
}

/* Of what is there to be searched, without the scene. */
static uint64_t bytes_of(const froe_tree *t) {
    uint64_t bytes = tree_table_bytes(t) + tree_wide_bytes(t->packed.wide);
    for (int id = FILE_NODES; id < FILE_END; id++) {
        const void *data;
        uint64_t size;
        if (file_is_of_tree((file_id)id)) file_part(t, (file_id)id, &data, &size), bytes += size;
    }
    return bytes;
}

froe_status tree_show(froe_tree *t) {
    const tree_facts *f = &t->facts;
    froe_report r = {.method = t->meta.method, .settings = t->meta.settings, .dim = t->scene->dim};
    r.leaf = t->meta.leaf;
    r.seed = t->meta.seed;
    r.objects = t->scene->object_count;
    r.nodes = t->node_count;
    r.leaves = f->leaves;
    r.fragments = f->pieces;
    r.in_cut = f->in_cut;
    r.covers = f->covers;
    r.size = r.nodes + r.fragments;
    r.height = f->height;
    r.mean_depth = f->mean_depth;
    r.max_leaf = f->max_leaf;
    r.inseparable = f->inseparable;
    r.crowded = f->crowded;
    r.bytes = bytes_of(t);
    r.predicates = t->predicates;
    r.promises = t->promises;
    for (uint32_t i = 0; i < t->meta.promise_count; i++) {
        const tree_promise *p = t->meta.promises + i;
        t->promises[i] = (froe_promise){p->name, p->promised, p->measured};
    }
    t->promises[t->meta.promise_count] = (froe_promise){0};
    t->report = r;
    return tree_spare_new(&t->alloc, &t->spare);
}

froe_status tree_finish(froe_tree *t) {
    froe_status status = tree_facts_of(t, &t->facts);
    if (!status) status = tree_table_new(t, &t->packed.table);
    if (!status) status = tree_wide_new(t, &t->packed.wide);
    t->packed.cells = tree_table_shape(t);
    if (!status && t->packed.wide) t->facts.levels = t->packed.wide->levels;
    return status ? status : tree_show(t);
}

froe_report froe_tree_report(const froe_tree *tree) {
    return tree->report;
}

const froe_scene *froe_tree_scene(const froe_tree *tree) {
    return tree->scene;
}

/* --------------------------------------------------------------- structure -- */

froe_node froe_tree_root(const froe_tree *tree) {
    (void)tree;
    return (froe_node){1};
}

froe_node_info froe_tree_node(const froe_tree *tree, froe_node node) {
    BASE_FLOATS_OWN;
    froe_node_info info = {0};
    uint32_t id = node.id1 - 1;
    if (id >= tree->node_count || tree_settle(tree, NULL)) return info;
    const tree_node *n = tree->nodes + id;
    info.cut = tree_cut_at(tree, id);
    if (info.cut.kind == FROE_CUT_VERTEX || info.cut.kind == FROE_CUT_CROSSING)
        info.cut.value = tree_plane_at(tree, id).c;
    if (info.cut.kind == FROE_CUT_FINE) info.cut.value = info.cut.normal[tree->scene->dim];
    tree_objects list = tree_list(tree, id);
    info.first_piece = list.first;
    info.piece_count = list.count;
    info.cover_count = tree_covers(tree, n);
    info.guard = n->flags & TREE_GUARD;
    info.inseparable = n->flags & TREE_INSEPARABLE;
    info.crowded = n->flags & TREE_CROWDED;
    if (!tree_is_leaf(n)) {
        info.child[0].id1 = n->child + 1;
        info.child[1].id1 = n->child + 2;
    }
    return info;
}

static uint32_t piece_corners(const froe_scene *s, uint32_t object) {
    return scene_form(s, object) == FROE_BALL ? 1 : scene_corners(s, object);
}

size_t froe_tree_piece_count(const froe_tree *tree) {
    return tree->piece_count;
}

froe_piece froe_tree_piece(const froe_tree *tree, size_t piece) {
    if (piece >= tree->piece_count || tree_settle(tree, NULL)) return (froe_piece){.object = FROE_NONE};
    if (tree_is_space(tree)) { /* nothing is cut there */
        tree_objects list = tree_list(tree, packed_leaf(tree, (uint32_t)piece));
        uint32_t object = tree_object(&list, (uint32_t)piece - list.first);
        return (froe_piece){object, true, piece_corners(tree->scene, object)};
    }
    if (tree_is_packed(tree)) { /* a fragment of a segment has two corners, as the segment has */
        uint32_t id = packed_id(tree, (uint32_t)piece), object = id & PACKED_OBJECT;
        return (froe_piece){object, packed_is_whole(id), scene_corners(tree->scene, object)};
    }
    const tree_piece *p = tree->pieces + piece;
    froe_piece out = {.object = p->object, .whole = !p->ring};
    if (p->ring)
        out.corners = tree->bounds[p->ring];
    else
        out.corners = piece_corners(tree->scene, p->object);
    return out;
}
