/* Instants at which what is seen may change: between two of them the faces in sight stay, as pictures taken at many
 * times tell; each is known to neighbouring doubles; and all are needed. */
#include "support/sanitized.h"
#include "vector/playing.h"

enum { FACES = 9, LARGE = 4, TIMES = SANITIZED ? 200 : 400, MOST = 8000 };

static uint64_t dice;

static double chance(void) {
    dice = dice * 6364136223846793005u + 1442695040888963407u;
    return (double)(dice >> 11) * 0x1p-53;
}

enum { REST, STRAIGHT, BENT, CUBIC, TETRAHEDRA, TANGLE };

/* Triangles at rest, that fly straight, or (bent) along parabolas or cubics, each between planes of its own across y,
 * so that none touches another. Large ones are before small ones. */
static froe_motion *make_motion_of(uint64_t seed, int kind) {
    froe_motion *motion = NULL;
    froe_motion_options w = froe_motion_defaults();
    dice = seed * 7919 + 5;
    w.dim = 3, w.begin = 0, w.end = 1;
    assert_int_equal(froe_motion_new(&w, NULL, &motion, NULL), FROE_OK);
    for (int i = 0; i < FACES; i++) {
        const size_t twice[] = {0, 2, 4, 6}, once[] = {0, 1, 2, 3};
        const double times[] = {0, 1, 0, 1, 0, 1};
        double at[18], controls[18], seconds[18];
        const double size = i < LARGE ? 4 : 0.6;
        double centre[6];
        for (int k = 0; k < 6; k++) centre[k] = i < LARGE ? 0 : 2.4 * chance() - 1.2;
        for (int k = 0; k < 18; k++) {
            const double from = centre[k / 3 % 2 * 3 + k % 3];
            at[k] = k % 3 == 1 ? i + 0.8 * chance() : from + size * (chance() - 0.5);
            controls[k] = k % 3 == 1 ? i + 0.8 * chance() : from + size * (chance() - 0.5);
        }
        for (int k = 0; k < 18 && kind == CUBIC; k++)
            seconds[k] = k % 3 == 1 ? i + 0.8 * chance() : 2 * controls[k] - at[k] + (chance() - 0.5);
        for (int k = 0; k < 6; k++)
            if (k % 2) controls[3 * k] = NAN;
        froe_moving m = froe_moving_defaults();
        char name[16];
        snprintf(name, sizeof name, "t%d", i);
        assert_int_equal(froe_motion_add_group(motion, &(froe_group){.name = name}, &m.group), FROE_OK);
        m.vertex_count = 3, m.count = 1, m.starts = kind == REST ? once : twice, m.times = times, m.coords = at;
        m.controls = kind == BENT || kind == CUBIC ? controls : NULL;
        m.second_controls = kind == CUBIC ? seconds : NULL;
        assert_int_equal(froe_motion_add(motion, &m, NULL), FROE_OK);
    }
    return motion;
}

static froe_motion *make_motion(uint64_t seed, bool bent) {
    return make_motion_of(seed, bent ? BENT : STRAIGHT);
}

/* The same with triangles that are bodies, and turn about y while they fly. */
static froe_motion *make_turning(uint64_t seed) {
    froe_motion *motion = NULL;
    froe_motion_options w = froe_motion_defaults();
    dice = seed * 7919 + 5;
    w.dim = 3, w.begin = 0, w.end = 1;
    assert_int_equal(froe_motion_new(&w, NULL, &motion, NULL), FROE_OK);
    for (int i = 0; i < FACES; i++) {
        const size_t starts[] = {0, 1, 2, 3};
        const double zeros[3] = {0}, times[] = {0, 0.5, 1}, size = i < LARGE ? 4 : 0.6;
        double at[9], centre[9], turns[12] = {0};
        for (int k = 0; k < 9; k++) {
            at[k] = k % 3 == 1 ? 0.8 * chance() : size * (chance() - 0.5);
            centre[k] = k % 3 == 1 ? i : i < LARGE ? 0 : 2.4 * chance() - 1.2;
        }
        for (size_t k = 0; k < 3; k++) {
            const double half = (k ? turns[4 * k - 3] : 0) + 0.7 * chance(), length = sqrt(half * half + 1);
            turns[4 * k + 1] = half / length, turns[4 * k + 3] = 1 / length;
        }
        froe_body body = froe_body_defaults();
        froe_moving m = froe_moving_defaults();
        char name[16];
        uint32_t bodies[3];
        snprintf(name, sizeof name, "t%d", i);
        body.count = 3, body.times = times, body.coords = centre, body.turns = turns;
        assert_int_equal(froe_motion_add_group(motion, &(froe_group){.name = name}, &m.group), FROE_OK);
        assert_int_equal(froe_motion_add_body(motion, &body, bodies, NULL), FROE_OK);
        bodies[1] = bodies[2] = bodies[0];
        m.vertex_count = 3, m.count = 1, m.starts = starts, m.times = zeros, m.coords = at, m.bodies = bodies;
        assert_int_equal(froe_motion_add(motion, &m, NULL), FROE_OK);
    }
    return motion;
}

