/* Solid models: one small model through every format that is easy to write by hand,
 * polygons kept and split, groups, materials, transforms, points and lines. */
#include "support.h"

static bool same_point(const double *p, double x, double y, double z) {
    return p[0] == x && p[1] == y && p[2] == z;
}

/* A triangle in z = 0 and a degenerate one: (0,0,0) (1,0,0) (0,1,0), and (5,5,5) thrice. */
static void check_pair(const char *path, const char *format) {
    froe_read_report report;
    froe_scene *scene = read_scene(path, &report);
    assert_string_equal(report.format, format);
    assert_int_equal(froe_scene_dim(scene), 3);
    assert_int_equal(froe_scene_kind_count(scene, FROE_POLYGON), 2);
    assert_true(same_point(corner(scene, 0, 0), 0, 0, 0));
    assert_true(same_point(corner(scene, 0, 1), 1, 0, 0));
    assert_true(same_point(corner(scene, 0, 2), 0, 1, 0));
    assert_int_equal(froe_scene_object(scene, 1).form, FROE_POINT);
    assert_true(same_point(corner(scene, 1, 0), 5, 5, 5));
    froe_scene_free(scene);
}

static void put_binary_stl(const char *path) {
    const float corners[2][3][3] = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{5, 5, 5}, {5, 5, 5}, {5, 5, 5}}};
    unsigned char bytes[84 + 2 * 50] = {0};
    bytes[80] = 2;
    for (int i = 0; i < 2; i++) memcpy(bytes + 84 + 50 * i + 12, corners[i], 36);
    write_bytes(path, bytes, sizeof bytes);
}

static void one_model_comes_through_every_format(void **state) {
    (void)state;
    write_text("pair.off", "OFF # comment\n4 2 0\n0 0 0\n1 0 0\n0 1 0 # y\n5 5 5\n3 0 1 2 0.5 0.5 0.5\n3 3 3 3\n");
    check_pair("pair.off", "OFF");
    write_text("pair.obj", "# two\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nv 5 5 5 1.0\nf 1/1 2/1 3/1\nf -1 -1 \\\n -1\n");
    check_pair("pair.obj", "OBJ");
    write_text("pair.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                           "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
                           "0 0 0\n1 0 0\n0 1 0\n5 5 5\n3 0 1 2\n3 3 3 3\n");
    check_pair("pair.ply", "PLY");
    write_text("pair.stl", "solid pair\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                           "endloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 5 5 5\nvertex 5 5 5\n"
                           "vertex 5 5 5\nendloop\nendfacet\nendsolid pair\n");
    check_pair("pair.stl", "Stereolithography (STL) (assimp)");
    put_binary_stl("binary.stl");
    check_pair("binary.stl", "Stereolithography (STL) (assimp)");
}

/* Binary, either byte order: double coordinates, a face of four, an edge, and a property that is left alone. */
static void put_binary_ply(const char *path, bool big) {
    static const double corners[4][3] = {{0.1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.1, 1, 0}};
    static const unsigned short indices[] = {0, 1, 2, 3}, ends[] = {3, 1};
    unsigned char bytes[1024];
    int size = snprintf((char *)bytes, sizeof bytes,
                        "ply\nformat binary_%s_endian 1.0\ncomment two\nelement vertex 4\nproperty double x\n"
                        "property double y\nproperty uchar red\nproperty double z\nelement face 1\n"
                        "property list uchar ushort vertex_indices\nelement edge 1\nproperty ushort vertex1\n"
                        "property ushort vertex2\nend_header\n",
                        big ? "big" : "little");
    unsigned char *at = bytes + size;
    for (int v = 0; v < 4; v++)
        for (int k = 0; k < 3; k++) {
            if (k == 2) *at++ = 200;
            for (int i = 0; i < 8; i++) at[big ? 7 - i : i] = ((const unsigned char *)&corners[v][k])[i];
            at += 8;
        }
    *at++ = 4;
    for (int i = 0; i < 6; i++, at += 2) {
        unsigned short value = i < 4 ? indices[i] : ends[i - 4];
        at[big] = (unsigned char)value;
        at[!big] = 0;
    }
    write_bytes(path, bytes, (size_t)(at - bytes));
}

