/* gltf.c: the animations of a glTF file (version 2.0, chapters 3.6, 3.11 and 4.4), read from the file itself. The nodes
 * are those of assimp, which has them in the order of the file. */
#include "animation/animation.h"
#include "formats/input/json.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef ARRAY(const formats_json *) json_list;

typedef struct gltf_bytes {
    formats_text text; /* what was read or decoded for it */
    const char *at;    /* NULL: not yet */
    size_t size;
} gltf_bytes;

typedef struct gltf_file {
    io_animation *animation;
    const io_nodes *nodes;
    formats_text file, json;
    const char *chunk; /* the binary chunk of a .glb; NULL */
    size_t chunk_size;
    formats_json_values values;
    json_list accessors, views, buffers, gltf_nodes, animations, samplers;
    ARRAY(gltf_bytes) bytes; /* of each buffer */
    ARRAY(size_t) node_of;   /* of each node of the file: that of the list, or SIZE_MAX */
} gltf_file;

static froe_status fail_gltf(const gltf_file *g, froe_status status, const char *sentence) {
    return support_fail(g->animation->sink->diag, status, "%s: %s", support_short(g->animation->sink->path), sentence);
}

static bool list_json(const gltf_file *g, const formats_json *array, json_list *out) {
    out->count = 0;
    if (!array_reserve(&g->animation->sink->alloc, out, formats_json_size(array))) return false;
    FORMATS_JSON_EACH(item, array) out->data[out->count++] = item;
    return true;
}

/* A member that is a whole number; `otherwise` if there is none, SIZE_MAX if it is none. */
static size_t whole_member(const formats_json *object, const char *name, size_t otherwise) {
    const formats_json *value = formats_json_get(object, name);
    if (!value) return otherwise;
    const bool whole = formats_json_is(value, FORMATS_JSON_NUMBER) && value->number >= 0 && value->number < 0x1p53 &&
                       value->number == floor(value->number);
    return whole ? (size_t)value->number : SIZE_MAX;
}

/* The item of a list that a member names by its number; NULL: there is none. */
static const formats_json *item_named(const json_list *list, const formats_json *object, const char *name) {
    const size_t i = whole_member(object, name, SIZE_MAX);
    return i < list->count ? list->data[i] : NULL;
}

static const char *text_member(const formats_json *object, const char *name) {
    const char *text = formats_json_string(formats_json_get(object, name));
    return text ? text : "";
}

/* ------------------------------------------------------------------------- file -- */

/* The text of a .gltf, or of the first chunk of a .glb. */
static froe_status find_text(gltf_file *g) {
    const formats_source *source = g->animation->source;
    const bool binary = !strncmp(source->head, "glTF", 4);
    const froe_status status = formats_load(source, g->animation->sink, binary, &g->file);
    if (status) return status;
    const char *text = g->file.data;
    size_t size = g->file.count;
    if (binary) {
        if (!io_glb_is_2(text, size))
            return fail_gltf(g, FROE_E_UNSUPPORTED,
                             "Animations are read from glTF 2, and the file is another version.");
        const size_t length = io_word_at(text + IO_GLB_HEADER), next = IO_GLB_HEADER + IO_GLB_CHUNK + length;
        if (length > size - IO_GLB_HEADER - IO_GLB_CHUNK)
            return fail_gltf(g, FROE_E_FORMAT, "A chunk of glTF is longer than the file.");
        if (next + IO_GLB_CHUNK <= size && !memcmp(text + next + 4, "BIN", 4)) {
            g->chunk = text + next + IO_GLB_CHUNK, g->chunk_size = io_word_at(text + next);
            if (g->chunk_size > size - next - IO_GLB_CHUNK)
                return fail_gltf(g, FROE_E_FORMAT, "A chunk of glTF is longer than the file.");
        }
        text += IO_GLB_HEADER + IO_GLB_CHUNK, size = strnlen(text, length); /* assimp takes it up to a zero */
    }
    enum { AHEAD = 16 }; /* zeros behind the text, as formats_load() has them: numbers are read ahead */
    if (!array_reserve(&g->animation->sink->alloc, &g->json, size + AHEAD))
        return support_fail_memory(g->animation->sink->diag);
    memcpy(g->json.data, text, size);
    memset(g->json.data + size, 0, AHEAD);
    g->json.count = size;
    return FROE_OK;
}

