/* What cannot be read: the right status, a message that names the file, silence on
 * stderr, no output; cancelling, many threads at once. */
#include "support.h"
#include <cpl_vsi.h>
#include <fcntl.h>
#include <math.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

static void missing_files_and_folders_are_refused(void **state) {
    (void)state;
    refuse("nowhere.geojson", FROE_E_IO, "nowhere.geojson: The file cannot be read: No such file or directory.");
    mkdir("folder.glb", 0777);
    refuse("folder.glb", FROE_E_FORMAT, "folder.glb: It is a directory, and no map");
    refuse("/dev/null", FROE_E_IO, "/dev/null: It is a device");
    assert_int_equal(mkfifo("pipe.csv", 0600), 0);
    refuse("pipe.csv", FROE_E_IO, "pipe.csv: It is a pipe, not a file.");
    unlink("pipe.csv");
    if (geteuid() == 0) return; /* root reads everything */
    write_text("secret.csv", "x,y\n1,2\n");
    chmod("secret.csv", 0);
    refuse("secret.csv", FROE_E_IO, "Permission denied");
    unlink("secret.csv");
}

/* A folder of shards in which nothing can be looked up is none that the program could know. */
static void folders_that_must_not_be_read_say_so(void **state) {
    (void)state;
    static const unsigned modes[] = {0000, 0444, 0333};
    const bool root = geteuid() == 0; /* who reads everything */
    assert_int_equal(mkdir("secret.froes", 0777), 0);
    write_text("secret.froes/froe.shards", "froe shards 1\n");
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        assert_int_equal(chmod("secret.froes", modes[i]), 0);
        if (root) assert_int_equal(seteuid(65534), 0);
        refuse("secret.froes", FROE_E_IO, "secret.froes: The file cannot be read: Permission denied.");
        if (root) assert_int_equal(seteuid(0), 0);
    }
    assert_int_equal(chmod("secret.froes", 0700), 0);
    unlink("secret.froes/froe.shards"), rmdir("secret.froes");
}

static void files_of_the_wrong_type_are_refused(void **state) {
    (void)state;
    static const char *const endings[] = {"geojson", "json", "shp", "gpkg", "fgb", "dxf",  "osm", "csv", "txt", "xyz",
                                          "obj",     "off",  "ply", "stl",  "glb", "gltf", "ifc", "fbx", "3ds", ""};
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        char path[32];
        snprintf(path, sizeof path, "wrong.%s", endings[i]);
        write_text(path, "");
        refuse(path, FROE_E_FORMAT, "is empty");
        write_text(path, "\x89PNG\r\n\x1a\n and so on, but no scene: a picture");
        refuse(path, FROE_E_FORMAT, path);
        unlink(path);
    }
}

/* assimp tells them behind the name of the file. */
static void reasons_of_bvh_are_told(void **state) {
    (void)state;
    write_text("bones.bvh", "HIERARCHY\nROOT Hips\n{\n  OFFSET 0 0 0\n  CHANNELS 1 Wposition\n}\n");
    refuse("bones.bvh", FROE_E_FORMAT,
           "bones.bvh: The reader assimp reports 'Invalid channel specifier \"Wposition\".'");
}

