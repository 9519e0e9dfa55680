/* AC3D: counts that do not fit, corners that are not there, and moves that assimp does not apply. */
#include "support.h"

/* A quadrilateral, a triangle and a line that share four vertices, and a kid of the world behind them. */
static const char whole[] = "AC3Db\nMATERIAL \"\" rgb 1 1 1  amb 1 1 1  emis 0 0 0  spec 0 0 0  shi 0  trans 0\n"
                            "OBJECT world\nkids 2\nOBJECT poly\nname \"a\"\n"
                            "loc 0 0 0\nrot 1 0 0 0 1 0 0 0 1\n"
                            "numvert 4\n0 0 0\n1 0 0\n1 1 0\n0 +1 -0\nnumsurf 3\n"
                            "SURF 0x0\nmat 0\nrefs 4\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n"
                            "SURF 0x0\nmat 0\nrefs 3\n0 0 0\n1 1 0\n2 1 1\n"
                            "SURF 0x2\nmat 0\nrefs 2\n0 0 0\n2 1 1\n"
                            "kids 0\nOBJECT poly\nnumvert 1\n5 5 5\nkids 0\n";

enum { MOST = sizeof whole + 256 };

static void write_changed(const char *path, const char *word, const char *other) {
    char text[MOST];
    const char *at = strstr(whole, word);
    assert_non_null(at);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - whole), whole, other, at + strlen(word));
    write_text(path, text);
}

static void what_assimp_takes_for_something_else_is_refused(void **state) {
    (void)state;
    static const char fewer[] = "There are fewer lines of numbers than were counted.",
                      more[] = "There are more lines of numbers than were counted.",
                      no_count[] = "A count is no whole number.",
                      no_vertex[] = "A surface names a vertex that does not exist.",
                      moved[] = "Objects that are moved (loc) and turned (rot), or have lines or kids, are not read.";
    static const struct {
        const char *word, *other;
        froe_status status;
        int line;
        const char *sentence;
    } changes[] = {
        {"refs 4", "refs -1", FROE_E_FORMAT, 17, no_count},
        {"refs 4", "refs", FROE_E_FORMAT, 17, no_count},
        {"refs 4", "refs 4.5", FROE_E_FORMAT, 17, no_count},
        {"refs 4", "refs 5", FROE_E_FORMAT, 22, fewer},
        {"refs 4", "refs 3", FROE_E_FORMAT, 21, more},
        {"refs 4", "refs 99999999999999999999", FROE_E_FORMAT, 17, no_count},
        {"\n3 0 1", "\n4 0 1", FROE_E_FORMAT, 21, no_vertex},
        {"\n3 0 1", "\n-1 0 1", FROE_E_FORMAT, 21, no_vertex},
        {"\n3 0 1", "\n3.0 0 1", FROE_E_FORMAT, 21, no_vertex},
        {"\n3 0 1", "\n+3 0 1", FROE_E_FORMAT, 21, no_vertex},
        {"numvert 4", "numvert 3", FROE_E_FORMAT, 13, more},
        {"numvert 4", "numvert 5", FROE_E_FORMAT, 14, fewer},
        {"numvert 4", "numvert x", FROE_E_FORMAT, 9, no_count},
        {"numsurf 3", "numsurf 2", FROE_E_FORMAT, 30, "There are more surfaces than were counted."},
        {"numsurf 3", "numsurf 4", FROE_E_FORMAT, 33, "There are fewer surfaces than were counted."},
        {"kids 2", "kids 3", FROE_E_FORMAT, 37, "The file ends before all is there that was counted."},
        {"5 5 5\nkids 0\n", "", FROE_E_FORMAT, 35, "The file ends before all is there that was counted."},
        {"2 1 1\nkids 0\nOBJECT poly\nnumvert 1\n5 5 5\nkids 0\n", "", FROE_E_FORMAT, 31,
         "The file ends before all is there that was counted."},
        {"name", "data two\n", FROE_E_FORMAT, 6, no_count},
        {"loc 0 0 0", "loc 0 0 1", FROE_E_UNSUPPORTED, 33, moved},
        {"loc 0 0 0\nrot 1 0 0 0 1 0 0 0 1", "loc 3 0 0\nrot 0 1 0 -1 0 0 0 0 1", FROE_E_UNSUPPORTED, 33, moved},
    };
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        char sentence[160];
        snprintf(sentence, sizeof sentence, "changed.ac: line %d: %s", changes[i].line, changes[i].sentence);
        write_changed("changed.ac", changes[i].word, changes[i].other);
        refuse("changed.ac", changes[i].status, sentence);
    }
    write_changed("changed.ac", "mat 0", "mat 1");
    refuse("changed.ac", FROE_E_FORMAT, "AC3D: material index is out of range");
}

static void expect_objects(const char *path, size_t count) {
    froe_scene *scene = read_scene(path, NULL);
    if (froe_scene_object_count(scene) != count) fail_msg("%s: %zu", path, froe_scene_object_count(scene));
    froe_scene_free(scene);
}

