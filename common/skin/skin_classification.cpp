#include "common/skin/skin_classification.h"

namespace deixis::skin {
namespace {

void ClassifyRow(const std::uint8_t* bgr, int width, const std::uint8_t* table,
                 std::uint8_t* probability) {
  for (int x = 0; x < width; ++x, bgr += 3) {
    const unsigned blue = static_cast<unsigned>(bgr[0] & 0xF8U) << 7U;
    const unsigned green = static_cast<unsigned>(bgr[1] & 0xF8U) << 2U;
    probability[x] = table[blue | green | static_cast<unsigned>(bgr[2] >> 3U)];
  }
}

}  // namespace

cv::Mat Classify(const cv::Mat& bgr, const SkinTable& table) {
  cv::Mat probability(bgr.size(), CV_8UC1);
  for (int y = 0; y < bgr.rows; ++y) {
    ClassifyRow(bgr.ptr<std::uint8_t>(y), bgr.cols, table.data(), probability.ptr<std::uint8_t>(y));
  }
  return probability;
}

}  // namespace deixis::skin
