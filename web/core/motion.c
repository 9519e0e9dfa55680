/* motion.c: moving objects, and partitions of them that follow */
#include "web.h"
#include <froe/formats.h>
#include <math.h>

#define AT(member) offsetof(froe_motion_options, member)
static const web_member motion_members[] = {
    {"dim", WEB_INT, AT(dim), NULL},    {"begin", WEB_DOUBLE, AT(begin), NULL},
    {"end", WEB_DOUBLE, AT(end), NULL}, {"tick", WEB_DOUBLE, AT(tick), NULL},
    {NULL, WEB_INT, 0, NULL},
};
#undef AT
static void motion_defaults(void *options) {
    *(froe_motion_options *)options = froe_motion_defaults();
}
const web_kind web_motion = {"motion", sizeof(froe_motion_options), motion_defaults, motion_members};

#define AT(member) offsetof(froe_moving, member)
static const web_member moving_members[] = {
    {"vertexCount", WEB_INT, AT(vertex_count), NULL},
    {"starts", WEB_ADDRESS, AT(starts), NULL},
    {"times", WEB_ADDRESS, AT(times), NULL},
    {"coords", WEB_ADDRESS, AT(coords), NULL},
    {"controls", WEB_ADDRESS, AT(controls), NULL},
    {"secondControls", WEB_ADDRESS, AT(second_controls), NULL},
    {"count", WEB_INT, AT(count), NULL},
    {"vertices", WEB_ADDRESS, AT(vertices), NULL},
    {"bodies", WEB_ADDRESS, AT(bodies), NULL},
    {"births", WEB_ADDRESS, AT(births), NULL},
    {"deaths", WEB_ADDRESS, AT(deaths), NULL},
    {"tags", WEB_ADDRESS, AT(tags), NULL},
    {"groups", WEB_ADDRESS, AT(groups), NULL},
    {"group", WEB_INT, AT(group), NULL},
    {NULL, WEB_INT, 0, NULL},
};
#undef AT
static void moving_defaults(void *options) {
    *(froe_moving *)options = froe_moving_defaults();
}
const web_kind web_moving = {"moving", sizeof(froe_moving), moving_defaults, moving_members};

#define AT(member) offsetof(froe_body, member)
static const web_member body_members[] = {
    {"count", WEB_INT, AT(count), NULL},       {"times", WEB_ADDRESS, AT(times), NULL},
    {"coords", WEB_ADDRESS, AT(coords), NULL}, {"controls", WEB_ADDRESS, AT(controls), NULL},
    {"turns", WEB_ADDRESS, AT(turns), NULL},   {NULL, WEB_INT, 0, NULL},
};
#undef AT
static void body_defaults(void *options) {
    *(froe_body *)options = froe_body_defaults();
}
const web_kind web_body = {"body", sizeof(froe_body), body_defaults, body_members};

#define AT(member) offsetof(froe_contact_options, member)
static const web_member contact_members[] = {
    {"from", WEB_DOUBLE, AT(from), NULL}, {"to", WEB_DOUBLE, AT(to), NULL}, {"first", WEB_BOOL, AT(first), NULL},
    {"apart", WEB_BOOL, AT(apart), NULL}, {NULL, WEB_INT, 0, NULL},
};
#undef AT
static void contact_defaults(void *options) {
    froe_contact_options *o = options;
    *o = froe_contact_defaults();
    o->threads = 1;
    o->progress = web_progress;
}
const web_kind web_contacts = {"contacts", sizeof(froe_contact_options), contact_defaults, contact_members};

#define AT(member) offsetof(froe_kinetic_options, member)
static const web_member kinetic_members[] = {
    {"seed", WEB_UINT64, AT(seed), NULL},         {"order", WEB_ADDRESS, AT(order), NULL},
    {"epoch", WEB_UINT64, AT(epoch), NULL},       {"swap", WEB_UINT64, AT(swap), NULL},
    {"augmented", WEB_BOOL, AT(augmented), NULL}, {NULL, WEB_INT, 0, NULL},
};
#undef AT
static void kinetic_defaults(void *options) {
    froe_kinetic_options *o = options;
    *o = froe_kinetic_defaults();
    o->progress = web_progress;
}
const web_kind web_kinetic = {"kinetic", sizeof(froe_kinetic_options), kinetic_defaults, kinetic_members};

static const web_member snapshot_members[] = {
    {"refuse", WEB_BOOL, offsetof(froe_snapshot_options, refuse), NULL},
    {NULL, WEB_INT, 0, NULL},
};
static void snapshot_defaults(void *options) {
    froe_snapshot_options *o = options;
    *o = froe_snapshot_defaults();
    o->places = false;
}
const web_kind web_snapshot = {"snapshot", sizeof(froe_snapshot_options), snapshot_defaults, snapshot_members};

