/* box_pairs.c: touching boxes by streamed segment trees (Zomorodian, Edelsbrunner: Fast
 * software for box intersections, 2002).
 *
 * Two boxes touch iff on every axis one holds the low end of the other. So, axis by
 * axis, one set of boxes counts as intervals and one as points (their low ends):
 *
 *     points      .  .   .  .  | .   .   .  .        in the range a .. b of this axis
 *     intervals  ---------------------------------   spans it: all points are in, go to the next axis
 *                      ------- | -------             else: down to the halves it meets
 *
 * The tree is never built; its nodes are frames of an explicit stack that hold copies of their
 * boxes. All coordinates are replaced by ranks, low ends before high ends where they are
 * equal. Ranks are all different, so ranges halve, at most b - a intervals have an end inside,
 * and neither equal coordinates nor nested boxes can spoil the balance. All lists stay sorted
 * along axis 0, where a plain scan ends it. */
#include "geom/meet/box_pairs.h"
#include "base/apart.h"
#include "base/radix.h"
#include "support/array.h"
#include "support/fail.h"

enum {
    AXES = 4,
    SMALL = 64,           /* lists shorter than this are scanned at once */
    LEVELS = 33,          /* of one axis: ranges of 32-bit ranks halve */
    POLL = 1 << 16,       /* pairs between two polls for cancellation */
    SLAB_BOXES = 1 << 10, /* low ends in a slab, the work of one job */
    SLABS = 32
};

typedef struct ranked_box {
    uint32_t id, lo[AXES], hi[AXES]; /* ranks */
} ranked_box;

/* A node of a tree: intervals and points are runs in the worker's arena. */
typedef struct box_frame {
    size_t intervals, interval_count, points, point_count;
    size_t top;    /* the arena above belongs to its children */
    uint32_t a, b; /* the points' low ends on this axis are in a .. b-1 */
    int axis, step;
} box_frame;

typedef struct worker {
    ARRAY(ranked_box) arena;
    box_frame stack[AXES * LEVELS + 1];
    int depth;
    unsigned number;
    uint32_t until_poll;
    base_apart apart;
} worker;

typedef struct box_search {
    const froe_allocator *alloc;
    base_task *task;
    int dim;
    uint32_t count, slabs;
    ranked_box *boxes; /* by lo[0] */
    worker *workers;
    geom_pair_fn *fn;
    void *user;
} box_search;

/* ------------------------------------------------------------------- ranks -- */

/* Ranks of all ends on one axis; a stable sort keeps low ends before equal high ends. */
static void rank_axis(box_search *s, int axis, const double *lo, const double *hi, base_pair *pairs, base_pair *spare) {
    uint32_t n = s->count;
    for (uint32_t i = 0; i < n; i++) {
        size_t at = (size_t)i * (size_t)s->dim + (size_t)axis;
        pairs[i] = (base_pair){base_double_key(lo[at]), i};
        pairs[n + i] = (base_pair){base_double_key(hi[at]), n + i};
    }
    base_radix_sort(pairs, spare, 2 * (size_t)n);
    for (uint32_t rank = 0; rank < 2 * n; rank++) {
        uint32_t end = pairs[rank].value;
        if (end < n)
            s->boxes[end].lo[axis] = rank;
        else
            s->boxes[end - n].hi[axis] = rank;
    }
}

static froe_status rank_boxes(box_search *s, const double *lo, const double *hi) {
    size_t n = s->count, pair_bytes = 4 * n * sizeof(base_pair);
    ranked_box *boxes = support_calloc(s->alloc, n, sizeof *boxes),
               *sorted = support_calloc(s->alloc, n, sizeof *sorted);
    base_pair *pairs = support_realloc(s->alloc, NULL, 0, pair_bytes);
    bool room = boxes && sorted && pairs;
    if (room) {
        s->boxes = boxes;
        for (uint32_t i = 0; i < s->count; i++) boxes[i].id = i;
        for (int axis = 0; axis < s->dim; axis++) rank_axis(s, axis, lo, hi, pairs, pairs + 2 * n);
        for (uint32_t i = 0; i < s->count; i++) pairs[i] = (base_pair){boxes[i].lo[0], i};
        base_radix_sort(pairs, pairs + 2 * n, n);
        for (size_t i = 0; i < n; i++) sorted[i] = boxes[pairs[i].value];
        s->boxes = sorted;
    } else {
        support_free(s->alloc, sorted, n * sizeof *sorted);
    }
    support_free(s->alloc, boxes, n * sizeof *boxes);
    support_free(s->alloc, pairs, pair_bytes);
    return room ? FROE_OK : FROE_E_MEMORY;
}

