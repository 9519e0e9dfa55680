/* test_overlay.c: where lines lie on each other one is drawn, the strongest, and nothing else goes away.
 *
 * The oracle lists, edge by edge, what the visibility says is seen of each, which may lie on each other as it likes,
 * and samples both: every point of an edge has to lie on a stroke, every point of a stroke on an edge, of the strongest
 * kind there, and no two strokes may have a stretch in common. All coordinates are small whole numbers at odd angles,
 * so that lines that are not equal are far apart. On a page where the whole scene is a hundredth of a pixel wide no
 * line is taken for another because they are near: what is drawn once there was found to be equal exactly. */
#include "pages.h"
#include "view/visibility/order.h"

enum { MOST = 40 };

/* ----------------------------------------------------------------------- scenes -- */

typedef struct sheets {
    double x[MOST][12];
    size_t count;
} sheets;

/* A parallelogram, after a rotation by an odd angle (and a threefold enlargement), which is exact. */
static void add_sheet(sheets *s, const int at[3], const int u[3], const int v[3]) {
    static const int turn[3][3] = {{2, -1, 2}, {2, 2, -1}, {-1, 2, 2}};
    double *x = s->x[s->count++];
    assert_true(s->count <= MOST);
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) {
            x[3 * i + k] = 0;
            for (int c = 0; c < 3; c++)
                x[3 * i + k] += turn[k][c] * (at[c] + (i == 1 || i == 2 ? u[c] : 0) + (i > 1 ? v[c] : 0));
        }
}

static int whole(uint32_t seed, uint32_t i, int lo, int hi) {
    return lo + (int)trees_random(seed, i, (uint32_t)(hi - lo + 1));
}

/* A floor of strips, each divided at places of its own: T-junctions all over. */
static void lay_floor(sheets *s, uint32_t seed) {
    for (int strip = 0, n = 0; strip < 4; strip++)
        for (int from = 0; from < 12;) {
            const int to = from + whole(seed, (uint32_t)n++, 1, 5), end = to > 12 ? 12 : to;
            add_sheet(s, (int[]){from, 3 * strip, 0}, (int[]){end - from, 0, 0}, (int[]){0, 3, 0});
            from = end;
        }
}

/* Sheets that hinge on stretches of one line, nested and overlapping, all in planes of their own. */
static void hinge(sheets *s, uint32_t seed) {
    for (uint32_t i = 0; i < 12; i++) {
        const int from = whole(seed, 4 * i, 0, 8), to = whole(seed, 4 * i + 1, from + 1, 12);
        add_sheet(s, (int[]){from, 0, 0}, (int[]){to - from, 0, 0},
                  (int[]){whole(seed, 4 * i + 2, -2, 2), (int)i - 6, whole(seed, 4 * i + 3, 1, 5)});
    }
}

/* Boxes that stand on and beside each other: rooms, and what is hidden in them. */
static void pile(sheets *s, uint32_t seed) {
    for (uint32_t b = 0; b < 6; b++) {
        int at[3], size[3][3] = {{0}};
        for (int k = 0; k < 3; k++) {
            at[k] = whole(seed, 6 * b + (uint32_t)k, 0, 5);
            size[k][k] = whole(seed, 6 * b + 3 + (uint32_t)k, 1, 4);
        }
        for (int k = 0; k < 3; k++) {
            const int *u = size[(k + 1) % 3], *v = size[(k + 2) % 3];
            const int across[3] = {at[0] + size[k][0], at[1] + size[k][1], at[2] + size[k][2]};
            add_sheet(s, at, v, u);
            add_sheet(s, across, u, v);
        }
    }
}

/* Sheets behind each other, so that their edges are one line to an eye at (1, 1, 1), or at (2, -1, 2) turned. */
static void stagger(sheets *s, uint32_t seed) {
    for (uint32_t i = 0; i < 14; i++) {
        const int back = whole(seed, 5 * i, -6, 6), left = whole(seed, 5 * i + 1, -4, 4);
        add_sheet(s, (int[]){back + left, back, back}, (int[]){whole(seed, 5 * i + 2, 1, 5), 0, 0},
                  (int[]){0, whole(seed, 5 * i + 3, 1, 5), whole(seed, 5 * i + 4, 0, 1)});
    }
}

static froe_tree *tree_of_sheets(void (*fill)(sheets *, uint32_t), uint32_t seed) {
    sheets s = {.count = 0};
    size_t starts[MOST + 1];
    fill(&s, seed);
    for (size_t i = 0; i <= s.count; i++) starts[i] = 4 * i;
    return trees_of_polygons(s.x[0], starts, s.count, "density");
}

/* ----------------------------------------------------------------------- oracle -- */

typedef struct line {
    double a[2], b[2];
    int strength; /* 0: it is there, but not visible */
} line;

