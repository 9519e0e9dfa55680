/* guard_bucket.c: several octree levels of the guard tree at once.
 *
 * As long as nothing shrinks, the middle planes of an octree are those of one grid (guard_grid.h). So one pass
 * gives each guard the code of its cell on the last level, a histogram of codes summed up over the
 * levels gives the guards of all cells on all levels, and that decides every split. Cells that need a shrink,
 * and those of the last level, become items; guards go straight to them, and those of finished cells nowhere.
 *
 * A guard on a plane dies where that plane splits, so it counts only in the cells above: its key says on which level
 * it dies.
 *
 * The guards of a whole scene are the corners of boxes whose places on the grid are known (grid_boxes.h). They are not
 * written down unless they go on, and few do, as that grid is fine enough to finish most cells. */
#include "split/guard/guard_work.h"
#include <string.h>

#define CHUNKS_MAX 64
#define CHUNK_COUNT (1u << 15) /* guards worth a thread's time */
#define PENDING 512            /* (2^dim - 1) * levels + 1 at most */

static const uint32_t NOWHERE = UINT32_MAX;

/* A cell: on which level, its code there, its node. */
typedef struct cell {
    uint32_t level, code, node;
} cell;

typedef struct bucket {
    guard_worker *w;
    const guard_item *item;
    const split_grid_boxes *grid_boxes; /* of the scene whose guards they are; NULL: they are those of the item */
    const double *points;
    double *to;
    uint32_t entries; /* guards, or objects of the scene */
    int dim, levels;
    guard_grid grid;
    char *tables;
    uint32_t axes[GUARD_CELLS];   /* [orthant's axes, axis 0 lowest] their bits in a code */
    uint32_t *keys;               /* [guard], not of a scene: code + level of death << GUARD_CODE_BITS, 0: never */
    uint32_t chunks, chunk_count; /* how the work is shared */
    uint32_t *sums;               /* [chunk][level, cell]: guards strictly inside */
    uint32_t *routes;             /* [code] the item it belongs to, or NOWHERE */
    uint8_t *depths;              /* [item] its level */
    uint32_t *ends;               /* [chunk][item] where its guards go next */
    uint32_t items, moved;        /* moved: guards of all items */
} bucket;

/* ---- keys and counts */

static inline uint32_t point_key(const bucket *b, const double *x, int dim) {
    uint32_t code = 0, death = GUARD_LEVELS + 1;
    for (int i = 0; i < dim; i++) {
        const guard_axis *t = &b->grid.axes[i];
        uint32_t slice = guard_slice(t, x[i]);
        code |= t->codes[slice];
        if (x[i] == t->bounds[slice] && slice && t->levels[slice] < death) death = t->levels[slice];
    }
    return death > GUARD_LEVELS ? code : code | death << GUARD_CODE_BITS;
}

/* A corner of a box: at hi on the axes of `high`, axis 0 lowest. */
static void corner_of(const double *lo, const double *hi, uint32_t high, int dim, double *x) {
    for (int i = 0; i < dim; i++) x[i] = high >> i & 1 ? hi[i] : lo[i];
}

/* Key of a corner of an object's box. */
static inline uint32_t corner_key(const bucket *b, uint32_t object, uint32_t high, int dim) {
    const uint32_t *code = b->grid_boxes->codes[object];
    if (!(code[0] & GRID_BOXES_APART)) return (code[0] ^ ((code[0] ^ code[1]) & b->axes[high])) & GUARD_CODE;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], x[FROE_MAX_DIM];
    scene_bounds_in(b->grid_boxes->scene, dim, object, lo, hi);
    corner_of(lo, hi, high, dim, x);
    return point_key(b, x, dim);
}

/* A flat box has each of its vertices once: those that are never at hi on its flat axes. */
static inline bool is_vertex(const bucket *b, uint32_t object, uint32_t high) {
    return !(b->grid_boxes->codes[object][0] >> GRID_BOXES_FLAT & high & (GUARD_CELLS - 1));
}

