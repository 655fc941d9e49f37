#pragma once
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <string>
#include <vector>

namespace deixis::config {

/// A YAML file with overrides set over its values, which knows where each value comes from. Plain
/// YAML only: neither anchors nor aliases, which could hold themselves or grow without bound.
class YamlDocument {
 public:
  /// Throws ConfigError naming file and line, or the override that is at fault.
  YamlDocument(const std::filesystem::path& path, const std::vector<std::string>& overrides);

  const YAML::Node& root() const { return root_; }

  /// Where `key` ("tracker.rate_hz") got its value, `mark` being its place in the file: "file:12"
  /// or "override 'tracker.rate_hz=x'".
  std::string PlaceOf(const std::string& key, const YAML::Mark& mark) const;

  /// The text that an override gives to just this key; nullptr when there is none.
  const std::string* OverridingText(const std::string& key) const;

  /// Why the override that gives `key` its value is no YAML; empty when it is, or there is none.
  std::string OverrideFault(const std::string& key) const;

 private:
  struct Override {
    std::string assignment;  ///< "tracker.rate_hz=30"
    std::string key;
    std::string text;   ///< The value as it was given; without its quotes when it has such.
    std::string fault;  ///< Why it is no YAML; then it can be a text only.
  };
  const Override* OverrideOf(const std::string& key) const;
  const Override* OverrideBelow(const std::string& key) const;
  YAML::Node ValueOf(Override& override) const;
  void Apply(const std::string& assignment);

  std::string file_;
  YAML::Node root_;
  std::vector<Override> overrides_;
};

/// The place in its file of the value that `key` names ("places[2].label") within `node`; a null
/// mark when the file does not state it.
YAML::Mark MarkOf(const YAML::Node& node, const std::string& key);

}  // namespace deixis::config
