/* test_checks.c: COLLADA, 3MF and STL, which are looked through by froe itself: memory that ends and calls that are
 * cancelled at every place, names that are missing or refer to nothing, and requirements that are lists of words. */
#include "support.h"
#include <cpl_vsi.h>

static size_t objects_of(const char *path, froe_read_report *report) {
    froe_scene *scene = read_scene(path, report);
    const size_t count = froe_scene_object_count(scene);
    froe_scene_free(scene);
    return count;
}

/* ------------------------------------------------------------------- COLLADA -- */

enum { NODES = 40, MOST = 1 << 15 };

static const char collada[] =
    "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\"><asset/>\n"
    "<library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" count=\"9\">0 0 0 4 0 0 0 4 0"
    "</float_array><technique_common><accessor source=\"#a\" count=\"3\" stride=\"3\"><param name=\"X\" "
    "type=\"float\"/>"
    "<param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"
    "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"1\">"
    "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 2</p></triangles></mesh></geometry>%s"
    "</library_geometries>\n<library_visual_scenes><visual_scene id=\"s\">%s</visual_scene></library_visual_scenes>\n"
    "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>\n";

static void write_collada(const char *path, const char *geometries, const char *nodes) {
    char *text = malloc(MOST);
    assert_non_null(text);
    assert_true(snprintf(text, MOST, collada, geometries, nodes) < MOST);
    write_text(path, text);
    free(text);
}

/* Nodes in a row, each moved by its number. */
static void write_nodes(const char *path) {
    char *nodes = malloc(MOST);
    size_t used = 0;
    assert_non_null(nodes);
    for (int i = 0; i < NODES; i++)
        used +=
            (size_t)snprintf(nodes + used, MOST - used,
                             "<node id=\"node number %d\"><translate>%d 0 0</translate><rotate>0 0 1 90</rotate>"
                             "<matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix><instance_geometry url=\"#g\"/></node>\n",
                             i, 5 * i);
    write_collada(path, "", nodes);
    free(nodes);
}

static void many_nodes_are_all_read(void **state) {
    (void)state;
    write_nodes("nodes.dae");
    assert_int_equal(objects_of("nodes.dae", NULL), NODES);
}

static void names_of_collada_have_to_be_there(void **state) {
    static const char here[] = "<instance_geometry url=\"#g\"/>", lost[] = "which instance_geometry names, is not in";
    char nodes[512];
    (void)state;
    /* a node without a name or an id is one all the same */
    snprintf(nodes, sizeof nodes, "<node>%s</node>", here);
    write_collada("nameless.dae", "<geometry><mesh/></geometry>", nodes);
    assert_int_equal(objects_of("nameless.dae", NULL), 1);
    snprintf(nodes, sizeof nodes, "<node>%s<instance_geometry/></node>", here);
    write_collada("urlless.dae", "", nodes);
    refuse("urlless.dae", FROE_E_FORMAT, lost);
    write_text("idless.dae", "<COLLADA version=\"1.4.1\"><asset/><library_visual_scenes><visual_scene><node>"
                             "<instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes></COLLADA>");
    refuse("idless.dae", FROE_E_FORMAT, lost);
    /* the first fault is told */
    snprintf(nodes, sizeof nodes, "<node><rotate>1 1 0 5</rotate><rotate>1 1 1 5</rotate><matrix>2</matrix>%s</node>",
             here);
    write_collada("faults.dae", "<geometry id=\"h\"><mesh><trifans><p>0 -1</p></trifans></mesh></geometry>", nodes);
    refuse("faults.dae", FROE_E_UNSUPPORTED, "trifans");
    write_collada("axes.dae", "", nodes);
    refuse("axes.dae", FROE_E_FORMAT, "axis");
}

/* Each of the last four numbers of a matrix counts. */
static void last_rows_of_matrices_are_looked_at(void **state) {
    static const char *const rows[] = {"0 0 0 1", "1 0 0 1", "0 1 0 1", "0 0 1 1", "0 0 0 2"};
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char nodes[512];
        snprintf(nodes, sizeof nodes,
                 "<node><matrix>1 0 0 0 0 1 0 0 0 0 1 0 %s</matrix><instance_geometry url=\"#g\"/></node>", rows[i]);
        write_collada("rows.dae", "", nodes);
        if (i)
            refuse("rows.dae", FROE_E_FORMAT, "The last row of a matrix is not 0, 0, 0 and 1.");
        else
            assert_int_equal(objects_of("rows.dae", NULL), 1);
    }
}

/* A library of nodes may stand behind the scenes. Of its nodes those at the top alone are found by assimp. */
static void nodes_of_later_libraries_are_found(void **state) {
    char nodes[1024];
    (void)state;
    for (int leg = 0; leg < 2; leg++) {
        snprintf(nodes, sizeof nodes,
                 "<node><instance_node url=\"#%s\"/></node></visual_scene></library_visual_scenes><library_nodes>"
                 "<node id=\"chair\" name=\"chair\"><instance_geometry url=\"#g\"/><node id=\"leg\"/></node>"
                 "</library_nodes><library_visual_scenes><visual_scene id=\"t\">",
                 leg ? "leg" : "chair");
        write_collada("later.dae", "", nodes);
        if (leg)
            refuse("later.dae", FROE_E_FORMAT, "'#leg', which instance_node names");
        else
            assert_int_equal(objects_of("later.dae", NULL), 1);
    }
}

/* The text of write_collada() with another word. */
static void write_changed(const char *path, const char *nodes, const char *word, const char *other) {
    char text[4096], changed[8192];
    assert_true(snprintf(text, sizeof text, collada, "", nodes) < (int)sizeof text);
    const char *at = strstr(text, word);
    assert_non_null(at);
    snprintf(changed, sizeof changed, "%.*s%s%s", (int)(at - text), text, other, at + strlen(word));
    write_text(path, changed);
}

