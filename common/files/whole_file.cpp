#include "common/files/whole_file.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>

namespace deixis::files {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void Refuse(const fs::path& file, const std::string& why) {
  throw FileError(file.string() + ": cannot be written: " + why);
}

/// While it lives, requests to end wait: a program that ended in between would leave a part.
class EndDelayed {
 public:
  EndDelayed() {
    sigset_t ends;
    sigemptyset(&ends);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ends, signal);
    pthread_sigmask(SIG_BLOCK, &ends, &before_);
  }
  ~EndDelayed() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  EndDelayed(const EndDelayed&) = delete;
  EndDelayed& operator=(const EndDelayed&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace

void WriteWhole(const fs::path& file, const std::string& bytes) {
  std::error_code error;
  if (fs::is_directory(file, error)) Refuse(file, "it is a folder");
  // A name would take the place of a device, and of a link instead of what it leads to.
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) {
    Refuse(file, "it is no regular file");
  }
  const fs::path final = fs::weakly_canonical(file, error);
  if (error) Refuse(file, error.message());
  const EndDelayed until_it_is_whole;
  const fs::path unfinished = final.string() + "." + std::to_string(getpid()) + ".part";
  std::ofstream out(unfinished, std::ios::binary);
  if (!out) Refuse(file, std::strerror(errno));
  out << bytes;
  out.close();
  if (out) fs::rename(unfinished, final, error);
  if (!out || error) {
    const std::string why = error ? error.message() : "no room";
    fs::remove(unfinished, error);
    Refuse(file, why);
  }
}

}  // namespace deixis::files
