/* sightlines.c: the table of sightlines, and the sides that images do not decide. */
#include "view/visibility/sightlines.h"
#include "base/random.h"
#include "geom/predicates.h"
#include "geom/selftest.h"
#include "view/visibility/order.h"
#include <string.h>

/* Relative errors of images of lines: FINE is good enough, above COARSE exact numbers are used. */
#define FINE 0x1p-49
#define COARSE 0x1p-44

/* ------------------------------------------------------------------ begin, end -- */

/* The number of an end of a line across the window, among the points. */
static uint32_t end_across(const view_sightlines *s, int axis, uint32_t i, uint32_t end) {
    return s->window_count + 2 * ((uint32_t)axis * (s->tiles - 1) + i - 1) + end;
}

/* Finer than the faces of a scene are on the whole, so that what is small gets tiles of its own size. */
static uint32_t choose_tiles(const froe_surface *surface, uint32_t window_count) {
    enum { TILES_MOST = 4096 };
    uint32_t tiles = 1;
    while (window_count == 4 && tiles < TILES_MOST && (uint64_t)tiles * tiles < 4 * (uint64_t)surface->patch_count)
        tiles *= 2;
    return tiles;
}

/* The corners of the window, and the ends of the lines across it: each on one of its sides, rounded. */
static bool make_points(view_sightlines *s, const double *window, uint32_t window_count) {
    s->window_count = window_count;
    s->tiles = choose_tiles(s->surface, window_count);
    s->point_count = window_count + 4 * (s->tiles - 1);
    s->points = support_calloc(&s->alloc, 3 * (size_t)s->point_count + 1, sizeof *s->points);
    if (!s->points) return false;
    for (uint32_t k = 0; k < 3 * window_count; k++) s->points[k] = window[k];
    for (int axis = 0; axis < 2; axis++)
        for (uint32_t i = 1; i < s->tiles; i++)
            for (uint32_t end = 0; end < 2; end++) {
                const uint32_t from = end ? 3 - 2 * (uint32_t)axis : 0, to = end ? 2 : 1 + 2 * (uint32_t)axis;
                const double share = (double)i / s->tiles;
                for (uint32_t k = 0; k < 3; k++)
                    s->points[3 * (size_t)end_across(s, axis, i, end) + k] =
                        (1 - share) * window[3 * from + k] + share * window[3 * to + k];
            }
    return true;
}

froe_status view_sightlines_new(view_sightlines *s, const froe_tree *tree, const froe_surface *surface,
                                const geom_eye *eye, const double *window, uint32_t window_count,
                                const froe_allocator *alloc) {
    *s = (view_sightlines){.alloc = *alloc, .tree = tree, .surface = surface, .eye = *eye};
    froe_status status = geom_context_new(alloc, &s->context);
    if (status) return status;
    if (!make_points(s, window, window_count)) return FROE_E_MEMORY;
    const uint32_t objects = tree->scene->object_count;
    s->eye_sides = support_calloc(alloc, (size_t)objects + 1, sizeof *s->eye_sides);
    s->of_edge = support_calloc(alloc, surface_line_count(surface) + 1, sizeof *s->of_edge);
    if (!s->eye_sides || !s->of_edge) return FROE_E_MEMORY;
    memset(s->eye_sides, 2, objects);
    return FROE_OK;
}

void view_sightlines_free(view_sightlines *s) {
    if (s->points) support_free(&s->alloc, s->points, (3 * (size_t)s->point_count + 1) * sizeof *s->points);
    if (s->eye_sides) support_free(&s->alloc, s->eye_sides, (size_t)s->tree->scene->object_count + 1);
    view_sightlines_drop(s);
    num_context_free(&s->context);
}

froe_status view_sightlines_fork(const view_sightlines *s, view_sightlines *out) {
    *out = *s;
    const froe_status status = geom_context_new(&s->alloc, &out->context);
    if (status) out->tree = NULL;
    return status;
}

void view_sightlines_close(view_sightlines *s) {
    if (s->tree) num_context_free(&s->context);
}

void view_sightlines_drop(view_sightlines *s) {
    if (s->of_edge) support_free(&s->alloc, s->of_edge, (surface_line_count(s->surface) + 1) * sizeof *s->of_edge);
    s->of_edge = NULL;
    array_free(&s->alloc, &s->lines);
    scene_table_free(&s->alloc, &s->made);
}

