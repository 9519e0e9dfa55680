/* paint.c: shapes: whole patches and clipped ones, visible regions, fragments. */
#include "view/picture/picture.h"

froe_status view_leave_out(view_painter *p) {
    const froe_visibility *v = p->v;
    froe_picture_report *report = &p->picture->report;
    print_ring ring = {0};
    bool ok = (p->left_out = support_calloc(&v->alloc, (size_t)v->surface->patch_count + 1, 1)) != NULL;
    for (uint32_t patch = 0; ok && patch < v->surface->patch_count; patch++) {
        const uint32_t first = v->patch_starts[patch], end = v->patch_starts[patch + 1];
        double area = 0;
        for (uint32_t i = first; ok && i < end; i++) {
            ring.count = 0;
            ok = view_print_visible(&p->parts, i, &ring);
            area += 0.5 * print_area(ring.data, ring.count);
        }
        if (first == end || area >= p->options->min_area) continue;
        p->left_out[patch] = 1;
        report->left_out++;
        report->left_out_area += area;
    }
    array_free(&v->alloc, &ring);
    return ok ? FROE_OK : FROE_E_MEMORY;
}

static bool is_left_out(const view_painter *p, uint32_t patch) {
    return p->left_out && p->left_out[patch];
}

bool view_begin_shape(froe_picture *picture, uint32_t patch, bool whole) {
    return array_push(&picture->alloc, &picture->shapes,
                      (picture_shape){patch, (uint32_t)picture->ring_ends.count, 0, whole});
}

void view_end_shape(froe_picture *picture) {
    picture_shape *last = picture->shapes.data + picture->shapes.count - 1;
    last->ring_count = (uint32_t)picture->ring_ends.count - last->first_ring;
    if (!last->ring_count) picture->shapes.count--;
    picture->report.whole += last->ring_count && last->whole;
}

/* Ends the ring whose points are those from `first` on; rings of less than three points are dropped. */
static bool end_ring(froe_picture *picture, size_t first) {
    if (picture->points.count - first < 3) {
        picture->points.count = first;
        return true;
    }
    return array_push(&picture->alloc, &picture->ring_ends, (uint32_t)picture->points.count);
}

/* Finds seams along the sides of the last ring, which begins at `first`; strips come after all rings of a shape. */
static bool look_along(view_painter *p, uint32_t node, size_t first) {
    const print_point *ring = p->picture->points.data + first;
    const size_t n = p->picture->points.count - first;
    bool beside;
    for (size_t i = 0; p->seams.parts && i < n; i++)
        if (!view_seams_look(&p->seams, node, ring[i], ring[i + 1 < n ? i + 1 : 0], &beside)) return false;
    return true;
}

static bool put_strips(view_painter *p) {
    return !p->seams.parts || view_seams_flush(&p->seams, &p->picture->points, &p->picture->ring_ends);
}

static bool is_clear(const view_painter *p, uint32_t patch) {
    return p->options->clear && p->options->clear[patch];
}

/* Appends the visible region of a patch as rings; those of less than three points are dropped. */
static bool append_region(view_painter *p, uint32_t patch, print_ring *points, print_ends *ends) {
    const froe_allocator *alloc = &p->picture->alloc;
    const view_region *r = &p->region;
    const view_sightlines *s = p->sights;
    if (view_region_make(&p->region, p->v, p->sights, patch)) return false;
    for (size_t i = 0; i + 1 < r->starts.count; i++) {
        const uint32_t first = r->starts.data[i], end = r->starts.data[i + 1];
        if (end - first < 3) continue;
        if (!array_reserve(alloc, points, end - first)) return false;
        for (uint32_t c = first; c < end; c++) {
            double page[2], ray[3];
            view_ray_at(p->v, r->corners.data[c], ray);
            view_camera_ray(p->options->view, s->eye.origin, s->eye.axis, ray, page);
            points->data[points->count++] = (print_point){page[0], page[1]};
        }
        if (!array_push(alloc, ends, (uint32_t)points->count)) return false;
    }
    return true;
}

static bool put_region(view_painter *p, uint32_t patch) {
    froe_picture *picture = p->picture;
    if (!view_begin_shape(picture, patch, false) || !append_region(p, patch, &picture->points, &picture->ring_ends))
        return false;
    view_end_shape(picture);
    return true;
}

