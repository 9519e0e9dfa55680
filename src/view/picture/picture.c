/* picture.c: the public calls for pictures: look, plan, paint. */
#include "view/picture/picture.h"
#include "base/floats.h"
#include "support/fail.h"
#include "tree/gate.h"
#include "view/visibility/order.h"
#include <math.h>

void froe_picture_defaults_into(froe_picture_options *out, size_t size) {
    const froe_picture_options all = {.size = size, .crease = 30};
    support_defaults(out, size, &all, sizeof all);
}

const char *froe_paint_name(froe_paint paint) {
    static const char *const names[FROE_PAINT_COUNT] = {"whole", "regions", "fragments"};
    return (unsigned)paint < FROE_PAINT_COUNT ? names[paint] : NULL;
}

const char *froe_line_name(froe_line kind) {
    switch (kind) {
    case FROE_LINE_BORDER:
        return "border";
    case FROE_LINE_SILHOUETTE:
        return "silhouette";
    case FROE_LINE_OBJECT:
        return "object";
    case FROE_LINE_MATERIAL:
        return "material";
    case FROE_LINE_CREASE:
        return "crease";
    case FROE_LINE_MESH:
        return "mesh";
    case FROE_LINE_CROSSING:
        return "crossing";
    case FROE_LINE_SECTION:
        return "section";
    case FROE_LINE_WIRE:
        return "wire";
    case FROE_LINE_POINT:
        return "point";
    default:
        return NULL;
    }
}

/* --------------------------------------------------------------------- looking -- */

static bool report_looking(void *user, double done) {
    return base_progress(user, VIEW_LOOKED * done);
}

static froe_status report(view_painter *p, double done) {
    return base_progress(&p->task, done) ? FROE_OK : FROE_E_CANCELLED;
}

static froe_status look_for_picture(view_painter *p, const froe_tree *tree, const froe_surface *surface,
                                    const uint8_t *kinds, froe_diagnostic *diag) {
    const froe_picture_options *o = p->options;
    froe_visibility_options look = froe_visibility_defaults();
    look.eye = o->view->eye;
    look.window = o->view->window;
    look.window_corners = 4;
    look.clear = o->clear;
    look.priorities = o->priorities;
    look.edges = kinds;
    look.cull_back = o->cull_back;
    look.crossings = o->lines & (FROE_LINE_CROSSING | FROE_LINE_SECTION);
    look.hidden_crossings = look.crossings && o->hidden;
    look.section = o->section;
    look.faces_only = !(o->lines & (FROE_LINE_WIRE | FROE_LINE_POINT));
    look.alloc = &p->picture->alloc;
    look.progress = report_looking;
    look.user = &p->task;
    const froe_status status = froe_visibility_new(tree, surface, &look, &p->v, diag);
    if (status) return status;
    p->sights = &p->v->sights;
    p->picture->report.visibility = froe_visibility_statistics(p->v);
    return FROE_OK;
}

/* -------------------------------------------------------------------- painting -- */

/* Plans the order in which fills are painted. */
static froe_status plan_fills(view_painter *p) {
    froe_picture_report *report = &p->picture->report;
    froe_status status = FROE_OK;
    report->paint = p->options->paint;
    if (p->options->no_fills) return FROE_OK;
    bool clear = false;
    for (uint32_t i = 0; p->options->clear && i < p->v->surface->patch_count; i++)
        clear = clear || p->options->clear[i];
    /* Visible regions overlap where one sees through some, and are then painted in an order of their own. */
    const bool ordered = p->options->paint == FROE_PAINT_WHOLE || (p->options->paint == FROE_PAINT_REGIONS && clear);
    if (ordered && clear) {
        p->places = support_calloc(&p->picture->alloc, (size_t)p->v->tree->piece_count + 1, sizeof *p->places);
        status = p->places ? view_find_places(p->v, p->options->priorities, p->places) : FROE_E_MEMORY;
    }
    if (!status) status = view_parts_new(&p->parts, p->v, p->options->view, p->places, p->options->cull_back);
    if (!status && ordered) {
        status = view_plan_whole(p);
        if (status == FROE_E_BUDGET) {
            report->paint = FROE_PAINT_FRAGMENTS;
            status = FROE_OK;
        }
    }
    if (!status && p->options->min_area > 0) status = view_leave_out(p);
    return status;
}

