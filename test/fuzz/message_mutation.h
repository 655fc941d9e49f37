#pragma once
#include <cstddef>
#include <cstdint>

namespace deixis::fuzz {

/// Changes the message of `size` bytes at `data`, which has room for `max_size`; returns its new
/// size. The fingerprint is that of a type afterwards: a mutation that hits it stops at the door.
/// One in eight times the message is made anew, whole and of any type; one in four times a number
/// in it becomes a lying length; else libFuzzer does what it does.
std::size_t MutateMessage(std::uint8_t* data, std::size_t size, std::size_t max_size,
                          unsigned int seed);

}  // namespace deixis::fuzz