static void what_collada_says_of_its_numbers_is_looked_at(void **state) {
    (void)state;
#define X_PARAM "<param name=\"X\" type=\"float\"/>"
#define Y_PARAM "<param name=\"Y\" type=\"float\"/>"
#define Z_PARAM "<param name=\"Z\" type=\"float\"/>"
    static const char beyond[] = "line 2: An accessor counts more numbers than its array has.",
                      flat[] = "line 2: Points with an X and no Z are not read.";
    static const struct {
        const char *word, *other;
        froe_status status;
        const char *sentence; /* NULL: it is read, as one object */
    } cases[] = {
        {"count=\"3\" stride", "count=\"4\" stride", FROE_E_FORMAT, beyond},
        {"count=\"3\" stride", "count=\"3\" offset=\"1\" stride", FROE_E_FORMAT, beyond},
        {"count=\"3\" stride", "count=\"3\" offset=\"10\" stride", FROE_E_FORMAT, beyond},
        {Z_PARAM, "", FROE_E_UNSUPPORTED, flat},
        {X_PARAM, Z_PARAM X_PARAM, FROE_OK, NULL},
        {X_PARAM, "<param type=\"float\"/>" Z_PARAM X_PARAM, FROE_OK, NULL},
        {Z_PARAM, Z_PARAM "<param name=\"W\" type=\"float\"/>", FROE_OK, NULL},
        {Y_PARAM, "<extra><technique><accessor/></technique></extra>" Y_PARAM, FROE_OK, NULL},
        /* the first fault is told: of an empty element the end is told to the reader, too */
        {Y_PARAM, "<skew/>", FROE_E_UNSUPPORTED, "line 2: Skews are not read. A matrix is."},
        {"<p>0 1 2</p>", "<p>0 1 -2</p>", FROE_E_FORMAT, "line 2: An index is negative."},
        {"<p>0 1 2</p>", "<p>0 1 02</p>", FROE_OK, NULL},
        {"</technique_common></source>",
         "</technique_common></source><source id=\"q\"><float_array id=\"b\" count=\"1\">0</float_array>"
         "<technique_common><accessor source=\"#b\" count=\"0\"><param/></accessor></technique_common></source>",
         FROE_OK, NULL},
        {"</geometry>", "</geometry><geometry id=\"h\"><convex_mesh/></geometry><geometry><spline/></geometry>",
         FROE_OK, NULL},
        {"<library_visual_scenes>", "<library_physics_models><skew/></library_physics_models><library_visual_scenes>",
         FROE_OK, NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char sentence[128];
        write_changed("numbers.dae", "<node><instance_geometry url=\"#g\"/></node>", cases[i].word, cases[i].other);
        snprintf(sentence, sizeof sentence, "numbers.dae: %s", cases[i].sentence);
        if (cases[i].status)
            refuse("numbers.dae", cases[i].status, sentence);
        else
            assert_int_equal(objects_of("numbers.dae", NULL), 1);
    }
}

/* Of text in other encodings the parser hands over 1024 bytes at once. */
static void write_long(const char *path, const char *open, const char *number, const char *close) {
    static char text[16384];
    size_t used = (size_t)snprintf(text, sizeof text,
                                   "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?><COLLADA version"
                                   "=\"1.4.1\"><asset/><library_visual_scenes><visual_scene><node>"
                                   "%s",
                                   open);
    for (int i = 0; i < 1500; i++) used += (size_t)snprintf(text + used, sizeof text - used, "%s ", number);
    snprintf(text + used, sizeof text - used, "%s</node></visual_scene></library_visual_scenes></COLLADA>", close);
    write_text(path, text);
}

static void long_texts_are_refused_once(void **state) {
    (void)state;
    write_long("long.dae", "<p>", "-1", "</p>");
    refuse("long.dae", FROE_E_FORMAT, "long.dae: line 1: An index is negative.");
    write_long("long.dae", "<matrix>", "1", "</matrix>");
    refuse("long.dae", FROE_E_FORMAT, "long.dae: line 1: The last row of a matrix is not 0, 0, 0 and 1.");
    write_long("long.dae", "<matrix>0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 1 ", "0", "</matrix><skew/>");
    refuse("long.dae", FROE_E_UNSUPPORTED, "long.dae: line 1: Skews are not read. A matrix is.");
    test_memory m = {.calls = 0};
    for (size_t fail_at = 1, refused = 0; refused < 2 && fail_at < 1000; fail_at++) { /* each time another place */
        froe_allocator alloc = test_memory_begin(&m);
        froe_read_options o = froe_read_defaults();
        froe_diagnostic why = {.message = ""};
        froe_scene *scene = NULL;
        o.alloc = &alloc, m.fail_at = fail_at;
        const froe_status status = froe_read("long.dae", &o, &scene, NULL, &why);
        assert_true(status == FROE_E_MEMORY || status == FROE_E_UNSUPPORTED);
        assert_null(scene);
        refused = status == FROE_E_MEMORY ? 0 : refused + 1;
        test_memory_end(&m);
    }
}

/* ------------------------------------------------------------------- X3D and AMF -- */

typedef struct checked_text {
    const char *path, *text;
    froe_status status;
    const char *words; /* of the message, or sorts that are left out */
    size_t objects;
} checked_text;

static void check_texts(const checked_text *cases, size_t count) {
    for (size_t i = 0; i < count; i++) {
        froe_read_report report;
        write_text(cases[i].path, cases[i].text);
        if (cases[i].status) {
            refuse(cases[i].path, cases[i].status, cases[i].words);
            continue;
        }
        const size_t objects = objects_of(cases[i].path, &report);
        if (objects != cases[i].objects || strcmp(report.sorts_left, cases[i].words) != 0)
            fail_msg("%s: %zu objects, and '%s' are left out", cases[i].text, objects, report.sorts_left);
    }
}

#define FACES(point)                                                                                                   \
    "<IndexedFaceSet coordIndex=\"0 1 2 -1\"><" point " point=\"0 0 0, 1 0 0, 1 2 0\"/></IndexedFaceSet>"
#define SHAPE "<Shape>" FACES("Coordinate") "<Appearance><Material/></Appearance></Shape>"
#define X3D(nodes) "<X3D version=\"3.3\"><head><meta name=\"a\"/></head>\n<Scene>" nodes "</Scene></X3D>"
#define TURNED(attributes) X3D("<Transform " attributes ">" SHAPE "</Transform>")
#define POINTS4 "<Coordinate point=\"0 0 0, 1 0 0, 1 1 0, 0 1 0\"/>"
#define LISTS(sort, name, list) X3D("<Shape><" sort " " name "=\"" list "\">" POINTS4 "</" sort "></Shape>")
#define LISTED(list) LISTS("IndexedFaceSet", "coordIndex", list)
#define LINES(list) LISTS("IndexedLineSet", "coordIndex", list)

static void what_assimp_takes_for_something_else_is_refused(void **state) {
    (void)state;
    static const char axis[] = "line 2: The axis of a rotation has not the length 1.",
                      blanks[] = "line 2: Indices are not whole numbers with blanks between them.",
                      none[] = "line 2: A face or line has no corners.",
                      more[] = "line 2: Lines of more than two points are not read.";
    static const checked_text cases[] = {
        {"a.x3d", X3D(SHAPE), FROE_OK, "", 1},
        {"a.x3d", TURNED("rotation=\"0.577, 0.577, 0.577, 1\" scaleOrientation=\"0 0 0 0\""), FROE_OK, "", 1},
        {"a.x3d", TURNED("translation=\"5 0 0\" scaleOrientation=\"1 1 0 1.5\""), FROE_E_FORMAT, axis, 0},
        {"a.x3d", TURNED("rotation=\"0 0 2 1.5\" translation=\"5 0 0\""), FROE_E_FORMAT, axis, 0},
        {"a.x3d", X3D(SHAPE "\n<Shape><Cone/><Cone/></Shape>"), FROE_E_UNSUPPORTED, "line 3: Cones are not read.", 0},
        {"a.x3d", X3D(SHAPE "<Collision><Transform>" SHAPE "</Transform></Collision><LOD>" SHAPE SHAPE "</LOD>"),
         FROE_OK, "Collision, LOD", 1},
        {"a.x3d", X3D(SHAPE "<ProtoDeclare name=\"p\">" SHAPE "</ProtoDeclare><Viewpoint/>"), FROE_OK, "", 1},
        {"a.x3d", X3D(SHAPE "<Shape><Text string=\"a\"/></Shape>"), FROE_OK, "Text", 1},
        {"a.x3d", X3D(SHAPE "<Shape>" FACES("CoordinateDouble") "</Shape><ProtoInstance name=\"p\"/>"), FROE_OK,
         "CoordinateDouble, ProtoInstance", 1},
        {"a.x3d", X3D(SHAPE "<ALongNameOfANodeThatNoStandardKnows/>"), FROE_E_FORMAT, "Unknown node \"ALong", 0},
        {"a.x3d", "<X3D><Scene>", FROE_E_FORMAT, "a.x3d: line 1: The text is not well-formed XML.", 0},
        {"a.x3d", "<?xml version=\"1.0\" encoding=\"x-nobody\"?>" X3D(SHAPE), FROE_OK, "", 1}, /* assimp reads it */
        {"a.x3d", LISTED("0, 1, 2, -1,\n0 2\t3"), FROE_OK, "", 2},
        {"a.x3d", LISTED("0,1,2,-1,0,2,3,-1"), FROE_E_UNSUPPORTED, blanks, 0},
        {"a.x3d", LISTED("0 1 2 -1, 0 2 ,3"), FROE_E_UNSUPPORTED, blanks, 0},
        {"a.x3d", LISTED("0 1 x 2"), FROE_E_UNSUPPORTED, blanks, 0},
        {"a.x3d", LISTED("0 1 2 -1 -1 0 2 3"), FROE_E_FORMAT, none, 0},
        {"a.x3d", LISTED("-1 0 2 3"), FROE_E_FORMAT, none, 0},
        {"a.x3d", LISTS("IndexedTriangleSet", "index", "0 1 2 0 2 3"), FROE_OK, "", 2},
        {"a.x3d", LISTS("IndexedTriangleSet", "index", "0,1,2"), FROE_E_UNSUPPORTED, blanks, 0},
        {"a.x3d", LINES("0 1 -1 2 3 -1"), FROE_OK, "", 2},
        {"a.x3d", LINES("0 1 2 -1"), FROE_E_UNSUPPORTED, more, 0},
        {"a.x3d", LISTS("LineSet", "vertexCount", "2 2"), FROE_OK, "", 2},
        {"a.x3d", LISTS("LineSet", "vertexCount", "2,2"), FROE_E_UNSUPPORTED, blanks, 0},
        {"a.x3d", LISTS("LineSet", "vertexCount", "2 3"), FROE_E_UNSUPPORTED, more, 0},
    };
    check_texts(cases, sizeof cases / sizeof *cases);
}

#define AMF(more) "<amf unit=\"millimeter\">\n" more "</amf>"
#define CORNER(x, y) "<vertex><coordinates><x>" x "</x><y>" y "</y><z>0</z></coordinates></vertex>"
#define VOLUME "<volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume>"
#define OF(material, more)                                                                                             \
    "<volume materialid=\"" material "\">" more "<triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume>"
#define COLOUR "<color><r>1</r><g>0</g><b>0</b></color>"
#define RED "<material id=\"1\">" COLOUR "</material>"
#define AMF_VERTICES "<vertices>" CORNER("0", "0") CORNER("1", "0") CORNER("0", "1") "</vertices>"
#define MESH(volumes) "<mesh>" AMF_VERTICES volumes "</mesh>"
#define OBJECT(id, meshes) "<object id=\"" id "\">" meshes "</object>\n"
#define INSTANCE(parts) "<constellation id=\"9\"><instance objectid=\"0\">" parts "</instance></constellation>"
#define GOOD OBJECT("0", MESH(VOLUME))

static void what_assimp_passes_over_of_amf_is_refused(void **state) {
    (void)state;
    static const char turn[] = "line 3: Turns of instances (rx, ry, rz) are not read.",
                      scale[] = "line 3: Scales and mirrors of instances are not read.",
                      several[] = ": Objects of several volumes that differ are not read.";
    static const checked_text cases[] = {
        {"a.amf", AMF(GOOD OBJECT("1", MESH(VOLUME))), FROE_OK, "", 2},
        {"a.amf", AMF(GOOD INSTANCE("<deltax>5</deltax>")), FROE_OK, "", 1},
        {"a.amf", AMF(OBJECT("0", MESH(VOLUME "\n" VOLUME "<!-- <volume> -->" VOLUME))), FROE_OK, "", 3},
        {"a.amf", AMF(RED OBJECT("0", MESH(OF("1", "") OF("1", "")))), FROE_OK, "", 2},
        {"a.amf", AMF(RED OBJECT("0", MESH(OF("1", "") VOLUME))), FROE_E_UNSUPPORTED, several, 0},
        {"a.amf", AMF(OBJECT("0", MESH(OF("", COLOUR) VOLUME))), FROE_E_UNSUPPORTED, several, 0},
        {"a.amf", AMF(OBJECT("0", MESH(VOLUME OF("", COLOUR)))), FROE_E_UNSUPPORTED, several, 0},
        {"a.amf", AMF(OBJECT("0", MESH(OF("", "<metadata>a</metadata>") VOLUME))), FROE_OK, "", 2},
        {"a.amf", AMF(OBJECT("0", MESH("<volume/>" VOLUME))), FROE_E_UNSUPPORTED, several, 0},
        {"a.amf", AMF(OBJECT("0", "<mesh>" VOLUME AMF_VERTICES "</mesh>")), FROE_OK, "", 1},
        {"a.amf",
         AMF(OBJECT("0", MESH("<volume type=\"object\"><triangle><v1>0</v1><v2>1</v2><v3>2</v3>" COLOUR
                              "</triangle></volume>" VOLUME))),
         FROE_OK, "", 2},
        {"a.amf", AMF(OBJECT("0", "<mesh>" VOLUME AMF_VERTICES VOLUME "</mesh>")), FROE_E_UNSUPPORTED, several, 0},
        {"a.amf", AMF(OBJECT("0", "<mesh>" VOLUME VOLUME AMF_VERTICES "</mesh>")), FROE_E_UNSUPPORTED, several, 0},
        {"a.amf", AMF(OBJECT("1", MESH(VOLUME) MESH(VOLUME))), FROE_E_UNSUPPORTED,
         "line 2: Objects of several meshes are not read.", 0},
        {"a.amf", AMF(GOOD INSTANCE("<scalex>1.0</scalex><mirrorz>1</mirrorz><printable>1</printable>")), FROE_OK, "",
         1},
        {"a.amf", AMF(GOOD INSTANCE("<scale>2</scale>")), FROE_E_UNSUPPORTED, scale, 0},
        {"a.amf", AMF(GOOD INSTANCE("<mirrory>-1</mirrory>")), FROE_E_UNSUPPORTED, scale, 0},
        {"a.amf", AMF(GOOD INSTANCE("<ry>1e-9</ry>")), FROE_E_UNSUPPORTED, turn, 0},
        {"a.amf", AMF(GOOD INSTANCE("<rz>90</rz>")), FROE_E_UNSUPPORTED, turn, 0},
        {"a.amf", "<amf>", FROE_E_FORMAT, "a.amf: line 1: The text is not well-formed XML.", 0},
        {"a.amf", "PK\3\4 is no AMF in an archive", FROE_E_FORMAT, "a.amf: ", 0},
    };
    check_texts(cases, sizeof cases / sizeof *cases);
}

static void turns_by_nothing_move_no_instance(void **state) {
    (void)state;
    static const char text[] = AMF(GOOD INSTANCE("<rx>0</rx><deltax>5</deltax><ry/><deltay>6</deltay><deltaz>7</deltaz>"
                                                 "<rz> 0.0 </rz>"));
    write_text("still.amf", text);
    assert_true(test_memory_each(read_with_memory, "still.amf") > 5);
    froe_scene *scene = read_scene("still.amf", NULL);
    assert_int_equal(froe_scene_object_count(scene), 1);
    for (int k = 0; k < 3; k++) assert_true(corner(scene, 0, 0)[k] == 5 + k);
    froe_scene_free(scene);
}

/* assimp gives corners without a colour one that is black and clear. */
static void faces_of_amf_without_a_colour_have_none(void **state) {
    (void)state;
    write_text("plain.amf", AMF(GOOD OBJECT("1", MESH(OF("", COLOUR)))));
    froe_scene *scene = read_scene("plain.amf", NULL);
    assert_int_equal(froe_scene_object_count(scene), 2);
    for (uint32_t i = 0; i < 2; i++)
        assert_int_equal(froe_scene_group(scene, froe_scene_object(scene, i).group).colour, i ? 0xff0000ff : 0);
    froe_scene_free(scene);
}

static bool count_calls(void *user, double done) {
    int *calls = user;
    (void)done;
    return --*calls > 0;
}

/* Texts are looked through by megabytes, and one that ends in the first is no more looked at, or cancelled. */
static void long_texts_are_looked_through_in_parts(void **state) {
    (void)state;
    enum { SIZE = 5 << 19 };
    char *text = malloc(SIZE + 512);
    assert_non_null(text);
    const int used = snprintf(text, 512, "%s", X3D(SHAPE "<!-- "));
    char *at = strstr(text, "<!-- ") + 5;
    assert_true(used < 512);
    memset(at, ' ', SIZE);
    strcpy(at + SIZE, "--></Scene></X3D>");
    write_text("long.x3d", text);
    assert_int_equal(objects_of("long.x3d", NULL), 1);
    for (int calls = 2; calls < 5; calls++) {
        int left = calls;
        froe_read_options o = froe_read_defaults();
        o.progress = count_calls, o.user = &left;
        refuse_with("long.x3d", &o, FROE_E_CANCELLED, "Cancelled.");
        assert_int_equal(left, 0);
    }
    memcpy(at, "--><", 4);
    memcpy(at + 5, "&", 1);
    write_text("long.x3d", text);
    refuse("long.x3d", FROE_E_FORMAT, "long.x3d: line 2: The text is not well-formed XML.");
    free(text);
}

/* ----------------------------------------------------------------------- 3MF -- */

static const char relations[] =
    "<Relationships xmlns=\"r\"><Relationship Target=\"/t.png\" Id=\"t\" Type=\"thumbnail\"/>"
    "<Relationship Target=\"/t.png\" Id=\"u\" Type=\"http://x/thumbnail\"/><Relationship Id=\"v\"/>"
    "<Relationship Id=\"w\" Type=\"http://x/3dmodel\"/><Other Type=\"http://x/3dmodel\" Target=\"/o\"/>"
    "<Relationship Target=\"/3D/m.model\" Id=\"a\" Type=\"http://x/3dmodel\"/>"
    "<Relationship Target=\"/3D/later.model\" Id=\"b\" Type=\"http://x/3dmodel\"/></Relationships>";
static const char mesh[] = "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
                           "<vertex x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles>"
                           "<triangle v1=\"0\" v2=\"1\" v3=\"2\"/></triangles></mesh>";

static void write_part(const char *archive, const char *name, const char *text) {
    char path[128];
    snprintf(path, sizeof path, "/vsizip/{%s}/%s", archive, name);
    VSILFILE *file = VSIFOpenL(path, "wb");
    assert_non_null(file);
    assert_int_equal(VSIFWriteL(text, 1, strlen(text), file), strlen(text));
    assert_int_equal(VSIFCloseL(file), 0);
}

/* An archive of one model: attributes of its root, what it has besides an object, and of what that is made. */
static void write_3mf(const char *path, const char *root, const char *more) {
    char text[4096];
    remove(path);
    assert_true((size_t)snprintf(text, sizeof text,
                                 "<model xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" %s>"
                                 "<resources>%s<object id=\"1\" name=\"one\">%s</object></resources>"
                                 "<build><item objectid=\"1\"/></build></model>",
                                 root, more, mesh) < sizeof text);
    write_part(path, "_rels/.rels", relations);
    write_part(path, "3D/m.model", text);
}

#define LONG "a-prefix-of-forty-letters-that-is-nowhere" /* of a message the first 80 are shown */

static void requirements_of_3mf_are_lists_of_words(void **state) {
    static const char declared[] = "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" "
                                   "xmlns:s=\"http://schemas.microsoft.com/3dmanufacturing/slice/2015/07\" "
                                   "xmlns:v=\"http://vendor\" requiredextensions=\"%s\"";
    static const struct {
        const char *words, *refused;
    } cases[] = {{"", NULL},
                 {" ", NULL},
                 {"p", NULL},
                 {" p\tp\n", NULL},
                 {"p s", "slice/2015/07"},
                 {"v", "http://vendor"},
                 {"v nobody", "http://vendor"},
                 {"nobody", "'nobody'"},
                 {LONG LONG LONG, "'" LONG}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char root[512];
        snprintf(root, sizeof root, declared, cases[i].words);
        write_3mf("required.3mf", root, "");
        if (cases[i].refused)
            refuse("required.3mf", FROE_E_UNSUPPORTED, cases[i].refused);
        else
            assert_int_equal(objects_of("required.3mf", NULL), 1);
    }
}

/* Of a corner whose colour is not in the list, the triangle has no mixture. */
static void corners_without_colours_mix_none(void **state) {
    (void)state;
    write_3mf("mixed.3mf", "",
              "<colorgroup id=\"6\"><color color=\"#0000FF\"/><color color=\"#00FF00\"/></colorgroup>"
              "<object id=\"2\"><mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/>"
              "<vertex x=\"0\" y=\"1\" z=\"0\"/></vertices><triangles>"
              "<triangle v1=\"0\" v2=\"1\" v3=\"2\" pid=\"6\" p1=\"0\" p2=\"1\" "
              "p3=\"9\"/></triangles></mesh></object></resources><build><item objectid=\"2\"/></build><resources>");
    assert_int_equal(objects_of("mixed.3mf", NULL), 2);
}

static void what_stands_outside_of_objects_is_no_part_of_one(void **state) {
    froe_read_report report;
    (void)state;
    write_3mf("outside.3mf", "",
              "<vertex x=\"9\" y=\"9\" z=\"9\"/><triangle v1=\"7\" v2=\"8\" v3=\"9\"/><beamlattice/><texture2d/>"
              "<component objectid=\"1\"/><basematerials id=\"5\"><base displaycolor=\"#FF0000\"/>"
              "<base displaycolor=\"#FF000080\" name=\"\"/></basematerials>");
    assert_int_equal(objects_of("outside.3mf", &report), 1);
    assert_int_equal(report.textures, 1);
    for (int i = 0; i < 4; i++) {
        static const char *const colours[] = {"", "displaycolor=\"red\"", "displaycolor=\"#12345\"",
                                              "displaycolor=\"#123456x\""};
        char more[128];
        snprintf(more, sizeof more, "<basematerials id=\"5\"><base %s/></basematerials>", colours[i]);
        write_3mf("colour.3mf", "", more);
        refuse("colour.3mf", FROE_E_FORMAT, "A colour is not like #RRGGBB.");
    }
}

/* What stands in place of the object, beside another part; NULL: it is read. */
static void what_objects_consist_of_is_looked_at(void **state) {
    (void)state;
#define VERTICES                                                                                                       \
    "<vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"1\" z=\"0\"/>"    \
    "</vertices>"
#define CORNERS "v1=\"0\" v2=\"1\" v3=\"2\""
    static const struct {
        const char *more, *sentence;
        size_t objects;
    } cases[] = {
        {"<object id=\"-1\"/>", "An attribute is not a whole number below 2^31.", 0},
        {"<object id=\"2\"><q:mesh xmlns:q=\"http://x\">" VERTICES "</q:mesh></object>", NULL, 1},
        /* two triangles of one colour are of one group, and a part that is named twice is read once */
        {"<colorgroup id=\"6\"><color color=\"#0000FF\"/></colorgroup><object id=\"2\"><mesh>" VERTICES
         "<triangles><triangle " CORNERS " pid=\"6\" p1=\"0\"/><triangle " CORNERS " pid=\"6\" p1=\"0\"/></triangles>"
         "</mesh></object></resources><build><item objectid=\"2\"/></build><resources>",
         NULL, 3},
        {"<object id=\"2\"><components><component path=\"/3D/b.model\" objectid=\"1\"/><component path=\"/3D/b.model\" "
         "objectid=\"1\"/></components></object></resources><build><item objectid=\"2\"/></build><resources>",
         NULL, 3},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char part[1024];
        write_3mf("objects.3mf", "", cases[i].more);
        snprintf(part, sizeof part, "<model><resources><object id=\"1\">%s</object></resources></model>", mesh);
        write_part("objects.3mf", "3D/b.model", part);
        if (cases[i].sentence)
            refuse("objects.3mf", FROE_E_FORMAT, cases[i].sentence);
        else
            assert_int_equal(objects_of("objects.3mf", NULL), cases[i].objects);
    }
    froe_scene *scene;
    write_3mf("objects.3mf", "", cases[2].more);
    scene = read_scene("objects.3mf", NULL);
    assert_int_equal(froe_scene_group_count(scene), 2);
    froe_scene_free(scene);
}

static void what_is_wrong_with_objects_is_said(void **state) {
    (void)state;
#define TRIANGLE(corners)                                                                                              \
    "<object id=\"2\"><mesh>" VERTICES "<triangles><triangle " corners "/></triangles></mesh></object>"
#define BUILD(what) "</resources><build><item " what "/></build><resources>"
#define VERTEX(numbers) "<object id=\"2\"><mesh><vertices><vertex " numbers "/></vertices></mesh></object>"
    static const char whole[] = "part '3D/m.model', line 1: An attribute is not a whole number below 2^31.",
                      number[] = "part '3D/m.model', line 1: A coordinate is missing or no finite number.";
    static const struct {
        const char *more, *sentence;
    } cases[] = {
        {TRIANGLE("v1=\"0\" v2=\"1\""), "A triangle has no three vertices."},
        {TRIANGLE("v1=\"0\" v2=\"1\" v3=\"2x\""), whole},
        {TRIANGLE("v1=\"0\" v2=\"1\" v3=\"2147483648\""), whole},
        {TRIANGLE("v1=\"0\" v2=\"1\" v3=\"\""), whole},
        {TRIANGLE("v1=\"0\" v2=\"1\" v3=\"3\"") BUILD("objectid=\"2\""),
         "triangle 0: The triangle names a vertex that does not exist."},
        {VERTEX("x=\"0\" y=\"0\""), number},
        {VERTEX("x=\"0\" y=\"0\" z=\"\""), number},
        {VERTEX("x=\"0\" y=\"0\" z=\"0 0\""), number},
        {VERTEX("x=\"0\" y=\"0\" z=\"1e999\""), number},
        {VERTEX("x=\"0\" y=\"north\" z=\"far\""), number},
        {BUILD("objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 0 0\""), number},
        {BUILD("objectid=\"7\""), "object with id 7: It is placed and not defined."},
        {BUILD("objectid=\"0\""), "A component or item names no object."},
        {"<object id=\"1\"/>", "object with id 1: It is defined twice."},
        {"<object id=\"2\"><components><component objectid=\"2\"/></components></object>" BUILD("objectid=\"2\""),
         "object with id 2: It is a component of itself."},
        {"<object id=\"2\"><mesh><beamlattice/></mesh></object>", "A lattice of beams is not read."},
        {"<base displaycolor=\"#FF0000\"/>", "A colour is in no group."},
        {"<object id=\"2\"><components><component path=\"/3D/lost.model\" objectid=\"1\"/></components></object>",
         "wrong.3mf: The archive has no part '3D/lost.model', or is damaged."},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_3mf("wrong.3mf", "", cases[i].more);
        refuse("wrong.3mf", FROE_E_FORMAT, cases[i].sentence);
    }
}

/* Parts are read by 32 kB, and no more of them where the first are refused. */
static void long_parts_are_refused_by_their_beginning(void **state) {
    (void)state;
    enum { SIZE = 1 << 17 };
    static const char wrong[] = "<model><resources><object id=\"x\"/>";
    char *text = malloc(SIZE + 1);
    assert_non_null(text);
    memset(text, ' ', SIZE), text[SIZE] = '\0';
    memcpy(text, wrong, sizeof wrong - 1);
    remove("long.3mf");
    write_part("long.3mf", "_rels/.rels", relations);
    write_part("long.3mf", "3D/m.model", text);
    refuse("long.3mf", FROE_E_FORMAT,
           "long.3mf: part '3D/m.model', line 1: An attribute is not a whole number below 2^31.");
    free(text);
}

static void archives_name_their_model(void **state) {
    (void)state;
    remove("nameless.3mf");
    write_part("nameless.3mf", "_rels/.rels", "<Relationships xmlns=\"r\"/>");
    refuse("nameless.3mf", FROE_E_FORMAT, "nameless.3mf: The archive names no 3D model.");
}

/* ----------------------------------------------------------------------- STL -- */

#define FACET "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
static const char solids[] = "solid a\n" FACET "endsolid a\nsolid b\n" FACET "endsolid b\n";
static const char stray[] = "solid a\n" FACET "endsolid a\nthe next\none is\nsolid b\n" FACET "endsolid b\n";

static void words_between_solids_hide_none(void **state) {
    (void)state;
    write_text("solids.stl", solids);
    assert_int_equal(objects_of("solids.stl", NULL), 2);
    write_text("stray.stl", stray);
    refuse("stray.stl", FROE_E_FORMAT, "line 10");
}

static void ends_of_facets_are_in_facets(void **state) {
    (void)state;
    static const struct {
        const char *text, *sentence; /* NULL: it is read */
    } cases[] = {
        {"solid a\n" FACET "endfacet\nendsolid a\n", "line 9: A facet ends here that has not begun."},
        {"solid a\n" FACET "endsolid a\nendfacet\n", NULL}, /* behind the solid anything may stand */
        {"solid a\n" FACET "endsolid endfacet\n", NULL},    /* a name */
        {"solid a endfacet\n" FACET "endsolid\n", NULL},
        {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid a\n",
         "line 7: The facet has less than 3 vertices."},
        {"solid a\nFacet normal 0 0 1\n", "line 2: Words such as 'facet' are not read in capital letters."},
        {"solid a\n" FACET, "The text does not end with a line 'endsolid', so that triangles may be missing."},
        {FACET "endsolid\n", NULL}, /* no text of STL, as its first word says */
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_text("facets.stl", cases[i].text);
        if (cases[i].sentence)
            refuse("facets.stl", FROE_E_FORMAT, cases[i].sentence);
        else if (i + 1 < sizeof cases / sizeof *cases)
            assert_int_equal(objects_of("facets.stl", NULL), 1);
        else
            refuse("facets.stl", FROE_E_FORMAT, "facets.stl: The file is of no type that can be read.");
    }
}

/* Of a binary file the header says how many triangles there are; bytes behind them are too few for another one. */
static void binary_files_are_as_long_as_their_header_says(void **state) {
    (void)state;
    static const struct {
        size_t size;
        unsigned char count[4];
        const char *sentence; /* NULL: it is read */
    } cases[] = {
        {134, {1}, NULL},
        {160, {1}, NULL},
        {184, {1}, "This binary STL file has 184 bytes. For the 1 triangle of its header it needs 134."},
        {133, {1}, "This binary STL file has 133 bytes. For the 1 triangle of its header it needs 134."},
        {94, {0}, "This binary STL file has 94 bytes. For the 0 triangles of its header it needs 84."},
        {134, {255, 255, 255, 255}, "For the 4294967295 triangles of its header it needs 214748364834."},
        {60, {0}, "A binary STL file has 84 bytes at least, and this one 60."},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        unsigned char bytes[256] = {0};
        memcpy(bytes + 80, cases[i].count, 4);
        const unsigned char one[4] = {0, 0, 0x80, 0x3f};
        memcpy(bytes + 84 + 24, one, 4), memcpy(bytes + 84 + 40, one, 4); /* (0, 0, 0), (1, 0, 0), (0, 1, 0) */
        write_bytes("binary.stl", bytes, cases[i].size);
        if (cases[i].sentence)
            refuse("binary.stl", FROE_E_FORMAT, cases[i].sentence);
        else
            assert_int_equal(objects_of("binary.stl", NULL), 1);
    }
}

/* -------------------------------------------------------------------- faults -- */

/* Many names, colours, components, parts and textures. */
static void write_rich_3mf(const char *path) {
    char more[3000];
    size_t used = 0;
    for (int i = 0; i < 20; i++)
        used += (size_t)snprintf(more + used, sizeof more - used,
                                 "<basematerials id=\"%d\"><base name=\"colour number %d\" displaycolor=\"#0000FF\"/>"
                                 "</basematerials>",
                                 100 + i, i);
    write_3mf(path,
              "xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\" "
              "requiredextensions=\"p\"",
              more);
}

static const char x3d[] =
    "<X3D><Scene><Transform rotation=\"0 0 1 1\"><Shape><IndexedFaceSet coordIndex=\"0 1 2\">"
    "<Coordinate point=\"0 0 0, 1 0 0, 1 2 0\"/></IndexedFaceSet></Shape></Transform></Scene></X3D>";
#define AMF_VERTEX(x, y) "<vertex><coordinates><x>" #x "</x><y>" #y "</y><z>0</z></coordinates></vertex>"
static const char amf[] = "<amf><object id=\"0\"><mesh><vertices>" AMF_VERTEX(0, 0) AMF_VERTEX(1, 0)
    AMF_VERTEX(0, 1) "</vertices><volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume></mesh>"
                     "</object></amf>";
/* A triangle in a layer of LightWave. */
static const char lwo[] = "FORM\0\0\0\x76LWO2TAGS\0\0\0\2a\0LAYR\0\0\0\x12\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0a\0"
                          "PNTS\0\0\0\x24\0\0\0\0\0\0\0\0\0\0\0\0\x3f\x80\0\0\0\0\0\0\0\0\0\0"
                          "\0\0\0\0\x3f\x80\0\0\0\0\0\0POLS\0\0\0\x0c"
                          "FACE\0\3\0\0\0\1\0\2SURF\0\0\0\4a\0\0";
static const char ifc[] = "ISO-10303-21;\n"
                          "HEADER;\n"
                          "FILE_DESCRIPTION((''),'2;1');\n"
                          "FILE_NAME('a','2020-01-01T00:00:00',(''),(''),'','','');\n"
                          "FILE_SCHEMA(('IFC2X3'));\n"
                          "ENDSEC;\n"
                          "DATA;\n"
                          "#2=IFCOWNERHISTORY(#3,#4,$,.ADDED.,$,$,$,0);\n"
                          "#3=IFCPERSONANDORGANIZATION(#5,#6,$);\n"
                          "#4=IFCAPPLICATION(#6,'1','a','a');\n"
                          "#5=IFCPERSON($,'n',$,$,$,$,$,$);\n"
                          "#6=IFCORGANIZATION($,'o',$,$,$);\n"
                          "#1=IFCPROJECT('0YvctVUKr0kugbFTf53O9L',#2,'p',$,$,$,$,(#10),#20);\n"
                          "#10=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,#11,$);\n"
                          "#11=IFCAXIS2PLACEMENT3D(#12,$,$);\n"
                          "#12=IFCCARTESIANPOINT((0.,0.,0.));\n"
                          "#20=IFCUNITASSIGNMENT((#21,#22));\n"
                          "#21=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n"
                          "#22=IFCSIUNIT(*,.PLANEANGLEUNIT.,$,.RADIAN.);\n"
                          "#30=IFCSITE('1YvctVUKr0kugbFTf53O9L',#2,'s',$,$,#31,$,$,.ELEMENT.,$,$,$,$,$);\n"
                          "#31=IFCLOCALPLACEMENT($,#11);\n"
                          "#32=IFCRELAGGREGATES('2YvctVUKr0kugbFTf53O9L',#2,$,$,#1,(#30));\n"
                          "#40=IFCBUILDINGELEMENTPROXY('3YvctVUKr0kugbFTf53O9L',#2,'box',$,$,#41,#50,$,$);\n"
                          "#41=IFCLOCALPLACEMENT(#31,#42);\n"
                          "#42=IFCAXIS2PLACEMENT3D(#43,$,$);\n"
                          "#43=IFCCARTESIANPOINT((10.,0.,0.));\n"
                          "#44=IFCRELCONTAINEDINSPATIALSTRUCTURE('4YvctVUKr0kugbFTf53O9L',#2,$,$,(#40),#30);\n"
                          "#50=IFCPRODUCTDEFINITIONSHAPE($,$,(#51));\n"
                          "#51=IFCSHAPEREPRESENTATION(#10,'Body','SweptSolid',(#60));\n"
                          "#60=IFCEXTRUDEDAREASOLID(#61,#11,#63,3.);\n"
                          "#61=IFCRECTANGLEPROFILEDEF(.AREA.,$,#64,2.,1.);\n"
                          "#63=IFCDIRECTION((0.,0.,1.));\n"
                          "#64=IFCAXIS2PLACEMENT2D(#65,$);\n"
                          "#65=IFCCARTESIANPOINT((0.,0.));\n"
                          "ENDSEC;\n"
                          "END-ISO-10303-21;\n";

static const char skinned[] =
    "{\"asset\": {\"version\": \"2.0\"}, \"scenes\": [{\"nodes\": [0]}], \"nodes\": [{\"mesh\": 0, \"skin\": 0}],"
    "\"skins\": [{\"joints\": [0]}], \"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}}]}],"
    "\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"type\": \"VEC3\", \"count\": 3}],"
    "\"bufferViews\": [{\"buffer\": 0, \"byteLength\": 36}],\"buffers\": [{\"byteLength\": 36, \"uri\": "
    "\"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";

static void memory_may_end_at_any_place(void **state) {
    (void)state;
    write_nodes("nodes.dae");
    write_rich_3mf("rich.3mf");
    assert_true(test_memory_each(read_with_memory, "nodes.dae") > 10);
    write_text("solids.stl", solids);
    assert_true(test_memory_each(read_with_memory, "rich.3mf") > 10);
    assert_true(test_memory_each(read_with_memory, "solids.stl") > 2);
    write_text("turned.x3d", x3d);
    assert_true(test_memory_each(read_with_memory, "turned.x3d") > 2);
    write_text("one.amf", amf);
    assert_true(test_memory_each(read_with_memory, "one.amf") > 2);
    write_bytes("one.lwo", lwo, sizeof lwo);
    assert_true(test_memory_each(read_with_memory, "one.lwo") > 2);
    write_text("skinned.gltf", skinned);
    assert_true(test_memory_each(read_with_memory, "skinned.gltf") > 5);
    write_text("box.ifc", ifc);
    assert_true(test_memory_each(read_with_memory, "box.ifc") > 2);
}

static bool count_down(void *user, double done) {
    int *left = user;
    (void)done;
    return --*left != 0;
}

static void reading_is_cancelled_at_any_call(void **state) {
    static const char *const paths[] = {"nodes.dae", "rich.3mf"};
    (void)state;
    write_nodes("nodes.dae");
    write_rich_3mf("rich.3mf");
    for (size_t i = 0; i < 2; i++) {
        froe_status status = FROE_E_CANCELLED;
        int stop = 1;
        for (; status; stop++) {
            int left = stop;
            froe_scene *scene = NULL;
            froe_read_options o = froe_read_defaults();
            o.progress = count_down, o.user = &left;
            status = froe_read(paths[i], &o, &scene, NULL, NULL);
            assert_true(status == FROE_OK || status == FROE_E_CANCELLED);
            assert_true(!status == (scene != NULL));
            froe_scene_free(scene);
        }
        assert_true(stop > 2);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(many_nodes_are_all_read),
        cmocka_unit_test(names_of_collada_have_to_be_there),
        cmocka_unit_test(last_rows_of_matrices_are_looked_at),
        cmocka_unit_test(nodes_of_later_libraries_are_found),
        cmocka_unit_test(what_collada_says_of_its_numbers_is_looked_at),
        cmocka_unit_test(long_texts_are_refused_once),
        cmocka_unit_test(what_assimp_takes_for_something_else_is_refused),
        cmocka_unit_test(what_assimp_passes_over_of_amf_is_refused),
        cmocka_unit_test(turns_by_nothing_move_no_instance),
        cmocka_unit_test(faces_of_amf_without_a_colour_have_none),
        cmocka_unit_test(long_texts_are_looked_through_in_parts),
        cmocka_unit_test(requirements_of_3mf_are_lists_of_words),
        cmocka_unit_test(corners_without_colours_mix_none),
        cmocka_unit_test(words_between_solids_hide_none),
        cmocka_unit_test(what_objects_consist_of_is_looked_at),
        cmocka_unit_test(what_is_wrong_with_objects_is_said),
        cmocka_unit_test(long_parts_are_refused_by_their_beginning),
        cmocka_unit_test(archives_name_their_model),
        cmocka_unit_test(ends_of_facets_are_in_facets),
        cmocka_unit_test(binary_files_are_as_long_as_their_header_says),
        cmocka_unit_test(what_stands_outside_of_objects_is_no_part_of_one),
        cmocka_unit_test(memory_may_end_at_any_place),
        cmocka_unit_test(reading_is_cancelled_at_any_call),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
