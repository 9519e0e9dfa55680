/* participants.c: the segments that take part in an event. */
#include "kinetic/event/participants.h"
#include "kinetic/kinetic.h"
#include <math.h>

enum { MANY = 48 }; /* with more participants, their crossings are not computed pair by pair */

void participants_clear(participants_table *all) {
    all->stamp++;
    all->list.count = 0;
    all->places.count = 0;
    all->pair = false;
}

bool participants_have(const participants_table *all, uint32_t segment) {
    return segment != FROE_NONE && all->stamps.data[segment] == all->stamp;
}

static void add_segment(participants_table *all, uint32_t segment) {
    if (participants_have(all, segment)) return;
    all->stamps.data[segment] = all->stamp;
    call_push(all->call, &all->list, segment);
}

/* ------------------------------------------------------------------ places -- */

static double speed_of(now_state *now, uint32_t segment) {
    const uint32_t *end = now->segments.data[segment].end;
    double a = now_speed(now, end[0]), b = now_speed(now, end[1]);
    return a > b ? a : b;
}

/* The change in y along a segment where x changes by dx, at most. */
static double rise(now_state *now, uint32_t segment, double dx) {
    const uint32_t *end = now->segments.data[segment].end;
    now_spot a = now_vertex_spot(now, end[0]), b = now_vertex_spot(now, end[1]);
    double width = fabs(b.x - a.x), height = fabs(b.y - a.y), rises = dx * (height / width);
    return rises < height ? rises : height; /* NaN, too */
}

static inline void enlarge(participants_place *place, now_spot spot, const double error[2]) {
    place->low[0] = place->high[0] = spot.x, place->low[1] = place->high[1] = spot.y;
    for (int i = 0; i < 2; i++) {
        const double e = (error[i] + fabs(place->low[i]) * 0x1p-50) * 2;
        place->low[i] -= e, place->high[i] += e;
    }
}

static inline participants_place place_of_spot(now_spot spot, double speed) {
    participants_place out = {.speed = speed};
    enlarge(&out, spot, (double[]){spot.error, spot.error});
    return out;
}

static participants_place place_of_vertex(now_state *now, uint32_t vertex) {
    double speed;
    const now_spot spot = now_vertex_flight(now, vertex, &speed);
    return place_of_spot(spot, speed);
}

/* A box around p. Around a crossing it reaches along the lines as far as x, where the other point is. */
static participants_place place_of_name(now_state *now, name_point p, double x) {
    if (name_is_vertex(p)) return place_of_vertex(now, p.a);
    const now_spot spot = now_spot_of(now, p);
    const double s = speed_of(now, p.a), t = speed_of(now, (uint32_t)p.b), dx = fabs(x - spot.x) + spot.error;
    const double up = rise(now, p.a, dx), over = rise(now, (uint32_t)p.b, dx);
    participants_place out = {.speed = s > t ? s : t};
    enlarge(&out, spot, (double[]){spot.error + dx, spot.error + (up < over ? up : over)});
    return out;
}

/* Twice the distance by which points of these speeds approach each other in two ticks. */
static double margin(double speed, double other) {
    return 4 * (speed + other);
}

static inline bool places_meet(const participants_place *a, const participants_place *b) {
    double far = margin(a->speed, b->speed);
    for (int i = 0; i < 2; i++)
        if (a->low[i] > b->high[i] + far || b->low[i] > a->high[i] + far) return false;
    return true; /* NaN, too */
}

/* -------------------------------------------------------------------- near -- */

typedef participants_line line;

static inline line line_of_segment(now_state *now, uint32_t segment) {
    const uint32_t *end = now->segments.data[segment].end;
    line s;
    for (int i = 0; i < 2; i++) s.spot[i] = now_vertex_flight(now, end[i], s.speeds + i);
    s.error = s.spot[0].error > s.spot[1].error ? s.spot[0].error : s.spot[1].error;
    s.speed = s.speeds[0] > s.speeds[1] ? s.speeds[0] : s.speeds[1];
    return s;
}

