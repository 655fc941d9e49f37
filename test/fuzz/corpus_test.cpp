// What the fuzzers start from, and what once broke something, in every build.
#include <gtest/gtest.h>

#include <filesystem>

#include "test/fuzz/good_messages.h"
#include "test/fuzz/hosted_services.h"
#include "test/fuzz/message_sequence.h"
#include "test/support/message_properties.h"
#include "test/support/random_message.h"
#include "test/support/temporary_folder.h"

namespace deixis::fuzz {
namespace {

using Input = std::vector<std::uint8_t>;

std::vector<std::pair<std::string, Input>> Corpus(const std::string& fuzzer) {
  std::vector<std::pair<std::string, Input>> corpus;
  const std::string folder = DEIXIS_SOURCE_DIR "/test/fuzz/corpus/" + fuzzer;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    const std::string content = test::FileContent(file.path());
    corpus.emplace_back(file.path().filename(), Input(content.begin(), content.end()));
  }
  return corpus;
}

TEST(MessageCorpus, EveryInputIsRefusedOrUnderstood) {
  const auto corpus = Corpus("messages");
  ASSERT_FALSE(corpus.empty());
  for (const auto& [name, input] : corpus) {
    EXPECT_EQ(test::BrokenProperty({input.data(), input.size()}), "") << name;
  }
}

TEST(MessageCorpus, GoodMessagesAreUnderstood) {
  for (const GoodMessage& message : GoodMessages()) {
    EXPECT_TRUE(test::IsUnderstood({message.bytes.data(), message.bytes.size()})) << message.name;
  }
}

TEST(ServiceCorpus, ServicesGoOnAfterEveryInput) {
  HostedServices services;
  const auto& channels = services.channels();
  const auto corpus = Corpus("services");
  ASSERT_FALSE(corpus.empty());
  for (const auto& [name, input] : corpus) {
    for (const auto& message : ReadSequence({input.data(), input.size()})) {
      services.Send(channels[message.channel % channels.size()],
                    {message.bytes.data(), message.bytes.size()});
    }
    ASSERT_EQ(services.Complaint(), "") << name;
  }
}

TEST(ServiceCorpus, ServicesGoOnAfterRandomMessagesOfEveryTypeOnEveryChannel) {
  HostedServices services;
  test::Random random(5);
  for (const std::string& channel : services.channels()) {
    for (const auto& type : test::AllWireTypes()) {
      const Input message = test::RandomMessage(type.name, random);
      services.Send(channel, {message.data(), message.size()});
    }
    ASSERT_EQ(services.Complaint(), "") << channel;
  }
}

}  // namespace
}  // namespace deixis::fuzz
