/* guard_phase.c: many levels of the guard tree for one sort of the guards on each axis.
 *
 *     axis 0   - - - x x - x x x x x x x x x x x x x x - -     x: maybe in the cube, -: gone
 *                    ^first                         ^last
 *
 * After Callahan and Kosaraju ("A decomposition of multidimensional point sets", 1995), with arrays for their lists:
 * the phase follows the larger part of the cube down the tree. To find out on which side of a middle plane less lies,
 * it walks from both ends of the axis in turn, place by place, until one side is finished: that side
 * is left behind for good, so that all walks together take O(dim * m). What is left behind has at most
 * half of the places, and the phase ends when half of the guards are gone: hence log m phases deep, however
 * deep the tree is. Parts left behind become items, or leaves. */
#include "split/guard/guard_shrink.h"
#include "split/guard/guard_sort.h"
#include <string.h>

/* Labels of guards: still in the cube; gone; in a list just now. Others: number of their item + FIRST. */
enum { ALIVE, DEAD, LISTED, FIRST };

/* The side of a middle plane that has fewer places. */
typedef struct minor_side {
    bool above;
    uint32_t begin, end;       /* its places */
    uint32_t on_begin, on_end; /* places on the plane */
    uint32_t here, on;         /* guards alive there */
} minor_side;

typedef struct phase {
    guard_peeler peeler;
    guard_worker *w;
    const guard_item *item;
    const double *points;
    int dim;
    uint32_t corner; /* of the shrink in progress */
    base_pair *order[FROE_MAX_DIM];
    uint32_t first[FROE_MAX_DIM], last[FROE_MAX_DIM]; /* all alive guards are at places first .. last - 1 */
    uint32_t *labels;                                 /* [guard] */
    uint32_t *list, listed;
    uint16_t *codes;     /* [place in list] */
    uint32_t *ends;      /* [item] where its guards go next */
    uint32_t items, end; /* end: guards of all items */
    uint32_t rest;       /* label that ALIVE stands for at the end */
    uint32_t alive, node, height;
    guard_cube cube;
    double mid[FROE_MAX_DIM];
} phase;

static uint32_t guard_at(const phase *ph, int axis, uint32_t place) {
    return ph->order[axis][place].value;
}
static bool alive_at(const phase *ph, int axis, uint32_t place) {
    return ph->labels[guard_at(ph, axis, place)] == ALIVE;
}
static const double *point_of(const phase *ph, uint32_t guard) {
    return ph->points + (size_t)guard * (size_t)ph->dim;
}

/* ---- sides and the decision */

/* Walks from both ends until one side is finished. */
static minor_side smaller_side(const phase *ph, int axis) {
    const base_pair *order = ph->order[axis];
    uint64_t middle = base_double_key(ph->mid[axis]);
    uint32_t first = ph->first[axis], last = ph->last[axis], low = first, high = last;
    for (;; low++, high--) {
        if (low == last || order[low].key >= middle) {
            for (high = low; high < last && order[high].key == middle;) high++;
            return (minor_side){.above = false, .begin = first, .end = low, .on_begin = low, .on_end = high};
        }
        if (high == first || order[high - 1].key <= middle) {
            for (low = high; low > first && order[low - 1].key == middle;) low--;
            return (minor_side){.above = true, .begin = high, .end = last, .on_begin = low, .on_end = high};
        }
    }
}

static uint32_t count_alive(const phase *ph, int axis, uint32_t begin, uint32_t end) {
    uint32_t count = 0;
    for (uint32_t place = begin; place < end; place++) count += alive_at(ph, axis, place);
    return count;
}

static void list_alive(phase *ph, int axis, uint32_t begin, uint32_t end) {
    for (uint32_t place = begin; place < end; place++) {
        uint32_t guard = guard_at(ph, axis, place);
        if (ph->labels[guard] != ALIVE) continue;
        ph->labels[guard] = LISTED;
        ph->list[ph->listed++] = guard;
    }
}

