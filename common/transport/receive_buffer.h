#pragma once
#include <cstdint>
#include <string>

namespace deixis::transport {

/// Receive buffer that the kernel granted to this process's LCM socket on `network` ("group:port"),
/// bytes; 0 when there is no such socket. liblcm does not tell, so the process's own sockets are
/// asked.
int GrantedReceiveBuffer(const std::string& network);

/// Datagrams that the kernel dropped since the buffer of this process's LCM socket on `network` was
/// full, or for another reason after they had arrived; 0 when the kernel does not tell (Linux
/// before 4.12). One message is one datagram per 65 kB.
std::int64_t DroppedByKernel(const std::string& network);

/// Most that the kernel grants to a subscriber that asks for `asked` bytes (net.core.rmem_max).
int ExpectedReceiveBuffer(int asked);

}  // namespace deixis::transport
