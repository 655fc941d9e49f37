#include "services/pose_fitter/trainer/rendered_person.h"

#include <gmock/gmock.h>

#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "common/config/config.h"

namespace deixis::pose_fitter {
namespace {

namespace fs = std::filesystem;

/// A sequence of one frame: a wall of person, 2 m away, with a loose object in its left half.
class WallPerson : public testing::Test {
 protected:
  WallPerson() : folder_(fs::path(testing::TempDir()) / "rendered_person_test") {
    fs::remove_all(folder_);
    for (const char* name : {"depth", "mask"}) fs::create_directories(folder_ / name);
    Write("person.csv", "key,value\nid,wall\nsex,male\nstature_mm,1700.0\nr_thigh_mm,400.0\n");
    Write("joints.csv", "frame,time_s,joint,x,y,z,u,v,visible\n0,0.0,nose,0.1,-0.2,2.0,1,2,1\n");
    cv::FileStorage lens((folder_ / "intrinsics.yml").string(), cv::FileStorage::WRITE);
    lens << "M1" << (cv::Mat_<double>(3, 3) << 100, 0, 20, 0, 100, 15, 0, 0, 1);
    lens << "D1" << cv::Mat::zeros(1, 5, CV_64F);
    cv::FileStorage world((folder_ / "camera_world.yml").string(), cv::FileStorage::WRITE);
    world << "floor_plane_cam" << (cv::Mat_<double>(1, 4) << 0, -1, 0, 1.2);
    cv::imwrite((folder_ / "depth/000000.png").string(), cv::Mat(30, 40, CV_16UC1, 2000));
    cv::Mat mask(30, 40, CV_8UC1, cv::Scalar(1));
    mask.colRange(0, 20).setTo(9);
    cv::imwrite((folder_ / "mask/000000.png").string(), mask);
  }
  void Write(const char* name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  void ExpectFault(const std::string& word) const {
    try {
      ReadRenderedPerson(folder_);
      FAIL() << "nothing was refused";
    } catch (const config::ConfigError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(word));
    }
  }

  fs::path folder_;
};

TEST_F(WallPerson, IsReadWithItsSizesAndMarkers) {
  const RenderedPerson person = ReadRenderedPerson(folder_);
  EXPECT_EQ(person.id, "wall");
  EXPECT_EQ(person.sex, anthropometry::Sex::kMale);
  EXPECT_DOUBLE_EQ(person.stature_m, 1.7);
  EXPECT_DOUBLE_EQ(person.lengths_m.at("r_thigh"), 0.4);
  EXPECT_EQ(person.frames.at(0).at("nose"), Eigen::Vector3d(0.1, -0.2, 2.0));
  EXPECT_EQ(person.up, -Eigen::Vector3d::UnitY());
  EXPECT_THAT(person.depth_frames, testing::ElementsAre(0));
}

TEST_F(WallPerson, HasASurfaceThatFacesTheCameraAndNoLooseObjects) {
  const auto points = ReadSurface(ReadRenderedPerson(folder_), 0, 3);
  ASSERT_FALSE(points.empty());
  for (const SurfacePoint& point : points) {
    EXPECT_DOUBLE_EQ(point.point_m.z(), 2.0);
    EXPECT_GT(point.point_m.x(), 0.0);
    EXPECT_NEAR(point.normal.z(), -1.0, 1e-9);
    EXPECT_EQ(point.part, 1);
  }
  EXPECT_NEAR(points.front().point_m.y(), 2.0 * (3.0 - 15.0) / 100.0, 1e-9);
}

TEST_F(WallPerson, IsRefusedWithoutStature) {
  Write("person.csv", "key,value\nid,wall\n");
  ExpectFault("stature_mm");
}

TEST_F(WallPerson, IsRefusedWithJointsThatAreNoNumbers) {
  Write("joints.csv", "frame,time_s,joint,x,y,z,u,v,visible\n0,0.0,nose,left,-0.2,2.0,1,2,1\n");
  ExpectFault("joints.csv");
}

TEST_F(WallPerson, IsRefusedWithoutLens) {
  fs::remove(folder_ / "intrinsics.yml");
  ExpectFault("intrinsics.yml");
}

TEST_F(WallPerson, IsRefusedWithoutDepth) {
  fs::remove(folder_ / "depth/000000.png");
  ExpectFault("depth");
}

}  // namespace
}  // namespace deixis::pose_fitter
