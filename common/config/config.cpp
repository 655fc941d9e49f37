#include "common/config/config.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <set>

namespace deixis::config {
namespace fs = std::filesystem;

namespace {

std::string Place(const std::string& file, const YAML::Mark& mark) {
  return mark.is_null() ? file : file + ":" + std::to_string(mark.line + 1);
}

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

void Override(YAML::Node root, const std::string& assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw ConfigError("override '" + assignment + "' is not of the form key=value");
  }
  YAML::Node node;
  node.reset(root);
  std::string rest = assignment.substr(0, equals);
  for (auto dot = rest.find('.'); dot != std::string::npos; dot = rest.find('.')) {
    YAML::Node next = node[rest.substr(0, dot)];
    node.reset(next);
    rest = rest.substr(dot + 1);
  }
  node[rest] = YAML::Load(assignment.substr(equals + 1));
}

fs::path ProgramFolder() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored).parent_path();
}

}  // namespace

void Faults::Require(bool holds, const std::string& key, const std::string& fault) {
  if (!holds) faults_.push_back("'" + key + "' " + fault);
}

void Faults::ThrowIfAny() const {
  if (faults_.empty()) return;
  std::string all;
  for (const std::string& fault : faults_) all += (all.empty() ? "" : "; ") + fault;
  throw ConfigError(all);
}

struct Reader::State {
  YAML::Node node;
  std::string file;
  std::string key;  ///< Full name, "tracker.rate_hz"; empty at the top.
  Completeness completeness = Completeness::kDefaultsAllowed;
  std::set<std::string> visited;

  std::unique_ptr<State> Child(const YAML::Node& child, const std::string& child_key) const {
    auto state = std::make_unique<State>();
    state->node = child;
    state->file = file;
    state->key = child_key;
    state->completeness = completeness;
    return state;
  }
};

Reader::Reader(std::unique_ptr<State> state) : state_(std::move(state)) {}
Reader::Reader(Reader&&) noexcept = default;
Reader::~Reader() = default;

void Reader::Fail(const std::string& fault) const {
  throw ConfigError(Place(state_->file, state_->node.Mark()) + ": key '" + state_->key + "' " +
                    fault);
}

void Reader::RequireMapping() {
  if (!state_->node.IsMap() && !state_->node.IsNull()) Fail("must be a mapping of keys to values");
}

std::unique_ptr<Reader> Reader::Child(const char* name) {
  state_->visited.insert(name);
  const YAML::Node child = state_->node.IsMap() ? state_->node[name] : YAML::Node();
  const std::string key = state_->key.empty() ? name : state_->key + "." + name;
  if (!child.IsDefined() || (child.IsNull() && !state_->node.IsMap())) {
    if (state_->completeness == Completeness::kEveryKey) {
      throw ConfigError(state_->file + ": key '" + key + "' is missing; state it");
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
    throw ConfigError(Place(state_->file, entry.first.Mark()) + ": key '" +
                      (state_->key.empty() ? key : state_->key + "." + key) +
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
  if (state_->node.IsNull()) {
    field.clear();
  } else if (!Convert(state_->node, field)) {
    Fail("must be a text");
  }
}

Reader OpenFile(const fs::path& path, const std::vector<std::string>& overrides,
                Completeness completeness) {
  auto state = std::make_unique<Reader::State>();
  state->file = path.string();
  state->completeness = completeness;
  try {
    state->node = YAML::LoadFile(path.string());
    RejectDuplicates(state->node, state->file, "");
    for (const std::string& assignment : overrides) Override(state->node, assignment);
  } catch (const YAML::BadFile&) {
    throw ConfigError(path.string() + ": cannot be read; give an existing YAML file");
  } catch (const YAML::Exception& error) {
    throw ConfigError(Place(path.string(), error.mark) + ": is not valid YAML: " + error.msg);
  }
  if (!state->node.IsMap() && !state->node.IsNull()) {
    throw ConfigError(path.string() + ": must be a mapping of keys to values");
  }
  return Reader(std::move(state));
}

fs::path FindConfig(const std::string& name) {
  std::vector<fs::path> places{name};
  if (const char* folder = std::getenv("DEIXIS_CONFIG_DIR"))
    places.push_back(fs::path(folder) / name);
  const fs::path program = ProgramFolder();
  places.push_back(program / "../share/deixis/config" / name);
  places.push_back(program / "../../../config" / name);  // <source>/build/<preset>/bin
  std::string searched;
  for (const fs::path& place : places) {
    std::error_code ignored;
    if (fs::is_regular_file(place, ignored)) return place.lexically_normal();
    searched += (searched.empty() ? "" : ", ") + place.lexically_normal().string();
  }
  throw ConfigError("configuration file '" + name + "' not found; searched: " + searched);
}

}  // namespace deixis::config
