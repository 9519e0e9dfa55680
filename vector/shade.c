/* shade.c: colours of faces: those of their groups, or one hue per material, lit by a light fixed to the camera. */
#include "render.h"
#include "support/axes.h"
#include <stdlib.h>
#include <string.h>

/* Muted, of like weight, and apart for the colour-blind; materials take them in the order they come. */
static const uint32_t hues[] = {0xE9E4D8, 0xB8CBD6, 0xD9B48F, 0xB9C7A0, 0xC9B6CF, 0xE3CF8E, 0xC9A79C, 0xA8C4BE};

/* Steps of light of flat shading: one is at most two of 255, which is invisible, and neighbours on a smooth surface
 * share a path more often. */
enum { LIGHTS = 64 };

/* How much the light, to the upper left of the camera, lights a polygon: 0 .. 1, from both sides. */
static double light_on(const vector_render *r, uint32_t object) {
    const double *p[3];
    double n[3], lamp[3];
    for (uint32_t i = 0; i < 3; i++) p[i] = froe_scene_vertex(r->scene, froe_scene_corner(r->scene, object, i));
    for (int k = 0; k < 3; k++) lamp[k] = 0.55 * r->view.back[k] + 0.7 * r->view.up[k] - 0.45 * r->view.right[k];
    support_triangle_normal(p[0], p[1], p[2], n);
    const double at = fabs(support_dot(n, lamp)) / sqrt(support_dot(n, n) * support_dot(lamp, lamp));
    return at >= 0 && at <= 1 ? at : 1;
}

static const char *name_of_group(const vector_render *r, uint32_t group, bool material) {
    const froe_group g = froe_scene_group(r->scene, group);
    return material ? g.material : g.name;
}

/* Per group: the first with its name, or its material; by a hash table, as there may be a group for each colour. */
static uint32_t *first_of_name(const vector_render *r, bool material) {
    const uint32_t groups = (uint32_t)froe_scene_group_count(r->scene);
    size_t slots = 16;
    while (slots < 2 * (size_t)groups) slots *= 2;
    uint32_t *out = support_calloc(&r->alloc, groups, sizeof *out),
             *table = support_calloc(&r->alloc, slots, sizeof *table); /* 1 more, 0: free */
    for (uint32_t g = 0; out && table && g < groups; g++) {
        const char *name = name_of_group(r, g, material);
        uint32_t hash = 2166136261u; /* FNV-1a */
        for (const char *c = name; *c; c++) hash = (hash ^ (unsigned char)*c) * 16777619u;
        size_t at = hash & (slots - 1);
        while (table[at] && strcmp(name_of_group(r, table[at] - 1, material), name) != 0) at = (at + 1) & (slots - 1);
        if (!table[at]) table[at] = g + 1;
        out[g] = table[at] - 1;
    }
    if (!table) support_free(&r->alloc, out, groups * sizeof *out), out = NULL;
    support_free(&r->alloc, table, slots * sizeof *table);
    return out;
}

/* 0: the scene gives none, or it is not wanted. */
static uint32_t given_colour(const froe_scene *scene, const froe_render_options *o, uint32_t group) {
    const bool wanted = !o->own_colours && o->shading != FROE_SHADE_WHITE && o->shading != FROE_SHADE_NONE;
    return wanted ? froe_scene_group(scene, group).colour : 0;
}

double vector_opacity(const froe_scene *scene, const froe_render_options *o, uint32_t group) {
    if (group == FROE_NONE) return 1;
    if (o->opacity && !isnan(o->opacity[group])) return o->opacity[group];
    const uint32_t colour = given_colour(scene, o, group);
    return colour ? (colour & 255) / 255.0 : 1;
}

uint32_t vector_line_colour(const vector_render *r, uint32_t group) {
    const uint32_t given = group == FROE_NONE ? 0 : given_colour(r->scene, r->options, group);
    return given ? given >> 8 : FROE_LINE_COLOUR;
}