/* ------------------------------------------------------------------- scans -- */

static bool found(const box_search *s, worker *w, const ranked_box *interval, const ranked_box *point) {
    if (!s->fn(s->user, w->number, interval->id, point->id)) return false;
    if (--w->until_poll) return true;
    w->until_poll = POLL;
    if (w->number == 0) return base_progress(s->task, s->task->done); /* the calling thread */
    return !base_cancelled(s->task);
}

/* Axis 0, the last one: each interval meets a run of the points. */
static bool scan(const box_search *s, worker *w, const box_frame *f) {
    const ranked_box *interval = w->arena.data + f->intervals, *interval_end = interval + f->interval_count;
    const ranked_box *point = w->arena.data + f->points, *point_end = point + f->point_count;
    for (; interval < interval_end; interval++) {
        while (point < point_end && point->lo[0] <= interval->lo[0]) point++;
        for (const ranked_box *p = point; p < point_end && p->lo[0] < interval->hi[0]; p++)
            if (!found(s, w, interval, p)) return false;
    }
    return true;
}

/* Do the boxes touch on the axes from 1 on, the point's low end in the interval on the frame's? */
static bool intervals_touch(const ranked_box *interval, const ranked_box *point, int axis) {
    for (int k = 1; k < axis; k++)
        if (interval->lo[k] >= point->hi[k] || point->lo[k] >= interval->hi[k]) return false;
    return interval->lo[axis] < point->lo[axis] && point->lo[axis] < interval->hi[axis];
}

/* A short list: scan along axis 0 in both roles and look at the other axes pair by pair. */
static bool scan_both(const box_search *s, worker *w, const box_frame *f) {
    const ranked_box *interval = w->arena.data + f->intervals, *interval_end = interval + f->interval_count;
    const ranked_box *point = w->arena.data + f->points, *point_end = point + f->point_count;
    while (interval < interval_end && point < point_end) {
        if (interval->lo[0] < point->lo[0]) {
            for (const ranked_box *p = point; p < point_end && p->lo[0] < interval->hi[0]; p++)
                if (intervals_touch(interval, p, f->axis) && !found(s, w, interval, p)) return false;
            interval++;
        } else {
            for (const ranked_box *i = interval; i < interval_end && i->lo[0] < point->hi[0]; i++)
                if (intervals_touch(i, point, f->axis) && !found(s, w, i, point)) return false;
            point++;
        }
    }
    return true;
}

/* ------------------------------------------------------------------- trees -- */

/* Enters a node; its range shrinks to the low ends that are there. */
static void push_frame(worker *w, box_frame f) {
    f.a = UINT32_MAX;
    f.b = 0;
    for (const ranked_box *p = w->arena.data + f.points, *end = p + f.point_count; p < end; p++) {
        if (p->lo[f.axis] < f.a) f.a = p->lo[f.axis];
        if (p->lo[f.axis] >= f.b) f.b = p->lo[f.axis] + 1;
    }
    f.top = w->arena.count;
    f.step = 0;
    w->stack[w->depth++] = f;
}

static bool spans(const ranked_box *interval, const box_frame *f) {
    return interval->lo[f->axis] < f->a && interval->hi[f->axis] >= f->b;
}

/* Enters the half a .. b of the node with copies of what belongs there. */
static void push_half(worker *w, const box_frame *f, uint32_t a, uint32_t b) {
    box_frame half = {.axis = f->axis, .points = f->top};
    ranked_box *out = w->arena.data + f->top;
    for (const ranked_box *p = w->arena.data + f->points, *end = p + f->point_count; p < end; p++)
        if (p->lo[f->axis] >= a && p->lo[f->axis] < b) *out++ = *p;
    half.point_count = (size_t)(out - w->arena.data) - half.points;
    half.intervals = half.points + half.point_count;
    for (const ranked_box *i = w->arena.data + f->intervals, *end = i + f->interval_count; i < end; i++)
        if (i->lo[f->axis] < b && i->hi[f->axis] > a && !spans(i, f)) *out++ = *i;
    half.interval_count = (size_t)(out - w->arena.data) - half.intervals;
    w->arena.count = half.intervals + half.interval_count;
    push_frame(w, half);
}

