// Fits an articulated body to depth images: where every limb of each person is.
#include "common/program/run_service.h"
#include "services/pose_fitter/pose_fitter_service.h"

int main(int argc, char** argv) {
  using deixis::pose_fitter::PoseFitterService;
  using deixis::pose_fitter::PoseFitterServiceConfig;
  return deixis::program::RunService<PoseFitterService, PoseFitterServiceConfig>(
      {"pose_fitter", "Fits an articulated body to depth images of people."}, argc, argv);
}
