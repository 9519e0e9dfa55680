/* groups.c: groups and their strings, which lie one after the other in one text; offset 0 is "". */
#include "base/floats.h"
#include "scene/store.h"
#include <string.h>

/** A string on its way into the text, where it may be part already: of another group, say. */
typedef struct group_text {
    const char *string; /* NULL: it is in the text */
    size_t place, size; /* where in the text; with its end, or 0 for "" and NULL, which cost nothing */
} group_text;

static group_text take_group_text(const struct scene_store *store, const char *string) {
    const size_t size = string && *string ? strlen(string) + 1 : 0;
    const uintptr_t place = (uintptr_t)string - (uintptr_t)store->text.data;
    const bool own = size && place < store->text.count;
    return (group_text){own ? NULL : string, place, size};
}

/** Appends a string and tells its offset. REQUIRES: room in text. */
static uint32_t put_group_text(struct scene_store *store, const group_text *text) {
    if (!text->size) return 0;
    const size_t offset = store->text.count;
    memcpy(store->text.data + offset, text->string ? text->string : store->text.data + text->place, text->size);
    store->text.count += text->size;
    return (uint32_t)offset;
}

froe_status froe_scene_add_group(froe_scene *scene, const froe_group *group, uint32_t *id) {
    BASE_FLOATS_OWN;
    if (!scene || !group) return FROE_E_ARG;
    froe_status status = scene_growable(scene, NULL);
    if (status) return status;
    struct scene_store *store = scene->store;
    const group_text name = take_group_text(store, group->name), material = take_group_text(store, group->material),
                     left = take_group_text(store, group->left), right = take_group_text(store, group->right);
    const size_t need = 1 + name.size + material.size + left.size + right.size;
    if (store->group_table.count == SCENE_LIMIT || need > UINT32_MAX - store->text.count) return FROE_E_LIMIT;
    bool room =
        array_reserve(&scene->alloc, &store->text, need) && array_reserve(&scene->alloc, &store->group_table, 1);
    if (room) {
        if (!store->text.count) store->text.data[store->text.count++] = 0;
        scene_group *g = store->group_table.data + store->group_table.count++;
        g->name = put_group_text(store, &name);
        g->material = put_group_text(store, &material);
        g->left = put_group_text(store, &left);
        g->right = put_group_text(store, &right);
        g->colour = group->colour;
        if (id) *id = (uint32_t)store->group_table.count - 1;
    }
    scene_publish(scene);
    return room ? FROE_OK : FROE_E_MEMORY;
}

froe_group froe_scene_group(const froe_scene *scene, uint32_t group) {
    if (group >= scene->group_count) return (froe_group){"", "", "", "", 0};
    const scene_group *g = scene->group_table + group;
    const char *text = scene->text;
    if (!scene_is_checked(scene) && !scene_group_fits(scene, g)) return (froe_group){"", "", "", "", 0};
    return (froe_group){text + g->name, text + g->material, text + g->left, text + g->right, g->colour};
}