int view_facing(view_sightlines *s, uint32_t object) {
    if (s->eye_sides[object] == 2) {
        geom_plane plane;
        scene_support(s->tree->scene, object, &plane);
        s->eye_sides[object] = (int8_t)geom_side_of_eye(&s->context, &plane, &s->eye);
    }
    return s->eye_sides[object];
}

/* ----------------------------------------------------------------------- lines -- */

geom_plane view_plane_at(const view_sightlines *s, uint32_t object) {
    if (object == FROE_NONE) return tree_plane_at(s->tree, 0);
    geom_plane plane;
    scene_support(s->tree->scene, object, &plane);
    return plane;
}

/* The plane that divides a face where a cut does. A wall of the method `cylindrical` leans by an infinitely small eps
 * from x + eps y; where it stands in the plane of an upright face, it divides that face at its y. */
static geom_plane dividing(const geom_plane *face, const geom_plane *cut) {
    const double x = face->p[0][0];
    if (!geom_is_sheared(cut) || face->p[1][0] != x || face->p[2][0] != x) return *cut;
    if (cut->form == GEOM_AT_VERTEX) return geom_plane_axis(3, 1, cut->p[0][1]);
    const int line = cut->p[0][0] == cut->p[1][0] ? 2 : 0; /* of those that cross there, one that crosses the face */
    const double *p = cut->p[line], *q = cut->p[line + 1];
    return p[0] < q[0] ? geom_plane_vertical(p, q) : geom_plane_vertical(q, p);
}

/* The line as a geom_line; `planes` receives the planes that it refers to. */
static geom_line resolve(view_sightlines *s, uint32_t line, geom_plane planes[2]) {
    const view_line *l = s->lines.data + line;
    if (l->kind == VIEW_EDGE)
        return (geom_line){.kind = GEOM_SIGHT_EDGE, .u = view_vertex(s, l->a), .v = view_vertex(s, l->b)};
    if (l->kind == VIEW_STOP) {
        const uint32_t *v = s->surface->vertices + 2 * (size_t)l->a;
        planes[1] = view_plane_at(s, l->c);
        return (geom_line){.kind = GEOM_SIGHT_STOP,
                           .u = view_vertex(s, v[0]),
                           .v = view_vertex(s, v[1]),
                           .a = &planes[1],
                           .axis = (int)l->b};
    }
    scene_support(s->tree->scene, surface_first(s->surface, l->a), &planes[0]);
    const geom_plane cut = tree_plane_at(s->tree, l->b);
    planes[1] = dividing(&planes[0], &cut);
    return (geom_line){.kind = GEOM_SIGHT_CUT, .s = &planes[0], .a = &planes[1]};
}

/* The line through two vertices. */
static filter_vector view_cross(const view_sightlines *s, uint32_t u, uint32_t v) {
    const filter_vector at_u = view_ray(s, u), at_v = view_ray(s, v);
    return filter_cross(&at_u, &at_v);
}

static uint32_t add_sight_line(view_sightlines *s, uint32_t kind, uint32_t a, uint32_t b, uint32_t c) {
    const uint32_t line = (uint32_t)s->lines.count;
    geom_plane planes[2];
    if (line >= INT32_MAX || !array_push(&s->alloc, &s->lines, (view_line){.kind = kind, .a = a, .b = b, .c = c}))
        return FROE_NONE;
    const geom_line exact = resolve(s, line, planes);
    /* The image is from the rays of its ends, if that is fine enough; else by balls; else from exact numbers, which
     * costs as much as one exact decision and spares many: planes that differ by little more than rounding are common
     * in models. */
    filter_vector image = {.e = INFINITY};
    const bool filtered = s->context.first == NUM_FILTER;
    if (filtered && kind == VIEW_EDGE) image = view_cross(s, a, b);
    if (filtered && !filter_is_fine(&image, FINE)) image = geom_line_image(&s->eye, &exact);
    if (filtered && !filter_is_fine(&image, COARSE)) {
        geom_line_round(&s->context, &s->eye, &exact, image.x);
        image.most = 1;
        image.e = 0x1p-52;
    }
    s->lines.data[line].image = image;
    return line;
}

uint32_t view_line_of_edge(view_sightlines *s, uint32_t edge) {
    const uint32_t *v = s->surface->vertices + 2 * (size_t)edge;
    if (!s->of_edge[edge]) s->of_edge[edge] = add_sight_line(s, VIEW_EDGE, v[0], v[1], edge) + 1;
    return s->of_edge[edge] - 1;
}

