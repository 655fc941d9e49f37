#include "services/stereo_driver/evaluation/rendered_sequence.h"

#include <algorithm>
#include <cstdio>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "common/config/config.h"

namespace deixis::stereo_driver {
namespace {

namespace fs = std::filesystem;

constexpr int kLooseObject = 9;
constexpr int kPerPerson = 10;  // Parts of the second person are this much higher.

std::string NameOf(int number) {
  char name[16];
  std::snprintf(name, sizeof(name), "%06d.png", number);
  return name;
}

// Six digits and .png; `room.png` is none.
bool IsFrame(const std::string& file) {
  constexpr std::size_t kDigits = 6;
  return file.size() == kDigits + 4 && file.substr(kDigits) == ".png" &&
         file.find_first_not_of("0123456789") == kDigits;
}

std::set<int> FramesWithTruth(const fs::path& folder) {
  std::set<int> frames;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder / "depth", ignored)) {
    const std::string file = entry.path().filename().string();
    if (IsFrame(file) && fs::exists(folder / "mask" / file)) {
      frames.insert(std::stoi(file));
    }
  }
  return frames;
}

std::set<int> EveryNth(const std::set<int>& frames, int every) {
  std::set<int> chosen;
  int i = 0;
  for (const int frame : frames) {
    if (i++ % every == 0) chosen.insert(frame);
  }
  return chosen;
}

cv::Mat BodyOf(const cv::Mat& mask) {
  cv::Mat is_body(mask.size(), CV_8UC1);
  std::transform(mask.begin<std::uint8_t>(), mask.end<std::uint8_t>(),
                 is_body.begin<std::uint8_t>(), [](int part) {
                   const bool is_person = part != 0 && part % kPerPerson != kLooseObject;
                   return static_cast<std::uint8_t>(is_person ? 255 : 0);
                 });
  return is_body;
}

}  // namespace

RenderedSequence::RenderedSequence(const fs::path& folder, int every)
    : folder_(folder), frames_(EveryNth(FramesWithTruth(folder), every)) {
  if (frames_.empty()) {
    throw config::ConfigError(folder.string() +
                              ": no frame has both depth/NNNNNN.png and mask/NNNNNN.png");
  }
  for (auto [video, name] : {std::pair{&left_, "left.mp4"}, std::pair{&right_, "right.mp4"}}) {
    if (!video->open((folder / name).string())) {
      throw config::ConfigError((folder / name).string() + ": cannot be read as a video");
    }
  }
  room_mm_ = ReadPicture("depth/room.png", CV_16UC1);
}

cv::Mat RenderedSequence::ReadPicture(const std::string& name, int type) const {
  const cv::Mat picture = cv::imread((folder_ / name).string(), cv::IMREAD_UNCHANGED);
  if (picture.empty() || picture.type() != type) {
    throw config::ConfigError((folder_ / name).string() +
                              ": cannot be read as a picture of its kind");
  }
  return picture;
}

std::optional<TrueFrame> RenderedSequence::Next() {
  const auto wanted = frames_.lower_bound(next_number_);
  if (wanted == frames_.end()) return std::nullopt;
  TrueFrame frame;
  frame.number = *wanted;
  for (; next_number_ <= frame.number; ++next_number_) {
    if (!left_.grab() || !right_.grab()) {
      throw config::ConfigError(folder_.string() + ": the videos end before frame " +
                                std::to_string(frame.number));
    }
  }
  left_.retrieve(frame.pair.left.bgr);
  right_.retrieve(frame.pair.right.bgr);
  const std::string name = NameOf(frame.number);
  frame.depth_mm = ReadPicture("depth/" + name, CV_16UC1);
  room_mm_.copyTo(frame.depth_mm, frame.depth_mm == 0);
  frame.is_body = BodyOf(ReadPicture("mask/" + name, CV_8UC1));
  return frame;
}

}  // namespace deixis::stereo_driver
