/* outline.c: see outline.h. */
#include "formats/input/outline.h"
#include "formats/input/triangulate.h"
#include <stdio.h>

void formats_outlines_free(const froe_allocator *alloc, formats_outlines *outlines) {
    array_free(alloc, &outlines->cuts);
    array_free(alloc, &outlines->points);
}

/* ------------------------------------------------------------------- sides -- */

formats_sides formats_sides_begin(void) {
    return (formats_sides){.left = true, .right = true};
}

static bool is_closed(const double *xy, size_t count) {
    return xy[0] == xy[2 * count - 2] && xy[1] == xy[2 * count - 1];
}

froe_status formats_sides_add(formats_sink *sink, formats_outlines *outlines, const double *xy, size_t count, bool hole,
                              formats_sides *sides) {
    if (!count) return FROE_OK;
    while (count > 1 && is_closed(xy, count)) --count;
    int side;
    if (outlines->wrap) { /* the longitudes are changed */
        outlines->points.count = 0;
        if (!array_append(&sink->alloc, &outlines->points, xy, 2 * count)) return support_fail_memory(sink->diag);
        side = formats_wrap_ring_side(outlines->points.data, count);
    } else {
        side = formats_ring_side(xy, count);
    }
    if (hole) side = -side;
    sides->polygons = true;
    sides->left = sides->left && side > 0;
    sides->right = sides->right && side < 0;
    return FROE_OK;
}

void formats_sides_end(formats_sides *sides) {
    if (!sides->polygons) sides->left = sides->right = false;
}

froe_status formats_feature_group(formats_sink *sink, const formats_feature_names *names, const formats_sides *sides) {
    char number[32];
    const char *name = names->name;
    if (!*name && !sides->polygons) return FROE_OK;
    if (!*name) name = names->id;
    if (!*name) {
        snprintf(number, sizeof number, "%lld", (long long)names->number);
        name = number;
    }
    const froe_group group = {.name = name,
                              .material = names->material,
                              .left = sides->left ? name : NULL,
                              .right = sides->right ? name : NULL};
    return formats_sink_group(sink, &group);
}

/* ----------------------------------------------------------------- objects -- */

froe_status formats_outline_point(formats_sink *sink, const formats_outlines *outlines, const double *xy) {
    double at[2] = {xy[0], xy[1]};
    const froe_status status = outlines->wrap ? formats_wrap_point(sink, at, at) : FROE_OK;
    return status ? status : formats_sink_point(sink, at);
}

froe_status formats_outline_line(formats_sink *sink, formats_outlines *outlines, const double *xy, size_t count,
                                 bool ring) {
    if (count < 2) return ++sink->report.skipped, FROE_OK;
    if (ring && !is_closed(xy, count)) {
        ++sink->report.closed;
        outlines->points.count = 0;
        if (!array_append(&sink->alloc, &outlines->points, xy, 2 * count) ||
            !array_append(&sink->alloc, &outlines->points, xy, 2))
            return support_fail_memory(sink->diag);
        xy = outlines->points.data;
        ++count;
    }
    return outlines->wrap ? formats_wrap_line(sink, xy, count, &outlines->cuts) : formats_sink_line(sink, xy, count);
}

froe_status formats_outline_end(formats_sink *sink, formats_outlines *outlines, const formats_sides *sides) {
    outlines->wrapped |= outlines->cuts.count > 0;
    const froe_status status = sides ? formats_wrap_close(sink, &outlines->cuts, sides->right) : FROE_OK;
    outlines->cuts.count = 0;
    sink->face = FROE_NONE;
    return status;
}
