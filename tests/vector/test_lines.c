/* test_lines.c: lines in SVG, read back in whole steps of its grid: each is drawn once, none is without length, no path
 * is empty, and whatever is left out for that is counted. */
#include "support/small_scenes.h"
#include <froe/render.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct segment {
    int64_t a[2], b[2];
} segment;

typedef struct page {
    segment *data;
    size_t count, room, subpaths;
    bool empty; /* there is a path without points, or a subpath without a line */
} page;

/* ---------------------------------------------------------------------- reading -- */

static void add_segment(page *p, const int64_t *a, const int64_t *b) {
    if (p->count == p->room) p->data = realloc(p->data, (p->room = 2 * p->room + 64) * sizeof *p->data);
    p->data[p->count++] = (segment){{a[0], a[1]}, {b[0], b[1]}};
}

static int64_t number(const char **d) {
    char *end;
    while (**d == ' ' || **d == ',') ++*d;
    const int64_t x = strtoll(*d, &end, 10);
    assert_true(end != *d);
    *d = end;
    return x;
}

/* The commands that the writer uses: m l h v z. */
static void read_path(page *p, const char *d) {
    int64_t at[2] = {0, 0}, start[2] = {0, 0};
    size_t first = p->count;
    char command = 0;
    bool begun = false;
    if (*d == '"') p->empty = true;
    for (; *d != '"';) {
        if (*d >= 'a' && *d <= 'z')
            command = *d++;
        else if (command == 'm')
            command = 'l';
        int64_t to[2] = {at[0], at[1]};
        if (command == 'z') {
            add_segment(p, at, start);
            memcpy(at, start, sizeof at);
            continue;
        }
        if (command != 'v') to[0] += number(&d);
        if (command != 'h') to[1] += number(&d);
        if (command == 'm') {
            if (begun && p->count == first) p->empty = true;
            memcpy(start, to, sizeof start);
            first = p->count;
            begun = true;
            p->subpaths++;
        } else {
            assert_non_null(strchr("lhv", command));
            add_segment(p, at, to);
        }
        memcpy(at, to, sizeof at);
    }
    if (p->count == first) p->empty = true;
}

static page read_lines(const char *svg) {
    page p = {NULL, 0, 0, 0, strstr(svg, "d=\"\"") != NULL};
    for (const char *at = svg; (at = strstr(at, "<path class=\"")) != NULL;) {
        const char *d = strstr(at, " d=\"");
        read_path(&p, d + 4);
        at = d;
    }
    return p;
}

/* ----------------------------------------------------------------------- checks -- */

