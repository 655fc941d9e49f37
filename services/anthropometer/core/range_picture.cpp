#include "services/anthropometer/core/range_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "services/anthropometer/core/drawing.h"
#include "services/anthropometer/core/plane_reach.h"

namespace deixis::anthropometer {
namespace {

using body_model::Kinematics;
using range_of_motion::BodySide;

constexpr double kOpacity = 0.38;
constexpr double kShareOfLimb = 0.55;  // Radius of a sector.
constexpr double kLeastRadius_m = 0.08, kLargestRadius_m = 0.17;
constexpr double kLabelWidth = 0.25;  // Of the height.
constexpr std::size_t kLettersPerLine = 24;
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
const cv::Scalar kText(40, 40, 40), kLeader(130, 130, 130);

/// Blue, green, red; by the joint's place among all joints.
const std::array<cv::Scalar, 8> kColours = {cv::Scalar(150, 90, 30),  cv::Scalar(60, 140, 60),
                                            cv::Scalar(40, 80, 210),  cv::Scalar(160, 60, 160),
                                            cv::Scalar(30, 150, 200), cv::Scalar(170, 130, 0),
                                            cv::Scalar(60, 60, 160),  cv::Scalar(90, 160, 110)};

/// Where text of several lines stands.
struct Label {
  cv::Point anchor;  ///< The joint.
  bool is_left = true;
  std::vector<std::string> lines;
  int top_px = 0;
};

/// One view that is being drawn.
struct Panel {
  View view = View::kFront;
  cv::Mat picture;
  Projection projection;
  int height_px = 0;
  int beside_px = 0;  ///< Added to the square on either side, for labels.

  cv::Point At(const Eigen::Vector3d& point_m) const {
    return projection(point_m) + cv::Point(beside_px, 0);
  }

  double scale() const { return height_px / 1900.0; }
  int line_px() const { return height_px / 50; }
};

std::size_t PlaceOf(const std::vector<anatomy::NamedTerm>& terms, const std::string& name) {
  const auto found =
      std::find_if(terms.begin(), terms.end(), [&](const auto& term) { return term.name == name; });
  return static_cast<std::size_t>(found - terms.begin());
}

std::string NameOf(const std::vector<anatomy::NamedTerm>& terms, const std::string& name,
                   anatomy::Language language) {
  const std::size_t place = PlaceOf(terms, name);
  return DrawableText(place < terms.size() ? terms[place].names.In(language) : name);
}

cv::Scalar ColourOf(const PlaneReach& reach, const anatomy::JointLimits& limits) {
  return kColours[PlaceOf(limits.joints(), reach.joint->joint.joint()) % kColours.size()];
}

std::vector<cv::Point> SectorOf(const PlaneReach& reach, const Panel& panel) {
  const double radius_px =
      panel.projection.px_per_m() *
      std::clamp(kShareOfLimb * reach.length_m, kLeastRadius_m, kLargestRadius_m);
  const cv::Point centre = panel.At(reach.centre_m);
  const double from = reach.neutral_rad - reach.clockwise.angle_rad;
  const double to = reach.neutral_rad + reach.anticlockwise.angle_rad;
  const int steps = std::max(2, static_cast<int>((to - from) / 0.03));
  std::vector<cv::Point> sector = {centre};
  for (int i = 0; i <= steps; ++i) {
    const double angle = from + (to - from) * i / steps;
    sector.emplace_back(static_cast<int>(std::lround(centre.x + radius_px * std::cos(angle))),
                        static_cast<int>(std::lround(centre.y - radius_px * std::sin(angle))));
  }
  return sector;
}

void DrawSectors(const std::vector<PlaneReach>& reaches, const anatomy::JointLimits& limits,
                 Panel& panel) {
  for (const PlaneReach& reach : reaches) {
    const std::vector<std::vector<cv::Point>> sector = {SectorOf(reach, panel)};
    const cv::Scalar colour = ColourOf(reach, limits);
    cv::Mat filled = panel.picture.clone();
    cv::fillPoly(filled, sector, colour, cv::LINE_AA);
    cv::addWeighted(filled, kOpacity, panel.picture, 1.0 - kOpacity, 0.0, panel.picture);
    cv::polylines(panel.picture, sector, true, colour, std::max(1, panel.height_px / 700),
                  cv::LINE_AA);
  }
}

/// Broken between words, where it is long.
std::vector<std::string> Wrapped(const std::string& text) {
  std::vector<std::string> lines = {""};
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > kLettersPerLine) {
      lines.emplace_back();
    }
    lines.back() += (lines.back().empty() ? "" : " ") + word;
    begin = end + 1;
  }
  return lines;
}