static const double page[12] = {-1, -20, -1, 1, -20, -1, 1, -20, 1, -1, -20, 1};

static froe_eye make_eye(bool parallel) {
    return (froe_eye){.at = {parallel ? 0.125 : 0.25, parallel ? -1 : -30, 0.25}, .parallel = parallel};
}

/* The objects in sight, as bits. */
static unsigned look_at(const froe_motion *motion, froe_eye eye, const double *window, double time) {
    froe_scene *scene;
    froe_tree *tree;
    froe_surface *surface;
    froe_visibility *v;
    froe_build_options build = froe_build_defaults();
    froe_visibility_options o = froe_visibility_defaults();
    unsigned seen = 0;
    build.purpose = "draw", build.threads = 1;
    o.eye = eye, o.window = window, o.window_corners = 4;
    assert_int_equal(froe_motion_scene(motion, time, NULL, &scene, NULL), FROE_OK);
    assert_int_equal(froe_build(scene, &build, &tree, NULL), FROE_OK);
    assert_int_equal(froe_surface_new(scene, NULL, &surface, NULL), FROE_OK);
    assert_int_equal(froe_visibility_new(tree, surface, &o, &v, NULL), FROE_OK);
    for (size_t i = 0; i < froe_visibility_piece_count(v); i++)
        seen |= 1u << froe_scene_object(scene, froe_visibility_piece(v, i).object).tag;
    froe_visibility_free(v), froe_surface_free(surface), froe_tree_free(tree), froe_scene_free(scene);
    return seen;
}

typedef struct instants {
    double low[MOST], high[MOST];
    size_t count;
} instants;

static bool keep(void *user, double low, double high) {
    instants *x = user;
    assert_true(x->count < MOST && low <= high && high - low <= 1e-15 && (!x->count || low > x->high[x->count - 1]));
    x->low[x->count] = low, x->high[x->count++] = high;
    return true;
}

static froe_sight_options ask(froe_eye eye, const double *window, const uint8_t *seen, double from, double to) {
    froe_sight_options o = froe_sight_defaults();
    memcpy(o.at, eye.at, sizeof o.at);
    o.parallel = eye.parallel, o.window = window, o.seen = seen, o.from = from, o.to = to;
    return o;
}

static instants find(const froe_motion *motion, froe_eye eye, const uint8_t *seen, double from, double to) {
    instants out = {.count = 0};
    froe_diagnostic diag;
    const froe_sight_options o = ask(eye, page, seen, from, to);
    if (froe_motion_sights(motion, &o, keep, &out, &diag)) fail_msg("%s", diag.message);
    return out;
}

static void faces_in_sight_change_at_instants_alone(void **state) {
    (void)state;
    unsigned changes = 0, gaps = 0;
    for (unsigned seed = 0; seed < 8; seed++) {
        const bool parallel = seed % 2, bent = seed % 4 == 3;
        froe_motion *motion = make_motion(seed, bent);
        const froe_eye eye = make_eye(parallel);
        const instants x = find(motion, eye, NULL, 0, 1);
        size_t k = 0;
        unsigned last = 0;
        for (int i = 1; i < TIMES; i++) {
            const double time = (i + 0.001) / TIMES;
            const size_t before = k;
            while (k < x.count && x.low[k] <= time) k++;
            const unsigned now = look_at(motion, eye, page, time);
            if (i > 1 && k == before && now != last) fail_msg("seed %u: other faces at %.17g", seed, time);
            changes += i > 1 && now != last, gaps += k == before;
            last = now;
        }
        froe_motion_free(motion);
    }
    print_message("  %u changes, %u times after which nothing happens\n", changes, gaps);
    assert_true(changes > 20 && gaps > 100);
}

