#include "common/config/config.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <set>

#include "common/config/yaml_document.h"

namespace deixis::config {
namespace fs = std::filesystem;

namespace {

fs::path ProgramFolder() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored).parent_path();
}

std::string TextOf(const std::vector<Fault>& faults) {
  std::string all;
  for (const Fault& fault : faults) {
    all += (all.empty() ? "'" : "; '") + fault.key + "' " + fault.text;
  }
  return all;
}

/// Where a configuration file may be, each place once: DEIXIS_CONFIG_DIR may be one of the shipped
/// folders, and an absolute name is the same in all of them.
std::vector<fs::path> PlacesOf(const std::string& name) {
  std::vector<fs::path> places;
  const auto add = [&places](const fs::path& place) {
    const fs::path normal = place.lexically_normal();
    if (std::find(places.begin(), places.end(), normal) == places.end()) places.push_back(normal);
  };
  add(name);
  if (const char* folder = std::getenv("DEIXIS_CONFIG_DIR")) add(fs::path(folder) / name);
  const fs::path program = ProgramFolder();
  add(program / "../share/deixis/config" / name);
  add(program / "../../../config" / name);  // <source>/build/<preset>/bin
  return places;
}

}  // namespace

FaultsFound::FaultsFound(std::vector<Fault> faults)
    : ConfigError(TextOf(faults)), faults_(std::move(faults)) {}

void Faults::Require(bool holds, const std::string& key, const std::string& fault) {
  if (!holds) faults_.push_back({key, fault});
}

void Faults::ThrowIfAny() const {
  if (!faults_.empty()) throw FaultsFound(faults_);
}

struct Reader::State {
  const YamlDocument* document = nullptr;
  YAML::Node node;
  std::string key;  ///< Full name, "tracker.rate_hz"; empty at the top.
  Completeness completeness = Completeness::kDefaultsAllowed;
  std::set<std::string> visited;
  std::unique_ptr<YamlDocument> own_document;  ///< Of the reader at the top.

  std::unique_ptr<State> Child(const YAML::Node& child, const std::string& child_key) const {
    auto state = std::make_unique<State>();
    state->document = document;
    state->node = child;
    state->key = child_key;
    state->completeness = completeness;
    return state;
  }
  std::string FullName(const std::string& name) const {
    return key.empty() ? name : key + "." + name;
  }
};

Reader::Reader(std::unique_ptr<State> state) : state_(std::move(state)) {}
Reader::Reader(Reader&&) noexcept = default;
Reader::~Reader() = default;

void Reader::Fail(const std::string& fault) const {
  const YamlDocument& document = *state_->document;
  const std::string place = document.PlaceOf(state_->key, state_->node.Mark());
  const std::string why = document.OverrideFault(state_->key);
  if (!why.empty()) throw ConfigError(place + ": the value is not valid YAML: " + why);
  throw ConfigError(place + ": key '" + state_->key + "' " + fault);
}

void Reader::Judge(const std::function<void()>& validate) const {
  try {
    validate();
  } catch (const FaultsFound& found) {
    std::string all;
    for (const Fault& fault : found.faults()) {
      const std::string key = state_->FullName(fault.key);
      all += (all.empty() ? "" : "; ") +
             state_->document->PlaceOf(key, MarkOf(state_->node, fault.key)) + ": key '" + key +
             "' " + fault.text;
    }
    throw ConfigError(all);
  } catch (const ConfigError& error) {
    throw ConfigError(state_->document->PlaceOf(state_->key, YAML::Mark::null_mark()) + ": " +
                      error.what());
  }
}

void Reader::RequireMapping() {
  if (!state_->node.IsMap() && !state_->node.IsNull()) Fail("must be a mapping of keys to values");
}

std::unique_ptr<Reader> Reader::Child(const char* name) {
  state_->visited.insert(name);
  const YAML::Node child = state_->node.IsMap() ? state_->node[name] : YAML::Node();
  const std::string key = state_->FullName(name);
  if (!child.IsDefined() || (child.IsNull() && !state_->node.IsMap())) {
    if (state_->completeness == Completeness::kEveryKey) {
      throw ConfigError(state_->document->PlaceOf(key, YAML::Mark::null_mark()) + ": key '" + key +
                        "' is missing; state it");
    }
    return nullptr;
  }
  return std::unique_ptr<Reader>(new Reader(state_->Child(child, key)));
}

