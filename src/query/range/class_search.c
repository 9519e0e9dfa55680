/* class_search.c: a range is searched for in the cells of all classes. */
#include "query/range/classes.h"
#include "support/fail.h"

typedef struct class_search {
    froe_query *q;
    const query_classes *p;
    const double *lo, *hi; /* of the range */
    bool memory;           /* ran out */
} class_search;

static bool done(const class_search *s) {
    return s->memory || (s->q->range.any && s->q->found.count);
}

/* Tests ids that have not been tested yet. */
static void test_objects(class_search *s, uint32_t first, uint32_t count) {
    froe_query *q = s->q;
    q->stats.leaves++;
    if (!query_expect(q, count)) s->memory = true;
    for (uint32_t i = 0; i < count && !done(s); i++) {
        const uint32_t object = s->p->ids.data[first + i];
        if (query_mark(&q->marks, object) && query_range_meets(q, object, &s->memory)) query_found(q, object);
    }
}

/* ------------------------------------------------------------------ places -- */

/* The first cell of a run for which a test of the cube fails, which then fails for all that follow. */
typedef bool place_test(const query_classes *p, uint32_t cell, const double *corner, int level);
static uint32_t first_without(class_search *s, uint32_t cell, uint32_t end, place_test *test, const double *corner,
                              int level) {
    while (cell < end) {
        const uint32_t middle = cell + (end - cell) / 2;
        s->q->stats.steps++;
        if (test(s->p, middle, corner, level))
            cell = middle + 1;
        else
            end = middle;
    }
    return end;
}

static bool is_not_after(const query_classes *p, uint32_t cell, const double *corner, int level) {
    return cube_compare(p->dim, query_cell_corner(p, cell), p->cells[cell].level, corner, level) <= 0;
}
static bool is_within(const query_classes *p, uint32_t cell, const double *corner, int level) {
    return cube_holds(p->dim, corner, level, query_cell_corner(p, cell));
}

/* The smallest cell that holds the cube, where `cell` is the last one that does not come after it. */
static uint32_t cell_around(class_search *s, uint32_t cell, const double *corner) {
    const query_classes *p = s->p;
    while (cell != FROE_NONE && !query_cell_holds(p, cell, corner)) {
        const uint32_t far = p->cells[cell].jump;
        s->q->stats.steps++;
        cell = far == cell || query_cell_holds(p, far, corner) ? p->cells[cell].parent : far;
    }
    return cell;
}

/* ----------------------------------------------------------- smaller cells -- */

/* A run waits, unless it is empty; there is room. */
static void push_run(class_search *s, uint32_t first, uint32_t end) {
    query_range *r = &s->q->range;
    if (first == end) return;
    r->nodes.data[r->nodes.count++] = first;
    r->nodes.data[r->nodes.count++] = end;
}

static bool range_meets_cube(const class_search *s, const double *corner, int level) {
    double least[FROE_MAX_DIM], lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    bool meets = true;
    for (int k = 0; k < s->p->dim; k++) least[k] = cube_corner(corner[k], level);
    cube_bounds(s->p->dim, least, level, lo, hi);
    for (int k = 0; k < s->p->dim; k++) meets &= lo[k] <= s->hi[k] && s->lo[k] <= hi[k];
    return meets;
}

/* Searches a run of cells, which lie in one cube and so on one side of 0 along each axis, as far as the range meets the
 * least cube around it: the first cell and the others, if it is that cube, otherwise those in the first of the 2^dim
 * parts of the cube and those in the others. False: no memory. */
static bool search_run(class_search *s, uint32_t first, uint32_t end) {
    const query_classes *p = s->p;
    const query_cell *c = p->cells + first;
    const double *from = query_cell_corner(p, first);
    const int digit = cube_highest_digit(p->dim, from, query_cell_corner(p, end - 1), NULL);
    s->q->stats.nodes++;
    if (!range_meets_cube(s, from, c->level > digit ? c->level : digit + 1)) return true;
    if (!array_reserve(&s->q->alloc, &s->q->range.nodes, 4)) return false;
    if (c->level > digit) {
        test_objects(s, c->first, c->own);
        push_run(s, first + 1, end);
    } else {
        const uint32_t upper = first_without(s, first + 1, end, is_within, from, digit);
        push_run(s, upper, end);
        push_run(s, first, upper);
    }
    return true;
}

/* --------------------------------------------------------------- searching -- */

/* What meets the range within a cube. */
static void search_cube(class_search *s, const double *corner, int level) {
    const query_classes *p = s->p;
    query_range *r = &s->q->range;
    const uint32_t after = first_without(s, 0, p->count, is_not_after, corner, level);
    for (uint32_t at = after ? cell_around(s, after - 1, corner) : FROE_NONE; at != FROE_NONE && !done(s);) {
        test_objects(s, p->cells[at].first, p->cells[at].count);
        at = p->cells[at].refers ? p->cells[at].parent : FROE_NONE;
    }
    if (after == p->count || !is_within(p, after, corner, level)) return;
    r->nodes.count = 0;
    s->memory |= !array_reserve(&s->q->alloc, &r->nodes, 2);
    if (!s->memory) push_run(s, after, first_without(s, after, p->count, is_within, corner, level));
    while (r->nodes.count && !done(s)) {
        r->nodes.count -= 2;
        s->memory |= !search_run(s, r->nodes.data[r->nodes.count], r->nodes.data[r->nodes.count + 1]);
    }
}

/* A range with finite bounds, in the cubes of its own class that they meet. */
static void search_cubes(class_search *s) {
    double corner[FROE_MAX_DIM], extent = 0;
    for (int k = 0; k < s->p->dim; k++) extent = fmax(extent, s->hi[k] - s->lo[k]);
    const int level = cube_level(extent);
    const cube_cover cover = cube_cover_of(s->p->dim, s->lo, s->hi, level);
    for (uint32_t which = 0; which < 1u << s->p->dim && !done(s); which++)
        if (cube_cover_at(&cover, which, corner)) search_cube(s, corner, level);
}

froe_status query_classes_search(froe_query *q, froe_diagnostic *diag) {
    const query_classes *p;
    const froe_status status = query_classes_of(q, &p, diag);
    if (status) return status;
    class_search s = {.q = q, .p = p, .lo = q->range.range.lo, .hi = q->range.range.hi};
    bool bounded = true;
    for (int k = 0; k < p->dim; k++) bounded &= isfinite(s.lo[k]) && isfinite(s.hi[k]);
    if (!bounded) return query_range_walk(q) ? support_fail_memory(diag) : FROE_OK;
    search_cubes(&s);
    return s.memory ? support_fail_memory(diag) : FROE_OK;
}
