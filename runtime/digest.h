#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

struct evp_md_ctx_st;  // OpenSSL's.

namespace nacre {

/// SHA-256 of something (FIPS 180-4): nobody can make two things that have the same, so it
/// may stand for the thing.
using Digest = std::array<std::uint8_t, 32>;

Digest sha256(std::string_view bytes);

/// The same of what comes in pieces.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(std::string_view piece);
  /// Of all pieces together; nothing may be added after it.
  Digest finish();

 private:
  evp_md_ctx_st* context_;
};

/// HMAC-SHA-256 (FIPS 198-1) over the parts put together: only who has the key can make it.
Digest hmac_sha256(std::string_view key, std::initializer_list<std::string_view> parts);

/// Whether two digests are equal, in a time that does not tell where they differ.
bool equal_in_constant_time(const Digest& a, const Digest& b);

/// 64 hexadecimal digits.
std::string to_hex(const Digest& digest);

}  // namespace nacre
