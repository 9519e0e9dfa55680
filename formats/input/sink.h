/* sink.h: the objects of readers and generators, gathered in batches, in order, which
 * froe_scene_add gets. */
#ifndef FROE_FORMATS_SINK_H
#define FROE_FORMATS_SINK_H

#include "support/array.h"
#include "support/fail.h"
#include <froe/formats.h>

typedef struct formats_bounds {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    bool any; /**< they hold something */
} formats_bounds;

typedef struct formats_sink {
    /* set by the owner before formats_sink_open() */
    froe_allocator alloc;
    froe_diagnostic *diag;      /**< may be NULL */
    const char *path;           /**< for messages */
    froe_faces faces;           /**< what formats_sink_face() does */
    bool boxes;                 /**< one bounding box per feature instead of the objects */
    bool halves;                /**< two, of x <= 0 and of x >= 0, where one would be wider than 180 */
    froe_progress_fn *progress; /**< may be NULL */
    void *user;
    froe_image_fn *image; /**< may be NULL */
    void *image_user;
    froe_objects_fn *deliver; /**< receives batches in the place of the scene; NULL: none */
    void *deliver_user;
    froe_read_report report; /**< counts */

    /* of the objects to come; readers write them, formats_sink_feature() resets them */
    uint32_t group;
    uint64_t tag;
    bool tagged;          /**< use `tag`; otherwise each object's own id */
    uint32_t face;        /**< FROE_NONE: each object its own */
    ARRAY(double) points; /**< that faces name, dim numbers each; readers append to it */
    const char *unit;     /**< "feature", "row", "face", ... for messages */
    const char *inside;   /**< name of the layer, node or group it is in; NULL: none */
    bool guessed;         /**< that coordinates are degrees: it is believed if all of them can be some */
    bool promised;        /**< the same by a rule of the format: it is told where they cannot be */
    uint64_t number;      /**< of the unit, as the file counts */

    /* private */
    froe_scene *scene;
    int dim;
    froe_kind kind; /**< of the batch */
    bool indexed;   /**< its corners are indices of points */
    size_t count;   /**< objects in the batch */
    size_t total;   /**< objects so far, batch included: the next id */
    ARRAY(double) coords, radii, gathered;
    ARRAY(uint32_t) indices;
    ARRAY(size_t) starts;
    ARRAY(uint32_t) object_faces, groups;
    ARRAY(uint64_t) tags;
    formats_bounds bounds, half[2]; /**< of the feature, and of its parts */
} formats_sink;

/** Makes the scene. FROE_E_MEMORY. */
froe_status formats_sink_open(formats_sink *sink, int dim);
/** Frees everything, the scene included unless it was taken. */
void formats_sink_free(formats_sink *sink);
/** Hands over the last batch, then the scene, which the caller owns from now on. */
froe_status formats_sink_take(formats_sink *sink, froe_scene **scene);

/** Which axis of space points up, after formats_sink_open(); z if it is not said. */
void formats_sink_up(formats_sink *sink, int axis);
/** The coordinate system of the scene, after formats_sink_open(). FROE_E_MEMORY, FROE_E_LIMIT. */
froe_status formats_sink_crs(formats_sink *sink, const froe_crs *crs);
/** Begins a feature: ends the one before. */
froe_status formats_sink_feature(formats_sink *sink, uint64_t number);
/** Ends the feature (with `boxes`: adds its box). */
froe_status formats_sink_end_feature(formats_sink *sink);
/** A new group becomes the group of the objects to come. */
froe_status formats_sink_group(formats_sink *sink, const froe_group *group);
/** Objects to come belong to one source polygon, named after the first of them. */
void formats_sink_new_face(formats_sink *sink);

/** Points of dim doubles. FROE_E_INPUT when a coordinate is not finite. */
froe_status formats_sink_point(formats_sink *sink, const double *p);
froe_status formats_sink_segment(formats_sink *sink, const double *a, const double *b);
/** The segments between neighbours of `count` points. */
froe_status formats_sink_line(formats_sink *sink, const double *points, size_t count);
/** Of one corner or more. */
froe_status formats_sink_hull(formats_sink *sink, const double *corners, size_t count);
froe_status formats_sink_box(formats_sink *sink, const double *lo, const double *hi);
froe_status formats_sink_ball(formats_sink *sink, const double *centre, double radius);
froe_status formats_sink_triangle(formats_sink *sink, const double *a, const double *b, const double *c);
/** One face of a solid with its corners in order: 1 gives a point, 2 a segment, 3 a triangle, more a
 * polygon or triangles, as `faces` says. Counts what was split. */
froe_status formats_sink_face(formats_sink *sink, const double *corners, size_t count);
/** The same, with its corners among the points. */
froe_status formats_sink_indexed_face(formats_sink *sink, const uint32_t *indices, size_t count);

/** Reports progress; FROE_E_CANCELLED. */
froe_status formats_sink_progress(formats_sink *sink, double done);
/** A failure that names file, unit, number and container before the sentence. */
froe_status formats_sink_fail(formats_sink *sink, froe_status status, const char *sentence, ...)
    __attribute__((format(printf, 3, 4)));

#endif
