/* glTF as a scene: what assimp passes over in silence, so that the scene would be another than the file means, is
 * refused by a sentence. */
#include "support.h"

/* A triangle and a half of a quadrilateral, of which the last corner is not there; two scenes. */
static const char whole[] =
    "{\"asset\": {\"version\": \"2.0\"}, \"extensionsRequired\": [\"KHR_materials_unlit\"], \"scene\": 0,\n"
    "\"scenes\": [{\"nodes\": [0]}, {\"nodes\": [1]}],\n"
    "\"nodes\": [{\"name\": \"a\", \"mesh\": 0, \"matrix\": [2,0,0,0, 0,1,0,0, 0,0,1,0, 3,0,0,1]},\n"
    "{\"name\": \"b\", \"mesh\": 0, \"translation\": [1, 2, 3], \"scale\": [1, 1, 1]}],\n"
    "\"meshes\": [{\"name\": \"m\", \"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"indices\": 1, \"mode\": "
    "4}]}],\n"
    "\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"type\": \"VEC3\", \"count\": 3},\n"
    "{\"bufferView\": 1, \"componentType\": 5123, \"type\": \"SCALAR\", \"count\": 3}],\n"
    "\"skins\": [{\"name\": \"s\", \"joints\": [1]}],\n"
    "\"bufferViews\": [{\"buffer\": 0, \"byteOffset\": 0, \"byteLength\": 36},\n"
    "{\"buffer\": 0, \"byteOffset\": 36, \"byteLength\": 12}],\n"
    "\"buffers\": [{\"byteLength\": 48, \"uri\": \"data:application/octet-stream;base64,"
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIAAAABAAMA\"}]}\n";

enum { MOST = sizeof whole + 256 };

/* The text with one word changed, and how long it is. */
static size_t change(char text[MOST], const char *word, const char *other) {
    const char *at = strstr(whole, word);
    assert_non_null(at);
    return (size_t)snprintf(text, MOST, "%.*s%s%s", (int)(at - whole), whole, other, at + strlen(word));
}

static void write_changed(const char *path, const char *word, const char *other) {
    char text[MOST];
    change(text, word, other);
    write_text(path, text);
}

static void put_word(unsigned char *to, size_t value) {
    for (int i = 0; i < 4; i++) to[i] = (unsigned char)(value >> 8 * i);
}

/* Writes a text as the first chunk of a .glb, with some of `pad` behind it, and the numbers of the triangle as the
 * second. */
static void write_chunks(const char *path, const char *text, size_t length, char pad) {
    static const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static const unsigned short indices[6] = {0, 1, 2, 0, 1, 3};
    static unsigned char glb[MOST + 128];
    const size_t padded = length / 4 * 4 + 8, numbers = sizeof corners + sizeof indices;
    assert_true(28 + padded + numbers <= sizeof glb);
    memcpy(glb, "glTF", 4);
    put_word(glb + 4, 2);
    put_word(glb + 8, 28 + padded + numbers);
    put_word(glb + 12, padded);
    memcpy(glb + 16, "JSON", 4);
    memcpy(glb + 20, text, length);
    memset(glb + 20 + length, pad, padded - length);
    put_word(glb + 20 + padded, numbers);
    memcpy(glb + 24 + padded, "BIN", 4);
    memcpy(glb + 28 + padded, corners, sizeof corners);
    memcpy(glb + 28 + padded + sizeof corners, indices, sizeof indices);
    write_bytes(path, glb, 28 + padded + numbers);
}

static void the_scene_to_be_shown_is_read_and_others_are_counted(void **state) {
    (void)state;
    froe_read_report report;
    write_text("whole.gltf", whole);
    froe_scene *scene = read_scene("whole.gltf", &report);
    assert_int_equal(froe_scene_object_count(scene), 1);
    assert_true(corner(scene, 0, 0)[0] == 3 && corner(scene, 0, 1)[0] == 5);
    assert_int_equal(report.layers_left, 1);
    froe_scene_free(scene);
}

