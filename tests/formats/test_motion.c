/* test_motion.c: Moving Features JSON: what is read, what is refused and how, and that writing loses nothing. */
#include "support/memory.h"
#include "support/scenes.h"

#include "formats/motion/datetime.h"
#include <math.h>
#include <string.h>

#define LINE(times, coordinates, more)                                                                                 \
    "{\"type\":\"Feature\",\"properties\":{\"name\":\"n\"},\"temporalGeometry\":{\"type\":\"MovingLineString\","       \
    "\"datetimes\":" times ",\"coordinates\":" coordinates more "}}"

#define HEAD "{\"type\":\"FeatureCollection\",\"features\":["
#define CLOUD(triangles)                                                                                               \
    HEAD "{\"type\":\"Feature\",\"temporalGeometry\":{\"type\":\"MovingPointCloud\",\"datetimes\":[0,10],"             \
         "\"coordinates\":[[[0,0,0],[1,0,0],[0,1,0],[1,1,0]],[[0,0,5],[1,0,7],[0,1,5],[1,1,5]]],"                      \
         "\"triangles\":" triangles "}}"
#define BODY(turns, triangles)                                                                                         \
    "{\"type\":\"Feature\",\"temporalGeometry\":{\"type\":\"MovingPoint\",\"datetimes\":[0,9],\"coordinates\":[[0,0,"  \
    "9],"                                                                                                              \
    "[1,0,0]],\"turns\":" turns ",\"base\":{\"coordinates\":[[1,0,0],[0,1,0],[0,0,1]],\"triangles\":" triangles "}}}"

static void put(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static froe_motion *read_text(const char *text, froe_motion_report *report) {
    froe_motion *m = NULL;
    froe_diagnostic diag;
    put("scene.mfjson", text);
    froe_status status = froe_read_motion("scene.mfjson", NULL, &m, report, &diag);
    if (status) print_error("%s\n", diag.message);
    assert_int_equal(status, FROE_OK);
    return m;
}

/* What is in a file from some words on, up to a mark; valid until the next call. */
static const char *part_of_file(const char *path, const char *words, char end) {
    static char text[1 << 16];
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    assert_int_equal(fclose(file), 0);
    char *from = strstr(text, words), *to = from ? strchr(from + strlen(words), end) : NULL;
    assert_non_null(to);
    *to = 0;
    return from;
}

static void assert_refused(const char *text, froe_status status, const char *message) {
    froe_motion *m = NULL;
    froe_diagnostic diag;
    put("bad.mfjson", text);
    const froe_status found = froe_read_motion("bad.mfjson", NULL, &m, NULL, &diag);
    assert_string_equal(found ? diag.message : "read", message);
    assert_int_equal(found, status);
    assert_null(m);
}

/* ------------------------------------------------------------------ instants -- */

static void instants_are_milliseconds_since_1970(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double value;
    } good[] = {
        {"1970-01-01", 0},
        {"1970-01-01T00:00:01Z", 1000},
        {"2000-02-29T12:34:56Z", 951827696000},
        {"2000-03-01T00:00:00+01:00", 951865200000},
        {"2000-02-29T18:30:00-0430", 951865200000},
        {"2024-12-31T24:00:00Z", 1735689600000},
        {"1969-12-31T23:59:59.5Z", -500},
        {"2020-01-01T00:00:00.1234", 1577836800123.4},
        {"0001-01-01T00:00:00Z", -62135596800000},
        {"1970-01-01t01", 3600000}, /* minutes, seconds and zone may be missing */
        {"1970-01-01 00:02z", 120000},
        {"1970-01-01T02+01", 3600000},
        {"1970-01-01T02+0130", 1800000},
        {"1970-01-01T00:00:00,25", 250},
        {"1970-01-01T00:00:00.00012345678901234567890", 0.12345678901234}, /* 17 digits */
        {"1998-12-31T23:59:60Z", 915148800000},
        {"1970-12-31T24:00:00.00Z", 31536000000},
        {"1900-03-01", -2203891200000}, /* no leap year, as 2000 was */
        {"2004-02-29", 1078012800000},
        {"2001-02-28", 983318400000},
    };
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        double value = NAN;
        assert_true(formats_datetime(good[i].text, &value));
        if (value != good[i].value) fail_msg("%s is %.17g", good[i].text, value);
    }
}

static void what_is_no_instant_is_refused(void **state) {
    (void)state;
    static const char *const bad[] = {"",
                                      "2000",
                                      "2001-02-29",
                                      "2000-13-01",
                                      "2000-00-01",
                                      "2000-01-01T",
                                      "2000-01-01T25:00:00Z",
                                      "2000-01-01T00:61:00Z",
                                      "2000-01-01T00:00:00Zx",
                                      "2000-01-01 00:00:00+x",
                                      "2000/01/01",
                                      "2000-01",
                                      "2000-01-1",
                                      "2000-01-32",
                                      "2000-01-00",
                                      "0000-01-01",
                                      "2000-04-31",
                                      "1900-02-29",
                                      "2000-01-01x00:00",
                                      "2000-01-01T1",
                                      "2000-01-01T12:",
                                      "2000-01-01T12:0",
                                      "2000-01-01T12:00:",
                                      "2000-01-01T12:00:61",
                                      "2000-01-01T24:00:01",
                                      "2000-01-01T24:00:00.5",
                                      "2000-01-01T24:01",
                                      "2000-01-01T12!",
                                      "2000-01-01T12+",
                                      "2000-01-01T12+24",
                                      "2000-01-01T12+05:",
                                      "2000-01-01T12+05:6",
                                      "2000-01-01T12+05:60",
                                      "2000-01-01T12+05001"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        double value;
        assert_false(formats_datetime(bad[i], &value));
    }
}

