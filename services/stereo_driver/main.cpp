// Publishes rectified pictures with the depth of the same view, from two cameras, recordings, a
// depth camera, or pairs that others publish.
#include "common/program/run_service.h"
#include "services/stereo_driver/stereo_driver_service.h"

int main(int argc, char** argv) {
  using deixis::stereo_driver::StereoDriverService;
  using deixis::stereo_driver::StereoDriverServiceConfig;
  return deixis::program::RunService<StereoDriverService, StereoDriverServiceConfig>(
      {"stereo_driver", "Publishes pictures with depth of stereo and depth cameras."}, argc, argv);
}
