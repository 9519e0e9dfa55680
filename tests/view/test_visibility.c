/* test_visibility.c: visible pieces and intervals against exact rays.
 *
 * For a ray, the oracle looks at every polygon and finds the nearest that it pierces, in rationals. Exactly one visible
 * piece must hold the ray, of that polygon's patch (or, where polygons coincide in depth, of the patch of highest
 * rank); none where the ray meets nothing or leaves the window. Points of edges are visible unless a polygon lies
 * before them. */
#include "rays.h"
#include "view/visibility/visibility.h"

typedef struct look {
    const froe_tree *tree;
    froe_surface *surface;
    froe_visibility *v;
    froe_eye eye;
    num_context context;
    bool general; /* no edge hides behind another one exactly */
    rational_point from, to;
    uint64_t seen, void_rays, skipped, visible_points, hidden_points;
} look;

static void open_look(look *l, const froe_tree *tree) {
    *l = (look){.tree = tree};
    assert_int_equal(froe_surface_new(tree->scene, NULL, &l->surface, NULL), FROE_OK);
    assert_int_equal(num_context_new(&tree->alloc, &l->context), FROE_OK);
    rational_point_init(&l->from);
    rational_point_init(&l->to);
}

static void close_look(look *l) {
    froe_surface_free(l->surface);
    num_context_free(&l->context);
    rational_point_clear(&l->from);
    rational_point_clear(&l->to);
}

static void from_eye(look *l, const froe_eye *eye) {
    l->eye = *eye;
    rational_point_set(&l->from, 3, eye->at);
    if (eye->parallel) mpq_set_ui(l->from.w, 0, 1);
}

/* ---------------------------------------------------------------------- faces -- */

/* Side of a line of the picture on which a point of space is, from the line's definition. */
static int side_of_point(look *l, uint32_t line, const double *x) {
    const view_line *k = l->v->sights.lines.data + line;
    geom_plane planes[2];
    geom_line h = {.kind = GEOM_SIGHT_EDGE};
    if (k->kind == VIEW_EDGE) {
        h.u = view_vertex(&l->v->sights, k->a), h.v = view_vertex(&l->v->sights, k->b);
    } else {
        assert_int_equal(k->kind, VIEW_CUT);
        scene_support(l->tree->scene, l->surface->members[l->surface->patch_starts[k->a]], &planes[0]);
        planes[1] = tree_plane_at(l->tree, k->b);
        h = (geom_line){.kind = GEOM_SIGHT_CUT, .s = &planes[0], .a = &planes[1]};
    }
    return geom_line_side_point(&l->context, &l->v->sights.eye, &h, x);
}

/* 1 strictly inside, -1 outside, 0 on a side. */
static int inside_piece(look *l, const view_piece *p, const double *x) {
    int least = 1;
    for (uint32_t i = 0; i < p->count; i++) {
        const view_way way = l->v->corners.data[p->first + i].way;
        const int side = (way & 1 ? -1 : 1) * side_of_point(l, way >> 1, x);
        if (side < least) least = side;
    }
    return least;
}

/* The patch seen at x: FROE_NONE nothing. A ray that touches only corners and edges may be on a side: `clear` false. */
static uint32_t expected_patch(look *l, const int32_t *priorities) {
    const froe_scene *s = l->tree->scene;
    mpq_t t, best;
    rational_point x;
    uint32_t found = FROE_NONE;
    mpq_inits(t, best, NULL);
    rational_point_init(&x);
    for (uint32_t o = 0; o < s->object_count; o++) {
        const uint32_t patch = l->surface->patch_of[o];
        if (patch == FROE_NONE || !rays_hit(s, &l->from, &l->to, o, t, &x)) continue;
        const int nearer = found == FROE_NONE ? -1 : mpq_cmp(t, best);
        bool higher = found != FROE_NONE && nearer == 0;
        if (higher) {
            const int32_t a = priorities ? priorities[patch] : 0, b = priorities ? priorities[found] : 0;
            higher = a > b || (a == b && patch > found);
        }
        if (nearer < 0 || higher) found = patch;
        if (nearer < 0) mpq_set(best, t);
    }
    mpq_clears(t, best, NULL);
    rational_point_clear(&x);
    return found;
}

