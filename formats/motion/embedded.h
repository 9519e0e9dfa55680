/* embedded.h: the files within the core: what the player of a motion consists of. */
#ifndef FROE_FORMATS_MOTION_EMBEDDED_H
#define FROE_FORMATS_MOTION_EMBEDDED_H
#include "support/embedded.h"

extern const support_embedded formats_embedded_files[];
#endif
