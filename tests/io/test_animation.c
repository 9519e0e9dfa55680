/* Animations of models: what is followed is held against an evaluation of the file's own interpolation, and what is no
 * rigid motion is refused by name. */
#include "animated.h"
#include "support/memory.h"

static uint64_t dice;

static double chance(void) {
    dice = dice * 6364136223846793005u + 1442695040888963407u;
    return (double)(dice >> 11) * 0x1p-53;
}

static int below(int n) {
    return (int)(chance() * n);
}

static void random_turn(float *q) {
    double square = 0, v[4];
    do {
        square = 0;
        for (int k = 0; k < 4; k++) v[k] = 2 * chance() - 1, square += v[k] * v[k];
    } while (!(square > 0.1 && square < 1));
    for (int k = 0; k < 4; k++) q[k] = (float)(v[k] / sqrt(square));
}

static void random_vector(float *v, double size) {
    for (int k = 0; k < 3; k++) v[k] = (float)(size * (2 * chance() - 1));
}

static void random_track(animated_track *t, int width, double size) {
    t->count = 2 + below(ANIMATED_KEYS - 1);
    t->between = below(3);
    const int each = t->between == CUBIC ? 3 : 1;
    for (int i = 0; i < t->count; i++) {
        t->times[i] = (float)((i ? (double)t->times[i - 1] : 0.5 * chance()) + 0.25 + chance());
        for (int k = 0; k < each; k++) random_vector(t->values[each * i + k], size);
        if (width == 4) random_turn(t->values[each * i + each / 2]);
        for (int k = 0; k < each && width == 4 && each == 3; k += 2) /* small tangents: splines of turns near no 0 */
            for (int j = 0; j < 4; j++) t->values[each * i + k][j] = (float)(0.4 * chance() - 0.2);
        if (width == 4 && each == 3 && i) { /* and keys of one half */
            double dot = 0;
            for (int j = 0; j < 4; j++) dot += (double)t->values[3 * i + 1][j] * (double)t->values[3 * i - 2][j];
            for (int j = 0; j < 4 && dot < 0; j++) t->values[3 * i + 1][j] = -t->values[3 * i + 1][j];
        }
    }
}

/* At rest nodes have maps that floats hold exactly. */
static void rest(animated_node *node) {
    static const int orders[][3] = {{0, 1, 2}, {1, 2, 0}, {1, 0, 2}};
    const int *order = orders[below(3)];
    const float size = (float)(1 << below(3)) / 2;
    random_vector(node->place, 2);
    node->turn[3] = 1;
    for (int k = 0; k < 3; k++) node->scale[k] = size;
    node->matrix = below(2);
    for (int k = 0; k < 3; k++) node->map[3 * k + order[k]] = below(2) ? size : -size;
}

static void make_random(animated_model *m, uint64_t seed) {
    dice = seed * 2654435761u + 12345;
    memset(m, 0, sizeof *m);
    m->nodes = 2 + below(ANIMATED_NODES - 1);
    for (int c = 0; c < 3; c++) random_vector(m->corners[c], 3);
    for (int n = 0; n < m->nodes; n++) {
        animated_node *node = m->node + n;
        node->parent = n ? below(n + 1) - 1 : -1;
        if (node->parent < 0 && n) node->parent = n - 1; /* one long chain is more likely */
        node->mesh = true;
        rest(node);
        if (n + 1 < m->nodes && below(3) == 0) continue;
        node->matrix = false;
        if (below(3)) random_track(&node->track[0], 3, 3);
        random_track(&node->track[1], 4, 1);
    }
}

typedef struct compared {
    double most, reported, extent;
    uint64_t points, pieces;
} compared;

/* All corners at many times. Triangles are in the order of the nodes as the file's tree has them, each as often as its
 * part has lives. */