static inline void count_key(const bucket *b, uint32_t key, uint32_t *sums, int dim) {
    uint32_t death = key >> GUARD_CODE_BITS;
    if (!death)
        sums[b->grid.starts[b->levels] + key]++;
    else
        sums[b->grid.starts[death - 1] + ((key & GUARD_CODE) >> dim * (b->levels - (int)death + 1))]++;
}

static inline void count_entries(const bucket *b, uint32_t begin, uint32_t end, uint32_t *sums, int dim) {
    for (uint32_t i = begin; i < end; i++) {
        if (b->grid_boxes) {
            for (uint32_t high = 0; high < 1u << dim; high++)
                if (is_vertex(b, i, high)) count_key(b, corner_key(b, i, high, dim), sums, dim);
        } else {
            b->keys[i] = point_key(b, b->points + (size_t)i * (size_t)dim, dim);
            count_key(b, b->keys[i], sums, dim);
        }
    }
}

static uint32_t chunk_end(const bucket *b, size_t chunk) {
    uint64_t end = (chunk + 1) * (uint64_t)b->chunk_count;
    return end < b->entries ? (uint32_t)end : b->entries;
}

static froe_status count_chunk(void *user, unsigned worker, size_t chunk) {
    (void)worker;
    bucket *b = user;
    uint32_t *sums = b->sums + chunk * b->grid.starts[b->levels + 1];
    uint32_t begin = (uint32_t)chunk * b->chunk_count, end = chunk_end(b, chunk);
    memset(sums, 0, b->grid.starts[b->levels + 1] * sizeof *sums);
    switch (b->dim) { /* one source, compiled for the common dimensions */
    case 2:
        count_entries(b, begin, end, sums, 2);
        break;
    case 3:
        count_entries(b, begin, end, sums, 3);
        break;
    default:
        count_entries(b, begin, end, sums, b->dim);
    }
    return FROE_OK;
}

/* ---- decisions */

/* Guards of the cell with these codes go to one item, or nowhere. */
static void route(bucket *b, const cell *c, uint32_t target) {
    uint32_t shift = (uint32_t)b->dim * ((uint32_t)b->levels - c->level), first = c->code << shift;
    for (uint32_t i = 0; i < 1u << shift; i++) b->routes[first + i] = target;
}

/* Does the cell shrink? Then it does so to the corner of its fullest part. */
static bool shrinks(const bucket *b, const cell *c, uint32_t count) {
    const uint32_t *parts = b->sums + b->grid.starts[c->level + 1] + (c->code << b->dim);
    uint32_t best = 0;
    for (uint32_t i = 0; i < 1u << b->dim; i++) best = parts[i] > best ? parts[i] : best;
    return count - best < b->w->plan->kill && best > b->w->plan->k;
}

/* Splits all cells that split, from the last to the first, so that the first item ends on top of the stack.
 * A root that shrinks is left alone. */
static froe_status split_cells(bucket *b) {
    cell pending[PENDING];
    uint32_t count = 0, first;
    froe_status status = FROE_OK;
    pending[count++] = (cell){0, 0, b->item->node};
    while (count && !status) {
        cell c = pending[--count];
        uint32_t guards = b->sums[b->grid.starts[c.level] + c.code];
        if (guards <= b->w->plan->k) {
            guard_leaf(b->w, c.node, guards);
            route(b, &c, NOWHERE);
            continue;
        }
        guard_cube cube;
        double mid[FROE_MAX_DIM];
        guard_grid_cell(&b->grid, (int)c.level, c.code, &cube, mid);
        bool last = c.level == (uint32_t)b->levels;
        if (last || shrinks(b, &c, guards)) {
            /* the cell becomes an item of its own */
            guard_item part = {.node = c.node,
                               .height = b->item->height + c.level * (uint32_t)b->dim,
                               .begin = b->item->begin + b->moved,
                               .count = guards,
                               .side = guard_other_side(b->item->side),
                               .shrink = (!last)};
            route(b, &c, b->items);
            b->depths[b->items] = (uint8_t)c.level;
            b->ends[b->items++] = b->moved;
            b->moved += guards;
            status = guard_push(b->w, b->item, &part, &cube);
            continue;
        }
        status = guard_octants(b->w, c.node, b->item->height + c.level * (uint32_t)b->dim, mid, &first);
        for (uint32_t code = 0; code < 1u << b->dim; code++)
            pending[count++] = (cell){c.level + 1, (c.code << b->dim) + code, first + code};
    }
    return status;
}

