/* gltf.c: what a glTF file (version 2.0) may say that assimp passes over, so that the model would be another one.
 *
 * Those are extensions that it requires (3.12), positions that are no floating-point numbers (KHR_mesh_quantization),
 * nodes that stand for many (EXT_mesh_gpu_instancing), transformations of another shape than there are (3.5.3), data in
 * another alphabet than that of base64, and faces with wrong indices, which assimp leaves out. Whatever assimp refuses
 * by itself is left to it. */
#include "assimp_metadata.h"
#include "check/check.h"
#include "formats/input/json.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct gltf_check {
    formats_sink *sink;
    const char *text; /* in which strings are decoded */
    size_t begin;     /* of it in the file */
    const formats_json *root;
    io_gltf_list accessors, meshes, nodes, skins;
} gltf_check;

bool io_is_gltf(const formats_source *source) {
    return !strncmp(source->head, "glTF", 4) || !strcmp(source->extension.text, "gltf") ||
           !strcmp(source->extension.text, "glb");
}

size_t io_word_at(const char *at) {
    const unsigned char *b = (const unsigned char *)at;
    return (size_t)b[0] | (size_t)b[1] << 8 | (size_t)b[2] << 16 | (size_t)b[3] << 24;
}

bool io_glb_is_2(const char *bytes, size_t size) {
    return size >= IO_GLB_HEADER + IO_GLB_CHUNK && io_word_at(bytes + 4) == 2 &&
           !memcmp(bytes + IO_GLB_HEADER + 4, "JSON", 4);
}

/* The bytes of a .gltf, or of the first chunk of a .glb; none where there are none. */
static froe_status load_bytes(const formats_source *source, formats_sink *sink, formats_text *text) {
    const char *head = source->head;
    if (strncmp(head, "glTF", 4) != 0) return formats_load_part(source, sink, 0, (size_t)source->size, text);
    if (!io_glb_is_2(head, (size_t)source->size)) return FROE_OK;
    const size_t length = io_word_at(head + IO_GLB_HEADER);
    if (length > source->size - IO_GLB_HEADER - IO_GLB_CHUNK) return FROE_OK;
    return formats_load_part(source, sink, IO_GLB_HEADER + IO_GLB_CHUNK, length, text);
}

/* assimp takes them up to the first zero. */
static froe_status load_text(const formats_source *source, formats_sink *sink, formats_text *text) {
    const froe_status status = load_bytes(source, sink, text);
    if (!status && text->count) text->count = strlen(text->data);
    return status;
}

/* A failure about "node 3 ('arm')". */
static froe_status fail_at(const gltf_check *c, froe_status status, const char *what, size_t number,
                           const formats_json *object, const char *sentence) {
    const char *name = formats_json_string(formats_json_get(object, "name"));
    char called[64] = "";
    if (name) snprintf(called, sizeof called, " ('%.50s')", name);
    return support_fail(c->sink->diag, status, "%s: %s %zu%s: %s", support_short(c->sink->path), what, number, called,
                        sentence);
}

/* ------------------------------------------------------------------- extensions -- */

/* Those that say nothing of where faces are, or that assimp reads where it can, and refuses otherwise. */
static bool is_harmless(const char *extension) {
    static const char *const beginnings[] = {"KHR_materials_",
                                             "KHR_texture_",
                                             "EXT_texture_",
                                             "MSFT_texture_",
                                             "KHR_lights_",
                                             "EXT_lights_",
                                             "KHR_xmp",
                                             "KHR_mesh_quantization",
                                             "KHR_draco_mesh_compression",
                                             "KHR_techniques_webgl",
                                             "EXT_mesh_features",
                                             "EXT_structural_metadata",
                                             "CESIUM_primitive_outline"};
    for (size_t i = 0; i < sizeof beginnings / sizeof *beginnings; i++)
        if (!strncmp(extension, beginnings[i], strlen(beginnings[i]))) return true;
    return false;
}

