#pragma once
#include <lcm/eventlog.h>

#include <string>

#include "common/messages/codec.h"

namespace deixis::transport {

/// Writes an LCM log. Throws BusError when the file cannot be created or written.
class LogWriter {
 public:
  explicit LogWriter(std::string path);
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  void Write(const std::string& channel, messages::Bytes bytes, Timestamp time);
  void Flush();

 private:
  [[noreturn]] void Fail() const;

  std::string path_;
  lcm_eventlog_t* log_ = nullptr;
};

}  // namespace deixis::transport