/* ---------------------------------------------------------------- eyes that move -- */

/* How an eye and the corners of the page move: as vertices of a motion of their own, of which the body is no part. */
typedef struct flight {
    double times[3], at[9], controls[9], turns[12];
    double eye[3], window[12];
    froe_body body;
    froe_motion *rig; /* the vertices: the eye, or the centre and the end of the direction towards it; the window */
    bool parallel;
} flight;

/* Flies straight, along parabolas (bent), and turns about a line that is nearly upright. */
static void make_flight(uint64_t seed, bool parallel, bool flies, bool bent, bool turns, flight *f) {
    const size_t starts[] = {0, 1, 2, 3, 4, 5, 6};
    const double zeros[6] = {0}, middle[3] = {0, 3, 0};
    double at[18] = {0};
    const double reach = parallel ? 3 : 16;
    const uint32_t bodies[6] = {0};
    froe_motion_options w = froe_motion_defaults();
    froe_moving m = froe_moving_defaults();
    dice = seed * 104729 + 3;
    *f = (flight){.times = {0, 0.375, 1}, .parallel = parallel, .body = froe_body_defaults()};
    for (int k = 0; k < 9; k++) {
        f->at[k] = middle[k % 3] + (flies && k > 2 && !(parallel && k % 3 == 1) ? reach * (chance() - 0.5) : 0);
        f->controls[k] = bent ? middle[k % 3] + reach * (chance() - 0.5) : NAN;
    }
    for (int i = 0; i < 3; i++) {
        const double half = turns ? 0.3 * i + 0.2 * chance() - 0.35 : 0, slant = 0.1 * half,
                     length = sqrt(1 + half * half + slant * slant);
        f->turns[4 * i] = slant / length, f->turns[4 * i + 2] = half / length, f->turns[4 * i + 3] = 1 / length;
    }
    f->body.count = 3, f->body.times = f->times, f->body.coords = f->at, f->body.controls = f->controls,
    f->body.turns = f->turns;
    const froe_eye eye = make_eye(parallel);
    for (int k = 0; k < 3; k++) f->eye[k] = eye.at[k] - (parallel ? 0 : middle[k]);
    for (int k = 0; k < 12; k++) f->window[k] = parallel && k % 3 == 1 ? 0 : page[k] - middle[k % 3];
    memcpy(at, f->eye, sizeof f->eye);
    memcpy(at + 6, f->window, sizeof f->window);
    w.dim = 3, w.begin = 0, w.end = 1;
    assert_int_equal(froe_motion_new(&w, NULL, &f->rig, NULL), FROE_OK);
    assert_int_equal(froe_motion_add_body(f->rig, &f->body, NULL, NULL), FROE_OK);
    m.vertex_count = 6, m.starts = starts, m.times = zeros, m.coords = at, m.bodies = bodies;
    assert_int_equal(froe_motion_add(f->rig, &m, NULL), FROE_OK);
}

static unsigned look_from(const froe_motion *motion, const flight *f, double time) {
    froe_eye eye = {.parallel = f->parallel};
    double window[12], centre[3];
    assert_true(froe_motion_position(f->rig, 0, time, eye.at) && froe_motion_position(f->rig, 1, time, centre));
    for (uint32_t k = 0; k < 4; k++) assert_true(froe_motion_position(f->rig, 2 + k, time, window + 3 * k));
    for (int k = 0; k < 3 && f->parallel; k++) eye.at[k] -= centre[k];
    return look_at(motion, eye, window, time);
}

