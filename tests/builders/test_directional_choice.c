/* test_directional_choice.c: the cut of each cell beside the one that the stages of build/directional/boxes_sweep.c
 * describe, found from the coordinates alone: all ends are sorted anew, and every box is looked at for each of them. */
#include "base/sort.h"
#include "build/directional/boxes.h"
#include <froe/io.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 160, ENDS = 4 * MOST };

typedef struct candidate {
    boxes_cut cut;
    bool face, paid;
} candidate;

typedef struct oracle {
    const boxes *b;
    const boxes_cell *cell;
    double end[MOST][FROE_MAX_DIM][4];
    unsigned rooms[MOST][FROE_MAX_DIM]; /* bit 0: the one before is alive, 1: the one after */
    candidate all[ENDS];                /* on one axis, ascending */
    uint32_t count;
} oracle;

static uint32_t balance(const boxes_cut *cut) {
    return cut->below < cut->above ? cut->below : cut->above;
}

static void look(oracle *o) {
    for (uint32_t i = 0; i < o->cell->count; i++) {
        boxes_ends(o->b, o->b->fragments.data[o->cell->first + i].object, o->end[i]);
        for (int k = 0; k < o->b->dim; k++) {
            const double *e = o->end[i][k];
            bool before = o->cell->lo[k] < e[BOXES_BEFORE] && e[BOXES_BEFORE] < e[BOXES_LO];
            bool after = e[BOXES_HI] < e[BOXES_AFTER] && e[BOXES_AFTER] < o->cell->hi[k];
            o->rooms[i][k] = (unsigned)before | (unsigned)after << 1;
        }
    }
}

/* 1, 1 + t or 2 + 2 t for none, one or both rooms, over the other axes. */
static int64_t weight(const oracle *o, uint32_t box, int axis) {
    int64_t t = o->b->options.trade, product = 1;
    for (int k = 0; k < o->b->dim; k++)
        if (k != axis && o->rooms[box][k]) product *= o->rooms[box][k] == 3 ? 2 + 2 * t : 1 + t;
    return product;
}

static candidate examine(const oracle *o, int axis, double c) {
    candidate x = {.cut = {.found = true, .axis = axis, .c = c}};
    int64_t divided = 0, rooms = 0;
    for (uint32_t i = 0; i < o->cell->count; i++) {
        const double *e = o->end[i][axis];
        x.cut.below += e[BOXES_HI] <= c;
        x.cut.above += e[BOXES_LO] >= c;
        x.face |= e[BOXES_LO] == c || e[BOXES_HI] == c;
        if (e[BOXES_LO] < c && c < e[BOXES_HI]) x.cut.divided++, divided += weight(o, i, axis);
        if (o->rooms[i][axis] & 1 && e[BOXES_BEFORE] <= c && c <= e[BOXES_LO]) rooms += weight(o, i, axis);
        if (o->rooms[i][axis] & 2 && e[BOXES_HI] <= c && c <= e[BOXES_AFTER]) rooms += weight(o, i, axis);
    }
    x.paid = divided <= o->b->options.trade * rooms;
    return x;
}

static void list_candidates(oracle *o, int axis) {
    double at[ENDS];
    uint32_t count = 0;
    for (uint32_t i = 0; i < o->cell->count; i++)
        for (int e = 0; e < 4; e++) {
            double x = o->end[i][axis][e];
            bool there = e == BOXES_BEFORE  ? o->rooms[i][axis] & 1
                         : e == BOXES_AFTER ? o->rooms[i][axis] >> 1 & 1
                                            : true;
            if (there && o->cell->lo[axis] < x && x < o->cell->hi[axis]) at[count++] = x;
        }
    if (count) base_sort(at, count, sizeof *at, base_compare_doubles);
    o->count = 0;
    for (uint32_t i = 0; i < count; i++)
        if (!i || at[i] != at[i - 1]) o->all[o->count++] = examine(o, axis, at[i]);
}

/* Of those that are allowed, of these the ones that divide fewest (if wanted), of these the best balanced: the first
 * one up to the median or, if it divides fewer, the last one beyond. */