/* ---- moving guards */

/* Where a guard goes, or NOWHERE. */
static inline uint32_t target_of(const bucket *b, uint32_t key) {
    uint32_t target = b->routes[key & GUARD_CODE], death = key >> GUARD_CODE_BITS;
    return death && target != NOWHERE && death <= b->depths[target] ? NOWHERE : target;
}

static inline void send_object(const bucket *b, uint32_t object, uint32_t *ends, bool move, int dim) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    for (uint32_t high = 0; high < 1u << dim; high++) {
        uint32_t target = is_vertex(b, object, high) ? target_of(b, corner_key(b, object, high, dim)) : NOWHERE;
        if (target == NOWHERE) continue;
        size_t at = ends[target]++;
        if (!move) continue;
        scene_bounds_in(b->grid_boxes->scene, dim, object, lo, hi);
        corner_of(lo, hi, high, dim, b->to + at * (size_t)dim);
    }
}

/* Counts guards for their items, or moves them there. */
static inline void send_entries(const bucket *b, uint32_t begin, uint32_t end, uint32_t *ends, bool move, int dim) {
    size_t size = (size_t)dim;
    for (uint32_t i = begin; i < end; i++) {
        uint32_t target = NOWHERE;
        if (b->grid_boxes)
            send_object(b, i, ends, move, dim);
        else
            target = target_of(b, b->keys[i]);
        if (target == NOWHERE) continue;
        size_t at = ends[target]++;
        if (move) memcpy(b->to + at * size, b->points + i * size, size * sizeof *b->to);
    }
}

static froe_status send_chunk(const bucket *b, size_t chunk, uint32_t *ends, bool move) {
    uint32_t begin = (uint32_t)chunk * b->chunk_count, end = chunk_end(b, chunk);
    switch (b->dim) { /* one source, compiled for the common dimensions */
    case 2:
        send_entries(b, begin, end, ends, move, 2);
        break;
    case 3:
        send_entries(b, begin, end, ends, move, 3);
        break;
    default:
        send_entries(b, begin, end, ends, move, b->dim);
    }
    return FROE_OK;
}

static froe_status move_chunk(void *user, unsigned worker, size_t chunk) {
    (void)worker;
    const bucket *b = user;
    return send_chunk(b, chunk, b->ends + chunk * b->grid.cells, true);
}

