/* geometry.c: see geometry.h. */
#include "queries/geometry.h"

/* "[1,2]" */
static void put_position(cli_answers *out, const double *at, int dim) {
    for (int k = 0; k < dim; k++) {
        cli_answers_put(out, k ? "," : "[");
        cli_answers_number(out, at[k]);
    }
    cli_answers_put(out, "]");
}

static void put_point(cli_answers *out, const double *at, int dim) {
    cli_answers_put(out, "{\"type\":\"Point\",\"coordinates\":");
    put_position(out, at, dim);
    cli_answers_put(out, "}");
}

/* Two positions that are the same make no valid line (ISO 19125-1, 6.1.7): they are written as a point. */
static void put_line_string(cli_answers *out, const double *from, const double *to, int dim) {
    bool apart = false;
    for (int k = 0; k < dim; k++) apart = apart || from[k] != to[k];
    if (!apart) return put_point(out, from, dim);
    cli_answers_put(out, "{\"type\":\"LineString\",\"coordinates\":[");
    put_position(out, from, dim);
    cli_answers_put(out, ",");
    put_position(out, to, dim);
    cli_answers_put(out, "]}");
}

/* A ring of four corners of a box, by numbers whose bits say which end each axis has, and the first again. */
static void put_box_ring(cli_answers *out, const double *lo, const double *hi, int dim,
                         const unsigned char corners[4]) {
    for (int i = 0; i <= 4; i++) {
        double at[3];
        for (int k = 0; k < dim; k++) at[k] = corners[i % 4] >> k & 1 ? hi[k] : lo[k];
        cli_answers_put(out, i ? "," : "[[");
        put_position(out, at, dim);
    }
    cli_answers_put(out, "]]");
}

/* Rings turn left, seen from outside. */
static void put_box(cli_answers *out, const double *lo, const double *hi, int dim) {
    static const unsigned char plane[4] = {0, 1, 3, 2}, faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                                                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    cli_answers_put(out, dim == 2 ? "{\"type\":\"Polygon\",\"coordinates\":"
                                  : "{\"type\":\"MultiPolygon\",\"coordinates\":[");
    if (dim == 2) put_box_ring(out, lo, hi, dim, plane);
    for (int i = 0; i < 6 && dim == 3; i++) {
        if (i) cli_answers_put(out, ",");
        put_box_ring(out, lo, hi, dim, faces[i]);
    }
    cli_answers_put(out, dim == 2 ? "}" : "]}");
}

static const double *vertex_at_corner(const froe_scene *scene, uint32_t object, uint32_t corner) {
    return froe_scene_vertex(scene, froe_scene_corner(scene, object, corner));
}

static void put_object(cli_answers *out, const froe_scene *scene, uint32_t object) {
    const int dim = froe_scene_dim(scene);
    const froe_object o = froe_scene_object(scene, object);
    const double *first = vertex_at_corner(scene, object, 0);
    if (o.form == FROE_POINT || o.form == FROE_BALL) return put_point(out, first, dim);
    if (o.form == FROE_SEGMENT) return put_line_string(out, first, vertex_at_corner(scene, object, 1), dim);
    if (o.form == FROE_BOX) return put_box(out, first, vertex_at_corner(scene, object, 1), dim);
    const bool polygon = o.form == FROE_POLYGON;
    cli_answers_put(out, polygon ? "{\"type\":\"Polygon\",\"coordinates\":[["
                                 : "{\"type\":\"MultiPoint\",\"coordinates\":[");
    for (uint32_t i = 0; i < o.corners + polygon; i++) {
        if (i) cli_answers_put(out, ",");
        put_position(out, vertex_at_corner(scene, object, i < o.corners ? i : 0), dim);
    }
    cli_answers_put(out, polygon ? "]]}" : "]}");
}

void cli_put_geometry(cli_table *table, const cli_answer *a) {
    cli_answers *out = &table->out;
    const int dim = froe_scene_dim(table->scene);
    const double *query =
        table->block ? table->block->numbers + table->block->starts[a->at] * table->block->width : NULL;
    switch (table->shape) { /* one way: each shape has a case */
    case CLI_SHAPE_NONE:
        return cli_answers_put(out, "null");
    case CLI_SHAPE_QUERY:
        return put_point(out, query, dim);
    case CLI_SHAPE_NEAREST:
    case CLI_SHAPE_HIT:
        return put_line_string(out, query, table->place.point, dim);
    case CLI_SHAPE_OBJECT:
        return put_object(out, table->scene, a->object);
    case CLI_SHAPE_PAIR:
        cli_answers_put(out, "{\"type\":\"GeometryCollection\",\"geometries\":[");
        put_object(out, table->scene, a->object);
        cli_answers_put(out, ",");
        put_object(out, table->scene, a->other);
        return cli_answers_put(out, "]}");
    }
}