static froe_status check_extensions(const gltf_check *c) {
    FORMATS_JSON_EACH(item, formats_json_get(c->root, "extensionsRequired")) {
        const char *name = formats_json_string(item);
        if (name && !is_harmless(name))
            return support_fail(c->sink->diag, FROE_E_UNSUPPORTED,
                                "%s: The file requires the extension '%.60s' of glTF, which is not read.",
                                support_short(c->sink->path), name);
    }
    return FROE_OK;
}

/* ---------------------------------------------------------------------- buffers -- */

/* assimp takes what is no digit of base64 (RFC 4648, section 4) for zeros, and so - and _, which are digits in the
 * names of files (section 5). It counts the letters before the data in 7 bits. */
static const char *find_fault_of_data(const char *uri) {
    enum { MOST_BEFORE = 126 };
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *comma = uri && !strncmp(uri, "data:", 5) ? strchr(uri, ',') : NULL;
    if (!comma) return NULL;
    if (comma - uri > MOST_BEFORE) return "More than 126 letters are before its data.";
    const char *base64 = strstr(uri, ";base64"), *end = comma + 1 + strspn(comma + 1, digits);
    if (!base64 || base64 > comma || !end[strspn(end, "=")]) return NULL;
    return "Its data are not in base64 with the digits A-Z, a-z, 0-9, + and / alone.";
}

static froe_status check_buffers(const gltf_check *c) {
    size_t number = 0;
    FORMATS_JSON_EACH(buffer, formats_json_get(c->root, "buffers")) {
        const char *sentence = find_fault_of_data(formats_json_string(formats_json_get(buffer, "uri")));
        if (sentence) return fail_at(c, FROE_E_FORMAT, "buffer", number, buffer, sentence);
        number++;
    }
    return FROE_OK;
}

/* ----------------------------------------------------------------------- meshes -- */

static froe_status list_items(gltf_check *c) {
    const froe_allocator *alloc = &c->sink->alloc;
    const bool room = io_gltf_list_items(alloc, c->root, "accessors", &c->accessors) &&
                      io_gltf_list_items(alloc, c->root, "meshes", &c->meshes) &&
                      io_gltf_list_items(alloc, c->root, "nodes", &c->nodes) &&
                      io_gltf_list_items(alloc, c->root, "skins", &c->skins);
    return room ? FROE_OK : support_fail_memory(c->sink->diag);
}

/* Are positions such as assimp takes all of them for? */
static bool is_floating(const formats_json *positions) {
    const char *type = formats_json_string(formats_json_get(positions, "type"));
    return !positions ||
           (io_gltf_is_number(formats_json_get(positions, "componentType"), 5126) && type && !strcmp(type, "VEC3"));
}

/* Is a mode one of those that there are? assimp takes 4 where there is none, or a number with a point. */
static bool is_mode(const formats_json *mode) {
    if (!mode || io_gltf_is_number(mode, 4)) return true;
    return formats_json_is(mode, FORMATS_JSON_NUMBER) && mode->number < 7 && strspn(mode->text, "+-.0123456789Ee") == 1;
}

/* Has a primitive the corners of one edge or triangle? Of a chain, loop or fan without them assimp makes a face all the
 * same, beyond its memory. Others it refuses. */
static bool is_long_enough(const formats_json *mode, size_t corners) {
    if (io_gltf_is_number(mode, 2) || io_gltf_is_number(mode, 3)) return corners >= 2;
    return (!io_gltf_is_number(mode, 5) && !io_gltf_is_number(mode, 6)) || corners >= 3;
}