static void assert_same_motion(const froe_motion *a, const froe_motion *b) {
    assert_int_equal(froe_motion_object_count(a), froe_motion_object_count(b));
    for (uint32_t i = 0; i < froe_motion_object_count(a); i++) {
        froe_moving_object p = froe_motion_object(a, i), q = froe_motion_object(b, i);
        assert_true(p.birth == q.birth && p.death == q.death);
        for (int k = 0; k < 3 && p.vertices[k] != FROE_NONE; k++) {
            size_t knots = froe_motion_knot_count(a, p.vertices[k]);
            assert_int_equal(knots, froe_motion_knot_count(b, q.vertices[k]));
            for (size_t j = 0; j < knots; j++) {
                froe_moving_knot x = froe_motion_knot(a, p.vertices[k], j), y = froe_motion_knot(b, q.vertices[k], j);
                assert_true(x.time == y.time && x.at[0] == y.at[0] && x.at[1] == y.at[1] && x.at[2] == y.at[2]);
                if (!isnan(x.control[0])) assert_memory_equal(x.control, y.control, sizeof x.control);
                assert_int_equal(isnan(x.second[0]), isnan(y.second[0]));
                if (!isnan(x.second[0])) assert_memory_equal(x.second, y.second, sizeof x.second);
            }
        }
    }
}

/* -------------------------------------------------------------------- reading -- */

static void lines_rings_and_points_become_segments(void **state) {
    (void)state;
    froe_motion_report report;
    froe_motion *m = read_text(
        "{\"type\":\"FeatureCollection\",\"crs\":{},\"features\":["
        "{\"type\":\"Feature\",\"id\":\"a\",\"temporalGeometry\":{\"type\":\"MovingPolygon\",\"datetimes\":[0,10],"
        "\"coordinates\":[[[[0,0],[1,0],[0,1],[0,0]]],[[[5,0],[6,0],[5,1],[5,0]]]]}},"
        "{\"type\":\"Feature\",\"properties\":{\"kind\":\"car\"},\"temporalGeometry\":{\"prisms\":["
        "{\"type\":\"MovingPoint\",\"datetimes\":[0,5,10],\"coordinates\":[[0.1,7,3],[1,7,3],[2,8,3]]},"
        "{\"type\":\"MovingLineString\",\"datetimes\":[2,8],\"interpolation\":\"Linear\","
        "\"coordinates\":[[[0,9],[1,9],[2,9]],[[0,8],[1,8],[2,8]]]}]}},"
        "{\"type\":\"Feature\",\"geometry\":null}]}",
        &report);
    assert_int_equal(froe_motion_object_count(m), 3 + 1 + 2);
    assert_int_equal(froe_motion_vertex_count(m), 3 + 1 + 3);
    assert_true(report.features == 2 && report.still == 1 && report.flattened == 1 && report.pieces == 3 + 2 + 3);
    froe_moving_object o = froe_motion_object(m, 2);
    assert_true(o.vertices[0] == 2 && o.vertices[1] == 0 && o.birth == 0 && o.death == 10);
    assert_string_equal(froe_motion_group(m, o.group).name, "a");
    o = froe_motion_object(m, 3);
    assert_true(o.vertices[0] == 3 && o.vertices[1] == 3 && o.tag == 1);
    assert_string_equal(froe_motion_group(m, o.group).name, "car");
    assert_true(froe_motion_knot(m, 3, 0).at[0] == 0.1);
    o = froe_motion_object(m, 5);
    assert_true(o.vertices[0] == 5 && o.vertices[1] == 6 && o.birth == 2 && o.death == 8);
    assert_true(froe_motion_window(m).begin == 0 && froe_motion_window(m).end == 10);
    froe_motion_free(m);
}

/* Three instants on the parabola y = x^2 give its control points; what follows has the same velocity. */
static void quadratic_interpolation_continues_its_velocity(void **state) {
    (void)state;
    froe_motion *m = read_text(LINE("[0,1,2,4]", "[[[0,0],[9,9]],[[1,1],[9,9]],[[2,4],[9,9]],[[4,4],[9,9]]]",
                                    ",\"interpolation\":\"Quadratic\""),
                               NULL);
    const double expected[3][2] = {{0.5, 0}, {1.5, 2}, {3, 8}};
    for (size_t i = 0; i < 3; i++)
        for (size_t k = 0; k < 2; k++) assert_true(froe_motion_knot(m, 0, i).control[k] == expected[i][k]);
    assert_true(froe_motion_knot(m, 1, 1).control[0] == 9);
    froe_motion_free(m);
    m = read_text(LINE("[0,4]", "[[[0,0],[9,9]],[[1,1],[9,9]]]",
                       ",\"interpolation\":\"Quadratic\",\"controls\":[[[0.1,7],[8,8]]]"),
                  NULL);
    assert_true(froe_motion_knot(m, 0, 0).control[0] == 0.1 && froe_motion_knot(m, 1, 0).control[1] == 8);
    froe_motion_free(m);
}

/* Instants on the parabola y = x^2 give that parabola, at all times. */
static void cubic_interpolation_takes_velocities_from_parabolas(void **state) {
    (void)state;
    const double y[] = {0, 1, 4, 16}, ends[] = {0, 1, 2, 4};
    double at[2];
    froe_motion *m = read_text(
        LINE("[0,1,2,4]", "[[[0,0],[9,9]],[[1,1],[9,9]],[[2,4],[9,9]],[[4,16],[9,9]]]", ",\"interpolation\":\"Cubic\""),
        NULL);
    for (size_t i = 0; i < 3; i++) {
        const froe_moving_knot knot = froe_motion_knot(m, 0, i);
        const double h = ends[i + 1] - ends[i];
        assert_true(fabs(knot.control[0] - (ends[i] + h / 3)) < 1e-15);
        assert_true(fabs(knot.control[1] - (y[i] + 2 * ends[i] * h / 3)) < 1e-14);
        assert_true(fabs(knot.second[1] - (y[i + 1] - 2 * ends[i + 1] * h / 3)) < 1e-14);
    }
    for (double time = 0; time <= 4; time += 0.125) {
        assert_true(froe_motion_position(m, 0, time, at));
        assert_true(fabs(at[0] - time) < 1e-14 && fabs(at[1] - time * time) < 1e-14);
    }
    assert_true(froe_motion_knot(m, 1, 1).second[0] == 9);
    froe_motion_free(m);
}

