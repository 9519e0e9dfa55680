/* Pictures of moving triangles: what the file shows at any time is held against rays, and the instants at which faces
 * come into sight are where they should be. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "vector/film.h"
#include "vector/playing.h"

enum { TRIANGLES = 24 };

/* Triangles, each a group: every third turns, one in six lives for a while only. */
static froe_motion *make_motion(uint64_t seed) {
    froe_motion *motion = NULL;
    froe_motion_options w = froe_motion_defaults();
    playing_dice = seed * 7919 + 5;
    w.dim = 3, w.begin = 0, w.end = 4;
    assert_int_equal(froe_motion_new(&w, NULL, &motion, NULL), FROE_OK);
    for (unsigned i = 0; i < TRIANGLES; i++) {
        static const size_t pairs[] = {0, 2, 4, 6}, singles[] = {0, 1, 2, 3};
        const double both[] = {0, 4, 0, 4, 0, 4}, none[] = {0, 0, 0};
        double at[18], centre[6], turns[8] = {0, 0, 0, 1};
        uint32_t bodies[3], group;
        char name[16];
        snprintf(name, sizeof name, "t%u", i);
        assert_int_equal(froe_motion_add_group(motion, &(froe_group){.name = name}, &group), FROE_OK);
        for (int k = 0; k < 6; k++) centre[k] = 6 * playing_chance() - 3;
        for (int k = 0; k < 18; k++) at[k] = centre[k / 3 % 2 * 3 + k % 3] + 3 * playing_chance() - 1.5;
        froe_moving m = froe_moving_defaults();
        m.vertex_count = 3, m.count = 1, m.group = group;
        m.starts = pairs, m.times = both, m.coords = at;
        if (i % 3 == 0) {
            double square = 0;
            for (int k = 0; k < 4; k++) turns[4 + k] = playing_chance(), square += turns[4 + k] * turns[4 + k];
            for (int k = 0; k < 4; k++) turns[4 + k] /= sqrt(square);
            froe_body body = froe_body_defaults();
            body.count = 2, body.times = both, body.coords = centre, body.turns = turns;
            assert_int_equal(froe_motion_add_body(motion, &body, bodies, NULL), FROE_OK);
            bodies[1] = bodies[2] = bodies[0];
            for (int k = 0; k < 9; k++) at[k] -= centre[k % 3];
            m.starts = singles, m.times = none, m.bodies = bodies;
        }
        const double birth = 1 + playing_chance(), death = 2 + playing_chance();
        if (i % 6 == 1) m.births = &birth, m.deaths = &death;
        assert_int_equal(froe_motion_add(motion, &m, NULL), FROE_OK);
    }
    return motion;
}

static void every_frame_is_what_rays_meet(void **state) {
    (void)state;
    playing_counts c = {0, 0, 0};
    for (unsigned seed = 0; seed < 5; seed++) {
        froe_motion *motion = make_motion(seed);
        froe_render_options o = froe_render_defaults();
        froe_film_options film = froe_film_defaults();
        froe_film_report report;
        froe_diagnostic diag = {.message = ""};
        o.camera.width = 600, o.camera.height = 500, o.camera.parallel = seed % 2;
        o.camera.eye[0] = 3 - (double)seed, o.camera.eye[2] = (double)seed - 1;
        o.shading = seed == 2 ? FROE_SHADE_WHITE : FROE_SHADE_FLAT;
        film.frames = 24, film.turn = seed == 3;
        if (froe_film(motion, "film.svg", &o, &film, &report, &diag)) fail_msg("%s", diag.message);
        assert_true(report.shown >= 24 && report.changes > 0 && report.pictures >= report.shown);
        playing_read("film.svg");
        playing_compare(motion, &o, film.turn, film.frames, &c);
        froe_motion_free(motion);
    }
    assert_true(c.hits > 4000 && c.empty > 2000 && c.unclear < c.hits / 4);
}

