/* face.c: triangles in space just after a tick: edges and surfaces by number, and which of two is above the other.
 *
 *      s  /\             Two triangles that do not cross and overlap as seen from above differ in height by a function
 *     ---/--\--- t       that is linear where they overlap, and changes its sign nowhere. So any corner of the overlap
 *       /____\           where they differ tells which is above: a vertex of one within the other, or where two edges
 *                         cross. If they differ at none of them, they differ nowhere. Each of these is the side of a
 * vertex of a plane, of degree 3 in time for linear plans. */
#include "base/sort.h"
#include "kinetic/now/now.h"

/* ----------------------------------------------------------------- numbers -- */

typedef struct face_side {
    uint32_t low, high; /* vertices */
    uint32_t corner;    /* 3 object + number of the edge */
} face_side;

static int by_vertices(const void *a, const void *b) {
    const face_side *x = a, *y = b;
    if (x->low != y->low) return x->low < y->low ? -1 : 1;
    if (x->high != y->high) return x->high < y->high ? -1 : 1;
    return (x->corner > y->corner) - (x->corner < y->corner);
}

/* Links equal edges of all faces; edge[] becomes the corner of the first of them. */
static void link_sides(now_state *now, face_side *sides) {
    const size_t count = 3 * now->faces.count;
    now_face *faces = now->faces.data;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t u = faces[i / 3].vertex[i % 3], v = faces[i / 3].vertex[(i + 1) % 3];
        sides[i] = (face_side){u < v ? u : v, u < v ? v : u, i};
    }
    base_sort(sides, count, sizeof *sides, by_vertices);
    for (size_t i = 0, first = 0; i < count; i++) {
        if (sides[i].low != sides[first].low || sides[i].high != sides[first].high) first = i;
        const bool more = i + 1 < count && sides[i + 1].low == sides[i].low && sides[i + 1].high == sides[i].high;
        now_face *f = faces + sides[i].corner / 3;
        f->edge[sides[i].corner % 3] = sides[first].corner;
        f->next[sides[i].corner % 3] = more ? sides[i + 1].corner : FROE_NONE;
    }
}

/* Edges that are new, in order, and the surface. What had a number before has it again, and stays as it is. REQUIRES:
 * room. */
static void number_face(now_state *now, uint32_t object, uint32_t *count, uint32_t known) {
    now_face *f = now->faces.data + object;
    now_segment *all = now->segments.data;
    for (uint32_t i = 0; i < 3; i++) {
        const uint32_t first = f->edge[i], corner = 3 * object + i;
        if (first != corner) {
            f->edge[i] = now->faces.data[first / 3].edge[first % 3];
            continue;
        }
        if (*count >= known) all[*count] = (now_segment){{f->vertex[i], f->vertex[(i + 1) % 3]}, corner, false, false};
        f->edge[i] = (*count)++;
    }
    if (*count >= known) all[*count] = (now_segment){{f->vertex[0], f->vertex[1]}, object, false, true};
    f->surface = (*count)++;
}

froe_status now_grow_faces(now_state *now) {
    const froe_allocator *alloc = &now->context.alloc;
    const froe_motion *m = now->motion;
    const size_t before = now->faces.count, all = m->objects.count, most = 4 * all + 1;
    face_side *sides = support_calloc(alloc, 3 * all + 1, sizeof *sides);
    const bool room = sides && array_reserve(alloc, &now->faces, all - before) &&
                      array_reserve(alloc, &now->segments, most - now->segments.count);
    for (size_t i = before; i < all && room; i++) {
        now_face *f = now->faces.data + now->faces.count++;
        *f = (now_face){.ghost = false};
        for (int k = 0; k < 3; k++) f->vertex[k] = m->objects.data[i].vertices[k];
    }
    if (room) {
        /* the numbers of those before come out as they are, as they depend on what is before alone */
        const uint32_t known = now->segments.count ? (uint32_t)now->segments.count - 1 : 0;
        uint32_t count = 0;
        link_sides(now, sides);
        for (uint32_t i = 0; i < all; i++) number_face(now, i, &count, known);
        now->segments.count = count + 1;
    }
    if (sides) support_free(alloc, sides, (3 * all + 1) * sizeof *sides);
    return room ? FROE_OK : FROE_E_MEMORY;
}

/* ------------------------------------------------------------------- sides -- */

typedef struct ball3 {
    num_ball c[3];
} ball3;

