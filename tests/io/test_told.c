/* test_told.c: what assimp and GDAL would pass over, or tell in their logs alone: indices, lists and ends of LightWave,
 * entities of IFC that are not there or came later, faces and axes of FBX, sorts of entities of DXF. */
#include "check/check.h"
#include "support.h"
#include <assimp/cimport.h>
#include <assimp/scene.h>

/* Reads what must be readable, of so many objects, with sorts left out. */
static void expect(const char *path, size_t objects, const char *left) {
    froe_read_report report;
    froe_scene *scene = read_scene(path, &report);
    if (froe_scene_object_count(scene) != objects || strcmp(report.sorts_left, left) != 0)
        fail_msg("%s: %zu objects, and '%s' are left out", path, froe_scene_object_count(scene), report.sorts_left);
    froe_scene_free(scene);
}

/* --------------------------------------------------------------------- LightWave -- */

typedef struct chunks {
    char bytes[512];
    size_t used;
} chunks;

/* A name, a length with the highest byte first, and as many bytes. */
static void put_chunk(chunks *c, const char *name, const char *bytes, size_t size) {
    const char length[4] = {0, 0, (char)(size >> 8), (char)size};
    assert_true(c->used + 8 + size <= sizeof c->bytes);
    memcpy(c->bytes + c->used, name, 4);
    memcpy(c->bytes + c->used + 4, length, 4);
    memcpy(c->bytes + c->used + 8, bytes, size);
    c->used += 8 + size;
}

#define ONE "\x3f\x80\0\0"
#define NIL "\0\0\0\0"
static const char points[] = NIL NIL NIL ONE NIL NIL ONE ONE NIL;
static const char layer[16] = "";

/* One layer of three points, and what else is in it. */
static void write_layer(const char *path, const char *type, const char *more, size_t size) {
    chunks form = {.used = 0}, all = {.used = 0};
    memcpy(form.bytes, type, 4), form.used = 4;
    put_chunk(&form, "TAGS", "a\0", 2);
    put_chunk(&form, "LAYR", layer, sizeof layer);
    put_chunk(&form, "PNTS", points, 36);
    memcpy(form.bytes + form.used, more, size), form.used += size;
    put_chunk(&form, "SURF", "a\0\0\0", 4);
    put_chunk(&all, "FORM", form.bytes, form.used);
    write_bytes(path, all.bytes, all.used);
}