/* A leaf slides out from behind a wall, and is seen from where its corner passes the edge; a third is born then. */
static void faces_come_into_sight_at_their_instant(void **state) {
    (void)state;
    froe_motion *motion = NULL;
    froe_motion_options w = froe_motion_defaults();
    w.dim = 3, w.begin = 0, w.end = 4;
    assert_int_equal(froe_motion_new(&w, NULL, &motion, NULL), FROE_OK);
    const size_t starts[] = {0, 1, 2, 3, 5, 7, 9, 10, 11, 12};
    const double times[] = {0, 0, 0, 0, 4, 0, 4, 0, 4, 0, 0, 0};
    const double at[] = {-9, 0, -9, 0,  0, -9, 0,  0, 30, /* the wall: x <= 0 */
                         -3, 1, 0,  5,  1, 0,  -4, 1, 0,
                         4,  1, 0,  -4, 1, 1,  4,  1, 1, /* its first corner is at 0 at 1.5 */
                         6,  1, 0,  7,  1, 0,  6,  1, 1};
    const double births[] = {0, 0, 2.7182818};
    froe_moving m = froe_moving_defaults();
    m.vertex_count = 9, m.count = 3, m.starts = starts, m.times = times, m.coords = at, m.births = births;
    const uint32_t groups[] = {0, 1, 2};
    for (int i = 0; i < 3; i++) {
        uint32_t id;
        const char *const names[] = {"t0", "t1", "t2"};
        assert_int_equal(froe_motion_add_group(motion, &(froe_group){.name = names[i]}, &id), FROE_OK);
    }
    m.groups = groups;
    assert_int_equal(froe_motion_add(motion, &m, NULL), FROE_OK);
    froe_render_options o = froe_render_defaults();
    froe_film_options film = froe_film_defaults();
    froe_film_report report;
    froe_diagnostic diag = {.message = ""};
    o.camera.parallel = true, o.camera.eye[0] = o.camera.eye[2] = 0, o.camera.eye[1] = -1;
    film.frames = 7, film.halvings = 10;
    if (froe_film(motion, "slide.svg", &o, &film, &report, &diag)) fail_msg("%s", diag.message);
    playing_read("slide.svg");
    double first[3] = {1, 1, 1};
    for (size_t i = 0; i < playing_file.path_count; i++)
        first[playing_file.paths[i].group[1] - '0'] =
            fmin(first[playing_file.paths[i].group[1] - '0'], playing_file.paths[i].from);
    assert_true(first[0] == 0 && report.changes >= 2);
    assert_true(report.late == 4.0 / 7 / 1024);
    assert_true(4 * first[1] > 1.5 && 4 * first[1] <= 1.5 + report.late);
    assert_true(first[2] == births[2] / 4);
    froe_motion_free(motion);
}

/* Times in the file have as many digits as tell a life of a billionth of the film. */
static void lives_of_any_length_are_shown(void **state) {
    (void)state;
    froe_motion *motion = NULL;
    froe_motion_options w = froe_motion_defaults();
    w.dim = 3, w.begin = 0, w.end = 4;
    assert_int_equal(froe_motion_new(&w, NULL, &motion, NULL), FROE_OK);
    const size_t starts[] = {0, 1, 2, 3, 4, 5, 6};
    const double times[6] = {0}, at[] = {-9, 0, -9, 0, 0, -9, 0, 0, 30, 3, 1, 0, 5, 1, 0, 4, 1, 9};
    const double births[] = {0, 1.3}, deaths[] = {4, 1.3 + 0x1p-28};
    const uint32_t groups[] = {0, 1};
    froe_moving m = froe_moving_defaults();
    m.vertex_count = 6, m.count = 2, m.starts = starts, m.times = times, m.coords = at;
    m.births = births, m.deaths = deaths, m.groups = groups;
    for (int i = 0; i < 2; i++) {
        uint32_t id;
        assert_int_equal(froe_motion_add_group(motion, &(froe_group){.name = i ? "t1" : "t0"}, &id), FROE_OK);
    }
    assert_int_equal(froe_motion_add(motion, &m, NULL), FROE_OK);
    froe_film_options film = froe_film_defaults();
    froe_diagnostic diag = {.message = ""};
    film.frames = 3;
    if (froe_film(motion, "life.svg", NULL, &film, NULL, &diag)) fail_msg("%s", diag.message);
    playing_read("life.svg");
    size_t found = 0;
    for (size_t i = 0; i < playing_file.path_count; i++) {
        const playing_path *p = playing_file.paths + i;
        if (p->group[1] != '1') continue;
        assert_true(p->from == births[1] / 4 && p->to == deaths[1] / 4);
        found++;
    }
    assert_true(found > 0);
    froe_motion_free(motion);
}

