/* ogr_shapes.c: a geometry's parts are visited in order with an explicit stack. */
#include "ogr_shapes.h"
#include "formats/input/triangulate.h"

void io_shapes_free(const froe_allocator *alloc, io_shapes *shapes) {
    array_free(alloc, &shapes->stack);
    array_free(alloc, &shapes->points);
    array_free(alloc, &shapes->cuts);
}

/* The vertices of a line or ring as xy pairs. */
static froe_status load_points(formats_sink *sink, io_shapes *shapes, OGRGeometryH line, size_t *count) {
    int n = OGR_G_GetPointCount(line);
    *count = n > 0 ? (size_t)n : 0;
    if (!array_reserve(&sink->alloc, &shapes->points, (*count + 1) * 2)) return support_fail_memory(sink->diag);
    double *xy = shapes->points.data;
    if (*count) OGR_G_GetPoints(line, xy, 2 * sizeof *xy, xy + 1, 2 * sizeof *xy, NULL, 0);
    return FROE_OK;
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
    io_sides *sides = user;
    if (type != wkbPolygon && type != wkbTriangle) return FROE_OK;
    int rings = OGR_G_GetGeometryCount(part);
    for (int i = 0; i < rings; ++i) {
        size_t count;
        froe_status status = load_points(sink, shapes, OGR_G_GetGeometryRef(part, i), &count);
        if (status) return status;
        if (!count) continue;
        double *xy = shapes->points.data;
        while (count > 1 && xy[0] == xy[2 * count - 2] && xy[1] == xy[2 * count - 1]) --count;
        int side = shapes->wrap ? io_wrap_ring_side(xy, count) : formats_ring_side(xy, count);
        if (i) side = -side; /* a hole has the interior outside */
        sides->polygons = true;
        sides->left = sides->left && side > 0;
        sides->right = sides->right && side < 0;
    }
    return FROE_OK;
}

froe_status io_shapes_sides(formats_sink *sink, io_shapes *shapes, OGRGeometryH geometry, io_sides *sides) {
    *sides = (io_sides){.left = true, .right = true};
    froe_status status = each_part(sink, shapes, geometry, part_sides, sides);
    if (!sides->polygons) sides->left = sides->right = false;
    return status;
}

/* --------------------------------------------------------------- objects -- */

static froe_status add_line(formats_sink *sink, io_shapes *shapes, OGRGeometryH line, bool ring) {
    size_t count;
    froe_status status = load_points(sink, shapes, line, &count);
    if (status) return status;
    double *xy = shapes->points.data;
    if (count < 2) return ++sink->report.skipped, FROE_OK;
    if (ring && (xy[0] != xy[2 * count - 2] || xy[1] != xy[2 * count - 1])) {
        xy[2 * count] = xy[0]; /* load_points left room */
        xy[2 * count + 1] = xy[1];
        ++count;
        ++sink->report.closed;
    }
    if (shapes->wrap) return io_wrap_line(sink, xy, count, &shapes->cuts);
    for (size_t i = 0; i + 1 < count && !status; ++i) status = formats_sink_segment(sink, xy + 2 * i, xy + 2 * i + 2);
    return status;
}

static froe_status add_point(formats_sink *sink, const io_shapes *shapes, OGRGeometryH point) {
    double at[2] = {OGR_G_GetX(point, 0), OGR_G_GetY(point, 0)};
    const froe_status status = shapes->wrap ? io_wrap_point(sink, at, at) : FROE_OK;
    return status ? status : formats_sink_point(sink, at);
}

static froe_status add_part(void *user, formats_sink *sink, io_shapes *shapes, OGRGeometryH part,
                            OGRwkbGeometryType type) {
    const io_sides *sides = user;
    const bool area = type == wkbPolygon || type == wkbTriangle;
    froe_status status = FROE_OK;
    if (OGR_G_IsEmpty(part)) return ++sink->report.skipped, FROE_OK;
    if (type == wkbPoint) return add_point(sink, shapes, part);
    if (type != wkbLineString && !area) return ++sink->report.skipped, FROE_OK;
    const int rings = area ? OGR_G_GetGeometryCount(part) : 0;
    if (area) formats_sink_new_face(sink);
    if (!area) status = add_line(sink, shapes, part, false);
    for (int i = 0; i < rings && !status; ++i) status = add_line(sink, shapes, OGR_G_GetGeometryRef(part, i), true);
    shapes->wrapped |= shapes->cuts.count > 0;
    if (!status && area) status = io_wrap_close(sink, &shapes->cuts, sides->right);
    shapes->cuts.count = 0;
    sink->face = FROE_NONE;
    return status;
}

froe_status io_shapes_add(formats_sink *sink, io_shapes *shapes, OGRGeometryH geometry, const io_sides *sides) {
    shapes->wrapped = false;
    const froe_status status = each_part(sink, shapes, geometry, add_part, (void *)sides);
    sink->report.wrapped += shapes->wrapped;
    return status;
}