/* 0xAARRGGBB. */
static uint32_t style_of(const vector_render *r, uint32_t patch, const uint32_t *materials) {
    const froe_render_options *o = r->options;
    const froe_patch p = froe_surface_patch(r->surface, patch);
    const uint32_t alpha = (uint32_t)floor(vector_opacity(r->scene, o, p.group) * 255 + 0.5);
    const uint32_t given = p.group == FROE_NONE ? 0 : given_colour(r->scene, o, p.group);
    const uint32_t own = p.group == FROE_NONE ? hues[0] : hues[materials[p.group] % (sizeof hues / sizeof *hues)];
    const uint32_t colour = given ? given >> 8 : own;
    const double lit_by = light_on(r, p.objects[0]);
    const double light = o->shading == FROE_SHADE_CEL ? (floor(lit_by * 0.9999 * o->cel_levels) + 0.5) / o->cel_levels
                                                      : floor(lit_by * LIGHTS + 0.5) / LIGHTS;
    if (o->shading == FROE_SHADE_WHITE) return alpha << 24 | 0xFFFFFF;
    if (o->shading == FROE_SHADE_PLAIN) return alpha << 24 | colour;
    uint32_t lit = alpha << 24;
    for (int shift = 0; shift < 24; shift += 8)
        lit |= (uint32_t)floor((double)(colour >> shift & 255) * (0.45 + 0.55 * light) + 0.5) << shift;
    return lit;
}

static int compare_styles(const void *a, const void *b) {
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* Colours of patches become numbers of the colours there are. */
static void number_styles(vector_render *r) {
    size_t kept = 0;
    uint32_t *colours = r->styles.data;
    if (r->styles.count) qsort(colours, r->styles.count, sizeof *colours, compare_styles);
    for (size_t i = 0; i < r->styles.count; i++)
        if (!kept || colours[i] != colours[kept - 1]) colours[kept++] = colours[i];
    r->styles.count = kept;
    for (size_t i = 0; i < r->patches; i++) {
        const uint32_t *found = bsearch(&r->style_of[i], colours, kept, sizeof *colours, compare_styles);
        r->style_of[i] = (uint32_t)(found - colours);
    }
}

froe_status vector_shade(vector_render *r) {
    const froe_render_options *o = r->options;
    const size_t groups = froe_scene_group_count(r->scene);
    const bool layers = o->layers == FROE_LAYERS_OBJECT, keys = layers || o->ids == FROE_IDS_OBJECT;
    uint32_t count = 0, *materials = first_of_name(r, true);
    r->style_of = support_calloc(&r->alloc, r->patches, sizeof *r->style_of);
    if (layers) r->layer_of = first_of_name(r, false);
    if (keys) r->keys = support_calloc(&r->alloc, r->patches, sizeof *r->keys);
    const bool ok = materials && r->style_of && (!layers || r->layer_of) && (!keys || r->keys) &&
                    array_reserve(&r->alloc, &r->styles, r->patches);
    /* Materials are numbered in the order in which they first occur. */
    for (uint32_t g = 0; ok && g < groups; g++) materials[g] = materials[g] < g ? materials[materials[g]] : count++;
    for (uint32_t i = 0; ok && i < r->patches; i++)
        r->styles.data[r->styles.count++] = r->style_of[i] = style_of(r, i, materials);
    if (ok) number_styles(r);
    /* The order of painting keeps layers together, or groups, or colours alone. */
    for (uint32_t i = 0; ok && keys && i < r->patches; i++) {
        const uint32_t group = froe_surface_patch(r->surface, i).group;
        r->keys[i] = group == FROE_NONE ? 0 : 1 + (r->layer_of ? r->layer_of[group] : group);
    }
    support_free(&r->alloc, materials, groups * sizeof *materials);
    return ok ? FROE_OK : FROE_E_MEMORY;
}
