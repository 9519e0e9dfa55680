/* guard_oracle.h: the guard tree by the letter of its rule, in the slowest way.
 *
 * Walks a tree cube by cube. In each it counts the guards strictly inside, decides by the rule
 * whether there is a leaf, an octree split or a shrink and where its planes are, and looks whether the nodes say
 * the same. So a tree that passes has leaves with at most k guards strictly inside, cubes for cells, and
 * is the one that the rule describes. */
#ifndef FROE_TESTS_SPLIT_GUARD_ORACLE_H
#define FROE_TESTS_SPLIT_GUARD_ORACLE_H
#include "split/guard/guard_tree.h"
#include "support/memory.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct oracle_cell { /* a cube to be checked; its guards are numbers[begin .. end-1] */
    uint32_t node, height;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    size_t begin, end;
} oracle_cell;

typedef struct oracle {
    const split_guard_tree *tree;
    const double *guards;
    int dim;
    uint32_t kill;
    ARRAY(uint32_t) numbers;
    ARRAY(oracle_cell) cells;
    uint64_t leaves, shrinks, octree_steps;
    uint32_t height;
    froe_allocator alloc;
} oracle;

static inline double oracle_x(const oracle *o, uint32_t guard, int axis) {
    return o->guards[(size_t)guard * (size_t)o->dim + (size_t)axis];
}

static inline bool oracle_inside(const oracle *o, uint32_t guard, const double *lo, const double *hi) {
    bool inside = true;
    for (int i = 0; i < o->dim; i++) inside = inside && lo[i] < oracle_x(o, guard, i) && oracle_x(o, guard, i) < hi[i];
    return inside;
}

/* A leaf: its guards are counted. */
static inline void oracle_leaf(oracle *o, uint32_t node, size_t guards, uint32_t height) {
    const split_guard_node *leaf = &o->tree->nodes.data[node];
    assert_int_equal(leaf->child, 0);
    assert_true(guards <= o->tree->k);
    assert_int_equal(leaf->guards, guards < UINT16_MAX ? guards : UINT16_MAX);
    if (height > o->height) o->height = height;
    o->leaves++;
}

/* A cell of the walk, leaf or not. */
static inline void oracle_visit(oracle *o, const oracle_cell *parent, oracle_cell cell) {
    cell.begin = o->numbers.count;
    for (size_t at = parent->begin; at < parent->end; at++)
        if (oracle_inside(o, o->numbers.data[at], cell.lo, cell.hi))
            assert_true(array_push(&o->alloc, &o->numbers, o->numbers.data[at]));
    cell.end = o->numbers.count;
    assert_true(array_push(&o->alloc, &o->cells, cell));
}

/* Follows a cut from node to one of its sides. */
static inline uint32_t oracle_follow(const oracle *o, uint32_t node, int axis, double value, bool above) {
    const split_guard_node *n = &o->tree->nodes.data[node];
    assert_true(n->child > node && n->child + 1 < o->tree->nodes.count);
    assert_int_equal(n->axis, axis);
    assert_true(n->value == value);
    return n->child + above;
}

/* Guards of the cell with no coordinate on a plane, per cell of the cross (bit of plane 0 first). */
static inline void oracle_count(const oracle *o, const oracle_cell *cell, int planes, const int *axes,
                                const double *values, size_t *counts) {
    memset(counts, 0, ((size_t)1 << planes) * sizeof *counts);
    for (size_t at = cell->begin; at < cell->end; at++) {
        size_t code = 0;
        bool dead = false;
        for (int i = 0; i < planes; i++) {
            double x = oracle_x(o, o->numbers.data[at], axes[i]);
            code = 2 * code + (x > values[i]);
            dead = dead || x == values[i];
        }
        if (!dead) counts[code]++;
    }
}

/* ---- shrink */

typedef struct oracle_planes {
    int count, axes[FROE_MAX_DIM];
    double values[FROE_MAX_DIM];
    size_t inner; /* code of the inner cube */
    oracle_cell cube;
} oracle_planes;

/* Is guard a farther along the axis? Equal ones in lexicographic order. */
static inline bool oracle_farther(const oracle *o, uint32_t a, uint32_t b, int axis, bool above) {
    if (oracle_x(o, a, axis) != oracle_x(o, b, axis)) return (oracle_x(o, a, axis) < oracle_x(o, b, axis)) == above;
    for (int i = 0; i < o->dim; i++)
        if (oracle_x(o, a, i) != oracle_x(o, b, i)) return (oracle_x(o, a, i) < oracle_x(o, b, i)) == above;
    return false;
}

