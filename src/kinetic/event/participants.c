/* participants.c: finds the segments that take part in an event.
 *
 *        \ |            The participants of an event are first the segments that its certificates name. Neighbours may
 *     ----\o====        be at the same place without walls and certificates of their own, because their vertices lie
 *         |\  d         on the walls of others or ride on segments. Every segment that comes within a margin of the
 *         | b           place is added to the participants. The margin is more than anything there moves in two ticks,
 * which is the time since all certificates held. The event lies between those ends and crossings of the participants
 * that are near. Doubles suffice, since the set of participants may be too large, but not too small. */
#include "kinetic/live.h"
#include <math.h>

enum { MANY = 48 }; /* with more participants, their crossings are not computed pair by pair */

void live_new_crew(froe_kinetic *k) {
    k->crew_stamp++;
    k->crew.count = 0;
    k->places.count = 0;
}

bool live_in_crew(const froe_kinetic *k, uint32_t segment) {
    return segment != FROE_NONE && segment_at(k, segment)->crew == k->crew_stamp;
}

void live_join_crew(froe_kinetic *k, uint32_t segment) {
    if (live_in_crew(k, segment)) return;
    segment_at(k, segment)->crew = k->crew_stamp;
    if (!array_push(&k->alloc, &k->crew, segment)) k->short_of_memory = true;
}

static void join_by_name(froe_kinetic *k, now_name p) {
    if (p.b == NAME_SEGMENT || name_is_crossing(p)) live_join_crew(k, p.a);
    if (name_is_crossing(p)) live_join_crew(k, (uint32_t)p.b);
    if (!name_is_vertex(p)) return;
    for (uint32_t e = k->vertices.data[p.a]; e != FROE_NONE; e = segment_at(k, e / 2)->end[e % 2].next)
        if (segment_at(k, e / 2)->here) live_join_crew(k, e / 2);
}

/* ------------------------------------------------------------------ places -- */

static double speed_of(froe_kinetic *k, uint32_t segment) {
    const uint32_t *end = k->now.segments.data[segment].end;
    double a = now_speed(&k->now, end[0]), b = now_speed(&k->now, end[1]);
    return a > b ? a : b;
}

/* The change in y along a segment where x changes by dx, at most. */
static double rise(froe_kinetic *k, uint32_t segment, double dx) {
    const uint32_t *end = k->now.segments.data[segment].end;
    now_spot a = now_spot_of(&k->now, (now_name){end[0], NAME_VERTEX});
    now_spot b = now_spot_of(&k->now, (now_name){end[1], NAME_VERTEX});
    double width = fabs(b.x - a.x), height = fabs(b.y - a.y), rises = dx * (height / width);
    return rises < height ? rises : height; /* NaN, too */
}

/* A box around p. Around a crossing it reaches along the lines as far as x, where the other point is. */
static live_place place_of_name(froe_kinetic *k, now_name p, double x) {
    now_spot spot = now_spot_of(&k->now, p);
    live_place out = {{spot.x, spot.y}, {spot.x, spot.y}, 0};
    double error[2] = {spot.error, spot.error};
    if (name_is_vertex(p)) {
        out.speed = now_speed(&k->now, p.a);
    } else {
        double s = speed_of(k, p.a), t = speed_of(k, (uint32_t)p.b), dx = fabs(x - spot.x) + spot.error;
        double up = rise(k, p.a, dx), over = rise(k, (uint32_t)p.b, dx);
        out.speed = s > t ? s : t;
        error[0] += dx;
        error[1] += up < over ? up : over;
    }
    for (int i = 0; i < 2; i++) {
        double e = (error[i] + fabs(out.low[i]) * 0x1p-50) * 2;
        out.low[i] -= e;
        out.high[i] += e;
    }
    return out;
}

/* Twice the distance by which points of these speeds approach each other in two ticks. */
static double margin(double speed, double other) {
    return 4 * (speed + other);
}

static bool places_meet(const live_place *a, const live_place *b) {
    double far = margin(a->speed, b->speed);
    for (int i = 0; i < 2; i++)
        if (a->low[i] > b->high[i] + far || b->low[i] > a->high[i] + far) return false;
    return true; /* NaN, too */
}

