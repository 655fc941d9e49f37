// Draws on the camera's pictures what the other services make of them: into files, into a window.
#include "common/program/run_service.h"
#include "services/viewer/viewer_service.h"

int main(int argc, char** argv) {
  using deixis::viewer::ViewerService;
  using deixis::viewer::ViewerServiceConfig;
  return deixis::program::RunService<ViewerService, ViewerServiceConfig>(
      {"viewer", "Draws people, objects, hands and gestures on the camera's pictures."}, argc,
      argv);
}
