/* parts.c: the regions that an exploded view pulls apart, from the cells of the tree. */
#include "exploded/solid.h"
#include "support/floats.h"
#include <math.h>
#include <stdlib.h>

typedef struct collector {
    draw_solid *solid;
    froe_status status;
} collector;

/* Appends corners in drawing coordinates; sum, if given, receives their sum. False without memory. */
static bool copy_corners(draw_solid *solid, const double *coords, size_t count, double *sum) {
    if (!array_reserve(&solid->picture->page.alloc, &solid->corners, 3 * count)) return false;
    for (size_t i = 0; i < count; i++) {
        double *p = solid->corners.data + solid->corners.count;
        draw_space_point(&solid->picture->space, coords + 3 * i, p);
        for (int k = 0; sum && k < 3; k++) sum[k] += p[k];
        solid->corners.count += 3;
    }
    return true;
}

/* Keeps a region at the depth of the parts with its faces, and of one above that its cut. */
static froe_status keep_region(draw_solid *solid, const froe_cell *cell) {
    const draw_page *page = &solid->picture->page;
    const uint32_t depth = page->options->explode_depth;
    if (cell->depth < depth && !cell->leaf && cell->cut_corners >= 3) {
        const draw_wall wall = {solid->corners.count, cell->cut_corners};
        if (!copy_corners(solid, cell->cut_coords, cell->cut_corners, NULL) ||
            !array_push(&page->alloc, &solid->walls, wall))
            return FROE_E_MEMORY;
        solid->wall_of[cell->node.id1 - 1] = (uint32_t)solid->walls.count;
    }
    if (cell->depth != depth && !(cell->leaf && cell->depth < depth)) return FROE_OK;
    draw_part part = {.node = cell->node, .depth = cell->depth, .leaf = cell->leaf};
    if (!cell->leaf) {
        draw_census census;
        if (!draw_census_of(&page->alloc, page->tree, cell->node, &census)) return FROE_E_MEMORY;
        part.depth += (double)census.depths / (double)census.leaves;
        solid->leaves += census.leaves;
    } else
        solid->leaves++;
    bool first = solid->parts.count == 0;
    solid->lo_depth = first ? part.depth : fmin(solid->lo_depth, part.depth);
    solid->hi_depth = first ? part.depth : fmax(solid->hi_depth, part.depth);
    part.first_corner = solid->corners.count;
    part.first_face = solid->face_ends.count;
    part.face_count = cell->face_count;
    double sum[3] = {0};
    if (!copy_corners(solid, cell->coords, cell->corners, sum) ||
        !array_reserve(&page->alloc, &solid->face_ends, cell->face_count))
        return FROE_E_MEMORY;
    for (size_t f = 0; f < cell->face_count; f++)
        solid->face_ends.data[solid->face_ends.count++] = cell->face_starts[f + 1];
    for (int k = 0; k < 3; k++) part.middle[k] = cell->corners ? sum[k] / (double)cell->corners : 0;
    if (!array_push(&page->alloc, &solid->parts, part)) return FROE_E_MEMORY;
    solid->part_of[cell->node.id1 - 1] = (uint32_t)solid->parts.count;
    return FROE_OK;
}

static bool visit_cell(void *user, const froe_cell *cell) {
    SUPPORT_FLOATS_OWN;
    collector *c = user;
    c->status = keep_region(c->solid, cell);
    if (!c->status && !draw_tick(c->solid->picture->page.task)) c->status = FROE_E_CANCELLED;
    return c->status == FROE_OK;
}

froe_status draw_solid_parts(draw_solid *solid) {
    const draw_page *page = &solid->picture->page;
    double lo[3] = {0}, hi[3] = {0};
    if (!froe_scene_bounds(froe_tree_scene(page->tree), lo, hi)) return FROE_OK;
    collector c = {solid, FROE_OK};
    froe_status status = froe_tree_cells(page->tree, lo, hi, visit_cell, &c, NULL);
    return c.status != FROE_OK ? c.status : status;
}
