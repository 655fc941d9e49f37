#include "common/anatomy/glossary.h"

#include <algorithm>
#include <iterator>

#include "common/config/config.h"

namespace deixis::anatomy {
namespace {

struct TermEntry {
  Names names;
  std::string printed, why;

  template <typename Visitor>
  void Visit(Visitor& v) {
    names.Visit(v);
    v("printed", printed);
    v("why", why);
  }
  void Validate() const {
    config::Faults faults;
    names.Require(faults);
    faults.ThrowIfAny();
  }
};

struct SectionEntry {
  std::string english, german;
  std::vector<TermEntry> terms;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("english", english);
    v("german", german);
    v("terms", terms);
  }
};

struct GlossaryFile {
  std::vector<SectionEntry> sections;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("sections", sections);
  }
};

std::string WithoutBrackets(const std::string& text) {
  return !text.empty() && text.back() == ')' ? text.substr(0, text.find(" (")) : text;
}

Names WithoutBrackets(const Names& names) {
  return {WithoutBrackets(names.english), WithoutBrackets(names.german),
          WithoutBrackets(names.latin)};
}

}  // namespace

Glossary Glossary::Load(const std::filesystem::path& path) {
  Glossary glossary;
  for (const SectionEntry& section : config::Load<GlossaryFile>(path).sections) {
    for (const TermEntry& term : section.terms) {
      glossary.terms_.push_back({term.names, section.english, term.printed, term.why});
    }
  }
  return glossary;
}

std::vector<Term> Glossary::Find(const std::string& name) const {
  std::vector<Term> found;
  std::copy_if(terms_.begin(), terms_.end(), std::back_inserter(found), [&name](const Term& term) {
    return term.names.Match(name) || WithoutBrackets(term.names).Match(name);
  });
  return found;
}

}  // namespace deixis::anatomy
