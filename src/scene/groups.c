/* groups.c: groups and their strings, which lie one after the other in one text; offset 0 is "". */
#include "base/floats.h"
#include "scene/store.h"
#include <string.h>

/** Appends a string and tells its offset; "" and NULL cost nothing. REQUIRES: room in text. */
static uint32_t put_group_text(struct scene_store *store, const char *string) {
    if (!string || !*string) return 0;
    size_t offset = store->text.count, size = strlen(string) + 1;
    memcpy(store->text.data + offset, string, size);
    store->text.count += size;
    return (uint32_t)offset;
}

static size_t text_need(const char *string) {
    return string && *string ? strlen(string) + 1 : 0;
}

froe_status froe_scene_add_group(froe_scene *scene, const froe_group *group, uint32_t *id) {
    BASE_FLOATS_OWN;
    if (!scene || !group) return FROE_E_ARG;
    froe_status status = scene_growable(scene, NULL);
    if (status) return status;
    struct scene_store *store = scene->store;
    size_t need =
        1 + text_need(group->name) + text_need(group->material) + text_need(group->left) + text_need(group->right);
    if (store->group_table.count == SCENE_LIMIT || need > UINT32_MAX - store->text.count) return FROE_E_LIMIT;
    bool room =
        array_reserve(&scene->alloc, &store->text, need) && array_reserve(&scene->alloc, &store->group_table, 1);
    if (room) {
        if (!store->text.count) store->text.data[store->text.count++] = 0;
        scene_group *g = store->group_table.data + store->group_table.count++;
        g->name = put_group_text(store, group->name);
        g->material = put_group_text(store, group->material);
        g->left = put_group_text(store, group->left);
        g->right = put_group_text(store, group->right);
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