static void check_ray(look *l, const double *x, const int32_t *priorities) {
    uint32_t held = 0, patch = FROE_NONE;
    for (uint32_t i = 0; i < l->v->piece_count; i++) {
        const int inside = inside_piece(l, l->v->pieces + i, x);
        if (inside == 0) {
            l->skipped++;
            return;
        }
        if (inside < 0) continue;
        held++;
        patch = l->v->pieces[i].patch;
    }
    rational_point_set(&l->to, 3, x);
    const uint32_t expected = expected_patch(l, priorities);
    if (held > 1 || patch != expected)
        fail_msg("eye %s(%g, %g, %g), to (%g, %g, %g): patch %d in %u pieces, expected %d",
                 l->eye.parallel ? "along " : "", l->eye.at[0], l->eye.at[1], l->eye.at[2], x[0], x[1], x[2],
                 (int)patch, held, (int)expected);
    l->seen += held;
    l->void_rays += !held;
}

static void random_target(const froe_scene *s, uint64_t seed, uint32_t ray, double x[3]) {
    for (uint32_t k = 0; k < 3; k++)
        x[k] = s->lo[k] + (1.2 * trees_unit(seed, 3 * ray + k) - 0.1) * (s->hi[k] - s->lo[k]);
}

/* ---------------------------------------------------------------------- edges -- */

/* What lies strictly between the eye and the point of an edge that the ray runs to: 1 a polygon, 0 nothing; -1 nothing,
 * but a polygon that does not use the edge touches the point, and it is a matter of taste whether that hides it. */
static int blocked(look *l, const froe_edge *e) {
    const froe_scene *s = l->tree->scene;
    mpq_t t;
    rational_point x;
    int found = 0;
    mpq_init(t);
    rational_point_init(&x);
    for (uint32_t o = 0; o < s->object_count && found < 1; o++) {
        const int where = rays_meet(s, &l->from, &l->to, o, t, &x);
        if (where < 0) continue;
        const int nearer = l->eye.parallel ? -mpq_sgn(t) : -mpq_cmp_ui(t, 1, 1);
        bool own = false;
        for (size_t i = 0; i < e->object_count; i++) own = own || e->objects[i] == o;
        if (nearer > 0 && where > 0) found = 1;
        if (nearer >= 0 && where == 0 && !own && !found) found = -1;
        if (nearer == 0 && !own && !found) found = -1;
    }
    mpq_clear(t);
    rational_point_clear(&x);
    return found;
}

static void check_point(look *l, const froe_edge *e, double t, bool visible) {
    const double *u = scene_vertex(l->tree->scene, e->vertex[0]), *v = scene_vertex(l->tree->scene, e->vertex[1]);
    rational_point_between(&l->to, 3, u, v, t);
    const int found = blocked(l, e);
    if (!l->general && found == 0) return; /* two faces before it may meet just there */
    if (found == visible)
        fail_msg("edge %u-%u at %.17g should be %s", e->vertex[0], e->vertex[1], t, visible ? "hidden" : "visible");
    l->visible_points += found == 0;
    l->hidden_points += found == 1;
}

/* The middle of every interval and of every gap that is no rounding error wide. */
static void check_edge(look *l, uint32_t edge) {
    size_t count;
    const froe_edge e = froe_surface_edge(l->surface, edge);
    const froe_interval *x = froe_visibility_of_edge(l->v, edge, &count);
    double last = 0;
    for (size_t i = 0; i <= count; i++) {
        const double from = i < count ? x[i].from : 1, to = i < count ? x[i].to : 1;
        assert_true(last <= from && from <= to && to <= 1);
        if (from - last > 1e-9) check_point(l, &e, last + 0.5 * (from - last), false);
        if (to - from > 1e-9) check_point(l, &e, from + 0.5 * (to - from), true);
        last = to;
    }
}

/* ---------------------------------------------------------------------- scenes -- */

static void check_eye(look *l, froe_eye eye, uint32_t rays, bool general) {
    froe_visibility_options o = froe_visibility_defaults();
    froe_diagnostic why = {.message = ""};
    double x[3];
    o.eye = eye;
    l->general = general;
    from_eye(l, &eye);
    if (froe_visibility_new(l->tree, l->surface, &o, &l->v, &why)) fail_msg("%s", why.message);
    for (uint32_t r = 0; r < rays; r++) {
        random_target(l->tree->scene, 3, r, x);
        check_ray(l, x, NULL);
    }
    for (uint32_t e = 0; e < l->surface->edge_count; e++) check_edge(l, e);
    froe_visibility_free(l->v);
}

