#include "common/capture/quiet_opencv.h"

#include <opencv2/core/utils/logger.hpp>

namespace deixis::capture {

void KeepOpenCvQuiet() { cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT); }

}  // namespace deixis::capture
