/* embree.c: Embree 3, triangles in single precision, high quality, one thread. */
#include "peer.h"
#include "triangle.h"
#include <embree3/rtcore.h>
#include <stdlib.h>

typedef struct index3 {
    RTCDevice device;
    RTCScene scene;
    const peer_triangle *t;
    ptrdiff_t bytes;
} index3;

static bool count_bytes(void *user, ssize_t bytes, bool post) {
    (void)post;
    ((index3 *)user)->bytes += bytes;
    return true;
}

static void *build(const peer_data *data, const peer *self) {
    const size_t n = data->count;
    const peer_triangle *t = (const peer_triangle *)data->coords;
    (void)self;
    index3 *x = calloc(1, sizeof *x);
    if (!x) exit(1);
    x->t = t;
    x->device = rtcNewDevice("threads=1");
    rtcSetDeviceMemoryMonitorFunction(x->device, count_bytes, x);
    x->scene = rtcNewScene(x->device);
    rtcSetSceneBuildQuality(x->scene, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry g = rtcNewGeometry(x->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    float *v = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * n);
    unsigned *f = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, n);
    for (size_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++) {
            f[3 * i + (size_t)c] = (unsigned)(3 * i + (size_t)c);
            for (int k = 0; k < 3; k++) v[9 * i + 3 * (size_t)c + (size_t)k] = (float)t[i].p[c][k];
        }
    rtcCommitGeometry(g);
    rtcAttachGeometry(x->scene, g);
    rtcReleaseGeometry(g);
    rtcCommitScene(x->scene);
    return x;
}

static void drop(void *index) {
    index3 *x = index;
    rtcReleaseScene(x->scene);
    rtcReleaseDevice(x->device);
    free(x);
}

static size_t bytes(void *index) {
    return (size_t)((index3 *)index)->bytes;
}

static struct RTCRay ray_of(const double o[3], const double d[3]) {
    return (struct RTCRay){.org_x = (float)o[0],
                           .org_y = (float)o[1],
                           .org_z = (float)o[2],
                           .dir_x = (float)d[0],
                           .dir_y = (float)d[1],
                           .dir_z = (float)d[2],
                           .tfar = INFINITY,
                           .mask = ~0u};
}

static double ray(void *index, const double o[3], const double d[3]) {
    struct RTCIntersectContext context;
    struct RTCRayHit hit = {.ray = ray_of(o, d)};
    hit.hit.geomID = hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcInitIntersectContext(&context);
    rtcIntersect1(((index3 *)index)->scene, &context, &hit);
    return hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? (double)INFINITY : (double)hit.ray.tfar;
}

static bool any(void *index, const double o[3], const double d[3]) {
    struct RTCIntersectContext context;
    struct RTCRay r = ray_of(o, d);
    rtcInitIntersectContext(&context);
    rtcOccluded1(((index3 *)index)->scene, &context, &r);
    return r.tfar < 0;
}

typedef struct nearest {
    const peer_triangle *t;
    const double *x;
    double best;
} nearest;

static bool look(struct RTCPointQueryFunctionArguments *a) {
    nearest *n = a->userPtr;
    double at[3], d = peer_square(n->t + a->primID, n->x, at);
    if (d >= n->best) return false;
    n->best = d;
    a->query->radius = (float)sqrt(d);
    return true;
}

static double nearest_distance(void *index, const double point[3]) {
    index3 *x = index;
    struct RTCPointQueryContext context;
    struct RTCPointQuery q = {(float)point[0], (float)point[1], (float)point[2], 0, INFINITY};
    nearest n = {x->t, point, INFINITY};
    rtcInitPointQueryContext(&context);
    rtcPointQuery(x->scene, &q, &context, look, &n);
    return sqrt(n.best);
}

static void answer(void *index, const peer_questions *q, peer_answers *out) {
    for (size_t i = 0; i < q->count; i++) {
        const double *x = q->numbers + 3 * i;
        out->values[i] = q->work == PEER_NEAREST     ? nearest_distance(index, x)
                         : q->work == PEER_FIRST_HIT ? ray(index, x, q->directions + 3 * i)
                                                     : any(index, x, q->directions + 3 * i);
    }
}

static bool serves(const peer_data *data, peer_work work) {
    return data->kind == PEER_TRIANGLES && (work == PEER_FIRST_HIT || work == PEER_ANY_HIT || work == PEER_NEAREST);
}

static const peer embree = {.name = "Embree",
                            .what = "version 3, of high quality, one thread; it rounds to single precision",
                            .tolerance = 1e-4,
                            .serves = serves,
                            .make = build,
                            .free = drop,
                            .answer = answer,
                            .bytes = bytes};

const peer *peer_at(size_t i) {
    return i ? NULL : &embree;
}