/* An eye in general position: no edge then hides behind another one exactly. */
static bool general(uint32_t e) {
    return e % 5 != 2 && e % 5 != 4;
}

static void check_tree(froe_tree *tree, uint32_t eyes, uint32_t rays) {
    look l;
    open_look(&l, tree);
    for (uint32_t e = 0; e < eyes; e++) check_eye(&l, rays_eye(tree, e), rays, general(e));
    print_message("  %d objects: %d rays see, %d see nothing, %d skipped; points %d visible, %d hidden\n",
                  (int)tree->scene->object_count, (int)l.seen, (int)l.void_rays, (int)l.skipped, (int)l.visible_points,
                  (int)l.hidden_points);
    assert_true(l.seen > rays / 2 && l.visible_points > 20 && l.hidden_points > 20);
    close_look(&l);
    froe_tree_free(tree);
}

static void random_triangles(void **state) {
    (void)state;
    check_tree(trees_grow(3, FROE_POLYGON, 28, 0, 1, "density", 1), 5, 40);
    check_tree(trees_grow(3, FROE_POLYGON, 80, 0, 0.3, "autopartition", 0), 2, 40);
}

static void triangles_of_a_lattice_with_overlaps_in_planes(void **state) {
    (void)state;
    check_tree(trees_grow(3, FROE_POLYGON, 50, 3, 2, "density", 1), 5, 50);
    check_tree(trees_grow(3, FROE_POLYGON, 40, 2, 2, "autopartition", 0), 5, 50);
}

/* Boxes of 6 quadrilaterals that overlap, on a lattice: coplanar faces, T-junctions, collinear edges. */
static froe_scene *boxes(uint32_t count, uint32_t grid) {
    static const int face[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    froe_scene *scene;
    const size_t starts[2] = {0, 4};
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    for (uint32_t b = 0; b < count; b++) {
        double lo[3], hi[3], coords[12];
        for (uint32_t k = 0; k < 3; k++) {
            lo[k] = trees_random(b, 2 * k, grid);
            hi[k] = lo[k] + 1 + trees_random(b, 2 * k + 1, 3);
        }
        for (int f = 0; f < 6; f++) {
            for (int i = 0; i < 4; i++)
                for (int k = 0; k < 3; k++) coords[3 * i + k] = face[f][i] >> k & 1 ? hi[k] : lo[k];
            assert_int_equal(trees_add(scene, FROE_POLYGON, 1, coords, NULL, starts), FROE_OK);
        }
    }
    return scene;
}

/* An eye in the planes of many faces, which are cuts: a line must not shine through what lies in front of it only
 * because the other side of its cut was not looked at yet. */
static void edges_stay_hidden_when_the_eye_is_in_cuts(void **state) {
    (void)state;
    froe_scene *scene = boxes(14, 4);
    froe_tree *tree = trees_build(scene, "density", 0);
    froe_scene_free(scene);
    look l;
    open_look(&l, tree);
    for (int axis = 0; axis < 3; axis++)
        for (int side = -1; side < 2; side += 2) {
            froe_eye eye = {.at = {0, 0, 0}, .parallel = true};
            eye.at[axis] = side;
            check_eye(&l, eye, 30, false);
            const froe_eye near = {.at = {3 + 9 * eye.at[0], 2 + 9 * eye.at[1], 3 + 9 * eye.at[2]}};
            check_eye(&l, near, 30, false);
        }
    print_message("  %d hidden points\n", (int)l.hidden_points);
    assert_true(l.hidden_points > 500);
    close_look(&l);
    froe_tree_free(tree);
}

static void boxes_that_overlap(void **state) {
    (void)state;
    froe_scene *scene = boxes(14, 4);
    check_tree(trees_build(scene, "density", 1), 5, 50);
    froe_scene_free(scene);
}

/* The same polygons, with a corner in the middle of every side, where the border goes straight on. */
static froe_tree *with_middles(const froe_scene *s, const char *method) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    for (uint32_t o = 0; o < s->object_count; o++) {
        const uint32_t n = scene_corners(s, o), count = scene->object_count;
        const size_t starts[2] = {0, 2 * (size_t)n};
        if (scene_form(s, o) != FROE_POLYGON) continue;
        double coords[24];
        for (uint32_t i = 0; i < n; i++)
            for (int k = 0; k < 3; k++) {
                const double a = scene_point(s, o, i)[k], b = scene_point(s, o, i + 1 < n ? i + 1 : 0)[k];
                coords[6 * i + (uint32_t)k] = a;
                coords[6 * i + 3 + (uint32_t)k] = 0.5 * a + 0.5 * b;
            }
        assert_int_equal(trees_add(scene, FROE_POLYGON, 1, coords, NULL, starts), FROE_OK);
        assert_int_equal(scene_corners(scene, count), 2 * n);
    }
    froe_tree *tree = trees_build(scene, method, 1);
    froe_scene_free(scene);
    return tree;
}