static void what_assimp_passes_over_is_refused(void **state) {
    (void)state;
    static const struct {
        const char *word, *other;
        froe_status status;
        const char *sentence;
    } changes[] = {
        {"KHR_materials_unlit", "EXT_meshopt_compression", FROE_E_UNSUPPORTED,
         "changed.gltf: The file requires the extension 'EXT_meshopt_compression' of glTF, which is not read."},
        {"5126", "5123", FROE_E_UNSUPPORTED, "changed.gltf: mesh 0 ('m'): Its positions are not three floating-point"},
        {"VEC3", "VEC2", FROE_E_UNSUPPORTED, "changed.gltf: mesh 0 ('m'): Its positions are not three floating-point"},
        {"\"mesh\": 0", "\"mesh\": 0, \"extensions\": {\"EXT_mesh_gpu_instancing\": {}}", FROE_E_UNSUPPORTED,
         "changed.gltf: node 0 ('a'): It stands in many places by the extension EXT_mesh_gpu_instancing"},
        {"0,0,1,0, 3", "0,0,1,0.5, 3", FROE_E_FORMAT, "changed.gltf: node 0 ('a'): Its matrix is not 16 numbers, of"},
        {"3,0,0,1]", "3,0,0,0.99999]", FROE_E_FORMAT, "changed.gltf: node 0 ('a'): Its matrix is not 16 numbers, of"},
        {"3,0,0,1]", "3,0,0]", FROE_E_FORMAT, "changed.gltf: node 0 ('a'): Its matrix is not 16 numbers, of"},
        {"[1, 2, 3]", "[1, 2]", FROE_E_FORMAT, "changed.gltf: node 1 ('b'): Its translation, rotation and scale are"},
        {"[1, 1, 1]", "[1, true, 1]", FROE_E_FORMAT, "changed.gltf: node 1 ('b'): Its translation, rotation and scale"},
        {"\"scale\"", "\"rotation\": [0, 0, 1, 1], \"scale\"", FROE_E_FORMAT,
         "changed.gltf: node 1 ('b'): The quaternion of its rotation does not have the length 1."},
        {"\"mode\": 4", "\"mode\": 9", FROE_E_FORMAT, "changed.gltf: mesh 0 ('m'): Its modes are not each one of the"},
        {"\"mode\": 4", "\"mode\": -1", FROE_E_FORMAT, "changed.gltf: mesh 0 ('m'): Its modes are not each one of the"},
        {"\"mode\": 4", "\"mode\": 2.0", FROE_E_FORMAT,
         "changed.gltf: mesh 0 ('m'): Its modes are not each one of the"},
        {"\"mode\": 4", "\"mode\": \"4\"", FROE_E_FORMAT,
         "changed.gltf: mesh 0 ('m'): Its modes are not each one of the"},
        {"3,0,0,1]", "3,0,0,true]", FROE_E_FORMAT, "changed.gltf: node 0 ('a'): Its matrix is not 16 numbers, of"},
        {"2,0,0,0, 0", "\"2\",0,0,0, 0", FROE_E_FORMAT, "changed.gltf: node 0 ('a'): Its matrix is not 16 numbers, of"},
        {"\"mesh\": 0", "\"mesh\": -1", FROE_E_FORMAT, "changed.gltf: The reader assimp reports '"},
        {"\"SCALAR\", \"count\": 3", "\"SCALAR\", \"count\": 1e10", FROE_E_FORMAT, "changed.gltf: The reader assimp"},
        {"\"SCALAR\", \"count\": 3", "\"SCALAR\", \"count\": 6", FROE_E_FORMAT,
         "changed.gltf: Of 2 points, edges or triangles 1 name vertices that do not exist."},
    };
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        write_changed("changed.gltf", changes[i].word, changes[i].other);
        refuse("changed.gltf", changes[i].status, changes[i].sentence);
    }
}

/* assimp has meshes in the order in which nodes name them. */
static void nodes_name_meshes_in_any_order(void **state) {
    (void)state;
    char text[MOST], both[MOST];
    change(text, "4}]}]", "4}]}, {\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"mode\": 0}]}]");
    for (int order = 0; order < 2; order++) {
        const char *at = strstr(text, "\"nodes\": [{"), *end = strstr(at, "\"meshes\"");
        snprintf(both, sizeof both, "%.*s\"nodes\": [{\"mesh\": %d, \"children\": [1]}, {\"mesh\": %d}],\n%s",
                 (int)(at - text), text, order, 1 - order, end);
        write_text("both.gltf", both);
        froe_scene *scene = read_scene("both.gltf", NULL);
        assert_int_equal(froe_scene_object_count(scene), 4);
        froe_scene_free(scene);
    }
}

