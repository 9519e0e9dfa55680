/* ASE, of 3ds Max: lists that are not as long as was counted, and corners that do not exist. */
#include "support.h"

static const char whole[] =
    "*3DSMAX_ASCIIEXPORT\t200\n*GEOMOBJECT {\n*NODE_NAME \"a\"\n*MESH {\n"
    "*MESH_NUMVERTEX 3\n*MESH_NUMFACES 1\n*MESH_VERTEX_LIST {\n"
    "*MESH_VERTEX 0\t0.0 0.0 0.0\n*MESH_VERTEX 1 1.0 0.0 0.0\n*MESH_VERTEX 2 0.0 1.5 0.0\n}\n"
    "*MESH_FACE_LIST {\n*MESH_FACE 0:  A:  0 B: 1 C:\t2 AB: 1 BC: 1 CA: 10\n}\n"
    "*MESH_NUMTVERTEX 2\n*MESH_TVERTLIST {\n*MESH_TVERT 0 0.0 0.0 0.0\n*MESH_TVERT 1 1.0 0.0 0.0\n}\n"
    "*MESH_NUMTVFACES 1\n*MESH_TFACELIST {\n*MESH_TFACE 0 0 1 1\n}\n"
    "*MESH_NUMCVERTEX 1\n*MESH_CVERTLIST {\n*MESH_VERTCOL 0 1.0 0.0 0.0\n}\n"
    "*MESH_NUMCVFACES 1\n*MESH_CFACELIST {\n*MESH_CFACE 0 0 0 0\n}\n"
    "}\n}\n*GEOMOBJECT {\n*NODE_NAME \"b\"\n*MESH {\n*MESH_NUMVERTEX 3\n*MESH_NUMFACES 1\n"
    "*MESH_VERTEX_LIST {\n*MESH_VERTEX 0 0.0 0.0 1.0\n*MESH_VERTEX 1 1.0 0.0 1.0\n"
    "*MESH_VERTEX 2 0.0 1.5 1.0\n}\n*MESH_FACE_LIST {\n*MESH_FACE 0: A: 0 B: 1 C: 2\n}\n}\n}\n";

enum { MOST = sizeof whole + 256 };

static void write_changed(const char *path, const char *word, const char *other) {
    char text[MOST];
    const char *at = strstr(whole, word);
    assert_non_null(at);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - whole), whole, other, at + strlen(word));
    write_text(path, text);
}

static void what_does_not_fit_is_refused(void **state) {
    (void)state;
    static const char corner[] = "A face names a vertex that does not exist.",
                      broken[] = "A face is not three corners.",
                      order[] = "Vertices and faces are not numbered from 0 on.",
                      points[] = "The mesh has fewer vertices than it counts.",
                      faces[] = "The mesh has another number of faces than it counts.";
    static const struct {
        const char *word, *other;
        int line; /* 0: as assimp has it */
        const char *sentence;
    } changes[] = {
        {"A:  0", "A: 3", 13, corner},
        {"B: 1", "B: 3", 13, corner},
        {"C:\t2", "C:\t99999999999999999999", 13, corner},
        {"B: 1", "B: -1", 13, broken},
        {"B: 1", "B:", 13, broken},
        {"B: 1", "D: 1", 13, broken},
        {"B: 1", "AB: 1", 13, broken},
        {"B: 1", "B 1", 13, broken},
        {"B: 1", "c: 1", 13, broken},
        {"*MESH_FACE 0:", "*MESH_FACE 1:", 13, order},
        {"*MESH_FACE 0:", "*MESH_FACE :", 13, order},
        {"*MESH_VERTEX 1", "*MESH_VERTEX 2", 9, order},
        {"*MESH_VERTEX 1", "*MESH_VERTEX x", 9, order},
        {"*MESH_NUMVERTEX 3", "*MESH_NUMVERTEX 2", 13, corner},
        {"*MESH_NUMVERTEX 3", "*MESH_NUMVERTEX 4", 36, points},
        {"*MESH_VERTEX 2 0.0 1.5 0.0\n}", "}", 35, points},
        {"*MESH_NUMFACES 1", "*MESH_NUMFACES 2", 36, faces},
        {"*MESH_VERTEX 2 0.0 1.5 1.0\n", "", 48, points},
        {"B: 1 C: 2\n", "B: 1 C: 2\n*MESH_FACE 1: A: 0 B: 1 C: 2\n", 50, faces},
        {"0 0 1 1", "0 0 1 2", 22, corner},
        {"0 0 1 1", "0 0 1", 22, broken},
        {"0 0 1 1", "1 0 1 1", 22, order},
        {"0 0 0 0", "0 0 1 0", 30, corner},
        {"*MESH_TFACE 0 0 1 1\n", "", 35, faces},
        {"*MESH_CFACE 0 0 0 0\n", "", 35, faces},
        {"*MESH_NUMCVERTEX", "*MESH_MAPPINGCHANNEL 2 {\n*MESH_NUMTVERTEX 1\n}\n*MESH_NUMCVERTEX", 39, faces},
        {"*MESH_TFACE 0 0 1 1\n}\n", "}\n*MESH_NUMTVERTEX 1\n", 23, faces},
        {"1 1.0 0.0 0.0", "1 1.0 0.0", 0, "Unable to parse float: unexpected EOL"},
        {"*MESH_NUMTVERTEX", "*MESH_ANIMATION {\n}\n*MESH_NUMTVERTEX", 0, "Found *MESH_ANIMATION element"},
    };
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        char sentence[160];
        snprintf(sentence, sizeof sentence, "changed.ase: line %d: %s", changes[i].line, changes[i].sentence);
        write_changed("changed.ase", changes[i].word, changes[i].other);
        refuse("changed.ase", FROE_E_FORMAT, changes[i].line ? sentence : changes[i].sentence);
    }
}

static void what_fits_is_read(void **state) {
    (void)state;
    static const char *const changes[][2] = {
        {"A:  0", "A:  0"},
        {"0:  A", "0  A"},
        /* where there are none, none are taken */
        {"*MESH_NUMTVERTEX 2\n*MESH_TVERTLIST {\n*MESH_TVERT 0 0.0 0.0 0.0\n*MESH_TVERT 1 1.0 0.0 0.0\n}\n", ""},
        {"*MESH_NUMCVERTEX 1\n*MESH_CVERTLIST {\n*MESH_VERTCOL 0 1.0 0.0 0.0\n}\n", ""},
    };
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        write_changed("fits.ask", changes[i][0], changes[i][1]);
        froe_scene *scene = read_scene("fits.ask", NULL);
        assert_int_equal(froe_scene_object_count(scene), 2);
        froe_scene_free(scene);
    }
}

/* assimp takes the zeros in it for ends. */
static void text_of_two_bytes_a_letter_is_refused(void **state) {
    (void)state;
    char wide[2 * sizeof whole + 2] = "\xff\xfe";
    for (size_t i = 0; i < sizeof whole - 1; i++) wide[2 + 2 * i] = whole[i];
    write_bytes("wide.ase", wide, 2 * sizeof whole);
    refuse("wide.ase", FROE_E_FORMAT, "The text is in UTF-16");
}

static void every_failing_allocation_gives_a_status(void **state) {
    (void)state;
    write_text("whole.ase", whole);
    test_memory_each(read_with_memory, "whole.ase");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_does_not_fit_is_refused),
        cmocka_unit_test(what_fits_is_read),
        cmocka_unit_test(text_of_two_bytes_a_letter_is_refused),
        cmocka_unit_test(every_failing_allocation_gives_a_status),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
