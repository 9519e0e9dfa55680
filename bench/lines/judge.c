/* judge.c: which lines should a drawing have, and which does it have? An oracle that shares no code with froe.
 *
 *     bench_judge MESH.off LINES.txt          prints: strokes, percent wrong, percent missing
 *
 * The mesh is seen along -z (bench/lines/page_mesh.py). Lines ought to be there along its borders, silhouettes, and
 * creases of more than 30 degrees, where nothing lies before them. Every half pixel of these, and of the lines drawn,
 * is a sample.
 *
 *     hidden      a triangle without the edge is nearer there: at the sample, and 0.05 px from it on all sides
 *     visible     there is none, at all five places
 *     neither     at a border of what hides it, and where another triangle is as deep: such samples do not count
 *
 * Wrong: no sample of an edge that ought to be drawn and is not hidden lies within 0.05 px of the line. Missing: a
 * visible sample of an edge, with no line within 0.05 px. Both in percent of all samples that count. */
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 1000 }; /* cells of the grid: one a pixel */
#define NEAR 0.05
#define STEP 0.5
#define DEPTH 1e-3 /* nearer by less is as deep: faces that share an edge meet there */

typedef struct vec {
    double x, y, z;
} vec;

typedef struct edge {
    uint32_t a, b, triangle[2], uses;
} edge;

typedef struct segment {
    double ax, ay, bx, by;
} segment;

typedef struct grid {
    uint32_t *starts, *items;
} grid;

static void *take(size_t count, size_t size) {
    void *p = calloc(count ? count : 1, size);
    if (!p) exit(1);
    return p;
}

/* ------------------------------------------------------------------------- grids -- */

static int cell_of(double x) {
    const int i = (int)floor(x + 0.5 * SIDE);
    return i < 0 ? 0 : i >= SIDE ? SIDE - 1 : i;
}

typedef struct box {
    double lo[2], hi[2];
} box;

/* Items by the cells of the page that their boxes meet, after all boxes are grown by NEAR. */
static grid grid_of(const box *boxes, size_t count) {
    grid g = {take((size_t)SIDE * SIDE + 2, sizeof *g.starts), NULL};
    for (int pass = 0; pass < 2; pass++) {
        for (size_t i = 0; i < count; i++)
            for (int y = cell_of(boxes[i].lo[1] - NEAR); y <= cell_of(boxes[i].hi[1] + NEAR); y++)
                for (int x = cell_of(boxes[i].lo[0] - NEAR); x <= cell_of(boxes[i].hi[0] + NEAR); x++) {
                    uint32_t *start = g.starts + (size_t)y * SIDE + x;
                    if (pass)
                        g.items[start[1]++] = (uint32_t)i;
                    else
                        start[2]++;
                }
        for (size_t c = 2; !pass && c < (size_t)SIDE * SIDE + 2; c++) g.starts[c] += g.starts[c - 1];
        if (!pass) g.items = take(g.starts[(size_t)SIDE * SIDE + 1], sizeof *g.items);
    }
    return g;
}

/* ----------------------------------------------------------------------- reading -- */

static vec *points;
static uint32_t *triangles;
static size_t point_count, triangle_count;

static void read_mesh(const char *path) {
    FILE *file = fopen(path, "r");
    if (!file || fscanf(file, "OFF %zu %zu %*d", &point_count, &triangle_count) != 2) exit(1);
    points = take(point_count, sizeof *points);
    triangles = take(3 * triangle_count, sizeof *triangles);
    for (size_t i = 0; i < point_count; i++)
        if (fscanf(file, "%lf %lf %lf", &points[i].x, &points[i].y, &points[i].z) != 3) exit(1);
    for (size_t i = 0; i < triangle_count; i++)
        if (fscanf(file, "%*d %u %u %u", triangles + 3 * i, triangles + 3 * i + 1, triangles + 3 * i + 2) != 3) exit(1);
    fclose(file);
}

static segment *read_lines(const char *path, size_t *count, size_t *strokes) {
    size_t room = 0;
    segment *out = NULL;
    FILE *file = fopen(path, "r");
    char *line = NULL;
    size_t size = 0;
    *count = *strokes = 0;
    while (file && getline(&line, &size, file) > 0) {
        char *at = line, *end;
        double last[2], p[2] = {0, 0};
        for (int i = 0;; i++) {
            memcpy(last, p, sizeof p);
            p[0] = strtod(at, &end);
            if (end == at) break;
            p[1] = strtod(end, &at);
            if (!i) continue;
            if (*count == room) out = realloc(out, (room = 2 * room + 64) * sizeof *out);
            out[(*count)++] = (segment){last[0], last[1], p[0], p[1]};
        }
        ++*strokes;
    }
    free(line);
    if (file) fclose(file);
    return out;
}

