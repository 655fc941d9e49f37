#include "services/pose_fitter/trainer/share_choice.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace deixis::pose_fitter {
namespace {

/// People whose arm is 0.3 of `arm` and whose statures say little of it.
std::vector<LengthSample> FourPeople() {
  std::vector<LengthSample> people;
  const double arms_m[] = {0.7, 0.8, 0.72, 0.81}, statures_m[] = {1.8, 1.7, 1.75, 1.6};
  for (int i = 0; i < 4; ++i) {
    const body_model::Sizes sizes = {{"kph", statures_m[i]}, {"ala", arms_m[i]}};
    people.push_back({0.3 * arms_m[i], sizes, sizes});
  }
  return people;
}

TEST(ShareChoice, TakesTheMeasureThatForetellsPeopleWhoWereLeftOut) {
  const LengthShare chosen = ChooseShare(FourPeople(), {"kph", "ala"});
  EXPECT_EQ(chosen.term.of, "ala");
  EXPECT_NEAR(chosen.term.share, 0.3, 1e-9);
  EXPECT_NEAR(chosen.term.spread, 0.0, 1e-9);
  EXPECT_NEAR(chosen.error_by_stature_m, 0.0, 1e-9);
}

TEST(ShareChoice, StaysWithTheFirstMeasureWhenOthersAreHardlyBetter) {
  auto people = FourPeople();
  for (LengthSample& person : people) {
    person.by_stature["ala"] = 0.5 * person.by_stature["kph"];
    person.by_stature_and_sex["ala"] = 0.5 * person.by_stature_and_sex["kph"];
  }
  EXPECT_EQ(ChooseShare(people, {"kph", "ala"}).term.of, "kph");
}

TEST(ShareChoice, TellsTheErrorOfWhoWasLeftOutAndNotOfWhoWasLearned) {
  // Of two people each is foretold by the other's share alone.
  const body_model::Sizes size = {{"kph", 1.0}};
  const LengthShare fitted = FitShare({{0.2, size, size}, {0.3, size, size}}, "kph");
  EXPECT_NEAR(fitted.error_by_stature_m, 0.1, 1e-9);
  EXPECT_NEAR(fitted.term.share, 0.25, 1e-9);
  EXPECT_NEAR(fitted.term.spread, std::sqrt(2.0) * 0.05, 1e-9);
}

TEST(ShareChoice, TellsErrorsWithAndWithoutTheSex) {
  auto people = FourPeople();
  for (LengthSample& person : people) person.by_stature["ala"] = 0.75;
  const LengthShare fitted = FitShare(people, "ala");
  EXPECT_GT(fitted.error_by_stature_m, 2.0 * fitted.error_by_stature_and_sex_m);
}

TEST(ShareChoice, NeedsTwoPeople) {
  EXPECT_THROW(FitShare({FourPeople().front()}, "kph"), std::invalid_argument);
}

}  // namespace
}  // namespace deixis::pose_fitter