/* Is it beside a range in one coordinate? */
static inline bool is_beside(double a, double b, const participants_place *place, int i, double slack) {
    return (a < b ? b : a) < place->low[i] - slack || (a < b ? a : b) > place->high[i] + slack;
}

/* May a segment meet a place, enlarged on all sides by what both move? Most are far above or below. */
static inline bool comes_near(const line *s, const participants_place *place) {
    const now_spot a = s->spot[0], b = s->spot[1];
    double far = margin(place->speed, s->speed);
    far += 2 * s->error;
    const double up = far + (fabs(a.y) + fabs(b.y)) * 0x1p-50;
    if (is_beside(a.y, b.y, place, 1, up)) return false;
    const double over = far + (fabs(a.x) + fabs(b.x)) * 0x1p-50;
    if (is_beside(a.x, b.x, place, 0, over)) return false;
    const double half[2] = {0.5 * place->high[0] - 0.5 * place->low[0] + over,
                            0.5 * place->high[1] - 0.5 * place->low[1] + up};
    const double d[2] = {b.x - a.x, b.y - a.y};
    const double u = 0.5 * place->low[0] + 0.5 * place->high[0] - a.x;
    const double v = 0.5 * place->low[1] + 0.5 * place->high[1] - a.y;
    double reach = fabs(d[0]) * half[1] + fabs(d[1]) * half[0];
    double off = fabs(d[0] * v - d[1] * u), slack = (fabs(d[0] * v) + fabs(d[1] * u)) * 0x1p-48;
    return !(off > reach * (1 + 0x1p-40) + slack);
}

static void add_if_near(froe_kinetic *k, uint32_t segment) {
    participants_table *all = &k->participants;
    if (segment == FROE_NONE || participants_have(all, segment)) return;
    const line s = line_of_segment(&k->now, segment);
    for (size_t i = 0; i < all->places.count; i++) {
        if (!comes_near(&s, all->places.data + i)) continue;
        add_segment(all, segment);
        return;
    }
}

bool participants_add_near(froe_kinetic *k, const uint32_t *segments, size_t count) {
    const size_t before = k->participants.list.count;
    for (size_t i = 0; i < count; i++) {
        const bool surface = segments[i] != FROE_NONE && now_is_surface(&k->now, segments[i]);
        const uint32_t *edge = surface ? now_face_of(&k->now, segments[i])->edge : segments + i;
        for (int j = 0; j < (surface ? 3 : 1); j++) add_if_near(k, edge[j]);
    }
    return k->participants.list.count > before;
}

/* ------------------------------------------------------------------- apart -- */

/* Is the other end of a segment, as good as, above or below a place at which it ends? */
static bool is_upright(const line *s, const participants_place *place) {
    const double width = fabs(s->spot[1].x - s->spot[0].x);
    return !(width > margin(s->speed, place->speed) + 2 * s->error + (place->high[0] - place->low[0]));
}

/* Do the points of a certificate lie in different places, and do the segments of each keep away from the other? Those
 * of both may meet in between if they are upright. */
static bool are_apart(ktree *tree, const name_point name[2], const participants_place place[2]) {
    bool upright[2] = {false, false};
    if (places_meet(place, place + 1)) return false;
    for (int i = 0; i < 2; i++) {
        const participants_place *other = place + (1 - i);
        uint32_t e = name_is_vertex(name[i]) ? tree->vertices.data[name[i].a] : FROE_NONE;
        for (; e != FROE_NONE; e = ktree_next_end(tree, e)) {
            const line s = line_of_segment(tree->now, e / 2);
            if (comes_near(&s, other)) return false;
            upright[i] = upright[i] || is_upright(&s, place + i);
        }
        for (int j = 0; j < 2 && name_is_crossing(name[i]); j++) {
            const line s = line_of_segment(tree->now, j ? (uint32_t)name[i].b : name[i].a);
            if (comes_near(&s, other)) return false;
            upright[i] = upright[i] || is_upright(&s, place + i);
        }
    }
    return !upright[0] || !upright[1];
}

