/* picture.c: PNG as base64 (RFC 4648), made by the draw library. */
#include "compare/picture.h"
#include "args/budget.h"
#include <froe/draw.h>
#include <stdlib.h>
#include <string.h>

typedef struct buffer {
    unsigned char *bytes;
    size_t count, capacity;
} buffer;

static bool take(void *user, const void *bytes, size_t count) {
    buffer *b = user;
    if (b->capacity - b->count < count) {
        const size_t capacity = 2 * b->capacity + count;
        unsigned char *more = realloc(b->bytes, capacity);
        if (!more) return false;
        b->bytes = more;
        b->capacity = capacity;
    }
    memcpy(b->bytes + b->count, bytes, count);
    b->count += count;
    return true;
}

static json_t *base64_json(const buffer *b) {
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char *text = malloc(4 * (b->count / 3 + 1) + 1), *to = text;
    if (!text) return NULL;
    for (size_t i = 0; i < b->count; i += 3) {
        const size_t left = b->count - i;
        const unsigned word =
            (unsigned)b->bytes[i] << 16 | (left > 1 ? b->bytes[i + 1] : 0u) << 8 | (left > 2 ? b->bytes[i + 2] : 0u);
        *to++ = letters[word >> 18];
        *to++ = letters[word >> 12 & 63];
        *to++ = left > 1 ? letters[word >> 6 & 63] : '=';
        *to++ = left > 2 ? letters[word & 63] : '=';
    }
    json_t *json = json_stringn_nocheck(text, (size_t)(to - text));
    free(text);
    return json;
}

json_t *picture_json(const froe_tree *tree, bool cells) {
    froe_draw_options o = froe_draw_defaults();
    buffer b = {.count = 0};
    o.width = 480;
    o.legend = false;
    if (!cells) o.show = FROE_DRAW_OBJECTS;
    o.margin = 8;
    const froe_status status = froe_draw_write(tree, FROE_DRAW_PNG, take, &b, &o, NULL);
    json_t *json = status ? json_null() : base64_json(&b);
    free(b.bytes);
    return json;
}

json_t *picture_scene_json(froe_scene *scene) {
    froe_build_options o = froe_build_defaults();
    froe_tree *tree;
    o.purpose = "query"; /* the quickest to build */
    o.max_fragments = cli_budget(CLI_BUDGET_OWN, scene);
    if (froe_build(scene, &o, &tree, NULL)) return json_null();
    json_t *json = picture_json(tree, false);
    froe_tree_free(tree);
    return json;
}
