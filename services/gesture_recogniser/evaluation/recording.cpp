#include "services/gesture_recogniser/evaluation/recording.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "common/config/config.h"

namespace deixis::gesture_recogniser {
namespace {

scene::Side SideFrom(const std::string& word) {
  if (word == "left") return scene::Side::kLeft;
  if (word == "right") return scene::Side::kRight;
  return scene::Side::kUnknown;
}

std::istream& operator>>(std::istream& in, scene::Box& box) {
  return in >> box.x_px >> box.y_px >> box.width_px >> box.height_px;
}

scene::Object ReadObject(std::istream& in) {
  scene::Object object;
  scene::Box box;
  in >> object.id >> object.label >> box;
  object.box = box;
  object.score = 1.0;
  return object;
}

LabelledGesture ReadGesture(std::istream& in) {
  LabelledGesture gesture;
  std::string side;
  in >> gesture.start_s >> gesture.apex_s >> gesture.end_s >> gesture.retract_end_s >> side >>
      gesture.object_id;
  gesture.side = SideFrom(side);
  return gesture;
}

RecordedHand ReadHand(std::istream& in) {
  RecordedHand hand;
  std::string side;
  in >> hand.id >> side >> hand.centre_px.x() >> hand.centre_px.y() >> hand.sigma_px >>
      hand.is_measured >> hand.is_acting;
  hand.side = SideFrom(side);
  return hand;
}

bool HasMoreWords(std::istream& in) {
  std::string word;
  return static_cast<bool>(in >> word);
}

/// Takes in one line; false when it does not make sense.
bool ReadLine(std::istringstream& in, Recording& recording) {
  std::string word;
  in >> word;
  if (word == "recording") {
    in >> recording.name >> recording.person;
  } else if (word == "object") {
    recording.objects.push_back(ReadObject(in));
  } else if (word == "gesture") {
    recording.gestures.push_back(ReadGesture(in));
  } else if (word == "frame") {
    in >> recording.frames.emplace_back().time_s;
  } else if (word == "face" && !recording.frames.empty()) {
    in >> recording.frames.back().face.emplace();
  } else if (word == "hand" && !recording.frames.empty()) {
    recording.frames.back().hands.push_back(ReadHand(in));
  } else {
    return false;
  }
  return !in.fail() && !HasMoreWords(in);
}

}  // namespace

Recording ReadRecording(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw config::ConfigError(file.string() + ": cannot be read");
  Recording recording;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.empty()) continue;
    std::istringstream words(line);
    if (!ReadLine(words, recording)) {
      throw config::ConfigError(file.string() + ":" + std::to_string(number) + ": '" + line +
                                "' is no line of a recording");
    }
  }
  return recording;
}

std::vector<Recording> ReadRecordings(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder)) {
    throw config::ConfigError("'" + folder.string() +
                              "' is no folder; name one with *.recording files");
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".recording") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<Recording> recordings;
  for (const auto& file : files) recordings.push_back(ReadRecording(file));
  return recordings;
}

}  // namespace deixis::gesture_recogniser
