/* bar.c: balanced aspect ratio: cells that stay fat, in a tree that stays low.
 *
 *     +-------+---+----+      points:  every cut is perpendicular to one of a few directions, leaves two fat cells, and
 *     | .   . | ./|    |               at most three of them leave no more than two thirds (space: three quarters) of
 *     |      /| / |  . |               the points. A convex range meets O(1/eps^(d-1)) cells of its size, and O(1) of
 *     |    /  |/  |----|               each larger size.
 *     | ./    | . | .  |      objects: the same on guards (build/bar/bar_guards.h). Objects are carried down, and
 *     +-------+---+----+               guards of objects that a cell has lost are forgotten, before its cut is chosen.
 *
 * Duncan, Goodrich and Kobourov (1999); de Berg and Streppel, "Approximate range searching using binary space
 * partitions", section 4, theorem 3. The guards of a cell are made from the objects in it: that is all the pruning
 * there is. What stays together in cells of few guards is refined as by density, but not fat any more.
 *
 * Beyond space cells are zones (build/bar/zone.h), which take few sums to describe. Where there are no directions
 * (option directions=0, or coordinates near the ends of doubles) cells are cubes, and the cuts those of a guard tree
 * (build/bar/cube_cut.h): fat, but not always low. */
#include "build/bar/bar_cut.h"
#include "build/bar/bar_guards.h"
#include "build/bar/cube_cut.h"
#include "build/bar/zone_cut.h"
#include "build/bar/zone_guard.h"
#include "build/method.h"
#include "split/axial.h"
#include "split/finish/finish.h"
#include "split/guard/guard_grid.h"
#include "support/fail.h"
#include <math.h>
#include <stdatomic.h>
#include <string.h>

enum { DIRECTIONS, ASPECT, GUARDS, GROWTH, TUNING, K, STOP };
enum { ZONE_ASPECT = 29 }; /* 20 sqrt 2, rounded up */
enum {
    LONG = 32,        /* objects of a cell that takes long enough to ask whether to go on */
    STAR = 1024,      /* most objects of a cell that may be left when no cut balances its guards */
    SAMPLE = 1 << 18, /* guards of a cell of objects that are read, at most */
    PATIENCE = 24,    /* cuts after which such a cell is left: a guard in the tip of a large cell takes some */
    SEQUENCE = 3,     /* cuts that bring down a cell's points, at most; of zones there may be more */
    FRUITLESS = 100   /* cuts of zones in a row after which a cell of objects is left */
};
#define LARGEST 0x1p1000  /* coordinates up to this have keys */
#define SMALLEST 0x1p-900 /* and differences, if the largest is above this */

static const char *const guard_kinds[] = {"hemisphere", "pairs", "boxes", NULL};
static const froe_option_info options[] = {
    [DIRECTIONS] = {"directions",
                    "of cuts: 3 or 4 in the plane, 7 in space, 10 to 36 beyond; 0: cells are cubes; -1: by dimension",
                    -1, -1, 36, NULL, true},
    [ASPECT] = {"aspect", "largest aspect ratio of a cell; -1: by directions", -1, -1, 1e6, NULL, false},
    [GUARDS] = {"guards", "of an object: hemisphere (6, 8, 32), pairs (of directions: 12, 24), boxes (no guarantee)", 0,
                0, 2, guard_kinds, true},
    [GROWTH] = {"growth", "fragments per object at which the guard stage gives a cell up; 0: never; -1: by dimension",
                -1, -1, 1e9, NULL, false},
    [TUNING] = {0},
    [K] = {"k", "guards left in a cell of the guard stage; -1: by kinds and dimension", -1, -1, 1e9, NULL, true},
    [STOP] = {"stop", "the guard stage leaves cells of so many objects to refinement; -1: by kinds", -1, -1, 1e9, NULL,
              true},
    {0},
};

/* Notes on the cells of all threads. */
typedef struct bar_notes {
    atomic_uint_least32_t unbalanced; /* cells whose points no sequence of cuts has brought down */
    atomic_uint_least32_t sequence;   /* most cuts of zones until one had */
    _Atomic double aspect;
} bar_notes;

