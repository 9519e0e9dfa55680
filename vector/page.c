/* page.c: what a page shows, in the operators of PDF (ISO 32000, 8.5), for which EPS defines procedures of the same
 * names. Coordinates are whole steps of the grid, 1/256 of a point, from the upper left corner. */
#include "page.h"
#include "render.h"

typedef struct page_writer {
    vector_render *render;
    vector_output *output;
    uint32_t alpha; /* in force, 0 .. 255 */
    bool *alphas;
} page_writer;

static void put_colour(vector_output *output, uint32_t colour, const char *operator) {
    vector_print(output, "%s %s %s %s\n", vector_real(4, (colour >> 16 & 255) / 255.0).text,
                 vector_real(4, (colour >> 8 & 255) / 255.0).text,
                 vector_real(4, (colour & 255) / 255.0).text, operator);
}

static bool put_path(void *user, const froe_render_path *path) {
    page_writer *w = user;
    const double grid = w->render->grid;
    const uint32_t alpha = path->colour >> 24;
    if (alpha != w->alpha) vector_print(w->output, "/a%u gs\n", alpha);
    w->alphas[w->alpha = alpha] = true;
    if (!path->lines) put_colour(w->output, path->colour, "rg");
    if (path->dots) vector_print(w->output, "1 J\n");
    if (path->width > 0) {
        put_colour(w->output, path->colour, "RG");
        vector_print(w->output, "%s w\n", vector_real(6, grid * path->width).text);
        if (path->dash > 0)
            vector_print(w->output, "[%s %s] 0 d\n", vector_real(6, grid * path->dash).text,
                         vector_real(6, grid * path->gap).text);
        else
            vector_print(w->output, "[] 0 d\n");
    }
    for (size_t i = 0; i < path->count; i++) {
        const froe_outline *outline = path->outlines + i;
        int64_t at[2] = {0, 0};
        if (!path->lines && !vector_ring_shows(w->render, outline)) continue;
        for (size_t k = 0; k < outline->count; k++) { /* points that fall together on the grid are one */
            const int64_t x = vector_step(w->render, outline->points[2 * k]),
                          y = vector_step(w->render, outline->points[2 * k + 1]);
            if (k && x == at[0] && y == at[1]) continue;
            vector_print(w->output, "%lld %lld %c\n", (long long)x, (long long)y, k ? 'l' : 'm');
            at[0] = x, at[1] = y;
        }
        if (outline->closed) vector_print(w->output, "h\n");
    }
    vector_print(w->output, "%s\n", path->lines ? "S" : path->width > 0 ? "B" : "f");
    if (path->dots) vector_print(w->output, "0 J\n");
    return !w->output->status;
}

vector_digits vector_points(const vector_render *render, double length) {
    return vector_real(10, length * vector_unit(render->options));
}

void vector_put_page(vector_render *render, vector_output *output, bool alphas[256]) {
    const froe_render_options *o = render->options;
    page_writer w = {.render = render, .output = output, .alpha = 255, .alphas = alphas};
    if (o->background < FROE_DRAW_BY_FORMAT) {
        put_colour(output, o->background, "rg");
        vector_print(output, "0 0 %s %s re f\n", vector_points(render, o->camera.width).text,
                     vector_points(render, o->camera.height).text);
    }
    vector_print(output, "0.00390625 0 0 -0.00390625 0 %s cm\n1 j\n", vector_points(render, o->camera.height).text);
    vector_each_path(render, put_path, &w);
}
