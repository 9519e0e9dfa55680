/* between.c: see between.h. Nothing but signs of determinants decides. */
#include "geom/between.h"
#include "base/random.h"
#include "geom/body.h"
#include <string.h>

/* Planes through the first `depth` of the points that were on the wrong side, and the points before `limit` on their
 * right sides, so far as `next`. */
typedef struct level {
    uint32_t next, limit;
    bool strict; /* some of those lies beside the plane, not in it */
} level;

typedef struct between_search {
    num_context *context;
    int dim, depth;
    geom_member *members;
    geom_member seeds[3]; /* they span a plane */
    geom_member basis[3]; /* of the current plane; first those that it has to run through */
    geom_plane plane;
    int sign; /* the side of the plane on which set 1 has to be */
    level levels[4];
} between_search;

/* The plane through the basis. False: it spans none. */
static bool take_plane(between_search *s) {
    const double *points[3] = {s->basis[0].x, s->basis[1].x, s->basis[2].x};
    s->plane = geom_plane_points(s->dim, points);
    return geom_plane_valid(s->context, &s->plane);
}

/* Any plane through the first `depth` of the basis: they are independent, so that some dim - depth neighbours in the
 * circle of the seeds complete them. */
static void any_plane(between_search *s) {
    int missing = s->dim - s->depth;
    s->sign = 1;
    for (int first = 0;; first++) {
        for (int i = 0; i < missing; i++) s->basis[s->depth + i] = s->seeds[(first + i) % s->dim];
        if (take_plane(s)) return;
    }
}

/* Makes dim of the points that span a plane the seeds. */
static bool find_seeds(between_search *s, uint32_t count) {
    uint32_t second = 1, third;
    while (second < count && geom_same_point(s->members->x, s->members[second].x, s->dim)) second++;
    if (second == count) return false;
    s->seeds[0] = s->basis[0] = s->members[0];
    s->seeds[1] = s->basis[1] = s->members[second];
    for (third = second + 1; s->dim == 3 && third < count; third++) {
        s->seeds[2] = s->basis[2] = s->members[third];
        if (take_plane(s)) return true;
    }
    return s->dim == 2;
}

/* Looks at the next point. False: no plane is right for it and for those before. */
static bool step_walk(between_search *s) {
    const uint32_t at = s->levels[s->depth].next;
    const geom_member *m = s->members + at;
    level *l = s->levels + s->depth;
    int side = geom_side_vertex(s->context, &s->plane, m->x) * s->sign * m->set;
    if (side < 0 && l->strict) { /* takes up the planes through one point more */
        if (s->depth == s->dim) return false;
        s->basis[s->depth++] = *m;
        s->levels[s->depth] = (level){.limit = at};
        any_plane(s);
        return true;
    }
    if (side < 0) s->sign = -s->sign; /* all before lie in the plane: turned round it is as right for them */
    l->strict |= side != 0;
    l->next++;
    return true;
}

geom_answer geom_between(num_context *context, int dim, geom_member *members, uint32_t count) {
    between_search s = {.context = context, .dim = dim, .members = members, .levels = {{.limit = count}}};
    for (uint32_t i = count; i > 1; i--) { /* a random order */
        const uint32_t j = base_below(base_mix(i), i);
        const geom_member m = members[j];
        members[j] = members[i - 1];
        members[i - 1] = m;
    }
    if (!find_seeds(&s, count)) return GEOM_FLAT;
    any_plane(&s);
    for (;;) {
        bool done = s.levels[s.depth].next == s.levels[s.depth].limit;
        if (done && !s.depth) break;
        if (!done && !step_walk(&s)) return GEOM_NO;
        if (!done) continue;
        /* Back to the planes through one point less; the plane found is right for the point that was wrong, too. Such a
         * point is likely to be wrong again: it is looked at first from now on. */
        const bool strict = s.levels[s.depth--].strict;
        level *l = s.levels + s.depth;
        const uint32_t at = l->next++;
        const geom_member wrong = members[at];
        l->strict = strict;
        memmove(members + 1, members, at * sizeof wrong);
        members[0] = wrong;
    }
    if (!s.levels[0].strict) return GEOM_FLAT;
    memcpy(members, s.basis, (size_t)dim * sizeof *members);
    return GEOM_YES;
}
