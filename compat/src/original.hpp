// The function that a caller would have called without this library.
#pragma once

namespace compat {

// The function of this name in the module that the call came from (caller is the return address), where programs have
// linked the original statically; otherwise the next one after this library in the order of the loader; otherwise that
// of any module: a call that is the last thing a function does may come from elsewhere than it seems. Null if there is
// none. Never a function of this library.
void *original_of(const char *name, const void *caller);

} // namespace compat
