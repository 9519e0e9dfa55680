/* scene.c: froe_write_scene: a scene as GeoJSON, CSV, OFF or OBJ, so that
 * froe_read gives it back. */
#include "formats/write/geojson.h"
#include "support/floats.h"
#include <string.h>

typedef struct pen {
    formats_writer writer;
    const froe_scene *scene;
    const char *path;
    froe_diagnostic *diag;
    int dim;
    size_t objects;
} pen;

/* A zero-length segment or zero-area triangle has fewer corners than its kind: the last is repeated. */
static uint32_t corner_of(const pen *p, uint32_t object, const froe_object *o, uint32_t corner) {
    return froe_scene_corner(p->scene, object, corner < o->corners ? corner : o->corners - 1);
}

static uint32_t corners_of(const froe_object *o) {
    uint32_t least = o->kind == FROE_SEGMENT || o->kind == FROE_BOX ? 2 : o->kind == FROE_POLYGON ? 3 : 1;
    return o->corners < least ? least : o->corners;
}

static const double *place_of_corner(const pen *p, uint32_t object, const froe_object *o, uint32_t corner) {
    return froe_scene_vertex(p->scene, corner_of(p, object, o, corner));
}

/* Can the scene be written in this format, which has these kinds (bits)? */
static froe_status check_kinds(const pen *p, const char *format, uint32_t kinds, bool dim_fits) {
    uint32_t other = 0;
    if (!dim_fits)
        return support_fail(p->diag, FROE_E_UNSUPPORTED, "%s: A scene of dimension %d cannot be written as %s.",
                            support_short(p->path), p->dim, format);
    while (other < p->objects && kinds >> froe_scene_object(p->scene, other).kind & 1) ++other;
    if (other == p->objects) return FROE_OK;
    froe_status status =
        support_fail(p->diag, FROE_E_UNSUPPORTED, "%s: object %u: A %s cannot be written as %s.",
                     support_short(p->path), other, froe_kind_name(froe_scene_object(p->scene, other).kind), format);
    if (p->diag) p->diag->object = other;
    return status;
}

/* --------------------------------------------------------------- GeoJSON -- */

static void position(pen *p, const double *at) {
    formats_put(&p->writer, "[");
    formats_put_point(&p->writer, at, 2, ",");
    formats_put(&p->writer, "]");
}

/* Segments, of which several that continue one another share a line. */
static void put_lines(pen *p, uint32_t first, uint32_t end) {
    const bool several = end > first + 1;
    uint32_t last = FROE_NONE;
    for (uint32_t i = first; i < end; ++i) {
        froe_object o = froe_scene_object(p->scene, i);
        if (i == first || corner_of(p, i, &o, 0) != last) {
            formats_put(&p->writer, i > first ? "],[" : several ? "[[" : "[");
            position(p, place_of_corner(p, i, &o, 0));
        }
        formats_put(&p->writer, ",");
        position(p, place_of_corner(p, i, &o, 1));
        last = corner_of(p, i, &o, 1);
    }
    formats_put(&p->writer, several ? "]]" : "]");
}

/* A box as a ring; with `boxes` it is read as the box it was. */
static void put_box(pen *p, const double *lo, const double *hi) {
    const double ring[5][2] = {{lo[0], lo[1]}, {hi[0], lo[1]}, {hi[0], hi[1]}, {lo[0], hi[1]}, {lo[0], lo[1]}};
    for (int i = 0; i < 5; ++i) {
        formats_put(&p->writer, i ? "," : "[[");
        position(p, ring[i]);
    }
    formats_put(&p->writer, "]]");
}

