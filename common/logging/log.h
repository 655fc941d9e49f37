#pragma once
#include <initializer_list>
#include <sstream>
#include <string>
#include <utility>

namespace deixis::logging {

/// One `key=value` of a log line; any type that streams.
struct Field {
  template <typename T>
  Field(std::string field_key, const T& field_value) : key(std::move(field_key)) {
    std::ostringstream stream;
    stream << field_value;
    value = stream.str();
  }
  std::string key;
  std::string value;
};

/// Names the service in every later line; call once, at the start of a program.
void SetService(const std::string& service);

/// Write one line to standard error: time, level, service, `event` (a word with underscores that
/// programs can look for) and the fields, values with blanks quoted. Info is news, Warn what works
/// less well than it should, Error what ends the program.
void Info(const std::string& event, std::initializer_list<Field> fields = {});
void Warn(const std::string& event, std::initializer_list<Field> fields = {});
void Error(const std::string& event, std::initializer_list<Field> fields = {});

}  // namespace deixis::logging