static compared compare(const animated_model *m, const char *path, const froe_motion_read_options *options) {
    froe_motion *motion = NULL;
    froe_motion_report report;
    froe_diagnostic diag = {.message = ""};
    compared c = {.most = 0};
    if (froe_read_animation(path, options, &motion, &report, &diag)) fail_msg("%s: %s", path, diag.message);
    const froe_motion_options window = froe_motion_window(motion);
    int order[ANIMATED_NODES], stack[ANIMATED_NODES], count = 0, height = 0;
    for (int n = m->nodes; n-- > 0;)
        if (m->node[n].parent < 0) stack[height++] = n;
    while (height) {
        const int n = stack[--height];
        order[count++] = n;
        for (int child = m->nodes; child-- > n + 1;)
            if (m->node[child].parent == n) stack[height++] = child;
    }
    uint32_t object = 0;
    for (int i = 0; i < count; i++) {
        if (!m->node[order[i]].mesh) continue;
        for (double end = -1; end < window.end; object++) {
            const froe_moving_object o = froe_motion_object(motion, object);
            char name[16];
            snprintf(name, sizeof name, "node %d", order[i]);
            assert_string_equal(froe_motion_group(motion, o.group).name, name);
            for (int s = 0; s <= 400; s++) {
                const double time = s == 400 ? o.death : o.birth + (o.death - o.birth) * s / 400;
                for (int corner = 0; corner < 3; corner++) {
                    double at[3];
                    long double truth[3], apart = 0;
                    assert_true(froe_motion_position(motion, o.vertices[corner], time, at));
                    animated_point(m, order[i], corner, time, time == o.death, truth);
                    for (int k = 0; k < 3; k++) apart += (at[k] - truth[k]) * (at[k] - truth[k]);
                    c.most = fmax(c.most, (double)sqrtl(apart));
                    c.points++;
                }
            }
            assert_true(end < 0 || o.birth == end);
            end = o.death;
        }
    }
    assert_int_equal(object, froe_motion_object_count(motion));
    c.reported = report.deviation, c.extent = report.extent, c.pieces = report.pieces;
    froe_motion_free(motion);
    return c;
}

static void the_deviation_that_is_told_holds_everywhere(void **state) {
    (void)state;
    static animated_model m;
    double share = 0;
    uint64_t points = 0;
    for (uint64_t seed = 1; seed <= 30; seed++) {
        make_random(&m, seed);
        animated_write(&m, "random.gltf");
        const compared c = compare(&m, "random.gltf", NULL);
        if (!(c.most <= c.reported + 1e-12 * c.extent))
            fail_msg("seed %u: %g apart, and %g was told", (unsigned)seed, c.most, c.reported);
        assert_true(c.reported <= 1e-3 * c.extent);
        if (c.reported > 1e-9) share = fmax(share, c.most / c.reported);
        points += c.points;
    }
    assert_true(points > 250000 && share > 0.8 && share < 1); /* and it is not told to be much more than it is */
}

static void less_deviation_takes_more_pieces(void **state) {
    (void)state;
    static animated_model m;
    froe_motion_read_options o = froe_motion_read_defaults();
    make_random(&m, 7);
    animated_write(&m, "finer.gltf");
    const compared coarse = compare(&m, "finer.gltf", &o);
    o.deviation = 1e-5;
    const compared fine = compare(&m, "finer.gltf", &o);
    assert_true(fine.pieces > 2 * coarse.pieces && fine.most <= fine.reported + 1e-12 * fine.extent);
    assert_true(fine.reported <= 1e-5 * fine.extent);
    o.from = 0.75, o.to = 9;
    compare(&m, "finer.gltf", &o);
}

/* A door that turns by half a turn about its hinge: no centre is off its way. */
static void make_door(animated_model *m) {
    memset(m, 0, sizeof *m);
    m->nodes = 2;
    const float corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}};
    memcpy(m->corners, corners, sizeof corners);
    for (int n = 0; n < 2; n++) {
        m->node[n] = (animated_node){.parent = -1, .mesh = true, .turn = {0, 0, 0, 1}, .scale = {1, 1, 1}};
        m->node[n].place[0] = (float)(-3 * n);
    }
    m->node[0].track[1] =
        (animated_track){.count = 2, .between = LINEAR, .times = {0, 2}, .values = {{0, 0, 0, 1}, {0, 1, 0, 0}}};
}

static void a_hinge_keeps_to_its_arc(void **state) {
    (void)state;
    static animated_model m;
    make_door(&m);
    animated_write(&m, "door.gltf");
    const compared c = compare(&m, "door.gltf", NULL);
    assert_true(c.pieces >= 4 && c.pieces <= 16 && c.reported > 0);
}