typedef struct bar {
    build_job *job;
    bar_notes *notes;
    split_refine refine;
    bar_rule rule;
    bar_guards guards;
    uint32_t *originals; /* lowest equal object: the others have no guards of their own */
    bar_region root;
    bar_zone root_zone;
    double share; /* of its points that a cell's sequence of cuts may leave together */
    uint32_t k, stop;
    bool cubes, zones, points; /* points: there is nothing else */
} bar;

/* What a thread works with. */
typedef struct bar_scratch {
    split_scratch refine; /* first: what refinement keeps */
    bar_search search;
    zone_search zones;
    bool planned;
    uint32_t count; /* guards of the cell at hand */
    double target;
    froe_cut cut;
} bar_scratch;

static bool points_only(const froe_scene *scene) {
    uint32_t i = 0;
    while (i < scene->object_count && scene_form(scene, i) == FROE_POINT) i++;
    return i == scene->object_count;
}

static double largest_coordinate(const froe_scene *scene) {
    double most = 0;
    for (int k = 0; k < scene->dim && scene->object_count; k++)
        most = fmax(most, fmax(fabs(scene->lo[k]), fabs(scene->hi[k])));
    return most;
}

static bool has_keys(const froe_scene *scene) {
    const double most = largest_coordinate(scene);
    return most == 0 || (most >= SMALLEST && most <= LARGEST);
}

static void resolve_bar(const froe_scene *scene, uint32_t leaf, double *option) {
    const bool points = points_only(scene);
    (void)leaf;
    const int zones = scene->dim * (scene->dim + 1) / 2;
    if (option[DIRECTIONS] < 0)
        option[DIRECTIONS] = !has_keys(scene) ? 0 : scene->dim == 2 ? 4 : scene->dim == 3 ? 7 : zones;
    if (option[ASPECT] < 0) option[ASPECT] = scene->dim > 3 ? ZONE_ASPECT : option[DIRECTIONS] == 4 ? 4 : 6;
    if (option[K] < 0) option[K] = points ? 1 : scene->dim == 2 ? 12 : scene->dim == 3 ? 32 : 4;
    if (option[STOP] < 0) option[STOP] = points ? 0 : 8;
    if (option[GROWTH] < 0) option[GROWTH] = scene->dim == 2 ? 4 : 16;
}

/* ------------------------------------------------------------ guards of a cell -- */

/** The keys of all guards inside, or of those of a sample of the objects. */
static bool gather_guards(const bar *b, const split_work *work, const split_cell *cell, const bar_region *region) {
    bar_scratch *scratch = work->scratch;
    bar_search *s = &scratch->search;
    const split_set *set = &work->set;
    const froe_scene *scene = b->job->scene;
    const split_directions *directions = &b->rule.directions;
    const uint64_t all = (uint64_t)cell->count * b->guards.count;
    const uint32_t stride = b->points ? 1 : (uint32_t)(all / SAMPLE) + 1;
    s->keys.count = 0;
    for (uint32_t i = 0; i < cell->count; i += stride) {
        const uint32_t object = set->items.data[cell->first + i].object;
        if (b->originals[object] != object) continue;
        double guards[BAR_GUARDS_MOST * 3];
        const uint32_t count = bar_guards_of(&b->guards, scene, object, guards);
        const bool point = scene_form(scene, object) == FROE_POINT; /* it is inside, whatever keys say */
        if (!array_reserve(&set->alloc, &s->keys, count * (size_t)directions->count)) return false;
        for (uint32_t j = 0; j < count; j++) {
            double *keys = s->keys.data + s->keys.count;
            bool inside = true; /* strictly between all facets */
            for (int n = 0; n < directions->count; n++) {
                keys[n] = split_key(directions, n, guards + j * (size_t)scene->dim);
                inside = inside && keys[n] > region->lo[n] && keys[n] < region->hi[n];
            }
            if (point || inside) s->keys.count += (size_t)directions->count;
        }
    }
    scratch->count = (uint32_t)(s->keys.count / (size_t)directions->count);
    return true;
}

