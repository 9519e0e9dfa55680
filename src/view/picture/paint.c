/* paint.c: shapes: visible regions and fragments, and which patches are left out. */
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

bool view_append_region(view_painter *p, uint32_t patch, print_ring *points, print_ends *ends) {
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
            view_camera_ray(p->options->view, &s->eye, ray, page);
            points->data[points->count++] = (print_point){page[0], page[1]};
        }
        if (!array_push(alloc, ends, (uint32_t)points->count)) return false;
    }
    return true;
}

static bool put_region(view_painter *p, uint32_t patch) {
    froe_picture *picture = p->picture;
    if (!view_begin_shape(picture, patch, false) ||
        !view_append_region(p, patch, &picture->points, &picture->ring_ends))
        return false;
    view_end_shape(picture);
    return true;
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
        if (v->patch_starts[i] < v->patch_starts[i + 1] && !view_is_left_out(p, i))
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
        if ((i && pairs[i].key == pairs[i - 1].key) || view_is_left_out(p, patch)) continue;
        ok = view_begin_shape(picture, patch, false) &&
             view_print_piece(&p->parts, p->sights, piece, &picture->points) && end_ring(picture, first);
        if (ok) view_end_shape(picture);
    }
    support_free(&picture->alloc, pairs, (2 * n + 1) * sizeof *pairs);
    return ok ? FROE_OK : FROE_E_MEMORY;
}
