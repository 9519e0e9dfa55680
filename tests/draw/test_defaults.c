/* Structs that carry their size: programs that were compiled when a struct was shorter, or longer, get its defaults. */
#include "support/memory.h"
#include <froe/draw.h>
#include <froe/formats.h>
#include <froe/measure.h>
#include <froe/shards.h>
#include <string.h>

#define OF_EACH(DO)                                                                                                    \
    DO(froe_objects, froe_objects_defaults)                                                                            \
    DO(froe_build_options, froe_build_defaults)                                                                        \
    DO(froe_audit_options, froe_audit_defaults)                                                                        \
    DO(froe_range, froe_range_defaults)                                                                                \
    DO(froe_batch_options, froe_batch_defaults)                                                                        \
    DO(froe_measure_options, froe_measure_defaults)                                                                    \
    DO(froe_motion_options, froe_motion_defaults)                                                                      \
    DO(froe_body, froe_body_defaults)                                                                                  \
    DO(froe_moving, froe_moving_defaults)                                                                              \
    DO(froe_contact_options, froe_contact_defaults)                                                                    \
    DO(froe_kinetic_options, froe_kinetic_defaults)                                                                    \
    DO(froe_snapshot_options, froe_snapshot_defaults)                                                                  \
    DO(froe_shards_options, froe_shards_defaults)                                                                      \
    DO(froe_order_options, froe_order_defaults)                                                                        \
    DO(froe_visibility_options, froe_visibility_defaults)                                                              \
    DO(froe_camera, froe_camera_defaults)                                                                              \
    DO(froe_picture_options, froe_picture_defaults)                                                                    \
    DO(froe_read_options, froe_read_defaults)                                                                          \
    DO(froe_export_options, froe_export_defaults)                                                                      \
    DO(froe_motion_read_options, froe_motion_read_defaults)                                                            \
    DO(froe_animation_options, froe_animation_defaults)                                                                \
    DO(froe_render_options, froe_render_defaults)                                                                      \
    DO(froe_draw_options, froe_draw_defaults)

typedef void into_fn(void *out, size_t size);
typedef struct subject {
    const char *name;
    size_t size;
    into_fn *into;
    void (*whole)(void *out);
} subject;

#define FUNCTIONS(type, name)                                                                                          \
    static void name##_sized(void *out, size_t size) {                                                                 \
        name##_into(out, size);                                                                                        \
    }                                                                                                                  \
    static void name##_whole(void *out) {                                                                              \
        const type made = name();                                                                                      \
        memcpy(out, &made, sizeof made);                                                                               \
    }
OF_EACH(FUNCTIONS)

#define SUBJECT(type, name) {#name, sizeof(type), name##_sized, name##_whole},
static const subject subjects[] = {OF_EACH(SUBJECT)};

enum { ROOM = 2048, LATER = 40 };

static void each_struct_is_as_large_as_the_program_has_it(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof subjects / sizeof *subjects; i++) {
        const subject *s = &subjects[i];
        unsigned char whole[ROOM], part[ROOM];
        size_t size;
        assert_true(s->size + LATER < ROOM);
        s->whole(whole);
        memcpy(&size, whole, sizeof size);
        if (size != s->size) fail_msg("%s() does not set the size", s->name);
        for (size_t known = sizeof size; known <= s->size + LATER; known += 8) {
            memset(part, 0xa5, sizeof part);
            s->into(part, known);
            memcpy(&size, part, sizeof size);
            if (size != known) fail_msg("%s_into() does not set the size %zu", s->name, known);
            for (size_t at = known; at < ROOM; at++)
                if (part[at] != 0xa5) fail_msg("%s_into() writes byte %zu of %zu", s->name, at, known);
            for (size_t at = s->size; at < known; at++)
                if (part[at]) fail_msg("%s_into() leaves byte %zu, which it does not know", s->name, at);
        }
    }
}

static void a_shorter_struct_has_the_defaults_of_its_members(void **state) {
    (void)state;
    froe_draw_options o;
    memset(&o, 0xa5, sizeof o);
    froe_draw_defaults_into(&o, offsetof(froe_draw_options, background));
    assert_true(o.width == 960 && o.margin == -1 && o.scale == 1);
    assert_int_equal(o.background, 0xa5a5a5a5);
}

static void a_struct_of_a_later_version_is_refused(void **state) {
    (void)state;
    struct {
        froe_audit_options known;
        uint64_t later;
    } o;
    froe_audit_defaults_into(&o.known, sizeof o);
    const double ends[] = {0, 0, 1, 1};
    froe_objects batch = froe_objects_defaults();
    batch.kind = FROE_SEGMENT, batch.count = 1, batch.coords = ends;
    froe_build_options build = froe_build_defaults();
    froe_scene *scene;
    froe_tree *tree;
    froe_diagnostic diag;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add(scene, &batch, &diag), FROE_OK);
    assert_int_equal(froe_build(scene, &build, &tree, &diag), FROE_OK);
    assert_int_equal(froe_tree_audit(tree, &o.known, &diag), FROE_E_OPTIONS);
    froe_audit_defaults_into(&o.known, sizeof o.known);
    assert_int_equal(froe_tree_audit(tree, &o.known, &diag), FROE_OK);
    froe_tree_free(tree), froe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_struct_is_as_large_as_the_program_has_it),
        cmocka_unit_test(a_shorter_struct_has_the_defaults_of_its_members),
        cmocka_unit_test(a_struct_of_a_later_version_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
