/* embedded.h: the files within the program: scenes of the demo, and what pages begin with. */
#ifndef FROE_CLI_EMBEDDED_H
#define FROE_CLI_EMBEDDED_H
#include "support/embedded.h"

extern const support_embedded cli_embedded_files[];
#endif
