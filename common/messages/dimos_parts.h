#pragma once
// For the .cpp files of this folder only: what dimos robots send, whose types follow those of ROS.
#include <sensor_msgs/CameraInfo.hpp>
#include <sensor_msgs/CompressedImage.hpp>
#include <sensor_msgs/Image.hpp>
#include <std_msgs/Header.hpp>

#include "common/geometry/camera_calibration.h"
#include "common/images/depth_image.h"
#include "common/images/image.h"

namespace deixis::messages {

/// The capture time to the microsecond below; throws Rejected("out_of_range") when it is none.
Timestamp ToTimestamp(const std_msgs::Time& stamp);
std_msgs::Header ToHeader(Timestamp time, const std::string& camera);

/// A colour or grey picture: raw, or a JPEG file. The frame's name becomes the camera's.
images::Image ToImage(const sensor_msgs::Image& message);

/// A JPEG file; other files are rejected.
images::Image ToImage(const sensor_msgs::CompressedImage& message);

/// Depth in whole millimetres or in metres.
images::DepthImage ToDepthImage(const sensor_msgs::Image& message);

/// A lens of the whole picture. Neither the projection nor the place of the camera is looked at.
geometry::CameraCalibration ToCameraCalibration(const sensor_msgs::CameraInfo& message);

}  // namespace deixis::messages