/* Triangles at rest, many of which pass through one another. */
static froe_motion *make_tangle(uint64_t seed, int faces) {
    const size_t starts[] = {0, 1, 2, 3};
    const double zeros[3] = {0};
    froe_motion *motion = NULL;
    froe_motion_options w = froe_motion_defaults();
    dice = seed * 7919 + 5;
    w.dim = 3, w.begin = 0, w.end = 1;
    assert_int_equal(froe_motion_new(&w, NULL, &motion, NULL), FROE_OK);
    for (int i = 0; i < faces; i++) {
        double at[9], centre[3];
        froe_moving m = froe_moving_defaults();
        char name[16];
        for (int k = 0; k < 3; k++) centre[k] = chance() - 0.5;
        for (int k = 0; k < 9; k++) at[k] = centre[k % 3] + 3 * chance() - 1.5;
        snprintf(name, sizeof name, "t%d", i);
        assert_int_equal(froe_motion_add_group(motion, &(froe_group){.name = name}, &m.group), FROE_OK);
        m.vertex_count = 3, m.count = 1, m.starts = starts, m.times = zeros, m.coords = at;
        assert_int_equal(froe_motion_add(motion, &m, NULL), FROE_OK);
    }
    return motion;
}

/* Tetrahedra at rest, each between planes of its own across y: 4 triangles each. */
static froe_motion *make_tetrahedra(uint64_t seed, int count) {
    static const uint32_t faces[] = {0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0};
    const size_t starts[] = {0, 1, 2, 3, 4};
    const double zeros[4] = {0};
    froe_motion *motion = NULL;
    froe_motion_options w = froe_motion_defaults();
    dice = seed * 7919 + 5;
    w.dim = 3, w.begin = 0, w.end = 1;
    assert_int_equal(froe_motion_new(&w, NULL, &motion, NULL), FROE_OK);
    for (int i = 0; i < count; i++) {
        double at[12], centre[2];
        froe_moving m = froe_moving_defaults();
        for (int k = 0; k < 2; k++) centre[k] = 1.6 * chance() - 0.8;
        for (int k = 0; k < 12; k++) at[k] = k % 3 == 1 ? i + 0.9 * chance() : centre[k % 3 / 2] + chance() - 0.5;
        m.vertex_count = 4, m.count = 4, m.starts = starts, m.times = zeros, m.coords = at, m.vertices = faces;
        assert_int_equal(froe_motion_add(motion, &m, NULL), FROE_OK);
    }
    return motion;
}

static void find_from(const froe_motion *motion, const flight *f, const uint32_t *pairs, size_t count, instants *x) {
    froe_sight_options o = froe_sight_defaults();
    froe_diagnostic diag;
    memcpy(o.at, f->eye, sizeof o.at);
    o.parallel = f->parallel, o.window = f->window, o.body = &f->body, o.pairs = pairs, o.pair_count = count;
    x->count = 0;
    if (froe_motion_sights(motion, &o, keep, x, &diag)) fail_msg("%s", diag.message);
}

/* What rests or flies, seen by an eye that rests, flies, or turns. */
static void eyes_that_move_see_changes_at_instants_alone(void **state) {
    (void)state;
    const struct {
        int faces;
        bool parallel, flies, bent, turns;
    } cases[] = {{REST, false, true, false, false},       {REST, false, true, true, false},
                 {REST, false, false, false, true},       {REST, false, true, false, true},
                 {REST, true, false, false, true},        {REST, true, true, true, true},
                 {STRAIGHT, false, true, false, false},   {STRAIGHT, false, false, false, true},
                 {STRAIGHT, true, true, true, true},      {BENT, false, false, false, false},
                 {BENT, false, true, true, false},        {BENT, true, true, false, true},
                 {CUBIC, true, false, false, false},      {CUBIC, true, true, true, false},
                 {TETRAHEDRA, false, false, false, true}, {TETRAHEDRA, true, false, false, true}};
    static instants x;
    unsigned all = 0;
    for (unsigned c = 0; c < sizeof cases / sizeof *cases; c++) {
        const unsigned seed = c % 4;
        unsigned changes = 0, gaps = 0, last = 0;
        size_t k = 0;
        flight f;
        make_flight(seed, cases[c].parallel, cases[c].flies, cases[c].bent, cases[c].turns, &f);
        froe_motion *motion =
            cases[c].faces == TETRAHEDRA ? make_tetrahedra(seed, 6) : make_motion_of(seed, cases[c].faces);
        find_from(motion, &f, NULL, 0, &x);
        for (int i = 1; i < TIMES; i++) {
            const double time = (i + 0.001) / TIMES;
            const size_t before = k;
            while (k < x.count && x.low[k] <= time) k++;
            const unsigned now = look_from(motion, &f, time);
            if (i > 1 && k == before && now != last) fail_msg("case %u: other faces at %.17g", c, time);
            changes += i > 1 && now != last, gaps += k == before;
            last = now;
        }
        froe_motion_free(motion), froe_motion_free(f.rig);
        print_message("  case %u: %u changes, %u times after which nothing happens\n", c, changes, gaps);
        assert_true(changes > 0 && gaps > 20);
        all += changes;
    }
    assert_true(all > 100);
}

