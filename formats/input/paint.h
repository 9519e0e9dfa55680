/* paint.h: faces that have colours of their own: a group for each colour, all with one name and material. */
#ifndef FROE_FORMATS_PAINT_H
#define FROE_FORMATS_PAINT_H
#include "formats/input/sink.h"

typedef struct formats_paint_entry {
    uint32_t colour, group;
} formats_paint_entry;

/** Groups by colour, in a table with open addressing. All zero: empty. */
typedef struct formats_paint {
    ARRAY(formats_paint_entry) table; /**< of 2^k entries; colour 0: free */
    size_t used;
    const char *name, *material; /**< of the groups; NULL: none */
} formats_paint;

/** The group of a colour (0xRRGGBBAA; 0: none) becomes the group of the objects to come. FROE_E_MEMORY,
 * FROE_E_LIMIT. */
froe_status formats_paint_enter(formats_sink *sink, formats_paint *paint, uint32_t colour);
void formats_paint_free(formats_sink *sink, formats_paint *paint);
/** The mean of `count` colours, channel by channel, rounded; 0 where one of them is none. */
uint32_t formats_paint_mean(const uint32_t *colours, size_t count);
#endif
