/* glTF with an animation in every container, and with each word of its text changed: the motion is the same, or there
 * is a status and a sentence. */
#include "animated.h"
#include "support/memory.h"
#include "support/sanitized.h"
#include <ctype.h>
#include <sys/resource.h>
#include <sys/stat.h>

enum { MOST = 1 << 16 };

/* A triangle that turns and moves, beside one that stands. */
static void make_model(animated_model *m) {
    *m = (animated_model){.nodes = 2, .corners = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}}};
    for (int n = 0; n < 2; n++)
        m->node[n] = (animated_node){.parent = -1, .mesh = true, .turn = {0, 0, 0, 1}, .scale = {1, 1, 1}};
    m->node[1].place[0] = -3;
    m->node[0].track[0] =
        (animated_track){.count = 2, .between = STEP, .times = {0, 2}, .values = {{0, 0, 0}, {0, 0, 1}}};
    m->node[0].track[1] =
        (animated_track){.count = 2, .between = LINEAR, .times = {0, 2}, .values = {{0, 0, 0, 1}, {0, 1, 0, 0}}};
}

static size_t slurp(const char *path, char bytes[MOST]) {
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t size = fread(bytes, 1, MOST - 1, file);
    fclose(file);
    bytes[size] = 0;
    return size;
}

/* Reads a file; its motion as text in `out`. */
static froe_status follow(const char *path, char out[MOST], froe_diagnostic *diag) {
    froe_motion *motion = NULL;
    *diag = (froe_diagnostic){.message = ""};
    const froe_status status = froe_read_animation(path, NULL, &motion, NULL, diag);
    if (!status == !motion || !status == !!*diag->message) fail_msg("%s: status %d: %s", path, status, diag->message);
    if (!status && froe_write_motion(motion, "motion.mfjson", diag)) fail_msg("%s", diag->message);
    if (!status && out) slurp("motion.mfjson", out);
    froe_motion_free(motion);
    return status;
}

static void every_container_has_the_same_motion(void **state) {
    (void)state;
    static animated_model m;
    static char within[MOST], other[MOST];
    froe_diagnostic why;
    make_model(&m);
    (void)mkdir("folder", 0777);
    animated_write(&m, "within.gltf");
    animated_write_as(&m, "folder/beside.gltf", ANIMATED_BESIDE, "folder/all its numbers.bin",
                      "all%20its%20numbers%2Ebin");
    animated_write_as(&m, "chunks.glb", ANIMATED_CHUNKS, NULL, NULL);
    assert_int_equal(follow("within.gltf", within, &why), FROE_OK);
    static const char *const others[] = {"folder/beside.gltf", "chunks.glb"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        if (follow(others[i], other, &why)) fail_msg("%s: %s", others[i], why.message);
        assert_string_equal(other, within);
    }
}

/* Some writers fill the chunk of the text up with zeros in place of blanks. */
static void zeros_may_end_the_text_in_chunks(void **state) {
    (void)state;
    static animated_model m;
    static char bytes[MOST], within[MOST], other[MOST];
    froe_diagnostic why;
    make_model(&m);
    animated_write_as(&m, "chunks.glb", ANIMATED_CHUNKS, NULL, NULL);
    assert_int_equal(follow("chunks.glb", within, &why), FROE_OK);
    const size_t size = slurp("chunks.glb", bytes);
    size_t end = 20 + (unsigned char)bytes[12] + 256u * (unsigned char)bytes[13];
    assert_true(bytes[end - 1] == ' ' || bytes[end - 1] == '\n');
    while (bytes[end - 1] == ' ' || bytes[end - 1] == '\n') bytes[--end] = '\0';
    write_bytes("zeros.glb", bytes, size);
    if (follow("zeros.glb", other, &why)) fail_msg("%s", why.message);
    assert_string_equal(other, within);
}

