#include "vkhausdorff/sha256.h"

#include <array>
#include <vector>

#include "host/base/input_file.h"

#if defined(_WIN32)
// clang-format off
#include <windows.h>
#include <bcrypt.h>
// clang-format on
#elif defined(VKH_HAS_CRYPTO)
#include <openssl/evp.h>
#endif

namespace vkh {
namespace {

using Digest = std::array<unsigned char, 32>;

#if defined(_WIN32)

class Hash {
 public:
  Hash() {
    is_good_ = BCryptOpenAlgorithmProvider(&algorithm_, BCRYPT_SHA256_ALGORITHM, nullptr, 0) == 0 &&
               BCryptCreateHash(algorithm_, &hash_, nullptr, 0, nullptr, 0, 0) == 0;
  }
  ~Hash() {
    if (hash_ != nullptr) BCryptDestroyHash(hash_);
    if (algorithm_ != nullptr) BCryptCloseAlgorithmProvider(algorithm_, 0);
  }
  Hash(const Hash&) = delete;
  Hash& operator=(const Hash&) = delete;
  void add(const char* bytes, size_t count) {
    is_good_ = is_good_ && BCryptHashData(hash_, reinterpret_cast<PUCHAR>(const_cast<char*>(bytes)),
                                          static_cast<ULONG>(count), 0) == 0;
  }
  bool finish(Digest& digest) {
    return is_good_ &&
           BCryptFinishHash(hash_, digest.data(), static_cast<ULONG>(digest.size()), 0) == 0;
  }

 private:
  BCRYPT_ALG_HANDLE algorithm_ = nullptr;
  BCRYPT_HASH_HANDLE hash_ = nullptr;
  bool is_good_ = false;
};

#elif defined(VKH_HAS_CRYPTO)

class Hash {
 public:
  Hash() : context_(EVP_MD_CTX_new()) {
    is_good_ = context_ != nullptr && EVP_DigestInit_ex(context_, EVP_sha256(), nullptr) == 1;
  }
  ~Hash() { EVP_MD_CTX_free(context_); }
  Hash(const Hash&) = delete;
  Hash& operator=(const Hash&) = delete;
  void add(const char* bytes, size_t count) {
    is_good_ = is_good_ && EVP_DigestUpdate(context_, bytes, count) == 1;
  }
  bool finish(Digest& digest) {
    return is_good_ && EVP_DigestFinal_ex(context_, digest.data(), nullptr) == 1;
  }

 private:
  EVP_MD_CTX* context_;
  bool is_good_ = false;
};

#else

class Hash {
 public:
  void add(const char*, size_t) {}
  bool finish(Digest&) { return false; }
};

#endif

std::string digits_of(Hash& hash) {
  Digest digest{};
  if (!hash.finish(digest)) return {};
  std::string text;
  for (const unsigned char byte : digest) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

}  // namespace

std::string sha256_of(const std::filesystem::path& path, const std::function<bool()>& keep_going) {
  const InputFile file(path);
  if (!file.is_open()) return {};
  Hash hash;
  std::vector<char> piece(size_t{1} << 20);
  for (uint64_t at = 0; at < file.size();) {
    const size_t count = file.read(at, piece.data(), piece.size());
    if (count == 0 || !keep_going()) return {};
    hash.add(piece.data(), count);
    at += count;
  }
  return digits_of(hash);
}

std::string sha256_of_pieces(const std::function<std::string_view()>& next) {
  Hash hash;
  for (std::string_view piece = next(); !piece.empty(); piece = next())
    hash.add(piece.data(), piece.size());
  return digits_of(hash);
}

}  // namespace vkh