/* The matrices of a skin are optional, and there may be too few. In a .glb the text does not begin the file. */
static void skins_without_matrices_are_read(void **state) {
    (void)state;
    static const char *const nodes[] = {"\"skin\": 0, \"mesh\": 0", "\"s\\u006bin\": 0, \"mesh\": 0",
                                        "\"\\u0073kin\": 0, \"skin\": 0, \"mesh\": 0"};
    char text[MOST];
    for (size_t i = 0; i < sizeof nodes / sizeof *nodes; i++)
        for (int binary = 0; binary < 2; binary++) {
            froe_read_report report;
            const size_t length = change(text, "\"mesh\": 0", nodes[i]);
            if (binary)
                write_chunks("skin.glb", text, length, ' ');
            else
                write_text("skin.gltf", text);
            froe_scene *scene = read_scene(binary ? "skin.glb" : "skin.gltf", &report);
            assert_int_equal(froe_scene_object_count(scene), 1);
            assert_true(corner(scene, 0, 0)[0] == 3 && corner(scene, 0, 1)[0] == 5);
            assert_string_equal(report.sorts_left, "skins");
            froe_scene_free(scene);
        }
}

/* assimp takes the text up to its first zero, and names of any bytes. */
static void texts_that_only_assimp_takes_are_checked_too(void **state) {
    (void)state;
    static const char sentence[] = "mesh 0 ('m'): Its positions are not three floating-point";
    char text[MOST];
    const size_t size = change(text, "5126", "5123");
    write_bytes("zero.gltf", text, size + 1);
    refuse("zero.gltf", FROE_E_UNSUPPORTED, sentence);
    write_chunks("blanks.glb", text, size, ' ');
    refuse("blanks.glb", FROE_E_UNSUPPORTED, sentence);
    write_chunks("zeros.glb", text, size, '\0');
    refuse("zeros.glb", FROE_E_UNSUPPORTED, sentence);
    write_chunks("zeros.glb", whole, sizeof whole - 1, '\0');
    froe_scene *scene = read_scene("zeros.glb", NULL);
    assert_true(froe_scene_object_count(scene) == 1 && corner(scene, 0, 1)[0] == 5);
    froe_scene_free(scene);
    write_changed("latin.gltf", "\"name\": \"m\"", "\"name\": \"caf\xe9\"");
    refuse("latin.gltf", FROE_E_FORMAT, "latin.gltf: line 5: JSON needs UTF-8 near '");
}

/* A file of another format under this extension is read as what it is. */
static void what_is_no_json_and_no_gltf_is_not_refused_for_it(void **state) {
    (void)state;
    write_text("off.gltf", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    froe_scene *scene = read_scene("off.gltf", NULL);
    assert_int_equal(froe_scene_object_count(scene), 1);
    froe_scene_free(scene);
    write_changed("broken.gltf", "\"scene\": 0", "\"scene\" 0");
    refuse("broken.gltf", FROE_E_FORMAT, "broken.gltf: The file is of no type that can be read.");
}

/* By another word, the scene is the same, to the last bit. */
static void what_does_not_change_the_scene_is_read(void **state) {
    (void)state;
    static const char *const changes[][2] = {
        {"\"mode\": 4", "\"mode\": 4.0"},
        {"KHR_materials_unlit", "KHR_techniques_webgl"},
        {"KHR_materials_unlit", "EXT_mesh_features"},
        {"KHR_materials_unlit", "EXT_structural_metadata"},
        {"KHR_materials_unlit", "CESIUM_primitive_outline"},
        {"\"KHR_materials_unlit\"", "5"},
        {"3,0,0,1]", "3,0,0,0.99999994]"},
        {"3,0,0,1]", "3,0,0,1.00000012]"},
    };
    write_text("whole.gltf", whole);
    froe_scene *scene = read_scene("whole.gltf", NULL);
    const uint64_t hash = scene_hash(scene);
    froe_scene_free(scene);
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        write_changed("same.gltf", changes[i][0], changes[i][1]);
        scene = read_scene("same.gltf", NULL);
        assert_true(scene_hash(scene) == hash);
        froe_scene_free(scene);
    }
}

static void faces_are_counted_in_every_mode(void **state) {
    (void)state;
    static const size_t objects[] = {3, 1, 3, 2, 1, 1, 1}; /* of three corners */
    for (int mode = 0; mode < 7; mode++) {
        char other[32];
        snprintf(other, sizeof other, "\"mode\": %d", mode);
        write_changed("mode.gltf", "\"mode\": 4", other);
        froe_scene *scene = read_scene("mode.gltf", NULL);
        assert_int_equal(froe_scene_object_count(scene), objects[mode]);
        froe_scene_free(scene);
    }
}

