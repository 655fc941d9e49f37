#include "common/config/yaml_document.h"

#include <yaml-cpp/eventhandler.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "common/config/config.h"

namespace deixis::config {
namespace fs = std::filesystem;

namespace {

constexpr int kDeepestNesting = 32;  // Configurations have five levels.

std::string Place(const std::string& file, const YAML::Mark& mark) {
  return mark.is_null() ? file : file + ":" + std::to_string(mark.line + 1);
}

/// Refuses, while a document is read, what a configuration has no use for.
class PlainYaml final : public YAML::EventHandler {
 public:
  explicit PlainYaml(std::string file) : file_(std::move(file)) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ == 1) return;
    throw ConfigError(Place(file_, mark) +
                      ": a second document begins; a configuration is one, remove its '---'");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    RefuseAnchor(mark, anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    RefuseAnchor(mark, anchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                const std::string&) override {
    RefuseAnchor(mark, anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    Enter(mark, anchor);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    Enter(mark, anchor);
  }
  void OnMapEnd() override { --depth_; }

 private:
  void RefuseAnchor(const YAML::Mark& mark, YAML::anchor_t anchor) const {
    if (anchor == YAML::NullAnchor) return;
    throw ConfigError(Place(file_, mark) +
                      ": anchors and aliases (& and *) are not taken; write the value out, or "
                      "quote a text that begins so");
  }
  void Enter(const YAML::Mark& mark, YAML::anchor_t anchor) {
    RefuseAnchor(mark, anchor);
    if (++depth_ <= kDeepestNesting) return;
    throw ConfigError(Place(file_, mark) + ": is nested more than " +
                      std::to_string(kDeepestNesting) + " levels deep; no configuration is");
  }

  std::string file_;
  int depth_ = 0;
  int documents_ = 0;
};

void RejectDuplicates(const YAML::Node& node, const std::string& file, const std::string& path) {
  if (node.IsSequence()) {
    for (const auto& element : node) RejectDuplicates(element, file, path);
  }
  if (!node.IsMap()) return;
  std::set<std::string> seen;
  for (const auto& entry : node) {
    const auto key = entry.first.as<std::string>();
    if (!seen.insert(key).second) {
      throw ConfigError(Place(file, entry.first.Mark()) + ": key '" + path + key +
                        "' is given twice; remove one of them");
    }
    RejectDuplicates(entry.second, file, path + key + ".");
  }
}

YAML::Node ParsePlain(const std::string& text, const std::string& file) {
  std::istringstream in(text);
  YAML::Parser parser(in);
  PlainYaml check(file);
  while (parser.HandleNextDocument(check)) {
  }
  YAML::Node node = YAML::Load(text);
  RejectDuplicates(node, file, "");
  return node;
}

std::string ReadText(const fs::path& path) {
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  try {
    if (in) return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  } catch (const std::ios_base::failure&) {
    // The one message below serves both.
  }
  throw ConfigError(path.string() + ": cannot be read: " + std::strerror(errno) +
                    "; give an existing YAML file");
}

bool CanHaveKeys(const YAML::Node& node) {
  return !node.IsDefined() || node.IsNull() || node.IsMap();
}

/// Sets `value` under `key`, dots for nested keys, below `root`.
void Set(YAML::Node root, const std::string& key, const YAML::Node& value) {
  YAML::Node node;
  node.reset(root);
  std::size_t begin = 0;
  for (auto dot = key.find('.'); dot != std::string::npos; dot = key.find('.', begin)) {
    YAML::Node next = node[key.substr(begin, dot - begin)];
    if (!CanHaveKeys(next)) throw ConfigError("'" + key.substr(0, dot) + "' is not a mapping");
    node.reset(next);
    begin = dot + 1;
  }
  node[key.substr(begin)] = value;
}

/// Whether `key` is `outer` or lies below it.
bool IsWithin(const std::string& key, const std::string& outer) {
  if (key.compare(0, outer.size(), outer) != 0) return false;
  return key.size() == outer.size() || key[outer.size()] == '.' || key[outer.size()] == '[';
}

YAML::Node ChildOf(const YAML::Node& node, const std::string& name) {
  if (node.IsMap()) return node[name];
  const bool is_index = !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isdigit(c) != 0;
  });
  if (node.IsSequence() && is_index) return node[std::stoul(name)];
  return YAML::Node(YAML::NodeType::Undefined);
}

/// "places[2].label" as "places.2.label".
std::string Dotted(const std::string& key) {
  std::string dotted;
  for (const char c : key) {
    if (c != ']') dotted += c == '[' ? '.' : c;
  }
  return dotted;
}

YAML::Mark MarkOfDotted(const YAML::Node& node, const std::string& key) {
  if (key.empty()) return node.Mark();
  const auto dot = key.find('.');
  const YAML::Node child = ChildOf(node, key.substr(0, dot));
  if (!child.IsDefined()) return YAML::Mark::null_mark();
  return MarkOfDotted(child, dot == std::string::npos ? "" : key.substr(dot + 1));
}

}  // namespace