/* Keys are those of the file, with slerp in between; the leaf is at z = 1, and the post beside it stands. */
static void collada_and_fbx_move_by_the_keys_that_assimp_has(void **state) {
    (void)state;
    static const struct {
        const char *path;
        double end, quarter; /* when the leaf has turned by 90 degrees */
    } cases[] = {{FROE_TEST_DATA "/../tests/io/door.dae", 3, 1}, {FROE_TEST_DATA "/../tests/io/door.fbx", 2, 2}};
    for (size_t i = 0; i < 2; i++) {
        froe_motion *motion = NULL;
        froe_motion_report report;
        froe_diagnostic diag = {.message = ""};
        if (froe_read_animation(cases[i].path, NULL, &motion, &report, &diag)) fail_msg("%s", diag.message);
        assert_true(froe_motion_window(motion).begin == 0 && froe_motion_window(motion).end == cases[i].end);
        assert_true(froe_motion_object_count(motion) == 2 && report.features == 1 && report.still == 1);
        for (int step = 0; step <= 90; step++) {
            const double angle = step * 3.14159265358979323846 / 180;
            const double truth[3] = {cos(angle), 2, 1 - sin(angle)};
            double at[3], apart = 0;
            assert_true(froe_motion_position(motion, 2, cases[i].quarter * step / 90, at));
            for (int k = 0; k < 3; k++) apart += (at[k] - truth[k]) * (at[k] - truth[k]);
            assert_true(sqrt(apart) <= report.deviation + 1e-6); /* assimp rounds to floats */
        }
        assert_true(report.deviation <= 1e-3 * report.extent && report.deviation > 0);
        froe_motion_free(motion);
    }
}

/* ---------------------------------------------------------------------- refusals -- */

static char *read_text(const char *path) {
    static char text[1 << 16];
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    return text;
}

static void expect(const char *path, const froe_motion_read_options *o, froe_status status, const char *message) {
    froe_diagnostic diag = {.message = ""};
    froe_motion *motion = NULL;
    const froe_status found = froe_read_animation(path, o, &motion, NULL, &diag);
    if (found != status || (message && strcmp(diag.message, message) != 0)) /* NULL: assimp says it */
        fail_msg("%s: expected '%s', got %s '%s'", path, message ? message : "", froe_status_name(found), diag.message);
    assert_null(motion);
}

static void keys_that_are_none_are_refused(void **state) {
    (void)state;
    static animated_model m;
    make_door(&m);
    m.node[0].track[1].times[1] = 0;
    animated_write(&m, "bad.gltf");
    expect("bad.gltf", NULL, FROE_E_INPUT,
           "bad.gltf: animation 'go': node 'node 0': Time 1, 0, is not after time 0, 0.");
    m.node[0].track[1].times[1] = NAN;
    animated_write(&m, "bad.gltf");
    expect("bad.gltf", NULL, FROE_E_INPUT, "bad.gltf: animation 'go': node 'node 0': Time 1 is not finite.");
    make_door(&m);
    m.node[0].track[1].values[1][1] = NAN;
    animated_write(&m, "bad.gltf");
    expect("bad.gltf", NULL, FROE_E_INPUT,
           "bad.gltf: animation 'go': node 'node 0': A number at time 1 is not finite.");
    m.node[0].track[1].values[1][1] = 0;
    animated_write(&m, "bad.gltf");
    expect("bad.gltf", NULL, FROE_E_INPUT,
           "bad.gltf: animation 'go': node 'node 0': The quaternion at time 1, 0 0 0 0, does not have the length 1.");
    m.node[0].track[1].values[1][1] = 1.01f;
    animated_write(&m, "bad.gltf");
    expect(
        "bad.gltf", NULL, FROE_E_INPUT,
        "bad.gltf: animation 'go': node 'node 0': The quaternion at time 1, 0 1.01 0 0, does not have the length 1.");
    m.node[0].track[1].values[1][1] = 1, m.node[0].track[1].count = 1;
    animated_write(&m, "bad.gltf");
    expect("bad.gltf", NULL, FROE_E_INPUT, "bad.gltf: animation 'go': It has no two keys at different times.");
}

