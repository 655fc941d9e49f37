// Preloaded (LD_PRELOAD), it sets a program's wall clock back by an hour as soon as the file that
// DEIXIS_CLOCK_SET_BACK names exists. Other clocks go on.
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>

namespace {

constexpr time_t kBack_s = 3600;

bool IsSetBack() {
  static const char* const file = std::getenv("DEIXIS_CLOCK_SET_BACK");
  static bool is_set_back = false;
  if (!is_set_back) is_set_back = file != nullptr && access(file, F_OK) == 0;
  return is_set_back;
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* time) {
  const auto result = syscall(SYS_clock_gettime, clock, time);
  if (result == 0 && clock == CLOCK_REALTIME && IsSetBack()) time->tv_sec -= kBack_s;
  return static_cast<int>(result);
}
