#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "common/anatomy/terms.h"

namespace deixis::anatomy {

/// A term of anatomy, as a file of the glossary has it.
struct Term {
  Names names;
  std::string section;  ///< English.
  std::string printed;  ///< What the source prints instead; empty = the same.
  std::string why;      ///< Why it is another one here.
};

class Glossary {
 public:
  /// Reads config/kinematics/glossary.yaml. Throws ConfigError naming file, line and key.
  static Glossary Load(const std::filesystem::path& path);

  const std::vector<Term>& terms() const { return terms_; }
  /// All that are called so in any language, brackets at its end left out or not; a name alone is
  /// no key.
  std::vector<Term> Find(const std::string& name) const;

 private:
  std::vector<Term> terms_;
};

}  // namespace deixis::anatomy
