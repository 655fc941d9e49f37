// Publishes the pictures of a camera, a stream, a video file, a folder or a dimos robot, with their
// capture times and the camera's calibration.
#include "common/program/run_service.h"
#include "services/camera_driver/camera_driver_service.h"

int main(int argc, char** argv) {
  using deixis::camera_driver::CameraDriverService;
  using deixis::camera_driver::CameraDriverServiceConfig;
  return deixis::program::RunService<CameraDriverService, CameraDriverServiceConfig>(
      {"camera_driver",
       "Publishes pictures of a camera, a stream, a video file, a folder or a dimos robot."},
      argc, argv);
}
