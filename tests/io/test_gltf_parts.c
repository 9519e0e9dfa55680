/* glTF as a scene, of which parts lie elsewhere: meshes and nodes that do not belong to the scene to be shown, and
 * buffers in other files, whose names are escaped (RFC 3986, 2.1). */
#include "support.h"
#include <sys/stat.h>

/* A quadrilateral of two triangles, and another one whose last corner is not there; %s are nodes, more meshes, more
 * members, and where the numbers are. */
static const char model[] =
    "{\"asset\": {\"version\": \"2.0\"}, \"scenes\": [{\"nodes\": [0]}, {\"nodes\": [1]}], \"nodes\": [%s],\n"
    "\"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"indices\": 1}]},\n"
    "{\"primitives\": [{\"attributes\": {\"POSITION\": 0}, \"indices\": 2}]}],\n"
    "\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"type\": \"VEC3\", \"count\": 4},\n"
    "{\"bufferView\": 1, \"componentType\": 5123, \"type\": \"SCALAR\", \"count\": 6},\n"
    "{\"bufferView\": 2, \"componentType\": 5123, \"type\": \"SCALAR\", \"count\": 6}],\n"
    "\"bufferViews\": [{\"buffer\": 0, \"byteOffset\": 0, \"byteLength\": 48},\n"
    "{\"buffer\": 0, \"byteOffset\": 48, \"byteLength\": 12}, {\"buffer\": 0, \"byteOffset\": 60, \"byteLength\": "
    "12}],\n"
    "%s\"buffers\": [{\"byteLength\": 72, \"uri\": \"%s\"}]}\n";

static void write_model(const char *path, const char *nodes, const char *more, const char *uri) {
    char text[sizeof model + 512];
    assert_true((size_t)snprintf(text, sizeof text, model, nodes, more, uri) < sizeof text);
    write_text(path, text);
}

/* Writes those numbers, with a right last corner or with one that is not there. */
static void write_numbers(const char *path, unsigned short last) {
    static const float corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    const unsigned short indices[12] = {0, 1, 2, 1, 3, 2, 0, 1, 2, 1, last, 2};
    char bytes[sizeof corners + sizeof indices];
    memcpy(bytes, corners, sizeof corners);
    memcpy(bytes + sizeof corners, indices, sizeof indices);
    write_bytes(path, bytes, sizeof bytes);
}

static void expect_objects(const char *path, size_t count) {
    froe_scene *scene = read_scene(path, NULL);
    assert_int_equal(froe_scene_object_count(scene), count);
    froe_scene_free(scene);
}

/* Mesh 0 is right. Mesh 1 matters wherever assimp reads it, and nowhere else. */
static void meshes_that_nothing_shows_do_not_hide_wrong_indices(void **state) {
    (void)state;
    static const struct {
        const char *nodes, *more;
        size_t objects; /* 0: refused */
    } files[] = {
        {"{\"mesh\": 0}", "", 2},
        {"{\"mesh\": 1}", "", 0},
        {"{\"mesh\": 0}, {\"mesh\": 1}", "", 2},
        {"{\"mesh\": 1}, {\"mesh\": 0}", "", 0},
        {"{\"mesh\": 0}, {\"mesh\": 1}", "\"scene\": 0, ", 2},
        {"{\"mesh\": 0}, {\"mesh\": 1}", "\"scene\": 1, ", 0},
        {"{\"mesh\": 1}, {\"mesh\": 0}", "\"scene\": 1, ", 2},
        {"{\"mesh\": 0, \"children\": [1, 2]}, {\"children\": [3]}, {}, {\"mesh\": 1}", "", 0},
        {"{\"mesh\": 0, \"children\": [1, 2]}, {\"children\": [3]}, {}, {\"mesh\": 0}, {\"mesh\": 1}", "", 4},
        {"{\"mesh\": 0}, {\"mesh\": 1}", "\"skins\": [{\"joints\": [0, 1]}], ", 0},
        {"{\"mesh\": 0}, {\"mesh\": 1}", "\"skins\": [{\"joints\": [0]}], ", 2},
        {"{\"mesh\": 0}, {\"mesh\": 1}", "\"animations\": [{\"channels\": [{\"target\": {\"node\": 1}}]}], ", 0},
        {"{\"mesh\": 0}, {\"mesh\": 1}", "\"animations\": [{\"channels\": [{\"target\": {\"node\": 0}}]}], ", 2},
        {"{\"mesh\": 0}, {\"mesh\": 1}", "\"animations\": [{\"channels\": [{\"target\": {\"path\": \"scale\"}}]}], ",
         2},
    };
    write_numbers("numbers.bin", 4);
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        write_model("parts.gltf", files[i].nodes, files[i].more, "numbers.bin");
        if (files[i].objects)
            expect_objects("parts.gltf", files[i].objects);
        else
            refuse("parts.gltf", FROE_E_FORMAT, "points, edges or triangles 1 name vertices that do not exist.");
    }
}

