/* x.c: whether faces of a DirectX file (.x) name vertices and materials that exist. assimp leaves out the corners and
 * faces that name others, and of an index that is the number of vertices it reads any memory.
 *
 *     Mesh name { 3; 0;0;0;, 1;0;0;, 0;1;0;; 1; 3;0,1,2;;       vertices and faces
 *       MeshMaterialList { 1; 1; 0;; Material { ... } } }       how many materials, faces, and the material of each
 *
 * What is not as expected is left to assimp, and so are files that are not text. */
#include "check/check.h"
#include <stdlib.h>
#include <string.h>

bool io_is_x(const formats_source *source) {
    return !strncmp(source->head, "xof ", 4) && !strncmp(source->head + 8, "txt ", 4);
}

typedef enum x_kind { END, WORD, NUMBER, OPEN, CLOSE } x_kind;

typedef struct x_check {
    const char *at;
    const char *word; /* the last word or number, and how long it is */
    size_t length;
    size_t number; /* of a whole number; SIZE_MAX: it is none */
} x_check;

static x_kind next_token(x_check *x) {
    static const char between[] = " \t\r\n\v\f,;", ending[] = " \t\r\n\v\f,;{}";
    for (x->at += strspn(x->at, between); *x->at == '#' || !strncmp(x->at, "//", 2); x->at += strspn(x->at, between))
        x->at += strcspn(x->at, "\n");
    if (!*x->at) return END;
    x->word = x->at;
    if (strchr("{}", *x->at)) return *x->at++ == '{' ? OPEN : CLOSE;
    x->length = strcspn(x->at, ending);
    if (*x->at == '"') x->length = strcspn(x->at + 1, "\"\n") + 1, x->length += x->at[x->length] == '"';
    x->at += x->length;
    const size_t digits = strspn(x->word, "0123456789");
    x->number = digits && digits == x->length ? strtoul(x->word, NULL, 10) : SIZE_MAX;
    return digits || strchr("+-.", *x->word) ? NUMBER : WORD;
}

static bool word_is(const x_check *x, const char *word) {
    return x->length == strlen(word) && !strncmp(x->word, word, x->length);
}

static bool pass_numbers(x_check *x, size_t count) {
    for (; count; count--)
        if (next_token(x) != NUMBER) return false;
    return true;
}

/* A brace, perhaps behind a name. */
static bool pass_head(x_check *x) {
    const x_kind kind = next_token(x);
    return kind == OPEN || (kind == WORD && next_token(x) == OPEN);
}

static const char *look_at_mesh(x_check *x) {
    if (!pass_head(x) || !pass_numbers(x, 1)) return NULL;
    const size_t vertices = x->number;
    for (size_t i = 0; i < vertices; i++)
        if (!pass_numbers(x, 3)) return NULL;
    if (!pass_numbers(x, 1)) return NULL;
    for (size_t faces = x->number; faces; faces--) {
        if (!pass_numbers(x, 1)) return NULL;
        for (size_t corners = x->number; corners; corners--) {
            if (!pass_numbers(x, 1)) return NULL;
            if (x->number >= vertices) return "A face names a vertex that does not exist.";
        }
    }
    return NULL;
}

static const char *look_at_materials(x_check *x) {
    size_t largest = 0, given = 0;
    if (!pass_head(x) || !pass_numbers(x, 2)) return NULL;
    const size_t faces = x->number;
    for (size_t i = 0; i < faces; i++) {
        if (!pass_numbers(x, 1)) return NULL;
        if (x->number > largest) largest = x->number;
    }
    for (size_t depth = 1; depth;) { /* each material is in braces */
        const x_kind kind = next_token(x);
        if (kind == END) return NULL;
        given += kind == OPEN && depth == 1;
        depth += (kind == OPEN) - (kind == CLOSE);
    }
    return !faces || largest < given ? NULL : "A face names a material that does not exist.";
}

/* What stands behind a word is its name. */
static io_fault find_x_fault(formats_sink *sink, const char *text) {
    x_check x = {.at = text};
    const char *fault = NULL;
    size_t line = 1;
    bool named = false;
    (void)sink;
    for (x_kind kind; !fault && (kind = next_token(&x)) != END; named = kind == WORD && !named) {
        if (kind != WORD || named) continue;
        if (word_is(&x, "template"))
            while ((kind = next_token(&x)) != CLOSE && kind != END) {
            }
        else if (word_is(&x, "Mesh"))
            fault = look_at_mesh(&x), kind = NUMBER;
        else if (word_is(&x, "MeshMaterialList"))
            fault = look_at_materials(&x), kind = CLOSE;
    }
    for (const char *at = text; fault && at < x.word; at++) line += *at == '\n';
    return (io_fault){fault, line, FROE_E_FORMAT};
}

froe_status io_x_check(const formats_source *source, formats_sink *sink) {
    return io_text_look(source, sink, true, find_x_fault);
}
