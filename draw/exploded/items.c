/* items.c: lists what is seen of an exploded view, nearest first.
 *
 * Nodes come front to back (froe_tree_order_nodes): the side of the eye first, then what lies in the cut, then
 * the other side. A part lists its front faces before its contents and its back faces after them. Pieces in cuts above
 * all parts move by their own centre, which lies in the cut: the order stays right (draw.h).
 * Only pieces that share a leaf have no cut between them: they are listed in the order of
 * their centres, and so are boxes, balls and hulls, which no cut divides. */
#include "exploded/solid.h"
#include "support/axes.h"
#include <math.h>
#include <stdlib.h>

typedef struct near_piece {
    double key; /* how near to the eye */
    size_t piece;
} near_piece;

typedef struct item_walk {
    draw_solid *solid;
    const froe_allocator *alloc;
    const froe_tree *tree;
    const froe_scene *scene;
    uint32_t part;       /* part + 1, or 0 above all parts */
    froe_node part_node; /* of the part */
    uint32_t depth;      /* of the node */
    ARRAY(near_piece) list;
    bool ok;
} item_walk;

static bool shows(const item_walk *w, uint32_t layers) {
    return w->solid->picture->show & layers;
}

static void centre(const double *corners, size_t count, double *out) {
    for (int k = 0; k < 3; k++) {
        out[k] = 0;
        for (size_t i = 0; i < count; i++) out[k] += corners[3 * i + (size_t)k] / (double)count;
    }
}

static void normal_of(const double *corners, size_t count, double *n) {
    for (int k = 0; k < 3; k++) n[k] = 0;
    for (size_t i = 1; i + 1 < count; i++) {
        const double *o = corners, *p = corners + 3 * i, *q = p + 3;
        for (int k = 0; k < 3; k++) {
            int a = (k + 1) % 3, b = (k + 2) % 3;
            n[k] += (p[a] - o[a]) * (q[b] - o[b]) - (p[b] - o[b]) * (q[a] - o[a]);
        }
    }
}

/* ------------------------------------------------------------------- items -- */

/* An item with these corners, moved by explode times `middle`. */
static bool add_item(item_walk *w, draw_item item, const double *corners, size_t count, const double *middle,
                     const froe_node *made) {
    draw_solid *solid = w->solid;
    const double e = solid->picture->page.options->explode, reach = item.radius;
    item.first = solid->points.count;
    item.count = (uint32_t)count;
    for (size_t i = 0; i < count; i++) {
        const double *p = corners + 3 * i;
        const double moved[3] = {p[0] + e * middle[0], p[1] + e * middle[1], p[2] + e * middle[2]};
        const draw_point at = draw_camera_project(&solid->camera, moved);
        const draw_point lo = {at.x - reach, at.y - reach}, hi = {at.x + reach, at.y + reach};
        const bool first = solid->points.count == 0;
        solid->lo = first ? lo : (draw_point){fmin(solid->lo.x, lo.x), fmin(solid->lo.y, lo.y)};
        solid->hi = first ? hi : (draw_point){fmax(solid->hi.x, hi.x), fmax(solid->hi.y, hi.y)};
        if (!array_push(w->alloc, &solid->points, at) || !array_push(w->alloc, &solid->cut, made && made[i].id1))
            return false;
    }
    return array_push(w->alloc, &solid->items, item);
}

static bool add_area(item_walk *w, draw_item item, const double *corners, size_t count, const double *middle,
                     const froe_node *made) {
    double n[3];
    normal_of(corners, count, n);
    item.shade = (float)draw_camera_shade(&w->solid->camera, n);
    return add_item(w, item, corners, count, middle, made);
}

static bool add_faces(item_walk *w, draw_matter matter) {
    const draw_solid *solid = w->solid;
    const draw_part *part = solid->parts.data + w->part - 1;
    size_t start = 0;
    for (size_t f = 0; f < part->face_count && shows(w, FROE_DRAW_CELLS); f++) {
        size_t end = solid->face_ends.data[part->first_face + f], count = end - start;
        const double *corners = solid->corners.data + part->first_corner + 3 * start;
        double n[3], out[3];
        start = end;
        if (count < 3) continue;
        /* Which way a face looks is told by where the middle is. */
        normal_of(corners, count, n);
        centre(corners, count, out);
        for (int k = 0; k < 3; k++) out[k] -= part->middle[k];
        bool front = (support_dot(n, solid->camera.eye) > 0) == (support_dot(n, out) >= 0);
        draw_item item = {.part = w->part - 1, .matter = (uint8_t)matter};
        if (front == (matter == DRAW_FRONT) && !add_area(w, item, corners, count, part->middle, NULL)) return false;
    }
    return true;
}