std::vector<std::string> LinesOf(const PlaneReach& reach, const PictureWords& words) {
  auto lines = Wrapped(NameOf(words.limits->joints(), reach.joint->joint.joint(), words.language));
  std::vector<PlaneBound> bounds = {reach.clockwise, reach.anticlockwise};
  // The same motion to both sides is one line.
  if (bounds[0].motion == bounds[1].motion) bounds.pop_back();
  for (const PlaneBound& bound : bounds) {
    const auto degrees = std::lround(bound.angle_rad * 180.0 / M_PI);
    lines.push_back("  " + NameOf(words.limits->motions(), bound.motion, words.language) + " " +
                    std::to_string(degrees));
  }
  return lines;
}

/// Whether its label goes to the left: the front view's right arm and leg, the side view's arm.
bool IsLeft(const PlaneReach& reach, View view) {
  if (view == View::kFront) return reach.joint->joint.side() == BodySide::kRight;
  const std::string& joint = reach.joint->joint.joint();
  return joint == "shoulder" || joint == "elbow" || joint == "wrist" || joint == "ankle";
}

/// Downwards, none over another one.
void Place(std::vector<Label>& labels, const Panel& panel) {
  std::stable_sort(labels.begin(), labels.end(),
                   [](const Label& a, const Label& b) { return a.anchor.y < b.anchor.y; });
  std::array<int, 2> free_px = {3 * panel.line_px(), 3 * panel.line_px()};
  for (Label& label : labels) {
    int& next_px = free_px[label.is_left ? 0 : 1];
    label.top_px = std::max(next_px, label.anchor.y - panel.line_px());
    next_px = label.top_px + panel.line_px() * (static_cast<int>(label.lines.size()) + 1);
  }
}

int WidthOf(const std::string& text, const Panel& panel) {
  int baseline = 0;
  return cv::getTextSize(text, kFont, panel.scale(), 1, &baseline).width;
}

void DrawLabel(const Label& label, const Panel& panel, cv::Mat& picture) {
  int widest = 0;
  for (const std::string& line : label.lines) widest = std::max(widest, WidthOf(line, panel));
  const int margin_px = panel.height_px / 60;
  const int left_px = label.is_left ? margin_px : picture.cols - margin_px - widest;
  const int edge_px = label.is_left ? left_px + widest + margin_px / 2 : left_px - margin_px / 2;
  const int middle_px = label.top_px - panel.line_px() / 4;
  cv::line(picture, {edge_px, middle_px}, label.anchor, kLeader, 1, cv::LINE_AA);
  for (std::size_t i = 0; i < label.lines.size(); ++i) {
    const cv::Point at(left_px, label.top_px + static_cast<int>(i) * panel.line_px());
    cv::putText(picture, label.lines[i], at, kFont, panel.scale(), kText, 1, cv::LINE_AA);
  }
}

void DrawLabels(const std::vector<PlaneReach>& reaches, const PictureWords& words, Panel& panel) {
  std::vector<Label> labels;
  for (const PlaneReach& reach : reaches) {
    if (panel.view == View::kFront && reach.joint->joint.side() == BodySide::kLeft) continue;
    labels.push_back(
        {panel.At(reach.centre_m), IsLeft(reach, panel.view), LinesOf(reach, words), 0});
  }
  Place(labels, panel);
  for (const Label& label : labels) DrawLabel(label, panel, panel.picture);
}

