/* write_motion.c: froe_write_motion: a motion as OGC Moving Features JSON, one feature a chain of segments;
 * bodies, and what moves in space, see write_solids.c. */
#include "formats/motion/solids.h"
#include "formats/write/writer.h"
#include "support/floats.h"
#include <math.h>

/* A run of objects in which each begins with the vertex where the one before ends. */
typedef struct chain {
    const froe_motion *motion;
    uint32_t first, end; /* objects */
    bool ring;           /* the last ends where the first begins */
} chain;

static uint32_t vertex_of(const chain *c, uint32_t i) {
    froe_moving_object o = froe_motion_object(c->motion, c->first + (c->first + i < c->end ? i : i - 1));
    return o.vertices[c->first + i < c->end ? 0 : 1];
}

/* Points of each geometry, a ring's first counted once. */
static uint32_t point_count(const chain *c) {
    return c->end - c->first + !c->ring;
}

static chain chain_at(const froe_motion *m, uint32_t first) {
    chain c = {m, first, first + 1, false};
    froe_moving_object begin = froe_motion_object(m, first), last = begin;
    for (; c.end < froe_motion_object_count(m); c.end++) {
        froe_moving_object next = froe_motion_object(m, c.end);
        if (next.group != begin.group || next.vertices[0] != last.vertices[1] || next.birth != begin.birth ||
            next.death != begin.death || last.vertices[1] == begin.vertices[0])
            break;
        last = next;
    }
    c.ring = c.end - c.first > 2 && last.vertices[1] == begin.vertices[0];
    return c;
}

/* Do all vertices have the same instants, from the birth to the death of the segments? */
static froe_status check_motion(const chain *c, froe_diagnostic *diag) {
    froe_moving_object o = froe_motion_object(c->motion, c->first);
    uint32_t v0 = vertex_of(c, 0);
    size_t count = froe_motion_knot_count(c->motion, v0);
    bool fits = count == 1 || (froe_motion_knot(c->motion, v0, 0).time == o.birth &&
                               froe_motion_knot(c->motion, v0, count - 1).time == o.death);
    for (uint32_t i = 1; i < point_count(c) && fits; i++) {
        uint32_t v = vertex_of(c, i);
        fits = froe_motion_knot_count(c->motion, v) == count;
        for (size_t k = 0; k < count && fits; k++)
            fits = froe_motion_knot(c->motion, v, k).time == froe_motion_knot(c->motion, v0, k).time;
    }
    if (fits && count > 1) return FROE_OK;
    return support_fail(diag, FROE_E_UNSUPPORTED,
                        "segment %u: The instants of its vertices are not the same, or not those of its life, which "
                        "MF-JSON cannot say.",
                        c->first);
}

/* The greatest degree of a piece of the chain. */
static int chain_degree(const chain *c, size_t knots) {
    int degree = 1;
    for (uint32_t i = 0; i < point_count(c); i++)
        for (size_t k = 0; k + 1 < knots; k++) {
            const froe_moving_knot knot = froe_motion_knot(c->motion, vertex_of(c, i), k);
            const int here = formats_degree_of(&knot);
            degree = here > degree ? here : degree;
        }
    return degree;
}

/* All points at one instant. */
static void put_geometry(formats_writer *w, const chain *c, size_t k, formats_listed what, int degree) {
    bool point = vertex_of(c, 0) == vertex_of(c, 1);
    uint32_t count = point ? 1 : c->end - c->first + 1;
    formats_put(w, c->ring ? "[[" : point ? "" : "[");
    for (uint32_t i = 0; i < count; i++) {
        uint32_t v = vertex_of(c, c->ring && i + 1 == count ? 0 : i);
        if (i) formats_put(w, ",");
        const froe_moving_knot knot = froe_motion_knot(c->motion, v, k);
        const bool last = what == FORMATS_PLACES; /* there may be no next one */
        const froe_moving_knot next = last ? knot : froe_motion_knot(c->motion, v, k + 1);
        formats_put_listed(w, &knot, &next, 2, what, degree);
    }
    formats_put(w, c->ring ? "]]" : point ? "" : "]");
}

static void put_geometries(formats_writer *w, const chain *c, const char *name, size_t count, formats_listed what,
                           int degree) {
    formats_put(w, name);
    for (size_t k = 0; k < count; k++) {
        if (k) formats_put(w, ",");
        put_geometry(w, c, k, what, degree);
    }
    formats_put(w, "]");
}

static void put_feature(formats_writer *w, const chain *c) {
    froe_moving_object o = froe_motion_object(c->motion, c->first);
    uint32_t v0 = vertex_of(c, 0);
    size_t count = froe_motion_knot_count(c->motion, v0);
    const bool point = v0 == vertex_of(c, 1);
    const int degree = chain_degree(c, count);
    formats_put(w, "{\"type\":\"Feature\",\"properties\":{");
    if (o.group != FROE_NONE) {
        formats_put(w, "\"name\":");
        formats_put_json(w, froe_motion_group(c->motion, o.group).name);
    }
    formats_put(w, "},\"temporalGeometry\":{\"type\":\"");
    formats_put(w, c->ring ? "MovingPolygon" : point ? "MovingPoint" : "MovingLineString");
    formats_put_interpolation(w, degree);
    for (size_t k = 0; k < count; k++) {
        if (k) formats_put(w, ",");
        formats_put_number(w, froe_motion_knot(c->motion, v0, k).time);
    }
    put_geometries(w, c, "],\"coordinates\":[", count, FORMATS_PLACES, degree);
    if (degree > 1) put_geometries(w, c, ",\"controls\":[", count - 1, FORMATS_CONTROLS, degree);
    if (degree > 2) put_geometries(w, c, ",\"secondControls\":[", count - 1, FORMATS_SECOND_CONTROLS, degree);
    formats_put(w, "}}");
}

static uint32_t put_chain(const froe_motion *motion, formats_writer *w, uint32_t first) {
    const chain c = chain_at(motion, first);
    put_feature(w, &c);
    return c.end;
}

froe_status froe_write_motion(const froe_motion *motion, const char *path, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!motion || !path) return support_fail_null(diag, __func__);
    const bool space = froe_motion_window(motion).dim == 3;
    uint32_t count = (uint32_t)froe_motion_object_count(motion);
    for (uint32_t i = 0; i < count && !space;) {
        chain c = chain_at(motion, i);
        const bool carried = froe_motion_vertex_body(motion, vertex_of(&c, 0)) != FROE_NONE;
        froe_status status = carried ? FROE_OK : check_motion(&c, diag);
        if (status) return status;
        i = c.end;
    }
    formats_writer w;
    froe_status status = formats_writer_open(&w, path, diag);
    if (status) return status;
    formats_put(&w, "{\"type\":\"FeatureCollection\",\"features\":[");
    status = formats_write_solids(motion, &w, put_chain, diag);
    formats_put(&w, "\n]}\n");
    return formats_writer_close(&w, status);
}
