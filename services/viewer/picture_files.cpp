#include "services/viewer/picture_files.h"

#include <cctype>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "common/config/config.h"

namespace deixis::viewer {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t kLongestLabel = 40;

// Labels come over the network: nothing of them may lead out of the folder.
std::string FileNamePart(const std::string& label) {
  std::string part;
  for (const char c : label) {
    const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (part.size() < kLongestLabel) part += is_plain ? c : '-';
  }
  return part.empty() ? "none" : part;
}

// The file is closed before it is judged: a full disk shows only then.
bool WritePng(const fs::path& file, const cv::Mat& bgr) {
  std::vector<unsigned char> png;
  if (!cv::imencode(".png", bgr, png)) return false;
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(png.data()), static_cast<std::streamsize>(png.size()));
  out.close();
  return !out.fail();
}

}  // namespace

PictureFiles::PictureFiles(const fs::path& folder) : folder_(folder) {
  std::error_code error;
  fs::create_directories(folder_, error);
  std::error_code ignored;
  if (fs::is_directory(folder_, ignored)) return;
  throw config::ConfigError("save_folder '" + folder_.string() + "' cannot be made: " +
                            error.message() + "; set save_folder to one that can be written to");
}

void PictureFiles::WriteGesture(const scene::Gesture& gesture, const cv::Mat& bgr) const {
  Write("gesture_" + std::to_string(gesture.event_id) + "_" + FileNamePart(gesture.object_label) +
            "_" + std::to_string(gesture.time.microseconds) + ".png",
        bgr);
}

void PictureFiles::WriteLatest(const cv::Mat& bgr) const { Write("latest.png", bgr); }

void PictureFiles::WriteStill(Timestamp time, const cv::Mat& bgr) const {
  Write("picture_" + std::to_string(time.microseconds) + ".png", bgr);
}

void PictureFiles::Write(const std::string& name, const cv::Mat& bgr) const {
  const fs::path unfinished = folder_ / ("." + name + ".part");
  std::error_code error;
  const bool is_written = WritePng(unfinished, bgr);
  if (is_written) fs::rename(unfinished, folder_ / name, error);
  if (is_written && !error) return;
  std::error_code ignored;
  fs::remove(unfinished, ignored);
  throw PictureNotWritten("picture '" + (folder_ / name).string() +
                          "' cannot be written; free some space or set save_folder");
}

}  // namespace deixis::viewer