/* -------------------------------------------------------------------- near -- */

typedef struct line {
    double at[2][2], error, speed;
} line;

static line line_of_segment(froe_kinetic *k, uint32_t segment) {
    const uint32_t *end = k->now.segments.data[segment].end;
    line out = {.error = 0, .speed = speed_of(k, segment)};
    for (int i = 0; i < 2; i++) {
        now_spot s = now_spot_of(&k->now, (now_name){end[i], NAME_VERTEX});
        out.at[i][0] = s.x, out.at[i][1] = s.y;
        out.error = s.error > out.error ? s.error : out.error;
    }
    return out;
}

/* May a segment meet the box when it is enlarged by `far` on all sides? */
static bool line_meets(const line *s, const double low[2], const double high[2], double far) {
    double centre[2], half[2], d[2];
    far += 2 * s->error;
    for (int i = 0; i < 2; i++) {
        double a = s->at[0][i], b = s->at[1][i], slack = far + (fabs(a) + fabs(b)) * 0x1p-50;
        if ((a < b ? b : a) < low[i] - slack || (a < b ? a : b) > high[i] + slack) return false;
        centre[i] = 0.5 * low[i] + 0.5 * high[i];
        half[i] = 0.5 * high[i] - 0.5 * low[i] + slack;
        d[i] = b - a;
    }
    double u = centre[0] - s->at[0][0], v = centre[1] - s->at[0][1];
    double reach = fabs(d[0]) * half[1] + fabs(d[1]) * half[0];
    double off = fabs(d[0] * v - d[1] * u), slack = (fabs(d[0] * v) + fabs(d[1] * u)) * 0x1p-48;
    return !(off > reach * (1 + 0x1p-40) + slack);
}

static bool is_near_place(const line *s, const live_place *place) {
    return line_meets(s, place->low, place->high, margin(place->speed, s->speed));
}

static bool is_near(froe_kinetic *k, uint32_t segment) {
    const line s = line_of_segment(k, segment);
    for (size_t i = 0; i < k->places.count; i++)
        if (is_near_place(&s, k->places.data + i)) return true;
    return false;
}

bool live_find_strangers(froe_kinetic *k, const uint32_t *segments, size_t count) {
    size_t before = k->crew.count;
    for (size_t i = 0; i < count; i++)
        if (segments[i] != FROE_NONE && !live_in_crew(k, segments[i]) && is_near(k, segments[i]))
            live_join_crew(k, segments[i]);
    return k->crew.count > before;
}

/* ------------------------------------------------------------------- items -- */

static bool is_at(froe_kinetic *k, uint32_t vertex, const live_place *place) {
    live_place at = place_of_name(k, (now_name){vertex, NAME_VERTEX}, 0);
    return places_meet(&at, place);
}

static bool comes_to(froe_kinetic *k, uint32_t segment, const live_place *place) {
    const line s = line_of_segment(k, segment);
    return is_near_place(&s, place);
}

/* Do the points of a certificate lie in different places, and do the segments of each keep away from the other? */
static bool are_apart(froe_kinetic *k, const now_name name[2], const live_place place[2]) {
    if (places_meet(place, place + 1)) return false;
    for (int i = 0; i < 2; i++) {
        const uint32_t both[2] = {name[i].a, (uint32_t)name[i].b};
        uint32_t e = name_is_vertex(name[i]) ? k->vertices.data[name[i].a] : FROE_NONE;
        for (; e != FROE_NONE; e = segment_at(k, e / 2)->end[e % 2].next)
            if (comes_to(k, e / 2, place + (1 - i))) return false;
        for (int j = 0; j < 2 && name_is_crossing(name[i]); j++)
            if (comes_to(k, both[j], place + (1 - i))) return false;
    }
    return true;
}

bool live_belong_together(const froe_kinetic *k, const live_item *item) {
    now_name p = item->claim.p, q = item->claim.q, third;
    if (item->kind == CERT_TURN || p.b == NAME_SEGMENT || live_met_segment(k, p, q) != FROE_NONE) return true;
    if (name_is_crossing(p) && name_is_crossing(q)) return live_third_crossing(p, q, &third);
    return live_is_one_segment(k, p, q);
}

