/* dxf.h: layers of a drawing in DXF, and the header that names them.
 *
 * It speaks for dxf_header.c and write_dxf.c (the entities, by GDAL). */
#ifndef FROE_IO_DXF_H
#define FROE_IO_DXF_H
#include "support/array.h"
#include <froe/render.h>

enum { DXF_NAME = 256 };

/** How everything on a layer is drawn; lengths in units of the drawing. */
typedef struct dxf_layer {
    char name[DXF_NAME];
    uint32_t colour; /**< 0xRRGGBB */
    double width, dash, gap;
} dxf_layer;
typedef ARRAY(dxf_layer) dxf_layers;
typedef ARRAY(char) dxf_text;

/** The number of the colour that is nearest among the 255 of AutoCAD, 1 .. 255. 7 is black on white and white on black.
 */
int dxf_colour(uint32_t colour);
/** GDAL's template of a header with these layers, their types of line, and units. `millimetres`: the unit of the
 * drawing; otherwise it has none. FROE_E_UNSUPPORTED: there is no such template. FROE_E_MEMORY. */
froe_status dxf_header(const froe_allocator *alloc, const dxf_layers *layers, bool millimetres, dxf_text *out);
#endif