static void polygons_of_lightwave_name_points_that_are_there(void **state) {
    (void)state;
#define BYTES(text) text, sizeof(text) - 1
#define LIST(length, polygons) "POLS\0\0\0" length "FACE" polygons
#define TRIANGLE LIST("\x0c", "\0\3\0\0\0\1\0\2")
    static const char beyond[] = "layer.lwo: layer 1: A polygon names a point that does not exist.";
    static const struct {
        const char *bytes;
        size_t size;
        const char *message; /* NULL: there is a triangle */
    } cases[] = {
        {BYTES(TRIANGLE), NULL},
        {BYTES(LIST("\x0e", "\0\3\0\0\0\1\xff\0\0\2")), NULL}, /* an index of four bytes */
        {BYTES(LIST("\x0c", "\x04\3\0\0\0\1\0\2")), NULL},     /* the highest bits are flags */
        {BYTES(LIST("\x0c", "\0\3\0\0\0\1\0\3")), beyond},     /* the number of points is no point */
        {BYTES(LIST("\x0e", "\0\3\0\0\0\1\xff\0\0\3")), beyond},
        {BYTES(LIST("\x0c", "\0\3\0\0\0\1\xff\2")), beyond}, /* four bytes that are cut off */
        {BYTES(LIST("\x0a", "\0\3\0\0\0\1")), beyond},       /* cut off behind an index */
        {BYTES(LIST("\x0b", "\0\3\0\0\0\1\0\0")), beyond},   /* and within one: chunks have even lengths */
        {BYTES(LIST("\x0e", "\0\0\0\3\0\0\0\1\0\2")),
         "layer.lwo: The reader assimp reports 'LWO2: Encountered invalid face record with zero indices'."},
        {BYTES("POLS\0\0\0\2\0\0" LIST("\x0c", "\0\3\0\0\0\1\0\3")), beyond}, /* the first list has no type */
        {BYTES(TRIANGLE TRIANGLE),
         "layer.lwo: layer 1: It has several lists of polygons (POLS), of which one alone would be read."},
        {BYTES(TRIANGLE "LAYR\0\0\0\x10\0\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0" TRIANGLE),
         "layer.lwo: layer 2: A polygon names a point that does not exist."},
        {BYTES(TRIANGLE "SURF\0\1\0\0"), "layer.lwo: The reader assimp reports 'LWO2: Chunk length points behind the"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_layer("layer.lwo", "LWO2", cases[i].bytes, cases[i].size);
        if (cases[i].message)
            refuse("layer.lwo", FROE_E_FORMAT, cases[i].message);
        else
            expect("layer.lwo", 1, "");
    }
    write_layer("layer.lwo", "LWOC", BYTES(TRIANGLE)); /* of no version that there is */
    refuse("layer.lwo", FROE_E_FORMAT, "layer.lwo: The reader assimp reports 'Unknown LWO sub format: LWOC'.");
}

/* ----------------------------------------------------------------------------- IFC -- */

/* A solid over a profile, of which the shape consists with other items, in a site with other things; it ends so. */
static void write_ifc(const char *path, const char *items, const char *more, const char *end) {
    static const char head[] =
        "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
        "FILE_NAME('a','2020-01-01T00:00:00',(''),(''),'','','');\nFILE_SCHEMA(('IFC2X3'));\nENDSEC;\nDATA;\n"
        "#1=IFCPROJECT('0YvctVUKr0kugbFTf53O9L',#2,'p',$,$,$,$,(#10),#20);\n"
        "#2=IFCOWNERHISTORY(#3,#4,$,.ADDED.,$,$,$,0);\n#3=IFCPERSONANDORGANIZATION(#5,#6,$);\n"
        "#4=IFCAPPLICATION(#6,'1','a','a');\n#5=IFCPERSON($,'n',$,$,$,$,$,$);\n#6=IFCORGANIZATION($,'o',$,$,$);\n"
        "#10=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,#11,$);\n#11=IFCAXIS2PLACEMENT3D(#12,$,$);\n"
        "#12=IFCCARTESIANPOINT((0.,0.,0.));\n#20=IFCUNITASSIGNMENT((#21));\n"
        "#21=IFCSIUNIT(*,.LENGTHUNIT.,$,.METRE.);\n#30=IFCSITE('1YvctVUKr0kugbFTf53O9L',#2,'s',$,$,#31,$,$,"
        ".ELEMENT.,$,$,$,$,$);\n#31=IFCLOCALPLACEMENT($,#11);\n"
        "#32=IFCRELAGGREGATES('2YvctVUKr0kugbFTf53O9L',#2,$,$,#1,(#30));\n"
        "#40=IFCBUILDINGELEMENTPROXY('3YvctVUKr0kugbFTf53O9L',#2,'box',$,$,#31,#50,$,$);\n"
        "#44=IFCRELCONTAINEDINSPATIALSTRUCTURE('4YvctVUKr0kugbFTf53O9L',#2,$,$,(#40),#30);\n"
        "#50=IFCPRODUCTDEFINITIONSHAPE($,$,(#51));\n#60=IFCEXTRUDEDAREASOLID(#61,#11,#63,3.);\n"
        "#61=IFCRECTANGLEPROFILEDEF(.AREA.,$,#64,2.,1.);\n#63=IFCDIRECTION((0.,0.,1.));\n"
        "#64=IFCAXIS2PLACEMENT2D(#65,$);\n#65=IFCCARTESIANPOINT((0.,0.));\n";
    char text[4096];
    assert_true((size_t)snprintf(text, sizeof text,
                                 "%s#51=IFCSHAPEREPRESENTATION(#10,'Body','SweptSolid',(#60%s));\n%s%s", head, items,
                                 more, end) < sizeof text);
    write_text(path, text);
}

static const char whole[] = "ENDSEC;\nEND-ISO-10303-21;\n";
enum { BOX = 12 }; /* triangles */

static void entities_of_ifc_are_there_and_known(void **state) {
    (void)state;
    static const char pipe[] = "#81=IFCPIPESEGMENT('6YvctVUKr0kugbFTf53O9L',#2,'e',$,$,#31,#50,$,$);\n";
    static const char unread[] = "house.ifc: Entity #81 is an IFCPIPESEGMENT, which came with IFC4 and is not read.";
#define PARTS(of, these) "#80=IFCRELAGGREGATES('7YvctVUKr0kugbFTf53O9L'," of "," these ");\n"
    static const struct {
        const char *items, *more, *end;
        froe_status status;
        const char *message;
    } cases[] = {
        {",#99", "", whole, FROE_E_FORMAT,
         "house.ifc: Entity #99, which #51 (IFCSHAPEREPRESENTATION) names, is not in the file."},
        {",#70", "#70 = IfcTriangulatedFaceSet(#71,$,.T.,((1,2,3)),$);\n", whole, FROE_E_UNSUPPORTED,
         "house.ifc: Entity #70 is an IFCTRIANGULATEDFACESET, which came with IFC4 and is not read. IFC2x3 is."},
        {"", pipe, whole, FROE_OK, NULL}, /* nothing names it */
        {"", "/* #80=IFCPOLYLINE((#99)); */\n#82=IFCLABEL('#99''s / #98');\n#83=AB();\n", whole, FROE_OK, NULL},
        {"", PARTS("#2,$,$,#81", "(#99)"), whole, FROE_E_FORMAT, "Entity #81, which #80 (IFCRELAGGREGATES) names,"},
        /* parts of what is unknown are not looked for, and unknown parts are refused */
        {"", PARTS("#2,$,$,#81", "(#99)") "#81=IFCCHIMNEY($);\n", whole, FROE_OK, NULL},
        {"", PARTS("#2,$,$,#30", "(#40,#81)") "#81=IFCPIPESEGMENT($);\n", whole, FROE_E_UNSUPPORTED, unread},
        {"", "", "ENDSEC;\n", FROE_E_FORMAT,
         "house.ifc: The file does not end with END-ISO-10303-21, so that parts may be missing."},
        {"", "", "#99=IFCPOLYLINE((#12,#98)END-ISO-10303-21", FROE_E_FORMAT, "Entity #98, which #99 (IFCPOLYLINE)"},
        {"", "", "#99=IFCPOLYLINE((#12,#12)END-ISO-10303-21", FROE_E_FORMAT,
         "house.ifc: The reader assimp reports 'STEP: ignoring unexpected EOF'."},
        {"", "", "/* END-ISO-10303-21;\n", FROE_E_FORMAT,
         "house.ifc: The reader assimp reports 'STEP: ignoring unexpected EOF'."},
        {"", "#61=IFCRECTANGLEPROFILEDEF(.AREA.,$,#64,5.,5.);\n", whole, FROE_E_FORMAT,
         "house.ifc: The reader assimp reports '(line 31) an object with the id #61 already exists'."},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_ifc("house.ifc", cases[i].items, cases[i].more, cases[i].end);
        if (cases[i].status)
            refuse("house.ifc", cases[i].status, cases[i].message);
        else
            expect("house.ifc", BOX, "");
    }
}

/* assimp knows IFC by its first bytes, whatever the name ends in. */
static void ifc_has_any_ending(void **state) {
    (void)state;
    static const char *const endings[] = {"ifc", "IFC", "step", "stp", "txt", "lwo"};
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        char path[16];
        snprintf(path, sizeof path, "any.%s", endings[i]);
        write_ifc(path, ",#99", "", whole);
        refuse(path, FROE_E_FORMAT, "Entity #99, which #51 (IFCSHAPEREPRESENTATION) names, is not in the file.");
        write_ifc(path, "", "", whole);
        if (i < 4) expect(path, BOX, ""); /* of others assimp takes it for something else */
    }
}

