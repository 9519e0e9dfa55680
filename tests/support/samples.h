/* samples.h: small trees of every method and of every kind of scene, for what is done to tree files byte by byte. */
#ifndef FROE_TESTS_SUPPORT_SAMPLES_H
#define FROE_TESTS_SUPPORT_SAMPLES_H
#include <froe/froe.h>

/** One tree, by its method and its scene. It is freed after the call. False ends samples_each(). */
typedef bool samples_fn(void *user, const char *method, const char *scene, const froe_tree *tree);

/** Every method on every scene that it serves; then a section of a tree in space, as method "section", and the present
 * of a kinetic partition, as method "snapshot". Ends the program when memory runs out. */
void samples_each(samples_fn *fn, void *user);
#endif
