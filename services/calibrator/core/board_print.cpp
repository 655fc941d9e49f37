#include "services/calibrator/core/board_print.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "common/text/size_text.h"

namespace deixis::calibrator {
namespace {

constexpr double kPointsPerMetre = 72.0 / 0.0254;
constexpr double kPngDotsPerMetre = 11811.0;  // 300 dpi.
const cv::Size2d kA4{0.210, 0.297};
constexpr double kMargin_m = 0.008;
constexpr double kCaption_m = 0.008;

std::string Millimetres(double metres) {
  std::ostringstream text;
  text << std::round(metres * 1e5) / 100.0 << " mm";
  return text.str();
}

cv::Size2d PageFor(cv::Size2d board) {
  const cv::Size2d needed(board.width + 2 * kMargin_m, board.height + 2 * kMargin_m + kCaption_m);
  for (const cv::Size2d page : {kA4, cv::Size2d(kA4.height, kA4.width)}) {
    if (needed.width <= page.width && needed.height <= page.height) return page;
  }
  return needed;
}

std::string PageContent(const BoardLayout& layout, const std::string& caption, cv::Size2d page) {
  const double left = 0.5 * (page.width - layout.size_m.width);
  const double top = 0.5 * (page.height - layout.size_m.height - kCaption_m);
  std::ostringstream content;
  content.precision(9);
  for (const cv::Rect2d& black : layout.black_m) {
    content << (left + black.x) * kPointsPerMetre << ' '
            << (page.height - top - black.y - black.height) * kPointsPerMetre << ' '
            << black.width * kPointsPerMetre << ' ' << black.height * kPointsPerMetre << " re\n";
  }
  content << "f\nBT /F1 8 Tf " << kMargin_m * kPointsPerMetre << ' ' << kMargin_m * kPointsPerMetre
          << " Td (" << caption << ") Tj ET\n";
  return content.str();
}

/// A PDF file of `objects`, the first one being the catalogue.
std::string PdfOf(const std::vector<std::string>& objects) {
  std::string pdf = "%PDF-1.4\n";
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    places.push_back(pdf.size());
    pdf += std::to_string(i + 1) + " 0 obj\n" + objects[i] + "\nendobj\n";
  }
  const std::size_t table = pdf.size();
  const std::string count = std::to_string(objects.size() + 1);
  pdf += "xref\n0 " + count + "\n0000000000 65535 f \n";
  for (const std::size_t place : places) {
    const std::string digits = std::to_string(place);
    pdf += std::string(10 - digits.size(), '0') + digits + " 00000 n \n";
  }
  return pdf + "trailer\n<< /Size " + count + " /Root 1 0 R >>\nstartxref\n" +
         std::to_string(table) + "\n%%EOF\n";
}

/// Below the board, as wide as the page allows.
void WriteCaption(cv::Mat& page, const std::string& caption) {
  constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
  const int width_px = cv::getTextSize(caption, kFont, 1.0, 2, nullptr).width;
  const double scale = 0.94 * page.cols / width_px;
  cv::putText(page, caption, {page.cols * 3 / 100, page.rows - page.cols / 80}, kFont, scale, 0, 2,
              cv::LINE_AA);
}

/// CRC-32 as PNG has it.
std::uint32_t Crc(const std::vector<std::uint8_t>& bytes) {
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xEDB88320u : 0u);
  }
  return ~crc;
}

void Append(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) {
    bytes.push_back(static_cast<std::uint8_t>(value >> shift));
  }
}

/// The chunk of a PNG file that states its resolution.
std::vector<std::uint8_t> ResolutionChunk(double dots_per_m) {
  const auto dots = static_cast<std::uint32_t>(std::lround(dots_per_m));
  std::vector<std::uint8_t> content{'p', 'H', 'Y', 's'};
  Append(content, dots);
  Append(content, dots);
  content.push_back(1);  // The unit is the metre.
  std::vector<std::uint8_t> chunk;
  Append(chunk, static_cast<std::uint32_t>(content.size() - 4));
  chunk.insert(chunk.end(), content.begin(), content.end());
  Append(chunk, Crc(content));
  return chunk;
}

}  // namespace

std::string BoardCaption(const BoardConfig& config, const BoardLayout& layout) {
  std::ostringstream text;
  const std::string count = text::SizeText(config.count.width, config.count.height);
  if (config.kind == BoardKind::kChessboard) {
    text << "--board " << count << " --square " << config.square_m;
  } else {
    text << "--charuco " << count << " --square " << config.square_m << " --marker "
         << config.marker_m << " --dictionary " << config.dictionary;
  }
  text << "   Print at 100 %. All squares across: " << Millimetres(layout.size_m.width)
       << "; measure it.";
  return text.str();
}

cv::Mat DrawBoard(const BoardLayout& layout, double px_per_m) {
  const double margin_px = layout.square_m * px_per_m;
  const auto pixel = [px_per_m, margin_px](double metres) {
    return static_cast<int>(std::lround(metres * px_per_m + margin_px));
  };
  cv::Mat drawn(pixel(layout.size_m.height + layout.square_m),
                pixel(layout.size_m.width + layout.square_m), CV_8UC1, cv::Scalar(255));
  for (const cv::Rect2d& black : layout.black_m) {
    const cv::Point from(pixel(black.x), pixel(black.y));
    const cv::Point to(pixel(black.x + black.width), pixel(black.y + black.height));
    drawn(cv::Rect(from, to)).setTo(0);
  }
  return drawn;
}

std::string BoardPdf(const BoardLayout& layout, const std::string& caption) {
  const cv::Size2d page = PageFor(layout.size_m);
  const std::string content = PageContent(layout, caption, page);
  std::ostringstream box;
  box << "[0 0 " << page.width * kPointsPerMetre << ' ' << page.height * kPointsPerMetre << "]";
  return PdfOf(
      {"<< /Type /Catalog /Pages 2 0 R /ViewerPreferences << /PrintScaling /None >> >>",
       "<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
       "<< /Type /Page /Parent 2 0 R /MediaBox " + box.str() +
           " /Contents 4 0 R /Resources << /Font << /F1 5 0 R >> >> >>",
       "<< /Length " + std::to_string(content.size()) + " >>\nstream\n" + content + "endstream",
       "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>"});
}

std::vector<std::uint8_t> BoardPng(const BoardLayout& layout, const std::string& caption) {
  cv::Mat page = DrawBoard(layout, kPngDotsPerMetre);
  WriteCaption(page, caption);
  std::vector<std::uint8_t> png;
  cv::imencode(".png", page, png);
  constexpr std::ptrdiff_t kAfterHeader = 8 + 25;  // Signature and IHDR.
  const auto chunk = ResolutionChunk(kPngDotsPerMetre);
  png.insert(png.begin() + kAfterHeader, chunk.begin(), chunk.end());
  return png;
}

}  // namespace deixis::calibrator