typedef struct lines {
    line *data;
    size_t count, room;
} lines;

/* By docs/reference/render.md: a visible line before a hidden one (0), then the wider, then the first of its width. */
static int strength_of(uint32_t kind) {
    return kind == FROE_LINE_SECTION      ? 8
           : kind == FROE_LINE_BORDER     ? 7
           : kind == FROE_LINE_SILHOUETTE ? 6
           : kind == FROE_LINE_CROSSING   ? 5
           : kind == FROE_LINE_OBJECT     ? 4
           : kind == FROE_LINE_MATERIAL   ? 3
           : kind == FROE_LINE_CREASE     ? 2
                                          : 1;
}

static void add_line(lines *l, const double *a, const double *b, int strength) {
    if (l->count == l->room) l->data = realloc(l->data, (l->room = 2 * l->room + 64) * sizeof *l->data);
    l->data[l->count++] = (line){{a[0], a[1]}, {b[0], b[1]}, strength};
}

/* How far a point is from a line, and the share of the line that is nearest to it. */
static double away(const line *l, const double *x, double *share) {
    const double d[2] = {l->b[0] - l->a[0], l->b[1] - l->a[1]}, square = d[0] * d[0] + d[1] * d[1];
    double t = square > 0 ? ((x[0] - l->a[0]) * d[0] + (x[1] - l->a[1]) * d[1]) / square : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    *share = t;
    return hypot(l->a[0] + t * d[0] - x[0], l->a[1] + t * d[1] - x[1]);
}

static double length_between(const double *a, const double *b) {
    return hypot(b[0] - a[0], b[1] - a[1]);
}

/* The stretch of space from a to b between shares; `beyond` the section nothing is. */
static void add_stretch(const page *p, lines *out, const double *a, const double *b, double from, double to,
                        int strength) {
    double x[2][3], at[2][2];
    for (int k = 0; k < 3; k++) x[0][k] = a[k] + from * (b[k] - a[k]), x[1][k] = a[k] + to * (b[k] - a[k]);
    if (!froe_project(&p->view, x[0], at[0]) || !froe_project(&p->view, x[1], at[1])) return;
    add_line(out, at[0], at[1], strength);
}

/* The share of an edge that the section has left. */
static bool keep(const page *p, const double *a, const double *b, double share[2]) {
    double at[2] = {0, 0};
    share[0] = 0, share[1] = 1;
    if (!p->section) return true;
    for (int k = 0; k < 3; k++) at[0] += p->section[k] * a[k], at[1] += p->section[k] * b[k];
    for (int e = 0; e < 2; e++) at[e] -= p->section[3];
    if (at[0] > 0) share[0] = at[0] / (at[0] - at[1]);
    if (at[1] > 0) share[1] = at[0] / (at[0] - at[1]);
    return (at[0] < 0 || at[1] < 0 || (at[0] == 0 && at[1] == 0)) && share[0] < share[1];
}

static void find_kinds(const page *p, uint8_t *kinds) {
    const froe_allocator alloc = support_allocator(NULL);
    geom_eye eye;
    view_sightlines s;
    assert_int_equal(view_eye_of(p->tree, &p->view.eye, &eye, NULL), FROE_OK);
    assert_int_equal(view_sightlines_new(&s, p->tree, p->surface, &eye, NULL, 0, &alloc), FROE_OK);
    view_line_kinds(&s, p->options.lines, p->options.crease, kinds);
    view_sightlines_free(&s);
}

/* All that is seen of each edge and crossing, and, with hidden lines, all of each. */
static lines list_all(const page *p) {
    lines out = {NULL, 0, 0};
    const froe_surface *s = p->surface;
    uint8_t *kinds = calloc(s->edge_count + 1, 1);
    froe_visibility_options o = froe_visibility_defaults();
    froe_visibility *v;
    size_t count;
    o.eye = p->view.eye, o.window = p->view.window, o.window_corners = 4, o.section = p->options.section;
    o.crossings = true, o.hidden_crossings = p->options.hidden;
    find_kinds(p, kinds);
    assert_int_equal(froe_visibility_new(p->tree, s, &o, &v, NULL), FROE_OK);
    for (uint32_t e = 0; e < s->edge_count; e++) {
        const froe_edge edge = froe_surface_edge(s, e);
        const double *a = scene_vertex(s->scene, edge.vertex[0]), *b = scene_vertex(s->scene, edge.vertex[1]);
        const froe_interval *x = froe_visibility_of_edge(v, e, &count);
        double share[2];
        if (!kinds[e]) continue;
        for (size_t i = 0; i < count; i++) add_stretch(p, &out, a, b, x[i].from, x[i].to, strength_of(kinds[e]));
        if (p->options.hidden && keep(p, a, b, share)) add_stretch(p, &out, a, b, share[0], share[1], 0);
    }
    const froe_crossing *c = froe_visibility_crossings(v, &count);
    for (size_t i = 0; i < count; i++)
        add_stretch(p, &out, c[i].from, c[i].to, 0, 1,
                    c[i].hidden ? 0 : strength_of(c[i].section ? FROE_LINE_SECTION : FROE_LINE_CROSSING));
    froe_visibility_free(v);
    free(kinds);
    return out;
}