static froe_status check_meshes(const gltf_check *c) {
    size_t number = 0;
    FORMATS_JSON_EACH(mesh, formats_json_get(c->root, "meshes")) {
        FORMATS_JSON_EACH(primitive, formats_json_get(mesh, "primitives")) {
            const formats_json *positions =
                io_gltf_item(&c->accessors, formats_json_get(primitive, "attributes"), "POSITION");
            if (!is_floating(positions))
                return fail_at(c, FROE_E_UNSUPPORTED, "mesh", number, mesh,
                               "Its positions are not three floating-point numbers each, as with the extension "
                               "KHR_mesh_quantization, which is not read.");
            const formats_json *mode = formats_json_get(primitive, "mode");
            const size_t corners = io_gltf_corners(&c->accessors, primitive);
            if (!is_mode(mode))
                return fail_at(c, FROE_E_FORMAT, "mesh", number, mesh,
                               "Its modes are not each one of the digits 0 to 6.");
            if (!is_long_enough(mode, corners))
                return fail_at(c, FROE_E_FORMAT, "mesh", number, mesh,
                               "A chain or loop of it has less than two corners, or a strip or fan less than three.");
        }
        number++;
    }
    return FROE_OK;
}

/* ------------------------------------------------------------------------ nodes -- */

static bool is_numbers(const formats_json *value, size_t count) {
    FORMATS_JSON_EACH(item, value)
    if (!formats_json_is(item, FORMATS_JSON_NUMBER)) return false;
    return !value || formats_json_size(value) == count;
}

/* Is a matrix, whose columns come one after the other, one of turns, scales, shears and a move? Its last number may be
 * 1 as single precision rounds it: neither froe nor assimp uses that number. */
static bool is_affine(const formats_json *matrix) {
    size_t i = 0;
    FORMATS_JSON_EACH(item, matrix) {
        const bool is_right = i == 15 ? fabs(item->number - 1) < 1e-6 : i % 4 != 3 || item->number == 0;
        if (!formats_json_is(item, FORMATS_JSON_NUMBER) || !is_right) return false;
        i++;
    }
    return is_numbers(matrix, 16);
}

/* Is a rotation of the length 1, but for rounding? There may be none. */
static bool is_unit(const formats_json *rotation) {
    double square = 0;
    FORMATS_JSON_EACH(item, rotation) square += item->number * item->number;
    return !rotation || fabs(square - 1) <= 0x1p-10;
}

static bool are_moved(const formats_json *weights) {
    FORMATS_JSON_EACH(item, weights)
    if (!io_gltf_is_number(item, 0)) return true;
    return false;
}

/* Of a skin without a matrix for each joint assimp reads beyond the last one, wherever that is. */
static froe_status check_skin(const gltf_check *c, const formats_json *node, const formats_json *skin) {
    const formats_json *count = formats_json_get(io_gltf_item(&c->accessors, skin, "inverseBindMatrices"), "count");
    const double joints = (double)formats_json_size(formats_json_get(skin, "joints"));
    if (formats_json_is(count, FORMATS_JSON_NUMBER) && count->number >= joints) return FROE_OK;
    return fail_at(c, FROE_E_UNSUPPORTED, "skin", (size_t)formats_json_get(node, "skin")->number, skin,
                   "It has no matrix (inverseBindMatrices) for each of its joints.");
}

/* Masks the members of a node that are called "skin", of which there may be several. */
static froe_status mask_skin(const gltf_check *c, const formats_json *node, io_gltf_found *found) {
    const formats_json *name = node + 1;
    for (size_t i = 0; i < node->count; i++, name = formats_json_next(name + 1)) {
        const size_t place = c->begin + (size_t)(name->text - c->text);
        if (!strcmp(name->text, "skin") && !array_push(&c->sink->alloc, &found->masked, place))
            return support_fail_memory(c->sink->diag);
    }
    return FROE_OK;
}

/* Skins and morph targets are not applied. Nodes that stand still are not skinned for assimp either. */
static froe_status check_shape(const gltf_check *c, const formats_json *node, const formats_json *mesh,
                               io_gltf_found *found) {
    const formats_json *weights = formats_json_get(node, "weights"), *skin = io_gltf_item(&c->skins, node, "skin");
    if (are_moved(weights ? weights : formats_json_get(mesh, "weights"))) io_leave(c->sink, "morph targets", 13);
    if (!skin) return FROE_OK;
    io_leave(c->sink, "skins", 5);
    return found->still ? mask_skin(c, node, found) : check_skin(c, node, skin);
}

