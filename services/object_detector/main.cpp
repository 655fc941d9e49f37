// Finds faces, trained objects and fixed places in the pictures of a camera.
#include "common/program/run_service.h"
#include "services/object_detector/object_detector_service.h"

int main(int argc, char** argv) {
  using deixis::object_detector::ObjectDetectorService;
  using deixis::object_detector::ObjectDetectorServiceConfig;
  return deixis::program::RunService<ObjectDetectorService, ObjectDetectorServiceConfig>(
      {"object_detector", "Finds faces, trained objects and fixed places in pictures."}, argc,
      argv);
}
