#include "common/anthropometry/body_measures.h"

#include <gmock/gmock.h>

#include <array>

#include "common/anthropometry/population.h"
#include "common/config/config.h"
#include "test/support/temporary_folder.h"

namespace deixis::anthropometry {
namespace {

using testing::HasSubstr;

const std::string kFile = DEIXIS_SOURCE_DIR "/config/kinematics/measures.yaml";

const BodyMeasures& Shipped() {
  static const BodyMeasures measures = BodyMeasures::Load({kFile});
  return measures;
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
      "measures:\n  - {name: a, english: a, german: a, latin: a, definition: a, "
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
           {"german: a", "german: ''", "measures[0].german"},
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
  EXPECT_THAT(loading(""),
              testing::ThrowsMessage<config::ConfigError>(HasSubstr("'measures' must have")));
}

TEST(Populations, AreRefusedWithoutMeasuresAndWithOneTwice) {
  const test::TemporaryFolder folder;
  const auto loading = [&folder](const std::string& text) {
    return [&folder, text] { Populations::Load(folder.Write("population.yaml", text)); };
  };
  const auto complains = [](const char* fault) {
    return testing::ThrowsMessage<config::ConfigError>(
        testing::AllOf(HasSubstr("population.yaml"), HasSubstr(fault)));
  };
  EXPECT_THAT(loading(""), complains("'measures' must name a measure"));
  const std::string people = "{mean_mm: [9, 9], spread_mm: [1, 1], correlation: [[1], [0, 1]]}\n";
  EXPECT_NO_THROW(loading("measures: [a, b]\nfemale: " + people + "male: " + people)());
  EXPECT_THAT(loading("measures: [a, a]\nfemale: " + people + "male: " + people),
              complains("each measure once"));
}

}  // namespace
}  // namespace deixis::anthropometry