/* Two walls overlap but for an instant, in which a leaf behind them is seen: from `open` to `closed`, after `begin`. In
 * a parallel view their edges pass one another, and so they do as seen from a point in the plane of both. */
static froe_motion *make_slit(double begin, double open, double closed) {
    froe_motion *motion = NULL;
    froe_motion_options w = froe_motion_defaults();
    w.dim = 3, w.begin = begin, w.end = begin + 4;
    assert_int_equal(froe_motion_new(&w, NULL, &motion, NULL), FROE_OK);
    const double wide = 0.5 * (closed - open), amid = 0.5 * (open + closed);
    const size_t starts[] = {0, 1, 2, 3, 6, 9, 10, 11, 12, 13};
    double times[] = {0, 0, 0, 0, amid, 4, 0, amid, 4, 0, 0, 0, 0};
    for (size_t i = 0; i < sizeof times / sizeof *times; i++) times[i] += begin;
    const double at[] = {0,     0, -9, 0,    0, 9,  -40,      0, 0,  /* the wall on the left, at rest */
                         -amid, 2, -8, wide, 2, -8, amid - 4, 2, -8, /* the other: its edge is at 0 at `open` */
                         -amid, 2, 8,  wide, 2, 8,  amid - 4, 2, 8,  40, 2, 0, /* and at `closed` */
                         -1,    4, -1, 1,    4, -1, 0,        4, 1};           /* the leaf */
    froe_moving m = froe_moving_defaults();
    m.vertex_count = 9, m.count = 3, m.starts = starts, m.times = times, m.coords = at;
    const uint32_t groups[] = {0, 1, 2};
    for (int i = 0; i < 3; i++) {
        uint32_t id;
        const char *const names[] = {"t0", "t1", "t2"};
        assert_int_equal(froe_motion_add_group(motion, &(froe_group){.name = names[i]}, &id), FROE_OK);
    }
    m.groups = groups;
    assert_int_equal(froe_motion_add(motion, &m, NULL), FROE_OK);
    return motion;
}

/* When the leaf is in sight: from the first of its paths on to the last. */
static void leaf_times(double out[2]) {
    playing_read("slit.svg");
    out[0] = 5, out[1] = -1;
    for (size_t i = 0; i < playing_file.path_count; i++)
        if (playing_file.paths[i].group[1] == '2') {
            out[0] = fmin(out[0], 4 * playing_file.paths[i].from);
            out[1] = fmax(out[1], 4 * playing_file.paths[i].to);
        }
}

static void what_is_seen_for_less_than_a_frame_is_seen(void **state) {
    (void)state;
    const double open = 1.4990234375, closed = 1.5029296875; /* a 140th of a frame */
    for (int turn = 0; turn < 3; turn++) {
        const bool parallel = turn == 1, far = turn == 2; /* far from time 0 doubles are a quarter of that time apart */
        froe_motion *motion = make_slit(far ? 0x1p42 : 0, open, closed);
        froe_render_options o = froe_render_defaults();
        froe_film_options film = froe_film_defaults();
        froe_film_report report;
        froe_diagnostic diag = {.message = ""};
        double seen[2];
        const double late = far ? 0x1p-8 : 4e-15; /* a few last places of the time */
        o.camera.parallel = parallel, o.camera.fit = false;
        o.camera.eye[0] = 0, o.camera.eye[1] = -20, o.camera.eye[2] = 0;
        o.camera.target[0] = o.camera.target[2] = 0, o.camera.target[1] = 0;
        film.frames = 7, film.halvings = 4;
        if (froe_film(motion, "slit.svg", &o, &film, &report, &diag)) fail_msg("%s", diag.message);
        leaf_times(seen);
        assert_true(seen[1] < 0 && report.changes == 0); /* by halving it is missed */
        film.exact = true;
        if (froe_film(motion, "slit.svg", &o, &film, &report, &diag)) fail_msg("%s", diag.message);
        leaf_times(seen);
        assert_true(fabs(seen[0] - open) < late + 3e-6 && fabs(seen[1] - closed) < late + 3e-6);
        assert_true(report.changes == 2 && report.late <= late && report.shown == 9);
        froe_motion_free(motion);
    }
}

