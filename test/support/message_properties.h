#pragma once
#include <string>

#include "common/messages/codec.h"

namespace deixis::test {

/// What must hold of any bytes that arrive as a message, whatever they are:
/// - if CheckWire accepts them, the generated decode() takes exactly all of them, with memory in
///   proportion, and what it made encodes to the same bytes;
/// - every codec rejects them with Rejected, or makes a value of them that it encodes to a message
///   which it accepts.
/// Returns what does not hold, "" when all does.
std::string BrokenProperty(messages::Bytes bytes);

/// Whether CheckWire accepts them and a codec makes a value of them.
bool IsUnderstood(messages::Bytes bytes);

}  // namespace deixis::test