static void add_segments_at(froe_kinetic *k, uint32_t vertex) {
    for (uint32_t e = k->tree.vertices.data[vertex]; e != FROE_NONE; e = ktree_next_end(&k->tree, e))
        if (ktree_segment_at(&k->tree, e / 2)->here) add_segment(&k->participants, e / 2);
}

/* A triangle that turns over happens at its corners, and all along its edges. */
static void add_flop(froe_kinetic *k, uint32_t surface) {
    for (int i = 0; i < 3; i++) {
        const uint32_t vertex = now_face_of(&k->now, surface)->vertex[i];
        add_segments_at(k, vertex);
        call_push(&k->call, &k->participants.places, place_of_vertex(&k->now, vertex));
    }
}

/* ------------------------------------------------------------------- pairs -- */

/* Where two vertices pass that belong to a segment each, as almost always, each end is looked at once. False: it is not
 * so. */
static bool add_pair(froe_kinetic *k, const slab_item *item) {
    participants_table *all = &k->participants;
    const ktree *tree = &k->tree;
    const uint32_t end[2] = {tree->vertices.data[item->claim.p.a], tree->vertices.data[item->claim.q.a]};
    for (int i = 0; i < 2; i++)
        if (end[i] == FROE_NONE || ktree_next_end(tree, end[i]) != FROE_NONE ||
            !ktree_segment_at(tree, end[i] / 2)->here)
            return false;
    if (!call_reserve(&k->call, &all->places, 2)) return false;
    for (int i = 0; i < 2; i++) {
        const uint32_t which = all->which[i] = end[i] % 2;
        line *s = all->line + i;
        add_segment(all, end[i] / 2);
        *s = line_of_segment(&k->now, end[i] / 2);
        all->places.data[i] = place_of_spot(s->spot[which], s->speeds[which]);
    }
    all->places.count = 2;
    return all->pair = true;
}

static bool is_pair_apart(const participants_table *all) {
    const participants_place *place = all->places.data;
    return !places_meet(place, place + 1) && !comes_near(all->line, place + 1) && !comes_near(all->line + 1, place) &&
           !(is_upright(all->line, place) && is_upright(all->line + 1, place + 1));
}

static bool has_pair_loose_ends(const participants_table *all) {
    const participants_place *place = all->places.data;
    for (int i = 0; i < 2; i++) {
        const uint32_t other = 1 - all->which[i];
        const participants_place at = place_of_spot(all->line[i].spot[other], all->line[i].speeds[other]);
        if (places_meet(&at, place) || places_meet(&at, place + 1)) return true;
    }
    return false;
}

/* ------------------------------------------------------------------- items -- */

bool participants_add_item(froe_kinetic *k, const slab_item *item) {
    participants_table *all = &k->participants;
    if (item->event == FROE_EVENT_VERTICES && !all->places.count && add_pair(k, item)) return is_pair_apart(all);
    if (item->kind == CERT_FLOP) {
        add_flop(k, item->cert);
        return false;
    }
    const name_point name[2] = {item->claim.p, item->claim.q};
    participants_place place[2];
    if (item->kind == CERT_TURN) add_segment(all, item->cert);
    for (int i = 0; i < 2; i++) {
        const name_point p = name[i];
        if (p.b == NAME_SEGMENT || name_is_crossing(p)) add_segment(all, p.a);
        if (name_is_crossing(p)) add_segment(all, (uint32_t)p.b);
        if (name_is_vertex(p)) add_segments_at(k, p.a);
        if (p.b == NAME_SEGMENT) continue;
        const name_point other = name[1 - i].b == NAME_SEGMENT ? p : name[1 - i];
        place[i] = place_of_name(&k->now, p, now_spot_of(&k->now, other).x);
        call_push(&k->call, &all->places, place[i]);
    }
    return slab_is_one_place(item) || are_apart(&k->tree, name, place);
}

bool participants_have_loose_ends(froe_kinetic *k, const slab_item *item) {
    const participants_table *all = &k->participants;
    name_point p = item->claim.p, q = item->claim.q;
    if (all->pair && all->list.count == 2) return has_pair_loose_ends(all);
    for (size_t i = 0; i < 2 * all->list.count; i++) {
        const uint32_t vertex = k->now.segments.data[all->list.data[i / 2]].end[i % 2];
        if ((name_is_vertex(p) && p.a == vertex) || (name_is_vertex(q) && q.a == vertex)) continue;
        const participants_place at = place_of_vertex(&k->now, vertex);
        for (size_t j = 0; j < all->places.count; j++)
            if (places_meet(&at, all->places.data + j)) return true;
    }
    return false;
}