static void write_geojson(pen *p) {
    formats_writer *w = &p->writer;
    formats_geojson_begin(w, p->scene);
    for (uint32_t i = 0, end; i < p->objects; i = end) {
        const froe_object o = froe_scene_object(p->scene, i);
        /* a run of segments that share their group is one feature */
        for (end = i + 1; o.kind == FROE_SEGMENT && o.group != FROE_NONE && end < p->objects; ++end) {
            const froe_object next = froe_scene_object(p->scene, end);
            if (next.kind != FROE_SEGMENT || next.group != o.group) break;
        }
        formats_put(w, i ? ",\n{\"type\":\"Feature\",\"properties\":{" : "\n{\"type\":\"Feature\",\"properties\":{");
        if (o.group != FROE_NONE) {
            const froe_group group = froe_scene_group(p->scene, o.group);
            formats_put(w, "\"name\":");
            formats_put_json(w, group.name);
            formats_put(w, ",\"layer\":");
            formats_put_json(w, group.material);
        }
        formats_put(w, "},\"geometry\":{\"type\":");
        formats_put_json(w, o.kind == FROE_POINT ? "Point"
                            : o.kind == FROE_BOX ? "Polygon"
                            : end == i + 1       ? "LineString"
                                                 : "MultiLineString");
        formats_put(w, ",\"coordinates\":");
        if (o.kind == FROE_POINT) position(p, place_of_corner(p, i, &o, 0));
        if (o.kind == FROE_BOX) put_box(p, place_of_corner(p, i, &o, 0), place_of_corner(p, i, &o, 1));
        if (o.kind == FROE_SEGMENT) put_lines(p, i, end);
        formats_put(w, "}}");
    }
    formats_put(w, FORMATS_GEOJSON_END);
}

/* ------------------------------------------------------------------- CSV -- */

static void header(pen *p, const char *prefix) {
    static const char *const axes[FROE_MAX_DIM] = {"x", "y", "z", "w", "x5", "x6", "x7", "x8"};
    for (int k = 0; k < p->dim; ++k) {
        formats_put(&p->writer, prefix);
        formats_put(&p->writer, axes[k]);
        formats_put(&p->writer, ",");
    }
}

/* Hulls have a row for each corner. */
static void write_csv(pen *p) {
    const froe_kind kind = p->objects ? froe_scene_object(p->scene, 0).kind : FROE_POINT;
    const bool box = kind == FROE_BOX, segment = kind == FROE_SEGMENT, hull = kind == FROE_HULL;
    if (hull) formats_put(&p->writer, "hull,");
    header(p, box ? "lo_" : segment ? "from_" : "");
    if (box || segment) header(p, box ? "hi_" : "to_");
    formats_put(&p->writer, kind == FROE_BALL ? "r,tag\n" : "tag\n");
    for (uint32_t i = 0; i < p->objects; ++i) {
        const froe_object o = froe_scene_object(p->scene, i);
        const uint32_t rows = hull ? o.corners : 1, each = box || segment ? 2 : 1;
        for (uint32_t c = 0; c < rows * each; ++c) {
            if (hull) formats_put_whole(&p->writer, i), formats_put(&p->writer, ",");
            formats_put_point(&p->writer, place_of_corner(p, i, &o, c), p->dim, ",");
            formats_put(&p->writer, ",");
            if ((c + 1) % each) continue;
            if (kind == FROE_BALL) {
                formats_put_number(&p->writer, o.radius);
                formats_put(&p->writer, ",");
            }
            formats_put_whole(&p->writer, o.tag);
            formats_put(&p->writer, "\n");
        }
    }
}

/* ----------------------------------------------------------- OFF and OBJ -- */

static void put_vertices(pen *p, const char *before) {
    uint32_t vertices = (uint32_t)froe_scene_vertex_count(p->scene);
    for (uint32_t i = 0; i < vertices; ++i) {
        formats_put(&p->writer, before);
        formats_put_point(&p->writer, froe_scene_vertex(p->scene, i), 3, " ");
        formats_put(&p->writer, "\n");
    }
}

static void put_indices(pen *p, uint32_t object, const froe_object *o, uint64_t from) {
    uint32_t corners = corners_of(o);
    for (uint32_t c = 0; c < corners; ++c) {
        formats_put(&p->writer, " ");
        formats_put_whole(&p->writer, from + corner_of(p, object, o, c));
    }
    formats_put(&p->writer, "\n");
}