/* ------------------------------------------------------------------------- edges -- */

static vec normal_of(uint32_t t) {
    const vec a = points[triangles[3 * t]], b = points[triangles[3 * t + 1]], c = points[triangles[3 * t + 2]];
    const vec u = {b.x - a.x, b.y - a.y, b.z - a.z}, v = {c.x - a.x, c.y - a.y, c.z - a.z};
    const vec n = {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    const double length = sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    return (vec){n.x / length, n.y / length, n.z / length};
}

static int by_ends(const void *a, const void *b) {
    const edge *x = a, *y = b;
    if (x->a != y->a) return x->a < y->a ? -1 : 1;
    if (x->b != y->b) return x->b < y->b ? -1 : 1;
    return (x->triangle[0] > y->triangle[0]) - (x->triangle[0] < y->triangle[0]);
}

/* Does the triangle run from the first end of an edge to the second? */
static bool ascends(const edge *e, uint32_t t) {
    for (int i = 0; i < 3; i++)
        if (triangles[3 * t + i] == e->a) return triangles[3 * t + (i + 1) % 3] == e->b;
    return false;
}

static bool ought_to_be_drawn(const edge *e) {
    if (e->uses != 2) return true;
    const vec n = normal_of(e->triangle[0]), m = normal_of(e->triangle[1]);
    const double sign = ascends(e, e->triangle[0]) == ascends(e, e->triangle[1]) ? -1 : 1;
    if ((n.z > 0) != (sign * m.z > 0)) return true;
    return sign * (n.x * m.x + n.y * m.y + n.z * m.z) <= cos(30 * 3.14159265358979323846 / 180);
}

static edge *find_edges(size_t *count) {
    edge *edges = take(3 * triangle_count, sizeof *edges);
    size_t kept = 0;
    for (uint32_t t = 0; t < triangle_count; t++)
        for (int i = 0; i < 3; i++) {
            const uint32_t a = triangles[3 * t + i], b = triangles[3 * t + (i + 1) % 3];
            edges[3 * t + i] = (edge){a < b ? a : b, a < b ? b : a, {t, UINT32_MAX}, 1};
        }
    qsort(edges, 3 * triangle_count, sizeof *edges, by_ends);
    for (size_t i = 0; i < 3 * triangle_count; i++) {
        edge *last = edges + kept - (kept > 0);
        if (kept && last->a == edges[i].a && last->b == edges[i].b) {
            if (last->uses++ == 1) last->triangle[1] = edges[i].triangle[0];
        } else
            edges[kept++] = edges[i];
    }
    *count = 0;
    for (size_t i = 0; i < kept; i++)
        if (ought_to_be_drawn(edges + i)) edges[(*count)++] = edges[i];
    return edges;
}

/* -------------------------------------------------------------------------- rays -- */

static grid triangle_grid;

static bool has_edge(uint32_t t, const edge *e) {
    int ends = 0;
    for (int i = 0; i < 3; i++) ends += triangles[3 * t + i] == e->a || triangles[3 * t + i] == e->b;
    return ends == 2;
}

/* Where is the nearest triangle that has not the edge, from depth z: 1 before it, 0 as deep, -1 behind, or none. */
static int nearest_at(const edge *e, double x, double y, double z) {
    int nearest = -1;
    const uint32_t *start = triangle_grid.starts + (size_t)cell_of(y) * SIDE + cell_of(x);
    for (uint32_t k = start[0]; k < start[1]; k++) {
        const uint32_t t = triangle_grid.items[k];
        const vec a = points[triangles[3 * t]], b = points[triangles[3 * t + 1]], c = points[triangles[3 * t + 2]];
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        const double u = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area,
                     v = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
        if (area == 0 || u < 0 || v < 0 || u + v > 1 || has_edge(t, e)) continue;
        const double before = a.z + u * (b.z - a.z) + v * (c.z - a.z) - z;
        if (before > DEPTH) return 1;
        if (before >= -DEPTH) nearest = 0;
    }
    return nearest;
}

/* 1: hidden, 0: visible, -1: neither. */
static int hidden_at(const edge *e, double t) {
    const vec a = points[e->a], b = points[e->b];
    const double x = a.x + t * (b.x - a.x), y = a.y + t * (b.y - a.y), z = a.z + t * (b.z - a.z);
    static const int way[5][2] = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    int covered = 0;
    for (int i = 0; i < 5; i++) {
        const int nearest = nearest_at(e, x + NEAR * way[i][0], y + NEAR * way[i][1], z);
        covered += nearest > 0;
        if (i == 0 && nearest == 0) return -1;
    }
    return covered == 5 ? 1 : covered ? -1 : 0;
}

/* ------------------------------------------------------------------------ judging -- */

static double distance_to(const segment *s, double x, double y, double *share) {
    const double dx = s->bx - s->ax, dy = s->by - s->ay, square = dx * dx + dy * dy;
    double t = square > 0 ? ((x - s->ax) * dx + (y - s->ay) * dy) / square : 0;
    *share = t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypot(x - s->ax - t * dx, y - s->ay - t * dy);
}

static grid grid_of_segments(const segment *s, size_t count) {
    box *boxes = take(count, sizeof *boxes);
    for (size_t i = 0; i < count; i++)
        boxes[i] =
            (box){{fmin(s[i].ax, s[i].bx), fmin(s[i].ay, s[i].by)}, {fmax(s[i].ax, s[i].bx), fmax(s[i].ay, s[i].by)}};
    const grid g = grid_of(boxes, count);
    free(boxes);
    return g;
}

/* A walk along a segment: the middles of its half pixels. */
typedef struct sampler {
    double x, y;
    size_t i, count;
} sampler;

static bool next_sample(sampler *at, const segment *s) {
    if (!at->i) at->count = (size_t)(hypot(s->bx - s->ax, s->by - s->ay) / STEP);
    if (at->i == at->count) return false;
    const double t = ((double)at->i++ + 0.5) / (double)at->count;
    at->x = s->ax + t * (s->bx - s->ax), at->y = s->ay + t * (s->by - s->ay);
    return true;
}

static const uint32_t *cell_at(const grid *g, double x, double y) {
    return g->starts + (size_t)cell_of(y) * SIDE + cell_of(x);
}

/* A part of samples in percent. */
typedef struct tally {
    size_t bad, count;
} tally;

static double percent(tally t) {
    return t.count ? 100.0 * (double)t.bad / (double)t.count : 0;
}

static tally count_wrong(const segment *lines, size_t count, const edge *edges, const segment *wanted, const grid *g) {
    tally out = {0, 0};
    for (size_t i = 0; i < count; i++)
        for (sampler at = {.i = 0}; next_sample(&at, lines + i);) {
            const uint32_t *start = cell_at(g, at.x, at.y);
            bool right = false;
            double share;
            for (uint32_t j = start[0]; j < start[1] && !right; j++) {
                const uint32_t e = g->items[j];
                right = distance_to(wanted + e, at.x, at.y, &share) <= NEAR && hidden_at(edges + e, share) != 1;
            }
            out.count++, out.bad += !right;
        }
    return out;
}

static tally count_missing(const segment *lines, const grid *g, const edge *edges, const segment *wanted,
                           size_t count) {
    tally out = {0, 0};
    for (size_t i = 0; i < count; i++)
        for (sampler at = {.i = 0}; next_sample(&at, wanted + i);) {
            const uint32_t *start = cell_at(g, at.x, at.y);
            bool found = false;
            double share;
            if (hidden_at(edges + i, ((double)at.i - 0.5) / (double)at.count) != 0) continue;
            for (uint32_t j = start[0]; j < start[1] && !found; j++)
                found = distance_to(lines + g->items[j], at.x, at.y, &share) <= NEAR;
            out.count++, out.bad += !found;
        }
    return out;
}

static grid grid_of_triangles(void) {
    box *boxes = take(triangle_count, sizeof *boxes);
    for (size_t t = 0; t < triangle_count; t++) {
        const vec a = points[triangles[3 * t]], b = points[triangles[3 * t + 1]], c = points[triangles[3 * t + 2]];
        boxes[t] = (box){{fmin(a.x, fmin(b.x, c.x)), fmin(a.y, fmin(b.y, c.y))},
                         {fmax(a.x, fmax(b.x, c.x)), fmax(a.y, fmax(b.y, c.y))}};
    }
    const grid g = grid_of(boxes, triangle_count);
    free(boxes);
    return g;
}

int main(int argc, char **argv) {
    size_t edge_count, line_count, strokes;
    if (argc != 3) return 2;
    read_mesh(argv[1]);
    edge *edges = find_edges(&edge_count);
    segment *lines = read_lines(argv[2], &line_count, &strokes);
    segment *wanted = take(edge_count, sizeof *wanted);
    for (size_t i = 0; i < edge_count; i++)
        wanted[i] = (segment){points[edges[i].a].x, points[edges[i].a].y, points[edges[i].b].x, points[edges[i].b].y};
    triangle_grid = grid_of_triangles();
    const grid line_grid = grid_of_segments(lines, line_count), edge_grid = grid_of_segments(wanted, edge_count);
    const tally wrong = count_wrong(lines, line_count, edges, wanted, &edge_grid),
                missing = count_missing(lines, &line_grid, edges, wanted, edge_count);
    printf("%zu %.4g %.4g\n", strokes, percent(wrong), percent(missing));
    free(edges), free(lines), free(wanted);
    return 0;
}