/* A cubic, a parabola and a straight piece at one time, in a line and in a ring, and in space. */
static void what_is_no_control_point_is_null(void **state) {
    (void)state;
    static const char *const files[] = {
        LINE("[0,4]", "[[[0,0],[9,9],[5,5]],[[1,1],[9,9],[7,5]]]",
             ",\"interpolation\":\"Cubic\",\"controls\":[[[0.1,7],[8,8],null]],"
             "\"secondControls\":[[[0.3,-2],null,null]]"),
        HEAD "{\"type\":\"Feature\",\"temporalGeometry\":{\"type\":\"MovingPolygon\",\"datetimes\":[0,4],"
             "\"coordinates\":[[[[0,0],[9,9],[5,5],[0,0]]],[[[1,1],[9,9],[7,5],[1,1]]]],\"interpolation\":\"Cubic\","
             "\"controls\":[[[[0.1,7],[8,8],null,[0.1,7]]]],\"secondControls\":[[[[0.3,-2],null,null,[0.3,-2]]]]}}]}",
        HEAD "{\"type\":\"Feature\",\"temporalGeometry\":{\"type\":\"MovingPointCloud\",\"datetimes\":[0,4],"
             "\"coordinates\":[[[0,0,1],[9,9,1],[5,5,1]],[[1,1,2],[9,9,2],[7,5,2]]],\"interpolation\":\"Cubic\","
             "\"controls\":[[[0.1,7,3],[8,8,3],null]],\"secondControls\":[[[0.3,-2,3],null,null]],"
             "\"triangles\":[[0,1,2]]}}]}"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        froe_motion *read = NULL, *m = read_text(files[i], NULL);
        const froe_moving_knot cubic = froe_motion_knot(m, 0, 0), parabola = froe_motion_knot(m, 1, 0);
        assert_true(cubic.control[0] == 0.1 && cubic.second[1] == -2);
        assert_true(parabola.control[0] == 8 && isnan(parabola.second[0]));
        assert_true(isnan(froe_motion_knot(m, 2, 0).control[0]) && isnan(froe_motion_knot(m, 0, 1).second[0]));
        assert_int_equal(froe_write_motion(m, "made.mfjson", NULL), FROE_OK);
        assert_int_equal(froe_read_motion("made.mfjson", NULL, &read, NULL, NULL), FROE_OK);
        assert_same_motion(m, read);
        assert_true(isnan(froe_motion_knot(read, 2, 0).control[0]));
        if (froe_motion_window(m).dim == 2) {
            assert_int_equal(froe_animate(m, NULL, 0, NULL, "cubic.svg", NULL), FROE_OK);
            assert_int_equal(froe_animate(m, NULL, 0, NULL, "cubic.html", NULL), FROE_OK);
            const char *way = part_of_file("cubic.svg", "class=\"way\" d=\"", '"');
            assert_true(strchr(way, 'C') && strchr(way, 'Q'));
            (void)part_of_file("cubic.html", "[0,0,0,0.1,7,0.3", ']');
        }
        froe_motion_free(m), froe_motion_free(read);
    }
}

/* Two triangles of a cloud, and a tetrahedron's side that a body carries. */
static void triangles_move_in_space(void **state) {
    (void)state;
    froe_motion_report report;
    froe_motion *m =
        read_text(CLOUD("[[0,1,2],[2,1,3]]") "," BODY("[[0,0,0,1],[0.6,0,0,0.8]]", "[[0,1,2]]") "]}", &report);
    assert_int_equal(froe_motion_window(m).dim, 3);
    assert_true(froe_motion_object_count(m) == 3 && froe_motion_vertex_count(m) == 7 && report.flattened == 0);
    assert_true(froe_motion_object(m, 1).vertices[2] == 3 && froe_motion_object(m, 2).vertices[0] == 4);
    assert_true(froe_motion_knot(m, 1, 1).at[2] == 7 && froe_motion_vertex_body(m, 3) == FROE_NONE);
    assert_true(froe_motion_vertex_body(m, 4) == 0 && froe_motion_body_knot(m, 0, 1).turn[0] == 0.6);
    double at[3];
    assert_true(froe_motion_position(m, 4, 9, at) && at[0] == 2);
    froe_motion_free(m);
}

