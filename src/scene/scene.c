/* scene.c: making, holding and freeing scenes, and their public readers. */
#include "scene/scene.h"
#include "base/floats.h"
#include "num/context.h"
#include "scene/store.h"
#include "support/fail.h"
#include <math.h>
#include <string.h>
#include <sys/mman.h>

const char *froe_kind_name(froe_kind kind) {
    static const char *const names[FROE_KIND_COUNT] = {"point", "segment", "polygon", "box", "ball", "hull"};
    return (unsigned)kind < FROE_KIND_COUNT ? names[kind] : NULL;
}

/* -------------------------------------------------------------------- life -- */

/** Gives back the table and the context, which are made again where they are needed. */
static void give_back(const froe_allocator *alloc, struct scene_store *store) {
    scene_table_free(alloc, &store->table);
    if (store->context_ready) num_context_free(&store->context);
    store->context_ready = false;
}

static void store_free(const froe_allocator *alloc, struct scene_store *store) {
    give_back(alloc, store);
    array_free(alloc, &store->coords);
    array_free(alloc, &store->kind_of);
    array_free(alloc, &store->form_of);
    array_free(alloc, &store->start_of);
    array_free(alloc, &store->vertex_of);
    array_free(alloc, &store->radii);
    array_free(alloc, &store->tags);
    array_free(alloc, &store->faces);
    array_free(alloc, &store->groups);
    array_free(alloc, &store->group_table);
    array_free(alloc, &store->text);
    support_free(alloc, store, sizeof *store);
}

froe_status froe_scene_new(int dim, const froe_allocator *caller, froe_scene **out) {
    BASE_FLOATS_OWN;
    if (!out || dim < 2 || dim > FROE_MAX_DIM) return FROE_E_ARG;
    if (num_rounding_check(NULL)) return FROE_E_UNSUPPORTED;
    froe_allocator alloc = support_allocator(caller);
    froe_scene *s = support_calloc(&alloc, 1, sizeof *s);
    if (!s) return FROE_E_MEMORY;
    s->alloc = alloc;
    s->dim = dim;
    s->up = dim == 3 ? 2 : -1;
    atomic_init(&s->holds, 1);
    for (int k = 0; k < FROE_MAX_DIM; k++) s->lo[k] = INFINITY, s->hi[k] = -INFINITY;
    s->store = support_calloc(&alloc, 1, sizeof *s->store);
    if (!s->store) {
        froe_scene_free(s);
        return FROE_E_MEMORY;
    }
    s->store->plan = match_usual;
    s->store->trusted = num_machine_trusted();
    scene_publish(s);
    *out = s;
    return FROE_OK;
}

void froe_scene_free(froe_scene *scene) {
    if (!scene || atomic_fetch_sub_explicit(&scene->holds, 1, memory_order_acq_rel) != 1) return;
    froe_allocator alloc = scene->alloc;
    if (scene->copied)
        support_free(&alloc, scene->map, scene->map_size);
    else if (scene->map)
        munmap(scene->map, scene->map_size);
    if (scene->store) store_free(&alloc, scene->store), support_free(&alloc, scene->crs, scene->crs_size);
    support_free(&alloc, scene, sizeof *scene);
}

void scene_hold(froe_scene *scene) {
    /* What only serves to grow is not read while the scene is frozen. Of several threads the one that freezes it gives
     * that back; no other can before this one's hold is given up. */
    const bool freezes = atomic_fetch_add_explicit(&scene->holds, 1, memory_order_acq_rel) == 1;
    if (freezes && scene->store) give_back(&scene->alloc, scene->store);
}

froe_status scene_growable(const froe_scene *s, froe_diagnostic *diag) {
    if (s->store && atomic_load_explicit(&s->holds, memory_order_acquire) == 1) return FROE_OK;
    return support_fail(diag, FROE_E_FROZEN, "A tree holds the scene, which can no longer grow.");
}

void scene_publish(froe_scene *s) {
    const struct scene_store *store = s->store;
    s->vertex_count = store->vertex_count;
    s->object_count = store->object_count;
    s->corner_count = store->corner_count;
    s->radius_count = (uint32_t)store->radii.count;
    s->group_count = (uint32_t)store->group_table.count;
    s->text_size = store->text.count;
    s->coords = store->coords.data;
    s->kind_of = store->kind_of.count ? store->kind_of.data : NULL;
    s->form_of = store->form_of.count ? store->form_of.data : NULL;
    s->start_of = store->start_of.count ? store->start_of.data : NULL;
    s->vertex_of = store->vertex_of.count ? store->vertex_of.data : NULL;
    s->radii = store->radii.data;
    s->tags = store->tags.count ? store->tags.data : NULL;
    s->faces = store->faces.count ? store->faces.data : NULL;
    s->groups = store->groups.count ? store->groups.data : NULL;
    s->group_table = store->group_table.data;
    s->text = store->text.data;
}

/* ----------------------------------------------------------------- reading -- */

froe_status froe_scene_set_up(froe_scene *scene, int axis) {
    BASE_FLOATS_OWN;
    if (!scene || scene->dim != 3 || axis < 0 || axis > 2) return FROE_E_ARG;
    const froe_status status = scene_growable(scene, NULL);
    if (!status) scene->up = axis;
    return status;
}

int froe_scene_up(const froe_scene *scene) {
    return scene->up;
}

int froe_scene_dim(const froe_scene *scene) {
    return scene->dim;
}

size_t froe_scene_object_count(const froe_scene *scene) {
    return scene->object_count;
}

size_t froe_scene_vertex_count(const froe_scene *scene) {
    return scene->vertex_count;
}

size_t froe_scene_group_count(const froe_scene *scene) {
    return scene->group_count;
}

size_t froe_scene_kind_count(const froe_scene *scene, froe_kind kind) {
    size_t count = 0;
    for (uint32_t i = 0; i < scene->object_count; i++) count += scene_kind(scene, i) == kind;
    return count;
}

bool froe_scene_bounds(const froe_scene *scene, double *lo, double *hi) {
    if (!scene->object_count) return false;
    memcpy(lo, scene->lo, (size_t)scene->dim * sizeof *lo);
    memcpy(hi, scene->hi, (size_t)scene->dim * sizeof *hi);
    return true;
}

froe_object froe_scene_object(const froe_scene *scene, uint32_t object) {
    if (object >= scene->object_count || (!scene_is_checked(scene) && !scene_object_fits(scene, object)))
        return (froe_object){.kind = FROE_KIND_NONE, .form = FROE_KIND_NONE, .face = FROE_NONE, .group = FROE_NONE};
    bool ball = scene_kind(scene, object) == FROE_BALL;
    return (froe_object){
        .kind = scene_kind(scene, object),
        .form = scene_form(scene, object),
        .corners = ball ? 1 : scene_corners(scene, object),
        .face = scene->faces ? scene->faces[object] : object,
        .group = scene->groups ? scene->groups[object] : FROE_NONE,
        .tag = scene->tags ? scene->tags[object] : object,
        .radius = ball ? scene_radius(scene, object) : 0,
    };
}

uint32_t froe_scene_corner(const froe_scene *scene, uint32_t object, uint32_t corner) {
    return corner < froe_scene_object(scene, object).corners ? scene_corner(scene, object, corner) : FROE_NONE;
}

const double *froe_scene_vertex(const froe_scene *scene, uint32_t vertex) {
    return vertex < scene->vertex_count ? scene_vertex(scene, vertex) : NULL;
}
