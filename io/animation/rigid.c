/* rigid.c: see rigid.h. */
#include "animation/rigid.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --------------------------------------------------------------------- matrices -- */

static void multiply_linear(const double a[9], const double b[9], double out[9]) {
    double r[9];
    for (int i = 0; i < 9; i++)
        r[i] = a[i / 3 * 3] * b[i % 3] + a[i / 3 * 3 + 1] * b[3 + i % 3] + a[i / 3 * 3 + 2] * b[6 + i % 3];
    memcpy(out, r, sizeof r);
}

static void apply_linear(const double a[9], const double v[3], double out[3]) {
    const double r[3] = {a[0] * v[0] + a[1] * v[1] + a[2] * v[2], a[3] * v[0] + a[4] * v[1] + a[5] * v[2],
                         a[6] * v[0] + a[7] * v[1] + a[8] * v[2]};
    memcpy(out, r, sizeof r);
}

static void linear_of_turn(const double q[4], double out[9]) {
    for (int c = 0; c < 3; c++) {
        const double unit[3] = {c == 0, c == 1, c == 2};
        double column[3];
        io_turn_apply(q, unit, column);
        for (int r = 0; r < 3; r++) out[3 * r + c] = column[r];
    }
}

/* The quaternion of a rotation, from the largest of its squares (Shepperd 1978). */
static void turn_of_linear(const double m[9], double q[4]) {
    const double trace = m[0] + m[4] + m[8],
                 four[4] = {m[0] - m[4] - m[8], m[4] - m[0] - m[8], m[8] - m[0] - m[4], trace};
    int most = 3;
    for (int k = 0; k < 3; k++)
        if (four[k] > four[most]) most = k;
    const int i = most, j = (i + 1) % 3, k = (i + 2) % 3;
    if (most == 3) {
        q[0] = m[7] - m[5], q[1] = m[2] - m[6], q[2] = m[3] - m[1], q[3] = 1 + trace;
    } else {
        q[i] = 1 + four[i], q[j] = m[3 * i + j] + m[3 * j + i], q[k] = m[3 * i + k] + m[3 * k + i];
        q[3] = m[3 * k + j] - m[3 * j + k];
    }
    if (!io_normalize(q, 4)) q[0] = q[1] = q[2] = 0, q[3] = 1;
}

/* The rotation Q and the number s whose product is nearest to a map, and how far it is from that, as a share of s. */
static double split_map(const double m[9], double *s, double q[4]) {
    const double determinant =
        m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
    double square = 0, scaled[9], back[9], apart = 0;
    for (int i = 0; i < 9; i++) square += m[i] * m[i];
    *s = (determinant < 0 ? -1 : 1) * sqrt(square / 3);
    q[0] = q[1] = q[2] = 0, q[3] = 1;
    if (*s == 0) return 0;
    for (int i = 0; i < 9; i++) scaled[i] = m[i] / *s;
    turn_of_linear(scaled, q);
    linear_of_turn(q, back);
    for (int i = 0; i < 9; i++) apart += (scaled[i] - back[i]) * (scaled[i] - back[i]);
    return sqrt(apart);
}

/* ----------------------------------------------------------------------- chains -- */

enum { TRACKS = 3 };

static const io_track *track_of(const io_channel *c, int i) {
    return i == 0 ? &c->place : i == 1 ? &c->turn : &c->scale;
}

static const double *rest_of(const io_channel *c, int i) {
    return i == 0 ? c->rest_place : i == 1 ? c->rest_turn : c->rest_scale;
}

/* A property at a time; at a jump it is what it jumps to. */
static void property_at(const io_animation *a, const io_channel *c, int i, double time, double *out) {
    const io_track *track = track_of(c, i);
    if (!track->count)
        memcpy(out, rest_of(c, i), (i == 1 ? 4 : 3) * sizeof *out);
    else
        io_track_at(a->numbers.data, track, io_track_piece(a->numbers.data, track, time), time, out);
}