/* The visible parts of one piece of the tree. */
static bool put_parts_of_piece(view_painter *p, uint32_t number) {
    froe_picture *picture = p->picture;
    const paint_node *node = p->parts.nodes.data + number;
    const bool opaque = !is_clear(p, node->patch);
    const froe_visibility *v = p->v;
    if (!view_begin_shape(picture, node->patch, false)) return false;
    for (uint32_t i = v->patch_starts[node->patch]; i < v->patch_starts[node->patch + 1]; i++) {
        const size_t first = picture->points.count;
        if (v->pieces[i].piece != node->piece) continue;
        if (!view_print_visible(&p->parts, i, &picture->points) || !end_ring(picture, first) ||
            (opaque && !look_along(p, number, first)))
            return false;
    }
    if (!put_strips(p)) return false;
    view_end_shape(picture);
    return true;
}

/* ------------------------------------------------------------------------- whole -- */

/* Are the visible parts of a patch all that is painted of it? */
static bool is_clipped(const view_painter *p, uint32_t node) {
    return p->graph.late[node] || p->parts.split[p->parts.nodes.data[node].patch] == PARTS_REGION;
}

/* Makes the rings of all clipped nodes. What they are made from is then freed, unless pieces are nodes. */
static bool make_regions(view_painter *p) {
    const froe_allocator *alloc = &p->picture->alloc;
    bool pieces = false;
    for (uint32_t i = 0; i < p->graph.count; i++) {
        const uint32_t v = p->order[i];
        const paint_node *node = p->parts.nodes.data + v;
        pieces = pieces || node->piece != FROE_NONE;
        if (node->piece != FROE_NONE || !is_clipped(p, v)) continue;
        if (!array_push(alloc, &p->region_starts, (uint32_t)p->region_ends.count)) return false;
        if (!is_left_out(p, node->patch) && !append_region(p, node->patch, &p->region_points, &p->region_ends))
            return false;
    }
    view_region_free(alloc, &p->region);
    p->region = (view_region){.corners = {0}};
    p->keep = pieces;
    return array_push(alloc, &p->region_starts, (uint32_t)p->region_ends.count);
}

/* The next one of these. */
static bool put_clipped(view_painter *p, uint32_t patch, uint32_t node, uint32_t number) {
    froe_picture *picture = p->picture;
    const bool strips = !is_clear(p, patch);
    if (!view_begin_shape(picture, patch, false)) return false;
    for (uint32_t ring = p->region_starts.data[number]; ring < p->region_starts.data[number + 1]; ring++) {
        const uint32_t begin = ring ? p->region_ends.data[ring - 1] : 0, end = p->region_ends.data[ring];
        const size_t first = picture->points.count;
        if (!array_append(&picture->alloc, &picture->points, p->region_points.data + begin, end - begin) ||
            !end_ring(picture, first) || (strips && !look_along(p, node, first)))
            return false;
    }
    if (strips && !put_strips(p)) return false;
    view_end_shape(picture);
    return true;
}

static bool put_whole_patch(view_painter *p, uint32_t patch, uint32_t node) {
    froe_picture *picture = p->picture;
    p->outliner.node = node;
    p->outliner.seams = p->seams.parts && !is_clear(p, patch) ? &p->seams : NULL;
    if (!view_begin_shape(picture, patch, true) ||
        !view_outline(&p->outliner, patch, &picture->points, &picture->ring_ends) || !put_strips(p))
        return false;
    view_end_shape(picture);
    return true;
}

