/* partition.c: walks the tree with the visible part of each region in hand.
 *
 * A section needs no solids: where a cut meets the section plane it is a line, and
 * the region of the section is split by it as in the plane. So flat views and
 * sections share this walk, which turns back wherever a region is out of
 * the window or too small to be seen, and costs what is seen. */
#include "partition.h"
#include <math.h>
#include <stdlib.h>

typedef struct region_frame {
    froe_node node;
    uint32_t depth;
    size_t first, count; /* its polygon in `stack`, at the end of it when the frame is on top */
} region_frame;

typedef ARRAY(draw_point) point_array;

typedef struct partition_walk {
    const froe_tree *tree;
    const froe_scene *scene;
    const draw_view *view;
    uint32_t max_depth;
    draw_partition *out;
    ARRAY(region_frame) frames;
    point_array stack, ring;
} partition_walk;

typedef struct depth_node {
    froe_node node;
    uint32_t depth;
} depth_node;

bool draw_census_of(const froe_allocator *alloc, const froe_tree *tree, froe_node node, draw_census *out) {
    ARRAY(depth_node) stack = {0};
    draw_census census = {0};
    bool ok = array_push(alloc, &stack, (depth_node){node, 0});
    while (ok && stack.count) {
        depth_node top = stack.data[--stack.count];
        froe_node_info info = froe_tree_node(tree, top.node);
        if (info.cut.kind == FROE_CUT_NONE) {
            census.leaves++;
            census.depths += top.depth;
        } else
            ok = array_push(alloc, &stack, (depth_node){info.child[0], top.depth + 1}) &&
                 array_push(alloc, &stack, (depth_node){info.child[1], top.depth + 1});
    }
    array_free(alloc, &stack);
    *out = census;
    return ok;
}

/* The line in which a cut meets the view's plane. */
typedef struct trace {
    draw_point n;
    double c;
} trace;

static bool push_part(partition_walk *w, froe_node node, uint32_t depth, const trace *line, int side, size_t count) {
    if (!array_reserve(&w->out->alloc, &w->stack, count + 1)) return false;
    size_t first = w->stack.count;
    size_t made = draw_clip_half(w->ring.data, count, line->n, line->c, side ? 1 : -1, w->stack.data + first);
    if (made < 3) return true;
    w->stack.count += made;
    return array_push(&w->out->alloc, &w->frames, (region_frame){node, depth, first, made});
}

