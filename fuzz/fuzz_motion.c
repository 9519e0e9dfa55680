/* fuzz_motion.c: any text as moving features (MF-JSON). What can be read has contacts that are told in order and lie in
 * the window, or too close to one another to be told apart. Without bodies it has as many objects. */
#include "support.h"
#include <froe/formats.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST_OBJECTS = 32 };

typedef struct told {
    const froe_motion *motion;
    double last;
} told;

static bool check(void *user, const froe_contact *c) {
    told *t = user;
    froe_motion_options w = froe_motion_window(t->motion);
    if (!(c->a < c->b && c->begin[0] <= c->begin[1] && c->begin[0] <= c->end[0] && c->begin[1] <= c->end[1]) ||
        !(w.begin <= c->begin[0] && c->end[1] <= w.end && t->last <= c->begin[0]))
        abort();
    t->last = c->begin[0];
    return true;
}

static void check_without_bodies(const froe_motion *motion) {
    froe_motion *out;
    froe_diagnostic why;
    double reached, deviation = 0.1;
    const froe_status status = froe_motion_without_bodies(motion, deviation, NULL, &out, &reached, &why);
    if (status && status != FROE_E_LIMIT) abort();
    if (status) return;
    if (!(reached <= deviation) || froe_motion_body_count(out) ||
        froe_motion_object_count(out) != froe_motion_object_count(motion))
        abort();
    froe_motion_free(out);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char path[256];
    fuzz_file("", ".mfjson", data, size, path, sizeof path);
    froe_motion *motion;
    froe_diagnostic why;
    if (froe_read_motion(path, NULL, &motion, NULL, &why) == FROE_OK) {
        told t = {motion, -(double)INFINITY};
        froe_contact_options o = froe_contact_defaults();
        o.threads = 1;
        const bool small = froe_motion_object_count(motion) <= MOST_OBJECTS;
        const froe_status status = small ? froe_motion_contacts(motion, &o, check, &t, &why) : FROE_OK;
        if (status != FROE_OK && status != FROE_E_LIMIT) abort();
        check_without_bodies(motion);
        froe_motion_free(motion);
    }
    remove(path);
    return 0;
}