static void write_off(pen *p) {
    formats_put(&p->writer, "OFF\n");
    formats_put_whole(&p->writer, froe_scene_vertex_count(p->scene));
    formats_put(&p->writer, " ");
    formats_put_whole(&p->writer, p->objects);
    formats_put(&p->writer, " 0\n");
    put_vertices(p, "");
    for (uint32_t i = 0; i < p->objects; ++i) {
        froe_object o = froe_scene_object(p->scene, i);
        formats_put_whole(&p->writer, corners_of(&o));
        put_indices(p, i, &o, 0);
    }
}

static void write_obj(pen *p) {
    static const char *const words[FROE_KIND_COUNT] = {"p", "l", "f", "", "", ""};
    put_vertices(p, "v ");
    uint32_t group = FROE_NONE;
    for (uint32_t i = 0; i < p->objects; ++i) {
        froe_object o = froe_scene_object(p->scene, i);
        if (o.group != group) {
            froe_group of = {.name = "", .material = ""};
            if (o.group != FROE_NONE) of = froe_scene_group(p->scene, o.group);
            formats_put(&p->writer, "o ");
            formats_put_word(&p->writer, of.name);
            formats_put(&p->writer, "\nusemtl ");
            formats_put_word(&p->writer, of.material);
            formats_put(&p->writer, "\n");
        }
        group = o.group;
        formats_put(&p->writer, words[o.kind]);
        put_indices(p, i, &o, 1);
    }
}

/* -------------------------------------------------------------------- all -- */

typedef struct kind_of_file {
    const char *extension, *name;
    uint32_t kinds; /* bits of froe_kind */
    int least_dim, most_dim;
    void (*write)(pen *p);
} kind_of_file;

enum { POINTS = 1 << FROE_POINT, SEGMENTS = 1 << FROE_SEGMENT, POLYGONS = 1 << FROE_POLYGON, BOXES = 1 << FROE_BOX };

static const kind_of_file files[] = {
    {"geojson", "GeoJSON", POINTS | SEGMENTS | BOXES, 2, 2, write_geojson},
    {"json", "GeoJSON", POINTS | SEGMENTS | BOXES, 2, 2, write_geojson},
    {"csv", "CSV", POINTS | SEGMENTS | BOXES | 1 << FROE_BALL | 1 << FROE_HULL, 2, FROE_MAX_DIM, write_csv},
    {"off", "OFF", POINTS | SEGMENTS | POLYGONS, 3, 3, write_off},
    {"obj", "OBJ", POINTS | SEGMENTS | POLYGONS, 3, 3, write_obj},
};

froe_status froe_write_scene(const froe_scene *scene, const char *path, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!scene || !path) return support_fail_null(diag, __func__);
    const froe_status checked = froe_scene_check(scene, diag);
    if (checked) return checked;
    pen p = {.scene = scene,
             .path = path,
             .diag = diag,
             .dim = froe_scene_dim(scene),
             .objects = froe_scene_object_count(scene)};
    const support_extension extension = support_path_extension(path);
    const kind_of_file *file = files, *end = files + sizeof files / sizeof *files;
    while (file != end && strcmp(file->extension, extension.text)) ++file;
    if (file == end)
        return support_fail_ending(diag, FROE_E_UNSUPPORTED, path, "scenes", ".geojson, .csv, .off or .obj");
    froe_status status = check_kinds(&p, file->name, file->kinds, p.dim >= file->least_dim && p.dim <= file->most_dim);
    if (!status && file->write == write_csv && p.objects)
        status =
            check_kinds(&p, "CSV together with the kind of object 0", 1u << froe_scene_object(scene, 0).kind, true);
    if (!status && file->write == write_geojson) status = formats_geojson_check(scene, path, diag);
    if (!status) status = formats_writer_open(&p.writer, path, diag);
    if (status) return status;
    file->write(&p);
    return formats_writer_close(&p.writer, FROE_OK);
}
