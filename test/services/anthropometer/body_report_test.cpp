#include "services/anthropometer/core/body_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "common/config/config.h"
#include "services/anthropometer/core/json_text.h"
#include "services/anthropometer/core/whole_file.h"
#include "test/support/temporary_folder.h"

namespace deixis::anthropometer {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kKinematics = DEIXIS_SOURCE_DIR "/config/kinematics/";

std::string FaultOf(const std::function<void()>& work) {
  try {
    work();
  } catch (const config::ConfigError& error) {
    return error.what();
  }
  return {};
}

TEST(BodyReport, TellsSumsOfMeasuresToo) {
  const auto measures = anthropometry::BodyMeasures::Load({kKinematics + "measures.yaml"});
  const Person person{anthropometry::Sex::kMale, 1.8, {{"kph", 1.8}, {"stl", 0.94}}};
  ASSERT_FALSE(measures.Find("blp")->derived.empty());  // kph - stl
  EXPECT_EQ(MeasuresJson(measures, person, {anatomy::Language::kGerman, "", "blp"}),
            R"([{"measure": "blp", "name": ")" + measures.Find("blp")->names.german +
                R"(", "mm": 860}])");
}

TEST(BodyReport, ListsWhatThereIsForANameThatIsNone) {
  const auto measures = anthropometry::BodyMeasures::Load({kKinematics + "measures.yaml"});
  const auto limits = anatomy::JointLimits::Load(kKinematics + "joint_limits.yaml");
  const Person person{anthropometry::Sex::kMale, 1.8, {{"kph", 1.8}}};
  const ReportRequest request{anatomy::Language::kGerman, "tail", "wingspan"};
  EXPECT_THAT(FaultOf([&] { JointLimitsJson(limits, request); }),
              AllOf(HasSubstr("--joint tail is none"), HasSubstr("knee (Kniegelenk)")));
  EXPECT_THAT(FaultOf([&] { MeasuresJson(measures, person, request); }),
              AllOf(HasSubstr("--measure wingspan is none"), HasSubstr("kph (Körperhöhe)")));
}

TEST(BodyReport, FindsJointsByTheirNamesInAnyLanguage) {
  const auto limits = anatomy::JointLimits::Load(kKinematics + "joint_limits.yaml");
  const auto told = [&](const std::string& name) {
    return JointLimitsJson(limits, {anatomy::Language::kEnglish, name, ""});
  };
  EXPECT_THAT(told("hip"), AllOf(HasSubstr("\"hip joint\""), Not(HasSubstr("knee"))));
  for (const char* name : {"Hip joint", "Hüftgelenk", "hueftgelenk", "articulatio coxae"}) {
    EXPECT_EQ(told(name), told("hip")) << name;
  }
}

TEST(JsonText, EscapesWhatJsonDoesNotTake) {
  EXPECT_EQ(JsonString("a\"b\\c\nä"), "\"a\\\"b\\\\c\\u000aä\"");
  EXPECT_EQ(JsonNumber(-0.0), "0");
  EXPECT_EQ(JsonObject({{"a", JsonArray({"1", "2"})}}), "{\"a\": [1, 2]}");
}

TEST(WholeFile, LeavesTheOldOneWhenItCannotBeWritten) {
  const test::TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  fs::create_directories(folder / "taken");
  WriteWhole(folder / "file", "first");
  WriteWhole(folder / "file", "second");
  std::string text;
  std::getline(std::ifstream(folder / "file"), text);
  EXPECT_EQ(text, "second");
  EXPECT_THAT(FaultOf([&] { WriteWhole(folder / "taken", "x"); }), HasSubstr("it is a folder"));
  EXPECT_THAT(FaultOf([&] { WriteWhole(folder / "none" / "file", "x"); }),
              HasSubstr("none/file: cannot be written"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 2);  // No part is left.
}

}  // namespace
}  // namespace deixis::anthropometer
