#include "common/logging/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>

namespace deixis::logging {
namespace {

struct Log {
  std::shared_ptr<spdlog::logger> logger = MakeLogger();
  std::string service = "deixis";

  static std::shared_ptr<spdlog::logger> MakeLogger() {
    auto made = std::make_shared<spdlog::logger>("deixis",
                                                 std::make_shared<spdlog::sinks::stderr_sink_mt>());
    made->set_pattern("%Y-%m-%dT%H:%M:%S.%e %l %v");
    made->flush_on(spdlog::level::info);
    return made;
  }
};

Log& TheLog() {
  static Log log;
  return log;
}

// Values with blanks or line breaks are quoted, so that a line stays one line and splits at blanks.
std::string Quoted(const std::string& value) {
  const bool is_plain = !value.empty() && std::none_of(value.begin(), value.end(), [](char c) {
    return c == ' ' || c == '"' || static_cast<unsigned char>(c) < 0x20;
  });
  if (is_plain) return value;
  std::string quoted = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return quoted + '"';
}

void Write(spdlog::level::level_enum level, const std::string& event,
           std::initializer_list<Field> fields) {
  std::string line = TheLog().service + ' ' + event;
  for (const Field& field : fields) line += ' ' + field.key + '=' + Quoted(field.value);
  TheLog().logger->log(level, "{}", line);
}

}  // namespace

void SetService(const std::string& service) { TheLog().service = service; }

void Info(const std::string& event, std::initializer_list<Field> fields) {
  Write(spdlog::level::info, event, fields);
}
void Warn(const std::string& event, std::initializer_list<Field> fields) {
  Write(spdlog::level::warn, event, fields);
}
void Error(const std::string& event, std::initializer_list<Field> fields) {
  Write(spdlog::level::err, event, fields);
}

}  // namespace deixis::logging