static void what_is_wrong_in_space_is_said_with_the_feature(void **state) {
    (void)state;
    assert_refused(CLOUD("[[0,1,2]]") "," LINE("[0,1]", "[[[0,0],[1,1]],[[0,0],[1,1]]]", "") "]}", FROE_E_INPUT,
                   "bad.mfjson: feature 1: It moves in the plane, and those before it do not.");
    assert_refused(CLOUD("[[0,1,4]]") "]}", FROE_E_INPUT,
                   "bad.mfjson: feature 0: Triangle 0 has a corner 4 of 4 points.");
    assert_refused(CLOUD("[[0,1]]") "]}", FROE_E_FORMAT,
                   "bad.mfjson: feature 0: Triangle 0 is no array of three numbers.");
    assert_refused(CLOUD("[[0,1,1]]") "]}", FROE_E_INPUT,
                   "bad.mfjson: feature 0: triangle 0: Two of its corners are the vertex 1.");
    assert_refused(CLOUD("[]") "]}", FROE_E_INPUT, "bad.mfjson: feature 0: There are no triangles.");
    assert_refused(HEAD BODY("[[0,0,0,1]]", "[[0,1,2]]") "]}", FROE_E_FORMAT,
                   "bad.mfjson: feature 0: There are 1 turns for 2 instants.");
    assert_refused(HEAD BODY("[[0,0,0,1],[0,0,1]]", "[[0,1,2]]") "]}", FROE_E_FORMAT,
                   "bad.mfjson: feature 0: Turn 1 is no array of four numbers.");
    assert_refused(HEAD BODY("[[0,0,0,1],[0,0,0,0]]", "[[0,1,2]]") "]}", FROE_E_INPUT,
                   "bad.mfjson: feature 0: body 0: The quaternion of turn 1, 0 0 0 0, has not the length 1.");
}

static void bodies_of_the_plane_turn_on_circles(void **state) {
    (void)state;
#define HAND(type, turns, segments)                                                                                    \
    "{\"type\":\"Feature\",\"temporalGeometry\":{\"type\":\"" type                                                     \
    "\",\"datetimes\":[0,2],\"coordinates\":[[0,0],[0,0]],"                                                            \
    "\"turns\":" turns ",\"base\":{\"coordinates\":[[1,0],[5,0],[5,1]],\"segments\":" segments "}}}"
    froe_motion *m = read_text(HAND("MovingPoint", "[[0,1],[0.6,0.8]]", "[[0,1],[1,2]]"), NULL);
    assert_true(froe_motion_window(m).dim == 2 && froe_motion_object_count(m) == 2 && froe_motion_body_count(m) == 1);
    assert_int_equal(froe_motion_vertex_count(m), 3);
    double at[2];
    assert_true(froe_motion_position(m, 1, 2, at));
    assert_true(fabs(at[0] - 1.4) < 1e-15 && fabs(at[1] - 4.8) < 1e-15); /* by twice the angle of 3, 4 and 5 */
    froe_motion_free(m);
    assert_refused(HAND("MovingPoint", "[[0,0,0,1],[0,0,0,1]]", "[[0,1]]"), FROE_E_FORMAT,
                   "bad.mfjson: feature 0: Turn 0 is no array of two numbers.");
    assert_refused(HAND("MovingPoint", "[[0,1],[0,1]]", "[[0,3]]"), FROE_E_INPUT,
                   "bad.mfjson: feature 0: Segment 0 has an end 3 of 3 points.");
    assert_refused(HAND("MovingPoint", "[[0,1],[0,1]]", "[[0,1,2]]"), FROE_E_FORMAT,
                   "bad.mfjson: feature 0: Segment 0 is no array of two numbers.");
    assert_refused(HAND("MovingPoint", "[[0,1],[0,1]]", "[]"), FROE_E_INPUT,
                   "bad.mfjson: feature 0: There are no segments.");
    assert_refused(HAND("MovingPolygon", "[[0,1],[0,1]]", "[[0,1]]"), FROE_E_FORMAT,
                   "bad.mfjson: feature 0: It has a base with segments, and is no MovingPoint.");
}

/* The standard's base, a file of a model, says how a point looks; one with coordinates would be a body. */
static void a_base_without_triangles_is_no_point(void **state) {
    (void)state;
#define POINT(base)                                                                                                    \
    "{\"type\":\"Feature\",\"temporalGeometry\":{\"type\":\"MovingPoint\",\"datetimes\":[0,1],"                        \
    "\"coordinates\":[[0,0],[1,1]]" base "}}"
    assert_refused(POINT(",\"base\":{\"coordinates\":[[0,0,0],[1,0,0],[0,1,0]]}"), FROE_E_FORMAT,
                   "bad.mfjson: feature 0: Its base has coordinates, but neither triangles nor segments.");
    assert_refused(POINT(",\"turns\":[[0,0,0,1],[0,0,0,1]]"), FROE_E_FORMAT,
                   "bad.mfjson: feature 0: It has turns, but no base with triangles or segments.");
    froe_motion *m = read_text(POINT(",\"base\":{\"type\":\"glTF\",\"href\":\"car.gltf\"}"), NULL);
    assert_true(froe_motion_window(m).dim == 2 && froe_motion_object_count(m) == 1);
    froe_motion_free(m);
}

