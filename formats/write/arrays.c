/* arrays.c: scenes, pieces and cells as arrays; see froe/arrays.h. */
#include "support/array.h"
#include "support/fail.h"
#include "support/floats.h"
#include <froe/arrays.h>

/* An array without items has room for one, so that it is not NULL. */
static size_t at_least_one(size_t count) {
    return count ? count : 1;
}

#define TAKE(alloc, array, count) (((array) = support_calloc((alloc), at_least_one(count), sizeof *(array))) != NULL)
#define GIVE(alloc, array, count) support_free((alloc), (array), (array) ? at_least_one(count) * sizeof *(array) : 0)

/* ------------------------------------------------------------------- scene -- */

void froe_scene_arrays_free(froe_scene_arrays *a) {
    if (!a) return;
    const size_t objects = a->object_count;
    GIVE(&a->alloc, a->coords, a->vertex_count * (size_t)a->dim);
    GIVE(&a->alloc, a->kinds, objects);
    GIVE(&a->alloc, a->forms, objects);
    GIVE(&a->alloc, a->starts, objects + 1);
    GIVE(&a->alloc, a->corners, a->corner_count);
    GIVE(&a->alloc, a->radii, objects);
    GIVE(&a->alloc, a->tags, objects);
    GIVE(&a->alloc, a->faces, objects);
    GIVE(&a->alloc, a->groups, objects);
    *a = (froe_scene_arrays){.dim = a->dim};
}

static bool take_scene(froe_scene_arrays *a) {
    const size_t objects = a->object_count;
    return TAKE(&a->alloc, a->coords, a->vertex_count * (size_t)a->dim) && TAKE(&a->alloc, a->kinds, objects) &&
           TAKE(&a->alloc, a->forms, objects) && TAKE(&a->alloc, a->starts, objects + 1) &&
           TAKE(&a->alloc, a->corners, a->corner_count) && TAKE(&a->alloc, a->radii, objects) &&
           TAKE(&a->alloc, a->tags, objects) && TAKE(&a->alloc, a->faces, objects) &&
           TAKE(&a->alloc, a->groups, objects);
}

froe_status froe_arrays_of_scene(const froe_scene *scene, const froe_allocator *alloc, froe_scene_arrays *out,
                                 froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!scene || !out) return support_fail_null(diag, __func__);
    const froe_status checked = froe_scene_check(scene, diag);
    if (checked) return checked;
    froe_scene_arrays a = {.dim = froe_scene_dim(scene), .alloc = support_allocator(alloc)};
    a.object_count = froe_scene_object_count(scene);
    a.vertex_count = froe_scene_vertex_count(scene);
    for (uint32_t i = 0; i < a.object_count; i++) a.corner_count += froe_scene_object(scene, i).corners;
    if (!take_scene(&a)) {
        froe_scene_arrays_free(&a);
        return support_fail_memory(diag);
    }
    if (a.vertex_count)
        memcpy(a.coords, froe_scene_vertex(scene, 0), a.vertex_count * (size_t)a.dim * sizeof *a.coords);
    for (uint32_t i = 0; i < a.object_count; i++) {
        const froe_object object = froe_scene_object(scene, i);
        a.kinds[i] = (uint8_t)object.kind;
        a.forms[i] = (uint8_t)object.form;
        a.radii[i] = object.radius;
        a.tags[i] = object.tag;
        a.faces[i] = object.face;
        a.groups[i] = object.group;
        a.starts[i + 1] = a.starts[i] + object.corners;
        for (uint32_t c = 0; c < object.corners; c++) a.corners[a.starts[i] + c] = froe_scene_corner(scene, i, c);
    }
    *out = a;
    return FROE_OK;
}

/* ------------------------------------------------------------------ pieces -- */

void froe_piece_arrays_free(froe_piece_arrays *a) {
    if (!a) return;
    GIVE(&a->alloc, a->objects, a->count);
    GIVE(&a->alloc, a->nodes, a->count);
    GIVE(&a->alloc, a->whole, a->count);
    GIVE(&a->alloc, a->starts, a->count + 1);
    GIVE(&a->alloc, a->coords, a->corner_count * (size_t)a->dim);
    GIVE(&a->alloc, a->made, a->corner_count);
    *a = (froe_piece_arrays){.dim = a->dim};
}

static bool take_pieces(froe_piece_arrays *a) {
    return TAKE(&a->alloc, a->objects, a->count) && TAKE(&a->alloc, a->nodes, a->count) &&
           TAKE(&a->alloc, a->whole, a->count) && TAKE(&a->alloc, a->starts, a->count + 1) &&
           TAKE(&a->alloc, a->coords, a->corner_count * (size_t)a->dim) && TAKE(&a->alloc, a->made, a->corner_count);
}

