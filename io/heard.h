/* heard.h: what all uses of GDAL share: its drivers, and its messages, which go to a handler of the thread. */
#ifndef FROE_IO_HEARD_H
#define FROE_IO_HEARD_H

#include "formats/input/sink.h"
#include "offline.h"
#include "setting.h"

/** Names for a message, as many as fit. */
typedef struct io_names {
    char text[128];
    size_t used, count;
} io_names;
void io_names_put(io_names *names, const char *name);

/** The first failure of which GDAL has told, and what it leaves out. */
typedef struct io_heard {
    const char *path; /**< set by the owner: what froe names itself, and no message needs to */
    bool online;      /**< set by the owner: the path may lead to the network, by the user's wish */
    bool failed;
    char text[160]; /**< "" where it names the path */
    io_names left;  /**< sorts of entities of a DXF that it passes over */
    io_offline offline;
    io_setting notes, debug;
} io_heard;

/** Registers the drivers, once, and listens until io_gdal_end(), offline unless `online`. Until then GDAL writes no
 * notes beside files that it reads. */
void io_gdal_begin(io_heard *heard);
void io_gdal_end(io_heard *heard);

/** A failure about `path`: what was heard, or else the sentence. */
froe_status io_gdal_fail(const io_heard *heard, froe_diagnostic *diag, froe_status status, const char *path,
                         const char *sentence);

#endif
