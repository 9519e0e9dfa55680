/* read_animation.c: froe_read_animation: the nodes of a model that an animation moves become rigid bodies, and all
 * others one body that stands still. */
#include "animation/rigid.h"
#include "formats/input/bodies.h"
#include "support/axes.h"
#include "support/floats.h"
#include <math.h>
#include <string.h>

/* What a reader gets with its options: they are its first member. */
typedef struct moving_model {
    froe_read_options options;
    const froe_motion_read_options *asked;
    froe_motion_options window;
    io_animation animation;
    io_nodes nodes;
    ARRAY(const io_channel *) channel_of; /* of each node, or NULL */
    ARRAY(size_t) owner;                  /* of each node: the last node that moves on the way to it, or SIZE_MAX */
    ARRAY(uint32_t) part_of;              /* of each node: 0: it stands still; of others and below: i + 1 */
    ARRAY(io_part) parts;
    froe_motion_report report;
    size_t halvings; /* that are left */
    double flaw;     /* by what share of them scales of nodes that rest change at most */
    /* the motion */
    ARRAY(formats_life) lives;
    ARRAY(size_t) starts;
    ARRAY(uint32_t) parts_of_objects;
} moving_model;

static froe_status no_memory(const moving_model *m) {
    return support_fail_memory(m->animation.sink->diag);
}

/* ---------------------------------------------------------------------- reading -- */

/* The window that is asked for, or from the first key to the last. */
static froe_status find_window(moving_model *m) {
    const io_animation *a = &m->animation;
    double first = (double)INFINITY, last = -(double)INFINITY;
    for (size_t i = 0; i < a->channels.count; i++) {
        const io_channel *c = a->channels.data + i;
        const io_track *const tracks[] = {&c->place, &c->turn, &c->scale};
        for (int k = 0; k < 3; k++) {
            if (!tracks[k]->count) continue;
            first = fmin(first, io_track_time(a->numbers.data, tracks[k], 0));
            last = fmax(last, io_track_time(a->numbers.data, tracks[k], tracks[k]->count - 1));
        }
    }
    if (!(first < last) && (isnan(m->asked->from) || isnan(m->asked->to)))
        return support_fail(a->sink->diag, FROE_E_INPUT,
                            "%s: animation '%.40s': It has no two keys at different times.",
                            support_short(a->sink->path), a->name);
    m->window = froe_motion_defaults();
    m->window.dim = 3;
    m->window.begin = isnan(m->asked->from) ? first : m->asked->from;
    m->window.end = isnan(m->asked->to) ? last : m->asked->to;
    return FROE_OK;
}

static froe_status refuse_skins(const moving_model *m, const struct aiScene *scene) {
    for (size_t n = 0; n < m->nodes.count; n++) {
        const struct aiNode *node = m->nodes.data[n].node;
        for (unsigned i = 0; i < node->mNumMeshes; i++)
            if (node->mMeshes[i] < scene->mNumMeshes && scene->mMeshes[node->mMeshes[i]]->mNumBones)
                return io_animation_fail(&m->animation, FROE_E_UNSUPPORTED, node->mName.data,
                                         "It is skinned, and parts move as rigid bodies.");
    }
    return FROE_OK;
}

/* Which nodes move, and which belong to them. */
static froe_status find_owners(moving_model *m) {
    const froe_allocator *alloc = &m->animation.sink->alloc;
    const size_t count = m->nodes.count;
    if (!array_reserve(alloc, &m->channel_of, count) || !array_reserve(alloc, &m->owner, count) ||
        !array_reserve(alloc, &m->part_of, count))
        return no_memory(m);
    for (size_t n = 0; n < count; n++) m->channel_of.data[n] = NULL, m->part_of.data[n] = 0;
    for (size_t i = 0; i < m->animation.channels.count; i++)
        m->channel_of.data[m->animation.channels.data[i].node] = m->animation.channels.data + i;
    for (size_t n = 0; n < count; n++) {
        const io_channel *c = m->channel_of.data[n];
        const size_t parent = m->nodes.data[n].parent;
        m->owner.data[n] = c && io_channel_moves(&m->animation, c) ? n
                           : parent == SIZE_MAX                    ? SIZE_MAX
                                                                   : m->owner.data[parent];
    }
    return FROE_OK;
}