froe_status view_paint_whole(view_painter *p) {
    const froe_picture_options *o = p->options;
    p->painted = support_calloc(&p->picture->alloc, p->parts.nodes.count + 1, sizeof *p->painted);
    p->runs = support_calloc(&p->picture->alloc, (size_t)p->v->surface->patch_count + 1, sizeof *p->runs);
    if (!p->painted || !p->runs || view_outliner_new(&p->outliner, p->sights, o->view, o->cull_back))
        return FROE_E_MEMORY;
    /* Runs of patches of one style without lines between; patches painted whole and opaque get the number of theirs. */
    uint32_t run = 0, last = FROE_NONE;
    for (uint32_t i = 0; i < p->v->surface->patch_count; i++) p->runs[i] = FROE_NONE;
    for (uint32_t i = 0; i < p->graph.count; i++) {
        const uint32_t v = p->order[i];
        const paint_node *node = p->parts.nodes.data + v;
        const uint32_t style = o->styles ? o->styles[node->patch] : 0;
        run += style != last || (p->breaks && p->breaks[i]);
        last = style;
        if (node->piece == FROE_NONE && !is_clipped(p, v) && !is_clear(p, node->patch)) p->runs[node->patch] = run;
    }
    p->outliner.underlap = o->underlap;
    p->outliner.runs = p->runs;
    if (!make_regions(p)) return FROE_E_MEMORY;
    const froe_status status =
        o->underlap > 0 ? view_seams_new(&p->seams, &p->parts, p->order, p->breaks, o->styles, o->clear, o->underlap)
                        : FROE_OK;
    if (status) return status;
    if (!p->keep) view_drop_corners(p->v); /* visible pieces are on the page now */
    for (uint32_t i = 0, clipped = 0; i < p->graph.count; i++) {
        const uint32_t v = p->order[i];
        const paint_node *node = p->parts.nodes.data + v;
        const bool piece = node->piece != FROE_NONE, region = !piece && is_clipped(p, v),
                   left_out = is_left_out(p, node->patch);
        p->painted[i] = (uint32_t)p->picture->shapes.count;
        const bool ok = left_out ? true
                        : piece  ? put_parts_of_piece(p, v)
                        : region ? put_clipped(p, node->patch, v, clipped)
                                 : put_whole_patch(p, node->patch, v);
        clipped += region;
        if (!ok) return FROE_E_MEMORY;
        if (p->picture->points.count > INT32_MAX) return FROE_E_LIMIT;
    }
    return FROE_OK;
}

/* ----------------------------------------------------------------------- regions -- */

froe_status view_paint_regions(view_painter *p) {
    const froe_visibility *v = p->v;
    const uint32_t patches = v->surface->patch_count;
    base_pair *pairs = support_calloc(&p->picture->alloc, 2 * (size_t)patches + 1, sizeof *pairs);
    size_t count = 0;
    bool ok = pairs != NULL;
    /* Visible patches by style; their order does not matter otherwise. */
    for (uint32_t i = 0; ok && i < patches; i++)
        if (v->patch_starts[i] < v->patch_starts[i + 1] && !is_left_out(p, i))
            pairs[count++] = (base_pair){p->options->styles ? p->options->styles[i] : 0, i};
    if (ok) base_radix_sort(pairs, pairs + count, count);
    for (size_t i = 0; ok && i < count; i++) ok = put_region(p, pairs[i].value);
    support_free(&p->picture->alloc, pairs, (2 * (size_t)patches + 1) * sizeof *pairs);
    return ok ? FROE_OK : FROE_E_MEMORY;
}

/* --------------------------------------------------------------------- fragments -- */

froe_status view_paint_fragments(view_painter *p) {
    const froe_visibility *v = p->v;
    froe_picture *picture = p->picture;
    const size_t n = v->piece_count;
    base_pair *pairs = support_calloc(&picture->alloc, 2 * n + 1, sizeof *pairs);
    bool ok = pairs != NULL;
    /* Pieces of the tree with a visible part, farthest first, each once. */
    for (size_t i = 0; ok && i < n; i++) pairs[i] = (base_pair){UINT32_MAX - v->pieces[i].place, v->pieces[i].piece};
    if (ok) base_radix_sort(pairs, pairs + n, n);
    for (size_t i = 0; ok && i < n; i++) {
        const size_t first = picture->points.count;
        const uint32_t piece = pairs[i].value, patch = v->surface->patch_of[v->tree->pieces[piece].object];
        if ((i && pairs[i].key == pairs[i - 1].key) || is_left_out(p, patch)) continue;
        ok = view_begin_shape(picture, patch, false) &&
             view_print_piece(&p->parts, p->sights, piece, &picture->points) && end_ring(picture, first);
        if (ok) view_end_shape(picture);
    }
    support_free(&picture->alloc, pairs, (2 * n + 1) * sizeof *pairs);
    return ok ? FROE_OK : FROE_E_MEMORY;
}
