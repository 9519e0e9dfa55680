/* export.c: froe_export: the pieces, cells or cuts of a tree, one after the other. */
#include "formats/write/shapes.h"
#include "support/array.h"
#include "support/floats.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

froe_export_options froe_export_defaults(void) {
    return (froe_export_options){.size = sizeof(froe_export_options)};
}

typedef struct export_job {
    const froe_tree *tree;
    const froe_scene *scene;
    int dim;
    froe_export_what what;
    const froe_export_options *options;
    const formats_shape_file *file;
    formats_writer writer;
    froe_allocator alloc;
    froe_diagnostic *diag;
    ARRAY(double) coords; /* corners of the shape at hand */
    ARRAY(froe_node) stack;
    uint64_t written, expected;
    bool cancelled;
} export_job;

static bool write_shape(export_job *j, const formats_shape *shape) {
    enum { SHAPES_PER_REPORT = 1024 };
    j->file->shape(&j->writer, shape, j->written == 0);
    if (++j->written % SHAPES_PER_REPORT || !j->options->progress) return true;
    const double share = j->expected ? (double)j->written / (double)j->expected : 1;
    volatile const double done = share < 1 ? share : 1;
    j->cancelled = !support_callback(j->options->progress(j->options->user, done));
    return !j->cancelled;
}

static void attach_number(formats_shape *s, const char *name, uint64_t number, bool missing) {
    s->attributes[s->attribute_count++] = (formats_attribute){.name = name, .number = number, .missing = missing};
}

static void attach_text(formats_shape *s, const char *name, const char *text) {
    s->attributes[s->attribute_count++] = (formats_attribute){.name = name, .text = text, .missing = !text || !*text};
}

/* -------------------------------------------------------------- fragments -- */

static void describe_piece(const export_job *j, formats_shape *s, const froe_object *object, uint32_t id,
                           froe_node node, bool in_cut) {
    froe_group group = {.name = ""};
    if (object->group != FROE_NONE) group = froe_scene_group(j->scene, object->group);
    attach_number(s, "object", id, false);
    attach_number(s, "face", object->face, object->face == FROE_NONE);
    attach_number(s, "group", object->group, object->group == FROE_NONE);
    attach_text(s, "name", group.name);
    attach_text(s, "material", group.material);
    attach_number(s, "tag", object->tag, false);
    attach_text(s, "kind", froe_kind_name(object->kind));
    attach_number(s, "node", node.id1, false);
    attach_number(s, "in_cut", in_cut, false);
}

/* A box in the plane is a polygon, in space a surface; beyond, its two corners say it all. */
static void draw_box(formats_shape *s, double *room) {
    static const size_t starts[] = {0, 4, 8, 12, 16, 20, 24};
    static const unsigned char square[] = {0, 1, 3, 2};
    static const unsigned char sides[] = {0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5};
    const int dim = s->dim;
    if (dim > 3) return;
    double lo_hi[6];
    memcpy(lo_hi, s->coords, 2 * (size_t)dim * sizeof *lo_hi);
    const unsigned char *order = dim == 2 ? square : sides; /* bit k of a corner chooses the side on axis k */
    s->corners = dim == 2 ? sizeof square : sizeof sides;
    for (size_t i = 0; i < s->corners; ++i)
        for (int k = 0; k < dim; ++k) room[i * (size_t)dim + (size_t)k] = lo_hi[(order[i] >> k & 1 ? dim : 0) + k];
    s->sort = dim == 2 ? FORMATS_POLYGON : FORMATS_SURFACE;
    s->starts = starts;
    s->faces = 6;
}

static froe_status write_piece(export_job *j, size_t index, froe_node node, bool in_cut) {
    enum { BOX_CORNERS = 24 };
    froe_piece piece = froe_tree_piece(j->tree, index);
    froe_object object = froe_scene_object(j->scene, piece.object);
    size_t room = piece.corners > BOX_CORNERS ? piece.corners : BOX_CORNERS;
    if (!array_reserve(&j->alloc, &j->coords, room * (size_t)j->dim)) return support_fail_memory(j->diag);
    double *coords = j->coords.data;
    formats_shape s = {.dim = j->dim, .coords = coords};
    s.corners = froe_tree_piece_corners(j->tree, index, coords, NULL, room);
    bool flat = object.kind == FROE_SEGMENT || object.kind == FROE_POLYGON;
    s.sort = !flat || s.corners < 2 ? FORMATS_POINTS : s.corners == 2 ? FORMATS_LINE : FORMATS_POLYGON;
    if (object.kind == FROE_BOX && s.corners == 2) draw_box(&s, coords);
    describe_piece(j, &s, &object, piece.object, node, in_cut);
    return write_shape(j, &s) ? FROE_OK : FROE_E_CANCELLED;
}

static froe_status write_fragments(export_job *j) {
    froe_status status = FROE_OK;
    j->expected = froe_tree_piece_count(j->tree);
    if (!array_push(&j->alloc, &j->stack, froe_tree_root(j->tree))) return support_fail_memory(j->diag);
    while (j->stack.count && !status) {
        const froe_node node = j->stack.data[--j->stack.count];
        froe_node_info info = froe_tree_node(j->tree, node);
        bool leaf = info.cut.kind == FROE_CUT_NONE;
        for (size_t i = 0; i < info.piece_count && !status; ++i)
            status = write_piece(j, info.first_piece + i, node, !leaf && i >= info.cover_count);
        const froe_node after[2] = {info.child[1], info.child[0]}; /* child 0 comes next */
        if (!leaf && !status && !array_append(&j->alloc, &j->stack, after, 2)) status = support_fail_memory(j->diag);
    }
    return status;
}