/* Of nodes that stand or rest in a part, and have meshes, themselves or below: their scale is that of the first key. */
static froe_status check_scales(moving_model *m) {
    const size_t count = m->nodes.count;
    ARRAY(bool) carries = {0};
    if (!array_reserve(&m->animation.sink->alloc, &carries, count)) return no_memory(m);
    froe_status status = FROE_OK;
    for (size_t n = 0; n < count; n++) carries.data[n] = m->nodes.data[n].node->mNumMeshes > 0;
    for (size_t n = count; n-- > 0;)
        if (carries.data[n] && m->nodes.data[n].parent != SIZE_MAX) carries.data[m->nodes.data[n].parent] = true;
    for (size_t n = 0; n < count && !status; n++)
        if (carries.data[n] && m->channel_of.data[n] && m->owner.data[n] != n)
            status =
                io_channel_scale(&m->animation, m->channel_of.data[n], m->nodes.data[n].node->mName.data, &m->flaw);
    array_free(&m->animation.sink->alloc, &carries);
    return status;
}

/* A part for each node that moves and carries meshes, itself or below. */
static froe_status make_parts(moving_model *m) {
    for (size_t n = 0; n < m->nodes.count; n++) {
        const size_t owner = m->owner.data[n];
        const bool carries = m->nodes.data[n].node->mNumMeshes > 0;
        m->report.still += carries && owner == SIZE_MAX;
        if (!carries || owner == SIZE_MAX || m->part_of.data[owner]) continue;
        io_part part;
        const froe_status status =
            io_part_make(&m->animation, &m->nodes, m->channel_of.data, owner, m->window.begin, &part);
        if (status || !array_push(&m->animation.sink->alloc, &m->parts, part)) {
            io_part_free(&part);
            return status ? status : no_memory(m);
        }
        m->part_of.data[owner] = (uint32_t)m->parts.count;
        m->report.features++;
    }
    if (m->parts.count) return FROE_OK;
    return support_fail(m->animation.sink->diag, FROE_E_INPUT,
                        "%s: animation '%.40s': It moves nothing that has faces.",
                        support_short(m->animation.sink->path), m->animation.name);
}

/* From the meshes of each node to its body. */
static void place_nodes(moving_model *m) {
    for (size_t n = 0; n < m->nodes.count; n++) {
        static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
        io_node *node = m->nodes.data + n;
        const struct aiMatrix4x4 *t = &node->node->mTransformation;
        double own[12] = {t->a1, t->a2, t->a3, t->a4, t->b1, t->b2, t->b3, t->b4, t->c1, t->c2, t->c3, t->c4};
        const size_t owner = m->owner.data[n];
        if (owner == n) {
            const io_part *part = m->part_of.data[n] ? m->parts.data + m->part_of.data[n] - 1 : NULL;
            for (int i = 0; i < 12; i++) node->at[i] = i % 4 == 3 || !part ? 0 : part->constant[i / 4 * 3 + i % 4];
            continue;
        }
        if (m->channel_of.data[n]) io_channel_matrix(&m->animation, m->channel_of.data[n], own);
        io_matrix_multiply(node->parent == SIZE_MAX ? identity : m->nodes.data[node->parent].at, own, node->at);
        if (owner != SIZE_MAX) m->part_of.data[n] = m->part_of.data[owner];
    }
}

static froe_status arrange(void *user, const formats_source *source, formats_sink *sink, const struct aiScene *scene,
                           io_nodes *nodes) {
    moving_model *m = user;
    m->animation.source = source, m->animation.sink = sink;
    froe_status status = io_is_gltf(source) ? io_animation_of_gltf(&m->animation, nodes)
                                            : io_animation_of_assimp(&m->animation, scene, nodes);
    if (!status) status = io_animation_check(&m->animation, nodes);
    if (!status) status = refuse_skins(m, scene);
    if (!status) status = find_window(m);
    if (!status) status = find_owners(m);
    if (!status) status = check_scales(m);
    if (!status) status = make_parts(m);
    if (!status) place_nodes(m);
    return status;
}

static froe_status read_moving(const formats_source *source, formats_sink *sink) {
    moving_model *m = (moving_model *)(uintptr_t)source->options;
    if (!io_assimp_recognise(source))
        return support_fail(sink->diag, FROE_E_UNSUPPORTED, "%s: The file is of no type that has animations.",
                            support_short(sink->path));
    return io_read_arranged(source, sink, &m->nodes, arrange, m);
}

static formats_reader *choose_moving(const formats_source *source) {
    (void)source;
    return read_moving;
}

/* ----------------------------------------------------------------------- motion -- */