/* What may stand instead of a word. */
static const char *const words[] = {"",
                                    "-1",
                                    "0",
                                    "1",
                                    "2.5",
                                    "1e300",
                                    "7",
                                    "null",
                                    "true",
                                    "\"\"",
                                    "\"x/../y\"",
                                    "[]",
                                    "{}",
                                    "\"data:,AA\"",
                                    "\"data:;base64,AAAA\"",
                                    "\"absent.bin\"",
                                    "5120",
                                    "5121",
                                    "5122",
                                    "5123",
                                    "\"VEC4\""};

/* The end of the number or string that begins here; NULL: none does. */
static char *end_of_word(char *at) {
    if (*at == '"') return strchr(at + 1, '"') + 1;
    char *end = at;
    while (isdigit((unsigned char)*end) || (*end && strchr("-+.eE", *end))) end++;
    return end == at ? NULL : end;
}

static void each_word_may_be_another(void **state) {
    (void)state;
    static animated_model m;
    static char text[MOST], changed[2 * MOST], right[MOST];
    size_t read = 0, refused = 0;
    froe_diagnostic why;
    make_model(&m);
    animated_write_as(&m, "words.gltf", ANIMATED_BESIDE, "words.bin", "words.bin");
    slurp("words.gltf", text);
    assert_int_equal(follow("words.gltf", right, &why), FROE_OK);
    size_t next = 0;
    for (char *at = text, *end; *at; at = end) {
        end = end_of_word(at);
        if (!end) {
            end = at + 1;
            continue;
        }
        const bool name = *end == ':';
        for (int k = 0; k < (name ? 1 : 2); k++) { /* a member of another name, or some of all words */
            const char *word = name ? "\"other\"" : words[next++ % (sizeof words / sizeof *words)];
            snprintf(changed, sizeof changed, "%.*s%s%s", (int)(at - text), text, word, end);
            write_text("changed.gltf", changed);
            if (follow("changed.gltf", NULL, &why))
                refused++;
            else
                read++;
        }
    }
    if (read < 30 || refused < 100) fail_msg("%zu read, %zu refused", read, refused);
}

static void each_byte_of_the_chunks_may_be_another(void **state) {
    (void)state;
    static animated_model m;
    static char bytes[MOST];
    froe_diagnostic why;
    size_t read = 0, refused = 0;
    make_model(&m);
    animated_write_as(&m, "chunks.glb", ANIMATED_CHUNKS, NULL, NULL);
    const size_t size = slurp("chunks.glb", bytes),
                 json = 20 + (unsigned char)bytes[12] + 256u * (unsigned char)bytes[13];
    for (size_t at = 0; at < json + 8; at = at == 19 ? json : at + 1)
        for (int value = 0; value < 256; value += 85) {
            const char before = bytes[at];
            bytes[at] = (char)value;
            write_bytes("changed.glb", bytes, size);
            bytes[at] = before;
            if (follow("changed.glb", NULL, &why))
                refused++;
            else
                read++;
        }
    for (size_t cut = 0; cut < size; cut += 1 + (cut > 40) * 29) {
        write_bytes("changed.glb", bytes, cut);
        assert_int_not_equal(follow("changed.glb", NULL, &why), FROE_OK);
    }
    if (read < 1 || refused < 20) fail_msg("%zu read, %zu refused", read, refused);
}

