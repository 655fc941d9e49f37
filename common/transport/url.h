#pragma once
#include <string>

namespace deixis::transport {

/// A taken-apart LCM URL: provider://network?key=value&key=value
struct Url {
  std::string text;                                  ///< The whole, ready for liblcm.
  std::string provider;                              ///< udpm, tcpq, memq, file.
  std::string network;                               ///< Address, or path of a log.
  std::string option(const std::string& key) const;  ///< Empty when absent.
};

/// The URL that is meant: `text`, else $LCM_DEFAULT_URL, else LCM's default (this host only). A
/// udpm URL without a receive buffer size gets `receive_buffer_bytes`, since with LCM's own small
/// one pictures are lost in silence; no more than the kernel grants, since liblcm would print a
/// page about the rest at every start. Throws BusError when it has no provider, gives a key twice
/// or without a value, or a port, ttl or buffer size out of range; of udpm, too, when it names no
/// multicast group, a group without a port, or a key that LCM does not know.
Url ResolveUrl(const std::string& text, int receive_buffer_bytes);

}  // namespace deixis::transport