static froe_status check_nodes(const gltf_check *c, io_gltf_found *found) {
    size_t number = 0;
    FORMATS_JSON_EACH(node, formats_json_get(c->root, "nodes")) {
        if (formats_json_get(formats_json_get(node, "extensions"), "EXT_mesh_gpu_instancing"))
            return fail_at(c, FROE_E_UNSUPPORTED, "node", number, node,
                           "It stands in many places by the extension EXT_mesh_gpu_instancing, which is not read.");
        if (!is_affine(formats_json_get(node, "matrix")))
            return fail_at(c, FROE_E_FORMAT, "node", number, node,
                           "Its matrix is not 16 numbers, of which those of the last row are 0, 0, 0 and 1.");
        if (!is_numbers(formats_json_get(node, "translation"), 3) ||
            !is_numbers(formats_json_get(node, "rotation"), 4) || !is_numbers(formats_json_get(node, "scale"), 3))
            return fail_at(c, FROE_E_FORMAT, "node", number, node,
                           "Its translation, rotation and scale are not 3, 4 and 3 numbers.");
        if (found->still && !is_unit(formats_json_get(node, "rotation")))
            return fail_at(c, FROE_E_FORMAT, "node", number, node,
                           "The quaternion of its rotation does not have the length 1.");
        const formats_json *mesh = io_gltf_item(&c->meshes, node, "mesh");
        const froe_status status = mesh ? check_shape(c, node, mesh, found) : FROE_OK;
        if (status) return status;
        number++;
    }
    return FROE_OK;
}

froe_status io_gltf_check(const formats_source *source, formats_sink *sink, io_gltf_found *found) {
    formats_text text = {0};
    formats_json_values values = {0};
    gltf_check c = {.sink = sink};
    froe_status status = load_text(source, sink, &text);
    const bool is_there = !status && text.count;
    const froe_status read =
        is_there ? formats_json_read(&sink->alloc, text.data, text.count, &values, &found->error) : FROE_E_FORMAT;
    if (read == FROE_E_MEMORY) status = support_fail_memory(sink->diag);
    c.root = values.data;
    c.text = text.data;
    c.begin = strncmp(source->head, "glTF", 4) ? 0 : IO_GLB_HEADER + IO_GLB_CHUNK;
    const char *version =
        read ? NULL : formats_json_string(formats_json_get(formats_json_get(c.root, "asset"), "version"));
    if (version && *version == '2') {
        const size_t scenes = formats_json_size(formats_json_get(c.root, "scenes"));
        sink->report.layers_left = scenes ? scenes - 1 : 0;
        status = check_extensions(&c);
        if (!status) status = check_buffers(&c);
        if (!status) status = list_items(&c);
        if (!status) status = check_meshes(&c);
        if (!status) status = check_nodes(&c, found);
        if (!status) status = io_gltf_count(sink, c.root, &c.accessors, &c.meshes, &c.nodes, &found->faces);
    }
    array_free(&sink->alloc, &c.accessors);
    array_free(&sink->alloc, &c.meshes);
    array_free(&sink->alloc, &c.nodes);
    array_free(&sink->alloc, &c.skins);
    array_free(&sink->alloc, &values);
    array_free(&sink->alloc, &text);
    return status;
}

froe_status io_gltf_is_whole(formats_sink *sink, const struct aiScene *scene, const io_gltf_found *found) {
    if (found->error.line && !strncmp(io_assimp_format(scene), "glTF2", 5))
        return support_fail(sink->diag, FROE_E_FORMAT, "%s: line %zu: %s", support_short(sink->path), found->error.line,
                            found->error.sentence);
    const size_t faces = found->faces;
    size_t read = 0;
    for (unsigned i = 0; i < scene->mNumMeshes; i++) read += scene->mMeshes[i]->mNumFaces;
    if (read >= faces) return FROE_OK;
    return support_fail(sink->diag, FROE_E_FORMAT,
                        "%s: Of %zu points, edges or triangles %zu name vertices that do not exist.",
                        support_short(sink->path), faces, faces - read);
}
