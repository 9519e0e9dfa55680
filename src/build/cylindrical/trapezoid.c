/* trapezoid.c: one step: a cell of the plane is cut by a wall or by the line of its first part. */
#include "build/cylindrical/trapezoid.h"
#include "build/cylindrical/cylinder.h"
#include "geom/filter.h"
#include "geom/selftest.h"

enum { LEFT, RIGHT };

/** With SPLIT_BOTH: the left end is on the positive side. */
enum { FALLING = 4, UNSURE = 8 };

/** The cut of a cell. A line runs from left to right: its positive side is above, that of a wall on the right. */
typedef struct trapezoid_cut {
    froe_cut name;
    double x, error;  /**< of a wall */
    filter_line line; /**< of a line, sure of whatever is further from 0 than `bound` */
    double bound;
    double ends[2][2]; /**< of a line: of the first part's segment */
    bool has_plane;
    geom_plane plane; /**< made for the first part that is too near for the filter; may face the other way */
    int facing;       /**< -1: it does */
} trapezoid_cut;

froe_status trapezoid_work_new(const froe_scene *scene, const froe_allocator *alloc, num_stage first, uint32_t leaf,
                               trapezoid_work *out) {
    memset(out, 0, sizeof *out);
    const froe_status status = split_set_new(scene, alloc, &out->set);
    if (status) return status;
    if (first > out->set.context.first) out->set.context.first = first;
    out->leaf = leaf;
    out->filtered = out->set.context.first == NUM_FILTER && num_rounding_trusted();
    for (int k = 0; k < 2; k++) out->span[k] = (scene->hi[k] - scene->lo[k]) * FILTER_UP;
    return FROE_OK;
}

void trapezoid_work_free(trapezoid_work *work) {
    const froe_allocator alloc = work->set.alloc;
    array_free(&alloc, &work->cells);
    array_free(&alloc, &work->parts);
    array_free(&alloc, &work->spare);
    split_set_free(&work->set);
}

static int order_ends(const double *p, const double *q) {
    const int k = p[0] == q[0];
    return (p[k] > q[k]) - (p[k] < q[k]);
}

trapezoid_part trapezoid_whole(const froe_scene *scene, uint32_t object) {
    const double *p = scene_point(scene, object, 0), *q = scene_point(scene, object, scene_corners(scene, object) - 1);
    const bool turned = order_ends(p, q) > 0;
    const double *left = turned ? q : p, *right = turned ? p : q;
    return (trapezoid_part){.p = {{left[0], left[1]}, {right[0], right[1]}},
                            .x = {left[0], right[0]},
                            .object = object | (turned ? TRAPEZOID_TURNED : 0),
                            .end = {turned, !turned}};
}

static uint32_t object_of(const trapezoid_part *f) {
    return f->object & ~TRAPEZOID_TURNED;
}

/* ------------------------------------------------------------------- lists -- */

static froe_status emit_part(split_set *set, uint32_t node, const trapezoid_part *f) {
    const uint32_t local = node - set->draft->outer;
    const bool turned = f->object & TRAPEZOID_TURNED;
    const uint32_t ring[2] = {f->end[turned], f->end[!turned]};
    const bool whole = !((ring[0] | ring[1]) & TREE_EDGE_CUT);
    return draft_piece(set->draft, local, object_of(f), whole ? NULL : ring, 2);
}

static froe_status end_trapezoid(trapezoid_work *w, const trapezoid_cell *cell) {
    split_set *set = &w->set;
    const uint32_t local = cell->node - set->draft->outer;
    draft_leaf(set->draft, local, 0);
    froe_status status = draft_list(set->draft, local);
    for (uint32_t i = 0; i < cell->count && !status; i++)
        status = emit_part(set, cell->node, w->parts.data + cell->first + i);
    w->parts.count = cell->first;
    return status;
}

/* ------------------------------------------------------------- exact sides -- */

static const geom_plane *plane_of(const trapezoid_work *w, trapezoid_cut *cut) {
    if (cut->has_plane) return &cut->plane;
    cut->plane = scene_cut_plane(w->set.scene, &cut->name);
    cut->has_plane = true;
    return &cut->plane;
}