uint32_t view_line_of_window(view_sightlines *s, uint32_t side) {
    const uint32_t first = s->tree->scene->vertex_count;
    return add_sight_line(s, VIEW_EDGE, first + side, first + (side + 1) % s->window_count, FROE_NONE);
}

uint32_t view_line_across(view_sightlines *s, int axis, uint32_t i) {
    const uint32_t first = s->tree->scene->vertex_count;
    return add_sight_line(s, VIEW_EDGE, first + end_across(s, axis, i, 0), first + end_across(s, axis, i, 1),
                          FROE_NONE);
}

static uint32_t tag_of_cut(uint32_t patch, uint32_t node) {
    return (uint32_t)base_hash(0, patch, node);
}

uint32_t view_line_of_cut(view_sightlines *s, uint32_t patch, uint32_t node) {
    const uint32_t tag = tag_of_cut(patch, node);
    if (!scene_table_reserve(&s->alloc, &s->made, 1)) return FROE_NONE;
    size_t at = scene_table_first(&s->made, tag);
    for (uint32_t id = scene_table_find(&s->made, tag, &at); id != FROE_NONE;
         id = scene_table_find_next(&s->made, tag, &at)) {
        const view_line *l = s->lines.data + id;
        if (l->a == patch && l->b == node) return id;
    }
    const uint32_t line = add_sight_line(s, VIEW_CUT, patch, node, FROE_NONE);
    if (line != FROE_NONE) scene_table_put(&s->made, at, tag, line);
    return line;
}

froe_status view_sightlines_keep(view_sightlines *s, uint32_t *numbers) {
    uint32_t kept = 0, cuts = 0;
    scene_table_free(&s->alloc, &s->made);
    for (size_t i = 0; i < s->lines.count; i++) {
        const view_line l = s->lines.data[i];
        const bool window = l.kind == VIEW_EDGE && l.c == FROE_NONE;
        if (l.kind == VIEW_EDGE && !window) s->of_edge[l.c] = numbers[i] ? kept + 1 : 0;
        if (!numbers[i] && !window) continue;
        cuts += l.kind == VIEW_CUT;
        numbers[i] = kept;
        s->lines.data[kept++] = l;
    }
    s->lines.count = kept;
    array_shrink(&s->alloc, &s->lines);
    if (!scene_table_reserve(&s->alloc, &s->made, cuts)) return FROE_E_MEMORY;
    for (uint32_t i = 0; i < kept; i++) {
        const view_line *l = s->lines.data + i;
        if (l->kind != VIEW_CUT) continue;
        const uint32_t tag = tag_of_cut(l->a, l->b);
        size_t at = scene_table_first(&s->made, tag);
        for (uint32_t id = scene_table_find(&s->made, tag, &at); id != FROE_NONE;)
            id = scene_table_find_next(&s->made, tag, &at);
        scene_table_put(&s->made, at, tag, i);
    }
    return FROE_OK;
}

bool view_is_point(view_sightlines *s, uint32_t edge) {
    const uint32_t *v = s->surface->vertices + 2 * (size_t)edge;
    const filter_vector image = view_cross(s, v[0], v[1]);
    double out[3];
    if (image.most > image.e) return false;
    const geom_line exact = {.kind = GEOM_SIGHT_EDGE, .u = view_vertex(s, v[0]), .v = view_vertex(s, v[1])};
    return !geom_line_round(&s->context, &s->eye, &exact, out);
}

/* The largest component of a key. */
static int axis_of(const double key[3]) {
    return fabs(key[0]) == 1 ? 0 : fabs(key[1]) == 1 ? 1 : 2;
}

bool view_line_key(view_sightlines *s, uint32_t line, double key[3], bool *turned) {
    geom_plane planes[2];
    const geom_line exact = resolve(s, line, planes);
    if (!geom_line_round(&s->context, &s->eye, &exact, key)) return false;
    *turned = key[axis_of(key)] < 0;
    for (int k = 0; k < 3 && *turned; k++) key[k] = -key[k];
    return true;
}

int view_compare_lines(view_sightlines *s, uint32_t a, uint32_t b, const double key[3]) {
    geom_plane planes[4];
    if (a == b) return 0;
    const geom_line x = resolve(s, a, planes), y = resolve(s, b, planes + 2);
    return geom_line_compare(&s->context, &s->eye, &x, &y, axis_of(key));
}

