/* parts.c: froe_tree_parts: the pieces, cells or cuts of a tree as shapes with attributes, one after the other. */
#include "formats/write/writer.h"
#include "support/array.h"
#include "support/floats.h"
#include <float.h>
#include <math.h>
#include <string.h>

typedef struct parts_walk {
    const froe_tree *tree;
    const froe_scene *scene;
    int dim;
    froe_export_what what;
    const froe_export_options *options;
    froe_part_fn *fn;
    void *user;
    froe_allocator alloc;
    froe_diagnostic *diag;
    ARRAY(double) coords; /* corners of the part at hand */
    ARRAY(froe_node) stack;
    uint64_t given, expected;
    bool stopped, cancelled;
} parts_walk;

static bool give_part(parts_walk *w, const froe_part *part) {
    enum { PARTS_PER_REPORT = 1024 };
    w->stopped = !support_callback(w->fn(w->user, part));
    if (w->stopped) return false;
    if (++w->given % PARTS_PER_REPORT || !w->options->progress) return true;
    const double share = w->expected ? (double)w->given / (double)w->expected : 1;
    volatile const double done = share < 1 ? share : 1;
    w->cancelled = !support_callback(w->options->progress(w->options->user, done));
    return !w->cancelled;
}

static void attach_number(froe_part *s, const char *name, uint64_t number, bool missing) {
    s->attributes[s->attribute_count++] = (froe_attribute){.name = name, .number = number, .missing = missing};
}

static void attach_text(froe_part *s, const char *name, const char *text) {
    s->attributes[s->attribute_count++] = (froe_attribute){.name = name, .text = text, .missing = !text || !*text};
}

/* -------------------------------------------------------------- fragments -- */

