/* trims.c: sides along which a hidden shape is drawn short, as what hides it ends there, too. */
#include "view/picture/seams.h"
#include <math.h>
#include <string.h>

/* Does a ring meet a strip? A corner deep within the strip, or none on its side, decides most; else print_overlap(). */
enum { MEETS_NOT, MEETS_MAYBE, MEETS };

/* Of the strips inside and beyond ab. */
typedef struct seam_place {
    int inside, beyond;
} seam_place;

static seam_place place_beside(const view_seams *s, uint32_t visible, print_point a, print_point b) {
    const seam_span span = view_seam_span(s, visible);
    const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy, length = sqrt(square),
                 wide = 0.5 * s->width * length, deep = SEAM_MARGIN * s->width * length * (1 + 1e-6),
                 little = SEAM_MARGIN * s->width * length * (1 - 1e-6);
    double lo = INFINITY, hi = -INFINITY, first = INFINITY, last = -INFINITY;
    seam_place out = {MEETS_MAYBE, MEETS_MAYBE};
    if (span.count < 3) return (seam_place){MEETS_NOT, MEETS_NOT};
    for (size_t k = span.first; k < span.first + span.count; k++) {
        const double x = s->points.data[k].x - a.x, y = s->points.data[k].y - a.y, along = dx * x + dy * y,
                     right = dx * y - dy * x; /* y points down */
        lo = right < lo ? right : lo, hi = right > hi ? right : hi;
        first = along < first ? along : first, last = along > last ? along : last;
        if (along <= deep || along >= square - deep) continue;
        if (right < -deep && right > deep - wide) out.inside = MEETS;
        if (right > deep && right < wide - deep) out.beyond = MEETS;
    }
    const bool aside = last < little || first > square - little;
    if (aside || lo > -little || hi < little - wide) out.inside = MEETS_NOT;
    if (aside || hi < little || lo > wide - little) out.beyond = MEETS_NOT;
    return out;
}

static bool meets_strip(const view_seams *s, uint32_t visible, int meets, const print_point strip[4]) {
    return meets == MEETS_MAYBE ? view_seam_meets(s, visible, strip, 4) : meets == MEETS;
}

/* A number that no mark of a node has yet. */
static uint32_t begin_marks(view_seams *s) {
    if (!++s->marked) { /* after 2^32 of them */
        memset(s->marks, 0, s->parts->nodes.count * sizeof *s->marks);
        s->marked = 1;
    }
    return s->marked;
}

bool view_seams_end(view_seams *s, uint32_t node, print_point a, print_point b, bool *ends) {
    print_point inner[4], outer[4];
    size_t inside = 0; /* so many near pieces may be visible inside */
    *ends = false;
    if (a.x == b.x && a.y == b.y) return true;
    view_make_strip(a, b, -0.5 * s->width, inner);
    view_make_strip(a, b, 0.5 * s->width, outer);
    if (!view_seams_near(s, view_grid_along(&s->grid, a, b, 0.5 * s->width))) return false;
    const uint32_t mark = begin_marks(s); /* of nodes that are visible beyond */
    for (size_t i = 0; i < s->near.count; i++) {
        const uint32_t visible = s->near.data[i], other = s->parts->node_of[visible];
        const seam_place at = place_beside(s, visible, a, b);
        if (at.beyond && s->marks[other] != mark && meets_strip(s, visible, at.beyond, outer)) s->marks[other] = mark;
        if (at.inside && s->marks[other] != mark) s->near.data[inside++] = visible;
    }
    for (size_t i = 0; i < inside && !*ends; i++) {
        const uint32_t visible = s->near.data[i];
        *ends = s->marks[s->parts->node_of[visible]] != mark && view_seam_covers(s, visible, node) &&
                view_seam_meets(s, visible, inner, 4);
    }
    return true;
}

bool view_seams_hidden(view_seams *s, uint32_t node, const print_point *ring, size_t count, bool *hidden) {
    if (!view_seams_own(s, node, view_grid_begin(&s->grid, view_grid_cells(&s->grid, ring, count, 0)))) return false;
    *hidden = !view_own_meets(s, ring, count);
    return true;
}
