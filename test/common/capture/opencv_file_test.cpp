#include "common/capture/opencv_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <random>

#include "common/capture/opencv_text.h"
#include "common/config/config.h"
#include "test/support/temporary_folder.h"

namespace deixis::capture {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string kHeader = "%YAML:1.0\n---\n";
const std::string kMatrix =
    "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 500., 0., 319.5, 0., 510., 239.5, 0., 0., 1. ]\n";
const std::string kHonest = kHeader + "calibration_time: \"Mon 01 Jan 2024 [10:00:00]\"\n" +
                            "image_width: 640\nimage_height: 480\n" + kMatrix +
                            "distortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n"
                            "   dt: d\n   data: [ -0.1, 0.02, 0.001, 0.002, 0. ]\n"
                            "views:\n   - { name:\"a, b\", points:[ 1, 2 ] } # [ as they came\n";

std::string Repeated(const std::string& part, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += part;
  return text;
}

class OpenCvFileTest : public testing::Test {
 protected:
  auto Reading(const std::string& text) {
    return [this, text] {
      const OpenCvFile file(folder_.Write("lens.yml", text).string(), "set it");
      file.Matrix("camera_matrix");
    };
  }
  test::TemporaryFolder folder_;
};

TEST_F(OpenCvFileTest, ReadsWhatOpenCvWritesInEveryFormat) {
  const cv::Mat matrix = (cv::Mat_<double>(3, 3) << 500, 0, 319.5, 0, 510, 239.5, 0, 0, 1);
  for (const std::string name : {"lens.yml", "lens.xml", "lens.json"}) {
    const std::string path = (folder_.path() / name).string();
    cv::FileStorage storage(path, cv::FileStorage::WRITE);
    for (int i = 0; i < 40; ++i) storage << "other_" + std::to_string(i) << matrix;
    storage << "words"
            << "["
            << "a [b"
            << "c"
            << "]"
            << "camera_matrix" << matrix;
    storage.release();
    const OpenCvFile file(path, "");
    EXPECT_EQ(cv::norm(file.Matrix("camera_matrix"), matrix, cv::NORM_INF), 0.0) << name;
  }
}

TEST_F(OpenCvFileTest, RefusesWhatNestsTooDeeplyForOpenCv) {
  constexpr int kDeep = 30000;
  const std::vector<std::string> texts{
      kHeader + "a: " + Repeated("[", kDeep),
      kHeader + "a: " + Repeated("{b: ", kDeep),
      kHeader + "a: " + Repeated("- ", kDeep),
      kHeader + Repeated("a: ", kDeep),
      kHeader + "a:\n" + Repeated("[\n", kDeep),
      kHeader + "a: " + Repeated("[\"]\",", kDeep),
      kHeader + "a: " + Repeated("[\"]\",\n", kDeep),
      kHeader + "a: " + Repeated("[a',\"']\",\n", kDeep),
      kHeader + "a: " + Repeated("[ # ]\n", kDeep),
      kHeader + "a: " + Repeated("{b]: ", kDeep),
      kHeader + "a: " + Repeated("{b]:\n", kDeep),
      "{\"a\":" + Repeated("[", kDeep),
      "{\"a\":" + Repeated("{\"]}\":\n", kDeep),
      "{\"a\":" + Repeated("[ // ]\n", kDeep),
      "{\"a\":" + Repeated("[ /*\n]\n*/\n", kDeep),
      "<?xml version=\"1.0\"?>\n<opencv_storage>" + Repeated("<a>", kDeep),
      "<?xml version=\"1.0\"?>\n<opencv_storage>" + Repeated("<a>\n<!--\n</a>\n-->\n", kDeep),
      "<?xml version=\"1.0\"?>\n<opencv_storage>" + Repeated("<a b=\"</a>\">\n", kDeep),
  };
  for (const std::string& text : texts) {
    EXPECT_THAT(Reading(text), ThrowsMessage<config::ConfigError>(
                                   AllOf(HasSubstr("lens.yml: nests"), HasSubstr("levels"))))
        << text.substr(0, 60);
  }
}

TEST_F(OpenCvFileTest, RefusesTextsOfSeveralLinesOrTakesThemWithoutACrash) {
  constexpr int kDeep = 30000;
  const std::vector<std::string> texts{
      "{\"a\":" + Repeated("[\"\n]\n\",\n", kDeep),
      "{\"a\":" + Repeated("{\"\n}\n\":\n", kDeep),
      kHeader + "a: " + Repeated("[\"\n]\n\",\n", kDeep),
      kHeader + "a: " + Repeated("{b\n}\n: ", kDeep),
      "<?xml version=\"1.0\"?>\n<opencv_storage>" + Repeated("<a b=\"\n</a>\n\">\n", kDeep),
      "<?xml version=\"1.0\"?>\n<opencv_storage>" + Repeated("<a>\"\n</a>\n\"\n", kDeep),
      "<?xml version=\"1.0\"?>\n<opencv_storage>" + Repeated("<a>\n<?b\n</a>\n?>\n", kDeep),
      "<?xml version=\"1.0\"?>\n<opencv_storage>" + Repeated("<a>\n<!b\n</a>\n>\n", kDeep),
      "<?xml version=\"1.0\"?>\n<opencv_storage>" + Repeated("<a></b>\n", kDeep),
      kHeader + "a: " + Repeated("[}\n", kDeep),
      kHeader + Repeated("a:\n", kDeep),
      kHeader + Repeated("-\n", kDeep),
      kHeader + Repeated("a: b: c:\n", kDeep),
      kHeader + Repeated("a: !!map\n", kDeep),
      kHeader + Repeated("a: &x\n", kDeep),
      kHeader + "a: " + Repeated("!!seq ", kDeep),
  };
  for (const std::string& text : texts) {
    EXPECT_THROW(Reading(text)(), config::ConfigError) << text.substr(0, 60);
  }
}

TEST_F(OpenCvFileTest, TakesTheNestingThatItAllows) {
  for (const std::string& deep :
       {Repeated("[", 120) + Repeated("]", 120), Repeated("- ", 120) + "1"}) {
    EXPECT_NO_THROW(Reading(kHeader + kMatrix + "a: " + deep + "\n")());
  }
}

TEST_F(OpenCvFileTest, RefusesMatricesOfManyDimensions) {
  for (const int dimensions : {3, 40, 101}) {
    const std::string sizes = Repeated("1, ", dimensions - 1) + "1";
    EXPECT_THAT(Reading(kHeader + "camera_matrix: !!opencv-nd-matrix\n   sizes: [ " + sizes +
                        " ]\n   dt: d\n   data: [ 1. ]\n"),
                ThrowsMessage<config::ConfigError>(
                    AllOf(HasSubstr("lens.yml: key 'camera_matrix'"), HasSubstr("opencv-matrix"))))
        << dimensions;
  }
}

TEST_F(OpenCvFileTest, RefusesMatricesOfAbsurdSize) {
  for (const std::string side : {"2000000000", "200000", "40000", "-3", "0", "1.5"}) {
    EXPECT_THAT(Reading(kHeader + "camera_matrix: !!opencv-matrix\n   rows: " + side +
                        "\n   cols: " + side + "\n   dt: d\n   data: [ 1. ]\n"),
                ThrowsMessage<config::ConfigError>(HasSubstr("not an opencv-matrix")))
        << side;
  }
}

TEST_F(OpenCvFileTest, RefusesSizesThatNoPictureHas) {
  const auto sized = [this](const std::string& width, const std::string& height) {
    return [this, width, height] {
      const std::string text =
          kHeader + "image_width: " + width + "\nimage_height: " + height + "\n";
      OpenCvFile(folder_.Write("lens.yml", text).string(), "").ImageSize();
    };
  };
  EXPECT_NO_THROW(sized("640", "480")());
  for (const std::string side : {"0", "-5", "32767", "1000000000", "2147483647", "4294967936",
                                 "99999999999999", "640.5", "abc", "[ 1 ]"}) {
    EXPECT_THAT(sized(side, "480"),
                ThrowsMessage<config::ConfigError>(
                    AllOf(HasSubstr("lens.yml: key 'image_width'"), HasSubstr("1 to 32766"))))
        << side;
    EXPECT_THAT(sized("640", side), ThrowsMessage<config::ConfigError>(HasSubstr("'image_height'")))
        << side;
  }
  EXPECT_THAT(sized("32766", "32766"),
              ThrowsMessage<config::ConfigError>(HasSubstr("more pixels")));
}

TEST_F(OpenCvFileTest, SaysWhichHalfOfTheSizeIsMissing) {
  const auto with = [this](const std::string& line) {
    return OpenCvFile(folder_.Write("lens.yml", kHeader + "a: 1\n" + line).string(), "")
        .ImageSize();
  };
  EXPECT_EQ(with(""), cv::Size());
  EXPECT_THAT([&] { with("image_width: 640\n"); },
              ThrowsMessage<config::ConfigError>(HasSubstr("'image_height' is missing")));
  EXPECT_THAT([&] { with("image_height: 480\n"); },
              ThrowsMessage<config::ConfigError>(HasSubstr("'image_width' is missing")));
}

TEST_F(OpenCvFileTest, RefusesWhatIsBinaryOrTooLarge) {
  EXPECT_THAT(Reading(kHonest + std::string(1, '\0')),
              ThrowsMessage<config::ConfigError>(HasSubstr("binary or compressed")));
  EXPECT_THAT(Reading(kHonest + std::string(kLargestOpenCvFile, ' ')),
              ThrowsMessage<config::ConfigError>(HasSubstr("more than 4 MB")));
}

TEST_F(OpenCvFileTest, RefusesPipes) {
  const std::string pipe = (folder_.path() / "pipe.yml").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(OpenCvFile(pipe, "set it"), config::ConfigError);
}

/// One byte, one run of bytes left out, doubled or made many: as damaged files and bad tools do it.
std::string Mutated(std::string text, std::mt19937& random) {
  static const std::string kBytes = "[]{}<>:-\"'#,!&*%\n \t0e.\\/\x7f\xff$";
  for (unsigned i = 0; i < 1 + random() % 4; ++i) {
    const std::size_t at = random() % text.size();
    const std::size_t length = 1 + random() % 40;
    const char byte = kBytes[random() % kBytes.size()];
    switch (random() % 5) {
      case 0:
        text[at] = byte;
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(random() % text.size(), length));
        break;
      case 3:
        text.insert(at, std::string(1 + random() % 3000, byte));
        break;
      default:
        text.insert(at, std::to_string(random()) + "e" + std::to_string(random()));
        break;
    }
    if (text.empty()) text = kHonest;
  }
  return text;
}

TEST_F(OpenCvFileTest, SurvivesMutationsOfAnHonestFile) {
  std::mt19937 random(7);
  int read = 0;
  for (int i = 0; i < 600; ++i) {
    const std::string text = Mutated(kHonest, random);
    try {
      const OpenCvFile file(folder_.Write("lens.yml", text).string(), "set it");
      file.ImageSize();
      ReadLens(file, {});
      ++read;
    } catch (const config::ConfigError&) {
      // An honest error.
    }
  }
  EXPECT_GT(read, 50);
}

}  // namespace
}  // namespace deixis::capture
