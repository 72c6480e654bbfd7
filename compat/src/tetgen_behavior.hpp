// What programs say by TetGen's class tetgenbehavior, in the place of switches.
#pragma once

#include <string>

namespace compat {

// The switches that a tetgenbehavior of TetGen 1.5.0 stands for, as far as they make a difference to the output.
std::string switches_of_behavior(const void *behavior);

} // namespace compat