static lines list_drawn(const page *p) {
    lines out = {NULL, 0, 0};
    for (size_t i = 0; i < froe_picture_stroke_count(p->picture); i++) {
        const froe_stroke s = froe_picture_stroke(p->picture, i);
        for (size_t k = 0; k + !s.closed < s.count; k++)
            add_line(&out, s.points + 2 * k, s.points + 2 * ((k + 1) % s.count), s.hidden ? 0 : strength_of(s.kind));
    }
    return out;
}

/* ----------------------------------------------------------------------- checks -- */

typedef struct sums {
    double drawn, twice; /* lengths, in parts of the scene: drawn, and what would have been drawn twice */
    uint64_t points;
} sums;

/* No two have a stretch in common. */
static void check_apart(const lines *drawn, double fine) {
    for (size_t i = 0; i < drawn->count; i++)
        for (size_t j = 0; j < i; j++) {
            const line *a = drawn->data + i, *b = drawn->data + j;
            double from, to;
            const double *ends[2] = {b->a, b->b};
            double at[2][2];
            away(a, ends[0], &from), away(a, ends[1], &to);
            for (int k = 0; k < 2; k++) {
                at[0][k] = a->a[k] + from * (a->b[k] - a->a[k]);
                at[1][k] = a->a[k] + to * (a->b[k] - a->a[k]);
            }
            double share;
            const bool on = away(b, at[0], &share) < fine && away(b, at[1], &share) < fine;
            if (on && length_between(at[0], at[1]) > 100 * fine)
                fail_msg("from (%.17g, %.17g) to (%.17g, %.17g) two lines are drawn", at[0][0], at[0][1], at[1][0],
                         at[1][1]);
        }
}

static bool on_page(const page *p, const double *x) {
    return x[0] > 0 && x[1] > 0 && x[0] < p->view.width && x[1] < p->view.height;
}

/* The greatest strength of those that a point is on; -1: it is on none. *ends: it is where one of them ends. */
static int strongest(const lines *l, const double *x, double fine, bool *ends) {
    int most = -1;
    *ends = false;
    for (size_t i = 0; i < l->count; i++) {
        double share;
        if (away(l->data + i, x, &share) > fine) continue;
        *ends = *ends || length_between(l->data[i].a, x) < 3 * fine || length_between(l->data[i].b, x) < 3 * fine;
        if (l->data[i].strength > most) most = l->data[i].strength;
    }
    return most;
}

/* Points of one list are on lines of the other, as visible, and, where that is asked for, as strong. */
static void check_points(const page *p, const lines *of, const lines *on, double fine, bool equal, sums *sum) {
    for (size_t i = 0; i < of->count; i++)
        for (int k = 0; k < 5; k++) {
            const line *l = of->data + i;
            const double t = (k + 0.381966) / 5;
            const double x[2] = {l->a[0] + t * (l->b[0] - l->a[0]), l->a[1] + t * (l->b[1] - l->a[1])};
            bool ends;
            if (!on_page(p, x)) continue;
            const int most = strongest(on, x, fine, &ends);
            if (most < 0 || (!ends && (equal ? most != l->strength : most < l->strength)))
                fail_msg("at (%.17g, %.17g): strength %d, and %d in the other list", x[0], x[1], l->strength, most);
            sum->points++;
        }
}

static double total(const lines *l) {
    double sum = 0;
    for (size_t i = 0; i < l->count; i++)
        if (l->data[i].strength) sum += length_between(l->data[i].a, l->data[i].b);
    return sum;
}

/* How much a unit of the scene is on the page, about: what is less than a billionth of that is rounding. */
static void check_lines(page *p, double unit, sums *sum) {
    froe_diagnostic why = {.message = ""};
    if (froe_picture_new(p->tree, p->surface, &p->options, &p->picture, &why)) fail_msg("%s", why.message);
    lines all = list_all(p), drawn = list_drawn(p);
    check_apart(&drawn, 1e-9 * unit);
    /* A line that is nearer to another than the page can tell gives way to it. */
    const double near = p->options.hidden ? 5.1e-5 : 2.6e-6, reach = near * (p->view.width + p->view.height);
    check_points(p, &all, &drawn, unit < 1e-2 ? 1e-8 * unit : reach, false, sum);
    check_points(p, &drawn, &all, 1e-8 * unit, true, sum);
    sum->drawn += total(&drawn) / unit;
    sum->twice += (total(&all) - total(&drawn)) / unit;
    free(all.data), free(drawn.data);
    froe_picture_free(p->picture);
}