static froe_status make_picture(view_painter *p, const froe_tree *tree, const froe_surface *surface,
                                froe_diagnostic *diag) {
    uint8_t *kinds = support_calloc(&p->picture->alloc, (size_t)surface->edge_count + 1, 1);
    if (!kinds) return support_fail_memory(diag);
    froe_status status = FROE_OK;
    if (p->options->lines) {
        /* Kinds depend on the eye. They use sightlines of their own, as those of the visibility do not exist yet. */
        geom_eye eye;
        view_sightlines sights = {.alloc = p->picture->alloc};
        status = view_eye_of(tree, &p->options->view->eye, &eye, diag);
        if (!status && view_sightlines_new(&sights, tree, surface, &eye, NULL, 0, &p->picture->alloc))
            status = support_fail_memory(diag);
        if (!status) view_line_kinds(&sights, p->options->lines, p->options->crease, kinds);
        if (sights.tree) view_sightlines_free(&sights);
    }
    if (!status) status = look_for_picture(p, tree, surface, kinds, diag);
    if (!status) {
        if (p->options->lines) status = view_make_segments(p, kinds);
        if (!status) status = report(p, VIEW_LOOKED);
        if (!status) status = plan_fills(p);
        if (!status) status = report(p, VIEW_PLANNED);
        const froe_paint paint = p->picture->report.paint;
        if (!status && !p->options->no_fills)
            status = p->order                      ? view_paint_whole(p)
                     : paint == FROE_PAINT_REGIONS ? view_paint_regions(p)
                                                   : view_paint_fragments(p);
        if (!status) status = report(p, VIEW_PAINTED);
        if (!status) status = view_make_strokes(p);
        froe_picture *picture = p->picture;
        const size_t shapes = picture->shapes.count;
        if (!status && !(picture->styles = support_calloc(&picture->alloc, shapes + 1, sizeof *picture->styles)))
            status = FROE_E_MEMORY;
        for (size_t i = 0; !status && p->options->styles && i < shapes; i++)
            picture->styles[i] = p->options->styles[picture->shapes.data[i].patch];
        picture->report.shapes = shapes;
        picture->report.points = picture->points.count;
        picture->report.strokes = picture->strokes.count;
        if (!status) status = report(p, 1);
        if (status == FROE_E_CANCELLED) support_fail_cancelled(diag);
        if (status == FROE_E_MEMORY) support_fail_memory(diag);
        if (status == FROE_E_LIMIT) support_fail(diag, status, "More than 2^31 points or arcs are needed.");
    }
    support_free(&p->picture->alloc, kinds, (size_t)surface->edge_count + 1);
    return status;
}

/* --------------------------------------------------------------------- calling -- */

static froe_status check_picture_options(const froe_picture_options *o, froe_diagnostic *diag) {
    if (!o || o->size != sizeof *o) return support_fail_defaults(diag, "froe_picture_defaults");
    if (!o->view) return support_fail(diag, FROE_E_ARG, "The options name no view.");
    if (o->paint < 0 || o->paint >= FROE_PAINT_COUNT)
        return support_fail(diag, FROE_E_OPTIONS, "There is no paint %d.", (int)o->paint);
    if (!(o->underlap >= 0) || !isfinite(o->underlap))
        return support_fail(diag, FROE_E_OPTIONS, "An underlap of %g is none.", o->underlap);
    if (!(o->min_area >= 0) || !isfinite(o->min_area))
        return support_fail(diag, FROE_E_OPTIONS, "A least area of %g is none.", o->min_area);
    if (!(o->halo >= 0) || !isfinite(o->halo))
        return support_fail(diag, FROE_E_OPTIONS, "A halo of %g is none.", o->halo);
    if (!(o->interleave >= 0) || !isfinite(o->interleave))
        return support_fail(diag, FROE_E_OPTIONS, "Lines that reach %g cannot be interleaved.", o->interleave);
    if (!(o->interleave_points >= 0) || !isfinite(o->interleave_points))
        return support_fail(diag, FROE_E_OPTIONS, "Points that reach %g cannot be interleaved.", o->interleave_points);
    if (!(o->crease >= 0 && o->crease <= 180))
        return support_fail(diag, FROE_E_OPTIONS, "A crease angle of %g degrees is not in 0 .. 180.", o->crease);
    return FROE_OK;
}

