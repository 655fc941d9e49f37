#include "common/config/config.h"

#include <gmock/gmock.h>

#include "test/support/temporary_folder.h"

namespace deixis::config {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

enum class Pace { kSlow, kFast };
inline auto EnumNames(Pace) {
  return std::vector<std::pair<std::string, Pace>>{{"slow", Pace::kSlow}, {"fast", Pace::kFast}};
}

struct Part {
  double gain = 1.5;
  template <typename Visitor>
  void Visit(Visitor& v) {
    v("gain", gain);
  }
};

struct Sample {
  int count = 3;
  bool is_on = false;
  std::string name = "none";
  Pace pace = Pace::kSlow;
  Part part;
  std::vector<Part> parts;
  std::vector<double> values{1.0};
  template <typename Visitor>
  void Visit(Visitor& v) {
    v("count", count);
    v("is_on", is_on);
    v("name", name);
    v("pace", pace);
    v("part", part);
    v("parts", parts);
    v("values", values);
  }
  void Validate() const {
    Faults faults;
    faults.Require(count > 0, "count", "must be positive");
    faults.Require(part.gain < 10.0, "part.gain", "must be below 10");
    faults.ThrowIfAny();
  }
};

class Config : public testing::Test {
 protected:
  Sample Read(const std::string& text, const std::vector<std::string>& overrides = {},
              Completeness completeness = Completeness::kDefaultsAllowed) {
    return Load<Sample>(folder_.Write("sample.yaml", text), overrides, completeness);
  }
  std::string FaultOf(const std::string& text, const std::vector<std::string>& overrides = {},
                      Completeness completeness = Completeness::kDefaultsAllowed) {
    try {
      Read(text, overrides, completeness);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "accepted";
  }
  test::TemporaryFolder folder_;
};

TEST_F(Config, KeepsDefaultsOfKeysThatAreLeftOut) {
  const Sample sample = Read("count: 7\n");
  EXPECT_EQ(sample.count, 7);
  EXPECT_EQ(sample.part.gain, 1.5);
  EXPECT_THAT(sample.values, ElementsAre(1.0));
}

TEST_F(Config, ReadsAnEmptyFileAsDefaults) { EXPECT_EQ(Read("").count, 3); }

TEST_F(Config, ReadsEveryKindOfField) {
  const Sample sample = Read(
      "count: 2\nis_on: true\nname: left\npace: fast\npart: {gain: 2}\n"
      "parts: [{gain: 3}, {gain: 4}]\nvalues: [5, 6.5]\n",
      {}, Completeness::kEveryKey);
  EXPECT_TRUE(sample.is_on);
  EXPECT_EQ(sample.name, "left");
  EXPECT_EQ(sample.pace, Pace::kFast);
  EXPECT_EQ(sample.part.gain, 2.0);
  ASSERT_EQ(sample.parts.size(), 2u);
  EXPECT_EQ(sample.parts[1].gain, 4.0);
  EXPECT_THAT(sample.values, ElementsAre(5.0, 6.5));
}

TEST_F(Config, OverridesNestedKeysAfterTheFile) {
  const Sample sample = Read("part: {gain: 2}\n", {"part.gain=4", "pace=fast", "values=[1,2]"});
  EXPECT_EQ(sample.part.gain, 4.0);
  EXPECT_EQ(sample.pace, Pace::kFast);
  EXPECT_EQ(sample.values.size(), 2u);
}

TEST_F(Config, NamesFileLineAndKeyOfAnUnknownKey) {
  EXPECT_THAT(FaultOf("count: 1\ncuont: 2\n"),
              AllOf(HasSubstr("sample.yaml:2"), HasSubstr("'cuont'"), HasSubstr("count")));
}

TEST_F(Config, RejectsUnknownNestedKeys) {
  EXPECT_THAT(FaultOf("part: {gian: 2}\n"), HasSubstr("'part.gian' is not known"));
}

TEST_F(Config, RejectsDuplicateKeys) {
  EXPECT_THAT(FaultOf("count: 1\ncount: 2\n"), HasSubstr("'count' is given twice"));
}

TEST_F(Config, RejectsWrongTypes) {
  EXPECT_THAT(FaultOf("count: many\n"), HasSubstr("'count' must be a whole number"));
  EXPECT_THAT(FaultOf("count: 1.5\n"), HasSubstr("'count' must be a whole number"));
  EXPECT_THAT(FaultOf("is_on: maybe\n"), HasSubstr("'is_on' must be true or false"));
  EXPECT_THAT(FaultOf("part: 3\n"), HasSubstr("'part' must be a mapping"));
  EXPECT_THAT(FaultOf("values: 3\n"), HasSubstr("'values' must be a list"));
  EXPECT_THAT(FaultOf("part: {gain: .nan}\n"), HasSubstr("must be a finite number"));
}

TEST_F(Config, NamesTheAllowedWordsOfAnEnumeration) {
  EXPECT_THAT(FaultOf("pace: brisk\n"), AllOf(HasSubstr("'brisk'"), HasSubstr("slow, fast")));
}

TEST_F(Config, ReportsAllFaultsOfMeaningAtOnce) {
  EXPECT_THAT(FaultOf("count: 0\npart: {gain: 12}\n"),
              AllOf(HasSubstr("'count' must be positive"), HasSubstr("'part.gain' must be below")));
}

TEST_F(Config, RejectsBrokenYaml) {
  EXPECT_THAT(FaultOf("count: [1\n"), HasSubstr("is not valid YAML"));
}

TEST_F(Config, RejectsAMissingFile) {
  EXPECT_THROW(Load<Sample>(folder_.path() / "absent.yaml"), ConfigError);
}

TEST_F(Config, RejectsAnOverrideWithoutAValue) {
  EXPECT_THAT(FaultOf("", {"count"}), HasSubstr("key=value"));
}

TEST_F(Config, DemandsEveryKeyOfShippedFiles) {
  EXPECT_THAT(FaultOf("count: 1\n", {}, Completeness::kEveryKey), HasSubstr("is missing"));
}

TEST_F(Config, FindsAFileByItsPath) {
  const auto path = folder_.Write("here.yaml", "");
  EXPECT_EQ(FindConfig(path.string()), path);
}

TEST_F(Config, SaysWhereAMissingConfigurationWasSearched) {
  try {
    FindConfig("no_such.yaml");
    FAIL() << "found a file that does not exist";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("no_such.yaml"), HasSubstr("searched")));
  }
}

}  // namespace
}  // namespace deixis::config
