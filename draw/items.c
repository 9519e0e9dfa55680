/* items.c: walks the tree from front to back and lists what is seen.
 *
 * At an inner node the side of the eye comes first, then what lies in the cut, then
 * the other side (Fuchs, Kedem, Naylor 1980). A part lists its front faces before its
 * contents and its back faces after them. Pieces in cuts above all parts
 * move by their own centre, which lies in the cut: the order stays right (draw.h).
 * Only pieces that share a leaf have no cut between them: they are listed in the order of
 * their centres, and so are boxes, balls and hulls, which no cut divides. */
#include "solid.h"
#include <math.h>
#include <stdlib.h>

typedef enum walk_stage { NODE, LIST, BACKS } walk_stage;
typedef struct frame {
    froe_node node;
    walk_stage stage;
    uint32_t part;  /* part + 1, or 0 above all parts */
    uint32_t depth; /* of the node */
} frame;

typedef struct order {
    double key; /* how near to the eye */
    size_t piece;
} order;

typedef struct walk {
    draw_solid *solid;
    const froe_allocator *alloc;
    const froe_tree *tree;
    const froe_scene *scene;
    ARRAY(frame) frames;
    ARRAY(order) list;
} walk;

static bool shows(const walk *w, uint32_t layers) {
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

static bool add_item_point(walk *w, draw_point at, double reach, bool cut) {
    draw_solid *solid = w->solid;
    bool first = solid->points.count == 0;
    draw_point lo = {at.x - reach, at.y - reach}, hi = {at.x + reach, at.y + reach};
    solid->lo = first ? lo : (draw_point){fmin(solid->lo.x, lo.x), fmin(solid->lo.y, lo.y)};
    solid->hi = first ? hi : (draw_point){fmax(solid->hi.x, hi.x), fmax(solid->hi.y, hi.y)};
    return array_push(w->alloc, &solid->points, at) && array_push(w->alloc, &solid->cut, cut);
}

/* An item with these corners, moved by explode times `middle`. */
static bool add_item(walk *w, draw_item item, const double *corners, size_t count, const double *middle,
                     const froe_node *made) {
    double k = w->solid->picture->page.options->explode;
    item.first = w->solid->points.count;
    item.count = (uint32_t)count;
    for (size_t i = 0; i < count; i++) {
        const double *p = corners + 3 * i;
        const double moved[3] = {p[0] + k * middle[0], p[1] + k * middle[1], p[2] + k * middle[2]};
        draw_point at = draw_camera_project(&w->solid->camera, moved);
        if (!add_item_point(w, at, item.radius, made && made[i].id1)) return false;
    }
    return array_push(w->alloc, &w->solid->items, item);
}

static bool add_area(walk *w, draw_item item, const double *corners, size_t count, const double *middle,
                     const froe_node *made) {
    double n[3];
    normal_of(corners, count, n);
    item.shade = (float)draw_camera_shade(&w->solid->camera, n);
    return add_item(w, item, corners, count, middle, made);
}

static bool add_faces(walk *w, uint32_t index, draw_matter matter) {
    const draw_solid *solid = w->solid;
    const draw_part *part = solid->parts.data + index;
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
        bool front = (draw_dot(n, solid->camera.eye) > 0) == (draw_dot(n, out) >= 0);
        draw_item item = {.part = index, .matter = (uint8_t)matter};
        if (front == (matter == DRAW_FRONT) && !add_area(w, item, corners, count, part->middle, NULL)) return false;
    }
    return true;
}

