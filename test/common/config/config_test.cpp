#include "common/config/config.h"

#include <gmock/gmock.h>

#include "test/support/temporary_folder.h"

namespace deixis::config {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::ThrowsMessage;

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
  void Validate() const {
    Faults faults;
    faults.Require(gain >= 0.0, "gain", "must not be negative");
    faults.ThrowIfAny();
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

TEST_F(Config, RejectsASecondDocument) {
  EXPECT_THAT(FaultOf("count: 1\n---\ncount: 2\n"), HasSubstr("a second document begins"));
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

TEST_F(Config, NamesPathAndLineOfANestedFault) {
  EXPECT_THAT(FaultOf("count: 1\npart:\n  gain: -1\n"),
              HasSubstr("sample.yaml:3: key 'part.gain' must not be negative"));
  EXPECT_THAT(FaultOf("parts:\n  - {gain: 1}\n  - {gain: -1}\n"),
              HasSubstr("sample.yaml:3: key 'parts[1].gain' must not be negative"));
  EXPECT_THAT(FaultOf("name: left\n\ncount: 0\n"), HasSubstr("sample.yaml:3: key 'count' must"));
}

TEST_F(Config, RejectsAnAliasThatHoldsItself) {
  EXPECT_THAT(FaultOf("count: 1\npart: &a\n  gain: *a\n"),
              AllOf(HasSubstr("sample.yaml:2: anchors and aliases"), HasSubstr("not taken")));
  EXPECT_THAT(FaultOf("part: &a [*a]\n"), HasSubstr("anchors and aliases"));
}

TEST_F(Config, RejectsAnAliasBombAtOnce) {
  std::string bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 30; ++i) {
    const std::string last = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + last + ", " + last +
            ", " + last + "]\n";
  }
  EXPECT_THAT(FaultOf(bomb), HasSubstr("anchors and aliases"));
}

TEST_F(Config, RejectsBottomlessNesting) {
  const std::string nested = std::string(100'000, '[') + std::string(100'000, ']');
  EXPECT_THAT(FaultOf("values: " + nested + "\n"), HasSubstr("nested more than 32 levels"));
  EXPECT_THAT(FaultOf("", {"values=" + nested}), HasSubstr("nested more than 32 levels"));
}

TEST_F(Config, RejectsWhatIsNoFile) {
  EXPECT_THAT([] { FindConfig("/dev/null"); },
              ThrowsMessage<ConfigError>(HasSubstr("'/dev/null' is not a file")));
  EXPECT_THAT([this] { FindConfig(folder_.path().string()); },
              ThrowsMessage<ConfigError>(HasSubstr("is not a file")));
  EXPECT_THAT([] { FindConfig(""); }, ThrowsMessage<ConfigError>(HasSubstr("is empty")));
}

TEST_F(Config, NamesAFileThatCannotBeRead) {
  EXPECT_THAT([] { Load<Sample>("/proc/self/mem"); },
              ThrowsMessage<ConfigError>(HasSubstr("/proc/self/mem: cannot be read: ")));
}

TEST_F(Config, RejectsAMissingFile) {
  EXPECT_THROW(Load<Sample>(folder_.path() / "absent.yaml"), ConfigError);
}

TEST_F(Config, RejectsAnOverrideWithoutAValue) {
  EXPECT_THAT(FaultOf("", {"count"}), HasSubstr("key=value"));
}

TEST_F(Config, BlamesTheOverrideNotTheFile) {
  EXPECT_EQ(FaultOf("count: 1\n", {"count.b=1"}), "override 'count.b=1': 'count' is not a mapping");
  EXPECT_EQ(FaultOf("values: [1, 2]\n", {"values.0=1"}),
            "override 'values.0=1': 'values' is not a mapping");
  EXPECT_THAT(FaultOf("count: 1\n", {"count=[1"}),
              HasSubstr("override 'count=[1': the value is not valid YAML"));
  EXPECT_THAT(FaultOf("count: 1\n", {"inner.count=1"}),
              HasSubstr("override 'inner.count=1': key 'inner' is not known"));
}

TEST_F(Config, BlamesTheOverrideForAValueThatMakesNoSense) {
  EXPECT_EQ(FaultOf("count: 1\n", {"count=many"}),
            "override 'count=many': key 'count' must be a whole number");
  EXPECT_EQ(FaultOf("count: 1\n", {"count=0"}), "override 'count=0': key 'count' must be positive");
  EXPECT_EQ(FaultOf("part: {gain: 1}\n", {"part={gain: -1}"}),
            "override 'part={gain: -1}': key 'part.gain' must not be negative");
  EXPECT_THAT(FaultOf("", {"cuont=1"}), HasSubstr("override 'cuont=1': key 'cuont' is not known"));
  EXPECT_THAT(FaultOf("", {"part=&a {gain: *a}"}), HasSubstr("override 'part=&a {gain: *a}'"));
  EXPECT_THAT(FaultOf("", {"part={[1]: 2}"}), HasSubstr("override 'part={[1]: 2}'"));
}

TEST_F(Config, TakesTheTextOfAnOverrideAsItIs) {
  for (const std::string text : {"*.jpg", "[0-9]*.jpg", "&x", "a: b", "{", "~", "# no comment"}) {
    EXPECT_EQ(Read("name: left\n", {"name=" + text}).name, text);
  }
  EXPECT_EQ(Read("name: left\n", {"name="}).name, "");
  EXPECT_EQ(Read("name: left\n", {"name=\"two words\""}).name, "two words");
}

TEST_F(Config, OverridesKeysThatTheFileLeavesOut) {
  EXPECT_EQ(Read("", {"part.gain=4"}).part.gain, 4.0);
  EXPECT_EQ(Read("part:\n", {"part.gain=4"}).part.gain, 4.0);
}

TEST_F(Config, RejectsAFileThatIsNoMapping) {
  EXPECT_THAT(FaultOf("just words\n", {"count=1"}), HasSubstr("must be a mapping of keys"));
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

TEST_F(Config, SaysEachPlaceThatWasSearchedOnce) {
  const std::string path = (folder_.path() / "no_such.yaml").string();  // So in every folder.
  EXPECT_THAT([&] { FindConfig(path); },
              ThrowsMessage<ConfigError>(EndsWith("not found; searched: " + path)));
}

}  // namespace
}  // namespace deixis::config
