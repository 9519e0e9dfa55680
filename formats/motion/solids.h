/* solids.h: motions in space as MF-JSON. */
#ifndef FROE_FORMATS_MOTION_SOLIDS_H
#define FROE_FORMATS_MOTION_SOLIDS_H
#include "formats/write/writer.h"
#include "support/fail.h"
#include <froe/kinetic.h>

/** Writes the features of a motion of triangles. FROE_E_UNSUPPORTED, FROE_E_MEMORY. */
froe_status formats_write_solids(const froe_motion *motion, formats_writer *w, froe_diagnostic *diag);
#endif
