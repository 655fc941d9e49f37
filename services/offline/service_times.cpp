#include "services/offline/service_times.h"

#include <cerrno>
#include <cstring>
#include <ctime>

#include "common/transport/bus.h"

namespace deixis::offline {
namespace {

constexpr std::int64_t kNsPerUs = 1000;

std::int64_t CpuTime_ns() {
  std::timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1'000'000'000 * static_cast<std::int64_t>(time.tv_sec) + time.tv_nsec;
}

}  // namespace

ServiceTimes::ServiceTimes(const std::string& file) : path_(file), file_(file) {
  file_ << "service,channel,time_us,cpu_us\n";
  Flush();
}

void ServiceTimes::Begin() { began_ns_ = CpuTime_ns(); }

void ServiceTimes::Note(const std::string& service, const std::string& channel,
                        std::int64_t time_us) {
  const std::int64_t spent_us = (CpuTime_ns() - began_ns_) / kNsPerUs;
  if (spent_us > 0) file_ << service << ',' << channel << ',' << time_us << ',' << spent_us << '\n';
  Begin();
}

void ServiceTimes::Flush() {
  if (file_.flush()) return;
  throw transport::BusError("'" + path_ + "' cannot be written: " + std::strerror(errno) +
                            "; name another file by --times");
}

}  // namespace deixis::offline
