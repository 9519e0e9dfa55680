/* scene.c: froe_write_scene: a scene as GeoJSON, CSV, OFF or OBJ, so that
 * froe_read gives it back. */
#include "formats/write/writer.h"
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

/* The first object whose kind is not among the kinds (bits); FROE_NONE: all are. */
static uint32_t first_other(const pen *p, uint32_t kinds) {
    for (uint32_t i = 0; i < p->objects; ++i)
        if (!(kinds >> froe_scene_object(p->scene, i).kind & 1)) return i;
    return FROE_NONE;
}

static froe_status check_kinds(const pen *p, const char *format, uint32_t kinds, bool dim_fits) {
    uint32_t other = first_other(p, kinds);
    if (dim_fits && other == FROE_NONE) return FROE_OK;
    if (!dim_fits)
        return support_fail(p->diag, FROE_E_UNSUPPORTED, "%s: a scene of dimension %d cannot be written as %s",
                            support_short(p->path), p->dim, format);
    froe_status status =
        support_fail(p->diag, FROE_E_UNSUPPORTED, "%s: object %u, a %s, cannot be written as %s",
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

static void begin_feature(pen *p, uint32_t first, const froe_object *o, const char *type) {
    formats_put(&p->writer,
                first ? ",\n{\"type\":\"Feature\",\"properties\":{" : "\n{\"type\":\"Feature\",\"properties\":{");
    if (o->group != FROE_NONE) {
        froe_group group = froe_scene_group(p->scene, o->group);
        formats_put(&p->writer, "\"name\":");
        formats_put_json(&p->writer, group.name);
        formats_put(&p->writer, ",\"layer\":");
        formats_put_json(&p->writer, group.material);
    }
    formats_put(&p->writer, "},\"geometry\":{\"type\":");
    formats_put_json(&p->writer, type);
    formats_put(&p->writer, ",\"coordinates\":");
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

/* The end of the run of segments from `first` that share its group. */
static uint32_t run_end(const pen *p, uint32_t first, const froe_object *o) {
    uint32_t end = first + 1;
    while (o->group != FROE_NONE && end < p->objects) {
        froe_object next = froe_scene_object(p->scene, end);
        if (next.kind != FROE_SEGMENT || next.group != o->group) break;
        ++end;
    }
    return end;
}

static void put_scene_line(pen *p, const double *a, const double *b) {
    formats_put(&p->writer, "[");
    position(p, a);
    formats_put(&p->writer, ",");
    position(p, b);
    formats_put(&p->writer, "]");
}

/* Segments that continue one another share a line. */
static void put_lines(pen *p, uint32_t first, uint32_t end) {
    uint32_t last = FROE_NONE;
    for (uint32_t i = first; i < end; ++i) {
        froe_object o = froe_scene_object(p->scene, i);
        if (i == first || corner_of(p, i, &o, 0) != last) {
            formats_put(&p->writer, i > first ? "],[" : "[[");
            position(p, place_of_corner(p, i, &o, 0));
        }
        formats_put(&p->writer, ",");
        position(p, place_of_corner(p, i, &o, 1));
        last = corner_of(p, i, &o, 1);
    }
    formats_put(&p->writer, "]]");
}

static const char *type_of(froe_kind kind, uint32_t objects) {
    if (kind == FROE_POINT) return "Point";
    if (kind == FROE_BOX) return "Polygon";
    return objects == 1 ? "LineString" : "MultiLineString";
}

static void write_geojson(pen *p) {
    formats_put(&p->writer, "{\"type\":\"FeatureCollection\",\"features\":[");
    for (uint32_t i = 0, end; i < p->objects; i = end) {
        froe_object o = froe_scene_object(p->scene, i);
        end = o.kind == FROE_SEGMENT ? run_end(p, i, &o) : i + 1;
        begin_feature(p, i, &o, type_of(o.kind, end - i));
        if (o.kind == FROE_POINT) position(p, place_of_corner(p, i, &o, 0));
        if (o.kind == FROE_BOX) put_box(p, place_of_corner(p, i, &o, 0), place_of_corner(p, i, &o, 1));
        if (o.kind == FROE_SEGMENT && end == i + 1)
            put_scene_line(p, place_of_corner(p, i, &o, 0), place_of_corner(p, i, &o, 1));
        if (o.kind == FROE_SEGMENT && end > i + 1) put_lines(p, i, end);
        formats_put(&p->writer, "}}");
    }
    formats_put(&p->writer, "\n]}\n");
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

static void write_csv(pen *p) {
    froe_kind kind = p->objects ? froe_scene_object(p->scene, 0).kind : FROE_POINT;
    header(p, kind == FROE_BOX ? "lo_" : "");
    if (kind == FROE_BOX) header(p, "hi_");
    formats_put(&p->writer, kind == FROE_BALL ? "r,tag\n" : "tag\n");
    for (uint32_t i = 0; i < p->objects; ++i) {
        froe_object o = froe_scene_object(p->scene, i);
        for (uint32_t c = 0; c < (kind == FROE_BOX ? 2u : 1u); ++c) {
            formats_put_point(&p->writer, place_of_corner(p, i, &o, c), p->dim, ",");
            formats_put(&p->writer, ",");
        }
        if (kind == FROE_BALL) {
            formats_put_number(&p->writer, o.radius);
            formats_put(&p->writer, ",");
        }
        formats_put_whole(&p->writer, o.tag);
        formats_put(&p->writer, "\n");
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

static void put_group(pen *p, uint32_t id) {
    froe_group group = {.name = "", .material = ""};
    if (id != FROE_NONE) group = froe_scene_group(p->scene, id);
    formats_put(&p->writer, "o ");
    formats_put_word(&p->writer, group.name);
    formats_put(&p->writer, "\nusemtl ");
    formats_put_word(&p->writer, group.material);
    formats_put(&p->writer, "\n");
}

static void write_obj(pen *p) {
    static const char *const words[FROE_KIND_COUNT] = {"p", "l", "f", "", "", ""};
    put_vertices(p, "v ");
    uint32_t group = FROE_NONE;
    for (uint32_t i = 0; i < p->objects; ++i) {
        froe_object o = froe_scene_object(p->scene, i);
        if (o.group != group) put_group(p, o.group);
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
    {"csv", "CSV", POINTS | BOXES | 1 << FROE_BALL, 2, FROE_MAX_DIM, write_csv},
    {"off", "OFF", POINTS | SEGMENTS | POLYGONS, 3, 3, write_off},
    {"obj", "OBJ", POINTS | SEGMENTS | POLYGONS, 3, 3, write_obj},
};

static const kind_of_file *find_place(const char *path) {
    formats_extension extension = formats_path_extension(path);
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i)
        if (!strcmp(files[i].extension, extension.text)) return &files[i];
    return NULL;
}

static froe_status check_written_scene(const pen *p, const kind_of_file *file) {
    if (!file)
        return support_fail(p->diag, FROE_E_UNSUPPORTED, "%s: a scene is written to .geojson, .csv, .off or .obj",
                            support_short(p->path));
    bool fits = p->dim >= file->least_dim && p->dim <= file->most_dim;
    froe_status status = check_kinds(p, file->name, file->kinds, fits);
    if (status || file->write != write_csv || !p->objects) return status;
    return check_kinds(p, "CSV together with the kind of object 0", 1u << froe_scene_object(p->scene, 0).kind, true);
}

froe_status froe_write_scene(const froe_scene *scene, const char *path, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!scene || !path) return support_fail(diag, FROE_E_ARG, "froe_write_scene: scene and path must not be NULL");
    pen p = {.scene = scene,
             .path = path,
             .diag = diag,
             .dim = froe_scene_dim(scene),
             .objects = froe_scene_object_count(scene)};
    const kind_of_file *file = find_place(path);
    froe_status status = check_written_scene(&p, file);
    if (!status) status = formats_writer_open(&p.writer, path, diag);
    if (status) return status;
    file->write(&p);
    return formats_writer_close(&p.writer, FROE_OK);
}
