/* image.c: images by GDAL, for textures. Large ones come smaller, as means of their pixels: of a face the mean is
 * wanted alone. */
#include "offline.h"
#include "readers.h"
#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

/* A larger image is read with so many pixels on its longer side. */
enum { MOST_PIXELS = 512 };

static void register_rasters(void) {
    GDALAllRegister();
}

/* Formats of images alone: no name makes GDAL open a database or the network. */
static const char *const drivers[] = {"PNG", "JPEG", "BMP", "GIF", "TGA", "WEBP", "GTiff", NULL};

/* The level of each channel where an image has a palette. */
static void apply_palette(GDALColorTableH palette, froe_image *image) {
    for (size_t i = 0; i < (size_t)image->width * image->height; i++) {
        uint8_t *p = image->pixels + 4 * i;
        const GDALColorEntry *entry = GDALGetColorEntry(palette, p[0]);
        p[0] = entry ? (uint8_t)entry->c1 : 0;
        p[1] = entry ? (uint8_t)entry->c2 : 0;
        p[2] = entry ? (uint8_t)entry->c3 : 0;
        p[3] = entry ? (uint8_t)entry->c4 : 255;
    }
}

/* Reads a band into every fourth byte from `channel` on. 16 bits become 8. */
static bool read_band(GDALDatasetH data, int number, froe_image *image, int channel, bool palette) {
    GDALRasterBandH band = GDALGetRasterBand(data, number);
    const int width = (int)image->width, height = (int)image->height;
    const size_t count = (size_t)width * (size_t)height;
    const bool wide = GDALGetRasterDataType(band) == GDT_UInt16;
    GDALRasterIOExtraArg how;
    INIT_RASTERIO_EXTRA_ARG(how);
    how.eResampleAlg = palette ? GRIORA_NearestNeighbour : GRIORA_Average;
    if (!wide)
        return GDALRasterIOEx(band, GF_Read, 0, 0, GDALGetRasterXSize(data), GDALGetRasterYSize(data),
                              image->pixels + channel, width, height, GDT_Byte, 4, 4 * (GSpacing)width,
                              &how) == CE_None;
    uint16_t *levels = VSIMalloc2(count, sizeof *levels);
    const bool ok = levels && GDALRasterIOEx(band, GF_Read, 0, 0, GDALGetRasterXSize(data), GDALGetRasterYSize(data),
                                             levels, width, height, GDT_UInt16, 0, 0, &how) == CE_None;
    for (size_t i = 0; ok && i < count; i++) image->pixels[4 * i + (size_t)channel] = (uint8_t)(levels[i] / 257);
    VSIFree(levels);
    return ok;
}

/* Grey, grey with opacity, colours, colours with opacity, or a palette. */
static bool read_pixels(GDALDatasetH data, froe_image *image) {
    const int bands = GDALGetRasterCount(data);
    GDALColorTableH palette = GDALGetRasterColorTable(GDALGetRasterBand(data, 1));
    const int colours = bands >= 3 ? 3 : 1, alpha = bands == 2 || bands >= 4 ? colours + 1 : 0;
    bool ok = true;
    memset(image->pixels, 255, 4 * (size_t)image->width * image->height);
    for (int k = 0; k < 3 && ok; k++) ok = read_band(data, colours == 3 ? k + 1 : 1, image, k, palette != NULL);
    if (ok && alpha && !palette) ok = read_band(data, alpha, image, 3, false);
    if (ok && palette) apply_palette(palette, image);
    return ok;
}

static bool read_data(GDALDatasetH data, const froe_allocator *alloc, froe_image *out) {
    const int width = GDALGetRasterXSize(data), height = GDALGetRasterYSize(data),
              longer = width > height ? width : height;
    if (width < 1 || height < 1 || GDALGetRasterCount(data) < 1) return false;
    const double share = longer > MOST_PIXELS ? (double)MOST_PIXELS / longer : 1;
    *out = (froe_image){.width = (uint32_t)(width * share), .height = (uint32_t)(height * share)};
    if (!out->width) out->width = 1;
    if (!out->height) out->height = 1;
    const size_t pixels = (size_t)out->width * out->height;
    out->pixels = support_calloc(alloc, pixels, 4);
    if (out->pixels && read_pixels(data, out)) return true;
    support_free(alloc, out->pixels, 4 * pixels);
    return false;
}

bool io_read_image(void *user, const char *path, const void *bytes, size_t count, const froe_allocator *alloc,
                   froe_image *out) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    char name[64];
    io_offline offline;
    (void)user;
    pthread_once(&once, register_rasters);
    CPLPushErrorHandler(CPLQuietErrorHandler);
    io_offline_begin(&offline);
    if (bytes) { /* a name of this call alone: the image is on its stack */
        snprintf(name, sizeof name, "/vsimem/froe-image-%p", (void *)name);
        VSILFILE *file = VSIFileFromMemBuffer(name, (GByte *)bytes, count, FALSE);
        if (file) VSIFCloseL(file);
    }
    GDALDatasetH data = GDALOpenEx(bytes ? name : path, GDAL_OF_RASTER | GDAL_OF_READONLY, drivers, NULL, NULL);
    const bool ok = data && read_data(data, alloc, out);
    if (data) GDALClose(data);
    if (bytes) VSIUnlink(name);
    io_offline_end(&offline);
    CPLPopErrorHandler();
    return ok;
}