static bool turns_change(const io_animation *a, const io_channel *c) {
    return c && c->turn.count && !io_track_rests(a->numbers.data, &c->turn);
}

bool io_channel_moves(const io_animation *a, const io_channel *c) {
    return turns_change(a, c) || (c->place.count && !io_track_rests(a->numbers.data, &c->place));
}

void io_channel_matrix(const io_animation *a, const io_channel *c, double out[12]) {
    double place[3], turn[4], scale[3], rotation[9];
    property_at(a, c, 0, -(double)INFINITY, place);
    property_at(a, c, 1, -(double)INFINITY, turn);
    property_at(a, c, 2, -(double)INFINITY, scale);
    linear_of_turn(turn, rotation);
    for (int r = 0; r < 3; r++) {
        for (int k = 0; k < 3; k++) out[4 * r + k] = rotation[3 * r + k] * scale[k];
        out[4 * r + 3] = place[r];
    }
}

froe_status io_channel_scale(const io_animation *a, const io_channel *c, const char *name, double *flaw) {
    const io_track *track = &c->scale;
    for (size_t i = 1; i < track->count; i++) {
        const double *first = io_track_value(a->numbers.data, track, 0),
                     *now = io_track_value(a->numbers.data, track, i);
        const double apart = io_track_apart(a->numbers.data, track, i), share = apart / io_length(first, 3);
        if (!(apart > 0)) continue;
        *flaw = fmax(*flaw, share);
        if (share <= 0x1p-10) continue;
        if (first[0] == now[0] && first[1] == now[1] && first[2] == now[2])
            return io_animation_fail(a, FROE_E_UNSUPPORTED, name,
                                     "Its scale changes along a spline before the time %.9g, and parts move as rigid "
                                     "bodies.",
                                     io_track_time(a->numbers.data, track, i));
        return io_animation_fail(a, FROE_E_UNSUPPORTED, name,
                                 "Its scale changes from %.4g %.4g %.4g to %.4g %.4g %.4g at the time %.9g, and parts "
                                 "move as rigid bodies.",
                                 first[0], first[1], first[2], now[0], now[1], now[2],
                                 io_track_time(a->numbers.data, track, i));
    }
    return FROE_OK;
}

static froe_status make_joint(const io_animation *a, const io_nodes *nodes, const io_channel *channel, size_t n,
                              io_joint *out, double *flaw) {
    const struct aiMatrix4x4 *t = &nodes->data[n].node->mTransformation;
    const double matrix[9] = {t->a1, t->a2, t->a3, t->b1, t->b2, t->b3, t->c1, t->c2, t->c3};
    double scale[3];
    *out = (io_joint){.channel = channel, .place = {t->a4, t->b4, t->c4}};
    memcpy(out->linear, matrix, sizeof matrix);
    if (channel) {
        property_at(a, channel, 2, -(double)INFINITY, scale);
        for (int i = 0; i < 9; i++) out->linear[i] = i % 4 ? 0 : scale[i / 4];
    }
    out->size = io_length(out->linear, 9);
    return channel ? io_channel_scale(a, channel, nodes->data[n].node->mName.data, flaw) : FROE_OK;
}