/* An eye that looks along an axis, and not along the cut. */
static geom_eye eye_across(view_sightlines *s, const geom_plane *cut) {
    const froe_scene *scene = s->tree->scene;
    geom_eye eye = {.axis = 0};
    int side = 0;
    for (int k = 0; k < 3 && !side; k++) {
        const double at[3] = {k == 0, k == 1, k == 2};
        eye = geom_eye_make(true, at, scene_vertex(scene, 0));
        side = geom_side_of_eye(&s->context, cut, &eye);
    }
    geom_eye_set_extent(
        &eye, fmax(fmax(scene->hi[0] - scene->lo[0], scene->hi[1] - scene->lo[1]), scene->hi[2] - scene->lo[2]));
    return eye;
}

void view_cut_key(view_sightlines *s, uint32_t line, double key[3]) {
    geom_plane planes[2];
    const geom_line exact = resolve(s, line, planes);
    const geom_plane cut = tree_plane_at(s->tree, s->lines.data[line].b);
    const geom_eye eye = eye_across(s, &cut);
    (void)geom_line_round(&s->context, &eye, &exact, key);
    const bool turned = key[axis_of(key)] < 0;
    for (int k = 0; k < 3 && turned; k++) key[k] = -key[k];
}

int view_compare_cuts(view_sightlines *s, uint32_t a, uint32_t b, const double key[3]) {
    geom_plane planes[4];
    if (a == b) return 0;
    const geom_line x = resolve(s, a, planes), y = resolve(s, b, planes + 2);
    const geom_plane cut = tree_plane_at(s->tree, s->lines.data[a].b);
    const geom_eye eye = eye_across(s, &cut);
    return geom_line_compare(&s->context, &eye, &x, &y, axis_of(key));
}

/* The point X = a(v) r(u) - a(u) r(v) (or its opposite, with a(v) < 0) and the axis e make the line X x e, and
 * l x (X x e) = X (l . e). */
froe_status view_stop_edge(view_sightlines *s, uint32_t edge, uint32_t object, uint32_t line, view_mark *out) {
    const uint32_t v = s->surface->vertices[2 * (size_t)edge + 1];
    const geom_plane plane = view_plane_at(s, object);
    double key[3];
    bool turned;
    (void)view_line_key(s, line, key, &turned);
    const uint32_t stop = add_sight_line(s, VIEW_STOP, edge, (uint32_t)axis_of(key), object);
    const bool behind = geom_side_vertex(&s->context, &plane, view_vertex(s, v)) < 0;
    *out = (view_mark){FROE_NONE, 2 * stop + (turned != behind)};
    return stop == FROE_NONE ? FROE_E_MEMORY : FROE_OK;
}

/* ----------------------------------------------------------------------- sides -- */

static bool has_corner(const froe_scene *scene, uint32_t object, uint32_t vertex) {
    uint32_t i = 0;
    const uint32_t n = scene_corners(scene, object);
    while (i < n && scene_corner(scene, object, i) != vertex) i++;
    return i < n;
}

bool view_cut_has(const view_sightlines *s, uint32_t node, uint32_t vertex) {
    const tree_node *n = s->tree->nodes + node;
    if (n->type == TREE_PLAIN) return scene_vertex(s->tree->scene, vertex)[n->axis] == n->u.value;
    const tree_cut *cut = s->tree->cuts + n->u.cut;
    if (cut->kind == FROE_CUT_OBJECT) return has_corner(s->tree->scene, cut->a, vertex);
    return cut->kind == FROE_CUT_VERTICES && (cut->a == vertex || cut->u.id.b == vertex || cut->u.id.c == vertex);
}

/* Is an object of a patch made of a vertex? Only small patches are searched. */
static bool patch_has_corner(const view_sightlines *s, uint32_t patch, uint32_t vertex) {
    enum { MEMBERS_MOST = 4 };
    const froe_surface *f = s->surface;
    const uint32_t first = f->patch_starts[patch], end = f->patch_starts[patch + 1];
    bool found = false;
    for (uint32_t m = first; m < end && end - first <= MEMBERS_MOST && !found; m++)
        found = has_corner(f->scene, f->members[m], vertex);
    return found;
}