static void what_is_not_rigid_is_refused(void **state) {
    (void)state;
    static animated_model m;
    make_door(&m);
    m.node[0].track[2] =
        (animated_track){.count = 2, .between = LINEAR, .times = {0, 1}, .values = {{1, 1, 1}, {1, 2, 1}}};
    animated_write(&m, "scaled.gltf");
    expect("scaled.gltf", NULL, FROE_E_UNSUPPORTED,
           "scaled.gltf: animation 'go': node 'node 0': Its scale changes from 1 1 1 to 1 2 1 at the time 1, and parts "
           "move as rigid bodies.");
    for (int k = 0; k < 3; k++) {
        m.node[0].track[2].values[1][k] = 3, m.node[0].track[2].values[1][(k + 1) % 3] = 1;
        m.node[0].track[2].values[1][(k + 2) % 3] = 1;
        animated_write(&m, "scaled.gltf");
        expect("scaled.gltf", NULL, FROE_E_UNSUPPORTED, NULL);
    }
    make_door(&m);
    m.node[1] = m.node[0], m.node[1].parent = 0, m.node[0].scale[2] = 2;
    animated_write(&m, "sheared.gltf");
    expect("sheared.gltf", NULL, FROE_E_UNSUPPORTED,
           "sheared.gltf: animation 'go': node 'node 0': It is scaled by different factors, and what turns below it is "
           "no rigid body.");
    for (int k = 0; k < 3; k++) m.node[0].scale[k] = -3; /* mirrored, by one factor: allowed */
    m.node[1].scale[0] = 5, m.node[1].scale[1] = -1;     /* nothing turns below it: allowed */
    animated_write(&m, "mirrored.gltf");
    const compared c = compare(&m, "mirrored.gltf", NULL);
    assert_true(c.most <= c.reported && c.reported <= 1e-3 * c.extent);
    make_door(&m);
    m.node[0].mesh = false;
    animated_write(&m, "empty.gltf");
    expect("empty.gltf", NULL, FROE_E_INPUT, "empty.gltf: animation 'go': It moves nothing that has faces.");
    make_door(&m);
    m.node[0].track[1] = (animated_track){.count = 2, .between = CUBIC, .times = {0, 1}};
    m.node[0].track[1].values[1][3] = 1, m.node[0].track[1].values[4][3] = -1; /* through 0 */
    animated_write(&m, "through.gltf");
    expect("through.gltf", NULL, FROE_E_LIMIT,
           "through.gltf: animation 'go': At the time 0.5 a deviation of 0.00447 cannot be kept.");
    m.node[0].track[1].times[0] = 8388608, m.node[0].track[1].times[1] = 8388609; /* no number is in between at last */
    animated_write(&m, "through.gltf");
    expect("through.gltf", NULL, FROE_E_LIMIT,
           "through.gltf: animation 'go': At the time 8388608.5 a deviation of 0.00447 cannot be kept.");
}

/* Pieces are as many as the root of what is asked for: those that nobody could wait for are refused. */
static void tiny_deviations_are_refused(void **state) {
    (void)state;
    static animated_model m;
    froe_motion_read_options o = froe_motion_read_defaults();
    make_random(&m, 7);
    animated_write(&m, "tiny.gltf");
    o.deviation = 1e-6;
    const compared fine = compare(&m, "tiny.gltf", &o);
    assert_true(fine.pieces > 2000 && fine.most <= fine.reported + 1e-12 * fine.extent);
    o.deviation = 1e-12;
    froe_diagnostic diag = {.message = ""};
    froe_motion *motion = NULL;
    assert_int_equal(froe_read_animation("tiny.gltf", &o, &motion, NULL, &diag), FROE_E_LIMIT);
    assert_null(motion);
    assert_non_null(strstr(diag.message, " is not reached by 65536 halvings of pieces."));
    assert_ptr_equal(strstr(diag.message, "tiny.gltf: animation 'go': At the time "), diag.message);
}

/* Nodes that stand while others move, or rest below one that moves; a node without faces may have any scale. */
static void scales_of_nodes_that_rest_are_refused(void **state) {
    (void)state;
    static animated_model m;
    for (int parent = -1; parent < 1; parent++) {
        make_door(&m);
        m.node[1].parent = parent;
        m.node[1].track[2] = (animated_track){
            .count = 3, .between = LINEAR, .times = {0, 1, 2}, .values = {{1, 1, 1}, {3, 3, 3}, {1, 1, 1}}};
        animated_write(&m, "grows.gltf");
        expect("grows.gltf", NULL, FROE_E_UNSUPPORTED,
               "grows.gltf: animation 'go': node 'node 1': Its scale changes from 1 1 1 to 3 3 3 at the time 1, and "
               "parts move as rigid bodies.");
        for (int k = 0; k < 3; k++) m.node[1].track[2].values[1][k] = 1.0001f;
        animated_write(&m, "drifts.gltf");
        const compared c = compare(&m, "drifts.gltf", NULL);
        assert_true(c.most <= c.reported && c.reported <= 1.2e-3 * c.extent);
        for (int k = 0; k < 3; k++) m.node[1].track[2].values[1][k] = 9;
        m.node[1].mesh = false;
        animated_write(&m, "empty.gltf");
        compare(&m, "empty.gltf", NULL);
    }
}