/* Maps above the last turn keep angles; the others, with their turns, are one. */
static froe_status join_maps(io_part *p, const io_nodes *nodes, const size_t *path, double begin) {
    double factor = 1, map[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, turn[4], rotation[9];
    for (size_t k = 0; k < p->joints.count; k++) {
        io_joint *j = p->joints.data + k;
        double s;
        if (k + 1 < p->turns) {
            const double apart = split_map(j->linear, &s, j->keeps);
            if (!(apart <= 0x1p-10))
                return io_animation_fail(
                    p->animation, FROE_E_UNSUPPORTED, nodes->data[path[k]].node->mName.data,
                    "It is scaled by different factors, and what turns below it is no rigid body.");
            factor *= s, j->size = fabs(s);
            p->flaw += apart;
            continue;
        }
        if (k >= p->turns && j->channel) {
            property_at(p->animation, j->channel, 1, begin, turn);
            linear_of_turn(turn, rotation);
            multiply_linear(map, rotation, map);
        }
        multiply_linear(map, j->linear, map);
    }
    for (int i = 0; i < 9; i++) p->constant[i] = factor * map[i];
    return FROE_OK;
}

froe_status io_part_make(const io_animation *animation, const io_nodes *nodes, const io_channel *const *channel_of,
                         size_t node, double begin, io_part *out) {
    const froe_allocator *alloc = &animation->sink->alloc;
    ARRAY(size_t) path = {0};
    *out = (io_part){.animation = animation};
    bool room = true;
    for (size_t n = node; n != SIZE_MAX && room; n = nodes->data[n].parent) room = array_push(alloc, &path, n);
    for (size_t i = 0; i < path.count / 2; i++) {
        const size_t other = path.data[i];
        path.data[i] = path.data[path.count - 1 - i], path.data[path.count - 1 - i] = other;
    }
    froe_status status = room ? FROE_OK : support_fail_memory(animation->sink->diag);
    for (size_t i = 0; i < path.count && !status; i++) {
        io_joint joint;
        double flaw = 0;
        status = make_joint(animation, nodes, channel_of[path.data[i]], path.data[i], &joint, &flaw);
        out->flaw += flaw;
        if (turns_change(animation, joint.channel)) out->turns = i + 1;
        if (!status && !array_push(alloc, &out->joints, joint)) status = support_fail_memory(animation->sink->diag);
    }
    if (!status) status = join_maps(out, nodes, path.data, begin);
    array_free(alloc, &path);
    return status;
}

void io_part_free(io_part *part) {
    if (part->animation) array_free(&part->animation->sink->alloc, &part->joints);
}

/* ------------------------------------------------------------------------ poses -- */

typedef struct part_pose {
    double place[3], turn[4];
} part_pose;

/* At a time from which `within` is not parted by a key: tracks are in the pieces of that time. */
static part_pose pose_at(const io_part *p, double time, double within) {
    const double *numbers = p->animation->numbers.data;
    part_pose pose = {.turn = {0, 0, 0, 1}};
    for (size_t k = p->joints.count; k-- > 0;) {
        const io_joint *j = p->joints.data + k;
        double place[3], turn[4] = {0, 0, 0, 1};
        memcpy(place, j->place, sizeof place);
        for (int i = 0; i < 2 && j->channel; i++) {
            const io_track *track = track_of(j->channel, i);
            double *to = i ? turn : place;
            if (track->count)
                io_track_at(numbers, track, io_track_piece(numbers, track, within), time, to);
            else
                memcpy(to, rest_of(j->channel, i), (i ? 4 : 3) * sizeof *to);
        }
        apply_linear(j->linear, pose.place, pose.place);
        io_turn_apply(turn, pose.place, pose.place);
        for (int i = 0; i < 3; i++) pose.place[i] += place[i];
        if (k + 1 < p->turns) io_turn_multiply(j->keeps, pose.turn, pose.turn);
        if (k < p->turns) io_turn_multiply(turn, pose.turn, pose.turn);
    }
    io_normalize(pose.turn, 4);
    return pose;
}

void io_part_pose(const io_part *part, double time, double place[3], double turn[4]) {
    const part_pose pose = pose_at(part, time, time);
    memcpy(place, pose.place, sizeof pose.place);
    memcpy(turn, pose.turn, sizeof pose.turn);
}

/* -------------------------------------------------------------------- deviation -- */

enum { SAMPLES = 32 };

/* How far the corners are apart in two poses: of the corners of the box around them the one that is farthest. */
static double apart_in(const io_part *p, const part_pose *a, const part_pose *b) {
    double most = 0;
    for (int corner = 0; corner < 8; corner++) {
        double at[3], x[3], y[3];
        for (int k = 0; k < 3; k++) at[k] = corner >> k & 1 ? p->hi[k] : p->lo[k];
        io_turn_apply(a->turn, at, x);
        io_turn_apply(b->turn, at, y);
        for (int k = 0; k < 3; k++) x[k] += a->place[k] - y[k] - b->place[k];
        most = fmax(most, io_length(x, 3));
    }
    return most;
}

static double reach_of(const io_part *p) {
    double most[3];
    for (int k = 0; k < 3; k++) most[k] = fmax(fabs(p->lo[k]), fabs(p->hi[k]));
    return io_length(most, 3);
}

/* Not less than the acceleration of any corner in the chain, and not less than what flaws of maps move it. */
static double bend_of(const io_part *p, double from, double to, double *flawed) {
    const double *numbers = p->animation->numbers.data, reach = reach_of(p);
    double spin = 0, bends = 0, at = 0, speed = 0, bend = 0;
    for (size_t k = p->joints.count; k-- > 0;) {
        const io_joint *j = p->joints.data + k;
        io_bounds place = {io_length(j->place, 3), 0, 0}, turn = {1, 0, 0};
        at *= j->size, speed *= j->size, bend *= j->size;
        if (j->channel) {
            const io_channel *c = j->channel;
            const double within = 0.5 * from + 0.5 * to;
            place = (io_bounds){io_length(c->rest_place, 3), 0, 0};
            if (c->place.count)
                place = io_track_bounds(numbers, &c->place, io_track_piece(numbers, &c->place, within), from, to);
            if (c->turn.count)
                turn = io_track_bounds(numbers, &c->turn, io_track_piece(numbers, &c->turn, within), from, to);
        }
        bend += (turn.speed * turn.speed + turn.bend) * at + 2 * turn.speed * speed + place.bend;
        speed += turn.speed * at + place.speed;
        at += place.most;
        spin += turn.speed, bends += turn.bend;
    }
    *flawed = p->flaw > 0 ? p->flaw * (reach + at) : 0;
    return bend + (1.5 * spin * spin + bends) * reach;
}

/* Does the body, straight and along its arc from one pose to the other, stay where the chain is? */
static bool stays(io_part *p, double from, double to, const part_pose *a, const part_pose *b) {
    double dot = 0, flawed, most = 0;
    for (int k = 0; k < 4; k++) dot += a->turn[k] * b->turn[k];
    const double sign = dot < 0 ? -1 : 1, cosine = fmin(fabs(dot), 1), span = to - from, step = span / SAMPLES;
    if (!(cosine >= 0.5)) return false;
    /* The angle along an arc: its first and second derivatives at most. */
    const double sine = sqrt((1 - cosine) * (1 + cosine)), least = 0.5 + 0.5 * cosine;
    const double spin = 2 * sine / least, twist = 4 * sine * (1 - cosine) / (least * least);
    const double own = (spin * spin + twist) * reach_of(p) / (span * span);
    const double bends = bend_of(p, from, to, &flawed) + own;
    if (!isfinite(bends)) return false;
    for (int i = 1; i < SAMPLES; i++) {
        const double share = (double)i / SAMPLES, time = from + share * span;
        const part_pose there = pose_at(p, time, 0.5 * from + 0.5 * to);
        part_pose here;
        for (int k = 0; k < 3; k++) here.place[k] = a->place[k] * (1 - share) + b->place[k] * share;
        for (int k = 0; k < 4; k++) here.turn[k] = a->turn[k] * (1 - share) + sign * b->turn[k] * share;
        io_normalize(here.turn, 4);
        most = fmax(most, apart_in(p, &there, &here));
    }
    most += bends * step * step / 8 + flawed;
    if (!(most <= p->tolerance)) return false;
    p->deviation = fmax(p->deviation, most);
    return true;
}

/* ------------------------------------------------------------------------ knots -- */

static int compare_times(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Keeps each of the times from `first` on once. */
static void sort_times(io_numbers *times, size_t first) {
    if (times->count == first) return;
    qsort(times->data + first, times->count - first, sizeof *times->data, compare_times);
    size_t kept = first + 1;
    for (size_t i = kept; i < times->count; i++)
        if (times->data[i] != times->data[kept - 1]) times->data[kept++] = times->data[i];
    times->count = kept;
}

/* Appends key times of the chain strictly between two, all of them or those of jumps. */
static bool gather_times(const io_part *p, double from, double to, bool jumps, io_numbers *out) {
    const double *numbers = p->animation->numbers.data;
    for (size_t k = 0; k < p->joints.count; k++)
        for (int i = 0; i < 2 && p->joints.data[k].channel; i++) {
            const io_track *track = track_of(p->joints.data[k].channel, i);
            for (size_t key = 0; key < track->count; key++) {
                const double time = io_track_time(numbers, track, key);
                if (!(time > from && time < to) || (jumps && !io_track_jumps(numbers, track, key))) continue;
                if (!array_push(&p->animation->sink->alloc, out, time)) return false;
            }
        }
    return true;
}

bool io_part_jumps(const io_part *part, double from, double to, io_numbers *out) {
    const size_t first = out->count;
    const bool room = gather_times(part, from, to, true, out);
    sort_times(out, first);
    return room;
}

static bool put_knot(const io_part *p, double time, const part_pose *pose, io_numbers *out) {
    const froe_allocator *alloc = &p->animation->sink->alloc;
    return array_push(alloc, out, time) && array_append(alloc, out, pose->place, 3) &&
           array_append(alloc, out, pose->turn, 4);
}

/* One piece between two keys, in halves of halves where it has to be: `ends` of those to come, the next one last. */
static froe_status follow_piece(io_part *p, double from, double to, io_numbers *ends, io_numbers *out) {
    enum { DEEPEST = 40 };
    const double within = 0.5 * from + 0.5 * to;
    const froe_allocator *alloc = &p->animation->sink->alloc;
    part_pose here = pose_at(p, from, within);
    bool room = array_push(alloc, ends, to);
    while (room && ends->count) {
        const double next = ends->data[ends->count - 1];
        const part_pose there = pose_at(p, next, within);
        if (stays(p, from, next, &here, &there)) {
            room = put_knot(p, next, &there, out);
            from = next, here = there;
            ends->count--;
            continue;
        }
        const double middle = 0.5 * from + 0.5 * next;
        if (ends->count > DEEPEST || !(middle > from && middle < next))
            return support_fail(p->animation->sink->diag, FROE_E_LIMIT,
                                "%s: animation '%.40s': At the time %.9g a deviation of %.3g cannot be kept.",
                                support_short(p->animation->sink->path), p->animation->name, from, p->tolerance);
        if (!p->halvings)
            return support_fail(p->animation->sink->diag, FROE_E_LIMIT,
                                "%s: animation '%.40s': At the time %.9g a deviation of %.3g is not reached by %d "
                                "halvings of pieces.",
                                support_short(p->animation->sink->path), p->animation->name, from, p->tolerance,
                                IO_HALVINGS);
        p->halvings--;
        room = array_push(alloc, ends, middle);
    }
    return room ? FROE_OK : support_fail_memory(p->animation->sink->diag);
}

froe_status io_part_follow(io_part *part, double from, double to, io_numbers *out) {
    const froe_allocator *alloc = &part->animation->sink->alloc;
    io_numbers keys = {0}, ends = {0};
    bool room =
        array_push(alloc, &keys, from) && array_push(alloc, &keys, to) && gather_times(part, from, to, false, &keys);
    froe_status status = FROE_OK;
    if (room) {
        sort_times(&keys, 0);
        const part_pose first = pose_at(part, from, 0.5 * from + 0.5 * keys.data[1]);
        room = put_knot(part, from, &first, out);
    }
    for (size_t i = 0; i + 1 < keys.count && room && !status; i++) {
        ends.count = 0;
        status = follow_piece(part, keys.data[i], keys.data[i + 1], &ends, out);
    }
    array_free(alloc, &keys), array_free(alloc, &ends);
    return room ? status : support_fail_memory(part->animation->sink->diag);
}
