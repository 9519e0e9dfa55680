/* validate.c: structure and indices of a tree, before they are used.
 *
 * The arrays of a sealed tree are packed in depth-first order (tree.h). So one walk that counts
 * what it has seen knows where the next pair, cut, normal, list and ring must begin; comparing
 * with that excludes cycles, sharing, gaps and overlaps at once, and each index is checked
 * where it stands. The audit checks what the pieces mean. */
#include "tree/validate.h"
#include "geom/selftest.h"
#include "support/fail.h"
#include "tree/packed/space.h"
#include "tree/walk.h"
#include <math.h>

typedef struct check {
    const froe_tree *tree;
    tree_walk walk;
    num_context context;
    uint32_t nodes, cuts, pieces, bounds, normals, blocks; /* seen so far */
    uint64_t height, max_leaf;                             /* likewise */
    froe_diagnostic *diag;
} check;

static froe_status bad_node(const check *c, const char *what) {
    return support_fail(c->diag, FROE_E_FORMAT, "node %u: The tree is corrupted: %s.", c->walk.node, what);
}

static froe_status bad_piece(const check *c, uint32_t object, const char *what) {
    return support_fail_at(c->diag, FROE_E_FORMAT, object < c->tree->scene->object_count ? object : FROE_NONE,
                           FROE_NONE, FROE_NONE, "object %u, node %u: The tree is corrupted: %s.", object, c->walk.node,
                           what);
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

/* The next doubles of normals are those of the cut, and finite. */
static bool normals_fit(check *c, const tree_cut *cut) {
    const froe_tree *t = c->tree;
    const size_t count = tree_cut_normals(cut, t->scene->dim);
    if (cut->a != c->normals || t->normal_count - c->normals < count) return false;
    for (size_t k = 0; k < count; k++)
        if (!isfinite(t->normals[cut->a + k])) return false;
    c->normals += (uint32_t)count;
    return true;
}

/* Kind, indices and numbers of a tabled cut; a plane must have a normal, and unused ids are 0. */
static bool cut_fits(check *c, const tree_cut *cut) {
    const froe_tree *t = c->tree;
    const froe_scene *s = t->scene;
    const bool space = s->dim == 3, b_free = cut->u.id.b == 0, c_free = cut->u.id.c == 0;
    const uint32_t dim = (uint32_t)s->dim, vertices = s->vertex_count, a = cut->a, b = cut->u.id.b;
    bool fits = dim <= 3;
    switch (cut->kind) {
    case FROE_CUT_AXIS:
        return a < dim && isfinite(cut->u.value);
    case FROE_CUT_PLANE:
        fits = isfinite(cut->u.value) && normals_fit(c, cut);
        break;
    case FROE_CUT_FINE:
        fits = b - 1 < GEOM_FINE_ROWS && c_free && normals_fit(c, cut);
        break;
    case FROE_CUT_OBJECT:
        fits = fits && a < s->object_count && scene_form(s, a) == (space ? FROE_POLYGON : FROE_SEGMENT) && b_free &&
               c_free;
        break;
    case FROE_CUT_VERTICES:
        fits = fits && a < vertices && b < vertices && (space ? cut->u.id.c < vertices : c_free);
        break;
    case FROE_CUT_EDGE:
        fits = space && a < vertices && b < vertices && c_free;
        break;
    case FROE_CUT_VERTEX:
        fits = fits && a < vertices && b_free && c_free;
        break;
    case FROE_CUT_CROSSING:
        fits = fits && is_edge(s, a) && is_edge(s, b) && c_free;
        break;
    default:
        return false;
    }
    if (!fits) return false;
    geom_plane plane = tree_plane_at(t, c->walk.node);
    return geom_plane_valid(&c->context, &plane);
}

/* ------------------------------------------------------------------- lists -- */

static froe_status check_list(check *c, uint32_t first, uint32_t count, uint32_t covers) {
    const froe_tree *t = c->tree;
    if (first != c->pieces || count > t->piece_count - c->pieces) return bad_node(c, "a list out of place");
    if (covers > count) return bad_node(c, "more covers than pieces");
    for (uint32_t i = first; !tree_is_packed(t) && i < first + count; i++) {
        const tree_piece *piece = t->pieces + i;
        if (piece->object >= t->scene->object_count)
            return bad_piece(c, piece->object, "an object that does not exist");
        const froe_kind form = scene_form(t->scene, piece->object);
        if (i - first < covers && form != FROE_BOX) return bad_piece(c, piece->object, "a cover that is no box");
        if (!piece->ring) continue;
        if (form != FROE_SEGMENT && form != FROE_POLYGON)
            return bad_piece(c, piece->object, "a kind that is never cut");
        if (piece->ring != c->bounds || c->bounds >= t->bound_count)
            return bad_piece(c, piece->object, "a ring out of place");
        const uint32_t *ring = t->bounds + piece->ring, length = *ring, most = t->bound_count - c->bounds - 1;
        if (length > most || (form == FROE_SEGMENT ? length != 2 : length < 3))
            return bad_piece(c, piece->object, "a ring of wrong length");
        for (uint32_t k = 0; k < length; k++) {
            uint32_t edge = ring[1 + k];
            bool own = form == FROE_SEGMENT ? edge == k : edge < scene_corners(t->scene, piece->object);
            if (edge & TREE_EDGE_CUT ? !tree_walk_above(&c->walk, edge & ~TREE_EDGE_CUT) : !own)
                return bad_piece(c, piece->object, "a ring entry that is no edge and no ancestor");
        }
        c->bounds += length + 1;
    }
    c->pieces += count;
    return FROE_OK;
}

/* ------------------------------------------------------------------- nodes -- */

static froe_status check_node(check *c) {
    const froe_tree *t = c->tree;
    const tree_node *n = t->nodes + c->walk.node;
    const bool leaf = n->type == TREE_LEAF, packed = tree_is_packed(t);
    const int general = TREE_GUARD | TREE_INSEPARABLE | TREE_CROWDED | (leaf ? 0 : TREE_CHARGED);
    const int known = !packed ? general : leaf ? TREE_CROWDED : 0;
    if (n->type > TREE_TABLED || n->flags & ~known || n->unused) return bad_node(c, "an unknown type or flag");
    if (leaf) {
        if (n->axis) return bad_node(c, "an unused field that is not 0");
        if (tree_walk_depth(&c->walk) > c->height) c->height = tree_walk_depth(&c->walk);
        if (n->u.list.count > c->max_leaf) c->max_leaf = n->u.list.count;
        if (packed && !tree_is_space(t) && !packed_takes_place(t, n, &c->blocks))
            return bad_node(c, "a block out of place");
        return check_list(c, n->u.list.first, n->u.list.count, tree_covers(t, n));
    }
    if (n->flags & (TREE_INSEPARABLE | TREE_CROWDED)) return bad_node(c, "an unknown flag");
    if (n->child != c->nodes || t->node_count - c->nodes < 2) return bad_node(c, "children out of place");
    c->nodes += 2;
    if (n->type == TREE_PLAIN) {
        bool fits = n->axis < t->scene->dim && isfinite(n->u.value);
        return fits ? FROE_OK : bad_node(c, "a cut that does not exist");
    }
    if (n->axis) return bad_node(c, "an unused field that is not 0");
    if (n->u.cut != c->cuts || c->cuts >= t->cut_count) return bad_node(c, "a cut out of place");
    const tree_cut *cut = t->cuts + c->cuts++;
    if (!cut_fits(c, cut)) return bad_node(c, "a cut that does not exist");
    return check_list(c, cut->first, cut->count, n->u.covers);
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

bool tree_meta_fits(const froe_tree *t) {
    const tree_meta *m = &t->meta;
    if (!text_fits(m->method, sizeof m->method) || !text_fits(m->settings, sizeof m->settings)) return false;
    if (m->leaf > INT32_MAX || m->promise_count > TREE_PROMISES) return false;
    for (uint32_t i = 0; i < TREE_PROMISES; i++) {
        const tree_promise *p = m->promises + i;
        if (!text_fits(p->name, sizeof p->name) || !isfinite(p->promised) || !isfinite(p->measured)) return false;
        const bool empty = !p->name[0] && p->promised == 0 && p->measured == 0;
        if (i < m->promise_count ? !p->name[0] : !empty) return false;
    }
    return finite_root(t, m->root_lo) && finite_root(t, m->root_hi);
}

froe_status tree_validate_nodes(const froe_tree *tree, froe_diagnostic *diag) {
    const bool packed = tree_is_packed(tree);
    check c = {.tree = tree, .walk = {.tree = tree}, .nodes = 1, .bounds = packed ? 0 : 1, .diag = diag};
    froe_status status = FROE_OK;
    bool begun = packed ? !tree->bound_count : tree->bound_count && tree->bounds[0] == 0;
    if (geom_context_new(&tree->alloc, &c.context)) return support_fail_memory(diag);
    if (!begun) status = support_fail(diag, FROE_E_FORMAT, "The tree is corrupted: it has no root.");
    while (!status && tree_walk_next(&c.walk)) status = check_node(&c);
    if (tree_walk_end(&c.walk)) status = support_fail_memory(diag);
    num_context_free(&c.context);
    if (status) return status;
    if (c.nodes != tree->node_count || c.cuts != tree->cut_count || c.pieces != tree->piece_count ||
        c.bounds != tree->bound_count || c.normals != tree->normal_count)
        return support_fail(diag, FROE_E_FORMAT, "The tree is corrupted: something that no node uses.");
    if (c.height != tree->facts.height || c.max_leaf != tree->facts.max_leaf)
        return support_fail(diag, FROE_E_FORMAT, "The tree is corrupted: its height or its fullest leaf is wrong.");
    return FROE_OK;
}

froe_status tree_validate(const froe_tree *tree, froe_diagnostic *diag) {
    if (!tree_meta_fits(tree))
        return support_fail(diag, FROE_E_FORMAT, "The tree is corrupted: its description is wrong.");
    const froe_status status = tree_validate_nodes(tree, diag);
    return status || !tree_is_packed(tree) ? status : packed_validate(tree, diag);
}
