/* texture.h: the colours that faces have by the images laid over them.
 *
 *     v                 A face takes the mean of the texels under it, in shares of light, which is what an eye sees of
 *     |  a-------b      it from afar. Means are taken over the middles of k^2 equal parts of each triangle of the
 *     |   \ . . /       face: about eight for each texel, 8^2 at least, and 24^2 at most.
 *     |    \ . /
 *     |     \c/         Light is counted in whole steps of a table, and comes back to sRGB by the table: no logarithm
 *     +---------- u     or power is computed, and the same file has the same colours everywhere. */
#ifndef FROE_FORMATS_TEXTURE_H
#define FROE_FORMATS_TEXTURE_H
#include "formats/input/sink.h"

/** What is beyond the image. */
typedef enum formats_wrap { FORMATS_REPEAT, FORMATS_CLAMP, FORMATS_MIRROR } formats_wrap;

typedef struct formats_texture {
    froe_image image; /**< pixels NULL: it cannot be read; otherwise those of formats_images */
    formats_wrap wrap[2];
    double cutoff; /**< texels of less opacity are not there, and others opaque; 0: opacity counts; -1: it does not */
    double scale[2], offset[2]; /**< u, v: places in the file are multiplied, then moved */
} formats_texture;

typedef struct formats_image {
    char name[256]; /**< as in the file; a longer one is not read */
    froe_image image;
} formats_image;
/** Each once, whether it can be read or not. */
typedef ARRAY(formats_image) formats_images;

/** The image of a name, which is read when it is met first: at or below the folder of the file `path`, or beside it; or
 * from bytes, which are no file. Others, and those that cannot be read, have pixels NULL and are counted in the report.
 * FROE_E_MEMORY. */
froe_status formats_image_find(formats_sink *sink, const char *path, const char *name, const void *bytes, size_t count,
                               formats_images *images, froe_image *out);
void formats_images_free(const froe_allocator *alloc, formats_images *images);

/** The mean of a texture over a face of `count` corners, 3 numbers each in `corners`, and u, v in `places` (v upwards
 * from the lowest row): shares of light, and of opacity. False: the texture cannot be read. */
bool formats_texture_mean(const formats_texture *texture, const double *corners, const double *places, size_t count,
                          double rgba[4]);

/** A share of light, from and to sRGB: 0 .. 255. */
double formats_light(uint8_t level);
uint8_t formats_level(double light);
/** A colour (see froe_group) in 64 steps a channel, of shares of light and of opacity. */
uint32_t formats_light_colour(const double rgba[4]);
/** The same steps for a colour. What is black and wholly clear has an opacity of 1/255: 0 would be no colour. */
uint32_t formats_step_colour(uint32_t colour);
#endif