/* Seen from the front, a leaf turns its edge to the eye at t = 0, and from t = 1.5 on for good. */
static void faces_that_turn_their_edge_to_the_eye_are_seen_in_between(void **state) {
    (void)state;
    for (int way = 0; way < 4; way++) {
        const bool parallel = way % 2,
                   late = way > 1; /* late: it comes into being at t = 0.5, with its edge to the eye */
        const double birth = late ? 0.5 : 0;
        const size_t starts[] = {0, 1, 2, 3, 4, 5, 9};
        const double times[] = {0, 0, 0, 0, 0, birth, 1, 1.5, 4}, births[] = {0, birth};
        const double at[] = {-9, 5, -9, 9, 5, -9, 0, 5, -5, 0, 0, 0, 0, 0, 4, 0, 2, 2, 4, 2, 2, 0, 2, 2, 0, 3, 3};
        const uint32_t groups[] = {0, 1};
        froe_motion *motion = NULL;
        froe_motion_options w = froe_motion_defaults();
        froe_render_options o = froe_render_defaults();
        froe_film_options film = froe_film_defaults();
        froe_diagnostic diag = {.message = ""};
        w.dim = 3, w.begin = 0, w.end = 4;
        assert_int_equal(froe_motion_new(&w, NULL, &motion, NULL), FROE_OK);
        for (int i = 0; i < 2; i++) {
            uint32_t id;
            assert_int_equal(froe_motion_add_group(motion, &(froe_group){.name = i ? "t1" : "t0"}, &id), FROE_OK);
        }
        froe_moving m = froe_moving_defaults();
        m.vertex_count = 6, m.count = 2, m.starts = starts, m.times = times, m.coords = at;
        m.births = births, m.groups = groups;
        assert_int_equal(froe_motion_add(motion, &m, NULL), FROE_OK);
        o.camera.parallel = parallel, o.camera.fit = parallel;
        o.camera.eye[0] = o.camera.eye[2] = 0, o.camera.eye[1] = -20;
        film.frames = 3, film.exact = true;
        if (froe_film(motion, "leaf.svg", &o, &film, NULL, &diag)) fail_msg("%s", diag.message);
        playing_read("leaf.svg");
        double seen[2] = {1, 0};
        for (size_t i = 0; i < playing_file.path_count; i++)
            if (playing_file.paths[i].group[1] == '1') {
                seen[0] = fmin(seen[0], playing_file.paths[i].from);
                seen[1] = fmax(seen[1], playing_file.paths[i].to);
            }
        assert_true(fabs(4 * seen[0] - birth) < 3e-6 && fabs(4 * seen[1] - 1.5) < 3e-6);
        froe_motion_free(motion);
    }
}

