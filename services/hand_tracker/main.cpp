// Tracks the hands of people in the pictures of a camera, by skin colour and motion.
#include "common/program/run_service.h"
#include "services/hand_tracker/hand_tracker_service.h"

int main(int argc, char** argv) {
  using deixis::hand_tracker::HandTrackerService;
  using deixis::hand_tracker::HandTrackerServiceConfig;
  return deixis::program::RunService<HandTrackerService, HandTrackerServiceConfig>(
      {"hand_tracker", "Tracks the hands of people in pictures by skin colour and motion."}, argc,
      argv);
}
