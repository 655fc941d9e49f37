#include "services/pose_fitter/core/start/searched_places.h"

#include <gtest/gtest.h>

namespace deixis::pose_fitter {
namespace {

using Eigen::Vector3d;

const Vector3d kCupboard_m(1.0, 0.5, 3.0);

TEST(SearchedPlaces, LetsEachPlaceBeSearchedAtOnceAndAgainAfterThePeriod) {
  SearchedPlaces places(0.3);
  EXPECT_TRUE(places.IsDue(kCupboard_m, 1.0));
  places.NoteFound(kCupboard_m, 1.0);
  EXPECT_FALSE(places.IsDue(kCupboard_m + Vector3d(0.1, 0.0, 0.0), 1.1));
  EXPECT_TRUE(places.IsDue(kCupboard_m + Vector3d(0.4, 0.0, 0.0), 1.1)) << "elsewhere";
  EXPECT_TRUE(places.IsDue(kCupboard_m, 1.31));
}

TEST(SearchedPlaces, WaitsLongerAfterEachSearchInVainButNotForEver) {
  SearchedPlaces places(0.3);
  double time_s = 0.0, longest_s = 0.0;
  for (int i = 0; i < 6; ++i) {
    places.NoteInVain(kCupboard_m, time_s);
    double wait_s = 0.0;
    while (!places.IsDue(kCupboard_m, time_s + wait_s)) wait_s += 0.01;
    EXPECT_GE(wait_s, longest_s - 0.011);
    longest_s = std::max(longest_s, wait_s);
    time_s += wait_s;
  }
  EXPECT_NEAR(longest_s, 1.2, 0.02);
  places.NoteFound(kCupboard_m, time_s);
  EXPECT_TRUE(places.IsDue(kCupboard_m, time_s + 0.31));
}

TEST(SearchedPlaces, ForgetsWhatWasLongAgoAndTimesThatGoBack) {
  SearchedPlaces places(0.3);
  for (int i = 0; i < 4; ++i) places.NoteInVain(kCupboard_m, 2.0 * i);
  places.NoteInVain(Vector3d(-1.0, 0.0, 2.0), 20.0);
  places.NoteInVain(kCupboard_m, 20.0);
  EXPECT_TRUE(places.IsDue(kCupboard_m, 20.31)) << "the first in vain again";
  EXPECT_TRUE(places.IsDue(kCupboard_m, 5.0));
}

}  // namespace
}  // namespace deixis::pose_fitter
