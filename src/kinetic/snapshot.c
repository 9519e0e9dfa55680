/* snapshot.c: the present of a kinetic partition as an ordinary tree, and where its vertices are exactly. */
#include "base/floats.h"
#include "base/sort.h"
#include "kinetic/kinetic.h"
#include "kinetic/places.h"
#include "scene/scene.h"
#include "support/fail.h"

void froe_snapshot_defaults_into(froe_snapshot_options *out, size_t size) {
    const froe_snapshot_options all = {.size = size, .places = true, .up = 2};
    support_defaults(out, size, &all, sizeof all);
}

typedef struct snapshot_work {
    froe_kinetic *k;
    uint32_t *objects, *order; /* ids in the motion, by id; positions in it, the first to cut first */
    size_t count, rounded, dim;
    uint32_t first_rounded; /* id in the motion */
    double *coords;
    uint64_t *tags;
    froe_places *places; /* NULL: not asked for */
} snapshot_work;

static bool snapshot_new(froe_kinetic *k, bool places, snapshot_work *p) {
    const size_t all = kinetic_object_count(k), dim = (size_t)k->now.motion->dim;
    size_t n = 0;
    for (uint32_t o = 0; o < all; o++) n += ktree_segment_at(&k->tree, now_segment_of(&k->now, o))->alive;
    *p = (snapshot_work){.k = k, .count = n, .dim = dim, .first_rounded = FROE_NONE};
    places = places && dim == 2;
    if (places) p->places = places_new(&k->call.alloc);
    p->objects = support_calloc(&k->call.alloc, n + 1, sizeof *p->objects);
    p->order = support_calloc(&k->call.alloc, 2 * n + 1, sizeof *p->order);
    p->coords = support_calloc(&k->call.alloc, dim * dim * n + 1, sizeof *p->coords);
    p->tags = support_calloc(&k->call.alloc, n + 1, sizeof *p->tags);
    return p->objects && p->order && p->coords && p->tags && (p->places || !places);
}

static void snapshot_free(snapshot_work *p) {
    const froe_allocator *alloc = &p->k->call.alloc;
    support_free(alloc, p->objects, (p->count + 1) * sizeof *p->objects);
    support_free(alloc, p->order, (2 * p->count + 1) * sizeof *p->order);
    support_free(alloc, p->coords, (p->dim * p->dim * p->count + 1) * sizeof *p->coords);
    support_free(alloc, p->tags, (p->count + 1) * sizeof *p->tags);
    froe_places_free(p->places);
}

static int by_object_key(void *user, uint32_t a, uint32_t b) {
    const snapshot_work *p = user;
    const now_state *now = &p->k->now;
    const uint32_t s = now_segment_of(now, p->objects[a]), t = now_segment_of(now, p->objects[b]);
    return ktree_before(&p->k->tree, s, t) ? -1 : 1;
}

static void take_objects(snapshot_work *p) {
    const froe_kinetic *k = p->k;
    uint32_t n = 0;
    for (uint32_t s = 0; s < kinetic_object_count(k); s++) {
        if (!ktree_segment_at(&k->tree, now_segment_of(&k->now, s))->alive) continue;
        p->objects[n] = s;
        p->tags[n] = k->now.motion->objects.data[s].tag;
        p->order[n] = n;
        n++;
    }
    if (n > 1) base_merge_sort(p->order, p->order + n, n, by_object_key, p);
}

/* A vertex that several segments share is rounded alike, and counted for each of its segments but the first no more.
 * False: no memory, or cancelled. */
static bool take_places(snapshot_work *p) {
    froe_kinetic *k = p->k;
    for (size_t i = 0; i < p->count; i++)
        for (uint32_t e = 0; e < p->dim; e++) {
            const uint32_t vertex = k->now.motion->objects.data[p->objects[i]].vertices[e];
            const bool exact = now_round(&k->now, vertex, p->coords + (p->dim * i + e) * p->dim);
            p->rounded += !exact && (p->dim == 3 || k->tree.vertices.data[vertex] == 2 * p->objects[i] + e);
            if (!exact && p->first_rounded == FROE_NONE) p->first_rounded = p->objects[i];
            if (p->places) {
                exact_point at;
                k->now.context.arena.top = 0;
                now_exact_at(&k->now, vertex, &at);
                if (!places_add(p->places, &at, !exact)) return false;
            }
            if (!call_goes_on(&k->call)) return false;
        }
    return true;
}

