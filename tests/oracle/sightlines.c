/* sightlines.c: triangles in a grid on the page, points of edges held before them. */
#include "oracle/sightlines.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { CELLS = 160 };

typedef struct checker {
    const oracle_triangles *triangles;
    const froe_scene *scene;
    const froe_surface *surface;
    size_t starts[CELLS * CELLS + 1];
    uint32_t *entries;
    oracle_lines *sum;
} checker;

/* -------------------------------------------------------------------------- grid -- */

static uint32_t cell_of(double place, double size) {
    const double at = floor(place / size * CELLS);
    return at >= 0 ? at < CELLS ? (uint32_t)at : CELLS - 1 : 0;
}

static void for_cells(checker *c, bool count_only) {
    const froe_projection *view = c->triangles->view;
    for (size_t i = 0; i < c->triangles->count; i++) {
        const oracle_triangle *t = c->triangles->at + i;
        for (uint32_t y = cell_of(t->lo[1], view->height); y <= cell_of(t->hi[1], view->height); y++)
            for (uint32_t x = cell_of(t->lo[0], view->width); x <= cell_of(t->hi[0], view->width); x++)
                if (count_only)
                    c->starts[y * CELLS + x]++;
                else
                    c->entries[--c->starts[y * CELLS + x]] = (uint32_t)i;
    }
}

static void fill_grid(checker *c) {
    for_cells(c, true);
    for (size_t i = 1; i <= CELLS * CELLS; i++) c->starts[i] += c->starts[i - 1]; /* ends, lowered to starts */
    c->entries = malloc((c->starts[CELLS * CELLS] + 1) * sizeof *c->entries);
    if (!c->entries) {
        fprintf(stderr, "oracle: no memory\n");
        exit(1);
    }
    for_cells(c, false);
}

/* ------------------------------------------------------------------------ points -- */

static bool uses(const froe_edge *edge, uint32_t object) {
    for (size_t i = 0; i < edge->object_count; i++)
        if (edge->objects[i] == object) return true;
    return false;
}

/* 1 something lies before the point, 0 nothing, -1 that is doubtful. Polygons that use the edge do not count. */
static int blocked(const checker *c, const froe_edge *edge, const double page[2], double depth) {
    const size_t cell =
        (size_t)cell_of(page[1], c->triangles->view->height) * CELLS + cell_of(page[0], c->triangles->view->width);
    int found = 0;
    for (size_t i = c->starts[cell]; i < c->starts[cell + 1] && found < 1; i++) {
        const oracle_triangle *t = c->triangles->at + c->entries[i];
        bool doubt;
        if (uses(edge, t->object)) continue;
        const double at = oracle_depth(c->triangles, c->entries[i], page, &doubt);
        const double near = depth - ORACLE_TIE * fabs(depth), far = depth + ORACLE_TIE * fabs(depth);
        if (doubt)
            found = -1;
        else if (at > 0 && at < far)
            found = at < near ? 1 : -1;
    }
    return found;
}

static void check_point(checker *c, uint32_t number, const froe_edge *edge, double share, bool visible) {
    const froe_projection *view = c->triangles->view;
    const double *a = froe_scene_vertex(c->scene, edge->vertex[0]), *b = froe_scene_vertex(c->scene, edge->vertex[1]);
    double point[3], page[2], depth = view->eye.parallel ? c->triangles->back : 0;
    for (int k = 0; k < 3; k++) {
        point[k] = a[k] + share * (b[k] - a[k]);
        depth -= view->back[k] * (point[k] - view->origin[k]);
    }
    if (!froe_project(view, point, page)) return;
    if (!(page[0] > 0 && page[1] > 0 && page[0] < view->width && page[1] < view->height)) return;
    const int is_blocked = blocked(c, edge, page, depth);
    if (is_blocked < 0) {
        c->sum->doubtful++;
    } else if (is_blocked == visible) {
        if (c->sum->wrong++) return;
        c->sum->edge = number;
        c->sum->share = share;
    } else {
        ++*(visible ? &c->sum->visible : &c->sum->hidden);
    }
}

/* Is every polygon at this edge seen edge-on, nearly? Then nothing of it is visible, by definition. */
static bool edge_on(const checker *c, const froe_edge *edge) {
    const froe_eye *eye = &c->triangles->view->eye;
    for (size_t i = 0; i < edge->object_count; i++) {
        double p[3][3], n[3], at = 0, size = 0;
        for (uint32_t k = 0; k < 9; k++)
            p[k / 3][k % 3] = froe_scene_vertex(c->scene, froe_scene_corner(c->scene, edge->objects[i], k / 3))[k % 3];
        for (int k = 0; k < 3; k++) {
            const int x = (k + 1) % 3, y = (k + 2) % 3;
            n[k] = (p[1][x] - p[0][x]) * (p[2][y] - p[0][y]) - (p[1][y] - p[0][y]) * (p[2][x] - p[0][x]);
            const double way = eye->parallel ? eye->at[k] : eye->at[k] - p[0][k];
            at += n[k] * way;
            size += fabs(n[k] * way);
        }
        if (fabs(at) > 1e-9 * size) return false;
    }
    return true;
}

static void check_edge(checker *c, const froe_visibility *visibility, uint32_t number) {
    const froe_edge edge = froe_surface_edge(c->surface, number);
    size_t count;
    const froe_interval *x = froe_visibility_of_edge(visibility, number, &count);
    double last = 0;
    if (edge_on(c, &edge)) return;
    for (size_t i = 0; i <= count; i++) {
        const double from = i < count ? x[i].from : 1;
        if (from - last > 1e-9) check_point(c, number, &edge, 0.5 * (last + from), false);
        if (i == count) break;
        if (x[i].to - from > 1e-9) check_point(c, number, &edge, 0.5 * (from + x[i].to), true);
        last = x[i].to;
    }
}

void oracle_check_edges(const oracle_triangles *triangles, const froe_scene *scene, const froe_surface *surface,
                        const froe_visibility *visibility, uint32_t step, oracle_lines *sum) {
    static checker c; /* its grid is too large for a stack */
    c = (checker){.triangles = triangles, .scene = scene, .surface = surface, .sum = sum};
    fill_grid(&c);
    for (uint32_t e = 0; e < froe_surface_edge_count(surface); e += step) check_edge(&c, visibility, e);
    free(c.entries);
}
