/* fuzz_poses.c: any bytes as a table of poses of a model of three parts. What can be read has contacts that are told in
 * order, or is refused with a sentence. */
#include "support.h"
#include <froe/formats.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static froe_scene *model(void) {
    static const double corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 3, 0, 0, 4, 0, 1, 3, 1, 0, 0, 0, 5, 1, 0, 5, 0, 1, 6};
    static const char *const names[] = {"a", "b", "c"};
    froe_scene *scene;
    if (froe_scene_new(3, NULL, &scene)) abort();
    for (int i = 0; i < 3; i++) {
        froe_objects o = froe_objects_defaults();
        uint32_t group;
        const froe_group named = {.name = names[i]};
        if (froe_scene_add_group(scene, &named, &group)) abort();
        o.kind = FROE_POLYGON, o.count = 1, o.coords = corners + 9 * i, o.groups = &group;
        if (froe_scene_add(scene, &o, NULL)) abort();
    }
    return scene;
}

static bool in_order(void *user, const froe_contact *c) {
    double *last = user;
    if (!(c->begin[0] <= c->begin[1] && c->begin[0] <= c->end[1] && *last <= c->begin[0])) abort();
    *last = c->begin[0];
    return true;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const char *const headers[] = {"body,time,x,y,z,qx,qy,qz,qw\n", "time,body,z,y,x\n",
                                          "body,time,x,y,z,note\n", ""};
    fuzz_bytes bytes = {data, size};
    const char *header = headers[fuzz_byte(&bytes) % 4];
    char path[256];
    froe_motion *motion;
    froe_diagnostic why = {.message = ""};
    froe_scene *scene = model();
    fuzz_file(header, ".csv", bytes.data, bytes.size, path, sizeof path);
    const froe_status status = froe_read_poses(path, scene, NULL, &motion, NULL, &why);
    if (status && !memchr(why.message, '.', sizeof why.message)) fuzz_complain("no sentence", &why);
    if (status == FROE_OK) {
        double last = -(double)INFINITY;
        froe_contact_options o = froe_contact_defaults();
        o.threads = 1;
        const froe_status met = froe_motion_contacts(motion, &o, in_order, &last, &why);
        if (met && met != FROE_E_LIMIT && met != FROE_E_UNSUPPORTED) fuzz_complain("contacts", &why);
        froe_motion_free(motion);
    }
    froe_scene_free(scene);
    remove(path);
    return 0;
}
