/* channels.c: the keys of an animation as assimp has them, which one is meant, and what keys may be. */
#include "animation/animation.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

froe_status io_animation_fail(const io_animation *animation, froe_status status, const char *node, const char *sentence,
                              ...) {
    char own_sentence[200];
    va_list args;
    va_start(args, sentence);
    vsnprintf(own_sentence, sizeof own_sentence, sentence, args);
    va_end(args);
    return support_fail(animation->sink->diag, status, "%s: animation '%.40s': node '%.40s': %s",
                        support_short(animation->sink->path), animation->name, node, own_sentence);
}

/* --------------------------------------------------------------------- which one -- */

froe_status io_animation_choose(io_animation *animation, size_t count, io_name_fn *name, const void *user,
                                size_t *out) {
    const char *path = support_short(animation->sink->path), *asked = animation->asked;
    char names[120] = "";
    size_t used = 0;
    if (!count) return support_fail(animation->sink->diag, FROE_E_INPUT, "%s: The model has no animation.", path);
    *out = asked ? count : 0;
    for (size_t i = 0; i < count && asked && *out == count; i++)
        if (!strcmp(name(user, i), asked)) *out = i;
    char *end = NULL;
    const unsigned long number = asked ? strtoul(asked, &end, 10) : 0;
    if (asked && *out == count && *asked >= '0' && *asked <= '9' && !*end && number < count) *out = number;
    for (size_t i = 0; i < count && used + 1 < sizeof names; i++) {
        const int length = snprintf(names + used, sizeof names - used, "%s'%.30s'", i ? ", " : "", name(user, i));
        used += length > 0 ? (size_t)length : 0;
    }
    if (*out == count)
        return support_fail(animation->sink->diag, FROE_E_OPTIONS, "%s: There is no animation '%.40s'. There are: %s.",
                            path, asked, names);
    if (!asked && count > 1)
        return support_fail(animation->sink->diag, FROE_E_OPTIONS,
                            "%s: There are several animations, and one has to be named: %s.", path, names);
    snprintf(animation->name, sizeof animation->name, "%.60s", name(user, *out));
    return FROE_OK;
}

/* ----------------------------------------------------------------------- its keys -- */

static froe_status check_track(io_animation *a, io_track *track, const char *node) {
    double *numbers = a->numbers.data;
    const size_t each = io_track_each(track);
    for (size_t i = 0; i < track->count; i++) {
        const double time = io_track_time(numbers, track, i);
        if (!isfinite(time)) return io_animation_fail(a, FROE_E_INPUT, node, "Time %zu is not finite.", i);
        if (i && !(time > io_track_time(numbers, track, i - 1)))
            return io_animation_fail(a, FROE_E_INPUT, node, "Time %zu, %.9g, is not after time %zu, %.9g.", i, time,
                                     i - 1, io_track_time(numbers, track, i - 1));
    }
    double *values = numbers + track->first + track->count;
    for (size_t i = 0; i < track->count; i++) {
        for (size_t k = 0; k < each; k++)
            if (!isfinite(values[each * i + k]))
                return io_animation_fail(a, FROE_E_INPUT, node, "A number at time %zu is not finite.", i);
        if (track->width < 4) continue;
        double *turn = values + each * i + (each - 4) / 2, square = 0;
        for (int k = 0; k < 4; k++) square += turn[k] * turn[k];
        if (!(fabs(square - 1) <= 0x1.1p-6)) /* four halves rounded to bytes, 64 / 127, have the square 1 + 0x1.03p-6 */
            return io_animation_fail(a, FROE_E_INPUT, node,
                                     "The quaternion at time %zu, %.4g %.4g %.4g %.4g, does not have the length 1.", i,
                                     turn[0], turn[1], turn[2], turn[3]);
        if (each == 4) io_normalize(turn, 4);
    }
    return FROE_OK;
}