/** The side of a plane on which one end of the part is. */
static int side_of_end(trapezoid_work *w, const geom_plane *plane, const trapezoid_part *f, int end) {
    num_context *context = &w->set.context;
    if (!(f->end[end] & TREE_EDGE_CUT)) return geom_side_vertex(context, plane, f->p[end]);
    const int left = geom_side_vertex(context, plane, f->p[LEFT]),
              right = geom_side_vertex(context, plane, f->p[RIGHT]);
    if (left == right) return left;
    const geom_plane by = split_plane_at(&w->set, f->end[end] & ~TREE_EDGE_CUT);
    return geom_side_crossing(context, plane, f->p[LEFT], f->p[RIGHT], &by);
}

/** The side of the cut, a wall, on which one end of the part is. Vertices and walls of vertices are ordered by x and y,
 * without a plane. */
static int side_of_wall(trapezoid_work *w, trapezoid_cut *cut, const trapezoid_part *f, int end) {
    froe_predicate_stats *stats = &w->set.context.stats;
    const double *at = f->end[end] & TREE_EDGE_CUT ? NULL : f->p[end];
    if (!at && cut->name.kind == FROE_CUT_VERTEX) {
        const froe_cut by = split_cut_at(&w->set, f->end[end] & ~TREE_EDGE_CUT);
        if (by.kind == FROE_CUT_VERTEX) at = scene_vertex(w->set.scene, by.id[0]);
    }
    if (!at || cut->name.kind != FROE_CUT_VERTEX) return side_of_end(w, plane_of(w, cut), f, end);
    stats->calls++, stats->by_id++;
    return order_ends(at, scene_vertex(w->set.scene, cut->name.id[0]));
}

static uint8_t class_between(int left, int right) {
    if (left * right < 0) return left < 0 ? SPLIT_BOTH : SPLIT_BOTH | FALLING;
    return left < 0 || right < 0 ? SPLIT_NEG : left || right ? SPLIT_POS : SPLIT_ON;
}

/* ----------------------------------------------------------------- classes -- */

/** Classes beside a wall. Two numbers that are exact need no margin, and are sure unless they are equal. */
static void classify_beside_wall(trapezoid_work *w, const trapezoid_cell *cell, trapezoid_cut *cut, uint32_t of[4]) {
    /* by: left end before, right end before, left end behind, right end behind */
    static const uint8_t classes[16] = {UNSURE, UNSURE,     UNSURE, SPLIT_NEG, UNSURE,    UNSURE, UNSURE, UNSURE,
                                        UNSURE, SPLIT_BOTH, UNSURE, UNSURE,    SPLIT_POS, UNSURE, UNSURE, UNSURE};
    const trapezoid_part *item = w->parts.data + cell->first;
    const double error = w->filtered ? cut->error : (double)INFINITY;
    froe_predicate_stats *stats = &w->set.context.stats;
    for (uint32_t i = 0; i < cell->count; i++) {
        const trapezoid_part *f = item + i;
        const double reach = (error + (double)f->error) * FILTER_UP, from = cut->x - reach, to = cut->x + reach;
        const unsigned left = (unsigned)(f->x[LEFT] < from) | (unsigned)(f->x[LEFT] > to) << 2,
                       right = (unsigned)(f->x[RIGHT] < from) | (unsigned)(f->x[RIGHT] > to) << 2;
        uint8_t class = classes[left | right << 1];
        if (class == UNSURE) {
            class = class_between(side_of_wall(w, cut, f, LEFT), side_of_wall(w, cut, f, RIGHT));
        } else {
            stats->calls += 2, stats->by_id += 2;
        }
        w->set.classes.data[i] = class;
        of[class & 3]++;
    }
}

/** The sign of the number whose double is that far from 0. */
static int sure_sign(double value, double bound) {
    return value > bound ? 1 : value < -bound ? -1 : NUM_UNSURE;
}

/** The side of an end that a cut has made, from the values of the line at the ends of the whole segment: they are
 * interpolated. */
