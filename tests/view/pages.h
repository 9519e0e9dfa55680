/* pages.h: what is painted last at a point of the page against what an exact ray through it meets first.
 *
 * The oracle of test_visibility.c, one step further: shapes, as they are handed to a writer, before rounding. With
 * patches that one sees through, the whole stack of layers down to the first opaque one must be painted, farthest
 * first. A section takes points of the scene away. */
#ifndef FROE_TESTS_VIEW_PAGES_H
#define FROE_TESTS_VIEW_PAGES_H
#include "rays.h"
#include "view/picture/picture.h"

typedef struct page {
    const froe_tree *tree;
    froe_surface *surface;
    froe_projection view;
    froe_picture_options options;
    froe_picture *picture;
    rational_point from, to;
    const double *section; /* what lies where section[0..2] . x > section[3] is not there; NULL */
    uint64_t shown, empty, layers;
} page;

static inline void open_page(page *p, const froe_tree *tree) {
    *p = (page){.tree = tree, .options = froe_picture_defaults()};
    assert_int_equal(froe_surface_new(tree->scene, NULL, &p->surface, NULL), FROE_OK);
    p->options.view = &p->view;
    rational_point_init(&p->from);
    rational_point_init(&p->to);
}

static inline void close_page(page *p) {
    froe_surface_free(p->surface);
    rational_point_clear(&p->from);
    rational_point_clear(&p->to);
}

static inline bool inside_shape(const page *p, const froe_shape *s, double x, double y) {
    int turns = 0;
    for (size_t r = 0; r < s->ring_count; r++) {
        size_t n;
        const double *ring = froe_picture_ring(p->picture, s->first_ring + r, &n);
        for (size_t i = 0; i < n; i++) {
            const double *a = ring + 2 * i, *b = ring + 2 * ((i + 1) % n);
            if ((a[1] <= y) == (b[1] <= y)) continue;
            if (((a[0] - x) * (b[1] - y) - (b[0] - x) * (a[1] - y) > 0) == (b[1] > y)) turns += b[1] > y ? 1 : -1;
        }
    }
    return turns != 0;
}

/* The point of space at a place of the page, at the distance of the scene. */
static inline void point_at(const page *p, double x, double y, double out[3]) {
    for (int k = 0; k < 3; k++) {
        const double *w = p->view.window;
        out[k] = w[k] + (w[3 + k] - w[k]) * (x / p->view.width) + (w[9 + k] - w[k]) * (y / p->view.height);
    }
}

typedef struct layer {
    uint32_t patch, place;
    double t;
} layer;

static inline bool is_clear(const page *p, uint32_t patch) {
    return p->options.clear && p->options.clear[patch];
}

/* Has the section taken this point away? */
static inline bool is_away(const page *p, const rational_point *x) {
    if (!p->section) return false;
    mpq_t sum, term;
    mpq_inits(sum, term, NULL);
    for (int k = 0; k < 4; k++) {
        mpq_set_d(term, p->section[k]);
        mpq_mul(term, term, k < 3 ? x->x[k] : x->w);
        if (k < 3)
            mpq_add(sum, sum, term);
        else
            mpq_sub(sum, sum, term);
    }
    const bool away = mpq_sgn(sum) * mpq_sgn(x->w) > 0;
    mpq_clears(sum, term, NULL);
    return away;
}

/* Patches met by the ray, nearest first, down to the first opaque one. */
static inline uint32_t layers_of(page *p, layer *out, uint32_t most) {
    const froe_scene *s = p->tree->scene;
    uint32_t count = 0, kept = 0;
    mpq_t t, *ts = calloc(most, sizeof *ts);
    rational_point x;
    mpq_init(t);
    rational_point_init(&x);
    for (uint32_t o = 0; o < s->object_count && count < most; o++) {
        const uint32_t patch = p->surface->patch_of[o];
        if (patch == FROE_NONE || !rays_hit(s, &p->from, &p->to, o, t, &x) || is_away(p, &x)) continue;
        uint32_t i = count++;
        mpq_init(ts[i]);
        for (; i && (mpq_cmp(ts[i - 1], t) > 0 || (mpq_equal(ts[i - 1], t) && out[i - 1].patch < patch)); i--) {
            mpq_set(ts[i], ts[i - 1]);
            out[i] = out[i - 1];
        }
        mpq_set(ts[i], t);
        out[i].patch = patch;
    }
    while (kept < count) {
        kept++;
        if (!is_clear(p, out[kept - 1].patch)) break;
    }
    for (uint32_t i = 0; i < count; i++) mpq_clear(ts[i]);
    free(ts);
    mpq_clear(t);
    rational_point_clear(&x);
    return kept;
}

