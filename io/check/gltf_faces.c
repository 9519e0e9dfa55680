/* gltf_faces.c: how many faces the meshes of a glTF file (version 2.0) have that assimp reads, which are not all. It
 * begins with the nodes of the scene to be shown, the joints of skins and the nodes that animations move, goes on to
 * the children of each, and reads the meshes of the nodes that it comes to. */
#include "check/check.h"

bool io_gltf_list_items(const froe_allocator *alloc, const formats_json *root, const char *name, io_gltf_list *list) {
    FORMATS_JSON_EACH(item, formats_json_get(root, name))
    if (!array_push(alloc, list, item)) return false;
    return true;
}

/* The item of that number; NULL: there is none. */
static const formats_json *item_at(const io_gltf_list *list, const formats_json *number) {
    const bool is_there =
        formats_json_is(number, FORMATS_JSON_NUMBER) && number->number >= 0 && number->number < (double)list->count;
    return is_there ? list->data[(size_t)number->number] : NULL;
}

const formats_json *io_gltf_item(const io_gltf_list *list, const formats_json *object, const char *name) {
    return item_at(list, formats_json_get(object, name));
}

bool io_gltf_is_number(const formats_json *value, double number) {
    return formats_json_is(value, FORMATS_JSON_NUMBER) && value->number == number;
}

typedef struct gltf_reach {
    const froe_allocator *alloc;
    const formats_json *root;
    ARRAY(bool) seen;   /* each value of the text by its place in it */
    io_gltf_list nodes; /* that assimp comes to, each once */
    bool room;
} gltf_reach;

/* Is it met for the first time? */
static bool is_new(gltf_reach *r, const formats_json *value) {
    if (!value || r->seen.data[value - r->root]) return false;
    return r->seen.data[value - r->root] = true;
}

static void come_to(gltf_reach *r, const formats_json *node) {
    if (is_new(r, node) && !array_push(r->alloc, &r->nodes, node)) r->room = false;
}

static void come_to_each(gltf_reach *r, const io_gltf_list *nodes, const formats_json *numbers) {
    FORMATS_JSON_EACH(number, numbers) come_to(r, item_at(nodes, number));
}

static void find_nodes(gltf_reach *r, const io_gltf_list *nodes) {
    const formats_json *shown = formats_json_get(r->root, "scene");
    double number = 0;
    FORMATS_JSON_EACH(scene, formats_json_get(r->root, "scenes"))
    if (number++ == (shown ? shown->number : 0)) come_to_each(r, nodes, formats_json_get(scene, "nodes"));
    FORMATS_JSON_EACH(skin, formats_json_get(r->root, "skins"))
    come_to_each(r, nodes, formats_json_get(skin, "joints"));
    FORMATS_JSON_EACH(animation, formats_json_get(r->root, "animations"))
    FORMATS_JSON_EACH(channel, formats_json_get(animation, "channels"))
    come_to(r, io_gltf_item(nodes, formats_json_get(channel, "target"), "node"));
    for (size_t i = 0; i < r->nodes.count; i++) come_to_each(r, nodes, formats_json_get(r->nodes.data[i], "children"));
}

size_t io_gltf_corners(const io_gltf_list *accessors, const formats_json *primitive) {
    const formats_json *positions = io_gltf_item(accessors, formats_json_get(primitive, "attributes"), "POSITION");
    const formats_json *indices = io_gltf_item(accessors, primitive, "indices");
    const formats_json *count = formats_json_get(indices ? indices : positions, "count");
    const bool is_count = formats_json_is(count, FORMATS_JSON_NUMBER) && count->number >= 0 && count->number < 0x1p32;
    return is_count ? (size_t)count->number : 0;
}

/* How many points, edges or triangles a primitive is that is long enough (3.7.2.1). */
static size_t faces_of(const formats_json *mode, size_t corners) {
    if (io_gltf_is_number(mode, 0) || io_gltf_is_number(mode, 2)) return corners;
    if (io_gltf_is_number(mode, 1)) return corners / 2;
    if (io_gltf_is_number(mode, 3)) return corners - 1;
    return io_gltf_is_number(mode, 5) || io_gltf_is_number(mode, 6) ? corners - 2 : corners / 3;
}

froe_status io_gltf_count(formats_sink *sink, const formats_json *root, const io_gltf_list *accessors,
                          const io_gltf_list *meshes, const io_gltf_list *nodes, size_t *faces) {
    gltf_reach r = {.alloc = &sink->alloc, .root = root};
    r.room = array_reserve(r.alloc, &r.seen, root->span);
    for (size_t i = 0; i < root->span && r.room; i++) r.seen.data[i] = false;
    if (r.room) find_nodes(&r, nodes);
    for (size_t i = 0; i < r.nodes.count; i++) {
        const formats_json *mesh = io_gltf_item(meshes, r.nodes.data[i], "mesh");
        if (!is_new(&r, mesh)) continue;
        FORMATS_JSON_EACH(primitive, formats_json_get(mesh, "primitives"))
        *faces += faces_of(formats_json_get(primitive, "mode"), io_gltf_corners(accessors, primitive));
    }
    array_free(r.alloc, &r.seen);
    array_free(r.alloc, &r.nodes);
    return r.room ? FROE_OK : support_fail_memory(sink->diag);
}
