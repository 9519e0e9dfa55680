/* alloc.h: the allocator in use. Every object carries its own. */
#ifndef FROE_SUPPORT_ALLOC_H
#define FROE_SUPPORT_ALLOC_H
#include "support/arithmetic.h"
#include <froe/froe.h>

/** The caller's allocator, or malloc where `alloc` or its function is NULL. */
froe_allocator support_allocator(const froe_allocator *alloc);
#endif