/* Each half of a side is an edge, although the beam of its polygon has the whole side. */
static void borders_that_go_straight_on(void **state) {
    (void)state;
    froe_scene *lattice = trees_scene(3, FROE_POLYGON, 40, 3, 2, 1), *solid = boxes(10, 4);
    check_tree(with_middles(lattice, "density"), 2, 30);
    check_tree(with_middles(solid, "autopartition"), 2, 30);
    check_tree(with_middles(solid, "cylindrical"), 2, 20);
    froe_scene_free(lattice), froe_scene_free(solid);
}

/* Each of three slats lies over the next: no order of whole faces paints them. */
static void slats_in_a_cycle_and_crossing(void **state) {
    (void)state;
    froe_scene *scene;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    for (int i = 0; i < 16; i++) {
        const double a = i < 8 ? i : 0, b = i < 8 ? i + 0.5 : 8, y = i < 8 ? 0 : i - 8;
        const double slat[12] = {
            a,           y, i % 3 - 1.0,         b,          y, i % 3 - 1.0, b, i < 8 ? 8 : y + 0.5,
            1.5 - i % 4, a, i < 8 ? 8 : y + 0.5, 1.5 - i % 4};
        const size_t starts[2] = {0, 4};
        assert_int_equal(trees_add(scene, FROE_POLYGON, 1, slat, NULL, starts), FROE_OK);
    }
    check_tree(trees_build(scene, "density", 1), 5, 60);
    froe_scene_free(scene);
}

static void a_window_shows_what_is_behind_it_and_nothing_else(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 80, 0, 1, "density", 1);
    look l;
    open_look(&l, tree);
    for (int turn = 0; turn < 2; turn++) {
        double window[15] = {0.2, 0.2, 0.9, 0.7, 0.25, 0.9, 0.85, 0.6, 0.9, 0.5, 0.9, 0.9, 0.15, 0.6, 0.9}, x[3];
        for (int k = 0; k < 3 && turn; k++) {
            for (int i = 0; i < 2; i++) {
                const double swap = window[3 * i + k];
                window[3 * i + k] = window[3 * (4 - i) + k], window[3 * (4 - i) + k] = swap;
            }
        }
        froe_visibility_options o = froe_visibility_defaults();
        o.eye = (froe_eye){.at = {0.4, 0.5, 3}};
        o.window = window, o.window_corners = 5;
        from_eye(&l, &o.eye);
        assert_int_equal(froe_visibility_new(tree, l.surface, &o, &l.v, NULL), FROE_OK);
        for (uint32_t r = 0; r < 300; r++) {
            random_target(tree->scene, 5, r, x);
            /* strictly inside or outside the cone over the window */
            const geom_eye eye = geom_eye_make(false, o.eye.at, NULL);
            bool inside = true;
            for (int i = 0; i < 5; i++) {
                const geom_line side = {.u = window + 3 * i, .v = window + 3 * ((i + 1) % 5)};
                const int s = geom_line_side_point(&l.context, &eye, &side, x);
                assert_int_not_equal(s, 0);
                inside = inside && s == (turn ? -1 : 1);
            }
            if (inside)
                check_ray(&l, x, NULL);
            else
                for (uint32_t i = 0; i < l.v->piece_count; i++) assert_true(inside_piece(&l, l.v->pieces + i, x) < 1);
        }
        assert_true(l.seen > 5);
        froe_visibility_free(l.v);
    }
    close_look(&l);
    froe_tree_free(tree);
}

