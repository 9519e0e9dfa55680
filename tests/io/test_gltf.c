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
    char bytes[MOST]; /* some versions of assimp look for the name as it is written */
    write_bytes("folder/all%20its%20numbers%2Ebin", bytes, slurp("folder/all its numbers.bin", bytes));
    assert_int_equal(follow("within.gltf", within, &why), FROE_OK);
    static const char *const others[] = {"folder/beside.gltf", "chunks.glb"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        if (follow(others[i], other, &why)) fail_msg("%s: %s", others[i], why.message);
        assert_string_equal(other, within);
    }
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

/* A length that became -1 is 4 GB, which assimp would fill with zeros. */
static void limit_memory(void) {
    const struct rlimit most = {(rlim_t)1 << 30, (rlim_t)1 << 30};
    if (!SANITIZED) assert_int_equal(setrlimit(RLIMIT_AS, &most), 0); /* a sanitizer needs more for its own tables */
}

int main(void) {
    limit_memory();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_container_has_the_same_motion),
        cmocka_unit_test(each_word_may_be_another),
        cmocka_unit_test(each_byte_of_the_chunks_may_be_another),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
