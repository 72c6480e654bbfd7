// Numbers with a point, whatever the locale of the program.
#pragma once

#include <locale.h>

namespace compat {

// While it lives, functions of C read and write on this thread as in the locale "C". That one takes no memory, and is not
// to be freed.
class PlainLocale {
public:
    PlainLocale() : before_(uselocale(plain())) {}
    PlainLocale(const PlainLocale &) = delete;
    PlainLocale &operator=(const PlainLocale &) = delete;
    ~PlainLocale() { uselocale(before_); }

private:
    static locale_t plain() {
        static const locale_t locale = newlocale(LC_ALL_MASK, "C", nullptr);
        return locale;
    }
    locale_t before_;
};

} // namespace compat
