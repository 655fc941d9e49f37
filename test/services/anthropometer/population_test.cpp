#include "common/anthropometry/population.h"

#include <gmock/gmock.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "common/anthropometry/person_estimate.h"
#include "common/config/config.h"
#include "services/anthropometer/evaluation/population_score.h"
#include "test/support/temporary_folder.h"

namespace deixis::anthropometer {
namespace {

using anthropometry::BodyMeasures;
using anthropometry::EstimatePerson;
using anthropometry::MeasuredLength;
using anthropometry::PersonEstimate;
using anthropometry::Population;
using anthropometry::Populations;
using anthropometry::Sex;
using testing::HasSubstr;

const std::string kConfig = DEIXIS_SOURCE_DIR "/config/kinematics/";

const Populations& Shipped() {
  static const Populations populations = Populations::Load(kConfig + "population.yaml");
  return populations;
}

TEST(Population, HasTheMeansAndSpreadsOfTheTables) {
  const BodyMeasures measures = BodyMeasures::Load({kConfig + "measures.yaml"});
  for (const Sex sex : {Sex::kFemale, Sex::kMale}) {
    for (const char* name : {"kph", "oal", "ual", "hdl", "usl", "stl", "fl"}) {
      const int place = *Shipped().Find(name);
      const auto& population = Shipped().Of(sex);
      const auto& percentiles = *measures.Find(name)->Of(sex);
      EXPECT_NEAR(1000.0 * population.mean_m[place], percentiles.p50, 0.06) << name;
      EXPECT_NEAR(1000.0 * std::sqrt(population.covariance_m2(place, place)),
                  percentiles.Spread_mm(), 0.4)
          << name;
    }
  }
}

TEST(EstimatePerson, KnowsThePopulationWhenNothingIsMeasured) {
  const PersonEstimate estimate = EstimatePerson(Shipped(), {}, Sex::kMale);
  EXPECT_NEAR(estimate.Length_m("kph"), 1.802, 1e-9);
  const double offset_m = Shipped().offset_m()[*Shipped().Find("kph")];
  EXPECT_GT(offset_m, 0.03);
  EXPECT_NEAR(estimate.Spread_m("kph"), std::hypot(0.0653, offset_m), 0.0005);
  EXPECT_EQ(EstimatePerson(Shipped(), {}).female_probability, 0.5);
}

TEST(EstimatePerson, FollowsALengthAsFarAsItsVarianceAllows) {
  const double sure = EstimatePerson(Shipped(), {{"kph", 1.95, 1e-8}}, Sex::kMale).Length_m("kph");
  const double spread = EstimatePerson(Shipped(), {}, Sex::kMale).Spread_m("kph");
  const double doubtful =
      EstimatePerson(Shipped(), {{"kph", 1.95, spread * spread}}, Sex::kMale).Length_m("kph");
  EXPECT_NEAR(sure, 1.95, 1e-5);
  EXPECT_NEAR(doubtful, 0.5 * (1.95 + 1.802), 1e-3);
}

/// Women and men of two lengths; all may be larger than that by `offset_m`.
Populations TwoLengths(double offset_m) {
  const Eigen::Matrix2d spread = Eigen::Vector2d(9e-4, 9e-4).asDiagonal();
  return {{"kph", "oal"},
          {Eigen::Vector2d(1.68, 0.30), spread},
          {Eigen::Vector2d(1.78, 0.40), spread},
          Eigen::Vector2d(offset_m, 0.0)};
}

TEST(EstimatePerson, IsLessSureOfTheSexByLengthsThatDifferBetweenPopulations) {
  const auto probability = [](double offset_m, const char* measure, double length_m) {
    return EstimatePerson(TwoLengths(offset_m), {{measure, length_m, 1e-6}}).female_probability;
  };
  EXPECT_GT(probability(0.0, "kph", 1.66), 0.99);
  EXPECT_LT(probability(0.1, "kph", 1.66), 0.75);
  EXPECT_EQ(probability(0.1, "oal", 0.31), probability(0.0, "oal", 0.31));
}

TEST(EstimatePerson, LearnsOfItsPopulationFromOneLengthForAnother) {
  const Eigen::Matrix2d spread = Eigen::Vector2d(1e-4, 1e-4).asDiagonal();
  const Population same{Eigen::Vector2d(1.7, 0.3), spread};
  const Populations populations({"kph", "oal"}, same, same, Eigen::Vector2d(0.1, 0.05));
  const auto estimate = EstimatePerson(populations, {{"kph", 1.6, 1e-8}});
  EXPECT_NEAR(estimate.Length_m("oal"), 0.3 - 0.05 / 1.01, 1e-5);
  EXPECT_NEAR(SizesOf(populations, Sex::kMale, 1.6).at("oal"), 0.3, 1e-9);
}

TEST(EstimatePerson, InfersLongerLimbsOfTallerPeopleAndGrowsSurer) {
  const PersonEstimate before = EstimatePerson(Shipped(), {}, Sex::kFemale);
  const PersonEstimate after = EstimatePerson(Shipped(), {{"kph", 1.80, 1e-6}}, Sex::kFemale);
  for (const char* limb : {"oal", "ual", "usl", "trochanter_height"}) {
    EXPECT_GT(after.Length_m(limb), before.Length_m(limb) + 0.01) << limb;
    EXPECT_LT(after.Spread_m(limb), before.Spread_m(limb)) << limb;
  }
}

TEST(EstimatePerson, SaysTheLikelierSexNeverForSure) {
  const auto probability = [](double stature_m) {
    return EstimatePerson(Shipped(), {{"kph", stature_m, 1e-4}}).female_probability;
  };
  EXPECT_GT(probability(1.55), 0.9);
  EXPECT_LT(probability(1.95), 0.1);
  EXPECT_NEAR(probability(1.74), 0.5, 0.15);
  EXPECT_LT(probability(1.55), 1.0);
}

TEST(EstimatePerson, HasACovarianceThatCanBe) {
  const PersonEstimate estimate =
      EstimatePerson(Shipped(), {{"oal", 0.33, 1e-4}, {"usl", 0.40, 1e-4}, {"kph", 1.75, 1e-6}});
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(estimate.covariance_m2);
  EXPECT_GT(solver.eigenvalues().minCoeff(), -1e-9);
}

TEST(EstimatePerson, RefusesWhatIsNoLength) {
  for (const MeasuredLength& length : std::vector<MeasuredLength>{{"tail", 0.3, 1e-4},
                                                                  {"oal", -0.3, 1e-4},
                                                                  {"oal", 0.3, 0.0},
                                                                  {"oal", std::nan(""), 1e-4},
                                                                  {"oal", 0.3, std::nan("")}}) {
    EXPECT_THROW(EstimatePerson(Shipped(), {length}), std::invalid_argument);
  }
}

TEST(StatureAt, IsThatOfTheTablesPercentiles) {
  EXPECT_NEAR(StatureAt(Shipped(), Sex::kMale, 0.5), 1.802, 1e-4);
  EXPECT_NEAR(StatureAt(Shipped(), Sex::kFemale, 0.95), 1.770, 0.008);
  EXPECT_THROW(StatureAt(Shipped(), Sex::kMale, 1.0), std::invalid_argument);
}

TEST(Populations, AreReadAsTheyWereWritten) {
  const test::TemporaryFolder folder;
  const Populations again = Populations::Load(folder.Write("p.yaml", Shipped().ToYaml()));
  EXPECT_EQ(again.measures(), Shipped().measures());
  EXPECT_LE((again.Of(Sex::kMale).mean_m - Shipped().Of(Sex::kMale).mean_m).norm(), 1e-3);
  EXPECT_LE((again.offset_m() - Shipped().offset_m()).norm(), 1e-3);
}

TEST(Populations, NameFileAndKeyOfWhatIsWrong) {
  const test::TemporaryFolder folder;
  const std::string good =
      "measures: [kph, oal]\n"
      "female: {mean_mm: [1680, 310], spread_mm: [60, 16], correlation: [[1], [0.7, 1]]}\n"
      "male: {mean_mm: [1800, 340], spread_mm: [60, 16], correlation: [[1], [0.7, 1]]}\n";
  const auto loading = [&folder](const std::string& text) {
    return [&folder, text] { Populations::Load(folder.Write("p.yaml", text)); };
  };
  EXPECT_NO_THROW(loading(good)());
  for (const auto& [from, to, says] : std::vector<std::array<std::string, 3>>{
           {"[1680, 310]", "[1680]", "female"},
           {"female:", "offset_mm: [1]\nfemale:", "offset_mm"},
           {"[60, 16]", "[60, -16]", "female.spread_mm"},
           {"[0.7, 1]", "[1.7, 1]", "female.correlation[1]"},
           {"[[1], [0.7, 1]]", "[[1], [1]]", "female.correlation[1]"},
           {"[60, 16], correlation: [[1], [0.7", "[60, 16], correlation: [[-1], [0.7",
            "female.correlation"}}) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    EXPECT_THAT(loading(text), testing::ThrowsMessage<config::ConfigError>(
                                   testing::AllOf(HasSubstr("p.yaml"), HasSubstr(says))))
        << to;
  }
}

/// A survey of people whose stature and arms follow a plain rule.
std::string MadeUpSurvey(double mean_mm) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::string text = "subjectid,stature,acromionradialelength,Branch\n";
  for (int i = 0; i < 400; ++i) {
    const double stature = mean_mm + 60.0 * normal(random);
    const double arm = 0.19 * stature + 8.0 * normal(random);
    text += std::to_string(i) + "," + std::to_string(stature) + "," + std::to_string(arm) + ",x\n";
  }
  return text;
}

