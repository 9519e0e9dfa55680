/* readers.h: the readers that need a library. It speaks for read_assimp.c and read_ogr.c. */
#ifndef FROE_IO_READERS_H
#define FROE_IO_READERS_H

#include "formats/input/source.h"
#include <froe/io.h>

formats_reader io_read_assimp, io_read_ogr;
/** Does assimp read files with this extension? */
bool io_assimp_recognise(const formats_source *source);

#endif
