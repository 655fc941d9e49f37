// Floods one channel of a bus with messages of one kind, as fast as can be or at a given rate, and
// says how many it sent. See README.md.
#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <thread>

#include "common/messages/hands.h"
#include "common/messages/image.h"
#include "common/messages/objects.h"
#include "common/messages/stereo_pair.h"
#include "common/transport/bus.h"

namespace {

using namespace deixis;
using Clock = std::chrono::steady_clock;
using Send = void (*)(transport::Bus&, const std::string&, std::int64_t time_us);

constexpr std::int64_t kStep_us = 20;

void SendGarbage(transport::Bus& bus, const std::string& channel, std::int64_t time_us) {
  static const std::vector<std::uint8_t> garbage(64, 0xAB);
  bus.PublishRaw(channel, {garbage.data(), garbage.size()}, {time_us});
}

void SendHands(transport::Bus& bus, const std::string& channel, std::int64_t time_us) {
  scene::Hands hands{{time_us}, "CAMERA", "", {}};
  hands.hands.resize(2);
  hands.hands[0].id = 1;
  hands.hands[1].id = 2;
  bus.Publish(channel, hands);
}

void SendObjects(transport::Bus& bus, const std::string& channel, std::int64_t time_us) {
  scene::Objects objects{};
  objects.time = {time_us};
  objects.camera = "CAMERA";
  bus.Publish(channel, objects);
}

// 1280 x 960 pixels of noise, which JPEG makes about a megabyte of.
images::EncodedImage LargePicture() {
  cv::Mat noise(960, 1280, CV_8UC3);
  cv::theRNG().state = 7;
  cv::randu(noise, cv::Scalar::all(0), cv::Scalar::all(255));
  images::EncodedImage picture{{0}, "CAMERA", noise.cols, noise.rows, {}};
  cv::imencode(".jpg", noise, picture.jpeg);
  return picture;
}

void SendPicture(transport::Bus& bus, const std::string& channel, std::int64_t time_us) {
  static images::EncodedImage picture = LargePicture();
  picture.time = {time_us};
  bus.Publish(channel, picture);
}

void SendPair(transport::Bus& bus, const std::string& channel, std::int64_t time_us) {
  static const images::EncodedImage picture = LargePicture();
  static images::EncodedStereoPair pair{picture, picture};
  pair.left.time = pair.right.time = {time_us};
  bus.Publish(channel, pair);
}

const std::map<std::string, Send> kKinds{{"garbage", SendGarbage},
                                         {"hands", SendHands},
                                         {"objects", SendObjects},
                                         {"pair", SendPair},
                                         {"picture", SendPicture}};

std::int64_t Flood(transport::Bus& bus, const std::string& channel, Send send, double seconds,
                   double most_per_s) {
  const Clock::time_point start = Clock::now();
  const auto elapsed_s = [start] {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  std::int64_t sent = 0;
  for (double now_s = 0.0; now_s < seconds; now_s = elapsed_s()) {
    if (most_per_s > 0.0 && static_cast<double>(sent) >= most_per_s * now_s) {
      std::this_thread::yield();
      continue;
    }
    send(bus, channel, kStep_us * ++sent);
  }
  return sent;
}

}  // namespace

int main(int argc, char** argv) {
  const auto kind = argc > 3 ? kKinds.find(argv[3]) : kKinds.end();
  if (argc < 5 || argc > 6 || kind == kKinds.end()) {
    std::cerr << "flood URL CHANNEL garbage|hands|objects|pair|picture SECONDS [MOST_PER_S]\n";
    return 2;
  }
  try {
    transport::BusOptions options;
    options.url = argv[1];
    transport::Bus bus(options);
    const double most_per_s = argc > 5 ? std::stod(argv[5]) : 0.0;
    std::cout << Flood(bus, argv[2], kind->second, std::stod(argv[4]), most_per_s) << '\n';
  } catch (const std::exception& error) {
    std::cerr << "flood: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