froe_status io_animation_check(io_animation *animation, const io_nodes *nodes) {
    froe_status status = FROE_OK;
    for (size_t i = 0; i < animation->channels.count && !status; i++) {
        io_channel *c = animation->channels.data + i;
        const char *name = nodes->data[c->node].node->mName.data;
        io_track *const tracks[] = {&c->place, &c->turn, &c->scale};
        for (int k = 0; k < 3 && !status; k++) status = check_track(animation, tracks[k], name);
        double square = 0;
        for (int k = 0; k < 4; k++) square += c->rest_turn[k] * c->rest_turn[k];
        if (!status && !c->turn.count && !(fabs(square - 1) <= 0x1p-10))
            status = io_animation_fail(animation, FROE_E_INPUT, name,
                                       "The quaternion of its rotation does not have the length 1.");
        io_normalize(c->rest_turn, 4);
    }
    return status;
}

/* --------------------------------------------------------------- of assimp's scene -- */

static const char *name_of_assimp(const void *user, size_t i) {
    const struct aiScene *scene = user;
    return scene->mAnimations[i]->mName.data;
}

/* Keys of vectors and of quaternions have the time first. */
static bool put_vectors(io_animation *a, const struct aiVectorKey *keys, unsigned count, double second, io_track *out) {
    *out = (io_track){IO_LINEAR, 3, count, a->numbers.count};
    if (!array_reserve(&a->sink->alloc, &a->numbers, 4 * (size_t)count)) return false;
    double *times = a->numbers.data + a->numbers.count, *values = times + count;
    for (unsigned i = 0; i < count; i++) {
        const double value[3] = {keys[i].mValue.x, keys[i].mValue.y, keys[i].mValue.z};
        times[i] = keys[i].mTime / second;
        memcpy(values + 3 * (size_t)i, value, sizeof value);
    }
    a->numbers.count += 4 * (size_t)count;
    return true;
}

static bool put_turns(io_animation *a, const struct aiQuatKey *keys, unsigned count, double second, io_track *out) {
    *out = (io_track){IO_LINEAR, 4, count, a->numbers.count};
    if (!array_reserve(&a->sink->alloc, &a->numbers, 5 * (size_t)count)) return false;
    double *times = a->numbers.data + a->numbers.count, *values = times + count;
    for (unsigned i = 0; i < count; i++) {
        const double value[4] = {keys[i].mValue.x, keys[i].mValue.y, keys[i].mValue.z, keys[i].mValue.w};
        times[i] = keys[i].mTime / second;
        memcpy(values + 4 * (size_t)i, value, sizeof value);
    }
    a->numbers.count += 5 * (size_t)count;
    return true;
}

froe_status io_animation_of_assimp(io_animation *a, const struct aiScene *scene, const io_nodes *nodes) {
    size_t chosen = 0;
    const froe_status status = io_animation_choose(a, scene->mNumAnimations, name_of_assimp, scene, &chosen);
    if (status) return status;
    const struct aiAnimation *animation = scene->mAnimations[chosen];
    const double second = animation->mTicksPerSecond > 0 ? animation->mTicksPerSecond : 1;
    if (animation->mNumMeshChannels || animation->mNumMorphMeshChannels)
        return support_fail(a->sink->diag, FROE_E_UNSUPPORTED,
                            "%s: animation '%.40s': It changes the shape of meshes, and parts move as rigid bodies.",
                            support_short(a->sink->path), a->name);
    for (unsigned i = 0; i < animation->mNumChannels; i++) {
        const struct aiNodeAnim *from = animation->mChannels[i];
        io_channel channel = {.node = nodes->count, .rest_turn = {0, 0, 0, 1}, .rest_scale = {1, 1, 1}};
        size_t found = 0;
        for (size_t n = 0; n < nodes->count; n++)
            if (!strcmp(nodes->data[n].node->mName.data, from->mNodeName.data)) channel.node = n, found++;
        if (found != 1)
            return io_animation_fail(a, FROE_E_INPUT, from->mNodeName.data,
                                     found ? "Several nodes have this name." : "The model has no such node.");
        if (!put_vectors(a, from->mPositionKeys, from->mNumPositionKeys, second, &channel.place) ||
            !put_turns(a, from->mRotationKeys, from->mNumRotationKeys, second, &channel.turn) ||
            !put_vectors(a, from->mScalingKeys, from->mNumScalingKeys, second, &channel.scale) ||
            !array_push(&a->sink->alloc, &a->channels, channel))
            return support_fail_memory(a->sink->diag);
    }
    return FROE_OK;
}
