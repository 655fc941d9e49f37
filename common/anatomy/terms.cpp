#include "common/anatomy/terms.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "common/config/config.h"

namespace deixis::anatomy {
namespace {

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

std::string WithSingleSpaces(std::string text) {
  const auto are_spaces = [](char left, char right) { return left == ' ' && right == ' '; };
  text.erase(std::unique(text.begin(), text.end(), are_spaces), text.end());
  return text;
}

std::string Plain(std::string text) {
  for (char& letter : text) {
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    if (letter == '_') letter = ' ';
  }
  for (const auto& [umlaut, letters] :
       std::vector<std::pair<std::string, std::string>>{{"ä", "ae"},
                                                        {"ö", "oe"},
                                                        {"ü", "ue"},
                                                        {"Ä", "ae"},
                                                        {"Ö", "oe"},
                                                        {"Ü", "ue"},
                                                        {"ß", "ss"}}) {
    text = Replaced(text, umlaut, letters);
  }
  return WithSingleSpaces(std::move(text));
}

}  // namespace

const std::string& Names::In(Language language) const {
  switch (language) {
    case Language::kGerman:
      return german;
    case Language::kLatin:
      return latin;
    case Language::kEnglish:
      break;
  }
  return english;
}

bool Names::Match(const std::string& name) const {
  const std::string plain = Plain(name);
  return !plain.empty() &&
         (plain == Plain(english) || plain == Plain(german) || plain == Plain(latin));
}

void Names::Require(config::Faults& faults) const {
  faults.Require(!english.empty(), "english", "must not be empty");
  faults.Require(!german.empty(), "german", "must not be empty");
  faults.Require(!latin.empty(), "latin", "must not be empty");
}

void NamedTerm::Require(config::Faults& faults) const {
  faults.Require(!name.empty(), "name", "must not be empty");
  names.Require(faults);
}

void NamedTerm::Validate() const {
  config::Faults faults;
  Require(faults);
  faults.ThrowIfAny();
}

}  // namespace deixis::anatomy
