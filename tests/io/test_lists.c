/* Models as text with lists that do not fit, or name what does not exist: AC3D, ASE (of 3ds Max) and DirectX; and maps
 * with lists of what are no places: KML, GPX and GML. */
#include "support.h"
#include <cpl_vsi.h>

/* ------------------------------------------------------------------------ AC3D -- */

/* A quadrilateral, a triangle and a line that share four vertices, and a kid of the world behind them. */
static const char ac_whole[] = "AC3Db\nMATERIAL \"\" rgb 1 1 1  amb 1 1 1  emis 0 0 0  spec 0 0 0  shi 0  trans 0\n"
                               "OBJECT world\nkids 2\nOBJECT poly\nname \"a\"\n"
                               "loc 0 0 0\nrot 1 0 0 0 1 0 0 0 1\n"
                               "numvert 4\n0 0 0\n1 0 0\n1 1 0\n0 +1 -0\nnumsurf 3\n"
                               "SURF 0x0\nmat 0\nrefs 4\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n"
                               "SURF 0x0\nmat 0\nrefs 3\n0 0 0\n1 1 0\n2 1 1\n"
                               "SURF 0x2\nmat 0\nrefs 2\n0 0 0\n2 1 1\n"
                               "kids 0\nOBJECT poly\nnumvert 1\n5 5 5\nkids 0\n";

enum { AC_MOST = sizeof ac_whole + 256 };

static void write_ac_changed(const char *path, const char *word, const char *other) {
    char text[AC_MOST];
    const char *at = strstr(ac_whole, word);
    assert_non_null(at);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - ac_whole), ac_whole, other, at + strlen(word));
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
        write_ac_changed("changed.ac", changes[i].word, changes[i].other);
        refuse("changed.ac", changes[i].status, sentence);
    }
    write_ac_changed("changed.ac", "mat 0", "mat 1");
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

static void what_fits_in_ac_is_read(void **state) {
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
        write_ac_changed("fits.ac", changes[i].word, changes[i].other);
        if (changes[i].objects)
            expect_objects("fits.ac", changes[i].objects);
        else
            refuse("fits.ac", FROE_E_FORMAT, "The file ends before all is there");
    }
}

/* The same triangle in an object of which one thing is changed. */
static void write_moved(const char *kind, const char *at, const char *surface, const char *kids) {
    char text[AC_MOST];
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

static void memory_may_end_in_ac(void **state) {
    (void)state;
    write_text("whole.ac", ac_whole);
    test_memory_each(read_with_memory, "whole.ac");
}

/* ------------------------------------------------------------------------- ASE -- */

static const char ase_whole[] =
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

enum { ASE_MOST = sizeof ase_whole + 256 };

static void write_ase_changed(const char *path, const char *word, const char *other) {
    char text[ASE_MOST];
    const char *at = strstr(ase_whole, word);
    assert_non_null(at);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - ase_whole), ase_whole, other, at + strlen(word));
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
        write_ase_changed("changed.ase", changes[i].word, changes[i].other);
        refuse("changed.ase", FROE_E_FORMAT, changes[i].line ? sentence : changes[i].sentence);
    }
}

static void what_fits_in_ase_is_read(void **state) {
    (void)state;
    static const char *const changes[][2] = {
        {"A:  0", "A:  0"},
        {"0:  A", "0  A"},
        /* where there are none, none are taken */
        {"*MESH_NUMTVERTEX 2\n*MESH_TVERTLIST {\n*MESH_TVERT 0 0.0 0.0 0.0\n*MESH_TVERT 1 1.0 0.0 0.0\n}\n", ""},
        {"*MESH_NUMCVERTEX 1\n*MESH_CVERTLIST {\n*MESH_VERTCOL 0 1.0 0.0 0.0\n}\n", ""},
    };
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        write_ase_changed("fits.ask", changes[i][0], changes[i][1]);
        froe_scene *scene = read_scene("fits.ask", NULL);
        assert_int_equal(froe_scene_object_count(scene), 2);
        froe_scene_free(scene);
    }
}

/* assimp takes the zeros in it for ends. */
/* assimp makes a body of a skeleton where there is nothing. */
static void what_has_no_objects_is_refused(void **state) {
    (void)state;
    static const char *const texts[] = {"hello, this is another file\n", "*3DSMAX_ASCIIEXPORT 200\n*SCENE {\n}\n"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        write_text("nothing.ase", texts[i]);
        refuse("nothing.ase", FROE_E_INPUT, "nothing.ase: The file holds no objects.");
    }
}