/* A name is first taken without its escapes, and then as it is written. */
static void escaped_names_of_buffers_are_found(void **state) {
    (void)state;
    static const struct {
        const char *file, *uri;
    } names[] = {
        {"parts of it/has space.bin", "has%20space.bin"},
        {"parts of it/bl%C3%BCte.bin", "bl%C3%BCte.bin"},
        {"parts of it/blute\xcc\x88.bin", "blute%cc%88.bin"},
        {"parts of it/below/n.bin", "below%2Fn.bin"},
        {"parts of it/100%.bin", "100%.bin"},
        {"parts of it/100%a.bin", "100%a.bin"},
        {"parts of it/100%g0.bin", "100%g0.bin"},
        {"parts of it/100%@0.bin", "100%@0.bin"},
        {"parts of it/100%G0.bin", "100%G0.bin"},
        {"parts of it/100%:0.bin", "100%:0.bin"},
        {"parts of it/100%25.bin", "100%2525.bin"},
        {"parts of it/no%00.bin", "no%00.bin"},
    };
    (void)mkdir("parts of it", 0777);
    (void)mkdir("parts of it/below", 0777);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        write_numbers(names[i].file, 3);
        write_model("parts of it/m.gltf", "{\"mesh\": 1}", "", names[i].uri);
        froe_scene *scene = read_scene("parts of it/m.gltf", NULL);
        if (froe_scene_object_count(scene) != 2) fail_msg("%s", names[i].uri);
        froe_scene_free(scene);
    }
    /* both are there: the name without escapes counts. That of the folder is taken as it is. */
    (void)mkdir("of%20it", 0777);
    write_numbers("of%20it/two names.bin", 3);
    write_numbers("of%20it/two%20names.bin", 4);
    write_model("of%20it/two%20names.gltf", "{\"mesh\": 1}", "", "two%20names.bin");
    expect_objects("of%20it/two%20names.gltf", 2);
    write_model("of%20it/two%20names.gltf", "{\"mesh\": 1}", "", "other%20names.bin");
    refuse("of%20it/two%20names.gltf", FROE_E_FORMAT, "could not open referenced file \"other%20names.bin\"");
}

static void every_failing_allocation_gives_a_status(void **state) {
    (void)state;
    write_numbers("its numbers.bin", 3);
    write_model("memory.gltf", "{\"mesh\": 0, \"children\": [1, 2, 3]}, {\"mesh\": 1}, {\"mesh\": 0}, {\"mesh\": 1}",
                "\"skins\": [{\"joints\": [1]}], ", "its%20numbers.bin");
    test_memory_each(read_with_memory, "memory.gltf");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meshes_that_nothing_shows_do_not_hide_wrong_indices),
        cmocka_unit_test(escaped_names_of_buffers_are_found),
        cmocka_unit_test(every_failing_allocation_gives_a_status),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