/* -------------------------------------------------------------- the next cut -- */

static bool plan_cube(const bar *b, const split_work *work, const split_cell *cell, const bar_region *box,
                      froe_cut *cut) {
    const int dim = b->job->scene->dim;
    cube_guards g;
    uint64_t count = 0;
    for (int k = 0; k < dim; k++) g.lo[k] = INFINITY, g.hi[k] = -INFINITY;
    for (uint32_t i = 0; i < cell->count; i++) {
        const uint32_t object = work->set.items.data[cell->first + i].object;
        if (b->originals[object] != object) continue;
        /* the corners of the object's box that are strictly inside: as many as the ends that are, multiplied */
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        bool in[2][FROE_MAX_DIM];
        uint64_t corners = 1;
        scene_object_bounds(b->job->scene, object, lo, hi);
        for (int k = 0; k < dim; k++) {
            in[0][k] = lo[k] > box->lo[k] && lo[k] < box->hi[k];
            in[1][k] = hi[k] > box->lo[k] && hi[k] < box->hi[k];
            corners *= (uint64_t)in[0][k] + (in[1][k] && hi[k] > lo[k]);
        }
        for (int k = 0; k < dim && corners; k++) {
            g.lo[k] = fmin(g.lo[k], in[0][k] ? lo[k] : hi[k]);
            g.hi[k] = fmax(g.hi[k], in[1][k] ? hi[k] : lo[k]);
        }
        count += corners;
    }
    return count > b->k && cube_cut(box, dim, &g, !b->points, cut);
}

static froe_status plan_bar(const bar *b, const split_work *work, const split_cell *cell, const bar_region *region,
                            bar_scratch *s) {
    bar_candidate c;
    if (!gather_guards(b, work, cell, region)) return FROE_E_MEMORY;
    if (s->count <= b->k) return FROE_OK;
    const bool old = region->goal && s->count > region->goal;
    s->target = old ? region->goal : floor(b->share * s->count);
    bar_found found = bar_search_cut(&b->rule, &work->set.alloc, &s->search, region, s->count, s->target, &c);
    if (found == BAR_MEMORY) return FROE_E_MEMORY;
    const bool stuck = found == BAR_UNBALANCED && old && region->cuts >= PATIENCE;
    if (found == BAR_NONE || (stuck && !b->points && cell->count <= STAR)) return FROE_OK;
    if (found == BAR_UNBALANCED || (old && region->cuts >= SEQUENCE)) atomic_fetch_add(&b->notes->unbalanced, 1);
    const double aspect = c.aspect[0] > c.aspect[1] ? c.aspect[0] : c.aspect[1];
    double most = atomic_load(&b->notes->aspect);
    while (aspect > most && !atomic_compare_exchange_weak(&b->notes->aspect, &most, aspect)) continue;
    s->cut = split_directions_cut(&b->rule.directions, c.direction, c.value);
    s->planned = true;
    return FROE_OK;
}

/** The guards inside of all objects that are not large, one each. */
static bool gather_zone_guards(const bar *b, const split_work *work, const split_cell *cell, const bar_zone *zone) {
    bar_scratch *s = work->scratch;
    const split_set *set = &work->set;
    const froe_scene *scene = b->job->scene;
    const size_t dim = (size_t)scene->dim;
    s->zones.rows.count = 0;
    if (!array_reserve(&set->alloc, &s->zones.rows, cell->count * dim)) return false;
    for (uint32_t i = 0; i < cell->count; i++) {
        const uint32_t object = set->items.data[cell->first + i].object;
        double *row = s->zones.rows.data + s->zones.rows.count;
        if (b->originals[object] != object) continue;
        if (scene_form(scene, object) == FROE_POINT) /* it is inside, whatever sums of doubles say */
            memcpy(row, scene_point(scene, object, 0), dim * sizeof *row);
        else if (!zone_guard_of(scene, object, zone, row))
            continue;
        s->zones.rows.count += dim;
    }
    s->count = (uint32_t)(s->zones.rows.count / dim);
    return true;
}