/* With several chunks: how many guards of each go to which item. */
static froe_status measure_chunk(void *user, unsigned worker, size_t chunk) {
    (void)worker;
    const bucket *b = user;
    uint32_t *counts = b->ends + (chunk + 1) * b->grid.cells;
    memset(counts, 0, b->items * sizeof *counts);
    return send_chunk(b, chunk, counts, false);
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
                b->ends[chunk * (size_t)b->grid.cells + i] += b->ends[(chunk - 1) * (size_t)b->grid.cells + i];
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
static size_t lay_out_bucket(bucket *b, char *room) {
    size_t used = 0, cells = (size_t)1 << (b->dim * b->levels);
    if (!b->grid_boxes) b->tables = carve(room, &used, guard_grid_size(b->dim, b->levels));
    b->routes = carve(room, &used, cells * sizeof *b->routes);
    b->depths = carve(room, &used, cells);
    b->ends = carve(room, &used, b->chunks * cells * sizeof *b->ends);
    b->sums = carve(room, &used, b->chunks * 2 * cells * sizeof *b->sums); /* all levels are fewer than two last ones */
    if (!b->grid_boxes) b->keys = carve(room, &used, b->entries * sizeof *b->keys);
    return used;
}

static froe_status reserve_bucket(bucket *b, uint32_t most_chunks) {
    b->chunks = b->entries / CHUNK_COUNT < most_chunks ? b->entries / CHUNK_COUNT : most_chunks;
    if (!b->w->parallel || b->chunks < 1) b->chunks = 1;
    b->chunk_count = (b->entries + b->chunks - 1) / b->chunks;
    char *room = guard_scratch(b->w, lay_out_bucket(b, NULL));
    if (!room) return FROE_E_MEMORY;
    lay_out_bucket(b, room);
    return FROE_OK;
}

static froe_status count_guards(bucket *b) {
    froe_status status = share(b, b->chunks, count_chunk);
    if (!status) {
        /* all counts into the first sum, and every level into the one above */
        uint32_t total = b->grid.starts[b->levels + 1], *sums = b->sums;
        for (uint32_t chunk = 1; chunk < b->chunks; chunk++)
            for (uint32_t i = 0; i < total; i++) sums[i] += sums[chunk * (size_t)total + i];
        for (int level = b->levels; level > 0; level--)
            for (uint32_t i = 0; i < b->grid.starts[level + 1] - b->grid.starts[level]; i++)
                sums[b->grid.starts[level - 1] + (i >> b->dim)] += sums[b->grid.starts[level] + i];
    }
    return status;
}

static const cell whole = {0, 0, 0};

froe_status guard_bucket(guard_worker *w, const guard_item *item, const guard_cube *cube, int levels) {
    bucket b = {.w = w, .item = item, .entries = item->count, .dim = w->plan->dim, .levels = levels};
    uint32_t threads = w->plan->task->threads;
    b.points = guard_points(w, item);
    froe_status status = reserve_bucket(&b, threads < CHUNKS_MAX / 4 ? 4 * threads : CHUNKS_MAX);
    if (status) return status;
    if (!guard_grid_make(b.dim, levels, cube, b.tables, &b.grid)) return guard_octree(w, item, cube);
    status = count_guards(&b);
    if (status) return status;
    if (shrinks(&b, &whole, item->count)) return guard_octree(w, item, cube);
    b.to = w->side[guard_other_side(item->side)] + (size_t)item->begin * (size_t)b.dim;
    status = split_cells(&b);
    return status || !b.items ? status : move_guards(&b);
}

froe_status guard_bucket_scene(guard_worker *w, const split_grid_boxes *grid_boxes, double **main, size_t *bytes,
                               uint32_t *count) {
    bucket b = {
        .w = w, .grid_boxes = grid_boxes, .entries = (uint32_t)grid_boxes->object_count, .grid = grid_boxes->grid};
    uint32_t threads = w->plan->task->threads;
    b.dim = grid_boxes->grid.dim;
    b.levels = grid_boxes->grid.levels;
    /* the bits of an axis in all codes are those of its last slice */
    for (uint32_t high = 1; high < 1u << b.dim; high++) {
        const guard_axis *t = &b.grid.axes[__builtin_ctz(high)];
        b.axes[high] = b.axes[high & (high - 1)] | t->codes[t->last];
    }
    *count = 0;
    froe_status status = reserve_bucket(&b, threads < CHUNKS_MAX ? threads : CHUNKS_MAX); /* sums are large */
    if (!status) status = count_guards(&b);
    if (status || (b.sums[0] > w->plan->k && shrinks(&b, &whole, b.sums[0]))) return status;
    *count = b.sums[0];
    /* all guards of the scene are counted: the cells are split, and the guards that go on are written down */
    guard_item item = {.side = GUARD_INPUT, .count = b.sums[0]};
    guard_cube cube;
    status = guard_push(w, NULL, &item, &grid_boxes->root);
    if (status || !w->items.count) return status; /* a leaf */
    guard_pop(w, &item, &cube);
    b.item = &item;
    status = split_cells(&b);
    if (status || !b.items) return status;
    *bytes = b.moved * (size_t)b.dim * sizeof **main;
    *main = b.to = support_realloc(w->plan->alloc, NULL, 0, *bytes);
    return b.to ? move_guards(&b) : FROE_E_MEMORY;
}