/* A triangle that is moved by keys of a component type, in a buffer beside the model. */
#define TYPED(kind, more)                                                                                              \
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]},{\"nodes\":[1]}],\"nodes\":[{\"mesh\":"  \
    "0,"                                                                                                               \
    "\"name\":\"n\"},{\"name\":\"m\"}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"buffers\":" \
    "[{\"byteLength\":84,\"uri\":\"typed.bin\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,"     \
    "\"byteOffset\":36,\"byteLength\":8},{\"buffer\":0,\"byteOffset\":44,\"byteLength\":40}],\"accessors\":["          \
    "{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},{\"bufferView\":1,\"componentType\":"     \
    "5126,"                                                                                                            \
    "\"count\":2,\"type\":\"SCALAR\"},{\"bufferView\":2,\"componentType\":" kind ",\"count\":2,\"type\":\"VEC3\"" more \
    "}],\"animations\":[{\"name\":\"go\",\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":"                \
    "\"translation\"}"                                                                                                 \
    "}],\"samplers\":[{\"input\":1,\"output\":2}]}]}"

/* Three corners, two times, and the bytes of keys: at 0 at the origin, then `last`. */
static void write_typed(const void *last, size_t size) {
    const float head[11] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1};
    unsigned char bytes[sizeof head + 40] = {0};
    memcpy(bytes, head, sizeof head);
    memcpy(bytes + sizeof head + size, last, size);
    write_bytes("typed.bin", bytes, sizeof bytes);
}

