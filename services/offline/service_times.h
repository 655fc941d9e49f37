#pragma once
#include <cstdint>
#include <fstream>
#include <string>

namespace deixis::offline {

/// Writes what each service spends on each message: CPU time of all threads, microseconds, a line
/// of `service,channel,time_us,cpu_us` (channel on the wire, log time of the input) each. Times
/// below a microsecond, those of messages that a service does not hear, are left out.
class ServiceTimes {
 public:
  explicit ServiceTimes(const std::string& file);  ///< Throws BusError when it cannot be written.

  /// From here on the next service works.
  void Begin();
  /// `service` has dealt with a message, and the next one begins.
  void Note(const std::string& service, const std::string& channel, std::int64_t time_us);
  void Flush();  ///< Throws BusError when the disk is full.

 private:
  std::string path_;
  std::ofstream file_;
  std::int64_t began_ns_ = 0;
};

}  // namespace deixis::offline
