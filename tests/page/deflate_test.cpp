// Inflates by zlib what was deflated in pieces.
#include "host/show/deflate.h"

#include <doctest/doctest.h>
#include <zlib.h>

#include <array>
#include <random>
#include <string>
#include <vector>

#include "host/base/parallel.h"

using namespace vkh;

namespace {

std::string inflated(const std::string& text, size_t bytes) {
  std::string out(bytes + 1, '\0');
  auto size = static_cast<uLongf>(out.size());
  const auto* from = reinterpret_cast<const Bytef*>(text.data());
  REQUIRE(uncompress(reinterpret_cast<Bytef*>(out.data()), &size, from,
                     static_cast<uLong>(text.size())) == Z_OK);
  out.resize(size);
  return out;
}

// Returns letters of an alphabet of `kinds`, in words that come again.
std::string letters(size_t count, int kinds) {
  std::mt19937 random(static_cast<unsigned>(count) + static_cast<unsigned>(kinds));
  std::string text;
  while (text.size() < count) {
    const size_t back = random() % 60000 + 1, size = random() % 100;
    if (back < text.size() && random() % 2 == 0) {
      text += std::string(text, text.size() - back, size);
    } else {
      text += static_cast<char>(random() % static_cast<unsigned>(kinds));
    }
  }
  text.resize(count);
  return text;
}

constexpr std::array kWays{Deflate::kQuick, Deflate::kThorough, Deflate::kCodes};

}  // namespace

TEST_CASE("what was deflated is inflated, whatever its size") {
  constexpr size_t kPiece = size_t{1} << 18;
  for (const size_t count : {size_t{0}, size_t{1}, size_t{1000}, kPiece - 1, kPiece, kPiece + 1,
                             2 * kPiece, 5 * kPiece + 7}) {
    for (const int kinds : {1, 20, 256}) {
      const std::string text = letters(count, kinds);
      for (const Deflate how : kWays)
        CHECK(inflated(deflated(std::array{DeflatePart{text, how}}), count) == text);
    }
  }
}

TEST_CASE("parts are one text, and each is deflated in its way") {
  const std::string first = letters(700000, 20), second = letters(300000, 256);
  for (const Deflate how : kWays) {
    for (const Deflate of_rest : kWays) {
      const std::string text =
          deflated(std::array{DeflatePart{first, how}, DeflatePart{second, of_rest}});
      CHECK(inflated(text, first.size() + second.size()) == first + second);
    }
  }
  CHECK(inflated(deflated({}), 0).empty());
}

TEST_CASE("pieces repeat what is before them, and their bytes do not depend on threads") {
  const std::string text = letters(3000000, 256);
  const std::array part{DeflatePart{text, Deflate::kQuick}};
  const std::string many = deflated(part);
  limit_threads(1);
  const std::string one = deflated(part);
  limit_threads(0);
  CHECK(many == one);
  uLongf whole = compressBound(static_cast<uLong>(text.size()));
  std::vector<Bytef> by_zlib(whole);
  compress2(by_zlib.data(), &whole, reinterpret_cast<const Bytef*>(text.data()),
            static_cast<uLong>(text.size()), 3);
  CHECK(static_cast<double>(many.size()) < 1.01 * static_cast<double>(whole));
}