froe_status froe_arrays_of_pieces(const froe_tree *tree, const froe_allocator *alloc, froe_piece_arrays *out,
                                  froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!tree || !out) return support_fail_null(diag, __func__);
    const froe_status checked = froe_tree_check(tree, diag);
    if (checked) return checked;
    froe_piece_arrays a = {.dim = froe_tree_report(tree).dim, .alloc = support_allocator(alloc)};
    a.count = froe_tree_piece_count(tree);
    for (size_t i = 0; i < a.count; i++) a.corner_count += froe_tree_piece(tree, i).corners;
    if (!take_pieces(&a)) {
        froe_piece_arrays_free(&a);
        return support_fail_memory(diag);
    }
    for (size_t i = 0; i < a.count; i++) {
        const froe_piece piece = froe_tree_piece(tree, i);
        const size_t start = a.starts[i];
        a.objects[i] = piece.object;
        a.whole[i] = piece.whole;
        a.starts[i + 1] = start + piece.corners;
        froe_tree_piece_corners(tree, i, a.coords + start * (size_t)a.dim, a.made + start, piece.corners);
    }
    for (uint32_t node = 1; node <= froe_tree_report(tree).nodes; node++) {
        const froe_node_info info = froe_tree_node(tree, (froe_node){node});
        for (size_t i = 0; i < info.piece_count; i++) a.nodes[info.first_piece + i] = (froe_node){node};
    }
    *out = a;
    return FROE_OK;
}

/* ------------------------------------------------------------------- cells -- */

void froe_cell_arrays_free(froe_cell_arrays *a) {
    if (!a) return;
    GIVE(&a->alloc, a->nodes, a->count);
    GIVE(&a->alloc, a->depths, a->count);
    GIVE(&a->alloc, a->faces, a->count + 1);
    GIVE(&a->alloc, a->starts, a->face_count + 1);
    GIVE(&a->alloc, a->coords, a->corner_count * (size_t)a->dim);
    *a = (froe_cell_arrays){.dim = a->dim};
}

static bool take_cells(froe_cell_arrays *a) {
    return TAKE(&a->alloc, a->nodes, a->count) && TAKE(&a->alloc, a->depths, a->count) &&
           TAKE(&a->alloc, a->faces, a->count + 1) && TAKE(&a->alloc, a->starts, a->face_count + 1) &&
           TAKE(&a->alloc, a->coords, a->corner_count * (size_t)a->dim);
}

typedef struct cell_copy {
    froe_cell_arrays arrays;
    bool inner, counted; /* the first walk counts, the second copies */
    size_t cells, faces, corners;
} cell_copy;

static bool copy_cell(void *user, const froe_cell *cell) {
    cell_copy *c = user;
    froe_cell_arrays *a = &c->arrays;
    if (!cell->leaf && !c->inner) return true;
    if (c->counted) {
        a->nodes[c->cells] = cell->node;
        a->depths[c->cells] = cell->depth;
        a->faces[c->cells + 1] = c->faces + cell->face_count;
        for (size_t f = 0; f < cell->face_count; f++)
            a->starts[c->faces + f + 1] = c->corners + cell->face_starts[f + 1];
        if (cell->corners)
            memcpy(a->coords + c->corners * (size_t)a->dim, cell->coords,
                   cell->corners * (size_t)a->dim * sizeof *a->coords);
    }
    c->cells++;
    c->faces += cell->face_count;
    c->corners += cell->corners;
    return true;
}

froe_status froe_arrays_of_cells(const froe_tree *tree, const double *lo, const double *hi, bool inner,
                                 const froe_allocator *alloc, froe_cell_arrays *out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!tree || !out) return support_fail_null(diag, __func__);
    cell_copy c = {.arrays = {.dim = froe_tree_report(tree).dim, .alloc = support_allocator(alloc)}, .inner = inner};
    froe_status status = froe_tree_cells(tree, lo, hi, copy_cell, &c, diag);
    if (status) return status;
    froe_cell_arrays *a = &c.arrays;
    a->count = c.cells;
    a->face_count = c.faces;
    a->corner_count = c.corners;
    status = take_cells(a) ? FROE_OK : support_fail_memory(diag);
    c = (cell_copy){.arrays = *a, .inner = inner, .counted = true};
    if (!status) status = froe_tree_cells(tree, lo, hi, copy_cell, &c, diag);
    if (status)
        froe_cell_arrays_free(a);
    else
        *out = *a;
    return status;
}
