/* readers.h: the readers that need a library. It is the header of read_3mf.c, read_assimp.c and read_ogr.c. */
#ifndef FROE_IO_READERS_H
#define FROE_IO_READERS_H

#include "formats/input/source.h"
#include <froe/io.h>

formats_reader io_read_3mf, io_read_assimp, io_read_ogr;
/** A froe_image_fn, by GDAL. */
bool io_read_image(void *user, const char *path, const void *bytes, size_t count, const froe_allocator *alloc,
                   froe_image *out);
/** Is it a 3MF file, by its extension and its first bytes? */
bool io_3mf_recognise(const formats_source *source);
/** Does assimp read files with this extension? */
bool io_assimp_recognise(const formats_source *source);

#endif