static void priorities_decide_within_planes(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 60, 2, 2, "density", 1);
    look l;
    open_look(&l, tree);
    int32_t *priorities = calloc(l.surface->patch_count, sizeof *priorities);
    for (uint32_t p = 0; p < l.surface->patch_count; p++) priorities[p] = (int32_t)trees_random(4, p, 5) - 2;
    for (int side = -1; side <= 1; side += 2) {
        froe_visibility_options o = froe_visibility_defaults();
        double x[3];
        o.eye = (froe_eye){.at = {0.31, 0.47, 9.1 * side}};
        o.priorities = priorities;
        from_eye(&l, &o.eye);
        assert_int_equal(froe_visibility_new(tree, l.surface, &o, &l.v, NULL), FROE_OK);
        for (uint32_t r = 0; r < 100; r++) {
            random_target(tree->scene, 6, r, x);
            check_ray(&l, x, priorities);
        }
        froe_visibility_free(l.v);
    }
    assert_true(l.seen > 50);
    free(priorities);
    close_look(&l);
    froe_tree_free(tree);
}

/* With everything clear, the pieces along a ray are all polygons it pierces, front to back. */
static void one_sees_through_what_is_clear(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 40, 0, 1, "density", 1);
    look l;
    open_look(&l, tree);
    uint8_t *clear = calloc(l.surface->patch_count, 1);
    memset(clear, 1, l.surface->patch_count);
    froe_visibility_options o = froe_visibility_defaults();
    o.eye = (froe_eye){.at = {0.3, 0.4, 5}};
    o.clear = clear;
    from_eye(&l, &o.eye);
    assert_int_equal(froe_visibility_new(tree, l.surface, &o, &l.v, NULL), FROE_OK);
    for (uint32_t r = 0; r < 100; r++) {
        double x[3];
        uint32_t held = 0, hits = 0;
        mpq_t t;
        rational_point at;
        mpq_init(t);
        rational_point_init(&at);
        random_target(tree->scene, 7, r, x);
        rational_point_set(&l.to, 3, x);
        for (uint32_t i = 0; i < l.v->piece_count; i++) held += inside_piece(&l, l.v->pieces + i, x) > 0;
        for (uint32_t i = 0; i < 40; i++) hits += rays_hit(tree->scene, &l.from, &l.to, i, t, &at);
        assert_int_equal(held, hits);
        l.seen += hits;
        mpq_clear(t);
        rational_point_clear(&at);
    }
    print_message("  %d layers\n", (int)l.seen);
    assert_true(l.seen > 50);
    froe_visibility_free(l.v);
    free(clear);
    close_look(&l);
    froe_tree_free(tree);
}

static void corners_lie_where_they_are_seen(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 60, 0, 1, "density", 1);
    look l;
    open_look(&l, tree);
    for (uint32_t e = 0; e < 4; e++) {
        froe_visibility_options o = froe_visibility_defaults();
        o.eye = rays_eye(tree, e);
        assert_int_equal(froe_visibility_new(tree, l.surface, &o, &l.v, NULL), FROE_OK);
        for (size_t i = 0; i < froe_visibility_piece_count(l.v); i++) {
            const froe_visible p = froe_visibility_piece(l.v, i);
            double x[3 * 40];
            geom_plane plane;
            scene_support(tree->scene, p.object, &plane);
            assert_int_equal(froe_visibility_corners(l.v, i, x, 40), p.corners);
            for (uint32_t c = 0; c < p.corners; c++) {
                double off = 0, size = 0;
                for (int k = 0; k < 3; k++)
                    off += plane.n[k] * (x[3 * c + (uint32_t)k] - plane.p[0][k]), size += fabs(plane.n[k]);
                assert_true(fabs(off) <= 1e-9 * size * 10);
                for (uint32_t s = 0; s < p.corners; s++) { /* on the positive side of all sides, up to rounding */
                    const view_spot *side = l.v->corners.data + l.v->pieces[i].first + s;
                    const filter_vector ray = geom_ray_image(&l.v->sights.eye, x + 3 * (size_t)c);
                    filter_vector n = l.v->sights.lines.data[side->way >> 1].image;
                    const double at = filter_dot(&n, &ray).x * (side->way & 1 ? -1 : 1);
                    assert_true(at >= -1e-8 * n.most * ray.most);
                }
            }
        }
        froe_visibility_free(l.v);
    }
    close_look(&l);
    froe_tree_free(tree);
}

