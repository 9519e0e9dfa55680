/* offline.h: GDAL without the network, for the calling thread. */
#ifndef FROE_IO_OFFLINE_H
#define FROE_IO_OFFLINE_H

/** What the thread allowed before: text of GDAL, or NULL. */
typedef struct io_offline {
    char *allowed;
} io_offline;

/** From here to io_offline_end() nothing that a file names is fetched: links to coordinate systems, services, names in
 * virtual file systems. */
void io_offline_begin(io_offline *offline);
void io_offline_end(io_offline *offline);

#endif
