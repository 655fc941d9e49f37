#include "common/messages/wire_check.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <string_view>

#include "common/messages/wire_layout.h"
#include "common/text/utf8.h"

namespace deixis::messages {
namespace {

// Goes over the bytes step by step. Structs nest as deep as the types do: no message decides that.
class Walk {
 public:
  Walk(WireTable table, Bytes bytes) : table_(table), at_(bytes.data), left_(bytes.size) {}

  WireFault Over(const WireLayout& layout) {
    std::array<std::int64_t, kMostWireSlots> lengths{};
    for (const WireStep *step = table_.steps + layout.first, *end = step + layout.n_steps;
         step != end; ++step) {
      const WireFault fault = step->item == WireItem::kLength
                                  ? OverLength(*step, lengths[static_cast<std::size_t>(step->slot)])
                                  : OverElements(*step, lengths);
      if (fault != WireFault::kNone) return fault;
    }
    return WireFault::kNone;
  }

  std::size_t left() const { return left_; }

 private:
  using Lengths = std::array<std::int64_t, kMostWireSlots>;

  WireFault OverLength(const WireStep& step, std::int64_t& length) {
    if (left_ < step.size) return WireFault::kTruncated;
    // The sign of the first byte is that of the number.
    std::int64_t value = static_cast<std::int8_t>(at_[0]);
    for (std::uint32_t i = 1; i < step.size; ++i) value = value * 256 + at_[i];
    Skip(step.size);
    length = value;
    return value < 0 ? WireFault::kBadLength : WireFault::kNone;
  }

  WireFault OverElements(const WireStep& step, const Lengths& lengths) {
    std::uint64_t count = step.count;
    if (step.slot >= 0) {
      const auto length = static_cast<std::uint64_t>(lengths[static_cast<std::size_t>(step.slot)]);
      if (length > left_) return WireFault::kTruncated;  // so that the product cannot overflow
      count *= length;
    }
    if (count > left_ / Smallest(step)) return WireFault::kTruncated;
    switch (step.item) {
      case WireItem::kBoolean:
        return OverBooleans(static_cast<std::size_t>(count));
      case WireItem::kString:
        return Repeat(count, [this] { return OverString(); });
      case WireItem::kStruct:
        return Repeat(count, [this, &step] { return Over(table_.layouts[step.size]); });
      default:
        Skip(static_cast<std::size_t>(count) * step.size);
        return WireFault::kNone;
    }
  }

  std::size_t Smallest(const WireStep& step) const {
    if (step.item == WireItem::kString) return 5;
    return step.item == WireItem::kStruct ? table_.layouts[step.size].smallest : step.size;
  }

  template <typename Element>
  static WireFault Repeat(std::uint64_t count, Element&& element) {
    for (; count > 0; --count) {
      const WireFault fault = element();
      if (fault != WireFault::kNone) return fault;
    }
    return WireFault::kNone;
  }

  WireFault OverBooleans(std::size_t count) {
    const bool all_good =
        std::all_of(at_, at_ + count, [](std::uint8_t byte) { return byte <= 1; });
    Skip(count);
    return all_good ? WireFault::kNone : WireFault::kBadBoolean;
  }

  WireFault OverString() {
    std::int64_t size = 0;  // with the NUL
    const WireFault fault = OverLength({WireItem::kLength, 0, 4, 1}, size);
    if (fault == WireFault::kTruncated) return fault;
    if (size <= 0) return WireFault::kBadString;
    const auto length = static_cast<std::size_t>(size);
    if (length > left_) return WireFault::kTruncated;
    const std::string_view content(reinterpret_cast<const char*>(at_), length - 1);
    const bool is_good = at_[length - 1] == 0 && text::IsUtf8(content);
    Skip(length);
    return is_good ? WireFault::kNone : WireFault::kBadString;
  }

  void Skip(std::size_t size) {
    at_ += size;
    left_ -= size;
  }

  const WireTable table_;
  const std::uint8_t* at_;
  std::size_t left_;
};

const WireLayout* FindLayout(WireTable table, Bytes bytes) {
  std::uint64_t mark = 0;
  for (int i = 0; i < 8; ++i) mark = mark << 8 | bytes.data[i];
  const auto fingerprint = static_cast<std::int64_t>(mark);
  const WireLayout* const end = table.layouts + table.n_layouts;
  const WireLayout* const found = std::lower_bound(
      table.layouts, end, fingerprint,
      [](const WireLayout& layout, std::int64_t value) { return layout.fingerprint < value; });
  return found != end && found->fingerprint == fingerprint ? found : nullptr;
}

}  // namespace

WireFault CheckWire(Bytes bytes) {
  if (bytes.size < 8) return WireFault::kTruncated;
  if (bytes.size > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    return WireFault::kTooLarge;
  }
  const WireTable table = GeneratedWireTable();
  const WireLayout* const layout = FindLayout(table, bytes);
  if (layout == nullptr) return WireFault::kWrongType;
  Walk walk(table, {bytes.data + 8, bytes.size - 8});
  const WireFault fault = walk.Over(*layout);
  if (fault != WireFault::kNone) return fault;
  return walk.left() == 0 ? WireFault::kNone : WireFault::kTrailingBytes;
}

const char* Reason(WireFault fault) {
  switch (fault) {
    case WireFault::kWrongType:
      return "wrong_type";
    case WireFault::kTooLarge:
      return "too_large";
    case WireFault::kTruncated:
      return "truncated";
    case WireFault::kTrailingBytes:
      return "trailing_bytes";
    case WireFault::kBadLength:
      return "bad_length";
    case WireFault::kBadString:
      return "bad_string";
    case WireFault::kBadBoolean:
      return "bad_boolean";
    case WireFault::kNone:
      break;
  }
  return "";
}

}  // namespace deixis::messages
