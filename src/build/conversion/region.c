/* region.c: Sutherland and Hodgman's clipping (1974), corner by corner. */
#include "build/conversion/region.h"
#include "geom/filter.h"
#include "support/clip.h"

void region_around(const double *lo, const double *hi, uint32_t side, region *out) {
    double from[2], to[2];
    bool known = true;
    for (int k = 0; k < 2; k++) {
        double size = hi[k] - lo[k] > 0 ? hi[k] - lo[k] : 1;
        from[k] = lo[k] - size;
        to[k] = hi[k] + size;
        known = known && fabs(from[k]) < 0x1p500 && fabs(to[k]) < 0x1p500; /* their products, too, are doubles */
    }
    *out = (region){
        .count = known ? 4 : 0,
        .corner = {
            {{from[0], from[1]}, side}, {{to[0], from[1]}, side}, {{to[0], to[1]}, side}, {{from[0], to[1]}, side}}};
}

int region_along(const geom_plane *line) {
    return fabs(line->n[0]) < fabs(line->n[1]) ? 0 : 1;
}

/** Signed distances in units of the normal, 0 where rounding decides. */
static void find_values(const region *r, const geom_plane *line, double *value) {
    for (uint32_t i = 0; i < r->count; i++) {
        num_ball f = filter_value(line, r->corner[i].x);
        value[i] = fabs(f.x) > 4 * f.e ? f.x : 0; /* NaN: 0 */
    }
}

/** Where the side leaving corner i meets the line. */
static region_corner meeting(const region *r, const geom_plane *line, const double *value, uint32_t i) {
    const region_corner *p = r->corner + i, *q = r->corner + (i + 1 < r->count ? i + 1 : 0);
    double u = value[i], v = value[i + 1 < r->count ? i + 1 : 0], share = u / (u - v);
    region_corner c = {.side = p->side};
    for (int k = 0; k < 2; k++) c.x[k] = p->x[k] + share * (q->x[k] - p->x[k]);
    if (line->form == GEOM_AXIS) c.x[line->axis] = line->c;
    return c;
}

bool region_section(const region *r, const geom_plane *line, region_corner end[2]) {
    double value[REGION_MOST];
    uint32_t found = 0;
    find_values(r, line, value);
    for (uint32_t i = 0; i < r->count; i++) {
        double u = value[i], v = value[i + 1 < r->count ? i + 1 : 0];
        bool meets = u == 0 || (u < 0 && v > 0) || (u > 0 && v < 0);
        if (!meets) continue;
        if (found == 2) return false;
        end[found++] = u == 0 ? r->corner[i] : meeting(r, line, value, i);
    }
    return found == 2;
}

void region_clip(const region *r, const geom_plane *line, int which, uint32_t side, region *out) {
    double value[REGION_MOST];
    uint32_t n = r->count;
    find_values(r, line, value);
    out->count = 0;
    for (uint32_t i = 0; i < n && out->count + 2 <= REGION_MOST; i++) {
        double u = which * value[i], v = which * value[i + 1 < n ? i + 1 : 0];
        const support_clipped left = support_clip_edge(u, v);
        if (left.corner) {
            out->corner[out->count] = r->corner[i];
            if (u == 0 && v < 0) out->corner[out->count].side = side;
            out->count++;
        }
        if (!left.meeting) continue;
        out->corner[out->count] = meeting(r, line, value, i);
        if (u > 0) out->corner[out->count].side = side;
        out->count++;
    }
    if (out->count + 2 > REGION_MOST || out->count < 3) out->count = 0;
}