static ball3 place_of(now_state *now, uint32_t vertex) {
    const now_spot s = now_vertex_spot(now, vertex);
    const now_bend *b = now->bends.data + vertex;
    const double t = (double)(now->tick - now->courses.data[vertex].base);
    const double height = b->z[0] + t * (b->z[1] + t * (b->z[2] + t * b->z[3]));
    return (ball3){{{s.x, s.error}, {s.y, s.error}, {height, b->error}}};
}

static ball3 step_from(ball3 a, ball3 b) {
    for (int k = 0; k < 3; k++) b.c[k] = num_ball_sub(b.c[k], a.c[k]);
    return b;
}

static num_ball cross(const ball3 *d, const ball3 *e) {
    return num_ball_sub(num_ball_mul(d->c[0], e->c[1]), num_ball_mul(d->c[1], e->c[0]));
}

/* Of vertices just after the tick, as seen from above: > 0 where they turn left. */
static int turn_of(now_state *now, uint32_t a, uint32_t b, uint32_t q) {
    const uint32_t vertex[3] = {a, b, q};
    if (a == q || b == q) return 0;
    const ball3 from = place_of(now, a), d = step_from(from, place_of(now, b)), e = step_from(from, place_of(now, q));
    int sign = num_ball_sign(cross(&d, &e));
    if (sign == 1 || sign == -1) return sign;
    sign = now_judge_turn(now, vertex, false);
    return sign ? sign : now_judge_turn(now, vertex, true);
}

/* Just after the tick; 0: in one plane for as long as the pieces last. */
static int volume_of(now_state *now, const uint32_t vertex[4]) {
    const ball3 from = place_of(now, vertex[0]);
    ball3 d[3];
    num_ball sum = {0, 0};
    for (int i = 0; i < 3; i++) d[i] = step_from(from, place_of(now, vertex[1 + i]));
    for (int i = 0; i < 3; i++)
        sum = num_ball_add(sum, num_ball_mul(cross(d + (i + 1) % 3, d + (i + 2) % 3), d[i].c[2]));
    int sign = num_ball_sign(sum);
    if (sign == 1 || sign == -1) return sign;
    sign = now_judge_volume(now, vertex, false);
    now->tied |= !sign;
    return sign ? sign : now_judge_volume(now, vertex, true);
}

int now_area(now_state *now, uint32_t object) {
    const uint32_t *v = now->faces.data[object].vertex;
    return turn_of(now, v[0], v[1], v[2]);
}

int now_over(now_state *now, uint32_t object, uint32_t vertex) {
    const uint32_t *v = now->faces.data[object].vertex;
    return volume_of(now, (uint32_t[]){v[0], v[1], v[2], vertex}) * now_area(now, object);
}

/* Is a vertex above (1) or below (-1) a triangle of that area? 0: neither, or it is beside it. */
static int vertex_above(now_state *now, uint32_t vertex, const uint32_t of[3], int area) {
    for (int i = 0; i < 3; i++) {
        if (vertex == of[i]) return 0;
        if (turn_of(now, of[i], of[(i + 1) % 3], vertex) * area < 0) return 0;
    }
    return volume_of(now, (uint32_t[]){of[0], of[1], of[2], vertex}) * area;
}

/* The same of two edges, where they cross as seen from above. */
static int edge_above(now_state *now, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    if (a == c || a == d || b == c || b == d) return 0;
    const int at_c = turn_of(now, a, b, c), at_d = turn_of(now, a, b, d);
    if (at_c * at_d > 0 || at_c == at_d) return 0;
    if (turn_of(now, c, d, a) * turn_of(now, c, d, b) > 0) return 0;
    return volume_of(now, (uint32_t[]){a, b, c, d}) * (at_d ? at_d : -at_c);
}

int now_above(now_state *now, uint32_t s, uint32_t t) {
    const uint32_t *u = now->faces.data[s].vertex, *v = now->faces.data[t].vertex;
    const int area[2] = {now_area(now, s), now_area(now, t)};
    int found = 0;
    for (int i = 0; i < 3 && !found && area[1]; i++) found = vertex_above(now, u[i], v, area[1]);
    for (int i = 0; i < 3 && !found && area[0]; i++) found = -vertex_above(now, v[i], u, area[0]);
    for (int i = 0; i < 9 && !found; i++)
        found = edge_above(now, u[i / 3], u[(i / 3 + 1) % 3], v[i % 3], v[(i % 3 + 1) % 3]);
    return found;
}