/* How often other faces are in sight near the end of a gap between two instants than near its beginning. */
static unsigned changes_in_gaps(const froe_motion *motion, const flight *f, const instants *x, unsigned *gaps) {
    unsigned changes = 0;
    for (size_t i = 0; i + 1 < x->count; i++) {
        const double low = x->high[i], high = x->low[i + 1];
        if (high - low < 1e-6) continue;
        changes += look_from(motion, f, low + 0.02 * (high - low)) != look_from(motion, f, high - 0.02 * (high - low));
        ++*gaps;
    }
    return changes;
}

/* Triangles at rest that pass through one another: the lines in which they do are edges, too. */
static void crossings_at_rest_are_edges(void **state) {
    (void)state;
    enum { CROSSING = 9 };
    static instants x;
    uint32_t pairs[CROSSING * (CROSSING - 1)];
    size_t count = 0;
    unsigned gaps = 0, ignored = 0;
    for (uint32_t i = 0; i < CROSSING; i++)
        for (uint32_t j = 0; j < i; j++, count++) pairs[2 * count] = j, pairs[2 * count + 1] = i;
    for (unsigned seed = 0; seed < (SANITIZED ? 2 : 6); seed++) {
        flight f;
        make_flight(seed, seed % 2, false, false, true, &f);
        froe_motion *motion = make_tangle(seed, CROSSING);
        find_from(motion, &f, pairs, count, &x);
        const unsigned wrong = changes_in_gaps(motion, &f, &x, &gaps);
        if (wrong) fail_msg("seed %u: %u changes between two instants", seed, wrong);
        if (!SANITIZED) {
            find_from(motion, &f, NULL, 0, &x);
            ignored += changes_in_gaps(motion, &f, &x, &gaps);
        }
        froe_motion_free(motion), froe_motion_free(f.rig);
    }
    print_message("  %u gaps; without the lines of crossing %u changes in them\n", gaps, ignored);
    assert_true(gaps > 200 && (SANITIZED || ignored > 0));
}

/* Just before an instant and just after it: of those at which other faces come into sight, each is told, too, where
 * only what is seen before is known. */
static void what_is_seen_before_tells_the_first_change(void **state) {
    (void)state;
    unsigned changes = 0, fewer = 0;
    for (unsigned seed = 20; seed < 28; seed++) {
        froe_motion *motion = make_motion(seed, seed % 4 == 3);
        const froe_eye eye = make_eye(seed % 2);
        const instants all = find(motion, eye, NULL, 0, 1);
        double from = 0;
        unsigned seen = look_at(motion, eye, page, 1e-9);
        for (size_t i = 0; i < all.count; i++) {
            const double next = i + 1 < all.count ? all.low[i + 1] : 1, gap = fmin(0.5 * (next - all.high[i]), 1e-7);
            const unsigned now = look_at(motion, eye, page, all.high[i] + gap);
            if (now == seen || gap < 1e-12) continue;
            uint8_t flags[FACES];
            for (int k = 0; k < FACES; k++) flags[k] = seen >> k & 1;
            const instants some = find(motion, eye, flags, from, next), whole = find(motion, eye, NULL, from, next);
            size_t k = 0;
            while (k < some.count && some.high[k] < all.low[i]) k++;
            assert_true(k < some.count && some.low[k] <= all.high[i]);
            fewer += some.count < whole.count;
            changes++, from = all.high[i], seen = now;
        }
        froe_motion_free(motion);
    }
    print_message("  %u changes, %u of them after fewer instants than there are in all\n", changes, fewer);
    assert_true(changes > 20 && fewer > 3);
}