static void bad_views_are_refused(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 20, 0, 1, "density", 1);
    froe_tree *other = trees_grow(3, FROE_POLYGON, 20, 0, 1, "density", 1);
    froe_surface *surface;
    froe_visibility *v = NULL;
    froe_diagnostic why;
    assert_int_equal(froe_surface_new(tree->scene, NULL, &surface, &why), FROE_OK);
    froe_visibility_options o = froe_visibility_defaults();
    const double flat[9] = {0, 0, 1, 1, 1, 1, 2, 2, 1}, nan[9] = {(double)NAN};
    o.eye.at[2] = 3;
    assert_int_equal(froe_visibility_new(other, surface, &o, &v, &why), FROE_E_ARG);
    o.window = flat, o.window_corners = 2;
    assert_int_equal(froe_visibility_new(tree, surface, &o, &v, &why), FROE_E_OPTIONS);
    o.window_corners = 3;
    assert_int_equal(froe_visibility_new(tree, surface, &o, &v, &why), FROE_E_INPUT);
    assert_non_null(strstr(why.message, "convex"));
    o.window = nan;
    assert_int_equal(froe_visibility_new(tree, surface, &o, &v, &why), FROE_E_OPTIONS);
    o.window = NULL, o.eye.at[0] = (double)INFINITY;
    assert_int_equal(froe_visibility_new(tree, surface, &o, &v, &why), FROE_E_ARG);
    o.size = 0;
    assert_int_equal(froe_visibility_new(tree, surface, &o, &v, &why), FROE_E_OPTIONS);
    assert_null(v);
    froe_surface_free(surface);
    froe_tree_free(tree), froe_tree_free(other);
}

/* Triangles beside each other at many depths: lines across the window and sides of others divide them, which tells
 * nothing, as all of them are seen. */
static void what_is_seen_whole_is_kept_whole(void **state) {
    enum { SIDE = 12 };
    (void)state;
    froe_scene *scene;
    froe_surface *surface;
    froe_visibility *v;
    double x[SIDE * SIDE * 9];
    size_t n = 0;
    for (int i = 0; i < SIDE; i++)
        for (int j = 0; j < SIDE; j++)
            for (int k = 0; k < 3; k++)
                x[n++] = i + 0.8 * (k == 1), x[n++] = j + 0.9 * (k == 2), x[n++] = (7 * i + 5 * j) % 11 + 0.125 * k;
    froe_objects triangles = froe_objects_defaults();
    triangles.count = n / 9, triangles.coords = x;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &triangles, NULL), FROE_OK);
    froe_tree *tree;
    assert_int_equal(froe_build(scene, NULL, &tree, NULL), FROE_OK);
    froe_scene_free(scene); /* the tree holds it */
    assert_int_equal(froe_surface_new(tree->scene, NULL, &surface, NULL), FROE_OK);
    const double window[12] = {-1, -1, 20, SIDE + 1, -1, 20, SIDE + 1, SIDE + 1, 20, -1, SIDE + 1, 20};
    froe_visibility_options o = froe_visibility_defaults();
    o.eye = (froe_eye){.at = {0, 0, 1}, .parallel = true};
    o.window = window, o.window_corners = 4;
    assert_int_equal(froe_visibility_new(tree, surface, &o, &v, NULL), FROE_OK);
    assert_int_equal(froe_visibility_piece_count(v), froe_tree_piece_count(tree));
    assert_int_equal(froe_visibility_statistics(v).visible_patches, SIDE * SIDE);
    froe_visibility_free(v);
    froe_surface_free(surface);
    froe_tree_free(tree);
}