YAML::Mark MarkOf(const YAML::Node& node, const std::string& key) {
  return MarkOfDotted(node, Dotted(key));
}

YamlDocument::YamlDocument(const fs::path& path, const std::vector<std::string>& overrides)
    : file_(path.string()) {
  try {
    root_ = ParsePlain(ReadText(path), file_);
  } catch (const YAML::Exception& error) {
    throw ConfigError(Place(file_, error.mark) + ": is not valid YAML: " + error.msg);
  }
  if (!CanHaveKeys(root_)) throw ConfigError(file_ + ": must be a mapping of keys to values");
  for (const std::string& assignment : overrides) Apply(assignment);
}

void YamlDocument::Apply(const std::string& assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw ConfigError("override '" + assignment + "' is not of the form key=value");
  }
  Override override{assignment, assignment.substr(0, equals), assignment.substr(equals + 1), ""};
  const YAML::Node value = ValueOf(override);
  try {
    Set(root_, override.key, value);
  } catch (const ConfigError& error) {
    throw ConfigError("override '" + assignment + "': " + error.what());
  }
  overrides_.push_back(std::move(override));
}

/// What is no plain YAML ("*.jpg") is a text.
YAML::Node YamlDocument::ValueOf(Override& override) const {
  try {
    const YAML::Node value = ParsePlain(override.text, override.key);
    const bool is_quoted = value.IsScalar() && value.Tag() == "!";
    if (is_quoted) override.text = value.Scalar();
    return value;
  } catch (const YAML::Exception& error) {
    override.fault = error.msg;
  } catch (const ConfigError& error) {
    override.fault = error.what();
  }
  return YAML::Node(override.text);
}

const YamlDocument::Override* YamlDocument::OverrideOf(const std::string& key) const {
  const auto last =
      std::find_if(overrides_.rbegin(), overrides_.rend(),
                   [&key](const Override& override) { return IsWithin(key, override.key); });
  return last == overrides_.rend() ? nullptr : &*last;
}

const YamlDocument::Override* YamlDocument::OverrideBelow(const std::string& key) const {
  const auto last =
      std::find_if(overrides_.rbegin(), overrides_.rend(),
                   [&key](const Override& override) { return IsWithin(override.key, key); });
  return last == overrides_.rend() ? nullptr : &*last;
}

std::string YamlDocument::PlaceOf(const std::string& key, const YAML::Mark& mark) const {
  const Override* override = OverrideOf(key);
  // What no line of the file says comes from an override of something below.
  if (override == nullptr && mark.is_null()) override = OverrideBelow(key);
  return override == nullptr ? Place(file_, mark) : "override '" + override->assignment + "'";
}

const std::string* YamlDocument::OverridingText(const std::string& key) const {
  const Override* override = OverrideOf(key);
  return override != nullptr && override->key == key ? &override->text : nullptr;
}

std::string YamlDocument::OverrideFault(const std::string& key) const {
  const Override* override = OverrideOf(key);
  return override == nullptr ? "" : override->fault;
}

}  // namespace deixis::config