/* Whatever comes and goes and changes places: what is shown stands in the list in the order of the picture. */
static void a_list_shows_each_picture_in_its_order(void **state) {
    (void)state;
    enum { PICTURES = 60, LONGEST = 40 };
    const froe_allocator alloc = support_allocator(NULL);
    film_list list = {.bytes = {0}};
    size_t kept = 0, made = 0;
    playing_dice = 11;
    for (int i = 0; i < PICTURES; i++) {
        film_picture p = {.time = i};
        for (int kind = 0; kind < 2; kind++) {
            const int count = (int)(playing_chance() * LONGEST), letters = i % 3 ? 40 : 6;
            for (int k = 0; k < count; k++) {
                const char letter = (char)('0' + (int)(playing_chance() * letters)); /* some of them twice */
                const film_path path = {p.bytes.count, 1, (uint64_t)letter / 2}; /* and hashes that say too little */
                assert_true(array_push(&alloc, &p.bytes, letter) && array_push(&alloc, &p.paths[kind], path));
            }
        }
        const size_t before = list.items.count;
        assert_true(vector_film_show(&list, &p, (double)i / PICTURES, &alloc));
        made += p.paths[0].count + p.paths[1].count, kept += p.paths[0].count + p.paths[1].count;
        kept -= list.items.count - (before > 2 ? before : 2);
        for (uint32_t kind = 0; kind < 2; kind++) {
            size_t k = 0;
            for (uint32_t at = list.items.data[kind].next; at != UINT32_MAX; at = list.items.data[at].next) {
                const film_item *item = list.items.data + at;
                if (item->to < 1) continue;
                assert_true(k < p.paths[kind].count);
                assert_int_equal(list.bytes.data[item->path.at], p.bytes.data[p.paths[kind].data[k++].at]);
            }
            assert_int_equal(k, p.paths[kind].count);
        }
        array_free(&alloc, &p.bytes), array_free(&alloc, &p.paths[0]), array_free(&alloc, &p.paths[1]);
    }
    assert_true(kept > made / 10);
    vector_film_free(&list, &alloc);
}

typedef struct filming {
    const froe_motion *motion;
    bool exact, turn, lines, culled, large;
    froe_film_report report;
} filming;

static froe_status film_once(void *user, const froe_allocator *alloc) {
    filming *f = user;
    froe_render_options o = froe_render_defaults();
    froe_film_options film = froe_film_defaults();
    o.camera.parallel = f->exact, o.camera.eye[0] = 0.125, o.camera.eye[1] = -9, o.camera.eye[2] = 0.25;
    o.alloc = alloc, film.frames = 2, film.halvings = 1, film.exact = f->exact, film.turn = f->turn;
    if (f->lines) o.shading = FROE_SHADE_NONE;
    o.cull_back = f->culled, o.min_area = f->large ? 1 : 0;
    return froe_film(f->motion, "memory.svg", &o, &film, &f->report, NULL);
}

/* A triangle flies past before two that rest and have an edge in common; a fourth is there for a while. */
static froe_motion *make_passing(void) {
    static const size_t starts[] = {0, 2, 4, 6, 7, 8, 9, 10, 11};
    static const double times[11] = {0, 1, 0, 1, 0, 1};
    static const double at[] = {-4,  -2,   -0.5, 2, -2,  -0.5, -2, -2, -0.5, 4,   -2, -0.5, -3,   -2, 2.5, 3, -2,
                                2.5, -0.2, 0,    0, 0.2, 0,    0,  0,  0,    0.5, 0,  0.5,  -0.3, 3,  0,   3};
    static const uint32_t vertices[] = {0, 1, 2, 3, 4, 5, 3, 4, 6, 4, 5, 7};
    static const double births[] = {0, 0, 0, 0.25}, deaths[] = {1, 1, 1, 0.5};
    froe_motion_options w = froe_motion_defaults();
    froe_moving b = froe_moving_defaults();
    froe_motion *motion = NULL;
    w.dim = 3, w.begin = 0, w.end = 1;
    b.vertex_count = 8, b.count = 4, b.starts = starts, b.times = times, b.coords = at, b.vertices = vertices;
    b.births = births, b.deaths = deaths;
    assert_int_equal(froe_motion_new(&w, NULL, &motion, NULL), FROE_OK);
    assert_int_equal(froe_motion_add(motion, &b, NULL), FROE_OK);
    return motion;
}