static int side_between(const trapezoid_part *f, int end, const double value[2], double bound) {
    const num_ball left = {value[LEFT], bound}, right = {value[RIGHT], bound};
    num_ball after = filter_difference(f->x[end], f->p[LEFT][0]), before = filter_difference(f->p[RIGHT][0], f->x[end]);
    after.e = (after.e + (double)f->error) * FILTER_UP, before.e = (before.e + (double)f->error) * FILTER_UP;
    return filter_sign(filter_add(filter_mul(left, before), filter_mul(right, after)));
}

/** Of a part whose segment the line touches or crosses, or nearly. */
static uint8_t class_near_line(trapezoid_work *w, trapezoid_cut *cut, const trapezoid_part *f, const double value[2]) {
    int whole[2], side[2];
    num_context *context = &w->set.context;
    for (int k = 0; k < 2; k++) {
        whole[k] = num_filtered_call(context, sure_sign(value[k], cut->bound));
        if (whole[k] != NUM_UNSURE) continue;
        if (!order_ends(f->p[k], cut->ends[LEFT]) || !order_ends(f->p[k], cut->ends[RIGHT]))
            context->stats.calls++, whole[k] = num_by_id(context, 0);
        else
            whole[k] = cut->facing * geom_side_vertex(context, plane_of(w, cut), f->p[k]);
    }
    if (whole[LEFT] == whole[RIGHT]) return class_between(whole[LEFT], whole[RIGHT]);
    for (int k = 0; k < 2; k++) {
        side[k] = whole[k];
        if (!(f->end[k] & TREE_EDGE_CUT)) continue;
        side[k] = w->filtered ? num_filtered_call(context, side_between(f, k, value, cut->bound)) : NUM_UNSURE;
        if (side[k] == NUM_UNSURE) side[k] = cut->facing * side_of_end(w, plane_of(w, cut), f, k);
    }
    return class_between(side[LEFT], side[RIGHT]);
}

/** Classes beside a line. */
static void classify_beside_line(trapezoid_work *w, const trapezoid_cell *cell, trapezoid_cut *cut, uint32_t of[4]) {
    const trapezoid_part *item = w->parts.data + cell->first;
    froe_predicate_stats *stats = &w->set.context.stats;
    const filter_line line = cut->line;
    const double bound = cut->bound;
    w->set.classes.data[0] = SPLIT_ON;
    of[SPLIT_ON]++;
    for (uint32_t i = 1; i < cell->count; i++) {
        const trapezoid_part *f = item + i;
        const double value[2] = {filter_line_value(&line, f->p[LEFT][0], f->p[LEFT][1]),
                                 filter_line_value(&line, f->p[RIGHT][0], f->p[RIGHT][1])};
        const bool above = (value[LEFT] > bound) & (value[RIGHT] > bound),
                   below = (value[LEFT] < -bound) & (value[RIGHT] < -bound);
        uint8_t class = above ? SPLIT_POS : SPLIT_NEG;
        if (above | below)
            stats->calls += 2, stats->filtered += 2;
        else
            class = class_near_line(w, cut, f, value);
        w->set.classes.data[i] = class;
        of[class & 3]++;
    }
}

/* -------------------------------------------------------------------- cuts -- */

/** Does the wall on this side of the cell run through the end of the part? */
static bool is_on_side_wall(trapezoid_work *w, const trapezoid_cell *cell, const trapezoid_part *f, int side) {
    const trapezoid_wall *wall = cell->wall + side;
    if (wall->node == FROE_NONE) return false;
    const double reach = ((double)wall->error + (double)f->error) * FILTER_UP;
    if (w->filtered && (f->x[side] < wall->x - reach || f->x[side] > wall->x + reach)) return false;
    const froe_cut cut = split_cut_at(&w->set, wall->node);
    if (cut.kind == FROE_CUT_VERTEX && !(f->end[side] & TREE_EDGE_CUT))
        return !order_ends(f->p[side], scene_vertex(w->set.scene, cut.id[0]));
    const geom_plane plane = scene_cut_plane(w->set.scene, &cut);
    return !side_of_end(w, &plane, f, side);
}