static void a_scale_along_a_spline_between_equal_keys_is_refused(void **state) {
    (void)state;
    static animated_model m;
    make_door(&m);
    animated_track *scale = &m.node[0].track[2];
    *scale = (animated_track){.count = 2, .between = CUBIC, .times = {0, 1}};
    for (int k = 0; k < 3; k++) scale->values[1][k] = scale->values[4][k] = 1;
    scale->values[0][0] = scale->values[5][1] = 9; /* before the first key and after the last: of no effect */
    animated_write(&m, "scaled.gltf");
    const compared c = compare(&m, "scaled.gltf", NULL);
    assert_true(c.most <= c.reported);
    for (int k = 2; k < 4; k++) {
        scale->values[k][2] = 4;
        animated_write(&m, "scaled.gltf");
        expect("scaled.gltf", NULL, FROE_E_UNSUPPORTED,
               "scaled.gltf: animation 'go': node 'node 0': Its scale changes along a spline before the time 1, and "
               "parts move as rigid bodies.");
        scale->values[k][2] = 0;
    }
}

/* 64 / 127 four times, as glTF has a turn by a third in bytes. */
static void quaternions_rounded_to_bytes_are_read(void **state) {
    (void)state;
    static animated_model m;
    for (int up = 0; up < 2; up++) {
        make_door(&m);
        for (int k = 0; k < 4; k++) m.node[0].track[1].values[1][k] = (float)((63 + up) / 127.0);
        animated_write(&m, "bytes.gltf");
        const compared c = compare(&m, "bytes.gltf", NULL);
        assert_true(c.pieces >= 4 && c.most <= c.reported + 1e-12);
    }
}

/* Messages quote 40 bytes of a name, and the 40th begins a character. */
static void a_name_that_is_cut_within_a_character_is_quoted_as_text(void **state) {
    (void)state;
    static animated_model m;
    make_door(&m);
    m.node[0].track[1].times[1] = 0;
    animated_write(&m, "right.gltf");
    const char *text = read_text("right.gltf"), *at = strstr(text, "\"node 0\"");
    FILE *file = fopen("cut.gltf", "w");
    assert_true(at && file);
    fprintf(file, "%.*s\"012345678901234567890123456789012345678\xc3\xa4\"%s", (int)(at - text), text, at + 8);
    fclose(file);
    expect("cut.gltf", NULL, FROE_E_INPUT,
           "cut.gltf: animation 'go': node '012345678901234567890123456789012345678?': Time 1, 0, is not after time 0, "
           "0.");
}

/* The second leaf of the door stands still. */
static void a_motion_with_parts_that_stand_survives_a_file(void **state) {
    (void)state;
    static animated_model m;
    froe_motion *made = NULL, *read = NULL;
    froe_diagnostic diag = {.message = ""};
    make_door(&m);
    animated_write(&m, "door.gltf");
    assert_int_equal(froe_read_animation("door.gltf", NULL, &made, NULL, NULL), FROE_OK);
    if (froe_write_motion(made, "door.mfjson", &diag)) fail_msg("%s", diag.message);
    assert_int_equal(froe_read_motion("door.mfjson", NULL, &read, NULL, NULL), FROE_OK);
    assert_int_equal(froe_motion_object_count(read), 2);
    for (uint32_t i = 0; i < 2; i++) {
        const froe_moving_object a = froe_motion_object(made, i), b = froe_motion_object(read, i);
        assert_true(a.birth == b.birth && a.death == b.death && a.birth == 0 && a.death == 2);
        assert_string_equal(froe_motion_group(made, a.group).name, froe_motion_group(read, b.group).name);
        for (int s = 0; s <= 20; s++)
            for (int corner = 0; corner < 3; corner++) {
                double p[3], q[3];
                assert_true(froe_motion_position(made, a.vertices[corner], s / 10.0, p));
                assert_true(froe_motion_position(read, b.vertices[corner], s / 10.0, q));
                assert_memory_equal(p, q, sizeof p);
            }
    }
    froe_motion_free(made), froe_motion_free(read);
}