static void binary_ply_comes_in_both_byte_orders(void **state) {
    (void)state;
    for (int big = 0; big < 2; big++) {
        put_binary_ply("binary.ply", big);
        froe_read_options options = froe_read_defaults();
        options.faces = FROE_FACES_POLYGONS;
        froe_read_report report;
        froe_scene *scene = read_with("binary.ply", &options, &report);
        assert_string_equal(report.precision, "float64");
        assert_int_equal(froe_scene_object_count(scene), 2);
        assert_int_equal(froe_scene_object(scene, 0).corners, 4);
        assert_true(same_point(corner(scene, 0, 3), 0.1, 1, 0));
        assert_int_equal(froe_scene_object(scene, 1).kind, FROE_SEGMENT);
        assert_true(same_point(corner(scene, 1, 1), 1, 0, 0));
        froe_scene_free(scene);
    }
    write_text("cloud.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                            "property float z\nend_header\n1 2 3\n4 5 6\n");
    froe_scene *scene = read_scene("cloud.ply", NULL);
    assert_int_equal(froe_scene_kind_count(scene, FROE_POINT), 2);
    froe_scene_free(scene);
}

/* -------------------------------------------------------------- polygons -- */

static const char *const solids = "OFF\n14 5 0\n"
                                  "0 0 0\n2 0 0\n2 2 0\n0 2 0\n"      /* a square */
                                  "4 0 0\n6 0 0\n6 2 0\n4 2 1e-9\n"   /* not quite planar */
                                  "8 0 0\n10 0 0\n8.5 0.5 0\n8 2 0\n" /* an arrowhead: planar, not convex */
                                  "1 1 1\n3 3 3\n"
                                  "4 0 1 2 3\n4 4 5 6 7\n4 8 9 10 11\n2 12 13\n1 12\n";

static void exactly_planar_convex_polygons_can_stay_whole(void **state) {
    (void)state;
    write_text("solids.off", solids);
    froe_read_options options = froe_read_defaults();
    froe_read_report report;
    options.faces = FROE_FACES_POLYGONS;
    froe_scene *scene = read_with("solids.off", &options, &report);
    assert_int_equal(froe_scene_object_count(scene), 7);
    assert_int_equal(report.triangulated, 2);
    assert_int_equal(froe_scene_object(scene, 0).corners, 4);
    static const uint32_t faces[] = {0, 1, 1, 3, 3, 5, 6};
    for (uint32_t i = 0; i < 7; i++) assert_int_equal(froe_scene_object(scene, i).face, faces[i]);
    assert_int_equal(froe_scene_object(scene, 5).kind, FROE_SEGMENT);
    assert_int_equal(froe_scene_object(scene, 6).kind, FROE_POINT);
    froe_scene_free(scene);
}

static double area_xy(const froe_scene *scene, uint32_t i) {
    const double *a = corner(scene, i, 0), *b = corner(scene, i, 1), *c = corner(scene, i, 2);
    return 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

static void polygons_are_split_along_ears(void **state) {
    (void)state;
    write_text("solids.off", solids);
    froe_read_report report;
    froe_scene *scene = read_scene("solids.off", &report);
    assert_int_equal(report.triangulated, 3);
    assert_int_equal(froe_scene_kind_count(scene, FROE_POLYGON), 6);
    for (uint32_t i = 0; i < 6; i++) assert_true(area_xy(scene, i) > 0); /* none turns over: no ear was outside */
    assert_true(area_xy(scene, 4) + area_xy(scene, 5) == 1);
    froe_scene_free(scene);
}

/* A comb of many teeth: most corners are no ears at first. The area is exact, all numbers being small. */
static void a_comb_is_covered_once(void **state) {
    (void)state;
    enum { WIDTH = 600, CORNERS = WIDTH + 3 };
    FILE *file = fopen("comb.obj", "w");
    assert_non_null(file);
    for (int i = 0; i <= WIDTH; i++) fprintf(file, "v %d %d 7\n", WIDTH - i, i % 2 ? 1 : 64);
    fprintf(file, "v 0 0 7\nv %d 0 7\nf", WIDTH);
    for (int i = 1; i <= CORNERS; i++) fprintf(file, " %d", i);
    fclose(file);
    froe_scene *scene = read_scene("comb.obj", NULL);
    assert_int_equal(froe_scene_object_count(scene), CORNERS - 2);
    double sum = 0;
    for (uint32_t i = 0; i < CORNERS - 2; i++) {
        assert_true(area_xy(scene, i) > 0);
        sum += area_xy(scene, i);
    }
    assert_true(sum == WIDTH * 0.5 * (1 + 64)); /* trapezia of width 1 under the zigzag */
    froe_scene_free(scene);
}

static void polygons_that_are_not_simple_are_split_all_the_same(void **state) {
    (void)state;
    write_text("bow.off", "OFF\n5 3 0\n0 0 0\n1 1 0\n1 0 0\n0 1 0\n2 2 0\n4 0 1 2 3\n5 0 1 4 1 0\n4 0 0 0 0\n");
    froe_read_report report;
    froe_scene *scene = read_scene("bow.off", &report);
    assert_int_equal(froe_scene_object_count(scene), 2 + 3 + 2);
    assert_int_equal(report.triangulated, 3);
    froe_scene_free(scene);
}

/* ------------------------------------------------------ groups, transforms -- */

static void names_and_materials_become_groups(void **state) {
    (void)state;
    write_text("groups.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\no Roof  \nusemtl tiles\nf 1 2 4\n"
                             "usemtl wood\nf 1 3 4\ng Wall\nf 2 3 4\no Roof\nusemtl tiles\nf 1 2 3\nl 1 2 3\np 4\n");
    froe_read_report report;
    froe_scene *scene = read_scene("groups.obj", &report);
    static const uint32_t groups[] = {FROE_NONE, 0, 1, 2, 0, 0, 0, 0};
    assert_int_equal(froe_scene_object_count(scene), 8);
    for (uint32_t i = 0; i < 8; i++) assert_int_equal(froe_scene_object(scene, i).group, groups[i]);
    assert_int_equal(froe_scene_kind_count(scene, FROE_SEGMENT), 2);
    assert_int_equal(froe_scene_kind_count(scene, FROE_POINT), 1);
    assert_string_equal(froe_scene_group(scene, 0).name, "Roof");
    assert_string_equal(froe_scene_group(scene, 0).material, "tiles");
    assert_string_equal(froe_scene_group(scene, 1).material, "wood");
    assert_string_equal(froe_scene_group(scene, 2).name, "Wall");
    froe_scene_free(scene);
}

/* Colours come from the library beside the model; what is no file of colours at or below it adds none. */
static void materials_bring_their_colours(void **state) {
    (void)state;
    write_text("colours.mtl",
               "newmtl tiles\r\nKd 0.8 0.1 0 # red\nnewmtl glass\n Kd 0.5\nd 0.4\nnewmtl fog\nKd 1 1 2\nTr 1\n"
               "newmtl none\nd 0.5\nnewmtl painted\nKd 1 1 1\nmap_Kd wood.png\n");
    write_text("colours.obj",
               "mtllib missing.mtl\nmtllib ../colours.mtl\nmtllib /colours.mtl\nmtllib .\nmtllib colours.mtl\n"
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl tiles\nf 1 2 3\nusemtl glass\nf 1 2 3\nusemtl fog\nf 1 2 3\n"
               "usemtl none\nf 1 2 3\nusemtl painted\nf 1 2 3\nusemtl unknown\nf 1 2 3\n");
    static const uint32_t colours[] = {0xCC1A00FF, 0x80808066, 0xFFFFFF00, 0, 0xFFFFFFFF, 0};
    froe_read_report report;
    froe_scene *scene = read_scene("colours.obj", &report);
    assert_string_equal(report.unread_library, "missing.mtl");
    assert_int_equal(froe_scene_group_count(scene), 6);
    for (uint32_t g = 0; g < 6; g++) assert_int_equal(froe_scene_group(scene, g).colour, colours[g]);
    froe_scene_free(scene);
    write_text("more colours.MTL", "newmtl unknown\nKd 0 1 0\n");
    write_text("two.obj", "mtllib more colours.MTL\tcolours.mtl \nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl tiles\nf 1 2 3\n"
                          "usemtl unknown\nf 1 2 3\n");
    scene = read_scene("two.obj", &report);
    assert_string_equal(report.unread_library, "");
    for (uint32_t g = 0; g < 2; g++) assert_int_equal(froe_scene_group(scene, g).colour, g ? 0x00FF00FF : colours[0]);
    froe_scene_free(scene);
    write_bytes("colours.mtl", "newmtl tiles\0", 13);
    scene = read_scene("colours.obj", &report);
    assert_int_equal(froe_scene_group(scene, 0).colour, 0);
    froe_scene_free(scene);
}

/* Two nodes show one mesh, one of them moved inside a scaled parent; %s is where the three points are. */
static const char *const instances =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],"
    "\"nodes\":[{\"name\":\"still\",\"mesh\":0},{\"name\":\"parent\",\"scale\":[2,2,2],\"children\":[2]},"
    "{\"name\":\"moved\",\"mesh\":0,\"translation\":[10,0,1]}],"
    "\"materials\":[{\"name\":\"stone\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0.2158605,0,0.503]},"
    "\"alphaMode\":\"BLEND\"}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],"
    "\"max\":[1,1,0]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
    "\"buffers\":[{%s\"byteLength\":36}]}";
static const char *const inside = "\"uri\":\"data:application/octet-stream;base64,"
                                  "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\",";
static const float points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

static void check_instances(const char *path) {
    froe_read_report report;
    froe_scene *scene = read_scene(path, &report);
    assert_int_equal(report.features, 2);
    assert_int_equal(froe_scene_object_count(scene), 2);
    assert_true(same_point(corner(scene, 0, 1), 1, 0, 0));
    assert_true(same_point(corner(scene, 1, 0), 20, 0, 2));
    assert_true(same_point(corner(scene, 1, 1), 22, 0, 2));
    assert_true(same_point(corner(scene, 1, 2), 20, 2, 2));
    assert_string_equal(froe_scene_group(scene, 0).name, "still");
    assert_string_equal(froe_scene_group(scene, 1).name, "moved");
    assert_string_equal(froe_scene_group(scene, 1).material, "stone");
    assert_int_equal(froe_scene_group(scene, 1).colour, 0xFF800080); /* 0.216 of light is half of sRGB */
    froe_scene_free(scene);
}

static void put_word(unsigned char *to, size_t value) {
    for (int i = 0; i < 4; i++) to[i] = (unsigned char)(value >> 8 * i);
}

static size_t put_glb(const char *path, size_t cut) {
    unsigned char glb[2048] = "glTF";
    size_t text = (size_t)snprintf((char *)glb + 20, 1500, instances, "");
    size_t padded = (text + 3) / 4 * 4, whole = 20 + padded + 8 + sizeof points;
    assert_true(whole <= sizeof glb);
    put_word(glb + 4, 2);
    put_word(glb + 8, whole);
    put_word(glb + 12, padded);
    put_word(glb + 16, 0x4e4f534a); /* JSON */
    memset(glb + 20 + text, ' ', padded - text);
    put_word(glb + 20 + padded, sizeof points);
    put_word(glb + 24 + padded, 0x004e4942); /* BIN */
    memcpy(glb + 28 + padded, points, sizeof points);
    write_bytes(path, glb, whole - cut);
    return whole;
}

static void transforms_of_nodes_are_applied(void **state) {
    (void)state;
    char json[1500];
    snprintf(json, sizeof json, instances, inside);
    write_text("instances.gltf", json);
    check_instances("instances.gltf");
    put_glb("instances.glb", 0);
    check_instances("instances.glb");
}

static void a_truncated_glb_is_refused_wherever_it_ends(void **state) {
    (void)state;
    size_t whole = put_glb("cut.glb", 0);
    for (size_t cut = 1; cut < whole; cut += cut < 80 ? 1 : 37) {
        put_glb("cut.glb", cut);
        refuse("cut.glb", FROE_E_FORMAT, "cut.glb: ");
    }
}

static void boxes_of_a_model_are_those_of_its_objects(void **state) {
    (void)state;
    write_text("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 6 7\no a\nf 1 2 3\no b\nf 1 2 4\nusemtl m\nf 1 3 4\n");
    froe_read_options options = froe_read_defaults();
    options.boxes = true;
    froe_scene *scene = read_with("two.obj", &options, NULL);
    assert_int_equal(froe_scene_kind_count(scene, FROE_BOX), 2);
    assert_true(same_point(corner(scene, 0, 1), 1, 1, 0));
    assert_true(same_point(corner(scene, 1, 1), 5, 6, 7));
    froe_scene_free(scene);
}

static void doubles_survive_in_off_and_obj(void **state) {
    (void)state;
    write_text("exact.off",
               "OFF\n3 1 0\n0.1 1e308 -1e308\n4.9406564584124654e-324 0.30000000000000004 -0\n1 2 3\n3 0 1 2\n");
    write_text("exact.obj", "v 0.1 1e308 -1e308\nv 4.9406564584124654e-324 0.30000000000000004 -0\nv 1 2 3\nf 1 2 3\n");
    const char *const paths[] = {"exact.off", "exact.obj"};
    for (int i = 0; i < 2; i++) {
        froe_read_report report;
        froe_scene *scene = read_scene(paths[i], &report);
        assert_string_equal(report.precision, "float64");
        assert_true(same_point(corner(scene, 0, 0), 0.1, 1e308, -1e308));
        assert_true(same_point(corner(scene, 0, 1), 0x1p-1074, 0.30000000000000004, 0));
        froe_scene_free(scene);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_model_comes_through_every_format),
        cmocka_unit_test(binary_ply_comes_in_both_byte_orders),
        cmocka_unit_test(exactly_planar_convex_polygons_can_stay_whole),
        cmocka_unit_test(polygons_are_split_along_ears),
        cmocka_unit_test(a_comb_is_covered_once),
        cmocka_unit_test(polygons_that_are_not_simple_are_split_all_the_same),
        cmocka_unit_test(names_and_materials_become_groups),
        cmocka_unit_test(materials_bring_their_colours),
        cmocka_unit_test(transforms_of_nodes_are_applied),
        cmocka_unit_test(a_truncated_glb_is_refused_wherever_it_ends),
        cmocka_unit_test(boxes_of_a_model_are_those_of_its_objects),
        cmocka_unit_test(doubles_survive_in_off_and_obj),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
