/* x.c: whether faces of a DirectX file (.x) name vertices and materials that exist. assimp leaves out the corners and
 * faces that name others, and of an index that is the number of vertices it reads any memory.
 *
 *     Mesh name { 3; 0;0;0;, 1;0;0;, 0;1;0;; 1; 3;0,1,2;;       vertices and faces
 *       MeshMaterialList { 1; 1; 0;; Material { ... } } }       how many materials, faces, and the material of each
 *
 * In a binary file tokens are numbers of 2 bytes, the lowest first; 1, 6 and 7 have a length of 4 bytes behind them:
 *
 *     1 length name   6 count whole numbers of 4 bytes   7 count floats of 4 or 8   10: {   11: }   31: template
 *
 * What is not as expected is left to assimp, and so are files that are compressed. */
#include "check/check.h"
#include <stdlib.h>
#include <string.h>

static bool is_binary(const formats_source *source) {
    return !strncmp(source->head + 8, "bin ", 4);
}

bool io_is_x(const formats_source *source) {
    return !strncmp(source->head, "xof ", 4) && (!strncmp(source->head + 8, "txt ", 4) || is_binary(source));
}

typedef enum x_kind { END, WORD, NUMBER, OPEN, CLOSE } x_kind;

typedef struct x_check {
    const char *at, *end;
    size_t real;   /* bytes of a float in a binary file; 0: it is text */
    size_t listed; /* numbers of a list that are still to come, and the bytes of each */
    size_t each;
    const char *word; /* the last word or number, and how long it is */
    size_t length;
    size_t number; /* of a whole number; SIZE_MAX: it is none */
} x_check;

static size_t little_endian(const char *at, size_t bytes) {
    size_t value = 0;
    while (bytes--) value = value << 8 | (unsigned char)at[bytes];
    return value;
}

static x_kind next_listed(x_check *x) {
    if ((size_t)(x->end - x->at) < x->each) return x->at = x->end, END;
    x->number = little_endian(x->at, x->each);
    x->at += x->each;
    x->listed--;
    return NUMBER;
}

/* Passes a name, or a text of that length. */
static x_kind next_name(x_check *x, size_t length) {
    if ((size_t)(x->end - x->at) < length) return x->at = x->end, END;
    x->word = x->at;
    x->length = length;
    x->at += length;
    return WORD;
}

static x_kind next_binary(x_check *x) {
    enum { NAME = 1, TEXT, INTEGER, IDENTIFIER = 5, INTEGERS, REALS, BEGIN = 10, FINISH, TEMPLATE = 31, TYPES = 40 };
    static const char words[] = "template";
    while (!x->listed) {
        if (x->end - x->at < 2) return END;
        const size_t token = little_endian(x->at, 2), size = token == INTEGERS ? 4 : x->real;
        const bool counted = token == NAME || token == TEXT || token == INTEGERS || token == REALS;
        x->at += 2;
        if (counted && x->end - x->at < 4) return END;
        const size_t count = counted ? little_endian(x->at, 4) : 0;
        x->at += counted ? 4 : 0;
        if (token == NAME) return next_name(x, count);
        if (token == TEXT) return next_name(x, count) == END ? END : (x->length = 0, WORD);
        if (token == IDENTIFIER) x->at += x->end - x->at < 16 ? x->end - x->at : 16;
        if (token == BEGIN) return OPEN;
        if (token == FINISH) return CLOSE;
        if (token >= TYPES) return x->length = 0, WORD;
        if (token == TEMPLATE) return x->word = words, x->length = strlen(words), WORD;
        x->listed = token == INTEGER ? 1 : count;
        x->each = token == INTEGER ? 4 : size;
    }
    return next_listed(x);
}

static x_kind next_token(x_check *x) {
    if (x->real) return next_binary(x);
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

/* No count is larger than what there is behind it. */
static bool is_count(const x_check *x) {
    return x->number <= (size_t)(x->end - x->at) || (x->number == SIZE_MAX && !x->real);
}

static const char *look_at_mesh(x_check *x) {
    static const char shorter[] = "The file is shorter than the counts of a mesh say.";
    if (!pass_head(x) || !pass_numbers(x, 1)) return NULL;
    const size_t vertices = x->number;
    if (!is_count(x)) return shorter;
    for (size_t i = 0; i < vertices; i++)
        if (!pass_numbers(x, 3)) return NULL;
    if (!pass_numbers(x, 1)) return NULL;
    if (!is_count(x)) return shorter;
    for (size_t faces = x->number; faces; faces--) {
        if (!pass_numbers(x, 1)) return NULL;
        if (!is_count(x)) return shorter;
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
static const char *find_x_fault(x_check *x) {
    const char *fault = NULL;
    bool named = false;
    for (x_kind kind; !fault && (kind = next_token(x)) != END; named = kind == WORD && !named) {
        if (kind != WORD || named) continue;
        if (word_is(x, "template"))
            while ((kind = next_token(x)) != CLOSE && kind != END) {
            }
        else if (word_is(x, "Mesh"))
            fault = look_at_mesh(x), kind = NUMBER;
        else if (word_is(x, "MeshMaterialList"))
            fault = look_at_materials(x), kind = CLOSE;
    }
    return fault;
}

static io_fault find_text_fault(formats_sink *sink, const char *text) {
    x_check x = {.at = text, .end = text + strlen(text)};
    const char *fault = find_x_fault(&x);
    size_t line = 1;
    (void)sink;
    for (const char *at = text; fault && at < x.word; at++) line += *at == '\n';
    return (io_fault){fault, line, FROE_E_FORMAT};
}

froe_status io_x_check(const formats_source *source, formats_sink *sink) {
    enum { HEAD = 16 };
    if (!is_binary(source)) return io_text_look(source, sink, true, find_text_fault);
    formats_text text = {0};
    froe_status status = formats_load_part(source, sink, 0, (size_t)source->size, &text);
    const size_t real = !strncmp(source->head + HEAD - 4, "0064", 4) ? 8 : 4;
    x_check x = {.real = real};
    if (!status && text.count >= HEAD) x.at = text.data + HEAD, x.end = text.data + text.count;
    const char *sentence = x.at ? find_x_fault(&x) : NULL;
    if (sentence) status = support_fail(sink->diag, FROE_E_FORMAT, "%s: %s", support_short(source->path), sentence);
    array_free(&sink->alloc, &text);
    return status;
}