/* How many predicates it takes to see n thin triangles, side by side in one face, from above. */
static uint64_t predicates_of_a_strip(uint32_t n) {
    froe_scene *scene;
    froe_tree *tree;
    froe_surface *surface;
    froe_visibility *v;
    double *x = calloc(9 * (size_t)n, sizeof *x);
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < 3; k++) x[9 * i + 3 * k] = i + k, x[9 * i + 3 * k + 1] = (i + k) % 2 ? 1e4 : 0;
    froe_objects triangles = froe_objects_defaults();
    triangles.count = n, triangles.coords = x;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &triangles, NULL), FROE_OK);
    assert_int_equal(froe_build(scene, NULL, &tree, NULL), FROE_OK);
    assert_int_equal(froe_surface_new(scene, NULL, &surface, NULL), FROE_OK);
    froe_visibility_options o = froe_visibility_defaults();
    o.eye = (froe_eye){.at = {0, 0, 1}, .parallel = true};
    assert_int_equal(froe_visibility_new(tree, surface, &o, &v, NULL), FROE_OK);
    const froe_visibility_report report = froe_visibility_statistics(v);
    assert_int_equal(report.visible_patches, 1);
    froe_visibility_free(v);
    froe_surface_free(surface);
    froe_tree_free(tree);
    froe_scene_free(scene);
    free(x);
    return report.predicates.calls;
}

/* In the order of the scene each would lie beyond the sides of all before it, and twice as many take four times the
 * work. */
static void thin_triangles_of_a_face_make_no_high_tree(void **state) {
    (void)state;
    assert_true(predicates_of_a_strip(2000) < 3 * predicates_of_a_strip(1000));
}

/* Afterwards every line is the window's, or something visible ends on it, and is found again under its number. */
static void lines_of_what_is_hidden_are_forgotten(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 400, 0, 1, "density", 1);
    froe_surface *surface;
    froe_visibility *v;
    const double window[12] = {-1, -1, 1.5, 2, -1, 1.5, 2, 2, 1.5, -1, 2, 1.5};
    froe_visibility_options o = froe_visibility_defaults();
    o.eye.at[2] = 3;
    o.window = window, o.window_corners = 4;
    assert_int_equal(froe_surface_new(tree->scene, NULL, &surface, NULL), FROE_OK);
    assert_int_equal(froe_visibility_new(tree, surface, &o, &v, NULL), FROE_OK);
    const size_t count = v->sights.lines.count;
    uint32_t cuts = 0, edges = 0;
    uint8_t *used = calloc(count, 1);
    for (size_t i = 0; i < v->corners.count; i++) used[v->corners.data[i].way >> 1] = 1;
    for (uint32_t i = 0; i < 2 * v->interval_count; i++)
        if (v->interval_marks[i].vertex == FROE_NONE) used[v->interval_marks[i].way >> 1] = 1;
    for (uint32_t e = 0; e < surface->edge_count; e++)
        if (v->edge_starts[e] < v->edge_starts[e + 1]) used[v->sights.of_edge[e] - 1] = 1;
    for (uint32_t i = 0; i < count; i++) {
        const view_line l = v->sights.lines.data[i];
        if (l.kind == VIEW_EDGE && l.c == FROE_NONE) continue;
        assert_true(used[i]);
        assert_int_equal(
            l.kind == VIEW_CUT ? view_line_of_cut(&v->sights, l.a, l.b) : view_line_of_edge(&v->sights, l.c), i);
        *(l.kind == VIEW_CUT ? &cuts : &edges) += 1;
    }
    assert_int_equal(v->sights.lines.count, count); /* none was made anew */
    assert_true(cuts > 100 && edges > 100);
    assert_true((double)count < 0.9 * (double)froe_visibility_statistics(v).lines);
    free(used);
    froe_visibility_free(v);
    froe_surface_free(surface);
    froe_tree_free(tree);
}