/** Names the wall that the part needs at one end. False: none, it ends on one. */
static bool name_wall(trapezoid_work *w, const trapezoid_cell *cell, const trapezoid_part *f, int side, froe_cut *cut) {
    split_set *set = &w->set;
    const uint32_t end = f->end[side];
    if (!(end & TREE_EDGE_CUT)) {
        *cut = (froe_cut){.kind = FROE_CUT_VERTEX, .id = {scene_corner(set->scene, object_of(f), end)}};
        return !is_on_side_wall(w, cell, f, side);
    }
    const froe_cut by = split_cut_at(set, end & ~TREE_EDGE_CUT);
    if (by.kind != FROE_CUT_OBJECT || is_on_side_wall(w, cell, f, side)) return false;
    *cut =
        split_cylinder_crossing(set, by.id[0], object_of(f)); /* the segment has its ends on both sides of that line */
    return true;
}

static bool same_ends(const trapezoid_part *f, const trapezoid_part *g) {
    return !order_ends(f->p[LEFT], g->p[LEFT]) && !order_ends(f->p[RIGHT], g->p[RIGHT]);
}

/** Chooses the cut of the cell: left wall, right wall, line. */
static void choose_cut(trapezoid_work *w, const trapezoid_cell *cell, trapezoid_cut *cut) {
    const trapezoid_part *f = w->parts.data + cell->first;
    const froe_scene *scene = w->set.scene;
    const bool point = !order_ends(f->p[LEFT], f->p[RIGHT]);
    cut->has_plane = false;
    cut->facing = 1;
    if (point) cut->name = (froe_cut){.kind = FROE_CUT_VERTEX, .id = {scene_corner(scene, object_of(f), 0)}};
    if (point || name_wall(w, cell, f, LEFT, &cut->name) || name_wall(w, cell, f, RIGHT, &cut->name)) {
        if (cut->name.kind == FROE_CUT_VERTEX) {
            cut->x = scene_vertex(scene, cut->name.id[0])[0], cut->error = 0;
        } else {
            const geom_plane *plane = plane_of(w, cut);
            cut->x = plane->c, cut->error = plane->c_err;
        }
        return;
    }
    cut->name = (froe_cut){.kind = FROE_CUT_OBJECT, .id = {object_of(f)}};
    cut->facing = f->object & TRAPEZOID_TURNED ? -1 : 1;
    memcpy(cut->ends, f->p, sizeof cut->ends);
    cut->line = filter_line_through(f->p[LEFT], f->p[RIGHT], w->filtered);
    cut->bound = w->filtered ? filter_line_bound(&cut->line, w->span[0], w->span[1]) : (double)INFINITY;
}

/** Of equal objects the lowest serves as the cut. True: its line runs from right to left. */
static bool prefer_lowest_line(const trapezoid_work *w, const trapezoid_cell *cell, froe_cut *cut) {
    const trapezoid_part *f = w->parts.data + cell->first;
    bool turned = f->object & TRAPEZOID_TURNED;
    for (uint32_t i = 1; i < cell->count; i++) {
        if (w->set.classes.data[i] != SPLIT_ON || object_of(f + i) >= cut->id[0] || !same_ends(f, f + i)) continue;
        cut->id[0] = object_of(f + i);
        turned = f[i].object & TRAPEZOID_TURNED;
    }
    return turned;
}

/* ------------------------------------------------------------------ dealing -- */

static float error_above(double error) {
    return error > 0 ? (float)(error * (1 + 0x1p-20)) + 0x1p-149f : 0;
}

/** Where the cut ends the two halves of a part. */
static void divide_part(trapezoid_work *w, trapezoid_cut *cut, uint32_t node, trapezoid_part *left,
                        trapezoid_part *right) {
    double x = cut->x, error = cut->error;
    if (cut->name.kind == FROE_CUT_OBJECT) {
        double image[3];
        error = geom_image_crossing(left->p[LEFT], left->p[RIGHT], plane_of(w, cut), image);
        x = image[0];
    }
    const float most = error_above(error);
    left->x[RIGHT] = right->x[LEFT] = x;
    left->end[RIGHT] = right->end[LEFT] = TREE_EDGE_CUT | node;
    left->error = right->error = left->error > most ? left->error : most;
}

