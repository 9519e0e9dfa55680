/* explicit.c: a scene with all arrays, for files: those that would say nothing are made, and say it. */
#include "scene/scene.h"
#include <stddef.h>
#include <string.h>

void scene_explicit_free(const froe_scene *s, const froe_allocator *alloc, froe_scene *out) {
    const size_t objects = s->object_count;
    if (out->kind_of != s->kind_of) support_free(alloc, out->kind_of, objects);
    if (out->form_of != s->form_of) support_free(alloc, out->form_of, objects);
    if (out->start_of != s->start_of) support_free(alloc, out->start_of, (objects + 1) * sizeof *out->start_of);
    if (out->vertex_of != s->vertex_of) support_free(alloc, out->vertex_of, s->corner_count * sizeof *out->vertex_of);
}

froe_status scene_explicit(const froe_scene *s, const froe_allocator *alloc, froe_scene *out) {
    const size_t objects = s->object_count;
    const size_t plain = offsetof(froe_scene, mapped); /* not the holds before it, which other threads may change */
    memcpy((char *)out + plain, (const char *)s + plain, sizeof *out - plain);
    if (!s->kind_of) out->kind_of = support_calloc(alloc, objects, sizeof *out->kind_of);
    if (!s->form_of) out->form_of = support_calloc(alloc, objects, sizeof *out->form_of);
    if (!s->start_of) out->start_of = support_calloc(alloc, objects + 1, sizeof *out->start_of);
    if (!s->vertex_of) out->vertex_of = support_calloc(alloc, s->corner_count, sizeof *out->vertex_of);
    if (!out->kind_of || !out->form_of || !out->start_of || !out->vertex_of) {
        scene_explicit_free(s, alloc, out);
        return FROE_E_MEMORY;
    }
    for (size_t i = 0; !s->kind_of && i < objects; i++) out->kind_of[i] = (uint8_t)s->kind;
    for (size_t i = 0; !s->form_of && i < objects; i++) out->form_of[i] = (uint8_t)s->form;
    for (size_t i = 0; !s->start_of && i <= objects; i++) out->start_of[i] = scene_start(s, (uint32_t)i);
    for (uint32_t i = 0; !s->vertex_of && i < s->corner_count; i++) out->vertex_of[i] = i;
    return FROE_OK;
}