/* From some calls for memory on there is none. */
static void run_short_of_memory(filming *f) {
    enum { TRIES = 24 };
    test_memory m;
    const froe_allocator alloc = test_memory_begin(&m);
    assert_int_equal(film_once(f, &alloc), FROE_OK);
    const size_t calls = m.calls;
    for (size_t i = 0; i < TRIES; i++) {
        test_memory_begin(&m);
        m.fail_at = 1 + i * calls / TRIES, m.fail_on = true;
        assert_int_equal(film_once(f, &alloc), FROE_E_MEMORY);
        test_memory_end(&m);
    }
}

/* What vanishes and comes into sight again is found in each way to make a film. */
static void every_way_to_film_finds_the_changes(void **state) {
    (void)state;
    froe_motion *motion = make_passing();
    for (int way = 0; way < 6; way++) {
        filming f = {.motion = motion, .exact = way % 3 > 0, .turn = way % 3 > 1, .lines = way > 2};
        assert_int_equal(film_once(&f, NULL), FROE_OK);
        assert_true(way == 1 ? f.report.changes == 2 : way == 2 || f.report.changes > 1); /* 2: seen from behind */
        assert_true(f.exact ? f.report.late < 1e-9 : f.report.late == 0.25);
        if (f.exact) run_short_of_memory(&f);
    }
    for (int culled = 0; culled < 2; culled++) { /* then all that happens is looked at */
        filming f = {.motion = motion, .exact = true, .culled = culled, .large = !culled};
        assert_int_equal(film_once(&f, NULL), FROE_OK);
        assert_int_equal(f.report.changes, 2);
    }
    froe_motion_free(motion);
}

static void allocations_may_fail(void **state) {
    (void)state;
    froe_motion *motion = NULL;
    assert_int_equal(froe_generate_motion("moving-boxes", 2, 1, NULL, &motion, NULL), FROE_OK);
    assert_true(test_memory_each(film_once, &(filming){.motion = motion}) > 100);
    froe_motion_free(motion);
}

static void what_no_film_can_be_is_refused(void **state) {
    (void)state;
    froe_motion *motion = make_motion(1), *plane = NULL;
    froe_render_options o = froe_render_defaults();
    froe_film_options film = froe_film_defaults();
    froe_diagnostic diag;
    assert_int_equal(froe_generate_motion("moving", 3, 1, NULL, &plane, NULL), FROE_OK);
    assert_int_equal(froe_film(plane, "no.svg", NULL, NULL, NULL, &diag), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_film(motion, "no.pdf", NULL, NULL, NULL, &diag), FROE_E_OPTIONS);
    o.layers = FROE_LAYERS_KIND;
    assert_int_equal(froe_film(motion, "no.svg", &o, NULL, NULL, &diag), FROE_E_OPTIONS);
    assert_string_equal(diag.message,
                        "A film has no layers, no interleaved lines and no fills that are painted twice.");
    film.exact = true; /* some of its triangles turn */
    assert_int_equal(froe_film(motion, "no.svg", NULL, &film, NULL, &diag), FROE_E_UNSUPPORTED);
    o = froe_render_defaults();
    o.camera.eye[0] = o.camera.eye[1] = 0, film.turn = true;
    assert_int_equal(froe_film(motion, "no.svg", &o, &film, NULL, &diag), FROE_E_OPTIONS);
    assert_string_equal(diag.message, "An exact film does not go around its own line of view.");
    film.frames = 0;
    assert_int_equal(froe_film(motion, "no.svg", NULL, &film, NULL, &diag), FROE_E_OPTIONS);
    assert_null(fopen("no.svg", "r"));
    froe_motion_free(motion), froe_motion_free(plane);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_frame_is_what_rays_meet),
        cmocka_unit_test(faces_come_into_sight_at_their_instant),
        cmocka_unit_test(lives_of_any_length_are_shown),
        cmocka_unit_test(what_is_seen_for_less_than_a_frame_is_seen),
        cmocka_unit_test(faces_that_turn_their_edge_to_the_eye_are_seen_in_between),
        cmocka_unit_test(a_list_shows_each_picture_in_its_order),
        cmocka_unit_test(every_way_to_film_finds_the_changes),
        cmocka_unit_test(allocations_may_fail),
        cmocka_unit_test(what_no_film_can_be_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