/* Each sort is named once, as many as there is room for; the first damage is told. */
static void sorts_that_assimp_leaves_out_are_named(void **state) {
    (void)state;
#define CONE "#73=IFCRIGHTCIRCULARCONE(#11,1.,1.);\n"
#define WORDS "#71=IFCTEXTLITERALWITHEXTENT('a',#11,.LEFT.,#79,'b');\n#72=IFCTEXTLITERAL('a',#11,.LEFT.);\n"
    static const struct {
        const char *items, *more, *left;
    } cases[] = {
        {",#70,#72", "#70=IFCBLOCK(#11,1.,2.,3.);\n#72=IFCSPHERE(#11,2.);\n", "IfcBlock, IfcSphere"},
        {",#70,#74", "#70=IFCBLOCK(#11,1.,2.,3.);\n#74=IFCBLOCK(#11,1.,2.,4.);\n", "IfcBlock"}, /* one line for both */
        {",#70,#72,#74", "#70=IFCBLOCK(#11,1.,2.,3.);\n#72=IFCSPHERE(#11,2.);\n#74=IFCBLOCK(#11,1.,2.,4.);\n",
         "IfcBlock, IfcSphere"},
        {",#71,#72", WORDS "#79=IFCPLANAREXTENT(1.,1.);\n", "IfcTextLiteralWithExtent, IfcTextLiteral"},
        {",#73,#74,#75,#76",
         CONE "#74=IFCRIGHTCIRCULARCYLINDER(#11,1.,1.);\n#75=IFCRECTANGULARPYRAMID(#11,1.,1.,1.);\n"
              "#76=IFCBLOCK(#11,1.,2.,3.);\n",
         "IfcRightCircularCone, IfcRightCircularCylinder"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_ifc("sorts.ifc", cases[i].items, cases[i].more, whole);
        expect("sorts.ifc", BOX, cases[i].left);
    }
    write_ifc("twice.ifc", "", "#65=IFCCARTESIANPOINT((0.,1.));\n#64=IFCAXIS2PLACEMENT2D(#65,$);\n", whole);
    refuse("twice.ifc", FROE_E_FORMAT, "an object with the id #65 already exists'.");
}

/* ----------------------------------------------------------------------------- FBX -- */

/* A square, whose axis that points up has that number and sign. */
static void write_fbx(const char *path, int up, int sign, const char *corners) {
    char text[1024];
    snprintf(text, sizeof text,
             "; FBX 7.4.0 project file\nFBXHeaderExtension: {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7400\n}\n"
             "GlobalSettings: {\n\tVersion: 1000\n\tProperties70: {\n\t\tP: \"UpAxis\", \"int\", \"Integer\", \"\",%d\n"
             "\t\tP: \"UpAxisSign\", \"int\", \"Integer\", \"\",%d\n\t}\n}\nObjects: {\n"
             "\tGeometry: 100, \"Geometry::a\", \"Mesh\" {\n"
             "\t\tVertices: *12 {\n\t\t\ta: 0,0,0,1,0,0,1,2,0,0,2,0\n\t\t}\n"
             "\t\tPolygonVertexIndex: *6 {\n\t\t\ta: %s\n\t\t}\n\t\tGeometryVersion: 124\n\t}\n"
             "\tModel: 200, \"Model::a\", \"Mesh\" {\n\t\tVersion: 232\n\t}\n}\n"
             "Connections: {\n\tC: \"OO\",100,200\n\tC: \"OO\",200,0\n}\n",
             up, sign, corners);
    write_text(path, text);
}

/* An axis that is none is taken for z, and one that points down for one that points up. */
static void axes_of_fbx_are_looked_at(void **state) {
    (void)state;
    static const struct {
        int up, sign, read;
        const char *left;
    } cases[] = {{0, 1, 0, ""}, {1, 1, 1, ""},  {2, 1, 2, ""},
                 {3, 1, 2, ""}, {-1, 1, 2, ""}, {1, -1, 1, "UpAxisSign -1"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_read_report report;
        write_fbx("axes.fbx", cases[i].up, cases[i].sign, "0,1,-3,0,2,-4");
        froe_scene *scene = read_scene("axes.fbx", &report);
        assert_int_equal(froe_scene_object_count(scene), 2);
        assert_int_equal(froe_scene_up(scene), cases[i].read);
        assert_string_equal(report.sorts_left, cases[i].left);
        froe_scene_free(scene);
    }
    write_fbx("axes.fbx", 1, 1, "0,1,-3,0,2,-100");
    refuse("axes.fbx", FROE_E_FORMAT,
           "axes.fbx: The reader assimp reports 'FBX-DOM (TOK_KEY, line 18, col 27) polygon");
}

enum { MODELS = 3, FIRST = 200, MOST_LINKS = 5, DEEP = 1001 };

/* Models 200, 201 and so on, of which the first has a square, and which is below which; 0 ends that. */
typedef struct fbx_links {
    int links[MOST_LINKS][2];
} fbx_links;

static void write_fbx_text(const char *path, const fbx_links *l, int models) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "; FBX 7.4.0 project file\nFBXHeaderExtension: {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7400\n}\n"
                  "GlobalSettings: {\n\tVersion: 1000\n}\nObjects: {\n\tGeometry: 100, \"Geometry::a\", \"Mesh\" {\n"
                  "\t\tVertices: *12 {\n\t\t\ta: 0,0,0,1,0,0,1,2,0,0,2,0\n\t\t}\n"
                  "\t\tPolygonVertexIndex: *4 {\n\t\t\ta: 0,1,2,-4\n\t\t}\n\t\tGeometryVersion: 124\n\t}\n");
    for (int i = FIRST; i < FIRST + models; i++)
        fprintf(file, "\tModel: %d, \"Model::m%d\", \"Mesh\" {\n\t\tVersion: 232\n\t}\n", i, i);
    fprintf(file, "}\nConnections: {\n\tC: \"OO\",100,200\n");
    for (int i = 0; i < MOST_LINKS && l->links[i][0]; i++)
        fprintf(file, "\tC: \"OO\" , %d,\t%d\n", l->links[i][0], l->links[i][1]);
    for (int i = FIRST + MODELS; i < FIRST + models; i++) fprintf(file, "\tC: \"OO\",%d,%d\n", i - 1, i);
    fprintf(file, "}\n");
    assert_int_equal(fclose(file), 0);
}