/* The three sides of a box that face the eye. Turning may have swapped its ends. */
static bool add_box(walk *w, draw_item item, const double *box, const double *middle) {
    const double *eye = w->solid->camera.eye;
    double lo[3], hi[3];
    for (int k = 0; k < 3; k++) {
        lo[k] = fmin(box[k], box[3 + k]);
        hi[k] = fmax(box[k], box[3 + k]);
    }
    for (int k = 0; k < 3; k++) {
        int a = (k + 1) % 3, b = (k + 2) % 3;
        double corners[12];
        for (int i = 0; i < 4; i++) {
            corners[3 * i + k] = eye[k] > 0 ? hi[k] : lo[k];
            corners[3 * i + a] = i == 1 || i == 2 ? hi[a] : lo[a];
            corners[3 * i + b] = i >= 2 ? hi[b] : lo[b];
        }
        if (!add_area(w, item, corners, 4, middle, NULL)) return false;
    }
    return true;
}

/* What a hull covers: the flat hull of its projected corners. */
static bool add_hull(walk *w, draw_item item, const double *corners, size_t count, const double *middle) {
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

/* ------------------------------------------------------------------ pieces -- */

/* Kinds that are never cut stand in many lists: each part shows its share of a box once,
 * and of balls and hulls the nearest part shows them whole. */
static bool met_before(walk *w, uint32_t object, froe_kind form, uint32_t part) {
    if (form != FROE_BOX && form != FROE_BALL && form != FROE_HULL) return false;
    uint32_t now = form == FROE_BOX ? part + 1 : 1;
    bool before = w->solid->met[object] == now;
    w->solid->met[object] = now;
    return before;
}

/* The share of a box (lo, hi) that lies in the bounds of a part. */
static void clip_box(const draw_solid *solid, uint32_t index, double *box) {
    const draw_part *part = solid->parts.data + index;
    const double *corners = solid->corners.data + part->first_corner;
    size_t count = part->face_count ? solid->face_ends.data[part->first_face + part->face_count - 1] : 0;
    for (size_t k = 0; k < 3 && count; k++) {
        double lo = corners[k], hi = corners[k];
        for (size_t i = 1; i < count; i++) {
            lo = fmin(lo, corners[3 * i + k]);
            hi = fmax(hi, corners[3 * i + k]);
        }
        box[k] = fmin(fmax(box[k], lo), hi);
        box[3 + k] = fmin(fmax(box[3 + k], lo), hi);
    }
}

static bool add_piece(walk *w, size_t index, uint32_t part) {
    draw_solid *solid = w->solid;
    draw_shaper *shaper = &solid->shaper;
    froe_piece piece = froe_tree_piece(w->tree, index);
    froe_object object = froe_scene_object(w->scene, piece.object);
    if (met_before(w, piece.object, object.form, part)) return true;
    if (!(piece.whole ? draw_corners_of_object(shaper, piece.object) : draw_corners_of_piece(shaper, index)))
        return false;
    const double *corners = shaper->solid.data;
    size_t count = shaper->solid.count / 3;
    double own[3];
    const double *middle = own;
    centre(corners, count, own);
    if (part) middle = solid->parts.data[part - 1].middle;
    draw_item item = {.matter = DRAW_PIECE, .odd = !piece.whole && (solid->met[piece.object] ^= 1) == 0};
    if (object.form == FROE_BOX) {
        if (part) clip_box(solid, part - 1, shaper->solid.data);
        return add_box(w, item, corners, middle);
    }
    if (object.form == FROE_HULL) return add_hull(w, item, corners, count, middle);
    if (object.form == FROE_BALL) {
        double r = ldexp(object.radius, solid->picture->space.shift) / solid->picture->space.half;
        item.radius = (float)(r < 1e30 ? r : 1e30);
        item.shade = 0.7f;
    }
    return add_area(w, item, corners, count, middle, piece.whole ? NULL : shaper->made.data);
}

static int nearest_first(const void *a, const void *b) {
    const order *x = a, *y = b;
    if (x->key != y->key) return x->key > y->key ? -1 : 1;
    return (x->piece > y->piece) - (x->piece < y->piece);
}

static bool key_of(walk *w, size_t piece, double *key) {
    draw_shaper *shaper = &w->solid->shaper;
    double middle[3];
    if (!draw_corners_of_object(shaper, froe_tree_piece(w->tree, piece).object)) return false;
    centre(shaper->solid.data, shaper->solid.count / 3, middle);
    *key = draw_dot(middle, w->solid->camera.eye);
    return true;
}

static bool add_list(walk *w, const froe_node_info *info, uint32_t part) {
    w->list.count = 0;
    if (!shows(w, FROE_DRAW_OBJECTS | FROE_DRAW_FRAGMENTS)) return true;
    for (size_t i = 0; i < info->piece_count; i++) {
        order at = {0, info->first_piece + i};
        if (info->piece_count > 1 && !key_of(w, at.piece, &at.key)) return false;
        if (!array_push(w->alloc, &w->list, at)) return false;
    }
    if (w->list.count > 1) qsort(w->list.data, w->list.count, sizeof *w->list.data, nearest_first);
    for (size_t i = 0; i < w->list.count && draw_tick(w->solid->picture->page.task); i++)
        if (!add_piece(w, w->list.data[i].piece, part)) return false;
    return true;
}

/* -------------------------------------------------------------------- walk -- */

static bool push(walk *w, froe_node node, walk_stage stage, uint32_t part, uint32_t depth) {
    return array_push(w->alloc, &w->frames, (frame){node, stage, part, depth});
}

/* The walls between parts: a cut within its region, in the middle of the gap. */
static bool add_wall(walk *w, const frame *at) {
    const draw_solid *solid = w->solid;
    uint32_t wall = solid->wall_of[at->node.id1 - 1];
    if (!wall || at->part || !shows(w, FROE_DRAW_CUTS)) return true;
    const draw_wall *cut = solid->walls.data + wall - 1;
    const double *corners = solid->corners.data + cut->first_corner;
    double own[3];
    centre(corners, cut->count, own);
    draw_item item = {.matter = DRAW_WALL, .depth = (uint16_t)(at->depth < 65535 ? at->depth : 65535)};
    return add_area(w, item, corners, cut->count, own, NULL);
}

static bool visit_node(walk *w, const frame *at) {
    froe_node_info info = froe_tree_node(w->tree, at->node);
    uint32_t part = at->part, own = w->solid->part_of[at->node.id1 - 1];
    if (own && !part) {
        part = own;
        if (!add_faces(w, part - 1, DRAW_FRONT) || !push(w, at->node, BACKS, part, at->depth)) return false;
    }
    if (info.cut.kind == FROE_CUT_NONE) return push(w, at->node, LIST, part, at->depth);
    draw_plane plane = draw_space_plane(&w->solid->picture->space, w->scene, &info.cut);
    int near = draw_dot(plane.n, w->solid->camera.eye) > 0;
    return push(w, info.child[!near], NODE, part, at->depth + 1) && push(w, at->node, LIST, part, at->depth) &&
           push(w, info.child[near], NODE, part, at->depth + 1);
}

static bool visit_item(walk *w, const frame *at) {
    if (at->stage == BACKS) return add_faces(w, at->part - 1, DRAW_BACK);
    if (at->stage == NODE) return visit_node(w, at);
    froe_node_info info = froe_tree_node(w->tree, at->node);
    return add_list(w, &info, at->part) && add_wall(w, at);
}

froe_status draw_solid_items(draw_solid *solid) {
    const draw_page *page = &solid->picture->page;
    walk w = {.solid = solid, .alloc = &page->alloc, .tree = page->tree, .scene = froe_tree_scene(page->tree)};
    bool ok = push(&w, froe_tree_root(page->tree), NODE, 0, 0);
    while (ok && w.frames.count && draw_tick(page->task)) {
        frame top = w.frames.data[--w.frames.count];
        ok = visit_item(&w, &top);
    }
    array_free(&page->alloc, &w.frames);
    array_free(&page->alloc, &w.list);
    return !ok ? FROE_E_MEMORY : page->task->cancelled ? FROE_E_CANCELLED : FROE_OK;
}