static inline uint32_t oracle_farthest(const oracle *o, const uint32_t *left, size_t count, int axis, bool above) {
    size_t best = 0;
    for (size_t at = 1; at < count; at++)
        if (oracle_farther(o, left[at], left[best], axis, above)) best = at;
    return (uint32_t)best;
}

/* Peels one guard off the list; returns the axis and its distance. */
static inline int oracle_peel(const oracle *o, const oracle_cell *cell, size_t corner, uint32_t *left, size_t *count,
                              double *size, double *value) {
    int axis = -1;
    uint32_t best = 0;
    for (int i = 0; i < o->dim; i++) {
        bool above = corner >> (o->dim - 1 - i) & 1;
        uint32_t at = oracle_farthest(o, left, *count, i, above);
        double x = oracle_x(o, left[at], i), far = fabs(x - (above ? cell->hi[i] : cell->lo[i]));
        if (axis >= 0 && far <= *size) continue;
        axis = i;
        best = at;
        *size = far;
        *value = x;
    }
    left[best] = left[--*count];
    return axis;
}

static inline oracle_planes oracle_shrink(const oracle *o, const oracle_cell *cell, size_t corner) {
    oracle_planes p = {.cube = *cell};
    size_t count = cell->end - cell->begin;
    uint32_t *left = malloc(count * sizeof *left);
    double size = 0, value = 0, nearest[FROE_MAX_DIM];
    bool peeled[FROE_MAX_DIM] = {false};
    int last = -1;
    memcpy(left, o->numbers.data + cell->begin, count * sizeof *left);
    for (uint32_t n = 0; n < o->kill; n++) {
        last = oracle_peel(o, cell, corner, left, &count, &size, &value);
        peeled[last] = true;
        nearest[last] = value;
    }
    for (int i = 0; i < o->dim; i++) {
        bool above = corner >> (o->dim - 1 - i) & 1;
        double at = above ? cell->hi[i] - size : cell->lo[i] + size;
        if (count) {
            double x = oracle_x(o, left[oracle_farthest(o, left, count, i, above)], i);
            at = above ? fmin(at, x) : fmax(at, x);
        }
        if (peeled[i]) at = above ? fmax(at, nearest[i]) : fmin(at, nearest[i]);
        if (i == last) at = nearest[i];
        if (!(cell->lo[i] < at && at < cell->hi[i])) continue;
        p.axes[p.count] = i;
        p.values[p.count++] = at;
        p.inner = 2 * p.inner + above;
        *(above ? &p.cube.lo[i] : &p.cube.hi[i]) = at;
    }
    free(left);
    return p;
}

/* Slab by slab: outer guards are those that lie outside first, and on no plane before. */
static inline void oracle_slabs(oracle *o, const oracle_cell *cell, const oracle_planes *p) {
    size_t counts[FROE_MAX_DIM] = {0};
    uint32_t node = cell->node;
    for (size_t at = cell->begin; at < cell->end; at++)
        for (int i = 0; i < p->count; i++) {
            bool above = p->inner >> (p->count - 1 - i) & 1;
            double x = oracle_x(o, o->numbers.data[at], p->axes[i]);
            bool outside = above ? x < p->values[i] : x > p->values[i];
            counts[i] += outside;
            if (outside || x == p->values[i]) break;
        }
    for (int i = 0; i < p->count; i++) {
        bool above = p->inner >> (p->count - 1 - i) & 1;
        oracle_leaf(o, oracle_follow(o, node, p->axes[i], p->values[i], !above), counts[i],
                    cell->height + (uint32_t)i + 1);
        node = oracle_follow(o, node, p->axes[i], p->values[i], above);
    }
    oracle_cell inner = p->cube;
    inner.node = node;
    inner.height = cell->height + (uint32_t)p->count;
    oracle_visit(o, cell, inner);
}