/* Takes one step of the node on top: the spanning intervals in both roles on the next axis, then the halves. */
static void step_frame(worker *w, box_frame *f) {
    uint32_t middle = f->a + (f->b - f->a) / 2;
    size_t spanning = w->arena.count - f->top;
    ranked_box *out;
    switch (f->step++) {
    case 0:
        out = w->arena.data + f->top; /* copies the intervals that span the node */
        for (const ranked_box *i = w->arena.data + f->intervals, *end = i + f->interval_count; i < end; i++)
            if (spans(i, f)) *out++ = *i;
        w->arena.count = (size_t)(out - w->arena.data);
        spanning = w->arena.count - f->top;
        push_frame(w, (box_frame){f->top, spanning, f->points, f->point_count, .axis = f->axis - 1});
        break;
    case 1:
        push_frame(w, (box_frame){f->points, f->point_count, f->top, spanning, .axis = f->axis - 1});
        break;
    case 2:
        push_half(w, f, f->a, middle);
        break;
    case 3:
        push_half(w, f, middle, f->b);
        break;
    default:
        w->depth--;
    }
}

/* -------------------------------------------------------------------- jobs -- */

/* One slab of the last axis: the boxes that begin in it against all that meet it. */
static froe_status run_slab(void *user, unsigned number, size_t slab) {
    const box_search *s = user;
    worker *w = s->workers + number;
    int axis = s->dim - 1;
    uint64_t ends = 2 * (uint64_t)s->count;
    uint32_t a = (uint32_t)(ends * slab / s->slabs), b = (uint32_t)(ends * (slab + 1) / s->slabs);
    box_frame all = {.axis = axis};
    w->arena.count = 0;
    w->depth = 0;
    w->number = number;
    w->until_poll = POLL;
    for (int points = 0; points < 2; points++) {
        for (const ranked_box *i = s->boxes, *end = i + s->count; i < end; i++) {
            bool in = i->lo[axis] < b && (points ? i->lo[axis] >= a : i->hi[axis] > a);
            if (in && !array_push(s->alloc, &w->arena, *i)) return FROE_E_MEMORY;
        }
        if (!points) all.interval_count = all.points = w->arena.count;
    }
    all.point_count = w->arena.count - all.points;
    push_frame(w, all);
    while (w->depth) {
        box_frame *f = &w->stack[w->depth - 1];
        if (f->step != 1) w->arena.count = f->top; /* step 1 uses what step 0 copied */
        size_t less = f->interval_count < f->point_count ? f->interval_count : f->point_count;
        if (f->axis && less >= SMALL) {
            if (!array_reserve(s->alloc, &w->arena, f->interval_count + f->point_count)) return FROE_E_MEMORY;
            step_frame(w, f);
            continue;
        }
        w->depth--;
        if (less && !(f->axis ? scan_both(s, w, f) : scan(s, w, f))) return FROE_E_CANCELLED;
    }
    return FROE_OK;
}

froe_status geom_box_pairs(const froe_allocator *alloc, base_task *task, double span, int dim, uint32_t count,
                           const double *lo, const double *hi, geom_pair_fn *fn, void *user) {
    box_search s = {.alloc = alloc, .task = task, .dim = dim, .count = count, .fn = fn, .user = user};
    if (count < 2) return FROE_OK;
    froe_status status = rank_boxes(&s, lo, hi);
    if (status) return status;
    s.slabs = count / SLAB_BOXES < 1 ? 1 : count / SLAB_BOXES > SLABS ? SLABS : count / SLAB_BOXES;
    s.workers = support_calloc(alloc, task->threads, sizeof *s.workers);
    status = s.workers ? base_run(task, span, s.slabs, run_slab, &s) : FROE_E_MEMORY;
    for (unsigned i = 0; s.workers && i < task->threads; i++) array_free(alloc, &s.workers[i].arena);
    support_free(alloc, s.workers, task->threads * sizeof *s.workers);
    support_free(alloc, s.boxes, count * sizeof *s.boxes);
    return status;
}
