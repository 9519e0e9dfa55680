/* grid_boxes.c: one pass over the objects. */
#include "split/guard/grid_boxes.h"
#include <string.h>

enum { PLACED_PER_JOB = 8192 }; /* objects */

/** Codes of boxes, as in grid_boxes.h. */
static inline void place_objects(const split_grid_boxes *p, uint32_t begin, uint32_t end, int dim) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    for (uint32_t object = begin; object < end; object++) {
        uint32_t first = 0, last = 0, flat = 0, apart = 0;
        scene_bounds_in(p->scene, dim, object, lo, hi);
        for (int i = 0; i < dim; i++) {
            const guard_axis *t = &p->grid.axes[i];
            uint32_t from = guard_slice(t, lo[i]), to = guard_slice(t, hi[i]);
            first |= t->codes[from];
            last |= t->codes[to];
            flat |= (uint32_t)(lo[i] == hi[i]) << i;
            apart |= (lo[i] == t->bounds[from]) | (hi[i] == t->bounds[to]);
        }
        p->codes[object][0] = first | flat << GRID_BOXES_FLAT | (apart ? GRID_BOXES_APART : 0);
        p->codes[object][1] = last;
    }
}

static froe_status place_chunk(void *user, unsigned worker, size_t chunk) {
    const split_grid_boxes *p = user;
    size_t end = (chunk + 1) * PLACED_PER_JOB < p->object_count ? (chunk + 1) * PLACED_PER_JOB : p->object_count;
    (void)worker;
    switch (p->grid.dim) { /* one source, compiled for the common dimensions */
    case 2:
        place_objects(p, (uint32_t)(chunk * PLACED_PER_JOB), (uint32_t)end, 2);
        break;
    case 3:
        place_objects(p, (uint32_t)(chunk * PLACED_PER_JOB), (uint32_t)end, 3);
        break;
    default:
        place_objects(p, (uint32_t)(chunk * PLACED_PER_JOB), (uint32_t)end, p->grid.dim);
    }
    return FROE_OK;
}

static froe_status fill_places(const froe_allocator *alloc, base_task *task, int levels, split_grid_boxes *p) {
    int dim = p->scene->dim;
    p->table_bytes = guard_grid_size(dim, levels);
    p->tables = support_realloc(alloc, NULL, 0, p->table_bytes);
    if (!p->tables) return FROE_E_MEMORY;
    if (!guard_grid_make(dim, levels, &p->root, p->tables, &p->grid)) {
        p->grid.levels = 0;
        return FROE_OK;
    }
    p->codes = support_realloc(alloc, NULL, 0, p->object_count * sizeof *p->codes);
    if (!p->codes) return FROE_E_MEMORY;
    return base_run(task, 0, (p->object_count + PLACED_PER_JOB - 1) / PLACED_PER_JOB, place_chunk, p);
}

froe_status split_grid_boxes_make(const froe_allocator *alloc, base_task *task, const froe_scene *scene,
                                  split_grid_boxes *out) {
    split_grid_boxes p = {.scene = scene, .object_count = scene->object_count};
    uint64_t guards = (uint64_t)scene->object_count << scene->dim;
    int levels = guard_grid_levels(guards, scene->dim, GUARD_CODE_BITS);
    guard_cube box = {.lo = {0}};
    froe_status status = FROE_OK;
    memcpy(box.lo, scene->lo, sizeof box.lo);
    memcpy(box.hi, scene->hi, sizeof box.hi);
    if (levels > 1) {
        guard_root(&box, scene->dim, &p.root);
        if (guard_strictly_inside(box.lo, box.hi, &p.root, scene->dim)) status = fill_places(alloc, task, levels, &p);
    }
    if (status)
        split_grid_boxes_free(alloc, &p);
    else
        *out = p;
    return status;
}

void split_grid_boxes_free(const froe_allocator *alloc, split_grid_boxes *p) {
    if (p->codes) support_free(alloc, p->codes, p->object_count * sizeof *p->codes);
    support_free(alloc, p->tables, p->table_bytes);
    *p = (split_grid_boxes){.scene = p->scene};
}