static void what_is_wrong_is_said_with_the_feature(void **state) {
    (void)state;
    assert_refused("{", FROE_E_FORMAT, "bad.mfjson: line 1: JSON needs a string or '}' near the end of the file.");
    assert_refused("{}", FROE_E_FORMAT, "bad.mfjson: The file is neither a Feature nor a FeatureCollection.");
    assert_refused("{\"features\":[]}", FROE_E_INPUT, "bad.mfjson: Nothing in the file moves.");
    assert_refused(LINE("[]", "[]", ""), FROE_E_FORMAT, "bad.mfjson: feature 0: Datetimes are missing.");
    assert_refused(LINE("[0,\"noon\"]", "[[[0,0],[1,1]],[[0,0],[1,1]]]", ""), FROE_E_FORMAT,
                   "bad.mfjson: feature 0: Datetime 1 is neither a number nor an ISO 8601 instant.");
    assert_refused(LINE("[0,1]", "[[[0,0],[1,1]]]", ""), FROE_E_FORMAT,
                   "bad.mfjson: feature 0: There are 1 geometries for 2 instants.");
    assert_refused(LINE("[0,1]", "[[[0,0],[1,1]],[[0,0],[1,1],[2,2]]]", ""), FROE_E_INPUT,
                   "bad.mfjson: feature 0: At instant 1 it has not as many points as at instant 0.");
    assert_refused(LINE("[0,1]", "[[[0,0],[1,\"x\"]],[[0,0],[1,1]]]", ""), FROE_E_FORMAT,
                   "bad.mfjson: feature 0: At instant 0 a coordinate is not a number.");
    assert_refused(LINE("[0,2,2]", "[[[0,0],[1,1]],[[0,0],[1,1]],[[0,0],[1,1]]]", ""), FROE_E_INPUT,
                   "bad.mfjson: feature 0: vertex 0: Time 2, 2, is not after time 1, 2.");
    assert_refused(LINE("[2,2]", "[[[0,0],[1,1]],[[0,0],[1,1]]]", ""), FROE_E_INPUT,
                   "bad.mfjson: All of the file is at one instant, 2.");
    assert_refused(LINE("[0,1]", "[[[0,0],[1,1]],[[0,0],[1,1]]]", ",\"interpolation\":\"Step\""), FROE_E_UNSUPPORTED,
                   "bad.mfjson: feature 0: There is no interpolation 'Step'. There are: Linear, Quadratic, Cubic.");
    assert_refused(LINE("[0,1]", "[[[0,0],[1,1]],[[0,0],[1,1]]]", ",\"interpolation\":\"Quadratic\""), FROE_E_INPUT,
                   "bad.mfjson: feature 0: Quadratic interpolation needs three instants.");
    assert_refused(LINE("[0,1]", "[[[0,0],[1,1]],[[0,0],[1,1]]]", ",\"interpolation\":\"Cubic\""), FROE_E_INPUT,
                   "bad.mfjson: feature 0: Cubic interpolation needs three instants.");
    assert_refused(
        LINE("[0,1]", "[[[0,0],[1,1]],[[0,0],[1,1]]]", ",\"interpolation\":\"Cubic\",\"controls\":[[[0,0],[1,1]]]"),
        FROE_E_FORMAT, "bad.mfjson: feature 0: There are 0 second controls for 2 instants.");
    assert_refused(LINE("[0,1]", "[[[0,0],[1,1]],[[0,0],[1,1]]]",
                        ",\"interpolation\":\"Cubic\",\"controls\":[[[0,0],null]],"
                        "\"secondControls\":[[[0,0],[1,1]]]"),
                   FROE_E_INPUT, "bad.mfjson: feature 0: vertex 1: It has a second control point 0, and no first.");
    assert_refused(
        LINE("[0,1]", "[[[0,0],[1,1]],[[0,0],[1,1]]]", ",\"interpolation\":\"Quadratic\",\"controls\":[[[0,0],null]]"),
        FROE_E_FORMAT, "bad.mfjson: feature 0: At instant 0 a position is no array of two numbers.");
    assert_refused(
        HAND("MovingPoint\",\"interpolation\":\"Cubic\",\"controls\":[[1,1]],\"secondControls\":[[1,1]],\"x\":\"",
             "[[0,1],[0,1]]", "[[2,0]]"),
        FROE_E_UNSUPPORTED,
        "bad.mfjson: feature 0: It is a body, which does not fly along cubics. There are: Linear, "
        "Quadratic.");
    assert_refused("{\"type\":\"Feature\",\"temporalGeometry\":{\"type\":\"MovingPolygon\",\"datetimes\":[0,1],"
                   "\"coordinates\":[[[[0,0],[1,1],[2,0]]],[]]}}",
                   FROE_E_INPUT,
                   "bad.mfjson: feature 0: At instant 0 a ring is not closed, or has less than three corners.");
    assert_refused("{\"type\":\"Feature\",\"temporalGeometry\":{\"type\":\"MovingSolid\"}}", FROE_E_UNSUPPORTED,
                   "bad.mfjson: feature 0: There is no moving geometry of type 'MovingSolid'.");
    froe_motion *m = NULL;
    assert_int_equal(froe_read_motion("missing.mfjson", NULL, &m, NULL, NULL), FROE_E_IO);
}

