/* offline.h: GDAL without the network, for the calling thread. */
#ifndef FROE_IO_OFFLINE_H
#define FROE_IO_OFFLINE_H

#include "setting.h"

typedef struct io_offline {
    io_setting allowed; /**< the file in virtual file systems that may be opened */
} io_offline;

/** From here to io_offline_end() nothing that a file names is fetched: links to coordinate systems, services, names in
 * virtual file systems. */
void io_offline_begin(io_offline *offline);
void io_offline_end(io_offline *offline);

#endif