static froe_status build_snapshot_tree(const snapshot_work *p, int up, froe_tree **tree, froe_diagnostic *diag) {
    froe_scene *scene = NULL;
    froe_status status = froe_scene_new((int)p->dim, &p->k->call.alloc, &scene);
    if (status) return support_fail_memory(diag);
    froe_objects batch = froe_objects_defaults();
    batch.kind = p->dim == 3 ? FROE_POLYGON : FROE_SEGMENT;
    batch.count = p->count, batch.coords = p->coords, batch.tags = p->tags;
    froe_build_options o = froe_build_defaults();
    o.method = "cylindrical";
    o.leaf = 0;
    if (p->dim == 3) o.settings = "edges=given";
    o.order = p->order, o.order_count = p->count;
    o.threads = batch.threads = p->k->options.threads;
    o.progress = p->k->options.progress, o.user = p->k->options.user;
    status = froe_scene_add(scene, &batch, diag);
    if (!status && p->dim == 3 && froe_scene_set_up(scene, up))
        status = support_fail(diag, FROE_E_OPTIONS, "option 'up': '%d' is not 0, 1 or 2.", up);
    if (!status) status = froe_build(scene, &o, tree, diag);
    froe_scene_free(scene); /* the tree holds it */
    return status;
}

/* ------------------------------------------------------------------- alike -- */

/* Nodes to compare; the tree has one for each cut of a live node. Of objects that are equal the tree names
 * the first one. */
typedef struct snapshot_twins {
    uint32_t live;
    froe_node tree;
} snapshot_twins;

typedef struct snapshot_comparison {
    const froe_kinetic *k;
    const froe_tree *tree;
    const froe_scene *scene;
    uint32_t *index;     /* of the motion's objects in the scene */
    uint32_t *originals; /* of the scene's objects: the first that is equal */
    uint32_t *vertices;  /* in space: of the scene, by vertex of the motion */
    ARRAY(snapshot_twins) stack;
    bool short_of_memory;
} snapshot_comparison;

static void push_pair_of_nodes(snapshot_comparison *c, uint32_t live, froe_node tree) {
    if (!array_push(&c->k->call.alloc, &c->stack, ((snapshot_twins){live, tree}))) c->short_of_memory = true;
}

static uint32_t snapshot_corner(const snapshot_comparison *c, uint32_t object, uint32_t end) {
    return froe_scene_corner(c->scene, object, end);
}

/* Are the two ends of an edge in space those vertices of the scene? */
static bool joins_corners(const snapshot_comparison *c, uint32_t segment, uint32_t u, uint32_t v) {
    const uint32_t *end = c->k->now.segments.data[segment].end;
    const uint32_t a = c->vertices[end[0]], b = c->vertices[end[1]];
    return (a == u && b == v) || (a == v && b == u);
}

static bool is_crossing(const snapshot_comparison *c, uint32_t s, uint32_t t, const froe_cut *cut) {
    uint32_t a[2], b[2];
    froe_scene_edge(c->scene, cut->id[0], a);
    froe_scene_edge(c->scene, cut->id[1], b);
    return (joins_corners(c, s, a[0], a[1]) && joins_corners(c, t, b[0], b[1])) ||
           (joins_corners(c, t, a[0], a[1]) && joins_corners(c, s, b[0], b[1]));
}

/* Is a cut of the tree the wall that a segment has at one of its ends? */
static bool is_wall(const snapshot_comparison *c, uint32_t segment, uint32_t wall, const froe_cut *cut) {
    if (c->vertices) {
        const now_segment *s = c->k->now.segments.data + segment;
        if (ktree_is_end(wall))
            return cut->kind == FROE_CUT_VERTEX && cut->id[0] == c->vertices[s->end[KTREE_END_0 - wall]];
        return cut->kind == FROE_CUT_CROSSING && is_crossing(c, segment, wall, cut);
    }
    const uint32_t object = c->index[segment];
    if (ktree_is_end(wall))
        return cut->kind == FROE_CUT_VERTEX && cut->id[0] == snapshot_corner(c, object, KTREE_END_0 - wall);
    if (cut->kind != FROE_CUT_CROSSING) return false;
    const uint32_t a = c->originals[cut->id[0]], b = c->originals[cut->id[1]];
    const uint32_t s = c->originals[object], t = c->originals[c->index[wall]];
    return (a == s && b == t) || (a == t && b == s);
}

