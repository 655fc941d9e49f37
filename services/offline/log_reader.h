#pragma once
#include <cstdint>
#include <memory>
#include <string>

#include "common/transport/bus.h"

namespace deixis::offline {

/// Reads an LCM log from its beginning to its end. Throws BusError when it cannot be opened.
class LogReader {
 public:
  explicit LogReader(const std::string& path);
  ~LogReader();

  /// Takes the next event; false at the end. The event stays valid until the next call.
  bool Next();
  const transport::RawMessage& event() const { return event_; }
  /// Share of the file that has been read, 0..1.
  double progress() const;
  /// Bytes at the end that are no whole event: the log was cut off or is damaged there.
  std::int64_t unreadable_bytes() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
  transport::RawMessage event_;
};

}  // namespace deixis::offline
