/* guard_bucket.c: several octree levels of the guard tree at once.
 *
 * As long as nothing shrinks, the middle planes of an octree are the products of one table of
 * values per axis. So one pass gives each guard the code of its cell on the last level, a histogram
 * of codes summed up over the levels gives the guards of all cells on all levels, and that decides
 * every split. Cells that need a shrink, and those of the last level, become items; guards
 * go straight to them, and those of finished cells nowhere.
 *
 * A guard on a plane dies where that plane splits, so it counts only in the cells above: its key says on which level
 * it dies. Comparisons with the table decide; the product that finds the place in it is only a guess. */
#include "split/guard_work.h"
#include <math.h>
#include <string.h>

#define LEVELS_MAX 7
#define BITS_MAX 15 /* dim * levels; 8 in 8 dimensions */
#define CHUNKS_MAX 64
#define CHUNK_COUNT (1u << 15) /* guards worth a thread's time */
#define PENDING 512            /* (2^dim - 1) * levels + 1 at most */

enum { CODE = (1 << BITS_MAX) - 1, NOWHERE = UINT16_MAX }; /* a key is code + level of death << BITS_MAX, 0: never */

typedef struct axis_table {
    double lo, scale; /* guess of a place: (x - lo) * scale */
    double *bounds;   /* [cells + 2] lo, planes, hi, infinity */
    uint32_t *keys;   /* [cells] bits of the code */
    uint8_t *deaths;  /* [cells] level on which bounds[i] splits; 0 for lo */
} axis_table;

/* A cell: on which level, its code there, its node. */
typedef struct cell {
    uint32_t level, code, node;
} cell;

typedef struct bucket {
    guard_worker *w;
    const guard_item *item;
    const double *points;
    double *to;
    int dim, levels;
    uint32_t cells, codes; /* per axis, in all */
    axis_table axes[FROE_MAX_DIM];
    uint32_t starts[LEVELS_MAX + 2]; /* of levels in a sum */
    uint32_t *keys;                  /* [guard] */
    uint32_t chunks, chunk_count;    /* how the work is shared */
    uint32_t *sums;                  /* [chunk][level, cell]: guards strictly inside */
    uint16_t *routes;                /* [code] the item it belongs to, or NOWHERE */
    uint8_t *depths;                 /* [item] its level */
    uint32_t *ends;                  /* [chunk][item] where its guards go next */
    uint32_t items;
} bucket;

/* ---- tables */

/* Bits of a place on one axis, spread to the bits of the code. */
static uint32_t spread(uint32_t place, int dim, int axis, int levels) {
    uint32_t code = 0;
    for (int bit = 0; bit < levels; bit++) code |= (place >> bit & 1) << (dim * bit + dim - 1 - axis);
    return code;
}

/* False when the cells become so narrow that doubles cannot tell their planes apart. */
static bool fill_bounds(double *bounds, uint32_t cells, double lo, double hi) {
    bounds[0] = lo;
    bounds[cells] = hi;
    bounds[cells + 1] = INFINITY;
    for (uint32_t step = cells; step > 1; step /= 2)
        for (uint32_t i = step / 2; i < cells; i += step)
            bounds[i] = guard_middle(bounds[i - step / 2], bounds[i + step / 2]);
    for (uint32_t i = 0; i < cells; i++)
        if (!(bounds[i] < bounds[i + 1])) return false;
    return true;
}

static bool fill_table(axis_table *t, const bucket *b, const guard_cube *cube, int axis) {
    t->lo = cube->lo[axis];
    t->scale = b->cells / (cube->hi[axis] - cube->lo[axis]);
    for (uint32_t i = 0; i < b->cells; i++) {
        t->keys[i] = spread(i, b->dim, axis, b->levels);
        t->deaths[i] = (uint8_t)(i ? b->levels - __builtin_ctz(i) : 0);
    }
    return fill_bounds(t->bounds, b->cells, cube->lo[axis], cube->hi[axis]);
}

/* ---- keys and counts */

