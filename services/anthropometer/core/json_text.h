#pragma once
#include <string>
#include <vector>

namespace deixis::anthropometer {

/// A string of JSON, of UTF-8 text.
std::string JsonString(const std::string& text);

/// A number of JSON, with so many significant digits that a length is exact to 1e-12.
std::string JsonNumber(double value);

/// An array of what is JSON already.
std::string JsonArray(const std::vector<std::string>& items);

/// One member of an object, of what is JSON already.
struct JsonMember {
  std::string key;
  std::string value;
};

std::string JsonObject(const std::vector<JsonMember>& members);

}  // namespace deixis::anthropometer
