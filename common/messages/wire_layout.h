#pragma once
// What the generated table of all message types is written in: how their bytes lie on the wire.
#include <cstddef>
#include <cstdint>

namespace deixis::messages {

/// What a step over the wire finds.
enum class WireItem : std::uint8_t {
  kBytes,    ///< Bytes that may have any value.
  kBoolean,  ///< A byte, 0 or 1.
  kLength,   ///< A signed integer, high byte first, that sizes arrays further on.
  kString,   ///< An int32 length, then text with its NUL.
  kStruct,   ///< Another layout.
};

/// Most lengths that one struct may have; the generator refuses more.
inline constexpr std::size_t kMostWireSlots = 8;

/// One step: `count` elements, times the length in `slot` when there is one.
struct WireStep {
  WireItem item;
  std::int8_t slot;     ///< kLength: where to keep it; else the length that multiplies, -1 = none.
  std::uint32_t size;   ///< kBytes, kLength: of one element. kStruct: index of the layout.
  std::uint32_t count;  ///< Elements by the array's fixed dimensions.
};

/// A struct: its steps in the order of the wire. No struct contains itself.
struct WireLayout {
  std::int64_t fingerprint;
  const char* name;     ///< package.struct
  std::uint16_t first;  ///< Index of its first step.
  std::uint16_t n_steps;
  std::uint32_t smallest;  ///< Bytes that it takes at least, never 0; without the fingerprint.
};

/// All types, ordered by fingerprint.
struct WireTable {
  const WireStep* steps;
  const WireLayout* layouts;
  std::size_t n_layouts;
};

/// The table made from lcmtypes/*.lcm by the build.
WireTable GeneratedWireTable();

}  // namespace deixis::messages