/* Which part each object belongs to, the boxes of parts, and the size of the model when the window begins. */
static froe_status measure_parts(moving_model *m, const froe_scene *scene) {
    const uint32_t objects = (uint32_t)froe_scene_object_count(scene);
    double lo[3], hi[3];
    if (!array_reserve(&m->animation.sink->alloc, &m->parts_of_objects, objects)) return no_memory(m);
    for (int k = 0; k < 3; k++) lo[k] = (double)INFINITY, hi[k] = -(double)INFINITY;
    for (size_t p = 0; p < m->parts.count; p++)
        for (int k = 0; k < 3; k++)
            m->parts.data[p].lo[k] = (double)INFINITY, m->parts.data[p].hi[k] = -(double)INFINITY;
    for (size_t n = 0; n < m->nodes.count; n++) {
        const size_t end = n + 1 < m->nodes.count ? m->nodes.data[n + 1].first : objects;
        io_part *part = m->part_of.data[n] ? m->parts.data + m->part_of.data[n] - 1 : NULL;
        double place[3] = {0, 0, 0}, turn[4] = {0, 0, 0, 1};
        if (part) io_part_pose(part, m->window.begin, place, turn);
        for (size_t i = m->nodes.data[n].first; i < end; i++) {
            const uint32_t corners = froe_scene_object(scene, (uint32_t)i).corners;
            m->parts_of_objects.data[i] = m->part_of.data[n];
            for (uint32_t c = 0; c < corners; c++) {
                const double *at = froe_scene_vertex(scene, froe_scene_corner(scene, (uint32_t)i, c));
                double there[3];
                io_turn_apply(turn, at, there);
                for (int k = 0; k < 3; k++) {
                    lo[k] = fmin(lo[k], there[k] + place[k]), hi[k] = fmax(hi[k], there[k] + place[k]);
                    if (part) part->lo[k] = fmin(part->lo[k], at[k]), part->hi[k] = fmax(part->hi[k], at[k]);
                }
            }
        }
    }
    m->report.extent = support_length((const double[]){hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]});
    return FROE_OK;
}

/* A body for what is in `knots`, or one that stands at the origin. */
static froe_status add_knots(moving_model *m, froe_motion *motion, const io_numbers *knots, formats_life *life) {
    static const double still[8] = {0, 0, 0, 0, 0, 0, 0, 1};
    const size_t count = knots ? knots->count / 8 : 1;
    const double *from = knots ? knots->data : still;
    const froe_allocator *alloc = &m->animation.sink->alloc;
    froe_diagnostic why;
    io_numbers arrays = {0};
    if (!array_reserve(alloc, &arrays, 8 * count)) return no_memory(m);
    double *times = arrays.data, *places = times + count, *turns = places + 3 * count;
    for (size_t i = 0; i < count; i++) {
        times[i] = from[8 * i];
        memcpy(places + 3 * i, from + 8 * i + 1, 3 * sizeof *places);
        memcpy(turns + 4 * i, from + 8 * i + 4, 4 * sizeof *turns);
    }
    froe_body body = froe_body_defaults();
    body.count = count, body.times = times, body.coords = places, body.turns = turns;
    froe_status status = froe_motion_add_body(motion, &body, &life->body, &why);
    array_free(alloc, &arrays);
    m->report.pieces += count - 1;
    if (status == FROE_E_MEMORY) return no_memory(m);
    return status ? support_fail(m->animation.sink->diag, status, "%s: %s", support_short(m->animation.sink->path),
                                 why.message)
                  : FROE_OK;
}

/* The lives of a part: from jump to jump. */
static froe_status add_lives(moving_model *m, froe_motion *motion, io_part *part) {
    const froe_allocator *alloc = &m->animation.sink->alloc;
    io_numbers ends = {0}, knots = {0};
    part->tolerance = m->asked->deviation * m->report.extent;
    part->halvings = m->halvings;
    bool room = array_push(alloc, &ends, m->window.begin) &&
                io_part_jumps(part, m->window.begin, m->window.end, &ends) && array_push(alloc, &ends, m->window.end);
    froe_status status = FROE_OK;
    for (size_t i = 0; i + 1 < ends.count && room && !status; i++) {
        formats_life life = {.birth = i ? ends.data[i] : -(double)INFINITY,
                             .death = i + 2 < ends.count ? ends.data[i + 1] : (double)INFINITY};
        knots.count = 0;
        status = io_part_follow(part, ends.data[i], ends.data[i + 1], &knots);
        if (!status) status = add_knots(m, motion, &knots, &life);
        if (!status) room = array_push(alloc, &m->lives, life);
        m->report.jumps += i > 0;
    }
    array_free(alloc, &ends), array_free(alloc, &knots);
    m->report.deviation = fmax(m->report.deviation, part->deviation);
    m->halvings = part->halvings;
    return room ? status : no_memory(m);
}