static froe_status parse_text(gltf_file *g) {
    formats_json_error error;
    const froe_allocator *alloc = &g->animation->sink->alloc;
    const froe_status status = formats_json_read(alloc, g->json.data, g->json.count, &g->values, &error);
    if (status == FROE_E_MEMORY) return support_fail_memory(g->animation->sink->diag);
    if (status)
        return support_fail(g->animation->sink->diag, status, "%s: line %zu: %s",
                            support_short(g->animation->sink->path), error.line, error.sentence);
    const formats_json *root = g->values.data;
    if (strncmp(text_member(formats_json_get(root, "asset"), "version"), "2", 1) != 0)
        return fail_gltf(g, FROE_E_UNSUPPORTED, "Animations are read from glTF 2, and the file is another version.");
    const bool room = list_json(g, formats_json_get(root, "accessors"), &g->accessors) &&
                      list_json(g, formats_json_get(root, "bufferViews"), &g->views) &&
                      list_json(g, formats_json_get(root, "buffers"), &g->buffers) &&
                      list_json(g, formats_json_get(root, "nodes"), &g->gltf_nodes) &&
                      list_json(g, formats_json_get(root, "animations"), &g->animations) &&
                      array_reserve(alloc, &g->bytes, g->buffers.count);
    if (!room) return support_fail_memory(g->animation->sink->diag);
    for (size_t i = 0; i < g->buffers.count; i++) g->bytes.data[i] = (gltf_bytes){.at = NULL};
    g->bytes.count = g->buffers.count;
    return FROE_OK;
}

/* ------------------------------------------------------------------------ nodes -- */

/* assimp lists the nodes of the scene that is to be shown, below one of its own where there are several roots. */
static froe_status match_nodes(gltf_file *g) {
    static const char sentence[] = "The nodes of the file are not as assimp has them.";
    const froe_allocator *alloc = &g->animation->sink->alloc;
    json_list scenes = {0}, row = {0};
    ARRAY(size_t) stack = {0};
    const formats_json *root = g->values.data;
    froe_status status = FROE_OK;
    bool room = list_json(g, formats_json_get(root, "scenes"), &scenes) &&
                array_reserve(alloc, &g->node_of, g->gltf_nodes.count);
    for (size_t i = 0; i < g->gltf_nodes.count && room; i++) g->node_of.data[i] = SIZE_MAX;
    const size_t number = whole_member(root, "scene", 0);
    const formats_json *below = number < scenes.count ? formats_json_get(scenes.data[number], "nodes") : NULL;
    size_t next = formats_json_size(below) == 1 ? 0 : 1;
    while (room && !status) { /* `below` are the roots, then the children of the node that was listed last */
        room = list_json(g, below, &row) && array_reserve(alloc, &stack, row.count);
        for (size_t i = row.count; i-- > 0 && room;)
            stack.data[stack.count++] = formats_json_is(row.data[i], FORMATS_JSON_NUMBER) && row.data[i]->number >= 0 &&
                                                row.data[i]->number < (double)g->gltf_nodes.count
                                            ? (size_t)row.data[i]->number
                                            : SIZE_MAX;
        if (!room || !stack.count) break;
        const size_t node = stack.data[--stack.count];
        if (node == SIZE_MAX || next >= g->nodes->count) {
            status = fail_gltf(g, FROE_E_UNSUPPORTED, sentence);
            break;
        }
        below = formats_json_get(g->gltf_nodes.data[node], "children");
        if (formats_json_size(below) != g->nodes->data[next].node->mNumChildren)
            status = fail_gltf(g, FROE_E_UNSUPPORTED, sentence);
        g->node_of.data[node] = next++;
    }
    array_free(alloc, &scenes), array_free(alloc, &row), array_free(alloc, &stack);
    return room ? status : support_fail_memory(g->animation->sink->diag);
}

