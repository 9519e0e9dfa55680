/* pages.h: large arrays in pages of 2 MB, which spare most page faults and most of the waiting for page tables.
 *
 * The system gives such pages to memory that is aligned to one and was never touched. What malloc() gives back has been
 * touched before as a rule, so large arrays are mapped, each by itself. Room that is not used yet takes no memory, and
 * an array that grows moves by its page tables, uncopied. */
#ifndef FROE_SUPPORT_PAGES_H
#define FROE_SUPPORT_PAGES_H
#include <stdbool.h>
#include <stddef.h>

/** Is an array of so many bytes one of these? Never where the system has no such pages, and never under sanitizers,
 * which watch the blocks of malloc() alone. */
bool support_pages_serve(size_t size);
/** A new array (ptr NULL), or one of these with another size; new_size 0 frees it, and returns NULL. Both sizes are 0
 * or served. NULL: there is no memory, and the old array stays. */
void *support_pages_realloc(void *ptr, size_t old_size, size_t new_size);
#endif