/* Records of a binary file: where they begin, and what their heads say at the end. */
typedef struct fbx_bytes {
    char bytes[4096];
    size_t count, width;
} fbx_bytes;

static void put_number(char *at, uint64_t number, size_t width) {
    for (size_t i = 0; i < width; i++) at[i] = (char)(number >> 8 * i);
}

static void put_bytes(fbx_bytes *f, const void *bytes, size_t count) {
    assert_true(f->count + count <= sizeof f->bytes);
    memcpy(f->bytes + f->count, bytes, count);
    f->count += count;
}

static size_t open_record(fbx_bytes *f, const char *name) {
    const char letters = (char)strlen(name);
    const size_t at = f->count;
    put_bytes(f, (const char[24]){0}, 3 * f->width);
    put_bytes(f, &letters, 1);
    put_bytes(f, name, strlen(name));
    return at;
}

static void put_property(fbx_bytes *f, size_t record, char kind, uint64_t number, const void *bytes, size_t width) {
    char head[9] = {kind};
    put_number(head + 1, number, width);
    put_bytes(f, head, 1 + width);
    if (bytes) put_bytes(f, bytes, number);
    char *at = f->bytes + record;
    put_number(at + f->width, (unsigned char)at[f->width] + 1u, f->width);
    put_number(at + 2 * f->width, f->count - record - 3 * f->width - 1 - (unsigned char)at[3 * f->width], f->width);
}