static void text_of_two_bytes_a_letter_is_refused(void **state) {
    (void)state;
    char wide[2 * sizeof ase_whole + 2] = "\xff\xfe";
    for (size_t i = 0; i < sizeof ase_whole - 1; i++) wide[2 + 2 * i] = ase_whole[i];
    write_bytes("wide.ase", wide, 2 * sizeof ase_whole);
    refuse("wide.ase", FROE_E_FORMAT, "The text is in UTF-16");
}

static void memory_may_end_in_ase(void **state) {
    (void)state;
    write_text("whole.ase", ase_whole);
    test_memory_each(read_with_memory, "whole.ase");
}

/* --------------------------------------------------------------------- DirectX -- */

/* Two triangles of a mesh that is called as a type is, in a frame that is so, too. */
static const char x_whole[] =
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

enum { X_MOST = sizeof x_whole + 256 };

static void write_x_changed(const char *path, const char *word, const char *other) {
    char text[X_MOST];
    const char *at = strstr(x_whole, word);
    assert_non_null(at);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - x_whole), x_whole, other, at + strlen(word));
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
        {"1,3,2;;", "1,4,2;;", 17, vertex},
        {"1,3,2;;", "1,5,2;;", 17, vertex},
        {"1,3,2;;", "1,-3,2;;", 17, vertex},
        {"1,3,2;;", "1,99999999999999999999,2;;", 17, vertex},
        {"   1;;", "   2;;", 25, material},
        {"   1;;", "   -1;;", 25, material},
        {"   { Other }\n", "", 24, material},
        {"  4;\n", "  4000000000;\n", 10, "The file is shorter than the counts of a mesh say."},
        {"  2;\n  3;", "  4000000000;\n  3;", 15, "The file is shorter than the counts of a mesh say."},
    };
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        char sentence[120];
        snprintf(sentence, sizeof sentence, "changed.x: line %d: %s", changes[i].line, changes[i].sentence);
        write_x_changed("changed.x", changes[i].word, changes[i].other);
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
        write_x_changed("right.x", changes[i][0], changes[i][1]);
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
    char text[X_MOST];
    for (size_t i = 0; i < sizeof cuts / sizeof *cuts; i++) {
        const char *at = strstr(x_whole, cuts[i]);
        assert_non_null(at);
        snprintf(text, sizeof text, "%.*s", (int)(at - x_whole), x_whole);
        write_text("cut.x", text);
        refuse("cut.x", FROE_E_FORMAT,
               strcmp(cuts[i], "0,1,2") != 0 ? "The reader assimp reports '"
                                             : "The file is shorter than the counts of a mesh say.");
    }
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        write_x_changed("words.x", words[i][0], words[i][1]);
        refuse("words.x", FROE_E_FORMAT, "The reader assimp reports '");
    }
    write_x_changed("binary.x", "txt", "bin");
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

/* Tokens of a binary file: numbers of 2 bytes, with the lowest first; then 4 bytes for a count, and for each item. */
typedef struct x_bytes {
    char at[1024];
    size_t count;
} x_bytes;

static void put_number(x_bytes *b, size_t bytes, uint64_t number) {
    for (; bytes--; number >>= 8) b->at[b->count++] = (char)(number & 255);
}

static void put_letters(x_bytes *b, size_t token, const char *letters) {
    put_number(b, 2, token), put_number(b, 4, strlen(letters));
    memcpy(b->at + b->count, letters, strlen(letters));
    b->count += strlen(letters);
}

static void put_name(x_bytes *b, const char *name) {
    put_letters(b, 1, name);
}

static void put_whole(x_bytes *b, const uint32_t *items, size_t count) {
    put_number(b, 2, 6), put_number(b, 4, count);
    for (size_t i = 0; i < count; i++) put_number(b, 4, items[i]);
}

static void put_reals(x_bytes *b, const double *items, size_t count, size_t bytes) {
    put_number(b, 2, 7), put_number(b, 4, count);
    for (size_t i = 0; i < count; i++) {
        const float single = (float)items[i];
        memcpy(b->at + b->count, bytes == 8 ? (const void *)(items + i) : (const void *)&single, bytes);
        b->count += bytes;
    }
}

enum { X_BEGIN = 10, X_END = 11, X_SEMICOLON = 20, X_TEMPLATE = 31, X_DWORD = 41 };

