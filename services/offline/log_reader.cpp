#include "services/offline/log_reader.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace deixis::offline {
namespace {

// An event: sync word, number (8 bytes), time (8), length of the channel (4), of the data (4),
// channel, data; big endian.
constexpr std::array<std::uint8_t, 4> kSync{0xED, 0xA1, 0xDA, 0x01};
constexpr std::int64_t kSyncBytes = kSync.size();
constexpr std::int64_t kHeaderBytes = 28;
constexpr std::int64_t kLongestChannel = 1000;  // As liblcm has it.
constexpr std::int64_t kFirstSearch = 1 << 10;  // Doubled while nothing is found.
constexpr std::int64_t kLargestSearch = 1 << 20;

std::uint64_t BigEndian(const std::uint8_t* bytes, int count) {
  std::uint64_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | bytes[i];
  return value;
}

std::int64_t LengthFrom(const std::uint8_t* bytes) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(BigEndian(bytes, 4)));
}

}  // namespace

LogReader::LogReader(const std::string& path) : path_(path) {
  std::error_code error;
  size_ = static_cast<std::int64_t>(std::filesystem::file_size(path, error));
  if (!error) file_.open(path, std::ios::binary);
  if (error || !file_) {
    throw transport::BusError(
        "log '" + path + "' cannot be read: " + (error ? error.message() : std::strerror(errno)) +
        "; give an existing LCM log");
  }
}

bool LogReader::Next() {
  while (position_ < size_) {
    const auto header = HeaderAt(position_);
    if (!header || !MayEndAt(position_ + header->end())) {
      PassOverDamage();
    } else if (header->channel_bytes == 0) {
      ++nameless_events_;
      position_ += header->end();
    } else {
      Take(*header);
      return true;
    }
  }
  return false;
}

std::int64_t LogReader::Header::end() const { return kHeaderBytes + channel_bytes + data_bytes; }

std::optional<LogReader::Header> LogReader::HeaderAt(std::int64_t offset) {
  if (size_ - offset < kHeaderBytes) return std::nullopt;
  const std::vector<std::uint8_t> bytes = Read(offset, kHeaderBytes);
  if (!std::equal(kSync.begin(), kSync.end(), bytes.begin())) return std::nullopt;
  Header header;
  header.timestamp_us = static_cast<std::int64_t>(BigEndian(&bytes[12], 8));
  header.channel_bytes = LengthFrom(&bytes[20]);
  header.data_bytes = LengthFrom(&bytes[24]);
  const bool is_possible = header.channel_bytes >= 0 && header.channel_bytes <= kLongestChannel &&
                           header.data_bytes >= 0 && header.end() <= size_ - offset;
  return is_possible ? std::optional(header) : std::nullopt;
}

/// A length that was damaged leads to where no event begins.
bool LogReader::MayEndAt(std::int64_t offset) {
  const std::int64_t bytes = std::min(kSyncBytes, size_ - offset);
  const std::vector<std::uint8_t> next = Read(offset, bytes);
  return std::equal(next.begin(), next.end(), kSync.begin());
}

void LogReader::Take(const Header& header) {
  content_ = Read(position_ + kHeaderBytes, header.channel_bytes + header.data_bytes);
  const auto channel_end = content_.begin() + header.channel_bytes;
  event_ = {std::string(content_.begin(), channel_end),
            {content_.data() + header.channel_bytes, static_cast<std::size_t>(header.data_bytes)},
            header.timestamp_us};
  position_ += header.end();
}

void LogReader::PassOverDamage() {
  const std::int64_t next = FindEventFrom(position_ + 1);
  const bool goes_on =
      !damaged_.empty() && damaged_.back().offset + damaged_.back().bytes == position_;
  if (!goes_on) damaged_.push_back({position_, 0});
  damaged_.back().bytes += next - position_;
  position_ = next;
}

/// The next sync word; the end of the file when there is none.
std::int64_t LogReader::FindEventFrom(std::int64_t offset) {
  for (std::int64_t bytes = kFirstSearch; size_ - offset >= kSyncBytes;
       bytes = std::min(2 * bytes, kLargestSearch)) {
    const auto block = Read(offset, std::min(bytes, size_ - offset));
    const auto found = std::search(block.begin(), block.end(), kSync.begin(), kSync.end());
    if (found != block.end()) return offset + (found - block.begin());
    offset += static_cast<std::int64_t>(block.size()) - kSyncBytes + 1;
  }
  return size_;
}

std::vector<std::uint8_t> LogReader::Read(std::int64_t offset, std::int64_t bytes) {
  std::vector<std::uint8_t> content(static_cast<std::size_t>(bytes));
  file_.seekg(offset);
  file_.read(reinterpret_cast<char*>(content.data()), bytes);
  if (file_) return content;
  throw transport::BusError("log '" + path_ + "' cannot be read any further at byte " +
                            std::to_string(offset) + "; is another program writing it?");
}

double LogReader::progress() const {
  return size_ == 0 ? 1.0 : static_cast<double>(position_) / static_cast<double>(size_);
}

}  // namespace deixis::offline
