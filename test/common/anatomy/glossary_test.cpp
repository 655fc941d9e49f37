#include "common/anatomy/glossary.h"

#include <gmock/gmock.h>

#include <set>

#include "common/config/config.h"
#include "test/support/temporary_folder.h"

namespace deixis::anatomy {
namespace {

const Glossary& Shipped() {
  static const Glossary glossary =
      Glossary::Load(DEIXIS_SOURCE_DIR "/config/kinematics/glossary.yaml");
  return glossary;
}

TEST(Glossary, HasEveryTermOnce) {
  EXPECT_EQ(Shipped().terms().size(), 116u);
  std::set<std::string> latin;
  for (const Term& term : Shipped().terms()) {
    EXPECT_TRUE(latin.insert(term.names.latin).second) << term.names.latin;
  }
}

TEST(Glossary, FindsATermByItsNameInAnyLanguage) {
  for (const std::string name : {"scapula", "Shoulder blade", "schulterblatt", "SCHULTERBLATT"}) {
    const auto found = Shipped().Find(name);
    ASSERT_EQ(found.size(), 1u) << name;
    EXPECT_EQ(found[0].names.latin, "scapula");
  }
  EXPECT_EQ(Shipped().Find("Fuss").size(), 1u);
  EXPECT_TRUE(Shipped().Find("").empty());
}

TEST(Glossary, GivesAllThatBearOneName) {
  EXPECT_EQ(Shipped().Find("neck").size(), 2u);
  EXPECT_EQ(Shipped().Find("Speiche").size(), 1u);
}

TEST(Glossary, KeepsWhatWasPrinted) {
  EXPECT_EQ(Shipped().Find("brachium")[0].printed, "Braichium");
  EXPECT_EQ(Shipped().Find("radius")[0].printed, "Rdius");
  EXPECT_EQ(Shipped().Find("medial cuneiform bone")[0].printed, "medial cubeiform bone");
}

TEST(Glossary, NamesTheKeyOfATermWithoutAName) {
  const test::TemporaryFolder folder;
  const auto file = folder.Write("g.yaml", "sections:\n  - terms:\n    - {latin: a, english: b}\n");
  EXPECT_THAT([&] { Glossary::Load(file); },
              testing::ThrowsMessage<config::ConfigError>(
                  testing::HasSubstr("sections[0].terms[0].german")));
}

TEST(Names, AreSaidInTheLanguageThatIsAsked) {
  const Names names{"knee", "Knie", "genu"};
  EXPECT_EQ(names.In(Language::kEnglish), "knee");
  EXPECT_EQ(names.In(Language::kGerman), "Knie");
  EXPECT_EQ(names.In(Language::kLatin), "genu");
}

}  // namespace
}  // namespace deixis::anatomy
