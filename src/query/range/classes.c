/* classes.c: a cell for each cube that an object of its class meets, and the lists of all cells. */
#include "query/range/classes.h"
#include "base/sort.h"
#include "support/fail.h"

/* An object meets 2^dim cubes of its class at most, and (1 + its extent / their edge)^dim on average, which becomes
 * many above four dimensions: there edges are 2 to 4 times as long. */
static int class_of(int dim, double extent) {
    const int level = cube_level(extent);
    return dim > 4 && level > CUBE_LEAST && level < CUBE_MOST ? level + (dim - 3) / 2 : level;
}

static void free_classes(const froe_allocator *alloc, query_part *part) {
    query_classes *p = (query_classes *)part;
    support_free(alloc, p->cells, p->count * sizeof *p->cells);
    support_free(alloc, p->corners, (size_t)p->count * (size_t)p->dim * sizeof *p->corners);
    array_free(alloc, &p->ids);
    support_free(alloc, p, sizeof *p);
}

/* ----------------------------------------------------------------- entries -- */

/* An object at a cube that it meets. */
typedef struct class_entry {
    uint32_t object;
    int16_t level;
} class_entry;

typedef struct class_draft {
    froe_query *q;
    int dim;
    ARRAY(class_entry) entries;
    ARRAY(double) corners;   /* [entry][axis] */
    uint32_t *order, *spare; /* entries along the curve */
} class_draft;

static const double *entry_corner(const class_draft *d, uint32_t entry) {
    return d->corners.data + (size_t)entry * (size_t)d->dim;
}

static int compare_entries(void *user, uint32_t a, uint32_t b) {
    const class_draft *d = user;
    return cube_compare(d->dim, entry_corner(d, a), d->entries.data[a].level, entry_corner(d, b),
                        d->entries.data[b].level);
}

static bool meets_cube(froe_query *q, uint32_t object, const double *corner, int level) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    cube_bounds(q->tree->scene->dim, corner, level, lo, hi);
    return query_object_meets_box(q, object, lo, hi);
}

/* An entry at each cube of its class that the object meets. */
static bool enter_object(class_draft *d, uint32_t object) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], corner[FROE_MAX_DIM], extent = 0;
    bool ok = true;
    scene_object_bounds(d->q->tree->scene, object, lo, hi);
    for (int k = 0; k < d->dim; k++) extent = fmax(extent, hi[k] - lo[k]);
    const int level = class_of(d->dim, extent);
    const cube_cover cover = cube_cover_of(d->dim, lo, hi, level);
    for (uint32_t which = 0; which < 1u << d->dim && ok; which++) {
        if (!cube_cover_at(&cover, which, corner)) continue;
        if (cover.divided && !meets_cube(d->q, object, corner, level)) continue;
        ok = array_push(&d->q->alloc, &d->entries, (class_entry){object, (int16_t)level}) &&
             array_append(&d->q->alloc, &d->corners, corner, (size_t)d->dim);
    }
    return ok && d->entries.count < FROE_NONE; /* one way: so many take 100 GB */
}

/* ------------------------------------------------------------------- cells -- */

/* Copies the ids of the next larger cell that holds this one, as far as they meet it. Where these, and those of the
 * cells that it refers to, are too many, it is referred to instead. */
static bool inherit(class_draft *d, query_classes *p, uint32_t cell) {
    query_cell *c = p->cells + cell;
    size_t listed = 0;
    for (uint32_t at = c->parent; at != FROE_NONE; at = p->cells[at].refers ? p->cells[at].parent : FROE_NONE) {
        listed += p->cells[at].count;
        if (listed > CLASSES_MOST) return c->refers = true;
    }
    const uint32_t above = c->parent; /* refers to none: together with what it did they would be too many here, too */
    for (uint32_t i = 0; above != FROE_NONE && i < p->cells[above].count; i++) {
        const uint32_t object = p->ids.data[p->cells[above].first + i];
        if (!meets_cube(d->q, object, query_cell_corner(p, cell), c->level)) continue;
        if (!array_push(&d->q->alloc, &p->ids, object)) return false;
        c->count++;
    }
    return true;
}