/* ------------------------------------------------------------------ pieces -- */

/* The three sides that face the eye of a box, or of its share within the bounds of the part. */
static bool add_box(item_walk *w, draw_item item, const double *box, const double *middle) {
    const draw_solid *solid = w->solid;
    const draw_part *part = w->part ? solid->parts.data + w->part - 1 : NULL;
    const double *bounds = part ? solid->corners.data + part->first_corner : NULL;
    const size_t count = part && part->face_count ? solid->face_ends.data[part->first_face + part->face_count - 1] : 0;
    double lo[3], hi[3];
    for (int k = 0; k < 3; k++) {
        double a = box[k], b = box[3 + k];
        if (count) {
            double least = bounds[k], most = bounds[k];
            for (size_t i = 1; i < count; i++) {
                least = fmin(least, bounds[3 * i + (size_t)k]);
                most = fmax(most, bounds[3 * i + (size_t)k]);
            }
            a = fmin(fmax(a, least), most);
            b = fmin(fmax(b, least), most);
        }
        lo[k] = fmin(a, b), hi[k] = fmax(a, b); /* turning may have swapped the ends */
    }
    for (int k = 0; k < 3; k++) {
        int a = (k + 1) % 3, b = (k + 2) % 3;
        double corners[12];
        for (int i = 0; i < 4; i++) {
            corners[3 * i + k] = solid->camera.eye[k] > 0 ? hi[k] : lo[k];
            corners[3 * i + a] = i == 1 || i == 2 ? hi[a] : lo[a];
            corners[3 * i + b] = i >= 2 ? hi[b] : lo[b];
        }
        if (!add_area(w, item, corners, 4, middle, NULL)) return false;
    }
    return true;
}

/* What a hull covers: the flat hull of its projected corners. */
static bool add_hull(item_walk *w, draw_item item, const double *corners, size_t count, const double *middle) {
    draw_solid *solid = w->solid;
    size_t first = solid->points.count;
    ARRAY(draw_point) spare = {0};
    item.shade = 0.7f;
    bool ok = array_reserve(w->alloc, &spare, count + 1) && add_item(w, item, corners, count, middle, NULL);
    if (ok) {
        size_t left = draw_hull(solid->points.data + first, spare.data, count);
        solid->items.data[solid->items.count - 1].count = (uint32_t)left;
        solid->points.count = solid->cut.count = first + left;
    }
    array_free(w->alloc, &spare);
    return ok;
}

static bool add_piece(item_walk *w, size_t index) {
    draw_solid *solid = w->solid;
    draw_shaper *shaper = &solid->shaper;
    froe_piece piece = froe_tree_piece(w->tree, index);
    froe_object object = froe_scene_object(w->scene, piece.object);
    if (object.form == FROE_BOX || object.form == FROE_BALL || object.form == FROE_HULL) {
        /* Kinds that are never cut stand in many lists: each part shows its share of a box once, and of balls and hulls
         * the nearest part shows them whole. */
        const uint32_t now = object.form == FROE_BOX ? w->part + 1 : 1;
        if (solid->met[piece.object] == now) return true;
        solid->met[piece.object] = now;
    }
    if (!(piece.whole ? draw_corners_of_object(shaper, piece.object) : draw_corners_of_piece(shaper, index)))
        return false;
    const double *corners = shaper->solid.data;
    size_t count = shaper->solid.count / 3;
    double own[3];
    const double *middle = own;
    centre(corners, count, own);
    if (w->part) middle = solid->parts.data[w->part - 1].middle;
    draw_item item = {.matter = DRAW_PIECE, .odd = !piece.whole && (solid->met[piece.object] ^= 1) == 0};
    if (object.form == FROE_BOX) return add_box(w, item, corners, middle);
    if (object.form == FROE_HULL) return add_hull(w, item, corners, count, middle);
    if (object.form == FROE_BALL) {
        double r = ldexp(object.radius, solid->picture->space.shift) / solid->picture->space.half;
        item.radius = (float)(r < 1e30 ? r : 1e30);
        item.shade = 0.7f;
    }
    return add_area(w, item, corners, count, middle, piece.whole ? NULL : shaper->made.data);
}

