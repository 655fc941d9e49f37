#pragma once
// For the .cpp files of this folder only: bytes to generated LCM types and back, and the checks
// that every message gets.
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "common/messages/codec.h"
#include "common/messages/wire_check.h"
#include "common/text/utf8.h"

namespace deixis::messages {

/// Bounds by meaning: more of these is no honest message.
inline constexpr std::int32_t kMostObjects = 4096;
inline constexpr std::int32_t kMostHands = 256;
inline constexpr std::int32_t kMostBodies = 256;
inline constexpr std::int32_t kMostCandidates = 4096;
inline constexpr std::int32_t kMostChannels = 1024;
inline constexpr std::int32_t kMostReasons = 256;
inline constexpr std::int32_t kMostDistortion = 14;
inline constexpr std::size_t kLongestText = 1024;  ///< Bytes.
/// Of a coordinate, size or speed in the image: far beyond any picture, yet safe as an int.
inline constexpr double kFarthest_px = 1e6;
/// Of a coordinate, size or speed in space, metres (per second): safe to square and add up.
inline constexpr double kFarthest_m = 1e6;
/// Of times and sequence numbers: their differences cannot overflow (year 38,500).
inline constexpr std::int64_t kLargestCount = std::int64_t{1} << 60;

/// The type's fingerprint at the head of an encoded message.
inline std::int64_t Fingerprint(Bytes bytes) {
  if (bytes.size < 8) throw Rejected("truncated");
  std::uint64_t value = 0;
  for (int i = 0; i < 8; ++i) value = value << 8 | bytes.data[i];
  return static_cast<std::int64_t>(value);
}

/// Decodes the whole of `bytes` as a Message, or throws Rejected. The only caller of the generated
/// decode(), which believes every length that it reads.
template <typename Message>
Message DecodeWire(Bytes bytes) {
  if (Fingerprint(bytes) != Message::getHash()) throw Rejected("wrong_type");
  const WireFault fault = CheckWire(bytes);
  if (fault != WireFault::kNone) throw Rejected(Reason(fault));
  Message message{};
  const int size = static_cast<int>(bytes.size);
  if (message.decode(bytes.data, 0, size) != size) {
    throw std::logic_error(
        "a message that passed the check of its bytes does not decode from them");
  }
  return message;
}

template <typename Message>
std::vector<std::uint8_t> EncodeWire(const Message& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  if (message.encode(bytes.data(), 0, static_cast<int>(bytes.size())) < 0) {
    throw std::logic_error("message does not encode into its own size");
  }
  return bytes;
}

inline void RequireCount(std::int64_t count, std::int64_t most) {
  if (count < 0 || count > most) throw Rejected("too_many");
}

inline double Finite(double value) {
  if (!std::isfinite(value)) throw Rejected("not_finite");
  return value;
}

/// A time in microseconds, or a sequence number.
inline std::int64_t Count(std::int64_t value) {
  if (value < 0 || value > kLargestCount) throw Rejected("out_of_range");
  return value;
}

/// A name, label or sentence. Results repeat them, so what came in must be fit to go out.
inline const std::string& Text(const std::string& sent) {
  if (sent.size() > kLongestText) throw Rejected("text_too_long");
  if (!text::IsUtf8(sent)) throw Rejected("bad_string");
  return sent;
}

/// Going out: a sentence that grew too long, cut between two characters (UTF-8) and marked.
inline std::string Shortened(const std::string& text) {
  constexpr const char* kMark = " ...";
  if (text.size() <= kLongestText) return text;
  std::size_t end = kLongestText - std::char_traits<char>::length(kMark);
  while (end > 0 && (text[end] & 0xC0) == 0x80) --end;
  return text.substr(0, end) + kMark;
}

inline Timestamp ToTimestamp(std::int64_t utime) { return {Count(utime)}; }

/// A number as an enumeration whose last value is `last`.
template <typename Enum>
Enum Enumeration(std::int8_t value, Enum last) {
  if (value < 0 || value > static_cast<std::int8_t>(last)) throw Rejected("out_of_range");
  return static_cast<Enum>(value);
}

template <typename Enum>
std::int8_t Number(Enum value) {
  return static_cast<std::int8_t>(value);
}

inline double Within(double value, double largest) {
  if (std::abs(Finite(value)) > largest) throw Rejected("out_of_range");
  return value;
}

/// A size or variance.
inline double NotNegative(double value, double largest) {
  if (Within(value, largest) < 0.0) throw Rejected("out_of_range");
  return value;
}

/// An id, or a number of things that follow nowhere.
inline std::int32_t AtLeast(std::int32_t least, std::int32_t value) {
  if (value < least) throw Rejected("out_of_range");
  return value;
}

/// A length or coordinate in the image.
inline double Pixels(double value) { return Within(value, kFarthest_px); }

template <int N>
Eigen::Matrix<double, N, 1> ToVector(const double (&values)[N], double largest = kFarthest_m) {
  Eigen::Matrix<double, N, 1> vector;
  for (int i = 0; i < N; ++i) vector[i] = Within(values[i], largest);
  return vector;
}

template <int N>
Eigen::Matrix<double, N, 1> ToPixels(const double (&values)[N]) {
  return ToVector<N>(values, kFarthest_px);
}

template <int N>
Eigen::Matrix<double, N, 1> ToMetres(const double (&values)[N]) {
  return ToVector<N>(values, kFarthest_m);
}

/// Going out: a number that is not finite is our own bug.
template <typename Derived, int N>
void FromVector(const Eigen::MatrixBase<Derived>& vector, double (&values)[N]) {
  if (!vector.allFinite()) throw std::logic_error("a value to be published is not finite");
  for (int i = 0; i < N; ++i) values[i] = vector[i];
}

/// Covariance of N values that are no larger than `largest`, from its lower triangle, row by row.
template <int N, int M>
Eigen::Matrix<double, N, N> ToCovariance(const double (&triangle)[M], double largest) {
  static_assert(M == N * (N + 1) / 2);
  Eigen::Matrix<double, N, N> matrix;
  for (int row = 0, i = 0; row < N; ++row) {
    for (int column = 0; column <= row; ++column, ++i) {
      matrix(row, column) = matrix(column, row) = Within(triangle[i], largest * largest);
    }
  }
  if (matrix.diagonal().minCoeff() < 0.0) throw Rejected("out_of_range");
  return matrix;
}

template <int N, int M>
void FromSymmetric(const Eigen::Matrix<double, N, N>& matrix, double (&triangle)[M]) {
  static_assert(M == N * (N + 1) / 2);
  if (!matrix.allFinite()) throw std::logic_error("a covariance to be published is not finite");
  for (int row = 0, i = 0; row < N; ++row) {
    for (int column = 0; column <= row; ++column, ++i) triangle[i] = matrix(row, column);
  }
}

inline double Outgoing(double value) {
  if (!std::isfinite(value)) throw std::logic_error("a value to be published is not finite");
  return value;
}

/// A probability or score.
inline double Probability(double value) {
  if (!(value >= 0.0 && value <= 1.0))
    throw Rejected(std::isfinite(value) ? "out_of_range" : "not_finite");
  return value;
}

}  // namespace deixis::messages