static froe_status make_motion(moving_model *m, const froe_scene *scene, froe_motion **out) {
    const froe_allocator *alloc = &m->animation.sink->alloc;
    formats_life still = {.birth = -(double)INFINITY, .death = (double)INFINITY};
    froe_diagnostic why;
    froe_status status = froe_motion_new(&m->window, m->asked->alloc, out, &why);
    if (status == FROE_E_MEMORY) return no_memory(m);
    if (status)
        return support_fail(m->animation.sink->diag, status, "%s: %s", support_short(m->animation.sink->path),
                            why.message);
    status = measure_parts(m, scene);
    if (!status) status = add_knots(m, *out, NULL, &still);
    bool room = array_push(alloc, &m->starts, 0) && array_push(alloc, &m->lives, still);
    for (size_t p = 0; p < m->parts.count && room && !status; p++) {
        const size_t first = m->lives.count;
        room = array_push(alloc, &m->starts, first);
        if (room) status = add_lives(m, *out, m->parts.data + p);
    }
    m->report.deviation += m->flaw * m->report.extent;
    const size_t lives = m->lives.count;
    room = room && array_push(alloc, &m->starts, lives);
    if (status || !room) return status ? status : no_memory(m);
    const formats_bodies bodies = {m->starts.data, m->lives.data, m->parts_of_objects.data};
    status = formats_add_bodies(*out, scene, &bodies, alloc, &why);
    if (status == FROE_E_MEMORY) return no_memory(m);
    return status ? support_fail(m->animation.sink->diag, status, "%s: %s", support_short(m->animation.sink->path),
                                 why.message)
                  : FROE_OK;
}

static void free_model(moving_model *m, const froe_allocator *alloc) {
    for (size_t p = 0; p < m->parts.count; p++) io_part_free(m->parts.data + p);
    array_free(alloc, &m->nodes), array_free(alloc, &m->channel_of), array_free(alloc, &m->owner);
    array_free(alloc, &m->part_of), array_free(alloc, &m->parts), array_free(alloc, &m->lives);
    array_free(alloc, &m->starts), array_free(alloc, &m->parts_of_objects);
    array_free(alloc, &m->animation.numbers), array_free(alloc, &m->animation.channels);
}

froe_status froe_read_animation(const char *path, const froe_motion_read_options *options, froe_motion **out,
                                froe_motion_report *report, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    static const formats_readers readers = {.choose = choose_moving};
    const froe_motion_read_options standard = froe_motion_read_defaults();
    if (!path || !out) return support_fail_null(diag, __func__);
    if (options && options->size != sizeof *options) return support_fail_defaults(diag, "froe_motion_read_defaults");
    moving_model m = {.options = froe_read_defaults(), .asked = options ? options : &standard, .halvings = IO_HALVINGS};
    if (!(m.asked->deviation > 0) || !isfinite(m.asked->deviation))
        return support_fail(diag, FROE_E_OPTIONS, "The deviation of an animation, %g, is not above 0.",
                            m.asked->deviation);
    const double start = formats_seconds();
    const froe_allocator alloc = support_allocator(m.asked->alloc);
    m.animation.asked = m.asked->animation;
    m.options.name = m.asked->name ? m.asked->name : path;
    m.options.image = io_read_image;
    m.options.alloc = m.asked->alloc;
    froe_scene *scene = NULL;
    froe_motion *motion = NULL;
    froe_read_report read;
    froe_status status = formats_read(&readers, path, &m.options, &scene, &read, diag);
    formats_sink sink = {.alloc = alloc, .diag = diag, .path = m.options.name}; /* that of the reader is gone */
    m.animation.sink = &sink;
    if (!status) m.report.up = froe_scene_up(scene), status = make_motion(&m, scene, &motion);
    froe_scene_free(scene);
    free_model(&m, &alloc);
    if (status) {
        froe_motion_free(motion);
        return status;
    }
    m.report.seconds = formats_seconds() - start;
    if (report) *report = m.report;
    *out = motion;
    return FROE_OK;
}