/* Place of x in the table: bounds[place] <= x < bounds[place + 1]. */
static inline uint32_t find(const axis_table *t, uint32_t last, double x) {
    double guess = (x - t->lo) * t->scale;
    uint32_t place = (uint32_t)(guess < last ? guess : last);
    while (x < t->bounds[place]) place--;
    while (x >= t->bounds[place + 1]) place++;
    return place;
}

static inline uint32_t key_of(const bucket *b, const double *x, int dim) {
    uint32_t code = 0, death = LEVELS_MAX + 1;
    for (int i = 0; i < dim; i++) {
        const axis_table *t = &b->axes[i];
        uint32_t place = find(t, b->cells - 1, x[i]);
        code |= t->keys[place];
        if (x[i] == t->bounds[place] && t->deaths[place] < death) death = t->deaths[place];
    }
    return death > LEVELS_MAX ? code : code | death << BITS_MAX;
}

static inline void count_keys(bucket *b, uint32_t begin, uint32_t end, uint32_t *sums, int dim) {
    for (uint32_t p = begin; p < end; p++) {
        uint32_t key = key_of(b, b->points + (size_t)p * (size_t)dim, dim), death = key >> BITS_MAX;
        b->keys[p] = key;
        if (!death)
            sums[b->starts[b->levels] + key]++;
        else
            sums[b->starts[death - 1] + ((key & CODE) >> dim * (b->levels - (int)death + 1))]++;
    }
}

static uint32_t chunk_end(const bucket *b, size_t chunk) {
    uint64_t end = (chunk + 1) * (uint64_t)b->chunk_count;
    return end < b->item->count ? (uint32_t)end : b->item->count;
}

static froe_status count_chunk(void *user, unsigned worker, size_t chunk) {
    (void)worker;
    bucket *b = user;
    uint32_t *sums = b->sums + chunk * b->starts[b->levels + 1];
    uint32_t begin = (uint32_t)chunk * b->chunk_count, end = chunk_end(b, chunk);
    memset(sums, 0, b->starts[b->levels + 1] * sizeof *sums);
    switch (b->dim) { /* one source, compiled for the common dimensions */
    case 2:
        count_keys(b, begin, end, sums, 2);
        break;
    case 3:
        count_keys(b, begin, end, sums, 3);
        break;
    default:
        count_keys(b, begin, end, sums, b->dim);
    }
    return FROE_OK;
}

/* All counts into the first sum, and every level into the one above. */
static void sum_up(bucket *b) {
    uint32_t total = b->starts[b->levels + 1], *sums = b->sums;
    for (uint32_t chunk = 1; chunk < b->chunks; chunk++)
        for (uint32_t i = 0; i < total; i++) sums[i] += sums[chunk * (size_t)total + i];
    for (int level = b->levels; level > 0; level--)
        for (uint32_t i = 0; i < b->starts[level + 1] - b->starts[level]; i++)
            sums[b->starts[level - 1] + (i >> b->dim)] += sums[b->starts[level] + i];
}

/* ---- decisions */

/* Bounds of the cell, and its middle planes (last level: none). */
static void cell_cube(const bucket *b, const cell *c, guard_cube *cube, double *mid) {
    uint32_t width = b->cells >> c->level;
    for (int i = 0; i < b->dim; i++) {
        uint32_t place = 0;
        for (uint32_t bit = c->level; bit-- > 0;)
            place = 2 * place + (c->code >> ((uint32_t)b->dim * bit + b->dim - 1 - i) & 1);
        const double *bounds = b->axes[i].bounds + place * (size_t)width;
        cube->lo[i] = bounds[0];
        cube->hi[i] = bounds[width];
        mid[i] = bounds[width / 2];
    }
}

/* Guards of the cell with these codes go to one item, or nowhere. */
static void route(bucket *b, const cell *c, uint32_t target) {
    uint32_t shift = (uint32_t)b->dim * ((uint32_t)b->levels - c->level), first = c->code << shift;
    for (uint32_t i = 0; i < 1u << shift; i++) b->routes[first + i] = (uint16_t)target;
}

