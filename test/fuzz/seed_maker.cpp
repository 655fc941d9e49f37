// Writes good messages for the fuzzers to start from: one of every type, and those that make sense.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "test/fuzz/good_messages.h"
#include "test/support/random_message.h"

int main(int argc, char** argv) {
  const std::string word = argc == 2 ? argv[1] : "";
  if (word.empty() || word.front() == '-') {
    std::cerr << "usage: seed_maker FOLDER\nWrites a good message of every type, a file each.\n";
    return word == "-h" || word == "--help" ? 0 : 2;
  }
  std::error_code error;
  std::filesystem::create_directories(word, error);
  const auto write = [&word](const std::string& name, const std::vector<std::uint8_t>& bytes) {
    std::ofstream file(word + "/" + name, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    return file.good();
  };
  bool is_written = true;
  deixis::test::Random random(1);
  for (const auto& type : deixis::test::AllWireTypes()) {
    is_written &= write(type.name, deixis::test::RandomMessage(type.name, random));
  }
  for (const auto& message : deixis::fuzz::GoodMessages()) {
    is_written &= write(message.name, message.bytes);
  }
  if (!is_written) std::cerr << "seed_maker: cannot write to '" << word << "'\n";
  return is_written ? 0 : 1;
}
