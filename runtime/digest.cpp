#include "runtime/digest.h"

#include <openssl/core_names.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/params.h>

#include <memory>
#include <new>

namespace nacre {

namespace {

struct Free {
  void operator()(EVP_MAC_CTX* context) const { EVP_MAC_CTX_free(context); }
};

/// What OpenSSL looks up by name, once: the look-up takes locks, which a child of fork()
/// might find held for ever. In a context of its own, because the configuration file of
/// the machine may leave out algorithms. Lives until the process ends.
struct Algorithms {
  OSSL_LIB_CTX* context = OSSL_LIB_CTX_new();
  EVP_MD* sha256 = EVP_MD_fetch(context, "SHA256", nullptr);
  EVP_MAC* hmac = EVP_MAC_fetch(context, "HMAC", nullptr);
  EVP_MAC_CTX* hmac_sha256 = [this] {
    char name[] = "SHA256";
    const OSSL_PARAM parameters[]{OSSL_PARAM_construct_utf8_string(OSSL_MAC_PARAM_DIGEST, name, 0),
                                  OSSL_PARAM_construct_end()};
    EVP_MAC_CTX* made = EVP_MAC_CTX_new(hmac);
    return made != nullptr && EVP_MAC_CTX_set_params(made, parameters) == 1 ? made : nullptr;
  }();
};

const Algorithms& algorithms() {
  static const Algorithms* const found = new Algorithms;
  return *found;
}

/// OpenSSL fails where memory is short; digests have no other way to.
void expect(bool done) {
  if (!done) throw std::bad_alloc();
}

const unsigned char* data(std::string_view bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

}  // namespace

Digest sha256(std::string_view bytes) {
  Digest digest{};
  expect(EVP_Digest(bytes.data(), bytes.size(), digest.data(), nullptr, algorithms().sha256,
                    nullptr) == 1);
  return digest;
}

Sha256::Sha256() : context_(EVP_MD_CTX_new()) {
  if (context_ != nullptr && EVP_DigestInit_ex2(context_, algorithms().sha256, nullptr) == 1)
    return;
  EVP_MD_CTX_free(context_);
  expect(false);
}

Sha256::~Sha256() { EVP_MD_CTX_free(context_); }

void Sha256::add(std::string_view piece) {
  expect(EVP_DigestUpdate(context_, piece.data(), piece.size()) == 1);
}

Digest Sha256::finish() {
  Digest digest{};
  expect(EVP_DigestFinal_ex(context_, digest.data(), nullptr) == 1);
  return digest;
}

Digest hmac_sha256(std::string_view key, std::initializer_list<std::string_view> parts) {
  expect(algorithms().hmac_sha256 != nullptr);
  const std::unique_ptr<EVP_MAC_CTX, Free> context(EVP_MAC_CTX_dup(algorithms().hmac_sha256));
  expect(context != nullptr && EVP_MAC_init(context.get(), data(key), key.size(), nullptr) == 1);
  for (const std::string_view part : parts) {
    expect(EVP_MAC_update(context.get(), data(part), part.size()) == 1);
  }
  Digest digest{};
  std::size_t size = 0;
  expect(EVP_MAC_final(context.get(), digest.data(), &size, digest.size()) == 1 &&
         size == digest.size());
  return digest;
}

bool equal_in_constant_time(const Digest& a, const Digest& b) {
  return CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

std::string to_hex(const Digest& digest) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : digest) {
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

}  // namespace nacre
