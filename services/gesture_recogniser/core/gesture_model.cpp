#include "services/gesture_recogniser/core/gesture_model.h"

#include <cstdio>
#include <sstream>

namespace deixis::gesture_recogniser {
namespace {

constexpr double kLongest_s = 10.0;  // As long as a motion can be kept.
// A stroke speeds up and slows down: with fewer points, straight lines between them lose its shape.
constexpr std::size_t kFewestPoints = 8;
constexpr std::size_t kMostPoints = 1000;

void Check(const ModelPoint& point, const std::string& key, config::Faults& faults) {
  faults.Require(point.speed_m_per_s >= 0.0, key + ".speed_m_per_s", "must not be negative");
  faults.Require(point.speed_spread_m_per_s > 0.0, key + ".speed_spread_m_per_s",
                 "must be positive");
  faults.Require(point.turn_spread_rad > 0.0, key + ".turn_spread_rad", "must be positive");
  faults.Require(point.shape_spread > 0.0, key + ".shape_spread", "must be positive");
  faults.Require(point.context_radius_m >= 0.0, key + ".context_radius_m", "must not be negative");
  faults.Require(point.context_end_rad >= point.context_start_rad, key + ".context_end_rad",
                 "must not lie before context_start_rad");
}

std::string Number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// Writes fields as `key: value` pairs with a separator.
class FieldWriter {
 public:
  explicit FieldWriter(std::string separator) : separator_(std::move(separator)) {}
  void operator()(const char* name, double value) {
    if (!text_.empty()) text_ += separator_;
    text_ += std::string(name) + ": " + Number(value);
  }
  const std::string& text() const { return text_; }

 private:
  std::string separator_;
  std::string text_;
};

template <typename T>
std::string Fields(T value, const std::string& separator) {
  FieldWriter writer(separator);
  value.Visit(writer);
  return writer.text();
}

std::string NameOf(ContextNeed need) {
  for (const auto& [name, value] : EnumNames(need)) {
    if (value == need) return name;
  }
  return "none";
}

}  // namespace

void GestureModel::Validate() const {
  config::Faults faults;
  faults.Require(!name.empty(), "name", "must not be empty");
  faults.Require(duration_s > 0.0 && duration_s <= kLongest_s, "duration_s", "must lie in (0, 10]");
  faults.Require(points.size() >= kFewestPoints && points.size() <= kMostPoints, "points",
                 "must be 8 to 1000: a file that was cut off describes no motion");
  faults.Require(stroke.duration_spread_s > 0.0 && stroke.duration_spread_s <= kLongest_s,
                 "stroke.duration_spread_s", "must lie in (0, 10]");
  faults.Require(stroke.peak_speed_m_per_s > 0.0, "stroke.peak_speed_m_per_s", "must be positive");
  faults.Require(stroke.peak_speed_log_spread > 0.0, "stroke.peak_speed_log_spread",
                 "must be positive");
  faults.Require(target.gap_spread_m > 0.0, "target.gap_spread_m", "must be positive");
  faults.Require(target.direction_spread_rad > 0.0, "target.direction_spread_rad",
                 "must be positive");
  faults.Require(target.posture_spread_rad > 0.0, "target.posture_spread_rad", "must be positive");
  for (std::size_t i = 0; i < points.size(); ++i) {
    Check(points[i], "points[" + std::to_string(i) + "]", faults);
  }
  faults.ThrowIfAny();
}

std::vector<GestureModel> LoadModels(const std::vector<std::string>& names) {
  std::vector<GestureModel> models;
  for (const std::string& name : names) {
    const auto file = config::FindConfig("gestures/" + name + ".yaml");
    models.push_back(config::Load<GestureModel>(file));
    if (models.back().name == file.stem()) continue;
    throw config::ConfigError(file.string() + ": 'name' is '" + models.back().name +
                              "'; it must be that of the file");
  }
  return models;
}

std::string ToYaml(const GestureModel& model) {
  std::ostringstream text;
  text << "# Motion model, written by scripts/deixis train-gestures. Metres in the image plane at "
          "the\n"
          "# person's distance, seconds, radians; one line per phase from beginning to end.\n"
       << "name: " << model.name << "\ncontext: " << NameOf(model.context)
       << "   # none, optional or required: does it need an object\nduration_s: "
       << Number(model.duration_s) << "\nexamples: " << model.examples << "\nstroke:\n  "
       << Fields(model.stroke, "\n  ") << "\ntarget:\n  " << Fields(model.target, "\n  ")
       << "\npoints:\n";
  for (const ModelPoint& point : model.points) {
    text << "  - {" << Fields(point, ", ") << "}\n";
  }
  return text.str();
}

}  // namespace deixis::gesture_recogniser
