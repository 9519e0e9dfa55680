/* aspect.c: depth first, with the facets of every waiting cell. */
#include "tree/audit/aspect.h"
#include "num/pair.h"
#include "support/array.h"

enum { NODES = FROE_MAX_DIM + 1 };
#define LACK 0x1p-98 /* of the sizes of two terms: more than their sum in pairs, and the charge, lack */

typedef struct aspect_cell {
    uint32_t node;
    double most[NODES][NODES]; /* INFINITY: there is no such facet */
} aspect_cell;

static bool is_less(num_pair a, num_pair b) {
    return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}

/** Does the cut bound a difference of two coordinates, or one and 0? n . x = x_i - x_j. */
static bool find_difference(const froe_cut *cut, int dim, int *i, int *j) {
    int count = 0;
    *i = *j = dim;
    if (cut->kind == FROE_CUT_AXIS) *i = cut->axis;
    for (int k = 0; k < dim && cut->kind == FROE_CUT_PLANE; k++) {
        count += cut->normal[k] != 0;
        if (cut->normal[k] == 1) *i = k;
        if (cut->normal[k] == -1) *j = k;
    }
    return *i != *j && count == (cut->kind == FROE_CUT_PLANE) * ((*i < dim) + (*j < dim));
}

/** The largest x_i - x_j of the cell; each sum is off by less than `charge` of its terms' sizes, and charged for it:
 * upwards, or downwards where that is negative. */
static void add_up(const aspect_cell *cell, int dim, double charge, num_pair most[NODES][NODES]) {
    for (int i = 0; i <= dim; i++)
        for (int j = 0; j <= dim; j++) most[i][j] = (num_pair){i == j ? 0 : cell->most[i][j], 0};
    for (int k = 0; k <= dim; k++)
        for (int i = 0; i <= dim; i++)
            for (int j = 0; j <= dim; j++) {
                const num_pair a = most[i][k], b = most[k][j];
                if (i == k || k == j || !(a.hi < INFINITY && b.hi < INFINITY)) continue;
                const num_pair sum = num_pair_add(a, b), more = {charge * (fabs(a.hi) + fabs(b.hi)), 0};
                const num_pair charged = num_pair_add(sum, more);
                if (is_less(charged, most[i][j])) most[i][j] = charged;
            }
}

static double aspect_of_cell(const aspect_cell *cell, int dim) {
    num_pair upper[NODES][NODES], lower[NODES][NODES];
    double widest = 0, narrowest = INFINITY;
    add_up(cell, dim, LACK, upper);
    add_up(cell, dim, -LACK, lower);
    for (int i = 0; i <= dim; i++)
        for (int j = 0; j < i; j++) {
            const double length = i < dim ? sqrt(2) : 1;
            const double size = LACK * (fabs(lower[i][j].hi) + fabs(lower[j][i].hi));
            widest = fmax(widest, num_pair_add(upper[i][j], upper[j][i]).hi / length);
            narrowest = fmin(narrowest, (num_pair_add(lower[i][j], lower[j][i]).hi - size) / length);
        }
    return narrowest > 0 ? widest / narrowest * (1 + 0x1p-48) : (double)INFINITY;
}

froe_status tree_aspect(const froe_tree *t, double *out) {
    ARRAY(aspect_cell) cells = {0};
    const int dim = t->scene->dim;
    aspect_cell root = {.node = 0};
    for (int i = 0; i < NODES; i++)
        for (int j = 0; j < NODES; j++) root.most[i][j] = INFINITY;
    for (int k = 0; k < dim; k++) root.most[k][dim] = t->meta.root_hi[k], root.most[dim][k] = -t->meta.root_lo[k];
    bool memory = array_push(&t->alloc, &cells, root);
    *out = 1;
    while (memory && cells.count) {
        const aspect_cell cell = cells.data[--cells.count];
        const tree_node *n = t->nodes + cell.node;
        int i, j;
        if (cell.node) *out = fmax(*out, aspect_of_cell(&cell, dim));
        if (tree_is_leaf(n) || !(n->flags & TREE_GUARD)) continue;
        const froe_cut cut = tree_cut_at(t, cell.node);
        aspect_cell below = cell, above = cell;
        below.node = n->child;
        above.node = n->child + 1;
        if (find_difference(&cut, dim, &i, &j)) {
            below.most[i][j] = cut.value;
            above.most[j][i] = -cut.value;
        } else {
            *out = INFINITY;
        }
        memory = array_push(&t->alloc, &cells, above) && array_push(&t->alloc, &cells, below);
    }
    array_free(&t->alloc, &cells);
    return memory ? FROE_OK : FROE_E_MEMORY;
}
