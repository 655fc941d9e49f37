#include "common/capture/looped_source.h"

#include <gmock/gmock.h>

#include "test/common/capture/scripted_source.h"

namespace deixis::capture {
namespace {

using testing::ElementsAre;

std::unique_ptr<Source> TwoPictures() {
  SourceStatus status;
  status.corrupt = 1;
  return std::make_unique<ScriptedSource>(std::vector<Picture>{PictureAt(0), PictureAt(100'000)},
                                          status);
}

TEST(LoopedSource, LetsTimeGoOnAcrossRoundsWithoutAJump) {
  LoopedSource source(TwoPictures);
  std::vector<std::int64_t> times;
  for (int i = 0; i < 5; ++i) times.push_back(source.Next().picture->time.microseconds);
  EXPECT_THAT(times, ElementsAre(0, 100'000, 200'000, 300'000, 400'000));
}

TEST(LoopedSource, AddsUpCorruptPicturesOfAllRounds) {
  LoopedSource source(TwoPictures);
  for (int i = 0; i < 3; ++i) source.Next();
  EXPECT_EQ(source.status().corrupt, 2);
}

TEST(LoopedSource, FinishesBeforeTimesOverflow) {
  LoopedSource source([] {
    return std::make_unique<ScriptedSource>(
        std::vector<Picture>{PictureAt(kLatestTime.microseconds / 2)});
  });
  int rounds = 0;
  while (source.Next().state == SourceState::kPicture) ++rounds;
  EXPECT_EQ(rounds, 2);
}

TEST(LoopedSource, FinishesWhenARoundGivesNoPicture) {
  LoopedSource source([] { return std::make_unique<ScriptedSource>(std::vector<Picture>{}); });
  EXPECT_EQ(source.Next().state, SourceState::kFinished);
}

}  // namespace
}  // namespace deixis::capture
