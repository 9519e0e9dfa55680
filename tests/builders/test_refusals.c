/* test_refusals.c: what froe_build() refuses whatever the method: settings that are none, orders, methods and purposes
 * that there are not; with a sentence for each. */
#include "build/options.h"
#include "support/refusals.h"
#include "support/small_scenes.h"
#include <froe/io.h>
#include <math.h>

static froe_scene *segments(void) {
    static const double coords[] = {0, 0, 1, 2, 3, 0, 4, 1, 0, 5, 6, 5};
    froe_scene *scene = scene_of(2);
    add(scene, FROE_SEGMENT, 3, coords, NULL, NULL);
    return scene;
}

static void what_is_not_given_is_refused(void **state) {
    (void)state;
    froe_scene *scene = segments();
    froe_build_options o = froe_build_defaults();
    const double plane[] = {1, 0, 2};
    froe_tree *tree = NULL;
    NULLS(froe_build(NULL, &o, &tree, &why));
    NULLS(froe_build(scene, &o, NULL, &why));
    o.size--;
    expect(froe_build(scene, &o, &tree, &why), FROE_E_OPTIONS, "froe_build_defaults");
    o.size++, o.leaf = (uint32_t)INT32_MAX + 1;
    expect(froe_build(scene, &o, &tree, &why), FROE_E_OPTIONS, "A leaf capacity of 2147483648 is above 2147483647");
    assert_null(tree);
    assert_int_equal(froe_build(scene, NULL, &tree, NULL), FROE_OK);
    froe_tree *section = NULL;
    NULLS(froe_tree_section(NULL, plane, NULL, &section, &why));
    NULLS(froe_tree_section(tree, NULL, NULL, &section, &why));
    NULLS(froe_tree_section(tree, plane, NULL, NULL, &why));
    assert_null(section);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void methods_and_purposes_are_those_there_are(void **state) {
    (void)state;
    froe_scene *scene = segments();
    froe_build_options o = froe_build_defaults();
    froe_tree *tree = NULL;
    const froe_method_info *grain = froe_method_at(0);
    for (size_t i = 1; strcmp(grain->name, "grain") != 0; i++) grain = froe_method_at(i);
    assert_string_equal(froe_method_auto(scene, NULL), "grain");
    assert_string_equal(froe_method_auto(scene, "draw"), "grain");
    assert_null(froe_method_auto(NULL, NULL));
    assert_null(froe_method_auto(scene, "fly"));
    assert_true(froe_method_serves(grain, scene, FROE_LEAF_OWN));
    assert_false(froe_method_serves(NULL, scene, FROE_LEAF_OWN));
    assert_false(froe_method_serves(grain, NULL, FROE_LEAF_OWN));
    o.purpose = "fly";
    expect(froe_build(scene, &o, &tree, &why), FROE_E_OPTIONS, "no purpose 'fly'. There are: pieces, query, draw.");
    o.purpose = NULL, o.method = "best";
    expect(froe_build(scene, &o, &tree, &why), FROE_E_OPTIONS, "no method 'best'. There are: auto, autopartition, bar");
    o.method = NULL;
    assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
    assert_string_equal(froe_tree_report(tree).method, "grain");
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void orders_have_every_object_once(void **state) {
    (void)state;
    static const struct {
        uint32_t order[3];
        size_t count;
        const char *method, *words;
    } bad[] = {{{0, 1, 2}, 2, "cylindrical", "2 entries for 3 objects"},
               {{0, 1, 3}, 3, "cylindrical", "Entry 2 of the order is 3, and there is no such object"},
               {{0, 1, 1}, 3, "cylindrical", "has object 1 twice"},
               {{0, 1, 2}, 3, "grain", "takes no order of objects"}};
    froe_scene *scene = segments();
    froe_build_options o = froe_build_defaults();
    froe_tree *tree = NULL;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        o.method = bad[i].method, o.order = bad[i].order, o.order_count = bad[i].count;
        expect(froe_build(scene, &o, &tree, &why), FROE_E_OPTIONS, bad[i].words);
    }
    o.method = "cylindrical", o.order = NULL;
    expect(froe_build(scene, &o, &tree, &why), FROE_E_OPTIONS, "0 entries for 3 objects");
    assert_null(tree);
    froe_scene_free(scene);
}

static void settings_are_plain_numbers_and_words_within_their_limits(void **state) {
    (void)state;
    static const struct {
        const char *method, *settings, *words;
    } bad[] = {
        {"density", "k", "'k': Its value is not a whole number from -1 to 1e+09"},
        {"density", "k=", "whole number"},
        {"density", "k=1.5", "whole number"},
        {"density", "k=1e300", "whole number"},
        {"density", "k=-1e300", "whole number"},
        {"density", "k=0x10", "whole number"},
        {"density", "k=1e", "whole number"},
        {"density", "k=1+1", "whole number"},
        {"density", "k=000000000000000000000000000000000000000000000000000000000000000000000001", "whole number"},
        {"density", "growth=-0.5", "'growth=-0.5': Its value is not a number from 0 to 1e+09"},
        {"density", "growth=2e9", "a number from 0 to"},
        {"density", "growth=nan", "a number from 0 to"},
        {"density", "mode=best", "'mode=best': Its value is not one of fixed"},
        {"density", "mode=fixe", "one of"},
        {"density", "grow=1", "Method 'density' has no option 'grow'"},
        {"kd", "best=1", "Method 'kd' has no option 'best'"},
    };
    froe_scene *scene = segments();
    froe_build_options o = froe_build_defaults();
    froe_tree *tree = NULL;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        o.method = bad[i].method, o.settings = bad[i].settings;
        expect(froe_build(scene, &o, &tree, &why), FROE_E_OPTIONS, bad[i].words);
        expect(build_tuned(scene, &o, &tree, &why), FROE_E_OPTIONS, bad[i].words);
    }
    assert_null(tree);
    o.method = "density", o.settings = " k=+3,\tgrowth=15e-1\nmode=tuned";
    assert_int_equal(froe_build(scene, &o, &tree, NULL), FROE_OK);
    assert_non_null(strstr(froe_tree_report(tree).settings, "mode=tuned k=3"));
    assert_non_null(strstr(froe_tree_report(tree).settings, "growth=1.5"));
    froe_tree_free(tree);
    froe_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_not_given_is_refused),
        cmocka_unit_test(methods_and_purposes_are_those_there_are),
        cmocka_unit_test(orders_have_every_object_once),
        cmocka_unit_test(settings_are_plain_numbers_and_words_within_their_limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
