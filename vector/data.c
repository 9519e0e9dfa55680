/* data.c: the lines of a picture as rows of CSV and as features of GeoJSON. */
#include "render.h"
#include <string.h>

typedef struct data_writer {
    vector_render *render;
    vector_output *output;
} data_writer;

/* Does the line lead back? A point does not. */
static bool leads_back(const froe_stroke *s) {
    return s->closed && s->count > 1;
}

/* Points of `dim` numbers, and the first once more where the line is closed: begin before and end behind each, and
 * `between` parts numbers. Those of the page are turned upwards. */
static void put_points(const data_writer *w, const froe_stroke *s, int dim, const char *begin, const char *between,
                       const char *end) {
    const size_t count = s->count + leads_back(s);
    for (size_t i = 0; i < count; i++) {
        const double *p = (dim == 2 ? s->points : s->space) + (size_t)dim * (i % s->count);
        vector_print(w->output, "%s%s", i ? "," : "", begin);
        for (int k = 0; k < dim; k++) {
            if (k) vector_print(w->output, "%s", between);
            vector_put_exactly(w->output, dim == 2 && k ? w->render->options->camera.height - p[k] : p[k]);
        }
        vector_print(w->output, "%s", end);
    }
}

typedef void put_line_fn(data_writer *w, const froe_stroke *line, const froe_object *owner);

/* Calls a function with each line, and the object whose group and face are to be told. */
static void put_lines(vector_render *r, vector_output *output, put_line_fn *put) {
    data_writer w = {r, output};
    const size_t count = froe_picture_stroke_count(r->picture);
    for (size_t i = 0; !output->status && i < count; i++) {
        const froe_stroke s = vector_stroke(r, i);
        if (!vector_stroke_shows(r, &s)) continue;
        const froe_object owner = froe_scene_object(r->scene, s.objects[0]);
        put(&w, &s, &owner);
        r->report.paths++;
    }
}

/* --------------------------------------------------------------------------- CSV -- */

static void put_wkt(data_writer *w, const froe_stroke *s, int dim) {
    vector_print(w->output, "\"%s%s (", s->count > 1 ? "LINESTRING" : "POINT", dim > 2 ? " Z" : "");
    put_points(w, s, dim, "", " ", "");
    vector_print(w->output, ")\"");
}

static void put_quoted(data_writer *w, const char *text) {
    vector_print(w->output, "\"");
    for (; *text; text++) vector_put(w->output, *text == '"' ? "\"\"" : text, *text == '"' ? 2 : 1);
    vector_print(w->output, "\"");
}

static void put_row(data_writer *w, const froe_stroke *s, const froe_object *owner) {
    const vector_render *r = w->render;
    const froe_ids ids = r->options->ids;
    put_wkt(w, s, 2);
    vector_print(w->output, ",%s,%d,%d,", froe_line_name(s->kind), s->hidden, leads_back(s));
    const bool group = ids != FROE_IDS_NONE && owner->group != FROE_NONE;
    if (group) vector_print(w->output, "%u", owner->group);
    vector_print(w->output, ",");
    if (group) put_quoted(w, froe_scene_group(r->scene, owner->group).name);
    if (ids == FROE_IDS_FACE)
        vector_print(w->output, ",%u,%u,", r->owners[s->objects[0]], owner->face);
    else
        vector_print(w->output, ",,,");
    put_wkt(w, s, 3);
    vector_print(w->output, "\n");
}

void vector_csv(vector_render *render, vector_output *output) {
    vector_print(output, "WKT,kind,hidden,closed,group,name,object,face,space\n");
    put_lines(render, output, put_row);
}

/* ----------------------------------------------------------------------- GeoJSON -- */

static void put_feature(data_writer *w, const froe_stroke *s, const froe_object *owner) {
    const vector_render *r = w->render;
    const froe_ids ids = r->options->ids;
    vector_print(w->output, "%s{\"type\":\"Feature\",\"properties\":{\"kind\":\"%s\",\"hidden\":%s,\"closed\":%s",
                 r->report.paths ? ",\n" : "", froe_line_name(s->kind), s->hidden ? "true" : "false",
                 leads_back(s) ? "true" : "false");
    if (ids != FROE_IDS_NONE && owner->group != FROE_NONE) {
        vector_print(w->output, ",\"group\":%u,\"name\":\"", owner->group);
        vector_put_json(w->output, froe_scene_group(r->scene, owner->group).name);
        vector_print(w->output, "\"");
    }
    if (ids == FROE_IDS_FACE)
        vector_print(w->output, ",\"object\":%u,\"face\":%u", r->owners[s->objects[0]], owner->face);
    vector_print(w->output, ",\"space\":[");
    put_points(w, s, 3, "[", ",", "]");
    vector_print(w->output, "]},\"geometry\":{\"type\":\"%s\",\"coordinates\":", s->count > 1 ? "LineString" : "Point");
    if (s->count > 1) vector_print(w->output, "[");
    put_points(w, s, 2, "[", ",", "]");
    vector_print(w->output, s->count > 1 ? "]}}" : "}}");
}

/* A member "crs" of null says that coordinates are in no system (GeoJSON of 2008). Without it they are degrees. */
void vector_geojson(vector_render *render, vector_output *output) {
    vector_print(output, "{\"type\":\"FeatureCollection\",\"crs\":null,\"features\":[\n");
    put_lines(render, output, put_feature);
    vector_print(output, "\n]}\n");
}