static bool patch_has_edge(const view_sightlines *s, uint32_t patch, uint32_t edge) {
    const froe_surface *f = s->surface;
    bool found = false;
    if (edge >= f->edge_count) return false; /* a wire */
    for (uint32_t i = f->edge_starts[edge]; i < f->edge_starts[edge + 1] && !found; i++)
        found = f->patch_of[f->uses[i]] == patch;
    return found;
}

/* Does a vertex lie on a line by what both are made of? */
static bool line_has_vertex(const view_sightlines *s, const view_line *l, uint32_t vertex) {
    if (l->kind == VIEW_EDGE) return l->a == vertex || l->b == vertex;
    return l->kind == VIEW_CUT && vertex < s->tree->scene->vertex_count && view_cut_has(s, l->b, vertex) &&
           patch_has_corner(s, l->a, vertex);
}

/* A cut stops an edge at one point, which is on the lines of this cut through all patches with the edge. */
static bool cut_has_meeting(const view_sightlines *s, const view_line *cut, uint32_t line, uint32_t across) {
    const view_line *e = s->lines.data + line, *c = s->lines.data + across;
    return cut->kind == VIEW_CUT && e->kind == VIEW_EDGE && c->kind == VIEW_CUT && c->b == cut->b &&
           patch_has_edge(s, cut->a, e->c) && patch_has_edge(s, c->a, e->c);
}

static int known(view_sightlines *s) {
    s->context.stats.calls++;
    return num_by_id(&s->context, 0);
}

int view_side_exactly(view_sightlines *s, uint32_t line, uint32_t vertex, view_way a, view_way b) {
    const view_line *l = s->lines.data + line;
    geom_plane planes[6];
    if (vertex == FROE_NONE && (a >> 1 == line || b >> 1 == line)) return known(s);
    if (vertex != FROE_NONE && line_has_vertex(s, l, vertex)) return known(s);
    if (vertex == FROE_NONE && (cut_has_meeting(s, l, a >> 1, b >> 1) || cut_has_meeting(s, l, b >> 1, a >> 1)))
        return known(s);
    const geom_line h = resolve(s, line, planes);
    if (vertex != FROE_NONE) return geom_line_side_point(&s->context, &s->eye, &h, view_vertex(s, vertex));
    const geom_line first = resolve(s, a >> 1, planes + 2), second = resolve(s, b >> 1, planes + 4);
    const int side = geom_line_side_meeting(&s->context, &s->eye, &h, &first, &second);
    return (a ^ b) & 1 ? -side : side;
}

int view_compare_vertices(view_sightlines *s, uint32_t line, uint32_t u, uint32_t v) {
    if (u == v) return 0;
    const filter_vector through = view_cross(s, u, v);
    const int sure = geom_line_image_side(&s->lines.data[line].image, &through);
    s->context.stats.filtered += sure != NUM_UNSURE;
    if (sure != NUM_UNSURE) return -sure;
    geom_plane planes[2];
    const geom_line h = resolve(s, line, planes);
    return -geom_line_order(&s->context, &s->eye, &h, view_vertex(s, u), view_vertex(s, v));
}

/* ---------------------------------------------------------------------- output -- */

filter_vector view_meeting_round(view_sightlines *s, view_way a, view_way b) {
    geom_plane planes[4];
    const geom_line first = resolve(s, a >> 1, planes), second = resolve(s, b >> 1, planes + 2);
    filter_vector ray = {.most = 1, .e = s->context.first == NUM_FILTER ? 0x1p-52 : INFINITY};
    geom_meeting_round(&s->context, &s->eye, &first, &second, ray.x);
    for (int k = 0; k < 3 && (a ^ b) & 1; k++) ray.x[k] = -ray.x[k];
    return ray;
}

double view_share_round(view_sightlines *s, uint32_t line, uint32_t u, uint32_t v) {
    geom_plane planes[2];
    const geom_line h = resolve(s, line, planes);
    return geom_share_round(&s->context, &s->eye, &h, view_vertex(s, u), view_vertex(s, v));
}

/* By exact multiplications. The normal has overflowed where its points are further from one another than 2^500; what is
 * not a number is not seen in n_max. */
