#include "common/program/run_service.h"
#include "services/hand_tracker/hand_tracker_service.h"

int main(int argc, char** argv) {
  return deixis::program::RunService<deixis::hand_tracker::HandTrackerService,
                                     deixis::hand_tracker::HandTrackerServiceConfig>(
      {"hand_tracker", "Tracks the hands of people in pictures by skin colour and motion."}, argc,
      argv);
}
