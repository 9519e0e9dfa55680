/* order.c: the walk behind every depth order, with a stack of its own. */
#include "view/visibility/order.h"
#include "geom/predicates.h"
#include "geom/selftest.h"
#include "support/fail.h"
#include "tree/list.h"
#include "tree/packed/space.h"
#include <math.h>

froe_status view_order_begin(view_order *order, const froe_tree *tree, const geom_eye *eye, bool front_to_back,
                             const uint32_t *ranks) {
    *order = (view_order){.tree = tree, .eye = *eye, .front_to_back = front_to_back, .ranks = ranks};
    froe_status status = geom_context_new(&tree->alloc, &order->context);
    return status ? status : view_order_restart(order);
}

froe_status view_order_restart(view_order *order) {
    order->visits.count = 0;
    order->list_at = order->list_end = 0;
    if (!array_push(&order->tree->alloc, &order->visits, (view_visit){0, false})) order->status = FROE_E_MEMORY;
    return order->status;
}

froe_status view_order_end(view_order *order) {
    const froe_allocator *alloc = &order->tree->alloc;
    array_free(alloc, &order->visits);
    array_free(alloc, &order->list);
    num_context_free(&order->context);
    return order->status;
}

/* ---------------------------------------------------------------------- lists -- */

/* Makes a list ready to be handed out; its last entry is in front of the others when back to front. */
static bool begin_list(view_order *order, tree_objects list) {
    order->list.count = 0;
    if (!array_reserve(&order->tree->alloc, &order->list, 2 * (size_t)list.count)) return false;
    base_pair *pairs = order->list.data;
    order->list_at = 0;
    order->list_end = list.count;
    for (uint32_t i = 0; i < list.count; i++) pairs[i].value = list.first + i;
    if (list.count < 2) return true;
    const froe_scene *scene = order->tree->scene;
    const uint32_t *ranks = order->ranks ? order->ranks : scene->faces;
    for (uint32_t i = 0; i < list.count; i++) {
        const uint32_t object = tree_object(&list, i);
        pairs[i].key = ranks ? ranks[object] : object;
    }
    base_radix_sort(pairs, pairs + list.count, list.count);
    return true;
}

/* ----------------------------------------------------------------------- walk -- */

/* The three points that make the cut of a node; false: it is made of something else. */
static bool points_of_cut(const froe_tree *tree, uint32_t node, const double *points[3]) {
    const tree_node *n = tree->nodes + node;
    if (tree->scene->dim != 3) return false;
    const tree_cut *cut = tree->cuts + n->u.cut;
    if (cut->kind == FROE_CUT_OBJECT) {
        for (uint32_t i = 0; i < 3; i++) points[i] = scene_point(tree->scene, cut->a, i);
        return true;
    }
    if (cut->kind != FROE_CUT_VERTICES) return false;
    const uint32_t vertices[3] = {cut->a, cut->u.id.b, cut->u.id.c};
    for (int i = 0; i < 3; i++) points[i] = scene_vertex(tree->scene, vertices[i]);
    return true;
}

int view_side_of_eye(num_context *context, const froe_tree *tree, uint32_t node, const geom_eye *eye) {
    const tree_node *n = tree->nodes + node;
    const double *p[3];
    if (n->type == TREE_PLAIN) {
        const double x = eye->at[n->axis], limit = eye->parallel ? 0 : n->u.value;
        return (x > limit) - (x < limit);
    }
    if (context->first == NUM_FILTER && points_of_cut(tree, node, p)) {
        const int sure = geom_side_of_eye_filter(p[0], p[1], p[2], eye);
        if (sure != NUM_UNSURE) return sure;
    }
    const geom_plane plane = tree_plane_at(tree, node);
    return geom_side_of_eye(context, &plane, eye);
}

static bool push_child(view_order *order, uint32_t node, uint32_t child) {
    const bool away = node == 0 && order->section && child != order->tree->nodes->child + (order->section > 0);
    return away || array_push(&order->tree->alloc, &order->visits, (view_visit){child, false});
}

/* Leaves the two children of a node, and its list between them, pending. */
static bool push_node(view_order *order, uint32_t node) {
    const froe_allocator *alloc = &order->tree->alloc;
    const tree_node *n = order->tree->nodes + node;
    const int side = order->sides ? (int)(order->sides[node] >> order->shift & 3) - 1
                                  : view_side_of_eye(&order->context, order->tree, node, &order->eye);
    uint32_t near = n->child + (side >= 0), far = 2 * n->child + 1 - near;
    uint32_t first = order->front_to_back ? near : far, last = order->front_to_back ? far : near;
    if (!push_child(order, node, last)) return false;
    if (n->type == TREE_TABLED && order->tree->cuts[n->u.cut].count &&
        !array_push(alloc, &order->visits, (view_visit){node, true}))
        return false;
    return push_child(order, node, first);
}