static void keys_have_every_component_type(void **state) {
    (void)state;
    static const signed char bytes[3] = {-128, 127, 1};
    static const unsigned char unsigned_bytes[3] = {255, 128, 0};
    static const short shorts[3] = {-32768, 32767, -1};
    static const unsigned short unsigned_shorts[3] = {65535, 32768, 0};
    static const float floats[3] = {0.5f, -2, 1e30f};
    static const struct {
        const char *text;
        const void *last;
        size_t size;
        double at[3];
    } cases[] = {
        {TYPED("5120", ""), bytes, 3, {-128, 127, 1}},
        {TYPED("5120", ",\"normalized\":true"), bytes, 3, {-1, 1, 1 / 127.0}},
        {TYPED("5121", ""), unsigned_bytes, 3, {255, 128, 0}},
        {TYPED("5121", ",\"normalized\":true"), unsigned_bytes, 3, {1, 128 / 255.0, 0}},
        {TYPED("5122", ",\"normalized\":false"), shorts, 6, {-32768, 32767, -1}},
        {TYPED("5122", ",\"normalized\":true"), shorts, 6, {-1, 1, -1 / 32767.0}},
        {TYPED("5123", ",\"normalized\":1"), unsigned_shorts, 6, {65535, 32768, 0}},
        {TYPED("5123", ",\"normalized\":true"), unsigned_shorts, 6, {1, 32768 / 65535.0, 0}},
        {TYPED("5126", ",\"normalized\":true"), floats, 12, {0.5, -2, 1e30f}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_motion *motion = NULL;
        froe_diagnostic why = {.message = ""};
        double at[3];
        write_typed(cases[i].last, cases[i].size);
        write_text("typed.gltf", cases[i].text);
        if (froe_read_animation("typed.gltf", NULL, &motion, NULL, &why)) fail_msg("case %zu: %s", i, why.message);
        assert_true(froe_motion_position(motion, froe_motion_object(motion, 0).vertices[0], 1, at));
        for (int k = 0; k < 3; k++)
            if (at[k] != cases[i].at[k]) fail_msg("case %zu, axis %d: %.17g", i, k, at[k]);
        froe_motion_free(motion);
    }
}

/* The animation of the file is not read, and this is said behind its name. */
static void must_say(const char *path, froe_status status, const char *sentence) {
    char message[300];
    froe_diagnostic why;
    const froe_status found = follow(path, NULL, &why);
    snprintf(message, sizeof message, "%s: %s", path, sentence);
    if (found != status || strcmp(message, why.message) != 0)
        fail_msg("expected '%s': %s: '%s'", sentence, froe_status_name(found), why.message);
}

/* What is wrong with a file that assimp takes: words of it, others instead, and what is said. */
static void what_is_wrong_with_an_animation_is_said(void **state) {
    (void)state;
    static const struct {
        const char *from, *to;
        froe_status status;
        const char *message;
    } cases[] = {
        {"\"count\":2,\"type\":\"VEC3\"",
         "\"count\":2,\"type\":\"VEC3\",\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":1,\"componentType\":5121},"
         "\"values\":{\"bufferView\":2}}",
         FROE_E_UNSUPPORTED, "The keys of an animation are sparse or compressed."},
        {"\"byteLength\":40", "\"byteLength\":40,\"extensions\":{}", FROE_E_UNSUPPORTED,
         "The keys of an animation are sparse or compressed."},
        {"\"output\":2", "\"output\":1", FROE_E_FORMAT, "An accessor of an animation is broken."},
        {"\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"", "\"componentType\":5125,\"count\":2,\"type\":\"VEC3\"",
         FROE_E_FORMAT, "An accessor of an animation is broken."},
        {"\"byteLength\":40", "\"byteLength\":40,\"byteStride\":8", FROE_E_FORMAT,
         "An accessor of an animation goes beyond its buffer."},
        {"\"count\":2,\"type\":\"SCALAR\"", "\"count\":1,\"type\":\"SCALAR\"", FROE_E_FORMAT,
         "animation 'go': node 'n': There are 2 values for 1 times."},
        {"\"count\":2,\"type\":\"SCALAR\"", "\"count\":0,\"type\":\"SCALAR\"", FROE_E_FORMAT,
         "animation 'go': node 'n': There are 2 values for 0 times."},
        {"\"output\":2", "\"output\":2,\"interpolation\":\"CUBICSPLINE\"", FROE_E_FORMAT,
         "animation 'go': node 'n': There are 2 values for 2 times."},
        {"\"output\":2", "\"output\":2,\"interpolation\":\"SMOOTH\"", FROE_E_UNSUPPORTED,
         "animation 'go': node 'n': There is no interpolation 'SMOOTH'."},
        {"\"translation\"", "\"pointer\"", FROE_E_UNSUPPORTED,
         "animation 'go': node 'n': It has no property 'pointer'."},
        {"\"name\":\"n\"", "\"name\":\"n\",\"matrix\":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]", FROE_E_FORMAT,
         "animation 'go': node 'n': It moves, and so it may not have a matrix."},
        {"\"name\":\"n\"", "\"name\":\"n\",\"rotation\":[0,0,0,2]", FROE_E_INPUT,
         "animation 'go': node 'n': The quaternion of its rotation does not have the length 1."},
        {"}],\"samplers\"", "},{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"translation\"}}],\"samplers\"",
         FROE_E_FORMAT, "animation 'go': node 'n': Two channels are about its translation."},
        {"\"target\":{\"node\":0", "\"target\":{\"node\":1", FROE_E_INPUT,
         "animation 'go': It has no two keys at different times."}, /* the node is in another scene */
        {"\"target\":{\"node\":0,", "\"target\":{", FROE_E_INPUT,
         "animation 'go': It has no two keys at different times."}, /* the target is one of an extension */
        {"\"animations\":[", "\"animations\":[{\"name\":\"on\",\"channels\":[],\"samplers\":[]},", FROE_E_OPTIONS,
         "There are several animations, and one has to be named: 'on', 'go'."},
        {"\"animations\":[", "\"others\":[", FROE_E_INPUT, "The model has no animation."},
    };
    static const float last[3] = {1, 2, 3};
    write_typed(last, sizeof last);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        static const char text[] = TYPED("5126", "");
        char changed[2 * sizeof text];
        const char *from = strstr(text, cases[i].from);
        assert_non_null(from);
        snprintf(changed, sizeof changed, "%.*s%s%s", (int)(from - text), text, cases[i].to,
                 from + strlen(cases[i].from));
        write_text("typed.gltf", changed);
        must_say("typed.gltf", cases[i].status, cases[i].message);
    }
}

#define LONG TEN TEN TEN TEN TEN TEN TEN TEN TEN TEN TEN "text"
#define TEN "text/plain"

