#include "common/transport/receive_buffer.h"

#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <vector>

namespace deixis::transport {
namespace {

constexpr int kDefaultPort = 7667;  // LCM's own.

bool IsBoundTo(int descriptor, int port) {
  sockaddr_in address{};
  socklen_t length = sizeof(address);
  if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &length) != 0) return false;
  return address.sin_family == AF_INET && ntohs(address.sin_port) == port;
}

// The kernel reports twice what it grants: the other half is for its own bookkeeping.
int GrantedTo(int descriptor) {
  int bytes = 0;
  socklen_t length = sizeof(bytes);
  if (getsockopt(descriptor, SOL_SOCKET, SO_RCVBUF, &bytes, &length) != 0) return 0;
  return bytes / 2;
}

std::int64_t DroppedBy(int descriptor) {
  std::array<std::uint32_t, SK_MEMINFO_VARS> facts{};
  socklen_t length = sizeof(facts);
  if (getsockopt(descriptor, SOL_SOCKET, SO_MEMINFO, facts.data(), &length) != 0) return 0;
  return facts[SK_MEMINFO_DROPS];
}

std::vector<int> SocketsOn(const std::string& network) {
  const auto colon = network.rfind(':');
  const int port =
      colon == std::string::npos ? kDefaultPort : std::atoi(network.c_str() + colon + 1);
  std::error_code ignored;
  std::vector<int> sockets;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", ignored)) {
    const int descriptor = std::atoi(entry.path().filename().c_str());
    if (IsBoundTo(descriptor, port)) sockets.push_back(descriptor);
  }
  return sockets;
}

}  // namespace

int GrantedReceiveBuffer(const std::string& network) {
  int largest = 0;
  for (const int socket : SocketsOn(network)) largest = std::max(largest, GrantedTo(socket));
  return largest;
}

std::int64_t DroppedByKernel(const std::string& network) {
  std::int64_t dropped = 0;
  for (const int socket : SocketsOn(network)) dropped += DroppedBy(socket);
  return dropped;
}

int ExpectedReceiveBuffer(int asked) {
  int most = asked;
  std::ifstream("/proc/sys/net/core/rmem_max") >> most;
  return std::min(asked, most);
}

}  // namespace deixis::transport