bool live_join_item(froe_kinetic *k, const live_item *item) {
    const now_name name[2] = {item->claim.p, item->claim.q};
    live_place place[2];
    if (item->kind == CERT_TURN) live_join_crew(k, item->cert);
    for (int i = 0; i < 2; i++) {
        join_by_name(k, name[i]);
        if (name[i].b == NAME_SEGMENT) continue;
        now_name other = name[1 - i].b == NAME_SEGMENT ? name[i] : name[1 - i];
        place[i] = place_of_name(k, name[i], now_spot_of(&k->now, other).x);
        if (!array_push(&k->alloc, &k->places, place[i])) k->short_of_memory = true;
    }
    return live_belong_together(k, item) || are_apart(k, name, place);
}

bool live_has_loose_ends(froe_kinetic *k, const live_item *item) {
    now_name p = item->claim.p, q = item->claim.q;
    for (size_t i = 0; i < k->crew.count; i++)
        for (int e = 0; e < 2; e++) {
            uint32_t vertex = k->now.segments.data[k->crew.data[i]].end[e];
            if ((name_is_vertex(p) && p.a == vertex) || (name_is_vertex(q) && q.a == vertex)) continue;
            for (size_t j = 0; j < k->places.count; j++)
                if (is_at(k, vertex, k->places.data + j)) return true;
        }
    return false;
}

/* ------------------------------------------------------------------- reach -- */

/* The part of s that is near the line of t, as shares of the way along s. False: there is none. */
static bool near_line(const line *s, const line *t, double far, double share[2]) {
    double d[2] = {t->at[1][0] - t->at[0][0], t->at[1][1] - t->at[0][1]}, off[2], slack = 0;
    for (int e = 0; e < 2; e++) {
        double u = s->at[e][0] - t->at[0][0], v = s->at[e][1] - t->at[0][1];
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
void live_reach_pair(froe_kinetic *k, double slab[2], uint32_t s, uint32_t t) {
    const line a = line_of_segment(k, s), b = line_of_segment(k, t);
    double share[2], far = margin(a.speed, b.speed) + 2 * (a.error + b.error);
    if (!near_line(&b, &a, far, share) || !near_line(&a, &b, far, share)) return;
    double x[2] = {a.at[0][0] + share[0] * (a.at[1][0] - a.at[0][0]),
                   a.at[0][0] + share[1] * (a.at[1][0] - a.at[0][0])};
    double slack = far + (fabs(x[0]) + fabs(x[1])) * 0x1p-40;
    double low = fmax(fmin(x[0], x[1]), fmin(b.at[0][0], b.at[1][0])) - slack;
    double high = fmin(fmax(x[0], x[1]), fmax(b.at[0][0], b.at[1][0])) + slack;
    if (low > high) return;
    slab[0] = fmin(slab[0], low), slab[1] = fmax(slab[1], high);
    live_reach(k, slab, name_crossing(s, t));
}

static void reach_end(froe_kinetic *k, uint32_t vertex, double slab[2]) {
    now_spot s = now_spot_of(&k->now, (now_name){vertex, NAME_VERTEX});
    double far = margin(now_speed(&k->now, vertex), 0) + s.error;
    for (size_t i = 0; i < k->places.count; i++) {
        const live_place *p = k->places.data + i;
        double f = far + margin(p->speed, 0);
        if (s.x < p->low[0] - f || s.x > p->high[0] + f || s.y < p->low[1] - f || s.y > p->high[1] + f) continue;
        live_reach(k, slab, (now_name){vertex, NAME_VERTEX});
        return;
    }
}

void live_reach_crew(froe_kinetic *k, double slab[2]) {
    for (size_t i = 0; i < k->crew.count; i++) {
        uint32_t s = k->crew.data[i];
        for (int e = 0; e < 2; e++) {
            now_name end = {k->now.segments.data[s].end[e], NAME_VERTEX};
            if (k->crew.count > MANY)
                live_reach(k, slab, end);
            else
                reach_end(k, end.a, slab);
        }
        for (size_t j = 0; j < i && k->crew.count <= MANY; j++) live_reach_pair(k, slab, s, k->crew.data[j]);
    }
}