/* By the specification. Of chains, loops and fans assimp would make a face all the same, beyond its memory. */
static void too_few_corners_are_no_face(void **state) {
    (void)state;
    static const char empty
        [] = "few.gltf: The reader assimp reports 'Mesh \"m-1\" has no faces'.",
   few[] =
        "few.gltf: mesh 0 ('m'): A chain or loop of it has less than two corners, or a strip or fan less than three.";
    static const struct {
        int mode, count;
        const char *message; /* NULL: there is one more object */
    } cases[] = {{1, 1, empty}, {4, 2, empty}, {2, 1, few},  {3, 1, few},  {3, 0, few}, {5, 2, few},
                 {5, 1, few},   {6, 2, few},   {3, 2, NULL}, {5, 3, NULL}, {6, 3, NULL}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        static const char indices[] = "\"SCALAR\", \"count\": 3}";
        char other[128], text[MOST], both[2 * MOST];
        snprintf(other, sizeof other, "\"mode\": 4}, {\"attributes\": {\"POSITION\": 0}, \"indices\": 2, \"mode\": %d",
                 cases[i].mode);
        change(text, "\"mode\": 4", other);
        const char *at = strstr(text, indices);
        assert_non_null(at);
        at += sizeof indices - 1;
        snprintf(both, sizeof both,
                 "%.*s, {\"bufferView\": 1, \"componentType\": 5123, \"type\": \"SCALAR\", \"count\": %d}%s",
                 (int)(at - text), text, cases[i].count, at);
        write_text("few.gltf", both);
        if (cases[i].message) {
            refuse("few.gltf", FROE_E_FORMAT, cases[i].message);
            continue;
        }
        froe_scene *scene = read_scene("few.gltf", NULL);
        assert_int_equal(froe_scene_object_count(scene), 2);
        froe_scene_free(scene);
    }
}

/* Of a model with a skin the text is changed before assimp sees it, and files beside it are not. */
static void buffers_beside_models_with_skins_are_read(void **state) {
    (void)state;
    static const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    static const unsigned short indices[6] = {0, 1, 2, 0, 1, 3};
    char text[MOST], beside[MOST], bytes[sizeof corners + sizeof indices];
    change(text, "\"mesh\": 0", "\"skin\": 0, \"mesh\": 0");
    const char *uri = strstr(text, "data:application");
    assert_non_null(uri);
    snprintf(beside, sizeof beside, "%.*sbeside.bin%s", (int)(uri - text), text, strchr(uri, '"'));
    write_text("beside.gltf", beside);
    remove("beside.bin");
    refuse("beside.gltf", FROE_E_FORMAT, "beside.gltf: The reader assimp reports 'GLTF: ");
    memcpy(bytes, corners, sizeof corners), memcpy(bytes + sizeof corners, indices, sizeof indices);
    write_bytes("beside.bin", bytes, sizeof bytes);
    froe_scene *scene = read_scene("beside.gltf", NULL);
    assert_int_equal(froe_scene_object_count(scene), 1);
    assert_true(corner(scene, 0, 0)[0] == 3 && corner(scene, 0, 1)[0] == 5);
    froe_scene_free(scene);
}

static void morph_targets_are_left_out(void **state) {
    (void)state;
    static const struct {
        const char *weights, *left;
    } cases[] = {{"\"weights\": [0, 0], \"mesh\": 0", ""}, {"\"weights\": [0, 0.5], \"mesh\": 0", "morph targets"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_read_report report;
        write_changed("morph.gltf", "\"mesh\": 0", cases[i].weights);
        froe_scene *scene = read_scene("morph.gltf", &report);
        assert_int_equal(froe_scene_object_count(scene), 1);
        assert_string_equal(report.sorts_left, cases[i].left);
        froe_scene_free(scene);
    }
}

static void every_failing_allocation_gives_a_status(void **state) {
    (void)state;
    write_text("whole.gltf", whole);
    test_memory_each(read_with_memory, "whole.gltf");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_scene_to_be_shown_is_read_and_others_are_counted),
        cmocka_unit_test(what_assimp_passes_over_is_refused),
        cmocka_unit_test(nodes_name_meshes_in_any_order),
        cmocka_unit_test(skins_without_matrices_are_read),
        cmocka_unit_test(texts_that_only_assimp_takes_are_checked_too),
        cmocka_unit_test(what_is_no_json_and_no_gltf_is_not_refused_for_it),
        cmocka_unit_test(what_does_not_change_the_scene_is_read),
        cmocka_unit_test(faces_are_counted_in_every_mode),
        cmocka_unit_test(too_few_corners_are_no_face),
        cmocka_unit_test(buffers_beside_models_with_skins_are_read),
        cmocka_unit_test(morph_targets_are_left_out),
        cmocka_unit_test(every_failing_allocation_gives_a_status),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