/* From six sides; at full size, and at a size at which only equal lines are one. */
static void check_scene(froe_tree *tree, const double *section, sums *sum) {
    static const double from[6][3] = {{1, 1, 1}, {0, 0, 1}, {2, -1, 2}, {3, 3, 3}, {-5, 2, 1}, {2, 2, -1}};
    page p;
    open_page(&p, tree);
    p.options.lines = 255;
    p.section = section;
    p.options.section = section ? -1 : 0;
    for (int hidden = 0; hidden < 2; hidden++)
        for (int e = 0; e < 6; e++) {
            p.options.hidden = hidden;
            look_from(&p, from[e][0], from[e][1], from[e][2], 0);
            check_lines(&p, 10, sum);
            look_from(&p, from[e][0], from[e][1], from[e][2], 1e-4);
            check_lines(&p, 1e-4, sum);
            p.options.halo = 1, p.options.interleave = 1;
            check_lines(&p, 1e-4, sum);
            p.options.halo = p.options.interleave = 0;
        }
    p.options.hidden = false;
    for (uint32_t e = 0; e < 12; e += 2) { /* eyes at points, also in the midst and in planes of the scene */
        set_view(&p, e);
        check_lines(&p, 10, sum);
    }
    close_page(&p);
}

static void check_all(void (*fill)(sheets *, uint32_t), const double *section, double least) {
    sums sum = {0, 0, 0};
    for (uint32_t seed = 1; seed <= 6; seed++) {
        froe_tree *tree = tree_of_sheets(fill, seed), *cut = NULL;
        if (section) assert_int_equal(froe_tree_section(tree, section, NULL, &cut, NULL), FROE_OK);
        check_scene(cut ? cut : tree, section, &sum);
        froe_tree_free(cut), froe_tree_free(tree);
    }
    print_message("  %.0f drawn, %.0f more would be drawn twice; %d points\n", sum.drawn, sum.twice, (int)sum.points);
    assert_true(sum.twice > least * sum.drawn);
}

static void t_junctions_of_a_floor_are_drawn_once(void **state) {
    (void)state;
    check_all(lay_floor, NULL, 0.1);
}

static void nested_edges_on_one_line_are_drawn_once(void **state) {
    (void)state;
    check_all(hinge, NULL, 0.02);
}

static void edges_of_boxes_that_touch_are_drawn_once(void **state) {
    (void)state;
    check_all(pile, NULL, 0.02);
}

static void edges_behind_each_other_are_drawn_once(void **state) {
    (void)state;
    check_all(stagger, NULL, 0.001);
}

/* A slanting plane, and one from the side of which walls are seen edge-on. */
static void lines_of_sections_are_drawn_once(void **state) {
    (void)state;
    check_all(pile, (const double[4]){1, 2, 3, 40}, 0.02);
    check_all(pile, (const double[4]){2, -1, 2, 7}, 0.02);
}

/* Two panes whose edges are one line but for the rounding of a model: on the page that is one line. */
static void edges_that_the_page_cannot_tell_apart_are_drawn_once(void **state) {
    (void)state;
    const double x[] = {0, 0,     0, 10, 0, 0, 10, 10, 0, 0, 10, 0, /* the near one */
                        2, -1e-7, 0, 8,  0, 0, 8,  -5, 0, 2, -5, 0};
    const size_t starts[] = {0, 4, 8};
    froe_tree *tree = trees_of_polygons(x, starts, 2, "density");
    page p;
    double length = 0;
    open_page(&p, tree);
    p.options.lines = FROE_LINE_BORDER;
    look_from(&p, 0, 0, 1, 10);
    check_view(&p, 1, 1);
    for (size_t i = 0; i < froe_picture_stroke_count(p.picture); i++) {
        const froe_stroke s = froe_picture_stroke(p.picture, i);
        length += length_of(&s);
    }
    assert_true(fabs(length - (400 + 160)) < 1e-3);
    froe_picture_free(p.picture);
    close_page(&p);
    froe_tree_free(tree);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(t_junctions_of_a_floor_are_drawn_once),
        cmocka_unit_test(nested_edges_on_one_line_are_drawn_once),
        cmocka_unit_test(edges_of_boxes_that_touch_are_drawn_once),
        cmocka_unit_test(edges_behind_each_other_are_drawn_once),
        cmocka_unit_test(lines_of_sections_are_drawn_once),
        cmocka_unit_test(edges_that_the_page_cannot_tell_apart_are_drawn_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
