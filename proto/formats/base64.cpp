#include "proto/formats/base64.h"

#include <memory>
#include <new>

#include <openssl/evp.h>

#include "core/error.h"

namespace wellspaced {

std::string decode_base64(std::string_view text) {
  const std::unique_ptr<EVP_ENCODE_CTX, decltype(&EVP_ENCODE_CTX_free)> context(EVP_ENCODE_CTX_new(),
                                                                                &EVP_ENCODE_CTX_free);
  if (context == nullptr) throw std::bad_alloc();
  EVP_DecodeInit(context.get());
  std::string bytes(text.size() / 4 * 3 + 3, '\0');
  auto* to = reinterpret_cast<unsigned char*>(bytes.data());
  int most = 0, rest = 0;
  const bool fine =
      EVP_DecodeUpdate(context.get(), to, &most, reinterpret_cast<const unsigned char*>(text.data()),
                       static_cast<int>(text.size())) >= 0 &&
      EVP_DecodeFinal(context.get(), to + most, &rest) == 1;
  if (!fine || text.empty())
    throw Error(ErrorCode::malformed_request,
                "this is not base64; encode the file's bytes with padding (RFC 4648)");
  bytes.resize(static_cast<std::size_t>(most + rest));
  return bytes;
}

std::string encode_base64(std::string_view bytes) {
  constexpr std::size_t block = 3 << 20;  // its lengths are ints
  std::string text((bytes.size() + 2) / 3 * 4 + 1, '\0');
  std::size_t to = 0;
  for (std::size_t from = 0; from < bytes.size(); from += block) {
    const std::string_view part = bytes.substr(from, block);
    to += static_cast<std::size_t>(EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data() + to),
                                                   reinterpret_cast<const unsigned char*>(part.data()),
                                                   static_cast<int>(part.size())));
  }
  text.resize(to);
  return text;
}

}  // namespace wellspaced
