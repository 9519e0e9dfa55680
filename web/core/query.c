/* query.c: ranges of every shape; all other questions are functions of <froe/query.h> as they are */
#include "web.h"
#include <froe/query.h>

static const char *shape_name(int value) {
    return froe_range_shape_name((froe_range_shape)value);
}
static const char *walk_name(int value) {
    return froe_walk_name((froe_walk)value);
}

#define AT(member) offsetof(froe_range, member)
static const web_member range_members[] = {
    {"shape", WEB_NAMED, AT(shape), shape_name}, {"points", WEB_ADDRESS, AT(points), NULL},
    {"count", WEB_INT, AT(count), NULL},         {"offsets", WEB_ADDRESS, AT(offsets), NULL},
    {"radius", WEB_DOUBLE, AT(radius), NULL},    {"eps", WEB_DOUBLE, AT(eps), NULL},
    {"walk", WEB_NAMED, AT(walk), walk_name},    {NULL, WEB_INT, 0, NULL},
};
#undef AT
static void range_defaults(void *options) {
    *(froe_range *)options = froe_range_defaults();
}
const web_kind web_range = {"range", sizeof(froe_range), range_defaults, range_members};

static const web_member batch_members[] = {{NULL, WEB_INT, 0, NULL}};
static void batch_defaults(void *options) {
    froe_batch_options *o = options;
    *o = froe_batch_defaults();
    o->threads = 1;
    o->progress = web_progress;
}
const web_kind web_batch = {"batch", sizeof(froe_batch_options), batch_defaults, batch_members};
