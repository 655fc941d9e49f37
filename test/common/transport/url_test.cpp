#include "common/transport/url.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>

#include "common/transport/bus.h"
#include "common/transport/channel_name.h"
#include "common/transport/receive_buffer.h"
#include "common/transport/sample_window.h"

namespace deixis::transport {
namespace {

TEST(ChannelFaults, NamesTheKeysOfWhatIsNoChannelAndOfASecondUse) {
  using Pairs = std::vector<std::pair<std::string, std::string>>;
  EXPECT_TRUE(ChannelFaults({{"in", "CAMERA"}, {"out", "OBJECTS"}}).empty());
  EXPECT_EQ(ChannelFaults({{"in", "CAMERA"}, {"out", "CAMERA"}}),
            (Pairs{{"out", "must be another channel than in"}}));
  EXPECT_EQ(ChannelFaults({{"in", ""}, {"out", "A B"}}),
            (Pairs{{"in", kChannelNameRule}, {"out", kChannelNameRule}}));
}

TEST(Url, GetsAReceiveBufferWhereNoneIsStated) {
  EXPECT_EQ(ResolveUrl("udpm://239.255.1.1:7000?ttl=0", 1000).text,
            "udpm://239.255.1.1:7000?ttl=0&recv_buf_size=1000");
  EXPECT_EQ(ResolveUrl("udpm://239.255.1.1:7000", 1000).text,
            "udpm://239.255.1.1:7000?recv_buf_size=1000");
}

TEST(Url, AsksForNoLargerReceiveBufferThanTheKernelGrants) {
  const int granted = ExpectedReceiveBuffer(1 << 30);
  EXPECT_EQ(ResolveUrl("udpm://239.255.1.1:7000", 1 << 30).option("recv_buf_size"),
            std::to_string(granted));
}

TEST(Url, KeepsAStatedReceiveBuffer) {
  const std::string text = "udpm://239.255.1.1:7000?recv_buf_size=5&ttl=1";
  EXPECT_EQ(ResolveUrl(text, 1000).text, text);
}

TEST(Url, LeavesOtherProvidersAlone) {
  EXPECT_EQ(ResolveUrl("memq://", 1000).text, "memq://");
  const Url log = ResolveUrl("file:///tmp/a.lcmlog?mode=w", 1000);
  EXPECT_EQ(log.network, "/tmp/a.lcmlog");
  EXPECT_EQ(log.option("mode"), "w");
  EXPECT_EQ(log.option("speed"), "");
}

TEST(Url, ComesFromTheEnvironmentWhereNoneIsGiven) {
  setenv("LCM_DEFAULT_URL", "memq://", 1);
  EXPECT_EQ(ResolveUrl("", 1000).provider, "memq");
  unsetenv("LCM_DEFAULT_URL");
  EXPECT_EQ(ResolveUrl("", 1000).network, "239.255.76.67:7667");
}

TEST(Url, WithoutProviderIsAnError) {
  EXPECT_THROW(ResolveUrl("239.255.1.1:7000", 1000), BusError);
}

TEST(Url, WithAKeyGivenTwiceIsAnError) {
  EXPECT_THROW(ResolveUrl("udpm://239.255.1.1:7000?ttl=0&ttl=1", 1000), BusError);
  EXPECT_THROW(ResolveUrl("file:///tmp/x?mode=r&speed=1&mode=w", 1000), BusError);
  EXPECT_NO_THROW(ResolveUrl("udpm://239.255.1.1:7000?ttl=0&recv_buf_size=5", 1000));
}

TEST(Url, WithNumbersThatLcmWouldMisreadNamesThem) {
  using testing::HasSubstr;
  const auto resolving = [](const std::string& rest) {
    return [rest] { ResolveUrl("udpm://239.255.1.1" + rest, 1000); };
  };
  for (const std::string port : {":0", ":65536", ":-7", ":7667x", ":", ":99999999999999999999"}) {
    EXPECT_THAT(resolving(port), testing::ThrowsMessage<BusError>(HasSubstr("the port must be")))
        << port;
  }
  EXPECT_THAT(resolving(":7000?ttl=256"), testing::ThrowsMessage<BusError>(HasSubstr("ttl must")));
  for (const std::string size : {"-1", "0", "4M", "2147483648"}) {
    EXPECT_THAT(resolving(":7000?recv_buf_size=" + size),
                testing::ThrowsMessage<BusError>(HasSubstr("recv_buf_size must")))
        << size;
  }
  EXPECT_THAT(resolving(""), testing::ThrowsMessage<BusError>(HasSubstr("has no port")));
  EXPECT_NO_THROW(resolving(":65535?ttl=255&recv_buf_size=2147483647")());
}

TEST(Url, WithAKeyButNoValueIsAnError) {
  for (const std::string text : {"udpm://239.255.1.1:7000?recv_buf_size=", "udpm://?ttl=&x=1",
                                 "udpm://?ttl", "file:///tmp/x?mode="}) {
    EXPECT_THAT([&] { ResolveUrl(text, 1000); },
                testing::ThrowsMessage<BusError>(testing::HasSubstr("no value")))
        << text;
  }
}

TEST(Url, OfUdpmNeedsAMulticastGroup) {
  for (const std::string text :
       {"udpm://10.0.0.1:7691", "udpm://localhost:7667", "udpm://240.0.0.1", "udpm://:7667"}) {
    EXPECT_THAT([&] { ResolveUrl(text, 1000); },
                testing::ThrowsMessage<BusError>(testing::HasSubstr("no multicast group")))
        << text;
  }
  EXPECT_NO_THROW(ResolveUrl("udpm://", 1000));
}

TEST(Url, OfTcpqNeedsAPortToo) {
  EXPECT_THAT([] { ResolveUrl("tcpq://127.0.0.1:99999", 1000); },
              testing::ThrowsMessage<BusError>(testing::HasSubstr("the port must be")));
  EXPECT_NO_THROW(ResolveUrl("tcpq://127.0.0.1:7700", 1000));
}

TEST(Url, IsTakenOrRefusedAsTheFrontEndDoes) {
  std::ifstream table(DEIXIS_SOURCE_DIR "/test/common/transport/lcm_urls.txt");
  int urls = 0;
  for (std::string verdict, url; table >> verdict >> url; ++urls) {
    if (verdict == "takes") {
      EXPECT_NO_THROW(ResolveUrl(url, 1000)) << url;
    } else {
      EXPECT_THROW(ResolveUrl(url, 1000), BusError) << url;
    }
  }
  EXPECT_GT(urls, 20);
}

TEST(Url, OfAnUnknownProviderIsAnErrorWhenOpened) {
  BusOptions options;
  options.url = "carrier_pigeon://";
  EXPECT_THROW(Bus{options}, BusError);
}

TEST(SampleWindow, SummarisesTheLatestValues) {
  SampleWindow window;
  EXPECT_EQ(window.Summarise().p50, -1.0);
  for (int i = 0; i <= 1000; ++i) window.Add(i < 489 ? 1e6 : i);
  EXPECT_NEAR(window.Summarise().p50, 745.0, 1.0);
  EXPECT_NEAR(window.Summarise().p99, 995.0, 1.0);
}

}  // namespace
}  // namespace deixis::transport
