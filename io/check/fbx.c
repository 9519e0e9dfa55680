/* fbx.c: whether the models of an FBX file (version 7) are below each other so that there is a first one. assimp goes
 * down from the first by calling itself, and ends the program where models are each other's parents.
 *
 *     Objects: { Model: 200, "Model::a", "Mesh" { ... } Model: 201, ... }
 *     Connections: { C: "OO",200,0 C: "OO",201,200 }      201 is below 200, and that below the scene, which is 0
 *
 * A binary file has the same in records: where the next begins, how many properties there are and how long they are,
 * in 4 or (from version 7500) 8 bytes each; the length of a name, a name; properties, such as S and a length before
 * letters, and L before a whole number; records within it. What is not as expected is left to assimp. Other objects may
 * be connected in circles: a bone with a deformer, that with a mesh, and its model with the bone. */
#include "check/check.h"
#include <stdlib.h>
#include <string.h>

enum { HEAD = 27, MOST_DEEP = 1000 };

enum { CHILD, PARENT };
typedef struct link {
    uint64_t ids[2];
} link;
typedef struct fbx_model {
    uint64_t id;
    size_t open, depth; /* parents that are not yet placed; of those that are, the deepest, plus 1 */
} fbx_model;
typedef struct fbx_check {
    const froe_allocator *alloc;
    ARRAY(uint64_t) models;
    ARRAY(link) links;        /* of models, by parent, when all are known */
    ARRAY(fbx_model) objects; /* that have parents, by id */
    ARRAY(uint64_t) placed;
} fbx_check;

bool io_is_fbx(const formats_source *source) {
    return !strcmp(source->extension.text, "fbx");
}

/* --------------------------------------------------------------------- reading -- */

static const char blanks[] = " \t\r\n";

static bool read_fbx_text(fbx_check *c, const char *text) {
    static const char model[] = "Model:", kind[] = "\"OO\"";
    for (const char *at = text; (at = strstr(at, model)); at++) {
        const char *number = at + strlen(model) + strspn(at + strlen(model), blanks);
        const bool known = at > text && strchr(blanks, at[-1]) && *number >= '0' && *number <= '9';
        if (known && !array_push(c->alloc, &c->models, strtoull(number, NULL, 10))) return false;
    }
    const char *at = strstr(text, "Connections:");
    while (at && (at = strstr(at, kind))) {
        link l;
        at += strlen(kind);
        for (int k = 0; k < 2; k++) {
            at += strspn(at, blanks);
            at += *at == ',';
            l.ids[k] = strtoull(at, (char **)(uintptr_t)&at, 10);
        }
        if (!array_push(c->alloc, &c->links, l)) return false;
    }
    return true;
}

static uint64_t number_at(const char *at, size_t width) {
    return io_word_at(at) | (width == 8 ? (uint64_t)io_word_at(at + 4) << 32 : 0);
}

typedef struct record {
    size_t end; /* in the text; 0: there is none */
    const char *name, *properties, *inside;
    size_t letters;
} record;

static record record_at(const formats_text *text, size_t at, size_t width) {
    const size_t head = 3 * width + 1;
    if (at > text->count || text->count - at < head) return (record){0};
    const char *from = text->data + at;
    const uint64_t end = number_at(from, width), size = number_at(from + 2 * width, width);
    const size_t letters = (unsigned char)from[head - 1], begin = at + head + letters;
    if (end <= at || end > text->count || begin > end || size > end - begin) return (record){0};
    return (record){(size_t)end, from + head, text->data + begin, text->data + begin + size, letters};
}

static bool is_named(const record *r, const char *name) {
    return r->letters == strlen(name) && !memcmp(r->name, name, r->letters);
}

/* A record within one that is named. */
static bool read_record(fbx_check *c, const record *within, const record *r) {
    static const char kind[] = "S\2\0\0\0OO";
    enum { KIND = sizeof kind - 1, NUMBER = 9 };
    const char *from = r->properties;
    const size_t size = (size_t)(r->inside - from);
    if (is_named(within, "Objects") && is_named(r, "Model") && size >= NUMBER && *from == 'L')
        return array_push(c->alloc, &c->models, number_at(from + 1, 8));
    const bool linked = is_named(within, "Connections") && is_named(r, "C") && size >= KIND + 2 * NUMBER &&
                        !memcmp(from, kind, KIND) && from[KIND] == 'L' && from[KIND + NUMBER] == 'L';
    const link l = {{linked ? number_at(from + KIND + 1, 8) : 0, linked ? number_at(from + KIND + NUMBER + 1, 8) : 0}};
    return !linked || array_push(c->alloc, &c->links, l);
}

static bool read_records(fbx_check *c, const formats_text *text) {
    const size_t width = io_word_at(text->data + HEAD - 4) >= 7500 ? 8 : 4;
    for (record all = record_at(text, HEAD, width); all.end; all = record_at(text, all.end, width))
        for (record one = {.end = (size_t)(all.inside - text->data)}; one.end && one.end < all.end;) {
            one = record_at(text, one.end, width);
            if (one.end && !read_record(c, &all, &one)) return false;
        }
    return true;
}

/* --------------------------------------------------------------------- placing -- */