static froe_status plan_zone(const bar *b, const split_work *work, const split_cell *cell, const bar_zone *zone,
                             bar_scratch *s) {
    if (!gather_zone_guards(b, work, cell, zone)) return FROE_E_MEMORY;
    if (s->count <= b->k || s->count < 2) return FROE_OK;
    const bool old = zone->goal && s->count > zone->goal && s->count / 2 <= zone->goal;
    const uint32_t cuts = old ? zone->cuts + 1 : 1;
    if (!b->points && cuts > FRUITLESS) return FROE_OK;
    s->target = old ? zone->goal : floor(b->share * s->count);
    const bar_found found = zone_search_cut(&work->set.alloc, &s->zones, zone, b->job->scene->dim, s->count,
                                            (uint32_t)s->target, b->rule.aspect, &s->cut);
    uint32_t most = atomic_load(&b->notes->sequence);
    while (cuts > most && !atomic_compare_exchange_weak(&b->notes->sequence, &most, cuts)) continue;
    s->planned = found == BAR_CUT;
    return found == BAR_MEMORY ? FROE_E_MEMORY : FROE_OK;
}

/** Where a cell lies: kept in its room. */
static bar_region region_of(const bar *b, const split_work *work, const split_cell *cell) {
    bar_region region = b->root;
    if (cell->depth) memcpy(&region, split_room(work), sizeof region);
    return region;
}

static bar_zone zone_of(const bar *b, const split_work *work, const split_cell *cell) {
    bar_zone zone = b->root_zone;
    if (cell->depth) memcpy(&zone, split_room(work), sizeof zone);
    return zone;
}

/** Finds the cut of the guard stage, if the cell is still in it. */
static froe_status plan_cut(const bar *b, const split_work *work, const split_cell *cell, bar_scratch *s) {
    const double growth = b->job->option[GROWTH];
    const bool enough = cell->count <= b->stop || (growth > 0 && cell->growth >= growth);
    froe_status status = FROE_OK;
    if (cell->count <= b->refine.leaf) return status;
    if (b->zones) {
        const bar_zone zone = zone_of(b, work, cell);
        if (isnan(zone.most[0][0])) return status;
        if (!enough) status = plan_zone(b, work, cell, &zone, s);
    } else {
        const bar_region region = region_of(b, work, cell);
        if (isnan(region.lo[0])) return status;
        if (!enough && b->cubes) s->planned = plan_cube(b, work, cell, &region, &s->cut);
        if (!enough && !b->cubes) status = plan_bar(b, work, cell, &region, s);
    }
    if (!s->planned && s->count > 1) atomic_fetch_add(&b->notes->unbalanced, 1);
    return status;
}

static froe_status finish_bar_cell(const void *config, split_work *work, const split_cell *cell, bool *done) {
    bar_scratch *s = work->scratch;
    const bar *b = config;
    if (cell->count >= LONG && !split_go_on(work)) return FROE_E_CANCELLED;
    s->planned = false;
    s->count = cell->count;
    const froe_status status = plan_cut(b, work, cell, s);
    return status || s->planned ? status : split_finish(&b->refine, work, cell, done);
}

static split_verdict choose_bar_cut(const void *config, split_work *work, const split_cell *cell, froe_cut *cut) {
    const bar_scratch *s = work->scratch;
    if (!s->planned) return split_refine_choose(&((const bar *)config)->refine, work, cell, cut);
    *cut = s->cut;
    return SPLIT_CUT_GUARD;
}

/** Notes how many cuts a sequence has taken. */
static void count_cut(const bar_scratch *s, uint32_t *goal, uint32_t *cuts) {
    *cuts = *goal == (uint32_t)s->target ? *cuts + 1 : 1;
    *goal = (uint32_t)s->target;
}