/* A channel whose sampler has times alone, in a second buffer: assimp takes nearly any. */
static void write_second(const char *count, const char *view, const char *buffer) {
    FILE *file = fopen("buffer.gltf", "w");
    assert_non_null(file);
    fprintf(
        file,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],\"meshes\":"
        "[{"
        "\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,"
        "\"count\":3,\"type\":\"VEC3\"},{\"componentType\":5126,\"type\":\"SCALAR\",\"bufferView\":1,\"count\":%s}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":1,\"byteLength\":%s}],\"buffers\":[{"
        "\"byteLength\":"
        "36,\"uri\":\"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"},{\"byteLength\":%s}],"
        "\"animations\":["
        "{\"name\":\"go\",\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"scale\"}}],\"samplers\":[{"
        "\"input\":"
        "1}]}]}",
        count, view, buffer);
    fclose(file);
}

static void what_is_wrong_with_a_buffer_is_said(void **state) {
    (void)state;
    static const char outside[] = "A buffer is not at or below the folder of the file.",
                      other[] = "The bytes of a buffer are not in base64.",
                      beyond[] = "An accessor of an animation goes beyond its buffer.",
                      no_output[] = "An accessor of an animation is broken.", /* the times are read, values are none */
        digits[] = "buffer 1: Its data are not in base64 with the digits A-Z, a-z, 0-9, + and / alone.";
    static const struct {
        const char *count, *view, *buffer;
        froe_status status;
        const char *message;
    } cases[] = {
        {"0", "0", "0", FROE_E_FORMAT, "A buffer of glTF has no bytes."},
        {"0", "0", "0,\"uri\":\"/x.bin\"", FROE_E_UNSUPPORTED, outside},
        {"0", "0", "0,\"uri\":\"../x.bin\"", FROE_E_UNSUPPORTED, outside},
        {"0", "0", "0,\"uri\":\"file:x.bin\"", FROE_E_UNSUPPORTED, outside},
        {"0", "0", "7,\"uri\":\"data:nothing\"", FROE_E_UNSUPPORTED, other},
        {"0", "0", "0,\"uri\":\"data:,\"", FROE_E_UNSUPPORTED, other},
        {"0", "0", "0,\"uri\":\"data:text/plain,\"", FROE_E_UNSUPPORTED, other},
        {"0", "0", "0,\"uri\":\"data:;base64,\"", FROE_E_FORMAT, no_output},
        {"1", "4", "4,\"uri\":\"data:;base64,+//+AA==\"", FROE_E_FORMAT, no_output},
        {"1", "4", "4,\"uri\":\"data:;base64,+-/+AA==\"", FROE_E_FORMAT, digits},
        {"1", "4", "4,\"uri\":\"data:;base64,+_/+AA==\"", FROE_E_FORMAT, digits},
        {"1", "4", "4,\"uri\":\"data:;base64,AA=AAA==\"", FROE_E_FORMAT, digits},
        {"1", "4", "4,\"uri\":\"data:x,;base64,-\"", FROE_E_FORMAT,
         "The reader assimp reports 'GLTF: buffer \"buffers[1]\", expected 4 bytes, but found 9'."},
        {"1", "4", "4,\"uri\":\"data:" LONG ";base64,AAAAAA==\"", FROE_E_FORMAT, no_output},
        {"1", "4", "4,\"uri\":\"data:1" LONG ";base64,AAAAAA==\"", FROE_E_FORMAT,
         "buffer 1: More than 126 letters are before its data."},
        {"1", "4,\"byteStride\":70000", "4,\"uri\":\"data:;base64,AAAAAA==\"", FROE_E_FORMAT, beyond},
        {"1", "4", "4,\"uri\":\"%67%6A%6b%G%1%4!.bin\"", FROE_E_FORMAT, no_output},
        {"1", "4", "4,\"uri\":\"%6g%6G.bin\"", FROE_E_FORMAT, no_output},
        {"1", "4", "4,\"uri\":\"data:;base64,AAA!AA==\"", FROE_E_FORMAT, digits},
        {"1,\"byteOffset\":4", "8", "8,\"uri\":\"data:;base64,AAAAAA==\"", FROE_E_FORMAT,
         "The reader assimp reports 'GLTF: buffer \"buffers[1]\", expected 8 bytes, but found 8'."},
    };
    write_bytes("gjk%G%1%4!.bin", "four", 4);
    write_bytes("%6g%6G.bin", "four", 4), write_bytes("%6Fnly.bin", "four", 4), remove("only.bin");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_second(cases[i].count, cases[i].view, cases[i].buffer);
        must_say("buffer.gltf", cases[i].status, cases[i].message);
    }
    froe_diagnostic why;
    write_second("1", "4", "4,\"uri\":\"%6Fnly.bin\"");
    assert_int_equal(follow("buffer.gltf", NULL, &why), FROE_E_IO);
    assert_string_equal(why.message, "only.bin: The file cannot be read: No such file or directory.");
    char name[5000] = "0,\"uri\":\"";
    const size_t used = strlen(name);
    memset(name + used, 'x', sizeof name - used);
    memcpy(name + sizeof name - 2, "\"", 2);
    write_second("0", "0", name);
    must_say("buffer.gltf", FROE_E_UNSUPPORTED, outside);
}

