#include "common/transport/publisher_sequences.h"

#include <gtest/gtest.h>

#include <random>

namespace deixis::transport {
namespace {

using std::chrono::milliseconds;

// Feeds sequence numbers, each message a hundredth of a second after the one before.
class PublisherSequencesTest : public testing::Test {
 protected:
  void Take(std::int64_t sequence, std::int64_t skipped = 0) {
    now_ += milliseconds{10};
    sequences_.Observe(sequence, {++time_}, skipped, now_);
  }
  void TakeRange(std::int64_t first, std::int64_t last) {
    for (std::int64_t i = first; i <= last; ++i) Take(i);
  }
  // One after the other, each counting on from where it was.
  void Interleave(std::int64_t a, std::int64_t b, int count) {
    for (int i = 0; i < count; ++i) {
      Take(a + i);
      Take(b + i);
    }
  }
  bool HasTwo() const { return sequences_.HasTwoPublishers(now_); }

  PublisherSequences sequences_;
  PublisherSequences::Clock::time_point now_{std::chrono::hours{1}};
  std::int64_t time_ = 0;
};

TEST_F(PublisherSequencesTest, CountsWhatIsMissing) {
  TakeRange(10, 20);
  Take(24);
  TakeRange(25, 30);
  EXPECT_EQ(sequences_.gaps(), 3);
  EXPECT_FALSE(HasTwo());
}

TEST_F(PublisherSequencesTest, WhatWasSkippedIsNotMissing) {
  Take(1);
  Take(9, 7);
  Take(20, 8);
  EXPECT_EQ(sequences_.gaps(), 2);
}

TEST_F(PublisherSequencesTest, TakesAPublisherThatStartsAnewForOne) {
  TakeRange(0, 500);
  for (int restart = 0; restart < 20; ++restart) TakeRange(0, 5 + restart);
  TakeRange(3, 60);  // Its first messages were lost.
  EXPECT_FALSE(HasTwo());
  EXPECT_EQ(sequences_.out_of_turn(), 0);
  EXPECT_EQ(sequences_.gaps(), 0);
}

TEST_F(PublisherSequencesTest, TakesALogThatIsPlayedInALoopForOnePublisher) {
  for (int round = 0; round < 10; ++round) TakeRange(700, 760);
  EXPECT_EQ(sequences_.out_of_turn(), 0);
  EXPECT_EQ(sequences_.gaps(), 0);
}

TEST_F(PublisherSequencesTest, TakesOvertakingDatagramsForOnePublisher) {
  for (std::int64_t i = 10; i < 400; i += 4) {
    for (const std::int64_t offset : {2, 0, 3, 1}) Take(i + offset);
  }
  EXPECT_FALSE(HasTwo());
}

TEST_F(PublisherSequencesTest, AnOvertakenMessageIsNotMissing) {
  for (const std::int64_t sequence : {10, 12, 11, 13, 14}) Take(sequence);
  EXPECT_EQ(sequences_.gaps(), 0);
}

TEST_F(PublisherSequencesTest, TakesHeavyLossForOnePublisher) {
  std::mt19937 random(1);
  std::int64_t received = 0;
  for (std::int64_t i = 0; i < 5000; ++i) {
    if (random() % 10 < 4) continue;
    ++received;
    Take(i);
  }
  EXPECT_EQ(sequences_.out_of_turn(), 0);
  EXPECT_NEAR(static_cast<double>(sequences_.gaps() + received), 5000.0, 10.0);
}

TEST_F(PublisherSequencesTest, TakesADoubledDatagramForOnePublisher) {
  for (std::int64_t i = 1; i < 100; ++i) {
    sequences_.Observe(i, {i}, 0, now_);
    sequences_.Observe(i, {i}, 0, now_);
  }
  EXPECT_FALSE(HasTwo());
  EXPECT_EQ(sequences_.gaps(), 0);
}

TEST_F(PublisherSequencesTest, TakesOneThatDoesNotCountForOnePublisher) {
  for (int i = 0; i < 50; ++i) Take(0);
  for (int i = 0; i < 50; ++i) Take(-1);
  EXPECT_FALSE(HasTwo());
}

TEST_F(PublisherSequencesTest, NoticesTwoWhoseCountsAreFarApart) {
  Interleave(1000, 50'000, 20);
  EXPECT_TRUE(HasTwo());
  EXPECT_EQ(sequences_.gaps(), 0);
}

TEST_F(PublisherSequencesTest, NoticesTwoThatBeganTogether) {
  Interleave(0, 0, 20);
  EXPECT_TRUE(HasTwo());
  EXPECT_EQ(sequences_.gaps(), 0);
}

TEST_F(PublisherSequencesTest, NoticesTwoWhoseCountsAreClose) {
  Interleave(100, 105, 30);
  EXPECT_TRUE(HasTwo());
  EXPECT_EQ(sequences_.gaps(), 0);
}

TEST_F(PublisherSequencesTest, NoticesASecondOneThatJoinsFromTheStart) {
  TakeRange(0, 3000);
  Interleave(3001, 0, 20);
  EXPECT_TRUE(HasTwo());
  EXPECT_EQ(sequences_.gaps(), 0);
}

TEST_F(PublisherSequencesTest, NoticesASecondOneThatSendsRarely) {
  for (int i = 0; i < 6; ++i) {
    TakeRange(1000 + 30 * i, 1029 + 30 * i);
    Take(20 + i);
  }
  EXPECT_TRUE(HasTwo());
  EXPECT_EQ(sequences_.gaps(), 0);
}

TEST_F(PublisherSequencesTest, NoticesTwoThroughASlowReader) {
  std::int64_t a = 100;
  std::int64_t b = 7000;
  for (int i = 0; i < 20; ++i) {  // Of three messages of each it takes one.
    Take(a += 3, 5);
    Take(b += 3, 5);
  }
  EXPECT_TRUE(HasTwo());
  EXPECT_EQ(sequences_.gaps(), 0);
}

TEST_F(PublisherSequencesTest, IsQuietAgainWhenTheSecondOneHasEnded) {
  Interleave(1000, 5000, 20);
  ASSERT_TRUE(HasTwo());
  TakeRange(5020, 5020 + 1200);  // Twelve seconds.
  EXPECT_FALSE(HasTwo());
  EXPECT_EQ(sequences_.gaps(), 0);
}

TEST_F(PublisherSequencesTest, AForgedNumberIsNeitherLossNorASecondPublisher) {
  TakeRange(10, 20);
  Take(std::int64_t{1} << 60);
  TakeRange(21, 3000);
  EXPECT_FALSE(HasTwo());
  EXPECT_EQ(sequences_.gaps(), 0);
}

}  // namespace
}  // namespace deixis::transport