static void divide_zone(const bar *b, const split_work *work, const split_cell *cell, const froe_cut *cut, bool guard,
                        void *positive, void *negative) {
    const bar_scratch *s = work->scratch;
    bar_zone above = zone_of(b, work, cell);
    if (guard) count_cut(s, &above.goal, &above.cuts), above.cluster = s->zones.cluster;
    if (!guard) above.most[0][0] = NAN; /* nothing is known of the shape of cells below */
    bar_zone below = above;
    if (guard) {
        bar_zone_divide(&above, &s->zones.shape, cut, 1);
        bar_zone_divide(&below, &s->zones.shape, cut, 0);
    }
    memcpy(positive, &above, sizeof above);
    memcpy(negative, &below, sizeof below);
}

static void divided(const void *config, const split_work *work, const split_cell *cell, const froe_cut *cut, bool guard,
                    void *positive, void *negative) {
    const bar *b = config;
    const bar_scratch *s = work->scratch;
    if (b->zones) {
        divide_zone(b, work, cell, cut, guard, positive, negative);
        return;
    }
    bar_region above = region_of(b, work, cell);
    if (guard && !b->cubes) count_cut(s, &above.goal, &above.cuts);
    bar_region below = above;
    if (guard) {
        const int i = b->cubes ? cut->axis : split_direction_of(&b->rule.directions, cut);
        above.lo[i] = below.hi[i] = cut->value;
    } else { /* nothing is known of the shape of cells below */
        above.lo[0] = below.lo[0] = NAN;
    }
    memcpy(positive, &above, sizeof above);
    memcpy(negative, &below, sizeof below);
}

/* -------------------------------------------------------------------- build -- */

static froe_status scratch_new(const void *config, split_work *work) {
    (void)config;
    work->scratch = support_calloc(&work->set.alloc, 1, sizeof(bar_scratch));
    return work->scratch ? split_scratch_begin(&work->set.alloc, &((bar_scratch *)work->scratch)->refine)
                         : FROE_E_MEMORY;
}

static void scratch_free(split_work *work) {
    bar_scratch *s = work->scratch;
    if (!s) return;
    split_scratch_end(&work->set.alloc, &s->refine);
    bar_search_free(&work->set.alloc, &s->search);
    zone_search_free(&work->set.alloc, &s->zones);
    support_free(&work->set.alloc, s, sizeof *s);
    work->scratch = NULL;
}

static void note_bar(const void *config) {
    const bar *b = config;
    build_job *job = b->job;
    if (job->option[GROWTH] > 0 && !b->points)
        build_promise(job, "guard_fragments", fmax(2 * job->option[GROWTH], 1) * job->scene->object_count, 0);
    if (b->cubes) return;
    /* Cuts beside clusters are proven to keep zones as fat as that, and no fatter (docs/design/bar.md). */
    if (!b->zones || job->option[ASPECT] >= ZONE_ASPECT)
        build_promise(job, "aspect", job->option[ASPECT], atomic_load(&b->notes->aspect)); /* of zones by the audit */
    if (!b->points || atomic_load(&b->notes->unbalanced)) return;
    /* A sequence of cuts until a part has `share` of the points, and so on until there is one; with leaves of no object
     * one more, through that. */
    const double sequence = b->zones ? atomic_load(&b->notes->sequence) : SEQUENCE;
    double height = job->scene->object_count && !job->leaf;
    for (double n = job->scene->object_count; n > 1; n = floor(b->share * n)) height += sequence;
    build_promise(job, "height", height, 0);
}