/* The objects that a film shows at a share of its time, as bits; *near: something begins or ends about then. */
static unsigned shown_at(double share, bool *near) {
    unsigned shown = 0;
    *near = false;
    for (size_t i = 0; i < playing_file.path_count; i++) {
        const playing_path *p = playing_file.paths + i;
        if (p->from <= share && share < p->to) shown |= 1u << (p->group[1] - '0');
        *near = *near || fabs(p->from - share) < 1e-5 || fabs(p->to - share) < 1e-5;
    }
    return shown;
}

/* At how many of some times a film shows other objects than are in sight of a motion, as which it is nearly. */
static unsigned count_wrong(const froe_motion *filmed, const froe_motion *motion, const froe_render_options *o,
                            bool exact) {
    enum { SHARES = 200 };
    froe_film_options film = froe_film_defaults();
    froe_projection view;
    froe_scene *scene;
    froe_diagnostic diag;
    unsigned wrong = 0;
    film.frames = 3, film.exact = exact;
    if (froe_film(filmed, "any.svg", o, &film, NULL, &diag)) fail_msg("%s", diag.message);
    playing_read("any.svg");
    assert_int_equal(froe_motion_scene(motion, 0, NULL, &scene, NULL), FROE_OK);
    assert_int_equal(froe_camera_place(&o->camera, scene, &view, NULL), FROE_OK);
    for (int i = 0; i < SHARES; i++) {
        const double time = chance();
        bool near;
        const unsigned shown = shown_at(time, &near);
        wrong += !near && shown != look_at(motion, view.eye, view.window, time);
    }
    froe_scene_free(scene);
    return wrong;
}

static froe_render_options look_from_afar(bool parallel) {
    froe_render_options o = froe_render_defaults();
    const double eye[3] = {0.25, -30, 0.25}, target[3] = {0.2, 0, 0.2};
    o.camera.parallel = parallel, o.camera.fit = false, o.camera.scale = 300, o.camera.fov = 5;
    o.camera.width = o.camera.height = 600, o.decimals = 4;
    for (int k = 0; k < 3; k++) o.camera.eye[k] = eye[k], o.camera.target[k] = target[k];
    return o;
}

/* With three frames alone. A film by halving is wrong a third of the time. */
static void exact_films_show_what_is_in_sight_at_any_time(void **state) {
    (void)state;
    unsigned halving = 0;
    for (unsigned seed = SANITIZED ? 42 : 40; seed < 44; seed++) {
        froe_motion *motion = make_motion(seed, seed % 4 == 3);
        const froe_render_options o = look_from_afar(seed % 2);
        assert_int_equal(count_wrong(motion, motion, &o, true), 0);
        halving += count_wrong(motion, motion, &o, false);
        froe_motion_free(motion);
    }
    print_message("  halving: %u wrong\n", halving);
    assert_true(halving > (SANITIZED ? 20 : 70));
}

/* The eye of a film that goes around, and its page, at a time: as vertices of a body that turns as a turntable does. */
static void make_round(const froe_motion *motion, const froe_camera *camera, flight *f) {
    enum { PLACES = 72 };
    static double times[PLACES + 1], centres[3 * (PLACES + 1)], turns[4 * (PLACES + 1)];
    static froe_camera cameras[PLACES];
    const size_t starts[] = {0, 1, 2, 3, 4, 5, 6};
    const double zeros[6] = {0};
    const uint32_t bodies[6] = {0};
    double at[18] = {0};
    froe_projection view;
    froe_scene *scene;
    froe_motion_options w = froe_motion_defaults();
    froe_moving m = froe_moving_defaults();
    assert_int_equal(froe_film_cameras(motion, camera, true, PLACES, cameras, NULL), FROE_OK);
    assert_int_equal(froe_camera_turns(camera, PLACES, turns, NULL), FROE_OK);
    assert_int_equal(froe_motion_scene(motion, 0, NULL, &scene, NULL), FROE_OK);
    assert_int_equal(froe_camera_place(cameras, scene, &view, NULL), FROE_OK);
    froe_scene_free(scene);
    *f = (flight){.parallel = camera->parallel, .body = froe_body_defaults()};
    for (size_t i = 0; i <= PLACES; i++) {
        times[i] = (double)i / PLACES;
        memcpy(centres + 3 * i, cameras->target, sizeof cameras->target);
    }
    f->body.count = PLACES + 1, f->body.times = times, f->body.coords = centres, f->body.turns = turns;
    for (int k = 0; k < 3; k++) at[k] = view.eye.at[k] - (f->parallel ? 0 : cameras->target[k]);
    for (int k = 0; k < 12; k++) at[6 + k] = view.window[k] - cameras->target[k % 3];
    w.dim = 3, w.begin = 0, w.end = 1;
    assert_int_equal(froe_motion_new(&w, NULL, &f->rig, NULL), FROE_OK);
    assert_int_equal(froe_motion_add_body(f->rig, &f->body, NULL, NULL), FROE_OK);
    m.vertex_count = 6, m.starts = starts, m.times = zeros, m.coords = at, m.bodies = bodies;
    assert_int_equal(froe_motion_add(f->rig, &m, NULL), FROE_OK);
}

