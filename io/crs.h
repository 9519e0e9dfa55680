/* crs.h: the coordinate system of the layers of a map becomes that of the scene. */
#ifndef FROE_IO_CRS_H
#define FROE_IO_CRS_H

#include "formats/input/sink.h"
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

/** What a format says of coordinates whose system its file does not name. */
typedef enum io_crs_promise {
    IO_CRS_BY_FILE, /**< nothing */
    IO_CRS_DEGREES, /**< they are longitudes and latitudes of WGS 84, in degrees */
    IO_CRS_GUESSED, /**< nothing, but in practice the same, where they can be degrees */
    IO_CRS_OTHER,   /**< the file names one that is not WGS 84, which GDAL takes for what it does not know */
    IO_CRS_NONE     /**< the file says that there is no system */
} io_crs_promise;

/** The layers so far. */
typedef struct io_crs {
    bool wrap; /**< set by the owner: only longitudes and latitudes will do */
    io_crs_promise promise;
    bool any;                    /**< a layer was there */
    OGRSpatialReferenceH system; /**< NULL: none */
    char layer[64];
} io_crs;
void io_crs_free(io_crs *crs);

io_crs_promise io_crs_promise_of(GDALDatasetH data);
/** A layer of which features are read. FROE_E_OPTIONS: its system is another than that of the layers before,
 * or will not do. */
froe_status io_crs_take(io_crs *crs, formats_sink *sink, OGRLayerH layer);

#endif