/* With others in it there is an empty one at their end. */
static void close_record(fbx_bytes *f, size_t record, bool others) {
    if (others) put_bytes(f, (const char[25]){0}, 3 * f->width + 1);
    put_number(f->bytes + record, f->count, f->width);
}

static void put_whole(fbx_bytes *f, const char *name, uint64_t number) {
    const size_t at = open_record(f, name);
    put_property(f, at, 'I', number, NULL, 4);
    close_record(f, at, false);
}

static void put_array(fbx_bytes *f, const char *name, char kind, const void *numbers, size_t count, size_t size) {
    const size_t at = open_record(f, name);
    char head[8] = {0};
    put_number(head + 4, count * size, 4);
    put_property(f, at, kind, count, NULL, 4);
    put_bytes(f, head, sizeof head), put_bytes(f, numbers, count * size);
    put_number(f->bytes + at + 2 * f->width, 13 + count * size, f->width);
    close_record(f, at, false);
}

static size_t open_object(fbx_bytes *f, const char *sort, uint64_t id) {
    const size_t at = open_record(f, sort);
    char name[16] = "a", length = (char)(strlen(sort) + 3);
    memcpy(name + 2, "\1", 1), memcpy(name + 3, sort, strlen(sort));
    put_property(f, at, 'L', id, NULL, 8);
    put_property(f, at, 'S', (unsigned char)length, name, 4);
    put_property(f, at, 'S', 4, "Mesh", 4);
    return at;
}

