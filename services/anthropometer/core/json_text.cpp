#include "services/anthropometer/core/json_text.h"

#include <cstdio>

namespace deixis::anthropometer {
namespace {

std::string Joined(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "" : ", ") + item;
  return text;
}

}  // namespace

std::string JsonString(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += {'\\', c};
    } else if (static_cast<unsigned char>(c) < 0x20) {
      char escaped[8];
      std::snprintf(escaped, sizeof escaped, "\\u%04x", c);
      quoted += escaped;
    } else {
      quoted += c;
    }
  }
  return quoted + "\"";
}

std::string JsonNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.13g", value + 0.0);  // No "-0".
  return text;
}

std::string JsonArray(const std::vector<std::string>& items) { return "[" + Joined(items) + "]"; }

std::string JsonObject(const std::vector<JsonMember>& members) {
  std::vector<std::string> items;
  for (const JsonMember& member : members) {
    items.push_back(JsonString(member.key) + ": " + member.value);
  }
  return "{" + Joined(items) + "}";
}

}  // namespace deixis::anthropometer
