#pragma once
#include "common/messages/codec.h"

namespace deixis::messages {

/// What is wrong with the bytes of a message.
enum class WireFault : std::uint8_t {
  kNone,
  kWrongType,      ///< No type that is known has this fingerprint.
  kTooLarge,       ///< 2 GB or more, which LCM cannot count.
  kTruncated,      ///< Ends before it is whole; lengths that lie reach beyond the end, too.
  kTrailingBytes,  ///< Goes on behind its end.
  kBadLength,      ///< A negative number of elements.
  kBadString,      ///< Not ended by its only NUL, or no UTF-8.
  kBadBoolean,     ///< Neither 0 nor 1.
};

/// Checks a message of any type that lcmtypes/ holds, told by its fingerprint, before it is
/// decoded: every length against the bytes that are left, texts, and that it ends where its bytes
/// end. Works by a table made from the .lcm files; takes no memory, and time in proportion to the
/// bytes at most. A message that passes is decoded from exactly its bytes, encodes to them again,
/// and takes memory in proportion to them: each element of an array has at least one byte of its
/// own.
WireFault CheckWire(Bytes bytes);

/// The short reason that Rejected carries: "truncated"; "" for kNone.
const char* Reason(WireFault fault);

}  // namespace deixis::messages