/* Two triangles of four vertices, with materials, behind a template, a text and a name; with other numbers in their
 * places. */
static void write_binary_x(const char *path, size_t real, uint32_t vertices, uint32_t corner, uint32_t material) {
    static const double places[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, colours[11] = {1, 1, 1, 1};
    const uint32_t faces[] = {2, 3, 0, 1, 2, 3, 1, corner, 2}, materials[] = {2, 2, 0, material};
    x_bytes b = {.count = 0};
    b.count = (size_t)sprintf(b.at, "xof 0303bin %s", real == 8 ? "0064" : "0032");
    put_number(&b, 2, X_TEMPLATE), put_name(&b, "Mesh"), put_number(&b, 2, X_BEGIN);
    put_number(&b, 2, 5), put_number(&b, 8, 7), put_number(&b, 8, 7); /* an identifier */
    put_number(&b, 2, X_DWORD), put_name(&b, "nVertices"), put_number(&b, 2, X_SEMICOLON), put_number(&b, 2, X_END);
    put_name(&b, "Note"), put_number(&b, 2, X_BEGIN), put_letters(&b, 2, "{ in two words");
    put_number(&b, 2, X_SEMICOLON), put_number(&b, 2, X_END);
    put_name(&b, "Mesh"), put_name(&b, "Mesh"), put_number(&b, 2, X_BEGIN);
    put_number(&b, 2, 3), put_number(&b, 4, vertices); /* a whole number alone */
    put_reals(&b, places, sizeof places / sizeof *places, real);
    put_whole(&b, faces, sizeof faces / sizeof *faces);
    put_name(&b, "MeshMaterialList"), put_number(&b, 2, X_BEGIN);
    put_whole(&b, materials, sizeof materials / sizeof *materials);
    for (int i = 0; i < 2; i++) {
        put_name(&b, "Material"), put_number(&b, 2, X_BEGIN);
        put_reals(&b, colours, sizeof colours / sizeof *colours, real);
        put_number(&b, 2, X_END);
    }
    put_number(&b, 2, X_END), put_number(&b, 2, X_END);
    write_bytes(path, b.at, b.count);
}

static void binary_files_are_looked_through(void **state) {
    (void)state;
    static const char vertex[] = "A face names a vertex that does not exist.",
                      material[] = "A face names a material that does not exist.",
                      shorter[] = "The file is shorter than the counts of a mesh say.";
    for (size_t real = 4; real <= 8; real += 4) {
        write_binary_x("good.x", real, 4, 3, 1);
        froe_scene *scene = read_scene("good.x", NULL);
        assert_int_equal(froe_scene_object_count(scene), 2);
        assert_true(corner(scene, 1, 1)[0] == 1 && corner(scene, 1, 1)[1] == 1);
        froe_scene_free(scene);
        assert_true(test_memory_each(read_with_memory, "good.x") > 5);
        write_binary_x("bad.x", real, 4, 4, 1);
        refuse("bad.x", FROE_E_FORMAT, vertex);
        write_binary_x("bad.x", real, 4, 900000, 1);
        refuse("bad.x", FROE_E_FORMAT, vertex);
        write_binary_x("bad.x", real, 4, 3, 2);
        refuse("bad.x", FROE_E_FORMAT, material);
        write_binary_x("bad.x", real, 4000000000u, 3, 1);
        refuse("bad.x", FROE_E_FORMAT, shorter);
        write_binary_x("bad.x", real, 3, 3, 1); /* the count of faces is a coordinate */
        refuse("bad.x", FROE_E_FORMAT, real == 4 ? shorter : "");
    }
    for (size_t length = 16; length < 300; length++) { /* cut off anywhere */
        char bytes[1024];
        write_binary_x("good.x", 4, 4, 3, 1);
        FILE *in = fopen("good.x", "rb");
        assert_non_null(in);
        const size_t whole = fread(bytes, 1, sizeof bytes, in);
        fclose(in);
        if (length >= whole) break;
        write_bytes("cut.x", bytes, length);
        froe_scene *scene = NULL;
        froe_diagnostic why = {0};
        const froe_status status = froe_read("cut.x", NULL, &scene, NULL, &why);
        assert_true(status == FROE_E_FORMAT || status == FROE_E_INPUT || (!status && length > 200));
        froe_scene_free(scene);
    }
}

static void memory_may_end_in_x(void **state) {
    (void)state;
    write_text("whole.x", x_whole);
    test_memory_each(read_with_memory, "whole.x");
}

/* ------------------------------------------------------------------------- KML -- */

#define KML(parts)                                                                                                     \
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\" "                       \
    "xmlns:gx=\"http://www.google.com/kml/ext/2.2\"><Document>\n" parts "</Document></kml>\n"
#define LINE(coordinates) "<Placemark><LineString><coordinates>" coordinates "</coordinates></LineString></Placemark>\n"
#define TRACK(parts) "<Placemark><gx:Track>" parts "</gx:Track></Placemark>\n"
#define AT(place) "<when>2020-01-01T00:00:00Z</when><gx:coord>" place "</gx:coord>"

/* GDAL would make other places of them, or end the program. */
static void places_of_kml_are_numbers(void **state) {
    (void)state;
    static const char *const bad[] = {
        "1,2 3,x",  "1 2",      "1,2;3,4", "1,5,2,25 3,4", "1,5,2,25,0", "1.5\xc2\xb0,2 3,4",
        "1,,2 3,4", "1,2, 3,4", "1",       "1,2,3,4,5,6",  "1,2.3.4 5,6"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char text[600];
        snprintf(text, sizeof text, KML(LINE("0,0 1,1") LINE("%s")), bad[i]);
        write_text("bad.kml", text);
        refuse("bad.kml", FROE_E_FORMAT, "bad.kml: line 4: A place is not two or three numbers with decimal points.");
    }
    static const char *const tracks[] = {AT("1 2 3") AT(""),  AT("1 x") AT("1 2"),     AT("1,2,3") AT("1 2"),
                                         AT("1") AT("1 2"),   AT("1 2 3 4") AT("1 2"), AT(" 1 2") AT("1 2"),
                                         AT("1  2") AT("1 2")};
    for (size_t i = 0; i < sizeof tracks / sizeof *tracks; i++) {
        char text[600];
        snprintf(text, sizeof text, KML(TRACK("%s")), tracks[i]);
        write_text("bad.kml", text);
        refuse("bad.kml", FROE_E_FORMAT,
               "bad.kml: line 3: A place of a track is not two or three numbers with one blank between them.");
    }
    write_text("bad.kml", KML(TRACK(AT("1 2 3") "<gx:coord>3 4 5</gx:coord>")));
    refuse("bad.kml", FROE_E_FORMAT, "bad.kml: line 3: A track has more places (gx:coord) than times (when).");
    write_text("bad.kml", KML("<Folder>"));
    refuse("bad.kml", FROE_E_FORMAT, "bad.kml: line 3: The text is not well-formed XML.");
}

static void what_places_of_kml_may_be_is_read(void **state) {
    (void)state;
    static const char *const good[] = {
        LINE("1,2 3,4"),
        LINE("\n 1,2,0\n\t+3.,.4e1,7 "),
        LINE("1,2,nan, 3,4,-5, "),
        LINE("1, 2, 0 3 ,4 , 0"),
        LINE("<![CDATA[1,2 3,4]]>"),
        LINE("") LINE("1,2 3,4"),
        TRACK(AT("1 2 3") AT("\n3 4 \n") "<when/>"),
        TRACK("") LINE("1,2 3,4"),
    };
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        char text[600];
        snprintf(text, sizeof text, KML("%s"), good[i]);
        write_text("good.kml", text);
        froe_scene *scene = read_scene("good.kml", NULL);
        assert_int_equal(froe_scene_object_count(scene), 1);
        for (int k = 0; k < 2; k++)
            assert_true(corner(scene, 0, k)[0] == 1 + 2 * k && corner(scene, 0, k)[1] == 2 + 2 * k);
        froe_scene_free(scene);
    }
    assert_true(test_memory_each(read_with_memory, "good.kml") > 5);
    froe_read_report report;
    write_text("linked.kml", KML("<NetworkLink><Link><href>other.kml</href></Link></NetworkLink>" LINE("1,2 3,4")));
    froe_scene_free(read_scene("linked.kml", &report));
    assert_string_equal(report.sorts_left, "NetworkLink");
}