/* Is a shrink due? Then *corner is where. */
static bool must_shrink(phase *ph, const minor_side *sides, uint32_t *corner) {
    uint32_t kill = ph->w->plan->kill;
    bool few = true;
    *corner = 0;
    ph->listed = 0;
    for (int i = 0; i < ph->dim && few; i++) {
        uint32_t there = ph->alive - sides[i].here - sides[i].on;
        bool above = (sides[i].here > there) == sides[i].above;
        few = (sides[i].here > there ? there : sides[i].here) + sides[i].on < kill;
        if (few) {
            /* Lists the guards that are not on the fuller side of the axis. When that is the one with fewer places,
             * then half of all guards are there at least, and the phase is about to end: walking over the others is
             * no loss. */
            list_alive(ph, i, sides[i].on_begin, sides[i].on_end);
            if (above != sides[i].above)
                list_alive(ph, i, sides[i].begin, sides[i].end);
            else if (sides[i].above)
                list_alive(ph, i, ph->first[i], sides[i].on_begin);
            else
                list_alive(ph, i, sides[i].on_end, ph->last[i]);
        }
        few = few && ph->listed < kill;
        *corner = 2 * *corner + above;
    }
    for (uint32_t i = 0; i < ph->listed; i++) ph->labels[ph->list[i]] = ALIVE;
    return few && ph->alive - ph->listed > ph->w->plan->k;
}

/* ---- parts left behind */

static guard_item part_of(const phase *ph, uint32_t node, uint32_t count) {
    return (guard_item){.node = node,
                        .height = ph->height,
                        .begin = ph->item->begin + ph->end,
                        .count = count,
                        .side = guard_other_side(ph->item->side)};
}

/* Makes an item or a leaf; *label is the one of its guards. */
static froe_status push_guard_part(phase *ph, uint32_t node, uint32_t count, const guard_cube *cube, uint32_t *label) {
    guard_item part = part_of(ph, node, count);
    bool leaf = count <= ph->w->plan->k;
    *label = leaf ? (uint32_t)DEAD : FIRST + ph->items;
    if (!leaf) {
        ph->ends[ph->items++] = ph->end;
        ph->end += count;
    }
    return guard_push(ph->w, ph->item, &part, cube);
}

/* ---- octree split */

static froe_status split_into_octants(phase *ph, const minor_side *sides) {
    uint32_t counts[GUARD_CELLS + 1] = {0}, labels[GUARD_CELLS + 1], first, cells = 1u << ph->dim, rest = 0;
    /* lists the guards on smaller sides and planes, with the codes of their orthants (dead: one more) */
    ph->listed = 0;
    for (int i = 0; i < ph->dim; i++) {
        list_alive(ph, i, sides[i].begin, sides[i].end);
        list_alive(ph, i, sides[i].on_begin, sides[i].on_end);
    }
    for (uint32_t at = 0; at < ph->listed; at++) {
        const double *x = point_of(ph, ph->list[at]);
        uint32_t code = 0, dead = 0;
        for (int i = 0; i < ph->dim; i++) {
            code = 2 * code + (x[i] > ph->mid[i]);
            dead |= x[i] == ph->mid[i];
        }
        ph->codes[at] = (uint16_t)(dead ? 1u << ph->dim : code);
        counts[ph->codes[at]]++;
    }
    froe_status status = guard_octants(ph->w, ph->node, ph->height, ph->mid, &first);
    ph->height += (uint32_t)ph->dim;
    for (int i = 0; i < ph->dim; i++) rest = 2 * rest + !sides[i].above;
    for (uint32_t code = 0; code < cells && !status; code++) {
        guard_cube cube = ph->cube;
        if (code == rest) continue;
        guard_orthant(&cube, ph->mid, code, ph->dim);
        status = push_guard_part(ph, first + code, counts[code], &cube, &labels[code]);
    }
    if (status) return status;
    labels[cells] = DEAD;
    for (uint32_t at = 0; at < ph->listed; at++) ph->labels[ph->list[at]] = labels[ph->codes[at]];
    /* the orthant that is on the larger sides becomes the cube */
    uint32_t code = 0;
    for (int i = 0; i < ph->dim; i++) {
        code = 2 * code + !sides[i].above;
        *(sides[i].above ? &ph->last[i] : &ph->first[i]) = sides[i].above ? sides[i].on_begin : sides[i].on_end;
    }
    guard_orthant(&ph->cube, ph->mid, code, ph->dim);
    ph->node = first + code;
    ph->alive -= ph->listed;
    return FROE_OK;
}

/* ---- shrink */

/* The end of the axis that is far from the corner. */
static uint32_t far_place(const phase *ph, int axis) {
    return guard_above(ph->corner, ph->dim, axis) ? ph->first[axis] : ph->last[axis] - 1;
}

static const double *phase_farthest(guard_peeler *self, int axis) {
    phase *ph = (phase *)self;
    while (ph->first[axis] < ph->last[axis] && !alive_at(ph, axis, far_place(ph, axis))) {
        if (guard_above(ph->corner, ph->dim, axis))
            ph->first[axis]++;
        else
            ph->last[axis]--;
    }
    return ph->first[axis] < ph->last[axis] ? point_of(ph, guard_at(ph, axis, far_place(ph, axis))) : NULL;
}