/* ------------------------------------------------------------------- reach -- */

/* The part of s that is near the line of t, as shares of the way along s. False: there is none. */
static bool near_line(const line *s, const line *t, double far, double share[2]) {
    double d[2] = {t->spot[1].x - t->spot[0].x, t->spot[1].y - t->spot[0].y}, off[2], slack = 0;
    for (int e = 0; e < 2; e++) {
        double u = s->spot[e].x - t->spot[0].x, v = s->spot[e].y - t->spot[0].y;
        off[e] = d[0] * v - d[1] * u;
        slack += (fabs(d[0] * v) + fabs(d[1] * u)) * 0x1p-48;
    }
    double width = (fabs(d[0]) + fabs(d[1])) * far + slack, slope = off[1] - off[0];
    share[0] = 0, share[1] = 1;
    if (fabs(slope) > 0) {
        double a = (-width - off[0]) / slope, b = (width - off[0]) / slope;
        share[0] = fmax(0, fmin(a, b) - 0x1p-40), share[1] = fmin(1, fmax(a, b) + 0x1p-40);
    } else if (fabs(off[0]) > width) {
        return false;
    }
    return share[0] <= share[1];
}

/* Includes the present crossing and all of the part where the segments are so near that it may have been there. */
void participants_reach_pair(now_state *now, double slab[2], uint32_t s, uint32_t t) {
    const line a = line_of_segment(now, s), b = line_of_segment(now, t);
    double share[2], far = margin(a.speed, b.speed) + 2 * (a.error + b.error);
    if (!near_line(&b, &a, far, share) || !near_line(&a, &b, far, share)) return;
    double x[2] = {a.spot[0].x + share[0] * (a.spot[1].x - a.spot[0].x),
                   a.spot[0].x + share[1] * (a.spot[1].x - a.spot[0].x)};
    double slack = far + (fabs(x[0]) + fabs(x[1])) * 0x1p-40;
    double low = fmax(fmin(x[0], x[1]), fmin(b.spot[0].x, b.spot[1].x)) - slack;
    double high = fmin(fmax(x[0], x[1]), fmax(b.spot[0].x, b.spot[1].x)) + slack;
    if (low > high) return;
    slab[0] = fmin(slab[0], low), slab[1] = fmax(slab[1], high);
    slab_reach(now, slab, name_crossing(s, t));
}

/* Widens the slab by an end if it is near a place. */
static void reach_end(froe_kinetic *k, uint32_t vertex, double slab[2]) {
    const participants_table *all = &k->participants;
    now_spot s = now_vertex_spot(&k->now, vertex);
    double far = margin(now_speed(&k->now, vertex), 0) + s.error;
    for (size_t i = 0; i < all->places.count; i++) {
        const participants_place *p = all->places.data + i;
        double f = far + margin(p->speed, 0);
        if (s.x < p->low[0] - f || s.x > p->high[0] + f || s.y < p->low[1] - f || s.y > p->high[1] + f) continue;
        slab_reach(&k->now, slab, (name_point){vertex, NAME_VERTEX});
        return;
    }
}

void participants_reach(froe_kinetic *k, double slab[2]) {
    const participants_table *all = &k->participants;
    for (size_t i = 0; i < all->list.count; i++) {
        const uint32_t s = all->list.data[i];
        for (int e = 0; e < 2; e++) {
            const uint32_t vertex = k->now.segments.data[s].end[e];
            if (all->list.count > MANY)
                slab_reach(&k->now, slab, (name_point){vertex, NAME_VERTEX});
            else
                reach_end(k, vertex, slab);
        }
        for (size_t j = 0; j < i && all->list.count <= MANY; j++)
            participants_reach_pair(&k->now, slab, s, all->list.data[j]);
    }
}