/* At how many of some times a film shows other objects than are in sight. */
static unsigned count_wrong_around(const froe_motion *motion, const froe_render_options *o, bool exact, int shares) {
    froe_film_options film = froe_film_defaults();
    froe_film_report report;
    froe_diagnostic diag;
    unsigned wrong = 0;
    flight f;
    film.frames = exact ? 3 : 9, film.exact = exact, film.turn = true;
    if (froe_film(motion, "round.svg", o, &film, &report, &diag)) fail_msg("%s", diag.message);
    playing_read("round.svg");
    make_round(motion, &o->camera, &f);
    for (int i = 0; i < shares; i++) {
        const double time = chance();
        bool near;
        const unsigned shown = shown_at(time, &near);
        wrong += !near && shown != look_from(motion, &f, time);
    }
    froe_motion_free(f.rig);
    return wrong;
}

static void exact_films_go_around(void **state) {
    (void)state;
    unsigned halving = 0, wrong = 0;
    for (unsigned seed = SANITIZED ? 3 : 0; seed < (SANITIZED ? 5 : 6); seed++) {
        froe_motion *motion = seed > 3 ? make_tangle(seed, FACES) : make_motion_of(seed, seed > 1 ? STRAIGHT : REST);
        froe_render_options o = froe_render_defaults();
        o.camera.parallel = seed % 2, o.camera.width = o.camera.height = 600, o.decimals = 4;
        wrong += count_wrong_around(motion, &o, true, 200);
        halving += count_wrong_around(motion, &o, false, 200);
        froe_motion_free(motion);
    }
    print_message("  exact: %u wrong, halving with three times as many frames: %u\n", wrong, halving);
    assert_int_equal(wrong, 0);
    assert_true(SANITIZED || halving > 50);
}

/* Of bodies on parabolas that are off by a millionth, only a time within some millionths of an instant may differ from
 * what is in sight of the bodies; a half off, a film is wrong. */
static void exact_films_show_bodies_that_turn_within_the_deviation(void **state) {
    (void)state;
    unsigned rough = 0;
    for (unsigned seed = 60; seed < (SANITIZED ? 61 : 63); seed++) {
        const froe_render_options o = look_from_afar(true);
        froe_motion *motion = make_turning(seed), *filmed;
        for (int i = 0; i < 2; i++) {
            double reached;
            assert_int_equal(froe_motion_without_bodies(motion, i ? 0.5 : 1e-6, NULL, &filmed, &reached, NULL),
                             FROE_OK);
            const unsigned wrong = count_wrong(filmed, motion, &o, true);
            if (!i) assert_int_equal(wrong, 0);
            rough += wrong;
            froe_motion_free(filmed);
        }
        froe_motion_free(motion);
    }
    print_message("  a half off: %u wrong\n", rough);
    assert_true(SANITIZED || rough > 0);
}

static bool stop(void *user, double low, double high) {
    (void)low, (void)high;
    return ++*(int *)user < 3;
}