static candidate best_on_axis(const oracle *o, const bool *allowed, bool fewest) {
    uint32_t least = UINT32_MAX, most = 0;
    candidate first = {.face = false}, last = {.face = false};
    for (uint32_t i = 0; i < o->count && fewest; i++)
        if (allowed[i] && o->all[i].cut.divided < least) least = o->all[i].cut.divided;
    for (int turn = 0; turn < 2; turn++)
        for (uint32_t i = 0; i < o->count; i++) {
            const boxes_cut *cut = &o->all[i].cut;
            if (!allowed[i] || (fewest && cut->divided != least)) continue;
            if (!turn && balance(cut) > most) most = balance(cut);
            if (!turn || balance(cut) != most) continue;
            if (cut->below > cut->above) last = o->all[i];
            if (cut->below <= cut->above && !first.cut.found) first = o->all[i];
        }
    return last.cut.found && (!first.cut.found || last.cut.divided < first.cut.divided) ? last : first;
}

static bool better(const boxes_cut *a, const boxes_cut *b, bool fewest) {
    if (!a->found || !b->found) return a->found;
    if (fewest && a->divided != b->divided) return a->divided < b->divided;
    return balance(a) != balance(b) ? balance(a) > balance(b) : a->divided < b->divided;
}

/* The best over all axes, of those with so many boxes on both sides. `narrow`: what rooms pay for, of what divides
 * fewest on its axis. */
static void best(oracle *o, uint32_t enough, bool narrow, boxes_cut *least, boxes_cut *lemma) {
    bool allowed[ENDS];
    for (int k = 0; k < o->b->dim; k++) {
        list_candidates(o, k);
        for (uint32_t i = 0; i < o->count; i++) allowed[i] = o->all[i].face && balance(&o->all[i].cut) >= enough;
        candidate a = best_on_axis(o, allowed, true);
        if (!narrow && better(&a.cut, least, true)) *least = a.cut;
        if (narrow && a.paid && better(&a.cut, lemma, true)) *lemma = a.cut;
        if (narrow) continue;
        for (uint32_t i = 0; i < o->count; i++) allowed[i] = o->all[i].paid && balance(&o->all[i].cut);
        candidate z = best_on_axis(o, allowed, false);
        if (better(&z.cut, lemma, false)) *lemma = z.cut;
    }
}

/* The first face, within the cell, of what its boxes reach over there, if more than 8 are there and one of them reaches
 * over all of it. */
static boxes_cut peel(const oracle *o) {
    const uint32_t count = o->cell->count;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    bool held = false;
    for (int k = 0; k < o->b->dim; k++) {
        lo[k] = INFINITY, hi[k] = -INFINITY;
        for (uint32_t i = 0; i < count; i++) {
            lo[k] = fmin(lo[k], fmax(o->end[i][k][BOXES_LO], o->cell->lo[k]));
            hi[k] = fmax(hi[k], fmin(o->end[i][k][BOXES_HI], o->cell->hi[k]));
        }
    }
    for (uint32_t i = 0; i < count && !held; i++) {
        held = true;
        for (int k = 0; k < o->b->dim; k++) held &= o->end[i][k][BOXES_LO] <= lo[k] && o->end[i][k][BOXES_HI] >= hi[k];
    }
    for (int k = 0; held && count > 8 && k < o->b->dim; k++) {
        const bool below = lo[k] > o->cell->lo[k];
        if (!below && hi[k] == o->cell->hi[k]) continue;
        assert_int_equal(examine(o, k, below ? lo[k] : hi[k]).cut.divided, 0);
        return (boxes_cut){.found = true,
                           .axis = k,
                           .c = below ? lo[k] : hi[k],
                           .below = below ? 0 : count,
                           .above = below ? count : 0};
    }
    return (boxes_cut){.found = false};
}

/* Would a list of the cell be longer by this cut, counted as comparisons, and do half of its pairs overlap? */
static bool crowded(const oracle *o, const boxes_cut *cut) {
    const uint32_t count = o->cell->count;
    const double m = count, left = m - cut->above, right = m - cut->below; /* those in the cut go to neither side */
    uint32_t pairs = 0, together = 0;
    if (o->b->options.faces || !cut->found || !cut->divided || count > 64 || count <= o->b->options.leaf) return false;
    if ((left * left + right * right) / (m * m) + cut->divided / m <= 1) return false;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = i > 32 ? i - 32 : 0; j < i; j++) {
            bool meet = true;
            for (int k = 0; k < o->b->dim; k++)
                meet &= fmin(o->end[i][k][BOXES_HI], o->end[j][k][BOXES_HI]) >
                        fmax(o->end[i][k][BOXES_LO], o->end[j][k][BOXES_LO]);
            pairs++;
            together += meet;
        }
    return 2 * together >= pairs;
}

