#include "common/anthropometry/body_measures.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/config/config.h"
#include "test/support/temporary_folder.h"

namespace deixis::anthropometry {
namespace {

using testing::HasSubstr;

const std::string kFile = DEIXIS_SOURCE_DIR "/config/kinematics/measures.yaml";
constexpr double kRounding_mm = 0.51;
constexpr double kRounding_percent = 0.0051;
const std::vector<Sex> kSexes{Sex::kFemale, Sex::kMale};

const BodyMeasures& Shipped() {
  static const BodyMeasures measures = BodyMeasures::Load({kFile});
  return measures;
}

/// A column of a measure, as it stands in the file or as the source prints it.
enum class Text { kCorrected, kPrinted };

double Value(const BodyMeasure& measure, Sex sex, const std::string& column, Text text) {
  for (const PrintedValue& printed : measure.printed) {
    if (text == Text::kPrinted && printed.sex == sex && printed.column == column) {
      return printed.value;
    }
  }
  return measure.Of(sex)->Column(column);
}

/// The four ratios to the body height that the source's percentages are made of, percent.
std::vector<double> Ratios(const BodyMeasure& measure, Sex sex, Text text) {
  std::vector<double> ratios;
  for (const char* column : {"p1", "p5", "p50", "p95"}) {
    ratios.push_back(100.0 * Value(measure, sex, column, text) /
                     Value(*Shipped().Find("kph"), sex, column, text));
  }
  return ratios;
}

/// "female usl" where percentage or half range do not follow from the row.
std::set<std::string> WrongPercentages(Text text) {
  std::set<std::string> wrong;
  for (const BodyMeasure& measure : Shipped().all()) {
    for (const Sex sex : kSexes) {
      if (!measure.Of(sex)) continue;
      const std::vector<double> ratios = Ratios(measure, sex, text);
      const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
      const double mean = (ratios[0] + ratios[1] + ratios[2] + ratios[3]) / 4.0;
      if (std::abs(mean - Value(measure, sex, "percent", text)) > kRounding_percent ||
          std::abs(0.5 * (*most - *least) - Value(measure, sex, "half_range", text)) >
              kRounding_percent) {
        wrong.insert((sex == Sex::kFemale ? "female " : "male ") + measure.name);
      }
    }
  }
  return wrong;
}

/// Where the median is not the sum that the definition says.
std::set<std::string> WrongSums(Text text) {
  std::set<std::string> wrong;
  for (const BodyMeasure& measure : Shipped().all()) {
    for (const Sex sex : kSexes) {
      if (measure.derived.empty() || !measure.Of(sex)) continue;
      double sum_mm = 0.0;
      for (const Summand& summand : measure.derived) {
        sum_mm += summand.sign * Shipped().Median_mm(summand.of, sex);
      }
      if (std::abs(sum_mm - Value(measure, sex, "p50", text)) > kRounding_mm) {
        wrong.insert((sex == Sex::kFemale ? "female " : "male ") + measure.name);
      }
    }
  }
  return wrong;
}

TEST(BodyMeasures, AreAllOfTheSource) {
  EXPECT_EQ(Shipped().all().size(), 34u);
  const auto rows =
      std::count_if(Shipped().all().begin(), Shipped().all().end(),
                    [](const BodyMeasure& measure) { return measure.female && measure.male; });
  EXPECT_EQ(rows, 33);
  const auto sitting = std::count_if(
      Shipped().all().begin(), Shipped().all().end(),
      [](const BodyMeasure& measure) { return measure.posture == MeasuringPosture::kSitting; });
  EXPECT_EQ(sitting, 7);
  EXPECT_EQ(Shipped().Find("kph")->female->p99, 1804.0);
  EXPECT_EQ(Shipped().Find("usfl")->male->p1, 412.0);
}

TEST(BodyMeasures, ContradictNothingOnceCorrected) {
  EXPECT_THAT(WrongSums(Text::kCorrected), testing::IsEmpty());
  EXPECT_THAT(WrongPercentages(Text::kCorrected), testing::IsEmpty());
}

// With the README of config/kinematics, the full list: another one is a slip of ours.
TEST(BodyMeasures, AreContradictedByTheSourceInTheseSums) {
  EXPECT_THAT(WrongSums(Text::kPrinted),
              testing::UnorderedElementsAre("female koh", "male koh", "male ala", "female oslp",
                                            "male oslp", "female usl", "male usl"));
  EXPECT_THAT(WrongPercentages(Text::kPrinted), testing::IsEmpty());
}

TEST(BodyMeasures, SayWhyWhereTheyCorrect) {
  for (const BodyMeasure& measure : Shipped().all()) {
    for (const PrintedValue& printed : measure.printed) {
      EXPECT_NE(printed.value, measure.Of(printed.sex)->Column(printed.column)) << measure.name;
      EXPECT_FALSE(printed.why.empty());
    }
  }
}

TEST(BodyMeasures, DeriveWhatHasNoRow) {
  EXPECT_EQ(Shipped().Median_mm("blp", Sex::kFemale), 789.0);
  EXPECT_EQ(Shipped().Median_mm("blp", Sex::kMale), 859.0);
}

TEST(BodyMeasures, SpreadAsTheirPercentilesSay) {
  EXPECT_NEAR(Shipped().Find("kob")->male->Spread_mm(), (164.0 - 146.0) / 3.29, 1e-12);
  EXPECT_NEAR(Shipped().Find("kph")->male->Spread_mm(), 65.3, 0.1);
}

TEST(BodyMeasures, AreExtendedBySurveys) {
  const BodyMeasures measures =
      BodyMeasures::Load({kFile, DEIXIS_SOURCE_DIR "/config/kinematics/measures_ansur2.yaml"});
  EXPECT_EQ(measures.all().size(), 34u + 25u);
  EXPECT_EQ(measures.Find("Wadenumfang")->ansur.at(0).of, "calfcircumference");
  EXPECT_THROW(measures.Median_mm("calf_girth", Sex::kMale), std::logic_error);
  EXPECT_THROW(BodyMeasures::Load({kFile, kFile}), config::ConfigError);
}

TEST(BodyMeasures, AreFoundInThreeLanguages) {
  for (const std::string name : {"oal", "upper arm length", "Upper_Arm_Length", "Oberarmlänge",
                                 "oberarmlaenge", "longitudo brachii"}) {
    ASSERT_NE(Shipped().Find(name), nullptr) << name;
    EXPECT_EQ(Shipped().Find(name)->name, "oal");
  }
  EXPECT_EQ(Shipped().Find("tail length"), nullptr);
}

TEST(BodyMeasures, NameFileAndKeyOfWhatIsWrong) {
  const test::TemporaryFolder folder;
  const std::string good =
      "measures:\n  - {name: a, english: a, definition: a, "
      "female: {p1: 1, p5: 2, p50: 3, p95: 4, p99: 5}, male: {p1: 1, p5: 2, p50: 3, p95: 4, p99: "
      "5}}\n";
  const auto loading = [&folder](const std::string& text) {
    return [&folder, text] { BodyMeasures::Load({folder.Write("measures.yaml", text)}); };
  };
  EXPECT_NO_THROW(loading(good)());
  const auto replaced = [&good](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  for (const auto& [from, to, says] : std::vector<std::array<std::string, 3>>{
           {"p5: 2", "p5: 9", "measures[0].female.p50"},
           {"p1: 1", "p1: -1", "measures[0].female.p50"},
           {"name: a", "name: ''", "measures[0].name"},
           {"name: a", "name: a, derived: [{of: b}]", "measures[0].derived"},
           {"name: a", "name: a, derived: [{of: a, sign: 2}]", "measures[0].derived[0].sign"},
           {"name: a", "nome: a", "'measures[0].nome' is not known"}}) {
    EXPECT_THAT(loading(replaced(from, to)),
                testing::ThrowsMessage<config::ConfigError>(
                    testing::AllOf(HasSubstr("measures.yaml"), HasSubstr(says))))
        << to;
  }
  EXPECT_THAT(loading(good + good.substr(good.find("  -"))),
              testing::ThrowsMessage<config::ConfigError>(HasSubstr("'a' is there already")));
}

}  // namespace
}  // namespace deixis::anthropometry
