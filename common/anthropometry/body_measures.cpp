#include "common/anthropometry/body_measures.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "common/config/config.h"

namespace deixis::anthropometry {
namespace {

const std::array<std::pair<const char*, double Percentiles::*>, 7> kColumns{{
    {"p1", &Percentiles::p1},
    {"p5", &Percentiles::p5},
    {"p50", &Percentiles::p50},
    {"p95", &Percentiles::p95},
    {"p99", &Percentiles::p99},
    {"percent", &Percentiles::percent},
    {"half_range", &Percentiles::half_range},
}};

bool IsColumn(const std::string& name) {
  return std::any_of(kColumns.begin(), kColumns.end(),
                     [&name](const auto& column) { return name == column.first; });
}

struct PercentilesEntry : Percentiles {
  template <typename Visitor>
  void Visit(Visitor& v) {
    for (const auto& [name, member] : kColumns) v(name, this->*member);
  }
  void Validate() const {
    const bool is_stated = p50 != 0.0;
    const bool grows = p1 > 0.0 && p1 < p5 && p5 < p50 && p50 < p95 && p95 < p99 && p99 < 3000.0;
    config::Faults faults;
    faults.Require(!is_stated || grows, "p50", "and the other percentiles must grow, 0 to 3000 mm");
    faults.Require(percent >= 0.0 && percent <= 200.0, "percent", "must lie in 0..200");
    faults.ThrowIfAny();
  }
};

struct SummandEntry : Summand {
  template <typename Visitor>
  void Visit(Visitor& v) {
    v("of", of);
    v("sign", sign);
  }
  void Validate() const {
    config::Faults faults;
    faults.Require(sign == 1 || sign == -1, "sign", "must be 1 or -1");
    faults.ThrowIfAny();
  }
};

struct ColumnEntry : SurveyColumn {
  template <typename Visitor>
  void Visit(Visitor& v) {
    v("of", of);
    v("times", times);
  }
  void Validate() const {
    config::Faults faults;
    faults.Require(!of.empty(), "of", "must name a column");
    faults.Require(times != 0.0 && times >= -10.0 && times <= 10.0, "times",
                   "must lie in -10..10 and not be 0");
    faults.ThrowIfAny();
  }
};

struct PrintedEntry : PrintedValue {
  template <typename Visitor>
  void Visit(Visitor& v) {
    v("sex", sex);
    v("column", column);
    v("value", value);
    v("why", why);
  }
  void Validate() const {
    config::Faults faults;
    faults.Require(IsColumn(column), "column",
                   "must be p1, p5, p50, p95, p99, percent or half_range");
    faults.Require(!why.empty(), "why", "must not be empty");
    faults.ThrowIfAny();
  }
};

struct MeasureEntry : anatomy::NamedTerm {
  std::string definition;
  MeasuringPosture posture = MeasuringPosture::kStanding;
  std::vector<SummandEntry> derived;
  std::vector<ColumnEntry> ansur;
  PercentilesEntry female, male;
  bool is_derived_only = false;
  bool is_surveyed_only = false;
  std::vector<PrintedEntry> printed;

  template <typename Visitor>
  void Visit(Visitor& v) {
    NamedTerm::Visit(v);
    v("posture", posture);
    v("definition", definition);
    v("derived", derived);
    v("ansur", ansur);
    v("female", female);
    v("male", male);
    v("is_derived_only", is_derived_only);
    v("is_surveyed_only", is_surveyed_only);
    v("printed", printed);
  }
  void Validate() const {
    config::Faults faults;
    NamedTerm::Require(faults);
    faults.Require(!definition.empty(), "definition", "must not be empty");
    faults.Require(!is_derived_only || !derived.empty(), "derived", "must be stated");
    faults.Require(!is_surveyed_only || !ansur.empty(), "ansur", "must be stated");
    const bool has_percentiles = female.p50 > 0.0 && male.p50 > 0.0;
    faults.Require(has_percentiles != (is_derived_only || is_surveyed_only), "female",
                   "and male must be stated, unless a measure is only derived or surveyed");
    faults.ThrowIfAny();
  }
  BodyMeasure ToMeasure() const {
    BodyMeasure measure{name, names, definition, posture, {}, {}, {}, {}, {}};
    measure.derived.assign(derived.begin(), derived.end());
    measure.ansur.assign(ansur.begin(), ansur.end());
    measure.printed.assign(printed.begin(), printed.end());
    if (!is_derived_only && !is_surveyed_only) {
      measure.female = female;
      measure.male = male;
    }
    return measure;
  }
};

struct MeasuresFile {
  std::vector<MeasureEntry> measures;

  template <typename Visitor>
  void Visit(Visitor& v) {
    v("measures", measures);
  }
  void Validate() const {
    config::Faults faults;
    faults.Require(!measures.empty(), "measures", "must have a measure");
    std::set<std::string> names;
    for (std::size_t i = 0; i < measures.size(); ++i) {
      const std::string key = "measures[" + std::to_string(i) + "]";
      for (const SummandEntry& summand : measures[i].derived) {
        const bool is_known =
            std::any_of(measures.begin(), measures.end(),
                        [&summand](const MeasureEntry& other) { return other.name == summand.of; });
        faults.Require(is_known && summand.of != measures[i].name, key + ".derived",
                       "is of '" + summand.of + "', which is no other measure");
      }
      faults.Require(names.insert(measures[i].name).second, key + ".name",
                     "'" + measures[i].name + "' is there already");
    }
    faults.ThrowIfAny();
  }
};

}  // namespace

double Percentiles::Column(const std::string& name) const {
  for (const auto& [column, member] : kColumns) {
    if (name == column) return this->*member;
  }
  throw std::logic_error("Percentiles: no column " + name);
}

BodyMeasures BodyMeasures::Load(const std::vector<std::filesystem::path>& paths) {
  BodyMeasures measures;
  for (const std::filesystem::path& path : paths) {
    for (const MeasureEntry& entry : config::Load<MeasuresFile>(path).measures) {
      if (measures.Find(entry.name) != nullptr) {
        throw config::ConfigError(path.string() + ": '" + entry.name + "' is there already");
      }
      measures.all_.push_back(entry.ToMeasure());
    }
  }
  return measures;
}

const BodyMeasure* BodyMeasures::Find(const std::string& name) const {
  const auto found = std::find_if(all_.begin(), all_.end(), [&name](const BodyMeasure& measure) {
    return measure.name == name || measure.names.Match(name);
  });
  return found == all_.end() ? nullptr : &*found;
}

double BodyMeasures::Median_mm(const std::string& name, Sex sex) const {
  const BodyMeasure* measure = Find(name);
  if (measure == nullptr) throw std::logic_error("BodyMeasures: no measure " + name);
  if (measure->Of(sex)) return measure->Of(sex)->p50;
  if (measure->derived.empty()) {
    throw std::logic_error("BodyMeasures: " + name + " has no percentiles");
  }
  double sum_mm = 0.0;
  for (const Summand& summand : measure->derived)
    sum_mm += summand.sign * Median_mm(summand.of, sex);
  return sum_mm;
}

}  // namespace deixis::anthropometry
