/* scenes.h: what the demo shows: real scenes, and the command lines run on each. */
#ifndef FROE_CLI_DEMO_SCENES_H
#define FROE_CLI_DEMO_SCENES_H

/** A command line of froe without the leading "froe", its words parted by single
 * blanks. A picture has a caption; its file is the word after -o. */
typedef struct demo_step {
    const char *command;
    const char *caption;
} demo_step;

enum { DEMO_STEPS = 12 };

typedef struct demo_scene {
    const char *title;
    const char *file; /**< of the embedded files */
    const char *text; /**< what it is and what to look for */
    const char *credit;
    int dim;                     /**< the methods that serve it are compared */
    demo_step steps[DEMO_STEPS]; /**< ended by a NULL command; the first build is the one the page reports */
} demo_scene;

/** Ended by a NULL title. */
extern const demo_scene demo_scenes[];
#endif