static void wrong_calls_are_refused(void **state) {
    (void)state;
    static animated_model m;
    froe_motion *motion = NULL;
    froe_motion_read_options o = froe_motion_read_defaults();
    make_door(&m);
    animated_write(&m, "door.gltf");
    expect(NULL, NULL, FROE_E_ARG, "An argument of froe_read_animation is NULL.");
    assert_int_equal(froe_read_animation("door.gltf", NULL, NULL, NULL, NULL), FROE_E_ARG);
    o.size = 0;
    expect("door.gltf", &o, FROE_E_OPTIONS, NULL);
    o = froe_motion_read_defaults(), o.deviation = (double)INFINITY;
    expect("door.gltf", &o, FROE_E_OPTIONS, "The deviation of an animation, inf, is not above 0.");
    o = froe_motion_read_defaults(), o.from = 3, o.to = 1;
    expect("door.gltf", &o, FROE_E_INPUT, "door.gltf: The window 3 .. 1 is empty, endless or not a number.");
    m.node[0].track[1].count = 1;
    animated_write(&m, "still.gltf");
    static const char two[] = "still.gltf: animation 'go': It has no two keys at different times.";
    for (int k = 0; k < 2; k++) {
        o = froe_motion_read_defaults();
        *(k ? &o.to : &o.from) = 1;
        expect("still.gltf", &o, FROE_E_INPUT, two);
    }
    o.from = 0;
    expect("still.gltf", &o, FROE_E_INPUT, "still.gltf: animation 'go': It moves nothing that has faces.");
    assert_null(motion);
}

/* Keys that are all the same move nothing, and still say where a node is; so do nodes without faces. */
static void tracks_that_rest_hold_their_nodes(void **state) {
    (void)state;
    static animated_model m;
    make_door(&m);
    m.nodes = 4;
    m.node[2] = m.node[1], m.node[2].parent = 1, m.node[2].scale[0] = m.node[2].scale[1] = m.node[2].scale[2] = 0;
    m.node[3] = m.node[0], m.node[3].mesh = false; /* it moves, and has no faces */
    m.node[1].track[0] = (animated_track){2, STEP, {0, 1}, {{1, 2, 3}, {1, 2, 3}}};
    m.node[1].track[1] = (animated_track){1, CUBIC, {0}, {{7, 0, 0, 0}, {0, 1, 0, 0}, {0, 7, 0, 0}}};
    m.node[1].track[2] = (animated_track){1, LINEAR, {0}, {{2, 2, 2}}};
    m.node[0].track[0] = (animated_track){3, STEP, {0, 1, 2}, {{0, 0, 0}, {0, 0, 0}, {0, 1, 0}}};
    animated_write(&m, "rests.gltf");
    const compared c = compare(&m, "rests.gltf", NULL);
    assert_true(c.most <= c.reported + 1e-12 && c.reported <= 1e-3 * c.extent);
}

/* The rotation at rest counts only where no keys are. */
static void a_rotation_beyond_numbers_may_be_replaced_by_keys(void **state) {
    (void)state;
    static animated_model m;
    make_door(&m);
    m.node[0].turn[0] = 3e38f;
    animated_write(&m, "large.gltf");
    m.node[0].turn[0] = 0;
    const compared c = compare(&m, "large.gltf", NULL);
    assert_true(c.most <= c.reported + 1e-12);
}

static void lines_are_refused_with_the_name_of_the_file(void **state) {
    (void)state;
    static animated_model m;
    make_door(&m);
    animated_write(&m, "right.gltf");
    const char *text = read_text("right.gltf"), *at = strstr(text, "\"indices\":1");
    FILE *file = fopen("lines.gltf", "w");
    assert_true(at && file);
    fprintf(file, "%.*s\"mode\":3,%s", (int)(at - text), text, at);
    fclose(file);
    expect("lines.gltf", NULL, FROE_E_UNSUPPORTED, "lines.gltf: object 0: It is no polygon, and only those are parts.");
}

