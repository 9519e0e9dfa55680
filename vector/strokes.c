/* strokes.c: how lines of each kind are drawn: the options' styles, over widths that suit illustrations. */
#include "render.h"
#include "support/fail.h"

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
        return 1;
    case FROE_LINE_CROSSING:
        return 0.8;
    default:
        return 0.6;
    }
}

froe_line_style vector_line_style(const froe_render_options *options, froe_line kind, bool hidden, double scale) {
    const double width = scale * (usual_width(kind) * options->line_width);
    froe_line_style out = {.width = hidden ? 0.6 * width : width, .colour = VECTOR_INK, .dash = NAN};
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