static geom_plane with_short_normal(geom_plane plane) {
    int exponent;
    if (plane.form == GEOM_POINTS && !(fabs(plane.n[0]) + fabs(plane.n[1]) + fabs(plane.n[2]) < INFINITY)) {
        double d[3], e[3];
        for (int k = 0; k < 3; k++) {
            d[k] = ldexp(plane.p[1][k], -600) - ldexp(plane.p[0][k], -600);
            e[k] = ldexp(plane.p[2][k], -600) - ldexp(plane.p[0][k], -600);
        }
        const filter_vector p = filter_exact(d), q = filter_exact(e), n = filter_cross(&p, &q);
        memcpy(plane.n, n.x, sizeof plane.n);
        plane.n_max = n.most;
    }
    frexp(plane.n_max, &exponent);
    for (int k = 0; k < 3; k++) plane.n[k] = ldexp(plane.n[k], -exponent);
    plane.n_max = ldexp(plane.n_max, -exponent);
    plane.c = ldexp(plane.c, -exponent);
    return plane;
}

geom_plane view_support(const froe_scene *scene, uint32_t object) {
    geom_plane plane;
    scene_support(scene, object, &plane);
    return with_short_normal(plane);
}

geom_plane view_plane_of(const view_sightlines *s, uint32_t patch) {
    return view_support(s->tree->scene, surface_first(s->surface, patch));
}

geom_plane view_plane_of_cut(const view_sightlines *s, uint32_t node) {
    return with_short_normal(tree_plane_at(s->tree, node));
}

/* x = e - t r, or for a parallel eye x = y + t d with y the point of the ray in the plane w_k = 0. */
static void sight_of(const view_sightlines *s, const double ray[3], double start[3], double way[3]) {
    const geom_eye *eye = &s->eye;
    for (int k = 0; k < 3; k++) {
        start[k] = eye->parallel ? eye->origin[k] : eye->at[k];
        way[k] = eye->parallel ? eye->at[k] : -ray[k];
    }
    for (int c = 0; c < 2 && eye->parallel; c++) start[(eye->axis + 1 + c) % 3] += ray[c] / ray[2] * eye->size;
}

/* How steeply a plane, of which the normal is about 1 long, meets a ray: n . r. *sure: that is more than rounding. */
static double slope_of(const geom_plane *plane, const double way[3], bool *sure) {
    double slope = 0, most = 0;
    for (int k = 0; k < 3; k++) {
        slope += plane->n[k] * way[k];
        most += fabs(plane->n[k] * way[k]);
    }
    *sure = fabs(slope) > 0x1p-50 * most;
    return slope;
}

/* The point is start + out. */
static void walk_to(const view_sightlines *s, const geom_plane *plane, const double ray[3], double start[3],
                    double out[3]) {
    const bool has_points = plane->form == GEOM_POINTS || plane->form == GEOM_VERTICAL;
    double way[3], at = has_points ? 0 : -plane->c, back = 0, square = 0, most = 0;
    bool sure;
    sight_of(s, ray, start, way);
    const double slope = slope_of(plane, way, &sure);
    for (int k = 0; k < 3; k++) at += plane->n[k] * (start[k] - (has_points ? plane->p[0][k] : 0));
    double t = at / slope;
    for (int k = 0; k < 3 && !sure; k++) most = fmax(most, fabs(way[k]));
    for (int k = 0; k < 3 && !sure;
         k++) { /* seen all but edge-on: the point of the ray that is nearest to the plane's */
        back += way[k] / most * (start[k] - (has_points ? plane->p[0][k] : start[k]));
        square += way[k] / most * (way[k] / most);
    }
    if (!sure) t = back / square / most;
    for (int k = 0; k < 3; k++) out[k] = -(way[k] * t);
}

void view_point_on(const view_sightlines *s, const geom_plane *plane, const double ray[3], double out[3]) {
    double start[3], way[3];
    walk_to(s, plane, ray, start, way);
    for (int k = 0; k < 3; k++) out[k] = start[k] + way[k];
}

void view_way_on(const view_sightlines *s, const geom_plane *plane, const double ray[3], double out[3]) {
    double start[3];
    walk_to(s, plane, ray, start, out);
}

void view_point_on_both(const view_sightlines *s, const geom_plane *a, const geom_plane *b, const double ray[3],
                        double out[3]) {
    double start[3], way[3];
    bool sure;
    sight_of(s, ray, start, way);
    const double steep_a = fabs(slope_of(a, way, &sure)), steep_b = fabs(slope_of(b, way, &sure));
    view_point_on(s, 16 * steep_a >= steep_b ? a : b, ray, out);
}