/* DirectX: keys of frames by their names, which may be those of two or of none. */
static void keys_of_names_that_are_not_those_of_one_node_are_refused(void **state) {
    (void)state;
    static const char text[] =
        "xof 0303txt 0032\nFrame leaf {\n FrameTransformMatrix { "
        "1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0;; }\n"
        " Mesh m { 3; 0.0;0.0;0.0;, 1.0;0.0;0.0;, 0.0;1.0;0.0;; 1; 3;0,1,2;; %s }\n Frame %s { }\n}\n"
        "AnimationSet go { Animation a { {%s} AnimationKey { 2; 2; 0;3;0.0,0.0,0.0;;, 4;3;1.0,0.0,0.0;;; } } }\n";
    static const struct {
        const char *skin, *frame, *moved;
        froe_status status;
        const char *message;
    } cases[] = {
        {"", "other", "leaf", FROE_OK, NULL},
        {"", "leaf", "leaf", FROE_E_INPUT, "keys.x: animation 'go': node 'leaf': Several nodes have this name."},
        {"", "other", "door", FROE_E_INPUT, "keys.x: animation 'go': node 'door': The model has no such node."},
        {"SkinWeights { \"other\"; 1; 0; 1.0; 1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0;; }",
         "other", "leaf", FROE_E_UNSUPPORTED,
         "keys.x: animation 'go': node 'leaf': It is skinned, and parts move as rigid bodies."},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        FILE *file = fopen("keys.x", "w");
        assert_non_null(file);
        fprintf(file, text, cases[i].skin, cases[i].frame, cases[i].moved);
        fclose(file);
        if (cases[i].status) {
            expect("keys.x", NULL, cases[i].status, cases[i].message);
            continue;
        }
        froe_motion *motion = NULL;
        double at[3][3];
        assert_int_equal(froe_read_animation("keys.x", NULL, &motion, NULL, NULL), FROE_OK);
        assert_true(froe_motion_window(motion).end == 4); /* no ticks are told: each is a second */
        for (int k = 0; k < 3; k++)
            assert_true(froe_motion_position(motion, froe_motion_object(motion, 0).vertices[0], 2 * k, at[k]));
        for (int k = 1; k < 3; k++)
            assert_true(at[k][0] - at[0][0] == k / 2.0 && at[k][1] == at[0][1] && at[k][2] == at[0][2]);
        froe_motion_free(motion);
    }
}

/* Changes of the text of a file that is right. */
static void what_the_file_lacks_is_said(void **state) {
    (void)state;
    static const struct {
        const char *from, *to;
        froe_status status;
        const char *message;
    } cases[] = {
        {"\"animations\":", "\"animation\":", FROE_E_INPUT, "broken.gltf: The model has no animation."},
        {"\"output\":3,\"interpolation\":\"LINEAR\"}],\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,"
         "\"path\":\"rotation\"",
         "\"output\":2}],\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"weights\"", FROE_E_UNSUPPORTED,
         "broken.gltf: animation 'go': node 'node 0': It changes the shape of its mesh (morph targets), and parts move "
         "as rigid bodies."},
        {"\"node\":0,\"path\"", "\"node\":7,\"path\"", FROE_E_FORMAT, NULL},
        {"\"LINEAR\"", "\"SPIRAL\"", FROE_E_UNSUPPORTED,
         "broken.gltf: animation 'go': node 'node 0': There is no interpolation 'SPIRAL'."},
        {"\"sampler\":0", "\"sampler\":3", FROE_E_FORMAT, NULL},
        {"\"output\":3", "\"output\":2", FROE_E_FORMAT, NULL},
    };
    static animated_model m;
    make_door(&m);
    animated_write(&m, "right.gltf");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *text = read_text("right.gltf"), *at = strstr(text, cases[i].from);
        FILE *file = fopen("broken.gltf", "w");
        assert_true(at && file);
        fprintf(file, "%.*s%s%s", (int)(at - text), text, cases[i].to, at + strlen(cases[i].from));
        fclose(file);
        expect("broken.gltf", NULL, cases[i].status, cases[i].message);
    }
    froe_motion_read_options o = froe_motion_read_defaults();
    o.animation = "walk";
    expect("right.gltf", &o, FROE_E_OPTIONS, "right.gltf: There is no animation 'walk'. There are: 'go'.");
    o.animation = "0";
    compare(&m, "right.gltf", &o);
    o.deviation = 0;
    expect("right.gltf", &o, FROE_E_OPTIONS, "The deviation of an animation, 0, is not above 0.");
}

