#pragma once
#include <cstddef>

namespace deixis::test {

/// Bytes that `new` has handed out in this thread so far. Programs that link this count.
std::size_t AllocatedBytes();

}  // namespace deixis::test
