#pragma once
// For the .cpp files of this folder only: pictures inside messages.
#include <bot_core/image_t.hpp>
#include <bot_core/images_t.hpp>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "common/images/encoded_image.h"
#include "common/images/image.h"
#include "common/messages/codec.h"

namespace deixis::messages {

/// Throws Rejected("bad_image_size" or "too_large") unless it is a size that a picture may have.
void RequirePictureSize(std::int64_t width_px, std::int64_t height_px);

/// CV_8UC3, blue green red; what CheckJpeg refuses is not decoded.
cv::Mat DecodeJpeg(const std::vector<std::uint8_t>& jpeg, cv::Size size);

/// Pixels as they lie in a message, `type` being OpenCV's, `stride` bytes from row to row (0 = no
/// gaps). A view: valid as long as `data`.
cv::Mat RawPixels(const std::vector<std::uint8_t>& data, cv::Size size, int type,
                  std::int64_t stride);

/// `raw` by one of OpenCV's colour conversions, as a picture of its own.
cv::Mat Converted(const cv::Mat& raw, int code);

/// Any picture that a camera sends: MJPEG, BGR, RGB, grey, YUYV.
images::Image ToImage(const bot_core::image_t& message);

/// A picture as raw BGR.
bot_core::image_t FromImage(const images::Image& image, std::int64_t sequence);

/// A picture as a JPEG file; others are rejected.
images::EncodedImage ToEncodedImage(bot_core::image_t message);
bot_core::image_t FromEncodedImage(const images::EncodedImage& image, std::int64_t sequence);

/// An empty picture with its time, size, camera name and sequence number.
bot_core::image_t FramedImage(Timestamp time, const std::string& camera, cv::Size size,
                              std::int64_t sequence);

/// Number among its publisher's pictures, from the metadata; -1 = none.
std::int64_t SequenceOf(const bot_core::image_t& message);

/// The first image of that role (an images_t constant), or nullptr.
const bot_core::image_t* FindImage(const bot_core::images_t& message, std::int16_t role);
/// The same; throws Rejected(`reason`) when there is none.
const bot_core::image_t& RequireImage(const bot_core::images_t& message, std::int16_t role,
                                      const char* reason);

}  // namespace deixis::messages