/* Of the edges of polygons whose borders go straight on, and of others. */
static void edges_that_are_not_wanted_have_no_intervals(void **state) {
    (void)state;
    froe_scene *solid = boxes(6, 4);
    froe_tree *trees[2] = {with_middles(solid, "density"), trees_build(solid, "density", 1)};
    froe_scene_free(solid);
    for (int i = 0; i < 2; i++) {
        froe_surface *surface;
        froe_visibility *all, *some;
        froe_visibility_options o = froe_visibility_defaults();
        size_t n, m, wanted = 0;
        o.eye = (froe_eye){.at = {9, 7, 20}};
        assert_int_equal(froe_surface_new(trees[i]->scene, NULL, &surface, NULL), FROE_OK);
        uint8_t *edges = calloc(surface->edge_count, 1);
        for (uint32_t e = 0; e < surface->edge_count; e++) edges[e] = trees_random(3, e, 2) > 0;
        assert_int_equal(froe_visibility_new(trees[i], surface, &o, &all, NULL), FROE_OK);
        o.edges = edges;
        assert_int_equal(froe_visibility_new(trees[i], surface, &o, &some, NULL), FROE_OK);
        for (uint32_t e = 0; e < surface->edge_count; e++) {
            const froe_interval *x = froe_visibility_of_edge(all, e, &n), *y = froe_visibility_of_edge(some, e, &m);
            assert_int_equal(m, edges[e] ? n : 0);
            for (size_t k = 0; k < m; k++) assert_true(x[k].from == y[k].from && x[k].to == y[k].to);
            wanted += m;
        }
        assert_true(wanted > 10 && wanted < froe_visibility_statistics(all).intervals);
        free(edges);
        froe_visibility_free(all);
        froe_visibility_free(some);
        froe_surface_free(surface);
        froe_tree_free(trees[i]);
    }
}

static bool stop(void *user, double done) {
    (void)user;
    return done < 0.05;
}

static void looking_can_be_cancelled(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 1500, 0, 0.1, "density", 1);
    froe_surface *surface;
    froe_visibility *v = NULL;
    assert_int_equal(froe_surface_new(tree->scene, NULL, &surface, NULL), FROE_OK);
    froe_visibility_options o = froe_visibility_defaults();
    o.eye.at[2] = 3;
    o.progress = stop;
    assert_int_equal(froe_visibility_new(tree, surface, &o, &v, NULL), FROE_E_CANCELLED);
    froe_surface_free(surface);
    froe_tree_free(tree);
}

static froe_status look_with(void *user, const froe_allocator *alloc) {
    froe_tree *tree = user;
    froe_surface *surface = NULL;
    froe_visibility *v = NULL;
    const double window[12] = {-1, -1, 1.5, 2, -1, 1.5, 2, 2, 1.5, -1, 2, 1.5};
    froe_visibility_options o = froe_visibility_defaults();
    o.eye.at[2] = 3;
    o.alloc = alloc;
    o.window = window, o.window_corners = 4;
    froe_status status = froe_surface_new(tree->scene, alloc, &surface, NULL);
    if (!status) status = froe_visibility_new(tree, surface, &o, &v, NULL);
    froe_visibility_free(v);
    froe_surface_free(surface);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(3, FROE_POLYGON, 40, 3, 1, "density", 1);
    assert_true(test_memory_each(look_with, tree) > 20);
    froe_tree_free(tree);
    froe_scene *solid = boxes(2, 2);
    tree = with_middles(solid, "density");
    assert_true(test_memory_each(look_with, tree) > 20);
    froe_tree_free(tree);
    froe_scene_free(solid);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_triangles),
        cmocka_unit_test(triangles_of_a_lattice_with_overlaps_in_planes),
        cmocka_unit_test(boxes_that_overlap),
        cmocka_unit_test(borders_that_go_straight_on),
        cmocka_unit_test(edges_stay_hidden_when_the_eye_is_in_cuts),
        cmocka_unit_test(slats_in_a_cycle_and_crossing),
        cmocka_unit_test(a_window_shows_what_is_behind_it_and_nothing_else),
        cmocka_unit_test(priorities_decide_within_planes),
        cmocka_unit_test(one_sees_through_what_is_clear),
        cmocka_unit_test(corners_lie_where_they_are_seen),
        cmocka_unit_test(bad_views_are_refused),
        cmocka_unit_test(what_is_seen_whole_is_kept_whole),
        cmocka_unit_test(thin_triangles_of_a_face_make_no_high_tree),
        cmocka_unit_test(lines_of_what_is_hidden_are_forgotten),
        cmocka_unit_test(edges_that_are_not_wanted_have_no_intervals),
        cmocka_unit_test(looking_can_be_cancelled),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