/* Nodes that assimp leaves out, and versions that it reads. */
static void what_is_wrong_with_nodes_and_versions_is_said(void **state) {
    (void)state;
    static const char first[] = "{\"asset\":{\"version\":\"1.0\"},\"scene\":\"s\",\"scenes\":{\"s\":{\"nodes\":[\"n\"]}"
                                "},\"nodes\":{\"n\":{\"meshes\":[\"m\"]}"
                                "},\"meshes\":{\"m\":{\"primitives\":[{\"attributes\":{\"POSITION\":\"a\"}}]}},"
                                "\"accessors\":{\"a\":{\"bufferView\":\"v\","
                                "\"componentType\":5126,\"byteOffset\":0,\"byteStride\":12,\"count\":3,\"type\":"
                                "\"VEC3\"}},\"bufferViews\":{\"v\":{"
                                "\"buffer\":\"b\",\"byteOffset\":0,\"byteLength\":36}},\"buffers\":{\"b\":{"
                                "\"byteLength\":36,\"uri\":\"data:;base64,"
                                "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}}}   ",
                      version[] = "Animations are read from glTF 2, and the file is another version.",
                      nodes[] = "The nodes of the file are not as assimp has them.";
    unsigned char binary[20 + sizeof first] = "glTF\1";
    const size_t text = (sizeof first - 1) / 4 * 4, size = 20 + text;
    write_text("first.gltf", first);
    must_say("first.gltf", FROE_E_UNSUPPORTED, version);
    for (int k = 0; k < 2; k++)
        binary[8 + k] = (unsigned char)(size >> 8 * k), binary[12 + k] = (unsigned char)(text >> 8 * k);
    memcpy(binary + 20, first, text);
    write_bytes("first.glb", binary, size);
    must_say("first.glb", FROE_E_UNSUPPORTED, version);
    static const char *const changes[] = {"\"name\":\"m\",\"children\":[-1]", "\"name\":\"m\",\"children\":[\"x\"]"};
    static const char typed[] = TYPED("5126", "");
    const char *from = strstr(typed, "\"scene\":0,"), *name = strstr(typed, "\"name\":\"m\"");
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        char changed[2 * sizeof typed];
        snprintf(changed, sizeof changed, "%.*s\"scene\":1,%.*s%s%s", (int)(from - typed), typed,
                 (int)(name - from) - 10, from + 10, changes[i], name + 10);
        write_text("nodes.gltf", changed);
        must_say("nodes.gltf", FROE_E_UNSUPPORTED, nodes);
    }
}