static boxes_cut choose(oracle *o) {
    boxes_cut least = {.found = false}, lemma = {.found = false};
    const boxes_options *how = &o->b->options;
    look(o);
    best(o, how->faces ? 0 : 1, false, &least, &lemma);
    double share = lemma.found ? how->balance * balance(&lemma) : 0;
    if (least.found && !least.divided && balance(&least) && balance(&least) >= share) return least;
    const boxes_cut outer = peel(o);
    if (outer.found) return outer;
    if (how->slack > 0 && lemma.found && lemma.divided)
        best(o, (uint32_t)fmax(1, ceil((1 - how->slack) * balance(&lemma))), true, NULL, &lemma);
    least.forced = true;
    boxes_cut cut = lemma.found ? lemma : least;
    if (crowded(o, &cut)) cut.found = false;
    return cut;
}

static void compare(const boxes_cut *a, const boxes_cut *b, const char *what) {
    if (a->found != b->found) fail_msg("%s: %s a cut", what, a->found ? "found" : "did not find");
    if (!a->found) return;
    if (a->axis != b->axis || a->c != b->c || a->below != b->below || a->above != b->above ||
        a->divided != b->divided || a->forced != b->forced)
        fail_msg("%s: x[%d] = %.17g, %u | %u, %u divided, in place of x[%d] = %.17g, %u | %u, %u", what, a->axis, a->c,
                 a->below, a->above, a->divided, b->axis, b->c, b->below, b->above, b->divided);
}

/* All cells of a scene; returns how many cuts divide boxes. */
static uint32_t check(const char *kind, size_t n, const boxes_options *options) {
    static oracle o;
    froe_scene *scene = NULL;
    froe_allocator alloc = support_allocator(NULL);
    boxes b;
    boxes_cell root = {.cover = FROE_NONE};
    uint32_t objects[MOST], dividing = 0;
    assert_int_equal(froe_generate(kind, n, 9, NULL, &scene, NULL), FROE_OK);
    assert_true(scene->object_count <= MOST);
    for (uint32_t i = 0; i < scene->object_count; i++) objects[i] = i;
    for (int k = 0; k < scene->dim; k++) root.lo[k] = -INFINITY, root.hi[k] = INFINITY;
    assert_int_equal(boxes_new(scene, &alloc, options, &b), FROE_OK);
    assert_int_equal(boxes_open(&b, root, objects, scene->object_count), FROE_OK);
    while (b.cells.count) {
        boxes_cell cell = b.cells.data[--b.cells.count];
        boxes_cut cut = boxes_sweep(&b, &cell);
        o.b = &b, o.cell = &cell;
        boxes_cut wanted = choose(&o);
        compare(&cut, &wanted, kind);
        dividing += cut.found && cut.divided;
        if (cut.found)
            assert_int_equal(boxes_divide(&b, &cell, &cut), FROE_OK);
        else
            boxes_drop(&b, &cell);
    }
    boxes_free(&b);
    froe_scene_free(scene);
    return dividing;
}

static void cuts_are_the_best_of_all(void **state) {
    static const char *const kinds[] = {"boxes",  "boxes-3d", "rows",   "debris", "sticks",    "slabs",
                                        "panels", "bars",     "shells", "moons",  "debris-3d", "debris-5d"};
    static const boxes_options options[] = {{.delta = 0.5, .trade = 2, .slack = 0.25},
                                            {.delta = 1, .trade = 1, .balance = 0.6},
                                            {.delta = 0.25, .trade = 5, .slack = 0.8, .balance = 1},
                                            {.delta = 0.5, .trade = 2, .slack = 0.25, .faces = true}};
    uint32_t dividing = 0;
    (void)state;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        for (size_t i = 0; i < sizeof options / sizeof *options; i++) {
            bool many = !strcmp(kinds[k], "debris-5d") || !strcmp(kinds[k], "shells");
            dividing += check(kinds[k], many ? 30 : 120, options + i);
        }
    assert_true(dividing > 1000);
}

int main(void) {
    static const struct CMUnitTest tests[] = {cmocka_unit_test(cuts_are_the_best_of_all)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