static size_t write_fbx_bytes(const char *path, const fbx_links *l, unsigned version) {
    static const double places[] = {0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 2, 0};
    static const int32_t indices[] = {0, 1, 2, -4};
    fbx_bytes f = {.width = version < 7500 ? 4 : 8};
    put_bytes(&f, "Kaydara FBX Binary  \0\x1a", 23);
    put_bytes(&f, (const char[4]){0}, 4), put_number(f.bytes + 23, version, 4);
    size_t at = open_record(&f, "FBXHeaderExtension");
    put_whole(&f, "FBXHeaderVersion", 1003), put_whole(&f, "FBXVersion", version), close_record(&f, at, true);
    at = open_record(&f, "GlobalSettings"), put_whole(&f, "Version", 1000), close_record(&f, at, true);
    at = open_record(&f, "Objects");
    const size_t mesh = open_object(&f, "Geometry", 100);
    put_array(&f, "Vertices", 'd', places, 12, 8), put_array(&f, "PolygonVertexIndex", 'i', indices, 4, 4);
    put_whole(&f, "GeometryVersion", 124), close_record(&f, mesh, true);
    for (uint64_t i = FIRST; i < FIRST + MODELS; i++) {
        const size_t model = open_object(&f, "Model", i);
        put_whole(&f, "Version", 232), close_record(&f, model, true);
    }
    close_record(&f, at, true), at = open_record(&f, "Connections");
    for (int i = -1; i < MOST_LINKS && (i < 0 || l->links[i][0]); i++) {
        const size_t link = open_record(&f, "C");
        put_property(&f, link, 'S', 2, "OO", 4);
        for (int k = 0; k < 2; k++)
            put_property(&f, link, 'L', i < 0 ? 100u * (unsigned)(k + 1) : (uint64_t)l->links[i][k], NULL, 8);
        close_record(&f, link, false);
    }
    close_record(&f, at, true);
    put_bytes(&f, (const char[200]){0}, 200);
    write_bytes(path, f.bytes, f.count);
    return f.count;
}

/* assimp would end the program. */
static void models_of_fbx_have_a_first_one(void **state) {
    (void)state;
    static const struct {
        fbx_links links;
        const char *refused; /* NULL: it is read */
        size_t objects;
    } cases[] = {
        {{{{200, 0}}}, NULL, 2},
        {{{{200, 201}, {201, 202}, {202, 0}}}, NULL, 2},
        {{{{200, 0}, {200, 201}, {201, 0}}}, NULL, 4},
        {{{{200, 201}, {200, 202}, {201, 0}, {202, 0}}}, NULL, 4},
        {{{{100, 100}, {200, 0}, {0, 200}}}, NULL, 2}, /* other objects may be connected in circles */
        {{{{200, 0}, {200, 200}}}, "links.fbx: model 200: It is its own parent, or a parent of its parents.", 0},
        {{{{200, 0}, {201, 202}, {200, 201}, {202, 201}}}, "links.fbx: model 201: It is its own parent", 0},
        {{{{200, 0}, {200, 201}, {201, 202}, {202, 200}}}, "links.fbx: model 200: It is its own parent", 0},
    };
    for (size_t i = 0; i < 3 * (sizeof cases / sizeof *cases); i++) {
        const size_t k = i / 3;
        if (i % 3 == 0)
            write_fbx_text("links.fbx", &cases[k].links, MODELS);
        else
            write_fbx_bytes("links.fbx", &cases[k].links, i % 3 == 1 ? 7400 : 7500);
        if (!cases[k].refused) {
            froe_scene *scene = read_scene("links.fbx", NULL);
            assert_int_equal(froe_scene_object_count(scene), cases[k].objects);
            froe_scene_free(scene);
        } else {
            refuse("links.fbx", FROE_E_FORMAT, cases[k].refused);
        }
    }
    write_fbx_text("deep.fbx", &(fbx_links){{{200, 201}, {201, 202}}}, DEEP);
    refuse("deep.fbx", FROE_E_INPUT, "deep.fbx: The file holds no objects"); /* the last is not below the scene */
    write_fbx_text("deep.fbx", &(fbx_links){{{200, 201}, {201, 202}}}, DEEP + 1);
    refuse("deep.fbx", FROE_E_UNSUPPORTED, "deep.fbx: model 200: It is below more than 1000 others.");
    write_fbx_text("memory.fbx", &cases[1].links, MODELS);
    assert_true(test_memory_each(read_with_memory, "memory.fbx") > 5);
    write_fbx_text("above.fbx", &(fbx_links){{{200, 0}, {201, 200}, {202, 201}, {203, 202}}}, MODELS + 1);
    refuse("above.fbx", FROE_E_FORMAT, "It is its own parent"); /* 202, which is below 201, too */
}

