/* test_data.c: lines as data beside the same lines in SVG: one for one, to the last bit of what SVG rounds, kept apart
 * by object or face as the files say; and rows and features that say the same. */
#include "support/small_scenes.h"
#include "vector/pages.h"
#include <math.h>
#include <stdio.h>

/* Three boxes that pass through each other: of a wall and of a roof with an odd name, of the roof, of nothing. */
static froe_tree *boxes(void) {
    static const int face[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    static const double lo[3][3] = {{0, 0, 0}, {-1, -1, 2}, {1, 3, 0}}, hi[3][3] = {{4, 4, 3}, {5, 5, 4}, {2, 7, 2}};
    static const char *const names[2] = {"wall", "\"roof\", tiles\n\xFF"};
    const size_t starts[4] = {0, 4, 8, 12};
    froe_scene *scene = scene_of(3);
    uint32_t groups[2];
    for (int g = 0; g < 2; g++) {
        const froe_group group = {.name = names[g], .material = ""};
        assert_int_equal(froe_scene_add_group(scene, &group, &groups[g]), FROE_OK);
    }
    for (int b = 0; b < 3; b++) {
        double x[72];
        uint32_t faces[6];
        for (int i = 0; i < 72; i++) x[i] = (face[i / 12][i / 3 % 4] >> i % 3 & 1 ? hi : lo)[b][i % 3];
        for (uint32_t f = 0; f < 6; f++) faces[f] = 6 * (uint32_t)b;
        for (int half = 0; half < 2; half++) {
            froe_objects o = froe_objects_defaults();
            o.count = 3, o.coords = x + 36 * half, o.starts = starts, o.faces = faces;
            if (b < 2) o.group = groups[b || half];
            assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
        }
    }
    return tree_of(scene, "density", 1);
}

static froe_render_options options_of(froe_ids ids, froe_layers layers) {
    froe_render_options o = froe_render_defaults();
    o.hidden = true;
    o.ids = ids;
    o.layers = layers;
    o.camera.width = 640, o.camera.height = 480;
    o.camera.margin = 10;
    return o;
}

typedef struct line {
    froe_stroke says;
    double points[64], space[96];
    uint32_t objects[32];
} line;

typedef struct lines {
    line at[400];
    size_t count, most;
} lines;

static bool keep_line(void *user, const froe_stroke *s) {
    lines *all = user;
    line *x = all->at + all->count;
    assert_true(s->count >= 2 && s->count <= 32 && all->count < 400);
    *x = (line){.says = *s};
    memcpy(x->points, s->points, 2 * s->count * sizeof *s->points);
    memcpy(x->space, s->space, 3 * s->count * sizeof *s->space);
    memcpy(x->objects, s->objects, s->count * sizeof *s->objects);
    return ++all->count != all->most;
}

static lines *lines_of(const froe_tree *tree, const froe_render_options *o) {
    lines *all = calloc(1, sizeof *all);
    froe_render_report report;
    assert_int_equal(froe_render_lines(tree, keep_line, all, o, &report, NULL), FROE_OK);
    assert_int_equal(report.strokes, all->count);
    assert_int_equal(report.shapes, 0);
    return all;
}

/* ------------------------------------------------------------------------- in SVG -- */

/* An attribute of the element that begins at `at`, or "". */
static const char *attribute(const char *at, const char *name, char out[200]) {
    char key[40];
    snprintf(key, sizeof key, " %s=\"", name);
    const char *end = strstr(at, "/>"), *found = strstr(at, key);
    *out = '\0';
    if (!found || found > end) return out;
    found += strlen(key);
    const size_t length = (size_t)(strchr(found, '"') - found);
    memcpy(out, found, length);
    out[length] = '\0';
    return out;
}

static int64_t number(const char **d) {
    char *end;
    const int64_t x = strtoll(*d, &end, 10);
    assert_true(end != *d);
    *d = end;
    return x;
}

/* Follows one line of a path, and compares its points. *at: where the last one ended. */
static void follow(const char **d, int64_t at[2], const line *x) {
    int64_t begin[2] = {0, 0};
    char command = *(*d)++;
    assert_int_equal(command, 'm');
    for (size_t i = 0; i < x->says.count; i++) {
        int64_t step[2];
        for (int k = 0; k < 2; k++) step[k] = (int64_t)floor(x->points[2 * i + k] * 100 + 0.5);
        if (i && step[0] == at[0] && step[1] == at[1]) continue; /* two points that fall together are one */
        if (i && **d >= 'a') command = *(*d)++;
        if (command != 'v') at[0] += number(d);
        if (command != 'h') at[1] += number(d);
        if (command == 'm') memcpy(begin, at, sizeof begin), command = 'l';
        assert_true(at[0] == step[0] && at[1] == step[1]);
    }
    assert_int_equal(x->says.closed, **d == 'z');
    if (**d == 'z') ++*d, memcpy(at, begin, sizeof begin);
}

static void compare_with_svg(const froe_tree *tree, const froe_render_options *o) {
    const froe_scene *scene = froe_tree_scene(tree);
    lines *all = lines_of(tree, o);
    page_bytes svg = page_of(tree, FROE_RENDER_SVG, o, NULL);
    size_t i = 0;
    froe_surface *surface;
    assert_int_equal(froe_surface_new(scene, NULL, &surface, NULL), FROE_OK);
    for (const char *at = svg.text; (at = strstr(at, "<path class=\"")); at++) {
        char text[200], expected[200];
        int64_t place[2] = {0, 0};
        const char *d = strstr(at, " d=\"") + 4;
        for (bool any = true; any; any = *d != '"', i++) {
            assert_true(i < all->count);
            const line *x = all->at + i;
            const froe_object owner = froe_scene_object(scene, x->objects[0]);
            snprintf(expected, sizeof expected, "%s%s", froe_line_name(x->says.kind), x->says.hidden ? " hidden" : "");
            assert_memory_equal(at + strlen("<path class=\""), expected, strlen(expected));
            const bool ids = o->ids != FROE_IDS_NONE;
            assert_string_equal(attribute(at, "data-kind", text), ids ? froe_line_name(x->says.kind) : "");
            const char *name = owner.group == FROE_NONE ? ""
                               : owner.group            ? "&quot;roof&quot;, tiles\n\xEF\xBF\xBD"
                                                        : "wall";
            assert_string_equal(attribute(at, "data-group", text), ids ? name : "");
            *expected = '\0';
            if (o->ids == FROE_IDS_FACE)
                snprintf(expected, sizeof expected, "%u",
                         froe_surface_patch(surface, froe_surface_patch_of(surface, x->objects[0])).objects[0]);
            assert_string_equal(attribute(at, "data-object", text), expected);
            follow(&d, place, x);
        }
    }
    assert_int_equal(i, all->count);
    assert_true(i > 10);
    froe_surface_free(surface);
    free(svg.text), free(all);
}

static void each_line_of_an_svg_is_one_of_the_data(void **state) {
    (void)state;
    froe_tree *tree = boxes();
    for (int ids = FROE_IDS_NONE; ids <= FROE_IDS_FACE; ids++)
        for (int layers = FROE_LAYERS_NONE; layers <= FROE_LAYERS_KIND; layers++) {
            const froe_render_options o = options_of((froe_ids)ids, (froe_layers)layers);
            compare_with_svg(tree, &o);
        }
    froe_tree_free(tree);
}

static uint32_t group_of(const froe_tree *tree, uint32_t object) {
    return froe_scene_object(froe_tree_scene(tree), object).group;
}

static void lines_are_kept_apart_by_object_and_by_face(void **state) {
    (void)state;
    froe_tree *tree = boxes();
    size_t counts[3];
    for (int ids = FROE_IDS_NONE; ids <= FROE_IDS_FACE; ids++) {
        const froe_render_options o = options_of((froe_ids)ids, FROE_LAYERS_NONE);
        lines *all = lines_of(tree, &o);
        counts[ids] = all->count;
        for (size_t i = 0; ids && i < all->count; i++)
            for (size_t k = 0; k < all->at[i].says.count; k++) {
                const uint32_t a = all->at[i].objects[0], b = all->at[i].objects[k];
                assert_int_equal(group_of(tree, a), group_of(tree, b));
                if (ids == FROE_IDS_FACE) assert_int_equal(a, b); /* faces of one polygon each */
            }
        free(all);
    }
    assert_true(counts[0] < counts[1] && counts[1] < counts[2]);
    froe_tree_free(tree);
}

/* ------------------------------------------------------------------------- as text -- */

static void put(char **out, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void put(char **out, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    *out += vsprintf(*out, format, arguments);
    va_end(arguments);
}

static void put_real(char **out, double x) {
    char text[40];
    snprintf(text, sizeof text, "%.15g", x);
    put(out, strtod(text, NULL) == x ? "%.15g" : "%.17g", x);
}

static void put_points(char **out, const line *x, int dim, const char *format[3]) {
    for (size_t i = 0; i < x->says.count + x->says.closed; i++) {
        put(out, "%s%s", i ? "," : "", format[0]);
        for (int k = 0; k < dim; k++) {
            const double *p = (dim == 2 ? x->points : x->space) + (size_t)dim * (i % x->says.count);
            put(out, "%s", k ? format[1] : "");
            put_real(out, dim == 2 && k ? 480 - p[1] : p[k]);
        }
        put(out, "%s", format[2]);
    }
}

/* The files as this test would write them. */
static void files_say_what_the_lines_are(void **state) {
    (void)state;
    static const char *wkt[3] = {"", " ", ""}, *json[3] = {"[", ",", "]"};
    froe_tree *tree = boxes();
    const froe_scene *scene = froe_tree_scene(tree);
    for (int ids = FROE_IDS_NONE; ids <= FROE_IDS_FACE; ids++) {
        const froe_render_options o = options_of((froe_ids)ids, FROE_LAYERS_NONE);
        lines *all = lines_of(tree, &o);
        char *csv = calloc(2, 1 << 18), *geojson = csv + (1 << 18), *row = csv, *feature = geojson;
        put(&row, "WKT,kind,hidden,closed,group,name,object,face,space\n");
        put(&feature, "{\"type\":\"FeatureCollection\",\"crs\":null,\"features\":[\n");
        for (size_t i = 0; i < all->count; i++) {
            const line *x = all->at + i;
            const froe_object owner = froe_scene_object(scene, x->objects[0]);
            const char *kind = froe_line_name(x->says.kind);
            put(&row, "\"LINESTRING (");
            put_points(&row, x, 2, wkt);
            put(&row, ")\",%s,%d,%d,", kind, x->says.hidden, x->says.closed);
            put(&feature, "%s{\"type\":\"Feature\",\"properties\":{\"kind\":\"%s\",\"hidden\":%s,\"closed\":%s",
                i ? ",\n" : "", kind, x->says.hidden ? "true" : "false", x->says.closed ? "true" : "false");
            if (ids && owner.group != FROE_NONE) {
                put(&row, "%u,\"%s\",", owner.group, owner.group ? "\"\"roof\"\", tiles\n\xFF" : "wall");
                put(&feature, ",\"group\":%u,\"name\":\"%s\"", owner.group,
                    owner.group ? "\\\"roof\\\", tiles\\u000a\\ufffd" : "wall");
            } else
                put(&row, ",,");
            if (ids == FROE_IDS_FACE) {
                put(&row, "%u,%u,", x->objects[0], owner.face);
                put(&feature, ",\"object\":%u,\"face\":%u", x->objects[0], owner.face);
            } else
                put(&row, ",,");
            put(&row, "\"LINESTRING Z (");
            put_points(&row, x, 3, wkt);
            put(&row, ")\"\n");
            put(&feature, ",\"space\":[");
            put_points(&feature, x, 3, json);
            put(&feature, "]},\"geometry\":{\"type\":\"LineString\",\"coordinates\":[");
            put_points(&feature, x, 2, json);
            put(&feature, "]}}");
        }
        put(&feature, "\n]}\n");
        page_bytes found[2] = {page_of(tree, FROE_RENDER_CSV, &o, NULL), page_of(tree, FROE_RENDER_GEOJSON, &o, NULL)};
        assert_string_equal(found[0].text, csv);
        assert_string_equal(found[1].text, geojson);
        free(found[0].text), free(found[1].text), free(csv), free(all);
    }
    froe_tree_free(tree);
}

/* ----------------------------------------------------------------------- receivers -- */

static void a_receiver_stops_the_lines_when_it_likes(void **state) {
    (void)state;
    froe_tree *tree = boxes();
    lines *all = calloc(1, sizeof *all);
    all->most = 3;
    assert_int_equal(froe_render_lines(tree, keep_line, all, NULL, NULL, NULL), FROE_OK);
    assert_int_equal(all->count, 3);
    assert_int_equal(froe_render_lines(tree, NULL, all, NULL, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_render_lines(NULL, keep_line, all, NULL, NULL, NULL), FROE_E_ARG);
    free(all);
    froe_tree_free(tree);
}

static bool count_lines(void *user, const froe_stroke *x) {
    *(size_t *)user += x->count;
    return true;
}

static froe_status count_with(void *user, const froe_allocator *alloc) {
    froe_render_options o = options_of(FROE_IDS_FACE, FROE_LAYERS_OBJECT);
    size_t points = 0;
    o.alloc = alloc;
    return froe_render_lines(user, count_lines, &points, &o, NULL, NULL);
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    froe_tree *tree = boxes();
    assert_true(test_memory_each(count_with, tree) > 30);
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_line_of_an_svg_is_one_of_the_data),
        cmocka_unit_test(lines_are_kept_apart_by_object_and_by_face),
        cmocka_unit_test(files_say_what_the_lines_are),
        cmocka_unit_test(a_receiver_stops_the_lines_when_it_likes),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
