/* scenes.h: what the demo shows: real scenes, and the command lines run on each. */
#ifndef FROE_CLI_DEMO_SCENES_H
#define FROE_CLI_DEMO_SCENES_H
#include <stdbool.h>

/** A command line of froe without the leading "froe", its words parted by single blanks; what it prints may go to a
 * file, ">FILE" at its end. A picture has a caption and a text for readers who do not see it; its file is the word
 * after -o or --animate. The lines since the picture before it belong to it. */
typedef struct demo_step {
    const char *command;
    const char *caption, *text;
    const char *still; /**< of a picture that moves: the picture of a former step, for readers who want no motion */
} demo_step;

enum { DEMO_STEPS = 12, DEMO_FILES = 4 };

/** A section of the page. */
typedef struct demo_scene {
    const char *title;
    const char *text;              /**< what it is good for; with markup */
    const char *files[DEMO_FILES]; /**< of the embedded ones, ended by NULL */
    demo_step steps[DEMO_STEPS];   /**< ended by a NULL command */
    const char *methods;           /**< the plan of which every method builds a tree, for a table; NULL: none */
    const char *credit;
} demo_scene;

/** Ended by a NULL title. */
extern const demo_scene demo_scenes[];
#endif