static void write_kmz(const char *path, const char *text) {
    char inside[64];
    snprintf(inside, sizeof inside, "/vsizip/{%s}/doc.kml", path);
    remove(path);
    VSILFILE *file = VSIFOpenL(inside, "wb");
    assert_non_null(file);
    assert_int_equal(VSIFWriteL(text, 1, strlen(text), file), strlen(text));
    assert_int_equal(VSIFCloseL(file), 0);
}

static void places_in_archives_of_kml_are_numbers(void **state) {
    (void)state;
    write_kmz("good.kmz", KML(LINE("1,2 3,4")));
    froe_scene_free(read_scene("good.kmz", NULL));
    assert_true(test_memory_each(read_with_memory, "good.kmz") > 5);
    write_kmz("bad.kmz", KML(LINE("1,2 3,x")));
    refuse("bad.kmz", FROE_E_FORMAT, "line 3: A place is not two or three numbers with decimal points.");
}

/* ------------------------------------------------------------------------- GPX -- */

static void places_of_gpx_are_numbers(void **state) {
    (void)state;
    static const char head[] =
        "<?xml version=\"1.0\"?>\n<gpx version=\"1.1\" xmlns=\"http://www.topografix.com/GPX/1/1\">\n";
    static const char *const bad[] = {
        "lat='48,5' lon='11.5'", "lat='48.5' lon='11,5'", "lat='48.5'", "lon='11.5'", "lat='' lon='11.5'",
        "lat='N48' lon='11.5'",  "lat='48.5N' lon='11.5'"};
    static const char *const forms[] = {"<wpt %s/>", "<rte><rtept lat='1' lon='2'/>\n<rtept %s/></rte>",
                                        "<trk><trkseg><trkpt lat='1' lon='2'/><trkpt %s/></trkseg></trk>"};
    char text[400], part[300];
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        const size_t form = i % 3;
        snprintf(part, sizeof part, forms[form], bad[i]);
        snprintf(text, sizeof text, "%s%s</gpx>", head, part);
        write_text("bad.gpx", text);
        refuse("bad.gpx", FROE_E_FORMAT,
               form == 1 ? "bad.gpx: line 4: A place has no lat and lon that are numbers with decimal points."
                         : "bad.gpx: line 3: A place has no lat and lon that are numbers with decimal points.");
    }
    snprintf(text, sizeof text, "%s<wpt lat=' 48.5 ' lon='-1.15e1'><name>a</name></wpt></gpx>", head);
    write_text("good.gpx", text);
    froe_scene *scene = read_scene("good.gpx", NULL);
    assert_true(corner(scene, 0, 0)[0] == -11.5 && corner(scene, 0, 0)[1] == 48.5);
    froe_scene_free(scene);
    assert_true(test_memory_each(read_with_memory, "good.gpx") > 2);
}

