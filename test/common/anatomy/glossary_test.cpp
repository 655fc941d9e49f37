#include "common/anatomy/glossary.h"

#include <gmock/gmock.h>

#include <map>
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

std::vector<std::string> SectionsOf(const std::string& name) {
  std::vector<std::string> sections;
  for (const Term& term : Shipped().Find(name)) sections.push_back(term.section);
  return sections;
}

bool IsAdded(const Term& term) { return term.why.rfind("added", 0) == 0; }

// Counted in the source; synonyms that share a line there ("Thorax / Pectus") are two.
TEST(Glossary, HasEveryTermOfTheSource) {
  std::map<std::string, int> terms;
  for (const Term& term : Shipped().terms()) terms[term.section] += IsAdded(term) ? 0 : 1;
  EXPECT_EQ(terms, (std::map<std::string, int>{{"directions of cutting", 7},
                                               {"planes", 5},
                                               {"direction and position", 17},
                                               {"positions of the extremities", 11},
                                               {"action of muscles and joints", 13},
                                               {"main parts and regions of the body", 24},
                                               {"bones: basic terms", 5},
                                               {"bones of the arm", 13},
                                               {"bones of the leg", 12},
                                               {"spine", 6}}));
}

TEST(Glossary, SaysWhatItAdds) {
  std::vector<std::string> added;
  for (const Term& term : Shipped().terms()) {
    if (IsAdded(term)) added.push_back(term.names.latin);
  }
  EXPECT_THAT(added, testing::ElementsAre("os lunatum", "scapula", "clavicula"));
}

TEST(Glossary, HasEveryTermOnce) {
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
  EXPECT_EQ(Shipped().Find("aeusseres Keilbein").size(), 1u);
  EXPECT_TRUE(Shipped().Find("").empty());
}

TEST(Glossary, FindsUmlautsInCapitals) {
  EXPECT_EQ(Shipped().Find("WIRBELSÄULE").size(), 1u);
  EXPECT_EQ(Shipped().Find("ÄUßERES KEILBEIN").size(), 1u);
}

TEST(Glossary, FindsTermsWithAndWithoutTheirBrackets) {
  EXPECT_EQ(Shipped().Find("Träger").size(), 1u);
  EXPECT_EQ(Shipped().Find("Träger (erster Halswirbel)").size(), 1u);
}

TEST(Glossary, FindsNothingForAnUnknownTermOrPartOfOne) {
  for (const char* name : {"tentacle", "Hume", "humerus ", "(bone)", ")"}) {
    EXPECT_TRUE(Shipped().Find(name).empty()) << name;
  }
}

TEST(Glossary, GivesAllThatBearOneName) {
  EXPECT_EQ(Shipped().Find("neck").size(), 2u);
  EXPECT_EQ(Shipped().Find("Speiche").size(), 1u);
}

TEST(Glossary, GivesAllMeaningsOfATermThatOccursTwice) {
  using testing::ElementsAre;
  const std::string region = "main parts and regions of the body";
  EXPECT_THAT(SectionsOf("dorsalis"),
              ElementsAre("direction and position", "positions of the extremities",
                          "positions of the extremities"));
  EXPECT_THAT(SectionsOf("Manus"), ElementsAre(region, "bones of the arm"));
  EXPECT_THAT(SectionsOf("Hand"), ElementsAre(region, "bones of the arm"));
  EXPECT_THAT(SectionsOf("pes"), ElementsAre(region, "bones of the leg"));
  EXPECT_THAT(SectionsOf("femur"), ElementsAre(region, "bones of the leg"));
  EXPECT_THAT(SectionsOf("epiphysis"), ElementsAre("bones: basic terms", "bones: basic terms"));
  EXPECT_THAT(SectionsOf("femur (bone)"), ElementsAre("bones of the leg"));
}

TEST(Glossary, HasNoMisprintedNames) {
  for (const char* name : {"Braichium", "Rdius", "medial cubeiform bone", "towards to head",
                           "sesamoid bone", "Sesambein", "intra", "(Unterschenkel",
                           "vertebra of the loin", "circumferent articular surface"}) {
    EXPECT_TRUE(Shipped().Find(name).empty()) << name;
  }
}

TEST(Glossary, SaysOnlyOfWhatDiffersThatItWasPrintedElse) {
  for (const Term& term : Shipped().terms()) {
    for (const std::string& text : {term.names.english, term.names.german, term.names.latin}) {
      EXPECT_NE(text, term.printed) << term.names.latin;
    }
  }
}

TEST(Glossary, LeadsFromTheFrontToBehindAsVentrodorsalSays) {
  for (const char* name : {"sagittal", "ventrodorsal", "anterior-posterior"}) {
    ASSERT_EQ(Shipped().Find(name).size(), 1u) << name;
    EXPECT_THAT(Shipped().Find(name)[0].names.english, testing::HasSubstr("front to behind"));
    EXPECT_THAT(Shipped().Find(name)[0].names.german, testing::HasSubstr("vorne nach hinten"));
    EXPECT_EQ(Shipped().Find(name)[0].printed, "from behind to the front");
  }
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