/* What a feature is called: by its properties, its id, or its first property that is a string. */
static void a_feature_has_the_name_that_says_most(void **state) {
    (void)state;
    static const char *const cases[][2] = {
        {"\"id\":\"i\",\"properties\":{\"label\":\"l\",\"title\":\"t\"}", "t"},
        {"\"id\":\"i\",\"properties\":{\"label\":7}", "i"},
        {"\"id\":7,\"properties\":{\"a\":[1,2],\"b\":\"b\",\"c\":\"c\"}", "b"},
        {"\"id\":7,\"properties\":{\"id\":\"8\"}", "8"},
        {"\"id\":-7,\"properties\":{\"a\":{\"b\":\"c\"}}", "-7"},
        {"\"id\":7.5,\"properties\":null", "0"},
        {"\"id\":7e3", "0"},
        {"\"id\":100000000000000000000000000000000000000", "0"},
        {"\"properties\":[\"a\"]", "0"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[400];
        snprintf(text, sizeof text,
                 "{\"type\":\"Feature\",%s,\"temporalGeometry\":{\"type\":\"MovingPoint\",\"datetimes\":[0,1],"
                 "\"interpolations\":[\"Linear\"],\"coordinates\":[[0,0],[1,1]]}}",
                 cases[i][0]);
        froe_motion *m = read_text(text, NULL);
        assert_string_equal(froe_motion_group(m, froe_motion_object(m, 0).group).name, cases[i][1]);
        froe_motion_free(m);
    }
}

#define GEOMETRY(type, more)                                                                                           \
    "{\"type\":\"Feature\",\"temporalGeometry\":{\"type\":\"Moving" type                                               \
    "\",\"datetimes\":[0,1],\"coordinates\":" more "}}"

static void geometries_that_are_none_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *text;
        froe_status status;
        const char *message;
    } cases[] = {
        {GEOMETRY("LineString", "[[],[]]"), FROE_E_INPUT, "feature 0: At instant 0 there is no geometry."},
        {GEOMETRY("Polygon", "[[[[0,0],[1,0],[1,1],[0,1]]],[]]"), FROE_E_INPUT,
         "feature 0: At instant 0 a ring is not closed, or has less than three corners."},
        {GEOMETRY("Polygon", "[[[[0,0],[1,0],[1,1],[0,0,0]]],[]]"), FROE_E_INPUT,
         "feature 0: At instant 0 a ring is not closed, or has less than three corners."},
        {GEOMETRY("Polygon", "[[[[0,0],[1,0],[1,1],[0,[0]]]],[]]"), FROE_E_INPUT,
         "feature 0: At instant 0 a ring is not closed, or has less than three corners."},
        {GEOMETRY("Polygon", "[[[[0,0],[1,0],[1,1],[0,null]]],[]]"), FROE_E_INPUT,
         "feature 0: At instant 0 a ring is not closed, or has less than three corners."},
        {GEOMETRY("Polygon", "[[[1,2,3,1]],[]]"), FROE_E_FORMAT,
         "feature 0: At instant 0 a position is no array of two numbers."},
        {GEOMETRY("Polygon", "[[[[0,0],[1,0],[1,1],[0,0]]],[[[0,0],[1,0],[1,1],[0,0]],[[0,0],[1,0],[1,1],[0,0]]]]"),
         FROE_E_INPUT, "feature 0: At instant 1 it has not as many points as at instant 0."},
        {GEOMETRY("LineString", "[[[0,0],[1,1]],[[0,0],[1,1],[2,2],[3,3],[4,4]]]"), FROE_E_INPUT,
         "feature 0: At instant 1 it has not as many points as at instant 0."},
        {GEOMETRY("PointCloud", "[[[0,0]],[[0,0]]],\"triangles\":[[0,0,0]]"), FROE_E_FORMAT,
         "feature 0: At instant 0 a position is no array of three numbers."},
        {CLOUD("[[0,1,-1]]") "]}", FROE_E_INPUT, "feature 0: Triangle 0 has a corner -1 of 4 points."},
        {CLOUD("[[0,1,2],[0,1,0.5]]") "]}", FROE_E_INPUT, "feature 0: Triangle 1 has a corner 0.5 of 4 points."},
        {CLOUD("[[0,1,\"2\"]]") "]}", FROE_E_FORMAT, "feature 0: Triangle 0 is no array of three numbers."},
        {HEAD BODY("[[0,0,0,1],[0,0,\"0\",1]]", "[[0,1,2]]") "]}", FROE_E_FORMAT,
         "feature 0: Turn 1 is no array of four numbers."},
        {"{\"type\":\"Feature\",\"temporalGeometry\":{\"type\":\"MovingPoint\",\"datetimes\":[0,1],\"coordinates\":"
         "[[0,0],[1,1]],\"base\":{\"coordinates\":[[0,0],[1]],\"segments\":[[0,1]]}}}",
         FROE_E_FORMAT, "feature 0: At instant 0 a position is no array of two numbers."},
        {HEAD LINE("[0,1]", "[[[0,0],[1,1]],[[0,0],[1,1]]]", "") "," BODY("[[0,0,0,1],[0,0,0,1]]", "[[0,1,2]]") "]}",
         FROE_E_INPUT, "feature 1: It moves in space, and those before it do not."},
        {"{\"type\":\"Feature\",\"temporalGeometry\":{\"datetimes\":[0,1]}}", FROE_E_FORMAT,
         "feature 0: Its moving geometry has no type."},
        {"{\"type\":\"Feature\",\"temporalGeometry\":{\"prisms\":[{\"type\":\"MovingPoint\",\"datetimes\":[0,1],"
         "\"coordinates\":[[0,0],[1,1]]},{\"type\":\"MovingPoint\"},{\"type\":\"MovingPoint\",\"datetimes\":[\"x\"]}]}"
         "}",
         FROE_E_FORMAT, "feature 0: Datetimes are missing."},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char message[200];
        snprintf(message, sizeof message, "bad.mfjson: %s", cases[i].message);
        assert_refused(cases[i].text, cases[i].status, message);
    }
}

static void a_byte_order_mark_is_passed_over(void **state) {
    (void)state;
    froe_motion *m = read_text("\xEF\xBB\xBF" LINE("[0,1]", "[[[0,0],[1,1]],[[0,0],[1,1]]]", ""), NULL);
    assert_int_equal(froe_motion_object_count(m), 1);
    froe_motion_free(m);
    assert_refused("\xEF\xBB\xBF", FROE_E_FORMAT, "bad.mfjson: line 1: JSON needs a value near the end of the file.");
}

static void a_window_has_to_reach_into_the_file(void **state) {
    (void)state;
    static const struct {
        double from, to;
        froe_status status;
        const char *message;
    } cases[] = {
        {5, 6, FROE_E_INPUT, "late.mfjson: Nothing is there from 5 to 6, for all is from 0 to 1."},
        {-6, -5, FROE_E_INPUT, "late.mfjson: Nothing is there from -6 to -5, for all is from 0 to 1."},
        {0.75, 0.25, FROE_E_INPUT, "late.mfjson: The window 0.75 .. 0.25 is empty"},
        {1, INFINITY, FROE_E_INPUT, "late.mfjson: The window 1 .. inf is empty"},
    };
    put("late.mfjson", LINE("[0,1]", "[[[0,0],[1,1]],[[0,0],[1,1]]]", ""));
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_motion *m = NULL;
        froe_diagnostic diag;
        froe_motion_read_options o = froe_motion_read_defaults();
        o.from = cases[i].from, o.to = cases[i].to;
        const froe_status status = froe_read_motion("late.mfjson", &o, &m, NULL, &diag);
        if (status != cases[i].status || strncmp(diag.message, cases[i].message, strlen(cases[i].message)))
            fail_msg("%d: %s", status, diag.message);
    }
    froe_motion *m = NULL;
    froe_motion_read_options o = froe_motion_read_defaults();
    assert_int_equal(froe_read_motion(NULL, NULL, &m, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_read_motion("late.mfjson", NULL, NULL, NULL, NULL), FROE_E_ARG);
    o.size--;
    assert_int_equal(froe_read_motion("late.mfjson", &o, &m, NULL, NULL), FROE_E_OPTIONS);
    assert_null(m);
}