static int nearest_first(const void *a, const void *b) {
    const near_piece *x = a, *y = b;
    if (x->key != y->key) return x->key > y->key ? -1 : 1;
    return (x->piece > y->piece) - (x->piece < y->piece);
}

static bool add_list(item_walk *w, const froe_node_info *info) {
    draw_shaper *shaper = &w->solid->shaper;
    w->list.count = 0;
    if (!shows(w, FROE_DRAW_OBJECTS | FROE_DRAW_FRAGMENTS)) return true;
    for (size_t i = 0; i < info->piece_count; i++) {
        near_piece at = {0, info->first_piece + i};
        if (info->piece_count > 1) {
            double middle[3];
            if (!draw_corners_of_object(shaper, froe_tree_piece(w->tree, at.piece).object)) return false;
            centre(shaper->solid.data, shaper->solid.count / 3, middle);
            at.key = support_dot(middle, w->solid->camera.eye);
        }
        if (!array_push(w->alloc, &w->list, at)) return false;
    }
    if (w->list.count > 1) qsort(w->list.data, w->list.count, sizeof *w->list.data, nearest_first);
    for (size_t i = 0; i < w->list.count && draw_tick(w->solid->picture->page.task); i++)
        if (!add_piece(w, w->list.data[i].piece)) return false;
    return true;
}

/* -------------------------------------------------------------------- walk -- */

static bool visit_stage(void *user, froe_node node, froe_order_stage stage) {
    SUPPORT_FLOATS_OWN;
    item_walk *w = user;
    const uint32_t own = w->solid->part_of[node.id1 - 1];
    if (stage == FROE_ORDER_BEGIN) {
        w->depth++;
        if (own && !w->part) {
            w->part = own, w->part_node = node;
            w->ok = add_faces(w, DRAW_FRONT);
        }
    } else if (stage == FROE_ORDER_LIST) {
        const froe_node_info info = froe_tree_node(w->tree, node);
        const uint32_t wall = w->solid->wall_of[node.id1 - 1];
        w->ok = add_list(w, &info);
        if (w->ok && wall && !w->part && shows(w, FROE_DRAW_CUTS)) {
            /* The wall between two parts: the cut within its region, in the middle of the gap. */
            const draw_wall *cut = w->solid->walls.data + wall - 1;
            const double *corners = w->solid->corners.data + cut->first_corner;
            const draw_item item = {.matter = DRAW_WALL, .depth = (uint16_t)(w->depth < 65536 ? w->depth - 1 : 65535)};
            double middle[3];
            centre(corners, cut->count, middle);
            w->ok = add_area(w, item, corners, cut->count, middle, NULL);
        }
    } else {
        w->depth--;
        if (w->part && w->part_node.id1 == node.id1) {
            w->ok = add_faces(w, DRAW_BACK);
            w->part = 0;
        }
    }
    return w->ok && draw_tick(w->solid->picture->page.task);
}

froe_status draw_solid_items(draw_solid *solid) {
    const draw_page *page = &solid->picture->page;
    const draw_space *space = &solid->picture->space;
    item_walk w = {.solid = solid, .alloc = &page->alloc, .tree = page->tree, .ok = true};
    froe_order_options options = froe_order_defaults();
    froe_eye eye = {.parallel = true};
    w.scene = froe_tree_scene(page->tree);
    options.front_to_back = true;
    for (int k = 0; k < 3; k++) eye.at[space->from[k]] = space->sign[k] * solid->camera.eye[k];
    const froe_status status = froe_tree_order_nodes(page->tree, &eye, &options, visit_stage, &w, NULL);
    array_free(&page->alloc, &w.list);
    return status ? status : !w.ok ? FROE_E_MEMORY : page->task->cancelled ? FROE_E_CANCELLED : FROE_OK;
}
