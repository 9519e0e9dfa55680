/* xml.h: any text within XML. */
#ifndef FROE_SUPPORT_XML_H
#define FROE_SUPPORT_XML_H
#include <stddef.h>

/** What stands for the next character of a text, UTF-8 if all is well; *text moves on. Bytes that are none, and control
 * characters, which XML 1.0 cannot hold (section 2.2), become U+FFFD. Returns how many bytes of `out` it takes; 0: the
 * text has ended. */
size_t support_xml_escape(const char **text, char out[8]);
#endif