/* -------------------------------------------------------------------- writing -- */

static void assert_same_bodies(const froe_motion *a, const froe_motion *b) {
    assert_int_equal(froe_motion_body_count(a), froe_motion_body_count(b));
    for (uint32_t v = 0; v < froe_motion_vertex_count(a); v++)
        assert_int_equal(froe_motion_vertex_body(a, v), froe_motion_vertex_body(b, v));
    for (uint32_t i = 0; i < froe_motion_body_count(a); i++) {
        assert_int_equal(froe_motion_body_knot_count(a, i), froe_motion_body_knot_count(b, i));
        for (size_t k = 0; k < froe_motion_body_knot_count(a, i); k++) {
            const froe_body_knot x = froe_motion_body_knot(a, i, k), y = froe_motion_body_knot(b, i, k);
            assert_true(x.time == y.time && !memcmp(x.at, y.at, sizeof x.at) && !memcmp(x.turn, y.turn, sizeof x.turn));
            if (!isnan(x.control[0])) assert_memory_equal(x.control, y.control, sizeof x.control);
        }
    }
}

static void every_kind_of_motion_survives_a_file(void **state) {
    (void)state;
    const froe_motion_generator_info *g;
    for (size_t i = 0; (g = froe_motion_generator_at(i)) != NULL; i++) {
        froe_motion *made = NULL, *again = NULL, *read = NULL;
        assert_int_equal(froe_generate_motion(g->name, 40, 7, NULL, &made, NULL), FROE_OK);
        assert_int_equal(froe_generate_motion(g->name, 40, 7, NULL, &again, NULL), FROE_OK);
        assert_same_motion(made, again);
        assert_in_range(froe_motion_object_count(made), 40, 51);
        assert_int_equal(froe_write_motion(made, "made.mfjson", NULL), FROE_OK);
        assert_int_equal(froe_read_motion("made.mfjson", NULL, &read, NULL, NULL), FROE_OK);
        assert_same_motion(made, read);
        assert_same_bodies(made, read);
        assert_int_equal(froe_motion_vertex_count(made), froe_motion_vertex_count(read));
        froe_motion_free(made);
        froe_motion_free(again);
        froe_motion_free(read);
    }
    froe_motion *m = NULL;
    assert_int_equal(froe_generate_motion("walking", 40, 7, NULL, &m, NULL), FROE_E_OPTIONS);
    assert_int_equal(froe_generate_motion("moving", 0, 7, NULL, &m, NULL), FROE_E_ARG);
}

/* Among lines that move by themselves; without a turn, and on a parabola. */
static void bodies_of_the_plane_survive_a_file(void **state) {
    (void)state;
#define MOVING_LINE                                                                                                    \
    ",\n{\"type\":\"Feature\",\"temporalGeometry\":{\"type\":\"MovingLineString\",\"datetimes\":[0,2],"                \
    "\"coordinates\":[[[3,4],[9,4],[9,5]],[[3,4],[9,4],[9,6]]]}}"
    froe_motion *read = NULL,
                *m = read_text(HEAD HAND("MovingPoint", "[[0,1],[0.6,0.8]]", "[[0,1],[1,2]]") MOVING_LINE
                               "," HAND("MovingPoint\",\"interpolation\":\"Quadratic\",\"controls\":[[1,1]],\"x\":\"",
                                        "[[0,1],[0,1]]", "[[2,0]]") "]}",
                               NULL);
    assert_int_equal(froe_motion_object_count(m), 5);
    assert_int_equal(froe_write_motion(m, "made.mfjson", NULL), FROE_OK);
    assert_int_equal(froe_read_motion("made.mfjson", NULL, &read, NULL, NULL), FROE_OK);
    assert_int_equal(froe_motion_vertex_count(read), 8); /* one corner is of no segment */
    assert_int_equal(froe_motion_body_count(read), 2);
    for (uint32_t i = 0; i < 5; i++)
        for (int e = 0; e < 2; e++)
            for (double time = 0; time <= 2; time += 0.37) {
                double p[2], q[2];
                assert_true(froe_motion_position(m, froe_motion_object(m, i).vertices[e], time, p));
                assert_true(froe_motion_position(read, froe_motion_object(read, i).vertices[e], time, q));
                assert_memory_equal(p, q, sizeof p);
            }
    assert_int_equal(froe_animate(m, NULL, 0, NULL, "hand.svg", NULL), FROE_OK);
    assert_int_equal(froe_animate(m, NULL, 0, NULL, "hand.html", NULL), FROE_OK);
    froe_motion_free(m), froe_motion_free(read);
}

