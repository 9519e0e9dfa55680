/* shape.c: objects and pieces in the plane of a view. In a section, solids become
 * what the plane cuts out of them: of a polygon a line, of a box a rectangle, of a
 * hull the hull of the crossings of all its chords. */
#include "shape.h"
#include <math.h>
#include <stdlib.h>

static bool append(draw_shaper *s, const double *x) {
    if (!array_reserve(&s->alloc, &s->solid, 3)) return false;
    draw_space_point(&s->view->space, x, s->solid.data + s->solid.count);
    s->solid.count += 3;
    return true;
}

bool draw_corners_of_object(draw_shaper *s, uint32_t object) {
    uint32_t corners = froe_scene_object(s->scene, object).corners;
    s->solid.count = 0;
    for (uint32_t i = 0; i < corners; i++)
        if (!append(s, froe_scene_vertex(s->scene, froe_scene_corner(s->scene, object, i)))) return false;
    return true;
}

bool draw_corners_of_piece(draw_shaper *s, size_t piece) {
    size_t corners = froe_tree_piece(s->tree, piece).corners, dim = (size_t)s->view->space.dim;
    s->raw.count = s->made.count = s->solid.count = 0;
    if (!array_reserve(&s->alloc, &s->raw, corners * dim) || !array_reserve(&s->alloc, &s->made, corners)) return false;
    froe_tree_piece_corners(s->tree, piece, s->raw.data, s->made.data, corners);
    s->made.count = corners;
    for (size_t i = 0; i < corners; i++)
        if (!append(s, s->raw.data + i * dim)) return false;
    return true;
}

static size_t corner_count(const draw_shaper *s) {
    return s->solid.count / 3;
}

static draw_point flat(const draw_shaper *s, size_t corner) {
    const double *p = s->solid.data + 3 * corner;
    return (draw_point){p[s->view->across], p[s->view->up]};
}

/* Height of a corner over the section plane. */
static double over(const draw_shaper *s, size_t corner) {
    return s->view->axis < 0 ? 0 : s->solid.data[3 * corner + (size_t)s->view->axis] - s->view->at;
}

static draw_point shape_crossing(const draw_shaper *s, size_t i, size_t j) {
    draw_point p = flat(s, i), q = flat(s, j);
    double t = over(s, i) / (over(s, i) - over(s, j));
    return (draw_point){p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
}

static int by_x_then_y(const void *a, const void *b) {
    const draw_point *p = a, *q = b;
    if (p->x != q->x) return p->x < q->x ? -1 : 1;
    return (p->y > q->y) - (p->y < q->y);
}

/* Andrew's monotone chain. */
size_t draw_hull(draw_point *points, draw_point *spare, size_t count) {
    if (count < 3) return count;
    qsort(points, count, sizeof *points, by_x_then_y);
    size_t made = 0;
    for (int chain = 0; chain < 2; chain++) {
        size_t base = made;
        for (size_t k = 0; k < count; k++) {
            draw_point p = points[chain ? count - 1 - k : k];
            while (made >= base + 2) {
                draw_point a = spare[made - 2], b = spare[made - 1];
                if ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0) break;
                made--;
            }
            spare[made++] = p;
        }
        made--;
    }
    for (size_t i = 0; i < made; i++) points[i] = spare[i];
    return made;
}

static bool add_shape_point(draw_shaper *s, draw_point p) {
    return array_push(&s->alloc, &s->points, p);
}

static bool room(draw_shaper *s) {
    s->spare.count = 0;
    return array_reserve(&s->alloc, &s->points, 5) && array_reserve(&s->alloc, &s->spare, s->points.count + 5);
}

/* Points in the view become a shape on the page. */
static bool finish(draw_shaper *s, draw_shape *out) {
    draw_point *p = s->points.data;
    if (s->points.count == 2 && p[0].x == p[1].x && p[0].y == p[1].y) s->points.count = 1;
    if (!room(s)) return false;
    p = s->points.data;
    size_t count = s->points.count;
    const draw_view *v = s->view;
    if (count == 1 && !(p->x >= v->lo.x && p->x <= v->hi.x && p->y >= v->lo.y && p->y <= v->hi.y)) count = 0;
    if (count == 2) {
        draw_point a = p[0], b = p[1];
        if (!draw_view_clip_line(v, p, p + 1)) count = 0;
        out->cut[0] = out->cut[0] && a.x == p[0].x && a.y == p[0].y;
        out->cut[1] = out->cut[1] && b.x == p[1].x && b.y == p[1].y;
    }
    if (count > 2) {
        count = draw_view_clip_ring(v, p, s->spare.data, count);
        if (count < 3) count = 0;
    }
    for (size_t i = 0; i < count; i++) p[i] = draw_view_map(v, p[i]);
    out->points = p;
    out->count = count;
    out->sort = count == 0 ? DRAW_NOTHING : count == 1 ? DRAW_DOT : count == 2 ? DRAW_STROKE : DRAW_RING;
    return true;
}

/* A point, segment or planar polygon. Of a cut polygon two crossings are left; a
 * polygon that merely touches the plane with a corner leaves nothing. */
