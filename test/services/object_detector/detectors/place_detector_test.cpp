#include "services/object_detector/core/detectors/place_detector.h"

#include <gmock/gmock.h>

#include "test/support/temporary_folder.h"

namespace deixis::object_detector {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const std::string kHead = "image_width_px: 640\nimage_height_px: 480\nframe: room\nplaces:\n";
const std::string kLamp = "  - {id: 7, label: lamp, box_px: [100, 200, 30, 40]}\n";
const std::string kCup = "  - {id: 3, label: cup, position_m: [1, 2, 3], position_sigma_m: 0.1}\n";

class PlacesTest : public testing::Test {
 protected:
  PlacesFile Load(const std::string& text) {
    return LoadPlaces(folder_.Write("places.yaml", text).string(), 1000);
  }
  auto Loading(const std::string& text) {
    return [this, text] { Load(text); };
  }
  static GreyPicture PictureOf(cv::Size size) { return {{5}, cv::Mat(size, CV_8UC1)}; }
  test::TemporaryFolder folder_;
};

TEST_F(PlacesTest, TellsEveryPlaceByAscendingId) {
  PlaceDetector detector(Load(kHead + kLamp + kCup));
  const auto objects = detector.Detect(PictureOf({640, 480}));
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(objects[0].id, 3);
  EXPECT_EQ(objects[0].position->position_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_NEAR(objects[0].position->covariance_m2(1, 1), 0.01, 1e-12);
  EXPECT_FALSE(objects[0].box);
  EXPECT_EQ(objects[1].id, 7);
  EXPECT_EQ(objects[1].label, "lamp");
  EXPECT_EQ(objects[1].kind, scene::ObjectKind::kPlace);
  EXPECT_EQ(objects[1].score, 1.0);
  EXPECT_FALSE(objects[1].position);
}

TEST_F(PlacesTest, ScalesBoxesToThePicture) {
  PlaceDetector detector(Load(kHead + kLamp));
  const scene::Box box = *detector.Detect(PictureOf({320, 960}))[0].box;
  EXPECT_NEAR(box.x_px, 50.0, 1e-9);
  EXPECT_NEAR(box.y_px, 400.0, 1e-9);
  EXPECT_NEAR(box.width_px, 15.0, 1e-9);
  EXPECT_NEAR(box.height_px, 80.0, 1e-9);
}

TEST_F(PlacesTest, RefusesTheIdsOfTrackedObjects) {
  EXPECT_THAT(Loading(kHead + "  - {id: 1000, label: lamp, box_px: [1, 2, 3, 4]}\n"),
              ThrowsMessage<config::ConfigError>(HasSubstr("ids from 1000 on")));
}

TEST_F(PlacesTest, RefusesAnIdThatIsUsedTwice) {
  EXPECT_THAT(Loading(kHead + kLamp + kLamp),
              ThrowsMessage<config::ConfigError>(HasSubstr("used twice")));
}

TEST_F(PlacesTest, RefusesBoxesThatAreNone) {
  EXPECT_THAT(Loading(kHead + "  - {id: 1, label: a, box_px: [1, 2, 3]}\n"),
              ThrowsMessage<config::ConfigError>(HasSubstr("places[0].box_px")));
  EXPECT_THAT(Loading(kHead + "  - {id: 1, label: a, box_px: [1, 2, 0, 4]}\n"),
              ThrowsMessage<config::ConfigError>(HasSubstr("at least one pixel")));
}

TEST_F(PlacesTest, RefusesBoxesThatAreNotInThePicture) {
  for (const std::string box : {"[640, 0, 5, 5]", "[0, 480, 5, 5]", "[-5, 0, 5, 5]",
                                "[0, 0, 641, 5]", "[1e300, 0, 5, 5]", "[0, 0, 1e300, 5]"}) {
    EXPECT_THAT(Loading(kHead + "  - {id: 1, label: a, box_px: " + box + "}\n"),
                ThrowsMessage<config::ConfigError>(HasSubstr("must lie in the picture")))
        << box;
  }
  EXPECT_NO_THROW(Load(kHead + "  - {id: 1, label: a, box_px: [-4, 470, 10, 20]}\n"));
}

TEST_F(PlacesTest, RefusesLabelsThatCannotBeSent) {
  for (const std::string& label : {std::string("\"\""), std::string("\"a\\0b\""),
                                   std::string("\"a\\nb\""), std::string(201, 'x')}) {
    EXPECT_THAT(Loading(kHead + "  - {id: 1, label: " + label + ", box_px: [1, 2, 3, 4]}\n"),
                ThrowsMessage<config::ConfigError>(HasSubstr("places[0].label")))
        << label;
  }
  EXPECT_NO_THROW(Load(kHead + "  - {id: 1, label: rote Tasse, box_px: [1, 2, 3, 4]}\n"));
}

TEST_F(PlacesTest, RefusesPositionsThatNothingHas) {
  const auto with = [](const std::string& rest) {
    return kHead + "  - {id: 1, label: a, " + rest + "}\n";
  };
  EXPECT_THAT(Loading(with("position_m: [1e300, 0, 1]")),
              ThrowsMessage<config::ConfigError>(HasSubstr("places[0].position_m")));
  EXPECT_THAT(Loading(with("position_m: [0, 0, 1], position_sigma_m: 1e300")),
              ThrowsMessage<config::ConfigError>(HasSubstr("places[0].position_sigma_m")));
  EXPECT_THAT(Loading(with("position_m: [0, 0, 1], extent_m: [-1, 1, 1]")),
              ThrowsMessage<config::ConfigError>(HasSubstr("places[0].extent_m")));
}

TEST_F(PlacesTest, RemarksOnNoPlacesAndOnLabelsThatAreUsedTwice) {
  EXPECT_THAT(RemarkOn(Load("")), HasSubstr("no places are known"));
  EXPECT_EQ(RemarkOn(Load(kHead + kLamp + kCup)), "");
  const std::string second = "  - {id: 8, label: lamp, box_px: [100, 200, 30, 40]}\n";
  EXPECT_THAT(RemarkOn(Load(kHead + kLamp + second)), HasSubstr("labelled 'lamp'"));
}

TEST_F(PlacesTest, RefusesAPlaceThatIsNowhere) {
  EXPECT_THAT(Loading(kHead + "  - {id: 1, label: a}\n"),
              ThrowsMessage<config::ConfigError>(HasSubstr("neither box_px nor position_m")));
}

TEST_F(PlacesTest, RefusesBoxesWithoutTheSizeOfTheirPicture) {
  EXPECT_THAT(Loading("places:\n" + kLamp),
              ThrowsMessage<config::ConfigError>(HasSubstr("image_width_px")));
}

TEST(ShippedPlaces, ExampleStatesEveryKey) {
  EXPECT_NO_THROW(config::Load<PlacesFile>(DEIXIS_SOURCE_DIR "/config/objects/example.yaml", {},
                                           config::Completeness::kEveryKey));
}

}  // namespace
}  // namespace deixis::object_detector