/* Nothing is counted behind it. */
static void roots_may_be_cut_off(void **state) {
    (void)state;
    static const char begin[] = "AC3Db\nMATERIAL \"\" rgb 1 1 1  amb 1 1 1  emis 0 0 0  spec 0 0 0  shi 0  trans 0\n"
                                "OBJECT poly\nnumvert 3\n0 0 0\n1 0 0\n";
    static const char *const ends[] = {"", "0 1 0\nnumsurf 1\nSURF 0x0\nmat 0\nrefs 3\n0 0 0\n1 0 0\n"};
    for (size_t i = 0; i < 2; i++) {
        char text[sizeof begin + 64];
        snprintf(text, sizeof text, "%s%s", begin, ends[i]);
        write_text("cut.ac", text);
        refuse("cut.ac", FROE_E_FORMAT, "The file ends before all is there that was counted.");
    }
}

static void what_fits_is_read(void **state) {
    (void)state;
    static const struct {
        const char *word, *other;
        size_t objects;
    } changes[] = {
        {"AC3Db", "AC3Db", 4},
        {"name \"a\"", "data 14\n7 letters \n4 5", 4}, /* bytes of any text */
        {"name \"a\"", "data 500\n", 0},
        {"numvert 4\n", "numvert 4 \n ", 4},
        {"name", "locked\nname", 4},
        {"5 5 5\nkids 0\n", "5 5 5\nkids 0\n  ", 4},
        {"SURF 0x0\nmat 0\nrefs 3", "SURF 0x2\nmat 0\nrefs 3", 5},
        {"0 0 0\nrot", "0 0 0\r\nrot", 4},
        {"SURF 0x0", "SURF 0x10", 4},
        {"SURF 0x2", "SURF 0x1", 5},
        {"SURF 0x0\nmat 0\nrefs 4", "SURF 0x4\nmat 0\nrefs 4", 4}, /* a strip */
        {"kids 2\nOBJECT poly", "kids 1\nOBJECT poly", 4},         /* and another root */
    };
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        write_changed("fits.ac", changes[i].word, changes[i].other);
        if (changes[i].objects)
            expect_objects("fits.ac", changes[i].objects);
        else
            refuse("fits.ac", FROE_E_FORMAT, "The file ends before all is there");
    }
}

/* The same triangle in an object of which one thing is changed. */
static void write_moved(const char *kind, const char *at, const char *surface, const char *kids) {
    char text[MOST];
    snprintf(text, sizeof text,
             "AC3Db\nMATERIAL \"\" rgb 1 1 1  amb 1 1 1  emis 0 0 0  spec 0 0 0  shi 0  trans 0\nOBJECT %s\n%s"
             "numvert 3\n0 0 0\n1 0 0\n0 1 0\n%s%s",
             kind, at, surface, kids);
    write_text("moved.ac", text);
}

static void what_is_moved_in_one_way_is_read(void **state) {
    (void)state;
    static const char triangle[] = "numsurf 1\nSURF 0x0\nmat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\n",
                      line[] = "numsurf 1\nSURF 0x2\nmat 0\nrefs 2\n0 0 0\n1 0 0\n",
                      kid[] = "kids 1\nOBJECT poly\nkids 0\n";
    static const struct {
        const char *at, *surface, *kids;
        double x; /* of the first corner; -1: refused */
    } cases[] = {
        {"loc 2 0 0\n", triangle, "kids 0\n", 2},
        {"rot 0 1 0 -1 0 0 0 0 1\n", triangle, "kids 0\n", 0},
        {"loc 0 0 0\n", line, "kids 0\n", 0},
        {"loc 0 0 0\n", triangle, kid, 0},
        {"loc 2 0 0\n", line, "kids 0\n", -1},
        {"loc 2 0 0\n", triangle, kid, -1},
        {"loc 2 0 0\nrot 0 1 0 -1 0 0 0 0 1\n", triangle, "kids 0\n", -1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_moved("poly", cases[i].at, cases[i].surface, cases[i].kids);
        if (cases[i].x < 0) {
            refuse("moved.ac", FROE_E_UNSUPPORTED,
                   "Objects that are moved (loc) and turned (rot), or have lines or kids");
            continue;
        }
        froe_scene *scene = read_scene("moved.ac", NULL);
        if (corner(scene, 0, 0)[0] != cases[i].x) fail_msg("%zu: %g", i, corner(scene, 0, 0)[0]);
        froe_scene_free(scene);
    }
}

/* Points that are in no surface are told of; only their kids are moved. */
static void points_alone_are_left_out(void **state) {
    (void)state;
    static const char *const surfaces[] = {"", "numsurf 1\nSURF 0x2\nmat 0\nrefs 0\n"};
    for (size_t i = 0; i < 2; i++) {
        froe_read_report report;
        write_moved("group", "loc 2 0 0\n", surfaces[i],
                    "kids 1\nOBJECT poly\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x0\nmat 0\n"
                    "refs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n");
        froe_scene *scene = read_scene("moved.ac", &report);
        assert_true(froe_scene_object_count(scene) == 1 && corner(scene, 0, 0)[0] == 2);
        assert_string_equal(report.sorts_left, "points");
        froe_scene_free(scene);
    }
}

static void every_failing_allocation_gives_a_status(void **state) {
    (void)state;
    write_text("whole.ac", whole);
    test_memory_each(read_with_memory, "whole.ac");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_assimp_takes_for_something_else_is_refused),
        cmocka_unit_test(roots_may_be_cut_off),
        cmocka_unit_test(what_fits_is_read),
        cmocka_unit_test(what_is_moved_in_one_way_is_read),
        cmocka_unit_test(points_alone_are_left_out),
        cmocka_unit_test(every_failing_allocation_gives_a_status),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
