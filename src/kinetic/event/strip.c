/* strip.c: what lies in two cells next to the wall between them, in space. */
#include "kinetic/event/strip.h"
#include "kinetic/certificate/certify.h"
#include "kinetic/kinetic.h"

bool strip_point_ends_before(now_state *now, const strip *s, name_point wall) {
    const int order = now_compare(now, wall, (name_point){(uint32_t)(1 - s->side), NAME_LINE});
    return s->side == KTREE_RIGHT ? order < 0 : order > 0;
}

/* The places of what is cut off, among the parts: two of each strip. */
static uint8_t part_slot(int which, int side) {
    return (uint8_t)(2 * which + side);
}

static uint32_t strip_part(const froe_kinetic *k, int which, int side) {
    return ktree_node_at(&k->tree, KTREE_PARTS)->child[part_slot(which, side)];
}

static void cut_strip(froe_kinetic *k, const strip *s, int which) {
    const uint32_t node = ktree_node_at(&k->tree, s->site.parent)->child[s->site.slot];
    surgery_split(k, node, 1 - s->side, (uint32_t[]){KTREE_PARTS, KTREE_PARTS},
                  (uint8_t[]){part_slot(which, KTREE_LEFT), part_slot(which, KTREE_RIGHT)});
}

static void join_again(froe_kinetic *k, const strip *s, int which) {
    surgery_join(k, strip_part(k, which, KTREE_LEFT), strip_part(k, which, KTREE_RIGHT), s->site.parent, s->site.slot);
}

/* Has it no wall but those of a point? */
static bool has_one_wall(froe_kinetic *k, uint32_t node, name_point point) {
    ktree *tree = &k->tree;
    ktree_walk(tree, node);
    for (uint32_t n; (n = ktree_walk_next(tree));)
        for (int side = 0; side < 2; side++) {
            const ktree_node *at = ktree_node_at(tree, n);
            const name_point wall = ktree_wall_name(tree, at->segment, at->wall[side]);
            if (name_exists(wall) && !name_is(wall, point)) return false;
        }
    return true;
}

/* Lists the triangles of both strips and, of a vertex, those at it. */
static void list_all(froe_kinetic *k, const strip both[2], name_point point) {
    ktree *tree = &k->tree;
    ktree_new_list(tree);
    for (int i = 0; i < 2; i++) ktree_collect(tree, strip_part(k, i, both[i].side));
    uint32_t e = name_is_vertex(point) ? tree->vertices.data[point.a] : FROE_NONE;
    for (; e != FROE_NONE; e = ktree_next_end(tree, e)) ktree_list_objects(tree, e / 2);
    for (int i = 0; i < 2 && name_is_crossing(point); i++) ktree_list_objects(tree, i ? (uint32_t)point.b : point.a);
}

static void keep_list(froe_kinetic *k) {
    const ktree *tree = &k->tree;
    k->surgery.kept.count = 0;
    for (size_t i = 0; i < tree->list.count; i++) call_push(&k->call, &k->surgery.kept, tree->list.data[i]);
}

static void grow_again(froe_kinetic *k, const strip *s, int which) {
    ktree_cell cell = s->site.cell;
    ktree_new_list(&k->tree);
    for (size_t i = 0; i < k->surgery.kept.count; i++) ktree_list(&k->tree, k->surgery.kept.data[i]);
    cell.wall[1 - s->side] = (name_point){(uint32_t)(1 - s->side), NAME_LINE};
    surgery_free_tree(k, strip_part(k, which, s->side));
    surgery_grow(k, &cell, KTREE_PARTS, part_slot(which, s->side));
}

pass_outcome strip_pass(froe_kinetic *k, const strip both[2], name_point point) {
    ktree *tree = &k->tree;
    pass_outcome outcome = PASS_DONE;
    surgery_begin(k);
    for (int i = 0; i < 2; i++) cut_strip(k, both + i, i);
    if (k->call.stopped) return PASS_DONE;
    list_all(k, both, point);
    for (int i = 0; i < 2; i++) {
        const ktree_cell *cell = &both[i].site.cell;
        if (participants_add_near(k, (uint32_t[]){cell->top, cell->bottom}, 2)) outcome = PASS_NEIGHBOURS;
    }
    if (participants_add_near(k, tree->list.data, tree->list.count)) outcome = PASS_NEIGHBOURS;
    for (int i = 0; i < 2 && !outcome; i++)
        if (!has_one_wall(k, strip_part(k, i, both[i].side), point)) outcome = PASS_REFUSED;
    if (!outcome) {
        k->counts.surgeries++;
        keep_list(k);
        for (int i = 0; i < 2; i++) grow_again(k, both + i, i);
    }
    for (int i = 0; i < 2; i++) join_again(k, both + i, i);
    if (outcome || k->call.stopped || tree->broken || k->now.lost) return outcome;
    ktree_touch_wall(tree, both[0].site.cell.wall[both[0].side]);
    certify_sites(k, (const ktree_site *const[]){&both[0].site, &both[1].site}, 2);
    return PASS_DONE;
}