/* ---------------------------------------------------------------------- numbers -- */

static int base64_digit(char c) {
    return c >= 'A' && c <= 'Z'   ? c - 'A'
           : c >= 'a' && c <= 'z' ? c - 'a' + 26
           : c >= '0' && c <= '9' ? c - '0' + 52
           : c == '+'             ? 62
           : c == '/'             ? 63
                                  : -1;
}

static bool decode_base64(const froe_allocator *alloc, const char *text, formats_text *out) {
    unsigned bits = 0;
    int filled = 0;
    if (!array_reserve(alloc, out, 3 * (strlen(text) / 4) + 3)) return false;
    for (; base64_digit(*text) >= 0; text++) {
        bits = bits << 6 | (unsigned)base64_digit(*text);
        filled += 6;
        if (filled < 8) continue;
        filled -= 8;
        out->data[out->count++] = (char)(bits >> filled & 255);
    }
    return true;
}

/* A file beside the model, or below its folder. */
static froe_status load_beside(gltf_file *g, const char *name, gltf_bytes *out) {
    const formats_source *from = g->animation->source;
    const char *slash = strrchr(from->file, '/');
    const int folder = slash ? (int)(slash - from->file) + 1 : 0;
    char path[4096];
    int used = snprintf(path, sizeof path, "%.*s", folder, from->file);
    if (*name == '/' || strstr(name, "..") || strchr(name, ':') || used < 0 ||
        (size_t)used + strlen(name) >= sizeof path)
        return fail_gltf(g, FROE_E_UNSUPPORTED, "A buffer is not at or below the folder of the file.");
    io_unescape(name, path + used);
    formats_source source;
    froe_status status = formats_source_open(path, NULL, &source, g->animation->sink->diag);
    if (!status) status = formats_load(&source, g->animation->sink, true, &out->text);
    out->at = out->text.data, out->size = out->text.count;
    return status;
}

static froe_status load_buffer(gltf_file *g, size_t i) {
    gltf_bytes *out = g->bytes.data + i;
    const char *uri = formats_json_string(formats_json_get(g->buffers.data[i], "uri"));
    if (out->at) return FROE_OK;
    if (!uri) {
        if (i || !g->chunk) return fail_gltf(g, FROE_E_FORMAT, "A buffer of glTF has no bytes.");
        out->at = g->chunk, out->size = g->chunk_size;
        return FROE_OK;
    }
    if (strncmp(uri, "data:", 5) != 0) return load_beside(g, uri, out);
    const char *comma = strchr(uri, ',');
    if (!comma || comma - uri < 7 || strncmp(comma - 7, ";base64", 7) != 0)
        return fail_gltf(g, FROE_E_UNSUPPORTED, "The bytes of a buffer are not in base64.");
    if (!decode_base64(&g->animation->sink->alloc, comma + 1, &out->text))
        return support_fail_memory(g->animation->sink->diag);
    out->at = out->text.data, out->size = out->text.count;
    return FROE_OK;
}

/* A number of a component type, as 3.6.2.2 and 3.11 of the specification turn it into one of floating point. */
static double component_at(const char *at, size_t type, bool shares) {
    const unsigned char *b = (const unsigned char *)at;
    const int whole = b[0] | b[1] << 8;
    float single;
    switch (type) {
    case 5120:
        return shares ? fmax((signed char)b[0] / 127.0, -1) : (signed char)b[0];
    case 5121:
        return shares ? b[0] / 255.0 : b[0];
    case 5122:
        return shares ? fmax((whole - (whole >> 15 << 16)) / 32767.0, -1) : whole - (whole >> 15 << 16);
    case 5123:
        return shares ? whole / 65535.0 : whole;
    default:
        break;
    }
    const uint32_t bits = (uint32_t)io_word_at(at);
    memcpy(&single, &bits, sizeof single);
    return single;
}