static froe_status find_once(void *user, const froe_allocator *alloc) {
    froe_motion *motion = NULL;
    const froe_eye eye = make_eye(false);
    int count = 0;
    (void)user;
    froe_status status = froe_generate_motion("moving-boxes", 1, 1, alloc, &motion, NULL);
    froe_motion_free(motion);
    motion = NULL;
    froe_motion_options w = froe_motion_defaults();
    w.dim = 3, w.begin = 0, w.end = 1;
    if (!status) status = froe_motion_new(&w, alloc, &motion, NULL);
    const size_t starts[] = {0, 2, 3, 4};
    const double times[] = {0, 1, 0, 0}, at[] = {-3, 0, 0, 3, 0, 0, 0, 1, 1, 0, 1, -1};
    froe_moving m = froe_moving_defaults();
    m.vertex_count = 3, m.count = 1, m.starts = starts, m.times = times, m.coords = at;
    if (!status) status = froe_motion_add(motion, &m, NULL);
    const froe_sight_options o = ask(eye, page, NULL, 0, 1);
    if (!status) status = froe_motion_sights(motion, &o, stop, &count, NULL);
    froe_motion_free(motion);
    return status;
}

static void allocations_may_fail(void **state) {
    (void)state;
    assert_true(test_memory_each(find_once, NULL) > 5);
}

static void what_cannot_be_followed_is_refused(void **state) {
    (void)state;
    froe_motion *plane = NULL, *boxes = NULL, *bent = make_motion(1, true);
    froe_diagnostic diag;
    const froe_eye point = {.at = {0, -30, 0}}, parallel = {.at = {0, -30, 0}, .parallel = true};
    const froe_sight_options far = ask(parallel, NULL, NULL, 0, 0), near = ask(point, NULL, NULL, 0, 1),
                             late = ask(parallel, NULL, NULL, 0, 2), o = ask(parallel, NULL, NULL, 0, 1);
    int count = 0;
    assert_int_equal(froe_generate_motion("moving", 3, 1, NULL, &plane, NULL), FROE_OK);
    assert_int_equal(froe_generate_motion("moving-boxes", 2, 1, NULL, &boxes, NULL), FROE_OK);
    assert_int_equal(froe_motion_sights(plane, &far, stop, &count, &diag), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_motion_sights(boxes, &far, stop, &count, &diag), FROE_E_UNSUPPORTED);
    assert_string_equal(diag.message, "object 0: It is of a body, which may turn.");
    assert_int_equal(froe_motion_sights(bent, &near, stop, &count, &diag), FROE_OK);
    assert_int_equal(froe_motion_sights(bent, &late, stop, &count, &diag), FROE_E_OPTIONS);
    assert_int_equal(froe_motion_sights(bent, &o, NULL, &count, &diag), FROE_E_ARG);
    assert_int_equal(count, 3);
    count = 0;
    assert_int_equal(froe_motion_sights(bent, &o, stop, &count, &diag), FROE_OK);
    assert_int_equal(count, 3);
    const double times[] = {0, 1, 0, 0}, at[] = {-3, 0, 0, 3, 0, 0, 0, 1, 1, 0, 1, -1}, bend[12] = {0};
    froe_moving m = froe_moving_defaults();
    m.vertex_count = 3, m.count = 1, m.starts = (const size_t[]){0, 2, 3, 4}, m.times = times, m.coords = at;
    m.controls = bend, m.second_controls = bend;
    assert_int_equal(froe_motion_add(bent, &m, NULL), FROE_OK);
    assert_int_equal(froe_motion_sights(bent, &o, stop, &count, &diag), FROE_OK);
    assert_int_equal(froe_motion_sights(bent, &near, stop, &count, &diag), FROE_E_UNSUPPORTED);
    assert_non_null(strstr(diag.message, "It flies along a cubic, which only a parallel eye that does not turn can "
                                         "follow."));
    froe_motion_free(plane), froe_motion_free(boxes), froe_motion_free(bent);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crossings_at_rest_are_edges),
        cmocka_unit_test(eyes_that_move_see_changes_at_instants_alone),
        cmocka_unit_test(exact_films_go_around),
        cmocka_unit_test(exact_films_show_what_is_in_sight_at_any_time),
        cmocka_unit_test(exact_films_show_bodies_that_turn_within_the_deviation),
        cmocka_unit_test(faces_in_sight_change_at_instants_alone),
        cmocka_unit_test(what_is_seen_before_tells_the_first_change),
        cmocka_unit_test(allocations_may_fail),
        cmocka_unit_test(what_cannot_be_followed_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
