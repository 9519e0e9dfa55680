/* locale.h: numbers have decimal points, whatever the locale of the caller. */
#ifndef FROE_SUPPORT_LOCALE_H
#define FROE_SUPPORT_LOCALE_H
#include <locale.h>
#include <stdbool.h>

/** The calling thread uses the C locale from support_locale_enter() to support_locale_leave(). */
typedef struct support_locale {
    locale_t own, before;
} support_locale;
bool support_locale_enter(support_locale *guard); /**< false: no memory */
void support_locale_leave(support_locale *guard);
#endif
