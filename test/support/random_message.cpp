#include "test/support/random_message.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "common/messages/wire_layout.h"

namespace deixis::test {
namespace {

using messages::GeneratedWireTable;
using messages::kMostWireSlots;
using messages::WireItem;
using messages::WireLayout;
using messages::WireStep;
using messages::WireTable;

class Writer {
 public:
  Writer(Random& random, unsigned most_elements) : random_(random), most_elements_(most_elements) {}

  void Struct(const WireLayout& layout) {
    std::array<std::uint32_t, kMostWireSlots> lengths{};
    for (const WireStep *step = table_.steps + layout.first, *end = step + layout.n_steps;
         step != end; ++step) {
      const auto slot = static_cast<std::size_t>(step->slot);
      if (step->item == WireItem::kLength) {
        lengths[slot] = Below(most_elements_ + 1);
        Number(lengths[slot], step->size);
      } else {
        const std::uint32_t times = step->slot < 0 ? 1 : lengths[slot];
        for (std::uint32_t i = 0; i < step->count * times; ++i) Element(*step);
      }
    }
  }

  void Number(std::uint64_t value, std::uint32_t size) {
    for (std::uint32_t i = size; i > 0; --i) {
      bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * (i - 1))));
    }
  }

  std::vector<std::uint8_t> bytes() && { return std::move(bytes_); }

 private:
  void Element(const WireStep& step) {
    switch (step.item) {
      case WireItem::kStruct:
        return Struct(table_.layouts[step.size]);
      case WireItem::kString:
        return String();
      case WireItem::kBoolean:
        return Number(Below(2), 1);
      default:
        return Numbers(step.size);
    }
  }

  void String() {
    static constexpr std::array<const char*, 10> kTexts{
        "",     "camera", "none",  "cup \xC3\xA9", "plumb_bob", "a longer text",
        "rgb8", "16UC1",  "32FC1", "jpeg"};
    const std::string text = kTexts[Below(kTexts.size())];
    Number(text.size() + 1, 4);
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    bytes_.push_back(0);
  }

  // A run of numbers, each zero as often as not.
  void Numbers(std::uint32_t size) {
    for (std::uint32_t i = 0; i < size; i += 8) {
      const std::uint64_t value = Below(2) == 0 ? 0 : (std::uint64_t{random_()} << 33 ^ random_());
      Number(value, std::min(size - i, 8U));
    }
  }

  std::uint32_t Below(std::size_t end) { return static_cast<std::uint32_t>(random_() % end); }

  const WireTable table_ = GeneratedWireTable();
  Random& random_;
  unsigned most_elements_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

std::vector<WireType> AllWireTypes() {
  const WireTable table = GeneratedWireTable();
  std::vector<WireType> types;
  for (const WireLayout* layout = table.layouts; layout != table.layouts + table.n_layouts;
       ++layout) {
    types.push_back({layout->name, layout->fingerprint});
  }
  std::sort(types.begin(), types.end(),
            [](const WireType& a, const WireType& b) { return a.name < b.name; });
  return types;
}

std::vector<std::uint8_t> RandomMessage(const std::string& name, Random& random,
                                        unsigned most_elements) {
  const WireTable table = GeneratedWireTable();
  const WireLayout* const end = table.layouts + table.n_layouts;
  const WireLayout* const layout = std::find_if(
      table.layouts, end, [&name](const WireLayout& candidate) { return candidate.name == name; });
  if (layout == end) throw std::logic_error("no message type '" + name + "'");
  Writer writer(random, most_elements);
  writer.Number(static_cast<std::uint64_t>(layout->fingerprint), 8);
  writer.Struct(*layout);
  return std::move(writer).bytes();
}

void SetFingerprint(std::int64_t fingerprint, std::uint8_t* message) {
  for (int i = 0; i < 8; ++i) {
    message[i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(fingerprint) >> (56 - 8 * i));
  }
}

}  // namespace deixis::test
