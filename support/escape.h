/* escape.h: any text within XML, or within a string of JSON. */
#ifndef FROE_SUPPORT_ESCAPE_H
#define FROE_SUPPORT_ESCAPE_H
#include <stdbool.h>
#include <stddef.h>

/** What stands for the next character of a text, UTF-8 if all is well; *text moves on. Bytes that are none, and control
 * characters, which XML 1.0 cannot hold (section 2.2), become U+FFFD. Returns how many bytes of `out` it takes; 0: the
 * text has ended. */
size_t support_xml_escape(const char **text, char out[8]);
/** What stands for the next character of a text, and moves the text beyond it. Bytes that are no UTF-8 become U+FFFD.
 * Returns how many bytes of `out` that is; 0: the text has ended. */
size_t support_json_escape(const char **text, char out[8]);
/** The reverse, of an escape whose backslash stands before *text: writes up to 4 bytes, which may be where the escape
 * stands, and moves both beyond them. False: there is no such escape, or no string can hold what it means, U+0000 or
 * half a pair of surrogates. */
bool support_json_unescape(char **text, char **out);
#endif
