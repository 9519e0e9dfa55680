/* status.h: how a failure gets its sentence. */
#ifndef FROE_BASE_STATUS_H
#define FROE_BASE_STATUS_H
#include "support/fail.h"

#define base_fail support_fail
#define base_fail_at support_fail_at
#define base_fail_memory support_fail_memory
#define base_fail_cancelled support_fail_cancelled
#endif