/* Appends the numbers of an accessor of elements of `width`. */
static froe_status read_accessor(gltf_file *g, const formats_json *accessor, size_t width, size_t *count) {
    static const struct {
        const char *name;
        size_t width;
    } kinds[] = {{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}};
    const formats_json *view = item_named(&g->views, accessor, "bufferView");
    const size_t buffer = whole_member(view, "buffer", SIZE_MAX), type = whole_member(accessor, "componentType", 0);
    const size_t size = type == 5126 ? 4 : type == 5122 || type == 5123 ? 2 : type == 5120 || type == 5121 ? 1 : 0;
    size_t given = 0;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (!strcmp(text_member(accessor, "type"), kinds[i].name)) given = kinds[i].width;
    if (accessor && (formats_json_get(accessor, "sparse") || formats_json_get(view, "extensions")))
        return fail_gltf(g, FROE_E_UNSUPPORTED, "The keys of an animation are sparse or compressed.");
    if (!view || buffer >= g->buffers.count || !size || given != width)
        return fail_gltf(g, FROE_E_FORMAT, "An accessor of an animation is broken.");
    const froe_status status = load_buffer(g, buffer);
    if (status) return status;
    const size_t stride = whole_member(view, "byteStride", size * width), start = whole_member(view, "byteOffset", 0);
    const size_t offset = whole_member(accessor, "byteOffset", 0), all = g->bytes.data[buffer].size;
    *count = whole_member(accessor, "count", 0);
    const bool fits = start <= all && offset <= all - start && stride >= size * width && stride <= 1 << 16 &&
                      (!*count || (size * width <= all - start - offset &&
                                   (*count - 1) <= (all - start - offset - size * width) / stride));
    if (!fits) return fail_gltf(g, FROE_E_FORMAT, "An accessor of an animation goes beyond its buffer.");
    if (!array_reserve(&g->animation->sink->alloc, &g->animation->numbers, *count * width))
        return support_fail_memory(g->animation->sink->diag);
    const formats_json *normalized = formats_json_get(accessor, "normalized");
    const bool shares = width == 4 || (formats_json_is(normalized, FORMATS_JSON_NAME) && *normalized->text == 't');
    const char *at = g->bytes.data[buffer].at + start + offset;
    double *out = g->animation->numbers.data + g->animation->numbers.count;
    for (size_t i = 0; i < *count; i++)
        for (size_t k = 0; k < width; k++) *out++ = component_at(at + i * stride + k * size, type, shares);
    g->animation->numbers.count += *count * width;
    return FROE_OK;
}

/* --------------------------------------------------------------------- channels -- */

static void read_rest(const formats_json *node, const char *name, size_t width, double *out) {
    const formats_json *values = formats_json_get(node, name);
    size_t k = 0;
    if (formats_json_size(values) != width) return;
    FORMATS_JSON_EACH(value, values) out[k++] = formats_json_is(value, FORMATS_JSON_NUMBER) ? value->number : 0;
}

/* The channel of a node, made where it is the first. */
static io_channel *channel_of(gltf_file *g, size_t node) {
    io_animation *a = g->animation;
    for (size_t i = 0; i < a->channels.count; i++)
        if (a->channels.data[i].node == g->node_of.data[node]) return a->channels.data + i;
    io_channel channel = {.node = g->node_of.data[node], .rest_turn = {0, 0, 0, 1}, .rest_scale = {1, 1, 1}};
    read_rest(g->gltf_nodes.data[node], "translation", 3, channel.rest_place);
    read_rest(g->gltf_nodes.data[node], "rotation", 4, channel.rest_turn);
    read_rest(g->gltf_nodes.data[node], "scale", 3, channel.rest_scale);
    return array_push(&a->sink->alloc, &a->channels, channel) ? a->channels.data + a->channels.count - 1 : NULL;
}

