/* ogr_shapes.c: a geometry's parts are visited in order with an explicit stack. */
#include "ogr_shapes.h"
#include <math.h>

void io_shapes_free(const froe_allocator *alloc, io_shapes *shapes) {
    array_free(alloc, &shapes->stack);
    array_free(alloc, &shapes->points);
    formats_outlines_free(alloc, &shapes->outlines);
}

/* A whole number beyond 64 bits has become the last one within, so that one may have been any. */
static froe_status refuse_cut(formats_sink *sink, const io_shapes *shapes, const double *xy, size_t count) {
    for (size_t i = 0; i < 2 * count && shapes->cuts; i++)
        if (fabs(xy[i]) == 0x1p63 || xy[i] == 0x1p64)
            return formats_sink_fail(sink, FROE_E_INPUT,
                                     "Coordinate %c is read as %.17g, as every longer whole number is. With a decimal "
                                     "point it is read as it is written.",
                                     i % 2 ? 'y' : 'x', xy[i]);
    return FROE_OK;
}

/* The vertices of a line or ring as xy pairs. */
static froe_status load_points(formats_sink *sink, io_shapes *shapes, OGRGeometryH line, size_t *count) {
    int n = OGR_G_GetPointCount(line);
    *count = n > 0 ? (size_t)n : 0;
    if (!array_reserve(&sink->alloc, &shapes->points, *count * 2)) return support_fail_memory(sink->diag);
    double *xy = shapes->points.data;
    if (*count) OGR_G_GetPoints(line, xy, 2 * sizeof *xy, xy + 1, 2 * sizeof *xy, NULL, 0);
    return refuse_cut(sink, shapes, xy, *count);
}

typedef froe_status part_fn(void *user, formats_sink *sink, io_shapes *shapes, OGRGeometryH part,
                            OGRwkbGeometryType type);

/* Calls fn for every part that is no collection, in order. */
static froe_status each_part(formats_sink *sink, io_shapes *shapes, OGRGeometryH geometry, part_fn *fn, void *user) {
    const froe_allocator *alloc = &sink->alloc;
    shapes->stack.count = 0;
    if (!array_push(alloc, &shapes->stack, geometry)) return support_fail_memory(sink->diag);
    froe_status status = FROE_OK;
    while (shapes->stack.count && !status) {
        OGRGeometryH part = shapes->stack.data[--shapes->stack.count];
        OGRwkbGeometryType type = wkbFlatten(OGR_G_GetGeometryType(part));
        const bool collection = type == wkbGeometryCollection || type == wkbMultiPoint || type == wkbMultiLineString ||
                                type == wkbMultiPolygon || type == wkbPolyhedralSurface || type == wkbTIN;
        if (!collection) {
            status = fn(user, sink, shapes, part, type);
            continue;
        }
        for (int i = OGR_G_GetGeometryCount(part); i-- > 0;) {
            OGRGeometryH child = OGR_G_GetGeometryRef(part, i);
            if (!array_push(alloc, &shapes->stack, child)) return support_fail_memory(sink->diag);
        }
    }
    return status;
}

/* ----------------------------------------------------------------- sides -- */

static froe_status part_sides(void *user, formats_sink *sink, io_shapes *shapes, OGRGeometryH part,
                              OGRwkbGeometryType type) {
    if (type != wkbPolygon && type != wkbTriangle) return FROE_OK;
    const int rings = OGR_G_GetGeometryCount(part);
    froe_status status = FROE_OK;
    for (int i = 0; i < rings && !status; ++i) {
        size_t count;
        status = load_points(sink, shapes, OGR_G_GetGeometryRef(part, i), &count);
        if (!status) status = formats_sides_add(sink, &shapes->outlines, shapes->points.data, count, i > 0, user);
    }
    return status;
}

froe_status io_shapes_sides(formats_sink *sink, io_shapes *shapes, OGRGeometryH geometry, formats_sides *sides) {
    *sides = formats_sides_begin();
    const froe_status status = each_part(sink, shapes, geometry, part_sides, sides);
    formats_sides_end(sides);
    return status;
}

/* --------------------------------------------------------------- objects -- */

static froe_status add_line(formats_sink *sink, io_shapes *shapes, OGRGeometryH line, bool ring) {
    size_t count;
    const froe_status status = load_points(sink, shapes, line, &count);
    return status ? status : formats_outline_line(sink, &shapes->outlines, shapes->points.data, count, ring);
}

static froe_status add_part(void *user, formats_sink *sink, io_shapes *shapes, OGRGeometryH part,
                            OGRwkbGeometryType type) {
    const bool area = type == wkbPolygon || type == wkbTriangle;
    froe_status status = FROE_OK;
    if (OGR_G_IsEmpty(part)) return ++sink->report.skipped, FROE_OK;
    if (type == wkbPoint) {
        const double at[2] = {OGR_G_GetX(part, 0), OGR_G_GetY(part, 0)};
        status = refuse_cut(sink, shapes, at, 1);
        return status ? status : formats_outline_point(sink, &shapes->outlines, at);
    }
    if (type != wkbLineString && !area) return ++sink->report.skipped, FROE_OK;
    const int rings = area ? OGR_G_GetGeometryCount(part) : 0;
    if (area) formats_sink_new_face(sink);
    if (!area) status = add_line(sink, shapes, part, false);
    for (int i = 0; i < rings && !status; ++i) status = add_line(sink, shapes, OGR_G_GetGeometryRef(part, i), true);
    return status ? status : formats_outline_end(sink, &shapes->outlines, area ? user : NULL);
}

froe_status io_shapes_add(formats_sink *sink, io_shapes *shapes, OGRGeometryH geometry, const formats_sides *sides) {
    shapes->outlines.wrapped = false;
    const froe_status status = each_part(sink, shapes, geometry, add_part, (void *)(uintptr_t)sides);
    sink->report.wrapped += shapes->outlines.wrapped;
    return status;
}