/** Replaces the cell's parts by those of its children, which have so many: those of child 1 below, of child 0 on top. A
 * part leaves at most one to child 1, so these close up in place while the others wait aside. `first`: the class of
 * child 0. */
static froe_status deal_parts(trapezoid_work *w, const trapezoid_cell *cell, trapezoid_cut *cut, uint8_t first,
                              const uint32_t counts[2]) {
    const size_t count = (size_t)counts[0] + counts[1];
    if (cell->first + count > INT32_MAX) return FROE_E_LIMIT; /* each becomes a piece at least */
    w->spare.count = 0;
    if ((count > cell->count && !array_reserve(&w->set.alloc, &w->parts, count - cell->count)) ||
        !array_reserve(&w->set.alloc, &w->spare, counts[0]))
        return FROE_E_MEMORY;
    trapezoid_part *item = w->parts.data + cell->first, *second = item, *top = w->spare.data;
    for (uint32_t i = 0; i < cell->count; i++) {
        const uint8_t class = w->set.classes.data[i];
        if (class == SPLIT_ON) continue;
        if (class <= SPLIT_POS) {
            *(class == first ? top++ : second++) = item[i];
            continue;
        }
        trapezoid_part left = item[i], right = left;
        divide_part(w, cut, cell->node, &left, &right);
        const bool left_first = (first == SPLIT_NEG) != !!(class & FALLING);
        *top++ = left_first ? left : right;
        *second++ = left_first ? right : left;
    }
    if (counts[0]) memcpy(second, w->spare.data, counts[0] * sizeof *second);
    w->parts.count = cell->first + count;
    return FROE_OK;
}

/** Begins the list of the node with so many parts that lie in its cut. */
static froe_status list_parts(trapezoid_work *w, const trapezoid_cell *cell, uint32_t count) {
    froe_status status = draft_list(w->set.draft, cell->node - w->set.draft->outer);
    for (uint32_t i = 0; count && i < cell->count && !status; i++)
        if (w->set.classes.data[i] == SPLIT_ON)
            status = emit_part(&w->set, cell->node, w->parts.data + cell->first + i);
    return status;
}

froe_status trapezoid_step(trapezoid_work *w, const trapezoid_cell *cell) {
    if (cell->count <= w->leaf) return end_trapezoid(w, cell);
    split_set *set = &w->set;
    trapezoid_cut cut;
    uint32_t of[4] = {0}, child;
    bool turned = false;
    set->classes.count = 0;
    if (!array_reserve(&set->alloc, &set->classes, cell->count) || !array_reserve(&set->alloc, &w->cells, 2))
        return FROE_E_MEMORY;
    choose_cut(w, cell, &cut);
    const bool line = cut.name.kind == FROE_CUT_OBJECT;
    if (line) {
        classify_beside_line(w, cell, &cut, of);
        turned = prefer_lowest_line(w, cell, &cut.name);
    } else {
        classify_beside_wall(w, cell, &cut, of);
    }
    const uint8_t first = turned ? SPLIT_POS : SPLIT_NEG;
    const uint32_t counts[2] = {of[first] + of[SPLIT_BOTH], of[!first] + of[SPLIT_BOTH]};
    froe_status status = draft_split(set->draft, cell->node - set->draft->outer, &cut.name, 0, &child);
    if (!status) status = list_parts(w, cell, of[SPLIT_ON]);
    if (!status) status = deal_parts(w, cell, &cut, first, counts);
    if (status) return status;
    for (uint32_t side = 2; side-- > 0;) { /* child 0 last, so that it comes first: the draft is in order */
        trapezoid_cell *to = w->cells.data + w->cells.count++;
        *to = *cell;
        to->node = set->draft->outer + child + side;
        to->depth = cell->depth + 1;
        to->first = cell->first + (side ? 0 : counts[1]);
        to->count = counts[side];
        if (!line) to->wall[!side] = (trapezoid_wall){cut.x, error_above(cut.error), cell->node};
    }
    return FROE_OK;
}