/* ------------------------------------------------------------------------- GML -- */

static void write_gml(const char *path, const char *geometry) {
    char text[700];
    snprintf(text, sizeof text,
             "<?xml version=\"1.0\"?>\n<FeatureCollection xmlns:gml=\"http://www.opengis.net/gml\" "
             "xmlns=\"http://example.com/f\">\n<gml:featureMember><road><pos>left, 2</pos><gml:shape>\n%s\n"
             "</gml:shape></road></gml:featureMember></FeatureCollection>\n",
             geometry);
    write_text(path, text);
}

#define STRING(parts) "<gml:LineString>" parts "</gml:LineString>"
#define POINT(parts) "<gml:Point>" parts "</gml:Point>"

/* GDAL would make other places of them. */
static void places_of_gml_are_numbers(void **state) {
    (void)state;
    static const char numbers[] = "A place is not numbers with decimal points and blanks between them.",
                      pairs[] = "A place is not two or three numbers with decimal points.";
    static const struct {
        const char *geometry, *sentence;
    } bad[] = {
        {STRING("<gml:posList>1,5 2,5 3,5 4,5</gml:posList>"), numbers},
        {STRING("<gml:posList>1 2 3 x</gml:posList>"), numbers},
        {STRING("<gml:posList>1 2 3 4m</gml:posList>"), numbers},
        {STRING("<gml:posList>1 2 NaN 4</gml:posList>"), numbers},
        {STRING("<gml:posList>1 2 . 4</gml:posList>"), numbers},
        {STRING("<gml:posList>1 2 3e 4</gml:posList>"), numbers},
        {STRING("<gml:pos>1,5 2,5</gml:pos><gml:pos>3,5 4,5</gml:pos>"), numbers},
        {POINT("<gml:coord><gml:X>1,5</gml:X><gml:Y>2</gml:Y></gml:coord>"), numbers},
        {STRING("<gml:coordinates>1,5,2,5 3,5,4,5</gml:coordinates>"), pairs},
        {STRING("<gml:coordinates>1,x 3,4</gml:coordinates>"), pairs},
        {STRING("<gml:coordinates>x,1 3,4</gml:coordinates>"), pairs},
        {POINT("<gml:coordinates>1</gml:coordinates>"), pairs},
        {STRING("<gml:coordinates>1,2;3,4</gml:coordinates>"), pairs},
        {STRING("<gml:coordinates>1,2, 3,4</gml:coordinates>"), pairs},
        {STRING("<gml:coordinates>1,2 3</gml:coordinates>"), pairs},
        {STRING("<gml:coordinates decimal=\",\" cs=\" \" ts=\";\">1,5 2.5;3,5 4,5</gml:coordinates>"), pairs},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char sentence[120];
        snprintf(sentence, sizeof sentence, "bad.gml: line 4: %s", bad[i].sentence);
        write_gml("bad.gml", bad[i].geometry);
        refuse("bad.gml", FROE_E_FORMAT, sentence);
    }
}