static inline void check_sample(page *p, double x, double y) {
    enum { MOST = 64 };
    layer expected[MOST];
    uint32_t painted[MOST], count = 0;
    double to[3];
    point_at(p, x, y, to);
    rational_point_set(&p->to, 3, to);
    const uint32_t wanted = layers_of(p, expected, MOST);
    for (size_t i = 0; i < froe_picture_shape_count(p->picture); i++) {
        const froe_shape s = froe_picture_shape(p->picture, i);
        if (!inside_shape(p, &s, x, y)) continue;
        if (!is_clear(p, s.patch)) count = 0;
        assert_true(count < MOST);
        painted[count++] = s.patch;
    }
    bool right = count == wanted;
    for (uint32_t i = 0; right && i < count; i++) right = painted[i] == expected[count - 1 - i].patch;
    if (!right)
        fail_msg("at (%.17g, %.17g): %u layers painted, the last of patch %d; %u expected, the first of patch %d", x, y,
                 count, count ? (int)painted[count - 1] : -1, wanted, wanted ? (int)expected[0].patch : -1);
    p->shown += count > 0;
    p->empty += count == 0;
    p->layers += count;
}

static inline void place(page *p, const froe_camera *c) {
    froe_diagnostic why = {.message = ""};
    if (froe_camera_place(c, p->tree->scene, &p->view, &why)) fail_msg("%s", why.message);
    rational_point_set(&p->from, 3, p->view.eye.at);
    if (p->view.eye.parallel) mpq_set_ui(p->from.w, 0, 1);
}

/* A parallel eye in a direction; scale 0: all fits. */
static inline void look_from(page *p, double x, double y, double z, double scale) {
    froe_camera c = froe_camera_defaults();
    c.parallel = true;
    c.scale = scale;
    c.eye[0] = x, c.eye[1] = y, c.eye[2] = z;
    place(p, &c);
}

/* The camera of an eye that lies anywhere, looking at the middle. */
static inline void set_view(page *p, uint32_t e) {
    froe_camera c = froe_camera_defaults();
    const froe_eye eye = rays_eye(p->tree, e);
    const froe_scene *s = p->tree->scene;
    c.parallel = eye.parallel;
    c.fit = e % 3 != 0; /* otherwise the eye stays, often amid the scene */
    c.fov = 80;
    for (int k = 0; k < 3; k++) {
        c.target[k] = 0.5 * (s->lo[k] + s->hi[k]) + 0.01 * k;
        c.eye[k] = eye.parallel ? c.target[k] + eye.at[k] : eye.at[k];
    }
    place(p, &c);
}

static inline void check_view(page *p, uint32_t samples, uint32_t seed) {
    froe_diagnostic why = {.message = ""};
    if (froe_picture_new(p->tree, p->surface, &p->options, &p->picture, &why)) fail_msg("%s", why.message);
    for (size_t i = 0; i < froe_picture_shape_count(p->picture); i++) {
        const froe_shape shape = froe_picture_shape(p->picture, i);
        for (size_t ring = shape.first_ring, count; ring < shape.first_ring + shape.ring_count; ring++) {
            const double *points = froe_picture_ring(p->picture, ring, &count);
            for (size_t k = 0; k < 2 * count; k++) assert_true(isfinite(points[k]));
        }
    }
    for (uint32_t i = 0; i < samples; i++)
        check_sample(p, p->view.width * trees_unit(seed, 2 * i), p->view.height * trees_unit(seed, 2 * i + 1));
}

/* For test_memory_each. */
static inline froe_status make_picture(void *user, const froe_allocator *alloc) {
    page *p = user;
    froe_picture *picture = NULL;
    p->options.alloc = alloc;
    froe_status status = froe_picture_new(p->tree, p->surface, &p->options, &picture, NULL);
    froe_picture_free(picture);
    return status;
}

/* Of a stroke, on the page. */
static inline double length_of(const froe_stroke *s) {
    double sum = 0;
    for (size_t k = 0; k + !s->closed < s->count; k++) {
        const double *a = s->points + 2 * k, *b = s->points + 2 * ((k + 1) % s->count);
        sum += hypot(a[0] - b[0], a[1] - b[1]);
    }
    return sum;
}

#endif