/* A cross: octree split (`only` negative: all cells are cubes) or shrink of form S (one is). */
static inline void oracle_cross(oracle *o, const oracle_cell *cell, int planes, const int *axes, const double *values,
                                long only) {
    size_t counts[1 << FROE_MAX_DIM];
    oracle_count(o, cell, planes, axes, values, counts);
    for (size_t code = 0; code < (size_t)1 << planes; code++) {
        oracle_cell part = *cell;
        for (int i = 0; i < planes; i++) {
            bool above = code >> (planes - 1 - i) & 1;
            part.node = oracle_follow(o, part.node, axes[i], values[i], above);
            *(above ? &part.lo[axes[i]] : &part.hi[axes[i]]) = values[i];
        }
        part.height += (uint32_t)planes;
        if (only < 0 || code == (size_t)only)
            oracle_visit(o, cell, part);
        else
            oracle_leaf(o, part.node, counts[code], part.height);
    }
}

/* Sides alike, but for the rounding of its planes: four units in the last place at most on each level. */
static inline void oracle_cube(const oracle *o, const oracle_cell *cell) {
    double least = INFINITY, most = 0, largest = 0;
    for (int i = 0; i < o->dim; i++) {
        double side = 0.5 * cell->hi[i] - 0.5 * cell->lo[i];
        least = fmin(least, side);
        most = fmax(most, side);
        largest = fmax(largest, fmax(fabs(cell->lo[i]), fabs(cell->hi[i])));
    }
    double unit = fmax(largest * 0x1p-52, 0x1p-1074);
    assert_true(most - least <= 4 * unit * (cell->height / (unsigned)o->dim + 1));
}

static inline void oracle_step(oracle *o, const oracle_cell *cell) {
    size_t count = cell->end - cell->begin, counts[1 << FROE_MAX_DIM], best = 0;
    int axes[FROE_MAX_DIM];
    double mid[FROE_MAX_DIM];
    if (count <= o->tree->k) {
        oracle_leaf(o, cell->node, count, cell->height);
        return;
    }
    oracle_cube(o, cell);
    for (int i = 0; i < o->dim; i++) {
        axes[i] = i;
        mid[i] = 0.5 * cell->lo[i] + 0.5 * cell->hi[i];
        assert_true(cell->lo[i] < mid[i] && mid[i] < cell->hi[i]);
    }
    oracle_count(o, cell, o->dim, axes, mid, counts);
    for (size_t code = 1; code < (size_t)1 << o->dim; code++)
        if (counts[code] > counts[best]) best = code;
    if (count - counts[best] >= o->kill || counts[best] <= o->tree->k) {
        o->octree_steps++;
        oracle_cross(o, cell, o->dim, axes, mid, -1);
        return;
    }
    o->shrinks++;
    oracle_planes p = oracle_shrink(o, cell, best);
    if (o->tree->form == SPLIT_FORM_U)
        oracle_slabs(o, cell, &p);
    else
        oracle_cross(o, cell, p.count, p.axes, p.values, (long)p.inner);
}

/** Checks the tree of these guards. O(guards * height), with little memory beside. */
static inline void oracle_check(const split_guard_tree *tree, const double *guards, size_t count) {
    oracle o = {.tree = tree, .guards = guards, .dim = tree->dim, .kill = tree->k ? tree->k : 1};
    o.alloc = support_allocator(NULL);
    oracle_cell root = {.node = 0};
    memcpy(root.lo, tree->lo, sizeof root.lo);
    memcpy(root.hi, tree->hi, sizeof root.hi);
    for (uint32_t p = 0; p < count; p++)
        if (oracle_inside(&o, p, tree->lo, tree->hi)) assert_true(array_push(&o.alloc, &o.numbers, p));
    root.end = o.numbers.count;
    assert_true(array_push(&o.alloc, &o.cells, root));
    while (o.cells.count) {
        oracle_cell cell = o.cells.data[--o.cells.count];
        o.numbers.count = cell.end; /* what lies above is done */
        oracle_step(&o, &cell);
    }
    assert_int_equal(o.leaves, tree->leaves);
    assert_int_equal(tree->nodes.count, 2 * o.leaves - 1);
    assert_int_equal(o.shrinks, tree->shrinks);
    assert_int_equal(o.octree_steps, tree->octree_steps);
    assert_int_equal(o.height, tree->height);
    assert_true((double)o.leaves <= tree->promised);
    array_free(&o.alloc, &o.numbers);
    array_free(&o.alloc, &o.cells);
}
#endif