/* What looking through a file says. */
static froe_status look_through_fbx(void *user, const froe_allocator *alloc) {
    static formats_source source;
    const froe_read_options options = froe_read_defaults();
    froe_diagnostic why = {0};
    formats_sink sink = {.alloc = *alloc, .diag = &why, .path = user};
    assert_int_equal(formats_source_open(user, &options, &source, &why), FROE_OK);
    return io_fbx_check(&source, &sink);
}

/* Whatever a broken file says of its records, to look through it ends: it is left to assimp, or refused. */
static void broken_records_of_fbx_end(void **state) {
    (void)state;
    static const fbx_links links = {{{200, 201}, {200, 202}, {201, 0}, {202, 0}}};
    static const unsigned char others[] = {0, 1, 'C', 0xff};
    const froe_allocator alloc = support_allocator(NULL);
    size_t looked = 0, left = 0;
    for (unsigned version = 7400; version <= 7500; version += 100) {
        const size_t size = write_fbx_bytes("whole.fbx", &links, version);
        static char good[4096], broken[4096];
        FILE *file = fopen("whole.fbx", "rb");
        assert_non_null(file);
        assert_int_equal(fread(good, 1, size, file), size);
        fclose(file);
        assert_true(test_memory_each(look_through_fbx, "whole.fbx") > 3);
        for (size_t at = 23; at < size; at++)
            for (size_t k = 0; k <= sizeof others; k++, looked++) {
                memcpy(broken, good, size);
                if (k < sizeof others) broken[at] = (char)others[k];
                write_bytes("broken.fbx", broken, k < sizeof others ? size : at);
                const froe_status status = look_through_fbx("broken.fbx", &alloc);
                assert_true(status == FROE_OK || status == FROE_E_FORMAT);
                left += status == FROE_OK;
            }
    }
    assert_true(left > looked / 2);
    write_text("words.fbx", "Model:1 XModel: 2 Model: a Model: : Model: 3\nConnections: C: \"OO\" 1 2 \"OO\",3");
    assert_int_equal(look_through_fbx("words.fbx", &alloc), FROE_OK);
}

/* ----------------------------------------------------------------------------- DXF -- */

static void numbers_of_dxf_are_numbers(void **state) {
    (void)state;
    static const char head[] = "0\nSECTION\n2\nHEADER\n9\n$LTSCALE\n40\none\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
    static const struct {
        const char *place;
        int line; /* of what is refused; 0: nothing is */
    } cases[] = {{"10\n1.5\n20\n 2 \n", 0},
                 {" 10\r\n1.5\r\n 20\r\n+2.\t\r\n", 0},
                 {"10\n1,5\n20\n2\n", 20},
                 {"10\n1.5\n20\n2 m\n", 22},
                 {"10\n1.5\n20\n\n", 22},
                 {"1\na,b\n10\n1.5\n20\nzwei\n", 24},
                 {"10\n1.5\n20\n2\n210\n0\n220\n0\n230\n0,1\n", 28}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[400], words[80];
        snprintf(text, sizeof text, "%s0\nPOINT\n8\n0\n%s0\nENDSEC\n0\nEOF\n", head, cases[i].place);
        write_text("numbers.dxf", text);
        snprintf(words, sizeof words, "numbers.dxf: line %d: This is not a number with a decimal point.",
                 cases[i].line);
        if (cases[i].line) {
            refuse("numbers.dxf", FROE_E_FORMAT, words);
            continue;
        }
        froe_scene *scene = read_scene("numbers.dxf", NULL);
        assert_true(corner(scene, 0, 0)[0] == 1.5 && corner(scene, 0, 0)[1] == 2);
        froe_scene_free(scene);
    }
}

