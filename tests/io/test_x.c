/* DirectX files as text, whose faces name vertices or materials that do not exist. */
#include "support.h"

/* Two triangles of a mesh that is called as a type is, in a frame that is so, too. */
static const char whole[] =
    "xof 0302txt 0032\n"
    "template Mesh {\n <3D82AB44-62DA-11cf-AB39-0020AF71E433>\n DWORD nVertices;\n array Vector "
    "vertices[nVertices];\n}\n"
    "Frame Mesh { // Mesh {\n"
    " FrameTransformMatrix { 1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0;; }\n"
    " Mesh Mesh {\n"
    "  4;\n  0.0;0.0;0.0;,\n  1.0;0.0;-0.0;,\n  0.5;1.0;.0;,\n  1.0;1.0;0.0;;\n"
    "  2;\n  3;0,1,2;,\n  3;1,3,2;;\n"
    "  MeshMaterialList {\n   2;\n   2;\n   0,\n   1;;\n"
    "   Material M { 1.0;0.0;0.0;1.0;; 5.0; 0.0;0.0;0.0;; 0.0;0.0;0.0;; TextureFilename { \"a Mesh {.png\"; } }\n"
    "   { Other }\n  }\n }\n}\n"
    "# Mesh {\n"
    "Material Other { 1.0;1.0;0.0;1.0;; 5.0; 0.0;0.0;0.0;; 0.0;0.0;0.0;; }\n";

enum { MOST = sizeof whole + 256 };

static void write_changed(const char *path, const char *word, const char *other) {
    char text[MOST];
    const char *at = strstr(whole, word);
    assert_non_null(at);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - whole), whole, other, at + strlen(word));
    write_text(path, text);
}

static void what_assimp_leaves_out_is_refused(void **state) {
    (void)state;
    static const char vertex[] = "A face names a vertex that does not exist.",
                      material[] = "A face names a material that does not exist.";
    static const struct {
        const char *word, *other;
        int line;
        const char *sentence;
    } changes[] = {
        {"1,3,2;;", "1,4,2;;", 17, vertex},   {"1,3,2;;", "1,5,2;;", 17, vertex},
        {"1,3,2;;", "1,-3,2;;", 17, vertex},  {"1,3,2;;", "1,99999999999999999999,2;;", 17, vertex},
        {"   1;;", "   2;;", 25, material},   {"   1;;", "   -1;;", 25, material},
        {"   { Other }\n", "", 24, material},
    };
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        char sentence[120];
        snprintf(sentence, sizeof sentence, "changed.x: line %d: %s", changes[i].line, changes[i].sentence);
        write_changed("changed.x", changes[i].word, changes[i].other);
        refuse("changed.x", FROE_E_FORMAT, sentence);
    }
}

static void what_is_right_is_read(void **state) {
    (void)state;
    static const char *const changes[][2] = {
        {"Frame", "Frame"},
        {" Mesh Mesh {", " Mesh {"},
        {" Mesh Mesh {", " Mesh // {\n # {\n {"},
        {"   2;\n   2;\n   0,\n   1;;\n", "   2;\n   1;\n   1;;\n"}, /* one for all faces */
        {"   { Other }\n", "   { Other } { Other }\n"},
        {"# Mesh {\n", "{ Mesh }\n"},
    };
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        write_changed("right.x", changes[i][0], changes[i][1]);
        froe_scene *scene = read_scene("right.x", NULL);
        if (froe_scene_object_count(scene) != 2) fail_msg("%s", changes[i][1]);
        froe_scene_free(scene);
    }
}

/* What is cut off, or no number, assimp refuses by itself; what it takes all the same is not looked at. */
static void what_is_not_as_expected_is_left_to_assimp(void **state) {
    (void)state;
    static const char *const cuts[] = {"nVertices", "Mesh Mesh {",      "Mesh {\n  4;", "4;\n",
                                       "0.0;-0.0",  "2;\n  3;",         "3;0,1",        "0,1,2",
                                       "1,2;,",     "MeshMaterialList", "{\n   2;",     "2;\n   2;\n   0",
                                       "0,\n   1",  "   Material",      "M { 1.0"};
    static const char *const words[][2] = {{" Mesh Mesh {", " Mesh Mesh Mesh {"},
                                           {"  4;", "  x;"},
                                           {"  1.0;0.0;-0.0;", "  1.0;x;-0.0;"},
                                           {"  2;\n  3;", "  x;\n  3;"},
                                           {"  3;0,1,2", "  x;0,1,2"},
                                           {"  3;0,1,2", "  3;0,x,2"},
                                           {"List {\n   2;", "List x x\n   2;"},
                                           {"List {\n   2;", "List {\n   x;"},
                                           {"   0,\n", "   x,\n"}};
    char text[MOST];
    for (size_t i = 0; i < sizeof cuts / sizeof *cuts; i++) {
        const char *at = strstr(whole, cuts[i]);
        assert_non_null(at);
        snprintf(text, sizeof text, "%.*s", (int)(at - whole), whole);
        write_text("cut.x", text);
        refuse("cut.x", FROE_E_FORMAT, "The reader assimp reports '");
    }
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        write_changed("words.x", words[i][0], words[i][1]);
        refuse("words.x", FROE_E_FORMAT, "The reader assimp reports '");
    }
    write_changed("binary.x", "txt", "bin");
    refuse("binary.x", FROE_E_FORMAT, "The reader assimp reports 'No root node'.");
}

static void meshes_may_have_no_faces(void **state) {
    (void)state;
    write_text("none.x", "xof 0302txt 0032\nMesh { 1; 0;0;0;; 0; MeshMaterialList { 0; 0; } }\n"
                         "Mesh { 3; 0;0;0;, 1;0;0;, 0;1;0;; 1; 3;0,1,2;; }\n");
    froe_scene *scene = read_scene("none.x", NULL);
    assert_int_equal(froe_scene_object_count(scene), 1);
    froe_scene_free(scene);
}

static void every_failing_allocation_gives_a_status(void **state) {
    (void)state;
    write_text("whole.x", whole);
    test_memory_each(read_with_memory, "whole.x");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_assimp_leaves_out_is_refused),         cmocka_unit_test(what_is_right_is_read),
        cmocka_unit_test(what_is_not_as_expected_is_left_to_assimp), cmocka_unit_test(meshes_may_have_no_faces),
        cmocka_unit_test(every_failing_allocation_gives_a_status),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
