/* readers.h: the readers that need no library. It speaks for csv.c, geojson.c, off.c, obj.c and ply.c. */
#ifndef FROE_FORMATS_READERS_H
#define FROE_FORMATS_READERS_H

#include "formats/input/source.h"

formats_reader formats_read_csv, formats_read_geojson, formats_read_off, formats_read_obj, formats_read_ply;

#endif