static void what_places_of_gml_may_be_is_read(void **state) {
    (void)state;
    static const char *const good[] = {
        STRING("<gml:posList>1 2 3 4</gml:posList>"),
        STRING("<gml:posList srsDimension=\"3\">\n1.e0 +2\t0\n3E+0 .4e1 -0 </gml:posList>"),
        STRING("<gml:posList>1 2<!-- and --> 3 4</gml:posList>"),
        STRING("<gml:posList>10e-1 2 3 4</gml:posList>"),
        STRING("<gml:pos>1 2</gml:pos><gml:pos>3 4</gml:pos>"),
        STRING("<gml:coordinates>\n1,2 3,4\n</gml:coordinates>"),
        STRING("<gml:coordinates>1,2,0 3,4,0</gml:coordinates>"),
        STRING("<gml:coordinates>1 2,3 4</gml:coordinates>"),
        STRING("<gml:coordinates decimal=\",\" cs=\" \" ts=\";\">1,0 2;3 4,0</gml:coordinates>"),
        STRING("<gml:coordinates cs=\";\" ts=\" \">1;2 3;4</gml:coordinates>"),
        STRING("<gml:coord><gml:X>1</gml:X><gml:Y>2</gml:Y></gml:coord>"
               "<gml:coord><gml:X>3</gml:X><gml:Y>4</gml:Y></gml:coord>"),
    };
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        write_gml("good.gml", good[i]);
        froe_scene *scene = read_scene("good.gml", NULL);
        assert_int_equal(froe_scene_object_count(scene), 1);
        for (int k = 0; k < 2; k++)
            if (corner(scene, 0, k)[0] != 1 + 2 * k || corner(scene, 0, k)[1] != 2 + 2 * k) fail_msg("%s", good[i]);
        froe_scene_free(scene);
    }
    assert_true(test_memory_each(read_with_memory, "good.gml") > 5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_assimp_takes_for_something_else_is_refused),
        cmocka_unit_test(roots_may_be_cut_off),
        cmocka_unit_test(what_fits_in_ac_is_read),
        cmocka_unit_test(what_is_moved_in_one_way_is_read),
        cmocka_unit_test(points_alone_are_left_out),
        cmocka_unit_test(memory_may_end_in_ac),
        cmocka_unit_test(what_does_not_fit_is_refused),
        cmocka_unit_test(what_fits_in_ase_is_read),
        cmocka_unit_test(what_has_no_objects_is_refused),
        cmocka_unit_test(text_of_two_bytes_a_letter_is_refused),
        cmocka_unit_test(memory_may_end_in_ase),
        cmocka_unit_test(what_assimp_leaves_out_is_refused),
        cmocka_unit_test(what_is_right_is_read),
        cmocka_unit_test(what_is_not_as_expected_is_left_to_assimp),
        cmocka_unit_test(meshes_may_have_no_faces),
        cmocka_unit_test(binary_files_are_looked_through),
        cmocka_unit_test(memory_may_end_in_x),
        cmocka_unit_test(places_of_kml_are_numbers),
        cmocka_unit_test(what_places_of_kml_may_be_is_read),
        cmocka_unit_test(places_in_archives_of_kml_are_numbers),
        cmocka_unit_test(places_of_gpx_are_numbers),
        cmocka_unit_test(places_of_gml_are_numbers),
        cmocka_unit_test(what_places_of_gml_may_be_is_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
