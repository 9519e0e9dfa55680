/* strokes.c: how lines of each kind are drawn (the options' styles, over widths that suit illustrations), and what they
 * belong to. */
#include "render.h"
#include "support/fail.h"
#include <stdlib.h>

/* ----------------------------------------------------------------------- styles -- */

froe_line_style froe_line_style_defaults(void) {
    return (froe_line_style){.width = NAN, .colour = FROE_NONE, .dash = NAN, .gap = NAN};
}

/* A share of the option line_width. */
static double usual_width(froe_line kind) {
    switch (kind) {
    case FROE_LINE_SECTION:
        return 2;
    case FROE_LINE_BORDER:
    case FROE_LINE_SILHOUETTE:
    case FROE_LINE_WIRE:
        return 1;
    case FROE_LINE_CROSSING:
        return 0.8;
    default:
        return 0.6;
    }
}

froe_line_style vector_line_style(const froe_render_options *options, froe_line kind, bool hidden, double scale) {
    const bool point = kind == FROE_LINE_POINT;
    const double width = scale * (point ? options->point_width : usual_width(kind) * options->line_width);
    froe_line_style out = {.width = hidden ? 0.6 * width : width, .colour = FROE_NONE, .dash = NAN};
    for (size_t i = 0; i < options->line_style_count; i++) {
        const froe_line_style *s = options->line_styles + i;
        if (!((hidden ? s->hidden : s->visible) & (uint32_t)kind)) continue;
        if (!isnan(s->width)) out.width = scale * s->width;
        if (s->colour != FROE_NONE) out.colour = s->colour;
        if (!isnan(s->dash)) out.dash = scale * s->dash, out.gap = scale * s->gap;
    }
    if (isnan(out.dash)) out.dash = hidden ? 4 * out.width : 0, out.gap = hidden ? 3 * out.width : 0;
    return out;
}

double vector_line_reach(const froe_render_options *options) {
    double widest = 0;
    for (uint32_t kind = 1; kind < FROE_LINE_END; kind <<= 1) {
        if (kind == FROE_LINE_POINT) continue;
        const bool drawn = options->lines & kind && (kind != FROE_LINE_SECTION || options->section);
        if (drawn) widest = fmax(widest, vector_line_style(options, (froe_line)kind, false, 1).width);
    }
    return 0.5 * widest;
}

/* Is it NaN, or a length that a page may have? */
static bool is_length(double x, bool above_0) {
    return isnan(x) || (x <= 1e6 && (above_0 ? x > 0 : x >= 0));
}

froe_status vector_check_lines(const froe_render_options *options, froe_diagnostic *diag) {
    if (options->lines >= FROE_LINE_END)
        return support_fail(diag, FROE_E_OPTIONS, "option 'lines': The bits 0x%X are no kinds of lines.",
                            options->lines & ~(FROE_LINE_END - 1u));
    if (options->line_style_count && !options->line_styles) return support_fail_null(diag, "froe_render_options");
    for (size_t i = 0; i < options->line_style_count; i++) {
        const froe_line_style *s = options->line_styles + i;
        if (!is_length(s->width, true))
            return support_fail(diag, FROE_E_OPTIONS,
                                "line style %zu: A width of %g is not a number above 0 and up to 1e6.", i, s->width);
        if (s->colour > 0xFFFFFF && s->colour != FROE_NONE)
            return support_fail(diag, FROE_E_OPTIONS, "line style %zu: The colour 0x%X is not like 0xRRGGBB.", i,
                                s->colour);
        if (!is_length(s->dash, false) || !is_length(s->gap, false) || isnan(s->dash) != isnan(s->gap) ||
            (s->dash > 0) != (s->gap > 0))
            return support_fail(diag, FROE_E_OPTIONS,
                                "line style %zu: Dashes of %g and gaps of %g are not both above 0 and up to 1e6, nor "
                                "both 0.",
                                i, s->dash, s->gap);
    }
    return FROE_OK;
}

/* ----------------------------------------------------------------------- owners -- */

uint32_t vector_group(const vector_render *r, uint32_t object) {
    return froe_scene_object(r->scene, object).group;
}

froe_status vector_find_owners(vector_render *r) {
    const froe_render_options *o = r->options;
    const size_t objects = froe_scene_object_count(r->scene);
    if (o->ids == FROE_IDS_NONE && o->layers != FROE_LAYERS_OBJECT) return FROE_OK;
    r->owners = support_calloc(&r->alloc, objects, sizeof *r->owners);
    if (!r->owners) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < objects; i++) {
        const uint32_t patch = froe_surface_patch_of(r->surface, i), group = vector_group(r, i);
        const bool layer = o->ids == FROE_IDS_NONE && group != FROE_NONE;
        r->owners[i] = o->ids != FROE_IDS_FACE ? (layer ? r->layer_of[group] : group)
                       : patch == FROE_NONE    ? i
                                               : froe_surface_patch(r->surface, patch).objects[0];
    }
    return FROE_OK;
}

typedef struct stroke_key {
    size_t place, i;
    uint32_t layer, kind, owner; /* kinds as the picture has them */
    bool visible;
} stroke_key;

static int compare_strokes(const void *a, const void *b) {
    const stroke_key *x = a, *y = b;
    if (x->place != y->place) return x->place < y->place ? -1 : 1;
    if (x->visible != y->visible) return x->visible - y->visible;
    if (x->layer != y->layer) return x->layer < y->layer ? -1 : 1;
    if (x->kind != y->kind) return x->kind < y->kind ? -1 : 1;
    if (x->owner != y->owner) return x->owner < y->owner ? -1 : 1;
    return (x->i > y->i) - (x->i < y->i);
}

froe_status vector_sort_strokes(vector_render *r) {
    const size_t count = froe_picture_stroke_count(r->picture);
    if (!r->owners) return FROE_OK;
    stroke_key *keys = support_calloc(&r->alloc, count, sizeof *keys);
    r->order = support_calloc(&r->alloc, count, sizeof *r->order);
    uint32_t kinds = 0;
    froe_line last = 0;
    for (size_t i = 0; keys && i < count; i++) {
        const froe_stroke s = froe_picture_stroke(r->picture, i);
        const uint32_t group = vector_group(r, s.objects[0]);
        kinds += s.kind != last; /* those of a kind follow each other */
        last = s.kind;
        keys[i] = (stroke_key){.place = s.place, .i = i, .kind = kinds, .visible = !s.hidden};
        keys[i].owner = r->owners[s.objects[0]];
        keys[i].layer = r->layer_of && group != FROE_NONE ? r->layer_of[group] : FROE_NONE;
    }
    if (keys) qsort(keys, count, sizeof *keys, compare_strokes);
    for (size_t i = 0; keys && r->order && i < count; i++) r->order[i] = keys[i].i;
    support_free(&r->alloc, keys, count * sizeof *keys);
    return keys && r->order ? FROE_OK : FROE_E_MEMORY;
}

froe_stroke vector_stroke(const vector_render *r, size_t i) {
    const bool there = r->order && i < froe_picture_stroke_count(r->picture);
    return froe_picture_stroke(r->picture, there ? r->order[i] : i);
}
