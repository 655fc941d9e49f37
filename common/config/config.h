#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace deixis::config {

/// What is wrong with a configuration: names the file, the line and the key, and says the cure.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What is wrong with one key: "must be positive".
struct Fault {
  std::string key;
  std::string text;
};

/// A config struct whose values make no sense; its keys are named as that struct names them.
class FaultsFound : public ConfigError {
 public:
  explicit FaultsFound(std::vector<Fault> faults);
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

/// Collects what is wrong with a config struct, so that Validate() can report everything at once.
class Faults {
 public:
  /// Notes `fault` ("must be positive") against `key` unless `holds`.
  void Require(bool holds, const std::string& key, const std::string& fault);
  void ThrowIfAny() const;  ///< Throws FaultsFound with all faults.

 private:
  std::vector<Fault> faults_;
};

/// How complete a file has to be.
enum class Completeness {
  kDefaultsAllowed,  ///< Keys that are left out keep their defaults.
  kEveryKey          ///< Every key must be stated: shipped files are the parameter manual.
};

/// A YAML mapping that is being read into a struct. A config struct names its fields in
/// `template <typename Visitor> void Visit(Visitor& v) { v("rate_hz", rate_hz); ... }`; fields may
/// be bool, integers, double, std::string, enumerations with an `EnumNames`, structs with `Visit`,
/// and std::vector of these. A struct with `void Validate() const` is checked as soon as it is
/// read, nested ones before the outer one. An enumeration gets its names from a function beside it:
/// `inline auto EnumNames(Pace) { return std::vector<std::pair<std::string, Pace>>{...}; }`.
class Reader {
 public:
  ~Reader();
  Reader(Reader&&) noexcept;

  template <typename T>
  void operator()(const char* name, T& field) {
    if (const auto child = Child(name)) child->Read(field);
  }

  template <typename T>
  void Read(T& field) {
    if constexpr (std::is_enum_v<T>) {
      ReadEnum(field);
    } else if constexpr (HasVisit<T>::value) {
      ReadStruct(field);
    } else {
      ReadScalar(field);
    }
  }

  template <typename T>
  void Read(std::vector<T>& field) {
    field.clear();
    for (Reader& element : Elements()) {
      T value{};
      element.Read(value);
      field.push_back(std::move(value));
    }
  }

 private:
  template <typename T, typename = void>
  struct HasVisit : std::false_type {};
  template <typename T>
  struct HasVisit<T, std::void_t<decltype(std::declval<T&>().Visit(std::declval<Reader&>()))>>
      : std::true_type {};

  template <typename T, typename = void>
  struct HasValidate : std::false_type {};
  template <typename T>
  struct HasValidate<T, std::void_t<decltype(std::declval<const T&>().Validate())>>
      : std::true_type {};

  template <typename T>
  void ReadEnum(T& field) {
    std::string word;
    ReadScalar(word);
    std::string allowed;
    for (const auto& [name, value] : EnumNames(T{})) {
      if (name == word) {
        field = value;
        return;
      }
      allowed += (allowed.empty() ? "" : ", ") + name;
    }
    Fail("is '" + word + "' but must be one of: " + allowed);
  }

  template <typename T>
  void ReadStruct(T& field) {
    RequireMapping();
    field.Visit(*this);
    RejectUnknownKeys();
    if constexpr (HasValidate<T>::value) Judge([&field] { field.Validate(); });
  }

  void ReadScalar(bool& field);
  void ReadScalar(int& field);
  void ReadScalar(std::int64_t& field);
  void ReadScalar(std::uint64_t& field);
  void ReadScalar(double& field);
  void ReadScalar(std::string& field);

  std::unique_ptr<Reader> Child(const char* name);  ///< nullptr when the key is left out.
  std::vector<Reader> Elements();
  void RequireMapping();
  void RejectUnknownKeys();
  /// Calls `validate`; what it finds is thrown with full keys and their places.
  void Judge(const std::function<void()>& validate) const;
  [[noreturn]] void Fail(const std::string& fault) const;

  struct State;
  explicit Reader(std::unique_ptr<State> state);
  friend Reader OpenFile(const std::filesystem::path&, const std::vector<std::string>&,
                         Completeness);
  std::unique_ptr<State> state_;
};

/// Opens a YAML file and sets `overrides` over its values: "tracker.rate_hz=30", dots for nested
/// keys, YAML values; a text is taken as it is ("source.pattern=*.jpg"). Throws ConfigError when it
/// cannot be read, has duplicate keys, anchors or aliases, or is not a mapping.
Reader OpenFile(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                Completeness completeness);

/// Reads `path` into a T: defaults first, then the file, then `overrides`, then Validate() of every
/// struct. Unknown and duplicate keys are rejected. Throws ConfigError naming file, line and key,
/// or the override that is at fault.
template <typename T>
T Load(const std::filesystem::path& path, const std::vector<std::string>& overrides = {},
       Completeness completeness = Completeness::kDefaultsAllowed) {
  T value{};
  OpenFile(path, overrides, completeness).Read(value);
  return value;
}

/// Where a file states `key` ("places[2].label"), for what is wrong with its value only beside
/// others: "file:12: key 'places[2].label'"; the line of what holds it when it is left out. Throws
/// ConfigError as OpenFile does.
std::string PlaceOf(const std::filesystem::path& path, const std::string& key);

/// All files of a folder of configurations ("skeletons") that end in .yaml, from all places that
/// FindConfig searches, by name; of two of one name the first. Throws ConfigError listing the
/// places when there are none.
std::vector<std::filesystem::path> FindConfigs(const std::string& folder);

/// Where a shipped configuration file lies: `name` itself if it is a path that exists, else under
/// $DEIXIS_CONFIG_DIR, else beside the installed or built program (../share/deixis/config), else
/// the source tree. Throws ConfigError listing the places that were searched, or naming what lies
/// there and is no file.
std::filesystem::path FindConfig(const std::string& name);
/// The same; what is not found is told with the cure, "set calibration.file".
std::filesystem::path FindConfig(const std::string& name, const std::string& cure);

}  // namespace deixis::config