static int64_t cross(const int64_t *a, const int64_t *b, const int64_t *c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/* Do two segments have more than a point in common? All in whole numbers. */
static bool overlap(const segment *s, const segment *t) {
    if (cross(s->a, s->b, t->a) || cross(s->a, s->b, t->b)) return false;
    const int k = s->a[0] == s->b[0];
    const int64_t s_lo = s->a[k] < s->b[k] ? s->a[k] : s->b[k], s_hi = s->a[k] + s->b[k] - s_lo,
                  t_lo = t->a[k] < t->b[k] ? t->a[k] : t->b[k], t_hi = t->a[k] + t->b[k] - t_lo;
    return s_lo < t_hi && t_lo < s_hi;
}

static char *render(const froe_tree *tree, const char *name, const froe_render_options *o, froe_render_report *report) {
    froe_diagnostic why = {.message = ""};
    if (froe_render(tree, name, o, report, &why)) fail_msg("%s: %s", name, why.message);
    FILE *file = fopen(name, "rb");
    char *text = calloc(report->bytes + 1, 1);
    assert_non_null(file);
    assert_int_equal(fread(text, 1, report->bytes, file), report->bytes);
    fclose(file);
    return text;
}

static void check(const froe_tree *tree, const froe_render_options *o, uint64_t sums[3]) {
    froe_render_report r;
    char *svg = render(tree, "lines.svg", o, &r);
    page p = read_lines(svg);
    assert_false(p.empty);
    assert_int_equal(p.subpaths, r.strokes);
    assert_int_equal(r.strokes + r.short_strokes, r.picture.strokes);
    assert_int_equal(r.shapes + r.thin_shapes, r.picture.shapes);
    for (size_t i = 0; i < p.count; i++) {
        assert_true(p.data[i].a[0] != p.data[i].b[0] || p.data[i].a[1] != p.data[i].b[1]);
        for (size_t j = 0; j < i; j++)
            if (overlap(p.data + i, p.data + j))
                fail_msg("(%d, %d) to (%d, %d) is drawn twice", (int)p.data[i].a[0], (int)p.data[i].a[1],
                         (int)p.data[i].b[0], (int)p.data[i].b[1]);
    }
    sums[0] += p.count, sums[1] += r.short_strokes, sums[2] += r.thin_shapes;
    free(p.data), free(svg);
}

/* ----------------------------------------------------------------------- scenes -- */

/* Boxes of whole size that stand on and beside each other, a sheet that is all but seen edge-on from the front, and one
 * that is too small for any picture. */
static froe_tree *pile(uint64_t seed) {
    froe_scene *scene = scene_of(3);
    for (int b = 0; b < 8; b++) {
        double lo[3], hi[3], x[72];
        static const int face[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                       {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
        const size_t starts[7] = {0, 4, 8, 12, 16, 20, 24};
        for (int k = 0; k < 3; k++) {
            lo[k] = (double)(int)(6 * next_random(&seed));
            hi[k] = lo[k] + 1 + (double)(int)(4 * next_random(&seed));
        }
        for (int i = 0; i < 72; i++) x[i] = (face[i / 12][i / 3 % 4] >> i % 3 & 1 ? hi : lo)[i % 3];
        add(scene, FROE_POLYGON, 6, x, NULL, starts);
    }
    const double sheets[] = {-3,      -5, 0,  -1, -5,           0,  -1, 5,  0x1p-30, -3,         5,
                             0x1p-30, -2, -9, 2,  -2 + 0x1p-20, -9, 2,  -2, -9,      2 + 0x1p-20};
    const size_t starts[] = {0, 4, 7};
    add(scene, FROE_POLYGON, 2, sheets, NULL, starts);
    return tree_of(scene, "density", 1);
}

static void lines_are_drawn_once_and_have_a_length(void **state) {
    (void)state;
    static const double from[4][3] = {{0, -1, 0}, {0, 0, 1}, {1, 0, 0}, {1, -2, 2}};
    uint64_t sums[3] = {0, 0, 0};
    for (uint64_t seed = 1; seed <= 3; seed++) {
        froe_tree *tree = pile(seed);
        for (int look = 0; look < 12; look++) {
            froe_render_options o = froe_render_defaults();
            const bool technical = look / 4 == 1;
            o.camera.parallel = true;
            memcpy(o.camera.eye, from[look % 4], sizeof from[0]);
            o.paint = look / 4 == 0 ? FROE_PAINT_REGIONS : FROE_PAINT_WHOLE;
            o.shading = technical ? FROE_SHADE_NONE : FROE_SHADE_WHITE;
            o.seams = FROE_SEAMS_NONE;
            o.hidden = technical;
            o.ids = FROE_IDS_FACE;
            check(tree, &o, sums);
        }
        froe_tree_free(tree);
    }
    print_message("  %d lines, %d too short, %d shapes too thin\n", (int)sums[0], (int)sums[1], (int)sums[2]);
    assert_true(sums[0] > 1000 && sums[1] > 0 && sums[2] > 0);
}

/* Other files come from the same lines, on a grid of 1/256 of a point. */
static void all_files_count_what_they_hold(void **state) {
    (void)state;
    froe_tree *tree = pile(1);
    froe_render_options o = froe_render_defaults();
    froe_render_report r;
    static const char *const names[] = {"lines.pdf", "lines.eps"};
    for (int i = 0; i < 2; i++) {
        free(render(tree, names[i], &o, &r));
        assert_int_equal(r.strokes + r.short_strokes, r.picture.strokes);
        assert_true(r.short_strokes > 0 && r.strokes > 5);
    }
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_are_drawn_once_and_have_a_length),
        cmocka_unit_test(all_files_count_what_they_hold),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