/* Where the jump of a cell below `parent` leads: as far as two equal jumps before it, or to the parent. */
static uint32_t jump_from(const query_cell *cells, uint32_t parent) {
    const uint32_t near = cells[parent].jump, far = cells[near].jump;
    return cells[parent].depth - cells[near].depth == cells[near].depth - cells[far].depth ? far : parent;
}

/* The cell of the entries first .. end, in order, which have one cube. *above: the cell before it, which it becomes. */
static bool make_cell(class_draft *d, query_classes *p, uint32_t cell, uint32_t first, uint32_t end, uint32_t *above) {
    const double *corner = entry_corner(d, d->order[first]);
    query_cell *c = p->cells + cell;
    memcpy(p->corners + (size_t)cell * (size_t)p->dim, corner, (size_t)p->dim * sizeof *corner);
    while (*above != FROE_NONE && !query_cell_holds(p, *above, corner)) *above = p->cells[*above].parent;
    *c = (query_cell){.first = (uint32_t)p->ids.count,
                      .own = end - first,
                      .count = end - first,
                      .parent = *above,
                      .jump = *above == FROE_NONE ? cell : jump_from(p->cells, *above),
                      .depth = *above == FROE_NONE ? 0 : p->cells[*above].depth + 1,
                      .level = d->entries.data[d->order[first]].level};
    *above = cell;
    for (uint32_t i = first; i < end; i++)
        if (!array_push(&d->q->alloc, &p->ids, d->entries.data[d->order[i]].object)) return false;
    return inherit(d, p, cell) && p->ids.count < FROE_NONE; /* one way: so many take 100 GB */
}

static bool make_cells(class_draft *d, query_classes *p) {
    const uint32_t entries = (uint32_t)d->entries.count;
    uint32_t cell = 0, above = FROE_NONE, first = 0;
    for (uint32_t i = 0; i < entries; i++) p->count += !i || compare_entries(d, d->order[i - 1], d->order[i]) != 0;
    p->cells = support_calloc(&d->q->alloc, p->count, sizeof *p->cells);
    p->corners = support_calloc(&d->q->alloc, (size_t)p->count * (size_t)p->dim, sizeof *p->corners);
    bool ok = p->cells && p->corners;
    for (uint32_t i = 1; i <= entries && ok; i++) {
        if (i < entries && compare_entries(d, d->order[first], d->order[i]) == 0) continue;
        ok = make_cell(d, p, cell++, first, i, &above);
        first = i;
    }
    return ok;
}

static froe_status make_classes(froe_query *q, query_part **out, froe_diagnostic *diag) {
    class_draft d = {.q = q, .dim = q->tree->scene->dim};
    query_classes *p = support_calloc(&q->alloc, 1, sizeof *p);
    if (!p) return support_fail_memory(diag);
    p->part.free = free_classes;
    p->dim = d.dim;
    *out = &p->part;
    bool ok = true;
    for (uint32_t i = 0; i < q->tree->scene->object_count && ok; i++) ok = enter_object(&d, i);
    const size_t entries = d.entries.count;
    d.order = ok ? support_calloc(&q->alloc, entries, sizeof *d.order) : NULL;
    d.spare = ok ? support_calloc(&q->alloc, entries, sizeof *d.spare) : NULL;
    if (d.order && d.spare) {
        for (uint32_t i = 0; i < entries; i++) d.order[i] = i;
        base_merge_sort(d.order, d.spare, entries, compare_entries, &d);
        ok = make_cells(&d, p);
    }
    ok = ok && d.order && d.spare;
    support_free(&q->alloc, d.order, entries * sizeof *d.order);
    support_free(&q->alloc, d.spare, entries * sizeof *d.spare);
    array_free(&q->alloc, &d.entries);
    array_free(&q->alloc, &d.corners);
    return ok ? FROE_OK : support_fail_memory(diag);
}

froe_status query_classes_of(froe_query *query, const query_classes **out, froe_diagnostic *diag) {
    const query_part *part;
    const froe_status status = query_prepare(query, QUERY_CLASSES, make_classes, &part, diag);
    if (status == FROE_OK) *out = (const query_classes *)part;
    return status;
}
