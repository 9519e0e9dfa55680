/* support.h: what tests of the core's formats share, by the reader of every format. */
#ifndef FROE_TESTS_IO_SUPPORT_H
#define FROE_TESTS_IO_SUPPORT_H
#include <froe/io.h>
#define FROE_TEST_READ froe_read
#include "support/scenes.h"
#endif
