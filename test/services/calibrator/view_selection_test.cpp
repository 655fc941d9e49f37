#include "services/calibrator/core/view_selection.h"

#include <gmock/gmock.h>

#include <numeric>

namespace deixis::calibrator::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A board of 4 x 3 corners whose first one is at `place`.
View ViewAt(cv::Point2f place, float spacing_px = 30.0F) {
  View view;
  view.size = {640, 480};
  for (int i = 0; i < 12; ++i) {
    view.corners.ids.push_back(i);
    view.corners.points_px.push_back(
        place + spacing_px * cv::Point2f(static_cast<float>(i % 4), static_cast<float>(i / 4)));
  }
  view.edge_width_px = 2.0;
  view.extent = 0.25;
  return view;
}

Fate Offer(ViewSelection& selection, const View& view) {
  return selection.Offer("picture", {}, {view}).fate;
}

TEST(ViewSelection, TakesWhatIsNew) {
  ViewSelection selection({}, 1);
  EXPECT_EQ(Offer(selection, ViewAt({100, 100})), Fate::kAccepted);
  EXPECT_EQ(Offer(selection, ViewAt({300, 200})), Fate::kAccepted);
  EXPECT_EQ(selection.shots().size(), 2u);
}

TEST(ViewSelection, RefusesAViewLikeAnEarlierOne) {
  ViewSelection selection({}, 1);
  Offer(selection, ViewAt({100, 100}));
  Offer(selection, ViewAt({300, 200}));
  EXPECT_EQ(Offer(selection, ViewAt({105, 103})), Fate::kTooSimilar);
  EXPECT_EQ(selection.shots().size(), 2u);
  EXPECT_EQ(selection.fates().at(Fate::kTooSimilar), 1);
}

TEST(ViewSelection, RefusesBlur) {
  ViewSelection selection({}, 1);
  View view = ViewAt({100, 100});
  view.edge_width_px = 6.0;
  const Judgement judgement = selection.Offer("picture", {}, {view});
  EXPECT_EQ(judgement.fate, Fate::kBlurred);
  EXPECT_THAT(judgement.remark, HasSubstr("6.0"));
}

TEST(ViewSelection, InAStreamTheBoardMustStandStill) {
  SelectionConfig config;
  config.most_motion_px = 1.5;
  ViewSelection selection(config, 1);
  EXPECT_EQ(Offer(selection, ViewAt({100, 100})), Fate::kMoving);
  EXPECT_EQ(Offer(selection, ViewAt({110, 100})), Fate::kMoving);
  EXPECT_EQ(Offer(selection, ViewAt({110.5, 100})), Fate::kAccepted);
}

TEST(ViewSelection, BothCamerasMustSeeTheBoard) {
  ViewSelection selection({}, 2);
  const Judgement judgement = selection.Offer("pair", {}, {ViewAt({100, 100}), std::nullopt});
  EXPECT_EQ(judgement.fate, Fate::kNoBoard);
  EXPECT_THAT(judgement.remark, HasSubstr("right"));
}

TEST(ViewSelection, RefusesAnotherSize) {
  ViewSelection selection({}, 1);
  Offer(selection, ViewAt({100, 100}));
  View other = ViewAt({300, 200});
  other.size = {800, 600};
  EXPECT_EQ(Offer(selection, other), Fate::kOtherSize);
}

TEST(BoardCoverage, SaysWhatIsMissing) {
  Coverage coverage;
  EXPECT_THAT(coverage.Advice(), Contains("show the board"));
  View view = ViewAt({20, 20});
  view.tilt_right_deg = 25.0;
  coverage.Add(view);
  const auto advice = coverage.Advice();
  EXPECT_THAT(advice, Contains(HasSubstr("the lower left")));
  EXPECT_THAT(advice, Not(Contains(HasSubstr("the upper left"))));
  EXPECT_THAT(advice, Contains(HasSubstr("its left side away")));
  EXPECT_THAT(advice, Not(Contains(HasSubstr("its right side away"))));
}

TEST(BoardCoverage, HasNothingToAskWhenAllWasShown) {
  Coverage coverage;
  for (const double tilt_deg : {-20.0, 20.0}) {
    for (const float spacing_px : {40.0F, 160.0F}) {
      for (const cv::Point2f place :
           {cv::Point2f(10, 10), cv::Point2f(310, 10), cv::Point2f(150, 10), cv::Point2f(10, 300),
            cv::Point2f(310, 300)}) {
        View view = ViewAt(place, spacing_px);
        view.extent = spacing_px / 200.0;
        view.tilt_right_deg = tilt_deg;
        view.tilt_down_deg = tilt_deg;
        for (cv::Point2f& point : view.corners.points_px) {
          point.x = std::min(point.x, 639.0F);
          point.y = std::min(point.y, 479.0F);
        }
        coverage.Add(view);
      }
    }
  }
  EXPECT_THAT(coverage.Advice(), IsEmpty());
}

}  // namespace
}  // namespace deixis::calibrator::test
