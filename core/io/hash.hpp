// One hash over named datasets, the same on every machine: XXH3-128 over canonical bytes, never over files.
//
// A dataset's bytes are its values in order: doubles and integers as 8 little-endian bytes, every NaN as the one quiet
// NaN 0x7ff8000000000000, text as its length (8 bytes) and its UTF-8 bytes. The whole is the hash over the datasets in
// the order of their names: length of the name, name, count of values, digest. So values may arrive in blocks and
// datasets in any order, and -0 differs from 0.
#pragma once

#include <xxhash.h>

#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace xpr {

/// The values of one dataset, in order.
class DatasetHash {
 public:
  DatasetHash() { XXH3_128bits_reset(state_.get()); }

  void add(double value) {
    add_word(value == value ? std::bit_cast<std::uint64_t>(value) : 0x7ff8000000000000ULL);
    ++count_;
  }
  void add(std::int64_t value) {
    add_word(std::bit_cast<std::uint64_t>(value));
    ++count_;
  }
  void add(std::string_view value) {
    add_word(value.size());
    XXH3_128bits_update(state_.get(), value.data(), value.size());
    ++count_;
  }
  template <class T>
  void add(std::span<const T> values) {
    for (const T& value : values) add(value);
  }

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] std::array<unsigned char, 16> digest() const {
    XXH128_canonical_t bytes;
    XXH128_canonicalFromHash(&bytes, XXH3_128bits_digest(state_.get()));
    return std::to_array(bytes.digest);
  }

 private:
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };

  void add_word(std::uint64_t word) {
    std::array<unsigned char, 8> bytes;
    for (std::size_t k = 0; k < 8; ++k) bytes[k] = static_cast<unsigned char>(word >> (8 * k));
    XXH3_128bits_update(state_.get(), bytes.data(), bytes.size());
  }

  std::unique_ptr<XXH3_state_t, Free> state_{XXH3_createState()};
  std::uint64_t count_ = 0;
};

/// Named datasets together.
class CanonicalHash {
 public:
  /// The dataset of that name, empty at first: add values to it.
  [[nodiscard]] DatasetHash& dataset(const std::string& name) { return datasets_[name]; }

  /// 32 hexadecimal digits.
  [[nodiscard]] std::string hex() const {
    DatasetHash whole;
    for (const auto& [name, dataset] : datasets_) {
      const auto digest = dataset.digest();
      whole.add(std::string_view(name));
      whole.add(static_cast<std::int64_t>(dataset.count()));
      whole.add(std::string_view(reinterpret_cast<const char*>(digest.data()), digest.size()));
    }
    std::string out;
    for (const unsigned char byte : whole.digest()) {
      constexpr std::string_view digits = "0123456789abcdef";
      out += digits[byte >> 4];
      out += digits[byte & 15];
    }
    return out;
  }

 private:
  std::map<std::string, DatasetHash> datasets_;
};

}  // namespace xpr