static bool split(partition_walk *w, region_frame top, const froe_node_info *info, double size) {
    const draw_view *view = w->view;
    const draw_plane plane = draw_space_plane(&view->space, w->scene, &info->cut);
    const double c = view->axis < 0 ? plane.c : plane.c - plane.n[view->axis] * view->at;
    const trace line = {{plane.n[view->across], plane.n[view->up]}, c};
    if (line.n.x == 0 && line.n.y == 0) {
        /* Parallel: the section lies on one side; within the cut it counts as in front. */
        region_frame same = {info->child[c <= 0], top.depth + 1, top.first, top.count};
        return array_push(&w->out->alloc, &w->frames, same);
    }
    w->ring.count = 0;
    if (!array_reserve(&w->out->alloc, &w->ring, top.count)) return false;
    for (size_t i = 0; i < top.count; i++) w->ring.data[i] = w->stack.data[top.first + i];
    w->stack.count = top.first;
    /* The part of the line inside the convex ring: its two extreme crossings. */
    const draw_point *ring = w->ring.data, along = {-line.n.y, line.n.x};
    draw_point ends[2] = {{0, 0}, {0, 0}};
    double reach[2] = {HUGE_VAL, -HUGE_VAL};
    for (size_t i = 0; i < top.count; i++) {
        draw_point p = ring[i], q = ring[i + 1 < top.count ? i + 1 : 0];
        double d = line.n.x * p.x + line.n.y * p.y - line.c, e = line.n.x * q.x + line.n.y * q.y - line.c;
        if (d != 0 && !(d < 0 && e > 0) && !(d > 0 && e < 0)) continue;
        double t = d == 0 ? 0 : d / (d - e);
        draw_point x = {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
        double s = along.x * x.x + along.y * x.y;
        if (s < reach[0]) reach[0] = s, ends[0] = x;
        if (s > reach[1]) reach[1] = s, ends[1] = x;
    }
    const draw_cut cut = {draw_view_map(view, ends[0]), draw_view_map(view, ends[1]), top.depth, (float)size};
    if (reach[0] < reach[1] && !array_push(&w->out->alloc, &w->out->cuts, cut)) return false;
    return push_part(w, info->child[0], top.depth + 1, &line, 0, top.count) &&
           push_part(w, info->child[1], top.depth + 1, &line, 1, top.count);
}

/* Takes a region off the stack: it is split, or drawn as it is. */
static bool step(partition_walk *w) {
    region_frame top = w->frames.data[--w->frames.count];
    froe_node_info info = froe_tree_node(w->tree, top.node);
    bool leaf = info.cut.kind == FROE_CUT_NONE;
    const draw_point *p = w->stack.data + top.first;
    draw_point lo = p[0], hi = p[0];
    for (size_t i = 1; i < top.count; i++) {
        lo = (draw_point){fmin(lo.x, p[i].x), fmin(lo.y, p[i].y)};
        hi = (draw_point){fmax(hi.x, p[i].x), fmax(hi.y, p[i].y)};
    }
    double size = fmax(hi.x - lo.x, hi.y - lo.y) * w->view->scale;
    if (!leaf && (!w->max_depth || top.depth < w->max_depth) && size >= w->view->detail)
        return split(w, top, &info, size);
    draw_partition *out = w->out;
    double depth = top.depth;
    if (!leaf) {
        draw_census census;
        if (!draw_census_of(&out->alloc, w->tree, top.node, &census)) return false;
        if (!w->max_depth || top.depth < w->max_depth) depth += (double)census.depths / (double)census.leaves;
        out->merged++;
        out->merged_leaves += census.leaves;
    }
    if (!array_reserve(&out->alloc, &out->points, top.count)) return false;
    draw_cell cell = {out->points.count, (uint32_t)top.count, depth};
    for (size_t i = 0; i < top.count; i++)
        out->points.data[out->points.count++] = draw_view_map(w->view, w->stack.data[top.first + i]);
    w->stack.count = top.first;
    return array_push(&out->alloc, &out->cells, cell);
}

froe_status draw_partition_add(draw_partition *out, const froe_tree *tree, const draw_view *view, uint32_t max_depth,
                               draw_task *task) {
    partition_walk w = {.tree = tree, .scene = froe_tree_scene(tree), .view = view, .max_depth = max_depth, .out = out};
    const draw_point lo = view->lo, hi = view->hi, window[4] = {lo, {hi.x, lo.y}, hi, {lo.x, hi.y}};
    bool ok = array_push(&out->alloc, &w.frames, (region_frame){froe_tree_root(tree), 0, 0, 4});
    for (int i = 0; i < 4 && ok; i++) ok = array_push(&out->alloc, &w.stack, window[i]);
    while (ok && w.frames.count && draw_tick(task)) ok = step(&w);
    array_free(&out->alloc, &w.frames);
    array_free(&out->alloc, &w.stack);
    array_free(&out->alloc, &w.ring);
    return !ok ? FROE_E_MEMORY : task->cancelled ? FROE_E_CANCELLED : FROE_OK;
}

static int by_value(const void *a, const void *b) {
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

bool draw_partition_scale(draw_partition *part) {
    size_t count = part->cells.count;
    if (!count) return true;
    double *depths = support_calloc(&part->alloc, count, sizeof *depths);
    if (!depths) return false;
    for (size_t i = 0; i < count; i++) depths[i] = part->cells.data[i].depth;
    qsort(depths, count, sizeof *depths, by_value);
    part->lo_depth = floor(depths[count / 50]);
    part->hi_depth = ceil(depths[count - 1 - count / 100]);
    part->below = depths[0] < part->lo_depth;
    part->above = depths[count - 1] > part->hi_depth;
    support_free(&part->alloc, depths, count * sizeof *depths);
    return true;
}

void draw_partition_free(draw_partition *partition) {
    array_free(&partition->alloc, &partition->points);
    array_free(&partition->alloc, &partition->cells);
    array_free(&partition->alloc, &partition->cuts);
}
