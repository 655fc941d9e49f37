#pragma once
#include <string>
#include <utility>
#include <vector>

namespace deixis::config {
class Faults;
}

namespace deixis::anatomy {

/// The languages in which people name parts of the body.
enum class Language { kEnglish, kGerman, kLatin };

inline auto EnumNames(Language) {
  return std::vector<std::pair<std::string, Language>>{
      {"en", Language::kEnglish}, {"de", Language::kGerman}, {"la", Language::kLatin}};
}

/// What is called by one name in each language; Latin or Greek.
struct Names {
  std::string english;
  std::string german;
  std::string latin;

  const std::string& In(Language language) const;

  /// Whether it is called `name` in any language: letters of either case, spaces and underscores
  /// alike. ASCII letters only change their case; ä, ö, ü and ß may be written ae, oe, ue and ss.
  bool Match(const std::string& name) const;

  /// Three keys of a mapping in a file.
  template <typename Visitor>
  void Visit(Visitor& v) {
    v("english", english);
    v("german", german);
    v("latin", latin);
  }
  void Require(config::Faults& faults) const;  ///< Notes what is empty.
};

/// What a file has a key for (a joint, a motion, a measure), and what people call it.
struct NamedTerm {
  std::string name;
  Names names;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("name", name);
    names.Visit(v);
  }
  void Require(config::Faults& faults) const;  ///< Notes what is empty.
  void Validate() const;                       ///< Throws FaultsFound.
};

}  // namespace deixis::anatomy