/* The cuts of a live node: walls on its left and right, then the segment, which is directed as its ends are given. */
static bool is_same(snapshot_comparison *c, snapshot_twins at) {
    froe_node_info info = froe_tree_node(c->tree, at.tree);
    if (!at.live) return info.cut.kind == FROE_CUT_NONE;
    const ktree_node *n = ktree_node_at(&c->k->tree, at.live);
    for (int side = 0; side < 2; side++) {
        if (n->wall[side] == KTREE_NO_WALL) continue;
        if (!is_wall(c, n->segment, n->wall[side], &info.cut)) return false;
        push_pair_of_nodes(c, n->child[side], info.child[side]);
        info = froe_tree_node(c->tree, info.child[1 - side]);
    }
    if (c->vertices) {
        const now_segment *s = c->k->now.segments.data + n->segment;
        bool over = true; /* is the positive side of the cut above? */
        if (s->surface) {
            if (info.cut.kind != FROE_CUT_OBJECT || info.cut.id[0] != c->index[s->origin]) return false;
            over = now_area((now_state *)&c->k->now, s->origin) > 0;
        } else if (info.cut.kind != FROE_CUT_EDGE || !joins_corners(c, n->segment, info.cut.id[0], info.cut.id[1])) {
            return false;
        }
        push_pair_of_nodes(c, n->child[over ? KTREE_UP : KTREE_DOWN], info.child[1]);
        push_pair_of_nodes(c, n->child[over ? KTREE_DOWN : KTREE_UP], info.child[0]);
        return true;
    }
    const uint32_t object = c->index[n->segment], cut = info.cut.id[0];
    if (info.cut.kind != FROE_CUT_OBJECT || c->originals[cut] != c->originals[object]) return false;
    const bool reversed = snapshot_corner(c, cut, 0) != snapshot_corner(c, object, 0);
    const bool turned = c->k->now.segments.data[n->segment].turned != reversed;
    push_pair_of_nodes(c, n->child[turned ? KTREE_DOWN : KTREE_UP], info.child[1]);
    push_pair_of_nodes(c, n->child[turned ? KTREE_UP : KTREE_DOWN], info.child[0]);
    return true;
}

static froe_status compare_with_tree(const snapshot_work *p, const froe_tree *tree, bool *alike) {
    const froe_allocator *alloc = &p->k->call.alloc;
    const size_t all = kinetic_object_count(p->k), vertices = p->k->tree.vertices.count;
    snapshot_comparison c = {.k = p->k, .tree = tree, .scene = froe_tree_scene(tree)};
    c.index = support_calloc(alloc, all + 1, sizeof *c.index);
    c.originals = support_calloc(alloc, p->count + 1, sizeof *c.originals);
    if (p->dim == 3) c.vertices = support_calloc(alloc, vertices + 1, sizeof *c.vertices);
    c.short_of_memory =
        (p->dim == 3 && !c.vertices) || !c.index || !c.originals || scene_originals(c.scene, alloc, c.originals);
    for (uint32_t i = 0; i < p->count && !c.short_of_memory; i++) {
        c.index[p->objects[i]] = i;
        for (uint32_t e = 0; e < 3 && c.vertices; e++)
            c.vertices[p->k->now.motion->objects.data[p->objects[i]].vertices[e]] = snapshot_corner(&c, i, e);
    }
    if (!c.short_of_memory)
        push_pair_of_nodes(&c, ktree_node_at(&p->k->tree, KTREE_ROOT)->child[0], froe_tree_root(tree));
    *alike = true;
    while (c.stack.count && *alike && !c.short_of_memory) *alike = is_same(&c, c.stack.data[--c.stack.count]);
    array_free(alloc, &c.stack);
    if (c.vertices) support_free(alloc, c.vertices, (vertices + 1) * sizeof *c.vertices);
    support_free(alloc, c.index, (all + 1) * sizeof *c.index);
    support_free(alloc, c.originals, (p->count + 1) * sizeof *c.originals);
    return c.short_of_memory ? FROE_E_MEMORY : FROE_OK;
}

/* ---------------------------------------------------------------- snapshots -- */

static froe_status make_snapshot(snapshot_work *p, const froe_snapshot_options *o, froe_snapshot *out,
                                 froe_diagnostic *diag) {
    take_objects(p);
    if (!take_places(p)) return call_fail(&p->k->call, diag);
    if (o->refuse && p->rounded)
        return support_fail_at(diag, FROE_E_UNSUPPORTED, p->first_rounded, FROE_NONE, FROE_NONE,
                               "%s %u: It ends where no double is at this tick. %zu vertices would have to be rounded.",
                               motion_noun(p->k->now.motion), p->first_rounded, p->rounded);
    froe_status status = build_snapshot_tree(p, o->up, &out->tree, diag);
    if (status) return status;
    if (compare_with_tree(p, out->tree, &out->alike)) {
        froe_tree_free(out->tree);
        return support_fail_memory(diag);
    }
    out->rounded = p->rounded;
    out->places = p->places;
    p->places = NULL;
    return FROE_OK;
}

froe_status froe_kinetic_snapshot(froe_kinetic *k, const froe_snapshot_options *options, froe_snapshot *out,
                                  froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    const froe_snapshot_options standard = froe_snapshot_defaults(), *o = options ? options : &standard;
    if (!k || !out) return support_fail_null(diag, __func__);
    if (o->size != sizeof *o) return support_fail_defaults(diag, "froe_snapshot_defaults");
    snapshot_work p;
    froe_snapshot made = {0};
    froe_status status = kinetic_begin(k, diag);
    if (status) return status;
    status = snapshot_new(k, o->places, &p) ? make_snapshot(&p, o, &made, diag) : support_fail_memory(diag);
    if (!status) *out = made;
    snapshot_free(&p);
    return status;
}