static void phase_peel(guard_peeler *self, int axis) {
    phase *ph = (phase *)self;
    uint32_t guard = guard_at(ph, axis, far_place(ph, axis));
    ph->labels[guard] = DEAD;
    ph->list[ph->listed++] = guard;
    ph->alive--;
}

static froe_status shrink_cube(phase *ph, uint32_t corner) {
    guard_shrunk shrunk;
    guard_item here = part_of(ph, ph->node, ph->alive);
    uint32_t inner;
    ph->corner = corner;
    ph->listed = 0;
    guard_shrink_rule(&ph->cube, ph->dim, corner, ph->w->plan->kill, &ph->peeler, &shrunk);
    froe_status status = guard_shrink_nodes(ph->w, &here, &shrunk, &inner);
    if (status) return status;
    for (uint32_t at = 0; at < ph->listed; at++) guard_count(ph->w, ph->node, point_of(ph, ph->list[at]), inner);
    /* guards on the planes of the inner cube die */
    for (int c = 0; c < shrunk.count; c++) {
        int i = shrunk.axes[c];
        const double *point;
        while ((point = phase_farthest(&ph->peeler, i)) && point[i] == shrunk.values[c]) phase_peel(&ph->peeler, i);
    }
    ph->cube = shrunk.cube;
    ph->node = inner;
    ph->height += (uint32_t)shrunk.count;
    return FROE_OK;
}

/* ---- the step */

static froe_status follow_phase(phase *ph) {
    uint32_t half = ph->item->count / 2;
    for (bool begun = false;; begun = true) {
        minor_side sides[FROE_MAX_DIM];
        uint32_t corner;
        if (ph->alive <= ph->w->plan->k || (begun && ph->alive <= half))
            return push_guard_part(ph, ph->node, ph->alive, &ph->cube, &ph->rest);
        if (base_cancelled(ph->w->plan->task)) return FROE_E_CANCELLED;
        for (int i = 0; i < ph->dim; i++) {
            while (ph->first[i] < ph->last[i] && !alive_at(ph, i, ph->first[i])) ph->first[i]++;
            while (ph->first[i] < ph->last[i] && !alive_at(ph, i, ph->last[i] - 1)) ph->last[i]--;
        }
        /* the smaller side of every axis */
        for (int i = 0; i < ph->dim; i++) {
            ph->mid[i] = guard_middle(ph->cube.lo[i], ph->cube.hi[i]);
            sides[i] = smaller_side(ph, i);
            sides[i].here = count_alive(ph, i, sides[i].begin, sides[i].end);
            sides[i].on = count_alive(ph, i, sides[i].on_begin, sides[i].on_end);
        }
        froe_status status = must_shrink(ph, sides, &corner) ? shrink_cube(ph, corner) : split_into_octants(ph, sides);
        if (status) return status;
    }
}

froe_status guard_phase(guard_worker *w, const guard_item *item, const guard_cube *cube) {
    size_t count = item->count, dim = (size_t)w->plan->dim;
    base_pair *room = guard_scratch(w, count * ((dim + 1) * sizeof *room + 3 * sizeof(uint32_t) + sizeof(uint16_t)));
    if (!room) return FROE_E_MEMORY;
    phase ph = {.peeler = {phase_farthest, phase_peel},
                .w = w,
                .item = item,
                .points = guard_points(w, item),
                .dim = w->plan->dim,
                .alive = item->count,
                .node = item->node,
                .height = item->height,
                .cube = *cube};
    for (size_t i = 0; i < dim; i++) {
        ph.order[i] = room + i * count;
        ph.last[i] = item->count;
    }
    guard_sort(ph.points, count, ph.dim, ph.order, room + dim * count);
    ph.labels = memset(room + (dim + 1) * count, 0, count * sizeof *ph.labels);
    ph.list = ph.labels + count;
    ph.ends = ph.list + count;
    ph.codes = (uint16_t *)(ph.ends + count);
    w->phases++;
    froe_status status = follow_phase(&ph);
    /* the guards of all items to where those begin */
    double *to = w->side[guard_other_side(item->side)] + item->begin * dim;
    for (uint32_t guard = 0; guard < item->count && !status; guard++) {
        uint32_t label = ph.labels[guard] == ALIVE ? ph.rest : ph.labels[guard];
        if (label >= FIRST) memcpy(to + ph.ends[label - FIRST]++ * dim, point_of(&ph, guard), dim * sizeof *to);
    }
    return status;
}