bool view_order_next(view_order *order, uint32_t *piece) {
    while (order->list_at == order->list_end) {
        if (!order->visits.count) return false;
        const view_visit at = order->visits.data[--order->visits.count];
        const bool inner = !at.list && !tree_is_leaf(order->tree->nodes + at.node);
        if (inner ? push_node(order, at.node) : begin_list(order, tree_list(order->tree, at.node))) continue;
        order->status = FROE_E_MEMORY;
        return false;
    }
    const size_t i = order->list_at++;
    *piece = order->list.data[order->front_to_back ? order->list_end - 1 - i : i].value;
    return true;
}

/* --------------------------------------------------------------------- checks -- */

froe_status view_eye_of(const froe_tree *tree, const froe_eye *eye, geom_eye *out, froe_diagnostic *diag) {
    double at[3] = {0}, origin[3] = {0}, most = 0, extent = 0;
    for (int k = 0; k < tree->scene->dim && k < 3; k++) {
        if (!isfinite(eye->at[k]))
            return support_fail_at(diag, FROE_E_ARG, FROE_NONE, FROE_NONE, (uint32_t)k,
                                   "Coordinate %d of the eye is not a finite number.", k);
        at[k] = eye->at[k];
        most = fmax(most, fabs(at[k]));
        if (!tree->scene->object_count) continue;
        origin[k] = 0.5 * tree->scene->lo[k] + 0.5 * tree->scene->hi[k];
        extent = fmax(extent, tree->scene->hi[k] - tree->scene->lo[k]);
    }
    if (eye->parallel && most == 0)
        return support_fail(diag, FROE_E_ARG, "The direction of a parallel eye has length 0.");
    *out = geom_eye_make(eye->parallel, at, origin);
    geom_eye_set_extent(out, extent);
    return FROE_OK;
}

/* Do all these pieces lie in the hyperplane of the first that has one? `faces`: those of polygons. */
static bool in_one_plane(num_context *context, const froe_scene *scene, const tree_objects *list, bool faces) {
    geom_plane plane;
    const froe_kind full = scene->dim == 2 ? FROE_SEGMENT : FROE_POLYGON;
    uint32_t base = 0;
    while (base < list->count && scene_form(scene, tree_object(list, base)) != full) base++;
    if (base == list->count) return faces;
    scene_support(scene, tree_object(list, base), &plane);
    for (uint32_t i = 0; i < list->count; i++) {
        const uint32_t object = tree_object(list, i);
        if (faces && scene_form(scene, object) != FROE_POLYGON) continue;
        for (uint32_t k = 0; k < scene_corners(scene, object); k++)
            if (geom_side_vertex(context, &plane, scene_point(scene, object, k)) != 0) return false;
    }
    return true;
}

froe_status view_order_check(const froe_tree *tree, bool faces, froe_diagnostic *diag) {
    const froe_scene *scene = tree->scene;
    num_context context;
    froe_status status = FROE_OK;
    bool ordered = !faces;
    for (uint32_t i = 0; i < scene->object_count; i++) {
        ordered = ordered || scene_form(scene, i) == FROE_POLYGON;
        if (scene_form(scene, i) > FROE_POLYGON)
            return support_fail_at(diag, FROE_E_UNSUPPORTED, i, FROE_NONE, FROE_NONE,
                                   "object %u: It is a %s. Only polygons, segments and points have a depth order.", i,
                                   froe_kind_name(scene_form(scene, i)));
    }
    if (!ordered) return FROE_OK;
    if (tree_is_space(tree))
        return support_fail(diag, FROE_E_UNSUPPORTED,
                            "A tree of method '%s' lists whole objects, which are in no depth order. A tree for the "
                            "purpose \"draw\" has pieces, which are.",
                            tree->meta.method);
    if (tree->report.max_leaf <= 1) return FROE_OK;
    if (geom_context_new(&tree->alloc, &context)) return support_fail_memory(diag);
    for (uint32_t node = 0; node < tree->node_count && !status; node++) {
        if (!tree_is_leaf(tree->nodes + node)) continue;
        const tree_objects list = tree_list(tree, node);
        if (list.count > 1 && !in_one_plane(&context, tree->scene, &list, faces))
            status = support_fail_at(diag, FROE_E_UNSUPPORTED, tree_object(&list, 0), FROE_NONE, FROE_NONE,
                                     "A leaf holds %u pieces (one of object %u) without a cut between them. A leaf "
                                     "capacity of 1 or 0 leaves none.",
                                     list.count, tree_object(&list, 0));
    }
    num_context_free(&context);
    return status;
}