/* As programs of Windows save it. */
static void text_in_utf16_is_named(void **state) {
    (void)state;
    static const struct {
        const char *path, *text;
    } files[] = {{"wide.csv", "x,y\n1,2\n"},
                 {"wide.txt", "x,y\n1,2\n"},
                 {"wide.geojson", "{\"type\":\"FeatureCollection\",\"features\":[]}"},
                 {"wide.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
                 {"wide.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
                 {"wide.ply", "ply\nformat ascii 1.0\n"}};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        for (int way = 0; way < 4; way++) { /* low or high bytes first, with or without a byte order mark */
            char bytes[256];
            size_t count = 0;
            const int high = way & 1;
            if (way < 2) bytes[high] = (char)0xFF, bytes[1 - high] = (char)0xFE, count = 2;
            for (const char *at = files[i].text; *at; at++, count += 2)
                bytes[count + (size_t)high] = *at, bytes[count + (size_t)(1 - high)] = '\0';
            write_bytes(files[i].path, bytes, count);
            refuse(files[i].path, FROE_E_FORMAT, "The text is in UTF-16, and must be saved in UTF-8.");
            unlink(files[i].path);
        }
}

static void broken_json_is_refused(void **state) {
    (void)state;
    static const char *const texts[] = {
        "{\"type\": \"FeatureCollection\", \"features\": [",
        ("{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\"properties\":{},\"geometry\":{\"type\":"
         "\"Point\",\"coordinates\":[1,2]}},{\"type\":\"Feature\",\"prop"),
        "{\"type\":\"Topology\",\"objects\":{\"a\":{\"type\":\"LineString\",\"arcs\":[0]}},\"arcs\":[[[0,0],[1",
        "{\"type\":\"LineString\",\"coordinates\":[[0,0],[1,1]}",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        write_text("broken.json", texts[i]);
        refuse("broken.json", FROE_E_FORMAT, "broken.json");
    }
    write_text("none.geojson", "{\"type\":\"FeatureCollection\",\"features\":[]}");
    refuse("none.geojson", FROE_E_INPUT, "holds no objects");
}

static void numbers_that_are_none_name_their_feature(void **state) {
    (void)state;
    write_text("nan.geojson", "{\"type\":\"FeatureCollection\",\"features\":["
                              "{\"type\":\"Feature\",\"id\":3,\"properties\":{},\"geometry\":{\"type\":\"LineString\","
                              "\"coordinates\":[[0,0],[1,1]]}},"
                              "{\"type\":\"Feature\",\"id\":8,\"properties\":{},\"geometry\":{\"type\":\"LineString\","
                              "\"coordinates\":[[2,2],[3,NaN]]}}]}");
    refuse("nan.geojson", FROE_E_INPUT, "feature 8 of 'nan': Coordinate y of corner 1 is nan, not a finite number.");
    froe_diagnostic why;
    froe_scene *scene;
    assert_int_equal(froe_read("nan.geojson", NULL, &scene, NULL, &why), FROE_E_INPUT);
    assert_int_equal(why.object, 1);
    assert_int_equal(why.corner, 1);
    assert_int_equal(why.axis, 1);
    write_text("inf.geojson", "{\"type\":\"LineString\",\"coordinates\":[[0,0],[1e999,1]]}");
    refuse("inf.geojson", FROE_E_INPUT, "Coordinate x of corner 1 is inf, not a finite number.");
    write_text("nan.off", "OFF\n3 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n");
    refuse("nan.off", FROE_E_INPUT, "face 0: Coordinate z of corner 1");
    write_text("nan.obj", "v 0 0 0\nv 1 0 inf\nv 0 1 0\nf 1 2 3\n");
    refuse("nan.obj", FROE_E_INPUT, "line 4: Coordinate z of corner 1 is inf, not a finite number.");
}

static void broken_models_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *path, *text;
    } files[] = {
        {"a.off", "OFF\n"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 zero\n3 0 1 2\n"},
        {"a.off", "OFF\n99999999999999999999 1 0\n0 0 0\n"},
        {"a.off", "OFF\n3 -1 0\n0 0 0\n1 0 0\n0 1 0\n"},
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"},
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n"},
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n"},
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf one 2 3\n"},
        {"a.obj", "v 0 0\nf 1 1 1\n"},
        {"a.obj", "once upon a time\n"},
        {"a.stl", "solid a\nfacet normal 0 0"},
        {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"},
        {"a.ply",
         "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nend_header\n0 0\n1 0\n"},
        {"a.ply",
         "ply\nformat ascii 1.0\nelement vertex 999999999\nproperty float x\nproperty float y\nend_header\n0 0\n"},
        {"a.ply", "ply\nformat ascii 1.0\nelement face 1\nproperty list int int vertex_index\nend_header\n1 0\n"},
        {"a.ply", "ply\nformat ascii 1.0\nelement face 1\nproperty list int int vertex_index\nend_header\n-1\n"},
        {"a.ply", "ply\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n"},
        {"a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float z\nend_header\n0 0\n"},
        {"a.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty double x\nproperty char "
                  "y\nend_header\n1234567"},
        {"a.ply", "ply\nformat odd 1.0\nend_header\n"},
        {"a.gltf", "{\"asset\":{\"version\":\"2.0\"},\"scenes\":["},
        {"a.ifc", "ISO-10303-21;\nHEADER;\n"},
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        write_text(files[i].path, files[i].text);
        refuse(files[i].path, FROE_E_FORMAT, files[i].path);
    }
    static const char zero[] = "ply\nformat ascii 1.0\0element vertex 1\nend_header\n";
    write_bytes("zero.ply", zero, sizeof zero - 1);
    refuse("zero.ply", FROE_E_FORMAT, "The header has no end.");
    write_text("b.off", "4OFF\n1 0 0\n0 0 0 0\n");
    refuse("b.off", FROE_E_UNSUPPORTED, "b.off");
    write_text("b.obj", "# v 0 0 0\n");
    refuse("b.obj", FROE_E_FORMAT, "has no vertices");
}

/* Such a file would be a cloud of its points. */
static void strips_of_ply_are_refused(void **state) {
    (void)state;
    write_text("strips.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                             "property float z\nelement tristrips 1\nproperty list int int vertex_indices\n"
                             "end_header\n0 0 0\n1 0 0\n0 1 0\n4 0 1 2 -1\n");
    refuse("strips.ply", FROE_E_UNSUPPORTED,
           "strips.ply: The element 'tristrips' names vertices, which is read of faces and edges alone.");
}

/* They would have their corners at the first vertex, or none. */
static void items_of_ply_without_vertices_are_refused(void **state) {
    (void)state;
    static const struct {
        const char *element, *sentence;
    } cases[] = {{"edge 1\nproperty int v1\nproperty int v2", "Its edges have no vertex1 or no vertex2."},
                 {"edge 1\nproperty int vertex1", "Its edges have no vertex1 or no vertex2."},
                 {"edge 1\nproperty list int int vertex_indices", "Its edges have no vertex1 or no vertex2."},
                 {"face 1\nproperty list int int vertex_list", "Its faces have no list vertex_indices."},
                 {"face 1\nproperty int vertex_indices", "Its faces have no list vertex_indices."}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[400];
        snprintf(text, sizeof text,
                 "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nelement %s\nend_header\n"
                 "1 1\n2 2\n2 0 1\n",
                 cases[i].element);
        write_text("items.ply", text);
        refuse("items.ply", FROE_E_FORMAT, cases[i].sentence);
    }
}

static void wrong_calls_are_refused(void **state) {
    (void)state;
    froe_scene *scene = NULL;
    froe_diagnostic why;
    assert_int_equal(froe_read(NULL, NULL, &scene, NULL, &why), FROE_E_ARG);
    assert_int_equal(froe_read("x.csv", NULL, NULL, NULL, &why), FROE_E_ARG);
    froe_read_options options = {.size = 0};
    assert_int_equal(froe_read("x.csv", &options, &scene, NULL, &why), FROE_E_OPTIONS);
    options = froe_read_defaults();
    options.faces = (froe_faces)7;
    assert_int_equal(froe_read("x.csv", &options, &scene, NULL, NULL), FROE_E_OPTIONS);
    assert_null(scene);
    options = froe_read_defaults();
    options.layer = "roof";
    refuse_with(FROE_TEST_DATA "/fzk-haus.glb", &options, FROE_E_OPTIONS, "and has no layers.");
    options.layer = NULL;
    options.where = "x > 3";
    refuse_with(FROE_TEST_DATA "/fzk-haus-boxes.csv", &options, FROE_E_OPTIONS, "no attributes");
}

/* ------------------------------------------------------------------ silence -- */

static void nothing_is_printed(void **state) {
    (void)state;
    int kept[2] = {dup(1), dup(2)}, file = open("said.txt", O_RDWR | O_CREAT | O_TRUNC, 0666);
    assert_true(file >= 0 && kept[0] >= 0 && kept[1] >= 0);
    fflush(NULL);
    dup2(file, 1);
    dup2(file, 2);
    static const char *const paths[] = {"broken.json", "nan.geojson", "wrong.shp", "a.stl", "a.ply", "a.gltf", "a.ifc"};
    write_text("wrong.shp", "no shapes");
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        froe_scene *scene = NULL;
        if (froe_read(paths[i], NULL, &scene, NULL, NULL) == FROE_OK) froe_scene_free(scene);
    }
    fflush(NULL);
    off_t said = lseek(file, 0, SEEK_END);
    dup2(kept[0], 1);
    dup2(kept[1], 2);
    close(kept[0]);
    close(kept[1]);
    close(file);
    assert_int_equal(said, 0);
}

/* ------------------------------------------------------------------- cancel -- */

typedef struct patience {
    int calls, most;
    double last;
} patience;

static bool count_down(void *user, double done) {
    patience *p = user;
    assert_true(done >= 0 && done <= 1);
    p->last = done;
    return ++p->calls <= p->most;
}

static void check_cancel(const char *path) {
    test_memory memory;
    froe_allocator alloc = test_memory_begin(&memory);
    froe_read_options options = froe_read_defaults();
    patience p = {.most = 1 << 20};
    options.progress = count_down;
    options.user = &p;
    options.alloc = &alloc;
    froe_scene_free(read_with(path, &options, NULL));
    assert_true(p.calls > 0);
    assert_true(p.last == 1);
    int calls = p.calls;
    for (int most = 0; most < calls; most++) {
        p = (patience){.most = most};
        refuse_with(path, &options, FROE_E_CANCELLED, "Cancelled.");
        assert_int_equal(p.calls, most + 1);
    }
    test_memory_end(&memory);
}

static void every_reader_can_be_cancelled_at_every_report(void **state) {
    (void)state;
    check_cancel(FROE_TEST_DATA "/freedoom-e1m1.geojson");
    check_cancel(FROE_TEST_DATA "/states-albers-10m.json");
    check_cancel(FROE_TEST_DATA "/utah-teapot.obj");
    check_cancel(FROE_TEST_DATA "/fzk-haus.glb");
    check_cancel(FROE_TEST_DATA "/fzk-haus-boxes.csv");
}

/* ------------------------------------------------------------------- memory -- */

typedef struct reading {
    const char *path;
    froe_read_options options;
} reading;

static froe_status read_and_free(void *user, const froe_allocator *alloc) {
    reading *r = user;
    r->options.alloc = alloc;
    froe_scene *scene = NULL;
    froe_status status = froe_read(r->path, &r->options, &scene, NULL, NULL);
    assert_true((status == FROE_OK) == (scene != NULL));
    froe_scene_free(scene);
    return status;
}

/* A part of an archive. */
static void write_part(const char *name, const char *text) {
    VSILFILE *file = VSIFOpenL(name, "wb");
    assert_non_null(file);
    assert_int_equal(VSIFWriteL(text, 1, strlen(text), file), strlen(text));
    assert_int_equal(VSIFCloseL(file), 0);
}

/* A triangle and a component of two colours, and one in another part. */
static void write_3mf(void) {
    VSILFILE *archive = VSIFOpenL("/vsizip/{m.3mf}", "wb");
    assert_non_null(archive);
    write_part("/vsizip/{m.3mf}/_rels/.rels",
               "<Relationships><Relationship Target=\"/a\" Type=\"x/3dmodel\"/></Relationships>");
#define MESH(more)                                                                                                     \
    "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"1\" y=\"0\" z=\"0\"/><vertex x=\"0\" y=\"1\" "       \
    "z=\"0\"/>"                                                                                                        \
    "</vertices><triangles><triangle v1=\"0\" v2=\"1\" v3=\"2\"" more "/></triangles></mesh>"
    write_part(
        "/vsizip/{m.3mf}/a",
        "<model><resources><basematerials id=\"5\"><base name=\"red\" "
        "displaycolor=\"#FF0000\"/><base "
        "name=\"blue\" displaycolor=\"#0000FF\"/></basematerials><object id=\"1\" "
        "name=\"one\">" MESH(" pid=\"5\" p1=\"0\" p2=\"1\" p3=\"0\"") "</object><object id=\"2\" pid=\"5\" "
                                                                      "pindex=\"1\">" MESH("") "</object>"
                                                                                               "<object "
                                                                                               "id=\"3\"><"
                                                                                               "components><"
                                                                                               "component "
                                                                                               "objectid=\"1\"/"
                                                                                               "><component "
                                                                                               "path=\"/b\" "
                                                                                               "objectid=\"1\"/>"
                                                                                               "</components></"
                                                                                               "object></"
                                                                                               "resources><build><"
                                                                                               "item "
                                                                                               "objectid=\"3\"/"
                                                                                               "><item "
                                                                                               "objectid=\"2\"/></"
                                                                                               "build></model>");
    write_part("/vsizip/{m.3mf}/b",
               "<model><resources><object id=\"1\" name=\"other\">" MESH("") "</object></resources></model>");
    assert_int_equal(VSIFCloseL(archive), 0);
}

/* Maps are read from archives, and models are not; of several maps one has to be named. */
static void what_is_in_an_archive_is_said(void **state) {
    (void)state;
    static const char map[] = "{\"type\":\"LineString\",\"coordinates\":[[0,0],[1,1]]}", off[] = "OFF\n1 0 0\n0 0 0\n";
    static const struct {
        const char *names[2], *texts[2], *message; /* NULL: it is read */
    } cases[] = {
        {{"map.geojson"}, {map}, NULL},
        {{"map.csv"}, {"x,y\n1,2\n"}, NULL},
        {{"map.csv"}, {"name,WKT\na,\"POINT (1 2)\"\n"}, NULL},
        {{"a.stl"}, {off}, "many.zip: Models are not read from archives, and 'a.stl' must be unpacked first."},
        {{"note.txt", "in/a.glb"},
         {"", off},
         "many.zip: Models are not read from archives, and 'in/a.glb' must be unpacked"},
        {{"note.md", "in/more.md"},
         {"# a", "# b"},
         "many.zip: No single map is in it, but: note.md, in. One of them is"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        unlink("many.zip");
        VSILFILE *archive = VSIFOpenL("/vsizip/{many.zip}", "wb");
        assert_non_null(archive);
        for (int k = 0; k < 2 && cases[i].names[k]; k++) {
            char name[64];
            snprintf(name, sizeof name, "/vsizip/{many.zip}/%s", cases[i].names[k]);
            write_part(name, cases[i].texts[k]);
        }
        assert_int_equal(VSIFCloseL(archive), 0);
        if (cases[i].message) {
            refuse("many.zip", FROE_E_FORMAT, cases[i].message);
            continue;
        }
        froe_scene *scene = read_scene("many.zip", NULL);
        assert_int_equal(froe_scene_object_count(scene), 1);
        froe_scene_free(scene);
    }
    VSILFILE *packed = VSIFOpenL("/vsigzip/a.off.gz", "wb");
    assert_int_equal(VSIFWriteL(off, 1, sizeof off - 1, packed), sizeof off - 1);
    assert_int_equal(VSIFCloseL(packed), 0);
    refuse("a.off.gz", FROE_E_FORMAT,
           "a.off.gz: Models are not read from archives, and 'a.off.gz' must be unpacked first.");
    packed = VSIFOpenL("/vsigzip/a-model-with-a-name-of-many-letters.glb.gz", "wb");
    assert_int_equal(VSIFWriteL(off, 1, sizeof off - 1, packed), sizeof off - 1);
    assert_int_equal(VSIFCloseL(packed), 0);
    refuse("a-model-with-a-name-of-many-letters.glb.gz", FROE_E_FORMAT,
           ": Models are not read from archives, and 'a-model");
}

static void every_failing_allocation_gives_a_status(void **state) {
    (void)state;
    write_3mf();
    write_text("m.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
               "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
               "property list uchar int vertex_index\nelement edge 1\nproperty int vertex1\n"
               "property int vertex2\nend_header\n0 0 0 255 0 0\n1 0 0 0 0 255\n0 1 0 0 0 255\n3 0 1 2\n0 1\n");
    write_text("c.off",
               "COFF\n4 2 0\n0 0 0 255 0 0\n2 0 0 0 0 255\n2 2 0 0 0 255\n0 2 0 0 0 0\n4 0 1 2 3\n3 0 1 2 0 1 0\n");
    write_text("m.csv", "lo_x,lo_y,hi_x,hi_y,tag\n0,0,1,1,7\n2,2,3,3,8\n");
    write_text("m2.csv", "x,y,r\n0,0,1\n2,2,3\n");
    write_text("m.off", "OFF\n5 2 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n1 1 1\n4 0 1 2 3\n4 0 1 2 4\n");
    write_text("m.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\no a\nusemtl b\nf 1 2 3 4\no c\nf 1 2 3\n");
    write_text("m.geojson", "{\"type\":\"Feature\",\"properties\":{\"name\":\"n\"},\"geometry\":{\"type\":\"Polygon\","
                            "\"coordinates\":[[[0,0],[9,0],[0,9],[0,0]],[[1,1],[1,2],[2,1],[1,1]]]}}");
    write_text("m.gltf",
               "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
               "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{\"bufferView\":0,"
               "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,"
               "\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;"
               "base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}");
    static const char *const paths[] = {"m.csv",  "m2.csv", "m.off", "m.obj", "m.geojson",
                                        "m.gltf", "m.3mf",  "m.ply", "c.off"};
    for (size_t i = 0; i < 2 * sizeof paths / sizeof *paths; i++) {
        reading r = {.path = paths[i / 2], .options = froe_read_defaults()};
        r.options.boxes = i % 2;
        r.options.faces = FROE_FACES_POLYGONS;
        assert_true(test_memory_each(read_and_free, &r) > 3);
    }
}

/* ------------------------------------------------------------------ threads -- */

static void *read_many(void *user) {
    static const char *const paths[] = {FROE_TEST_DATA "/freedoom-e1m1.geojson",
                                        FROE_TEST_DATA "/fzk-haus.glb",
                                        "a.gltf",
                                        "broken.json",
                                        FROE_TEST_DATA "/fzk-haus-boxes.csv",
                                        "a.stl"};
    static const size_t objects[] = {812, 35906, 0, 0, 110, 0};
    size_t wrong = 0;
    for (size_t i = 0; i < 12; i++) {
        froe_scene *scene = NULL;
        froe_diagnostic why = {.message = ""};
        size_t at = (i + (size_t)(uintptr_t)user) % 6;
        froe_status status = froe_read(paths[at], NULL, &scene, NULL, &why);
        if (status) wrong += objects[at] != 0 || !strstr(why.message, paths[at]);
        if (!status) wrong += froe_scene_object_count(scene) != objects[at];
        froe_scene_free(scene);
    }
    return (void *)(uintptr_t)wrong;
}

static void many_threads_read_at_once(void **state) {
    (void)state;
    pthread_t threads[4];
    for (size_t i = 0; i < 4; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, read_many, (void *)(uintptr_t)i), 0);
    for (size_t i = 0; i < 4; i++) {
        void *wrong;
        assert_int_equal(pthread_join(threads[i], &wrong), 0);
        assert_null(wrong);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(missing_files_and_folders_are_refused),
        cmocka_unit_test(folders_that_must_not_be_read_say_so),
        cmocka_unit_test(files_of_the_wrong_type_are_refused),
        cmocka_unit_test(reasons_of_bvh_are_told),
        cmocka_unit_test(text_in_utf16_is_named),
        cmocka_unit_test(broken_json_is_refused),
        cmocka_unit_test(numbers_that_are_none_name_their_feature),
        cmocka_unit_test(broken_models_are_refused),
        cmocka_unit_test(strips_of_ply_are_refused),
        cmocka_unit_test(items_of_ply_without_vertices_are_refused),
        cmocka_unit_test(wrong_calls_are_refused),
        cmocka_unit_test(nothing_is_printed),
        cmocka_unit_test(every_reader_can_be_cancelled_at_every_report),
        cmocka_unit_test(what_is_in_an_archive_is_said),
        cmocka_unit_test(every_failing_allocation_gives_a_status),
        cmocka_unit_test(many_threads_read_at_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
