// Recognises pointing gestures from hand tracks and objects, and names the object that is meant.
#include "common/program/run_service.h"
#include "services/gesture_recogniser/gesture_recogniser_service.h"

int main(int argc, char** argv) {
  using deixis::gesture_recogniser::GestureRecogniserService;
  using deixis::gesture_recogniser::GestureRecogniserServiceConfig;
  return deixis::program::RunService<GestureRecogniserService, GestureRecogniserServiceConfig>(
      {"gesture_recogniser", "Recognises pointing gestures and the objects that they mean."}, argc,
      argv);
}
