#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/transport/bus.h"
#include "common/transport/status_reporter.h"
#include "test/support/temporary_folder.h"

namespace deixis::fuzz {

/// Every service that listens, as shipped configurations have it, on one private bus: the drivers
/// once in each mode in which they listen.
class HostedServices {
 public:
  HostedServices();
  ~HostedServices();

  /// Channels that services listen to.
  const std::vector<std::string>& channels() const { return channels_; }

  /// Sends bytes, whatever they are, and lets all services handle them and what follows.
  void Send(const std::string& channel, messages::Bytes bytes);

  /// What is not as it must be after all that was sent, "" when nothing: a handler has failed, a
  /// good message is not answered, nor the next one, the status does not go out.
  std::string Complaint();

 private:
  class Host;
  template <typename Service, typename Config>
  void Add(const std::string& file, const std::vector<std::string>& overrides = {});
  void AddDrivers();
  void NoteNewChannels();
  void HandleAll();
  void SendGood(const std::string& name);
  std::map<std::string, std::int64_t> Published() const;
  /// Channel on which good messages, so much later, are not answered; "" = none.
  std::string FirstSilent(std::int64_t step_us);

  test::TemporaryFolder folder_;
  transport::Bus bus_;
  std::vector<std::unique_ptr<Host>> hosts_;
  std::vector<std::string> channels_;
  std::int64_t time_us_ = 1'000'000;  ///< Of the good messages.
  int statuses_ = 0;                  ///< That were heard.
};

}  // namespace deixis::fuzz