froe_status froe_picture_new(const froe_tree *tree, const froe_surface *surface, const froe_picture_options *options,
                             froe_picture **out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!tree || !surface || !out) return support_fail_null(diag, __func__);
    froe_status status = check_picture_options(options, diag);
    if (!status) status = view_check_surface(tree, surface, diag);
    if (!status) status = tree_settle(tree, diag);
    if (status) return status;
    const froe_allocator alloc = support_allocator(options->alloc);
    froe_picture *picture = support_calloc(&alloc, 1, sizeof *picture);
    if (!picture) return support_fail_memory(diag);
    picture->alloc = alloc;
    view_painter p = {.picture = picture, .options = options};
    base_task_init(&p.task, options->threads, options->progress, options->user);
    status = make_picture(&p, tree, surface, diag);
    view_seams_free(&p.seams);
    view_graph_free(&alloc, &p.graph);
    array_free(&alloc, &p.arcs);
    view_region_free(&alloc, &p.region);
    support_free(&alloc, p.order, (p.parts.nodes.count + 1) * sizeof *p.order);
    support_free(&alloc, p.breaks, p.parts.nodes.count + 1);
    array_free(&alloc, &p.items);
    array_free(&alloc, &p.segments);
    support_free(&alloc, p.painted, (p.parts.nodes.count + 1) * sizeof *p.painted);
    if (p.v) {
        support_free(&alloc, p.places, ((size_t)p.v->tree->piece_count + 1) * sizeof *p.places);
        support_free(&alloc, p.left_out, (size_t)p.v->surface->patch_count + 1);
        support_free(&alloc, p.runs, ((size_t)p.v->surface->patch_count + 1) * sizeof *p.runs);
    }
    view_parts_free(&p.parts);
    froe_visibility_free(p.v);
    if (status) {
        froe_picture_free(picture);
        return status;
    }
    *out = picture;
    return FROE_OK;
}

void froe_picture_free(froe_picture *p) {
    if (!p) return;
    const froe_allocator alloc = p->alloc;
    support_free(&alloc, p->styles, (p->shapes.count + 1) * sizeof *p->styles);
    array_free(&alloc, &p->shapes);
    array_free(&alloc, &p->points);
    array_free(&alloc, &p->ring_ends);
    array_free(&alloc, &p->strokes);
    array_free(&alloc, &p->stroke_points);
    array_free(&alloc, &p->stroke_space);
    array_free(&alloc, &p->stroke_objects);
    support_free(&alloc, p, sizeof *p);
}

/* ---------------------------------------------------------------------- reading -- */

size_t froe_picture_shape_count(const froe_picture *p) {
    return p->shapes.count;
}

froe_shape froe_picture_shape(const froe_picture *p, size_t i) {
    if (i >= p->shapes.count) return (froe_shape){.patch = FROE_NONE};
    const picture_shape *s = p->shapes.data + i;
    return (froe_shape){s->patch, p->styles[i], s->whole, s->first_ring, s->ring_count};
}

const double *froe_picture_ring(const froe_picture *p, size_t ring, size_t *points) {
    *points = 0;
    if (ring >= p->ring_ends.count) return NULL;
    const uint32_t first = ring ? p->ring_ends.data[ring - 1] : 0;
    *points = p->ring_ends.data[ring] - first;
    return &p->points.data[first].x;
}

size_t froe_picture_stroke_count(const froe_picture *p) {
    return p->strokes.count;
}

froe_stroke froe_picture_stroke(const froe_picture *p, size_t i) {
    if (i >= p->strokes.count) return (froe_stroke){.count = 0};
    const picture_stroke *s = p->strokes.data + i;
    return (froe_stroke){.kind = (froe_line)s->kind,
                         .hidden = s->hidden,
                         .closed = s->closed,
                         .butt = {s->butt[0], s->butt[1]},
                         .place = s->place,
                         .points = &p->stroke_points.data[s->first].x,
                         .space = p->stroke_space.data + 3 * (size_t)s->first,
                         .objects = p->stroke_objects.data + s->first,
                         .count = s->count};
}

froe_picture_report froe_picture_statistics(const froe_picture *p) {
    return p->report;
}