std::vector<Reader> Reader::Elements() {
  if (state_->node.IsNull()) return {};
  if (!state_->node.IsSequence()) Fail("must be a list");
  std::vector<Reader> elements;
  for (std::size_t i = 0; i < state_->node.size(); ++i) {
    elements.push_back(
        Reader(state_->Child(state_->node[i], state_->key + "[" + std::to_string(i) + "]")));
  }
  return elements;
}

void Reader::RejectUnknownKeys() {
  if (!state_->node.IsMap()) return;
  for (const auto& entry : state_->node) {
    const auto key = entry.first.as<std::string>();
    if (state_->visited.count(key) != 0) continue;
    std::string known;
    for (const std::string& name : state_->visited) known += (known.empty() ? "" : ", ") + name;
    const std::string full = state_->FullName(key);
    throw ConfigError(state_->document->PlaceOf(full, entry.first.Mark()) + ": key '" + full +
                      "' is not known; known are: " + known);
  }
}

namespace {

template <typename T>
bool Convert(const YAML::Node& node, T& field) {
  try {
    if (!node.IsScalar()) return false;
    field = node.as<T>();
    return true;
  } catch (const YAML::Exception&) {
    return false;
  }
}

}  // namespace

void Reader::ReadScalar(bool& field) {
  if (!Convert(state_->node, field)) Fail("must be true or false");
}
void Reader::ReadScalar(int& field) {
  if (!Convert(state_->node, field)) Fail("must be a whole number");
}
void Reader::ReadScalar(std::int64_t& field) {
  if (!Convert(state_->node, field)) Fail("must be a whole number");
}
void Reader::ReadScalar(std::uint64_t& field) {
  if (!Convert(state_->node, field)) Fail("must be a whole number, 0 or more");
}
void Reader::ReadScalar(double& field) {
  if (!Convert(state_->node, field)) Fail("must be a number");
  if (!(std::abs(field) <= std::numeric_limits<double>::max())) Fail("must be a finite number");
}
void Reader::ReadScalar(std::string& field) {
  if (const std::string* text = state_->document->OverridingText(state_->key)) {
    field = *text;
  } else if (state_->node.IsNull()) {
    field.clear();
  } else if (!Convert(state_->node, field)) {
    Fail("must be a text");
  }
}

Reader OpenFile(const fs::path& path, const std::vector<std::string>& overrides,
                Completeness completeness) {
  auto state = std::make_unique<Reader::State>();
  state->own_document = std::make_unique<YamlDocument>(path, overrides);
  state->document = state->own_document.get();
  state->node.reset(state->document->root());
  state->completeness = completeness;
  return Reader(std::move(state));
}

std::string PlaceOf(const fs::path& path, const std::string& key) {
  const YamlDocument document(path, {});
  YAML::Mark mark = MarkOf(document.root(), key);
  std::string holder = key;
  while (mark.is_null() && holder.find_last_of(".[") != std::string::npos) {
    holder.resize(holder.find_last_of(".["));
    mark = MarkOf(document.root(), holder);
  }
  return document.PlaceOf(key, mark) + ": key '" + key + "'";
}

fs::path FindConfig(const std::string& name) {
  if (name.empty()) throw ConfigError("the name of a configuration file is empty; give one");
  std::string searched;
  for (const fs::path& place : PlacesOf(name)) {
    std::error_code ignored;
    const std::string tried = place.string();
    if (fs::is_regular_file(place, ignored)) return place;
    if (fs::exists(place, ignored)) throw ConfigError("'" + tried + "' is not a file; give one");
    searched += (searched.empty() ? "" : ", ") + tried;
  }
  throw ConfigError("configuration file '" + name + "' not found; searched: " + searched);
}

std::vector<fs::path> FindConfigs(const std::string& folder) {
  std::map<std::string, fs::path> found;
  std::string searched;
  for (const fs::path& place : PlacesOf(folder)) {
    std::error_code none;
    for (fs::directory_iterator at(place, none), end; !none && at != end; at.increment(none)) {
      if (at->path().extension() == ".yaml") found.emplace(at->path().filename(), at->path());
    }
    searched += (searched.empty() ? "" : ", ") + place.string();
  }
  if (found.empty()) {
    throw ConfigError("no configuration files in '" + folder + "'; searched: " + searched);
  }
  std::vector<fs::path> files;
  for (const auto& [name, file] : found) files.push_back(file);
  return files;
}

fs::path FindConfig(const std::string& name, const std::string& cure) {
  try {
    return FindConfig(name);
  } catch (const ConfigError& error) {
    throw ConfigError(error.what() + ("; " + cure));
  }
}

}  // namespace deixis::config