/* GDAL inserts nothing of a block that is not there; its other sorts come behind. */
static void blocks_of_dxf_are_there(void **state) {
    (void)state;
    static const char head[] = "0\nSECTION\n2\nHEADER\n0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\n B "
                               "\n10\n0\n20\n0\n0\nPOINT\n8\n0\n10\n1\n20\n2\n"
                               "0\nENDBLK\n0\nBLOCK\n2\nA\n70\n4\n0\nENDBLK\n0\nBLOCK\n2\nC\n70\n4\n0\nENDBLK\n"
                               "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
                               "0\nPOINT\n8\n0\n10\n1\n20\n2\n0\nMESH\n8\n0\n",
                      insert[] = "0\nINSERT\n8\n0\n%s10\n1\n20\n2\n0\nENDSEC\n0\nEOF\n";
    static const struct {
        const char *name, *left;
    } cases[] = {{"2\nBB\n", "INSERT of unknown blocks, XREF, MESH"},
                 {"10\n0\n0\nINSERT\n8\n0\n2\nB\n", "INSERT of unknown blocks, XREF, MESH"},
                 {"2\nB\n", "XREF, MESH"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[700], inserted[100];
        froe_read_report report;
        snprintf(inserted, sizeof inserted, insert, cases[i].name);
        snprintf(text, sizeof text, "%s%s", head, inserted);
        write_text("blocks.dxf", text);
        froe_scene_free(read_scene("blocks.dxf", &report));
        assert_string_equal(report.sorts_left, cases[i].left);
    }
    assert_true(test_memory_each(read_with_memory, "blocks.dxf") > 4);
}

/* GDAL passes over entities, and froe names their sorts: each once, and as many as there is room for. Windows of a
 * sheet are nothing to draw. */
static void sorts_of_entities_that_are_not_read_are_named(void **state) {
    (void)state;
    static const struct {
        const char *sorts[8], *left;
    } cases[] = {
        {{"MESH", "3DSOLID", "MESH", "VIEWPORT"}, "MESH, 3DSOLID"},
        {{"VIEWPORT"}, ""},
        {{"MESH", "3DSOLID", "ACAD_PROXY_ENTITY", "OLE2FRAME", "WIPEOUT", "REGION"},
         "MESH, 3DSOLID, ACAD_PROXY_ENTITY, OLE2FRAME"},
        {{"TOO_LONG_A_NAME_OF_A_SORT_FOR_WHAT_IS_HEARD"}, "TOO_LONG_A_NAME_OF_A_SORT_FOR_W"},
        {{"of two words"}, ""},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1024] = "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n0\n10\n0\n20\n0\n11\n1\n21\n1\n";
        for (int k = 0; k < 8 && cases[i].sorts[k]; k++)
            snprintf(text + strlen(text), sizeof text - strlen(text), "0\n%s\n8\n0\n", cases[i].sorts[k]);
        snprintf(text + strlen(text), sizeof text - strlen(text), "0\nENDSEC\n0\nEOF\n");
        write_text("sorts.dxf", text);
        expect("sorts.dxf", 1, cases[i].left);
    }
}

/* ------------------------------------------------------------------------- threads -- */

/* What assimp reads for another part of the program is none of an import of froe. */
static void imports_of_others_are_not_listened_to(void **state) {
    (void)state;
    write_ifc("own.ifc", "", "", whole);
    expect("own.ifc", BOX, "");
    write_ifc("others.ifc", ",#70", "#70=IFCBLOCK(#11,1.,2.,3.);\n", whole);
    const struct aiScene *scene = aiImportFile("others.ifc", 0);
    assert_non_null(scene);
    aiReleaseImport(scene);
    expect("own.ifc", BOX, "");
    expect("others.ifc", BOX, "IfcBlock");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polygons_of_lightwave_name_points_that_are_there),
        cmocka_unit_test(entities_of_ifc_are_there_and_known),
        cmocka_unit_test(ifc_has_any_ending),
        cmocka_unit_test(sorts_that_assimp_leaves_out_are_named),
        cmocka_unit_test(axes_of_fbx_are_looked_at),
        cmocka_unit_test(models_of_fbx_have_a_first_one),
        cmocka_unit_test(broken_records_of_fbx_end),
        cmocka_unit_test(numbers_of_dxf_are_numbers),
        cmocka_unit_test(blocks_of_dxf_are_there),
        cmocka_unit_test(sorts_of_entities_that_are_not_read_are_named),
        cmocka_unit_test(imports_of_others_are_not_listened_to),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