/* By the first number of each: of ids, of models, and of links by their child. */
static int order_numbers(const void *x, const void *y) {
    const uint64_t a = *(const uint64_t *)x, b = *(const uint64_t *)y;
    return a < b ? -1 : a > b;
}

static int order_parents(const void *x, const void *y) {
    return order_numbers(((const link *)x)->ids + PARENT, ((const link *)y)->ids + PARENT);
}

static fbx_model *find_object(const fbx_check *c, uint64_t id) {
    const fbx_model wanted = {.id = id};
    return c->objects.count ? bsearch(&wanted, c->objects.data, c->objects.count, sizeof wanted, order_numbers) : NULL;
}

static bool is_model(const fbx_check *c, uint64_t id) {
    return c->models.count && bsearch(&id, c->models.data, c->models.count, sizeof id, order_numbers);
}

/* Lists the objects, and sorts the links of models. */
static bool list_objects(fbx_check *c) {
    size_t kept = 0;
    if (c->models.count) qsort(c->models.data, c->models.count, sizeof *c->models.data, order_numbers);
    for (size_t i = 0; i < c->links.count; i++)
        if (is_model(c, c->links.data[i].ids[CHILD]) && is_model(c, c->links.data[i].ids[PARENT]))
            c->links.data[kept++] = c->links.data[i];
    c->links.count = kept;
    if (!array_reserve(c->alloc, &c->objects, c->links.count) || !array_reserve(c->alloc, &c->placed, c->links.count))
        return false;
    if (!c->links.count) return true;
    for (size_t i = 0; i < c->links.count; i++)
        c->objects.data[c->objects.count++] = (fbx_model){.id = c->links.data[i].ids[CHILD], .open = 1};
    qsort(c->objects.data, c->objects.count, sizeof *c->objects.data, order_numbers);
    qsort(c->links.data, c->links.count, sizeof *c->links.data, order_parents);
    size_t last = 0;
    for (size_t i = 1; i < c->objects.count; i++)
        if (c->objects.data[i].id == c->objects.data[last].id)
            c->objects.data[last].open++;
        else
            c->objects.data[++last] = c->objects.data[i];
    c->objects.count = last + 1;
    return true;
}

/* The first link of an object, on the side by which they are in order. */
static size_t first_link(const fbx_check *c, int side, uint64_t id) {
    size_t low = 0, high = c->links.count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (c->links.data[middle].ids[side] < id)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Places the objects below one that is placed. */
static void place_below(fbx_check *c, uint64_t parent, size_t depth) {
    for (size_t i = first_link(c, PARENT, parent); i < c->links.count && c->links.data[i].ids[PARENT] == parent; i++) {
        fbx_model *o = find_object(c, c->links.data[i].ids[CHILD]);
        if (o->depth < depth) o->depth = depth;
        if (!--o->open) c->placed.data[c->placed.count++] = o->id;
    }
}

/* An object that is its own parent, from one below it that is not placed: up, more often than there are objects. */
static uint64_t find_own_parent(fbx_check *c, uint64_t id) {
    qsort(c->links.data, c->links.count, sizeof *c->links.data, order_numbers);
    for (size_t steps = 0; steps < c->objects.count; steps++) {
        const fbx_model *above = NULL;
        for (size_t i = first_link(c, CHILD, id); !above || !above->open; i++)
            above = find_object(c, c->links.data[i].ids[PARENT]);
        id = above->id;
    }
    return id;
}

static froe_status place_models(fbx_check *c, formats_sink *sink) {
    for (size_t i = 0; i < c->links.count; i++) {
        const uint64_t parent = c->links.data[i].ids[PARENT];
        if ((!i || parent != c->links.data[i - 1].ids[PARENT]) && !find_object(c, parent)) place_below(c, parent, 1);
    }
    for (size_t i = 0; i < c->placed.count; i++) {
        const uint64_t id = c->placed.data[i];
        place_below(c, id, find_object(c, id)->depth + 1);
    }
    for (size_t i = 0; i < c->objects.count; i++) {
        const fbx_model *o = &c->objects.data[i];
        if (!o->open && o->depth <= MOST_DEEP) continue;
        const unsigned long long id = o->open ? find_own_parent(c, o->id) : o->id;
        return support_fail(
            sink->diag, o->open ? FROE_E_FORMAT : FROE_E_UNSUPPORTED, "%s: model %llu: %s", support_short(sink->path),
            id, o->open ? "It is its own parent, or a parent of its parents." : "It is below more than 1000 others.");
    }
    return FROE_OK;
}

froe_status io_fbx_check(const formats_source *source, formats_sink *sink) {
    static const char binary[] = "Kaydara FBX Binary  ";
    formats_text text = {0};
    fbx_check c = {.alloc = &sink->alloc};
    froe_status status = formats_load_part(source, sink, 0, (size_t)source->size, &text);
    if (!status) {
        const bool records = text.count >= HEAD && !memcmp(text.data, binary, strlen(binary));
        const bool room = (records ? read_records(&c, &text) : read_fbx_text(&c, text.data)) && list_objects(&c);
        status = room ? place_models(&c, sink) : support_fail_memory(sink->diag);
    }
    array_free(&sink->alloc, &text);
    array_free(&sink->alloc, &c.models);
    array_free(&sink->alloc, &c.links);
    array_free(&sink->alloc, &c.objects);
    array_free(&sink->alloc, &c.placed);
    return status;
}