/* ---------------------------------------------------------- cells and cuts -- */

static void describe_cell(const export_job *j, formats_shape *s, const froe_cell *cell) {
    froe_node_info info = {.piece_count = 0};
    if (j->tree) info = froe_tree_node(j->tree, cell->node);
    attach_number(s, "node", cell->node.id1, false);
    attach_number(s, "depth", cell->depth, false);
    attach_number(s, "pieces", info.piece_count, false);
}

static bool write_cell(void *user, const froe_cell *cell) {
    SUPPORT_FLOATS_OWN;
    export_job *j = user;
    bool wanted = j->what == FROE_EXPORT_CELLS ? cell->leaf && cell->corners : !cell->leaf && cell->cut_corners;
    if (!wanted) return true;
    formats_shape s = {.dim = j->dim};
    if (j->what == FROE_EXPORT_CUTS) {
        s.coords = cell->cut_coords;
        s.corners = cell->cut_corners;
        s.sort = s.corners == 1 ? FORMATS_POINTS : s.corners == 2 ? FORMATS_LINE : FORMATS_POLYGON;
    } else {
        s.coords = cell->coords;
        s.corners = cell->corners;
        s.sort = j->dim == 3      ? FORMATS_SURFACE
                 : s.corners == 1 ? FORMATS_POINTS
                 : s.corners == 2 ? FORMATS_LINE
                                  : FORMATS_POLYGON;
        s.starts = cell->face_starts;
        s.faces = cell->face_count;
    }
    describe_cell(j, &s, cell);
    return write_shape(j, &s);
}

/* Within the box that the options say, or else the scene's bounds and a tenth of the longest side more. */
static froe_status write_cells(export_job *j) {
    double lo[FROE_MAX_DIM] = {0}, hi[FROE_MAX_DIM] = {0}, longest = 0;
    froe_report report = froe_tree_report(j->tree);
    j->expected = j->what == FROE_EXPORT_CELLS ? report.leaves : report.nodes - report.leaves;
    froe_scene_bounds(j->scene, lo, hi);
    for (int k = 0; k < j->dim; ++k) longest = fmax(longest, 0.1 * hi[k] - 0.1 * lo[k]);
    if (longest == 0) longest = 1;
    for (int k = 0; k < j->dim; ++k) {
        lo[k] = fmax(j->options->lo ? j->options->lo[k] : lo[k] - longest, -0x1.fffffffffffffp+1022);
        hi[k] = fmin(j->options->hi ? j->options->hi[k] : hi[k] + longest, 0x1.fffffffffffffp+1022);
    }
    return froe_tree_cells(j->tree, lo, hi, write_cell, j, j->diag);
}

/* -------------------------------------------------------------------- all -- */

static froe_status run_export(export_job *j, const char *path) {
    froe_status status = formats_writer_open(&j->writer, path, j->diag);
    if (status) return status;
    formats_shape like = {.dim = j->dim};
    if (j->what == FROE_EXPORT_FRAGMENTS)
        describe_piece(j, &like, &(froe_object){.group = FROE_NONE}, 0, (froe_node){0}, false);
    else
        describe_cell(&(export_job){.tree = NULL}, &like, &(froe_cell){.depth = 0});
    j->file->begin(&j->writer, j->scene, &like);
    status = j->what == FROE_EXPORT_FRAGMENTS ? write_fragments(j) : write_cells(j);
    if (j->cancelled) status = support_fail_cancelled(j->diag);
    if (!status) formats_put(&j->writer, j->file->end);
    array_free(&j->alloc, &j->coords);
    array_free(&j->alloc, &j->stack);
    return formats_writer_close(&j->writer, status);
}

froe_status froe_export(const froe_tree *tree, const char *path, froe_export_what what,
                        const froe_export_options *options, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    froe_export_options defaults = froe_export_defaults();
    if (!tree || !path) return support_fail_null(diag, __func__);
    if (what != FROE_EXPORT_FRAGMENTS && what != FROE_EXPORT_CELLS && what != FROE_EXPORT_CUTS)
        return support_fail(diag, FROE_E_ARG, "There is nothing of number %d to export.", (int)what);
    if (options && options->size != sizeof *options) return support_fail_defaults(diag, "froe_export_defaults");
    const froe_scene *scene = froe_tree_scene(tree);
    export_job j = {.tree = tree,
                    .scene = scene,
                    .dim = froe_scene_dim(scene),
                    .what = what,
                    .alloc = support_allocator(NULL),
                    .options = options ? options : &defaults,
                    .file = formats_shape_file_of(path),
                    .diag = diag};
    const bool fits = j.file && j.dim >= j.file->least_dim && j.dim <= j.file->most_dim;
    if (fits && j.dim > 3 && what != FROE_EXPORT_FRAGMENTS)
        return support_fail(diag, FROE_E_UNSUPPORTED, "%s: Cells and cuts exist in 2 and 3 dimensions, not in %d.",
                            support_short(path), j.dim);
    if (!fits) {
        char trees[40];
        snprintf(trees, sizeof trees, "trees of dimension %d", j.dim);
        return support_fail_ending(diag, FROE_E_UNSUPPORTED, path, trees,
                                   j.dim == 2   ? ".geojson or .csv"
                                   : j.dim == 3 ? ".obj or .csv"
                                                : ".csv");
    }
    const froe_status status = j.file->check ? j.file->check(scene, path, diag) : FROE_OK;
    return status ? status : run_export(&j, path);
}