static froe_status make_item(bucket *b, const cell *c, uint32_t count, const guard_cube *cube, bool shrink,
                             uint32_t *end) {
    *end -= count;
    guard_item part = {.node = c->node,
                       .height = b->item->height + c->level * (uint32_t)b->dim,
                       .begin = b->item->begin + *end,
                       .count = count,
                       .side = guard_other_side(b->item->side),
                       .shrink = shrink};
    route(b, c, b->items);
    b->depths[b->items] = (uint8_t)c->level;
    b->ends[b->items++] = *end;
    return guard_push(b->w, b->item, &part, cube);
}

/* Does the cell shrink? Then it does so to the corner of its fullest part. */
static bool shrinks(const bucket *b, const cell *c, uint32_t count) {
    const uint32_t *parts = b->sums + b->starts[c->level + 1] + (c->code << b->dim);
    uint32_t best = 0;
    for (uint32_t i = 0; i < 1u << b->dim; i++) best = parts[i] > best ? parts[i] : best;
    return count - best < b->w->plan->kill && best > b->w->plan->k;
}

/* Splits all cells that split, from the last to the first, so that the first item ends on top of the stack.
 * A root that shrinks is left alone. */
static froe_status split_cells(bucket *b) {
    cell pending[PENDING];
    uint32_t count = 0, end = b->item->count, first;
    froe_status status = FROE_OK;
    pending[count++] = (cell){0, 0, b->item->node};
    while (count && !status) {
        cell c = pending[--count];
        uint32_t guards = b->sums[b->starts[c.level] + c.code];
        if (guards <= b->w->plan->k) {
            guard_leaf(b->w, c.node, guards);
            route(b, &c, NOWHERE);
            continue;
        }
        guard_cube cube;
        double mid[FROE_MAX_DIM];
        cell_cube(b, &c, &cube, mid);
        bool last = c.level == (uint32_t)b->levels;
        if (last || shrinks(b, &c, guards)) {
            status = make_item(b, &c, guards, &cube, !last, &end);
            continue;
        }
        status = guard_octants(b->w, c.node, b->item->height + c.level * (uint32_t)b->dim, mid, &first);
        for (uint32_t code = 0; code < 1u << b->dim; code++)
            pending[count++] = (cell){c.level + 1, (c.code << b->dim) + code, first + code};
    }
    return status;
}

/* ---- moving guards */

static inline uint32_t target_of(const bucket *b, uint32_t key) {
    uint32_t target = b->routes[key & CODE], death = key >> BITS_MAX;
    return death && target != NOWHERE && death <= b->depths[target] ? (uint32_t)NOWHERE : target;
}

static inline void move_keys(bucket *b, uint32_t begin, uint32_t end, uint32_t *ends, int dim) {
    for (uint32_t p = begin; p < end; p++) {
        uint32_t target = target_of(b, b->keys[p]);
        if (target == NOWHERE) continue;
        memcpy(b->to + (size_t)ends[target]++ * (size_t)dim, b->points + (size_t)p * (size_t)dim,
               (size_t)dim * sizeof *b->to);
    }
}

static froe_status move_chunk(void *user, unsigned worker, size_t chunk) {
    (void)worker;
    bucket *b = user;
    uint32_t *ends = b->ends + chunk * b->codes;
    uint32_t begin = (uint32_t)chunk * b->chunk_count, end = chunk_end(b, chunk);
    switch (b->dim) {
    case 2:
        move_keys(b, begin, end, ends, 2);
        break;
    case 3:
        move_keys(b, begin, end, ends, 3);
        break;
    default:
        move_keys(b, begin, end, ends, b->dim);
    }
    return FROE_OK;
}

