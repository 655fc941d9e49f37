#include "common/transport/log_writer.h"

#include <cerrno>
#include <cstring>

#include "common/transport/bus.h"

namespace deixis::transport {

LogWriter::LogWriter(std::string path) : path_(std::move(path)) {
  log_ = lcm_eventlog_create(path_.c_str(), "w");
  if (log_ == nullptr) {
    throw BusError("log '" + path_ + "' cannot be written: " + std::strerror(errno) +
                   "; check the folder and its rights");
  }
}

LogWriter::~LogWriter() { lcm_eventlog_destroy(log_); }

void LogWriter::Fail() const {
  throw BusError("log '" + path_ + "' cannot be written any further: " + std::strerror(errno) +
                 "; free some space on that disk");
}

void LogWriter::Write(const std::string& channel, messages::Bytes bytes, Timestamp time) {
  lcm_eventlog_event_t event{};
  event.timestamp = time.microseconds;
  event.channellen = static_cast<std::int32_t>(channel.size());
  event.channel = const_cast<char*>(channel.c_str());
  event.datalen = static_cast<std::int32_t>(bytes.size);
  event.data = const_cast<std::uint8_t*>(bytes.data);
  if (lcm_eventlog_write_event(log_, &event) != 0) Fail();
}

void LogWriter::Flush() {
  if (std::fflush(log_->f) != 0) Fail();
}

}  // namespace deixis::transport