/* By its name, or else by its number. */
static void animations_are_chosen_by_name_and_number(void **state) {
    (void)state;
#define THESE "There are: '8', 'a long name of an animation, a', '', '', '', '', '', '', '', '', '', 'go'."
    static const char text[] = TYPED("5126", "");
    static const struct {
        const char *asked, *message;
    } cases[] = {{"go", ""}, /* the last */
                 {"8", ""},  /* the first, by its name */
                 {"11", ""}, /* the last, by its number */
                 {"1", "animation 'a long name of an animation, and more': It has no two keys at different times."},
                 {"", "animation '': It has no two keys at different times."},
                 {"12", "There is no animation '12'. " THESE},
                 {"1x", "There is no animation '1x'. " THESE},
                 {"-1", "There is no animation '-1'. " THESE}};
    char changed[2 * sizeof text];
    static const float last[3] = {1, 2, 3};
    const char *name = strstr(text, "\"go\"");
    assert_non_null(name);
    write_typed(last, sizeof last);
    const size_t rest = strlen(name) - 2; /* without the ends of the array and of the file */
    int used = snprintf(changed, sizeof changed, "%.*s\"8\"%.*s,{\"name\":\"a long name of an animation, and more\"}",
                        (int)(name - text), text, (int)rest - 4, name + 4);
    for (int i = 2; i < 11; i++) used += snprintf(changed + used, sizeof changed - (size_t)used, ",{}");
    snprintf(changed + used, sizeof changed - (size_t)used, ",{\"name\":%s", name);
    write_text("named.gltf", changed);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_motion *motion = NULL;
        froe_diagnostic why = {.message = ""};
        froe_motion_read_options o = froe_motion_read_defaults();
        o.animation = cases[i].asked;
        const froe_status status = froe_read_animation("named.gltf", &o, &motion, NULL, &why);
        char message[300];
        snprintf(message, sizeof message, "%s%s", *cases[i].message ? "named.gltf: " : "", cases[i].message);
        if (!status != !*message || strcmp(why.message, message))
            fail_msg("%s: %s: '%s'", cases[i].asked, froe_status_name(status), why.message);
        assert_int_equal(!motion, *message != '\0');
        froe_motion_free(motion);
    }
}

/* Of names of animations those are told that there is room for. */
static void many_names_of_animations_are_cut(void **state) {
    (void)state;
    static const char text[] = TYPED("5126", "");
    static const float last[3] = {1, 2, 3};
    char changed[4 * sizeof text];
    const char *name = strstr(text, "{\"name\":\"go\"");
    assert_non_null(name);
    write_typed(last, sizeof last);
    int used = snprintf(changed, sizeof changed, "%.*s", (int)(name - text), text);
    for (int i = 0; i < 9; i++)
        used += snprintf(changed + used, sizeof changed - (size_t)used,
                         "{\"name\":\"%d, which has thirty letters...\"},", i);
    snprintf(changed + used, sizeof changed - (size_t)used, "%s", name);
    write_text("many.gltf", changed);
    must_say("many.gltf", FROE_E_OPTIONS,
             "There are several animations, and one has to be named: '0, which has thirty letters...', "
             "'1, which has thirty letters...', '2, which has thirty letters...', '3, which has thi.");
}

/* A length that became -1 is 4 GB, which assimp would fill with zeros. */
static void limit_memory(void) {
    const struct rlimit most = {(rlim_t)1 << 30, (rlim_t)1 << 30};
    if (!SANITIZED) assert_int_equal(setrlimit(RLIMIT_AS, &most), 0); /* a sanitizer needs more for its own tables */
}

int main(void) {
    limit_memory();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_container_has_the_same_motion),
        cmocka_unit_test(zeros_may_end_the_text_in_chunks),
        cmocka_unit_test(keys_have_every_component_type),
        cmocka_unit_test(what_is_wrong_with_an_animation_is_said),
        cmocka_unit_test(what_is_wrong_with_a_buffer_is_said),
        cmocka_unit_test(what_is_wrong_with_nodes_and_versions_is_said),
        cmocka_unit_test(animations_are_chosen_by_name_and_number),
        cmocka_unit_test(many_names_of_animations_are_cut),
        cmocka_unit_test(each_word_may_be_another),
        cmocka_unit_test(each_byte_of_the_chunks_may_be_another),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