static froe_status read_sampler(gltf_file *g, const formats_json *sampler, const char *node, io_track *out) {
    static const char *const names[] = {"STEP", "LINEAR", "CUBICSPLINE"};
    const char *between = formats_json_string(formats_json_get(sampler, "interpolation"));
    size_t values = 0;
    out->between = IO_LINEAR;
    out->first = g->animation->numbers.count;
    bool known = !between;
    for (int i = 0; i < 3 && !known; i++)
        if (!strcmp(between, names[i])) out->between = (io_between)i, known = true;
    if (!known)
        return io_animation_fail(g->animation, FROE_E_UNSUPPORTED, node, "There is no interpolation '%.30s'.", between);
    froe_status status = read_accessor(g, item_named(&g->accessors, sampler, "input"), 1, &out->count);
    if (!status) status = read_accessor(g, item_named(&g->accessors, sampler, "output"), out->width, &values);
    if (!status && (!out->count || values != out->count * (out->between == IO_CUBIC ? 3 : 1)))
        status = io_animation_fail(g->animation, FROE_E_FORMAT, node, "There are %zu values for %zu times.", values,
                                   out->count);
    return status;
}

static froe_status read_channel(gltf_file *g, const formats_json *channel) {
    const formats_json *target = formats_json_get(channel, "target");
    const char *path = text_member(target, "path");
    const size_t node = whole_member(target, "node", g->gltf_nodes.count);
    if (!formats_json_get(target, "node")) return FROE_OK; /* of an extension */
    if (node >= g->gltf_nodes.count)
        return fail_gltf(g, FROE_E_FORMAT, "An animation moves a node that does not exist.");
    const formats_json *moved = g->gltf_nodes.data[node];
    const char *name = text_member(moved, "name");
    if (g->node_of.data[node] == SIZE_MAX) return FROE_OK; /* it is not in the scene */
    if (!strcmp(path, "weights"))
        return io_animation_fail(g->animation, FROE_E_UNSUPPORTED, name,
                                 "It changes the shape of its mesh (morph targets), and parts move as rigid bodies.");
    if (formats_json_get(moved, "matrix"))
        return io_animation_fail(g->animation, FROE_E_FORMAT, name, "It moves, and so it may not have a matrix.");
    io_channel *c = channel_of(g, node);
    if (!c) return support_fail_memory(g->animation->sink->diag);
    const bool turn = !strcmp(path, "rotation"), scale = !strcmp(path, "scale");
    io_track *track = turn ? &c->turn : scale ? &c->scale : &c->place;
    if (!turn && !scale && strcmp(path, "translation") != 0)
        return io_animation_fail(g->animation, FROE_E_UNSUPPORTED, name, "It has no property '%.30s'.", path);
    if (track->count)
        return io_animation_fail(g->animation, FROE_E_FORMAT, name, "Two channels are about its %.30s.", path);
    track->width = turn ? 4 : 3;
    return read_sampler(g, item_named(&g->samplers, channel, "sampler"), name, track);
}

static const char *name_of_gltf(const void *user, size_t i) {
    const gltf_file *g = user;
    return text_member(g->animations.data[i], "name");
}

froe_status io_animation_of_gltf(io_animation *animation, const io_nodes *nodes) {
    gltf_file g = {.animation = animation, .nodes = nodes};
    const froe_allocator *alloc = &animation->sink->alloc;
    size_t chosen = 0;
    froe_status status = find_text(&g);
    if (!status) status = parse_text(&g);
    if (!status) status = io_animation_choose(animation, g.animations.count, name_of_gltf, &g, &chosen);
    if (!status) status = match_nodes(&g);
    if (!status) {
        const formats_json *chosen_one = g.animations.data[chosen];
        if (!list_json(&g, formats_json_get(chosen_one, "samplers"), &g.samplers))
            status = support_fail_memory(animation->sink->diag);
        FORMATS_JSON_EACH(channel, formats_json_get(chosen_one, "channels")) {
            if (!status) status = read_channel(&g, channel);
        }
    }
    for (size_t i = 0; i < g.bytes.count; i++) array_free(alloc, &g.bytes.data[i].text);
    array_free(alloc, &g.file), array_free(alloc, &g.json), array_free(alloc, &g.values);
    array_free(alloc, &g.accessors), array_free(alloc, &g.views), array_free(alloc, &g.buffers);
    array_free(alloc, &g.gltf_nodes), array_free(alloc, &g.animations), array_free(alloc, &g.samplers);
    array_free(alloc, &g.bytes), array_free(alloc, &g.node_of);
    return status;
}