/** Where all vertices are at a time: dim doubles each, NaN where the plan of one does not cover it. */
WEB_EXPORT void web_positions(const froe_motion *motion, double time, double *coords) {
    const unsigned dim = froe_motion_window(motion).dim;
    const size_t count = froe_motion_vertex_count(motion);
    for (size_t i = 0; i < count; i++)
        if (!froe_motion_position(motion, (uint32_t)i, time, coords + i * dim))
            for (unsigned k = 0; k < dim; k++) coords[i * dim + k] = NAN;
}

/** All objects; room for as many as there are. */
WEB_EXPORT void web_moving_objects(const froe_motion *motion, froe_moving_object *objects) {
    const size_t count = froe_motion_object_count(motion);
    for (size_t i = 0; i < count; i++) objects[i] = froe_motion_object(motion, (uint32_t)i);
}

static bool take_contact(void *user, const froe_contact *contact) {
    return web_bytes_take(user, contact, sizeof *contact);
}
/** Contacts as an array of froe_contact. */
WEB_EXPORT froe_status web_contacts_of(const froe_motion *motion, const froe_contact_options *options, web_bytes *out,
                                       froe_diagnostic *diag) {
    *out = (web_bytes){NULL, 0, 0, false};
    return web_bytes_end(out, froe_motion_contacts(motion, options, take_contact, out, diag), diag);
}

/** An event, and when it happened, between two doubles. */
typedef struct web_event {
    froe_event event;
    double instant[2];
} web_event;
_Static_assert(sizeof(web_event) == 88, "package/motion.js reads it");

typedef enum web_visit { VISIT_ALL, VISIT_ALL_INSTANTS, VISIT_FIRST } web_visit;
typedef struct event_taker {
    froe_kinetic *kinetic;
    web_bytes *out;
    web_visit visit;
    bool stopped;
} event_taker;

static bool take_event(void *user, const froe_event *event) {
    event_taker *taker = user;
    web_event told = {*event, {event->early, event->late}};
    if (taker->visit != VISIT_ALL && froe_kinetic_instant(taker->kinetic, told.instant, NULL) != FROE_OK) return false;
    if (!web_bytes_take(taker->out, &told, sizeof told)) return false;
    if (taker->visit == VISIT_FIRST) taker->stopped = true;
    return !taker->stopped;
}

/** Lets time go on, or with VISIT_FIRST up to the next event, if there is one; events as an array of web_event. With
 * VISIT_ALL the instants are those of the ticks around. */
WEB_EXPORT froe_status web_advance(froe_kinetic *kinetic, double time, web_visit visit, web_bytes *out,
                                   froe_diagnostic *diag) {
    event_taker taker = {kinetic, out, visit, false};
    *out = (web_bytes){NULL, 0, 0, false};
    const froe_status status = froe_kinetic_advance(kinetic, time, take_event, &taker, diag);
    return web_bytes_end(out, status == FROE_E_CANCELLED && taker.stopped ? FROE_OK : status, diag);
}

/** A piece of an object between two walls of the partition. */
typedef struct web_fragment {
    uint32_t object;
    double ends[4];
} web_fragment;
static bool take_fragment(void *user, uint32_t object, const double ends[4]) {
    const web_fragment fragment = {object, {ends[0], ends[1], ends[2], ends[3]}};
    return web_bytes_take(user, &fragment, sizeof fragment);
}
/** All fragments from back to front, as an array of web_fragment. */
WEB_EXPORT froe_status web_kinetic_order(froe_kinetic *kinetic, const double eye[2], web_bytes *out,
                                         froe_diagnostic *diag) {
    *out = (web_bytes){NULL, 0, 0, false};
    return web_bytes_end(out, froe_kinetic_order(kinetic, eye, take_fragment, out, diag), diag);
}

_Static_assert(FROE_EVENT_KINDS == 12, "EVENTS in package/kinetic.js names them");
/** The counts of events by kind, then those in the order of KINETIC in package/motion.js. */
WEB_EXPORT void web_kinetic_statistics(const froe_kinetic *kinetic, double out[FROE_EVENT_KINDS + 8]) {
    const froe_kinetic_stats s = froe_kinetic_statistics(kinetic);
    for (int i = 0; i < FROE_EVENT_KINDS; i++) *out++ = (double)s.events[i];
    const double numbers[8] = {(double)s.surgeries, (double)s.batches,       (double)s.crowds,
                               (double)s.restarts,  (double)s.nodes_touched, (double)s.certificates_made,
                               (double)s.nodes,     (double)s.certificates};
    for (int i = 0; i < 8; i++) *out++ = numbers[i];
}