/// What labels need beside the square: wide bodies leave no room in it.
int RoomBeside(const cv::Mat& picture) {
  cv::Mat is_paper, columns;
  cv::inRange(picture, picture.at<cv::Vec3b>(0, 0), picture.at<cv::Vec3b>(0, 0), is_paper);
  cv::reduce(is_paper, columns, 0, cv::REDUCE_MIN);
  int first = 0;
  while (first < columns.cols && columns.at<std::uint8_t>(first) != 0) ++first;
  return std::max(0, static_cast<int>(kLabelWidth * picture.rows) - first);
}

/// Without those of the farther arm and leg, which would lie behind the nearer ones.
std::vector<PlaneReach> Nearer(const std::vector<PlaneReach>& reaches) {
  std::vector<PlaneReach> nearer;
  for (const PlaneReach& reach : reaches) {
    const auto is_before = [&](const PlaneReach& other) {
      return other.joint->joint.side() == BodySide::kLeft &&
             other.joint->joint.joint() == reach.joint->joint.joint();
    };
    const bool is_far = reach.joint->joint.side() == BodySide::kRight;
    if (!is_far || std::none_of(reaches.begin(), reaches.end(), is_before)) {
      nearer.push_back(reach);
    }
  }
  return nearer;
}

cv::Mat DrawView(View view, const Kinematics& kinematics, const body_model::BodyPose& pose,
                 const range_of_motion::RangeOfMotion& range, const PictureWords& words,
                 int height_px) {
  const double span_m = SpanOf(kinematics);
  Panel panel{view, Draw(kinematics.model(), pose, view, height_px, span_m),
              ProjectionOf(kinematics, view, height_px, span_m), height_px};
  panel.beside_px = RoomBeside(panel.picture);
  cv::copyMakeBorder(panel.picture, panel.picture, 0, 0, panel.beside_px, panel.beside_px,
                     cv::BORDER_REPLICATE);
  auto reaches = ReachesIn(view, kinematics, range);
  if (view == View::kSide) reaches = Nearer(reaches);
  DrawSectors(reaches, *words.limits, panel);
  DrawLabels(reaches, words, panel);
  return panel.picture;
}

}  // namespace

std::string DrawableText(const std::string& utf8) {
  static const std::array<std::pair<const char*, const char*>, 7> kLetters = {
      {{"ä", "ae"}, {"ö", "oe"}, {"ü", "ue"}, {"Ä", "Ae"}, {"Ö", "Oe"}, {"Ü", "Ue"}, {"ß", "ss"}}};
  std::string text = utf8;
  for (const auto& [letter, ascii] : kLetters) {
    for (auto at = text.find(letter); at != std::string::npos; at = text.find(letter)) {
      text.replace(at, std::string(letter).size(), ascii);
    }
  }
  for (char& c : text) {
    if (static_cast<unsigned char>(c) >= 0x80) c = '?';
  }
  return text;
}

cv::Mat DrawWithRanges(const body_model::BodyModel& model, const body_model::BodyPose& pose,
                       const range_of_motion::RangeOfMotion& range, const PictureWords& words,
                       int height_px) {
  Kinematics kinematics(model);
  body_model::BodyPose upright = pose;
  upright.frame_from_root = {};
  kinematics.Update(upright);
  cv::Mat both;
  cv::hconcat(DrawView(View::kFront, kinematics, upright, range, words, height_px),
              DrawView(View::kSide, kinematics, upright, range, words, height_px), both);
  const double scale = height_px / 1500.0;
  cv::putText(both, DrawableText(words.title), {height_px / 60, height_px / 35}, kFont, scale,
              kText, 1, cv::LINE_AA);
  return both;
}

}  // namespace deixis::anthropometer