/* With several chunks: how many guards of each go to which item. */
static froe_status measure_chunk(void *user, unsigned worker, size_t chunk) {
    (void)worker;
    bucket *b = user;
    uint32_t *counts = b->ends + (chunk + 1) * b->codes;
    memset(counts, 0, b->items * sizeof *counts);
    for (uint32_t p = (uint32_t)chunk * b->chunk_count; p < chunk_end(b, chunk); p++) {
        uint32_t target = target_of(b, b->keys[p]);
        if (target != NOWHERE) counts[target]++;
    }
    return FROE_OK;
}

static froe_status share(bucket *b, uint32_t jobs, base_job_fn *fn) {
    return b->chunks > 1 ? base_run(b->w->plan->task, 0, jobs, fn, b) : fn(b, 0, 0);
}

static froe_status move_guards(bucket *b) {
    if (b->chunks > 1) {
        froe_status status = share(b, b->chunks - 1, measure_chunk);
        if (status) return status;
        for (uint32_t chunk = 1; chunk < b->chunks; chunk++)
            for (uint32_t i = 0; i < b->items; i++)
                b->ends[chunk * (size_t)b->codes + i] += b->ends[(chunk - 1) * (size_t)b->codes + i];
    }
    return share(b, b->chunks, move_chunk);
}

/* ---- the step */

static void *carve(char *room, size_t *used, size_t bytes) {
    size_t at = *used;
    *used += (bytes + 7) / 8 * 8;
    return room ? room + at : NULL;
}

/* Lays out all arrays in one block and returns its size; room NULL: only that. */
static size_t lay_out(bucket *b, char *room) {
    size_t used = 0;
    for (int i = 0; i < b->dim; i++) {
        b->axes[i].bounds = carve(room, &used, (b->cells + 2) * sizeof(double));
        b->axes[i].keys = carve(room, &used, b->cells * sizeof(uint32_t));
        b->axes[i].deaths = carve(room, &used, b->cells);
    }
    b->routes = carve(room, &used, b->codes * sizeof *b->routes);
    b->depths = carve(room, &used, b->codes);
    b->ends = carve(room, &used, b->chunks * (size_t)b->codes * sizeof *b->ends);
    b->sums = carve(room, &used, b->chunks * (size_t)b->starts[b->levels + 1] * sizeof *b->sums);
    b->keys = carve(room, &used, b->item->count * sizeof *b->keys);
    return used;
}

static void plan_chunks(bucket *b) {
    uint32_t threads = b->w->parallel ? b->w->plan->task->threads : 1, count = b->item->count;
    uint32_t most = threads > 1 ? 4 * threads : 1;
    b->chunks = count / CHUNK_COUNT < most ? count / CHUNK_COUNT : most;
    if (b->chunks > CHUNKS_MAX) b->chunks = CHUNKS_MAX;
    if (b->chunks < 1) b->chunks = 1;
    b->chunk_count = (count + b->chunks - 1) / b->chunks;
}

froe_status guard_bucket(guard_worker *w, const guard_item *item, const guard_cube *cube, int levels) {
    bucket b = {.w = w, .item = item, .points = guard_points(w, item), .dim = w->plan->dim, .levels = levels};
    b.to = w->side[guard_other_side(item->side)] + (size_t)item->begin * (size_t)b.dim;
    b.cells = 1u << levels;
    b.codes = 1u << (b.dim * levels);
    for (int level = 0; level <= levels; level++) b.starts[level + 1] = b.starts[level] + (1u << (b.dim * level));
    plan_chunks(&b);
    char *room = guard_scratch(w, lay_out(&b, NULL));
    if (!room) return FROE_E_MEMORY;
    lay_out(&b, room);
    for (int i = 0; i < b.dim; i++)
        if (!fill_table(&b.axes[i], &b, cube, i)) return guard_octree(w, item, cube);
    froe_status status = share(&b, b.chunks, count_chunk);
    if (status) return status;
    sum_up(&b);
    if (shrinks(&b, &(cell){0, 0, 0}, item->count)) return guard_octree(w, item, cube);
    status = split_cells(&b);
    return status || !b.items ? status : move_guards(&b);
}