/** What does not depend on objects one by one. */
static froe_status prepare_bar(bar *b) {
    build_job *job = b->job;
    const int asked = (int)job->option[DIRECTIONS];
    b->points = points_only(job->scene);
    b->cubes = asked == 0;
    b->zones = !b->cubes && job->scene->dim > 3;
    const bool there = b->zones ? asked == job->scene->dim * (job->scene->dim + 1) / 2
                                : split_directions_of(job->scene->dim, asked, &b->rule.directions);
    if (!b->cubes && (!has_keys(job->scene) || !there)) {
        if (has_keys(job->scene))
            return support_fail(job->diag, FROE_E_OPTIONS, "option 'directions': There are no %d in dimension %d.",
                                asked, job->scene->dim);
        return support_fail(job->diag, FROE_E_UNSUPPORTED, "Method 'bar' has no directions for coordinates of %g.",
                            largest_coordinate(job->scene));
    }
    b->share = job->scene->dim == 3 ? 0.75 : 0.67;
    b->rule.aspect = job->option[ASPECT] * (1 - 0x1p-30); /* pays for all rounding */
    if (b->zones) b->rule.aspect /= sqrt(2);              /* differences of coordinates, beside distances */
    b->rule.through = !b->points;
    b->rule.floor = SMALLEST * 0x1p-60;
    b->k = (uint32_t)job->option[K];
    b->stop = (uint32_t)job->option[STOP];
    const bool rays = !b->cubes && !b->zones;
    if (rays) bar_guards_make(&b->rule.directions, (bar_guard_kind)job->option[GUARDS], &b->guards);
    /* a cube that has all guards inside */
    const froe_scene *scene = b->job->scene;
    const int dim = scene->dim;
    guard_cube box, root;
    memcpy(box.lo, scene->lo, sizeof box.lo);
    memcpy(box.hi, scene->hi, sizeof box.hi);
    for (uint32_t i = 0; i < scene->object_count && rays && !b->points; i++) {
        double guards[BAR_GUARDS_MOST * 3];
        const uint32_t count = bar_guards_of(&b->guards, scene, i, guards) * (uint32_t)dim;
        for (uint32_t j = 0; j < count; j++) {
            box.lo[j % (uint32_t)dim] = fmin(box.lo[j % (uint32_t)dim], guards[j]);
            box.hi[j % (uint32_t)dim] = fmax(box.hi[j % (uint32_t)dim], guards[j]);
        }
    }
    guard_root(&box, dim, &root);
    b->root = bar_region_of(dim, root.lo, root.hi);
    if (b->zones) b->root_zone = bar_zone_of(dim, root.lo, root.hi);
    memcpy(b->job->meta.root_lo, root.lo, (size_t)dim * sizeof(double));
    memcpy(b->job->meta.root_hi, root.hi, (size_t)dim * sizeof(double));
    return FROE_OK;
}

static froe_status build_bar(build_job *job, froe_tree **out) {
    bar_notes notes = {0};
    bar b = {.job = job,
             .notes = &notes,
             .refine = split_axial_of(job->scene, job->leaf, job->seed, 1).refine}; /* as density's last stage */
    b.refine.small = FINISH_MOST;
    const size_t bytes = ((size_t)job->scene->object_count + 1) * sizeof *b.originals;
    froe_status status = prepare_bar(&b);
    if (status) return status;
    b.originals = support_realloc(&job->alloc, NULL, 0, bytes);
    if (!b.originals) return support_fail_memory(job->diag);
    status = scene_originals(job->scene, &job->alloc, b.originals);
    split_method method = {.config = &b,
                           .shaped = true,
                           .choose = choose_bar_cut,
                           .finish = finish_bar_cell,
                           .room = b.zones ? sizeof(bar_zone) : sizeof(bar_region),
                           .divided = divided,
                           .note = note_bar,
                           .scratch_new = scratch_new,
                           .scratch_free = scratch_free};
    split_job split = build_split_job(job);
    status = status ? support_fail_memory(job->diag) : split_grow(&split, &method, out);
    support_free(&job->alloc, b.originals, bytes);
    return status;
}

const build_method build_method_bar = {
    .info = {.name = "bar",
             .summary = "fat cells in a low tree: for ranges of any shape, exact or approximate",
             .source = "Duncan, Goodrich and Kobourov 1999; de Berg and Streppel, theorem 3",
             .guarantee = "cells of bounded aspect; points: height O(log n); objects: O(lambda) a cell",
             .kinds = BUILD_SERVES(BUILD_DIMS_ALL, BUILD_KINDS_ALL),
             .options = options},
    .tunable = true,
    .resolve = resolve_bar,
    .build = build_bar,
};