static void describe_piece(const parts_walk *w, froe_part *s, const froe_object *object, uint32_t id, froe_node node,
                           bool in_cut) {
    froe_group group = {.name = "", .material = ""};
    if (object->group != FROE_NONE) group = froe_scene_group(w->scene, object->group);
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
static void draw_box(froe_part *s, double *room) {
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
    s->sort = dim == 2 ? FROE_PART_POLYGON : FROE_PART_SURFACE;
    s->starts = starts;
    s->faces = 6;
}

static froe_status give_piece(parts_walk *w, size_t index, froe_node node, bool in_cut) {
    enum { BOX_CORNERS = 24 };
    froe_piece piece = froe_tree_piece(w->tree, index);
    froe_object object = froe_scene_object(w->scene, piece.object);
    size_t room = piece.corners > BOX_CORNERS ? piece.corners : BOX_CORNERS;
    if (!array_reserve(&w->alloc, &w->coords, room * (size_t)w->dim)) return support_fail_memory(w->diag);
    double *coords = w->coords.data;
    froe_part s = {.kind = object.kind, .dim = w->dim, .coords = coords};
    s.corners = froe_tree_piece_corners(w->tree, index, coords, NULL, room);
    bool flat = object.kind == FROE_SEGMENT || object.kind == FROE_POLYGON;
    s.sort = !flat || s.corners < 2 ? FROE_PART_POINTS : s.corners == 2 ? FROE_PART_LINE : FROE_PART_POLYGON;
    if (object.kind == FROE_BOX && s.corners == 2) draw_box(&s, coords);
    describe_piece(w, &s, &object, piece.object, node, in_cut);
    (void)give_part(w, &s);
    return FROE_OK;
}

static froe_status give_fragments(parts_walk *w) {
    froe_status status = FROE_OK;
    w->expected = froe_tree_piece_count(w->tree);
    if (!array_push(&w->alloc, &w->stack, froe_tree_root(w->tree))) return support_fail_memory(w->diag);
    while (w->stack.count && !status && !w->stopped && !w->cancelled) {
        const froe_node node = w->stack.data[--w->stack.count];
        froe_node_info info = froe_tree_node(w->tree, node);
        bool leaf = info.cut.kind == FROE_CUT_NONE;
        for (size_t i = 0; i < info.piece_count && !status && !w->stopped && !w->cancelled; ++i)
            status = give_piece(w, info.first_piece + i, node, !leaf && i >= info.cover_count);
        const froe_node after[2] = {info.child[1], info.child[0]}; /* child 0 comes next */
        if (!leaf && !status && !array_append(&w->alloc, &w->stack, after, 2)) status = support_fail_memory(w->diag);
    }
    return status;
}

/* ---------------------------------------------------------- cells and cuts -- */

static void describe_cell(const parts_walk *w, froe_part *s, const froe_cell *cell) {
    froe_node_info info = {.piece_count = 0};
    if (w->tree) info = froe_tree_node(w->tree, cell->node);
    attach_number(s, "node", cell->node.id1, false);
    attach_number(s, "depth", cell->depth, false);
    attach_number(s, "pieces", info.piece_count, false);
}

static bool give_cell(void *user, const froe_cell *cell) {
    SUPPORT_FLOATS_OWN;
    parts_walk *w = user;
    bool wanted = w->what == FROE_EXPORT_CELLS ? cell->leaf && cell->corners : !cell->leaf && cell->cut_corners;
    if (!wanted) return true;
    froe_part s = {.kind = FROE_KIND_NONE, .dim = w->dim};
    if (w->what == FROE_EXPORT_CUTS) {
        s.coords = cell->cut_coords;
        s.corners = cell->cut_corners;
        s.sort = s.corners == 1 ? FROE_PART_POINTS : s.corners == 2 ? FROE_PART_LINE : FROE_PART_POLYGON;
    } else {
        s.coords = cell->coords;
        s.corners = cell->corners;
        s.sort = w->dim == 3      ? FROE_PART_SURFACE
                 : s.corners == 1 ? FROE_PART_POINTS
                 : s.corners == 2 ? FROE_PART_LINE
                                  : FROE_PART_POLYGON;
        s.starts = cell->face_starts;
        s.faces = cell->face_count;
    }
    describe_cell(w, &s, cell);
    return give_part(w, &s);
}

/* Within the box that the options say, or else the scene's bounds and a tenth of the longest side more. */
static froe_status give_cells(parts_walk *w) {
    double lo[FROE_MAX_DIM] = {0}, hi[FROE_MAX_DIM] = {0}, longest = 0;
    froe_report report = froe_tree_report(w->tree);
    w->expected = w->what == FROE_EXPORT_CELLS ? report.leaves : report.nodes - report.leaves;
    froe_scene_bounds(w->scene, lo, hi);
    for (int k = 0; k < w->dim; ++k) longest = fmax(longest, 0.1 * hi[k] - 0.1 * lo[k]);
    if (longest == 0) longest = 1;
    for (int k = 0; k < w->dim; ++k) {
        lo[k] = w->options->lo ? w->options->lo[k] : fmax(lo[k] - longest, -DBL_MAX);
        hi[k] = w->options->hi ? w->options->hi[k] : fmin(hi[k] + longest, DBL_MAX);
    }
    return froe_tree_cells(w->tree, lo, hi, give_cell, w, w->diag);
}

/* -------------------------------------------------------------------- all -- */

froe_part froe_part_like(froe_export_what what) {
    froe_part like = {.dim = 0};
    const parts_walk none = {.tree = NULL};
    if (what == FROE_EXPORT_FRAGMENTS)
        describe_piece(&none, &like, &(froe_object){.group = FROE_NONE}, 0, (froe_node){0}, false);
    else
        describe_cell(&none, &like, &(froe_cell){.depth = 0});
    return like;
}

froe_status froe_tree_parts(const froe_tree *tree, froe_export_what what, const froe_export_options *options,
                            froe_part_fn *fn, void *user, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    const froe_export_options defaults = froe_export_defaults();
    if (!tree || !fn) return support_fail_null(diag, __func__);
    if (what != FROE_EXPORT_FRAGMENTS && what != FROE_EXPORT_CELLS && what != FROE_EXPORT_CUTS)
        return support_fail(diag, FROE_E_ARG, "There is nothing of number %d to export.", (int)what);
    if (options && options->size != sizeof *options) return support_fail_defaults(diag, "froe_export_defaults");
    const froe_status checked = froe_tree_check(tree, diag);
    if (checked) return checked;
    const froe_scene *scene = froe_tree_scene(tree);
    parts_walk w = {.tree = tree,
                    .scene = scene,
                    .dim = froe_scene_dim(scene),
                    .what = what,
                    .alloc = support_allocator(NULL),
                    .options = options ? options : &defaults,
                    .fn = fn,
                    .user = user,
                    .diag = diag};
    if (w.dim > 3 && what != FROE_EXPORT_FRAGMENTS)
        return support_fail(diag, FROE_E_UNSUPPORTED, "Cells and cuts exist in 2 and 3 dimensions, not in %d.", w.dim);
    froe_status status = what == FROE_EXPORT_FRAGMENTS ? give_fragments(&w) : give_cells(&w);
    if (w.cancelled) status = support_fail_cancelled(diag);
    array_free(&w.alloc, &w.coords);
    array_free(&w.alloc, &w.stack);
    return status;
}
