/* picture.c: PNG as base64 (RFC 4648), made by the draw library. */
#include "compare/picture.h"
#include "args/budget.h"
#include "library.h"
#include "report/report.h"
#include "support/array.h"
#include <stdlib.h>

typedef ARRAY(unsigned char) byte_array;

static bool take(void *user, const void *bytes, size_t count) {
    const froe_allocator alloc = support_allocator(NULL);
    byte_array *all = user;
    if (array_append(&alloc, all, bytes, count)) return true;
    (void)cli_report_lose(); /* the library calls it a failure to write */
    return false;
}

static json_t *base64_json(const unsigned char *bytes, size_t count) {
    static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char *text = malloc(4 * (count / 3 + 1) + 1), *to = text;
    if (!text) return cli_report_lose();
    for (size_t i = 0; i < count; i += 3) {
        const size_t left = count - i;
        const unsigned word =
            (unsigned)bytes[i] << 16 | (left > 1 ? bytes[i + 1] : 0u) << 8 | (left > 2 ? bytes[i + 2] : 0u);
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
    const froe_allocator alloc = support_allocator(NULL);
    cli_draw library;
    if (cli_open_draw(&library)) return json_null();
    froe_draw_options o;
    library.defaults(&o, sizeof o);
    byte_array png = {0};
    o.width = 480;
    o.legend = false;
    if (!cells) o.show = FROE_DRAW_OBJECTS;
    o.margin = 8;
    const froe_status status = library.write(tree, FROE_DRAW_PNG, take, &png, &o, NULL);
    json_t *json = status == FROE_E_MEMORY ? cli_report_lose()
                   : status                ? json_null()
                                           : base64_json(png.data, png.count);
    array_free(&alloc, &png);
    return json;
}

json_t *picture_scene_json(froe_scene *scene) {
    froe_build_options o = froe_build_defaults();
    froe_tree *tree;
    o.purpose = "query"; /* the quickest to build */
    o.max_fragments = cli_budget(CLI_BUDGET_OWN, scene);
    const froe_status status = froe_build(scene, &o, &tree, NULL);
    if (status) return status == FROE_E_MEMORY ? cli_report_lose() : json_null();
    json_t *json = picture_json(tree, false);
    froe_tree_free(tree);
    return json;
}
