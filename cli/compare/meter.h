/* meter.h: an allocator that counts the memory in use now and at most. */
#ifndef FROE_CLI_COMPARE_METER_H
#define FROE_CLI_COMPARE_METER_H
#include <froe/froe.h>
#include <stdatomic.h>

/** Bytes that were asked for; what malloc adds to them is not known. Any number of threads may allocate at once. */
typedef struct meter {
    atomic_size_t now, most;
} meter;

/** malloc, on the meter, which must outlive all that is allocated. */
froe_allocator meter_allocator(meter *m);
/** Lets `most` begin again from what is in use. Returns what is in use. */
size_t meter_restart(meter *m);
#endif