/* Whatever bytes are changed, the answer is a motion or a sentence. */
static void changed_bytes_end_in_a_status(void **state) {
    (void)state;
    static animated_model m;
    static char bytes[1 << 16];
    make_random(&m, 3);
    animated_write(&m, "bytes.gltf");
    const size_t size = strlen(strcpy(bytes, read_text("bytes.gltf")));
    size_t read = 0;
    for (int round = 0; round < 200; round++) {
        static char changed[1 << 16];
        froe_motion *motion = NULL;
        froe_diagnostic diag = {.message = ""};
        memcpy(changed, bytes, size);
        for (int k = below(3); k >= 0; k--) changed[below((int)size)] = "0123456789,[]{}\":ABxyz-."[below(25)];
        write_bytes("changed.gltf", changed, size);
        const froe_status status = froe_read_animation("changed.gltf", NULL, &motion, NULL, &diag);
        assert_true(!status == !*diag.message && !status == !!motion);
        read += !status;
        froe_motion_free(motion);
    }
    assert_true(read > 10 && read < 190);
}

static froe_status read_once(void *user, const froe_allocator *alloc) {
    froe_motion_read_options o = froe_motion_read_defaults();
    o.alloc = alloc;
    froe_motion *motion = NULL;
    const froe_status status = froe_read_animation(user, &o, &motion, NULL, NULL);
    froe_motion_free(motion);
    return status;
}

/* So many keys and jumps that lists of them grow. */
static void make_chain(animated_model *m) {
    memset(m, 0, sizeof *m);
    m->nodes = 5;
    for (int c = 0; c < 3; c++) random_vector(m->corners[c], 3);
    for (int n = 0; n < m->nodes; n++) {
        m->node[n] = (animated_node){.parent = n - 1, .mesh = n == 4, .turn = {0, 0, 0, 1}, .scale = {1, 1, 1}};
        m->node[n].track[0] = (animated_track){.count = ANIMATED_KEYS, .between = STEP};
        for (int k = 0; k < ANIMATED_KEYS; k++)
            m->node[n].track[0].times[k] = (float)(n + 5 * k), m->node[n].track[0].values[k][0] = (float)k;
    }
}

static void allocations_may_fail(void **state) {
    (void)state;
    static animated_model m;
    make_random(&m, 3);
    animated_write(&m, "memory.gltf");
    assert_true(test_memory_each(read_once, "memory.gltf") > 50);
    make_chain(&m);
    animated_write(&m, "chain.gltf");
    const compared c = compare(&m, "chain.gltf", NULL);
    if (c.most > c.reported + 1e-12 * c.extent) fail_msg("%g apart, and %g was told", c.most, c.reported);
    assert_true(test_memory_each(read_once, "chain.gltf") > 50);
    for (const char *const *door = (const char *const[]){FROE_TEST_DATA "/../tests/io/door.dae",
                                                         FROE_TEST_DATA "/../tests/io/door.fbx", NULL};
         *door; door++)
        assert_true(test_memory_each(read_once, (void *)(uintptr_t)*door) > 20);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_deviation_that_is_told_holds_everywhere),
        cmocka_unit_test(less_deviation_takes_more_pieces),
        cmocka_unit_test(tiny_deviations_are_refused),
        cmocka_unit_test(a_hinge_keeps_to_its_arc),
        cmocka_unit_test(collada_and_fbx_move_by_the_keys_that_assimp_has),
        cmocka_unit_test(keys_that_are_none_are_refused),
        cmocka_unit_test(what_is_not_rigid_is_refused),
        cmocka_unit_test(scales_of_nodes_that_rest_are_refused),
        cmocka_unit_test(a_scale_along_a_spline_between_equal_keys_is_refused),
        cmocka_unit_test(quaternions_rounded_to_bytes_are_read),
        cmocka_unit_test(a_name_that_is_cut_within_a_character_is_quoted_as_text),
        cmocka_unit_test(a_motion_with_parts_that_stand_survives_a_file),
        cmocka_unit_test(wrong_calls_are_refused),
        cmocka_unit_test(tracks_that_rest_hold_their_nodes),
        cmocka_unit_test(a_rotation_beyond_numbers_may_be_replaced_by_keys),
        cmocka_unit_test(keys_of_names_that_are_not_those_of_one_node_are_refused),
        cmocka_unit_test(lines_are_refused_with_the_name_of_the_file),
        cmocka_unit_test(what_the_file_lacks_is_said),
        cmocka_unit_test(changed_bytes_end_in_a_status),
        cmocka_unit_test(allocations_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
