/* utf8.h: the bytes of a character. */
#ifndef FROE_SUPPORT_UTF8_H
#define FROE_SUPPORT_UTF8_H
#include <stdbool.h>
#include <stddef.h>

/** Bytes of the UTF-8 character that a text begins with, in its shortest form and no surrogate (RFC 3629); 0: it is
 * none. The zero byte at the end counts as one. */
size_t support_utf8_length(const char *text);
/** Is all of a text UTF-8? So is NULL. */
bool support_is_utf8(const char *text);
/** Does a file that begins with these bytes seem to be text in UTF-16, as programs of Windows save it? It has a byte
 * order mark, or every second byte is 0, and the others are letters and the like. */
bool support_is_utf16(const char *bytes, size_t size);
/** What is said of such a file. */
static const char support_utf16_sentence[] = "The text is in UTF-16, and must be saved in UTF-8.";
#endif
