#include "services/offline/log_reader.h"

#include <lcm/eventlog.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace deixis::offline {

struct LogReader::Implementation {
  ~Implementation() {
    FreeEvent();
    if (log != nullptr) lcm_eventlog_destroy(log);
  }
  void FreeEvent() {
    if (event != nullptr) lcm_eventlog_free_event(event);
    event = nullptr;
  }
  lcm_eventlog_t* log = nullptr;
  lcm_eventlog_event_t* event = nullptr;
  std::int64_t size = 0;
  std::int64_t end_of_last_event = 0;
};

LogReader::LogReader(const std::string& path)
    : implementation_(std::make_unique<Implementation>()) {
  std::error_code error;
  implementation_->size = static_cast<std::int64_t>(std::filesystem::file_size(path, error));
  if (!error) implementation_->log = lcm_eventlog_create(path.c_str(), "r");
  if (implementation_->log == nullptr) {
    throw transport::BusError(
        "log '" + path + "' cannot be read: " + (error ? error.message() : std::strerror(errno)) +
        "; give an existing LCM log");
  }
}

LogReader::~LogReader() = default;

bool LogReader::Next() {
  Implementation& in = *implementation_;
  in.FreeEvent();
  in.event = lcm_eventlog_read_next_event(in.log);
  if (in.event == nullptr) return false;
  in.end_of_last_event = std::ftell(in.log->f);
  event_ = {std::string(in.event->channel, static_cast<std::size_t>(in.event->channellen)),
            {static_cast<const std::uint8_t*>(in.event->data),
             static_cast<std::size_t>(in.event->datalen)},
            in.event->timestamp};
  return true;
}

double LogReader::progress() const {
  const Implementation& in = *implementation_;
  if (in.size == 0) return 1.0;
  return static_cast<double>(in.end_of_last_event) / static_cast<double>(in.size);
}

std::int64_t LogReader::unreadable_bytes() const {
  return implementation_->size - implementation_->end_of_last_event;
}

}  // namespace deixis::offline
