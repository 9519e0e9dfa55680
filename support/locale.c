/* locale.c: the locale of a thread. */
#include "support/locale.h"

bool support_locale_enter(support_locale *guard) {
    guard->own = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!guard->own) return false;
    guard->before = uselocale(guard->own);
    return true;
}

void support_locale_leave(support_locale *guard) {
    uselocale(guard->before);
    freelocale(guard->own);
}
