/* animation.h: which nodes of a model an animation moves, and how. It speaks for channels.c, which takes the keys that
 * assimp has, and for gltf.c, which reads those of glTF itself: assimp 5.2 hands over neither what is between them nor
 * tangents, has nodes by their names alone, which need not differ, and rounds times. */
#ifndef FROE_IO_ANIMATION_H
#define FROE_IO_ANIMATION_H
#include "animation/track.h"
#include "assimp_nodes.h"
#include "check/check.h"

/** A node and its three properties. One without keys is as it is at rest. */
typedef struct io_channel {
    size_t node; /**< of the list of nodes */
    io_track place, turn, scale;
    double rest_place[3], rest_turn[4], rest_scale[3];
} io_channel;

typedef struct io_animation {
    const formats_source *source;
    formats_sink *sink; /**< for memory and messages */
    const char *asked;  /**< the name or number of the one that is wanted; NULL: the only one */
    char name[64];      /**< of the one that was found */
    io_numbers numbers;
    ARRAY(io_channel) channels; /**< of different nodes */
} io_animation;

/** Fill in the name and the channels. FROE_E_INPUT: there is no animation. FROE_E_OPTIONS: there is no such one, or
 * several and none is asked for. FROE_E_FORMAT, FROE_E_UNSUPPORTED: meshes change their shape. FROE_E_MEMORY. */
froe_status io_animation_of_assimp(io_animation *animation, const struct aiScene *scene, const io_nodes *nodes);
froe_status io_animation_of_gltf(io_animation *animation, const io_nodes *nodes);

/** Refuses keys that are none, and makes turns as long as 1, but for those of splines. FROE_E_INPUT: times that do not
 * increase, numbers that are not finite, a quaternion whose length is not 1. */
froe_status io_animation_check(io_animation *animation, const io_nodes *nodes);

/** The i-th of `count` names that `asked` means; SIZE_MAX: the failure of the first function above. */
typedef const char *io_name_fn(const void *user, size_t i);
froe_status io_animation_choose(io_animation *animation, size_t count, io_name_fn *name, const void *user, size_t *out);
/** A failure of a channel: names file, animation and node before the sentence. */
froe_status io_animation_fail(const io_animation *animation, froe_status status, const char *node, const char *sentence,
                              ...) __attribute__((format(printf, 4, 5)));
#endif
