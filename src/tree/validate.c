/* validate.c: structure and indices of a tree, before they are used.
 *
 * The arrays of a sealed tree are packed in depth-first order (tree.h). So one walk that counts
 * what it has seen knows where the next pair, cut, normal, list and ring must begin; comparing
 * with that excludes cycles, sharing, gaps and overlaps at once, and each index is checked
 * where it stands. The audit checks what the pieces mean. */
#include "tree/validate.h"
#include "geom/selftest.h"
#include "support/fail.h"
#include "tree/packed/packed.h"
#include "tree/walk.h"
#include <math.h>

typedef struct check {
    const froe_tree *tree;
    tree_walk walk;
    num_context context;
    uint32_t nodes, cuts, pieces, bounds, normals; /* seen so far */
    froe_diagnostic *diag;
} check;

static froe_status bad_node(const check *c, const char *what) {
    return support_fail(c->diag, FROE_E_FORMAT, "the tree is corrupted: %s, node %u", what, c->walk.node);
}

static froe_status bad_piece(const check *c, uint32_t object, const char *what) {
    return support_fail_at(c->diag, FROE_E_FORMAT, object < c->tree->scene->object_count ? object : FROE_NONE,
                           FROE_NONE, FROE_NONE, "the tree is corrupted: %s, node %u, object %u", what, c->walk.node,
                           object);
}

/* -------------------------------------------------------------------- cuts -- */

static bool finite_root(const froe_tree *t, const double *x) {
    for (int k = 0; k < FROE_MAX_DIM; k++)
        if (!isfinite(x[k]) || (k >= t->scene->dim && x[k] != 0)) return false;
    return true;
}

/* What a CROSSING may name: segments in the plane, edges in space. */
static bool is_edge(const froe_scene *s, uint32_t id) {
    uint32_t vertices[2];
    if (s->dim == 2) return id < s->object_count && scene_form(s, id) == FROE_SEGMENT;
    return froe_scene_edge(s, id, vertices);
}

static bool cut_ids_exist(const froe_scene *s, const tree_cut *cut) {
    bool space = s->dim == 3, b_free = cut->u.id.b == 0, c_free = cut->u.id.c == 0;
    uint32_t vertices = s->vertex_count;
    switch (cut->kind) {
    case FROE_CUT_OBJECT:
        return cut->a < s->object_count && scene_form(s, cut->a) == (space ? FROE_POLYGON : FROE_SEGMENT) && b_free &&
               c_free;
    case FROE_CUT_VERTICES:
        return cut->a < vertices && cut->u.id.b < vertices && (space ? cut->u.id.c < vertices : c_free);
    case FROE_CUT_EDGE:
        return space && cut->a < vertices && cut->u.id.b < vertices && c_free;
    case FROE_CUT_VERTEX:
        return cut->a < vertices && b_free && c_free;
    default:
        return is_edge(s, cut->a) && is_edge(s, cut->u.id.b) && c_free;
    }
}

/* Kind, indices and numbers of a tabled cut; a plane must have a normal. */
static bool cut_fits(check *c, const tree_cut *cut) {
    const froe_tree *t = c->tree;
    int dim = t->scene->dim;
    if (cut->kind == FROE_CUT_AXIS) return cut->a < (uint32_t)dim && isfinite(cut->u.value);
    if (dim > 3) return false;
    if (cut->kind == FROE_CUT_PLANE) {
        if (cut->a != c->normals || t->normal_count - c->normals < (uint32_t)dim) return false;
        for (int k = 0; k < dim; k++)
            if (!isfinite(t->normals[cut->a + (uint32_t)k])) return false;
        if (!isfinite(cut->u.value)) return false;
        c->normals += (uint32_t)dim;
    } else if (cut->kind < FROE_CUT_OBJECT || cut->kind >= FROE_CUT_KIND_COUNT || !cut_ids_exist(t->scene, cut)) {
        return false;
    }
    geom_plane plane = tree_plane_at(t, c->walk.node);
    return geom_plane_valid(&c->context, &plane);
}

/* ------------------------------------------------------------------- lists -- */

static bool edge_fits(const check *c, uint32_t object, uint32_t i, uint32_t edge) {
    if (edge & TREE_EDGE_CUT) return tree_walk_above(&c->walk, edge & ~TREE_EDGE_CUT);
    bool segment = scene_form(c->tree->scene, object) == FROE_SEGMENT;
    return segment ? edge == i : edge < scene_corners(c->tree->scene, object);
}

static froe_status check_ring(check *c, const tree_piece *piece) {
    const froe_tree *t = c->tree;
    froe_kind form = scene_form(t->scene, piece->object);
    if (form != FROE_SEGMENT && form != FROE_POLYGON) return bad_piece(c, piece->object, "a kind that is never cut");
    if (piece->ring != c->bounds || c->bounds >= t->bound_count)
        return bad_piece(c, piece->object, "a ring out of place");
    uint32_t count = t->bounds[piece->ring], most = t->bound_count - c->bounds - 1;
    if (count > most || (form == FROE_SEGMENT ? count != 2 : count < 3))
        return bad_piece(c, piece->object, "a ring of wrong length");
    for (uint32_t i = 0; i < count; i++)
        if (!edge_fits(c, piece->object, i, t->bounds[piece->ring + 1 + i]))
            return bad_piece(c, piece->object, "a ring entry that is no edge and no ancestor");
    c->bounds += count + 1;
    return FROE_OK;
}

