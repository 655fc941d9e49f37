#include "services/hand_tracker/core/people.h"

#include <gtest/gtest.h>

namespace deixis::hand_tracker {
namespace {

scene::Objects Faces(double time_s, const std::vector<scene::Box>& boxes) {
  scene::Objects objects;
  objects.time = {static_cast<std::int64_t>(1e6 * time_s)};
  for (const scene::Box& box : boxes) {
    scene::Object face;
    face.kind = scene::ObjectKind::kFace;
    face.box = box;
    objects.objects.push_back(face);
  }
  return objects;
}

constexpr scene::Box kFace{300, 100, 60, 60};

People PeopleWith(const scene::Box& box, bool moves) {
  People people(10.0);
  for (int i = 0; i < 10; ++i) {
    people.Update(Faces(0.1 * i, {box}));
    people.NoteMotion([moves](const scene::Box&) { return moves; }, 0.1);
  }
  return people;
}

TEST(People, BelievesAFaceThatStaysAndMoves) {
  const auto established = PeopleWith(kFace, true).established();
  ASSERT_EQ(established.size(), 1U);
  EXPECT_EQ(established[0].times_seen, 10);
}

TEST(People, DoesNotTakeAPictureOnTheWallForSomebody) {
  EXPECT_TRUE(PeopleWith(kFace, false).established().empty());
}

TEST(People, DoesNotBelieveAFaceThatFlashesUpOnce) {
  People people(10.0);
  people.Update(Faces(0.0, {kFace}));
  people.NoteMotion([](const scene::Box&) { return true; }, 0.1);
  EXPECT_TRUE(people.established().empty());
}

TEST(People, ForgetsWhoeverIsGone) {
  People people = PeopleWith(kFace, true);
  people.Forget({4'000'000});
  EXPECT_EQ(people.established().size(), 1U);
  people.Forget({20'000'000});
  EXPECT_TRUE(people.established().empty());
}

TEST(People, KeepsTwoFacesApart) {
  People people(10.0);
  for (int i = 0; i < 5; ++i) {
    people.Update(Faces(0.1 * i, {kFace, {100, 90, 60, 60}}));
    people.NoteMotion([](const scene::Box&) { return true; }, 0.1);
  }
  EXPECT_EQ(people.established().size(), 2U);
}

TEST(People, IgnoresObjectsAndEmptyBoxes) {
  People people(10.0);
  scene::Objects objects = Faces(0.0, {{10, 10, 0, 0}});
  objects.objects.push_back({});
  for (int i = 0; i < 5; ++i) people.Update(objects);
  people.NoteMotion([](const scene::Box&) { return true; }, 0.1);
  EXPECT_TRUE(people.established().empty());
}

TEST(Person, ShouldersLieBelowTheFaceOnTheirSides) {
  Person person;
  person.face = kFace;
  const auto shoulders = Shoulders(person);
  EXPECT_LT(shoulders[0].x(), 300.0);
  EXPECT_GT(shoulders[1].x(), 360.0);
  EXPECT_GT(shoulders[0].y(), 160.0);
}

}  // namespace
}  // namespace deixis::hand_tracker
