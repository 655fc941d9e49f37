#pragma once
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "common/transport/bus.h"

namespace deixis::offline {

/// Bytes of a log that belong to no whole event.
struct DamagedPart {
  std::int64_t offset = 0;
  std::int64_t bytes = 0;
};

/// Reads an LCM log from its beginning to its end. Where it is damaged or cut off, it goes on with
/// the next event. Throws BusError when it cannot be opened or read.
class LogReader {
 public:
  explicit LogReader(const std::string& path);

  /// Takes the next event; false at the end. The event stays valid until the next call.
  bool Next();
  const transport::RawMessage& event() const { return event_; }
  /// Share of the file that has been read, 0..1.
  double progress() const;
  std::int64_t size_bytes() const { return size_; }
  /// What has been passed over so far, in order.
  const std::vector<DamagedPart>& damaged() const { return damaged_; }
  /// Whole events that were passed over since their channel has no name.
  std::int64_t nameless_events() const { return nameless_events_; }

 private:
  struct Header {
    std::int64_t timestamp_us = 0;
    std::int64_t channel_bytes = 0;
    std::int64_t data_bytes = 0;
    std::int64_t end() const;  ///< Of the event, behind its own beginning.
  };
  std::optional<Header> HeaderAt(std::int64_t offset);
  bool MayEndAt(std::int64_t offset);
  void Take(const Header& header);
  void PassOverDamage();
  std::int64_t FindEventFrom(std::int64_t offset);
  std::vector<std::uint8_t> Read(std::int64_t offset, std::int64_t bytes);

  std::string path_;
  std::ifstream file_;
  std::int64_t size_ = 0;
  std::int64_t position_ = 0;  ///< Of the next event.
  std::vector<std::uint8_t> content_;
  transport::RawMessage event_;
  std::vector<DamagedPart> damaged_;
  std::int64_t nameless_events_ = 0;
};

}  // namespace deixis::offline