static froe_status check_list(check *c, uint32_t first, uint32_t count) {
    const froe_tree *t = c->tree;
    froe_status status = FROE_OK;
    if (first != c->pieces || count > t->piece_count - c->pieces) return bad_node(c, "a list out of place");
    for (uint32_t i = first; !status && !tree_is_packed(t) && i < first + count; i++) {
        const tree_piece *piece = t->pieces + i;
        if (piece->object >= t->scene->object_count)
            return bad_piece(c, piece->object, "an object that does not exist");
        if (piece->ring) status = check_ring(c, piece);
    }
    c->pieces += count;
    return status;
}

/* ------------------------------------------------------------------- nodes -- */

static froe_status check_leaf(check *c, const tree_node *n) {
    if ((n->child && !tree_is_packed(c->tree)) || n->axis) return bad_node(c, "an unused field that is not 0");
    return check_list(c, n->u.list.first, n->u.list.count);
}

static froe_status check_inner(check *c, const tree_node *n) {
    const froe_tree *t = c->tree;
    if (n->flags & (TREE_INSEPARABLE | TREE_CROWDED)) return bad_node(c, "an unknown flag");
    if (n->child != c->nodes || t->node_count - c->nodes < 2) return bad_node(c, "children out of place");
    c->nodes += 2;
    if (n->type == TREE_PLAIN) {
        bool fits = n->axis < t->scene->dim && isfinite(n->u.value);
        return fits ? FROE_OK : bad_node(c, "a cut that does not exist");
    }
    if (n->axis || n->u.list.count) return bad_node(c, "an unused field that is not 0");
    if (n->u.cut != c->cuts || c->cuts >= t->cut_count) return bad_node(c, "a cut out of place");
    const tree_cut *cut = t->cuts + c->cuts++;
    if (!cut_fits(c, cut)) return bad_node(c, "a cut that does not exist");
    return check_list(c, cut->first, cut->count);
}

static int known_flags(const froe_tree *t, const tree_node *n) {
    if (tree_is_packed(t)) return n->type == TREE_LEAF ? TREE_CROWDED : 0;
    return TREE_GUARD | TREE_INSEPARABLE | TREE_CROWDED;
}

static froe_status check_node(check *c) {
    const tree_node *n = c->tree->nodes + c->walk.node;
    if (n->type > TREE_TABLED || n->flags & ~known_flags(c->tree, n) || n->unused)
        return bad_node(c, "an unknown type or flag");
    return n->type == TREE_LEAF ? check_leaf(c, n) : check_inner(c, n);
}

static froe_status check_nodes(check *c) {
    const froe_tree *t = c->tree;
    froe_status status = FROE_OK;
    c->nodes = c->bounds = 1;
    c->walk.tree = t;
    bool begun = tree_is_packed(t) ? !t->bound_count : t->bound_count && t->bounds[0] == 0;
    if (tree_is_packed(t)) c->bounds = 0;
    if (!t->node_count || !begun) return support_fail(c->diag, FROE_E_FORMAT, "the tree is corrupted: it has no root");
    while (!status && tree_walk_next(&c->walk)) status = check_node(c);
    if (tree_walk_end(&c->walk)) return support_fail_memory(c->diag);
    if (status) return status;
    if (c->nodes != t->node_count || c->cuts != t->cut_count || c->pieces != t->piece_count ||
        c->bounds != t->bound_count || c->normals != t->normal_count)
        return support_fail(c->diag, FROE_E_FORMAT, "the tree is corrupted: something that no node uses");
    return FROE_OK;
}

/* -------------------------------------------------------------------- meta -- */

/* Printable, ended, and zeros to the end. */
static bool text_fits(const char *text, size_t size) {
    size_t i = 0;
    while (i < size && text[i] >= ' ' && text[i] <= '~') i++;
    if (i == size) return false;
    while (i < size && !text[i]) i++;
    return i == size;
}

static bool promise_fits(const tree_promise *p, bool used) {
    if (!text_fits(p->name, sizeof p->name) || isnan(p->promised) || isnan(p->measured)) return false;
    return used ? p->name[0] != 0 : !p->name[0] && p->promised == 0 && p->measured == 0;
}

static bool meta_fits(const froe_tree *t) {
    const tree_meta *m = &t->meta;
    if (!text_fits(m->method, sizeof m->method) || !text_fits(m->settings, sizeof m->settings)) return false;
    if (m->leaf > INT32_MAX || m->promise_count > TREE_PROMISES) return false;
    for (uint32_t i = 0; i < TREE_PROMISES; i++)
        if (!promise_fits(m->promises + i, i < m->promise_count)) return false;
    return finite_root(t, m->root_lo) && finite_root(t, m->root_hi);
}

froe_status tree_validate(const froe_tree *tree, froe_diagnostic *diag) {
    check c = {.tree = tree, .diag = diag};
    if (!meta_fits(tree)) return support_fail(diag, FROE_E_FORMAT, "the tree is corrupted: its description");
    if (geom_context_new(&tree->alloc, &c.context)) return support_fail_memory(diag);
    froe_status status = check_nodes(&c);
    num_context_free(&c.context);
    if (!status && tree_is_packed(tree)) status = packed_validate(tree, diag);
    return status;
}