TEST(Evaluation, FindsTheSpreadThatTheSurveyHas) {
  const test::TemporaryFolder folder;
  const auto file = folder.Write(
      "m.yaml",
      "measures:\n"
      "  - {name: kph, english: a, german: a, latin: a, definition: a, is_surveyed_only: true,"
      " ansur: [{of: stature}]}\n"
      "  - {name: oal, english: b, german: b, latin: b, definition: b, is_surveyed_only: true,"
      " ansur: [{of: acromionradialelength}]}\n");
  const BodyMeasures measures = BodyMeasures::Load({file});
  const Surveys surveys{Survey::Read(folder.Write("f.csv", MadeUpSurvey(1650.0))),
                        Survey::Read(folder.Write("m.csv", MadeUpSurvey(1780.0)))};
  const Populations fit = FitPopulations(measures, surveys, Half::kOdd);
  const PopulationScore score = Score(fit, measures, surveys, Half::kEven, {"kph"}, 0.005);
  EXPECT_EQ(score.people, 400);
  EXPECT_NEAR(score.predictions[1].stated_spread_mm, 8.0, 1.0);
  EXPECT_NEAR(score.predictions[1].share_within_90, 0.9, 0.04);
  EXPECT_GT(score.sex.accuracy, 0.8);
  EXPECT_LT(score.sex.calibration_error, 0.06);
  EXPECT_LT(score.sex.brier, 0.15);
  EXPECT_NEAR(score.predictions[1].share_within_50, 0.5, 0.06);
  EXPECT_GT(score.predictions[1].p90_mm, score.predictions[1].median_mm);
}

TEST(Survey, NamesTheLineOrColumnThatIsWrong) {
  const test::TemporaryFolder folder;
  const auto reading = [&folder](const std::string& text) {
    return [&folder, text] { Survey::Read(folder.Write("s.csv", text)); };
  };
  EXPECT_THAT(reading("a,b\n1,2\n"),
              testing::ThrowsMessage<config::ConfigError>(HasSubstr("has no column subjectid")));
  EXPECT_THAT(reading("SubjectId,b\n1\n"),
              testing::ThrowsMessage<config::ConfigError>(HasSubstr("s.csv:2: has 1 columns")));
  EXPECT_THAT(reading("SubjectId,b\nx,2\n"),
              testing::ThrowsMessage<config::ConfigError>(HasSubstr("no subject's number")));
}

}  // namespace
}  // namespace deixis::anthropometer
