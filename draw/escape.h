/* escape.h: any text within XML. */
#ifndef FROE_DRAW_ESCAPE_H
#define FROE_DRAW_ESCAPE_H
#include <stddef.h>

/** Bytes of the UTF-8 character that a text begins with, in its shortest form and no surrogate (RFC 3629); 0: it is
 * none. The zero byte at the end counts as one. */
size_t draw_utf8_length(const char *text);

/** What stands for the next character of a text, UTF-8 if all is well; *text moves on. Bytes that are none, and control
 * characters, which XML 1.0 cannot hold (section 2.2), become U+FFFD. Returns how many bytes of `out` it takes; 0: the
 * text has ended. */
size_t draw_escape(const char **text, char out[8]);
#endif