static bool plane_figure(draw_shaper *s, bool pieces, draw_shape *out) {
    size_t count = corner_count(s), flat_corners = 0;
    for (size_t i = 0; i < count; i++) flat_corners += over(s, i) == 0;
    for (size_t i = 0; i < count; i++) {
        size_t j = i + 1 < count ? i + 1 : 0;
        double a = over(s, i), b = over(s, j);
        bool on = a == 0, across = (a < 0 && b > 0) || (a > 0 && b < 0);
        if ((!on && !across) || (count == 2 && i == 1 && across)) continue;
        bool cut = pieces && (s->made.data[i].id1 || (on && count > 2 && s->made.data[i ? i - 1 : count - 1].id1));
        if (s->points.count < 2) out->cut[s->points.count] = cut;
        if (!add_shape_point(s, on ? flat(s, i) : shape_crossing(s, i, j))) return false;
    }
    if (count > 2 && s->points.count < 2) s->points.count = 0;
    if (flat_corners < count && s->points.count > 2) { /* several corners on one line: its ends */
        qsort(s->points.data, s->points.count, sizeof *s->points.data, by_x_then_y);
        s->points.data[1] = s->points.data[s->points.count - 1];
        s->points.count = 2;
    }
    return finish(s, out);
}

static bool ball(draw_shaper *s, double raw_radius, draw_shape *out) {
    const draw_space *space = &s->view->space;
    double r = ldexp(raw_radius, space->shift) / space->half, h = over(s, 0);
    if (!(r < 1e100)) r = 1e100;
    if (fabs(h) > r) return true;
    r = sqrt((r - h) * (r + h));
    draw_point c = flat(s, 0), lo = s->view->lo, hi = s->view->hi;
    if (c.x + r < lo.x || c.x - r > hi.x || c.y + r < lo.y || c.y - r > hi.y) return true;
    if (r == 0) return add_shape_point(s, c) && finish(s, out);
    if (r > 64 * (hi.x - lo.x + hi.y - lo.y)) { /* too large for the page's curves: a ring, by halving arcs */
        enum { CORNERS = 128 };
        draw_point p[CORNERS] = {{1, 0}};
        p[CORNERS / 4] = (draw_point){0, 1};
        p[CORNERS / 2] = (draw_point){-1, 0};
        p[3 * CORNERS / 4] = (draw_point){0, -1};
        for (int step = CORNERS / 8; step; step /= 2)
            for (int i = step; i < CORNERS; i += 2 * step) {
                draw_point a = p[i - step], b = p[(i + step) % CORNERS], m = {a.x + b.x, a.y + b.y};
                double length = sqrt(m.x * m.x + m.y * m.y);
                p[i] = (draw_point){m.x / length, m.y / length};
            }
        for (int i = 0; i < CORNERS; i++)
            if (!add_shape_point(s, (draw_point){c.x + r * p[i].x, c.y + r * p[i].y})) return false;
        return finish(s, out);
    }
    if (!add_shape_point(s, draw_view_map(s->view, c))) return false;
    *out = (draw_shape){.sort = DRAW_DISC, .points = s->points.data, .count = 1};
    out->half = (draw_point){r * s->view->scale * space->squeeze, r * s->view->scale};
    return true;
}

bool draw_shape_of_object(draw_shaper *s, uint32_t object, draw_shape *out) {
    froe_object o = froe_scene_object(s->scene, object);
    *out = (draw_shape){.sort = DRAW_NOTHING};
    s->points.count = 0;
    if (!draw_corners_of_object(s, object)) return false;
    if (o.form == FROE_BALL) return ball(s, o.radius, out);
    if (o.form != FROE_BOX && o.form != FROE_HULL) return plane_figure(s, false, out);
    if (o.form == FROE_HULL) {
        const size_t count = corner_count(s);
        for (size_t i = 0; i < count; i++) {
            const double at = over(s, i);
            if (at == 0 && !add_shape_point(s, flat(s, i))) return false;
            for (size_t j = i + 1; at != 0 && j < count; j++)
                if (((at < 0 && over(s, j) > 0) || (at > 0 && over(s, j) < 0)) &&
                    !add_shape_point(s, shape_crossing(s, i, j)))
                    return false;
        }
        if (!room(s)) return false;
        s->points.count = draw_hull(s->points.data, s->spare.data, s->points.count);
        return finish(s, out);
    }
    const double a = over(s, 0), b = over(s, 1);
    if (fmin(a, b) > 0 || fmax(a, b) < 0) return true;
    draw_point p = flat(s, 0), q = flat(s, 1);
    draw_point lo = {fmin(p.x, q.x), fmin(p.y, q.y)}, hi = {fmax(p.x, q.x), fmax(p.y, q.y)};
    bool thin = lo.x == hi.x || lo.y == hi.y;
    bool ok = add_shape_point(s, lo) && (thin || add_shape_point(s, (draw_point){hi.x, lo.y})) &&
              add_shape_point(s, hi) && (thin || add_shape_point(s, (draw_point){lo.x, hi.y}));
    return ok && finish(s, out);
}

bool draw_shape_of_piece(draw_shaper *s, size_t piece, draw_shape *out) {
    froe_piece p = froe_tree_piece(s->tree, piece);
    if (p.whole) return draw_shape_of_object(s, p.object, out);
    *out = (draw_shape){.sort = DRAW_NOTHING};
    s->points.count = 0;
    return draw_corners_of_piece(s, piece) && plane_figure(s, true, out);
}

void draw_shaper_free(draw_shaper *s) {
    array_free(&s->alloc, &s->raw);
    array_free(&s->alloc, &s->made);
    array_free(&s->alloc, &s->solid);
    array_free(&s->alloc, &s->points);
    array_free(&s->alloc, &s->spare);
}