static void real_cars_are_read_unrounded(void **state) {
    (void)state;
    froe_motion *m = NULL;
    froe_motion_report report;
    assert_int_equal(froe_read_motion(FROE_TEST_DATA "/cars-bologna.mfjson", NULL, &m, &report, NULL), FROE_OK);
    assert_int_equal(froe_motion_object_count(m), 548);
    assert_int_equal(report.pieces, 2 * 15012);
    assert_true(froe_motion_window(m).begin == 300000 && froe_motion_window(m).end == 330000);
    froe_moving_knot k = froe_motion_knot(m, 1, 1);
    assert_true(k.time == 301000 && k.at[0] == 695.607 && k.at[1] == 975.696);
    assert_string_equal(froe_motion_group(m, froe_motion_object(m, 0).group).name, "Audinot_12_1");
    froe_motion_free(m);
}

static froe_status read_motion_with(void *user, const froe_allocator *alloc) {
    froe_motion_read_options o = froe_motion_read_defaults();
    o.alloc = alloc;
    froe_motion *m = NULL;
    froe_status status = froe_read_motion(user, &o, &m, NULL, NULL);
    froe_motion_free(m);
    return status;
}

static froe_status write_some_events(void *user, const froe_allocator *alloc) {
    const size_t *count = user;
    froe_event_writer *writer;
    froe_diagnostic why;
    froe_status status = froe_event_writer_new("some.csv", alloc, &writer, &why);
    if (status) return status;
    froe_event event = {.kind = FROE_EVENT_CONTACT, .tick = 1, .early = 0.1, .late = 0.25, .object_count = 2};
    for (size_t i = 0; i < *count; i++) {
        event.objects[0] = (uint32_t)i, event.objects[1] = 7;
        assert_true(froe_event_writer_put(writer, &event));
    }
    return froe_event_writer_close(writer, FROE_OK, &why);
}

static size_t lines_of(const char *path, char *last, int size) {
    FILE *file = fopen(path, "r");
    size_t lines = 0;
    assert_non_null(file);
    while (fgets(last, size, file)) lines++;
    fclose(file);
    return lines;
}

static void events_are_a_file_when_all_are_there(void **state) {
    (void)state;
    char line[200];
    for (size_t count = 0; count < 3000; count += 511) {
        assert_int_equal(write_some_events(&count, NULL), FROE_OK);
        assert_int_equal(lines_of("some.csv", line, sizeof line), count + 1);
    }
    assert_string_equal(line, "1,0.1,0.25,contact,2,2554,7,,\n");
    froe_event_writer *writer;
    froe_diagnostic why;
    assert_int_equal(froe_event_writer_new("some.csv", NULL, &writer, &why), FROE_OK);
    assert_int_equal(froe_event_writer_close(writer, FROE_E_CANCELLED, &why), FROE_E_CANCELLED);
    assert_int_equal(lines_of("some.csv", line, sizeof line), 2556); /* what was there before */
    assert_int_equal(froe_event_writer_new("some.txt", NULL, &writer, &why), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_event_writer_close(NULL, FROE_OK, &why), FROE_OK);
    size_t few = 3;
    assert_true(test_memory_each(write_some_events, &few) >= 1);
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    froe_motion *m = NULL;
    assert_int_equal(froe_generate_motion("moving-spin", 3, 1, NULL, &m, NULL), FROE_OK);
    assert_int_equal(froe_write_motion(m, "few.mfjson", NULL), FROE_OK);
    froe_motion_free(m);
    assert_true(test_memory_each(read_motion_with, (char[]){"few.mfjson"}) > 10);
    static const char *const texts[] = {
        HEAD GEOMETRY("Polygon",
                      "[[[[0,0],[1,0],[1,1],[0,0]]],[[[0,0],[1,0],[1,1],[0,0]]]],\"interpolation\":"
                      "\"Cubic\",\"controls\":[[[[0,0],[1,0],[1,1],[0,0]]]],"
                      "\"secondControls\":[[[[0,0],[1,0],[1,1],[0,0]]]]") "," GEOMETRY("Point", "[[0,0],[1,1]]") "]}",
        HAND("MovingPoint\",\"interpolation\":\"Quadratic\",\"controls\":[[1,1]],\"x\":\"", "[[0,1],[0.6,0.8]]",
             "[[2,0]]"),
        CLOUD("[[0,1,2],[2,1,3]]") "," BODY("[[0,0,0,1],[0.6,0,0,0.8]]", "[[0,1,2]]") "]}",
        LINE("[0,1,2]", "[[[0,0],[1,1]],[[0,0],[1,1]],[[1,0],[1,1]]]", ",\"interpolation\":\"Quadratic\""),
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        put("few.mfjson", texts[i]);
        assert_true(test_memory_each(read_motion_with, (char[]){"few.mfjson"}) > 10);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(instants_are_milliseconds_since_1970),
        cmocka_unit_test(what_is_no_instant_is_refused),
        cmocka_unit_test(lines_rings_and_points_become_segments),
        cmocka_unit_test(quadratic_interpolation_continues_its_velocity),
        cmocka_unit_test(cubic_interpolation_takes_velocities_from_parabolas),
        cmocka_unit_test(what_is_no_control_point_is_null),
        cmocka_unit_test(triangles_move_in_space),
        cmocka_unit_test(what_is_wrong_in_space_is_said_with_the_feature),
        cmocka_unit_test(bodies_of_the_plane_turn_on_circles),
        cmocka_unit_test(a_base_without_triangles_is_no_point),
        cmocka_unit_test(what_is_wrong_is_said_with_the_feature),
        cmocka_unit_test(a_feature_has_the_name_that_says_most),
        cmocka_unit_test(geometries_that_are_none_are_refused),
        cmocka_unit_test(a_byte_order_mark_is_passed_over),
        cmocka_unit_test(a_window_has_to_reach_into_the_file),
        cmocka_unit_test(every_kind_of_motion_survives_a_file),
        cmocka_unit_test(bodies_of_the_plane_survive_a_file),
        cmocka_unit_test(real_cars_are_read_unrounded),
        cmocka_unit_test(events_are_a_file_when_all_are_there),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
